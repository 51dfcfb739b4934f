!> The response of a structure to an oscillating load by modal superposition: amplitude and phase of components, and the peaks
!! that the requested frequencies miss.
module modal_response
   use eigenpairs, only: all_displacements, residual_displacements
   use equation_solver, only: equation_system, failure_type
   use frequency_loads, only: load_at
   use kinds, only: wp
   use modal_superposition, only: excite, modal_system, peak_frequency, phase_of, response_at, static_share, viscous_of
   use mode_parts, only: main_part, mode_part
   use mode_values, only: modes_type
   use model_data, only: damped_bars, model_type
   use natural_modes, only: spectrum_type
   use oscillating_structure, only: factorise_at, oscillating_type
   use numbers, only: first_largest
   use stage_plan, only: asked_frequencies, between, force_between, loss_at, response_plan
   use structural_elements, only: unit_tension
   use text_tools, only: integer_text, one_of, real_text
   use tolerances, only: least_load, no_motion, same_frequency, unexcited
   implicit none
   private

   public :: find_response

   real(wp), parameter :: pi = acos(-1.0_wp)

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
