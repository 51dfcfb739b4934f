!> Provides small numerical services: range checks, ties, the vector product, zeros of polynomials, least squares.
!! A measure must be finite and far enough below the largest real that its squares and its products with stiffnesses and areas stay
!! finite. The zeros of a polynomial of low degree in an interval are found between the zeros of its derivative: the polynomial is
!! monotonic there, so that each such interval has at most one zero. LAPACK solves the linear least-squares problem.
!! Source: Press et al., Numerical Recipes, 2nd ed., section 9.4, for Newton's method within a bracket.
module numbers
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   use tolerances, only: dependent_columns, symmetric_tie
   implicit none
   private

   public :: is_measure, first_largest, cross, by_rotation, find_zeros, enclosed_zero, polynomial, derivative, &
             solve_least_squares, fit_line

   real(wp), parameter, public :: largest_measure = 1.0e100_wp
   real(wp), parameter, public :: identity(3, 3) = reshape([real(wp) :: 1, 0, 0, 0, 1, 0, 0, 0, 1], [3, 3])

   integer, parameter, public :: highest_degree = 4

   !> Some zeros in ascending order.
   type, public :: zero_list
      integer  :: n = 0
      real(wp) :: x(highest_degree) = 0.0_wp
   end type zero_list

   interface
      subroutine dgelsy(m, n, nrhs, a, lda, b, ldb, jpvt, rcond, rank, work, lwork, info)
         import :: wp
         integer, intent(in)     :: m, n, nrhs, lda, ldb, lwork
         real(wp), intent(in)    :: rcond
         real(wp), intent(inout) :: a(lda, *), b(ldb, *), work(*)
         integer, intent(inout)  :: jpvt(*)
         integer, intent(out)    :: rank, info
      end subroutine dgelsy
   end interface

contains

   !> Whether VALUE can be a measure. A NaN is never compared: that would raise an exception.
   elemental logical function is_measure(value)
      real(wp), intent(in) :: value

      is_measure = ieee_is_finite(value)
      if (is_measure) is_measure = abs(value) <= largest_measure
   end function is_measure

   !> The position of the largest of the VALUES that count, the first among those that are equal to rounding; 0 where none counts.
   !! Every node and element that is named for its largest value is found by this rule.
   pure integer function first_largest(values, counts) result(at)
      real(wp), intent(in)          :: values(:)
      logical, intent(in), optional :: counts(:) !! default: all count
      logical  :: counted(size(values))
      real(wp) :: most

      counted = .true.
      if (present(counts)) counted = counts
      at = 0
      if (any(counted .and. .not. is_measure(values))) then
         at = findloc(counted .and. .not. is_measure(values), .true., dim=1)
      else if (any(counted)) then
         most = maxval(values, mask=counted)
         at = findloc(counted .and. values >= most - symmetric_tie*abs(most), .true., dim=1)
      end if
   end function first_largest

   !> Vector product a x b.
   pure function cross(a, b) result(product_of_them)
      real(wp), intent(in) :: a(3), b(3)
      real(wp) :: product_of_them(3)

      product_of_them = [a(2)*b(3) - a(3)*b(2), a(3)*b(1) - a(1)*b(3), a(1)*b(2) - a(2)*b(1)]
   end function cross

   !> [W] of a point at the ARM from the node that rotates: its displacement is {u} + [W] {theta}, theta x arm.
   pure function by_rotation(arm) result(w)
      real(wp), intent(in) :: arm(3) !! [length]
      real(wp) :: w(3, 3)

      w = reshape([0.0_wp, -arm(3), arm(2), arm(3), 0.0_wp, -arm(1), -arm(2), arm(1), 0.0_wp], [3, 3])
   end function by_rotation

   !> The zeros in FROM < x < TO at which sum of c_k x**k changes its sign; a double zero does not count.
   pure recursive subroutine find_zeros(c, from, to, zeros)
      real(wp), intent(in)         :: c(0:)  !! up to the power highest_degree
      real(wp), intent(in)         :: from, to
      type(zero_list), intent(out) :: zeros
      type(zero_list) :: turns
      real(wp) :: bracket(2)
      integer  :: i

      if (all(abs(c(1:)) <= 0.0_wp)) return
      call find_zeros(derivative(c), from, to, turns)
      bracket(2) = from
      do i = 1, turns%n + 1
         bracket(1) = bracket(2)
         bracket(2) = to
         if (i <= turns%n) bracket(2) = turns%x(i)
         if (polynomial(c, bracket(1))*polynomial(c, bracket(2)) >= 0.0_wp) cycle
         zeros%n = zeros%n + 1
         zeros%x(zeros%n) = enclosed_zero(c, bracket)
      end do
   end subroutine find_zeros

   !> The zero in BRACKET, at whose ends the polynomial has opposite signs, to rounding: Newton's method, bisection where Newton's
   !! method would leave the bracket.
   pure real(wp) function enclosed_zero(c, bracket) result(x)
      real(wp), intent(in) :: c(0:), bracket(2)
      real(wp) :: ends(2), value, slope, step, last_step
      integer  :: k, pass

      ends = bracket
      if (polynomial(c, ends(1)) > 0.0_wp) ends = bracket([2, 1]) ! negative at ends(1)
      x = 0.5_wp*sum(ends)
      step = ends(2) - ends(1)
      do pass = 1, 500
         value = 0.0_wp
         slope = 0.0_wp
         do k = ubound(c, 1), 0, -1
            slope = slope*x + value
            value = value*x + c(k)
         end do
         if (abs(value) <= 0.0_wp) exit
         if (value < 0.0_wp) then
            ends(1) = x
         else
            ends(2) = x
         end if
         last_step = step
         step = 0.5_wp*sum(ends) - x
         if (abs(value) < 0.5_wp*abs(slope*last_step)) then ! Newton's method converges
            if ((x - value/slope - ends(1))*(x - value/slope - ends(2)) <= 0.0_wp) step = -value/slope
         end if
         x = x + step
         if (abs(step) <= spacing(x)) exit
      end do
   end function enclosed_zero

   !> Sum of c_k x**k.
   pure real(wp) function polynomial(c, x) result(value)
      real(wp), intent(in) :: c(0:), x
      integer :: k

      value = 0.0_wp
      do k = ubound(c, 1), 0, -1
         value = value*x + c(k)
      end do
   end function polynomial

   !> Coefficients k c_k of the derivative, one fewer.
   pure function derivative(c) result(slope)
      real(wp), intent(in) :: c(0:)
      real(wp) :: slope(0:ubound(c, 1) - 1)
      integer  :: k

      do k = 1, ubound(c, 1)
         slope(k - 1) = k*c(k)
      end do
   end function derivative

   !> The X that minimizes norm2(MATRIX X - RHS), by an orthogonal factorisation with pivoting (DGELSY). The columns are scaled to unit
   !! length first, so that d, d^2, d^3 may have any unit. OK is false where MATRIX has fewer rows than columns or, to rounding,
   !! dependent columns; X is then zero.
   subroutine solve_least_squares(matrix, rhs, x, ok)
      real(wp), intent(in)  :: matrix(:, :) !! (points, unknowns)
      real(wp), intent(in)  :: rhs(:)       !! (points)
      real(wp), intent(out) :: x(:)         !! (unknowns)
      logical, intent(out)  :: ok
      real(wp), allocatable :: a(:, :), b(:, :), work(:)
      real(wp) :: length(size(matrix, 2)), best_size(1)
      integer  :: pivots(size(matrix, 2)), info, k, m, n, rank

      m = size(matrix, 1)
      n = size(matrix, 2)
      x = 0.0_wp
      ok = .false.
      if (m < n) return
      length = [(norm2(matrix(:, k)), k = 1, n)]
      if (any(length <= 0.0_wp)) return
      a = matrix/spread(length, 1, m)
      b = reshape(rhs, [m, 1])
      pivots = 0
      call dgelsy(m, n, 1, a, m, b, m, pivots, dependent_columns, rank, best_size, -1, info)
      allocate (work(int(best_size(1))))
      call dgelsy(m, n, 1, a, m, b, m, pivots, dependent_columns, rank, work, size(work), info)
      ok = info == 0 .and. rank == n
      if (ok) x = b(:n, 1)/length
   end subroutine solve_least_squares

   !> The least-squares line y = LINE(1) + LINE(2) x. OK is false for fewer than two different x.
   subroutine fit_line(x, y, line, ok)
      real(wp), intent(in)  :: x(:), y(:)
      real(wp), intent(out) :: line(2)
      logical, intent(out)  :: ok
      real(wp) :: matrix(size(x), 2)

      matrix(:, 1) = 1.0_wp
      matrix(:, 2) = x
      call solve_least_squares(matrix, y, line, ok)
   end subroutine fit_line

end module numbers
