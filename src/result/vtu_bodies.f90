!> The bodies as ParaView shows them: with displacements and stresses, or in the shapes of natural modes.
module vtu_bodies
   use, intrinsic :: iso_fortran_env, only: int8
   use analysis_state, only: analysis_type
   use body_elements, only: node_stresses, whole_stress
   use element_kinds, only: element_table
   use elasticity, only: max_stresses
   use kinds, only: wp
   use listing_table, only: label_type
   use mode_values, only: modes_type
   use model_data, only: corners_of, model_type, n_points
   use stress_measures, only: principal_stresses, von_mises
   use temperatures, only: has_temperatures, node_temperatures
   use text_tools, only: integer_text, real_text
   use vtu_file, only: cell_data, named, point_data, vtu_file_type
   implicit none
   private

   public :: write_bodies, write_shapes

contains

   !> Elements with stresses at their centres, nodes with displacements and the mean of the stresses of its elements there.
   subroutine write_bodies(file, labels, model, analysis)
      type(vtu_file_type), intent(inout) :: file
      type(label_type), intent(in)       :: labels
      type(model_type), intent(in)       :: model
      type(analysis_type), intent(in)    :: analysis
      real(wp), allocatable :: u(:, :), at_node(:, :), at_centre(:, :), principal(:, :)
      integer, allocatable  :: properties(:)
      integer :: e, i, m

      m = n_points(model)
      allocate (u(3, m), source=0.0_wp)
      allocate (at_node(max_stresses, m), at_centre(max_stresses, model%n_elements), principal(3, model%n_elements))
      allocate (properties(model%n_elements))
      u(:model%dimension, :) = analysis%all_u(:, :m)
      do e = 1, model%n_elements
         properties(e) = model%properties(model%element_property(e))%id
         at_centre(:, e) = whole_stress(model, e, analysis%all_u, analysis%temperature)
         principal(:, e) = principal_stresses(at_centre(:, e))
      end do
      call node_stresses(model, analysis%all_u, analysis%temperature, at_node)
      call write_mesh(file, model)
      call file%add(point_data, named('displacement', labels%length), u)
      call file%add(point_data, named('stress', labels%pressure), at_node)
      call file%add(point_data, named('von_mises', labels%pressure), [(von_mises(at_node(:, i)), i = 1, m)])
      if (has_temperatures(model)) then
         associate (t => node_temperatures(model, analysis%temperature))
            call file%add(point_data, 'temperature [deg]', t(:m))
         end associate
      end if
      call file%add(cell_data, 'element', model%element_id)
      call file%add(cell_data, 'property', properties)
      call file%add(cell_data, named('stress_at_centre', labels%pressure), at_centre)
      call file%add(cell_data, named('principal_stress', labels%pressure), principal)
      call file%add(cell_data, named('von_mises_at_centre', labels%pressure), &
                    [(von_mises(at_centre(:, e)), e = 1, model%n_elements)])
   end subroutine write_bodies

   !> The shapes of the MODES: vectors at the nodes, one a mode, each named by its number and frequency.
   subroutine write_shapes(file, model, modes)
      type(vtu_file_type), intent(inout) :: file
      type(model_type), intent(in)       :: model
      type(modes_type), intent(in)       :: modes
      real(wp), allocatable :: u(:, :)
      integer :: k, m

      m = n_points(model)
      allocate (u(3, m), source=0.0_wp)
      call write_mesh(file, model)
      do k = 1, size(modes%modes)
         u(:model%dimension, :) = modes%modes(k)%u(:, :m)
         call file%add(point_data, 'mode '//integer_text(modes%n_before + k)//', frequency '// &
                       real_text(modes%modes(k)%frequency), u)
      end do
   end subroutine write_shapes

   !> The points and cells of the bodies, and the numbers of the nodes.
   subroutine write_mesh(file, model)
      type(vtu_file_type), intent(inout) :: file
      type(model_type), intent(in)       :: model
      integer, allocatable       :: connected(:), ends(:)
      integer(int8), allocatable :: types(:)
      integer :: e, m, n

      m = n_points(model)
      allocate (connected(count(model%element_nodes > 0)), ends(model%n_elements), types(model%n_elements))
      n = 0
      do e = 1, model%n_elements
         associate (nodes => corners_of(model, e))
            connected(n + 1:n + size(nodes)) = nodes(element_table(model%element_kind(e))%vtk_nodes(:size(nodes)))
            n = n + size(nodes)
            ends(e) = n
            types(e) = int(element_table(model%element_kind(e))%vtk_type, int8)
         end associate
      end do
      call file%points(model%x(:, :m))
      call file%cells(connected, ends, types)
      call file%add(point_data, 'node', model%node_id(:m))
   end subroutine write_mesh

end module vtu_bodies
