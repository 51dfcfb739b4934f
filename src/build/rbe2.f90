!> Dependent nodes: RBE2, RBE3 and the MPC of the case control as sums over components of other nodes, which take their place.
!! Reference nodes of RBE2 have rotations, and those of RBE3 whose rotations the card asks for. A model of revolution has none:
!! a ring that stays one moves along its axis alone.
module rbe2
   use bulk_data, only: equation_card, has_component, rigid_card
   use constraint_equations, only: add_dependence, add_term, check_dependences, dependence_list, eliminate
   use deck_check, only: checked_deck
   use kinds, only: wp
   use model_data, only: model_type, n_rotations, rotation_type
   use node_build, only: append_node
   use node_coupling, only: couple_node
   use rbe3, only: add_mean, by_rotation, find_node, no_displacement
   use reference_nodes, only: component_place, node_axes, place_of_component, rotation_at, third_axis
   use support_build, only: check_sums, summed_sets
   use text_tools, only: integer_text
   implicit none
   private

   public :: build_dependents, build_rotations

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
      if (size(deck%bulk%rigid) + size(deck%bulk%equation) == 0) return
      allocate (without(model%n_nodes), source=.false.)
      do i = 1, size(deck%bulk%rigid)
         call check_expansion(deck, deck%bulk%rigid(i))
         if (deck%bulk%rigid(i)%is_mean) then
            call add_mean(deck, deck%bulk%rigid(i), model, list, without)
         else
            call add_rigid(deck, deck%bulk%rigid(i), model, list, without)
         end if
      end do
      do i = 1, size(deck%bulk%equation)
         call add_equation(deck, deck%bulk%equation(i), any(active == deck%bulk%equation(i)%set), model, list, without)
      end do
      model%used = model%used .or. without
      if (deck%errors%any() .or. list%n == 0) return
      call check_dependences(deck, model, list)
      do i = 1, n_rotations(model)
         without(model%rotations(i)%node) = .true.
         model%used(model%rotations(i)%node) = .true.
         call turn_rotation(i)
      end do
      if (.not. deck%errors%any()) call eliminate(list, without, model)

   contains

      !> Rotations in space are counted along the axes of their node.
      subroutine turn_rotation(k)
         integer, intent(in) :: k

         if (.not. allocated(model%node_system) .or. model%dimension == 2) return
         associate (rotation => model%rotations(k))
            if (model%node_system(rotation%point) > 0) call couple_node(model%coupling, model%n_nodes, rotation%node, &
               [rotation%node], reshape(node_axes(model, rotation%point), [3, 3, 1]))
         end associate
      end subroutine turn_rotation

   end subroutine build_dependents

   !> A rigid element that grows where there are temperatures: that is not done.
   subroutine check_expansion(deck, card)
      type(checked_deck), intent(in) :: deck
      type(rigid_card), intent(in)   :: card

      if (abs(card%alpha) > 0.0_wp .and. any(deck%control%stages%temperature%id > 0)) call deck%field_error(card%line, &
         card%alpha_at, 'not zero, and case control has TEMPERATURE(LOAD), but rigid elements do not grow with their '// &
         'temperature; expected blank or zero', called='ALPHA')
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

      call find_node(deck, card%line, 2, card%node, model, without, point)
      if (no_displacement(model, card%components)) call deck%field_error(card%line, 'CM', 'names no displacement that nodes of '// &
         'this model have; expected some of 1 to '//integer_text(model%dimension))
      do k = 1, size(card%nodes)
         call find_node(deck, card%line, card%at(k), card%nodes(k), model, without, node)
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
      end do
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
            'this component is that of the first term, which depends on the others', called='G')
      end do
      if (.not. active) return
      without = nowhere
      if (any(place%node == 0) .or. deck%errors%any()) return
      call add_dependence(list, place(1), card%line, card%at(1))
      do k = 2, size(place)
         call add_term(list, place(k), -card%factor(k)/card%factor(1)*place(1)%scale/place(k)%scale)
      end do
   end subroutine add_equation

   !> Append a node for the rotations of each reference node, behind those of the deck. Nodes that are not there are for others to
   !! name.
   subroutine build_rotations(deck, model)
      type(checked_deck), intent(in)  :: deck
      type(model_type), intent(inout) :: model
      integer :: i, point

      if (model%axisymmetric) return
      do i = 1, size(deck%bulk%rigid)
         associate (card => deck%bulk%rigid(i))
            point = model%node_table%find(card%node)
            if (point == 0 .or. .not. turns(model, card)) cycle
            if (rotation_at(model, point) > 0) cycle
            if (.not. allocated(model%rotations)) allocate (model%rotations(0))
            model%rotations = [model%rotations, rotation_type(point=point, arm=arm_of(model, point, card))]
         end associate
      end do
      if (.not. allocated(model%rotations)) return
      do i = 1, size(model%rotations)
         call append_node(model, model%x(:, model%rotations(i)%point), [.true., spread(model%dimension == 3, 1, &
                                                                                        model%dimension - 1)], [integer ::])
         model%rotations(i)%node = model%n_nodes
      end do
   end subroutine build_rotations

   !> Whether the reference node of CARD has rotations that the model knows.
   pure logical function turns(model, card)
      type(model_type), intent(in) :: model
      type(rigid_card), intent(in) :: card

      turns = .not. card%is_mean .or. has_component(card%components, 6)
      if (model%dimension == 3) turns = turns .or. has_component(card%components, 4) .or. has_component(card%components, 5)
   end function turns

   !> Root mean square of the distances of the nodes of CARD from POINT; 1 where they lie there [length].
   pure real(wp) function arm_of(model, point, card) result(arm)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: point
      type(rigid_card), intent(in) :: card
      integer :: k, n, node

      arm = 0.0_wp
      n = 0
      do k = 1, size(card%nodes)
         node = model%node_table%find(card%nodes(k))
         if (node == 0) cycle
         n = n + 1
         arm = arm + sum((model%x(:, node) - model%x(:, point))**2)
      end do
      arm = sqrt(arm/max(n, 1))
      if (arm <= 0.0_wp) arm = 1.0_wp
   end function arm_of

end module rbe2
