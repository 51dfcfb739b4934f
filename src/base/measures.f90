!> Which numbers can be the measure of anything: finite ones far enough below the largest real that squares and products of them, with
!! stiffnesses and areas, are still numbers. And which of several numbers is the largest.
module measures
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   implicit none
   private

   public :: is_measure, first_largest

   real(wp), parameter, public :: largest_measure = 1.0e100_wp
   real(wp), parameter, public :: tie = 1.0e-6_wp !! how far values may differ that a symmetric structure would have alike

contains

   !> Whether VALUE is one. What is no number at all is never compared: that would be an exception.
   elemental logical function is_measure(value)
      real(wp), intent(in) :: value

      is_measure = ieee_is_finite(value)
      if (is_measure) is_measure = abs(value) <= largest_measure
   end function is_measure

   !> Where the largest of the VALUES that count is, the first of those that are as large but for what rounding may have made; 0
   !! where none counts. Every node and element that is named for its largest value is found by this rule.
   pure integer function first_largest(values, counts) result(at)
      real(wp), intent(in)          :: values(:)
      logical, intent(in), optional :: counts(:) !! default: all count
      logical  :: counted(size(values))
      real(wp) :: most

      counted = .true.
      if (present(counts)) counted = counts
      at = 0
      if (any(counted .and. .not. is_measure(values))) then
         at = findloc(counted .and. .not. is_measure(values), .true., dim=1)
      else if (any(counted)) then
         most = maxval(values, mask=counted)
         at = findloc(counted .and. values >= most - tie*abs(most), .true., dim=1)
      end if
   end function first_largest

end module measures
