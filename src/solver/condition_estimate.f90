!> An estimate of the condition number of the factorised stiffness matrix [k].
!! [k] is scaled to [d] [k] [d], d_i = k_ii^(-1/2). The scaling removes the effect of units, of rotations beside displacements
!! and of a soft part on a stiff one, which costs no digits. A stiff part on a soft support costs digits: the stiffness of its
!! support is a small difference of large numbers. The scaled matrix has a unit diagonal. Its norm lies between 1 and the number
!! of unknowns of an element. The condition number is therefore taken as the norm of the inverse. (An estimate of the norm of
!! the matrix itself would depend on rounding: where columns have equal sums, rounding chooses among them.)
!! Source: Higham, ACM Trans. Math. Softw. 14 (1988) 381-396, DLACN2 of LAPACK; scaling: van der Sluis, Numer. Math. 14 (1969)
!! 14-23.
module condition_estimate
   use blas_lapack, only: dlacn2
   use equation_solver, only: equation_system
   use kinds, only: wp
   implicit none
   private

   public :: estimate_condition, first_large, watch_condition

   real(wp), parameter, public :: poor_condition = 1.0e12_wp !! a larger condition number is reported
   real(wp), parameter :: spread = 300.0_wp ! see watch_condition
   real(wp), parameter :: near = 0.9283_wp ! of the largest entry: in a rigid motion rounding must not choose the node

   !> An estimate of the condition.
   type, public :: condition_type
      real(wp) :: number = 0.0_wp          !! norm(([d] [k] [d])^-1), the largest column sum [-]
      integer  :: node = 0, direction = 0  !! of the largest component of the displacement that [k] resists least
      real(wp) :: weakest = 1.0_wp         !! smallest relative pivot examined so far, as in equation_system
      logical  :: is_new = .false.         !! the condition is poor and has not been reported
   end type condition_type

contains

   !> Estimate the condition of the factor of SYSTEM where its smallest pivot justifies the cost. 1/pivot is an entry of the
   !! diagonal of the inverse of a part of [d] [k] [d]. The largest column sum is at most n times the largest entry. With n
   !! equations the condition of structures was found between 1E-4 and 41 n/pivot, for slender beams, bodies on soft bars and
   !! all decks. A factor is examined when its pivot is ten times smaller than any before: an estimate costs some five
   !! solutions.
   subroutine watch_condition(system, condition)
      class(equation_system), intent(in)  :: system
      type(condition_type), intent(inout) :: condition

      condition%is_new = .false.
      if (system%weakest*poor_condition > spread*system%n) return
      if (system%weakest > 0.1_wp*condition%weakest) return
      call estimate_condition(system, condition)
      condition%is_new = condition%number > poor_condition
   end subroutine watch_condition

   !> The condition of the matrix whose factor SYSTEM holds, by some five solutions.
   subroutine estimate_condition(system, condition)
      class(equation_system), intent(in)  :: system
      type(condition_type), intent(inout) :: condition
      real(wp), allocatable :: scale(:), v(:), x(:)
      integer, allocatable  :: signs(:)
      integer :: kase, state(3)

      allocate (scale, source=sqrt(system%diagonal))
      allocate (v(system%n), x(system%n), signs(system%n))
      kase = 0
      condition%number = 0.0_wp
      do
         call dlacn2(system%n, v, x, signs, condition%number, kase, state)
         if (kase == 0) exit
         x = scale*x
         call system%solve_by_factor(x)
         x = scale*x
      end do
      condition%weakest = system%weakest
      v = abs(v)
      v(system%locked) = 0.0_wp
      call first_large(system, v, condition%node, condition%direction)
   end subroutine estimate_condition

   !> The first node, in the order of the model, and its DIRECTION at which V equals the largest entry within the margin.
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
