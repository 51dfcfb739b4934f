!> Mass of the isoparametric elements: what the integral of N_i N_j over the body is, the same for every component of the
!! displacements, and what it is when all of it is put at the nodes.
!! Sources: consistent: Archer, Consistent mass matrix for distributed mass systems, J. Struct. Div. ASCE 89 (1963) 161-178; lumped:
!! Hinton, Rock, Zienkiewicz, A note on mass lumping and related processes in the finite element method, Earthquake Engng Struct.
!! Dyn. 4 (1976) 245-249, which is positive for elements of second order too.
module element_mass
   use element_kinds, only: max_nodes
   use element_mapping, only: element_law, element_map, map_element, map_point, max_shapes
   use kinds, only: wp
   use quadrature, only: integration_rule, mass_rule
   use shape_functions, only: shape_values
   implicit none
   private

   public :: shape_products, lump

contains

   !> M(i, j) = integral of N_i N_j over the element, of an axisymmetric one over the whole ring [length^3].
   pure subroutine shape_products(law, x, m)
      type(element_law), intent(in) :: law
      real(wp), intent(in)          :: x(:, :) !! nodes (dimension, nodes) [length]
      real(wp), intent(inout)       :: m(:, :) !! (nodes, nodes), set here
      type(element_map)      :: map
      type(integration_rule) :: rule
      real(wp) :: g(3, max_shapes), n(max_nodes), volume
      integer  :: i, j

      call map_element(law, x, map)
      call mass_rule(law%kind, rule)
      associate (nodes => map%n)
         m(:nodes, :nodes) = 0.0_wp
         do i = 1, rule%n
            call map_point(law, map, rule%point(:, i), g, volume)
            call shape_values(law%kind, rule%point(:, i), n)
            do j = 1, nodes
               m(:nodes, j) = m(:nodes, j) + n(:nodes)*(n(j)*(rule%weight(i)*volume))
            end do
         end do
      end associate
   end subroutine shape_products

   !> The mass matrix M becomes diagonal: its own diagonal, scaled so that the mass remains.
   pure subroutine lump(m)
      real(wp), intent(inout) :: m(:, :)
      real(wp) :: diagonal(size(m, 1)), total
      integer  :: i

      diagonal = [(m(i, i), i = 1, size(m, 1))]
      total = sum(m)
      m = 0.0_wp
      do i = 1, size(m, 1)
         m(i, i) = diagonal(i)*(total/sum(diagonal))
      end do
   end subroutine lump

end module element_mass
