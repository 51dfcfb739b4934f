!> Earlier solutions as a first guess: what of them, taken together, comes nearest to the next one in the energy of its own
!! matrix. Load steps follow a smooth path: where the joints stay closed, a few digits are known before anything is solved.
!! Source: Fischer, Comput. Methods Appl. Mech. Engrg. 163 (1998) 193-204.
module earlier_solutions
   use front_solve, only: moving_times_vector
   use front_tree, only: front_tree_type
   use interface_equations, only: add_products
   use kinds, only: wp
   implicit none
   private

   public :: note_solution, forget_solutions, guess_solution

   integer, parameter  :: most = 5                    !! that are kept
   real(wp), parameter :: dependent = 1.0e-12_wp      !! energy, as a share, below which nothing new is left of one

   type, public :: earlier_solutions_type
      private
      integer :: n = 0                                ! kept, the last one first
      real(wp), allocatable :: u(:, :)                ! (unknowns that move, most)
      real(wp), allocatable :: f(:, :)                ! [k_b] u
   end type earlier_solutions_type

contains

   !> X solves ([k_b] + sum of [k_int]) x = b on the equations that move.
   subroutine note_solution(tree, k_int, b, x, earlier)
      type(front_tree_type), intent(in)           :: tree
      real(wp), intent(in)                        :: k_int(:, :, :) !! (3, 3, n) of interface elements [force/length]
      real(wp), intent(in)                        :: b(:)           !! of the equations that move [force]
      real(wp), intent(in)                        :: x(:)           !! (tree%n) [length]
      type(earlier_solutions_type), intent(inout) :: earlier
      real(wp), allocatable :: of_joints(:)
      integer :: i

      if (.not. allocated(earlier%u)) allocate (earlier%u(size(tree%equations), most), earlier%f(size(tree%equations), most))
      earlier%n = min(most, earlier%n + 1)
      do i = earlier%n, 2, -1
         earlier%u(:, i) = earlier%u(:, i - 1)
         earlier%f(:, i) = earlier%f(:, i - 1)
      end do
      allocate (of_joints(tree%n))
      of_joints(tree%equations) = 0.0_wp
      call add_products(tree%joints, k_int, x, of_joints)
      earlier%u(:, 1) = x(tree%equations)
      earlier%f(:, 1) = b - of_joints(tree%equations)
   end subroutine note_solution

   !> [k_b], or what is held, is another one now.
   subroutine forget_solutions(earlier)
      type(earlier_solutions_type), intent(inout) :: earlier

      earlier%n = 0
   end subroutine forget_solutions

   !> X on the equations that move, not touched elsewhere: with it the energy x'([k_b] + sum of [k_int]) x/2 - b'x is least of all
   !! sums of earlier solutions; zero where there is none. They are made orthogonal in that energy, the last one first. With it
   !! comes RESIDUAL = b - ([k_b] + sum of [k_int]) x, and WORK = x'([k_b] + sum of [k_int]) x.
   subroutine guess_solution(tree, k_int, earlier, b, x, residual, work)
      type(front_tree_type), intent(in)        :: tree
      real(wp), intent(in)                     :: k_int(:, :, :) !! (3, 3, n) [force/length]
      type(earlier_solutions_type), intent(in) :: earlier
      real(wp), intent(in)                     :: b(:)           !! of the equations that move [force]
      real(wp), intent(inout)                  :: x(:)           !! (tree%n) [length]
      real(wp), intent(inout)                  :: residual(:)    !! (tree%n) [force]
      real(wp), intent(out)                    :: work           !! [force*length]
      real(wp) :: direction(size(tree%equations), most), force(size(tree%equations), most) ! what is new of each; the whole force
      real(wp) :: energy, whole, share
      real(wp), allocatable :: u(:), f(:)
      integer :: i, j, n

      allocate (u(tree%n), f(tree%n))
      x(tree%equations) = 0.0_wp
      n = 0
      do j = 1, earlier%n
         u(tree%equations) = earlier%u(:, j)
         f(tree%equations) = earlier%f(:, j)
         call add_products(tree%joints, k_int, u, f)
         n = n + 1
         direction(:, n) = u(tree%equations)
         force(:, n) = f(tree%equations)
         whole = dot_product(direction(:, n), force(:, n))
         do i = 1, n - 1
            share = dot_product(force(:, i), direction(:, n))
            direction(:, n) = direction(:, n) - share*direction(:, i) ! the force's share in later ones is none then
         end do
         energy = dot_product(direction(:, n), force(:, n))
         if (.not. energy > dependent*abs(whole)) then
            n = n - 1
            cycle
         end if
         direction(:, n) = direction(:, n)/sqrt(energy)
         force(:, n) = force(:, n)/sqrt(energy)
         x(tree%equations) = x(tree%equations) + dot_product(direction(:, n), b)*direction(:, n)
      end do
      residual(tree%equations) = b
      work = 0.0_wp
      if (n == 0) return
      call moving_times_vector(tree, x, f)
      call add_products(tree%joints, k_int, x, f)
      residual(tree%equations) = residual(tree%equations) - f(tree%equations)
      work = dot_product(x(tree%equations), f(tree%equations))
   end subroutine guess_solution

end module earlier_solutions
