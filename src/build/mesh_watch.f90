!> Warnings about the mesh: elements on the same nodes, and coincident nodes that nothing connects.
!! Both are left by meshes that were written twice or not merged. The stiffness of an element that is there twice counts twice;
!! bodies whose nodes are not merged come apart as at a crack. Neither is an error: an overlay, or a crack, may be meant.
module mesh_watch
   use connected_bodies, only: join_coupled
   use element_kinds, only: element_table
   use kinds, only: wp
   use lists, only: join, list_owners, root_of
   use mesh_queries, only: element_points, is_face_node, n_points
   use model_data, only: a_bar, bar_nodes, freedoms_type, joints_type, mesh_type, n_bars, supported
   use spatial_search, only: spatial_search_type
   use text_tools, only: integer_text, one_of, plural
   use tolerances, only: same_node
   implicit none
   private

   public :: repeated_words, crack_words

   integer, parameter  :: most_named = 3         ! pairs that a warning names
   integer, parameter  :: many = 2000            ! nodes from which on several threads search

contains

   !> A warning about elements, and bars without a BOLT, that have the nodes of another one; '' where there are none. Bars count if
   !! their stiffness is the same too: several unlike bars may lie between two nodes.
   function repeated_words(mesh) result(words)
      type(mesh_type), intent(in) :: mesh
      character(:), allocatable    :: words
      character(:), allocatable :: named
      integer, allocatable :: lowest(:, :), first(:), owners(:)
      integer :: e, i, n

      allocate (lowest(1, mesh%n_elements + n_bars(mesh)), source=0)
      do e = 1, mesh%n_elements
         lowest(1, e) = minval(element_points(mesh, e))
      end do
      do i = 1, n_bars(mesh)
         if (mesh%bars(i)%kind == a_bar .and. mesh%bars(i)%bolt == 0) &
            lowest(1, mesh%n_elements + i) = minval(bar_nodes(mesh%bars(i)))
      end do
      call list_owners(mesh%n_nodes, lowest, first, owners)
      n = 0
      named = ''
      do e = 1, size(lowest, 2)
         if (lowest(1, e) == 0) cycle
         do i = first(lowest(1, e)), first(lowest(1, e) + 1) - 1 ! in ascending order
            if (owners(i) >= e) exit
            if (.not. same_place(mesh, owners(i), e)) cycle
            n = n + 1
            call name_pair(n, name_of(mesh, e)//' as '//name_of(mesh, owners(i)), named)
            exit
         end do
      end do
      words = ''
      if (n > 0) words = plural(n, 'element')//one_of(n == 1, ' has', ' have')//' the nodes of another one:'//named// &
                         ': the stiffness there counts twice; delete one of each pair'
   end function repeated_words

   !> Add PAIR number N to the pairs that a warning names.
   pure subroutine name_pair(n, pair, named)
      integer, intent(in)      :: n
      character(*), intent(in) :: pair
      character(:), allocatable, intent(inout) :: named

      if (n > 1 .and. n <= most_named + 1) named = named//','
      if (n <= most_named) named = named//' '//pair
      if (n == most_named + 1) named = named//' ...'
   end subroutine name_pair

   !> Whether A and B, elements or behind these bars, have the same corners.
   pure logical function same_place(mesh, a, b)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)          :: a, b
      integer :: k, n

      same_place = .false.
      if ((a > mesh%n_elements) .neqv. (b > mesh%n_elements)) return
      if (a > mesh%n_elements) then
         associate (one => mesh%bars(a - mesh%n_elements), other => mesh%bars(b - mesh%n_elements))
            same_place = (all(one%nodes == other%nodes) .or. all(one%nodes == other%nodes(2:1:-1))) .and. &
                         .not. abs(one%stiffness - other%stiffness) > 0.0_wp
         end associate
         return
      end if
      n = element_table(mesh%element_kind(a))%n_corners
      if (n /= element_table(mesh%element_kind(b))%n_corners) return
      associate (own => mesh%element_nodes(:n, a), other => mesh%element_nodes(:n, b))
         same_place = all([(any(own(k) == other), k = 1, n)]) .and. all([(any(other(k) == own), k = 1, n)])
      end associate
   end function same_place

   !> The number of element E, or of a bar behind the elements.
   pure function name_of(mesh, e) result(name)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)          :: e
      character(:), allocatable    :: name

      if (e <= mesh%n_elements) name = integer_text(mesh%element_id(e))
      if (e > mesh%n_elements) name = integer_text(mesh%bars(e - mesh%n_elements)%id)
   end function name_of

   !> A warning about coincident nodes of elements that no joint, constraint equation, bar or spring connects; '' where there are
   !! none. Nodes that are wholly supported need no connection. Bodies that joints connect may touch elsewhere, too.
   function crack_words(mesh, joints, freedoms) result(words)
      type(mesh_type), intent(in) :: mesh
      type(joints_type), intent(in) :: joints
      type(freedoms_type), intent(in) :: freedoms
      character(:), allocatable    :: words
      type(spatial_search_type) :: search
      character(:), allocatable :: named
      integer, allocatable  :: assembly(:), body(:), found(:), nodes(:), parent(:)
      logical, allocatable  :: has_near(:) ! also where the other node is connected
      real(wp), allocatable :: reach(:)
      integer :: i, k, n, n_found

      allocate (nodes, source=pack([(i, i = 1, n_points(mesh))], [(may_part(mesh, freedoms, i), i = 1, n_points(mesh))]))
      call find_reach(mesh, reach)
      call search%build(mesh%x(:, nodes))
      allocate (has_near(size(nodes)), parent(0))
      !$omp parallel default(shared) private(found, n_found) if(size(nodes) > many)
      allocate (found(16))
      !$omp do schedule(dynamic, 512)
      do i = 1, size(nodes)
         call find_near(i, found, n_found)
         has_near(i) = n_found > 1
      end do
      !$omp end do
      !$omp end parallel
      n = 0
      named = ''
      allocate (found(16))
      do i = 1, size(nodes)
         if (.not. has_near(i)) cycle
         call find_near(i, found, n_found)
         if (size(parent) == 0) then
            call find_connections(mesh, joints, freedoms, parent)
            call find_assemblies(mesh, joints, body, assembly)
         end if
         do k = 1, n_found ! a pair counts at its second node
            if (found(k) < nodes(i) .and. .not. share(parent, found(k), nodes(i)) .and. &
                (share(body, found(k), nodes(i)) .or. .not. share(assembly, found(k), nodes(i)))) exit
         end do
         if (k > n_found) cycle
         n = n + 1
         call name_pair(n, integer_text(mesh%node_id(nodes(i)))//' at '//integer_text(mesh%node_id(found(k))), named)
      end do
      words = ''
      if (n > 0) words = plural(n, 'node')//one_of(n == 1, ' lies', ' lie')//' at the place of another one, and no '// &
         'joint, rigid element, MPC, bar or spring connects them:'//named// &
         ': the bodies come apart there; merge these nodes or give a JOINT'

   contains

      !> The nodes FOUND(:N) within reach of the I-th of NODES, itself among them.
      subroutine find_near(i, found, n)
         integer, intent(in)                 :: i
         integer, allocatable, intent(inout) :: found(:)
         integer, intent(out)                :: n

         associate (x => mesh%x(:, nodes(i)), r => reach(nodes(i)))
            call search%list_meeting(x - r, x + r, found, n)
         end associate
         found(:n) = nodes(found(:n))
      end subroutine find_near

   end function crack_words

   !> Whether NODE belongs to an element and is free to part from another one.
   pure logical function may_part(mesh, freedoms, node)
      type(mesh_type), intent(in) :: mesh
      type(freedoms_type), intent(in) :: freedoms
      integer, intent(in)          :: node

      may_part = mesh%first_at(node + 1) > mesh%first_at(node)
      if (may_part) may_part = .not. (is_face_node(mesh, node) .or. all(supported(mesh, freedoms, node)))
   end function may_part

   !> The distance within which another node coincides with each node, from the shortest edge of the elements there [length].
   pure subroutine find_reach(mesh, reach)
      type(mesh_type), intent(in) :: mesh
      real(wp), allocatable, intent(out) :: reach(:) !! (n_nodes)
      real(wp) :: shortest
      integer  :: e, k

      allocate (reach(mesh%n_nodes), source=huge(1.0_wp))
      do e = 1, mesh%n_elements
         associate (kind => element_table(mesh%element_kind(e)), nodes => mesh%element_nodes(:, e))
            shortest = huge(1.0_wp)
            if (kind%n_edges == 0) shortest = norm2(mesh%x(:, nodes(2)) - mesh%x(:, nodes(1))) ! a beam
            do k = 1, kind%n_edges
               shortest = min(shortest, norm2(mesh%x(:, nodes(kind%edges(1, k))) - mesh%x(:, nodes(kind%edges(2, k)))))
            end do
            reach(nodes(:kind%n_nodes)) = min(reach(nodes(:kind%n_nodes)), same_node*shortest)
         end associate
      end do
   end subroutine find_reach

   !> Whether A and B are in one set of the union-find PARENT.
   pure logical function share(parent, a, b)
      integer, intent(in) :: parent(:), a, b

      share = root_of(parent, a) == root_of(parent, b)
   end function share

   !> The sets of nodes that interface elements, constraint equations, bars and springs connect: their union-find PARENT.
   pure subroutine find_connections(mesh, joints, freedoms, parent)
      type(mesh_type), intent(in) :: mesh
      type(joints_type), intent(in) :: joints
      type(freedoms_type), intent(in) :: freedoms
      integer, allocatable, intent(out) :: parent(:) !! (n_nodes)
      integer :: i

      parent = [(i, i = 1, mesh%n_nodes)]
      call join_ends(joints, parent)
      do i = 1, n_bars(mesh)
         if (mesh%bars(i)%nodes(2) == 0) cycle ! the ground
         call join(parent, mesh%bars(i)%nodes(1), mesh%bars(i)%nodes(2))
      end do
      call join_coupled(mesh, freedoms, parent)
   end subroutine find_connections

   !> The union-finds of the nodes of each BODY, and of each ASSEMBLY of bodies that joints connect.
   pure subroutine find_assemblies(mesh, joints, body, assembly)
      type(mesh_type), intent(in) :: mesh
      type(joints_type), intent(in) :: joints
      integer, allocatable, intent(out) :: body(:), assembly(:) !! (n_nodes)
      integer :: e, i, k

      body = [(i, i = 1, mesh%n_nodes)]
      do e = 1, mesh%n_elements
         associate (nodes => mesh%element_nodes(:, e))
            do k = 2, size(nodes)
               call join(body, nodes(1), nodes(k))
            end do
         end associate
      end do
      do k = 1, size(mesh%faces)
         call join(body, mesh%faces(k)%point, mesh%faces(k)%node)
      end do
      assembly = body
      call join_ends(joints, assembly)
   end subroutine find_assemblies

   !> Unite in PARENT the nodes of each interface element.
   pure subroutine join_ends(joints, parent)
      type(joints_type), intent(in) :: joints
      integer, intent(inout)       :: parent(:)
      integer :: i, k

      do i = 1, size(joints%element)
         associate (nodes => joints%element(i)%node)
            do k = 2, size(nodes)
               call join(parent, nodes(1), nodes(k))
            end do
         end associate
      end do
   end subroutine join_ends

end module mesh_watch
