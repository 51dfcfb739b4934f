!> Separators that cut a graph in two, the halves again, and so on: a binary tree, its places numbered as in a heap, the children
!! of h are 2h and 2h + 1. Inner places hold the separators, the leaves what is left between them. Neighbours stand in places of
!! which one is above the other.
module separator_tree
   use node_graph, only: node_graph_type
   implicit none
   private

   public :: thin_separators

contains

   !> Separators of a coarse graph are thick in the fine one: PLACE(node). Every node that does not have neighbours on both sides
   !! of its separator goes down to the side where it has some, and on, until it separates or is in a leaf.
   pure subroutine thin_separators(graph, n_leaves, place)
      type(node_graph_type), intent(in) :: graph
      integer, intent(in)               :: n_leaves  !! a power of 2; they are places n_leaves to 2 n_leaves - 1
      integer, intent(inout)            :: place(:)  !! (graph%n)
      logical :: on_one_side, on_the_other
      integer :: i

      do i = 1, graph%n
         do while (place(i) < n_leaves)
            on_one_side = is_below(2*place(i))
            on_the_other = is_below(2*place(i) + 1)
            if (on_one_side .eqv. on_the_other) exit
            place(i) = 2*place(i) + merge(0, 1, on_one_side)
         end do
      end do

   contains

      !> Whether a neighbour of node I stands in the subtree of place TOP.
      pure logical function is_below(top)
         integer, intent(in) :: top
         integer :: k, shift

         is_below = .false.
         do k = graph%first(i), graph%first(i + 1) - 1
            shift = leadz(top) - leadz(place(graph%neighbours(k)))
            if (shift < 0) cycle
            is_below = shiftr(place(graph%neighbours(k)), shift) == top
            if (is_below) return
         end do
      end function is_below

   end subroutine thin_separators

end module separator_tree
