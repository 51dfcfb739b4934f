!> Numbers for the fields of a card: the most digits that the columns hold.
module field_numbers
   use deck_numbers, only: parse_real
   use kinds, only: wp
   implicit none
   private

   public :: real_field_text

contains

   !> VALUE in at most WIDTH columns, as NASTRAN writes it: the nearest number that fits, as 0.0125, 260.8628 or, where that
   !! is nearer, in the short form with an exponent, 1.2346-5. It always has a decimal point, and reads back by parse_real.
   function real_field_text(value, width) result(text)
      real(wp), intent(in)      :: value !! |value| below 1E99 and not below 1E-99, or zero
      integer, intent(in)       :: width !! 7 to 16
      character(:), allocatable :: text
      character(40) :: entry, best
      real(wp) :: least
      integer  :: decimals

      best = '0.0'
      least = huge(least)
      do decimals = 1, width - 1
         call plain_form(value, decimals, width, entry)
         call consider()
      end do
      call plain_form(value, 0, width, entry)
      call consider()
      do decimals = 0, width - 2
         call short_form(value, decimals, entry)
         call consider()
      end do
      text = trim(best)

   contains

      !> Keep ENTRY where it fits and is nearer to VALUE than the best before it.
      subroutine consider()
         real(wp) :: error, read_back
         logical  :: ok

         if (len_trim(entry) > width) return
         call parse_real(trim(entry), read_back, ok)
         if (.not. ok) return
         error = abs(read_back - value)
         if (error >= least) return
         least = error
         best = entry
      end subroutine consider

   end function real_field_text


   !> VALUE with DECIMALS digits behind the point; a zero before the point where there is room, none where not.
   subroutine plain_form(value, decimals, width, entry)
      real(wp), intent(in)      :: value
      integer, intent(in)       :: decimals, width
      character(*), intent(out) :: entry
      character(12) :: layout
      integer :: status

      entry = repeat('*', len(entry))
      if (abs(value) >= 1.0e16_wp) return
      write (layout, '(a, i0, a)') '(f0.', decimals, ')'
      write (entry, layout, iostat=status) value
      if (status /= 0) entry = repeat('*', len(entry))
      if (len_trim(entry) >= width) return
      if (entry(1:1) == '.') entry = '0'//entry
      if (entry(1:2) == '-.') entry = '-0'//entry(2:)
   end subroutine plain_form


   !> VALUE with one digit before the point, DECIMALS behind it and an exponent without E: -1.25+7.
   subroutine short_form(value, decimals, entry)
      real(wp), intent(in)      :: value
      integer, intent(in)       :: decimals
      character(*), intent(out) :: entry
      character(16) :: layout
      integer :: e, first

      write (layout, '(a, i0, a)') '(es40.', decimals, 'e3)'
      write (entry, layout) value
      entry = adjustl(entry)
      e = index(entry, 'E')
      first = e + 2
      do while (entry(first:first) == '0' .and. entry(first + 1:first + 1) /= ' ')
         first = first + 1
      end do
      entry = entry(:e - 1)//entry(e + 1:e + 1)//entry(first:)
   end subroutine short_form

end module field_numbers
