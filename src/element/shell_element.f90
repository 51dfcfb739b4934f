!> Flat shell elements in space with three or four corners of six dofs: membrane, bending and transverse shear.
!! The membrane and the geometry are those of shell_membrane.
!!
!! Bending and transverse shear: the discrete Kirchhoff-Mindlin triangle and quadrilateral (I. Katili, A new discrete
!! Kirchhoff-Mindlin element based on Mindlin-Reissner plate theory and assumed shear strain fields, Parts I and II, Int. J. Numer.
!! Meth. Engng 36 (1993) 1859-1908). The rotation of a fibre, {beta} = (theta_y, -theta_x), is interpolated linearly from the
!! corners; a quadratic term along each edge is added, whose amplitude follows from the equilibrium of a beam along the edge.
!!
!! Nodal values of an element are (3, 2 n): displacements of the n corners, then their rotations [rad], in global axes; nodal forces
!! likewise, then moments.
module shell_element
   use element_kinds, only: centre_point, kind_quad4, kind_quad8, kind_tria6, max_nodes, node_point
   use kinds, only: wp
   use quadrature, only: body_rule, integration_rule, mass_rule
   use shape_functions, only: shape_derivatives, shape_values
   use shell_membrane, only: add_membrane, add_thermal_membrane_forces, find_membrane, corner_kind, flat_coordinates, shell_frame, &
                             shell_frame_of, shell_law, thickness_at
   implicit none
   private

   public :: shell_forces, shell_products, shell_stiffness, shell_stresses, shell_thermal_forces

contains

   !> [k] of an element with corners X.
   pure subroutine shell_stiffness(law, x, k)
      type(shell_law), intent(in) :: law
      real(wp), intent(in)        :: x(:, :)  !! (3, corners) [length]
      real(wp), intent(inout)     :: k(:, :)  !! (6 corners, 6 corners), set here [force/length], [force], [force length]
      type(shell_frame)      :: frame
      type(integration_rule) :: rule
      real(wp) :: curvature(3, 12), gamma(2, 12), k_local(24, 24), plate(12, 12), t, volume
      integer  :: a, at(12), b, m, p

      frame = shell_frame_of(x, law%offset)
      m = 3*frame%n
      k_local = 0.0_wp
      call add_membrane(law, frame, k_local)
      ! bending and transverse shear
      plate = 0.0_wp
      call body_rule(merge(kind_quad4, kind_tria6, frame%n == 4), .false., rule)
      do p = 1, rule%n
         call plate_strains(law, frame, rule%point(:, p), curvature, gamma, volume)
         t = thickness_at(law, frame, rule%point(:, p))
         plate(:m, :m) = plate(:m, :m) + rule%weight(p)*volume*( &
            t**3/12.0_wp*matmul(transpose(curvature(:, :m)), matmul(law%bending, curvature(:, :m))) + &
            t*law%shear*matmul(transpose(gamma(:, :m)), gamma(:, :m)))
      end do
      at(:m) = [([6*a - 3, 6*a - 2, 6*a - 1], a = 1, frame%n)]
      do b = 1, m
         k_local(at(:m), at(b)) = k_local(at(:m), at(b)) + plate(:m, b)
      end do
      associate (n => 2*m, t => from_nodes(frame))
         k(:n, :n) = matmul(transpose(t), matmul(k_local(:n, :n), t))
      end associate
   end subroutine shell_stiffness

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

   !> Curvatures xx, yy, xy and transverse shear strains xz, yz at a POINT from w, theta_x, theta_y of corner 1 first. VOLUME is the
   !! volume per unit of weight.
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
      do i = 1, m                             ! at a corner from its two edges, interpolated between the corners
         b = modulo(i - 2, m) + 1
         associate (det => axis(1, i)*axis(2, b) - axis(2, i)*axis(1, b))
            across = reshape([axis(2, b), -axis(1, b), -axis(2, i), axis(1, i)], [2, 2])/det
         end associate
         do a = 1, 3*m
            gamma(:, a) = gamma(:, a) + n(i)*matmul(across, [edge_shear(i)*edge(a, i), edge_shear(b)*edge(a, b)])
         end do
      end do
   end subroutine plate_strains

   !> For every edge, from corner i to the next: the amplitude of its quadratic rotation, EDGE times w, theta_x, theta_y of the
   !! corners; the shear strain per unit of this amplitude; its direction AXIS. Along an edge of length L, with phi = 12 D/(G_s
   !! L^2): amplitude = -3/2/(1 + phi) ((w_j - w_i)/L + (beta_i + beta_j)/2), shear strain = -2/3 phi amplitude.
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

   !> Strains without thermal expansion in the axes of the element, at the corners and then at the centre, under the nodal values U:
   !! MEMBRANE xx, yy, xy of the mean plane, CURVATURE likewise, transverse shear strains xz, yz.
   pure subroutine find_strains(law, frame, u, rise, slope, membrane, curvature, shear)
      type(shell_law), intent(in)   :: law
      type(shell_frame), intent(in) :: frame
      real(wp), intent(in)          :: u(:, :)          !! (3, 2 corners) [length], [rad]
      real(wp), intent(in)          :: rise(:), slope   !! (corners) [temperature], [temperature/length]
      real(wp), intent(out)         :: membrane(3, 5), curvature(3, 5), shear(2, 5) !! [-], [1/length], [-]
      real(wp) :: b(3, 12), gamma(2, 12), u_local(6, 4), plate(12), volume, warm(5)
      integer  :: i, m

      m = frame%n
      u_local(:, :m) = reshape(matmul(from_nodes(frame), reshape(u, [6*m])), [6, m])
      plate(:3*m) = reshape(u_local(3:5, :m), [3*m])
      call find_membrane(law, frame, rise, u_local, membrane)
      warm(:m) = rise
      warm(m + 1) = sum(rise)/m
      do i = 1, m + 1
         if (i <= m) call plate_strains(law, frame, node_point(:, i, corner_kind(m)), b, gamma, volume)
         if (i > m) call plate_strains(law, frame, centre_point(:, corner_kind(m)), b, gamma, volume)
         membrane(:, i) = membrane(:, i) - law%expansion*warm(i)*[1.0_wp, 1.0_wp, 0.0_wp]
         curvature(:, i) = matmul(b(:, :3*m), plate(:3*m)) - law%expansion*slope*[1.0_wp, 1.0_wp, 0.0_wp]
         shear(:, i) = matmul(gamma(:, :3*m), plate(:3*m))
      end do
   end subroutine find_strains

   !> Stresses (xx, yy, zz, xy, yz, zx) in global axes at the heights Z above the mean plane, at the corners and then at the centre,
   !! under the nodal values U and a thermal load: T - TREF is RISE at the mean plane and grows by SLOPE per unit height.
   pure subroutine shell_stresses(law, x, u, rise, slope, z, stress)
      type(shell_law), intent(in) :: law
      real(wp), intent(in)        :: x(:, :)         !! (3, corners) [length]
      real(wp), intent(in)        :: u(:, :)         !! (3, 2 corners) [length], [rad]
      real(wp), intent(in)        :: rise(:), slope  !! (corners) [temperature], [temperature/length]
      real(wp), intent(in)        :: z(:)            !! [length]
      real(wp), intent(out)       :: stress(:, :, :) !! (6, corners + 1, heights) [pressure]
      type(shell_frame) :: frame
      real(wp) :: membrane(3, 5), curvature(3, 5), shear(2, 5), s(3), full(3, 3)
      integer  :: i, k, m

      frame = shell_frame_of(x, law%offset)
      m = frame%n
      call find_strains(law, frame, u, rise, slope, membrane, curvature, shear)
      do k = 1, size(z)
         do i = 1, m + 1
            s = matmul(law%d, membrane(:, i)) + z(k)*matmul(law%bending, curvature(:, i))
            full = matmul(frame%axes(:, :2), matmul(reshape([s(1), s(3), s(3), s(2)], [2, 2]), transpose(frame%axes(:, :2))))
            stress(:, i, k) = [full(1, 1), full(2, 2), full(3, 3), full(1, 2), full(2, 3), full(3, 1)]
         end do
      end do
   end subroutine shell_stresses

   !> Forces and moments per length, N_x, N_y, N_xy, M_x, M_y, M_xy, Q_x, Q_y, at the corners and then at the centre, for nodal
   !! values and a thermal load as in shell_stresses: the integrals over the thickness of sigma, of sigma z and of tau_xz, tau_yz.
   !! The direction x is ALONG, y is normal cross x.
   pure subroutine shell_forces(law, x, u, rise, slope, along, force)
      type(shell_law), intent(in) :: law
      real(wp), intent(in)        :: x(:, :)         !! (3, corners) [length]
      real(wp), intent(in)        :: u(:, :)         !! (3, 2 corners) [length], [rad]
      real(wp), intent(in)        :: rise(:), slope  !! (corners) [temperature], [temperature/length]
      real(wp), intent(in)        :: along(3)        !! unit, in the plane of the element
      real(wp), intent(out)       :: force(:, :)     !! (8, corners + 1) [force/length], moments [force]
      real(wp), parameter :: rigid = 1.0e12_wp
      type(shell_frame) :: frame
      type(shell_law)   :: stiff_law
      real(wp) :: membrane(3, 5), curvature(3, 5), shear(2, 5), t, turn(2, 2)
      integer  :: i, m

      stiff_law = law
      if (law%shear <= 0.0_wp) stiff_law%shear = rigid*law%bending(1, 1) ! the shear force is that of a plate nearly rigid in shear
      frame = shell_frame_of(x, law%offset)
      m = frame%n
      call find_strains(stiff_law, frame, u, rise, slope, membrane, curvature, shear)
      turn(1, :) = matmul(along, frame%axes(:, :2))
      turn(2, :) = [-turn(1, 2), turn(1, 1)]
      do i = 1, m + 1
         t = sum(law%thickness(:m))/m
         if (i <= m) t = law%thickness(i)
         force(:3, i) = turned(t*matmul(law%d, membrane(:, i)))
         force(4:6, i) = turned(t**3/12.0_wp*matmul(law%bending, curvature(:, i)))
         force(7:, i) = t*stiff_law%shear*matmul(turn, shear(:, i))
      end do

   contains

      !> The components xx, yy, xy along and across the direction ALONG.
      pure function turned(s)
         real(wp), intent(in) :: s(3)
         real(wp) :: turned(3), full(2, 2)

         full = matmul(turn, matmul(reshape([s(1), s(3), s(3), s(2)], [2, 2]), transpose(turn)))
         turned = [full(1, 1), full(2, 2), full(1, 2)]
      end function turned

   end subroutine shell_forces

   !> Nodal forces and moments F of a thermal load: T - TREF is RISE at the corners of the mean plane and grows by SLOPE per unit
   !! height.
   pure subroutine shell_thermal_forces(law, x, rise, slope, f)
      type(shell_law), intent(in) :: law
      real(wp), intent(in)        :: x(:, :)         !! (3, corners) [length]
      real(wp), intent(in)        :: rise(:), slope  !! (corners) [temperature], [temperature/length]
      real(wp), intent(inout)     :: f(:, :)         !! (3, 2 corners) [force], [force length], set here
      type(shell_frame) :: frame
      type(integration_rule) :: rule
      real(wp) :: b(3, 12), gamma(2, 12), f_local(6, 4), t, volume
      integer  :: m, p

      frame = shell_frame_of(x, law%offset)
      m = frame%n
      f_local = 0.0_wp
      call add_thermal_membrane_forces(law, frame, rise, f_local)
      if (abs(slope) > 0.0_wp) then
         call body_rule(merge(kind_quad4, kind_tria6, m == 4), .false., rule)
         do p = 1, rule%n
            call plate_strains(law, frame, rule%point(:, p), b, gamma, volume)
            t = thickness_at(law, frame, rule%point(:, p))
            f_local(3:5, :m) = f_local(3:5, :m) + reshape(rule%weight(p)*volume*t**3/12.0_wp*law%expansion*slope* &
                           matmul(transpose(b(:, :3*m)), law%bending(:, 1) + law%bending(:, 2)), [3, m])
         end do
      end if
      f(:, :2*m) = reshape(matmul(reshape(f_local(:, :m), [6*m]), from_nodes(frame)), [3, 2*m])
   end subroutine shell_thermal_forces

   !> M = integral of q N_i N_j over an element; the shape functions interpolate q between its VALUES at the corners.
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
