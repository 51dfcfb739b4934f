!> Which numbers can be the measure of anything: finite ones far enough below the largest real that squares and products of them, with
!! stiffnesses and areas, are still numbers.
module measures
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   implicit none
   private

   public :: is_measure

   real(wp), parameter, public :: largest_measure = 1.0e100_wp

contains

   !> Whether VALUE is one. What is no number at all is never compared: that would be an exception.
   elemental logical function is_measure(value)
      real(wp), intent(in) :: value

      is_measure = ieee_is_finite(value)
      if (is_measure) is_measure = abs(value) <= largest_measure
   end function is_measure

end module measures
