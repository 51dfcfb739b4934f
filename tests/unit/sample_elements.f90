!> Elements for tests of shapes, stiffnesses and loads.
module sample_elements
   use elasticity, only: axisymmetric, solid
   use element_kinds, only: element_table, kind_hexa8, kind_penta6, kind_quad4, max_nodes, node_point
   use element_mapping, only: element_law, element_map, make_element_law, map_element, map_point, max_shapes
   use kinds, only: wp
   use quadrature, only: integration_rule, volume_rule
   implicit none
   private

   public :: belong, cross, distorted, element_volume, law_of

   real(wp), parameter, public :: e = 210.0_wp, nu = 0.3_wp

contains

   !> E, nu and the thickness 0.7.
   pure type(element_law) function law_of(kind, state, incompatible)
      integer, intent(in) :: kind, state
      logical, intent(in) :: incompatible

      law_of = make_element_law(kind, state, e, nu, 0.7_wp, incompatible)
   end function law_of

   !> Whether a kind of element, a state and the modes go together.
   pure logical function belong(kind, state, incompatible)
      integer, intent(in) :: kind, state
      logical, intent(in) :: incompatible

      belong = (element_table(kind)%dimension == 3) .eqv. (state == solid)
      if (incompatible) belong = belong .and. (any(kind == [kind_hexa8, kind_penta6]) .or. &
                                               (kind == kind_quad4 .and. state /= axisymmetric))
   end function belong

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

   !> a x b, by hand: independent of the program.
   pure function cross(a, b) result(c)
      real(wp), intent(in) :: a(3), b(3)
      real(wp) :: c(3)

      c = [a(2)*b(3) - a(3)*b(2), a(3)*b(1) - a(1)*b(3), a(1)*b(2) - a(2)*b(1)]
   end function cross

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
