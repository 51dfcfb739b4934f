!> Which nodes share an element: the graph that orderings work on.
module node_graph
   use model_data, only: model_type, n_bars
   use section_coupling, only: section_node
   implicit none
   private

   public :: build_node_graph

   !> Nodes and their neighbours: neighbours(first(i):first(i+1)-1) share an element or interface element with node i.
   type, public :: node_graph_type
      integer :: n = 0
      integer, allocatable :: first(:)      !! (n + 1)
      integer, allocatable :: neighbours(:)
   end type node_graph_type

contains

   !> The graph of all nodes of MODEL; time and memory linear in its size.
   subroutine build_node_graph(model, graph)
      type(model_type), intent(in)  :: model
      type(node_graph_type), intent(out) :: graph
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

end module node_graph
