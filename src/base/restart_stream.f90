!> Defines the layout of a restart file, and writes or reads the state of a run through it.
!! A module with state in the file has one routine that names its parts in order. The same routine writes and reads them.
!!
!!     byte  1   'JOINTFEM RESTART'
!!          17   the number of the layout [4]
!!          21   16909060, which is 1, 2, 3, 4 byte by byte where the most significant comes first [4]
!!          25   the version of the program that wrote it [16 letters]
!!          41   the checksum of the deck with its INCLUDE files [8]
!!          49   the state: blocks of memory one behind the other, each with the number of its bytes before it [8]
!!       n - 15  n, the bytes of the whole file [8]
!!        n - 7  the checksum of all before [8]
!!
!! An array of any size, or one that may be unallocated, has its extent before it [4], -1: unallocated. Types that pass as blocks have
!! no allocatable components and no padding: a filler component stands where padding would be.
!!
!! open_restart checks that a file is whole and of this layout, program and order of bytes. A length in the file is accepted only as
!! far as there are bytes for it.
!!
!! The checksum is CRC-64 as in the xz format. It detects every damage within 64 consecutive bits, and any other damage but with a
!! probability of 2**-64.
!! Source: ECMA-182, annex B (polynomial), in the reflected form of the .xz file format 1.1.0, section 6; the sum of '123456789'
!! is 995DC9BBDF1939FA.
module restart_stream
   use, intrinsic :: iso_c_binding, only: c_f_pointer, c_loc
   use c_library, only: read_all_bytes, write_bytes
   use, intrinsic :: iso_fortran_env, only: int32, int64
   use kinds, only: long
   use text_tools, only: integer_text
   implicit none
   private

   public :: open_restart, add_to_checksum

   integer, parameter, public :: layout = 8 !! changes with the layout and with its contents
   character(*), parameter    :: magic = 'JOINTFEM RESTART'
   integer(int32), parameter  :: order_mark = int(z'01020304', int32), other_order = int(z'04030201', int32)
   integer, parameter, public :: version_length = 16
   integer, parameter :: head_length = 48, tail_length = 16
   character(8), parameter :: eight_letters = ''
   integer(int64), parameter, public :: no_bytes = 0_int64 !! the checksum of no bytes, the start value

   type, public :: restart_stream_type
      logical :: writes = .false.                 !! false: it reads
      character(:), allocatable :: fault          !! why it failed; not allocated: it has not failed
      character(:), allocatable, private :: bytes ! reading: the file
      integer(long), private  :: used = 0         ! bytes read or written so far
      integer(long), private  :: last = 0         ! reading: the last byte before the tail
      integer(int64), private :: sum = no_bytes   ! checksum of the bytes written
      integer, private        :: descriptor = -1
   contains
      procedure :: start
      procedure :: complete
      procedure :: is_at_end
      procedure :: item
      procedure :: text
      procedure :: any_text
      procedure :: extent
      procedure :: file
   end type restart_stream_type

   integer :: i
   integer(int64), parameter :: polynomial = ior(shiftl(int(z'C96C5795', int64), 32), int(z'D7870F42', int64))

   ! the remainder of each byte after eight shifts
   integer(int64), parameter :: t0(0:255) = [(int(i, int64), i = 0, 255)]
   integer(int64), parameter :: t1(0:255) = ieor(shiftr(t0, 1), iand(t0, 1_int64)*polynomial)
   integer(int64), parameter :: t2(0:255) = ieor(shiftr(t1, 1), iand(t1, 1_int64)*polynomial)
   integer(int64), parameter :: t3(0:255) = ieor(shiftr(t2, 1), iand(t2, 1_int64)*polynomial)
   integer(int64), parameter :: t4(0:255) = ieor(shiftr(t3, 1), iand(t3, 1_int64)*polynomial)
   integer(int64), parameter :: t5(0:255) = ieor(shiftr(t4, 1), iand(t4, 1_int64)*polynomial)
   integer(int64), parameter :: t6(0:255) = ieor(shiftr(t5, 1), iand(t5, 1_int64)*polynomial)
   integer(int64), parameter :: t7(0:255) = ieor(shiftr(t6, 1), iand(t6, 1_int64)*polynomial)
   integer(int64), parameter :: table(0:255) = ieor(shiftr(t7, 1), iand(t7, 1_int64)*polynomial)

contains

   !> Begin a restart file on the open DESCRIPTOR: by this VERSION of the program, for the deck with the checksum DECK.
   subroutine start(self, descriptor, version, deck)
      class(restart_stream_type), intent(out) :: self
      integer, intent(in)                     :: descriptor
      character(*), intent(in)                :: version
      integer(int64), intent(in)              :: deck
      character(version_length) :: words

      self%writes = .true.
      self%descriptor = descriptor
      words = version
      call put(self, magic//transfer([int(layout, int32), order_mark], eight_letters)//words//transfer(deck, eight_letters))
   end subroutine start

   !> Write the tail of the file. OK is false where anything failed.
   subroutine complete(self, ok)
      class(restart_stream_type), intent(inout) :: self
      logical, intent(out)                      :: ok
      integer(int64) :: sum

      call put(self, transfer(self%used + tail_length, eight_letters))
      sum = self%sum
      call put(self, transfer(sum, eight_letters))
      ok = .not. allocated(self%fault)
   end subroutine complete

   !> Check that BYTES are a restart file of this VERSION of the program for the deck with the checksum DECK. STREAM then reads its
   !! state. PROBLEM is the error, '' where there is none. BYTES are handed over.
   subroutine open_restart(bytes, version, deck, stream, problem)
      character(:), allocatable, intent(inout) :: bytes
      character(*), intent(in)                 :: version
      integer(int64), intent(in)               :: deck
      type(restart_stream_type), intent(out)   :: stream
      character(:), allocatable, intent(out)   :: problem
      integer(int64) :: n, sum
      integer(int32) :: of_layout, order

      problem = 'it is not a restart file'
      n = len(bytes, long)
      if (n < len(magic)) return
      if (bytes(:len(magic)) /= magic) return
      problem = 'it is truncated'
      if (n < head_length + tail_length) return
      order = transfer(bytes(21:24), order)
      problem = 'it was written on a machine with another byte order'
      if (order == other_order) return
      problem = 'it is damaged: its byte order is unknown'
      if (order /= order_mark) return
      problem = 'it is damaged or truncated: its length is wrong' ! the tail is common to all layouts
      if (transfer(bytes(n - 15:n - 8), n) /= n) return
      sum = no_bytes
      call add_to_checksum(bytes(:n - 8), sum)
      problem = 'it is damaged: its checksum is wrong'
      if (transfer(bytes(n - 7:), sum) /= sum) return
      of_layout = transfer(bytes(17:20), of_layout)
      problem = 'it has layout '//integer_text(int(of_layout))//' of another version of the program, this one reads '// &
                integer_text(layout)
      if (of_layout /= layout) return
      problem = 'version '//trim(bytes(25:40))//' of the program wrote it, this one is '//version
      if (bytes(25:40) /= version) return
      problem = 'it belongs to another deck, or the deck has been changed since'
      if (transfer(bytes(41:48), deck) /= deck) return
      problem = ''
      call move_alloc(bytes, stream%bytes)
      stream%used = head_length
      stream%last = n - tail_length
   end subroutine open_restart

   !> Whether all of the state has been read without a failure.
   pure logical function is_at_end(self)
      class(restart_stream_type), intent(in) :: self

      is_at_end = .not. allocated(self%fault) .and. self%used == self%last
   end function is_at_end

   !> Write, or read, up to six variables or contiguous arrays of any intrinsic type but character.
   subroutine item(self, a, b, c, d, e, f)
      class(restart_stream_type), intent(inout) :: self
      class(*), intent(inout)                   :: a(..)
      class(*), intent(inout), optional         :: b(..), c(..), d(..), e(..), f(..)

      call block(self, storage_size(a)/8*size(a, kind=long), a)
      if (present(b)) call block(self, storage_size(b)/8*size(b, kind=long), b)
      if (present(c)) call block(self, storage_size(c)/8*size(c, kind=long), c)
      if (present(d)) call block(self, storage_size(d)/8*size(d, kind=long), d)
      if (present(e)) call block(self, storage_size(e)/8*size(e, kind=long), e)
      if (present(f)) call block(self, storage_size(f)/8*size(f, kind=long), f)
   end subroutine item

   !> The N bytes of VALUES.
   subroutine block(self, n, values)
      class(restart_stream_type), intent(inout) :: self
      integer(long), intent(in)                 :: n
      type(*), intent(inout), target            :: values(..)
      character(n), pointer :: bytes

      call c_f_pointer(c_loc(values), bytes)
      call self%text(bytes)
   end subroutine block

   !> Write or read BYTES; where they cannot be read they keep their values.
   subroutine text(self, bytes)
      class(restart_stream_type), intent(inout) :: self
      character(*), intent(inout)               :: bytes
      integer(long) :: n

      n = len(bytes, long)
      if (n == 0 .or. allocated(self%fault)) return
      if (self%writes) then
         call put(self, transfer(n, eight_letters))
         call put(self, bytes)
      else if (n /= next_size(self)) then
         call fail(self, 'a part of the state does not fit the model')
      else
         bytes = self%bytes(self%used + 1:self%used + n)
         self%used = self%used + n
      end if
   end subroutine text

   !> Reading: the byte count at this place, if so many bytes follow; otherwise -1.
   integer(long) function next_size(self) result(n)
      class(restart_stream_type), intent(inout) :: self

      n = -1
      if (self%last - self%used < 8) return
      n = transfer(self%bytes(self%used + 1:self%used + 8), n)
      self%used = self%used + 8
      if (n > self%last - self%used) n = -1
   end function next_size

   !> Write or read the count N of items of at least BYTES_EACH, -1: not allocated. Reading gives 0 where the bytes are missing.
   subroutine extent(self, n, bytes_each)
      class(restart_stream_type), intent(inout) :: self
      integer, intent(inout)                    :: n
      integer, intent(in)                       :: bytes_each

      call self%item(n)
      if (self%writes) return
      if (n < -1 .or. (n > 0 .and. int(n, long)*bytes_each + 8 > self%last - self%used)) &
         call fail(self, 'it ends too early')
      if (allocated(self%fault)) n = 0
   end subroutine extent

   !> Write all bytes of the file PATH into the stream, or copy them from the stream to DESCRIPTOR.
   subroutine file(self, path, descriptor)
      class(restart_stream_type), intent(inout) :: self
      character(*), intent(in)                  :: path
      integer, intent(in)                       :: descriptor
      character(:), allocatable :: bytes
      integer(long) :: n
      logical :: ok

      if (allocated(self%fault)) return
      if (self%writes) then
         call read_all_bytes(path, bytes, ok)
         if (.not. ok) then
            call fail(self, path//' cannot be read')
            return
         end if
         call put(self, transfer(len(bytes, long), eight_letters))
         call put(self, bytes)
         return
      end if
      n = next_size(self)
      ok = n >= 0
      if (ok) call write_bytes(descriptor, self%bytes(self%used + 1:self%used + n), ok)
      self%used = self%used + max(0_long, n)
      if (.not. ok) call fail(self, path//' cannot be written')
   end subroutine file

   !> Write or read a text of any length, or an unallocated one.
   subroutine any_text(self, value)
      class(restart_stream_type), intent(inout) :: self
      character(:), allocatable, intent(inout)  :: value
      integer :: n

      n = -1
      if (allocated(value)) n = len(value)
      call self%extent(n, 1)
      if (.not. self%writes) then
         if (allocated(value)) deallocate (value)
         if (n >= 0) allocate (character(n) :: value)
      end if
      if (n >= 0) call self%text(value)
   end subroutine any_text

   subroutine put(self, bytes)
      class(restart_stream_type), intent(inout) :: self
      character(*), intent(in)                  :: bytes
      logical :: ok

      if (allocated(self%fault)) return
      call add_to_checksum(bytes, self%sum)
      call write_bytes(self%descriptor, bytes, ok)
      self%used = self%used + len(bytes, long)
      if (.not. ok) call fail(self, 'it cannot be written')
   end subroutine put

   !> Note the failure; the first message counts.
   subroutine fail(self, words)
      class(restart_stream_type), intent(inout) :: self
      character(*), intent(in)                  :: words

      if (.not. allocated(self%fault)) self%fault = words
   end subroutine fail

   !> Extend the checksum SUM by BYTES.
   pure subroutine add_to_checksum(bytes, sum)
      character(*), intent(in)      :: bytes
      integer(int64), intent(inout) :: sum
      integer(long) :: k

      sum = not(sum)
      do k = 1, len(bytes, long)
         sum = ieor(table(ieor(int(iand(sum, 255_int64)), iachar(bytes(k:k)))), shiftr(sum, 8))
      end do
      sum = not(sum)
   end subroutine add_to_checksum

end module restart_stream
