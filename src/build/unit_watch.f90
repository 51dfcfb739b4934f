!> Whether density and modulus of the materials are in one system of units: by the speed of a wave along a rod, sqrt(E/RHO), which is
!! some thousand m/s in every solid.
module unit_watch
   use deck_input, only: deck_type
   use kinds, only: wp
   use text_tools, only: integer_text, upper
   implicit none
   private

   public :: unit_words

   real(wp), parameter :: slowest = 100.0_wp, fastest = 20000.0_wp ! of waves in solids, rubber to diamond [m/s]
   real(wp), parameter :: usual = 5000.0_wp                        ! of metals [m/s]
   character(2), parameter :: lengths(3) = ['MM', 'M ', 'IN']
   real(wp), parameter :: metres(3) = [1.0e-3_wp, 1.0_wp, 0.0254_wp] ! of these; time is in seconds, or in milliseconds with mm
   ! what densities are given in by mistake in a deck of mm and N, and what they must be multiplied by
   character(6), parameter :: mistakes(2) = ['kg/m3 ', 'g/cm3 ']
   real(wp), parameter :: remedies(2) = [1.0e-12_wp, 1.0e-9_wp]

contains

   !> The first MAT1 of DECK whose wave speed is that of no solid in any usual system of units, UNITS = given or not, in words with
   !! a guess; '' where there is none.
   pure function unit_words(deck) result(words)
      type(deck_type), intent(in) :: deck
      character(:), allocatable   :: words
      real(wp) :: speed, rho
      integer  :: best, i

      words = ''
      do i = 1, size(deck%bulk%mat1)
         associate (card => deck%bulk%mat1(i))
            rho = deck%bulk%parameters%mass_factor*card%rho
            if (rho <= 0.0_wp .or. card%e <= 0.0_wp) cycle
            speed = sqrt(card%e/rho)
            if (any(is_usual(speed*metres) .and. (upper(deck%control%length_unit) == lengths .or. &
                                                  all(upper(deck%control%length_unit) /= lengths)))) cycle
            words = 'MAT1 '//integer_text(card%id)//': RHO ='//number(card%rho)//' with E ='//number(card%e)// &
                    ' makes the speed of waves, sqrt(E/RHO), that of no solid in mm, m or inches'
            best = minloc(abs(log(sqrt(card%e/(rho*remedies))*metres(1)/usual)), dim=1)
            if (is_usual(sqrt(card%e/(rho*remedies(best)))*metres(1))) words = words//'; is it '//trim(mistakes(best))// &
               ' in a deck of mm and N? There it would be'//number(card%rho*remedies(best))
            return
         end associate
      end do
   end function unit_words

   !> Whether a SPEED is that of waves in solids.
   elemental logical function is_usual(speed)
      real(wp), intent(in) :: speed !! [m/s]

      is_usual = speed >= slowest .and. speed <= fastest
   end function is_usual

   !> ' 7.850E-09'
   pure function number(value) result(text)
      real(wp), intent(in)      :: value
      character(:), allocatable :: text
      character(12) :: digits

      write (digits, '(es12.3)') value
      text = ' '//trim(adjustl(digits))
   end function number

end module unit_watch
