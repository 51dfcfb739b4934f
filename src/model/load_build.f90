!> Loads: which forces act, and which displacements are prescribed, at the end of every stage.
module load_build
   use body_elements, only: element_weight
   use bulk_data, only: bulk_data_type, pressure_card
   use deck_cards, only: add_field_error
   use deck_errors, only: deck_error_list
   use deck_input, only: deck_type
   use element_kinds, only: element_table, kind_hexa8, kind_penta6, kind_tetra4, max_nodes, max_side_nodes
   use element_loads, only: side_forces
   use id_table, only: id_table_type
   use kinds, only: wp
   use model_data, only: corners_of, model_type, stage_load_type, surface_type
   use section_coupling, only: add_section_share
   use surface_build, only: side_influence
   use text_tools, only: integer_text
   implicit none
   private

   public :: build_loads

   !> Where the pressure of a PLOAD4 or PLOADE card acts: 0 where the card is in error.
   type :: pressed_side
      integer :: element = 0, side = 0
   end type pressed_side

   character(*), parameter :: nor_others = ', nor a PLOAD4, PLOADE, PLOADM, FORCEM, GRAV or SPCD'

contains

   !> The total load at the end of each stage.
   subroutine build_loads(deck, model, errors)
      type(deck_type), intent(in)          :: deck
      type(model_type), intent(inout)      :: model
      type(deck_error_list), intent(inout) :: errors
      type(pressed_side), allocatable :: pressed(:)
      integer :: i, k, s

      call check_forces(deck, model, errors)
      call find_pressed_sides(deck, model, pressed, errors)
      call check_surface_loads(deck, model, errors)
      call check_gravity(deck, model, errors)
      call check_displacements(deck, model, errors)
      call check_combinations(deck, errors)
      allocate (model%stage_loads(size(deck%control%stages)))
      do s = 1, size(deck%control%stages)
         associate (loads => model%stage_loads(s), reference => deck%control%stages(s)%load)
            allocate (loads%node(deck%bulk%n_force), loads%force(3, deck%bulk%n_force))
            if (reference%id == 0) cycle
            i = findloc(deck%bulk%load(:deck%bulk%n_load)%set, reference%id, dim=1)
            if (i > 0) then
               associate (load => deck%bulk%load(i))
                  do k = 1, size(load%sets)
                     call add_set(deck, model, pressed, load%sets(k), load%scale*load%factors(k), loads)
                  end do
               end associate
            else
               call add_set(deck, model, pressed, reference%id, 1.0_wp, loads)
               if (.not. has_set(deck%bulk, reference%id)) call errors%add(reference%line, &
                  'LOAD: there is no FORCE or LOAD with set '//integer_text(reference%id)//nor_others)
            end if
         end associate
      end do
   end subroutine build_loads


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


   !> The sides that PLOAD4 and PLOADE cards press on.
   subroutine find_pressed_sides(deck, model, pressed, errors)
      type(deck_type), intent(in)          :: deck
      type(model_type), intent(in)         :: model
      type(pressed_side), allocatable, intent(out) :: pressed(:)
      type(deck_error_list), intent(inout) :: errors
      type(id_table_type) :: elements
      integer :: e, i

      allocate (pressed(deck%bulk%n_pressure))
      if (deck%bulk%n_pressure == 0) return
      call elements%build(model%element_id)
      do i = 1, deck%bulk%n_pressure
         associate (card => deck%bulk%pressure(i))
            if (card%first == 0) cycle
            e = elements%find(card%first)
            if (e == 0) then
               call add_field_error(deck%text, card%line, 2, 'EID', 'there is no body element '//integer_text(card%first), errors)
            else if (element_table(model%element_kind(e))%dimension /= merge(3, 2, card%on_face)) then
               call add_field_error(deck%text, card%line, 2, 'EID', 'element '//integer_text(card%first)//' is a '// &
                  trim(element_table(model%element_kind(e))%card)// &
                  trim(merge(': PLOAD4 is for faces of solids', ': PLOADE is for plane edges    ', card%on_face)), errors)
            else if (any(corners_of(model, e) == 0)) then
               cycle ! said already
            else
               call find_side(deck, model, card, e, pressed(i), errors)
            end if
         end associate
      end do
   end subroutine find_pressed_sides


   !> The side of element E that the CARD names by its corners.
   subroutine find_side(deck, model, card, e, pressed, errors)
      type(deck_type), intent(in)          :: deck
      type(model_type), intent(in)         :: model
      type(pressure_card), intent(in)      :: card
      integer, intent(in)                  :: e
      type(pressed_side), intent(inout)    :: pressed
      type(deck_error_list), intent(inout) :: errors
      character(:), allocatable :: expected
      integer :: corner(2), k, side
      logical :: fits

      corner = 0
      do k = 1, 2
         if (card%corners(k) == 0) cycle
         corner(k) = own_corner(model, e, card%corners(k))
         if (corner(k) > 0) cycle
         call add_field_error(deck%text, card%line, merge(6, 3, card%on_face) + k, merge('G1 ', merge('G34', 'G2 ', &
            card%on_face), k == 1), 'node '//integer_text(card%corners(k))//' is no corner of element '// &
            integer_text(card%first), errors)
         return
      end do
      if (corner(1) == 0) return ! said already
      associate (kind => element_table(model%element_kind(e)))
         do side = 1, kind%n_sides
            associate (own => kind%side_nodes(:kind%side_size(side), side))
               if (all(own /= corner(1))) cycle
               select case (model%element_kind(e))
               case (kind_tetra4)            ! G4 is the corner that the face does not have
                  fits = corner(2) > 0 .and. all(own /= corner(2))
               case (kind_hexa8, kind_penta6)
                  if (size(own) == 3) then
                     fits = corner(2) == 0
                  else                       ! G3 is opposite to G1
                     fits = own(modulo(findloc(own, corner(1), dim=1) + 1, 4) + 1) == corner(2)
                  end if
               case default
                  fits = any(own == corner(2)) .and. corner(1) /= corner(2)
               end select
               if (.not. fits) cycle
            end associate
            pressed%element = e
            pressed%side = side
            return
         end do
      end associate
      select case (model%element_kind(e))
      case (kind_tetra4)
         expected = 'expected in G1 a corner of the face and in G4 the corner that it does not have'
      case (kind_hexa8)
         expected = 'expected in G1 and G3 two opposite corners of a face'
      case (kind_penta6)
         expected = 'expected two opposite corners of a quadrilateral face, or in G1 alone a corner of a triangular one'
      case default
         expected = 'expected the two ends of an edge'
      end select
      call add_field_error(deck%text, card%line, merge(7, 4, card%on_face), 'G1', 'no side of element '// &
                           integer_text(card%first)//' has these corners; '//expected, errors)
   end subroutine find_side


   !> Which corner of element E node ID is, the twin of a split node too; 0: none.
   pure integer function own_corner(model, e, id) result(corner)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e, id
      integer :: node

      corner = 0
      node = model%node_table%find(id)
      if (node == 0) return
      corner = findloc(corners_of(model, e), node, dim=1)
      if (corner == 0 .and. model%twin(node) > 0) corner = findloc(corners_of(model, e), model%twin(node), dim=1)
   end function own_corner


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


   !> Add FACTOR times everything of SET to LOADS: nodal forces one by one, distributed loads summed up at every node.
   subroutine add_set(deck, model, pressed, set, factor, loads)
      type(deck_type), intent(in)          :: deck
      type(model_type), intent(in)         :: model
      type(pressed_side), intent(in)       :: pressed(:)
      integer, intent(in)                  :: set
      real(wp), intent(in)                 :: factor
      type(stage_load_type), intent(inout) :: loads
      real(wp), allocatable :: spread_out(:, :)
      integer :: i, node, s

      associate (bulk => deck%bulk)
         do i = 1, bulk%n_force
            if (bulk%force(i)%set == set) call add_force(model%node_table%find(bulk%force(i)%node), &
                                                         factor*bulk%force(i)%force, loads)
         end do
         do i = 1, bulk%n_displacement
            if (bulk%displacement(i)%set == set) call add_displacement(i)
         end do
         if (.not. (any(bulk%pressure%set == set) .or. any(bulk%surface_load%set == set) .or. any(bulk%gravity%set == set))) return
         allocate (spread_out(3, model%n_nodes), source=0.0_wp)
         do i = 1, bulk%n_pressure
            if (bulk%pressure(i)%set == set .and. pressed(i)%element > 0) &
               call add_pressure(model, pressed(i), factor*bulk%pressure(i)%pressure, spread_out)
         end do
         do i = 1, bulk%n_surface_load
            if (bulk%surface_load(i)%set /= set) cycle
            s = findloc(model%surfaces%id, bulk%surface_load(i)%surface, dim=1)
            if (s == 0) cycle
            if (bulk%surface_load(i)%is_pressure) then
               call add_surface_pressure(model, model%surfaces(s), factor*bulk%surface_load(i)%pressure, spread_out)
            else
               call add_surface_force(model, model%surfaces(s), factor*bulk%surface_load(i)%force, spread_out)
            end if
         end do
         do i = 1, bulk%n_gravity
            if (bulk%gravity(i)%set == set) call add_gravity(model, factor*bulk%gravity(i)%acceleration, spread_out)
         end do
      end associate
      do node = 1, model%n_nodes
         if (any(abs(spread_out(:, node)) > 0.0_wp)) call add_force(node, spread_out(:, node), loads)
      end do

   contains

      subroutine add_displacement(card)
         integer, intent(in) :: card
         integer :: at, d

         associate (displacement => deck%bulk%displacement(card))
            at = model%node_table%find(displacement%node)
            if (at == 0) return
            if (.not. allocated(loads%moved)) allocate (loads%moved(model%dimension, model%n_nodes), source=0.0_wp)
            do d = 1, model%dimension
               if (.not. has_component(displacement%components, d)) cycle
               loads%moved(d, at) = loads%moved(d, at) + factor*displacement%value
               if (model%twin(at) > 0) loads%moved(d, model%twin(at)) = loads%moved(d, at) ! a split node: both of it
            end do
         end associate
      end subroutine add_displacement

   end subroutine add_set


   !> A FORCE at NODE, at the end of the list.
   subroutine add_force(node, force, loads)
      integer, intent(in)                  :: node
      real(wp), intent(in)                 :: force(3)
      type(stage_load_type), intent(inout) :: loads
      integer,  allocatable :: longer(:)
      real(wp), allocatable :: wider(:, :)
      integer :: room

      if (loads%n == size(loads%node)) then
         room = 2*loads%n + 8
         allocate (longer(room), wider(3, room))
         longer(:loads%n) = loads%node
         wider(:, :loads%n) = loads%force
         call move_alloc(longer, loads%node)
         call move_alloc(wider, loads%force)
      end if
      loads%n = loads%n + 1
      loads%node(loads%n) = node
      loads%force(:, loads%n) = force
   end subroutine add_force


   !> Nodal forces of a pressure P on one side.
   pure subroutine add_pressure(model, pressed, p, force)
      type(model_type), intent(in)   :: model
      type(pressed_side), intent(in) :: pressed
      real(wp), intent(in)           :: p
      real(wp), intent(inout)        :: force(:, :) !! (3, n_nodes)
      real(wp) :: f(model%dimension, max_side_nodes)

      associate (kind => element_table(model%element_kind(pressed%element)), e => pressed%element)
         associate (nodes => model%element_nodes(kind%side_nodes(:kind%side_size(pressed%side), pressed%side), e), &
                    property => model%properties(max(1, model%element_property(e))))
            call side_forces(property%state, property%thickness, model%x(:model%dimension, nodes), spread(p, 1, size(nodes)), f)
            force(:model%dimension, nodes) = force(:model%dimension, nodes) + f(:, :size(nodes))
            call add_section_share(model, e, nodes, f, force)
         end associate
      end associate
   end subroutine add_pressure


   !> Nodal forces of a pressure P on a surface, positive into its body.
   pure subroutine add_surface_pressure(model, surface, p, force)
      type(model_type), intent(in)   :: model
      type(surface_type), intent(in) :: surface
      real(wp), intent(in)           :: p
      real(wp), intent(inout)        :: force(:, :) !! (3, n_nodes)
      real(wp) :: area(max_side_nodes), normal(3, max_side_nodes)
      integer  :: k, s

      do s = 1, surface%n
         call side_influence(model, surface, s, area, normal)
         do k = 1, surface%corners(s)
            force(:, surface%nodes(k, s)) = force(:, surface%nodes(k, s)) - p*normal(:, k)
         end do
         call add_section_share(model, surface%element(s), surface%nodes(:surface%corners(s), s), -p*normal, force)
      end do
   end subroutine add_surface_pressure


   !> Nodal forces of a total force spread evenly over the area of a surface.
   pure subroutine add_surface_force(model, surface, total, force)
      type(model_type), intent(in)   :: model
      type(surface_type), intent(in) :: surface
      real(wp), intent(in)           :: total(3)
      real(wp), intent(inout)        :: force(:, :) !! (3, n_nodes)
      real(wp) :: area(max_side_nodes), normal(3, max_side_nodes), sum_of_areas
      integer  :: k, pass, s

      sum_of_areas = 0.0_wp
      do pass = 1, 2
         do s = 1, surface%n
            call side_influence(model, surface, s, area, normal)
            if (pass == 1) then
               sum_of_areas = sum_of_areas + sum(area)
               cycle
            end if
            do k = 1, surface%corners(s)
               force(:, surface%nodes(k, s)) = force(:, surface%nodes(k, s)) + area(k)/sum_of_areas*total
            end do
            call add_section_share(model, surface%element(s), surface%nodes(:surface%corners(s), s), &
                                   spread(total/sum_of_areas, 2, max_side_nodes)*spread(area, 1, 3), force)
         end do
         if (sum_of_areas <= 0.0_wp) return
      end do
   end subroutine add_surface_force


   !> Nodal forces of the weight of all bodies.
   pure subroutine add_gravity(model, acceleration, force)
      type(model_type), intent(in) :: model
      real(wp), intent(in)         :: acceleration(3)
      real(wp), intent(inout)      :: force(:, :) !! (3, n_nodes)
      real(wp) :: f(model%dimension, max_nodes)
      integer  :: e

      do e = 1, model%n_elements
         associate (nodes => corners_of(model, e), d => model%dimension)
            if (any(nodes == 0) .or. model%element_property(e) == 0) cycle
            call element_weight(model, e, acceleration(:d), f)
            force(:d, nodes) = force(:d, nodes) + f(:, :size(nodes))
            call add_section_share(model, e, nodes, f, force)
         end associate
      end do
   end subroutine add_gravity

end module load_build
