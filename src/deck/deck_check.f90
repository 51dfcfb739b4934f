!> A deck that was read, while what its cards say is put together: errors that are found long after a card was read.
module deck_check
   use bulk_data, only: bulk_data_type
   use card_reader, only: card_kind
   use case_control, only: case_control_type
   use deck_cards, only: add_field_error, card_name
   use deck_errors, only: deck_error_list
   use deck_input, only: deck_type
   use deck_text, only: deck_text_type
   implicit none
   private

   !> The parts of a deck, and where what is wrong in it goes.
   type, public :: checked_deck
      type(deck_text_type), pointer     :: text => null()
      type(case_control_type), pointer  :: control => null()
      type(bulk_data_type), pointer     :: bulk => null()
      type(deck_error_list), pointer    :: errors => null()
      type(card_kind), pointer, private :: kinds(:) => null()
   contains
      procedure :: start
      procedure, private :: kind_of_line, named_field_error, numbered_field_error
      generic :: field_error => named_field_error, numbered_field_error
   end type checked_deck

contains

   !> Check DECK, what is wrong goes to ERRORS. Both outlive SELF.
   subroutine start(self, deck, errors)
      class(checked_deck), intent(inout)           :: self
      type(deck_type), intent(in), target          :: deck
      type(deck_error_list), intent(inout), target :: errors

      self%text => deck%text
      self%control => deck%control
      self%bulk => deck%bulk
      self%kinds => deck%kinds
      self%errors => errors
   end subroutine start


   !> Which kind of card begins on LINE.
   integer function kind_of_line(self, line) result(kind)
      class(checked_deck), intent(in) :: self
      integer, intent(in)             :: line

      kind = findloc(self%kinds%name, card_name(self%text%card_part(line)), dim=1)
   end function kind_of_line


   !> Add an error about the FIELD, by its name in the table, of the card that begins on LINE.
   subroutine named_field_error(self, line, field, message, called)
      class(checked_deck), intent(in)    :: self
      integer, intent(in)                :: line
      character(*), intent(in)           :: field, message
      character(*), intent(in), optional :: called !! in the message, where not by its name

      associate (k => self%kinds(self%kind_of_line(line))%number_of(field))
         if (present(called)) then
            call add_field_error(self%text, line, k, called, message, self%errors)
         else
            call add_field_error(self%text, line, k, field, message, self%errors)
         end if
      end associate
   end subroutine named_field_error


   !> The same about data field K. NOUN: what it names, in front of its name.
   subroutine numbered_field_error(self, line, k, message, called, noun)
      class(checked_deck), intent(in)    :: self
      integer, intent(in)                :: line, k
      character(*), intent(in)           :: message
      character(*), intent(in), optional :: called !! as above; must be given where the table does not reach so far
      character(*), intent(in), optional :: noun
      character(:), allocatable :: name

      if (present(called)) then
         name = called
      else
         name = trim(self%kinds(self%kind_of_line(line))%table(k)%name)
      end if
      if (present(noun)) name = noun//' '//name
      call add_field_error(self%text, line, k, name, message, self%errors)
   end subroutine numbered_field_error

end module deck_check
