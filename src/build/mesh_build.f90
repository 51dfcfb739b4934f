!> The mesh of the model: nodes, bodies and marked sides, from mesh cards and block generators to positions.
!! A new reference node of RBE2M and RBE3M lies at the centroid of its marked surface. NODEAT is another number of the node nearest
!! to a position. The nodes that loads, supports and masses name are checked first, so that missing nodes are reported for a deck
!! with mesh errors too.
module mesh_build
   use block_mesh, only: collect_cards, mesh_card_type
   use bulk_data, only: element_card
   use contact_regions, only: add_regions
   use deck_check, only: checked_deck
   use displacement_systems, only: build_systems
   use elasticity, only: axisymmetric
   use element_build, only: check_elements, collect_elements, collect_sides, marked_side, resolve_properties
   use element_kinds, only: element_table
   use kinds, only: wp
   use lists, only: id_table_type, list_owners
   use model_data, only: mesh_type, placed_node
   use model_kind, only: find_kind, space_hint
   use node_build, only: append_nodes, build_nodes, fill_mid_sides, highest_number
   use numbers, only: cross
   use text_tools, only: integer_text, one_of, plural
   use tolerances, only: equal_distance
   implicit none
   private

   public :: build_mesh, check_named_nodes

contains

   !> Build the mesh of the model; SIDES are the marked sides.
   subroutine build_mesh(deck, mesh, sides)
      type(checked_deck), intent(inout) :: deck
      type(mesh_type), intent(inout) :: mesh
      type(marked_side), allocatable, intent(out) :: sides(:)
      type(mesh_card_type) :: cards
      integer, allocatable :: states(:)
      integer :: b, other, ring

      call build_systems(deck, mesh%systems)
      call collect_cards(deck, cards)
      call build_nodes(deck, cards%grid, mesh)
      call find_kind(deck, mesh)
      do b = 1, size(deck%bulk%block)
         if (deck%bulk%block(b)%dimension < mesh%dimension) call deck%errors%add(deck%bulk%block(b)%line, &
            'BLOCK2: plane bodies cannot stand in a model of space')
      end do
      if (any(deck%rigid%surface > 0) .or. size(deck%bulk%place) > 0) call place_nodes(deck, cards%side, mesh)
      call resolve_properties(deck, mesh)
      call collect_elements(deck, cards%element, mesh)
      call fill_mid_sides(deck, mesh)
      ! bodies, faces, edges, interface elements and springs share one numbering, as in NASTRAN
      associate (bulk => deck%bulk, of_blocks => cards%element(size(deck%bulk%element) + 1:))
         call deck%report_repeated('element', &
            [bulk%element%id, bulk%edge%id, bulk%cjoint%id, bulk%conrod%id, bulk%spring%id, of_blocks%id], &
            [bulk%element%line, bulk%edge%line, bulk%cjoint%line, bulk%conrod%line, bulk%spring%line, of_blocks%line], &
            n_cards=size(bulk%element) + size(bulk%edge) + size(bulk%cjoint) + size(bulk%conrod) + size(bulk%spring))
         call warn_of_repeated(deck, [bulk%element%id, bulk%edge%id, bulk%cjoint%id, bulk%conrod%id, bulk%spring%id, &
                                      of_blocks%id], [bulk%rigid%id, bulk%mass%id])
      end associate
      call list_owners(mesh%n_nodes, mesh%element_nodes, mesh%first_at, mesh%elements_at)
      ! plane and axisymmetric bodies must not be mixed: forces are those of the thickness, or those of the whole ring
      allocate (states(0:size(mesh%properties)), source=0) ! 0: a property in error
      states(1:) = mesh%properties%state
      ring = findloc(states(mesh%element_property), axisymmetric, dim=1)
      other = findloc(states(mesh%element_property) > 0 .and. states(mesh%element_property) /= axisymmetric, .true., dim=1)
      mesh%axisymmetric = ring > 0
      if (min(ring, other) > 0) call deck%errors%add(mesh%element_line(max(ring, other)), 'element '// &
         integer_text(mesh%element_id(max(ring, other)))//': PAXIS and PSHELL cannot be mixed in one model')
      call check_nodes(deck, mesh)
      call check_elements(deck, cards%grid, mesh)
      call collect_sides(deck, cards%side, mesh, sides)
      call add_regions(deck, mesh, sides)
   end subroutine build_mesh

   !> Warn of numbers that rigid elements and masses, OTHERS, share with ELEMENTS or among themselves: nothing refers to them.
   subroutine warn_of_repeated(deck, elements, others)
      type(checked_deck), intent(in) :: deck
      integer, intent(in) :: elements(:), others(:)
      type(id_table_type)  :: table
      integer, allocatable :: again(:)

      call table%build([elements, others])
      call table%list_repeated(again)
      again = pack(again, again > size(elements)) - size(elements)
      if (size(again) > 0) call deck%errors%warn(plural(size(again), 'number')// &
         ' of rigid elements and masses are those of other elements too, the first '// &
         integer_text(others(minval(again)))//'; NASTRAN wants numbers of their own')
   end subroutine warn_of_repeated

   !> Append the reference nodes of RBE2M and RBE3M that name none: each at the centroid of its surface, numbered from the highest
   !! node number of the deck on. Find the nodes of NODEAT cards: the number of a card becomes a number of the node nearest to its
   !! position. Of equally near nodes the new reference node of an RBE2M or RBE3M is taken, else the node with the lowest number.
   subroutine place_nodes(deck, sides, mesh)
      type(checked_deck), intent(inout) :: deck
      type(element_card), intent(in)    :: sides(:) !! of blocks
      type(mesh_type), intent(inout) :: mesh
      type(element_card), allocatable :: marking(:)
      real(wp), allocatable :: distance(:), x(:, :)
      logical, allocatable  :: is_meant(:)
      real(wp) :: rounding
      integer  :: highest, i, k, n, n_given ! n_given: before the new reference nodes

      n_given = mesh%n_nodes
      deallocate (mesh%placed)
      allocate (mesh%placed(size(deck%bulk%place)))
      mesh%placed%id = deck%bulk%place%id ! reference nodes get higher numbers
      ! the new reference nodes
      allocate (x(3, merge(count(deck%rigid%surface > 0 .and. deck%rigid%node == 0), 0, n_given > 0)))
      if (size(x, 2) > 0) then
         highest = highest_number(mesh)
         if (highest > huge(1) - size(x, 2)) then
            call deck%errors%add(0, 'the reference nodes of RBE2M and RBE3M get numbers above node '//integer_text(highest)// &
                                 ', and their numbers would exceed 2147483647')
         else
            n = 0
            do i = 1, size(deck%rigid)
               associate (card => deck%rigid(i))
                  if (card%surface == 0 .or. card%node > 0) cycle
                  n = n + 1
                  card%node = highest + n
                  x(:, n) = centroid(mesh, side_cards(deck, sides, card%surface))
               end associate
            end do
            call append_nodes(mesh, x)
         end if
      end if
      mesh%placed = [placed_node ::] ! the reference nodes, then the nodes of NODEAT
      do i = 1, size(deck%rigid)
         associate (card => deck%rigid(i))
            if (card%surface > 0) mesh%placed = [mesh%placed, placed_node(element=card%id, surface=card%surface, number=card%node, &
                                                                            node=mesh%node_table%find(card%node))]
         end associate
      end do
      ! the nodes nearest to the positions of NODEAT, on their surfaces if they name one
      if (size(deck%bulk%place) == 0 .or. mesh%n_nodes == 0) return
      rounding = equal_distance*maxval(maxval(mesh%x, dim=2) - minval(mesh%x, dim=2))
      do i = 1, size(deck%bulk%place)
         associate (card => deck%bulk%place(i))
            if (card%id == 0) cycle
            if (any(mesh%node_id == card%id)) then
               call deck%field_error(card%line, 'ID', 'there is a node '//integer_text(card%id)// &
                                     ' already; expected another number')
               cycle
            end if
            is_meant = spread(card%surface == 0, 1, mesh%n_nodes)
            marking = side_cards(deck, sides, card%surface)
            if (card%surface > 0) then
               do k = 1, size(marking)
                  is_meant(nodes_on(mesh, marking(k), merge(3, 8, marking(k)%kind <= 0))) = .true.
               end do
            end if
            do k = 1, size(mesh%placed)
               if (mesh%placed(k)%surface == card%surface .and. mesh%placed(k)%node > 0) is_meant(mesh%placed(k)%node) = .true.
            end do
            if (.not. any(is_meant)) then
               call deck%field_error(card%line, 'PID', 'surface '//integer_text(card%surface)//' has no nodes; '// &
                                     'expected a PMARK with faces or edges, or blank')
               cycle
            end if
            distance = norm2(mesh%x - spread(card%x, 2, mesh%n_nodes), dim=1)
            is_meant = is_meant .and. distance <= minval(distance, mask=is_meant) + rounding
            if (any(is_meant(n_given + 1:))) is_meant(:n_given) = .false.
            mesh%placed = [mesh%placed, placed_node(id=card%id, surface=card%surface, x=card%x, &
                                                      node=findloc(is_meant, .true., dim=1))]
         end associate
      end do
      associate (named => mesh%placed%id > 0)
         where (named) mesh%placed%number = mesh%node_id(max(1, mesh%placed%node))
         call mesh%node_table%add(pack(mesh%placed%id, named), pack(mesh%placed%node, named))
      end associate
   end subroutine place_nodes

   !> The cards that mark the sides of SURFACE, those of blocks included.
   pure function side_cards(deck, of_blocks, surface) result(cards)
      type(checked_deck), intent(in) :: deck
      type(element_card), intent(in) :: of_blocks(:)
      integer, intent(in)            :: surface
      type(element_card), allocatable :: cards(:)

      associate (edge => deck%bulk%edge%element_card, element => deck%bulk%element)
         cards = [pack(edge, edge%property == surface), pack(element, element%property == surface), &
                  pack(of_blocks, of_blocks%property == surface)]
      end associate
   end function side_cards

   !> The first N nodes on CARD, without missing ones.
   pure function nodes_on(mesh, card, n) result(nodes)
      type(mesh_type), intent(in) :: mesh
      type(element_card), intent(in) :: card
      integer, intent(in)            :: n
      integer, allocatable :: nodes(:)
      integer :: k

      nodes = [(mesh%node_table%find(card%nodes(k)), k = 1, n)]
      nodes = pack(nodes, nodes > 0)
   end function nodes_on

   !> The centroid of the sides on CARDS, weighted by length of edges or area of faces; the mean of the nodes where the total is
   !! zero.
   pure function centroid(mesh, cards)
      type(mesh_type), intent(in) :: mesh
      type(element_card), intent(in) :: cards(:)
      real(wp) :: centroid(3), extent, total
      integer  :: k, n, s
      integer, allocatable :: nodes(:)

      centroid = 0.0_wp
      total = 0.0_wp
      do s = 1, size(cards)
         n = merge(2, element_table(max(1, cards(s)%kind))%n_corners, cards(s)%kind <= 0) ! corners
         nodes = nodes_on(mesh, cards(s), n)
         associate (p => mesh%x(:, nodes))
            n = size(p, 2)
            if (n == 2) then
               extent = norm2(p(:, 2) - p(:, 1))
               centroid = centroid + extent*0.5_wp*(p(:, 1) + p(:, 2))
               total = total + extent
            end if
            do k = 2, n - 1
               extent = 0.5_wp*norm2(cross(p(:, k) - p(:, 1), p(:, k + 1) - p(:, 1)))
               centroid = centroid + extent*(p(:, 1) + p(:, k) + p(:, k + 1))/3.0_wp
               total = total + extent
            end do
         end associate
      end do
      if (total > 0.0_wp) centroid = centroid/total
   end function centroid

   !> Errors: a node outside the x-y plane in a plane model, or with x < 0 in an axisymmetric one.
   subroutine check_nodes(deck, mesh)
      type(checked_deck), intent(in) :: deck
      type(mesh_type), intent(in) :: mesh
      real(wp) :: x(3)
      integer  :: b, i, node

      if (mesh%dimension == 3) return
      do i = 1, size(deck%bulk%grid)
         node = mesh%node_table%find(deck%bulk%grid(i)%id)
         if (node == 0) cycle
         x = mesh%x(:, node)
         associate (grid => deck%bulk%grid(i))
            if (grid%cp <= 0) x = grid%x ! a number given twice has one node
            if (abs(x(3)) > 0.0_wp) call deck%field_error(grid%line, one_of(grid%cp > 0, 'CP', 'X3'), &
               one_of(grid%cp > 0, 'puts the node out of the plane', 'not zero')// &
               ', but a plane model lies in x-y'//space_hint(mesh))
            if (mesh%axisymmetric .and. x(1) < 0.0_wp) call deck%field_error(grid%line, one_of(grid%cp > 0, 'CP', 'X1'), &
               one_of(grid%cp > 0, 'puts the node at a negative x', 'negative')// &
               ', but an axisymmetric model lies in x >= 0')
         end associate
      end do
      if (.not. mesh%axisymmetric) return
      do b = 1, size(deck%bulk%block)
         if (any(deck%bulk%block(b)%corner(1, :) < 0.0_wp)) call deck%errors%add(deck%bulk%block(b)%line, &
            'BLOCK2: a corner has x < 0, but an axisymmetric model lies in x >= 0')
      end do
   end subroutine check_nodes

   !> Report the missing nodes of every FORCE, MOMENT, SPC, SPC1, SPCD and CONM2. A number that could not be read is 0 and is not
   !! reported again.
   subroutine check_named_nodes(deck, mesh)
      type(checked_deck), intent(in) :: deck
      type(mesh_type), intent(in) :: mesh !! its nodes
      integer :: i, k

      do i = 1, size(deck%bulk%force)
         associate (card => deck%bulk%force(i))
            call require(card%line, 2, card%node)
            do k = 1, 4
               call require(card%line, k + 3, card%ends(k))
            end do
         end associate
      end do
      do i = 1, size(deck%bulk%support)
         associate (card => deck%bulk%support(i))
            if (card%surface > 0) cycle
            do k = 1, size(card%first) ! G1 THRU G2 means the nodes that exist
               if (card%first(k) == card%last(k)) call require(card%line, card%at(k), card%first(k), called='G')
            end do
         end associate
      end do
      do i = 1, size(deck%bulk%displacement)
         associate (card => deck%bulk%displacement(i))
            call require(card%line, card%field, card%node, called='G')
         end associate
      end do
      do i = 1, size(deck%bulk%suport)
         call require(deck%bulk%suport(i)%line, deck%bulk%suport(i)%field, deck%bulk%suport(i)%node, called='ID')
      end do
      do i = 1, size(deck%bulk%mass)
         associate (card => deck%bulk%mass(i))
            call require(card%line, merge(3, 2, card%component > 0), card%node)
         end associate
      end do

   contains

      !> Error: data field K of the card on LINE names a missing node ID.
      subroutine require(line, k, id, called)
         integer, intent(in)                :: line, k, id
         character(*), intent(in), optional :: called

         if (id <= 0) return
         if (mesh%node_table%find(id) == 0) call deck%field_error(line, k, 'there is no GRID '//integer_text(id), called)
      end subroutine require

   end subroutine check_named_nodes

end module mesh_build
