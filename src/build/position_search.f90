!> Points found by position: a tree whose every node halves its points along their longest extent, so that finding one of n
!! costs log n steps however they lie.
!! Source: Bentley, Multidimensional binary search trees used for associative searching, Comm. ACM 18 (1975) 509-517.
module position_search
   use kinds, only: wp
   implicit none
   private

   type, public :: position_search_type
      private
      real(wp), allocatable :: points(:, :) ! (3, n) in the order of the tree: of a stretch of it the middle one divides it
      integer, allocatable  :: number(:)    ! (n) which of the points given each is
      integer, allocatable  :: axis(:)      ! (n) along which it divides its stretch
   contains
      procedure :: build
      procedure :: nearest
      procedure :: order
   end type position_search_type

   integer, parameter, public :: first_undivided = 8 !! stretches no longer than this are not divided

contains

   !> Take the POINTS(3, n).
   pure subroutine build(self, points)
      class(position_search_type), intent(inout) :: self
      real(wp), intent(in) :: points(:, :)
      integer :: i, n

      n = size(points, 2)
      self%points = points
      if (allocated(self%number)) deallocate (self%number, self%axis)
      allocate (self%number(n), self%axis(n))
      do i = 1, n
         self%number(i) = i
      end do
      self%axis = 1
      call divide(self, 1, n)
   end subroutine build

   !> The points in the order of the tree: the middle one of every stretch of it, FIRST + (LAST - FIRST)/2, divides it.
   pure function order(self) result(points)
      class(position_search_type), intent(in) :: self
      integer, allocatable :: points(:)

      points = self%number
   end function order

   !> Put the points FIRST to LAST in the order of the tree.
   pure recursive subroutine divide(self, first, last)
      type(position_search_type), intent(inout) :: self
      integer, intent(in) :: first, last
      integer :: axis, middle

      if (last - first < first_undivided) return
      middle = first + (last - first)/2
      axis = maxloc(maxval(self%points(:, first:last), dim=2) - minval(self%points(:, first:last), dim=2), dim=1)
      call select_middle(self, first, last, middle, axis)
      self%axis(middle) = axis
      call divide(self, first, middle - 1)
      call divide(self, middle + 1, last)
   end subroutine divide

   !> Exchange points among FIRST to LAST until none before MIDDLE lies beyond it along AXIS, and none behind it lies before it.
   !! Source: Hoare's FIND; Wirth, Algorithms + Data Structures = Programs, section 2.3.4.
   pure subroutine select_middle(self, first, last, middle, axis)
      type(position_search_type), intent(inout) :: self
      integer, intent(in) :: first, last, middle, axis
      real(wp) :: pivot, point(3)
      integer  :: i, j, low, high, number

      low = first
      high = last
      do while (low < high)
         pivot = self%points(axis, middle)
         i = low
         j = high
         do
            do while (self%points(axis, i) < pivot)
               i = i + 1
            end do
            do while (self%points(axis, j) > pivot)
               j = j - 1
            end do
            if (i <= j) then
               point = self%points(:, i)
               self%points(:, i) = self%points(:, j)
               self%points(:, j) = point
               number = self%number(i)
               self%number(i) = self%number(j)
               self%number(j) = number
               i = i + 1
               j = j - 1
            end if
            if (i > j) exit
         end do
         if (j < middle) low = i
         if (i > middle) high = j
      end do
   end subroutine select_middle

   !> The point nearest to X within REACH; 0 where there is none. Of points at the same distance the first.
   pure subroutine nearest(self, x, reach, point, distance)
      class(position_search_type), intent(in) :: self
      real(wp), intent(in)  :: x(3), reach
      integer, intent(out)  :: point
      real(wp), intent(out) :: distance !! huge where there is none

      point = 0
      distance = huge(1.0_wp)
      call look_into(self, 1, size(self%number), x, reach, point, distance)
   end subroutine nearest

   !> Look for a point nearer than DISTANCE, or as near and before POINT, among the points FIRST to LAST of the tree.
   pure recursive subroutine look_into(self, first, last, x, reach, point, distance)
      type(position_search_type), intent(in) :: self
      integer, intent(in)     :: first, last
      real(wp), intent(in)    :: x(3), reach
      integer, intent(inout)  :: point
      real(wp), intent(inout) :: distance
      real(wp) :: beyond
      integer  :: i, middle

      if (last - first < first_undivided) then
         do i = first, last
            call compare(self, i, x, reach, point, distance)
         end do
         return
      end if
      middle = first + (last - first)/2
      beyond = x(self%axis(middle)) - self%points(self%axis(middle), middle)
      if (beyond <= 0.0_wp) call look_into(self, first, middle - 1, x, reach, point, distance)
      if (beyond > 0.0_wp) call look_into(self, middle + 1, last, x, reach, point, distance)
      if (abs(beyond) > min(distance, reach)) return
      call compare(self, middle, x, reach, point, distance)
      if (beyond > 0.0_wp) call look_into(self, first, middle - 1, x, reach, point, distance)
      if (beyond <= 0.0_wp) call look_into(self, middle + 1, last, x, reach, point, distance)

   end subroutine look_into

   !> Whether point K of the tree is nearer than DISTANCE, or as near and before POINT: then it takes their place.
   pure subroutine compare(self, k, x, reach, point, distance)
      type(position_search_type), intent(in) :: self
      integer, intent(in)     :: k
      real(wp), intent(in)    :: x(3), reach
      integer, intent(inout)  :: point
      real(wp), intent(inout) :: distance
      real(wp) :: candidate

      if (maxval(abs(self%points(:, k) - x)) > min(distance, reach)) return
      candidate = norm2(self%points(:, k) - x)
      if (candidate > reach .or. candidate > distance) return
      if (candidate >= distance .and. self%number(k) > point) return
      point = self%number(k)
      distance = candidate
   end subroutine compare

end module position_search
