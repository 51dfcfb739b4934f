!> Profile ordering of nodes: reverse Cuthill-McKee from a pseudo-peripheral node.
!! Sources: Cuthill, McKee (Proc. 24th ACM Conf., 1969); George, Liu, Computer Solution of Large Sparse Positive
!! Definite Systems, 1981, chapter 4 (the start node, and why reversed).
module node_ordering
   use model_data, only: model_type, n_bars
   use section_coupling, only: section_node
   implicit none
   private

   public :: build_node_graph, reverse_cuthill_mckee

   !> Nodes and their neighbours: neighbours(first(i):first(i+1)-1) share an element or interface element with node i.
   type, public :: node_graph
      integer :: n = 0
      integer, allocatable :: first(:)      !! (n + 1)
      integer, allocatable :: neighbours(:)
   end type node_graph

contains

   !> The graph of all nodes of MODEL; time and memory linear in its size.
   subroutine build_node_graph(model, graph)
      type(model_type), intent(in)  :: model
      type(node_graph), intent(out) :: graph
      integer, allocatable :: mark(:), partner_first(:), partners(:)
      integer :: e, i, k, node, other, pass, n

      call list_partners(model, partner_first, partners)
      graph%n = model%n_nodes
      allocate (graph%first(graph%n + 1), mark(graph%n))
      do pass = 1, 2 ! count, then fill
         mark = 0
         n = 0
         do node = 1, graph%n
            graph%first(node) = n + 1
            mark(node) = node
            do i = model%first_at(node), model%first_at(node + 1) - 1
               e = model%elements_at(i)
               do k = 1, size(model%element_nodes, 1)
                  call visit(model%element_nodes(k, e))
               end do
               call visit(section_node(model, e))
            end do
            do i = partner_first(node), partner_first(node + 1) - 1
               call visit(partners(i))
            end do
         end do
         graph%first(graph%n + 1) = n + 1
         if (pass == 1) allocate (graph%neighbours(n))
      end do

   contains

      subroutine visit(candidate)
         integer, intent(in) :: candidate

         other = candidate
         if (other == 0) return ! behind the last corner, or no section
         if (mark(other) == node) return
         mark(other) = node
         n = n + 1
         if (pass == 2) graph%neighbours(n) = other
      end subroutine visit

   end subroutine build_node_graph


   !> The nodes at the other ends of the interface elements and bars of every node.
   pure subroutine list_partners(model, first, partners)
      type(model_type), intent(in)      :: model
      integer, allocatable, intent(out) :: first(:), partners(:)
      integer, allocatable :: filled(:)
      integer :: i, node, side

      allocate (first(model%n_nodes + 1), source=0)
      do i = 1, size(model%interface)
         if (model%interface(i)%nodes(2) == 0) cycle
         first(model%interface(i)%nodes + 1) = first(model%interface(i)%nodes + 1) + 1
      end do
      do i = 1, n_bars(model)
         first(model%bars(i)%nodes + 1) = first(model%bars(i)%nodes + 1) + 1
      end do
      first(1) = 1
      do node = 1, model%n_nodes
         first(node + 1) = first(node) + first(node + 1)
      end do
      allocate (partners(first(model%n_nodes + 1) - 1))
      allocate (filled, source=first)
      do i = 1, size(model%interface)
         if (model%interface(i)%nodes(2) == 0) cycle
         do side = 1, 2
            node = model%interface(i)%nodes(side)
            partners(filled(node)) = model%interface(i)%nodes(3 - side)
            filled(node) = filled(node) + 1
         end do
      end do
      do i = 1, n_bars(model)
         do side = 1, 2
            node = model%bars(i)%nodes(side)
            partners(filled(node)) = model%bars(i)%nodes(3 - side)
            filled(node) = filled(node) + 1
         end do
      end do
   end subroutine list_partners


   !> ORDER(k) is the k-th node of the reverse Cuthill-McKee ordering of GRAPH, connected piece after connected piece.
   subroutine reverse_cuthill_mckee(graph, order)
      type(node_graph), intent(in)      :: graph
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
      type(node_graph), intent(in) :: graph
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
      type(node_graph), intent(in) :: graph
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
      type(node_graph), intent(in) :: graph
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
      type(node_graph), intent(in) :: graph
      integer, intent(in)          :: node

      degree = graph%first(node + 1) - graph%first(node)
   end function degree

end module node_ordering
