!> Nodes that two parts of a deck with superelements give by two numbers and that are one node: those that SECONCT pairs, and, unless
!! SEBULK says MANUAL, those at one place. The node has both numbers; its supports, loads and elements are those of both. Nodes at one
!! place between which a joint, a spring or a rigid element may lie are joined by SECONCT alone.
module part_nodes
   use bulk_data, only: grid_card
   use deck_check, only: checked_deck
   use deck_parts, only: part_at
   use kinds, only: wp
   use lists, only: id_table_type, join, root_of
   use spatial_search, only: spatial_search_type
   use text_tools, only: integer_text, plural, real_text
   use tolerances, only: part_distance
   implicit none
   private

   public :: join_part_nodes

contains

   !> ONE_AS(i) is the first of the CARDS that are the node of card i: i itself, or one before it.
   subroutine join_part_nodes(deck, cards, one_as)
      type(checked_deck), intent(in)    :: deck
      type(grid_card), intent(in)       :: cards(:)  !! x in global axes; GRID, then scalar points and nodes of blocks
      integer, allocatable, intent(out) :: one_as(:) !! (cards)
      integer :: i

      one_as = [(i, i = 1, size(cards))]
      if (size(deck%bulk%part_lines) == 0) return
      call join_pairs(deck, cards, one_as)
      if (deck%bulk%n_manual == 0) call join_places(deck, cards, one_as)
      one_as = [(root_of(one_as, i), i = 1, size(cards))]
   end subroutine join_part_nodes

   !> Join the pairs of SECONCT. Errors: a node that is missing, elsewhere, or of other axes of its displacements.
   subroutine join_pairs(deck, cards, one_as)
      type(checked_deck), intent(in) :: deck
      type(grid_card), intent(in)    :: cards(:)
      integer, intent(inout)         :: one_as(:)
      type(id_table_type) :: table
      integer :: at(2), k

      call table%build(cards%id)
      do k = 1, size(deck%bulk%joined, 2)
         associate (ids => deck%bulk%joined(:2, k), line => deck%bulk%joined(3, k), field => deck%bulk%joined(4, k))
            at = [table%find(ids(1)), table%find(ids(2))]
            if (at(1) == 0) call deck%field_error(line, field, 'there is no GRID '//integer_text(ids(1)), 'GA')
            if (at(2) == 0) call deck%field_error(line, field + 1, 'there is no GRID '//integer_text(ids(2)), 'GB')
            if (any(at == 0)) cycle
            if (cards(at(1))%is_scalar .neqv. cards(at(2))%is_scalar) then
               call deck%field_error(line, field, 'of nodes '//words(ids)// &
                                     ' one is a scalar point; expected two GRID or two SPOINT', 'GA')
            else if (distance(cards(at(1)), cards(at(2))) > max(part_distance, deck%bulk%join_distance)) then
               call deck%field_error(line, field, 'nodes '//words(ids)//' are '// &
                                     real_text(distance(cards(at(1)), cards(at(2))))//' apart; expected one place within TOL', 'GA')
            else if (are_equal(deck, cards(at(1)), cards(at(2)), line)) then
               call join(one_as, at(1), at(2))
            end if
         end associate
      end do
   end subroutine join_pairs

   !> Join nodes of different parts at one place, with a warning; those between which the deck has joints, springs, rigid elements or
   !! equations stay apart, with a warning.
   subroutine join_places(deck, cards, one_as)
      type(checked_deck), intent(in) :: deck
      type(grid_card), intent(in)    :: cards(:)
      integer, intent(inout)         :: one_as(:)
      type(spatial_search_type) :: search
      integer, allocatable :: found(:), of(:)
      real(wp), allocatable :: x(:, :)
      real(wp) :: reach
      integer :: first(2, 2), i, k, n(2), n_found, which

      of = pack([(i, i = 1, size(deck%bulk%grid))], .not. cards(:size(deck%bulk%grid))%is_scalar)
      x = reshape([(cards(of(i))%x, i = 1, size(of))], [3, size(of)])
      call search%build(x)
      allocate (found(0))
      reach = max(part_distance, deck%bulk%join_distance)
      n = 0
      do i = 1, size(of)
         call search%list_meeting(x(:, i) - reach, x(:, i) + reach, found, n_found)
         do k = 1, n_found
            associate (a => cards(of(found(k))), b => cards(of(i)))
               if (found(k) >= i .or. part_at(deck%bulk, a%line) == part_at(deck%bulk, b%line)) cycle
               if (root_of(one_as, of(found(k))) == root_of(one_as, of(i))) cycle
               which = merge(2, 1, are_connected(deck, a%id, b%id))
               if (n(which) == 0) first(:, which) = [a%id, b%id]
               n(which) = n(which) + 1
               if (which == 2) cycle
               if (are_equal(deck, a, b, b%line)) call join(one_as, of(found(k)), of(i))
            end associate
         end do
      end do
      if (n(1) > 0) call deck%errors%warn(plural(n(1), 'pair')//' of nodes of two parts at one place, the first '// &
         words(first(:, 1))//', are one node each, as in NASTRAN; SEBULK with MANUAL keeps them apart')
      if (n(2) > 0) call deck%errors%warn(plural(n(2), 'pair')//' of nodes of two parts at one place are not joined, the first '// &
         words(first(:, 2))//', because the deck has joints, or an element between the nodes; NASTRAN joins them unless SEBULK '// &
         'has MANUAL')
   end subroutine join_places

   !> Whether a joint may lie between nodes A and B, or a spring, rigid element or equation does.
   pure logical function are_connected(deck, a, b)
      type(checked_deck), intent(in) :: deck
      integer, intent(in)            :: a, b
      integer :: k

      are_connected = size(deck%bulk%joint) + size(deck%bulk%cjoint) + size(deck%bulk%pair) > 0
      do k = 1, size(deck%bulk%spring)
         are_connected = are_connected .or. (any(deck%bulk%spring(k)%nodes == a) .and. any(deck%bulk%spring(k)%nodes == b))
      end do
      do k = 1, size(deck%bulk%rigid)
         associate (nodes => [deck%bulk%rigid(k)%node, deck%bulk%rigid(k)%nodes])
            are_connected = are_connected .or. (any(nodes == a) .and. any(nodes == b))
         end associate
      end do
      do k = 1, size(deck%bulk%equation)
         associate (nodes => deck%bulk%equation(k)%node)
            are_connected = are_connected .or. (any(nodes == a) .and. any(nodes == b))
         end associate
      end do
   end function are_connected

   !> Whether nodes A and B have the same axes of displacements; if not, an error on LINE.
   logical function are_equal(deck, a, b, line)
      type(checked_deck), intent(in) :: deck
      type(grid_card), intent(in)    :: a, b
      integer, intent(in)            :: line

      are_equal = a%cd == b%cd
      if (.not. are_equal) call deck%errors%add(line, 'nodes '//words([a%id, b%id])//' are one node of two parts, and have CD '// &
                                                integer_text(a%cd)//' and '//integer_text(b%cd)//'; expected one system')
   end function are_equal

   !> The distance of two nodes; 0 of scalar points.
   pure real(wp) function distance(a, b)
      type(grid_card), intent(in) :: a, b

      distance = 0.0_wp
      if (.not. a%is_scalar) distance = norm2(a%x - b%x)
   end function distance

   !> Two numbers, for a message.
   pure function words(ids)
      integer, intent(in)       :: ids(2)
      character(:), allocatable :: words

      words = integer_text(ids(1))//' and '//integer_text(ids(2))
   end function words

end module part_nodes
