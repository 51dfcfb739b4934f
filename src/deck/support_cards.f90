!> The cards of supports: SPC, SPC1, SPCM, their sum SPCADD (MPCADD sums up equations likewise), and SPCD, which moves them. A routine for each array of the bulk data,
!! a table for each kind.
module support_cards
   use bulk_data, only: bulk_data_type, displacement_card, support_card, set_sum_card
   use card_lines, only: card_values, decode_integer
   use card_reader, only: card_reader_type
   use field_rules, only: component_field, integer_field, real_field
   use kinds, only: wp
   use text_tools, only: integer_text
   implicit none
   private

   public :: read_support, read_support_sum, read_equation_sum, read_displacement

contains

   !> SPC: one or two nodes held in the components C at the displacement D. SPC1: components C of the
   !! nodes G1, G2, ..., or G1 THRU G2. SPCM: components C of all nodes of the marked surface PID.
   subroutine read_support(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      integer :: field, i, n

      call cards%set_table([integer_field('SID'), integer_field('G1'), component_field('C1'), real_field('D1', default=0.0_wp), &
         integer_field('G2', default=0), component_field('C2', default=0), real_field('D2', default=0.0_wp)], 'SPC')
      call cards%set_table([integer_field('SID'), component_field('C')], 'SPC1', open_ended=.true.)
      call cards%set_table([integer_field('SID'), component_field('C'), integer_field('PID')], 'SPCM')
      allocate (bulk%support(2*cards%n))
      n = 0
      do i = 1, cards%n
         call cards%next(values)
         n = n + 1
         associate (line => cards%line, integers => values%integers, given => values%given)
            select case (cards%card%name)
            case ('SPC')
               if ((given(5) .neqv. given(6)) .or. (given(7) .and. .not. given(5))) &
                  call cards%error('G2', 'node, components C2 and displacement D2 go together')
               do field = 2, merge(5, 2, given(5)), 3
                  n = n + merge(1, 0, field > 2)
                  bulk%support(n) = support_card(line=line, set=integers(1), components=integers(field + 1), &
                                                 value=values%reals(field + 2), first=integers(field:field), &
                                                 last=integers(field:field), at=[field])
               end do
            case ('SPC1')
               bulk%support(n) = support_card(line=line, set=integers(1), components=integers(2))
               call list_nodes(cards, bulk%support(n))
            case default
               bulk%support(n) = support_card(line=line, set=integers(1), components=integers(2), surface=integers(3))
               allocate (bulk%support(n)%first(0), bulk%support(n)%last(0), bulk%support(n)%at(0))
            end select
         end associate
      end do
      bulk%support = bulk%support(:n)
   end subroutine read_support

   !> The nodes of an SPC1, from data field 3 on.
   subroutine list_nodes(cards, support)
      type(card_reader_type), intent(inout) :: cards
      type(support_card), intent(inout)     :: support
      integer :: k, n, node
      logical :: ok, through

      associate (card => cards%card)
         allocate (support%first(card%n), support%last(card%n), support%at(card%n), source=0)
         n = 0
         through = .false.
         do k = 3, card%n
            if (card%fields(k)%text == '') cycle
            if (card%fields(k)%text == 'THRU') then
               if (n == 0 .or. through .or. k == card%n) call card%field_error(k, 'THRU: expected G1 THRU G2', cards%errors)
               through = .true.
               cycle
            end if
            call decode_integer(card, k, 'G', 'a node number or THRU', node, ok, cards%errors)
            if (.not. ok) cycle
            if (node < 1) call card%field_error(k, 'G: '''//integer_text(node)//''' is no node number', cards%errors)
            if (through) then
               through = .false.
               if (n == 0) cycle
               support%last(n) = node
               if (node < support%first(n)) call card%field_error(k, 'G: THRU goes down, expected '// &
                                                                  integer_text(support%first(n))//' or more', cards%errors)
            else
               n = n + 1
               support%first(n) = node
               support%last(n) = node
               support%at(n) = k
            end if
         end do
         if (n == 0 .and. card%n < 3) call card%field_error(3, 'G1: blank, expected a node number', cards%errors)
      end associate
      support%first = support%first(:n)
      support%last = support%last(:n)
      support%at = support%at(:n)
   end subroutine list_nodes

   !> SPCADD: the supports of all sets S1, S2, ...
   subroutine read_support_sum(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk

      call read_sums(cards, 'a support set', bulk%support_sum)
   end subroutine read_support_sum

   !> MPCADD: the equations of all sets S1, S2, ...
   subroutine read_equation_sum(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk

      call read_sums(cards, 'a set of equations', bulk%equation_sum)
   end subroutine read_equation_sum

   !> Cards that sum up sets S1, S2, ..., each the number of A_SET.
   subroutine read_sums(cards, a_set, sums)
      type(card_reader_type), intent(inout) :: cards
      character(*), intent(in)              :: a_set
      type(set_sum_card), allocatable, intent(out) :: sums(:)
      type(card_values) :: values
      integer :: i, k, set
      logical :: ok

      call cards%set_table(integer_field(['SID', 'S1 ']), open_ended=.true.)
      allocate (sums(cards%n))
      do i = 1, cards%n
         call cards%next(values)
         associate (total => sums(i), card => cards%card)
            total%line = cards%line
            total%set = values%integers(1)
            total%sets = values%integers(2:2)
            total%at = [2]
            do k = 3, card%n
               if (card%fields(k)%length == 0) cycle
               call decode_integer(card, k, 'S', 'the number of '//a_set, set, ok, cards%errors)
               if (ok .and. set < 1) call card%field_error(k, 'S: '''//integer_text(set)// &
                  ''' is out of range, expected the number of '//a_set//', 1 or more', cards%errors)
               total%sets = [total%sets, set]
               total%at = [total%at, k]
            end do
         end associate
      end do
   end subroutine read_sums

   !> SPCD: displacements of held components, in a load set: the total at the end of the stage, as for forces.
   subroutine read_displacement(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      integer :: field, i, n

      call cards%set_table([integer_field('SID'), integer_field('G1'), component_field('C1'), real_field('D1'), &
         integer_field('G2', default=0), component_field('C2', default=0), real_field('D2', default=0.0_wp)])
      allocate (bulk%displacement(2*cards%n))
      n = 0
      do i = 1, cards%n
         call cards%next(values)
         if (any(values%given(5:7)) .and. .not. all(values%given(5:6))) &
            call cards%error('G2', 'node, components C2 and displacement D2 go together')
         do field = 2, merge(5, 2, values%given(5)), 3
            n = n + 1
            bulk%displacement(n) = displacement_card(line=cards%line, set=values%integers(1), field=field, &
               node=values%integers(field), components=values%integers(field + 1), value=values%reals(field + 2))
         end do
      end do
      bulk%displacement = bulk%displacement(:n)
   end subroutine read_displacement

end module support_cards
