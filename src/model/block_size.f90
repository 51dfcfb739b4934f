!> Whether the blocks of a deck can be solved on this machine at all, told from their divisions before a node is made.
module block_size
   use deck_input, only: deck_type
   use failures, only: failure_type
   use kinds, only: wp
   use memory_need, only: check_memory
   implicit none
   private

   public :: check_block_size

   !> The factor of a nested dissection has d**2 N m entries times these, N nodes, m as in dissected_entries: half of what was
   !! measured, because supports may take much away.
   real(wp), parameter :: plane_share = 3.7_wp, solid_share = 8.0_wp
   real(wp), parameter :: model_bytes = 500.0_wp   ! of a node, its elements and the graph

contains

   !> A failure where the factor is out of reach. Blocks count each for itself, GRID cards not at all: what passes here is looked
   !! at again when the fronts are laid out.
   subroutine check_block_size(deck, failure)
      type(deck_type), intent(in)       :: deck
      type(failure_type), intent(inout) :: failure
      real(wp) :: bytes, entries, nodes, unknowns
      integer  :: b

      entries = 0.0_wp
      nodes = 0.0_wp
      unknowns = 0.0_wp
      associate (blocks => deck%bulk%block)
         do b = 1, size(blocks)
            associate (sides => blocks(b)%divisions + 1.0_wp, d => blocks(b)%dimension)
               entries = entries + merge(plane_share, solid_share, d == 2)*d**2*dissected_entries(sides)
               nodes = nodes + product(sides)
               unknowns = unknowns + d*product(sides)
            end associate
         end do
         bytes = 8.0_wp*entries + model_bytes*nodes
         call check_memory(int(min(unknowns, real(huge(1), wp))), maxval([2, blocks%dimension]), 'at least', bytes, failure)
      end associate
   end subroutine check_block_size


   !> N m for a grid of a >= b >= c nodes: m = c (1 + log2(b/c)), a cube's side, the logarithm of a square's. Of a long bar that
   !! is what each cube of it has, of a plate what each column of nodes has, c to each of its separators.
   !! Source: George, SIAM J. Numer. Anal. 10 (1973) 345-363, for the square; the rest is scaled from it.
   pure real(wp) function dissected_entries(sides)
      real(wp), intent(in) :: sides(3)
      real(wp) :: middle, smallest

      smallest = minval(sides)
      middle = sum(sides) - smallest - maxval(sides)
      dissected_entries = product(sides)*smallest*(1.0_wp + log(middle/smallest)/log(2.0_wp))
   end function dissected_entries

end module block_size
