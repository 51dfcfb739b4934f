!> Load cards against the model: nodes, surfaces, sets and masses that are there, directions that the model has. Temperatures:
!! how warm the nodes are at the end of every stage.
module load_checks
   use bulk_data, only: bulk_data_type, gravity_card, has_component
   use coordinate_systems, only: rectangular
   use deck_check, only: checked_deck
   use displacement_systems, only: find_system
   use element_kinds, only: element_table
   use kinds, only: wp
   use model_data, only: a_bar, corners_of, model_type, n_bars, n_points, supported
   use reference_nodes, only: component_place, place_of_component
   use surface_build, only: find_surface
   use surface_sides, only: nodes_of
   use text_tools, only: integer_text
   implicit none
   private

   public :: check_load_cards, check_plane, has_set, build_temperatures

   character(*), parameter :: others = 'PLOAD4, PLOADE, PLOAD, PLOAD1, PLOAD2, PLOADM, FORCEM, GRAV or SPCD' ! than FORCE, of a load set
   character(*), parameter, public :: nor_others = ', nor a '//others                 !! behind `there is no FORCE`

contains

   !> All load cards of the deck but those of nodal forces and pressed sides; what does not fit goes to ERRORS.
   subroutine check_load_cards(deck, model)
      type(checked_deck), intent(in) :: deck
      type(model_type), intent(in)   :: model

      call check_surface_loads(deck, model)
      call check_gravity(deck, model)
      call check_displacements(deck, model)
      call check_combinations(deck)
   end subroutine check_load_cards

   !> Whether some load card is of SET.
   pure logical function has_set(bulk, set)
      type(bulk_data_type), intent(in) :: bulk
      integer, intent(in)              :: set

      has_set = any(bulk%force%set == set) .or. any(bulk%pressure%set == set) .or. any(bulk%surface_load%set == set) .or. &
                any(bulk%gravity%set == set) .or. any(bulk%displacement%set == set) .or. any(bulk%beam_load%set == set)
   end function has_set

   !> A plane model has no direction z; the card on LINE has its component of VECTOR in N3, unless it is turned or goes along nodes.
   subroutine check_plane(deck, model, line, vector, along, turned)
      type(checked_deck), intent(in) :: deck
      type(model_type), intent(in)   :: model
      integer, intent(in)            :: line
      real(wp), intent(in)           :: vector(3) !! in global axes
      logical, intent(in), optional  :: along     !! it is that from node to node, which may have no field N3; false
      logical, intent(in), optional  :: turned    !! it is given in system CID; false
      real(wp), parameter :: rounding = 1.0e-12_wp
      character(:), allocatable :: field

      if (model%dimension == 3 .or. abs(vector(3)) <= rounding*norm2(vector)) return
      field = 'N3'
      if (present(turned)) then
         if (turned) field = 'CID'
      end if
      if (present(along)) then
         if (along) field = 'G1'
      end if
      if (field == 'N3') then
         call deck%field_error(line, field, 'not zero, but a plane model lies in x-y')
      else
         call deck%field_error(line, field, 'the load points out of the plane, but a plane model lies in x-y')
      end if
   end subroutine check_plane

   !> PLOADM and FORCEM act on surfaces that are there; a pressure, on one that has one body alone.
   subroutine check_surface_loads(deck, model)
      type(checked_deck), intent(in) :: deck
      type(model_type), intent(in)   :: model
      integer :: i, s

      do i = 1, size(deck%bulk%surface_load)
         associate (card => deck%bulk%surface_load(i))
            if (card%surface == 0) cycle
            call find_surface(deck, card%line, 'PID', card%surface, model, s)
            if (s == 0) cycle
            associate (surface => model%surfaces(s))
               if (card%is_pressure .and. (any(surface%other(:surface%n) > 0) .or. surface%was_split)) &
                  call deck%field_error(card%line, 'PID', 'bodies lie on both sides of surface '//integer_text(card%surface)// &
                                        ': the loaded body is ambiguous')
               if (model%axisymmetric .and. surface%n > 0 .and. all(abs(model%x(1, nodes_of(surface))) <= 0.0_wp)) &
                  call deck%field_error(card%line, 'PID', 'surface '//integer_text(card%surface)// &
                                        ' lies on the axis and has no area')
            end associate
            call check_plane(deck, model, card%line, card%force)
         end associate
      end do
   end subroutine check_surface_loads

   !> GRAV needs a mass to act on.
   subroutine check_gravity(deck, model)
      type(checked_deck), intent(in) :: deck
      type(model_type), intent(in)   :: model
      real(wp) :: acceleration(3)
      integer  :: i, system

      do i = 1, size(deck%bulk%gravity)
         associate (card => deck%bulk%gravity(i))
            call find_system(deck, card%line, 'CID', card%system, model%systems, system)
            acceleration = card%acceleration
            if (card%is_spin) then
               call check_spin(card)
               cycle
            end if
            if (system > 0) then
               if (model%systems(system)%kind /= rectangular) call deck%field_error(card%line, 'CID', integer_text(card%system)// &
                  ' is not rectangular, but gravity has one direction everywhere')
               acceleration = matmul(model%systems(system)%axes, acceleration)
            end if
            call check_plane(deck, model, card%line, acceleration, turned=card%system > 0)
            if (model%axisymmetric .and. abs(acceleration(1)) > 1.0e-12_wp*norm2(acceleration)) &
               call deck%field_error(card%line, 'N1', 'not zero, but in an axisymmetric model gravity acts along y')
            if (all(model%properties%rho <= 0.0_wp) .and. all(deck%bulk%mass%mass <= 0.0_wp)) &
               call deck%errors%add(card%line, 'GRAV: no body has a mass; give RHO on its MAT1')
         end associate
      end do

   contains

      !> RFORCE: an axis along z in the plane, along y of revolution, and a mass.
      subroutine check_spin(card)
         type(gravity_card), intent(in) :: card
         real(wp) :: axis(3), size_of

         axis = abs(card%spin) + abs(card%spin_rate)
         if (card%node > 0) then
            if (model%node_table%find(card%node) == 0) call deck%field_error(card%line, 'G', 'there is no GRID '// &
                                                                             integer_text(card%node))
         end if
         if (system > 0) then
            if (model%systems(system)%kind /= rectangular) call deck%field_error(card%line, 'CID', integer_text(card%system)// &
               ' is not rectangular, but the axis has one direction everywhere')
            axis = abs(matmul(model%systems(system)%axes, card%spin)) + abs(matmul(model%systems(system)%axes, card%spin_rate))
         end if
         size_of = maxval(axis)
         if (model%axisymmetric) then
            if (maxval(axis([1, 3])) > 1.0e-12_wp*size_of) call deck%field_error(card%line, 'R1', &
               'a ring turns about y; expected R1 and R3 zero')
            if (any(abs(card%spin_rate) > 0.0_wp)) call deck%field_error(card%line, 'RACC', &
               'not zero, but an axisymmetric model has no circumferential forces')
         else if (model%dimension == 2) then
            if (maxval(axis(:2)) > 1.0e-12_wp*size_of) call deck%field_error(card%line, 'R1', &
               'a plane model turns about z; expected R1 and R2 zero')
         end if
         if (all(model%properties%rho <= 0.0_wp) .and. all(deck%bulk%mass%mass <= 0.0_wp)) &
            call deck%errors%add(card%line, 'RFORCE: no body has a mass; give RHO on its MAT1')
      end subroutine check_spin

   end subroutine check_gravity

   !> SPCD moves components that are held.
   subroutine check_displacements(deck, model)
      type(checked_deck), intent(in) :: deck
      type(model_type), intent(in)   :: model
      character(:), allocatable :: words
      integer :: d, i, node

      do i = 1, size(deck%bulk%displacement)
         associate (card => deck%bulk%displacement(i))
            node = model%node_table%find(card%node)
            if (node == 0) cycle
            do d = 1, 6
               if (.not. has_component(card%components, d)) cycle
               words = ''
               associate (place => place_of_component(model, node, d))
                  if (place%node == 0) then
                     words = ', expected 1 to '//integer_text(model%dimension)
                  else if (.not. is_supported(model, place)) then
                     words = ' of node '//integer_text(card%node)//' is not supported: SPCD moves components that an SPC holds'
                  end if
               end associate
               if (words /= '') call deck%field_error(card%line, card%field + 1, 'component '//integer_text(d)//words, &
                                                      called='C')
            end do
         end associate
      end do
   end subroutine check_displacements

   !> Whether the component at PLACE is supported.
   pure logical function is_supported(model, place)
      type(model_type), intent(in)      :: model
      type(component_place), intent(in) :: place
      logical :: held(model%dimension)

      held = supported(model, place%node)
      is_supported = held(place%d)
   end function is_supported

   !> LOAD cards combine sets that are there.
   subroutine check_combinations(deck)
      type(checked_deck), intent(in) :: deck
      character(:), allocatable :: name
      integer :: i, k

      name = ''
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
            name = others
            if (any(deck%bulk%force%set == card%set)) name = 'FORCE'
            call deck%field_error(card%line, 'SID', 'set '//integer_text(card%set)//' is that of a '//name// &
                                  ' too: case control is ambiguous')
         end associate
      end do
   end subroutine check_combinations

   !> Of every stage that names a set of TEMP and TEMPD cards the temperatures of all nodes, in its load of MODEL.
   subroutine build_temperatures(deck, model)
      type(checked_deck), intent(in)  :: deck
      type(model_type), intent(inout) :: model
      logical, allocatable :: given(:)
      integer :: before, s

      call check_nodes(deck, model)
      do s = 1, size(deck%control%stages)
         associate (reference => deck%control%stages(s)%temperature, stages => deck%control%stages)
            if (reference%id == 0) cycle
            before = findloc(stages(:s - 1)%temperature%id, reference%id, dim=1)
            if (before > 0) then
               model%stage_loads(s)%temperature = model%stage_loads(before)%temperature
               cycle
            end if
            if (all(deck%bulk%temperature%set /= reference%id)) then
               call deck%errors%add(reference%line, 'TEMPERATURE: there is no TEMP or TEMPD with set '// &
                                    integer_text(reference%id))
               cycle
            end if
            if (all(abs(model%properties%alpha) <= 0.0_wp) .and. .not. has_warm_bar(model)) then
               call deck%errors%add(reference%line, 'TEMPERATURE: nothing expands; give A on a MAT1')
               cycle
            end if
            associate (temperature => model%stage_loads(s)%temperature)
               allocate (temperature%at(model%n_nodes), source=0.0_wp)
               temperature%reference_share = 1.0_wp
               call fill_in(deck, model, reference%id, temperature%at, given)
            end associate
            if (.not. deck%errors%any()) call check_whole(deck, model, s, given)
         end associate
      end do
   end subroutine build_temperatures

   !> Whether any bar expands.
   pure logical function has_warm_bar(model)
      type(model_type), intent(in) :: model

      has_warm_bar = .false.
      if (n_bars(model) > 0) has_warm_bar = any(abs(model%bars%expansion) > 0.0_wp)
   end function has_warm_bar

   !> TEMP cards name nodes that are there, each once a set; a set has one TEMPD.
   subroutine check_nodes(deck, model)
      type(checked_deck), intent(in) :: deck
      type(model_type), intent(in)   :: model
      integer :: i, k, node
      integer, allocatable :: last(:) ! (nodes) card that named it last

      allocate (last(model%n_nodes), source=0)
      do i = 1, size(deck%bulk%temperature)
         associate (card => deck%bulk%temperature(i))
            if (card%is_default) then
               k = findloc(deck%bulk%temperature(:i - 1)%is_default .and. deck%bulk%temperature(:i - 1)%set == card%set, &
                           .true., dim=1)
               if (k > 0 .and. card%set > 0) call deck%field_error(card%line, card%field, 'set '//integer_text(card%set)// &
                  ' has a TEMPD already, in '//deck%text%place(deck%bulk%temperature(k)%line))
               cycle
            end if
            if (card%node == 0) cycle
            node = model%node_table%find(card%node)
            if (node == 0) then
               call deck%field_error(card%line, card%field, 'there is no GRID '//integer_text(card%node))
               cycle
            end if
            k = last(node)
            last(node) = i
            if (k == 0) cycle
            if (deck%bulk%temperature(k)%set == card%set) call deck%field_error(card%line, card%field, 'node '// &
               integer_text(card%node)//' has a temperature in set '//integer_text(card%set)//' already, in '// &
               deck%text%place(deck%bulk%temperature(k)%line))
         end associate
      end do
   end subroutine check_nodes

   !> The temperatures AT all nodes in SET, and which are GIVEN: by TEMP, else by TEMPD; the twin of a node of a split surface has
   !! the same, a node on the face of a shell that of the shell, a node put at the middle of an edge the mean of its ends.
   subroutine fill_in(deck, model, set, at, given)
      type(checked_deck), intent(in)    :: deck
      type(model_type), intent(in)      :: model
      integer, intent(in)               :: set
      real(wp), intent(inout)           :: at(:)
      logical, allocatable, intent(out) :: given(:)
      logical :: is_filled(model%n_nodes)
      integer :: corners(2), e, i, k, node

      allocate (given(model%n_nodes), source=.false.)
      do i = 1, size(deck%bulk%temperature)
         associate (card => deck%bulk%temperature(i))
            if (card%is_default .or. card%set /= set) cycle
            node = model%node_table%find(card%node)
            if (node == 0) cycle
            at(node) = card%value
            given(node) = .true.
         end associate
      end do
      is_filled = .false.
      is_filled(model%first_filled:model%first_filled + model%n_filled - 1) = .true.
      do i = 1, n_points(model)
         if (model%duplicate(i) == 0) cycle
         associate (twin => model%duplicate(i))
            if (given(i) .and. .not. given(twin)) at(twin) = at(i)
            given(twin) = given(twin) .or. given(i)
            is_filled(twin) = is_filled(i)
         end associate
      end do
      i = findloc(deck%bulk%temperature%is_default .and. deck%bulk%temperature%set == set, .true., dim=1)
      if (i > 0) then
         where (.not. (given .or. is_filled)) at = deck%bulk%temperature(i)%value
         given = given .or. .not. is_filled
      end if
      do e = 1, model%n_elements
         associate (kind => element_table(model%element_kind(e)), nodes => corners_of(model, e))
            do k = kind%n_corners + 1, kind%n_nodes
               if (any(nodes == 0)) exit
               corners = nodes(kind%edges(:, k - kind%n_corners))
               if (given(nodes(k)) .or. .not. all(given(corners))) cycle
               at(nodes(k)) = 0.5_wp*sum(at(corners))
               given(nodes(k)) = .true.
            end do
         end associate
      end do
      if (.not. allocated(model%faces)) return
      do k = 1, size(model%faces)
         associate (face => model%faces(k))
            at(face%node) = at(face%point)
            given(face%node) = given(face%point)
         end associate
      end do
   end subroutine fill_in

   !> Every node of a body or of a bar has a temperature in stage S.
   subroutine check_whole(deck, model, s, given)
      type(checked_deck), intent(in) :: deck
      type(model_type), intent(in)   :: model
      integer, intent(in)            :: s
      logical, intent(in)            :: given(:)
      integer :: i

      associate (reference => deck%control%stages(s)%temperature)
         do i = 1, n_points(model)
            if (given(i) .or. .not. is_warmed(i)) cycle
            call deck%errors%add(reference%line, 'TEMPERATURE: node '//integer_text(model%node_id(i))// &
               ' has no temperature in set '//integer_text(reference%id)//'; expected a TEMP of it, or a TEMPD')
            return
         end do
      end associate

   contains

      pure logical function is_warmed(node)
         integer, intent(in) :: node
         integer :: k

         is_warmed = model%first_at(node + 1) > model%first_at(node)
         do k = 1, n_bars(model)
            is_warmed = is_warmed .or. (model%bars(k)%kind == a_bar .and. any(model%bars(k)%nodes == node))
         end do
      end function is_warmed

   end subroutine check_whole

end module load_checks
