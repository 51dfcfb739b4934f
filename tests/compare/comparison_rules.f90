!> The tolerance file: the tolerance of each quantity. tolerances.txt describes its syntax.
module comparison_rules
   use, intrinsic :: iso_fortran_env, only: real64
   use comparison_text, only: text_file, open_text, next_line, close_text, next_token, word, &
                              number_kind, number_value, not_a_number, an_integer, text_of
   implicit none
   private

   public :: rule, rule_set, read_rules, csv_rule, listing_rule, find_block, allowed

   !> One quantity: |actual - reference| <= absolute + relative |reference|.
   type :: rule
      character(len=:), allocatable :: name
      integer :: column = 0                        !! token in a line of a block; 0 = any other
      real(real64) :: relative = 0.0_real64        !! 0 <= relative < 1
      real(real64) :: absolute = 0.0_real64        !! >= 0, in the unit of the quantity
   end type rule

   !> The columns of one kind of table, or of one kind of line.
   type :: block_rules
      character(len=:), allocatable :: title       !! its words, one blank between them
      logical :: one_line = .false.
      logical :: is_path = .false.
      type(rule), allocatable :: columns(:)
   end type block_rules

   !> Everything the tolerance file says.
   type :: rule_set
      type(rule), allocatable :: csv(:), listing(:)
      type(block_rules), allocatable :: blocks(:)
   end type rule_set

contains

   !> Read the tolerance file. On the first error `message` names file, line and what was expected;
   !! otherwise it is empty.
   subroutine read_rules(name, rules, message)
      character(len=*), intent(in) :: name
      type(rule_set), intent(out) :: rules
      character(len=:), allocatable, intent(out) :: message
      type(text_file) :: file
      character(len=:), allocatable :: line, error
      logical :: found

      allocate (rules%csv(0), rules%listing(0), rules%blocks(0))
      call open_text(file, name, message)
      if (message /= '') return
      error = ''
      do
         call next_line(file, line, found, message)
         if (.not. found) exit
         call read_statement(uncommented(line), rules, error)
         if (error /= '') then
            message = name//':'//text_of(file%line_number)//': '//error
            exit
         end if
      end do
      call close_text(file)
   end subroutine read_rules

   !> Take one line of the tolerance file into the rules.
   subroutine read_statement(line, rules, error)
      character(len=*), intent(in) :: line
      type(rule_set), intent(inout) :: rules
      character(len=:), allocatable, intent(inout) :: error
      integer :: last

      select case (word(line, 1))
      case ('')
      case ('csv')
         call add_rule(line, 2, 3, rules%csv, error)
      case ('listing')
         if (word(line, 2) /= '*') error = "expected '*' after 'listing'"
         if (error == '') call add_rule(line, 2, 3, rules%listing, error)
      case ('table', 'line', 'path')
         call add_block(line, rules%blocks, error)
      case ('column')
         last = size(rules%blocks)
         if (last == 0) then
            error = "'column' before the first 'table' or 'line'"
         else if (rules%blocks(last)%is_path) then
            error = "a path has no columns to compare"
         else
            call add_rule(line, 3, 4, rules%blocks(last)%columns, error)
         end if
      case default
         error = "expected csv, listing, table, line, path or column, not '"//word(line, 1)//"'"
      end select
   end subroutine read_statement

   !> Append the rule of a statement whose quantity is word `at_name` and whose tolerance starts with
   !! word `at_tolerance`; in a block word 2 is the number of the column.
   subroutine add_rule(line, at_name, at_tolerance, list, error)
      character(len=*), intent(in) :: line
      integer, intent(in) :: at_name, at_tolerance
      type(rule), allocatable, intent(inout) :: list(:)
      character(len=:), allocatable, intent(inout) :: error
      type(rule) :: new
      integer :: i

      new%name = word(line, at_name)
      if (new%name == '') error = 'expected the name of a quantity'
      if (at_name == 3) call read_column(word(line, 2), new%column, error)
      if (error == '') call read_tolerance(line, at_tolerance, new, error)
      do i = 1, size(list)
         if (at_name == 3) then
            if (list(i)%column == new%column) error = 'column '//word(line, 2)//' has two tolerances'
         else
            if (list(i)%name == new%name) error = new%name//' has two tolerances'
         end if
      end do
      if (error == '') call append_rule(list, new)
   end subroutine add_rule

   !> The number of a column, 0 for `*`.
   subroutine read_column(token, column, error)
      character(len=*), intent(in) :: token
      integer, intent(out) :: column
      character(len=:), allocatable, intent(inout) :: error
      integer :: status

      column = 0
      if (token == '*') return
      status = 1
      if (number_kind(token) == an_integer) read (token, *, iostat=status) column
      if (status /= 0 .or. column < 1) error = "expected the number of a column or '*', not '"//token//"'"
   end subroutine read_column

   !> `exact`, or `relative R absolute A`, and nothing behind it.
   subroutine read_tolerance(line, at, new, error)
      character(len=*), intent(in) :: line
      integer, intent(in) :: at
      type(rule), intent(inout) :: new
      character(len=:), allocatable, intent(inout) :: error

      if (word(line, at) == 'exact') then
         if (word(line, at + 1) /= '') error = "text behind 'exact'"
         return
      end if
      if (word(line, at) /= 'relative' .or. word(line, at + 2) /= 'absolute' .or. word(line, at + 4) /= '') then
         error = "expected 'exact' or 'relative R absolute A'"
         return
      end if
      call read_limit(word(line, at + 1), new%relative, error)
      call read_limit(word(line, at + 3), new%absolute, error)
      if (error == '' .and. new%relative >= 1.0_real64) error = 'relative must be less than 1'
   end subroutine read_tolerance

   subroutine read_limit(token, value, error)
      character(len=*), intent(in) :: token
      real(real64), intent(inout) :: value
      character(len=:), allocatable, intent(inout) :: error
      logical :: valid

      valid = number_kind(token) /= not_a_number
      if (valid) call number_value(token, value, valid)
      if (valid) valid = value >= 0.0_real64
      if (.not. valid) error = "expected a number not below zero, not '"//token//"'"
   end subroutine read_limit

   !> Open a block: `table TITLE`, `line TITLE` or `path TITLE`.
   subroutine add_block(line, blocks, error)
      character(len=*), intent(in) :: line
      type(block_rules), allocatable, intent(inout) :: blocks(:)
      character(len=:), allocatable, intent(inout) :: error
      type(block_rules) :: new
      integer :: i

      new%title = word(line, 2)
      i = 3
      do while (word(line, i) /= '')
         new%title = new%title//' '//word(line, i)
         i = i + 1
      end do
      new%one_line = word(line, 1) == 'line'
      new%is_path = word(line, 1) == 'path'
      allocate (new%columns(0))
      if (new%title == '') error = "expected a title after '"//word(line, 1)//"'"
      do i = 1, size(blocks)
         if (blocks(i)%title == new%title) error = 'the title '//new%title//' stands here twice'
      end do
      if (error == '') call append_block(blocks, new)
   end subroutine add_block

   !> The rule of a CSV column: its own, else that of `*`, else exact.
   function csv_rule(rules, name) result(found)
      type(rule_set), intent(in) :: rules
      character(len=*), intent(in) :: name
      type(rule) :: found
      integer :: i

      do i = 1, size(rules%csv)
         if (rules%csv(i)%name == name) then
            found = rules%csv(i)
            exit
         end if
         if (rules%csv(i)%name == '*') found = rules%csv(i)
      end do
      found%name = name
   end function csv_rule

   !> The rule of token `column` in a line of block `block` (0: outside all blocks): its own, else that of `*`
   !! in the block, else that of the listing, else exact.
   function listing_rule(rules, block, column) result(found)
      type(rule_set), intent(in) :: rules
      integer, intent(in) :: block, column
      type(rule) :: found
      integer :: i

      found%name = 'token '//text_of(column)
      if (size(rules%listing) > 0) then
         found%relative = rules%listing(1)%relative
         found%absolute = rules%listing(1)%absolute
      end if
      if (block == 0) return
      do i = 1, size(rules%blocks(block)%columns)
         associate (candidate => rules%blocks(block)%columns(i))
            if (candidate%column == column) then
               found = candidate
               exit
            end if
            if (candidate%column == 0) found = candidate
         end associate
      end do
   end function listing_rule

   !> The block whose title the line starts with, blanks before and between words and a comma or colon behind one aside; the longest one; 0 if none.
   integer function find_block(rules, line)
      type(rule_set), intent(in) :: rules
      character(len=*), intent(in) :: line
      integer :: i, length

      find_block = 0
      length = 0
      do i = 1, size(rules%blocks)
         associate (title => rules%blocks(i)%title)
            if (len(title) > length .and. starts_with(line, title)) then
               find_block = i
               length = len(title)
            end if
         end associate
      end do
   end function find_block

   pure logical function starts_with(line, title)
      character(len=*), intent(in) :: line, title
      integer :: at_line, at_title, first, last, first_title, last_title

      at_line = 1
      at_title = 1
      starts_with = .false.
      do
         call next_token(title, at_title, first_title, last_title)
         if (first_title == 0) exit
         call next_token(line, at_line, first, last)
         if (first == 0) return
         if (scan(line(last:last), ',:') > 0 .and. scan(title(last_title:last_title), ',:') == 0) last = last - 1
         if (last - first /= last_title - first_title) return
         if (line(first:last) /= title(first_title:last_title)) return
      end do
      starts_with = .true.
   end function starts_with

   !> The deviation allowed from a reference value, same unit. Zero as reference leaves the absolute part only.
   pure real(real64) function allowed(limit, reference)
      type(rule), intent(in) :: limit
      real(real64), intent(in) :: reference

      allowed = limit%absolute + limit%relative*abs(reference)
   end function allowed

   !> The line up to a `#` that starts a word.
   pure function uncommented(line)
      character(len=*), intent(in) :: line
      character(len=:), allocatable :: uncommented
      integer :: position, first, last

      uncommented = line
      position = 1
      do
         call next_token(line, position, first, last)
         if (first == 0) return
         if (line(first:first) == '#') exit
      end do
      uncommented = line(:first - 1)
   end function uncommented

   subroutine append_rule(list, new)
      type(rule), allocatable, intent(inout) :: list(:)
      type(rule), intent(in) :: new
      type(rule), allocatable :: longer(:)
      integer :: n

      n = size(list)
      allocate (longer(n + 1))
      longer(:n) = list
      longer(n + 1) = new
      call move_alloc(longer, list)
   end subroutine append_rule

   subroutine append_block(list, new)
      type(block_rules), allocatable, intent(inout) :: list(:)
      type(block_rules), intent(in) :: new
      type(block_rules), allocatable :: longer(:)
      integer :: n

      n = size(list)
      allocate (longer(n + 1))
      longer(:n) = list
      longer(n + 1) = new
      call move_alloc(longer, list)
   end subroutine append_block

end module comparison_rules
