!> Dependent nodes: RBE2, RBE3 and the MPC of the case control as sums over components of other nodes, which take their place.
module rigid_build
   use bulk_data, only: equation_card, has_component, rigid_card
   use deck_check, only: checked_deck
   use dependences, only: add_dependence, add_term, check_dependences, dependence_list, eliminate
   use kinds, only: wp
   use model_data, only: model_type, n_rotations
   use node_coupling, only: couple_node
   use reference_nodes, only: component_place, node_axes, place_of_component, rotation_at, third_axis
   use rigid_motion, only: by_rotation, mean_motion
   use text_tools, only: integer_text
   implicit none
   private

   public :: build_dependents

contains

   !> Make of the rigid elements and equations of DECK couplings of MODEL, whose supports and displacement systems are known.
   !! Errors: nodes that are not there or split, components that are none, and those of check_dependences.
   subroutine build_dependents(deck, model)
      type(checked_deck), intent(in)  :: deck
      type(model_type), intent(inout) :: model
      type(dependence_list) :: list
      logical, allocatable  :: without(:) ! nodes of these cards that no element holds
      integer :: i, set

      set = 0
      if (size(deck%control%stages) > 0) set = deck%control%stages(1)%equations%id
      if (set > 0 .and. all(deck%bulk%equation%set /= set)) call deck%errors%add(deck%control%stages(1)%equations%line, &
         'MPC: there is no MPC with set '//integer_text(set))
      if (size(deck%bulk%rigid) + size(deck%bulk%equation) == 0) return
      allocate (without(model%n_nodes), source=.false.)
      do i = 1, size(deck%bulk%rigid)
         if (deck%bulk%rigid(i)%is_mean) then
            call add_mean(deck, deck%bulk%rigid(i), model, list, without)
         else
            call add_rigid(deck, deck%bulk%rigid(i), model, list, without)
         end if
      end do
      do i = 1, size(deck%bulk%equation)
         call add_equation(deck, deck%bulk%equation(i), deck%bulk%equation(i)%set == set, model, list, without)
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

   !> The dependences of an RBE3: the components REFC of its node are the weighted mean of those of its nodes.
   subroutine add_mean(deck, card, model, list, without)
      type(checked_deck), intent(in)       :: deck
      type(rigid_card), intent(in)         :: card
      type(model_type), intent(in)         :: model
      type(dependence_list), intent(inout) :: list
      logical, intent(inout)               :: without(:)
      real(wp) :: t(6, 3, size(card%nodes)), direction(6)
      integer  :: digit, i, nodes(size(card%nodes)), point, c
      logical  :: determined(6)

      call find_node(deck, card%line, 3, card%node, model, without, point)
      do i = 1, size(card%nodes)
         call find_node(deck, card%line, card%at(i), card%nodes(i), model, without, nodes(i))
      end do
      if (no_displacement(model, card%components) .and. .not. has_component(card%components, 6)) &
         call deck%field_error(card%line, 'REFC', 'names no component that nodes of this model have')
      call check_directions(deck, card, model)
      if (point == 0 .or. any(nodes == 0) .or. deck%errors%any()) return
      call motion_of_mean(model, card, point, nodes, t, determined)
      do digit = 1, 6
         if (.not. has_component(card%components, digit)) cycle
         associate (place => place_of_component(model, point, digit))
            if (place%node == 0) cycle
            direction = direction_of(model, point, digit)
            if (any(.not. determined .and. abs(direction) > 1.0e-10_wp)) then
               call deck%field_error(card%line, 'REFC', 'component '//integer_text(digit)//' of node '// &
                  integer_text(card%node)//' cannot be had from the components C of these nodes: they move so that it is left '// &
                  'open, as nodes on a line leave the rotation about it')
               return
            end if
            call add_dependence(list, place, card%line, 3)
            do i = 1, size(nodes)
               do c = 1, model%dimension
                  call add_term(list, component_place(nodes(i), c), place%scale*dot_product(direction, t(:, c, i)))
               end do
            end do
         end associate
      end do
   end subroutine add_mean

   !> What of displacement and rotation in global axes the component DIGIT of POINT is.
   pure function direction_of(model, point, digit) result(direction)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: point, digit
      real(wp) :: direction(6), axes(3, 3)

      axes = node_axes(model, point)
      if (model%dimension == 2) axes(:, 3) = third_axis(model, point)
      direction = 0.0_wp
      if (digit <= 3) direction(:3) = axes(:, digit)
      if (digit > 3) direction(4:) = axes(:, digit - 3)
      if (model%axisymmetric) direction([1, 3, 4, 5, 6]) = 0.0_wp
   end function direction_of

   !> [T] of mean_motion for the NODES of CARD; on a ring, whose rotation does not count, from their displacements along the axis.
   subroutine motion_of_mean(model, card, point, nodes, t, determined)
      type(model_type), intent(in) :: model
      type(rigid_card), intent(in) :: card
      integer, intent(in)          :: point, nodes(:)
      real(wp), intent(out)        :: t(:, :, :)
      logical, intent(out)         :: determined(6)
      real(wp) :: r(3, size(nodes)), axes(3, 3, size(nodes))
      logical  :: used(3, size(nodes))
      integer  :: c, i

      do i = 1, size(nodes)
         r(:, i) = model%x(:, nodes(i)) - model%x(:, point)
         axes(:, :, i) = node_axes(model, nodes(i))
         used(:, i) = [(c <= model%dimension .and. has_component(card%directions(i), c), c = 1, 3)]
      end do
      if (model%axisymmetric) then
         r = 0.0_wp
         axes([1, 3], :, :) = 0.0_wp
      end if
      call mean_motion(r, axes, used, card%weight, t, determined)
   end subroutine motion_of_mean

   !> The means are of displacements: C names no rotations, and some displacement.
   subroutine check_directions(deck, card, model)
      type(checked_deck), intent(in) :: deck
      type(rigid_card), intent(in)   :: card
      type(model_type), intent(in)   :: model
      integer :: i

      do i = 1, size(card%nodes)
         if (card%directions(i) == 0) cycle ! said already
         if (any([has_component(card%directions(i), 4), has_component(card%directions(i), 5), &
                  has_component(card%directions(i), 6)])) then
            call deck%field_error(card%line, card%at(i), 'its components C, '//integer_text(card%directions(i))// &
               ', are rotations too, which nodes of bodies do not have; expected C of 1 to 3', called='G')
            return
         else if (no_displacement(model, card%directions(i))) then
            call deck%field_error(card%line, card%at(i), 'its components C, '//integer_text(card%directions(i))// &
               ', name no displacement that nodes of this model have', called='G')
            return
         end if
      end do
   end subroutine check_directions

   !> Whether COMPONENTS name no displacement of MODEL.
   pure logical function no_displacement(model, components)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: components
      integer :: d

      no_displacement = components > 0 .and. .not. any([(has_component(components, d), d = 1, model%dimension)])
   end function no_displacement

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

   !> The NODE with the number ID, which data field FIELD of the card on LINE names; 0, and an error, where there is none, or
   !! where a joint split it. A node that no element holds is WITHOUT.
   subroutine find_node(deck, line, field, id, model, without, node)
      type(checked_deck), intent(in) :: deck
      integer, intent(in)            :: line, field, id
      type(model_type), intent(in)   :: model
      logical, intent(inout)         :: without(:)
      integer, intent(out)           :: node

      node = 0
      if (id == 0) return
      node = model%node_table%find(id)
      if (node == 0) then
         call deck%field_error(line, field, 'there is no GRID '//integer_text(id), called='G')
      else if (model%twin(node) > 0) then
         call deck%field_error(line, field, 'node '//integer_text(id)//' is split by a JOINT: which of the two is meant is not '// &
                               'known; expected nodes away from it, or bodies meshed apart', called='G')
         node = 0
      else
         without(node) = without(node) .or. .not. model%used(node)
      end if
   end subroutine find_node

end module rigid_build
