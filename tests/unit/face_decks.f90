!> Cards of blocks of any kind of element with marks on two opposite sides, so that blocks of different meshes can be put on each
!! other.
module face_decks
   use kinds, only: wp
   use text_tools, only: integer_text
   implicit none
   private

   public :: block_cards, block_node, supports, all_moved, quarter

   real(wp), parameter :: quarter = 0.5_wp*acos(-1.0_wp)

   !> A block from LOW to HIGH of N elements in each direction, or boxes of six tetrahedra. A plane one with ANGLE > 0 is bent: y is
   !! the radius, and x runs from that angle down to 0.
   type, public :: block_type
      character(8) :: card = 'CQUAD4'        !! CQUAD4, CQUAD8, CHEXA, CHEXA20, CTETRA, CTETRA10
      integer  :: n(3) = 1                   !! in the plane two of them
      real(wp) :: low(3) = 0.0_wp, high(3) = 1.0_wp
      integer  :: first = 1                  !! number of the first node and element
      integer  :: property = 1
      integer  :: marks(2) = 0               !! PMARK of the side low and of that high in y, of solids in z; 0: none
      real(wp) :: angle = 0.0_wp
      real(wp) :: skew = 0.0_wp              !! moves the nodes inside the block by so much of a division
   end type block_type

   real(wp), parameter :: numbers(3) = [1.0_wp, 2.0_wp, 3.0_wp]

   ! the six tetrahedra of a box by their corners, 0 or 1 in x, y, z: along the sides from one corner to the opposite one
   integer, parameter :: order(3, 6) = reshape([1, 2, 3, 2, 3, 1, 3, 1, 2, 1, 3, 2, 2, 1, 3, 3, 2, 1], [3, 6])

contains

   !> The cards of BLOCK, each with a semicolon behind it.
   function block_cards(block) result(cards)
      type(block_type), intent(in) :: block
      character(:), allocatable :: cards
      integer :: at(3), d, e, i, j, k, points(3)

      cards = ''
      d = dimension_of(block)
      points = 0
      points(:d) = 2*block%n(:d)
      do k = 0, points(3)
         do j = 0, points(2)
            do i = 0, points(1)
               at = [i, j, k]
               if (is_node(block, at)) cards = cards//grid_card(block, at)
            end do
         end do
      end do
      e = block%first
      do k = 0, merge(block%n(3), 1, d == 3) - 1
         do j = 0, block%n(2) - 1
            do i = 0, block%n(1) - 1
               cards = cards//element_cards(block, 2*[i, j, k], e)
               if (j == 0 .and. d == 2) call mark(1, [i, j, k])
               if (j == block%n(2) - 1 .and. d == 2) call mark(2, [i, j + 1, k])
               if (k == 0 .and. d == 3) call mark(1, [i, j, k])
               if (k == block%n(3) - 1 .and. d == 3) call mark(2, [i, j, k + 1])
            end do
         end do
      end do
      do i = 1, 2
         if (block%marks(i) > 0) cards = cards//'PMARK,'//integer_text(block%marks(i))//';'
      end do

   contains

      !> Mark the side at AT, or its two halves of tetrahedra.
      subroutine mark(side, at)
         integer, intent(in) :: side, at(3)
         integer, parameter  :: x(3) = [2, 0, 0], y(3) = [0, 2, 0]
         character(:), allocatable :: head, rim(:)

         if (block%marks(side) == 0) return
         e = e + 1
         head = integer_text(e)//','//integer_text(block%marks(side))
         rim = [character(10) :: name(2*at), name(2*at + x), name(2*at + x + y), name(2*at + y)]
         if (d == 2) then
            cards = cards//'CBAR,'//head//joined(rim(:2))
         else if (index(block%card, 'CTETRA') == 1) then
            cards = cards//'CTRIA3,'//head//joined(rim(:3))
            e = e + 1
            cards = cards//'CTRIA3,'//integer_text(e)//','//integer_text(block%marks(side))//joined(rim([1, 3, 4]))
         else
            cards = cards//'CQUAD4,'//head//joined(rim)
         end if
      end subroutine mark

      function name(at) result(text)
         integer, intent(in) :: at(3)
         character(10) :: text

         text = integer_text(block_node(block, at))
      end function name

      !> Names, each with a comma before it, and the end of the card.
      function joined(names) result(text)
         character(*), intent(in)  :: names(:)
         character(:), allocatable :: text
         integer :: n

         text = ''
         do n = 1, size(names)
            text = text//','//trim(names(n))
         end do
         text = text//';'
      end function joined

   end function block_cards

   !> The number of the node at AT, counted in half divisions.
   pure integer function block_node(block, at) result(id)
      type(block_type), intent(in) :: block
      integer, intent(in)          :: at(3)

      id = block%first + at(1) + (2*block%n(1) + 1)*(at(2) + (2*block%n(2) + 1)*at(3))
   end function block_node

   !> Hold COMPONENTS of the nodes at AT(D), counted in divisions, in set 1.
   function supports(block, d, at, components) result(cards)
      type(block_type), intent(in) :: block
      integer, intent(in)          :: d, at
      character(*), intent(in)     :: components
      character(:), allocatable :: cards
      integer :: i, j, k, place(3), points(3)

      cards = ''
      points = 0
      points(:dimension_of(block)) = 2*block%n(:dimension_of(block))
      do k = 0, points(3)
         do j = 0, points(2)
            do i = 0, points(1)
               place = [i, j, k]
               if (place(d) /= 2*at .or. .not. is_node(block, place)) cycle
               cards = cards//'SPC1,1,'//components//','//integer_text(block_node(block, place))//';'
            end do
         end do
      end do
   end function supports

   !> Hold all nodes, in set 1, and move them BY along D, in set 10.
   function all_moved(block, d, by) result(cards)
      type(block_type), intent(in) :: block
      integer, intent(in)          :: d
      real(wp), intent(in)         :: by
      character(:), allocatable :: cards, ids
      integer :: at, next
      character(30) :: move

      write (move, '(f0.15)') by
      cards = ''
      do at = 0, 2*block%n(1)
         ids = layer(block, at)
         do while (ids /= '')
            next = index(ids, ',')
            cards = cards//'SPC1,1,'//trim(merge('12 ', '123', dimension_of(block) == 2))//','//ids(:next - 1)//';SPCD,10,'// &
                    ids(:next - 1)//','//integer_text(d)//','//trim(move)//';'
            ids = ids(next + 1:)
         end do
      end do
   end function all_moved

   !> The nodes of BLOCK at AT, in half divisions of x, each with a comma behind it.
   function layer(block, at) result(ids)
      type(block_type), intent(in) :: block
      integer, intent(in)          :: at
      character(:), allocatable :: ids
      integer :: j, k

      ids = ''
      do k = 0, merge(0, 2*block%n(3), dimension_of(block) == 2)
         do j = 0, 2*block%n(2)
            if (is_node(block, [at, j, k])) ids = ids//integer_text(block_node(block, [at, j, k]))//','
         end do
      end do
   end function layer

   pure integer function dimension_of(block) result(d)
      type(block_type), intent(in) :: block

      d = merge(2, 3, index(block%card, 'CQUAD') == 1)
   end function dimension_of

   !> Whether the elements have a node at AT: at the corners of the boxes, of second order on their edges too, of tetrahedra in faces
   !! and inside as well.
   pure logical function is_node(block, at)
      type(block_type), intent(in) :: block
      integer, intent(in)          :: at(3)

      select case (block%card)
      case ('CQUAD8', 'CHEXA20')
         is_node = count(modulo(at, 2) == 1) <= 1
      case ('CTETRA10')
         is_node = .true.
      case default
         is_node = all(modulo(at, 2) == 0)
      end select
   end function is_node

   function grid_card(block, at) result(card)
      type(block_type), intent(in) :: block
      integer, intent(in)          :: at(3)
      character(:), allocatable :: card
      real(wp) :: share(3), x(3)
      integer  :: d, k
      character(30) :: number

      d = dimension_of(block)
      x = 0.0_wp
      share = 0.0_wp
      share(:d) = at(:d)/(2.0_wp*block%n(:d))
      if (all(at(:d) > 1 .and. at(:d) < 2*block%n(:d) - 1)) then ! corners inside
         if (all(modulo(at, 2) == 0)) share(:d) = share(:d) + block%skew*sin(numbers(:d)*(at(1) + 2*at(2)))/block%n(:d)
      end if
      x(:d) = block%low(:d) + share(:d)*(block%high(:d) - block%low(:d))
      if (block%angle > 0.0_wp) x(:2) = x(2)*[cos(block%angle*(1.0_wp - share(1))), sin(block%angle*(1.0_wp - share(1)))]
      card = 'GRID,'//integer_text(block_node(block, at))//','
      do k = 1, d
         write (number, '(f0.15)') x(k)
         card = card//','//trim(number)
      end do
      card = card//';'
   end function grid_card

   !> The element, or the six tetrahedra, whose first corner is at AT; E is the number of the last element then.
   function element_cards(block, at, e) result(cards)
      type(block_type), intent(in) :: block
      integer, intent(in)          :: at(3)
      integer, intent(inout)       :: e
      character(:), allocatable :: cards
      integer, parameter :: corner(3, 8) = reshape([0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0, 0, 0, 2, 2, 0, 2, 2, 2, 2, 0, 2, 2], [3, 8])
      integer :: corners(3, 4), i, k

      cards = ''
      if (index(block%card, 'CTETRA') == 0) then
         call add(spread(at, 2, merge(4, 8, dimension_of(block) == 2)) + corner(:, :merge(4, 8, dimension_of(block) == 2)))
         return
      end if
      do i = 1, 6
         corners(:, 1) = at
         do k = 1, 3
            corners(:, k + 1) = corners(:, k)
            corners(order(k, i), k + 1) = corners(order(k, i), k + 1) + 2
         end do
         if (i > 3) corners(:, 2:3) = corners(:, [3, 2]) ! the other way round
         call add(corners)
      end do

   contains

      !> Add an element with its corners at these places, and the nodes between them.
      subroutine add(x)
         integer, intent(in) :: x(:, :)
         integer, allocatable :: between(:, :)
         integer :: j

         e = e + 1
         select case (block%card)
         case ('CQUAD8')
            between = (x + x(:, [2, 3, 4, 1]))/2
         case ('CHEXA20')
            between = (x(:, [1, 2, 3, 4, 1, 2, 3, 4, 5, 6, 7, 8]) + x(:, [2, 3, 4, 1, 5, 6, 7, 8, 6, 7, 8, 5]))/2
         case ('CTETRA10')
            between = (x(:, [1, 2, 3, 1, 2, 3]) + x(:, [2, 3, 1, 4, 4, 4]))/2
         case default
            between = x(:, :0)
         end select
         cards = cards//block%card(:verify(block%card, '0123456789 ', back=.true.))
         if (block%card == 'CQUAD4' .or. block%card == 'CQUAD8') cards = cards//block%card(6:6)
         cards = cards//','//integer_text(e)//','//integer_text(block%property)
         do j = 1, size(x, 2)
            cards = cards//','//integer_text(block_node(block, x(:, j)))
            if (j == 6 .and. size(x, 2) > 6) cards = cards//';+'
         end do
         do j = 1, size(between, 2)
            if (modulo(size(x, 2) + j - 7, 8) == 0) cards = cards//';+'
            cards = cards//','//integer_text(block_node(block, between(:, j)))
         end do
         cards = cards//';'
      end subroutine add

   end function element_cards

end module face_decks
