!> Dependent nodes: RBE2, RBE3 and the MPC of the case control as sums over components of other nodes, which take their place.
!! Reference nodes of RBE2 have rotations, and those of RBE3 whose rotations the card asks for. A model of revolution has none:
!! a ring that stays one moves along its axis alone.
module rbe2
   use bulk_data, only: equation_card, has_component, rigid_card
   use constraint_equations, only: add_dependence, add_term, check_dependences, dependence_list, eliminate
   use deck_check, only: checked_deck
   use kinds, only: wp
   use model_data, only: model_type, n_rotations
   use rbe3, only: add_mean, by_rotation, find_node, no_displacement
   use reference_nodes, only: component_place, node_axes, place_of_component, rotation_at, third_axis
   use support_build, only: check_sums, summed_sets
   use surface_build, only: find_surface, surface_node_list, surface_nodes
   use text_tools, only: integer_text
   implicit none
   private

   public :: build_dependents, name_surface_nodes

contains

   !> Make of the rigid elements and equations of DECK couplings of MODEL, whose supports and displacement systems are known.
   !! Errors: nodes that are not there or split, components that are none, and those of check_dependences.
   subroutine build_dependents(deck, model)
      type(checked_deck), intent(in)  :: deck
      type(model_type), intent(inout) :: model
      type(dependence_list) :: list
      logical, allocatable  :: without(:) ! nodes of these cards that no element holds
      integer, allocatable  :: active(:)  ! sets of equations
      integer :: i, set

      set = 0
      if (size(deck%control%stages) > 0) set = deck%control%stages(1)%equations%id
      if (set > 0 .and. all(deck%bulk%equation%set /= set) .and. all(deck%bulk%equation_sum%set /= set)) call deck%errors%add( &
         deck%control%stages(1)%equations%line, 'MPC: there is no MPC or MPCADD with set '//integer_text(set))
      call check_sums(deck, 'MPCADD', deck%bulk%equation_sum, deck%bulk%equation%set, 'MPC')
      allocate (active, source=summed_sets(deck%bulk%equation_sum, set))
      if (size(deck%rigid) + size(deck%bulk%equation) == 0) return
      allocate (without(model%n_nodes), source=.false.)
      do i = 1, size(deck%rigid)
         call check_expansion(deck, deck%rigid(i))
         if (deck%rigid(i)%is_mean) then
            call add_mean(deck, deck%rigid(i), model, list, without)
         else
            call add_rigid(deck, deck%rigid(i), model, list, without)
         end if
      end do
      do i = 1, size(deck%bulk%equation)
         call add_equation(deck, deck%bulk%equation(i), any(active == deck%bulk%equation(i)%set), model, list, without)
      end do
      model%used = model%used .or. without
      if (deck%errors%any() .or. list%n == 0) return
      call check_dependences(deck, model, list)
      do i = 1, n_rotations(model)
         model%used(model%rotations(i)%node) = .true.
         if (.not. model%rotations(i)%of_element) without(model%rotations(i)%node) = .true.
      end do
      if (.not. deck%errors%any()) call eliminate(list, without, model)
   end subroutine build_dependents

   !> The nodes of RBE2M and RBE3M are those of their surface: of RBE3M with their areas of influence as weights, so that what acts on the
   !! reference node is spread evenly over the area; of RBE2M without GN, which may be one of them.
   subroutine name_surface_nodes(deck, model)
      type(checked_deck), intent(inout) :: deck
      type(model_type), intent(in)      :: model
      type(surface_node_list) :: list
      logical, allocatable :: counts(:)
      integer :: i, surface

      do i = 1, size(deck%rigid)
         associate (card => deck%rigid(i))
            if (card%surface == 0) cycle
            call find_surface(deck, card%line, 'PID', card%surface, model, surface)
            if (surface == 0) cycle
            call surface_nodes(model, model%surfaces(surface), list)
            if (card%is_mean) then ! mid-side nodes alone have an area on triangles of second order
               counts = abs(list%area) > 1.0e-12_wp*maxval(abs(list%area))
            else
               counts = model%node_id(list%node) /= card%node
            end if
            card%nodes = pack(model%node_id(list%node), counts)
            card%weight = pack(list%area, counts)
            card%at = spread(card%at(1), 1, size(card%nodes))
            card%directions = spread(card%directions(1), 1, size(card%nodes))
         end associate
      end do
   end subroutine name_surface_nodes

   !> A rigid element that grows where there are temperatures: that is not done.
   subroutine check_expansion(deck, card)
      type(checked_deck), intent(in) :: deck
      type(rigid_card), intent(in)   :: card

      if (abs(card%alpha) > 0.0_wp .and. any(deck%control%stages%temperature%id > 0)) call deck%field_error(card%line, &
         card%alpha_at, 'not zero, and case control has TEMPERATURE(LOAD), but rigid elements have no thermal expansion; '// &
            'expected blank or zero', called='ALPHA')
   end subroutine check_expansion

   !> The dependences of an RBE2: the components CM of its nodes are those of a rigid body that moves with GN, {u} + theta x arm.
   subroutine add_rigid(deck, card, model, list, without)
      type(checked_deck), intent(in)       :: deck
      type(rigid_card), intent(in)         :: card
      type(model_type), intent(in)         :: model
      type(dependence_list), intent(inout) :: list
      logical, intent(inout)               :: without(:)
      real(wp) :: own(3, 3), motion(3, 6)
      integer  :: c, digit, k, node, point

      call find_node(deck, card%line, card%node_at, card%node, model, without, point)
      if (no_displacement(model, card%components) .and. .not. turn_others()) call deck%field_error(card%line, &
         card%components_at, 'contains no displacement of the nodes of this model; expected some of 1 to '// &
         integer_text(model%dimension), called='CM')
      do k = 1, size(card%nodes)
         call find_node(deck, card%line, card%at(k), card%nodes(k), model, without, node)
         if (node == 0 .and. card%surface > 0) return ! one of a surface stands for all
         if (node == 0 .or. point == 0) cycle
         if (node == point) then
            call deck%field_error(card%line, card%at(k), 'node '//integer_text(card%node)//' is the independent node GN; '// &
                                  'expected other nodes that move with it', called='G')
            cycle
         end if
         own = node_axes(model, node)
         motion = rigid_components(model, point, model%x(:, node) - model%x(:, point))
         do c = 1, model%dimension
            if (.not. has_component(card%components, c)) cycle
            call add_dependence(list, component_place(node, c), card%line, card%at(k))
            do digit = 1, 6
               associate (place => place_of_component(model, point, digit))
                  if (place%node > 0) call add_term(list, place, dot_product(own(:, c), motion(:, digit))/place%scale)
               end associate
            end do
         end do
         call add_rotations(node, card%at(k))
      end do

   contains

      !> Whether the card names rotations, and a dependent node has some.
      logical function turn_others()
         integer :: c, i

         turn_others = any([(has_component(card%components, c), c = 4, 6)]) .and. &
                       any([(rotation_at(model, max(1, model%node_table%find(card%nodes(i)))) > 0, i = 1, size(card%nodes))])
      end function turn_others

      !> Rotations of a dependent NODE that has them are those of the body.
      subroutine add_rotations(node, at)
         integer, intent(in) :: node, at
         type(component_place) :: own_place, place
         real(wp) :: body(3, 3)
         integer  :: c, digit

         if (rotation_at(model, node) == 0) return
         own = node_axes(model, node)
         body = node_axes(model, point)
         do c = 4, 6
            own_place = place_of_component(model, node, c)
            if (own_place%node == 0 .or. .not. has_component(card%components, c)) cycle
            call add_dependence(list, own_place, card%line, at)
            do digit = 4, 6
               place = place_of_component(model, point, digit)
               if (place%node > 0) call add_term(list, place, dot_product(own(:, c - 3), body(:, digit - 3))* &
                                                 own_place%scale/place%scale)
            end do
         end do
      end subroutine add_rotations

   end subroutine add_rigid

   !> The displacement at ARM from POINT that its components 1 to 6 make of a rigid body, in global axes. That of a ring is along the
   !! axis of revolution alone.
   pure function rigid_components(model, point, arm) result(motion)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: point
      real(wp), intent(in)         :: arm(3)
      real(wp) :: motion(3, 6)

      motion(:, :3) = node_axes(model, point)
      motion(:, 4:) = matmul(by_rotation(arm), motion(:, :3))
      if (model%dimension == 2) motion(:, 6) = matmul(by_rotation(arm), third_axis(model, point))
      if (.not. model%axisymmetric) return
      motion(1, :) = 0.0_wp
      motion(3, :) = 0.0_wp
   end function rigid_components

   !> The dependence of an MPC where it is ACTIVE.
   subroutine add_equation(deck, card, active, model, list, without)
      type(checked_deck), intent(in)       :: deck
      type(equation_card), intent(in)      :: card
      logical, intent(in)                  :: active
      type(model_type), intent(in)         :: model
      type(dependence_list), intent(inout) :: list
      logical, intent(inout)               :: without(:)
      type(component_place) :: place(size(card%node))
      integer :: k, node
      logical :: nowhere(size(without))

      nowhere = without
      do k = 1, size(card%node)
         call find_node(deck, card%line, card%at(k), card%node(k), model, nowhere, node)
         if (node == 0 .or. card%component(k) == 0) cycle
         place(k) = place_of_component(model, node, card%component(k))
         if (place(k)%node == 0) call deck%field_error(card%line, card%at(k) + 1, 'node '//integer_text(card%node(k))// &
            ' has no component '//integer_text(card%component(k)), called='C')
         if (k == 1 .or. place(k)%node == 0) cycle
         if (place(k)%node == place(1)%node .and. place(k)%d == place(1)%d) call deck%field_error(card%line, card%at(k), &
            'this is the dependent component of the first term', called='G')
      end do
      if (.not. active) return
      without = nowhere
      if (any(place%node == 0) .or. deck%errors%any()) return
      call add_dependence(list, place(1), card%line, card%at(1))
      do k = 2, size(place)
         call add_term(list, place(k), -card%factor(k)/card%factor(1)*place(1)%scale/place(k)%scale)
      end do
   end subroutine add_equation

end module rbe2
