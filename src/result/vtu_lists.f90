!> The names of the files for ParaView, their removal, and the index files NAME.pvtu and NAME.pvd. NAME.pvtu is the index of the
!! pieces of a grid and names their arrays. NAME.pvd lists the files that belong together, and their times.
module vtu_lists
   use c_library, only: is_regular_file, read_all_bytes
   use incomplete_results, only: remove_old
   use kinds, only: wp
   use output_file, only: output_file_type
   use text_tools, only: integer_text
   use vtu_file, only: data_start, xml_text
   implicit none
   private

   public :: piece_ending, is_vtu_ending, remove_old_vtu, write_index, write_collection

contains

   !> The ending of piece K of a grid whose index has this ENDING: .2.p0.vtu, .2.p1.vtu of .2.pvtu.
   pure function piece_ending(ending, k) result(of_piece)
      character(*), intent(in)  :: ending
      integer, intent(in)       :: k !! from 0 on
      character(:), allocatable :: of_piece

      of_piece = ending(:len(ending) - len('pvtu'))//'p'//integer_text(k)//'.vtu'
   end function piece_ending

   !> Whether ENDING, behind the name of the deck, is that of a file for ParaView: .vtu, .pvtu and its pieces, .joint.vtu,
   !! .modes.vtu, all optionally preceded by the number of a stage, or of a stage and an increment; .pvd.
   pure logical function is_vtu_ending(ending)
      character(*), intent(in) :: ending
      integer :: first, k, length

      is_vtu_ending = ending == '.pvd'
      first = 1
      do k = 0, 2
         is_vtu_ending = is_vtu_ending .or. is_piece_ending(ending(first:)) .or. &
                         any(ending(first:) == [character(10) :: '.vtu', '.pvtu', '.joint.vtu', '.modes.vtu'])
         if (is_vtu_ending .or. len(ending) < first + 2) return
         length = verify(ending(first + 1:), '0123456789') - 1
         if (ending(first:first) /= '.' .or. length < 1) return
         first = first + 1 + length
      end do
   end function is_vtu_ending

   !> Whether ENDING is that of a piece: .p0.vtu, .p1.vtu and so on.
   pure logical function is_piece_ending(ending)
      character(*), intent(in) :: ending
      integer :: length

      is_piece_ending = .false.
      if (len(ending) < len('.p0.vtu')) return
      length = verify(ending(3:), '0123456789') - 1
      is_piece_ending = ending(:2) == '.p' .and. length >= 1 .and. ending(3 + length:) == '.vtu'
   end function is_piece_ending

   !> Remove the files of an earlier run: those without a number, and those in its lists.
   subroutine remove_old_vtu(name)
      character(*), intent(in) :: name

      call remove_old(name//'.vtu')
      call remove_old(name//'.joint.vtu')
      call remove_old(name//'.modes.vtu')
      call remove_list(name, '.pvtu', 'Source="')
      call remove_list(name, '.pvd', 'file="')
   end subroutine remove_old_vtu

   !> Remove the file of NAME with this ENDING, the files that it names behind MARK, and the pieces of those that are indexes.
   recursive subroutine remove_list(name, ending, mark)
      character(*), intent(in) :: name, ending, mark
      character(:), allocatable :: bytes, base, listed
      integer :: at, first
      logical :: ok

      if (.not. is_regular_file(name//ending)) return
      call read_all_bytes(name//ending, bytes, ok)
      if (.not. ok) return
      base = mark//xml_text(name(index(name, '/', back=.true.) + 1:))
      first = 1
      do
         at = index(bytes(first:), base)
         if (at == 0) exit
         first = first + at - 1 + len(base)
         listed = bytes(first:first + index(bytes(first:)//'"', '"') - 2)
         if (.not. is_vtu_ending(listed)) cycle
         if (ending == '.pvd' .and. index(listed, '.pvtu') > 0) call remove_list(name, listed, 'Source="')
         call remove_old(name//listed)
      end do
      call remove_old(name//ending)
   end subroutine remove_list

   !> Write the index with this ENDING of N_PIECES pieces of the deck NAME, its folder included. Its arrays are those in the
   !! header of the first piece. If a file cannot be read or written, OK is false and the index is removed.
   subroutine write_index(name, ending, n_pieces, ok)
      character(*), intent(in) :: name, ending
      integer, intent(in)      :: n_pieces
      logical, intent(out)     :: ok
      type(output_file_type)    :: file
      character(:), allocatable :: header
      integer :: i, k

      call read_header(name//piece_ending(ending, 0), header, ok)
      if (.not. ok) return
      call file%start(name//ending)
      call file%put('<?xml version="1.0"?>')
      i = index(header, '<VTKFile')
      k = index(header, '"UnstructuredGrid"')
      call file%put(header(i:k)//'P'//header(k + 1:i + index(header(i:), '>') - 1))
      call file%put('  <PUnstructuredGrid GhostLevel="0">')
      call put_section('Points')
      call put_section('PointData')
      call put_section('CellData')
      do i = 1, n_pieces
         call file%put('    <Piece Source="'//xml_text(name(index(name, '/', back=.true.) + 1:)//piece_ending(ending, &
                                                                                                              i - 1))//'"/>')
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

   !> The header of the file PATH. OK is false where that cannot be read.
   subroutine read_header(path, header, ok)
      character(*), intent(in)               :: path
      character(:), allocatable, intent(out) :: header
      logical, intent(out)                   :: ok
      integer :: status, unit

      allocate (character(data_start) :: header)
      open (newunit=unit, file=path, access='stream', action='read', status='old', iostat=status)
      ok = status == 0
      if (.not. ok) return
      read (unit, iostat=status) header
      ok = status == 0
      close (unit)
   end subroutine read_header

end module vtu_lists
