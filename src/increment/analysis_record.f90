!> The state of the analysis in a restart file, and how it is taken up from it.
module analysis_record
   use analysis_state, only: analysis_type, joint_energy, pass_record, slip_record
   use branch_starts, only: turning_point
   use condition_estimate, only: condition_type
   use model_data, only: temperature_type
   use restart_stream, only: restart_stream_type
   use state_record, only: record_states
   implicit none
   private

   public :: record_analysis

contains

   !> Write ANALYSIS, or read it into one that start_analysis has made for the same model: everything in it but what stands still in
   !! an increment (condensed, which its first one prints) and what is so only while it is taken up (goes_on).
   subroutine record_analysis(stream, analysis)
      type(restart_stream_type), intent(inout) :: stream
      type(analysis_type), intent(inout)       :: analysis

      call stream%mark('PROGRESS')
      call stream%item(analysis%stage)
      call stream%item(analysis%increment)
      call stream%item(analysis%share)
      call stream%item(analysis%fraction)
      call stream%item(analysis%carry)
      call stream%item(analysis%eq10)
      call stream%item(analysis%average)
      call stream%item(analysis%is_loose)
      call stream%item(analysis%loose_force)
      call stream%item(analysis%is_settled)
      call stream%item(analysis%load_tolerance)
      call stream%item(analysis%tolerance)
      call record_loads(stream, analysis)
      call record_movements(stream, analysis)
      call record_joints(stream, analysis)
   end subroutine record_analysis

   !> What is known of all nodes.
   subroutine record_loads(stream, analysis)
      type(restart_stream_type), intent(inout) :: stream
      type(analysis_type), intent(inout)       :: analysis

      call stream%mark('LOADS')
      call stream%item(analysis%load_before)
      call stream%item(analysis%load_after)
      call stream%item(analysis%applied)
      call record_temperature(stream, analysis%temperature_before)
      call record_temperature(stream, analysis%temperature_after)
      call record_temperature(stream, analysis%temperature)
      call stream%list(analysis%loaded)
      call stream%item(analysis%is_moved)
      call stream%item(analysis%moves)
      call stream%item(analysis%moved_before)
      call stream%item(analysis%moved_after)
      call stream%item(analysis%moved)
      call stream%item(analysis%all_u)
      call stream%item(analysis%all_unbalanced)
      call stream%item(analysis%place)
   end subroutine record_loads

   !> What is known of retained nodes, bars and sections.
   subroutine record_movements(stream, analysis)
      type(restart_stream_type), intent(inout) :: stream
      type(analysis_type), intent(inout)       :: analysis

      call stream%mark('MOVEMENTS')
      call stream%item(analysis%held)
      call stream%item(analysis%felt_before)
      call stream%item(analysis%felt_after)
      call stream%item(analysis%felt)
      call stream%item(analysis%change)
      call stream%item(analysis%move)
      call stream%item(analysis%body)
      call stream%item(analysis%u)
      call stream%item(analysis%du)
      call stream%item(analysis%unbalanced)
      call stream%item(analysis%is_elastic)
      call stream%item(analysis%pull)
      call stream%item(analysis%is_locked)
   end subroutine record_movements

   !> What is known of interface elements and joints.
   subroutine record_joints(stream, analysis)
      type(restart_stream_type), intent(inout) :: stream
      type(analysis_type), intent(inout)       :: analysis

      call stream%mark('JOINTS')
      call record_states(stream, analysis%states)
      call stream%item(analysis%movement)
      call stream%item(analysis%k)
      if (allocated(analysis%exact)) call record_states(stream, analysis%exact)
      call record_turns(stream, analysis%turns)
      call stream%item(analysis%kind)
      call stream%item(analysis%next_kind)
      call record_condition(stream, analysis%condition)
      call record_energy(stream, analysis%energy)
      call record_passes(stream, analysis%passes, analysis%n_passes)
      call record_slips(stream, analysis%slips)
      call stream%item(analysis%largest_p)
      call stream%item(analysis%largest_lambda)
      call stream%item(analysis%largest_load)
      call stream%item(analysis%n_removed)
      call stream%item(analysis%ends_early)
      call stream%item(analysis%is_partial)
      call stream%item(analysis%n_parts)
   end subroutine record_joints

   subroutine record_temperature(stream, temperature)
      type(restart_stream_type), intent(inout) :: stream
      type(temperature_type), intent(inout)    :: temperature

      call stream%list(temperature%at)
      call stream%item(temperature%reference_share)
   end subroutine record_temperature

   subroutine record_turns(stream, turns)
      type(restart_stream_type), intent(inout) :: stream
      type(turning_point), intent(inout)       :: turns(:, :)
      integer :: i, k

      call stream%expect(size(turns))
      do i = 1, size(turns, 2)
         do k = 1, size(turns, 1)
            call stream%item(turns(k, i)%branch)
            call stream%item(turns(k, i)%delta)
            call stream%item(turns(k, i)%tau)
         end do
      end do
   end subroutine record_turns

   subroutine record_condition(stream, condition)
      type(restart_stream_type), intent(inout) :: stream
      type(condition_type), intent(inout)      :: condition

      call stream%item(condition%number)
      call stream%item(condition%node)
      call stream%item(condition%direction)
      call stream%item(condition%weakest)
      call stream%item(condition%is_new)
   end subroutine record_condition

   subroutine record_energy(stream, energy)
      type(restart_stream_type), intent(inout) :: stream
      type(joint_energy), intent(inout)        :: energy(:)
      integer :: i

      call stream%expect(size(energy))
      do i = 1, size(energy)
         call stream%item(energy(i)%put_in)
         call stream%item(energy(i)%given_back)
      end do
   end subroutine record_energy

   !> The first N of PASSES, behind which there is room.
   subroutine record_passes(stream, passes, n)
      type(restart_stream_type), intent(inout)        :: stream
      type(pass_record), allocatable, intent(inout)   :: passes(:)
      integer, intent(inout)                          :: n
      integer :: i

      call stream%count(n, 32)
      if (n > size(passes)) then
         deallocate (passes)
         allocate (passes(n))
      end if
      do i = 1, n
         call stream%item(passes(i)%before)
         call stream%item(passes(i)%after)
         call stream%item(passes(i)%step)
         call stream%item(passes(i)%changes)
         call stream%item(passes(i)%part)
      end do
   end subroutine record_passes

   subroutine record_slips(stream, slips)
      type(restart_stream_type), intent(inout)      :: stream
      type(slip_record), allocatable, intent(inout) :: slips(:)
      integer :: i, n

      n = size(slips)
      call stream%count(n, 96)
      if (n /= size(slips)) then
         deallocate (slips)
         allocate (slips(n))
      end if
      do i = 1, n
         call stream%item(slips(i)%pass)
         call stream%item(slips(i)%element)
         call stream%item(slips(i)%delta)
         call stream%item(slips(i)%tau)
         call stream%item(slips(i)%limit)
      end do
   end subroutine record_slips

end module analysis_record
