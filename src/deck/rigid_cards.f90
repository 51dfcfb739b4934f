!> The cards of dependent nodes: RBE2 (nodes that move with one as a rigid body), RBE3 (one that moves as the weighted mean of others),
!! MPC (an equation between components).
module rigid_cards
   use bulk_data, only: bulk_data_type, equation_card, rigid_card
   use card_fields, only: card_values, decode_integer, decode_real
   use card_reader, only: card_reader_type
   use deck_numbers, only: parse_integer
   use field_rules, only: blank_field, component_field, in_range, integer_field, real_field
   use kinds, only: wp
   use text_tools, only: integer_text
   implicit none
   private

   public :: read_rigid, read_equation

   character(*), parameter :: a_node = 'a node number', components = 'a list of components, different digits of 1 to 6'

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
            else
               last = cards%card%n
               if (last > 4) call take_expansion(cards, last)
               call read_list(cards, 4, last, rigid%components, 1.0_wp, rigid)
            end if
         end associate
      end do
   end subroutine read_rigid

   !> ALPHA of an RBE2, a real behind the last node: rigid elements do not grow with their temperature, zero is no error. LAST is the
   !! field before it.
   subroutine take_expansion(cards, last)
      type(card_reader_type), intent(inout) :: cards
      integer, intent(inout)                :: last

      associate (field => cards%card%fields(last))
         if (.not. is_real(field%text)) return
         call check_expansion(cards, last)
         last = last - 1
      end associate
   end subroutine take_expansion

   !> Data field K holds the coefficient of thermal expansion of a rigid element, which must be zero.
   subroutine check_expansion(cards, k)
      type(card_reader_type), intent(inout) :: cards
      integer, intent(in)                   :: k
      real(wp) :: alpha
      logical  :: ok

      call decode_real(cards%card, k, 'ALPHA', 'blank or zero', alpha, ok, cards%errors)
      if (ok .and. abs(alpha) > 0.0_wp) call cards%card%field_error(k, 'ALPHA: not zero, but rigid elements do not grow with '// &
         'their temperature; expected blank or zero', cards%errors)
   end subroutine check_expansion

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
            call read_tail(cards, last)
            return
         end if
         call decode_real(cards%card, last, 'WT', 'a weight, a real number above 0', this_weight, ok, cards%errors)
         if (ok .and. this_weight <= 0.0_wp) call cards%card%field_error(last, 'WT: '''// &
            trim(cards%card%fields(last)%text)//''' is out of range, expected a weight, a real number above 0', cards%errors)
         call read_components(cards, last + 1, these)
         first = last + 2
         if (first > cards%card%n) call cards%card%field_error(first, 'G: blank, expected '//a_node, cards%errors)
      end do
   end subroutine read_groups

   !> What stands behind the groups, from the word in data field K on: ALPHA and its value.
   subroutine read_tail(cards, k)
      type(card_reader_type), intent(inout) :: cards
      integer, intent(in)                   :: k

      associate (card => cards%card)
         if (card%fields(k)%text == 'ALPHA' .and. k < card%n) then
            call check_expansion(cards, k + 1)
         else if (card%fields(k)%text == 'UM') then
            call card%field_error(k, 'UM: the components REFC of the reference node are the dependent ones here; expected no UM', &
                                  cards%errors)
         else
            call card%field_error(k, ''''//trim(card%fields(k)%text)//''', expected '//a_node//', a weight or ALPHA', cards%errors)
         end if
      end associate
   end subroutine read_tail

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

   !> The components in data field K.
   subroutine read_components(cards, k, components_here)
      type(card_reader_type), intent(inout) :: cards
      integer, intent(in)                   :: k
      integer, intent(out)                  :: components_here
      logical :: ok

      components_here = 0
      ok = k <= cards%card%n
      if (ok) ok = cards%card%fields(k)%length > 0
      if (.not. ok) then
         call cards%card%field_error(k, 'C: blank, expected '//components, cards%errors)
         return
      end if
      call decode_integer(cards%card, k, 'C', components, components_here, ok, cards%errors)
      if (ok .and. .not. in_range(component_field('C'), real(components_here, wp))) then
         call cards%card%field_error(k, 'C: '''//trim(cards%card%fields(k)%text)//''' is out of range, expected '//components, &
                                     cards%errors)
         components_here = 0
      end if
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
         call read_component(cards, k + 1, component)
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

   !> The one component in data field K.
   subroutine read_component(cards, k, component)
      type(card_reader_type), intent(inout) :: cards
      integer, intent(in)                   :: k
      integer, intent(out)                  :: component
      character(*), parameter :: expected = 'a component, 1 to 6'
      logical :: ok

      component = 0
      ok = k <= cards%card%n
      if (ok) ok = cards%card%fields(k)%length > 0
      if (.not. ok) then
         call cards%card%field_error(k, 'C: blank, expected '//expected, cards%errors)
         return
      end if
      call decode_integer(cards%card, k, 'C', expected, component, ok, cards%errors)
      if (.not. ok .or. (component >= 1 .and. component <= 6)) return
      call cards%card%field_error(k, 'C: '''//integer_text(component)//''' is out of range, expected '//expected, cards%errors)
      component = 0
   end subroutine read_component

end module rigid_cards
