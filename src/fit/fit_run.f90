!> The run of jointfit: what is said on the standard error, and the exit status.
module fit_run
   use c_library, only: end_run, tell_failed_writes
   use command_arguments, only: complain_of_input, input_argument
   use data_columns, only: branch_words, data_normal, fit_reload, fit_unload
   use deck_errors, only: deck_error_list
   use deck_text, only: deck_text_type
   use error_report, only: print_errors
   use fit_command, only: fit_command_type
   use incomplete_results, only: all_complete, watch_ends, what_is_in_the_way
   use, intrinsic :: iso_fortran_env, only: error_unit
   use output_file, only: output_file_type
   use surface_fit, only: surface_fit_type
   implicit none
   private

   public :: report_unreadable_data, report_data_errors, report_fit, begin_output, end_fit

   integer, parameter :: status_unreadable = 1, status_data = 2, status_unwritten = 4

   integer :: exit_status = 0 ! the highest so far

contains

   subroutine report_unreadable_data(file)
      type(input_argument), intent(in) :: file

      exit_status = max(exit_status, status_unreadable)
      call complain_of_input(file, 'a file of test data')
   end subroutine report_unreadable_data

   !> All errors of a data file.
   subroutine report_data_errors(text, errors)
      type(deck_text_type), intent(in)  :: text
      type(deck_error_list), intent(in) :: errors

      exit_status = max(exit_status, status_data)
      call print_errors(error_unit, 'DATA', 'no card written', text, errors)
   end subroutine report_data_errors

   !> The warnings of a fit, and that there is no card for want of loading data.
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

   !> Begin the outputs of the run: OUT for the cards and, where the command wants it, the PLOT.
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

end module fit_run
