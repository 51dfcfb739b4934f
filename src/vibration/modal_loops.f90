!> Quasi-static modal analysis: loops of the structure under alpha [M] {phi}, phi a natural mode.
!! Between alpha and -alpha the structure goes through loops, from the state at the end of a stage. With the modal coordinate
!! q = phi^T [M] (u - u_0), phi of generalised mass 1, the two strokes of the last loop give
!!
!!    omega^2 = alpha/q     zeta = D/(2 pi omega^2 q^2), q half the mean length of the strokes, D the loss of the joints
!!
!! D is what the laws of the elements absorb in the loop: the work done on them, less what they hold more at its end and would
!! give back. A loop that does not close moves the forces at rest, and their work is part of D: it is the loss of an element that
!! ratchets. Source: H. Festjens, G. Chevallier, J.-L. Dion, A numerical quasi-static method for the identification of frictional
!! dissipation in bolted joints, ASME DETC 2012-70583 and Int. J. Solids Struct. 2013; R. M. Lacayo, M. S. Allen, Mech. Syst.
!! Signal Process. 118 (2019) 133-157; E. Jewell, M. S. Allen, I. Zare, M. Wall, J. Sound Vib. 479 (2020) 115376.
module modal_loops
   use analysis_state, only: analysis_type
   use element_mapping, only: two_pi
   use equation_solver, only: failure_type
   use equations, only: recover_displacements
   use iwan_law, only: energy_gain
   use joint_laws, only: element_state, force_of, slices_of
   use kinds, only: wp
   use mass_matrix, only: mass_times
   use modal_path, only: begin_path, coordinate, follow_path, modal_load_type, path_type, remove_rigid_motion, reverse, &
                         start_path
   use model_data, only: model_type
   use node_coupling, only: displacements, forces_on_unknowns
   use shear_stiffness, only: shear_slope
   use stage_plan, only: backbone_plan
   use terminal, only: show_line
   use text_tools, only: integer_text, one_of
   use tolerances, only: equal_senses, minor_area, zero_loop_area
   implicit none
   private

   public :: run_loops, choose_sense

   real(wp), parameter :: settled_q = 0.3_wp         ! of the tolerance: change of q from loop to loop
   real(wp), parameter :: settled_area = 10.0_wp     ! likewise, of the area of a loop
   real(wp), parameter :: steady = 0.01_wp           ! of the gap: change of the gap of a loop that moves on for ever
   real(wp), parameter :: not_known = 0.9_wp         ! ratio of the changes of two loops, where there are but two
   real(wp), parameter :: slowest = 0.97_wp          ! likewise: a larger one counts as this
   real(wp), parameter :: coarsely_settled = 0.01_wp ! of the area: coarse loops only look for the load
   real(wp), parameter :: per_part = 0.1_wp          ! of the tolerance: share of one part of a loop
   real(wp), parameter :: least_loss = 0.01_wp       ! of alpha q: a smaller D does not tighten the tolerances

   !> The last loop under one alpha.
   type, public :: loop_type
      real(wp) :: alpha = 0.0_wp
      real(wp) :: q = 0.0_wp                         !! half the mean of the two strokes between the turning points
      real(wp) :: omega_squared = 0.0_wp             !! from the secant of the strokes [1/time^2]
      real(wp) :: loss = 0.0_wp                      !! loss factor, 2 zeta [-]
      real(wp) :: centre = 0.0_wp, gap = 0.0_wp      !! its middle, and its gap, both over q [-]
      real(wp) :: distortion = 0.0_wp                !! part of the movement orthogonal to phi, norm of [M] [-]
      real(wp) :: slipping = 0.0_wp, open = 0.0_wp   !! shares of the interface elements, at any time of the loop [-]
      integer  :: n_loops = 0
      real(wp) :: unsettled = 0.0_wp                 !! by what the last repetition has changed the loss factor; 0: it has settled [-]
      real(wp) :: lost = 0.0_wp                      !! D [force x length]
      real(wp), allocatable :: shares(:)             !! (joints) shares of D [-]
      real(wp), allocatable :: way(:, :)             !! (2, increments) alpha, q
   end type loop_type

contains

   !> Choose the sense of the first push of MODAL, up to about the load of the loop COARSE: that in which the structure is softer,
   !! so that the loops of a structure and of its mirror image are mirror images. The present sense remains where both are equal.
   subroutine choose_sense(model, modal, wanted, coarse)
      type(model_type), intent(in)         :: model
      type(modal_load_type), intent(inout) :: modal
      type(backbone_plan), intent(in)      :: wanted
      type(loop_type), intent(in)          :: coarse
      type(analysis_type), allocatable :: now
      type(failure_type) :: failure, none
      type(path_type)    :: path
      real(wp) :: pushed(2) ! q of the pushes; larger than any where the structure does not carry alpha
      integer  :: i

      do i = 1, 2
         failure = none
         call start_path(modal, coarse%alpha, now)
         call be_precise(wanted, coarse, 1.0_wp, modal)
         call begin_path(model, 0.0_wp, 0.0_wp, path)
         call follow_path(model, modal, [0.0_wp, coarse%alpha], wanted%increments, now, path, failure)
         pushed(i) = -1.0_wp
         if (.not. failure%raised) pushed(i) = coordinate(modal, now, coarse%alpha)
         call reverse(modal)
      end do
      if (pushed(2) > pushed(1) + equal_senses*abs(pushed(1))) call reverse(modal)
   end subroutine choose_sense

   !> 0 -> ALPHA -> -ALPHA -> ALPHA, then the same loop repeated until it has settled, at most for the cycles of WANTED. FINE, the
   !! loop of about this load that coarse increments have found: increments are halved to the tolerance of WANTED. FAILURE where
   !! the structure does not carry ALPHA. The change of q passes through zero while the loop still moves: it must close to the same
   !! tolerance, or its gap must be steady, twice: the ratio of changes is that of the first loops before it is that of the drift. A gap
   !! that is small against q may be as large as a small loss.
   subroutine run_loops(model, modal, wanted, alpha, loop, failure, fine)
      type(model_type), intent(in)          :: model
      type(modal_load_type), intent(inout)  :: modal
      type(backbone_plan), intent(in)       :: wanted
      real(wp), intent(in)                  :: alpha
      type(loop_type), intent(out)          :: loop
      type(failure_type), intent(inout)     :: failure
      type(loop_type), intent(in), optional :: fine
      type(analysis_type), allocatable :: now
      type(path_type) :: path
      real(wp) :: settled(2)                        ! changes of q and D that count as none, of themselves
      real(wp) :: change(3), change_before(3), before(3) ! of q, D and gap, and these of the loop before
      logical  :: is_steady, was_steady

      modal%finest_work = 0.0_wp
      settled = [coarsely_settled, coarsely_settled]
      loop%alpha = alpha
      call start_path(modal, alpha, now)
      if (present(fine)) then
         call be_precise(wanted, fine, 1.0_wp, modal)
         settled = wanted%tolerance*[settled_q, settled_area]
      end if
      call begin_path(model, 0.0_wp, 0.0_wp, path)
      call follow_path(model, modal, [0.0_wp, alpha], wanted%increments, now, path, failure)
      if (present(fine)) call be_precise(wanted, fine, least_loss, modal)
      change = huge(1.0_wp)
      is_steady = .false.
      do while (.not. failure%raised .and. loop%n_loops < 2 + wanted%cycles)
         before = [loop%q, loop%lost, loop%gap*loop%q]
         change_before = change
         call run_loop(model, modal, wanted%increments, now, loop, failure)
         if (failure%raised) exit
         if (allocated(modal%place)) call show_line(modal%place//', loop '//integer_text(loop%n_loops)// &
            one_of(present(fine), '', ' of the search for the load'), at_once=.false., is_logged=.true.)
         if (present(fine)) call be_precise(wanted, loop, least_loss, modal)
         if (loop%n_loops < 2) cycle
         change = abs([loop%q, loop%lost, loop%gap*loop%q] - before)
         was_steady = is_steady
         is_steady = all(left(change, change_before) <= [max(settled*[loop%q, abs(loop%lost)], [0.0_wp, minor_area*alpha*loop%q]), &
                                                         merge(steady*abs(loop%gap)*loop%q, huge(1.0_wp), &
                                                               abs(loop%gap) > settled(1))])
         if (is_steady .and. (was_steady .or. .not. present(fine) .or. &
                              abs(loop%gap) <= settled(1)*min(1.0_wp, loop%lost/(alpha*loop%q)))) exit
      end do
      if (present(fine) .and. loop%n_loops > 1 .and. .not. is_steady) loop%unsettled = 2.0_wp*change(2)/(two_pi*loop%alpha*loop%q)
   end subroutine run_loops

   !> Take the tolerances of work and q of MODAL from the loop LIKE. Where D is small, an error of q is a large share of it; D of
   !! less than LEAST of alpha q does not tighten the tolerances.
   pure subroutine be_precise(wanted, like, least, modal)
      type(backbone_plan), intent(in)      :: wanted
      type(loop_type), intent(in)          :: like
      real(wp), intent(in)                 :: least
      type(modal_load_type), intent(inout) :: modal
      real(wp) :: area, lost

      area = like%alpha*like%q
      lost = max(abs(like%lost), least*area)
      modal%finest_work = max(wanted%tolerance*per_part*lost, rounding_of_work(modal, area))
      modal%finest_q = like%q*max(wanted%tolerance*per_part*min(1.0_wp, lost/area), modal%q_noise)
   end subroutine be_precise

   !> What all later loops change, estimated from the CHANGE of the last loop and of the one BEFORE: changes fall in geometric
   !! progression.
   elemental real(wp) function left(change, before)
      real(wp), intent(in) :: change, before
      real(wp) :: ratio

      ratio = not_known
      if (before < huge(1.0_wp)) ratio = min(slowest, change/max(before, tiny(1.0_wp)))
      left = max(change, change*ratio/(1.0_wp - ratio))
   end function left

   !> One more loop from NOW, the upper turning point.
   subroutine run_loop(model, modal, increments, now, loop, failure)
      type(model_type), intent(in)         :: model
      type(modal_load_type), intent(inout) :: modal
      integer, intent(in)                  :: increments !! from rest to alpha
      type(analysis_type), intent(inout)   :: now
      type(loop_type), intent(inout)       :: loop
      type(failure_type), intent(inout)    :: failure
      type(path_type) :: path
      type(element_state) :: start(size(now%states))
      real(wp), allocatable :: lost(:), low_u(:, :), top_u(:, :)
      real(wp) :: high, low, share, top, from(3, size(now%states))
      integer  :: j

      if (failure%raised) return
      start = now%states
      from = now%movement
      top_u = now%u
      top = coordinate(modal, now, loop%alpha)
      call begin_path(model, loop%alpha, top, path)
      call follow_path(model, modal, [loop%alpha, -loop%alpha], 2*increments, now, path, failure)
      low_u = now%u
      low = coordinate(modal, now, -loop%alpha)
      call follow_path(model, modal, [-loop%alpha, loop%alpha], 2*increments, now, path, failure)
      if (failure%raised) return
      high = coordinate(modal, now, loop%alpha)
      loop%q = 0.25_wp*(high + top) - 0.5_wp*low
      if (.not. loop%q > 0.0_wp) then
         call failure%raise('the mode gives way against the load')
         return
      end if
      loop%n_loops = loop%n_loops + 1
      loop%omega_squared = loop%alpha/loop%q
      lost = path%work + at_rest(model, modal, start, from, now)
      loop%lost = sum(lost)
      if (abs(loop%lost) <= size(path%points, 2)*rounding_of_work(modal, loop%alpha*loop%q)) loop%lost = 0.0_wp
      loop%loss = 2.0_wp*loop%lost/(two_pi*loop%alpha*loop%q)
      loop%shares = [(sum(lost(model%joints%list(j)%first:model%joints%list(j)%last)), j = 1, size(model%joints%list))]/ &
                    merge(loop%lost, huge(1.0_wp), loop%lost > 0.0_wp)
      loop%centre = modal%sense*(0.25_wp*(high + top) + 0.5_wp*low)/loop%q
      loop%gap = (high - top)/loop%q
      share = 1.0_wp/max(1, size(model%joints%element))
      loop%slipping = share*count(path%has_slipped)
      loop%open = share*count(path%has_opened)
      loop%way = modal%sense*path%points
      call find_distortion(model, modal, 0.25_wp*(now%u + top_u) - 0.5_wp*low_u, loop)
   end subroutine run_loop

   !> The largest error of the work on a path that rounding explains, AREA being alpha q [force x length].
   pure real(wp) function rounding_of_work(modal, area) result(error)
      type(modal_load_type), intent(in) :: modal
      real(wp), intent(in)              :: area

      error = max(zero_loop_area*area, modal%work_noise, modal%q_noise*area)
   end function rounding_of_work

   !> What is to be added to the work of the forces beyond those at rest, F - F_0, for the loss of a loop that has led from the
   !! states START and the movements FROM to NOW, by element. The change of F is elastic, dF/k: the element gives back F dF/k, F
   !! the mean, if F falls again. F_0 does work on the movement that remains. No large numbers are subtracted where the loop
   !! closes to rounding.
   function at_rest(model, modal, start, from, now) result(lost)
      type(model_type), intent(in)      :: model
      type(modal_load_type), intent(in) :: modal
      type(element_state), intent(in)   :: start(:)
      real(wp), intent(in)              :: from(:, :)
      type(analysis_type), intent(in)   :: now
      real(wp) :: lost(size(start))
      real(wp) :: elastic(3), force(3, 2), k(3)
      integer  :: d, e

      lost = 0.0_wp
      do e = 1, size(start)
         associate (element => model%joints%element(e), law => model%joints%list(model%joints%element(e)%joint)%law, &
            state => now%states(e))
            k = [(element%area*shear_slope(law%shear(d), state%shear(d), state%normal%pressure), d = 1, 2), &
                 element%area*law%normal%e_u]
            force(:, 1) = force_of(element%area, start(e))
            force(:, 2) = force_of(element%area, state)
            elastic = 0.0_wp
            if (law%iwan%given) k(:2) = 0.0_wp ! its slices know what they hold
            where (k > 0.0_wp) elastic = (force(:, 2) - force(:, 1))/k
            lost(e) = dot_product(modal%rest_forces(:, e), now%movement(:, e) - from(:, e) - elastic) &
                      - dot_product(0.5_wp*sum(force, dim=2) - modal%rest_forces(:, e), elastic)
            if (law%iwan%given) lost(e) = lost(e) - element%area*energy_gain(law%iwan, slices_of(start(e)), slices_of(state))
         end associate
      end do
   end function at_rest

   !> The distortion of LOOP: |d - q phi|/|d| in the norm of [M], d the movement of all nodes, half of that between the turning
   !! points, HALF on the retained nodes.
   subroutine find_distortion(model, modal, half, loop)
      type(model_type), intent(in)         :: model
      type(modal_load_type), intent(inout) :: modal
      real(wp), intent(in)                 :: half(:, :)
      type(loop_type), intent(inout)       :: loop
      real(wp), allocatable :: d(:, :), f(:, :), other(:, :)

      allocate (d, f, mold=modal%phi)
      call recover_displacements(modal%system, forces_on_unknowns(model, loop%alpha*modal%force), half, d)
      d = displacements(model, d)
      call remove_rigid_motion(model, modal, d)
      other = d - loop%q*modal%phi
      call mass_times(model, modal%mass, other, f)
      loop%distortion = max(0.0_wp, sum(other*f))
      call mass_times(model, modal%mass, d, f)
      loop%distortion = sqrt(loop%distortion/sum(d*f))
   end subroutine find_distortion

end module modal_loops
