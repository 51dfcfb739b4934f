!> The states of interface elements in a restart file.
module state_record
   use joint_laws, only: element_state
   use normal_stiffness, only: normal_state
   use restart_stream, only: restart_stream_type
   use shear_stiffness, only: shear_state
   implicit none
   private

   public :: record_states

contains

   !> Write STATES, or read as many: everything in them.
   subroutine record_states(stream, states)
      type(restart_stream_type), intent(inout) :: stream
      type(element_state), intent(inout)       :: states(:)
      integer :: i, k

      call stream%mark('ELEMENTS')
      call stream%expect(size(states))
      do i = 1, size(states)
         call record_normal(stream, states(i)%normal)
         do k = 1, 2
            call record_shear(stream, states(i)%shear(k))
         end do
         call stream%item(states(i)%slips)
         call stream%item(states(i)%origin)
      end do
   end subroutine record_states

   subroutine record_normal(stream, state)
      type(restart_stream_type), intent(inout) :: stream
      type(normal_state), intent(inout)        :: state

      call stream%item(state%branch)
      call stream%item(state%p_av)
      call stream%item(state%sigmaf)
      call stream%item(state%sumf)
      call stream%item(state%gap)
      call stream%item(state%lambda)
      call stream%item(state%lambda_before)
      call stream%item(state%k_n)
      call stream%item(state%pressure)
      call stream%item(state%lambda_a)
      call stream%item(state%p_a)
      call stream%item(state%lambda_b)
   end subroutine record_normal

   subroutine record_shear(stream, state)
      type(restart_stream_type), intent(inout) :: stream
      type(shear_state), intent(inout)         :: state

      call stream%item(state%branch)
      call stream%item(state%sense)
      call stream%item(state%delta)
      call stream%item(state%delta_0)
      call stream%item(state%slid)
      call stream%item(state%delta_before)
      call stream%item(state%tau)
      call stream%item(state%tau_before)
      call stream%item(state%d_r)
      call stream%item(state%tau_r)
      call stream%item(state%offset)
      call stream%item(state%side)
      call stream%item(state%k_s)
   end subroutine record_shear

end module state_record
