!> Reads the cards of supports, prescribed displacements, springs and nodal masses.
!! Supports: SPC, SPC1, SPCM and their sum SPCADD, SUPORT; MPCADD combines constraint equations likewise. Prescribed displacements: SPCD.
!! Springs: CELAS1, CELAS2, CBUSH, PELAS, PBUSH. Masses: CONM2.
module support_cards
   use bulk_data, only: bulk_data_type, displacement_card, set_sum_card, spring_property_card, support_card
   use card_fields, only: card_fields_type
   use field_rules, only: at_least_1, not_negative
   use kinds, only: wp
   use text_tools, only: integer_text, one_of
   implicit none
   private

   public :: read_support, read_suport, read_sum, read_displacement, read_spring, read_spring_property, read_mass

contains

   !> SPC: one or two nodes held in the components C at the displacement D. SPC1: components C of the nodes G1, G2, ..., or G1 THRU G2.
   !! SPCM: components C of all nodes of the marked surface PID.
   subroutine read_support(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk

      if (card%name == 'SPC') then
         call read_displacement(card, bulk)
         return
      end if
      associate (support => bulk%support(card%i))
         support%line = card%line
         call card%field('SID', support%set)
         call card%components('C', support%components)
         if (card%name == 'SPC1') then
            call card%list_ranges(3, 'G', 'a node number', support%id_ranges)
         else
            call card%field('PID', support%surface)
            call card%finish(support%line)
            allocate (support%first(0), support%last(0), support%at(0))
         end if
      end associate
   end subroutine read_support

   !> SUPORT: up to four nodes with components that are held at rest and free in the modes.
   subroutine read_suport(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      integer :: k

      card%i = card%i - 1
      do k = 1, max(2, min(card%n, 8)), 2
         if (k > 1 .and. card%text_at(k) == '' .and. card%text_at(k + 1) == '') then
            call card%skip(['ID', 'C '])
            cycle
         end if
         card%i = card%i + 1
         associate (held => bulk%suport(card%i))
            held%line = card%line
            held%field = k
            call card%field('ID'//integer_text((k + 1)/2), held%node)
            call card%components('C'//integer_text((k + 1)/2), held%components)
         end associate
      end do
      call card%must_be_blank(9, card%n, '')
   end subroutine read_suport

   !> SPCADD: the supports of all sets S1, S2, ...; MPCADD: their constraint equations.
   subroutine read_sum(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      type(set_sum_card) :: total
      character(:), allocatable :: a_set
      integer :: k, set
      logical :: ok

      a_set = one_of(card%name == 'SPCADD', 'a support set', one_of(card%name == 'MPCADD', 'a set of equations', 'a set of pairs'))
      total%line = card%line
      call card%field('SID', total%set)
      call card%field('S1', set)
      total%sets = [set]
      total%at = [2]
      do k = 3, card%n
         if (card%text_at(k) == '') cycle
         call card%integer_at(k, 'S', set, ok, bounds=at_least_1, expected='the number of '//a_set//', 1 or more')
         total%sets = [total%sets, set]
         total%at = [total%at, k]
      end do
      select case (card%name)
      case ('SPCADD')
         bulk%support_sum(card%i) = total
      case ('MPCADD')
         bulk%equation_sum(card%i) = total
      case ('BCTADD')
         bulk%contact_sum(card%i) = total
      case default
         bulk%glue_sum(card%i) = total
      end select
   end subroutine read_sum

   !> SPCD: displacements of held components in a load set; as for forces, the total at the end of the stage. SPC: supports with the
   !! same fields.
   subroutine read_displacement(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      type(displacement_card) :: moved(2)
      integer :: k, n

      call card%field('SID', moved(1)%set)
      call card%field('G1', moved(1)%node)
      call card%components('C1', moved(1)%components)
      if (card%name == 'SPC') then
         call card%field('D1', moved(1)%value, default=0.0_wp)
      else
         call card%field('D1', moved(1)%value)
      end if
      call card%field('G2', moved(2)%node, default=0)
      call card%components('C2', moved(2)%components, default=0)
      call card%field('D2', moved(2)%value, default=0.0_wp)
      call card%finish(moved(1)%line)
      moved(2)%line = moved(1)%line
      moved(2)%set = moved(1)%set
      moved%field = [2, 5]
      n = merge(2, 1, card%given('G2'))
      if (any(card%given(['G2', 'C2', 'D2'])) .and. .not. all(card%given(['G2', 'C2']))) &
         call card%error('G2', 'node, components C2 and displacement D2 go together')
      do k = 1, n
         associate (held => moved(k), at => card%i + k - 1)
            if (card%name == 'SPC') then
               bulk%support(at) = support_card(line=held%line, set=held%set, components=held%components, value=held%value, &
                                               first=[held%node], last=[held%node], at=[held%field])
            else
               bulk%displacement(at) = held
            end if
         end associate
      end do
      card%i = card%i + n - 1
   end subroutine read_displacement

   !> CELAS1: a spring between component C1 of node G1 and C2 of G2, with a PELAS; CELAS2: with K. A blank node is the ground. CBUSH:
   !! springs along the three axes of system CID between GA and GB or the ground, with a PBUSH. The position S on the line between the
   !! nodes has no effect: the springs connect the displacements of the nodes, and their rotations.
   subroutine read_spring(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      character(2) :: field
      integer :: c, k, offset

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
         if (card%is_faulty()) return
         if (all(spring%nodes == 0)) call card%error('G1', 'blank, as is G2; expected a node at one end or at both')
         if (all(spring%nodes == 0)) return
         do k = 1, 2 ! every node needs a component
            field = 'C'//integer_text(k)
            c = spring%components(k)
            if (c < 0 .or. c > 6) then
               call card%error(field, 'there is no component '//integer_text(c)//'; expected 1 to 6, blank or 0 at the ground')
            else if (spring%nodes(k) > 0 .and. c == 0) then
               call card%error(field, 'blank or 0, expected the component at G'//integer_text(k))
            else if (k == 1 .and. all([spring%nodes(1), spring%components] > 0) .and. (c > 3 .neqv. spring%components(2) > 3)) then
               call card%error(field, 'a displacement at one end and a rotation at the other; expected two '// &
                               'displacements or two rotations')
            end if
         end do
      end associate
   end subroutine read_spring

   !> PELAS: the stiffnesses K of one or two springs. PBUSH: K1, K2, K3 of a CBUSH along its axes, K4, K5, K6 about them; lines of
   !! damping (B, GE) and stress recovery (RCV) may follow. Mass (M) would change the answer and is an error. Stress factors have no
   !! effect. Damping of a CBUSH is not supported and is an error in a stage with FREQUENCY.
   subroutine read_spring_property(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      type(spring_property_card) :: second
      character(8) :: flag
      integer :: k

      associate (first => bulk%spring_property(card%i))
         first%is_bush = card%name == 'PBUSH'
         if (first%is_bush) then
            first%line = card%line
            call card%field('PID', first%id)
            call card%word('FLAG', '|K|', flag)
            call card%field(['K1', 'K2', 'K3', 'K4', 'K5', 'K6'], first%stiffness, not_negative, default=0.0_wp)
            do k = 10, card%n, 8
               select case (card%text_at(k))
               case ('B', 'GE')
                  call bulk%ignored%wait(card%text_at(k)//' of PBUSH', card%line, needs_response=.true., &
                                         refusal='expected none: damping of springs is GE of CELAS2 and PELAS')
               case ('RCV', '')
               case default
                  call card%error_at(k, 'FLAG: '''//card%text_at(k)//''', expected B, GE or RCV after the line of K')
               end select
            end do
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

   !> CONM2: mass M at node G, beside it by X1 to X3, with moments of inertia about its centre. CMASS2: mass M that resists the component
   !! C1 of node G1 alone, of a rotation a moment of inertia.
   subroutine read_mass(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk

      associate (mass => bulk%mass(card%i))
         call card%field('EID', mass%id)
         if (card%name == 'CMASS2') then
            call card%field('M', mass%mass, not_negative)
            call card%field('G1', mass%node)
            call card%field('C1', mass%component, least=1, most=6)
            call card%blank(['G2', 'C2'])
         else
            call card%field('G', mass%node)
            call card%field('CID', mass%system, default=0, least=-1)
            call card%field('M', mass%mass, not_negative)
            call card%field(['X1', 'X2', 'X3'], mass%offset, default=0.0_wp)
            call card%blank(['-'])
            call card%field(['I11', 'I21', 'I22', 'I31', 'I32', 'I33'], mass%inertia, default=0.0_wp)
         end if
         call card%finish(mass%line)
      end associate
   end subroutine read_mass

end module support_cards
