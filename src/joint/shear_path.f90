!> The exact shear law of the joint over one step, for methods that iterate to equilibrium: the branch polynomials, piece by
!! piece, each bit of the way along the curve of the pressure that it is made under (Fig. 4b), pressure and deflection
!! changing in proportion. At constant pressure this is the polynomial itself.
module shear_path
   use kinds, only: wp
   use normal_stiffness, only: branch_load
   use shear_stiffness, only: branch_end, cubic_of, cubic_slope_derivatives, join_loading, least_movement, shear_law, &
                              shear_slope, shear_state, turn
   implicit none
   private

   public :: follow_shear

   real(wp), parameter :: rounding = 1.0e-9_wp ! of the way: an end so near to a corner is the corner
   real(wp), parameter :: gauss_2(2) = 0.5_wp + [-0.5_wp, 0.5_wp]/sqrt(3.0_wp)          ! on 0..1, weights 1/2
   real(wp), parameter :: gauss_3(3) = 0.5_wp + [-0.5_wp, 0.0_wp, 0.5_wp]*sqrt(0.6_wp)  ! on 0..1
   real(wp), parameter :: weight_3(3) = [5.0_wp, 8.0_wp, 5.0_wp]/18.0_wp

   !> The straight way of one step: (delta, p) is start + f change at the fraction f of it.
   type :: way_type
      real(wp) :: start(2) = 0.0_wp, change(2) = 0.0_wp
   end type way_type

contains

   !> Follow the law from the state BEFORE to the deflection DELTA, the pressure going from P(1) to P(2).
   pure subroutine follow_shear(law, before, delta, p, after, by_delta, by_p, work)
      type(shear_law), intent(in)    :: law
      type(shear_state), intent(in)  :: before
      real(wp), intent(in)           :: delta    !! [length]
      real(wp), intent(in)           :: p(2)     !! [pressure]
      type(shear_state), intent(out) :: after
      real(wp), intent(out)          :: by_delta !! d tau/d DELTA [pressure/length]
      real(wp), intent(out)          :: by_p     !! d tau/d P(2) [-]
      real(wp), intent(out)          :: work     !! integral of tau d delta [pressure x length]
      type(way_type) :: way
      real(wp) :: from, to
      integer  :: pieces
      logical  :: at_corner

      after = before
      after%delta_before = before%delta
      after%tau_before = before%tau
      after%delta = delta
      by_delta = 0.0_wp
      by_p = 0.0_wp
      work = 0.0_wp
      if (.not. law%given) return
      way = way_type(start=[before%delta, p(1)], change=[delta - before%delta, p(2) - p(1)])
      if (abs(way%change(1)) <= least_movement(law, before, p(2))) then
         by_delta = shear_slope(law, after, [delta, p(2)])
         after%tau = before%tau + by_delta*way%change(1)
         return
      end if
      call turn(after%sense*way%change(1) < 0.0_wp, after)
      from = 0.0_wp
      do pieces = 1, 4 ! load, unload, load of the other sense are the most there can be; the fourth is never left
         call end_of_piece(after, way, from, to, at_corner)
         call follow_piece(law, after, way, from, to, by_delta, by_p, work)
         if (.not. at_corner) exit
         by_delta = by_delta - to*shear_slope(law, after, way%start + to*way%change)
         call join_loading(after)
         by_delta = by_delta + to*shear_slope(law, after, way%start + to*way%change)
         if (to >= 1.0_wp) exit
         from = to
      end do
   end subroutine follow_shear

   !> The fraction TO of the way at which the branch of STATE ends: 1, or before that the corner where it joins a loading
   !! curve (AT_CORNER).
   pure subroutine end_of_piece(state, way, from, to, at_corner)
      type(shear_state), intent(in) :: state
      type(way_type), intent(in)    :: way
      real(wp), intent(in)          :: from
      real(wp), intent(out)         :: to
      logical, intent(out)          :: at_corner

      to = 1.0_wp
      at_corner = .false.
      if (state%branch == branch_load) return
      to = (state%sense*branch_end(state) - way%start(1))/way%change(1)
      at_corner = to < 1.0_wp + rounding
      if (abs(to - 1.0_wp) <= rounding) to = 1.0_wp
      to = min(1.0_wp, max(from, to))
   end subroutine end_of_piece

   !> Along one branch from fraction FROM to TO: stress, its derivatives, work.
   !! tau = integral of g d delta, g the slope; with f the fraction of the way,
   !!    d tau/d delta_end = integral of (g + f D dg/d delta) d f,   d tau/d p_end = integral of f D dg/dp d f,
   !! D being the change of delta.
   pure subroutine follow_piece(law, state, way, from, to, by_delta, by_p, work)
      type(shear_law), intent(in)      :: law
      type(shear_state), intent(inout) :: state
      type(way_type), intent(in)       :: way
      real(wp), intent(in)             :: from, to
      real(wp), intent(inout)          :: by_delta, by_p, work
      real(wp) :: f, place(2), step, slope_by_d, slope_by_p, tau
      integer  :: i

      step = to - from
      if (step <= 0.0_wp) return
      do i = 1, 3
         f = from + step*gauss_3(i)
         tau = state%tau + stress_gain(law, state, way, from, f)
         work = work + weight_3(i)*step*way%change(1)*tau
      end do
      do i = 1, 2
         f = from + step*gauss_2(i)
         place = way%start + f*way%change
         call cubic_slope_derivatives(cubic_of(law, state%branch), state%sense*place(1), place(2), slope_by_d, slope_by_p)
         by_delta = by_delta + 0.5_wp*step*(shear_slope(law, state, place) + f*way%change(1)*state%sense*slope_by_d)
         by_p = by_p + 0.5_wp*step*f*way%change(1)*slope_by_p
      end do
      state%tau = state%tau + stress_gain(law, state, way, from, to)
   end subroutine follow_piece

   !> Integral of the slope over the deflection from fraction FROM to TO; two Gauss points are exact for a cubic.
   pure real(wp) function stress_gain(law, state, way, from, to) result(gain)
      type(shear_law), intent(in)   :: law
      type(shear_state), intent(in) :: state
      type(way_type), intent(in)    :: way
      real(wp), intent(in)          :: from, to
      real(wp) :: f
      integer  :: i

      gain = 0.0_wp
      do i = 1, 2
         f = from + (to - from)*gauss_2(i)
         gain = gain + 0.5_wp*(to - from)*way%change(1)*shear_slope(law, state, way%start + f*way%change)
      end do
   end function stress_gain

end module shear_path
