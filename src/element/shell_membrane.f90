!> Shell elements in their plane: property, geometry, and the membrane with drilling rotations theta_z.
!! An element is flat: its corners are projected onto its mean plane. The distance of a corner from this plane is a rigid lever, as
!! is the offset of the plate (ZOFFS). Values of a corner are u, v, w and the rotations, in the axes of the element.
!!
!! Triangle: after the optimal triangle with drilling rotations (C. A. Felippa, A study of optimal membrane triangles with drilling
!! freedoms, Comput. Methods Appl. Mech. Engrg. 192 (2003) 2125-2168), with two changes.
!!
!! 1. The drilling rotations of the ends of an edge bow the edge in its plane. The traction on a bowed edge does work on these
!!    rotations: it asks for moments at both ends. The moments of two triangles at a common edge cancel. At an edge of one triangle
!!    alone nothing would balance them, because nodal forces are those of a straight edge. So only edges between triangles are bowed
!!    (BOWED), and a patch of any mesh bears constant stress under nodal forces without moments. A lone triangle is one of constant
!!    strain.
!! 2. The higher-order stiffness is a hundred times smaller (HIGHER): the optimal one makes rows of triangles at a boundary, whose
!!    outer edges are straight, and curved shells too stiff.
!!
!! Quadrilateral: with the modes of Wilson and Taylor. A penalty ties the drilling rotation to the rotation of the membrane (T. J.
!! R. Hughes, F. Brezzi, On drilling degrees of freedom, Comput. Methods Appl. Mech. Engrg. 72 (1989) 105-121). The penalty is of
!! the size of the bending stiffness: a larger one would lock curved shells, a smaller one would make twisted shells too flexible.
module shell_membrane
   use elasticity, only: plane_stress
   use element_kinds, only: kind_quad4, kind_tria3, max_nodes
   use element_mapping, only: element_law, element_map, map_element, map_point
   use kinds, only: wp
   use laminate, only: ply_type
   use numbers, only: cross
   use shape_functions, only: shape_values
   implicit none
   private

   public :: corner_kind, drilling_stiffness, flat_coordinates, membrane_at, shell_frame_of, thickness_at

   !> Section and material of a shell element.
   type, public :: shell_law
      real(wp) :: d(3, 3) = 0.0_wp            !! plane stress of the membrane: xx, yy, xy; of a laminate A/t [pressure]
      real(wp) :: bending(3, 3) = 0.0_wp      !! the same for bending, times 12 I/T**3; of a laminate 12 D/t^3 [pressure]
      real(wp) :: coupling(3, 3) = 0.0_wp     !! between membrane and bending: B/t^2 [pressure]
      real(wp) :: shear(2) = 0.0_wp           !! G TS/T of transverse shear xz, yz; 0: rigid in transverse shear [pressure]
      real(wp) :: heat(3, 3) = 0.0_wp         !! columns: integrals of [Q] {alpha} (1, z/t, 12 z^2/t^2)/t [pressure/temperature]
      real(wp) :: thickness(4) = 0.0_wp       !! at the corners [length]
      real(wp) :: offset = 0.0_wp             !! of the mean plane from the nodes, along the normal (ZOFFS) [length]
      real(wp) :: along(3) = 0.0_wp           !! projected: direction x of the material; zero: isotropic
      logical  :: bowed(3) = .false.          !! of a triangle: its edge from corner i to the next lies between triangles
      type(ply_type), allocatable :: plies(:) !! of a laminate
   end type shell_law

   !> The geometry of a shell element.
   type, public :: shell_frame
      integer  :: n = 0                       !! number of corners
      real(wp) :: axes(3, 3) = 0.0_wp         !! columns: two directions in the plane, the normal, right-handed with the corners
      real(wp) :: x(2, 4) = 0.0_wp            !! corners in the plane [length]
      real(wp) :: lever(4) = 0.0_wp           !! height of the mean plane above the nodes, along the normal, with offset [length]
   end type shell_frame

   real(wp), parameter :: drilling = 1.0_wp ! penalty of the drilling rotation of a quadrilateral: this times G t^2/area, at most G

   real(wp), parameter :: lumping = 1.5_wp  ! alpha_b, of the bow of an edge in the mean strains of a triangle; 3/2 is optimal
   real(wp), parameter :: higher = 0.004_wp ! beta_0, of the higher-order stiffness; (1 - 4 nu^2)/2 is optimal

contains

   !> The frame of the corners of an element with nodes X and an OFFSET. The normal of a quadrilateral is perpendicular to both
   !! diagonals. The first direction is that of MATERIAL, if any.
   pure type(shell_frame) function shell_frame_of(x, offset, material) result(frame)
      real(wp), intent(in) :: x(:, :)         !! (3, nodes) [length]
      real(wp), intent(in) :: offset          !! [length]
      real(wp), intent(in), optional :: material(3)
      real(wp) :: from_centre(3), along(3), centre(3), normal(3)
      integer  :: i, n

      n = size(x, 2)
      if (n > 4) n = n/2                      ! a second-order element: that of its corners
      frame%n = n
      centre = sum(x(:, :n), dim=2)/n
      if (n == 4) then
         along = x(:, 2) + x(:, 3) - x(:, 1) - x(:, 4)
         normal = cross(x(:, 3) - x(:, 1), x(:, 4) - x(:, 2))
      else
         along = x(:, 2) - x(:, 1)
         normal = cross(along, x(:, 3) - x(:, 1))
      end if
      normal = normal/max(norm2(normal), tiny(1.0_wp))
      if (present(material)) then
         if (norm2(material) > 0.0_wp) along = material
      end if
      along = along - dot_product(along, normal)*normal
      along = along/max(norm2(along), tiny(1.0_wp))
      frame%axes(:, 1) = along
      frame%axes(:, 2) = cross(normal, along)
      frame%axes(:, 3) = normal
      do i = 1, n
         from_centre = x(:, i) - centre
         frame%x(:, i) = matmul(from_centre, frame%axes(:, :2))
         frame%lever(i) = offset
         if (n == 4) frame%lever(i) = offset - dot_product(from_centre, normal)
      end do
   end function shell_frame_of

   !> The nodes X of an element projected onto its mean plane, in its axes.
   pure function flat_coordinates(x) result(flat)
      real(wp), intent(in) :: x(:, :)         !! (3, nodes) [length]
      real(wp) :: flat(2, size(x, 2)), from_centre(3)
      type(shell_frame) :: frame
      integer :: i

      frame = shell_frame_of(x, 0.0_wp)
      do i = 1, size(x, 2)
         from_centre = x(:, i) - sum(x(:, :frame%n), dim=2)/frame%n
         flat(:, i) = matmul(from_centre, frame%axes(:, :2))
      end do
   end function flat_coordinates

   !> The linear kind of an element with N corners.
   pure integer function corner_kind(n)
      integer, intent(in) :: n

      corner_kind = merge(kind_quad4, kind_tria3, n == 4)
   end function corner_kind

   !> The thickness at a POINT, given in local coordinates, of an element with this number of CORNERS [length].
   pure real(wp) function thickness_at(law, corners, point) result(t)
      type(shell_law), intent(in) :: law
      integer, intent(in)         :: corners
      real(wp), intent(in)        :: point(3)
      real(wp) :: n(max_nodes)

      call shape_values(corner_kind(corners), point, n)
      t = dot_product(n(:corners), law%thickness(:corners))
   end function thickness_at

   !> Strains xx, yy, xy of the membrane at a POINT from u, v, theta_z of the corners and, of a quadrilateral, the four modes. TWIST
   !! is the difference between the drilling rotation and the rotation of the membrane. VOLUME is the volume per unit of weight.
   pure subroutine membrane_at(law, frame, point, b, twist, volume)
      type(shell_law), intent(in)   :: law
      type(shell_frame), intent(in) :: frame
      real(wp), intent(in)          :: point(3)
      real(wp), intent(out)         :: b(3, 16), twist(16), volume
      real(wp) :: at_corner(3, 9, 3), n(max_nodes), area
      integer  :: i

      if (frame%n == 4) then
         call mode_strains(frame, point, b, twist, volume)
         return
      end if
      b = 0.0_wp
      twist = 0.0_wp
      call membrane_strains(law, frame%x(:, :3), area, b(:, :9), at_corner)
      call shape_values(corner_kind(3), point, n)
      do i = 1, 3
         b(:, :9) = b(:, :9) + n(i)*at_corner(:, :, i)
      end do
      volume = 2.0_wp*area
   end subroutine membrane_at

   !> The penalty of the drilling rotation of an element of this AREA and thickness T.
   pure real(wp) function drilling_stiffness(law, t, area) result(g)
      type(shell_law), intent(in) :: law
      real(wp), intent(in)        :: t, area  !! [length], [length^2]

      g = law%d(3, 3)*min(1.0_wp, drilling*t**2/area)
   end function drilling_stiffness

   !> Strains xx, yy, xy at a POINT of a quadrilateral from u, v, theta_z of the corners and the four modes. TWIST is the difference
   !! between the drilling rotation and the rotation of the membrane.
   pure subroutine mode_strains(frame, point, b, twist, volume)
      type(shell_frame), intent(in) :: frame
      real(wp), intent(in)          :: point(3)
      real(wp), intent(out)         :: b(3, 16), twist(16), volume
      type(element_law) :: plane
      type(element_map) :: map
      real(wp) :: g(3, max_nodes), n(max_nodes)
      integer  :: i, c

      plane%kind = kind_quad4
      plane%state = plane_stress
      plane%incompatible = .true.
      call map_element(plane, frame%x, map)
      call map_point(plane, map, point, g, volume)
      call shape_values(kind_quad4, point, n)
      b = 0.0_wp
      twist = 0.0_wp
      do i = 1, 6
         c = merge(3*i - 2, 2*i + 3, i <= 4)
         b(:, c) = [g(1, i), 0.0_wp, g(2, i)]
         b(:, c + 1) = [0.0_wp, g(2, i), g(1, i)]
         twist(c:c + 1) = 0.5_wp*[g(2, i), -g(1, i)]
      end do
      twist(3:12:3) = n(:4)
   end subroutine mode_strains

   !> The strains xx, yy, xy of a membrane triangle from its nine values, u, v, theta_z of corner 1 first: the BASIC strains, which
   !! are constant, and the higher-order strains AT_CORNER i, whose mean is zero. Felippa 2003, Eqs. (11) to (32), with the
   !! parameters of OPT but for the two changes above.
   pure subroutine membrane_strains(law, x, area, basic, at_corner)
      type(shell_law), intent(in) :: law
      real(wp), intent(in)  :: x(2, 3)        !! [length]
      real(wp), intent(out) :: area           !! [length^2]
      real(wp), intent(out) :: basic(3, 9), at_corner(3, 9, 3) !! [1/length], of rotations [-]
      real(wp), parameter :: b(9) = [1.0_wp, 2.0_wp, 1.0_wp, 0.0_wp, 1.0_wp, -1.0_wp, -1.0_wp, -1.0_wp, -2.0_wp] ! beta 1 to 9
      real(wp) :: to_hierarchical(3, 9), natural(3, 3), a(3, 3), q(3, 3), squares(3), direction(2, 3), from(2, 3), to(2, 3)
      real(wp) :: bow(3)
      integer  :: i, j, k, row

      basic = 0.0_wp
      associate (xs => x(1, :), ys => x(2, :))
         area = 0.5_wp*((xs(2) - xs(1))*(ys(3) - ys(1)) - (xs(3) - xs(1))*(ys(2) - ys(1)))
         do i = 1, 3
            j = modulo(i, 3) + 1
            k = modulo(j, 3) + 1
            associate (y_jk => ys(j) - ys(k), x_kj => xs(k) - xs(j), x_ji => xs(j) - xs(i), y_ji => ys(j) - ys(i))
               basic(:, 3*i - 2) = 0.5_wp*[y_jk, 0.0_wp, x_kj]
               basic(:, 3*i - 1) = 0.5_wp*[0.0_wp, x_kj, y_jk]
               bow = merge(lumping/12.0_wp, 0.0_wp, law%bowed(i))*[y_ji**2, x_ji**2, -2.0_wp*x_ji*y_ji]
               basic(:, 3*i) = basic(:, 3*i) - bow
               basic(:, 3*j) = basic(:, 3*j) + bow
               do row = 1, 3
                  to_hierarchical(row, 3*i - 2:3*i - 1) = [x_kj, -y_jk]/(4.0_wp*area)
               end do
            end associate
            to_hierarchical(:, 3*i) = 0.0_wp
            to_hierarchical(i, 3*i) = 1.0_wp
            from(:, i) = x(:, i)              ! edge i goes from corner i to the next
            to(:, i) = x(:, j)
         end do
         basic = basic/area
      end associate
      ! xx, yy, xy from the strains along the edges: the inverse of e = c^2 xx + s^2 yy + c s xy, whose columns are cross products
      ! of rows
      squares = sum((to - from)**2, dim=1)
      direction = (to - from)/spread(sqrt(squares), 1, 2)
      a(:, 1) = direction(1, :)**2
      a(:, 2) = direction(2, :)**2
      a(:, 3) = direction(1, :)*direction(2, :)
      do i = 1, 3
         natural(:, i) = cross(a(modulo(i, 3) + 1, :), a(modulo(i + 1, 3) + 1, :))
      end do
      natural = natural/dot_product(a(1, :), natural(:, 1))
      do k = 1, 3
         select case (k)
         case (1); q = reshape(b([1, 4, 7, 2, 5, 8, 3, 6, 9]), [3, 3])
         case (2); q = reshape(b([9, 3, 6, 7, 1, 4, 8, 2, 5]), [3, 3])
         case (3); q = reshape(b([5, 8, 2, 6, 9, 3, 4, 7, 1]), [3, 3])
         end select
         q = 2.0_wp*area/3.0_wp*q/spread(squares, 2, 3)
         at_corner(:, :, k) = 1.5_wp*sqrt(higher)*matmul(natural, matmul(q, to_hierarchical))
      end do
   end subroutine membrane_strains

end module shell_membrane
