!> The order of elimination: nested dissection of the node graph. METIS dissects; large graphs of plane meshes it sees coarsely
!! first, nodes by fours: the separators of the coarse graph, thinned, are as good as those of the fine one, and the whole takes
!! half the time. In space they are worse, by a tenth of the operations, and the order is a small part of the whole.
module nested_dissection
   use graph_coarsening, only: coarsen, weigh_links
   use metis, only: order_by_metis, separate_by_metis
   use node_graph, only: node_graph_type, part_of_graph
   use reverse_lists, only: list_owners
   use separator_tree, only: thin_separators
   implicit none
   private

   public :: dissect, dissect_coarsely

   integer, parameter :: large = 20000      ! nodes from which on a graph is coarsened
   integer, parameter :: flat = 10          ! neighbours of a node, on the average, up to which a mesh is taken for a plane one
   integer, parameter :: part_nodes = 700   ! that are not dissected coarsely

contains

   !> ORDER(k) is the k-th node to be eliminated, of those with TAKEN(node): the others are left out of the graph.
   !! OK is false where METIS has not the memory.
   subroutine dissect(graph, taken, order, ok)
      type(node_graph_type), intent(in)  :: graph
      logical, intent(in)                :: taken(:)
      integer, allocatable, intent(out)  :: order(:)
      logical, intent(out)               :: ok
      type(node_graph_type) :: part
      integer, allocatable  :: nodes(:), number(:)
      integer :: i

      nodes = pack([(i, i = 1, graph%n)], taken)
      allocate (number(graph%n), source=0)
      call part_of_graph(graph, nodes, number, part)
      if (part%n >= large .and. size(part%neighbours) <= flat*part%n) then
         call dissect_coarsely(part, part_nodes, order, ok)
      else
         call order_by_metis(part, order, ok)
      end if
      if (ok) order = nodes(order)
   end subroutine dissect


   !> ORDER as above. A coarse graph is cut into parts of no more than MOST_NODES of GRAPH, on the average; METIS orders them one
   !! by one. The separators follow their parts.
   subroutine dissect_coarsely(graph, most_nodes, order, ok)
      type(node_graph_type), intent(in) :: graph
      integer, intent(in)               :: most_nodes
      integer, allocatable, intent(out) :: order(:)
      logical, intent(out)              :: ok
      type(node_graph_type) :: pairs, fours
      integer, allocatable  :: weight(:), pair_weight(:), four_weight(:), pair(:), four(:)
      integer, allocatable  :: place(:), first(:), nodes(:), number(:)
      integer :: n, n_parts

      n_parts = 1
      do while (n_parts*most_nodes < graph%n)
         n_parts = 2*n_parts
      end do
      call weigh_links(graph, weight)
      call coarsen(graph, weight, pairs, pair_weight, pair)
      call coarsen(pairs, pair_weight, fours, four_weight, four)
      call separate_by_metis(fours, n_parts, place, ok)
      if (.not. ok) return
      if (maxval(place) == 1) n_parts = 1   ! nothing was separated
      place = place(four(pair))
      call thin_separators(graph, n_parts, place)
      call list_owners(2*n_parts - 1, reshape(place, [1, graph%n]), first, nodes)
      allocate (order(graph%n), number(graph%n))
      number = 0
      n = 0
      call order_subtree(1)

   contains

      !> The nodes of the subtree of place TOP.
      recursive subroutine order_subtree(top)
         integer, intent(in)   :: top
         type(node_graph_type) :: part
         integer, allocatable  :: sequence(:)

         if (top < n_parts) then
            call order_subtree(2*top)
            call order_subtree(2*top + 1)
         end if
         associate (here => nodes(first(top):first(top + 1) - 1))
            if (top < n_parts) then
               order(n + 1:n + size(here)) = here
            else if (ok) then
               call part_of_graph(graph, here, number, part)
               call order_by_metis(part, sequence, ok)
               if (ok) order(n + 1:n + size(here)) = here(sequence)
            end if
            n = n + size(here)
         end associate
      end subroutine order_subtree

   end subroutine dissect_coarsely

end module nested_dissection
