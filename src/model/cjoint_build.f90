!> Interface elements that CJOINT cards give one by one.
module cjoint_build
   use deck_cards, only: add_field_error
   use deck_errors, only: deck_error_list
   use deck_input, only: deck_type
   use id_table, only: id_table_type
   use interface_axes, only: joint_axes, outward
   use kinds, only: wp
   use interface_operator, only: hang_on, interface_element
   use model_data, only: model_type
   use text_tools, only: integer_text
   implicit none
   private

   public :: list_groups, cjoint_elements, group_number

contains

   !> CJOINT cards with the same PJOINT make up one joint, numbered as the PJOINT: GROUP(i) is that of card i, in the order in
   !! which they come.
   pure subroutine list_groups(deck, group, n_groups)
      type(deck_type), intent(in)       :: deck
      integer, allocatable, intent(out) :: group(:) !! (n_cjoint)
      integer, intent(out)              :: n_groups
      type(id_table_type) :: laws
      integer :: first, i

      associate (law => deck%bulk%cjoint(:deck%bulk%n_cjoint)%law)
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
   subroutine cjoint_elements(deck, members, model, elements, errors)
      type(deck_type), intent(in)          :: deck
      integer, intent(in)                  :: members(:)
      type(model_type), intent(in)         :: model
      type(interface_element), allocatable, intent(out) :: elements(:)
      type(deck_error_list), intent(inout) :: errors
      integer :: k, node, nodes(2)

      allocate (elements(size(members)))
      do k = 1, size(members)
         associate (card => deck%bulk%cjoint(members(k)), element => elements(k))
            element%id = card%id
            element%area = card%area
            nodes = 0
            do node = 1, 2
               if (card%nodes(node) == 0) cycle
               nodes(node) = model%node_table%find(card%nodes(node))
               if (nodes(node) == 0) call add_field_error(deck%text, card%line, node + 2, 'node G'// &
                  integer_text(node), 'there is no GRID '//integer_text(card%nodes(node)), errors)
            end do
            call hang_on(element, nodes(1), nodes(2))
            if (model%dimension == 2 .and. abs(card%normal(3)) > 0.0_wp) call add_field_error(deck%text, card%line, 8, 'NZ', &
               'not zero, but a plane model lies in x-y', errors)
            if (norm2(card%normal) > 0.0_wp) &
               element%axes = joint_axes(model, outward(model, nodes, card%normal/norm2(card%normal)))
         end associate
      end do
   end subroutine cjoint_elements


   !> The number of a group of CJOINTs: that of its PJOINT, or where a JOINT has it already, the next that is free.
   pure integer function group_number(deck, joints, law) result(number)
      type(deck_type), intent(in)     :: deck
      type(id_table_type), intent(in) :: joints !! of the JOINT cards, by their ids
      integer, intent(in)             :: law

      number = law
      if (joints%find(law) == 0) return
      number = law + max(maxval(deck%bulk%joint(:deck%bulk%n_joint)%id), maxval(deck%bulk%pjoint(:deck%bulk%n_pjoint)%id))
   end function group_number

end module cjoint_build
