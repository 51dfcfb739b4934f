!> Load cards against the model: nodes, surfaces, sets and masses that are there, directions that the model has.
module load_checks
   use bulk_data, only: bulk_data_type
   use deck_cards, only: add_field_error
   use deck_errors, only: deck_error_list
   use deck_input, only: deck_type
   use kinds, only: wp
   use model_data, only: model_type
   use text_tools, only: integer_text
   implicit none
   private

   public :: check_load_cards, has_component, has_set

   !> Behind `there is no FORCE`: the other cards of a load set.
   character(*), parameter, public :: nor_others = ', nor a PLOAD4, PLOADE, PLOADM, FORCEM, GRAV or SPCD'

contains

   !> All load cards of the deck; what does not fit goes to ERRORS.
   subroutine check_load_cards(deck, model, errors)
      type(deck_type), intent(in)          :: deck
      type(model_type), intent(in)         :: model
      type(deck_error_list), intent(inout) :: errors

      call check_forces(deck, model, errors)
      call check_surface_loads(deck, model, errors)
      call check_gravity(deck, model, errors)
      call check_displacements(deck, model, errors)
      call check_combinations(deck, errors)
   end subroutine check_load_cards


   !> Whether some load card is of SET.
   pure logical function has_set(bulk, set)
      type(bulk_data_type), intent(in) :: bulk
      integer, intent(in)              :: set

      has_set = any(bulk%force(:bulk%n_force)%set == set) .or. any(bulk%pressure(:bulk%n_pressure)%set == set) .or. &
                any(bulk%surface_load(:bulk%n_surface_load)%set == set) .or. &
                any(bulk%gravity(:bulk%n_gravity)%set == set) .or. &
                any(bulk%displacement(:bulk%n_displacement)%set == set)
   end function has_set


   !> Forces act on nodes that are there, in directions that they have.
   subroutine check_forces(deck, model, errors)
      type(deck_type), intent(in)          :: deck
      type(model_type), intent(in)         :: model
      type(deck_error_list), intent(inout) :: errors
      integer :: i, node

      associate (bulk => deck%bulk)
         do i = 1, bulk%n_force
            node = model%node_table%find(bulk%force(i)%node)
            if (node == 0 .and. bulk%force(i)%node > 0) then
               call add_field_error(deck%text, bulk%force(i)%line, 2, 'G', 'there is no GRID '// &
                                    integer_text(bulk%force(i)%node), errors)
            else if (node > 0) then
               if (.not. model%used(node)) call add_field_error(deck%text, bulk%force(i)%line, 2, 'G', 'node '// &
                  integer_text(bulk%force(i)%node)//' belongs to no element', errors)
            end if
            call check_plane(deck, model, bulk%force(i)%line, 7, 'N3', bulk%force(i)%force, errors)
         end do
      end associate
   end subroutine check_forces


   !> A plane model has no direction z; the card on LINE has its component in data field K.
   subroutine check_plane(deck, model, line, k, name, vector, errors)
      type(deck_type), intent(in)          :: deck
      type(model_type), intent(in)         :: model
      integer, intent(in)                  :: line, k
      character(*), intent(in)             :: name
      real(wp), intent(in)                 :: vector(3)
      type(deck_error_list), intent(inout) :: errors

      if (model%dimension == 2 .and. abs(vector(3)) > 0.0_wp) call add_field_error(deck%text, line, k, name, &
         'not zero, but a plane model lies in x-y', errors)
   end subroutine check_plane


   !> PLOADM and FORCEM act on surfaces that are there; a pressure, on one that has one body alone.
   subroutine check_surface_loads(deck, model, errors)
      type(deck_type), intent(in)          :: deck
      type(model_type), intent(in)         :: model
      type(deck_error_list), intent(inout) :: errors
      integer :: i, field, s

      do i = 1, deck%bulk%n_surface_load
         associate (card => deck%bulk%surface_load(i))
            if (card%surface == 0) cycle
            field = merge(3, 6, card%is_pressure)
            s = findloc(model%surfaces%id, card%surface, dim=1)
            if (s == 0) then
               call add_field_error(deck%text, card%line, field, 'PID', 'there is no PMARK '//integer_text(card%surface), errors)
               cycle
            end if
            if (card%is_pressure .and. (any(model%surfaces(s)%other(:model%surfaces(s)%n) > 0) .or. &
                                        model%surfaces(s)%was_split)) call add_field_error(deck%text, &
               card%line, field, 'PID', 'bodies lie on both sides of surface '//integer_text(card%surface)// &
               ', so which one the pressure acts on is not known', errors)
            if (model%axisymmetric .and. on_axis(model, s)) call add_field_error(deck%text, card%line, field, 'PID', &
               'surface '//integer_text(card%surface)//' lies on the axis and has no area', errors)
            if (.not. card%is_pressure) call check_plane(deck, model, card%line, 5, 'N3', card%force, errors)
         end associate
      end do
   end subroutine check_surface_loads


   !> Whether all nodes of surface S have x = 0, the axis of a body of revolution.
   pure logical function on_axis(model, s)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: s
      integer :: i

      on_axis = model%surfaces(s)%n > 0
      do i = 1, model%surfaces(s)%n
         if (maxval(abs(model%x(1, model%surfaces(s)%nodes(:model%surfaces(s)%corners(i), i)))) > 0.0_wp) on_axis = .false.
      end do
   end function on_axis


   !> GRAV needs a mass to act on.
   subroutine check_gravity(deck, model, errors)
      type(deck_type), intent(in)          :: deck
      type(model_type), intent(in)         :: model
      type(deck_error_list), intent(inout) :: errors
      integer :: i

      do i = 1, deck%bulk%n_gravity
         associate (card => deck%bulk%gravity(i))
            call check_plane(deck, model, card%line, 6, 'N3', card%acceleration, errors)
            if (model%axisymmetric .and. abs(card%acceleration(1)) > 0.0_wp) call add_field_error(deck%text, card%line, 4, 'N1', &
               'not zero, but in an axisymmetric model gravity acts along y', errors)
            if (all(model%properties%rho <= 0.0_wp)) call errors%add(card%line, 'GRAV: no body has a mass; give RHO on its MAT1')
         end associate
      end do
   end subroutine check_gravity


   !> SPCD moves components that are held.
   subroutine check_displacements(deck, model, errors)
      type(deck_type), intent(in)          :: deck
      type(model_type), intent(in)         :: model
      type(deck_error_list), intent(inout) :: errors
      integer :: d, i, node

      do i = 1, deck%bulk%n_displacement
         associate (card => deck%bulk%displacement(i))
            if (card%node == 0) cycle
            node = model%node_table%find(card%node)
            if (node == 0) then
               call add_field_error(deck%text, card%line, card%field, 'G', 'there is no GRID '//integer_text(card%node), errors)
               cycle
            end if
            do d = 1, 6
               if (.not. has_component(card%components, d)) cycle
               if (d > model%dimension) then
                  call add_field_error(deck%text, card%line, card%field + 1, 'C', 'component '//integer_text(d)// &
                     ', expected 1 to '//integer_text(model%dimension), errors)
               else if (.not. model%held(d, node)) then
                  call add_field_error(deck%text, card%line, card%field + 1, 'C', 'component '//integer_text(d)//' of node '// &
                     integer_text(card%node)//' is not supported: SPCD moves components that an SPC holds', errors)
               end if
            end do
         end associate
      end do
   end subroutine check_displacements


   !> Whether digit D is among COMPONENTS.
   pure logical function has_component(components, d)
      integer, intent(in) :: components, d
      integer :: rest

      has_component = .true.
      rest = components
      do while (rest > 0)
         if (modulo(rest, 10) == d) return
         rest = rest/10
      end do
      has_component = .false.
   end function has_component


   !> LOAD cards combine sets that are there.
   subroutine check_combinations(deck, errors)
      type(deck_type), intent(in)          :: deck
      type(deck_error_list), intent(inout) :: errors
      integer :: i, k

      associate (bulk => deck%bulk)
         do i = 1, bulk%n_load
            do k = 1, size(bulk%load(i)%sets)
               if (bulk%load(i)%sets(k) > 0 .and. .not. has_set(bulk, bulk%load(i)%sets(k))) &
                  call add_field_error(deck%text, bulk%load(i)%line, bulk%load(i)%at(k), 'L'//integer_text(k), &
                                       'there is no FORCE with set '//integer_text(bulk%load(i)%sets(k))//nor_others, errors)
            end do
            if (has_set(bulk, bulk%load(i)%set)) call add_field_error(deck%text, bulk%load(i)%line, 1, 'SID', 'set '// &
               integer_text(bulk%load(i)%set)//' is that of a '//first_of_set(bulk, bulk%load(i)%set)// &
               ' too: case control could mean either', errors)
         end do
      end associate
   end subroutine check_combinations


   !> The name of a card that is of SET.
   pure function first_of_set(bulk, set) result(name)
      type(bulk_data_type), intent(in) :: bulk
      integer, intent(in)              :: set
      character(:), allocatable :: name

      name = 'FORCE'
      if (any(bulk%force(:bulk%n_force)%set == set)) return
      name = 'PLOAD4, PLOADE, PLOADM, FORCEM, GRAV or SPCD'
   end function first_of_set

end module load_checks
