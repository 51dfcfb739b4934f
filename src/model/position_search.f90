!> Points found by position: a hashed grid of cells, so that pairing n points costs n steps.
module position_search
   use kinds, only: long, wp
   implicit none
   private

   type, public :: position_search_type
      private
      real(wp) :: cell = 1.0_wp                  ! size of a cell
      real(wp) :: origin(3) = 0.0_wp
      real(wp), allocatable :: points(:, :)      ! (3, n)
      integer, allocatable  :: first(:), next(:) ! chain of the points of a bucket
   contains
      procedure :: build
      procedure :: nearest
   end type position_search_type

contains

   !> Take the POINTS(3, n). REACH is the largest distance that `nearest` will be asked for.
   pure subroutine build(self, points, reach)
      class(position_search_type), intent(inout) :: self
      real(wp), intent(in) :: points(:, :), reach
      real(wp) :: extent
      integer  :: i, n, bucket

      n = size(points, 2)
      self%points = points
      if (allocated(self%first)) deallocate (self%first, self%next)
      allocate (self%first(0:max(1, 2*n) - 1), source=0)
      allocate (self%next(n), source=0)
      if (n == 0) return
      self%origin = minval(points, dim=2)
      extent = maxval(maxval(points, dim=2) - self%origin)
      self%cell = max(2.0_wp*reach, extent/real(n, wp), tiny(1.0_wp)*1.0e10_wp)
      do i = n, 1, -1
         bucket = bucket_of(self, cell_of(self, points(:, i)))
         self%next(i) = self%first(bucket)
         self%first(bucket) = i
      end do
   end subroutine build


   !> The point nearest to X within REACH (not more than the REACH of `build`); 0 where there is none. Of points at the
   !! same distance the first.
   pure subroutine nearest(self, x, reach, point, distance)
      class(position_search_type), intent(in) :: self
      real(wp), intent(in)  :: x(3), reach
      integer, intent(out)  :: point
      real(wp), intent(out) :: distance
      integer(long) :: home(3), cell(3)
      real(wp) :: candidate
      integer  :: dx, dy, dz, i

      point = 0
      distance = huge(1.0_wp)
      if (size(self%next) == 0) return
      if (maxval(abs(x - self%origin))/self%cell > 1.0e15_wp) return
      home = cell_of(self, x)
      do dz = -1, 1
         do dy = -1, 1
            do dx = -1, 1
               cell = home + [dx, dy, dz]
               i = self%first(bucket_of(self, cell))
               do while (i > 0)
                  candidate = norm2(self%points(:, i) - x)
                  if (candidate <= reach .and. (candidate < distance .or. (candidate <= distance .and. i < point))) then
                     point = i
                     distance = candidate
                  end if
                  i = self%next(i)
               end do
            end do
         end do
      end do
   end subroutine nearest


   pure function cell_of(self, x) result(cell)
      class(position_search_type), intent(in) :: self
      real(wp), intent(in) :: x(3)
      integer(long) :: cell(3)

      cell = floor((x - self%origin)/self%cell, kind=long)
   end function cell_of


   pure integer function bucket_of(self, cell) result(bucket)
      class(position_search_type), intent(in) :: self
      integer(long), intent(in) :: cell(3)
      integer(long), parameter :: prime(3) = [73856093_long, 19349663_long, 83492791_long]
      integer(long) :: mixed, clipped(3)

      clipped = modulo(cell, 1000000007_long)
      mixed = ieor(ieor(clipped(1)*prime(1), clipped(2)*prime(2)), clipped(3)*prime(3))
      bucket = int(modulo(mixed, int(size(self%first), long)))
   end function bucket_of

end module position_search
