!> The VTK XML files for ParaView: an unstructured grid, NAME.vtu, the index of its pieces, NAME.pvtu, and a list of files with
!! their times, NAME.pvd. A grid has points, cells, and arrays of values on either.
!!
!! Every array is passed once and written at once; the module keeps none of it. Use:
!!
!!    call file%start('beam.1.vtu')
!!    call file%points(x)                               ! in this order: points, cells, and then the values
!!    call file%cells(connectivity, ends, types)
!!    call file%add(point_data, 'displacement', u)      ! real or integer; (n) scalars, (3,n) vectors,
!!    call file%add(cell_data, 'stress', sigma)         ! (6,n) symmetric tensors: xx yy zz xy yz xz
!!    call file%finish(ok)
!!
!! The file, "appended raw":
!!
!!    byte 1              the XML header, padded with blanks; its last byte is the underscore that begins the data
!!    byte data_start     the arrays as in memory, each after its length in bytes (UInt64)
!!    then                the closing tags
!!
!! The header contains the offset of every array. It is therefore written last, into the space reserved for it. After COMPLETE the
!! component FILE is the closed file, not yet named.
!!
!! A failed or inconsistent call makes FILE%FAULT true. Inconsistent are: a size of an array that differs from that of the points, a
!! node number without a point, no points at all, more arrays than the header holds. Later calls do nothing, and FINISH leaves
!! no file. The compiler copies arrays that are not contiguous.
module vtu_file
   use, intrinsic :: iso_c_binding, only: c_f_pointer, c_loc
   use, intrinsic :: iso_fortran_env, only: int8, int32, int64, real64
   use kinds, only: wp
   use output_file, only: output_file_type
   use text_tools, only: integer_text
   implicit none
   private

   public :: named, piece_of, xml_text, write_index, write_collection

   integer(int8), parameter, public :: vtk_vertex = 1_int8 !! a type of cell; those of bodies: element_kinds

   integer, parameter, public :: data_start = 16384 !! length of the header [bytes]: enough for a hundred arrays

   !> The sections of the header with arrays; callers use those of the values.
   integer, parameter, public :: point_data = 3, cell_data = 4
   integer, parameter         :: in_points = 1, in_cells = 2
   character(*), parameter    :: section_tags(4) = [character(9) :: 'Points', 'Cells', 'PointData', 'CellData']

   character(*), parameter :: newline = new_line('a')
   character(*), parameter :: closing = newline//'  </AppendedData>'//newline//'</VTKFile>'//newline ! behind the data

   !> The lines of a section of the header, one for each array.
   type :: section_type
      character(:), allocatable :: lines
   end type section_type

   type, public :: vtu_file_type
      type(output_file_type) :: file
      integer, private :: n_points = -1, n_cells = -1 ! -1: not yet given
      integer(int64), private :: n_bytes = 0          ! of data so far
      type(section_type), private :: sections(size(section_tags))
   contains
      procedure :: start
      procedure :: points
      procedure :: cells
      generic   :: add => add_reals, add_integers
      procedure :: complete
      procedure :: finish
      procedure, private :: add_reals, add_integers
   end type vtu_file_type

contains

   !> Open the file that will be PATH, or with IS_PART the part PATH of another process, as in output_file. A file that is still
   !! open is discarded first.
   subroutine start(self, path, is_part)
      class(vtu_file_type), intent(inout) :: self
      character(*), intent(in)            :: path
      logical, intent(in), optional       :: is_part
      integer :: i

      self%n_points = -1
      self%n_cells = -1
      self%n_bytes = 0
      do i = 1, size(self%sections)
         self%sections(i)%lines = ''
      end do
      call self%file%start(path, is_part)
      call self%file%put_lines(repeat(' ', data_start))
   end subroutine start

   !> The points: the first array, and the only one of its kind.
   subroutine points(self, x)
      class(vtu_file_type), intent(inout)  :: self
      real(real64), intent(in), contiguous :: x(:, :) !! (3,n): x, y, z of each point [length]

      call require(self, size(x, 1) == 3 .and. self%n_points < 0)
      self%n_points = size(x, 2)
      call self%add(in_points, 'points', x)
   end subroutine points

   !> The cells, after the points.
   subroutine cells(self, connectivity, ends, types)
      class(vtu_file_type), intent(inout)    :: self
      integer(int32), intent(in), contiguous :: connectivity(:) !! nodes of the first cell, the second, ...: 1 to n
      integer(int32), intent(in), contiguous :: ends(:)         !! (n_cells) where each cell's nodes end in CONNECTIVITY
      integer(int8), intent(in), contiguous  :: types(:)        !! (n_cells) VTK's numbers: vtk_vertex, ...

      call require(self, self%n_points >= 0 .and. self%n_cells < 0 .and. size(ends) == size(types))
      call require(self, all(connectivity >= 1 .and. connectivity <= self%n_points))
      self%n_cells = size(ends)
      ! ENDS must not decrease, and end at the size of CONNECTIVITY
      call require(self, all(ends >= 0) .and. all(ends(2:) >= ends(:size(ends) - 1)))
      call write_array(self, in_cells, 'connectivity', 'Int32', 4, connectivity - 1, maxval([0, ends])) ! VTK counts points from 0
      call self%add(in_cells, 'offsets', ends)
      call write_array(self, in_cells, 'types', 'UInt8', 1, types)
   end subroutine cells

   !> An array of values: (n), or (components, n), one for every point or every cell.
   subroutine add_reals(self, section, name, values)
      class(vtu_file_type), intent(inout)  :: self
      integer, intent(in)                  :: section !! point_data, cell_data
      character(*), intent(in)             :: name
      real(real64), intent(in), contiguous :: values(..)

      call write_array(self, section, name, 'Float64', 8, values)
   end subroutine add_reals

   subroutine add_integers(self, section, name, values)
      class(vtu_file_type), intent(inout)    :: self
      integer, intent(in)                    :: section
      character(*), intent(in)               :: name
      integer(int32), intent(in), contiguous :: values(..)

      call write_array(self, section, name, 'Int32', 4, values)
   end subroutine add_integers

   !> Record an array for the header, and write its length and bytes.
   subroutine write_array(self, section, name, number, bytes, values, n_tuples)
      type(vtu_file_type), intent(inout) :: self
      integer, intent(in)                :: section
      character(*), intent(in)           :: name, number
      integer, intent(in)                :: bytes      !! of a number
      type(*), intent(in), contiguous, target :: values(..) !! (n) or (components, n)
      integer, intent(in), optional      :: n_tuples   !! required; default: one for each point or cell
      character(:), allocatable :: line
      character(20)  :: offset
      integer        :: components, n
      integer(int64) :: n_bytes

      n = merge(self%n_points, self%n_cells, section == in_points .or. section == point_data)
      if (present(n_tuples)) n = n_tuples
      components = 1
      if (rank(values) == 2) components = size(values, 1)
      ! an empty array constructor has an extent of -1 in gfortran 12
      call require(self, self%file%is_open .and. components > 0 .and. max(0, size(values, rank(values))) == n)
      if (self%file%fault) return
      write (offset, '(i0)') self%n_bytes
      line = '        <DataArray type="'//number//'" Name="'//xml_text(name)//'"'
      if (components > 1) line = line//' NumberOfComponents="'//integer_text(components)//'"' ! 1: a matrix to some readers
      self%sections(section)%lines = self%sections(section)%lines//line//' format="appended" offset="'//trim(offset)//'"/>'//newline
      n_bytes = int(bytes, int64)*components*n
      block
         character(n_bytes), pointer :: as_bytes

         call c_f_pointer(c_loc(values), as_bytes)
         call self%file%put_lines(transfer(n_bytes, '12345678'))
         call self%file%put_lines(as_bytes)
      end block
      self%n_bytes = self%n_bytes + storage_size(n_bytes)/8 + n_bytes
   end subroutine write_array

   !> Mark the file as failed unless a call FITS the state.
   pure subroutine require(self, fits)
      type(vtu_file_type), intent(inout) :: self
      logical, intent(in)                :: fits

      self%file%fault = self%file%fault .or. .not. fits
   end subroutine require

   !> Write the header, padded to data_start bytes, and close the file, which has no name yet. FILE%FAULT is true where anything
   !! failed.
   subroutine complete(self)
      class(vtu_file_type), intent(inout) :: self
      character(*), parameter :: last = '  <AppendedData encoding="raw">'//newline//'_'
      character(*), parameter :: orders(0:1) = [character(12) :: 'BigEndian', 'LittleEndian']
      character(:), allocatable :: header
      integer :: i, status, unit

      if (.not. self%file%is_open) return
      header = '<?xml version="1.0"?>'//newline//'<VTKFile type="UnstructuredGrid" version="1.0" byte_order="'// &
               trim(orders(transfer(1_int32, 1_int8)))//'" header_type="UInt64">'//newline// &
               '  <UnstructuredGrid>'//newline//'    <Piece NumberOfPoints="'//integer_text(self%n_points)// &
               '" NumberOfCells="'//integer_text(self%n_cells)//'">'//newline
      do i = 1, size(section_tags)
         header = header//'      <'//trim(section_tags(i))//'>'//newline//self%sections(i)%lines// &
                  '      </'//trim(section_tags(i))//'>'//newline
      end do
      header = header//'    </Piece>'//newline//'  </UnstructuredGrid>'//newline
      header = header//repeat(' ', max(0, data_start - len(header) - len(last)))//last
      call require(self, self%n_cells >= 0 .and. len(header) == data_start)
      call self%file%put_lines(closing)
      call self%file%close()
      if (self%file%fault) return
      open (newunit=unit, file=self%file%part, status='old', action='readwrite', access='stream', form='unformatted', iostat=status)
      if (status == 0) write (unit, pos=1, iostat=status) header
      if (status == 0) close (unit, iostat=status)
      call require(self, status == 0)
      if (self%file%fault) call self%file%discard()
   end subroutine complete

   !> Complete the file and give it its name. If that fails, OK is false and the file is removed.
   subroutine finish(self, ok)
      class(vtu_file_type), intent(inout) :: self
      logical, intent(out)                :: ok

      call self%complete()
      call self%file%finish(ok)
   end subroutine finish

   !> NAME of an array with the UNIT of its values, if the deck names one.
   pure function named(name, unit) result(words)
      character(*), intent(in)  :: name, unit
      character(:), allocatable :: words

      words = name
      if (unit /= '') words = name//' ['//trim(unit)//']'
   end function named

   !> TEXT escaped for an XML attribute.
   pure function xml_text(text) result(escaped)
      character(*), intent(in)  :: text
      character(:), allocatable :: escaped
      character(*), parameter :: special = '&<>"', entities(4) = [character(6) :: '&amp;', '&lt;', '&gt;', '&quot;']
      integer :: i, k

      escaped = ''
      do i = 1, len(text)
         k = index(special, text(i:i))
         if (k == 0) escaped = escaped//text(i:i)
         if (k > 0) escaped = escaped//trim(entities(k))
      end do
   end function xml_text

   !> The name of piece K of the grid with this INDEX: .2.p0.vtu, .2.p1.vtu of .2.pvtu.
   pure function piece_of(index, k) result(name)
      character(*), intent(in)  :: index
      integer, intent(in)       :: k !! from 0 on
      character(:), allocatable :: name

      name = index(:len(index) - len('pvtu'))//'p'//integer_text(k)//'.vtu'
   end function piece_of

   !> Write the index PATH of N_PIECES pieces. Its arrays are those in the header of the first piece. If a file cannot be read or
   !! written, OK is false and the index is removed.
   subroutine write_index(path, n_pieces, ok)
      character(*), intent(in) :: path
      integer, intent(in)      :: n_pieces
      logical, intent(out)     :: ok
      type(output_file_type)    :: file
      character(:), allocatable :: header
      integer :: i, k, status, unit

      allocate (character(data_start) :: header)
      open (newunit=unit, file=piece_of(path, 0), access='stream', action='read', status='old', iostat=status)
      ok = status == 0
      if (.not. ok) return
      read (unit, iostat=status) header
      ok = status == 0
      close (unit)
      if (.not. ok) return
      call file%start(path)
      call file%put('<?xml version="1.0"?>')
      i = index(header, '<VTKFile')
      k = index(header, '"UnstructuredGrid"')
      call file%put(header(i:k)//'P'//header(k + 1:i + index(header(i:), '>') - 1))
      call file%put('  <PUnstructuredGrid GhostLevel="0">')
      call put_section('Points')
      call put_section('PointData')
      call put_section('CellData')
      do i = 0, n_pieces - 1
         call file%put('    <Piece Source="'//xml_text(piece_of(path(index(path, '/', back=.true.) + 1:), i))//'"/>')
      end do
      call file%put('  </PUnstructuredGrid>')
      call file%put('</VTKFile>')
      call file%finish(ok)

   contains

      !> The arrays of the section TAG, without their offsets in the file.
      subroutine put_section(tag)
         character(*), intent(in) :: tag
         integer :: at, last, length

         at = index(header, '<'//tag//'>')
         last = index(header, '</'//tag//'>')
         call file%put('    <P'//tag//'>')
         do
            length = index(header(at:last), '<DataArray')
            if (length == 0) exit
            at = at + length
            length = index(header(at:last), ' format=') - 1
            call file%put('      <P'//header(at:at + length - 1)//'/>')
         end do
         call file%put('    </P'//tag//'>')
      end subroutine put_section

   end subroutine write_index

   !> Write the list of .vtu files that ParaView opens: the files of each time. If it cannot be written, OK is false and the
   !! list is removed.
   subroutine write_collection(path, times, parts, names, ok)
      character(*), intent(in) :: path
      real(wp), intent(in)     :: times(:) !! ascending
      integer, intent(in)      :: parts(:) !! 0, 1, ... within one time
      character(*), intent(in) :: names(:) !! the .vtu files, relative to the folder of the list
      logical, intent(out)     :: ok
      type(output_file_type) :: file
      character(24) :: time
      integer :: i

      call file%start(path)
      call file%put('<?xml version="1.0"?>')
      call file%put('<VTKFile type="Collection" version="1.0">')
      call file%put('  <Collection>')
      do i = 1, size(names)
         write (time, '(f24.9)') times(i)
         call file%put('    <DataSet timestep="'//trim(adjustl(time))//'" group="" part="'//integer_text(parts(i))//'"')
         call file%put('             file="'//xml_text(trim(names(i)))//'"/>') ! on a line of its own: names may be long
      end do
      call file%put('  </Collection>')
      call file%put('</VTKFile>')
      call file%finish(ok)
   end subroutine write_collection

end module vtu_file
