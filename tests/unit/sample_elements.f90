!> Elements for tests of shapes, stiffnesses and loads.
module sample_elements
   use elasticity, only: axisymmetric
   use element_kinds, only: element_table, max_nodes, node_point
   use element_mapping, only: element_law, element_map, map_element, map_point, max_shapes
   use kinds, only: wp
   use quadrature, only: integration_rule, volume_rule
   implicit none
   private

   public :: distorted, element_volume

contains

   !> A distorted element of a kind, x > 0.
   pure function distorted(kind) result(x)
      integer, intent(in) :: kind
      real(wp) :: x(3, max_nodes)
      integer  :: i, k

      x = 0.0_wp
      do i = 1, max_nodes
         do k = 1, element_table(kind)%dimension
            x(k, i) = node_point(k, i, kind) + 0.2_wp*node_point(modulo(k, 2) + 1, i, kind) + 2.0_wp + &
                      merge(0.12_wp, 0.04_wp, element_table(kind)%linear == kind)*sin(2.3_wp*i + 1.7_wp*k*i)
         end do
      end do
   end function distorted

   !> Volume of an element: area times thickness in the plane, of the whole ring in an axisymmetric body [length^3].
   pure real(wp) function element_volume(law, x) result(total)
      type(element_law), intent(in) :: law
      real(wp), intent(in)          :: x(:, :)            !! corners (dimension, nodes) [length]
      type(integration_rule) :: rule
      type(element_map)      :: map
      real(wp) :: g(3, max_shapes), volume
      integer  :: i

      call map_element(law, x, map)
      call volume_rule(law%kind, law%state == axisymmetric, rule)
      total = 0.0_wp
      do i = 1, rule%n
         call map_point(law, map, rule%point(:, i), g, volume)
         total = total + rule%weight(i)*volume
      end do
   end function element_volume

end module sample_elements
