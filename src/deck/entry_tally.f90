!> Entries of a deck that are read and have no effect: how many, and which, for one line of the listing and one on the screen.
!! NASTRAN has many that ask for output, choose a way of solving, or belong to what a deck does not use.
!! Of some it is the rest of the deck that tells: damping of materials has an effect where the structure oscillates.
module entry_tally
   use deck_errors, only: deck_error_list
   use text_tools, only: integer_text
   implicit none
   private

   integer, parameter :: name_length = 40

   !> An entry of which it is not known yet whether it has an effect.
   type :: waiting_entry
      character(name_length) :: name = ''
      integer :: n = 1                        ! of this name
      integer :: line = 0                     ! of the first in the deck text
      logical :: needs_response = .false.     ! it has an effect with FREQUENCY only; else with MODES
      character(:), allocatable :: refusal    ! why the effect that it would have is an error, empty: it is not
   end type waiting_entry

   !> What has no effect in one deck.
   type, public :: entry_tally_type
      integer :: n = 0                                        !! entries
      character(name_length), allocatable, private :: names(:) ! of them, each once, in the order of their appearance
      type(waiting_entry), allocatable, private :: waiting(:)
   contains
      procedure :: wait, settle
      procedure :: add
      procedure :: words
   end type entry_tally_type

contains

   !> One more entry that is called NAME.
   pure subroutine add(self, name)
      class(entry_tally_type), intent(inout) :: self
      character(*), intent(in)               :: name

      if (.not. allocated(self%names)) allocate (self%names(0))
      self%n = self%n + 1
      if (all(self%names /= name)) self%names = [character(name_length) :: self%names, name]
   end subroutine add

   !> The entry NAME on LINE has an effect where the structure oscillates, or responds to a load; with a REFUSAL that is an error.
   pure subroutine wait(self, name, line, needs_response, refusal)
      class(entry_tally_type), intent(inout) :: self
      character(*), intent(in)               :: name
      integer, intent(in)                    :: line
      logical, intent(in)                    :: needs_response
      character(*), intent(in), optional     :: refusal
      type(waiting_entry) :: entry
      integer :: i

      if (.not. allocated(self%waiting)) allocate (self%waiting(0))
      i = findloc(self%waiting%name == name, .true., dim=1)
      if (i > 0) then
         self%waiting(i)%n = self%waiting(i)%n + 1
         if (present(refusal) .and. self%waiting(i)%refusal == '') self%waiting(i)%refusal = refusal
         return
      end if
      entry%name = name
      entry%line = line
      entry%needs_response = needs_response
      entry%refusal = ''
      if (present(refusal)) entry%refusal = refusal
      self%waiting = [self%waiting, entry]
   end subroutine wait

   !> Now it is known whether any stage has MODES, and FREQUENCY.
   subroutine settle(self, has_modes, has_response, errors)
      class(entry_tally_type), intent(inout) :: self
      logical, intent(in)                    :: has_modes, has_response
      type(deck_error_list), intent(inout)   :: errors
      integer :: i

      if (.not. allocated(self%waiting)) return
      do i = 1, size(self%waiting)
         associate (entry => self%waiting(i))
            if (.not. merge(has_response, has_modes, entry%needs_response)) then
               call self%add(trim(entry%name))
               self%n = self%n + entry%n - 1
            else if (entry%refusal /= '') then
               call errors%add(entry%line, trim(entry%name)//': another response than it would have without; '//entry%refusal)
            end if
         end associate
      end do
      deallocate (self%waiting)
   end subroutine settle

   !> '12 entries without effect: PARAM, DISPLACEMENT'; empty where there are none.
   pure function words(self) result(text)
      class(entry_tally_type), intent(in) :: self
      character(:), allocatable           :: text
      integer :: i

      text = ''
      if (self%n == 0) return
      text = integer_text(self%n)//trim(merge(' entry  ', ' entries', self%n == 1))//' without effect: '//trim(self%names(1))
      do i = 2, size(self%names)
         text = text//', '//trim(self%names(i))
      end do
   end function words

end module entry_tally
