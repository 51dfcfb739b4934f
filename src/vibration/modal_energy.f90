!> Where the strain energy of a mode is: in each body, each bar, each joint, of these in its normal and its shear stiffness apart; and
!! the forces [k] {u}, element by element, which owe nothing to the factor that the mode was found with.
module modal_energy
   use bar_elements, only: add_pull, bar_elongation
   use body_elements, only: felt_stiffness
   use element_kinds, only: max_felt_dofs
   use interface_operator, only: add_force, joint_movement
   use kinds, only: wp
   use model_build, only: find_bodies
   use model_data, only: bar_nodes, model_type, n_bars
   use node_coupling, only: felt_nodes
   use oscillating_structure, only: oscillating_type
   implicit none
   private

   public :: strain_energies

   !> Of one mode [force x length].
   type, public :: energy_type
      real(wp), allocatable :: body(:)             !! (bodies)
      real(wp), allocatable :: bar(:)              !! (bars)
      real(wp), allocatable :: normal(:), shear(:) !! (joints)
      real(wp) :: damped = 0.0_wp                  !! of bodies and bars, each part times its GE; what a cycle loses is 2 pi times this
   contains
      procedure :: total, scale
   end type energy_type

contains

   !> All of it.
   pure real(wp) function total(self)
      class(energy_type), intent(in) :: self

      total = sum(self%body) + sum(self%bar) + sum(self%normal) + sum(self%shear)
   end function total

   !> FACTOR times all of it, part by part.
   pure subroutine scale(self, factor)
      class(energy_type), intent(inout) :: self
      real(wp), intent(in)              :: factor

      self%body = factor*self%body
      self%bar = factor*self%bar
      self%normal = factor*self%normal
      self%shear = factor*self%shear
      self%damped = factor*self%damped
   end subroutine scale

   !> The strain energies of the shapes U, half of u^T [k] u part by part, and the forces F = [k] U that hold them.
   pure subroutine strain_energies(model, structure, u, energies, f)
      type(model_type), intent(in)       :: model
      type(oscillating_type), intent(in) :: structure
      real(wp), intent(in)               :: u(:, :, :)  !! (dimension, n_nodes, modes) [length]
      type(energy_type), intent(out)     :: energies(:) !! (modes)
      real(wp), intent(out)              :: f(:, :, :)  !! as U [force]
      real(wp) :: movement(3), tension
      integer  :: body(model%n_elements), i, j, m, n_bodies

      f = 0.0_wp
      call find_bodies(model, body, n_bodies)
      do m = 1, size(energies)
         allocate (energies(m)%body(n_bodies), energies(m)%bar(n_bars(model)), energies(m)%normal(size(model%joints)), &
                   energies(m)%shear(size(model%joints)), source=0.0_wp)
      end do
      call strain_bodies(model, body, u, energies, f)
      do m = 1, size(energies)
         do i = 1, n_bars(model)
            if (.not. structure%is_elastic(i)) cycle
            associate (bar => model%bars(i))
               tension = bar%stiffness*bar_elongation(bar, u(:, bar_nodes(bar), m))
               energies(m)%bar(i) = 0.5_wp*tension**2/bar%stiffness
               energies(m)%damped = energies(m)%damped + bar%damping*energies(m)%bar(i)
               call add_pull(model, i, -tension, f(:, :, m))
            end associate
         end do
         do i = 1, size(model%interface)
            movement = joint_movement(model%interface(i), u(:, :, m))
            associate (k => structure%k(:, i))
               j = model%interface(i)%joint
               energies(m)%shear(j) = energies(m)%shear(j) + 0.5_wp*sum(k(:2)*movement(:2)**2)
               energies(m)%normal(j) = energies(m)%normal(j) + 0.5_wp*k(3)*movement(3)**2
               call add_force(model%interface(i), k*movement, f(:, :, m))
            end associate
         end do
      end do
   end subroutine strain_energies

   !> Those of the bodies: of every element once, for all shapes.
   pure subroutine strain_bodies(model, body, u, energies, f)
      type(model_type), intent(in)     :: model
      integer, intent(in)              :: body(:) !! (n_elements)
      real(wp), intent(in)             :: u(:, :, :)
      type(energy_type), intent(inout) :: energies(:)
      real(wp), intent(inout)          :: f(:, :, :)
      real(wp) :: k(max_felt_dofs, max_felt_dofs), q(max_felt_dofs, size(energies)), p(max_felt_dofs, size(energies)), own
      integer  :: d, e, i, m, n

      d = model%dimension
      do e = 1, model%n_elements
         call felt_stiffness(model, e, k)
         associate (nodes => felt_nodes(model, e))
            n = d*size(nodes)
            do i = 1, size(nodes)
               q(d*(i - 1) + 1:d*i, :) = u(:, nodes(i), :)
            end do
            p(:n, :) = matmul(k(:n, :n), q(:n, :))
            do i = 1, size(nodes)
               f(:, nodes(i), :) = f(:, nodes(i), :) + p(d*(i - 1) + 1:d*i, :)
            end do
            do m = 1, size(energies)
               own = 0.5_wp*dot_product(q(:n, m), p(:n, m))
               associate (energy => energies(m))
                  energy%body(body(e)) = energy%body(body(e)) + own
                  energy%damped = energy%damped + model%properties(model%element_property(e))%damping*own
               end associate
            end do
         end associate
      end do
   end subroutine strain_bodies

end module modal_energy
