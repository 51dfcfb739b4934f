!> The elimination tree of a symmetric matrix, from its graph alone: which column waits for which, how many rows each gets.
!! Source: Liu, SIAM J. Matrix Anal. Appl. 11 (1990) 134-172.
module elimination_tree
   use node_graph, only: node_graph_type
   implicit none
   private

   public :: number_places, find_parents, order_depth_first, count_rows

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
      integer, allocatable :: child(:), sibling(:), number(:), new_parent(:), new_order(:)
      integer :: j, n, roots, node, done

      n = size(parent)
      allocate (child(n), sibling(n), number(n), source=0)
      roots = 0
      do j = n, 1, -1
         if (parent(j) == 0 .or. parent(j) > n) then
            sibling(j) = roots
            roots = j
         else
            sibling(j) = child(parent(j))
            child(parent(j)) = j
         end if
      end do
      done = 0
      do while (roots /= 0)
         node = roots
         roots = sibling(roots)
         walk: do
            do while (child(node) /= 0)   ! down to the first child that is not numbered
               j = child(node)
               child(node) = sibling(j)
               node = j
            end do
            done = done + 1
            number(node) = done
            if (parent(node) == 0 .or. parent(node) > n) exit walk
            node = parent(node)
         end do walk
      end do
      allocate (new_parent(n), new_order(n))
      do j = 1, n
         new_order(number(j)) = order(j)
         new_parent(number(j)) = parent(j)
         if (parent(j) > 0 .and. parent(j) <= n) new_parent(number(j)) = number(parent(j))
      end do
      parent = new_parent
      order = new_order
   end subroutine order_depth_first


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
