!> The exact shear law of the joint over one step, for methods that iterate to equilibrium: the branch polynomials, piece by
!! piece, each bit of the way along the curve of the pressure that it is made under (Fig. 4b), pressure and deflection
!! changing in proportion. At constant pressure this is the polynomial itself.
module shear_path
   use kinds, only: wp
   use normal_stiffness, only: branch_load, branch_reload, branch_unload
   use shear_stiffness, only: least_movement, shear_law, shear_slope, shear_slope_derivatives, shear_state
   implicit none
   private

   public :: follow_shear

   real(wp), parameter :: rounding = 1.0e-9_wp ! of the way: an end so near to a corner is the corner
   real(wp), parameter :: gauss_2(2) = 0.5_wp + [-0.5_wp, 0.5_wp]/sqrt(3.0_wp)          ! on 0..1, weights 1/2
   real(wp), parameter :: gauss_3(3) = 0.5_wp + [-0.5_wp, 0.0_wp, 0.5_wp]*sqrt(0.6_wp)  ! on 0..1
   real(wp), parameter :: weight_3(3) = [5.0_wp, 8.0_wp, 5.0_wp]/18.0_wp

   !> The straight way of one step: delta and p at the fraction f of it.
   type :: way_type
      real(wp) :: delta_0 = 0.0_wp, d_delta = 0.0_wp
      real(wp) :: p_0 = 0.0_wp, d_p = 0.0_wp
   end type way_type

contains

   !> Follow the law from the state BEFORE, at pressure P_BEFORE, to the deflection DELTA at pressure P.
   pure subroutine follow_shear(law, before, p_before, delta, p, after, by_delta, by_p, work)
      type(shear_law), intent(in)    :: law
      type(shear_state), intent(in)  :: before
      real(wp), intent(in)           :: p_before !! [pressure]
      real(wp), intent(in)           :: delta    !! [length]
      real(wp), intent(in)           :: p        !! [pressure]
      type(shear_state), intent(out) :: after
      real(wp), intent(out)          :: by_delta !! d tau/d DELTA [pressure/length]
      real(wp), intent(out)          :: by_p     !! d tau/d P [-]
      real(wp), intent(out)          :: work     !! integral of tau d delta [pressure x length]
      type(way_type) :: way
      real(wp) :: from, to, movement
      integer  :: pieces
      logical  :: at_corner

      after = before
      after%delta_before = before%delta
      after%tau_before = before%tau
      after%delta = delta
      work = 0.0_wp
      by_p = 0.0_wp
      movement = delta - before%delta
      way = way_type(before%delta, movement, p_before, p - p_before)
      if (abs(movement) <= least_movement(law, before, p) .or. .not. law%given) then
         by_delta = 0.0_wp
         if (law%given) by_delta = shear_slope(law, after%branch, after%sense*delta, p)
         after%tau = before%tau + by_delta*movement
         return
      end if
      call turn(after, before, movement)
      by_delta = 0.0_wp
      from = 0.0_wp
      do pieces = 1, 4 ! load, unload, load of the other sense are the most there can be; the fourth is never left
         call end_of_piece(after, way, from, to, at_corner)
         call follow_piece(law, after, way, from, to, by_delta, by_p, work)
         if (.not. at_corner) exit
         by_delta = by_delta - to*shear_slope_at(law, after, way, to)
         if (after%branch == branch_unload) after%sense = -after%sense
         after%branch = branch_load
         by_delta = by_delta + to*shear_slope_at(law, after, way, to)
         if (to >= 1.0_wp) exit
         from = to
      end do
   end subroutine follow_shear


   !> The branch on which the step begins, by the sense of its movement.
   pure subroutine turn(state, before, movement)
      type(shear_state), intent(inout) :: state
      type(shear_state), intent(in)    :: before
      real(wp), intent(in)             :: movement

      if (state%sense*movement < 0.0_wp) then
         if (state%branch == branch_load) then
            state%d_r = state%sense*before%delta
            state%tau_r = state%sense*before%tau
         end if
         state%branch = branch_unload
      else if (state%branch == branch_unload) then
         state%d_s = state%sense*before%delta
         state%tau_s = state%sense*before%tau
         state%branch = branch_reload
      end if
   end subroutine turn


   !> The fraction TO of the way at which the branch of STATE ends: 1, or before that the corner where it joins a loading
   !! curve (AT_CORNER).
   pure subroutine end_of_piece(state, way, from, to, at_corner)
      type(shear_state), intent(in) :: state
      type(way_type), intent(in)    :: way
      real(wp), intent(in)          :: from
      real(wp), intent(out)         :: to
      logical, intent(out)          :: at_corner
      real(wp) :: corner

      to = 1.0_wp
      at_corner = .false.
      if (state%branch == branch_load) return
      corner = state%sense*merge(state%d_r, -state%d_r, state%branch == branch_reload)
      to = (corner - way%delta_0)/way%d_delta
      at_corner = to < 1.0_wp + rounding
      if (abs(to - 1.0_wp) <= rounding) to = 1.0_wp
      to = min(1.0_wp, max(from, to))
   end subroutine end_of_piece


   !> Along one branch from fraction FROM to TO: stress, its derivatives, work.
   !! tau = integral of g d delta, g the slope; with f the fraction of the way,
   !!    d tau/d delta_end = integral of (g + f D dg/d delta) d f,   d tau/d p_end = integral of f D dg/dp d f,   D = d_delta
   pure subroutine follow_piece(law, state, way, from, to, by_delta, by_p, work)
      type(shear_law), intent(in)      :: law
      type(shear_state), intent(inout) :: state
      type(way_type), intent(in)       :: way
      real(wp), intent(in)             :: from, to
      real(wp), intent(inout)          :: by_delta, by_p, work
      real(wp) :: f, step, slope_by_d, slope_by_p, tau
      integer  :: i

      step = to - from
      if (step <= 0.0_wp) return
      do i = 1, 3
         f = from + step*gauss_3(i)
         tau = state%tau + stress_gain(law, state, way, from, f)
         work = work + weight_3(i)*step*way%d_delta*tau
      end do
      do i = 1, 2
         f = from + step*gauss_2(i)
         call shear_slope_derivatives(law, state%branch, state%sense*(way%delta_0 + f*way%d_delta), way%p_0 + f*way%d_p, &
                                      slope_by_d, slope_by_p)
         by_delta = by_delta + 0.5_wp*step*(shear_slope_at(law, state, way, f) + f*way%d_delta*state%sense*slope_by_d)
         by_p = by_p + 0.5_wp*step*f*way%d_delta*slope_by_p
      end do
      state%tau = state%tau + stress_gain(law, state, way, from, to)
   end subroutine follow_piece


   !> Integral of the slope over the deflection from fraction FROM to TO; two Gauss points are exact for a cubic.
   pure real(wp) function stress_gain(law, state, way, from, to) result(gain)
      type(shear_law), intent(in)   :: law
      type(shear_state), intent(in) :: state
      type(way_type), intent(in)    :: way
      real(wp), intent(in)          :: from, to
      integer :: i

      gain = 0.0_wp
      do i = 1, 2
         gain = gain + 0.5_wp*(to - from)*way%d_delta*shear_slope_at(law, state, way, from + (to - from)*gauss_2(i))
      end do
   end function stress_gain


   pure real(wp) function shear_slope_at(law, state, way, f) result(slope)
      type(shear_law), intent(in)   :: law
      type(shear_state), intent(in) :: state
      type(way_type), intent(in)    :: way
      real(wp), intent(in)          :: f

      slope = shear_slope(law, state%branch, state%sense*(way%delta_0 + f*way%d_delta), way%p_0 + f*way%d_p)
   end function shear_slope_at

end module shear_path
