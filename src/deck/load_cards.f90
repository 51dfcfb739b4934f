!> The cards of supports and loads: SPC, SPC1, SPCM, FORCE, LOAD. A table and a routine each.
module load_cards
   use bulk_data, only: bulk_data_type, support_card
   use card_fields, only: card_values, check_direction, decode_card, decode_integer, decode_real, field_error
   use card_lines, only: card_type
   use deck_errors, only: deck_error_list
   use field_rules, only: blank_field, component_field, field_rule, integer_field, real_field
   use kinds, only: wp
   use text_tools, only: integer_text
   implicit none
   private

   public :: read_spc, read_spc1, read_spcm, read_force, read_load

contains

   !> SPC: one or two nodes held in the components C; a displacement other than zero is not for this card.
   subroutine read_spc(card, bulk, values, errors)
      type(card_type), intent(in)          :: card
      type(bulk_data_type), intent(inout)  :: bulk
      type(card_values), intent(inout)     :: values
      type(deck_error_list), intent(inout) :: errors
      type(field_rule), save, allocatable :: table(:)
      logical :: two

      if (.not. allocated(table)) table = [integer_field('SID'), integer_field('G1'), component_field('C1'), &
         blank_field('D1'), integer_field('G2', default=0), component_field('C2', default=0), blank_field('D2')]
      call decode_card(card, table, .false., values, errors)
      two = values%given(5)
      if (two .neqv. values%given(6)) call field_error(card, 5, 'G2: node and components C2 go together', errors)
      bulk%n_support = bulk%n_support + 1
      associate (support => bulk%support(bulk%n_support))
         call start_support(support, card%line, values%integers(1), values%integers(3), values%integers(2:2), [2])
      end associate
      if (.not. two) return
      bulk%n_support = bulk%n_support + 1
      associate (support => bulk%support(bulk%n_support))
         call start_support(support, card%line, values%integers(1), values%integers(6), values%integers(5:5), [5])
      end associate
   end subroutine read_spc


   pure subroutine start_support(support, line, set, components, nodes, at)
      type(support_card), intent(inout) :: support
      integer, intent(in)               :: line, set, components, nodes(:), at(:)

      support%line = line
      support%set = set
      support%components = components
      support%first = nodes
      support%last = nodes
      support%at = at
   end subroutine start_support


   !> SPC1: components C of the nodes G1, G2, ..., or G1 THRU G2.
   subroutine read_spc1(card, bulk, values, errors)
      type(card_type), intent(in)          :: card
      type(bulk_data_type), intent(inout)  :: bulk
      type(card_values), intent(inout)     :: values
      type(deck_error_list), intent(inout) :: errors
      type(field_rule), save, allocatable :: table(:)
      integer, allocatable :: nodes(:), last(:), at(:)
      integer :: k, n, node
      logical :: ok, through

      if (.not. allocated(table)) table = [integer_field('SID'), component_field('C')]
      call decode_card(card, table, .true., values, errors)
      allocate (nodes(card%n), last(card%n), at(card%n), source=0)
      n = 0
      through = .false.
      do k = 3, card%n
         if (card%fields(k)%text == '') cycle
         if (card%fields(k)%text == 'THRU') then
            if (n == 0 .or. through .or. k == card%n) call field_error(card, k, 'THRU: expected G1 THRU G2', errors)
            through = .true.
            cycle
         end if
         call decode_integer(card, k, 'G', 'a node number or THRU', node, ok, errors)
         if (.not. ok) cycle
         if (node < 1) call field_error(card, k, 'G: '''//integer_text(node)//''' is no node number', errors)
         if (through) then
            through = .false.
            if (n == 0) cycle
            last(n) = node
            if (node < nodes(n)) call field_error(card, k, 'G: THRU goes down, expected '// &
                                                  integer_text(nodes(n))//' or more', errors)
         else
            n = n + 1
            nodes(n) = node
            last(n) = node
            at(n) = k
         end if
      end do
      if (n == 0 .and. card%n < 3) call field_error(card, 3, 'G1: blank, expected a node number', errors)
      bulk%n_support = bulk%n_support + 1
      associate (support => bulk%support(bulk%n_support))
         call start_support(support, card%line, values%integers(1), values%integers(2), nodes(:n), at(:n))
         support%last = last(:n)
      end associate
   end subroutine read_spc1


   !> SPCM: components C of all nodes of the marked surface PID.
   subroutine read_spcm(card, bulk, values, errors)
      type(card_type), intent(in)          :: card
      type(bulk_data_type), intent(inout)  :: bulk
      type(card_values), intent(inout)     :: values
      type(deck_error_list), intent(inout) :: errors
      type(field_rule), save, allocatable :: table(:)
      integer :: no_nodes(0)

      if (.not. allocated(table)) table = [integer_field('SID'), component_field('C'), integer_field('PID')]
      call decode_card(card, table, .false., values, errors)
      bulk%n_support = bulk%n_support + 1
      associate (support => bulk%support(bulk%n_support))
         call start_support(support, card%line, values%integers(1), values%integers(2), no_nodes, no_nodes)
         support%surface = values%integers(3)
      end associate
   end subroutine read_spcm


   !> FORCE: the vector F (N1, N2, N3) at one node; the direction is not made a unit vector, as in NASTRAN.
   subroutine read_force(card, bulk, values, errors)
      type(card_type), intent(in)          :: card
      type(bulk_data_type), intent(inout)  :: bulk
      type(card_values), intent(inout)     :: values
      type(deck_error_list), intent(inout) :: errors
      type(field_rule), save, allocatable :: table(:)

      if (.not. allocated(table)) table = [integer_field('SID'), integer_field('G'), blank_field('CID'), real_field('F'), &
         real_field('N1', default=0.0_wp), real_field('N2', default=0.0_wp), real_field('N3', default=0.0_wp)]
      call decode_card(card, table, .false., values, errors)
      call check_direction(card, table, 5, 'the force', values, errors)
      bulk%n_force = bulk%n_force + 1
      associate (force => bulk%force(bulk%n_force))
         force%line = card%line
         force%set = values%integers(1)
         force%node = values%integers(2)
         force%force = values%reals(4)*values%reals(5:7)
      end associate
   end subroutine read_force


   !> LOAD: S (S1 L1 + S2 L2 + ...), the sets L being those of load cards other than LOAD.
   subroutine read_load(card, bulk, values, errors)
      type(card_type), intent(in)          :: card
      type(bulk_data_type), intent(inout)  :: bulk
      type(card_values), intent(inout)     :: values
      type(deck_error_list), intent(inout) :: errors
      type(field_rule), save, allocatable :: table(:)
      real(wp) :: factor
      integer  :: k, set
      logical  :: factor_ok, set_ok

      if (.not. allocated(table)) table = [integer_field('SID'), real_field('S'), real_field('S1'), integer_field('L1')]
      call decode_card(card, table, .true., values, errors)
      bulk%n_load = bulk%n_load + 1
      associate (load => bulk%load(bulk%n_load))
         load%line = card%line
         load%set = values%integers(1)
         load%scale = values%reals(2)
         load%factors = values%reals(3:3)
         load%sets = values%integers(4:4)
         load%at = [4]
         do k = 5, card%n, 2
            if (k + 1 > card%n) then
               call field_error(card, k, 'S: a factor without its load set', errors)
               exit
            end if
            if (card%fields(k)%text == '' .and. card%fields(k + 1)%text == '') cycle
            if (card%fields(k)%text == '' .or. card%fields(k + 1)%text == '') then
               call field_error(card, k, 'S: a factor S and its load set L go together, one of them is blank', errors)
               cycle
            end if
            call decode_real(card, k, 'S', 'a real number', factor, factor_ok, errors)
            call decode_integer(card, k + 1, 'L', 'a load set number', set, set_ok, errors)
            if (.not. (factor_ok .and. set_ok)) cycle
            if (set < 1) call field_error(card, k + 1, 'L: '''//integer_text(set)// &
                                          ''' is out of range, expected a load set number of 1 or more', errors)
            load%factors = [load%factors, factor]
            load%sets = [load%sets, set]
            load%at = [load%at, k + 1]
         end do
      end associate
   end subroutine read_load

end module load_cards
