!> Compares the bodies in pieces with the same bodies in one file, with a reader of its own.
!!
!!    compare_pieces WHOLE.vtu INDEX.pvtu SHARE
!!
!! Every element of WHOLE must stand in exactly one piece, every node in at least one, in the same place and with the same
!! neighbours in its elements. Values may differ by SHARE of the largest of their array, principal stresses by 6E-8: two equal
!! principal stresses are exact only to the root of rounding. A node in several pieces has the same values to the last bit; names,
!! types and components of the arrays are those of the index. Prints a fault and ends with status 1, or prints how many pieces have
!! elements, and how many nodes stand in several pieces.
program compare_pieces
   use, intrinsic :: iso_fortran_env, only: int32, int64, int8, real64
   implicit none

   type :: array_type
      character(64) :: name = '', kind = '', section = ''
      integer :: components = 1
      real(real64), allocatable :: values(:, :)
   end type array_type

   type :: grid_type
      integer :: n_points = 0, n_cells = 0
      type(array_type), allocatable :: arrays(:)
   end type grid_type

   character(1024) :: argument(3)
   character(:), allocatable :: folder, text
   type(grid_type) :: whole, piece
   type(array_type), allocatable :: listed(:)
   integer, allocatable :: node_of(:), element_of(:)   ! of whole, by number
   integer, allocatable :: shown(:), cells(:)          ! in how many pieces each node and element of it stands
   type(array_type), allocatable :: first(:)           ! the values at nodes as the first piece that had them has them
   real(real64) :: share
   integer :: at, i, length, with_elements

   do i = 1, 3
      call get_command_argument(i, argument(i))
   end do
   read (argument(3), *) share
   call read_grid(trim(argument(1)), whole)
   call number(whole, 'PointData', 'node', node_of)
   call number(whole, 'CellData', 'element', element_of)
   allocate (shown(whole%n_points), cells(whole%n_cells), source=0)
   first = whole%arrays
   with_elements = 0
   call read_bytes(trim(argument(2)), text)
   call read_arrays(text, 'PDataArray', 'P', listed)
   call same_arrays(listed, whole%arrays, 'the index')
   folder = argument(2)(:index(argument(2), '/', back=.true.))
   at = 1
   do
      length = index(text(at:), '<Piece Source="')
      if (length == 0) exit
      at = at + length + len('<Piece Source="') - 1
      length = index(text(at:), '"') - 1
      call read_grid(folder//text(at:at + length - 1), piece)
      call compare(piece, text(at:at + length - 1))
      if (piece%n_cells > 0) with_elements = with_elements + 1
   end do
   if (any(cells /= 1)) call wrong('an element stands in no piece, or in several')
   if (any(shown == 0)) call wrong('a node stands in no piece')
   print '(i0,1x,i0)', with_elements, count(shown > 1)

contains

   subroutine wrong(words)
      character(*), intent(in) :: words

      print '(2a)', trim(argument(2))//': ', words
      error stop 1, quiet=.true.
   end subroutine wrong

   !> All values of PIECE against those of the whole.
   subroutine compare(piece, name)
      type(grid_type), intent(in)  :: piece
      character(*), intent(in)     :: name
      integer :: node(piece%n_points), element(piece%n_cells), k

      call same_arrays(piece%arrays, whole%arrays, name)
      node = node_of(nint(values(piece, 'PointData', 'node')))
      element = element_of(nint(values(piece, 'CellData', 'element')))
      if (any(node == 0) .or. any(element == 0)) call wrong(name//' has a node or an element that the whole has not')
      call compare_cells(piece, name, node, element)
      do k = 1, size(whole%arrays)
         associate (expected => whole%arrays(k), found => piece%arrays(k))
            if (expected%section == 'CellData') call near(found%values, expected%values(:, element), expected, name)
            if (expected%section /= 'PointData' .and. expected%section /= 'Points') cycle
            call near(found%values, expected%values(:, node), expected, name)
            do i = 1, piece%n_points
               if (shown(node(i)) > 0) then
                  if (any(abs(found%values(:, i) - first(k)%values(:, node(i))) > 0.0_real64)) call wrong(name//': another '// &
                        trim(expected%name)//' at a node than in the piece before')
               end if
               first(k)%values(:, node(i)) = found%values(:, i)
            end do
         end associate
      end do
      cells(element) = cells(element) + 1
      shown(node) = shown(node) + 1
   end subroutine compare

   !> Types of the cells, and their nodes as the whole numbers them.
   subroutine compare_cells(piece, name, node, element)
      type(grid_type), intent(in) :: piece
      character(*), intent(in)    :: name
      integer, intent(in)         :: node(:), element(:)
      integer, allocatable :: here(:), there(:), ends(:), all_ends(:), types(:)
      integer :: c

      if (piece%n_cells == 0) return
      here = nint(values(piece, 'Cells', 'connectivity')) + 1
      there = nint(values(whole, 'Cells', 'connectivity')) + 1
      ends = [0, nint(values(piece, 'Cells', 'offsets'))]
      all_ends = [0, nint(values(whole, 'Cells', 'offsets'))]
      types = nint(values(whole, 'Cells', 'types'))
      if (any(nint(values(piece, 'Cells', 'types')) /= types(element))) call wrong(name//': another kind of element')
      do c = 1, piece%n_cells
         if (ends(c + 1) - ends(c) /= all_ends(element(c) + 1) - all_ends(element(c))) call wrong(name//': more nodes or less')
         if (any(node(here(ends(c) + 1:ends(c + 1))) /= there(all_ends(element(c)) + 1:all_ends(element(c) + 1)))) &
            call wrong(name//': an element on other nodes')
      end do
   end subroutine compare_cells

   !> FOUND as EXPECTED, to a share of the largest value of the array OF.
   subroutine near(found, expected, of, name)
      real(real64), intent(in)     :: found(:, :), expected(:, :)
      type(array_type), intent(in) :: of
      character(*), intent(in)     :: name
      real(real64), parameter :: of_equal_roots = 4.0_real64*sqrt(epsilon(1.0_real64))
      real(real64) :: allowed, largest, off

      if (size(found) == 0) return
      allowed = merge(share, 0.0_real64, of%kind == 'Float64' .and. of%section /= 'Points')
      if (index(of%name, 'principal_stress') == 1) allowed = max(allowed, of_equal_roots)
      largest = maxval(abs(of%values))
      off = maxval(abs(found - expected))
      if (.not. off <= allowed*largest) then
         print '(2a,es9.2,a,es9.2)', trim(of%name), ': off by ', off, ', the largest is ', largest
         call wrong(name)
      end if
   end subroutine near

   !> The same names, kinds and components in the same order; an index does not name what makes the cells.
   subroutine same_arrays(found, expected, where)
      type(array_type), intent(in) :: found(:), expected(:)
      character(*), intent(in)     :: where
      integer :: k, m

      m = 0
      do k = 1, size(expected)
         if (where == 'the index' .and. expected(k)%section == 'Cells') cycle
         m = m + 1
         if (m > size(found)) call wrong(where//' lacks '//trim(expected(k)%name))
         if (found(m)%name /= expected(k)%name .or. found(m)%kind /= expected(k)%kind .or. &
             found(m)%section /= expected(k)%section .or. found(m)%components /= expected(k)%components) &
            call wrong(where//' has another array than '//trim(expected(k)%name))
      end do
      if (m /= size(found)) call wrong(where//' has more arrays')
   end subroutine same_arrays

   !> The array NAME of one component.
   function values(grid, section, name)
      type(grid_type), intent(in) :: grid
      character(*), intent(in)    :: section, name
      real(real64), allocatable :: values(:)
      integer :: k

      do k = 1, size(grid%arrays)
         if (grid%arrays(k)%name == name .and. grid%arrays(k)%section == section) then
            values = reshape(grid%arrays(k)%values, [size(grid%arrays(k)%values)])
            return
         end if
      end do
      call wrong('there is no '//name)
   end function values

   !> PLACE: where the node or element of each number stands in GRID, 0: nowhere.
   subroutine number(grid, section, name, place)
      type(grid_type), intent(in)       :: grid
      character(*), intent(in)          :: section, name
      integer, allocatable, intent(out) :: place(:)
      integer, allocatable :: ids(:)
      integer :: k

      ids = nint(values(grid, section, name))
      allocate (place(0:maxval(ids)), source=0)
      do k = 1, size(ids)
         if (place(ids(k)) > 0) call wrong('two have one number')
         place(ids(k)) = k
      end do
   end subroutine number

   subroutine read_bytes(path, bytes)
      character(*), intent(in)               :: path
      character(:), allocatable, intent(out) :: bytes
      integer :: n, status, unit

      open (newunit=unit, file=path, access='stream', form='unformatted', action='read', status='old', iostat=status)
      if (status /= 0) call wrong('there is no '//path)
      inquire (unit=unit, size=n)
      allocate (character(n) :: bytes)
      read (unit) bytes
      close (unit)
   end subroutine read_bytes

   subroutine read_grid(path, grid)
      character(*), intent(in)     :: path
      type(grid_type), intent(out) :: grid
      character(:), allocatable :: bytes
      integer :: data_start

      call read_bytes(path, bytes)
      grid%n_points = integer_in(bytes, 'NumberOfPoints="')
      grid%n_cells = integer_in(bytes, 'NumberOfCells="')
      data_start = index(bytes, '<AppendedData encoding="raw">')
      data_start = data_start + index(bytes(data_start:), '_') - 1
      call read_arrays(bytes(:data_start), 'DataArray', '', grid%arrays, bytes(data_start + 1:))
   end subroutine read_grid

   !> The arrays that TEXT names by TAG in sections with PREFIX; with DATA their values.
   subroutine read_arrays(text, tag, prefix, arrays, data)
      character(*), intent(in) :: text, tag, prefix
      type(array_type), allocatable, intent(out) :: arrays(:)
      character(*), intent(in), optional :: data
      character(*), parameter :: sections(4) = [character(9) :: 'Points', 'Cells', 'PointData', 'CellData']
      type(array_type) :: one
      integer :: at, last, s, length

      allocate (arrays(0))
      do s = 1, size(sections)
         at = index(text, '<'//prefix//trim(sections(s))//'>')
         if (at == 0) cycle
         last = index(text, '</'//prefix//trim(sections(s))//'>')
         do
            length = index(text(at:last), '<'//tag//' ')
            if (length == 0) exit
            at = at + length
            associate (line => text(at:at + index(text(at:), '/>')))
               one%name = text_in(line, 'Name="')
               one%kind = text_in(line, 'type="')
               one%section = sections(s)
               one%components = 1
               if (index(line, 'NumberOfComponents') > 0) one%components = integer_in(line, 'NumberOfComponents="')
               if (present(data)) call read_values(data(integer_in(line, 'offset="') + 1:), one)
            end associate
            arrays = [arrays, one]
         end do
      end do
   end subroutine read_arrays

   !> The values of ARRAY, which BYTES begin with: their length in bytes, and they.
   subroutine read_values(bytes, array)
      character(*), intent(in)        :: bytes
      type(array_type), intent(inout) :: array
      integer :: n

      n = int(transfer(bytes(:8), 0_int64))
      if (allocated(array%values)) deallocate (array%values)
      select case (array%kind)
      case ('Float64')
         array%values = reshape(transfer(bytes(9:8 + n), [0.0_real64]), [array%components, n/8/array%components])
      case ('Int32')
         array%values = reshape(real(transfer(bytes(9:8 + n), [0_int32]), real64), [array%components, n/4/array%components])
      case ('UInt8')
         array%values = reshape(real(transfer(bytes(9:8 + n), [0_int8]), real64), [array%components, n/array%components])
      case default
         call wrong('numbers of kind '//array%kind)
      end select
   end subroutine read_values

   !> What stands behind MARK up to the next quote.
   function text_in(text, mark)
      character(*), intent(in)  :: text, mark
      character(:), allocatable :: text_in
      integer :: at

      at = index(text, mark) + len(mark)
      text_in = text(at:at + index(text(at:), '"') - 2)
   end function text_in

   integer function integer_in(text, mark)
      character(*), intent(in) :: text, mark
      character(24) :: digits

      digits = text_in(text, mark)
      read (digits, *) integer_in
   end function integer_in

end program compare_pieces
