!> The values of parameters on the command line: --set NAME=V,V,V, lists in pairs A=1,2:B=3,4, or a CSV file whose rows are runs.
module parameter_sets
   use c_library, only: is_regular_file, read_all_bytes
   use deck_parameters, only: is_parameter_name, parameter_type
   use text_tools, only: integer_text, one_of, plural
   implicit none
   private

   public :: read_setting, take_row

   !> One --set: names, and rows of a value for each.
   type, public :: setting_type
      integer :: n_rows = 0, n_names = 0
      character(:), allocatable, private :: text
      logical, private :: is_table = .false.
      integer, allocatable, private :: first(:, :), last(:, :) ! characters of the cells in TEXT: lines of a table, else columns
   end type setting_type

contains

   !> Read OPTION, what follows --set, as one more of SETTINGS. FAULT is why that fails, else ''.
   subroutine read_setting(option, settings, fault)
      character(*), intent(in) :: option
      type(setting_type), allocatable, intent(inout) :: settings(:)
      character(:), allocatable, intent(out) :: fault
      type(setting_type), allocatable :: longer(:)
      character(:), allocatable :: name
      integer :: i, j, k

      allocate (longer(size(settings) + 1)) ! gfortran 12 loses the texts of an array constructor
      longer(:size(settings)) = settings
      associate (new => longer(size(longer)))
         new%is_table = index(option, '=') == 0
         if (new%is_table) new%is_table = is_regular_file(option)
         if (new%is_table) call read_all_bytes(option, new%text, new%is_table)
         if (.not. new%is_table) new%text = option
         call cut_text(new, fault)
         if (fault /= '') fault = one_of(new%is_table, option//', ', '--set '//option//': ')//fault
         if (fault /= '') return
         do k = 1, new%n_names
            name = text_at(new, 0, k)
            do i = 1, size(longer)
               do j = 1, merge(k - 1, longer(i)%n_names, i == size(longer))
                  if (text_at(longer(i), 0, j) == name) fault = '--set '//name//': given twice'
               end do
            end do
         end do
      end associate
      if (fault == '') call move_alloc(longer, settings)
   end subroutine read_setting

   !> Find the cells of SETTING: in the lines of a table between commas, else of NAME=V,V,V with colons between several.
   subroutine cut_text(setting, fault)
      type(setting_type), intent(inout)      :: setting
      character(:), allocatable, intent(out) :: fault
      integer, allocatable :: cuts(:), line(:), marks(:)
      integer :: equals, k, n, p

      fault = 'expected NAME=VALUE, NAME=VALUE,VALUE,... for a run with each, A=1,2:B=3,4 for runs with pairs, or a CSV file'
      associate (text => setting%text, is_table => setting%is_table)
         allocate (marks, source=[0, pack([(k, k = 1, len(text))], [(is_mark(text, k, is_table), k = 1, len(text))]), &
                                  len(text) + 1])
         allocate (line(size(marks)))
         n = 0
         do p = 1, size(marks) - 1
            if (is_table .and. verify(text(marks(p) + 1:marks(p + 1) - 1), ' '//achar(13)) == 0) cycle
            equals = marks(p)
            if (.not. is_table) equals = equals + index(text(equals + 1:marks(p + 1) - 1), '=')
            if (.not. is_table .and. equals == marks(p)) return
            if (allocated(cuts)) deallocate (cuts)
            allocate (cuts, source=[marks(p), pack([(k, k = marks(p) + 1, marks(p + 1) - 1)], &
                      [(k == equals .or. (k > equals .and. text(k:k) == ','), k = marks(p) + 1, marks(p + 1) - 1)]), marks(p + 1)])
            if (n == 0) allocate (setting%first(size(marks) - 1, size(cuts) - 1), setting%last(size(marks) - 1, size(cuts) - 1))
            if (size(cuts) - 1 /= size(setting%first, 2)) then
               k = merge(1, 2, is_table) ! behind a name
               fault = one_of(is_table, 'line '//integer_text(p), text(marks(p) + 1:equals - 1))//': '// &
                       plural(size(cuts) - k, 'value')//', expected '//integer_text(size(setting%first, 2) + 1 - k)
               return
            end if
            n = n + 1
            setting%first(n, :) = cuts(:size(cuts) - 1) + 1
            setting%last(n, :) = cuts(2:) - 1
            line(n) = p
         end do
      end associate
      if (setting%is_table .and. n < 2) fault = 'expected a line of names, then lines with their values, with commas between them'
      if (setting%is_table .and. n < 2) return
      setting%n_rows = merge(n, size(setting%first, 2), setting%is_table) - 1
      setting%n_names = merge(size(setting%first, 2), n, setting%is_table)
      call check_cells(line(:n), setting, fault)
   end subroutine cut_text

   !> Take off the blanks around the cells of a table. FAULT, as given where the text is no table, is '' where all cells are valid.
   subroutine check_cells(line, setting, fault)
      integer, intent(in)                      :: line(:)
      type(setting_type), intent(inout)        :: setting
      character(:), allocatable, intent(inout) :: fault
      character(*), parameter :: bad = '$'//achar(9)//achar(10)//achar(13)
      integer :: k, n
      logical :: is_name, ok

      do n = 1, size(line)
         do k = 1, size(setting%first, 2)
            associate (first => setting%first(n, k), last => setting%last(n, k), text => setting%text)
               if (setting%is_table) last = first - 1 + verify(text(first:last), ' '//achar(13), back=.true.)
               if (setting%is_table) first = first - 1 + max(1, verify(text(first:last), ' '))
               is_name = merge(n, k, setting%is_table) == 1
               ok = last >= first
               if (ok .and. is_name) ok = is_parameter_name(text(first:last))
               if (ok) ok = scan(text(first:last), bad) == 0
               if (ok) cycle
               if (setting%is_table .or. (last >= first .and. .not. is_name)) &
                  fault = one_of(is_name, 'a name has letters, digits and underscores', &
                                 'a value is a number or a word, without $, tab or line end')
               if (setting%is_table) fault = 'line '//integer_text(line(n))//', column '//integer_text(k)//': "'// &
                                             text(first:last)//'": '//fault
            end associate
            return
         end do
      end do
      fault = ''
   end subroutine check_cells

   !> Whether character K of TEXT ends a line of a table, or is a colon before NAME=.
   pure logical function is_mark(text, k, is_table)
      character(*), intent(in) :: text
      integer, intent(in)      :: k
      logical, intent(in)      :: is_table

      is_mark = text(k:k) == merge(new_line('a'), ':', is_table)
      if (is_mark .and. .not. is_table) is_mark = is_parameter_name(text(k + 1:k + index(text(k + 1:), '=') - 1))
   end function is_mark

   !> The text of column K in ROW; row 0 has the names.
   pure function text_at(setting, row, k) result(text)
      type(setting_type), intent(in) :: setting
      integer, intent(in)            :: row, k
      character(:), allocatable      :: text
      integer :: at(2)

      at = merge([row + 1, k], [k, row + 1], setting%is_table)
      text = setting%text(setting%first(at(1), at(2)):setting%last(at(1), at(2)))
   end function text_at

   !> The PARAMETERS of combination RUN = 0, 1, ... of the rows of SETTINGS, the last setting changing fastest. Those of settings
   !! with several rows are added to the NAME of the run and, without slashes, are the BASE of its files.
   subroutine take_row(settings, run, parameters, name, base)
      type(setting_type), intent(in)                 :: settings(:)
      integer, intent(in)                            :: run
      type(parameter_type), allocatable, intent(out) :: parameters(:)
      character(:), allocatable, intent(inout)       :: name
      character(:), allocatable, intent(out)         :: base
      integer :: at, j, k

      base = ''
      allocate (parameters(sum(settings%n_names)))
      at = 0
      do k = 1, size(settings)
         do j = 1, settings(k)%n_names
            at = at + 1
            associate (parameter => parameters(at))
               parameter%name = text_at(settings(k), 0, j)
               parameter%value = text_at(settings(k), modulo(run/product(settings(k + 1:)%n_rows), settings(k)%n_rows) + 1, j)
               if (settings(k)%n_rows == 1) cycle
               base = base//'_'//parameter%name//'='//parameter%value
               name = name//', '//parameter%name//'='//parameter%value
            end associate
         end do
      end do
      do k = 1, len(base) ! the name of a file cannot have slashes
         if (base(k:k) == '/') base(k:k) = '-'
      end do
   end subroutine take_row

end module parameter_sets
