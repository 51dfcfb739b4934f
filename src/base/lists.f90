!> Looks up, sorts and groups whole numbers such as the identification numbers of nodes, elements and properties.
!! A number table gives the position of an identification number. An inverse list gives for each number the lists that hold it (from
!! the nodes of every element to the elements of every node). Disjoint sets of 1 to n use union-find: PARENT(i) is another member of
!! the set of i, or i itself where i is the root. At first every i is a root.
module lists
   use kinds, only: long
   implicit none
   private

   public :: sorted_order, distinct, first_not_below, list_owners, join, root_of

   !> A set of identification numbers in ascending order with the position of each.
   type, public :: id_table_type
      private
      integer, allocatable :: ids(:)       ! ascending
      integer, allocatable :: positions(:) ! positions(k) is the position of ids(k)
      integer, allocatable :: direct(:)    ! direct(id) is the position of id, 0: none; only for dense numbers
   contains
      procedure :: build
      procedure :: add
      procedure :: find
      procedure :: list_repeated
   end type id_table_type

   integer, parameter :: sparsest = 8 ! at most so many times the count of numbers is the range of a direct table

contains

   !> Build the table of the numbers IDS(n); find(IDS(k)) is then k.
   pure subroutine build(self, ids)
      class(id_table_type), intent(inout) :: self
      integer, intent(in)                 :: ids(:)

      call sorted_order(ids, self%positions)
      self%ids = ids(self%positions)
      call tabulate(self)
   end subroutine build

   !> Make the direct table of the numbers, if these are dense.
   pure subroutine tabulate(self)
      class(id_table_type), intent(inout) :: self
      integer :: k, n

      n = size(self%ids)
      if (allocated(self%direct)) deallocate (self%direct)
      if (n == 0) return
      if (int(self%ids(n), long) - self%ids(1) >= int(sparsest, long)*n) return
      allocate (self%direct(self%ids(1):self%ids(n)), source=0)
      do k = n, 1, -1
         self%direct(self%ids(k)) = self%positions(k)
      end do
   end subroutine tabulate

   !> Add the numbers IDS with their POSITIONS; a number already in the table keeps its position.
   pure subroutine add(self, ids, positions)
      class(id_table_type), intent(inout) :: self
      integer, intent(in)                 :: ids(:), positions(:)
      integer, allocatable :: order(:)

      self%ids = [self%ids, ids]
      self%positions = [self%positions, positions]
      call sorted_order(self%ids, order)
      self%ids = self%ids(order)
      self%positions = self%positions(order)
      call tabulate(self)
   end subroutine add

   !> The position of ID, 0 where it is not in the table, the first position of a repeated ID.
   pure integer function find(self, id) result(position)
      class(id_table_type), intent(in) :: self
      integer, intent(in)              :: id
      integer :: k

      position = 0
      if (.not. allocated(self%ids)) return
      if (allocated(self%direct)) then
         if (id >= lbound(self%direct, 1) .and. id <= ubound(self%direct, 1)) position = self%direct(id)
         return
      end if
      if (size(self%ids) == 0) return
      k = first_not_below(self%ids, id)
      if (self%ids(k) == id) position = self%positions(k)
   end function find

   !> The first position of the ascending KEYS whose key is at least KEY, the last one where there is none; by bisection.
   pure integer function first_not_below(keys, key) result(low)
      integer, intent(in) :: keys(:), key
      integer :: high, middle

      low = 1
      high = size(keys)
      do while (low < high)
         middle = low + (high - low)/2
         if (keys(middle) < key) then
            low = middle + 1
         else
            high = middle
         end if
      end do
   end function first_not_below

   !> The positions of all repeated numbers but the first of each, in ascending order of the number.
   pure subroutine list_repeated(self, positions)
      class(id_table_type), intent(in)  :: self
      integer, allocatable, intent(out) :: positions(:)

      positions = pack(self%positions(2:), self%ids(2:) == self%ids(:size(self%ids) - 1))
   end subroutine list_repeated

   !> The permutation that puts KEYS(n) in ascending order; equal keys keep their order.
   !! Source: radix sort by bytes, the least significant first; Knuth, The Art of Computer Programming 3, section 5.2.5.
   pure subroutine sorted_order(keys, order)
      integer, intent(in)               :: keys(:)
      integer, allocatable, intent(out) :: order(:)
      integer, allocatable :: before(:)
      integer(long) :: above, least
      integer :: byte, digit, first(0:256), i, n

      n = size(keys)
      order = [(i, i = 1, n)]
      if (n < 2) return
      if (all(keys(2:) >= keys(:n - 1))) return
      least = minval(keys)
      above = maxval(keys) - least
      byte = 0
      do while (shiftr(above, 8*byte) > 0)
         call move_alloc(order, before)
         allocate (order(n))
         first = 0
         do i = 1, n
            digit = int(ibits(keys(i) - least, 8*byte, 8)) + 1
            first(digit) = first(digit) + 1
         end do
         do digit = 1, 256
            first(digit) = first(digit - 1) + first(digit) ! where the keys with this byte end
         end do
         do i = 1, n
            digit = int(ibits(keys(before(i)) - least, 8*byte, 8))
            first(digit) = first(digit) + 1
            order(first(digit)) = before(i)
         end do
         byte = byte + 1
      end do
   end subroutine sorted_order

   !> The distinct numbers among KEYS, in ascending order.
   pure subroutine distinct(keys, values)
      integer, intent(in)               :: keys(:)
      integer, allocatable, intent(out) :: values(:)
      integer, allocatable :: order(:)
      logical, allocatable :: is_new(:)

      call sorted_order(keys, order)
      values = keys(order)
      allocate (is_new(size(values)), source=.true.)
      is_new(2:) = values(2:) /= values(:size(values) - 1)
      values = pack(values, is_new)
   end subroutine distinct

   !> OWNERS(FIRST(i):FIRST(i + 1) - 1) are the columns of MEMBERS that hold the number i, in ascending order. A column that holds i
   !! twice appears twice.
   pure subroutine list_owners(n, members, first, owners)
      integer, intent(in)               :: n              !! numbers: 1 to N
      integer, intent(in)               :: members(:, :)  !! (most of a list, lists); 0: none
      integer, allocatable, intent(out) :: first(:)       !! (N + 1)
      integer, allocatable, intent(out) :: owners(:)      !! (entries of MEMBERS that are not 0)
      integer :: i, k, list

      allocate (first(n + 1), source=0)
      do list = 1, size(members, 2)
         do k = 1, size(members, 1)
            i = members(k, list)
            if (i > 0) first(i) = first(i) + 1
         end do
      end do
      first(n + 1) = 1 + sum(first(:n))
      do i = n, 1, -1
         first(i) = first(i + 1) - first(i)       ! where the owners of i begin
      end do
      allocate (owners(first(n + 1) - 1))
      do list = 1, size(members, 2)
         do k = 1, size(members, 1)
            i = members(k, list)
            if (i == 0) cycle
            owners(first(i)) = list
            first(i) = first(i) + 1               ! where the next owner of i goes; in the end where those of i + 1 begin
         end do
      end do
      first = [1, first(:n)]
   end subroutine list_owners

   !> Unite the sets of A and B (union-find with path halving); zero is ignored.
   pure subroutine join(parent, a, b)
      integer, intent(inout) :: parent(:)
      integer, intent(in)    :: a, b
      integer :: i, j

      if (a == 0 .or. b == 0) return
      call climb(parent, a, i)
      call climb(parent, b, j)
      parent(max(i, j)) = min(i, j)
   end subroutine join

   !> The ROOT of the set of MEMBER; halves the path.
   pure subroutine climb(parent, member, root)
      integer, intent(inout) :: parent(:)
      integer, intent(in)    :: member
      integer, intent(out)   :: root

      root = member
      do while (parent(root) /= root)
         parent(root) = parent(parent(root))
         root = parent(root)
      end do
   end subroutine climb

   !> The root of the set of MEMBER.
   pure integer function root_of(parent, member) result(root)
      integer, intent(in) :: parent(:), member

      root = member
      do while (parent(root) /= root)
         root = parent(root)
      end do
   end function root_of

end module lists
