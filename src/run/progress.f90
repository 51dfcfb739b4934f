!> Progress on the terminal: stage, increment of how many, time left. Nothing where the standard error is no terminal.
module progress
   use, intrinsic :: iso_fortran_env, only: error_unit
   use c_library, only: is_terminal
   use kinds, only: long, wp
   use stage_plan, only: stage_plan_type
   use text_tools, only: integer_text
   implicit none
   private

   type, public :: progress_type
      private
      logical :: shown = .false.
      integer :: done  = 0, total = 0
      integer(long) :: started = 0, last = 0, rate = 1
      character(:), allocatable :: deck
   contains
      procedure :: start
      procedure :: advance
      procedure :: finish
   end type progress_type

contains

   subroutine start(self, deck, plan, quiet)
      class(progress_type), intent(inout) :: self
      character(*), intent(in)            :: deck
      type(stage_plan_type), intent(in)   :: plan
      logical, intent(in)                 :: quiet
      integer :: s

      self%shown = .false.
      if (.not. quiet) self%shown = is_terminal(2)
      self%deck = deck
      self%done = 0
      self%total = sum([(size(plan%stages(s)%shares), s = 1, size(plan%stages))])
      call system_clock(self%started, self%rate)
      self%last = self%started
   end subroutine start


   !> One more increment is done; say so five times a second at most.
   subroutine advance(self, stage, increment, increments)
      class(progress_type), intent(inout) :: self
      integer, intent(in)                 :: stage, increment, increments
      integer(long) :: now
      real(wp) :: left

      self%done = self%done + 1
      if (.not. self%shown) return
      call system_clock(now)
      if (5*(now - self%last) < self%rate) return
      self%last = now
      left = real(now - self%started, wp)/self%rate*(self%total - self%done)/self%done
      write (error_unit, '(a)', advance='no') achar(13)//self%deck//': stage '//integer_text(stage)//', increment '// &
         integer_text(increment)//' of '//integer_text(increments)//', '//integer_text(nint(left))//' s left    '
      flush (error_unit)
   end subroutine advance


   subroutine finish(self)
      class(progress_type), intent(inout) :: self

      if (self%shown .and. self%last > self%started) write (error_unit, '(a)', advance='no') &
         achar(13)//repeat(' ', len(self%deck) + 60)//achar(13)
      self%shown = .false.
   end subroutine finish

end module progress
