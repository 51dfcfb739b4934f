!> Defines the layout of a restart file, and writes or reads the state of a run through it.
!! Each type with state in the file has one routine that names its components in order. The same routine writes and reads them.
!!
!!     byte  1   'JOINTFEM RESTART'
!!          17   the number of the layout [4]
!!          21   16909060, which is 1, 2, 3, 4 byte by byte where the most significant comes first [4]
!!          25   the version of the program that wrote it [16 letters]
!!          41   the checksum of the deck with its INCLUDE files [8]
!!          49   the state: its items one behind the other
!!       n - 15  n, the bytes of the whole file [8]
!!        n - 7  the checksum of all before [8]
!!
!! An item: length of its name [1], its kind (part, integer, real and so on) [1], its name, the number of its bytes [8], -1: not
!! allocated, and these bytes. A part has a version, and the items behind it are the components of one type; a component of many
!! elements is one item. Reading compares kinds, names and versions. An array of any size, or one that may be unallocated, has its
!! extent before it, -1: unallocated.
!!
!! open_restart checks that a file is whole and of this layout, program and order of bytes. A length in the file is accepted only as
!! far as there are bytes for it.
module restart_stream
   use, intrinsic :: iso_c_binding, only: c_f_pointer, c_loc, c_ptr
   use c_library, only: read_all_bytes, write_bytes
   use checksum, only: add_to_checksum, no_bytes
   use, intrinsic :: iso_fortran_env, only: int32, int64
   use kinds, only: long, wp
   use text_tools, only: integer_text
   implicit none
   private

   public :: open_restart

   integer, parameter, public :: layout = 12 !! changes with the layout and with its contents
   character(*), parameter    :: magic = 'JOINTFEM RESTART'
   integer(int32), parameter  :: order_mark = int(z'01020304', int32), other_order = int(z'04030201', int32)
   integer, parameter, public :: version_length = 16
   integer, parameter :: head_length = 48, tail_length = 16
   character(8), parameter :: eight_letters = ''
   integer, parameter :: is_part = 1, is_integer = 2, is_real = 3, is_logical = 4, is_text = 5, is_extent = 6, is_file = 7
   character(7), parameter :: kind_words(is_file) = ['part   ', 'integer', 'real   ', 'logical', 'text   ', 'extent ', 'file   ']

   type, public :: restart_stream_type
      logical :: writes = .false.                 !! false: it reads
      character(:), allocatable :: fault          !! why it failed; not allocated: it has not failed
      character(:), allocatable :: bytes          !! reading: the file; writing: allocated where the state stays in memory
      integer(long) :: used = 0                   !! bytes read or written so far
      integer(long) :: last = 0                   !! reading: the last byte before the tail
      integer(int64), private :: sum = no_bytes   ! checksum of the bytes written
      integer, private        :: descriptor = -1
      character(:), allocatable, private :: name  ! of the last part
   contains
      procedure :: start
      procedure :: complete
      procedure :: is_at_end
      procedure :: part
      generic   :: item => integer_item, long_item, real_item, logical_item
      procedure :: text
      procedure :: extent
      procedure :: file
      procedure :: fail
      procedure, private :: integer_item, long_item, real_item, logical_item
   end type restart_stream_type

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

   !> Begin the part NAME, the components of the type of this name, in this VERSION: the routine that names them counts it up with
   !! each change.
   subroutine part(self, name, version)
      class(restart_stream_type), intent(inout) :: self
      character(*), intent(in)                  :: name
      integer, intent(in)                       :: version
      integer :: found

      found = version
      self%name = ''
      call block(self, name, is_part, 4, found)
      self%name = name
      if (found /= version) call self%fail('its part '''//name//''' has version '//integer_text(found)// &
                                           ', this program reads '//integer_text(version))
   end subroutine part

   ! ---- item: the value of the component NAME, or its values A of any rank ----

   subroutine integer_item(self, name, a)
      class(restart_stream_type), intent(inout) :: self
      character(*), intent(in)                  :: name
      integer, intent(inout), contiguous        :: a(..)

      call block(self, name, is_integer, 4, a)
   end subroutine integer_item

   subroutine long_item(self, name, a)
      class(restart_stream_type), intent(inout) :: self
      character(*), intent(in)                  :: name
      integer(long), intent(inout), contiguous  :: a(..)

      call block(self, name, is_integer, 8, a)
   end subroutine long_item

   subroutine real_item(self, name, a)
      class(restart_stream_type), intent(inout) :: self
      character(*), intent(in)                  :: name
      real(wp), intent(inout), contiguous       :: a(..)

      call block(self, name, is_real, 8, a)
   end subroutine real_item

   subroutine logical_item(self, name, a)
      class(restart_stream_type), intent(inout) :: self
      character(*), intent(in)                  :: name
      logical, intent(inout), contiguous        :: a(..)

      call block(self, name, is_logical, 4, a)
   end subroutine logical_item

   !> VALUES of so many BYTES_EACH, which keep their values where they cannot be read.
   subroutine block(self, name, kind, bytes_each, values)
      class(restart_stream_type), intent(inout) :: self
      character(*), intent(in)                  :: name
      integer, intent(in)                       :: kind, bytes_each
      type(*), intent(inout), target            :: values(..)
      integer(long) :: found, n

      n = bytes_each*product(max(0_long, shape(values, kind=long))) ! gfortran 12 gives an empty array that it has copied an extent of -1
      found = n
      call head(self, name, kind, found)
      if (n /= found) call self%fail(quoted(self, name)//' does not fit the model')
      if (n > 0 .and. .not. allocated(self%fault)) call move(c_loc(values), n)

   contains

      subroutine move(at, n)
         type(c_ptr), intent(in)   :: at
         integer(long), intent(in) :: n
         character(n), pointer :: bytes

         call c_f_pointer(at, bytes)
         call content(self, bytes)
      end subroutine move

   end subroutine block

   !> Write or read the head of the item NAME of this KIND and of N bytes. Reading gives 0 where it is another item.
   subroutine head(self, name, kind, n)
      class(restart_stream_type), intent(inout) :: self
      character(*), intent(in)                  :: name
      integer, intent(in)                       :: kind
      integer(long), intent(inout)              :: n
      character(:), allocatable :: there
      integer :: length, found

      if (self%writes) then
         call put(self, achar(len(name))//achar(kind)//name//transfer(n, eight_letters))
         return
      end if
      n = 0
      length = 0
      if (allocated(self%fault)) return
      if (self%last - self%used >= 10) length = iachar(self%bytes(self%used + 1:self%used + 1))
      if (self%last - self%used < 10 + length) then
         call self%fail('it ends before '//quoted(self, name))
         return
      end if
      found = iachar(self%bytes(self%used + 2:self%used + 2))
      there = self%bytes(self%used + 3:self%used + 2 + length)
      if (found /= kind .or. there /= name .or. length /= len(name)) then
         call self%fail(trim(kind_words(kind))//' '//quoted(self, name)//' is expected, '// &
                        trim(kind_words(max(is_part, min(found, is_file))))//' '''//there//''' is there')
         return
      end if
      self%used = self%used + 10 + length
      n = transfer(self%bytes(self%used - 7:self%used), n)
      if (n >= -1 .and. n <= self%last - self%used) return
      call self%fail('it ends within '//quoted(self, name))
      n = 0
   end subroutine head

   !> Write or read BYTES, behind their head.
   subroutine content(self, bytes)
      class(restart_stream_type), intent(inout) :: self
      character(*), intent(inout)               :: bytes

      if (self%writes) then
         call put(self, bytes)
      else
         bytes = self%bytes(self%used + 1:self%used + len(bytes))
         self%used = self%used + len(bytes)
      end if
   end subroutine content

   !> The component NAME in words.
   pure function quoted(self, name) result(words)
      class(restart_stream_type), intent(in) :: self
      character(*), intent(in)               :: name
      character(:), allocatable :: words

      words = ''''//name//''''
      if (allocated(self%name)) then
         if (self%name /= '') words = words//' of '//self%name
      end if
   end function quoted

   !> Write or read a text of any length, or an unallocated one.
   subroutine text(self, name, value)
      class(restart_stream_type), intent(inout) :: self
      character(*), intent(in)                  :: name
      character(:), allocatable, intent(inout)  :: value
      integer(long) :: n

      n = -1
      if (allocated(value)) n = len(value, long)
      call head(self, name, is_text, n)
      if (.not. self%writes) then
         if (allocated(value)) deallocate (value)
         if (n >= 0) allocate (character(n) :: value)
      end if
      if (n > 0) call content(self, value)
   end subroutine text

   !> Write or read the count N of items of at least BYTES_EACH, -1: not allocated. Reading gives 0 where the bytes are missing.
   subroutine extent(self, name, n, bytes_each)
      class(restart_stream_type), intent(inout) :: self
      character(*), intent(in)                  :: name
      integer, intent(inout)                    :: n
      integer, intent(in)                       :: bytes_each

      call block(self, name, is_extent, 4, n)
      if (self%writes) return
      if (n < -1 .or. (n > 0 .and. int(n, long)*bytes_each > self%last - self%used)) &
         call self%fail('it ends within '//quoted(self, name))
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
            call self%fail(path//' cannot be read')
            return
         end if
         n = len(bytes, long)
      end if
      call head(self, 'bytes', is_file, n)
      if (self%writes) then
         call put(self, bytes)
      else if (.not. allocated(self%fault)) then
         n = max(0_long, n)
         call write_bytes(descriptor, self%bytes(self%used + 1:self%used + n), ok)
         self%used = self%used + n
         if (.not. ok) call self%fail(path//' cannot be written')
      end if
   end subroutine file

   subroutine put(self, bytes)
      class(restart_stream_type), intent(inout) :: self
      character(*), intent(in)                  :: bytes
      integer(long) :: n
      logical :: ok

      if (allocated(self%fault)) return
      if (allocated(self%bytes)) then ! in memory
         n = self%used + len(bytes, long)
         if (n > len(self%bytes, long)) self%bytes = self%bytes//repeat(' ', n) ! room for as much again
         self%bytes(self%used + 1:n) = bytes
         self%used = n
         return
      end if
      call add_to_checksum(bytes, self%sum)
      call write_bytes(self%descriptor, bytes, ok)
      self%used = self%used + len(bytes, long)
      if (.not. ok) call self%fail('it cannot be written')
   end subroutine put

   !> Note the failure; the first message counts.
   subroutine fail(self, words)
      class(restart_stream_type), intent(inout) :: self
      character(*), intent(in)                  :: words

      if (.not. allocated(self%fault)) self%fault = words
   end subroutine fail

end module restart_stream
