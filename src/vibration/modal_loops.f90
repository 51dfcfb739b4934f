!> Quasi-static modal analysis: loops of the structure under alpha [M] {phi}, phi a natural mode.
!! The structure is held at the load of the end of a stage; phi has generalised mass 1. Between alpha and -alpha the structure
!! goes through loops, which NEWTON iterates to equilibrium. The loops use copies: the state of the stage is not changed. In the
!! modal coordinate q = phi^T [M] (u - u_0) the last loop gives
!!
!!    omega^2 = (alpha_+ - alpha_-)/(q_+ - q_-)     zeta = D/(2 pi omega^2 q^2), q = (q_+ - q_-)/2, D the loss of the joints
!!
!! D is the sum over the elements of the exact work of their laws and needs no fine steps. The work of the forces at rest is
!! left out: it is zero over a closed loop, but preloads times the remaining gap of rounding would exceed small loops. Unknowns
!! inside condensed bodies contribute to q: K_gg^-1 of their forces, which is linear in alpha, so that an increment costs no
!! recovery.
!! Source: H. Festjens, G. Chevallier, J.-L. Dion, A numerical quasi-static method for the identification of frictional dissipation
!! in bolted joints, ASME DETC 2012-70583 and Int. J. Solids Struct. 2013; R. M. Lacayo, M. S. Allen, Mech. Syst. Signal Process.
!! 118 (2019) 133-157; E. Jewell, M. S. Allen, I. Zare, M. Wall, J. Sound Vib. 479 (2020) 115376.
module modal_loops
   use analysis_state, only: analysis_type, free_norm
   use element_mapping, only: two_pi
   use equation_solver, only: equation_system, failure_type
   use equations, only: condense_load, recover_displacements
   use joint_laws, only: element_state, force_of
   use joint_work, only: joint_energy, work_along
   use kinds, only: wp
   use load_path, only: hold_load, start_increment
   use mass_matrix, only: form_mass, mass_matrix_type, mass_times
   use model_data, only: model_type
   use newton_method, only: newton_increment
   use node_coupling, only: displacements, forces_on_unknowns
   use normal_stiffness, only: branch_open
   use stage_plan, only: backbone_plan, stage_plan_type
   implicit none
   private

   public :: start_modal_load, run_loops

   real(wp), parameter :: settled = 0.01_wp          ! of the area of a loop: a smaller change is none
   real(wp), parameter :: no_area = 1.0e-9_wp        ! of alpha q: rounding
   real(wp), parameter :: negligible = 1.0e-6_wp     ! likewise: smaller areas need not settle
   real(wp), parameter :: per_part = 0.03_wp         ! of the tolerance: share of one part of a loop
   real(wp), parameter :: finest_step = 1.0e-7_wp    ! of alpha: a smaller step is not halved
   real(wp), parameter :: coarsest_step = 0.125_wp   ! likewise: a larger one is, for elements may slip and stick within it
   real(wp), parameter :: exact = 1.0e-10_wp         ! TOL at most
   real(wp), parameter :: finest = 1.0e-13_wp        ! limit of TOL relative to the held load

   !> The initial data of the loops of one mode.
   type, public :: modal_load_type
      real(wp), allocatable :: phi(:, :)             !! (dimension, n_nodes) generalised mass 1
      real(wp), allocatable :: force(:, :)           !! [M] {phi} on all nodes
      real(wp), allocatable :: condensed(:, :)       !! the same condensed on the retained nodes
      real(wp) :: inside = 0.0_wp                    !! q of the interior of the bodies, retained nodes fixed, for alpha = 1
      type(analysis_type)   :: rest                  !! copy of the state, in equilibrium
      real(wp), allocatable :: rest_forces(:, :)     !! (3, n) forces of the interface elements there, in their axes
      real(wp) :: finest_work = 0.0_wp               !! increments are halved until the work changes by less; 0: not halved
      type(stage_plan_type) :: plan
      type(mass_matrix_type) :: mass
      class(equation_system), allocatable :: system
   end type modal_load_type

   !> The last loop under one alpha.
   type, public :: loop_type
      real(wp) :: alpha = 0.0_wp
      real(wp) :: q = 0.0_wp                         !! half the distance between the turning points
      real(wp) :: omega_squared = 0.0_wp             !! from the secant of the turning points [1/time^2]
      real(wp) :: loss = 0.0_wp                      !! loss factor, 2 zeta [-]
      real(wp) :: centre = 0.0_wp, gap = 0.0_wp      !! its middle, and its gap, both over q [-]
      real(wp) :: distortion = 0.0_wp                !! part of the movement orthogonal to phi, norm of [M] [-]
      real(wp) :: slipping = 0.0_wp, open = 0.0_wp   !! shares of the interface elements, at any time of the loop [-]
      integer  :: n_loops = 0
      real(wp), allocatable :: lost(:)               !! (elements) contributions to D [force x length]
      real(wp), allocatable :: shares(:)             !! (joints) shares of D [-]
      real(wp), allocatable :: way(:, :)             !! (2, increments) alpha, q
      logical, allocatable  :: has_slipped(:), has_opened(:)
   end type loop_type

contains

   !> Copy ANALYSIS and SYSTEM under constant load, in equilibrium, and form the modal force of the shape PHI.
   subroutine start_modal_load(model, plan, analysis, system, phi, modal, failure)
      type(model_type), intent(in)       :: model
      type(stage_plan_type), intent(in)  :: plan
      type(analysis_type), intent(in)    :: analysis
      class(equation_system), intent(in) :: system
      real(wp), intent(in)               :: phi(:, :) !! generalised mass 1
      type(modal_load_type), intent(out) :: modal
      type(failure_type), intent(inout)  :: failure
      real(wp), allocatable :: inside(:, :), felt(:, :)
      real(wp) :: work(size(model%interface))
      integer :: e

      if (failure%raised) return
      allocate (modal%system, source=system)
      call modal%system%forget_past()
      call form_mass(model, modal%mass)
      modal%rest = analysis
      if (allocated(modal%rest%exact)) deallocate (modal%rest%exact)
      modal%rest%tolerance = modal%rest%tolerance*min(1.0_wp, exact/modal%rest%load_tolerance) ! TOL of BACK is of pressures
      modal%rest%load_tolerance = min(exact, modal%rest%load_tolerance)
      modal%plan = plan
      modal%phi = phi
      allocate (modal%force, inside, mold=phi)
      allocate (modal%condensed, mold=analysis%u)
      call mass_times(model, modal%mass, modal%phi, modal%force)
      call hold_load(model, modal%system, modal%rest)
      felt = forces_on_unknowns(model, modal%force)
      call condense_load(modal%system, felt, modal%condensed)
      call recover_displacements(modal%system, felt, 0.0_wp*modal%condensed, inside)
      modal%inside = sum(felt*inside)
      allocate (modal%rest_forces(3, size(model%interface)), source=0.0_wp)
      modal%plan%stages(modal%rest%stage)%fractions = [1.0_wp]
      call load_increment(model, modal, [0.0_wp, 0.0_wp], modal%rest, work, failure)
      do e = 1, size(model%interface)
         modal%rest_forces(:, e) = force_of(model%interface(e)%area, modal%rest%states(e))
      end do
   end subroutine start_modal_load

   !> Go from alpha = ENDS(1) to ENDS(2) in N increments; LOOP collects the work of the joints.
   subroutine follow_path(model, modal, ends, n, now, loop, failure)
      type(model_type), intent(in)         :: model
      type(modal_load_type), intent(inout) :: modal
      real(wp), intent(in)                 :: ends(2)
      integer, intent(in)                  :: n
      type(analysis_type), intent(inout)   :: now
      type(loop_type), intent(inout)       :: loop
      type(failure_type), intent(inout)    :: failure
      type(analysis_type), allocatable :: straight
      real(wp) :: at(2), work(size(model%interface))
      integer  :: i

      do i = 1, n
         at = ends(1) + [i - 1, i]*(ends(2) - ends(1))/n
         if (modal%finest_work > 0.0_wp) then
            straight = now
            call load_increment(model, modal, at, straight, work, failure)
            call refine_increment(model, modal, at, work, now, loop, failure)
         else
            call load_increment(model, modal, at, now, work, failure)
            call add_work(now, work, loop)
         end if
         if (failure%raised) return
         loop%way = reshape([loop%way, at(2), coordinate(modal, now, at(2))], [2, size(loop%way, 2) + 1])
      end do
   end subroutine follow_path

   !> Go from alpha = ENDS(1) to ENDS(2), where the joints would take the work WHOLE on straight paths, as one increment. The
   !! increment is halved until halving has no effect. The remaining error falls by four in each halving; a third of the last
   !! difference is subtracted.
   recursive subroutine refine_increment(model, modal, ends, whole, now, loop, failure)
      type(model_type), intent(in)         :: model
      type(modal_load_type), intent(inout) :: modal
      real(wp), intent(in)                 :: ends(2)
      real(wp), intent(in)                 :: whole(:) !! (elements) [force x length]
      type(analysis_type), intent(inout)   :: now
      type(loop_type), intent(inout)       :: loop
      type(failure_type), intent(inout)    :: failure
      type(analysis_type), allocatable :: half, end
      real(wp) :: first(size(whole)), second(size(whole)), middle, change, step

      middle = 0.5_wp*sum(ends)
      half = now
      call load_increment(model, modal, [ends(1), middle], half, first, failure)
      end = half
      call load_increment(model, modal, [middle, ends(2)], end, second, failure)
      if (failure%raised) return
      change = sum(abs(first + second - whole))
      step = abs(ends(2) - ends(1))/loop%alpha
      if (step <= coarsest_step .and. (change <= modal%finest_work .or. step <= finest_step)) then
         call add_work(half, first, loop)
         call add_work(end, second + (first + second - whole)/3.0_wp, loop)
         now = end
      else
         deallocate (half, end) ! states are large
         call refine_increment(model, modal, [ends(1), middle], first, now, loop, failure)
         if (.not. failure%raised) call refine_increment(model, modal, [middle, ends(2)], second, now, loop, failure)
      end if
   end subroutine refine_increment

   !> Clear LOOP, to begin at ALPHA and Q.
   pure subroutine clear(model, alpha, q, loop)
      type(model_type), intent(in)   :: model
      real(wp), intent(in)           :: alpha, q
      type(loop_type), intent(inout) :: loop

      loop%way = reshape([alpha, q], [2, 1])
      loop%lost = spread(0.0_wp, 1, size(model%interface))
      loop%has_slipped = spread(.false., 1, size(model%interface))
      loop%has_opened = loop%has_slipped
   end subroutine clear

   !> Add WORK, done by the joints on the way to NOW, to LOOP.
   subroutine add_work(now, work, loop)
      type(analysis_type), intent(in) :: now
      real(wp), intent(in)            :: work(:) !! (elements) [force x length]
      type(loop_type), intent(inout)  :: loop

      loop%lost = loop%lost + work
      loop%has_slipped = loop%has_slipped .or. now%states%slips
      loop%has_opened = loop%has_opened .or. now%states%normal%branch == branch_open
   end subroutine add_work

   !> One increment from alpha = ENDS(1) to ENDS(2), and the WORK of the joints on the straight path of each element, without
   !! that of the forces at rest.
   subroutine load_increment(model, modal, ends, now, work, failure)
      type(model_type), intent(in)         :: model
      type(modal_load_type), intent(inout) :: modal
      real(wp), intent(in)                 :: ends(2)
      type(analysis_type), intent(inout)   :: now
      real(wp), intent(out)                :: work(:) !! (elements) [force x length]
      type(failure_type), intent(inout)    :: failure
      type(element_state) :: before(size(now%states))
      type(joint_energy)  :: energy
      real(wp) :: from(3, size(now%states))
      integer  :: e

      work = 0.0_wp
      if (failure%raised) return
      associate (at => modal%rest%before)
         now%before%load = at%load + ends(1)*modal%force
         now%before%condensed_load = at%condensed_load + ends(1)*modal%condensed
         now%after%load = at%load + ends(2)*modal%force
         now%after%condensed_load = at%condensed_load + ends(2)*modal%condensed
      end associate
      now%now%load = now%before%load
      now%now%condensed_load = now%before%condensed_load
      now%increment = 0
      before = now%states
      from = now%movement
      call start_increment(modal%plan, modal%system, now)
      call newton_increment(model, modal%plan, now, modal%system, failure)
      if (failure%raised) return
      do e = 1, size(before)
         associate (element => model%interface(e), to => now%movement(:, e))
            energy = work_along(model%joints(element%joint)%law, element%area, before(e), to)
            work(e) = sum(energy%net()) - dot_product(modal%rest_forces(:, e), to - from(:, e))
         end associate
      end do
   end subroutine load_increment

   !> q of the state NOW, under ALPHA.
   pure real(wp) function coordinate(modal, now, alpha) result(q)
      type(modal_load_type), intent(in) :: modal
      type(analysis_type), intent(in)   :: now
      real(wp), intent(in)              :: alpha

      q = sum(modal%condensed*(now%u - modal%rest%u)) + alpha*modal%inside
   end function coordinate

   !> 0 -> ALPHA -> -ALPHA -> ALPHA, then the same loop repeated until its area has settled, at most for the cycles of WANTED.
   !! If MEASURED, the last loop is followed again with its loss to the tolerance of WANTED. FAILURE where the structure does
   !! not carry ALPHA.
   subroutine run_loops(model, modal, wanted, alpha, measured, loop, failure)
      type(model_type), intent(in)         :: model
      type(modal_load_type), intent(inout) :: modal
      type(backbone_plan), intent(in)      :: wanted
      real(wp), intent(in)                 :: alpha
      logical, intent(in)                  :: measured
      type(loop_type), intent(out)         :: loop
      type(failure_type), intent(inout)    :: failure
      type(analysis_type), allocatable :: now, start
      real(wp) :: area, area_before, held

      now = modal%rest
      held = free_norm(modal%rest%now%condensed_load, modal%rest%held)
      if (held > 0.0_wp) then
         now%load_tolerance = max(min(finest, now%load_tolerance), &
                                  now%load_tolerance*min(1.0_wp, alpha*free_norm(modal%condensed, modal%rest%held)/held))
         now%tolerance = now%load_tolerance/modal%rest%load_tolerance*now%tolerance
      end if
      modal%finest_work = 0.0_wp
      loop%alpha = alpha
      call clear(model, 0.0_wp, 0.0_wp, loop)
      call follow_path(model, modal, [0.0_wp, alpha], wanted%increments, now, loop, failure)
      area = 0.0_wp
      do while (.not. failure%raised)
         area_before = area
         if (measured) start = now
         call run_loop(model, modal, wanted%increments, now, loop, failure)
         area = sum(loop%lost)
         if (failure%raised .or. loop%n_loops >= 2 + wanted%cycles) exit
         if (loop%n_loops >= 2 .and. abs(area - area_before) <= max(settled*abs(area), negligible*alpha*loop%q)) exit
      end do
      if (failure%raised .or. .not. measured .or. area <= negligible*alpha*loop%q) return
      modal%finest_work = max(wanted%tolerance*per_part*area, no_area*alpha*loop%q)
      loop%n_loops = loop%n_loops - 1
      call run_loop(model, modal, wanted%increments, start, loop, failure)
   end subroutine run_loops

   !> One more loop from NOW, the upper turning point.
   subroutine run_loop(model, modal, increments, now, loop, failure)
      type(model_type), intent(in)         :: model
      type(modal_load_type), intent(inout) :: modal
      integer, intent(in)                  :: increments !! from rest to alpha
      type(analysis_type), intent(inout)   :: now
      type(loop_type), intent(inout)       :: loop
      type(failure_type), intent(inout)    :: failure
      real(wp), allocatable :: u_low(:, :), d(:, :), f(:, :), other(:, :)
      real(wp) :: area, high, low, top, share
      integer  :: j

      if (failure%raised) return
      top = coordinate(modal, now, loop%alpha)
      call clear(model, loop%alpha, top, loop)
      call follow_path(model, modal, [loop%alpha, -loop%alpha], 2*increments, now, loop, failure)
      u_low = now%u
      low = coordinate(modal, now, -loop%alpha)
      call follow_path(model, modal, [-loop%alpha, loop%alpha], 2*increments, now, loop, failure)
      if (failure%raised) return
      high = coordinate(modal, now, loop%alpha)
      if (.not. (low < 0.0_wp .and. high > 0.0_wp)) then
         call failure%raise('both ends of the loop lie on one side of the state at rest')
         return
      end if
      loop%n_loops = loop%n_loops + 1
      loop%q = 0.5_wp*(high - low)
      loop%omega_squared = 2.0_wp*loop%alpha/(high - low)
      area = sum(loop%lost)
      if (abs(area) <= no_area*loop%alpha*loop%q) area = 0.0_wp
      loop%loss = 2.0_wp*area/(two_pi*loop%omega_squared*loop%q**2)
      loop%shares = [(sum(loop%lost(model%joints(j)%first:model%joints(j)%last)), j = 1, size(model%joints))]/ &
                    merge(area, huge(1.0_wp), area > 0.0_wp)
      loop%centre = 0.5_wp*(high + low)/loop%q
      loop%gap = (high - top)/loop%q
      share = 1.0_wp/max(1, size(model%interface))
      loop%slipping = share*count(loop%has_slipped)
      loop%open = share*count(loop%has_opened)

      ! |d - q phi|/|d| in the norm of [M], d the movement of all nodes, half of that between the turning points
      allocate (d, f, mold=modal%phi)
      call recover_displacements(modal%system, forces_on_unknowns(model, loop%alpha*modal%force), 0.5_wp*(now%u - u_low), d)
      d = displacements(model, d)
      other = d - loop%q*modal%phi
      call mass_times(model, modal%mass, other, f)
      loop%distortion = max(0.0_wp, sum(other*f))
      call mass_times(model, modal%mass, d, f)
      loop%distortion = sqrt(loop%distortion/sum(d*f))
   end subroutine run_loop

end module modal_loops
