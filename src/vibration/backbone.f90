!> BACKBONE: frequency and loss factor of a mode as they change with its amplitude, about the state at the end of a stage. The amplitude is
!! the displacement that the mode has at the node that moves most, or at the node asked for, q |phi|; for every amplitude the load
!! alpha [M] {phi} is sought under which the loop reaches it.
module backbone
   use analysis_state, only: analysis_type
   use equation_solver, only: equation_system
   use failures, only: failure_type
   use kinds, only: wp
   use mass_matrix, only: mass_matrix_type
   use modal_loops, only: loop_type, push_type, run_loops, start_push
   use mode_values, only: modes_type
   use model_data, only: model_type, n_points
   use stage_plan, only: backbone_plan, stage_plan_type
   use terminal_line, only: show_line
   use text_tools, only: integer_text
   implicit none
   private

   public :: find_backbone

   real(wp), parameter :: reached = 1.0e-7_wp       ! of an amplitude: nearer none is sought
   real(wp), parameter :: same = 1.0e-12_wp         ! of alpha: the loop jumps between two that are as near
   real(wp), parameter :: near_limit = 1.0e-4_wp    ! of alpha: so near the largest load that is borne is known
   integer, parameter  :: most_trials = 60

   type, public :: backbone_type
      integer  :: mode = 0                          !! number in the table of frequencies
      real(wp) :: omega_squared = 0.0_wp            !! of the mode [1/time^2]
      real(wp) :: peak = 0.0_wp                     !! |phi| at the node whose displacement the amplitude is
      integer  :: node = 0                          !! its position
      type(loop_type), allocatable :: loops(:)      !! in the order of their amplitudes
      character(:), allocatable    :: problem       !! why there is none, or not up to the largest amplitude; '': there is
      logical  :: is_limited = .false.              !! the last loop is under the largest load that the structure bears
   end type backbone_type

   !> A load and the amplitude to which it leads.
   type :: trial_type
      real(wp) :: alpha = 0.0_wp, amplitude = 0.0_wp
   end type trial_type

contains

   !> The backbone that PLAN asks for. FAILURE where the state at the end of the stage is not in equilibrium.
   subroutine find_backbone(model, plan, analysis, system, mass, modes, found, failure)
      type(model_type), intent(in)       :: model
      type(stage_plan_type), intent(in)  :: plan
      type(analysis_type), intent(in)    :: analysis
      class(equation_system), intent(in) :: system
      type(mass_matrix_type), intent(in) :: mass
      type(modes_type), intent(in)       :: modes
      type(backbone_type), intent(out)   :: found
      type(failure_type), intent(inout)  :: failure
      type(push_type) :: push
      type(loop_type) :: loop
      integer :: i

      associate (wanted => plan%stages(analysis%stage)%vibration%backbone)
         call choose_mode(model, modes, wanted, found)
         if (found%problem /= '') return
         associate (mode => modes%modes(wanted%mode - modes%n_before))
            call start_push(model, plan, analysis, system, mass, mode%u/sqrt(mode%mass), push, failure)
         end associate
         if (failure%raised) return
         do i = 1, size(wanted%amplitudes)
            call show_line('backbone, amplitude '//integer_text(i)//' of '//integer_text(size(wanted%amplitudes)), at_once=i == 1)
            call reach_amplitude(model, mass, wanted, wanted%amplitudes(i), push, found, loop)
            if (loop%n_loops > 0) found%loops = [found%loops, loop]
            if (found%problem /= '') exit
         end do
      end associate
   end subroutine find_backbone

   !> The mode that is WANTED among MODES, and the node whose displacement is the amplitude.
   subroutine choose_mode(model, modes, wanted, found)
      type(model_type), intent(in)       :: model
      type(modes_type), intent(in)       :: modes
      type(backbone_plan), intent(in)    :: wanted
      type(backbone_type), intent(inout) :: found
      real(wp), allocatable :: moved(:)

      found%mode = wanted%mode
      found%problem = ''
      allocate (found%loops(0))
      associate (k => wanted%mode - modes%n_before)
         if (k < 1 .or. k > size(modes%modes)) then
            found%problem = 'THE MODE IS NOT AMONG THOSE FOUND'
         else if (modes%modes(k)%is_rigid) then
            found%problem = 'THE MODE HAS NO STRAIN'
         else
            moved = sqrt(sum(modes%modes(k)%u(:, :n_points(model))**2, dim=1)/modes%modes(k)%mass)
            found%omega_squared = modes%modes(k)%lambda
            found%node = wanted%node
            if (found%node == 0) found%node = findloc(moved >= (1.0_wp - reached)*maxval(moved), .true., dim=1)
            found%peak = moved(found%node)
            if (found%peak <= reached*maxval(moved)) found%problem = 'THE NODE ASKED FOR DOES NOT MOVE IN THIS MODE'
         end if
      end associate
   end subroutine choose_mode

   !> The LOOP of this AMPLITUDE, by secants over the load, within what has been found too little and too much. A load that is not borne is
   !! too much; where there is no room left below it the loop of the largest load that is borne is the last, if it adds one.
   subroutine reach_amplitude(model, mass, wanted, amplitude, push, found, loop)
      type(model_type), intent(in)       :: model
      type(mass_matrix_type), intent(in) :: mass
      type(backbone_plan), intent(in)    :: wanted
      real(wp), intent(in)               :: amplitude
      type(push_type), intent(inout)     :: push
      type(backbone_type), intent(inout) :: found
      type(loop_type), intent(out)       :: loop
      type(trial_type)   :: low, high, now, before
      type(loop_type)    :: next, best
      type(failure_type) :: refused, none
      integer :: trial

      high%alpha = huge(1.0_wp)
      now%alpha = found%omega_squared*amplitude/found%peak
      if (size(found%loops) > 0) then
         low%alpha = found%loops(size(found%loops))%alpha
         low%amplitude = found%loops(size(found%loops))%q*found%peak
         now%alpha = low%alpha*amplitude/low%amplitude
      end if
      before = low
      do trial = 1, most_trials
         refused = none
         call run_loops(model, mass, push, now%alpha, wanted%cycles, wanted%increments, next, refused)
         if (refused%raised) then
            high = trial_type(now%alpha, huge(1.0_wp))
            found%problem = refused%message
            now%alpha = 0.5_wp*(low%alpha + high%alpha)
         else
            loop = next
            now%amplitude = next%q*found%peak
            if (abs(now%amplitude - amplitude) <= reached*amplitude) exit
            if (now%amplitude < amplitude) then
               low = now
               best = next
            else
               high = now
            end if
            call next_trial(amplitude, low, high, before, now)
         end if
         if (high%alpha - low%alpha <= same*high%alpha) exit
         found%is_limited = high%amplitude >= huge(1.0_wp) .and. high%alpha - low%alpha <= near_limit*high%alpha
         if (found%is_limited) exit
      end do
      if (found%is_limited) then
         loop = best
      else
         found%problem = ''
      end if
   end subroutine reach_amplitude

   !> NOW becomes the next trial: by the secant through it and the one BEFORE, within LOW and HIGH.
   pure subroutine next_trial(amplitude, low, high, before, now)
      real(wp), intent(in)            :: amplitude
      type(trial_type), intent(in)    :: low, high
      type(trial_type), intent(inout) :: before, now
      real(wp) :: alpha

      alpha = -1.0_wp
      if (abs(now%amplitude - before%amplitude) > 0.0_wp) alpha = now%alpha + (amplitude - now%amplitude)* &
         (now%alpha - before%alpha)/(now%amplitude - before%amplitude)
      before = now
      if (.not. (alpha > low%alpha .and. alpha < high%alpha)) then
         alpha = 2.0_wp*low%alpha
         if (high%alpha < huge(1.0_wp)) alpha = 0.5_wp*(low%alpha + high%alpha)
      end if
      now%alpha = alpha
   end subroutine next_trial

end module backbone
