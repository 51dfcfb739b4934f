!> How many digits the equations of the structure cost: an estimate of their condition, of the matrix [k] that the factor there is
!! is of. It is that of [d] [k] [d], d_i = k_ii^(-1/2): one that does not depend on units, that of a rotation beside a displacement
!! included, nor on a soft part that hangs on a stiff one, which costs nothing. A stiff part that hangs on a soft one does: of what
!! holds it only the difference of large numbers is known.
!! Source: Higham, ACM Trans. Math. Softw. 14 (1988) 381-396, DLACN2 of LAPACK; scaling: van der Sluis, Numer. Math. 14 (1969)
!! 14-23.
module condition_estimate
   use blas_lapack, only: dlacn2
   use equation_solver, only: equation_system
   use kinds, only: wp
   implicit none
   private

   public :: estimate_condition, first_large, watch_condition

   real(wp), parameter, public :: poor_condition = 1.0e12_wp !! above it a run says so
   real(wp), parameter :: spread = 300.0_wp ! see watch_condition
   real(wp), parameter :: near = 0.9283_wp ! of the largest: of a body that moves as a whole it is not rounding that chooses the node

   !> An estimate of the condition.
   type, public :: condition_type
      real(wp) :: number = 0.0_wp          !! norm([d] [k] [d]) norm(([d] [k] [d])^-1), the norms largest column sums [-]
      integer  :: node = 0, direction = 0  !! of the largest component of the displacement that [k] resists least
      real(wp) :: weakest = 1.0_wp         !! pivot that has been looked at, as equation_system has it
      logical  :: is_new = .false.         !! it is poor, and has not been told
   end type condition_type

contains

   !> Look at the factor that SYSTEM has, where its weakest pivot makes that worth while. 1/pivot is an entry of the diagonal of
   !! the inverse of a part of [d] [k] [d], and the largest column sum is at most n times the largest entry: with n equations the
   !! condition of structures has been found between 1E-4 and 41 n/pivot, of slender beams, bodies on soft bars and all decks.
   !! Looked at is what is ten times worse than what has been looked at before: an estimate costs some ten solutions.
   subroutine watch_condition(system, condition)
      class(equation_system), intent(in)  :: system
      type(condition_type), intent(inout) :: condition

      condition%is_new = .false.
      if (system%weakest*poor_condition > spread*system%n) return
      if (system%weakest > 0.1_wp*condition%weakest) return
      call estimate_condition(system, condition)
      condition%is_new = condition%number > poor_condition
   end subroutine watch_condition

   !> The condition of the matrix that the factor of SYSTEM is of, by some five solutions and as many products.
   subroutine estimate_condition(system, condition)
      class(equation_system), intent(in)  :: system
      type(condition_type), intent(inout) :: condition
      real(wp), allocatable :: scale(:), v(:)
      real(wp) :: of_inverse, of_matrix

      allocate (scale, source=sqrt(system%diagonal_of_factor()))
      allocate (v(system%n))
      call estimate_norm(.false., of_matrix)
      call estimate_norm(.true., of_inverse)
      condition%number = of_matrix*of_inverse
      condition%weakest = system%weakest
      v = abs(v)
      v(system%locked) = 0.0_wp
      call first_large(system, v, condition%node, condition%direction)

   contains

      !> The largest column sum of the scaled matrix, or of its inverse; V is the product that has it.
      subroutine estimate_norm(inverse, norm)
         logical, intent(in)   :: inverse
         real(wp), intent(out) :: norm
         real(wp) :: x(system%n)
         integer  :: signs(system%n), kase, state(3)

         kase = 0
         norm = 0.0_wp
         do
            call dlacn2(system%n, v, x, signs, norm, kase, state)
            if (kase == 0) exit
            if (inverse) then
               x = scale*x
               call system%solve_by_factor(x)
               x = scale*x
            else
               x = x/scale
               call system%multiply_by_factor(x)
               x = x/scale
            end if
         end do
      end subroutine estimate_norm

   end subroutine estimate_condition

   !> The first node, in the order of the model, and DIRECTION where V is as good as largest.
   pure subroutine first_large(system, v, node, direction)
      class(equation_system), intent(in) :: system
      real(wp), intent(in)               :: v(:) !! (n) >= 0
      integer, intent(out)               :: node, direction
      integer  :: k
      real(wp) :: much

      much = near*maxval(v)
      do node = 1, size(system%number, 2)
         do direction = 1, size(system%number, 1)
            k = system%number(direction, node)
            if (k == 0) cycle
            if (v(k) >= much) return
         end do
      end do
   end subroutine first_large

end module condition_estimate
