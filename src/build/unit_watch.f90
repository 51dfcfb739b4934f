!> Checks for mixed units: by the wave speed and E of materials, by c of joints, by gravity, and by the largest stress.
!! The wave speed of a rod, sqrt(E/RHO), is 500 to 15000 m/s in metals, concrete, wood and plastics (steel 5200, lead 1200,
!! beryllium 12400), less in rubber and foam; gravity is 9.81 m/s2; the faces of a joint approach by micrometres; no solid bears a
!! stress of E/50. UNITS of the deck gives the units of length and force where it is there; else any usual system may be meant.
module unit_watch
   use case_control, only: case_control_type
   use deck_errors, only: deck_error_list
   use deck_input, only: deck_type
   use kinds, only: wp
   use model_data, only: joints_type
   use normal_curve, only: loading_deflection
   use text_tools, only: integer_text, one_of, upper
   use tolerances, only: exactly_one, whole_power_of_ten
   implicit none
   private

   public :: watch_units, find_units, stress_words

   real(wp), parameter :: slowest = 500.0_wp, fastest = 15000.0_wp ! of waves in solids [m/s]
   real(wp), parameter :: usual = 5000.0_wp                        ! of metals [m/s]

   ! usual systems: mm and s, m and s, inches and s, mm and ms
   character(2), parameter :: length_name(4) = ['MM', 'M ', 'IN', 'MM']
   real(wp), parameter :: speed_factor(4) = [1.0e-3_wp, 1.0_wp, 0.0254_wp, 1.0_wp] ! to m/s
   real(wp), parameter :: gravity(4) = [9810.0_wp, 9.81_wp, 386.1_wp, 0.00981_wp]
   real(wp), parameter :: least_g = 0.5_wp, most_g = 10.0_wp       ! of gravity: range of GRAV
   character(3), parameter :: force_name(4) = ['N  ', 'KGF', 'KN ', 'LBF']
   real(wp), parameter :: newtons(4) = [1.0_wp, 9.80665_wp, 1.0e3_wp, 4.4482216_wp]
   real(wp), parameter :: metres(3) = [1.0e-3_wp, 1.0_wp, 0.0254_wp] ! of the first three lengths

   real(wp), parameter :: softest = 1.0e6_wp                       ! E of rubber [Pa]
   real(wp), parameter :: as_gpa(2) = [3.0e7_wp, 5.0e8_wp]         ! E of metals in GPa read as N/mm2; few plastics [Pa]
   real(wp), parameter :: as_pa(2) = [1.0e15_wp, 5.0e17_wp]        ! E of solids in Pa read as N/mm2 [Pa]
   real(wp), parameter :: widest = 1.0e-4_wp, one_mpa = 1.0e6_wp   ! approach of faces at 1 N/mm2 [m], [Pa]
   real(wp), parameter :: micron = 1.0e-6_wp                       ! approach of usual faces at 1 N/mm2 [m]
   real(wp), parameter :: wide_share = 0.01_wp                     ! approach of faces at the first pressure, of the size of a joint
   real(wp), parameter :: most_strained = 0.02_wp                  ! of E: limit of stresses in solids

   ! mistakes in a deck of mm and N (1) or of m and N (2), and the factors of RHO and of E that mend them
   integer, parameter :: in_system(8) = [1, 1, 1, 1, 2, 2, 2, 2]
   character(9), parameter :: mistakes(8) = [character(9) :: 'kg/m3', 'g/cm3', 'kg/mm3', 'GPa', 'g/cm3', 't/mm3', 'N/mm2', 'GPa']
   real(wp), parameter :: of_rho(8) = [1.0e-12_wp, 1.0e-9_wp, 1.0e-3_wp, 1.0_wp, 1.0e3_wp, 1.0e12_wp, 1.0_wp, 1.0_wp]
   real(wp), parameter :: of_e(8) = [1.0_wp, 1.0_wp, 1.0_wp, 1.0e3_wp, 1.0_wp, 1.0_wp, 1.0e6_wp, 1.0e9_wp]
   real(wp), parameter :: solid_e(2, 2) = reshape([1.0e2_wp, 1.3e6_wp, 1.0e8_wp, 1.3e12_wp], [2, 2]) ! range [N/mm2], [N/m2]
   real(wp), parameter :: solid_rho(2, 2) = reshape([1.0e-10_wp, 2.5e-8_wp, 1.0e2_wp, 2.5e4_wp], [2, 2]) ! [t/mm3], [kg/m3]

contains

   !> Warn of what contradicts UNITS of DECK, or all usual systems: the first MAT1 whose wave speed, or whose E
   !! where it has no RHO, is not that of a solid; the first JNORM whose faces approach too far; the first GRAV that is not gravity.
   subroutine watch_units(deck, joints, errors)
      type(deck_type), intent(in)          :: deck
      type(joints_type), intent(in) :: joints
      type(deck_error_list), intent(inout) :: errors !! gets the warnings
      logical  :: meant(4) ! systems that UNITS and the wave speeds allow
      real(wp) :: metre, newton, pascals

      meant = length_name == upper(deck%control%length_unit) .or. all(length_name /= upper(deck%control%length_unit))
      call find_units(deck%control, metre, newton)
      pascals = 0.0_wp
      if (metre > 0.0_wp) pascals = newton/metre**2
      call errors%warn(material_words(deck, meant, pascals))
      call errors%warn(approach_words(deck, joints, metre, newton))
      call errors%warn(gravity_words(deck, meant))
   end subroutine watch_units

   !> The units of length and force that UNITS of CONTROL names, 0: not known.
   pure subroutine find_units(control, metre, newton)
      type(case_control_type), intent(in) :: control
      real(wp), intent(out)               :: metre, newton !! of the units [m], [N]
      integer :: i

      metre = 0.0_wp
      newton = 0.0_wp
      i = findloc(length_name, upper(control%length_unit), dim=1)
      if (i > 0) metre = metres(i)
      i = findloc(force_name, upper(control%force_unit), dim=1)
      if (i > 0) newton = newtons(i)
   end subroutine find_units

   !> The first MAT1 that is no solid in any system MEANT, or '' and the systems in which all may be.
   function material_words(deck, meant, pascals) result(words)
      type(deck_type), intent(in) :: deck
      logical, intent(inout)      :: meant(4)
      real(wp), intent(in)        :: pascals !! of the unit of E, 0: not known
      character(:), allocatable   :: words
      real(wp) :: rho, speed
      logical  :: fits(4)
      integer  :: i

      words = ''
      do i = 1, size(deck%bulk%mat1)
         associate (card => deck%bulk%mat1(i))
            rho = deck%bulk%parameters%mass_factor*card%rho
            if (card%e <= 0.0_wp .or. card%name /= 'MAT1') cycle
            if (rho > 0.0_wp) then
               speed = sqrt(card%e/rho)
               fits = meant .and. speed*speed_factor >= slowest .and. speed*speed_factor <= fastest
               if (any(fits)) then
                  meant = fits
                  cycle
               end if
               words = 'MAT1 '//integer_text(card%id)//': RHO ='//number(card%rho)//' with E ='//number(card%e)// &
                       ' gives a wave speed sqrt(E/RHO) of'//speed_text(speed, meant)// &
                       '; metals, concrete, wood and plastics have 500 to 15000 m/s'//guess(card%e, card%rho, rho/card%rho, meant)
               return
            end if
            associate (e => card%e*pascals)
               if (.not. pascals > 0.0_wp) cycle
               if (e < softest) words = 'is softer than rubber'
               if (e >= as_gpa(1) .and. e <= as_gpa(2)) words = 'is that of a soft plastic; is it GPa?'
               if (e >= as_pa(1) .and. e <= as_pa(2) .and. .not. is_power_of_ten(card%e)) words = 'is that of no solid; is it Pa?'
            end associate
            if (words == '') cycle
            words = 'MAT1 '//integer_text(card%id)//': E ='//number(card%e)//' '//trim(deck%control%force_unit)//'/'// &
                    trim(deck%control%length_unit)//'2 '//words
            return
         end associate
      end do
   end function material_words

   !> The wave SPEED in the systems that are MEANT: ' 163.6 m/s', or ' 163.6 m/s in mm, 1.6E+05 m/s in m, ...'.
   pure function speed_text(speed, meant) result(text)
      real(wp), intent(in)      :: speed
      logical, intent(in)       :: meant(4)
      character(:), allocatable :: text
      character(2), parameter :: names(3) = ['mm', 'm ', 'in']
      integer :: s

      text = ''
      do s = 1, 3
         if (.not. meant(s)) cycle
         if (text /= '') text = text//','
         text = text//number(speed*speed_factor(s))//' m/s'
         if (count(meant(:3)) > 1) text = text//' in '//trim(names(s))
      end do
   end function speed_text

   !> The mistake after which E and RHO, times FACTOR, would be those of a solid, as a question; '' where there is none.
   pure function guess(e, rho, factor, meant) result(words)
      real(wp), intent(in)      :: e, rho, factor
      logical, intent(in)       :: meant(4)
      character(:), allocatable :: words
      real(wp) :: distance, least, mended_e, mended_rho
      integer  :: best, i

      words = ''
      best = 0
      least = log(10.0_wp) ! from the usual speed
      do i = 1, size(mistakes)
         associate (s => in_system(i))
            if (.not. meant(s)) cycle
            mended_e = e*of_e(i)
            mended_rho = rho*factor*of_rho(i)
            if (mended_e < solid_e(1, s) .or. mended_e > solid_e(2, s)) cycle
            if (mended_rho < solid_rho(1, s) .or. mended_rho > solid_rho(2, s)) cycle
            distance = abs(log(sqrt(mended_e/mended_rho)*speed_factor(s)/usual))
         end associate
         if (distance >= least) cycle
         least = distance
         best = i
      end do
      if (best == 0) return
      words = '; is '//one_of(of_e(best) > 1.0_wp, 'E', 'RHO')//' in '//trim(mistakes(best))//' in a deck of '// &
              one_of(in_system(best) == 1, 'mm', 'm')//' and N? There it would be'// &
              number(merge(e*of_e(best), rho*of_rho(best), of_e(best) > 1.0_wp))
   end function guess

   !> The first JNORM whose faces approach farther at 1 N/mm2 than those of any surface, or by a visible part of the joint at its
   !! first pressure; '' where there is none.
   function approach_words(deck, joints, metre, newton) result(words)
      type(deck_type), intent(in)  :: deck
      type(joints_type), intent(in) :: joints
      real(wp), intent(in)         :: metre, newton !! of the units of length and force, 0: not known
      character(:), allocatable    :: words
      real(wp) :: approach, pressure
      integer  :: j

      words = ''
      do j = 1, size(joints%list)
         associate (joint => joints%list(j), law => joints%list(j)%law%normal)
            words = 'joint '//integer_text(joint%id)//': c p^m of its JNORM is'
            if (metre > 0.0_wp .and. newton > 0.0_wp) then
               pressure = one_mpa*metre**2/newton
               approach = law%c*pressure**law%m
               if (approach*metre > widest) then
                  words = words//number(approach)//' '//trim(deck%control%length_unit)//' at 1 N/mm2; faces of metals approach '// &
                          'by 0.1 to 10 micrometres there'//conversions(law%c, law%m, pressure, metre)
                  return
               end if
            end if
            approach = loading_deflection(law, joint%p_av)
            if (joint%frame%extent > 0.0_wp .and. approach > wide_share*joint%frame%extent) then
               words = words//number(approach)//' at its first pressure,'//number(joint%p_av)//', more than 1/100 of its size,'// &
                       number(joint%frame%extent)//'; is C in the units of the deck?'
               return
            end if
         end associate
      end do
      words = ''
   end function approach_words

   !> What C would be in the deck if it were one of books, where it would be that of usual faces: '; from mm and N/mm2 C would be ...'.
   pure function conversions(c, m, pressure, metre) result(words)
      real(wp), intent(in)      :: c, m
      real(wp), intent(in)      :: pressure !! 1 N/mm2 in the units of the deck
      real(wp), intent(in)      :: metre    !! of the unit of length
      character(:), allocatable :: words
      character(*), parameter :: units(3) = [character(25) :: 'mm and N/mm2', 'micrometres and N/mm2', 'micrometres and kgf/cm2']
      real(wp), parameter :: length(3) = [1.0e-3_wp, 1.0e-6_wp, 1.0e-6_wp] ! of these units [m]
      real(wp), parameter :: at(3) = [1.0_wp, 1.0_wp, 10.1972_wp]          ! 1 N/mm2 in these units
      real(wp) :: approach
      integer  :: i

      words = ''
      do i = 1, size(units)
         approach = c*at(i)**m*length(i) ! [m]
         if (approach < 0.01_wp*micron .or. approach > 100.0_wp*micron) cycle
         words = words//one_of(words == '', '; from', ', from')//' '//trim(units(i))//' C would be'// &
                 number(approach/metre/pressure**m)
      end do
   end function conversions

   !> The first GRAV that is not gravity in any system MEANT; '' where there is none.
   pure function gravity_words(deck, meant) result(words)
      type(deck_type), intent(in) :: deck
      logical, intent(in)         :: meant(4)
      character(:), allocatable   :: words
      integer :: i

      words = ''
      do i = 1, size(deck%bulk%gravity)
         associate (card => deck%bulk%gravity(i), a => norm2(deck%bulk%gravity(i)%acceleration))
            if (card%is_spin .or. a <= 0.0_wp .or. abs(a - 1.0_wp) <= exactly_one) cycle ! a LOAD may multiply 1
            if (any(a >= least_g*gravity .and. a <= most_g*gravity .and. meant)) cycle
            words = 'GRAV of'//number(a)//' is not gravity; in mm and s that is 9810, in m and s 9.81, in inches and s 386.1'
            if (any(a >= least_g*gravity .and. a <= most_g*gravity)) words = words//'; UNITS or RHO is of another system'
            return
         end associate
      end do
   end function gravity_words

   !> Whether VALUE is a power of ten, as the E of a body that stands for a rigid one.
   pure logical function is_power_of_ten(value)
      real(wp), intent(in) :: value

      is_power_of_ten = abs(log10(value) - anint(log10(value))) < whole_power_of_ten
   end function is_power_of_ten

   !> A warning for a structure whose largest von Mises stress is STRAINED times E.
   pure function stress_words(strained) result(words)
      real(wp), intent(in)      :: strained !! [-]
      character(:), allocatable :: words

      words = ''
      if (strained > most_strained) words = 'the largest von Mises stress is'//number(strained)// &
         ' of E, more than solids bear elastically; are loads, lengths and E in one system of units?'
   end function stress_words

   !> Text such as ' 7.850E-09'.
   pure function number(value) result(text)
      real(wp), intent(in)      :: value
      character(:), allocatable :: text
      character(12) :: digits

      write (digits, '(es12.3)') value
      text = ' '//trim(adjustl(digits))
   end function number

end module unit_watch
