!> Points found by position: a tree whose every node halves its points along their longest extent, so that finding one of n
!! costs log n steps however they lie.
!! Source: Bentley, Multidimensional binary search trees used for associative searching, Comm. ACM 18 (1975) 509-517.
!!
!! Boxes found by a box: a tree of bounding volumes, so that the few of n that one meets are found in log n steps. A stretch of the
!! tree is halved as the one above halves the centres of its boxes; the box about all of a stretch stands with its middle.
!! Source: Clark, Hierarchical geometric models for visible surface algorithms, Comm. ACM 19 (1976) 547-554.
module spatial_search
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

   type, public :: box_search_type
      private
      real(wp), allocatable :: box(:, :, :)   ! (3, 2, n) least and greatest coordinates, in the order of the tree
      real(wp), allocatable :: around(:, :, :) ! (3, 2, n) those of all boxes of the stretch with this middle
      integer, allocatable  :: number(:)      ! (n) which of the boxes given each is
   contains
      procedure :: build => build_boxes
      procedure :: list_meeting
   end type box_search_type

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

   !> Take the BOXES(3, 2, n), least and greatest coordinates.
   pure subroutine build_boxes(self, boxes)
      class(box_search_type), intent(inout) :: self
      real(wp), intent(in) :: boxes(:, :, :)
      type(position_search_type) :: centres
      real(wp) :: whole(3, 2)

      call centres%build(0.5_wp*(boxes(:, 1, :) + boxes(:, 2, :)))
      self%number = centres%order()
      self%box = boxes(:, :, self%number)
      self%around = self%box
      call surround(self, 1, size(self%number), whole)
   end subroutine build_boxes

   !> The box AROUND the boxes FIRST to LAST of the tree, kept for every stretch that is divided.
   pure recursive subroutine surround(self, first, last, around)
      type(box_search_type), intent(inout) :: self
      integer, intent(in)   :: first, last
      real(wp), intent(out) :: around(3, 2)
      real(wp) :: half(3, 2)
      integer  :: middle

      if (last - first < first_undivided) then
         around(:, 1) = minval(self%box(:, 1, first:last), dim=2)
         around(:, 2) = maxval(self%box(:, 2, first:last), dim=2)
         return
      end if
      middle = first + (last - first)/2
      around = self%box(:, :, middle)
      call surround(self, first, middle - 1, half)
      around(:, 1) = min(around(:, 1), half(:, 1))
      around(:, 2) = max(around(:, 2), half(:, 2))
      call surround(self, middle + 1, last, half)
      around(:, 1) = min(around(:, 1), half(:, 1))
      around(:, 2) = max(around(:, 2), half(:, 2))
      self%around(:, :, middle) = around
   end subroutine surround

   !> The boxes that meet the box from LOW to HIGH, borders count: FOUND(:N).
   pure subroutine list_meeting(self, low, high, found, n)
      class(box_search_type), intent(in)  :: self
      real(wp), intent(in)                :: low(3), high(3)
      integer, allocatable, intent(inout) :: found(:) !! made longer where it is too short
      integer, intent(out)                :: n

      n = 0
      call look_into_box(self, 1, size(self%number), low, high, found, n)
   end subroutine list_meeting

   !> Add to FOUND(:N) those of the boxes FIRST to LAST of the tree that meet the box from LOW to HIGH.
   pure recursive subroutine look_into_box(self, first, last, low, high, found, n)
      type(box_search_type), intent(in)   :: self
      integer, intent(in)                 :: first, last
      real(wp), intent(in)                :: low(3), high(3)
      integer, allocatable, intent(inout) :: found(:)
      integer, intent(inout)              :: n
      integer :: i, middle

      if (last - first < first_undivided) then
         do i = first, last
            call compare_boxes(self, i, low, high, found, n)
         end do
         return
      end if
      middle = first + (last - first)/2
      if (.not. meet(self%around(:, :, middle), low, high)) return
      call look_into_box(self, first, middle - 1, low, high, found, n)
      call compare_boxes(self, middle, low, high, found, n)
      call look_into_box(self, middle + 1, last, low, high, found, n)
   end subroutine look_into_box

   !> Add box I of the tree to FOUND(:N) where it meets the box from LOW to HIGH.
   pure subroutine compare_boxes(self, i, low, high, found, n)
      type(box_search_type), intent(in)   :: self
      integer, intent(in)                 :: i
      real(wp), intent(in)                :: low(3), high(3)
      integer, allocatable, intent(inout) :: found(:)
      integer, intent(inout)              :: n
      integer, allocatable :: longer(:)

      if (.not. meet(self%box(:, :, i), low, high)) return
      if (n == size(found)) then
         allocate (longer(2*n + 8))
         longer(:n) = found
         call move_alloc(longer, found)
      end if
      n = n + 1
      found(n) = self%number(i)
   end subroutine compare_boxes

   !> Whether BOX and that from LOW to HIGH have a point in common.
   pure logical function meet(box, low, high)
      real(wp), intent(in) :: box(3, 2), low(3), high(3)

      meet = all(box(:, 1) <= high) .and. all(box(:, 2) >= low)
   end function meet

end module spatial_search
