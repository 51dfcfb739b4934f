!> Fits the laws of one surface to its test data: the shear branches and the power law lambda = c p^m (Eq. 1).
!! Warns where the slope of a fitted cubic turns negative in the range of the card: a joint has no negative stiffness.
module surface_fit
   use branch_cubic, only: cubic
   use branch_fit, only: branch_fit_type, fault_dependent, fault_few_points, fault_none, fault_one_pressure, fit_lines_only, &
                         fit_loops, fit_points, loop_fit_type, residual_of, residual_type
   use data_columns, only: branch_words, column_c, column_d, column_lambda, column_p, column_tau, data_normal, data_shear, &
                           fit_load, fit_reload, fit_unload
   use deck_errors, only: deck_error_list
   use field_rules, only: largest_size, smallest_size
   use fit_command, only: fit_command_type
   use fit_data, only: test_data_type
   use kinds, only: wp
   use normal_curve, only: least_power
   use numbers, only: fit_line, solve_least_squares
   use shear_loops, only: loop_closure, wide_gap, worst_closure
   use shear_stiffness, only: shear_law
   use text_tools, only: plural, real_text
   implicit none
   private

   public :: fit_surface, fit_power_law, fit_proportional, check_slopes, find_slope_loss

   real(wp), parameter :: much = 0.05_wp ! a residual above this share of the largest reading is reported

   type, public :: normal_fit_type
      real(wp) :: c = 0.0_wp, m = 0.0_wp           !! lambda = c p^m
      integer  :: n_points = 0
      real(wp) :: p_low = 0.0_wp, p_high = 0.0_wp  !! [pressure]
      real(wp) :: lambda_high = 0.0_wp             !! [length]
      type(residual_type) :: residual              !! of lambda [length]
      real(wp) :: p_largest = 0.0_wp               !! p of the largest residual [pressure]
      type(loop_fit_type) :: loops                 !! lines of unloading and reloading
   end type normal_fit_type

   type, public :: surface_fit_type
      integer :: kind = 0                          !! data_normal, or a shear law
      type(branch_fit_type) :: branch(3)           !! load, unload, reload of the card; n_points 0: no data
      integer  :: source(3) = 0                    !! branch of the data used for each branch of the card
      real(wp) :: card(2, 3, 3) = 0.0_wp           !! (., k, branch): a_k1 and a_k2 for the card
      logical  :: has_loading = .false.            !! false: the card is incomplete
      real(wp) :: p_max = 0.0_wp                   !! range of the loading data [pressure]
      real(wp) :: d_max = 0.0_wp                   !! [length], 0: unknown
      type(loop_closure) :: closure                !! of the law on the card
      type(normal_fit_type) :: normal
      type(deck_error_list) :: warnings
   end type surface_fit_type

   integer, parameter  :: most_steps = 200, most_halvings = 60
   real(wp), parameter :: settled = 1.0e-14_wp   ! change of ln c and m in one step
   real(wp), parameter :: m_rounding = 1.0e-9_wp ! an m above 1 by less counts as 1

contains

   !> Fit the law of the surface in DATA. Missing data go to ERRORS.
   subroutine fit_surface(data, command, fit, errors)
      type(test_data_type), intent(in)     :: data
      type(fit_command_type), intent(in)   :: command
      type(surface_fit_type), intent(out)  :: fit
      type(deck_error_list), intent(inout) :: errors
      type(shear_law) :: law
      real(wp) :: largest, smallest, positive(4)
      integer  :: from(3) ! branch of the card for each branch of the law

      fit%kind = data%kind
      fit%warnings = data%warnings
      if (data%kind /= data_normal) then
         call fit_shear(data, command, fit, errors)
      else if (command%only > 0) then
         call errors%add(0, 'points of normal tests have no branch: --branch is for shear tests')
      else
         associate (p => data%value(column_p, :data%n), lambda => data%value(column_lambda, :data%n), &
                    branch => data%branch(:data%n))
            call fit_loops(p, lambda, branch, data%run(:data%n), data%joined(:data%n), fit%normal%loops)
            call fit_normal(pack(p, branch == fit_load), pack(lambda, branch == fit_load), fit%normal, errors, fit%warnings)
            call check_residual('lambda', 'lambda', fit%normal%residual%largest, maxval(abs(lambda)), fit%warnings)
         end associate
      end if
      if (errors%any()) return
      largest = max(fit%normal%c, fit%normal%loops%e_u, maxval(abs(fit%card)), fit%p_max, fit%d_max)
      if (.not. largest <= largest_size) call errors%add(0, 'the law that fits these data has a number of '//real_text(largest)// &
         ', and a deck accepts at most '//real_text(largest_size)//': are the units right, and --dmax?')
      positive = [fit%normal%c, fit%normal%loops%e_u, fit%p_max, fit%d_max] ! zero: not fitted, its field is blank
      smallest = minval(positive, mask=positive > 0.0_wp)
      if (smallest < smallest_size) call errors%add(0, 'the law that fits these data has a number of '//real_text(smallest)// &
         ', and a deck accepts none below '//real_text(smallest_size)//': are the units right?')
      if (errors%any() .or. .not. fit%has_loading) return
      from = merge([fit_load, fit_unload, fit_reload], fit_load, fit%branch%n_points > 0)
      law = shear_law(given=.true., load=cubic(fit%card(:, :, fit_load)), unload=cubic(fit%card(:, :, from(fit_unload))), &
                      reload=cubic(fit%card(:, :, from(fit_reload))), p_max=fit%p_max)
      if (fit%d_max > 0.0_wp) law%d_max = fit%d_max
      fit%closure = worst_closure(law, fit%p_max)
      if (fit%closure%is_known .and. fit%closure%share > wide_gap) &
         call fit%warnings%add(0, 'reloading misses point A by more than 5 % of tau_r: cycles under one load creep')
   end subroutine fit_surface

   !> Fit the branches of the shear law.
   subroutine fit_shear(data, command, fit, errors)
      type(test_data_type), intent(in)      :: data
      type(fit_command_type), intent(in)    :: command
      type(surface_fit_type), intent(inout) :: fit
      type(deck_error_list), intent(inout)  :: errors
      type(branch_fit_type) :: nothing
      integer :: b

      fit%source = [1, 2, 3]
      if (command%only > 0) then
         fit%source = 0
         fit%source(command%as) = command%only
         if (count(data%branch(:data%n) == command%only) == 0) then
            call errors%add(0, 'no '//trim(branch_words(command%only))//' data: --branch asks for them')
            return
         end if
      end if
      do b = fit_load, fit_reload
         if (count(data%branch(:data%n) == fit%source(b)) == 0) cycle
         if (data%is_record .and. b /= fit_load) then      ! a record may contain a short part of a branch
            call fit_branch(data, command, fit%source(b), fit%branch(b), fit%warnings)
            if (fit%branch(b)%fault /= fault_none) fit%branch(b) = nothing
         else
            call fit_branch(data, command, fit%source(b), fit%branch(b), errors)
         end if
         fit%card(:, :, b) = fit%branch(b)%lines
         if (.not. fit%branch(b)%from_points) cycle
         if (command%fit%one_step) fit%card(:, :, b) = fit%branch(b)%joint
         call check_residual(trim(branch_words(fit%source(b)))//': tau', 'tau', merge(fit%branch(b)%of_joint%largest, &
                             fit%branch(b)%of_lines%largest, command%fit%one_step), maxval(abs(data%value(column_tau, :data%n))), &
                             fit%warnings)
      end do
      associate (load => fit%branch(fit_load))
         fit%has_loading = load%n_points > 0
         fit%p_max = load%p_high
         if (load%from_points) fit%d_max = max(abs(load%d_low), abs(load%d_high))
      end associate
      if (command%fit%one_step .and. .not. data%kind == data_shear) &
         call fit%warnings%add(0, 'the cubics are given, there are no points for --joint-fit: the lines are on the card')
      if (command%d_max > 0.0_wp) fit%d_max = command%d_max
   end subroutine fit_shear

   !> Warn where readings lie far off the fit.
   subroutine check_residual(subject, reading, residual, largest, warnings)
      character(*), intent(in)             :: subject, reading  !! 'LOAD: tau', 'tau'
      real(wp), intent(in)                 :: residual, largest !! largest deviation from the law; largest reading
      type(deck_error_list), intent(inout) :: warnings

      if (residual > much*largest) call warnings%add(0, subject//' lies up to '//real_text(residual)//' off the law on the card'// &
         ', more than 5 % of the largest '//reading//', '//real_text(largest))
   end subroutine check_residual

   !> Fit a branch of the card to the rows of branch SOURCE.
   subroutine fit_branch(data, command, source, fit, errors)
      type(test_data_type), intent(in)     :: data
      type(fit_command_type), intent(in)   :: command
      integer, intent(in)                  :: source
      type(branch_fit_type), intent(out)   :: fit
      type(deck_error_list), intent(inout) :: errors
      integer, allocatable :: rows(:)
      character(:), allocatable :: help, name
      integer :: i
      logical :: met(data%n)

      rows = pack([(i, i = 1, data%n)], data%branch(:data%n) == source)
      name = trim(branch_words(source))
      if (data%kind == data_shear) then
         call fit_rows(rows, data%run(rows))
         met = .false.
         if (fit%fault /= fault_none .and. data%in_order .and. source == fit_reload) met = [(returns(i), i = 1, data%n)]
         if (any(met)) then
            rows = pack([(i, i = 1, data%n)], met .or. data%branch(:data%n) == source)
            call fit_rows(rows, merge(data%run(max(1, rows - 1)), data%run(rows), met(rows)))
         end if
      else
         call fit_lines_only(data%value(column_c, rows), data%value(column_p, rows), command%fit%one_pressure, fit)
      end if
      fit%row = rows
      help = ''                   ! where measured pressures are close to each other but count as different
      associate (p => fit%group_p, n => size(fit%group_p))
         if (any(p(2:) < 1.05_wp*p(:n - 1))) help = ', --p-tolerance 0.05 counts pressures within 5 % as one'
      end associate
      select case (fit%fault)
      case (fault_one_pressure)
         call errors%add(data%line(rows(1)), name//': all data at one pressure, p = '//real_text(fit%p_high)// &
                         ', expected two pressures or more; --one-pressure makes a card that does not depend on the pressure')
      case (fault_few_points)
         i = findloc(fit%group, fit%fault_at, 1)
         call errors%add(data%line(rows(i)), name//', p = '//real_text(fit%group_p(fit%fault_at))//': '// &
                         plural(count(fit%group == fit%fault_at), 'point')//' that fix no cubic, expected '// &
                         trim(merge('four different d or more             ', 'three different d or more, not zero  ', &
                         fit%constant))//'; --joint-fit needs no cubic of each pressure'//help)
      case (fault_dependent)
         call errors%add(data%line(rows(1)), name//': '//plural(size(rows), 'point')// &
                         ' that do not fix the coefficients: expected more different d and p'//help)
      end select

   contains

      subroutine fit_rows(rows, run)
         integer, intent(in) :: rows(:), run(:)

         call fit_points(data%value(column_d, rows), data%value(column_tau, rows), data%value(column_p, rows), run, &
                         source /= fit_load, command%fit, fit)
      end subroutine fit_rows

      !> Whether reloading returns to point A at row I: it is a point of loading, and also of reloading where reloading has few
      !! points.
      logical function returns(i)
         integer, intent(in) :: i
         integer :: a

         returns = .false.
         if (i == 1) return
         if (data%branch(i) /= fit_load .or. data%branch(i - 1) /= fit_reload) return
         a = findloc(data%branch(:i - 1), fit_load, 1, back=.true.)
         if (a == 0) return
         associate (d => data%value(column_d, [a, i]))
            returns = abs(d(2) - d(1)) <= 1.0e-6_wp*abs(d(1))
         end associate
      end function returns

   end subroutine fit_branch

   !> Fit the power law to points of loading, with m at most 1. Missing data go to ERRORS, an m held at 1 goes to WARNINGS.
   subroutine fit_normal(p, lambda, fit, errors, warnings)
      real(wp), intent(in)                 :: p(:)      !! [pressure]; noise below 0 counts as 0
      real(wp), intent(in)                 :: lambda(:) !! [length]
      type(normal_fit_type), intent(inout) :: fit
      type(deck_error_list), intent(inout) :: errors, warnings
      real(wp) :: slope
      logical  :: ok

      call fit_power_law(p, lambda, fit%c, fit%m, ok)
      if (.not. ok) then
         call errors%add(0, 'the points do not fix c and m: expected two or more different p above 0 with lambda above 0')
         return
      else if (fit%m < least_power) then
         call errors%add(0, 'lambda does not grow with p: m = '//real_text(fit%m)//', expected at least '// &
                         real_text(least_power)//' and not above 1')
         return
      else if (fit%m > 1.0_wp) then
         if (fit%m > 1.0_wp + m_rounding) call warnings%add(0, 'the fit gives m = '//real_text(fit%m)// &
            ', but the law allows at most 1: m is set to 1; use --zero if the readings do not begin at zero')
         fit%m = 1.0_wp
         fit%c = fit_proportional(p, lambda)
      end if
      fit%residual = residual_of(lambda - fit%c*max(p, 0.0_wp)**fit%m)
      fit%p_largest = p(fit%residual%at)
      fit%n_points = size(p)
      fit%p_low = minval(p)
      fit%p_high = maxval(p)
      fit%lambda_high = maxval(lambda)
      if (size(fit%loops%lines) == 0) return
      slope = fit%p_high**(1.0_wp - fit%m)/(fit%m*fit%c)
      if (fit%loops%e_u <= 0.0_wp) then
         call warnings%add(0, 'lambda does not fall with p in unloading: EU is left blank')
      else if (fit%loops%e_u < slope) then ! unloading is less steep than loading
         call warnings%add(0, 'E_u = '//real_text(fit%loops%e_u)//' is below the slope of the loading curve at p = '// &
                           real_text(fit%p_high)//', '//real_text(slope)//': the set would be negative')
      end if
   end subroutine fit_normal

   !> The c and m that minimize the sum of (c p^m - lambda)^2. The start is the straight line through ln lambda over ln p.
   !! Gauss-Newton steps in lambda follow; a step that increases the sum is halved. Points with p <= 0 or lambda <= 0 have no
   !! logarithm and are left out of the start; for p <= 0 the law is zero for any c and m. OK is false where fewer than two
   !! different p > 0 have lambda > 0, or the steps do not converge.
   subroutine fit_power_law(p, lambda, c, m, ok)
      real(wp), intent(in)  :: p(:)      !! [pressure]
      real(wp), intent(in)  :: lambda(:) !! [length]
      real(wp), intent(out) :: c         !! [length/pressure^m]
      real(wp), intent(out) :: m         !! [-]
      logical, intent(out)  :: ok
      real(wp), allocatable :: jacobian(:, :), law(:), x(:), y(:)
      real(wp) :: before, mean, now, q(2), step(2)  ! q: ln c at the mean of ln p, and m
      logical  :: above(size(p))
      integer  :: halvings, k

      c = 0.0_wp
      m = 0.0_wp
      above = p > 0.0_wp .and. lambda > 0.0_wp
      ok = count(above) >= 2
      if (.not. ok) return
      x = log(pack(p, above))
      mean = sum(x)/size(x)      ! at the mean of ln p the two unknowns are almost independent
      call fit_line(x - mean, log(pack(lambda, above)), q, ok)
      if (.not. ok) return
      x = log(pack(p, p > 0.0_wp)) - mean
      y = pack(lambda, p > 0.0_wp)
      before = sum_of_squares(q)
      do k = 1, most_steps
         law = exp(q(1) + q(2)*x)
         jacobian = reshape([law, law*x], [size(x), 2])
         call solve_least_squares(jacobian, y - law, step, ok)
         if (.not. ok) exit
         do halvings = 1, most_halvings
            now = sum_of_squares(q + step)
            if (now <= before) exit
            step = 0.5_wp*step
         end do
         if (now > before) exit  ! no direction of descent is left: q is the minimum to rounding
         q = q + step
         before = now
         if (maxval(abs(step)) <= settled) exit
      end do
      ok = ok .and. k <= most_steps
      m = q(2)
      c = exp(q(1) - m*mean)

   contains

      real(wp) function sum_of_squares(trial) result(total)
         real(wp), intent(in) :: trial(2)

         total = huge(total)
         if (maxval(abs(trial(1) + trial(2)*x)) < 300.0_wp) total = sum((exp(trial(1) + trial(2)*x) - y)**2)
      end function sum_of_squares

   end subroutine fit_power_law

   !> The c of lambda = c p, the law with m = 1 [length/pressure].
   pure real(wp) function fit_proportional(p, lambda) result(c)
      real(wp), intent(in) :: p(:), lambda(:)

      c = dot_product(p, lambda)/dot_product(p, p)
   end function fit_proportional

   !> Check the slope of every fitted branch in the range of its data and, if it is positive there, in the range of the card: p from
   !! 0 to PMAX, d to DMAX, and d below zero too for unloading and reloading, because these branches extend past zero to the mirror
   !! image of their point A. A branch is followed as in the joint: unloading with decreasing d, the others with increasing d.
   subroutine check_slopes(fit)
      type(surface_fit_type), intent(inout) :: fit
      character(:), allocatable :: words
      integer  :: b, k
      logical  :: lost
      real(wp) :: d, d_max, p, pressures(2), way(2)

      d_max = fit%d_max
      if (d_max <= 0.0_wp) d_max = huge(d_max)
      do b = fit_load, fit_reload
         associate (branch => fit%branch(b))
            if (branch%n_points == 0) cycle
            do k = 1, merge(2, 1, fit%has_loading)
               way = [0.0_wp, d_max]
               if (k == 1) then
                  pressures = [branch%p_low, branch%p_high]
                  if (branch%from_points) way = [branch%d_low, branch%d_high]
                  if (b == fit_load) way(1) = min(way(1), 0.0_wp)
                  words = ', inside the tested range'
               else
                  pressures = [0.0_wp, fit%p_max]
                  if (b /= fit_load .and. fit%d_max > 0.0_wp) way(1) = -d_max
                  words = ', outside the tested range of the branch, but inside the range of the card, which --dmax sets'
               end if
               if (b == fit_unload .and. merge(branch%from_points, fit%d_max > 0.0_wp, k == 1)) way = way([2, 1])
               call find_slope_loss(fit%card(:, :, b), pressures(1), pressures(2), way(1), way(2), lost, p, d)
               if (lost) call fit%warnings%add(0, trim(branch_words(b))//': the slope of tau becomes zero or negative at p = '// &
                                               real_text(p)//', d = '//real_text(d)//words)
               if (lost) exit
            end do
         end associate
      end do
   end subroutine check_slopes

   !> From d = FROM to d = TO, find the first d at which dtau/dd = sum over k of k (a_k1 + a_k2 p) d^(k-1) is not positive for some
   !! p between P_LOW and P_HIGH. The slope is linear in p, so its minimum is at P_LOW or P_HIGH: two quadratics in d decide.
   pure subroutine find_slope_loss(lines, p_low, p_high, from, to, found, p, d)
      real(wp), intent(in)  :: lines(2, 3)   !! a_k1 and a_k2 for k = 1, 2, 3
      real(wp), intent(in)  :: p_low, p_high !! [pressure]
      real(wp), intent(in)  :: from, to      !! [length], TO = +-huge: unbounded
      logical, intent(out)  :: found
      real(wp), intent(out) :: p, d          !! the place, if FOUND
      real(wp) :: a(3), ends(2), discriminant, places(3), q, sense
      logical  :: lost(3)
      integer  :: first, i

      found = .false.
      p = 0.0_wp
      d = 0.0_wp
      ends = [p_low, p_high]
      sense = sign(1.0_wp, to - from)
      do i = 1, 2
         a = lines(1, :) + lines(2, :)*ends(i)
         places = from                            ! the start, and the roots of a1 + 2 a2 d + 3 a3 d^2
         discriminant = a(2)**2 - 3.0_wp*a(3)*a(1)
         q = -(a(2) + sign(sqrt(max(discriminant, 0.0_wp)), a(2)))
         if (discriminant >= 0.0_wp .and. abs(q) > 0.0_wp) then ! the two roots q/(3 a3) and a1/q, without cancellation
            places(2) = a(1)/q
            if (abs(a(3)) > tiny(q)) places(3) = q/(3.0_wp*a(3))
         end if
         lost = (places - from)*sense > 0.0_wp .and. (places - to)*sense <= 0.0_wp
         lost(1) = a(1) + from*(2.0_wp*a(2) + from*3.0_wp*a(3)) <= 0.0_wp
         if (.not. any(lost)) cycle
         first = minloc(abs(places - from), 1, lost)
         if (found .and. abs(places(first) - from) >= abs(d - from)) cycle
         found = .true.
         p = ends(i)
         d = places(first)
      end do
   end subroutine find_slope_loss

end module surface_fit
