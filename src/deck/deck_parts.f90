!> The parts of a deck with partitioned superelements: BEGIN SUPER = n begins part n, in which the cards of a superelement follow.
!! All parts are one structure, of which nothing is reduced: its answer is exact where NASTRAN's depends on the reduction. All parts
!! share one numbering. A node, property or material that several parts give by the same card is one; SECONCT of different numbers,
!! SELOC and copies of parts are errors.
module deck_parts
   use bulk_data, only: bulk_data_type
   use card_fields, only: card_fields_type
   use checksum, only: add_to_checksum, no_bytes
   use deck_cards, only: card_type, read_card
   use deck_errors, only: deck_error_list
   use deck_text, only: deck_text_type
   use field_rules, only: parse_integer
   use, intrinsic :: iso_fortran_env, only: int16, int64
   use lists, only: sorted_order
   use text_tools, only: integer_text, plural, upper
   implicit none
   private

   public :: part_of_begin, drop_repeated, check_parts, read_part

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

   !> Say what parts are here, and which nodes NASTRAN would join.
   subroutine check_parts(bulk, errors)
      type(bulk_data_type), intent(in)     :: bulk
      type(deck_error_list), intent(inout) :: errors
      integer, allocatable        :: order(:)
      integer(int64), allocatable :: key(:)
      integer :: first(2), i, j, n

      call errors%warn('BEGIN SUPER: '//plural(size(bulk%part_lines), 'part')//' and the main bulk data are one structure, in '// &
                       'one numbering; nothing is reduced, and every SUBCASE is of the whole structure')
      allocate (key(size(bulk%grid)), source=no_bytes)
      do i = 1, size(bulk%grid)
         call add_to_checksum(transfer([bulk%grid(i)%x], repeat('x', 24)), key(i))
      end do
      call sorted_order(int(ibits(key, 0, 31)), order)
      n = 0
      do i = 2, size(order)
         do j = i - 1, 1, -1
            if (ibits(key(order(j)), 0, 31) /= ibits(key(order(i)), 0, 31)) exit
            associate (a => bulk%grid(order(j)), b => bulk%grid(order(i)))
               if (a%is_scalar .or. b%is_scalar .or. a%cp /= b%cp .or. key(order(j)) /= key(order(i)) .or. a%id == b%id) cycle
               if (part_at(bulk, a%line) == part_at(bulk, b%line)) cycle
               n = n + 1
               if (n == 1) first = [a%id, b%id]
            end associate
         end do
      end do
      if (n > 0 .and. bulk%n_manual < size(bulk%part_lines)) &
         call errors%warn(plural(n, 'pair')//' of nodes of two parts at one place are not joined, the first '// &
                          integer_text(first(1))//' and '//integer_text(first(2))//'; NASTRAN joins such nodes unless SEBULK '// &
                          'has MANUAL: give them one number, or RBE2')
   end subroutine check_parts

   !> SEBULK and SECONCT: a part is itself, where its GRID cards are, and is joined to others by nodes of the same number.
   subroutine read_part(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      character(8) :: word
      integer :: k, seid
      logical :: is_one

      call card%field(merge('SEIDA', 'SEID ', card%name == 'SECONCT'), seid)
      if (card%name == 'SEBULK') then
         call card%word('TYPE', '|PRIMARY|', word)
         call card%skip(['RSEID'])
         call card%word('METHOD', '|AUTO|MANUAL|', word)
         if (word == 'MANUAL') bulk%n_manual = bulk%n_manual + 1
         return
      end if
      call card%field('SEIDB', seid, default=0, least=0)
      do k = 9, card%n - 1, 2
         is_one = card%text_at(k) == card%text_at(k + 1) .or. any(['THRU' == card%text_at(k), 'THRU' == card%text_at(k + 1)])
         if (.not. is_one) call card%error_at(k + 1, 'GB: '''//card%text_at(k + 1)//''' where GA is '//card%text_at(k)// &
                                              '; expected one number in both parts')
      end do
   end subroutine read_part

end module deck_parts
