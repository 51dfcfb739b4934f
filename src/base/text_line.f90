!> A line of a history put together field by field: without formats, which cost more than all else where the lines are many.
module text_line
   use kinds, only: wp
   use number_text, only: full_width, integer_width, write_full, write_integer
   implicit none
   private

   integer, parameter :: room = 1024 ! characters, more than any line has; what lies beyond is cut off

   type, public :: text_line_type
      integer         :: length = 0  !! used of TEXT
      character(room) :: text
   contains
      procedure :: clear
      procedure :: add
      procedure :: add_integer
      procedure :: add_full
   end type text_line_type

contains

   !> Begin the line anew.
   pure subroutine clear(self)
      class(text_line_type), intent(inout) :: self

      self%length = 0
   end subroutine clear


   !> WORDS as they stand.
   pure subroutine add(self, words)
      class(text_line_type), intent(inout) :: self
      character(*), intent(in)             :: words
      integer :: n

      n = min(len(words), room - self%length)
      self%text(self%length + 1:self%length + n) = words(:n)
      self%length = self%length + n
   end subroutine add


   !> VALUE as i0.
   pure subroutine add_integer(self, value)
      class(text_line_type), intent(inout) :: self
      integer, intent(in)                  :: value
      character(integer_width) :: digits
      integer :: n

      call write_integer(value, digits, n)
      call self%add(digits(:n))
   end subroutine add_integer


   !> VALUE with 17 digits, as es24.16e3 without blanks.
   pure subroutine add_full(self, value)
      class(text_line_type), intent(inout) :: self
      real(wp), intent(in)                 :: value
      character(full_width) :: field
      integer :: n

      call write_full(value, field, n)
      call self%add(field(:n))
   end subroutine add_full

end module text_line
