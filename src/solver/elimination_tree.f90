!> The elimination tree of a symmetric matrix, from its graph alone: which column waits for which, how many rows each gets.
!! Source: Liu, SIAM J. Matrix Anal. Appl. 11 (1990) 134-172.
module elimination_tree
   use node_graph, only: node_graph_type
   implicit none
   private

   public :: number_places, find_parents, number_depth_first, order_depth_first, count_rows

contains

   !> PLACE(ORDER(k)) = k, 0 for other nodes.
   subroutine number_places(graph, order, place)
      type(node_graph_type), intent(in)   :: graph
      integer, intent(in)                 :: order(:)
      integer, allocatable, intent(inout) :: place(:)
      integer :: k

      if (.not. allocated(place)) allocate (place(graph%n), source=0)
      do k = 1, size(order)
         place(order(k)) = k
      end do
   end subroutine number_places

   !> The elimination tree of the first N_INNER places; what comes behind them is taken as one, number N_INNER + 1.
   subroutine find_parents(graph, order, place, n_inner, parent)
      type(node_graph_type), intent(in) :: graph
      integer, intent(in)               :: order(:), place(:), n_inner
      integer, allocatable, intent(out) :: parent(:) !! (n_inner) 0: none
      integer, allocatable :: ancestor(:)
      integer :: i, k, next, r, row

      allocate (parent(n_inner), ancestor(n_inner), source=0)
      do i = 1, size(order)
         row = min(i, n_inner + 1)
         do k = graph%first(order(i)), graph%first(order(i) + 1) - 1
            r = place(graph%neighbours(k))
            if (r == 0 .or. r >= row) cycle
            do
               next = ancestor(r)
               if (next == row) exit
               ancestor(r) = row              ! the way is shorter next time
               if (next == 0) then
                  parent(r) = row
                  exit
               end if
               r = next
            end do
         end do
      end do
   end subroutine find_parents

   !> Renumber a tree depth first, so that every subtree is without gaps; ORDER follows.
   subroutine order_depth_first(parent, order)
      integer, intent(inout) :: parent(:), order(:)
      integer, allocatable :: child(:), sibling(:), number(:), sequence(:)
      logical, allocatable :: is_root(:)
      integer :: j, n

      n = size(parent)
      allocate (is_root, source=parent == 0 .or. parent > n)
      allocate (child(n), sibling(n), source=0)
      do j = n, 1, -1
         if (is_root(j)) cycle
         sibling(j) = child(parent(j))
         child(parent(j)) = j
      end do
      call number_depth_first(is_root, child, sibling, number, sequence)
      do j = 1, n
         if (.not. is_root(j)) parent(j) = number(parent(j))
      end do
      parent = parent(sequence)
      order = order(sequence)
   end subroutine order_depth_first

   !> Number trees depth first, children first, from lists of children: NUMBER(i) is that of node i, 0 where no root leads to it;
   !! SEQUENCE is the other way round.
   pure subroutine number_depth_first(is_root, child, sibling, number, sequence)
      logical, intent(in)               :: is_root(:)
      integer, intent(inout)            :: child(:), sibling(:) !! the first child, the next of its parent, 0: none; gone then
      integer, allocatable, intent(out) :: number(:), sequence(:)
      integer :: first, n, node, root

      allocate (number(size(is_root)), sequence(size(is_root)), source=0)
      n = 0
      do root = 1, size(is_root)
         if (.not. is_root(root)) cycle
         node = root
         do
            do while (child(node) /= 0)
               first = child(node)
               child(node) = sibling(first)
               sibling(first) = node   ! the way back
               node = first
            end do
            n = n + 1
            number(node) = n
            sequence(n) = node
            if (node == root) exit
            node = sibling(node)
         end do
      end do
      sequence = sequence(:n)
   end subroutine number_depth_first

   !> BEYOND(j): rows below the diagonal in column j of the factor. Row i has an entry in column j where j lies on the way up
   !! the tree from a neighbour of i to i.
   subroutine count_rows(graph, order, place, parent, beyond)
      type(node_graph_type), intent(in) :: graph
      integer, intent(in)               :: order(:), place(:), parent(:)
      integer, allocatable, intent(out) :: beyond(:)
      integer, allocatable :: mark(:)
      integer :: i, j, k, n

      n = size(parent)
      allocate (beyond(n), mark(n), source=0)
      do i = 1, size(order)
         if (i <= n) mark(i) = i
         do k = graph%first(order(i)), graph%first(order(i) + 1) - 1
            j = place(graph%neighbours(k))
            if (j == 0 .or. j >= i .or. j > n) cycle
            do while (mark(j) /= i)
               mark(j) = i
               beyond(j) = beyond(j) + 1
               j = parent(j)
               if (j == 0 .or. j > n) exit
            end do
         end do
      end do
   end subroutine count_rows

end module elimination_tree
