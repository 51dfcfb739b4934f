!> The torsion of CROD and CONROD in space: G J/L between the rotations of their ends about the line between them.
!! The ends of a rod with J have rotations if a chain of such rods leads to a shell, a beam, a reference node or a MOMENT. Of a node
!! with rods alone the rotations that no rod twists are left out, as NASTRAN does by AUTOSPC.
module rod_torsion
   use deck_check, only: checked_deck
   use kinds, only: wp
   use mesh_queries, only: n_rotations, open_left_out
   use model_data, only: a_spring, bar_type, freedoms_type, mesh_type, n_bars, rotation_type
   use tolerances, only: zero_rotation_stiffness
   use unknowns, only: node_axes, rotation_at
   implicit none
   private

   public :: add_torsion, add_twisted, leave_out_untwisted

contains

   !> Append to ROTATIONS(:N) those of the nodes that have rotations because of rods with J.
   pure subroutine add_twisted(deck, mesh, rotations, n)
      type(checked_deck), intent(in)     :: deck
      type(mesh_type), intent(inout) :: mesh
      type(rotation_type), intent(inout) :: rotations(:)
      integer, intent(inout)             :: n
      logical :: twisted(mesh%n_nodes)
      integer :: end, i

      twisted = twisted_nodes(deck, mesh, mesh%rotation_of > 0)
      do i = 1, n_bars(mesh)
         if (.not. mesh%bars(i)%torsion > 0.0_wp) cycle
         do end = 1, 2
            associate (node => mesh%bars(i)%nodes(end))
               if (.not. twisted(node) .or. mesh%rotation_of(node) > 0) cycle
               n = n + 1
               mesh%rotation_of(node) = n
               rotations(n) = rotation_type(point=node, of_element=.true., of_rods=.true., &
                  arm=norm2(mesh%x(:, mesh%bars(i)%nodes(2)) - mesh%x(:, mesh%bars(i)%nodes(1))))
            end associate
         end do
      end do
   end subroutine add_twisted

   !> The nodes that have rotations because of rods with J; HAS tells those that have rotations anyway.
   pure function twisted_nodes(deck, mesh, has) result(more)
      type(checked_deck), intent(in) :: deck
      type(mesh_type), intent(in) :: mesh
      logical, intent(in)            :: has(:) !! (n_nodes)
      logical :: more(size(has)), reached(size(has))
      integer :: i, node
      logical :: goes_on

      more = .false.
      if (mesh%dimension == 2 .or. .not. any(mesh%bars%torsion > 0.0_wp)) return
      reached = has
      do i = 1, size(deck%bulk%force)
         if (.not. deck%bulk%force(i)%is_moment) cycle
         node = mesh%node_table%find(deck%bulk%force(i)%node)
         if (node > 0) reached(node) = .true.
      end do
      goes_on = .true.
      do while (goes_on)
         goes_on = .false.
         do i = 1, n_bars(mesh)
            associate (ends => mesh%bars(i)%nodes)
               if (.not. mesh%bars(i)%torsion > 0.0_wp) cycle
               if (.not. any(reached(ends)) .or. all(more(ends) .or. has(ends))) cycle
               reached(ends) = .true.
               more(ends) = .not. has(ends)
               goes_on = .true.
            end associate
         end do
      end do
   end function twisted_nodes

   !> Append a spring between the rotations of the ends of each rod with J.
   pure subroutine add_torsion(mesh)
      type(mesh_type), intent(inout) :: mesh
      type(bar_type), allocatable :: springs(:)
      integer :: end, i, k, n

      if (mesh%dimension == 2) return
      allocate (springs(count(mesh%bars%torsion > 0.0_wp)))
      n = 0
      do i = 1, n_bars(mesh)
         associate (bar => mesh%bars(i))
            if (.not. bar%torsion > 0.0_wp) cycle
            if (rotation_at(mesh, bar%nodes(1)) == 0 .or. rotation_at(mesh, bar%nodes(2)) == 0) cycle
            n = n + 1
            springs(n) = bar_type(id=bar%id, kind=a_spring, axis='R1', stiffness=bar%torsion, damping=bar%damping)
            do end = 1, 2
               k = rotation_at(mesh, bar%nodes(end))
               springs(n)%nodes(end) = mesh%rotations(k)%node
               springs(n)%direction(:, end) = bar%direction(:, end)/mesh%rotations(k)%arm
            end do
         end associate
      end do
      mesh%bars = [mesh%bars, springs(:n)]
   end subroutine add_torsion

   !> Leave out the rotations of nodes of rods that no rod or spring twists: pivots of the stiffness of the rotations at the node,
   !! from the largest down, as far as they are not zero, remain.
   pure subroutine leave_out_untwisted(mesh, freedoms)
      type(mesh_type), intent(in) :: mesh
      type(freedoms_type), intent(inout) :: freedoms
      real(wp) :: along(3), k(3, 3), scale
      integer  :: c, end, i, r
      logical  :: free(3)

      do r = 1, n_rotations(mesh)
         if (.not. mesh%rotations(r)%of_rods) cycle
         associate (node => mesh%rotations(r)%node)
            k = 0.0_wp
            do i = 1, n_bars(mesh)
               do end = 1, 2
                  if (mesh%bars(i)%nodes(end) /= node) cycle
                  along = matmul(mesh%bars(i)%direction(:, end), node_axes(mesh, mesh%rotations(r)%point))
                  k = k + mesh%bars(i)%stiffness*spread(along, 2, 3)*spread(along, 1, 3)
               end do
            end do
            scale = maxval([k(1, 1), k(2, 2), k(3, 3)])
            free = .not. freedoms%held(:, node)
            do while (any(free))
               c = maxloc([k(1, 1), k(2, 2), k(3, 3)], dim=1, mask=free)
               if (k(c, c) <= zero_rotation_stiffness*scale) exit
               free(c) = .false.
               k = k - spread(k(:, c), 2, 3)*spread(k(c, :), 1, 3)/k(c, c)
            end do
            if (.not. any(free)) cycle
            call open_left_out(mesh, freedoms)
            freedoms%left_out(:, node) = freedoms%left_out(:, node) .or. free
            freedoms%held(:, node) = freedoms%held(:, node) .or. free
         end associate
      end do
   end subroutine leave_out_untwisted

end module rod_torsion
