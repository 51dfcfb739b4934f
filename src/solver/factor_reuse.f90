!> Whether an old factor may do as preconditioner of conjugate gradients, or a new one is cheaper: costs are counted, in steps.
module factor_reuse
   use kinds, only: wp
   implicit none
   private

   public :: may_reuse, note_factor, note_steps, note_failure, forget_factor, forget_steps

   real(wp), parameter :: step_operations = 75.0_wp !! that a step costs for every entry of the fronts that move
   integer, parameter  :: first_wait = 4            !! solutions that are not tried after steps were in vain
   integer, parameter  :: fewest_steps = 8          !! a factorisation that costs less is not worth the trouble

   type, public :: factor_reuse_type
      integer :: most_steps = 0                     !! that cost what a factorisation does; 0: it is always cheaper
      integer, private :: spent = 0, solved = 0     ! since the last factorisation, that included
      integer, private :: last = 0                  ! steps of the last solution
      integer, private :: pause = 0, wait = first_wait ! how often not to try after steps were in vain
      logical, private :: is_there = .false.        ! a factor
   contains
      procedure :: set_costs
   end type factor_reuse_type

contains

   !> A factorisation takes so many OPERATIONS, on so many ENTRIES.
   subroutine set_costs(self, operations, entries)
      class(factor_reuse_type), intent(inout) :: self
      real(wp), intent(in)                    :: operations, entries

      self%most_steps = int(min(1.0e3_wp, operations/(step_operations*max(1.0_wp, entries))))
      if (self%most_steps < fewest_steps) self%most_steps = 0
   end subroutine set_costs

   !> Whether to go on with the factor: until a solution takes more steps than have been spent on each since the factorisation.
   subroutine may_reuse(self, yes)
      class(factor_reuse_type), intent(inout) :: self
      logical, intent(out)                    :: yes

      yes = self%is_there .and. self%most_steps > 0 .and. self%pause == 0 .and. self%last*self%solved <= self%spent
      self%pause = max(0, self%pause - 1)
   end subroutine may_reuse

   !> There is a new factor.
   subroutine note_factor(self)
      class(factor_reuse_type), intent(inout) :: self

      self%is_there = .true.
      self%spent = self%most_steps
      self%solved = 1
      self%last = 0
   end subroutine note_factor

   !> A solution with the old factor took so many STEPS.
   subroutine note_steps(self, steps)
      class(factor_reuse_type), intent(inout) :: self
      integer, intent(in)                     :: steps

      self%spent = self%spent + steps
      self%solved = self%solved + 1
      self%last = steps
      self%wait = first_wait
   end subroutine note_steps

   !> The steps were in vain: do not try for a while, longer every time.
   subroutine note_failure(self)
      class(factor_reuse_type), intent(inout) :: self

      self%pause = self%wait
      self%wait = min(64, 2*self%wait)
   end subroutine note_failure

   !> The factor is of no use any more.
   subroutine forget_factor(self)
      class(factor_reuse_type), intent(inout) :: self

      self%is_there = .false.
   end subroutine forget_factor

   !> What there was of factors and steps so far is nothing to go by: all begins anew, but for the costs.
   subroutine forget_steps(self)
      class(factor_reuse_type), intent(inout) :: self

      self%spent = 0
      self%solved = 0
      self%last = 0
      self%pause = 0
      self%wait = first_wait
      self%is_there = .false.
   end subroutine forget_steps

end module factor_reuse
