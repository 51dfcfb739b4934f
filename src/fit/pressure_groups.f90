!> Test points that were taken at one pressure.
module pressure_groups
   use kinds, only: wp
   implicit none
   private

   public :: group_by_pressure

contains

   !> Put points into groups of equal pressure. In ascending order of p a group reaches from its lowest p to
   !! (1 + TOLERANCE) times that; its pressure is the mean of its points. Groups are numbered in ascending order of p.
   pure subroutine group_by_pressure(p, tolerance, group, group_p)
      real(wp), intent(in)               :: p(:)       !! [pressure]; one below 0, an error elsewhere, stands for itself
      real(wp), intent(in)               :: tolerance  !! >= 0 [-]
      integer, allocatable, intent(out)  :: group(:)   !! (points) the group of each point
      real(wp), allocatable, intent(out) :: group_p(:) !! (groups) [pressure]
      real(wp) :: lowest
      integer  :: n

      allocate (group(size(p)), source=0)
      allocate (group_p(0))
      do while (any(group == 0))
         n = size(group_p) + 1
         lowest = minval(p, group == 0)
         where (group == 0 .and. p <= max(lowest, lowest*(1.0_wp + tolerance))) group = n
         group_p = [group_p, sum(p, group == n)/count(group == n)]
      end do
   end subroutine group_by_pressure

end module pressure_groups
