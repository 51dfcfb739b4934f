!> Writes the outputs of jointfit besides the cards: errors, warnings and a gnuplot script; sets the exit status.
!! The script plots the data and the fit of a surface: the test points, and lines through the fit at these points.
module fit_output
   use c_library, only: end_run, tell_failed_writes
   use fit_data, only: test_data_type
   use kinds, only: wp
   use terminal, only: complain_of_input, input_argument
   use data_columns, only: branch_letters, branch_words, column_d, column_lambda, column_p, column_symbols, column_tau, &
                           data_normal, data_shear, fit_load, fit_reload, fit_unload
   use deck_errors, only: deck_error_list
   use deck_text, only: deck_text_type
   use error_report, only: print_errors
   use fit_command, only: fit_command_type
   use incomplete_results, only: all_complete, watch_ends, what_is_in_the_way
   use, intrinsic :: iso_fortran_env, only: error_unit
   use output_file, only: output_file_type
   use surface_fit, only: normal_fit_type, surface_fit_type
   use text_tools, only: integer_text, real_text
   implicit none
   private

   public :: report_unreadable_data, report_data_errors, report_fit, begin_output, end_fit, write_plot

   integer, parameter :: status_unreadable = 1, status_data = 2, status_unwritten = 4

   integer :: exit_status = 0 ! highest status so far

contains

   subroutine report_unreadable_data(file)
      type(input_argument), intent(in) :: file

      exit_status = max(exit_status, status_unreadable)
      call complain_of_input(file, 'a file of test data')
   end subroutine report_unreadable_data

   !> Report all errors of a data file.
   subroutine report_data_errors(text, errors)
      type(deck_text_type), intent(in)  :: text
      type(deck_error_list), intent(in) :: errors

      exit_status = max(exit_status, status_data)
      call print_errors(error_unit, 'DATA', 'no card written', text, errors)
   end subroutine report_data_errors

   !> Report the warnings of a fit, and a missing card where loading data are missing.
   subroutine report_fit(file, fit)
      type(input_argument), intent(in)   :: file
      type(surface_fit_type), intent(in) :: fit
      character(:), allocatable :: word
      integer :: k

      do k = 1, fit%warnings%n
         write (error_unit, '(3a)') file%name, ': WARNING: ', fit%warnings%items(k)%message
      end do
      if (fit%kind == data_normal .or. fit%has_loading) return
      exit_status = max(exit_status, status_data)
      word = trim(branch_words(merge(fit_reload, fit_unload, fit%branch(fit_reload)%n_points > 0)))
      write (error_unit, '(2a)') file%name, ': no LOAD data, and a JSHEAR card needs the loading coefficients: those of the'// &
         ' other branches are written as comments; --branch '//word//' --as LOAD makes a card of '//word//' data'
   end subroutine report_fit

   !> Begin the outputs of the run: OUT for the cards and, if the command asks for it, PLOT.
   subroutine begin_output(command, out, plot)
      type(fit_command_type), intent(in)    :: command
      type(output_file_type), intent(inout) :: out, plot

      call tell_failed_writes()
      call watch_ends()
      call out%start('')
      if (command%plot /= '') call plot%start(command%plot)
   end subroutine begin_output

   !> End the run with the highest status of all files.
   subroutine end_fit(command, out, plot)
      type(fit_command_type), intent(in)    :: command
      type(output_file_type), intent(inout) :: out, plot
      logical :: ok

      if (command%plot /= '') then
         call plot%finish(ok)
         if (what_is_in_the_way() /= '') then
            write (error_unit, '(2a)') 'jointfit: ', what_is_in_the_way()
         else if (.not. ok) then
            write (error_unit, '(3a)') 'jointfit: ', command%plot, ' cannot be written'
         end if
         call all_complete()
         exit_status = max(exit_status, merge(0, status_unwritten, ok))
      end if
      call out%finish(ok)
      if (.not. ok) write (error_unit, '(a)') 'jointfit: the cards cannot be written to the standard output'
      call end_run(max(exit_status, merge(0, status_unwritten, ok)))
   end subroutine end_fit

   !> Add the plot of surface NUMBER of the command to OUT: p over lambda, tau over d, or for published cubics Fig. 2, their coefficients
   !! over p.
   subroutine write_plot(command, number, data, fit, out)
      type(fit_command_type), intent(in)    :: command
      integer, intent(in)                   :: number
      type(test_data_type), intent(in)      :: data
      type(surface_fit_type), intent(in)    :: fit
      type(output_file_type), intent(inout) :: out
      character(:), allocatable :: picture, plots
      character(32) :: label
      integer :: axes(2), b, k

      picture = command%plot
      k = index(picture, '.', back=.true.)
      if (k > index(picture, '/', back=.true.) + 1) picture = picture(:k - 1)
      if (size(command%files) > 1) picture = picture//'_'//integer_text(command%id + number - 1)
      call out%put('# '//command%files(number)%name//' and its fit by jointfit; gnuplot draws '//picture//'.svg')
      call out%put('reset')
      plots = ''
      if (fit%kind == data_normal) call put_normal(data, fit%normal, plots, out)
      do b = fit_load, fit_reload
         if (fit%branch(b)%n_points == 0) cycle
         if (fit%kind == data_shear) then
            call put_shear(data, fit, b, plots, out)
         else
            associate (branch => fit%branch(b))
               do k = 1, 3
                  call put_block(out, plots, branch_letters(b)//integer_text(k), [b, k], branch%group_p, branch%cubic(k, :), &
                                 branch%group_p, branch%lines(1, k) + branch%lines(2, k)*branch%group_p)
               end do
            end associate
         end if
      end do
      call out%put('set terminal svg size 900,600 noenhanced background "white"')
      call out%put('set output '//quoted(picture//'.svg'))
      call out%put('set title '//quoted(command%files(number)%name))
      axes = [column_p, 0] ! 0: coefficients
      if (fit%kind == data_normal) axes = [column_lambda, column_p]
      if (fit%kind == data_shear) axes = [column_d, column_tau]
      do k = 1, count(axes > 0)
         label = column_symbols(axes(k))
         if (data%unit(axes(k)) /= '') label = trim(label)//' ['//trim(data%unit(axes(k)))//']'
         call out%put('set '//merge('x', 'y', k == 1)//'label '//quoted(label))
      end do
      call out%put('set key outside right')
      call out%put('set grid')
      call out%put('plot '//plots(3:))
   end subroutine write_plot

   !> Plot the points of loading with the power law, and the points of each unloading or reloading line with its slope E_u.
   subroutine put_normal(data, fit, plots, out)
      type(test_data_type), intent(in)         :: data
      type(normal_fit_type), intent(in)        :: fit
      character(:), allocatable, intent(inout) :: plots
      type(output_file_type), intent(inout)    :: out
      integer, allocatable  :: rows(:)
      real(wp), allocatable :: fitted(:), p(:)
      integer :: b, i, k

      do k = 0, size(fit%loops%lines)
         rows = pack([(i, i = 1, data%n)], fit%loops%line_of == k)
         p = data%value(column_p, rows)
         b = fit_load
         fitted = fit%c*max(p, 0.0_wp)**fit%m
         if (k > 0) then
            b = fit%loops%lines(k)%branch
            fitted = 0.0_wp*p + fit%loops%lines(k)%lambda
            if (fit%loops%e_u > 0.0_wp) fitted = fitted + (p - fit%loops%lines(k)%p)/fit%loops%e_u
         end if
         call put_block(out, plots, trim(branch_words(b)), [b, b], data%value(column_lambda, rows), p, fitted, p)
      end do
   end subroutine put_normal

   !> Plot the points of branch B of shear at each pressure and the law of the card, with the best constant of each run.
   subroutine put_shear(data, fit, b, plots, out)
      type(test_data_type), intent(in)         :: data
      type(surface_fit_type), intent(in)       :: fit
      integer, intent(in)                      :: b
      character(:), allocatable, intent(inout) :: plots
      type(output_file_type), intent(inout)    :: out
      integer, allocatable :: own(:)
      real(wp) :: fitted(data%n)
      integer  :: g, k

      associate (branch => fit%branch(b), rows => fit%branch(b)%row)
         do k = 1, size(branch%start)
            own = pack(rows, branch%curve == k)
            g = branch%group(branch%curve_at(k))
            associate (d => data%value(column_d, own), tau => data%value(column_tau, own), &
                       a => fit%card(1, :, b) + branch%group_p(g)*fit%card(2, :, b))
               fitted(own) = d*(a(1) + d*(a(2) + d*a(3)))
               if (branch%constant) fitted(own) = fitted(own) + sum(tau - fitted(own))/size(own)
               call put_block(out, plots, trim(branch_words(b))//', p = '//real_text(branch%group_p(g)), [b, g], d, tau, d, &
                              fitted(own))
            end associate
         end do
      end associate
   end subroutine put_shear

   !> Add a block of points X, Y with the fit FITTED_X, FITTED_Y at each point, in a LOOK of shape and colour. Consecutive blocks of one
   !! TITLE share an entry of the key.
   subroutine put_block(out, plots, title, look, x, y, fitted_x, fitted_y)
      type(output_file_type), intent(inout)    :: out
      character(:), allocatable, intent(inout) :: plots !! arguments of the plot command so far
      character(*), intent(in) :: title
      integer, intent(in)      :: look(2)
      real(wp), intent(in)     :: x(:), y(:), fitted_x(:), fitted_y(:)
      character(:), allocatable :: block, colour, name
      integer :: i

      i = 1
      block = '$data_1'
      do while (index(plots, block//' ') > 0)
         i = i + 1
         block = '$data_'//integer_text(i)
      end do
      call out%put(block//' << EOD')
      do i = 1, size(x)
         call out%put(real_text(x(i))//' '//real_text(y(i))//' '//real_text(fitted_x(i))//' '//real_text(fitted_y(i)))
      end do
      call out%put('EOD')
      name = ' title '//quoted(title)
      if (index(plots, name) > 0) name = ' notitle'
      colour = ' lc '//integer_text(look(2))
      plots = plots//', '//block//' using 1:2 with points pt '//integer_text(2*look(1) + 3)//colour//name//', '//block// &
              ' using 3:4 with lines lw 2 dt '//integer_text(look(1))//colour//' notitle'
   end subroutine put_block

   !> TEXT quoted for gnuplot.
   pure function quoted(text) result(words)
      character(*), intent(in)  :: text
      character(:), allocatable :: words
      integer :: k

      words = ''''
      do k = 1, len_trim(text)
         words = words//text(k:k)
         if (text(k:k) == '''') words = words//''''
      end do
      words = words//''''
   end function quoted

end module fit_output
