!> Which nodes share an element: the graph that orderings work on.
module node_graph
   use mass_elements, only: mass_nodes, n_masses
   use model_data, only: bar_nodes, model_type, n_bars
   use node_coupling, only: unknown_nodes
   use reverse_lists, only: list_owners
   use section_coupling, only: coupled_nodes, felt_nodes, section_node
   implicit none
   private

   public :: build_node_graph, part_of_graph

   !> Nodes and their neighbours: neighbours(first(i):first(i+1)-1) share an element or interface element with node i.
   type, public :: node_graph_type
      integer :: n = 0
      integer, allocatable :: first(:)      !! (n + 1)
      integer, allocatable :: neighbours(:)
      logical :: with_masses = .false.      !! masses at nodes couple what these move with: a shift may come
   end type node_graph_type

contains

   !> The graph of all nodes of MODEL; time and memory linear in its size. WITH_MASSES, those at nodes couple what these move with.
   subroutine build_node_graph(model, graph, with_masses)
      type(model_type), intent(in)  :: model
      type(node_graph_type), intent(out) :: graph
      logical, intent(in), optional :: with_masses !! false
      integer, allocatable :: mark(:), joined(:, :), first_list(:), lists_at(:)
      integer :: e, i, k, node, other, pass, n

      graph%n = model%n_nodes
      if (present(with_masses)) graph%with_masses = with_masses
      call list_joined(model, graph%with_masses, joined)
      call list_owners(graph%n, joined, first_list, lists_at)
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

      subroutine visit(candidate)
         integer, intent(in) :: candidate

         other = candidate
         if (other == 0) return ! behind the last of a list, or no section
         if (mark(other) == node) return
         mark(other) = node
         n = n + 1
         if (pass == 2) graph%neighbours(n) = other
      end subroutine visit

   end subroutine build_node_graph

   !> JOINED(:, n): the nodes whose unknowns interface elements and bars couple, and body elements with nodes that move with the
   !! unknowns of others; 0 behind the last.
   subroutine list_joined(model, with_masses, joined)
      type(model_type), intent(in)      :: model
      logical, intent(in)               :: with_masses
      integer, allocatable, intent(out) :: joined(:, :)
      integer, allocatable :: wider(:, :)
      integer :: e, i, n

      allocate (joined(2, size(model%interface) + n_bars(model)), source=0)
      n = 0
      do i = 1, size(model%interface)
         call join(unknown_nodes(model, model%interface(i)%node))
      end do
      do i = 1, n_bars(model)
         call join(unknown_nodes(model, bar_nodes(model%bars(i))))
      end do
      do i = 1, merge(n_masses(model), 0, with_masses)
         call join(unknown_nodes(model, mass_nodes(model, model%masses(i))))
      end do
      if (.not. allocated(model%coupling%of_node)) return
      do e = 1, model%n_elements
         if (moves_with_others(e)) call join(coupled_nodes(model, e))
      end do
      joined = joined(:, :n)

   contains

      !> Whether element E couples the unknowns of nodes that it does not touch.
      logical function moves_with_others(this)
         integer, intent(in) :: this
         integer :: k

         associate (felt => felt_nodes(model, this), unknown => coupled_nodes(model, this))
            moves_with_others = any([(all(felt /= unknown(k)), k = 1, size(unknown))])
         end associate
      end function moves_with_others

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

   !> The PART of GRAPH with NODES alone, numbered in their sequence.
   pure subroutine part_of_graph(graph, nodes, number, part)
      type(node_graph_type), intent(in)  :: graph
      integer, intent(in)                :: nodes(:)
      integer, intent(inout)             :: number(:) !! (graph%n) room to work in: zero, and zero again on return
      type(node_graph_type), intent(out) :: part
      integer :: i, k, m

      part%n = size(nodes)
      number(nodes) = [(i, i = 1, part%n)]
      m = 0
      do i = 1, part%n
         m = m + count(number(graph%neighbours(graph%first(nodes(i)):graph%first(nodes(i) + 1) - 1)) > 0)
      end do
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

end module node_graph
