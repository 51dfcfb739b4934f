!> Ends a run and the batch: names the results or reports the error, writes the summary, and sets the exit status.
!! The summary has a row for each run of the command. It goes into the file of --summary, and with several runs to the screen too.
!! The exit status is the highest of all runs.
module run_end
   use c_library, only: end_run, write_bytes
   use command_line, only: command_type, is_result_of
   use deck_input, only: deck_type
   use distribution, only: leave_processes
   use error_report, only: print_errors
   use incomplete_results, only: say_at_interrupts, what_is_in_the_way
   use, intrinsic :: iso_fortran_env, only: error_unit
   use kinds, only: long, wp
   use result_page, only: history_ending
   use table_writer, only: column, column_type, csv, csv_titles, heading, table_type
   use model_data, only: model_type, n_points
   use output_file, only: output_file_type
   use progress, only: phase_write, has_errors, is_over, is_refused, is_unreadable, is_unsolved, is_unwritten, run_type, &
                       status_of, was_checked, was_searched, would_overwrite
   use range_watch, only: distance_words, tetra_words
   use restart_file, only: restart_name
   use results, only: digest_type, discard_results, finish_results, listing_ending, show_answers
   use stage_plan, only: stage_plan_type
   use terminal, only: clear_line, complain_of_input, say_line
   use text_tools, only: plural
   use unit_watch, only: stress_words
   use watched_nodes, only: watched_node
   implicit none
   private

   public :: finish_run, end_program, start_run_of_batch, end_run_of_batch

   integer :: exit_status = 0 ! the highest so far

   integer, parameter :: name_width = 40 ! of the table on the screen

   type :: row_type
      character(:), allocatable :: name
      integer  :: status = 0
      type(digest_type) :: digest
      logical  :: is_there(5) = .false.                ! u_max, mises_max, contact, safety, frequency
      integer  :: node = 0                             ! number of the first watched node, 0: none
      type(watched_node) :: watched
      real(wp) :: seconds = 0.0_wp
   end type row_type

   type, public :: batch_type
      private
      type(row_type), allocatable :: rows(:)
      integer       :: n = 0
      integer(long) :: began = 0
   end type batch_type

contains

   !> End the current run: name the results or report the error. The progress line is cleared.
   subroutine finish_run(run, deck, model, plan)
      type(run_type), intent(inout)     :: run
      type(deck_type), intent(in)       :: deck
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      logical :: ok, shown

      if (run%keeps_results .or. .not. is_over(run)) then
         call run%progress%enter(phase_write)
         call finish_results(plan, run%failure, run%results, ok)
         call run%progress%finish()
         if (run%results%watch%n_warnings > 0) &
            call say_line(run%argument%name//': '//plural(run%results%watch%n_warnings, 'warning')//' in the listing')
         call tell(run%results%watch%poor_condition)
         call tell(stress_words(run%results%digest%strained))
         call tell(run%results%watch%divided)
         call tell(distance_words(run%results%watch%farthest))
         call tell(tetra_words(model))
         call say_of_deck(run, deck)
         if (ok) then
            call show_answers(run%results, shown)
            if (.not. shown) call miss_output(run%argument%name)
            if (run%results%missing_vtu /= '') then
               call tell('the files for ParaView cannot be written: '//run%results%missing_vtu)
               exit_status = max(exit_status, status_of(is_unwritten))
            end if
         else
            run%ending = is_unwritten
         end if
      end if
      if (run%failure%raised) run%ending = is_unsolved
      if (run%misses_restart) exit_status = max(exit_status, status_of(is_unwritten))
      call clear_line()
      call say_at_interrupts('')
      call say_how_it_ended(run, deck, model, plan)
      exit_status = max(exit_status, status_of(run%ending))

   contains

      !> Print WORDS about the deck, if any.
      subroutine tell(words)
         character(*), intent(in) :: words

         if (words /= '') call say_line(run%argument%name//': '//words)
      end subroutine tell

   end subroutine finish_run

   !> Report the entries without effect, and how NASTRAN would read the deck differently.
   subroutine say_of_deck(run, deck)
      type(run_type), intent(in)  :: run
      type(deck_type), intent(in) :: deck

      if (deck%bulk%ignored%n > 0) call say_line(run%argument%name//': '//deck%bulk%ignored%words())
      if (deck%control%of_nastran .and. size(deck%control%stages) > 1) call say_line(run%argument%name//': '// &
         plural(size(deck%control%stages), 'SUBCASE')//' are stages of one history: each starts from the end of the previous one')
   end subroutine say_of_deck

   !> Report the error, or that a deck is in order. A run that did not finish leaves no result.
   subroutine say_how_it_ended(run, deck, model, plan)
      type(run_type), intent(inout)     :: run
      type(deck_type), intent(in)       :: deck
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      logical :: ok
      integer :: i

      associate (name => run%argument%name, base => run%argument%base)
         select case (run%ending)
         case (is_unreadable)
            call complain_of_input(run%argument, 'a deck')
         case (is_refused)
            call say_line(name//': '//restart_name(base)//' cannot be resumed: '//run%problem)
            call discard_results(run%results)
         case (would_overwrite)
            do i = 2, deck%text%n_files
               if (is_result_of(deck%text%files(i)%true_path, run%argument)) &
                  call say_line(name//': its results would overwrite the INCLUDE file '//deck%text%files(i)%path)
            end do
         case (has_errors)
            call print_errors(error_unit, 'DECK', 'nothing solved', deck%text, run%errors)
         case (was_checked)
            call say_of_deck(run, deck)
            call write_bytes(1, name//': no errors; '//plural(n_points(model), 'node')//', '// &
                             plural(model%n_elements, 'body element')//', '// &
                             plural(size(model%interface), 'interface element')//', '//plural(size(plan%stages), 'stage')// &
                             new_line('a'), ok)
            if (.not. ok) call miss_output(name)
         case (was_searched)
            call say_of_deck(run, deck)
            call run%suggestions%finish(ok)
            if (.not. ok) call miss_output(name)
         case (is_unsolved)
            call say_line(name//': '//run%failure%message// &
                          trim(merge('; the results end there', '; no results           ', run%keeps_results)))
            if (.not. run%keeps_results) call discard_results(run%results)
         case (is_unwritten)
            if (base == '') then
               call say_line(name//': the listing cannot be written to the standard output')
            else if (what_is_in_the_way() /= '') then
               call say_line(name//': the results cannot be written: '//what_is_in_the_way()// &
                             '; remove it, or take another folder by -o')
            else
               call say_line(name//': the results '//base//listing_ending//' and '//base//history_ending// &
                             ' cannot be written: is the folder there, and is there room on the disk?')
            end if
            call discard_results(run%results)
         end select
      end associate
   end subroutine say_how_it_ended

   !> Report that the standard output of the deck NAME is full or closed.
   subroutine miss_output(name)
      character(*), intent(in) :: name

      call say_line(name//': the standard output cannot be written')
      exit_status = max(exit_status, status_of(is_unwritten))
   end subroutine miss_output

   !> Note the start of a run of COMMAND.
   subroutine start_run_of_batch(command, batch)
      type(command_type), intent(in)  :: command
      type(batch_type), intent(inout) :: batch

      if (.not. allocated(batch%rows)) allocate (batch%rows(size(command%decks)))
      call system_clock(batch%began)
   end subroutine start_run_of_batch

   !> Note the end of the run: its row of the summary.
   subroutine end_run_of_batch(run, model, batch)
      type(run_type), intent(in)      :: run
      type(model_type), intent(in)    :: model
      type(batch_type), intent(inout) :: batch
      integer(long) :: now, rate

      batch%n = batch%n + 1
      call system_clock(now, rate)
      associate (row => batch%rows(batch%n), digest => run%results%digest)
         row%name = run%argument%name
         row%status = status_of(run%ending)
         row%seconds = real(now - batch%began, wp)/real(rate, wp)
         row%digest = digest
         if (digest%stages == 0) return
         row%is_there = [.true., model%n_elements > 0, size(model%joints) > 0, digest%safety < huge(1.0_wp), &
                         digest%frequency >= 0.0_wp]
         if (.not. allocated(run%results%watched%nodes)) return
         row%watched = run%results%watched%nodes(1)
         row%node = model%node_id(row%watched%node)
      end associate
   end subroutine end_run_of_batch

   !> Write the summary of all runs of COMMAND. OK is false, with a message, where it cannot be written.
   subroutine end_batch(command, batch, ok)
      type(command_type), intent(in) :: command
      type(batch_type), intent(in)   :: batch
      logical, intent(out)           :: ok
      type(output_file_type)   :: screen, summary
      type(table_type) :: table
      type(column_type), allocatable :: columns(:)
      character(name_width) :: name
      integer :: i
      logical :: shown

      call screen%start('')
      if (command%summary /= '') call summary%start(command%summary)
      call heading(screen, 'ALL RUNS')
      columns = [csv('deck'), column('', 'a41'), column('STATUS', 'i7', name='status'), csv('stages'), &
                 column('INCREMENTS', 'i11', name='increments'), csv('iterations'), &
                 column('U MAX', 'es12.4', name='u_max'), column('MISES MAX', 'es12.4', name='mises_max'), &
                 csv('contact'), column('CONTACT %', 'f10.2'), csv('safety'), column('MU N/T', 'f10.3'), &
                 column('FREQUENCY', 'es12.4', name='frequency'), csv(['watched', 'along  ']), &
                 column('STIFFNESS', 'es12.4', name='stiffness'), csv('seconds')]
      call table%start('', columns, screen)
      if (summary%is_open) call summary%put(csv_titles(columns))
      do i = 1, batch%n
         associate (row => batch%rows(i), d => batch%rows(i)%digest)
            name = row%name(max(1, len(row%name) - name_width + 1):)
            call table%add('"'//row%name//'"')
            call table%add(' '//name)
            call table%add([row%status, d%stages, d%increments, d%iterations])
            call table%add([d%u_max, d%mises_max, d%contact, 100.0_wp*d%contact, d%safety, min(d%safety, 99999.0_wp), &
                            d%frequency], where=row%is_there([1, 2, 3, 3, 4, 4, 5]))
            call table%add([row%node], where=[row%node > 0])
            call table%add([row%watched%along, row%watched%stiffness], where=[row%watched%is_loaded, row%watched%moves])
            call table%add([row%seconds])
         end associate
         call table%print_row(screen, summary)
      end do
      ok = .true.
      if (command%summary /= '') call summary%finish(ok)
      if (.not. ok) call say_line('the summary '//command%summary//' cannot be written')
      if (batch%n < 2 .or. command%check_only) return
      call screen%finish(shown)
      ok = ok .and. shown
   end subroutine end_batch

   !> End the program with STATUS, or with the highest status of the decks where that is higher.
   subroutine end_program(status, command, runs)
      integer, intent(in), optional :: status !! default: 0
      type(command_type), intent(in), optional :: command !! whose RUNS the summary lists
      type(batch_type), intent(in), optional   :: runs
      logical :: ok

      if (present(status)) exit_status = max(exit_status, status)
      if (present(runs)) then
         call end_batch(command, runs, ok)
         if (.not. ok) exit_status = max(exit_status, status_of(is_unwritten))
      end if
      call leave_processes()
      call end_run(exit_status)
   end subroutine end_program

end module run_end
