!> Shells in space, triangles and quadrilaterals of three displacements and three rotations a corner. An element is flat: its corners
!! are projected onto its mean plane, and what a corner has from there is a rigid lever, as is an offset of the plate (ZOFFS).
!!
!! Membrane: the optimal triangle with drilling rotations (C. A. Felippa, A study of optimal membrane triangles with drilling
!! freedoms, Comput. Methods Appl. Mech. Engrg. 192 (2003) 2125-2168); a quadrilateral is half the sum of its four triangles. The
!! drilling rotation is that of the membrane, so that it needs no stiffness of its own.
!! Bending and transverse shear: the discrete Kirchhoff-Mindlin triangle and quadrilateral (I. Katili, A new discrete Kirchhoff-Mindlin
!! element based on Mindlin-Reissner plate theory and assumed shear strain fields, Parts I and II, Int. J. Numer. Meth. Engng 36
!! (1993) 1859-1908). The rotation of a fibre, {beta} = (theta_y, -theta_x), is linear between the corners, and quadratic along an
!! edge, where its amplitude follows from the equilibrium of a beam along the edge.
!!
!! Nodal values of an element are (3, 2 n): displacements of the n corners, then their rotations [rad], in global axes; forces
!! likewise, then moments.
module shell_element
   use elasticity, only: plane_stress
   use element_kinds, only: centre_point, kind_quad4, kind_quad8, kind_tria3, kind_tria6, max_nodes, node_point
   use element_mapping, only: element_law, element_map, map_element, map_point
   use kinds, only: wp
   use numbers, only: cross
   use quadrature, only: body_rule, integration_rule, mass_rule
   use shape_functions, only: shape_derivatives, shape_values
   implicit none
   private

   public :: flat_coordinates, shell_frame_of, shell_products, shell_stiffness, shell_stresses, shell_thermal_forces

   !> What a shell element is made of.
   type, public :: shell_law
      real(wp) :: d(3, 3) = 0.0_wp            !! plane stress of the membrane: xx, yy, xy [pressure]
      real(wp) :: bending(3, 3) = 0.0_wp      !! that of bending, times 12 I/T**3 [pressure]
      real(wp) :: shear = 0.0_wp              !! G TS/T of transverse shear; 0: rigid in it [pressure]
      real(wp) :: nu = 0.0_wp                 !! Poisson's ratio of the membrane [-]
      real(wp) :: thickness(4) = 0.0_wp       !! at the corners [length]
      real(wp) :: offset = 0.0_wp             !! of the mean plane from the nodes, along the normal (ZOFFS) [length]
      real(wp) :: expansion = 0.0_wp          !! alpha [1/temperature]
   end type shell_law

   !> Where an element lies.
   type, public :: shell_frame
      integer  :: n = 0                       !! corners
      real(wp) :: axes(3, 3) = 0.0_wp         !! columns: two directions in the plane, the normal, right-handed with the corners
      real(wp) :: x(2, 4) = 0.0_wp            !! corners in the plane [length]
      real(wp) :: lever(4) = 0.0_wp           !! of the plane above the nodes, along the normal, with the offset [length]
   end type shell_frame

   real(wp), parameter :: drilling = 1.0_wp ! stiffness that ties the drilling rotation of a quadrilateral, by G t^2/area, at most G

   !> What the strains at the points of integration of a quadrilateral are at its corners: the point at corner i counts TO_CORNERS(i, j) at j.
   real(wp), parameter :: near = 1.0_wp + 0.5_wp*sqrt(3.0_wp), far = 1.0_wp - 0.5_wp*sqrt(3.0_wp)
   real(wp), parameter :: to_corners(4, 4) = reshape([near, -0.5_wp, far, -0.5_wp, -0.5_wp, near, -0.5_wp, far, &
                                                      far, -0.5_wp, near, -0.5_wp, -0.5_wp, far, -0.5_wp, near], [4, 4])

contains

   !> The frame of an element with corners X and an OFFSET. The normal is that of the diagonals, of a triangle that of its plane.
   pure type(shell_frame) function shell_frame_of(x, offset) result(frame)
      real(wp), intent(in) :: x(:, :)         !! (3, corners) [length]
      real(wp), intent(in) :: offset          !! [length]
      real(wp) :: from_centre(3), along(3), centre(3), normal(3)
      integer  :: i, n

      n = size(x, 2)
      frame%n = n
      centre = sum(x, dim=2)/n
      if (n == 4) then
         along = x(:, 2) + x(:, 3) - x(:, 1) - x(:, 4)
         normal = cross(x(:, 3) - x(:, 1), x(:, 4) - x(:, 2))
      else
         along = x(:, 2) - x(:, 1)
         normal = cross(along, x(:, 3) - x(:, 1))
      end if
      normal = normal/max(norm2(normal), tiny(1.0_wp))
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

   !> The corners X of an element in its plane.
   pure function flat_coordinates(x) result(flat)
      real(wp), intent(in) :: x(:, :)         !! (3, corners) [length]
      real(wp) :: flat(2, size(x, 2))
      type(shell_frame) :: frame

      frame = shell_frame_of(x, 0.0_wp)
      flat = frame%x(:, :size(x, 2))
   end function flat_coordinates

   !> [k] of an element with corners X.
   pure subroutine shell_stiffness(law, x, k)
      type(shell_law), intent(in) :: law
      real(wp), intent(in)        :: x(:, :)  !! (3, corners) [length]
      real(wp), intent(inout)     :: k(:, :)  !! (6 corners, 6 corners), set here [force/length], [force], [force length]
      type(shell_frame) :: frame
      real(wp) :: own(24, 24)
      integer  :: i

      frame = shell_frame_of(x, law%offset)
      own = 0.0_wp
      if (frame%n == 3) call add_triangle(law, frame, own)
      if (frame%n == 4) call add_quadrilateral(law, frame, own)
      call add_plate(law, frame, own)
      do i = 1, frame%n                       ! levers: u + lever theta_y, v - lever theta_x are those of the plane
         own(:, 6*i - 1) = own(:, 6*i - 1) + frame%lever(i)*own(:, 6*i - 5)
         own(:, 6*i - 2) = own(:, 6*i - 2) - frame%lever(i)*own(:, 6*i - 4)
      end do
      do i = 1, frame%n
         own(6*i - 1, :) = own(6*i - 1, :) + frame%lever(i)*own(6*i - 5, :)
         own(6*i - 2, :) = own(6*i - 2, :) - frame%lever(i)*own(6*i - 4, :)
      end do
      call to_global(frame, own, k)
   end subroutine shell_stiffness

   !> K from OWN, which has u, v, w and the rotations of corner 1 first, in the axes of the element.
   pure subroutine to_global(frame, own, k)
      type(shell_frame), intent(in) :: frame
      real(wp), intent(in)          :: own(24, 24)
      real(wp), intent(inout)       :: k(:, :)
      integer :: a, b, i, j, n

      n = frame%n
      do b = 0, 1
         do j = 1, n
            do a = 0, 1
               do i = 1, n
                  k(3*(n*a + i) - 2:3*(n*a + i), 3*(n*b + j) - 2:3*(n*b + j)) = matmul(frame%axes, matmul( &
                     own(6*i - 5 + 3*a:6*i - 3 + 3*a, 6*j - 5 + 3*b:6*j - 3 + 3*b), transpose(frame%axes)))
               end do
            end do
         end do
      end do
   end subroutine to_global

   !> Add the membrane of a triangle to OWN.
   pure subroutine add_triangle(law, frame, own)
      type(shell_law), intent(in)   :: law
      type(shell_frame), intent(in) :: frame
      real(wp), intent(inout)       :: own(24, 24)
      real(wp) :: at_corner(3, 9, 3), basic(3, 9), d(3, 3), e(3, 9), k(9, 9), area
      integer  :: a

      call membrane_strains(law%nu, frame%x(:, :3), area, basic, at_corner)
      d = area*sum(law%thickness(:3))/3.0_wp*law%d
      k = matmul(transpose(basic), matmul(d, basic))
      do a = 1, 3                             ! at the middle of the edges, each of which stands for a third
         e = 0.5_wp*(at_corner(:, :, a) + at_corner(:, :, modulo(a, 3) + 1))
         k = k + matmul(transpose(e), matmul(d, e))/3.0_wp
      end do
      own([1, 2, 6, 7, 8, 12, 13, 14, 18], [1, 2, 6, 7, 8, 12, 13, 14, 18]) = k
   end subroutine add_triangle

   !> Add the membrane of a quadrilateral to OWN.
   pure subroutine add_quadrilateral(law, frame, own)
      type(shell_law), intent(in)   :: law
      type(shell_frame), intent(in) :: frame
      real(wp), intent(inout)       :: own(24, 24)
      real(wp) :: k(16, 16), f(16)
      integer  :: at(12), b

      call mode_stiffness(law, frame, k)
      f = 0.0_wp
      call condense(k, f)
      at = [(6*b - 5, 6*b - 4, 6*b, b = 1, 4)]
      do b = 1, 12
         own(at, at(b)) = k(:12, b)
      end do
   end subroutine add_quadrilateral

   !> Eliminate the modes from [K] and the forces F: what is left of the first twelve; of the others enough to find them from these.
   pure subroutine condense(k, f)
      real(wp), intent(inout) :: k(16, 16), f(16)
      integer :: i, j

      do i = 16, 13, -1
         f(:i - 1) = f(:i - 1) - k(:i - 1, i)*f(i)/k(i, i)
         do j = 1, i - 1
            k(:i - 1, j) = k(:i - 1, j) - k(:i - 1, i)*k(i, j)/k(i, i)
         end do
      end do
   end subroutine condense

   !> [k] between u, v, theta_z of the corners and the parameters of the four modes, with the mean thickness, under which the modes have no
   !! part in constant strain.
   pure subroutine mode_stiffness(law, frame, k)
      type(shell_law), intent(in)   :: law
      type(shell_frame), intent(in) :: frame
      real(wp), intent(out)         :: k(16, 16)
      type(integration_rule) :: rule
      real(wp) :: b(3, 16), r(16), g, t, volume
      integer  :: i, p

      k = 0.0_wp
      t = sum(law%thickness)/4.0_wp
      associate (x => frame%x)
         g = 0.5_wp*((x(1, 3) - x(1, 1))*(x(2, 4) - x(2, 2)) - (x(1, 4) - x(1, 2))*(x(2, 3) - x(2, 1))) ! area
         g = law%d(3, 3)*min(1.0_wp, drilling*t**2/g)
      end associate
      call body_rule(kind_quad4, .false., rule)
      do p = 1, rule%n
         call mode_strains(frame, rule%point(:, p), b, r, volume)
         do i = 1, 16
            k(:, i) = k(:, i) + rule%weight(p)*volume*t*(matmul(matmul(law%d, b(:, i)), b) + g*r*r(i))
         end do
      end do
   end subroutine mode_stiffness

   !> Strains xx, yy, xy at a POINT of a quadrilateral from u, v, theta_z of the corners and the four modes; and how far the drilling
   !! rotation is from the rotation of the membrane, TWIST.
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

   pure real(wp) function thickness_at(law, frame, point) result(t)
      type(shell_law), intent(in)   :: law
      type(shell_frame), intent(in) :: frame
      real(wp), intent(in)          :: point(3)
      real(wp) :: n(max_nodes)

      call shape_values(corner_kind(frame%n), point, n)
      t = dot_product(n(:frame%n), law%thickness(:frame%n))
   end function thickness_at

   !> The strains xx, yy, xy of a membrane triangle from its nine values, u, v, theta_z of corner 1 first: the BASIC ones, which are
   !! constant, and what comes on top AT_CORNER i, which has no mean. Felippa 2003, Eqs. (11) to (32), with the parameters of OPT.
   pure subroutine membrane_strains(nu, x, area, basic, at_corner)
      real(wp), intent(in)  :: nu             !! [-]
      real(wp), intent(in)  :: x(2, 3)        !! [length]
      real(wp), intent(out) :: area           !! [length^2]
      real(wp), intent(out) :: basic(3, 9), at_corner(3, 9, 3) !! [1/length], of rotations [-]
      real(wp), parameter :: b(9) = [1.0_wp, 2.0_wp, 1.0_wp, 0.0_wp, 1.0_wp, -1.0_wp, -1.0_wp, -1.0_wp, -2.0_wp] ! beta 1 to 9
      real(wp) :: to_hierarchical(3, 9), natural(3, 3), q(3, 3), squares(3), from(2, 3), to(2, 3)
      integer  :: i, j, k, row

      associate (xs => x(1, :), ys => x(2, :))
         area = 0.5_wp*((xs(2) - xs(1))*(ys(3) - ys(1)) - (xs(3) - xs(1))*(ys(2) - ys(1)))
         do i = 1, 3
            j = modulo(i, 3) + 1
            k = modulo(j, 3) + 1
            associate (y_jk => ys(j) - ys(k), x_kj => xs(k) - xs(j), x_ik => xs(i) - xs(k), x_ji => xs(j) - xs(i), &
                       y_ik => ys(i) - ys(k), y_ji => ys(j) - ys(i))
               basic(:, 3*i - 2) = 0.5_wp*[y_jk, 0.0_wp, x_kj]
               basic(:, 3*i - 1) = 0.5_wp*[0.0_wp, x_kj, y_jk]
               basic(:, 3*i) = 0.125_wp*[y_jk*(y_ik - y_ji), x_kj*(x_ji - x_ik), &
                                         2.0_wp*(x_ji*y_ji - x_ik*y_ik)]
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
      squares = sum((to - from)**2, dim=1)
      natural = natural_to_cartesian((to - from)/spread(sqrt(squares), 1, 2))
      do k = 1, 3
         select case (k)
         case (1); q = reshape(b([1, 4, 7, 2, 5, 8, 3, 6, 9]), [3, 3])
         case (2); q = reshape(b([9, 3, 6, 7, 1, 4, 8, 2, 5]), [3, 3])
         case (3); q = reshape(b([5, 8, 2, 6, 9, 3, 4, 7, 1]), [3, 3])
         end select
         q = 2.0_wp*area/3.0_wp*q/spread(squares, 2, 3)
         at_corner(:, :, k) = 1.5_wp*sqrt(max(0.5_wp*(1.0_wp - 4.0_wp*nu**2), 0.01_wp))* &
                              matmul(natural, matmul(q, to_hierarchical))
      end do
   end subroutine membrane_strains

   !> The matrix by which the strains along three DIRECTIONS become xx, yy, xy: the inverse of e = c^2 xx + s^2 yy + c s xy.
   pure function natural_to_cartesian(direction) result(t)
      real(wp), intent(in) :: direction(2, 3) !! unit
      real(wp) :: t(3, 3), a(3, 3)
      integer  :: i, j, k

      a(:, 1) = direction(1, :)**2
      a(:, 2) = direction(2, :)**2
      a(:, 3) = direction(1, :)*direction(2, :)
      do i = 1, 3                             ! columns of the inverse are cross products of rows
         j = modulo(i, 3) + 1
         k = modulo(j, 3) + 1
         t(:, i) = cross(a(j, :), a(k, :))
      end do
      t = t/dot_product(a(1, :), t(:, 1))
   end function natural_to_cartesian

   !> Add bending and transverse shear to OWN.
   pure subroutine add_plate(law, frame, own)
      type(shell_law), intent(in)   :: law
      type(shell_frame), intent(in) :: frame
      real(wp), intent(inout)       :: own(24, 24)
      type(integration_rule) :: rule
      real(wp) :: curvature(3, 12), gamma(2, 12), k(12, 12), t, volume
      integer  :: a, b, at(12), m, p

      m = frame%n
      k = 0.0_wp
      call body_rule(merge(kind_quad4, kind_tria6, m == 4), .false., rule)
      do p = 1, rule%n
         call plate_strains(law, frame, rule%point(:, p), curvature, gamma, volume)
         t = thickness_at(law, frame, rule%point(:, p))
         k(:3*m, :3*m) = k(:3*m, :3*m) + rule%weight(p)*volume*( &
            t**3/12.0_wp*matmul(transpose(curvature(:, :3*m)), matmul(law%bending, curvature(:, :3*m))) + &
            t*law%shear*matmul(transpose(gamma(:, :3*m)), gamma(:, :3*m)))
      end do
      at(:3*m) = [([6*a - 3, 6*a - 2, 6*a - 1], a = 1, m)]
      do b = 1, 3*m
         own(at(:3*m), at(b)) = own(at(:3*m), at(b)) + k(:3*m, b)
      end do
   end subroutine add_plate

   pure integer function corner_kind(n)
      integer, intent(in) :: n

      corner_kind = merge(kind_quad4, kind_tria3, n == 4)
   end function corner_kind

   !> Curvatures xx, yy, xy and transverse shear strains xz, yz at a POINT from w, theta_x, theta_y of corner 1 first. VOLUME: what
   !! a unit of weight stands for.
   pure subroutine plate_strains(law, frame, point, curvature, gamma, volume)
      type(shell_law), intent(in)   :: law
      type(shell_frame), intent(in) :: frame
      real(wp), intent(in)          :: point(3) !! local coordinates
      real(wp), intent(out)         :: curvature(3, 12), gamma(2, 12), volume
      real(wp) :: dn(3, max_nodes), n(max_nodes), g(2, 8), edge(12, 4), edge_shear(4), axis(2, 4)
      real(wp), dimension(2, 2) :: across, inverse, j
      integer  :: a, b, i, m

      m = frame%n
      call find_edges(law, frame, edge, edge_shear, axis)
      call shape_derivatives(corner_kind(m), point, dn)
      j = matmul(dn(:2, :m), transpose(frame%x(:, :m)))
      volume = j(1, 1)*j(2, 2) - j(1, 2)*j(2, 1)
      inverse = reshape([j(2, 2), -j(2, 1), -j(1, 2), j(1, 1)], [2, 2])/volume
      g(:, :m) = matmul(inverse, dn(:2, :m))
      call shape_derivatives(merge(kind_quad8, kind_tria6, m == 4), point, dn)
      g(:, m + 1:2*m) = matmul(inverse, dn(:2, m + 1:2*m))
      curvature = 0.0_wp
      gamma = 0.0_wp
      do i = 1, m                             ! beta_x = theta_y, beta_y = -theta_x
         curvature(:, 3*i) = [g(1, i), 0.0_wp, g(2, i)]
         curvature(:, 3*i - 1) = -[0.0_wp, g(2, i), g(1, i)]
      end do
      do i = 1, m
         associate (c => axis(1, i), s => axis(2, i), slope => g(:, m + i))
            do a = 1, 3*m
               curvature(:, a) = curvature(:, a) + [c*slope(1), s*slope(2), c*slope(2) + s*slope(1)]*edge(a, i)
            end do
         end associate
      end do
      if (law%shear <= 0.0_wp) return
      call shape_values(corner_kind(m), point, n)
      do i = 1, m                             ! at a corner from its two edges, between them as the shape functions
         b = modulo(i - 2, m) + 1
         associate (det => axis(1, i)*axis(2, b) - axis(2, i)*axis(1, b))
            across = reshape([axis(2, b), -axis(1, b), -axis(2, i), axis(1, i)], [2, 2])/det
         end associate
         do a = 1, 3*m
            gamma(:, a) = gamma(:, a) + n(i)*matmul(across, [edge_shear(i)*edge(a, i), edge_shear(b)*edge(a, b)])
         end do
      end do
   end subroutine plate_strains

   !> Of every edge, from corner i to the next: the amplitude of its quadratic rotation, EDGE times w, theta_x, theta_y of the corners;
   !! its shear strain by that amplitude; its direction AXIS. Along an edge of length L, with phi = 12 D/(G_s L^2):
   !! amplitude = -3/2/(1 + phi) ((w_j - w_i)/L + (beta_i + beta_j)/2), shear strain = -2/3 phi amplitude.
   pure subroutine find_edges(law, frame, edge, edge_shear, axis)
      type(shell_law), intent(in)   :: law
      type(shell_frame), intent(in) :: frame
      real(wp), intent(out)         :: edge(12, 4), edge_shear(4), axis(2, 4)
      real(wp) :: amplitude, length, phi, t
      integer  :: i, j, k

      edge = 0.0_wp
      do i = 1, frame%n
         j = modulo(i, frame%n) + 1
         axis(:, i) = frame%x(:, j) - frame%x(:, i)
         length = norm2(axis(:, i))
         axis(:, i) = axis(:, i)/length
         t = 0.5_wp*(law%thickness(i) + law%thickness(j))
         phi = 0.0_wp
         if (law%shear > 0.0_wp) phi = law%bending(1, 1)*(t/length)**2/law%shear
         amplitude = -1.5_wp/(1.0_wp + phi)
         edge_shear(i) = -2.0_wp/3.0_wp*phi
         edge(3*i - 2, i) = -amplitude/length
         edge(3*j - 2, i) = amplitude/length
         do k = i, j, j - i
            edge(3*k, i) = 0.5_wp*amplitude*axis(1, i)
            edge(3*k - 1, i) = -0.5_wp*amplitude*axis(2, i)
         end do
      end do
   end subroutine find_edges

   !> Stresses (xx, yy, zz, xy, yz, zx) in global axes at the heights Z above the mean plane, at the corners and then at the centre,
   !! under the nodal values U, what is warmer than its reference temperature by RISE, and by SLOPE more a unit of height.
   pure subroutine shell_stresses(law, x, u, rise, slope, z, stress)
      type(shell_law), intent(in) :: law
      real(wp), intent(in)        :: x(:, :)         !! (3, corners) [length]
      real(wp), intent(in)        :: u(:, :)         !! (3, 2 corners) [length], [rad]
      real(wp), intent(in)        :: rise(:), slope  !! (corners) [temperature], [temperature/length]
      real(wp), intent(in)        :: z(:)            !! [length]
      real(wp), intent(out)       :: stress(:, :, :) !! (6, corners + 1, heights) [pressure]
      type(shell_frame) :: frame
      real(wp) :: membrane(3, 5), curvature(3, 5), gamma(2, 12), b(3, 12), plate(12), own(6, 4), s(3), full(3, 3), warm(5), volume
      integer  :: i, k, m

      frame = shell_frame_of(x, law%offset)
      m = frame%n
      do i = 1, m
         own(:3, i) = matmul(u(:, i), frame%axes)
         own(4:, i) = matmul(u(:, m + i), frame%axes)
         plate(3*i - 2:3*i) = own(3:5, i)
         own(1, i) = own(1, i) + frame%lever(i)*own(5, i)
         own(2, i) = own(2, i) - frame%lever(i)*own(4, i)
      end do
      call find_membrane(law, frame, rise, own, membrane)
      do i = 1, m + 1
         if (i <= m) call plate_strains(law, frame, node_point(:, i, corner_kind(m)), b, gamma, volume)
         if (i > m) call plate_strains(law, frame, centre_point(:, corner_kind(m)), b, gamma, volume)
         curvature(:, i) = matmul(b(:, :3*m), plate(:3*m))
      end do
      warm(:m) = rise
      warm(m + 1) = sum(rise)/m
      do k = 1, size(z)
         do i = 1, m + 1
            s = matmul(law%d, membrane(:, i) - law%expansion*warm(i)*[1.0_wp, 1.0_wp, 0.0_wp]) + &
                z(k)*matmul(law%bending, curvature(:, i) - law%expansion*slope*[1.0_wp, 1.0_wp, 0.0_wp])
            full = matmul(frame%axes(:, :2), matmul(reshape([s(1), s(3), s(3), s(2)], [2, 2]), transpose(frame%axes(:, :2))))
            stress(:, i, k) = [full(1, 1), full(2, 2), full(3, 3), full(1, 2), full(2, 3), full(3, 1)]
         end do
      end do
   end subroutine shell_stresses

   !> Strains of the mean plane at the corners and at the centre from OWN, of every corner u, v, w and rotations in the axes of the
   !! element. The modes of a quadrilateral bear no force but that of warmth.
   pure subroutine find_membrane(law, frame, rise, own, strain)
      type(shell_law), intent(in)   :: law
      type(shell_frame), intent(in) :: frame
      real(wp), intent(in)          :: rise(:)   !! (corners) [temperature]
      real(wp), intent(in)          :: own(6, 4)
      real(wp), intent(out)         :: strain(3, 5)
      real(wp) :: at_corner(3, 9, 3), b(3, 16), basic(3, 9), f(16), k(16, 16), q(16), r(16), area, volume
      integer  :: i

      if (frame%n == 3) then
         q(:9) = pack(own([1, 2, 6], :3), .true.)
         call membrane_strains(law%nu, frame%x(:, :3), area, basic, at_corner)
         strain(:, 4) = matmul(basic, q(:9))
         do i = 1, 3
            strain(:, i) = strain(:, 4) + matmul(at_corner(:, :, i), q(:9))
         end do
         return
      end if
      q(:12) = pack(own([1, 2, 6], :), .true.)
      call mode_stiffness(law, frame, k)
      call warm_modes(law, frame, rise, f)
      call condense(k, f)
      do i = 13, 16
         q(i) = (f(i) - dot_product(k(:i - 1, i), q(:i - 1)))/k(i, i)
      end do
      do i = 1, 5
         if (i <= 4) call mode_strains(frame, node_point(:, i, kind_quad4)/sqrt(3.0_wp), b, r, volume)
         if (i == 5) call mode_strains(frame, centre_point(:, kind_quad4), b, r, volume)
         strain(:, i) = matmul(b, q)
      end do
      ! from the points of integration to the corners, bilinear
      strain(:, :4) = matmul(strain(:, :4), to_corners)
   end subroutine find_membrane

   !> Forces and moments F by which a warm element pushes its corners: RISE above its reference temperature at the corners, by SLOPE
   !! more a unit of height.
   pure subroutine shell_thermal_forces(law, x, rise, slope, f)
      type(shell_law), intent(in) :: law
      real(wp), intent(in)        :: x(:, :)         !! (3, corners) [length]
      real(wp), intent(in)        :: rise(:), slope  !! (corners) [temperature], [temperature/length]
      real(wp), intent(inout)     :: f(:, :)         !! (3, 2 corners) [force], [force length], set here
      type(shell_frame) :: frame
      type(integration_rule) :: rule
      real(wp) :: at_corner(3, 9, 3), basic(3, 9), b(3, 12), gamma(2, 12), own(6, 4), q(12), k(16, 16), f_modes(16), area, t, volume
      integer  :: a, m, p

      frame = shell_frame_of(x, law%offset)
      m = frame%n
      own = 0.0_wp
      if (m == 3) then
         call membrane_strains(law%nu, frame%x(:, :3), area, basic, at_corner)
         q(:9) = area*sum(law%thickness(:3))*sum(rise)/9.0_wp*law%expansion*matmul(transpose(basic), law%d(:, 1) + law%d(:, 2))
      else
         call warm_modes(law, frame, rise, f_modes)
         call mode_stiffness(law, frame, k)
         call condense(k, f_modes)
         q = f_modes(:12)
      end if
      own([1, 2, 6], :m) = reshape(q(:3*m), [3, m])
      if (abs(slope) > 0.0_wp) then
         call body_rule(merge(kind_quad4, kind_tria6, m == 4), .false., rule)
         do p = 1, rule%n
            call plate_strains(law, frame, rule%point(:, p), b, gamma, volume)
            t = thickness_at(law, frame, rule%point(:, p))
            own(3:5, :m) = own(3:5, :m) + reshape(rule%weight(p)*volume*t**3/12.0_wp*law%expansion*slope* &
                           matmul(transpose(b(:, :3*m)), law%bending(:, 1) + law%bending(:, 2)), [3, m])
         end do
      end if
      do a = 1, m
         own(5, a) = own(5, a) + frame%lever(a)*own(1, a)
         own(4, a) = own(4, a) - frame%lever(a)*own(2, a)
         f(:, a) = matmul(frame%axes, own(:3, a))
         f(:, m + a) = matmul(frame%axes, own(4:, a))
      end do
   end subroutine shell_thermal_forces

   !> The forces F of a warm membrane on u, v, theta_z of the corners of a quadrilateral and on its modes.
   pure subroutine warm_modes(law, frame, rise, f)
      type(shell_law), intent(in)   :: law
      type(shell_frame), intent(in) :: frame
      real(wp), intent(in)          :: rise(:) !! (4)
      real(wp), intent(out)         :: f(16)
      type(integration_rule) :: rule
      real(wp) :: b(3, 16), n(max_nodes), r(16), volume
      integer  :: p

      f = 0.0_wp
      call body_rule(kind_quad4, .false., rule)
      do p = 1, rule%n
         call mode_strains(frame, rule%point(:, p), b, r, volume)
         call shape_values(kind_quad4, rule%point(:, p), n)
         f = f + rule%weight(p)*volume*sum(law%thickness)/4.0_wp*dot_product(n(:4), rise)*law%expansion* &
             matmul(law%d(:, 1) + law%d(:, 2), b)
      end do
   end subroutine warm_modes

   !> M = integral of q N_i N_j over an element, q between its VALUES at the corners as the shape functions.
   pure subroutine shell_products(x, values, m)
      real(wp), intent(in)    :: x(:, :)             !! (3, corners) [length]
      real(wp), intent(in)    :: values(:)           !! (corners) [per area]
      real(wp), intent(inout) :: m(:, :)             !! (corners, corners), set here
      type(integration_rule) :: rule
      real(wp) :: dn(3, max_nodes), n(max_nodes), flat(2, size(x, 2)), j(2, 2)
      integer  :: i, p, s

      s = size(x, 2)
      flat = flat_coordinates(x)
      m(:s, :s) = 0.0_wp
      call mass_rule(corner_kind(s), rule)
      do p = 1, rule%n
         call shape_derivatives(corner_kind(s), rule%point(:, p), dn)
         call shape_values(corner_kind(s), rule%point(:, p), n)
         j = matmul(dn(:2, :s), transpose(flat))
         do i = 1, s
            m(:s, i) = m(:s, i) + rule%weight(p)*(j(1, 1)*j(2, 2) - j(1, 2)*j(2, 1))*dot_product(n(:s), values)*n(:s)*n(i)
         end do
      end do
   end subroutine shell_products

end module shell_element
