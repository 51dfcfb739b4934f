!> Which rows the tables of a stage have where OUTPUT limits them to some nodes: those of the nodes, and of the elements that have
!! any of them.
module shown_rows
   use listing_table, only: page_type
   use model_data, only: corners_of, model_type
   implicit none
   private

   public :: shows_node, shows_element, shows_interface

contains

   pure logical function shows_node(page, node)
      type(page_type), intent(in) :: page
      integer, intent(in)         :: node

      shows_node = .true.
      if (allocated(page%shown)) shows_node = page%shown(node)
   end function shows_node

   !> Of body element E.
   pure logical function shows_element(page, model, e)
      type(page_type), intent(in)  :: page
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e

      shows_element = .true.
      if (allocated(page%shown)) shows_element = any(page%shown(corners_of(model, e)))
   end function shows_element

   !> Of interface element I.
   pure logical function shows_interface(page, model, i)
      type(page_type), intent(in)  :: page
      type(model_type), intent(in) :: model
      integer, intent(in)          :: i

      shows_interface = .true.
      if (allocated(page%shown)) shows_interface = any(page%shown(model%interface(i)%node))
   end function shows_interface

end module shown_rows
