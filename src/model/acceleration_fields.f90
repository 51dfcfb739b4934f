!> Accelerations that act on all masses, with the sense of the force: uniform (gravity), or growing with the distance from an axis
!! (rotation).
module acceleration_fields
   use kinds, only: wp
   implicit none
   private

   public :: acceleration_at

   !> a(x) = UNIFORM + GRADIENT (x - ORIGIN)
   type, public :: acceleration_field
      logical  :: is_uniform = .true.
      real(wp) :: uniform(3) = 0.0_wp        !! [length/time^2]
      real(wp) :: gradient(3, 3) = 0.0_wp    !! [1/time^2]
      real(wp) :: origin(3) = 0.0_wp         !! [length]
   end type acceleration_field

contains

   !> The acceleration of FIELD at X [length/time^2].
   pure function acceleration_at(field, x) result(a)
      type(acceleration_field), intent(in) :: field
      real(wp), intent(in)                 :: x(3)
      real(wp) :: a(3)

      a = field%uniform
      if (.not. field%is_uniform) a = a + matmul(field%gradient, x - field%origin)
   end function acceleration_at

end module acceleration_fields
