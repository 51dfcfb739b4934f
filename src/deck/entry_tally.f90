!> Entries of a deck that are read and have no effect: how many, and which, for one line of the listing and one on the screen.
!! NASTRAN has many that ask for output, choose a way of solving, or belong to what a deck does not use.
module entry_tally
   use text_tools, only: integer_text
   implicit none
   private

   integer, parameter :: name_length = 20

   !> What has no effect in one deck.
   type, public :: entry_tally_type
      integer :: n = 0                                        !! entries
      character(name_length), allocatable, private :: names(:) ! of them, each once, in the order of their appearance
   contains
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
