!> RBE3: the components of a reference node as the weighted mean of those of other nodes, or with UM others of these components by the
!! same equations.
module mean_build
   use bulk_data, only: has_component, rigid_card
   use deck_check, only: checked_deck
   use dependence_exchange, only: solve_for
   use dependences, only: add_dependence, add_term, dependence_list
   use kinds, only: wp
   use model_data, only: model_type
   use reference_nodes, only: component_place, node_axes, place_of_component, third_axis
   use rigid_motion, only: mean_motion
   use rigid_nodes, only: find_node, no_displacement
   use text_tools, only: integer_text
   implicit none
   private

   public :: add_mean

contains

   !> The dependences of an RBE3: the components REFC of its node are the weighted mean of those of its nodes.
   subroutine add_mean(deck, card, model, list, without)
      type(checked_deck), intent(in)       :: deck
      type(rigid_card), intent(in)         :: card
      type(model_type), intent(in)         :: model
      type(dependence_list), intent(inout) :: list
      logical, intent(inout)               :: without(:)
      real(wp) :: t(6, 3, size(card%nodes)), direction(6)
      integer  :: before, digit, i, nodes(size(card%nodes)), point, c
      logical  :: determined(6)

      before = list%n
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
      if (allocated(card%um_nodes)) call exchange(deck, card, model, before + 1, list)
   end subroutine add_mean

   !> With UM other components depend than REFC: those that the pairs name, in place of what items FIRST and on of LIST are of.
   !! Errors: nodes and components that are not those of the card, not as many as REFC has, and equations that do not give them.
   subroutine exchange(deck, card, model, first, list)
      type(checked_deck), intent(in)       :: deck
      type(rigid_card), intent(in)         :: card
      type(model_type), intent(in)         :: model
      integer, intent(in)                  :: first
      type(dependence_list), intent(inout) :: list
      type(component_place) :: places(6*size(card%um_nodes))
      integer :: at(6*size(card%um_nodes)), digit, k, n
      logical :: ok

      n = 0
      do k = 1, size(card%um_nodes)
         if (card%um_nodes(k) /= card%node .and. all(card%nodes /= card%um_nodes(k))) then
            call deck%field_error(card%line, card%um_at(k), 'node '//integer_text(card%um_nodes(k))// &
               ' is neither REFGRID nor one of the nodes of this card', called='UM')
            return
         end if
         do digit = 1, 6
            if (.not. has_component(card%um_components(k), digit)) cycle
            n = n + 1
            places(n) = place_of_component(model, model%node_table%find(card%um_nodes(k)), digit)
            at(n) = card%um_at(k)
            if (places(n)%node == 0) n = n - 1 ! of a plane model those out of it
         end do
      end do
      ok = n == list%n - first + 1
      if (.not. ok) call deck%field_error(card%line, 4, 'UM names '//integer_text(n)//' components, but REFC has '// &
         integer_text(list%n - first + 1)//'; expected as many')
      if (.not. ok) return
      call solve_for(list, first, places(:n), at(:n), ok)
      if (.not. ok) call deck%field_error(card%line, card%um_at(1), 'the components behind UM do not follow from the others; '// &
                                          'expected such that hold the reference node as REFC does', called='UM')
   end subroutine exchange

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

   !> The means are of displacements: C names some. Rotations in C are left out, as nodes of bodies have none; those of a reference node
   !! would count.
   subroutine check_directions(deck, card, model)
      type(checked_deck), intent(in) :: deck
      type(rigid_card), intent(in)   :: card
      type(model_type), intent(in)   :: model
      integer :: digit, i

      do i = 1, size(card%nodes)
         if (card%directions(i) == 0) cycle ! said already
         if (any([(place_of_rotation(i, digit), digit = 4, 6)])) then
            call deck%field_error(card%line, card%at(i), 'its components C, '//integer_text(card%directions(i))// &
               ', are rotations too, which this node has, as the reference node of a rigid element; expected C of 1 to 3', &
               called='G')
            return
         else if (no_displacement(model, card%directions(i))) then
            call deck%field_error(card%line, card%at(i), 'its components C, '//integer_text(card%directions(i))// &
               ', name no displacement that nodes of this model have', called='G')
            return
         end if
      end do

   contains

      !> Whether C of node K names the rotation DIGIT, and the node has it.
      logical function place_of_rotation(k, digit)
         integer, intent(in) :: k, digit
         type(component_place) :: place
         integer :: node

         node = model%node_table%find(card%nodes(k))
         if (node > 0) place = place_of_component(model, node, digit)
         place_of_rotation = place%node > 0 .and. has_component(card%directions(k), digit)
      end function place_of_rotation

   end subroutine check_directions

end module mean_build
