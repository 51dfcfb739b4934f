!> Interface elements that CJOINT cards give one by one.
module cjoint_build
   use deck_check, only: checked_deck
   use id_table, only: id_table_type
   use interface_axes, only: joint_axes, outward
   use kinds, only: wp
   use model_data, only: interface_element, model_type
   use node_build, only: find_nodes
   implicit none
   private

   public :: list_groups, cjoint_elements, group_number

contains

   !> CJOINT cards with the same PJOINT make up one joint, numbered as the PJOINT: GROUP(i) is that of card i, in the order in
   !! which they come.
   pure subroutine list_groups(deck, group, n_groups)
      type(checked_deck), intent(in)    :: deck
      integer, allocatable, intent(out) :: group(:) !! (n_cjoint)
      integer, intent(out)              :: n_groups
      type(id_table_type) :: laws
      integer :: first, i

      associate (law => deck%bulk%cjoint%law)
         call laws%build(law)
         allocate (group(size(law)))
         n_groups = 0
         do i = 1, size(law)
            first = laws%find(law(i))
            if (first == i) n_groups = n_groups + 1
            group(i) = n_groups
            if (first < i) group(i) = group(first)
         end do
      end associate
   end subroutine list_groups


   !> The interface elements of the CJOINT cards MEMBERS.
   subroutine cjoint_elements(deck, members, model, elements)
      type(checked_deck), intent(in)                    :: deck
      integer, intent(in)                               :: members(:)
      type(model_type), intent(in)                      :: model
      type(interface_element), allocatable, intent(out) :: elements(:)
      integer :: k

      allocate (elements(size(members)))
      do k = 1, size(members)
         associate (card => deck%bulk%cjoint(members(k)), element => elements(k))
            element%id = card%id
            element%area = card%area
            call find_nodes(deck, card%line, card%nodes, model, element%nodes)
            if (model%dimension == 2 .and. abs(card%normal(3)) > 0.0_wp) &
               call deck%field_error(card%line, 'NZ', 'not zero, but a plane model lies in x-y')
            if (norm2(card%normal) > 0.0_wp) &
               element%axes = joint_axes(model, outward(model, element%nodes, card%normal/norm2(card%normal)))
         end associate
      end do
   end subroutine cjoint_elements


   !> The number of a group of CJOINTs: that of its PJOINT, or where a JOINT has it already, the next that is free.
   pure integer function group_number(deck, joints, law) result(number)
      type(checked_deck), intent(in)  :: deck
      type(id_table_type), intent(in) :: joints !! of the JOINT cards, by their ids
      integer, intent(in)             :: law

      number = law
      if (joints%find(law) == 0) return
      number = law + max(maxval(deck%bulk%joint%id), maxval(deck%bulk%pjoint%id))
   end function group_number

end module cjoint_build
