!> Reads the cards of beam sections, PBAR, PBARL, PBEAM and PBEAML, and of the line load on beams, PLOAD1.
!! The module mesh_cards reads CBAR and CBEAM.
module beam_cards
   use beam_sections, only: section_dimensions, section_names, section_of
   use bulk_data, only: beam_property_card, bulk_data_type
   use card_fields, only: card_fields_type
   use field_rules, only: any_real, not_negative, parse_real, positive, real_range
   use kinds, only: wp
   use tapered_beam, only: beam_station
   use text_tools, only: integer_text
   use tolerances, only: equal_ends
   implicit none
   private

   public :: read_beam_property, read_beam_load

   character(2), parameter :: point_names(8) = ['C1', 'C2', 'D1', 'D2', 'E1', 'E2', 'F1', 'F2']
   character(4), parameter :: dimension_names(6) = ['DIM1', 'DIM2', 'DIM3', 'DIM4', 'DIM5', 'DIM6']
   integer, parameter      :: first_of_station = 17 ! first data field of a PBEAM station
   character(4), parameter :: station_names(7) = ['X/XB', 'A   ', 'I1  ', 'I2  ', 'I12 ', 'J   ', 'NSM ']
   type(real_range), parameter :: share = real_range(0.0_wp, 1.0_wp)
   type(real_range), parameter :: station_ranges(7) = [share, positive, positive, positive, any_real, not_negative, not_negative]
   character(3), parameter, public :: load_types(12) = [character(3) :: 'FX', 'FY', 'FZ', 'MX', 'MY', 'MZ', 'FXE', 'FYE', 'FZE', &
                                                        'MXE', 'MYE', 'MZE']

contains

   !> PBAR and PBEAM give a section by its properties, PBARL and PBEAML by its dimensions. With K1 and K2 of a PBAR blank a beam is
   !! rigid in transverse shear, as in NASTRAN; those of a PBEAM are then 1.
   subroutine read_beam_property(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      real(wp) :: points(8)

      associate (property => bulk%beam_property(card%i), section => bulk%beam_property(card%i)%section)
         property%name = card%name(:6)
         property%line = card%line
         call card%field('PID', property%id)
         call card%field('MID', property%material)
         select case (card%name)
         case ('PBAR')
            call card%field('A', section%area, positive, default=0.0_wp)
            call card%field(['I1', 'I2'], section%inertia(:2), not_negative, default=0.0_wp)
         case ('PBEAM')
            call card%field('A', section%area, positive)
            call card%field(['I1 ', 'I2 ', 'I12'], section%inertia, default=0.0_wp)
         case default
            call read_dimensions(card, property)
            return
         end select
         call card%field('J', section%torsion, not_negative, default=0.0_wp)
         call card%field('NSM', property%extra_mass, not_negative, default=0.0_wp)
         if (card%name == 'PBAR') call card%skip(['-'])
         call card%field(point_names, points, default=0.0_wp)
         section%point = reshape(points, [2, 4])
         if (card%name == 'PBAR') then
            call card%field(['K1', 'K2'], section%shear, not_negative, default=0.0_wp)
            call card%field('I12', section%inertia(3), default=0.0_wp)
            call card%finish(property%line)
         else
            call read_stations(card, property)
         end if
         associate (i => section%inertia) ! I12 squared must be below I1 I2 for a possible section
            if (any(i(:2) < 0.0_wp) .or. (abs(i(3)) > 0.0_wp .and. i(3)**2 >= i(1)*i(2))) &
               call card%error('I12', 'no section has these moments; expected I1 and I2 at least 0 and I12 squared below I1 I2')
         end associate
      end associate
   end subroutine read_beam_property

   !> The rest of a PBEAM: its stations, in any order, and K1, K2. A blank at a station is the value between those of both ends, at end B
   !! that of end A. The shear centre is the centroid: shear relief (S1, S2), NSI and the offsets M and N of mass and neutral axis
   !! must be blank.
   subroutine read_stations(card, property)
      type(card_fields_type), intent(inout)   :: card
      type(beam_property_card), intent(inout) :: property
      type(beam_station), allocatable :: stations(:)
      real(wp), allocatable :: values(:, :)      ! x/L, A, I1, I2, I12, J, NSM of each station, end A first
      logical, allocatable  :: given(:, :)
      real(wp) :: points(8), value
      integer  :: first, k, n
      logical  :: ok

      associate (section => property%section)
         allocate (values(7, 1), source=0.0_wp)
         values(2:, 1) = [section%area, section%inertia, section%torsion, property%extra_mass]
         allocate (given(7, 1), source=.true.)
         section%shear = 1.0_wp
         stations = [beam_station(section)]
         first = first_of_station
         do while (any(card%text_at(first) == ['YES ', 'YESA', 'NO  ']))
            n = size(stations) + 1
            values = reshape([values, spread(0.0_wp, 1, 7)], [7, n])
            given = reshape([given, spread(.true., 1, 7)], [7, n])
            do k = 1, 7
               given(k, n) = card%text_at(first + k) /= ''
               if (given(k, n)) call card%real_at(first + k, trim(station_names(k)), values(k, n), ok, station_ranges(k))
            end do
            if (.not. given(1, n)) call card%error_at(first + 1, 'X/XB: blank, expected the position of the station, 0 to 1')
            points = reshape(section%point, [8])
            if (card%text_at(first) == 'YES') then
               do k = 1, 8
                  points(k) = 0.0_wp
                  if (card%text_at(first + 7 + k) /= '') call card%real_at(first + 7 + k, point_names(k), points(k), ok, any_real)
               end do
            end if
            stations = [stations, beam_station(point=reshape(points, [2, 4]))]
            first = first + merge(16, 8, card%text_at(first) == 'YES')
         end do
         do k = 1, 2
            if (card%text_at(first + k - 1) == '') cycle
            call card%real_at(first + k - 1, 'K'//integer_text(k), section%shear(k), ok, expected='a real number, 0 or more')
         end do
         do k = first + 2, card%n
            if (k == first + 6 .or. k == first + 7) cycle ! CW, without effect where no SA or SB names a point that warps
            call parse_real(card%text_at(k), value, ok)
            if (card%text_at(k) == '' .or. (ok .and. .not. abs(value) > 0.0_wp)) cycle
            call card%error_at(k, ''''//card%text_at(k)//''' where the field must be blank or zero: beams have no '// &
               'shear relief, no offset of their axes and no inertia of NSM')
         end do
         if (card%is_faulty()) return
         k = findloc(values(1, :), 1.0_wp, dim=1)
         if (k == 0) k = 1                       ! no end B: the section of end A
         do n = 2, size(stations)
            associate (ends => (1.0_wp - values(1, n))*values(:, 1) + values(1, n)*values(:, k))
               if (n /= k) where (.not. given(:, n)) values(:, n) = ends
               if (n == k) where (.not. given(:, n)) values(:, n) = values(:, 1)
            end associate
         end do
         stations%at = values(1, :)
         stations%area = values(2, :)
         do n = 1, size(stations)
            stations(n)%inertia = values(3:5, n)
            stations(n)%shear = section%shear
         end do
         stations%torsion = values(6, :)
         stations%extra_mass = values(7, :)
      end associate
      call keep_stations(card, property, stations)
   end subroutine read_stations

   !> Keep STATIONS, the first one end A, in the order of their positions, if the section changes.
   subroutine keep_stations(card, property, stations)
      type(card_fields_type), intent(inout)   :: card
      type(beam_property_card), intent(inout) :: property
      type(beam_station), intent(in)          :: stations(:)
      integer, allocatable :: order(:)
      integer :: k

      if (all([(same(stations(k)), k = 1, size(stations))])) return
      order = [integer ::]
      do while (size(order) < size(stations))
         order = [order, minloc(stations%at, dim=1, mask=[(all(order /= k), k = 1, size(stations))])]
      end do
      property%stations = stations(order)
      associate (s => property%stations, n => size(stations))
         if (abs(s(n)%at - 1.0_wp) > 0.0_wp) property%stations = [s, beam_station(stations(1)%beam_section, 1.0_wp, &
                                                                                  stations(1)%extra_mass)]
      end associate
      associate (s => property%stations)
         if (any(s(2:)%at <= s(:size(s) - 1)%at)) call card%error_at(first_of_station, &
            'two stations in one place; expected X/XB above 0, up to 1, different for each station')
         if (any(s%area <= 0.0_wp) .or. any([(any(s(k)%inertia(:2) <= 0.0_wp), k = 1, size(s))])) call card%error_at( &
            first_of_station, 'the section changes; expected A, I1 and I2 positive at every station')
         if (any([(s(k)%inertia(3)**2 >= s(k)%inertia(1)*s(k)%inertia(2), k = 1, size(s))])) call card%error_at( &
            first_of_station, 'no section has these moments; expected I12 squared below I1 I2 at every station')
      end associate

   contains

      !> Whether STATION has the section of end A.
      pure logical function same(station)
         type(beam_station), intent(in) :: station

         associate (a => [stations(1)%area, stations(1)%inertia, stations(1)%torsion, stations(1)%extra_mass], &
                    b => [station%area, station%inertia, station%torsion, station%extra_mass])
            same = all(abs(b - a) <= equal_ends*abs(a))
         end associate
      end function same

   end subroutine keep_stations

   !> PBARL, PBEAML: TYPE and its dimensions, then NSM; of a PBEAML those of other stations, whose blanks are the values before.
   subroutine read_dimensions(card, property)
      type(card_fields_type), intent(inout)   :: card
      type(beam_property_card), intent(inout) :: property
      type(beam_station), allocatable :: stations(:)
      type(beam_station) :: station
      character(:), allocatable :: expected, words
      real(wp) :: d(6)
      integer  :: first, i, k, n
      logical  :: ok

      call card%skip(['GROUP', 'TYPE ', '-    ', '-    ', '-    ', '-    '])
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
      if (card%name == 'PBARL') call card%finish(property%line)
      if (card%is_faulty()) return
      call section_of(trim(section_names(i)), d(:n), property%section, expected)
      if (expected /= '') call card%error('DIM1', 'these dimensions give no valid '//trim(section_names(i))// &
                                          '; expected '//expected)
      if (card%name == 'PBARL' .or. expected /= '') return
      stations = [beam_station(property%section, 0.0_wp, property%extra_mass)]
      do first = 10 + n, card%n, n + 3             ! SO, X/XB, dimensions, NSM of a station of a PBEAML
         station = stations(1)
         station%at = 1.0_wp
         if (card%text_at(first + 1) /= '') call card%real_at(first + 1, 'X/XB', station%at, ok, station_ranges(1))
         do k = 1, n
            if (card%text_at(first + 1 + k) /= '') call card%real_at(first + 1 + k, dimension_names(k), d(k), ok, positive)
         end do
         if (card%text_at(first + n + 2) /= '') call card%real_at(first + n + 2, 'NSM', station%extra_mass, ok, not_negative)
         if (card%is_faulty()) return
         call section_of(trim(section_names(i)), d(:n), station%beam_section, expected)
         if (expected /= '') call card%error_at(first + 2, 'DIM1: these dimensions give no valid '//trim(section_names(i))// &
                                                '; expected '//expected)
         if (expected /= '') return
         stations = [stations, station]
      end do
      call keep_stations(card, property, stations)
   end subroutine read_dimensions

   !> PLOAD1: a force or moment along a beam, in global axes (FX ... MZ) or beam axes (FXE ... MZE), linear from P1 at X1 to P2 at X2; a
   !! concentrated load where X2 is blank or equals X1. SCALE: X is a length or a fraction of the beam; the load is per unit length of
   !! the beam or, with PR, of its projection on the plane normal to the load.
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
