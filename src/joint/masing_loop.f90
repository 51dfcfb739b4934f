!> What a joint loses in shear when it oscillates about the state that it is in, one direction of one interface element.
!!
!! The skeleton curve is the loading curve from rest at the present pressure, up to its peak, where its slope is zero, or to the Coulomb
!! limit, whichever comes first; from there on it is constant:
!!
!!    tau(d) = a_1 d + a_2 d**2 + a_3 d**3   d <= d_e,      tau(d) = tau(d_e)   beyond
!!
!! Masing's rule: both branches of the loop of amplitude d are the skeleton doubled in both directions, begun at the turning point:
!!
!!    tau = -+ tau(d) +- 2 tau((d +- x)/2)
!!
!! Between them lies 8 W(d) - 4 tau(d) d, W the integral of the skeleton from 0 to d: what one cycle loses. For the cubic alone that is
!! -(4/3) a_2 d**3 - 2 a_3 d**4, nothing for a law that is a line; where the skeleton is constant from d_e on, that of d_e and
!! 4 tau(d_e) (d - d_e).
!!
!! A curve that hardens (a_2 > 0) has its doubled branches on the wrong side of each other, the one of loading below the one of
!! relief: the rule gives a loss below zero, work that the joint would do for ever. No joint does; the rule does not hold for such a
!! curve, and the loss is taken as zero. A curve that hardens first and softens later loses from the amplitude on at which the softening
!! outweighs.
!! Source: G. Masing, Proc. 2nd Int. Congress of Applied Mechanics, Zurich 1926, p. 332.
module masing_loop
   use branch_cubic, only: cubic, cubic_loop, cubic_slope, cubic_value, slope_on_way, value_on_way
   use kinds, only: wp
   use polynomial_zeros, only: find_zeros, zero_list
   implicit none
   private

   public :: loop_loss, skeleton_end

   real(wp), parameter, public :: no_limit = huge(1.0_wp) !! of a joint without friction

contains

   !> What one cycle of shear loses by area of the joint [pressure x length], not below zero.
   pure real(wp) function loop_loss(loading, p, limit, amplitude) result(loss)
      type(cubic), intent(in) :: loading   !! curve A of the law
      real(wp), intent(in)    :: p         !! present pressure, >= 0 [pressure]
      real(wp), intent(in)    :: limit     !! Coulomb limit mu p, >= 0, or no_limit [pressure]
      real(wp), intent(in)    :: amplitude !! d of the shear deflection, its sign does not matter [length]
      real(wp) :: d, reach

      d = abs(amplitude)
      reach = skeleton_end(loading, p, limit, d)
      loss = max(0.0_wp, cubic_loop(loading, reach, p) + 4.0_wp*cubic_value(loading, reach, p)*(d - reach))
   end function loop_loss

   !> d_e up to which the skeleton curve is the loading curve, no more than FAR [length].
   pure real(wp) function skeleton_end(loading, p, limit, far) result(d)
      type(cubic), intent(in) :: loading
      real(wp), intent(in)    :: p, limit !! as above
      real(wp), intent(in)    :: far      !! >= 0 [length]
      type(zero_list) :: peaks, meetings
      real(wp) :: c(0:4)

      d = 0.0_wp
      if (cubic_slope(loading, 0.0_wp, p) <= 0.0_wp .or. limit <= 0.0_wp) return
      ! as polynomials in d/far
      d = far
      c = slope_on_way(loading, [0.0_wp, far], [p, 0.0_wp])
      call find_zeros(c(:2), 0.0_wp, 1.0_wp, peaks)
      if (peaks%n > 0) d = peaks%x(1)*far
      if (cubic_value(loading, d, p) <= limit) return ! rises as far as that
      c = value_on_way(loading, [0.0_wp, far], [p, 0.0_wp])
      c(0) = -limit
      call find_zeros(c(:3), 0.0_wp, d/far, meetings)
      if (meetings%n > 0) d = meetings%x(1)*far
   end function skeleton_end

end module masing_loop
