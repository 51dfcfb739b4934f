!> The cards of supports and loads: SPC, SPC1, SPCM; FORCE, PLOAD4, PLOADE, PLOADM, FORCEM, GRAV, SPCD, LOAD, BOLT. A routine for
!! each array of the bulk data, a table for each kind.
module load_cards
   use bulk_data, only: bolt_card, bulk_data_type, displacement_card, force_card, gravity_card, pressure_card, support_card, &
                        surface_load_card
   use card_fields, only: card_values, decode_integer, decode_real
   use card_reader, only: card_reader_type
   use field_rules, only: blank_field, component_field, integer_field, real_field
   use kinds, only: wp
   use text_tools, only: integer_text
   implicit none
   private

   public :: read_support, read_force, read_pressure, read_surface_load, read_gravity, read_displacement, read_load, read_bolt

contains

   !> SPC: one or two nodes held in the components C; a displacement other than zero is not for this card. SPC1: components C of the
   !! nodes G1, G2, ..., or G1 THRU G2. SPCM: components C of all nodes of the marked surface PID.
   subroutine read_support(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      integer :: field, i, n

      call cards%set_table([integer_field('SID'), integer_field('G1'), component_field('C1'), blank_field('D1'), &
         integer_field('G2', default=0), component_field('C2', default=0), blank_field('D2')], 'SPC')
      call cards%set_table([integer_field('SID'), component_field('C')], 'SPC1', open_ended=.true.)
      call cards%set_table([integer_field('SID'), component_field('C'), integer_field('PID')], 'SPCM')
      allocate (bulk%support(2*cards%n))
      n = 0
      do i = 1, cards%n
         call cards%next(values)
         n = n + 1
         associate (line => cards%line, integers => values%integers, given => values%given)
            select case (cards%card%name)
            case ('SPC')
               if (given(5) .neqv. given(6)) call cards%error('G2', 'node and components C2 go together')
               do field = 2, merge(5, 2, given(5)), 3
                  n = n + merge(1, 0, field > 2)
                  bulk%support(n) = support_card(line=line, set=integers(1), components=integers(field + 1), &
                                                 first=integers(field:field), last=integers(field:field), at=[field])
               end do
            case ('SPC1')
               bulk%support(n) = support_card(line=line, set=integers(1), components=integers(2))
               call list_nodes(cards, bulk%support(n))
            case default
               bulk%support(n) = support_card(line=line, set=integers(1), components=integers(2), surface=integers(3))
               allocate (bulk%support(n)%first(0), bulk%support(n)%last(0), bulk%support(n)%at(0))
            end select
         end associate
      end do
      bulk%support = bulk%support(:n)
   end subroutine read_support

   !> The nodes of an SPC1, from data field 3 on.
   subroutine list_nodes(cards, support)
      type(card_reader_type), intent(inout) :: cards
      type(support_card), intent(inout)     :: support
      integer :: k, n, node
      logical :: ok, through

      associate (card => cards%card)
         allocate (support%first(card%n), support%last(card%n), support%at(card%n), source=0)
         n = 0
         through = .false.
         do k = 3, card%n
            if (card%fields(k)%text == '') cycle
            if (card%fields(k)%text == 'THRU') then
               if (n == 0 .or. through .or. k == card%n) call card%field_error(k, 'THRU: expected G1 THRU G2', cards%errors)
               through = .true.
               cycle
            end if
            call decode_integer(card, k, 'G', 'a node number or THRU', node, ok, cards%errors)
            if (.not. ok) cycle
            if (node < 1) call card%field_error(k, 'G: '''//integer_text(node)//''' is no node number', cards%errors)
            if (through) then
               through = .false.
               if (n == 0) cycle
               support%last(n) = node
               if (node < support%first(n)) call card%field_error(k, 'G: THRU goes down, expected '// &
                                                                  integer_text(support%first(n))//' or more', cards%errors)
            else
               n = n + 1
               support%first(n) = node
               support%last(n) = node
               support%at(n) = k
            end if
         end do
         if (n == 0 .and. card%n < 3) call card%field_error(3, 'G1: blank, expected a node number', cards%errors)
      end associate
      support%first = support%first(:n)
      support%last = support%last(:n)
      support%at = support%at(:n)
   end subroutine list_nodes

   !> FORCE: the vector F (N1, N2, N3) at one node; the direction is not made a unit vector, as in NASTRAN.
   subroutine read_force(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      integer :: i

      call cards%set_table([integer_field(['SID', 'G  ']), blank_field('CID'), real_field('F'), &
         real_field(['N1', 'N2', 'N3'], default=0.0_wp)])
      allocate (bulk%force(cards%n))
      do i = 1, cards%n
         call cards%next(values)
         call cards%check_direction('N1', 'the force', values)
         bulk%force(i) = force_card(line=cards%line, set=values%integers(1), node=values%integers(2), &
                                    force=values%reals(4)*values%reals(5:7))
      end do
   end subroutine read_force

   !> PLOAD4: pressure on a face of a solid, positive into it: P1 at G1, P2 to P4 at the next corners as the right hand goes
   !! about the outward normal, where blank as P1. The face is named by G1 and, for CHEXA and CPENTA, the opposite corner G3; for
   !! CTETRA G4 is the corner that the face does not have.
   !! PLOADE: pressure on the edge G1-G2 of a plane or axisymmetric element, positive into the body.
   subroutine read_pressure(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      integer :: i

      call cards%set_table([integer_field(['SID', 'EID']), real_field('P1'), real_field(['P2', 'P3', 'P4'], default=0.0_wp), &
         integer_field('G1'), integer_field('G34', default=0)], 'PLOAD4')
      call cards%set_table([integer_field(['SID', 'EID']), real_field('P'), integer_field(['G1', 'G2'])], 'PLOADE')
      allocate (bulk%pressure(cards%n))
      do i = 1, cards%n
         call cards%next(values)
         associate (pressure => bulk%pressure(i))
            pressure = pressure_card(line=cards%line, set=values%integers(1), first=values%integers(2), &
                                     on_face=cards%card%name == 'PLOAD4')
            if (pressure%on_face) then
               pressure%corners = values%integers(7:8)
               pressure%pressure = merge(values%reals(3:6), values%reals(3), values%given(3:6))
            else
               pressure%corners = values%integers(4:5)
               pressure%pressure = values%reals(3)
            end if
         end associate
      end do
   end subroutine read_pressure

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

      call cards%set_table([integer_field('SID'), blank_field('CID'), real_field('A'), &
         real_field(['N1', 'N2', 'N3'], default=0.0_wp)])
      allocate (bulk%gravity(cards%n))
      do i = 1, cards%n
         call cards%next(values)
         call cards%check_direction('N1', 'the acceleration', values)
         bulk%gravity(i) = gravity_card(line=cards%line, set=values%integers(1), &
                                        acceleration=values%reals(3)*values%reals(4:6))
      end do
   end subroutine read_gravity

   !> SPCD: displacements of held components, in a load set: the total at the end of the stage, as for forces.
   subroutine read_displacement(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      integer :: field, i, n

      call cards%set_table([integer_field('SID'), integer_field('G1'), component_field('C1'), real_field('D1'), &
         integer_field('G2', default=0), component_field('C2', default=0), real_field('D2', default=0.0_wp)])
      allocate (bulk%displacement(2*cards%n))
      n = 0
      do i = 1, cards%n
         call cards%next(values)
         if (any(values%given(5:7)) .and. .not. all(values%given(5:6))) &
            call cards%error('G2', 'node, components C2 and displacement D2 go together')
         do field = 2, merge(5, 2, values%given(5)), 3
            n = n + 1
            bulk%displacement(n) = displacement_card(line=cards%line, set=values%integers(1), field=field, &
               node=values%integers(field), components=values%integers(field + 1), value=values%reals(field + 2))
         end do
      end do
      bulk%displacement = bulk%displacement(:n)
   end subroutine read_displacement

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
