!> One branch of the shear law, tau = sum over k of (a_k1 + a_k2 p) d^k (Eqs. 3b, 5, 6), from test points or published cubics.
module branch_fit
   use kinds, only: wp
   use least_squares, only: fit_line, solve_least_squares
   implicit none
   private

   public :: fit_points, fit_lines_only, group_by_pressure, fit_cubic, fit_cubic_in_pressure

   real(wp), parameter :: rounding = 1.0e-13_wp ! share of a coefficient in tau below which it is set to zero

   !> What the data lack for a fit.
   integer, parameter, public :: fault_none = 0, fault_one_pressure = 1, fault_few_points = 2, fault_dependent = 3

   !> How far the points, or the coefficients of the cubics, lie off a fit.
   type, public :: residual_type
      real(wp) :: rms = 0.0_wp, largest = 0.0_wp
      integer  :: at  = 0      !! the point or the pressure with the largest
   end type residual_type

   !> A fitted branch. LINES are the straight lines of Fig. 2, a_k1 and a_k2 for k = 1, 2, 3.
   type, public :: branch_fit_type
      integer :: n_points  = 0              !! 0: no data of this branch
      integer :: fault     = fault_none     !! what the data lack
      integer :: fault_at  = 0              !! the pressure with too few points, of fault_few_points
      logical :: from_points = .false.      !! false: the cubics were given
      logical :: constant  = .false.        !! the cubics have a constant term
      logical :: two_step  = .false.        !! CUBICS and LINES are there
      integer, allocatable  :: group(:)     !! (points) the pressure that each was taken at
      real(wp), allocatable :: group_p(:)   !! (pressures)
      real(wp), allocatable :: cubic(:, :)  !! (0:3, pressures)
      real(wp) :: lines(2, 3) = 0.0_wp      !! a line through the cubics' coefficients, term by term
      real(wp) :: joint(2, 3) = 0.0_wp      !! all points at once
      type(residual_type) :: of_cubics, of_lines, of_joint !! of tau [stress]
      type(residual_type) :: of_coefficients(3)            !! of the cubics' coefficients about LINES
      real(wp) :: p_low = 0.0_wp, p_high = 0.0_wp          !! range of the data [pressure]
      real(wp) :: d_low = 0.0_wp, d_high = 0.0_wp          !! [length]
   end type branch_fit_type

contains

   !> Fit a branch through test points: in two steps, a cubic for each pressure and then the lines of Fig. 2 through their
   !! coefficients, and for comparison all points in one step. What the two steps lack is a fault of FIT unless ONE_STEP says
   !! that the other is wanted.
   subroutine fit_points(d, tau, p, constant, tolerance, one_step, fit)
      real(wp), intent(in)               :: d(:), tau(:), p(:) !! (points) [length], [stress], [pressure]
      logical, intent(in)                :: constant           !! each group's cubic has a constant term
      real(wp), intent(in)               :: tolerance          !! relative, of pressures that count as one
      logical, intent(in)                :: one_step
      type(branch_fit_type), intent(out) :: fit
      logical :: ok
      integer :: k

      fit%n_points = size(d)
      fit%from_points = .true.
      fit%constant = constant
      fit%p_low = minval(p)
      fit%p_high = maxval(p)
      fit%d_low = minval(d)
      fit%d_high = maxval(d)
      call group_by_pressure(p, tolerance, fit%group, fit%group_p)
      call fit_two_steps(d, tau, fit)
      if (.not. (fit%two_step .or. one_step)) return
      call fit_cubic_in_pressure(d, tau, p, fit%group, constant, fit%joint, ok)
      fit%fault = merge(fault_none, fault_dependent, ok)
      if (.not. ok) return
      do k = 1, 3
         call drop_rounding(fit%lines(:, k), fit%p_high, maxval(abs(d))**k, maxval(abs(tau)))
         call drop_rounding(fit%joint(:, k), fit%p_high, maxval(abs(d))**k, maxval(abs(tau)))
      end do
      fit%of_joint = law_residual(d, tau, p, fit, fit%joint)
      if (.not. fit%two_step) return
      fit%of_lines = law_residual(d, tau, p, fit, fit%lines)
      associate (c => fit%cubic(:, fit%group))
         fit%of_cubics = residual_of(tau - (c(1, :) + d*(c(2, :) + d*(c(3, :) + d*c(4, :)))))
      end associate
   end subroutine fit_points


   !> A cubic for each group, then a line through each of their coefficients.
   subroutine fit_two_steps(d, tau, fit)
      real(wp), intent(in)                 :: d(:), tau(:)
      type(branch_fit_type), intent(inout) :: fit
      integer :: i
      logical :: ok

      allocate (fit%cubic(0:3, size(fit%group_p)))
      do i = 1, size(fit%group_p)
         call fit_cubic(pack(d, fit%group == i), pack(tau, fit%group == i), fit%constant, fit%cubic(:, i), ok)
         if (ok) cycle
         fit%fault = fault_few_points
         fit%fault_at = i
         return
      end do
      call fit_coefficient_lines(fit)
   end subroutine fit_two_steps


   !> Fit the lines of Fig. 2 through published cubics; the range of d is not known from them.
   subroutine fit_lines_only(c, p, fit)
      real(wp), intent(in)               :: c(:, :) !! (3, cubics)
      real(wp), intent(in)               :: p(:)    !! (cubics) [pressure]
      type(branch_fit_type), intent(out) :: fit
      integer :: k

      fit%n_points = size(p)
      fit%p_low = minval(p)
      fit%p_high = maxval(p)
      fit%group = [(k, k = 1, size(p))]
      fit%group_p = p
      allocate (fit%cubic(0:3, size(p)), source=0.0_wp)
      fit%cubic(1:, :) = c
      call fit_coefficient_lines(fit)
      do k = 1, 3
         call drop_rounding(fit%lines(:, k), fit%p_high, 1.0_wp, maxval(abs(c(k, :))))
      end do
   end subroutine fit_lines_only


   !> a_k1 + a_k2 p through the coefficients of the cubics, all pressures counting alike.
   subroutine fit_coefficient_lines(fit)
      type(branch_fit_type), intent(inout) :: fit
      integer :: k

      do k = 1, 3
         call fit_line(fit%group_p, fit%cubic(k, :), fit%lines(:, k), fit%two_step)
         if (.not. fit%two_step) fit%fault = fault_one_pressure
         if (.not. fit%two_step) return
         fit%of_coefficients(k) = residual_of(fit%cubic(k, :) - fit%lines(1, k) - fit%lines(2, k)*fit%group_p)
      end do
   end subroutine fit_coefficient_lines


   !> Put points into groups of equal pressure. In ascending order of p a group reaches from its lowest p to
   !! (1 + TOLERANCE) times that; its pressure is the mean of its points. Groups are numbered in ascending order of p.
   pure subroutine group_by_pressure(p, tolerance, group, group_p)
      real(wp), intent(in)               :: p(:)       !! >= 0 [pressure]
      real(wp), intent(in)               :: tolerance  !! >= 0 [-]
      integer, allocatable, intent(out)  :: group(:)   !! (points) the group of each point
      real(wp), allocatable, intent(out) :: group_p(:) !! (groups) [pressure]
      real(wp) :: highest
      integer  :: n

      allocate (group(size(p)), source=0)
      allocate (group_p(0))
      do while (any(group == 0))
         n = size(group_p) + 1
         highest = minval(p, group == 0)*(1.0_wp + tolerance)
         where (group == 0 .and. p <= highest) group = n
         group_p = [group_p, sum(p, group == n)/count(group == n)]
      end do
   end subroutine group_by_pressure


   !> tau = C(0) + C(1) d + C(2) d^2 + C(3) d^3 through the points of one pressure. OK is false where the points do not
   !! fix it: fewer than three different d other than zero, or four with the constant.
   subroutine fit_cubic(d, tau, with_constant, c, ok)
      real(wp), intent(in)  :: d(:), tau(:)  !! (points) [length], [stress]
      logical, intent(in)   :: with_constant !! false: C(0) = 0, as on the loading branch
      real(wp), intent(out) :: c(0:3)
      logical, intent(out)  :: ok
      real(wp) :: matrix(size(d), 0:3)
      integer  :: first

      first = merge(0, 1, with_constant)
      matrix(:, 0) = 1.0_wp
      matrix(:, 1:) = cubic_terms(d)
      c = 0.0_wp
      call solve_least_squares(matrix(:, first:), tau, c(first:), ok)
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


   !> Set to zero what of a line (a_k1, a_k2) is rounding: a share of the stress far below its last digit.
   pure subroutine drop_rounding(line, p, d_power, tau)
      real(wp), intent(inout) :: line(2)
      real(wp), intent(in)    :: p, d_power, tau !! largest p, d^k and |tau| of the data

      where (abs(line)*[1.0_wp, p]*d_power <= rounding*tau) line = 0.0_wp
   end subroutine drop_rounding


   !> Residual of tau about the law with LINES; where the branch has constants, each group its own best.
   pure function law_residual(d, tau, p, fit, lines) result(residual)
      real(wp), intent(in)              :: d(:), tau(:), p(:), lines(2, 3)
      type(branch_fit_type), intent(in) :: fit
      type(residual_type) :: residual
      real(wp) :: off(size(d)), terms(size(d), 3)
      integer  :: i, k

      terms = cubic_terms(d)
      off = tau
      do k = 1, 3
         off = off - (lines(1, k) + lines(2, k)*p)*terms(:, k)
      end do
      do i = 1, merge(size(fit%group_p), 0, fit%constant)
         where (fit%group == i) off = off - sum(off, fit%group == i)/count(fit%group == i)
      end do
      residual = residual_of(off)
   end function law_residual


   pure function residual_of(off) result(residual)
      real(wp), intent(in) :: off(:)
      type(residual_type) :: residual

      residual%rms = norm2(off)/sqrt(real(size(off), wp))
      residual%at = maxloc(abs(off), 1)
      residual%largest = abs(off(residual%at))
   end function residual_of

end module branch_fit
