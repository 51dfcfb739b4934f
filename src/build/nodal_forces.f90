!> Forces on single nodes: FORCE, FORCE1 and FORCE2 as vectors in global axes.
module nodal_forces
   use bulk_data, only: force_card
   use deck_check, only: checked_deck
   use kinds, only: wp
   use load_checks, only: check_plane
   use model_data, only: model_type
   use system_build, only: to_global
   use text_tools, only: integer_text
   implicit none
   private

   public :: find_nodal_forces

contains

   !> FORCE(:, i) is that of card I in global axes [force]; zero where the card is in error.
   subroutine find_nodal_forces(deck, model, force)
      type(checked_deck), intent(in)     :: deck
      type(model_type), intent(in)       :: model
      real(wp), allocatable, intent(out) :: force(:, :) !! (3, cards)
      integer :: i, node

      allocate (force(3, size(deck%bulk%force)), source=0.0_wp)
      do i = 1, size(deck%bulk%force)
         associate (card => deck%bulk%force(i))
            node = model%node_table%find(card%node)
            if (node == 0 .and. card%node > 0) then
               call deck%field_error(card%line, 'G', 'there is no GRID '//integer_text(card%node))
            else if (node > 0) then
               if (card%is_moment) then
                  call deck%field_error(card%line, 'G', 'node '//integer_text(card%node)//' has no rotations for a moment to '// &
                                        'act on; expected a pair of forces on nodes of the body')
                  cycle
               end if
               if (.not. model%used(node)) call deck%field_error(card%line, 'G', 'node '//integer_text(card%node)// &
                                                                 ' belongs to no element')
            end if
            force(:, i) = card%force
            if (card%ends(1) > 0) then
               call along_lines(deck, model, card, force(:, i))
            else if (node > 0) then
               call to_global(deck, model%systems, card%line, card%system, model%x(:, node), force(:, i))
            end if
            call check_plane(deck, model, card%line, force(:, i), along=card%ends(1) > 0, turned=card%system > 0)
         end associate
      end do
   end subroutine find_nodal_forces

   !> FORCE of a FORCE1, along a line between two nodes, or of a FORCE2, across two such lines.
   subroutine along_lines(deck, model, card, force)
      type(checked_deck), intent(in) :: deck
      type(model_type), intent(in)   :: model
      type(force_card), intent(in)   :: card
      real(wp), intent(inout)        :: force(3)
      real(wp) :: direction(3), line(3, 2)
      integer  :: k, nodes(4)

      force = 0.0_wp
      do k = 1, 4
         nodes(k) = model%node_table%find(card%ends(k))
         if (nodes(k) == 0 .and. card%ends(k) > 0) call deck%field_error(card%line, k + 3, 'there is no GRID '// &
                                                                         integer_text(card%ends(k)))
      end do
      if (any(nodes == 0 .and. (card%ends > 0 .or. card%ends(3) > 0)) .or. any(nodes(:2) == 0)) return
      do k = 1, merge(2, 1, nodes(3) > 0)
         line(:, k) = model%x(:, nodes(2*k)) - model%x(:, nodes(2*k - 1))
      end do
      direction = line(:, 1)
      if (nodes(3) > 0) direction = [line(2, 1)*line(3, 2) - line(3, 1)*line(2, 2), &
                                     line(3, 1)*line(1, 2) - line(1, 1)*line(3, 2), &
                                     line(1, 1)*line(2, 2) - line(2, 1)*line(1, 2)]
      if (norm2(direction) > 0.0_wp) then
         force = card%force(1)*direction/norm2(direction)
      else if (nodes(3) > 0) then
         call deck%field_error(card%line, 'G1', 'the lines G1-G2 and G3-G4 are parallel or have no length: the force has no '// &
                               'direction')
      else
         call deck%field_error(card%line, 'G1', 'G1 and G2 lie in one place: the force has no direction')
      end if
   end subroutine along_lines

end module nodal_forces
