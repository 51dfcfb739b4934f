!> Declares the services of the C library that Fortran lacks: files by bytes, paths, signals and terminals.
!! Files are read and written with every failure reported, renamed, removed and identified.
module c_library
   use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_funptr, c_int, c_int8_t, c_int16_t, c_int64_t, c_intptr_t, &
                                          c_null_char, c_null_funptr, c_ptr, c_size_t
   implicit none
   private

   public :: open_standard_outputs, read_all_bytes, create_unique, open_to_write, write_bytes, close_file, rename_file, &
             remove_file, make_folders, true_path, kind_of_file, is_regular_file, is_same_file, tell_failed_writes, at_signals, &
             lock_folder, end_run, go_to_byte, append_bytes, c_fsync, c_isatty, c_raise, c_rename, c_truncate, c_unlink, c_usleep

   !> Kinds of file that a path may lead to.
   integer, parameter, public :: no_file = 0, pipe_file = 1, device_file = 2, folder_file = 4, block_file = 6, regular_file = 8, &
                                 link_file = 10, socket_file = 12 !! S_IFMT of Linux, by 4096

   integer(c_int), parameter :: to_read = 0, to_write = 1, to_append = 1025 ! O_RDONLY, O_WRONLY, O_APPEND of open
   integer(c_intptr_t), parameter :: ignored = 1          ! SIG_IGN

   logical, public, protected :: has_ended = .false. !! set by end_run

   interface
      integer(c_int) function c_open(path, flags) bind(c, name='open')
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int), value :: flags
      end function c_open

      !> Creates a new file with a unique name: replaces the six X of TEMPLATE before its last LETTERS_BEHIND letters.
      integer(c_int) function c_mkstemps(template, letters_behind) bind(c, name='mkstemps')
         import :: c_char, c_int
         character(kind=c_char), intent(inout) :: template(*)
         integer(c_int), value :: letters_behind
      end function c_mkstemps

      integer(c_int) function c_fchmod(descriptor, mode) bind(c, name='fchmod')
         import :: c_int
         integer(c_int), value :: descriptor, mode
      end function c_fchmod

      integer(c_int) function c_umask(mask) bind(c, name='umask')
         import :: c_int
         integer(c_int), value :: mask
      end function c_umask

      !> Number of bytes read, 0 at the end of the file, -1 on failure.
      integer(c_size_t) function c_read(descriptor, bytes, count) bind(c, name='read')
         import :: c_char, c_int, c_size_t
         integer(c_int), value               :: descriptor
         character(kind=c_char), intent(out) :: bytes(*)
         integer(c_size_t), value            :: count
      end function c_read

      !> Number of bytes written, -1 on failure.
      integer(c_size_t) function c_write(descriptor, bytes, count) bind(c, name='write')
         import :: c_char, c_int, c_size_t
         integer(c_int), value              :: descriptor
         character(kind=c_char), intent(in) :: bytes(*)
         integer(c_size_t), value           :: count
      end function c_write

      !> Forces the bytes written to DESCRIPTOR from memory to the disk; 0 on success.
      integer(c_int) function c_fsync(descriptor) bind(c, name='fsync')
         import :: c_int
         integer(c_int), value :: descriptor
      end function c_fsync

      !> Moves the place of the next write to byte OFFSET behind the start (WHENCE 0) or the present place (1); gives that place.
      integer(c_int64_t) function c_lseek(descriptor, offset, whence) bind(c, name='lseek64')
         import :: c_int, c_int64_t
         integer(c_int), value     :: descriptor, whence
         integer(c_int64_t), value :: offset
      end function c_lseek

      !> Shortens the file PATH, which ends with a null character, to LENGTH bytes; needs no memory.
      integer(c_int) function c_truncate(path, length) bind(c, name='truncate64')
         import :: c_char, c_int, c_int64_t
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int64_t), value          :: length
      end function c_truncate

      integer(c_int) function c_close(descriptor) bind(c, name='close')
         import :: c_int
         integer(c_int), value :: descriptor
      end function c_close

      integer(c_int) function c_mkdir(path, mode) bind(c, name='mkdir')
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int), value :: mode
      end function c_mkdir

      integer(c_int) function c_rename(old, new) bind(c, name='rename')
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: old(*), new(*)
      end function c_rename

      !> Removes the file PATH, which ends with a null character; needs no memory.
      integer(c_int) function c_unlink(path) bind(c, name='unlink')
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: path(*)
      end function c_unlink

      type(c_ptr) function c_realpath(path, resolved) bind(c, name='realpath')
         import :: c_char, c_ptr
         character(kind=c_char), intent(in)  :: path(*)
         character(kind=c_char), intent(out) :: resolved(*)
      end function c_realpath

      !> Status of the file PATH in DIRECTORY; 0 on success. The layout of STATUS is the same on every processor (man 2 statx).
      integer(c_int) function c_statx(directory, path, flags, mask, status) bind(c, name='statx')
         import :: c_char, c_int, c_int8_t
         integer(c_int), value              :: directory, flags, mask
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int8_t), intent(out)     :: status(256)
      end function c_statx

      !> Set the action at SIGNAL; gives the previous action.
      integer(c_intptr_t) function c_signal(signal, handler) bind(c, name='signal')
         import :: c_funptr, c_int, c_intptr_t
         integer(c_int), value :: signal
         type(c_funptr), value :: handler
      end function c_signal

      integer(c_int) function c_raise(signal) bind(c, name='raise')
         import :: c_int
         integer(c_int), value :: signal
      end function c_raise

      integer(c_int) function c_flock(descriptor, operation) bind(c, name='flock')
         import :: c_int
         integer(c_int), value :: descriptor, operation
      end function c_flock

      integer(c_int) function c_usleep(microseconds) bind(c, name='usleep')
         import :: c_int
         integer(c_int), value :: microseconds
      end function c_usleep

      !> 1 where DESCRIPTOR (1 standard output, 2 standard error) is a terminal, otherwise 0.
      integer(c_int) function c_isatty(descriptor) bind(c, name='isatty')
         import :: c_int
         integer(c_int), value :: descriptor
      end function c_isatty
   end interface

contains

   !> All bytes of PATH: a plain file, a pipe or the standard input.
   !! OK is false where PATH cannot be opened or read (a directory opens, but does not read).
   subroutine read_all_bytes(path, bytes, ok)
      character(*), intent(in)               :: path
      character(:), allocatable, intent(out) :: bytes
      logical, intent(out)                   :: ok
      integer(c_size_t), parameter :: first_room = 1048576 ! where the size of the file is unknown
      character(:), allocatable :: wider
      character(1)      :: next
      integer(c_size_t) :: used, got, room
      integer(c_int)    :: descriptor
      logical           :: endless

      descriptor = c_open(path//c_null_char, to_read)
      ok = descriptor >= 0
      if (.not. ok) return
      endless = .not. is_regular_file(path)
      inquire (file=path, size=room)
      if (room <= 0) room = first_room
      allocate (character(room) :: bytes) ! exact for a file: a long deck is not copied
      used = 0
      do
         if (used == len(bytes, c_size_t)) then
            got = c_read(descriptor, next, 1_c_size_t)
            if (got <= 0) exit
            allocate (character(2*used) :: wider)
            wider(:used) = bytes
            wider(used + 1:used + 1) = next
            call move_alloc(wider, bytes)
            used = used + 1
         end if
         got = c_read(descriptor, bytes(used + 1:), len(bytes, c_size_t) - used)
         if (got <= 0) exit
         used = used + got
         if (endless) then ! a device such as /dev/zero has no end; bytes that are not text end the reading
            if (index(bytes(:used), c_null_char) > 0) got = 0
            if (got == 0) exit
         end if
      end do
      ok = c_close(descriptor) == 0 .and. got == 0
      if (used < len(bytes, c_size_t)) bytes = bytes(:used)
   end subroutine read_all_bytes

   !> Create a new file NAME, a dot, six letters, ENDING for writing, and give its PATH. No link, pipe or device can wait under
   !! this name, and no other run has the file. DESCRIPTOR is negative on failure.
   subroutine create_unique(name, ending, path, descriptor)
      character(*), intent(in)               :: name, ending
      character(:), allocatable, intent(out) :: path
      integer, intent(out)                   :: descriptor
      integer(c_int), parameter :: read_and_write_for_all = int(o'666', c_int) ! less the user's mask
      integer(c_int) :: mask, status

      path = name//'.XXXXXX'//ending//c_null_char
      descriptor = int(c_mkstemps(path, len(ending, c_int)))
      path = path(:len(path) - 1)
      if (descriptor < 0) return
      mask = c_umask(0_c_int) ! umask can only be asked by setting it
      status = c_umask(mask)
      status = c_fchmod(int(descriptor, c_int), iand(read_and_write_for_all, not(mask)))
      if (status /= 0) return   ! a file system without modes is no error
   end subroutine create_unique

   !> Open the existing file PATH for writing from its beginning. DESCRIPTOR is negative on failure.
   subroutine open_to_write(path, descriptor)
      character(*), intent(in) :: path
      integer, intent(out)     :: descriptor

      descriptor = int(c_open(path//c_null_char, to_write))
   end subroutine open_to_write

   !> Write all BYTES to DESCRIPTOR (1: the standard output) without a buffer. OK is false where some bytes could not be written,
   !! as on a full disk.
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

   !> Write BYTES behind the last byte of the existing file PATH, which ends with a null character; needs no memory.
   subroutine append_bytes(path, bytes, ok)
      character(*), intent(in) :: path, bytes
      logical, intent(out)     :: ok
      integer(c_int) :: descriptor

      descriptor = c_open(path, to_append)
      ok = descriptor >= 0
      if (ok) call write_bytes(int(descriptor), bytes, ok)
      if (descriptor >= 0) ok = c_close(descriptor) == 0 .and. ok
   end subroutine append_bytes

   !> The number of bytes before the next write to DESCRIPTOR; with LENGTH the next write is behind so many. Negative on failure.
   integer(c_int64_t) function go_to_byte(descriptor, length) result(place)
      integer, intent(in)                      :: descriptor
      integer(c_int64_t), intent(in), optional :: length

      if (present(length)) place = c_lseek(int(descriptor, c_int), length, 0_c_int)
      if (.not. present(length)) place = c_lseek(int(descriptor, c_int), 0_c_int64_t, 1_c_int)
   end function go_to_byte

   !> Close DESCRIPTOR. OK is false where written bytes were lost.
   subroutine close_file(descriptor, ok)
      integer, intent(in)  :: descriptor
      logical, intent(out) :: ok

      ok = c_close(int(descriptor, c_int)) == 0
   end subroutine close_file

   !> A closed standard output gets a descriptor that cannot be written. Otherwise a result file would get its number, and the
   !! screen lines with it. A closed standard input stays closed: it cannot be read.
   subroutine open_standard_outputs()
      integer(c_int) :: descriptor, status
      logical :: input_is_closed

      input_is_closed = .false.
      do
         descriptor = c_open('/dev/null'//c_null_char, to_read)
         if (descriptor == 0) input_is_closed = .true.
         if (descriptor < 0 .or. descriptor > 2) exit
      end do
      if (descriptor > 2) status = c_close(descriptor)
      if (input_is_closed) status = c_close(0_c_int)
   end subroutine open_standard_outputs

   !> Give the file OLD the name NEW, in place of any file of that name. OK is false on failure.
   subroutine rename_file(old, new, ok)
      character(*), intent(in) :: old, new
      logical, intent(out)     :: ok

      ok = c_rename(old//c_null_char, new//c_null_char) == 0
   end subroutine rename_file

   !> Make the folders of PATH, which ends with a slash, where there is nothing of their names.
   subroutine make_folders(path)
      character(*), intent(in) :: path
      integer(c_int), parameter :: all_may = int(o'777', c_int) ! less the user's mask
      integer(c_int) :: status
      integer :: k

      do k = 2, len(path)
         if (path(k:k) /= '/') cycle
         if (kind_of_file(path(:k - 1)) == no_file) status = c_mkdir(path(:k - 1)//c_null_char, all_may)
      end do
   end subroutine make_folders

   !> Remove the file PATH if it exists.
   subroutine remove_file(path)
      character(*), intent(in) :: path
      integer(c_int) :: status

      status = c_unlink(path//c_null_char)
      if (status /= 0) return   ! there was no such file
   end subroutine remove_file

   !> The absolute path of PATH with all links resolved; PATH itself where there is no such file.
   function true_path(path) result(resolved)
      character(*), intent(in)  :: path
      character(:), allocatable :: resolved
      integer, parameter :: longest = 4096 ! PATH_MAX, the null character included
      character(longest) :: text

      resolved = path
      if (c_associated(c_realpath(path//c_null_char, text))) resolved = text(:index(text, c_null_char) - 1)
   end function true_path

   !> The kind of file at PATH, links followed; no_file where it leads nowhere.
   integer function kind_of_file(path) result(kind)
      character(*), intent(in) :: path
      integer(c_int), parameter :: here = -100, follow_links = 0, kind_asked = 1 ! AT_FDCWD, STATX_TYPE
      integer, parameter :: mode_at = 29                                        ! of stx_mode
      integer(c_int8_t) :: status(256)

      kind = no_file
      if (c_statx(here, path//c_null_char, follow_links, kind_asked, status) /= 0) return
      kind = ibits(int(transfer(status(mode_at:mode_at + 1), 0_c_int16_t)), 12, 4)
   end function kind_of_file

   !> Whether PATH is a plain file, links followed: not a folder, device or pipe.
   logical function is_regular_file(path)
      character(*), intent(in) :: path

      is_regular_file = kind_of_file(path) == regular_file
   end function is_regular_file

   !> Whether the paths A and B lead to one plain file, by symbolic or hard links.
   logical function is_same_file(a, b)
      character(*), intent(in) :: a, b
      integer(c_int), parameter :: here = -100, follow_links = 0, number_asked = 256 ! AT_FDCWD, STATX_INO
      integer(c_int8_t) :: status_a(256), status_b(256)

      is_same_file = .false.
      if (.not. is_regular_file(a)) return
      if (c_statx(here, a//c_null_char, follow_links, number_asked, status_a) /= 0) return
      if (c_statx(here, b//c_null_char, follow_links, number_asked, status_b) /= 0) return
      is_same_file = all(status_a(33:40) == status_b(33:40)) .and. all(status_a(137:144) == status_b(137:144)) ! stx_ino, stx_dev
   end function is_same_file

   !> A write into a pipe without a reader, or beyond the limit on file size, fails from now on as on a full disk and does not
   !! kill the program.
   subroutine tell_failed_writes()
      call at_signals([13, 25], transfer(ignored, c_null_funptr)) ! SIGPIPE, SIGXFSZ of Linux
   end subroutine tell_failed_writes

   !> HANDLER is called with the number of the signal at any of these SIGNALS. An ignored signal (nohup) stays ignored.
   subroutine at_signals(signals, handler)
      integer(c_int), intent(in) :: signals(:)
      type(c_funptr), value      :: handler !! of a subroutine with one integer(c_int) by value
      integer(c_intptr_t) :: before
      integer :: i

      do i = 1, size(signals)
         before = c_signal(signals(i), handler)
         if (before == ignored) before = c_signal(signals(i), transfer(ignored, handler))
      end do
   end subroutine at_signals

   !> Wait a limited time until no other run holds the FOLDER, and hold it until DESCRIPTOR is closed.
   subroutine lock_folder(folder, descriptor)
      character(*), intent(in) :: folder
      integer, intent(out)     :: descriptor
      integer(c_int), parameter :: alone = 2 + 4 ! LOCK_EX, LOCK_NB
      integer, parameter        :: tries = 200   ! of 50 ms
      integer(c_int) :: status
      integer :: i

      descriptor = int(c_open(folder//c_null_char, to_read))
      do i = 1, tries
         if (descriptor < 0) return
         if (c_flock(int(descriptor, c_int), alone) == 0) return
         status = c_usleep(50000_c_int)
         if (status /= 0) cycle ! a signal interrupted the wait: try again at once
      end do
   end subroutine lock_folder

   !> End the program with exit status STATUS and without further output on the terminal.
   subroutine end_run(status)
      integer, intent(in) :: status

      has_ended = .true.
      stop status, quiet=.true.
   end subroutine end_run

end module c_library
