!> The names of the files for ParaView: how they may end, and which of them an earlier run has left.
module vtu_endings
   use c_library, only: is_regular_file, read_all_bytes
   use incomplete_results, only: remove_old
   use text_tools, only: integer_text
   use vtu_file, only: xml_text
   implicit none
   private

   public :: piece_ending, is_vtu_ending, remove_old_vtu

contains

   !> The ending of piece K behind the name of the deck, of a grid whose index has this ENDING: .2.p0.vtu, .2.p1.vtu of .2.pvtu.
   pure function piece_ending(ending, k) result(of_piece)
      character(*), intent(in)  :: ending
      integer, intent(in)       :: k !! from 0 on
      character(:), allocatable :: of_piece

      of_piece = ending(:len(ending) - len('pvtu'))//'p'//integer_text(k)//'.vtu'
   end function piece_ending

   !> Whether a file of a deck may end so, behind the name of the deck: .vtu, .pvtu and its pieces, .joint.vtu, .modes.vtu, all with the
   !! number of a stage before them, or of a stage and an increment; .pvd.
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

   !> Remove what an earlier run left: the files without a number, and those that its lists name.
   subroutine remove_old_vtu(name)
      character(*), intent(in) :: name

      call remove_old(name//'.vtu')
      call remove_old(name//'.joint.vtu')
      call remove_old(name//'.modes.vtu')
      call remove_list(name, '.pvtu', 'Source="')
      call remove_list(name, '.pvd', 'file="')
   end subroutine remove_old_vtu

   !> Remove the files of NAME that the one with this ENDING names behind MARK, the pieces of those that are indexes, and itself.
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

end module vtu_endings
