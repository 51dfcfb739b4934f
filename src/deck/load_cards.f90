!> Shares of a stage's load change that go to its increments (section 5: arithmetic or geometric progression).
!!
!! The cards of loads: FORCE, FORCE1, FORCE2, MOMENT, PLOAD4, PLOADE, PLOAD, PLOADM, FORCEM, GRAV, LOAD, BOLT. A routine for each
!! array of the bulk data, a table for each kind.
module load_cards
   use bulk_data, only: bolt_card, bulk_data_type, force_card, gravity_card, of_edge, of_face, of_nodes, pressure_card, &
                        surface_load_card
   use card_lines, only: card_values, decode_integer, decode_real
   use card_reader, only: card_reader_type
   use field_rules, only: any_field, integer_field, real_field, word_field
   use kinds, only: wp
   use text_tools, only: integer_text
   implicit none
   private

   public :: arithmetic_shares, geometric_shares, read_force, read_pressure, read_surface_load, read_gravity, read_load, &
             read_bolt

contains

   !> N shares s_k = FIRST + (k - 1) d with sum 1: d = 2 (1 - N FIRST) / (N (N - 1)).
   !! OK is false where the last share would not be positive (FIRST >= 2/N).
   pure subroutine arithmetic_shares(n, first, shares, ok)
      integer, intent(in)                :: n     !! increments, 1 or more
      real(wp), intent(in)               :: first !! share of the first one, 0 < FIRST <= 1 (N = 1: not used)
      real(wp), allocatable, intent(out) :: shares(:)
      logical, intent(out)               :: ok
      real(wp) :: step
      integer  :: k

      ok = .true.
      allocate (shares(n), source=1.0_wp)
      if (n == 1) return
      step = 2.0_wp*(1.0_wp - n*first)/(real(n, wp)*(n - 1))
      do k = 1, n
         shares(k) = first + (k - 1)*step
      end do
      ok = shares(1) > 0.0_wp .and. shares(n) > 1.0e-12_wp
   end subroutine arithmetic_shares

   !> N shares s_k = FIRST r^(k - 1) with sum 1; the ratio r is found by bisection and closed by scaling.
   !! OK is false where no such r exists (FIRST >= 1 with N > 1).
   pure subroutine geometric_shares(n, first, shares, ok)
      integer, intent(in)                :: n
      real(wp), intent(in)               :: first !! 0 < FIRST < 1 (N = 1: not used)
      real(wp), allocatable, intent(out) :: shares(:)
      logical, intent(out)               :: ok
      real(wp) :: low, high, ratio
      integer  :: k

      allocate (shares(n), source=1.0_wp)
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
      shares(1) = first
      do k = 2, n
         shares(k) = shares(k - 1)*ratio
      end do
      shares(2:) = shares(2:)*(1.0_wp - first)/sum(shares(2:))
      ok = all(shares > 1.0e-12_wp)
   end subroutine geometric_shares

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

   !> FORCE: the vector F (N1, N2, N3) at one node, in system CID; the direction is not made a unit vector, as in NASTRAN. MOMENT:
   !! likewise. FORCE1: F along the line from G1 to G2; FORCE2: F along the vector product of the lines G1-G2 and G3-G4.
   subroutine read_force(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      integer :: i

      call cards%set_table([integer_field(['SID', 'G  ']), integer_field('CID', default=0, least=0), real_field('F'), &
         real_field(['N1', 'N2', 'N3'], default=0.0_wp)], 'FORCE')
      call cards%set_table([integer_field(['SID', 'G  ']), integer_field('CID', default=0, least=0), real_field('M'), &
         real_field(['N1', 'N2', 'N3'], default=0.0_wp)], 'MOMENT')
      call cards%set_table([integer_field(['SID', 'G  ']), real_field('F'), integer_field(['G1', 'G2'])], 'FORCE1')
      call cards%set_table([integer_field(['SID', 'G  ']), real_field('F'), integer_field(['G1', 'G2', 'G3', 'G4'])], 'FORCE2')
      allocate (bulk%force(cards%n))
      do i = 1, cards%n
         call cards%next(values)
         associate (force => bulk%force(i), integers => values%integers)
            force = force_card(line=cards%line, set=integers(1), node=integers(2), is_moment=cards%card%name == 'MOMENT')
            select case (cards%card%name)
            case ('FORCE1')
               force%ends(:2) = integers(4:5)
               force%force(1) = values%reals(3)
            case ('FORCE2')
               force%ends = integers(4:7)
               force%force(1) = values%reals(3)
            case default
               call cards%check_direction('N1', trim(merge('the moment', 'the force ', force%is_moment)), values)
               force%system = integers(3)
               force%force = values%reals(4)*values%reals(5:7)
            end select
         end associate
      end do
   end subroutine read_force

   !> PLOAD4: pressure on a face of a solid, positive into it: P1 at G1, P2 to P4 at the next corners as the right hand goes
   !! about the outward normal, where blank as P1. The face is named by G1 and, for CHEXA and CPENTA, the opposite corner G3; for
   !! CTETRA G4 is the corner that the face does not have. Faces that elements mark are named by these, EID or EID THRU EID2, and
   !! the pressure acts along their normals. A direction N1, N2, N3 in system CID makes of the pressure a traction along it.
   !! PLOADE: pressure on the edge G1-G2 of a plane or axisymmetric element, positive into the body.
   !! PLOAD: pressure on the face with the corners G1 to G3 or G4, along the right-hand normal as these go round.
   subroutine read_pressure(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      integer :: i

      call cards%set_table([integer_field(['SID', 'EID']), real_field('P1'), real_field(['P2', 'P3', 'P4'], default=0.0_wp), &
         any_field(['G1 ', 'G34']), integer_field('CID', default=0, least=0), &
         real_field(['N1', 'N2', 'N3'], default=0.0_wp), word_field('SORL', '|SURF|'), word_field('LDIR', '|NORM|')], 'PLOAD4')
      call cards%set_table([integer_field(['SID', 'EID']), real_field('P'), integer_field(['G1', 'G2'])], 'PLOADE')
      call cards%set_table([integer_field('SID'), real_field('P'), integer_field(['G1', 'G2', 'G3']), &
         integer_field('G4', default=0)], 'PLOAD')
      allocate (bulk%pressure(cards%n))
      do i = 1, cards%n
         call cards%next(values)
         associate (pressure => bulk%pressure(i), integers => values%integers)
            pressure = pressure_card(line=cards%line, set=integers(1))
            select case (cards%card%name)
            case ('PLOAD4')
               pressure%kind = of_face
               pressure%first = integers(2)
               pressure%pressure = merge(values%reals(3:6), values%reals(3), values%given(3:6))
               pressure%system = integers(9)
               pressure%direction = values%reals(10:12)
               call read_face(cards, pressure)
            case ('PLOADE')
               pressure%kind = of_edge
               pressure%first = integers(2)
               pressure%corners(:2) = integers(4:5)
               pressure%pressure = values%reals(3)
            case default
               pressure%kind = of_nodes
               pressure%corners = integers(3:6)
               pressure%pressure = values%reals(2)
            end select
         end associate
      end do
   end subroutine read_pressure

   !> Data fields 7 and 8 of a PLOAD4: two corners of a face, or THRU and the last of the elements that mark faces.
   subroutine read_face(cards, pressure)
      type(card_reader_type), intent(inout) :: cards
      type(pressure_card), intent(inout)    :: pressure
      character(*), parameter :: expected = 'a node number or THRU'
      integer :: k
      logical :: ok

      associate (card => cards%card)
         pressure%last = pressure%first
         if (card%n < 7) return
         if (card%fields(7)%text == 'THRU') then
            if (card%n < 8) then
               call card%field_error(8, 'EID2: blank, expected the number of an element behind THRU', cards%errors)
               return
            end if
            call decode_integer(card, 8, 'EID2', 'the number of an element', pressure%last, ok, cards%errors)
            if (ok .and. pressure%last < pressure%first) call card%field_error(8, 'EID2: '//integer_text(pressure%last)// &
               ' is less than EID, expected '//integer_text(pressure%first)//' or more', cards%errors)
            pressure%last = max(pressure%last, pressure%first)
            return
         end if
         do k = 7, min(8, card%n)
            if (card%fields(k)%length == 0) cycle
            call decode_integer(card, k, trim(merge('G1 ', 'G34', k == 7)), expected, pressure%corners(k - 6), ok, cards%errors)
            if (ok .and. pressure%corners(k - 6) < 1) call card%field_error(k, trim(merge('G1 ', 'G34', k == 7))//': '''// &
               integer_text(pressure%corners(k - 6))//''' is no node number', cards%errors)
         end do
      end associate
   end subroutine read_face

   !> PLOADM: pressure on a marked surface, positive into the body. FORCEM: a total force F (N1, N2, N3), spread evenly over it.
   subroutine read_surface_load(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      integer :: i

      call cards%set_table([integer_field('SID'), real_field('P'), integer_field('PID')], 'PLOADM')
      call cards%set_table([integer_field('SID'), real_field('F'), real_field(['N1', 'N2', 'N3'], default=0.0_wp), &
         integer_field('PID')], 'FORCEM')
      allocate (bulk%surface_load(cards%n))
      do i = 1, cards%n
         call cards%next(values)
         associate (load => bulk%surface_load(i))
            load = surface_load_card(line=cards%line, set=values%integers(1), is_pressure=cards%card%name == 'PLOADM')
            if (load%is_pressure) then
               load%pressure = values%reals(2)
               load%surface = values%integers(3)
            else
               call cards%check_direction('N1', 'the force', values)
               load%force = values%reals(2)*values%reals(3:5)
               load%surface = values%integers(6)
            end if
         end associate
      end do
   end subroutine read_surface_load

   !> GRAV: acceleration A (N1, N2, N3) on all bodies, with RHO of MAT1.
   subroutine read_gravity(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      integer :: i

      call cards%set_table([integer_field('SID'), integer_field('CID', default=0, least=0), real_field('A'), &
         real_field(['N1', 'N2', 'N3'], default=0.0_wp), integer_field('MB', default=0, least=-1, most=0)]) ! no superelements
      allocate (bulk%gravity(cards%n))
      do i = 1, cards%n
         call cards%next(values)
         call cards%check_direction('N1', 'the acceleration', values)
         bulk%gravity(i) = gravity_card(line=cards%line, set=values%integers(1), system=values%integers(2), &
                                        acceleration=values%reals(3)*values%reals(4:6))
      end do
   end subroutine read_gravity

   !> LOAD: S (S1 L1 + S2 L2 + ...), the sets L being those of load cards other than LOAD.
   subroutine read_load(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      real(wp) :: factor
      integer  :: i, k, set
      logical  :: factor_ok, set_ok

      call cards%set_table([integer_field('SID'), real_field('S'), real_field('S1'), integer_field('L1')], open_ended=.true.)
      allocate (bulk%load(cards%n))
      do i = 1, cards%n
         call cards%next(values)
         associate (load => bulk%load(i), card => cards%card)
            load%line = card%line
            load%set = values%integers(1)
            load%scale = values%reals(2)
            load%factors = values%reals(3:3)
            load%sets = values%integers(4:4)
            load%at = [4]
            do k = 5, card%n, 2
               if (k + 1 > card%n) then
                  call card%field_error(k, 'S: a factor without its load set', cards%errors)
                  exit
               end if
               if (card%fields(k)%text == '' .and. card%fields(k + 1)%text == '') cycle
               if (card%fields(k)%text == '' .or. card%fields(k + 1)%text == '') then
                  call card%field_error(k, 'S: a factor S and its load set L go together, one of them is blank', cards%errors)
                  cycle
               end if
               call decode_real(card, k, 'S', 'a real number', factor, factor_ok, cards%errors)
               call decode_integer(card, k + 1, 'L', 'a load set number', set, set_ok, cards%errors)
               if (.not. (factor_ok .and. set_ok)) cycle
               if (set < 1) call card%field_error(k + 1, 'L: '''//integer_text(set)// &
                                                  ''' is out of range, expected a load set number of 1 or more', cards%errors)
               load%factors = [load%factors, factor]
               load%sets = [load%sets, set]
               load%at = [load%at, k + 1]
            end do
         end associate
      end do
   end subroutine read_load

   !> BOLT: the CROD EID, or the solid cut at the surface PMARK, tightened to PRELOAD in SUBCASE STAGE and locked in the later
   !! ones.
   subroutine read_bolt(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      integer :: i

      call cards%set_table([integer_field('BID'), integer_field('EID', default=0), real_field('PRELOAD', above=0.0_wp), &
         integer_field('STAGE', default=1), integer_field('PMARK', default=0)])
      allocate (bulk%bolt(cards%n))
      do i = 1, cards%n
         call cards%next(values)
         if (values%given(2) .and. values%given(5)) then
            call cards%error('PMARK', 'a bolt is a CROD, EID, or a solid cut at a surface, PMARK, not both')
         else if (.not. (values%given(2) .or. values%given(5))) then
            call cards%error('EID', 'blank, expected a CROD, or in field 6 the PMARK at which a solid is cut')
         end if
         bulk%bolt(i) = bolt_card(line=cards%line, id=values%integers(1), element=values%integers(2), &
                                  preload=values%reals(3), stage=values%integers(4), surface=values%integers(5))
      end do
   end subroutine read_bolt

end module load_cards
