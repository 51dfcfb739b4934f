!> jointfit: the cards of a joint's laws, JNORM, JSHEAR and JIWAN, fitted to test data, or to what was measured on a structure.
program jointfit
   use c_library, only: end_run, tell_failed_writes
   use data_columns, only: branch_words, data_loss, data_normal, fit_reload, fit_unload
   use deck_errors, only: deck_error_list
   use error_report, only: print_errors
   use fit_command, only: fit_command_type, read_fit_command
   use fit_data, only: read_test_data, test_data_type
   use fit_plot, only: write_plot
   use incomplete_results, only: all_complete, watch_ends, what_is_in_the_way
   use identification, only: identify
   use, intrinsic :: iso_fortran_env, only: error_unit
   use law_cards, only: write_cards
   use machine, only: use_threads
   use output_file, only: output_file_type
   use reading_corrections, only: take_off_seat, take_off_specimens
   use surface_fit, only: check_slopes, fit_surface, surface_fit_type
   use terminal, only: complain_of_input
   use test_branches, only: find_branches
   implicit none
   integer, parameter :: status_unreadable = 1, status_data = 2, status_unwritten = 4
   type(fit_command_type) :: command
   type(output_file_type) :: out, plot
   integer :: i, exit_status ! the highest of all files
   logical :: ok

   call read_fit_command(command, exit_status)
   if (exit_status >= 0) call end_run(exit_status)
   exit_status = 0
   if (command%structure%path == '') call use_threads(1)
   call tell_failed_writes()
   call watch_ends()
   call out%start('')
   if (command%plot /= '') call plot%start(command%plot)
   if (command%structure%path /= '') call identify(command, out, plot, exit_status)
   do i = 1, size(command%files)
      call fit_file(i)
   end do
   if (command%plot /= '') then
      call plot%finish(ok)
      if (what_is_in_the_way() /= '') then
         write (error_unit, '(2a)') 'jointfit: ', what_is_in_the_way()
      else if (.not. ok) then
         write (error_unit, '(3a)') 'jointfit: ', command%plot, ' cannot be written'
      end if
      call all_complete()
      if (.not. ok) exit_status = max(exit_status, status_unwritten)
   end if
   call out%finish(ok)
   if (.not. ok) write (error_unit, '(a)') 'jointfit: the cards cannot be written to the standard output'
   if (.not. ok) exit_status = max(exit_status, status_unwritten)
   call end_run(exit_status)

contains

   subroutine fit_file(i)
      integer, intent(in) :: i
      type(test_data_type)   :: data
      type(surface_fit_type) :: fit
      type(deck_error_list)  :: errors
      logical :: readable
      integer :: k

      associate (file => command%files(i))
         ! --------------------------------------------------------------- READ THE TEST DATA
         call read_test_data(file%path, file%name, command%reading, data, errors, readable)
         if (.not. readable) then
            exit_status = max(exit_status, status_unreadable)
            call complain_of_input(file, 'a file of test data')
            return
         end if

         ! --------------------------------------------------------------- COMPRESSION OF THE SPECIMENS
         call take_off_specimens(data, command, errors)

         ! --------------------------------------------------------------- WHICH BRANCH IS WHICH?
         call find_branches(data, command, errors)

         ! --------------------------------------------------------------- ZEROED UNDER LOAD?
         call take_off_seat(data, command, errors)

         ! --------------------------------------------------------------- LEAST SQUARES
         if (.not. errors%any()) call fit_surface(data, command, fit, errors)
         if (errors%any()) then
            exit_status = max(exit_status, status_data)
            call print_errors(error_unit, 'DATA', 'no card written', data%text, errors)
            return
         end if

         ! --------------------------------------------------------------- POSITIVE SLOPE?
         call check_slopes(fit)

         ! --------------------------------------------------------------- CARDS
         call write_cards(command, i, data, fit, out)
         if (command%plot /= '') call write_plot(command, i, data, fit, plot)

         ! --------------------------------------------------------------- WARNINGS
         do k = 1, fit%warnings%n
            write (error_unit, '(3a)') file%name, ': WARNING: ', fit%warnings%items(k)%message
         end do
         if (any(fit%kind == [data_normal, data_loss]) .or. fit%has_loading) return
         exit_status = max(exit_status, status_data)
         k = merge(fit_reload, fit_unload, fit%branch(fit_reload)%n_points > 0)
         write (error_unit, '(5a)') file%name, ': no LOAD data, and a JSHEAR card needs the loading coefficients: those of the'// &
            ' other branches are written as comments; --branch ', trim(branch_words(k)), ' --as LOAD makes a card of ', &
            trim(branch_words(k))//' data'
      end associate
   end subroutine fit_file

end program jointfit
