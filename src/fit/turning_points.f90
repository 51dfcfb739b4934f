!> A record in the order of time: how much of it is noise, and where it turns back.
module turning_points
   use kinds, only: wp
   implicit none
   private

   public :: scatter_of, find_turns

contains

   !> How far a reading of a record, in which X and Y rise and fall together, may lie off by chance, as a share of the range of
   !! each: the largest of N, sqrt(2 ln N) standard deviations; two of them may lie twice as far apart. The noise shows in the
   !! distance of a reading from the chord between its neighbours, which is small on a smooth curve however unevenly it was read.
   !! The median passes over the turns; for normal noise it is 0.6745 sqrt(3/2) standard deviations.
   pure real(wp) function scatter_of(x, y) result(scatter)
      real(wp), intent(in) :: x(:), y(:) !! (readings)
      real(wp) :: distance(max(0, size(x) - 2)), a(2), chord(2), range(2)
      integer  :: i, n

      n = size(x)
      scatter = 0.0_wp
      range = [maxval(x) - minval(x), maxval(y) - minval(y)]
      if (n < 5 .or. any(range <= 0.0_wp)) return
      distance = 0.0_wp
      do i = 2, n - 1
         chord = [x(i + 1) - x(i - 1), y(i + 1) - y(i - 1)]/range
         a = [x(i) - x(i - 1), y(i) - y(i - 1)]/range
         if (norm2(chord) > 0.0_wp) distance(i - 1) = abs(chord(1)*a(2) - chord(2)*a(1))/norm2(chord)
      end do
      scatter = sqrt(2.0_wp*log(real(n, wp)))*median(distance)/(0.6745_wp*sqrt(1.5_wp))
   end function scatter_of

   !> The readings at which U turns back by more than BAND: the last before it does.
   pure subroutine find_turns(u, band, turns)
      real(wp), intent(in)              :: u(:)
      real(wp), intent(in)              :: band     !! [u]
      integer, allocatable, intent(out) :: turns(:) !! ascending; neither the first nor the last reading
      integer :: high, i, low, way                  ! WAY: 1 rising, -1 falling, 0 not known yet

      allocate (turns(0))
      high = 1
      low = 1
      way = 0
      do i = 2, size(u)
         if (u(i) >= u(high)) high = i
         if (u(i) <= u(low)) low = i
         if (way >= 0 .and. u(high) - u(i) > band) then
            if (way > 0 .or. u(high) - u(1) > band) turns = [turns, high]
            way = -1
            low = i
         else if (way <= 0 .and. u(i) - u(low) > band) then
            if (way < 0 .or. u(1) - u(low) > band) turns = [turns, low]
            way = 1
            high = i
         end if
      end do
   end subroutine find_turns

   !> The middle one of X in ascending order, the upper of two: by halving the range, the number below and above counted.
   pure real(wp) function median(x)
      real(wp), intent(in) :: x(:)
      real(wp) :: high, low
      integer  :: k

      low = minval(x)
      high = maxval(x)
      do k = 1, 60
         median = 0.5_wp*(low + high)
         if (2*count(x <= median) < size(x)) then
            low = median
         else
            high = median
         end if
      end do
      median = high
   end function median

end module turning_points
