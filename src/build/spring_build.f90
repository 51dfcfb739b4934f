!> Bars of CROD and CONROD, BOLT cards of bars, and springs of CELAS1, CELAS2 and CBUSH.
!! A spring is stored as a bar of the model, one per direction; springs follow the bars.
module spring_build
   use bolt_threads, only: in_units, thread_type
   use bulk_data, only: bolt_card, edge_card, edge_crod, prod_card, spring_card
   use deck_check, only: checked_deck
   use displacement_systems, only: find_directions
   use kinds, only: wp
   use mesh_queries, only: shown_number
   use model_data, only: a_spring, bar_type, mesh_type, tightening_type
   use model_kind, only: space_hint
   use node_build, only: find_nodes
   use numbers, only: cross, identity
   use structural_build, only: is_beam_edge
   use text_tools, only: integer_text, one_of
   use tolerances, only: no_lever, zero_cosine
   use unit_watch, only: find_units
   use unknowns, only: node_axes, rotation_at
   implicit none
   private

   public :: build_bars, is_bar, add_tightening, find_thread, build_springs

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
      if (any(bar%nodes == 0)) return
      along = mesh%x(:, bar%nodes(2)) - mesh%x(:, bar%nodes(1))
      length = norm2(along)
      if (length <= 0.0_wp) then
         call deck%errors%add(line, 'bar '//integer_text(bar%id)//' has no length')
         return
      end if
      bar%direction = spread(along/length, 2, 2)
      bar%stiffness = deck%bulk%mat1(material)%e*prod%area/length
      if (.not. deck%bulk%mat1(material)%bars_only) &
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
   subroutine build_springs(deck, mesh)
      type(checked_deck), intent(in)  :: deck
      type(mesh_type), intent(inout) :: mesh
      type(bar_type), allocatable :: bars(:)
      real(wp) :: stiffness(6), damping
      integer  :: i, k, n

      associate (cards => deck%bulk%spring, laws => deck%bulk%spring_property)
         call deck%report_repeated('PELAS', pack(laws%id, .not. laws%is_bush), pack(laws%line, .not. laws%is_bush))
         call deck%report_repeated('PBUSH', pack(laws%id, laws%is_bush), pack(laws%line, laws%is_bush))
         if (size(cards) == 0) return
         n = size(mesh%bars)
         allocate (bars(n + 6*size(cards)))
         bars(:n) = mesh%bars
         do i = 1, size(cards)
            stiffness = [cards(i)%stiffness, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp] ! of a CELAS2
            damping = cards(i)%damping
            k = findloc(laws%id == cards(i)%property .and. (laws%is_bush .eqv. cards(i)%is_bush), .true., dim=1)
            if (cards(i)%property > 0 .and. k > 0) then
               stiffness = laws(k)%stiffness
               damping = laws(k)%damping
            else if (cards(i)%property > 0) then
               call deck%field_error(cards(i)%line, 'PID', 'there is no '//one_of(cards(i)%is_bush, 'PBUSH', 'PELAS')//' '// &
                                     integer_text(cards(i)%property))
            end if
            call build_spring(deck, cards(i), stiffness, damping, mesh, bars, n)
         end do
      end associate
      mesh%bars = bars(:n)
   end subroutine build_springs

   !> Append the springs of one CARD to BARS(:N).
   subroutine build_spring(deck, card, stiffness, damping, mesh, bars, n)
      type(checked_deck), intent(in)  :: deck
      type(spring_card), intent(in)   :: card
      real(wp), intent(in)            :: stiffness(6) !! of a CELAS the first [force/length], [moment]
      real(wp), intent(in)            :: damping      !! structural [-]
      type(mesh_type), intent(in) :: mesh
      type(bar_type), intent(inout)   :: bars(:)
      integer, intent(inout)          :: n
      real(wp) :: directions(3, 3), axes(3, 3)
      integer  :: k, nodes(2)
      logical  :: ok

      if (card%is_bush) then
         call find_nodes(deck, card%line, card%nodes, mesh, nodes)
         call find_axes(deck, card, mesh, nodes, stiffness, directions, ok)
         if (.not. ok) return
         do k = 1, 6
            if (stiffness(k) > 0.0_wp) call add(k, stiffness(k), spread(directions(:, modulo(k - 1, 3) + 1), 2, 2))
         end do
         return
      end if
      do k = 1, 2
         call find_nodes(deck, card%line, card%nodes(k:k), mesh, nodes(k:k), first=2*k + 1)
         directions(:, k) = 0.0_wp
         if (nodes(k) == 0) cycle
         if (card%components(k) == 3 .and. mesh%dimension == 2) call deck%field_error(card%line, 'C'//integer_text(k), &
            'a plane model has no component 3'//space_hint(mesh))
         if (all(card%components(k) /= [1, 2, mesh%dimension, 4, 5, 6])) return ! reported
         axes = node_axes(mesh, nodes(k))
         directions(:, k) = axes(:, modulo(card%components(k) - 1, 3) + 1)
      end do
      k = merge(1, 2, card%nodes(1) > 0) ! the first node that is not the ground
      if (any(nodes == 0 .and. card%nodes > 0) .or. all(card%nodes == 0)) return
      if (k == 1) directions(:, :2) = -directions(:, :2) ! the force of NASTRAN is k (u_1 - u_2)
      if (k == 2) nodes = nodes([2, 1])
      if (k == 2) directions(:, 1) = directions(:, 2)
      call add(card%components(k), stiffness(1), directions(:, :2))
      if (n > 0) bars(n)%ground_first = k == 2

   contains

      !> A spring along AXES, unit, or between rotations about them: the nodes of rotations have rotations times an arm as
      !! components.
      subroutine add(component, k_axis, axes)
         integer, intent(in)  :: component
         real(wp), intent(in) :: k_axis, axes(3, 2)
         real(wp) :: along(3, 2)
         integer  :: end, ends(2)

         ends = nodes
         along = axes
         if (component > 3) then
            if (mesh%dimension == 2 .and. component /= 6) return ! no rotation in the plane
            along = 0.0_wp
            do end = 1, 2
               if (nodes(end) == 0) cycle
               if (rotation_at(mesh, nodes(end)) == 0) then
                  call deck%errors%add(card%line, 'spring '//integer_text(card%id)//': node '// &
                     integer_text(shown_number(mesh, nodes(end)))// &
                     ' has no rotations; expected a node of shells or beams, or the reference node of an RBE2, RBAR, or RBE3 '// &
                     'with rotations in REFC')
                  return
               end if
               associate (rotation => mesh%rotations(rotation_at(mesh, nodes(end))))
                  ends(end) = rotation%node
                  along(:, end) = axes(:, end)/rotation%arm
                  if (mesh%dimension == 2) along(:, end) = [axes(3, end), 0.0_wp, 0.0_wp]/rotation%arm
               end associate
            end do
            if (ends(2) == 0) along(:, 2) = along(:, 1)
         end if
         n = n + 1
         bars(n) = bar_type(id=card%id, nodes=ends, kind=a_spring, axis=axis_names(component), stiffness=k_axis, damping=damping, &
                            direction=along)
      end subroutine add

   end subroutine build_spring

   !> The axes of a CBUSH at its first node: those of its system; without a system, the line between its nodes if it has K1 and K4
   !! alone, and global axes if the nodes coincide. Error: a force between nodes apart that have rotations has a lever; the springs
   !! of this program apply no moments to their nodes.
   subroutine find_axes(deck, card, mesh, nodes, stiffness, directions, ok)
      type(checked_deck), intent(in) :: deck
      type(spring_card), intent(in)  :: card
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)            :: nodes(2)
      real(wp), intent(in)           :: stiffness(6)
      real(wp), intent(out)          :: directions(3, 3) !! columns, unit
      logical, intent(out)           :: ok
      real(wp) :: along(3), lever
      integer  :: axis, end

      directions = identity
      ok = nodes(1) > 0 .and. (nodes(2) > 0 .or. card%nodes(2) == 0)
      if (.not. ok) return
      if (card%system > 0) then
         call find_directions(deck, mesh%systems, card%line, card%system, mesh%x(:, nodes(1)), directions, ok, ['CID', 'GA '])
      else if (card%system < 0 .and. nodes(2) > 0) then
         along = mesh%x(:, nodes(2)) - mesh%x(:, nodes(1))
         if (norm2(along) <= 0.0_wp) return
         ok = all(stiffness([2, 3, 5, 6]) <= 0.0_wp)
         if (ok) directions(:, 1) = along/norm2(along)
         if (.not. ok) call deck%field_error(card%line, 'CID', 'blank, but GA and GB are apart and there is more than '// &
            'K1 and K4; expected the system of its axes, 0 for global axes')
      end if
      if (.not. ok .or. nodes(2) == 0) return
      lever = 0.0_wp
      do axis = 1, mesh%dimension
         if (stiffness(axis) > 0.0_wp) lever = max(lever, norm2(cross(mesh%x(:, nodes(2)) - mesh%x(:, nodes(1)), &
                                                                       directions(:, axis))))
      end do
      do end = 1, 2
         if (rotation_at(mesh, nodes(end)) == 0) cycle
         if (lever <= no_lever*mesh%rotations(rotation_at(mesh, nodes(end)))%arm) cycle
         call deck%field_error(card%line, 'GB', 'a spring across the line from GA to GB gives node '// &
            integer_text(shown_number(mesh, nodes(end)))//' a moment, since the nodes are apart; expected nodes in one place, '// &
            'one of them tied to GA or GB by an RBAR')
         return
      end do
   end subroutine find_axes

end module spring_build
