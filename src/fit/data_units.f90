!> Units of test data and of decks, by name: how many SI units one of them is.
module data_units
   use kinds, only: wp
   use text_tools, only: upper
   implicit none
   private

   public :: read_system, unit_value, has_force

   real(wp), parameter :: kgf = 9.80665_wp, inch = 0.0254_wp, lbf = 4.4482216152605_wp

   character(6), parameter :: length_names(9) = [character(6) :: 'M', 'CM', 'MM', 'UM', 'MICRON', 'NM', 'IN', 'MIL', 'FT']
   real(wp), parameter     :: lengths(9) = [1.0_wp, 1.0e-2_wp, 1.0e-3_wp, 1.0e-6_wp, 1.0e-6_wp, 1.0e-9_wp, inch, &
                                            1.0e-3_wp*inch, 12.0_wp*inch]
   character(6), parameter :: force_names(7) = [character(6) :: 'N', 'DAN', 'KN', 'KGF', 'KP', 'LBF', 'KIP']
   real(wp), parameter     :: forces(7) = [1.0_wp, 10.0_wp, 1.0e3_wp, kgf, kgf, lbf, 1.0e3_wp*lbf]
   character(6), parameter :: stress_names(7) = [character(6) :: 'PA', 'KPA', 'MPA', 'GPA', 'BAR', 'PSI', 'KSI']
   real(wp), parameter     :: stresses(7) = [1.0_wp, 1.0e3_wp, 1.0e6_wp, 1.0e9_wp, 1.0e5_wp, lbf/inch**2, 1.0e3_wp*lbf/inch**2]

   !> A unit of length and one of stress in SI units, and the words that the user has for them; values 0: none.
   type, public :: unit_system
      real(wp) :: length = 0.0_wp, stress = 0.0_wp
      character(:), allocatable :: length_name, stress_name
   end type unit_system

contains

   !> `mm, kgf` or `um, MPa`: a unit of length, and one of force or stress; with a force the stress is force/length^2.
   pure subroutine read_system(text, system, ok)
      character(*), intent(in)       :: text
      type(unit_system), intent(out) :: system
      logical, intent(out)           :: ok
      character(:), allocatable :: second
      integer :: comma

      comma = index(text//',', ',')
      system%length_name = trim(adjustl(text(:comma - 1)))
      second = trim(adjustl(text(min(comma, len(text)) + 1:)))
      system%length = table_value(plain(system%length_name), length_names, lengths)
      system%stress_name = second
      system%stress = stress_value(plain(second))
      if (table_value(plain(second), force_names, forces) > 0.0_wp) then
         system%stress_name = second//'/'//system%length_name//'2'
         if (system%length > 0.0_wp) system%stress = table_value(plain(second), force_names, forces)/system%length**2
      end if
      ok = system%length > 0.0_wp .and. system%stress > 0.0_wp
   end subroutine read_system

   !> What UNIT is in SI units, 0 where it is no unit of stress or, with STRESS 0, of length.
   pure real(wp) function unit_value(unit, stress) result(value)
      character(*), intent(in) :: unit
      integer, intent(in)      :: stress

      if (stress == 0) value = table_value(plain(unit), length_names, lengths)
      if (stress /= 0) value = stress_value(plain(unit))
   end function unit_value

   !> Whether there is a unit of force with which LENGTH and STRESS [SI] are the units of a deck.
   pure logical function has_force(length, stress)
      real(wp), intent(in) :: length, stress

      has_force = any(abs(forces - stress*length**2) <= 1.0e-9_wp*forces)
   end function has_force

   !> A name of stress, or force/length2.
   pure real(wp) function stress_value(word) result(value)
      character(*), intent(in) :: word
      integer :: slash, last

      value = table_value(word, stress_names, stresses)
      slash = index(word, '/')
      last = len(word)
      if (slash == 0 .or. last < slash + 2) return
      if (word(last:last) /= '2') return
      associate (length => table_value(word(slash + 1:last - 1), length_names, lengths))
         if (length > 0.0_wp) value = table_value(word(:slash - 1), force_names, forces)/length**2
      end associate
   end function stress_value

   pure real(wp) function table_value(word, names, values) result(value)
      character(*), intent(in) :: word, names(:)
      real(wp), intent(in)     :: values(:)
      integer :: k

      k = findloc(names == word, .true., 1)
      value = 0.0_wp
      if (k > 0) value = values(k)
   end function table_value

   !> UNIT in capitals without blanks and ^, the Greek mu as U and raised figures as others.
   pure function plain(unit) result(word)
      character(*), intent(in)  :: unit
      character(:), allocatable :: word
      integer :: k

      word = ''
      do k = 1, len(unit)
         select case (iachar(unit(k:k)))
         case (178, 179)                  ! raised 2 and 3, the second byte of them in UTF-8
            word = word//achar(iachar(unit(k:k)) - 128)
         case (181, 188)                  ! the micro sign, and the second byte of the letter mu
            word = word//'U'
         case (194, 206, iachar(' '), iachar('^'), 9)
            cycle
         case default
            word = word//upper(unit(k:k))
         end select
      end do
   end function plain

end module data_units
