!> Forces on single nodes: FORCE, FORCE1 and FORCE2 as vectors in global axes; MOMENT on the rotations of reference nodes.
module nodal_forces
   use bulk_data, only: force_card
   use deck_check, only: checked_deck
   use kinds, only: wp
   use load_checks, only: check_plane
   use model_data, only: model_type
   use reference_nodes, only: node_axes, rotation_at, rotation_component
   use system_build, only: to_global
   use text_tools, only: integer_text
   implicit none
   private

   public :: find_nodal_forces

contains

   !> FORCE(:, i) is that of card I in global axes on NODE(i) of the model, of a moment on the node of rotations [force]; zero where
   !! the card is in error.
   subroutine find_nodal_forces(deck, model, node, force)
      type(checked_deck), intent(in)     :: deck
      type(model_type), intent(in)       :: model
      integer, allocatable, intent(out)  :: node(:)     !! (cards)
      real(wp), allocatable, intent(out) :: force(:, :) !! (3, cards)
      integer :: i

      allocate (node(size(deck%bulk%force)), source=0)
      allocate (force(3, size(deck%bulk%force)), source=0.0_wp)
      do i = 1, size(deck%bulk%force)
         associate (card => deck%bulk%force(i))
            node(i) = model%node_table%find(card%node)
            force(:, i) = card%force
            if (card%ends(1) > 0) then
               call along_lines(deck, model, card, force(:, i))
            else if (node(i) > 0) then
               call to_global(deck, model%systems, card%line, card%system, model%x(:, node(i)), force(:, i))
            end if
            if (card%is_moment) then
               if (node(i) > 0) call onto_rotations(deck, model, card, node(i), force(:, i))
               cycle
            end if
            if (node(i) > 0) then
               if (.not. model%used(node(i))) call deck%field_error(card%line, 'G', 'node '//integer_text(card%node)// &
                                                                    ' belongs to no element')
               call check_felt(deck, model, card, node(i), node_axes(model, node(i)), force(:, i))
            end if
            call check_plane(deck, model, card%line, force(:, i), along=card%ends(1) > 0, turned=card%system > 0)
         end associate
      end do
   end subroutine find_nodal_forces

   !> A MOMENT acts on the rotations of NODE, which takes their node's place: FORCE becomes the moment by their arm.
   subroutine onto_rotations(deck, model, card, node, force)
      type(checked_deck), intent(in) :: deck
      type(model_type), intent(in)   :: model
      type(force_card), intent(in)   :: card
      integer, intent(inout)         :: node
      real(wp), intent(inout)        :: force(3) !! [moment], then [force]
      real(wp), parameter :: rounding = 1.0e-12_wp
      real(wp) :: axes(3, 3)
      integer  :: rotation

      rotation = rotation_at(model, node)
      if (rotation == 0) then
         call deck%field_error(card%line, 'G', 'node '//integer_text(card%node)//' has no rotations for a moment to act on; '// &
                               'expected the reference node of an RBE2, or of an RBE3 with rotations in REFC')
         force = 0.0_wp
         return
      end if
      axes = node_axes(model, node)
      node = model%rotations(rotation)%node
      force = force/model%rotations(rotation)%arm
      if (model%dimension == 2) then
         if (any(abs(force(:2)) > rounding*norm2(force))) call deck%field_error(card%line, 'N1', &
            'not zero, but in a plane model moments act about z: expected N3 alone')
         force = [force(3), 0.0_wp, 0.0_wp]
         axes = reshape([1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp], [3, 3])
      end if
      call check_felt(deck, model, card, node, axes, force)
   end subroutine onto_rotations

   !> A FORCE on NODE, a reference node, must move something: not act along a component that was left out and depends on nothing.
   subroutine check_felt(deck, model, card, node, axes, force)
      type(checked_deck), intent(in) :: deck
      type(model_type), intent(in)   :: model
      type(force_card), intent(in)   :: card
      integer, intent(in)            :: node
      real(wp), intent(in)           :: axes(3, 3), force(3)
      real(wp), parameter :: rounding = 1.0e-10_wp
      integer :: d, digit

      if (.not. allocated(model%left_out)) return
      do d = 1, model%dimension
         if (.not. is_idle(model, node, axes(:model%dimension, d)) .or. .not. model%left_out(d, node)) cycle
         if (abs(dot_product(axes(:, d), force)) <= rounding*norm2(force)) cycle
         digit = d
         if (card%is_moment) digit = findloc([(rotation_component(model, digit), digit = 1, 6)], d, dim=1)
         call deck%field_error(card%line, 'G', 'component '//integer_text(digit)//' of node '//integer_text(card%node)// &
                               ' moves nothing: no element, dependent node or support takes a load there')
         return
      end do
   end subroutine check_felt

   !> Whether NODE does not move along DIRECTION whatever the unknowns are.
   pure logical function is_idle(model, node, direction)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: node
      real(wp), intent(in)         :: direction(:)
      integer :: k

      is_idle = .true.
      if (.not. allocated(model%coupling%of_node)) return
      associate (coupling => model%coupling, c => model%coupling%of_node(node))
         if (c == 0) return
         do k = coupling%first(c), coupling%first(c + 1) - 1
            is_idle = is_idle .and. all(abs(matmul(direction, coupling%t(:, :, k))) <= 0.0_wp)
         end do
      end associate
   end function is_idle

   !> FORCE of a FORCE1, along a line between two nodes, or of a FORCE2, across two such lines.
   subroutine along_lines(deck, model, card, force)
      type(checked_deck), intent(in) :: deck
      type(model_type), intent(in)   :: model
      type(force_card), intent(in)   :: card
      real(wp), intent(inout)        :: force(3)
      real(wp) :: direction(3), line(3, 2)
      integer  :: k, nodes(4)

      force = 0.0_wp
      nodes = [(model%node_table%find(card%ends(k)), k = 1, 4)]
      if (any(nodes == 0 .and. (card%ends > 0 .or. card%ends(3) > 0)) .or. any(nodes(:2) == 0)) return
      do k = 1, merge(2, 1, nodes(3) > 0)
         line(:, k) = model%x(:, nodes(2*k)) - model%x(:, nodes(2*k - 1))
      end do
      direction = line(:, 1)
      if (nodes(3) > 0) direction = [line(2, 1)*line(3, 2) - line(3, 1)*line(2, 2), &
                                     line(3, 1)*line(1, 2) - line(1, 1)*line(3, 2), &
                                     line(1, 1)*line(2, 2) - line(2, 1)*line(1, 2)]
      if (norm2(direction) > 0.0_wp) then
         force = card%force(1)*direction/norm2(direction)
      else if (nodes(3) > 0) then
         call deck%field_error(card%line, 'G1', 'the lines G1-G2 and G3-G4 are parallel or have no length: the force has no '// &
                               'direction')
      else
         call deck%field_error(card%line, 'G1', 'G1 and G2 lie in one place: the force has no direction')
      end if
   end subroutine along_lines

end module nodal_forces
