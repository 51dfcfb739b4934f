!> The index of a grid that stands in pieces, NAME.pvtu for ParaView: which arrays the pieces have, and their names.
module pvtu_file
   use c_library, only: close_file, open_file, read_bytes
   use kinds, only: long
   use output_file, only: output_file_type
   use vtu_file, only: data_start, xml_text
   implicit none
   private

   public :: write_index

contains

   !> The index PATH of pieces NAMES, as seen from its folder; the arrays are those in the header of the file FIRST, one of the pieces.
   !! OK is false, and no index is left by us, where it cannot be read or written.
   subroutine write_index(path, first, names, ok)
      character(*), intent(in) :: path, first
      character(*), intent(in) :: names(:)
      logical, intent(out)     :: ok
      type(output_file_type)    :: file
      character(:), allocatable :: header
      integer :: i

      call read_header(first, header, ok)
      if (.not. ok) return
      call file%start(path)
      call file%put('<?xml version="1.0"?>')
      i = index(header, '<VTKFile')
      call file%put(replaced(header(i:i + index(header(i:), '>') - 1), '"UnstructuredGrid"', '"PUnstructuredGrid"'))
      call file%put('  <PUnstructuredGrid GhostLevel="0">')
      call put_section('Points')
      call put_section('PointData')
      call put_section('CellData')
      do i = 1, size(names)
         call file%put('    <Piece Source="'//xml_text(trim(names(i)))//'"/>')
      end do
      call file%put('  </PUnstructuredGrid>')
      call file%put('</VTKFile>')
      call file%finish(ok)

   contains

      !> The arrays of the section TAG, without their places in the file.
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

   !> TEXT with BY where THIS stands in it.
   pure function replaced(text, this, by)
      character(*), intent(in)  :: text, this, by
      character(:), allocatable :: replaced
      integer :: i

      i = index(text, this)
      replaced = text(:i - 1)//by//text(i + len(this):)
   end function replaced

   !> The header of the file PATH. OK is false where that cannot be read.
   subroutine read_header(path, header, ok)
      character(*), intent(in)               :: path
      character(:), allocatable, intent(out) :: header
      logical, intent(out)                   :: ok
      integer(long) :: got
      integer :: descriptor, first
      logical :: closed

      allocate (character(data_start) :: header)
      call open_file(path, descriptor)
      ok = descriptor >= 0
      first = 1
      do while (ok .and. first <= data_start)
         call read_bytes(descriptor, header(first:), got)
         ok = got > 0
         first = first + int(got)
      end do
      if (descriptor >= 0) call close_file(descriptor, closed)
   end subroutine read_header

end module pvtu_file
