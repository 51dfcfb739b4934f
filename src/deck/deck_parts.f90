!> The parts of a deck with partitioned superelements: BEGIN SUPER = n begins part n, in which the cards of a superelement follow.
!! All parts are one structure, of which nothing is reduced: its answer is exact where NASTRAN's depends on the reduction. All parts
!! share one numbering. A node, property or material that several parts give by the same card is one; SELOC and copies of parts are
!! errors. Which nodes of different numbers are one node, part_nodes decides.
module deck_parts
   use bulk_data, only: bulk_data_type
   use card_fields, only: card_fields_type
   use checksum, only: add_to_checksum, no_bytes
   use deck_cards, only: card_type, read_card
   use deck_errors, only: deck_error_list
   use deck_text, only: deck_text_type
   use field_rules, only: parse_integer, positive
   use kinds, only: wp
   use, intrinsic :: iso_fortran_env, only: int16, int64
   use lists, only: sorted_order
   use text_tools, only: plural, upper
   implicit none
   private

   public :: part_of_begin, part_at, drop_repeated, check_parts, read_part

   ! cards that mean the same when they are given twice, by their first letters: nodes, axes, materials, tables, supports and sets
   character(6), parameter :: same_twice(14) = [character(6) :: 'GRID', 'GRDSET', 'SPOINT', 'CORD', 'MAT', 'TABLE', 'TABDMP', &
      'EIGR', 'SPC', 'BAROR', 'BEAMOR', 'ASET', 'BSET', 'QSET']

contains

   !> The number of the part that LINE, which begins with BEGIN, begins; 0: it begins no part.
   pure integer function part_of_begin(line) result(part)
      character(*), intent(in) :: line
      character(:), allocatable :: rest
      logical :: is_integer

      rest = adjustl(upper(line(6:)))
      if (index(rest, 'BULK') == 1) rest = adjustl(rest(5:))
      part = 0
      if (index(rest, 'SUPER') /= 1) return
      rest = adjustl(rest(6:))
      if (index(rest, '=') == 1) rest = adjustl(rest(2:))
      call parse_integer(trim(rest), part, is_integer)
      if (.not. is_integer .or. part < 1) part = 0
   end function part_of_begin

   !> The part of the card on LINE, in the order of the deck; 0: the main bulk data.
   pure integer function part_at(bulk, line)
      type(bulk_data_type), intent(in) :: bulk
      integer, intent(in)              :: line

      part_at = count(bulk%part_lines < line)
   end function part_at

   !> Of cards that several parts give with the same entries keep the first, where they mean the same when given twice. GRDSET holds
   !! for its own part in NASTRAN, here for all, so that no part with nodes may lack it.
   subroutine drop_repeated(text, names, kind_at, n, bulk, errors)
      type(deck_text_type), intent(in)     :: text
      character(8), intent(in)             :: names(:)   !! of the kinds of card
      integer(int16), intent(inout)        :: kind_at(:) !! (lines) kind of the card that begins there, 0: none
      integer, intent(inout)               :: n(:)       !! number of cards of each kind
      type(bulk_data_type), intent(in)     :: bulk
      type(deck_error_list), intent(inout) :: errors
      integer, allocatable         :: line(:), order(:)
      integer(int64), allocatable  :: key(:)
      logical, allocatable :: counts(:)
      logical :: has(2, 0:size(bulk%part_lines)), is_first
      integer :: i, j, k

      has = .false.
      allocate (counts(size(kind_at)), source=.false.)
      do i = 1, size(kind_at)
         if (kind_at(i) == 0) cycle
         associate (name => names(kind_at(i)))
            if (name == 'GRDSET') has(2, part_at(bulk, i)) = .true.
            counts(i) = is_same_twice(name)
         end associate
      end do
      line = pack([(i, i = 1, size(counts))], counts)
      allocate (key(size(line)))
      do i = 1, size(line)
         key(i) = sum_of_card(text, line(i))
      end do
      call sorted_order(int(ibits(key, 0, 31)), order) ! equal cards keep their order
      do i = 1, size(line)
         associate (this => order(i))
            is_first = .true.
            do j = i - 1, 1, -1
               if (ibits(key(order(j)), 0, 31) /= ibits(key(this), 0, 31)) exit
               if (key(order(j)) == key(this) .and. part_at(bulk, line(order(j))) < part_at(bulk, line(this))) is_first = .false.
            end do
            k = kind_at(line(this))
            if (names(k) == 'GRID' .and. is_first) has(1, part_at(bulk, line(this))) = .true.
            if (is_first) cycle
            n(k) = n(k) - 1
            kind_at(line(this)) = 0
         end associate
      end do
      ! the nodes of the main bulk data that parts repeat belong to these parts
      if (any(has(2, :)) .and. any(has(1, 1:) .and. .not. has(2, 1:))) &
         call errors%add(bulk%part_lines(findloc(has(1, 1:) .and. .not. has(2, 1:), .true., dim=1)), 'GRDSET holds for '// &
                         'all parts, and this part has none; expected the same GRDSET in each, or CP, CD and PS of GRID')
   end subroutine drop_repeated

   !> The checksum of the card that begins on LINE, of its name and all its entries.
   integer(int64) function sum_of_card(text, line) result(key)
      type(deck_text_type), intent(in) :: text
      integer, intent(in)              :: line
      type(card_type), allocatable :: card
      type(deck_error_list) :: said_later
      integer :: behind, k

      behind = line
      allocate (card)
      call read_card(text, behind, card, said_later)
      key = no_bytes
      call add_to_checksum(card%name, key)
      do k = 1, card%n
         call add_to_checksum('|'//card%fields(k)%text(:card%fields(k)%length), key)
      end do
   end function sum_of_card

   !> Whether a card NAME means the same when it is given twice. Two equal loads, masses or elements are two.
   pure logical function is_same_twice(name)
      character(8), intent(in) :: name
      integer :: k

      is_same_twice = name(1:1) == 'P' .and. name(:5) /= 'PLOAD'
      do k = 1, size(same_twice)
         is_same_twice = is_same_twice .or. index(name, trim(same_twice(k))) == 1
      end do
      if (name == 'SPCD' .or. name == 'MATT1') is_same_twice = .false.
   end function is_same_twice

   !> Say what the parts are.
   subroutine check_parts(bulk, errors)
      type(bulk_data_type), intent(in)     :: bulk
      type(deck_error_list), intent(inout) :: errors

      call errors%warn('BEGIN SUPER: '//plural(size(bulk%part_lines), 'part')//' and the main bulk data are one structure, in '// &
                       'one numbering; nothing is reduced, and every SUBCASE is of the whole structure')
   end subroutine check_parts

   !> SEBULK and SECONCT: a part is itself, where its GRID cards are, and is joined to others by nodes of the same number, by pairs
   !! GA and GB, or GA1 THRU GA2, GB1 THRU GB2, and by nodes at one place.
   subroutine read_part(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      character(8) :: word
      real(wp) :: tolerance
      integer, parameter :: ids(2) = [1, huge(1)]
      integer :: at, ends(4), i, k, seid
      logical :: ok(4)

      call card%field(merge('SEIDA', 'SEID ', card%name == 'SECONCT'), seid)
      if (card%name == 'SEBULK') then
         if (card%text_at(2) /= '' .and. card%text_at(2) /= 'PRIMARY') &
            call card%wrong_entry(2, 'TYPE', 'makes a part of the cards of another one, or of a file; expected PRIMARY, or blank')
         call card%skip(['TYPE ', 'RSEID'])
         call card%word('METHOD', '|AUTO|MANUAL|', word)
         if (word == 'MANUAL') bulk%n_manual = bulk%n_manual + 1
         call card%field('TOL', tolerance, positive, default=0.0_wp)
         bulk%join_distance = max(bulk%join_distance, tolerance)
         return
      end if
      call card%field('SEIDB', seid, default=0, least=0)
      call card%field('TOL', tolerance, positive, default=0.0_wp)
      bulk%join_distance = max(bulk%join_distance, tolerance)
      k = 9
      do while (k <= card%n)
         at = k
         if (card%text_at(k) == '' .and. (k == card%n .or. card%text_at(min(k + 1, card%n)) == '')) then
            k = k + 2
            cycle
         end if
         call card%integer_at(k, 'GA', ends(1), ok(1), bounds=ids)
         if (card%text_at(k + 1) == 'THRU') then
            call card%integer_at(k + 2, 'GA', ends(2), ok(2), bounds=ids)
            call card%integer_at(k + 3, 'GB', ends(3), ok(3), bounds=ids)
            call card%integer_at(k + 5, 'GB', ends(4), ok(4), bounds=ids)
            if (all(ok) .and. ends(2) - ends(1) /= ends(4) - ends(3)) then
               call card%error_at(k + 5, 'GB: expected as many nodes as GA1 THRU GA2')
               ok = .false.
            end if
            k = k + 6
         else
            call card%integer_at(k + 1, 'GB', ends(3), ok(3), bounds=ids)
            ends(2) = ends(1)
            ok([2, 4]) = .true.
            k = k + 2
         end if
         if (.not. all(ok) .or. ends(1) == ends(3)) cycle
         bulk%joined = reshape([bulk%joined, [([ends(1) + i, ends(3) + i, card%line, at], i = 0, ends(2) - ends(1))]], &
                               [4, size(bulk%joined, 2) + max(0, ends(2) - ends(1) + 1)])
      end do
   end subroutine read_part

end module deck_parts
