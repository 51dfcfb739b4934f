!> The bodies as ParaView shows them: with displacements and stresses, or in the shapes of natural modes.
module vtu_bodies
   use body_elements, only: node_stresses, whole_stress
   use body_parts, only: all_shown, body_piece_type, shown_type
   use elasticity, only: max_stresses, principal_stresses, von_mises
   use element_kinds, only: element_table
   use, intrinsic :: iso_fortran_env, only: int8
   use kinds, only: wp
   use listing_table, only: label_type
   use mode_values, only: modes_type
   use model_data, only: corners_of, is_shell, model_type, n_points, temperature_type
   use structural_results, only: face_stresses, node_peaks
   use temperatures, only: node_temperatures
   use text_tools, only: integer_text, real_text
   use vtu_file, only: cell_data, named, point_data, vtu_file_type
   implicit none
   private

   public :: write_bodies, write_shapes, write_piece, notes_for_pieces

contains

   !> Of what is SHOWN elements with stresses at their centres, nodes with displacements and the mean of the stresses of its elements
   !! there.
   subroutine write_bodies(file, labels, model, shown, u, temperature)
      type(vtu_file_type), intent(inout) :: file
      type(label_type), intent(in)       :: labels
      type(model_type), intent(in)       :: model
      type(shown_type), intent(in)       :: shown
      real(wp), intent(in)               :: u(:, :) !! (dimension, n_nodes) [length]
      type(temperature_type), intent(in) :: temperature
      real(wp), allocatable :: moved(:, :), at_node(:, :), at_centre(:, :), principal(:, :), peaks(:), at_ends(:)
      integer :: i, m, n

      m = shown%n_points
      n = size(shown%elements)
      allocate (moved(3, m), source=0.0_wp)
      allocate (at_node(max_stresses, model%n_nodes), at_centre(max_stresses, n), principal(3, n))
      moved(:model%dimension, :) = u(:, :m)
      do i = 1, n
         at_centre(:, i) = whole_stress(model, shown%elements(i), u, temperature)
         principal(:, i) = principal_stresses(at_centre(:, i))
      end do
      call node_stresses(model, u, temperature, at_node)
      allocate (peaks(model%n_nodes), at_ends(model%n_elements))
      call node_peaks(model, u, temperature, peaks(:m), at_ends)
      call write_mesh(file, model, shown)
      call file%add(point_data, named('displacement', labels%length), moved)
      call file%add(point_data, named('stress', labels%pressure), at_node(:, :m))
      call file%add(point_data, named('von_mises', labels%pressure), [(max(von_mises(at_node(:, i)), peaks(i)), i = 1, m)])
      if (shown%is_warm) then
         associate (t => node_temperatures(model, temperature))
            call file%add(point_data, 'temperature [deg]', t(:m))
         end associate
      end if
      call file%add(cell_data, 'element', model%element_id(shown%elements))
      call file%add(cell_data, 'property', model%properties(model%element_property(shown%elements))%id)
      call file%add(cell_data, named('stress_at_centre', labels%pressure), at_centre)
      call file%add(cell_data, named('principal_stress', labels%pressure), principal)
      call file%add(cell_data, named('von_mises_at_centre', labels%pressure), [(max(von_mises(at_centre(:, i)), &
                                                                                at_ends(shown%elements(i))), i = 1, n)])
      if (allocated(model%structural%place)) call write_faces(file, labels, model, shown, u, temperature)
   end subroutine write_bodies

   !> Of shells the thickness and the von Mises stress at the centres of both faces; of other elements zero.
   subroutine write_faces(file, labels, model, shown, u, temperature)
      type(vtu_file_type), intent(inout) :: file
      type(label_type), intent(in)       :: labels
      type(model_type), intent(in)       :: model
      type(shown_type), intent(in)       :: shown
      real(wp), intent(in)               :: u(:, :) !! (dimension, n_nodes) [length]
      type(temperature_type), intent(in) :: temperature
      real(wp) :: thickness(size(shown%elements)), at_face(size(shown%elements), 2), stress(max_stresses, 5, 2)
      integer  :: f, i, n

      thickness = 0.0_wp
      at_face = 0.0_wp
      do i = 1, size(thickness)
         if (.not. is_shell(model, shown%elements(i))) cycle
         n = size(corners_of(model, shown%elements(i)))
         call face_stresses(model, shown%elements(i), u, temperature, stress)
         at_face(i, :) = [(von_mises(stress(:, n + 1, f)), f = 1, 2)]
         thickness(i) = sum(model%structural%shells(model%structural%place(shown%elements(i)))%thickness(:n))/n
      end do
      call file%add(cell_data, named('thickness', labels%length), thickness)
      call file%add(cell_data, named('von_mises_at_z1', labels%pressure), at_face(:, 1))
      call file%add(cell_data, named('von_mises_at_z2', labels%pressure), at_face(:, 2))
   end subroutine write_faces

   !> What the LABELS of a file are that is written in pieces, for write_piece.
   pure function notes_for_pieces(labels) result(notes)
      type(label_type), intent(in) :: labels
      character(:), allocatable    :: notes

      notes = labels%length//labels%pressure
   end function notes_for_pieces

   !> The piece_writer of the results: a PIECE as write_bodies has it, into a file that has been reserved.
   subroutine write_piece(piece, u, temperature, notes, file, ok)
      type(body_piece_type), intent(in)  :: piece
      real(wp), intent(in)               :: u(:, :) !! (dimension, nodes of its model) [length]
      type(temperature_type), intent(in) :: temperature
      character(*), intent(in)           :: notes, file
      logical, intent(out)               :: ok
      type(vtu_file_type) :: part
      type(label_type)    :: labels

      labels%length = notes(:len(labels%length))
      labels%pressure = notes(len(labels%length) + 1:)
      call part%open_part(file)
      call write_bodies(part, labels, piece%model, piece%shown, u, temperature)
      call part%complete()
      ok = .not. part%failed()
   end subroutine write_piece

   !> The shapes of the MODES: vectors at the nodes, one a mode, each named by its number and frequency.
   subroutine write_shapes(file, model, modes)
      type(vtu_file_type), intent(inout) :: file
      type(model_type), intent(in)       :: model
      type(modes_type), intent(in)       :: modes
      real(wp), allocatable :: u(:, :)
      integer :: k, m

      m = n_points(model)
      allocate (u(3, m), source=0.0_wp)
      call write_mesh(file, model, all_shown(model))
      do k = 1, size(modes%modes)
         u(:model%dimension, :) = modes%modes(k)%u(:, :m)
         call file%add(point_data, 'mode '//integer_text(modes%n_before + k)//', frequency '// &
                       real_text(modes%modes(k)%frequency), u)
      end do
   end subroutine write_shapes

   !> The points and cells of what is SHOWN, and the numbers of the nodes.
   subroutine write_mesh(file, model, shown)
      type(vtu_file_type), intent(inout) :: file
      type(model_type), intent(in)       :: model
      type(shown_type), intent(in)       :: shown
      integer, allocatable       :: connected(:), ends(:)
      integer(int8), allocatable :: types(:)
      integer :: i, m, n

      m = shown%n_points
      allocate (connected(count(model%element_nodes(:, shown%elements) > 0)))
      allocate (ends(size(shown%elements)), types(size(shown%elements)))
      n = 0
      do i = 1, size(ends)
         associate (nodes => corners_of(model, shown%elements(i)), kind => element_table(model%element_kind(shown%elements(i))))
            connected(n + 1:n + size(nodes)) = nodes(kind%vtk_nodes(:size(nodes)))
            n = n + size(nodes)
            ends(i) = n
            types(i) = int(kind%vtk_type, int8)
         end associate
      end do
      call file%points(model%x(:, :m))
      call file%cells(connected, ends, types)
      call file%add(point_data, 'node', model%node_id(:m))
   end subroutine write_mesh

end module vtu_bodies
