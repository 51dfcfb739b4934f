!> The shape of a plane quadrilateral, by the name under which the mesh is checked.
module quad4
   use element_kinds, only: kind_quad4
   use element_mapping, only: smallest_jacobian
   use kinds, only: wp
   implicit none
   private

   public :: quad4_smallest_jacobian

contains

   !> As smallest_jacobian: above zero only for four corners counter-clockwise round a convex quadrilateral [-].
   pure real(wp) function quad4_smallest_jacobian(x) result(smallest)
      real(wp), intent(in) :: x(2, 4)     !! corners [length]

      smallest = smallest_jacobian(kind_quad4, x)
   end function quad4_smallest_jacobian

end module quad4
