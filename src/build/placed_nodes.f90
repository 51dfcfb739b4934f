!> Nodes defined by position or surface: reference nodes of RBE2M and RBE3M, and NODEAT.
!! A new reference node lies at the centroid of its marked surface. NODEAT is another number for the node nearest to a position.
module placed_nodes
   use bulk_data, only: element_card
   use deck_check, only: checked_deck
   use element_kinds, only: element_table
   use kinds, only: wp
   use model_data, only: model_type, placed_node
   use node_build, only: append_nodes, highest_number
   use numbers, only: cross
   use text_tools, only: integer_text
   implicit none
   private

   public :: place_nodes

contains

   !> Append the reference nodes of RBE2M and RBE3M that name none: each at the centroid of its surface, numbered from the highest node
   !! number of the deck on. Find the nodes of NODEAT cards.
   subroutine place_nodes(deck, sides, model)
      type(checked_deck), intent(inout) :: deck
      type(element_card), intent(in)    :: sides(:) !! of blocks
      type(model_type), intent(inout)   :: model
      real(wp), allocatable :: x(:, :)
      integer :: highest, i, n, n_given

      n_given = model%n_nodes
      allocate (model%placed(size(deck%bulk%place)))
      model%placed%id = deck%bulk%place%id ! reference nodes get higher numbers
      allocate (x(3, merge(count(deck%rigid%surface > 0 .and. deck%rigid%node == 0), 0, n_given > 0)))
      if (size(x, 2) > 0) then
         highest = highest_number(model)
         if (highest > huge(1) - size(x, 2)) then
            call deck%errors%add(0, 'the reference nodes of RBE2M and RBE3M get numbers above node '//integer_text(highest)// &
                                 ', and their numbers would exceed 2147483647')
         else
            n = 0
            do i = 1, size(deck%rigid)
               associate (card => deck%rigid(i))
                  if (card%surface == 0 .or. card%node > 0) cycle
                  n = n + 1
                  card%node = highest + n
                  x(:, n) = centroid(model, side_cards(deck, sides, card%surface))
               end associate
            end do
            call append_nodes(model, x)
         end if
      end if
      call find_places(deck, sides, n_given, model)
   end subroutine place_nodes

   !> The cards that mark the sides of SURFACE, those of blocks included.
   pure function side_cards(deck, of_blocks, surface) result(cards)
      type(checked_deck), intent(in) :: deck
      type(element_card), intent(in) :: of_blocks(:)
      integer, intent(in)            :: surface
      type(element_card), allocatable :: cards(:)

      associate (edge => deck%bulk%edge%element_card, element => deck%bulk%element)
         cards = [pack(edge, edge%property == surface), pack(element, element%property == surface), &
                  pack(of_blocks, of_blocks%property == surface)]
      end associate
   end function side_cards

   !> The first N nodes on CARD, without missing ones.
   pure function nodes_on(model, card, n) result(nodes)
      type(model_type), intent(in)   :: model
      type(element_card), intent(in) :: card
      integer, intent(in)            :: n
      integer, allocatable :: nodes(:)
      integer :: k

      nodes = [(model%node_table%find(card%nodes(k)), k = 1, n)]
      nodes = pack(nodes, nodes > 0)
   end function nodes_on

   !> The centroid of the sides on CARDS, weighted by length of edges or area of faces; the mean of the nodes where the total is zero.
   pure function centroid(model, cards)
      type(model_type), intent(in)   :: model
      type(element_card), intent(in) :: cards(:)
      real(wp) :: centroid(3), extent, total
      integer  :: k, n, s

      centroid = 0.0_wp
      total = 0.0_wp
      do s = 1, size(cards)
         n = merge(2, element_table(max(1, cards(s)%kind))%n_corners, cards(s)%kind <= 0) ! corners
         associate (p => model%x(:, nodes_on(model, cards(s), n)))
            n = size(p, 2)
            if (n == 2) then
               extent = norm2(p(:, 2) - p(:, 1))
               centroid = centroid + extent*0.5_wp*(p(:, 1) + p(:, 2))
               total = total + extent
            end if
            do k = 2, n - 1
               extent = 0.5_wp*norm2(cross(p(:, k) - p(:, 1), p(:, k + 1) - p(:, 1)))
               centroid = centroid + extent*(p(:, 1) + p(:, k) + p(:, k + 1))/3.0_wp
               total = total + extent
            end do
         end associate
      end do
      if (total > 0.0_wp) centroid = centroid/total
   end function centroid

   !> The nodes of NODEAT cards: the number of a card becomes a number of the node nearest to its position. Of equally near nodes the
   !! new reference node of an RBE2M or RBE3M is taken, else the node with the lowest number.
   subroutine find_places(deck, sides, n_given, model)
      type(checked_deck), intent(in)  :: deck
      type(element_card), intent(in)  :: sides(:) !! of blocks
      integer, intent(in)             :: n_given !! number of nodes before the new reference nodes
      type(model_type), intent(inout) :: model
      type(element_card), allocatable :: marking(:)
      real(wp), allocatable :: distance(:)
      logical, allocatable  :: is_meant(:)
      real(wp) :: rounding
      integer  :: i, k

      model%placed = [placed_node ::]
      do i = 1, size(deck%rigid)
         associate (card => deck%rigid(i))
            if (card%surface > 0) model%placed = [model%placed, placed_node(element=card%id, surface=card%surface, &
                                                                            node=model%node_table%find(card%node))]
         end associate
      end do
      if (size(deck%bulk%place) == 0 .or. model%n_nodes == 0) return
      rounding = 1.0e-9_wp*maxval(maxval(model%x, dim=2) - minval(model%x, dim=2))
      do i = 1, size(deck%bulk%place)
         associate (card => deck%bulk%place(i))
            if (card%id == 0) cycle
            if (any(model%node_id == card%id)) then
               call deck%field_error(card%line, 'ID', 'there is a node '//integer_text(card%id)// &
                                     ' already; expected another number')
               cycle
            end if
            is_meant = spread(card%surface == 0, 1, model%n_nodes)
            marking = side_cards(deck, sides, card%surface)
            do k = 1, merge(size(marking), 0, card%surface > 0)
               is_meant(nodes_on(model, marking(k), merge(3, 8, marking(k)%kind <= 0))) = .true.
            end do
            do k = 1, size(model%placed)
               if (model%placed(k)%surface == card%surface .and. model%placed(k)%node > 0) is_meant(model%placed(k)%node) = .true.
            end do
            if (.not. any(is_meant)) then
               call deck%field_error(card%line, 'PID', 'surface '//integer_text(card%surface)//' has no nodes; '// &
                                     'expected a PMARK with faces or edges, or blank')
               cycle
            end if
            distance = norm2(model%x - spread(card%x, 2, model%n_nodes), dim=1)
            is_meant = is_meant .and. distance <= minval(distance, mask=is_meant) + rounding
            if (any(is_meant(n_given + 1:))) is_meant(:n_given) = .false.
            model%placed = [model%placed, placed_node(id=card%id, surface=card%surface, x=card%x, &
                                                      node=findloc(is_meant, .true., dim=1))]
         end associate
      end do
      associate (named => model%placed%id > 0)
         call model%node_table%add(pack(model%placed%id, named), pack(model%placed%node, named))
      end associate
   end subroutine find_places

end module placed_nodes
