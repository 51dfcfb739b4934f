!> Whether the nodes that cards of loads, supports and masses name are there. It is asked before anything else is made of these
!! cards, so that it is said of a deck whose mesh is faulty too.
module named_nodes
   use deck_check, only: checked_deck
   use model_data, only: model_type
   use text_tools, only: integer_text
   implicit none
   private

   public :: check_named_nodes

contains

   !> Say of every card of FORCE, MOMENT, SPC, SPC1, SPCD and CONM2 which of its nodes are not there. A number that could not be read
   !! is 0, and nothing is said of it again.
   subroutine check_named_nodes(deck, model)
      type(checked_deck), intent(in) :: deck
      type(model_type), intent(in)   :: model !! its nodes
      integer :: i, k

      do i = 1, size(deck%bulk%force)
         associate (card => deck%bulk%force(i))
            if (is_missing(card%node)) call deck%field_error(card%line, 'G', there_is_no(card%node))
            do k = 1, 4
               if (is_missing(card%ends(k))) call deck%field_error(card%line, k + 3, there_is_no(card%ends(k)))
            end do
         end associate
      end do
      do i = 1, size(deck%bulk%support)
         associate (card => deck%bulk%support(i))
            if (card%surface > 0) cycle
            do k = 1, size(card%first)
               if (card%first(k) /= card%last(k)) cycle ! of G1 THRU G2 those that are there
               if (is_missing(card%first(k))) &
                  call deck%field_error(card%line, card%at(k), there_is_no(card%first(k)), called='G')
            end do
         end associate
      end do
      do i = 1, size(deck%bulk%displacement)
         associate (card => deck%bulk%displacement(i))
            if (is_missing(card%node)) call deck%field_error(card%line, card%field, there_is_no(card%node), called='G')
         end associate
      end do
      do i = 1, size(deck%bulk%mass)
         associate (card => deck%bulk%mass(i))
            if (is_missing(card%node)) call deck%field_error(card%line, 'G', there_is_no(card%node))
         end associate
      end do

   contains

      !> Whether node ID is named and not there.
      pure logical function is_missing(id)
         integer, intent(in) :: id

         is_missing = id > 0
         if (is_missing) is_missing = model%node_table%find(id) == 0
      end function is_missing

   end subroutine check_named_nodes

   pure function there_is_no(id) result(words)
      integer, intent(in)       :: id
      character(:), allocatable :: words

      words = 'there is no GRID '//integer_text(id)
   end function there_is_no

end module named_nodes
