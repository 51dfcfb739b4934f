!> The generator of teaching meshes: BLOCK2, a quadrilateral block, and BLOCK3, a box; nodes numbered up each column first.
module block_mesh
   use bulk_data, only: block2_card, block3_card
   use element_kinds, only: kind_hexa8, kind_quad4
   use kinds, only: wp
   implicit none
   private

   public :: generate_block2, generate_block3, block_nodes, block_elements, block_side

   !> What a block gives: places are positions in its own node list.
   type, public :: block_type
      integer :: line = 0, id = 0, property = 0, weld = 0
      integer :: kind = 0                     !! of its elements
      integer, allocatable  :: node_id(:)
      real(wp), allocatable :: x(:, :)        !! (3, nodes)
      integer, allocatable  :: element_id(:)
      integer, allocatable  :: places(:, :)   !! (8, elements)
      integer :: n_sides = 0                  !! marked sides
      integer, allocatable  :: mark(:)        !! (n_sides) PMARK id
      integer, allocatable  :: number(:)      !! (n_sides) k: side Sk of the card
      integer, allocatable  :: side(:, :)     !! (4, n_sides) places of its corners, 0 behind the last
   end type block_type

contains

   !> The nodes, elements and marked sides of a BLOCK2.
   pure subroutine generate_block2(card, block)
      type(block2_card), intent(in) :: card
      type(block_type), intent(out) :: block
      integer, allocatable  :: corners(:, :)
      real(wp), allocatable :: x(:, :)
      integer :: i, side

      block%line = card%line
      block%id = card%id
      block%property = card%property
      block%weld = card%weld
      block%kind = kind_quad4
      call block_nodes(card, block%node_id, x)
      allocate (block%x(3, size(x, 2)), source=0.0_wp)
      block%x(:2, :) = x
      call block_elements(card, block%element_id, corners)
      allocate (block%places(8, size(corners, 2)), source=0)
      block%places(:4, :) = corners
      call start_sides(block, 2*sum(card%divisions))
      do side = 1, 4
         if (card%marks(side) == 0) cycle
         associate (places => block_side(card, side))
            do i = 1, size(places) - 1
               call add_side(block, card%marks(side), side, places(i:i + 1))
            end do
         end associate
      end do
   end subroutine generate_block2


   pure subroutine start_sides(block, most)
      type(block_type), intent(inout) :: block
      integer, intent(in)             :: most

      allocate (block%mark(most), block%number(most), source=0)
      allocate (block%side(4, most), source=0)
   end subroutine start_sides


   pure subroutine add_side(block, mark, number, places)
      type(block_type), intent(inout) :: block
      integer, intent(in)             :: mark, number, places(:)

      block%n_sides = block%n_sides + 1
      block%mark(block%n_sides) = mark
      block%number(block%n_sides) = number
      block%side(:size(places), block%n_sides) = places
   end subroutine add_side


   !> The nodes, elements and marked sides of a BLOCK3: node (i, j, k), all from 0, is number
   !! N1 + (i (NY + 1) + j)(NZ + 1) + k.
   pure subroutine generate_block3(card, block)
      type(block3_card), intent(in) :: card
      type(block_type), intent(out) :: block
      real(wp) :: r(0:card%divisions(1)), s(0:card%divisions(2)), t(0:card%divisions(3)), share(3)
      integer  :: corner, i, j, k, m, n(3), step(3) ! from node to node along x, y, z

      n = card%divisions
      step = [(n(2) + 1)*(n(3) + 1), n(3) + 1, 1]
      block%line = card%line
      block%id = card%id
      block%property = card%property
      block%weld = card%weld
      block%kind = kind_hexa8
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
               share = [r(i), s(j), t(k)]
               block%x(:, m) = card%corner(:, 1) + share*(card%corner(:, 2) - card%corner(:, 1))
            end do
         end do
      end do
      allocate (block%element_id(product(n)), block%places(8, product(n)))
      m = 0
      do i = 0, n(1) - 1
         do j = 0, n(2) - 1
            do k = 0, n(3) - 1
               m = m + 1
               block%element_id(m) = card%first_element + m - 1
               corner = 1 + dot_product([i, j, k], step)
               block%places(:4, m) = corner + [0, step(1), step(1) + step(2), step(2)]
               block%places(5:, m) = block%places(:4, m) + step(3)
            end do
         end do
      end do
      call start_sides(block, 2*(n(1)*n(2) + n(2)*n(3) + n(3)*n(1)))
      do m = 1, 2 ! low, high
         do i = 1, 3
            call mark_face(card, i, m == 2, step, block)
         end do
      end do
   end subroutine generate_block3


   !> The marked sides on one face of a box: where it begins or ends along AXIS. Their corners go round them as seen from outside.
   pure subroutine mark_face(card, axis, at_end, step, block)
      type(block3_card), intent(in)   :: card
      integer, intent(in)             :: axis    !! 1: x, 2: y, 3: z
      logical, intent(in)             :: at_end
      integer, intent(in)             :: step(3) !! from place to place along x, y, z
      type(block_type), intent(inout) :: block
      integer :: a, b, corner, i, j, places(4), side

      side = 2*axis - merge(0, 1, at_end)
      if (card%marks(side) == 0) return
      a = merge(2, 1, axis == 1) ! the two other axes, in ascending order
      b = merge(2, 3, axis == 3)
      do i = 0, card%divisions(a) - 1
         do j = 0, card%divisions(b) - 1
            corner = 1 + i*step(a) + j*step(b)
            if (at_end) corner = corner + card%divisions(axis)*step(axis)
            places = corner + [0, step(a), step(a) + step(b), step(b)]
            if (at_end .eqv. axis == 2) places = places(4:1:-1) ! right-handed are y z, z x, x y
            call add_side(block, card%marks(side), side, places)
         end do
      end do
   end subroutine mark_face


   !> Coordinates X(2, n) and numbers ID(n) of the nodes of a block, n = (NX + 1)(NY + 1). Node (i, j), i counting
   !! along side 1-2 and j along side 1-4, both from 0, is number N1 + i (NY + 1) + j and stands at the bilinear
   !! image of its graded place in the unit square.
   pure subroutine block_nodes(block, id, x)
      type(block2_card), intent(in)      :: block
      integer, allocatable, intent(out)  :: id(:)
      real(wp), allocatable, intent(out) :: x(:, :)
      real(wp) :: s(0:block%divisions(1)), t(0:block%divisions(2))
      integer  :: i, j, n

      call graded_places(block%grading(1), s)
      call graded_places(block%grading(2), t)
      n = (block%divisions(1) + 1)*(block%divisions(2) + 1)
      allocate (id(n), x(2, n))
      n = 0
      do i = 0, block%divisions(1)
         do j = 0, block%divisions(2)
            n = n + 1
            id(n) = block%first_node + n - 1
            x(:, n) = (1.0_wp - s(i))*(1.0_wp - t(j))*block%corner(:, 1) + s(i)*(1.0_wp - t(j))*block%corner(:, 2) &
                      + s(i)*t(j)*block%corner(:, 3) + (1.0_wp - s(i))*t(j)*block%corner(:, 4)
         end do
      end do
   end subroutine block_nodes


   !> Places 0 = s_0 < ... < s_n = 1 whose steps grow by a constant factor, the last RATIO times the first.
   pure subroutine graded_places(ratio, s)
      real(wp), intent(in)  :: ratio
      real(wp), intent(out) :: s(0:)
      real(wp) :: factor, step
      integer  :: i, n

      n = ubound(s, 1)
      factor = 1.0_wp
      if (n > 1) factor = ratio**(1.0_wp/(n - 1))
      s(0) = 0.0_wp
      step = 1.0_wp
      do i = 1, n
         s(i) = s(i - 1) + step
         step = step*factor
      end do
      if (abs(ratio - 1.0_wp) <= 0.0_wp) s = [(real(i, wp), i = 0, n)]
      s = s/s(n)
   end subroutine graded_places


   !> Places in the block's node list, NODES(4, n), of the corners of each element, counter-clockwise; element numbers
   !! go up each column too, ID(n) from E1.
   pure subroutine block_elements(block, id, nodes)
      type(block2_card), intent(in)     :: block
      integer, allocatable, intent(out) :: id(:), nodes(:, :)
      integer :: i, j, n, corner, column

      n = product(block%divisions)
      allocate (id(n), nodes(4, n))
      column = block%divisions(2) + 1
      n = 0
      do i = 0, block%divisions(1) - 1
         do j = 0, block%divisions(2) - 1
            n = n + 1
            id(n) = block%first_element + n - 1
            corner = i*column + j + 1
            nodes(:, n) = [corner, corner + column, corner + column + 1, corner + 1]
         end do
      end do
   end subroutine block_elements


   !> The nodes of side SIDE (1: corners 1-2, 2: 2-3, 3: 3-4, 4: 4-1) in this order, as places in the block's node list.
   pure function block_side(block, side) result(places)
      type(block2_card), intent(in)     :: block
      integer, intent(in)               :: side
      integer, allocatable              :: places(:)
      integer :: i, column, last_column

      column = block%divisions(2) + 1
      last_column = block%divisions(1)*column
      select case (side)
      case (1)
         allocate (places, source=[(i*column + 1, i = 0, block%divisions(1))])
      case (2)
         allocate (places, source=[(last_column + i, i = 1, column)])
      case (3)
         allocate (places, source=[(i*column + column, i = block%divisions(1), 0, -1)])
      case default
         allocate (places, source=[(i, i = column, 1, -1)])
      end select
   end function block_side

end module block_mesh
