!> The cards of a deck, array by array of the bulk data: which kinds of card there are, where their cards begin, and each of them
!! decoded by the table of its kind.
module card_reader
   use bulk_data, only: bulk_data_type
   use card_lines, only: card_values, decode_card, card_type
   use deck_cards, only: read_card
   use deck_errors, only: deck_error_list
   use deck_text, only: deck_text_type
   use field_rules, only: field_rule
   use, intrinsic :: iso_fortran_env, only: int8
   use kinds, only: wp
   implicit none
   private

   integer, parameter :: many_lines = 5000            ! of a deck that is worth two threads

   !> One kind of card, and the routine that reads all its cards; kinds that one array holds share a routine.
   type, public :: card_kind
      character(8) :: name = ''
      type(field_rule), allocatable :: table(:)      !! what its fields may hold; set by the routine
      logical, private :: open_ended = .false.       ! more may follow behind the table
      integer, private :: routine = 0                ! the same for all kinds that share one
      integer, private :: n = 0                      ! cards of this kind
      procedure(read_cards), pointer, nopass, private :: read => null()
   contains
      procedure :: number_of
   end type card_kind

   !> What a reading routine takes its cards from.
   type, public :: card_reader_type
      integer           :: n = 0                     !! cards that the routine will find
      integer           :: line = 0                  !! where the card begins that was taken last
      type(card_type)   :: card                      !! that card
      type(deck_error_list), pointer :: errors => null()
      type(card_kind), allocatable :: kinds(:)       !! all that there are
      type(deck_text_type), pointer, private :: text => null()
      integer(int8), allocatable, private :: kind_at(:) ! (lines) of the card that begins there, 0: none that is known
      integer, private :: routine = 0
      integer, private :: errors_before = 0          ! the card was decoded
   contains
      procedure :: start
      procedure :: add_kinds
      procedure :: note_card
      procedure :: read_all
      procedure :: set_table
      procedure :: next
      procedure :: take
      procedure :: decode
      procedure :: is_faulty
      procedure :: error
      procedure :: check_direction
   end type card_reader_type

   abstract interface
      !> Sets the tables of its kinds, gives its array of BULK the room for CARDS%N and takes the cards one after another.
      subroutine read_cards(cards, bulk)
         import :: bulk_data_type, card_reader_type
         type(card_reader_type), intent(inout) :: cards
         type(bulk_data_type), intent(inout)   :: bulk
      end subroutine read_cards
   end interface

contains

   !> The data field that the table calls FIELD.
   pure integer function number_of(self, field)
      class(card_kind), intent(in) :: self
      character(*), intent(in)     :: field

      number_of = findloc(self%table%name, field, dim=1)
   end function number_of

   !> Read from TEXT; what is wrong goes to ERRORS. Both outlive the reader.
   subroutine start(self, text, errors)
      class(card_reader_type), intent(inout)       :: self
      type(deck_text_type), intent(in), target     :: text
      type(deck_error_list), intent(inout), target :: errors

      self%text => text
      self%errors => errors
      allocate (self%kinds(0), self%kind_at(text%n))
      self%kind_at = 0
   end subroutine start

   !> The kinds with these NAMES are read by READ.
   subroutine add_kinds(self, names, read)
      class(card_reader_type), intent(inout) :: self
      character(*), intent(in)               :: names(:)
      procedure(read_cards)                  :: read
      type(card_kind) :: kind
      integer :: k

      kind%routine = size(self%kinds) + 1
      kind%read => read
      do k = 1, size(names)
         kind%name = names(k)
         self%kinds = [self%kinds, kind]
      end do
   end subroutine add_kinds

   !> A card of the name NAME begins on LINE; not IS_KNOWN where there is no such kind.
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

   !> Fill the arrays of BULK, each with the cards noted, in the order of the deck. The first routine, that of the nodes, has about
   !! half of a long deck: it is the work of one thread, the others that of another. The errors stand as if they had come one after
   !! the other.
   subroutine read_all(self, bulk)
      class(card_reader_type), intent(inout) :: self
      type(bulk_data_type), intent(inout)    :: bulk
      type(card_reader_type)                 :: other
      type(deck_error_list), target          :: others
      integer :: k

      other = self
      other%errors => others
      !$omp parallel sections default(shared) if(size(self%kind_at) > many_lines)
      call read_by(self, 1, bulk)
      !$omp section
      do k = 2, size(other%kinds)
         call read_by(other, k, bulk)
      end do
      !$omp end parallel sections
      other%kinds(1) = self%kinds(1)
      call move_alloc(other%kinds, self%kinds)
      call self%errors%add_all(others)
   end subroutine read_all

   !> Read all cards of the ROUTINE of that number, where there is one.
   subroutine read_by(cards, routine, bulk)
      type(card_reader_type), intent(inout) :: cards
      integer, intent(in)                   :: routine
      type(bulk_data_type), intent(inout)   :: bulk

      if (cards%kinds(routine)%routine /= routine) return
      cards%routine = routine
      cards%n = sum(cards%kinds%n, mask=cards%kinds%routine == routine)
      cards%line = 0
      call cards%kinds(routine)%read(cards, bulk)
   end subroutine read_by

   !> RULES, one a field, are the table of the kind NAME; left out, of the only one of the routine.
   subroutine set_table(self, rules, name, open_ended)
      class(card_reader_type), intent(inout) :: self
      type(field_rule), intent(in)           :: rules(:)
      character(*), intent(in), optional     :: name
      logical, intent(in), optional          :: open_ended !! true: more may follow behind the table
      integer :: kind

      kind = self%routine
      if (present(name)) kind = findloc(self%kinds%name, name, dim=1)
      self%kinds(kind)%table = rules
      if (present(open_ended)) self%kinds(kind)%open_ended = open_ended
   end subroutine set_table

   !> Take the next card of the routine, there must be one, and decode it.
   subroutine next(self, values)
      class(card_reader_type), intent(inout) :: self
      type(card_values), intent(inout)       :: values

      call self%take()
      call self%decode(values)
   end subroutine next

   !> Take the next card as it stands.
   subroutine take(self)
      class(card_reader_type), intent(inout) :: self
      integer :: behind

      do
         self%line = self%line + 1
         if (self%kind_at(self%line) == 0) cycle
         if (self%kinds(self%kind_at(self%line))%routine == self%routine) exit
      end do
      behind = self%line
      call read_card(self%text, behind, self%card, self%errors)
   end subroutine take

   !> Decode the card by its table, or by the first N rules of it: then more may follow.
   subroutine decode(self, values, n)
      class(card_reader_type), intent(inout) :: self
      type(card_values), intent(inout)       :: values
      integer, intent(in), optional          :: n
      integer :: used

      self%errors_before = self%errors%n
      associate (kind => self%kinds(self%kind_at(self%line)))
         used = size(kind%table)
         if (present(n)) used = n
         call decode_card(self%card, kind%table(:used), kind%open_ended .or. used < size(kind%table), values, self%errors)
      end associate
   end subroutine decode

   !> Whether anything was found wrong with the card since it was decoded.
   pure logical function is_faulty(self)
      class(card_reader_type), intent(in) :: self

      is_faulty = self%errors%n > self%errors_before
   end function is_faulty

   !> An error about the FIELD of the card, by its name in the table.
   subroutine error(self, field, message)
      class(card_reader_type), intent(inout) :: self
      character(*), intent(in)               :: field, message

      call self%card%field_error(self%kinds(self%kind_at(self%line))%number_of(field), field//': '//message, self%errors)
   end subroutine error

   !> The direction of WHAT in the three fields from FIRST on must not be zero.
   subroutine check_direction(self, first, what, values)
      class(card_reader_type), intent(inout) :: self
      character(*), intent(in)               :: first, what
      type(card_values), intent(in)          :: values
      integer :: k

      associate (kind => self%kinds(self%kind_at(self%line)))
         k = kind%number_of(first)
         if (values%ok .and. all(abs(values%reals(k:k + 2)) <= 0.0_wp)) &
            call self%error(first, what//' has no direction, expected '//trim(kind%table(k)%name)//', '// &
                            trim(kind%table(k + 1)%name)//', '//trim(kind%table(k + 2)%name)//' not all zero')
      end associate
   end subroutine check_direction

end module card_reader
