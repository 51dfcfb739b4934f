!> Coulomb slip in the plane of the joint along a straight way: the stress turns towards the movement within the increment.
!! Without slip the stress would grow by {gain} in proportion to the way f. It sticks up to f_s, where it meets the limit l = mu p,
!! which is linear in f too. From there on it stays at the limit and
!!
!!    l d{n}/df = {gain} - {n} ({n} . {gain})        {n} its direction, theta the angle of {n} to {gain}
!!    tan(theta/2) = tan(theta_s/2) exp(-x)          x = |gain| (1 - f_s)/l, with the mean of l
!!
!! This is exact at constant pressure; NEWTON and the loops of BACKBONE follow it. A return of the stress at the end of the increment,
!! along a line, is of first order in the increments only. Source: R. D. Krieg, D. B. Krieg, J. Pressure Vessel Technol. 99 (1977)
!! 510-515, for the yield surface of von Mises.
module slip_path
   use kinds, only: wp
   use tolerances, only: no_stress_direction, no_turn
   implicit none
   private

   public :: turn_slip, meet_limit, return_to_limit

   real(wp), parameter :: far = 100.0_wp    ! x of a stress that has turned entirely

contains

   !> The stress TAU at the end of a way on which an element slips, from the stress BEFORE, with the limits at both ends.
   pure subroutine turn_slip(before, gain, limits, tau, by_gain, by_limit)
      real(wp), intent(in)  :: before(2)     !! [pressure]
      real(wp), intent(in)  :: gain(2)       !! what the stress would grow by without slip; it would end above the limit
      real(wp), intent(in)  :: limits(2)     !! [pressure]; the first one is at least |BEFORE|, which STEP may have left above it
      real(wp), intent(out) :: tau(2)        !! of the size of LIMITS(2)
      real(wp), intent(out) :: by_gain(2, 2) !! d TAU/d GAIN [-]
      real(wp), intent(out) :: by_limit(2)   !! d TAU/d LIMITS(2) [-]
      real(wp) :: b(2), g(2), l(2), unit, begins(2), first, f, f_change(3), e(2), n(2), cosine, sine, x, share
      real(wp) :: size_begins, size_gain, mean, c(0:2)
      real(wp) :: angle(3), turned(3), x_change(3) ! derivatives for the two components of g and for l(2)

      ! relative to a power of two, which changes no digit: squares neither vanish nor exceed the range of numbers
      unit = scale(1.0_wp, exponent(max(maxval(abs(before)), maxval(abs(gain)), maxval(limits))))
      b = before/unit
      g = gain/unit
      l = limits/unit
      tau = 0.0_wp
      by_gain = 0.0_wp
      by_limit = g/max(norm2(g), tiny(1.0_wp))
      if (l(2) <= 0.0_wp) return
      first = max(l(1), norm2(b))
      if (norm2(g) <= no_turn*l(2)) then ! along a line; the angle between both is the square of NO_TURN
         call return_to_limit(b + g, l(2), tau, by_gain, by_limit)
         tau = unit*tau
         return
      else if (4.0_wp*far*max(first, l(2)) <= norm2(g)) then ! x is beyond FAR
         call return_to_limit(g, l(2), tau, by_gain, by_limit)
         tau = unit*tau
         return
      end if

      call meet_limit(b, g, l, f, c)
      begins = b + f*g
      f_change = 0.0_wp
      if (f > 0.0_wp) f_change = -f*[begins, -(first + f*(l(2) - first))]/ &
                                   max(c(1) + c(2)*f, no_stress_direction*first**2)
      size_begins = norm2(begins)
      size_gain = norm2(g)
      n = begins/max(size_begins, tiny(1.0_wp))
      e = g/size_gain
      if (size_begins <= no_stress_direction*l(2)) n = e
      mean = 0.5_wp*(first + f*(l(2) - first) + l(2))
      x = min(far, (1.0_wp - f)*size_gain/mean)
      cosine = dot_product(n, e)
      sine = e(1)*n(2) - e(2)*n(1)
      share = 1.0_wp/max(cosh(x) + cosine*sinh(x), tiny(1.0_wp)) ! sine of the angle at the end, of that at the beginning

      ! rates of the angle of e, of that of n at the beginning, of x
      angle = [-e(2), e(1), 0.0_wp]/size_gain
      turned = angle
      if (size_begins > no_stress_direction*l(2)) turned = [-n(2), n(1), 0.0_wp]*f/size_begins &
                                                 + (n(1)*g(2) - n(2)*g(1))/size_begins*f_change
      x_change = [e, 0.0_wp]*(1.0_wp - f)/mean - size_gain/mean*f_change &
                 - 0.5_wp*x/mean*([0.0_wp, 0.0_wp, 1.0_wp + f] + (l(2) - first)*f_change)
      n = rotated(e, share*(sinh(x) + cosine*cosh(x)), share*sine)
      tau = unit*l(2)*n
      turned = l(2)*((1.0_wp - share)*angle + share*turned - share*sine*x_change)
      by_gain = spread([-n(2), n(1)], 2, 2)*spread(turned(:2), 1, 2)
      by_limit = n + [-n(2), n(1)]*turned(3)
   end subroutine turn_slip

   !> The stress TAU of the size LIMIT along TRIAL, which is above it.
   pure subroutine return_to_limit(trial, limit, tau, by_trial, by_limit)
      real(wp), intent(in)  :: trial(2), limit !! [pressure]
      real(wp), intent(out) :: tau(2)
      real(wp), intent(out) :: by_trial(2, 2)  !! d TAU/d TRIAL [-]
      real(wp), intent(out) :: by_limit(2)     !! d TAU/d LIMIT, the direction of TRIAL [-]

      by_limit = trial/norm2(trial)
      tau = limit*by_limit
      by_trial = limit/norm2(trial)*(reshape([1.0_wp, 0.0_wp, 0.0_wp, 1.0_wp], [2, 2]) &
                                     - spread(by_limit, 2, 2)*spread(by_limit, 1, 2))
   end subroutine return_to_limit

   !> f_s: from there on |BEFORE + f GAIN|**2 - l**2 = c(0) + 2 c(1) f + c(2) f**2 > 0, at most 1.
   pure subroutine meet_limit(before, gain, limits, f, c)
      real(wp), intent(in)  :: before(2), gain(2), limits(2) !! as in turn_slip
      real(wp), intent(out) :: f, c(0:2)
      real(wp) :: first

      first = max(limits(1), norm2(before))
      c = [sum(before**2) - first**2, dot_product(before, gain) - first*(limits(2) - first), sum(gain**2) - (limits(2) - first)**2]
      f = sqrt(max(0.0_wp, c(1)**2 - c(0)*c(2)))
      if (c(1) > 0.0_wp) then
         f = -c(0)/(c(1) + f)
      else
         f = (f - c(1))/max(c(2), tiny(1.0_wp))
      end if
      f = min(f, 1.0_wp)
   end subroutine meet_limit

   !> The unit vector E turned by the angle of this COSINE and SINE.
   pure function rotated(e, cosine, sine) result(n)
      real(wp), intent(in) :: e(2), cosine, sine
      real(wp) :: n(2)

      n = cosine*e + sine*[-e(2), e(1)]
   end function rotated

end module slip_path
