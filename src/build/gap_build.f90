!> The initial gaps of the joints: from JGAP cards to the interface elements.
module gap_build
   use bulk_data, only: jgap_card
   use deck_check, only: checked_deck
   use gap_table, only: gap_table_type
   use interface_axes, only: joint_axes
   use interface_operator, only: at_first_end, joint_movement, nodes_of_end
   use kinds, only: wp
   use model_data, only: joint_centroid, joint_type, model_type
   use text_tools, only: integer_text
   implicit none
   private

   public :: build_gaps

   real(wp), parameter :: rounding = 1.0e-12_wp ! of the coordinates: what two faces are apart by less, they touch

contains

   !> Give the interface elements of MODEL their gaps.
   subroutine build_gaps(deck, model)
      type(checked_deck), intent(in)  :: deck
      type(model_type), intent(inout) :: model
      integer :: i, j

      do i = 1, size(deck%bulk%jgap)
         associate (card => deck%bulk%jgap(i))
            if (card%joint == 0) cycle ! a field that could not be read
            j = findloc(model%joints%id, card%joint, dim=1)
            if (j == 0) then
               call deck%field_error(card%line, 'JID', 'there is no joint '//integer_text(card%joint))
               cycle
            end if
            model%joints(j)%gap_kind = card%kind
            select case (card%kind)
            case ('CONST')
               model%interface(model%joints(j)%first:model%joints(j)%last)%gap = card%g0
            case ('PLANE', 'TABLE')
               call gaps_by_place(deck, card, model%joints(j), model)
            case ('NODES')
               call gaps_by_node(deck, card, model%joints(j), model)
            case ('TRUE')
               call true_gaps(deck, card, model%joints(j), model)
            end select
         end associate
      end do
   end subroutine build_gaps

   !> PLANE and TABLE: the gap follows from where in the joint an element is, x and y in the axes of the mean normal.
   subroutine gaps_by_place(deck, card, joint, model)
      type(checked_deck), intent(in)  :: deck
      type(jgap_card), intent(in)     :: card
      type(joint_type), intent(in)    :: joint
      type(model_type), intent(inout) :: model
      type(gap_table_type) :: table
      real(wp) :: axes(3, 3), centroid(3), place(2)
      integer  :: i
      logical  :: ok

      if (joint%last < joint%first) return ! said elsewhere
      if (norm2(joint%normal) <= 0.0_wp) then
         call deck%field_error(card%line, 'KIND', trim(card%kind)//', but the normals of joint '//integer_text(joint%id)// &
                               ' point all round, and it has no plane: expected CONST, NODES or TRUE')
         return
      end if
      axes = joint_axes(model, joint%normal)
      centroid = joint_centroid(model, joint)
      if (model%axisymmetric) centroid(1) = 0.0_wp ! that of rings lies on the axis
      ok = .true.
      if (card%kind == 'TABLE') call start_table(deck, card, axes, centroid, model%dimension == 2, table, ok)
      if (card%kind == 'PLANE' .and. model%dimension == 2) call check_no_y(deck, card)
      if (.not. ok) return
      do i = joint%first, joint%last
         associate (element => model%interface(i))
            place = matmul(at_first_end(element, model%x) - centroid, axes(:, :2))
            if (card%kind == 'TABLE') then
               element%gap = table%value_at(place)
            else
               element%gap = card%g0 + sum(card%slope*place + card%crown*place**2)
            end if
         end associate
      end do
      associate (gaps => model%interface(joint%first:joint%last)%gap)
         where (abs(gaps) <= rounding*maxval(abs(gaps))) gaps = 0.0_wp
      end associate
   end subroutine gaps_by_place

   !> A joint in the plane has no y.
   subroutine check_no_y(deck, card)
      type(checked_deck), intent(in) :: deck
      type(jgap_card), intent(in)    :: card
      character(*), parameter :: words = 'not zero, but a joint of a plane model has x alone'

      if (abs(card%slope(2)) > 0.0_wp) call deck%field_error(card%line, 'SY', words)
      if (abs(card%crown(2)) > 0.0_wp) call deck%field_error(card%line, 'CY', words)
   end subroutine check_no_y

   !> The points of a TABLE in the plane of the joint; not OK where two are at one place there.
   subroutine start_table(deck, card, axes, centroid, is_plane, table, ok)
      type(checked_deck), intent(in)      :: deck
      type(jgap_card), intent(in)         :: card
      real(wp), intent(in)                :: axes(3, 3), centroid(3)
      logical, intent(in)                 :: is_plane !! x alone counts
      type(gap_table_type), intent(inout) :: table
      logical, intent(out)                :: ok
      real(wp) :: x(2, size(card%gap))
      integer  :: twice(2)

      ok = size(card%gap) > 0
      if (.not. ok) return ! said where the card is read
      x = matmul(transpose(axes(:, :2)), card%x - spread(centroid, 2, size(card%gap)))
      if (is_plane) x(2, :) = 0.0_wp
      call table%build(x, card%gap, twice)
      ok = twice(1) == 0
      if (.not. ok) call deck%field_error(card%line, card%at(twice(2)), 'point '//integer_text(twice(2))// &
         ' of the table is, seen along the normal of the joint, at the same place as point '//integer_text(twice(1)), called='X')
   end subroutine start_table

   !> NODES: by node of SIDE1, zero where none is given. An element that hangs on several has their mean. A node on which none hangs, as
   !! a corner of a flat face of six nodes, is on SIDE1 all the same.
   subroutine gaps_by_node(deck, card, joint, model)
      type(checked_deck), intent(in)  :: deck
      type(jgap_card), intent(in)     :: card
      type(joint_type), intent(in)    :: joint
      type(model_type), intent(inout) :: model
      real(wp), allocatable :: gap(:, :)
      integer, allocatable  :: given_at(:) ! 0: not on SIDE1, -1: not given
      integer :: i, node
      character(:), allocatable :: words

      allocate (gap(1, model%n_nodes), source=0.0_wp)
      allocate (given_at(model%n_nodes), source=0)
      do i = joint%first, joint%last
         given_at(nodes_of_end(model%interface(i), 1)) = -1
      end do
      if (joint%side_1 > 0) then
         associate (side => model%surfaces(joint%side_1))
            do i = 1, side%n
               given_at(side%nodes(:side%n_nodes(i), i)) = -1
            end do
         end associate
      end if
      do i = 1, size(card%node)
         if (card%node(i) == 0) cycle
         words = ''
         node = model%node_table%find(card%node(i))
         if (node == 0) then
            words = 'there is no GRID '//integer_text(card%node(i))
         else if (given_at(node) == 0) then
            words = 'node '//integer_text(card%node(i))//' is not on SIDE1 of joint '//integer_text(joint%id)
         else if (given_at(node) > 0) then
            words = 'node '//integer_text(card%node(i))//' is given twice'
         else
            given_at(node) = i
            gap(1, node) = card%gap(i)
         end if
         if (words /= '' .and. joint%last >= joint%first) call deck%field_error(card%line, card%at(i), words, called='G')
      end do
      do i = joint%first, joint%last
         model%interface(i)%gap = sum(at_first_end(model%interface(i), gap))
      end do
   end subroutine gaps_by_node

   !> TRUE: the distance of the faces in the mesh along the normal, from end 1 to end 2.
   subroutine true_gaps(deck, card, joint, model)
      type(checked_deck), intent(in)  :: deck
      type(jgap_card), intent(in)     :: card
      type(joint_type), intent(in)    :: joint
      type(model_type), intent(inout) :: model
      real(wp) :: closing(3)
      integer  :: i

      do i = joint%first, joint%last
         associate (element => model%interface(i))
            if (size(nodes_of_end(element, 2)) == 0) then
               call deck%field_error(card%line, 'KIND', 'TRUE, but joint '//integer_text(joint%id)// &
                                     ' stands on a rigid base, which has no place: expected CONST, PLANE, TABLE or NODES')
               return
            end if
            closing = joint_movement(element, model%x)
            element%gap = 0.0_wp
            if (abs(closing(3)) > rounding*maxval(abs(model%x(:, element%node)))) element%gap = -closing(3)
         end associate
      end do
   end subroutine true_gaps

end module gap_build
