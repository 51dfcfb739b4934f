!> The cards of springs and of masses at nodes: CELAS1, CELAS2, CBUSH, PELAS, PBUSH, CONM2. A routine for each array of the bulk
!! data, a table for each kind.
module spring_cards
   use bulk_data, only: bulk_data_type, mass_card, spring_card, spring_property_card
   use card_lines, only: card_values
   use card_reader, only: card_reader_type
   use field_rules, only: any_field, blank_field, integer_field, real_field, word_field
   use kinds, only: wp
   use text_tools, only: integer_text
   implicit none
   private

   public :: read_spring, read_spring_property, read_mass

contains

   !> CELAS1: a spring between component C1 of node G1 and C2 of G2, with a PELAS; CELAS2: with K. A node left blank is the ground.
   !! CBUSH: springs along the three axes of system CID between GA and GB or the ground, with a PBUSH. Where along the line between
   !! them it stands, S, means nothing to nodes without rotations.
   subroutine read_spring(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      integer :: i

      call cards%set_table([integer_field(['EID', 'PID']), integer_field('G1', default=0), &
         integer_field('C1', default=0), integer_field('G2', default=0), &
         integer_field('C2', default=0)], 'CELAS1')
      call cards%set_table([integer_field('EID'), real_field('K', least=0.0_wp), integer_field('G1', default=0), &
         integer_field('C1', default=0), integer_field('G2', default=0), &
         integer_field('C2', default=0), real_field('GE', default=0.0_wp, least=0.0_wp), any_field('S')], 'CELAS2')
      call cards%set_table([integer_field(['EID', 'PID', 'GA ']), integer_field('GB', default=0), &
         any_field(['GO', 'X2', 'X3']), integer_field('CID', default=-1, least=0), any_field('S'), &
         integer_field('OCID', default=-1, least=-1), blank_field(['S1', 'S2', 'S3'])], 'CBUSH')
      allocate (bulk%spring(cards%n))
      do i = 1, cards%n
         call cards%next(values)
         associate (spring => bulk%spring(i), integers => values%integers)
            spring = spring_card(line=cards%line, id=integers(1), is_bush=cards%card%name == 'CBUSH')
            if (spring%is_bush) then
               spring%property = integers(2)
               spring%nodes = integers(3:4)
               spring%system = integers(8)
               if (spring%system < 0 .and. any(values%given(5:7))) call cards%error('CID', 'blank, and GO or X1, X2, X3 '// &
                  'are not; expected the system of its axes, 0 for global axes')
               if (integers(10) >= 0) call cards%error('OCID', 'expected blank or -1: the spring has no offset')
               cycle
            end if
            if (cards%card%name == 'CELAS1') spring%property = integers(2)
            if (cards%card%name == 'CELAS2') then
               spring%stiffness = values%reals(2)
               spring%damping = values%reals(7)
               if (spring%damping > 0.0_wp) call bulk%idle%wait('GE of CELAS2', cards%line, needs_response=.false.)
            end if
            spring%nodes = integers([3, 5])
            spring%components = integers([4, 6])
            if (values%ok) call check_ends(cards, spring)
         end associate
      end do
   end subroutine read_spring

   !> A CELAS has a node, and a component at every node that it has.
   subroutine check_ends(cards, spring)
      type(card_reader_type), intent(inout) :: cards
      type(spring_card), intent(in)         :: spring
      character(2) :: field
      integer :: k

      if (all(spring%nodes == 0)) then
         call cards%error('G1', 'blank, and G2 is too; expected a node at one end at least')
         return
      end if
      do k = 1, 2
         if (spring%components(k) < 0 .or. spring%components(k) > 6) then
            call cards%error('C'//integer_text(k), 'there is no component '//integer_text(spring%components(k))// &
                             '; expected 1, 2 or 3, blank or 0 at the ground')
            cycle
         end if
         if (spring%nodes(k) == 0 .or. (spring%components(k) >= 1 .and. spring%components(k) <= 3)) cycle
         field = 'C'//integer_text(k)
         if (spring%components(k) == 0) call cards%error(field, 'blank or 0, expected the component at G'//integer_text(k))
         if (spring%components(k) > 3) call cards%error(field, 'component '//integer_text(spring%components(k))// &
            ' is a rotation, which nodes of bodies do not have; expected 1, 2 or 3')
      end do
   end subroutine check_ends

   !> PELAS: the stiffnesses K of one or two springs; PBUSH: K1, K2, K3 of a CBUSH along its axes. Factors of stresses have no effect.
   subroutine read_spring_property(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      integer :: field, i, k, n

      call cards%set_table([integer_field('PID1'), real_field('K1', least=0.0_wp), &
         real_field('GE1', default=0.0_wp, least=0.0_wp), any_field('S1'), &
         integer_field('PID2', default=0), real_field('K2', default=0.0_wp, least=0.0_wp), &
         real_field('GE2', default=0.0_wp, least=0.0_wp), any_field('S2')], 'PELAS')
      call cards%set_table([integer_field('PID'), word_field('FLAG', '|K|'), &
         real_field(['K1', 'K2', 'K3'], default=0.0_wp, least=0.0_wp), real_field(['K4', 'K5', 'K6'], default=0.0_wp)], 'PBUSH', &
         open_ended=.true.)
      allocate (bulk%spring_property(2*cards%n))
      n = 0
      do i = 1, cards%n
         call cards%next(values)
         if (cards%card%name == 'PBUSH') then
            n = n + 1
            bulk%spring_property(n) = spring_property_card(line=cards%line, id=values%integers(1), is_bush=.true., &
                                                           stiffness=values%reals(3:5))
            do k = 6, 8
               if (abs(values%reals(k)) > 0.0_wp) call cards%error('K'//integer_text(k - 2), &
                  'against a rotation, which nodes of bodies do not have; expected blank')
            end do
            call check_rest(cards, bulk)
            cycle
         end if
         do field = 1, merge(5, 1, values%given(5)), 4
            n = n + 1
            bulk%spring_property(n) = spring_property_card(line=cards%line, id=values%integers(field), field=field, &
                                                           stiffness=[values%reals(field + 1), 0.0_wp, 0.0_wp], &
                                                           damping=values%reals(field + 2))
            if (values%reals(field + 2) > 0.0_wp) call bulk%idle%wait('GE of PELAS', cards%line, needs_response=.false.)
         end do
         if (values%given(6) .and. .not. values%given(5)) call cards%error('PID2', 'blank, but K2 is not')
      end do
      bulk%spring_property = bulk%spring_property(:n)
   end subroutine read_spring_property

   !> Behind the stiffnesses of a PBUSH may stand lines of damping, B and GE, of stress recovery, RCV, and of mass, M, which counts.
   !! Damping of a CBUSH is not done: where a structure responds to a load it is an error.
   subroutine check_rest(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      integer :: k

      do k = 10, cards%card%n, 8
         associate (flag => cards%card%fields(k)%text)
            if (flag == 'B' .or. flag == 'GE') call bulk%idle%wait(trim(flag)//' of PBUSH', cards%line, needs_response=.true., &
               refusal='expected none: of springs GE of CELAS2 and PELAS is done')
            if (flag == 'B' .or. flag == 'GE' .or. flag == 'RCV' .or. flag == '') cycle
            call cards%card%field_error(k, 'FLAG: '''//trim(flag)//''', expected B, GE or RCV behind the line of K', cards%errors)
         end associate
      end do
   end subroutine check_rest

   !> CONM2: mass M at node G, with its moments of inertia about it. It stands at its node: an offset would need rotations.
   subroutine read_mass(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      integer :: i

      call cards%set_table([integer_field(['EID', 'G  ']), integer_field('CID', default=0, least=0), &
         real_field('M', least=0.0_wp), blank_field(['X1', 'X2', 'X3', '- ']), &
         real_field(['I11', 'I21', 'I22', 'I31', 'I32', 'I33'], default=0.0_wp)])
      allocate (bulk%mass(cards%n))
      do i = 1, cards%n
         call cards%next(values)
         bulk%mass(i) = mass_card(line=cards%line, id=values%integers(1), node=values%integers(2), mass=values%reals(4), &
                                  system=values%integers(3), inertia=values%reals(9:14))
      end do
   end subroutine read_mass

end module spring_cards
