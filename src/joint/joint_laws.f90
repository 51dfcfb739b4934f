!> The laws of a joint together: the state of an interface element, its stiffness, and the Coulomb limit. The methods ask for
!! these element by element: STEP for stiffnesses, NEWTON for the exact law, BACK for secants.
module joint_laws
   use branch_cubic, only: cubic_secant
   use kinds, only: wp
   use normal_curve, only: loading_pressure, normal_law, normal_secant
   use normal_stiffness, only: branch_open, closed_share, follow_normal, is_virgin, norm, normal_state
   use shear_path, only: follow_shear
   use slip_path, only: turn_slip
   use shear_stiffness, only: shear, shear_law, shear_state, slid_from, stand_at_limit
   use tolerances, only: pressure_floor, settled_secant, slip_margin
   implicit none
   private

   public :: norm_and_shear, stiffness_at_rest, stiffness_matrices, follow_element, force_of
   public :: rest_when_open, is_apart
   public :: friction_limit, friction_excess, exceeds_limit, limit_cuts
   public :: back_stiffness

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
      logical  :: turns = .false.            !! slip turns the stress within an increment: paths of loops
      real(wp) :: origin(2) = 0.0_wp         !! tangential movement at which delta = 0: that of the last closing
   end type element_state

contains

   !> NORM, and SHEAR for x and y: the branches of an element after the last increment, and its stiffness for the next one.
   pure subroutine norm_and_shear(law, area, eq10, movement, state, k)
      type(joint_law), intent(in)        :: law
      real(wp), intent(in)               :: area        !! a_i [length^2]
      logical, intent(in)                :: eq10        !! as in NORM
      real(wp), intent(in)               :: movement(3) !! total movement of end 1 relative to end 2 [length]
      type(element_state), intent(inout) :: state
      real(wp), intent(out)              :: k(3)        !! k_sx, k_sy, k_n [force/length]
      logical  :: was_open
      real(wp) :: p

      was_open = state%normal%branch == branch_open
      k(:2) = 0.0_wp
      call norm(law%normal, area, eq10, state%normal, k(3))
      call start_shear(law, area, was_open, movement, state, p)
      if (state%normal%branch /= branch_open) call shear(law%shear, area, p, state%shear, k(:2))
   end subroutine norm_and_shear

   !> Prepare SHEAR after NORM: where the element has opened or closed, its shear law begins anew; a slipping element stands at the
   !! limits. P is the pressure for SHEAR [pressure].
   pure subroutine start_shear(law, area, was_open, movement, state, p)
      type(joint_law), intent(in)        :: law
      real(wp), intent(in)               :: area        !! a_i [length^2]
      logical, intent(in)                :: was_open    !! before NORM
      real(wp), intent(in)               :: movement(3) !! as in norm_and_shear
      type(element_state), intent(inout) :: state
      real(wp), intent(out)              :: p

      p = max(0.0_wp, state%normal%pressure)
      call rest_when_open(state, movement)
      if (state%normal%branch == branch_open) return
      if (was_open) then
         state%origin = movement(:2) - closed_share(state%normal)*(movement(:2) - state%origin)
         state%shear%delta = movement(:2) - state%origin
      end if
      if (state%slips) call stand_at_limit(law%shear, p, state%shear)
      if (is_virgin(area, state%normal)) p = state%normal%p_av
   end subroutine start_shear

   !> The matrices (3, 3, n) of elements with the stiffnesses K(3, n) in their axes.
   pure function stiffness_matrices(k) result(matrices)
      real(wp), intent(in)  :: k(:, :)
      real(wp), allocatable :: matrices(:, :, :)
      integer :: d

      allocate (matrices(3, 3, size(k, 2)), source=0.0_wp)
      do d = 1, 3
         matrices(d, d, :) = k(d, :)
      end do
   end function stiffness_matrices

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

   !> The force of an element in this STATE, in its axes [force].
   pure function force_of(area, state) result(force)
      real(wp), intent(in)            :: area
      type(element_state), intent(in) :: state
      real(wp) :: force(3)

      force = [state%shear%tau*area, state%normal%sumf]
   end function force_of

   !> An open element transmits no shear. When it closes, its shear law begins anew at the present movement.
   pure subroutine rest_when_open(state, movement)
      type(element_state), intent(inout) :: state
      real(wp), intent(in)               :: movement(3)

      if (state%normal%branch /= branch_open) return
      state%shear = shear_state()
      state%origin = movement(:2)
   end subroutine rest_when_open

   !> Whether an element is open and has a gap.
   elemental logical function is_apart(state)
      type(element_state), intent(in) :: state

      is_apart = state%normal%branch == branch_open .and. state%normal%gap > 0.0_wp
   end function is_apart

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
   !! friction as a return to the limit, or along the way where the element TURNS. With SEEN the shear laws and friction see that
   !! normal state and not AFTER's: then the forces are monotone functions of the movement, and the tangent is symmetric.
   pure subroutine follow_element(law, area, before, movement, after, tangent, seen)
      type(joint_law), intent(in)      :: law
      real(wp), intent(in)             :: area
      type(element_state), intent(in)  :: before
      real(wp), intent(in)             :: movement(3)   !! total movement of end 1 relative to end 2 [length]
      type(element_state), intent(out) :: after
      real(wp), intent(out)            :: tangent(3, 3) !! d (forces x, y, z)/d movement [force/length], not symmetric
      type(normal_state), intent(in), optional :: seen  !! with the lambda_before of BEFORE
      type(normal_state) :: normal ! for the laws along x and y
      real(wp) :: by_delta(2), by_p(2), slope, work, limit, size_of_tau, along(2), share, share_by_lambda
      real(wp) :: slipped(2), by_limit(2), by_trial(2, 2)
      integer  :: i

      after = before
      tangent = 0.0_wp
      call follow_normal(law%normal, area, before%normal, movement(3) - before%normal%gap, after%normal, slope, work)
      after%slips = .false.
      tangent(3, 3) = slope*area
      normal = after%normal
      if (present(seen)) then
         normal = seen
         slope = 0.0_wp
      end if
      if (normal%branch == branch_open) then
         after%shear%tau = 0.0_wp
         return
      end if
      share = 1.0_wp
      share_by_lambda = 0.0_wp
      if (before%normal%branch == branch_open) then
         share = closed_share(normal)
         after%origin = movement(:2) - share*(movement(:2) - before%origin)
         if (.not. present(seen)) share_by_lambda = (1.0_wp - share)/max(normal%lambda - before%normal%lambda, tiny(1.0_wp))
      end if
      do i = 1, 2
         call follow_shear(law%shear(i), before%shear(i), movement(i) - after%origin(i), &
                           [before%normal%pressure, normal%pressure], after%shear(i), by_delta(i), by_p(i), work)
         tangent(i, i) = area*by_delta(i)*share
         tangent(i, 3) = area*by_p(i)*slope + area*by_delta(i)*(movement(i) - before%origin(i))*share_by_lambda
      end do
      limit = friction_limit(law, normal%pressure)
      after%slips = .false.
      if (law%has_friction) after%slips = norm2(after%shear%tau) > limit*(1.0_wp + slip_margin)
      if (.not. after%slips) return
      if (before%turns) then
         call turn_slip(before%shear%tau, after%shear%tau - before%shear%tau, &
                        [friction_limit(law, before%normal%pressure), limit], slipped, by_trial, by_limit)
         tangent(:2, :) = matmul(by_trial, tangent(:2, :))
         tangent(:2, 3) = tangent(:2, 3) + law%mu*slope*area*by_limit
      else
         size_of_tau = norm2(after%shear%tau)                       ! tau = limit * trial/|trial|
         along = after%shear%tau/size_of_tau
         slipped = limit*along
         tangent(:2, :2) = limit/size_of_tau*(tangent(:2, :2) - matmul(spread(along, 2, 1), &
                                              matmul(spread(along, 1, 1), tangent(:2, :2))))
         tangent(:2, 3) = limit/size_of_tau*(tangent(:2, 3) - along*dot_product(along, tangent(:2, 3))) + law%mu*slope*area*along
      end if
      after%shear%slid = after%shear%slid + slid_from(law%shear, normal%pressure, after%shear, slipped)
      after%shear%tau = slipped
      call stand_at_limit(law%shear, max(0.0_wp, normal%pressure), after%shear)
   end subroutine follow_element

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

   !> Whether the Coulomb limit cuts the secants of BACK at this DEFLECTION and PRESSURE, as in back_stiffness: the element slides.
   pure logical function limit_cuts(law, pressure, deflection) result(cuts)
      type(joint_law), intent(in) :: law
      real(wp), intent(in)        :: pressure, deflection(2) !! [pressure], along x and y [length]

      cuts = .false.
      if (law%has_friction) cuts = any(friction_limit(law, pressure) < &
         (1.0_wp - settled_secant)*norm2(deflection)*cubic_secant(law%shear%load, abs(deflection), pressure))
   end function limit_cuts

end module joint_laws
