!> The shear law of the joint in one direction, and SHEAR: how the increments meet it (section 4.3).
!!
!!                               tau |                                   L  LOAD    tau = A(d), Eq. (6), from 0 through A on
!!                             tau_r |. . . . . . . . . .L  L  LRA  L  L
!!                                   |           L  L  R  R  R  U.       U  UNLOAD  tau = b0 + B(d), Eqs. (3b), (7), from A, where
!!                                   |       L  L  R  R       U  .                  the movement turned back, past zero to M, the
!!                                   |    L   R  R          U    .                  mirror of A: it joins L of the other sense
!!                                   |  L   R            U       .
!!                                   |L  R           U  U        .       R  RELOAD  tau = c0 + C(d), Eqs. (4), (5), from S, where U
!!    -------------------------------|-R----------U--------------+------            turned back again, anywhere, to A: it joins L;
!!                                 R |         U  U             d_r    d            where R turns back, U anew
!!                               R   |      U
!!                             R     |  U  U                             b0 and c0 make a branch begin at the stress that is there.
!!                           R  U  U U                                   d and tau count in the sense s of the loading, +1 or -1:
!!                U  U  U  S         |                                   d = s delta. A, B, C are cubics whose coefficients are
!! L  L M  U  U  U                   | -tau_r                            straight lines in the pressure (Fig. 2).
module shear_stiffness
   use kinds, only: wp
   use normal_stiffness, only: branch_load, branch_reload, branch_unload
   implicit none
   private

   public :: shear, shear_slope, least_movement, turn, branch_end, join_loading
   public :: cubic_of, cubic_slope, cubic_slope_derivatives, cubic_secant, cubic_work

   real(wp), parameter :: rounding = 1.0e-10_wp ! of the stresses at hand: a change below this is none

   !> P(d) = a_1 d + a_2 d**2 + a_3 d**3, a_k = a_k1 + a_k2 p.
   type, public :: cubic
      real(wp) :: coefficients(2, 3) = 0.0_wp  !! (a_k1 and a_k2, k)
   end type cubic

   type, public :: shear_law
      logical     :: given = .false.           !! false: no shear stiffness
      type(cubic) :: load, unload, reload      !! A, B, C
      real(wp)    :: p_max = huge(1.0_wp)      !! tested range [pressure], [length]
      real(wp)    :: d_max = huge(1.0_wp)
   end type shear_law

   !> State of one interface element in one shear direction. Point A and d are in the sense s, so d_r >= 0.
   type, public :: shear_state
      integer  :: branch = branch_load
      real(wp) :: sense  = 1.0_wp              !! s
      real(wp) :: delta  = 0.0_wp              !! accumulated shear deflection [length]
      real(wp) :: delta_before = 0.0_wp        !! before the last increment
      real(wp) :: tau    = 0.0_wp              !! shear stress [pressure]
      real(wp) :: tau_before = 0.0_wp
      real(wp) :: d_r    = 0.0_wp, tau_r = 0.0_wp !! point A, where the last unloading left the loading curve
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
      call ask_diamonds(least_movement(law, state, pressure), state)
      k_s = area*shear_slope(law, state, [state%delta, pressure])
   end subroutine shear

   !> The questions of section 4.3: the branch that the element is on for the next increment. A movement of LEAST or less is none.
   pure subroutine ask_diamonds(least, state)
      real(wp), intent(in)             :: least
      type(shear_state), intent(inout) :: state
      real(wp) :: change, d

      change = state%sense*(state%delta - state%delta_before)
      d = state%sense*state%delta
      select case (state%branch)
      case (branch_load)
         if (change < -least) then
            call turn(.true., state)
            if (d <= branch_end(state)) call join_loading(state)   ! from rest, or back past the mirror of A at once
         end if
      case (branch_unload)
         if (d <= branch_end(state)) then
            call join_loading(state)
         else if (change > least) then
            call turn(.false., state)
         end if
      case (branch_reload)
         if (change < -least) then
            call turn(.true., state)
         else if (d >= branch_end(state)) then
            call join_loading(state)
         end if
      end select
   end subroutine ask_diamonds

   !> The branch that begins with a movement, of which STATE holds the place before it: BACK against the sense of the branch, or
   !! forth. Only what leaves the loading curve sets point A.
   pure subroutine turn(back, state)
      logical, intent(in)              :: back
      type(shear_state), intent(inout) :: state

      if (back) then
         if (state%branch == branch_load) then
            state%d_r = state%sense*state%delta_before
            state%tau_r = state%sense*state%tau_before
         end if
         state%branch = branch_unload
      else if (state%branch == branch_unload) then
         state%branch = branch_reload
      end if
   end subroutine turn

   !> The d at which an unloading or reloading branch joins a loading curve: that of the other sense at M, its own at A [length].
   pure real(wp) function branch_end(state) result(d)
      type(shear_state), intent(in) :: state

      d = merge(state%d_r, -state%d_r, state%branch == branch_reload)
   end function branch_end

   !> The branch has come to its end: loading, after unloading of the other sense.
   pure subroutine join_loading(state)
      type(shear_state), intent(inout) :: state

      if (state%branch == branch_unload) state%sense = -state%sense
      state%branch = branch_load
   end subroutine join_loading

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

   !> d tau/d delta on the branch of STATE at the PLACE (delta, p), not below zero [pressure/length].
   pure real(wp) function shear_slope(law, state, place) result(slope)
      type(shear_law), intent(in)   :: law
      type(shear_state), intent(in) :: state
      real(wp), intent(in)          :: place(2)

      slope = cubic_slope(cubic_of(law, state%branch), state%sense*place(1), place(2))
   end function shear_slope

   !> The cubic of a branch.
   pure type(cubic) function cubic_of(law, branch) result(curve)
      type(shear_law), intent(in) :: law
      integer, intent(in)         :: branch

      curve = law%reload
      if (branch == branch_load) curve = law%load
      if (branch == branch_unload) curve = law%unload
   end function cubic_of

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

   !> How that slope changes with d and with p; both zero where it is cut off at zero.
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

   !> P(d)/d at D under the pressure P, its first slope at d = 0; not below zero [pressure/length].
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

end module shear_stiffness
