!> The cards of dependent nodes: RBE2 (nodes that move with one as a rigid body), RBE3 (one that moves as the weighted mean of others),
!! MPC (an equation between components).
module rigid_cards
   use bulk_data, only: bulk_data_type, equation_card, has_component, rigid_card
   use card_lines, only: card_values, decode_integer, decode_real
   use card_reader, only: card_reader_type
   use field_rules, only: parse_integer, blank_field, component_field, expectation, field_rule, in_range, integer_field, &
                          real_field
   use kinds, only: wp
   use text_tools, only: integer_text
   implicit none
   private

   public :: read_rigid, read_equation

   character(*), parameter :: a_node = 'a node number'

contains

   !> RBE2: the components CM of the nodes GM move with node GN as a rigid body. RBE3: the components REFC of node REFGRID are the
   !! weighted mean of the components C of the nodes G, group by group, each with its weight.
   subroutine read_rigid(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      integer :: i, last

      call cards%set_table([integer_field('EID'), integer_field('GN'), component_field('CM'), integer_field('GM1')], 'RBE2', &
                           open_ended=.true.)
      call cards%set_table([integer_field('EID'), blank_field('-'), integer_field('REFGRID'), component_field('REFC'), &
         real_field('WT1', above=0.0_wp), component_field('C1'), integer_field('G1,1')], 'RBE3', open_ended=.true.)
      allocate (bulk%rigid(cards%n))
      do i = 1, cards%n
         call cards%next(values)
         associate (rigid => bulk%rigid(i), integers => values%integers)
            rigid%line = cards%line
            rigid%id = integers(1)
            rigid%is_mean = cards%card%name == 'RBE3'
            rigid%node = integers(merge(3, 2, rigid%is_mean))
            rigid%components = integers(merge(4, 3, rigid%is_mean))
            allocate (rigid%nodes(0), rigid%at(0), rigid%directions(0), rigid%weight(0))
            if (rigid%is_mean) then
               call read_groups(cards, values%reals(5), integers(6), rigid)
               if (any(has_component(rigid%directions, 4) .or. has_component(rigid%directions, 5) .or. &
                       has_component(rigid%directions, 6))) call bulk%idle%add('456 in C of RBE3')
            else
               last = cards%card%n
               if (last > 4) call take_expansion(cards, last, rigid)
               call read_list(cards, 4, last, rigid%components, 1.0_wp, rigid)
            end if
         end associate
      end do
   end subroutine read_rigid

   !> ALPHA of an RBE2, a real behind the last node, or the first of two, the other TREF. LAST is the field before it.
   subroutine take_expansion(cards, last, rigid)
      type(card_reader_type), intent(inout) :: cards
      integer, intent(inout)                :: last
      type(rigid_card), intent(inout)       :: rigid
      integer :: first

      associate (fields => cards%card%fields)
         if (.not. is_real(fields(last)%text)) return
         first = merge(last - 1, last, is_real(fields(last - 1)%text))
      end associate
      call read_expansion(cards, first, last, rigid)
      last = first - 1
   end subroutine take_expansion

   !> ALPHA in data field K, and TREF behind it where that is not behind field LAST.
   subroutine read_expansion(cards, k, last, rigid)
      type(card_reader_type), intent(inout) :: cards
      integer, intent(in)                   :: k, last
      type(rigid_card), intent(inout)       :: rigid
      real(wp) :: reference
      logical  :: ok

      call decode_real(cards%card, k, 'ALPHA', 'a real number', rigid%alpha, ok, cards%errors)
      if (.not. ok) rigid%alpha = 0.0_wp
      rigid%alpha_at = k
      if (k < last) call decode_real(cards%card, k + 1, 'TREF', 'a real number', reference, ok, cards%errors)
   end subroutine read_expansion

   !> The groups of an RBE3 from data field 5 on: WEIGHT, DIRECTIONS and the nodes of the first one, which is decoded so far; behind
   !! its nodes a real begins the next one.
   subroutine read_groups(cards, weight, directions, rigid)
      type(card_reader_type), intent(inout) :: cards
      real(wp), intent(in)                  :: weight
      integer, intent(in)                   :: directions
      type(rigid_card), intent(inout)       :: rigid
      real(wp) :: this_weight
      integer  :: first, last, these
      logical  :: ok

      first = 7
      this_weight = weight
      these = directions
      do
         last = first
         do while (last <= cards%card%n)
            if (is_word(cards%card%fields(last)%text) .or. is_real(cards%card%fields(last)%text)) exit
            last = last + 1
         end do
         call read_list(cards, first, last - 1, these, this_weight, rigid)
         if (last > cards%card%n) return
         if (is_word(cards%card%fields(last)%text)) then
            call read_tail(cards, last, rigid)
            return
         end if
         call decode_real(cards%card, last, 'WT', 'a weight, a real number above 0', this_weight, ok, cards%errors)
         if (ok .and. this_weight <= 0.0_wp) call cards%card%field_error(last, 'WT: '''// &
            trim(cards%card%fields(last)%text)//''' is out of range, expected a weight, a real number above 0', cards%errors)
         call read_components(cards, last + 1, component_field('C'), these)
         first = last + 2
         if (first > cards%card%n) call cards%card%field_error(first, 'G: blank, expected '//a_node, cards%errors)
      end do
   end subroutine read_groups

   !> What stands behind the groups, from the word in data field K on: UM and pairs of a node and its components, ALPHA and its value,
   !! and perhaps TREF.
   subroutine read_tail(cards, k, rigid)
      type(card_reader_type), intent(inout) :: cards
      integer, intent(in)                   :: k
      type(rigid_card), intent(inout)       :: rigid
      integer :: at

      at = k
      associate (card => cards%card)
         do while (at <= card%n)
            if (card%fields(at)%text == 'UM' .and. .not. allocated(rigid%um_nodes)) then
               call read_dependent(cards, at, rigid)
            else if (card%fields(at)%text == 'ALPHA' .and. at < card%n .and. rigid%alpha_at == 0) then
               call read_expansion(cards, at + 1, card%n, rigid)
               return
            else
               call card%field_error(at, ''''//trim(card%fields(at)%text)//''', expected '//a_node//', a weight, UM or ALPHA', &
                                     cards%errors)
               return
            end if
         end do
      end associate
   end subroutine read_tail

   !> The pairs behind UM in data field AT, which is left at the next word, or behind the card.
   subroutine read_dependent(cards, at, rigid)
      type(card_reader_type), intent(inout) :: cards
      integer, intent(inout)                :: at
      type(rigid_card), intent(inout)       :: rigid
      integer :: components, node
      logical :: ok

      allocate (rigid%um_nodes(0), rigid%um_components(0), rigid%um_at(0))
      associate (card => cards%card)
         do
            at = at + 1
            if (at > card%n) exit
            if (card%fields(at)%length == 0) cycle
            if (is_word(card%fields(at)%text)) exit
            call decode_integer(card, at, 'G', a_node, node, ok, cards%errors)
            call read_components(cards, at + 1, component_field('C'), components)
            if (ok) then
               rigid%um_nodes = [rigid%um_nodes, node]
               rigid%um_components = [rigid%um_components, components]
               rigid%um_at = [rigid%um_at, at]
            end if
            at = at + 1
         end do
      end associate
   end subroutine read_dependent

   !> Whether TEXT is a word, a letter first.
   pure logical function is_word(text)
      character(*), intent(in) :: text

      is_word = text(1:1) >= 'A' .and. text(1:1) <= 'Z'
   end function is_word

   !> Whether TEXT is no integer but has the point of a real number.
   pure logical function is_real(text)
      character(*), intent(in) :: text
      integer :: number
      logical :: ok

      call parse_integer(text, number, ok)
      is_real = .not. ok .and. index(text, '.') > 0
   end function is_real

   !> The components in data field K, by RULE.
   subroutine read_components(cards, k, rule, components)
      type(card_reader_type), intent(inout) :: cards
      integer, intent(in)                   :: k
      type(field_rule), intent(in)          :: rule
      integer, intent(out)                  :: components
      logical :: ok

      components = 0
      ok = k <= cards%card%n
      if (ok) ok = cards%card%fields(k)%length > 0
      if (.not. ok) then
         call cards%card%field_error(k, 'C: blank, expected '//expectation(rule), cards%errors)
         return
      end if
      call decode_integer(cards%card, k, 'C', expectation(rule), components, ok, cards%errors)
      if (.not. ok .or. in_range(rule, real(components, wp))) return
      call cards%card%field_error(k, 'C: '''//trim(cards%card%fields(k)%text)//''' is out of range, expected '// &
                                  expectation(rule), cards%errors)
      components = 0
   end subroutine read_components

   !> The nodes in the data fields FIRST to LAST, all with the same DIRECTIONS and WEIGHT, behind those that RIGID has.
   subroutine read_list(cards, first, last, directions, weight, rigid)
      type(card_reader_type), intent(inout) :: cards
      integer, intent(in)                   :: first, last, directions
      real(wp), intent(in)                  :: weight
      type(rigid_card), intent(inout)       :: rigid
      integer :: k, node(first:max(first, last)), at(first:max(first, last))
      logical :: ok

      at = 0
      associate (card => cards%card)
         do k = first, last
            if (card%fields(k)%length == 0) cycle
            call decode_integer(card, k, 'G', a_node, node(k), ok, cards%errors)
            if (ok .and. node(k) < 1) call card%field_error(k, 'G: '''//integer_text(node(k))//''' is no node number', cards%errors)
            if (ok .and. node(k) > 0) at(k) = k
         end do
      end associate
      rigid%nodes = [rigid%nodes, pack(node, at > 0)]
      rigid%at = [rigid%at, pack(at, at > 0)]
      rigid%directions = [rigid%directions, spread(directions, 1, count(at > 0))]
      rigid%weight = [rigid%weight, spread(weight, 1, count(at > 0))]
   end subroutine read_list

   !> MPC: the sum of A times component C of node G is zero; the first term is the dependent one.
   subroutine read_equation(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      integer :: i, k

      call cards%set_table([integer_field(['SID', 'G1 ']), integer_field('C1', most=6), real_field('A1'), integer_field('G2'), &
                            integer_field('C2', most=6), real_field('A2')], open_ended=.true.)
      allocate (bulk%equation(cards%n))
      do i = 1, cards%n
         call cards%next(values)
         associate (equation => bulk%equation(i), card => cards%card)
            equation%line = cards%line
            equation%set = values%integers(1)
            equation%node = values%integers([2, 5])
            equation%component = values%integers([3, 6])
            equation%factor = values%reals([4, 7])
            equation%at = [2, 5]
            if (values%ok .and. abs(equation%factor(1)) <= 0.0_wp) call cards%error('A1', 'zero, but the first term is the '// &
                                                                                    'dependent one')
            do k = 8, card%n
               if (modulo(k, 8) == 2 .or. modulo(k, 8) == 5) then
                  call read_term(cards, k, equation)
               else if (modulo(k, 8) <= 1 .and. card%fields(k)%length > 0) then
                  call card%field_error(k, ''''//trim(card%fields(k)%text)//''' where the field must be blank', cards%errors)
               end if
            end do
         end associate
      end do
   end subroutine read_equation

   !> The term in the data fields K to K + 2, where there is one.
   subroutine read_term(cards, k, equation)
      type(card_reader_type), intent(inout) :: cards
      integer, intent(in)                   :: k
      type(equation_card), intent(inout)    :: equation
      real(wp) :: factor
      integer  :: component, node
      logical  :: ok

      associate (card => cards%card)
         if (all(card%fields(k:min(k + 2, card%n))%length == 0)) return
         if (card%fields(k)%length == 0) then
            call card%field_error(k, 'G: blank, expected '//a_node, cards%errors)
            return
         end if
         call decode_integer(card, k, 'G', a_node, node, ok, cards%errors)
         call read_components(cards, k + 1, integer_field('C', most=6), component)
         ok = k + 2 <= card%n
         if (ok) ok = card%fields(k + 2)%length > 0
         if (ok) then
            call decode_real(card, k + 2, 'A', 'a real number', factor, ok, cards%errors)
         else
            call card%field_error(k + 2, 'A: blank, expected a real number', cards%errors)
            factor = 0.0_wp
         end if
      end associate
      equation%node = [equation%node, node]
      equation%component = [equation%component, component]
      equation%factor = [equation%factor, factor]
      equation%at = [equation%at, k]
   end subroutine read_term

end module rigid_cards
