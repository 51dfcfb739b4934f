!> Conjugate gradients on the equations that move, with the factor of an earlier increment as preconditioner: where the joints
!! have changed little since, a few steps cost less than a factorisation.
!! Source: Hestenes, Stiefel, J. Res. NBS 49 (1952) 409-436, preconditioned as in Golub, Van Loan, Matrix Computations, 11.5.
module conjugate_gradients
   use front_solve, only: moving_times_vector, solve_moving
   use front_tree, only: front_tree_type
   use kinds, only: wp
   implicit none
   private

   public :: iterate_moving

   integer, parameter :: few = 3   ! steps after which it can be told how many there will be

contains

   !> Solve ([k_b] + sum of [k_int]) x = b on the equations that move. STEPS is how many it took, more than MOST_STEPS where that
   !! was not enough: X is of no use then. TOLERANCE is a share of the energy of the solution, as a length.
   subroutine iterate_moving(tree, equations, k_int, tolerance, most_steps, x, steps)
      type(front_tree_type), intent(in) :: tree
      integer, intent(in)               :: equations(:)   !! those that move
      real(wp), intent(in)              :: k_int(:, :, :) !! (6, 6, n) of interface elements
      real(wp), intent(in)              :: tolerance
      integer, intent(in)               :: most_steps
      real(wp), intent(inout)           :: x(:)           !! (n) b on entry, the solution on return; untouched elsewhere
      integer, intent(out)              :: steps
      real(wp), allocatable :: residual(:), z(:), direction(:), product(:), u(:)
      real(wp) :: alpha, before, first, now

      allocate (residual(tree%n), z(tree%n), direction(tree%n), product(tree%n), u(tree%n))
      associate (e => equations)
         residual(e) = x(e)                ! what stands at locked equations meets zeros: solve_moving leaves none else there
         u(e) = 0.0_wp
         z(e) = residual(e)
         call solve_moving(tree, z)
         direction(e) = z(e)
         now = dot_product(residual(e), z(e))
         first = now
         do steps = 1, most_steps
            call moving_times_vector(tree, direction, product)
            call add_joints(tree, k_int, direction, product)
            alpha = dot_product(direction(e), product(e))
            if (.not. alpha > 0.0_wp) exit
            alpha = now/alpha
            u(e) = u(e) + alpha*direction(e)
            residual(e) = residual(e) - alpha*product(e)
            z(e) = residual(e)
            call solve_moving(tree, z)
            before = now
            now = dot_product(residual(e), z(e))
            if (now <= tolerance**2*first) then
               x(e) = u(e)
               return
            end if
            if (steps >= few .and. log(now/first)*most_steps > 2.0_wp*log(tolerance)*steps) exit ! that will take too long
            direction(e) = z(e) + now/before*direction(e)
         end do
         steps = most_steps + 1
         if (first <= 0.0_wp) then ! no load
            x(e) = 0.0_wp
            steps = 0
         end if
      end associate
   end subroutine iterate_moving


   !> Y = Y + sum of [k_int] X.
   pure subroutine add_joints(tree, k_int, x, y)
      type(front_tree_type), intent(in) :: tree
      real(wp), intent(in)              :: k_int(:, :, :)
      real(wp), intent(in)              :: x(:)
      real(wp), intent(inout)           :: y(:)
      real(wp) :: u(6), f(6)
      integer  :: i, j

      do i = 1, size(k_int, 3)
         u = 0.0_wp
         do j = 1, 6
            if (tree%joint_equations(j, i) > 0) u(j) = x(tree%joint_equations(j, i))
         end do
         f = matmul(k_int(:, :, i), u)
         do j = 1, 6
            if (tree%joint_equations(j, i) > 0) y(tree%joint_equations(j, i)) = y(tree%joint_equations(j, i)) + f(j)
         end do
      end do
   end subroutine add_joints

end module conjugate_gradients
