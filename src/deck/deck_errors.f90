!> Collects the errors of a deck, so that a user sees all of them at once, sorts them into kinds for print, and collects the warnings.
module deck_errors
   use text_tools, only: append, text_item
   implicit none
   private

   public :: sort_into_kinds

   integer, parameter :: most_of_kind = 10 ! so many are printed
   character(*), parameter :: no_card = 'is not a card of' ! such an error is printed once for each name

   !> One error: its message and its place (index of the line in the deck text, 0 for the deck as a whole; columns first to last, 0 for
   !! the whole line).
   type, public :: deck_error
      integer :: line = 0, first = 0, last = 0
      character(:), allocatable :: message
   end type deck_error

   type, public :: deck_error_list
      integer :: n = 0
      type(deck_error), allocatable :: items(:)
      type(text_item), allocatable  :: warnings(:) !! about the model
   contains
      procedure :: add
      procedure :: warn
      procedure :: any => any_error
   end type deck_error_list

   !> Errors whose messages differ only in numbers and quoted text.
   type, public :: error_kind
      character(:), allocatable :: words   ! common part of its messages
      integer :: n = 0                     ! errors
      integer :: most = most_of_kind       ! largest number printed
      integer :: printed = 0               ! so far
      integer :: last = 0                  ! number of the error printed last
   end type error_kind

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

   !> Add WORDS to the warnings, if there are any, once.
   pure subroutine warn(self, words)
      class(deck_error_list), intent(inout) :: self
      character(*), intent(in)              :: words
      integer :: i

      if (allocated(self%warnings)) then
         if (any([(self%warnings(i)%words == words, i = 1, size(self%warnings))])) return
      end if
      call append(self%warnings, words)
   end subroutine warn

   pure logical function any_error(self)
      class(deck_error_list), intent(in) :: self

      any_error = self%n > 0
   end function any_error

   !> The kinds of ERRORS, and the kind of each error in this ORDER: errors of a kind have the same message without numbers, blanks
   !! and quoted text. Unknown cards are of one kind where the whole message is the same.
   subroutine sort_into_kinds(errors, order, kinds, kind_of)
      type(deck_error_list), intent(in)         :: errors
      integer, intent(in)                       :: order(:)
      type(error_kind), allocatable, intent(out) :: kinds(:)
      integer, allocatable, intent(out)         :: kind_of(:)
      character(:), allocatable :: words
      logical :: is_card, quoted
      integer :: i, k, n

      allocate (kinds(size(order)), kind_of(size(order)))
      n = 0
      do k = 1, size(order)
         associate (message => errors%items(order(k))%message)
            is_card = index(message, no_card) > 0
            quoted = .false.
            words = ''
            do i = 1, len(message)
               if (message(i:i) == '''') quoted = .not. quoted
               if (is_card .or. .not. (quoted .or. scan(message(i:i), ' 0123456789.+-') == 1)) words = words//message(i:i)
            end do
         end associate
         do i = 1, n
            if (kinds(i)%words == words) exit
         end do
         kind_of(k) = i
         if (i <= n) cycle
         n = n + 1
         kinds(n)%words = words
         if (is_card) kinds(n)%most = 1
      end do
      kinds = kinds(:n)
   end subroutine sort_into_kinds

end module deck_errors
