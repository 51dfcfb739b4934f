!> Search of points and boxes by position in a tree of bounding volumes, in log n steps.
!! Each section of the tree is halved along the axis of its largest extent of points or box centres. The box around a section is
!! stored with its middle.
!! Source: Bentley, Multidimensional binary search trees used for associative searching, Comm. ACM 18 (1975) 509-517; Clark,
!! Hierarchical geometric models for visible surface algorithms, Comm. ACM 19 (1976) 547-554.
module spatial_search
   use kinds, only: wp
   implicit none
   private

   !> Boxes; points are boxes without extent.
   type, public :: spatial_search_type
      private
      real(wp), allocatable :: box(:, :, :)    ! (3, 2, n) least and greatest coordinates, in the order of the tree
      real(wp), allocatable :: around(:, :, :) ! (3, 2, n) bounding boxes of the sections with this middle
      integer, allocatable  :: number(:)       ! (n) input number of each box
   contains
      procedure :: build
      procedure :: nearest
      procedure :: list_meeting
   end type spatial_search_type

   integer, parameter :: first_undivided = 8 ! sections of at most this length are not divided
   integer, parameter :: many = 4096         ! length from which on a section is a task

contains

   !> Build the tree of the boxes from LOW(3, n) to HIGH(3, n), or of the points LOW.
   subroutine build(self, low, high)
      class(spatial_search_type), intent(inout) :: self
      real(wp), intent(in)           :: low(:, :)
      real(wp), intent(in), optional :: high(:, :)
      real(wp) :: boxes(3, 2, size(low, 2))
      real(wp), allocatable :: centres(:, :)
      real(wp) :: whole(3, 2)
      integer  :: i

      boxes(:, 1, :) = low
      boxes(:, 2, :) = low
      if (present(high)) boxes(:, 2, :) = high
      allocate (centres, source=0.5_wp*(boxes(:, 1, :) + boxes(:, 2, :)))
      self%number = [(i, i = 1, size(centres, 2))]
      !$omp parallel default(shared) if(size(self%number) > many)
      !$omp single
      call divide(centres, self%number)
      !$omp end single
      !$omp end parallel
      self%box = boxes(:, :, self%number)
      self%around = self%box
      if (size(self%number) > 0) call surround(self, 1, size(self%number), whole)
   end subroutine build

   !> Sort a section of POINTS, with their NUMBERs, into the order of the tree: points are exchanged until none before the middle
   !! has a larger coordinate along the axis of the largest extent, and none behind it a smaller one; then each half likewise.
   !! Source: Hoare's FIND; Wirth, Algorithms + Data Structures = Programs, section 2.3.4.
   recursive subroutine divide(points, number)
      real(wp), intent(inout) :: points(:, :) !! (3, n)
      integer, intent(inout)  :: number(:)    !! (n)
      real(wp) :: pivot, point(3)
      integer  :: axis, i, j, k, low, high, middle

      low = 1
      high = size(number)
      if (high <= first_undivided) return
      middle = 1 + (high - 1)/2
      axis = maxloc(maxval(points, dim=2) - minval(points, dim=2), dim=1)
      do while (low < high)
         pivot = points(axis, middle)
         i = low
         j = high
         do while (i <= j)
            do while (points(axis, i) < pivot)
               i = i + 1
            end do
            do while (points(axis, j) > pivot)
               j = j - 1
            end do
            if (i > j) exit
            point = points(:, i)
            points(:, i) = points(:, j)
            points(:, j) = point
            k = number(i)
            number(i) = number(j)
            number(j) = k
            i = i + 1
            j = j - 1
         end do
         if (j < middle) low = i
         if (i > middle) high = j
      end do
      !$omp task default(shared) if(middle > many)
      call divide(points(:, :middle - 1), number(:middle - 1))
      !$omp end task
      call divide(points(:, middle + 1:), number(middle + 1:))
      !$omp taskwait
   end subroutine divide

   !> The bounding box AROUND the boxes FIRST to LAST of the tree, stored with its middle.
   pure recursive subroutine surround(self, first, last, around)
      type(spatial_search_type), intent(inout) :: self
      integer, intent(in)   :: first, last
      real(wp), intent(out) :: around(3, 2)
      real(wp) :: half(3, 2)
      integer  :: middle

      middle = first + (last - first)/2
      if (last - first < first_undivided) then
         around(:, 1) = minval(self%box(:, 1, first:last), dim=2)
         around(:, 2) = maxval(self%box(:, 2, first:last), dim=2)
      else
         call surround(self, first, middle - 1, half)
         around(:, 1) = min(self%box(:, 1, middle), half(:, 1))
         around(:, 2) = max(self%box(:, 2, middle), half(:, 2))
         call surround(self, middle + 1, last, half)
         around(:, 1) = min(around(:, 1), half(:, 1))
         around(:, 2) = max(around(:, 2), half(:, 2))
      end if
      self%around(:, :, middle) = around
   end subroutine surround

   !> The point nearest to X within REACH, 0: none; of equally near points the first.
   pure subroutine nearest(self, x, reach, point, distance)
      class(spatial_search_type), intent(in) :: self
      real(wp), intent(in)  :: x(3), reach
      integer, intent(out)  :: point
      real(wp), intent(out) :: distance !! huge without a point

      point = 0
      distance = huge(1.0_wp)
      if (size(self%number) > 0) call find_nearer(self, 1, size(self%number), x, reach, point, distance)
   end subroutine nearest

   !> Find among the points FIRST to LAST of the tree one nearer than DISTANCE, or equally near and before POINT; the nearer half is
   !! searched first.
   pure recursive subroutine find_nearer(self, first, last, x, reach, point, distance)
      type(spatial_search_type), intent(in) :: self
      integer, intent(in)     :: first, last
      real(wp), intent(in)    :: x(3), reach
      integer, intent(inout)  :: point
      real(wp), intent(inout) :: distance
      real(wp) :: candidate, beyond(2)
      integer  :: half, i, middle
      logical  :: is_divided

      middle = first + (last - first)/2
      is_divided = last - first >= first_undivided
      do i = merge(middle, first, is_divided), merge(middle, last, is_divided)
         if (gap(self%box(:, :, i), x) > min(distance, reach)) cycle ! cheaper than the distance
         candidate = norm2(self%box(:, 1, i) - x)
         if (candidate > reach .or. candidate > distance) cycle
         if (candidate >= distance .and. self%number(i) > point) cycle
         point = self%number(i)
         distance = candidate
      end do
      if (.not. is_divided) return
      beyond(1) = gap(self%around(:, :, first + (middle - 1 - first)/2), x)
      beyond(2) = gap(self%around(:, :, middle + 1 + (last - middle - 1)/2), x)
      do i = 1, 2
         half = merge(i, 3 - i, beyond(1) <= beyond(2))
         if (beyond(half) > min(distance, reach)) cycle
         if (half == 1) call find_nearer(self, first, middle - 1, x, reach, point, distance)
         if (half == 2) call find_nearer(self, middle + 1, last, x, reach, point, distance)
      end do
   end subroutine find_nearer

   !> Largest distance of X from BOX along any axis, a lower bound of the distance of its points.
   pure real(wp) function gap(box, x)
      real(wp), intent(in) :: box(3, 2), x(3)

      gap = max(0.0_wp, box(1, 1) - x(1), x(1) - box(1, 2), box(2, 1) - x(2), x(2) - box(2, 2), box(3, 1) - x(3), x(3) - box(3, 2))
   end function gap

   !> The boxes FOUND(:N) that meet the box from LOW to HIGH, borders included.
   pure subroutine list_meeting(self, low, high, found, n)
      class(spatial_search_type), intent(in) :: self
      real(wp), intent(in)                   :: low(3), high(3)
      integer, allocatable, intent(inout)    :: found(:) !! enlarged if necessary
      integer, intent(out)                   :: n

      n = 0
      if (size(self%number) > 0) call add_meeting(self, 1, size(self%number), low, high, found, n)
   end subroutine list_meeting

   !> Add to FOUND(:N) the boxes FIRST to LAST of the tree that meet the box from LOW to HIGH.
   pure recursive subroutine add_meeting(self, first, last, low, high, found, n)
      type(spatial_search_type), intent(in) :: self
      integer, intent(in)                   :: first, last
      real(wp), intent(in)                  :: low(3), high(3)
      integer, allocatable, intent(inout)   :: found(:)
      integer, intent(inout)                :: n
      integer :: i, middle
      logical :: is_divided

      middle = first + (last - first)/2
      if (any(self%around(:, 1, middle) > high) .or. any(self%around(:, 2, middle) < low)) return
      is_divided = last - first >= first_undivided
      if (is_divided) call add_meeting(self, first, middle - 1, low, high, found, n)
      do i = merge(middle, first, is_divided), merge(middle, last, is_divided)
         if (any(self%box(:, 1, i) > high) .or. any(self%box(:, 2, i) < low)) cycle
         if (n == size(found)) found = [found, found, spread(0, 1, 8)]
         n = n + 1
         found(n) = self%number(i)
      end do
      if (is_divided) call add_meeting(self, middle + 1, last, low, high, found, n)
   end subroutine add_meeting

end module spatial_search
