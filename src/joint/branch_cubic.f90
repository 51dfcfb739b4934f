!> The cubic of one branch of a shear law: value, slope, secant and work, and its polynomial along a straight path.
!! Source: Edelugo, Eqs. (3)-(7) and Fig. 2: the coefficients are linear in the pressure.
module branch_cubic
   use kinds, only: wp
   use numbers, only: enclosed_zero
   implicit none
   private

   public :: cubic_value, cubic_slope, cubic_slope_derivatives, cubic_secant, cubic_work, cubic_loop
   public :: value_on_way, slope_on_way, deflection_at

   !> P(d) = a_1 d + a_2 d**2 + a_3 d**3, a_k = a_k1 + a_k2 p.
   type, public :: cubic
      real(wp) :: coefficients(2, 3) = 0.0_wp  !! (a_k1 and a_k2, k)
   end type cubic

   real(wp), parameter :: one(0:4) = [1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp] ! as a polynomial
   real(wp), parameter :: exponents(2, 3) = reshape([real(wp) :: 1, 1, 2, 2, 3, 3], [2, 3])

contains

   !> P at D under the pressure P [pressure].
   elemental real(wp) function cubic_value(curve, d, p) result(stress)
      type(cubic), intent(in) :: curve
      real(wp), intent(in)    :: d, p
      real(wp) :: a(3)

      a = at_pressure(curve, p)
      stress = d*(a(1) + d*(a(2) + d*a(3)))
   end function cubic_value

   !> The least d >= 0 at which P is STRESS under the pressure P; where P peaks below STRESS, the peak [length].
   pure real(wp) function deflection_at(curve, stress, p) result(d)
      type(cubic), intent(in) :: curve
      real(wp), intent(in)    :: stress !! >= 0 [pressure]
      real(wp), intent(in)    :: p
      real(wp) :: a(3), q(3), unit, farthest, root

      d = 0.0_wp
      a = at_pressure(curve, p)
      if (a(1) <= 0.0_wp .or. stress <= 0.0_wp) return
      d = stress/a(1)
      if (all(abs(a(2:)) <= 0.0_wp)) return
      unit = d                                             ! x = d/unit: P/stress = x + q_2 x**2 + q_3 x**3
      q = [1.0_wp, a(2)*unit/a(1), a(3)*unit*unit/a(1)]
      ! the first zero of P', in the form without cancellation; a cubic that rises up to x = 4 reaches 1 before
      farthest = 4.0_wp
      root = q(2)**2 - 3.0_wp*q(3)
      if (root >= 0.0_wp) then
         root = sqrt(root) - q(2)
         if (root*farthest > 1.0_wp) farthest = 1.0_wp/root
      end if
      d = unit*farthest
      if (farthest*(1.0_wp + farthest*(q(2) + farthest*q(3))) <= 1.0_wp) return
      d = unit*enclosed_zero([-1.0_wp, q], [0.0_wp, farthest])
   end function deflection_at

   !> P as a polynomial in the fraction f of a path on which d = D(1) + f D(2), p = P(1) + f P(2): sum of c_k f**k [pressure].
   pure function value_on_way(curve, d, p) result(c)
      type(cubic), intent(in) :: curve
      real(wp), intent(in)    :: d(2), p(2)
      real(wp) :: c(0:4)

      c = sum_on_way(curve%coefficients, times(one, d), d, p)
   end function value_on_way

   !> dP/dd likewise, not cut off at zero: sum of c_k f**k, k up to 3 [pressure/length].
   pure function slope_on_way(curve, d, p) result(c)
      type(cubic), intent(in) :: curve
      real(wp), intent(in)    :: d(2), p(2)
      real(wp) :: c(0:4)

      c = sum_on_way(curve%coefficients*exponents, one, d, p)
   end function slope_on_way

   !> The sum of (a_k1 + a_k2 p) FIRST d**(k - 1) on that path.
   pure function sum_on_way(a, first, d, p) result(c)
      real(wp), intent(in) :: a(2, 3), first(0:4), d(2), p(2)
      real(wp) :: c(0:4), power(0:4)
      integer  :: k

      c = 0.0_wp
      power = first
      do k = 1, 3
         if (all(abs(a(:, k:)) <= 0.0_wp)) exit
         c = c + times(power, [a(1, k) + a(2, k)*p(1), a(2, k)*p(2)])
         power = times(power, d)
      end do
   end function sum_on_way

   !> Multiply a polynomial by FACTOR(1) + FACTOR(2) f; no fifth power arises here.
   pure function times(c, factor) result(product)
      real(wp), intent(in) :: c(0:4), factor(2)
      real(wp) :: product(0:4)

      product = factor(1)*c + factor(2)*[0.0_wp, c(:3)]
   end function times

   !> a_1, a_2, a_3 under the pressure P.
   pure function at_pressure(curve, p) result(a)
      type(cubic), intent(in) :: curve
      real(wp), intent(in)    :: p
      real(wp) :: a(3)

      a = curve%coefficients(1, :) + curve%coefficients(2, :)*p
   end function at_pressure

   !> dP/dd at D under the pressure P, not below zero [pressure/length].
   elemental real(wp) function cubic_slope(curve, d, p) result(slope)
      type(cubic), intent(in) :: curve
      real(wp), intent(in)    :: d, p
      real(wp) :: a(3)

      a = at_pressure(curve, p)
      slope = max(0.0_wp, a(1) + d*(2.0_wp*a(2) + d*3.0_wp*a(3)))
   end function cubic_slope

   !> The derivatives of that slope by d and p; both zero where the slope is cut off at zero.
   pure subroutine cubic_slope_derivatives(curve, d, p, by_d, by_p)
      type(cubic), intent(in) :: curve
      real(wp), intent(in)    :: d, p
      real(wp), intent(out)   :: by_d, by_p
      real(wp) :: a(3)

      by_d = 0.0_wp
      by_p = 0.0_wp
      if (cubic_slope(curve, d, p) <= 0.0_wp) return
      a = at_pressure(curve, p)
      by_d = 2.0_wp*a(2) + 6.0_wp*a(3)*d
      a = curve%coefficients(2, :)
      by_p = a(1) + d*(2.0_wp*a(2) + d*3.0_wp*a(3))
   end subroutine cubic_slope_derivatives

   !> P(d)/d at D under the pressure P, at d = 0 the initial slope; not below zero [pressure/length].
   elemental real(wp) function cubic_secant(curve, d, p) result(secant)
      type(cubic), intent(in) :: curve
      real(wp), intent(in)    :: d, p
      real(wp) :: a(3)

      a = at_pressure(curve, p)
      secant = max(0.0_wp, a(1) + d*(a(2) + d*a(3)))
   end function cubic_secant

   !> Integral of P from 0 to D under the pressure P [pressure x length].
   elemental real(wp) function cubic_work(curve, d, p) result(work)
      type(cubic), intent(in) :: curve
      real(wp), intent(in)    :: d, p
      real(wp) :: a(3)

      a = at_pressure(curve, p)
      work = d**2*(a(1)/2.0_wp + d*(a(2)/3.0_wp + d*a(3)/4.0_wp))
   end function cubic_work

   !> 8 times that integral less 4 P(D) D: the area of the loop from -D to D by Masing's rule [pressure x length]. The linear
   !! term does not contribute. The area is negative where the curve hardens.
   elemental real(wp) function cubic_loop(curve, d, p) result(loss)
      type(cubic), intent(in) :: curve
      real(wp), intent(in)    :: d, p
      real(wp) :: a(3)

      a = at_pressure(curve, p)
      loss = -d**3*(4.0_wp/3.0_wp*a(2) + 2.0_wp*d*a(3))
   end function cubic_loop

end module branch_cubic
