!> Checks for mixed units: by the wave speed of materials, by gravity, and by the largest stress.
!! The wave speed of a rod, sqrt(E/RHO), is of the order of 1000 m/s in every solid; gravity is 9.81 m/s2; no solid bears a stress
!! of E/50.
module unit_watch
   use deck_input, only: deck_type
   use kinds, only: wp
   use text_tools, only: integer_text, upper
   implicit none
   private

   public :: unit_words, stress_words

   real(wp), parameter :: slowest = 100.0_wp, fastest = 20000.0_wp ! of waves in solids, rubber to diamond [m/s]
   real(wp), parameter :: usual = 5000.0_wp                        ! of metals [m/s]
   character(2), parameter :: lengths(3) = ['MM', 'M ', 'IN']
   real(wp), parameter :: metres(3) = [1.0e-3_wp, 1.0_wp, 0.0254_wp] ! of these units; time in seconds, or in milliseconds with mm
   real(wp), parameter :: gravity(4) = [9810.0_wp, 9.81_wp, 386.1_wp, 0.00981_wp] ! in these units, and in mm and milliseconds
   integer, parameter  :: gravity_unit(4) = [1, 2, 3, 1]
   real(wp), parameter :: least_g = 0.5_wp, most_g = 10.0_wp       ! of gravity: range of GRAV
   real(wp), parameter :: most_strained = 0.02_wp                  ! of E: limit of stresses in solids
   ! wrong units of density in a deck of mm and N, and the factors that convert them
   character(6), parameter :: mistakes(2) = ['kg/m3 ', 'g/cm3 ']
   real(wp), parameter :: remedies(2) = [1.0e-12_wp, 1.0e-9_wp]

contains

   !> A warning for the first MAT1 of DECK whose wave speed is not that of a solid, in UNITS or else in any usual system, with a
   !! guess of the mistake; else for the first GRAV that is not gravity; '' where there is none.
   pure function unit_words(deck) result(words)
      type(deck_type), intent(in) :: deck
      character(:), allocatable   :: words
      real(wp) :: speed, rho
      integer  :: best, i, unit

      words = ''
      unit = findloc(lengths, upper(deck%control%length_unit), dim=1)
      do i = 1, size(deck%bulk%mat1)
         associate (card => deck%bulk%mat1(i))
            rho = deck%bulk%parameters%mass_factor*card%rho
            if (rho <= 0.0_wp .or. card%e <= 0.0_wp) cycle
            speed = sqrt(card%e/rho)
            if (any(is_usual(speed*metres) .and. (unit == 0 .or. [1, 2, 3] == unit))) cycle
            words = 'MAT1 '//integer_text(card%id)//': RHO ='//number(card%rho)//' with E ='//number(card%e)// &
                    ' gives a wave speed sqrt(E/RHO) of no solid in mm, m or inches'
            best = minloc(abs(log(sqrt(card%e/(rho*remedies))*metres(1)/usual)), dim=1)
            if (is_usual(sqrt(card%e/(rho*remedies(best)))*metres(1))) words = words//'; is it '//trim(mistakes(best))// &
               ' in a deck of mm and N? There it would be'//number(card%rho*remedies(best))
            return
         end associate
      end do
      do i = 1, size(deck%bulk%gravity)
         associate (card => deck%bulk%gravity(i), a => norm2(deck%bulk%gravity(i)%acceleration))
            if (card%is_spin .or. a <= 0.0_wp .or. abs(a - 1.0_wp) <= 1.0e-9_wp) cycle ! a LOAD may multiply 1
            if (any(a >= least_g*gravity .and. a <= most_g*gravity .and. (unit == 0 .or. gravity_unit == unit))) cycle
            words = 'GRAV of'//number(a)//' is not gravity; in mm and s that is 9810, in m and s 9.81, in inches and s 386.1'
            return
         end associate
      end do
   end function unit_words

   !> A warning for a structure whose largest von Mises stress is STRAINED times E.
   pure function stress_words(strained) result(words)
      real(wp), intent(in)      :: strained !! [-]
      character(:), allocatable :: words

      words = ''
      if (strained > most_strained) words = 'the largest von Mises stress is'//number(strained)// &
         ' of E, more than solids bear elastically; are loads, lengths and E in one system of units?'
   end function stress_words

   !> Whether SPEED is a wave speed in solids.
   elemental logical function is_usual(speed)
      real(wp), intent(in) :: speed !! [m/s]

      is_usual = speed >= slowest .and. speed <= fastest
   end function is_usual

   !> Text such as ' 7.850E-09'.
   pure function number(value) result(text)
      real(wp), intent(in)      :: value
      character(:), allocatable :: text
      character(12) :: digits

      write (digits, '(es12.3)') value
      text = ' '//trim(adjustl(digits))
   end function number

end module unit_watch
