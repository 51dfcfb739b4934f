!> The few services of the C library that Fortran has no word for: reading and writing files by bytes with
!! every failure told, renaming and removing a file, the true path of a file, and whether a stream is a terminal.
module c_library
   use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_f_pointer, c_int, c_null_char, c_null_ptr, &
                                          c_ptr, c_size_t
   implicit none
   private

   public :: read_all_bytes, create_file, write_bytes, close_file, rename_file, remove_file, remove_terminated, &
             true_path, is_terminal, end_run

   logical, public, protected :: has_ended = .false. !! by end_run

   interface
      function c_fopen(path, mode) bind(c, name='fopen') result(stream)
         import :: c_char, c_ptr
         character(kind=c_char), intent(in) :: path(*), mode(*)
         type(c_ptr) :: stream
      end function c_fopen

      function c_fread(buffer, size, count, stream) bind(c, name='fread') result(got)
         import :: c_char, c_ptr, c_size_t
         character(kind=c_char), intent(out) :: buffer(*)
         integer(c_size_t), value :: size, count
         type(c_ptr), value       :: stream
         integer(c_size_t)        :: got
      end function c_fread

      function c_ferror(stream) bind(c, name='ferror') result(status)
         import :: c_int, c_ptr
         type(c_ptr), value :: stream
         integer(c_int)     :: status
      end function c_ferror

      function c_fclose(stream) bind(c, name='fclose') result(status)
         import :: c_int, c_ptr
         type(c_ptr), value :: stream
         integer(c_int)     :: status
      end function c_fclose

      function c_creat(path, mode) bind(c, name='creat') result(descriptor)
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int), value :: mode
         integer(c_int)        :: descriptor
      end function c_creat

      function c_write(descriptor, bytes, count) bind(c, name='write') result(written)
         import :: c_char, c_int, c_size_t
         integer(c_int), value              :: descriptor
         character(kind=c_char), intent(in) :: bytes(*)
         integer(c_size_t), value           :: count
         integer(c_size_t)                  :: written  ! -1 on failure
      end function c_write

      function c_close(descriptor) bind(c, name='close') result(status)
         import :: c_int
         integer(c_int), value :: descriptor
         integer(c_int)        :: status
      end function c_close

      function c_rename(old, new) bind(c, name='rename') result(status)
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: old(*), new(*)
         integer(c_int) :: status
      end function c_rename

      function c_unlink(path) bind(c, name='unlink') result(status)
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int) :: status
      end function c_unlink

      function c_realpath(path, resolved) bind(c, name='realpath') result(text)
         import :: c_char, c_ptr
         character(kind=c_char), intent(in) :: path(*)
         type(c_ptr), value :: resolved
         type(c_ptr)        :: text
      end function c_realpath

      function c_strlen(text) bind(c, name='strlen') result(length)
         import :: c_ptr, c_size_t
         type(c_ptr), value :: text
         integer(c_size_t)  :: length
      end function c_strlen

      subroutine c_free(memory) bind(c, name='free')
         import :: c_ptr
         type(c_ptr), value :: memory
      end subroutine c_free

      function c_isatty(descriptor) bind(c, name='isatty') result(answer)
         import :: c_int
         integer(c_int), value :: descriptor
         integer(c_int)        :: answer
      end function c_isatty

      subroutine c_exit(status) bind(c, name='exit')
         import :: c_int
         integer(c_int), value :: status
      end subroutine c_exit
   end interface

contains

   !> All bytes of the file PATH, whatever it is: a plain file, a pipe, the standard input.
   !! OK is false where it cannot be opened or read (a directory opens, but does not read).
   subroutine read_all_bytes(path, bytes, ok)
      character(*), intent(in)               :: path
      character(:), allocatable, intent(out) :: bytes
      logical, intent(out)                   :: ok
      integer(c_size_t), parameter :: first_room = 1048576 ! where the size of the file is not known
      character(:), allocatable :: wider
      character(1)      :: one_more
      integer(c_size_t) :: used, got, room
      integer(c_int)    :: status
      type(c_ptr)       :: stream

      ok = .false.
      stream = c_fopen(path//c_null_char, 'rb'//c_null_char)
      if (.not. c_associated(stream)) return
      inquire (file=path, size=room)
      if (room <= 0) room = first_room
      allocate (character(room) :: bytes)
      used = 0
      do
         if (used == len(bytes, c_size_t)) then ! at the end, or larger than it was said to be
            got = c_fread(one_more, 1_c_size_t, 1_c_size_t, stream)
            if (got == 0) exit
            allocate (character(2*used) :: wider)
            wider(:used) = bytes
            wider(used + 1:used + 1) = one_more
            call move_alloc(wider, bytes)
            used = used + 1
         end if
         got = c_fread(bytes(used + 1:), 1_c_size_t, len(bytes, c_size_t) - used, stream)
         if (got == 0) exit
         used = used + got
      end do
      ok = c_ferror(stream) == 0
      status = c_fclose(stream)
      if (used < len(bytes, c_size_t)) bytes = bytes(:used)
   end subroutine read_all_bytes


   !> Create the file PATH, empty, for writing. DESCRIPTOR is below zero where that fails.
   subroutine create_file(path, descriptor)
      character(*), intent(in) :: path
      integer, intent(out)     :: descriptor
      integer(c_int), parameter :: read_and_write_for_all = int(o'666', c_int) ! less the user's mask

      descriptor = int(c_creat(path//c_null_char, read_and_write_for_all))
   end subroutine create_file


   !> Write all BYTES to DESCRIPTOR (1: the standard output). OK is false where some could not be written, as on a full disk:
   !! the operating system is asked itself, nothing waits in a buffer.
   subroutine write_bytes(descriptor, bytes, ok)
      integer, intent(in)      :: descriptor
      character(*), intent(in) :: bytes
      logical, intent(out)     :: ok
      integer(c_size_t) :: done, written

      done = 0
      ok = .true.
      do while (done < len(bytes, c_size_t))
         written = c_write(int(descriptor, c_int), bytes(done + 1:), len(bytes, c_size_t) - done)
         ok = written > 0
         if (.not. ok) return
         done = done + written
      end do
   end subroutine write_bytes


   !> Close DESCRIPTOR. OK is false where what was written did not all get there.
   subroutine close_file(descriptor, ok)
      integer, intent(in)  :: descriptor
      logical, intent(out) :: ok

      ok = c_close(int(descriptor, c_int)) == 0
   end subroutine close_file


   !> Give the file OLD the name NEW, in place of any file of that name. OK is false on failure.
   subroutine rename_file(old, new, ok)
      character(*), intent(in) :: old, new
      logical, intent(out)     :: ok

      ok = c_rename(old//c_null_char, new//c_null_char) == 0
   end subroutine rename_file


   !> Remove the file PATH where it is there.
   subroutine remove_file(path)
      character(*), intent(in) :: path

      call remove_terminated(path//c_null_char)
   end subroutine remove_file


   !> The same for a PATH that ends with a null character; takes no memory.
   subroutine remove_terminated(path)
      character(*), intent(in) :: path
      integer(c_int) :: status

      status = c_unlink(path)
      if (status /= 0) return   ! nothing of that name was there: as wanted
   end subroutine remove_terminated


   !> The absolute path of PATH with all links resolved; PATH itself where no such file is.
   function true_path(path) result(resolved)
      character(*), intent(in)  :: path
      character(:), allocatable :: resolved
      character(kind=c_char), pointer :: letters(:)
      type(c_ptr) :: text
      integer     :: i, length

      text = c_realpath(path//c_null_char, c_null_ptr)
      if (.not. c_associated(text)) then
         resolved = path
         return
      end if
      length = int(c_strlen(text))
      call c_f_pointer(text, letters, [length])
      allocate (character(length) :: resolved)
      do i = 1, length
         resolved(i:i) = letters(i)
      end do
      call c_free(text)
   end function true_path


   !> Whether the stream DESCRIPTOR (1 standard output, 2 standard error) is a terminal.
   function is_terminal(descriptor) result(answer)
      integer, intent(in) :: descriptor
      logical :: answer

      answer = c_isatty(int(descriptor, c_int)) /= 0
   end function is_terminal


   !> End the program with exit status STATUS and no further word on the terminal.
   subroutine end_run(status)
      integer, intent(in) :: status

      has_ended = .true.
      call c_exit(int(status, c_int))
   end subroutine end_run

end module c_library
