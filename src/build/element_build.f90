!> Body elements and their properties, from cards and block generators to positions; checks of their shape.
module element_build
   use block_mesh, only: block_type
   use bulk_data, only: element_card, property_card
   use deck_check, only: checked_deck
   use elasticity, only: axisymmetric, beam, plane_stress, shell, solid
   use element_kinds, only: element_table, kind_edge2, kind_quad4, kind_quad8, kind_tria3, kind_tria6
   use element_mapping, only: smallest_jacobian
   use kinds, only: wp
   use lists, only: id_table_type, sorted_order
   use model_data, only: corners_of, model_type, property_type
   use node_build, only: blank_node, find_nodes, raw_nodes
   use shell_membrane, only: flat_coordinates
   use structural_build, only: is_beam_edge
   use text_tools, only: integer_text
   implicit none
   private

   integer, parameter :: few = 4096 ! number of elements up to which one thread is used

   public :: resolve_properties, collect_elements, check_element_numbers, check_elements, check_one_state, is_face

contains

   !> Whether an element card marks a face: in space a CTRIA3, CQUAD4 or second-order card whose property is no PSHELL.
   elemental logical function is_face(model, card)
      type(model_type), intent(in)   :: model
      type(element_card), intent(in) :: card

      is_face = model%dimension == 3 .and. element_table(card%kind)%dimension == 2
      if (is_face) is_face = .not. any(model%properties%id == card%property .and. model%properties%state == shell)
   end function is_face

   !> Every PSHELL, PAXIS and PSOLID with its material, followed by the sections of beams. In space a PSHELL with a bending material
   !! is a shell property.
   subroutine resolve_properties(deck, model)
      type(checked_deck), intent(in)  :: deck
      type(model_type), intent(inout) :: model
      type(property_card), allocatable :: cards(:)
      type(id_table_type) :: materials
      integer :: i, k

      call materials%build(deck%bulk%mat1%id)
      allocate (cards, source=[deck%bulk%pshell, deck%bulk%paxis, deck%bulk%psolid, (property_card( &
         line=deck%bulk%beam_property(i)%line, id=deck%bulk%beam_property(i)%id, material=deck%bulk%beam_property(i)%material, &
         state=beam), i = 1, size(deck%bulk%beam_property))])
      allocate (model%properties(size(cards)))
      do i = 1, size(cards)
         associate (card => cards(i), property => model%properties(i))
            property = property_type(id=card%id, state=card%state, thickness=card%thickness, incompatible=card%incompatible)
            if (model%dimension == 3 .and. i <= size(deck%bulk%pshell) .and. card%bending > 0) then
               property%state = shell
               property%fibre = card%fibre
               property%extra_mass = deck%bulk%parameters%mass_factor*card%extra_mass
            end if
            k = materials%find(card%material)
            if (k > 0) then
               property%e = deck%bulk%mat1(k)%e
               property%nu = deck%bulk%mat1(k)%nu
               if (deck%bulk%mat1(k)%bars_only) call deck%field_error(card%line, 2, 'MAT1 '//integer_text(card%material)// &
                  ' has only E, which suffices for bars; expected two of E, G and NU')
               property%rho = deck%bulk%parameters%mass_factor*deck%bulk%mat1(k)%rho
               if (property%state < axisymmetric .and. card%thickness > 0.0_wp) & ! a membrane
                  property%rho = property%rho + deck%bulk%parameters%mass_factor*card%extra_mass/card%thickness
               property%alpha = deck%bulk%mat1(k)%alpha
               property%strength = deck%bulk%mat1(k)%strength
               property%damping = deck%bulk%mat1(k)%damping
               property%reference = deck%bulk%mat1(k)%reference
            else if (card%material > 0) then
               call deck%field_error(card%line, 2, 'there is no MAT1 '//integer_text(card%material))
            end if
         end associate
      end do
   end subroutine resolve_properties

   !> Elements of cards and of blocks, in ascending order of their numbers; blank mid-side nodes become blank_node.
   subroutine collect_elements(deck, blocks, raw, position, model)
      type(checked_deck), intent(in)  :: deck
      type(block_type), intent(in)    :: blocks(:)
      type(raw_nodes), intent(in)     :: raw
      integer, intent(in)             :: position(:)
      type(model_type), intent(inout) :: model
      type(id_table_type)  :: properties
      integer, allocatable :: id(:), kind(:), nodes(:, :), property(:), line(:), order(:)
      integer :: b, corners, i, k, most, n, total

      call properties%build(model%properties%id)
      total = size(deck%bulk%element) + size(deck%bulk%edge) + n_elements(blocks)
      allocate (id(total), kind(total), property(total), line(total))
      most = max(4, maxval(element_table(deck%bulk%element%kind)%n_nodes), maxval(element_table(blocks%kind)%n_nodes))
      allocate (nodes(most, total), source=0)
      n = 0
      do i = 1, size(deck%bulk%element)
         associate (element => deck%bulk%element(i))
            if (is_face(model, element)) cycle
            n = n + 1
            id(n) = element%id
            kind(n) = element%kind
            line(n) = element%line
            k = element_table(element%kind)%n_nodes
            corners = element_table(element%kind)%n_corners
            call find_nodes(deck, element%line, element%nodes(:k), model, nodes(:k, n))
            where (element%nodes(corners + 1:k) == 0) nodes(corners + 1:k, n) = blank_node
            property(n) = properties%find(element%property)
            call check_property(deck, model, element%line, element%property, element%kind, property(n))
         end associate
      end do
      do i = 1, size(deck%bulk%edge)
         associate (edge => deck%bulk%edge(i))
            if (.not. is_beam_edge(deck, edge)) cycle
            n = n + 1
            id(n) = edge%id
            kind(n) = kind_edge2
            line(n) = edge%line
            call find_nodes(deck, edge%line, edge%nodes(:2), model, nodes(:2, n))
            property(n) = findloc(model%properties%id == edge%property .and. model%properties%state == beam, .true., dim=1)
         end associate
      end do
      do b = 1, size(blocks)
         associate (block => blocks(b))
            k = properties%find(block%property)
            call check_property(deck, model, block%line, block%property, block%kind, k)
            corners = element_table(block%kind)%n_corners
            do i = 1, size(block%element_id)
               n = n + 1
               id(n) = block%element_id(i)
               kind(n) = block%kind
               line(n) = block%line
               property(n) = k
               nodes(:corners, n) = position(raw%place(raw%block_start(b) + block%places(:corners, i)))
               nodes(corners + 1:element_table(block%kind)%n_nodes, n) = blank_node
            end do
         end associate
      end do
      call sorted_order(id(:n), order)
      model%n_elements = n
      model%element_id = id(order)
      model%element_kind = kind(order)
      model%element_nodes = nodes(:maxval([4, element_table(kind(:n))%n_nodes]), order)
      model%element_property = property(order)
      model%element_line = line(order)
   end subroutine collect_elements

   pure integer function n_elements(blocks)
      type(block_type), intent(in) :: blocks(:)
      integer :: b

      n_elements = sum([(size(blocks(b)%element_id), b = 1, size(blocks))])
   end function n_elements

   !> The property ID of an element of a KIND must be a property for this kind; PROPERTY is its position, 0 for a missing property or one
   !! for another kind.
   subroutine check_property(deck, model, line, id, kind, property)
      type(checked_deck), intent(in) :: deck
      type(model_type), intent(in)   :: model
      integer, intent(in)            :: line, id, kind
      integer, intent(inout)         :: property
      character(:), allocatable :: wanted

      if (model%dimension == 3 .and. element_table(kind)%dimension == 2 .and. any(deck%bulk%block%line == line)) then
         call deck%errors%add(line, 'BLOCK2: plane bodies cannot stand in a model of space')
         return
      end if
      if (property > 0) then
         if (model%properties(property)%state == shell .and. element_table(kind)%linear /= kind) then
            call deck%errors%add(line, 'a shell of second order; expected CTRIA3 or CQUAD4 for shells in a model of space')
            property = 0
            return
         end if
         if (model%properties(property)%state /= beam .and. &
             ((model%properties(property)%state == solid) .eqv. element_table(kind)%dimension == 3)) return
         property = 0
      end if
      if (id == 0) return
      wanted = 'PSHELL or PAXIS '
      if (element_table(kind)%dimension == 3) wanted = 'PSOLID '
      if (any(deck%bulk%pmark%id == id) .and. element_table(kind)%dimension == 2) then
         call deck%field_error(line, 'PID', integer_text(id)//' is a PMARK: a surface of a plane body is '// &
                               'marked with CBAR or CROD edges')
      else
         call deck%field_error(line, 'PID', 'there is no '//wanted//integer_text(id))
      end if
   end subroutine check_property

   !> Errors: an element number that is given twice. Bodies, faces, edges, interface elements and rigid elements share one numbering, as
   !! in NASTRAN.
   subroutine check_element_numbers(deck, blocks)
      type(checked_deck), intent(in) :: deck
      type(block_type), intent(in)   :: blocks(:)
      integer, allocatable :: id(:), line(:)
      integer :: b, n, n_cards, k

      associate (bulk => deck%bulk)
         n_cards = size(bulk%element) + size(bulk%edge) + size(bulk%cjoint) + size(bulk%conrod) + size(bulk%rigid) + &
                   size(bulk%spring) + size(bulk%mass)
         allocate (id(n_cards + n_elements(blocks)), line(n_cards + n_elements(blocks)))
         id(:n_cards) = [bulk%element%id, bulk%edge%id, bulk%cjoint%id, bulk%conrod%id, bulk%rigid%id, bulk%spring%id, bulk%mass%id]
         line(:n_cards) = [bulk%element%line, bulk%edge%line, bulk%cjoint%line, bulk%conrod%line, bulk%rigid%line, &
                           bulk%spring%line, bulk%mass%line]
      end associate
      n = n_cards
      do b = 1, size(blocks)
         k = size(blocks(b)%element_id)
         id(n + 1:n + k) = blocks(b)%element_id
         line(n + 1:n + k) = blocks(b)%line
         n = n + k
      end do
      call deck%report_repeated('element', id, line, n_cards=n_cards)
   end subroutine check_element_numbers

   !> Plane and axisymmetric bodies must not be mixed: forces of a plane body are those of its thickness, forces of an axisymmetric
   !! body those of the whole ring.
   subroutine check_one_state(deck, model)
      type(checked_deck), intent(in)  :: deck
      type(model_type), intent(inout) :: model
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
         call deck%errors%add(model%element_line(e), 'element '//integer_text(model%element_id(e))//': PAXIS and PSHELL '// &
                              'cannot be mixed in one model')
         exit
      end do
      model%axisymmetric = rings
   end subroutine check_one_state

   !> Errors: an element whose det J is not positive: in a plane element at the corners, in a solid at its integration points.
   subroutine check_elements(deck, model)
      type(checked_deck), intent(in) :: deck
      type(model_type), intent(in)   :: model
      type(id_table_type)  :: doubtful_blocks ! lines of the block cards already reported
      logical, allocatable :: doubtful(:), sound(:)
      integer :: e, i, last_line, node

      allocate (doubtful(model%n_nodes), source=.false.)
      do i = 1, size(deck%bulk%grid)
         if (.not. deck%bulk%grid(i)%doubtful) cycle
         node = model%node_table%find(deck%bulk%grid(i)%id)
         if (node > 0) doubtful(node) = .true.
      end do
      call doubtful_blocks%build(pack(deck%bulk%block%line, deck%bulk%block%doubtful))
      allocate (sound(model%n_elements))
      !$omp parallel do schedule(dynamic, 512) default(shared) if(model%n_elements > few)
      do e = 1, model%n_elements
         sound(e) = is_sound(e)
      end do
      !$omp end parallel do
      last_line = 0
      do e = 1, model%n_elements
         if (sound(e) .or. model%element_line(e) == last_line) cycle ! one error per card
         last_line = model%element_line(e)
         call deck%errors%add(model%element_line(e), 'element '//integer_text(model%element_id(e))//' has no positive '// &
                         shape_words(model%element_kind(e)))
      end do

   contains

      !> Whether element E has a valid shape, or cannot be checked yet.
      pure logical function is_sound(e)
         integer, intent(in) :: e

         is_sound = .true.
         associate (nodes => corners_of(model, e))
            if (any(nodes == 0)) return
            if (any(doubtful(nodes))) return
            if (doubtful_blocks%find(model%element_line(e)) > 0) return
            if (model%element_kind(e) == kind_edge2) return ! a beam: its length is checked with its offsets
            if (model%dimension == 3 .and. element_table(model%element_kind(e))%dimension == 2) then
               if (size(nodes) > 4) return ! second order: reported already
               is_sound = smallest_jacobian(model%element_kind(e), flat_coordinates(model%x(:, nodes))) > 0.0_wp
            else
               is_sound = smallest_jacobian(model%element_kind(e), model%x(:model%dimension, nodes)) > 0.0_wp
            end if
         end associate
      end function is_sound

   end subroutine check_elements

   !> Text: what is wrong with the shape of an element of a KIND, and what was expected.
   pure function shape_words(kind) result(words)
      integer, intent(in) :: kind
      character(:), allocatable :: words

      select case (kind)
      case (kind_quad4)
         words = 'area at some corner; expected four nodes counter-clockwise round a convex quadrilateral'
      case (kind_tria3)
         words = 'area at some corner; expected three nodes counter-clockwise'
      case (kind_quad8, kind_tria6)
         words = 'area at some integration point; expected the corners counter-clockwise, then the nodes near the middle of '// &
                 'its edges, the first between corners 1 and 2'
      case default
         words = 'volume at some integration point; expected the '//trim(merge('nodes  ', 'corners', element_table(kind)%n_nodes > &
                 element_table(kind)%n_corners))//' in the order of '//trim(element_table(kind)%card)//' in the card manual'
      end select
   end function shape_words

end module element_build
