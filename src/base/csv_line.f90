!> A line of comma-separated values put together field by field: without formats, which cost more than all else where the lines
!! are many.
module csv_line
   use kinds, only: wp
   use number_text, only: full_width, integer_width, write_full, write_integer
   implicit none
   private

   integer, parameter :: room = 2048 ! characters at first, doubled where a line is longer

   type, public :: csv_line_type
      integer                   :: length = 0  !! used of TEXT; 0 begins a new line
      character(:), allocatable :: text        !! where anything was added
   contains
      generic :: add => add_integers, add_reals, add_text
      procedure, private :: add_integers, add_reals, add_text
   end type csv_line_type

contains

   !> WORDS as they stand, behind a comma where they are not the first field.
   pure subroutine add_text(self, words)
      class(csv_line_type), intent(inout) :: self
      character(*), intent(in)            :: words
      character(:), allocatable :: longer
      integer :: n

      n = len(words)
      if (.not. allocated(self%text)) allocate (character(room) :: self%text)
      if (self%length + 1 + n > len(self%text)) then
         allocate (character(2*(self%length + 1 + n)) :: longer)
         longer(:self%length) = self%text(:self%length)
         call move_alloc(longer, self%text)
      end if
      if (self%length > 0) then
         self%length = self%length + 1
         self%text(self%length:self%length) = ','
      end if
      self%text(self%length + 1:self%length + n) = words
      self%length = self%length + n
   end subroutine add_text

   !> VALUES as i0, a field each.
   pure subroutine add_integers(self, values)
      class(csv_line_type), intent(inout) :: self
      integer, intent(in)                 :: values(:)
      character(integer_width) :: digits
      integer :: i, n

      do i = 1, size(values)
         call write_integer(values(i), digits, n)
         call self%add_text(digits(:n))
      end do
   end subroutine add_integers

   !> VALUES with the 17 digits that make them come back the same, as es24.16e3 without blanks, a field each.
   pure subroutine add_reals(self, values)
      class(csv_line_type), intent(inout) :: self
      real(wp), intent(in)                :: values(:)
      character(full_width) :: field
      integer :: i, n

      do i = 1, size(values)
         call write_full(values(i), field, n)
         call self%add_text(field(:n))
      end do
   end subroutine add_reals

end module csv_line
