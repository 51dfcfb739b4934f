!> Compares a result file with its reference, number by number, with a tolerance for each quantity.
!!
!!     compare_results TOLERANCES REFERENCE ACTUAL [MERGED]
!!
!! Files that end in `.csv` are compared by column name, all others line by line as listings. Differences are also: missing or
!! surplus lines, rows, columns or words; another word; a word for a number; NaN, Infinity or an overflow field (****) in either
!! file, even in both; an empty file. MERGED receives REFERENCE, with the lines of ACTUAL in place of those that differ; it stands for
!! ACTUAL only where both have as many lines, so that the caller compares the two. Exit status: 0 equal within tolerance; 1
!! different, the differences on standard output; 2 wrong usage or unreadable file.
program compare_results
   use, intrinsic :: iso_fortran_env, only: real64
   use comparison_rules, only: rule, rule_set, read_rules, csv_rule, listing_rule, find_block, allowed
   use comparison_text, only: argument, give_up, text_file, open_text, next_line, close_text, next_token, next_field, number_kind, &
                              number_value, same_integer, defect, text_of, not_a_number, an_integer
   implicit none

   integer, parameter :: most_shown = 20

   !> Where the comparison stands, and what it found.
   type :: findings
      character(len=:), allocatable :: file        !! the actual file
      integer :: line = 0
      integer :: count = 0                         !! differences
      integer :: shown = 0                         !! those printed
      integer :: surplus = 0                       !! rows of paths that the reference has more than the actual file
   end type findings

   type(rule_set) :: rules
   type(text_file) :: reference, actual
   type(findings) :: found
   character(len=:), allocatable :: message
   integer :: merged = 0                           ! unit, 0: none

   ! ---- what to compare ----
   if (command_argument_count() < 3 .or. command_argument_count() > 4) &
      call give_up('usage: compare_results TOLERANCES REFERENCE ACTUAL [MERGED]')
   if (is_csv(argument(2)) .neqv. is_csv(argument(3))) call give_up('one file is a .csv, the other is not')
   call read_rules(argument(1), rules, message)
   if (message /= '') call give_up(message)
   call open_text(reference, argument(2), message)
   if (message /= '') call give_up(message)
   call open_text(actual, argument(3), message)
   if (message /= '') call give_up(message)
   found%file = actual%name
   if (command_argument_count() == 4) call open_merged(argument(4), merged)

   ! ---- compare ----
   if (is_csv(actual%name)) then
      call compare_csv(rules, reference, actual, found)
   else
      call compare_listing(rules, reference, actual, found)
   end if
   call compare_length(reference, actual, found)
   call close_text(reference)
   call close_text(actual)
   if (merged /= 0) close (merged)

   ! ---- tell ----
   if (found%count == 0) stop 0, quiet=.true.
   print '(a)', found%file//': differences from '//reference%name//': '//text_of(found%count)// &
      ', shown: '//text_of(found%shown)
   stop 1, quiet=.true.

contains

   !> Listings: token by token. The titles of the tolerance file open the tables; a table ends at the
   !! next title, or at the first blank line below a row, which is a line that starts with a number.
   subroutine compare_listing(rules, reference, actual, found)
      type(rule_set), intent(in) :: rules
      type(text_file), intent(inout) :: reference, actual
      type(findings), intent(inout) :: found
      character(len=:), allocatable :: line_r, line_a
      integer :: table, block, first, last, position, before
      logical :: more, row_seen

      table = 0
      row_seen = .false.
      do
         call next_pair(reference, actual, line_r, line_a, found, more)
         if (.not. more) return
         before = found%count
         block = find_block(rules, line_r)
         if (block == 0) then
            position = 1
            call next_token(line_r, position, first, last)
            if (first == 0) then
               if (row_seen) table = 0
            else if (number_kind(line_r(first:last)) /= not_a_number) then
               row_seen = .true.
            end if
            block = table
         else if (.not. rules%blocks(block)%one_line) then
            table = block
            row_seen = .false.
            block = 0                              ! the title itself stands outside its table
         end if
         if (same_text(line_r, line_a)) then
            call report_defect(line_r, line_a, found)
         else
            call compare_tokens(rules, block, line_r, line_a, found)
         end if
         call merge_lines(found%count == before, line_r, line_a)
         if (table == 0) cycle
         if (.not. rules%blocks(table)%is_path) cycle
         found%surplus = found%surplus + path_rows(reference, found, merged) - path_rows(actual, found, 0)
         table = 0
      end do
   end subroutine compare_listing

   !> Read past the table of a path, up to the blank line below its rows: how many there are. A row is made of numbers.
   integer function path_rows(file, found, copy) result(rows)
      type(text_file), intent(inout) :: file
      type(findings), intent(inout) :: found
      integer, intent(in) :: copy                  !! unit that receives the lines, 0: none
      character(len=:), allocatable :: line, message
      integer :: position, first, last
      logical :: more

      rows = 0
      do
         message = ''
         call next_line(file, line, more, message)
         if (message /= '') call give_up(message)
         position = 1
         if (more) call next_token(line, position, first, last)
         if (.not. more) exit
         if (copy /= 0) write (copy, '(a)') line
         if (first == 0 .and. rows > 0) exit
         if (first == 0) cycle
         call report_defect(line, line, found)
         if (rows > 0 .or. number_kind(line(first:last)) /= not_a_number) rows = rows + 1
      end do
      found%line = file%line_number
      if (rows == 0) call report(found, 'path', 'nothing', 'nothing', 'never without a row')
   end function path_rows

   !> One line of a listing; `block` says which tolerances hold.
   subroutine compare_tokens(rules, block, line_r, line_a, found)
      type(rule_set), intent(in) :: rules
      integer, intent(in) :: block
      character(len=*), intent(in) :: line_r, line_a
      type(findings), intent(inout) :: found
      type(rule) :: limit
      integer :: column, at_r, at_a, first_r, last_r, first_a, last_a

      at_r = 1
      at_a = 1
      column = 0
      do
         column = column + 1
         call next_token(line_r, at_r, first_r, last_r)
         call next_token(line_a, at_a, first_a, last_a)
         if (first_r == 0 .and. first_a == 0) return
         if (first_r == 0) then
            call report(found, 'token '//text_of(column), 'nothing', line_a(first_a:last_a), 'the same words')
         else if (first_a == 0) then
            call report(found, 'token '//text_of(column), line_r(first_r:last_r), 'nothing', 'the same words')
         else if (same_text(line_r(first_r:last_r), line_a(first_a:last_a))) then
            call report_defect(line_r(first_r:last_r), line_a(first_a:last_a), found)
         else
            limit = listing_rule(rules, block, column)
            call compare_values(limit, .true., line_r(first_r:last_r), line_a(first_a:last_a), found)
         end if
      end do
   end subroutine compare_tokens

   !> CSV files: the header must be the same, then the columns are compared by name.
   subroutine compare_csv(rules, reference, actual, found)
      type(rule_set), intent(in) :: rules
      type(text_file), intent(inout) :: reference, actual
      type(findings), intent(inout) :: found
      character(len=:), allocatable :: line_r, line_a
      type(rule), allocatable :: columns(:)
      integer :: i, at, first, last
      logical :: more, usable
      integer :: before

      call next_pair(reference, actual, line_r, line_a, found, more)
      if (.not. more) return
      call report_defect(line_r, line_a, found)
      usable = same_text(line_r, line_a)
      call merge_lines(usable, line_r, line_a)
      if (.not. usable) call report(found, 'header', line_r, line_a, 'the same header')
      allocate (columns(count([(line_r(i:i) == ',', i=1, len(line_r))]) + 1))
      at = 1
      do i = 1, size(columns)
         call next_field(line_r, at, first, last)
         columns(i) = csv_rule(rules, trim(adjustl(line_r(first:last))))
      end do
      if (.not. usable) call compare_fields(columns, line_r, line_a, found)      ! names the titles
      do
         call next_pair(reference, actual, line_r, line_a, found, more)
         if (.not. more) return
         before = found%count
         if (same_text(line_r, line_a)) then
            call report_defect(line_r, line_a, found)
         else if (usable) then
            call compare_fields(columns, line_r, line_a, found)
         end if
         call merge_lines(usable .and. found%count == before, line_r, line_a)
      end do
   end subroutine compare_csv

   subroutine open_merged(name, unit)
      character(len=*), intent(in) :: name
      integer, intent(out) :: unit
      integer :: status

      open (newunit=unit, file=name, access='stream', form='formatted', action='write', status='replace', iostat=status)
      if (status /= 0) call give_up(name//': cannot be written')
   end subroutine open_merged

   !> One line of MERGED, where it is wanted: that of the reference, or where they are not equal that of the actual file.
   subroutine merge_lines(equal, line_r, line_a)
      logical, intent(in) :: equal
      character(len=*), intent(in) :: line_r, line_a

      if (merged == 0) return
      if (equal) then
         write (merged, '(a)') line_r
      else
         write (merged, '(a)') line_a
      end if
   end subroutine merge_lines

   !> One row of a CSV file.
   subroutine compare_fields(columns, line_r, line_a, found)
      type(rule), intent(in) :: columns(:)
      character(len=*), intent(in) :: line_r, line_a
      type(findings), intent(inout) :: found
      integer :: i, at_r, at_a, first_r, last_r, first_a, last_a

      at_r = 1
      at_a = 1
      i = 0
      do while (at_r <= len(line_r) + 1 .and. at_a <= len(line_a) + 1)
         i = i + 1
         call next_field(line_r, at_r, first_r, last_r)
         call next_field(line_a, at_a, first_a, last_a)
         if (same_text(line_r(first_r:last_r), line_a(first_a:last_a))) then
            call report_defect(line_r(first_r:last_r), line_a(first_a:last_a), found)
         else if (i <= size(columns)) then
            call compare_values(columns(i), .false., line_r(first_r:last_r), line_a(first_a:last_a), found)
         else
            call report(found, 'column '//text_of(i), line_r(first_r:last_r), line_a(first_a:last_a), 'the same text')
         end if
      end do
      if (at_r <= len(line_r) + 1) call report(found, 'row', 'more fields', text_of(i)//' fields', 'as many fields')
      if (at_a <= len(line_a) + 1) call report(found, 'row', text_of(i)//' fields', 'more fields', 'as many fields')
   end subroutine compare_fields

   !> Two words or fields that differ as text. With `strict_integers` an integer reference wants the same integer.
   subroutine compare_values(limit, strict_integers, text_r, text_a, found)
      type(rule), intent(in) :: limit
      logical, intent(in) :: strict_integers
      character(len=*), intent(in) :: text_r, text_a
      type(findings), intent(inout) :: found
      character(len=:), allocatable :: token_r, token_a
      real(real64) :: value_r, value_a
      integer :: kind_r, kind_a
      logical :: finite_r, finite_a
      character(len=13) :: tolerance

      if (defect(text_r) /= '' .or. defect(text_a) /= '') then
         call report_defect(text_r, text_a, found)
         return
      end if
      token_r = trim(adjustl(text_r))
      token_a = trim(adjustl(text_a))
      kind_r = number_kind(token_r)
      kind_a = number_kind(token_a)
      if (kind_r == not_a_number .or. kind_a == not_a_number) then
         call report(found, limit%name, text_r, text_a, 'the same text')
      else if (strict_integers .and. kind_r == an_integer) then
         if (same_integer(token_r, token_a)) return
         call report(found, limit%name, token_r, token_a, 'the same integer')
      else
         call number_value(token_r, value_r, finite_r)
         call number_value(token_a, value_a, finite_a)
         if (finite_r .and. finite_a) then
            if (abs(value_a - value_r) <= allowed(limit, value_r)) return
         end if
         write (tolerance, '(es9.2e3)') allowed(limit, value_r)
         call report(found, limit%name, token_r, token_a, trim(tolerance))
      end if
   end subroutine compare_values

   !> Tell where one of two texts has NaN, Infinity or an overflow field.
   subroutine report_defect(text_r, text_a, found)
      character(len=*), intent(in) :: text_r, text_a
      type(findings), intent(inout) :: found

      if (defect(text_r) /= '') then
         call report(found, defect(text_r), text_r, text_a, 'never')
      else if (defect(text_a) /= '') then
         call report(found, defect(text_a), text_r, text_a, 'never')
      end if
   end subroutine report_defect

   !> The next line of both files. `more` is false where one of them has ended.
   subroutine next_pair(reference, actual, line_r, line_a, found, more)
      type(text_file), intent(inout) :: reference, actual
      character(len=:), allocatable, intent(inout) :: line_r, line_a
      type(findings), intent(inout) :: found
      logical, intent(out) :: more
      character(len=:), allocatable :: message
      logical :: more_r, more_a

      message = ''
      call next_line(reference, line_r, more_r, message)
      call next_line(actual, line_a, more_a, message)
      if (message /= '') call give_up(message)
      more = more_r .and. more_a
      found%line = actual%line_number
   end subroutine next_pair

   !> Read the rest of the longer file and compare the number of lines; then look at the last line end.
   subroutine compare_length(reference, actual, found)
      type(text_file), intent(inout) :: reference, actual
      type(findings), intent(inout) :: found
      character(len=:), allocatable :: line_r, line_a, message
      logical :: more_r, more_a

      message = ''
      do
         call next_line(reference, line_r, more_r, message)
         call next_line(actual, line_a, more_a, message)
         if (message /= '') call give_up(message)
         if (.not. (more_r .or. more_a)) exit
      end do
      found%line = actual%line_number
      if (reference%line_number /= actual%line_number + found%surplus) then
         call report(found, 'lines', text_of(reference%line_number), text_of(actual%line_number + found%surplus), &
                     'as many lines', always=.true.)
      else if (reference%line_number == 0) then
         call report(found, 'lines', '0', '0', 'never an empty file', always=.true.)
      end if
      if (reference%complete .neqv. actual%complete) then
         call report(found, 'end of the last line', trim(merge('there  ', 'missing', reference%complete)), &
                     trim(merge('there  ', 'missing', actual%complete)), 'the same', always=.true.)
      end if
   end subroutine compare_length

   !> Count a difference, and print it unless enough have been printed; `always` prints it all the same.
   subroutine report(found, quantity, value_r, value_a, allowed_text, always)
      type(findings), intent(inout) :: found
      character(len=*), intent(in) :: quantity, value_r, value_a, allowed_text
      logical, intent(in), optional :: always
      logical :: show

      found%count = found%count + 1
      show = found%shown < most_shown
      if (present(always)) show = show .or. always
      if (.not. show) return
      found%shown = found%shown + 1
      print '(a)', found%file//':'//text_of(found%line)//': '//quantity//': reference '//quoted(value_r)// &
         ', actual '//quoted(value_a)//', allowed: '//adjustl(allowed_text)
   end subroutine report

   !> Words in quotation marks, numbers as they stand; long lines cut.
   function quoted(text)
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: quoted
      integer, parameter :: longest = 72

      if (number_kind(trim(text)) /= not_a_number) then
         quoted = trim(text)
      else if (len(text) > longest) then
         quoted = "'"//text(:longest)//"...'"
      else
         quoted = "'"//text//"'"
      end if
   end function quoted

   !> Equal to the last blank, which `==` would pass over.
   pure logical function same_text(a, b)
      character(len=*), intent(in) :: a, b

      same_text = .false.
      if (len(a) == len(b)) same_text = a == b
   end function same_text

   pure logical function is_csv(name)
      character(len=*), intent(in) :: name

      is_csv = .false.
      if (len(name) >= 4) is_csv = name(len(name) - 3:) == '.csv'
   end function is_csv

end program compare_results
