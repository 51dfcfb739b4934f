!> Loads: which forces act, and which displacements are prescribed, at the end of every stage.
module load_build
   use body_elements, only: element_weight
   use case_entries, only: set_reference
   use deck_check, only: checked_deck
   use element_kinds, only: max_nodes, max_side_nodes
   use kinds, only: wp
   use load_checks, only: check_load_cards, has_set, nor_others
   use model_data, only: corners_of, model_type, stage_load_type, surface_type
   use nodal_forces, only: find_nodal_forces
   use section_coupling, only: add_section_share
   use pressed_sides, only: add_pressure, find_pressed_sides, pressed_side
   use support_moves, only: add_moves, check_kept, keep_moved
   use surface_build, only: side_influence
   use system_build, only: system_of_id
   use text_tools, only: integer_text
   implicit none
   private

   public :: build_loads

contains

   !> The total load at the end of each stage, and the amplitude of the load that oscillates about it.
   subroutine build_loads(deck, model, oscillating)
      type(checked_deck), intent(in)  :: deck
      type(model_type), intent(inout) :: model
      type(stage_load_type), allocatable, intent(out) :: oscillating(:) !! (stages) DLOAD, nothing where none is given
      type(pressed_side), allocatable :: pressed(:)
      integer, allocatable  :: node(:)     ! of the cards of nodal forces
      real(wp), allocatable :: force(:, :) ! likewise
      integer :: s

      call find_nodal_forces(deck, model, node, force)
      call check_load_cards(deck, model)
      call check_kept(deck, model)
      call find_pressed_sides(deck, model, pressed)
      allocate (model%stage_loads(size(deck%control%stages)), oscillating(size(deck%control%stages)))
      do s = 1, size(deck%control%stages)
         associate (loads => model%stage_loads(s), stage => deck%control%stages(s))
            allocate (loads%node(size(deck%bulk%force)), loads%force(3, size(deck%bulk%force)))
            call keep_moved(deck, model, stage%load%id, loads)
            call add_case(stage%load, 'LOAD', loads)
            allocate (oscillating(s)%node(0), oscillating(s)%force(3, 0))
            call add_case(stage%vibration%load, 'DLOAD', oscillating(s))
         end associate
      end do

   contains

      !> Add to LOADS the load set, or the sum of sets, that the entry KEY of case control asks for.
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
                  call add_set(deck, model, node, force, pressed, load%sets(k), load%scale*load%factors(k), loads)
               end do
            end associate
         else
            call add_set(deck, model, node, force, pressed, reference%id, 1.0_wp, loads)
            if (.not. has_set(deck%bulk, reference%id)) call deck%errors%add(reference%line, &
               key//': there is no FORCE or LOAD with set '//integer_text(reference%id)//nor_others)
         end if
      end subroutine add_case

   end subroutine build_loads

   !> Add FACTOR times everything of SET to LOADS: nodal forces one by one, distributed loads summed up at every node.
   subroutine add_set(deck, model, nodal, force, pressed, set, factor, loads)
      type(checked_deck), intent(in)       :: deck
      type(model_type), intent(in)         :: model
      integer, intent(in)                  :: nodal(:)    !! (cards of nodal forces) the nodes on which they act
      real(wp), intent(in)                 :: force(:, :) !! (3, likewise), in global axes [force]
      type(pressed_side), intent(in)       :: pressed(:)
      integer, intent(in)                  :: set
      real(wp), intent(in)                 :: factor
      type(stage_load_type), intent(inout) :: loads
      real(wp), allocatable :: spread_out(:, :)
      real(wp) :: acceleration(3)
      integer  :: i, node, s

      associate (bulk => deck%bulk)
         do i = 1, size(bulk%force)
            if (bulk%force(i)%set == set) call add_force(nodal(i), factor*force(:, i), loads)
         end do
         call add_moves(deck, model, set, factor, loads)
         if (all(bulk%pressure%set /= set) .and. all(bulk%surface_load%set /= set) .and. all(bulk%gravity%set /= set)) return
         if (deck%errors%any()) return ! elements may be what nothing can be spread over
         allocate (spread_out(3, model%n_nodes), source=0.0_wp)
         do i = 1, size(pressed)
            if (bulk%pressure(pressed(i)%card)%set == set) call add_pressure(model, pressed(i), factor, spread_out)
         end do
         do i = 1, size(bulk%surface_load)
            if (bulk%surface_load(i)%set /= set) cycle
            s = findloc(model%surfaces%id, bulk%surface_load(i)%surface, dim=1)
            if (s == 0) cycle
            if (bulk%surface_load(i)%is_pressure) then
               call add_surface_pressure(model, model%surfaces(s), factor*bulk%surface_load(i)%pressure, spread_out)
            else
               call add_surface_force(model, model%surfaces(s), factor*bulk%surface_load(i)%force, spread_out)
            end if
         end do
         do i = 1, size(bulk%gravity)
            if (bulk%gravity(i)%set /= set) cycle
            s = system_of_id(deck, bulk%gravity(i)%system)
            acceleration = factor*bulk%gravity(i)%acceleration
            if (s > 0) acceleration = matmul(model%systems(s)%axes, acceleration)
            call add_gravity(model, acceleration, spread_out)
            call add_mass_weights(model, acceleration, spread_out)
         end do
      end associate
      do node = 1, model%n_nodes
         if (any(abs(spread_out(:, node)) > 0.0_wp)) call add_force(node, spread_out(:, node), loads)
      end do
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
         do k = 1, surface%n_nodes(s)
            force(:, surface%nodes(k, s)) = force(:, surface%nodes(k, s)) - p*normal(:, k)
         end do
         call add_section_share(model, surface%element(s), surface%nodes(:surface%n_nodes(s), s), -p*normal, force)
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
            do k = 1, surface%n_nodes(s)
               force(:, surface%nodes(k, s)) = force(:, surface%nodes(k, s)) + area(k)/sum_of_areas*total
            end do
            call add_section_share(model, surface%element(s), surface%nodes(:surface%n_nodes(s), s), &
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

   !> The weight of masses at nodes.
   pure subroutine add_mass_weights(model, acceleration, force)
      type(model_type), intent(in) :: model
      real(wp), intent(in)         :: acceleration(3)
      real(wp), intent(inout)      :: force(:, :) !! (3, n_nodes)
      integer :: i

      do i = 1, size(model%masses)
         associate (node => model%masses(i)%node)
            force(:, node) = force(:, node) + model%masses(i)%mass*acceleration
         end associate
      end do
   end subroutine add_mass_weights

end module load_build
