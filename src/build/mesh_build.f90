!> Nodes, bodies and marked sides: from the mesh cards and the block generators to positions in the model.
module mesh_build
   use block_mesh, only: block_type
   use deck_cards, only: add_field_error
   use deck_errors, only: deck_error_list
   use deck_input, only: deck_type
   use element_build, only: check_element_numbers, check_elements, check_one_state, collect_elements
   use element_kinds, only: element_table
   use kinds, only: wp
   use model_data, only: model_type
   use node_build, only: collect_nodes, generate_blocks, order_nodes, raw_nodes
   use property_build, only: resolve_properties
   use reverse_lists, only: list_owners
   use side_build, only: collect_sides, marked_sides
   implicit none
   private

   public :: build_mesh, list_elements_of_nodes

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


   !> The elements of every node.
   subroutine list_elements_of_nodes(model)
      type(model_type), intent(inout) :: model

      call list_owners(model%n_nodes, model%element_nodes, model%first_at, model%elements_at)
   end subroutine list_elements_of_nodes


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

end module mesh_build
