!> Fits the power law lambda = c p^m (Eq. 1) to a normal test: to points of loading, or to stiffnesses k = dp/dlambda at several p.
module normal_fit
   use branch_fit, only: fit_loops, loop_fit_type, residual_of, residual_type
   use data_columns, only: column_k, column_lambda, column_p, data_stiffness, fit_load
   use deck_errors, only: deck_error_list
   use fit_data, only: test_data_type
   use kinds, only: wp
   use normal_curve, only: least_power
   use numbers, only: fit_line, solve_least_squares
   use text_tools, only: one_of, real_text
   use tolerances, only: m_at_one, settled_curve
   implicit none
   private

   public :: fit_normal_test, fit_power_law, fit_proportional, fit_stiffness, check_residual

   real(wp), parameter :: much = 0.05_wp ! a residual above this share of the largest reading is reported
   real(wp), parameter :: largest_power = 300.0_wp ! of e: beyond it values are no readings
   integer, parameter  :: most_steps = 200, most_halvings = 60

   type, public :: normal_fit_type
      real(wp) :: c = 0.0_wp, m = 0.0_wp           !! lambda = c p^m
      integer  :: n_points = 0
      real(wp) :: p_low = 0.0_wp, p_high = 0.0_wp  !! [pressure]
      character(6) :: reading = 'lambda'           !! or k
      real(wp) :: high = 0.0_wp            !! largest lambda [length] or k [pressure/length]
      type(residual_type) :: residual              !! of the reading
      real(wp) :: p_largest = 0.0_wp               !! p of the largest residual [pressure]
      type(loop_fit_type) :: loops                 !! lines of unloading and reloading
   end type normal_fit_type

contains

   !> Fit the law to the test DATA: c and m to points of loading or to stiffnesses, E_u to the points of unloading and reloading.
   !! Missing data go to ERRORS.
   subroutine fit_normal_test(data, fit, errors, warnings)
      type(test_data_type), intent(in)     :: data
      type(normal_fit_type), intent(inout) :: fit
      type(deck_error_list), intent(inout) :: errors, warnings

      associate (p => data%value(column_p, :data%n), lambda => data%value(column_lambda, :data%n), &
                 k => data%value(column_k, :data%n), branch => data%branch(:data%n))
         call fit_loops(p, lambda, branch, data%run(:data%n), data%joined(:data%n), fit%loops)
         if (data%kind == data_stiffness) then
            call fit_stiffness(p, k, fit, errors, warnings)
            call check_residual('k', 'k', fit%residual%largest, maxval(abs(k)), warnings)
         else
            call fit_normal(pack(p, branch == fit_load), pack(lambda, branch == fit_load), fit, errors, warnings)
            call check_residual('lambda', 'lambda', fit%residual%largest, maxval(abs(lambda)), warnings)
         end if
      end associate
   end subroutine fit_normal_test

   !> Fit c and m to tangent stiffnesses K = p^(1-m)/(m c): the straight line through ln k over ln p, so that a relative error of k
   !! counts the same at every p. m is at most 1.
   subroutine fit_stiffness(p, k, fit, errors, warnings)
      real(wp), intent(in)                 :: p(:) !! [pressure]
      real(wp), intent(in)                 :: k(:) !! [pressure/length]
      type(normal_fit_type), intent(inout) :: fit
      type(deck_error_list), intent(inout) :: errors, warnings
      real(wp) :: line(2), mean
      logical  :: ok

      ok = all(p > 0.0_wp) .and. all(k > 0.0_wp)
      if (.not. ok) call errors%add(0, 'stiffnesses: expected p and k above 0 in every row')
      if (.not. ok) return
      mean = sum(log(p))/size(p)
      call fit_line(log(p) - mean, log(k), line, ok)
      if (.not. ok) call errors%add(0, 'the points do not fix c and m: expected k at two or more different p')
      if (.not. ok) return
      fit%m = 1.0_wp - line(2)
      if (fit%m < least_power) then
         call errors%add(0, 'k grows as p to the power of '//real_text(line(2))//', expected 1 - m, with m at least '// &
                         real_text(least_power)//' and not above 1')
         return
      else if (fit%m > 1.0_wp) then
         if (fit%m > 1.0_wp + m_at_one) call warnings%add(0, 'the fit gives m = '//real_text(fit%m)// &
            ', but the law allows at most 1: m is set to 1')
         fit%m = 1.0_wp
      end if
      fit%c = exp((1.0_wp - fit%m)*mean - line(1))/fit%m
      fit%reading = 'k'
      fit%residual = residual_of(k - p**(1.0_wp - fit%m)/(fit%m*fit%c))
      fit%p_largest = p(fit%residual%at)
      fit%n_points = size(p)
      fit%p_low = minval(p)
      fit%p_high = maxval(p)
      fit%high = maxval(k)
   end subroutine fit_stiffness

   !> Warn where readings lie far off the fit.
   subroutine check_residual(subject, reading, residual, largest, warnings)
      character(*), intent(in)             :: subject, reading  !! 'LOAD: tau', 'tau'
      real(wp), intent(in)                 :: residual, largest !! largest deviation from the law; largest reading
      type(deck_error_list), intent(inout) :: warnings

      if (residual > much*largest) call warnings%add(0, subject//' lies up to '//real_text(residual)//' off the law on the card'// &
         ', more than 5 % of the largest '//reading//', '//real_text(largest))
   end subroutine check_residual

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
         if (fit%m > 1.0_wp + m_at_one) call warnings%add(0, 'the fit gives m = '//real_text(fit%m)// &
            ', but the law allows at most 1: m is set to 1; --zero or --seat if the readings do not begin at zero')
         fit%m = 1.0_wp
         fit%c = fit_proportional(p, lambda)
      end if
      fit%residual = residual_of(lambda - fit%c*max(p, 0.0_wp)**fit%m)
      fit%p_largest = p(fit%residual%at)
      fit%n_points = size(p)
      fit%p_low = minval(p)
      fit%p_high = maxval(p)
      fit%high = maxval(lambda)
      if (size(fit%loops%lines) == 0) return
      slope = fit%p_high**(1.0_wp - fit%m)/(fit%m*fit%c)
      if (fit%loops%e_u <= 0.0_wp) then
         call warnings%add(0, 'lambda does not fall with p in unloading: EU is left blank')
      else if (fit%loops%e_u < slope) then ! unloading is less steep than loading
         call warnings%add(0, 'E_u = '//real_text(fit%loops%e_u)//' is below the slope of the loading curve at p = '// &
                           real_text(fit%p_high)//', '//real_text(slope)//': unloading would be less steep than loading'// &
                           one_of(fit%loops%e_u < fit%m*slope, ', and the set would be negative', ''))
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
         if (maxval(abs(step)) <= settled_curve) exit
      end do
      m = q(2)
      ok = ok .and. k <= most_steps .and. abs(q(1) - m*mean) < largest_power
      if (.not. ok) return
      c = exp(q(1) - m*mean)

   contains

      real(wp) function sum_of_squares(trial) result(total)
         real(wp), intent(in) :: trial(2)

         total = huge(total)
         if (maxval(abs(trial(1) + trial(2)*x)) < largest_power) total = sum((exp(trial(1) + trial(2)*x) - y)**2)
      end function sum_of_squares

   end subroutine fit_power_law

   !> The c of lambda = c p, the law with m = 1 [length/pressure].
   pure real(wp) function fit_proportional(p, lambda) result(c)
      real(wp), intent(in) :: p(:), lambda(:)

      c = dot_product(p, lambda)/dot_product(p, p)
   end function fit_proportional

end module normal_fit
