!> Fits branches of the shear law and the unloading slope E_u, and measures noise and turning points of a record.
!! A branch of shear is tau = sum over k of (a_k1 + a_k2 p) d^k (Eqs. 3b, 5, 6); it is fitted to points or to published cubics. The
!! loops of a normal test give E_u, the slope of unloading and reloading. The record is in the order of time.
module branch_fit
   use data_columns, only: fit_load
   use kinds, only: wp
   use numbers, only: fit_line, solve_least_squares
   use tolerances, only: equal_pressures, zero_coefficient
   implicit none
   private

   public :: scatter_of, find_turns, group_by_pressure, fit_loops, fit_points, fit_lines_only, fit_cubic, fit_cubic_in_pressure, &
             residual_of

   !> One line of unloading or reloading, lambda = LAMBDA + (p - P)/E_U, through the mean of its points.
   type, public :: loop_line
      integer  :: branch = 0, n_points = 0
      real(wp) :: p_low = 0.0_wp, p_high = 0.0_wp !! [pressure]
      real(wp) :: lambda = 0.0_wp, p = 0.0_wp     !! means of the points [length], [pressure]
      real(wp) :: set = 0.0_wp                    !! lambda at p = 0 [length]
      real(wp) :: e_u = 0.0_wp                    !! [pressure/length], 0: no line with positive slope
   end type loop_line

   type, public :: loop_fit_type
      type(loop_line), allocatable :: lines(:)
      integer  :: n_points = 0
      real(wp) :: e_u   = 0.0_wp  !! common slope of all lines [pressure/length], 0: none
      real(wp) :: error = 0.0_wp  !! standard error of E_U relative to E_U
      real(wp) :: rms   = 0.0_wp  !! of lambda about lines of this slope [length]
      integer, allocatable :: line_of(:) !! (points) 0: loading, -1: no line
   end type loop_fit_type

   !> Options of a branch fit.
   type, public :: fit_choice
      real(wp) :: p_tolerance  = equal_pressures !! relative difference of pressures that count as equal
      logical  :: one_step     = .false.    !! the one-step fit is wanted: what the two-step fit lacks is not an error
      logical  :: one_pressure = .false.    !! for one pressure: coefficients independent of pressure
   end type fit_choice

   !> What the data lack for a fit.
   integer, parameter, public :: fault_none = 0, fault_one_pressure = 1, fault_few_points = 2, fault_dependent = 3

   !> Residual of the points, or of the coefficients of the cubics, about a fit.
   type, public :: residual_type
      real(wp) :: rms = 0.0_wp, largest = 0.0_wp
      integer  :: at  = 0      !! point or pressure with the largest residual
   end type residual_type

   !> A fitted branch. LINES are the straight lines of Fig. 2, a_k1 and a_k2 for k = 1, 2, 3.
   type, public :: branch_fit_type
      integer :: n_points  = 0              !! 0: no data for this branch
      integer :: fault     = fault_none     !! what the data lack
      integer :: fault_at  = 0              !! pressure with too few points, for fault_few_points
      logical :: from_points = .false.      !! false: the cubics were given
      logical :: constant  = .false.        !! every run at a pressure has a constant term
      logical :: two_step  = .false.        !! CUBIC and LINES are set
      integer, allocatable  :: row(:)       !! (points) row in the data
      integer, allocatable  :: group(:)     !! (points) pressure group of each point
      real(wp), allocatable :: group_p(:)   !! (pressures)
      real(wp), allocatable :: cubic(:, :)  !! (3, pressures)
      integer, allocatable  :: curve(:)     !! (points) run at one pressure to which each point belongs
      integer, allocatable  :: curve_at(:)  !! (curves) first point
      real(wp), allocatable :: start(:)     !! (curves) constant term of the cubic [stress]
      real(wp) :: lines(2, 3) = 0.0_wp      !! a line through the coefficients of the cubics, term by term
      real(wp) :: joint(2, 3) = 0.0_wp      !! fit to all points in one step
      type(residual_type) :: of_cubics, of_lines, of_joint !! of tau [stress]
      type(residual_type) :: of_coefficients(3)            !! of the coefficients of the cubics about LINES
      real(wp) :: p_low = 0.0_wp, p_high = 0.0_wp          !! range of the data [pressure]
      real(wp) :: d_low = 0.0_wp, d_high = 0.0_wp          !! [length]
      real(wp), allocatable :: sense(:), from(:) !! (points) the fit is to sense tau over sense (d - from); 1 and 0 but for BRANCH
   end type branch_fit_type

contains

   !> The largest random deviation of a reading in a record in which X and Y rise and fall together, as a share of the range of
   !! each: sqrt(2 ln N) standard deviations for N readings; two readings may differ by twice as much. The distance of a reading
   !! from the chord between its neighbours measures the noise: on a smooth curve it is small even for uneven readings. The median
   !! is insensitive to the turning points; for normal noise it is 0.6745 sqrt(3/2) standard deviations.
   pure real(wp) function scatter_of(x, y) result(scatter)
      real(wp), intent(in) :: x(:), y(:) !! (readings)
      real(wp) :: distance(max(0, size(x) - 2)), a(2), chord(2), range(2), high, low, median
      integer  :: i, n

      n = size(x)
      scatter = 0.0_wp
      range = [maxval(x) - minval(x), maxval(y) - minval(y)]
      if (n < 5 .or. any(range <= 0.0_wp)) return
      distance = 0.0_wp
      do i = 2, n - 1
         chord = [x(i + 1) - x(i - 1), y(i + 1) - y(i - 1)]/range
         a = [x(i) - x(i - 1), y(i) - y(i - 1)]/range
         if (norm2(chord) > 0.0_wp) distance(i - 1) = abs(chord(1)*a(2) - chord(2)*a(1))/norm2(chord)
      end do
      low = minval(distance)
      high = maxval(distance)
      do i = 1, 60            ! bisection for the median, of two the upper one: the number of values below is counted
         median = 0.5_wp*(low + high)
         if (2*count(distance <= median) < n - 2) then
            low = median
         else
            high = median
         end if
      end do
      scatter = sqrt(2.0_wp*log(real(n, wp)))*high/(0.6745_wp*sqrt(1.5_wp))
   end function scatter_of

   !> The turning points of U: the last readings before U turns back by more than BAND.
   pure subroutine find_turns(u, band, turns)
      real(wp), intent(in)              :: u(:)
      real(wp), intent(in)              :: band     !! [u]
      integer, allocatable, intent(out) :: turns(:) !! ascending, without the first and the last reading
      integer :: high, i, low, way                  ! WAY: 1 rising, -1 falling, 0 unknown

      allocate (turns(0))
      high = 1
      low = 1
      way = 0
      do i = 2, size(u)
         if (u(i) >= u(high)) high = i
         if (u(i) <= u(low)) low = i
         if (way >= 0 .and. u(high) - u(i) > band) then
            if (way > 0 .or. u(high) - u(1) > band) turns = [turns, high]
            way = -1
            low = i
         else if (way <= 0 .and. u(i) - u(low) > band) then
            if (way < 0 .or. u(1) - u(low) > band) turns = [turns, low]
            way = 1
            high = i
         end if
      end do
   end subroutine find_turns

   !> Fit lines of one common slope, each with its own intercept, to the runs that are not loading: lambda over p, because the test
   !! prescribes the pressure and measures the deflection. The slopes of the single runs show the scatter.
   subroutine fit_loops(p, lambda, branch, run, joined, fit)
      real(wp), intent(in) :: p(:), lambda(:)    !! (points) [pressure], [length]
      integer, intent(in)  :: branch(:), run(:)  !! (points)
      logical, intent(in)  :: joined(:)          !! (points) the test came from the point before
      type(loop_fit_type), intent(out) :: fit
      integer, allocatable :: points(:)
      type(loop_line) :: line
      real(wp) :: mean(2), sums(3), total(3)     ! sums of squares p p, p lambda, lambda lambda about the means
      integer  :: freedom, i, k

      allocate (fit%lines(0))
      fit%line_of = merge(0, -1, branch == fit_load)
      total = 0.0_wp
      do i = 1, size(p)
         if (fit%line_of(i) >= 0) cycle
         points = pack([(k, k = 1, size(p))], run == run(i) .and. branch == branch(i))
         if (joined(i)) points = [i - 1, points]
         mean = [sum(p(points)), sum(lambda(points))]/size(points)
         sums = [sum((p(points) - mean(1))**2), sum((p(points) - mean(1))*(lambda(points) - mean(2))), &
                 sum((lambda(points) - mean(2))**2)]
         if (sums(1) <= 0.0_wp) cycle
         line = loop_line(branch(i), size(points), minval(p(points)), maxval(p(points)), mean(2), mean(1), &
                          mean(2) - mean(1)*sums(2)/sums(1))
         if (sums(2) > 0.0_wp) line%e_u = sums(1)/sums(2)
         fit%lines = [fit%lines, line]
         where (run == run(i) .and. branch == branch(i)) fit%line_of = size(fit%lines)
         total = total + sums
      end do
      if (size(fit%lines) == 0) return
      fit%n_points = sum(fit%lines%n_points)
      if (total(2) <= 0.0_wp) return
      fit%e_u = total(1)/total(2)
      fit%rms = sqrt(max(0.0_wp, total(3) - total(2)/fit%e_u)/fit%n_points)
      freedom = fit%n_points - size(fit%lines) - 1
      if (freedom > 0) fit%error = fit%rms*sqrt(fit%n_points/(freedom*total(1)))*fit%e_u
   end subroutine fit_loops

   !> Fit a branch to test points in two steps, a cubic for each pressure and then the lines of Fig. 2 through the coefficients, and
   !! for comparison in one step to all points. What the two steps lack is a fault of FIT unless the one-step fit is CHOSEN.
   subroutine fit_points(d, tau, p, run, constant, chosen, fit)
      real(wp), intent(in)               :: d(:), tau(:), p(:) !! (points) [length], [stress], [pressure]
      integer, intent(in)                :: run(:)             !! (points) each run at a pressure starts at a point of its own
      logical, intent(in)                :: constant           !! the runs have a constant term
      type(fit_choice), intent(in)       :: chosen
      type(branch_fit_type), intent(out) :: fit
      integer, allocatable  :: curves(:), points(:)
      real(wp), allocatable :: start(:)
      logical :: ok
      integer :: i, k

      fit%n_points = size(d)
      fit%from_points = .true.
      fit%constant = constant
      fit%p_low = minval(p)
      fit%p_high = maxval(p)
      fit%d_low = minval(d)
      fit%d_high = maxval(d)
      call group_by_pressure(p, chosen%p_tolerance, fit%group, fit%group_p)
      allocate (fit%curve(size(run)), source=0)
      fit%curve_at = [integer ::]
      do i = 1, size(run)              ! number the runs of each pressure in the order of their first points
         if (fit%curve(i) > 0) cycle
         fit%curve_at = [fit%curve_at, i]
         where (run == run(i) .and. fit%group == fit%group(i)) fit%curve = size(fit%curve_at)
      end do
      allocate (fit%start(size(fit%curve_at)), source=0.0_wp)
      allocate (fit%cubic(3, size(fit%group_p)))
      do i = 1, size(fit%group_p)      ! a cubic for each pressure, then a line through each coefficient of the cubics
         points = pack([(k, k = 1, size(d))], fit%group == i)
         curves = pack([(k, k = 1, size(fit%start))], fit%group(fit%curve_at) == i)
         call fit_cubic(d(points), tau(points), belongs(fit, points, curves), fit%cubic(:, i), start, ok)
         fit%start(curves(:size(start))) = start
         if (ok) cycle
         fit%fault = fault_few_points
         fit%fault_at = i
         exit
      end do
      if (fit%fault == fault_none) call fit_coefficient_lines(chosen%one_pressure, fit)
      if (.not. (fit%two_step .or. chosen%one_step)) return
      fit%joint = fit%lines                ! for one pressure they are equal
      ok = size(fit%group_p) == 1 .and. fit%two_step
      if (.not. ok) call fit_cubic_in_pressure(d, tau, p, belongs(fit, [(k, k = 1, size(d))], [(k, k = 1, size(fit%start))]), &
                                               fit%joint, ok)
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
         fit%of_cubics = residual_of(tau - (fit%start(fit%curve) + d*(c(1, :) + d*(c(2, :) + d*c(3, :)))))
      end associate
   end subroutine fit_points

   !> Group points of equal pressure. In ascending order of p a group extends from its lowest p to (1 + TOLERANCE) times that; its
   !! pressure is the mean of its points. Groups are numbered in ascending order of p.
   pure subroutine group_by_pressure(p, tolerance, group, group_p)
      real(wp), intent(in)               :: p(:)       !! [pressure]; a p below 0, reported elsewhere, forms a group of its own
      real(wp), intent(in)               :: tolerance  !! >= 0 [-]
      integer, allocatable, intent(out)  :: group(:)   !! (points)
      real(wp), allocatable, intent(out) :: group_p(:) !! (groups) [pressure]
      real(wp) :: lowest
      integer  :: n

      allocate (group(size(p)), source=0)
      allocate (group_p(0))
      do while (any(group == 0))
         n = size(group_p) + 1
         lowest = minval(p, group == 0)
         where (group == 0 .and. p <= max(lowest, lowest*(1.0_wp + tolerance))) group = n
         group_p = [group_p, sum(p, group == n)/count(group == n)]
      end do
   end subroutine group_by_pressure

   !> Whether each of the POINTS belongs to each of the CURVES; without constant terms there are no curves.
   pure function belongs(fit, points, curves) result(matrix)
      type(branch_fit_type), intent(in) :: fit
      integer, intent(in)               :: points(:), curves(:)
      logical, allocatable :: matrix(:, :)
      integer :: n

      n = merge(size(curves), 0, fit%constant)
      matrix = spread(fit%curve(points), 2, n) == spread(curves(:n), 1, size(points))
   end function belongs

   !> Fit the lines of Fig. 2 to published cubics, which do not give the range of d.
   subroutine fit_lines_only(c, p, one_pressure, fit)
      real(wp), intent(in)               :: c(:, :) !! (3, cubics)
      real(wp), intent(in)               :: p(:)    !! (cubics) [pressure]
      logical, intent(in)                :: one_pressure !! a single cubic is enough
      type(branch_fit_type), intent(out) :: fit
      integer :: k

      fit%n_points = size(p)
      fit%p_low = minval(p)
      fit%p_high = maxval(p)
      fit%group = [(k, k = 1, size(p))]
      fit%group_p = p
      fit%cubic = c
      allocate (fit%start(0))
      call fit_coefficient_lines(one_pressure, fit)
      do k = 1, 3
         call drop_rounding(fit%lines(:, k), fit%p_high, 1.0_wp, maxval(abs(c(k, :))))
      end do
   end subroutine fit_lines_only

   !> Fit a_k1 + a_k2 p to the coefficients of the cubics; all pressures have equal weight.
   subroutine fit_coefficient_lines(one_pressure, fit)
      logical, intent(in)                  :: one_pressure !! one pressure is enough: a_k2 = 0
      type(branch_fit_type), intent(inout) :: fit
      integer :: k

      fit%two_step = one_pressure .and. size(fit%group_p) == 1
      if (fit%two_step) then
         fit%lines(1, :) = fit%cubic(:, 1)
         fit%of_coefficients%at = 1
         return
      end if
      do k = 1, 3
         call fit_line(fit%group_p, fit%cubic(k, :), fit%lines(:, k), fit%two_step)
         if (.not. fit%two_step) fit%fault = fault_one_pressure
         if (.not. fit%two_step) return
         fit%of_coefficients(k) = residual_of(fit%cubic(k, :) - fit%lines(1, k) - fit%lines(2, k)*fit%group_p)
      end do
   end subroutine fit_coefficient_lines

   !> Fit tau = START + C(1) d + C(2) d^2 + C(3) d^3 to the points of one pressure, with a START for every curve. OK is false where
   !! the points do not determine the cubic: fewer than three different nonzero d, or four on one curve with a start.
   subroutine fit_cubic(d, tau, belongs, c, start, ok)
      real(wp), intent(in)  :: d(:), tau(:)          !! (points) [length], [stress]
      logical, intent(in)   :: belongs(:, :)         !! (points, curves); no curves: START is zero, as on the loading branch
      real(wp), intent(out) :: c(3)
      real(wp), allocatable, intent(out) :: start(:) !! (curves) [stress]
      logical, intent(out)  :: ok
      real(wp) :: x(size(belongs, 2) + 3), matrix(size(d), size(belongs, 2) + 3)
      integer  :: n

      n = size(belongs, 2)
      matrix(:, :n) = merge(1.0_wp, 0.0_wp, belongs)
      matrix(:, n + 1:) = cubic_terms(d)
      call solve_least_squares(matrix, tau, x, ok)
      c = x(n + 1:)
      start = x(:n)
   end subroutine fit_cubic

   !> Fit all points of a branch in one step: tau = sum over k of (LINES(1,k) + LINES(2,k) p) d^k, with a constant for every curve,
   !! because every unloading or reloading run starts at a point of its own. OK is false where the points do not determine the
   !! coefficients.
   subroutine fit_cubic_in_pressure(d, tau, p, belongs, lines, ok)
      real(wp), intent(in)  :: d(:), tau(:), p(:) !! (points) [length], [stress], [pressure]
      logical, intent(in)   :: belongs(:, :)      !! (points, curves)
      real(wp), intent(out) :: lines(2, 3)        !! a_k1 and a_k2 for k = 1, 2, 3
      logical, intent(out)  :: ok
      real(wp), allocatable :: matrix(:, :), x(:)

      lines = 0.0_wp
      ok = 6 + size(belongs, 2) <= size(d)
      if (.not. ok) return
      allocate (matrix(size(d), 6 + size(belongs, 2)), x(6 + size(belongs, 2)))
      matrix(:, 1:3) = cubic_terms(d)
      matrix(:, 4:6) = spread(p, 2, 3)*matrix(:, 1:3)
      matrix(:, 7:) = merge(1.0_wp, 0.0_wp, belongs)
      call solve_least_squares(matrix, tau, x, ok)
      lines(1, :) = x(1:3)
      lines(2, :) = x(4:6)
   end subroutine fit_cubic_in_pressure

   !> d, d^2 and d^3 of every point.
   pure function cubic_terms(d) result(terms)
      real(wp), intent(in) :: d(:)
      real(wp) :: terms(size(d), 3)

      terms = reshape([d, d*d, d*(d*d)], [size(d), 3])
   end function cubic_terms

   !> Set the coefficients of a line (a_k1, a_k2) to zero where they are rounding: a share of the stress far below its last digit.
   pure subroutine drop_rounding(line, p, d_power, tau)
      real(wp), intent(inout) :: line(2)
      real(wp), intent(in)    :: p, d_power, tau !! largest p, d^k and |tau| of the data

      where (abs(line)*[1.0_wp, p]*d_power <= zero_coefficient*tau) line = 0.0_wp
   end subroutine drop_rounding

   !> Residual of tau about the law with LINES; where the branch has constants, each curve takes its best constant.
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
         do i = 1, size(fit%start)
            where (fit%curve == i) off = off - sum(off, fit%curve == i)/count(fit%curve == i)
         end do
      end if
      residual = residual_of(off)
   end function law_residual

   !> Residual of deviations OFF from a fit.
   pure function residual_of(off) result(residual)
      real(wp), intent(in) :: off(:) !! not empty
      type(residual_type) :: residual

      residual%rms = norm2(off)/sqrt(real(size(off), wp))
      residual%at = maxloc(abs(off), 1)
      residual%largest = abs(off(residual%at))
   end function residual_of

end module branch_fit
