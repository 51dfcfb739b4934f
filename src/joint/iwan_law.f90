!> Segalman's Iwan model of friction on one interface element: Jenkins elements side by side, springs that slide at their limits.
!! The strengths phi k of the springs, phi the movement at which one slides, have a density over phi that is a power law up to
!! phi_max, and a Dirac's share there:
!!
!!    rho(phi) = R phi^chi + S delta(phi - phi_max)      beta = S (chi+1)/(R phi_max^(chi+1))
!!    K_T = integral of rho                              F_S = integral of phi rho
!!    phi_max = F_S (1+beta)/(K_T (beta + (chi+1)/(chi+2)))
!!
!!    tau(d) = K_T d - R d^(chi+2)/((chi+1)(chi+2))      from rest up to phi_max, F_S beyond
!!    loss   = 4 R d^(chi+3)/((chi+2)(chi+3))            of a cycle of amplitude d up to phi_max, per area
!!
!! Slices: phi_n = phi_max exp(-c (N-n)/sqrt(N)), n = 1 to N, and phi_0 = 0. Slice n has the stiffness and the strength of its part
!! of the density, so that K_T and F_S are exact; S is one slice more. The curve of the slices is the polygon of tangents of tau(d)
!! at the phi_n. More slices are finer and reach down to smaller amplitudes.
!! In the plane of a joint each slice has a stress of two components, which turns towards the movement while it slides. F_S and phi_max
!! are in proportion to the pressure, K_T is constant.
!! Source: D. J. Segalman, A four-parameter Iwan model for lap-type joints, J. Appl. Mech. 72 (2005) 752-760.
module iwan_law
   use kinds, only: wp
   use slip_path, only: meet_limit, turn_slip
   use tolerances, only: flag_margin, slip_margin
   implicit none
   private

   public :: make_slices, greatest_phi, limit_share, follow_slices, slices_work, energy_gain, monotone_stress, &
             slices_loss, loading_slopes, slides_as_whole, stresses

   real(wp), parameter :: spacing = 1.6_wp  ! c
   real(wp), parameter, public :: point(5) = 0.5_wp + 0.5_wp*[-0.906179845938664_wp, -0.538469310105683_wp, 0.0_wp, &
                                              0.538469310105683_wp, 0.906179845938664_wp] !! of Gauss, on 0..1
   real(wp), parameter, public :: weight(5) = 0.5_wp*[0.236926885056189_wp, 0.478628670499366_wp, 0.568888888888889_wp, &
                                                      0.478628670499366_wp, 0.236926885056189_wp]

   type, public :: iwan_type
      logical  :: given = .false.
      real(wp) :: f_s   = 0.0_wp              !! F_S per area at the pressure P_REF [pressure]
      real(wp) :: k_t   = 0.0_wp              !! K_T per area [pressure/length]
      real(wp) :: chi   = 0.0_wp, beta = 0.0_wp
      real(wp) :: p_ref = 0.0_wp              !! 0: F_S does not depend on the pressure [pressure]
      real(wp), allocatable :: stiffness(:)   !! of the slices [pressure/length]
      real(wp), allocatable :: strength(:)    !! at P_REF [pressure]
   end type iwan_type

   !> The slices of one interface element.
   type, public :: iwan_state
      real(wp) :: delta(2) = 0.0_wp           !! movement of the faces to which they have come [length]
      real(wp), allocatable :: tau(:, :)      !! (2, slices) stress; not allocated: none [pressure]
      logical  :: slides = .false.            !! all of them slide
   end type iwan_state

contains

   !> Divide the density of LAW into N slices, with one more for S.
   pure subroutine make_slices(n, law)
      integer, intent(in)            :: n
      type(iwan_type), intent(inout) :: law
      real(wp) :: x(0:n) ! phi_n/phi_max
      real(wp) :: power  ! stiffness of the power law, R phi_max^(chi+1)/(chi+1)
      integer  :: i

      x(0) = 0.0_wp
      x(1:) = [(exp(-spacing*(n - i)/sqrt(real(n, wp))), i = 1, n)]
      power = law%k_t/(1.0_wp + law%beta)
      law%stiffness = power*(x(1:)**(law%chi + 1.0_wp) - x(:n - 1)**(law%chi + 1.0_wp))
      law%strength = power*greatest_phi(law)*(law%chi + 1.0_wp)/(law%chi + 2.0_wp)* &
                     (x(1:)**(law%chi + 2.0_wp) - x(:n - 1)**(law%chi + 2.0_wp))
      if (.not. law%beta > 0.0_wp) return
      law%stiffness = [law%stiffness, law%beta*power]
      law%strength = [law%strength, law%beta*power*greatest_phi(law)]
   end subroutine make_slices

   !> phi_max at the pressure P_REF [length].
   pure real(wp) function greatest_phi(law) result(phi)
      type(iwan_type), intent(in) :: law

      phi = law%f_s*(1.0_wp + law%beta)/(law%k_t*(law%beta + (law%chi + 1.0_wp)/(law%chi + 2.0_wp)))
   end function greatest_phi

   !> The limits of the slices at the PRESSURE, relative to their strengths.
   elemental real(wp) function limit_share(law, pressure) result(share)
      type(iwan_type), intent(in) :: law
      real(wp), intent(in)        :: pressure

      share = 1.0_wp
      if (law%p_ref > 0.0_wp) share = max(0.0_wp, pressure)/law%p_ref
   end function limit_share

   !> Follow the slices from BEFORE straight to the movement DELTA. A slice at its limit is turned along the way.
   pure subroutine follow_slices(law, before, delta, share, after, by_delta, by_share)
      type(iwan_type), intent(in)   :: law
      type(iwan_state), intent(in)  :: before
      real(wp), intent(in)          :: delta(2)       !! [length]
      real(wp), intent(in)          :: share(2)       !! limits at both ends, relative to the strengths [-]
      type(iwan_state), intent(out) :: after
      real(wp), intent(out)         :: by_delta(2, 2) !! d (sum of the stresses)/d DELTA [pressure/length]
      real(wp), intent(out)         :: by_share(2)    !! likewise, d/d SHARE(2) [pressure]
      real(wp) :: by_gain(2, 2), by_limit(2), unit(2, 2)
      logical  :: slips
      integer  :: m

      unit = reshape([1.0_wp, 0.0_wp, 0.0_wp, 1.0_wp], [2, 2])
      after%tau = stresses(law, before)
      after%delta = delta
      by_delta = 0.0_wp
      by_share = 0.0_wp
      after%slides = .true.
      do m = 1, size(law%stiffness)
         call move_slice(law%stiffness(m)*(delta - before%delta), share*law%strength(m), after%tau(:, m), slips, by_gain, by_limit)
         by_delta = by_delta + law%stiffness(m)*merge(by_gain, unit, slips)
         if (slips) by_share = by_share + law%strength(m)*by_limit
         after%slides = after%slides .and. slips
      end do
   end subroutine follow_slices

   !> The stresses of the slices of STATE, zero where it has none.
   pure function stresses(law, state) result(tau)
      type(iwan_type), intent(in)  :: law
      type(iwan_state), intent(in) :: state
      real(wp) :: tau(2, size(law%stiffness))

      tau = 0.0_wp
      if (allocated(state%tau)) tau = state%tau
   end function stresses

   !> Move a slice: its stress TAU grows by GAIN where it does not slip. LIMITS are those at both ends of the way.
   pure subroutine move_slice(gain, limits, tau, slips, by_gain, by_limit)
      real(wp), intent(in)    :: gain(2), limits(2) !! [pressure]
      real(wp), intent(inout) :: tau(2)
      logical, intent(out)    :: slips
      real(wp), intent(out)   :: by_gain(2, 2), by_limit(2) !! derivatives of TAU with respect to GAIN and LIMITS(2), if it slips
      real(wp) :: before(2)

      before = tau
      tau = before + gain
      slips = norm2(tau) > limits(2)*(1.0_wp + slip_margin)
      if (.not. slips) return
      call turn_slip(before, gain, limits, tau, by_gain, by_limit)
   end subroutine move_slice

   !> The stress TAU of the slices at the fraction F of a straight way of length MOVED from BEFORE, and their WORK up to there. A
   !! slice sticks up to the fraction at which it meets its limit; its power is linear there, and after it along one axis.
   pure subroutine slices_work(law, before, moved, share, f, tau, work)
      type(iwan_type), intent(in)  :: law
      type(iwan_state), intent(in) :: before
      real(wp), intent(in)         :: moved(2)  !! [length]
      real(wp), intent(in)         :: share(2)  !! at the ends of the way
      real(wp), intent(in)         :: f
      real(wp), intent(out)        :: tau(2), work !! [pressure], [pressure x length]
      real(wp) :: all_tau(2, size(law%stiffness)), begins, c(0:2), width
      integer  :: i, k, m, panels

      tau = 0.0_wp
      work = 0.0_wp
      all_tau = stresses(law, before)
      do m = 1, size(law%stiffness)
         associate (first => all_tau(:, m), gain => law%stiffness(m)*moved, limits => share*law%strength(m))
            begins = 1.0_wp
            if (norm2(first + gain) > limits(2)*(1.0_wp + slip_margin)) call meet_limit(first, gain, limits, begins, c)
            begins = min(f, begins)
            work = work + begins*dot_product(first + 0.5_wp*begins*gain, moved)
            panels = merge(4, 1, abs(first(1)*gain(2) - first(2)*gain(1)) > 0.0_wp)
            width = (f - begins)/panels
            do k = 1, merge(panels, 0, width > 0.0_wp)
               do i = 1, 5
                  work = work + weight(i)*width*dot_product(stress_on_way(first, gain, limits, begins + &
                                                                          (k - 1 + point(i))*width), moved)
               end do
            end do
            tau = tau + stress_on_way(first, gain, limits, f)
         end associate
      end do
   end subroutine slices_work

   !> The stress of a slice at the fraction F of its way.
   pure function stress_on_way(first, gain, limits, f) result(tau)
      real(wp), intent(in) :: first(2), gain(2), limits(2), f
      real(wp) :: tau(2), by_gain(2, 2), by_limit(2)
      logical  :: slips

      tau = first
      call move_slice(f*gain, [max(limits(1), norm2(first)), limits(1) + f*(limits(2) - limits(1))], tau, slips, by_gain, &
                      by_limit)
   end function stress_on_way

   !> What the springs of the slices hold more in the state AFTER than BEFORE [pressure x length].
   pure real(wp) function energy_gain(law, before, after) result(energy)
      type(iwan_type), intent(in)  :: law
      type(iwan_state), intent(in) :: before, after
      real(wp) :: tau(2, size(law%stiffness), 2)

      tau(:, :, 1) = stresses(law, before)
      tau(:, :, 2) = stresses(law, after)
      energy = 0.5_wp*sum(sum((tau(:, :, 2) - tau(:, :, 1))*(tau(:, :, 2) + tau(:, :, 1)), dim=1)/law%stiffness)
   end function energy_gain

   !> The stress after a straight movement D from rest, the limits being SHARE of the strengths [pressure].
   pure real(wp) function monotone_stress(law, share, d) result(tau)
      type(iwan_type), intent(in) :: law
      real(wp), intent(in)        :: share, d !! d >= 0 [length]

      tau = sum(min(law%stiffness*d, share*law%strength))
   end function monotone_stress

   !> Whether all slices slide after a straight movement D from rest.
   pure logical function slides_as_whole(law, share, d) result(slides)
      type(iwan_type), intent(in) :: law
      real(wp), intent(in)        :: share, d

      slides = all(law%stiffness*d > share*law%strength)
   end function slides_as_whole

   !> Loss of a cycle of the amplitude D, per area: a parallelogram of each slice that slides [pressure x length].
   pure real(wp) function slices_loss(law, share, d) result(loss)
      type(iwan_type), intent(in) :: law
      real(wp), intent(in)        :: share, d

      loss = sum(4.0_wp*share*law%strength*max(0.0_wp, d - share*law%strength/law%stiffness))
   end function slices_loss

   !> Slopes of the stress along x and y, xx, yy and xy, where the movement goes on as it was: a slice at its limit has none along its
   !! stress [pressure/length].
   pure function loading_slopes(law, state, share) result(slopes)
      type(iwan_type), intent(in)  :: law
      type(iwan_state), intent(in) :: state
      real(wp), intent(in)         :: share
      real(wp) :: slopes(3), along(2), tau(2, size(law%stiffness))
      integer  :: m

      tau = stresses(law, state)
      slopes = 0.0_wp
      do m = 1, size(law%stiffness)
         slopes(:2) = slopes(:2) + law%stiffness(m)
         if (norm2(tau(:, m)) < (1.0_wp - flag_margin)*share*law%strength(m) .or. .not. norm2(tau(:, m)) > 0.0_wp) cycle
         along = tau(:, m)/norm2(tau(:, m))
         slopes = slopes - law%stiffness(m)*[along**2, product(along)]
      end do
   end function loading_slopes

end module iwan_law
