!> The layout of a restart file, and the state of a run as it passes through: whoever keeps something in it has one routine that
!! names its parts in their order, and the same routine writes them and reads them.
!!
!!     byte  1   'JOINTFEM RESTART'
!!          17   the number of the layout [4]
!!          21   16909060, which is 1, 2, 3, 4 byte by byte where the most significant comes first: tells the order of all bytes [4]
!!          25   the version of the program that wrote it [16 letters]
!!          41   the checksum of the deck with what it includes [8]
!!          49   the state: values one behind the other, each as the routine that names it says; between them marks, which are a
!!               text, so that a reader out of step is told at once
!!       n - 15  n, the bytes of the whole file [8]
!!        n - 7  the checksum of all before [8]
!!
!! Numbers are two's complement of 4 or 8 bytes and IEEE 754 of 8, truths a byte 0 or 1. An array of known size is its number of
!! values [8] and the values in Fortran's order; one that may have any size, or none, has its extents [8 each] before them, the
!! first -1 where it is not there. A text of any length is that length [8], -1: not there, and its letters. A file is its length [8]
!! and its bytes.
!!
!! A file that is read is whole and of this layout and program: open_restart has looked at its sums. What it says of lengths is
!! believed as far as there are bytes for it, and no further.
module restart_stream
   use c_library, only: close_file, open_file, read_bytes, write_bytes
   use checksum, only: add_to_checksum, no_bytes
   use, intrinsic :: iso_fortran_env, only: int32, int64
   use kinds, only: long, wp
   use text_tools, only: integer_text
   implicit none
   private

   public :: open_restart

   integer, parameter, public :: layout = 3 !! changes with every change of what is kept, or how
   character(*), parameter    :: magic = 'JOINTFEM RESTART'
   integer(int32), parameter  :: order_mark = int(z'01020304', int32)
   integer, parameter, public :: version_length = 16
   integer, parameter :: head_length = 48, tail_length = 16
   integer, parameter :: room = 1048576 ! bytes that are gathered before they are written

   type, public :: restart_stream_type
      logical :: writes = .false.                 !! else it reads
      logical :: swapped = .false.                !! the bytes of numbers stand in the other order
      character(:), allocatable :: fault          !! why it failed, in words; not allocated: it has not
      character(:), allocatable, private :: bytes ! reading: the file; writing: what is not written yet
      integer(long), private  :: used = 0         ! of these
      integer(long), private  :: last = 0         ! reading: byte before the tail
      integer(long), private  :: written = 0      ! bytes in the file
      integer(int64), private :: sum = no_bytes   ! of them
      integer, private        :: descriptor = -1
   contains
      procedure :: start
      procedure :: complete
      procedure :: is_at_end
      procedure :: mark
      procedure :: count
      procedure :: expect
      procedure :: file
      generic   :: item => integer_item, real_item, logical_item, text_item, integers_item, matrix_integers_item, reals_item, &
                           matrix_reals_item, logicals_item, matrix_logicals_item
      generic   :: list => text_list, integer_list, integer_matrix, real_list, real_matrix, logical_list
      procedure, private :: integer_item, real_item, logical_item, text_item, integers_item, matrix_integers_item, reals_item, &
                            matrix_reals_item, logicals_item, matrix_logicals_item
      procedure, private :: text_list, integer_list, integer_matrix, real_list, real_matrix, logical_list
   end type restart_stream_type

contains

   !> Write what comes to the open file DESCRIPTOR: by this VERSION of the program, for the deck with the checksum DECK.
   subroutine start(self, descriptor, version, deck)
      class(restart_stream_type), intent(inout) :: self
      integer, intent(in)                       :: descriptor
      character(*), intent(in)                  :: version
      integer(int64), intent(in)                :: deck
      character(version_length) :: words
      integer(int64) :: sum
      integer :: layout_now, mark_now

      self%writes = .true.
      self%descriptor = descriptor
      if (.not. allocated(self%bytes)) allocate (character(room) :: self%bytes)
      self%used = 0
      self%written = 0
      self%sum = no_bytes
      words = version
      sum = deck
      layout_now = layout
      mark_now = order_mark
      call put(self, magic)
      call self%item(layout_now)
      call self%item(mark_now)
      call put(self, words)
      call long_item(self, sum)
   end subroutine start

   !> All has been written: its end, and the last bytes go to the file. OK is false where anything failed.
   subroutine complete(self, ok)
      class(restart_stream_type), intent(inout) :: self
      logical, intent(out)                      :: ok
      integer(int64) :: n, sum

      n = self%written + self%used + tail_length
      call long_item(self, n)
      call flush_bytes(self)
      sum = self%sum
      call long_item(self, sum)
      call flush_bytes(self)
      ok = .not. allocated(self%fault)
   end subroutine complete

   !> Look whether BYTES are a restart file of this VERSION of the program for the deck with the checksum DECK: STREAM then reads
   !! the state in it. Else PROBLEM says what is wrong, '' where nothing is. BYTES are handed over.
   subroutine open_restart(bytes, version, deck, stream, problem)
      character(:), allocatable, intent(inout) :: bytes
      character(*), intent(in)                 :: version
      integer(int64), intent(in)               :: deck
      type(restart_stream_type), intent(out)   :: stream
      character(:), allocatable, intent(out)   :: problem
      character(version_length) :: of_version
      integer(int64) :: of_deck, n, sum, sum_now
      integer :: of_layout, order

      of_layout = 0
      order = 0
      of_deck = 0
      sum = 0
      problem = 'it is no restart file'
      n = len(bytes, long)
      if (n < len(magic)) return
      if (bytes(:len(magic)) /= magic) return
      problem = 'it is cut short'
      if (n < head_length + tail_length) return
      of_version = ''
      call move_alloc(bytes, stream%bytes)
      stream%used = len(magic)
      stream%last = n
      call stream%item(of_layout)
      call stream%item(order)
      stream%swapped = order /= order_mark
      if (stream%swapped) then
         stream%used = len(magic)
         call stream%item(of_layout)
         call stream%item(order)
         problem = 'it is damaged: its bytes are in no order'
         if (order /= order_mark) return
      end if
      stream%used = n - tail_length           ! every layout has the same tail: what is damaged is of no layout
      call long_item(stream, n)
      problem = 'it is damaged or cut: not as long as it says'
      if (n /= stream%last) return
      call long_item(stream, sum)
      sum_now = no_bytes
      call add_to_checksum(stream%bytes(:n - tail_length/2), sum_now)
      problem = 'it is damaged: its checksum is not that of its bytes'
      if (sum /= sum_now) return
      problem = 'it has layout '//integer_text(of_layout)//' of another version of the program, this one reads '// &
                integer_text(layout)
      if (of_layout /= layout) return
      stream%used = head_length - version_length - tail_length/2
      call stream%item(of_version)
      call long_item(stream, of_deck)
      problem = 'version '//trim(of_version)//' of the program wrote it, this one is '//version
      if (of_version /= version) return
      problem = 'it belongs to another deck, or the deck has been changed since'
      if (of_deck /= deck) return
      problem = ''
      stream%used = head_length
      stream%last = n - tail_length
   end subroutine open_restart

   !> Whether all of the state has been read, and nothing failed.
   pure logical function is_at_end(self)
      class(restart_stream_type), intent(in) :: self

      is_at_end = .not. allocated(self%fault) .and. self%used == self%last
   end function is_at_end

   !> A mark in the file: what follows is the state of NAME.
   subroutine mark(self, name)
      class(restart_stream_type), intent(inout) :: self
      character(*), intent(in)                  :: name
      character(len(name)) :: found

      found = name
      call self%item(found)
      if (found /= name) call fail(self, 'the state of '//name//' is not where it should be')
   end subroutine mark

   !> N things follow, each of at least BYTES_EACH; when it is read 0 where that many cannot.
   subroutine count(self, n, bytes_each)
      class(restart_stream_type), intent(inout) :: self
      integer, intent(inout)                    :: n
      integer, intent(in)                       :: bytes_each

      call self%item(n)
      if (self%writes) return
      if (n < 0 .or. n > (self%last - self%used)/bytes_each) call fail(self, 'more is to follow than there is')
      if (allocated(self%fault)) n = 0
   end subroutine count

   !> The bytes of a file: all of PATH when the state is written; when it is read they are written to DESCRIPTOR.
   subroutine file(self, path, descriptor)
      class(restart_stream_type), intent(inout) :: self
      character(*), intent(in)                  :: path
      integer, intent(in)                       :: descriptor
      integer(long) :: n
      logical :: ok

      if (self%writes) then
         call copy_file(self, path)
      else
         n = 0
         call long_item(self, n)
         if (n < 0 .or. n > self%last - self%used) call fail(self, 'a file is longer than there are bytes')
         if (allocated(self%fault)) return
         call write_bytes(descriptor, self%bytes(self%used + 1:self%used + n), ok)
         self%used = self%used + n
         if (.not. ok) call fail(self, path//' cannot be written')
      end if
   end subroutine file

   subroutine copy_file(self, path)
      class(restart_stream_type), intent(inout) :: self
      character(*), intent(in)                  :: path
      character(:), allocatable :: piece
      integer(long) :: n, left, got
      integer :: descriptor
      logical :: ok

      inquire (file=path, size=n)
      call open_file(path, descriptor)
      if (descriptor < 0) call fail(self, path//' cannot be read')
      if (allocated(self%fault)) return
      call long_item(self, n)
      allocate (character(room/4) :: piece)
      left = n
      do while (left > 0)
         call read_bytes(descriptor, piece, got)
         if (got <= 0 .or. got > left) exit
         call put(self, piece(:got))
         left = left - got
      end do
      if (left /= 0) call fail(self, path//' cannot be read')
      call close_file(descriptor, ok)
   end subroutine copy_file

   ! ---- values of known number ----

   subroutine integer_item(self, value)
      class(restart_stream_type), intent(inout) :: self
      integer, intent(inout)               :: value
      integer :: values(1)

      values = value
      call move_integers(self, 1_long, values)
      value = values(1)
   end subroutine integer_item

   subroutine real_item(self, value)
      class(restart_stream_type), intent(inout) :: self
      real(wp), intent(inout)              :: value
      real(wp) :: values(1)

      values = value
      call move_reals(self, 1_long, values)
      value = values(1)
   end subroutine real_item

   subroutine logical_item(self, value)
      class(restart_stream_type), intent(inout) :: self
      logical, intent(inout)               :: value
      logical :: values(1)

      values = value
      call move_logicals(self, 1_long, values)
      value = values(1)
   end subroutine logical_item

   subroutine long_item(self, value)
      class(restart_stream_type), intent(inout) :: self
      integer(int64), intent(inout)             :: value
      character(8) :: piece

      piece = transfer(value, piece)
      call move_bytes(self, 8, piece)
      value = transfer(piece, value)
   end subroutine long_item

   subroutine text_item(self, value)
      class(restart_stream_type), intent(inout) :: self
      character(*), intent(inout)               :: value

      call move_bytes(self, 1, value)
   end subroutine text_item

   subroutine integers_item(self, values)
      class(restart_stream_type), intent(inout) :: self
      integer, intent(inout)               :: values(:)

      call check_number(self, size(values, kind=long))
      call move_integers(self, size(values, kind=long), values)
   end subroutine integers_item

   subroutine matrix_integers_item(self, values)
      class(restart_stream_type), intent(inout) :: self
      integer, intent(inout)               :: values(:, :)

      call check_number(self, size(values, kind=long))
      call move_integers(self, size(values, kind=long), values)
   end subroutine matrix_integers_item

   subroutine reals_item(self, values)
      class(restart_stream_type), intent(inout) :: self
      real(wp), intent(inout)              :: values(:)

      call check_number(self, size(values, kind=long))
      call move_reals(self, size(values, kind=long), values)
   end subroutine reals_item

   subroutine matrix_reals_item(self, values)
      class(restart_stream_type), intent(inout) :: self
      real(wp), intent(inout)              :: values(:, :)

      call check_number(self, size(values, kind=long))
      call move_reals(self, size(values, kind=long), values)
   end subroutine matrix_reals_item

   subroutine logicals_item(self, values)
      class(restart_stream_type), intent(inout) :: self
      logical, intent(inout)               :: values(:)

      call check_number(self, size(values, kind=long))
      call move_logicals(self, size(values, kind=long), values)
   end subroutine logicals_item

   subroutine matrix_logicals_item(self, values)
      class(restart_stream_type), intent(inout) :: self
      logical, intent(inout)               :: values(:, :)

      call check_number(self, size(values, kind=long))
      call move_logicals(self, size(values, kind=long), values)
   end subroutine matrix_logicals_item

   !> N things stand here, and no other number.
   subroutine expect(self, n)
      class(restart_stream_type), intent(inout) :: self
      integer, intent(in)                       :: n

      call check_number(self, int(n, long))
   end subroutine expect

   subroutine check_number(self, n)
      class(restart_stream_type), intent(inout) :: self
      integer(long), intent(in)                 :: n
      integer(int64) :: found

      found = n
      call long_item(self, found)
      if (found /= n) call fail(self, 'an array has another size than the model asks for')
   end subroutine check_number

   ! ---- values of any number, or none ----

   subroutine text_list(self, value)
      class(restart_stream_type), intent(inout) :: self
      character(:), allocatable, intent(inout)  :: value
      integer :: extents(1)

      extents = -1
      if (allocated(value)) extents = len(value)
      call move_extents(self, extents, 1)
      if (.not. self%writes) then
         if (allocated(value)) deallocate (value)
         if (extents(1) >= 0) allocate (character(extents(1)) :: value)
      end if
      if (allocated(value)) call move_bytes(self, 1, value)
   end subroutine text_list

   subroutine integer_list(self, values)
      class(restart_stream_type), intent(inout) :: self
      integer, allocatable, intent(inout)  :: values(:)
      integer :: extents(1)

      extents = -1
      if (allocated(values)) extents = shape(values)
      call move_extents(self, extents, 4)
      if (.not. self%writes) then
         if (allocated(values)) deallocate (values)
         if (extents(1) >= 0) allocate (values(extents(1)))
      end if
      if (allocated(values)) call move_integers(self, size(values, kind=long), values)
   end subroutine integer_list

   subroutine integer_matrix(self, values)
      class(restart_stream_type), intent(inout) :: self
      integer, allocatable, intent(inout)  :: values(:, :)
      integer :: extents(2)

      extents = -1
      if (allocated(values)) extents = shape(values)
      call move_extents(self, extents, 4)
      if (.not. self%writes) then
         if (allocated(values)) deallocate (values)
         if (extents(1) >= 0) allocate (values(extents(1), extents(2)))
      end if
      if (allocated(values)) call move_integers(self, size(values, kind=long), values)
   end subroutine integer_matrix

   subroutine real_list(self, values)
      class(restart_stream_type), intent(inout) :: self
      real(wp), allocatable, intent(inout) :: values(:)
      integer :: extents(1)

      extents = -1
      if (allocated(values)) extents = shape(values)
      call move_extents(self, extents, 8)
      if (.not. self%writes) then
         if (allocated(values)) deallocate (values)
         if (extents(1) >= 0) allocate (values(extents(1)))
      end if
      if (allocated(values)) call move_reals(self, size(values, kind=long), values)
   end subroutine real_list

   subroutine real_matrix(self, values)
      class(restart_stream_type), intent(inout) :: self
      real(wp), allocatable, intent(inout) :: values(:, :)
      integer :: extents(2)

      extents = -1
      if (allocated(values)) extents = shape(values)
      call move_extents(self, extents, 8)
      if (.not. self%writes) then
         if (allocated(values)) deallocate (values)
         if (extents(1) >= 0) allocate (values(extents(1), extents(2)))
      end if
      if (allocated(values)) call move_reals(self, size(values, kind=long), values)
   end subroutine real_matrix

   subroutine logical_list(self, values)
      class(restart_stream_type), intent(inout) :: self
      logical, allocatable, intent(inout)  :: values(:)
      integer :: extents(1)

      extents = -1
      if (allocated(values)) extents = shape(values)
      call move_extents(self, extents, 1)
      if (.not. self%writes) then
         if (allocated(values)) deallocate (values)
         if (extents(1) >= 0) allocate (values(extents(1)))
      end if
      if (allocated(values)) call move_logicals(self, size(values, kind=long), values)
   end subroutine logical_list

   !> EXTENTS of values of WIDTH bytes that follow, the first -1: there are none. Where they cannot be there, they have none.
   subroutine move_extents(self, extents, width)
      class(restart_stream_type), intent(inout) :: self
      integer, intent(inout)                    :: extents(:)
      integer, intent(in)                       :: width
      integer(int64) :: extent
      integer(long)  :: most, together
      integer :: k

      together = 1
      do k = 1, size(extents)
         extent = extents(k)
         call long_item(self, extent)
         most = huge(0)
         if (.not. self%writes) most = min(most, (self%last - self%used)/(width*together))
         if (extent < merge(-1, 0, k == 1) .or. extent > most) call fail(self, 'an array is longer than there are bytes')
         if (allocated(self%fault)) extent = 0
         together = together*max(1_long, extent)
         extents(k) = int(extent)
         if (extents(1) < 0) exit
      end do
      if (allocated(self%fault)) extents = 0
   end subroutine move_extents

   ! ---- bytes ----

   subroutine move_integers(self, n, values)
      class(restart_stream_type), intent(inout) :: self
      integer(long), intent(in)                 :: n
      integer, intent(inout)                    :: values(n)
      integer, parameter :: most = 1024
      character(4*most) :: piece
      integer(long) :: k, m

      do k = 0, n - 1, most
         m = min(n - k, int(most, long))
         if (self%writes) piece(:4*m) = transfer(values(k + 1:k + m), piece(:4*m))
         call move_bytes(self, 4, piece(:4*m))
         if (.not. self%writes) values(k + 1:k + m) = transfer(piece(:4*m), 0, m)
      end do
   end subroutine move_integers

   subroutine move_reals(self, n, values)
      class(restart_stream_type), intent(inout) :: self
      integer(long), intent(in)                 :: n
      real(wp), intent(inout)                   :: values(n)
      integer, parameter :: most = 512
      character(8*most) :: piece
      integer(long) :: k, m

      do k = 0, n - 1, most
         m = min(n - k, int(most, long))
         if (self%writes) piece(:8*m) = transfer(values(k + 1:k + m), piece(:8*m))
         call move_bytes(self, 8, piece(:8*m))
         if (.not. self%writes) values(k + 1:k + m) = transfer(piece(:8*m), 0.0_wp, m)
      end do
   end subroutine move_reals

   subroutine move_logicals(self, n, values)
      class(restart_stream_type), intent(inout) :: self
      integer(long), intent(in)                 :: n
      logical, intent(inout)                    :: values(n)
      character(1)  :: byte
      integer(long) :: k

      do k = 1, n
         byte = achar(0)
         if (self%writes) byte = achar(merge(1, 0, values(k)))
         call move_bytes(self, 1, byte)
         values(k) = byte == achar(1)
         if (iachar(byte) > 1) call fail(self, 'what should be true or false is neither')
      end do
   end subroutine move_logicals

   !> Write the BYTES of values of WIDTH, or read them; zeros where that fails.
   subroutine move_bytes(self, width, bytes)
      class(restart_stream_type), intent(inout) :: self
      integer, intent(in)                       :: width
      character(*), intent(inout)               :: bytes
      integer(long) :: n

      if (self%writes) then
         if (self%swapped) call swap(width, bytes)
         call put(self, bytes)
         if (self%swapped) call swap(width, bytes)
         return
      end if
      n = len(bytes, long)
      if (n > self%last - self%used) call fail(self, 'the state ends too early')
      if (allocated(self%fault)) then
         bytes = repeat(achar(0), len(bytes))
         return
      end if
      bytes = self%bytes(self%used + 1:self%used + n)
      self%used = self%used + n
      if (self%swapped) call swap(width, bytes)
   end subroutine move_bytes

   !> Turn the order of the BYTES of every value of WIDTH.
   pure subroutine swap(width, bytes)
      integer, intent(in)         :: width
      character(*), intent(inout) :: bytes
      character(width) :: value
      integer(long)    :: k
      integer          :: i

      do k = 0, len(bytes, long) - width, width
         value = bytes(k + 1:k + width)
         do i = 1, width
            bytes(k + i:k + i) = value(width + 1 - i:width + 1 - i)
         end do
      end do
   end subroutine swap

   subroutine put(self, bytes)
      class(restart_stream_type), intent(inout) :: self
      character(*), intent(in)                  :: bytes
      integer(long) :: done, n

      done = 0
      do while (done < len(bytes, long))
         if (self%used == len(self%bytes, long)) call flush_bytes(self)
         n = min(len(bytes, long) - done, len(self%bytes, long) - self%used)
         self%bytes(self%used + 1:self%used + n) = bytes(done + 1:done + n)
         self%used = self%used + n
         done = done + n
      end do
   end subroutine put

   subroutine flush_bytes(self)
      class(restart_stream_type), intent(inout) :: self
      logical :: ok

      if (allocated(self%fault)) then
         self%used = 0
         return
      end if
      call add_to_checksum(self%bytes(:self%used), self%sum)
      call write_bytes(self%descriptor, self%bytes(:self%used), ok)
      self%written = self%written + self%used
      self%used = 0
      if (.not. ok) call fail(self, 'it cannot be written')
   end subroutine flush_bytes

   !> The first word counts.
   subroutine fail(self, words)
      class(restart_stream_type), intent(inout) :: self
      character(*), intent(in)                  :: words

      if (.not. allocated(self%fault)) self%fault = words
   end subroutine fail

end module restart_stream
