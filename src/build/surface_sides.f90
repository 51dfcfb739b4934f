!> Topology of sides and marked surfaces: corners, sides at each node, orientation, elements behind, and split surfaces.
!! If bodies on both sides of a surface with a joint share its nodes, the nodes are doubled to make room for interface elements.
module surface_sides
   use deck_check, only: checked_deck
   use element_kinds, only: element_table
   use lists, only: distinct, id_table_type, join, list_owners, root_of
   use model_data, only: mesh_type, surface_type
   use node_build, only: append_nodes
   use text_tools, only: integer_text
   implicit none
   private

   public :: side_corners, nodes_of, list_sides, reverse_side, orient_sides, elements_behind, split_shared_surfaces

   !> The sides of a surface at every node of it: side(first(k):first(k + 1) - 1) at node(k).
   type, public :: side_list
      integer :: n = 0                             !! number of nodes
      integer, allocatable :: node(:)              !! (n) positions in the model, ascending
      integer, allocatable :: first(:)             !! (n + 1)
      integer, allocatable :: side(:)
      type(id_table_type), private :: place        ! position of a node in NODE
   end type side_list

contains

   !> The corners of side S of element E, counter-clockwise as seen from outside; 0: the face of a shell along its normal.
   pure function side_corners(mesh, e, s) result(nodes)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)          :: e, s
      integer, allocatable :: nodes(:)

      associate (kind => element_table(mesh%element_kind(e)))
         if (s == 0) nodes = mesh%element_nodes(:kind%n_corners, e)
         if (s > 0) nodes = mesh%element_nodes(kind%side_nodes(:kind%side_corners(s), s), e)
      end associate
   end function side_corners

   !> The nodes of SURFACE, each once, in ascending order.
   pure function nodes_of(surface) result(nodes)
      type(surface_type), intent(in) :: surface
      integer, allocatable :: nodes(:)

      call distinct(pack(surface%nodes(:, :surface%n), surface%nodes(:, :surface%n) > 0), nodes)
   end function nodes_of

   !> The sides of SURFACE at every node.
   pure subroutine list_sides(surface, at)
      type(surface_type), intent(in) :: surface
      type(side_list), intent(out)   :: at
      integer, allocatable :: places(:, :)
      integer :: i, k

      at%node = nodes_of(surface)
      at%n = size(at%node)
      call at%place%build(at%node)
      allocate (places(size(surface%nodes, 1), surface%n), source=0)
      do i = 1, surface%n
         do k = 1, surface%n_nodes(i)
            places(k, i) = at%place%find(surface%nodes(k, i))
         end do
      end do
      call list_owners(at%n, places, at%first, at%side)
   end subroutine list_sides

   !> Reverse SIDE of SURFACE: it becomes a side of the element behind it.
   pure subroutine reverse_side(surface, side)
      type(surface_type), intent(inout) :: surface
      integer, intent(in)               :: side
      integer :: element, m

      m = surface%corners(side)
      associate (nodes => surface%nodes(:, side))
         nodes(:m) = nodes(m:1:-1)
         if (surface%n_nodes(side) == 2*m) nodes(m + 1:2*m - 1) = nodes(2*m - 1:m + 1:-1) ! the last one closes the ring
      end associate
      element = surface%element(side)
      surface%element(side) = surface%other(side)
      surface%other(side) = element
   end subroutine reverse_side

   !> Reverse sides of SURFACE until neighbours have a consistent orientation: the same body on the left of all edges, inside all
   !! faces.
   pure subroutine orient_sides(surface, at)
      type(surface_type), intent(inout) :: surface
      type(side_list), intent(in)       :: at !! of SURFACE
      integer, allocatable :: queue(:)
      logical, allocatable :: done(:)
      integer :: side, first, i, k, n, last, other, place

      allocate (done(surface%n), queue(surface%n))
      done = .false.
      do first = 1, surface%n
         if (done(first)) cycle
         queue(1) = first
         done(first) = .true.
         n = 0
         last = 1
         do while (n < last)
            n = n + 1
            side = queue(n)
            do k = 1, surface%corners(side)
               place = at%place%find(surface%nodes(k, side))
               do i = at%first(place), at%first(place + 1) - 1
                  other = at%side(i)
                  if (done(other)) cycle
                  select case (common_sense(surface, side, k, other))
                  case (0)
                     cycle
                  case (1)
                     call reverse_side(surface, other)
                  end select
                  done(other) = .true.
                  last = last + 1
                  queue(last) = other
               end do
            end do
         end do
      end do
   end subroutine orient_sides

   !> How side OTHER shares corner K of SIDE (in the plane the node, of a face the edge to the next corner): 0 not shared,
   !! 1 shared in the same sense, which is inconsistent, -1 in the opposite sense.
   pure integer function common_sense(surface, side, k, other) result(sense)
      type(surface_type), intent(in) :: surface
      integer, intent(in)            :: side, k, other
      integer :: at, n, next

      n = surface%corners(other)
      at = findloc(surface%nodes(:n, other), surface%nodes(k, side), dim=1)
      sense = 0
      if (n == 2) then
         sense = merge(1, -1, at == k) ! both begin here, or both end here
      else
         next = surface%nodes(modulo(k, surface%corners(side)) + 1, side)
         if (surface%nodes(modulo(at, n) + 1, other) == next) sense = 1
         if (surface%nodes(modulo(at - 2, n) + 1, other) == next) sense = -1
      end if
   end function common_sense

   !> The elements BEHIND surface S at its node K: those connected to the back of a side at this node without crossing the
   !! surface. None if they are also connected to the front.
   pure subroutine elements_behind(mesh, s, at, k, behind)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)               :: s
      type(side_list), intent(in)       :: at        !! its sides at its nodes
      integer, intent(in)               :: k
      integer, allocatable, intent(out) :: behind(:)
      integer, allocatable :: around(:), parent(:)
      logical, allocatable :: in_front(:), at_back(:) ! sets of connected elements
      integer :: i, j

      allocate (around, source=mesh%elements_at(mesh%first_at(at%node(k)):mesh%first_at(at%node(k) + 1) - 1))
      allocate (in_front(size(around)), at_back(size(around)), source=.false.)
      allocate (parent, source=[(i, i=1, size(around))])
      do i = 1, size(around)
         do j = 1, i - 1
            if (common_side(mesh, s, at, k, around(i), around(j))) call join(parent, i, j)
         end do
      end do
      do i = at%first(k), at%first(k + 1) - 1
         in_front(root_of(parent, findloc(around, mesh%surfaces(s)%element(at%side(i)), dim=1))) = .true.
         at_back(root_of(parent, findloc(around, mesh%surfaces(s)%other(at%side(i)), dim=1))) = .true.
      end do
      behind = [integer ::]
      if (.not. any(in_front .and. at_back)) behind = pack(around, [(at_back(root_of(parent, i)), i = 1, size(around))])
   end subroutine elements_behind

   !> Whether elements A and B share a side at node PLACE of surface S that does not belong to S.
   pure logical function common_side(mesh, s, at, place, a, b)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)          :: s, place, a, b
      type(side_list), intent(in)  :: at
      integer :: common(size(mesh%element_nodes, 1)), i, k, n

      n = 0
      do k = 1, element_table(mesh%element_kind(a))%n_corners ! elements that share only an edge also share its mid-edge node
         if (all(mesh%element_nodes(:, b) /= mesh%element_nodes(k, a))) cycle
         n = n + 1
         common(n) = mesh%element_nodes(k, a)
      end do
      common_side = n >= mesh%dimension
      do i = at%first(place), at%first(place + 1) - 1
         if (.not. common_side) return
         associate (side => mesh%surfaces(s)%nodes(:mesh%surfaces(s)%corners(at%side(i)), at%side(i)))
            common_side = any([(all(side /= common(k)), k = 1, n)])
         end associate
      end do
   end function common_side

   !> Split the shared surfaces that JOINT cards name as SIDE1 without a SIDE2. The elements on the left of the
   !! edges, or inside the faces, keep the nodes; those behind get the duplicates, numbered from the highest node number on.
   subroutine split_shared_surfaces(deck, mesh)
      type(checked_deck), intent(in)  :: deck
      type(mesh_type), intent(inout) :: mesh
      type(id_table_type)  :: surfaces
      type(side_list)      :: at
      integer, allocatable :: behind(:), element_nodes(:, :)
      integer, allocatable :: split(:) ! nodes with a duplicate
      integer :: j, k, n_duplicates, node, s

      mesh%duplicate = spread(0, 1, mesh%n_nodes)
      call surfaces%build(mesh%surfaces%id)
      n_duplicates = 0
      do j = 1, size(deck%bulk%joint)
         if (deck%bulk%joint(j)%sides(2) /= 0) cycle
         s = surfaces%find(deck%bulk%joint(j)%sides(1))
         if (s == 0) cycle
         associate (surface => mesh%surfaces(s), line => deck%bulk%joint(j)%line, nodes => nodes_of(mesh%surfaces(s)))
            if (.not. any(surface%other(:surface%n) > 0)) cycle
            if (any(surface%other(:surface%n) == 0)) then
               call deck%field_error(line, 'SIDE1', 'bodies lie on both sides of some '//merge('edges', 'faces', &
                  mesh%dimension == 2)//' of surface '//integer_text(surface%id)//' and on one side of others')
               cycle
            end if
            if (any(mesh%duplicate(nodes) > 0)) then
               node = nodes(findloc(mesh%duplicate(nodes) > 0, .true., dim=1))
               call deck%field_error(line, 'SIDE1', 'surface '//integer_text(surface%id)//' meets another surface that is '// &
                  'split, at node '//integer_text(mesh%node_id(node))//': mesh the bodies apart there and give both '// &
                  'faces, SIDE1 and SIDE2')
               cycle
            end if
         end associate
         ! the elements behind the surface get duplicates of its nodes; the model keeps its nodes until all these elements are known
         call list_sides(mesh%surfaces(s), at)
         call orient_sides(mesh%surfaces(s), at)
         allocate (element_nodes, source=mesh%element_nodes)
         do k = 1, at%n
            call elements_behind(mesh, s, at, k, behind)
            if (size(behind) == 0) cycle ! the edge of the surface inside a body is not split
            n_duplicates = n_duplicates + 1
            mesh%duplicate(at%node(k)) = mesh%n_nodes + n_duplicates
            where (element_nodes(:, behind) == at%node(k)) element_nodes(:, behind) = mesh%n_nodes + n_duplicates
         end do
         call move_alloc(element_nodes, mesh%element_nodes)
         mesh%surfaces(s)%other = 0
         mesh%surfaces(s)%was_split = .true.
      end do
      if (n_duplicates == 0) return
      if (mesh%node_id(mesh%n_nodes) > huge(1) - n_duplicates) call deck%errors%add(0, 'the doubled nodes of split surfaces '// &
         'get numbers above node '//integer_text(mesh%node_id(mesh%n_nodes))// &
         ', and their numbers would exceed 2147483647')
      split = pack([(k, k = 1, mesh%n_nodes)], mesh%duplicate > 0)
      split(mesh%duplicate(split) - mesh%n_nodes) = split ! in the order of the duplicates
      call append_nodes(mesh, mesh%x(:, split))
      call list_owners(mesh%n_nodes, mesh%element_nodes, mesh%first_at, mesh%elements_at)
      do s = 1, size(mesh%surfaces) ! the sides of surfaces that were not split follow their elements
         associate (surface => mesh%surfaces(s))
            if (.not. surface%was_split) then
               do j = 1, surface%n
                  do k = 1, surface%n_nodes(j)
                     node = mesh%duplicate(surface%nodes(k, j))
                     if (node == 0) cycle
                     if (any(mesh%element_nodes(:, surface%element(j)) == node)) surface%nodes(k, j) = node
                  end do
               end do
            end if
         end associate
      end do
   end subroutine split_shared_surfaces

end module surface_sides
