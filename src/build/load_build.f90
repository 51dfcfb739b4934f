!> Loads at the end of every stage: nodal forces and prescribed displacements.
!! FORCE, FORCE1 and FORCE2 are vectors in global axes; MOMENT acts on rotations.
module load_build
   use body_loads, only: acceleration_field, add_gravity, add_to_beam, check_plane, find_beam_loads, find_fields
   use case_entries, only: set_reference
   use deck_check, only: checked_deck
   use displacement_systems, only: find_directions
   use field_rules, only: has_component
   use kinds, only: wp
   use load_data, only: force_card
   use load_changes, only: forget_others, nodal_loads, note_changes
   use model_data, only: freedoms_type, history_type, mesh_type, stage_load_type, supported
   use model_kind, only: space_hint
   use node_coupling, only: coupling_parts
   use numbers, only: cross, identity
   use pressure_loads, only: add_pressure, add_surface_load, find_pressed_sides, pressed_side
   use support_build, only: check_kept, differ, keep_moved, move
   use surface_build, only: find_surface
   use surface_sides, only: nodes_of
   use text_tools, only: integer_text, one_of
   use tolerances, only: zero_component, zero_component_along
   use unknowns, only: node_axes, place_of_component, rotation_at, rotation_component
   use wave_build, only: add_force, check_waves, has_set, list_waves, planned_wave
   implicit none
   private

   public :: build_loads, add_force

   !> The loads of cards as vectors: where they act and what they are.
   type :: card_loads
      integer, allocatable  :: node(:)          ! (cards of nodal forces) the loaded node
      real(wp), allocatable :: force(:, :)      ! (3, likewise) in global axes [force]
      type(pressed_side), allocatable :: pressed(:)
      type(acceleration_field), allocatable :: fields(:)
      integer, allocatable  :: beam(:)          ! (PLOAD1) the loaded element
      real(wp), allocatable :: end_force(:, :)  ! (12, PLOAD1) [force], [moment]
      real(wp), allocatable :: pressing(:, :)   ! (3, n_nodes) nodal forces of the pressures of a stage, where there are bolts [force]
   end type card_loads

   character(*), parameter :: others = 'PLOAD4, PLOADE, PLOAD, PLOAD1, PLOAD2, PLOADM, FORCEM, GRAV or SPCD' ! the other load cards
   character(*), parameter :: nor_others = ', nor a '//others ! behind the text `there is no FORCE`

contains

   !> Nodal forces of the cards: FORCE(:, i) of card I in global axes acts on NODE(i); of a moment on the node of rotations [force].
   !! It is zero where the card is in error.
   subroutine find_nodal_forces(deck, mesh, freedoms, node, force)
      type(checked_deck), intent(in)     :: deck
      type(mesh_type), intent(in) :: mesh
      type(freedoms_type), intent(in) :: freedoms
      integer, allocatable, intent(out)  :: node(:)     !! (cards)
      real(wp), allocatable, intent(out) :: force(:, :) !! (3, cards)
      real(wp) :: axes(3, 3)
      integer  :: i
      logical  :: ok

      allocate (node(size(deck%bulk%force)), source=0)
      allocate (force(3, size(deck%bulk%force)), source=0.0_wp)
      do i = 1, size(deck%bulk%force)
         associate (card => deck%bulk%force(i))
            node(i) = mesh%node_table%find(card%node)
            force(:, i) = card%force
            if (card%ends(1) > 0) then
               call along_lines(deck, mesh, card, force(:, i))
            else if (node(i) > 0) then
               call find_directions(deck, mesh%systems, card%line, card%system, mesh%x(:, node(i)), axes, ok)
               if (ok .and. card%system > 0) force(:, i) = matmul(axes, force(:, i))
            end if
            if (node(i) > 0) then ! a node without elements that is held takes its load, as in NASTRAN
               if (.not. freedoms%used(node(i)) .and. rotation_at(mesh, node(i)) == 0 .and. &
                   all(freedoms%support_of(:, node(i)) > 0)) then
                  call deck%errors%warn('node '//integer_text(card%node)//' belongs to no element and is held: its loads have '// &
                                        'no effect')
                  force(:, i) = 0.0_wp
                  cycle
               end if
            end if
            if (card%is_moment) then
               if (node(i) > 0) call onto_rotations(deck, mesh, freedoms, card, node(i), force(:, i))
               cycle
            end if
            if (node(i) > 0) then
               if (.not. freedoms%used(node(i))) call deck%field_error(card%line, 'G', 'node '//integer_text(card%node)// &
                                                                    ' belongs to no element')
               call check_movable(deck, mesh, freedoms, card, node(i), node_axes(mesh, node(i)), force(:, i))
            end if
            call check_plane(deck, mesh, card%line, force(:, i), &
                             one_of(card%ends(1) > 0, 'G1', one_of(card%system > 0, 'CID', 'N3')))
         end associate
      end do
   end subroutine find_nodal_forces

   !> A MOMENT acts on the rotations of NODE: NODE becomes the node of rotations, FORCE the moment divided by their arm.
   subroutine onto_rotations(deck, mesh, freedoms, card, node, force)
      type(checked_deck), intent(in) :: deck
      type(mesh_type), intent(in) :: mesh
      type(freedoms_type), intent(in) :: freedoms
      type(force_card), intent(in)   :: card
      integer, intent(inout)         :: node
      real(wp), intent(inout)        :: force(3) !! [moment], then [force]
      real(wp) :: axes(3, 3)
      integer  :: rotation

      rotation = rotation_at(mesh, node)
      if (rotation == 0) then
         call deck%field_error(card%line, 'G', 'node '//integer_text(card%node)//' has no rotations, so that no moment can act '// &
            'on it; expected a node of shells or beams, or the reference node of an RBE2, RBAR, or RBE3 with rotations in REFC')
         force = 0.0_wp
         return
      end if
      axes = node_axes(mesh, node)
      node = mesh%rotations(rotation)%node
      force = force/mesh%rotations(rotation)%arm
      if (mesh%dimension == 2) then
         if (any(abs(force(:2)) > zero_component*norm2(force))) call deck%field_error(card%line, 'N1', &
            'not zero, but in a plane model moments act about z: expected N3 alone'//space_hint(mesh))
         force = [force(3), 0.0_wp, 0.0_wp]
         axes = identity
      end if
      call check_movable(deck, mesh, freedoms, card, node, axes, force)
   end subroutine onto_rotations

   !> Error: a FORCE on a reference NODE along a component that was left out and depends on nothing: the node has no movement along
   !! it for any value of the unknowns.
   subroutine check_movable(deck, mesh, freedoms, card, node, axes, force)
      type(checked_deck), intent(in) :: deck
      type(mesh_type), intent(in) :: mesh
      type(freedoms_type), intent(in) :: freedoms
      type(force_card), intent(in)   :: card
      integer, intent(in)            :: node
      real(wp), intent(in)           :: axes(3, 3), force(3)
      integer :: d, digit, k, parts(2)

      if (size(freedoms%left_out) == 0) return
      parts = coupling_parts(freedoms, node)
      do d = 1, mesh%dimension
         if (.not. freedoms%left_out(d, node) .or. abs(dot_product(axes(:, d), force)) <= zero_component_along*norm2(force)) cycle
         if (any([(abs(matmul(axes(:mesh%dimension, d), freedoms%coupling%t(:, :, k))) > 0.0_wp, k = parts(1), parts(2))])) cycle
         digit = d
         if (card%is_moment) digit = findloc([(rotation_component(mesh, digit), digit = 1, 6)], d, dim=1)
         call deck%field_error(card%line, 'G', 'component '//integer_text(digit)//' of node '//integer_text(card%node)// &
                               ' takes no load: no element, dependent node or support has this component')
         return
      end do
   end subroutine check_movable

   !> FORCE of a FORCE1, along a line between two nodes, or of a FORCE2, perpendicular to two such lines.
   subroutine along_lines(deck, mesh, card, force)
      type(checked_deck), intent(in) :: deck
      type(mesh_type), intent(in) :: mesh
      type(force_card), intent(in)   :: card
      real(wp), intent(inout)        :: force(3)
      real(wp) :: direction(3), line(3, 2)
      integer  :: k, nodes(4)

      force = 0.0_wp
      nodes = [(mesh%node_table%find(card%ends(k)), k = 1, 4)]
      if (any(nodes == 0 .and. (card%ends > 0 .or. card%ends(3) > 0)) .or. any(nodes(:2) == 0)) return
      do k = 1, merge(2, 1, nodes(3) > 0)
         line(:, k) = mesh%x(:, nodes(2*k)) - mesh%x(:, nodes(2*k - 1))
      end do
      direction = line(:, 1)
      if (nodes(3) > 0) direction = cross(line(:, 1), line(:, 2))
      if (norm2(direction) > 0.0_wp) then
         force = card%force(1)*direction/norm2(direction)
      else if (nodes(3) > 0) then
         call deck%field_error(card%line, 'G1', 'the lines G1-G2 and G3-G4 are parallel or have no length: the force has no '// &
                               'direction')
      else
         call deck%field_error(card%line, 'G1', 'G1 and G2 lie in one place: the force has no direction')
      end if
   end subroutine along_lines

   !> Errors of load cards. PLOADM and FORCEM: missing surfaces, and a pressure on a surface with bodies on both sides. SPCD: a
   !! component that is not supported. LOAD: missing sets.
   subroutine check_cards(deck, mesh, freedoms)
      type(checked_deck), intent(in) :: deck
      type(mesh_type), intent(in) :: mesh
      type(freedoms_type), intent(in) :: freedoms
      character(:), allocatable :: words
      character(len(others))    :: kinds ! of cards
      logical :: held(mesh%dimension)
      integer :: d, i, k, node, s

      ! PLOADM and FORCEM
      do i = 1, size(deck%bulk%surface_load)
         associate (card => deck%bulk%surface_load(i))
            if (card%surface == 0) cycle
            call find_surface(deck, card%line, 'PID', card%surface, mesh, s)
            if (s == 0) cycle
            associate (surface => mesh%surfaces(s))
               if (card%is_pressure .and. (any(surface%other(:surface%n) > 0) .or. surface%was_split)) &
                  call deck%field_error(card%line, 'PID', 'bodies lie on both sides of surface '//integer_text(card%surface)// &
                                        ': the loaded body is ambiguous')
               if (mesh%axisymmetric .and. surface%n > 0 .and. all(abs(mesh%x(1, nodes_of(surface))) <= 0.0_wp)) &
                  call deck%field_error(card%line, 'PID', 'surface '//integer_text(card%surface)// &
                                        ' lies on the axis and has no area')
            end associate
            call check_plane(deck, mesh, card%line, card%force, 'N3')
         end associate
      end do

      ! SPCD
      do i = 1, size(deck%bulk%displacement)
         associate (card => deck%bulk%displacement(i))
            node = mesh%node_table%find(card%node)
            if (node == 0 .or. .not. may_act(card%set)) cycle
            do d = 1, 6
               if (.not. has_component(card%components, d)) cycle
               words = ''
               associate (place => place_of_component(mesh, node, d))
                  if (place%node == 0) then
                     words = ', expected 1 to '//integer_text(mesh%dimension)
                  else
                     held = supported(mesh, freedoms, place%node)
                     if (.not. held(place%d)) words = ' of node '//integer_text(card%node)// &
                                                      ' is not supported: SPCD moves components that an SPC holds'
                  end if
               end associate
               if (words /= '') call deck%field_error(card%line, card%field + 1, 'component '//integer_text(d)//words, &
                                                      called='C')
            end do
         end associate
      end do

      ! LOAD, which combines sets
      do i = 1, size(deck%bulk%load)
         associate (card => deck%bulk%load(i))
            do k = 1, size(card%sets)
               if (card%sets(k) <= 0 .or. has_set(deck%bulk, card%sets(k))) cycle
               if (any(deck%bulk%load%set == card%sets(k))) then
                  call deck%field_error(card%line, card%at(k), integer_text(card%sets(k))//' is a LOAD too; expected the '// &
                                        'sets of forces and pressures that it combines', called='L'//integer_text(k))
               else
                  call deck%field_error(card%line, card%at(k), 'there is no FORCE with set '//integer_text(card%sets(k))// &
                                        nor_others, called='L'//integer_text(k))
               end if
            end do
            if (.not. has_set(deck%bulk, card%set)) cycle
            kinds = others
            if (any(deck%bulk%force%set == card%set)) kinds = 'FORCE'
            call deck%field_error(card%line, 'SID', 'set '//integer_text(card%set)//' is that of a '//trim(kinds)// &
                                  ' too: case control is ambiguous')
         end associate
      end do
   contains

      !> Whether a load SET belongs to a stage with these supports.
      pure logical function may_act(set)
         integer, intent(in) :: set
         integer :: k, s

         may_act = .false.
         do s = 1, size(deck%control%stages)
            if (may_act .or. .not. deck%shares(s)) cycle
            associate (wanted => deck%control%stages(s)%load%id)
               k = findloc(deck%bulk%load%set, wanted, dim=1)
               may_act = wanted == set
               if (k > 0) may_act = may_act .or. any(deck%bulk%load(k)%sets == set)
            end associate
         end do
      end function may_act

   end subroutine check_cards

   !> The total load at the end of each stage, and the patterns of its oscillating loads.
   subroutine build_loads(deck, from, mesh, freedoms, history, waves)
      type(checked_deck), intent(in)  :: deck
      integer, intent(in)             :: from(:) !! (stages) position of the stage from whose end each starts, 0: from rest
      type(mesh_type), intent(in) :: mesh
      type(freedoms_type), intent(in) :: freedoms
      type(history_type), intent(inout) :: history
      type(planned_wave), allocatable, intent(out) :: waves(:) !! of DLOAD
      type(card_loads) :: cards
      type(nodal_loads), allocatable :: at_end(:) ! (0:stages)
      integer :: i, s

      call find_nodal_forces(deck, mesh, freedoms, cards%node, cards%force)
      call check_cards(deck, mesh, freedoms)
      call find_fields(deck, mesh, cards%fields)
      call find_beam_loads(deck, mesh, cards%beam, cards%end_force)
      call check_kept(deck, mesh)
      call find_pressed_sides(deck, mesh, cards%pressed)
      allocate (history%stages(size(deck%control%stages)))
      history%stages%from = from
      allocate (at_end(0:size(history%stages)))
      if (size(deck%bulk%bolt) > 0 .and. .not. deck%errors%any()) then
         allocate (cards%pressing(3, mesh%n_nodes))
         allocate (at_end(0)%of_kind(3, mesh%n_nodes, 2), source=0.0_wp)
      end if
      do s = 1, size(deck%control%stages)
         associate (loads => history%stages(s), stage => deck%control%stages(s))
            if (allocated(cards%pressing)) cards%pressing = 0.0_wp
            allocate (loads%node(size(deck%bulk%force)), loads%force(3, size(deck%bulk%force)))
            call keep_moved(deck, mesh, stage%load%id, loads)
            call add_case(stage%load, 'LOAD', loads)
            if (allocated(cards%pressing)) then
               call note_changes(cards%pressing, at_end(loads%from)%of_kind, loads, at_end(s)%of_kind)
               call forget_others(history%stages(s + 1:)%from, at_end)
            end if
            if (loads%from > 0) loads%changes(1) = loads%changes(1) .or. differ(history%stages(loads%from)%moved, loads%moved)
         end associate
      end do
      call list_waves(deck, mesh, freedoms, waves)
      do i = 1, size(waves)
         do s = 1, size(waves(i)%sets)
            call add_case(waves(i)%sets(s), trim(waves(i)%keys(s)), waves(i)%load)
         end do
      end do
      call check_waves(deck, waves)

   contains

      !> Add to LOADS the load set, or the combination of sets, that the entry KEY of case control names.
      subroutine add_case(reference, key, loads)
         type(set_reference), intent(in)      :: reference
         character(*), intent(in)             :: key
         type(stage_load_type), intent(inout) :: loads
         integer :: i, k

         if (reference%id == 0) return
         i = findloc(deck%bulk%load%set, reference%id, dim=1)
         if (i > 0) then
            associate (load => deck%bulk%load(i))
               do k = 1, size(load%sets)
                  call add_set(deck, mesh, freedoms, cards, load%sets(k), load%scale*load%factors(k), loads)
               end do
            end associate
         else
            call add_set(deck, mesh, freedoms, cards, reference%id, 1.0_wp, loads)
            if (.not. has_set(deck%bulk, reference%id)) call deck%errors%add(reference%line, &
               key//': there is no FORCE or LOAD with set '//integer_text(reference%id)//nor_others)
         end if
      end subroutine add_case

   end subroutine build_loads

   !> Add FACTOR times all loads of SET to LOADS: nodal forces one by one, distributed loads as sums per node.
   subroutine add_set(deck, mesh, freedoms, cards, set, factor, loads)
      type(checked_deck), intent(in)       :: deck
      type(mesh_type), intent(in)          :: mesh
      type(freedoms_type), intent(in)      :: freedoms
      type(card_loads), intent(inout)      :: cards
      integer, intent(in)                  :: set
      real(wp), intent(in)                 :: factor
      type(stage_load_type), intent(inout) :: loads
      real(wp), allocatable :: spread_out(:, :)
      integer  :: i, node

      associate (bulk => deck%bulk)
         do i = 1, size(bulk%force)
            if (bulk%force(i)%set == set) call add_force(cards%node(i), factor*cards%force(:, i), loads)
         end do
         do i = 1, size(bulk%displacement)
            associate (card => bulk%displacement(i))
               if (card%set == set) call move(mesh, card%node, card%components, 1.0_wp, factor*card%value, loads)
            end associate
         end do
         if (all(bulk%pressure%set /= set) .and. all(bulk%surface_load%set /= set) .and. all(bulk%gravity%set /= set) .and. &
             all(bulk%beam_load%set /= set)) return
         if (deck%errors%any()) return ! elements in error may have no area or volume
         allocate (spread_out(3, mesh%n_nodes), source=0.0_wp)
         call add_faces(.true., spread_out)
         if (allocated(cards%pressing)) call add_faces(.false., cards%pressing)
         call add_gravity(mesh, freedoms, cards%fields, set, factor, loads, spread_out)
         do i = 1, size(bulk%beam_load)
            if (bulk%beam_load(i)%set == set .and. cards%beam(i) > 0) &
               call add_to_beam(mesh, freedoms, cards%beam(i), factor*cards%end_force(:, i), loads, spread_out)
         end do
      end associate
      do node = 1, mesh%n_nodes
         if (any(abs(spread_out(:, node)) > 0.0_wp)) call add_force(node, spread_out(:, node), loads)
      end do

   contains

      !> Add the nodal FORCE of pressures, and WITH_FORCES that of forces on surfaces.
      subroutine add_faces(with_forces, force)
         logical, intent(in)     :: with_forces
         real(wp), intent(inout) :: force(:, :) !! (3, n_nodes)
         integer :: i, s

         do i = 1, size(cards%pressed)
            if (deck%bulk%pressure(cards%pressed(i)%card)%set == set) call add_pressure(mesh, cards%pressed(i), factor, force)
         end do
         do i = 1, size(deck%bulk%surface_load)
            associate (card => deck%bulk%surface_load(i))
               if (card%set /= set .or. .not. (with_forces .or. card%is_pressure)) cycle
               s = findloc(mesh%surfaces%id, card%surface, dim=1)
               if (s > 0) call add_surface_load(mesh, mesh%surfaces(s), card, factor, force)
            end associate
         end do
      end subroutine add_faces

   end subroutine add_set

end module load_build
