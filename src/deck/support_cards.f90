!> Reads the cards of supports, prescribed displacements, springs and nodal masses.
!! Supports: SPC, SPC1, SPCM and their sum SPCADD, SUPORT; MPCADD combines constraint equations likewise. Prescribed displacements: SPCD.
!! Springs: CELAS1 to 4, CBUSH, PELAS, PBUSH. Masses: CONM1, CONM2, CMASS1 to 4, PMASS. Scalar points: SPOINT, SLOAD.
module support_cards
   use bulk_data, only: bulk_data_type, pmass_card, set_sum_card, spring_property_card, support_card
   use card_fields, only: card_fields_type
   use field_rules, only: at_least_1, not_negative, parse_integer, real_range
   use kinds, only: wp
   use load_data, only: displacement_card
   use text_tools, only: integer_text, one_of
   implicit none
   private

   public :: read_support, read_suport, read_sum, read_displacement, read_spring, read_spring_property, read_mass, &
             read_pmass, read_scalar, read_scalar_load

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
         if (card%name == 'SPC1') then
            call card%components('C', support%components, default=-1)
            call card%list_ranges(3, 'G', 'a node number', support%id_ranges)
         else
            call card%components('C', support%components)
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
      if (card%name == 'SPC') then
         call card%components('C1', moved(1)%components, default=-1)
         call card%field('D1', moved(1)%value, default=0.0_wp)
      else
         call card%components('C1', moved(1)%components)
         call card%field('D1', moved(1)%value)
      end if
      call card%field('G2', moved(2)%node, default=0)
      call card%components('C2', moved(2)%components, default=0)
      call card%field('D2', moved(2)%value, default=0.0_wp)
      call card%finish(moved(1)%line)
      moved(2)%line = moved(1)%line
      moved(2)%set = moved(1)%set
      moved%field = [2, 5]
      n = merge(2, 1, moved(2)%node > 0)
      if (merge(.not. card%given('C2'), moved(2)%components > 0 .or. abs(moved(2)%value) > 0.0_wp, n == 2)) &
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

   !> CELAS1: a spring between component C1 of node G1 and C2 of G2, with a PELAS; CELAS2: with K. A blank node is the ground. CELAS3
   !! and CELAS4: the same between scalar points S1 and S2. CDAMP1 to 4: viscous dampers likewise, with a PDAMP or B. CBUSH: a bush.
   !! CVISC: a bush along and about the line between its nodes, with a PVISC.
   subroutine read_spring(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk

      associate (spring => bulk%spring(card%i))
         spring%is_bush = card%name == 'CBUSH'
         spring%is_damper = any(card%name(:5) == ['CDAMP', 'CVISC'])
         spring%is_scalar = any(card%name(6:6) == ['3', '4'])
         call card%field('EID', spring%id)
         if (spring%is_bush) then
            call read_bush(card, bulk)
            return
         end if
         if (card%name == 'CVISC') then
            spring%is_bush = .true.
            call card%field('PID', spring%property, default=spring%id)
            call card%field(['G1', 'G2'], spring%nodes)
         else if (any(card%name(6:6) == ['1', '3'])) then
            call card%field('PID', spring%property)
         else if (spring%is_damper) then
            call card%field('B', spring%viscous, not_negative)
         else
            call card%field('K', spring%stiffness, not_negative)
         end if
         if (.not. spring%is_bush) call read_ends(card, spring%is_scalar, spring%nodes, spring%components)
         if (card%name == 'CELAS2') then
            call card%field('GE', spring%damping, not_negative, default=0.0_wp)
            call card%skip(['S'])
         end if
         call card%finish(spring%line)
         if (spring%damping > 0.0_wp) call bulk%ignored%wait('GE of CELAS2', card%line, needs_response=.false.)
         if (spring%is_damper) call bulk%ignored%wait(trim(card%name), card%line, needs_response=.true.)
      end associate
   end subroutine read_spring

   !> The ends of a spring or mass: NODES G1 and G2 with COMPONENTS C1 and C2, or scalar points S1 and S2. Blank: the ground.
   subroutine read_ends(card, is_scalar, nodes, components)
      type(card_fields_type), intent(inout) :: card
      logical, intent(in)  :: is_scalar
      integer, intent(out) :: nodes(2), components(2)
      character(2) :: field
      integer :: k

      components = 1
      if (is_scalar) call card%field(['S1', 'S2'], nodes, default=0, least=0)
      do k = 1, 2
         if (is_scalar) exit
         field = 'C'//integer_text(k)
         call card%field('G'//integer_text(k), nodes(k), default=0, least=0)
         call card%field(field, components(k), default=0, least=-huge(1))
         if (components(k) < 0 .or. components(k) > 6) call card%error(field, 'there is no component '// &
            integer_text(components(k))//'; expected 1 to 6, blank or 0 at the ground and of scalar points')
      end do
      if (all(nodes == 0) .and. .not. card%is_faulty()) call card%error(one_of(is_scalar, 'S1', 'G1'), 'blank, as is '// &
         one_of(is_scalar, 'S2', 'G2')//'; expected a node at one end or at both')
      where (nodes == 0) components = 0
   end subroutine read_ends

   !> CBUSH: springs along and about three axes, with a PBUSH, between GA and GB or the ground. The axes are those of system CID, or
   !! follow from node GO or the vector X1, X2, X3. The bush stands at S on the line between the nodes, or at S1, S2, S3 in system OCID.
   subroutine read_bush(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      logical :: ok

      associate (bush => bulk%spring(card%i))
         call card%field('PID', bush%property, default=bush%id)
         call card%field('GA', bush%nodes(1))
         call card%field('GB', bush%nodes(2), default=0, least=0)
         call card%field('GO', bush%orientation(1), default=0.0_wp, whole=.true.)
         call card%field(['X2', 'X3'], bush%orientation(2:), default=0.0_wp, whole=.true.)
         call parse_integer(card%text_at(5), bush%other, ok)
         if (.not. ok .or. any(card%given(['X2', 'X3']))) bush%other = 0
         if (bush%other > 0) bush%orientation = 0.0_wp
         call card%field('CID', bush%system, default=-1, least=0)
         call card%field('S', bush%share, real_range(0.0_wp, 1.0_wp), default=0.5_wp, whole=.true.)
         call card%field('OCID', bush%point_system, default=-1, least=-1)
         call card%field(['S1', 'S2', 'S3'], bush%point, default=0.0_wp, whole=.true.)
         call card%finish(bush%line)
      end associate
   end subroutine read_bush

   !> SPOINT: scalar points, numbers and ranges.
   subroutine read_scalar(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk

      bulk%scalar(card%i)%line = card%line
      call card%list_ranges(1, 'ID', 'a number', bulk%scalar(card%i)%id_ranges)
   end subroutine read_scalar

   !> SLOAD: up to three forces F on scalar points S.
   subroutine read_scalar_load(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      integer :: k, set

      call card%field('SID', set)
      do k = 1, max(1, min(3, card%n/2))
         if (k > 1) card%i = card%i + 1
         associate (force => bulk%force(card%i))
            force%line = card%line
            force%set = set
            call card%field('S'//integer_text(k), force%node)
            call card%field('F'//integer_text(k), force%force(1))
         end associate
      end do
      call card%finish(set)
   end subroutine read_scalar_load

   !> PELAS: the stiffnesses K of one or two springs. PDAMP: the viscous damping B of one to four dampers. PVISC: the
   !! damping CE along and CR about the line of one or two CVISC. PBUSH: K1, K2, K3 of a CBUSH
   !! along its axes, K4, K5, K6 about them; lines of damping (viscous B, structural GE), stress recovery (RCV, without effect) and
   !! mass (M) may follow.
   subroutine read_spring_property(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      type(spring_property_card) :: law
      character(1) :: nth
      integer :: k

      if (card%name == 'PBUSH') then
         bulk%spring_property(card%i)%is_bush = .true.
         call read_bush_property(card, bulk)
         return
      end if
      law%line = card%line
      law%is_bush = card%name == 'PVISC'
      law%is_damper = card%name == 'PDAMP'
      do k = 1, merge(4, 2, law%is_damper)
         nth = integer_text(k)
         law%field = merge(2*k - 1, 4*k - 3, law%is_damper)
         if (k > 1 .and. (card%text_at(law%field) == '' .or. card%text_at(law%field) == '0')) then ! FINISH finds the rest
            if (card%text_at(law%field + 1) /= '') then
               call card%error_at(law%field, 'PID'//nth//': blank, but '//one_of(law%is_bush, 'CE', &
                                  merge('B', 'K', law%is_damper))//nth//' is not')
               return
            end if
            exit
         end if
         if (k > 1) card%i = card%i + 1
         call card%field('PID'//nth, law%id)
         if (law%is_damper) then
            call card%field('B'//nth, law%viscous(1), not_negative)
         else if (law%is_bush) then
            call card%field('CE'//nth, law%viscous(1), not_negative, default=0.0_wp)
            call card%field('CR'//nth, law%viscous(4), not_negative, default=0.0_wp)
            if (k == 1) call card%skip(['-'])
         else
            call card%field('K'//nth, law%stiffness(1), not_negative)
            call card%field('GE'//nth, law%damping(1), not_negative, default=0.0_wp)
            call card%skip(['S'//nth])
            if (law%damping(1) > 0.0_wp) call bulk%ignored%wait('GE of PELAS', card%line, needs_response=.false.)
         end if
         bulk%spring_property(card%i) = law
         if (law%is_bush) bulk%spring_property(card%i)%is_damper = .true.
      end do
      call card%finish(k)
   end subroutine read_spring_property

   !> PBUSH: a line of six values for each flag.
   subroutine read_bush_property(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      character(:), allocatable :: flag
      real(wp) :: value
      integer  :: i, k
      logical  :: ok

      associate (law => bulk%spring_property(card%i))
         law%line = card%line
         call card%field('PID', law%id)
         flag = 'K'
         do k = 2, max(2, card%n), 8
            if (card%text_at(k) /= '') flag = card%text_at(k)
            if (all(flag /= [character(8) :: 'K', 'B', 'GE', 'RCV', 'M'])) then
               call card%error_at(k, 'FLAG: '''//card%text_at(k)//''', expected K, B, GE, RCV or M')
               cycle
            end if
            do i = 1, merge(1, 6, flag == 'M')
               if (card%text_at(k + i) == '' .or. flag == 'RCV') cycle
               call card%real_at(k + i, flag//integer_text(i), value, ok, not_negative)
               if (.not. ok .or. .not. value > 0.0_wp) cycle
               if (flag == 'K') law%stiffness(i) = value
               if (flag == 'GE') law%damping(i) = value
               if (flag == 'M') law%mass = value
               if (flag == 'GE') call bulk%ignored%wait('GE of PBUSH', card%line, needs_response=.false.)
               if (flag == 'B') law%viscous(i) = value
               if (flag == 'B') call bulk%ignored%wait('B of PBUSH', card%line, needs_response=.true.)
            end do
         end do
      end associate
   end subroutine read_bush_property

   !> CONM2: mass M at node G, beside it by X1 to X3, with moments of inertia about its centre. CONM1: the mass matrix of the six
   !! components of node G. CMASS2: mass M that resists component C1 of node G1 less component C2 of G2, of a rotation a moment of
   !! inertia; CMASS1: with a PMASS; CMASS3, CMASS4: of scalar points.
   subroutine read_mass(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      integer :: components(2), i, j, nodes(2)

      associate (mass => bulk%mass(card%i))
         call card%field('EID', mass%id)
         mass%is_directed = card%name(:5) == 'CMASS'
         mass%is_scalar = any(card%name == ['CMASS3', 'CMASS4'])
         if (mass%is_directed) then
            if (any(card%name == ['CMASS1', 'CMASS3'])) call card%field('PID', mass%property)
            if (any(card%name == ['CMASS2', 'CMASS4'])) call card%field('M', mass%mass, not_negative)
            call read_ends(card, mass%is_scalar, nodes, components)
            i = merge(2, 1, nodes(1) == 0) ! the first node that is not the ground
            mass%node = nodes(i)
            mass%node_2 = nodes(3 - i)
            mass%component = components(i)
            mass%component_2 = components(3 - i)
         else
            call card%field('G', mass%node)
            call card%field('CID', mass%system, default=0, least=merge(0, -1, card%name == 'CONM1'))
            if (card%name == 'CONM1') then
               allocate (mass%matrix(21))
               do i = 1, 6
                  do j = 1, i
                     call card%field('M'//integer_text(10*i + j), mass%matrix(i*(i - 1)/2 + j), default=0.0_wp)
                  end do
               end do
            else
               call card%field('M', mass%mass, not_negative)
               call card%field(['X1', 'X2', 'X3'], mass%offset, default=0.0_wp)
               call card%blank(['-'])
               call card%field(['I11', 'I21', 'I22', 'I31', 'I32', 'I33'], mass%inertia, default=0.0_wp)
            end if
         end if
         call card%finish(mass%line)
      end associate
   end subroutine read_mass

   !> PMASS: up to four masses of CMASS1 and CMASS3.
   subroutine read_pmass(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      type(pmass_card) :: mass
      integer :: k

      do k = 1, 4
         if (k > 1 .and. card%text_at(2*k - 1) == '') exit
         call card%field('PID'//integer_text(k), mass%id)
         call card%field('M'//integer_text(k), mass%mass, not_negative)
         if (k > 1) card%i = card%i + 1
         mass%line = card%line
         bulk%pmass(card%i) = mass
      end do
      call card%finish(k)
   end subroutine read_pmass

end module support_cards
