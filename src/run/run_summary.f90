!> The summary of the runs of the command: a row of values for each, on the screen and in the file of --summary. Ends the program.
!! The values of a run are a list of names and numbers, those of the watched nodes, joints and frequencies that it has.
!! The table has a column for each name of any run. The exit status is the highest of all runs.
module run_summary
   use c_library, only: end_run
   use command_line, only: command_type
   use distribution, only: leave_processes
   use equation_solver, only: failure_type
   use incomplete_results, only: all_complete, hold_interrupts
   use kinds, only: wp
   use model_data, only: model_type
   use output_file, only: output_file_type
   use page_lines, only: heading
   use result_page, only: largest_safety
   use results, only: results_type
   use stage_plan, only: pair_names
   use table_column, only: column, column_type, csv, csv_titles
   use table_writer, only: table_type
   use terminal, only: say_line
   use text_tools, only: integer_text
   implicit none
   private

   public :: summarise, end_program

   integer, parameter, public :: status_unsolved = 3, status_unwritten = 4

   type, public :: named_value
      character(40) :: name = ''                !! of its column
      real(wp)      :: value = 0.0_wp
   end type named_value

   !> The row of a run.
   type, public :: summary_row
      character(:), allocatable :: name
      character(60) :: ended = ''               !! how, where the status is not 0
      integer  :: status = 0, exit = 0          !! status of the deck; also of the output
      real(wp) :: seconds = 0.0_wp
      logical  :: is_short = .false.            !! ended for want of memory
      type(named_value), allocatable :: values(:)
   end type summary_row

   character(10), parameter :: whole(4) = [character(10) :: 'stages', 'increments', 'iterations', 'watched'] ! numbers without fraction

contains

   !> The ROW of a run with the NAME of its deck and values, from its RESULTS; FAILURE is why they end early. A run that HAS_PART of a
   !! stage has values without any finished stage.
   subroutine summarise(name, model, results, failure, has_part, status, row)
      character(*), intent(in)       :: name
      type(model_type), intent(in)   :: model
      type(results_type), intent(in) :: results
      type(failure_type), intent(in) :: failure
      logical, intent(in)            :: has_part
      integer, intent(in)            :: status
      type(summary_row), intent(out) :: row
      integer :: first, i, id, k, n

      row%name = name
      row%status = status
      if (status /= 0) row%ended = 'NO RESULTS'
      if (results%finished%is_named()) row%ended = 'ENDED EARLY at '//results%page%place
      if (failure%raised) row%is_short = index(failure%message, ' MiB ') > 0
      if (failure%raised .and. index(failure%message//' ', 'given up') > 0) row%ended = 'GIVEN UP, '//row%ended(:50)
      n = 0
      allocate (row%values(1000))
      collect: associate (d => results%counts%digest, watched => results%watched)
         call add('stages', real(d%stages, wp))
         call add('increments', real(d%increments, wp))
         call add('iterations', real(d%iterations, wp))
         if (d%stages == 0 .and. .not. has_part) exit collect
         call add('u_max', d%u_max)
         call add('mises_max', d%mises_max, model%mesh%n_elements > 0)
         call add('contact', d%contact, size(model%joints%list) > 0)
         call add('safety', d%safety, d%safety < huge(1.0_wp))
         call add('frequency', d%frequencies(1), d%frequencies(1) >= 0.0_wp)
         call add('bolt_force', d%bolt_force, d%bolt_force < huge(1.0_wp))
         call add('bolt_use', d%bolt_use, d%bolt_use >= 0.0_wp)
         do k = 2, size(d%frequencies)
            call add('frequency_'//integer_text(k), d%frequencies(k), d%frequencies(k) >= 0.0_wp)
         end do
         if (.not. allocated(watched%nodes)) exit collect
         do k = 1, size(watched%nodes)
            associate (node => watched%nodes(k))
               id = model%mesh%node_id(node%node)
               call add_movement(k == 1, id, integer_text(id), node%along, node%is_loaded, node%stiffness, node%moves)
            end associate
         end do
         do k = 1, size(watched%pairs)
            associate (pair => watched%pairs(k), ids => watched%pairs(k)%pair%ids)
               first = findloc(any(abs(pair%pair%along) > 0.0_wp, dim=1), .true., dim=1)
               do i = first, merge(1, size(pair_names), first == 1) ! two nodes at one place have no line, but axes
                  if (all(abs(pair%pair%along(:, i)) <= 0.0_wp)) cycle
                  call add_movement(k == 1 .and. i == first .and. size(watched%nodes) == 0, ids(1), integer_text(ids(1))//'-'// &
                                    integer_text(ids(2))//trim(merge('  ', '_'//pair_names(i)(:1), i == 1)), &
                                    pair%change(i), .true., pair%stiffness(i), abs(pair%stiffness(i)) > 0.0_wp)
               end do
            end associate
         end do
         do k = 1, size(watched%parts)
            call add('share_joint_'//integer_text(watched%parts(k)%id), sum(watched%parts(k)%share), &
                     watched%parts(k)%kind == 'JOINT')
         end do
      end associate collect
      row%values = row%values(:n)

   contains

      subroutine add(name, value, where)
         character(*), intent(in)      :: name
         real(wp), intent(in)          :: value
         logical, intent(in), optional :: where !! default: true

         if (present(where)) then
            if (.not. where) return
         end if
         if (n == size(row%values)) row%values = [row%values, row%values]
         n = n + 1
         row%values(n) = named_value(name, value)
      end subroutine add

      !> Movement and stiffness of a node or pair, the first of them also under the names without its number.
      subroutine add_movement(is_first, id, of, along, has_load, stiffness, moves)
         logical, intent(in)      :: is_first
         integer, intent(in)      :: id
         character(*), intent(in) :: of
         logical, intent(in)      :: has_load, moves
         real(wp), intent(in)     :: along, stiffness

         if (is_first) then
            call add('watched', real(id, wp))
            call add('along', along, has_load)
            call add('stiffness', stiffness, moves)
         end if
         call add('along_'//of, along, has_load)
         call add('stiffness_'//of, stiffness, moves)
      end subroutine add_movement

   end subroutine summarise

   !> End the program with the highest status of the runs of COMMAND, whose summary has the ROWS. The summary goes into the file of
   !! --summary and, with several runs, to the screen. An interrupt that has waited ends the program here.
   subroutine end_program(command, rows)
      type(command_type), intent(in) :: command
      type(summary_row), intent(in)  :: rows(:)
      type(output_file_type) :: screen, summary
      type(table_type)       :: table
      type(column_type), allocatable :: columns(:)
      character(40) :: name ! on the screen, where it is the end of a longer name
      integer :: i, k
      logical :: ok, shown

      call screen%start('')
      if (command%summary /= '') call summary%start(command%summary)
      call heading(screen, 'ALL RUNS')
      columns = [csv('deck'), column('', 'a41', key='name'), column('STATUS', 'i7', name='status'), csv('stages'), &
                 column('INCREMENTS', 'i11', name='increments'), csv('iterations'), &
                 column('U MAX', 'es12.4', name='u_max'), column('MISES MAX', 'es12.4', name='mises_max'), &
                 csv('contact'), column('CONTACT %', 'f10.2'), csv('safety'), column('MU N/T', 'f10.3'), &
                 column('FREQUENCY', 'es12.4', name='frequency'), csv(['watched', 'along  ']), &
                 column('STIFFNESS', 'es12.4', name='stiffness'), csv(['seconds', 'ended  '])]
      do i = 1, size(rows)
         associate (names => rows(i)%values%name)
            if (i > 1) then
               if (size(names) == size(rows(1)%values)) then
                  if (all(names == rows(1)%values%name)) cycle
               end if
            end if
            columns = [columns, csv(pack(names, [(all(columns%key /= names(k)), k = 1, size(names))]))]
         end associate
      end do
      call table%start('', columns, screen)
      if (summary%is_open) call summary%put(csv_titles(columns))
      do i = 1, size(rows)
         associate (row => rows(i))
            name = row%name(max(1, len(row%name) - len(name) + 1):)
            call table%put('deck', '"'//row%name//'"')
            call table%put('name', ' '//name)
            call table%put('status', row%status)
            call table%put('seconds', row%seconds)
            call table%put('ended', '"'//trim(row%ended)//'"')
            do k = 1, size(row%values)
               associate (item => row%values(k))
                  if (any(whole == item%name)) call table%put(trim(item%name), nint(item%value))
                  if (all(whole /= item%name)) call table%put(trim(item%name), item%value)
                  if (item%name == 'contact') call table%put('CONTACT %', 100.0_wp*item%value)
                  if (item%name == 'safety' .and. item%value <= largest_safety) call table%put('MU N/T', item%value)
               end associate
            end do
            call table%leave_rest()
            call table%print_row(screen, summary)
            if (row%ended /= '') call screen%put('     '//trim(row%ended))
         end associate
      end do
      ok = .true.
      shown = .true.
      if (command%summary /= '') call summary%finish(ok)
      if (.not. ok) call say_line('the summary '//command%summary//' cannot be written')
      if (size(rows) > 1 .and. .not. command%check_only) call screen%finish(shown)
      call all_complete()
      call hold_interrupts(.false.)
      call leave_processes()
      call end_run(max(maxval(rows%exit), merge(0, status_unwritten, ok .and. shown)))
   end subroutine end_program

end module run_summary
