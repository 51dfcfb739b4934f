!> Stiffness, stresses and nodal forces of the elements of a model; this module selects the routine of each kind.
module body_elements
   use beam_element, only: beam_nodal_forces, beam_stiffness, beam_thermal_load
   use elasticity, only: max_stresses, n_stresses, plane_strain
   use element_kinds, only: element_table, max_section_dofs, max_nodes, centre_point
   use element_mapping, only: element_law, make_element_law
   use isoparametric, only: stiffness, nodal_thermal_forces
   use kinds, only: wp
   use element_unknowns, only: displaced_nodes
   use mesh_queries, only: element_points, is_beam, is_shell
   use model_data, only: mesh_type, model_type, temperature_type
   use node_coupling, only: onto_unknowns, add_section_share, corner_displacements, extend_stiffness, section_node
   use shape_functions, only: shape_values
   use shell_element, only: most_shell_nodes, shell_stiffness, shell_thermal_forces
   use stress_recovery, only: centre_stress, nodal_stress
   use structural_elements, only: between_own, most_own, onto_own, structural_stress
   use temperatures, only: beam_slopes, element_rise, element_slope
   implicit none
   private

   public :: coupled_stiffness, element_centre, element_stress, element_nodal_stress, node_stresses, whole_stress
   public :: element_stiffness, internal_forces, element_thermal_forces, add_thermal_forces, law_of

   ! Element contributions to nodal sums are computed in parallel, block by block, if there are more than a few; they are added in
   ! the order of the elements, so that the sum does not depend on the number of threads.
   integer, parameter :: block = 8192, few = 512

contains

   !> [k] between the components of the nodes_of_unknowns of element E, components of node 1 first [force/length]. K is enlarged where
   !! it is too small, because dependent nodes couple an element with any number of unknowns. A loop over elements reuses K.
   pure subroutine coupled_stiffness(model, e, k)
      type(model_type), intent(in)         :: model
      integer, intent(in)                  :: e
      real(wp), allocatable, intent(inout) :: k(:, :) !! dimension x these nodes rows and columns are set

      if (.not. allocated(k)) allocate (k(max_section_dofs, max_section_dofs))
      call element_stiffness(model, e, k)
      if (model%freedoms%coupling%n > 0) call onto_unknowns(model, displaced_nodes(model%freedoms, e), k)
   end subroutine coupled_stiffness

   !> [k] between the displacements of the displaced_nodes of element E, components of node 1 first [force/length].
   pure subroutine element_stiffness(model, e, k)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e
      real(wp), intent(inout)      :: k(:, :) !! dimension x displaced nodes rows and columns are set
      real(wp), allocatable :: full(:, :) ! between the nodal values of a shell or beam

      if (is_beam(model%mesh, e) .or. is_shell(model%mesh, e)) allocate (full(3*most_own, 3*most_own))
      if (is_beam(model%mesh, e)) then
         full(:12, :12) = beam_stiffness(model%mesh%structural%beams(model%mesh%structural%place(e)), &
                                         model%mesh%x(:, element_points(model%mesh, e)))
         call between_own(model, e, full, k)
      else if (is_shell(model%mesh, e)) then
         call shell_stiffness(model%mesh%structural%shells(model%mesh%structural%place(e)), &
                              model%mesh%x(:, element_points(model%mesh, e)), full)
         call between_own(model, e, full, k)
      else
         call stiffness(law_of(model%mesh, e), model%mesh%x(:model%mesh%dimension, element_points(model%mesh, e)), k)
         call extend_stiffness(model, e, k)
      end if
   end subroutine element_stiffness

   !> The centre of element E, the point of element_stress [length]: of a linear element the mean of its corners.
   pure function element_centre(model, e) result(x)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e
      real(wp) :: x(model%mesh%dimension), n(max_nodes)

      associate (nodes => element_points(model%mesh, e), kind => element_table(model%mesh%element_kind(e)))
         if (kind%n_nodes == kind%n_corners) then
            x = sum(model%mesh%x(:model%mesh%dimension, nodes), dim=2)/size(nodes)
         else
            call shape_values(model%mesh%element_kind(e), centre_point(:, model%mesh%element_kind(e)), n)
            x = matmul(model%mesh%x(:model%mesh%dimension, nodes), n(:size(nodes)))
         end if
      end associate
   end function element_centre

   !> Stress at the centre of element E under the displacements U at this TEMPERATURE: components as in elasticity [pressure]. For a
   !! beam it is zero.
   pure function element_stress(model, e, u, temperature) result(stress)
      type(model_type), intent(in)       :: model
      integer, intent(in)                :: e
      real(wp), intent(in)               :: u(:, :) !! (dimension, n_nodes) [length]
      type(temperature_type), intent(in) :: temperature
      real(wp) :: stress(n_stresses(model%mesh%properties(model%mesh%element_property(e))%state))
      real(wp) :: at_corners(max_stresses, most_shell_nodes + 1, 1) ! of a shell in its mean plane, and at its centre

      if (is_beam(model%mesh, e)) then
         stress = 0.0_wp
      else if (is_shell(model%mesh, e)) then
         associate (n => element_table(model%mesh%element_kind(e))%n_nodes)
            call structural_stress(model, e, u(:, displaced_nodes(model%freedoms, e)), temperature, [0.0_wp], &
                                   at_corners(:, :n + 1, :))
            stress = at_corners(:, n + 1, 1)
         end associate
      else
         call centre_stress(law_of(model%mesh, e), model%mesh%x(:model%mesh%dimension, element_points(model%mesh, e)), &
            corner_displacements(model, e, u), stress, element_rise(model, e, temperature))
      end if
   end function element_stress

   !> Stresses at the nodes of element E (no shell or beam), with the components of element_stress.
   pure subroutine element_nodal_stress(model, e, u, temperature, stress)
      type(model_type), intent(in)       :: model
      integer, intent(in)                :: e
      real(wp), intent(in)               :: u(:, :) !! (dimension, n_nodes) [length]
      type(temperature_type), intent(in) :: temperature
      real(wp), intent(inout)            :: stress(:, :) !! (components, nodes) [pressure], set here

      call nodal_stress(law_of(model%mesh, e), model%mesh%x(:model%mesh%dimension, element_points(model%mesh, e)), &
         corner_displacements(model, e, u), stress, element_rise(model, e, temperature))
   end subroutine element_nodal_stress

   !> Nodal stresses with the components of whole_stress: the mean over the elements at a node; 0 at a node without elements.
   subroutine node_stresses(model, u, temperature, at_node)
      type(model_type), intent(in)       :: model
      real(wp), intent(in)               :: u(:, :)       !! (dimension, n_nodes) [length]
      type(temperature_type), intent(in) :: temperature
      real(wp), intent(out)              :: at_node(:, :) !! (max_stresses, points) [pressure]
      real(wp), allocatable :: shares(:, :, :)            ! (max_stresses, nodes, elements of a block)
      integer, allocatable  :: n_at(:)                    ! number of bodies at each node
      integer :: e, first, i, last

      at_node = 0.0_wp
      allocate (n_at(size(at_node, 2)), source=model%mesh%first_at(2:size(at_node, 2) + 1) - model%mesh%first_at(:size(at_node, 2)))
      do e = 1, model%mesh%n_elements ! shells and beams have separate tables
         if (is_shell(model%mesh, e) .or. is_beam(model%mesh, e)) &
            n_at(element_points(model%mesh, e)) = n_at(element_points(model%mesh, e)) - 1
      end do
      allocate (shares(max_stresses, size(model%mesh%element_nodes, 1), min(block, model%mesh%n_elements)))
      do first = 1, model%mesh%n_elements, block
         last = min(model%mesh%n_elements, first + block - 1)
         !$omp parallel do schedule(dynamic, 128) default(shared) if(last - first > few)
         do e = first, last
            if (.not. (is_shell(model%mesh, e) .or. is_beam(model%mesh, e))) call find_shares(e, shares(:, :, e - first + 1))
         end do
         !$omp end parallel do
         do e = first, last
            if (is_shell(model%mesh, e) .or. is_beam(model%mesh, e)) cycle
            do i = 1, element_table(model%mesh%element_kind(e))%n_nodes
               associate (node => model%mesh%element_nodes(i, e))
                  at_node(:, node) = at_node(:, node) + shares(:, i, e - first + 1)
               end associate
            end do
         end do
      end do

   contains

      !> The share of element E in the mean stresses at its nodes.
      pure subroutine find_shares(e, share)
         integer, intent(in)     :: e
         real(wp), intent(inout) :: share(:, :) !! (max_stresses, nodes)
         real(wp) :: nodal(max_stresses, max_nodes), rise(max_nodes)
         integer  :: c, i

         associate (nodes => element_points(model%mesh, e))
            c = n_stresses(model%mesh%properties(model%mesh%element_property(e))%state)
            rise(:size(nodes)) = element_rise(model, e, temperature)
            call element_nodal_stress(model, e, u, temperature, nodal(:c, :size(nodes)))
            do i = 1, size(nodes)
               share(:, i) = full_stress(model, e, nodal(:c, i), rise(i))/real(n_at(nodes(i)), wp)
            end do
         end associate
      end subroutine find_shares

   end subroutine node_stresses

   !> Stress at the centre of element E as (xx, yy, zz, xy, yz, zx), with the stress normal to the plane and the hoop stress.
   pure function whole_stress(model, e, u, temperature) result(whole)
      type(model_type), intent(in)       :: model
      integer, intent(in)                :: e
      real(wp), intent(in)               :: u(:, :) !! (dimension, n_nodes) [length]
      type(temperature_type), intent(in) :: temperature
      real(wp) :: whole(max_stresses), n(max_nodes)

      call shape_values(model%mesh%element_kind(e), centre_point(:, model%mesh%element_kind(e)), n)
      associate (rise => element_rise(model, e, temperature))
         whole = full_stress(model, e, element_stress(model, e, u, temperature), dot_product(n(:size(rise)), rise))
      end associate
   end function whole_stress

   !> All six stresses from the STRESS at a point of element E, where T - TREF is RISE.
   pure function full_stress(model, e, stress, rise) result(full)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e
      real(wp), intent(in)         :: stress(:) !! components as in elasticity
      real(wp), intent(in)         :: rise      !! [temperature]
      real(wp) :: full(max_stresses)

      full = 0.0_wp
      associate (property => model%mesh%properties(model%mesh%element_property(e)))
         if (size(stress) == max_stresses) then ! solids, shells, beams
            full = stress
         else
            full(:2) = stress(:2)
            full(4) = stress(size(stress))
            if (size(stress) == 4) full(3) = stress(3)
            if (property%state == plane_strain) full(3) = property%nu*(stress(1) + stress(2)) - property%e*property%alpha*rise
         end if
      end associate
   end function full_stress

   !> Internal forces of the bodies: F = sum of [k] {u} over the elements.
   subroutine internal_forces(model, u, f)
      type(model_type), intent(in) :: model
      real(wp), intent(in)         :: u(:, :) !! (dimension, n_nodes) [length]
      real(wp), intent(out)        :: f(:, :) !! (dimension, n_nodes) [force]
      real(wp), allocatable :: p(:, :, :)     ! (dimension, displaced nodes, elements of a block)
      integer :: e, first, i, last

      f = 0.0_wp
      ! 8: with rotations
      allocate (p(model%mesh%dimension, max(most_own, size(model%mesh%element_nodes, 1)) + 1, min(block, model%mesh%n_elements)))
      do first = 1, model%mesh%n_elements, block
         last = min(model%mesh%n_elements, first + block - 1)
         !$omp parallel do schedule(dynamic, 128) default(shared) if(last - first > few)
         do e = first, last
            call element_forces(model, e, u, p(:, :, e - first + 1))
         end do
         !$omp end parallel do
         do e = first, last
            associate (nodes => displaced_nodes(model%freedoms, e))
               do i = 1, size(nodes)
                  f(:, nodes(i)) = f(:, nodes(i)) + p(:, i, e - first + 1)
               end do
            end associate
         end do
      end do
   end subroutine internal_forces

   !> The internal forces P of element E at its displaced_nodes.
   pure subroutine element_forces(model, e, u, p)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e
      real(wp), intent(in)         :: u(:, :) !! (dimension, n_nodes) [length]
      real(wp), intent(inout)      :: p(:, :) !! (dimension, nodes) [force], set here
      real(wp) :: k(max_section_dofs, max_section_dofs), q(max_section_dofs)
      integer  :: n

      call element_stiffness(model, e, k)
      associate (nodes => displaced_nodes(model%freedoms, e))
         n = model%mesh%dimension*size(nodes)
         q(:n) = reshape(u(:, nodes), [n])
         p(:, :size(nodes)) = reshape(matmul(k(:n, :n), q(:n)), [model%mesh%dimension, size(nodes)])
      end associate
   end subroutine element_forces

   !> Thermal nodal forces F of element E at its displaced_nodes, but for that of a section, at this TEMPERATURE.
   pure subroutine element_thermal_forces(model, e, temperature, f)
      type(model_type), intent(in)       :: model
      integer, intent(in)                :: e
      type(temperature_type), intent(in) :: temperature
      real(wp), intent(inout)            :: f(:, :) !! (dimension, nodes) [force], set here
      real(wp) :: nodal(3, most_own)                ! on the nodal values of a shell or beam

      associate (rise => element_rise(model, e, temperature), x => model%mesh%x(:, element_points(model%mesh, e)))
         if (is_beam(model%mesh, e)) then
            associate (law => model%mesh%structural%beams(model%mesh%structural%place(e)))
               nodal(:, :4) = beam_nodal_forces(law, x, beam_thermal_load(law, x, rise, beam_slopes(model, e, temperature)))
            end associate
            call onto_own(model%mesh, e, nodal, f)
         else if (is_shell(model%mesh, e)) then
            call shell_thermal_forces(model%mesh%structural%shells(model%mesh%structural%place(e)), x, rise, &
                                      element_slope(model, e, temperature), nodal)
            call onto_own(model%mesh, e, nodal, f)
         else
            call nodal_thermal_forces(law_of(model%mesh, e), x(:model%mesh%dimension, :), rise, f)
         end if
      end associate
   end subroutine element_thermal_forces

   !> Add to F the thermal nodal forces of the bodies at this TEMPERATURE.
   pure subroutine add_thermal_forces(model, temperature, f)
      type(model_type), intent(in)       :: model
      type(temperature_type), intent(in) :: temperature
      real(wp), intent(inout)            :: f(:, :) !! (dimension, n_nodes) [force]
      real(wp) :: nodal(model%mesh%dimension, max_nodes)
      integer  :: e, n

      do e = 1, model%mesh%n_elements
         associate (nodes => displaced_nodes(model%freedoms, e))
            n = size(nodes)
            if (section_node(model%mesh, e) > 0) n = n - 1 ! add_section_share
            call element_thermal_forces(model, e, temperature, nodal)
            f(:, nodes(:n)) = f(:, nodes(:n)) + nodal(:, :n)
            call add_section_share(model%mesh, e, nodes(:n), nodal, f)
         end associate
      end do
   end subroutine add_thermal_forces

   !> The law of element E: material, thickness and kind.
   pure type(element_law) function law_of(mesh, e)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)          :: e

      associate (property => mesh%properties(mesh%element_property(e)))
         law_of = make_element_law(mesh%element_kind(e), property%state, property%e, property%nu, property%thickness, &
                                   property%incompatible, property%alpha)
         if (.not. allocated(property%solid)) return
         law_of%d = property%solid(:, :6)
         law_of%expansion = property%solid(:, 7)
         law_of%is_coupled = property%is_coupled
      end associate
   end function law_of

end module body_elements
