!> Which lists hold a number: from the nodes of every element, say, to the elements of every node.
module reverse_lists
   implicit none
   private

   public :: list_owners

contains

   !> OWNERS(FIRST(i):FIRST(i + 1) - 1) are the columns of MEMBERS that hold the number i, in ascending order; a column that
   !! holds it twice stands there twice.
   pure subroutine list_owners(n, members, first, owners)
      integer, intent(in)               :: n              !! numbers: 1 to N
      integer, intent(in)               :: members(:, :)  !! (most of a list, lists); 0: none
      integer, allocatable, intent(out) :: first(:)       !! (N + 1)
      integer, allocatable, intent(out) :: owners(:)      !! (entries of MEMBERS that are not 0)
      integer :: i, k, list

      allocate (first(n + 1), source=0)
      do list = 1, size(members, 2)
         do k = 1, size(members, 1)
            i = members(k, list)
            if (i > 0) first(i) = first(i) + 1
         end do
      end do
      first(n + 1) = 1 + sum(first(:n))
      do i = n, 1, -1
         first(i) = first(i + 1) - first(i)       ! where the owners of i begin
      end do
      allocate (owners(first(n + 1) - 1))
      do list = 1, size(members, 2)
         do k = 1, size(members, 1)
            i = members(k, list)
            if (i == 0) cycle
            owners(first(i)) = list
            first(i) = first(i) + 1               ! where the next owner of i goes: in the end where those of i + 1 begin
         end do
      end do
      do i = n, 2, -1
         first(i) = first(i - 1)
      end do
      if (n > 0) first(1) = 1
   end subroutine list_owners

end module reverse_lists
