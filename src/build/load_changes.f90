!> What a stage changes of the loads: forces, or pressures, by the nodal forces of both.
module load_changes
   use kinds, only: wp
   use model_data, only: stage_load_type
   use tolerances, only: zero_remainder
   implicit none
   private

   public :: note_changes, forget_others

   !> The nodal forces at the end of a stage; not allocated where no later stage starts from it.
   type, public :: nodal_loads
      real(wp), allocatable :: of_kind(:, :, :) !! (3, n_nodes, 2) of forces, of pressures [force]
   end type nodal_loads

contains

   !> Note what of LOADS, of which the pressures are PRESSING, differs from the nodal forces BEFORE, those of the stage from which this
   !! one starts. NOW are its own.
   pure subroutine note_changes(pressing, before, loads, now)
      real(wp), intent(in)                 :: pressing(:, :)  !! (3, n_nodes)
      real(wp), intent(in)                 :: before(:, :, :) !! (3, n_nodes, 2) of forces, of pressures
      type(stage_load_type), intent(inout) :: loads
      real(wp), allocatable, intent(out)   :: now(:, :, :)    !! likewise
      integer :: i, k

      allocate (now, mold=before)
      now(:, :, 1) = -pressing
      now(:, :, 2) = pressing
      do i = 1, loads%n
         now(:, loads%node(i), 1) = now(:, loads%node(i), 1) + loads%force(:, i)
      end do
      do k = 1, 2
         loads%changes(k) = any(abs(now(:, :, k) - before(:, :, k)) > zero_remainder*max(maxval(abs(now)), maxval(abs(before))))
      end do
   end subroutine note_changes

   !> Forget the loads AT the END of all stages but those FROM which later ones start.
   pure subroutine forget_others(from, at_end)
      integer, intent(in)              :: from(:)
      type(nodal_loads), intent(inout) :: at_end(0:)
      integer :: s

      do s = 0, ubound(at_end, 1)
         if (all(from /= s) .and. allocated(at_end(s)%of_kind)) deallocate (at_end(s)%of_kind)
      end do
   end subroutine forget_others

end module load_changes
