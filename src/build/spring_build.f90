!> Springs: CELAS1, CELAS2 and CBUSH as bars of the model, one a direction, behind the bars themselves.
module spring_build
   use bulk_data, only: spring_card
   use coordinate_systems, only: directions_at
   use deck_check, only: checked_deck
   use kinds, only: wp
   use model_data, only: bar_type, model_type
   use node_build, only: find_nodes
   use system_build, only: find_system
   use text_tools, only: integer_text
   implicit none
   private

   public :: build_springs

   character(2), parameter :: axis_names(3) = ['T1', 'T2', 'T3']

contains

   !> Append the springs to the bars of MODEL.
   subroutine build_springs(deck, model)
      type(checked_deck), intent(in)  :: deck
      type(model_type), intent(inout) :: model
      type(bar_type), allocatable :: bars(:)
      integer :: i, n

      associate (cards => deck%bulk%spring, laws => deck%bulk%spring_property)
         call deck%report_repeated('PELAS', pack(laws%id, .not. laws%is_bush), pack(laws%line, .not. laws%is_bush))
         call deck%report_repeated('PBUSH', pack(laws%id, laws%is_bush), pack(laws%line, laws%is_bush))
         if (size(cards) == 0) return
         n = size(model%bars)
         allocate (bars(n + 3*size(cards)))
         bars(:n) = model%bars
         do i = 1, size(cards)
            call build_spring(deck, cards(i), model, bars, n)
         end do
      end associate
      model%bars = bars(:n)
   end subroutine build_springs

   !> The springs of one CARD, behind the first N of BARS.
   subroutine build_spring(deck, card, model, bars, n)
      type(checked_deck), intent(in)  :: deck
      type(spring_card), intent(in)   :: card
      type(model_type), intent(inout) :: model
      type(bar_type), intent(inout)   :: bars(:)
      integer, intent(inout)          :: n
      real(wp) :: stiffness(3), damping, directions(3, 3)
      integer  :: k, nodes(2)
      logical  :: ok

      call find_stiffness(deck, card, stiffness, damping)
      if (card%is_bush) then
         call find_nodes(deck, card%line, card%nodes, model, nodes)
         call find_axes(deck, card, model, nodes, stiffness, directions, ok)
         if (.not. ok) return
         do k = 1, 3
            if (stiffness(k) <= 0.0_wp) cycle
            call add(axis_names(k), stiffness(k), spread(directions(:, k), 2, 2))
         end do
      else
         do k = 1, 2
            call find_nodes(deck, card%line, card%nodes(k:k), model, nodes(k:k), first=2*k + 1)
            directions(:, k) = 0.0_wp
            if (nodes(k) == 0) cycle
            if (card%components(k) == 3 .and. model%dimension == 2) call deck%field_error(card%line, 'C'//integer_text(k), &
               'a plane model has no component 3')
            if (card%components(k) < 1 .or. card%components(k) > model%dimension) return ! said
            directions(:, k) = direction_of(model, nodes(k), card%components(k))
         end do
         k = merge(1, 2, card%nodes(1) > 0) ! the first node that is not the ground
         if (any(nodes == 0 .and. card%nodes > 0) .or. all(card%nodes == 0)) return
         if (k == 1) directions(:, :2) = -directions(:, :2) ! NASTRAN's force is k (u_1 - u_2)
         if (k == 2) nodes = nodes([2, 1])
         if (k == 2) directions(:, 1) = directions(:, 2)
         call add(axis_names(card%components(k)), stiffness(1), directions(:, :2))
         bars(n)%ground_first = k == 2
      end if

   contains

      subroutine add(axis, k_axis, along)
         character(2), intent(in) :: axis
         real(wp), intent(in)     :: k_axis, along(3, 2)

         n = n + 1
         bars(n)%id = card%id
         bars(n)%nodes = nodes
         bars(n)%axis = axis
         bars(n)%stiffness = k_axis
         bars(n)%damping = damping
         bars(n)%direction = along
         model%used(pack(nodes, nodes > 0)) = .true.
      end subroutine add

   end subroutine build_spring

   !> The stiffness of the spring of CARD, the first one of a CELAS, and its structural damping.
   subroutine find_stiffness(deck, card, stiffness, damping)
      type(checked_deck), intent(in) :: deck
      type(spring_card), intent(in)  :: card
      real(wp), intent(out)          :: stiffness(3) !! [force/length]
      real(wp), intent(out)          :: damping      !! [-]
      integer :: k

      stiffness = [card%stiffness, 0.0_wp, 0.0_wp]
      damping = card%damping
      if (card%property == 0) return
      associate (laws => deck%bulk%spring_property)
         k = findloc(laws%id == card%property .and. (laws%is_bush .eqv. card%is_bush), .true., dim=1)
         if (k > 0) then
            stiffness = laws(k)%stiffness
            damping = laws(k)%damping
         else
            call deck%field_error(card%line, 'PID', 'there is no '//trim(merge('PBUSH', 'PELAS', card%is_bush))//' '// &
                                  integer_text(card%property))
         end if
      end associate
   end subroutine find_stiffness

   !> The axes of a CBUSH at its first node: of its system; without one, along the line between its nodes where it has K1 alone, and
   !! global where they stand in one place.
   subroutine find_axes(deck, card, model, nodes, stiffness, directions, ok)
      type(checked_deck), intent(in) :: deck
      type(spring_card), intent(in)  :: card
      type(model_type), intent(in)   :: model
      integer, intent(in)            :: nodes(2)
      real(wp), intent(in)           :: stiffness(3)
      real(wp), intent(out)          :: directions(3, 3) !! columns, unit
      logical, intent(out)           :: ok
      integer :: system

      directions = reshape([1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp], [3, 3])
      ok = nodes(1) > 0 .and. (nodes(2) > 0 .or. card%nodes(2) == 0)
      if (.not. ok) return
      if (card%system > 0) then
         call find_system(deck, card%line, 'CID', card%system, model%systems, system)
         ok = system > 0
         if (.not. ok) return
         call directions_at(model%systems(system), model%x(:, nodes(1)), directions, ok)
         if (.not. ok) call deck%field_error(card%line, 'CID', 'GA lies on the axis of system '//integer_text(card%system)// &
                                             ', where its first two directions are not defined')
      else if (card%system < 0 .and. nodes(2) > 0) then
         associate (along => model%x(:, nodes(2)) - model%x(:, nodes(1)))
            if (norm2(along) <= 0.0_wp) return
            ok = all(stiffness(2:) <= 0.0_wp)
            if (ok) directions(:, 1) = along/norm2(along)
            if (.not. ok) call deck%field_error(card%line, 'CID', 'blank, but GA and GB stand apart and there is more than '// &
               'K1; expected the system of its axes, 0 for global axes')
         end associate
      end if
   end subroutine find_axes

   !> Direction of COMPONENT of a node: global, or of its displacement system CD.
   pure function direction_of(model, node, component) result(direction)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: node, component
      real(wp) :: direction(3)
      logical  :: is_turned

      direction = 0.0_wp
      is_turned = allocated(model%node_system)
      if (is_turned) is_turned = model%node_system(node) > 0
      if (is_turned) then
         associate (coupling => model%coupling)
            direction(:model%dimension) = coupling%t(:, component, coupling%first(coupling%of_node(node)))
         end associate
      else
         direction(component) = 1.0_wp
      end if
   end function direction_of

end module spring_build
