!> Block meshes: the GRID, element and side cards that a BLOCK2, a quadrilateral block, or a BLOCK3, a box, stands for.
!! Nodes are numbered up each column first. A welded block uses the coincident nodes of an earlier block.
module block_mesh
   use bulk_data, only: block_card, edge_cbar, element_card, grid_card
   use deck_check, only: checked_deck
   use element_kinds, only: kind_hexa20, kind_hexa8, kind_quad4, kind_quad8
   use kinds, only: wp
   use node_build, only: scalar_points
   use spatial_search, only: spatial_search_type
   use text_tools, only: integer_text
   use tolerances, only: welded_nodes
   implicit none
   private

   public :: generate_block, collect_cards

   !> The mesh of a block. The cards of its elements and sides name nodes by their positions in the block.
   type, public :: block_type
      integer, allocatable  :: node_id(:)
      real(wp), allocatable :: x(:, :)                !! (3, nodes) [length]
      type(element_card), allocatable :: element(:)   !! corners alone: mid-edge nodes are added later, like blank ones on cards
      integer :: n_sides = 0
      type(element_card), allocatable :: side(:)      !! (n_sides) the property is a PMARK, the id is -k for side Sk of the card
   end type block_type

   !> The mesh cards of a deck, followed by those of its blocks.
   type, public :: mesh_card_type
      type(grid_card), allocatable    :: grid(:)
      type(element_card), allocatable :: element(:)
      type(element_card), allocatable :: side(:)      !! of blocks alone, as above
   end type mesh_card_type

contains

   !> The mesh cards of DECK. Errors: a block that cannot be welded.
   subroutine collect_cards(deck, cards)
      type(checked_deck), intent(in)    :: deck
      type(mesh_card_type), intent(out) :: cards
      type(block_type), allocatable :: blocks(:)
      logical, allocatable :: is_welded(:)
      integer :: b, i

      cards%grid = [deck%bulk%grid, scalar_points(deck)]
      cards%element = deck%bulk%element
      allocate (cards%side(0), blocks(size(deck%bulk%block)))
      do b = 1, size(blocks)
         associate (card => deck%bulk%block(b), block => blocks(b))
            call generate_block(card, block)
            call weld_block(deck, b, blocks, is_welded)
            cards%grid = [cards%grid, pack([(grid_card(line=card%line, id=block%node_id(i), x=block%x(:, i), &
                                                       doubtful=card%doubtful), i = 1, size(is_welded))], .not. is_welded)]
            call name_nodes(block%node_id, block%element)
            call name_nodes(block%node_id, block%side)
            cards%element = [cards%element, block%element]
            cards%side = [cards%side, block%side]
         end associate
      end do
   end subroutine collect_cards

   !> Replace positions in the list ID by the numbers there.
   pure subroutine name_nodes(id, cards)
      integer, intent(in)               :: id(:)
      type(element_card), intent(inout) :: cards(:)
      integer :: i

      do i = 1, size(cards)
         associate (n => count(cards(i)%nodes > 0))
            cards(i)%nodes(:n) = id(cards(i)%nodes(:n))
         end associate
      end do
   end subroutine name_nodes

   !> Give the nodes of block B that coincide with nodes of the earlier block to which it is welded the numbers of these.
   subroutine weld_block(deck, b, blocks, is_welded)
      type(checked_deck), intent(in)    :: deck
      integer, intent(in)               :: b
      type(block_type), intent(inout)   :: blocks(:)
      logical, allocatable, intent(out) :: is_welded(:) !! (nodes of block B)
      type(spatial_search_type) :: search
      integer, allocatable :: near_this(:), near_other(:)
      real(wp) :: reach, distance
      integer  :: k, other, found

      allocate (is_welded(size(blocks(b)%node_id)), source=.false.)
      associate (card => deck%bulk%block(b))
         if (card%weld == 0) return
         other = findloc(deck%bulk%block(:b - 1)%id, card%weld, dim=1, back=.true.)
         if (other == 0) then
            call deck%field_error(card%line, 'WELD', 'no BLOCK'//integer_text(card%dimension)//' '//integer_text(card%weld)// &
                                  ' stands before this one')
            return
         end if
      end associate
      reach = welded_nodes*maxval(maxval(blocks(b)%x, dim=2) - minval(blocks(b)%x, dim=2))
      call nodes_near(blocks(other)%x, blocks(b)%x, reach, near_this)
      call nodes_near(blocks(b)%x, blocks(other)%x, reach, near_other)
      call search%build(blocks(other)%x(:, near_this))
      do k = 1, size(near_other)
         call search%nearest(blocks(b)%x(:, near_other(k)), reach, found, distance)
         if (found == 0) cycle
         is_welded(near_other(k)) = .true.
         blocks(b)%node_id(near_other(k)) = blocks(other)%node_id(near_this(found))
      end do
      if (.not. any(is_welded)) call deck%field_error(deck%bulk%block(b)%line, 'WELD', 'the two blocks have no node in common')
   end subroutine weld_block

   !> The NODES of X within REACH of the box around OTHERS: for two adjacent blocks those of one face only.
   pure subroutine nodes_near(x, others, reach, nodes)
      real(wp), intent(in)              :: x(:, :), others(:, :) !! (3, n) [length]
      real(wp), intent(in)              :: reach                 !! [length]
      integer, allocatable, intent(out) :: nodes(:)
      logical, allocatable :: is_near(:)
      integer :: k

      allocate (is_near(size(x, 2)), source=.true.)
      do k = 1, 3
         is_near = is_near .and. x(k, :) >= minval(others(k, :)) - reach .and. x(k, :) <= maxval(others(k, :)) + reach
      end do
      nodes = pack([(k, k = 1, size(x, 2))], is_near)
   end subroutine nodes_near

   !> The nodes, elements and marked sides of a CARD. Node (i, j, k) has the number N1 + (i (NY + 1) + j)(NZ + 1) + k, where i
   !! counts along x or side 1-2, j along y or side 1-4 and k along z, all from 0. Element numbers also run up each column, from E1.
   pure subroutine generate_block(card, block)
      type(block_card), intent(in)  :: card
      type(block_type), intent(out) :: block
      real(wp) :: r(0:card%divisions(1)), s(0:card%divisions(2)), t(0:card%divisions(3))
      integer  :: corner, i, j, k, kind, m, n(3), step(3) ! step: increments of the position along x, y, z

      n = card%divisions
      step = [(n(2) + 1)*(n(3) + 1), n(3) + 1, 1]
      call graded_places(card%grading(1), r)
      call graded_places(card%grading(2), s)
      call graded_places(card%grading(3), t)
      allocate (block%node_id(product(n + 1)), block%x(3, product(n + 1)))
      m = 0
      do i = 0, n(1)
         do j = 0, n(2)
            do k = 0, n(3)
               m = m + 1
               block%node_id(m) = card%first_node + m - 1
               block%x(:, m) = point(card, r(i), s(j), t(k))
            end do
         end do
      end do
      if (card%dimension == 2) then
         kind = merge(kind_quad8, kind_quad4, card%order == 2)
         allocate (block%side(2*(n(1) + n(2))))
         do k = 1, 4
            call mark_side(card, k, step, block)
         end do
      else
         kind = merge(kind_hexa20, kind_hexa8, card%order == 2)
         allocate (block%side(2*(n(1)*n(2) + n(2)*n(3) + n(3)*n(1))))
         do k = 1, 6
            call mark_side(card, merge(2*k - 1, 2*k - 6, k <= 3), step, block)
         end do
      end if
      block%side = block%side(:block%n_sides)
      n(3) = max(1, n(3))
      allocate (block%element(product(n)))
      block%element%line = card%line
      block%element%property = card%property
      block%element%kind = kind
      m = 0
      do i = 0, n(1) - 1
         do j = 0, n(2) - 1
            do k = 0, n(3) - 1
               m = m + 1
               block%element(m)%id = card%first_element + m - 1
               corner = 1 + dot_product([i, j, k], step)
               associate (nodes => block%element(m)%nodes)
                  nodes(:4) = corner + [0, step(1), step(1) + step(2), step(2)]
                  if (card%dimension == 3) nodes(5:8) = nodes(:4) + step(3)
               end associate
            end do
         end do
      end do
   end subroutine generate_block

   !> Position of the node of a block with the graded coordinates R, S, T in the unit square or cube: bilinear interpolation of the
   !! corners, in a box linear interpolation between its two corners.
   pure function point(card, r, s, t) result(x)
      type(block_card), intent(in) :: card
      real(wp), intent(in)         :: r, s, t
      real(wp) :: x(3)

      associate (c => card%corner)
         if (card%dimension == 3) then
            x = c(:, 1) + [r, s, t]*(c(:, 2) - c(:, 1))
         else
            x = (1.0_wp - r)*(1.0_wp - s)*c(:, 1) + r*(1.0_wp - s)*c(:, 2) + r*s*c(:, 3) + (1.0_wp - r)*s*c(:, 4)
         end if
      end associate
   end function point

   !> Coordinates 0 = s_0 < ... < s_n = 1 whose steps grow by a constant factor; the last step is RATIO times the first.
   pure subroutine graded_places(ratio, s)
      real(wp), intent(in)  :: ratio
      real(wp), intent(out) :: s(0:)
      real(wp) :: factor, step
      integer  :: i, n

      n = ubound(s, 1)
      s(0) = 0.0_wp
      if (n == 0) return
      factor = 1.0_wp
      if (n > 1) factor = ratio**(1.0_wp/(n - 1))
      step = 1.0_wp
      do i = 1, n
         s(i) = s(i - 1) + step
         step = step*factor
      end do
      s = s/s(n)
   end subroutine graded_places

   !> The marked sides on side NUMBER of a block. Edges of a quadrilateral (1: corners 1-2, 2: 2-3, 3: 3-4, 4: 4-1) follow in this
   !! order. Faces of a box (x low, x high, y low and so on) have their corners counter-clockwise as seen from outside. The edges
   !! are those of the faces at z low: of the faces y low, x high, y high and x low.
   pure subroutine mark_side(card, number, step, block)
      type(block_card), intent(in)    :: card
      integer, intent(in)             :: number
      integer, intent(in)             :: step(3) !! increments of the position along x, y, z
      type(block_type), intent(inout) :: block
      integer, parameter :: face_of_edge(4) = [3, 2, 4, 1]
      integer :: a, axis, b, corner, face, i, j, k, places(4)
      logical :: at_end, is_turned

      if (card%marks(number) == 0) return
      face = number
      if (card%dimension == 2) face = face_of_edge(number)
      axis = (face + 1)/2
      at_end = face == 2*axis
      is_turned = at_end .eqv. axis == 2 ! y z, z x and x y are right-handed
      a = merge(2, 1, axis == 1)         ! the two other axes, in ascending order
      b = merge(2, 3, axis == 3)
      do k = 0, card%divisions(a) - 1
         i = k
         if (is_turned .and. card%dimension == 2) i = card%divisions(a) - 1 - k
         do j = 0, max(1, card%divisions(b)) - 1
            corner = 1 + i*step(a) + j*step(b)
            if (at_end) corner = corner + card%divisions(axis)*step(axis)
            places = corner + [0, step(a), step(a) + step(b), step(b)]
            block%n_sides = block%n_sides + 1
            associate (side => block%side(block%n_sides), n => merge(2, 4, card%dimension == 2))
               side%line = card%line
               side%property = card%marks(number)
               side%id = -number
               side%kind = merge(edge_cbar, kind_quad4, card%dimension == 2)
               side%nodes(:n) = places(:n)
               if (is_turned) side%nodes(:n) = places(n:1:-1)
            end associate
         end do
      end do
   end subroutine mark_side

end module block_mesh
