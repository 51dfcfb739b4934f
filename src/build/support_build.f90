!> Supports from SPC, SPC1, SPCM, SUPORT and PS of GRID, and their prescribed displacements.
!! SPCD gives a total at the end of a stage, among its loads. D of SPC holds from the end of the first stage on. SPCADD and
!! MPCADD combine sets.
module support_build
   use bulk_data, only: set_sum_card, support_card
   use deck_cards, only: card_name
   use deck_check, only: checked_deck
   use field_rules, only: component_words, has_component
   use kinds, only: wp
   use lists, only: first_not_below
   use mesh_queries, only: is_face_node, is_scalar_point, n_points
   use model_data, only: bar_nodes, freedoms_type, joints_type, mesh_type, n_bars, n_sections, stage_load_type, support_group
   use surface_build, only: find_surface
   use surface_sides, only: nodes_of
   use text_tools, only: integer_text
   use unknowns, only: component_place, place_of_component, rotation_at
   implicit none
   private

   public :: build_supports, hold, move, keep_moved, check_kept, differ, summed_sets, check_sums

   integer, parameter :: most_places = 12 ! of one node: six components, of a split node twice

contains

   !> The nodes with elements, and the components that the SPC set of case control and PS of GRID support. Of the node of a pretension
   !! section only the first component, the overlap, is an unknown.
   subroutine build_supports(deck, mesh, joints, freedoms)
      type(checked_deck), intent(in)  :: deck
      type(mesh_type), intent(in) :: mesh
      type(joints_type), intent(in) :: joints
      type(freedoms_type), intent(inout) :: freedoms
      integer, allocatable :: sets(:)
      integer :: i, node, set

      allocate (freedoms%held(mesh%dimension, mesh%n_nodes), source=.false.)
      allocate (freedoms%support_of(mesh%dimension, mesh%n_nodes), source=0)
      allocate (freedoms%support_groups(0))
      freedoms%used = mesh%first_at(2:) > mesh%first_at(:mesh%n_nodes)
      do i = 1, size(joints%element)
         freedoms%used(joints%element(i)%node) = .true.
      end do
      do i = 1, n_bars(mesh)
         freedoms%used(bar_nodes(mesh%bars(i))) = .true.
      end do
      do i = 1, size(mesh%faces) ! those of bushes: the nodes behind their arms
         associate (face => mesh%faces(i))
            if (.not. freedoms%used(face%node) .or. rotation_at(mesh, face%point) == 0) cycle
            freedoms%used(face%point) = .true.
            freedoms%used(mesh%rotations(rotation_at(mesh, face%point))%node) = .true.
         end associate
      end do
      do i = 1, size(deck%bulk%force) ! rotations that nodes of springs have because of a moment
         if (.not. deck%bulk%force(i)%is_moment) cycle
         associate (id => deck%bulk%force(i)%node, node => mesh%node_table%find(deck%bulk%force(i)%node))
            if (node == 0 .or. .not. any(deck%bulk%spring%nodes(1) == id .or. deck%bulk%spring%nodes(2) == id)) cycle
            if (rotation_at(mesh, node) > 0) freedoms%used(mesh%rotations(rotation_at(mesh, node))%node) = .true.
         end associate
      end do
      do i = 1, n_sections(mesh)
         if (mesh%sections(i)%node > 0) freedoms%held(2:, mesh%sections(i)%node) = .true.
      end do
      do i = 1, size(deck%bulk%grid)
         if (deck%bulk%grid(i)%ps == 0) cycle
         call open_group(support_group('GRID', 0, deck%bulk%grid(i)%line), freedoms)
         call hold(mesh, freedoms, mesh%node_table%find(deck%bulk%grid(i)%id), deck%bulk%grid(i)%ps)
      end do
      set = 0
      if (size(deck%control%stages) > 0) set = deck%control%stages(deck%stage)%supports%id
      allocate (sets, source=support_sets(deck))
      do i = 1, size(deck%bulk%support)
         associate (card => deck%bulk%support(i), active => any(sets == deck%bulk%support(i)%set))
            if (active .and. card%surface > 0) call open_group(support_group('SPCM', card%surface, card%line), freedoms)
            if (active .and. card%surface == 0) &
               call open_group(support_group(card_name(deck%text%card_part(card%line)), card%set, card%line), freedoms)
            call apply_support(deck, card, active, mesh, freedoms)
         end associate
      end do
      do i = 1, size(deck%bulk%suport)
         associate (card => deck%bulk%suport(i))
            call open_group(support_group('FREE', 0, card%line), freedoms)
            node = mesh%node_table%find(card%node)
            if (node > 0) call hold(mesh, freedoms, node, card%components)
         end associate
      end do
      call check_sums(deck, 'SPCADD', deck%bulk%support_sum, deck%bulk%support%set, 'SPC, SPC1 or SPCM')
      if (set > 0 .and. all(deck%bulk%support%set /= set) .and. all(deck%bulk%support_sum%set /= set)) call deck%errors%add( &
         deck%control%stages(deck%stage)%supports%line, 'SPC: there is no SPC, SPC1, SPCM or SPCADD with set '//integer_text(set))
   end subroutine build_supports

   !> The active sets of supports: that of case control, or those of its SPCADD.
   pure function support_sets(deck) result(sets)
      type(checked_deck), intent(in) :: deck
      integer, allocatable :: sets(:)
      integer :: set

      set = 0
      if (size(deck%control%stages) > 0) set = deck%control%stages(deck%stage)%supports%id
      sets = summed_sets(deck%bulk%support_sum, set)
   end function support_sets

   !> Check one support card, and apply it if its set is ACTIVE.
   subroutine apply_support(deck, support, active, mesh, freedoms)
      type(checked_deck), intent(in)  :: deck
      type(support_card), intent(in)  :: support
      logical, intent(in)             :: active
      type(mesh_type), intent(in) :: mesh
      type(freedoms_type), intent(inout) :: freedoms
      integer, allocatable :: nodes(:)
      integer :: k, node, surface
      logical :: any_node

      if (support%surface > 0) then
         call find_surface(deck, support%line, 'PID', support%surface, mesh, surface)
         if (surface == 0 .or. .not. active) return
         nodes = nodes_of(mesh%surfaces(surface))
         do k = 1, size(nodes)
            if (is_face_node(mesh, nodes(k))) nodes(k) = mesh%faces(mesh%face_of(nodes(k)))%point
            call hold(mesh, freedoms, nodes(k), support%components)
         end do
         return
      end if
      do k = 1, size(support%first)
         if (support%first(k) == support%last(k)) then
            call apply_to(mesh%node_table%find(support%first(k)))
            cycle
         end if
         ! G1 THRU G2 means the nodes that exist, as in NASTRAN; at least one must exist
         any_node = support%last(k) < support%first(k) ! reported already
         do node = first_not_below(mesh%node_id(:n_points(mesh)), support%first(k)), n_points(mesh)
            ! lower: the last node
            if (mesh%node_id(node) < support%first(k) .or. mesh%node_id(node) > support%last(k)) exit
            any_node = .true.
            call apply_to(node)
         end do
         if (.not. any_node) call deck%field_error(support%line, support%at(k), 'there is no GRID from '// &
            integer_text(support%first(k))//' to '//integer_text(support%last(k)), called='G')
      end do

   contains

      !> Error: components are left out at a node that is no scalar point.
      subroutine apply_to(node)
         integer, intent(in) :: node

         if (node == 0) return
         if (support%components < 0 .and. .not. is_scalar_point(mesh, node)) then
            call deck%field_error(support%line, merge(2, support%at(k) + 1, support%at(1) == 3), 'blank or 0, expected '// &
                                  component_words//'; blank is for scalar points', called='C')
         else if (active) then
            call hold(mesh, freedoms, node, support%components)
         end if
      end subroutine apply_to

   end subroutine apply_support

   !> Hold COMPONENTS of NODE, rotations if it has any. Components that a node does not have (3 to 5 in the plane) are held anyway.
   subroutine hold(mesh, freedoms, node, components)
      type(mesh_type), intent(in) :: mesh
      type(freedoms_type), intent(inout) :: freedoms
      integer, intent(in)             :: node, components
      type(component_place) :: places(most_places)
      integer :: k

      places = places_of(mesh, node, components)
      do k = 1, count(places%node > 0)
         freedoms%held(places(k)%d, places(k)%node) = .true.
         associate (group => freedoms%support_of(places(k)%d, places(k)%node))
            if (group == 0) group = size(freedoms%support_groups)
         end associate
      end do
   end subroutine hold

   !> Open GROUP for the supports that follow; PS of GRID, and SPC cards of one set, join the last group of their kind.
   subroutine open_group(group, freedoms)
      type(support_group), intent(in) :: group
      type(freedoms_type), intent(inout) :: freedoms

      associate (groups => freedoms%support_groups)
         if (size(groups) > 0 .and. any(group%kind == ['GRID', 'SPC ', 'FREE'])) then
            if (groups(size(groups))%kind == group%kind .and. groups(size(groups))%id == group%id) return
         end if
      end associate
      freedoms%support_groups = [freedoms%support_groups, group]
   end subroutine open_group

   !> Set the displacement of COMPONENTS of node ID in LOADS to SHARE of its former value plus VALUE.
   pure subroutine move(mesh, id, components, share, value, loads)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)                  :: id, components
      real(wp), intent(in)                 :: share, value
      type(stage_load_type), intent(inout) :: loads
      type(component_place) :: places(most_places)
      integer :: k

      if (.not. allocated(loads%moved)) allocate (loads%moved(mesh%dimension, mesh%n_nodes), source=0.0_wp)
      places = places_of(mesh, mesh%node_table%find(id), components)
      do k = 1, count(places%node > 0)
         associate (moved => loads%moved(places(k)%d, places(k)%node))
            moved = share*moved + value*places(k)%scale
         end associate
      end do
   end subroutine move

   !> Add D of SPC cards to LOADS, the end of a stage with load set SET and no displacements so far. A component that an SPCD of
   !! these loads names is left out.
   subroutine keep_moved(deck, mesh, set, loads)
      type(checked_deck), intent(in)       :: deck
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)                  :: set !! of case control, 0: none
      type(stage_load_type), intent(inout) :: loads
      integer, allocatable :: holding(:), sets(:)
      integer :: i, k

      if (all(abs(deck%bulk%support%value) <= 0.0_wp)) return
      allocate (holding, source=support_sets(deck))
      do i = 1, size(deck%bulk%support)
         associate (card => deck%bulk%support(i))
            if (abs(card%value) > 0.0_wp .and. any(holding == card%set)) &
               call move(mesh, card%first(1), card%components, 0.0_wp, card%value, loads)
         end associate
      end do
      if (.not. allocated(loads%moved) .or. set == 0) return
      sets = [set]
      k = findloc(deck%bulk%load%set, set, dim=1)
      if (k > 0) sets = deck%bulk%load(k)%sets
      do i = 1, size(deck%bulk%displacement)
         associate (card => deck%bulk%displacement(i))
            if (any(sets == card%set)) call move(mesh, card%node, card%components, 0.0_wp, 0.0_wp, loads)
         end associate
      end do
   end subroutine keep_moved

   !> Errors: D of a component that the node does not have, and two SPC cards with different D of a component.
   subroutine check_kept(deck, mesh)
      type(checked_deck), intent(in) :: deck
      type(mesh_type), intent(in) :: mesh
      type(component_place) :: places(most_places)
      character(:), allocatable :: words
      integer, allocatable :: holding(:), by(:, :) ! the card that moves a component, 0: none
      integer :: d, i, node, other

      if (all(abs(deck%bulk%support%value) <= 0.0_wp)) return
      allocate (holding, source=support_sets(deck))
      allocate (by(mesh%dimension, mesh%n_nodes), source=0)
      words = ''
      do i = 1, size(deck%bulk%support)
         associate (card => deck%bulk%support(i))
            if (abs(card%value) <= 0.0_wp) cycle
            node = mesh%node_table%find(card%first(1))
            if (node == 0) cycle ! reported already
            do d = 1, 6
               if (.not. has_component(card%components, d)) cycle
               places = places_of(mesh, node, d)
               words = 'component '//integer_text(d)//' of node '//integer_text(card%first(1))
               if (places(1)%node == 0) then
                  call deck%field_error(card%line, card%at(1) + 1, words// &
                     ' does not exist, so that D cannot move it; expected 1 to '//integer_text(mesh%dimension), called='C')
               else if (any(holding == card%set)) then
                  other = by(places(1)%d, places(1)%node) ! a duplicate has the same components
                  by(places(1)%d, places(1)%node) = i
                  if (other == 0) cycle
                  if (abs(deck%bulk%support(other)%value - card%value) > 0.0_wp) call deck%field_error(card%line, &
                     card%at(1) + 2, words//' has another prescribed displacement by the SPC of '// &
                     deck%text%place(deck%bulk%support(other)%line), called='D')
               end if
            end do
         end associate
      end do
   end subroutine check_kept

   !> The places of COMPONENTS of NODE, -1 that of a scalar point, existing ones first, then places of node 0; for a split node also
   !! those of its duplicate.
   pure function places_of(mesh, node, components) result(places)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)          :: node, components
      type(component_place) :: places(most_places)
      type(component_place) :: place
      integer :: d, n

      n = 0
      if (node == 0) return
      do d = 1, 6
         if (.not. has_component(merge(1, components, components < 0 .and. is_scalar_point(mesh, node)), d)) cycle
         place = place_of_component(mesh, node, d)
         if (place%node == 0) cycle
         n = n + 1
         places(n) = place
         place%node = mesh%duplicate(place%node)
         if (place%node == 0) cycle
         n = n + 1
         places(n) = place
      end do
   end function places_of

   !> The sets that SET stands for: itself, or the sets of the SUMS with this number.
   pure function summed_sets(sums, set) result(sets)
      type(set_sum_card), intent(in) :: sums(:)
      integer, intent(in)            :: set !! 0: none
      integer, allocatable :: sets(:)
      integer :: i

      sets = [set]
      i = findloc(sums%set, set, dim=1, back=.true.)
      if (i > 0 .and. set > 0) sets = sums(i)%sets
   end function summed_sets

   !> Errors of SUMS, cards called NAME: missing sets, and a number that is also one of a set. KNOWN are the sets of the cards CALLED
   !! so that may be combined.
   subroutine check_sums(deck, name, sums, known, called)
      type(checked_deck), intent(in) :: deck
      character(*), intent(in)       :: name, called
      type(set_sum_card), intent(in) :: sums(:)
      integer, intent(in)            :: known(:)
      integer :: i, k

      call deck%report_repeated(name, sums%set, sums%line)
      do i = 1, size(sums)
         associate (card => sums(i))
            if (any(known == card%set) .and. card%set > 0) call deck%field_error(card%line, 'SID', &
               'set '//integer_text(card%set)//' is that of an '//called//' too: case control is ambiguous')
            do k = 1, size(card%sets)
               if (card%sets(k) <= 0 .or. any(known == card%sets(k))) cycle
               if (any(sums%set == card%sets(k))) then
                  call deck%field_error(card%line, card%at(k), integer_text(card%sets(k))//' is an '//name// &
                                        ' too; expected the sets of '//called//' that it sums up', called='S'//integer_text(k))
               else
                  call deck%field_error(card%line, card%at(k), 'there is no '//called//' with set '//integer_text(card%sets(k)), &
                                        called='S'//integer_text(k))
               end if
            end do
         end associate
      end do
   end subroutine check_sums

   !> Whether A and B differ; what is not there is zero.
   pure logical function differ(a, b)
      real(wp), allocatable, intent(in) :: a(:, :), b(:, :)

      differ = .false.
      if (allocated(a) .and. allocated(b)) then
         differ = any(abs(a - b) > 0.0_wp)
      else if (allocated(a)) then
         differ = any(abs(a) > 0.0_wp)
      else if (allocated(b)) then
         differ = any(abs(b) > 0.0_wp)
      end if
   end function differ

end module support_build
