!> The answer of the structure to a load that oscillates, at the nodes that are asked for: its modes, superposed, and what they leave
!! of the static answer.
module modal_response
   use eigenpairs, only: all_displacements, on_equations
   use equation_solver, only: equation_system
   use failures, only: failure_type
   use frequency_response, only: modal_system, phase_of, response_at, static_share
   use kinds, only: wp
   use mode_values, only: modes_type
   use model_data, only: model_type
   use oscillating_structure, only: factorise_at, oscillating_type
   use text_tools, only: real_text
   use vibration_plan, only: loss_at, response_plan
   implicit none
   private

   public :: find_response

   real(wp), parameter :: nothing = 1.0e-10_wp !! of the largest amplitude at a frequency: rounding, which has no phase

   !> The response of one stage.
   type, public :: response_type
      integer, allocatable  :: node(:)            !! (nodes) their numbers
      real(wp), allocatable :: frequency(:)       !! (frequencies) [1/time]
      real(wp), allocatable :: amplitude(:, :, :) !! (2 or 3 components, nodes, frequencies), >= 0 [length]
      real(wp), allocatable :: phase(:, :, :)     !! likewise, of the displacement against the force [degrees]
      logical :: is_complete = .false.            !! with the static answer of the modes that have not been asked for
   end type response_type

contains

   !> The RESPONSE that is PLANned, by MODES, whose unknowns have the numbers of SYSTEM. FAILURE where it has no bound: an
   !! undamped mode at its frequency, a structure that is not held at rest.
   subroutine find_response(model, structure, plan, modes, system, response, failure)
      type(model_type), intent(in)        :: model
      type(oscillating_type), intent(in)  :: structure
      type(response_plan), intent(in)     :: plan
      type(modes_type), intent(in)        :: modes
      class(equation_system), intent(in)  :: system
      type(response_type), intent(out)    :: response
      type(failure_type), intent(inout)   :: failure
      type(modal_system) :: superposed
      real(wp), allocatable :: at_rest(:)
      complex(wp) :: u(model%dimension*size(plan%nodes))
      real(wp) :: large(size(u))
      integer  :: f
      logical  :: ok

      call put_together(model, plan, modes, superposed)
      call static_answer(model, structure, plan, system, at_rest)
      response%is_complete = allocated(at_rest)
      if (response%is_complete) superposed%rest = at_rest - static_share(superposed)
      response%node = model%node_id(plan%nodes)
      response%frequency = plan%frequencies
      associate (d => model%dimension, n => size(plan%nodes))
         allocate (response%amplitude(d, n, size(plan%frequencies)), response%phase(d, n, size(plan%frequencies)))
         do f = 1, size(plan%frequencies)
            call response_at(superposed, plan%frequencies(f), u, ok)
            if (.not. ok) then
               call failure%raise('FREQUENCY: at '//real_text(plan%frequencies(f))//' the response has no bound: no damping, '// &
                                  'or a structure that nothing holds')
               return
            end if
            large = abs(u)
            where (large <= nothing*maxval(large)) u = 0.0_wp
            response%amplitude(:, :, f) = reshape(abs(u), [d, n])
            response%phase(:, :, f) = reshape(phase_of(u), [d, n])
         end do
      end associate
   end subroutine find_response

   !> MODES as the superposition sees them.
   pure subroutine put_together(model, plan, modes, superposed)
      type(model_type), intent(in)    :: model
      type(response_plan), intent(in) :: plan
      type(modes_type), intent(in)    :: modes
      type(modal_system), intent(out) :: superposed
      integer :: d, m, n

      d = model%dimension
      n = size(modes%modes)
      allocate (superposed%shape(d*size(plan%nodes), n), superposed%force(n), superposed%loss(n))
      superposed%lambda = modes%modes%lambda
      superposed%mass = modes%modes%mass
      superposed%viscous = allocated(plan%damping)
      superposed%rest = [(0.0_wp, m = 1, size(superposed%shape, 1))]
      do m = 1, n
         associate (mode => modes%modes(m))
            superposed%shape(:, m) = pack(mode%u(:, plan%nodes), .true.)
            superposed%force(m) = sum(mode%u*plan%force(:d, :))
            superposed%loss(m) = mode%loss
            if (superposed%viscous) superposed%loss(m) = loss_at(plan%damping, mode%frequency)
         end associate
      end do
   end subroutine put_together

   !> Displacements at the nodes under the load at rest. Not allocated of a structure that is not held.
   subroutine static_answer(model, structure, plan, system, at_rest)
      type(model_type), intent(in)       :: model
      type(oscillating_type), intent(in) :: structure
      type(response_plan), intent(in)    :: plan
      class(equation_system), intent(in) :: system
      real(wp), allocatable, intent(out) :: at_rest(:)
      class(equation_system), allocatable :: unshifted
      type(failure_type) :: loose
      real(wp), allocatable :: u(:, :), x(:)

      if (system%shift < 0.0_wp) return
      call factorise_at(model, structure, 0.0_wp, unshifted, loose)
      if (loose%raised) return
      allocate (x, source=on_equations(model, system, plan%force(:model%dimension, :)))
      call unshifted%solve_by_factor(x)
      x(system%locked) = 0.0_wp
      allocate (u, source=all_displacements(model, system, x))
      at_rest = pack(u(:, plan%nodes), .true.)
   end subroutine static_answer

end module modal_response
