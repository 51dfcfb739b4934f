!> BACKBONE: frequency and loss factor of a mode over its amplitude, about the state at the end of a stage. The amplitude is the
!! displacement q |phi| of the mode at the node that moves most, or at a given node. For every amplitude the load alpha [M]
!! {phi} is sought under which the loop reaches it. Under an oscillating load with the modal force F = phi^T {F}, the mode alone
!! has the amplitude q at two frequencies, (F/q)^2 = (omega_r^2 - omega^2)^2 + (eta omega_r^2)^2, omega_r and eta those of q.
module backbone
   use analysis_state, only: analysis_type
   use element_mapping, only: two_pi
   use equation_solver, only: equation_system, failure_type
   use frequency_loads, only: load_at
   use kinds, only: wp
   use modal_loops, only: choose_sense, loop_type, run_loops
   use modal_path, only: modal_load_type, reverse, start_modal_load
   use mode_values, only: modes_type
   use mesh_queries, only: n_points
   use model_data, only: model_type
   use stage_plan, only: backbone_plan, loss_at, stage_plan_type, vibration_plan_type
   use terminal, only: show_line
   use text_tools, only: integer_text
   use tolerances, only: coarse_amplitude, coarse_limit, fine_limit, largest_to_rounding, same_alpha
   implicit none
   private

   public :: start_backbone, find_loop, finish_backbone

   real(wp), parameter :: exactly = 0.1_wp          ! of the tolerance of JAMPL: likewise with fine increments
   real(wp), parameter :: around = 2.0_wp           ! times the load: the two find the same load within this factor
   integer, parameter  :: most_trials = 60
   integer, parameter  :: steps = 20                ! of the response between two amplitudes

   type, public :: backbone_type
      integer  :: mode = 0                          !! number in the table of frequencies
      real(wp) :: omega_squared = 0.0_wp            !! of the mode [1/time^2]
      real(wp) :: peak = 0.0_wp                     !! |phi| at the node whose displacement the amplitude is
      integer  :: node = 0                          !! position of the node
      type(loop_type), allocatable :: loops(:)      !! in the order of their amplitudes
      character(:), allocatable    :: problem       !! why there is no backbone, or none up to the largest amplitude; '': there is
      logical  :: is_limited = .false.              !! the last loop is under the largest load that the structure carries
      type(modal_load_type), allocatable, private :: modal !! until the backbone is complete
      real(wp), allocatable :: answers(:, :)        !! (5, n) response of the mode alone: amplitude; frequency below, its phase;
                                                    !! frequency above, its phase [length, 1/time, degrees]; frequency < 0: none
   end type backbone_type

   !> A load and the resulting amplitude.
   type :: trial_type
      real(wp) :: alpha = 0.0_wp, amplitude = 0.0_wp
   end type trial_type

   !> The search for the load of an amplitude.
   type :: search_type
      real(wp) :: amplitude = 0.0_wp                !! requested
      type(trial_type) :: low, now, before          !! too small; the present trial; the one before
      type(trial_type) :: high = trial_type(huge(1.0_wp), 0.0_wp) !! too large
      real(wp) :: near = coarse_limit              !! of alpha: precision of the largest load that is carried
      real(wp) :: carried = 0.0_wp                  !! alpha up to which the load of the last failure was carried; 0: not known
      real(wp) :: slope = 0.0_wp                    !! of the load over the amplitude, 0: not known
      logical  :: ends = .false.
      logical  :: is_limited = .false.              !! ... because the structure does not carry a larger load
   contains
      procedure :: is_nearer, judge
   end type search_type

contains

   !> Choose the mode of the backbone FOUND and the node whose displacement is the amplitude, with the loops that ANALYSIS has kept.
   !! FAILURE where the state at the end of the stage is not in equilibrium.
   subroutine start_backbone(model, plan, analysis, system, modes, found, failure)
      type(model_type), intent(in)       :: model
      type(stage_plan_type), intent(in)  :: plan
      type(analysis_type), intent(in)    :: analysis
      class(equation_system), allocatable, intent(inout) :: system
      type(modes_type), intent(in)       :: modes
      type(backbone_type), intent(out)   :: found
      type(failure_type), intent(inout)  :: failure
      real(wp), allocatable :: moved(:)
      integer :: i, k

      found%problem = ''
      allocate (found%loops(0))
      associate (wanted => plan%stages(analysis%stage)%vibration%backbone)
         found%mode = wanted%mode
         k = wanted%mode - modes%n_before
         if (k < 1 .or. k > size(modes%modes)) then
            found%problem = 'THE MODE IS NOT AMONG THOSE FOUND'
         else if (modes%modes(k)%is_rigid) then
            found%problem = 'THE MODE HAS NO STRAIN'
         else
            moved = sqrt(sum(modes%modes(k)%u(:, :n_points(model%mesh))**2, dim=1)/modes%modes(k)%mass)
            found%omega_squared = modes%modes(k)%lambda
            found%node = wanted%node
            if (found%node == 0) found%node = findloc(moved >= (1.0_wp - largest_to_rounding)*maxval(moved), .true., dim=1)
            found%peak = moved(found%node)
            if (found%peak <= largest_to_rounding*maxval(moved)) found%problem = 'THE REQUESTED NODE DOES NOT MOVE IN THIS MODE'
         end if
      end associate
      if (index(system%description%name, 'PETSC') == 1) found%problem = 'IT NEEDS SOLVER = TREE OR SKYLINE'
      if (found%problem /= '') return
      allocate (found%modal)
      associate (mode => modes%modes(k))
         call start_modal_load(model, plan, analysis, system, mode%u/sqrt(mode%mass), found%modal, failure)
      end associate
      if (allocated(analysis%kept)) &
         found%loops = [(taken_up(size(model%joints%list), analysis%kept(:, i)), i = 1, size(analysis%kept, 2))]
   end subroutine start_backbone

   !> Find the loop of the next amplitude of the backbone and keep it in ANALYSIS; MORE is false where none is left.
   subroutine find_loop(model, plan, analysis, found, more)
      type(model_type), intent(in)       :: model
      type(stage_plan_type), intent(in)  :: plan
      type(analysis_type), intent(inout) :: analysis
      type(backbone_type), intent(inout) :: found
      logical, intent(out)               :: more
      type(loop_type) :: loop
      integer :: i, k

      associate (wanted => plan%stages(analysis%stage)%vibration%backbone)
         i = size(found%loops) + 1
         more = found%problem == '' .and. i <= size(wanted%amplitudes)
         if (.not. more) return
         found%modal%place = 'backbone, amplitude '//integer_text(i)//' of '//integer_text(size(wanted%amplitudes))
         call show_line(found%modal%place, at_once=i == 1)
         call reach_amplitude(model, wanted, wanted%amplitudes(i), found, loop)
         more = found%problem == '' .and. loop%n_loops > 0
         if (loop%n_loops > 0) found%loops = [found%loops, loop]
         if (loop%n_loops == 0 .and. found%problem == '') found%problem = 'no load has a loop of this amplitude'
         if (more) analysis%kept = reshape([(numbers_of(found%loops(k)), k = 1, i)], [size(numbers_of(loop)), i])
      end associate
   end subroutine find_loop

   !> The printed numbers of LOOP, for a restart file; and a loop of these NUMBERS.
   pure function numbers_of(loop) result(numbers)
      type(loop_type), intent(in) :: loop
      real(wp), allocatable :: numbers(:)

      numbers = [loop%alpha, loop%q, loop%omega_squared, loop%loss, loop%centre, loop%gap, loop%distortion, loop%slipping, &
                 loop%open, real(loop%n_loops, wp), loop%unsettled, loop%shares, loop%way]
   end function numbers_of

   pure type(loop_type) function taken_up(n_joints, numbers) result(loop)
      integer, intent(in)  :: n_joints
      real(wp), intent(in) :: numbers(:)

      loop = loop_type(numbers(1), numbers(2), numbers(3), numbers(4), numbers(5), numbers(6), numbers(7), numbers(8), numbers(9), &
                       nint(numbers(10)), numbers(11), shares=numbers(12:11 + n_joints), &
                       way=reshape(numbers(12 + n_joints:), [2, (size(numbers) - 11 - n_joints)/2]))
   end function taken_up

   !> The LOOP of this AMPLITUDE. Loops of coarse increments find about the load. From there on increments are halved to the
   !! tolerance of WANTED. Where the structure does not carry the load of the amplitude, LOOP is that of the largest load found, if
   !! it is above that of the last loop.
   subroutine reach_amplitude(model, wanted, amplitude, found, loop)
      type(model_type), intent(in)       :: model
      type(backbone_plan), intent(in)    :: wanted
      real(wp), intent(in)               :: amplitude
      type(backbone_type), intent(inout) :: found
      type(loop_type), intent(out)       :: loop
      type(search_type) :: search
      type(loop_type)   :: coarse

      if (found%modal%sense < 0.0_wp) call reverse(found%modal) ! a resumed run begins so, too
      search%amplitude = amplitude
      search%now%alpha = found%omega_squared*amplitude/found%peak
      if (size(found%loops) > 0) then
         search%low%alpha = found%loops(size(found%loops))%alpha
         search%low%amplitude = found%loops(size(found%loops))%q*found%peak
         search%slope = search%low%alpha/search%low%amplitude
         search%now%alpha = search%slope*amplitude
      end if
      call try_loads(model, wanted, coarse_amplitude, search, found, coarse)
      if (coarse%n_loops == 0) return
      call choose_sense(model, found%modal, wanted, coarse)
      search%low = trial_type(coarse%alpha/around, 0.0_wp)
      search%high%alpha = min(coarse%alpha*around, 2.0_wp*search%high%alpha - search%low%alpha)
      search%near = fine_limit
      if (search%is_limited) search%now%alpha = coarse%alpha
      call try_loads(model, wanted, exactly*wanted%tolerance, search, found, loop, coarse)
      if (loop%n_loops == 0) loop = coarse
   end subroutine reach_amplitude

   !> Try loads until the loop has the amplitude of SEARCH within TOLERANCE, by coarse increments, or by FINE ones from that loop
   !! on. LOOP is the nearest one.
   subroutine try_loads(model, wanted, tolerance, search, found, loop, fine)
      type(model_type), intent(in)          :: model
      type(backbone_plan), intent(in)       :: wanted
      real(wp), intent(in)                  :: tolerance
      type(search_type), intent(inout)      :: search
      type(backbone_type), intent(inout)    :: found
      type(loop_type), intent(out)          :: loop
      type(loop_type), intent(in), optional :: fine
      type(loop_type)    :: next
      type(failure_type) :: none, refused
      integer :: trial

      search%before = trial_type()
      search%carried = 0.0_wp
      do trial = 1, most_trials
         refused = none
         call run_loops(model, found%modal, wanted, search%now%alpha, next, refused, fine)
         if (refused%raised) then
            found%problem = refused%message
            search%carried = found%modal%carried
         else if (loop%n_loops == 0 .or. search%is_nearer(next%q*found%peak, loop%q*found%peak)) then
            loop = next
         end if
         call search%judge(merge(huge(1.0_wp), next%q*found%peak, refused%raised), tolerance)
         if (search%ends) exit
      end do
      found%is_limited = search%is_limited
      if (.not. found%is_limited) found%problem = ''
   end subroutine try_loads

   !> Whether amplitude A is nearer to the requested one than B.
   pure logical function is_nearer(search, a, b)
      class(search_type), intent(in) :: search
      real(wp), intent(in)           :: a, b

      is_nearer = abs(a - search%amplitude) < abs(b - search%amplitude)
   end function is_nearer

   !> Judge the AMPLITUDE under the present load, huge where the structure does not carry the load, and choose the next load: by
   !! the secant through the last two, or on either side of the load up to which a failed path was carried, between the loads
   !! found too small and too large. The search ends within TOLERANCE of the requested amplitude, and where no load is left
   !! between the two.
   subroutine judge(search, amplitude, tolerance)
      class(search_type), intent(inout) :: search
      real(wp), intent(in)              :: amplitude, tolerance
      real(wp) :: alpha

      search%now%amplitude = amplitude
      search%ends = abs(amplitude - search%amplitude) <= tolerance*search%amplitude
      if (amplitude < search%amplitude) then
         search%low = search%now
      else
         search%high = search%now
      end if
      alpha = -1.0_wp ! of the secant
      if (amplitude < huge(1.0_wp)) then
         associate (now => search%now, before => search%before)
            if (search%slope <= 0.0_wp .or. (before%alpha > 0.0_wp .and. abs(amplitude - before%amplitude) > 0.0_wp)) &
               search%slope = (now%alpha - before%alpha)/(amplitude - before%amplitude)
            alpha = now%alpha + (search%amplitude - amplitude)*search%slope
         end associate
         search%before = search%now
      end if
      associate (low => search%low%alpha, high => search%high%alpha)
         if (.not. between(alpha)) alpha = (1.0_wp - 0.5_wp*search%near)*search%carried
         if (.not. between(alpha)) alpha = (1.0_wp + 0.5_wp*search%near)*search%carried
         if (.not. between(alpha)) alpha = merge(0.5_wp*(low + high), 2.0_wp*low, high < huge(1.0_wp))
         search%is_limited = .not. search%ends .and. search%high%amplitude >= huge(1.0_wp) .and. high - low <= search%near*high
         search%ends = search%ends .or. search%is_limited .or. high - low <= same_alpha*high
      end associate
      search%now%alpha = alpha

   contains

      !> Whether ALPHA lies between the loads found too small and too large.
      pure logical function between(alpha)
         real(wp), intent(in) :: alpha

         between = alpha > search%low%alpha .and. alpha < search%high%alpha
      end function between

   end subroutine judge

   !> Complete the backbone FOUND. Where the stage asks for a response, this is the response of the mode alone to the modal force,
   !! at every amplitude of FOUND and between these (linear over log q). The two frequencies meet at resonance, which has a row of
   !! its own.
   subroutine finish_backbone(model, vibration, modes, found)
      type(model_type), intent(in)          :: model
      type(vibration_plan_type), intent(in) :: vibration
      type(modes_type), intent(in)          :: modes
      type(backbone_type), intent(inout)    :: found
      real(wp) :: row(5), before, excess, force, high, loss, low, w ! loss factor without the joints
      integer  :: i, k, n

      if (.not. allocated(found%modal)) return
      if (allocated(vibration%response)) then
         associate (waves => vibration%response%waves, mode => modes%modes(found%mode - modes%n_before))
            force = abs(sum([(load_at(waves(i)%law, mode%frequency)* &
                              sum(found%modal%phi*waves(i)%force(:model%mesh%dimension, :)), i = 1, size(waves))]))
         end associate
      end if
      deallocate (found%modal)
      if (.not. allocated(vibration%response)) return
      associate (mode => modes%modes(found%mode - modes%n_before))
         loss = mode%material_loss
         if (allocated(vibration%response%damping)) loss = loss + loss_at(vibration%response%damping, mode%frequency)
      end associate
      allocate (found%answers(5, 0))
      before = 1.0_wp
      do i = 1, size(found%loops)
         n = merge(steps, 1, i > 1)
         do k = 1, n
            w = real(k, wp)/n
            call answer(w)
            if (i > 1 .and. before*excess < 0.0_wp) then ! resonance lies between this amplitude and the one before: bisection
               low = w - 1.0_wp/n
               high = w
               do while (high - low > same_alpha)
                  w = 0.5_wp*(low + high)
                  call answer(w)
                  if (excess*before > 0.0_wp) low = w
                  if (excess*before <= 0.0_wp) high = w
               end do
               call answer(merge(low, high, before > 0.0_wp))
               row([3, 5]) = -90.0_wp
               row(4) = row(2)
               found%answers = reshape([found%answers, row], [5, size(found%answers, 2) + 1])
               call answer(real(k, wp)/n)
            end if
            if (excess > 0.0_wp) found%answers = reshape([found%answers, row], [5, size(found%answers, 2) + 1])
            before = excess
         end do
      end do

   contains

      !> The row of the amplitude at fraction W from the loop before to loop I; EXCESS: F/q less the damping force at resonance.
      subroutine answer(w)
         real(wp), intent(in) :: w
         real(wp) :: q, omega_squared, lost, beside

         associate (a => found%loops(max(1, i - 1)), b => found%loops(i))
            q = a%q**(1.0_wp - w)*b%q**w
            omega_squared = (1.0_wp - w)*a%omega_squared + w*b%omega_squared
            lost = ((1.0_wp - w)*a%loss + w*b%loss + loss)*omega_squared
         end associate
         excess = force/q - lost
         beside = sqrt(max(0.0_wp, excess*(force/q + lost)))
         row(1) = q*found%peak
         row([2, 4]) = sqrt(max(0.0_wp, omega_squared + beside*[-1.0_wp, 1.0_wp]))/two_pi
         if (omega_squared < beside) row(2) = -1.0_wp
         row(3) = -atan2(lost, beside)*360.0_wp/two_pi
         row(5) = -180.0_wp - row(3)
      end subroutine answer

   end subroutine finish_backbone

end module backbone
