!> The laws of a joint together: the state of an interface element, its stiffness, and the Coulomb limit. The methods ask for
!! these element by element: STEP for stiffnesses, NEWTON for the exact law, BACK for secants.
module joint_laws
   use branch_cubic, only: cubic_secant
   use iwan_law, only: follow_slices, iwan_state, iwan_type, limit_share, monotone_stress, slides_as_whole, stresses
   use kinds, only: wp
   use normal_curve, only: loading_pressure, normal_law, normal_secant
   use normal_stiffness, only: branch_load, branch_open, branch_unload, closed_share, follow_normal, is_virgin, norm, normal_state
   use shear_path, only: follow_shear
   use slip_path, only: return_to_limit, turn_slip
   use shear_stiffness, only: shear, shear_law, shear_state, slid_from, stand_at_limit
   use tolerances, only: pressure_floor, settled_secant, slip_margin
   implicit none
   private

   public :: norm_and_shear, stiffness_at_rest, stiffness_matrices, force_along, follow_element, force_of
   public :: rest_when_open, is_apart
   public :: friction_limit, friction_excess, exceeds_limit, limit_cuts
   public :: back_stiffness
   public :: slices_of, slices_to, limit_scales

   type, public :: joint_law
      type(normal_law) :: normal
      type(shear_law)  :: shear(2)           !! along x and y of the joint
      logical  :: has_friction = .false.
      real(wp) :: mu = 0.0_wp                !! coefficient of friction
      type(iwan_type) :: iwan                !! in place of Coulomb's law; SHEAR is then its K_T, and MU is F_S/P_REF
   end type joint_law

   !> State of one interface element. Directions are its axes: x, y, z.
   type, public :: element_state
      type(normal_state) :: normal
      type(shear_state)  :: shear(2)
      logical  :: slips = .false.            !! the limit was exceeded in the last increment
      logical  :: turns = .false.            !! slip turns the stress along the way of an increment: NEWTON and BACKBONE
      real(wp) :: origin(2) = 0.0_wp         !! tangential movement at which delta = 0: that of the last closing
      type(iwan_state), allocatable :: iwan  !! of Iwan's law; not allocated: at rest
   end type element_state

   real(wp), parameter :: sticks = sqrt(huge(1.0_wp)) ! limit of a slice that does not slide, of its strength

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
      if (state%normal%branch == branch_open) return
      if (law%iwan%given) then
         if (.not. allocated(state%iwan)) allocate (state%iwan)
         call name_branches(state%shear%delta - state%iwan%delta, state%shear)
         state%iwan = slices_to(law, state)
         where (law%shear%given) k(:2) = area*law%iwan%k_t
      else
         call shear(law%shear, area, p, state%shear, k(:2))
      end if
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
      if (state%slips .and. .not. law%iwan%given) call stand_at_limit(law%shear, p, state%shear)
      if (is_virgin(area, state%normal)) p = state%normal%p_av
   end subroutine start_shear

   !> The matrices (3, 3, n) of elements with the stiffnesses K in their axes: (3, n), or (4, n) with k_sxy, which couples the shears.
   pure function stiffness_matrices(k) result(matrices)
      real(wp), intent(in)  :: k(:, :)
      real(wp), allocatable :: matrices(:, :, :)
      integer :: d

      allocate (matrices(3, 3, size(k, 2)), source=0.0_wp)
      do d = 1, 3
         matrices(d, d, :) = k(d, :)
      end do
      if (size(k, 1) < 4) return
      matrices(1, 2, :) = k(4, :)
      matrices(2, 1, :) = k(4, :)
   end function stiffness_matrices

   !> The force of an element with the stiffness K, with k_sxy, under MOVEMENT [force].
   pure function force_along(k, movement) result(force)
      real(wp), intent(in) :: k(4)        !! [force/length]
      real(wp), intent(in) :: movement(3) !! [length]
      real(wp) :: force(3)

      force = k(:3)*movement + k(4)*[movement(2), movement(1), 0.0_wp]
   end function force_along

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
      if (allocated(state%iwan)) deallocate (state%iwan)
      state%origin = movement(:2)
   end subroutine rest_when_open

   !> Whether an element is open and has a gap.
   elemental logical function is_apart(state)
      type(element_state), intent(in) :: state

      is_apart = state%normal%branch == branch_open .and. state%normal%gap > 0.0_wp
   end function is_apart

   !> The slices of STATE.
   pure type(iwan_state) function slices_of(state) result(slices)
      type(element_state), intent(in) :: state

      if (allocated(state%iwan)) slices = state%iwan
   end function slices_of

   !> The slices of STATE moved to its delta under its pressure.
   pure type(iwan_state) function slices_to(law, state) result(slices)
      type(joint_law), intent(in)     :: law
      type(element_state), intent(in) :: state
      real(wp) :: by_delta(2, 2), by_share(2)

      call follow_slices(law%iwan, slices_of(state), state%shear%delta, &
                         spread(limit_share(law%iwan, state%normal%pressure), 1, 2), slices, by_delta, by_share)
   end function slices_to

   !> LOAD along x or y where the stress of SHEAR has grown by what has MOVED, UNLOAD where it has fallen. Iwan's law asks for no more.
   elemental subroutine name_branches(moved, shear)
      real(wp), intent(in)             :: moved
      type(shear_state), intent(inout) :: shear

      if (abs(moved) > 0.0_wp) shear%branch = merge(branch_load, branch_unload, moved*shear%tau >= 0.0_wp)
   end subroutine name_branches

   !> Whether the limit of friction is in proportion to the pressure.
   elemental logical function limit_scales(law)
      type(joint_law), intent(in) :: law

      limit_scales = law%has_friction .and. .not. (law%iwan%given .and. law%iwan%p_ref <= 0.0_wp)
   end function limit_scales

   !> The Coulomb limit tau_f = mu p (section 4.4) of the resultant of tau [pressure].
   pure real(wp) function friction_limit(law, pressure) result(limit)
      type(joint_law), intent(in) :: law
      real(wp), intent(in)        :: pressure

      limit = law%mu*max(0.0_wp, pressure)
      if (law%iwan%given .and. law%iwan%p_ref <= 0.0_wp) limit = law%iwan%f_s
   end function friction_limit

   !> Whether the shear stress is above the limit by more than the share MARGIN of it; with Iwan's law, whether all slices slide.
   pure logical function exceeds_limit(law, state, margin)
      type(joint_law), intent(in)     :: law
      type(element_state), intent(in) :: state
      real(wp), intent(in)            :: margin
      type(iwan_state) :: slices

      exceeds_limit = .false.
      if (law%iwan%given) then
         if (state%normal%branch /= branch_open) slices = slices_to(law, state)
         exceeds_limit = slices%slides
         return
      end if
      if (law%has_friction) exceeds_limit = norm2(state%shear%tau) > friction_limit(law, state%normal%pressure)*(1.0_wp + margin)
   end function exceeds_limit

   !> The shear force above the limit: a vector in the direction of tau, zero within the limit; with Iwan's law, above what its
   !! slices bear after the movement [force].
   pure function friction_excess(law, area, state) result(excess)
      type(joint_law), intent(in)     :: law
      real(wp), intent(in)            :: area
      type(element_state), intent(in) :: state
      real(wp) :: excess(2), tau(2)

      excess = 0.0_wp
      if (law%iwan%given) then
         if (state%normal%branch == branch_open) return
         excess = state%shear%tau - sum(stresses(law%iwan, slices_to(law, state)), dim=2)
         if (norm2(excess) <= slip_margin*friction_limit(law, state%normal%pressure)) excess = 0.0_wp
         excess = excess*area
         return
      end if
      if (.not. exceeds_limit(law, state, slip_margin)) return
      tau = state%shear%tau
      excess = tau*(1.0_wp - friction_limit(law, state%normal%pressure)/norm2(tau))*area
   end function friction_excess

   !> Follow all laws of one element exactly from its state BEFORE, in equilibrium, to MOVEMENT: the branches, and Coulomb
   !! friction along the way where the element TURNS, otherwise as a return to the limit. With SEEN the shear laws and friction see
   !! that normal state and not AFTER's: then the forces are monotone functions of the movement, and the tangent is symmetric but
   !! for the turn.
   pure subroutine follow_element(law, area, before, movement, after, tangent, seen)
      type(joint_law), intent(in)      :: law
      real(wp), intent(in)             :: area
      type(element_state), intent(in)  :: before
      real(wp), intent(in)             :: movement(3)   !! total movement of end 1 relative to end 2 [length]
      type(element_state), intent(out) :: after
      real(wp), intent(out)            :: tangent(3, 3) !! d (forces x, y, z)/d movement [force/length], not symmetric
      type(normal_state), intent(in), optional :: seen  !! with the lambda_before of BEFORE
      type(normal_state) :: normal ! for the laws along x and y
      real(wp) :: by_delta(2), by_p(2), slope, work, limit, share, share_by_lambda
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
         if (allocated(after%iwan)) deallocate (after%iwan)
         return
      end if
      share = 1.0_wp
      share_by_lambda = 0.0_wp
      if (before%normal%branch == branch_open) then
         share = closed_share(normal)
         after%origin = movement(:2) - share*(movement(:2) - before%origin)
         if (.not. present(seen)) share_by_lambda = (1.0_wp - share)/max(normal%lambda - before%normal%lambda, tiny(1.0_wp))
      end if
      if (law%iwan%given) then
         call follow_iwan(law, area, before, movement, [normal%pressure, slope], [share, share_by_lambda], after, tangent)
         return
      end if
      do i = 1, 2
         call follow_shear(law%shear(i), before%shear(i), movement(i) - after%origin(i), &
                           [before%normal%pressure, normal%pressure], after%shear(i), by_delta(i), by_p(i))
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
      else
         call return_to_limit(after%shear%tau, limit, slipped, by_trial, by_limit)
      end if
      tangent(:2, :) = matmul(by_trial, tangent(:2, :))
      tangent(:2, 3) = tangent(:2, 3) + law%mu*slope*area*by_limit
      after%shear%slid = after%shear%slid + slid_from(law%shear, normal%pressure, after%shear, slipped)
      after%shear%tau = slipped
      call stand_at_limit(law%shear, max(0.0_wp, normal%pressure), after%shear)
   end subroutine follow_element

   !> The part of follow_element that is Iwan's law.
   pure subroutine follow_iwan(law, area, before, movement, p, closing, after, tangent)
      type(joint_law), intent(in)        :: law
      real(wp), intent(in)               :: area
      type(element_state), intent(in)    :: before
      real(wp), intent(in)               :: movement(3)
      real(wp), intent(in)               :: p(2)       !! that of the limits at MOVEMENT, and its derivative along z
      real(wp), intent(in)               :: closing(2) !! share of the movement since the faces closed, likewise
      type(element_state), intent(inout) :: after
      real(wp), intent(inout)            :: tangent(3, 3)
      real(wp) :: by_delta(2, 2), by_share(2), delta(2), share(2)

      delta = movement(:2) - after%origin
      share = sticks
      if (law%has_friction) share = limit_share(law%iwan, [before%normal%pressure, p(1)])
      if (.not. allocated(after%iwan)) allocate (after%iwan)
      call follow_slices(law%iwan, slices_of(before), delta, share, after%iwan, by_delta, by_share)
      after%slips = after%iwan%slides
      after%shear%delta_before = before%shear%delta
      after%shear%tau_before = before%shear%tau
      call name_branches(delta - before%shear%delta, after%shear)
      after%shear%delta = delta
      after%shear%tau = sum(after%iwan%tau, dim=2)
      after%shear%slid = delta - after%shear%tau/law%iwan%k_t
      tangent(:2, :2) = area*closing(1)*by_delta
      tangent(:2, 3) = area*closing(2)*matmul(by_delta, movement(:2) - before%origin)
      if (law%iwan%p_ref > 0.0_wp .and. p(1) > 0.0_wp) tangent(:2, 3) = tangent(:2, 3) + area*p(2)/law%iwan%p_ref*by_share
   end subroutine follow_iwan

   !> BACK: secants K = (k_sx, k_sy, k_n) of the loading curves at the DEFLECTION: p(lambda)/lambda, P(d)/d under this p, both cut
   !! in proportion where their resultant exceeds the Coulomb limit, times the area [force/length]; none where the element is open.
   pure function back_stiffness(law, area, p_av, deflection) result(k)
      type(joint_law), intent(in) :: law
      real(wp), intent(in)        :: area, p_av
      real(wp), intent(in)        :: deflection(3) !! of the joint: along x, along y, lambda [length]
      real(wp) :: k(3), moved, p, tau

      k = 0.0_wp
      if (deflection(3) < 0.0_wp) return
      p = max(loading_pressure(law%normal, deflection(3)), pressure_floor*p_av)
      moved = norm2(deflection(:2))
      k(3) = normal_secant(law%normal, area, p)
      if (law%iwan%given) then
         k(:2) = area*law%iwan%k_t
         if (moved > 0.0_wp) k(:2) = area*monotone_stress(law%iwan, limit_share(law%iwan, p), moved)/moved
         return
      end if
      k(:2) = area*cubic_secant(law%shear%load, abs(deflection(:2)), p)
      tau = norm2(k(:2)*deflection(:2))/area
      if (law%has_friction .and. tau > friction_limit(law, p)) k(:2) = friction_limit(law, p)/tau*k(:2)
   end function back_stiffness

   !> Whether the Coulomb limit cuts the secants of BACK at this DEFLECTION and PRESSURE, as in back_stiffness: the element slides.
   pure logical function limit_cuts(law, pressure, deflection) result(cuts)
      type(joint_law), intent(in) :: law
      real(wp), intent(in)        :: pressure, deflection(2) !! [pressure], along x and y [length]

      cuts = .false.
      if (law%iwan%given) then
         cuts = slides_as_whole(law%iwan, limit_share(law%iwan, pressure), norm2(deflection))
         return
      end if
      if (law%has_friction) cuts = friction_limit(law, pressure) < &
         (1.0_wp - settled_secant)*norm2(deflection*cubic_secant(law%shear%load, abs(deflection), pressure))
   end function limit_cuts

end module joint_laws
