!> Elements for tests of shapes, stiffnesses and loads.
module sample_elements
   use element_kinds, only: element_table, max_nodes
   use kinds, only: wp
   use shape_functions, only: corner_point
   implicit none
   private

   public :: distorted

contains

   !> A distorted element of a kind, x > 0.
   pure function distorted(kind) result(x)
      integer, intent(in) :: kind
      real(wp) :: x(3, max_nodes)
      integer  :: i, k

      x = 0.0_wp
      do i = 1, max_nodes
         do k = 1, element_table(kind)%dimension
            x(k, i) = corner_point(k, i, kind) + 0.2_wp*corner_point(modulo(k, 2) + 1, i, kind) + 2.0_wp + &
                      0.12_wp*sin(2.3_wp*i + 1.7_wp*k*i)
         end do
      end do
   end function distorted

end module sample_elements
