!> The grids for ParaView: bodies with displacements and stresses or mode shapes, and joints with their values. A joint is shown
!! by the faces of its side 1, with the values of the interface elements at the nodes. Joints of single elements (CJOINT) are
!! points; so are all elements at one node but the first.
module vtu_grids
   use analysis_state, only: analysis_type
   use body_elements, only: node_stresses, whole_stress
   use body_parts, only: body_piece_type, shown_type
   use elasticity, only: max_stresses, principal_stresses, von_mises
   use element_kinds, only: element_table
   use interface_operator, only: at_first_end, nodes_of_end, weights_of_end
   use, intrinsic :: iso_fortran_env, only: int8
   use joint_values, only: face_distance
   use kinds, only: wp
   use mesh_queries, only: element_points, is_shell
   use model_data, only: joint_type, model_type, surface_type, temperature_type
   use result_page, only: label_type
   use shell_element, only: most_shell_nodes
   use structural_results, only: face_stresses, node_peaks
   use surface_sides, only: nodes_of
   use temperatures, only: node_temperatures
   use vtu_file, only: cell_data, named, point_data, vtk_vertex, vtu_file_type
   implicit none
   private

   public :: write_bodies, write_joints, write_mesh, write_piece

   integer, parameter :: n_values = 8 ! lambda, pressure, tau(3), gap, averaged slip, area

   !> The points and cells of all joints during assembly.
   type :: grid_type
      integer :: n_points = 0, n_cells = 0, n_corners = 0
      real(wp), allocatable :: x(:, :), values(:, :)
      integer, allocatable  :: node(:)         ! with which a point moves
      integer, allocatable  :: element(:)      ! interface element that gives a point its branch
      integer, allocatable  :: corners(:), ends(:)
      integer(int8), allocatable :: types(:)
   end type grid_type

contains

   !> Write the SHOWN elements with stresses at their centres, shells with thickness and stress at both faces, and their nodes with
   !! displacements and averaged stresses.
   subroutine write_bodies(file, labels, model, shown, u, temperature)
      type(vtu_file_type), intent(inout) :: file
      type(label_type), intent(in)       :: labels
      type(model_type), intent(in)       :: model
      type(shown_type), intent(in)       :: shown
      real(wp), intent(in)               :: u(:, :) !! (dimension, n_nodes) [length]
      type(temperature_type), intent(in) :: temperature
      real(wp), allocatable :: moved(:, :), at_node(:, :), at_centre(:, :), principal(:, :), peaks(:), at_ends(:)
      real(wp), allocatable :: thickness(:), at_face(:, :)
      real(wp) :: stress(max_stresses, most_shell_nodes + 1, 2)
      integer  :: f, i, k, m, n

      m = shown%n_points
      n = size(shown%elements)
      allocate (moved(3, m), source=0.0_wp)
      allocate (at_node(max_stresses, model%mesh%n_nodes), at_centre(max_stresses, n), principal(3, n))
      moved(:model%mesh%dimension, :) = u(:, :m)
      do i = 1, n
         at_centre(:, i) = whole_stress(model, shown%elements(i), u, temperature)
         principal(:, i) = principal_stresses(at_centre(:, i))
      end do
      call node_stresses(model, u, temperature, at_node)
      allocate (peaks(model%mesh%n_nodes), at_ends(model%mesh%n_elements))
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
      call file%add(cell_data, 'element', model%mesh%element_id(shown%elements))
      call file%add(cell_data, 'property', model%mesh%properties(model%mesh%element_property(shown%elements))%id)
      call file%add(cell_data, named('stress_at_centre', labels%pressure), at_centre)
      call file%add(cell_data, named('principal_stress', labels%pressure), principal)
      call file%add(cell_data, named('von_mises_at_centre', labels%pressure), [(max(von_mises(at_centre(:, i)), &
                                                                                at_ends(shown%elements(i))), i = 1, n)])
      if (size(model%mesh%structural%place) == 0) return
      allocate (thickness(n), at_face(n, 2), source=0.0_wp) ! at the centres of both faces of shells; zero for other elements
      do i = 1, n
         if (.not. is_shell(model%mesh, shown%elements(i))) cycle
         k = size(element_points(model%mesh, shown%elements(i)))
         call face_stresses(model, shown%elements(i), u, temperature, stress)
         at_face(i, :) = [(von_mises(stress(:, k + 1, f)), f = 1, 2)]
         k = element_table(model%mesh%element_kind(shown%elements(i)))%n_corners
         thickness(i) = sum(model%mesh%structural%shells(model%mesh%structural%place(shown%elements(i)))%thickness(:k))/k
      end do
      call file%add(cell_data, named('thickness', labels%length), thickness)
      call file%add(cell_data, named('von_mises_at_z1', labels%pressure), at_face(:, 1))
      call file%add(cell_data, named('von_mises_at_z2', labels%pressure), at_face(:, 2))
   end subroutine write_bodies

   !> The piece_writer of the results: write a PIECE as write_bodies does into FILE, the part that rank 0 has created. NOTES are the
   !! labels of length and pressure.
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
      call part%start(file, is_part=.true.)
      call write_bodies(part, labels, piece%model, piece%shown, u, temperature)
      call part%complete()
      ok = .not. part%file%fault
   end subroutine write_piece

   !> The points and cells of the SHOWN elements, and the numbers of the nodes.
   subroutine write_mesh(file, model, shown)
      type(vtu_file_type), intent(inout) :: file
      type(model_type), intent(in)       :: model
      type(shown_type), intent(in)       :: shown
      integer, allocatable       :: connected(:), ends(:)
      integer(int8), allocatable :: types(:)
      integer :: i, m, n

      m = shown%n_points
      allocate (connected(count(model%mesh%element_nodes(:, shown%elements) > 0)))
      allocate (ends(size(shown%elements)), types(size(shown%elements)))
      n = 0
      do i = 1, size(ends)
         associate (nodes => element_points(model%mesh, shown%elements(i)), &
            kind => element_table(model%mesh%element_kind(shown%elements(i))))
            connected(n + 1:n + size(nodes)) = nodes(kind%vtk_nodes(:size(nodes)))
            n = n + size(nodes)
            ends(i) = n
            types(i) = int(kind%vtk_type, int8)
         end associate
      end do
      call file%points(model%mesh%x(:, :m))
      call file%cells(connected, ends, types)
      call file%add(point_data, 'node', model%mesh%node_id(:m))
   end subroutine write_mesh

   !> Write all joints into FILE. BRANCH is 1 load, 2 unload, 3 open, 4 reload as in the chart. TAU is the shear stress on side
   !! 2 in global axes. GAP is the distance of the faces. A node of a face without an element of its own, such as a corner of a
   !! second-order face, has the mean of the adjacent nodes and the branch of the first of them.
   subroutine write_joints(file, labels, model, analysis)
      type(vtu_file_type), intent(inout) :: file
      type(label_type), intent(in)       :: labels
      type(model_type), intent(in)       :: model
      type(analysis_type), intent(in)    :: analysis
      type(grid_type) :: grid
      real(wp), allocatable :: u(:, :)
      integer :: cells, i, j, n, points

      points = size(model%joints%element) ! upper bounds of points and cells
      cells = points
      do j = 1, size(model%joints%list)
         if (model%joints%list(j)%side_1 == 0) cycle
         associate (surface => model%mesh%surfaces(model%joints%list(j)%side_1))
            points = points + sum(surface%n_nodes(:surface%n))
            cells = cells + surface%n
         end associate
      end do
      allocate (grid%x(3, points), grid%node(points), grid%element(points), grid%corners(points))
      allocate (grid%ends(cells), grid%types(cells))
      allocate (grid%values(n_values, points), source=0.0_wp)
      do j = 1, size(model%joints%list)
         if (model%joints%list(j)%side_1 > 0) then
            call add_faces(model, analysis, model%joints%list(j), model%mesh%surfaces(model%joints%list(j)%side_1), grid)
         else
            do i = model%joints%list(j)%first, model%joints%list(j)%last ! elements of a joint of single elements
               call add_element(model, analysis, i, grid)
            end do
         end if
      end do
      n = grid%n_points
      call file%points(grid%x(:, :n))
      call file%cells(grid%corners(:grid%n_corners), grid%ends(:grid%n_cells), grid%types(:grid%n_cells))
      associate (values => grid%values(:, :n), of => grid%element(:n))
         call file%add(point_data, 'element', model%joints%element(of)%id)
         call file%add(point_data, 'joint', model%joints%list(model%joints%element(of)%joint)%id)
         allocate (u(3, n), source=0.0_wp)
         u(:model%mesh%dimension, :) = analysis%all_u(:, grid%node(:n))
         call file%add(point_data, named('displacement', labels%length), u)
         call file%add(point_data, named('lambda', labels%length), values(1, :))
         call file%add(point_data, named('pressure', labels%pressure), values(2, :))
         call file%add(point_data, named('gap', labels%length), values(6, :))
         call file%add(point_data, named('tau', labels%pressure), values(3:5, :))
         call file%add(point_data, 'branch', analysis%states(of)%normal%branch)
         call file%add(point_data, 'slip', nint(values(7, :)))
         call file%add(point_data, named('area', labels%area), values(8, :))
      end associate
   end subroutine write_joints

   !> Add JOINT as the faces of SURFACE, its side 1, that have an element at any of their nodes.
   subroutine add_faces(model, analysis, joint, surface, grid)
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      type(joint_type), intent(in)    :: joint
      type(surface_type), intent(in)  :: surface
      type(grid_type), intent(inout)  :: grid
      integer, allocatable :: all_nodes(:), near(:), element_at(:), point(:), share(:)
      logical, allocatable :: second(:)
      integer :: before, f, i, k

      allocate (element_at(model%mesh%n_nodes), point(model%mesh%n_nodes), source=0) ! element and point of a node
      allocate (share(size(grid%element)), source=0)
      allocate (second(joint%first:joint%last), source=.false.) ! whether an earlier element has the same node
      do i = joint%first, joint%last
         associate (nodes => nodes_of_end(model%joints%element(i), 1), weights => weights_of_end(model%joints%element(i), 1))
            associate (node => nodes(maxloc(weights, dim=1)))
               second(i) = element_at(node) > 0
               if (.not. second(i)) element_at(node) = i
            end associate
         end associate
      end do
      before = grid%n_points
      do f = 1, surface%n
         associate (nodes => surface%nodes(:surface%n_nodes(f), f))
            if (any(element_at(nodes) > 0)) point(nodes) = -1
         end associate
      end do
      all_nodes = nodes_of(surface)
      do k = 1, size(all_nodes)
         if (point(all_nodes(k)) == 0) cycle
         call add_point(all_nodes(k), model%mesh%x(:, all_nodes(k)), grid)
         point(all_nodes(k)) = grid%n_points
      end do
      do f = 1, surface%n
         associate (nodes => surface%nodes(:surface%n_nodes(f), f))
            if (all(element_at(nodes) == 0)) cycle
            do k = 1, size(nodes)
               near = beside(k, surface%corners(f), size(nodes))
               if (element_at(nodes(k)) > 0) near = [k]
               do i = 1, size(near)
                  if (element_at(nodes(near(i))) > 0) &
                     call take(element_at(nodes(near(i))), point(nodes(k)), element_at(nodes(k)) > 0)
               end do
            end do
            call add_cell(point(nodes), surface%corners(f), grid)
         end associate
      end do
      do f = 1, surface%n                                 ! no adjacent element, as at the edge of the other side
         associate (nodes => surface%nodes(:surface%n_nodes(f), f))
            do k = 1, size(nodes)
               if (point(nodes(k)) == 0) cycle
               if (share(point(nodes(k))) > 0) cycle
               i = findloc(element_at(nodes) > 0, .true., dim=1)
               if (i > 0) call take(element_at(nodes(i)), point(nodes(k)), .true.)
            end do
         end associate
      end do
      do k = before + 1, grid%n_points
         grid%values(:, k) = grid%values(:, k)/max(1, share(k))
      end do
      do i = joint%first, joint%last
         if (second(i)) call add_element(model, analysis, i, grid)
      end do

   contains

      !> Give point K the values of element E, its ONLY one or one of several.
      subroutine take(e, k, only)
         integer, intent(in) :: e, k
         logical, intent(in) :: only

         if (only .and. share(k) > 0) return
         if (share(k) == 0) grid%element(k) = e
         share(k) = share(k) + 1
         grid%values(:, k) = grid%values(:, k) + values_of(model, analysis, e)
      end subroutine take

   end subroutine add_faces

   !> The positions among the N nodes of a side from which node K, without an element of its own, takes its values. For a corner
   !! of a second-order side these are the adjacent mid-side nodes, otherwise all nodes.
   pure function beside(k, corners, n) result(near)
      integer, intent(in)  :: k, corners, n
      integer, allocatable :: near(:)
      integer :: i

      near = [(i, i = 1, n)]
      if (n == corners .or. k > corners) return
      near = [n]                                          ! an edge has one mid-side node
      if (corners > 2) near = [corners + k, corners + modulo(k - 2, corners) + 1]
   end function beside

   !> Add interface element I as a point.
   subroutine add_element(model, analysis, i, grid)
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      integer, intent(in)             :: i
      type(grid_type), intent(inout)  :: grid

      associate (nodes => nodes_of_end(model%joints%element(i), 1))
         call add_point(nodes(1), at_first_end(model%joints%element(i), model%mesh%x), grid)
      end associate
      grid%element(grid%n_points) = i
      grid%values(:, grid%n_points) = values_of(model, analysis, i)
      call add_cell([grid%n_points], 1, grid)
   end subroutine add_element

   !> Add a point at X that moves with NODE.
   pure subroutine add_point(node, x, grid)
      integer, intent(in)            :: node
      real(wp), intent(in)           :: x(3)
      type(grid_type), intent(inout) :: grid

      grid%n_points = grid%n_points + 1
      grid%x(:, grid%n_points) = x
      grid%node(grid%n_points) = node
   end subroutine add_point

   !> Add a cell with these POINTS: a vertex, line, triangle or quadrangle with so many CORNERS, or one with mid-side points too.
   pure subroutine add_cell(points, corners, grid)
      integer, intent(in)            :: points(:), corners
      type(grid_type), intent(inout) :: grid
      integer, parameter :: linear(4) = [int(vtk_vertex), 3, 5, 9], quadratic(4) = [0, 21, 22, 23] ! the types of VTK

      grid%corners(grid%n_corners + 1:grid%n_corners + size(points)) = points
      grid%n_corners = grid%n_corners + size(points)
      grid%n_cells = grid%n_cells + 1
      grid%ends(grid%n_cells) = grid%n_corners
      grid%types(grid%n_cells) = int(merge(linear(corners), quadratic(corners), size(points) == corners), int8)
   end subroutine add_cell

   !> The values at the point of interface element I.
   pure function values_of(model, analysis, i) result(values)
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      integer, intent(in)             :: i
      real(wp) :: values(n_values)

      associate (state => analysis%states(i), element => model%joints%element(i))
         values(1:2) = [state%normal%lambda, state%normal%pressure]
         values(3:5) = matmul(element%axes(:, :2), state%shear%tau)
         values(6) = face_distance(state%normal)
         values(7) = merge(1.0_wp, 0.0_wp, state%slips)
         values(8) = element%area
      end associate
   end function values_of

end module vtu_grids
