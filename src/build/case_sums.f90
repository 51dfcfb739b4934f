!> SUBCOM: the loads of a stage that combines independent cases. Its displacements are then the same combination of theirs, because
!! the structure is linear and the supports are the same.
module case_sums
   use kinds, only: wp
   use model_data, only: history_type, stage_load_type
   use stage_plan, only: stage_plan_type
   implicit none
   private

   public :: sum_cases

contains

   !> Set the loads, movements of supports and temperatures of each SUBCOM in HISTORY.
   pure subroutine sum_cases(plan, history)
      type(stage_plan_type), intent(in) :: plan
      type(history_type), intent(inout) :: history
      type(stage_load_type), allocatable :: total ! on the heap: the compiler warns of its bounds where it is a local variable
      integer :: k, s

      do s = 1, size(plan%stages)
         if (.not. allocated(plan%stages(s)%parts)) cycle
         allocate (total)
         allocate (total%node(0), total%force(3, 0))
         do k = 1, size(plan%stages(s)%parts)
            associate (part => history%stages(plan%stages(s)%parts(k)), factor => plan%stages(s)%factors(k))
               total%node = [total%node, part%node(:part%n)]
               total%force = reshape([total%force, factor*part%force(:, :part%n)], [3, size(total%node)])
               call add(total%moved, factor, part%moved)
               call add(total%beam, factor, part%beam)
               call add(total%temperature%own, factor, part%temperature%own)
               total%temperature%reference_share = total%temperature%reference_share + factor*part%temperature%reference_share
               if (.not. allocated(part%temperature%at)) cycle
               if (.not. allocated(total%temperature%at)) total%temperature%at = 0.0_wp*part%temperature%at
               total%temperature%at = total%temperature%at + factor*part%temperature%at
            end associate
         end do
         total%n = size(total%node)
         history%stages(s) = total
         deallocate (total)
      end do
   end subroutine sum_cases

   !> Add FACTOR times PART to TOTAL; what is not allocated is zero.
   pure subroutine add(total, factor, part)
      real(wp), allocatable, intent(inout) :: total(:, :)
      real(wp), intent(in)                 :: factor
      real(wp), allocatable, intent(in)    :: part(:, :)

      if (.not. allocated(part)) return
      if (.not. allocated(total)) allocate (total, source=0.0_wp*part)
      total = total + factor*part
   end subroutine add

end module case_sums
