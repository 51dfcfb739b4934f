!> The motions of a rigid body at the blocks of a process.
module rigid_modes
   use kinds, only: wp
   use shares, only: share_type
   use unknown_motions, only: motions_at, n_motions
   implicit none
   private

   public :: own_modes

contains

   !> MODES(:, i): motion i, component after component of the own blocks; zero where held.
   pure subroutine own_modes(share, modes)
      type(share_type), intent(in)       :: share
      real(wp), allocatable, intent(out) :: modes(:, :) !! (rows, motions) [-], rotations [length]
      real(wp), allocatable :: one(:, :, :)
      integer :: b, c

      allocate (one(share%dimension, share%n_own, n_motions(share%dimension)))
      do b = 1, share%n_own
         one(:, b, :) = motions_at(share%x(:, b))
      end do
      do b = 1, size(share%odd)
         one(:, share%odd(b), :) = share%odd_motions(:, :, b)
      end do
      do b = 1, share%n_own
         do c = 1, share%dimension
            if (share%held_own(c, b)) one(c, b, :) = 0.0_wp
         end do
      end do
      modes = reshape(one, [share%dimension*share%n_own, size(one, 3)])
   end subroutine own_modes

end module rigid_modes
