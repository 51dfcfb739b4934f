!> One interface element from increment to increment, as the loop of interface_stiffness has it.
module element_steps
   use joint_laws, only: element_state, is_apart, joint_law, open_or_close, shear_pressure
   use kinds, only: wp
   use normal_stiffness, only: branch_open, norm
   use shear_stiffness, only: shear
   implicit none
   private

   public :: element_stiffness_of

contains

   !> NORM, and SHEAR once a direction: K = (k_sx, k_sy, k_n) for the next increment [force/length].
   subroutine element_stiffness_of(law, area, eq10, movement, state, k)
      type(joint_law), intent(in)        :: law
      real(wp), intent(in)               :: area        !! [length^2]
      logical, intent(in)                :: eq10
      real(wp), intent(in)               :: movement(3) !! in all [length]
      type(element_state), intent(inout) :: state
      real(wp), intent(out)              :: k(3)
      integer :: d
      logical :: was_apart

      was_apart = is_apart(state)
      call norm(law%normal, area, eq10, state%normal, k(3))
      call open_or_close(law, was_apart, movement, state)
      k(:2) = 0.0_wp
      if (state%normal%branch == branch_open) return
      do d = 1, 2
         call shear(law%shear(d), area, shear_pressure(area, state%normal), state%shear(d), k(d))
      end do
   end subroutine element_stiffness_of

end module element_steps
