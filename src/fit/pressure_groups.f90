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
      real(wp), intent(in)               :: p(:)       !! >= 0 [pressure]
      real(wp), intent(in)               :: tolerance  !! >= 0 [-]
      integer, allocatable, intent(out)  :: group(:)   !! (points) the group of each point
      real(wp), allocatable, intent(out) :: group_p(:) !! (groups) [pressure]
      real(wp), allocatable :: points(:)
      integer  :: order(size(p)), i, n
      real(wp) :: lowest

      order = ascending(p)
      allocate (group(size(p)), source=0)
      n = 0
      lowest = 0.0_wp
      do i = 1, size(p)
         if (n == 0 .or. p(order(i)) > lowest*(1.0_wp + tolerance)) then
            n = n + 1
            lowest = p(order(i))
         end if
         group(order(i)) = n
      end do
      allocate (group_p(n), points(n), source=0.0_wp)
      do i = 1, size(p)
         group_p(group(i)) = group_p(group(i)) + p(i)
         points(group(i)) = points(group(i)) + 1.0_wp
      end do
      group_p = group_p/points
   end subroutine group_by_pressure


   !> The permutation that puts X in ascending order (Shell's method).
   pure function ascending(x) result(order)
      real(wp), intent(in) :: x(:)
      integer :: order(size(x)), gap, i, j, moved

      order = [(i, i = 1, size(x))]
      gap = size(x)/2
      do while (gap > 0)
         do i = gap + 1, size(x)
            moved = order(i)
            j = i
            do while (j > gap)
               if (x(order(j - gap)) <= x(moved)) exit
               order(j) = order(j - gap)
               j = j - gap
            end do
            order(j) = moved
         end do
         gap = gap/2
      end do
   end function ascending

end module pressure_groups
