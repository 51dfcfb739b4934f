!> Coordinate systems of CORD cards in global axes, and the vectors and nodes that are given in them.
!! A system may depend on other systems in any order. Nodes with CD have their unknowns along the directions of their system, so
!! that supports and prescribed displacements act along these directions.
module displacement_systems
   use coordinate_systems, only: coordinate_system, directions_at, make_system, position_in, rectangular
   use deck_check, only: checked_deck
   use kinds, only: wp
   use lists, only: id_table_type
   use model_data, only: freedoms_type, mesh_type
   use node_coupling, only: couple_node, is_coupled
   use numbers, only: identity
   use text_tools, only: integer_text
   use tolerances, only: zero_component_along
   use unknowns, only: node_axes, rotation_at
   implicit none
   private

   public :: build_systems, find_system, find_directions, rectangular_axes, find_node_systems, couple_node_systems

contains

   !> The SYSTEMS of all CORD cards, in their order. CORD2 may refer to any other system, CORD1 to nodes given in any other system.
   !! A circular reference is an error.
   subroutine build_systems(deck, systems)
      type(checked_deck), intent(in)                    :: deck
      type(coordinate_system), allocatable, intent(out) :: systems(:)
      type(id_table_type)  :: ids, grids
      logical, allocatable :: is_done(:)
      integer :: i, k, missing, n_done

      associate (cards => deck%bulk%system)
         allocate (systems(size(cards)), is_done(size(cards)))
         if (size(cards) == 0) return
         call deck%report_repeated('coordinate system', cards%id, cards%line)
         call ids%build(cards%id)
         if (any(cards%nodes(1) > 0)) call grids%build(deck%bulk%grid%id)
         is_done = .false.
         do
            n_done = count(is_done)
            do i = 1, size(cards)
               if (.not. is_done(i)) call build_system(i)
            end do
            if (count(is_done) == n_done) exit
         end do
         do i = 1, size(cards)
            if (is_done(i)) cycle
            associate (card => cards(i))
               missing = findloc(card%nodes > 0 .and. [(grids%find(card%nodes(k)) == 0, k = 1, 3)], .true., dim=1)
               if (card%nodes(1) > 0 .and. missing > 0) then
                  call deck%field_error(card%line, card%field + missing, 'there is no GRID '//integer_text(card%nodes(missing)))
               else if (card%nodes(1) == 0 .and. ids%find(card%reference) == 0) then
                  call deck%field_error(card%line, 'RID', 'there is no coordinate system '//integer_text(card%reference))
               else
                  call deck%errors%add(card%line, 'coordinate system '//integer_text(card%id)//' cannot be placed: it '// &
                     'refers to itself, directly or through other systems and nodes, or to a system with an error')
               end if
            end associate
         end do
      end associate

   contains

      !> Build system I, if the systems and nodes it refers to are done.
      subroutine build_system(i)
         integer, intent(in) :: i
         real(wp) :: points(3, 3)
         integer  :: grid, k, other
         logical  :: ok

         associate (card => deck%bulk%system(i))
            do k = 1, 3
               points(:, k) = card%points(:, k)
               other = card%reference
               if (card%nodes(1) > 0) then
                  grid = grids%find(card%nodes(k))
                  if (grid == 0) return
                  points(:, k) = deck%bulk%grid(grid)%x
                  other = deck%bulk%grid(grid)%cp
               end if
               if (other == 0) cycle
               other = ids%find(other)
               if (other == 0) return
               if (.not. is_done(other)) return
               points(:, k) = position_in(systems(other), points(:, k))
            end do
            call make_system(card%id, card%kind, points(:, 1), points(:, 2), points(:, 3), systems(i), ok)
            is_done(i) = .true.
            if (.not. ok) call deck%errors%add(card%line, 'coordinate system '//integer_text(card%id)// &
               ': its three points lie on a line; expected an origin, a point on z and one in the x-z plane')
         end associate
      end subroutine build_system

   end subroutine build_systems

   !> Position of the system ID in FIELD of the card on LINE; 0 for global axes, and, with an error, for a missing system.
   subroutine find_system(deck, line, field, id, systems, system)
      type(checked_deck), intent(in)      :: deck
      integer, intent(in)                 :: line
      character(*), intent(in)            :: field
      integer, intent(in)                 :: id
      type(coordinate_system), intent(in) :: systems(:)
      integer, intent(out)                :: system

      system = 0
      if (id > 0) system = findloc(deck%bulk%system%id, id, dim=1)
      if (system == 0 .and. id > 0) &
         call deck%field_error(line, field, 'there is no CORD1R, CORD2R, CORD2C or CORD2S '//integer_text(id))
      if (system > size(systems)) system = 0
   end subroutine find_system

   !> The directions, columns, of the system CID of the card on LINE at the point X; global axes for CID 0. OK is false, with an
   !! error, for a missing system, and on the axis of a cylindrical or spherical one; but the directions AT_NODE are then x, y and z of
   !! that system, as in NASTRAN, with a warning.
   subroutine find_directions(deck, systems, line, cid, x, directions, ok, names, at_node)
      type(checked_deck), intent(in)      :: deck
      type(coordinate_system), intent(in) :: systems(:)
      integer, intent(in)                 :: line, cid
      real(wp), intent(in)                :: x(3)      !! global axes [length]
      real(wp), intent(out)               :: directions(3, 3)
      logical, intent(out)                :: ok
      character(*), intent(in), optional  :: names(2)  !! of the field and of the point; default 'CID' and 'the node'
      logical, intent(in), optional       :: at_node   !! default: without NAMES
      character(8) :: called(2)
      integer      :: system
      logical      :: is_of_node

      called = [character(8) :: 'CID', 'the node']
      if (present(names)) called = names
      is_of_node = .not. present(names)
      if (present(at_node)) is_of_node = at_node
      directions = identity
      call find_system(deck, line, trim(called(1)), cid, systems, system)
      ok = system > 0 .or. cid <= 0
      if (system == 0) return
      call directions_at(systems(system), x, directions, ok)
      if (.not. ok .and. is_of_node) then
         ok = .true.
         call deck%errors%warn('a node lies on the axis of system '//integer_text(cid)//', where its first two directions are '// &
                               'not defined; they are x and y of that system, as in NASTRAN')
      else if (.not. ok) then
         call deck%field_error(line, trim(called(1)), trim(called(2))//' lies on the axis of system '// &
                               integer_text(cid)//', where its first two directions are not defined')
      end if
   end subroutine find_directions

   !> The axes, columns, of the rectangular system CID of the card on LINE; global axes for CID 0. Errors: no such system; a system
   !! of another kind. BUT is the end of this message: what the system is for.
   subroutine rectangular_axes(deck, systems, line, cid, but, axes)
      type(checked_deck), intent(in)      :: deck
      type(coordinate_system), intent(in) :: systems(:)
      integer, intent(in)                 :: line, cid
      character(*), intent(in)            :: but
      real(wp), intent(out)               :: axes(3, 3)
      integer :: system

      axes = identity
      call find_system(deck, line, 'CID', cid, systems, system)
      if (system == 0) return
      if (systems(system)%kind /= rectangular) &
         call deck%field_error(line, 'CID', integer_text(cid)//' is not rectangular, but '//but)
      axes = systems(system)%axes
   end subroutine rectangular_axes

   !> Couple the nodes of the model that have a CD, and their duplicates, to unknowns along its directions; in space the rotations
   !! of these nodes too are about these directions. Errors: no such system; a node on the axis of a cylindrical or spherical one;
   !! directions out of the plane of a plane model.
   subroutine find_node_systems(deck, mesh)
      type(checked_deck), intent(in)  :: deck
      type(mesh_type), intent(inout) :: mesh
      real(wp) :: directions(3, 3)
      integer  :: i, node
      logical  :: ok

      do i = 1, size(deck%bulk%grid)
         associate (grid => deck%bulk%grid(i), d => mesh%dimension)
            if (grid%cd <= 0) cycle
            node = mesh%node_table%find(grid%id)
            if (node == 0) cycle
            call find_directions(deck, mesh%systems, grid%line, grid%cd, mesh%x(:, node), directions, ok, &
                                 ['CD      ', 'the node'], at_node=.true.)
            if (.not. ok) cycle
            if (d == 2 .and. any(abs(directions(3, :2)) > zero_component_along)) then
               call deck%field_error(grid%line, 'CD', 'the first two directions of the system do not lie in the plane of the '// &
                                     'model, x-y')
               cycle
            end if
            if (size(mesh%node_system) == 0) mesh%node_system = spread(0, 1, mesh%n_nodes)
            do while (node > 0)
               if (mesh%node_system(node) > 0) exit ! a number given twice has one node
               mesh%node_system(node) = findloc(mesh%systems%id, grid%cd, dim=1)
               node = mesh%duplicate(node)
            end do
         end associate
      end do
   end subroutine find_node_systems

   !> Couple the nodes with a system CD, and their rotations, to unknowns along the directions of their system.
   subroutine couple_node_systems(deck, mesh, freedoms)
      type(checked_deck), intent(in)     :: deck
      type(mesh_type), intent(in)        :: mesh
      type(freedoms_type), intent(inout) :: freedoms
      real(wp) :: directions(3, 3)
      integer  :: i, node, rotation

      if (size(mesh%node_system) == 0) return
      do i = 1, size(deck%bulk%grid)
         if (deck%bulk%grid(i)%cd <= 0) cycle
         node = mesh%node_table%find(deck%bulk%grid(i)%id)
         associate (d => mesh%dimension)
            do while (node > 0)
               if (mesh%node_system(node) == 0 .or. is_coupled(freedoms, [node])) exit
               directions = node_axes(mesh, node)
               call couple_node(freedoms%coupling, mesh%n_nodes, node, [node], reshape(directions(:d, :d), [d, d, 1]))
               rotation = rotation_at(mesh, node)
               if (d == 3 .and. rotation > 0) then
                  rotation = mesh%rotations(rotation)%node
                  call couple_node(freedoms%coupling, mesh%n_nodes, rotation, [rotation], reshape(directions, [3, 3, 1]))
               end if
               node = mesh%duplicate(node)
            end do
         end associate
      end do
   end subroutine couple_node_systems

end module displacement_systems
