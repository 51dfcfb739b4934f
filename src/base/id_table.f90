!> Numbers that users give to things (nodes, elements, properties), and where each thing is stored.
module id_table
   implicit none
   private

   public :: sorted_order

   !> A set of identification numbers in ascending order with the position of each.
   type, public :: id_table_type
      private
      integer, allocatable :: ids(:)       ! ascending
      integer, allocatable :: positions(:) ! positions(k) is where ids(k) stood
   contains
      procedure :: build
      procedure :: find
      procedure :: list_repeated
   end type id_table_type

contains

   !> Take the numbers IDS(n); find(IDS(k)) is k from now on.
   pure subroutine build(self, ids)
      class(id_table_type), intent(inout) :: self
      integer, intent(in)                 :: ids(:)

      call sorted_order(ids, self%positions)
      self%ids = ids(self%positions)
   end subroutine build


   !> The position of ID, 0 where it is not in the table. Of repeated ids the first.
   pure integer function find(self, id) result(position)
      class(id_table_type), intent(in) :: self
      integer, intent(in)              :: id
      integer :: low, high, middle

      position = 0
      if (.not. allocated(self%ids)) return
      low = 1
      high = size(self%ids)
      do while (low < high)
         middle = low + (high - low)/2
         if (self%ids(middle) < id) then
            low = middle + 1
         else
            high = middle
         end if
      end do
      if (low > size(self%ids)) return
      if (self%ids(low) == id) position = self%positions(low)
   end function find


   !> The positions of all numbers that an earlier position holds already, in ascending order of the number.
   pure subroutine list_repeated(self, positions)
      class(id_table_type), intent(in)  :: self
      integer, allocatable, intent(out) :: positions(:)
      integer :: k, n

      allocate (positions(count(self%ids(2:) == self%ids(:size(self%ids) - 1))))
      n = 0
      do k = 2, size(self%ids)
         if (self%ids(k) /= self%ids(k - 1)) cycle
         n = n + 1
         positions(n) = self%positions(k)
      end do
   end subroutine list_repeated


   !> The permutation that puts KEYS(n) in ascending order; equal keys keep their order (merge sort).
   pure subroutine sorted_order(keys, order)
      integer, intent(in)               :: keys(:)
      integer, allocatable, intent(out) :: order(:)
      integer, allocatable :: merged(:)
      integer :: n, width, left, middle, right, i, j, k

      n = size(keys)
      allocate (order(n), merged(n))
      order = [(i, i = 1, n)]
      if (n > 1) then
         if (all(keys(2:) >= keys(:n - 1))) return
      end if
      width = 1
      do while (width < n)
         do left = 1, n, 2*width
            middle = min(left + width, n + 1)
            right = min(left + 2*width, n + 1)
            i = left
            j = middle
            do k = left, right - 1
               if (j >= right) then
                  merged(k) = order(i); i = i + 1
               else if (i >= middle) then
                  merged(k) = order(j); j = j + 1
               else if (keys(order(j)) < keys(order(i))) then
                  merged(k) = order(j); j = j + 1
               else
                  merged(k) = order(i); i = i + 1
               end if
            end do
         end do
         order = merged
         width = 2*width
      end do
   end subroutine sorted_order

end module id_table
