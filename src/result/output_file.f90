!> Result files that appear under their names only when complete: written as NAME.abcdef.part, closed, and renamed at the end of
!! the run. Without a name the lines go to the standard output at the end.
module output_file
   use, intrinsic :: iso_c_binding, only: c_null_char
   use c_library, only: c_truncate, close_file, go_to_byte, open_to_write, remove_file, write_bytes
   use incomplete_results, only: create_part, name_part
   use kinds, only: long
   use restart_stream, only: restart_stream_type
   implicit none
   private

   type, public :: output_file_type
      private
      character(:), allocatable :: path          ! empty: standard output
      character(:), allocatable, public :: part  !! its name until the end
      character(:), allocatable :: buffer
      integer, public :: used = 0                !! characters of the buffer: of the standard output all
      integer :: descriptor = -1
      logical, public :: fault = .false.         !! some write has failed, or the writer has found a fault
      logical, public :: is_open = .false.
      logical :: waits = .false.                 ! complete and closed, not yet named
      logical, public :: is_named = .false.      !! has its name
      integer(long), public :: kept = 0          !! bytes up to the last mark
   contains
      procedure :: start
      procedure :: put
      procedure :: put_lines
      procedure :: text_behind
      procedure :: close
      procedure :: finish
      procedure :: discard
      procedure :: mark
      procedure :: return_to_mark
      procedure :: record
   end type output_file_type

   integer, parameter :: room = 1048576          ! bytes that are buffered before a write

contains

   !> Open the file that will be PATH (empty: standard output). A file that is still open is discarded. IS_PART: PATH is the part
   !! that another process has created; that process gives it its name, or removes it.
   subroutine start(self, path, is_part)
      class(output_file_type), intent(inout) :: self
      character(*), intent(in)               :: path
      logical, intent(in), optional          :: is_part !! default: false
      logical :: exists

      self%is_named = .false.
      self%kept = 0
      call self%discard()
      self%path = path
      if (allocated(self%buffer)) deallocate (self%buffer)
      allocate (character(room) :: self%buffer)
      self%used = 0
      exists = .false.
      if (present(is_part)) exists = is_part
      if (exists) then
         self%part = path
         call open_to_write(path, self%descriptor)
      else if (path /= '') then
         call create_part(path, self%part, self%descriptor)
      end if
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

   !> Write TEXT, whole lines with their ends, or bytes.
   subroutine put_lines(self, text)
      class(output_file_type), intent(inout) :: self
      character(*), intent(in)               :: text
      logical :: ok

      if (self%fault) return
      if (self%path /= '' .and. len(text, long) > room) then
         call empty(self)
         if (.not. self%fault) call write_bytes(self%descriptor, text, ok)
         self%fault = self%fault .or. .not. ok
         return
      end if
      if (self%used + len(text) > len(self%buffer)) call make_room(self, len(text))
      if (self%fault) return
      self%buffer(self%used + 1:self%used + len(text)) = text
      self%used = self%used + len(text)
   end subroutine put_lines

   !> The text behind the first N characters.
   pure function text_behind(self, n) result(text)
      class(output_file_type), intent(in) :: self
      integer, intent(in)                 :: n
      character(self%used - n) :: text

      text = self%buffer(n + 1:self%used)
   end function text_behind

   !> Empty the buffer into the file.
   subroutine empty(self)
      class(output_file_type), intent(inout) :: self
      logical :: ok

      if (.not. self%fault) call write_bytes(self%descriptor, self%buffer(:self%used), ok)
      self%fault = self%fault .or. .not. ok
      self%used = 0
   end subroutine empty

   !> Make room for the NEEDED bytes in the buffer; for the standard output, make the buffer larger.
   subroutine make_room(self, needed)
      class(output_file_type), intent(inout) :: self
      integer, intent(in)                    :: needed
      character(:), allocatable :: wider

      if (self%path /= '') call empty(self)
      if (self%used + needed <= len(self%buffer)) return
      allocate (character(2*len(self%buffer) + needed) :: wider)
      wider(:self%used) = self%buffer(:self%used)
      call move_alloc(wider, self%buffer)
   end subroutine make_room

   !> Write the rest and close the file, which has no name yet.
   subroutine close(self)
      class(output_file_type), intent(inout) :: self
      logical :: closed

      if (.not. self%is_open .or. self%path == '') return
      call empty(self)
      call close_file(self%descriptor, closed)
      deallocate (self%buffer)
      self%is_open = .false.
      self%fault = self%fault .or. .not. closed
      self%waits = .not. self%fault
      if (self%fault) call remove_file(self%part)
   end subroutine close

   !> Close the file and give it its name. If that fails, OK is false and the file is removed.
   subroutine finish(self, ok)
      class(output_file_type), intent(inout) :: self
      logical, intent(out)                   :: ok

      ok = .false.
      if (.not. (self%is_open .or. self%waits)) return
      if (self%path == '') then
         if (.not. self%fault) call write_bytes(1, self%buffer(:self%used), ok)
         self%used = 0
         self%is_open = .false.
      else
         call self%close()
         if (self%waits) call name_part(self%part, self%path, ok)
         self%waits = .false.
         self%is_named = ok
      end if
      self%fault = .not. ok
   end subroutine finish

   !> Discard the file, unless it already has its name.
   subroutine discard(self)
      class(output_file_type), intent(inout) :: self
      logical :: closed

      if (self%is_open) self%waits = self%path /= ''
      if (self%is_open .and. self%waits) call close_file(self%descriptor, closed)
      if (self%waits) call remove_file(self%part)
      self%is_open = .false.
      self%waits = .false.
   end subroutine discard

   !> Mark the present end of the file: of a run that ends early the bytes up to here are kept.
   subroutine mark(self)
      class(output_file_type), intent(inout) :: self

      if (.not. self%is_open) return
      if (self%path == '') then
         self%kept = self%used
      else
         call empty(self)
         if (.not. self%fault) self%kept = go_to_byte(self%descriptor)
      end if
   end subroutine mark

   !> Drop what was written behind the mark.
   subroutine return_to_mark(self)
      class(output_file_type), intent(inout) :: self

      if (.not. self%is_open .or. self%fault) return
      if (self%path == '') then
         self%used = int(self%kept)
      else
         self%used = 0
         self%fault = c_truncate(self%part//c_null_char, self%kept) /= 0
         if (.not. self%fault) self%fault = go_to_byte(self%descriptor, self%kept) /= self%kept
      end if
   end subroutine return_to_mark

   !> Write the present content of the file to a restart file, or replace it by that of the restart file; the file is then open.
   subroutine record(self, stream)
      class(output_file_type), intent(inout)   :: self
      type(restart_stream_type), intent(inout) :: stream
      character(:), allocatable :: text
      integer(long) :: kept

      kept = self%kept
      call stream%part('output_file_type', 1)
      call stream%item('kept', kept)
      if (self%path == '') then
         if (stream%writes) text = self%buffer(:self%used)
         call stream%text('buffer', text)
         if (stream%writes .or. .not. allocated(text)) return
         self%used = 0
         call make_room(self, len(text))
         self%used = len(text)
         self%buffer(:self%used) = text
         self%kept = min(kept, len(text, long))
      else if (stream%writes) then
         if (self%is_open) call empty(self)
         call stream%file(self%part, self%descriptor)
      else
         call self%start(self%path)
         if (self%is_open) call stream%file(self%part, self%descriptor)
         self%kept = kept
      end if
   end subroutine record

end module output_file
