!> Shape functions of every kind of element and of the edges of plane ones, and their derivatives, in the local coordinates of
!! local_nodes.
!! Source: Zienkiewicz, Taylor, Zhu, The Finite Element Method, 6th ed., chapters 4 and 5.
module shape_functions
   use element_kinds, only: kind_edge2, kind_hexa8, kind_penta6, kind_quad4, kind_tetra4, kind_tria3, max_nodes
   use kinds, only: wp
   use local_nodes, only: node_point
   use quadratic_shapes, only: quadratic_derivatives, quadratic_values
   implicit none
   private

   public :: shape_values, shape_derivatives

contains

   !> The shape functions N at a point; zero beyond the nodes of the kind.
   pure subroutine shape_values(kind, point, n)
      integer, intent(in)   :: kind                   !! kind_tria3 ... kind_edge3
      real(wp), intent(in)  :: point(3)               !! local coordinates; those beyond the kind's dimension are not used
      real(wp), intent(out) :: n(max_nodes)           !! [-]
      integer  :: i

      n = 0.0_wp
      associate (r => point(1), s => point(2), t => point(3), corner => node_point(:, :, kind))
         select case (kind)
         case (kind_tria3)
            n(:3) = [1.0_wp - r - s, r, s]
         case (kind_quad4)
            do i = 1, 4
               n(i) = 0.25_wp*(1.0_wp + r*corner(1, i))*(1.0_wp + s*corner(2, i))
            end do
         case (kind_tetra4)
            n(:4) = [1.0_wp - r - s - t, r, s, t]
         case (kind_penta6)
            n(:3) = 0.5_wp*(1.0_wp - t)*[1.0_wp - r - s, r, s]
            n(4:6) = 0.5_wp*(1.0_wp + t)*[1.0_wp - r - s, r, s]
         case (kind_hexa8)
            do i = 1, 8
               n(i) = 0.125_wp*(1.0_wp + r*corner(1, i))*(1.0_wp + s*corner(2, i))*(1.0_wp + t*corner(3, i))
            end do
         case (kind_edge2)
            n(:2) = [0.5_wp*(1.0_wp - r), 0.5_wp*(1.0_wp + r)]
         case default
            call quadratic_values(kind, point, n)
         end select
      end associate
   end subroutine shape_values

   !> Derivatives of the shape functions with respect to the local coordinates. Columns beyond the nodes of the kind, and
   !! the rows beyond its dimension, are left as they are.
   pure subroutine shape_derivatives(kind, point, dn)
      integer, intent(in)     :: kind                 !! kind_tria3 ... kind_edge3
      real(wp), intent(in)    :: point(3)             !! local coordinates
      real(wp), intent(inout) :: dn(3, max_nodes)     !! dN_i/d(local j) in dn(j, i) [-]
      real(wp) :: a, b, c
      integer  :: i

      associate (r => point(1), s => point(2), t => point(3))
         select case (kind)
         case (kind_tria3)
            dn(:2, 1) = [-1.0_wp, -1.0_wp]
            dn(:2, 2) = [1.0_wp, 0.0_wp]
            dn(:2, 3) = [0.0_wp, 1.0_wp]
         case (kind_quad4)
            do i = 1, 4
               dn(1, i) = 0.25_wp*node_point(1, i, kind_quad4)*(1.0_wp + s*node_point(2, i, kind_quad4))
               dn(2, i) = 0.25_wp*node_point(2, i, kind_quad4)*(1.0_wp + r*node_point(1, i, kind_quad4))
            end do
         case (kind_tetra4)
            dn(:, 1) = [-1.0_wp, -1.0_wp, -1.0_wp]
            dn(:, 2) = [1.0_wp, 0.0_wp, 0.0_wp]
            dn(:, 3) = [0.0_wp, 1.0_wp, 0.0_wp]
            dn(:, 4) = [0.0_wp, 0.0_wp, 1.0_wp]
         case (kind_penta6)
            a = 0.5_wp*(1.0_wp - t)
            b = 0.5_wp*(1.0_wp + t)
            dn(:, 1) = [-a, -a, -0.5_wp*(1.0_wp - r - s)]
            dn(:, 2) = [a, 0.0_wp, -0.5_wp*r]
            dn(:, 3) = [0.0_wp, a, -0.5_wp*s]
            dn(:, 4) = [-b, -b, 0.5_wp*(1.0_wp - r - s)]
            dn(:, 5) = [b, 0.0_wp, 0.5_wp*r]
            dn(:, 6) = [0.0_wp, b, 0.5_wp*s]
         case (kind_hexa8)
            do i = 1, 8
               a = 1.0_wp + r*node_point(1, i, kind_hexa8)
               b = 1.0_wp + s*node_point(2, i, kind_hexa8)
               c = 1.0_wp + t*node_point(3, i, kind_hexa8)
               dn(1, i) = 0.125_wp*node_point(1, i, kind_hexa8)*b*c
               dn(2, i) = 0.125_wp*node_point(2, i, kind_hexa8)*c*a
               dn(3, i) = 0.125_wp*node_point(3, i, kind_hexa8)*a*b
            end do
         case (kind_edge2)
            dn(1, :2) = [-0.5_wp, 0.5_wp]
         case default
            call quadratic_derivatives(kind, point, dn)
         end select
      end associate
   end subroutine shape_derivatives

end module shape_functions
