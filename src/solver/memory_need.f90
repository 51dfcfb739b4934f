!> Comparison of the memory that a run needs with that of the machine. The need of a model follows from its cards before a node
!! is made: the part that does not depend on the order of elimination. The need of a factor follows from its layout.
module memory_need
   use bulk_data, only: block_card
   use deck_input, only: deck_type
   use equation_solver, only: failure_type
   use kinds, only: long, wp
   use machine, only: address_space_left, for_threads, memory_for
   use omp_lib, only: omp_get_max_threads
   use text_tools, only: integer_text, one_of, plural
   implicit none
   private

   public :: check_buffers, check_model_size, check_memory, nodes_of_block, shortage

   real(wp), parameter :: node_bytes = 500.0_wp !! per node, with its elements, the graph and nodal arrays; a factor takes far more

contains

   !> Fail where a limit on the address space leaves less than the buffers that the threads take at their first call of OpenBLAS.
   subroutine check_buffers(failure)
      type(failure_type), intent(inout) :: failure
      integer(long) :: left, needed

      left = address_space_left()
      needed = for_threads()
      if (needed > left) then
         call failure%raise('OpenBLAS needs at least '//integer_text(int(needed/1048576))//' MiB of address space for '// &
                            plural(omp_get_max_threads(), 'thread')//', and '//integer_text(int(left/1048576))// &
                            ' MiB are left: raise the limit (ulimit -v)'// &
                            one_of(omp_get_max_threads() > 1, ', or take --threads 1', ''))
      end if
   end subroutine check_buffers

   !> Fail where the nodes of the deck's blocks and GRID cards exceed the memory.
   subroutine check_model_size(deck, failure)
      type(deck_type), intent(in)       :: deck
      type(failure_type), intent(inout) :: failure
      character(:), allocatable :: words
      real(wp) :: nodes, share

      if (failure%raised) return
      nodes = size(deck%bulk%grid) + sum(nodes_of_block(deck%bulk%block))
      call shortage('the nodes of the model need at least', node_bytes*nodes, words, share)
      if (words /= '') call failure%raise(words)
   end subroutine check_model_size

   !> Nodes of the block of CARD; second order adds those at the middle of the edges.
   elemental real(wp) function nodes_of_block(card) result(nodes)
      type(block_card), intent(in) :: card
      real(wp) :: along(3) ! nodes along x, y, z

      along = card%divisions + 1.0_wp
      nodes = product(along)
      associate (d => card%dimension)
         if (card%order /= 1) nodes = nodes + sum(product(along)/along(:d)*card%divisions(:d))
      end associate
   end function nodes_of_block

   !> Fail where the factor of N equations, BYTES, exceeds the available memory; the message gives the size that fits.
   subroutine check_memory(n, dimension, bytes, failure)
      integer, intent(in)               :: n          !! unknowns
      integer, intent(in)               :: dimension  !! of the model
      real(wp), intent(in)              :: bytes
      type(failure_type), intent(inout) :: failure
      real(wp), parameter :: inverse_growth(2:3) = [0.9_wp, 0.75_wp] ! bytes grow like n log n, n**(4/3)
      character(:), allocatable :: words
      real(wp) :: share

      call shortage('the factor of '//integer_text(n)//' equations needs about', bytes, words, share)
      if (words /= '') call failure%raise(words//'; about '// &
                                          integer_text(int(n*share**inverse_growth(dimension)))//' equations of this shape '// &
                                             'would fit')
   end subroutine check_memory

   !> WORDS that compare the BYTES of NEEDS with the memory, and the SHARE that is available; '' where the memory suffices.
   subroutine shortage(needs, bytes, words, share)
      character(*), intent(in)               :: needs
      real(wp), intent(in)                   :: bytes
      character(:), allocatable, intent(out) :: words
      real(wp), intent(out)                  :: share !! [-]
      real(wp) :: there
      integer  :: mebibytes(2)

      there = real(memory_for(bytes), wp)
      words = ''
      share = 1.0_wp
      if (bytes <= there) return
      share = there/bytes
      mebibytes = int(min([bytes, there]/1048576.0_wp, real(huge(1), wp)))
      words = needs//' '//integer_text(mebibytes(1))//' MiB, and '//integer_text(mebibytes(2))//' MiB are available'
   end subroutine shortage

end module memory_need
