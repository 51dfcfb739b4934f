!> Marked surfaces: the body elements and the orientation of their sides, and the tributary areas of their nodes.
module surface_build
   use deck_check, only: checked_deck
   use edge_halves, only: half_edge_text
   use element_build, only: marked_side
   use element_kinds, only: element_table, is_second_order, max_side_nodes
   use elasticity, only: plane_stress
   use isoparametric, only: side_areas, side_forces
   use kinds, only: wp
   use lists, only: id_table_type, sorted_order, list_owners
   use mesh_queries, only: element_points, is_shell
   use model_data, only: mesh_type, surface_type
   use shell_element, only: node_thickness
   use surface_sides, only: nodes_of, side_corners
   use text_tools, only: integer_text, one_of
   implicit none
   private

   public :: build_surfaces, find_surface, surface_nodes, side_influence, side_name

   !> The nodes of a surface, each once, in ascending order of their numbers.
   type, public :: surface_node_list
      integer :: n = 0
      integer, allocatable  :: node(:)      !! (n) positions
      real(wp), allocatable :: area(:)      !! (n) tributary areas a_i [length^2]
      real(wp), allocatable :: normal(:, :) !! (3, n) unit normals out of the body
   end type surface_node_list

contains

   !> One surface per PMARK card, with the sides that name it.
   subroutine build_surfaces(deck, sides, mesh)
      type(checked_deck), intent(in)  :: deck
      type(marked_side), intent(in)   :: sides(:)
      type(mesh_type), intent(inout) :: mesh
      type(id_table_type)  :: marks
      integer, allocatable :: surface(:), first(:), members(:), said(:) ! said: missing marks
      character(:), allocatable :: words
      integer :: i, k, most_nodes

      words = ''
      most_nodes = 2*(mesh%dimension - 1)                     ! of a side
      if (any(is_second_order(mesh%element_kind))) most_nodes = merge(3, max_side_nodes, mesh%dimension == 2)
      call marks%build(deck%bulk%pmark%id)
      allocate (mesh%surfaces(size(deck%bulk%pmark)), surface(size(sides)), said(0))
      do i = 1, size(sides)
         surface(i) = marks%find(sides(i)%property)
         if (surface(i) > 0 .or. sides(i)%property <= 0 .or. any(said == sides(i)%property)) cycle
         words = 'there is no PMARK '//integer_text(sides(i)%property)
         k = count(sides%property == sides(i)%property)
         if (k > 1) words = words//' for '//integer_text(k)//' sides'
         if (sides(i)%id < 0) then
            call deck%field_error(sides(i)%line, 'S'//integer_text(-sides(i)%id), words)
         else
            if (sides(i)%corners > 2) words = words//': in a model of space plane elements mark surfaces; '// &
               'plane bodies cannot be mixed with solids; shells need MID2 on their PSHELL' ! the card may be meant as an element
            if (sides(i)%corners == 2) words = words//', nor a PBAR or PBARL'
            call deck%field_error(sides(i)%line, 'PID', words)
         end if
         said = [said, sides(i)%property]
      end do
      call list_owners(size(mesh%surfaces), reshape(surface, [1, size(sides)]), first, members)
      do k = 1, size(mesh%surfaces)
         associate (marked => mesh%surfaces(k), card => deck%bulk%pmark(k), n => first(k + 1) - first(k))
            marked%id = card%id
            allocate (marked%nodes(most_nodes, n), marked%strip(n), source=0)
            allocate (marked%element(n), marked%other(n), marked%line(n), marked%corners(n), marked%n_nodes(n))
            do i = first(k), first(k + 1) - 1
               associate (side => sides(members(i)))
                  if (all(side%nodes(:side%corners) > 0)) call add_side(deck, side, mesh, marked) ! else reported already
               end associate
            end do
            if (marked%n < n) call cut(marked)
            call check_repeated(deck, mesh, marked)
            if (n > 0 .or. card%id == 0 .or. marks%find(card%id) < k) cycle ! a number given twice is reported elsewhere
            words = 'surface '//integer_text(card%id)//' has no '// &
                    one_of(mesh%dimension == 3, 'face: expected a CTRIA3, CQUAD4', 'edge: expected a CBAR, CROD')// &
                    ' or side of a block with this PID'
            if (any([(index(deck%text%files(i)%bytes(:min(200, len(deck%text%files(i)%bytes))), 'Created by Gmsh') > 0, &
                      i = 1, deck%text%n_files)])) words = words// &
               '; Gmsh writes a face once: of two physical groups with the same face only the first has it'
            call deck%field_error(card%line, 'PID', words)
         end associate
      end do
   end subroutine build_surfaces

   !> Cut the arrays of SURFACE to its sides.
   subroutine cut(surface)
      type(surface_type), intent(inout) :: surface

      associate (n => surface%n)
         surface%nodes = surface%nodes(:, :n)
         surface%strip = surface%strip(:n)
         surface%element = surface%element(:n)
         surface%other = surface%other(:n)
         surface%line = surface%line(:n)
         surface%corners = surface%corners(:n)
         surface%n_nodes = surface%n_nodes(:n)
      end associate
   end subroutine cut

   !> The SURFACE of the model with this ID, in FIELD of the card on LINE; 0, and an error, for a missing surface.
   subroutine find_surface(deck, line, field, id, mesh, surface)
      type(checked_deck), intent(in) :: deck
      integer, intent(in)            :: line, id
      character(*), intent(in)       :: field
      type(mesh_type), intent(in) :: mesh
      integer, intent(out)           :: surface

      surface = findloc(mesh%surfaces%id, id, dim=1)
      if (surface == 0) call deck%field_error(line, field, 'there is no PMARK '//integer_text(id))
   end subroutine find_surface

   !> Add SIDE to its surface, in the node order of its element. Of two elements the side belongs to the one with the order of the
   !! card; the other element is behind it.
   subroutine add_side(deck, side, mesh, surface)
      type(checked_deck), intent(in)    :: deck
      type(marked_side), intent(in)     :: side
      type(mesh_type), intent(in) :: mesh
      type(surface_type), intent(inout) :: surface
      integer, allocatable :: side_nodes(:)
      integer :: at, owner, other, found, e, j, own_side
      logical :: same_sense, owner_same

      owner = 0
      other = 0
      own_side = 0
      owner_same = .false.
      associate (nodes => side%nodes(:side%corners))
         do j = mesh%first_at(nodes(1)), mesh%first_at(nodes(1) + 1) - 1
            e = mesh%elements_at(j)
            if (e == owner) cycle ! a corner that is repeated on the card
            call side_of_element(mesh, e, nodes, at, same_sense)
            if (at < 0) cycle
            found = e
            if (owner == 0 .or. (same_sense .and. .not. owner_same)) then
               found = owner
               owner = e
               own_side = at
               owner_same = same_sense
            end if
            if (found > 0) other = found
         end do
         if (owner == 0) then
            call deck%errors%add(side%line, 'the '//side_name(mesh, nodes)//' is no side of a body element'// &
                                 half_edge_text(mesh, nodes))
            return
         end if
         side_nodes = shell_face(mesh, owner, nodes)
      end associate
      if (own_side > 0) then
         associate (kind => element_table(mesh%element_kind(owner)))
            side_nodes = mesh%element_nodes(kind%side_nodes(:kind%side_size(own_side), own_side), owner)
         end associate
         if (any(side_nodes == 0)) return ! reported already
      end if
      if (own_side > 0 .or. size(side_nodes) > side%corners) call check_mark(deck, side, mesh, owner, side_nodes)
      surface%n = surface%n + 1
      surface%line(surface%n) = side%line
      surface%corners(surface%n) = side%corners
      surface%n_nodes(surface%n) = size(side_nodes)
      surface%nodes(:size(side_nodes), surface%n) = side_nodes
      surface%element(surface%n) = owner
      surface%other(surface%n) = other
   end subroutine add_side

   !> The nodes of the face of shell E on the side on which its corners have the order of CORNERS.
   pure function shell_face(mesh, e, corners) result(nodes)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)         :: e, corners(:)
      integer, allocatable :: nodes(:)
      integer :: ends(2), j, k

      nodes = corners
      associate (kind => element_table(mesh%element_kind(e)), of_element => element_points(mesh, e))
         if (kind%n_nodes == kind%n_corners) return
         do k = 1, size(corners)
            ends = [findloc(of_element, corners(k), dim=1), findloc(of_element, corners(modulo(k, size(corners)) + 1), dim=1)]
            do j = 1, kind%n_edges
               if (all(kind%edges(:, j) == ends) .or. all(kind%edges(:, j) == ends([2, 1]))) &
                  nodes = [nodes, of_element(kind%n_corners + j)]
            end do
         end do
      end associate
   end function shell_face

   !> Error: mid-side nodes of SIDE other than SIDE_NODES, those of the side of element E. Gmsh writes the mid-side node of an edge
   !! as X1 of a CBAR.
   subroutine check_mark(deck, side, mesh, e, side_nodes)
      type(checked_deck), intent(in) :: deck
      type(marked_side), intent(in)  :: side
      integer, intent(in)            :: e, side_nodes(:)
      type(mesh_type), intent(in) :: mesh
      character(:), allocatable :: element
      integer :: a, b, k, m, mid, place

      element = 'element '//integer_text(mesh%element_id(e))//', a '//trim(element_table(mesh%element_kind(e))%card)
      m = side%corners
      if (size(side_nodes) == m .and. side%n_nodes > m) then
         if (m == 2) then
            call deck%field_error(side%line, 'X1', 'a node, as the middle of the edge, but the edge is one of '// &
                                  element//', which is linear; expected a real number, or blank')
         else
            call deck%errors%add(side%line, 'face '//integer_text(side%id)//' has mid-side nodes, but is one of '// &
                                 element//', which is linear; expected its corners alone')
         end if
         return
      end if
      do k = 1, side%n_nodes - m
         if (side%nodes(m + k) == 0) cycle ! blank: the node of the element; or reported already
         a = findloc(side_nodes(:m), side%nodes(k), dim=1)
         b = findloc(side_nodes(:m), side%nodes(modulo(k, m) + 1), dim=1)
         place = merge(a, b, modulo(a, m) + 1 == b) ! the mark may have the opposite sense
         if (m == 2) place = 1
         mid = side_nodes(m + place)
         if (mid == side%nodes(m + k)) cycle
         call deck%field_error(side%line, 2 + m + k, integer_text(mesh%node_id(side%nodes(m + k)))//', but '// &
                               element//', has node '//integer_text(mesh%node_id(mid))//' at the middle of this edge')
         return
      end do
   end subroutine check_mark

   !> Text that names a side by its nodes.
   pure function side_name(mesh, nodes) result(words)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)          :: nodes(:)
      character(:), allocatable    :: words
      integer :: k

      words = one_of(size(nodes) == 2, 'edge between nodes', 'face of nodes')
      do k = 1, size(nodes)
         if (k == size(nodes)) words = words//' and'
         words = words//' '//integer_text(mesh%node_id(nodes(k)))
         if (k < size(nodes) - 1) words = words//','
      end do
   end function side_name

   !> The SIDE of element E with the corners NODES, in any order; 0: the face of a shell; -1: none. SAME_SENSE: NODES have the
   !! cyclic order of the element.
   pure subroutine side_of_element(mesh, e, nodes, side, same_sense)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)          :: e, nodes(:)
      integer, intent(out)         :: side
      logical, intent(out)         :: same_sense
      integer :: at, k

      do side = merge(0, 1, is_shell(mesh, e)), element_table(mesh%element_kind(e))%n_sides
         associate (corners => side_corners(mesh, e, side), n => size(nodes))
            if (size(corners) /= n) cycle
            if (any([(all(corners /= nodes(k)) .or. all(nodes /= corners(k)), k = 1, n)])) cycle
            at = findloc(corners, nodes(1), dim=1)
            same_sense = at == 1
            if (n > 2) same_sense = corners(modulo(at, n) + 1) == nodes(2)
            return
         end associate
      end do
      side = -1
      same_sense = .false.
   end subroutine side_of_element

   !> Error: a side that occurs twice in a surface, so that its area would count twice.
   subroutine check_repeated(deck, mesh, surface)
      type(checked_deck), intent(in) :: deck
      type(mesh_type), intent(in) :: mesh
      type(surface_type), intent(in) :: surface
      integer, allocatable :: order(:), lowest(:)
      integer :: j, k, m

      allocate (lowest(surface%n))
      do k = 1, surface%n
         lowest(k) = minval(surface%nodes(:surface%corners(k), k))
      end do
      call sorted_order(lowest, order)
      do k = 2, surface%n
         do j = k - 1, 1, -1
            if (lowest(order(k)) /= lowest(order(j))) exit
            if (surface%corners(order(k)) /= surface%corners(order(j))) cycle
            associate (corners => surface%nodes(:surface%corners(order(k)), order(k)), &
                       corners_before => surface%nodes(:surface%corners(order(j)), order(j)))
               if (any([(all(corners_before /= corners(m)), m = 1, size(corners))])) cycle
               call deck%errors%add(max(surface%line(order(k)), surface%line(order(j))), 'surface '//integer_text(surface%id)// &
                  ': the '//side_name(mesh, corners)//' is marked twice')
            end associate
         end do
      end do
   end subroutine check_repeated

   !> Tributary areas of the nodes of side S of SURFACE, a_i = integral of N_i over the side [length^2] (section 4.1).
   pure subroutine side_influence(mesh, surface, s, area, normal)
      type(mesh_type), intent(in) :: mesh
      type(surface_type), intent(in) :: surface
      integer, intent(in)            :: s
      real(wp), intent(out)          :: area(max_side_nodes)        !! 0 behind the last node
      real(wp), intent(out)          :: normal(3, max_side_nodes)   !! integral of N_i times the outward normal [length^2]
      real(wp) :: force(mesh%dimension, max_side_nodes)
      integer  :: n

      area = 0.0_wp
      normal = 0.0_wp
      n = surface%n_nodes(s)
      if (mesh%element_property(surface%element(s)) == 0) return ! reported already
      associate (property => mesh%properties(mesh%element_property(surface%element(s))), &
                 x => mesh%x(:mesh%dimension, surface%nodes(:n, s)))
         if (mesh%dimension == 3 .and. surface%corners(s) == 2) then
            call edge_areas(mesh, surface%element(s), surface%nodes(:n, s), area)
            return
         end if
         call side_areas(property%state, property%thickness, x, area)
         call side_forces(property%state, property%thickness, x, spread(-1.0_wp, 1, n), force)
      end associate
      normal(:mesh%dimension, :n) = force(:, :n)
   end subroutine side_influence

   !> Tributary areas of the NODES of an edge of shell E, before shell_faces cuts it into strips: the integral of N_i along the edge
   !! times the thickness at the node.
   pure subroutine edge_areas(mesh, e, nodes, area)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)         :: e, nodes(:)
      real(wp), intent(inout)     :: area(:)     !! (nodes) [length^2], set here
      real(wp) :: flat(2, size(nodes)), thickness(max_side_nodes)
      integer  :: k

      associate (points => element_points(mesh, e), law => mesh%structural%shells(mesh%structural%place(e)), &
                 along => mesh%x(:, nodes(2)) - mesh%x(:, nodes(1)))
         thickness(:size(points)) = node_thickness(law, size(points))
         do k = 1, size(nodes) ! in the plane of the edge
            associate (from_first => mesh%x(:, nodes(k)) - mesh%x(:, nodes(1)))
               flat(1, k) = dot_product(from_first, along)/norm2(along)
               flat(2, k) = norm2(from_first - flat(1, k)/norm2(along)*along)
            end associate
         end do
         call side_areas(plane_stress, 1.0_wp, flat, area)
         do k = 1, size(nodes)
            area(k) = area(k)*thickness(findloc(points, nodes(k), dim=1))
         end do
      end associate
   end subroutine edge_areas

   !> The nodes of SURFACE with their tributary areas, summed over the sides at a node, and their normals, the mean of the sides
   !! weighted by area.
   pure subroutine surface_nodes(mesh, surface, list)
      type(mesh_type), intent(in) :: mesh
      type(surface_type), intent(in)       :: surface
      type(surface_node_list), intent(out) :: list
      type(id_table_type) :: place
      real(wp) :: area(max_side_nodes), normal(3, max_side_nodes)
      integer  :: s, k, node

      list%node = nodes_of(surface)
      list%n = size(list%node)
      call place%build(list%node)
      allocate (list%area(list%n), source=0.0_wp)
      allocate (list%normal(3, list%n), source=0.0_wp)
      do s = 1, surface%n
         call side_influence(mesh, surface, s, area, normal)
         if (mesh%dimension == 3 .and. surface%n_nodes(s) > surface%corners(s)) & ! that of a corner may be zero or reversed
            normal = spread(sum(normal, dim=2), 2, max_side_nodes)
         do k = 1, surface%n_nodes(s)
            node = place%find(surface%nodes(k, s))
            list%area(node) = list%area(node) + area(k)
            list%normal(:, node) = list%normal(:, node) + normal(:, k)
         end do
      end do
      do k = 1, list%n
         list%normal(:, k) = list%normal(:, k)/max(norm2(list%normal(:, k)), tiny(1.0_wp))
      end do
   end subroutine surface_nodes

end module surface_build
