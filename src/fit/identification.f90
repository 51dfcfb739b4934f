!> jointfit --structure: parameters of a deck from what was measured on the structure. Reads both files, seeks the parameters, and
!! writes them with deviations, the rows before and after, and the cards of the deck with the values in.
module identification
   use card_text, only: real_field_text
   use deck_errors, only: deck_error_list
   use deck_parameters, only: parameter_type
   use deck_text, only: deck_text_type, read_deck_text
   use equation_solver, only: failure_type
   use error_report, only: print_errors
   use fit_command, only: fit_command_type
   use fit_plot, only: put_block, quoted
   use incomplete_results, only: hold_interrupts, interrupt_so_far
   use, intrinsic :: iso_fortran_env, only: error_unit
   use kinds, only: wp
   use law_search, only: search_type, seek
   use machine, only: use_threads
   use measured_data, only: a_phase, differences, measured_type, outer_value, read_measured
   use mode_rows, only: structure_type
   use omp_lib, only: omp_get_max_threads
   use openblas, only: prepare_libraries
   use output_file, only: output_file_type
   use structure_run, only: start_structure
   use terminal, only: clear_line, complain_of_input, open_line, version
   use text_tools, only: integer_text, one_of, plural, real_text
   use tolerances, only: other_unit
   implicit none
   private

   public :: identify

   integer, parameter :: status_unreadable = 1, status_data = 2, status_unsolved = 3

contains

   !> Carry out COMMAND. The result goes to OUT, the picture to PLOT; STATUS is the exit status.
   subroutine identify(command, out, plot, status)
      type(fit_command_type), intent(in)    :: command
      type(output_file_type), intent(inout) :: out, plot
      integer, intent(out)                  :: status
      type(measured_type)   :: data
      type(structure_type)  :: structure
      type(search_type)     :: search
      type(deck_error_list) :: errors, of_data
      type(failure_type)    :: failure
      integer :: cores
      logical :: readable

      call prepare_libraries()
      cores = omp_get_max_threads()
      call use_threads(1)
      status = status_unreadable
      call read_measured(command%measured%path, command%measured%name, data, of_data, readable)
      if (.not. readable) call complain_of_input(command%measured, 'a file of measured values')
      if (.not. readable) return
      call take_starts(command, data, of_data)
      structure%path = command%structure%path
      structure%set = command%set
      if (.not. of_data%any()) then
         call start_structure(data, structure, errors, of_data, readable, failure)
         if (.not. readable) call complain_of_input(command%structure, 'a deck')
         if (.not. readable) return
      end if
      status = status_data
      if (errors%any()) call print_errors(error_unit, 'DECK', 'nothing solved', structure%deck%text, errors)
      if (of_data%any()) call print_errors(error_unit, 'DATA', 'nothing solved', data%text, of_data)
      if (errors%any() .or. of_data%any()) return
      call open_line(command%structure%name, .false., .false.)
      call hold_interrupts(.true.)
      search%fault = failure%message
      if (.not. failure%raised) call seek(data, structure, command%n_starts, cores, search)
      call clear_line()
      status = merge(0, status_unsolved, search%fault == '' .and. interrupt_so_far() == 0)
      if (search%fault /= '') then
         write (error_unit, '(4a)') command%structure%name, ': with the start values: ', search%fault, '; nothing found'
      else if (allocated(search%y)) then
         call write_search(command, data, search, out)
         call write_cards(structure, data, search, out)
         if (command%plot /= '') call plot_rows(command, data, search, plot)
         if (interrupt_so_far() /= 0) write (error_unit, '(2a)') command%structure%name, ': interrupted, the best values so far'
      end if
   end subroutine identify

   !> Put the starts of the command into DATA.
   subroutine take_starts(command, data, errors)
      type(fit_command_type), intent(in)   :: command
      type(measured_type), intent(inout)   :: data
      type(deck_error_list), intent(inout) :: errors
      integer :: i, k

      do i = 1, size(command%start)
         do k = 1, size(data%parameters)
            if (data%parameters(k)%name == command%start(i)%name) exit
         end do
         if (k > size(data%parameters)) then
            call errors%add(0, '--start '//command%start(i)%name//': the file has no such parameter')
            cycle
         end if
         read (command%start(i)%value, *) data%parameters(k)%start
         associate (p => data%parameters(k))
            if (.not. (p%is_linear .or. p%start > 0.0_wp) .or. (p%is_bounded .and. (p%start <= p%low .or. p%start >= p%high))) &
               call errors%add(p%line, '--start '//p%name//': expected a value between the bounds, above 0 unless LINEAR')
         end associate
      end do
      if (size(data%rows) < size(data%parameters)) call errors%add(0, plural(size(data%parameters), 'parameter')//' and '// &
         plural(size(data%rows), 'row')//': expected a row for each parameter at least')
   end subroutine take_starts

   !> Write the parameters and the rows as comments.
   subroutine write_search(command, data, search, out)
      type(fit_command_type), intent(in)    :: command
      type(measured_type), intent(in)       :: data
      type(search_type), intent(in)         :: search
      type(output_file_type), intent(inout) :: out
      real(wp) :: before(size(data%rows)), after(size(data%rows)), deviation
      real(wp) :: interval(2)
      character(:), allocatable :: words
      integer :: i, j, k

      before = differences(data, search%first%value)
      after = differences(data, search%best%value)
      if (interrupt_so_far() /= 0) call out%put('$ INTERRUPTED: THE BEST VALUES SO FAR')
      call out%put('$          '//command%structure%name//' fitted by jointfit '//version//' to '//command%measured%name)
      call out%put('$ search   '//plural(search%n_runs, 'run')//'; sum of squares '//real_text(sum(before**2))// &
         ' at the start, '//real_text(search%square)//' now, expected '//integer_text(size(data%rows) - size(search%free))// &
         ' of '//plural(size(data%rows), 'row')//' and '//plural(size(search%free), 'free parameter'))
      if (search%n_starts > 1) call out%put('$ starts   '//integer_text(search%n_same)//' of '//integer_text(search%n_starts)// &
                                            ' have led to this sum of squares')
      if (search%by_number) call out%put('$ modes    have changed places: MODE counts at the values found, not at the start')
      do i = 1, size(data%rows)
         if (abs(search%best%off_number(i)) > 0.0_wp) call out%put('$ modes    row '//integer_text(i)// &
            ': the mode is not that with the number of the row; SHAPE= of its points decides')
      end do
      call write_other(data, search, out)
      call write_checks(data, search%best%value, after, out)
      call out%put('$')
      call out%put('$ parameter        start          now    deviation       two deviations      determined by the rows')
      do i = 1, size(data%parameters)
         k = findloc(search%free, i, dim=1)
         if (.not. allocated(search%statistics%deviation)) k = 0
         associate (p => data%parameters(i))
            words = ''
            if (search%is_held(i)) words = '   HELD: the rows do not determine it'
            if (search%is_at_bound(i)) words = '   AT ITS BOUND'
            if (k > 0) then
               deviation = outer_value(p, search%y(i))*search%statistics%deviation(k)
               if (p%is_linear) deviation = outer_value(p, search%statistics%deviation(k))
               interval = outer_value(p, search%y(i) + 2.0_wp*[-1, 1]*search%statistics%deviation(k))
               words = cell(deviation)//cell(interval(1))//cell(interval(2))//'   '//leading(search%statistics%share(:, k))
            end if
            call out%put('$ '//p%name//repeat(' ', max(1, 10 - len(p%name)))//cell(p%start)// &
                         cell(outer_value(p, search%y(i)))//words)
         end associate
      end do
      if (allocated(search%statistics%correlation)) then
         call out%put('$')
         do j = 2, merge(size(search%free), 0, size(search%free) == size(search%statistics%deviation))
            words = '$ correlation of '//data%parameters(search%free(j))%name//':'
            do k = 1, j - 1
               words = words//'  '//data%parameters(search%free(k))%name//' '// &
                       real_text(nint(1000.0_wp*search%statistics%correlation(j, k))/1000.0_wp)
            end do
            call out%put(words)
         end do
      end if
      call out%put('$')
      call out%put('$  row     measured    deviation        start          now  differences/deviation      MAC')
      do i = 1, size(data%rows)
         associate (row => data%rows(i))
            call out%put('$ '//adjusted(integer_text(i), 4)//cell(row%value)//cell(row%deviation)//cell(search%first%value(i))// &
               cell(search%best%value(i))//adjusted(hundredths(before(i)), 12)//adjusted(hundredths(after(i)), 10)// &
               adjusted(real_text(nint(1000.0_wp*search%best%mac(i))/1000.0_wp), 9)//'  '//row%words)
         end associate
      end do
   end subroutine write_search

   !> Write the best other place where a search has ended: the data are within two deviations of it too, the parameters are not.
   subroutine write_other(data, search, out)
      type(measured_type), intent(in)       :: data
      type(search_type), intent(in)         :: search
      type(output_file_type), intent(inout) :: out
      logical :: is_other(size(search%squares))
      character(:), allocatable :: words
      integer :: i, k

      if (.not. allocated(search%statistics%deviation)) return
      if (size(search%statistics%deviation) /= size(search%free)) return
      do i = 1, size(is_other)
         is_other(i) = search%squares(i) < search%square + 4.0_wp .and. &
            any(abs(search%ends(search%free, i) - search%y(search%free)) > 2.0_wp*search%statistics%deviation)
      end do
      k = minloc(search%squares, dim=1, mask=is_other)
      if (k == 0) return
      words = '$ or       with other modes for the rows, or beyond a maximum: sum of squares '//real_text(search%squares(k))//' at'
      do i = 1, size(data%parameters)
         words = words//' '//data%parameters(i)%name//'='// &
                 real_field_text(outer_value(data%parameters(i), search%ends(i, k)), 7)
      end do
      call out%put(words)
   end subroutine write_other

   !> Write which rows may be mistakes: VALUE of the deck is OFF by many deviations, and has the other sign or another power of ten.
   subroutine write_checks(data, value, off, out)
      type(measured_type), intent(in)       :: data
      real(wp), intent(in)                  :: value(:), off(:)
      type(output_file_type), intent(inout) :: out
      integer :: i

      do i = 1, size(off)
         associate (row => data%rows(i), least => min(abs(value(i)), abs(data%rows(i)%value)))
            if (abs(off(i)) < other_unit .or. row%kind == a_phase .or. .not. least > 0.0_wp) cycle
            if (value(i)*row%value < 0.0_wp) call out%put('$ check    row '//integer_text(i)//': the deck has the other sign')
            if (least*other_unit < max(abs(value(i)), abs(row%value))) call out%put('$ check    row '//integer_text(i)// &
               ': the deck has '//trim(adjustl(cell(abs(value(i)/row%value))))//' times the measured value; are their units equal?')
         end associate
      end do
   end subroutine write_checks

   !> The rows with the largest SHARES of the variance of a parameter, as `1 (45 %), 3 (30 %)`.
   function leading(shares) result(words)
      real(wp), intent(in)      :: shares(:)
      character(:), allocatable :: words
      logical :: left(size(shares))
      integer :: i, k

      words = ''
      left = .true.
      do k = 1, min(3, size(shares))
         i = maxloc(shares, dim=1, mask=left)
         left(i) = .false.
         if (shares(i) >= 0.05_wp) words = words//one_of(k == 1, '', ', ')//integer_text(i)//' ('// &
                                           integer_text(nint(100.0_wp*shares(i)))//' %)'
      end do
   end function leading

   !> WORDS at the right end of WIDTH columns, and a number in 13 columns.
   pure function adjusted(words, width) result(text)
      character(*), intent(in) :: words
      integer, intent(in)      :: width
      character(max(width, len(words))) :: text

      text = adjustr(repeat(' ', len(text) - len(words))//words)
   end function adjusted

   pure function hundredths(value) result(text)
      real(wp), intent(in)      :: value
      character(:), allocatable :: text

      text = real_text(nint(100.0_wp*min(1.0e6_wp, max(-1.0e6_wp, value)))/100.0_wp)
   end function hundredths

   pure function cell(value) result(text)
      real(wp), intent(in) :: value
      character(13) :: text

      if (abs(value) >= 0.1_wp .and. abs(value) < 1.0e6_wp) write (text, '(f13.4)') value
      if (abs(value) < 0.1_wp .or. abs(value) >= 1.0e6_wp) write (text, '(es13.5)') value
   end function cell

   !> Write the cards of the deck that have parameters, with the values in.
   subroutine write_cards(structure, data, search, out)
      type(structure_type), intent(in)      :: structure
      type(measured_type), intent(in)       :: data
      type(search_type), intent(in)         :: search
      type(output_file_type), intent(inout) :: out
      type(parameter_type), allocatable :: parameters(:)
      type(deck_text_type)  :: texts(2) ! with the names and with the values of the parameters
      type(deck_error_list) :: errors
      character(:), allocatable :: words
      logical :: readable
      integer :: i, j, first, k

      words = '$ jointfem'
      do k = 1, 2
         allocate (parameters(size(data%parameters) + size(structure%set)))
         parameters(size(data%parameters) + 1:) = structure%set
         do i = 1, size(data%parameters)
            parameters(i)%name = data%parameters(i)%name
            parameters(i)%is_long = .true.
            parameters(i)%value = '${'//parameters(i)%name//'}'
            if (k == 2) parameters(i)%value = real_field_text(outer_value(data%parameters(i), search%y(i)), 7)
            if (k == 2) words = words//' --set '//parameters(i)%name//'='//parameters(i)%value
         end do
         call read_deck_text(structure%path, texts(k), errors, readable, parameters)
         deallocate (parameters)
      end do
      call out%put('$')
      call out%put(words)
      first = 1
      do i = 1, texts(1)%n
         if (scan(texts(1)%line(i)//' ', '+*, $') /= 1) first = i
         words = texts(1)%line(i)
         if (index(words, '${') == 0 .or. index(words, '${') > index(words, '$')) cycle ! none, or in a comment
         do j = first, texts(1)%n ! the whole card
            words = texts(1)%line(j)//' '
            if (j > i .and. scan(words, '+*, ') /= 1) exit
            if (words /= '') call out%put(texts(2)%line(j))
         end do
         first = j
      end do
   end subroutine write_cards

   !> Plot the rows over their numbers: measured, at the start and now, over the measured value.
   subroutine plot_rows(command, data, search, plot)
      type(fit_command_type), intent(in)    :: command
      type(measured_type), intent(in)       :: data
      type(search_type), intent(in)         :: search
      type(output_file_type), intent(inout) :: plot
      character(:), allocatable :: picture, plots
      real(wp) :: number(size(data%rows)), scale(size(data%rows))
      integer :: i, k

      picture = command%plot
      k = index(picture, '.', back=.true.)
      if (k > index(picture, '/', back=.true.) + 1) picture = picture(:k - 1)
      call plot%put('# '//command%measured%name//' and '//command%structure%name//' by jointfit; gnuplot draws '//picture//'.svg')
      call plot%put('reset')
      plots = ''
      number = [(real(i, wp), i = 1, size(number))]
      scale = merge(1.0_wp, data%rows%value, abs(data%rows%value) <= 0.0_wp)
      call put_block(plot, plots, 'start', [1, 1], number, data%rows%value/scale, number, search%first%value/scale)
      call put_block(plot, plots, 'now', [1, 2], number, data%rows%value/scale, number, search%best%value/scale)
      call plot%put('$deviations << EOD')
      do i = 1, size(number)
         call plot%put(integer_text(i)//' '//real_text(data%rows(i)%value/scale(i))//' '// &
                       real_text(data%rows(i)%deviation/abs(scale(i))))
      end do
      call plot%put('EOD')
      call plot%put('set terminal svg size 900,600 noenhanced background "white"')
      call plot%put('set output '//quoted(picture//'.svg'))
      call plot%put('set xlabel "row"')
      call plot%put('set ylabel "over the measured value"')
      call plot%put('set grid')
      call plot%put('plot $deviations using 1:2:3 with yerrorbars pt 7 lc 0 title "measured"'//plots)
   end subroutine plot_rows

end module identification
