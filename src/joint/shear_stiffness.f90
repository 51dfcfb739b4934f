!> The shear law of the joint in one direction, and SHEAR: how the increments meet it (section 4.3).
!!
!!                               tau |                                   L  LOAD    tau = A(d) + o, Eq. (6), from 0 through A on
!!                             tau_r |. . . . . . . . . .L  L  LRA  L  L
!!                                   |           L  L  R  R  R  U.       U  UNLOAD  tau = b0 + B(d), Eqs. (3b), (7), from A, where
!!                                   |       L  L  R  R       U  .                  the movement turned back, past zero to M, where
!!                                   |    L   R  R          U    .                  it meets L of the other sense and joins it
!!                                   |  L   R            U       .
!!                                   |L  R           U  U        .       R  RELOAD  tau = c0 + C(d), Eqs. (4), (5), from S, where U
!!    -------------------------------|-R----------U--------------+------            turned back again, to where it meets L, before
!!                                 R |         U  U             d_r    d            A or after it; where R turns back, U anew
!!                               R   |      U
!!                             R     |  U  U                             b0 and c0 make a branch begin at the stress that is there;
!!                           R  U  U U                                   o, what L has of its path, is 0 where p never changed.
!!                U  U  U  S         |                                   d and tau count in the sense s of the loading, +1 or -1:
!! L  L M  U  U  U                   | -tau_r                            d = s delta. A, B, C are cubics whose coefficients are
!!                                                                       straight lines in the pressure (Fig. 2).
module shear_stiffness
   use branch_cubic, only: cubic, cubic_slope, cubic_value, value_on_way
   use kinds, only: wp
   use normal_stiffness, only: branch_load, branch_reload, branch_unload
   use polynomial_zeros, only: find_zeros, zero_list
   implicit none
   private

   public :: shear, shear_slope, least_movement, least_stress, turn, goal_sense, look_ahead, join_loading, leave_offset
   public :: cubic_of

   real(wp), parameter :: rounding = 1.0e-10_wp ! of the stresses at hand: a change below this is none
   real(wp), parameter :: touching = 1.0e-11_wp ! of them: what comes so near to a curve meets it

   type, public :: shear_law
      logical     :: given = .false.           !! false: no shear stiffness
      type(cubic) :: load, unload, reload      !! A, B, C
      real(wp)    :: p_max = huge(1.0_wp)      !! tested range [pressure], [length]
      real(wp)    :: d_max = huge(1.0_wp)
   end type shear_law

   !> State of one interface element in one shear direction. Point A, o and d are in the sense s, so d_r >= 0.
   type, public :: shear_state
      integer  :: branch = branch_load
      real(wp) :: sense  = 1.0_wp              !! s
      real(wp) :: delta  = 0.0_wp              !! accumulated shear deflection [length]
      real(wp) :: delta_before = 0.0_wp        !! before the last increment
      real(wp) :: tau    = 0.0_wp              !! shear stress [pressure]
      real(wp) :: tau_before = 0.0_wp
      real(wp) :: d_r    = 0.0_wp, tau_r = 0.0_wp !! point A, where the last unloading left the loading curve
      real(wp) :: offset = 0.0_wp              !! o = tau - A(d; p) of the loading branch, after it as it was at A [pressure]
      real(wp) :: side   = 0.0_wp              !! of an increment's end: above (+1) or below the curve that the branch goes to
      logical  :: parallel = .false.           !! the branch will not meet that curve, and goes on along its slope
      real(wp) :: k_s    = 0.0_wp              !! stiffness of the last increment [force/length]
   end type shear_state

contains

   !> Shear stiffness of one interface element in one direction for the next increment, from what the last one did to it.
   !! Source: Edelugo, section 4.3, Eqs. (3)-(7), Fig. 4. The tangent is that of the curve of the current pressure.
   pure subroutine shear(law, area, pressure, state, k_s)
      type(shear_law), intent(in)      :: law
      real(wp), intent(in)             :: area     !! area of influence a_i, > 0 [length^2]
      real(wp), intent(in)             :: pressure !! p now, >= 0 [pressure]
      type(shear_state), intent(inout) :: state    !! accumulated; branch, sense and point A are brought up to date
      real(wp), intent(out)            :: k_s      !! [force/length], not below zero

      k_s = 0.0_wp
      if (.not. law%given) return
      call ask_diamonds(law, pressure, state)
      call leave_offset(law, pressure, state)
      call look_ahead(law, [state%delta, pressure], state)
      k_s = area*shear_slope(law, state, [state%delta, pressure])
   end subroutine shear

   !> The questions of section 4.3: the branch that the element is on for the next increment.
   pure subroutine ask_diamonds(law, pressure, state)
      type(shear_law), intent(in)      :: law
      real(wp), intent(in)             :: pressure
      type(shear_state), intent(inout) :: state
      real(wp) :: change, least

      least = least_movement(law, state, pressure)
      change = state%sense*(state%delta - state%delta_before)
      if (abs(change) > least) call turn(change < 0.0_wp, state)
      if (state%branch == branch_load) return
      call find_side(law, pressure, state)
      if (.not. abs(state%side) > 0.0_wp .and. goal_sense(state)*state%delta >= 0.0_wp) call join_loading(state)
   end subroutine ask_diamonds

   !> The branch that begins with a movement, of which STATE holds the place before it: BACK against the sense of the branch, or
   !! forth. Only what leaves the loading curve sets point A.
   pure subroutine turn(back, state)
      logical, intent(in)              :: back
      type(shear_state), intent(inout) :: state
      integer :: branch

      branch = state%branch
      if (back) then
         if (branch == branch_load) then
            state%d_r = state%sense*state%delta_before
            state%tau_r = state%sense*state%tau_before
         end if
         state%branch = branch_unload
      else if (branch == branch_unload) then
         state%branch = branch_reload
      end if
      if (state%branch == branch) return
      state%side = 0.0_wp
      state%parallel = .false.
   end subroutine turn

   !> The sense of the loading curve that an unloading or reloading branch goes to: the other one, its own.
   pure real(wp) function goal_sense(state) result(sense)
      type(shear_state), intent(in) :: state

      sense = merge(-state%sense, state%sense, state%branch == branch_unload)
   end function goal_sense

   !> On which side of the curve that the branch goes to the increment has ended: SIDE, 0 where it has met that curve, which begins
   !! at delta = 0, on its straight way, or has not come to delta = 0.
   pure subroutine find_side(law, pressure, state)
      type(shear_law), intent(in)      :: law
      real(wp), intent(in)             :: pressure
      type(shear_state), intent(inout) :: state
      real(wp) :: d(2), tau(2), excess(2), least

      d = goal_sense(state)*[state%delta_before, state%delta]
      tau = goal_sense(state)*[state%tau_before, state%tau]
      if (d(2) < 0.0_wp) return
      if (d(1) < 0.0_wp) then
         tau(1) = tau(1) - (tau(2) - tau(1))*d(1)/(d(2) - d(1))
         d(1) = 0.0_wp
      end if
      excess = tau - cubic_value(law%load, d, pressure) - state%offset
      least = least_stress(state, pressure)
      if (abs(state%side) > 0.0_wp) excess(1) = sign(huge(1.0_wp), state%side) ! under the pressure that was
      state%side = sign(1.0_wp, excess(2))
      if (minval(abs(excess)) <= least .or. (excess(1) > 0.0_wp .neqv. excess(2) > 0.0_wp)) state%side = 0.0_wp
   end subroutine find_side

   !> The branch has come to its end: loading, after unloading of the other sense.
   pure subroutine join_loading(state)
      type(shear_state), intent(inout) :: state

      state%sense = goal_sense(state)
      state%branch = branch_load
      state%parallel = .false.
   end subroutine join_loading

   !> Take up o = tau - A(d; p) while the element is on its loading curve: what it has of its path (0 where p never changed). The
   !! last one taken up is that of point A.
   pure subroutine leave_offset(law, pressure, state)
      type(shear_law), intent(in)      :: law
      real(wp), intent(in)             :: pressure
      type(shear_state), intent(inout) :: state

      if (state%branch /= branch_load) return
      state%offset = state%sense*state%tau - cubic_value(law%load, state%sense*state%delta, pressure)
      state%side = 0.0_wp
   end subroutine leave_offset

   !> The least change of delta that counts as a movement: what is below it is rounding, beside the stresses that the element
   !! bears or could bear [length].
   pure real(wp) function least_movement(law, state, pressure) result(least)
      type(shear_law), intent(in)   :: law
      type(shear_state), intent(in) :: state
      real(wp), intent(in)          :: pressure
      real(wp) :: stress

      stress = max(abs(state%tau), abs(state%tau_before), abs(pressure))
      least = rounding*stress/max(cubic_slope(law%load, 0.0_wp, pressure), tiny(1.0_wp)*1.0e100_wp)
   end function least_movement

   !> A stress that is rounding beside those that the element bears or could bear [pressure].
   pure real(wp) function least_stress(state, pressure) result(least)
      type(shear_state), intent(in) :: state
      real(wp), intent(in)          :: pressure

      least = touching*max(abs(state%tau), abs(state%tau_before), abs(state%tau_r), abs(pressure))
   end function least_stress

   !> d tau/d delta on the branch of STATE at the PLACE (delta, p), not below zero [pressure/length].
   pure real(wp) function shear_slope(law, state, place) result(slope)
      type(shear_law), intent(in)   :: law
      type(shear_state), intent(in) :: state
      real(wp), intent(in)          :: place(2)

      if (state%parallel) then
         slope = cubic_slope(law%load, goal_sense(state)*place(1), place(2))
      else
         slope = cubic_slope(cubic_of(law, state%branch), state%sense*place(1), place(2))
      end if
   end function shear_slope

   !> At the PLACE (delta, p), under the stress of STATE: the branch becomes PARALLEL to the loading curve that it goes to, for the
   !! rest of it, where it moves away from that curve, less steep below it or steeper above, and would not meet it in the tested
   !! range.
   pure subroutine look_ahead(law, place, state)
      type(shear_law), intent(in)      :: law
      real(wp), intent(in)             :: place(2)
      type(shear_state), intent(inout) :: state
      real(wp), parameter :: far = 1.0e60_wp ! what polynomials can be formed of
      type(zero_list) :: meetings
      real(wp) :: behind(0:4), bound, d, parts, s
      integer  :: highest

      s = goal_sense(state)
      d = s*place(1)
      if (state%branch == branch_load .or. state%parallel .or. d < -rounding*state%d_r) return
      ! how far it would be above the curve further on, as a polynomial in that distance
      behind = state%sense*s*value_on_way(cubic_of(law, state%branch), state%sense*s*[d, 1.0_wp], [place(2), 0.0_wp]) &
               - value_on_way(law%load, [d, 1.0_wp], [place(2), 0.0_wp])
      behind(0) = s*state%tau - cubic_value(law%load, d, place(2)) - state%offset
      parts = behind(1)
      if (abs(parts) <= rounding*cubic_slope(law%load, 0.0_wp, place(2))) parts = behind(2) ! alike here: further on then
      if (abs(behind(0)) <= least_stress(state, place(2)) .or. behind(0)*parts <= 0.0_wp) return
      highest = findloc(abs(behind) > 0.0_wp, .true., dim=1, back=.true.) - 1
      bound = 1.0_wp + maxval(abs(behind(:highest - 1)))/abs(behind(highest)) ! Cauchy's: no zero lies beyond
      call find_zeros(behind, 0.0_wp, min(bound, far, max(0.0_wp, law%d_max - d)), meetings)
      state%parallel = meetings%n == 0
   end subroutine look_ahead

   !> The cubic of a branch.
   pure type(cubic) function cubic_of(law, branch) result(curve)
      type(shear_law), intent(in) :: law
      integer, intent(in)         :: branch

      curve = law%reload
      if (branch == branch_load) curve = law%load
      if (branch == branch_unload) curve = law%unload
   end function cubic_of

end module shear_stiffness
