!> SET n = 1, 3, 10 THRU 20, 30 THRU 50 EXCEPT 35, 36, PMARK 4: numbers to which case control gives a name. A set is kept as it is
!! written; what is wrong with one that nothing uses does no harm. The nodes of a SET or of a marked surface, PMARK, limit tables.
module case_sets
   use case_entries, only: entry_type
   use deck_errors, only: deck_error_list
   use deck_text, only: deck_text_type
   use field_rules, only: parse_integer
   use text_tools, only: integer_text, upper
   implicit none
   private

   public :: read_set, find_set, numbers_in_set, read_limit

   type, public :: number_set
      integer :: id = 0, line = 0
      character(:), allocatable :: text !! what follows the equals sign, with its continuation lines
   end type number_set

   !> Nodes that case control names: those of a SET, or those of a marked surface.
   type, public :: limit_type
      logical :: is_mark = .false.
      integer :: id = 0, line = 0
   end type limit_type

   character(*), parameter :: expected = ', expected ALL, or numbers, N THRU M and PMARK N with commas between them, behind a '// &
                                         'THRU also EXCEPT and numbers'

contains

   !> Append the set of ENTRY to SETS: where a line ends with a comma the next one goes on, CURSOR is left behind it.
   subroutine read_set(text, entry, cursor, sets, errors)
      type(deck_text_type), intent(in)       :: text
      type(entry_type), intent(in)           :: entry  !! its value is '5 = 1, 2,'
      integer, intent(inout)                 :: cursor
      type(number_set), allocatable, intent(inout) :: sets(:)
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
      if (.not. allocated(sets)) allocate (sets(0))
      sets = [sets, set]
   end subroutine read_set

   !> Where the set with this ID is, the last of them; 0: nowhere.
   pure integer function find_set(sets, id) result(at)
      type(number_set), allocatable, intent(in) :: sets(:)
      integer, intent(in) :: id

      at = 0
      if (allocated(sets)) at = findloc(sets%id, id, dim=1, back=.true.)
   end function find_set

   !> Which of NUMBERS are in SET, and the marked surfaces that it names.
   subroutine numbers_in_set(set, numbers, are_in, marks, errors)
      type(number_set), intent(in)         :: set
      integer, intent(in)                  :: numbers(:)
      logical, intent(out)                 :: are_in(:)
      integer, allocatable, intent(out)    :: marks(:) !! their PMARK
      type(deck_error_list), intent(inout) :: errors
      character(:), allocatable :: word
      integer :: at, first, last, mark
      logical :: ok, excepts

      allocate (marks(0))
      are_in = .false.
      excepts = .false.
      first = 0
      last = 0
      at = 1
      call next_word(set%text, at, word)
      if (word == '') call errors%add(set%line, 'SET '//integer_text(set%id)//': no number'//expected)
      do while (word /= '')
         if (word == 'ALL') then
            are_in = .true.
         else if (word == 'PMARK') then
            call next_word(set%text, at, word)
            call parse_integer(word, mark, ok)
            if (.not. ok .or. mark < 1) exit
            marks = [marks, mark]
            first = 0
            last = 0
         else if (word == 'EXCEPT' .and. last > first) then
            excepts = .true.
         else if (word == 'THRU' .and. first > 0 .and. last == first) then
            call next_word(set%text, at, word)
            call parse_integer(word, last, ok)
            if (.not. ok .or. last <= first) exit
            are_in = are_in .or. (numbers >= first .and. numbers <= last)
            excepts = .false.
         else
            excepts = excepts .and. first > 0
            call take_number(word, ok)
            if (.not. ok) exit
         end if
         call next_word(set%text, at, word)
      end do
      if (word /= '') call errors%add(set%line, 'SET '//integer_text(set%id)//': '''//word(:min(20, len(word)))//''''//expected)

   contains

      !> A number of its own, or behind EXCEPT one of the range before it that is not meant.
      subroutine take_number(word, ok)
         character(*), intent(in) :: word
         logical, intent(out)     :: ok
         integer :: number

         call parse_integer(word, number, ok)
         if (ok) ok = number > 0
         if (.not. ok) return
         if (excepts .and. number >= first .and. number <= last) then
            where (numbers == number) are_in = .false.
            return
         end if
         excepts = .false.
         first = number
         last = number
         where (numbers == number) are_in = .true.
      end subroutine take_number

   end subroutine numbers_in_set

   !> The next WORD of TEXT from AT on, empty behind the last; blanks and commas stand between them.
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

   !> Append WORD, 'SET 5' or 'PMARK 20' in capitals, to LIMITS; OK is false where it is neither.
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

end module case_sets
