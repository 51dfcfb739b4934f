!> All laws of a joint together, the state of one of its elements, and the Coulomb limit between them.
module joint_laws
   use kinds, only: wp
   use normal_path, only: follow_normal
   use normal_stiffness, only: branch_open, is_virgin, norm, normal_law, normal_state
   use shear_path, only: follow_shear
   use shear_stiffness, only: shear, shear_law, shear_state, start_shear
   implicit none
   private

   public :: element_stiffness_of, friction_excess, exceeds_limit, follow_element, rest_when_open

   real(wp), parameter :: slip_margin = 1.0e-9_wp ! of the limit: rounding does not make a joint slip
   real(wp), parameter :: flag_margin = 1.0e-7_wp ! of the limit: what a relief leaves is no slip in the next increment

   type, public :: joint_law
      type(normal_law) :: normal
      type(shear_law)  :: shear(2)           !! along x and y of the joint
      logical  :: has_friction = .false.
      real(wp) :: mu = 0.0_wp                !! coefficient of friction
      integer  :: n_reanalyses = 1           !! NREAN; -1: until the excess is gone
   end type joint_law

   !> State of one interface element. Directions are its axes: x, y, z.
   type, public :: element_state
      type(normal_state) :: normal
      type(shear_state)  :: shear(2)
      logical  :: slips = .false.            !! the limit was exceeded in the last increment
      real(wp) :: origin(2) = 0.0_wp         !! tangential movement at which delta = 0: where it closed last
   end type element_state

contains

   !> NORM, and SHEAR once a direction: stiffness K = (k_sx, k_sy, k_n) of one element for the next increment.
   pure subroutine element_stiffness_of(law, area, movement, state, k)
      type(joint_law), intent(in)        :: law
      real(wp), intent(in)               :: area        !! a_i [length^2]
      real(wp), intent(in)               :: movement(3) !! of end 1 against end 2, in all [length]
      type(element_state), intent(inout) :: state
      real(wp), intent(out)              :: k(3)        !! [force/length]
      real(wp) :: pressure
      integer  :: i

      call norm(law%normal, area, state%normal, k(3))
      call rest_when_open(state, movement)
      pressure = state%normal%pressure
      if (is_virgin(law%normal, area, state%normal)) pressure = law%normal%p_av
      k(:2) = 0.0_wp
      if (state%normal%branch == branch_open) return
      do i = 1, 2
         call shear(law%shear(i), area, max(0.0_wp, pressure), state%shear(i), k(i))
      end do
   end subroutine element_stiffness_of


   !> An open element transmits no shear, and when it closes it begins anew from where it is.
   pure subroutine rest_when_open(state, movement)
      type(element_state), intent(inout) :: state
      real(wp), intent(in)               :: movement(3)

      if (state%normal%branch /= branch_open) return
      call start_shear(state%shear(1))
      call start_shear(state%shear(2))
      state%origin = movement(:2)
   end subroutine rest_when_open


   !> By how much the shear force exceeds the Coulomb limit mu p a_i (section 4.4): a vector in the direction of tau, zero
   !! within the limit [force].
   pure function friction_excess(law, area, state) result(excess)
      type(joint_law), intent(in)     :: law
      real(wp), intent(in)            :: area
      type(element_state), intent(in) :: state
      real(wp) :: excess(2), tau(2), limit

      excess = 0.0_wp
      if (.not. law%has_friction) return
      tau = state%shear%tau
      limit = law%mu*max(0.0_wp, state%normal%pressure)
      if (norm2(tau) <= limit*(1.0_wp + slip_margin)) return
      excess = tau*(1.0_wp - limit/norm2(tau))*area
   end function friction_excess


   !> Whether the shear stress is so far above the limit that the element is said to slip.
   pure logical function exceeds_limit(law, state)
      type(joint_law), intent(in)     :: law
      type(element_state), intent(in) :: state

      exceeds_limit = .false.
      if (.not. law%has_friction) return
      exceeds_limit = norm2(state%shear%tau) > law%mu*max(0.0_wp, state%normal%pressure)*(1.0_wp + flag_margin)
   end function exceeds_limit


   !> Follow all laws of one element exactly from its state BEFORE, in equilibrium, to MOVEMENT: the branches, and Coulomb as a
   !! return to the limit.
   pure subroutine follow_element(law, area, before, movement, after, tangent, work)
      type(joint_law), intent(in)      :: law
      real(wp), intent(in)             :: area
      type(element_state), intent(in)  :: before
      real(wp), intent(in)             :: movement(3)   !! of end 1 against end 2, in all [length]
      type(element_state), intent(out) :: after
      real(wp), intent(out)            :: tangent(3, 3) !! d (forces x, y, z)/d movement [force/length], not symmetric
      real(wp), intent(out)            :: work(2)       !! done by shear, by normal forces [force x length]
      real(wp) :: by_delta(2), by_p(2), slope, shear_work, limit, size_of_tau, along(2), trial(2)
      integer  :: i

      after = before
      tangent = 0.0_wp
      work = 0.0_wp
      call follow_normal(law%normal, area, before%normal, movement(3), after%normal, slope, work(2))
      after%slips = .false.
      tangent(3, 3) = slope*area
      if (after%normal%branch == branch_open) then
         do i = 1, 2
            after%shear(i)%tau = 0.0_wp
         end do
         return
      end if
      do i = 1, 2
         call follow_shear(law%shear(i), before%shear(i), before%normal%pressure, movement(i) - before%origin(i), &
                           after%normal%pressure, after%shear(i), by_delta(i), by_p(i), shear_work)
         work(1) = work(1) + area*shear_work
         tangent(i, i) = area*by_delta(i)
         tangent(i, 3) = area*by_p(i)*slope
      end do
      if (.not. law%has_friction) return
      trial = after%shear%tau
      limit = law%mu*after%normal%pressure
      size_of_tau = norm2(trial)
      if (size_of_tau <= limit*(1.0_wp + slip_margin)) return
      after%slips = .true.                                         ! tau = limit * trial/|trial|
      along = trial/size_of_tau
      tangent(:2, :2) = limit/size_of_tau*(tangent(:2, :2) - matmul(spread(along, 2, 1), &
                                           matmul(spread(along, 1, 1), tangent(:2, :2))))
      tangent(:2, 3) = limit/size_of_tau*(tangent(:2, 3) - along*dot_product(along, tangent(:2, 3))) &
                       + law%mu*slope*area*along
      work(1) = 0.0_wp
      do i = 1, 2
         after%shear(i)%tau = limit*along(i)
         work(1) = work(1) + 0.5_wp*area*(before%shear(i)%tau + after%shear(i)%tau) &
                   *(after%shear(i)%delta - before%shear(i)%delta)
      end do
   end subroutine follow_element

end module joint_laws
