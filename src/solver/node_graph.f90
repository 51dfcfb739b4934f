!> The graph of nodes that share an element, and its reverse Cuthill-McKee ordering. The ordering begins at a pseudo-peripheral
!! node.
!! Sources: Cuthill, McKee (Proc. 24th ACM Conf., 1969); George, Liu, Computer Solution of Large Sparse Positive
!! Definite Systems, 1981, chapter 4 (the start node, and why reversed).
module node_graph
   use element_unknowns, only: displaced_nodes, last_displaced, nodes_of_unknowns
   use lists, only: list_owners
   use mass_matrix, only: mass_nodes, n_masses
   use mesh_queries, only: is_face_node
   use model_data, only: bar_nodes, model_type, n_bars
   use node_coupling, only: unknown_nodes
   implicit none
   private

   public :: build_node_graph, list_joined, part_of_graph, reverse_cuthill_mckee

   !> Nodes and their neighbours: neighbours(first(i):first(i+1)-1) share an element or interface element with node i.
   type, public :: node_graph_type
      integer :: n = 0
      integer, allocatable :: first(:)      !! (n + 1)
      integer, allocatable :: neighbours(:)
      logical :: with_masses = .false.      !! nodal masses couple their nodes: a shift is possible
   end type node_graph_type

contains

   !> The graph of all nodes of MODEL; time and memory are linear in its size. WITH_MASSES, nodal masses couple their nodes.
   subroutine build_node_graph(model, graph, with_masses)
      type(model_type), intent(in)  :: model
      type(node_graph_type), intent(out) :: graph
      logical, intent(in), optional :: with_masses !! false
      integer, allocatable :: mark(:), joined(:, :), first_list(:), lists_at(:)
      integer :: e, i, k, node, pass, n

      graph%n = model%mesh%n_nodes
      if (present(with_masses)) graph%with_masses = with_masses
      call list_joined(model, graph%with_masses, .true., joined)
      call list_owners(graph%n, joined, first_list, lists_at)
      allocate (graph%first(graph%n + 1), mark(graph%n))
      do pass = 1, 2 ! count, then fill
         mark = 0
         n = 0
         do node = 1, graph%n
            graph%first(node) = n + 1
            mark(node) = node
            if (.not. is_face_node(model%mesh, node)) then ! a face has no unknowns
               do i = model%mesh%first_at(node), model%mesh%first_at(node + 1) - 1
                  e = model%mesh%elements_at(i)
                  do k = model%freedoms%table%first(e), last_displaced(model%freedoms%table, e)
                     call visit(model%freedoms%table%node(k))
                  end do
               end do
            end if
            do i = first_list(node), first_list(node + 1) - 1
               do k = 1, size(joined, 1)
                  call visit(joined(k, lists_at(i)))
               end do
            end do
         end do
         graph%first(graph%n + 1) = n + 1
         if (pass == 1) allocate (graph%neighbours(n))
      end do

   contains

      subroutine visit(other)
         integer, intent(in) :: other

         if (other == 0) return ! end of a list
         if (mark(other) == node) return
         mark(other) = node
         n = n + 1
         if (pass == 2) graph%neighbours(n) = other
      end subroutine visit

   end subroutine build_node_graph

   !> JOINED(:, n): the nodes that interface elements and bars couple; WITH_MASSES also nodal masses; WITH_BODIES also body
   !! elements with coupled nodes; 0 behind the last.
   subroutine list_joined(model, with_masses, with_bodies, joined)
      type(model_type), intent(in)      :: model
      logical, intent(in)               :: with_masses, with_bodies
      integer, allocatable, intent(out) :: joined(:, :)
      integer, allocatable :: wider(:, :)
      integer :: e, i, n

      allocate (joined(2, size(model%joints%element) + n_bars(model%mesh)), source=0)
      n = 0
      do i = 1, size(model%joints%element)
         call join(unknown_nodes(model%freedoms, model%joints%element(i)%node))
      end do
      do i = 1, n_bars(model%mesh)
         call join(unknown_nodes(model%freedoms, bar_nodes(model%mesh%bars(i))))
      end do
      if (with_masses) then
         do i = 1, n_masses(model)
            call join(unknown_nodes(model%freedoms, mass_nodes(model, model%mesh%masses(i))))
         end do
      end if
      if (.not. (with_bodies .and. model%freedoms%coupling%n > 0)) return
      do e = 1, model%mesh%n_elements
         ! an unknown of the element may belong to a node that does not participate
         associate (displaced => displaced_nodes(model%freedoms, e), unknown => nodes_of_unknowns(model%freedoms, e))
            if (any([(all(displaced /= unknown(i)), i = 1, size(unknown))])) call join(unknown)
         end associate
      end do
      joined = joined(:, :n)

   contains

      subroutine join(nodes)
         integer, intent(in) :: nodes(:)

         n = n + 1
         if (size(nodes) > size(joined, 1) .or. n > size(joined, 2)) then
            allocate (wider(max(size(nodes), size(joined, 1)), max(size(joined, 2), merge(2*n, 0, n > size(joined, 2)))), source=0)
            wider(:size(joined, 1), :n - 1) = joined(:, :n - 1)
            call move_alloc(wider, joined)
         end if
         joined(:size(nodes), n) = nodes
      end subroutine join

   end subroutine list_joined

   !> The PART of GRAPH with NODES only, numbered in their sequence.
   pure subroutine part_of_graph(graph, nodes, number, part)
      type(node_graph_type), intent(in)  :: graph
      integer, intent(in)                :: nodes(:)
      integer, intent(inout)             :: number(:) !! (graph%n) work space: zero on entry and on return
      type(node_graph_type), intent(out) :: part
      integer :: i, k, m

      part%n = size(nodes)
      number(nodes) = [(i, i = 1, part%n)]
      m = sum([(count(number(graph%neighbours(graph%first(nodes(i)):graph%first(nodes(i) + 1) - 1)) > 0), i = 1, part%n)])
      allocate (part%first(part%n + 1), part%neighbours(m))
      m = 0
      do i = 1, part%n
         part%first(i) = m + 1
         do k = graph%first(nodes(i)), graph%first(nodes(i) + 1) - 1
            if (number(graph%neighbours(k)) == 0) cycle
            m = m + 1
            part%neighbours(m) = number(graph%neighbours(k))
         end do
      end do
      part%first(part%n + 1) = m + 1
      number(nodes) = 0
   end subroutine part_of_graph

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
         call reach(graph, start, .true., level, order, n)
      end do
      order = order(graph%n:1:-1)
   end subroutine reverse_cuthill_mckee

   !> A pseudo-peripheral node of the piece of NODE: go to a node of least degree in the last level of the level structure as
   !! long as the structure becomes longer. LEVEL is unchanged on return.
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
         n = 0
         call reach(graph, start, .false., level, queue, n)
         depth = level(queue(n))
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

   !> Breadth-first search from START: nodes that are reached, with LEVEL 0 on entry, are appended to QUEUE behind the first N
   !! and get levels 1, 2, ...; neighbours in ascending order, BY_DEGREE of their degree.
   subroutine reach(graph, start, by_degree, level, queue, n)
      type(node_graph_type), intent(in) :: graph
      integer, intent(in)    :: start
      logical, intent(in)    :: by_degree
      integer, intent(inout) :: level(:), queue(:), n
      integer :: first, i, k, m, other

      i = n
      n = n + 1
      queue(n) = start
      level(start) = 1
      do while (i < n)
         i = i + 1
         first = n + 1
         do k = graph%first(queue(i)), graph%first(queue(i) + 1) - 1
            other = graph%neighbours(k)
            if (level(other) /= 0) cycle
            level(other) = level(queue(i)) + 1
            n = n + 1
            m = n          ! insertion sort: few neighbours
            do while (by_degree .and. m > first)
               if (degree(graph, queue(m - 1)) <= degree(graph, other)) exit
               queue(m) = queue(m - 1)
               m = m - 1
            end do
            queue(m) = other
         end do
      end do
   end subroutine reach

   pure integer function degree(graph, node)
      type(node_graph_type), intent(in) :: graph
      integer, intent(in)          :: node

      degree = graph%first(node + 1) - graph%first(node)
   end function degree

end module node_graph
