!> The torsion of CROD and CONROD in space: G J/L between the rotations of their ends about the line between them.
!! The ends of a rod with J have rotations if a chain of such rods leads to a shell, a beam, a reference node or a MOMENT. Of a node
!! with rods alone the rotations that no rod twists are left out, as NASTRAN does by AUTOSPC.
module rod_torsion
   use deck_check, only: checked_deck
   use kinds, only: wp
   use model_data, only: a_spring, bar_type, model_type, n_bars, n_rotations, rotation_type
   use tolerances, only: zero_rotation_stiffness
   use unknowns, only: node_axes, rotation_at
   implicit none
   private

   public :: add_torsion, add_twisted, leave_out_untwisted

contains

   !> Append to ROTATIONS(:N) those of the nodes that have rotations because of rods with J.
   pure subroutine add_twisted(deck, model, rotations, n)
      type(checked_deck), intent(in)     :: deck
      type(model_type), intent(inout)    :: model
      type(rotation_type), intent(inout) :: rotations(:)
      integer, intent(inout)             :: n
      logical :: twisted(model%mesh%n_nodes)
      integer :: end, i

      twisted = twisted_nodes(deck, model, model%mesh%rotation_of > 0)
      do i = 1, n_bars(model)
         if (.not. model%mesh%bars(i)%torsion > 0.0_wp) cycle
         do end = 1, 2
            associate (node => model%mesh%bars(i)%nodes(end))
               if (.not. twisted(node) .or. model%mesh%rotation_of(node) > 0) cycle
               n = n + 1
               model%mesh%rotation_of(node) = n
               rotations(n) = rotation_type(point=node, of_element=.true., of_rods=.true., &
                  arm=norm2(model%mesh%x(:, model%mesh%bars(i)%nodes(2)) - model%mesh%x(:, model%mesh%bars(i)%nodes(1))))
            end associate
         end do
      end do
   end subroutine add_twisted

   !> The nodes that have rotations because of rods with J; HAS tells those that have rotations anyway.
   pure function twisted_nodes(deck, model, has) result(more)
      type(checked_deck), intent(in) :: deck
      type(model_type), intent(in)   :: model
      logical, intent(in)            :: has(:) !! (n_nodes)
      logical :: more(size(has)), reached(size(has))
      integer :: i, node
      logical :: goes_on

      more = .false.
      if (model%mesh%dimension == 2 .or. .not. any(model%mesh%bars%torsion > 0.0_wp)) return
      reached = has
      do i = 1, size(deck%bulk%force)
         if (.not. deck%bulk%force(i)%is_moment) cycle
         node = model%mesh%node_table%find(deck%bulk%force(i)%node)
         if (node > 0) reached(node) = .true.
      end do
      goes_on = .true.
      do while (goes_on)
         goes_on = .false.
         do i = 1, n_bars(model)
            associate (ends => model%mesh%bars(i)%nodes)
               if (.not. model%mesh%bars(i)%torsion > 0.0_wp) cycle
               if (.not. any(reached(ends)) .or. all(more(ends) .or. has(ends))) cycle
               reached(ends) = .true.
               more(ends) = .not. has(ends)
               goes_on = .true.
            end associate
         end do
      end do
   end function twisted_nodes

   !> Append a spring between the rotations of the ends of each rod with J.
   pure subroutine add_torsion(model)
      type(model_type), intent(inout) :: model
      type(bar_type), allocatable :: springs(:)
      integer :: end, i, k, n

      if (model%mesh%dimension == 2) return
      allocate (springs(count(model%mesh%bars%torsion > 0.0_wp)))
      n = 0
      do i = 1, n_bars(model)
         associate (bar => model%mesh%bars(i))
            if (.not. bar%torsion > 0.0_wp) cycle
            if (rotation_at(model, bar%nodes(1)) == 0 .or. rotation_at(model, bar%nodes(2)) == 0) cycle
            n = n + 1
            springs(n) = bar_type(id=bar%id, kind=a_spring, axis='R1', stiffness=bar%torsion, damping=bar%damping)
            do end = 1, 2
               k = rotation_at(model, bar%nodes(end))
               springs(n)%nodes(end) = model%mesh%rotations(k)%node
               springs(n)%direction(:, end) = bar%direction(:, end)/model%mesh%rotations(k)%arm
            end do
            model%freedoms%used(springs(n)%nodes) = .true.
         end associate
      end do
      model%mesh%bars = [model%mesh%bars, springs(:n)]
   end subroutine add_torsion

   !> Leave out the rotations of nodes of rods that no rod or spring twists: pivots of the stiffness of the rotations at the node,
   !! from the largest down, as far as they are not zero, remain.
   pure subroutine leave_out_untwisted(model)
      type(model_type), intent(inout) :: model
      real(wp) :: along(3), k(3, 3), scale
      integer  :: c, end, i, r
      logical  :: free(3)

      do r = 1, n_rotations(model)
         if (.not. model%mesh%rotations(r)%of_rods) cycle
         associate (node => model%mesh%rotations(r)%node)
            k = 0.0_wp
            do i = 1, n_bars(model)
               do end = 1, 2
                  if (model%mesh%bars(i)%nodes(end) /= node) cycle
                  along = matmul(model%mesh%bars(i)%direction(:, end), node_axes(model, model%mesh%rotations(r)%point))
                  k = k + model%mesh%bars(i)%stiffness*spread(along, 2, 3)*spread(along, 1, 3)
               end do
            end do
            scale = maxval([k(1, 1), k(2, 2), k(3, 3)])
            free = .not. model%freedoms%held(:, node)
            do while (any(free))
               c = maxloc([k(1, 1), k(2, 2), k(3, 3)], dim=1, mask=free)
               if (k(c, c) <= zero_rotation_stiffness*scale) exit
               free(c) = .false.
               k = k - spread(k(:, c), 2, 3)*spread(k(c, :), 1, 3)/k(c, c)
            end do
            if (.not. any(free)) cycle
            if (.not. allocated(model%freedoms%left_out)) allocate (model%freedoms%left_out(model%mesh%dimension, &
               model%mesh%n_nodes), source=.false.)
            model%freedoms%left_out(:, node) = model%freedoms%left_out(:, node) .or. free
            model%freedoms%held(:, node) = model%freedoms%held(:, node) .or. free
         end associate
      end do
   end subroutine leave_out_untwisted

end module rod_torsion
