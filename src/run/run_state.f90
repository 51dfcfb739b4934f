!> The run of one deck: what its boxes hand on to each other, and how it may end.
module run_state
   use command_line, only: deck_argument
   use deck_errors, only: deck_error_list
   use failures, only: failure_type
   use kinds, only: long
   use progress, only: progress_type
   use restart_stream, only: restart_stream_type
   use results, only: results_type
   implicit none
   private

   public :: is_over

   ! how a run ended that did not come to its last increment, and the exit status that this is
   integer, parameter, public :: goes_on = 0, is_unreadable = 1, would_overwrite = 2, has_errors = 3, was_checked = 4, &
                                 is_unsolved = 5, is_unwritten = 6, is_refused = 7
   integer, parameter, public :: status_of(0:7) = [0, 1, 1, 2, 0, 3, 4, 1]

   !> The run of one deck.
   type, public :: run_type
      type(failure_type) :: failure            !! the structure cannot be solved
      type(deck_argument) :: argument
      logical :: check_only = .false., is_dated = .false.
      type(deck_error_list) :: errors
      type(results_type) :: results
      type(progress_type) :: progress
      integer :: ending = goes_on
      logical :: keeps = .false.               !! it ended early, but what there was in equilibrium is a result
      integer(long) :: deck_sum = 0            !! the checksum of the deck
      type(restart_stream_type) :: restart     !! the restart file that is taken up, as long as there is any
      logical :: resumes = .false.             !! there is
      character(:), allocatable :: problem     !! why it cannot be taken up
      logical :: misses_restart = .false.      !! one could not be written
   end type run_type

contains

   !> Whether nothing more is to be done for this deck.
   pure logical function is_over(run)
      type(run_type), intent(in) :: run

      is_over = run%failure%raised .or. run%ending /= goes_on
   end function is_over

end module run_state
