!> Quasi-static modal analysis: the structure, held at the load of the end of a stage, under alpha [M] {phi}, phi a natural mode of
!! generalised mass 1. Between alpha and -alpha it goes through loops, iterated to equilibrium by NEWTON; all on copies, what goes on from
!! the stage is left as it is. In the modal coordinate q = phi^T [M] (u - u_0) the last loop gives
!!
!!    omega^2 = (alpha_+ - alpha_-)/(q_+ - q_-)     zeta = D/(2 pi omega^2 q^2), q = (q_+ - q_-)/2, D what the joints keep of the loop
!!
!! D is summed over the elements by the exact work of their laws, so that it needs no fine steps; without that of the forces at rest, which
!! a closed loop does not have: preloads times what rounding leaves open would drown small loops. What lies inside condensed bodies has its
!! share in q: K_gg^-1 of its forces, which is linear in alpha, so that an increment costs no recovery.
!! Source: H. Festjens, G. Chevallier, J.-L. Dion, A numerical quasi-static method for the identification of frictional dissipation in
!! bolted joints, ASME DETC 2012-70583 and Int. J. Solids Struct. 2013; R. M. Lacayo, M. S. Allen, Mech. Syst. Signal Process. 118 (2019)
!! 133-157; E. Jewell, M. S. Allen, I. Zare, M. Wall, J. Sound Vib. 479 (2020) 115376.
module modal_loops
   use analysis_state, only: analysis_type, free_norm
   use element_mapping, only: two_pi
   use equation_solver, only: equation_system
   use equations, only: condense_load, recover_displacements
   use failures, only: failure_type
   use joint_laws, only: work_along
   use kinds, only: wp
   use load_path, only: hold_load, start_increment
   use mass_matrix, only: form_mass, mass_matrix_type, mass_times
   use model_data, only: model_type
   use newton_method, only: newton_increment
   use node_coupling, only: displacements, forces_on_unknowns
   use normal_stiffness, only: branch_open
   use stage_plan, only: stage_plan_type
   implicit none
   private

   public :: start_push, run_loops

   real(wp), parameter :: settled = 0.01_wp          ! of the area of a loop: less is no change
   real(wp), parameter :: no_area = 1.0e-9_wp        ! of alpha q: rounding
   real(wp), parameter :: negligible = 1.0e-6_wp     ! likewise: areas so small need not settle
   real(wp), parameter :: exact = 1.0e-10_wp         ! TOL at most
   real(wp), parameter :: finest = 1.0e-13_wp        ! TOL beside the load that is held

   !> What the loops of one mode start from.
   type, public :: push_type
      real(wp), allocatable :: phi(:, :)             !! (dimension, n_nodes) generalised mass 1
      real(wp), allocatable :: force(:, :)           !! [M] {phi} on all nodes
      real(wp), allocatable :: condensed(:, :)       !! of it what retained nodes feel
      real(wp) :: inside = 0.0_wp                    !! q of the inside of the bodies, retained nodes at rest, for alpha = 1
      type(analysis_type)   :: rest                  !! the copy of the state, in equilibrium
      real(wp), allocatable :: borne(:, :)           !! (3, n) forces of the interface elements there, in their axes
      type(stage_plan_type) :: plan
      type(mass_matrix_type) :: mass
      class(equation_system), allocatable :: system
   end type push_type

   !> The last loop under one alpha.
   type, public :: loop_type
      real(wp) :: alpha = 0.0_wp
      real(wp) :: q = 0.0_wp                         !! half of what lies between the turning points
      real(wp) :: omega_squared = 0.0_wp             !! by their secant [1/time^2]
      real(wp) :: loss = 0.0_wp                      !! loss factor, 2 zeta [-]
      real(wp) :: centre = 0.0_wp, gap = 0.0_wp      !! its middle, and what it lacks to be closed, both by q [-]
      real(wp) :: distortion = 0.0_wp                !! share of the movement that is not phi, norm of [M] [-]
      real(wp) :: slipping = 0.0_wp, open = 0.0_wp   !! shares of the interface elements, at any time of the loop [-]
      integer  :: n_loops = 0
      real(wp), allocatable :: lost(:)               !! (joints) share of D
      real(wp), allocatable :: way(:, :)             !! (2, increments) alpha, q
      logical, allocatable  :: has_slipped(:), has_opened(:)
   end type loop_type

contains

   !> A copy of ANALYSIS and SYSTEM, the load held, in equilibrium; the force of the mode whose shape is PHI.
   subroutine start_push(model, plan, analysis, system, phi, push, failure)
      type(model_type), intent(in)       :: model
      type(stage_plan_type), intent(in)  :: plan
      type(analysis_type), intent(in)    :: analysis
      class(equation_system), intent(in) :: system
      real(wp), intent(in)               :: phi(:, :) !! generalised mass 1
      type(push_type), intent(out)       :: push
      type(failure_type), intent(inout)  :: failure
      real(wp), allocatable :: inside(:, :), felt(:, :)
      type(loop_type) :: none
      integer :: e

      if (failure%raised) return
      allocate (push%system, source=system)
      call push%system%forget_past()
      call form_mass(model, push%mass)
      push%rest = analysis
      if (allocated(push%rest%exact)) deallocate (push%rest%exact)
      push%rest%tolerance = push%rest%tolerance*min(1.0_wp, exact/push%rest%load_tolerance) ! TOL of BACK is of pressures
      push%rest%load_tolerance = min(exact, push%rest%load_tolerance)
      push%plan = plan
      push%phi = phi
      allocate (push%force, inside, mold=phi)
      allocate (push%condensed, mold=analysis%u)
      call mass_times(model, push%mass, push%phi, push%force)
      call hold_load(model, push%system, push%rest)
      felt = forces_on_unknowns(model, push%force)
      call condense_load(push%system, felt, push%condensed)
      call recover_displacements(push%system, felt, 0.0_wp*push%condensed, inside)
      push%inside = sum(felt*inside)
      call swing(model, push, 0.0_wp, 0.0_wp, 1, push%rest, none, failure)
      allocate (push%borne(3, size(model%interface)))
      do e = 1, size(model%interface)
         associate (state => push%rest%states(e))
            push%borne(:, e) = [state%shear%tau*model%interface(e)%area, state%normal%sumf]
         end associate
      end do
   end subroutine start_push

   !> From alpha = BEGIN to END in N increments; what the joints do on the way goes to LOOP where it counts that.
   subroutine swing(model, push, begin, end, n, now, loop, failure)
      type(model_type), intent(in)       :: model
      type(push_type), intent(inout)     :: push
      real(wp), intent(in)               :: begin, end
      integer, intent(in)                :: n
      type(analysis_type), intent(inout) :: now
      type(loop_type), intent(inout)     :: loop
      type(failure_type), intent(inout)  :: failure
      type(analysis_type), allocatable :: before
      integer :: e, i

      if (failure%raised) return
      associate (at => push%rest%before)
         now%before%load = at%load + begin*push%force
         now%before%condensed_load = at%condensed_load + begin*push%condensed
         now%after%load = at%load + end*push%force
         now%after%condensed_load = at%condensed_load + end*push%condensed
      end associate
      now%now%load = now%before%load
      now%now%condensed_load = now%before%condensed_load
      push%plan%stages(now%stage)%fractions = [(1.0_wp/n, i = 1, n)]
      now%increment = 0
      do i = 1, n
         if (allocated(loop%way)) before = now
         call start_increment(push%plan, push%system, now)
         call newton_increment(model, push%plan, now, push%system, failure)
         if (failure%raised) return
         if (.not. allocated(loop%way)) cycle
         loop%way = reshape([loop%way, begin + now%fraction*(end - begin), 0.0_wp], [2, size(loop%way, 2) + 1])
         loop%way(2, size(loop%way, 2)) = coordinate(push, now, loop%way(1, size(loop%way, 2)))
         do e = 1, size(model%interface)
            associate (element => model%interface(e), from => before%movement(:, e), to => now%movement(:, e))
               loop%lost(element%joint) = loop%lost(element%joint) + sum(work_along(model%joints(element%joint)%law, &
                  element%area, before%states(e), from, to)) - dot_product(push%borne(:, e), to - from)
            end associate
         end do
         loop%has_slipped = loop%has_slipped .or. now%states%slips
         loop%has_opened = loop%has_opened .or. now%states%normal%branch == branch_open
      end do
   end subroutine swing

   !> q of the state NOW, under ALPHA.
   pure real(wp) function coordinate(push, now, alpha) result(q)
      type(push_type), intent(in)     :: push
      type(analysis_type), intent(in) :: now
      real(wp), intent(in)            :: alpha

      q = sum(push%condensed*(now%u - push%rest%u)) + alpha*push%inside
   end function coordinate

   !> 0 -> ALPHA -> -ALPHA -> ALPHA, then the same loop again, and up to CYCLES times more until its area has settled. FAILURE where the
   !! structure does not bear ALPHA.
   subroutine run_loops(model, push, alpha, cycles, increments, loop, failure)
      type(model_type), intent(in)       :: model
      type(push_type), intent(inout)     :: push
      real(wp), intent(in)               :: alpha
      integer, intent(in)                :: cycles
      integer, intent(in)                :: increments !! from rest to alpha
      type(loop_type), intent(out)       :: loop
      type(failure_type), intent(inout)  :: failure
      type(analysis_type), allocatable :: now
      real(wp), allocatable :: u_low(:, :)
      real(wp) :: area, area_before, held, high, low, top

      now = push%rest
      held = free_norm(push%rest%now%condensed_load, push%rest%held)
      if (held > 0.0_wp) then
         now%load_tolerance = max(min(finest, now%load_tolerance), &
                                  now%load_tolerance*min(1.0_wp, alpha*free_norm(push%condensed, push%rest%held)/held))
         now%tolerance = now%load_tolerance/push%rest%load_tolerance*now%tolerance
      end if
      call swing(model, push, 0.0_wp, alpha, increments, now, loop, failure)
      loop%alpha = alpha
      area = 0.0_wp
      do while (.not. failure%raised)
         area_before = area
         top = coordinate(push, now, alpha)
         loop%way = reshape([alpha, top], [2, 1])
         loop%lost = 0.0_wp*model%joints%p_av
         loop%has_slipped = spread(.false., 1, size(model%interface))
         loop%has_opened = loop%has_slipped
         call swing(model, push, alpha, -alpha, 2*increments, now, loop, failure)
         if (failure%raised) return
         u_low = now%u
         low = coordinate(push, now, -alpha)
         call swing(model, push, -alpha, alpha, 2*increments, now, loop, failure)
         if (failure%raised) return
         high = coordinate(push, now, alpha)
         area = sum(loop%lost)
         loop%n_loops = loop%n_loops + 1
         if (loop%n_loops >= 2 + cycles) exit
         if (loop%n_loops >= 2 .and. abs(area - area_before) <= max(settled*abs(area), negligible*alpha*(high - low))) exit
      end do
      if (.not. failure%raised .and. .not. (low < 0.0_wp .and. high > 0.0_wp)) &
         call failure%raise('both ends of the loop lie on one side of the state at rest')
      if (failure%raised) return
      loop%q = 0.5_wp*(high - low)
      loop%omega_squared = 2.0_wp*alpha/(high - low)
      if (abs(area) <= no_area*alpha*loop%q) area = 0.0_wp
      loop%loss = 2.0_wp*area/(two_pi*loop%omega_squared*loop%q**2)
      loop%lost = loop%lost/merge(area, huge(1.0_wp), area > 0.0_wp)
      loop%centre = 0.5_wp*(high + low)/loop%q
      loop%gap = (high - top)/loop%q
      if (size(model%interface) > 0) then
         loop%slipping = count(loop%has_slipped)/real(size(model%interface), wp)
         loop%open = count(loop%has_opened)/real(size(model%interface), wp)
      end if
      loop%distortion = distortion_of(model, push, 0.5_wp*(now%u - u_low), loop)
   end subroutine run_loops

   !> Share of the movement U of retained nodes, half of that between the turning points, that is not phi: |d - q phi|/|d|, d the movement
   !! of all nodes, in the norm of [M] [-].
   function distortion_of(model, push, u, loop) result(share)
      type(model_type), intent(in)       :: model
      type(push_type), intent(in)        :: push
      real(wp), intent(in)               :: u(:, :)
      type(loop_type), intent(in)        :: loop
      real(wp) :: share
      real(wp), allocatable :: d(:, :), f(:, :), other(:, :)

      allocate (d, f, mold=push%phi)
      call recover_displacements(push%system, forces_on_unknowns(model, loop%alpha*push%force), u, d)
      d = displacements(model, d)
      other = d - loop%q*push%phi
      call mass_times(model, push%mass, other, f)
      share = max(0.0_wp, sum(other*f))
      call mass_times(model, push%mass, d, f)
      share = sqrt(share/sum(d*f))
   end function distortion_of

end module modal_loops
