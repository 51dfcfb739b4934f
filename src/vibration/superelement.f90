!> A structure condensed on some components of its nodes: their stiffness and mass by Guyan or by Craig and Bampton.
!!
!!    {u} = [v] {a} + [phi] {q}    [v]: the static displacements under a unit movement of each retained component, the others held
!!                                 [phi]: natural modes with all retained components held, of generalised mass 1
!!    [k]: [v]^T [k] [v], and lambda of each mode; [m]: [v phi]^T [m] [v phi]
!!
!! Source: R. R. Craig, M. C. C. Bampton, AIAA Journal 6 (1968) 1313-1319; R. J. Guyan, AIAA Journal 3 (1965) 380.
module superelement
   use eigenpairs, only: all_displacements, on_equations
   use element_mapping, only: two_pi
   use enforced_motion, only: stiffness_times
   use equation_solver, only: equation_system, failure_type
   use kinds, only: wp
   use mass_matrix, only: mass_times
   use model_data, only: model_type
   use natural_modes, only: find_natural_modes, spectrum_type
   use oscillating_structure, only: factorise_at, oscillating_type
   use stage_plan, only: vibration_plan_type
   use superelement_build, only: retained_type
   use unknowns, only: unknown_name
   implicit none
   private

   public :: reduce_structure

   type, public :: reduced_type
      type(retained_type)   :: retained
      real(wp), allocatable :: k(:, :), m(:, :) !! components, then modes [force/length], [force x time^2/length] and moments likewise
      integer  :: n_modes = 0
      real(wp) :: highest = 0.0_wp              !! frequency of the last mode [1/time]
   end type reduced_type

contains

   !> Condense STRUCTURE on RETAINED, with the modes that PLAN asks for, if it is there. In STRUCTURE the retained components are held
   !! afterwards.
   subroutine reduce_structure(model, structure, retained, plan, reduced, failure)
      type(model_type), intent(in)          :: model
      type(oscillating_type), intent(inout) :: structure
      type(retained_type), intent(in)       :: retained
      type(vibration_plan_type), allocatable, intent(in) :: plan
      type(reduced_type), intent(out)       :: reduced
      type(failure_type), intent(inout)     :: failure
      class(equation_system), allocatable   :: fixed
      type(vibration_plan_type) :: asked
      type(spectrum_type)   :: spectrum
      real(wp), allocatable :: f(:, :), v(:, :), kv(:, :), mv(:, :), x(:)
      integer :: i, n, n_a

      if (failure%raised) return
      reduced%retained = retained
      n_a = size(retained%place)
      structure%held = reshape([(retained%place(i)%node, retained%place(i)%d, i = 1, n_a)], [2, n_a])
      if (allocated(plan)) then
         asked = plan
         if (allocated(asked%response)) deallocate (asked%response)
         call find_natural_modes(model, structure, asked, spectrum, fixed, failure)
         if (failure%raised) return
         deallocate (fixed)
         reduced%n_modes = spectrum%n_wanted
         if (size(retained%mode_id) > 0) reduced%n_modes = min(reduced%n_modes, size(retained%mode_id))
         if (reduced%n_modes > 0) reduced%highest = sqrt(max(0.0_wp, spectrum%lambda(reduced%n_modes)))/two_pi
      end if
      call factorise_at(model, structure, 0.0_wp, fixed, failure)
      if (failure%raised) failure%message = 'OUTPUT = DMIG, with the components of ASET held: '//failure%message
      if (failure%raised) return
      n = n_a + reduced%n_modes
      associate (started => structure%started)
         allocate (v(started%n, n), kv(started%n, n_a), mv(started%n, n), x(started%n))
         allocate (f(model%mesh%dimension, model%mesh%n_nodes))
         do i = 1, n_a
            v(:, i) = 0.0_wp
            if (started%number(retained%place(i)%d, retained%place(i)%node) == 0) then
               call failure%raise('OUTPUT = DMIG: '//unknown_name(model, retained%place(i)%node, retained%place(i)%d)//' is held')
               return
            end if
            v(started%number(retained%place(i)%d, retained%place(i)%node), i) = retained%place(i)%scale
            call stiffness_times(model, structure, all_displacements(model, started, v(:, i)), f)
            x = -on_equations(model, fixed, f)
            call fixed%solve_by_factor(x)
            x(fixed%locked) = 0.0_wp
            v(:, i) = v(:, i) + x
            call stiffness_times(model, structure, all_displacements(model, started, v(:, i)), f)
            kv(:, i) = on_equations(model, started, f)
         end do
         if (reduced%n_modes > 0) v(:, n_a + 1:) = spectrum%x(:, :reduced%n_modes)
         do i = 1, n
            call mass_times(model, structure%mass, all_displacements(model, started, v(:, i)), f)
            mv(:, i) = on_equations(model, started, f)
         end do
      end associate
      allocate (reduced%k(n, n), source=0.0_wp)
      reduced%k(:n_a, :n_a) = matmul(transpose(v(:, :n_a)), kv)
      reduced%m = matmul(transpose(v), mv)
      do i = n_a + 1, n
         reduced%k(i, i) = spectrum%lambda(i - n_a)
         reduced%m(n_a + 1:, i) = 0.0_wp
         reduced%m(i, i) = 1.0_wp
      end do
      reduced%k = 0.5_wp*(reduced%k + transpose(reduced%k))
      reduced%m = 0.5_wp*(reduced%m + transpose(reduced%m))
   end subroutine reduce_structure

end module superelement
