!> A card, and a line of it cut into fields: small field (8 columns), large field (16), free field (commas).
module card_lines
   use deck_errors, only: deck_error_list
   use text_tools, only: integer_text
   implicit none
   private

   public :: cut_line

   integer, parameter, public :: field_width = 32 !! longest entry of a field (free field only)
   integer, parameter :: blank = iachar(' ')      ! codes are compared at once, characters by a call of the library

   !> One entry of a card and where it stands.
   type, public :: card_field
      character(field_width) :: text = ''  ! raised to capitals, left-justified
      integer :: length = 0                ! of the text
      integer :: line  = 0                 ! index in the deck text
      integer :: first = 0, last = 0       ! columns of the field
   end type card_field

   !> One card: its name and its data fields 1..n, field 1 being NASTRAN's field 2; each line of a card (each pair
   !! of lines in large field) gives eight, blank ones included up to the last entry.
   type, public :: card_type
      character(8) :: name = ''
      integer :: line = 0                    !! index of its first line
      integer :: n    = 0
      type(card_field), allocatable :: fields(:)
      character(8) :: marker = ''            !! what stands in field 10 of the line that was cut last
      logical, private :: half = .false.     ! that line is large field and waits for its second half
   contains
      procedure :: start
      procedure :: where_is
      procedure :: field_error
   end type card_type

contains

   !> Make SELF the card that begins on LINE, without its name and fields yet.
   subroutine start(self, line)
      class(card_type), intent(inout) :: self
      integer, intent(in)             :: line

      self%line = line
      self%n = 0
      self%marker = ''
      self%half = .false.
      if (.not. allocated(self%fields)) allocate (self%fields(64))
   end subroutine start

   !> Cut one line into fields and put them at the end of CARD.
   recursive subroutine cut_line(line, comma, at, has_tabs, card, errors)
      character(*), intent(in)             :: line     !! its card part
      integer, intent(in)                  :: comma    !! column of its first comma, 0: none
      integer, intent(in)                  :: at       !! its index in the deck text
      logical, intent(in)                  :: has_tabs !! there may be tabs in it
      type(card_type), intent(inout)       :: card
      type(deck_error_list), intent(inout) :: errors
      character(:), allocatable :: plain
      integer :: tab
      logical :: large

      if (has_tabs) then
         tab = index(line, achar(9))
         if (tab > 0) then
            call errors%add(at, 'a tab in column '//integer_text(tab)//': expected blanks, fields are columns of eight', tab, tab)
            plain = without_tabs(line)
            call cut_line(plain, index(plain, ','), at, .false., card, errors)
            return
         end if
      end if
      card%marker = ''
      large = index(line(:merge(comma - 1, min(8, len(line)), comma > 0)), '*') > 0
      if (card%half .and. .not. large) then
         do while (modulo(card%n, 8) /= 0) ! the second half of a large-field line is not there
            call push(card, '', at, 0, 0, errors)
         end do
      end if
      if (comma > 0) then
         call cut_free(line, comma, at, card, large, errors)
      else
         call cut_fixed(line, at, card, large, errors)
      end if
      card%half = large .and. modulo(card%n, 8) == 4
   end subroutine cut_line

   !> TEXT with its tabs as blanks up to the next field, so that one tab makes one error.
   pure function without_tabs(text) result(plain)
      character(*), intent(in)  :: text
      character(:), allocatable :: plain
      integer :: i

      plain = ''
      do i = 1, len(text)
         if (text(i:i) == achar(9)) then
            plain = plain//repeat(' ', 8 - modulo(len(plain), 8))
         else
            plain = plain//text(i:i)
         end if
         if (len(plain) > 1000) return
      end do
   end function without_tabs

   !> Fixed fields: eight of 8 columns, or four of 16, behind the name; columns 73-80 are the continuation mark.
   subroutine cut_fixed(line, at, card, large, errors)
      character(*), intent(in)             :: line
      integer, intent(in)                  :: at
      type(card_type), intent(inout)       :: card
      logical, intent(in)                  :: large
      type(deck_error_list), intent(inout) :: errors
      integer :: width, k, first, last

      if (len(line) > 80) then
         call errors%add(at, 'text past column 80: expected at most ten fields of eight columns', 81, len(line))
      end if
      width = merge(16, 8, large)
      do k = 1, 64/width
         first = 9 + (k - 1)*width
         last = first + width - 1
         if (first <= len(line)) then
            call push(card, line(first:min(last, len(line))), at, first, last, errors)
         else
            call push(card, '', at, first, last, errors)
         end if
      end do
      if (len(line) <= 72) return
      card%marker = adjustl(line(73:min(80, len(line))))
      if (card%marker /= '' .and. scan(card%marker(1:1), '+*') == 0) call errors%add(at, ''''//trim(card%marker)// &
         ''' in columns 73 to 80: expected a continuation mark that begins with + or *, or blanks', 73, min(80, len(line)))
   end subroutine cut_fixed

   !> Free field: entries between commas, eight (large: four) of them, and one more for the continuation mark.
   subroutine cut_free(line, comma, at, card, large, errors)
      character(*), intent(in)             :: line
      integer, intent(in)                  :: comma, at
      type(card_type), intent(inout)       :: card
      logical, intent(in)                  :: large
      type(deck_error_list), intent(inout) :: errors
      integer :: k, first, last, most

      most = merge(4, 8, large)
      first = comma + 1
      do k = 1, most
         last = min(first - 1, len(line))
         do while (last < len(line))
            if (line(last + 1:last + 1) == ',') exit
            last = last + 1
         end do
         call push(card, line(first:last), at, first, max(first, last), errors)
         first = last + 2
      end do
      if (first > len(line)) return
      card%marker = adjustl(line(first:))
      if (index(line(first:), ',') > 0 .or. scan(card%marker(1:1), '+*') == 0) then
         call errors%add(at, 'more than '//integer_text(most)//' entries behind the name: go on in a continuation line', &
                         first, len(line))
      end if
   end subroutine cut_free

   !> One more field: ENTRY without the blanks around it, in capitals.
   subroutine push(card, entry, at, first, last, errors)
      type(card_type), intent(inout)       :: card
      character(*), intent(in)             :: entry
      integer, intent(in)                  :: at, first, last
      type(deck_error_list), intent(inout) :: errors
      type(card_field), allocatable :: wider(:)
      integer :: from, to, i, code

      if (card%n == size(card%fields)) then
         allocate (wider(2*card%n))
         wider(:card%n) = card%fields
         call move_alloc(wider, card%fields)
      end if
      card%n = card%n + 1
      from = 1
      do while (from <= len(entry))
         if (iachar(entry(from:from)) /= blank) exit
         from = from + 1
      end do
      to = len(entry)
      do while (to >= from)
         if (iachar(entry(to:to)) /= blank) exit
         to = to - 1
      end do
      associate (field => card%fields(card%n))
         field%line = at
         field%first = first
         field%last = last
         field%length = min(to - from + 1, field_width)
         field%text = ''
         do i = 1, field%length
            code = iachar(entry(from + i - 1:from + i - 1))
            if (code >= iachar('a') .and. code <= iachar('z')) code = code - 32
            field%text(i:i) = achar(code)
         end do
      end associate
      if (to - from + 1 > field_width) call errors%add(at, card%where_is(card%n)//': an entry of more than '// &
                                                       integer_text(field_width)//' characters', first, last)
   end subroutine push

   !> Words for data field K: 'CQUAD4, field 7'; NASTRAN counts 2 to 9 on every line of a card.
   pure function where_is(self, k) result(words)
      class(card_type), intent(in) :: self
      integer, intent(in)          :: k
      character(:), allocatable    :: words

      words = trim(self%name)//', field '//integer_text(modulo(k - 1, 8) + 2)
      if (k > 8) words = words//' of continuation '//integer_text((k - 1)/8)
   end function where_is

   !> An error about data field K, its place and columns taken from the card.
   subroutine field_error(self, k, message, errors)
      class(card_type), intent(in)         :: self
      integer, intent(in)                  :: k
      character(*), intent(in)             :: message
      type(deck_error_list), intent(inout) :: errors

      if (k >= 1 .and. k <= self%n) then
         associate (field => self%fields(k))
            call errors%add(field%line, self%where_is(k)//', '//message, field%first, field%last)
         end associate
      else
         call errors%add(self%line, self%where_is(k)//', '//message)
      end if
   end subroutine field_error

end module card_lines
