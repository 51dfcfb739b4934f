!> The XML around the data of a VTK unstructured grid: what stands in the file, and where.
module vtu_header
   use, intrinsic :: iso_fortran_env, only: int8, int32, int64
   implicit none
   private

   public :: header_text, xml_text

   integer, parameter, public :: data_start = 16384 !! length of the header [bytes]: enough for a hundred arrays

   !> The sections of the header that arrays stand in.
   integer, parameter, public :: in_points = 1, in_cells = 2, in_point_data = 3, in_cell_data = 4
   character(*), parameter    :: section_tags(4) = [character(9) :: 'Points', 'Cells', 'PointData', 'CellData']

   !> An array of the file.
   type, public :: array_type
      character(:), allocatable :: name
      character(:), allocatable :: number      !! VTK's word for the kind: Float64, Int32, UInt8
      integer :: section    = 0                !! where it stands in the header
      integer :: components = 1
      integer(int64) :: offset = 0             !! of its length, from data_start [bytes]
   end type array_type

   character(*), parameter :: newline = new_line('a')
   character(*), parameter, public :: closing = newline//'  </AppendedData>'//newline//'</VTKFile>'//newline !! behind the data

contains

   !> The header, at least data_start bytes long: longer where the arrays are too many.
   pure function header_text(n_points, n_cells, arrays) result(text)
      integer(int64), intent(in)   :: n_points, n_cells
      type(array_type), intent(in) :: arrays(:)
      character(:), allocatable    :: text
      character(*), parameter :: last = '  <AppendedData encoding="raw">'//newline//'_'
      integer :: section, i

      text = '<?xml version="1.0"?>'//newline// &
             '<VTKFile type="UnstructuredGrid" version="1.0" byte_order="'//byte_order()//'" header_type="UInt64">'// &
             newline//'  <UnstructuredGrid>'//newline//'    <Piece NumberOfPoints="'//decimal(n_points)// &
             '" NumberOfCells="'//decimal(n_cells)//'">'//newline
      do section = 1, size(section_tags)
         text = text//'      <'//trim(section_tags(section))//'>'//newline
         do i = 1, size(arrays)
            associate (array => arrays(i))
               if (array%section /= section) cycle
               text = text//'        <DataArray type="'//array%number//'" Name="'//xml_text(array%name)//'"'
               if (array%components > 1) & ! some readers make a matrix of one column where the 1 is spelled out
                  text = text//' NumberOfComponents="'//decimal(int(array%components, int64))//'"'
               text = text//' format="appended" offset="'//decimal(array%offset)//'"/>'//newline
            end associate
         end do
         text = text//'      </'//trim(section_tags(section))//'>'//newline
      end do
      text = text//'    </Piece>'//newline//'  </UnstructuredGrid>'//newline
      text = text//repeat(' ', max(0, data_start - len(text) - len(last)))//last
   end function header_text


   !> How the bytes of a number lie in memory, in VTK's words.
   pure function byte_order() result(word)
      character(:), allocatable :: word
      integer(int8) :: bytes(4)

      bytes = transfer(1_int32, bytes)
      if (bytes(1) == 1_int8) then
         word = 'LittleEndian'
      else
         word = 'BigEndian'
      end if
   end function byte_order


   pure function decimal(value) result(text)
      integer(int64), intent(in) :: value
      character(:), allocatable  :: text
      character(20) :: buffer

      write (buffer, '(i0)') value
      text = trim(buffer)
   end function decimal


   !> TEXT as it may stand between the quotes of an XML attribute.
   pure function xml_text(text) result(escaped)
      character(*), intent(in)  :: text
      character(:), allocatable :: escaped
      integer :: i

      escaped = ''
      do i = 1, len(text)
         select case (text(i:i))
         case ('&')
            escaped = escaped//'&amp;'
         case ('<')
            escaped = escaped//'&lt;'
         case ('>')
            escaped = escaped//'&gt;'
         case ('"')
            escaped = escaped//'&quot;'
         case default
            escaped = escaped//text(i:i)
         end select
      end do
   end function xml_text

end module vtu_header
