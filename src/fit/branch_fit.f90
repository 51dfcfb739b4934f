!> One branch of the shear law, tau = sum over k of (a_k1 + a_k2 p) d^k, from test points or published cubics.
module branch_fit
   use cubic_fit, only: cubic_terms, fit_cubic, fit_cubic_in_pressure
   use kinds, only: wp
   use least_squares, only: fit_line
   use pressure_groups, only: group_by_pressure
   implicit none
   private

   public :: fit_points, fit_lines_only

   real(wp), parameter :: rounding = 1.0e-13_wp ! share of a coefficient in tau below which it is set to zero

   !> How far the points, or the coefficients of the cubics, lie off a fit.
   type, public :: residual_type
      real(wp) :: rms = 0.0_wp, largest = 0.0_wp
      integer  :: at  = 0      !! the point or the pressure with the largest
   end type residual_type

   !> A fitted branch. LINES are the straight lines of Fig. 2, a_k1 and a_k2 for k = 1, 2, 3.
   type, public :: branch_fit_type
      integer :: n_points  = 0              !! 0: no data of this branch
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

   !> What the data lack for a fit.
   integer, parameter, public :: fault_none = 0, fault_one_pressure = 1, fault_few_points = 2, fault_dependent = 3

contains

   !> Fit a branch through test points: in two steps, a cubic for each pressure and then the lines of Fig. 2 through their
   !! coefficients, and for comparison all points in one step. What the two steps lack is a FAULT unless ONE_STEP says
   !! that the other is wanted; WHERE is then the group (fault_few_points) or 0.
   subroutine fit_points(d, tau, p, constant, tolerance, one_step, fit, fault, where)
      real(wp), intent(in)               :: d(:), tau(:), p(:) !! (points) [length], [stress], [pressure]
      logical, intent(in)                :: constant           !! each group's cubic has a constant term
      real(wp), intent(in)               :: tolerance          !! relative, of pressures that count as one
      logical, intent(in)                :: one_step
      type(branch_fit_type), intent(out) :: fit
      integer, intent(out)               :: fault, where
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
      call fit_two_steps(d, tau, fit, fault, where)
      if (fault /= fault_none .and. .not. one_step) return
      fit%two_step = fault == fault_none
      where = 0
      call fit_cubic_in_pressure(d, tau, p, fit%group, constant, fit%joint, ok)
      fault = merge(fault_none, fault_dependent, ok)
      if (.not. ok) return
      do k = 1, 3
         call drop_rounding(fit%lines(:, k), fit%p_high, maxval(abs(d))**k, maxval(abs(tau)))
         call drop_rounding(fit%joint(:, k), fit%p_high, maxval(abs(d))**k, maxval(abs(tau)))
      end do
      fit%of_joint = law_residual(d, tau, p, fit, fit%joint)
      if (.not. fit%two_step) return
      fit%of_lines = law_residual(d, tau, p, fit, fit%lines)
      fit%of_cubics = residual_of(tau - cubic_stress(d, fit))
   end subroutine fit_points


   !> A cubic for each group, then a line through each of their coefficients.
   subroutine fit_two_steps(d, tau, fit, fault, where)
      real(wp), intent(in)                 :: d(:), tau(:)
      type(branch_fit_type), intent(inout) :: fit
      integer, intent(out)                 :: fault, where
      integer :: i
      logical :: ok

      allocate (fit%cubic(0:3, size(fit%group_p)))
      fault = fault_few_points
      do i = 1, size(fit%group_p)
         where = i
         call fit_cubic(pack(d, fit%group == i), pack(tau, fit%group == i), fit%constant, fit%cubic(:, i), ok)
         if (.not. ok) return
      end do
      where = 0
      fault = fault_one_pressure
      call fit_coefficient_lines(fit, ok)
      if (ok) fault = fault_none
   end subroutine fit_two_steps


   !> Fit the lines of Fig. 2 through published cubics; the range of d is not known from them.
   subroutine fit_lines_only(c, p, fit, fault)
      real(wp), intent(in)               :: c(:, :) !! (3, cubics)
      real(wp), intent(in)               :: p(:)    !! (cubics) [pressure]
      type(branch_fit_type), intent(out) :: fit
      integer, intent(out)               :: fault
      integer :: k
      logical :: ok

      fit%n_points = size(p)
      fit%p_low = minval(p)
      fit%p_high = maxval(p)
      fit%group_p = p
      allocate (fit%cubic(0:3, size(p)))
      fit%cubic(0, :) = 0.0_wp
      fit%cubic(1:, :) = c
      call fit_coefficient_lines(fit, ok)
      fault = merge(fault_none, fault_one_pressure, ok)
      fit%two_step = ok
      do k = 1, 3
         call drop_rounding(fit%lines(:, k), fit%p_high, 1.0_wp, maxval(abs(c(k, :))))
      end do
   end subroutine fit_lines_only


   !> a_k1 + a_k2 p through the coefficients of the cubics, all pressures counting alike.
   subroutine fit_coefficient_lines(fit, ok)
      type(branch_fit_type), intent(inout) :: fit
      logical, intent(out)                 :: ok
      integer :: k

      do k = 1, 3
         call fit_line(fit%group_p, fit%cubic(k, :), fit%lines(:, k), ok)
         if (.not. ok) return
         fit%of_coefficients(k) = residual_of(fit%cubic(k, :) - fit%lines(1, k) - fit%lines(2, k)*fit%group_p)
      end do
   end subroutine fit_coefficient_lines


   !> Set to zero what of a line (a_k1, a_k2) is rounding: a share of the stress far below its last digit.
   pure subroutine drop_rounding(line, p, d_power, tau)
      real(wp), intent(inout) :: line(2)
      real(wp), intent(in)    :: p, d_power, tau !! largest p, d^k and |tau| of the data

      if (abs(line(1))*d_power <= rounding*tau) line(1) = 0.0_wp
      if (abs(line(2))*p*d_power <= rounding*tau) line(2) = 0.0_wp
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
      if (fit%constant) then
         do i = 1, size(fit%group_p)
            where (fit%group == i) off = off - sum(off, fit%group == i)/count(fit%group == i)
         end do
      end if
      residual = residual_of(off)
   end function law_residual


   !> tau of the cubic of each point's own pressure.
   pure function cubic_stress(d, fit) result(tau)
      real(wp), intent(in)              :: d(:)
      type(branch_fit_type), intent(in) :: fit
      real(wp) :: tau(size(d))

      associate (c => fit%cubic(:, fit%group))
         tau = c(1, :) + d*(c(2, :) + d*(c(3, :) + d*c(4, :)))
      end associate
   end function cubic_stress


   pure function residual_of(off) result(residual)
      real(wp), intent(in) :: off(:)
      type(residual_type) :: residual

      residual%rms = norm2(off)/sqrt(real(size(off), wp))
      residual%at = maxloc(abs(off), 1)
      residual%largest = abs(off(residual%at))
   end function residual_of

end module branch_fit
