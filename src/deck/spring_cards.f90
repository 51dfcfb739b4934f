!> The cards of springs and of masses at nodes: CELAS1, CELAS2, CBUSH, PELAS, PBUSH, CONM2.
module spring_cards
   use bulk_data, only: bulk_data_type, spring_card, spring_property_card
   use card_fields, only: card_fields_type
   use field_rules, only: not_negative
   use kinds, only: wp
   use text_tools, only: integer_text
   implicit none
   private

   public :: read_spring, read_spring_property, read_mass

contains

   !> CELAS1: a spring between component C1 of node G1 and C2 of G2, with a PELAS; CELAS2: with K. A node left blank is the ground.
   !! CBUSH: springs along the three axes of system CID between GA and GB or the ground, with a PBUSH. Where along the line between
   !! them it stands, S, has no effect: it acts between the displacements of its nodes, and between their rotations.
   subroutine read_spring(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      integer :: offset

      associate (spring => bulk%spring(card%i))
         spring%is_bush = card%name == 'CBUSH'
         call card%field('EID', spring%id)
         if (spring%is_bush) then
            call card%field('PID', spring%property)
            call card%field('GA', spring%nodes(1))
            call card%field('GB', spring%nodes(2), default=0)
            call card%skip(['GO', 'X2', 'X3'])
            call card%field('CID', spring%system, default=-1, least=0)
            call card%skip(['S'])
            call card%field('OCID', offset, default=-1, least=-1)
            call card%blank(['S1', 'S2', 'S3'])
            call card%finish(spring%line)
            if (spring%system < 0 .and. any(card%given(['GO', 'X2', 'X3']))) call card%error('CID', &
               'blank, and GO or X1, X2, X3 are not; expected the system of its axes, 0 for global axes')
            if (offset >= 0) call card%error('OCID', 'expected blank or -1: the spring has no offset')
            return
         end if
         if (card%name == 'CELAS1') call card%field('PID', spring%property)
         if (card%name == 'CELAS2') call card%field('K', spring%stiffness, not_negative)
         call card%field('G1', spring%nodes(1), default=0)
         call card%field('C1', spring%components(1), default=0)
         call card%field('G2', spring%nodes(2), default=0)
         call card%field('C2', spring%components(2), default=0)
         if (card%name == 'CELAS2') then
            call card%field('GE', spring%damping, not_negative, default=0.0_wp)
            call card%skip(['S'])
         end if
         call card%finish(spring%line)
         if (spring%damping > 0.0_wp) call bulk%ignored%wait('GE of CELAS2', card%line, needs_response=.false.)
         if (.not. card%is_faulty()) call check_ends(card, spring)
      end associate
   end subroutine read_spring

   !> A CELAS has a node, and a component at every node that it has.
   subroutine check_ends(card, spring)
      type(card_fields_type), intent(inout) :: card
      type(spring_card), intent(in)         :: spring
      character(2) :: field
      integer :: k

      if (all(spring%nodes == 0)) call card%error('G1', 'blank, like G2; expected a node at one end at least')
      if (all(spring%nodes == 0)) return
      do k = 1, 2
         field = 'C'//integer_text(k)
         associate (c => spring%components(k))
            if (c < 0 .or. c > 6) then
               call card%error(field, 'there is no component '//integer_text(c)//'; expected 1 to 6, blank or 0 at the ground')
            else if (spring%nodes(k) == 0) then
               cycle
            else if (c == 0) then
               call card%error(field, 'blank or 0, expected the component at G'//integer_text(k))
            else if (all(spring%components > 0) .and. (c > 3 .neqv. spring%components(3 - k) > 3)) then
               if (k == 1) call card%error(field, 'a displacement at one end and a rotation at the other; expected two of a kind')
            end if
         end associate
      end do
   end subroutine check_ends

   !> PELAS: the stiffnesses K of one or two springs; PBUSH: K1, K2, K3 of a CBUSH along its axes, K4, K5, K6 about
   !! them. Factors of stresses have no effect.
   subroutine read_spring_property(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      type(spring_property_card) :: second
      character(8) :: flag

      associate (first => bulk%spring_property(card%i))
         first%is_bush = card%name == 'PBUSH'
         if (first%is_bush) then
            first%line = card%line
            call card%field('PID', first%id)
            call card%word('FLAG', '|K|', flag)
            call card%field(['K1', 'K2', 'K3', 'K4', 'K5', 'K6'], first%stiffness, not_negative, default=0.0_wp)
            call check_rest(card, bulk)
            return
         end if
         call card%field('PID1', first%id)
         call card%field('K1', first%stiffness(1), not_negative)
         call card%field('GE1', first%damping, not_negative, default=0.0_wp)
         call card%skip(['S1'])
         call card%field('PID2', second%id, default=0)
         call card%field('K2', second%stiffness(1), not_negative, default=0.0_wp)
         call card%field('GE2', second%damping, not_negative, default=0.0_wp)
         call card%skip(['S2'])
         call card%finish(first%line)
         if (first%damping > 0.0_wp) call bulk%ignored%wait('GE of PELAS', card%line, needs_response=.false.)
         if (card%given('PID2')) then
            second%line = card%line
            second%field = 5
            card%i = card%i + 1
            bulk%spring_property(card%i) = second
            if (second%damping > 0.0_wp) call bulk%ignored%wait('GE of PELAS', card%line, needs_response=.false.)
         else if (card%given('K2')) then
            call card%error('PID2', 'blank, but K2 is not')
         end if
      end associate
   end subroutine read_spring_property

   !> Behind the stiffnesses of a PBUSH may stand lines of damping, B and GE, of stress recovery, RCV, and of mass, M, which counts.
   !! Damping of a CBUSH is not done: where a structure responds to a load it is an error.
   subroutine check_rest(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      character(:), allocatable :: flag
      integer :: k

      do k = 10, card%n, 8
         flag = card%text_at(k)
         if (flag == 'B' .or. flag == 'GE') then
            call bulk%ignored%wait(flag//' of PBUSH', card%line, needs_response=.true., &
                                refusal='expected none: damping of springs is GE of CELAS2 and PELAS')
         else if (flag /= 'RCV' .and. flag /= '') then
            call card%error_at(k, 'FLAG: '''//flag//''', expected B, GE or RCV after the line of K')
         end if
      end do
   end subroutine check_rest

   !> CONM2: mass M at node G, with its moments of inertia about it. It stands at its node: an offset would need rotations.
   subroutine read_mass(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk

      associate (mass => bulk%mass(card%i))
         call card%field('EID', mass%id)
         call card%field('G', mass%node)
         call card%field('CID', mass%system, default=0, least=0)
         call card%field('M', mass%mass, not_negative)
         call card%blank(['X1', 'X2', 'X3', '- '])
         call card%field(['I11', 'I21', 'I22', 'I31', 'I32', 'I33'], mass%inertia, default=0.0_wp)
         call card%finish(mass%line)
      end associate
   end subroutine read_mass

end module spring_cards
