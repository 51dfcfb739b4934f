!> What the cards of rigid elements and equations name: nodes and components.
module rigid_nodes
   use bulk_data, only: has_component
   use deck_check, only: checked_deck
   use model_data, only: model_type
   use text_tools, only: integer_text
   implicit none
   private

   public :: find_node, no_displacement

contains

   !> Whether COMPONENTS name no displacement of MODEL.
   pure logical function no_displacement(model, components)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: components
      integer :: d

      no_displacement = components > 0 .and. .not. any([(has_component(components, d), d = 1, model%dimension)])
   end function no_displacement

   !> The NODE with the number ID, which data field FIELD of the card on LINE names; 0, and an error, where there is none, or
   !! where a joint split it. A node that no element holds is WITHOUT.
   subroutine find_node(deck, line, field, id, model, without, node)
      type(checked_deck), intent(in) :: deck
      integer, intent(in)            :: line, field, id
      type(model_type), intent(in)   :: model
      logical, intent(inout)         :: without(:)
      integer, intent(out)           :: node

      node = 0
      if (id == 0) return
      node = model%node_table%find(id)
      if (node == 0) then
         call deck%field_error(line, field, 'there is no GRID '//integer_text(id), called='G')
      else if (model%twin(node) > 0) then
         call deck%field_error(line, field, 'node '//integer_text(id)//' is split by a JOINT: which of the two is meant is not '// &
                               'known; expected nodes away from it, or bodies meshed apart', called='G')
         node = 0
      else
         without(node) = without(node) .or. .not. model%used(node)
      end if
   end subroutine find_node

end module rigid_nodes
