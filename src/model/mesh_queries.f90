!> What is asked about a mesh: its points and the nodes that follow them, the points and the kinds of its elements.
module mesh_queries
   use element_kinds, only: element_table, kind_edge2
   use model_data, only: a_point, a_rotation, an_overlap, mesh_type, n_sections
   implicit none
   private

   public :: n_points, n_rotations, node_kind, place_in_kind, point_of, element_points, is_shell, is_beam, is_face_node

contains

   !> The number of points of the structure. The nodes of rotations and sections follow the points.
   pure integer function n_points(mesh)
      type(mesh_type), intent(in) :: mesh

      n_points = mesh%n_nodes - n_sections(mesh) - n_rotations(mesh)
   end function n_points

   !> The number of nodes of rotations.
   pure integer function n_rotations(mesh)
      type(mesh_type), intent(in) :: mesh

      n_rotations = 0
      if (allocated(mesh%rotations)) n_rotations = size(mesh%rotations)
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
      if (allocated(mesh%structural%place)) is_shell = mesh%structural%place(e) > 0 .and. mesh%element_kind(e) /= kind_edge2
   end function is_shell

   !> Whether element E is a beam.
   pure logical function is_beam(mesh, e)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)          :: e

      is_beam = mesh%element_kind(e) == kind_edge2
   end function is_beam

   !> Whether NODE is a face node of shells.
   pure logical function is_face_node(mesh, node)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)          :: node

      is_face_node = .false.
      if (.not. allocated(mesh%face_of)) return
      if (node <= size(mesh%face_of)) is_face_node = mesh%face_of(node) > 0
   end function is_face_node

end module mesh_queries
