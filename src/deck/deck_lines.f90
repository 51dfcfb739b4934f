!> Scans a line of a deck for its end, its card part and its first comma; interprets an INCLUDE: recognises its line, finds whether its
!! name goes on on the next line, and takes the name; interprets a line that repeats the card before it with some fields changed.
!! Source of the last: MSC Nastran, Getting Started Guide, replication of bulk data.
module deck_lines
   use c_library, only: is_regular_file
   use, intrinsic :: iso_fortran_env, only: int8
   use field_rules, only: parse_integer, parse_real
   use kinds, only: long, wp
   use text_tools, only: integer_text, upper
   implicit none
   private

   public :: scan_line, executive_control, is_include, is_open, file_named_by, path_beside, repeats_of, repeated

   !> Place of a line. Its card part is the line without its comment ($ to the end) and without trailing blanks.
   type, public :: line_place
      integer(long) :: start  = 0 !! byte of its file, from 1
      integer       :: length = 0 !! of the card part
      integer       :: comma  = 0 !! column of the first comma in the card part up to column 72, 0: none
   end type line_place

   integer, parameter :: n_fields = 9, entry_width = 32

   ! classes of bytes
   integer, parameter :: plain = 0, line_feed = 1, carriage_return = 2, dollar = 3, comma = 4, control = 5
   integer :: code
   integer(int8), parameter :: meaning(0:255) = int([(control, code = 0, 8), plain, line_feed, control, control, carriage_return, &
      (control, code = 14, 31), (plain, code = 32, 35), dollar, (plain, code = 37, 43), comma, (plain, code = 45, 126), &
      control, (plain, code = 128, 255)], int8)

contains

   !> Scan the line of BYTES that begins at START; each byte is examined once.
   pure subroutine scan_line(bytes, start, line, next, bad)
      character(*), intent(in)      :: bytes
      integer(long), intent(in)     :: start
      type(line_place), intent(out) :: line
      integer(long), intent(out)    :: next    !! start of the next line
      integer, intent(out)          :: bad     !! code of the first byte that no text file holds (a control character other
                                               !! than a tab), -1: none
      integer(long) :: i, finish
      logical :: in_card ! still in the card part

      bad = -1
      in_card = .true.
      line%start = start
      finish = len(bytes, long)
      next = finish + 1
      do i = start, len(bytes, long)
         select case (meaning(iachar(bytes(i:i))))
         case (plain)
            cycle
         case (comma)
            if (in_card .and. line%comma == 0 .and. i < start + 72) line%comma = int(i - start + 1)
         case (dollar)
            if (in_card) finish = i - 1
            in_card = .false.
         case (carriage_return)
            if (bad < 0 .and. i < len(bytes, long) .and. bytes(i + 1:min(i + 1, len(bytes, long))) /= achar(10)) &
               bad = iachar(bytes(i:i)) ! it does not end its line
            if (in_card) finish = i - 1
            in_card = .false.
         case (line_feed)
            if (in_card) finish = i - 1
            next = i + 1
            exit
         case default
            if (bad < 0) bad = iachar(bytes(i:i))
         end select
      end do
      line%length = len_trim(bytes(start:finish))
   end subroutine scan_line

   !> Whether LINE (its card part) is an INCLUDE: the word, followed by a blank, a quote or an equals sign.
   pure logical function is_include(line)
      character(*), intent(in) :: line
      integer :: first

      is_include = .false.
      first = verify(line, ' ')
      if (first == 0) return
      if (line(first:first) /= 'I' .and. line(first:first) /= 'i') return ! the usual case
      is_include = upper(line(first:min(first + 6, len(line)))) == 'INCLUDE'
      if (is_include .and. len(line) > first + 6) is_include = scan(line(first + 7:first + 7), ' ''"=') == 1
   end function is_include

   !> Whether STATEMENT, an INCLUDE, ends within a name in quotes: the name goes on on the next line.
   pure logical function is_open(statement)
      character(*), intent(in) :: statement
      integer :: quote

      quote = scan(statement, '''"')
      is_open = quote > 0
      if (is_open) is_open = index(statement(quote + 1:), statement(quote:quote)) == 0
   end function is_open

   !> The name of the file in STATEMENT, an INCLUDE, with slashes; empty where there is none.
   pure function file_named_by(statement) result(path)
      character(*), intent(in)  :: statement
      character(:), allocatable :: path
      integer :: closing, k

      path = adjustl(statement)
      path = trim(adjustl(path(8:)))
      if (index(path, '=') == 1) path = trim(adjustl(path(2:)))
      if (scan(path, '''"') == 1) then ! in quotes, the last character of the statement is the closing one
         closing = index(path(2:), path(1:1))
         path = path(2:merge(closing, 0, len(path) == closing + 1))
      end if
      do k = 1, len(path)
         if (path(k:k) == '\') path(k:k) = '/' ! a deck from Windows
      end do
   end function file_named_by

   !> The PATH that an INCLUDE in the file PARENT names: beside this file, or else, if it exists there, beside the file DECK.
   function path_beside(path, parent, deck) result(full)
      character(*), intent(in)  :: path, parent, deck
      character(:), allocatable :: full

      full = path
      if (path(1:1) == '/') return
      full = parent(:index(parent, '/', back=.true.))//path
      if (is_regular_file(full)) return
      if (is_regular_file(deck(:index(deck, '/', back=.true.))//path)) full = deck(:index(deck, '/', back=.true.))//path
   end function path_beside

   !> Where executive control begins and ends in BYTES: the first lines with SOL, and with CEND or BEGIN; 0 where there is no CEND.
   pure function executive_control(bytes) result(range)
      character(*), intent(in) :: bytes
      integer(long) :: range(2), next, start
      character(80) :: line

      range = [len(bytes, long) + 1, 0_long]
      start = 1
      do while (start <= len(bytes, long))
         next = index(bytes(start:), achar(10), kind=long)
         if (next == 0) next = len(bytes, long) - start + 2
         line = upper(adjustl(bytes(start:min(start + next - 2, start + 78))))
         if (index(line, 'SOL ') == 1) range(1) = min(range(1), start)
         if (range(2) == 0 .and. (index(line, 'BEGIN') == 1 .or. index(line, 'CEND') == 1)) range(2) = start
         if (index(line, 'CEND') == 1) return
         start = start + next
      end do
      range(2) = 0
   end function executive_control

   !> How many cards LINE repeats: 0 where it repeats none, 1 for '=, *(1), =, ==' and 'PBAR,102,=,==', N for '=(N)' and '=N', which
   !! repeat the STEPS of a line before; -1 where these cannot be read.
   integer function repeats_of(line, steps) result(n)
      character(*), intent(in) :: line
      character(entry_width), intent(inout) :: steps(n_fields) !! the entries of LINE where it has some
      character(entry_width) :: entries(n_fields)
      logical :: ok

      n = 0
      if (line(:min(1, len(line))) /= '=') then
         if (index(line, ',=') == 0) return
         entries = entries_of(line) ! a card of its own name that keeps entries
         if (.not. any(entries(2:) == '=' .or. entries(2:) == '==')) return
         n = 1
         steps = entries
         return
      end if
      if (scan(line, ', ') == 2) then
         if (index(line, ',') > 0 .or. len(line) > 8) n = 1
         if (n == 1) steps = entries_of(line)
         return
      end if
      call parse_integer(inside(trim(line(2:))), n, ok)
      if (.not. ok .or. n < 1 .or. steps(1) == '') n = -1
   end function repeats_of

   !> CARD, a line of one card, in free field with its entries changed by STEPS: '=' keeps an entry, '==' this one and all others, *(D) adds
   !! D to it, anything else replaces it. Empty: an entry is no number, or CARD no line that can be repeated.
   function repeated(card, steps) result(line)
      character(*), intent(in) :: card
      character(entry_width), intent(in) :: steps(n_fields)
      character(:), allocatable :: line
      character(entry_width) :: entries(n_fields)
      real(wp) :: step, value
      integer  :: k, i_step, i_value
      logical  :: ok, of_integers, was_integer

      entries = entries_of(card)
      line = ''
      if (entries(1) == '' .or. scan(entries(1)(:1), '+*=') > 0 .or. index(entries(1), '*') > 0) return
      do k = 1, n_fields
         associate (entry => entries(k), words => steps(k))
            if (words == '==') exit
            if (words == '=') cycle
            if (index(words, '*') /= 1) then
               entry = words
               cycle
            end if
            if (entry == '') entry = '0'
            call parse_integer(trim(entry), i_value, was_integer)
            call parse_integer(inside(words(2:)), i_step, of_integers)
            if (was_integer .and. of_integers) then
               entry = integer_text(i_value + i_step)
               cycle
            end if
            call parse_real(trim(entry), value, ok)
            if (ok) call parse_real(inside(words(2:)), step, ok)
            if (.not. ok) return
            write (entry, '(es24.16)') value + step
            entry = adjustl(entry)
         end associate
      end do
      line = trim(entries(1))
      do k = 2, n_fields
         line = line//','//trim(entries(k))
      end do
   end function repeated

   !> WORDS without the parentheses around them.
   pure function inside(words)
      character(*), intent(in)  :: words
      character(:), allocatable :: inside

      inside = trim(adjustl(words))
      if (len(inside) < 2) return
      if (inside(:1) == '(' .and. inside(len(inside):) == ')') inside = inside(2:len(inside) - 1)
   end function inside

   !> The entries of LINE in free field or in fields of eight columns, capitals.
   pure function entries_of(line) result(entries)
      character(*), intent(in) :: line
      character(entry_width)   :: entries(n_fields)
      integer :: first, k, last

      entries = ''
      first = 1
      do k = 1, n_fields
         if (first > len(line)) return
         if (index(line, ',') > 0) then
            last = first + index(line(first:)//',', ',') - 2
            entries(k) = upper(adjustl(line(first:last)))
            first = last + 2
         else
            entries(k) = upper(adjustl(line(first:min(first + 7, len(line)))))
            first = first + 8
         end if
      end do
   end function entries_of

end module deck_lines
