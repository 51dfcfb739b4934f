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
      call climb(parent, a, i)
      call climb(parent, b, j)
      parent(max(i, j)) = min(i, j)
   end subroutine join

   !> The ROOT of the set of MEMBER, the way there halved for the next time.
   pure subroutine climb(parent, member, root)
      integer, intent(inout) :: parent(:)
      integer, intent(in)    :: member
      integer, intent(out)   :: root

      root = member
      do while (parent(root) /= root)
         parent(root) = parent(parent(root))
         root = parent(root)
      end do
   end subroutine climb

   !> The member that stands for the set of MEMBER.
   pure integer function root_of(parent, member) result(root)
      integer, intent(in) :: parent(:), member

      root = member
      do while (parent(root) /= root)
         root = parent(root)
      end do
   end function root_of

end module disjoint_sets
