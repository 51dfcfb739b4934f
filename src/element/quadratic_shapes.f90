!> Shape functions of the second-order elements and edges, and their derivatives: complete on the triangle and the tetrahedron,
!! serendipity functions on the others. Local coordinates: local_nodes.
!! Source: Zienkiewicz, Taylor, Zhu, The Finite Element Method, 6th ed., sections 4.6 to 4.12.
module quadratic_shapes
   use element_kinds, only: element_table, kind_edge3, kind_hexa20, kind_penta15, kind_quad8, kind_tetra10, kind_tria6, max_nodes
   use kinds, only: wp
   use local_nodes, only: node_point
   implicit none
   private

   public :: quadratic_values, quadratic_derivatives

   ! d L_i/d(local j) in (j, i) of the barycentric coordinates, first that which is 1 at corner 1; its third row in space only
   real(wp), parameter :: gradient(3, 4) = reshape([real(wp) :: -1, -1, -1,  1, 0, 0,  0, 1, 0,  0, 0, 1], [3, 4])

contains

   !> The shape functions N at a point. What is beyond the nodes of the kind, and all of another kind, is left as it is.
   pure subroutine quadratic_values(kind, point, n)
      integer, intent(in)     :: kind                 !! kind_tria6 ... kind_hexa20, kind_edge3
      real(wp), intent(in)    :: point(3)             !! local coordinates; those beyond the kind's dimension are not used
      real(wp), intent(inout) :: n(max_nodes)         !! [-]
      real(wp) :: l(4), bubble, factor(4), slope(3)
      integer  :: i

      associate (r => point(1), s => point(2), t => point(3))
         select case (kind)
         case (kind_edge3)
            n(:3) = [0.5_wp*r*(r - 1.0_wp), 0.5_wp*r*(r + 1.0_wp), (1.0_wp - r)*(1.0_wp + r)]
         case (kind_tria6, kind_tetra10)
            associate (corners => element_table(kind)%n_corners)
               l = barycentric(corners, point)
               do i = 1, corners
                  n(i) = l(i)*(2.0_wp*l(i) - 1.0_wp)
               end do
               do i = corners + 1, element_table(kind)%n_nodes
                  n(i) = 4.0_wp*product(l(element_table(kind)%edges(:, i - corners)))
               end do
            end associate
         case (kind_quad8, kind_hexa20)
            do i = 1, element_table(kind)%n_nodes
               call node_factors(kind, i, point, factor, slope)
               n(i) = product(factor)
            end do
         case (kind_penta15)
            l = barycentric(3, point)
            bubble = (1.0_wp - t)*(1.0_wp + t)
            do i = 1, 3
               n(i) = 0.5_wp*l(i)*((2.0_wp*l(i) - 1.0_wp)*(1.0_wp - t) - bubble)
               n(i + 3) = 0.5_wp*l(i)*((2.0_wp*l(i) - 1.0_wp)*(1.0_wp + t) - bubble)
               n(i + 6) = 2.0_wp*l(i)*l(modulo(i, 3) + 1)*(1.0_wp - t)
               n(i + 9) = l(i)*bubble
               n(i + 12) = 2.0_wp*l(i)*l(modulo(i, 3) + 1)*(1.0_wp + t)
            end do
         end select
      end associate
   end subroutine quadratic_values

   !> Derivatives of the shape functions with respect to the local coordinates; the rest of DN is left as it is.
   pure subroutine quadratic_derivatives(kind, point, dn)
      integer, intent(in)     :: kind                 !! kind_tria6 ... kind_hexa20, kind_edge3
      real(wp), intent(in)    :: point(3)             !! local coordinates
      real(wp), intent(inout) :: dn(3, max_nodes)     !! dN_i/d(local j) in dn(j, i) [-]
      real(wp) :: l(4), factor(4), slope(3)
      integer  :: d, i

      select case (kind)
      case (kind_edge3)
         dn(1, :3) = [point(1) - 0.5_wp, point(1) + 0.5_wp, -2.0_wp*point(1)]
      case (kind_tria6, kind_tetra10)
         associate (corners => element_table(kind)%n_corners)
            d = corners - 1
            l = barycentric(corners, point)
            do i = 1, corners
               dn(:d, i) = (4.0_wp*l(i) - 1.0_wp)*gradient(:d, i)
            end do
            do i = corners + 1, element_table(kind)%n_nodes
               associate (b => element_table(kind)%edges(1, i - corners), e => element_table(kind)%edges(2, i - corners))
                  dn(:d, i) = 4.0_wp*(l(b)*gradient(:d, e) + l(e)*gradient(:d, b))
               end associate
            end do
         end associate
      case (kind_quad8, kind_hexa20)
         do i = 1, element_table(kind)%n_nodes
            call node_factors(kind, i, point, factor, slope)
            dn(1, i) = slope(1)*factor(2)*factor(3)
            dn(2, i) = slope(2)*factor(3)*factor(1)
            if (kind == kind_hexa20) dn(3, i) = slope(3)*factor(1)*factor(2)
         end do
      case (kind_penta15)
         call wedge_derivatives(point, dn)
      end select
   end subroutine quadratic_derivatives

   !> Derivatives of the shape functions of the wedge: products of functions of L(r, s) and of t.
   pure subroutine wedge_derivatives(point, dn)
      real(wp), intent(in)    :: point(3)
      real(wp), intent(inout) :: dn(3, max_nodes)
      real(wp) :: bubble, dbubble, down, l(4), up
      integer  :: i, next

      l = barycentric(3, point)
      down = 1.0_wp - point(3)
      up = 1.0_wp + point(3)
      bubble = down*up
      dbubble = -2.0_wp*point(3)
      do i = 1, 3
         next = modulo(i, 3) + 1
         dn(:2, i) = 0.5_wp*((4.0_wp*l(i) - 1.0_wp)*down - bubble)*gradient(:2, i)
         dn(3, i) = 0.5_wp*l(i)*(1.0_wp - 2.0_wp*l(i) - dbubble)
         dn(:2, i + 3) = 0.5_wp*((4.0_wp*l(i) - 1.0_wp)*up - bubble)*gradient(:2, i)
         dn(3, i + 3) = 0.5_wp*l(i)*(2.0_wp*l(i) - 1.0_wp - dbubble)
         dn(:2, i + 6) = 2.0_wp*down*(l(i)*gradient(:2, next) + l(next)*gradient(:2, i))
         dn(3, i + 6) = -2.0_wp*l(i)*l(next)
         dn(:2, i + 9) = bubble*gradient(:2, i)
         dn(3, i + 9) = l(i)*dbubble
         dn(:2, i + 12) = 2.0_wp*up*(l(i)*gradient(:2, next) + l(next)*gradient(:2, i))
         dn(3, i + 12) = 2.0_wp*l(i)*l(next)
      end do
   end subroutine wedge_derivatives

   !> N_i of a quadrilateral or hexahedron is the product of FACTOR, one function of each coordinate and a fourth; its derivative
   !! by coordinate a is SLOPE(a) times the factors of the other coordinates.
   pure subroutine node_factors(kind, i, point, factor, slope)
      integer, intent(in)   :: kind, i
      real(wp), intent(in)  :: point(3)
      real(wp), intent(out) :: factor(4), slope(3)
      real(wp) :: whole
      integer  :: a, d

      d = element_table(kind)%dimension
      factor = 1.0_wp
      slope = 0.0_wp
      whole = 0.5_wp**(d - 1)
      if (i <= element_table(kind)%n_corners) then
         whole = 0.5_wp*whole
         factor(4) = dot_product(point(:d), node_point(:d, i, kind)) - (d - 1)
      end if
      do a = 1, d
         associate (p => node_point(a, i, kind))
            if (abs(p) < 0.5_wp) then
               factor(a) = (1.0_wp - point(a))*(1.0_wp + point(a))
               slope(a) = -2.0_wp*point(a)*whole
            else
               factor(a) = 1.0_wp + point(a)*p
               slope(a) = p*whole
               if (i <= element_table(kind)%n_corners) slope(a) = slope(a)*(factor(4) + factor(a))
            end if
         end associate
      end do
      factor(4) = whole*factor(4)
   end subroutine node_factors

   !> The barycentric coordinates of a triangle (3 corners; the fourth is 0) or a tetrahedron (4).
   pure function barycentric(corners, point) result(l)
      integer, intent(in)  :: corners
      real(wp), intent(in) :: point(3)
      real(wp) :: l(4)

      l(2:corners) = point(:corners - 1)
      l(1) = 1.0_wp - sum(point(:corners - 1))
      l(corners + 1:) = 0.0_wp
   end function barycentric

end module quadratic_shapes
