!> Nodes, bodies and marked edges: from the mesh cards and the block generator to positions in the model.
module mesh_build
   use block_mesh, only: block_elements, block_nodes, block_side
   use deck_cards, only: add_field_error, card_name
   use deck_errors, only: deck_error_list
   use deck_input, only: deck_type
   use id_table, only: id_table_type, sorted_order
   use kinds, only: wp
   use model_data, only: model_type, property_type
   use position_search, only: position_search_type
   use quad4, only: quad4_smallest_jacobian
   use text_tools, only: integer_text
   implicit none
   private

   public :: build_mesh, list_elements_of_nodes

   !> Edges that carry a mark, before they are sorted into surfaces.
   type, public :: marked_edges
      integer :: n = 0
      integer, allocatable :: mark(:)      !! PMARK id
      integer, allocatable :: nodes(:, :)  !! (2, n)
      integer, allocatable :: line(:)      !! of its card
      integer, allocatable :: field(:)     !! data field with the mark's id
   end type marked_edges

   !> Nodes as they come, before they are put in order, and which of them a block's places are.
   type :: raw_nodes
      integer :: n = 0
      integer, allocatable  :: id(:), line(:)
      real(wp), allocatable :: x(:, :)
      integer, allocatable  :: place(:)        ! of all blocks, one after another: raw node
      integer, allocatable  :: block_start(:)  ! place(block_start(b) + 1 : block_start(b + 1))
   end type raw_nodes

contains

   !> Fill the mesh part of MODEL; EDGES are the marked edges found on the way.
   subroutine build_mesh(deck, model, edges, errors)
      type(deck_type), intent(in)          :: deck
      type(model_type), intent(inout)      :: model
      type(marked_edges), intent(out)      :: edges
      type(deck_error_list), intent(inout) :: errors
      type(raw_nodes) :: raw
      integer, allocatable :: position(:) ! raw node -> node of the model

      call collect_nodes(deck, raw, errors)
      call order_nodes(raw, model, position)
      call resolve_properties(deck, model, errors)
      call collect_elements(deck, raw, position, model, errors)
      call check_element_numbers(deck, errors)
      call list_elements_of_nodes(model)
      call check_elements(deck, model, errors)
      call collect_edges(deck, raw, position, model, edges, errors)
   end subroutine build_mesh


   !> All GRID cards and all nodes of blocks; a welded block uses the coincident nodes of the block it is welded to.
   subroutine collect_nodes(deck, raw, errors)
      type(deck_type), intent(in)          :: deck
      type(raw_nodes), intent(out)         :: raw
      type(deck_error_list), intent(inout) :: errors
      integer, allocatable  :: id(:)
      real(wp), allocatable :: x(:, :)
      integer :: b, i, k, n, total

      associate (bulk => deck%bulk)
         allocate (raw%block_start(bulk%n_block2 + 1), source=0)
         do b = 1, bulk%n_block2
            raw%block_start(b + 1) = raw%block_start(b) + product(bulk%block2(b)%divisions + 1)
         end do
         total = bulk%n_grid + raw%block_start(bulk%n_block2 + 1)
         allocate (raw%id(total), raw%line(total), raw%x(3, total), raw%place(raw%block_start(bulk%n_block2 + 1)))
         do i = 1, bulk%n_grid
            raw%id(i) = bulk%grid(i)%id
            raw%line(i) = bulk%grid(i)%line
            raw%x(:, i) = bulk%grid(i)%x
         end do
         n = bulk%n_grid
         do b = 1, bulk%n_block2
            call block_nodes(bulk%block2(b), id, x)
            associate (places => raw%place(raw%block_start(b) + 1:raw%block_start(b + 1)))
               call weld_block(deck, b, raw, x, places, errors)
               do k = 1, size(id)
                  if (places(k) > 0) cycle
                  n = n + 1
                  places(k) = n
                  raw%id(n) = id(k)
                  raw%line(n) = bulk%block2(b)%line
                  raw%x(:, n) = [x(1, k), x(2, k), 0.0_wp]
               end do
            end associate
         end do
      end associate
      raw%n = n
      call report_repeated(deck, raw%id(:n), raw%line(:n), deck%bulk%n_grid, 'node', errors)
   end subroutine collect_nodes


   !> Where block B is welded to an earlier one, PLACES(k) is the raw node at X(:, k) of that block, else 0.
   subroutine weld_block(deck, b, raw, x, places, errors)
      type(deck_type), intent(in)          :: deck
      integer, intent(in)                  :: b
      type(raw_nodes), intent(in)          :: raw
      real(wp), intent(in)                 :: x(:, :)
      integer, intent(inout)               :: places(:)
      type(deck_error_list), intent(inout) :: errors
      type(position_search_type) :: search
      integer, allocatable :: others(:)
      real(wp) :: reach, distance
      integer  :: k, other, found

      places = 0
      associate (block => deck%bulk%block2(b))
         if (block%weld == 0) return
         do other = b - 1, 1, -1
            if (deck%bulk%block2(other)%id == block%weld) exit
         end do
         if (other == 0) then
            call add_field_error(deck%text, block%line, 21, 'WELD', 'no BLOCK2 '//integer_text(block%weld)// &
                                 ' stands before this one', errors)
            return
         end if
      end associate
      others = raw%place(raw%block_start(other) + 1:raw%block_start(other + 1))
      reach = 1.0e-6_wp*maxval(maxval(x, dim=2) - minval(x, dim=2))
      call search%build(raw%x(:, others), reach)
      do k = 1, size(places)
         call search%nearest([x(1, k), x(2, k), 0.0_wp], reach, found, distance)
         if (found > 0) places(k) = others(found)
      end do
      if (all(places == 0)) call add_field_error(deck%text, deck%bulk%block2(b)%line, 21, 'WELD', &
         'the two blocks have no node in common', errors)
   end subroutine weld_block


   !> The nodes of the model in ascending order of their numbers.
   subroutine order_nodes(raw, model, position)
      type(raw_nodes), intent(in)       :: raw
      type(model_type), intent(inout)   :: model
      integer, allocatable, intent(out) :: position(:)
      integer, allocatable :: order(:)
      integer :: i

      call sorted_order(raw%id(:raw%n), order)
      allocate (position(raw%n))
      position(order) = [(i, i = 1, raw%n)]
      model%n_nodes = raw%n
      model%node_id = raw%id(order)
      model%x = raw%x(:, order)
      call model%node_table%build(model%node_id)
   end subroutine order_nodes


   !> Every PSHELL with its material.
   subroutine resolve_properties(deck, model, errors)
      type(deck_type), intent(in)          :: deck
      type(model_type), intent(inout)      :: model
      type(deck_error_list), intent(inout) :: errors
      type(id_table_type) :: materials
      integer :: i, material

      associate (bulk => deck%bulk)
         call materials%build(bulk%mat1(:bulk%n_mat1)%id)
         allocate (model%properties(bulk%n_pshell))
         do i = 1, bulk%n_pshell
            associate (pshell => bulk%pshell(i), property => model%properties(i))
               property%id = pshell%id
               property%thickness = pshell%thickness
               property%plane_strain = pshell%plane_strain
               material = materials%find(pshell%material)
               if (material > 0) then
                  property%e = bulk%mat1(material)%e
                  property%nu = bulk%mat1(material)%nu
               else if (pshell%material > 0) then
                  call add_field_error(deck%text, pshell%line, 2, 'MID1', 'there is no MAT1 '// &
                                       integer_text(pshell%material), errors)
               end if
            end associate
         end do
      end associate
   end subroutine resolve_properties


   !> CQUAD4 cards and elements of blocks, in ascending order of their numbers.
   subroutine collect_elements(deck, raw, position, model, errors)
      type(deck_type), intent(in)          :: deck
      type(raw_nodes), intent(in)          :: raw
      integer, intent(in)                  :: position(:)
      type(model_type), intent(inout)      :: model
      type(deck_error_list), intent(inout) :: errors
      type(id_table_type)  :: properties
      integer, allocatable :: id(:), nodes(:, :), property(:), line(:), block_id(:), block_nodes(:, :), order(:)
      integer :: b, i, k, n, total

      call properties%build(model%properties%id)
      total = deck%bulk%n_quad4
      do b = 1, deck%bulk%n_block2
         total = total + product(deck%bulk%block2(b)%divisions)
      end do
      allocate (id(total), nodes(4, total), property(total), line(total))
      do i = 1, deck%bulk%n_quad4
         associate (element => deck%bulk%quad4(i))
            id(i) = element%id
            line(i) = element%line
            do k = 1, 4
               call resolve_node(deck, model, element%line, k + 2, 'node G'//integer_text(k), element%nodes(k), nodes(k, i), &
                                 errors)
            end do
            property(i) = properties%find(element%property)
            call check_property(deck, element%line, element%property, property(i), errors)
         end associate
      end do
      n = deck%bulk%n_quad4
      do b = 1, deck%bulk%n_block2
         associate (block => deck%bulk%block2(b))
            call block_elements(block, block_id, block_nodes)
            k = properties%find(block%property)
            call check_property(deck, block%line, block%property, k, errors)
            do i = 1, size(block_id)
               id(n + i) = block_id(i)
               nodes(:, n + i) = position(raw%place(raw%block_start(b) + block_nodes(:, i)))
            end do
            property(n + 1:n + size(block_id)) = k
            line(n + 1:n + size(block_id)) = block%line
            n = n + size(block_id)
         end associate
      end do
      call sorted_order(id, order)
      model%n_elements = n
      model%element_id = id(order)
      model%element_nodes = nodes(:, order)
      model%element_property = property(order)
      model%element_line = line(order)
   end subroutine collect_elements


   !> Position of node ID; an error about data field K of the card on LINE where there is none.
   subroutine resolve_node(deck, model, line, k, name, id, node, errors)
      type(deck_type), intent(in)          :: deck
      type(model_type), intent(in)         :: model
      integer, intent(in)                  :: line, k, id
      character(*), intent(in)             :: name
      integer, intent(out)                 :: node
      type(deck_error_list), intent(inout) :: errors

      node = model%node_table%find(id)
      if (node == 0 .and. id > 0) call add_field_error(deck%text, line, k, name, 'there is no GRID '//integer_text(id), errors)
   end subroutine resolve_node


   subroutine check_property(deck, line, id, property, errors)
      type(deck_type), intent(in)          :: deck
      integer, intent(in)                  :: line, id, property
      type(deck_error_list), intent(inout) :: errors

      if (property > 0 .or. id == 0) return
      if (any(deck%bulk%pmark(:deck%bulk%n_pmark)%id == id)) then
         call add_field_error(deck%text, line, 2, 'PID', integer_text(id)//' is a PMARK: a surface of a plane body is '// &
                              'marked with CBAR or CROD edges', errors)
      else
         call add_field_error(deck%text, line, 2, 'PID', 'there is no PSHELL '//integer_text(id), errors)
      end if
   end subroutine check_property


   !> No element number twice, bodies, edges and interface elements counted together as NASTRAN does.
   subroutine check_element_numbers(deck, errors)
      type(deck_type), intent(in)          :: deck
      type(deck_error_list), intent(inout) :: errors
      integer, allocatable :: id(:), line(:)
      integer :: b, i, n, k, total

      associate (bulk => deck%bulk)
         total = bulk%n_quad4 + bulk%n_edge + bulk%n_cjoint
         do b = 1, bulk%n_block2
            total = total + product(bulk%block2(b)%divisions)
         end do
         allocate (id(total), line(total))
         n = bulk%n_quad4 + bulk%n_edge + bulk%n_cjoint
         id(:n) = [bulk%quad4(:bulk%n_quad4)%id, bulk%edge(:bulk%n_edge)%id, bulk%cjoint(:bulk%n_cjoint)%id]
         line(:n) = [bulk%quad4(:bulk%n_quad4)%line, bulk%edge(:bulk%n_edge)%line, bulk%cjoint(:bulk%n_cjoint)%line]
         do b = 1, bulk%n_block2
            k = product(bulk%block2(b)%divisions)
            id(n + 1:n + k) = [(bulk%block2(b)%first_element + i, i = 0, k - 1)]
            line(n + 1:n + k) = bulk%block2(b)%line
            n = n + k
         end do
      end associate
      call report_repeated(deck, id, line, deck%bulk%n_quad4 + deck%bulk%n_edge + deck%bulk%n_cjoint, 'element', errors)
   end subroutine check_element_numbers


   !> Say which of the numbers ID(n), given on the cards of LINE(n), are given twice; a card that gives many is named once.
   subroutine report_repeated(deck, id, line, n_cards, noun, errors)
      type(deck_type), intent(in)          :: deck
      integer, intent(in)                  :: id(:), line(:)
      integer, intent(in)                  :: n_cards !! the first so many are given one by one, the others by blocks
      character(*), intent(in)             :: noun
      type(deck_error_list), intent(inout) :: errors
      type(id_table_type)  :: table
      integer, allocatable :: again(:), order(:)
      integer :: field, k, last, more
      character(3) :: name

      call table%build(id)
      call table%list_repeated(again)
      call sorted_order(line(again), order)
      k = 1
      do while (k <= size(again))
         last = k
         do while (last < size(again))
            if (line(again(order(last + 1))) /= line(again(order(k)))) exit
            last = last + 1
         end do
         more = last - k
         associate (this => again(order(k)))
            field = 1
            name = merge('ID ', 'EID', noun == 'node')
            if (this > n_cards) then
               field = merge(15, 16, noun == 'node')
               name = merge('N1', 'E1', noun == 'node')
            end if
            if (id(this) > 0) call add_field_error(deck%text, line(this), field, trim(name), noun//' '//integer_text(id(this))// &
               trim(merge(', and more of this card,', '                        ', more > 0))//' is given twice, first in '// &
               deck%text%place(line(table%find(id(this)))), errors)
         end associate
         k = last + 1
      end do
   end subroutine report_repeated


   !> The elements of every node.
   subroutine list_elements_of_nodes(model)
      type(model_type), intent(inout) :: model
      integer, allocatable :: filled(:)
      integer :: e, k, node

      if (allocated(model%first_at)) deallocate (model%first_at, model%elements_at)
      allocate (model%first_at(model%n_nodes + 1), source=0)
      do e = 1, model%n_elements
         do k = 1, 4
            node = model%element_nodes(k, e)
            if (node > 0) model%first_at(node + 1) = model%first_at(node + 1) + 1
         end do
      end do
      model%first_at(1) = 1
      do node = 1, model%n_nodes
         model%first_at(node + 1) = model%first_at(node) + model%first_at(node + 1)
      end do
      allocate (model%elements_at(model%first_at(model%n_nodes + 1) - 1))
      allocate (filled, source=model%first_at)
      do e = 1, model%n_elements
         do k = 1, 4
            node = model%element_nodes(k, e)
            if (node == 0) cycle
            model%elements_at(filled(node)) = e
            filled(node) = filled(node) + 1
         end do
      end do
   end subroutine list_elements_of_nodes


   !> Every element lies in the plane and has a positive area at all its corners.
   subroutine check_elements(deck, model, errors)
      type(deck_type), intent(in)          :: deck
      type(model_type), intent(in)         :: model
      type(deck_error_list), intent(inout) :: errors
      real(wp) :: smallest
      integer  :: e, i, last_line
      logical, allocatable :: doubtful(:)

      do i = 1, deck%bulk%n_grid
         if (abs(deck%bulk%grid(i)%x(3)) > 0.0_wp) call add_field_error(deck%text, deck%bulk%grid(i)%line, 5, 'X3', &
            'not zero, but a plane model lies in x-y', errors)
      end do
      allocate (doubtful(model%n_nodes), source=.false.)
      do i = 1, deck%bulk%n_grid
         if (deck%bulk%grid(i)%doubtful .and. model%node_table%find(deck%bulk%grid(i)%id) > 0) &
            doubtful(model%node_table%find(deck%bulk%grid(i)%id)) = .true.
      end do
      last_line = 0
      do e = 1, model%n_elements
         if (any(model%element_nodes(:, e) == 0) .or. model%element_line(e) == last_line) cycle ! once a card
         if (any(doubtful(model%element_nodes(:, e)))) cycle
         if (any(deck%bulk%block2%line == model%element_line(e) .and. deck%bulk%block2%doubtful)) cycle
         smallest = quad4_smallest_jacobian(model%x(:2, model%element_nodes(:, e)))
         if (smallest > 0.0_wp) cycle
         last_line = model%element_line(e)
         call errors%add(model%element_line(e), 'element '//integer_text(model%element_id(e))//' has no positive area at '// &
                         'some corner; expected four nodes counter-clockwise round a convex quadrilateral')
      end do
   end subroutine check_elements


   !> What the manual calls node K of the edge on LINE: GA, GB of a CBAR, G1, G2 of a CROD.
   function edge_node(deck, line, k) result(name)
      type(deck_type), intent(in) :: deck
      integer, intent(in)         :: line, k
      character(2) :: name

      name = merge('G1', 'G2', k == 1)
      if (card_name(deck%text%card_part(line)) == 'CBAR') name = merge('GA', 'GB', k == 1)
   end function edge_node


   !> CBAR and CROD edges and the marked sides of blocks.
   subroutine collect_edges(deck, raw, position, model, edges, errors)
      type(deck_type), intent(in)          :: deck
      type(raw_nodes), intent(in)          :: raw
      integer, intent(in)                  :: position(:)
      type(model_type), intent(in)         :: model
      type(marked_edges), intent(out)      :: edges
      type(deck_error_list), intent(inout) :: errors
      integer, allocatable :: places(:)
      integer :: b, i, k, n, side, total

      total = deck%bulk%n_edge
      do b = 1, deck%bulk%n_block2
         total = total + 2*sum(deck%bulk%block2(b)%divisions)
      end do
      allocate (edges%mark(total), edges%nodes(2, total), edges%line(total), edges%field(total))
      n = 0
      do i = 1, deck%bulk%n_edge
         associate (edge => deck%bulk%edge(i))
            n = n + 1
            edges%mark(n) = edge%property
            edges%line(n) = edge%line
            edges%field(n) = 2
            do k = 1, 2
               call resolve_node(deck, model, edge%line, k + 2, 'node '//edge_node(deck, edge%line, k), edge%nodes(k), &
                                 edges%nodes(k, n), errors)
            end do
         end associate
      end do
      do b = 1, deck%bulk%n_block2
         do side = 1, 4
            if (deck%bulk%block2(b)%marks(side) == 0) cycle
            places = block_side(deck%bulk%block2(b), side)
            do i = 1, size(places) - 1
               n = n + 1
               edges%mark(n) = deck%bulk%block2(b)%marks(side)
               edges%line(n) = deck%bulk%block2(b)%line
               edges%field(n) = 16 + side
               edges%nodes(:, n) = position(raw%place(raw%block_start(b) + places(i:i + 1)))
            end do
         end do
      end do
      edges%n = n
   end subroutine collect_edges

end module mesh_build
