!> Nodes on the faces and edges of shells, at rigid levers from the nodes of the shells.
!! A marked surface of shells lies half a thickness off their mean plane, on the side to which the normals of the marking elements
!! point. A marked edge of shells is as wide as the thickness and is cut into strips; those of an edge with a mid-side node are
!! faces of eight nodes. The nodes of such sides have rigid levers r from the nodes of the shells and no unknowns of their own:
!! u + theta x r. Joints, gaps and pressure use them as they use other
!! nodes. Masses with an offset and bushes between nodes apart have such nodes too.
module shell_faces
   use bulk_data, only: mass_card
   use bush_build, only: add_ends, bush_type
   use deck_check, only: checked_deck
   use displacement_systems, only: find_directions
   use element_kinds, only: max_side_nodes
   use kinds, only: wp
   use mesh_queries, only: element_points, is_shell, open_left_out
   use model_data, only: face_node_type, freedoms_type, mesh_type, surface_type
   use node_build, only: append_nodes
   use node_coupling, only: couple_node, transformation, unknown_nodes
   use numbers, only: by_rotation, cross
   use shell_element, only: node_normal, node_thickness
   use text_tools, only: integer_text
   use unknowns, only: third_axis
   implicit none
   private

   public :: build_shell_faces, couple_shell_faces, mass_offset

   integer, parameter :: strips = 8 ! over the thickness at an edge: equal strips overestimate the inertia by 2/strips^2
   !> The node of a strip that stands off node 1, 2, and 3, at the middle, of the edge, on the lower, middle and upper line.
   integer, parameter :: place(3, 3) = reshape([1, 8, 4, 2, 6, 3, 5, 0, 7], [3, 3])

contains

   !> The offset of the centre of the mass CARD from its node at X; with CID -1 the card has the centre itself, in basic axes.
   pure function mass_offset(card, x) result(offset)
      type(mass_card), intent(in) :: card
      real(wp), intent(in)        :: x(3)
      real(wp) :: offset(3)

      offset = card%offset
      if (card%system < 0) offset = card%offset - x
   end function mass_offset

   !> Give the sides of shells in marked surfaces nodes of their own, and masses with an offset.
   subroutine build_shell_faces(deck, mesh, bushes)
      type(checked_deck), intent(in)  :: deck
      type(mesh_type), intent(inout) :: mesh
      type(bush_type), intent(inout) :: bushes(:) !! the ends of their arms are faces too
      type(face_node_type), allocatable :: faces(:)
      real(wp) :: axes(3, 3)
      integer  :: i, k, n
      logical  :: ok

      allocate (faces(0))
      do k = 1, size(deck%bulk%mass) ! the centre of mass of a CONM2 with an offset has a rigid lever from its node, as faces have
         associate (card => deck%bulk%mass(k))
            n = mesh%node_table%find(card%node)
            if (n == 0) cycle
            if (all(abs(mass_offset(card, mesh%x(:, n))) <= 0.0_wp)) cycle
            call find_directions(deck, mesh%systems, card%line, max(card%system, 0), mesh%x(:, n), axes, ok)
            faces = [faces, face_node_type(point=n, lever=matmul(axes, mass_offset(card, mesh%x(:, n))))]
         end associate
      end do
      call add_ends(bushes, faces)
      do k = 1, size(mesh%surfaces)
         associate (surface => mesh%surfaces(k))
            if (.not. any([(is_shell(mesh, surface%element(n)), n = 1, surface%n)])) cycle
            do n = 1, surface%n
               if (surface%other(n) == 0) cycle
               call deck%errors%add(surface%line(n), 'surface '//integer_text(surface%id)// &
                  ': a joint cannot lie on an edge between two shells; expected a free edge')
               return
            end do
            call offset_sides(mesh, surface, faces)
         end associate
      end do
      if (size(faces) == 0) return
      ! the nodes of the faces follow those of the deck, with the elements of the shell nodes, which give their material
      n = mesh%n_nodes
      faces%node = [(n + k, k = 1, size(faces))]
      mesh%elements_at = [mesh%elements_at, ((mesh%elements_at(i), i = mesh%first_at(faces(k)%point), &
                                                mesh%first_at(faces(k)%point + 1) - 1), k = 1, size(faces))]
      mesh%first_at = [mesh%first_at, spread(0, 1, size(faces))]
      do k = 1, size(faces)
         associate (point => faces(k)%point)
            mesh%first_at(n + k + 1) = mesh%first_at(n + k) + mesh%first_at(point + 1) - mesh%first_at(point)
         end associate
      end do
      call append_nodes(mesh, mesh%x(:, faces%point) + reshape([(faces(k)%lever, k = 1, size(faces))], [3, size(faces)]))
      mesh%face_of = [spread(0, 1, n), [(k, k = 1, size(faces))]]
      call move_alloc(faces, mesh%faces)
   end subroutine build_shell_faces

   !> Give the sides of SURFACE that belong to shells nodes among FACES; a shared node has the mean lever of its sides. The lines of the
   !! strips at a node count along UP, the normal of the first shell there, because the next shell may be numbered clockwise.
   subroutine offset_sides(mesh, surface, faces)
      type(mesh_type), intent(in) :: mesh
      type(surface_type), intent(inout) :: surface
      type(face_node_type), allocatable, intent(inout) :: faces(:)
      type(face_node_type), allocatable :: added(:)
      integer, allocatable :: n_of(:), of_node(:, :)
      integer  :: at, c, i, line, n, nodes(max_side_nodes), row, s
      real(wp) :: normal(3), side, t(max_side_nodes), up(3, mesh%n_nodes)

      call cut_edges(surface)
      allocate (added(max_side_nodes*surface%n), of_node(0:2*strips, mesh%n_nodes))
      allocate (n_of(max_side_nodes*surface%n), source=0)
      of_node = 0
      up = 0.0_wp
      n = 0
      do s = 1, surface%n
         if (.not. is_shell(mesh, surface%element(s))) cycle
         c = count(surface%nodes(:, s) > 0)
         row = surface%strip(s)
         nodes(:c) = surface%nodes(:c, s)
         associate (corners => element_points(mesh, surface%element(s)), &
                    law => mesh%structural%shells(mesh%structural%place(surface%element(s))))
            side = sign(0.5_wp, dot_product(node_normal(mesh%x(:, corners), 1), &
                                            cross(mesh%x(:, nodes(2)) - mesh%x(:, nodes(1)), &
                                                  mesh%x(:, nodes(surface%corners(s))) - mesh%x(:, nodes(1)))))
            t(:size(corners)) = node_thickness(law, size(corners))
            do i = 1, c
               at = findloc(corners, nodes(i), dim=1)
               normal = node_normal(mesh%x(:, corners), at)
               if (row == 0) then
                  call take(0, nodes(i), (law%offset + side*t(at))*normal, surface%nodes(i, s))
               else ! lines half a strip apart
                  if (all(abs(up(:, nodes(i))) <= 0.0_wp)) up(:, nodes(i)) = normal
                  do line = 2*row - 2, 2*row
                     associate (k => place(line - 2*row + 3, i))
                        if (k > merge(4, 8, c == 2) .or. k == 0) cycle
                        call take(merge(line, 2*strips - line, dot_product(up(:, nodes(i)), normal) >= 0.0_wp), nodes(i), &
                                  (law%offset + t(at)*(0.5_wp*line/strips - 0.5_wp))*normal, surface%nodes(k, s))
                     end associate
                  end do
               end if
            end do
         end associate
         if (row > 0) surface%corners(s) = 4
         surface%n_nodes(s) = merge(merge(4, 8, c == 2), c, row > 0)
      end do
      do i = 1, n
         added(i)%lever = added(i)%lever/n_of(i)
      end do
      faces = [faces, added(:n)]

   contains

      !> AT is the face node that stands off NODE on LINE of the strips; add LEVER to its mean.
      subroutine take(line, node, lever, at)
         integer, intent(in)    :: line, node
         real(wp), intent(in)   :: lever(3)
         integer, intent(inout) :: at

         if (of_node(line, node) == 0) then
            n = n + 1
            of_node(line, node) = n
            added(n)%point = node
         end if
         associate (face => of_node(line, node))
            added(face)%lever = added(face)%lever + lever
            n_of(face) = n_of(face) + 1
            at = mesh%n_nodes + size(faces) + face
         end associate
      end subroutine take

   end subroutine offset_sides

   !> Repeat every edge of SURFACE once per strip over the thickness.
   pure subroutine cut_edges(surface)
      type(surface_type), intent(inout) :: surface
      integer, allocatable :: from(:), strip(:)
      integer :: k, s

      associate (copies => merge(strips, 1, surface%corners(:surface%n) == 2))
         if (all(copies == 1)) return
         allocate (from(0), strip(0))
         do s = 1, surface%n
            from = [from, spread(s, 1, copies(s))]
            strip = [strip, [(k, k = 1, copies(s))]]
         end do
      end associate
      surface%n = size(from)
      surface%nodes = surface%nodes(:, from)
      surface%corners = surface%corners(from)
      surface%n_nodes = surface%n_nodes(from)
      surface%element = surface%element(from)
      surface%other = surface%other(from)
      surface%line = surface%line(from)
      surface%strip = merge(strip, 0, surface%corners == 2)
   end subroutine cut_edges

   !> Couple the face nodes to the nodes from which they stand off, or to the masters of these: u + theta x lever.
   subroutine couple_shell_faces(mesh, freedoms)
      type(mesh_type), intent(in) :: mesh
      type(freedoms_type), intent(inout) :: freedoms
      real(wp), allocatable :: t(:, :, :)
      real(wp) :: w(mesh%dimension, mesh%dimension)
      integer  :: d, j, k

      if (size(mesh%faces) == 0) return
      d = mesh%dimension
      call open_left_out(mesh, freedoms)
      do k = 1, size(mesh%faces)
         associate (face => mesh%faces(k), rotation => mesh%rotations(mesh%rotation_of(mesh%faces(k)%point)), &
                    lever => mesh%faces(k)%lever)
            if (d == 3) w = by_rotation(lever)/rotation%arm
            if (d == 2) w = sum(third_axis(mesh, face%point))/rotation%arm*reshape([-lever(2), lever(1), 0.0_wp, 0.0_wp], [2, 2])
            associate (masters => unknown_nodes(freedoms, [face%point, rotation%node]), &
                       both => transformation(mesh, freedoms, [face%point, rotation%node]))
               allocate (t(d, d, size(masters)))
               do j = 1, size(masters)
                  associate (of_master => both(:, d*(j - 1) + 1:d*j))
                     t(:, :, j) = of_master(:d, :) + matmul(w, of_master(d + 1:, :))
                  end associate
               end do
               call couple_node(freedoms%coupling, mesh%n_nodes, face%node, masters, t)
               deallocate (t)
            end associate
            freedoms%left_out(:, face%node) = .true.
            freedoms%held(:, face%node) = .true.
         end associate
      end do
   end subroutine couple_shell_faces

end module shell_faces
