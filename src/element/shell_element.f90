!> Shell elements in space, three to eight nodes of six dofs: stiffness, thermal forces and masses of all kinds.
!! Flat elements with three or four corners have the membrane and the geometry of shell_membrane, bending and transverse shear of
!! shell_plate; curved elements with six or eight nodes are those of shell_curved. Each gives its strains at a point: membrane
!! strains xx, yy, xy, curvatures likewise, transverse shear strains xz, yz, in the axes of the element or of its material.
!!
!! Nodal values of an element are (3, 2 n): displacements of the n nodes, then their rotations [rad], in global axes; nodal forces
!! likewise, then moments. Amplitudes of modes inside the element follow them and are condensed.
module shell_element
   use element_kinds, only: kind_quad4, kind_tria6, max_nodes, node_point
   use kinds, only: wp
   use numbers, only: cross
   use quadrature, only: body_rule, integration_rule, mass_rule
   use shape_functions, only: shape_derivatives, shape_values
   use shell_curved, only: bubble, bubble_forces, curved_map, curved_strains, find_bubble, map_curved, most_columns, surface_kind, &
                           surface_normal, tangents
   use shell_membrane, only: corner_kind, drilling_stiffness, flat_coordinates, membrane_at, shell_frame, shell_frame_of, &
                             shell_law, thickness_at
   use shell_plate, only: plate_strains
   implicit none
   private

   public :: form, kind_of, map_of, node_normal, node_thickness, section_heat, section_stiffness, shell_bubble_load, &
             shell_bubble_mass, shell_products, shell_stiffness, shell_strains, shell_thermal_forces

   integer, parameter, public :: most_shell_nodes = 8

   real(wp), parameter :: softer = 1000.0_wp ! the drilling rotation of a curved element than that of a flat one
   real(wp), parameter :: stiff = 1.0e3_wp  ! shear modulus of a curved shell rigid in transverse shear, times its bending modulus

   !> An element of one kind, mapped.
   type, public :: shell_map
      integer  :: n = 0, corners = 0           !! nodes
      integer  :: columns = 0                  !! nodal values and amplitudes
      real(wp) :: from_nodes(24, 24) = 0.0_wp  !! flat: gives u, v, w and rotations of the corners in the axes of the element
      type(shell_frame) :: frame               !! flat
      type(curved_map), allocatable :: curved
      type(integration_rule) :: rule
   end type shell_map

   !> Strains of an element at a point, as shell_strains has them.
   type, public :: shell_point
      real(wp) :: b(8, most_columns) = 0.0_wp, twist(most_columns) = 0.0_wp
      real(wp) :: axes(3, 3) = 0.0_wp          !! their directions
      real(wp) :: volume = 0.0_wp              !! area per unit of weight
      real(wp) :: t = 0.0_wp, t_membrane = 0.0_wp !! thickness [length]; of the membrane of a flat element the mean
   end type shell_point

contains

   !> [k] of an element with nodes X.
   pure subroutine shell_stiffness(law, x, k)
      type(shell_law), intent(in) :: law
      real(wp), intent(in)        :: x(:, :)  !! (3, nodes) [length]
      real(wp), intent(inout)     :: k(:, :)  !! (6 nodes, 6 nodes), set here [force/length], [force], [force length]
      type(shell_map) :: map
      real(wp) :: f(most_columns), whole(most_columns, most_columns)
      integer  :: n

      map = map_of(law, x)
      call form(law, map, spread(0.0_wp, 1, map%n), 0.0_wp, whole, f)
      n = 6*map%n
      k(:n, :n) = whole(:n, :n)
   end subroutine shell_stiffness

   !> The map of an element with nodes X.
   pure type(shell_map) function map_of(law, x) result(map)
      type(shell_law), intent(in) :: law
      real(wp), intent(in)        :: x(:, :)  !! (3, nodes) [length]

      map%n = size(x, 2)
      map%corners = merge(map%n, map%n/2, map%n <= 4)
      if (map%n <= 4) then
         map%columns = merge(28, 18, map%n == 4)
         map%frame = shell_frame_of(x, law%offset, law%along)
         map%from_nodes(:6*map%n, :6*map%n) = from_nodes(map%frame)
         call body_rule(merge(kind_quad4, kind_tria6, map%n == 4), .false., map%rule)
      else
         map%columns = merge(54, 36, map%n == 8)
         allocate (map%curved)
         call map_curved(law, x, map%curved)
         call mass_rule(surface_kind(map%n), map%rule)
      end if
   end function map_of

   !> The strains of an element at a POINT.
   pure subroutine shell_strains(law, map, point, at)
      type(shell_law), intent(in)    :: law
      type(shell_map), intent(in)    :: map
      real(wp), intent(in)           :: point(3)
      type(shell_point), intent(out) :: at
      real(wp) :: curvature(3, 12), gamma(2, 12), local(8, 24), membrane(3, 16), twist(16)
      integer  :: c, m

      at%t = thickness_at(law, map%corners, point)
      if (allocated(map%curved)) then
         at%t_membrane = at%t
         call curved_strains(map%curved, point, at%b, at%twist, at%axes, at%volume)
         return
      end if
      m = 6*map%n
      at%t_membrane = sum(law%thickness(:map%n))/map%n
      at%axes = map%frame%axes
      call membrane_at(law, map%frame, point, membrane, twist, at%volume)
      call plate_strains(law, map%frame, point, curvature, gamma, at%volume)
      local = 0.0_wp
      do c = 1, map%n
         local(:3, 6*c - 5:6*c - 4) = membrane(:, 3*c - 2:3*c - 1)
         local(:3, 6*c) = membrane(:, 3*c)
         local(4:6, 6*c - 3:6*c - 1) = curvature(:, 3*c - 2:3*c)
         local(7:, 6*c - 3:6*c - 1) = gamma(:, 3*c - 2:3*c)
      end do
      at%b(:, :m) = matmul(local(:, :m), map%from_nodes(:m, :m))
      if (map%n == 3) return
      local(1, :) = 0.0_wp
      do c = 1, 4
         local(1, [6*c - 5, 6*c - 4, 6*c]) = twist(3*c - 2:3*c)
      end do
      at%twist(:m) = matmul(local(1, :m), map%from_nodes(:m, :m))
      at%b(:3, 25:28) = membrane(:, 13:16)
      at%twist(25:28) = twist(13:16)
   end subroutine shell_strains

   !> The matrix that gives forces and moments per length, N, M, Q, from the strains AT a point.
   pure function section_stiffness(law, map, at) result(c)
      type(shell_law), intent(in)   :: law
      type(shell_map), intent(in)   :: map
      type(shell_point), intent(in) :: at
      real(wp) :: c(8, 8), shear(2)
      integer  :: i

      c = 0.0_wp
      c(:3, :3) = at%t_membrane*law%d
      c(4:6, 4:6) = at%t**3/12.0_wp*law%bending
      c(:3, 4:6) = at%t**2*law%coupling
      c(4:6, :3) = c(:3, 4:6)
      shear = law%shear
      if (allocated(map%curved)) shear = merge(law%shear, stiff*law%bending(1, 1), law%shear > 0.0_wp)
      do i = 1, 2
         c(6 + i, 6 + i) = at%t*shear(i)
      end do
   end function section_stiffness

   !> Forces and moments per length N, M, Q of the restrained section AT a point under a RISE at the mean plane that grows by
   !! SLOPE.
   pure function section_heat(law, at, rise, slope) result(force)
      type(shell_law), intent(in)   :: law
      type(shell_point), intent(in) :: at
      real(wp), intent(in)          :: rise, slope
      real(wp) :: force(8)

      associate (t => at%t)
         force(:3) = at%t_membrane*law%heat(:, 1)*rise + t**2*law%heat(:, 2)*slope
         force(4:6) = t**2*law%heat(:, 2)*rise + t**3/12.0_wp*law%heat(:, 3)*slope
      end associate
      force(7:) = 0.0_wp
   end function section_heat

   !> [K] and the thermal forces F of an element with the amplitudes condensed; the rows of these keep what gives their values.
   pure subroutine form(law, map, rise, slope, k, f, load)
      type(shell_law), intent(in) :: law
      type(shell_map), intent(in) :: map
      real(wp), intent(in)        :: rise(:), slope  !! (nodes) [temperature], [temperature/length]
      real(wp), intent(out)       :: k(most_columns, most_columns), f(most_columns)
      real(wp), intent(in), optional :: load(:, :)   !! (3, nodes) [force/length^2] on the bubble, added to F
      type(shell_point) :: at(map%rule%n)
      real(wp) :: area, c(8, 8), g, n(max_nodes), cb(8, most_columns)
      integer  :: i, j, m, p

      m = map%columns
      k = 0.0_wp
      f = 0.0_wp
      do p = 1, map%rule%n
         call shell_strains(law, map, map%rule%point(:, p), at(p))
      end do
      area = sum(map%rule%weight(:map%rule%n)*at%volume)
      g = drilling_stiffness(law, sum(law%thickness(:map%corners))/map%corners, area)
      if (allocated(map%curved)) g = g/softer
      do p = 1, map%rule%n
         associate (b => at(p)%b(:, :m), w => map%rule%weight(p)*at(p)%volume, twist => at(p)%twist)
            c = section_stiffness(law, map, at(p))
            cb(:, :m) = w*matmul(c, b)
            k(:m, :m) = k(:m, :m) + matmul(transpose(b), cb(:, :m))
            if (map%n /= 3) then
               do i = 1, m
                  k(:m, i) = k(:m, i) + w*at(p)%t_membrane*g*twist(:m)*twist(i)
               end do
            end if
            if (all(abs(rise) <= 0.0_wp) .and. .not. abs(slope) > 0.0_wp) cycle
            call shape_values(kind_of(map%n), map%rule%point(:, p), n)
            f(:m) = f(:m) + w*matmul(section_heat(law, at(p), dot_product(n(:map%n), rise), slope), b)
         end associate
      end do
      if (present(load) .and. map%n == 8) f(49:51) = f(49:51) + bubble_forces(map%curved, load)
      do i = m, 6*map%n + 1, -1
         if (.not. k(i, i) > 0.0_wp) k(i, i) = 1.0_wp ! an amplitude of the membrane of a shell that bends alone is zero
         f(:i - 1) = f(:i - 1) - k(:i - 1, i)*f(i)/k(i, i)
         do j = 1, i - 1
            k(:i - 1, j) = k(:i - 1, j) - k(:i - 1, i)*k(i, j)/k(i, i)
         end do
      end do
   end subroutine form

   !> The kind of an element with N nodes.
   pure integer function kind_of(n)
      integer, intent(in) :: n

      kind_of = merge(corner_kind(n), surface_kind(n), n <= 4)
   end function kind_of

   !> The matrix that gives the values in the axes of the element, u, v, w and rotations of corner 1 first, from nodal values. At
   !! the mean plane the displacements are u + lever theta_y, v - lever theta_x.
   pure function from_nodes(frame) result(t)
      type(shell_frame), intent(in) :: frame
      real(wp) :: t(6*frame%n, 6*frame%n)
      integer  :: i

      t = 0.0_wp
      do i = 1, frame%n
         associate (u => 3*i - 2, r => 3*(frame%n + i) - 2, row => 6*i - 5)
            t(row:row + 2, u:u + 2) = transpose(frame%axes)
            t(row + 3:row + 5, r:r + 2) = transpose(frame%axes)
            t(row, r:r + 2) = frame%lever(i)*frame%axes(:, 2)
            t(row + 1, r:r + 2) = -frame%lever(i)*frame%axes(:, 1)
         end associate
      end do
   end function from_nodes

   !> Nodal forces and moments F of a thermal load: T - TREF is RISE at the nodes in the mean plane and grows by SLOPE per unit
   !! height.
   pure subroutine shell_thermal_forces(law, x, rise, slope, f)
      type(shell_law), intent(in) :: law
      real(wp), intent(in)        :: x(:, :)         !! (3, nodes) [length]
      real(wp), intent(in)        :: rise(:), slope  !! (nodes) [temperature], [temperature/length]
      real(wp), intent(inout)     :: f(:, :)         !! (3, 2 nodes) [force], [force length], set here
      type(shell_map) :: map
      real(wp) :: k(most_columns, most_columns), whole(most_columns)

      map = map_of(law, x)
      call form(law, map, rise, slope, k, whole)
      f(:, :2*map%n) = reshape(whole(:6*map%n), [3, 2*map%n])
   end subroutine shell_thermal_forces

   !> Nodal forces and moments F of the share of a LOAD that acts on the bubble of eight nodes.
   pure subroutine shell_bubble_load(law, x, load, f)
      type(shell_law), intent(in) :: law
      real(wp), intent(in)        :: x(:, :)         !! (3, nodes) [length]
      real(wp), intent(in)        :: load(:, :)      !! (3, nodes) [force/length^2]
      real(wp), intent(inout)     :: f(:, :)         !! (3, 2 nodes) [force], [force length], set here
      type(shell_map) :: map
      real(wp) :: k(most_columns, most_columns), whole(most_columns)

      map = map_of(law, x)
      call form(law, map, spread(0.0_wp, 1, map%n), 0.0_wp, k, whole, load)
      f(:, :2*map%n) = reshape(whole(:6*map%n), [3, 2*map%n])
   end subroutine shell_bubble_load

   !> The mass that the bubble of an element of eight nodes adds between its nodal values, P^T T + T^T P. T gives the amplitudes of
   !! the displacements of the bubble from the nodal values, where no force acts on any amplitude; those of the rotations of the bubble
   !! are without inertia. P = S + c T/2, S = integral of q N_i b along the axes of the bubble, c = integral of q b^2.
   pure subroutine shell_bubble_mass(law, x, q, p, t)
      type(shell_law), intent(in) :: law
      real(wp), intent(in)        :: x(:, :)         !! (3, 8) [length]
      real(wp), intent(in)        :: q(:)            !! (8) mass per area [force time^2/length^3]
      real(wp), intent(out)       :: p(3, 48), t(3, 48)
      type(shell_map) :: map
      real(wp) :: a(3, 2), all_amplitudes(6, 48), b, c, k(most_columns, most_columns), n(max_nodes), f(most_columns), s(8), w
      integer  :: i, j

      map = map_of(law, x)
      call form(law, map, spread(0.0_wp, 1, 8), 0.0_wp, k, f)
      do i = 1, 6                                   ! in the order in which form has left their rows
         all_amplitudes(i, :) = -k(48 + i, :48)
         do j = 1, i - 1
            all_amplitudes(i, :) = all_amplitudes(i, :) - k(48 + i, 48 + j)*all_amplitudes(j, :)
         end do
         all_amplitudes(i, :) = all_amplitudes(i, :)/k(48 + i, 48 + i)
      end do
      t = all_amplitudes(:3, :)
      s = 0.0_wp
      c = 0.0_wp
      do i = 1, map%rule%n
         associate (point => map%rule%point(:, i))
            call shape_values(kind_of(8), point, n)
            b = bubble(point)
            a = tangents(x, point)
            w = map%rule%weight(i)*norm2(cross(a(:, 1), a(:, 2)))*dot_product(q, n(:8))
         end associate
         s = s + w*b*(n(:8) + b*map%curved%weights)
         c = c + w*b**2
      end do
      p = 0.5_wp*c*t
      do i = 1, 8
         p(:, 3*i - 2:3*i) = p(:, 3*i - 2:3*i) + s(i)*transpose(map%curved%bubble_axes)
      end do
   end subroutine shell_bubble_mass

   !> The unit normal of an element at its node I.
   pure function node_normal(x, i) result(normal)
      real(wp), intent(in) :: x(:, :)                !! (3, nodes) [length]
      integer, intent(in)  :: i
      real(wp) :: normal(3)
      type(shell_frame) :: frame

      if (size(x, 2) > 4) then
         normal = surface_normal(x, i)
      else
         frame = shell_frame_of(x, 0.0_wp)
         normal = frame%axes(:, 3)
      end if
   end function node_normal

   !> The thickness at the N nodes of an element [length].
   pure function node_thickness(law, n) result(t)
      type(shell_law), intent(in) :: law
      integer, intent(in)         :: n
      real(wp) :: t(n)
      integer  :: i

      t = [(thickness_at(law, merge(n, n/2, n <= 4), node_point(:, i, kind_of(n))), i = 1, n)]
   end function node_thickness

   !> M = integral of q N_i N_j over an element; the shape functions interpolate q between its VALUES at the corners.
   pure subroutine shell_products(x, values, m)
      real(wp), intent(in)    :: x(:, :)             !! (3, nodes) [length]
      real(wp), intent(in)    :: values(:)           !! (nodes) [per area]
      real(wp), intent(inout) :: m(:, :)             !! (nodes, nodes), set here
      type(integration_rule) :: rule
      real(wp) :: a(3, 2), axes(3, 3), dn(3, max_nodes), n(max_nodes), j(2, 2), q, volume, weights(8)
      integer  :: i, p, s

      s = size(x, 2)
      m(:s, :s) = 0.0_wp
      if (s == 8) call find_bubble(x, weights, axes)
      call mass_rule(kind_of(s), rule)
      do p = 1, rule%n
         call shape_values(kind_of(s), rule%point(:, p), n)
         q = dot_product(n(:s), values)
         if (s <= 4) then
            call shape_derivatives(kind_of(s), rule%point(:, p), dn)
            j = matmul(dn(:2, :s), transpose(flat_coordinates(x)))
            volume = j(1, 1)*j(2, 2) - j(1, 2)*j(2, 1)
         else
            if (s == 8) n(:8) = n(:8) + bubble(rule%point(:, p))*weights
            a = tangents(x, rule%point(:, p))
            volume = norm2(cross(a(:, 1), a(:, 2)))
         end if
         do i = 1, s
            m(:s, i) = m(:s, i) + rule%weight(p)*volume*q*n(:s)*n(i)
         end do
      end do
   end subroutine shell_products

end module shell_element
