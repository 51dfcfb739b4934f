!> The generator of teaching meshes: BLOCK2, a quadrilateral block, nodes numbered up each column first.
module block_mesh
   use bulk_data, only: block2_card
   use kinds, only: wp
   implicit none
   private

   public :: block_nodes, block_elements, block_side

contains

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
      type(block2_card), intent(in) :: block
      integer, intent(in)  :: side
      integer, allocatable :: places(:)
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
