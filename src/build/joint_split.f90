!> A joint on one shared surface: where bodies lie on both sides of a marked surface and share its nodes, the nodes are
!! doubled, so that interface elements can stand between them.
module joint_split
   use deck_check, only: checked_deck
   use id_table, only: id_table_type
   use kinds, only: wp
   use model_data, only: model_type
   use node_build, only: append_nodes
   use reverse_lists, only: list_owners
   use surface_sides, only: elements_behind, face_one_way, list_sides, nodes_of, side_list
   use text_tools, only: integer_text
   implicit none
   private

   public :: split_shared_surfaces

   !> Some elements.
   type :: element_list
      integer, allocatable :: element(:)
   end type element_list

contains

   !> Split the shared surfaces that JOINT cards name as SIDE1 without a SIDE2. The elements on the left of the
   !! surface's edges, or inside its faces, keep the nodes; those behind get the twins, numbered from the highest node number on.
   subroutine split_shared_surfaces(deck, model)
      type(checked_deck), intent(in)  :: deck
      type(model_type), intent(inout) :: model
      type(id_table_type)  :: surfaces
      integer :: j, n_twins, node, s

      allocate (model%twin(model%n_nodes), source=0)
      call surfaces%build(model%surfaces%id)
      n_twins = 0
      do j = 1, size(deck%bulk%joint)
         if (deck%bulk%joint(j)%sides(2) /= 0) cycle
         s = surfaces%find(deck%bulk%joint(j)%sides(1))
         if (s == 0) cycle
         associate (surface => model%surfaces(s), line => deck%bulk%joint(j)%line, nodes => nodes_of(model%surfaces(s)))
            if (.not. any(surface%other(:surface%n) > 0)) cycle
            if (any(surface%other(:surface%n) == 0)) then
               call deck%field_error(line, 'SIDE1', 'bodies lie on both sides of some '//merge('edges', 'faces', &
                  model%dimension == 2)//' of surface '//integer_text(surface%id)//' and on one side of others')
               cycle
            end if
            if (any(model%twin(nodes) > 0)) then
               node = nodes(findloc(model%twin(nodes) > 0, .true., dim=1))
               call deck%field_error(line, 'SIDE1', 'surface '//integer_text(surface%id)//' meets another surface that is '// &
                  'split, at node '//integer_text(model%node_id(node))//': mesh the bodies apart there and give both '// &
                  'faces, SIDE1 and SIDE2')
               cycle
            end if
         end associate
         call split_surface(model, s, n_twins)
      end do
      if (n_twins == 0) return
      if (model%node_id(model%n_nodes) > huge(1) - n_twins) call deck%errors%add(0, 'the nodes that stand double where '// &
         'surfaces are split are numbered behind node '//integer_text(model%node_id(model%n_nodes))// &
         ', and their numbers would pass 2147483647')
      call add_twins(model, n_twins)
      call list_owners(model%n_nodes, model%element_nodes, model%first_at, model%elements_at)
      call move_other_surfaces(model)
   end subroutine split_shared_surfaces

   !> Give the elements behind surface S twins of its nodes, behind the N_TWINS that there are. They are no nodes of the model yet.
   subroutine split_surface(model, s, n_twins)
      type(model_type), intent(inout) :: model
      integer, intent(in)             :: s
      integer, intent(inout)          :: n_twins
      type(side_list) :: at
      type(element_list), allocatable :: behind(:)
      integer :: i, k

      call list_sides(model%surfaces(s), at)
      call face_one_way(model%surfaces(s), at)
      allocate (behind(at%n))
      do k = 1, at%n                          ! the whole nodes are needed until all is known
         call elements_behind(model, s, at, k, behind(k)%element)
      end do
      do k = 1, at%n
         if (size(behind(k)%element) == 0) cycle ! the surface ends inside a body here: the tip stays whole
         n_twins = n_twins + 1
         model%twin(at%node(k)) = model%n_nodes + n_twins
         do i = 1, size(behind(k)%element)
            associate (nodes => model%element_nodes(:, behind(k)%element(i)))
               where (nodes == at%node(k)) nodes = model%n_nodes + n_twins
            end associate
         end do
      end do
      model%surfaces(s)%other = 0
      model%surfaces(s)%was_split = .true.
   end subroutine split_surface

   !> Append the twins to the nodes of the model.
   subroutine add_twins(model, n_twins)
      type(model_type), intent(inout) :: model
      integer, intent(in)             :: n_twins
      real(wp), allocatable :: x(:, :)
      integer :: k

      allocate (x(3, n_twins))
      do k = 1, model%n_nodes
         if (model%twin(k) > 0) x(:, model%twin(k) - model%n_nodes) = model%x(:, k)
      end do
      call append_nodes(model, x)
      model%twin = [model%twin, (0, k = 1, n_twins)]
   end subroutine add_twins

   !> Sides of the surfaces that were not split follow their elements.
   pure subroutine move_other_surfaces(model)
      type(model_type), intent(inout) :: model
      integer :: i, k, s, twin

      do s = 1, size(model%surfaces)
         if (model%surfaces(s)%was_split) cycle
         associate (surface => model%surfaces(s))
            do i = 1, surface%n
               do k = 1, surface%n_nodes(i)
                  twin = model%twin(surface%nodes(k, i))
                  if (twin == 0) cycle
                  if (any(model%element_nodes(:, surface%element(i)) == twin)) surface%nodes(k, i) = twin
               end do
            end do
         end associate
      end do
   end subroutine move_other_surfaces

end module joint_split
