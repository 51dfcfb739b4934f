!> Rows of a table that is printed later, when its stage is complete.
module row_buffer
   use output_file, only: output_file_type
   implicit none
   private

   integer, parameter :: width = 132

   type, public :: row_buffer_type
      integer :: n = 0
      character(width), allocatable, private :: rows(:)
   contains
      procedure :: add
      procedure :: flush => flush_rows
   end type row_buffer_type

contains

   subroutine add(self, row)
      class(row_buffer_type), intent(inout) :: self
      character(*), intent(in)              :: row
      character(width), allocatable :: longer(:)

      if (.not. allocated(self%rows)) allocate (self%rows(64))
      if (self%n == size(self%rows)) then
         allocate (longer(2*self%n))
         longer(:self%n) = self%rows
         call move_alloc(longer, self%rows)
      end if
      self%n = self%n + 1
      self%rows(self%n) = row
   end subroutine add


   !> Print all rows and forget them.
   subroutine flush_rows(self, file)
      class(row_buffer_type), intent(inout) :: self
      type(output_file_type), intent(inout) :: file
      integer :: i

      do i = 1, self%n
         call file%put(self%rows(i))
      end do
      self%n = 0
   end subroutine flush_rows

end module row_buffer
