!> Shape functions of every kind of element and edge, and their derivatives with respect to local coordinates.
!! Second-order functions are complete on the triangle and the tetrahedron, serendipity functions on the other kinds.
!! Source: Zienkiewicz, Taylor, Zhu, The Finite Element Method, 6th ed., chapters 4 and 5, sections 4.6 to 4.12; of the pyramid:
!! Bedrosian, Shape functions and integration formulas for three-dimensional finite element analysis, Int. J. Numer. Meth. Engng 35
!! (1992) 95-108: those of a hexahedron whose upper corners are one are rational functions of x, y, z that fit all neighbours.
module shape_functions
   use element_kinds, only: element_table, kind_edge2, kind_edge3, kind_hexa20, kind_hexa8, kind_penta15, kind_penta6, kind_quad4, &
                            kind_pyram5, kind_quad8, kind_tetra10, kind_tetra4, kind_tria3, kind_tria6, max_edges, max_nodes, &
                            node_point
   use kinds, only: wp
   implicit none
   private

   public :: shape_values, shape_derivatives

   ! d L_i/d(local j) in (j, i) of the barycentric coordinates, L_1 = 1 at corner 1; the third row is used in space only
   real(wp), parameter :: gradient(3, 4) = reshape([real(wp) :: -1, -1, -1,  1, 0, 0,  0, 1, 0,  0, 0, 1], [3, 4])

   integer, parameter :: along(max_edges) = [1, 2, 1, 2, 3, 3, 3, 3, 1, 2, 1, 2] ! the coordinate along each edge
   integer, parameter :: next(3) = [2, 3, 1]

contains

   !> Shape functions N of the quadrilateral and the hexahedron, and their derivatives DN. At a corner: the product of the linear
   !! functions of all coordinates and a factor that vanishes at the adjacent mid-edge nodes. On an edge: a parabola along it times
   !! linear functions of the other coordinates.
   pure subroutine serendipity(kind, point, n, dn)
      integer, intent(in)     :: kind
      real(wp), intent(in)    :: point(3)
      real(wp), intent(inout), optional :: n(max_nodes), dn(3, max_nodes)
      real(wp) :: bubble, f(3), inner, whole, x(3)
      integer  :: a, b, c, corners, d, i

      d = element_table(kind)%dimension
      corners = element_table(kind)%n_corners
      whole = merge(0.25_wp, 0.125_wp, d == 2)
      x = 0.0_wp
      x(:d) = point(:d)
      associate (p => node_point(:, :, kind))
         do i = 1, corners
            inner = x(1)*p(1, i) + x(2)*p(2, i) + x(3)*p(3, i) - (d - 1)
            f = 1.0_wp + x*p(:, i)
            if (present(n)) n(i) = whole*f(1)*f(2)*f(3)*inner
            if (.not. present(dn)) cycle
            dn(1, i) = whole*p(1, i)*f(2)*f(3)*(inner + f(1))
            dn(2, i) = whole*p(2, i)*f(3)*f(1)*(inner + f(2))
            if (d == 3) dn(3, i) = whole*p(3, i)*f(1)*f(2)*(inner + f(3))
         end do
         do i = corners + 1, element_table(kind)%n_nodes
            a = along(i - corners)
            b = next(a)
            c = next(b)
            bubble = 2.0_wp*whole*(1.0_wp - x(a))*(1.0_wp + x(a))
            f = 1.0_wp + x*p(:, i)
            if (present(n)) n(i) = bubble*f(b)*f(c)
            if (.not. present(dn)) cycle
            dn(a, i) = -4.0_wp*whole*x(a)*f(b)*f(c)
            if (b <= d) dn(b, i) = bubble*p(b, i)*f(c)
            if (c <= d) dn(c, i) = bubble*f(b)*p(c, i)
         end do
      end associate
   end subroutine serendipity

   !> The barycentric coordinates of a triangle (3 corners; the fourth is 0) or a tetrahedron (4).
   pure function barycentric(corners, point) result(l)
      integer, intent(in)  :: corners
      real(wp), intent(in) :: point(3)
      real(wp) :: l(4)

      l(2:corners) = point(:corners - 1)
      l(1) = 1.0_wp - sum(point(:corners - 1))
      l(corners + 1:) = 0.0_wp
   end function barycentric

   !> The shape functions N at a point; zero beyond the nodes of the kind.
   pure subroutine shape_values(kind, point, n)
      integer, intent(in)   :: kind                   !! kind_tria3 ... kind_edge3
      real(wp), intent(in)  :: point(3)               !! local coordinates; those beyond the dimension of the kind are not used
      real(wp), intent(out) :: n(max_nodes)           !! [-]
      real(wp) :: l(4), bubble
      integer  :: i

      n = 0.0_wp
      associate (r => point(1), s => point(2), t => point(3), corner => node_point(:, :, kind))
         select case (kind)
         case (kind_tria3)
            n(:3) = [1.0_wp - r - s, r, s]
         case (kind_quad4)
            n(:4) = 0.25_wp*(1.0_wp + r*corner(1, :4))*(1.0_wp + s*corner(2, :4))
         case (kind_tetra4)
            n(:4) = [1.0_wp - r - s - t, r, s, t]
         case (kind_penta6)
            n(:3) = 0.5_wp*(1.0_wp - t)*[1.0_wp - r - s, r, s]
            n(4:6) = 0.5_wp*(1.0_wp + t)*[1.0_wp - r - s, r, s]
         case (kind_hexa8)
            do i = 1, 8
               n(i) = 0.125_wp*(1.0_wp + r*corner(1, i))*(1.0_wp + s*corner(2, i))*(1.0_wp + t*corner(3, i))
            end do
         case (kind_pyram5) ! of a hexahedron, those of its upper corners added up
            do i = 1, 4
               n(i) = 0.125_wp*(1.0_wp + r*corner(1, i))*(1.0_wp + s*corner(2, i))*(1.0_wp - t)
            end do
            n(5) = 0.5_wp*(1.0_wp + t)
         case (kind_edge2)
            n(:2) = [0.5_wp*(1.0_wp - r), 0.5_wp*(1.0_wp + r)]
         case (kind_edge3)
            n(:3) = [0.5_wp*r*(r - 1.0_wp), 0.5_wp*r*(r + 1.0_wp), (1.0_wp - r)*(1.0_wp + r)]
         case (kind_tria6, kind_tetra10)
            associate (corners => element_table(kind)%n_corners)
               l = barycentric(corners, point)
               n(:corners) = l(:corners)*(2.0_wp*l(:corners) - 1.0_wp)
               do i = corners + 1, element_table(kind)%n_nodes
                  n(i) = 4.0_wp*product(l(element_table(kind)%edges(:, i - corners)))
               end do
            end associate
         case (kind_quad8, kind_hexa20)
            call serendipity(kind, point, n=n)
         case (kind_penta15)
            l = barycentric(3, point)
            bubble = (1.0_wp - t)*(1.0_wp + t)
            do i = 1, 3
               n(i) = 0.5_wp*l(i)*((2.0_wp*l(i) - 1.0_wp)*(1.0_wp - t) - bubble)
               n(i + 3) = 0.5_wp*l(i)*((2.0_wp*l(i) - 1.0_wp)*(1.0_wp + t) - bubble)
               n(i + 6) = 2.0_wp*l(i)*l(next(i))*(1.0_wp - t)
               n(i + 9) = l(i)*bubble
               n(i + 12) = 2.0_wp*l(i)*l(next(i))*(1.0_wp + t)
            end do
         end select
      end associate
   end subroutine shape_values

   !> Derivatives of the shape functions with respect to the local coordinates. Columns beyond the nodes of the kind and rows beyond
   !! its dimension are not changed.
   pure subroutine shape_derivatives(kind, point, dn)
      integer, intent(in)     :: kind                 !! kind_tria3 ... kind_edge3
      real(wp), intent(in)    :: point(3)             !! local coordinates
      real(wp), intent(inout) :: dn(3, max_nodes)     !! dN_i/d(local j) in dn(j, i) [-]
      real(wp) :: a, b, bubble, c, dbubble, down, l(4), up
      integer  :: corners, d, i, k

      associate (r => point(1), s => point(2), t => point(3))
         select case (kind)
         case (kind_tria3)
            dn(:2, :3) = gradient(:2, :3)
         case (kind_quad4)
            do i = 1, 4
               dn(1, i) = 0.25_wp*node_point(1, i, kind_quad4)*(1.0_wp + s*node_point(2, i, kind_quad4))
               dn(2, i) = 0.25_wp*node_point(2, i, kind_quad4)*(1.0_wp + r*node_point(1, i, kind_quad4))
            end do
         case (kind_tetra4)
            dn(:, :4) = gradient
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
         case (kind_pyram5)
            do i = 1, 4
               a = 1.0_wp + r*node_point(1, i, kind_pyram5)
               b = 1.0_wp + s*node_point(2, i, kind_pyram5)
               dn(1, i) = 0.125_wp*node_point(1, i, kind_pyram5)*b*(1.0_wp - t)
               dn(2, i) = 0.125_wp*node_point(2, i, kind_pyram5)*a*(1.0_wp - t)
               dn(3, i) = -0.125_wp*a*b
            end do
            dn(:, 5) = [0.0_wp, 0.0_wp, 0.5_wp]
         case (kind_edge2)
            dn(1, :2) = [-0.5_wp, 0.5_wp]
         case (kind_edge3)
            dn(1, :3) = [r - 0.5_wp, r + 0.5_wp, -2.0_wp*r]
         case (kind_tria6, kind_tetra10)
            corners = element_table(kind)%n_corners
            d = corners - 1
            l = barycentric(corners, point)
            do i = 1, corners
               dn(:d, i) = (4.0_wp*l(i) - 1.0_wp)*gradient(:d, i)
            end do
            do i = corners + 1, element_table(kind)%n_nodes
               associate (m => element_table(kind)%edges(1, i - corners), e => element_table(kind)%edges(2, i - corners))
                  dn(:d, i) = 4.0_wp*(l(m)*gradient(:d, e) + l(e)*gradient(:d, m))
               end associate
            end do
         case (kind_quad8, kind_hexa20)
            call serendipity(kind, point, dn=dn)
         case (kind_penta15) ! products of functions of L(r, s) and of t
            l = barycentric(3, point)
            down = 1.0_wp - t
            up = 1.0_wp + t
            bubble = down*up
            dbubble = -2.0_wp*t
            do i = 1, 3
               k = next(i)
               dn(:2, i) = 0.5_wp*((4.0_wp*l(i) - 1.0_wp)*down - bubble)*gradient(:2, i)
               dn(3, i) = 0.5_wp*l(i)*(1.0_wp - 2.0_wp*l(i) - dbubble)
               dn(:2, i + 3) = 0.5_wp*((4.0_wp*l(i) - 1.0_wp)*up - bubble)*gradient(:2, i)
               dn(3, i + 3) = 0.5_wp*l(i)*(2.0_wp*l(i) - 1.0_wp - dbubble)
               dn(:2, i + 6) = 2.0_wp*down*(l(i)*gradient(:2, k) + l(k)*gradient(:2, i))
               dn(3, i + 6) = -2.0_wp*l(i)*l(k)
               dn(:2, i + 9) = bubble*gradient(:2, i)
               dn(3, i + 9) = l(i)*dbubble
               dn(:2, i + 12) = 2.0_wp*up*(l(i)*gradient(:2, k) + l(k)*gradient(:2, i))
               dn(3, i + 12) = 2.0_wp*l(i)*l(k)
            end do
         end select
      end associate
   end subroutine shape_derivatives

end module shape_functions
