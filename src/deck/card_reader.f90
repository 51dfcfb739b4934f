!> The cards of a deck, array by array of the bulk data: which kinds of card there are, where their cards stand, and each of them
!! decoded by the table of its kind.
module card_reader
   use bulk_data, only: bulk_data_type
   use card_fields, only: card_values, decode_card
   use card_lines, only: card_type
   use deck_cards, only: read_card
   use deck_errors, only: deck_error_list
   use deck_text, only: deck_text_type
   use field_rules, only: field_rule
   use kinds, only: wp
   implicit none
   private

   public :: name_of_field, number_of_field

   !> One kind of card, and the routine that reads all its cards; kinds that one array holds share a routine.
   type, public :: card_kind
      character(8) :: name = ''
      type(field_rule), allocatable :: table(:)    !! what its fields may hold; set by the routine
      logical, private :: open_ended = .false.     ! more may follow behind the table
      integer, private :: routine = 0              ! number of the line of the list that names the kind
      procedure(read_cards), pointer, nopass, private :: read => null()
   end type card_kind

   !> Cards of one kind, N of them, one behind the other from line FIRST on.
   type :: card_run
      integer :: kind = 0, first = 0, n = 0
   end type card_run

   !> What a reading routine takes its cards from.
   type, public :: card_reader_type
      integer           :: n = 0                   !! cards that the routine will find
      type(card_type)   :: card                    !! the one that was taken last,
      type(card_values) :: values                  !! and its fields
      type(deck_error_list), pointer :: errors => null()
      type(card_kind), allocatable :: kinds(:)     !! all that there are
      type(deck_text_type), pointer, private :: text => null()
      type(card_run), allocatable, private :: runs(:) ! in the order of the deck
      integer, private :: n_runs = 0, routine = 0, run = 0, left = 0, cursor = 0
      integer, private :: errors_before = 0        ! the card was decoded
   contains
      procedure :: start
      procedure :: add_kinds
      procedure :: kind_of
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

   !> Read from TEXT; what is wrong goes to ERRORS. Both outlive the reader.
   subroutine start(self, text, errors)
      class(card_reader_type), intent(inout)      :: self
      type(deck_text_type), intent(in), target    :: text
      type(deck_error_list), intent(inout), target :: errors

      self%text => text
      self%errors => errors
      allocate (self%kinds(0), self%runs(64))
   end subroutine start


   !> The kinds with these NAMES (blanks between them) are read by READ.
   subroutine add_kinds(self, names, read)
      class(card_reader_type), intent(inout) :: self
      character(*), intent(in)               :: names
      procedure(read_cards)                  :: read
      type(card_kind) :: kind
      integer :: first, last

      self%routine = self%routine + 1
      first = 1
      do while (first <= len(names))
         last = index(names(first:)//' ', ' ') + first - 2
         kind%name = names(first:last)
         kind%routine = self%routine
         kind%read => read
         self%kinds = [self%kinds, kind]
         first = last + 2
      end do
   end subroutine add_kinds


   !> The kind of card with this NAME, 0: there is none.
   pure integer function kind_of(self, name) result(kind)
      class(card_reader_type), intent(in) :: self
      character(8), intent(in)            :: name

      do kind = size(self%kinds), 1, -1
         if (self%kinds(kind)%name == name) return
      end do
   end function kind_of


   !> A card of a KIND begins on LINE; FOLLOWS tells whether it comes straight behind the card noted last.
   subroutine note_card(self, kind, line, follows)
      class(card_reader_type), intent(inout) :: self
      integer, intent(in)                    :: kind, line
      logical, intent(in)                    :: follows
      type(card_run), allocatable :: longer(:)
      logical :: same

      same = follows .and. self%n_runs > 0
      if (same) same = self%runs(self%n_runs)%kind == kind
      if (.not. same) then
         if (self%n_runs == size(self%runs)) then
            allocate (longer(2*self%n_runs))
            longer(:self%n_runs) = self%runs
            call move_alloc(longer, self%runs)
         end if
         self%n_runs = self%n_runs + 1
         self%runs(self%n_runs) = card_run(kind, line, 0)
      end if
      self%runs(self%n_runs)%n = self%runs(self%n_runs)%n + 1
   end subroutine note_card


   !> Fill the arrays of BULK, each with the cards noted, in the order of the deck.
   subroutine read_all(self, bulk)
      class(card_reader_type), intent(inout) :: self
      type(bulk_data_type), intent(inout)    :: bulk
      integer :: k

      self%routine = 0
      do k = 1, size(self%kinds)
         if (self%kinds(k)%routine == self%routine) cycle
         self%routine = self%kinds(k)%routine
         associate (runs => self%runs(:self%n_runs))
            self%n = sum(runs%n, mask=self%kinds(runs%kind)%routine == self%routine)
         end associate
         self%run = 0
         self%left = 0
         call self%kinds(k)%read(self, bulk)
      end do
   end subroutine read_all


   !> RULES, one a field, are the table of the kind NAME; left out, of the only one of the routine.
   subroutine set_table(self, rules, name, open_ended)
      class(card_reader_type), intent(inout) :: self
      type(field_rule), intent(in)           :: rules(:)
      character(*), intent(in), optional     :: name
      logical, intent(in), optional          :: open_ended !! true: more may follow behind the table
      integer :: kind

      kind = findloc(self%kinds%routine, self%routine, dim=1)
      if (present(name)) kind = findloc(self%kinds%name, name, dim=1)
      self%kinds(kind)%table = rules
      if (present(open_ended)) self%kinds(kind)%open_ended = open_ended
   end subroutine set_table


   !> Take and decode the next card of the routine. There must be one.
   subroutine next(self)
      class(card_reader_type), intent(inout) :: self

      call self%take()
      call self%decode()
   end subroutine next


   !> Take the next card as it stands.
   subroutine take(self)
      class(card_reader_type), intent(inout) :: self

      if (self%left == 0) then
         do
            self%run = self%run + 1
            if (self%kinds(self%runs(self%run)%kind)%routine == self%routine) exit
         end do
         self%cursor = self%runs(self%run)%first
         self%left = self%runs(self%run)%n
      end if
      self%left = self%left - 1
      call read_card(self%text, self%cursor, self%card, self%errors)
   end subroutine take


   !> Decode the card by its table, or by the first N fields of it with more behind them.
   subroutine decode(self, n)
      class(card_reader_type), intent(inout) :: self
      integer, intent(in), optional          :: n

      self%errors_before = self%errors%n
      associate (kind => self%kinds(self%runs(self%run)%kind))
         if (present(n)) then
            call decode_card(self%card, kind%table(:n), .true., self%values, self%errors)
         else
            call decode_card(self%card, kind%table, kind%open_ended, self%values, self%errors)
         end if
      end associate
   end subroutine decode


   !> Whether anything was found wrong with the card since it was taken.
   pure logical function is_faulty(self)
      class(card_reader_type), intent(in) :: self

      is_faulty = self%errors%n > self%errors_before
   end function is_faulty


   !> An error about the FIELD of the card.
   subroutine error(self, field, message)
      class(card_reader_type), intent(inout) :: self
      character(*), intent(in)               :: field !! its name in the table
      character(*), intent(in)               :: message

      call self%card%field_error(number_of_field(self%kinds, self%card%name, field), field//': '//message, self%errors)
   end subroutine error


   !> The direction of WHAT in three fields from FIRST on must not be zero.
   subroutine check_direction(self, first, what)
      class(card_reader_type), intent(inout) :: self
      character(*), intent(in)               :: first !! name of the field
      character(*), intent(in)               :: what
      integer :: k

      associate (table => self%kinds(self%runs(self%run)%kind)%table)
         k = findloc(table%name, first, dim=1)
         if (.not. self%values%ok .or. any(abs(self%values%reals(k:k + 2)) > 0.0_wp)) return
         call self%error(first, what//' has no direction, expected '//trim(table(k)%name)//', '//trim(table(k + 1)%name)//', '// &
                         trim(table(k + 2)%name)//' not all zero')
      end associate
   end subroutine check_direction


   !> The name of data field K of a card of the kind NAME.
   pure function name_of_field(list, name, k) result(field)
      type(card_kind), intent(in) :: list(:)
      character(*), intent(in)    :: name
      integer, intent(in)         :: k
      character(:), allocatable   :: field

      field = trim(list(findloc(list%name, name, dim=1))%table(k)%name)
   end function name_of_field


   !> The data field of a card of the kind NAME that is called FIELD.
   pure integer function number_of_field(list, name, field) result(k)
      type(card_kind), intent(in) :: list(:)
      character(*), intent(in)    :: name, field

      k = findloc(list(findloc(list%name, name, dim=1))%table%name, field, dim=1)
   end function number_of_field

end module card_reader
