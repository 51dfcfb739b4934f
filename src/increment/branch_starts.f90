!> The points (delta, tau) at which the shear branches of the interface elements began, for the listing only. A branch of
!! unloading or reloading is shifted so that it passes through this point (b0 and c0 of section 4.3).
module branch_starts
   use branch_cubic, only: cubic_value
   use joint_laws, only: element_state
   use kinds, only: wp
   use normal_stiffness, only: branch_load
   use shear_stiffness, only: cubic_of, shear_law, shear_state
   implicit none
   private

   public :: note_turns, branch_shift

   !> One direction of one interface element.
   type, public :: turning_point
      integer  :: branch = branch_load          !! that began there
      integer, private :: filler = 0            ! as in normal_state
      real(wp) :: delta = 0.0_wp, tau = 0.0_wp  !! where it began [length], [pressure]
   end type turning_point

contains

   !> Note in TURNS(2, n) the branches that began with the last movement of the elements in these STATES. A branch begins at the
   !! point before the movement.
   pure subroutine note_turns(states, turns)
      type(element_state), intent(in)    :: states(:)
      type(turning_point), intent(inout) :: turns(:, :)
      integer :: i, k

      do i = 1, size(states)
         do k = 1, 2
            associate (state => states(i)%shear(k))
               if (turns(k, i)%branch /= state%branch) &
                  turns(k, i) = turning_point(branch=state%branch, delta=state%delta_before, tau=state%tau_before)
            end associate
         end do
      end do
   end subroutine note_turns

   !> b0 or c0: the shift by which the curve of the branch of STATE under the pressure P passes through the point TURN, where
   !! the branch began; zero on the loading curve [pressure].
   pure real(wp) function branch_shift(law, state, p, turn) result(shift)
      type(shear_law), intent(in)     :: law
      type(shear_state), intent(in)   :: state
      real(wp), intent(in)            :: p
      type(turning_point), intent(in) :: turn

      shift = 0.0_wp
      if (state%branch == branch_load) return
      shift = state%sense*turn%tau - cubic_value(cubic_of(law, state%branch), state%sense*(turn%delta - state%delta_0), p)
   end function branch_shift

end module branch_starts
