!> The laws of a joint together: the state of an interface element, its stiffness, and the Coulomb limit. The methods ask for
!! these element by element: STEP for stiffnesses, NEWTON for the exact law, BACK for secants.
module joint_laws
   use branch_cubic, only: cubic_secant, cubic_work
   use kinds, only: wp
   use normal_curve, only: loading_pressure, normal_law, normal_secant, pressure_floor
   use normal_stiffness, only: branch_open, closed_share, follow_normal, is_virgin, norm, normal_state, stored_work
   use shear_path, only: follow_shear
   use shear_stiffness, only: curve_deflection, shear, shear_law, shear_state, slid_from, stand_at_limit
   implicit none
   private

   public :: norm_and_shear, stiffness_at_rest, follow_element, work_along, rest_when_open, is_apart
   public :: friction_limit, friction_excess, exceeds_limit
   public :: back_stiffness, loading_work

   real(wp), parameter :: slip_margin = 1.0e-9_wp ! of the limit: rounding does not cause slip
   real(wp), parameter, public :: flag_margin = 1.0e-7_wp  !! of it: the remainder of a relief is no slip in the next increment
   real(wp), parameter, public :: rest_margin = -1.0e-6_wp !! of the limit: settled secants are at the limit to which they are cut

   type, public :: joint_law
      type(normal_law) :: normal
      type(shear_law)  :: shear(2)           !! along x and y of the joint
      logical  :: has_friction = .false.
      real(wp) :: mu = 0.0_wp                !! coefficient of friction
   end type joint_law

   !> State of one interface element. Directions are its axes: x, y, z.
   type, public :: element_state
      type(normal_state) :: normal
      type(shear_state)  :: shear(2)
      logical  :: slips = .false.            !! the limit was exceeded in the last increment
      integer, private :: filler = 0         ! as in normal_state
      real(wp) :: origin(2) = 0.0_wp         !! tangential movement at which delta = 0: that of the last closing
   end type element_state

contains

   !> NORM, and SHEAR for x and y: the branches of an element after the last increment, and its stiffness for the next one. Where
   !! the element has closed, its shear law begins at the point of closing; a slipping element stands at the limits.
   pure subroutine norm_and_shear(law, area, eq10, movement, state, k)
      type(joint_law), intent(in)        :: law
      real(wp), intent(in)               :: area        !! a_i [length^2]
      logical, intent(in)                :: eq10        !! as in NORM
      real(wp), intent(in)               :: movement(3) !! total movement of end 1 relative to end 2 [length]
      type(element_state), intent(inout) :: state
      real(wp), intent(out)              :: k(3)        !! k_sx, k_sy, k_n [force/length]
      logical  :: was_apart
      real(wp) :: p

      was_apart = is_apart(state)
      k(:2) = 0.0_wp
      call norm(law%normal, area, eq10, state%normal, k(3))
      call rest_when_open(state, movement)
      if (state%normal%branch == branch_open) return
      if (was_apart) then
         call begin_at_closing(movement, state)
         state%shear%delta = movement(:2) - state%origin
      end if
      p = max(0.0_wp, state%normal%pressure)
      if (state%slips) call stand_at_limit(law%shear, p, state%shear)
      if (is_virgin(area, state%normal)) p = state%normal%p_av
      call shear(law%shear, area, p, state%shear, k(:2))
   end subroutine norm_and_shear

   !> The stiffness (k_sx, k_sy, k_n) of an element that has never been pressed [force/length].
   pure function stiffness_at_rest(law, area, p_av) result(k)
      type(joint_law), intent(in) :: law
      real(wp), intent(in)        :: area !! a_i [length^2]
      real(wp), intent(in)        :: p_av !! [pressure]
      real(wp) :: k(3)
      type(element_state) :: state

      state%normal%p_av = p_av
      call norm_and_shear(law, area, .false., [0.0_wp, 0.0_wp, 0.0_wp], state, k)
   end function stiffness_at_rest

   !> An open element transmits no shear. When it closes, its shear law begins anew at the present movement.
   pure subroutine rest_when_open(state, movement)
      type(element_state), intent(inout) :: state
      real(wp), intent(in)               :: movement(3)

      if (state%normal%branch /= branch_open) return
      state%shear = shear_state()
      state%origin = movement(:2)
   end subroutine rest_when_open

   !> Whether an element is open and has a gap: its shear deflection counts from the point of closing. (Without a gap it counts
   !! from the beginning of the increment that closes the element; the path up to closing is short.)
   elemental logical function is_apart(state)
      type(element_state), intent(in) :: state

      is_apart = state%normal%branch == branch_open .and. state%normal%gap > 0.0_wp
   end function is_apart

   !> The last movement has closed an element: set its origin to the point of closing on that straight path.
   pure subroutine begin_at_closing(movement, state)
      real(wp), intent(in)               :: movement(3)
      type(element_state), intent(inout) :: state    !! on entry the origin is where the element was last open

      state%origin = movement(:2) - closed_share(state%normal)*(movement(:2) - state%origin)
   end subroutine begin_at_closing

   !> The Coulomb limit tau_f = mu p (section 4.4) of the resultant of tau [pressure].
   pure real(wp) function friction_limit(law, pressure) result(limit)
      type(joint_law), intent(in) :: law
      real(wp), intent(in)        :: pressure

      limit = law%mu*max(0.0_wp, pressure)
   end function friction_limit

   !> Whether the shear stress is above the limit by more than the share MARGIN of it.
   pure logical function exceeds_limit(law, state, margin)
      type(joint_law), intent(in)     :: law
      type(element_state), intent(in) :: state
      real(wp), intent(in)            :: margin

      exceeds_limit = .false.
      if (law%has_friction) exceeds_limit = norm2(state%shear%tau) > friction_limit(law, state%normal%pressure)*(1.0_wp + margin)
   end function exceeds_limit

   !> The shear force above the limit: a vector in the direction of tau, zero within the limit [force].
   pure function friction_excess(law, area, state) result(excess)
      type(joint_law), intent(in)     :: law
      real(wp), intent(in)            :: area
      type(element_state), intent(in) :: state
      real(wp) :: excess(2), tau(2)

      excess = 0.0_wp
      if (.not. exceeds_limit(law, state, slip_margin)) return
      tau = state%shear%tau
      excess = tau*(1.0_wp - friction_limit(law, state%normal%pressure)/norm2(tau))*area
   end function friction_excess

   !> Follow all laws of one element exactly from its state BEFORE, in equilibrium, to MOVEMENT: the branches, and Coulomb
   !! friction as a return to the limit.
   pure subroutine follow_element(law, area, before, movement, after, tangent, work)
      type(joint_law), intent(in)      :: law
      real(wp), intent(in)             :: area
      type(element_state), intent(in)  :: before
      real(wp), intent(in)             :: movement(3)   !! total movement of end 1 relative to end 2 [length]
      type(element_state), intent(out) :: after
      real(wp), intent(out)            :: tangent(3, 3) !! d (forces x, y, z)/d movement [force/length], not symmetric
      real(wp), intent(out)            :: work(3)       !! done by shear, by normal forces, on friction [force x length]
      real(wp) :: by_delta(2), by_p(2), slope, shear_work, limit, size_of_tau, along(2), share, share_by_lambda, slid(2)
      integer  :: i

      after = before
      tangent = 0.0_wp
      work = 0.0_wp
      call follow_normal(law%normal, area, before%normal, movement(3) - before%normal%gap, after%normal, slope, work(2))
      after%slips = .false.
      tangent(3, 3) = slope*area
      if (after%normal%branch == branch_open) then
         after%shear%tau = 0.0_wp
         return
      end if
      share = 1.0_wp
      share_by_lambda = 0.0_wp
      if (is_apart(before)) then
         call begin_at_closing(movement, after)
         share = closed_share(after%normal)
         share_by_lambda = (1.0_wp - share)/max(after%normal%lambda - before%normal%lambda, tiny(1.0_wp))
      end if
      do i = 1, 2
         call follow_shear(law%shear(i), before%shear(i), movement(i) - after%origin(i), &
                           [before%normal%pressure, after%normal%pressure], after%shear(i), by_delta(i), by_p(i), shear_work)
         work(1) = work(1) + area*shear_work
         tangent(i, i) = area*by_delta(i)*share
         tangent(i, 3) = area*by_p(i)*slope + area*by_delta(i)*(movement(i) - before%origin(i))*share_by_lambda
      end do
      after%slips = exceeds_limit(law, after, slip_margin)
      if (.not. after%slips) return
      limit = friction_limit(law, after%normal%pressure)            ! tau = limit * trial/|trial|
      size_of_tau = norm2(after%shear%tau)
      along = after%shear%tau/size_of_tau
      tangent(:2, :2) = limit/size_of_tau*(tangent(:2, :2) - matmul(spread(along, 2, 1), &
                                           matmul(spread(along, 1, 1), tangent(:2, :2))))
      tangent(:2, 3) = limit/size_of_tau*(tangent(:2, 3) - along*dot_product(along, tangent(:2, 3))) + law%mu*slope*area*along
      slid = slid_from(law%shear, after%normal%pressure, after%shear, limit*along)
      after%shear%slid = after%shear%slid + slid
      after%shear%tau = limit*along
      work(3) = area*sum(after%shear%tau*slid)
      work(1) = sum(0.5_wp*area*(before%shear%tau + after%shear%tau)*(after%shear%delta - before%shear%delta)) - work(3)
      call stand_at_limit(law%shear, max(0.0_wp, after%normal%pressure), after%shear)
   end subroutine follow_element

   !> Work of an element (tangential, normal) on the straight path from the movement FROM to TO, from its state BEFORE [force x
   !! length]. Where slip begins on the path follow_element takes the mean of the stresses; here the point of slip is found. Up
   !! to that point the work is that of the laws; beyond it five Gauss points integrate the stress. An element that opens does
   !! no work beyond the point of zero pressure on the line of slope E_u.
   pure function work_along(law, area, before, from, to) result(work)
      type(joint_law), intent(in)     :: law
      real(wp), intent(in)            :: area
      type(element_state), intent(in) :: before
      real(wp), intent(in)            :: from(3), to(3) !! total movement of end 1 relative to end 2 [length]
      real(wp) :: work(2)
      real(wp), parameter :: point(5) = [-0.906179845938664_wp, -0.538469310105683_wp, 0.0_wp, 0.538469310105683_wp, &
                                         0.906179845938664_wp]
      real(wp), parameter :: weight(5) = [0.236926885056189_wp, 0.478628670499366_wp, 0.568888888888889_wp, 0.478628670499366_wp, &
                                          0.236926885056189_wp]
      type(element_state) :: begins, after
      real(wp), parameter :: near = 1.0e-7_wp ! of the path: the error of the work is its square
      real(wp), parameter :: shut = 1.0e-9_wp ! likewise: still pressed
      real(wp) :: tangent(3, 3), part(3), stick, slip, middle, guess, end(3)
      integer  :: i

      end = to
      call follow_element(law, area, before, end, after, tangent, part)
      work = part(:2)
      if (after%normal%branch == branch_open .and. before%normal%pressure > 0.0_wp) then
         end = from + (1.0_wp - shut)*before%normal%pressure/law%normal%e_u/(from(3) - to(3))*(to - from)
         call follow_element(law, area, before, end, after, tangent, part)
         work(1) = part(1)
      end if
      if (.not. after%slips) return
      stick = 0.0_wp ! fraction of the path
      slip = 1.0_wp
      guess = 1.0_wp - norm2(after%shear%slid - before%shear%slid)/norm2(end(:2) - from(:2))
      do i = 1, 26
         if (slip - stick <= 2.0_wp*near) exit
         middle = 0.5_wp*(stick + slip)
         if (i <= 2) middle = min(max(guess + merge(-near, near, i == 1), stick), slip)
         call follow_element(law, area, before, from + middle*(end - from), after, tangent, part)
         if (after%slips) slip = middle
         if (.not. after%slips) stick = middle
      end do
      call follow_element(law, area, before, from + stick*(end - from), begins, tangent, part)
      work(1) = part(1)
      do i = 1, size(point)
         slip = stick + 0.5_wp*(1.0_wp + point(i))*(1.0_wp - stick)
         call follow_element(law, area, begins, from + slip*(end - from), after, tangent, part)
         work(1) = work(1) + 0.5_wp*weight(i)*(1.0_wp - stick)*area*dot_product(after%shear%tau, end(:2) - from(:2))
      end do
   end function work_along

   !> BACK: secants K = (k_sx, k_sy, k_n) of the loading curves at the DEFLECTION: p(lambda)/lambda, P(d)/d under this p and cut to
   !! the Coulomb limit, times the area [force/length]; none where the element is open.
   pure function back_stiffness(law, area, p_av, deflection) result(k)
      type(joint_law), intent(in) :: law
      real(wp), intent(in)        :: area, p_av
      real(wp), intent(in)        :: deflection(3) !! of the joint: along x, along y, lambda [length]
      real(wp) :: k(3), moved, p

      k = 0.0_wp
      if (deflection(3) < 0.0_wp) return
      p = max(loading_pressure(law%normal, deflection(3)), pressure_floor*p_av)
      moved = norm2(deflection(:2))
      k(:2) = area*cubic_secant(law%shear%load, abs(deflection(:2)), p)
      if (law%has_friction .and. moved > 0.0_wp) k(:2) = min(k(:2), friction_limit(law, p)*area/moved)
      k(3) = normal_secant(law%normal, area, p)
   end function back_stiffness

   !> Work by shear, by normal forces and on friction of an element on its path from rest to STATE [force x length]: along the
   !! loading curves, and by sliding along the limit.
   pure function loading_work(law, area, state) result(work)
      type(joint_law), intent(in)     :: law
      real(wp), intent(in)            :: area
      type(element_state), intent(in) :: state
      real(wp) :: work(3)

      associate (lambda => state%normal%lambda, p => state%normal%pressure, loading => law%shear%load)
         work = area*[sum(cubic_work(loading, abs(curve_deflection(state%shear)), p)), stored_work(law%normal, lambda, p, p), &
                      sum(state%shear%tau*state%shear%slid)]
      end associate
   end function loading_work

end module joint_laws
