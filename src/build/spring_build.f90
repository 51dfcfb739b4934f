!> Bars, springs and masses: CROD with PROD, CONROD, and the BOLT cards that tighten some of them; CELAS1, CELAS2 and CBUSH as
!! bars of the model, one a direction, behind the bars themselves; CONM2, and whether there is any mass where the structure
!! shall oscillate.
module spring_build
   use bulk_data, only: bolt_card, edge_card, edge_crod, mass_card, prod_card, spring_card
   use coordinate_systems, only: directions_at
   use deck_check, only: checked_deck
   use displacement_systems, only: find_system
   use kinds, only: wp
   use model_data, only: a_spring, bar_type, model_type, n_bars
   use node_build, only: find_nodes
   use reference_nodes, only: node_axes, rotation_at
   use structural_build, only: is_cut_beam
   use text_tools, only: integer_text
   implicit none
   private

   public :: build_bars, is_bar, find_stage, build_springs, build_masses, check_mass

   character(2), parameter :: axis_names(6) = ['T1', 'T2', 'T3', 'R1', 'R2', 'R3']

contains

   !> Whether an edge is a bar: a CROD with the id of a PROD.
   pure logical function is_bar(deck, edge)
      type(checked_deck), intent(in) :: deck
      type(edge_card), intent(in)    :: edge

      is_bar = edge%kind == edge_crod .and. edge%property > 0 .and. any(deck%bulk%prod%id == edge%property)
   end function is_bar

   !> Fill the bars of MODEL.
   subroutine build_bars(deck, model)
      type(checked_deck), intent(in)  :: deck
      type(model_type), intent(inout) :: model
      integer :: i, n, prod

      allocate (model%bars(size(deck%bulk%edge) + size(deck%bulk%conrod)))
      n = 0
      do i = 1, size(deck%bulk%edge)
         associate (edge => deck%bulk%edge(i))
            if (is_cut_beam(deck, edge)) call add_cut_beam(edge)
            if (.not. is_bar(deck, edge)) cycle
            n = n + 1
            prod = findloc(deck%bulk%prod%id, edge%property, dim=1)
            model%bars(n)%id = edge%id
            call find_nodes(deck, edge%line, edge%nodes(:2), model, model%bars(n)%nodes)
            call build_bar(deck, edge%line, deck%bulk%prod(prod), model, model%bars(n))
         end associate
      end do
      do i = 1, size(deck%bulk%conrod)
         associate (rod => deck%bulk%conrod(i))
            n = n + 1
            model%bars(n)%id = rod%id
            call find_nodes(deck, rod%line, rod%nodes, model, model%bars(n)%nodes, first=2)
            call build_bar(deck, rod%line, prod_card(line=rod%line, material=rod%material, area=rod%area, &
                           extra_mass=rod%extra_mass), model, model%bars(n))
         end associate
      end do
      model%bars = model%bars(:n)
      do i = 1, size(deck%bulk%bolt)
         if (deck%bulk%bolt(i)%element > 0) call tighten(deck, deck%bulk%bolt(i), model) ! else a solid bolt
      end do

   contains

      !> The bar that is the axial part of a beam with a BOLT; the beam has its mass.
      subroutine add_cut_beam(edge)
         type(edge_card), intent(in) :: edge

         associate (property => deck%bulk%beam_property(findloc(deck%bulk%beam_property%id, edge%property, dim=1)))
            if (all(deck%bulk%mat1%id /= property%material)) return ! said already
            n = n + 1
            model%bars(n)%id = edge%id
            model%bars(n)%nodes = [model%node_table%find(edge%nodes(1)), model%node_table%find(edge%nodes(2))]
            call build_bar(deck, edge%line, prod_card(line=property%line, material=property%material, &
                                                      area=property%section%area), model, model%bars(n))
            model%bars(n)%mass = 0.0_wp
         end associate
      end subroutine add_cut_beam

   end subroutine build_bars

   !> The stiffness and mass of BAR, whose card is on LINE and whose nodes are known, with the section of PROD.
   subroutine build_bar(deck, line, prod, model, bar)
      type(checked_deck), intent(in) :: deck
      integer, intent(in)            :: line
      type(prod_card), intent(in)    :: prod
      type(model_type), intent(in)   :: model
      type(bar_type), intent(inout)  :: bar
      integer  :: material
      real(wp) :: along(3), length

      material = findloc(deck%bulk%mat1%id, prod%material, dim=1)
      if (material == 0) then
         if (prod%material > 0) call deck%field_error(prod%line, 'MID', 'there is no MAT1 '//integer_text(prod%material))
         return
      end if
      if (any(bar%nodes == 0)) return
      along = model%x(:, bar%nodes(2)) - model%x(:, bar%nodes(1))
      length = norm2(along)
      if (length <= 0.0_wp) then
         call deck%errors%add(line, 'bar '//integer_text(bar%id)//' has no length')
         return
      end if
      bar%direction = spread(along/length, 2, 2)
      bar%stiffness = deck%bulk%mat1(material)%e*prod%area/length
      bar%area = prod%area
      bar%strength = deck%bulk%mat1(material)%strength
      bar%mass = deck%bulk%parameters%mass_factor*(deck%bulk%mat1(material)%rho*prod%area + prod%extra_mass)*length
      bar%expansion = deck%bulk%mat1(material)%alpha*length
      bar%reference = deck%bulk%mat1(material)%reference
      bar%damping = deck%bulk%mat1(material)%damping
      if (model%axisymmetric .and. abs(bar%direction(1, 1)) > 1.0e-9_wp) call deck%errors%add(line, 'bar '// &
         integer_text(bar%id)//': in an axisymmetric model bars stand along y; their area is that of all round the ring')
   end subroutine build_bar

   !> The BOLT of a bar: which one it is, and in which stage it is tightened.
   subroutine tighten(deck, card, model)
      type(checked_deck), intent(in)  :: deck
      type(bolt_card), intent(in)     :: card
      type(model_type), intent(inout) :: model
      integer :: k, stage

      k = findloc(model%bars%id, card%element, dim=1)
      call find_stage(deck, card, stage)
      if (k == 0) call deck%field_error(card%line, 'EID', 'there is no CROD '//integer_text(card%element)// &
                                           ' with a PROD, nor a CONROD, CBAR or CBEAM')
      if (k == 0 .or. stage == 0) return
      associate (bar => model%bars(k))
         if (bar%bolt > 0) then
            call deck%field_error(card%line, 'EID', 'CROD '//integer_text(card%element)//' is BOLT '//integer_text(bar%bolt)// &
                                  ' already')
            return
         end if
         bar%bolt = card%id
         bar%preload = card%preload
         bar%stage = stage
      end associate
   end subroutine tighten

   !> Position of the STAGE in which the bolt of CARD is tightened; 0: it is not there.
   subroutine find_stage(deck, card, stage)
      type(checked_deck), intent(in) :: deck
      type(bolt_card), intent(in)    :: card
      integer, intent(out)           :: stage

      stage = findloc(deck%control%stages%id, card%stage, dim=1)
      if (stage == 0 .and. card%stage > 0) call deck%field_error(card%line, 'STAGE', &
         'there is no SUBCASE '//integer_text(card%stage))
   end subroutine find_stage

   !> Append the springs to the bars of MODEL.
   subroutine build_springs(deck, model)
      type(checked_deck), intent(in)  :: deck
      type(model_type), intent(inout) :: model
      type(bar_type), allocatable :: bars(:)
      integer :: i, n

      associate (cards => deck%bulk%spring, laws => deck%bulk%spring_property)
         call deck%report_repeated('PELAS', pack(laws%id, .not. laws%is_bush), pack(laws%line, .not. laws%is_bush))
         call deck%report_repeated('PBUSH', pack(laws%id, laws%is_bush), pack(laws%line, laws%is_bush))
         if (size(cards) == 0) return
         n = size(model%bars)
         allocate (bars(n + 6*size(cards)))
         bars(:n) = model%bars
         do i = 1, size(cards)
            call build_spring(deck, cards(i), model, bars, n)
         end do
      end associate
      model%bars = bars(:n)
   end subroutine build_springs

   !> The springs of one CARD, behind the first N of BARS.
   subroutine build_spring(deck, card, model, bars, n)
      type(checked_deck), intent(in)  :: deck
      type(spring_card), intent(in)   :: card
      type(model_type), intent(inout) :: model
      type(bar_type), intent(inout)   :: bars(:)
      integer, intent(inout)          :: n
      real(wp) :: stiffness(6), damping, directions(3, 3)
      integer  :: k, nodes(2)
      logical  :: ok

      call find_stiffness(deck, card, stiffness, damping)
      if (card%is_bush) then
         call find_nodes(deck, card%line, card%nodes, model, nodes)
         call find_axes(deck, card, model, nodes, stiffness, directions, ok)
         if (.not. ok) return
         do k = 1, 6
            if (stiffness(k) <= 0.0_wp) cycle
            if (k > 3) call add_rotational(k, stiffness(k), spread(directions(:, k - 3), 2, 2))
            if (k <= 3) call add(axis_names(k), stiffness(k), spread(directions(:, k), 2, 2), nodes)
         end do
      else
         do k = 1, 2
            call find_nodes(deck, card%line, card%nodes(k:k), model, nodes(k:k), first=2*k + 1)
            directions(:, k) = 0.0_wp
            if (nodes(k) == 0) cycle
            if (card%components(k) == 3 .and. model%dimension == 2) call deck%field_error(card%line, 'C'//integer_text(k), &
               'a plane model has no component 3')
            if (all(card%components(k) /= [1, 2, model%dimension, 4, 5, 6])) return ! said
            directions(:, k) = direction_of(model, nodes(k), card%components(k) - merge(3, 0, card%components(k) > 3))
         end do
         k = merge(1, 2, card%nodes(1) > 0) ! the first node that is not the ground
         if (any(nodes == 0 .and. card%nodes > 0) .or. all(card%nodes == 0)) return
         if (k == 1) directions(:, :2) = -directions(:, :2) ! NASTRAN's force is k (u_1 - u_2)
         if (k == 2) nodes = nodes([2, 1])
         if (k == 2) directions(:, 1) = directions(:, 2)
         if (card%components(k) > 3) then
            call add_rotational(card%components(k), stiffness(1), directions(:, :2))
         else
            call add(axis_names(card%components(k)), stiffness(1), directions(:, :2), nodes)
         end if
         if (n > 0) bars(n)%ground_first = k == 2
      end if

   contains

      !> A spring between rotations about AXES, unit: between the nodes of these, whose components are rotations times an arm.
      subroutine add_rotational(component, k_axis, axes)
         integer, intent(in)  :: component
         real(wp), intent(in) :: k_axis, axes(3, 2)
         real(wp) :: along(3, 2)
         integer  :: end, turned(2)

         turned = 0
         along = 0.0_wp
         if (model%dimension == 2 .and. component /= 6) return ! turns nothing in the plane
         do end = 1, 2
            if (nodes(end) == 0) cycle
            if (rotation_at(model, nodes(end)) == 0) then
               call deck%errors%add(card%line, 'spring '//integer_text(card%id)//': node '// &
                  integer_text(model%node_id(nodes(end)))// &
                  ' has no rotations; expected a node of shells or beams, or the reference node of an RBE2')
               return
            end if
            associate (rotation => model%rotations(rotation_at(model, nodes(end))))
               turned(end) = rotation%node
               along(:, end) = axes(:, end)/rotation%arm
               if (model%dimension == 2) along(:, end) = [axes(3, end), 0.0_wp, 0.0_wp]/rotation%arm
            end associate
         end do
         if (turned(2) == 0) along(:, 2) = along(:, 1)
         call add(axis_names(component), k_axis, along, turned)
      end subroutine add_rotational

      subroutine add(axis, k_axis, along, nodes)
         character(2), intent(in) :: axis
         real(wp), intent(in)     :: k_axis, along(3, 2)
         integer, intent(in)      :: nodes(2)

         n = n + 1
         bars(n)%id = card%id
         bars(n)%nodes = nodes
         bars(n)%kind = a_spring
         bars(n)%axis = axis
         bars(n)%stiffness = k_axis
         bars(n)%damping = damping
         bars(n)%direction = along
         model%used(pack(nodes, nodes > 0)) = .true.
      end subroutine add

   end subroutine build_spring

   !> The stiffness of the spring of CARD, the first one of a CELAS, and its structural damping.
   subroutine find_stiffness(deck, card, stiffness, damping)
      type(checked_deck), intent(in) :: deck
      type(spring_card), intent(in)  :: card
      real(wp), intent(out)          :: stiffness(6) !! [force/length], [moment]
      real(wp), intent(out)          :: damping      !! [-]
      integer :: k

      stiffness = 0.0_wp
      stiffness(1) = card%stiffness
      damping = card%damping
      if (card%property == 0) return
      associate (laws => deck%bulk%spring_property)
         k = findloc(laws%id == card%property .and. (laws%is_bush .eqv. card%is_bush), .true., dim=1)
         if (k > 0) then
            stiffness = laws(k)%stiffness
            damping = laws(k)%damping
         else
            call deck%field_error(card%line, 'PID', 'there is no '//trim(merge('PBUSH', 'PELAS', card%is_bush))//' '// &
                                  integer_text(card%property))
         end if
      end associate
   end subroutine find_stiffness

   !> The axes of a CBUSH at its first node: of its system; without one, along the line between its nodes where it has K1 alone, and
   !! global where they stand in one place.
   subroutine find_axes(deck, card, model, nodes, stiffness, directions, ok)
      type(checked_deck), intent(in) :: deck
      type(spring_card), intent(in)  :: card
      type(model_type), intent(in)   :: model
      integer, intent(in)            :: nodes(2)
      real(wp), intent(in)           :: stiffness(6)
      real(wp), intent(out)          :: directions(3, 3) !! columns, unit
      logical, intent(out)           :: ok
      integer :: system

      directions = reshape([1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp], [3, 3])
      ok = nodes(1) > 0 .and. (nodes(2) > 0 .or. card%nodes(2) == 0)
      if (.not. ok) return
      if (card%system > 0) then
         call find_system(deck, card%line, 'CID', card%system, model%systems, system)
         ok = system > 0
         if (.not. ok) return
         call directions_at(model%systems(system), model%x(:, nodes(1)), directions, ok)
         if (.not. ok) call deck%field_error(card%line, 'CID', 'GA lies on the axis of system '//integer_text(card%system)// &
                                             ', where its first two directions are not defined')
      else if (card%system < 0 .and. nodes(2) > 0) then
         associate (along => model%x(:, nodes(2)) - model%x(:, nodes(1)))
            if (norm2(along) <= 0.0_wp) return
            ok = all(stiffness(2:) <= 0.0_wp)
            if (ok) directions(:, 1) = along/norm2(along)
            if (.not. ok) call deck%field_error(card%line, 'CID', 'blank, but GA and GB stand apart and there is more than '// &
               'K1; expected the system of its axes, 0 for global axes')
         end associate
      end if
   end subroutine find_axes

   !> Direction of COMPONENT of a node: global, or of its displacement system CD.
   pure function direction_of(model, node, component) result(direction)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: node, component
      real(wp) :: direction(3)
      logical  :: is_turned

      direction = 0.0_wp
      is_turned = allocated(model%node_system)
      if (is_turned) is_turned = model%node_system(node) > 0
      if (is_turned) then
         associate (axes => node_axes(model, node))
            direction = axes(:, component)
         end associate
      else
         direction(component) = 1.0_wp
      end if
   end function direction_of

   !> Fill the masses of MODEL, PARAM WTMASS on them, and how elements have theirs. A CONM2 stands at a node that some element holds.
   subroutine build_masses(deck, model)
      type(checked_deck), intent(in)  :: deck
      type(model_type), intent(inout) :: model
      integer :: i, n

      model%lumped = deck%control%lumped
      associate (parameters => deck%bulk%parameters)
         if (parameters%mass_line > 0 .and. .not. deck%control%mass_is_given) then
            model%lumped = parameters%lumped
         else if (parameters%mass_line > 0 .and. (parameters%lumped .neqv. model%lumped)) then
            call deck%errors%add(parameters%mass_line, 'PARAM COUPMASS asks for '// &
               trim(merge('lumped    ', 'consistent', parameters%lumped))//' mass, but MASS in case control does not; expected '// &
                  'only one of them')
         end if
      end associate
      allocate (model%masses(size(deck%bulk%mass)))
      n = 0
      do i = 1, size(deck%bulk%mass)
         associate (card => deck%bulk%mass(i), node => model%node_table%find(deck%bulk%mass(i)%node))
            if (node == 0) cycle
            if (.not. model%used(node)) &
               call deck%field_error(card%line, 'G', 'node '//integer_text(card%node)//' belongs to no element')
            n = n + 1
            model%masses(n)%node = node
            model%masses(n)%mass = deck%bulk%parameters%mass_factor*card%mass
            call find_inertia(deck, model, card, model%x(:, node), model%masses(n)%inertia)
         end associate
      end do
      model%masses = model%masses(:n)
   end subroutine build_masses

   !> The INERTIA of CARD about its node, turned from its system into global axes [force x time^2 x length]: I11, I22, I33 on the
   !! diagonal, -I21, -I31, -I32 beside it, I21 the integral of x_1 x_2 over the mass.
   subroutine find_inertia(deck, model, card, x, inertia)
      type(checked_deck), intent(in) :: deck
      type(model_type), intent(in)   :: model
      type(mass_card), intent(in)    :: card
      real(wp), intent(in)           :: x(3)          !! of the node [length]
      real(wp), intent(out)          :: inertia(3, 3)
      real(wp) :: axes(3, 3)
      integer  :: system
      logical  :: ok

      associate (i11 => card%inertia(1), i21 => card%inertia(2), i22 => card%inertia(3), i31 => card%inertia(4), &
                 i32 => card%inertia(5), i33 => card%inertia(6))
         inertia = deck%bulk%parameters%mass_factor*reshape([i11, -i21, -i31, -i21, i22, -i32, -i31, -i32, i33], [3, 3])
      end associate
      if (any(deck%control%stages%vibration%modes%id > 0) .and. .not. is_inertia(inertia)) call deck%field_error(card%line, &
         'I11', 'not a possible inertia tensor: it must be positive semidefinite')
      if (card%system == 0) return
      call find_system(deck, card%line, 'CID', card%system, model%systems, system)
      if (system == 0 .or. all(abs(card%inertia) <= 0.0_wp)) return
      call directions_at(model%systems(system), x, axes, ok)
      if (ok) then
         inertia = matmul(axes, matmul(inertia, transpose(axes)))
      else
         call deck%field_error(card%line, 'CID', 'the node lies on the axis of system '//integer_text(card%system)// &
                               ', where its first two directions are not defined')
      end if
   end subroutine find_inertia

   !> Whether no turning has an energy below zero: no minor on the diagonal is, rounding aside.
   pure logical function is_inertia(a)
      real(wp), intent(in) :: a(3, 3) !! symmetric
      real(wp), parameter :: rounding = 1.0e-12_wp
      real(wp) :: b(3, 3), size_of
      integer  :: i, j

      size_of = maxval(abs(a))
      is_inertia = .true.
      if (size_of <= 0.0_wp) return
      b = a/size_of
      do i = 1, 3
         j = modulo(i, 3) + 1
         is_inertia = is_inertia .and. b(i, i) >= 0.0_wp .and. b(i, i)*b(j, j) - b(i, j)**2 >= -rounding
      end do
      is_inertia = is_inertia .and. b(1, 1)*(b(2, 2)*b(3, 3) - b(2, 3)**2) - b(1, 2)*(b(1, 2)*b(3, 3) - b(2, 3)*b(1, 3)) &
                   + b(1, 3)*(b(1, 2)*b(2, 3) - b(2, 2)*b(1, 3)) >= -rounding
   end function is_inertia

   !> Where the deck asks for MODES, every body has a mass, its own or at one of its nodes or in a bar on it.
   subroutine check_mass(deck, model)
      type(checked_deck), intent(in) :: deck
      type(model_type), intent(in)   :: model !! its parts are found, bolts among what connects
      logical, allocatable :: has_mass(:)     ! (parts)
      integer :: e, i, line

      i = findloc(deck%control%stages%vibration%modes%id > 0, .true., dim=1)
      if (i == 0) return
      line = deck%control%stages(i)%vibration%modes%line
      allocate (has_mass(model%n_parts), source=.false.)
      do e = 1, model%n_elements
         if (model%properties(model%element_property(e))%rho > 0.0_wp) has_mass(model%part(model%element_nodes(1, e))) = .true.
      end do
      do i = 1, size(model%masses)
         if (model%masses(i)%mass > 0.0_wp) has_mass(model%part(model%masses(i)%node)) = .true.
      end do
      do i = 1, n_bars(model)
         if (model%bars(i)%mass > 0.0_wp) has_mass(model%part(model%bars(i)%nodes)) = .true. ! springs have none
      end do
      if (.not. any(has_mass)) then
         call deck%errors%add(line, 'MODES: the structure has no mass; give RHO on MAT1, or CONM2')
         return
      end if
      do e = 1, model%n_elements
         associate (part => model%part(model%element_nodes(1, e)))
            if (has_mass(part)) cycle
            call deck%errors%add(line, 'MODES: the body of element '//integer_text(model%element_id(e))// &
                                 ' has no mass; give RHO on its MAT1, or a CONM2 on it')
            has_mass(part) = .true. ! said
         end associate
      end do
   end subroutine check_mass

end module spring_build
