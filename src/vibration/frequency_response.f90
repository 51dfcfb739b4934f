!> The answer of a structure to a load that oscillates, by superposition of its modes: amplitude and phase of some components.
!!
!! Mode r, its shape phi_r, modal mass m_r, lambda_r = omega_r**2, feels the force q_r = phi_r . F. Under F e**(i omega t) the displacement
!! u e**(i omega t) has
!!
!!    u = sum over r of phi_r q_r / (m_r (lambda_r - omega**2 + i b_r)) + u_rest,   b_r = eta_r lambda_r + omega g_r omega_r
!!
!!    structural damping: eta_r, the loss factor of materials and joints in this mode
!!    viscous damping:    g_r of a TABDMP1, NASTRAN's B = g omega_r m, which is g at omega = omega_r
!!
!! u_rest is what modes that were not asked for give, as they do when nothing oscillates: the static answer less the share of the modes
!! in it, phi_r q_r/(m_r lambda_r).
!! Source: R. W. Clough and J. Penzien, Dynamics of Structures, sections 4-3 and 13-3; MSC Nastran, Dynamic Analysis User's Guide,
!! modal frequency response.
module frequency_response
   use kinds, only: wp
   implicit none
   private

   public :: response_at, static_share, peak_frequency, phase_of

   real(wp), parameter :: pi = acos(-1.0_wp)

   !> The modes, as far as the response asks of them.
   type, public :: modal_system
      real(wp), allocatable :: lambda(:)  !! (modes) omega_r**2, 0 of a rigid mode [1/time^2]
      real(wp), allocatable :: mass(:)    !! (modes) modal mass, > 0 [force x time^2/length, by the scale of the shapes]
      real(wp), allocatable :: shape(:, :) !! (components, modes) of the components asked
      real(wp), allocatable :: force(:)   !! (modes) phi_r . F
      real(wp), allocatable :: loss(:)    !! (modes) eta_r, structural damping [-]
      real(wp), allocatable :: viscous(:) !! (modes) g_r, viscous damping [-]
      real(wp), allocatable :: rest(:)    !! (components) u_rest, zero where there is none [length]
   end type modal_system

contains

   !> The complex displacements of the components when the load oscillates with FREQUENCY [length]. OK is false where the answer is
   !! without bound: the frequency of a mode that has no damping, or of a rigid mode at rest. An undamped mode that the load does not
   !! touch gives nothing.
   pure subroutine response_at(system, frequency, u, ok)
      type(modal_system), intent(in) :: system
      real(wp), intent(in)           :: frequency !! f >= 0 [1/time]
      complex(wp), intent(out)       :: u(:)      !! (components)
      logical, intent(out)           :: ok
      complex(wp) :: resistance ! what the mode sets against its force, by its mass
      real(wp)    :: omega
      integer     :: r

      omega = 2.0_wp*pi*frequency
      u = system%rest
      ok = .true.
      do r = 1, size(system%lambda)
         if (abs(system%force(r)) <= 0.0_wp) cycle
         associate (lambda => system%lambda(r))
            resistance = cmplx(lambda - omega**2, system%loss(r)*lambda + system%viscous(r)*omega*sqrt(max(0.0_wp, lambda)), wp)
         end associate
         if (abs(resistance) <= 0.0_wp) then
            ok = .false.
            return
         end if
         u = u + system%shape(:, r)*system%force(r)/(system%mass(r)*resistance)
      end do
   end subroutine response_at

   !> Where mode R alone has its largest amplitude: with structural damping at its natural frequency, with viscous damping below it.
   !! 0 of a mode that has no peak: a motion without strain, or one damped too much [1/time].
   pure real(wp) function peak_frequency(system, r) result(frequency)
      type(modal_system), intent(in) :: system
      integer, intent(in)            :: r

      frequency = sqrt(max(0.0_wp, system%lambda(r)*(1.0_wp - 0.5_wp*system%viscous(r)**2)))/(2.0_wp*pi)
   end function peak_frequency

   !> What the elastic modes have in the static answer, which less this is u_rest [length].
   pure function static_share(system) result(u)
      type(modal_system), intent(in) :: system
      real(wp) :: u(size(system%shape, 1))
      integer  :: r

      u = 0.0_wp
      do r = 1, size(system%lambda)
         if (system%lambda(r) > 0.0_wp) u = u + system%shape(:, r)*system%force(r)/(system%mass(r)*system%lambda(r))
      end do
   end function static_share

   !> The phase of a displacement against the force, above -180 up to 180 degrees: negative where it lags behind. That of nothing is 0.
   elemental real(wp) function phase_of(u) result(phase)
      complex(wp), intent(in) :: u

      phase = 0.0_wp
      if (abs(u) <= 0.0_wp) return
      phase = atan2(aimag(u), real(u))*180.0_wp/pi
      if (phase <= -180.0_wp) phase = 180.0_wp ! where the imaginary part is -0.0
   end function phase_of

end module frequency_response
