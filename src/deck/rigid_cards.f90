!> Reads the cards of dependent nodes: RBE1, RBE2, RBE3, RBAR, RROD, SHELLTO, MPC and NODEAT.
!! RBE2: nodes that move with one node as a rigid body. RBE3: a node that moves as the weighted mean of others. Both list their nodes
!! or name a marked surface. MPC: a constraint equation between components. NODEAT: a node given by its place.
module rigid_cards
   use bulk_data, only: bulk_data_type, rigid_card
   use card_fields, only: card_fields_type
   use field_rules, only: at_least_1, component_words, has_component, parse_integer, positive
   use kinds, only: wp
   use text_tools, only: integer_text, one_of
   implicit none
   private

   public :: read_rigid, read_place, read_tie, read_equation

   character(*), parameter :: a_node = 'a node number'

contains

   !> RBE2: the components CM of the nodes GM move with node GN as a rigid body. RBE3: the components REFC of node REFGRID are the
   !! weighted mean of the components C of the nodes G, group by group, each with its weight. RBE2M, RBE3M: the same with the nodes
   !! of surface PID; without GN or REFGRID the reference node is a new node.
   subroutine read_rigid(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      integer  :: directions, first, last, node
      real(wp) :: weight

      select case (card%name)
      case ('RBAR')
         call read_rigid_bar(card, bulk%rigid(card%i))
         return
      case ('RBE1')
         call read_rigid_body(card, bulk%rigid(card%i))
         return
      case ('RROD')
         call read_rigid_rod(card, bulk%rigid(card%i))
         return
      end select
      associate (rigid => bulk%rigid(card%i))
         rigid%line = card%line
         rigid%is_mean = card%name(:4) == 'RBE3'
         allocate (rigid%nodes(0), rigid%at(0), rigid%directions(0), rigid%weight(0))
         call card%field('EID', rigid%id)
         select case (card%name)
         case ('RBE3')
            rigid%node_at = 3
            rigid%components_at = 4
            call card%blank(['-'])
            call card%field('REFGRID', rigid%node)
            call card%components('REFC', rigid%components)
            call card%field('WT1', weight, positive)
            call card%components('C1', directions)
            call card%field('G1,1', node)
            call read_groups(card, weight, directions, rigid)
         case ('RBE2')
            call card%field('GN', rigid%node)
            call card%components('CM', rigid%components)
            call card%field('GM1', node)
            last = card%n
            if (last > 4 .and. is_real(card%text_at(last))) then ! ALPHA, with TREF in the next field or without
               first = merge(last - 1, last, is_real(card%text_at(last - 1)))
               call read_expansion(card, first, last, rigid)
               last = first - 1
            end if
            call read_list(card, 4, last, rigid%components, 1.0_wp, rigid)
         case default ! rigid_elements adds the nodes of the surface
            call card%field(one_of(rigid%is_mean, 'REFGRID', 'GN'), rigid%node, default=0, least=0)
            call card%components(one_of(rigid%is_mean, 'REFC', 'CM'), rigid%components)
            directions = rigid%components
            if (rigid%is_mean) call card%components('C', directions)
            call card%field('PID', rigid%surface)
            if (.not. rigid%is_mean) call card%field('ALPHA', rigid%alpha, default=0.0_wp)
            if (.not. rigid%is_mean) call card%field('TREF', rigid%reference, default=0.0_wp)
            call card%finish(rigid%line)
            rigid%at = [merge(5, 4, rigid%is_mean)]
            rigid%directions = [directions]
         end select
      end associate
   end subroutine read_rigid

   !> NODEAT: the node nearest to a place, on surface PID if given.
   subroutine read_place(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk

      associate (place => bulk%place(card%i))
         call card%field('ID', place%id)
         call card%field(['X', 'Y', 'Z'], place%x, default=0.0_wp)
         call card%field('PID', place%surface, default=0)
         call card%finish(place%line)
      end associate
   end subroutine read_place

   !> SHELLTO: a marked edge of shells and the marked face with which it moves.
   subroutine read_tie(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk

      call card%field(['PID1', 'PID2'], bulk%tie(card%i)%surfaces)
      call card%finish(bulk%tie(card%i)%line)
   end subroutine read_tie

   !> RBAR: one of the nodes GA and GB is independent, with all six components in CNA or CNB. The components CMA or CMB of the other
   !! node, all six where blank, move with it as a rigid body.
   subroutine read_rigid_bar(card, rigid)
      type(card_fields_type), intent(inout) :: card
      type(rigid_card), intent(inout)       :: rigid
      integer  :: nodes(2), independent(2), dependent(2), a, c
      real(wp) :: expansion(2)

      call card%field('EID', rigid%id)
      call card%field(['GA', 'GB'], nodes)
      call card%components('CNA', independent(1), default=0)
      call card%components('CNB', independent(2), default=0)
      call card%components('CMA', dependent(1), default=0)
      call card%components('CMB', dependent(2), default=0)
      call card%field(['ALPHA', 'TREF '], expansion, default=0.0_wp)
      rigid%alpha = expansion(1)
      rigid%reference = expansion(2)
      call card%finish(rigid%line)
      rigid%alpha_at = 8
      a = merge(2, 1, independent(1) == 0 .and. independent(2) > 0) ! the independent end
      if (all(independent > 0) .and. len(integer_text(independent(1))//integer_text(independent(2))) == 6) then
         rigid%um_nodes = nodes
         rigid%um_components = independent
         rigid%um_at = [2, 3]
         rigid%nodes = nodes
         rigid%at = [2, 3]
         if (all(dependent == 0)) dependent = [(others_of(independent(a)), a = 1, 2)]
         rigid%directions = dependent
         rigid%weight = [1.0_wp, 1.0_wp]
         rigid%node = nodes(1)
         rigid%node_at = 2
         return
      else if (any([(.not. has_component(independent(a), c), c = 1, 6)]) .or. independent(3 - a) > 0) then
         call card%error('CNA', 'expected six independent components in all, in CNA and CNB')
      else if (dependent(a) > 0) then
         call card%error(merge('CMA', 'CMB', a == 1), 'components of the independent end; expected a blank')
      end if
      if (dependent(3 - a) == 0) dependent(3 - a) = 123456
      rigid%node = nodes(a)
      rigid%node_at = a + 1
      rigid%components = dependent(3 - a)
      rigid%components_at = 8 - a
      rigid%nodes = [nodes(3 - a)]
      rigid%at = [4 - a]
      rigid%directions = [rigid%components]
      rigid%weight = [1.0_wp]
   end subroutine read_rigid_bar

   !> The components that are not among COMPONENTS, 0: none.
   pure integer function others_of(components) result(others)
      integer, intent(in) :: components
      integer :: c

      others = 0
      do c = 1, 6
         if (.not. has_component(components, c)) others = 10*others + c
      end do
   end function others_of

   !> RBE1: six independent components CN of the nodes GN, then UM and the dependent components CM of the nodes GM, ALPHA and TREF.
   subroutine read_rigid_body(card, rigid)
      type(card_fields_type), intent(inout) :: card
      type(rigid_card), intent(inout)       :: rigid
      integer :: components, k, node
      logical :: is_dependent, node_ok, ok

      allocate (rigid%nodes(0), rigid%at(0), rigid%directions(0), rigid%weight(0), rigid%um_nodes(0), rigid%um_components(0), &
                rigid%um_at(0))
      rigid%line = card%line
      rigid%node_at = 2
      call card%field('EID', rigid%id)
      is_dependent = .false.
      k = 2
      do while (k <= card%n)
         if (card%text_at(k) == 'UM') then
            is_dependent = .true.
         else if (is_real(card%text_at(k))) then
            call read_expansion(card, k, card%n, rigid)
            exit
         else if (card%text_at(k) /= '') then
            call card%integer_at(k, 'G', node, node_ok, bounds=at_least_1, expected=a_node)
            call card%integer_at(k + 1, 'C', components, ok, expected=component_words)
            if (node_ok .and. is_dependent) then
               rigid%nodes = [rigid%nodes, node]
               rigid%directions = [rigid%directions, components]
               rigid%at = [rigid%at, k]
            else if (node_ok) then
               rigid%um_nodes = [rigid%um_nodes, node]
               rigid%um_components = [rigid%um_components, components]
               rigid%um_at = [rigid%um_at, k]
            end if
            k = k + 1
         end if
         k = k + 1
      end do
      rigid%weight = spread(1.0_wp, 1, size(rigid%nodes))
      if (size(rigid%um_nodes) > 0) rigid%node = rigid%um_nodes(1)
      if (size(rigid%um_nodes) == 0 .or. size(rigid%nodes) == 0) call card%error('EID', &
         'expected nodes and their independent components, UM, nodes and their dependent components')
   end subroutine read_rigid_body

   !> RROD: the distance of the nodes GA and GB is constant; a component CMA or CMB depends.
   subroutine read_rigid_rod(card, rigid)
      type(card_fields_type), intent(inout) :: card
      type(rigid_card), intent(inout)       :: rigid
      integer :: c(2), end

      rigid%is_rod = .true.
      allocate (rigid%nodes(2))
      call card%field('EID', rigid%id)
      call card%field(['GA', 'GB'], rigid%nodes)
      call card%field(['CMA', 'CMB'], c, default=0, least=0, most=3)
      call card%field('ALPHA', rigid%alpha, default=0.0_wp)
      call card%field('TREF', rigid%reference, default=0.0_wp)
      call card%finish(rigid%line)
      rigid%alpha_at = 6
      if (count(c > 0) /= 1) call card%error('CMA', 'expected one dependent component, 1 to 3, in CMA or CMB')
      end = merge(1, 2, c(1) > 0)
      rigid%nodes = rigid%nodes([end, 3 - end])
      rigid%at = [end + 1, 4 - end]
      rigid%node = rigid%nodes(2)
      rigid%node_at = 4 - end
      rigid%components = c(end)
      rigid%directions = [c(end), 0]
      rigid%weight = [1.0_wp, 1.0_wp]
   end subroutine read_rigid_rod

   !> ALPHA in data field K, and TREF after it unless that is beyond field LAST.
   subroutine read_expansion(card, k, last, rigid)
      type(card_fields_type), intent(inout) :: card
      integer, intent(in)                   :: k, last
      type(rigid_card), intent(inout)       :: rigid
      logical :: ok

      call card%real_at(k, 'ALPHA', rigid%alpha, ok)
      rigid%alpha_at = k
      if (k < last) call card%real_at(k + 1, 'TREF', rigid%reference, ok)
   end subroutine read_expansion

   !> The groups of an RBE3 from data field 5 on. WEIGHT, DIRECTIONS and nodes of the first group are decoded so far; after its
   !! nodes a real begins the next group. After the groups: UM with pairs of a node and its components, ALPHA and its value, and
   !! TREF or nothing.
   subroutine read_groups(card, weight, directions, rigid)
      type(card_fields_type), intent(inout) :: card
      real(wp), intent(in)                  :: weight
      integer, intent(in)                   :: directions
      type(rigid_card), intent(inout)       :: rigid
      real(wp) :: this_weight
      integer  :: components, first, last, node, these
      logical  :: is_node, ok

      first = 7
      this_weight = weight
      these = directions
      do
         last = first
         do while (last <= card%n .and. .not. (is_word(card%text_at(last)) .or. is_real(card%text_at(last))))
            last = last + 1
         end do
         call read_list(card, first, last - 1, these, this_weight, rigid)
         if (last > card%n) return
         if (is_word(card%text_at(last))) exit
         call card%real_at(last, 'WT', this_weight, ok, positive, expected='a weight, a real number above 0')
         call card%integer_at(last + 1, 'C', these, ok, expected=component_words)
         first = last + 2
         if (first > card%n) call card%error_at(first, 'G: blank, expected '//a_node)
      end do
      if (card%text_at(last) == 'UM') then
         allocate (rigid%um_nodes(0), rigid%um_components(0), rigid%um_at(0))
         last = last + 1
         do while (last <= card%n .and. .not. is_word(card%text_at(last)))
            if (card%text_at(last) == '') then
               last = last + 1
               cycle
            end if
            call card%integer_at(last, 'G', node, is_node, expected=a_node)
            call card%integer_at(last + 1, 'C', components, ok, expected=component_words)
            if (is_node) then
               rigid%um_nodes = [rigid%um_nodes, node]
               rigid%um_components = [rigid%um_components, components]
               rigid%um_at = [rigid%um_at, last]
            end if
            last = last + 2
         end do
         if (last > card%n) return
      end if
      if (card%text_at(last) == 'ALPHA' .and. last < card%n) then
         call read_expansion(card, last + 1, card%n, rigid)
      else
         call card%error_at(last, ''''//card%text_at(last)//''', expected '//a_node//', a weight, UM or ALPHA')
      end if
   end subroutine read_groups

   !> Whether TEXT begins with a letter.
   pure logical function is_word(text)
      character(*), intent(in) :: text

      is_word = scan(text, 'ABCDEFGHIJKLMNOPQRSTUVWXYZ') == 1
   end function is_word

   !> Whether TEXT is not an integer but has the decimal point of a real number.
   pure logical function is_real(text)
      character(*), intent(in) :: text
      integer :: number
      logical :: ok

      call parse_integer(text, number, ok)
      is_real = .not. ok .and. index(text, '.') > 0
   end function is_real

   !> Append the nodes in the data fields FIRST to LAST to RIGID, all with the same DIRECTIONS and WEIGHT.
   subroutine read_list(card, first, last, directions, weight, rigid)
      type(card_fields_type), intent(inout) :: card
      integer, intent(in)                   :: first, last, directions
      real(wp), intent(in)                  :: weight
      type(rigid_card), intent(inout)       :: rigid
      integer :: k, node(first:max(first, last)), at(first:max(first, last))
      logical :: ok

      at = 0
      do k = first, last
         if (card%text_at(k) == '') cycle
         call card%integer_at(k, 'G', node(k), ok, bounds=at_least_1, expected=a_node)
         if (ok) at(k) = k
      end do
      rigid%nodes = [rigid%nodes, pack(node, at > 0)]
      rigid%at = [rigid%at, pack(at, at > 0)]
      rigid%directions = [rigid%directions, spread(directions, 1, count(at > 0))]
      rigid%weight = [rigid%weight, spread(weight, 1, count(at > 0))]
   end subroutine read_list

   !> MPC: the sum of A times component C of node G is zero; the first term is the dependent one.
   subroutine read_equation(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      real(wp) :: factor
      integer  :: component, k, node
      logical  :: ok

      associate (equation => bulk%equation(card%i))
         equation%line = card%line
         equation%at = [2, 5]
         allocate (equation%node(2), equation%component(2), equation%factor(2))
         call card%field('SID', equation%set)
         call card%field('G1', equation%node(1))
         call card%field('C1', equation%component(1), default=0, least=0, most=6)
         call card%field('A1', equation%factor(1))
         call card%field('G2', equation%node(2))
         call card%field('C2', equation%component(2), default=0, least=0, most=6)
         call card%field('A2', equation%factor(2))
         if (.not. card%is_faulty() .and. abs(equation%factor(1)) <= 0.0_wp) &
            call card%error('A1', 'zero, expected a coefficient that is not zero: the first term is the dependent one')
         do k = 8, card%n
            if (modulo(k, 8) <= 1) call card%must_be_blank(k, k, '')
            if (modulo(k, 8) /= 2 .and. modulo(k, 8) /= 5) cycle ! no term begins here
            if (card%text_at(k)//card%text_at(k + 1)//card%text_at(k + 2) == '') cycle
            if (card%text_at(k) == '') then
               call card%error_at(k, 'G: blank, expected '//a_node)
               cycle
            end if
            call card%integer_at(k, 'G', node, ok, expected=a_node)
            call card%integer_at(k + 1, 'C', component, ok, bounds=[0, 6])
            call card%real_at(k + 2, 'A', factor, ok)
            equation%node = [equation%node, node]
            equation%component = [equation%component, component]
            equation%factor = [equation%factor, factor]
            equation%at = [equation%at, k]
         end do
      end associate
   end subroutine read_equation

end module rigid_cards
