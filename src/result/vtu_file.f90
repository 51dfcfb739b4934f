!> A VTK XML unstructured grid, NAME.vtu, for ParaView: points, cells, and arrays of values on either.
!!
!! Every array is handed over once and goes to the disk at once; nothing of it is kept or copied. The file is
!!
!!    byte 1              the XML header, filled up with blanks; its last byte is the underscore that begins the data
!!    byte data_start     the arrays as they lie in memory, each after its length in bytes (UInt64)
!!    then                the closing tags
!!
!! The header needs the place of every array, so it is written last, into the room that was left for it.
!!
!! As with every result, the file has the name NAME.vtu.part until it is complete. Use:
!!
!!    call file%start('beam.1.vtu')
!!    call file%points(x)                            ! in this order: points, cells, and then the values
!!    call file%cells(connectivity, ends, types)
!!    call file%point_data('displacement', u)        ! real or integer; (n) scalars, (3,n) vectors,
!!    call file%cell_data('stress', sigma)           ! (6,n) symmetric tensors: xx yy zz xy yz xz
!!    call file%finish(ok)
!!
!! A call that fails, or that contradicts what went before (an array of another size than the points, a node number that
!! is no point, no points at all, more arrays than the header holds), makes FAILED true; the calls after it do nothing,
!! and FINISH leaves no file.
!! Arrays that are not contiguous are copied by the compiler at the call.
module vtu_file
   use, intrinsic :: iso_fortran_env, only: int8, int32, int64, real64
   use c_library, only: remove_file, rename_file
   use incomplete_results, only: note_incomplete
   use vtu_header, only: array_type, closing, data_start, header_text, in_cell_data, in_cells, in_point_data, in_points
   implicit none
   private

   ! Types of cell, with the nodes in the order of CTRIA3, CQUAD4, CTETRA and CHEXA. The normal of the first triangle of
   ! a wedge points outward, that of CPENTA inward: a CPENTA goes in as G1 G3 G2 G4 G6 G5.
   integer(int8), parameter, public :: vtk_vertex = 1_int8, vtk_line = 3_int8, vtk_triangle = 5_int8, &
                                       vtk_quad = 9_int8, vtk_tetra = 10_int8, vtk_hexahedron = 12_int8, &
                                       vtk_wedge = 13_int8

   type, public :: vtu_file_type
      private
      character(:), allocatable :: path
      integer :: unit   = 0
      integer :: status = 0                    ! of the first call that failed
      integer(int64) :: n_points = -1, n_cells = -1 ! -1: not yet given
      integer(int64) :: n_bytes = 0            ! of data so far
      integer :: n_arrays = 0
      type(array_type), allocatable :: arrays(:)
      logical, public :: is_open = .false.
   contains
      procedure :: start
      procedure :: points
      procedure :: cells
      generic   :: point_data => point_reals, point_tuples, point_integers, point_integer_tuples
      generic   :: cell_data  => cell_reals, cell_tuples, cell_integers, cell_integer_tuples
      procedure :: failed
      procedure :: finish
      procedure :: discard
      procedure, private :: point_reals, point_tuples, point_integers, point_integer_tuples
      procedure, private :: cell_reals, cell_tuples, cell_integers, cell_integer_tuples
   end type vtu_file_type

   character(*), parameter :: suffix = '.part'

   integer, parameter :: wrong_call = -huge(0) ! a status of our own

contains

   !> Open the file that will be PATH. A file that is still open is given up first.
   subroutine start(self, path)
      class(vtu_file_type), intent(inout) :: self
      character(*), intent(in)            :: path

      call self%discard()
      self%path = path
      self%n_points = -1
      self%n_cells = -1
      self%n_bytes = 0
      self%n_arrays = 0
      if (allocated(self%arrays)) deallocate (self%arrays)
      allocate (self%arrays(16))
      call note_incomplete(path)
      call note_incomplete(path//suffix)
      open (newunit=self%unit, file=path//suffix, status='replace', action='write', access='stream', &
            form='unformatted', iostat=self%status)
      self%is_open = self%status == 0
      if (self%is_open) write (self%unit, iostat=self%status) repeat(' ', data_start)
   end subroutine start


   !> The points: the first array, and the only one of its kind.
   subroutine points(self, x)
      class(vtu_file_type), intent(inout)  :: self
      real(real64), intent(in), contiguous :: x(:, :) !! (3,n): x, y, z of each point [length]

      if (size(x, 1) /= 3 .or. self%n_points >= 0) call refuse(self)
      self%n_points = size(x, 2, int64)
      call put_reals(self, in_points, 'points', 3, size(x, kind=int64), x)
   end subroutine points


   !> The cells, after the points.
   subroutine cells(self, connectivity, ends, types)
      class(vtu_file_type), intent(inout)    :: self
      integer(int32), intent(in), contiguous :: connectivity(:) !! nodes of the first cell, the second, ...: 1 to n
      integer(int32), intent(in), contiguous :: ends(:)         !! (n_cells) where each cell's nodes end in CONNECTIVITY
      integer(int8), intent(in), contiguous  :: types(:)        !! (n_cells) vtk_quad, ...
      integer, parameter :: room = 8192
      integer(int32) :: block(room)
      integer(int64) :: first, n, total

      if (self%n_points < 0 .or. self%n_cells >= 0 .or. size(ends) /= size(types)) call refuse(self)
      self%n_cells = size(ends, kind=int64)
      total = size(connectivity, kind=int64)
      if (.not. ends_fit(ends, total)) call refuse(self)

      call begin_array(self, in_cells, 'connectivity', 'Int32', 1, 4*total)
      do first = 1, total, room ! VTK counts the points from 0
         if (self%status /= 0) return
         n = min(int(room, int64), total - first + 1)
         block(:n) = connectivity(first:first + n - 1) - 1
         if (minval(block(:n)) < 0 .or. maxval(block(:n)) >= self%n_points) call refuse(self)
         if (self%status == 0) write (self%unit, iostat=self%status) block(:n)
      end do
      call put_integers(self, in_cells, 'offsets', 1, self%n_cells, ends)
      call begin_array(self, in_cells, 'types', 'UInt8', 1, self%n_cells)
      if (self%status == 0) write (self%unit, iostat=self%status) types
   end subroutine cells


   !> Whether ENDS never falls, and ends at TOTAL.
   pure logical function ends_fit(ends, total)
      integer(int32), intent(in) :: ends(:)
      integer(int64), intent(in) :: total
      integer(int64) :: i, before

      before = 0
      ends_fit = .false.
      do i = 1, size(ends, kind=int64)
         if (ends(i) < before) return
         before = ends(i)
      end do
      ends_fit = before == total
   end function ends_fit

   ! Values: each of these is one form of point_data or cell_data. The array's last extent runs over points or cells.

   subroutine point_reals(self, name, values)
      class(vtu_file_type), intent(inout)  :: self
      character(*), intent(in)             :: name
      real(real64), intent(in), contiguous :: values(:)

      if (size(values, kind=int64) /= self%n_points) call refuse(self)
      call put_reals(self, in_point_data, name, 1, size(values, kind=int64), values)
   end subroutine point_reals


   subroutine point_tuples(self, name, values)
      class(vtu_file_type), intent(inout)  :: self
      character(*), intent(in)             :: name
      real(real64), intent(in), contiguous :: values(:, :)

      if (size(values, 2, int64) /= self%n_points) call refuse(self)
      call put_reals(self, in_point_data, name, size(values, 1), size(values, kind=int64), values)
   end subroutine point_tuples


   subroutine point_integers(self, name, values)
      class(vtu_file_type), intent(inout)    :: self
      character(*), intent(in)               :: name
      integer(int32), intent(in), contiguous :: values(:)

      if (size(values, kind=int64) /= self%n_points) call refuse(self)
      call put_integers(self, in_point_data, name, 1, size(values, kind=int64), values)
   end subroutine point_integers


   subroutine point_integer_tuples(self, name, values)
      class(vtu_file_type), intent(inout)    :: self
      character(*), intent(in)               :: name
      integer(int32), intent(in), contiguous :: values(:, :)

      if (size(values, 2, int64) /= self%n_points) call refuse(self)
      call put_integers(self, in_point_data, name, size(values, 1), size(values, kind=int64), values)
   end subroutine point_integer_tuples


   subroutine cell_reals(self, name, values)
      class(vtu_file_type), intent(inout)  :: self
      character(*), intent(in)             :: name
      real(real64), intent(in), contiguous :: values(:)

      if (size(values, kind=int64) /= self%n_cells) call refuse(self)
      call put_reals(self, in_cell_data, name, 1, size(values, kind=int64), values)
   end subroutine cell_reals


   subroutine cell_tuples(self, name, values)
      class(vtu_file_type), intent(inout)  :: self
      character(*), intent(in)             :: name
      real(real64), intent(in), contiguous :: values(:, :)

      if (size(values, 2, int64) /= self%n_cells) call refuse(self)
      call put_reals(self, in_cell_data, name, size(values, 1), size(values, kind=int64), values)
   end subroutine cell_tuples


   subroutine cell_integers(self, name, values)
      class(vtu_file_type), intent(inout)    :: self
      character(*), intent(in)               :: name
      integer(int32), intent(in), contiguous :: values(:)

      if (size(values, kind=int64) /= self%n_cells) call refuse(self)
      call put_integers(self, in_cell_data, name, 1, size(values, kind=int64), values)
   end subroutine cell_integers


   subroutine cell_integer_tuples(self, name, values)
      class(vtu_file_type), intent(inout)    :: self
      character(*), intent(in)               :: name
      integer(int32), intent(in), contiguous :: values(:, :)

      if (size(values, 2, int64) /= self%n_cells) call refuse(self)
      call put_integers(self, in_cell_data, name, size(values, 1), size(values, kind=int64), values)
   end subroutine cell_integer_tuples


   !> Whether anything could not be written.
   pure logical function failed(self)
      class(vtu_file_type), intent(in) :: self

      failed = self%status /= 0
   end function failed


   !> Write the header, close the file and give it its name. OK is false, and no file is left by us, where that failed.
   subroutine finish(self, ok)
      class(vtu_file_type), intent(inout) :: self
      logical, intent(out)                :: ok
      character(:), allocatable :: header
      integer(int64) :: n_written

      ok = .false.
      if (.not. self%is_open) return
      if (self%n_cells < 0) call refuse(self)
      if (self%status == 0) then
         header = header_text(self%n_points, self%n_cells, self%arrays(:self%n_arrays))
         if (len(header) > data_start) call refuse(self)
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
         if (.not. ok) call refuse(self)
      end if
      if (.not. ok) call remove_file(self%path//suffix)
   end subroutine finish


   !> Leave nothing behind.
   subroutine discard(self)
      class(vtu_file_type), intent(inout) :: self
      integer :: status

      if (.not. self%is_open) return
      close (self%unit, iostat=status)
      self%is_open = .false.
      call remove_file(self%path//suffix)
   end subroutine discard


   !> A call that contradicts what went before.
   subroutine refuse(self)
      type(vtu_file_type), intent(inout) :: self

      if (self%status == 0) self%status = wrong_call
   end subroutine refuse


   !> Note an array of N_BYTES for the header, and write its length.
   subroutine begin_array(self, section, name, number, components, n_bytes)
      type(vtu_file_type), intent(inout) :: self
      integer, intent(in)                :: section, components
      character(*), intent(in)           :: name, number
      integer(int64), intent(in)         :: n_bytes
      type(array_type), allocatable :: longer(:)

      if (.not. self%is_open .or. self%n_points < 0 .or. components < 1) call refuse(self)
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


   !> One array of N reals in all. Of any rank at the call; here of rank one, so that it is written as one block.
   subroutine put_reals(self, section, name, components, n, values)
      type(vtu_file_type), intent(inout) :: self
      integer, intent(in)                :: section, components
      character(*), intent(in)           :: name
      integer(int64), intent(in)         :: n
      real(real64), intent(in)           :: values(n)

      call begin_array(self, section, name, 'Float64', components, 8*n)
      if (self%status == 0) write (self%unit, iostat=self%status) values
   end subroutine put_reals


   !> One array of N integers in all, likewise.
   subroutine put_integers(self, section, name, components, n, values)
      type(vtu_file_type), intent(inout) :: self
      integer, intent(in)                :: section, components
      character(*), intent(in)           :: name
      integer(int64), intent(in)         :: n
      integer(int32), intent(in)         :: values(n)

      call begin_array(self, section, name, 'Int32', components, 4*n)
      if (self%status == 0) write (self%unit, iostat=self%status) values
   end subroutine put_integers

end module vtu_file
