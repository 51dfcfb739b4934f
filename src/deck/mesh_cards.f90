!> The cards of nodes, edges and generated blocks: GRID, CBAR, CROD, PMARK, BLOCK2, BLOCK3. A table and a routine each.
module mesh_cards
   use bulk_data, only: bulk_data_type
   use card_fields, only: card_values, decode_card, field_error
   use card_lines, only: card_type
   use deck_errors, only: deck_error_list
   use field_rules, only: blank_field, component_field, field_rule, integer_field, real_field
   use kinds, only: wp
   implicit none
   private

   public :: read_grid, read_cbar, read_crod, read_pmark, read_block2, read_block3

   real(wp), parameter :: most_elements = 2.0e7_wp         ! of a block
   integer, parameter  :: most_first = huge(1) - 200000000 ! N1 and E1: the numbers of a block have room behind them

contains

   !> GRID: a node. Gmsh writes whole coordinates without a decimal point in large field, so integers are taken here.
   subroutine read_grid(card, bulk, values, errors)
      type(card_type), intent(in)          :: card
      type(bulk_data_type), intent(inout)  :: bulk
      type(card_values), intent(inout)     :: values
      type(deck_error_list), intent(inout) :: errors
      type(field_rule), save, allocatable :: table(:)

      if (.not. allocated(table)) table = [integer_field('ID'), blank_field('CP'), &
         real_field('X1', default=0.0_wp, whole=.true.), real_field('X2', default=0.0_wp, whole=.true.), &
         real_field('X3', default=0.0_wp, whole=.true.), &
         blank_field('CD'), component_field('PS', default=0), blank_field('SEID')]
      call decode_card(card, table, .false., values, errors)
      bulk%n_grid = bulk%n_grid + 1
      associate (grid => bulk%grid(bulk%n_grid))
         grid%line = card%line
         grid%id = values%integers(1)
         grid%x = values%reals(3:5)
         grid%ps = values%integers(7)
         grid%doubtful = .not. values%ok
      end associate
   end subroutine read_grid


   !> CBAR: an edge of a marked surface. The orientation vector of a real bar (Gmsh writes one) has no meaning here.
   subroutine read_cbar(card, bulk, values, errors)
      type(card_type), intent(in)          :: card
      type(bulk_data_type), intent(inout)  :: bulk
      type(card_values), intent(inout)     :: values
      type(deck_error_list), intent(inout) :: errors
      type(field_rule), save, allocatable :: table(:)

      if (.not. allocated(table)) table = [integer_field('EID'), integer_field('PID'), integer_field('GA'), &
         integer_field('GB'), real_field('X1', default=0.0_wp), real_field('X2', default=0.0_wp), &
         real_field('X3', default=0.0_wp)]
      call decode_card(card, table, .false., values, errors)
      call store_edge(card, bulk, values)
   end subroutine read_cbar


   !> CROD: an edge of a marked surface, or with a PROD a bar, such as a bolt.
   subroutine read_crod(card, bulk, values, errors)
      type(card_type), intent(in)          :: card
      type(bulk_data_type), intent(inout)  :: bulk
      type(card_values), intent(inout)     :: values
      type(deck_error_list), intent(inout) :: errors
      type(field_rule), save, allocatable :: table(:)

      if (.not. allocated(table)) table = [integer_field('EID'), integer_field('PID'), integer_field('G1'), integer_field('G2')]
      call decode_card(card, table, .false., values, errors)
      call store_edge(card, bulk, values)
   end subroutine read_crod


   subroutine store_edge(card, bulk, values)
      type(card_type), intent(in)         :: card
      type(bulk_data_type), intent(inout) :: bulk
      type(card_values), intent(in)       :: values

      bulk%n_edge = bulk%n_edge + 1
      associate (edge => bulk%edge(bulk%n_edge))
         edge%line = card%line
         edge%id = values%integers(1)
         edge%property = values%integers(2)
         edge%nodes(:2) = values%integers(3:4)
      end associate
   end subroutine store_edge


   subroutine read_pmark(card, bulk, values, errors)
      type(card_type), intent(in)          :: card
      type(bulk_data_type), intent(inout)  :: bulk
      type(card_values), intent(inout)     :: values
      type(deck_error_list), intent(inout) :: errors
      type(field_rule), save, allocatable :: table(:)

      if (.not. allocated(table)) table = [integer_field('PID')]
      call decode_card(card, table, .false., values, errors)
      bulk%n_pmark = bulk%n_pmark + 1
      bulk%pmark(bulk%n_pmark)%line = card%line
      bulk%pmark(bulk%n_pmark)%id = values%integers(1)
   end subroutine read_pmark


   !> BLOCK2: a quadrilateral block of NX by NY elements between four corners; corners 2 and 4 left blank make it a
   !! rectangle with corners 1 and 3 on its diagonal.
   subroutine read_block2(card, bulk, values, errors)
      type(card_type), intent(in)          :: card
      type(bulk_data_type), intent(inout)  :: bulk
      type(card_values), intent(inout)     :: values
      type(deck_error_list), intent(inout) :: errors
      type(field_rule), save, allocatable :: table(:)
      integer, parameter :: most_divisions = 100000
      integer :: errors_before

      errors_before = errors%n
      if (.not. allocated(table)) table = [integer_field('BID'), integer_field('PID'), &
         integer_field('NX', most=most_divisions), integer_field('NY', most=most_divisions), &
         real_field('X1', default=0.0_wp), real_field('Y1', default=0.0_wp), &
         real_field('X2', default=0.0_wp), real_field('Y2', default=0.0_wp), &
         real_field('X3'), real_field('Y3'), real_field('X4', default=0.0_wp), real_field('Y4', default=0.0_wp), &
         real_field('RX', default=1.0_wp, above=0.0_wp), real_field('RY', default=1.0_wp, above=0.0_wp), &
         integer_field('N1', default=1), integer_field('E1', default=1), &
         integer_field('S1', default=0), integer_field('S2', default=0), &
         integer_field('S3', default=0), integer_field('S4', default=0), integer_field('WELD', default=0)]
      call decode_card(card, table, .false., values, errors)
      if (any(values%given([7, 8, 11, 12])) .and. .not. all(values%given([7, 8, 11, 12]))) then
         call field_error(card, 7, 'X2: corners 2 and 4 must both be given (X2, Y2, X4, Y4), or all four '// &
                              'left blank for a rectangle', errors)
      end if
      call check_block(card, 4, values, errors)
      bulk%n_block2 = bulk%n_block2 + 1
      associate (block2 => bulk%block2(bulk%n_block2), x => values%reals)
         block2%line = card%line
         block2%id = values%integers(1)
         block2%property = values%integers(2)
         block2%divisions = max(1, values%integers(3:4))
         block2%corner = reshape(x(5:12), [2, 4])
         if (.not. any(values%given([7, 8, 11, 12]))) then
            block2%corner(:, 2) = [x(9), x(6)]
            block2%corner(:, 4) = [x(5), x(10)]
         end if
         block2%grading = x(13:14)
         block2%first_node = values%integers(15)
         block2%first_element = values%integers(16)
         block2%marks = values%integers(17:20)
         block2%weld = values%integers(21)
         block2%doubtful = errors%n > errors_before
      end associate
   end subroutine read_block2


   !> BLOCK3: a box of NX by NY by NZ elements between two opposite corners; nodes go up z first, then y, then x.
   subroutine read_block3(card, bulk, values, errors)
      type(card_type), intent(in)          :: card
      type(bulk_data_type), intent(inout)  :: bulk
      type(card_values), intent(inout)     :: values
      type(deck_error_list), intent(inout) :: errors
      type(field_rule), save, allocatable :: table(:)
      integer, parameter :: most_divisions = 10000
      integer :: errors_before

      errors_before = errors%n
      if (.not. allocated(table)) table = [integer_field('BID'), integer_field('PID'), &
         integer_field('NX', most=most_divisions), integer_field('NY', most=most_divisions), &
         integer_field('NZ', most=most_divisions), &
         real_field('X1', default=0.0_wp), real_field('Y1', default=0.0_wp), real_field('Z1', default=0.0_wp), &
         real_field('X2'), real_field('Y2'), real_field('Z2'), real_field('RX', default=1.0_wp, above=0.0_wp), &
         real_field('RY', default=1.0_wp, above=0.0_wp), real_field('RZ', default=1.0_wp, above=0.0_wp), &
         integer_field('N1', default=1), integer_field('E1', default=1), &
         integer_field('S1', default=0), integer_field('S2', default=0), integer_field('S3', default=0), &
         integer_field('S4', default=0), integer_field('S5', default=0), integer_field('S6', default=0), &
         integer_field('WELD', default=0)]
      call decode_card(card, table, .false., values, errors)
      call check_block(card, 5, values, errors)
      where (values%integers(15:16) > most_first) values%integers(15:16) = 1 ! a deck of solids is mostly one block, from 1 on
      if (values%ok .and. any(values%reals(9:11) <= values%reals(6:8))) call field_error(card, 9, &
         'X2: the second corner must lie beyond the first in x, y and z', errors)
      bulk%n_block3 = bulk%n_block3 + 1
      associate (block3 => bulk%block3(bulk%n_block3), x => values%reals)
         block3%line = card%line
         block3%id = values%integers(1)
         block3%property = values%integers(2)
         block3%divisions = max(1, values%integers(3:5))
         block3%corner = reshape(x(6:11), [3, 2])
         block3%grading = x(12:14)
         block3%first_node = values%integers(15)
         block3%first_element = values%integers(16)
         block3%marks = values%integers(17:22)
         block3%weld = values%integers(23)
         block3%doubtful = errors%n > errors_before
      end associate
   end subroutine read_block3


   !> Size and numbers of a block, whose divisions are data fields 3 to LAST and whose N1 and E1 are 15 and 16. Of too many
   !! elements one is left, so that the rest of the deck can be checked.
   subroutine check_block(card, last, values, errors)
      type(card_type), intent(in)          :: card
      integer, intent(in)                  :: last
      type(card_values), intent(inout)     :: values
      type(deck_error_list), intent(inout) :: errors

      if (product(real(values%integers(3:last), wp)) > most_elements) then
         call field_error(card, 3, 'NX: more than 2E7 elements in one block', errors)
         values%integers(3:last) = 1
      end if
      if (values%integers(15) > most_first) &
         call field_error(card, 15, 'N1: the last node number would pass 2147483647', errors)
      if (values%integers(16) > most_first) &
         call field_error(card, 16, 'E1: the last element number would pass 2147483647', errors)
   end subroutine check_block

end module mesh_cards
