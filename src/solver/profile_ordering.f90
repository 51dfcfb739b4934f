!> Profile ordering of nodes: reverse Cuthill-McKee from a pseudo-peripheral node.
!! Sources: Cuthill, McKee (Proc. 24th ACM Conf., 1969); George, Liu, Computer Solution of Large Sparse Positive
!! Definite Systems, 1981, chapter 4 (the start node, and why reversed).
module profile_ordering
   use node_graph, only: node_graph_type
   implicit none
   private

   public :: reverse_cuthill_mckee

contains

   !> ORDER(k) is the k-th node of the reverse Cuthill-McKee ordering of GRAPH, connected piece after connected piece.
   subroutine reverse_cuthill_mckee(graph, order)
      type(node_graph_type), intent(in)      :: graph
      integer, allocatable, intent(out) :: order(:)
      integer, allocatable :: level(:)
      integer :: start, n, node

      allocate (order(graph%n), level(graph%n), source=0)
      n = 0
      do node = 1, graph%n
         if (level(node) /= 0) cycle
         start = peripheral_node(graph, node, level)
         call number_piece(graph, start, level, order, n)
      end do
      order = order(graph%n:1:-1)
   end subroutine reverse_cuthill_mckee

   !> A node as far out as can be found cheaply in the piece of NODE: go to a node of least degree in the last level of
   !! its level structure as long as that makes the structure longer. LEVEL is left as it came.
   integer function peripheral_node(graph, node, level) result(start)
      type(node_graph_type), intent(in) :: graph
      integer, intent(in)          :: node
      integer, intent(inout)       :: level(:)
      integer, allocatable :: queue(:)
      integer :: depth, deepest, n, i, candidate

      allocate (queue(graph%n))
      start = node
      deepest = -1
      do
         call level_structure(graph, start, level, queue, n, depth)
         candidate = queue(n)
         do i = n, 1, -1
            if (level(queue(i)) /= depth) exit
            if (degree(graph, queue(i)) <= degree(graph, candidate)) candidate = queue(i)
         end do
         level(queue(:n)) = 0
         if (depth <= deepest) exit
         deepest = depth
         start = candidate
      end do
   end function peripheral_node

   !> Breadth-first levels 1, 2, ... from START; QUEUE(:N) are the nodes reached.
   subroutine level_structure(graph, start, level, queue, n, depth)
      type(node_graph_type), intent(in) :: graph
      integer, intent(in)          :: start
      integer, intent(inout)       :: level(:), queue(:)
      integer, intent(out)         :: n, depth
      integer :: i, k, other

      n = 1
      queue(1) = start
      level(start) = 1
      i = 0
      do while (i < n)
         i = i + 1
         do k = graph%first(queue(i)), graph%first(queue(i) + 1) - 1
            other = graph%neighbours(k)
            if (level(other) /= 0) cycle
            level(other) = level(queue(i)) + 1
            n = n + 1
            queue(n) = other
         end do
      end do
      depth = level(queue(n))
   end subroutine level_structure

   !> Number the piece of START: the neighbours of each node in ascending order of degree.
   subroutine number_piece(graph, start, level, order, n)
      type(node_graph_type), intent(in) :: graph
      integer, intent(in)          :: start
      integer, intent(inout)       :: level(:), order(:), n
      integer :: i, k, m, first, other

      i = n
      n = n + 1
      order(n) = start
      level(start) = 1
      do while (i < n)
         i = i + 1
         first = n + 1
         do k = graph%first(order(i)), graph%first(order(i) + 1) - 1
            other = graph%neighbours(k)
            if (level(other) /= 0) cycle
            level(other) = 1
            n = n + 1
            m = n          ! insertion sort: few neighbours
            do while (m > first)
               if (degree(graph, order(m - 1)) <= degree(graph, other)) exit
               order(m) = order(m - 1)
               m = m - 1
            end do
            order(m) = other
         end do
      end do
   end subroutine number_piece

   pure integer function degree(graph, node)
      type(node_graph_type), intent(in) :: graph
      integer, intent(in)          :: node

      degree = graph%first(node + 1) - graph%first(node)
   end function degree

end module profile_ordering
