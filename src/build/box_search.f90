!> Boxes found by a box: a tree of bounding volumes, so that the few of n that one meets are found in log n steps. A stretch of the
!! tree is halved as position_search halves the centres of its boxes; the box about all of a stretch stands with its middle.
!! Source: Clark, Hierarchical geometric models for visible surface algorithms, Comm. ACM 19 (1976) 547-554.
module box_search
   use kinds, only: wp
   use position_search, only: first_undivided, position_search_type
   implicit none
   private

   type, public :: box_search_type
      private
      real(wp), allocatable :: box(:, :, :)   ! (3, 2, n) least and greatest coordinates, in the order of the tree
      real(wp), allocatable :: around(:, :, :) ! (3, 2, n) those of all boxes of the stretch with this middle
      integer, allocatable  :: number(:)      ! (n) which of the boxes given each is
   contains
      procedure :: build
      procedure :: list_meeting
   end type box_search_type

contains

   !> Take the BOXES(3, 2, n), least and greatest coordinates.
   pure subroutine build(self, boxes)
      class(box_search_type), intent(inout) :: self
      real(wp), intent(in) :: boxes(:, :, :)
      type(position_search_type) :: centres
      real(wp) :: whole(3, 2)

      call centres%build(0.5_wp*(boxes(:, 1, :) + boxes(:, 2, :)))
      self%number = centres%order()
      self%box = boxes(:, :, self%number)
      self%around = self%box
      call surround(self, 1, size(self%number), whole)
   end subroutine build

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
      call look_into(self, 1, size(self%number), low, high, found, n)
   end subroutine list_meeting

   !> Add to FOUND(:N) those of the boxes FIRST to LAST of the tree that meet the box from LOW to HIGH.
   pure recursive subroutine look_into(self, first, last, low, high, found, n)
      type(box_search_type), intent(in)   :: self
      integer, intent(in)                 :: first, last
      real(wp), intent(in)                :: low(3), high(3)
      integer, allocatable, intent(inout) :: found(:)
      integer, intent(inout)              :: n
      integer :: i, middle

      if (last - first < first_undivided) then
         do i = first, last
            call compare(self, i, low, high, found, n)
         end do
         return
      end if
      middle = first + (last - first)/2
      if (.not. meet(self%around(:, :, middle), low, high)) return
      call look_into(self, first, middle - 1, low, high, found, n)
      call compare(self, middle, low, high, found, n)
      call look_into(self, middle + 1, last, low, high, found, n)
   end subroutine look_into

   !> Add box I of the tree to FOUND(:N) where it meets the box from LOW to HIGH.
   pure subroutine compare(self, i, low, high, found, n)
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
   end subroutine compare

   !> Whether BOX and that from LOW to HIGH have a point in common.
   pure logical function meet(box, low, high)
      real(wp), intent(in) :: box(3, 2), low(3), high(3)

      meet = all(box(:, 1) <= high) .and. all(box(:, 2) >= low)
   end function meet

end module box_search
