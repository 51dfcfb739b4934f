!> Stresses in an element from its displacements: at its centre, and extrapolated from inner points to its nodes.
!! Source: Zienkiewicz, Taylor, Zhu, The Finite Element Method, 6th ed., section 13.3; Hinton and Campbell, Local and global
!! smoothing of discontinuous finite element functions, Int. J. Numer. Meth. Engng 8 (1974) 461-480.
module stress_recovery
   use elasticity, only: axisymmetric, max_stresses, n_stresses, solid
   use element_kinds, only: centre_point, element_table, kind_penta6, kind_tetra4, kind_tria3, max_nodes, node_point
   use element_mapping, only: element_law, element_map, map_element, map_point, max_shapes
   use isoparametric, only: condensed_stiffness, max_unknowns, condensed_thermal_forces
   use kinds, only: wp
   use quadrature, only: gauss, integration_rule, stress_rule, tetra_far, tetra_near
   use shape_functions, only: shape_values
   implicit none
   private

   public :: centre_stress, nodal_stress

contains

   !> Stress at the centre, where a linear element is most accurate. The incompatible modes have no strain there.
   pure subroutine centre_stress(law, x, u, stress, rise)
      type(element_law), intent(in) :: law
      real(wp), intent(in)    :: x(:, :)         !! nodes (dimension, nodes) [length]
      real(wp), intent(in)    :: u(:, :)         !! displacements (dimension, nodes) [length]
      real(wp), intent(inout) :: stress(:)       !! (n_stresses(state)) [pressure], set here; components as in elasticity
      real(wp), intent(in), optional :: rise(:)  !! (nodes) T - TREF, 0 [temperature]
      type(element_map) :: map
      real(wp) :: q(3, max_shapes)

      call map_element(law, x, map)
      q = 0.0_wp ! parameters of the modes, and the third component in the plane
      q(:size(u, 1), :map%n) = u(:, :map%n)
      call stress_at(law, map, centre_point(:, law%kind), map%n, q, stress, rise)
   end subroutine centre_stress

   !> Stresses at the nodes, extrapolated from the points of stress_rule; the parameters of the incompatible modes are included. The
   !! extrapolation uses the linear shape functions of the element whose corners are these points. Where the element has one such
   !! point, the stress of this point holds at all nodes.
   pure subroutine nodal_stress(law, x, u, stress, rise)
      type(element_law), intent(in) :: law
      real(wp), intent(in)    :: x(:, :)         !! nodes (dimension, nodes) [length]
      real(wp), intent(in)    :: u(:, :)         !! displacements (dimension, nodes) [length]
      real(wp), intent(inout) :: stress(:, :)    !! (n_stresses(state), nodes) [pressure], set here
      real(wp), intent(in), optional :: rise(:)  !! (nodes) T - TREF, 0 [temperature]
      type(element_map)      :: map
      type(integration_rule) :: rule
      real(wp) :: q(3, max_shapes), at_point(max_stresses, max_nodes), n(max_nodes), scaled(3)
      real(wp) :: full(max_unknowns, max_unknowns), thermal(max_unknowns), values(max_unknowns)
      integer  :: d, i, k, linear, m, n_all, n_nodal

      m = n_stresses(law%state)
      call map_element(law, x, map)
      q = 0.0_wp ! parameters of the modes, and the third component in the plane
      q(:size(u, 1), :map%n) = u(:, :map%n)
      if (map%n_modes > 0) then  ! parameters of the modes from the condensed columns: only a thermal load acts on the modes
         d = size(u, 1)
         call condensed_stiffness(law, x, full, n_nodal, n_all)
         thermal = 0.0_wp
         if (present(rise)) call condensed_thermal_forces(law, x, rise, full, thermal)
         values(:n_nodal) = pack(u(:, :map%n), .true.)
         do i = n_nodal + 1, n_all
            values(i) = (thermal(i) - dot_product(full(:i - 1, i), values(:i - 1)))/full(i, i)
         end do
         q(:d, map%n + 1:n_all/d) = reshape(values(n_nodal + 1:n_all), [d, map%n_modes])
      end if
      call stress_rule(law%kind, law%state == axisymmetric, rule)
      do k = 1, rule%n
         call stress_at(law, map, rule%point(:, k), map%n + map%n_modes, q, at_point(:, k), rise)
      end do
      linear = element_table(law%kind)%linear
      do i = 1, map%n
         if (rule%n == 1) then
            stress(:m, i) = at_point(:m, 1)
         else
            associate (node => node_point(:, i, law%kind)) ! local coordinates relative to the points of stress_rule
               scaled = node/gauss
               if (linear == kind_tria3 .or. linear == kind_penta6) scaled(:2) = 2.0_wp*node(:2) - 1.0_wp/3.0_wp
               if (linear == kind_tetra4) scaled = (node - tetra_far)/(tetra_near - tetra_far)
            end associate
            call shape_values(linear, scaled, n)
            stress(:m, i) = matmul(at_point(:m, :rule%n), n(:rule%n))
         end if
      end do
   end subroutine nodal_stress

   !> Stress at a local POINT from the displacements and parameters Q of the first N shape functions.
   pure subroutine stress_at(law, map, point, n, q, stress, rise)
      type(element_law), intent(in) :: law
      type(element_map), intent(in) :: map
      real(wp), intent(in)    :: point(3)
      integer, intent(in)     :: n
      real(wp), intent(in)    :: q(3, max_shapes)  !! displacements, parameters of modes [length]
      real(wp), intent(inout) :: stress(:)         !! (at least n_stresses(state)) [pressure], set here
      real(wp), intent(in), optional :: rise(:)    !! (nodes) T - TREF, 0 [temperature]
      real(wp) :: g(3, max_shapes), shape(max_nodes), strain(max_stresses), volume
      integer  :: direct, i, m

      call map_point(law, map, point, g, volume)
      strain = 0.0_wp
      do i = 1, n
         strain(1) = strain(1) + g(1, i)*q(1, i)
         strain(2) = strain(2) + g(2, i)*q(2, i)
         if (law%state == solid) then
            strain(3) = strain(3) + g(3, i)*q(3, i)
            strain(4) = strain(4) + g(2, i)*q(1, i) + g(1, i)*q(2, i)
            strain(5) = strain(5) + g(3, i)*q(2, i) + g(2, i)*q(3, i)
            strain(6) = strain(6) + g(1, i)*q(3, i) + g(3, i)*q(1, i)
         else if (law%state == axisymmetric) then
            strain(3) = strain(3) + g(3, i)*q(1, i)
            strain(4) = strain(4) + g(2, i)*q(1, i) + g(1, i)*q(2, i)
         else
            strain(3) = strain(3) + g(2, i)*q(1, i) + g(1, i)*q(2, i)
         end if
      end do
      if (present(rise)) then ! the free thermal expansion has no stress
         call shape_values(law%kind, point, shape)
         direct = merge(3, 2, law%state == solid .or. law%state == axisymmetric)
         if (law%is_coupled) direct = 6
         strain(:direct) = strain(:direct) - law%expansion(:direct)*dot_product(shape(:size(rise)), rise)
      end if
      m = n_stresses(law%state)
      stress(:m) = matmul(law%d(:m, :m), strain(:m))
   end subroutine stress_at

end module stress_recovery
