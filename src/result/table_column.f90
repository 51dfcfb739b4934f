!> The columns of a table: heading, edit descriptor, unit, and name in the CSV file.
module table_column
   use text_tools, only: short_width
   implicit none
   private

   public :: column, csv, csv_titles

   type, public :: column_type
      character(48) :: heading = ''
      character(48) :: key = ''       ! by which its cells are put
      character(40) :: name = ''      ! in the CSV file
      character(12) :: form = ''
      character(20) :: unit = ''
      integer :: width = 0            ! 0: text to the end of the row
      integer :: last = 0             ! last character of its values in the row
      integer :: heading_shift = 0, unit_shift = 0
      logical :: is_listed = .true.
      logical :: is_short = .false.   ! written by the fast write_short
   end type column_type

contains

   !> A column. FORM is the edit descriptor of its values: i11, es13.5, f9.4, a8; 'a' is text to the end of the row. Heading and
   !! unit end where the values end, or the given number of characters behind.
   elemental function column(heading, form, unit, heading_shift, unit_shift, name, is_listed, key) result(item)
      character(*), intent(in)           :: heading, form
      character(*), intent(in), optional :: unit, name    !! default: none
      integer, intent(in), optional      :: heading_shift, unit_shift
      logical, intent(in), optional      :: is_listed     !! default: yes
      character(*), intent(in), optional :: key           !! by which its cells are put; default: the name, else the heading
      type(column_type) :: item
      integer :: point

      item%key = adjustl(heading)
      if (present(name)) item%name = name
      if (item%name /= '') item%key = item%name
      if (present(key)) item%key = key
      if (present(is_listed)) item%is_listed = is_listed
      if (.not. item%is_listed) return
      item%heading = heading
      item%form = '('//form//')'
      if (present(unit)) item%unit = unit
      if (present(heading_shift)) item%heading_shift = heading_shift
      if (present(unit_shift)) item%unit_shift = unit_shift
      point = index(form//'.', '.')
      if (form /= 'a') read (form(scan(form, '0123456789'):point - 1), *) item%width
      item%is_short = index(form, 'es') == 1 .and. form(point:) == '.5' .and. item%width >= short_width
   end function column

   !> A column of the CSV file only.
   elemental function csv(name) result(item)
      character(*), intent(in) :: name
      type(column_type) :: item

      item = column('', '', name=name, is_listed=.false.)
   end function csv

   !> The first line of the CSV file of a table with these COLUMNS.
   pure function csv_titles(columns) result(titles)
      type(column_type), intent(in) :: columns(:)
      character(:), allocatable     :: titles
      integer :: at, i

      allocate (character(sum(len_trim(columns%name) + 1, mask=columns%name /= '')) :: titles)
      at = 0
      do i = 1, size(columns)
         if (columns(i)%name == '') cycle
         titles(at + 1:) = ','//columns(i)%name
         at = at + 1 + len_trim(columns(i)%name)
      end do
      titles = titles(2:)
   end function csv_titles

end module table_column
