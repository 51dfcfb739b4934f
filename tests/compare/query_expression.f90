!> Expressions over the rows of a CSV file (tests/README.md): one value for each row, found while the expression is parsed. 0 is
!! false, anything else true; -2^2 is -4; texts allow = and != only. Compared or added values must be finite numbers.
module query_expression
   use, intrinsic :: iso_fortran_env, only: real64
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use comparison_text, only: number_kind, number_value, defect, not_a_number
   use csv_table, only: table, cell_length, column_of
   implicit none
   private

   public :: evaluate, cell_of, equal

   !> Rows of a file, the row of another file that belongs to each, and the number of its group.
   type, public :: selection
      type(table) :: file, other
      integer, allocatable :: rows(:), partners(:), groups(:)
   end type selection

   !> A number for each row, or a text.
   type, public :: row_values
      logical :: is_text = .false.
      real(real64), allocatable :: x(:)
      character(len=cell_length), allocatable :: text(:)
   end type row_values

   !> An expression, and how far it is read.
   type :: reader
      character(len=:), allocatable :: text
      integer :: at = 1
      character(len=:), allocatable :: message         !! the first complaint
      character(len=:), allocatable :: columns         !! names of those read so far, a blank behind each
      type(selection), pointer :: chosen => null()
   end type reader

   ! what stands between two values, from the loosest tie to the tightest
   character(len=3), parameter :: ties(12) = ['or ', 'and', '<= ', '>= ', '!= ', '<  ', '>  ', '=  ', '+  ', '-  ', '*  ', '/  ']
   integer, parameter :: levels(12) = [1, 2, 3, 3, 3, 3, 3, 3, 4, 4, 5, 5]
   integer, parameter :: relations = 3, sums = 4, tightest = 5

contains

   !> The values of an expression. On failure `message` says why, otherwise it is empty. `columns`: the names it uses,
   !! a blank behind each.
   subroutine evaluate(expression, chosen, values, message, columns)
      character(len=*), intent(in) :: expression
      type(selection), intent(in), target :: chosen
      type(row_values), intent(out) :: values
      character(len=:), allocatable, intent(out) :: message, columns
      type(reader) :: source
      character(len=:), allocatable :: rest

      source = reader(text=expression, message='', columns='', chosen=chosen)
      call read_level(source, 1, values)
      rest = next_word(source)
      if (source%at <= len(expression)) call complain(source, 'not understood')
      if (.not. values%is_text) call want_finite(source, values)
      message = source%message
      if (message /= '') message = message//', before the ^ in '//expression(:source%at - 1)//'^'//expression(source%at:)
      columns = source%columns
   end subroutine evaluate

   !> The cell of a column that belongs to row i of those chosen; `found` is false where there is no such column.
   subroutine cell_of(chosen, name, i, cell, found)
      type(selection), intent(in) :: chosen
      character(len=*), intent(in) :: name
      integer, intent(in) :: i
      character(len=cell_length), intent(out) :: cell
      logical, intent(out) :: found
      integer :: column

      cell = ''
      column = 0
      if (index(name, 'other.') == 1 .and. allocated(chosen%partners)) then
         column = column_of(chosen%other, name(7:))
         if (column > 0) cell = chosen%other%cells(column, chosen%partners(i))
      else
         column = column_of(chosen%file, name)
         if (column > 0) cell = chosen%file%cells(column, chosen%rows(i))
      end if
      found = column > 0
   end subroutine cell_of

   !> Values tied by operators of this level and tighter ones.
   recursive subroutine read_level(source, level, a)
      type(reader), intent(inout) :: source
      integer, intent(in) :: level
      type(row_values), intent(out) :: a
      type(row_values) :: b
      integer :: k

      if (level > tightest) then
         call read_signed(source, a)
         return
      else if (level == relations) then
         if (next_is(source, 'not')) then
            call read_level(source, level, a)
            call want_finite(source, a)
            a%x = merge(0.0_real64, 1.0_real64, abs(a%x) > 0.0_real64)
            return
         end if
      end if
      call read_level(source, level + 1, a)
      do
         do k = 1, size(ties)
            if (levels(k) /= level) cycle
            if (next_is(source, trim(ties(k)))) exit
         end do
         if (k > size(ties)) return
         call read_level(source, level + 1, b)
         if (level == relations) then
            call relate(source, trim(ties(k)), a, b)
            return
         end if
         call combine(source, ties(k), a, b)
      end do
   end subroutine read_level

   !> Put into A what an operator makes of A and B.
   subroutine combine(source, tie, a, b)
      type(reader), intent(inout) :: source
      character(len=*), intent(in) :: tie
      type(row_values), intent(inout) :: a
      type(row_values), intent(in) :: b

      call want_numbers(source, a)
      call want_numbers(source, b)
      select case (tie)
      case ('or'); a%x = max(abs(a%x), abs(b%x))
      case ('and'); a%x = min(abs(a%x), abs(b%x))
      case ('+'); a%x = a%x + b%x
      case ('-'); a%x = a%x - b%x
      case ('*'); a%x = a%x*b%x
      case ('/'); a%x = a%x/b%x
      end select
   end subroutine combine

   !> Put 1 into A where it has this relation to B, else 0.
   recursive subroutine relate(source, relation, a, b)
      type(reader), intent(inout) :: source
      character(len=*), intent(in) :: relation
      type(row_values), intent(inout) :: a
      type(row_values), intent(in) :: b
      type(row_values) :: off
      logical :: holds(size(a%x))

      if (a%is_text .and. b%is_text .and. (relation == '=' .or. relation == '!=')) then
         holds = (a%text == b%text) .eqv. relation == '='
      else
         call want_finite(source, a)
         call want_finite(source, b)
         select case (relation)
         case ('<'); holds = a%x < b%x
         case ('>'); holds = a%x > b%x
         case ('<='); holds = a%x <= b%x
         case ('>='); holds = a%x >= b%x
         case ('!='); holds = .not. equal(a%x, b%x)
         case ('=')
            off%x = 0.0_real64*b%x
            if (next_is(source, 'within')) call read_level(source, sums, off)
            call want_finite(source, off)
            holds = abs(a%x - b%x) <= off%x
         end select
      end if
      a = row_values(x=merge(1.0_real64, 0.0_real64, holds))
   end subroutine relate

   recursive subroutine read_signed(source, a)
      type(reader), intent(inout) :: source
      type(row_values), intent(out) :: a
      type(row_values) :: b

      if (next_is(source, '-')) then
         call read_signed(source, a)
         call want_numbers(source, a)
         a%x = -a%x
         return
      end if
      call read_operand(source, a)
      if (.not. next_is(source, '^')) return
      call read_signed(source, b)
      call want_numbers(source, a)
      call want_numbers(source, b)
      where (equal(b%x, anint(b%x)))
         a%x = a%x**nint(b%x)
      elsewhere
         a%x = a%x**b%x
      end where
   end subroutine read_signed

   !> A number, a text, a column, a function, or an expression in parentheses.
   recursive subroutine read_operand(source, a)
      type(reader), intent(inout) :: source
      type(row_values), intent(out) :: a
      character(len=:), allocatable :: word
      logical :: finite
      integer :: n, length

      n = size(source%chosen%rows)
      allocate (a%x(n), source=0.0_real64)
      allocate (a%text(n))
      word = next_word(source)
      source%at = source%at + len(word)
      if (number_kind(word) /= not_a_number) then
         call number_value(word, a%x(1), finite)
         a%x = a%x(1)
      else if (word == 'pi') then
         a%x = acos(-1.0_real64)
      else if (word /= '') then
         if (next_is(source, '(')) then
            call read_function(source, word, a)
         else
            call read_column(source, word, a)
         end if
      else if (next_is(source, '(')) then
         call read_level(source, 1, a)
         call expect(source, ')')
      else if (next_is(source, '"')) then
         length = max(index(source%text(source%at:), '"') - 1, 0)
         a%is_text = .true.
         a%text = source%text(source%at:source%at + length - 1)
         source%at = source%at + length
         call expect(source, '"')
      else
         call complain(source, 'a value is missing')
      end if
   end subroutine read_operand

   !> A column: numbers where all its cells are some, else texts.
   subroutine read_column(source, name, a)
      type(reader), intent(inout) :: source
      character(len=*), intent(in) :: name
      type(row_values), intent(inout) :: a
      logical :: usable
      integer :: i

      if (index(' '//source%columns, ' '//name//' ') == 0) source%columns = source%columns//name//' '
      do i = 1, size(a%x)
         call cell_of(source%chosen, name, i, a%text(i), usable)
         if (.not. usable) call complain(source, "there is no column '"//name//"'")
         if (defect(a%text(i)) /= '') call complain(source, "'"//trim(a%text(i))//"' in the column '"//name//"'")
         if (number_kind(trim(a%text(i))) == not_a_number) then
            a%is_text = .true.
         else
            call number_value(trim(a%text(i)), a%x(i), usable)
            if (.not. usable) call complain(source, "'"//trim(a%text(i))//"' is too large")
         end if
      end do
   end subroutine read_column

   !> A function, read up to its opening parenthesis.
   recursive subroutine read_function(source, name, a)
      type(reader), intent(inout) :: source
      character(len=*), intent(in) :: name
      type(row_values), intent(inout) :: a
      type(row_values) :: arguments(3)
      integer :: i, n

      n = 0
      if (name /= 'count') then
         do n = 1, 3
            call read_level(source, 1, arguments(n))
            call want_numbers(source, arguments(n))
            if (.not. next_is(source, ',')) exit
         end do
      end if
      call expect(source, ')')
      associate (x => arguments(1)%x, y => arguments(2)%x, z => arguments(3)%x)
         if (source%message /= '') return
         select case (name//achar(iachar('0') + n))
         case ('abs1'); a%x = abs(x)
         case ('sqrt1'); a%x = sqrt(x)
         case ('exp1'); a%x = exp(x)
         case ('log1'); a%x = log(x)
         case ('sin1'); a%x = sin(x)
         case ('cos1'); a%x = cos(x)
         case ('int1'); a%x = aint(x)
         case ('min2'); a%x = min(x, y)
         case ('max2'); a%x = max(x, y)
         case ('if3'); a%x = merge(y, z, abs(x) > 0.0_real64)
         case ('count0'); a%x = [(real(count(source%chosen%groups == source%chosen%groups(i)), real64), i=1, size(a%x))]
         case ('sum1', 'min1', 'max1', 'first1', 'last1', 'before1')
            call want_finite(source, arguments(1))
            a%x = of_groups(name, x, source%chosen%groups)
         case default
            call complain(source, "there is no function '"//name//"' of so many values")
         end select
      end associate
   end subroutine read_function

   !> For each row what NAME makes of the values of its group.
   pure function of_groups(name, x, groups) result(y)
      character(len=*), intent(in) :: name
      real(real64), intent(in) :: x(:)
      integer, intent(in) :: groups(:)
      real(real64) :: y(size(x))
      real(real64), allocatable :: members(:)
      integer :: g

      y = 0.0_real64
      do g = 1, maxval(groups)
         members = pack(x, groups == g)
         if (size(members) == 0) cycle
         select case (name)
         case ('sum'); members = sum(members)
         case ('min'); members = minval(members)
         case ('max'); members = maxval(members)
         case ('first'); members = members(1)
         case ('last'); members = members(size(members))
         case ('before'); members = eoshift(members, -1)
         end select
         y = unpack(members, groups == g, y)
      end do
   end function of_groups

   !> The same number to the last bit; false where one is none.
   elemental logical function equal(a, b)
      real(real64), intent(in) :: a, b

      equal = a <= b .and. a >= b
   end function equal

   ! ---- words, signs and complaints ----

   !> Whether this word or sign comes next; then it is read.
   logical function next_is(source, token)
      type(reader), intent(inout) :: source
      character(len=*), intent(in) :: token
      character(len=:), allocatable :: word

      word = next_word(source)
      if (word == '') word = source%text(source%at:min(source%at + len(token) - 1, len(source%text)))
      next_is = word == token
      if (next_is) source%at = source%at + len(token)
   end function next_is

   !> The word or number that comes next behind blanks; empty where a sign comes, or nothing.
   function next_word(source) result(word)
      type(reader), intent(inout) :: source
      character(len=:), allocatable :: word
      character(len=*), parameter :: letters = 'abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.'
      integer :: last

      do while (source%at <= len(source%text))
         if (index(' '//new_line('a'), source%text(source%at:source%at)) == 0) exit
         source%at = source%at + 1
      end do
      last = source%at - 1
      do while (last < len(source%text))
         associate (c => source%text(last + 1:last + 1), read => source%text(source%at:last))
            if (index(letters, c) == 0) then ! but for the sign of an exponent
               if (index('+-', c) == 0 .or. verify(read, '0123456789.eE') > 0 .or. scan(read, 'eE') < len(read)) exit
               if (len(read) < 2) exit
            end if
         end associate
         last = last + 1
      end do
      word = source%text(source%at:last)
   end function next_word

   subroutine expect(source, token)
      type(reader), intent(inout) :: source
      character(len=*), intent(in) :: token

      if (.not. next_is(source, token)) call complain(source, "expected '"//token//"'")
   end subroutine expect

   subroutine want_numbers(source, a)
      type(reader), intent(inout) :: source
      type(row_values), intent(in) :: a

      if (a%is_text) call complain(source, 'a text where a number is wanted')
   end subroutine want_numbers

   subroutine want_finite(source, a)
      type(reader), intent(inout) :: source
      type(row_values), intent(in) :: a

      call want_numbers(source, a)
      if (.not. all(ieee_is_finite(a%x))) call complain(source, 'a value is no finite number')
   end subroutine want_finite

   subroutine complain(source, why)
      type(reader), intent(inout) :: source
      character(len=*), intent(in) :: why

      if (source%message == '') source%message = why
   end subroutine complain

end module query_expression
