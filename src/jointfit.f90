!> jointfit: the cards of a joint's laws, JNORM and JSHEAR, fitted to test data.
program jointfit
   use c_library, only: end_run
   use deck_errors, only: deck_error_list
   use fit_command, only: fit_command_type, read_fit_command
   use fit_comments, only: write_cards
   use fit_data, only: read_test_data, test_data_type
   use fit_output, only: begin_output, end_fit, report_data_errors, report_fit, report_unreadable_data, write_plot
   use law_cards, only: check_slopes
   use machine, only: use_threads
   use output_file, only: output_file_type
   use surface_fit, only: fit_surface, surface_fit_type
   use test_branches, only: find_branches
   implicit none
   type(fit_command_type) :: command
   type(output_file_type) :: out, plot
   integer :: i, status

   call read_fit_command(command, status)
   if (status >= 0) call end_run(status)
   call use_threads(1)
   call begin_output(command, out, plot)
   do i = 1, size(command%files)
      call fit_file(i)
   end do
   call end_fit(command, out, plot)

contains

   subroutine fit_file(i)
      integer, intent(in) :: i
      type(test_data_type)   :: data
      type(surface_fit_type) :: fit
      type(deck_error_list)  :: errors
      logical :: readable

      ! ------------------------------------------------------------------ READ THE TEST DATA
      call read_test_data(command%files(i)%path, command%files(i)%name, command%reading, data, errors, readable)
      if (.not. readable) then
         call report_unreadable_data(command%files(i))
         return
      end if

      ! ------------------------------------------------------------------ WHICH BRANCH IS WHICH?
      call find_branches(data, command, errors)

      ! ------------------------------------------------------------------ LEAST SQUARES
      if (.not. errors%any()) call fit_surface(data, command, fit, errors)
      if (errors%any()) then
         call report_data_errors(data%text, errors)
         return
      end if

      ! ------------------------------------------------------------------ POSITIVE SLOPE?
      call check_slopes(fit)

      ! ------------------------------------------------------------------ CARDS
      call write_cards(command%files(i)%name, data, command, command%id + (i - 1), fit, out)
      if (command%plot /= '') call write_plot(command, i, data, fit, plot)
      call report_fit(command%files(i), fit)
   end subroutine fit_file

end program jointfit
