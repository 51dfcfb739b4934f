!> Linear shape functions of every kind of element, and their derivatives, in local coordinates.
!! Quadrilateral and hexahedron: each coordinate from -1 to 1. Triangle and tetrahedron: from 0 to 1, corner 1 at the
!! origin. Wedge: a triangle in r, s, and t from -1 to 1.
!! Source: Zienkiewicz, Taylor, Zhu, The Finite Element Method, 6th ed., chapters 4 and 5.
module shape_functions
   use element_kinds, only: kind_hexa8, kind_penta6, kind_quad4, kind_tetra4, kind_tria3, max_nodes, n_kinds
   use kinds, only: wp
   implicit none
   private

   public :: shape_values, shape_derivatives

   !> Local coordinates of the corners: (coordinate, corner, kind).
   real(wp), parameter, public :: corner_point(3, max_nodes, n_kinds) = reshape([real(wp) :: &
      0, 0, 0,  1, 0, 0,  0, 1, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0, &
      -1, -1, 0,  1, -1, 0,  1, 1, 0,  -1, 1, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0, &
      0, 0, 0,  1, 0, 0,  0, 1, 0,  0, 0, 1,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0, &
      0, 0, -1,  1, 0, -1,  0, 1, -1,  0, 0, 1,  1, 0, 1,  0, 1, 1,  0, 0, 0,  0, 0, 0, &
      -1, -1, -1,  1, -1, -1,  1, 1, -1,  -1, 1, -1,  -1, -1, 1,  1, -1, 1,  1, 1, 1,  -1, 1, 1], [3, max_nodes, n_kinds])

   real(wp), parameter, public :: centre_point(3, n_kinds) = reshape([real(wp) :: & !! local coordinates of the centre
      1.0_wp/3.0_wp, 1.0_wp/3.0_wp, 0, 0, 0, 0, 0.25_wp, 0.25_wp, 0.25_wp, 1.0_wp/3.0_wp, 1.0_wp/3.0_wp, 0, 0, 0, 0], &
      [3, n_kinds])

contains

   !> The shape functions N at a point; zero beyond the nodes of the kind.
   pure subroutine shape_values(kind, point, n)
      integer, intent(in)   :: kind                   !! kind_tria3 ... kind_hexa8
      real(wp), intent(in)  :: point(3)               !! local coordinates; the third is not used in the plane
      real(wp), intent(out) :: n(max_nodes)           !! [-]
      integer  :: i

      n = 0.0_wp
      associate (r => point(1), s => point(2), t => point(3), corner => corner_point(:, :, kind))
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
         end select
      end associate
   end subroutine shape_values

   !> Derivatives of the shape functions with respect to the local coordinates. Columns beyond the nodes of the kind, and
   !! the third row in the plane, are left as they are.
   pure subroutine shape_derivatives(kind, point, dn)
      integer, intent(in)     :: kind                 !! kind_tria3 ... kind_hexa8
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
               dn(1, i) = 0.25_wp*corner_point(1, i, kind_quad4)*(1.0_wp + s*corner_point(2, i, kind_quad4))
               dn(2, i) = 0.25_wp*corner_point(2, i, kind_quad4)*(1.0_wp + r*corner_point(1, i, kind_quad4))
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
               a = 1.0_wp + r*corner_point(1, i, kind_hexa8)
               b = 1.0_wp + s*corner_point(2, i, kind_hexa8)
               c = 1.0_wp + t*corner_point(3, i, kind_hexa8)
               dn(1, i) = 0.125_wp*corner_point(1, i, kind_hexa8)*b*c
               dn(2, i) = 0.125_wp*corner_point(2, i, kind_hexa8)*c*a
               dn(3, i) = 0.125_wp*corner_point(3, i, kind_hexa8)*a*b
            end do
         end select
      end associate
   end subroutine shape_derivatives

end module shape_functions
