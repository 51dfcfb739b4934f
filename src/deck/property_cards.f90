!> Reads the cards of properties, materials, beam sections and beam loads, and PARAM.
!! Properties and materials: PSHELL, PAXIS, PSOLID, PROD, CONROD, MAT1. Beams: PBAR, PBARL, PBEAM, PBEAML, and the line load
!! PLOAD1. The module mesh_cards reads CBAR and CBEAM.
module property_cards
   use beam_sections, only: section_dimensions, section_names, section_of
   use bulk_data, only: beam_property_card, bulk_data_type, conrod_card, prod_card, property_card
   use card_fields, only: card_fields_type
   use elasticity, only: axisymmetric, plane_strain, plane_stress, solid
   use field_rules, only: any_real, not_negative, parse_real, positive, real_range
   use kinds, only: wp
   use nastran_compatibility, only: take_parameter
   use tapered_beam, only: beam_station
   use text_tools, only: integer_text, real_text
   use tolerances, only: equal_ends
   implicit none
   private

   public :: read_pshell, read_body_property, read_rod, read_mat1, read_parameter, read_beam_property, read_beam_load

   character(2), parameter :: point_names(8) = ['C1', 'C2', 'D1', 'D2', 'E1', 'E2', 'F1', 'F2']
   character(4), parameter :: dimension_names(6) = ['DIM1', 'DIM2', 'DIM3', 'DIM4', 'DIM5', 'DIM6']
   integer, parameter      :: first_of_station = 17 ! first data field of a PBEAM station
   character(4), parameter :: station_names(7) = ['X/XB', 'A   ', 'I1  ', 'I2  ', 'I12 ', 'J   ', 'NSM ']
   type(real_range), parameter :: share = real_range(0.0_wp, 1.0_wp)
   type(real_range), parameter :: station_ranges(7) = [share, positive, positive, positive, any_real, not_negative, not_negative]
   character(3), parameter, public :: load_types(12) = [character(3) :: 'FX', 'FY', 'FZ', 'MX', 'MY', 'MZ', 'FXE', 'FYE', 'FZE', &
                                                        'MXE', 'MYE', 'MZE']

contains

   !> PSHELL: in the plane a membrane of thickness T; MID2 = -1 is plane strain, otherwise plane stress. MODES = YES on a continuation
   !! adds the incompatible modes of Wilson and Taylor; bending data have no effect there. In space a shell: MID1 membrane (blank: none,
   !! the mass is that of MID2), MID2 and 12I/T**3 bending, MID3 and TS/T transverse shear, Z1 and Z2 the fibres of stress output.
   subroutine read_pshell(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      character(8) :: modes
      real(wp) :: number
      logical  :: is_number

      associate (property => bulk%pshell(card%i))
         call card%field('PID', property%id)
         property%bends_alone = (card%text_at(2) == '' .or. card%text_at(2) == '0') .and. card%text_at(4) /= ''
         if (property%bends_alone) then
            call card%skip(['MID1'])
         else
            call card%field('MID1', property%material)
         end if
         call card%field('T', property%thickness, positive)
         call card%field('MID2', property%bending, default=0, least=-1)
         if (property%bends_alone) property%material = property%bending
         call card%field('12I/T**3', property%inertia_ratio, positive, default=1.0_wp)
         call card%field('MID3', property%shear, default=0)
         call card%field('TS/T', property%shear_ratio, positive, default=5.0_wp/6.0_wp)
         call card%field('NSM', property%extra_mass, not_negative, default=0.0_wp)
         modes = card%text_at(9) ! Z1, or MODES of a membrane
         call parse_real(card%text_at(9), number, is_number)
         if (is_number) then
            call card%field('Z1', property%fibre(1), default=0.0_wp)
            modes = 'NO'
         else
            call card%word('MODES', '|NO|YES|', modes)
         end if
         call card%field('Z2', property%fibre(2), default=0.0_wp)
         call card%blank(['MID4'])
         call card%finish(property%line)
         property%fibre_given = [is_number, card%text_at(10) /= '']
         where (.not. property%fibre_given) property%fibre = [-0.5_wp, 0.5_wp]*property%thickness
         property%state = merge(plane_strain, plane_stress, property%bending == -1)
         property%incompatible = modes == 'YES'
      end associate
   end subroutine read_pshell

   !> PAXIS: a body of revolution about y; its mesh lies in x >= 0. PSOLID: solids. CHEXA of 8 and CPENTA of 6 nodes have
   !! incompatible modes, as NASTRAN's have bubble functions, unless ISOP selects full integration. NASTRAN's reduced shear
   !! integration without bubble functions is not available; the incompatible modes also remove parasitic shear in bending. Output
   !! requests and the system of an isotropic material have no effect.
   subroutine read_body_property(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      type(property_card) :: property
      character(8) :: isop, other

      call card%field('PID', property%id)
      call card%field('MID', property%material)
      if (card%name == 'PAXIS') then
         call card%finish(property%line)
         property%state = axisymmetric
         bulk%paxis(card%i) = property
      else
         call card%skip(['CORDM'])
         call card%word('IN', '|BUBBLE|GAUSS|TWO|THREE|0|1|2|3|', other)
         call card%skip(['STRESS'])
         call card%word('ISOP', '|MODES|PLAIN|FULL|REDUCED|0|1|2|3|', isop)
         call card%word('FCTN', '|SMECH|', other)
         call card%finish(property%line)
         property%state = solid
         property%incompatible = index('|PLAIN|FULL|1|2|3|', '|'//trim(isop)//'|') == 0
         bulk%psolid(card%i) = property
      end if
   end subroutine read_body_property

   !> PROD: a bar of cross-section A with the torsion constant J; C has no effect. CONROD: a CROD and its PROD on one card. PTUBE: the
   !! section of a tube.
   subroutine read_rod(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      type(conrod_card) :: rod

      if (card%name == 'PTUBE') then
         call read_tube(card, bulk%prod(card%i))
         return
      else if (card%name == 'PROD') then
         call card%field('PID', rod%id)
      else
         call card%field('EID', rod%id)
         call card%field(['G1', 'G2'], rod%nodes)
      end if
      call card%field('MID', rod%material)
      call card%field('A', rod%area, positive)
      call card%field('J', rod%torsion, not_negative, default=0.0_wp)
      call card%skip(['C'])
      call card%field('NSM', rod%extra_mass, not_negative, default=0.0_wp)
      call card%finish(rod%line)
      if (card%name == 'PROD') then
         bulk%prod(card%i) = rod%prod_card
      else
         bulk%conrod(card%i) = rod
      end if
   end subroutine read_rod

   !> PTUBE: outer diameter OD and wall T, 0 a solid rod. With another diameter OD2 at the second end a tube with the same wall and the
   !! same axial stiffness, of the mean wall diameter (OD - OD2)/ln((OD - T)/(OD2 - T)).
   subroutine read_tube(card, tube)
      type(card_fields_type), intent(inout) :: card
      type(prod_card), intent(inout)        :: tube
      real(wp), parameter :: pi = acos(-1.0_wp)
      real(wp) :: ends(2), mean, wall

      call card%field('PID', tube%id)
      call card%field('MID', tube%material)
      call card%field('OD', ends(1), positive)
      call card%field('T', wall, not_negative, default=0.0_wp)
      call card%field('NSM', tube%extra_mass, not_negative, default=0.0_wp)
      call card%field('OD2', ends(2), not_negative, default=ends(1))
      call card%finish(tube%line)
      if (card%is_faulty()) return
      if (.not. ends(2) > 0.0_wp) ends(2) = ends(1)
      if (2.0_wp*wall > minval(ends)) call card%error('T', 'more than half the diameter; expected the wall, or 0 for a solid rod')
      if (.not. wall > 0.0_wp .and. abs(ends(1) - ends(2)) > 0.0_wp) call card%error('OD2', 'differs from OD; expected a wall T')
      if (.not. wall > 0.0_wp) wall = 0.5_wp*minval(ends)
      if (card%is_faulty()) return
      mean = ends(1) - wall
      if (abs(ends(1) - ends(2)) > equal_ends*ends(1)) mean = (ends(1) - ends(2))/log((ends(1) - wall)/(ends(2) - wall))
      tube%area = pi*wall*mean
      tube%torsion = 0.25_wp*tube%area*(mean**2 + wall**2)
   end subroutine read_tube

   !> MAT1: two of E, G and NU suffice, with G = E/(2 (1 + NU)); E suffices for bars. Of all three, G
   !! holds for torsion and transverse shear, with a warning where they differ by more than one per cent. Of the
   !! stress limits, the limit in tension is compared with bolt stresses. The material system has no effect on an isotropic material.
   subroutine read_mat1(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      real(wp) :: g

      associate (mat1 => bulk%mat1(card%i))
         call card%field('MID', mat1%id)
         call card%field('E', mat1%e, positive, default=0.0_wp)
         call card%field('G', g, positive, default=0.0_wp)
         call card%field('NU', mat1%nu, real_range(-1.0_wp, 0.5_wp, above=.true., below=.true.), default=0.0_wp)
         call card%field('RHO', mat1%rho, not_negative, default=0.0_wp)
         call card%field('A', mat1%alpha, default=0.0_wp)
         call card%field('TREF', mat1%reference, default=0.0_wp)
         mat1%reference_given = card%given('TREF')
         call card%field('GE', mat1%damping, not_negative, default=0.0_wp)
         call card%field('ST', mat1%strength, not_negative, default=0.0_wp)
         call card%skip(['SC   ', 'SS   ', 'MCSID'])
         call card%finish(mat1%line)
         if (mat1%damping > 0.0_wp) call bulk%ignored%wait('GE of MAT1', card%line, needs_response=.false.)
      end associate
      associate (e => bulk%mat1(card%i)%e, nu => bulk%mat1(card%i)%nu, bars_only => bulk%mat1(card%i)%bars_only, &
                 has_e => bulk%mat1(card%i)%e > 0.0_wp, has_g => g > 0.0_wp, has_nu => card%given('NU'))
         bars_only = has_e .and. .not. (has_g .or. has_nu)
         if (card%is_faulty() .or. bars_only) return ! the blank one of the three follows
         if (.not. (has_e .or. (has_g .and. has_nu))) then
            call card%error('E', 'expected two of E, G and NU; for bars E alone suffices')
         else if (.not. has_e) then
            e = 2.0_wp*(1.0_wp + nu)*g
         else if (.not. has_nu) then
            nu = e/(2.0_wp*g) - 1.0_wp
            bars_only = nu <= -1.0_wp .or. nu >= 0.5_wp
            if (bars_only) call card%errors%warn('MAT1 '//card%text_at(1)//': E and G give NU = E/(2G) - 1 = '//real_text(nu)// &
                                                 ', not above -1 and below 0.5: the material is for bars and beams alone')
         else if (has_g) then
            if (abs(e/(2.0_wp*(1.0_wp + nu)) - g) > 0.01_wp*g) call card%errors%warn('MAT1 '//card%text_at(1)//': G = '// &
               real_text(g)//' does not agree with E and NU, which give G = '//real_text(e/(2.0_wp*(1.0_wp + nu)))// &
               '; G holds for the torsion and the transverse shear of beams, rods and shells, E and NU for all else')
         end if
         bulk%mat1(card%i)%shear = merge(g, 0.5_wp*e/(1.0_wp + nu), has_e .and. has_g .and. has_nu)
      end associate
   end subroutine read_mat1

   !> PARAM: a name and one or two values of any kind. Most PARAMs of NASTRAN have no effect here, some would change the answer.
   subroutine read_parameter(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      character(:), allocatable :: expected
      integer :: line

      call card%skip(['N ', 'V1', 'V2'])
      line = card%line
      if (card%n > 3) call bulk%ignored%add('fields behind V2 of PARAM '//card%text_at(1))
      if (.not. card%given('N')) call card%error('N', 'blank, expected the name of a parameter')
      if (.not. card%given('V1')) call card%error('V1', 'blank, expected the value of the parameter')
      if (.not. all(card%given(['N ', 'V1']))) return
      call take_parameter(card%text_at(1), card%text_at(2), line, bulk%parameters, bulk%ignored, expected)
      if (expected /= '') call card%error('V1', ''''//card%text_at(2)//''' for '//card%text_at(1)//', expected '//expected)
   end subroutine read_parameter

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
               'shear relief and no offset of their axes')
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

end module property_cards
