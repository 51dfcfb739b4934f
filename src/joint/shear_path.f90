!> The exact shear law of the joint over one step, for methods that iterate to equilibrium.
!! Pressure and deflection change in proportion. The path consists of pieces of the branch polynomials; each part of the path
!! follows the curve of its current pressure (Fig. 4b). At constant pressure the path is the polynomial itself. Along such a
!! path every curve is a polynomial in the fraction f of the path. Hence a piece ends exactly where a branch meets a loading
!! curve.
module shear_path
   use branch_cubic, only: cubic, cubic_by_pressure, cubic_slope, cubic_slope_derivatives, cubic_value, slope_on_way, value_on_way
   use kinds, only: wp
   use normal_stiffness, only: branch_load
   use numbers, only: derivative, enclosed_zero, find_zeros, polynomial, zero_list
   use shear_stiffness, only: cubic_of, goal_sense, join_loading, least_movement, least_stress, leave_offset, shear_law, &
                              shear_slope, shear_state, turn
   implicit none
   private

   public :: follow_shear

   integer, parameter  :: most_pieces = 50      ! more pieces than the polynomials of a path can have turns
   real(wp), parameter :: rounding = 1.0e-12_wp ! of the path: no shorter piece is begun; of slopes: no difference
   real(wp), parameter :: gauss_2(2) = 0.5_wp + [-0.5_wp, 0.5_wp]/sqrt(3.0_wp)          ! on 0..1, weights 1/2
   real(wp), parameter :: gauss_3(3) = 0.5_wp + [-0.5_wp, 0.0_wp, 0.5_wp]*sqrt(0.6_wp)  ! on 0..1
   real(wp), parameter :: weight_3(3) = [5.0_wp, 8.0_wp, 5.0_wp]/18.0_wp

   !> The straight path of one step: (delta - delta_0, p) is start + f change at the fraction f of the path.
   type :: way_type
      real(wp) :: start(2) = 0.0_wp, change(2) = 0.0_wp
   end type way_type

   !> A piece of the path, from the fraction FROM to TO, on which tau follows the slope of one cubic.
   type :: piece_type
      real(wp)    :: from = 0.0_wp, to = 1.0_wp
      type(cubic) :: curve
      real(wp)    :: sense = 1.0_wp          ! its d is sense*(delta - delta_0)
      logical     :: meets = .false.         ! it ends on the loading curve that the branch approaches
      logical     :: ends_at_a = .false.     ! it ends at d_r
   end type piece_type

   !> Sums along the path: derivatives of tau by the end point, and work.
   type :: gain_type
      real(wp) :: by_delta = 0.0_wp, by_p = 0.0_wp, work = 0.0_wp
   end type gain_type

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
      type(way_type)   :: way
      type(piece_type) :: piece
      type(gain_type)  :: gain
      real(wp) :: moved
      integer  :: i

      after = before
      after%delta_before = before%delta
      after%tau_before = before%tau
      by_delta = 0.0_wp
      by_p = 0.0_wp
      work = 0.0_wp
      moved = delta - before%delta
      if (law%given) call leave_offset(law, p(1), after)
      after%delta = delta
      if (.not. law%given) return
      if (abs(moved) <= least_movement(law, before, p(2))) then
         by_delta = shear_slope(law, after, p(2))
         after%tau = before%tau + by_delta*moved
         call leave_offset(law, p(2), after)
         return
      end if
      way = way_type(start=[before%delta - before%delta_0, p(1)], change=[moved, p(2) - p(1)])
      call turn(after%sense*moved < 0.0_wp, after)
      do i = 1, most_pieces
         call next_piece(law, after, way, piece)
         call follow_piece(piece, way, after, gain)
         if (piece%meets) then
            call pass_corner(law, piece, way, after, gain)
         else if (piece%ends_at_a) then
            call pass_a(law, piece, way, after, gain)
         end if
         if (piece%to >= 1.0_wp) exit
         piece%from = piece%to
      end do
      call leave_offset(law, p(2), after)
      by_delta = gain%by_delta
      by_p = gain%by_p
      work = gain%work
   end subroutine follow_shear

   !> The piece that begins at PIECE%FROM, with the stress of STATE. It ends at the first of these points: the end of the path;
   !! a zero of a slope, where the slope is cut off; d = 0, where the curve begins that the branch approaches; d_r; the point
   !! where the branch meets that curve; past d_r the point where the other of the two slopes becomes the steeper one.
   pure subroutine next_piece(law, state, way, piece)
      type(shear_law), intent(in)     :: law
      type(shear_state), intent(in)   :: state
      type(way_type), intent(in)      :: way
      type(piece_type), intent(inout) :: piece
      real(wp) :: d(2), p(2), goal, at_a, slope(0:4), goal_slope(0:4), excess(0:4)

      piece = piece_type(from=piece%from, curve=cubic_of(law, state%branch), sense=state%sense)
      p = [way%start(2), way%change(2)]
      slope = slope_on_way(piece%curve, piece%sense*[way%start(1), way%change(1)], p)
      call end_at_zeros(slope, piece)
      if (state%branch == branch_load) return
      goal = goal_sense(state)
      d = goal*[way%start(1), way%change(1)]
      if (piece%from < -d(1)/d(2)) then
         piece%to = min(piece%to, -d(1)/d(2))
         return
      end if
      at_a = (state%d_r - d(1))/d(2)
      if (piece%from + rounding < at_a) then
         piece%ends_at_a = at_a <= piece%to
         piece%to = min(piece%to, at_a)
      else
         goal_slope = slope_on_way(law%load, d, p)
         excess = excess_over_goal(law, state, way, piece, slope)
         if (polynomial(excess, piece%from) > least_stress(state, maxval(p))) then
            piece%ends_at_a = .true. ! above the curve at d_r or past it
            piece%to = piece%from
            return
         end if
         call end_at_zeros(goal_slope, piece)
         call end_at_zeros(slope - goal_slope, piece)
         if (polynomial(goal_slope, 0.5_wp*(piece%from + piece%to)) > polynomial(slope, 0.5_wp*(piece%from + piece%to))) then
            piece%curve = law%load
            piece%sense = goal
            slope = goal_slope
         end if
      end if
      excess = excess_over_goal(law, state, way, piece, slope)
      call end_at_meeting(excess, least_stress(state, maxval(p)), piece)
   end subroutine next_piece

   !> tau less the curve that the branch approaches, as a polynomial in f: the stress at the beginning of PIECE plus the
   !! integral of SLOPE, less the curve [pressure].
   pure function excess_over_goal(law, state, way, piece, slope) result(excess)
      type(shear_law), intent(in)   :: law
      type(shear_state), intent(in) :: state
      type(way_type), intent(in)    :: way
      type(piece_type), intent(in)  :: piece
      real(wp), intent(in)          :: slope(0:4)
      real(wp) :: excess(0:4), d(2), goal

      goal = goal_sense(state)
      d = goal*[way%start(1), way%change(1)]
      excess = 0.0_wp
      if (polynomial(slope, 0.5_wp*(piece%from + piece%to)) > 0.0_wp) excess(1:) = d(2)*slope(:3)/[1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp]
      excess(0) = goal*state%tau - state%offset - polynomial(excess, piece%from)
      excess = excess - value_on_way(law%load, d, [way%start(2), way%change(2)])
   end function excess_over_goal

   !> Let a piece end at the first zero of the polynomial C, if any.
   pure subroutine end_at_zeros(c, piece)
      real(wp), intent(in)            :: c(0:4)
      type(piece_type), intent(inout) :: piece
      type(zero_list) :: zeros

      call find_zeros(c, piece%from + rounding, piece%to, zeros)
      if (zeros%n > 0) piece%to = zeros%x(1)
   end subroutine end_at_zeros

   !> Let a piece end where it first meets its goal: where EXCESS passes through zero or comes within LEAST of it. The latter is
   !! possible at the beginning, at the end and at the extrema of EXCESS.
   pure subroutine end_at_meeting(excess, least, piece)
      real(wp), intent(in)            :: excess(0:4), least
      type(piece_type), intent(inout) :: piece
      type(zero_list) :: turns
      real(wp) :: ends(0:5)
      integer  :: i

      call find_zeros(derivative(excess), piece%from, piece%to, turns)
      ends(:turns%n + 1) = [piece%from, turns%x(:turns%n), piece%to]
      do i = 0, turns%n + 1
         piece%meets = .true.
         piece%to = ends(i)
         if (abs(polynomial(excess, ends(i))) <= least) return
         if (i > turns%n) exit
         if ((polynomial(excess, ends(i)) > 0.0_wp) .neqv. (polynomial(excess, ends(i + 1)) > 0.0_wp)) then
            piece%to = enclosed_zero(excess, ends(i:i + 1))
            return
         end if
      end do
      piece%meets = .false.
   end subroutine end_at_meeting

   !> At d_r the branch has not met the curve that it approaches. Above the curve it becomes the loading branch with an o of its
   !! own; below, it continues along the steeper slope. The fraction at d_r changes with the end of the path. With t that
   !! fraction, g the slope,
   !!    d tau_end/d end = ... - t (g_before - g_after).
   pure subroutine pass_a(law, piece, way, state, gain)
      type(shear_law), intent(in)      :: law
      type(piece_type), intent(in)     :: piece
      type(way_type), intent(in)       :: way
      type(shear_state), intent(inout) :: state
      type(gain_type), intent(inout)   :: gain
      real(wp) :: d, goal, p, own, loading

      goal = goal_sense(state)
      d = goal*(way%start(1) + piece%to*way%change(1))
      p = way%start(2) + piece%to*way%change(2)
      own = cubic_slope(piece%curve, piece%sense*goal*d, p)
      loading = cubic_slope(law%load, d, p)
      if (goal*state%tau - state%offset > cubic_value(law%load, d, p)) then
         call join_loading(state)
      else
         loading = max(loading, own)
      end if
      gain%by_delta = gain%by_delta - piece%to*(own - loading)
   end subroutine pass_a

   !> Pass from the end of a piece onto the loading curve that it meets there. The fraction at that point changes with the end
   !! of the path: with t that fraction, e(t) = 0 the excess over the curve, g the slope, D the change of delta,
   !!    d tau_end/d end = ... + (g_before - g_after) D dt/d end,   dt/d end = -(de/d end)/(de/dt).
   pure subroutine pass_corner(law, piece, way, state, gain)
      type(shear_law), intent(in)      :: law
      type(piece_type), intent(in)     :: piece
      type(way_type), intent(in)       :: way
      type(shear_state), intent(inout) :: state
      type(gain_type), intent(inout)   :: gain
      real(wp) :: place(2), goal, d, slopes(2), by_p, rate, jump, curve_slope

      goal = goal_sense(state)
      place = way%start + piece%to*way%change
      d = goal*place(1)
      slopes = [cubic_slope(piece%curve, piece%sense*place(1), place(2)), cubic_slope(law%load, d, place(2))]
      curve_slope = polynomial(slope_on_way(law%load, goal*[way%start(1), way%change(1)], [way%start(2), way%change(2)]), piece%to)
      by_p = cubic_by_pressure(law%load, d)
      rate = goal*way%change(1)*(slopes(1) - curve_slope) - by_p*way%change(2)
      jump = way%change(1)*(slopes(1) - slopes(2))
      if (abs(rate) > rounding*(abs(way%change(1))*sum(slopes) + abs(by_p*way%change(2)))) then
         gain%by_delta = gain%by_delta - jump*goal*(gain%by_delta - curve_slope*piece%to)/rate
         gain%by_p = gain%by_p - jump*(goal*gain%by_p - by_p*piece%to)/rate
      end if
      state%tau = goal*(cubic_value(law%load, d, place(2)) + state%offset)
      call join_loading(state)
   end subroutine pass_corner

   !> Integrate along one piece: stress, its derivatives, work. tau = integral of g d delta, g the slope; with f the fraction of
   !! the path,
   !!    d tau/d delta_end = integral of (g + f D dg/d delta) d f,   d tau/d p_end = integral of f D dg/dp d f,
   !! D being the change of delta.
   pure subroutine follow_piece(piece, way, state, gain)
      type(piece_type), intent(in)     :: piece
      type(way_type), intent(in)       :: way
      type(shear_state), intent(inout) :: state
      type(gain_type), intent(inout)   :: gain
      real(wp) :: f, place(2), step, slope, slope_by_d, slope_by_p, tau
      integer  :: i

      step = piece%to - piece%from
      if (step <= 0.0_wp) return
      do i = 1, 3
         f = piece%from + step*gauss_3(i)
         tau = state%tau + stress_gain(piece, way, f)
         gain%work = gain%work + weight_3(i)*step*way%change(1)*tau
      end do
      do i = 1, 2
         f = piece%from + step*gauss_2(i)
         place = way%start + f*way%change
         slope = cubic_slope(piece%curve, piece%sense*place(1), place(2))
         call cubic_slope_derivatives(piece%curve, piece%sense*place(1), place(2), slope_by_d, slope_by_p)
         gain%by_delta = gain%by_delta + 0.5_wp*step*(slope + f*way%change(1)*piece%sense*slope_by_d)
         gain%by_p = gain%by_p + 0.5_wp*step*f*way%change(1)*slope_by_p
      end do
      state%tau = state%tau + stress_gain(piece, way, piece%to)
   end subroutine follow_piece

   !> Integral of the slope over the deflection from the beginning of PIECE to the fraction TO; two Gauss points are exact.
   pure real(wp) function stress_gain(piece, way, to) result(gain)
      type(piece_type), intent(in) :: piece
      type(way_type), intent(in)   :: way
      real(wp), intent(in)         :: to
      real(wp) :: place(2)
      integer  :: i

      gain = 0.0_wp
      do i = 1, 2
         place = way%start + (piece%from + (to - piece%from)*gauss_2(i))*way%change
         gain = gain + 0.5_wp*(to - piece%from)*way%change(1)*cubic_slope(piece%curve, piece%sense*place(1), place(2))
      end do
   end function stress_gain

end module shear_path
