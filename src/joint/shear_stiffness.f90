!> SHEAR: the shear law of the joint in one direction, as the increments meet it (section 4.3).
!!
!! Every branch is a cubic in the shear deflection whose coefficients are straight lines in the pressure (Fig. 2):
!!    load     tau = A(d)        A(d) = (a11 + a12 p) d + (a21 + a22 p) d**2 + (a31 + a32 p) d**3      Eq. (6)
!!    unload   tau = b0 + B(d)   likewise with b; b0 makes it begin where the loading curve was left   Eqs. (3b), (7)
!!    reload   tau = c0 + C(d)   likewise with c                                                       Eqs. (4), (5)
!! at d = s delta, s = +1 or -1 being the sense of the loading that the branch belongs to.
module shear_stiffness
   use kinds, only: wp
   use normal_stiffness, only: branch_load, branch_reload, branch_unload
   implicit none
   private

   public :: shear, shear_slope, shear_slope_derivatives, start_shear, least_movement

   real(wp), parameter :: rounding = 1.0e-10_wp ! of the stresses at hand: a change below this is none

   type, public :: shear_law
      logical  :: given = .false.              !! false: no shear stiffness
      real(wp) :: coefficients(2, 3, 4) = 0.0_wp !! (constant and slope in p; power of d; branch_load, _unload, unused, _reload)
      real(wp) :: p_max = huge(1.0_wp)         !! tested range [pressure], [length]
      real(wp) :: d_max = huge(1.0_wp)
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
      real(wp) :: d_s    = 0.0_wp, tau_s = 0.0_wp !! where the last reloading began
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
      real(wp) :: change, smallest, d

      k_s = 0.0_wp
      if (.not. law%given) return
      change = state%sense*(state%delta - state%delta_before)
      smallest = least_movement(law, state, pressure)
      d = state%sense*state%delta
      select case (state%branch)
      case (branch_load)
         if (change < -smallest) then
            state%d_r = state%sense*state%delta_before
            state%tau_r = state%sense*state%tau_before
            state%branch = branch_unload
            if (d <= -state%d_r) call change_sense(state)          ! from rest, or back past the mirror of A at once
         end if
      case (branch_unload)
         if (d <= -state%d_r) then
            call change_sense(state)
         else if (change > smallest) then
            state%d_s = state%sense*state%delta_before
            state%tau_s = state%sense*state%tau_before
            state%branch = branch_reload
         end if
      case (branch_reload)
         if (change < -smallest) then
            state%branch = branch_unload
         else if (d >= state%d_r) then
            state%branch = branch_load
         end if
      end select
      k_s = area*shear_slope(law, state%branch, state%sense*state%delta, pressure)
   end subroutine shear


   !> The least change of delta that counts as a movement: what is below it is rounding, beside the stresses that the element
   !! bears or could bear [length].
   pure real(wp) function least_movement(law, state, pressure) result(least)
      type(shear_law), intent(in)   :: law
      type(shear_state), intent(in) :: state
      real(wp), intent(in)          :: pressure
      real(wp) :: stress

      stress = max(abs(state%tau), abs(state%tau_before), abs(pressure))
      least = rounding*stress/max(shear_slope(law, branch_load, 0.0_wp, pressure), tiny(1.0_wp)*1.0e100_wp)
   end function least_movement


   !> The unloading branch has come to the mirror of A: it joins the loading curve of the other sense.
   pure subroutine change_sense(state)
      type(shear_state), intent(inout) :: state

      state%sense = -state%sense
      state%branch = branch_load
   end subroutine change_sense


   !> d tau/d d of a branch at D under the pressure P, not below zero [pressure/length].
   pure real(wp) function shear_slope(law, branch, d, p) result(slope)
      type(shear_law), intent(in) :: law
      integer, intent(in)         :: branch
      real(wp), intent(in)        :: d !! in the sense of the branch [length]
      real(wp), intent(in)        :: p !! [pressure]
      real(wp) :: a(3)

      a = law%coefficients(1, :, branch) + law%coefficients(2, :, branch)*p
      slope = max(0.0_wp, a(1) + d*(2.0_wp*a(2) + d*3.0_wp*a(3)))
   end function shear_slope


   !> How that slope changes with d and with p; both zero where it is cut off at zero.
   pure subroutine shear_slope_derivatives(law, branch, d, p, by_d, by_p)
      type(shear_law), intent(in) :: law
      integer, intent(in)         :: branch
      real(wp), intent(in)        :: d, p
      real(wp), intent(out)       :: by_d, by_p
      real(wp) :: a(3)

      by_d = 0.0_wp
      by_p = 0.0_wp
      if (shear_slope(law, branch, d, p) <= 0.0_wp) return
      a = law%coefficients(1, :, branch) + law%coefficients(2, :, branch)*p
      by_d = 2.0_wp*a(2) + 6.0_wp*a(3)*d
      a = law%coefficients(2, :, branch)
      by_p = a(1) + d*(2.0_wp*a(2) + d*3.0_wp*a(3))
   end subroutine shear_slope_derivatives


   !> Virgin state: what an element has at first, and again when it has been open.
   pure subroutine start_shear(state)
      type(shear_state), intent(out) :: state

      state%sense = 1.0_wp
   end subroutine start_shear

end module shear_stiffness
