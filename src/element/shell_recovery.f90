!> Stresses of shells at heights above their mean plane and in the plies of laminates, and their forces and moments per length.
module shell_recovery
   use element_kinds, only: centre_point, max_nodes, node_point
   use kinds, only: wp
   use laminate, only: ply_turn
   use shape_functions, only: shape_values
   use shell_curved, only: most_columns
   use shell_element, only: form, kind_of, map_of, most_shell_nodes, section_heat, section_stiffness, shell_map, shell_point, &
                            shell_strains
   use shell_membrane, only: shell_law
   implicit none
   private

   public :: ply_stresses, shell_forces, shell_stresses

   ! extrapolation of strains from the integration points of a quadrilateral to its corners: TO_CORNERS(i, j) is the weight of the
   ! point next to corner i at corner j
   real(wp), parameter :: near = 1.0_wp + 0.5_wp*sqrt(3.0_wp), far = 1.0_wp - 0.5_wp*sqrt(3.0_wp)
   real(wp), parameter :: to_corners(4, 4) = reshape([near, -0.5_wp, far, -0.5_wp, -0.5_wp, near, -0.5_wp, far, &
                                                      far, -0.5_wp, near, -0.5_wp, -0.5_wp, far, -0.5_wp, near], [4, 4])

contains

   !> Strains at the nodes and then at the centre under the nodal values U, and AT each the operators.
   pure subroutine find_strains(law, map, u, rise, slope, strain, at)
      type(shell_law), intent(in)    :: law
      type(shell_map), intent(in)    :: map
      real(wp), intent(in)           :: u(:, :)          !! (3, 2 nodes) [length], [rad]
      real(wp), intent(in)           :: rise(:), slope   !! (nodes) [temperature], [temperature/length]
      real(wp), intent(out)          :: strain(8, most_shell_nodes + 1) !! [-], [1/length]
      type(shell_point), intent(out) :: at(:)            !! (nodes + 1)
      real(wp) :: f(most_columns), k(most_columns, most_columns), q(most_columns), at_gauss(3, 4)
      type(shell_point) :: inner
      integer  :: i, m

      m = 6*map%n
      q(:m) = reshape(u, [m])
      if (map%columns > m) call form(law, map, rise, slope, k, f)
      do i = m + 1, map%columns
         q(i) = (f(i) - dot_product(k(:i - 1, i), q(:i - 1)))/k(i, i)
      end do
      do i = 1, map%n + 1
         if (i <= map%n) call shell_strains(law, map, node_point(:, i, kind_of(map%n)), at(i))
         if (i > map%n) call shell_strains(law, map, centre_point(:, kind_of(map%n)), at(i))
         strain(:, i) = matmul(at(i)%b(:, :map%columns), q(:map%columns))
      end do
      if (map%n /= 4) return
      do i = 1, 4                              ! the membrane by bilinear extrapolation from the integration points
         call shell_strains(law, map, map%rule%point(:, i), inner)
         at_gauss(:, i) = matmul(inner%b(:3, :map%columns), q(:map%columns))
      end do
      strain(:3, :4) = matmul(at_gauss, to_corners)
   end subroutine find_strains

   !> Stresses (xx, yy, zz, xy, yz, zx) in global axes at the heights Z above the mean plane, at the nodes and then at the centre,
   !! under the nodal values U and a thermal load: T - TREF is RISE at the mean plane and grows by SLOPE per unit height.
   pure subroutine shell_stresses(law, x, u, rise, slope, z, stress)
      type(shell_law), intent(in) :: law
      real(wp), intent(in)        :: x(:, :)         !! (3, nodes) [length]
      real(wp), intent(in)        :: u(:, :)         !! (3, 2 nodes) [length], [rad]
      real(wp), intent(in)        :: rise(:), slope  !! (nodes) [temperature], [temperature/length]
      real(wp), intent(in)        :: z(:)            !! [length]
      real(wp), intent(out)       :: stress(:, :, :) !! (6, nodes + 1, heights) [pressure]
      type(shell_map)   :: map
      type(shell_point) :: at(size(x, 2) + 1)
      real(wp) :: strain(8, most_shell_nodes + 1), warm(size(x, 2) + 1), s(3), full(3, 3)
      integer  :: i, k

      map = map_of(law, x)
      call find_strains(law, map, u, rise, slope, strain, at)
      warm = [rise, mean_rise(rise)]
      do k = 1, size(z)
         do i = 1, map%n + 1
            if (allocated(law%plies)) then
               s = ply_stress(law, ply_at(law, z(k)), strain(:, i), warm(i), slope, z(k))
            else
               s = matmul(law%d, strain(:3, i)) - law%heat(:, 1)*warm(i) + &
                   z(k)*(matmul(law%bending, strain(4:6, i)) - law%heat(:, 3)*slope)
            end if
            associate (plane => at(i)%axes(:, :2))
               full = matmul(plane, matmul(reshape([s(1), s(3), s(3), s(2)], [2, 2]), transpose(plane)))
            end associate
            stress(:, i, k) = [full(1, 1), full(2, 2), full(3, 3), full(1, 2), full(2, 3), full(3, 1)]
         end do
      end do
   end subroutine shell_stresses

   !> The mean temperature at the centre from those of the nodes.
   pure real(wp) function mean_rise(rise)
      real(wp), intent(in) :: rise(:)
      real(wp) :: n(max_nodes)
      integer  :: kind

      mean_rise = sum(rise)/size(rise)
      if (size(rise) <= 4) return
      kind = kind_of(size(rise))
      call shape_values(kind, centre_point(:, kind), n)
      mean_rise = dot_product(n(:size(rise)), rise)
   end function mean_rise

   !> The ply of a laminate at the height Z.
   pure integer function ply_at(law, z)
      type(shell_law), intent(in) :: law
      real(wp), intent(in)        :: z

      ply_at = findloc(law%plies%to >= z, .true., dim=1)
      if (ply_at == 0) ply_at = size(law%plies)
   end function ply_at

   !> Stress xx, yy, xy of ply P at the height Z, in the axes of the laminate.
   pure function ply_stress(law, p, strain, rise, slope, z) result(s)
      type(shell_law), intent(in) :: law
      integer, intent(in)         :: p
      real(wp), intent(in)        :: strain(8), rise, slope, z
      real(wp) :: s(3)

      s = matmul(law%plies(p)%q, strain(:3) + z*strain(4:6)) - law%plies(p)%heat*(rise + z*slope)
   end function ply_stress

   !> Stresses 11, 22, 12 of the plies of a laminate in their own axes, at the centre of an element, at the lower face, the middle
   !! and the upper face of each, for nodal values and a thermal load as in shell_stresses.
   pure function ply_stresses(law, x, u, rise, slope) result(stress)
      type(shell_law), intent(in) :: law
      real(wp), intent(in)        :: x(:, :), u(:, :), rise(:), slope
      real(wp) :: stress(3, 3, size(law%plies))       !! (component, height, ply) [pressure]
      type(shell_map)   :: map
      type(shell_point) :: at(size(x, 2) + 1)
      real(wp) :: strain(8, most_shell_nodes + 1), z(3)
      integer  :: i, k

      map = map_of(law, x)
      call find_strains(law, map, u, rise, slope, strain, at)
      do i = 1, size(law%plies)
         associate (p => law%plies(i), turn => ply_turn(-law%plies(i)%angle))
            z = [p%from, 0.5_wp*(p%from + p%to), p%to]
            do k = 1, 3
               stress(:, k, i) = matmul(ply_stress(law, i, strain(:, map%n + 1), mean_rise(rise), slope, z(k)), turn)
            end do
         end associate
      end do
   end function ply_stresses

   !> Forces and moments per length, N_x, N_y, N_xy, M_x, M_y, M_xy, Q_x, Q_y, at the nodes and then at the centre, for nodal
   !! values and a thermal load as in shell_stresses: the integrals over the thickness of sigma, of sigma z and of tau_xz, tau_yz.
   !! The direction x is ALONG, y is normal cross x.
   pure subroutine shell_forces(law, x, u, rise, slope, along, force)
      type(shell_law), intent(in) :: law
      real(wp), intent(in)        :: x(:, :)         !! (3, nodes) [length]
      real(wp), intent(in)        :: u(:, :)         !! (3, 2 nodes) [length], [rad]
      real(wp), intent(in)        :: rise(:), slope  !! (nodes) [temperature], [temperature/length]
      real(wp), intent(in)        :: along(3)        !! unit, in the plane of the element
      real(wp), intent(out)       :: force(:, :)     !! (8, nodes + 1) [force/length], moments [force]
      real(wp), parameter :: rigid = 1.0e12_wp
      type(shell_map)   :: map
      type(shell_point) :: at(size(x, 2) + 1)
      type(shell_law)   :: stiff_law
      real(wp) :: strain(8, most_shell_nodes + 1), warm(size(x, 2) + 1), f(8), turn(2, 2)
      integer  :: i

      map = map_of(law, x)
      stiff_law = law
      if (map%n <= 4 .and. all(law%shear <= 0.0_wp)) stiff_law%shear = rigid*law%bending(1, 1) ! the force of a plate nearly rigid
      call find_strains(stiff_law, map, u, rise, slope, strain, at)
      warm = [rise, mean_rise(rise)]
      do i = 1, map%n + 1
         at(i)%t_membrane = at(i)%t
         f = matmul(section_stiffness(stiff_law, map, at(i)), strain(:, i)) - section_heat(law, at(i), warm(i), slope)
         turn(1, :) = matmul(along, at(i)%axes(:, :2))
         turn(1, :) = turn(1, :)/max(norm2(turn(1, :)), tiny(1.0_wp))
         turn(2, :) = [-turn(1, 2), turn(1, 1)]
         force(:3, i) = turned(f(:3))
         force(4:6, i) = turned(f(4:6))
         force(7:, i) = matmul(turn, f(7:))
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

end module shell_recovery
