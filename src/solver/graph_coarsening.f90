!> A graph with half the nodes: neighbours that hold together most become one.
!! Source: heavy-edge matching, Karypis, Kumar, SIAM J. Sci. Comput. 20 (1998) 359-392, section 3.1.
module graph_coarsening
   use node_graph, only: node_graph_type
   implicit none
   private

   public :: weigh_links, coarsen

contains

   !> WEIGHT of every link to a neighbour: one, and one for every neighbour that both have.
   pure subroutine weigh_links(graph, weight)
      type(node_graph_type), intent(in) :: graph
      integer, allocatable, intent(out) :: weight(:) !! as graph%neighbours
      integer, allocatable :: mark(:)
      integer :: i, j, k, l

      allocate (weight(size(graph%neighbours)), source=1)
      allocate (mark(graph%n), source=0)
      do i = 1, graph%n
         mark(graph%neighbours(graph%first(i):graph%first(i + 1) - 1)) = i
         do k = graph%first(i), graph%first(i + 1) - 1
            j = graph%neighbours(k)
            do l = graph%first(j), graph%first(j + 1) - 1
               if (mark(graph%neighbours(l)) == i) weight(k) = weight(k) + 1
            end do
         end do
      end do
   end subroutine weigh_links


   !> Every node is joined with the neighbour, not joined yet, to which its link weighs most; the COARSE graph has the links
   !! between them, their weights added up.
   pure subroutine coarsen(graph, weight, coarse, coarse_weight, of_node)
      type(node_graph_type), intent(in)  :: graph
      integer, intent(in)                :: weight(:)        !! as graph%neighbours
      type(node_graph_type), intent(out) :: coarse
      integer, allocatable, intent(out)  :: coarse_weight(:) !! as coarse%neighbours
      integer, allocatable, intent(out)  :: of_node(:)       !! (graph%n) what of COARSE a node is in
      integer, allocatable :: members(:, :), at(:)
      integer :: best, c, i, j, k, m, most, n

      allocate (of_node(graph%n), source=0)
      allocate (members(2, graph%n), source=0)
      coarse%n = 0
      do i = 1, graph%n
         if (of_node(i) > 0) cycle
         best = 0
         most = 0
         do k = graph%first(i), graph%first(i + 1) - 1
            if (of_node(graph%neighbours(k)) > 0 .or. weight(k) <= most) cycle
            best = graph%neighbours(k)
            most = weight(k)
         end do
         coarse%n = coarse%n + 1
         members(:, coarse%n) = [i, best]
         of_node(i) = coarse%n
         if (best > 0) of_node(best) = coarse%n
      end do

      allocate (coarse%first(coarse%n + 1), coarse%neighbours(size(graph%neighbours)))
      allocate (coarse_weight(size(graph%neighbours)), source=0)
      allocate (at(coarse%n), source=0)               ! where a neighbour stands in the list
      n = 0
      do c = 1, coarse%n
         coarse%first(c) = n + 1
         do m = 1, 2
            i = members(m, c)
            if (i == 0) cycle
            do k = graph%first(i), graph%first(i + 1) - 1
               j = of_node(graph%neighbours(k))
               if (j == c) cycle
               if (at(j) < coarse%first(c)) then
                  n = n + 1
                  at(j) = n
                  coarse%neighbours(n) = j
               end if
               coarse_weight(at(j)) = coarse_weight(at(j)) + weight(k)
            end do
         end do
      end do
      coarse%first(coarse%n + 1) = n + 1
      coarse%neighbours = coarse%neighbours(:n)
      coarse_weight = coarse_weight(:n)
   end subroutine coarsen

end module graph_coarsening
