!> The power law of the normal deflection, lambda = c p^m (Eq. 1), from test points.
module normal_fit
   use branch_fit, only: loop_fit_type
   use deck_errors, only: deck_error_list
   use kinds, only: wp
   use least_squares, only: fit_line, solve_least_squares
   use normal_curve, only: least_power
   use text_tools, only: real_text
   implicit none
   private

   public :: fit_normal, fit_power_law, fit_proportional

   integer, parameter  :: most_steps = 200, most_halvings = 60
   real(wp), parameter :: settled = 1.0e-14_wp   ! change of ln c and m in one step
   real(wp), parameter :: m_rounding = 1.0e-9_wp ! an m above 1 by less is 1

   type, public :: normal_fit_type
      real(wp) :: c = 0.0_wp, m = 0.0_wp           !! lambda = c p^m
      integer  :: n_points = 0
      real(wp) :: p_low = 0.0_wp, p_high = 0.0_wp  !! [pressure]
      real(wp) :: lambda_high = 0.0_wp             !! [length]
      real(wp) :: rms = 0.0_wp, largest = 0.0_wp, p_largest = 0.0_wp !! residual of lambda [length], and where [pressure]
      type(loop_fit_type) :: loops                 !! the lines of unloading and reloading
   end type normal_fit_type

contains

   !> Fit the power law to points of loading, m being 1 at most. What they lack goes to ERRORS, an m held at 1 to WARNINGS.
   subroutine fit_normal(p, lambda, fit, errors, warnings)
      real(wp), intent(in)                 :: p(:)      !! [pressure]; below 0, in the noise, it counts as 0
      real(wp), intent(in)                 :: lambda(:) !! [length]
      type(normal_fit_type), intent(inout) :: fit
      type(deck_error_list), intent(inout) :: errors, warnings
      real(wp) :: off(size(p)), slope
      integer  :: at
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
      off = abs(lambda - fit%c*max(p, 0.0_wp)**fit%m)
      at = maxloc(off, 1)
      fit%n_points = size(p)
      fit%p_low = minval(p)
      fit%p_high = maxval(p)
      fit%lambda_high = maxval(lambda)
      fit%rms = norm2(off)/sqrt(real(size(p), wp))
      fit%largest = off(at)
      fit%p_largest = p(at)
      if (size(fit%loops%lines) == 0) return
      slope = fit%p_high**(1.0_wp - fit%m)/(fit%m*fit%c)
      if (fit%loops%e_u <= 0.0_wp) then
         call warnings%add(0, 'lambda does not fall with p in unloading: EU is left blank')
      else if (fit%loops%e_u < slope) then ! unloaded less steeply than loaded
         call warnings%add(0, 'E_u = '//real_text(fit%loops%e_u)//' is below the slope of the loading curve at p = '// &
                           real_text(fit%p_high)//', '//real_text(slope)//': the set would be negative')
      end if
   end subroutine fit_normal

   !> The c and m that make the sum of (c p^m - lambda)^2 least. The straight line through ln lambda over ln p is the start;
   !! then Gauss-Newton in lambda itself, a step that makes the sum larger being halved. Points with p <= 0 or lambda <= 0
   !! have no logarithm: they are left out of the start, and with p <= 0 the law gives zero whatever c and m are.
   !! OK is false where fewer than two different p > 0 have lambda > 0, or the steps do not settle.
   subroutine fit_power_law(p, lambda, c, m, ok)
      real(wp), intent(in)  :: p(:)      !! [pressure]
      real(wp), intent(in)  :: lambda(:) !! [length]
      real(wp), intent(out) :: c         !! [length/pressure^m]
      real(wp), intent(out) :: m         !! [-]
      logical, intent(out)  :: ok
      real(wp), allocatable :: x(:), y(:)
      real(wp) :: line(2), mean
      logical  :: above(size(p))

      c = 0.0_wp
      m = 0.0_wp
      above = p > 0.0_wp .and. lambda > 0.0_wp
      ok = count(above) >= 2
      if (.not. ok) return
      x = log(pack(p, above))
      y = log(pack(lambda, above))
      mean = sum(x)/size(x)      ! at the mean of ln p the two unknowns hardly depend on each other
      call fit_line(x - mean, y, line, ok)
      if (.not. ok) return
      call gauss_newton(log(pack(p, p > 0.0_wp)) - mean, pack(lambda, p > 0.0_wp), line, ok)
      m = line(2)
      c = exp(line(1) - m*mean)
   end subroutine fit_power_law

   !> From the start Q, the Q that makes the sum of (exp(Q(1) + Q(2) x) - lambda)^2 least.
   subroutine gauss_newton(x, lambda, q, ok)
      real(wp), intent(in)    :: x(:), lambda(:)
      real(wp), intent(inout) :: q(2)
      logical, intent(out)    :: ok
      real(wp) :: jacobian(size(x), 2), law(size(x)), step(2), now, before
      integer  :: halvings, k

      before = sum_of_squares(q)
      do k = 1, most_steps
         law = exp(q(1) + q(2)*x)
         jacobian(:, 1) = law
         jacobian(:, 2) = law*x
         call solve_least_squares(jacobian, lambda - law, step, ok)
         if (.not. ok) return
         do halvings = 1, most_halvings
            now = sum_of_squares(q + step)
            if (now <= before) exit
            step = 0.5_wp*step
         end do
         if (now > before) return     ! no direction downhill is left: q is the least to rounding
         q = q + step
         before = now
         if (maxval(abs(step)) <= settled) return
      end do
      ok = .false.

   contains

      real(wp) function sum_of_squares(trial) result(total)
         real(wp), intent(in) :: trial(2)

         total = huge(total)
         if (maxval(abs(trial(1) + trial(2)*x)) < 300.0_wp) total = sum((exp(trial(1) + trial(2)*x) - lambda)**2)
      end function sum_of_squares

   end subroutine gauss_newton

   !> The c of lambda = c p, the law with m = 1 [length/pressure].
   pure real(wp) function fit_proportional(p, lambda) result(c)
      real(wp), intent(in) :: p(:), lambda(:)

      c = dot_product(p, lambda)/dot_product(p, p)
   end function fit_proportional

end module normal_fit
