!> The card of the gaps, JGAP: one kind of card for five ways to say what the initial gap of a joint is.
module gap_cards
   use bulk_data, only: bulk_data_type, jgap_card
   use card_fields, only: card_values, decode_integer, decode_real
   use card_reader, only: card_reader_type
   use field_rules, only: blank_field, integer_field, real_field, word_field
   use kinds, only: wp
   implicit none
   private

   public :: read_jgap

   integer, parameter :: list_from = 9 ! the data field where the lists of TABLE and NODES begin: the first continuation

contains

   !> JGAP: the initial gap of a joint.
   subroutine read_jgap(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      integer :: i, k

      call cards%set_table([integer_field('JID'), word_field('KIND', '|CONST|PLANE|TABLE|NODES|TRUE|'), &
         real_field(['G0', 'SX', 'SY', 'CX', 'CY'], default=0.0_wp), blank_field('blank')], open_ended=.true.)
      allocate (bulk%jgap(cards%n))
      do i = 1, cards%n
         call cards%next(values)
         associate (jgap => bulk%jgap(i), reals => values%reals)
            jgap%line = cards%line
            jgap%joint = values%integers(1)
            jgap%kind = values%words(2)
            jgap%g0 = reals(3)
            jgap%slope = reals(4:5)
            jgap%crown = reals(6:7)
            allocate (jgap%node(0), jgap%gap(0), jgap%at(0), jgap%x(3, 0))
            if (.not. values%given(2)) call cards%error('KIND', 'blank, expected one of CONST, PLANE, TABLE, NODES, TRUE')
            if (cards%is_faulty()) cycle
            select case (jgap%kind)
            case ('CONST', 'PLANE')
               if (.not. values%given(3)) call cards%error('G0', 'blank, expected a real number')
               call check_blank(cards, merge(4, list_from, jgap%kind == 'CONST'))
            case ('TRUE')
               call check_blank(cards, 3)
            case default
               do k = 3, 7
                  if (values%given(k)) call no_entry(cards, k)
               end do
               if (jgap%kind == 'TABLE') call read_points(cards, jgap)
               if (jgap%kind == 'NODES') call read_nodes(cards, jgap)
            end select
         end associate
      end do
   end subroutine read_jgap

   !> From data field FIRST on the card must be blank.
   subroutine check_blank(cards, first)
      type(card_reader_type), intent(inout) :: cards
      integer, intent(in)                   :: first
      integer :: k

      do k = first, cards%card%n
         if (cards%card%fields(k)%length > 0) call no_entry(cards, k)
      end do
   end subroutine check_blank

   subroutine no_entry(cards, k)
      type(card_reader_type), intent(inout) :: cards
      integer, intent(in)                   :: k

      associate (card => cards%card)
         call card%field_error(k, ''''//trim(card%fields(k)%text)//''' where the field must be blank: '// &
                               trim(card%fields(2)%text)//' has no such field', cards%errors)
      end associate
   end subroutine no_entry

   !> The points of TABLE: X, Y, Z, G four by four; a coordinate left blank is zero, four blank fields are no point.
   subroutine read_points(cards, jgap)
      type(card_reader_type), intent(inout) :: cards
      type(jgap_card), intent(inout)        :: jgap
      integer, allocatable :: groups(:)
      integer :: d, i

      call list_groups(cards, 4, groups)
      deallocate (jgap%x, jgap%gap)
      allocate (jgap%x(3, size(groups)), jgap%gap(size(groups)))
      do i = 1, size(groups)
         associate (first => groups(i))
            do d = 1, 3
               call read_real(cards, first + d - 1, achar(iachar('X') + d - 1), 'a real number, or blank', .false., &
                              jgap%x(d, i))
            end do
            call read_real(cards, first + 3, 'G', 'the gap at the point, a real number', .true., jgap%gap(i))
         end associate
      end do
      jgap%at = groups
   end subroutine read_points

   !> The nodes of NODES: G1 and its gap, two by two; two blank fields are no node.
   subroutine read_nodes(cards, jgap)
      type(card_reader_type), intent(inout) :: cards
      type(jgap_card), intent(inout)        :: jgap
      character(*), parameter :: expected = 'the number of a node'
      integer, allocatable :: groups(:)
      integer :: i
      logical :: ok

      call list_groups(cards, 2, groups)
      deallocate (jgap%node, jgap%gap)
      allocate (jgap%node(size(groups)), source=0)
      allocate (jgap%gap(size(groups)))
      do i = 1, size(groups)
         associate (first => groups(i), card => cards%card)
            if (card%fields(first)%length == 0) then
               call card%field_error(first, 'G: blank, expected '//expected, cards%errors)
            else
               call decode_integer(card, first, 'G', expected, jgap%node(i), ok, cards%errors)
            end if
            call read_real(cards, first + 1, 'GAP', 'the gap there, a real number', .true., jgap%gap(i))
         end associate
      end do
      jgap%at = groups
   end subroutine read_nodes

   !> Where in the list of the card the GROUPS of so many fields begin that are not blank; there must be some.
   subroutine list_groups(cards, length, groups)
      type(card_reader_type), intent(inout) :: cards
      integer, intent(in)                   :: length
      integer, allocatable, intent(out)     :: groups(:)
      integer :: k

      associate (card => cards%card)
         groups = [(k, k = list_from, card%n, length)]
         groups = pack(groups, [(any(card%fields(k:min(k + length - 1, card%n))%length > 0), k = list_from, card%n, length)])
      end associate
      if (size(groups) == 0) call cards%card%field_error(2, 'KIND: '//trim(cards%card%fields(2)%text)// &
         ', but no list follows in continuation lines', cards%errors)
   end subroutine list_groups

   !> The real in data field K, NAME; blank it is zero, or an error where it is REQUIRED.
   subroutine read_real(cards, k, name, expected, required, value)
      type(card_reader_type), intent(inout) :: cards
      integer, intent(in)                   :: k
      character(*), intent(in)              :: name, expected
      logical, intent(in)                   :: required
      real(wp), intent(out)                 :: value
      logical :: is_blank, ok

      value = 0.0_wp
      is_blank = k > cards%card%n
      if (.not. is_blank) is_blank = cards%card%fields(k)%length == 0
      if (.not. is_blank) call decode_real(cards%card, k, name, expected, value, ok, cards%errors)
      if (is_blank .and. required) call cards%card%field_error(k, name//': blank, expected '//expected, cards%errors)
   end subroutine read_real

end module gap_cards
