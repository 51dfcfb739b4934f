!> The sum of some directions that comes nearest to a solution, in the energy of its matrix, by their products alone.
!! Source: Fischer, Comput. Methods Appl. Mech. Engrg. 163 (1998) 193-204.
module least_energy
   use kinds, only: wp
   implicit none
   private

   public :: find_least_energy

   real(wp), parameter :: dependent = 1.0e-12_wp !! energy, as a share, below which nothing new is left of a direction

contains

   !> SHARE c that makes c'ENERGY c/2 - WORK'c least: directions orthogonal in energy are made one after another, the first one
   !! first, and one of which nothing new is left is left out.
   pure subroutine find_least_energy(energy, work, share)
      real(wp), intent(in)  :: energy(:, :) !! (n, n) symmetric, no eigenvalue below zero [force*length]
      real(wp), intent(in)  :: work(:)      !! (n) [force*length]
      real(wp), intent(out) :: share(:)     !! (n) [-]
      real(wp) :: direction(size(work), size(work)), left
      integer  :: i, j, n, pass

      share = 0.0_wp
      n = 0
      do j = 1, size(work)
         n = n + 1
         direction(:, n) = 0.0_wp
         direction(j, n) = 1.0_wp
         do pass = 1, 2                               ! the second one takes away what rounding has left
            do i = 1, n - 1
               direction(:, n) = direction(:, n) - dot_product(direction(:, i), matmul(energy, direction(:, n)))*direction(:, i)
            end do
         end do
         left = dot_product(direction(:, n), matmul(energy, direction(:, n)))
         if (.not. left > dependent*energy(j, j)) then
            n = n - 1
            cycle
         end if
         direction(:, n) = direction(:, n)/sqrt(left)
         share = share + dot_product(direction(:, n), work)*direction(:, n)
      end do
   end subroutine find_least_energy

end module least_energy
