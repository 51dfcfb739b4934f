!> Nodes that case control names: those of a SET, or those of a marked surface.
module node_limits
   use field_rules, only: parse_integer
   implicit none
   private

   public :: read_limit

   !> One of the two.
   type, public :: limit_type
      logical :: is_mark = .false.
      integer :: id = 0, line = 0
   end type limit_type

contains

   !> Append WORD, 'SET 5' or 'PMARK 20' in capitals, to LIMITS; OK is false where it is neither.
   pure subroutine read_limit(word, line, limits, ok)
      character(*), intent(in) :: word
      integer, intent(in)      :: line !! of the entry
      type(limit_type), allocatable, intent(inout) :: limits(:) !! not allocated: none so far
      logical, intent(out)     :: ok
      type(limit_type) :: limit

      ok = index(word, 'SET ') == 1 .or. index(word, 'PMARK ') == 1
      if (.not. ok) return
      limit%is_mark = word(1:1) == 'P'
      limit%line = line
      call parse_integer(trim(adjustl(word(index(word, ' '):))), limit%id, ok)
      if (.not. ok) return
      if (.not. allocated(limits)) allocate (limits(0))
      limits = [limits, limit]
   end subroutine read_limit

end module node_limits
