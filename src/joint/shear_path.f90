!> The exact shear law of the joint over one step, for methods that iterate to equilibrium.
!! Pressure and deflection change in proportion. The path consists of pieces of the branch polynomials; each part of the path
!! follows the curve of its current pressure (Fig. 4b). At constant pressure the path is the polynomial itself. Along such a
!! path every curve is a polynomial in the fraction f of the path. Hence a piece ends exactly where a branch meets a loading
!! curve.
module shear_path
   use branch_cubic, only: cubic_slope, cubic_slope_derivatives, cubic_value, slope_on_way, value_on_way
   use kinds, only: wp
   use normal_stiffness, only: branch_load
   use numbers, only: derivative, enclosed_zero, find_zeros, polynomial, zero_list
   use shear_stiffness, only: curve_of, followed_curve, goal_sense, join_loading, least_movement, least_stress, leave_offset, &
                              shear_law, shear_slope, shear_state, turn
   use tolerances, only: rounding_of_path
   implicit none
   private

   public :: follow_shear

   integer, parameter  :: most_pieces = 50      ! more pieces than the polynomials of a path can have turns
   real(wp), parameter :: gauss_2(2) = 0.5_wp + [-0.5_wp, 0.5_wp]/sqrt(3.0_wp)          ! on 0..1, weights 1/2
   real(wp), parameter :: gauss_3(3) = 0.5_wp + [-0.5_wp, 0.0_wp, 0.5_wp]*sqrt(0.6_wp)  ! on 0..1
   real(wp), parameter :: weight_3(3) = [5.0_wp, 8.0_wp, 5.0_wp]/18.0_wp

   !> A piece of the path, from the fraction FROM to TO, on which tau follows the slope of one cubic.
   type :: piece_type
      real(wp)    :: from = 0.0_wp, to = 1.0_wp
      type(followed_curve) :: on             ! its origin counts from delta_0, as the place on the way
      logical     :: meets = .false.         ! it ends on the loading curve that the branch approaches
      logical     :: ends_at_a = .false.     ! it ends at d_r
   end type piece_type

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
      real(wp), intent(out), optional :: work    !! integral of tau d delta [pressure x length]
      type(piece_type) :: piece
      real(wp) :: way(2, 2) ! (delta - delta_0 and p; start and change): the place at the fraction f is start + f change
      real(wp) :: moved
      integer  :: i

      after = before
      after%delta_before = before%delta
      after%tau_before = before%tau
      by_delta = 0.0_wp
      by_p = 0.0_wp
      if (present(work)) work = 0.0_wp
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
      way = reshape([before%delta - before%delta_0, p(1), moved, p(2) - p(1)], [2, 2])
      call turn(after%sense*moved < 0.0_wp, after)
      do i = 1, most_pieces
         call next_piece(law, after, way, piece)
         call follow_piece(piece, way, after, by_delta, by_p, work)
         if (piece%meets .or. piece%ends_at_a) call pass_corner(law, piece, way, after, by_delta, by_p)
         if (piece%to >= 1.0_wp) exit
         piece%from = piece%to
      end do
      call leave_offset(law, p(2), after)
   end subroutine follow_shear

   !> The piece that begins at PIECE%FROM, with the stress of STATE. It ends at the first of these points: the end of the path;
   !! a zero of a slope, where the slope is cut off; d = 0, where the curve begins that the branch approaches; d_r; the point
   !! where the branch meets that curve; past d_r the point where the other of the two slopes becomes the steeper one.
   pure subroutine next_piece(law, state, way, piece)
      type(shear_law), intent(in)     :: law
      type(shear_state), intent(in)   :: state
      real(wp), intent(in)            :: way(2, 2)
      type(piece_type), intent(inout) :: piece
      type(zero_list) :: turns
      real(wp) :: d(2), goal, at_a, least, slope(0:4), goal_slope(0:4), excess(0:4), ends(0:5)
      integer  :: i

      piece = piece_type(from=piece%from, on=curve_of(law, state))
      piece%on%origin = piece%on%origin - state%delta_0
      slope = slope_on_way(piece%on%curve, piece%on%sense*[way(1, 1) - piece%on%origin, way(1, 2)], way(2, :))
      piece%to = first_zero(slope)
      if (state%branch == branch_load) return
      goal = goal_sense(state)
      d = goal*way(1, :)
      if (piece%from < -d(1)/d(2)) then
         piece%to = min(piece%to, -d(1)/d(2))
         return
      end if
      least = least_stress(state, maxval(way(2, :)))
      at_a = (state%d_r - d(1))/d(2)
      if (piece%from + rounding_of_path < at_a) then
         piece%ends_at_a = at_a <= piece%to
         piece%to = min(piece%to, at_a)
      else
         goal_slope = slope_on_way(law%load, d, way(2, :))
         excess = excess_over_goal(slope)
         if (polynomial(excess, piece%from) > least) then
            piece%ends_at_a = .true. ! above the curve at d_r or past it
            piece%to = piece%from
            return
         end if
         piece%to = first_zero(goal_slope)
         piece%to = first_zero(slope - goal_slope)
         if (polynomial(goal_slope, 0.5_wp*(piece%from + piece%to)) > polynomial(slope, 0.5_wp*(piece%from + piece%to))) then
            piece%on = followed_curve(law%load, goal, 0.0_wp)
            slope = goal_slope
         end if
      end if

      ! the curve is met where the excess passes through zero or comes within rounding of it, at an end or an extremum
      excess = excess_over_goal(slope)
      call find_zeros(derivative(excess), piece%from, piece%to, turns)
      ends(:turns%n + 1) = [piece%from, turns%x(:turns%n), piece%to]
      do i = 0, turns%n + 1
         piece%meets = abs(polynomial(excess, ends(i))) <= least
         if (piece%meets) piece%to = ends(i)
         if (piece%meets .or. i > turns%n) exit
         piece%meets = (polynomial(excess, ends(i)) > 0.0_wp) .neqv. (polynomial(excess, ends(i + 1)) > 0.0_wp)
         if (piece%meets) piece%to = enclosed_zero(excess, ends(i:i + 1))
         if (piece%meets) exit
      end do

   contains

      !> The first zero of the polynomial C on the piece, or else its end.
      pure real(wp) function first_zero(c) result(f)
         real(wp), intent(in) :: c(0:4)
         type(zero_list) :: zeros

         call find_zeros(c, piece%from + rounding_of_path, piece%to, zeros)
         f = piece%to
         if (zeros%n > 0) f = zeros%x(1)
      end function first_zero

      !> tau less the curve that the branch approaches, as a polynomial in f: the stress at the beginning of the piece plus the
      !! integral of SLOPE, less the curve [pressure].
      pure function excess_over_goal(slope) result(excess)
         real(wp), intent(in) :: slope(0:4)
         real(wp) :: excess(0:4)

         excess = 0.0_wp
         if (polynomial(slope, 0.5_wp*(piece%from + piece%to)) > 0.0_wp) &
            excess(1:) = d(2)*slope(:3)/[1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp]
         excess(0) = goal*state%tau - state%offset - polynomial(excess, piece%from)
         excess = excess - value_on_way(law%load, d, way(2, :))
      end function excess_over_goal

   end subroutine next_piece

   !> Pass the end of PIECE where the slope jumps from g_before to g_after, D being the change of delta. The fraction t at this
   !! point changes with the end of the path:
   !!    d tau_end/d end = ... + (g_before - g_after) D dt/d end
   !! Where the branch meets the loading curve, it joins it; e(t) = 0 is the excess over the curve, dt/d end = -(de/d end)/(de/dt).
   !! At d_r the branch has not met the curve. Above the curve it becomes the loading branch with an o of its own; below, it
   !! continues along the steeper slope. There dt/d end = -t/D.
   pure subroutine pass_corner(law, piece, way, state, by_delta, by_p)
      type(shear_law), intent(in)      :: law
      type(piece_type), intent(in)     :: piece
      real(wp), intent(in)             :: way(2, 2)
      type(shear_state), intent(inout) :: state
      real(wp), intent(inout)          :: by_delta, by_p
      real(wp) :: place(2), goal, d, slopes(2), b(3), curve, curve_slope, curve_by_p, rate, jump

      goal = goal_sense(state)
      place = way(:, 1) + piece%to*way(:, 2)
      d = goal*place(1)
      slopes = [slope_at(piece, place), cubic_slope(law%load, d, place(2))]
      curve = cubic_value(law%load, d, place(2))
      if (.not. piece%meets) then
         if (goal*state%tau - state%offset > curve) then
            call join_loading(state)
         else
            slopes(2) = max(slopes(2), slopes(1))
         end if
         by_delta = by_delta - piece%to*(slopes(1) - slopes(2))
         return
      end if
      curve_slope = polynomial(slope_on_way(law%load, goal*way(1, :), way(2, :)), piece%to)
      b = law%load%coefficients(2, :)
      curve_by_p = d*(b(1) + d*(b(2) + d*b(3))) ! dP/dp; it does not depend on the pressure
      rate = goal*way(1, 2)*(slopes(1) - curve_slope) - curve_by_p*way(2, 2)
      jump = way(1, 2)*(slopes(1) - slopes(2))
      if (abs(rate) > rounding_of_path*(abs(way(1, 2))*sum(slopes) + abs(curve_by_p*way(2, 2)))) then
         by_delta = by_delta - jump*goal*(by_delta - curve_slope*piece%to)/rate
         by_p = by_p - jump*(goal*by_p - curve_by_p*piece%to)/rate
      end if
      state%tau = goal*(curve + state%offset)
      call join_loading(state)
   end subroutine pass_corner

   !> Integrate along one piece: stress, its derivatives, work. tau = integral of g d delta, g the slope; with f the fraction of
   !! the path,
   !!    d tau/d delta_end = integral of (g + f D dg/d delta) d f,   d tau/d p_end = integral of f D dg/dp d f,
   !! D being the change of delta.
   pure subroutine follow_piece(piece, way, state, by_delta, by_p, work)
      type(piece_type), intent(in)     :: piece
      real(wp), intent(in)             :: way(2, 2)
      type(shear_state), intent(inout) :: state
      real(wp), intent(inout)          :: by_delta, by_p
      real(wp), intent(inout), optional :: work
      real(wp) :: f, place(2), step, slope, slope_by_d, slope_by_p
      integer  :: i

      step = piece%to - piece%from
      if (step <= 0.0_wp) return
      do i = 1, merge(3, 0, present(work))
         work = work + weight_3(i)*step*way(1, 2)*(state%tau + stress_gain(piece%from + step*gauss_3(i)))
      end do
      do i = 1, 2
         f = piece%from + step*gauss_2(i)
         place = way(:, 1) + f*way(:, 2)
         slope = slope_at(piece, place)
         call cubic_slope_derivatives(piece%on%curve, piece%on%sense*(place(1) - piece%on%origin), place(2), slope_by_d, slope_by_p)
         by_delta = by_delta + 0.5_wp*step*(slope + f*way(1, 2)*piece%on%sense*slope_by_d)
         by_p = by_p + 0.5_wp*step*f*way(1, 2)*slope_by_p
      end do
      state%tau = state%tau + stress_gain(piece%to)

   contains

      !> Integral of the slope over the deflection from the beginning of the piece to the fraction TO; two Gauss points are exact.
      pure real(wp) function stress_gain(to) result(gain)
         real(wp), intent(in) :: to
         real(wp) :: place(2)
         integer  :: i

         gain = 0.0_wp
         do i = 1, 2
            place = way(:, 1) + (piece%from + (to - piece%from)*gauss_2(i))*way(:, 2)
            gain = gain + 0.5_wp*(to - piece%from)*way(1, 2)*slope_at(piece, place)
         end do
      end function stress_gain

   end subroutine follow_piece

   !> d tau/d delta of PIECE at the PLACE (delta - delta_0, p) [pressure/length].
   pure real(wp) function slope_at(piece, place) result(slope)
      type(piece_type), intent(in) :: piece
      real(wp), intent(in)         :: place(2)

      slope = cubic_slope(piece%on%curve, piece%on%sense*(place(1) - piece%on%origin), place(2))
   end function slope_at

end module shear_path
