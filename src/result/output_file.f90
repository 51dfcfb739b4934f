!> Result files that appear under their names only when complete: written as NAME.abcdef.part, renamed at the end. Without a
!! name the lines go to the standard output at the end.
module output_file
   use c_library, only: close_file, remove_file, write_bytes
   use incomplete_results, only: create_part, name_part
   use restart_stream, only: restart_stream_type
   implicit none
   private

   type, public :: output_file_type
      private
      character(:), allocatable :: path          ! empty: standard output
      character(:), allocatable :: part          ! its name until complete
      character(:), allocatable :: buffer
      integer :: used = 0
      integer :: descriptor = -1
      logical :: fault = .false.                 ! some write has failed
      logical, public :: is_open = .false.
   contains
      procedure :: start
      procedure :: put
      procedure :: put_lines
      procedure :: length
      procedure :: text_behind
      procedure :: failed
      procedure :: finish
      procedure :: discard
      procedure :: record
   end type output_file_type

   integer, parameter :: room = 1048576          ! bytes that are buffered before a write

contains

   !> Open the file that will be PATH (empty: standard output).
   subroutine start(self, path)
      class(output_file_type), intent(inout) :: self
      character(*), intent(in)               :: path

      self%path = path
      if (allocated(self%buffer)) deallocate (self%buffer)
      allocate (character(room) :: self%buffer)
      self%used = 0
      if (path /= '') call create_part(path, self%part, self%descriptor)
      self%fault = path /= '' .and. self%descriptor < 0
      self%is_open = .not. self%fault
   end subroutine start

   !> Write one line, without the blanks at its end.
   subroutine put(self, line)
      class(output_file_type), intent(inout) :: self
      character(*), intent(in)               :: line
      integer :: length

      if (self%fault) return
      length = len_trim(line)
      if (self%used + length + 1 > len(self%buffer)) call make_room(self, length + 1)
      if (self%fault) return
      self%buffer(self%used + 1:self%used + length) = line(:length)
      self%used = self%used + length + 1
      self%buffer(self%used:self%used) = new_line('a')
   end subroutine put

   !> Write TEXT, whole lines with their ends.
   subroutine put_lines(self, text)
      class(output_file_type), intent(inout) :: self
      character(*), intent(in)               :: text

      if (self%fault) return
      if (self%used + len(text) > len(self%buffer)) call make_room(self, len(text))
      if (self%fault) return
      self%buffer(self%used + 1:self%used + len(text)) = text
      self%used = self%used + len(text)
   end subroutine put_lines

   !> Number of buffered characters: for the standard output all.
   pure integer function length(self)
      class(output_file_type), intent(in) :: self

      length = self%used
   end function length

   !> The text behind the first N characters.
   pure function text_behind(self, n) result(text)
      class(output_file_type), intent(in) :: self
      integer, intent(in)                 :: n
      character(self%used - n) :: text

      text = self%buffer(n + 1:self%used)
   end function text_behind

   !> Empty the buffer into the file; for the standard output, make the buffer larger.
   subroutine make_room(self, needed)
      class(output_file_type), intent(inout) :: self
      integer, intent(in)                    :: needed
      character(:), allocatable :: wider
      logical :: ok

      if (self%path /= '') then
         call write_bytes(self%descriptor, self%buffer(:self%used), ok)
         self%fault = .not. ok
         self%used = 0
      end if
      if (self%used + needed <= len(self%buffer)) return
      allocate (character(2*len(self%buffer) + needed) :: wider)
      wider(:self%used) = self%buffer(:self%used)
      call move_alloc(wider, self%buffer)
   end subroutine make_room

   !> Whether anything could not be written.
   pure logical function failed(self)
      class(output_file_type), intent(in) :: self

      failed = self%fault
   end function failed

   !> Close the file and give it its name. If that fails, OK is false and the file is removed.
   subroutine finish(self, ok)
      class(output_file_type), intent(inout) :: self
      logical, intent(out)                   :: ok
      logical :: closed

      ok = .false.
      if (.not. self%is_open) return
      if (.not. self%fault) then
         call write_bytes(merge(1, self%descriptor, self%path == ''), self%buffer(:self%used), ok)
         self%used = 0
      end if
      if (self%path /= '') then
         call close_file(self%descriptor, closed)
         ok = ok .and. closed
         if (ok) then
            call name_part(self%part, self%path, ok)
         else
            call remove_file(self%part)
         end if
      end if
      self%is_open = .false.
      self%fault = .not. ok
   end subroutine finish

   !> Discard the file.
   subroutine discard(self)
      class(output_file_type), intent(inout) :: self
      logical :: closed

      if (.not. self%is_open) return
      self%is_open = .false.
      if (self%path == '') return
      call close_file(self%descriptor, closed)
      call remove_file(self%part)
   end subroutine discard

   !> Write the present content of the file to a restart file, or replace it by that of the restart file.
   subroutine record(self, stream)
      class(output_file_type), intent(inout)   :: self
      type(restart_stream_type), intent(inout) :: stream
      character(:), allocatable :: text
      logical :: ok

      if (self%path == '') then
         if (stream%writes) text = self%buffer(:self%used)
         call stream%any_text(text)
         if (stream%writes .or. .not. allocated(text)) return
         self%used = 0
         call make_room(self, len(text))
         self%used = len(text)
         self%buffer(:self%used) = text
      else if (stream%writes) then
         if (self%used > 0) call write_bytes(self%descriptor, self%buffer(:self%used), ok)
         if (self%used > 0) self%fault = self%fault .or. .not. ok
         self%used = 0
         call stream%file(self%part, self%descriptor)
      else
         call self%discard()
         call self%start(self%path)
         if (self%is_open) call stream%file(self%part, self%descriptor)
      end if
   end subroutine record

end module output_file
