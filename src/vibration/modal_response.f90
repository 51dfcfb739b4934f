!> The response of a structure to an oscillating load by modal superposition: amplitude and phase of components.
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
module modal_response
   use blas_lapack, only: zgesv
   use eigenpairs, only: all_displacements, residual_displacements
   use equation_solver, only: equation_system, failure_type
   use frequency_loads, only: load_at
   use kinds, only: wp
   use mode_parts, only: main_part, mode_part
   use mode_values, only: modes_type
   use model_data, only: damped_bars, model_type
   use natural_modes, only: factorise_at, oscillating_type, spectrum_type
   use numbers, only: first_largest
   use stage_plan, only: asked_frequencies, between, force_between, loss_at, response_plan, wave_type
   use structural_elements, only: unit_tension
   use text_tools, only: integer_text, one_of, real_text
   use tolerances, only: at_resonance, least_load, no_motion, same_frequency, unexcited
   implicit none
   private

   public :: response_at, static_share, peak_frequency, phase_of, find_response

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

   real(wp), parameter :: missed_share = 0.05_wp  ! excess over the response at the adjacent frequencies of a missed peak
   real(wp), parameter :: small_share = 0.01_wp   ! of the largest amplitude of a component: smaller peaks are not searched

   !> The peak of a mode between the given frequencies.
   type, public :: missed_peak
      integer  :: mode = 0                        !! its place among the modes found
      real(wp) :: frequency = 0.0_wp              !! of the peak [1/time]
      integer  :: node = 0, component = 0         !! place of its maximum: position among the wanted nodes; 1 to 3
      real(wp) :: amplitude = 0.0_wp              !! there, 0: unbounded, the mode has no damping [length]
      real(wp) :: beside = 0.0_wp                 !! the larger one at the adjacent frequencies [length]
   end type missed_peak

   !> The response of one stage.
   type, public :: response_type
      integer, allocatable  :: node(:)            !! (nodes) their numbers
      real(wp), allocatable :: frequency(:)       !! (frequencies) [1/time]
      real(wp), allocatable :: amplitude(:, :, :) !! (2 or 3 components, nodes, frequencies), >= 0 [length]
      real(wp), allocatable :: phase(:, :, :)     !! likewise, of the displacement against the force [degrees]
      complex(wp), allocatable :: between(:, :, :) !! (directions, pairs, frequencies) movement of one node against another [length]
      complex(wp), allocatable :: force(:, :, :)  !! (directions, pairs, frequencies) of the load between them; 0: none [force]
      type(missed_peak), allocatable :: missed(:)
      logical :: is_complete = .false.            !! includes the static contribution of the other modes
      logical :: is_direct = .false.              !! SOL 108
      integer :: n_beyond = 0                     !! requested frequencies above the modes, where peaks are missing
   end type response_type

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

   !> The RESPONSE of PLAN by superposition of MODES, in the numbering of SYSTEM. FAILURE where the response is unbounded: an
   !! undamped mode at its frequency, or a structure without supports at zero frequency.
   subroutine find_response(model, structure, plan, spectrum, modes, system, response, failure)
      type(model_type), intent(in)        :: model
      type(oscillating_type), intent(in)  :: structure
      type(response_plan), intent(in)     :: plan
      type(spectrum_type), intent(in)     :: spectrum
      type(modes_type), intent(in)        :: modes     !! evaluated from SPECTRUM
      class(equation_system), intent(in)  :: system
      type(response_type), intent(out)    :: response
      type(failure_type), intent(inout)   :: failure
      class(equation_system), allocatable :: unshifted
      type(modal_system) :: superposed
      type(failure_type) :: loose
      real(wp), allocatable :: x(:, :), u_rest(:, :)
      complex(wp), allocatable :: u(:) ! of the nodes, then of the pairs, then of the dampers
      real(wp), allocatable :: large(:)
      integer, allocatable  :: dampers(:)
      integer  :: d, f, k, m, n, w
      logical  :: ok

      d = model%mesh%dimension
      n = size(plan%nodes)
      dampers = damped_bars(model%mesh)
      superposed%damper = model%mesh%bars(dampers)%viscous
      m = d*n + 4*size(plan%pairs) + size(dampers)
      allocate (u(m), large(m))
      allocate (superposed%shape(size(u), size(modes%modes)), superposed%viscous(size(modes%modes)), &
                superposed%forces(size(modes%modes), size(plan%waves) + size(dampers)), &
                superposed%rests(size(u), size(plan%waves) + size(dampers)), &
                superposed%carried(size(u), size(plan%waves)), source=0.0_wp)
      superposed%lambda = modes%modes%lambda
      superposed%mass = modes%modes%mass
      superposed%loss = modes%modes%loss
      do m = 1, size(modes%modes)
         associate (mode => modes%modes(m))
            superposed%shape(:, m) = wanted(mode%u)
            if (.not. allocated(plan%damping)) cycle
            superposed%loss(m) = mode%material_loss
            if (plan%is_structural) then
               superposed%loss(m) = superposed%loss(m) + loss_at(plan%damping, mode%frequency)
            else
               superposed%viscous(m) = loss_at(plan%damping, mode%frequency)
            end if
         end associate
      end do

      superposed%forces = reshape([(excited(plan%waves(w)%force(:d, :)), w = 1, size(plan%waves)), &
                                   (excited(unit_tension(model, dampers(w))), w = 1, size(dampers))], shape(superposed%forces))
      superposed%shape(size(u) - size(dampers) + 1:, :) = transpose(superposed%forces(:, size(plan%waves) + 1:))

      ! u_rest: the static response of a supported structure less that of the modes; without supports by inertia relief
      if (allocated(spectrum%at_rest)) then
         x = spectrum%at_rest
      else if (system%shift >= 0.0_wp .or. (spectrum%n_before == 0 .and. spectrum%n_rigid <= size(modes%modes) .and. &
                                            spectrum%n_rigid < size(spectrum%lambda))) then
         call factorise_at(model, structure, min(0.0_wp, system%shift), unshifted, loose)
         if (.not. loose%raised) then
            x = spectrum%load
            do w = 1, size(x, 2)
               if (system%shift >= 0.0_wp) then
                  call unshifted%solve_by_factor(x(:, w))
               else
                  call residual_displacements(model, structure%mass, unshifted, spectrum%x(:, :size(modes%modes)), &
                                              spectrum%load(:, w), x(:, w))
               end if
            end do
            deallocate (unshifted)
         end if
      end if
      response%is_complete = allocated(x)
      if (response%is_complete) then
         x(system%locked, :) = 0.0_wp
         do w = 1, size(x, 2)
            u_rest = all_displacements(model, system, x(:, w))
            superposed%rests(:, w) = wanted(u_rest)
            superposed%force = superposed%forces(:, w)
            if (system%shift >= 0.0_wp) superposed%rests(:, w) = superposed%rests(:, w) - static_share(superposed)
         end do
      end if
      do w = 1, size(plan%waves)
         if (allocated(plan%waves(w)%moved)) superposed%carried(:, w) = wanted(plan%waves(w)%moved)
      end do
      response%node = model%mesh%node_id(plan%nodes)
      response%is_direct = plan%is_direct
      response%frequency = asked_frequencies(plan, modes%modes%frequency)
      response%n_beyond = count(plan%frequencies > (1.0_wp + same_frequency)*modes%reach)
      allocate (response%amplitude(d, n, size(response%frequency)), response%phase(d, n, size(response%frequency)), &
                response%between(4, size(plan%pairs), size(response%frequency)))
      allocate (response%force(4, size(plan%pairs), size(response%frequency)), source=(0.0_wp, 0.0_wp))
      do f = 1, size(response%frequency)
         do w = 1, size(plan%waves)
            if (allocated(plan%waves(w)%moved)) cycle
            do k = 1, size(plan%pairs)
               response%force(:, k, f) = response%force(:, k, f) + load_at(plan%waves(w)%law, response%frequency(f))* &
                  force_between(plan%pairs(k), plan%waves(w)%force(:d, :), least_load*norm2(plan%waves(w)%force))
            end do
         end do
         call excite(plan%waves, response%frequency(f), superposed, ok)
         if (ok) call response_at(superposed, response%frequency(f), u, ok)
         if (.not. ok .and. .not. any(abs(superposed%force) > 0.0_wp)) then
            call failure%raise('FREQUENCY: at '//real_text(response%frequency(f))//' a support that has a velocity or an '// &
                               'acceleration moves without bound; expected frequencies above 0')
            return
         else if (.not. ok) then
            m = minloc(abs(superposed%lambda - (2.0_wp*pi*response%frequency(f))**2), dim=1, mask=abs(superposed%force) > 0.0_wp)
            call failure%raise('FREQUENCY: at '//real_text(response%frequency(f))//' the response is unbounded: '// &
                               why_unbounded(model, modes, m))
            return
         end if
         large(:) = abs(u)
         where (large <= no_motion*maxval(large)) u = 0.0_wp
         response%amplitude(:, :, f) = reshape(abs(u(:d*n)), [d, n])
         response%phase(:, :, f) = reshape(phase_of(u(:d*n)), [d, n])
         response%between(:, :, f) = reshape(u(d*n + 1:d*n + 4*size(plan%pairs)), [4, size(plan%pairs)])
      end do
      call find_missed_peaks(plan, modes, superposed, response)

   contains

      !> The movements of the wanted nodes, then of the pairs and dampers, from those of all nodes.
      pure function wanted(u)
         real(wp), intent(in) :: u(:, :)
         real(wp) :: wanted(d*n + 4*size(plan%pairs) + size(dampers))
         integer  :: k

         wanted = [pack(u(:, plan%nodes), .true.), (between(plan%pairs(k), u), k = 1, size(plan%pairs)), &
                   (sum(unit_tension(model, dampers(k))*u), k = 1, size(dampers))]
      end function wanted

      !> The modal forces of FORCE; zero where they are rounding, beside the size of FORCE and, since a large mass moves little in the
      !! modes that its acceleration excites, beside all modal forces on modes of mass 1.
      pure function excited(force) result(q)
         real(wp), intent(in) :: force(:, :)
         real(wp) :: q(size(modes%modes))
         logical  :: is_small(size(q))
         integer  :: r

         q = [(sum(modes%modes(r)%u*force), r = 1, size(q))]
         is_small = abs(q) <= unexcited*norm2(force)*[(maxval(abs(modes%modes(r)%u)), r = 1, size(q))]
         associate (of_unit => q/sqrt(superposed%mass))
            where (is_small .and. (all(is_small) .or. abs(of_unit) <= unexcited*norm2(of_unit))) q = 0.0_wp
         end associate
      end function excited

   end subroutine find_response

   !> Why the response at the frequency of mode M of MODES has no bound, and what gives it one.
   pure function why_unbounded(model, modes, m) result(words)
      type(model_type), intent(in) :: model
      type(modes_type), intent(in) :: modes
      integer, intent(in)          :: m
      character(:), allocatable :: words
      type(mode_part) :: part

      words = 'mode '//integer_text(modes%n_before + m)
      if (modes%modes(m)%is_rigid) then
         words = words//' is a motion without strain: the structure, or a part of it, is not supported'
      else
         part = main_part(model, modes%modes(m)%energy)
         words = words//' has no damping; '//integer_text(nint(100.0_wp*part%share))//' % of its strain energy is in '// &
                 trim(part%kind)//' '//integer_text(part%id)//': expected '// &
                 one_of(part%kind == 'JOINT', 'AMPLITUDE or SDAMPING', 'GE on its MAT1')//', or PARAM,G'
      end if
   end function why_unbounded

   !> The modes whose peak lies between two frequencies of RESPONSE and is missed: at the peak some component exceeds its
   !! amplitudes at both frequencies. For each mode the component of the largest amplitude.
   subroutine find_missed_peaks(plan, modes, superposed, response)
      type(response_plan), intent(in)    :: plan
      type(modes_type), intent(in)       :: modes
      type(modal_system), intent(inout)  :: superposed
      type(response_type), intent(inout) :: response
      type(missed_peak) :: peak
      complex(wp) :: u(size(superposed%shape, 1))
      real(wp)    :: at_peak(size(response%amplitude(:, :, 1))), beside(size(at_peak)), most(size(at_peak))
      integer     :: at, d, k, m, n
      logical     :: is_damped, ok

      allocate (response%missed(0))
      if (size(response%frequency) < 2) return
      d = size(response%amplitude, 1)
      n = size(at_peak)
      most = reshape(maxval(response%amplitude, dim=3), [n])
      do m = 1, size(modes%modes)
         peak = missed_peak(mode=modes%n_before + m, frequency=peak_frequency(superposed, m))
         k = count(response%frequency <= peak%frequency) ! the one below
         if (k == 0 .or. k == size(response%frequency) .or. peak%frequency <= 0.0_wp) cycle
         associate (largest => maxval(abs(modes%modes(m)%u)))
            call excite(plan%waves, peak%frequency, superposed, ok)
            if (abs(superposed%force(m)) <= 0.0_wp) cycle
            is_damped = superposed%loss(m) + viscous_of(superposed, m) > unexcited
            beside = reshape(maxval(response%amplitude(:, :, k:k + 1), dim=3), [n])
            if (is_damped) then
               call response_at(superposed, peak%frequency, u, ok)
               at_peak = abs(u(:n))
               where (at_peak <= max(no_motion*maxval(at_peak), small_share*most, (1.0_wp + missed_share)*beside)) at_peak = 0.0_wp
            else
               at_peak = abs(superposed%shape(:n, m))
               where (at_peak <= unexcited*largest) at_peak = 0.0_wp
            end if
         end associate
         at = first_largest(at_peak)
         if (at_peak(at) <= 0.0_wp) cycle
         if (is_damped) peak%amplitude = at_peak(at)
         peak%beside = beside(at)
         peak%node = (at - 1)/d + 1
         peak%component = at - d*(peak%node - 1)
         response%missed = [response%missed, peak]
      end do
   end subroutine find_missed_peaks

end module modal_response
