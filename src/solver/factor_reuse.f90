!> Reuse of an earlier factor as preconditioner of conjugate gradients in an increment. Reuse pays where the joints have changed
!! little and a few steps cost less than a factorisation. The module decides on reuse by costs counted in steps, computes the
!! first guess, which is the combination of earlier solutions of least energy, and does the steps.
!! Sources: Hestenes, Stiefel, J. Res. NBS 49 (1952) 409-436, preconditioned as in Golub, Van Loan, Matrix Computations, 11.5;
!! Fischer, Comput. Methods Appl. Mech. Engrg. 163 (1998) 193-204 (the first guess).
module factor_reuse
   use front_solve, only: refactored_times_vector, solve_refactored
   use front_tree, only: front_tree_type
   use interface_equations, only: add_products
   use kinds, only: wp
   use tolerances, only: dependent_energy
   implicit none
   private

   public :: may_reuse, note_factor, note_steps, note_failure, note_solution, guess_solution, find_least_energy, &
             iterate_refactored, price_in_steps

   real(wp), parameter :: step_operations = 75.0_wp !! operations of a step per entry of the refactored fronts
   integer, parameter  :: first_wait = 4            !! solutions without a trial after steps have failed
   integer, parameter  :: fewest_steps = 8          !! a factorisation that costs less than these steps is not avoided
   integer, parameter  :: few = 3                   !! steps after which the total number can be predicted
   integer, parameter  :: most_kept = 5             !! earlier solutions

   type, public :: factor_reuse_type
      integer :: most_steps = 0                     !! steps that cost as much as a factorisation; 0: never worth while
      logical :: has_factor = .false.               !! a useful factor exists
      integer, private :: spent = 0, solved = 0     ! since the last factorisation, which is included
      integer, private :: last = 0                  ! steps of the last solution
      integer, private :: pause = 0, wait = first_wait ! solutions to pass without a trial after steps have failed
   end type factor_reuse_type

   type, public :: earlier_solutions_type
      integer :: n = 0                              !! number kept, the latest first
      real(wp), allocatable, private :: u(:, :)     ! (refactored unknowns, most_kept)
      real(wp), allocatable, private :: f(:, :)     ! [k_b] u
   end type earlier_solutions_type

contains

   !> Number of steps, each through all ENTRIES, that cost as much as a factorisation of OPERATIONS; 0: a factorisation is
   !! always cheaper.
   pure integer function price_in_steps(operations, entries) result(price)
      real(wp), intent(in) :: operations, entries

      price = int(min(1.0e3_wp, operations/(step_operations*max(1.0_wp, entries))))
      if (price < fewest_steps) price = 0
   end function price_in_steps

   !> Whether to keep the factor: until a solution takes more steps than the average cost per solution since the factorisation.
   subroutine may_reuse(self, yes)
      class(factor_reuse_type), intent(inout) :: self
      logical, intent(out)                    :: yes

      yes = self%has_factor .and. self%most_steps > 0 .and. self%pause == 0 .and. self%last*self%solved <= self%spent
      self%pause = max(0, self%pause - 1)
   end subroutine may_reuse

   !> Record a new factor.
   subroutine note_factor(self)
      class(factor_reuse_type), intent(inout) :: self

      self%has_factor = .true.
      self%spent = self%most_steps
      self%solved = 1
      self%last = 0
   end subroutine note_factor

   !> Record the STEPS of a solution with the old factor.
   subroutine note_steps(self, steps)
      class(factor_reuse_type), intent(inout) :: self
      integer, intent(in)                     :: steps

      self%spent = self%spent + steps
      self%solved = self%solved + 1
      self%last = steps
      self%wait = first_wait
   end subroutine note_steps

   !> Record steps that failed: pause the trials, longer each time.
   subroutine note_failure(self)
      class(factor_reuse_type), intent(inout) :: self

      self%pause = self%wait
      self%wait = min(64, 2*self%wait)
   end subroutine note_failure

   !> Record that X solves ([k_b] + sum of [k_int]) x = b on the refactored equations.
   subroutine note_solution(tree, k_int, b, x, earlier)
      type(front_tree_type), intent(in)           :: tree
      real(wp), intent(in)                        :: k_int(:, :, :) !! (3, 3, n) of interface elements [force/length]
      real(wp), intent(in)                        :: b(:)           !! of the refactored equations [force]
      real(wp), intent(in)                        :: x(:)           !! (tree%n) [length]
      type(earlier_solutions_type), intent(inout) :: earlier
      real(wp), allocatable :: of_joints(:)

      if (.not. allocated(earlier%u)) &
         allocate (earlier%u(size(tree%equations), most_kept), earlier%f(size(tree%equations), most_kept))
      earlier%n = min(most_kept, earlier%n + 1)
      earlier%u(:, 2:earlier%n) = earlier%u(:, :earlier%n - 1)
      earlier%f(:, 2:earlier%n) = earlier%f(:, :earlier%n - 1)
      allocate (of_joints(tree%n))
      of_joints(tree%equations) = 0.0_wp
      call add_products(tree%joints, k_int, x, of_joints)
      earlier%u(:, 1) = x(tree%equations)
      earlier%f(:, 1) = b - of_joints(tree%equations)
   end subroutine note_solution

   !> X on the refactored equations: the combination of earlier solutions with the least energy x'([k_b] + sum of [k_int]) x/2 -
   !! b'x; zero where there is no earlier solution. Other entries are not changed. RESIDUAL = b - ([k_b] + sum of [k_int]) x,
   !! and WORK = x'([k_b] + sum of [k_int]) x.
   subroutine guess_solution(tree, k_int, earlier, b, x, residual, work)
      type(front_tree_type), intent(in)        :: tree
      real(wp), intent(in)                     :: k_int(:, :, :) !! (3, 3, n) [force/length]
      type(earlier_solutions_type), intent(in) :: earlier
      real(wp), intent(in)                     :: b(:)           !! of the refactored equations [force]
      real(wp), intent(inout)                  :: x(:)           !! (tree%n) [length]
      real(wp), intent(inout)                  :: residual(:)    !! (tree%n) [force]
      real(wp), intent(out)                    :: work           !! [force*length]
      real(wp) :: energy(earlier%n, earlier%n), share(earlier%n)
      real(wp), allocatable :: f(:)
      integer :: j

      x(tree%equations) = 0.0_wp
      residual(tree%equations) = b
      work = 0.0_wp
      if (earlier%n == 0) return
      allocate (f(tree%n))
      associate (e => tree%equations, u => earlier%u(:, :earlier%n))
         do j = 1, earlier%n
            x(e) = u(:, j)
            f(e) = earlier%f(:, j)
            call add_products(tree%joints, k_int, x, f)
            energy(:, j) = matmul(f(e), u)
         end do
         call find_least_energy(energy, matmul(b, u), share)
         x(e) = matmul(u, share)
         call refactored_times_vector(tree, x, f)
         call add_products(tree%joints, k_int, x, f)
         residual(e) = b - f(e)
         work = dot_product(x(e), f(e))
      end associate
   end subroutine guess_solution

   !> The combination of directions nearest to a solution in the energy norm: SHARE c that minimises c'ENERGY c/2 - WORK'c. The
   !! directions are orthogonalised in energy one after another. A direction that adds nothing new is left out.
   pure subroutine find_least_energy(energy, work, share)
      real(wp), intent(in)  :: energy(:, :) !! (n, n) symmetric, positive semidefinite [force*length]
      real(wp), intent(in)  :: work(:)      !! (n) [force*length]
      real(wp), intent(out) :: share(:)     !! (n) [-]
      real(wp) :: direction(size(work), size(work)), left
      integer  :: i, j, n, pass

      share = 0.0_wp
      n = 0
      do j = 1, size(work)
         n = n + 1
         direction(:, n) = 0.0_wp
         direction(j, n) = 1.0_wp
         do pass = 1, 2                               ! the second pass removes rounding errors
            do i = 1, n - 1
               direction(:, n) = direction(:, n) - dot_product(direction(:, i), matmul(energy, direction(:, n)))*direction(:, i)
            end do
         end do
         left = dot_product(direction(:, n), matmul(energy, direction(:, n)))
         if (.not. left > dependent_energy*energy(j, j)) then
            n = n - 1
            cycle
         end if
         direction(:, n) = direction(:, n)/sqrt(left)
         share = share + dot_product(direction(:, n), work)*direction(:, n)
      end do
   end subroutine find_least_energy

   !> Solve ([k] + sum of CHANGE) d = r on the refactored equations, [k] being the factorised matrix of the tree, and add d to
   !! X. The recurrence carries z with r = [k] z and the product p = [k] d, so that a step multiplies by no matrix other than
   !! CHANGE. STEPS is the number of steps; above MOST_STEPS the iteration has failed and X is useless. The iteration has
   !! converged where the energy left is at most TOLERANCE**2 times the energy of X on entry, ENERGY, plus that of d.
   subroutine iterate_refactored(tree, change, energy, tolerance, most_steps, r, x, steps)
      type(front_tree_type), intent(in) :: tree
      real(wp), intent(in)              :: change(:, :, :) !! (3, 3, n) of interface elements since [k] [force/length]
      real(wp), intent(in)              :: energy          !! [force*length], twice the work
      real(wp), intent(in)              :: tolerance
      integer, intent(in)               :: most_steps
      real(wp), intent(inout)           :: r(:)            !! (n) [force], the residual on return
      real(wp), intent(inout)           :: x(:)            !! (n) [length], other entries not changed
      integer, intent(out)              :: steps
      real(wp), allocatable :: z(:), direction(:), of_factor(:), product(:)
      real(wp) :: alpha, before, enough, now, start

      allocate (z(tree%n), direction(tree%n), of_factor(tree%n), product(tree%n))
      associate (e => tree%equations)
         z(e) = r(e)                ! entries at locked equations meet zeros: solve_refactored leaves zero there
         call solve_refactored(tree, z)
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
            call solve_refactored(tree, z)
            before = now
            now = dot_product(r(e), z(e))
            if (now <= enough) return
            if (steps >= few .and. log(start/enough)*steps > log(start/now)*most_steps) exit ! the prediction exceeds the limit
            direction(e) = z(e) + now/before*direction(e)
            of_factor(e) = r(e) + now/before*of_factor(e)
         end do
         steps = most_steps + 1
      end associate
   end subroutine iterate_refactored

end module factor_reuse
