!> The shear law of the joint in one direction, and SHEAR: the shear stiffness of the next increment (section 4.3).
!!
!!                               tau |                                   L  LOAD    tau = A(d) + o, Eq. (6), from 0 through A on
!!                             tau_r |. . . . . . . . . .L  L  LRA  L  L
!!                                   |           L  L  R  R  R  U.       U  UNLOAD  tau = b0 + B(d), Eqs. (3b), (7), from A, where
!!                                   |       L  L  R  R       U  .                  the movement turned back, past zero to M, where
!!                                   |    L   R  R          U    .                  it meets L of the other sense and joins it
!!                                   |  L   R            U       .
!!                                   |L  R           U  U        .       R  RELOAD  tau = c0 + C(d), Eqs. (4), (5), from S, where U
!!    -------------------------------|-R----------U--------------+------            turned back again, to where it meets L, at A
!!                                 R |         U  U             d_r    d            at the latest; where R turns back, U anew
!!                               R   |      U
!!                             R     |  U  U                             b0 and c0 make a branch begin at the stress that is there;
!!                           R  U  U U                                   o, what L has of its path, is 0 where p never changed.
!!                U  U  U  S         |                                   d and tau count in the sense s of the loading, +1 or -1:
!! L  L M  U  U  U                   | -tau_r                            d = s (delta - delta_0); slip moves delta_0. A, B, C are
!!                                                                       cubics, their coefficients linear in the pressure (Fig. 2).
!!
!! U and R end where they meet the loading curve that they approach (M, and A or a point before it). A branch that reaches d_r
!! without meeting that curve becomes the loading branch where it is above the curve. Below the curve it continues along the
!! steeper of the two slopes until it meets the curve.
!!
!! ORIGIN BRANCH: B and C count d from the point where the branch began, in the sense of the movement, without b0 and c0:
!! tau = tau_r - B(d_r - d) of U, tau = tau_s + C(d - d_s) of R.
module shear_stiffness
   use branch_cubic, only: cubic, cubic_slope, cubic_value, deflection_at
   use kinds, only: wp
   use normal_stiffness, only: branch_load, branch_reload, branch_unload
   use tolerances, only: rounding_of_a_change, touching_curve
   implicit none
   private

   public :: shear, shear_slope, least_movement, least_stress, turn, goal_sense, join_loading, leave_offset
   public :: cubic_of, curve_deflection, curve_of, slid_from, stand_at_limit, branch_shift

   real(wp), parameter :: past_peaks = 1.0e6_wp ! along the initial slope: a cubic without a peak reaches that stress far beyond d

   type, public :: shear_law
      logical     :: given = .false.           !! false: no shear stiffness
      type(cubic) :: load, unload, reload      !! A, B, C
      real(wp)    :: p_max = huge(1.0_wp)      !! tested range [pressure], [length]
      real(wp)    :: d_max = huge(1.0_wp)
      logical     :: from_branch = .false.     !! ORIGIN BRANCH: d of B and C counts from where the branch began
   end type shear_law

   !> The cubic that an element follows: d tau/d delta = P'(d; p), d = sense (delta - origin).
   type, public :: followed_curve
      type(cubic) :: curve
      real(wp)    :: sense = 1.0_wp
      real(wp)    :: origin = 0.0_wp           !! [length]
   end type followed_curve

   !> State of one interface element in one shear direction. Point A, o and d are in the sense s, so d_r >= 0.
   type, public :: shear_state
      integer  :: branch = branch_load
      real(wp) :: sense  = 1.0_wp              !! s
      real(wp) :: delta  = 0.0_wp              !! total movement of the faces since they closed [length]
      real(wp) :: delta_0 = 0.0_wp             !! the origin, which slip moves: d = s (delta - delta_0) [length]
      real(wp) :: slid   = 0.0_wp              !! sliding part of delta [length]
      real(wp) :: delta_before = 0.0_wp        !! before the last increment
      real(wp) :: delta_start = 0.0_wp         !! where the unloading or reloading branch began [length]
      real(wp) :: tau    = 0.0_wp              !! shear stress [pressure]
      real(wp) :: tau_before = 0.0_wp
      real(wp) :: d_r    = 0.0_wp, tau_r = 0.0_wp !! point A, where the last unloading left the loading curve
      real(wp) :: offset = 0.0_wp              !! o = tau - A(d; p) of the loading branch; later its value at A [pressure]
      real(wp) :: side   = 0.0_wp              !! after an increment: above (+1) or below the curve to which the branch goes
      real(wp) :: k_s    = 0.0_wp              !! stiffness of the last increment [force/length]
   end type shear_state

contains

   !> Shear stiffness of one interface element in one direction for the next increment, from its state after the last one.
   !! Source: Edelugo, section 4.3, Eqs. (3)-(7), Fig. 4. The tangent is that of the curve at the present pressure.
   elemental subroutine shear(law, area, pressure, state, k_s)
      type(shear_law), intent(in)      :: law
      real(wp), intent(in)             :: area     !! area of influence a_i, > 0 [length^2]
      real(wp), intent(in)             :: pressure !! p now, >= 0 [pressure]
      type(shear_state), intent(inout) :: state    !! accumulated; branch, sense and point A are updated
      real(wp), intent(out)            :: k_s      !! [force/length], not below zero

      k_s = 0.0_wp
      if (.not. law%given) return
      call ask_diamonds(law, pressure, state)
      call leave_offset(law, pressure, state)
      k_s = area*shear_slope(law, state, pressure)
   end subroutine shear

   !> The questions of section 4.3: the branch that the element is on for the next increment.
   pure subroutine ask_diamonds(law, pressure, state)
      type(shear_law), intent(in)      :: law
      real(wp), intent(in)             :: pressure
      type(shear_state), intent(inout) :: state
      real(wp) :: change, d(2), tau(2), excess(2), least

      least = least_movement(law, state, pressure)
      change = state%sense*(state%delta - state%delta_before)
      if (abs(change) > least) call turn(change < 0.0_wp, state)
      if (state%branch == branch_load) return
      if (goal_sense(state)*(state%delta - state%delta_0) < 0.0_wp) return
      ! side of the curve that the branch approaches, beyond its beginning at d = 0; 0: met on the straight path
      d = goal_sense(state)*([state%delta_before, state%delta] - state%delta_0)
      tau = goal_sense(state)*[state%tau_before, state%tau]
      if (d(1) < 0.0_wp) then
         tau(1) = tau(1) - (tau(2) - tau(1))*d(1)/(d(2) - d(1))
         d(1) = 0.0_wp
      end if
      excess = tau - cubic_value(law%load, d, pressure) - state%offset
      least = least_stress(state, pressure)
      if (abs(state%side) > 0.0_wp) excess(1) = sign(huge(1.0_wp), state%side) ! under the former pressure
      state%side = sign(1.0_wp, excess(2))
      if (minval(abs(excess)) <= least .or. (excess(1) > 0.0_wp .neqv. excess(2) > 0.0_wp)) state%side = 0.0_wp
      if (.not. abs(state%side) > 0.0_wp .or. (is_past_a(state) .and. state%side > 0.0_wp)) call join_loading(state)
   end subroutine ask_diamonds

   !> d = s (delta - delta_0), the argument of the cubics [length].
   elemental real(wp) function curve_deflection(state) result(d)
      type(shear_state), intent(in) :: state

      d = state%sense*(state%delta - state%delta_0)
   end function curve_deflection

   !> Whether a returning branch has reached d_r, in the sense of the loading curve that it approaches.
   pure logical function is_past_a(state)
      type(shear_state), intent(in) :: state

      is_past_a = goal_sense(state)*(state%delta - state%delta_0) >= (1.0_wp - rounding_of_a_change)*state%d_r
   end function is_past_a

   !> Set the branch that begins with a movement; STATE holds the point before it. BACK: against the sense of the branch. Only a
   !! branch that leaves the loading curve sets point A.
   pure subroutine turn(back, state)
      logical, intent(in)              :: back
      type(shear_state), intent(inout) :: state
      integer :: branch

      branch = state%branch
      if (back) then
         if (branch == branch_load) then
            state%d_r = state%sense*(state%delta_before - state%delta_0)
            state%tau_r = state%sense*state%tau_before
         end if
         state%branch = branch_unload
      else if (branch == branch_unload) then
         state%branch = branch_reload
      end if
      if (state%branch == branch) return
      state%side = 0.0_wp
      state%delta_start = state%delta_before
   end subroutine turn

   !> The sense of the loading curve that a branch approaches: opposite for unloading, its own for reloading.
   pure real(wp) function goal_sense(state) result(sense)
      type(shear_state), intent(in) :: state

      sense = merge(-state%sense, state%sense, state%branch == branch_unload)
   end function goal_sense

   !> The branch has reached its end: loading, in the opposite sense after unloading.
   pure subroutine join_loading(state)
      type(shear_state), intent(inout) :: state

      state%sense = goal_sense(state)
      state%branch = branch_load
   end subroutine join_loading

   !> Update o = tau - A(d; p) while the element is on its loading curve: the effect of its path (0 where p never changed). The
   !! last value is that of point A.
   pure subroutine leave_offset(law, pressure, state)
      type(shear_law), intent(in)      :: law
      real(wp), intent(in)             :: pressure
      type(shear_state), intent(inout) :: state

      if (state%branch /= branch_load) return
      state%offset = state%sense*state%tau - cubic_value(law%load, curve_deflection(state), pressure)
      state%side = 0.0_wp
   end subroutine leave_offset

   !> The least change of delta that counts as a movement. A smaller change is rounding relative to the present and possible
   !! stresses of the element [length].
   pure real(wp) function least_movement(law, state, pressure) result(least)
      type(shear_law), intent(in)   :: law
      type(shear_state), intent(in) :: state
      real(wp), intent(in)          :: pressure
      real(wp) :: stress

      stress = max(abs(state%tau), abs(state%tau_before), abs(pressure))
      least = rounding_of_a_change*stress/max(cubic_slope(law%load, 0.0_wp, pressure), tiny(1.0_wp)*1.0e100_wp)
   end function least_movement

   !> The stress that counts as rounding relative to the present and possible stresses of the element [pressure].
   pure real(wp) function least_stress(state, pressure) result(least)
      type(shear_state), intent(in) :: state
      real(wp), intent(in)          :: pressure

      least = touching_curve*max(abs(state%tau), abs(state%tau_before), abs(state%tau_r), abs(pressure))
   end function least_stress

   !> d tau/d delta on the branch of STATE under the PRESSURE, not below zero [pressure/length]. A returning branch past d_r
   !! that has not met its curve follows the steeper of the two.
   pure real(wp) function shear_slope(law, state, pressure) result(slope)
      type(shear_law), intent(in)   :: law
      type(shear_state), intent(in) :: state
      real(wp), intent(in)          :: pressure
      type(followed_curve) :: on

      on = curve_of(law, state)
      slope = cubic_slope(on%curve, on%sense*(state%delta - on%origin), pressure)
      if (state%branch == branch_load) return
      if (is_past_a(state)) slope = max(slope, cubic_slope(law%load, goal_sense(state)*(state%delta - state%delta_0), pressure))
   end function shear_slope

   !> Put a slipping element at point D of the loading curve in its sense of slip, where slip begins, and clear its branches:
   !! the asperities meet anew after sliding (section 4.4). Where the curve peaks below the stress, the element stands at the
   !! peak.
   elemental subroutine stand_at_limit(law, pressure, state)
      type(shear_law), intent(in)      :: law
      real(wp), intent(in)             :: pressure
      type(shear_state), intent(inout) :: state !! its tau is the stress after slip
      real(wp) :: d

      if (.not. law%given) return
      if (abs(state%tau) > 0.0_wp) state%sense = sign(1.0_wp, state%tau)
      state%branch = branch_load
      d = deflection_at(law%load, abs(state%tau), pressure)
      state%delta_0 = state%delta - state%sense*d
      state%d_r = 0.0_wp
      state%tau_r = 0.0_wp
      state%side = 0.0_wp
      state%delta_before = state%delta ! the increment is not a movement along a branch
      state%tau_before = state%tau
      call leave_offset(law, pressure, state)
   end subroutine stand_at_limit

   !> Sliding of an element whose stress falls from that of STATE to TAU by slip: the difference over the slope of its branch,
   !! on the loading branch the mean slope between the two [length].
   elemental real(wp) function slid_from(law, pressure, state, tau) result(slid)
      type(shear_law), intent(in)   :: law
      real(wp), intent(in)          :: pressure, tau
      type(shear_state), intent(in) :: state
      real(wp) :: d, offset, slope

      slid = 0.0_wp
      if (.not. law%given) return
      d = curve_deflection(state)
      if (state%branch == branch_load .and. d > 0.0_wp) then
         d = min(d, deflection_at(law%load, past_peaks*cubic_slope(law%load, 0.0_wp, pressure)*d, pressure)) ! constant past it
         offset = state%sense*state%tau - cubic_value(law%load, d, pressure)
         slid = state%sense*(curve_deflection(state) - deflection_at(law%load, max(0.0_wp, state%sense*tau - offset), pressure))
      else
         slope = shear_slope(law, state, pressure)
         if (slope > 0.0_wp) slid = (state%tau - tau)/slope
      end if
   end function slid_from

   !> b0 or c0: the shift by which the curve of the branch of STATE under the pressure P passes through the point (DELTA, TAU)
   !! where the branch began, or s TAU of a branch that counts from this point; zero on the loading curve [pressure].
   pure real(wp) function branch_shift(law, state, p, delta, tau) result(shift)
      type(shear_law), intent(in)   :: law
      type(shear_state), intent(in) :: state
      real(wp), intent(in)          :: p, delta, tau

      shift = 0.0_wp
      if (state%branch == branch_load) return
      shift = state%sense*tau
      if (.not. law%from_branch) shift = shift - cubic_value(cubic_of(law, state%branch), state%sense*(delta - state%delta_0), p)
   end function branch_shift

   !> The cubic of the branch of STATE, and from where and in which sense its d counts.
   pure type(followed_curve) function curve_of(law, state) result(on)
      type(shear_law), intent(in)   :: law
      type(shear_state), intent(in) :: state

      on = followed_curve(cubic_of(law, state%branch), state%sense, state%delta_0)
      if (.not. law%from_branch .or. state%branch == branch_load) return
      on%sense = goal_sense(state)
      on%origin = state%delta_start
   end function curve_of

   !> The cubic of a branch.
   pure type(cubic) function cubic_of(law, branch) result(curve)
      type(shear_law), intent(in) :: law
      integer, intent(in)         :: branch

      curve = law%reload
      if (branch == branch_load) curve = law%load
      if (branch == branch_unload) curve = law%unload
   end function cubic_of

end module shear_stiffness
