!> Curved shell elements of second order, six or eight nodes of six dofs: strains by mixed interpolation of tensorial components.
!! The nodes have directors, the unit normals of the element there; fibres stay straight. The covariant strains of the mean
!! surface, their change over the thickness and the transverse shear strains are each taken at points where the interpolation of
!! displacements has them free of locking, and interpolated from there. Eight nodes: MITC9, a ninth node at the centre with the
!! amplitudes of a bubble; a constant is added to strains and curvatures so that their means are those of the displacements, without
!! which distorted elements fail the patch test. Six nodes: MITC6. Shells are thin beside their radii: terms of (t/R)^2 are neglected.
!! Source: M. L. Bucalem, K. J. Bathe, Higher-order MITC general shell elements, Int. J. Numer. Meth. Engng 36 (1993) 3729-3754;
!! P. S. Lee, K. J. Bathe, Development of MITC isotropic triangular shell finite elements, Comput. Struct. 82 (2004) 945-962.
module shell_curved
   use element_kinds, only: centre_point, kind_quad8, kind_tria6, max_nodes, node_point
   use kinds, only: wp
   use numbers, only: cross
   use quadrature, only: gauss, integration_rule, mass_rule
   use shape_functions, only: shape_derivatives, shape_values
   use shell_membrane, only: shell_law
   use tolerances, only: plane_shell
   implicit none
   private

   public :: bubble, bubble_forces, curved_strains, find_bubble, map_curved, surface_kind, surface_normal, tangents

   integer, parameter, public :: most_columns = 54              !! of strains: 6 of each node, 6 of the bubble
   real(wp), parameter :: h = sqrt(0.6_wp)                      ! three Gauss points: -h, 0, h
   real(wp), parameter :: r1 = 0.5_wp - 0.5_wp*gauss, r2 = 0.5_wp + 0.5_wp*gauss
   ! points of the strains along r, then along s, then of the third strain: rs, of triangles that along their third side; the centre
   real(wp), parameter :: tied_quad(2, 16) = reshape([-gauss, -h, gauss, -h, -gauss, 0.0_wp, gauss, 0.0_wp, -gauss, h, gauss, h, &
      -h, -gauss, -h, gauss, 0.0_wp, -gauss, 0.0_wp, gauss, h, -gauss, h, gauss, &
      -gauss, -gauss, gauss, -gauss, -gauss, gauss, gauss, gauss], [2, 16])
   real(wp), parameter :: tied_tria(2, 10) = reshape([r1, 0.0_wp, r2, 0.0_wp, r1, gauss, 0.0_wp, r1, 0.0_wp, r2, gauss, r1, &
      r1, r2, r2, r1, r1, r1, 1.0_wp/3.0_wp, 1.0_wp/3.0_wp], [2, 10])

   !> A curved element and its covariant strains at the tied points: rows rr, ss, rs of the mean surface, of their change over the
   !! height, then rz, sz; shear strains are engineering strains.
   type, public :: curved_map
      integer  :: kind = 0, n = 0                               !! nodes
      real(wp) :: offset = 0.0_wp
      real(wp) :: x(3, 8) = 0.0_wp, director(3, 9) = 0.0_wp     !! that of the bubble last
      real(wp) :: weights(8) = 0.0_wp, bubble_axes(3, 3) = 0.0_wp !! by find_bubble
      real(wp) :: along(3) = 0.0_wp                             !! direction x of the strains: of the material, or of r at the centre
      real(wp) :: tied(8, most_columns, 16) = 0.0_wp
      real(wp) :: mean(6, most_columns) = 0.0_wp                !! to be added to the strains
   end type curved_map

contains

   !> The kind of a surface element with N nodes, 6 or 8.
   pure integer function surface_kind(n)
      integer, intent(in) :: n

      surface_kind = merge(kind_quad8, kind_tria6, n == 8)
   end function surface_kind

   !> The bubble of eight nodes at a POINT: 1 at the centre, 0 along the sides.
   pure real(wp) function bubble(point)
      real(wp), intent(in) :: point(3)

      bubble = (1.0_wp - point(1)**2)*(1.0_wp - point(2)**2)
   end function bubble

   !> The bubble of the displacements of an element with nodes X. In a plane element the displacements of the nodes alone decide its
   !! amplitude in the plane, by WEIGHTS: a displacement of second degree in the coordinates is exact, as it is without the bubble
   !! where opposite sides are parallel. An amplitude of its own would be condensed without its inertia, which is as large as that of
   !! all nodes. AXES are the directions of free amplitudes: normal to the element, and in a curved one along it.
   !! Source of the weights: R. H. MacNeal, R. L. Harder, Eight nodes or nine?, Int. J. Numer. Meth. Engng 33 (1992) 1049-1058.
   pure subroutine find_bubble(x, weights, axes)
      real(wp), intent(in)  :: x(:, :)            !! (3, 8) [length]
      real(wp), intent(out) :: weights(8), axes(3, 3)
      real(wp) :: at(3, 8), basis(8, 6), n(max_nodes), q(8), value(6)
      integer  :: i, k

      call shape_values(kind_quad8, centre_point(:, kind_quad8), n)
      axes(:, :2) = tangents(x, centre_point(:, kind_quad8))
      axes(:, 3) = cross(axes(:, 1), axes(:, 2))
      axes(:, 2) = cross(axes(:, 3), axes(:, 1))
      do i = 1, 3
         axes(:, i) = axes(:, i)/max(norm2(axes(:, i)), tiny(1.0_wp))
      end do
      at = matmul(transpose(axes), x - spread(matmul(x, n(:8)), 2, 8))
      weights = 0.0_wp
      if (maxval(abs(at(3, :))) > plane_shell*maxval(abs(at))) return
      axes(:, :2) = 0.0_wp
      do k = 1, 6                                 ! 1, x, y, then xx, xy, yy: the least weights that give each at the centre
         if (k == 1) q = 1.0_wp
         if (k == 2 .or. k == 3) q = at(k - 1, :)
         if (k > 3) q = at(merge(1, 2, k < 6), :)*at(merge(1, 2, k < 5), :)
         value(k) = merge(-dot_product(n(:8), q), 0.0_wp, k > 3)
         do i = 1, k - 1
            associate (part => dot_product(basis(:, i), q))
               value(k) = value(k) - part*value(i)
               q = q - part*basis(:, i)
            end associate
         end do
         associate (left => max(norm2(q), tiny(1.0_wp)))
            value(k) = value(k)/left
            basis(:, k) = q/left
         end associate
         weights = weights + value(k)*basis(:, k)
      end do
   end subroutine find_bubble

   !> Forces F on the amplitudes of the bubble, of displacements along its axes, under the load Q at the nodes.
   pure function bubble_forces(map, q) result(f)
      type(curved_map), intent(in) :: map
      real(wp), intent(in)         :: q(:, :)     !! (3, 8) [force/length^2]
      real(wp) :: f(3), a(3, 2), n(max_nodes)
      type(integration_rule) :: rule
      integer  :: p

      f = 0.0_wp
      call mass_rule(map%kind, rule)
      do p = 1, rule%n
         a = tangents(map%x(:, :map%n), rule%point(:, p))
         call shape_values(map%kind, rule%point(:, p), n)
         f = f + rule%weight(p)*norm2(cross(a(:, 1), a(:, 2)))*bubble(rule%point(:, p))*matmul(q, n(:map%n))
      end do
      f = matmul(f, map%bubble_axes)
   end function bubble_forces

   !> The derivatives with respect to r and s of the position of the nodes X, at a POINT.
   pure function tangents(x, point) result(a)
      real(wp), intent(in) :: x(:, :), point(3)   !! (3, 6 or 8) [length]
      real(wp) :: a(3, 2), dn(3, max_nodes)

      call shape_derivatives(surface_kind(size(x, 2)), point, dn)
      a = matmul(x, transpose(dn(:2, :size(x, 2))))
   end function tangents

   !> The unit normal of an element at its node I.
   pure function surface_normal(x, i) result(normal)
      real(wp), intent(in) :: x(:, :)             !! (3, 6 or 8) [length]
      integer, intent(in)  :: i
      real(wp) :: a(3, 2), normal(3)
      integer  :: kind

      kind = surface_kind(size(x, 2))
      a = tangents(x, node_point(:, i, kind))
      normal = cross(a(:, 1), a(:, 2))
      normal = normal/max(norm2(normal), tiny(1.0_wp))
   end function surface_normal

   !> MAP an element with nodes X.
   pure subroutine map_curved(law, x, map)
      type(shell_law), intent(in)   :: law
      real(wp), intent(in)          :: x(:, :)    !! (3, 6 or 8) [length]
      type(curved_map), intent(out) :: map
      real(wp) :: n(max_nodes), a(3, 2), twist(most_columns), b(8, most_columns), free(8, most_columns), axes(3, 3), area, volume
      real(wp) :: sum_of(6, most_columns)
      type(integration_rule) :: rule
      integer  :: i

      map%n = size(x, 2)
      map%kind = surface_kind(map%n)
      map%offset = law%offset
      map%x(:, :map%n) = x
      do i = 1, map%n
         map%director(:, i) = surface_normal(x, i)
      end do
      if (map%n == 8) call find_bubble(x, map%weights, map%bubble_axes)
      call shape_values(map%kind, centre_point(:, map%kind), n)
      do i = 1, map%n
         map%director(:, 9) = map%director(:, 9) + n(i)*map%director(:, i)
      end do
      do i = 1, merge(16, 10, map%n == 8)
         if (map%n == 8) call covariant(map, [tied_quad(:, i), 0.0_wp], map%tied(:, :, i), twist, a)
         if (map%n == 6) call covariant(map, [tied_tria(:, i), 0.0_wp], map%tied(:, :, i), twist, a)
      end do
      a = tangents(x, centre_point(:, map%kind))
      map%along = a(:, 1)
      if (norm2(law%along) > 0.0_wp) map%along = law%along
      if (map%n == 6) return
      area = 0.0_wp
      sum_of = 0.0_wp
      call mass_rule(map%kind, rule)
      do i = 1, rule%n
         call curved_strains(map, rule%point(:, i), b, twist, axes, volume, free)
         area = area + rule%weight(i)*volume
         sum_of = sum_of + rule%weight(i)*volume*(free(:6, :) - b(:6, :))
      end do
      map%mean = sum_of/area
   end subroutine map_curved

   !> Covariant strains B at a POINT as displacements are interpolated, TWIST, the drilling rotation beyond the rotation of the
   !! surface, and the tangents A of the mean surface.
   pure subroutine covariant(map, point, b, twist, a, da)
      type(curved_map), intent(in)    :: map
      real(wp), intent(in)            :: point(3)
      real(wp), intent(out)           :: b(8, most_columns), twist(most_columns), a(3, 2)
      real(wp), intent(out), optional :: da(3, 2) !! change of A per height
      real(wp) :: dn(3, max_nodes), n(max_nodes), dv(3, 2), g(3, 2), normal(3), v(3), w(3, 2), of_u(8, 3), of_twist(3)
      integer  :: c, i, m

      m = map%n
      call shape_values(map%kind, point, n)
      call shape_derivatives(map%kind, point, dn)
      v = matmul(map%director(:, :m), n(:m))
      dv = matmul(map%director(:, :m), transpose(dn(:2, :m)))
      a = matmul(map%x(:, :m), transpose(dn(:2, :m))) + map%offset*dv
      if (present(da)) da = dv
      normal = cross(a(:, 1), a(:, 2))
      g = reshape([a(:, 2), -a(:, 1)], [3, 2])/norm2(normal) ! normal x the contravariant tangents
      normal = normal/norm2(normal)
      b = 0.0_wp
      twist = 0.0_wp
      dn(:2, 9) = 0.0_wp
      if (m == 8) then                            ! the bubble
         n(9) = bubble(point)
         dn(:2, 9) = -2.0_wp*point(:2)*[1.0_wp - point(2)**2, 1.0_wp - point(1)**2]
         m = 9
      end if
      do i = 1, m
         c = 3*i - 2
         if (i < 9) then
            dn(:2, i) = dn(:2, i) + map%weights(i)*dn(:2, 9)
            call displace(dn(:, i), b(:, c:c + 2), twist(c:c + 2))
            dn(:2, i) = dn(:2, i) - map%weights(i)*dn(:2, 9)
         end if
         call displace(dn(:, i), of_u, of_twist)
         associate (director => map%director(:, i), at => merge(52, 3*(map%n + i) - 2, i == 9))
            w = reshape([cross(director, a(:, 1)), cross(director, a(:, 2))], [3, 2]) ! of the rotation of the fibre
            b(4:8, at:at + 2) = transpose(reshape([dn(1, i)*w(:, 1), dn(2, i)*w(:, 2), dn(2, i)*w(:, 1) + dn(1, i)*w(:, 2), &
                                                  n(i)*w(:, 1), n(i)*w(:, 2)], [3, 5]))
            do c = 1, 8                           ! the displacement of the mean surface is u + theta x offset director
               b(c, at:at + 2) = b(c, at:at + 2) + map%offset*cross(director, of_u(c, :))
            end do
            twist(at:at + 2) = n(i)*normal + map%offset*cross(director, of_twist)
            if (i < 9) cycle
            b(:, 49:51) = matmul(of_u, map%bubble_axes)
            twist(49:51) = matmul(of_twist, map%bubble_axes)
         end associate
      end do

   contains

      !> Strains and twist of displacements with the derivatives D.
      pure subroutine displace(d, b, twist)
         real(wp), intent(in)  :: d(:)
         real(wp), intent(out) :: b(8, 3), twist(3)

         b = transpose(reshape([d(1)*a(:, 1), d(2)*a(:, 2), d(2)*a(:, 1) + d(1)*a(:, 2), &
                                d(1)*dv(:, 1), d(2)*dv(:, 2), d(2)*dv(:, 1) + d(1)*dv(:, 2), d(1)*v, d(2)*v], [3, 8]))
         twist = -0.5_wp*(d(1)*g(:, 1) + d(2)*g(:, 2))
      end subroutine displace

   end subroutine covariant

   !> Strains B at a POINT in the axes of the material there: xx, yy, xy of the mean surface, their change over the height, xz, yz;
   !! from the nodal values, then from the amplitudes of the bubble. AXES are these axes, VOLUME is the area per unit of weight.
   pure subroutine curved_strains(map, point, b, twist, axes, volume, free)
      type(curved_map), intent(in) :: map
      real(wp), intent(in)         :: point(3)
      real(wp), intent(out)        :: b(8, most_columns), twist(most_columns), axes(3, 3), volume
      real(wp), intent(out), optional :: free(8, most_columns) !! as displacements are interpolated
      real(wp) :: a(3, 2), da(3, 2), j(2, 2), r(2, 2), dr(2, 2)

      call covariant(map, point, b, twist, a, da)
      if (present(free)) free = b
      if (map%n == 8) call interpolate_quad(map, point, b)
      if (map%n == 6) call interpolate_tria(map, point, b)
      axes(:, 3) = cross(a(:, 1), a(:, 2))
      axes(:, 3) = axes(:, 3)/norm2(axes(:, 3))
      axes(:, 1) = map%along - dot_product(map%along, axes(:, 3))*axes(:, 3)
      axes(:, 1) = axes(:, 1)/max(norm2(axes(:, 1)), tiny(1.0_wp))
      axes(:, 2) = cross(axes(:, 3), axes(:, 1))
      j = matmul(transpose(a), axes(:, :2))
      volume = j(1, 1)*j(2, 2) - j(1, 2)*j(2, 1)
      r = reshape([j(2, 2), -j(1, 2), -j(2, 1), j(1, 1)], [2, 2])/volume ! d(r, s)/d(x, y)
      dr = -matmul(r, matmul(transpose(matmul(transpose(da), axes(:, :2))), r)) ! its change over the height
      call turn(b)
      b(:6, :) = b(:6, :) + map%mean
      if (present(free)) call turn(free)

   contains

      !> Turn covariant strains B into those in the axes.
      pure subroutine turn(b)
         real(wp), intent(inout) :: b(8, most_columns)
         real(wp) :: m(3, 6)

         m(:, :3) = to_axes(r + dr) - to_axes(r) - to_axes(dr)
         m(:, 4:) = to_axes(r)
         b(4:6, :) = matmul(m, b(:6, :))
         b(:3, :) = matmul(m(:, 4:), b(:3, :))
         b(7:, :) = matmul(transpose(r), b(7:, :))
      end subroutine turn

   end subroutine curved_strains

   !> The matrix that gives strains xx, yy, xy from covariant strains, R = d(r, s)/d(x, y).
   pure function to_axes(r) result(m)
      real(wp), intent(in) :: r(2, 2)
      real(wp) :: m(3, 3)

      m(1, :) = [r(1, 1)**2, r(2, 1)**2, r(1, 1)*r(2, 1)]
      m(2, :) = [r(1, 2)**2, r(2, 2)**2, r(1, 2)*r(2, 2)]
      m(3, :) = [2.0_wp*r(1, 1)*r(1, 2), 2.0_wp*r(2, 1)*r(2, 2), r(1, 1)*r(2, 2) + r(2, 1)*r(1, 2)]
   end function to_axes

   !> B at a POINT from the tied points: strains along r linear in r and quadratic in s, along s likewise, rs bilinear.
   pure subroutine interpolate_quad(map, point, b)
      type(curved_map), intent(in) :: map
      real(wp), intent(in)         :: point(3)
      real(wp), intent(inout)      :: b(8, most_columns)
      real(wp) :: linear(2, 2), quadratic(3, 2)
      integer  :: i, k

      do i = 1, 2
         associate (r => point(i))
            linear(:, i) = 0.5_wp*[1.0_wp - r/gauss, 1.0_wp + r/gauss]
            quadratic(:, i) = [r*(r - h), 2.0_wp*(h**2 - r**2), r*(r + h)]/(2.0_wp*h**2)
         end associate
      end do
      b = 0.0_wp
      do k = 1, 6
         associate (i => modulo(k - 1, 2) + 1, j => (k + 1)/2)
            b([1, 4, 7], :) = b([1, 4, 7], :) + linear(i, 1)*quadratic(j, 2)*map%tied([1, 4, 7], :, k)
            b([2, 5, 8], :) = b([2, 5, 8], :) + linear(i, 2)*quadratic(j, 1)*map%tied([2, 5, 8], :, 6 + k)
            if (k <= 4) b([3, 6], :) = b([3, 6], :) + linear(i, 1)*linear(j, 2)*map%tied([3, 6], :, 12 + k)
         end associate
      end do
   end subroutine interpolate_quad

   !> B at a POINT from the tied points: strains along each side are linear, each from three points; shear strains are linear along
   !! the sides, from two points on each, and have those of the centre: the field a + b r + c s + (s, -r) (d r + e s).
   pure subroutine interpolate_tria(map, point, b)
      type(curved_map), intent(in) :: map
      real(wp), intent(in)         :: point(3)
      real(wp), intent(inout)      :: b(8, most_columns)
      real(wp) :: corner(most_columns, 2, 3), ends(most_columns, 2, 3), side(most_columns, 9), third(2, most_columns)
      real(wp) :: miss(most_columns, 2)
      integer  :: k

      associate (r => point(1), s => point(2), t => 1.0_wp - point(1) - point(2), tied => map%tied)
         b([1, 4], :) = weighted(tied([1, 4], :, 1:3), r, s)
         b([2, 5], :) = weighted(tied([2, 5], :, 4:6), s, r)
         third = weighted(tied([1, 4], :, 7:9) + tied([2, 5], :, 7:9) - tied([3, 6], :, 7:9), r, t)
         b([3, 6], :) = b([1, 4], :) + b([2, 5], :) - third
         side(:, 1:2) = tied(7, :, 1:2)
         side(:, 4:5) = tied(8, :, 4:5)
         side(:, 7:8) = tied(8, :, 7:8) - tied(7, :, 7:8)
         do k = 1, 3                              ! at both ends of the side
            ends(:, 1, k) = (r2*side(:, 3*k - 2) - r1*side(:, 3*k - 1))/gauss
            ends(:, 2, k) = (r2*side(:, 3*k - 1) - r1*side(:, 3*k - 2))/gauss
         end do
         ! corner 3 begins with the point nearer to it, point 7: the side from corner 3 to corner 2
         corner(:, :, 1) = ends(:, 1, 1:2)
         corner(:, 1, 2) = ends(:, 2, 1)
         corner(:, 2, 2) = ends(:, 2, 1) + ends(:, 2, 3)
         corner(:, 1, 3) = ends(:, 2, 2) - ends(:, 1, 3)
         corner(:, 2, 3) = ends(:, 2, 2)
         miss = transpose(tied(7:, :, 10)) - sum(corner, dim=3)/3.0_wp
         miss = 6.0_wp*miss(:, [2, 1]) - 3.0_wp*miss ! of r (s, 1 - r), s (1 - s, r), which have no component along a side
         do k = 1, 2
            b(6 + k, :) = t*corner(:, k, 1) + r*corner(:, k, 2) + s*corner(:, k, 3)
         end do
         b(7, :) = b(7, :) + s*(r*miss(:, 1) + (1.0_wp - s)*miss(:, 2))
         b(8, :) = b(8, :) + r*((1.0_wp - r)*miss(:, 1) + s*miss(:, 2))
      end associate

   contains

      !> The linear field with these VALUES at the three points: (r1, 0), (r2, 0), (r1, gauss) in coordinates P and Q.
      pure function weighted(values, p, q) result(field)
         real(wp), intent(in) :: values(2, most_columns, 3), p, q
         real(wp) :: field(2, most_columns), along, across

         along = (p - r1)/gauss
         across = q/gauss
         field = (1.0_wp - along - across)*values(:, :, 1) + along*values(:, :, 2) + across*values(:, :, 3)
      end function weighted

   end subroutine interpolate_tria

end module shell_curved
