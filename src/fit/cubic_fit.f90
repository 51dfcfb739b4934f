!> The cubics of the shear law (Eqs. 3b, 5, 6) from test points.
module cubic_fit
   use kinds, only: wp
   use least_squares, only: solve_least_squares
   implicit none
   private

   public :: fit_cubic, fit_cubic_in_pressure, cubic_terms

contains

   !> tau = C(0) + C(1) d + C(2) d^2 + C(3) d^3 through the points of one pressure. OK is false where the points do not
   !! fix it: fewer than three different d other than zero, or four with the constant.
   subroutine fit_cubic(d, tau, with_constant, c, ok)
      real(wp), intent(in)  :: d(:), tau(:)  !! (points) [length], [stress]
      logical, intent(in)   :: with_constant !! false: C(0) = 0, as on the loading branch
      real(wp), intent(out) :: c(0:3)
      logical, intent(out)  :: ok
      real(wp) :: matrix(size(d), 0:3)

      matrix(:, 0) = 1.0_wp
      matrix(:, 1:) = cubic_terms(d)
      c = 0.0_wp
      if (with_constant) then
         call solve_least_squares(matrix, tau, c, ok)
      else
         call solve_least_squares(matrix(:, 1:), tau, c(1:), ok)
      end if
   end subroutine fit_cubic


   !> All points of a branch at once: tau = sum over k of (LINES(1,k) + LINES(2,k) p) d^k, and with constants one more
   !! for each group of points, because every run of an unloading or reloading starts at a point of its own. OK is false
   !! where the points do not fix the coefficients.
   subroutine fit_cubic_in_pressure(d, tau, p, group, with_constants, lines, ok)
      real(wp), intent(in)  :: d(:), tau(:), p(:) !! (points) [length], [stress], [pressure]
      integer, intent(in)   :: group(:)           !! (points) 1 and up
      logical, intent(in)   :: with_constants
      real(wp), intent(out) :: lines(2, 3)        !! a_k1 and a_k2 for k = 1, 2, 3
      logical, intent(out)  :: ok
      real(wp), allocatable :: matrix(:, :), x(:)
      integer :: i, n

      n = 6
      if (with_constants) n = n + maxval(group)
      lines = 0.0_wp
      ok = n <= size(d)
      if (.not. ok) return
      allocate (matrix(size(d), n), x(n))
      matrix(:, 1:3) = cubic_terms(d)
      matrix(:, 4:6) = spread(p, 2, 3)*matrix(:, 1:3)
      do i = 7, n
         matrix(:, i) = merge(1.0_wp, 0.0_wp, group == i - 6)
      end do
      call solve_least_squares(matrix, tau, x, ok)
      lines(1, :) = x(1:3)
      lines(2, :) = x(4:6)
   end subroutine fit_cubic_in_pressure


   !> d, d^2, d^3 of every point.
   pure function cubic_terms(d) result(terms)
      real(wp), intent(in) :: d(:)
      real(wp) :: terms(size(d), 3)

      terms(:, 1) = d
      terms(:, 2) = d*d
      terms(:, 3) = d*terms(:, 2)
   end function cubic_terms

end module cubic_fit
