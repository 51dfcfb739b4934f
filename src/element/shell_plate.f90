!> Flat shell elements out of their plane: bending and transverse shear, the discrete Kirchhoff-Mindlin triangle and quadrilateral.
!! Source: I. Katili, A new discrete Kirchhoff-Mindlin element based on Mindlin-Reissner plate theory and assumed shear strain
!! fields, Parts I and II, Int. J. Numer. Meth. Engng 36 (1993) 1859-1908. The rotation of a fibre, {beta} = (theta_y, -theta_x),
!! is interpolated linearly from the corners; a quadratic term along each edge is added, whose amplitude follows from the
!! equilibrium of a beam along the edge.
module shell_plate
   use element_kinds, only: kind_quad8, kind_tria6, max_nodes
   use kinds, only: wp
   use shape_functions, only: shape_derivatives, shape_values
   use shell_membrane, only: corner_kind, shell_frame, shell_law
   implicit none
   private

   public :: plate_strains

contains

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
      if (all(law%shear <= 0.0_wp)) return
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
   !! L^2) of bending and shear along it: amplitude = -3/2/(1 + phi) ((w_j - w_i)/L + (beta_i + beta_j)/2), shear strain = -2/3 phi
   !! amplitude.
   pure subroutine find_edges(law, frame, edge, edge_shear, axis)
      type(shell_law), intent(in)   :: law
      type(shell_frame), intent(in) :: frame
      real(wp), intent(out)         :: edge(12, 4), edge_shear(4), axis(2, 4)
      real(wp) :: along(3), amplitude, length, phi, shear, t
      integer  :: i, j, k

      edge = 0.0_wp
      do i = 1, frame%n
         j = modulo(i, frame%n) + 1
         axis(:, i) = frame%x(:, j) - frame%x(:, i)
         length = norm2(axis(:, i))
         axis(:, i) = axis(:, i)/length
         t = 0.5_wp*(law%thickness(i) + law%thickness(j))
         along = [axis(1, i)**2, axis(2, i)**2, 2.0_wp*axis(1, i)*axis(2, i)]
         shear = dot_product(along(:2), law%shear)
         phi = 0.0_wp
         if (shear > 0.0_wp) phi = dot_product(along, matmul(law%bending, along))*(t/length)**2/shear
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

end module shell_plate
