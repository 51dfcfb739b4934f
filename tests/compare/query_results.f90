!> Queries a CSV file, such as a history of joints.
!!
!!     query_results FILE ACTION...           `-` for FILE: one row without columns
!!
!! tests/README.md describes the actions and expressions. Where no row is left no condition holds. Exit status: 0 all conditions
!! hold; 1 one does not: its first rows are on standard output; 2 wrong usage, no row left, no such column, a value that is not a
!! finite number, an unreadable file.
program query_results
   use, intrinsic :: iso_fortran_env, only: output_unit, real64
   use comparison_text, only: argument, give_up, not_a_number, number_kind, text_of
   use csv_table, only: column_of, read_table, cell_length
   use query_expression, only: evaluate, cell_of, equal, row_values, selection
   implicit none

   integer, parameter :: most_shown = 5
   type(selection) :: chosen
   type(row_values) :: values
   character(len=:), allocatable :: action, operand, columns, message, printed
   integer :: i, n
   logical :: failed

   n = command_argument_count()
   if (n < 3 .or. modulo(n, 2) == 0) call give_up('usage: query_results FILE ACTION...; see the head of query_results.f90')
   call start(argument(1))
   printed = ''
   failed = .false.
   do i = 2, n, 2
      action = argument(i)
      operand = argument(i + 1)
      select case (action)
      case ('with')
         call read_table(operand, chosen%other, message)
         if (message /= '') call give_up(message)
         call find_partners()
      case ('on')
         if (.not. allocated(chosen%partners)) call give_up('on, and no with before it')
      case ('count')
         if (operand /= text_of(size(chosen%rows))) call tell(text_of(size(chosen%rows))//' rows, expected '//operand)
      case ('rows', 'by', 'all', 'print')
         call evaluate(operand, chosen, values, message, columns)
         if (message /= '') call give_up(chosen%file%name//': '//message)
         if (values%is_text .and. (action == 'rows' .or. action == 'all')) call give_up(operand//' is a text')
         if (action == 'rows') call keep(abs(values%x) > 0.0_real64)
         if (action == 'by') call divide(values)
         if (action == 'all') call tell_rows(abs(values%x) > 0.0_real64)
         if (action == 'print') printed = printed//' '//only_one(values)
      case default
         call give_up("there is no action '"//action//"'")
      end select
   end do
   if (printed /= '') print '(a)', printed(2:)
   if (failed) stop 1, quiet=.true.
   stop 0, quiet=.true.

contains

   !> All rows of a file.
   subroutine start(name)
      character(len=*), intent(in) :: name
      integer :: row

      if (name == '-') then
         chosen%file%name = name
         chosen%file%lines = [0]
         allocate (chosen%file%titles(0), chosen%file%cells(0, 1))
      else
         call read_table(name, chosen%file, message)
         if (message /= '') call give_up(message)
      end if
      chosen%rows = [(row, row=1, size(chosen%file%lines))]
      chosen%groups = spread(1, 1, size(chosen%rows))
      if (size(chosen%rows) == 0) call give_up(name//': no row')
   end subroutine start

   subroutine keep(mask)
      logical, intent(in) :: mask(:)

      if (.not. any(mask)) call give_up(chosen%file%name//': no row with '//operand)
      chosen%rows = pack(chosen%rows, mask)
      chosen%groups = pack(chosen%groups, mask)
      if (allocated(chosen%partners)) chosen%partners = pack(chosen%partners, mask)
   end subroutine keep

   !> Rows of one group with different values are of different groups from now on.
   subroutine divide(a)
      type(row_values), intent(in) :: a
      integer :: groups(size(chosen%rows)), row, before

      do row = 1, size(groups)
         groups(row) = row
         do before = 1, row - 1
            if (chosen%groups(before) /= chosen%groups(row)) cycle
            if (a%is_text) then
               if (a%text(before) /= a%text(row)) cycle
            else
               if (.not. equal(a%x(before), a%x(row))) cycle
            end if
            groups(row) = groups(before)
            exit
         end do
      end do
      chosen%groups = groups
   end subroutine divide

   !> The row of the other file that belongs to each row: by the actions `on` that follow, in order where there is none.
   subroutine find_partners()
      logical, allocatable :: belongs(:, :)          ! (row of the other file, row chosen)
      integer :: k, row, keys, there, here

      there = size(chosen%other%lines)
      here = size(chosen%rows)
      keys = 0
      do k = i + 2, n - 1, 2
         if (argument(k) /= 'on') exit
         if (keys == 0) allocate (belongs(there, here), source=.true.)
         keys = keys + 1
         call take_key(argument(k + 1), belongs)
      end do
      if (keys == 0) then
         if (here /= there) call give_up(text_of(here)//' rows of '//chosen%file%name//', '//text_of(there)//' of '// &
                                         chosen%other%name)
         chosen%partners = [(row, row=1, here)]
      else
         row = findloc(count(belongs, 1) == 1, .false., 1)
         if (row > 0) call give_up(place(row)//': '//text_of(count(belongs(:, row)))//' rows of '//chosen%other%name// &
                                   ' belong to it')
         chosen%partners = findloc(belongs, .true., 1)
      end if
   end subroutine find_partners

   !> Of the rows that belong to each row only those with its value of the key, `COLUMN=A` or `COLUMN`.
   subroutine take_key(key, belongs)
      character(len=*), intent(in) :: key
      logical, intent(inout) :: belongs(:, :)
      type(row_values) :: a
      integer :: equals, column, row

      equals = index(key//'=', '=')
      column = column_of(chosen%other, key(:equals - 1))
      if (column == 0) call give_up(chosen%other%name//": there is no column '"//key(:equals - 1)//"'")
      call evaluate(key(modulo(equals, len(key) + 1) + 1:), chosen, a, message, columns)
      if (message /= '') call give_up(chosen%file%name//': '//message)
      do row = 1, size(belongs, 2)
         if (a%is_text) belongs(:, row) = belongs(:, row) .and. chosen%other%cells(column, :) == a%text(row)
         if (.not. a%is_text) belongs(:, row) = belongs(:, row) .and. is_number(chosen%other%cells(column, :), a%x(row))
      end do
   end subroutine take_key

   elemental logical function is_number(cell, x)
      character(len=cell_length), intent(in) :: cell
      real(real64), intent(in) :: x
      real(real64) :: value
      integer :: status

      is_number = .false.
      if (number_kind(trim(cell)) == not_a_number) return
      read (cell, *, iostat=status) value
      is_number = status == 0 .and. equal(value, x)
   end function is_number

   !> The value that all rows have, as the cells have it where it is that of a column.
   function only_one(a) result(word)
      type(row_values), intent(in) :: a
      character(len=:), allocatable :: word
      character(len=cell_length) :: cell
      logical :: same, found

      if (a%is_text) same = all(a%text == a%text(1))
      if (.not. a%is_text) same = all(equal(a%x, a%x(1)))
      if (.not. same) call give_up(chosen%file%name//': '//operand//' is not the same in all of '// &
                                   text_of(size(chosen%rows))//' rows')
      call cell_of(chosen, operand, 1, cell, found)
      if (.not. found) then
         write (cell, '(es24.16e3)') a%x(1)
         if (abs(a%x(1)) < 1.0e9_real64 .and. equal(a%x(1), anint(a%x(1)))) write (cell, '(i0)') nint(a%x(1))
         if (a%is_text) cell = a%text(1)
      end if
      word = trim(adjustl(cell))
   end function only_one

   !> The first rows in which the condition does not hold, with what it asks for.
   subroutine tell_rows(holds)
      logical, intent(in) :: holds(:)
      character(len=cell_length) :: cell
      integer :: row, shown, first, last
      logical :: found

      if (all(holds)) return
      shown = 0
      do row = 1, size(holds)
         if (holds(row) .or. shown == most_shown) cycle
         shown = shown + 1
         write (output_unit, '(a)', advance='no') place(row)//':'
         first = 1
         do while (first <= len(columns))
            last = first + index(columns(first:), ' ') - 2
            call cell_of(chosen, columns(first:last), row, cell, found)
            write (output_unit, '(a)', advance='no') ' '//columns(first:last)//' = '//trim(cell)
            first = last + 2
         end do
         print '(a)'
      end do
      call tell(text_of(count(.not. holds))//' of '//text_of(size(holds))//' rows without '//operand)
   end subroutine tell_rows

   function place(row)
      integer, intent(in) :: row
      character(len=:), allocatable :: place

      place = chosen%file%name//':'//text_of(chosen%file%lines(chosen%rows(row)))
   end function place

   subroutine tell(what)
      character(len=*), intent(in) :: what

      print '(a)', chosen%file%name//': '//what
      failed = .true.
   end subroutine tell

end program query_results
