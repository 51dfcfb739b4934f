!> Paths of the structure under alpha [M] {phi}, phi a natural mode, from the state at the end of a stage. The structure is held
!! at the load of the end of the stage; phi has generalised mass 1. NEWTON iterates every increment of alpha to equilibrium. The
!! paths use copies: the state of the stage is not changed. The modal coordinate is q = phi^T [M] (u - u_0). Unknowns inside
!! condensed bodies contribute to q: K_gg^-1 of their forces, which is linear in alpha, so that an increment costs no recovery.
!! The work of an element counts the forces beyond those at rest: F - F_0 over the movement. Preloads times a movement of rounding
!! would exceed the work of small loops. What the forces at rest contribute to the loss of a loop is in absorbed_at_rest.
!! A free structure stands on the statically determinate supports of free_structure. [M] {phi} is orthogonal to all rigid-body
!! motions, so that the inertia forces of the mode are in equilibrium without these supports; other supports give the same
!! movement but for a rigid-body motion, which {phi}^T [M] does not contain.
module modal_path
   use analysis_state, only: analysis_type, free_norm
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
   use normal_stiffness, only: branch_open, normal_state
   use stage_plan, only: stage_plan_type
   use text_tools, only: real_text
   use tolerances, only: closing_step, exact_tol, finest_step, finest_tol, rounding_of_forces, rounding_of_sums
   use unknowns, only: motions_of, n_motions
   implicit none
   private

   public :: start_modal_load, start_path, begin_path, follow_path, coordinate, reverse, remove_rigid_motion

   real(wp), parameter :: coarsest_step = 0.125_wp   ! likewise: a larger one is, for elements may slip and stick within it
   real(wp), parameter :: margin = 10.0_wp           ! of rounding errors
   real(wp), parameter :: slowed = 0.9_wp            ! of the closing before: an element that closes less may have turned back

   !> The initial data of the paths of one mode.
   type, public :: modal_load_type
      real(wp), allocatable :: phi(:, :)             !! (dimension, n_nodes) generalised mass 1
      real(wp), allocatable :: rigid(:, :, :)        !! (dimension, n_nodes, n) rigid-body motions of a free structure, of
                                                     !! generalised mass 1 and orthogonal in [M]; n = 0: it has supports
      real(wp), allocatable :: force(:, :)           !! [M] {phi} on all nodes
      real(wp), allocatable :: condensed(:, :)       !! the same condensed on the retained nodes
      real(wp) :: inside = 0.0_wp                    !! q of the interior of the bodies, retained nodes fixed, for alpha = 1
      real(wp) :: sense = 1.0_wp                     !! of phi against the mode: that of the first push
      type(analysis_type)   :: rest                  !! copy of the state, in equilibrium
      real(wp), allocatable :: rest_forces(:, :)     !! (3, n) forces of the interface elements there, in their axes
      real(wp) :: largest = 0.0_wp                   !! alpha of the present paths
      real(wp) :: begins = 0.0_wp                    !! alpha at the beginning of the present path
      real(wp) :: carried = 0.0_wp                   !! |alpha| of the last state in equilibrium of a path that has failed
      real(wp) :: finest_work = 0.0_wp               !! increments are halved until work and q change by less; 0: not halved
      real(wp) :: finest_q = 0.0_wp
      real(wp) :: work_noise = 0.0_wp                !! rounding error of the work of the elements on a path
      real(wp) :: q_noise = 0.0_wp                   !! of q, relative: what the tolerance of equilibrium leaves
      type(stage_plan_type) :: plan
      type(mass_matrix_type) :: mass
      class(equation_system), allocatable :: system
      character(:), allocatable :: place             !! 'backbone, amplitude 3 of 10', for the progress; not allocated: none
   end type modal_load_type

   !> What happened on a path.
   type, public :: path_type
      real(wp), allocatable :: work(:)               !! (elements) of the forces beyond those at rest [force x length]
      real(wp), allocatable :: points(:, :)          !! (2, increments) alpha, q
      logical, allocatable  :: has_slipped(:), has_opened(:)
   end type path_type

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
      real(wp), allocatable :: inside(:, :), on_unknowns(:, :)
      real(wp) :: work(size(model%joints%element))
      integer :: e

      if (failure%raised) return
      allocate (modal%system, source=system)
      call modal%system%forget_past()
      call form_mass(model, modal%mass)
      modal%rest = analysis
      if (allocated(modal%rest%exact)) deallocate (modal%rest%exact)
      modal%rest%states%turns = .true.
      modal%rest%tolerance = modal%rest%tolerance*min(1.0_wp, exact_tol/modal%rest%load_tolerance) ! TOL of BACK is of pressures
      modal%rest%load_tolerance = min(exact_tol, modal%rest%load_tolerance)
      modal%plan = plan
      modal%plan%measures_path = .false.
      modal%plan%stages%follows_path = .false.
      modal%plan%stages(analysis%stage)%path = 'start of the loops'
      modal%phi = phi
      call find_rigid_motions(model, modal)
      call remove_rigid_motion(model, modal, modal%phi)
      allocate (modal%force, inside, mold=phi)
      allocate (modal%condensed, mold=analysis%u)
      call mass_times(model, modal%mass, modal%phi, modal%force)
      call hold_load(model, modal%system, modal%rest)
      on_unknowns = forces_on_unknowns(model, modal%force)
      call condense_load(modal%system, on_unknowns, modal%condensed)
      call recover_displacements(modal%system, on_unknowns, 0.0_wp*modal%condensed, inside)
      modal%inside = sum(on_unknowns*inside)
      allocate (modal%rest_forces(3, size(model%joints%element)), source=0.0_wp)
      modal%rest%increment_fraction = 0.0_wp
      call load_increment(model, modal, [0.0_wp, 0.0_wp], modal%rest, work, failure)
      do e = 1, size(model%joints%element)
         modal%rest_forces(:, e) = force_of(model%joints%element(e)%area, modal%rest%states(e))
      end do
      associate (states => modal%rest%states)
         modal%work_noise = rounding_of_forces*(sum(abs(modal%rest_forces*modal%rest%movement)) + &
                                                    sum(abs(modal%rest_forces(3, :)*states%normal%lambda)))
      end associate
   end subroutine start_modal_load

   !> The rigid-body motions of a free structure, a ring's along its axis, orthogonal in [M] by Gram and Schmidt. A motion
   !! without mass is left out.
   subroutine find_rigid_motions(model, modal)
      type(model_type), intent(in)         :: model
      type(modal_load_type), intent(inout) :: modal
      real(wp), allocatable :: moved(:, :, :), u(:, :), f(:, :)
      real(wp) :: before, mass
      integer  :: i

      allocate (modal%rigid(model%mesh%dimension, model%mesh%n_nodes, 0))
      if (.not. model%freedoms%floats) return
      allocate (moved(model%mesh%dimension, n_motions(model%mesh%dimension), model%mesh%n_nodes))
      allocate (u, f, mold=modal%phi)
      do i = 1, model%mesh%n_nodes
         moved(:, :, i) = motions_of(model, i)
      end do
      do i = merge(2, 1, model%mesh%axisymmetric), merge(2, size(moved, 2), model%mesh%axisymmetric)
         u = displacements(model, moved(:, i, :))
         call mass_times(model, modal%mass, u, f)
         before = sum(u*f)
         call remove_rigid_motion(model, modal, u)
         call remove_rigid_motion(model, modal, u) ! orthogonal to rounding
         call mass_times(model, modal%mass, u, f)
         mass = sum(u*f)
         if (mass > rounding_of_sums**2*before) &
            modal%rigid = reshape([modal%rigid, u/sqrt(mass)], [shape(u), size(modal%rigid, 3) + 1])
      end do
   end subroutine find_rigid_motions

   !> Remove the rigid-body motion of a free structure from the displacements U: [M] U is then in equilibrium.
   subroutine remove_rigid_motion(model, modal, u)
      type(model_type), intent(in)      :: model
      type(modal_load_type), intent(in) :: modal
      real(wp), contiguous, intent(inout) :: u(:, :)
      real(wp), allocatable :: f(:, :)
      integer :: i

      if (size(modal%rigid, 3) == 0) return
      allocate (f, mold=u)
      call mass_times(model, modal%mass, u, f)
      do i = 1, size(modal%rigid, 3)
         u = u - sum(modal%rigid(:, :, i)*f)*modal%rigid(:, :, i)
      end do
   end subroutine remove_rigid_motion

   !> Reverse the sense of phi, and of alpha and q with it.
   pure subroutine reverse(modal)
      type(modal_load_type), intent(inout) :: modal

      modal%sense = -modal%sense
      modal%phi = -modal%phi
      modal%force = -modal%force
      modal%condensed = -modal%condensed
   end subroutine reverse

   !> A state NOW at rest, with the tolerance of equilibrium for loads up to ALPHA.
   subroutine start_path(modal, alpha, now)
      type(modal_load_type), intent(inout) :: modal
      real(wp), intent(in)                 :: alpha
      type(analysis_type), allocatable, intent(inout) :: now
      real(wp) :: held, share ! load at rest; that of alpha, of it

      modal%largest = alpha
      modal%carried = 0.0_wp
      modal%plan%stages(modal%rest%stage)%path = 'loops under '//in_words(alpha)
      modal%q_noise = margin*modal%rest%load_tolerance
      now = modal%rest
      held = free_norm(modal%rest%now%condensed_load, modal%rest%held)
      if (held <= 0.0_wp) return
      share = alpha*free_norm(modal%condensed, modal%rest%held)/held
      now%load_tolerance = max(min(finest_tol, now%load_tolerance), now%load_tolerance*min(1.0_wp, share))
      modal%q_noise = margin*now%load_tolerance/share
      now%tolerance = now%load_tolerance/modal%rest%load_tolerance*now%tolerance
   end subroutine start_path

   !> Go from alpha = ENDS(1) to ENDS(2) in N increments, along PATH.
   subroutine follow_path(model, modal, ends, n, now, path, failure)
      type(model_type), intent(in)         :: model
      type(modal_load_type), intent(inout) :: modal
      real(wp), intent(in)                 :: ends(2)
      integer, intent(in)                  :: n
      type(analysis_type), intent(inout)   :: now
      type(path_type), intent(inout)       :: path
      type(failure_type), intent(inout)    :: failure
      type(analysis_type), allocatable :: straight
      real(wp) :: at(2), work(size(model%joints%element))
      integer  :: i

      modal%begins = ends(1)
      do i = 1, n
         at = ends(1) + [i - 1, i]*(ends(2) - ends(1))/n
         if (modal%finest_work > 0.0_wp) then
            straight = now
            call load_increment(model, modal, at, straight, work, failure)
            if (failure%raised) return
            call refine_increment(model, modal, at, &
                                  [work, coordinate(modal, straight, at(2)) - coordinate(modal, now, at(1))], now, path, failure)
         else
            call load_increment(model, modal, at, now, work, failure)
            call add_work(now, work, path)
         end if
         if (failure%raised) return
         path%points = reshape([path%points, at(2), coordinate(modal, now, at(2))], [2, size(path%points, 2) + 1])
      end do
   end subroutine follow_path

   !> Go from alpha = ENDS(1) to ENDS(2). As one increment, the joints take the work and q grows by what WHOLE says. The increment
   !! is halved until halving has no effect on the work of the elements and on the growth of q: the error of q at the start of an
   !! increment is not that of the increment. Two errors do not show in this way: where an element closes, its shear deflection
   !! counts from the start of the increment, and where an element turns from closing to opening, because another one opens or slips, the
   !! straight way misses its largest pressure. Such increments are halved to CLOSING_STEP. The remaining error of the work falls by four in each halving; a third of the last difference is subtracted.
   recursive subroutine refine_increment(model, modal, ends, whole, now, path, failure)
      type(model_type), intent(in)         :: model
      type(modal_load_type), intent(inout) :: modal
      real(wp), intent(in)                 :: ends(2)
      real(wp), intent(in)                 :: whole(:) !! (elements) [force x length], and growth of q
      type(analysis_type), intent(inout)   :: now
      type(path_type), intent(inout)       :: path
      type(failure_type), intent(inout)    :: failure
      type(analysis_type), allocatable :: half, end
      real(wp) :: first(size(whole)), second(size(whole)), difference(size(whole)), coarsest, middle, share
      integer  :: n
      logical  :: hides

      n = size(model%joints%element)
      middle = 0.5_wp*sum(ends)
      half = now
      call load_increment(model, modal, [ends(1), middle], half, first(:n), failure)
      end = half
      call load_increment(model, modal, [middle, ends(2)], end, second(:n), failure)
      if (failure%raised) return
      first(n + 1) = coordinate(modal, half, middle) - coordinate(modal, now, ends(1))
      second(n + 1) = coordinate(modal, end, ends(2)) - coordinate(modal, half, middle)
      difference = first + second - whole
      share = abs(ends(2) - ends(1))/modal%largest
      hides = any(now%states%normal%branch == branch_open .and. end%states%normal%branch /= branch_open) .or. &
              missed_work(model%joints%element%area, now%states%normal, half%states%normal, end%states%normal) > modal%finest_work
      coarsest = merge(closing_step, coarsest_step, hides)
      if (share <= coarsest .and. (share <= finest_step .or. (sum(abs(difference(:n))) <= modal%finest_work &
                                                              .and. abs(difference(n + 1)) <= modal%finest_q))) then
         call add_work(half, first(:n), path)
         call add_work(end, second(:n) + difference(:n)/3.0_wp, path)
         now = end
      else
         deallocate (half, end) ! states are large
         call refine_increment(model, modal, [ends(1), middle], first, now, path, failure)
         if (.not. failure%raised) call refine_increment(model, modal, [middle, ends(2)], second, now, path, failure)
      end if
   end subroutine refine_increment

   !> The largest work of elements of these AREAS on their loading curves that two straight ways, A to B to C, may miss, where an
   !! element turns back in one of them: it may have gone on, as it did before, to the end of that way.
   pure real(wp) function missed_work(areas, a, b, c) result(work)
      real(wp), intent(in)           :: areas(:) !! [length^2]
      type(normal_state), intent(in) :: a(:), b(:), c(:)
      real(wp) :: first(size(a)), second(size(a))

      first = b%lambda - a%lambda
      second = c%lambda - b%lambda
      work = sum(areas*c%p_a*max(0.0_wp, max(a%lambda + first - second, b%lambda + max(0.0_wp, first)) - c%lambda_a), &
                 mask=second < max(0.0_wp, slowed*first))
   end function missed_work

   !> Begin PATH at ALPHA and Q.
   pure subroutine begin_path(model, alpha, q, path)
      type(model_type), intent(in)   :: model
      real(wp), intent(in)           :: alpha, q
      type(path_type), intent(inout) :: path

      path%points = reshape([alpha, q], [2, 1])
      path%work = spread(0.0_wp, 1, size(model%joints%element))
      path%has_slipped = spread(.false., 1, size(model%joints%element))
      path%has_opened = path%has_slipped
   end subroutine begin_path

   !> Add WORK, done by the joints on the way to NOW, to PATH.
   subroutine add_work(now, work, path)
      type(analysis_type), intent(in) :: now
      real(wp), intent(in)            :: work(:) !! (elements) [force x length]
      type(path_type), intent(inout)  :: path

      path%work = path%work + work
      path%has_slipped = path%has_slipped .or. now%states%slips
      path%has_opened = path%has_opened .or. now%states%normal%branch == branch_open
   end subroutine add_work

   !> One increment from alpha = ENDS(1) to ENDS(2), and the WORK of the joints on the straight path of each element, without
   !! that of the forces at rest. Where it continues the last increment, NEWTON begins from the extrapolated displacements.
   subroutine load_increment(model, modal, ends, now, work, failure)
      type(model_type), intent(in)         :: model
      type(modal_load_type), intent(inout) :: modal
      real(wp), intent(in)                 :: ends(2)
      type(analysis_type), intent(inout)   :: now
      real(wp), intent(out)                :: work(:) !! (elements) [force x length]
      type(failure_type), intent(inout)    :: failure
      type(element_state) :: before(size(now%states))
      type(joint_energy)  :: energy
      real(wp) :: from(3, size(now%states)), step
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
      step = ends(2) - ends(1)
      now%increment = merge(1, 0, step*now%increment_fraction > 0.0_wp)
      modal%plan%stages(modal%rest%stage)%fractions = pack([now%increment_fraction, step], [now%increment > 0, .true.])
      before = now%states
      from = now%movement
      call start_increment(modal%plan, modal%system, now)
      call newton_increment(model, modal%plan, now, modal%system, failure)
      if (failure%raised) then
         modal%carried = abs(ends(2) - (sum(modal%plan%stages(modal%rest%stage)%fractions) - now%fraction)) ! newton went back to it
         failure%message = failure%message//'; the last state in equilibrium is at '//in_words(modal%carried)
         return
      end if
      do e = 1, size(before)
         associate (element => model%joints%element(e), to => now%movement(:, e))
            energy = work_along(model%joints%list(element%joint)%law, element%area, before(e), to)
            work(e) = sum(energy%net()) - dot_product(modal%rest_forces(:, e), to - from(:, e))
         end associate
      end do
   end subroutine load_increment

   !> ALPHA for a message.
   pure function in_words(alpha) result(words)
      real(wp), intent(in)      :: alpha
      character(:), allocatable :: words

      words = 'alpha = '//real_text(alpha)
   end function in_words

   !> q of the state NOW, under ALPHA.
   pure real(wp) function coordinate(modal, now, alpha) result(q)
      type(modal_load_type), intent(in) :: modal
      type(analysis_type), intent(in)   :: now
      real(wp), intent(in)              :: alpha

      q = sum(modal%condensed*(now%u - modal%rest%u)) + alpha*modal%inside
   end function coordinate

end module modal_path
