!> The elements of the bodies, each by its kind: stiffness, stress. The one place that knows which kinds there are.
module body_elements
   use kinds, only: wp
   use model_data, only: model_type
   use quad4, only: plane_elasticity, quad4_stiffness, quad4_stress
   implicit none
   private

   public :: element_stiffness, element_stress, internal_forces

contains

   !> Stiffness of element E, components of node 1 first [force/length].
   pure subroutine element_stiffness(model, e, k)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e
      real(wp), intent(out)        :: k(:, :) !! (8, 8)

      associate (property => model%properties(model%element_property(e)), nodes => model%element_nodes(:, e))
         call quad4_stiffness(model%x(:2, nodes), plane_elasticity(property%e, property%nu, property%plane_strain), &
                              property%thickness, k)
      end associate
   end subroutine element_stiffness


   !> Stress (sigma_x, sigma_y, tau_xy) at the centre of element E under the displacements U [pressure].
   pure function element_stress(model, e, u) result(stress)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e
      real(wp), intent(in)         :: u(:, :) !! (dimension, n_nodes) [length]
      real(wp) :: stress(3)

      associate (property => model%properties(model%element_property(e)), nodes => model%element_nodes(:, e))
         stress = quad4_stress(model%x(:2, nodes), plane_elasticity(property%e, property%nu, property%plane_strain), &
                               reshape(u(:, nodes), [8]))
      end associate
   end function element_stress


   !> Forces that hold the bodies in their displaced shape: F = sum of [k] {u} of their elements.
   pure subroutine internal_forces(model, u, f)
      type(model_type), intent(in) :: model
      real(wp), intent(in)         :: u(:, :) !! (dimension, n_nodes) [length]
      real(wp), intent(out)        :: f(:, :) !! (dimension, n_nodes) [force]
      real(wp) :: k(8, 8)
      integer  :: e

      f = 0.0_wp
      do e = 1, model%n_elements
         call element_stiffness(model, e, k)
         associate (nodes => model%element_nodes(:, e))
            f(:, nodes) = f(:, nodes) + reshape(matmul(k, reshape(u(:, nodes), [8])), [2, 4])
         end associate
      end do
   end subroutine internal_forces

end module body_elements
