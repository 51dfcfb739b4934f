!> Splits one line of case control into key and value and checks the value.
!!
!! SET n = 1, 3, 10 THRU 20, 30 THRU 50 EXCEPT 35, 36, PMARK 4 gives a list of numbers a name in case control. A set is kept as
!! written; an error in an unused set is not reported. The nodes of a SET or of a marked surface, PMARK, limit tables.
module case_entries
   use deck_errors, only: deck_error_list
   use deck_text, only: deck_text_type
   use field_rules, only: parse_integer, list_of
   use text_tools, only: integer_text, upper
   implicit none
   private

   public :: cut_entry, choose, read_number, value_error, read_set, numbers_in_set, read_limit

   !> Keys for all stages, and keys of a stage.
   character(8), parameter, public :: global_keys(16) = [character(8) :: 'SOL', 'TITLE', 'UNITS', 'METHOD', 'TOL', 'PRESSURE', &
      'CARRY', 'AVERAGE', 'PATHTOL', 'SOLVER', 'ECHO', 'RESTART', 'MASS', 'MODEL', 'K2GG', 'M2GG']
   character(11), parameter, public :: stage_keys(22) = [character(11) :: 'SPC', 'MPC', 'LABEL', 'LOAD', 'INCR', 'OUTPUT', &
      'TEMPERATURE', 'WATCH', 'FROM', 'SUBSEQ', 'BCSET', 'BGSET', 'BOLTLD', 'LOADSET', 'MODES', 'STIFFNESS', 'AMPLITUDE', &
      'BACKBONE', 'FREQUENCY', 'DLOAD', 'SDAMPING', 'RESPONSE']
   character(11), parameter :: short_keys(7) = [character(11) :: 'TEMPERATURE', 'FREQUENCY', 'SDAMPING', 'TITLE', 'LABEL', &
                                                           'METHOD', 'DLOAD'] ! four letters suffice

   !> A key with a number, and its line (0: not given).
   type, public :: set_reference
      integer :: id = 0, line = 0
   end type set_reference

   !> One line of case control, cut into key and value.
   type, public :: entry_type
      integer :: line = 0
      character(:), allocatable :: key, value
      character(:), allocatable :: describers !! text in parentheses after the key, or empty
      integer :: first = 0, last = 0  !! columns of the value
   end type entry_type

   type, public :: number_set
      integer :: id = 0, line = 0
      character(:), allocatable :: text !! text after the equals sign, with continuation lines
   end type number_set

   !> Nodes named in case control: those of a SET or of a marked surface.
   type, public :: limit_type
      logical :: is_mark = .false.
      integer :: id = 0, line = 0
   end type limit_type

   character(*), parameter :: expected = ', expected ALL, or numbers, N THRU M and PMARK N with commas between them, behind a '// &
                                         'THRU also EXCEPT and numbers'

contains

   !> Cut 'UNITS = MM, KGF' into key and value. A blank may replace the equals sign. 'STRESS(PLOT) = ALL' also has a describer.
   subroutine cut_entry(line, at, entry)
      character(*), intent(in)      :: line
      integer, intent(in)           :: at
      type(entry_type), intent(out) :: entry
      integer :: first, last, closing, k

      entry%line = at
      entry%describers = ''
      first = verify(line, ' ')
      last = scan(line(first:), ' =,(')
      last = merge(len(line), first + last - 2, last == 0)
      entry%key = upper(line(first:last))
      do k = 1, size(short_keys)
         if (len(entry%key) >= 4 .and. index(short_keys(k), entry%key) == 1) entry%key = trim(short_keys(k))
      end do
      first = last + max(1, verify(line(last + 1:), ' '))
      if (line(first:min(first, len(line))) == '(') then
         closing = index(line(first:), ')')
         last = merge(len(line), first + closing - 1, closing == 0)
         entry%describers = upper(line(first + 1:last - merge(0, 1, closing == 0)))
      end if
      entry%first = last + 1
      first = verify(line(last + 1:), ' ')
      if (first > 0) then
         first = last + first
         if (line(first:first) == '=') then
            entry%first = first
            first = first + max(1, verify(line(first + 1:), ' '))
         end if
         entry%first = min(first, len(line))
         entry%value = line(min(first, len(line) + 1):)
      else
         entry%value = ''
      end if
      if (entry%value == '=') entry%value = ''
      entry%last = len(line)
      entry%first = min(entry%first, entry%last)
   end subroutine cut_entry

   !> CHOICE is the position of the value among WORDS, '|A|B|'. Any other value is an error, and CHOICE keeps its value.
   subroutine choose(entry, words, choice, errors)
      type(entry_type), intent(in)         :: entry
      character(*), intent(in)             :: words
      integer, intent(inout)               :: choice
      type(deck_error_list), intent(inout) :: errors
      integer :: at, i

      at = index(words, '|'//upper(entry%value)//'|')
      if (at == 0 .or. entry%value == '' .or. index(entry%value, '|') > 0) then
         call value_error(entry, list_of(words, ' or '), errors)
      else
         choice = count([(words(i:i) == '|', i = 1, at)])
      end if
   end subroutine choose

   !> Report that the value of ENTRY is not what was EXPECTED.
   subroutine value_error(entry, expected, errors)
      type(entry_type), intent(in)         :: entry
      character(*), intent(in)             :: expected
      type(deck_error_list), intent(inout) :: errors

      if (entry%value == '') then
         call errors%add(entry%line, entry%key//': no value, expected '//expected)
      else
         call errors%add(entry%line, entry%key//': '''//entry%value(:min(60, len(entry%value)))//''', expected '//expected, &
                         entry%first, entry%last)
      end if
   end subroutine value_error

   !> The value of ENTRY as the number of a set or a stage, at least 1.
   subroutine read_number(entry, reference, errors)
      type(entry_type), intent(in)         :: entry
      type(set_reference), intent(out)     :: reference
      type(deck_error_list), intent(inout) :: errors
      logical :: ok

      call parse_integer(entry%value, reference%id, ok)
      if (.not. ok .or. reference%id < 1) then
         call value_error(entry, 'an integer of 1 or more', errors)
         reference%id = 0
      else
         reference%line = entry%line
      end if
   end subroutine read_number

   !> Append the set of ENTRY to SETS. A comma at the end of a line continues the set; CURSOR then is the line after the set.
   subroutine read_set(text, entry, cursor, sets, errors)
      type(deck_text_type), intent(in)       :: text
      type(entry_type), intent(in)           :: entry  !! with a value such as '5 = 1, 2,'
      integer, intent(inout)                 :: cursor
      type(number_set), allocatable, intent(inout) :: sets(:) !! at first of size 0
      type(deck_error_list), intent(inout)   :: errors
      type(number_set) :: set
      integer :: equals
      logical :: ok

      equals = index(entry%value, '=')
      set%line = entry%line
      ok = equals > 1
      if (ok) call parse_integer(trim(entry%value(:equals - 1)), set%id, ok)
      if (.not. ok .or. set%id < 1) then
         call errors%add(entry%line, 'SET: '''//entry%value(:min(40, len(entry%value)))//''', expected SET N = numbers', &
                         entry%first, entry%last)
         set%id = 0
      end if
      set%text = upper(trim(entry%value(equals + 1:)))
      do while (index(set%text, ',', back=.true.) == len(set%text) .and. len(set%text) > 0 .and. cursor <= text%n)
         set%text = set%text//' '//upper(trim(text%card_part(cursor)))
         cursor = cursor + 1
      end do
      sets = [sets, set]
   end subroutine read_set

   !> Which of NUMBERS are in SET, and its marked surfaces.
   subroutine numbers_in_set(set, numbers, are_in, marks, errors)
      type(number_set), intent(in)         :: set
      integer, intent(in)                  :: numbers(:)
      logical, intent(out)                 :: are_in(:)
      integer, allocatable, intent(out)    :: marks(:) !! PMARK of its marked surfaces
      type(deck_error_list), intent(inout) :: errors
      character(:), allocatable :: word
      integer :: at, first, last, number
      logical :: ok, excepts

      allocate (marks(0))
      are_in = .false.
      excepts = .false.
      first = 0 ! of the number or range before, 0: none
      last = 0
      at = 1
      call next_word(set%text, at, word)
      if (word == '') call errors%add(set%line, 'SET '//integer_text(set%id)//': no number'//expected)
      do while (word /= '')
         ok = .true.
         select case (word)
         case ('ALL')
            are_in = .true.
         case ('PMARK')
            call next_word(set%text, at, word)
            call parse_integer(word, number, ok)
            ok = ok .and. number > 0
            if (ok) marks = [marks, number]
            first = 0
            last = 0
         case ('EXCEPT')
            ok = last > first
            excepts = .true.
         case ('THRU')
            ok = first > 0 .and. last == first
            if (ok) call next_word(set%text, at, word)
            if (ok) call parse_integer(word, last, ok)
            ok = ok .and. last > first
            are_in = are_in .or. (numbers >= first .and. numbers <= last)
            excepts = .false.
         case default
            call parse_integer(word, number, ok)
            ok = ok .and. number > 0
            excepts = excepts .and. number >= first .and. number <= last ! else a number of its own
            where (numbers == number) are_in = .not. excepts
            if (.not. excepts) first = number
            if (.not. excepts) last = number
         end select
         if (.not. ok) exit
         call next_word(set%text, at, word)
      end do
      if (word /= '') call errors%add(set%line, 'SET '//integer_text(set%id)//': '''//word(:min(20, len(word)))//''''//expected)
   end subroutine numbers_in_set

   !> The next WORD of TEXT from AT on, empty at the end; blanks and commas separate words.
   pure subroutine next_word(text, at, word)
      character(*), intent(in)               :: text
      integer, intent(inout)                 :: at
      character(:), allocatable, intent(out) :: word
      integer :: first, length

      word = ''
      first = verify(text(at:), ' ,')
      if (first == 0) return
      first = at + first - 1
      length = scan(text(first:)//' ', ' ,') - 1
      word = text(first:first + length - 1)
      at = first + length
   end subroutine next_word

   !> Append WORD, 'SET 5' or 'PMARK 20' in capitals, to LIMITS; OK is false where WORD is neither.
   pure subroutine read_limit(word, line, limits, ok)
      character(*), intent(in) :: word
      integer, intent(in)      :: line !! of the entry
      type(limit_type), allocatable, intent(inout) :: limits(:) !! not allocated: none so far
      logical, intent(out)     :: ok
      type(limit_type) :: limit

      ok = index(word, 'SET ') == 1 .or. index(word, 'PMARK ') == 1
      if (.not. ok) return
      limit%is_mark = word(1:1) == 'P'
      limit%line = line
      call parse_integer(trim(adjustl(word(index(word, ' '):))), limit%id, ok)
      if (.not. ok) return
      if (.not. allocated(limits)) allocate (limits(0))
      limits = [limits, limit]
   end subroutine read_limit

end module case_entries
