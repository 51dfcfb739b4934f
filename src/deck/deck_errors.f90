!> Collects the errors of a deck, so that a user sees all of them at once.
module deck_errors
   implicit none
   private

   !> One error: its message and its place (index of the line in the deck text, 0 for the deck as a whole; columns first to last, 0 for
   !! the whole line).
   type, public :: deck_error
      integer :: line = 0, first = 0, last = 0
      character(:), allocatable :: message
   end type deck_error

   type, public :: deck_error_list
      integer :: n = 0
      type(deck_error), allocatable :: items(:)
   contains
      procedure :: add
      procedure :: add_all
      procedure :: any => any_error
   end type deck_error_list

contains

   !> Add one error. A message about the same place appears once.
   subroutine add(self, line, message, first, last)
      class(deck_error_list), intent(inout) :: self
      integer, intent(in)                   :: line    !! index in the deck text, 0: the deck as a whole
      character(*), intent(in)              :: message
      integer, intent(in), optional         :: first, last !! columns, both or none
      type(deck_error), allocatable :: wider(:)
      type(deck_error) :: item
      integer :: i

      item%line = line
      item%message = message
      if (present(first)) item%first = first
      if (present(last)) item%last = last
      do i = self%n, max(1, self%n - 20), -1
         if (self%items(i)%line == line .and. self%items(i)%first == item%first .and. self%items(i)%message == message) return
      end do
      if (.not. allocated(self%items)) allocate (self%items(16))
      if (self%n == size(self%items)) then
         allocate (wider(2*self%n))
         wider(:self%n) = self%items
         call move_alloc(wider, self%items)
      end if
      self%n = self%n + 1
      self%items(self%n) = item
   end subroutine add

   !> Append the errors of OTHERS.
   subroutine add_all(self, others)
      class(deck_error_list), intent(inout) :: self
      type(deck_error_list), intent(in)     :: others
      integer :: i

      do i = 1, others%n
         associate (item => others%items(i))
            call self%add(item%line, item%message, item%first, item%last)
         end associate
      end do
   end subroutine add_all

   pure logical function any_error(self)
      class(deck_error_list), intent(in) :: self

      any_error = self%n > 0
   end function any_error

end module deck_errors
