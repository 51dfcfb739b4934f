!> The few services of the C library that Fortran has no word for: reading and writing files by bytes with
!! every failure told, renaming and removing a file, its true path and whether it is one, and whether a stream is a terminal.
module c_library
   use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_int, c_int8_t, c_int16_t, c_intptr_t, c_null_char, c_ptr, c_size_t
   implicit none
   private

   public :: read_all_bytes, create_file, write_bytes, close_file, rename_file, remove_file, remove_terminated, &
             true_path, is_regular_file, is_terminal, tell_failed_writes, end_run

   logical, public, protected :: has_ended = .false. !! by end_run

   interface
      integer(c_int) function c_open(path, flags) bind(c, name='open')
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int), value :: flags
      end function c_open

      integer(c_int) function c_creat(path, mode) bind(c, name='creat')
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int), value :: mode
      end function c_creat

      !> What has been read, 0 at the end of the file, -1 on failure.
      integer(c_size_t) function c_read(descriptor, bytes, count) bind(c, name='read')
         import :: c_char, c_int, c_size_t
         integer(c_int), value               :: descriptor
         character(kind=c_char), intent(out) :: bytes(*)
         integer(c_size_t), value            :: count
      end function c_read

      !> What has been written, -1 on failure.
      integer(c_size_t) function c_write(descriptor, bytes, count) bind(c, name='write')
         import :: c_char, c_int, c_size_t
         integer(c_int), value              :: descriptor
         character(kind=c_char), intent(in) :: bytes(*)
         integer(c_size_t), value           :: count
      end function c_write

      integer(c_int) function c_close(descriptor) bind(c, name='close')
         import :: c_int
         integer(c_int), value :: descriptor
      end function c_close

      integer(c_int) function c_rename(old, new) bind(c, name='rename')
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: old(*), new(*)
      end function c_rename

      integer(c_int) function c_unlink(path) bind(c, name='unlink')
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: path(*)
      end function c_unlink

      type(c_ptr) function c_realpath(path, resolved) bind(c, name='realpath')
         import :: c_char, c_ptr
         character(kind=c_char), intent(in)  :: path(*)
         character(kind=c_char), intent(out) :: resolved(*)
      end function c_realpath

      !> What the file PATH of DIRECTORY is, 0 on success; the layout of STATUS is the same on every processor (man 2 statx).
      integer(c_int) function c_statx(directory, path, flags, mask, status) bind(c, name='statx')
         import :: c_char, c_int, c_int8_t
         integer(c_int), value              :: directory, flags, mask
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int8_t), intent(out)     :: status(256)
      end function c_statx

      !> What is done at SIGNAL from now on; gives what was done.
      integer(c_intptr_t) function c_signal(signal, handler) bind(c, name='signal')
         import :: c_int, c_intptr_t
         integer(c_int), value      :: signal
         integer(c_intptr_t), value :: handler
      end function c_signal

      integer(c_int) function c_isatty(descriptor) bind(c, name='isatty')
         import :: c_int
         integer(c_int), value :: descriptor
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
      integer(c_int), parameter    :: to_read = 0          ! O_RDONLY
      character(:), allocatable :: wider
      integer(c_size_t) :: used, got, room
      integer(c_int)    :: descriptor

      descriptor = c_open(path//c_null_char, to_read)
      ok = descriptor >= 0
      if (.not. ok) return
      inquire (file=path, size=room)
      if (room <= 0) room = first_room
      allocate (character(room + 1) :: bytes) ! one more than there are: the end shows at once
      used = 0
      do
         if (used == len(bytes, c_size_t)) then
            allocate (character(2*used) :: wider)
            wider(:used) = bytes
            call move_alloc(wider, bytes)
         end if
         got = c_read(descriptor, bytes(used + 1:), len(bytes, c_size_t) - used)
         if (got <= 0) exit
         used = used + got
      end do
      ok = c_close(descriptor) == 0 .and. got == 0
      bytes = bytes(:used)
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
      integer, parameter :: longest = 4096 ! PATH_MAX, the null character included
      character(longest) :: text

      resolved = path
      if (c_associated(c_realpath(path//c_null_char, text))) resolved = text(:index(text, c_null_char) - 1)
   end function true_path

   !> Whether PATH is a plain file, links followed: no folder, device or pipe.
   logical function is_regular_file(path)
      character(*), intent(in) :: path
      integer(c_int), parameter :: here = -100, follow_links = 0, kind_asked = 1              ! AT_FDCWD, STATX_TYPE
      integer, parameter :: kind_bits = int(o'170000'), regular = int(o'100000'), mode_at = 29 ! S_IFMT, S_IFREG, stx_mode
      integer(c_int8_t) :: status(256)

      is_regular_file = c_statx(here, path//c_null_char, follow_links, kind_asked, status) == 0
      if (is_regular_file) &
         is_regular_file = iand(int(transfer(status(mode_at:mode_at + 1), 0_c_int16_t)), kind_bits) == regular
   end function is_regular_file

   !> A write into a pipe that nobody reads, or beyond the size that files may have, fails from now on as one on a full disk does,
   !! and does not kill the program.
   subroutine tell_failed_writes()
      integer(c_int), parameter      :: signals(2) = [13, 25] ! SIGPIPE, SIGXFSZ of Linux
      integer(c_intptr_t), parameter :: ignore = 1            ! SIG_IGN
      integer(c_intptr_t) :: before
      integer :: i

      do i = 1, size(signals)
         before = c_signal(signals(i), ignore)
         if (before < 0) return ! SIG_ERR: it stays as it was
      end do
   end subroutine tell_failed_writes

   !> Whether the stream DESCRIPTOR (1 standard output, 2 standard error) is a terminal.
   logical function is_terminal(descriptor)
      integer, intent(in) :: descriptor

      is_terminal = c_isatty(int(descriptor, c_int)) /= 0
   end function is_terminal

   !> End the program with exit status STATUS and no further word on the terminal.
   subroutine end_run(status)
      integer, intent(in) :: status

      has_ended = .true.
      call c_exit(int(status, c_int))
   end subroutine end_run

end module c_library
