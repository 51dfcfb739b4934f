!> The data of a VTK XML file, "appended raw": arrays that are handed over once and go to the disk at once, under a header
!! that stands before them.
!!
!!    byte 1              the XML header, filled up with blanks; its last byte is the underscore that begins the data
!!    byte data_start     the arrays as they lie in memory, each after its length in bytes (UInt64)
!!    then                the closing tags
!!
!! The header needs the place of every array, so it is written last, into the room that was left for it.
!!
!! As with every result, the file has the name PATH.part until it is complete. A call that fails makes FAILED true; the calls
!! after it do nothing, and FINISH leaves no file.
module appended_data
   use, intrinsic :: iso_fortran_env, only: int8, int32, int64, real64
   use c_library, only: remove_file, rename_file
   use incomplete_results, only: note_incomplete, suffix
   use vtu_header, only: array_type, closing, data_start, header_text
   implicit none
   private

   type, public :: appended_data_type
      private
      character(:), allocatable :: path
      integer :: unit   = 0
      integer :: status = 0                    ! of the first call that failed
      integer(int64) :: n_bytes = 0            ! of data so far
      integer :: n_arrays = 0
      type(array_type), allocatable :: arrays(:)
      logical, public :: is_open = .false.
   contains
      procedure :: start
      procedure :: begin_array
      generic   :: put => put_reals, put_integers, put_bytes
      procedure :: refuse
      procedure :: failed
      procedure :: finish
      procedure :: discard
      procedure, private :: put_reals, put_integers, put_bytes
   end type appended_data_type

   integer, parameter :: wrong_call = -huge(0) ! a status of our own

contains

   !> Open the file that will be PATH. A file that is still open is given up first.
   subroutine start(self, path)
      class(appended_data_type), intent(inout) :: self
      character(*), intent(in)                 :: path

      call self%discard()
      self%path = path
      self%n_bytes = 0
      self%n_arrays = 0
      if (allocated(self%arrays)) deallocate (self%arrays)
      allocate (self%arrays(16))
      call note_incomplete(path)
      open (newunit=self%unit, file=path//suffix, status='replace', action='write', access='stream', &
            form='unformatted', iostat=self%status)
      self%is_open = self%status == 0
      if (self%is_open) write (self%unit, iostat=self%status) repeat(' ', data_start)
   end subroutine start


   !> Note an array of N_BYTES for the header, and write its length. Its values follow by PUT, in one call or several.
   subroutine begin_array(self, section, name, number, components, n_bytes)
      class(appended_data_type), intent(inout) :: self
      integer, intent(in)                      :: section    !! in_points, ... of vtu_header
      character(*), intent(in)                 :: name
      character(*), intent(in)                 :: number     !! VTK's word for the kind: Float64, Int32, UInt8
      integer, intent(in)                      :: components !! of each tuple, 1 or more
      integer(int64), intent(in)               :: n_bytes    !! of all values
      type(array_type), allocatable :: longer(:)

      if (.not. self%is_open .or. components < 1) call self%refuse()
      if (self%status /= 0) return
      if (self%n_arrays == size(self%arrays)) then
         allocate (longer(2*self%n_arrays))
         longer(:self%n_arrays) = self%arrays
         call move_alloc(longer, self%arrays)
      end if
      self%n_arrays = self%n_arrays + 1
      self%arrays(self%n_arrays) = array_type(name, number, section, components, self%n_bytes)
      write (self%unit, iostat=self%status) n_bytes
      self%n_bytes = self%n_bytes + storage_size(n_bytes)/8 + n_bytes
   end subroutine begin_array


   subroutine put_reals(self, values)
      class(appended_data_type), intent(inout) :: self
      real(real64), intent(in), contiguous     :: values(:)

      if (self%status == 0) write (self%unit, iostat=self%status) values
   end subroutine put_reals


   subroutine put_integers(self, values)
      class(appended_data_type), intent(inout) :: self
      integer(int32), intent(in), contiguous   :: values(:)

      if (self%status == 0) write (self%unit, iostat=self%status) values
   end subroutine put_integers


   subroutine put_bytes(self, values)
      class(appended_data_type), intent(inout) :: self
      integer(int8), intent(in), contiguous    :: values(:)

      if (self%status == 0) write (self%unit, iostat=self%status) values
   end subroutine put_bytes


   !> A call that contradicts what went before.
   pure subroutine refuse(self)
      class(appended_data_type), intent(inout) :: self

      if (self%status == 0) self%status = wrong_call
   end subroutine refuse


   !> Whether anything could not be written.
   pure logical function failed(self)
      class(appended_data_type), intent(in) :: self

      failed = self%status /= 0
   end function failed


   !> Write the header, close the file and give it its name. OK is false, and no file is left by us, where that failed.
   subroutine finish(self, n_points, n_cells, ok)
      class(appended_data_type), intent(inout) :: self
      integer(int64), intent(in)               :: n_points, n_cells
      logical, intent(out)                     :: ok
      character(:), allocatable :: header
      integer(int64) :: n_written

      ok = .false.
      if (.not. self%is_open) return
      if (self%status == 0) then
         header = header_text(n_points, n_cells, self%arrays(:self%n_arrays))
         if (len(header) > data_start) call self%refuse()
      end if
      if (self%status == 0) write (self%unit, iostat=self%status) closing
      if (self%status == 0) write (self%unit, pos=1, iostat=self%status) header
      if (self%status == 0) flush (self%unit, iostat=self%status)
      if (self%status /= 0) then
         call self%discard()
         return
      end if
      close (self%unit, iostat=self%status)
      self%is_open = .false.
      if (self%status == 0) then ! that the disk is full may show in nothing but the size
         inquire (file=self%path//suffix, size=n_written)
         if (n_written == data_start + self%n_bytes + len(closing)) call rename_file(self%path//suffix, self%path, ok)
         if (.not. ok) call self%refuse()
      end if
      if (.not. ok) call remove_file(self%path//suffix)
   end subroutine finish


   !> Leave nothing behind.
   subroutine discard(self)
      class(appended_data_type), intent(inout) :: self
      integer :: status

      if (.not. self%is_open) return
      close (self%unit, iostat=status)
      self%is_open = .false.
      call remove_file(self%path//suffix)
   end subroutine discard

end module appended_data
