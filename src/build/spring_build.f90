!> Bars of CROD and CONROD, BOLT cards of bars, and springs of CELAS1 to CELAS4 and CBUSH.
!! A spring is stored as a bar of the model, one per direction; springs follow the bars.
module spring_build
   use bolt_threads, only: in_units, thread_type
   use bulk_data, only: edge_card, edge_crod, prod_card, spring_card, spring_property_card
   use bush_build, only: bush_type
   use deck_check, only: checked_deck
   use kinds, only: wp
   use load_data, only: bolt_card
   use mesh_queries, only: is_scalar_point, shown_number
   use model_data, only: a_spring, bar_type, mesh_type, tightening_type
   use model_kind, only: space_hint
   use node_build, only: find_nodes
   use structural_build, only: is_beam_edge
   use text_tools, only: integer_text, one_of
   use tolerances, only: zero_cosine
   use unit_watch, only: find_units
   use unknowns, only: node_axes, rotation_at
   implicit none
   private

   public :: build_bars, is_bar, add_tightening, find_thread, build_springs

   character(*), parameter :: turning_nodes = &
      '; expected a node of shells or beams, or the reference node of an RBE2, RBAR, or RBE3 with rotations in REFC'
   character(2), parameter :: axis_names(6) = ['T1', 'T2', 'T3', 'R1', 'R2', 'R3']

contains

   !> Whether an edge is a bar: a CROD with the id of a PROD.
   pure logical function is_bar(deck, edge)
      type(checked_deck), intent(in) :: deck
      type(edge_card), intent(in)    :: edge

      is_bar = edge%kind == edge_crod .and. edge%property > 0 .and. any(deck%bulk%prod%id == edge%property)
   end function is_bar

   !> Fill the bars of the model, and assign the BOLT cards of bars, with the stages that tighten them.
   subroutine build_bars(deck, mesh)
      type(checked_deck), intent(in)  :: deck
      type(mesh_type), intent(inout) :: mesh
      type(prod_card) :: prod
      integer :: i, k, n
      logical :: is_cut_beam

      deallocate (mesh%bars)
      allocate (mesh%bars(size(deck%bulk%edge) + size(deck%bulk%conrod)))
      n = 0
      do i = 1, size(deck%bulk%edge)
         associate (edge => deck%bulk%edge(i))
            is_cut_beam = is_beam_edge(deck, edge) .and. any(deck%bulk%bolt%element == edge%id)
            if (is_cut_beam) then ! the bar has the axial force of a beam with a BOLT, the beam keeps the mass
               associate (property => deck%bulk%beam_property(findloc(deck%bulk%beam_property%id, edge%property, dim=1)))
                  prod = prod_card(line=property%line, material=property%material, area=property%section%area)
               end associate
               if (all(deck%bulk%mat1%id /= prod%material)) cycle ! reported already
            else if (is_bar(deck, edge)) then
               prod = deck%bulk%prod(findloc(deck%bulk%prod%id, edge%property, dim=1))
            else
               cycle
            end if
            n = n + 1
            mesh%bars(n)%id = edge%id
            call find_nodes(deck, edge%line, edge%nodes(:2), mesh, mesh%bars(n)%nodes)
            call build_bar(deck, edge%line, prod, mesh, mesh%bars(n))
            if (is_cut_beam) mesh%bars(n)%mass = 0.0_wp
         end associate
      end do
      do i = 1, size(deck%bulk%conrod)
         associate (rod => deck%bulk%conrod(i))
            n = n + 1
            mesh%bars(n)%id = rod%id
            call find_nodes(deck, rod%line, rod%nodes, mesh, mesh%bars(n)%nodes, first=2)
            call build_bar(deck, rod%line, rod%prod_card, mesh, mesh%bars(n))
         end associate
      end do
      mesh%bars = mesh%bars(:n)
      do i = 1, size(deck%bulk%bolt)
         associate (card => deck%bulk%bolt(i))
            if (card%element == 0) cycle ! a solid bolt
            k = findloc(mesh%bars%id, card%element, dim=1)
            if (k == 0) call deck%field_error(card%line, 'EID', 'there is no CROD '//integer_text(card%element)// &
                                              ' with a PROD, nor a CONROD, CBAR or CBEAM')
            if (k == 0) cycle
            call add_tightening(deck, card, mesh%bars(k)%bolt, name_of_bar(deck, card%element), mesh%bars(k)%tightening)
            if (mesh%bars(k)%thread%size == '') call find_thread(deck, card, mesh, mesh%bars(k)%thread)
         end associate
      end do
   end subroutine build_bars

   !> Text such as 'CONROD 7' for the bar or beam ID, as its card has it.
   function name_of_bar(deck, id) result(name)
      type(checked_deck), intent(in) :: deck
      integer, intent(in)            :: id
      character(:), allocatable :: name
      integer :: k, line

      line = 0
      k = findloc(deck%bulk%edge%id, id, dim=1)
      if (k > 0) line = deck%bulk%edge(k)%line
      k = findloc(deck%bulk%conrod%id, id, dim=1)
      if (k > 0) line = deck%bulk%conrod(k)%line
      name = deck%card_on(line)//' '//integer_text(id)
   end function name_of_bar

   !> The stiffness and mass of BAR with the section of PROD; its card is on LINE, its nodes are known.
   subroutine build_bar(deck, line, prod, mesh, bar)
      type(checked_deck), intent(in) :: deck
      integer, intent(in)            :: line
      type(prod_card), intent(in)    :: prod
      type(mesh_type), intent(in) :: mesh
      type(bar_type), intent(inout)  :: bar
      integer  :: material
      real(wp) :: along(3), length

      material = findloc(deck%bulk%mat1%id, prod%material, dim=1)
      if (material == 0) then
         if (prod%material > 0) call deck%field_error(prod%line, 'MID', 'there is no MAT1 '//integer_text(prod%material))
         return
      end if
      if (deck%bulk%mat1(material)%name /= 'MAT1') call deck%field_error(prod%line, 'MID', deck%bulk%mat1(material)%name//' '// &
         integer_text(prod%material)//' is no material of bars; expected a MAT1')
      if (any(bar%nodes == 0)) return
      along = mesh%x(:, bar%nodes(2)) - mesh%x(:, bar%nodes(1))
      length = norm2(along)
      if (length <= 0.0_wp) then
         call deck%errors%add(line, 'bar '//integer_text(bar%id)//' has no length')
         return
      end if
      bar%direction = spread(along/length, 2, 2)
      bar%stiffness = deck%bulk%mat1(material)%e*prod%area/length
      bar%torsion = deck%bulk%mat1(material)%shear*prod%torsion/length
      bar%area = prod%area
      bar%strength = deck%bulk%mat1(material)%strength
      bar%mass = deck%bulk%parameters%mass_factor*(deck%bulk%mat1(material)%rho*prod%area + prod%extra_mass)*length
      bar%expansion = deck%bulk%mat1(material)%alpha*length
      bar%reference = deck%bulk%mat1(material)%reference
      bar%damping = deck%bulk%mat1(material)%damping
      if (mesh%axisymmetric .and. abs(bar%direction(1, 1)) > zero_cosine) call deck%errors%add(line, 'bar '// &
         integer_text(bar%id)//': in an axisymmetric model bars stand along y; their area is that of all round the ring')
   end subroutine build_bar

   !> Add the stage of CARD to the TIGHTENING of bolt ID, which becomes the number of its first card.
   subroutine add_tightening(deck, card, id, part, tightening)
      type(checked_deck), intent(in)       :: deck
      type(bolt_card), intent(in)          :: card
      integer, intent(inout)               :: id
      character(*), intent(in)             :: part !! what is tightened, for the message
      type(tightening_type), intent(inout) :: tightening
      integer :: n, stage

      stage = findloc(deck%control%stages%id, card%stage, dim=1)
      if (stage == 0 .and. card%stage > 0) call deck%field_error(card%line, 'STAGE', &
         'there is no SUBCASE '//integer_text(card%stage))
      if (stage == 0) return
      if (id == 0) id = card%id
      if (.not. allocated(tightening%stage)) allocate (tightening%stage(0), tightening%preload(0))
      if (any(tightening%stage == stage)) then
         call deck%field_error(card%line, 'STAGE', part//' is BOLT '//integer_text(id)// &
            ' already, which this SUBCASE tightens; expected one BOLT for each SUBCASE')
         return
      end if
      n = count(tightening%stage < stage)
      tightening%preload = [tightening%preload(:n), card%preload, tightening%preload(n + 1:)]
      tightening%stage = [tightening%stage(:n), stage, tightening%stage(n + 1:)]
   end subroutine add_tightening

   !> The THREAD of the bolt of CARD in the units of the deck.
   subroutine find_thread(deck, card, mesh, thread)
      type(checked_deck), intent(in) :: deck
      type(bolt_card), intent(in)    :: card
      type(mesh_type), intent(in)    :: mesh
      type(thread_type), intent(out) :: thread
      real(wp) :: metre, newton

      if (card%thread%size == '') return
      call find_units(deck%control, metre, newton)
      if (.not. (metre > 0.0_wp .and. newton > 0.0_wp)) then
         call deck%field_error(card%line, 'SIZE', 'the strength of a class is in N/mm2, and case control names no units known '// &
                               'here; expected UNITS, of MM, M or IN and of N, KN, KGF or LBF')
         return
      end if
      if (mesh%axisymmetric .and. .not. card%thread%count > 0.0_wp) call deck%field_error(card%line, 'COUNT', &
         'blank; expected the number of bolts round the ring of an axisymmetric model')
      thread = in_units(card%thread, 1.0_wp/(1000.0_wp*metre), 1.0e6_wp*metre**2/newton)
   end subroutine find_thread

   !> Append the springs to the bars of the model.
   subroutine build_springs(deck, bushes, mesh)
      type(checked_deck), intent(in) :: deck
      type(bush_type), intent(in)    :: bushes(:)
      type(mesh_type), intent(inout) :: mesh
      type(bar_type), allocatable :: bars(:)
      type(spring_property_card) :: law
      logical :: is_kind(size(deck%bulk%spring_property))
      integer :: i, k, n

      associate (cards => deck%bulk%spring, laws => deck%bulk%spring_property)
         is_kind = .not. (laws%is_bush .or. laws%is_damper)
         call deck%report_repeated('PELAS', pack(laws%id, is_kind), pack(laws%line, is_kind))
         is_kind = laws%is_damper .and. .not. laws%is_bush
         call deck%report_repeated('PDAMP', pack(laws%id, is_kind), pack(laws%line, is_kind))
         is_kind = laws%is_bush .and. .not. laws%is_damper
         call deck%report_repeated('PBUSH', pack(laws%id, is_kind), pack(laws%line, is_kind))
         is_kind = laws%is_bush .and. laws%is_damper
         call deck%report_repeated('PVISC', pack(laws%id, is_kind), pack(laws%line, is_kind))
         if (size(cards) == 0) return
         n = size(mesh%bars)
         allocate (bars(n + 6*size(cards)))
         bars(:n) = mesh%bars
         do i = 1, size(cards)
            if (bushes(i)%is_whole) call build_bush(deck, cards(i), bushes(i), laws(bushes(i)%property), mesh, bars, n)
            if (cards(i)%is_bush) cycle
            law = spring_property_card()
            law%stiffness(1) = cards(i)%stiffness ! of a CELAS2
            law%damping(1) = cards(i)%damping
            law%viscous(1) = cards(i)%viscous
            k = findloc(laws%id == cards(i)%property .and. .not. laws%is_bush .and. (laws%is_damper .eqv. cards(i)%is_damper), &
                        .true., dim=1)
            if (cards(i)%property > 0 .and. k > 0) law = laws(k)
            if (cards(i)%property > 0 .and. k == 0) call deck%field_error(cards(i)%line, 'PID', 'there is no '// &
               one_of(cards(i)%is_damper, 'PDAMP ', 'PELAS ')//integer_text(cards(i)%property))
            call build_spring(deck, cards(i), law, mesh, bars, n)
         end do
      end associate
      mesh%bars = bars(:n)
   end subroutine build_springs

   !> Append the springs of a CBUSH, one for each axis with K or B, to BARS(:N). Where only GE1 of all PBUSH is given it holds for all six.
   subroutine build_bush(deck, card, bush, law, mesh, bars, n)
      type(checked_deck), intent(in) :: deck
      type(spring_card), intent(in)  :: card
      type(bush_type), intent(in)    :: bush
      type(spring_property_card), intent(in) :: law
      type(mesh_type), intent(in)    :: mesh
      type(bar_type), intent(inout)  :: bars(:)
      integer, intent(inout)         :: n
      type(bar_type), allocatable :: spring ! on the heap: the compiler warns of its bounds where it is a local variable
      real(wp) :: damping(6)
      integer  :: end, i, k
      logical  :: ok

      allocate (spring)
      damping = law%damping
      if (all([(deck%bulk%spring_property(i)%damping(2:) <= 0.0_wp .or. .not. deck%bulk%spring_property(i)%is_bush, &
                i = 1, size(deck%bulk%spring_property))])) damping = law%damping(1)
      do end = 1, 2
         if (.not. bush%has_arm(end)) cycle
         if (rotation_at(mesh, bush%nodes(end)) > 0) cycle
         call deck%field_error(card%line, one_of(end == 1, 'GA', 'GB'), 'node '// &
            integer_text(shown_number(mesh, bush%nodes(end)))//' has no rotations, but the nodes are apart, so '// &
            'that this bush gives it a moment'//turning_nodes)
         return
      end do
      do k = 1, 6
         if (.not. law%stiffness(k) + law%viscous(k) > 0.0_wp) cycle
         spring%id = card%id
         spring%nodes = bush%nodes
         spring%kind = a_spring
         spring%axis = axis_names(k)
         spring%stiffness = law%stiffness(k)
         spring%damping = damping(k)
         spring%viscous = law%viscous(k)
         spring%direction = spread(bush%axes(:, modulo(k - 1, 3) + 1), 2, 2)
         if (k <= 3) then
            do end = 1, 2
               if (bush%face(end) > 0) spring%nodes(end) = mesh%faces(bush%face(end))%node
            end do
         else
            if (mesh%dimension == 2 .and. k < 6) cycle ! no rotation in the plane
            ok = .true.
            do end = 1, 2
               if (ok .and. bush%nodes(end) > 0) call onto_rotation(deck, card, mesh, spring, end, ok)
            end do
            if (.not. ok) return
         end if
         n = n + 1
         bars(n) = spring
      end do
   end subroutine build_bush

   !> SPRING at END, so far along an axis, acts about it: on the node of rotations, whose components are rotations times an arm.
   subroutine onto_rotation(deck, card, mesh, spring, end, ok)
      type(checked_deck), intent(in) :: deck
      type(spring_card), intent(in)  :: card
      type(mesh_type), intent(in)    :: mesh
      type(bar_type), intent(inout)  :: spring
      integer, intent(in)            :: end
      logical, intent(out)           :: ok
      integer :: rotation

      rotation = rotation_at(mesh, spring%nodes(end))
      ok = rotation > 0
      if (.not. ok) then
         call deck%errors%add(card%line, 'spring '//integer_text(card%id)//': node '// &
                              integer_text(shown_number(mesh, spring%nodes(end)))//' has no rotations'//turning_nodes)
         return
      end if
      associate (along => spring%direction(:, end))
         if (mesh%dimension == 2) along = [along(3), 0.0_wp, 0.0_wp]
         along = along/mesh%rotations(rotation)%arm
      end associate
      spring%nodes(end) = mesh%rotations(rotation)%node
   end subroutine onto_rotation

   !> Append the spring of a CELAS or CDAMP to BARS(:N), with the first values of LAW. The force of NASTRAN is k (u_1 - u_2).
   subroutine build_spring(deck, card, law, mesh, bars, n)
      type(checked_deck), intent(in) :: deck
      type(spring_card), intent(in)  :: card
      type(spring_property_card), intent(in) :: law
      type(mesh_type), intent(in)    :: mesh
      type(bar_type), intent(inout)  :: bars(:)
      integer, intent(inout)         :: n
      type(bar_type) :: spring
      real(wp) :: axes(3, 3)
      integer  :: component, k
      logical  :: ok

      spring = bar_type(id=card%id, kind=a_spring, stiffness=law%stiffness(1), damping=law%damping(1), viscous=law%viscous(1))
      do k = 2, 1, -1 ! AXIS is the component of the first node that is not the ground
         call find_nodes(deck, card%line, card%nodes(k:k), mesh, spring%nodes(k:k), first=2*k + 1)
         if (spring%nodes(k) == 0) cycle
         component = card%components(k)
         if (is_scalar_point(mesh, spring%nodes(k))) component = 1
         if (card%components(k) == 3 .and. mesh%dimension == 2) call deck%field_error(card%line, 'C'//integer_text(k), &
            'a plane model has no component 3'//space_hint(mesh))
         if (component == 0) call deck%field_error(card%line, 'C'//integer_text(k), 'blank or 0, expected the component at G'// &
                                                   integer_text(k))
         if (all(component /= [1, 2, mesh%dimension, 4, 5, 6])) return ! reported
         axes = node_axes(mesh, spring%nodes(k))
         spring%direction(:, k) = -axes(:, modulo(component - 1, 3) + 1)
         spring%axis = axis_names(component)
         if (component <= 3) cycle
         if (mesh%dimension == 2 .and. component /= 6) return ! no rotation in the plane
         call onto_rotation(deck, card, mesh, spring, k, ok)
         if (.not. ok) return
      end do
      if (any(spring%nodes == 0 .and. card%nodes > 0) .or. all(card%nodes == 0)) return
      if (card%nodes(1) == 0) then
         spring%ground_first = .true.
         spring%nodes = spring%nodes([2, 1])
         spring%direction(:, 1) = -spring%direction(:, 2)
      end if
      if (spring%nodes(2) == 0) spring%direction(:, 2) = spring%direction(:, 1)
      n = n + 1
      bars(n) = spring
   end subroutine build_spring

end module spring_build
