!> Reports a numerical failure: that the structure cannot be solved, and why.
module failures
   implicit none
   private

   type, public :: failure_type
      logical :: raised = .false.
      character(:), allocatable :: message
   contains
      procedure :: raise
   end type failure_type

contains

   !> Report the failure; the first message counts.
   subroutine raise(self, message)
      class(failure_type), intent(inout) :: self
      character(*), intent(in)           :: message

      if (self%raised) return
      self%raised = .true.
      self%message = message
   end subroutine raise

end module failures
