!> What a factor takes at the least, told from the graph of the nodes before these are ordered.
module least_factor
   use kinds, only: wp
   use node_graph, only: node_graph_type
   implicit none
   private

   public :: least_factor_bytes

contains

   !> The lower triangle of the stiffness matrix, in double precision [bytes]. A factor has an entry wherever the matrix has one,
   !! in any order. How much it fills in is a matter of shape (a chain of elements fills nothing, a cube of n nodes n**(4/3)), and
   !! what separates a shape is known only when it has been ordered; this bound refuses nothing that would fit. In space it also
   !! is more than the ordering takes.
   pure real(wp) function least_factor_bytes(graph, weight) result(bytes)
      type(node_graph_type), intent(in) :: graph
      integer, intent(in)               :: weight(:) !! (n_nodes) unknowns of each node
      real(wp) :: entries
      integer  :: i

      entries = 0.0_wp
      do i = 1, graph%n ! every pair of neighbours is met twice
         entries = entries + 0.5_wp*weight(i)*(weight(i) + 1.0_wp) &
                   + 0.5_wp*weight(i)*sum(real(weight(graph%neighbours(graph%first(i):graph%first(i + 1) - 1)), wp))
      end do
      bytes = 8.0_wp*entries
   end function least_factor_bytes

end module least_factor
