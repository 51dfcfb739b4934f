!> Closed loops of shear: the gap of a test loop, the loss of Masing's loop, and the stiffness under oscillation.
!! The gap of a loop: a joint is loaded to d under a constant pressure, unloaded until tau is zero and reloaded to d. The gap is
!! the difference of the stresses at d before and after. Cycles under one load creep by the gap. The loss is that of one
!! direction of one interface element that oscillates about its present state.
!!
!! The skeleton curve is the loading curve from rest at the present pressure, up to its peak, where its slope is zero, or to the
!! Coulomb limit, whichever comes first. Beyond that point the skeleton is constant:
!!
!!    tau(d) = a_1 d + a_2 d**2 + a_3 d**3   d <= d_e,      tau(d) = tau(d_e)   beyond
!!
!! Masing's rule: both branches of the loop of amplitude d are the skeleton scaled by two in both directions, from the turning
!! point:
!!
!!    tau = -+ tau(d) +- 2 tau((d +- x)/2)
!!
!! The area between them is 8 W(d) - 4 tau(d) d, W the integral of the skeleton from 0 to d: the loss of one cycle. For the
!! cubic alone the area is -(4/3) a_2 d**3 - 2 a_3 d**4, zero for a linear law. Where the skeleton is constant from d_e on, the
!! area is that of d_e plus 4 tau(d_e) (d - d_e).
!!
!! A curve that hardens (a_2 > 0) has its doubled branches in the wrong order, loading below relief: Masing's rule gives a
!! negative loss, which is impossible. The rule does not hold for such a curve, and the loss is taken as zero. A curve that
!! hardens first and softens later has a loss from the amplitude on at which the softening outweighs.
!! Source: G. Masing, Proc. 2nd Int. Congress of Applied Mechanics, Zurich 1926, p. 332.
!!
!! The stiffness of an interface element under small oscillation about its present state. Oscillation reverses all the time. A
!! joint that has been loaded unloads first and then stays on its unloading branches, which are stiffer than its loading
!! branches. The stiffness is therefore that of unloading: E_u and the initial slope of the shear unloading branch. The tangent
!! of loading belongs to a slowly growing load. An open element has no stiffness.
module shear_loops
   use branch_cubic, only: cubic, cubic_loop, cubic_secant, cubic_slope, cubic_value, slope_on_way, value_on_way
   use iwan_law, only: limit_share, loading_slopes, slices_loss
   use joint_laws, only: element_state, friction_limit, joint_law, slices_of
   use kinds, only: wp
   use normal_curve, only: normal_tangent
   use normal_stiffness, only: branch_open
   use numbers, only: find_zeros, zero_list
   use shear_stiffness, only: curve_deflection, shear_law
   use tolerances, only: equal_loop_gaps
   implicit none
   private

   public :: closure_at, worst_closure, loop_loss, loss_of_element, skeleton_end, oscillation_stiffness

   real(wp), parameter, public :: wide_gap = 0.05_wp !! a warning is given above it

   integer, parameter  :: divisions = 20        ! of the tested range

   !> The gap of a loop and its place.
   type, public :: loop_closure
      logical  :: is_known = .false.            !! whether any loop reaches tau = 0 on branch B
      real(wp) :: share = 0.0_wp                !! |tau of C at d_r - tau_r|/tau_r
      real(wp) :: p = 0.0_wp, d = 0.0_wp        !! [pressure], [length]; D = 0: the limit of small loops
   end type loop_closure

   real(wp), parameter, public :: no_limit = huge(1.0_wp) !! of a joint without friction

contains

   !> The widest gap over the tested range; without a largest pressure at P_AV, without a largest deflection for small loops.
   pure type(loop_closure) function worst_closure(law, p_av) result(worst)
      type(shear_law), intent(in) :: law
      real(wp), intent(in)        :: p_av !! [pressure]
      type(loop_closure) :: here
      real(wp) :: p, d
      integer  :: i, k

      do i = 1, divisions
         p = p_av
         if (law%p_max < huge(1.0_wp)) p = law%p_max*i/divisions
         do k = 1, divisions
            d = 0.0_wp
            if (law%d_max < huge(1.0_wp)) d = law%d_max*k/divisions
            here = closure_at(law, p, d)
            if (.not. here%is_known) cycle
            if (.not. worst%is_known .or. here%share > worst%share + equal_loop_gaps) worst = here
         end do
      end do
   end function worst_closure

   !> The gap of the loop to D under the pressure P. D = 0: small loops, the gap is that of the initial slopes, |c_1/b_1 - 1|.
   pure type(loop_closure) function closure_at(law, p, d) result(closure)
      type(shear_law), intent(in) :: law
      real(wp), intent(in)        :: p    !! [pressure]
      real(wp), intent(in)        :: d    !! [length]
      type(zero_list) :: zeros
      real(wp) :: rise, stress, unloading(0:4), slopes(2)

      closure%p = p
      closure%d = d
      if (d <= 0.0_wp) then
         slopes = [cubic_slope(law%unload, 0.0_wp, p), cubic_slope(law%reload, 0.0_wp, p)]
         closure%is_known = slopes(1) > 0.0_wp
         if (closure%is_known) closure%share = abs(slopes(2)/slopes(1) - 1.0_wp)
         return
      end if
      stress = d*cubic_secant(law%load, d, p)
      if (stress <= 0.0_wp) return
      unloading = value_on_way(law%unload, [d, -d], [p, 0.0_wp]) ! over f, d from d to -d
      if (law%from_branch) unloading = -value_on_way(law%unload, [0.0_wp, d], [p, 0.0_wp])
      unloading(0) = stress
      call find_zeros(unloading, 0.0_wp, 2.0_wp, zeros)
      closure%is_known = zeros%n > 0
      if (.not. closure%is_known) return
      rise = cubic_value(law%reload, d, p) - cubic_value(law%reload, d*(1.0_wp - zeros%x(1)), p)
      if (law%from_branch) rise = cubic_value(law%reload, d*zeros%x(1), p)
      closure%share = abs(rise/stress - 1.0_wp)
   end function closure_at

   !> Loss of one cycle of shear per area of the joint [pressure x length], not below zero.
   pure real(wp) function loop_loss(loading, p, limit, amplitude) result(loss)
      type(cubic), intent(in) :: loading   !! curve A of the law
      real(wp), intent(in)    :: p         !! present pressure, >= 0 [pressure]
      real(wp), intent(in)    :: limit     !! Coulomb limit mu p, >= 0, or no_limit [pressure]
      real(wp), intent(in)    :: amplitude !! d of the shear deflection; its sign does not matter [length]

      loss = loss_beyond(loading, p, abs(amplitude), skeleton_end(loading, p, limit, abs(amplitude)))
   end function loop_loss

   !> The loss of the loop of amplitude D whose skeleton is constant from REACH on.
   pure real(wp) function loss_beyond(loading, p, d, reach) result(loss)
      type(cubic), intent(in) :: loading
      real(wp), intent(in)    :: p, d, reach

      loss = max(0.0_wp, cubic_loop(loading, reach, p) + 4.0_wp*cubic_value(loading, reach, p)*(d - reach))
   end function loss_beyond

   !> Loss of one cycle of shear per area of an element whose two ends oscillate with the amplitude MOVEMENT in its plane. The
   !! limit is that of the resultant of the two stresses: both stay constant from the fraction of MOVEMENT on at which the
   !! resultant reaches it [pressure x length].
   pure real(wp) function loss_of_element(law, p, movement) result(loss)
      type(joint_law), intent(in) :: law
      real(wp), intent(in)        :: p           !! present pressure, >= 0 [pressure]
      real(wp), intent(in)        :: movement(2) !! [length]
      real(wp) :: bounds(2), d(2), limit, reach(2)
      integer  :: i

      if (law%iwan%given) then
         loss = slices_loss(law%iwan, limit_share(law%iwan, p), norm2(merge(movement, 0.0_wp, law%shear%given)))
         return
      end if
      limit = no_limit
      if (law%has_friction) limit = friction_limit(law, p)
      d = merge(abs(movement), 0.0_wp, law%shear%given)
      loss = 0.0_wp
      if (count(d > 0.0_wp) < 2) then
         i = maxloc(d, dim=1)
         if (d(i) > 0.0_wp) loss = loop_loss(law%shear(i)%load, p, limit, d(i))
         return
      end if
      reach = [(skeleton_end(law%shear(i)%load, p, merge(no_limit, 0.0_wp, limit > 0.0_wp), d(i)), i = 1, 2)]
      if (norm2(cubic_value(law%shear%load, reach, p)) > limit) then
         bounds = [0.0_wp, 1.0_wp]
         do i = 1, digits(1.0_wp)
            if (norm2(cubic_value(law%shear%load, min(reach, 0.5_wp*sum(bounds)*d), p)) > limit) then
               bounds(2) = 0.5_wp*sum(bounds)
            else
               bounds(1) = 0.5_wp*sum(bounds)
            end if
         end do
         reach = min(reach, bounds(1)*d)
      end if
      loss = sum([(loss_beyond(law%shear(i)%load, p, d(i), reach(i)), i = 1, 2)])
   end function loss_of_element

   !> d_e up to which the skeleton curve is the loading curve, at most FAR [length].
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
      if (cubic_value(loading, d, p) <= limit) return ! the curve rises up to d
      c = value_on_way(loading, [0.0_wp, far], [p, 0.0_wp])
      c(0) = -limit
      call find_zeros(c(:3), 0.0_wp, d/far, meetings)
      if (meetings%n > 0) d = meetings%x(1)*far
   end function skeleton_end

   !> K = (k_sx, k_sy, k_n, k_sxy) under the present pressure p and shear deflections d [force/length]: E_u a_i and a_i B'(d; p), the
   !! slope of the unloading cubic where it would begin. ON_LOADING: dp/dlambda a_i and a_i A'(d; p) of the loading curves. The slices
   !! of JIWAN couple the directions of shear by k_sxy on loading.
   pure function oscillation_stiffness(law, area, state, on_loading) result(k)
      type(joint_law), intent(in)     :: law
      real(wp), intent(in)            :: area       !! a_i [length^2]
      type(element_state), intent(in) :: state
      logical, intent(in)             :: on_loading
      real(wp) :: k(4)
      integer  :: i

      k = 0.0_wp
      if (state%normal%branch == branch_open) return
      associate (p => max(0.0_wp, state%normal%pressure))
         k(3) = law%normal%e_u*area
         if (on_loading) k(3) = normal_tangent(law%normal, area, p, state%normal%p_av)
         if (law%iwan%given .and. on_loading) then
            k([1, 2, 4]) = merge(area*loading_slopes(law%iwan, slices_of(state), limit_share(law%iwan, p)), 0.0_wp, &
                                 [law%shear%given, all(law%shear%given)])
            return
         end if
         do i = 1, 2
            associate (d => curve_deflection(state%shear(i)), shear => law%shear(i))
               if (.not. shear%given) cycle
               k(i) = area*cubic_slope(shear%unload, merge(0.0_wp, d, shear%from_branch), p)
               if (on_loading) k(i) = area*cubic_slope(shear%load, abs(d), p)
            end associate
         end do
      end associate
   end function oscillation_stiffness

end module shear_loops
