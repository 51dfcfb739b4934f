!> Modal superposition: the complex amplitudes of components from the data of modes at a frequency.
!!
!! Mode r has the shape phi_r, the modal mass m_r, lambda_r = omega_r**2, and the modal force q_r = phi_r . F. Under F e**(i
!! omega t) the displacement is u e**(i omega t) with
!!
!!    u = sum over r of phi_r q_r / (m_r (lambda_r - omega**2 + i b_r)) + u_rest,   b_r = eta_r lambda_r + omega g_r omega_r
!!
!!    structural damping: eta_r, the loss factor of materials and joints in this mode
!!    viscous damping:    g_r of a TABDMP1, NASTRAN's B = g omega_r m, which is g at omega = omega_r
!!
!! u_rest is the static contribution of the modes that are not computed: the static response less that of the computed modes,
!! phi_r q_r/(m_r lambda_r).
!!
!! Dampers of CDAMP1 to CDAMP4 and CBUSH (B = c) couple the modes. Damper j gives its nodes the forces d_j g_j, and
!!
!!    g_j = -i omega c_j e_j,   e_j = d_j . u,   q_r = phi_r . F + sum over j of (phi_r . d_j) g_j
!!
!! with its own static contribution in u_rest. These are as many equations for the modal amplitudes and g_j together; without u_rest
!! they are NASTRAN's, phi^T [B] phi, in the modes.
!!
!! An unsupported structure has no static response; its u_rest is that to the part of the load which the
!! inertia forces of the computed modes, rigid-body modes among them, do not balance (inertia relief).
!! Source: R. W. Clough and J. Penzien, Dynamics of Structures, sections 4-3 and 13-3; MSC Nastran, Dynamic Analysis User's Guide,
!! modal frequency response.
module modal_superposition
   use blas_lapack, only: zgesv
   use frequency_loads, only: load_at
   use kinds, only: wp
   use stage_plan, only: wave_type
   use tolerances, only: at_resonance
   implicit none
   private

   public :: response_at, excite, static_share, peak_frequency, viscous_of, phase_of

   real(wp), parameter :: pi = acos(-1.0_wp)

   !> The data of the modes for the response.
   type, public :: modal_system
      real(wp), allocatable :: lambda(:)  !! (modes) omega_r**2, 0 of a rigid mode [1/time^2]
      real(wp), allocatable :: mass(:)    !! (modes) modal mass, > 0 [force x time^2/length, by the scale of the shapes]
      real(wp), allocatable :: shape(:, :) !! (components, modes) of the wanted components
      complex(wp), allocatable :: force(:) !! (modes) phi_r . F
      real(wp), allocatable :: loss(:)    !! (modes) eta_r, structural damping [-]
      real(wp), allocatable :: viscous(:) !! (modes) g_r, viscous damping [-]
      complex(wp), allocatable :: rest(:) !! (components) u_rest, zero where there is none [length]
      ! of each wave by itself, with the factor 1: its FORCE and REST, and u_s where it moves supports
      real(wp), allocatable :: forces(:, :), rests(:, :), carried(:, :)
      ! dampers: c_j [force x time/length]; their movements e_j are the last components, and d_j the last of the waves
      real(wp), allocatable :: damper(:)
   end type modal_system

contains

   !> The complex displacements of the components under a load that oscillates with FREQUENCY [length]. OK is false where the
   !! response is unbounded: at the frequency of an undamped mode, or of a rigid-body mode at zero. An undamped mode that the
   !! load does not excite contributes zero.
   pure subroutine response_at(system, frequency, u, ok)
      type(modal_system), intent(in) :: system
      real(wp), intent(in)           :: frequency !! f >= 0 [1/time]
      complex(wp), intent(out)       :: u(:)      !! (components)
      logical, intent(out)           :: ok
      complex(wp) :: along(size(system%lambda)) ! modal amplitudes
      complex(wp) :: resistance(size(system%lambda)) ! dynamic stiffness of each mode per modal mass
      logical     :: is_coupled(size(system%lambda))
      real(wp)    :: omega
      integer     :: n

      omega = 2.0_wp*pi*frequency
      n = 0
      if (allocated(system%damper) .and. omega > 0.0_wp) n = size(system%damper)
      associate (lambda => system%lambda, last => size(u) - n + 1)
         resistance = cmplx(lambda - omega**2, system%loss*lambda + system%viscous*omega*sqrt(max(0.0_wp, lambda)), wp)
         is_coupled = any(abs(system%shape(last:, :)) > 0.0_wp, dim=1)
         ok = all(is_coupled .or. abs(system%force) <= 0.0_wp .or. abs(resistance) > at_resonance*abs(lambda))
         if (.not. ok) return
         along = 0.0_wp
         where (abs(system%force) > 0.0_wp .and. .not. is_coupled) along = system%force/(system%mass*resistance)
         u = system%rest
         if (n > 0) call couple(system, omega, resistance, is_coupled, along, u, ok)
         u = u + matmul(system%shape, along)
      end associate
   end subroutine response_at

   !> The amplitudes ALONG of the modes that dampers couple, and the static contribution of the dampers in U. Every unknown is scaled
   !! by the square root of its own resistance.
   pure subroutine couple(system, omega, resistance, is_coupled, along, u, ok)
      type(modal_system), intent(in) :: system
      real(wp), intent(in)           :: omega         !! > 0 [1/time]
      complex(wp), intent(in)        :: resistance(:) !! (modes) [1/time^2]
      logical, intent(in)            :: is_coupled(:) !! (modes)
      complex(wp), intent(inout)     :: along(:)      !! (modes)
      complex(wp), intent(inout)     :: u(:)          !! (components)
      logical, intent(out)           :: ok
      complex(wp), allocatable :: a(:, :), b(:, :)
      real(wp), allocatable    :: s(:)
      integer, allocatable     :: modes(:), pivots(:)
      integer :: first, info, k, m, n

      modes = pack([(k, k = 1, size(along))], is_coupled)
      m = size(modes)
      n = size(system%damper)
      first = size(u) - n + 1
      s = [1.0_wp/(sqrt(system%mass(modes)*max(system%lambda(modes), omega**2))), sqrt(omega*system%damper)]
      allocate (a(m + n, m + n), source=(0.0_wp, 0.0_wp))
      a(:m, m + 1:) = -transpose(system%shape(first:, modes))
      a(m + 1:, :m) = -system%shape(first:, modes)
      a(m + 1:, m + 1:) = -system%rests(first:, size(system%rests, 2) - n + 1:)
      do k = 1, m + n
         a(:, k) = a(:, k)*s*s(k)
         if (k <= m) a(k, k) = resistance(modes(k))*system%mass(modes(k))*s(k)**2
         if (k > m) a(k, k) = a(k, k) + cmplx(0.0_wp, 1.0_wp, wp)
      end do
      b = reshape(s*[system%force(modes), u(first:)], [m + n, 1])
      allocate (pivots(m + n))
      call zgesv(m + n, 1, a, m + n, pivots, b, m + n, info)
      ok = info == 0
      if (.not. ok) return
      b(:, 1) = s*b(:, 1)
      along(modes) = b(:m, 1)
      u = u + matmul(system%rests(:, size(system%rests, 2) - n + 1:), b(m + 1:, 1))
   end subroutine couple

   !> Set the FORCE and REST of SYSTEM to those of its WAVES at FREQUENCY; not OK: a support moves without bound.
   pure subroutine excite(waves, frequency, system, ok)
      type(wave_type), intent(in)       :: waves(:)
      real(wp), intent(in)              :: frequency !! [1/time]
      type(modal_system), intent(inout) :: system
      logical, intent(out)              :: ok
      complex(wp) :: factor(size(waves)), moved(size(waves))
      real(wp) :: omega
      integer  :: i

      omega = 2.0_wp*pi*frequency
      moved = 0.0_wp
      ok = .true.
      do i = 1, size(waves)
         factor(i) = load_at(waves(i)%law, frequency)
         if (.not. allocated(waves(i)%moved)) cycle
         associate (order => waves(i)%law%card%motion - 1) ! of the derivative that is given: u = a/(i omega)**order
            ok = ok .and. (order == 0 .or. omega > 0.0_wp .or. abs(factor(i)) <= 0.0_wp)
            if (abs(factor(i)) > 0.0_wp .and. ok) moved(i) = factor(i)/cmplx(0.0_wp, omega, wp)**order
         end associate
         factor(i) = omega**2*moved(i)
      end do
      associate (n => size(waves)) ! the dampers follow
         system%force = [(sum(system%forces(i, :n)*factor), i = 1, size(system%forces, 1))]
         system%rest = [(sum(system%rests(i, :n)*factor) + sum(system%carried(i, :n)*moved), i = 1, size(system%rests, 1))]
      end associate
   end subroutine excite

   !> The frequency at which mode R alone has its largest amplitude: with structural damping its natural frequency, with viscous
   !! damping below it. 0 for a mode without a peak: a rigid-body mode, or one damped too much [1/time].
   pure real(wp) function peak_frequency(system, r) result(frequency)
      type(modal_system), intent(in) :: system
      integer, intent(in)            :: r

      frequency = sqrt(max(0.0_wp, system%lambda(r)*(1.0_wp - 0.5_wp*viscous_of(system, r)**2)))/(2.0_wp*pi)
   end function peak_frequency

   !> The viscous damping g_r of mode R with that of dampers, phi^T [B] phi/(m omega) [-].
   pure real(wp) function viscous_of(system, r) result(viscous)
      type(modal_system), intent(in) :: system
      integer, intent(in)            :: r

      viscous = system%viscous(r)
      if (.not. allocated(system%damper) .or. .not. system%lambda(r) > 0.0_wp) return
      associate (first => size(system%shape, 1) - size(system%damper) + 1)
         viscous = viscous + sum(system%damper*system%shape(first:, r)**2)/(system%mass(r)*sqrt(system%lambda(r)))
      end associate
   end function viscous_of

   !> The static response of the elastic modes, which is subtracted for u_rest [length].
   pure function static_share(system) result(u)
      type(modal_system), intent(in) :: system !! its FORCE is real
      real(wp) :: u(size(system%shape, 1))
      integer  :: r

      u = 0.0_wp
      do r = 1, size(system%lambda)
         if (system%lambda(r) > 0.0_wp) u = u + system%shape(:, r)*real(system%force(r))/(system%mass(r)*system%lambda(r))
      end do
   end function static_share

   !> The phase of a displacement against the force, above -180 up to 180 degrees: negative where it lags behind. For zero
   !! displacement it is 0.
   elemental real(wp) function phase_of(u) result(phase)
      complex(wp), intent(in) :: u

      phase = 0.0_wp
      if (abs(u) > 0.0_wp) phase = atan2(aimag(u), real(u))*180.0_wp/pi
      if (phase <= -180.0_wp) phase = 180.0_wp ! where the imaginary part is -0.0
   end function phase_of

end module modal_superposition
