!> Conjugate gradients on the equations that move, with the factor of an earlier increment as preconditioner: where the joints
!! have changed little since, a few steps cost less than a factorisation.
!! Source: Hestenes, Stiefel, J. Res. NBS 49 (1952) 409-436, preconditioned as in Golub, Van Loan, Matrix Computations, 11.5.
module conjugate_gradients
   use front_solve, only: solve_moving
   use front_tree, only: front_tree_type
   use interface_equations, only: add_products
   use kinds, only: wp
   implicit none
   private

   public :: iterate_moving

   integer, parameter :: few = 3   ! steps after which it can be told how many there will be

contains

   !> Solve ([k] + sum of CHANGE) d = r on the equations that move, [k] what the tree has the factor of, and add d to X. Beside
   !! r = [k] z, the product p = [k] d goes along with the direction d: no step multiplies by a matrix other than CHANGE. STEPS
   !! is how many it took, more than MOST_STEPS where that was not enough: X is of no use then. Enough is where d leaves of the
   !! ENERGY, of what X had, and of d, no more than the square of TOLERANCE, a share of a length.
   subroutine iterate_moving(tree, change, energy, tolerance, most_steps, r, x, steps)
      type(front_tree_type), intent(in) :: tree
      real(wp), intent(in)              :: change(:, :, :) !! (3, 3, n) of interface elements since [k] [force/length]
      real(wp), intent(in)              :: energy          !! [force*length], twice the work
      real(wp), intent(in)              :: tolerance
      integer, intent(in)               :: most_steps
      real(wp), intent(inout)           :: r(:)            !! (n) [force], what is left of it on return
      real(wp), intent(inout)           :: x(:)            !! (n) [length], not touched elsewhere
      integer, intent(out)              :: steps
      real(wp), allocatable :: z(:), direction(:), of_factor(:), product(:)
      real(wp) :: alpha, before, enough, now, start

      allocate (z(tree%n), direction(tree%n), of_factor(tree%n), product(tree%n))
      associate (e => tree%equations)
         z(e) = r(e)                ! what stands at locked equations meets zeros: solve_moving leaves none else there
         call solve_moving(tree, z)
         now = dot_product(r(e), z(e))
         start = now
         enough = tolerance**2*(energy + start)
         steps = 0
         if (now <= enough) return
         direction(e) = z(e)
         of_factor(e) = r(e)
         do steps = 1, most_steps
            product(e) = of_factor(e)
            call add_products(tree%joints, change, direction, product)
            alpha = dot_product(direction(e), product(e))
            if (.not. alpha > 0.0_wp) exit
            alpha = now/alpha
            x(e) = x(e) + alpha*direction(e)
            r(e) = r(e) - alpha*product(e)
            z(e) = r(e)
            call solve_moving(tree, z)
            before = now
            now = dot_product(r(e), z(e))
            if (now <= enough) return
            if (steps >= few .and. log(start/enough)*steps > log(start/now)*most_steps) exit ! that will take too long
            direction(e) = z(e) + now/before*direction(e)
            of_factor(e) = r(e) + now/before*of_factor(e)
         end do
         steps = most_steps + 1
      end associate
   end subroutine iterate_moving

end module conjugate_gradients
