!> The lines of a deck in the order in which they count, INCLUDE files opened in their place.
module deck_text
   use kinds, only: long
   use c_library, only: read_all_bytes, true_path
   use command_tools, only: standard_input
   use deck_errors, only: deck_error_list
   use text_tools, only: integer_text, upper
   implicit none
   private

   public :: read_deck_text, is_include

   integer, parameter :: max_files = 500 ! a deck and its INCLUDE files
   integer, parameter :: max_depth = 20  ! of INCLUDE in INCLUDE
   integer, parameter :: longest_include = 10000 ! characters; no path is longer

   type :: source_file
      character(:), allocatable :: path      ! as the user wrote it
      character(:), allocatable :: true_path
      character(:), allocatable :: bytes
      integer :: parent = 0                  ! the file that holds the INCLUDE; 0: the deck itself
   end type source_file

   !> All lines of a deck. Line i is bytes start(i) to start(i)+length(i)-1 of its file; comments and blanks at
   !! the end are part of the line.
   type, public :: deck_text_type
      integer :: n = 0       !! number of lines
      integer :: n_files = 0
      logical :: is_text = .true. !! false: some file holds bytes that are no text, or the deck is empty
      type(source_file), allocatable     :: files(:)
      integer, allocatable, private      :: file(:)   ! which file line i stands in
      integer, allocatable, private      :: number(:) ! its number there, from 1
      integer, allocatable, private      :: length(:)
      integer(long), allocatable, private :: start(:)
   contains
      procedure :: line => whole_line
      procedure :: card_part
      procedure :: place
      procedure :: file_number
      procedure, private :: push_line
   end type deck_text_type

contains

   !> Read the deck PATH and what it includes. READABLE is false where PATH itself cannot be read (then TEXT holds
   !! nothing); everything else that is wrong goes to ERRORS.
   subroutine read_deck_text(path, text, errors, readable)
      character(*), intent(in)             :: path
      type(deck_text_type), intent(out)    :: text
      type(deck_error_list), intent(inout) :: errors
      logical, intent(out)                 :: readable

      allocate (text%files(max_files))
      allocate (text%file(1024), text%number(1024), text%length(1024), text%start(1024))
      call add_file(text, path, 0, 0, errors, readable)
      if (.not. readable) return
      if (len_trim(text%files(1)%bytes) == 0) then
         call errors%add(0, 'the deck is empty')
         text%is_text = .false.
      end if
   end subroutine read_deck_text


   !> Line I as it stands in its file, without the line end.
   function whole_line(self, i) result(line)
      class(deck_text_type), intent(in) :: self
      integer, intent(in)               :: i
      character(:), allocatable         :: line

      line = self%files(self%file(i))%bytes(self%start(i):self%start(i) + self%length(i) - 1)
   end function whole_line


   !> Line I without its comment ($ to the end) and without blanks at its end.
   function card_part(self, i) result(line)
      class(deck_text_type), intent(in) :: self
      integer, intent(in)               :: i
      character(:), allocatable         :: line
      integer :: dollar

      line = self%line(i)
      dollar = index(line, '$')
      if (dollar > 0) line = line(:dollar - 1)
      line = trim(line)
   end function card_part


   !> Where line I stands, for a message: 'beam.bdf, line 14'.
   function place(self, i) result(words)
      class(deck_text_type), intent(in) :: self
      integer, intent(in)               :: i
      character(:), allocatable         :: words

      if (i == 0) then
         words = self%files(1)%path
      else
         words = self%files(self%file(i))%path//', line '//integer_text(self%number(i))
      end if
   end function place


   !> The file that line I stands in: 1 the deck itself, 2 and up its INCLUDE files.
   pure integer function file_number(self, i)
      class(deck_text_type), intent(in) :: self
      integer, intent(in)               :: i

      file_number = self%file(i)
   end function file_number


   !> Read one file and add its lines; an INCLUDE line is added and then followed.
   recursive subroutine add_file(text, path, parent, depth, errors, readable)
      type(deck_text_type), intent(inout)  :: text
      character(*), intent(in)             :: path
      integer, intent(in)                  :: parent, depth
      type(deck_error_list), intent(inout) :: errors
      logical, intent(out)                 :: readable
      integer :: me, number, bad
      integer(long) :: start, finish, next, length

      me = text%n_files + 1
      text%files(me)%path = path
      if (path == standard_input) text%files(me)%path = 'standard input'
      text%files(me)%parent = parent
      call read_all_bytes(path, text%files(me)%bytes, readable)
      if (.not. readable) return
      text%files(me)%true_path = true_path(path)
      text%n_files = me
      length = len(text%files(me)%bytes, long)
      start = 1
      number = 0
      if (length >= 3) then
         if (text%files(me)%bytes(1:3) == char(239)//char(187)//char(191)) start = 4 ! UTF-8 byte order mark
      end if
      do while (start <= length)
         next = scan_line_end(text%files(me)%bytes, start, length)
         finish = next - 1
         if (finish >= start) then
            if (text%files(me)%bytes(finish:finish) == achar(13)) finish = finish - 1
         end if
         number = number + 1
         call text%push_line(me, number, start, finish)
         bad = control_byte(text%files(me)%bytes(start:finish))
         if (bad >= 0) then
            call errors%add(text%n, 'byte '//integer_text(bad)//' on this line is no text: a deck is a text file')
            text%is_text = .false.
            return
         end if
         call follow_include(text, me, depth, errors)
         start = next + 1
      end do
   end subroutine add_file


   !> Position of the line feed at or after START, LENGTH + 1 where there is none.
   pure integer(long) function scan_line_end(bytes, start, length) result(position)
      character(*), intent(in)  :: bytes
      integer(long), intent(in) :: start, length

      position = index(bytes(start:), achar(10), kind=long)
      if (position == 0) then
         position = length + 1
      else
         position = start + position - 1
      end if
   end function scan_line_end


   !> The first byte of LINE that no text file holds (a control character other than a tab), -1 for none.
   pure integer function control_byte(line) result(code)
      character(*), intent(in) :: line
      integer(long) :: i

      do i = 1, len(line, long)
         code = iachar(line(i:i))
         if ((code < 32 .and. code /= 9) .or. code == 127) return
      end do
      code = -1
   end function control_byte


   subroutine push_line(self, file, number, start, finish)
      class(deck_text_type), intent(inout) :: self
      integer, intent(in)                  :: file, number
      integer(long), intent(in)            :: start, finish
      integer :: room

      if (self%n == size(self%file)) then
         room = 2*self%n
         self%file = [self%file, spread(0, 1, room - self%n)]
         self%number = [self%number, spread(0, 1, room - self%n)]
         self%length = [self%length, spread(0, 1, room - self%n)]
         self%start = [self%start, spread(0_long, 1, room - self%n)]
      end if
      self%n = self%n + 1
      self%file(self%n) = file
      self%number(self%n) = number
      self%start(self%n) = start
      self%length(self%n) = int(finish - start + 1)
   end subroutine push_line


   !> Where the last line read is an INCLUDE, read that file here and now.
   recursive subroutine follow_include(text, me, depth, errors)
      type(deck_text_type), intent(inout)  :: text
      integer, intent(in)                  :: me, depth
      type(deck_error_list), intent(inout) :: errors
      character(:), allocatable :: line, path, resolved
      integer :: here, ancestor
      logical :: readable

      here = text%n
      if (text%length(here) < 7 .or. text%length(here) > longest_include) return
      line = adjustl(text%card_part(here))
      if (.not. is_include(line)) return
      path = included_path(line(8:))
      if (path == '') then
         call errors%add(here, 'INCLUDE: expected a file name, INCLUDE ''mesh.bdf''')
         return
      end if
      if (path(1:1) /= '/') path = folder(text%files(me)%path)//path
      resolved = true_path(path)
      ancestor = me
      do while (ancestor > 0)
         if (text%files(ancestor)%true_path == resolved) then
            call errors%add(here, 'INCLUDE: '''//path//''' is being read already: a circle of INCLUDEs')
            return
         end if
         ancestor = text%files(ancestor)%parent
      end do
      if (depth == max_depth .or. text%n_files == max_files) then
         call errors%add(here, 'INCLUDE: more than '//integer_text(max_depth)//' INCLUDEs inside each other, or '// &
                         integer_text(max_files)//' files in all')
         return
      end if
      call add_file(text, path, me, depth + 1, errors, readable)
      if (.not. readable) call errors%add(here, 'INCLUDE: '''//path//''' cannot be read: no such file, or not a file')
   end subroutine follow_include


   !> Whether LINE (its card part) is an INCLUDE: the word, then a blank, a quote or an equals sign.
   pure logical function is_include(line)
      character(*), intent(in) :: line
      integer :: first

      is_include = .false.
      first = verify(line, ' ')
      if (first == 0 .or. len(line) > longest_include) return
      if (len(line) < first + 6) return
      if (upper(line(first:first + 6)) /= 'INCLUDE') return
      is_include = .true.
      if (len(line) > first + 6) is_include = scan(line(first + 7:first + 7), ' ''"=') == 1
   end function is_include


   !> The file name in what follows the word INCLUDE: in quotes of either kind, or bare.
   pure function included_path(words) result(path)
      character(*), intent(in)  :: words
      character(:), allocatable :: path
      integer :: closing

      path = trim(adjustl(words))
      if (path == '') return
      if (path(1:1) == '=') path = trim(adjustl(path(2:)))
      if (path == '') return
      if (path(1:1) == '''' .or. path(1:1) == '"') then
         closing = index(path(2:), path(1:1))
         if (closing == 0) then
            path = ''
         else if (len_trim(path) > closing + 1) then
            path = ''
         else
            path = path(2:closing)
         end if
      end if
   end function included_path


   !> The folder part of PATH with its slash, empty for the current folder.
   pure function folder(path) result(part)
      character(*), intent(in)  :: path
      character(:), allocatable :: part

      part = path(:index(path, '/', back=.true.))
   end function folder

end module deck_text
