!> Reads the lines of a deck in order and inserts INCLUDE files, and cards that a line repeats, in their place.
module deck_text
   use c_library, only: is_regular_file, read_all_bytes, true_path
   use checksum, only: add_to_checksum, no_bytes
   use terminal, only: standard_input
   use deck_errors, only: deck_error_list
   use deck_lines, only: executive_control, file_named_by, is_include, is_open, line_place, path_beside, repeated, repeats_of, &
                         scan_line
   use deck_parameters, only: fill_parameters, parameter_type
   use kinds, only: long
   use lists, only: first_not_below
   use tab_columns, only: blank_tabs, expand_tabs
   use text_tools, only: integer_text, one_of, upper
   implicit none
   private

   public :: read_deck_text, deck_text_of_bytes, checksum_of

   integer, parameter :: max_files = 500 ! a deck and its INCLUDE files
   integer, parameter :: max_depth = 20  ! depth of nested INCLUDE
   integer, parameter :: most_include = 8 ! continuations of an INCLUDE

   type :: source_file
      character(:), allocatable :: path      ! as the user wrote it
      character(:), allocatable :: true_path
      character(:), allocatable :: bytes
      integer(long) :: executive(2) = 0      ! of executive_control, once it is asked for
      integer :: parent = 0                  ! file with the INCLUDE; 0: this is the deck itself
   end type source_file

   !> A part of the deck: lines FIRST to the next part stand in FILE, the first of them as line NUMBER of the file.
   type :: part_type
      integer :: first = 0, file = 0, number = 0
   end type part_type

   !> All lines of a deck, located once and never copied: line i is a range of bytes in the file of its part.
   type, public :: deck_text_type
      integer :: n = 0       !! number of lines
      integer :: n_files = 0
      logical :: is_text = .true.  !! false: a file contains bytes that are not text, or the deck is empty
      logical :: ends_whole = .false. !! the last line of the deck has a line end
      character(:), allocatable :: tab_lines !! the first line with tabs of each file, and how many have tabs; empty: none
      type(source_file), allocatable         :: files(:)
      type(line_place), allocatable, private :: lines(:)
      type(part_type), allocatable, private  :: parts(:)
      integer, private                       :: n_parts = 0
      type(parameter_type), allocatable      :: parameters(:) !! of --set
      character(:), allocatable              :: options       !! of the command, that change the problem; not allocated: none
      character(:), allocatable, private     :: law           ! file of --law, until its lines follow BEGIN BULK
      logical, private                       :: has_fields = .true. ! false: data, whose tabs are blanks
   contains
      procedure :: line => whole_line
      procedure :: card_part
      procedure :: find
      procedure :: place
      procedure :: file_number
      procedure, private :: part_of
   end type deck_text_type

contains

   !> Read the deck PATH and its INCLUDE files, or a file of data, which HAS no FIELDS of fixed width. READABLE is false where PATH
   !! itself cannot be read (TEXT is then empty). All other errors go to ERRORS.
   subroutine read_deck_text(path, text, errors, readable, parameters, law, has_fields)
      character(*), intent(in)             :: path
      type(deck_text_type), intent(out)    :: text
      type(deck_error_list), intent(inout) :: errors
      logical, intent(out)                 :: readable
      type(parameter_type), intent(in), optional :: parameters(:) !! default: none
      character(*), intent(in), optional   :: law !! file of cards behind BEGIN BULK; default and '': none
      logical, intent(in), optional        :: has_fields !! default: true
      integer :: k

      allocate (text%files(max_files), text%lines(1024), text%parts(2*max_files), text%parameters(0))
      if (present(has_fields)) text%has_fields = has_fields
      if (present(parameters)) text%parameters = parameters
      if (present(law)) then
         if (law /= '') text%law = law
      end if
      call add_file(text, path, 0, 0, errors, readable)
      do k = 1, size(text%parameters)
         associate (parameter => text%parameters(k))
            if (.not. parameter%is_used) call errors%add(0, '--set '//parameter%name//': there is no ${'//parameter%name// &
                                                         '} in the deck')
         end associate
      end do
   end subroutine read_deck_text

   !> Read the deck from BYTES, lines and line ends as in a file. Its name is 'text'; its INCLUDE files are relative to the current
   !! folder.
   subroutine deck_text_of_bytes(bytes, text, errors)
      character(*), intent(in)             :: bytes
      type(deck_text_type), intent(out)    :: text
      type(deck_error_list), intent(out)   :: errors

      allocate (text%files(max_files), text%lines(1024), text%parts(2*max_files))
      text%n_files = 1
      text%files(1) = source_file(path='text', true_path='', bytes=bytes)
      call take_tabs(text, 1, errors)
      call add_lines(text, 1, 0, errors)
   end subroutine deck_text_of_bytes

   !> The checksum of all files of TEXT, in the order of opening, each with its length.
   integer(long) function checksum_of(text) result(sum)
      type(deck_text_type), intent(in) :: text
      character(20) :: length
      integer :: i

      sum = no_bytes
      if (allocated(text%options)) call add_to_checksum(text%options, sum)
      do i = 1, text%n_files
         write (length, '(i20)') len(text%files(i)%bytes, long)
         call add_to_checksum(length, sum)
         call add_to_checksum(text%files(i)%bytes, sum)
      end do
   end function checksum_of

   !> Line I as in its file, without the line end.
   function whole_line(self, i) result(line)
      class(deck_text_type), intent(in) :: self
      integer, intent(in)               :: i
      character(:), allocatable         :: line
      integer(long) :: finish, next
      integer :: file

      file = self%parts(self%part_of(i))%file
      associate (start => self%lines(i)%start)
         next = index(self%files(file)%bytes(start:), achar(10), kind=long)
         finish = merge(start + next - 2, len(self%files(file)%bytes, long), next > 0)
         if (finish >= start) then
            if (self%files(file)%bytes(finish:finish) == achar(13)) finish = finish - 1
         end if
         line = self%files(file)%bytes(start:finish)
      end associate
   end function whole_line

   !> A copy of line I without its comment ($ to the end) and without trailing blanks. See FIND.
   function card_part(self, i) result(line)
      class(deck_text_type), intent(in) :: self
      integer, intent(in)               :: i
      character(:), allocatable         :: line
      integer(long) :: first, last
      integer :: file, comma

      call self%find(i, file, first, last, comma)
      line = self%files(file)%bytes(first:last)
   end function card_part

   !> The card part of line I without a copy: FILES(FILE)%BYTES(FIRST:LAST). COMMA is the column of its first comma, 0 where there is
   !! none.
   pure subroutine find(self, i, file, first, last, comma)
      class(deck_text_type), intent(in) :: self
      integer, intent(in)               :: i
      integer, intent(out)              :: file, comma
      integer(long), intent(out)        :: first, last

      file = self%parts(self%part_of(i))%file
      first = self%lines(i)%start
      last = first + self%lines(i)%length - 1
      comma = self%lines(i)%comma
   end subroutine find

   !> The place of line I for a message: 'beam.bdf, line 14'.
   function place(self, i) result(words)
      class(deck_text_type), intent(in) :: self
      integer, intent(in)               :: i
      character(:), allocatable         :: words
      integer :: part

      if (i == 0) then
         words = self%files(1)%path
      else
         part = self%part_of(i)
         words = self%files(self%parts(part)%file)%path//', line '// &
                 integer_text(self%parts(part)%number + i - self%parts(part)%first)
      end if
   end function place

   !> The file of line I: 1 the deck itself, 2 and up its INCLUDE files.
   pure integer function file_number(self, i)
      class(deck_text_type), intent(in) :: self
      integer, intent(in)               :: i

      file_number = self%parts(self%part_of(i))%file
   end function file_number

   !> The part with line I.
   pure integer function part_of(self, i) result(part)
      class(deck_text_type), intent(in) :: self
      integer, intent(in)               :: i

      part = 1
      if (self%n_parts == 1) return ! the usual case
      part = first_not_below(self%parts(:self%n_parts)%first, i)
      if (self%parts(part)%first > i) part = part - 1
   end function part_of

   !> Read one file and add its lines.
   recursive subroutine add_file(text, path, parent, depth, errors, readable)
      type(deck_text_type), intent(inout)  :: text
      character(*), intent(in)             :: path
      integer, intent(in)                  :: parent, depth
      type(deck_error_list), intent(inout) :: errors
      logical, intent(out)                 :: readable
      character(:), allocatable :: fault
      integer :: me

      me = text%n_files + 1
      text%files(me)%path = path
      if (path == standard_input) text%files(me)%path = 'standard input'
      text%files(me)%parent = parent
      call read_all_bytes(path, text%files(me)%bytes, readable)
      if (.not. readable) return
      if (allocated(text%parameters)) then
         call fill_parameters(text%files(me)%bytes, text%parameters, fault)
         if (fault /= '') call errors%add(0, text%files(me)%path//', '//fault)
      end if
      call take_tabs(text, me, errors)
      text%files(me)%true_path = true_path(path)
      text%n_files = me
      call add_lines(text, me, depth, errors)
   end subroutine add_file

   !> Expand the tabs of file ME, and note that there are some.
   subroutine take_tabs(text, me, errors)
      type(deck_text_type), intent(inout)  :: text
      integer, intent(in)                  :: me
      type(deck_error_list), intent(inout) :: errors
      character(:), allocatable :: fault
      integer :: first, n

      if (.not. allocated(text%tab_lines)) text%tab_lines = ''
      if (.not. text%has_fields) then
         call blank_tabs(text%files(me)%bytes)
         return
      end if
      call expand_tabs(text%files(me)%bytes, n, first, fault)
      if (fault /= '') call errors%add(0, text%files(me)%path//', '//fault)
      if (n > 0) text%tab_lines = text%tab_lines//one_of(text%tab_lines == '', '', '; ')//text%files(me)%path//', line '// &
                                  integer_text(first)//' (one of '//integer_text(n)//')'
   end subroutine take_tabs

   !> Add the lines of file ME; an INCLUDE line is added and then followed. A name in quotes may go on on the next lines.
   recursive subroutine add_lines(text, me, depth, errors)
      type(deck_text_type), intent(inout)  :: text
      integer, intent(in)                  :: me, depth
      type(deck_error_list), intent(inout) :: errors
      integer :: number, bad, opened
      integer(long) :: start, next, length
      character(:), allocatable :: statement ! an INCLUDE so far; empty: none
      logical :: starts_part
      character(32) :: steps(9)    ! of the line that repeated a card last

      steps = ''
      length = len(text%files(me)%bytes, long)
      if (me == 1 .and. len_trim(text%files(me)%bytes) == 0) then
         call errors%add(0, one_of(text%has_fields, 'the deck is empty', 'the file is empty'))
         text%is_text = .false.
      end if
      start = 1
      if (index(text%files(me)%bytes(:min(3_long, length)), char(239)//char(187)//char(191)) == 1) start = 4 ! UTF-8 byte order mark
      number = 0
      statement = ''
      opened = 0
      starts_part = .true. ! at the start of the file, and after the lines of another file
      do while (start <= length)
         number = number + 1
         if (starts_part) call start_part()
         call add_line()
         call scan_line(text%files(me)%bytes, start, text%lines(text%n), next, bad)
         if (bad >= 0) then
            call errors%add(text%n, 'byte '//integer_text(bad)//' on this line is no text: a deck is a text file')
            text%is_text = .false.
            return
         end if
         call take_include(next > length)
         call take_repeats()
         start = next
      end do
      if (me == 1 .and. length > 0) text%ends_whole = text%files(1)%bytes(length:length) == achar(10)

   contains

      subroutine start_part()
         if (text%n_parts == size(text%parts)) text%parts = [text%parts, text%parts]
         text%n_parts = text%n_parts + 1
         text%parts(text%n_parts) = part_type(text%n + 1, me, number)
      end subroutine start_part

      subroutine add_line()
         if (text%n == size(text%lines)) text%lines = [text%lines, text%lines]
         text%n = text%n + 1
      end subroutine add_line

      !> Where the line read last repeats the card before it, it becomes blank, and the cards follow it: they stand behind the bytes of
      !! the file and have the number of this line.
      subroutine take_repeats()
         character(:), allocatable :: card
         integer(long) :: after, at
         integer :: k, n

         n = repeats_of(text%card_part(text%n), steps)
         if (n == 0) return
         k = text%n - 1
         do while (k > 1 .and. text%lines(max(k, 1))%length == 0)
            k = k - 1
         end do
         card = ''
         if (n > 0 .and. k > 0) card = text%card_part(k)
         text%lines(text%n)%length = 0
         text%lines(text%n)%comma = 0
         do k = 1, max(n, 1)
            if (card /= '') card = repeated(card, steps)
            if (card == '') then
               call errors%add(text%n, 'the card before cannot be repeated so; expected a card of one line, and =, ==, '// &
                               '*(number), an entry, or =(number) behind such a line')
               return
            end if
            at = len(text%files(me)%bytes, long) + 2
            text%files(me)%bytes = text%files(me)%bytes//achar(10)//card
            call start_part()
            call add_line()
            call scan_line(text%files(me)%bytes, at, text%lines(text%n), after, bad)
         end do
         starts_part = .true.
      end subroutine take_repeats

      !> Follow the INCLUDE on the line read last, or on it and the lines before it, which are blank lines from then on.
      subroutine take_include(is_last)
         logical, intent(in) :: is_last !! line of the file
         integer(long) :: first, last
         integer :: comma, file
         logical :: is_begin

         starts_part = .false.
         call text%find(text%n, file, first, last, comma)
         associate (line => text%files(file)%bytes(first:last))
            is_begin = .false.
            if (allocated(text%law) .and. statement == '') is_begin = index(upper(adjustl(line)), 'BEGIN') == 1
            if (statement == '' .and. .not. (is_include(line) .or. is_begin)) return
            if (statement == '') opened = text%n
            statement = statement//trim(adjustl(line))
         end associate
         if (is_begin) then
            call add_law(starts_part)
            statement = ''
            return
         end if
         if (opened < text%n) text%lines(text%n)%length = 0
         if (is_open(statement) .and. .not. is_last .and. text%n < opened + most_include) return
         call follow_include(text, me, opened, statement, depth, starts_part, errors)
         statement = ''
      end subroutine take_include

      !> The lines of the file of --law.
      subroutine add_law(followed)
         logical, intent(out) :: followed
         character(:), allocatable :: path

         call move_alloc(text%law, path)
         call add_file(text, path, me, depth + 1, errors, followed)
         if (.not. followed) call errors%add(0, '--law '//path//': the file cannot be read')
      end subroutine add_law

   end subroutine add_lines

   !> Read the file that the INCLUDE on line HERE names at once; STATEMENT is the whole of it.
   recursive subroutine follow_include(text, me, here, statement, depth, followed, errors)
      type(deck_text_type), intent(inout)  :: text
      integer, intent(in)                  :: me, here, depth
      character(*), intent(in)             :: statement
      logical, intent(out)                 :: followed !! lines of another file were added
      type(deck_error_list), intent(inout) :: errors
      character(:), allocatable :: path, resolved
      integer :: ancestor

      followed = .false.
      path = file_named_by(statement)
      if (path == '') then
         call errors%add(here, 'INCLUDE: expected a file name, INCLUDE ''mesh.bdf''')
         return
      end if
      path = path_beside(path, text%files(me)%path, text%files(1)%path)
      resolved = true_path(path)
      ancestor = me
      do while (ancestor > 0)
         if (text%files(ancestor)%true_path == resolved) then
            call errors%add(here, 'INCLUDE: '''//path//''' includes itself, directly or through other files')
            return
         end if
         ancestor = text%files(ancestor)%parent
      end do
      if (depth == max_depth .or. text%n_files == max_files) then
         call errors%add(here, 'INCLUDE: more than '//integer_text(max_depth)//' nested INCLUDEs, or '// &
                         integer_text(max_files)//' files in all')
         return
      end if
      if (is_regular_file(path)) call add_file(text, path, me, depth + 1, errors, followed)
      if (followed) return
      path = 'INCLUDE: '''//path(:min(len(path), 200))//''' cannot be read: no such file, or not a file'
      associate (control => text%files(me)%executive, at => text%lines(here)%start)
         if (control(1) == 0) control = executive_control(text%files(me)%bytes)
         if (at > control(1) .and. at < control(2)) then
            call errors%warn(path//' ('//text%place(here)//'); before CEND such a file has DMAP, which is not followed')
         else
            call errors%add(here, path)
         end if
      end associate
   end subroutine follow_include

end module deck_text
