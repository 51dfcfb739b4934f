!> The cards of beams: PBAR, PBARL, PBEAM and PBEAML, their sections, which are constant along a beam; PLOAD1, loads along one. CBAR and
!! CBEAM themselves are read with the edges they share the card with.
module beam_cards
   use beam_sections, only: beam_section, section_dimensions, section_names, section_of
   use bulk_data, only: beam_load_card, beam_property_card, bulk_data_type
   use card_fields, only: card_fields_type
   use field_rules, only: not_negative, parse_real, positive, real_range
   use kinds, only: wp
   use text_tools, only: integer_text
   implicit none
   private

   public :: read_beam_property, read_beam_load

   character(2), parameter :: point_names(8) = ['C1', 'C2', 'D1', 'D2', 'E1', 'E2', 'F1', 'F2']
   character(4), parameter :: dimension_names(6) = ['DIM1', 'DIM2', 'DIM3', 'DIM4', 'DIM5', 'DIM6']
   integer, parameter      :: first_of_station = 17 ! data field of a PBEAM, and how many fields a station has
   character(3), parameter, public :: load_types(12) = [character(3) :: 'FX', 'FY', 'FZ', 'MX', 'MY', 'MZ', 'FXE', 'FYE', 'FZE', &
                                                        'MXE', 'MYE', 'MZE']

contains

   !> PBAR and PBEAM: a section by its numbers; PBARL and PBEAML: by its dimensions.
   subroutine read_beam_property(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk

      bulk%beam_property(card%i)%name = card%name(:6)
      select case (card%name)
      case ('PBAR');  call read_pbar(card, bulk%beam_property(card%i))
      case ('PBEAM'); call read_pbeam(card, bulk%beam_property(card%i))
      case default;   call read_dimensions(card, bulk%beam_property(card%i))
      end select
   end subroutine read_beam_property

   !> PBAR: K1 and K2 left blank, a beam is rigid in transverse shear, as in NASTRAN.
   subroutine read_pbar(card, property)
      type(card_fields_type), intent(inout)    :: card
      type(beam_property_card), intent(inout) :: property

      associate (section => property%section)
         call card%field('PID', property%id)
         call card%field('MID', property%material)
         call card%field('A', section%area, positive, default=0.0_wp)
         call card%field(['I1', 'I2'], section%inertia(:2), not_negative, default=0.0_wp)
         call card%field('J', section%torsion, not_negative, default=0.0_wp)
         call card%field('NSM', property%extra_mass, not_negative, default=0.0_wp)
         call card%skip(['-'])
         call read_points(card, section)
         call card%field(['K1', 'K2'], section%shear, not_negative, default=0.0_wp)
         call card%field('I12', section%inertia(3), default=0.0_wp)
         call card%finish(property%line)
         call check_inertia(card, section)
      end associate
   end subroutine read_pbar

   !> PBEAM: the section at end A; stations further on must have the same. K1 and K2 left blank are 1. The shear centre is the centroid:
   !! warping (CW), taper in shear (S1, S2), NSI and the offsets M and N of mass and neutral axis must be blank.
   subroutine read_pbeam(card, property)
      type(card_fields_type), intent(inout)    :: card
      type(beam_property_card), intent(inout) :: property
      real(wp) :: value
      integer  :: first, k
      logical  :: ok

      associate (section => property%section)
         call card%field('PID', property%id)
         call card%field('MID', property%material)
         call card%field('A', section%area, positive)
         call card%field(['I1 ', 'I2 ', 'I12'], section%inertia, default=0.0_wp)
         call card%field('J', section%torsion, not_negative, default=0.0_wp)
         call card%field('NSM', property%extra_mass, not_negative, default=0.0_wp)
         call read_points(card, section)
         property%line = card%line
         section%shear = 1.0_wp
         first = first_of_station
         do while (any(card%text_at(first) == ['YES ', 'YESA', 'NO  ']))
            do k = 3, 8
               if (card%text_at(first + k - 1) == '') cycle
               call parse_real(card%text_at(first + k - 1), value, ok)
               if (ok) ok = abs(value - at_end_a(k)) <= 1.0e-6_wp*abs(at_end_a(k))
               if (.not. ok) call card%error_at(first + k - 1, ''''//card%text_at(first + k - 1)//''' differs from the section '// &
                  'at end A; expected a beam of constant section, or a chain of beams with sections of their own')
            end do
            first = first + merge(16, 8, card%text_at(first) == 'YES')
         end do
         do k = 1, 2
            if (card%text_at(first + k - 1) == '') cycle
            call card%real_at(first + k - 1, 'K'//integer_text(k), 'a real number, 0 or more', section%shear(k), ok)
         end do
         do k = first + 2, card%n
            call parse_real(card%text_at(k), value, ok)
            if (card%text_at(k) == '' .or. (ok .and. .not. abs(value) > 0.0_wp)) cycle
            call card%error_at(k, ''''//card%text_at(k)//''' where the field must be blank or zero: beams have no warping, no '// &
               'taper and no offset of their axes')
         end do
         call check_inertia(card, section)
      end associate

   contains

      !> What field K of a station is at end A.
      pure real(wp) function at_end_a(k)
         integer, intent(in) :: k

         associate (section => property%section)
            select case (k)
            case (3);     at_end_a = section%area
            case (4:6);   at_end_a = section%inertia(k - 3)
            case (7);     at_end_a = section%torsion
            case default; at_end_a = property%extra_mass
            end select
         end associate
      end function at_end_a

   end subroutine read_pbeam

   subroutine read_points(card, section)
      type(card_fields_type), intent(inout) :: card
      type(beam_section), intent(inout)     :: section
      real(wp) :: points(8)

      call card%field(point_names, points, default=0.0_wp)
      section%point = reshape(points, [2, 4])
   end subroutine read_points

   !> I12 squared is below I1 I2: a section that can be.
   subroutine check_inertia(card, section)
      type(card_fields_type), intent(inout) :: card
      type(beam_section), intent(in)        :: section

      associate (i => section%inertia)
         if (any(i(:2) < 0.0_wp) .or. (abs(i(3)) > 0.0_wp .and. i(3)**2 >= i(1)*i(2))) &
            call card%error('I12', 'no section has these moments; expected I1 and I2 at least 0 and I12 squared below I1 I2')
      end associate
   end subroutine check_inertia

   !> PBARL, PBEAML: TYPE and its dimensions, then NSM.
   subroutine read_dimensions(card, property)
      type(card_fields_type), intent(inout)    :: card
      type(beam_property_card), intent(inout) :: property
      character(:), allocatable :: expected, words
      real(wp) :: d(6)
      integer  :: i, n
      logical  :: ok

      call card%field('PID', property%id)
      call card%field('MID', property%material)
      call card%skip(['GROUP', 'TYPE ', '-    ', '-    ', '-    ', '-    '])
      property%line = card%line
      i = 0
      if (card%text_at(4) /= '') i = findloc(section_names, card%text_at(4), dim=1)
      if (i == 0) then
         words = trim(section_names(1))
         do n = 2, size(section_names)
            words = words//', '//trim(section_names(n))
         end do
         call card%wrong_entry(4, 'TYPE', 'is not a section of jointfem, expected one of '//words)
         return
      end if
      n = section_dimensions(i)
      call card%field(dimension_names(:n), d(:n), positive)
      call card%field('NSM', property%extra_mass, not_negative, default=0.0_wp)
      call card%finish(property%line)
      if (card%is_faulty()) return
      call section_of(trim(section_names(i)), d(:n), property%section, expected)
      ok = expected == ''
      if (.not. ok) call card%error('DIM1', 'these dimensions give no valid '//trim(section_names(i))//'; expected '//expected)
   end subroutine read_dimensions

   !> PLOAD1: a force or moment along a beam, global (FX ... MZ) or in its axes (FXE ... MZE), between X1 and X2 linear from P1 to P2; X2
   !! blank or equal to X1: at X1 alone. SCALE: X is a length or a fraction of the beam, the load one a unit of the beam's length or, with PR,
   !! of its length projected onto the plane across the load.
   subroutine read_beam_load(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      character(8) :: kind, scale

      associate (load => bulk%beam_load(card%i))
         call card%field('SID', load%set)
         call card%field('EID', load%element)
         call card%word('TYPE', '|FX|FY|FZ|MX|MY|MZ|FXE|FYE|FZE|MXE|MYE|MZE|', kind)
         call card%word('SCALE', '|LE|FR|LEPR|FRPR|', scale)
         call card%field('X1', load%x(1), not_negative)
         call card%field('P1', load%p(1))
         call card%field('X2', load%x(2), not_negative, default=load%x(1))
         call card%field('P2', load%p(2), default=load%p(1))
         call card%finish(load%line)
         load%kind = findloc(load_types, kind(:3), dim=1)
         load%is_fraction = scale(:2) == 'FR'
         load%is_projected = scale(3:) == 'PR'
         if (load%is_fraction .and. any(load%x > 1.0_wp)) call card%error('X1', &
            'a fraction of the beam; expected X1 and X2 up to 1')
         if (load%x(2) < load%x(1)) call card%error('X2', 'below X1; expected X1 before X2')
      end associate
   end subroutine read_beam_load

end module beam_cards
