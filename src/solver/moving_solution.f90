!> Solutions on the fronts that move: by the factor of the stiffness as it is now, or, where one solution is all that is wanted
!! and it is cheaper, by an earlier factor and conjugate gradients.
module moving_solution
   use conjugate_gradients, only: iterate_moving
   use earlier_solutions, only: earlier_solutions_type, forget_solutions, guess_solution, note_solution
   use factor_reuse, only: factor_reuse_type, forget_factor, may_reuse, note_factor, note_failure, note_steps
   use front_factor, only: factorise_moving
   use front_solve, only: solve_moving
   use front_tree, only: front_tree_type
   use kinds, only: wp
   implicit none
   private

   public :: form_moving, solve_with_joints, forget_moving

   real(wp), parameter :: step_tolerance = 1.0e-13_wp !! of conjugate gradients: share of the energy of the solution, as a length

   !> What is known of the stiffness now, beside the factor in the fronts.
   type, public :: moving_factor_type
      logical :: is_own = .false.                     !! whether the factor is that of the stiffness now, not an earlier one
      logical :: is_awaited = .false.                 !! whether the one solution that is wanted is still to come
      real(wp), allocatable :: k_int(:, :, :)         !! (3, 3, n) of interface elements, that the factor is of [force/length]
      type(factor_reuse_type) :: reuse                !! when to use an earlier one
      type(earlier_solutions_type) :: earlier         !! with which conjugate gradients begin
   end type moving_factor_type

contains

   !> The stiffness is that of the bodies and K_INT now; factorise it, unless ONE_SOLUTION is wanted and an earlier factor may do.
   !! FAULT as in front_factor.
   subroutine form_moving(tree, k_int, one_solution, factor, fault)
      type(front_tree_type), intent(inout)    :: tree
      real(wp), intent(in)                    :: k_int(:, :, :) !! (3, 3, n) of interface elements, global axes [force/length]
      logical, intent(in)                     :: one_solution
      type(moving_factor_type), intent(inout) :: factor
      integer, intent(out)                    :: fault
      logical :: reuse

      fault = 0
      reuse = .false.
      if (one_solution) call may_reuse(factor%reuse, reuse)
      factor%is_awaited = one_solution .and. factor%reuse%most_steps > 0
      factor%is_own = .false.
      if (.not. reuse) call factorise(tree, k_int, factor, fault)
   end subroutine form_moving


   subroutine factorise(tree, k_int, factor, fault)
      type(front_tree_type), intent(inout)    :: tree
      real(wp), intent(in)                    :: k_int(:, :, :)
      type(moving_factor_type), intent(inout) :: factor
      integer, intent(out)                    :: fault

      call factorise_moving(tree, k_int, fault)
      factor%is_own = fault == 0
      if (factor%is_own) then
         factor%k_int = k_int
         call note_factor(factor%reuse)
      else
         call forget_factor(factor%reuse)
      end if
   end subroutine factorise


   !> X, the load on entry, becomes the solution on the equations that move, with K_INT of form_moving; zero where LOCKED. Where
   !! conjugate gradients do not get there, only now the stiffness is factorised: FAULT as there.
   subroutine solve_with_joints(tree, locked, k_int, factor, x, fault)
      type(front_tree_type), intent(inout)    :: tree
      integer, intent(in)                     :: locked(:)
      real(wp), intent(in)                    :: k_int(:, :, :) !! (3, 3, n) [force/length]
      type(moving_factor_type), intent(inout) :: factor
      real(wp), intent(inout)                 :: x(:)           !! (tree%n) [force], [length]; not touched elsewhere
      integer, intent(out)                    :: fault
      real(wp) :: b(size(tree%equations))
      logical  :: found

      fault = 0
      b = x(tree%equations)
      found = .false.
      if (.not. factor%is_own) then
         call iterate(tree, k_int, b, factor, x, found)
         if (.not. found) call factorise(tree, k_int, factor, fault)
         if (fault /= 0) return
      end if
      if (.not. found) then
         x(tree%equations) = b
         x(locked) = 0.0_wp
         call solve_moving(tree, x)
      end if
      if (factor%is_awaited) call note_solution(tree, k_int, b, x, factor%earlier)
      factor%is_awaited = .false.
   end subroutine solve_with_joints


   !> Conjugate gradients with the factor there is; whether the solution is FOUND in time.
   subroutine iterate(tree, k_int, b, factor, x, found)
      type(front_tree_type), intent(in)       :: tree
      real(wp), intent(in)                    :: k_int(:, :, :), b(:)
      type(moving_factor_type), intent(inout) :: factor
      real(wp), intent(inout)                 :: x(:)
      logical, intent(out)                    :: found
      real(wp), allocatable :: residual(:)
      real(wp) :: work
      integer  :: steps

      allocate (residual(tree%n))
      call guess_solution(tree, k_int, factor%earlier, b, x, residual, work)
      call iterate_moving(tree, k_int - factor%k_int, work, step_tolerance, factor%reuse%most_steps, residual, x, steps)
      found = steps <= factor%reuse%most_steps
      if (found) then
         call note_steps(factor%reuse, steps)
      else
         call note_failure(factor%reuse)
      end if
   end subroutine iterate


   !> The bodies, or what is held, are others now: neither the factor nor solutions are of use any more.
   subroutine forget_moving(factor)
      type(moving_factor_type), intent(inout) :: factor

      call forget_factor(factor%reuse)
      call forget_solutions(factor%earlier)
   end subroutine forget_moving

end module moving_solution
