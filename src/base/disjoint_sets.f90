!> Disjoint sets of 1 to n (union-find): PARENT(i) is another member of the set of i, or i itself, which then stands for the set.
!! At the beginning PARENT = [1, ..., n]: every member alone.
module disjoint_sets
   implicit none
   private

   public :: join, root_of

contains

   !> Union of the sets of A and B (union-find with path halving); a zero is nothing.
   pure subroutine join(parent, a, b)
      integer, intent(inout) :: parent(:)
      integer, intent(in)    :: a, b
      integer :: i, j

      if (a == 0 .or. b == 0) return
      i = a
      do while (parent(i) /= i)
         parent(i) = parent(parent(i))
         i = parent(i)
      end do
      j = b
      do while (parent(j) /= j)
         parent(j) = parent(parent(j))
         j = parent(j)
      end do
      if (i < j) then
         parent(j) = i
      else
         parent(i) = j
      end if
   end subroutine join


   !> The member that stands for the set of MEMBER.
   pure integer function root_of(parent, member) result(root)
      integer, intent(in) :: parent(:), member

      root = member
      do while (parent(root) /= root)
         root = parent(root)
      end do
   end function root_of

end module disjoint_sets
