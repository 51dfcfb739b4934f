!> Nodes, bodies and marked sides: from the mesh cards and the block generators to positions in the model.
module mesh_build
   use bar_build, only: is_bar
   use block_mesh, only: block_type
   use bulk_data, only: element_card
   use card_names, only: card_name
   use deck_cards, only: add_field_error
   use deck_errors, only: deck_error_list
   use deck_input, only: deck_type
   use elasticity, only: axisymmetric, plane_strain, plane_stress, solid
   use element_kinds, only: element_table, kind_quad4, kind_tria3, max_nodes, max_side_nodes
   use element_mapping, only: smallest_jacobian
   use id_table, only: id_table_type, sorted_order
   use kinds, only: wp
   use model_data, only: corners_of, model_type, property_type
   use node_build, only: collect_nodes, generate_blocks, order_nodes, raw_nodes, report_repeated
   use text_tools, only: integer_text
   implicit none
   private

   public :: build_mesh, list_elements_of_nodes

   !> Sides that carry a mark, before they are sorted into surfaces.
   type, public :: marked_sides
      integer :: n = 0
      integer, allocatable :: mark(:)      !! PMARK id
      integer, allocatable :: corners(:)   !! 2, 3 or 4
      integer, allocatable :: nodes(:, :)  !! (4, n)
      integer, allocatable :: line(:)      !! of its card
      integer, allocatable :: field(:)     !! data field with the mark's id
   end type marked_sides

contains

   !> Fill the mesh part of MODEL; SIDES are the marked sides found on the way.
   subroutine build_mesh(deck, model, sides, errors)
      type(deck_type), intent(in)          :: deck
      type(model_type), intent(inout)      :: model
      type(marked_sides), intent(out)      :: sides
      type(deck_error_list), intent(inout) :: errors
      type(block_type), allocatable :: blocks(:)
      type(raw_nodes) :: raw
      integer, allocatable :: position(:) ! raw node -> node of the model

      model%dimension = 2
      if (deck%bulk%n_block3 > 0 .or. any(element_table(deck%bulk%element(:deck%bulk%n_element)%kind)%dimension == 3)) &
         model%dimension = 3
      call generate_blocks(deck, blocks)
      call collect_nodes(deck, blocks, raw, errors)
      call order_nodes(raw, model, position)
      call resolve_properties(deck, model, errors)
      call collect_elements(deck, blocks, raw, position, model, errors)
      call check_element_numbers(deck, blocks, errors)
      call list_elements_of_nodes(model)
      call check_one_state(model, errors)
      call check_nodes(deck, model, errors)
      call check_elements(deck, model, errors)
      call collect_sides(deck, blocks, raw, position, model, sides, errors)
   end subroutine build_mesh


   !> Every PSHELL, PAXIS and PSOLID with its material.
   subroutine resolve_properties(deck, model, errors)
      type(deck_type), intent(in)          :: deck
      type(model_type), intent(inout)      :: model
      type(deck_error_list), intent(inout) :: errors
      type(id_table_type) :: materials
      integer :: i, n

      associate (bulk => deck%bulk)
         call materials%build(bulk%mat1(:bulk%n_mat1)%id)
         allocate (model%properties(bulk%n_pshell + bulk%n_paxis + bulk%n_psolid))
         do i = 1, bulk%n_pshell
            associate (pshell => bulk%pshell(i), property => model%properties(i))
               property%id = pshell%id
               property%state = merge(plane_strain, plane_stress, pshell%plane_strain)
               property%thickness = pshell%thickness
               property%incompatible = pshell%incompatible
               call set_material(deck, materials, pshell%material, pshell%line, 'MID1', property, errors)
            end associate
         end do
         n = bulk%n_pshell
         do i = 1, bulk%n_paxis
            model%properties(n + i)%id = bulk%paxis(i)%id
            model%properties(n + i)%state = axisymmetric
            call set_material(deck, materials, bulk%paxis(i)%material, bulk%paxis(i)%line, 'MID', model%properties(n + i), errors)
         end do
         n = n + bulk%n_paxis
         do i = 1, bulk%n_psolid
            model%properties(n + i)%id = bulk%psolid(i)%id
            model%properties(n + i)%state = solid
            model%properties(n + i)%incompatible = bulk%psolid(i)%incompatible
            call set_material(deck, materials, bulk%psolid(i)%material, bulk%psolid(i)%line, 'MID', model%properties(n + i), &
                              errors)
         end do
      end associate
   end subroutine resolve_properties


   !> The material of a PROPERTY by its id; an error about field 2 of the card on LINE where there is none.
   subroutine set_material(deck, materials, id, line, field, property, errors)
      type(deck_type), intent(in)          :: deck
      type(id_table_type), intent(in)      :: materials
      integer, intent(in)                  :: id, line
      character(*), intent(in)             :: field
      type(property_type), intent(inout)   :: property
      type(deck_error_list), intent(inout) :: errors
      integer :: material

      material = materials%find(id)
      if (material > 0) then
         property%e = deck%bulk%mat1(material)%e
         property%nu = deck%bulk%mat1(material)%nu
         property%rho = deck%bulk%mat1(material)%rho
      else if (id > 0) then
         call add_field_error(deck%text, line, 2, field, 'there is no MAT1 '//integer_text(id), errors)
      end if
   end subroutine set_material


   !> Whether an element card marks a face: in a model of solids, CQUAD4 and CTRIA3 do nothing else.
   elemental logical function is_face(model, card)
      type(model_type), intent(in)   :: model
      type(element_card), intent(in) :: card

      is_face = model%dimension == 3 .and. element_table(card%kind)%dimension == 2
   end function is_face


   !> Elements of cards and of blocks, in ascending order of their numbers.
   subroutine collect_elements(deck, blocks, raw, position, model, errors)
      type(deck_type), intent(in)          :: deck
      type(block_type), intent(in)         :: blocks(:)
      type(raw_nodes), intent(in)          :: raw
      integer, intent(in)                  :: position(:)
      type(model_type), intent(inout)      :: model
      type(deck_error_list), intent(inout) :: errors
      type(id_table_type)  :: properties
      integer, allocatable :: id(:), kind(:), nodes(:, :), property(:), line(:), order(:)
      integer :: b, i, k, n, total, most

      call properties%build(model%properties%id)
      total = deck%bulk%n_element
      do b = 1, size(blocks)
         total = total + size(blocks(b)%element_id)
      end do
      allocate (id(total), kind(total), property(total), line(total))
      allocate (nodes(max_nodes, total), source=0)
      n = 0
      do i = 1, deck%bulk%n_element
         associate (element => deck%bulk%element(i))
            if (is_face(model, element)) cycle
            n = n + 1
            id(n) = element%id
            kind(n) = element%kind
            line(n) = element%line
            do k = 1, element_table(element%kind)%n_nodes
               call resolve_node(deck, model, element%line, k + 2, 'node G'//integer_text(k), element%nodes(k), nodes(k, n), &
                                 errors)
            end do
            property(n) = properties%find(element%property)
            call check_property(deck, model, element%line, element%property, element%kind, property(n), errors)
         end associate
      end do
      do b = 1, size(blocks)
         associate (block => blocks(b))
            k = properties%find(block%property)
            call check_property(deck, model, block%line, block%property, block%kind, k, errors)
            do i = 1, size(block%element_id)
               n = n + 1
               id(n) = block%element_id(i)
               kind(n) = block%kind
               line(n) = block%line
               property(n) = k
               associate (corners => element_table(block%kind)%n_nodes)
                  nodes(:corners, n) = position(raw%place(raw%block_start(b) + block%places(:corners, i)))
               end associate
            end do
         end associate
      end do
      call sorted_order(id(:n), order)
      most = maxval([4, element_table(kind(:n))%n_nodes])
      model%n_elements = n
      model%element_id = id(order)
      model%element_kind = kind(order)
      model%element_nodes = nodes(:most, order)
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


   !> The property ID of an element of a KIND must be one of its own sort; PROPERTY is its position, 0 for none, and set to 0
   !! where it is of another.
   subroutine check_property(deck, model, line, id, kind, property, errors)
      type(deck_type), intent(in)          :: deck
      type(model_type), intent(in)         :: model
      integer, intent(in)                  :: line, id, kind
      integer, intent(inout)               :: property
      type(deck_error_list), intent(inout) :: errors
      character(:), allocatable :: wanted

      if (model%dimension == 3 .and. element_table(kind)%dimension == 2) then
         call errors%add(line, 'BLOCK2: the model has solids; plane bodies and solids cannot be mixed')
         return
      end if
      wanted = 'PSHELL or PAXIS '
      if (element_table(kind)%dimension == 3) wanted = 'PSOLID '
      if (property > 0) then
         if ((model%properties(property)%state == solid) .eqv. element_table(kind)%dimension == 3) return
         property = 0
      end if
      if (id == 0) return
      if (any(deck%bulk%pmark(:deck%bulk%n_pmark)%id == id) .and. element_table(kind)%dimension == 2) then
         call add_field_error(deck%text, line, 2, 'PID', integer_text(id)//' is a PMARK: a surface of a plane body is '// &
                              'marked with CBAR or CROD edges', errors)
      else
         call add_field_error(deck%text, line, 2, 'PID', 'there is no '//wanted//integer_text(id), errors)
      end if
   end subroutine check_property


   !> No element number twice, bodies, faces, edges and interface elements counted together as NASTRAN does.
   subroutine check_element_numbers(deck, blocks, errors)
      type(deck_type), intent(in)          :: deck
      type(block_type), intent(in)         :: blocks(:)
      type(deck_error_list), intent(inout) :: errors
      integer, allocatable :: id(:), line(:)
      integer :: b, n, n_cards, k, total

      associate (bulk => deck%bulk)
         n_cards = bulk%n_element + bulk%n_edge + bulk%n_cjoint
         total = n_cards
         do b = 1, size(blocks)
            total = total + size(blocks(b)%element_id)
         end do
         allocate (id(total), line(total))
         id(:n_cards) = [bulk%element(:bulk%n_element)%id, bulk%edge(:bulk%n_edge)%id, bulk%cjoint(:bulk%n_cjoint)%id]
         line(:n_cards) = [bulk%element(:bulk%n_element)%line, bulk%edge(:bulk%n_edge)%line, bulk%cjoint(:bulk%n_cjoint)%line]
         n = n_cards
         do b = 1, size(blocks)
            k = size(blocks(b)%element_id)
            id(n + 1:n + k) = blocks(b)%element_id
            line(n + 1:n + k) = blocks(b)%line
            n = n + k
         end do
      end associate
      call report_repeated(deck, id, line, n_cards, 'element', errors)
   end subroutine check_element_numbers


   !> The elements of every node.
   subroutine list_elements_of_nodes(model)
      type(model_type), intent(inout) :: model
      integer, allocatable :: filled(:)
      integer :: e, k, node

      if (allocated(model%first_at)) deallocate (model%first_at, model%elements_at)
      allocate (model%first_at(model%n_nodes + 1), source=0)
      do e = 1, model%n_elements
         do k = 1, size(model%element_nodes, 1)
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
         do k = 1, size(model%element_nodes, 1)
            node = model%element_nodes(k, e)
            if (node == 0) cycle
            model%elements_at(filled(node)) = e
            filled(node) = filled(node) + 1
         end do
      end do
   end subroutine list_elements_of_nodes


   !> Plane bodies and bodies of revolution cannot be mixed: the forces of the ones are those of their thickness, of the
   !! others those of the whole ring.
   subroutine check_one_state(model, errors)
      type(model_type), intent(inout)      :: model
      type(deck_error_list), intent(inout) :: errors
      logical :: rings, others
      integer :: e

      rings = .false.
      others = .false.
      do e = 1, model%n_elements
         if (model%element_property(e) == 0) cycle
         if (model%properties(model%element_property(e))%state == axisymmetric) then
            rings = .true.
         else
            others = .true.
         end if
         if (.not. (rings .and. others)) cycle
         call errors%add(model%element_line(e), 'element '//integer_text(model%element_id(e))//': PAXIS and PSHELL cannot be '// &
                         'mixed in one model')
         exit
      end do
      model%axisymmetric = rings
   end subroutine check_one_state


   !> A plane model lies in x-y, an axisymmetric one besides in x >= 0.
   subroutine check_nodes(deck, model, errors)
      type(deck_type), intent(in)          :: deck
      type(model_type), intent(in)         :: model
      type(deck_error_list), intent(inout) :: errors
      integer :: b, i

      if (model%dimension == 3) return
      do i = 1, deck%bulk%n_grid
         if (abs(deck%bulk%grid(i)%x(3)) > 0.0_wp) call add_field_error(deck%text, deck%bulk%grid(i)%line, 5, 'X3', &
            'not zero, but a plane model lies in x-y', errors)
         if (model%axisymmetric .and. deck%bulk%grid(i)%x(1) < 0.0_wp) call add_field_error(deck%text, &
            deck%bulk%grid(i)%line, 3, 'X1', 'negative, but an axisymmetric model lies in x >= 0', errors)
      end do
      if (.not. model%axisymmetric) return
      do b = 1, deck%bulk%n_block2
         if (any(deck%bulk%block2(b)%corner(1, :) < 0.0_wp)) call errors%add(deck%bulk%block2(b)%line, &
            'BLOCK2: a corner has x < 0, but an axisymmetric model lies in x >= 0')
      end do
   end subroutine check_nodes


   !> Every element has a positive area or volume at all its corners.
   subroutine check_elements(deck, model, errors)
      type(deck_type), intent(in)          :: deck
      type(model_type), intent(in)         :: model
      type(deck_error_list), intent(inout) :: errors
      integer  :: e, i, last_line
      logical, allocatable :: doubtful(:)

      allocate (doubtful(model%n_nodes), source=.false.)
      do i = 1, deck%bulk%n_grid
         if (deck%bulk%grid(i)%doubtful .and. model%node_table%find(deck%bulk%grid(i)%id) > 0) &
            doubtful(model%node_table%find(deck%bulk%grid(i)%id)) = .true.
      end do
      last_line = 0
      do e = 1, model%n_elements
         if (model%element_line(e) == last_line) cycle ! once a card
         associate (nodes => corners_of(model, e))
            if (any(nodes == 0)) cycle
            if (any(doubtful(nodes))) cycle
            if (any(deck%bulk%block2%line == model%element_line(e) .and. deck%bulk%block2%doubtful)) cycle
            if (any(deck%bulk%block3%line == model%element_line(e) .and. deck%bulk%block3%doubtful)) cycle
            if (smallest_jacobian(model%element_kind(e), model%x(:model%dimension, nodes)) > 0.0_wp) cycle
         end associate
         last_line = model%element_line(e)
         call errors%add(model%element_line(e), 'element '//integer_text(model%element_id(e))//' has no positive '// &
                         shape_words(model%element_kind(e)))
      end do
   end subroutine check_elements


   !> What an element of a KIND lacks, and what was expected.
   pure function shape_words(kind) result(words)
      integer, intent(in)       :: kind
      character(:), allocatable :: words

      select case (kind)
      case (kind_quad4)
         words = 'area at some corner; expected four nodes counter-clockwise round a convex quadrilateral'
      case (kind_tria3)
         words = 'area at some corner; expected three nodes counter-clockwise'
      case default
         words = 'volume at some corner; expected the corners in the order of '//trim(element_table(kind)%card)// &
                 ' in the card manual'
      end select
   end function shape_words


   !> What the manual calls node K of the edge on LINE: GA, GB of a CBAR, G1, G2 of a CROD.
   function edge_node(deck, line, k) result(name)
      type(deck_type), intent(in) :: deck
      integer, intent(in)         :: line, k
      character(2) :: name

      name = merge('G1', 'G2', k == 1)
      if (card_name(deck%text%card_part(line)) == 'CBAR') name = merge('GA', 'GB', k == 1)
   end function edge_node


   !> CBAR and CROD edges in the plane, CTRIA3 and CQUAD4 faces of solids, and the marked sides of blocks.
   subroutine collect_sides(deck, blocks, raw, position, model, sides, errors)
      type(deck_type), intent(in)          :: deck
      type(block_type), intent(in)         :: blocks(:)
      type(raw_nodes), intent(in)          :: raw
      integer, intent(in)                  :: position(:)
      type(model_type), intent(in)         :: model
      type(marked_sides), intent(out)      :: sides
      type(deck_error_list), intent(inout) :: errors
      integer :: b, i, k, n, total

      total = deck%bulk%n_edge + sum(blocks%n_sides)
      if (model%dimension == 3) total = total + deck%bulk%n_element
      allocate (sides%mark(total), sides%corners(total), sides%line(total), sides%field(total))
      allocate (sides%nodes(max_side_nodes, total), source=0)
      n = 0
      do i = 1, deck%bulk%n_edge
         associate (edge => deck%bulk%edge(i))
            if (is_bar(deck, edge)) cycle
            if (model%dimension == 3) then
               call errors%add(edge%line, 'a CBAR, or a CROD without a PROD, marks an edge of a plane body; surfaces of '// &
                               'solids are marked with CTRIA3 and CQUAD4 faces')
               cycle
            end if
            call start_side(edge%property, 2, edge%line, 2)
            do k = 1, 2
               call resolve_node(deck, model, edge%line, k + 2, 'node '//edge_node(deck, edge%line, k), edge%nodes(k), &
                                 sides%nodes(k, n), errors)
            end do
         end associate
      end do
      do i = 1, deck%bulk%n_element
         associate (face => deck%bulk%element(i))
            if (.not. is_face(model, face)) cycle
            call start_side(face%property, element_table(face%kind)%n_nodes, face%line, 2)
            do k = 1, sides%corners(n)
               call resolve_node(deck, model, face%line, k + 2, 'node G'//integer_text(k), face%nodes(k), sides%nodes(k, n), &
                                 errors)
            end do
         end associate
      end do
      do b = 1, size(blocks)
         do i = 1, blocks(b)%n_sides
            associate (corners => blocks(b)%side(:count(blocks(b)%side(:, i) > 0), i))
               call start_side(blocks(b)%mark(i), size(corners), blocks(b)%line, blocks(b)%mark_field(i))
               sides%nodes(:size(corners), n) = position(raw%place(raw%block_start(b) + corners))
            end associate
         end do
      end do
      sides%n = n

   contains

      subroutine start_side(mark, corners, line, field)
         integer, intent(in) :: mark, corners, line, field

         n = n + 1
         sides%mark(n) = mark
         sides%corners(n) = corners
         sides%line(n) = line
         sides%field(n) = field
      end subroutine start_side

   end subroutine collect_sides

end module mesh_build
