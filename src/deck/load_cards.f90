!> Reads the cards of loads (FORCE to FORCEM, GRAV, RFORCE, LOAD), of bolts and of temperatures (TEMP to TEMPRB).
!! Each array of the bulk data has a routine, each kind of card a table. The increment fractions of a stage's load change
!! (section 5: arithmetic or geometric progression) are here too.
module load_cards
   use bolt_threads, only: complete_thread, strength_classes, thread_sizes, thread_type
   use bulk_data, only: bulk_data_type
   use card_fields, only: card_fields_type, id_ranges
   use field_rules, only: at_least_1, not_negative, positive, real_range
   use kinds, only: wp
   use load_data, only: load_card, of_edge, of_face, of_marks, of_nodes, temperature_card
   use nx_cards, only: is_nx_bolt, read_nx_bolt
   use support_cards, only: read_scalar_load
   use text_tools, only: integer_text, one_of
   use tolerances, only: least_fraction
   implicit none
   private

   public :: arithmetic_fractions, geometric_fractions, read_force, read_pressure, read_surface_load, read_gravity, read_load, &
             read_combination, read_bolt, read_temperature, read_own_temperature

contains

   !> N fractions s_k = FIRST + (k - 1) d with sum 1: d = 2 (1 - N FIRST) / (N (N - 1)).
   !! OK is false where the last fraction would not be positive (FIRST >= 2/N).
   pure subroutine arithmetic_fractions(n, first, fractions, ok)
      integer, intent(in)                :: n     !! number of increments, at least 1
      real(wp), intent(in)               :: first !! the first fraction, 0 < FIRST <= 1 (N = 1: not used)
      real(wp), allocatable, intent(out) :: fractions(:)
      logical, intent(out)               :: ok
      real(wp) :: step
      integer  :: k

      ok = .true.
      allocate (fractions(n), source=1.0_wp)
      if (n == 1) return
      step = 2.0_wp*(1.0_wp - n*first)/(real(n, wp)*(n - 1))
      fractions = [(first + (k - 1)*step, k = 1, n)]
      ok = fractions(1) > 0.0_wp .and. fractions(n) > least_fraction
   end subroutine arithmetic_fractions

   !> N fractions s_k = FIRST r^(k - 1) with sum 1; the ratio r is found by bisection and closed by scaling.
   !! OK is false where no such r exists (FIRST >= 1 with N > 1).
   pure subroutine geometric_fractions(n, first, fractions, ok)
      integer, intent(in)                :: n
      real(wp), intent(in)               :: first !! 0 < FIRST < 1 (N = 1: not used)
      real(wp), allocatable, intent(out) :: fractions(:)
      logical, intent(out)               :: ok
      real(wp) :: low, high, ratio
      integer  :: k

      allocate (fractions(n), source=1.0_wp)
      ok = n == 1
      if (ok) return
      if (first <= 0.0_wp .or. first >= 1.0_wp) return
      low = 0.0_wp
      high = 1.0_wp
      do while (geometric_sum(n, first, high) < 1.0_wp)
         high = 2.0_wp*high
      end do
      do k = 1, 200
         ratio = 0.5_wp*(low + high)
         if (geometric_sum(n, first, ratio) < 1.0_wp) then
            low = ratio
         else
            high = ratio
         end if
      end do
      fractions(1) = first
      do k = 2, n
         fractions(k) = fractions(k - 1)*ratio
      end do
      fractions(2:) = fractions(2:)*(1.0_wp - first)/sum(fractions(2:))
      ok = all(fractions > least_fraction)
   end subroutine geometric_fractions

   pure real(wp) function geometric_sum(n, first, ratio) result(total)
      integer, intent(in)  :: n
      real(wp), intent(in) :: first, ratio
      real(wp) :: term
      integer  :: k

      total = 0.0_wp
      term = first
      do k = 1, n
         total = total + term
         if (total > 2.0_wp) return
         term = term*ratio
      end do
   end function geometric_sum

   !> FORCE: the vector F (N1, N2, N3) at one node in system CID; as in NASTRAN, the direction is not normalised. MOMENT likewise.
   !! FORCE1: F along the line from G1 to G2. FORCE2: F along the vector product of the lines G1-G2 and G3-G4.
   subroutine read_force(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      real(wp) :: f, direction(3)

      if (card%name == 'SLOAD') then
         call read_scalar_load(card, bulk)
         return
      end if
      associate (force => bulk%force(card%i))
         force%is_moment = card%name(:1) == 'M'
         call card%field('SID', force%set)
         call card%field('G', force%node)
         select case (card%name)
         case ('FORCE1', 'MOMENT1', 'FORCE2', 'MOMENT2')
            call card%field(merge('M', 'F', force%is_moment), force%force(1))
            call card%field(['G1', 'G2'], force%ends(:2))
            if (any(card%name == ['FORCE2 ', 'MOMENT2'])) call card%field(['G3', 'G4'], force%ends(3:))
            call card%finish(force%line)
         case default
            call card%field('CID', force%system, default=0, least=0)
            call card%field(merge('M', 'F', force%is_moment), f)
            call card%field(['N1', 'N2', 'N3'], direction, default=0.0_wp)
            call card%finish(force%line)
            call card%check_direction('N1', one_of(force%is_moment, 'the moment', 'the force'), direction)
            force%force = f*direction
         end select
      end associate
   end subroutine read_force

   !> PLOAD4: pressure on a face of a solid, positive into the body: P1 at G1, P2 to P4 at the next corners in the right-hand sense
   !! about the outward normal; a blank value is P1. G1 names the face with, for CHEXA and CPENTA, the opposite corner G3; for CTETRA
   !! G4 is the corner that is not on the face. The elements EID, or EID THRU EID2, name marked faces; the pressure then acts along their
   !! normals. A direction N1, N2, N3 in system CID turns the pressure into a traction along it.
   !! PLOADE: pressure on the edge G1-G2 of a plane or axisymmetric element, positive into the body.
   !! PLOAD2: pressure on the faces marked by the elements EID1, EID2, ... or EID1 THRU EID2, along their normals.
   !! PLOAD: pressure on the face with the corners G1 to G3 or G4, along its right-hand normal.
   subroutine read_pressure(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      character(8) :: word
      integer :: k
      logical :: ok

      associate (pressure => bulk%pressure(card%i), p => bulk%pressure(card%i)%pressure)
         call card%field('SID', pressure%set)
         select case (card%name)
         case ('PLOAD4')
            pressure%kind = of_face
            call card%field('EID', pressure%first)
            call card%field('P1', p(1))
            call card%field(['P2', 'P3', 'P4'], p(2:), default=p(1))
            call card%skip(['G1 ', 'G34'])
            call card%field('CID', pressure%system, default=0, least=0)
            call card%field(['N1', 'N2', 'N3'], pressure%direction, default=0.0_wp)
            call card%word('SORL', '|SURF|', word)
            call card%word('LDIR', '|NORM|', word)
            call card%finish(pressure%line)
            pressure%last = pressure%first
            if (card%text_at(7) /= 'THRU') then ! two corners of a face
               do k = 7, 8
                  if (card%text_at(k) == '') cycle
                  call card%integer_at(k, one_of(k == 7, 'G1', 'G34'), pressure%corners(k - 6), ok, bounds=at_least_1, &
                                       expected='a node number or THRU')
               end do
            else if (card%n < 8) then ! the last element of the range that marks faces
               call card%error_at(8, 'EID2: blank, expected the number of an element after THRU')
            else
               call card%integer_at(8, 'EID2', pressure%last, ok, expected='the number of an element')
               if (ok .and. pressure%last < pressure%first) call card%error_at(8, 'EID2: '//integer_text(pressure%last)// &
                  ' is less than EID, expected '//integer_text(pressure%first)//' or more')
               pressure%last = max(pressure%last, pressure%first)
            end if
         case ('PLOADE')
            pressure%kind = of_edge
            call card%field('EID', pressure%first)
            call card%field('P', p(1))
            call card%field(['G1', 'G2'], pressure%corners(:2))
            call card%finish(pressure%line)
         case ('PLOAD2')
            pressure%kind = of_marks
            call card%field('P', p(1))
            call card%list_ranges(3, 'EID', 'an element number', pressure%ranges)
            pressure%line = card%line
         case default
            pressure%kind = of_nodes
            call card%field('P', p(1))
            call card%field(['G1', 'G2', 'G3'], pressure%corners(:3))
            call card%field('G4', pressure%corners(4), default=0)
            call card%finish(pressure%line)
         end select
         if (card%name /= 'PLOAD4') p = p(1)
      end associate
   end subroutine read_pressure

   !> PLOADM: pressure on a marked surface, positive into the body. FORCEM: a total force F (N1, N2, N3), evenly distributed over it.
   subroutine read_surface_load(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      real(wp) :: f, direction(3)

      associate (load => bulk%surface_load(card%i))
         load%is_pressure = card%name == 'PLOADM'
         call card%field('SID', load%set)
         if (load%is_pressure) then
            call card%field('P', load%pressure)
         else
            call card%field('F', f)
            call card%field(['N1', 'N2', 'N3'], direction, default=0.0_wp)
         end if
         call card%field('PID', load%surface)
         call card%finish(load%line)
         if (load%is_pressure) return
         call card%check_direction('N1', 'the force', direction)
         load%force = f*direction
      end associate
   end subroutine read_surface_load

   !> GRAV: acceleration A (N1, N2, N3) on all bodies, with RHO of MAT1; ACCEL1: on the masses of some nodes. RFORCE: angular
   !! velocity 2 pi A R and acceleration 2 pi RACC R about an axis through node G.
   subroutine read_gravity(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      real(wp), parameter :: two_pi = 6.283185307179586_wp
      real(wp) :: a, rate, direction(3)
      integer  :: method, body

      associate (gravity => bulk%gravity(card%i))
         gravity%line = card%line
         gravity%is_spin = card%name == 'RFORCE'
         call card%field('SID', gravity%set)
         if (gravity%is_spin) then
            call card%field('G', gravity%node, default=0, least=0)
            call card%field('CID', gravity%system, default=0, least=0)
            call card%field('A', a, default=0.0_wp)
            call card%field(['R1', 'R2', 'R3'], direction, default=0.0_wp)
            call card%field('METHOD', method, default=1, most=2) ! both methods follow the distribution of the mass
            call card%field('RACC', rate, default=0.0_wp)
            gravity%spin = two_pi*a*direction
            gravity%spin_rate = two_pi*rate*direction
         else
            call card%field('CID', gravity%system, default=0, least=0)
            call card%field('A', a)
            call card%field(['N1', 'N2', 'N3'], direction, default=0.0_wp)
            gravity%acceleration = a*direction
         end if
         if (card%name == 'ACCEL1') then
            call card%list_ranges(9, 'GRID', 'a node number', gravity%nodes)
         else
            call card%field('MB', body, default=0, least=-1, most=0) ! no superelements
            call card%finish(gravity%line)
         end if
         call card%check_direction(merge('R1', 'N1', gravity%is_spin), &
                                   one_of(gravity%is_spin, 'the rotation', 'the acceleration'), direction)
      end associate
   end subroutine read_gravity

   !> LOAD: S (S1 L1 + S2 L2 + ...). The sets L hold load cards other than LOAD.
   subroutine read_load(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk

      call read_combination(card, bulk%load(card%i))
   end subroutine read_load

   !> LOAD and DLOAD: a sum of load sets, each times a factor.
   subroutine read_combination(card, load)
      type(card_fields_type), intent(inout) :: card
      type(load_card), intent(inout)        :: load
      real(wp) :: factor
      integer  :: k, set
      logical  :: factor_ok, set_ok

      load%line = card%line
      call card%field('SID', load%set)
      call card%field('S', load%scale)
      call card%field('S1', factor)
      call card%field('L1', set)
      load%factors = [factor]
      load%sets = [set]
      load%at = [4]
      do k = 5, card%n, 2
         if (card%text_at(k)//card%text_at(k + 1) == '') cycle
         if (k + 1 > card%n) then
            call card%error_at(k, 'S: a factor without its load set')
         else if (card%text_at(k) == '' .or. card%text_at(k + 1) == '') then
            call card%error_at(k, 'S: a factor S and its load set L go together, one of them is blank')
         else
            call card%real_at(k, 'S', factor, factor_ok)
            call card%integer_at(k + 1, 'L', set, set_ok, bounds=at_least_1, expected='a load set number of 1 or more')
            if (.not. (factor_ok .and. set_ok)) cycle
            load%factors = [load%factors, factor]
            load%sets = [load%sets, set]
            load%at = [load%at, k + 1]
         end if
      end do
   end subroutine read_combination

   !> BOLT: the CROD EID, or the solid cut at the surface PMARK, tightened to PRELOAD in SUBCASE STAGE and locked in later stages;
   !! its thread.
   subroutine read_bolt(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      real(wp), parameter :: usual_friction = 0.12_wp ! mu_G
      logical :: ok

      if (is_nx_bolt(card)) then
         call read_nx_bolt(card, bulk%bolt(card%i))
         return
      end if
      associate (bolt => bulk%bolt(card%i))
         call card%field('BID', bolt%id)
         call card%field('EID', bolt%element, default=0)
         call card%field('PRELOAD', bolt%preload, positive)
         call card%field('STAGE', bolt%stage, default=1)
         call card%field('PMARK', bolt%surface, default=0)
         call card%word('SIZE', thread_sizes, bolt%thread%size)
         call card%word('CLASS', strength_classes, bolt%thread%class)
         call card%field('ALPHAA', bolt%thread%tightening, real_range(1.0_wp), default=1.0_wp)
         call card%field('PITCH', bolt%thread%pitch, positive, default=0.0_wp)
         call card%field('MUG', bolt%thread%friction, not_negative, default=usual_friction)
         call card%field('COUNT', bolt%thread%count, positive, default=0.0_wp)
         call card%finish(bolt%line)
         if (card%given('SIZE') .neqv. card%given('CLASS')) call card%error(one_of(card%given('SIZE'), 'CLASS', 'SIZE'), &
            'blank, expected the '//one_of(card%given('SIZE'), 'strength class beside SIZE', 'thread beside CLASS'))
         if (.not. card%given('SIZE')) bolt%thread = thread_type()
         ok = .true.
         if (card%given('SIZE') .and. .not. card%is_faulty()) call complete_thread(bolt%thread, ok)
         if (.not. ok) call card%error('PITCH', 'more than that of the coarse thread; expected a pitch in mm, blank: coarse')
         if (any(card%given(['ALPHAA', 'PITCH ', 'MUG   ', 'COUNT ']) .and. .not. card%given('SIZE'))) call card%error('SIZE', &
            'blank, expected the thread, to which ALPHAA, PITCH, MUG and COUNT belong')
      end associate
      if (all(card%given(['EID  ', 'PMARK']))) then
         call card%error('PMARK', 'given beside EID; expected one of them: the CROD of a bolt, or the surface at which a solid '// &
                         'bolt is cut')
      else if (.not. any(card%given(['EID  ', 'PMARK']))) then
         call card%error('EID', 'blank, expected a CROD, or in field 6 the PMARK at which a solid is cut')
      end if
   end subroutine read_bolt

   !> TEMP: temperatures T of up to three nodes G. TEMPD: temperature of all nodes without a TEMP in set SID, for up to four sets.
   subroutine read_temperature(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      character(4) :: name(4)
      character(2) :: t(4)
      integer  :: k, line, n, number(4), set
      real(wp) :: value(4)
      logical  :: for_all

      for_all = card%name == 'TEMPD'
      n = merge(4, 3, for_all)
      name = merge(['SID1', 'SID2', 'SID3', 'SID4'], ['G1  ', 'G2  ', 'G3  ', 'G4  '], for_all)
      t = ['T1', 'T2', 'T3', 'T4']
      set = 0
      if (.not. for_all) call card%field('SID', set)
      call card%field(name(1), number(1))
      call card%field(t(1), value(1))
      do k = 2, n
         call card%field(name(k), number(k), default=0)
         call card%field(t(k), value(k), default=0.0_wp)
      end do
      call card%finish(line)
      card%i = card%i - 1
      do k = 1, n
         if (k > 1 .and. number(k) == 0 .and. .not. abs(value(k)) > 0.0_wp) cycle ! blank or zero
         if (k > 1 .and. .not. (card%given(name(k)) .and. card%given(t(k)))) then
            call card%error(trim(name(k)), 'this and '//t(k)//' go together, one of them is blank')
            cycle
         end if
         card%i = card%i + 1
         bulk%temperature(card%i) = temperature_card(line=line, set=merge(number(k), set, for_all), is_default=for_all, &
            node=merge(0, number(k), for_all), field=merge(2*k - 1, 2*k, for_all), value=value(k))
      end do
   end subroutine read_temperature

   !> TEMPP1, TEMPRB: temperatures of shells, of beams and rods. Those of points of the section, which NASTRAN uses for stresses only,
   !! have no effect.
   subroutine read_own_temperature(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      type(id_ranges) :: others
      integer :: first

      associate (warm => bulk%own_temperature(card%i))
         warm%line = card%line
         warm%is_plate = card%name == 'TEMPP1'
         call card%field('SID', warm%set)
         call card%field('EID1', first)
         if (warm%is_plate) then
            call card%field('TBAR', warm%mean(1))
            warm%mean(2) = warm%mean(1)
            call card%field('TPRIME', warm%slope(1), default=0.0_wp)
            call card%skip(['-  ', 'TS1', 'TS2', '-  '])
         else
            call card%field(['TA', 'TB'], warm%mean)
            call card%field(['TP1A', 'TP1B', 'TP2A', 'TP2B'], warm%slope, default=0.0_wp)
            call card%skip(['TCA', 'TDA', 'TEA', 'TFA', 'TCB', 'TDB', 'TEB', 'TFB'])
         end if
         warm%ranges = id_ranges([first], [first], [2])
         if (card%n <= merge(8, 16, warm%is_plate)) return
         call card%list_ranges(merge(9, 17, warm%is_plate), 'EID', 'an element number', others)
         warm%ranges = id_ranges([first, others%first], [first, others%last], [2, others%at])
      end associate
   end subroutine read_own_temperature

end module load_cards
