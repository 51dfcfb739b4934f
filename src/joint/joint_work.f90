!> The work of an interface element in an increment: put in, given back, kept, lost by sliding.
!!
!!    put in - given back = integral of tau d delta + integral of p d lambda = kept + lost
!!
!! LOST is the integral of tau over the sliding part of delta. KEPT is the integral over the other part, which the branches take,
!! and the work of the pressure: energy of the springs that the branches are, and the work of the permanent set and of the loops
!! between the branches. The integrals are exact along the straight way of the increment, on which delta and the pressure of the
!! shear laws change in proportion, as in shear_path:
!!
!!    |tau| |            . o trial     The stress follows the branch until it meets the limit mu p at f_s. From there on it stays at
!!          |        . '               the limit, in the direction of the stress that the branch would have had (trial), and the
!!     mu p |- - - s - - - -*          elements stand at point D of their loading curves: delta takes d D, and slides by the rest.
!!          |    .                     Where the element TURNS, the direction is that of slip_path.
!!        0 *---------------+- f       An element that opens is followed to the point where its pressure is zero.
!!          0     f_s       1
!!
!! NEWTON follows the branches themselves. STEP follows its tangents: a branch is a spring of the stiffness k_s. BACK goes from
!! rest along the loading curves. Iwan's slices are followed by all three. Each gives back what its states say, so that KEPT has no error that grows with the increments.
module joint_work
   use branch_cubic, only: cubic, cubic_slope, cubic_value, cubic_work, deflection_at, value_on_way
   use iwan_law, only: energy_gain, iwan_state, limit_share, point, slices_work, weight
   use joint_laws, only: element_state, follow_element, friction_limit, joint_law, slices_of, slices_to
   use kinds, only: wp
   use normal_curve, only: curve_work
   use normal_stiffness, only: branch_open, follow_normal, normal_state
   use numbers, only: polynomial
   use shear_path, only: follow_shear
   use shear_stiffness, only: shear_state
   use slip_path, only: turn_slip
   use tolerances, only: end_of_way, least_slope, slip_at_once, zero_stress
   implicit none
   private

   public :: work_along, work_of_tangents, work_of_secants

   integer, parameter  :: by_branches = 1, by_tangents = 2, by_curves = 3, by_slices = 4

   !> Work done on an interface element, or on the elements of a joint [force x length].
   type, public :: joint_energy
      real(wp) :: put_in(2)     = 0.0_wp        !! by shear, by normal forces
      real(wp) :: given_back(2) = 0.0_wp        !! likewise, >= 0
      real(wp) :: lost          = 0.0_wp        !! by sliding, >= 0; a part of the work of shear
   contains
      procedure :: net                          !! work of shear and of normal forces: what the laws absorb
      procedure :: kept                         !! of it not lost by sliding
      procedure :: add
   end type joint_energy

   !> The way of the shear of an element through an increment.
   type :: way_type
      integer           :: follows = by_branches
      type(shear_state) :: before(2)
      type(iwan_state)  :: slices               ! by_slices: before
      logical  :: turns    = .false.            ! see element_state; then
      real(wp) :: trial(2) = 0.0_wp             ! stress at the end as if nothing slid [pressure]
      real(wp) :: moved(2) = 0.0_wp             ! change of delta [length]
      real(wp) :: p(2)     = 0.0_wp             ! at both ends [pressure]
      real(wp) :: slope(2) = 0.0_wp             ! of the tangents, by_tangents [pressure/length]
   end type way_type

contains

   !> Work of shear and of normal forces.
   pure function net(self) result(work)
      class(joint_energy), intent(in) :: self
      real(wp) :: work(2)

      work = self%put_in - self%given_back
   end function net

   !> What shear and the normal direction have kept; negative where energy of earlier increments is given back or lost.
   pure function kept(self) result(work)
      class(joint_energy), intent(in) :: self
      real(wp) :: work(2)

      work = self%net() - [self%lost, 0.0_wp]
   end function kept

   !> Add the work of ANOTHER element or increment.
   pure subroutine add(self, another)
      class(joint_energy), intent(inout) :: self
      class(joint_energy), intent(in)    :: another

      self%put_in = self%put_in + another%put_in
      self%given_back = self%given_back + another%given_back
      self%lost = self%lost + another%lost
   end subroutine add

   !> Work on the straight way from the state BEFORE, in equilibrium, to MOVEMENT, by the exact laws of follow_element.
   pure type(joint_energy) function work_along(law, area, before, movement) result(energy)
      type(joint_law), intent(in)     :: law
      real(wp), intent(in)            :: area        !! a_i [length^2]
      type(element_state), intent(in) :: before
      real(wp), intent(in)            :: movement(3) !! total movement of end 1 relative to end 2 [length]
      type(element_state) :: after
      type(normal_state)  :: normal
      type(way_type)      :: way
      real(wp) :: tangent(3, 3), slope, work, fraction

      call follow_element(law, area, before, movement, after, tangent)
      call follow_normal(law%normal, area, before%normal, after%normal%lambda, normal, slope, work)
      call tally(2, work, energy)
      way%before = before%shear
      way%turns = before%turns
      way%moved = movement(:2) - after%origin - before%shear%delta
      way%p = [before%normal%pressure, after%normal%pressure]
      if (after%normal%branch == branch_open) then
         if (.not. before%normal%pressure > 0.0_wp) return
         fraction = before%normal%pressure/max(law%normal%e_u*(before%normal%lambda - after%normal%lambda), tiny(1.0_wp))
         way%moved = min(1.0_wp, fraction)*way%moved
         after%slips = law%has_friction
         after%shear%tau = 0.0_wp
      end if
      if (law%iwan%given) then
         way%slices = slices_of(before)
         call share_by_slices(law, area, slices_of(after), way, energy)
         return
      end if
      if (way%turns .and. after%slips) call go(law, way, 1.0_wp, way%trial, work)
      call share_out(law, area, way, after%slips, after%shear%tau, energy)
   end function work_along

   !> Add the work of shear of Iwan's slices on WAY, which leads them to AFTER, to ENERGY. The springs of the slices keep energy, and
   !! what they do not keep is lost.
   pure subroutine share_by_slices(law, area, after, way, energy)
      type(joint_law), intent(in)       :: law
      real(wp), intent(in)              :: area
      type(iwan_state), intent(in)      :: after
      type(way_type), intent(inout)     :: way
      type(joint_energy), intent(inout) :: energy
      real(wp) :: work(2)

      way%follows = by_slices
      call share_out(law, area, way, .false., [0.0_wp, 0.0_wp], energy)
      work = energy%net()
      energy%lost = max(0.0_wp, work(1) - area*energy_gain(law%iwan, way%slices, after))
   end subroutine share_by_slices

   !> Work in the increment of STEP that has led to STATE, before NORM and SHEAR have seen it: forces along the tangents of the
   !! increment, and what the re-analyses have made slide. No force below zero does work.
   pure type(joint_energy) function work_of_tangents(law, area, state) result(energy)
      type(joint_law), intent(in)     :: law
      real(wp), intent(in)            :: area
      type(element_state), intent(in) :: state
      type(way_type) :: way
      real(wp) :: pressed(2), tau(2), work

      associate (normal => state%normal, shear => state%shear)
         pressed = max(0.0_wp, [normal%sigmaf, normal%sumf])
         if (any(pressed > 0.0_wp)) then
            work = 0.5_wp*sum(pressed)*(normal%lambda - normal%lambda_before)
            if (any([normal%sigmaf, normal%sumf] < 0.0_wp)) work = work*sum(pressed)/abs(normal%sumf - normal%sigmaf)
            call tally(2, work, energy)
         end if
         way%before = shear
         way%before%tau = shear%tau_before
         way%p = [normal%sigmaf/area, normal%pressure]
         if (law%iwan%given) then
            way%slices = slices_of(state)
            way%moved = shear%delta - way%slices%delta
            if (normal%branch /= branch_open) call share_by_slices(law, area, slices_to(law, state), way, energy)
            return
         end if
         way%follows = by_tangents
         way%moved = shear%delta - shear%delta_before
         way%slope = shear%k_s/area
         tau = shear%tau_before + way%slope*way%moved
         call share_out(law, area, way, any(abs(tau - shear%tau) > zero_stress*maxval(abs([tau, shear%tau]))), shear%tau, energy)
      end associate
   end function work_of_tangents

   !> Work of BACK on the straight way from rest to STATE, along the loading curves, as long as the limit allows.
   pure type(joint_energy) function work_of_secants(law, area, state) result(energy)
      type(joint_law), intent(in)     :: law
      real(wp), intent(in)            :: area
      type(element_state), intent(in) :: state
      type(way_type) :: way

      if (state%normal%branch == branch_open) return
      call tally(2, area*curve_work(law%normal, state%normal%lambda, state%normal%pressure), energy)
      way%follows = by_curves
      way%moved = state%shear%delta
      way%p = [0.0_wp, state%normal%pressure]
      if (law%iwan%given) then
         call share_by_slices(law, area, slices_of(state), way, energy)
         return
      end if
      call share_out(law, area, way, state%slips, state%shear%tau, energy)
   end function work_of_secants

   !> Add WORK, positive or negative, of DIRECTION: 1 shear, 2 normal.
   pure subroutine tally(direction, work, energy)
      integer, intent(in)               :: direction
      real(wp), intent(in)              :: work
      type(joint_energy), intent(inout) :: energy

      energy%put_in(direction) = energy%put_in(direction) + max(0.0_wp, work)
      energy%given_back(direction) = energy%given_back(direction) + max(0.0_wp, -work)
   end subroutine tally

   !> Add the work of shear on WAY to ENERGY. If the element SLIPS, its stress at the end of the way is TAU_END.
   pure subroutine share_out(law, area, way, slips, tau_end, energy)
      type(joint_law), intent(in)       :: law
      real(wp), intent(in)              :: area
      type(way_type), intent(in)        :: way
      logical, intent(in)               :: slips
      real(wp), intent(in)              :: tau_end(2)
      type(joint_energy), intent(inout) :: energy
      real(wp) :: begins, tau(2), there(2), work, turns, work_there, kept, slip_work, unused
      integer  :: i, k, panels

      begins = 1.0_wp
      if (slips) begins = zero_on(law, way, .false., 1.0_wp)
      call go(law, way, begins, tau, work)
      if (dot_product(way%before%tau, way%moved) < 0.0_wp .and. dot_product(tau, way%moved) > 0.0_wp) then
         turns = zero_on(law, way, .true., begins) ! slopes are positive: the power does not fall, it has one zero
         call go(law, way, turns, tau, work_there)
         call tally(1, area*work_there, energy)
         work = work - work_there
      end if
      call tally(1, area*work, energy)
      if (.not. slips) return

      call go(law, way, begins, tau, work)
      kept = kept_in_slip(law, way, begins, tau, tau_end)
      slip_work = 0.0_wp
      panels = merge(1, 4, any(abs(way%moved) <= 0.0_wp .and. abs(tau) <= 0.0_wp) .or. & ! along one axis the stress does not turn
                           (way%turns .and. norm2(way%trial - tau) <= norm2(tau_end)))
      do k = 1, panels
         do i = 1, 5
            call stress_in_slip(law, way, begins, (k - 1 + point(i))/panels, tau, norm2(tau_end), there)
            work = weight(i)/panels*(1.0_wp - begins)*dot_product(there, way%moved)
            call tally(1, area*work, energy)
            slip_work = slip_work + work
         end do
      end do
      unused = max(0.0_wp, kept - slip_work) ! rounding, or an increment that the branches cannot follow
      energy%put_in(1) = energy%put_in(1) + area*unused
      energy%lost = energy%lost + area*(slip_work + unused - kept)
   end subroutine share_out

   !> The stress TAU at the fraction F of WAY as if nothing slid, and the WORK of shear up to there [pressure x length].
   pure subroutine go(law, way, f, tau, work)
      type(joint_law), intent(in) :: law
      type(way_type), intent(in)  :: way
      real(wp), intent(in)        :: f
      real(wp), intent(out)       :: tau(2), work
      type(shear_state) :: there
      real(wp) :: c(0:4), by_delta, by_p, part
      integer  :: i

      if (way%follows == by_slices) then
         call slices_work(law%iwan, way%slices, way%moved, limit_share(law%iwan, way%p), f, tau, work)
         return
      end if
      work = 0.0_wp
      do i = 1, 2
         associate (before => way%before(i), moved => f*way%moved(i))
            select case (way%follows)
            case (by_tangents)
               tau(i) = before%tau + way%slope(i)*moved
               work = work + 0.5_wp*(before%tau + tau(i))*moved
            case (by_curves)
               c = value_on_way(law%shear(i)%load, [0.0_wp, abs(way%moved(i))], [0.0_wp, way%p(2)])
               tau(i) = sign(polynomial(c, f), way%moved(i))
               work = work + abs(moved)*polynomial(c/[1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp, 5.0_wp], f)
            case default
               call follow_shear(law%shear(i), before, before%delta + moved, [way%p(1), pressure_at(way, f)], there, by_delta, &
                                 by_p, part)
               tau(i) = there%tau
               work = work + part
            end select
         end associate
      end do
   end subroutine go

   !> The pressure at the fraction F of WAY.
   pure real(wp) function pressure_at(way, f) result(p)
      type(way_type), intent(in) :: way
      real(wp), intent(in)       :: f

      p = way%p(1) + f*(way%p(2) - way%p(1))
   end function pressure_at

   !> The fraction up to END at which slip begins, the excess over the limit being positive from there on, or OF_POWER at which the
   !! power of shear changes its sign. Regula falsi with halves: the branches are nearly straight.
   pure real(wp) function zero_on(law, way, of_power, end) result(f)
      type(joint_law), intent(in) :: law
      type(way_type), intent(in)  :: way
      logical, intent(in)         :: of_power
      real(wp), intent(in)        :: end
      real(wp) :: ends(2), values(2), value, scale
      integer  :: i, side

      ends = [0.0_wp, end]
      if (.not. of_power) ends(1) = slip_at_once
      values = [value_at(ends(1)), value_at(ends(2))]
      f = 0.0_wp
      if (values(1) >= 0.0_wp) return
      f = end
      if (values(2) <= 0.0_wp) return
      scale = maxval(abs(values))
      do i = 1, 60
         f = (ends(1)*values(2) - ends(2)*values(1))/(values(2) - values(1))
         if (modulo(i, 3) == 0) f = 0.5_wp*sum(ends)
         value = value_at(f)
         if (abs(value) <= zero_stress*scale) return
         side = merge(2, 1, value > 0.0_wp)
         ends(side) = f
         values(side) = value
         if (ends(2) - ends(1) <= end_of_way) return
      end do

   contains

      pure real(wp) function value_at(f)
         real(wp), intent(in) :: f
         real(wp) :: tau(2), work

         call go(law, way, f, tau, work)
         value_at = dot_product(tau, way%moved)
         if (.not. of_power) value_at = norm2(tau) - friction_limit(law, pressure_at(way, f))
      end function value_at

   end function zero_on

   !> TAU at the fraction X of the slip that BEGINS on WAY, where the stress is FIRST: in the direction of the trial, or turned
   !! along the way, its size between those of FIRST and LAST.
   pure subroutine stress_in_slip(law, way, begins, x, first, last, tau)
      type(joint_law), intent(in) :: law
      type(way_type), intent(in)  :: way
      real(wp), intent(in)        :: begins, x, first(2), last
      real(wp), intent(out)       :: tau(2)
      real(wp) :: by_gain(2, 2), by_limit(2), size, trial(2), work

      size = norm2(first) + x*(last - norm2(first))
      if (way%turns) then
         call turn_slip(first, x*(way%trial - first), [norm2(first), size], tau, by_gain, by_limit)
      else
         call go(law, way, begins + x*(1.0_wp - begins), trial, work)
         tau = trial
         if (norm2(trial) > 0.0_wp) tau = trial/norm2(trial)*size
      end if
   end subroutine stress_in_slip

   !> What the branches keep of the work while the element slips: integral of tau d (delta - slid), the stress going from TAU to
   !! TAU_END [pressure x length]. A tangent is a spring. At point D of the loading curve d takes d tau/A', that is
   !!    integral of A d D = U(D; p) + integral of (A dA/dp / A' - dU/dp) dp,     U the integral of A from 0 to D.
   pure real(wp) function kept_in_slip(law, way, begins, tau, tau_end) result(kept)
      type(joint_law), intent(in) :: law
      type(way_type), intent(in)  :: way
      real(wp), intent(in)        :: begins, tau(2), tau_end(2)
      real(wp) :: at(2), p(2)
      integer  :: i, k

      kept = 0.0_wp
      if (way%follows == by_tangents) then
         do k = 1, 2
            if (way%slope(k) > 0.0_wp) then
               kept = kept + 0.5_wp*(tau_end(k)**2 - tau(k)**2)/way%slope(k)
            else
               kept = kept + 0.5_wp*(tau_end(k) + tau(k))*(1.0_wp - begins)*way%moved(k)
            end if
         end do
         return
      end if
      p = [pressure_at(way, begins), way%p(2)]
      do k = 1, 2
         associate (loading => law%shear(k)%load)
            kept = kept + cubic_work(loading, deflection_at(loading, abs(tau_end(k)), p(2)), p(2)) &
                   - cubic_work(loading, deflection_at(loading, abs(tau(k)), p(1)), p(1))
         end associate
      end do
      if (.not. (abs(p(2) - p(1)) > 0.0_wp .and. any([(abs(law%shear(k)%load%coefficients(2, :)) > 0.0_wp, k = 1, 2)]))) return
      do i = 1, 5
         call stress_in_slip(law, way, begins, point(i), tau, norm2(tau_end), at)
         do k = 1, 2
            kept = kept + weight(i)*(p(2) - p(1))*by_pressure(law%shear(k)%load, abs(at(k)), p(1) + point(i)*(p(2) - p(1)))
         end do
      end do
   end function kept_in_slip

   !> A dA/dp / A' - dU/dp of the curve LOADING where A is the STRESS [length].
   pure real(wp) function by_pressure(loading, stress, p) result(change)
      type(cubic), intent(in) :: loading
      real(wp), intent(in)    :: stress, p
      type(cubic) :: per_pressure ! its A is dA/dp
      real(wp) :: d, slope

      per_pressure%coefficients(1, :) = loading%coefficients(2, :)
      d = deflection_at(loading, stress, p)
      slope = cubic_slope(loading, d, p)
      change = -cubic_work(per_pressure, d, p)
      if (slope > least_slope*cubic_slope(loading, 0.0_wp, p)) &
         change = change + cubic_value(loading, d, p)*cubic_value(per_pressure, d, p)/slope
   end function by_pressure

end module joint_work
