!> The mesh of the model: nodes, bodies and marked sides, from mesh cards and block generators to positions.
!! The nodes that cards of loads, supports and masses name are checked before anything else is built from these cards, so that missing
!! nodes are reported for a deck with mesh errors too.
module mesh_build
   use block_mesh, only: collect_cards, mesh_card_type
   use case_control, only: model_axisymmetric, model_plane, model_space
   use deck_check, only: checked_deck
   use displacement_systems, only: build_systems
   use element_build, only: check_element_numbers, check_elements, check_one_state, collect_elements, collect_sides, marked_side, &
                            resolve_properties
   use element_kinds, only: element_table
   use kinds, only: wp
   use lists, only: list_owners
   use model_data, only: model_type
   use node_build, only: build_nodes, fill_mid_sides
   use placed_nodes, only: place_nodes
   use text_tools, only: integer_text
   implicit none
   private

   public :: build_mesh, check_named_nodes

contains

   !> Build the mesh of MODEL; SIDES are the marked sides.
   subroutine build_mesh(deck, model, sides)
      type(checked_deck), intent(inout) :: deck
      type(model_type), intent(inout)   :: model
      type(marked_side), allocatable, intent(out) :: sides(:)
      type(mesh_card_type) :: cards
      integer :: b
      logical :: has_solids

      has_solids = any(deck%bulk%block%dimension == 3) .or. any(element_table(deck%bulk%element%kind)%dimension == 3)
      model%dimension = merge(3, 2, has_solids)
      call build_systems(deck, model%systems)
      call collect_cards(deck, cards)
      call build_nodes(deck, cards%grid, model)
      if (any(abs(model%x(3, :)) > 0.0_wp) .and. .not. is_plane(deck)) model%dimension = 3
      call take_model(deck, has_solids, model)
      do b = 1, size(deck%bulk%block)
         if (deck%bulk%block(b)%dimension < model%dimension) call deck%errors%add(deck%bulk%block(b)%line, &
            'BLOCK2: plane bodies cannot stand in a model of space')
      end do
      if (any(deck%rigid%surface > 0) .or. size(deck%bulk%place) > 0) call place_nodes(deck, cards%side, model)
      call resolve_properties(deck, model)
      call collect_elements(deck, cards%element, model)
      call fill_mid_sides(deck, model)
      call check_element_numbers(deck, cards%element)
      call list_owners(model%n_nodes, model%element_nodes, model%first_at, model%elements_at)
      call check_one_state(deck, model)
      call check_nodes(deck, model)
      call check_elements(deck, cards%grid, model)
      call collect_sides(deck, cards%side, model, sides)
   end subroutine build_mesh

   !> Whether a deck without solids is plane, whatever X3 of its nodes: it has a PAXIS or a BLOCK2, or it has PSHELL and none of them has a
   !! bending material.
   pure logical function is_plane(deck)
      type(checked_deck), intent(in) :: deck

      associate (bulk => deck%bulk)
         is_plane = size(bulk%paxis) > 0 .or. any(bulk%block%dimension == 2) .or. &
                    (size(bulk%pshell) > 0 .and. all(bulk%pshell%bending <= 0))
      end associate
   end function is_plane

   !> Set the kind of model from the entry MODEL of case control, if the deck does not contradict it.
   subroutine take_model(deck, has_solids, model)
      type(checked_deck), intent(in)  :: deck
      logical, intent(in)             :: has_solids
      type(model_type), intent(inout) :: model

      associate (control => deck%control)
         select case (control%model)
         case (model_space)
            if (size(deck%bulk%paxis) > 0) call deck%errors%add(control%model_line, 'MODEL = SPACE, but the deck has a PAXIS; '// &
                                                                'expected AXISYMMETRIC, or no PAXIS')
            if (size(deck%bulk%paxis) == 0) model%dimension = 3
         case (model_plane, model_axisymmetric)
            if (has_solids) call deck%errors%add(control%model_line, 'MODEL: the deck has solids; expected SPACE')
            if (.not. has_solids) model%dimension = 2
            if (size(deck%bulk%paxis) == 0 .neqv. control%model == model_plane) call deck%errors%add(control%model_line, &
               trim(merge('MODEL = PLANE, but the deck has a PAXIS        ', &
                          'MODEL = AXISYMMETRIC, but the deck has no PAXIS', &
                          control%model == model_plane)))
         end select
      end associate
   end subroutine take_model

   !> Errors: a node outside the x-y plane in a plane model, or with x < 0 in an axisymmetric one.
   subroutine check_nodes(deck, model)
      type(checked_deck), intent(in) :: deck
      type(model_type), intent(in)   :: model
      real(wp) :: x(3)
      integer  :: b, i, node

      if (model%dimension == 3) return
      do i = 1, size(deck%bulk%grid)
         node = model%node_table%find(deck%bulk%grid(i)%id)
         if (node == 0) cycle
         x = model%x(:, node)
         associate (grid => deck%bulk%grid(i))
            if (grid%cp <= 0) x = grid%x ! a number given twice has one node
            if (abs(x(3)) > 0.0_wp) call deck%field_error(grid%line, trim(merge('CP', 'X3', grid%cp > 0)), &
               trim(merge('puts the node out of the plane', 'not zero                      ', grid%cp > 0))// &
               ', but a plane model lies in x-y')
            if (model%axisymmetric .and. x(1) < 0.0_wp) call deck%field_error(grid%line, trim(merge('CP', 'X1', grid%cp > 0)), &
               trim(merge('puts the node at a negative x', 'negative                     ', grid%cp > 0))// &
               ', but an axisymmetric model lies in x >= 0')
         end associate
      end do
      if (.not. model%axisymmetric) return
      do b = 1, size(deck%bulk%block)
         if (any(deck%bulk%block(b)%corner(1, :) < 0.0_wp)) call deck%errors%add(deck%bulk%block(b)%line, &
            'BLOCK2: a corner has x < 0, but an axisymmetric model lies in x >= 0')
      end do
   end subroutine check_nodes

   !> Report the missing nodes of every FORCE, MOMENT, SPC, SPC1, SPCD and CONM2. A number that could not be read is 0 and is not
   !! reported again.
   subroutine check_named_nodes(deck, model)
      type(checked_deck), intent(in) :: deck
      type(model_type), intent(in)   :: model !! its nodes
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
         if (model%node_table%find(id) == 0) call deck%field_error(line, k, 'there is no GRID '//integer_text(id), called)
      end subroutine require

   end subroutine check_named_nodes

end module mesh_build
