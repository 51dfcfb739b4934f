!> The elements of the bodies, each by its kind: stiffness, stress. The one place that knows which kinds there are.
module body_elements
   use elasticity, only: plane_strain, plane_stress
   use element_kinds, only: kind_quad4
   use element_mapping, only: element_law, make_element_law
   use isoparametric, only: stiffness
   use kinds, only: wp
   use model_data, only: model_type, property_type
   use stress_recovery, only: centre_stress
   implicit none
   private

   public :: element_stiffness, element_stress, internal_forces

contains

   !> Stiffness of element E, components of node 1 first [force/length].
   pure subroutine element_stiffness(model, e, k)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e
      real(wp), intent(inout)      :: k(:, :) !! (8, 8), set here

      associate (nodes => model%element_nodes(:, e))
         call stiffness(law_of(model%properties(model%element_property(e))), model%x(:2, nodes), k)
      end associate
   end subroutine element_stiffness


   !> Stress (sigma_x, sigma_y, tau_xy) at the centre of element E under the displacements U [pressure].
   pure function element_stress(model, e, u) result(stress)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e
      real(wp), intent(in)         :: u(:, :) !! (dimension, n_nodes) [length]
      real(wp) :: stress(3)

      associate (nodes => model%element_nodes(:, e))
         call centre_stress(law_of(model%properties(model%element_property(e))), model%x(:2, nodes), u(:, nodes), stress)
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


   !> The law of plane quadrilaterals with a property.
   pure type(element_law) function law_of(property)
      type(property_type), intent(in) :: property

      law_of = make_element_law(kind_quad4, merge(plane_strain, plane_stress, property%plane_strain), property%e, property%nu, &
                                property%thickness, incompatible=.false.)
   end function law_of

end module body_elements
