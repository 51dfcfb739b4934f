!> A VTK XML unstructured grid, NAME.vtu, for ParaView: points, cells, and arrays of values on either.
!!
!! Every array is handed over once and goes to the disk at once; nothing of it is kept or copied. Use:
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
   use appended_data, only: appended_data_type
   use vtu_header, only: in_cell_data, in_cells, in_point_data, in_points
   implicit none
   private

   ! Types of cell, with the nodes in the order of CTRIA3, CQUAD4, CTETRA and CHEXA. The normal of the first triangle of
   ! a wedge points outward, that of CPENTA inward: a CPENTA goes in as G1 G3 G2 G4 G6 G5.
   integer(int8), parameter, public :: vtk_vertex = 1_int8, vtk_line = 3_int8, vtk_triangle = 5_int8, &
                                       vtk_quad = 9_int8, vtk_tetra = 10_int8, vtk_hexahedron = 12_int8, &
                                       vtk_wedge = 13_int8

   type, public :: vtu_file_type
      private
      type(appended_data_type) :: data
      integer(int64) :: n_points = -1, n_cells = -1 ! -1: not yet given
   contains
      procedure :: start
      procedure :: points
      procedure :: cells
      generic   :: point_data => point_reals, point_tuples, point_integers, point_integer_tuples
      generic   :: cell_data  => cell_reals, cell_tuples, cell_integers, cell_integer_tuples
      procedure :: is_open
      procedure :: failed
      procedure :: finish
      procedure :: discard
      procedure, private :: point_reals, point_tuples, point_integers, point_integer_tuples
      procedure, private :: cell_reals, cell_tuples, cell_integers, cell_integer_tuples
   end type vtu_file_type

contains

   !> Open the file that will be PATH. A file that is still open is given up first.
   subroutine start(self, path)
      class(vtu_file_type), intent(inout) :: self
      character(*), intent(in)            :: path

      call self%data%start(path)
      self%n_points = -1
      self%n_cells = -1
   end subroutine start


   !> The points: the first array, and the only one of its kind.
   subroutine points(self, x)
      class(vtu_file_type), intent(inout)  :: self
      real(real64), intent(in), contiguous :: x(:, :) !! (3,n): x, y, z of each point [length]

      if (size(x, 1) /= 3 .or. self%n_points >= 0) call self%data%refuse()
      self%n_points = size(x, 2, int64)
      call put_reals(self, in_points, 'points', size(x, 1), self%n_points, x)
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

      if (self%n_points < 0 .or. self%n_cells >= 0 .or. size(ends) /= size(types)) call self%data%refuse()
      self%n_cells = size(ends, kind=int64)
      total = size(connectivity, kind=int64)
      if (.not. ends_fit(ends, total)) call self%data%refuse()

      call self%data%begin_array(in_cells, 'connectivity', 'Int32', 1, 4*total)
      do first = 1, total, room ! VTK counts the points from 0
         if (self%data%failed()) return
         n = min(int(room, int64), total - first + 1)
         block(:n) = connectivity(first:first + n - 1) - 1
         if (minval(block(:n)) < 0 .or. maxval(block(:n)) >= self%n_points) call self%data%refuse()
         call self%data%put(block(:n))
      end do
      call put_integers(self, in_cells, 'offsets', 1, self%n_cells, ends)
      call self%data%begin_array(in_cells, 'types', 'UInt8', 1, self%n_cells)
      call self%data%put(types)
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

      call put_reals(self, in_point_data, name, 1, size(values, kind=int64), values)
   end subroutine point_reals


   subroutine point_tuples(self, name, values)
      class(vtu_file_type), intent(inout)  :: self
      character(*), intent(in)             :: name
      real(real64), intent(in), contiguous :: values(:, :)

      call put_reals(self, in_point_data, name, size(values, 1), size(values, 2, int64), values)
   end subroutine point_tuples


   subroutine point_integers(self, name, values)
      class(vtu_file_type), intent(inout)    :: self
      character(*), intent(in)               :: name
      integer(int32), intent(in), contiguous :: values(:)

      call put_integers(self, in_point_data, name, 1, size(values, kind=int64), values)
   end subroutine point_integers


   subroutine point_integer_tuples(self, name, values)
      class(vtu_file_type), intent(inout)    :: self
      character(*), intent(in)               :: name
      integer(int32), intent(in), contiguous :: values(:, :)

      call put_integers(self, in_point_data, name, size(values, 1), size(values, 2, int64), values)
   end subroutine point_integer_tuples


   subroutine cell_reals(self, name, values)
      class(vtu_file_type), intent(inout)  :: self
      character(*), intent(in)             :: name
      real(real64), intent(in), contiguous :: values(:)

      call put_reals(self, in_cell_data, name, 1, size(values, kind=int64), values)
   end subroutine cell_reals


   subroutine cell_tuples(self, name, values)
      class(vtu_file_type), intent(inout)  :: self
      character(*), intent(in)             :: name
      real(real64), intent(in), contiguous :: values(:, :)

      call put_reals(self, in_cell_data, name, size(values, 1), size(values, 2, int64), values)
   end subroutine cell_tuples


   subroutine cell_integers(self, name, values)
      class(vtu_file_type), intent(inout)    :: self
      character(*), intent(in)               :: name
      integer(int32), intent(in), contiguous :: values(:)

      call put_integers(self, in_cell_data, name, 1, size(values, kind=int64), values)
   end subroutine cell_integers


   subroutine cell_integer_tuples(self, name, values)
      class(vtu_file_type), intent(inout)    :: self
      character(*), intent(in)               :: name
      integer(int32), intent(in), contiguous :: values(:, :)

      call put_integers(self, in_cell_data, name, size(values, 1), size(values, 2, int64), values)
   end subroutine cell_integer_tuples


   !> One array of N tuples of COMPONENTS reals. Of any rank at the call; here of rank one, so that it is written as one block.
   subroutine put_reals(self, section, name, components, n, values)
      type(vtu_file_type), intent(inout) :: self
      integer, intent(in)                :: section, components
      character(*), intent(in)           :: name
      integer(int64), intent(in)         :: n
      real(real64), intent(in)           :: values(components*n)

      if (n /= expected(self, section)) call self%data%refuse()
      call self%data%begin_array(section, name, 'Float64', components, 8*size(values, kind=int64))
      call self%data%put(values)
   end subroutine put_reals


   !> One array of N tuples of COMPONENTS integers, likewise.
   subroutine put_integers(self, section, name, components, n, values)
      type(vtu_file_type), intent(inout) :: self
      integer, intent(in)                :: section, components
      character(*), intent(in)           :: name
      integer(int64), intent(in)         :: n
      integer(int32), intent(in)         :: values(components*n)

      if (n /= expected(self, section)) call self%data%refuse()
      call self%data%begin_array(section, name, 'Int32', components, 4*size(values, kind=int64))
      call self%data%put(values)
   end subroutine put_integers


   !> How many tuples an array of SECTION has: one a point or one a cell; -1 where neither is known yet.
   pure integer(int64) function expected(self, section)
      type(vtu_file_type), intent(in) :: self
      integer, intent(in)             :: section

      expected = merge(self%n_points, self%n_cells, section == in_points .or. section == in_point_data)
   end function expected


   pure logical function is_open(self)
      class(vtu_file_type), intent(in) :: self

      is_open = self%data%is_open
   end function is_open


   !> Whether anything could not be written.
   pure logical function failed(self)
      class(vtu_file_type), intent(in) :: self

      failed = self%data%failed()
   end function failed


   !> Complete the file and give it its name. OK is false, and no file is left by us, where that failed.
   subroutine finish(self, ok)
      class(vtu_file_type), intent(inout) :: self
      logical, intent(out)                :: ok

      if (self%n_cells < 0) call self%data%refuse()
      call self%data%finish(self%n_points, self%n_cells, ok)
   end subroutine finish


   !> Leave nothing behind.
   subroutine discard(self)
      class(vtu_file_type), intent(inout) :: self

      call self%data%discard()
   end subroutine discard

end module vtu_file
