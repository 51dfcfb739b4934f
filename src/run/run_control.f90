!> The run of one deck among several: what it is called, what its exit status is, what is said on the terminal.
module run_control
   use, intrinsic :: iso_fortran_env, only: error_unit
   use c_library, only: end_run, write_bytes
   use command_tools, only: why_unreadable
   use command_line, only: command_type, deck_argument, is_result_of
   use deck_errors, only: deck_error_list
   use deck_input, only: deck_type
   use error_report, only: print_errors
   use failures, only: failure_type
   use model_data, only: model_type, n_points
   use results, only: discard_results, results_type
   use stage_plan, only: stage_plan_type
   use text_tools, only: plural
   implicit none
   private

   public :: overwrites_input, report_unreadable, report_errors, report_failure, &
             report_overwritten, report_unwritten, report_checked, report_warnings, end_program

   integer, parameter :: status_unreadable = 1, status_deck = 2, status_unsolved = 3, status_unwritten = 4

   !> Highest exit status so far.
   integer, public, protected :: exit_status = 0

contains

   subroutine raise_status(status)
      integer, intent(in) :: status

      exit_status = max(exit_status, status)
   end subroutine raise_status


   !> The deck file cannot be read at all.
   subroutine report_unreadable(argument)
      type(deck_argument), intent(in) :: argument

      call raise_status(status_unreadable)
      write (error_unit, '(3a)') argument%name, ': ', why_unreadable(argument%path, 'a deck')
   end subroutine report_unreadable


   !> Whether a file that the deck includes is one that its results would be written to.
   logical function overwrites_input(argument, deck)
      type(deck_argument), intent(in) :: argument
      type(deck_type), intent(in)     :: deck
      integer :: i

      overwrites_input = .false.
      do i = 2, deck%text%n_files
         if (is_result_of(deck%text%files(i)%true_path, argument)) overwrites_input = .true.
      end do
   end function overwrites_input


   !> The files of which that is so.
   subroutine report_overwritten(argument, deck)
      type(deck_argument), intent(in) :: argument
      type(deck_type), intent(in)     :: deck
      integer :: i

      call raise_status(status_unreadable)
      do i = 2, deck%text%n_files
         if (is_result_of(deck%text%files(i)%true_path, argument)) write (error_unit, '(3a)') argument%name, &
            ': its results would overwrite the INCLUDE file ', deck%text%files(i)%path
      end do
   end subroutine report_overwritten


   !> The deck has errors: all of them.
   subroutine report_errors(deck, errors)
      type(deck_type), intent(in)       :: deck
      type(deck_error_list), intent(in) :: errors

      call raise_status(status_deck)
      call print_errors(error_unit, 'DECK', 'nothing solved', deck%text, errors)
   end subroutine report_errors


   !> The structure cannot be solved.
   subroutine report_failure(argument, failure, results)
      type(deck_argument), intent(in)   :: argument
      type(failure_type), intent(in)    :: failure
      type(results_type), intent(inout) :: results

      call raise_status(status_unsolved)
      write (error_unit, '(4a)') argument%name, ': ', failure%message, '; no results'
      call discard_results(results)
   end subroutine report_failure


   !> The results cannot be written.
   subroutine report_unwritten(argument, results)
      type(deck_argument), intent(in)   :: argument
      type(results_type), intent(inout) :: results

      call raise_status(status_unwritten)
      if (argument%listing == '') then
         write (error_unit, '(2a)') argument%name, ': the listing cannot be written to the standard output'
      else
         write (error_unit, '(5a)') argument%name, ': the results ', argument%listing, ' and ', argument%history// &
            ' cannot be written: is the folder there, and is there room on the disk?'
      end if
      call discard_results(results)
   end subroutine report_unwritten


   !> Warnings stand in the listing; say that there are some.
   subroutine report_warnings(argument, results)
      type(deck_argument), intent(in) :: argument
      type(results_type), intent(in)  :: results

      associate (n => results%listing%watch%n_warnings)
         if (n > 0) write (error_unit, '(4a)') argument%name, ': ', plural(n, 'warning'), ' in the listing'
      end associate
   end subroutine report_warnings


   !> --check: the deck is in order.
   subroutine report_checked(argument, model, plan)
      type(deck_argument), intent(in)   :: argument
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      logical :: ok

      call write_bytes(1, argument%name//': no errors; '//plural(n_points(model), 'node')//', '// &
                       plural(model%n_elements, 'body element')//', '//plural(size(model%interface), 'interface element')// &
                       ', '//plural(size(plan%stages), 'stage')//new_line('a'), ok)
      if (.not. ok) call raise_status(status_unwritten)
   end subroutine report_checked


   !> End with STATUS, or the highest of the decks where that is higher.
   subroutine end_program(status)
      integer, intent(in), optional :: status !! 0

      if (present(status)) call raise_status(status)
      call end_run(exit_status)
   end subroutine end_program

end module run_control
