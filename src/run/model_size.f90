!> Whether a model can be held at all, told from its cards before a node is made: what no order of elimination changes.
module model_size
   use deck_input, only: deck_type
   use failures, only: failure_type
   use kinds, only: wp
   use memory_need, only: shortage
   implicit none
   private

   public :: check_model_size

   real(wp), parameter :: node_bytes = 500.0_wp !! of a node, its elements, the graph, arrays over nodes; a factor takes far more

contains

   !> A failure where the memory does not hold the nodes of the deck's blocks and GRID cards.
   subroutine check_model_size(deck, failure)
      type(deck_type), intent(in)       :: deck
      type(failure_type), intent(inout) :: failure
      character(:), allocatable :: words
      real(wp) :: nodes, share
      integer  :: b

      associate (bulk => deck%bulk)
         nodes = bulk%n_grid
         do b = 1, bulk%n_block2
            nodes = nodes + product(bulk%block2(b)%divisions + 1.0_wp)
         end do
         do b = 1, bulk%n_block3
            nodes = nodes + product(bulk%block3(b)%divisions + 1.0_wp)
         end do
      end associate
      call shortage('the nodes of the model need at least', node_bytes*nodes, words, share)
      if (words /= '') call failure%raise(words)
   end subroutine check_model_size

end module model_size
