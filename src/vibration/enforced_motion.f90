!> Supports that oscillate: the quasi-static motion of the structure with its supports, and the inertia forces that this motion calls up.
!!
!! The displacement u = u_s + w has a part u_s = U a, the static displacements under the unit movements of the supports, a their
!! amplitude, and the motion w relative to it, with fixed supports: [m] w'' + [k] w = -[m] U a'', under a e**(i omega t) a load
!! omega**2 [m] U a. Damping is that of w. Source: R. W. Clough and J. Penzien, Dynamics of Structures, section 17-2.
module enforced_motion
   use body_elements, only: internal_forces
   use eigenpairs, only: all_displacements, on_equations
   use equation_solver, only: equation_system, failure_type
   use interface_operator, only: add_force, joint_movement
   use joint_laws, only: force_along
   use kinds, only: wp
   use mass_matrix, only: mass_times
   use model_data, only: model_type
   use oscillating_structure, only: factorise_at, oscillating_type
   use node_coupling, only: displacements
   use stage_plan, only: wave_type
   use structural_elements, only: add_bar_forces
   implicit none
   private

   public :: carry_along, stiffness_times

contains

   !> F = [k] {u}, nodal forces of the bodies, bars and joints of STRUCTURE under the displacements U of all nodes.
   subroutine stiffness_times(model, structure, u, f)
      type(model_type), intent(in)       :: model
      type(oscillating_type), intent(in) :: structure
      real(wp), intent(in)               :: u(:, :) !! (dimension, n_nodes) [length]
      real(wp), intent(out)              :: f(:, :) !! likewise [force]
      integer :: i

      call internal_forces(model, u, f)
      call add_bar_forces(model, structure%is_elastic, u, f)
      f = -f
      do i = 1, size(model%joints%element)
         call add_force(model%joints%element(i), -force_along(structure%k(:, i), joint_movement(model%joints%element(i), u)), f)
      end do
      f = -f
   end subroutine stiffness_times

   !> For each of WAVES that moves supports: MOVED becomes U, the displacements of all nodes, FORCE becomes [m] U.
   subroutine carry_along(model, structure, waves, failure)
      type(model_type), intent(in)       :: model
      type(oscillating_type), intent(in) :: structure
      type(wave_type), intent(inout)     :: waves(:)
      type(failure_type), intent(inout)  :: failure
      class(equation_system), allocatable :: system
      real(wp), allocatable :: f(:, :), held(:, :), x(:)
      integer :: i

      do i = 1, size(waves)
         if (.not. allocated(waves(i)%moved) .or. failure%raised) cycle
         if (.not. allocated(system)) call factorise_at(model, structure, 0.0_wp, system, failure)
         if (failure%raised) return
         held = displacements(model, merge(waves(i)%moved, 0.0_wp, system%number == 0))
         allocate (f, mold=held)
         call stiffness_times(model, structure, held, f)
         x = -on_equations(model, system, f)
         call system%solve_by_factor(x)
         x(system%locked) = 0.0_wp
         waves(i)%moved = held + all_displacements(model, system, x)
         call mass_times(model, structure%mass, waves(i)%moved, f)
         waves(i)%force(:size(f, 1), :) = f
         deallocate (f)
      end do
   end subroutine carry_along

end module enforced_motion
