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
      logical :: twisted(model%n_nodes)
      integer :: end, i

      twisted = twisted_nodes(deck, model, model%rotation_of > 0)
      do i = 1, n_bars(model)
         if (.not. model%bars(i)%torsion > 0.0_wp) cycle
         do end = 1, 2
            associate (node => model%bars(i)%nodes(end))
               if (.not. twisted(node) .or. model%rotation_of(node) > 0) cycle
               n = n + 1
               model%rotation_of(node) = n
               rotations(n) = rotation_type(point=node, of_element=.true., of_rods=.true., &
                  arm=norm2(model%x(:, model%bars(i)%nodes(2)) - model%x(:, model%bars(i)%nodes(1))))
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
      if (model%dimension == 2 .or. .not. any(model%bars%torsion > 0.0_wp)) return
      reached = has
      do i = 1, size(deck%bulk%force)
         if (.not. deck%bulk%force(i)%is_moment) cycle
         node = model%node_table%find(deck%bulk%force(i)%node)
         if (node > 0) reached(node) = .true.
      end do
      goes_on = .true.
      do while (goes_on)
         goes_on = .false.
         do i = 1, n_bars(model)
            associate (ends => model%bars(i)%nodes)
               if (.not. model%bars(i)%torsion > 0.0_wp) cycle
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

      if (model%dimension == 2) return
      allocate (springs(count(model%bars%torsion > 0.0_wp)))
      n = 0
      do i = 1, n_bars(model)
         associate (bar => model%bars(i))
            if (.not. bar%torsion > 0.0_wp) cycle
            if (rotation_at(model, bar%nodes(1)) == 0 .or. rotation_at(model, bar%nodes(2)) == 0) cycle
            n = n + 1
            springs(n) = bar_type(id=bar%id, kind=a_spring, axis='R1', stiffness=bar%torsion, damping=bar%damping)
            do end = 1, 2
               k = rotation_at(model, bar%nodes(end))
               springs(n)%nodes(end) = model%rotations(k)%node
               springs(n)%direction(:, end) = bar%direction(:, end)/model%rotations(k)%arm
            end do
            model%used(springs(n)%nodes) = .true.
         end associate
      end do
      model%bars = [model%bars, springs(:n)]
   end subroutine add_torsion

   !> Leave out the rotations of nodes of rods that no rod or spring twists: pivots of the stiffness of the rotations at the node,
   !! from the largest down, as far as they are not zero, remain.
   pure subroutine leave_out_untwisted(model)
      type(model_type), intent(inout) :: model
      real(wp) :: along(3), k(3, 3), scale
      integer  :: c, end, i, r
      logical  :: free(3)

      do r = 1, n_rotations(model)
         if (.not. model%rotations(r)%of_rods) cycle
         associate (node => model%rotations(r)%node)
            k = 0.0_wp
            do i = 1, n_bars(model)
               do end = 1, 2
                  if (model%bars(i)%nodes(end) /= node) cycle
                  along = matmul(model%bars(i)%direction(:, end), node_axes(model, model%rotations(r)%point))
                  k = k + model%bars(i)%stiffness*spread(along, 2, 3)*spread(along, 1, 3)
               end do
            end do
            scale = maxval([k(1, 1), k(2, 2), k(3, 3)])
            free = .not. model%held(:, node)
            do while (any(free))
               c = maxloc([k(1, 1), k(2, 2), k(3, 3)], dim=1, mask=free)
               if (k(c, c) <= zero_rotation_stiffness*scale) exit
               free(c) = .false.
               k = k - spread(k(:, c), 2, 3)*spread(k(c, :), 1, 3)/k(c, c)
            end do
            if (.not. any(free)) cycle
            if (.not. allocated(model%left_out)) allocate (model%left_out(model%dimension, model%n_nodes), source=.false.)
            model%left_out(:, node) = model%left_out(:, node) .or. free
            model%held(:, node) = model%held(:, node) .or. free
         end associate
      end do
   end subroutine leave_out_untwisted

end module rod_torsion
