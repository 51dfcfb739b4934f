!> Finds the cards of a deck and reads each of them by the routine of its kind.
module card_kinds
   use bulk_data, only: bulk_data_type
   use card_fields, only: card_fields_type
   use deck_cards, only: card_name, card_type, check_first_field, is_continuation, loose_text, read_card
   use deck_errors, only: deck_error_list
   use deck_lines, only: is_include
   use deck_parts, only: part_of_begin
   use deck_text, only: deck_text_type
   use, intrinsic :: iso_fortran_env, only: int16
   use kinds, only: long
   use mesh_cards, only: complete_remedy
   use nastran_compatibility, only: take_idle_card
   use text_tools, only: plural, upper
   implicit none
   private

   public :: find_cards, read_all, read_one

   !> One kind of card, and the routine that reads it. The kinds of one array share a routine.
   type, public :: card_kind
      character(8) :: name = ''
      character(8), allocatable :: fields(:)         !! names of the data fields, as far as cards of this kind have been read
      integer :: routine = 0                         !! the same for kinds that share a routine
      integer :: n = 0                               !! number of cards of this kind
      logical :: of_mesh = .false.                   !! of nodes, elements, properties or marked surfaces
      procedure(read_one), pointer, nopass :: read => null()
   end type card_kind

   abstract interface
      !> Stores the fields of CARD in entry CARD%I of its array of BULK.
      subroutine read_one(card, bulk)
         import :: bulk_data_type, card_fields_type
         type(card_fields_type), intent(inout) :: card
         type(bulk_data_type), intent(inout)   :: bulk
      end subroutine read_one
   end interface

   integer, parameter :: many_lines = 5000 ! length of a deck from which two threads pay

contains

   !> Note where the cards from line CURSOR to ENDDATA begin. BULK counts all cards, also unknown ones and those without effect. Text
   !! behind ENDDATA has no effect. A second BEGIN makes their number -1.
   subroutine find_cards(text, cursor, cards, may_be_open, kind_at, bulk, errors)
      type(deck_text_type), intent(in)     :: text
      integer, intent(inout)               :: cursor
      type(card_kind), intent(inout)       :: cards(:)   !! the number of each kind
      logical, intent(in)                  :: may_be_open !! NASTRAN takes the deck without ENDDATA too
      integer(int16), intent(inout)        :: kind_at(:) !! (lines) kind of the card that begins there
      type(bulk_data_type), intent(inout)  :: bulk
      type(deck_error_list), intent(inout) :: errors
      integer(long) :: first, last
      integer :: at, comma, file
      integer :: ended_file ! file whose ENDDATA was read last, 1: the deck itself
      integer :: loose(2), n_loose(2) ! first line with text in columns 73 to 80, and past column 80; and their number
      logical :: is_open    ! a card may be continued

      ended_file = 0
      loose = 0
      n_loose = 0
      is_open = .false.
      allocate (bulk%part_lines(0), bulk%joined(4, 0))
      do while (cursor <= text%n)
         at = cursor
         cursor = cursor + 1
         call text%find(at, file, first, last, comma)
         if (last < first) cycle
         if (ended_file == 1 .or. file == ended_file) then
            call bulk%ignored%add('text behind ENDDATA')
            do while (cursor <= text%n) ! once for each file
               if (ended_file /= 1 .and. text%file_number(cursor) /= ended_file) exit
               cursor = cursor + 1
            end do
            cycle
         end if
         associate (line => text%files(file)%bytes(first:last))
            if (len(line) > 72 .and. comma == 0) call watch_columns(line)
            if (is_continuation(line, comma)) then
               if (.not. is_open) call errors%add(at, 'a continuation line without a card before it')
               cycle
            end if
            is_open = .false.
            if (is_include(line)) cycle ! the lines of the file follow in the deck text
            if (card_name(line, comma) == 'ENDDATA') then
               ended_file = file
            else if (upper(line(:min(6, len(line)))) == 'BEGIN') then
               if (part_of_begin(line) > 0) then
                  bulk%part_lines = [bulk%part_lines, at]
                  cycle
               end if
               errors%n = 0
               call errors%add(at, 'a second BEGIN, expected a part: BEGIN SUPER = n; nothing of this deck is read')
               bulk%n_cards = -1
               return
            else
               is_open = .true.
               bulk%n_cards = bulk%n_cards + 1
               call find_card(line)
            end if
         end associate
      end do
      if (ended_file /= 1 .and. text%ends_whole .and. may_be_open) then
         call errors%warn('no ENDDATA: expected it after the last card; a deck that is cut off between two lines would look '// &
                          'the same')
      else if (ended_file /= 1) then
         call errors%add(0, 'no ENDDATA: the deck may be truncated; expected ENDDATA after the last card')
      end if
      if (n_loose(1) > 0) call errors%warn('text in columns 73 to 80 that is no continuation mark is not read: '// &
         plural(n_loose(1), 'line')//', the first '//text%place(loose(1)))
      if (n_loose(2) > 0) call errors%warn('text past column 80 is not read: '//plural(n_loose(2), 'line')//', the first '// &
                                           text%place(loose(2)))

   contains

      !> Note the text that is not read at the end of LINE, line AT.
      subroutine watch_columns(line)
         character(*), intent(in) :: line
         integer :: column, k

         column = loose_text(line, text%card_part(min(at + 1, text%n)))
         if (column == 0) return
         k = merge(1, 2, column == 73)
         n_loose(k) = n_loose(k) + 1
         if (loose(k) == 0) loose(k) = at
      end subroutine watch_columns

      !> Note the card that begins with LINE, line AT of TEXT; the first comma is in column COMMA, 0: none.
      subroutine find_card(line)
         character(*), intent(in) :: line
         type(card_type)       :: card
         type(deck_error_list) :: faults
         character(8) :: name
         integer :: behind, kind
         logical :: is_idle

         name = card_name(line, comma)
         call check_first_field(line, comma, at, faults)
         do kind = 1, size(cards) ! findloc would copy the names
            if (cards(kind)%name == name) exit
         end do
         if (kind <= size(cards) .and. .not. faults%any()) then
            kind_at(at) = int(kind, int16)
            cards(kind)%n = cards(kind)%n + 1
         else
            is_idle = .false.
            if (.not. faults%any()) call take_idle_card(trim(name), at, bulk%ignored, is_idle)
            if (is_idle) return
            behind = at
            call read_card(text, behind, card, errors) ! finds the other errors of the card
            if (card%name == 'CQUAD9') then
               call errors%add(card%line, 'CQUAD9 is a complete element of nine nodes; expected a CQUAD8, no node inside'// &
                               complete_remedy, 1, 8)
            else if (card%name == 'SELOC') then
               call errors%add(card%line, 'SELOC moves a part of the deck; expected the GRID of the part where they stand in '// &
                               'the structure', 1, 8)
            else if (card%name /= '') then
               call errors%add(card%line, ''''//trim(card%name)//''' is not a card of jointfem; see input/cards.md', 1, 8)
            end if
         end if
      end subroutine find_card

   end subroutine find_cards

   !> Fill the arrays of BULK with the noted cards, in the order of the deck TEXT; errors go to ERRORS. The first routine, that of
   !! the nodes, reads about half of a long deck: one thread runs it, a second thread runs the others. The errors have the order of
   !! a serial run.
   subroutine read_all(text, kind_at, cards, bulk, errors)
      type(deck_text_type), intent(in)             :: text
      integer(int16), intent(in)                    :: kind_at(:)
      type(card_kind), intent(inout)               :: cards(:)
      type(bulk_data_type), intent(inout)          :: bulk
      type(deck_error_list), intent(inout), target :: errors
      type(deck_error_list), target :: others
      integer :: k

      !$omp parallel sections default(shared) if(text%n > many_lines)
      call read_by(1, errors)
      !$omp section
      do k = 2, size(cards)
         call read_by(k, others)
      end do
      !$omp end parallel sections
      if (allocated(others%warnings)) then
         do k = 1, size(others%warnings)
            call errors%warn(others%warnings(k)%words)
         end do
      end if
      do k = 1, others%n
         call errors%add(others%items(k)%line, others%items(k)%message, others%items(k)%first, others%items(k)%last)
      end do

   contains

      !> Read all cards of routine number ROUTINE.
      subroutine read_by(routine, errors)
         integer, intent(in)                          :: routine
         type(deck_error_list), intent(inout), target :: errors
         type(card_fields_type) :: card
         integer :: behind, left, line

         if (cards(routine)%routine /= routine) return ! another name in the line of a routine
         left = sum(cards%n, mask=cards%routine == routine)
         card%errors => errors
         do line = 1, size(kind_at)
            if (left == 0) exit
            if (kind_at(line) == 0) cycle
            associate (kind => cards(kind_at(line)))
               if (kind%routine /= routine) cycle
               behind = line
               call read_card(text, behind, card%card_type, errors)
               call move_alloc(kind%fields, card%names)
               call card%begin()
               call kind%read(card, bulk)
               call move_alloc(card%names, kind%fields)
            end associate
            left = left - 1
         end do
      end subroutine read_by

   end subroutine read_all

end module card_kinds
