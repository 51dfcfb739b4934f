!> Which nodes have rotations: the reference nodes of RBE2, and those of RBE3 whose rotations the card asks for. A model of revolution
!! has none: a ring that stays one moves along its axis alone.
module rotation_build
   use bulk_data, only: has_component, rigid_card
   use deck_check, only: checked_deck
   use extra_nodes, only: append_node
   use kinds, only: wp
   use model_data, only: model_type, rotation_type
   use reference_nodes, only: rotation_at
   implicit none
   private

   public :: build_rotations

contains

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

end module rotation_build
