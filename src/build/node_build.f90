!> Nodes of GRID cards and blocks in ascending order, mid-side nodes, and nodes for other unknowns.
!! A mid-side node that cards leave blank is placed at the middle of its edge, one for all elements that share the edge. All
!! elements at an edge must have the same mid-side node, or none. Nodes that no card gives follow the nodes of the deck; their
!! unknowns are not displacements of points.
module node_build
   use bulk_data, only: grid_card
   use coordinate_systems, only: position_in
   use deck_check, only: checked_deck
   use displacement_systems, only: find_system
   use elasticity, only: shell
   use element_kinds, only: element_table, is_second_order
   use kinds, only: wp
   use lists, only: id_table_type, sorted_order, list_owners
   use model_data, only: mesh_type
   use part_nodes, only: join_part_nodes
   use text_tools, only: integer_text, plural
   use tolerances, only: zero_coordinate
   implicit none
   private

   public :: build_nodes, scalar_points, append_nodes, find_nodes, fill_mid_sides, append_unknowns, highest_number

   integer, parameter, public :: blank_node = -1   !! in element_nodes, until fill_mid_sides: left blank on the card

   !> The edges of all elements, element by element; a shared edge occurs once per element.
   type :: edge_list
      integer :: n = 0
      integer, allocatable :: ends(:, :)     ! (2, n) corners, the lower position first
      integer, allocatable :: element(:)     ! (n)
      integer, allocatable :: place(:)       ! (n) of its mid-side node in element_nodes(:, element); 0: a linear element
      integer, allocatable :: first(:)       ! (n) the first edge between the same corners
      integer, allocatable :: namer(:)       ! (n) at that first edge: the first edge that names the mid-side node, else the first
   end type edge_list                        ! second-order one, else itself

contains

   !> The nodes of the GRID cards of DECK and its blocks, in ascending order of their numbers; CARDS get their coordinates in global
   !! axes.
   subroutine build_nodes(deck, cards, mesh)
      type(checked_deck), intent(in)  :: deck
      type(grid_card), intent(inout)  :: cards(:) !! those of blocks last
      type(mesh_type), intent(inout) :: mesh
      integer, allocatable :: one_as(:), order(:), stays(:)
      integer :: i, system

      do i = 1, size(cards)
         if (cards(i)%cp <= 0) cycle
         call find_system(deck, cards(i)%line, 'CP', cards(i)%cp, mesh%systems, system)
         if (system == 0) cycle
         associate (x => cards(i)%x)
            x = position_in(mesh%systems(system), x)
            where (abs(x) <= zero_coordinate*(norm2(x) + norm2(mesh%systems(system)%origin))) x = 0.0_wp
         end associate
      end do
      do i = 2, size(cards) ! scalar points have no place: that of another node
         if (cards(i)%is_scalar) cards(i)%x = cards(1)%x
      end do
      call deck%report_repeated('node', cards%id, cards%line, &
                                n_cards=size(deck%bulk%grid) + count(cards%is_scalar))
      call join_part_nodes(deck, cards, one_as)
      stays = pack([(i, i = 1, size(cards))], [(one_as(i) == i, i = 1, size(cards))])
      call sorted_order(cards(stays)%id, order)
      order = stays(order)
      mesh%n_nodes = size(order)
      mesh%node_id = cards(order)%id
      if (any(cards%is_scalar)) mesh%is_scalar = cards(order)%is_scalar
      allocate (mesh%x(3, mesh%n_nodes))
      do i = 1, mesh%n_nodes
         mesh%x(:, i) = cards(order(i))%x
      end do
      call mesh%node_table%build(mesh%node_id)
      associate (gone => pack([(i, i = 1, size(cards))], [(one_as(i) /= i, i = 1, size(cards))]))
         if (size(gone) > 0) call mesh%node_table%add(cards(gone)%id, [(mesh%node_table%find(cards(one_as(gone(i)))%id), &
                                                                       i = 1, size(gone))])
      end associate
   end subroutine build_nodes

   !> The scalar points of DECK: those of SPOINT, and others that CELAS3, CELAS4, CMASS3 and CMASS4 name.
   pure function scalar_points(deck) result(points)
      type(checked_deck), intent(in) :: deck
      type(grid_card), allocatable :: points(:)
      type(id_table_type) :: known
      integer, allocatable :: ids(:), named(:), order(:)
      integer :: i, id, k

      allocate (points(0))
      do i = 1, size(deck%bulk%scalar)
         associate (card => deck%bulk%scalar(i))
            do k = 1, size(card%first)
               ids = [(id, id = card%first(k), card%last(k))]
               ids = pack(ids, [(all(points%id /= id), id = card%first(k), card%last(k))])
               points = [points, (grid_card(line=card%line, id=ids(id), is_scalar=.true.), id = 1, size(ids))]
            end do
         end associate
      end do
      named = [pack(deck%bulk%mass%node, deck%bulk%mass%is_scalar), pack(deck%bulk%mass%node_2, deck%bulk%mass%is_scalar), &
               pack(deck%bulk%spring%nodes(1), deck%bulk%spring%is_scalar), &
               pack(deck%bulk%spring%nodes(2), deck%bulk%spring%is_scalar)]
      call known%build([deck%bulk%grid%id, points%id])
      call sorted_order(named, order)
      named = named(order)
      do i = 1, size(named)
         if (named(i) == 0 .or. any(named(max(1, i - 1):i - 1) == named(i))) cycle
         if (known%find(named(i)) == 0) points = [points, grid_card(id=named(i), is_scalar=.true.)]
      end do
   end function scalar_points

   !> Append nodes at X, numbered from the highest number on, and enter them in the table of numbers. Numbers stop at the
   !! largest integer.
   subroutine append_nodes(mesh, x)
      type(mesh_type), intent(inout) :: mesh
      real(wp), intent(in)            :: x(:, :) !! (3, new nodes) [length]
      integer :: highest, k

      highest = highest_number(mesh)
      mesh%node_id = [mesh%node_id, (highest + min(k, huge(1) - highest), k = 1, size(x, 2))]
      mesh%n_nodes = size(mesh%node_id)
      mesh%x = reshape([mesh%x, x], [3, mesh%n_nodes])
      if (size(mesh%duplicate) > 0) mesh%duplicate = [mesh%duplicate, spread(0, 1, size(x, 2))]
      call mesh%node_table%add(mesh%node_id(mesh%n_nodes - size(x, 2) + 1:), [(k, k = mesh%n_nodes - size(x, 2) + 1, mesh%n_nodes)])
   end subroutine append_nodes

   !> The highest node number of the model, with those of NODEAT.
   pure integer function highest_number(mesh)
      type(mesh_type), intent(in) :: mesh

      highest_number = max(mesh%node_id(mesh%n_nodes), maxval([0, mesh%placed%id]))
   end function highest_number

   !> The NODES with the numbers ID, which an element, edge or interface element card names from data field FIRST on; 0, and an
   !! error, for a missing node. An ID of 0 is a field that is blank or could not be read; it gives 0 without an error.
   subroutine find_nodes(deck, line, id, mesh, nodes, first)
      type(checked_deck), intent(in) :: deck
      integer, intent(in)            :: line     !! of the card
      integer, intent(in)            :: id(:)
      type(mesh_type), intent(in) :: mesh
      integer, intent(out)           :: nodes(:)
      integer, intent(in), optional  :: first    !! 3
      integer :: behind, k

      nodes = 0
      behind = 2
      if (present(first)) behind = first - 1
      do k = 1, size(id)
         if (id(k) == 0) cycle
         nodes(k) = mesh%node_table%find(id(k))
         if (nodes(k) == 0) call deck%field_error(line, k + behind, 'there is no GRID '//integer_text(id(k)), noun='node')
      end do
   end subroutine find_nodes

   !> Place nodes at the middle of the edges with a blank mid-side node: the node that another element names there, else a new node,
   !! numbered behind all others in the order of the elements. Errors: elements that share an edge but not its mid-side
   !! node; numbers beyond the largest integer.
   subroutine fill_mid_sides(deck, mesh)
      type(checked_deck), intent(in)  :: deck
      type(mesh_type), intent(inout) :: mesh
      type(edge_list) :: edges
      real(wp), allocatable :: x(:, :)
      integer :: i, n, n_new, node

      if (.not. any(is_second_order(mesh%element_kind))) return
      call match_edges(mesh, edges)
      call check_orders(deck, mesh, edges)
      n = mesh%n_nodes
      n_new = 0
      do i = 1, edges%n
         if (node_at(mesh, edges, i) /= blank_node) cycle
         associate (mid_node => mesh%element_nodes(edges%place(i), edges%element(i)))
            mid_node = node_at(mesh, edges, edges%namer(edges%first(i)))
            if (mid_node /= blank_node) cycle
            n_new = n_new + 1
            mid_node = n + n_new
         end associate
      end do
      mesh%n_filled = n_new
      mesh%first_filled = n + 1
      where (mesh%element_nodes == blank_node) mesh%element_nodes = 0 ! of edges with missing corners
      if (n_new == 0) return
      if (highest_number(mesh) > huge(1) - n_new) then
         call deck%errors%add(0, 'the blank mid-side nodes get numbers above node '// &
                              integer_text(highest_number(mesh))//', and their numbers would exceed 2147483647')
         where (mesh%element_nodes > n) mesh%element_nodes = 0
         return
      end if
      allocate (x(3, n_new))
      do i = 1, edges%n
         node = node_at(mesh, edges, i)
         if (node > n) x(:, node - n) = 0.5_wp*(mesh%x(:, edges%ends(1, i)) + mesh%x(:, edges%ends(2, i)))
      end do
      call append_nodes(mesh, x)
   end subroutine fill_mid_sides

   !> The EDGES of all elements, without edges with missing corners; the first between the same corners, and the one that names the
   !! mid-side node.
   pure subroutine match_edges(mesh, edges)
      type(mesh_type), intent(in) :: mesh
      type(edge_list), intent(out) :: edges
      integer, allocatable :: start(:), at(:)
      integer :: c, e, ends(2), i, k, node, total

      total = sum(element_table(mesh%element_kind)%n_edges)
      allocate (edges%ends(2, total), edges%element(total), edges%place(total))
      do e = 1, mesh%n_elements
         associate (kind => element_table(mesh%element_kind(e)))
            do k = 1, kind%n_edges
               ends = mesh%element_nodes(kind%edges(:, k), e)
               if (any(ends == 0)) cycle ! reported already
               edges%n = edges%n + 1
               edges%ends(:, edges%n) = [minval(ends), maxval(ends)]
               edges%element(edges%n) = e
               edges%place(edges%n) = merge(kind%n_corners + k, 0, kind%n_nodes > kind%n_corners)
            end do
         end associate
      end do
      call list_owners(mesh%n_nodes, reshape(edges%ends(1, :edges%n), [1, edges%n]), start, at)
      allocate (edges%first(edges%n), edges%namer(edges%n))
      do node = 1, mesh%n_nodes
         do i = start(node), start(node + 1) - 1
            c = at(i)
            edges%first(c) = c
            edges%namer(c) = c
            do k = start(node), i - 1
               if (edges%ends(2, at(k)) /= edges%ends(2, c)) cycle
               edges%first(c) = edges%first(at(k))
               exit
            end do
            associate (namer => edges%namer(edges%first(c)))
               if (weight(c) > weight(namer)) namer = c
            end associate
         end do
      end do

   contains

      !> Rank of edge I: 2 it names a mid-side node, 1 the node is blank, 0 it has none.
      pure integer function weight(i)
         integer, intent(in) :: i

         weight = 0
         if (edges%place(i) > 0) weight = merge(2, 1, node_at(mesh, edges, i) > 0)
      end function weight

   end subroutine match_edges

   !> The mid-side node of edge I: 0 where it has none or the named node is missing, blank_node where it is blank.
   pure integer function node_at(mesh, edges, i) result(node)
      type(mesh_type), intent(in) :: mesh
      type(edge_list), intent(in)  :: edges
      integer, intent(in)          :: i

      node = 0
      if (edges%place(i) > 0) node = mesh%element_nodes(edges%place(i), edges%element(i))
   end function node_at

   !> Error: elements at an edge with different mid-side nodes, or with and without one; each element is reported once. The
   !! nodes at the middle of edges with linear shells are noted, with a warning.
   subroutine check_orders(deck, mesh, edges)
      type(checked_deck), intent(in) :: deck
      type(mesh_type), intent(inout) :: mesh
      type(edge_list), intent(in)    :: edges
      integer :: i, last, node, other
      character(:), allocatable :: edge, element

      last = 0
      element = ''
      edge = ''
      do i = 1, edges%n
         other = edges%namer(edges%first(i))
         if (edges%element(i) == last .or. other == i) cycle
         node = node_at(mesh, edges, i)
         if (edges%place(i) == 0 .and. edges%place(other) == 0) cycle
         if (edges%place(i) == 0 .and. is_of_shell(mesh, edges%element(i))) then
            if (all(mesh%middles(1, :) /= edges%place(other) .or. mesh%middles(2, :) /= edges%element(other))) &
               mesh%middles = reshape([mesh%middles, edges%place(other), edges%element(other), edges%ends(:, i), &
                                       mesh%element_line(edges%element(i))], [5, size(mesh%middles, 2) + 1])
            cycle
         end if
         if (edges%place(i) > 0 .and. (node <= 0 .or. node == node_at(mesh, edges, other))) cycle
         last = edges%element(i)
         element = 'element '//integer_text(mesh%element_id(last))
         associate (a => mesh%node_id(edges%ends(1, i)), b => mesh%node_id(edges%ends(2, i)))
            edge = 'the edge between nodes '//integer_text(a)//' and '//integer_text(b)//' with element '// &
                   integer_text(mesh%element_id(edges%element(other)))
         end associate
         if (edges%place(i) == 0) then
            call deck%errors%add(mesh%element_line(last), element//' is linear, and shares '//edge// &
               ', which is of second order; expected both of one order, or '// &
               'bodies that do not share their nodes and a JOINT between them')
         else
            call deck%errors%add(mesh%element_line(last), element//' has node '//integer_text(mesh%node_id(node))// &
               ' at the middle of '//edge//', which has node '//integer_text(mesh%node_id(node_at(mesh, edges, other)))//' there')
         end if
      end do
      if (size(mesh%middles) > 0) call deck%errors%warn(plural(size(mesh%middles, 2), 'edge')//' between linear shells and '// &
         'shells of second order: the nodes at their middle move with their ends; in NASTRAN they are free')
   end subroutine check_orders

   !> Whether element E has the property of a shell.
   pure logical function is_of_shell(mesh, e)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)          :: e

      is_of_shell = mesh%element_property(e) > 0
      if (is_of_shell) is_of_shell = mesh%properties(mesh%element_property(e))%state == shell
   end function is_of_shell

   !> Append nodes for unknowns that are not displacements of points, one at each of POINTS: N_ELEMENTS of the ELEMENTS in turn
   !! belong to each node. The number of these nodes is 0.
   subroutine append_unknowns(mesh, points, n_elements, elements)
      type(mesh_type), intent(inout) :: mesh
      integer, intent(in)            :: points(:), n_elements(:), elements(:)
      integer, allocatable :: none(:)
      integer :: k, n

      n = mesh%n_nodes
      none = spread(0, 1, size(points))
      mesh%n_nodes = n + size(points)
      mesh%node_id = [mesh%node_id, none]
      mesh%duplicate = [mesh%duplicate, none]
      mesh%x = reshape([mesh%x, mesh%x(:, points)], [3, mesh%n_nodes])
      mesh%elements_at = [mesh%elements_at, elements]
      mesh%first_at = [mesh%first_at, none]
      do k = n + 1, mesh%n_nodes
         mesh%first_at(k + 1) = mesh%first_at(k) + n_elements(k - n)
      end do
      if (size(mesh%rotation_of) > 0) mesh%rotation_of = [mesh%rotation_of, none]
      if (size(mesh%node_section) > 0) mesh%node_section = [mesh%node_section, none]
   end subroutine append_unknowns

end module node_build
