!> The state of the analysis, which changes from increment to increment, and operations on it common to all methods.
module analysis_state
   use case_control, only: case_control_type
   use control_words, only: method_newton, method_step, pressure_eq10
   use condensed_interface, only: condensed_type
   use condition_estimate, only: condition_type
   use equation_solver, only: equation_system, failure_type
   use interface_operator, only: add_global_force, interface_element, joint_movement
   use joint_laws, only: element_state, norm_and_shear
   use joint_work, only: joint_energy
   use kinds, only: wp
   use model_data, only: model_type, n_bars, n_sections, temperature_type
   use normal_curve, only: normal_secant
   use normal_stiffness, only: at_rest, branch_load, branch_open, is_virgin
   use numbers, only: is_measure
   use terminal, only: line_is_shown, show_line
   use text_tools, only: integer_text, real_text
   use tolerances, only: newton_tol, path_tol, rounding_of_forces
   implicit none
   private

   public :: start_analysis, all_held, interface_stiffness, find_movements, find_unbalanced, subtract_joint_forces, element_force, &
             record_iteration, note_largest, free_norm, force_noise, note_turns

   integer, parameter, public :: no_stiffness = 1, secant_stiffness = 2, tangent_stiffness = 3, e_u_stiffness = 4 !! k_n used
   integer, parameter, public :: kind_on_branch(4) = [tangent_stiffness, e_u_stiffness, no_stiffness, e_u_stiffness] !! by branch

   !> Where a shear branch of an interface element began, for the listing only.
   type, public :: turning_point
      integer  :: branch = branch_load              !! that began there
      real(wp) :: delta = 0.0_wp, tau = 0.0_wp      !! [length], [pressure]
   end type turning_point

   !> One re-analysis after the Coulomb check, or one iteration towards equilibrium, for the listing.
   type, public :: iteration_record
      real(wp) :: before = 0.0_wp, after = 0.0_wp   !! excess, or unbalanced force [force]; BACK: largest p, its change [pressure]
      real(wp) :: step = 1.0_wp                     !! length of the line search; BACK: largest deflection [length]
      integer  :: changes = 0                       !! interface elements that slip or have changed their branch
      integer  :: part = 0                          !! NEWTON: which part of a divided increment; BACK: -1
   end type iteration_record

   !> A slipping element before and after a re-analysis: points t_1 and t_1' of Fig. 5(b).
   type, public :: slip_record
      integer  :: reanalysis = 0, element = 0
      real(wp) :: delta(2, 2) = 0.0_wp              !! (direction, before and after) [length]
      real(wp) :: tau(2, 2) = 0.0_wp                !! likewise [pressure]
      real(wp) :: limit(2) = 0.0_wp                 !! mu p before and after
   end type slip_record

   !> The loads and support movements at one instant.
   type, public :: load_state
      real(wp), allocatable  :: load(:, :)           !! (dimension, n_nodes) with constant parts of bolt and thermal forces [force]
      real(wp), allocatable  :: moved(:, :)          !! (dimension, n_nodes) displacements of held components [length]
      type(temperature_type) :: temperature
      real(wp), allocatable  :: condensed_load(:, :) !! (dimension, retained) condensed load, with moved supports [force]
   end type load_state

   !> The error of path of an increment: how far its end is from the limit of many increments, see path_error.
   type, public :: path_error_type
      ! root mean squares over the joint where they are largest, relative to the largest value so far of all joints [-]
      real(wp) :: deflection = 0.0_wp               !! of lambda
      real(wp) :: pressure = 0.0_wp
      real(wp) :: contact = 0.0_wp                  !! share of the area of a joint that is open in one of both states, and pressed
                                                    !! by more than PATHTOL of the largest pressure in the other [-]
      logical  :: lets_go = .false.                 !! any element is open in one of both states only
      logical  :: slides = .false.                  !! a joint slips at all its nodes that press
      real(wp) :: displacement = 0.0_wp             !! then: largest difference of a displacement, of the largest displacement [-]
      logical  :: unseen = .false.                  !! the way may hold what its points do not show
   end type path_error_type

   !> The record of the last increment for output; no later result depends on it.
   type, public :: increment_record
      type(iteration_record), allocatable :: iterations(:)
      type(slip_record), allocatable      :: slips(:) !! where OUTPUT asks for them
      type(condensed_type)  :: condensed              !! [k_b] on the interface, where OUTPUT asks for it
      type(condition_type)  :: condition              !! of the stiffness that the increment used
      integer, allocatable  :: kind(:)                !! kind of the normal stiffness of each interface element
      integer  :: n_iterations = 0
      integer  :: n_removed = 0                       !! interface elements removed
      integer  :: n_parts   = 1                       !! NEWTON: number of parts of the increment
      type(path_error_type) :: path_error             !! NEWTON
      logical  :: is_iterated = .false.               !! to equilibrium, by NEWTON, or by STEP where gaps close
      logical  :: is_whole  = .true.                  !! ... and the whole increment was repeated from where the parts led
      logical  :: follows_path = .false.              !! ... or its parts follow the path and stand
      logical  :: ends_early = .false.                !! NEWTON has stopped: this is the last state in equilibrium
      logical  :: is_partial = .false.                !! ... and it lies within an increment
      logical  :: hangs = .false.                     !! NEWTON: nothing holds a body without a joint that is open at all nodes
      logical  :: is_settled = .true.                 !! BACK: whether the last secants agree with their results
   end type increment_record

   !> Displacements and forces over nodes are (dimension, n_nodes). The increments use those of the retained nodes only, in
   !! arrays (dimension, retained); recover_bodies completes them.
   type, public :: analysis_type
      integer  :: stage = 0, increment = 0
      integer  :: next = 1                          !! position of the stage behind this one in the deck
      logical  :: goes_on = .false.                 !! the stage continues from a restart file
      real(wp) :: increment_fraction = 0.0_wp       !! of the stage's load change, this increment
      real(wp) :: fraction = 0.0_wp                 !! sum of these so far: exactly 1 at the end of the stage
      type(load_state) :: before, after, now        !! at the start of the stage, at its end, in this increment
      integer, allocatable :: loaded(:)             !! nodes on which loads act in this stage
      logical  :: is_moved = .false.                !! whether supports are displaced in this stage
      logical  :: moves = .false.                   !! whether supports move in this increment
      ! as case control has them
      logical  :: carry = .false.
      logical  :: eq10 = .false.                    !! STEP: p on the loading curve by Eq. (10) as printed
      logical  :: average = .true.                  !! BACK: averages two consecutive sets of results
      real(wp) :: load_tolerance = newton_tol         !! NEWTON: share of the largest load that may be left unbalanced; BACK: of the
                                                    !! largest pressure by which the laws may differ from the secants
      real(wp) :: path_tolerance = path_tol         !! NEWTON without INCR: share of the largest deflection and pressure
      real(wp) :: tolerance = 0.0_wp                !! LOAD_TOLERANCE as a force, for the largest load so far
      logical  :: is_loose = .false.                !! interference has pushed a body away until nothing presses it
      real(wp) :: loose_force = 0.0_wp              !! then p_av a_i of its joints: a small part of it counts as zero [force]
      ! over all nodes, from the last recover_bodies
      real(wp), allocatable :: all_u(:, :)          !! displacements [length]
      real(wp), allocatable :: all_unbalanced(:, :) !! applied - internal forces; on held components minus the reaction
      real(wp), allocatable :: stands(:, :)         !! where held components stood when they were held; not allocated: at rest [length]
      integer :: supports = 1                       !! which of the freedoms of the model are in force
      integer, allocatable  :: retained_index(:)    !! (n_nodes) of a node among the retained ones, 0: nowhere
      ! over retained nodes
      logical, allocatable  :: held(:, :)           !! supported or locked
      real(wp), allocatable :: change(:, :)         !! of the condensed load in this increment
      real(wp), allocatable :: move(:, :)           !! of supports in this increment [length]
      real(wp), allocatable :: body(:, :)           !! [k_b] {u}
      real(wp), allocatable :: u(:, :), du(:, :)    !! displacements, and of this increment [length]
      real(wp), allocatable :: unbalanced(:, :)     !! condensed load - internal forces
      ! of bars and of the sections of solid bolts
      logical, allocatable  :: is_elastic(:)        !! of bars: no bolt, or locked
      real(wp), allocatable :: rest_tension(:)      !! of locked bolts: tension at the lengths at rest and at TREF [force]
      logical, allocatable  :: is_locked(:)         !! of sections
      real(wp), allocatable :: start_tension(:)     !! of bars, then of sections: of a bolt that is tightened again, at the start of the
                                                    !! stage; else 0 [force]
      ! of interface elements and joints
      type(element_state), allocatable :: states(:)
      real(wp), allocatable :: movement(:, :)       !! (3, n) total, of end 1 relative to end 2, in element axes [length]
      real(wp), allocatable :: k(:, :)              !! (3, n) their stiffness (k_sx, k_sy, k_n) in the next increment
      integer, allocatable  :: next_kind(:)         !! of the normal stiffness in the next increment
      type(element_state), allocatable :: exact(:)  !! STEP: states of the exact laws on the same movements
      type(turning_point), allocatable :: turns(:, :) !! (2, n) where the shear branches began
      type(joint_energy), allocatable  :: energy(:) !! work on the joints in this stage
      real(wp) :: largest_p = 0.0_wp                !! largest pressure or shear stress so far: the scale of rounding errors
      real(wp) :: largest_lambda = 0.0_wp           !! deflection so far, likewise
      real(wp) :: largest_load = 0.0_wp             !! on the structure or on the joints so far [force]
      real(wp), allocatable :: kept(:, :)           !! backbone at the end of this stage: the loops done, one per column
      type(increment_record) :: record
   end type analysis_type

contains

   !> Start from the structure at rest without load.
   subroutine start_analysis(model, system, control, analysis)
      type(model_type), intent(in)        :: model
      class(equation_system), intent(in)  :: system
      type(case_control_type), intent(in) :: control
      type(analysis_type), intent(out)    :: analysis

      analysis%supports = model%supports
      analysis%carry = control%carry
      analysis%eq10 = control%pressure == pressure_eq10
      analysis%average = control%average
      analysis%load_tolerance = control%tolerance
      analysis%path_tolerance = control%path_tolerance
      allocate (analysis%all_u(model%mesh%dimension, model%mesh%n_nodes), source=0.0_wp)
      allocate (analysis%all_unbalanced, analysis%now%load, analysis%now%moved, source=analysis%all_u)
      allocate (analysis%retained_index, source=system%retained_index)
      allocate (analysis%held, source=system%held_now())
      allocate (analysis%u(model%mesh%dimension, size(system%retained)), source=0.0_wp)
      allocate (analysis%du, analysis%body, analysis%unbalanced, analysis%change, analysis%move, analysis%now%condensed_load, &
                source=analysis%u)
      analysis%before = analysis%now
      analysis%after = analysis%now
      allocate (analysis%rest_tension(n_bars(model%mesh)), source=0.0_wp)
      allocate (analysis%is_locked(n_sections(model%mesh)), source=.false.)
      allocate (analysis%start_tension(n_bars(model%mesh) + n_sections(model%mesh)), source=0.0_wp)
      allocate (analysis%is_elastic(n_bars(model%mesh)), source=.true.)
      if (n_bars(model%mesh) > 0) analysis%is_elastic = model%mesh%bars%bolt == 0
      allocate (analysis%states(size(model%joints%element)), analysis%energy(size(model%joints%list)))
      allocate (analysis%record%iterations(16), analysis%record%slips(0))
      allocate (analysis%k(3, size(model%joints%element)), analysis%movement(3, size(model%joints%element)), source=0.0_wp)
      allocate (analysis%turns(2, size(model%joints%element)))
      allocate (analysis%record%kind(size(model%joints%element)), analysis%next_kind(size(model%joints%element)), &
         source=no_stiffness)
      analysis%states%normal = at_rest(model%joints%list(model%joints%element%joint)%p_av, model%joints%element%gap)
      analysis%states%turns = control%method == method_newton
      if (control%method == method_step) allocate (analysis%exact, source=analysis%states)
   end subroutine start_analysis

   !> Which components of all nodes are held: supported or locked.
   pure function all_held(model, analysis) result(held)
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      logical :: held(model%mesh%dimension, model%mesh%n_nodes)
      integer :: i

      held = model%freedoms%held
      do i = 1, n_sections(model%mesh)
         if (analysis%is_locked(i)) held(1, model%mesh%sections(i)%node) = .true.
      end do
   end function all_held

   !> NORM and SHEAR for every interface element: its branches after the last increment and its stiffness for the next one. A
   !! removed element leaves its force unbalanced.
   subroutine interface_stiffness(model, system, analysis, failure)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      type(analysis_type), intent(inout) :: analysis
      type(failure_type), intent(in)     :: failure
      logical :: was_open
      integer :: i

      if (failure%raised) return
      analysis%record%n_removed = 0
      do i = 1, size(model%joints%element)
         associate (area => model%joints%element(i)%area, law => model%joints%list(model%joints%element(i)%joint)%law, &
                    state => analysis%states(i), k => analysis%k(:, i))
            was_open = state%normal%branch == branch_open
            call norm_and_shear(law, area, analysis%eq10, analysis%movement(:, i), state, k)
            if (state%normal%branch == branch_open .and. .not. was_open) analysis%record%n_removed = analysis%record%n_removed + 1
            analysis%next_kind(i) = kind_on_branch(state%normal%branch)
            if (is_virgin(area, state%normal) .and. k(3) <= normal_secant(law%normal, area, state%normal%p_av)) &
               analysis%next_kind(i) = secant_stiffness
         end associate
      end do
      call note_turns(analysis)
      call find_unbalanced(system, analysis)
   end subroutine interface_stiffness

   !> Note the shear branches that began with the last movement. A branch begins at the point before the movement.
   pure subroutine note_turns(analysis)
      type(analysis_type), intent(inout) :: analysis
      integer :: i, k

      do i = 1, size(analysis%states)
         do k = 1, 2
            associate (state => analysis%states(i)%shear(k), turn => analysis%turns(k, i))
               if (turn%branch /= state%branch) &
                  turn = turning_point(branch=state%branch, delta=state%delta_before, tau=state%tau_before)
            end associate
         end do
      end do
   end subroutine note_turns

   !> The movements of the interface elements under the displacements {u} that have been reached.
   subroutine find_movements(system, analysis)
      class(equation_system), intent(in) :: system
      type(analysis_type), intent(inout) :: analysis
      integer :: i

      do i = 1, size(system%interface)
         analysis%movement(:, i) = joint_movement(system%interface(i), analysis%u)
      end do
   end subroutine find_movements

   !> The unbalanced forces of the increment: load minus the forces in bodies and joints on retained nodes.
   subroutine find_unbalanced(system, analysis)
      class(equation_system), intent(in) :: system
      type(analysis_type), intent(inout) :: analysis

      analysis%unbalanced = analysis%now%condensed_load - analysis%body
      call subtract_joint_forces(system%interface, analysis%states, analysis%unbalanced)
   end subroutine find_unbalanced

   !> Force of an interface ELEMENT in this STATE on its end 2 or the base, in global axes [force].
   pure function element_force(element, state) result(force)
      type(interface_element), intent(in) :: element
      type(element_state), intent(in)     :: state
      real(wp) :: force(3)

      force = matmul(element%axes, [state%shear%tau*element%area, state%normal%sumf])
   end function element_force

   !> Subtract the forces of interface ELEMENTS in these STATES from the nodal forces F.
   pure subroutine subtract_joint_forces(elements, states, f)
      type(interface_element), intent(in) :: elements(:)
      type(element_state), intent(in)     :: states(:)
      real(wp), intent(inout)             :: f(:, :) !! (dimension, nodes that the elements number) [force]
      integer :: i

      do i = 1, size(elements)
         call add_global_force(elements(i), -element_force(elements(i), states(i)), f)
      end do
   end subroutine subtract_joint_forces

   !> Euclidean norm of nodal forces F over the components that are not HELD [force]; huge where the norm overflows.
   pure real(wp) function free_norm(f, held) result(norm)
      real(wp), intent(in) :: f(:, :)    !! (dimension, nodes)
      logical, intent(in)  :: held(:, :) !! likewise
      real(wp) :: largest
      integer  :: i

      norm = huge(1.0_wp)
      if (.not. all(is_measure(f))) return
      largest = maxval(abs(f), mask=.not. held)
      norm = 0.0_wp
      if (largest <= 0.0_wp) return
      do i = 1, size(f, 2)
         norm = norm + sum((f(:, i)/largest)**2, mask=.not. held(:, i))
      end do
      norm = largest*sqrt(norm)
   end function free_norm

   !> Bound of the rounding error of the forces in the bodies under U; these are differences of large numbers [force].
   pure real(wp) function force_noise(system, u) result(noise)
      class(equation_system), intent(in) :: system
      real(wp), intent(in)               :: u(:, :) !! [length]

      noise = rounding_of_forces*system%stiffest*max(0.0_wp, maxval(abs(u)))
   end function force_noise

   !> Update the largest pressure and deflection so far.
   pure subroutine note_largest(analysis)
      type(analysis_type), intent(inout) :: analysis
      integer :: k

      if (size(analysis%states) == 0) return
      analysis%largest_load = max(analysis%largest_load, free_norm(analysis%now%condensed_load, analysis%held), &
                                  norm2(analysis%states%normal%sumf))
      analysis%largest_p = max(analysis%largest_p, maxval(abs(analysis%states%normal%pressure)))
      analysis%largest_lambda = max(analysis%largest_lambda, maxval(abs(analysis%states%normal%lambda)))
      do k = 1, 2
         analysis%largest_p = max(analysis%largest_p, maxval(abs(analysis%states%shear(k)%tau)))
         analysis%largest_lambda = max(analysis%largest_lambda, maxval(abs(analysis%states%shear(k)%delta)))
      end do
   end subroutine note_largest

   !> Record an iteration for the listing, and report it on the terminal.
   subroutine record_iteration(analysis, iteration)
      type(analysis_type), intent(inout) :: analysis
      type(iteration_record), intent(in) :: iteration

      associate (record => analysis%record)
         if (record%n_iterations == size(record%iterations)) record%iterations = [record%iterations, record%iterations]
         record%n_iterations = record%n_iterations + 1
         record%iterations(record%n_iterations) = iteration
      end associate
      if (line_is_shown) & ! the words cost more than the record
         call show_line('stage '//integer_text(analysis%stage)//', increment '//integer_text(analysis%increment)//', iteration '// &
                     integer_text(analysis%record%n_iterations)//': '//real_text(iteration%after)//' left, changes of branch: '// &
                     integer_text(iteration%changes), at_once=.false.)
   end subroutine record_iteration

end module analysis_state
