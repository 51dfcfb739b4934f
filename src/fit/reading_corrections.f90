!> Corrects the readings of a normal test: takes off the compression of the specimens between the gauges, and finds the offset of a
!! test that was zeroed under load, or of a gauge that was not at zero.
!! With an offset the loading curve is lambda = c p^m + l0 (lambda alone counts from the seating load, or from anywhere), or
!! lambda = c ((p + ps)^m - ps^m) (lambda and p both count from the seating pressure ps). The better of the two is taken. An F test
!! compares it with the law without offset: F = (S0 - S1)/(S1/(n - 3)), S the sum of squares of the n readings.
module reading_corrections
   use data_columns, only: column_k, column_lambda, column_p, data_normal, data_stiffness, fit_load
   use deck_errors, only: deck_error_list
   use fit_command, only: fit_command_type
   use fit_data, only: test_data_type
   use kinds, only: wp
   use normal_curve, only: least_power
   use normal_fit, only: fit_power_law, fit_proportional
   use numbers, only: solve_least_squares
   use text_tools, only: one_of, plural, real_text
   use tolerances, only: m_at_one, settled_offset
   implicit none
   private

   public :: take_off_specimens, take_off_seat, find_offset

   integer, parameter  :: fewest = 5                           ! points for three unknowns and an F test
   integer, parameter  :: most_steps = 200, most_halvings = 50
   real(wp), parameter :: much_m = 0.02_wp, much_c = 0.05_wp   ! changes of m and c (relative) below which an offset is not told

   !> The offset of the readings of a test: the law is that of LAMBDA + l0 over P + p0.
   type, public :: offset_type
      logical  :: is_found = .false.
      logical  :: of_p = .false.                  !! p counts from the seating load too
      real(wp) :: p = 0.0_wp, lambda = 0.0_wp     !! to be added to the readings [pressure], [length]
      real(wp) :: c = 0.0_wp, m = 0.0_wp          !! with the offset
      real(wp) :: m_before = 0.0_wp, c_before = 0.0_wp !! without
      real(wp) :: rms = 0.0_wp, rms_before = 0.0_wp !! of lambda
      real(wp) :: f = 0.0_wp, f_chance = 0.0_wp   !! the F of the test; exceeded by chance in one test of 1000
   end type offset_type

contains

   !> Take the compression of the specimens under p off lambda of DATA, and out of stiffnesses, where the command gives it.
   subroutine take_off_specimens(data, command, errors)
      type(test_data_type), intent(inout)  :: data
      type(fit_command_type), intent(in)   :: command
      type(deck_error_list), intent(inout) :: errors
      real(wp) :: stiffest

      if (command%bulk <= 0.0_wp .or. errors%any()) return
      associate (p => data%value(column_p, :data%n), lambda => data%value(column_lambda, :data%n), &
                 k => data%value(column_k, :data%n))
         select case (data%kind)
         case (data_normal)
            lambda = lambda - command%bulk*p
         case (data_stiffness)
            stiffest = maxval(k)
            if (stiffest*command%bulk >= 1.0_wp) call errors%add(0, '--bulk: k is up to '//real_text(stiffest)// &
               ', and the specimens alone have '//real_text(1.0_wp/command%bulk)//': expected E and H in the units of the cards')
            if (errors%any()) return
            k = k/(1.0_wp - command%bulk*k)
         case default
            call errors%add(0, '--bulk is for normal tests')
            return
         end select
      end associate
      call data%notes%add(0, 'compression of the specimens taken off: lambda less '//real_text(command%bulk)//' p (--bulk)')
   end subroutine take_off_specimens

   !> Find the offset of the points of loading of a normal test. With --seat it is taken off all readings of DATA, of all its tests;
   !! without, a significant one that changes c or m is told.
   subroutine take_off_seat(data, command, errors)
      type(test_data_type), intent(inout)  :: data
      type(fit_command_type), intent(in)   :: command
      type(deck_error_list), intent(inout) :: errors
      type(offset_type) :: offset
      character(:), allocatable :: words

      if (errors%any()) return
      if (command%seat .and. data%kind /= data_normal) call errors%add(0, '--seat is for points of normal tests, lambda and p')
      if (data%kind /= data_normal) return
      associate (loading => data%branch(:data%n) == fit_load)
         call find_offset(pack(data%value(column_p, :data%n), loading), pack(data%value(column_lambda, :data%n), loading), offset)
      end associate
      if (command%seat .and. .not. offset%is_found) call errors%add(0, '--seat: the points do not fix c, m and an offset: '// &
         'expected '//plural(fewest, 'point')//' of loading or more, along a curve with m below 1')
      if (.not. offset%is_found) return
      words = real_text(offset%p)//' added to p, '//real_text(offset%lambda)//' to lambda'
      if (command%seat) then
         data%value(column_p, :data%n) = data%value(column_p, :data%n) + offset%p
         data%value(column_lambda, :data%n) = data%value(column_lambda, :data%n) + offset%lambda
         call data%notes%add(0, words//' (--seat); rms of lambda '//real_text(offset%rms)//' in place of '// &
                             real_text(offset%rms_before))
         call data%notes%add(0, 'the offset is '//one_of(offset%f > offset%f_chance, 'significant', 'not significant')// &
                             ': F = '//real_text(offset%f)//', by chance in 1 of 1000 tests above '//real_text(offset%f_chance))
      else if (offset%f > offset%f_chance .and. (abs(offset%m - offset%m_before) > much_m .or. &
                                                 abs(offset%c - offset%c_before) > much_c*offset%c_before)) then
         call data%warnings%add(0, 'the readings fit better with an offset, '//words//': rms of lambda '//real_text(offset%rms)// &
            ' in place of '//real_text(offset%rms_before)//', m = '//real_text(offset%m)//' in place of '// &
            real_text(offset%m_before)//' (F = '//real_text(offset%f)//', by chance in 1 of 1000 tests above '// &
            real_text(offset%f_chance)//'); --seat takes it, where the test was zeroed under load or a gauge was not at zero')
      end if
   end subroutine take_off_seat

   !> The offset with which points of loading fit the law best. Nothing is found with too few points, or where no such law has a
   !! smaller sum of squares.
   subroutine find_offset(p, lambda, offset)
      real(wp), intent(in)           :: p(:), lambda(:) !! [pressure], [length]
      type(offset_type), intent(out) :: offset
      type(offset_type) :: other
      real(wp) :: q(3), s(2), s_before, scale
      integer  :: k, n
      logical  :: ok

      n = size(p)
      if (n < fewest) return
      scale = maxval(p)
      if (scale <= 0.0_wp .or. maxval(lambda) <= 0.0_wp) return
      call fit_power_law(p, lambda, other%c_before, other%m_before, ok)
      if (.not. (ok .and. other%m_before > 0.0_wp .and. other%m_before <= 1.0_wp)) then
         other%m_before = 1.0_wp
         other%c_before = fit_proportional(p, lambda)
      end if
      s_before = sum((other%c_before*max(p, 0.0_wp)**other%m_before - lambda)**2)
      s = s_before
      do k = 1, 2
         call fit_three(max(p/scale, 0.0_wp), lambda, k == 2, q, s(k), ok)
         if (.not. ok .or. s(k) >= minval([s_before, s(:k - 1)])) cycle
         offset = other
         offset%is_found = .true.
         offset%of_p = k == 2
         offset%m = q(2)
         offset%c = exp(q(1))/scale**q(2)
         if (k == 1) offset%lambda = -q(3)
         if (k == 2) offset%p = scale*exp(q(3))
         if (k == 2) offset%lambda = exp(q(1))*exp(q(3))**q(2)
         offset%rms = sqrt(s(k)/n)
         offset%f = (s_before - s(k))*(n - 3)/max(s(k), tiny(s))
      end do
      offset%rms_before = sqrt(s_before/n)
      offset%f_chance = chance_limit(n - 3)
   end subroutine find_offset

   !> Fit Q = (ln a, m, l0) of lambda = a p^m + l0, or, where P COUNTS from the seating load too, Q = (ln a, m, ln ps) of
   !! lambda = a ((p + ps)^m - ps^m), by Gauss-Newton steps from the best point of a grid; a step that increases the sum of squares
   !! S is halved. OK is false where m is not that of a joint, or the steps do not converge.
   subroutine fit_three(p, lambda, counts, q, s, ok)
      real(wp), intent(in)  :: p(:)      !! relative to the largest, 0 to 1
      real(wp), intent(in)  :: lambda(:) !! [length]
      logical, intent(in)   :: counts
      real(wp), intent(out) :: q(3), s
      logical, intent(out)  :: ok
      real(wp) :: before, step(3), trial(3)
      integer  :: halvings, k

      call search(p, lambda, counts, q, s)
      ok = s < huge(s)
      if (.not. ok) return
      do k = 1, most_steps
         call solve_least_squares(jacobian(p, counts, q), lambda - curve(p, counts, q), step, ok)
         if (.not. ok) return
         before = s
         do halvings = 1, most_halvings
            trial = q + step
            s = sum_of_squares(trial)
            if (s <= before) exit
            step = 0.5_wp*step
         end do
         if (s > before) s = before
         if (halvings > most_halvings) exit ! no direction of descent is left: q is the minimum to rounding
         q = trial
         if (maxval(abs(step)) <= settled_offset*max(1.0_wp, maxval(abs(q)))) exit
      end do
      ok = k <= most_steps .and. q(2) >= least_power .and. q(2) <= 1.0_wp - m_at_one

   contains

      !> Huge where the unknowns are beyond all bounds.
      real(wp) function sum_of_squares(q) result(total)
         real(wp), intent(in) :: q(3)

         total = huge(total)
         if (abs(q(1)) > 300.0_wp .or. q(2) <= 0.0_wp .or. q(2) > 3.0_wp) return
         if (counts .and. (q(3) < -40.0_wp .or. q(3) > 10.0_wp)) return
         total = sum((curve(p, counts, q) - lambda)**2)
      end function sum_of_squares

   end subroutine fit_three

   !> The point BEST of a grid of m and ps with the LEAST sum of squares, each with its best a and l0; see fit_three.
   subroutine search(p, lambda, counts, best, least)
      real(wp), intent(in)  :: p(:), lambda(:)
      logical, intent(in)   :: counts
      real(wp), intent(out) :: best(3), least
      real(wp) :: a(2), m, ps, total
      integer  :: i, j
      logical  :: ok

      least = huge(least)
      best = 0.0_wp
      do j = 1, merge(17, 1, counts)
         ps = 10.0_wp**(0.25_wp*(j - 14))      ! 5.6E-4 to 5.6
         do i = 1, 19
            m = 0.05_wp*i
            if (counts) then
               associate (g => (p + ps)**m - ps**m)
                  a = [dot_product(g, lambda)/dot_product(g, g), 0.0_wp]
                  total = sum((a(1)*g - lambda)**2)
               end associate
            else
               call solve_least_squares(reshape([p**m, 0.0_wp*p + 1.0_wp], [size(p), 2]), lambda, a, ok)
               if (.not. ok) cycle
               total = sum((a(1)*p**m + a(2) - lambda)**2)
            end if
            if (a(1) <= 0.0_wp .or. total >= least) cycle
            least = total
            best = [log(a(1)), m, merge(log(ps), a(2), counts)]
         end do
      end do
   end subroutine search

   !> The lambda of the unknowns Q at each P; see fit_three.
   pure function curve(p, counts, q) result(f)
      real(wp), intent(in) :: p(:), q(3)
      logical, intent(in)  :: counts
      real(wp) :: f(size(p))

      if (counts) then
         f = exp(q(1))*((p + exp(q(3)))**q(2) - exp(q(3))**q(2))
      else
         f = exp(q(1))*p**q(2) + q(3)
      end if
   end function curve

   !> The derivatives of the curve with respect to each of Q.
   pure function jacobian(p, counts, q) result(j)
      real(wp), intent(in) :: p(:), q(3)
      logical, intent(in)  :: counts
      real(wp) :: j(size(p), 3), x(size(p)), ps

      if (counts) then
         ps = exp(q(3))
         x = p + ps
         j(:, 1) = exp(q(1))*(x**q(2) - ps**q(2))
         j(:, 2) = exp(q(1))*(x**q(2)*log(x) - ps**q(2)*log(ps))
         j(:, 3) = exp(q(1))*q(2)*ps*(x**(q(2) - 1.0_wp) - ps**(q(2) - 1.0_wp))
      else
         x = max(p, tiny(p))
         j(:, 1) = exp(q(1))*x**q(2)
         j(:, 2) = j(:, 1)*log(x)
         j(:, 3) = 1.0_wp
      end if
   end function jacobian

   !> The F of one numerator and NU denominator degrees of freedom that chance exceeds in one of 1000 tests: the square of Student's
   !! t at 0.9995. Source: Abramowitz and Stegun, 26.7.5, to 1 % from 6 degrees on; below 6 the values of tables.
   pure real(wp) function chance_limit(nu) result(f)
      integer, intent(in) :: nu
      real(wp), parameter :: z = 3.2905267_wp, small(5) = [636.619_wp, 31.599_wp, 12.924_wp, 8.610_wp, 6.869_wp]
      real(wp), parameter :: g1 = (z**3 + z)/4, g2 = (5*z**5 + 16*z**3 + 3*z)/96, &
                             g3 = (3*z**7 + 19*z**5 + 17*z**3 - 15*z)/384, &
                             g4 = (79*z**9 + 776*z**7 + 1482*z**5 - 1920*z**3 - 945*z)/92160
      real(wp) :: n

      n = real(max(nu, 1), wp)
      f = (z + (g1 + (g2 + (g3 + g4/n)/n)/n)/n)**2
      if (nu <= size(small)) f = small(max(nu, 1))**2
   end function chance_limit

end module reading_corrections
