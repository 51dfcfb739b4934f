!> Interface elements: between two facing surfaces, between a surface and a rigid base, or given outright.
module joint_build
   use cjoint_build, only: cjoint_elements, group_number, list_groups
   use deck_cards, only: add_field_error
   use deck_errors, only: deck_error_list
   use deck_input, only: deck_type
   use facing_nodes, only: pair_nodes
   use id_table, only: id_table_type
   use interface_axes, only: joint_axes
   use kinds, only: wp
   use interface_operator, only: hang_on, interface_element
   use law_build, only: default_slope, law_tables, list_laws, resolve_laws
   use model_data, only: joint_type, model_type
   use reverse_lists, only: list_owners
   use surface_build, only: surface_node_list, surface_nodes
   use text_tools, only: integer_text
   implicit none
   private

   public :: build_joints

   !> Where what the JOINT cards name stands.
   type :: joint_tables
      type(id_table_type) :: joint   !! the JOINT cards
      type(id_table_type) :: side    !! the sides of the JOINT cards, those of card j at 2 j - 1 and 2 j
      type(id_table_type) :: surface !! the surfaces of the model
      type(law_tables)    :: laws
   end type joint_tables

contains

   !> Fill the joints and interface elements of MODEL.
   subroutine build_joints(deck, model, errors)
      type(deck_type), intent(in)          :: deck
      type(model_type), intent(inout)      :: model
      type(deck_error_list), intent(inout) :: errors
      type(interface_element), allocatable :: elements(:)
      type(joint_tables)   :: tables
      integer, allocatable :: first(:), group(:), members(:)
      integer :: g, highest, j, n, n_groups

      associate (bulk => deck%bulk, cards => deck%bulk%joint(:deck%bulk%n_joint))
         call tables%joint%build(cards%id)
         call tables%side%build([(cards(j)%sides, j = 1, size(cards))])
         call tables%surface%build(model%surfaces%id)
         call list_laws(deck, tables%laws)
         call list_groups(deck, group, n_groups)
         allocate (model%joints(size(cards) + n_groups), model%interface(0))
         highest = 0
         if (bulk%n_cjoint > 0) highest = maxval(bulk%cjoint(:bulk%n_cjoint)%id)
         n = 0
         do j = 1, size(cards)
            call joint_elements(deck, tables, j, model, highest, elements, errors)
            call add_elements(model, n, j, cards(j)%id, cards(j)%line, elements)
            call resolve_laws(deck, tables%laws, cards(j)%law, model%joints(j), errors)
         end do
         call list_owners(n_groups, reshape(group, [1, size(group)]), first, members)
         do g = 1, n_groups
            j = size(cards) + g
            call cjoint_elements(deck, members(first(g):first(g + 1) - 1), model, elements, errors)
            associate (card => bulk%cjoint(members(first(g))))
               call add_elements(model, n, j, group_number(deck, tables%joint, card%law), card%line, elements)
               call resolve_laws(deck, tables%laws, card%law, model%joints(j), errors)
            end associate
         end do
      end associate
      model%interface = model%interface(:n)
      do j = 1, size(model%joints)
         call sum_joint(model, model%joints(j))
         call default_slope(model, model%joints(j), errors)
      end do
   end subroutine build_joints


   !> Put the interface elements of joint J behind the first N of the model's, which may have room for more.
   subroutine add_elements(model, n, j, id, line, elements)
      type(model_type), intent(inout)         :: model
      integer, intent(inout)                  :: n
      integer, intent(in)                     :: j, id, line
      type(interface_element), intent(inout)  :: elements(:)
      type(interface_element), allocatable    :: longer(:)

      model%joints(j)%id = id
      model%joints(j)%line = line
      model%joints(j)%first = n + 1
      model%joints(j)%last = n + size(elements)
      elements%joint = j
      if (model%joints(j)%last > size(model%interface)) then
         allocate (longer(2*model%joints(j)%last))
         longer(:n) = model%interface(:n)
         call move_alloc(longer, model%interface)
      end if
      model%interface(n + 1:model%joints(j)%last) = elements
      n = model%joints(j)%last
   end subroutine add_elements


   !> Interface elements of JOINT card J, numbered from HIGHEST + 1.
   subroutine joint_elements(deck, tables, j, model, highest, elements, errors)
      type(deck_type), intent(in)          :: deck
      type(joint_tables), intent(in)       :: tables
      integer, intent(in)                  :: j
      type(model_type), intent(in)         :: model
      integer, intent(inout)               :: highest
      type(interface_element), allocatable, intent(out) :: elements(:)
      type(deck_error_list), intent(inout) :: errors
      type(surface_node_list) :: side1, side2
      integer, allocatable :: partner(:)
      integer :: surface(2), k

      allocate (elements(0))
      associate (card => deck%bulk%joint(j))
         surface = 0
         do k = 1, 2
            if (card%sides(k) == 0) cycle
            surface(k) = tables%surface%find(card%sides(k))
            if (surface(k) == 0) call add_field_error(deck%text, card%line, k + 2, 'SIDE'//integer_text(k), &
               'there is no PMARK '//integer_text(card%sides(k)), errors)
         end do
         k = j
         if (card%sides(1) > 0) k = min(k, (tables%side%find(card%sides(1)) + 1)/2)
         if (card%sides(2) > 0) k = min(k, (tables%side%find(card%sides(2)) + 1)/2)
         if (k < j) call add_field_error(deck%text, card%line, 3, 'SIDE1', 'one of the sides is a side of JOINT '// &
                                         integer_text(deck%bulk%joint(k)%id)//' already', errors)
         if (surface(1) == 0 .or. (surface(2) == 0 .and. card%sides(2) > 0)) return
         if (model%surfaces(surface(1))%n == 0) return
         if (surface(2) > 0) then
            if (model%surfaces(surface(2))%n == 0) return
            if (any(model%surfaces(surface(2))%other(:model%surfaces(surface(2))%n) > 0)) then
               call add_field_error(deck%text, card%line, 4, 'SIDE2', 'bodies lie on both sides of surface '// &
                  integer_text(card%sides(2)), errors)
               return
            end if
         end if
         if (surface(2) > 0 .and. any(model%surfaces(surface(1))%other(:model%surfaces(surface(1))%n) > 0)) then
            call add_field_error(deck%text, card%line, 3, 'SIDE1', 'bodies lie on both sides of surface '// &
               integer_text(card%sides(1))//': leave SIDE2 blank, and the program splits it', errors)
            return
         end if
         call surface_nodes(model, model%surfaces(surface(1)), side1)
         allocate (partner(side1%n), source=0)
         if (surface(2) > 0) then
            call surface_nodes(model, model%surfaces(surface(2)), side2)
            call pair_nodes(deck, j, model, surface(1), side1, side2, partner, errors)
         else if (any(model%twin(side1%node) > 0)) then
            call drop_tips(model, side1)
            partner = model%twin(side1%node)
         end if
      end associate
      if (model%axisymmetric .and. any(side1%area <= 0.0_wp)) then
         call errors%add(deck%bulk%joint(j)%line, 'surface '//integer_text(deck%bulk%joint(j)%sides(1))// &
            ' has no area at node '//integer_text(model%node_id(side1%node(minloc(side1%area, dim=1))))//': it lies on the axis')
         return
      end if
      if (highest > huge(highest) - side1%n) then
         call add_field_error(deck%text, deck%bulk%joint(j)%line, 1, 'JID', 'the numbers of its interface '// &
            'elements, which follow those of the CJOINTs, would pass 2147483647', errors)
         return
      end if
      deallocate (elements)
      allocate (elements(side1%n))
      do k = 1, side1%n
         elements(k)%id = highest + k
         call hang_on(elements(k), side1%node(k), partner(k))
         elements(k)%area = side1%area(k)
         elements(k)%axes = joint_axes(model, side1%normal(:, k))
      end do
      highest = highest + side1%n
   end subroutine joint_elements


   !> Leave out the nodes at which a split surface ends inside a body.
   pure subroutine drop_tips(model, side)
      type(model_type), intent(in)           :: model
      type(surface_node_list), intent(inout) :: side
      integer :: k, n

      n = 0
      do k = 1, side%n
         if (model%twin(side%node(k)) == 0) cycle
         n = n + 1
         side%node(n) = side%node(k)
         side%area(n) = side%area(k)
         side%normal(:, n) = side%normal(:, k)
      end do
      side%n = n
      side%node = side%node(:n)
      side%area = side%area(:n)
      side%normal = side%normal(:, :n)
   end subroutine drop_tips


   !> Area and mean normal of a joint.
   pure subroutine sum_joint(model, joint)
      type(model_type), intent(in)    :: model
      type(joint_type), intent(inout) :: joint
      integer :: i

      joint%area = 0.0_wp
      joint%normal = 0.0_wp
      do i = joint%first, joint%last
         joint%area = joint%area + model%interface(i)%area
         joint%normal = joint%normal + model%interface(i)%area*model%interface(i)%axes(:, 3)
      end do
      if (norm2(joint%normal) > 1.0e-6_wp*joint%area) then
         joint%normal = joint%normal/norm2(joint%normal)
      else
         joint%normal = 0.0_wp
      end if
   end subroutine sum_joint

end module joint_build
