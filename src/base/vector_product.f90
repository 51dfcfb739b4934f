!> The vector product.
module vector_product
   use kinds, only: wp
   implicit none
   private

   public :: cross

contains

   !> a x b.
   pure function cross(a, b) result(product_of_them)
      real(wp), intent(in) :: a(3), b(3)
      real(wp) :: product_of_them(3)

      product_of_them = [a(2)*b(3) - a(3)*b(2), a(3)*b(1) - a(1)*b(3), a(1)*b(2) - a(2)*b(1)]
   end function cross

end module vector_product
