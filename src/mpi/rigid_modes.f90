!> The motions of a rigid body at the blocks of a process: three in the plane, six in space.
!! Nodes that are no points of the structure, of rotations and of sections, move with their own point as if they were one.
module rigid_modes
   use kinds, only: wp
   use shares, only: share_type
   implicit none
   private

   public :: own_modes

contains

   !> MODES(:, i): motion i, component after component of the own blocks; zero where held.
   pure subroutine own_modes(share, modes)
      type(share_type), intent(in)       :: share
      real(wp), allocatable, intent(out) :: modes(:, :) !! (rows, motions) [-], rotations [length]
      real(wp), allocatable :: one(:, :, :)
      integer :: b, c, d

      d = share%dimension
      allocate (one(d, share%n_own, merge(6, 3, d == 3)), source=0.0_wp)
      do b = 1, share%n_own
         do c = 1, d
            one(c, b, c) = 1.0_wp
         end do
         associate (x => share%x(:, b))
            if (d == 2) then
               one(:, b, 3) = [-x(2), x(1)]
            else
               one(:, b, 4) = [0.0_wp, -x(3), x(2)]
               one(:, b, 5) = [x(3), 0.0_wp, -x(1)]
               one(:, b, 6) = [-x(2), x(1), 0.0_wp]
            end if
         end associate
         do c = 1, d
            if (share%held_own(c, b)) one(c, b, :) = 0.0_wp
         end do
      end do
      modes = reshape(one, [d*share%n_own, size(one, 3)])
   end subroutine own_modes

end module rigid_modes
