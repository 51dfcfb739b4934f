!> What is asked about a mesh: its points and the nodes that follow them, the points and the kinds of its elements.
!! A mesh and its freedoms start with empty lists: a list of size 0 says that there are none, or that no node has such a value.
module mesh_queries
   use element_kinds, only: element_table, kind_edge2
   use model_data, only: a_point, a_rotation, an_overlap, freedoms_type, mesh_type, model_type, n_sections
   implicit none
   private

   public :: start_mesh, start_freedoms, start_parts, open_left_out, shown_number
   public :: n_points, n_rotations, node_kind, place_in_kind, point_of, element_points, is_shell, is_beam, is_face_node, &
             own_column, is_scalar_point

contains

   !> The number of NODE in messages: that of the first NODEAT that names it, else its own.
   pure integer function shown_number(mesh, node) result(number)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)         :: node
      integer :: k

      number = mesh%node_id(node)
      k = findloc(mesh%placed%id > 0 .and. mesh%placed%node == node, .true., dim=1)
      if (k > 0) number = mesh%placed(k)%id
   end function shown_number

   !> Start MESH: the lists that a deck need not fill are empty.
   pure subroutine start_mesh(mesh)
      type(mesh_type), intent(inout) :: mesh

      allocate (mesh%properties(0), mesh%bars(0), mesh%masses(0), mesh%sections(0), mesh%rotations(0), mesh%faces(0), &
                mesh%placed(0), mesh%middles(5, 0))
      allocate (mesh%structural%place(0), mesh%structural%shells(0), mesh%structural%beams(0))
      allocate (mesh%duplicate(0), mesh%node_system(0), mesh%is_scalar(0), mesh%face_of(0), mesh%rotation_of(0), &
                mesh%node_section(0), &
                mesh%element_section(0))
   end subroutine start_mesh

   !> Start FREEDOMS: nothing is coupled or left out.
   pure subroutine start_freedoms(freedoms)
      type(freedoms_type), intent(inout) :: freedoms

      allocate (freedoms%left_out(0, 0), freedoms%coupling%of_node(0), freedoms%coupling%node(0), freedoms%coupling%t(0, 0, 0))
      allocate (freedoms%coupling%first(1), source=1)
   end subroutine start_freedoms

   !> Start the mesh and the freedoms of MODEL.
   pure subroutine start_parts(model)
      type(model_type), intent(inout) :: model

      call start_mesh(model%mesh)
      call start_freedoms(model%freedoms)
   end subroutine start_parts

   !> From now on LEFT_OUT has a value for every component; none is left out yet. Nothing where it has them already.
   pure subroutine open_left_out(mesh, freedoms)
      type(mesh_type), intent(in)        :: mesh
      type(freedoms_type), intent(inout) :: freedoms

      if (size(freedoms%left_out) == 0) freedoms%left_out = spread(spread(.false., 1, mesh%dimension), 2, mesh%n_nodes)
   end subroutine open_left_out

   !> The number of points of the structure. The nodes of rotations and sections follow the points.
   pure integer function n_points(mesh)
      type(mesh_type), intent(in) :: mesh

      n_points = mesh%n_nodes - n_sections(mesh) - n_rotations(mesh)
   end function n_points

   !> The number of nodes of rotations.
   pure integer function n_rotations(mesh)
      type(mesh_type), intent(in) :: mesh

      n_rotations = size(mesh%rotations)
   end function n_rotations

   !> The kind of the unknowns of NODE. The nodes of rotations follow the points, the nodes of sections follow those.
   pure integer function node_kind(mesh, node) result(kind)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)          :: node

      kind = a_point
      if (node > n_points(mesh)) kind = a_rotation
      if (node > n_points(mesh) + n_rotations(mesh)) kind = an_overlap
   end function node_kind

   !> The position of NODE in its kind: itself for a point, else in model%mesh%rotations or model%mesh%sections.
   pure integer function place_in_kind(mesh, node) result(place)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)          :: node

      place = node
      if (node_kind(mesh, node) /= a_point) place = place - n_points(mesh)
      if (node_kind(mesh, node) == an_overlap) place = place - n_rotations(mesh)
   end function place_in_kind

   !> The point to which the rotations NODE belong; a point gives itself.
   pure integer function point_of(mesh, node) result(point)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)          :: node

      point = node
      if (node_kind(mesh, node) == a_rotation) point = mesh%rotations(place_in_kind(mesh, node))%point
   end function point_of

   !> The points of the geometry of element E, corners first: the nodes on its card. Those of its unknowns: element_unknowns.
   pure function element_points(mesh, e) result(nodes)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)          :: e
      integer :: nodes(element_table(mesh%element_kind(e))%n_nodes)

      nodes = mesh%element_nodes(:size(nodes), e)
   end function element_points

   !> Whether element E is a shell.
   pure logical function is_shell(mesh, e)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)          :: e

      is_shell = .false.
      if (size(mesh%structural%place) > 0) is_shell = mesh%structural%place(e) > 0 .and. mesh%element_kind(e) /= kind_edge2
   end function is_shell

   !> Whether element E is a beam.
   pure logical function is_beam(mesh, e)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)          :: e

      is_beam = mesh%element_kind(e) == kind_edge2
   end function is_beam

   !> The column of a shell or beam E in the temperatures of elements; bar i has that behind the beams and i - 1 bars.
   pure integer function own_column(mesh, e)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)         :: e

      own_column = mesh%structural%place(e) + merge(size(mesh%structural%shells), 0, is_beam(mesh, e))
   end function own_column

   !> Whether NODE is a face node of shells.
   pure logical function is_face_node(mesh, node)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)          :: node

      is_face_node = .false.
      if (node <= size(mesh%face_of)) is_face_node = mesh%face_of(node) > 0
   end function is_face_node

   !> Whether NODE is a scalar point, whose first component alone exists.
   pure logical function is_scalar_point(mesh, node)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)          :: node

      is_scalar_point = .false.
      if (node <= size(mesh%is_scalar)) is_scalar_point = mesh%is_scalar(node)
   end function is_scalar_point

end module mesh_queries
