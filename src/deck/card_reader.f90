!> Finds the cards of each kind in a deck and reads them into the arrays of the bulk data.
module card_reader
   use bulk_data, only: bulk_data_type
   use card_fields, only: card_fields_type
   use deck_cards, only: read_card
   use deck_errors, only: deck_error_list
   use deck_text, only: deck_text_type
   use, intrinsic :: iso_fortran_env, only: int8
   implicit none
   private

   integer, parameter :: many_lines = 5000            ! length of a deck from which two threads pay

   !> One kind of card, and the routine that reads it. The kinds of one array share a routine.
   type, public :: card_kind
      character(8) :: name = ''
      character(8), allocatable :: fields(:)         !! names of the data fields, as far as cards of this kind have been read
      integer, private :: routine = 0                ! the same for kinds that share a routine
      integer, private :: n = 0                      ! number of cards of this kind
      procedure(read_one), pointer, nopass, private :: read => null()
   end type card_kind

   !> The kinds of card, and the lines where cards begin.
   type, public :: card_reader_type
      type(card_kind), allocatable :: kinds(:)       !! all kinds
      integer(int8), allocatable, private :: kind_at(:) ! (lines) kind of the card that begins there, 0: none or unknown
   contains
      procedure :: start, add_kinds, note_card, n_of, read_all
   end type card_reader_type

   abstract interface
      !> Stores the fields of CARD in entry CARD%I of its array of BULK.
      subroutine read_one(card, bulk)
         import :: bulk_data_type, card_fields_type
         type(card_fields_type), intent(inout) :: card
         type(bulk_data_type), intent(inout)   :: bulk
      end subroutine read_one
   end interface

contains

   !> Begin a deck of N_LINES.
   subroutine start(self, n_lines)
      class(card_reader_type), intent(inout) :: self
      integer, intent(in)                    :: n_lines

      allocate (self%kinds(0), self%kind_at(n_lines))
      self%kind_at = 0
   end subroutine start

   !> Add the kinds NAMES, which READ reads.
   subroutine add_kinds(self, names, read)
      class(card_reader_type), intent(inout) :: self
      character(*), intent(in)               :: names(:)
      procedure(read_one)                    :: read
      type(card_kind) :: kind
      integer :: k

      kind%routine = size(self%kinds) + 1
      kind%read => read
      do k = 1, size(names)
         kind%name = names(k)
         self%kinds = [self%kinds, kind]
      end do
   end subroutine add_kinds

   !> Note that a card NAME begins on LINE; IS_KNOWN is false where there is no such kind.
   pure subroutine note_card(self, name, line, is_known)
      class(card_reader_type), intent(inout) :: self
      character(8), intent(in)               :: name
      integer, intent(in)                    :: line
      logical, intent(out)                   :: is_known
      integer :: k

      do k = 1, size(self%kinds)
         is_known = self%kinds(k)%name == name
         if (.not. is_known) cycle
         self%kind_at(line) = int(k, int8)
         self%kinds(k)%n = self%kinds(k)%n + 1
         return
      end do
   end subroutine note_card

   !> Number of noted cards of the kind NAME and of the kinds in the same array.
   pure integer function n_of(self, name) result(n)
      class(card_reader_type), intent(in) :: self
      character(*), intent(in)            :: name
      integer :: k

      k = findloc(self%kinds%name, name, dim=1)
      if (k == 0) error stop 'there is no card '//name
      n = sum(self%kinds%n, mask=self%kinds%routine == self%kinds(k)%routine)
   end function n_of

   !> Fill the arrays of BULK with the noted cards, in the order of the deck TEXT; errors go to ERRORS. The first routine, that of the
   !! nodes, reads about half of a long deck: one thread runs it, a second thread runs the others. The errors have the order of a
   !! serial run.
   subroutine read_all(self, text, bulk, errors)
      class(card_reader_type), intent(inout)       :: self
      type(deck_text_type), intent(in)             :: text
      type(bulk_data_type), intent(inout)          :: bulk
      type(deck_error_list), intent(inout), target :: errors
      type(deck_error_list), target :: others
      integer :: k

      !$omp parallel sections default(shared) if(text%n > many_lines)
      call read_by(self%kinds, 1, self%kind_at, text, bulk, errors)
      !$omp section
      do k = 2, size(self%kinds)
         call read_by(self%kinds, k, self%kind_at, text, bulk, others)
      end do
      !$omp end parallel sections
      call errors%add_all(others)
   end subroutine read_all

   !> Read all cards of routine number ROUTINE.
   subroutine read_by(kinds, routine, kind_at, text, bulk, errors)
      type(card_kind), intent(inout)               :: kinds(:)
      integer, intent(in)                          :: routine
      integer(int8), intent(in)                    :: kind_at(:)
      type(deck_text_type), intent(in)             :: text
      type(bulk_data_type), intent(inout)          :: bulk
      type(deck_error_list), intent(inout), target :: errors
      type(card_fields_type) :: card
      integer :: behind, left, line

      if (kinds(routine)%routine /= routine) return
      left = sum(kinds%n, mask=kinds%routine == routine)
      card%errors => errors
      line = 0
      do while (left > 0)
         line = line + 1
         if (kind_at(line) == 0) cycle
         associate (kind => kinds(kind_at(line)))
            if (kind%routine /= routine) cycle
            behind = line
            call read_card(text, behind, card%card, errors)
            call move_alloc(kind%fields, card%names)
            call card%begin()
            call kind%read(card, bulk)
            call move_alloc(card%names, kind%fields)
         end associate
         left = left - 1
      end do
   end subroutine read_by

end module card_reader
