!> Everything that changes from increment to increment, and what all methods do with it alike.
module analysis_state
   use bar_elements, only: add_pull
   use body_elements, only: internal_forces
   use equations, only: body_forces, condense_load, equation_system, recover_displacements
   use joint_laws, only: element_state, element_stiffness_of
   use kinds, only: wp
   use model_data, only: joint_movement, model_type, n_bars, n_sections
   use normal_stiffness, only: branch_open
   use stage_plan, only: stage_plan_type
   implicit none
   private

   public :: start_analysis, start_stage, start_increment, interface_stiffness, find_unbalanced, element_force, &
             recover_bodies, tally_work, record_pass, note_largest, free_norm

   !> Work done on one joint in the present stage [force x length].
   type, public :: joint_energy
      real(wp) :: put_in(2)     = 0.0_wp            !! by shear, by normal forces: sum of the positive works
      real(wp) :: given_back(2) = 0.0_wp            !! likewise of the negative ones, as a positive number
   end type joint_energy

   !> One re-analysis after the Coulomb check, or one iteration towards equilibrium, for the listing.
   type, public :: pass_record
      real(wp) :: before = 0.0_wp, after = 0.0_wp   !! excess, or unbalanced force [force]
      real(wp) :: step = 1.0_wp                     !! length of the line search
      integer  :: changes = 0                       !! interface elements that slip, or that changed their branch
      integer  :: part = 0                          !! NEWTON: which part of a divided increment; BACK: -1
   end type pass_record

   !> Arrays over nodes are (dimension, n_nodes). In the increments displacements and unbalanced forces are those of the nodes
   !! that the equations retain; recover_bodies completes them.
   type, public :: analysis_type
      integer  :: stage = 0, increment = 0
      real(wp) :: share = 0.0_wp                    !! of the stage's load change, this increment
      real(wp) :: fraction = 0.0_wp                 !! of it, so far: exactly 1 at the end of the stage
      logical  :: carry = .false.
      real(wp) :: load_tolerance = 1.0e-10_wp       !! NEWTON: share of the largest load that may be left unbalanced
      real(wp) :: tolerance = 0.0_wp                !! the same as a force, for the largest load so far
      real(wp), allocatable :: load_before(:, :)    !! at the start of the stage [force]
      real(wp), allocatable :: load_after(:, :)     !! at its end; what is not elastic in bolts included
      real(wp), allocatable :: applied(:, :)        !! now
      real(wp), allocatable :: felt_before(:, :)    !! the same loads as retained nodes feel them: what acts on the others
      real(wp), allocatable :: felt_after(:, :)     !! condensed, and what moved supports push included
      real(wp), allocatable :: felt(:, :)
      real(wp), allocatable :: change(:, :)         !! of that in this increment
      integer, allocatable  :: retained(:)          !! the nodes that the equations retain
      integer, allocatable  :: loaded(:)            !! nodes on which loads act in this stage
      logical  :: is_moved = .false.                !! whether supports are out of their places in this stage
      logical  :: moves = .false.                   !! whether they are moved in this increment
      real(wp), allocatable :: moved_before(:, :)   !! displacements of held components at the start of the stage [length]
      real(wp), allocatable :: moved_after(:, :)    !! at its end
      real(wp), allocatable :: moved(:, :)          !! now
      real(wp), allocatable :: move(:, :)           !! in this increment
      real(wp), allocatable :: body(:, :)           !! [k_b] {u} as retained nodes feel it
      real(wp), allocatable :: u(:, :), du(:, :)    !! displacements, and of this increment [length]
      real(wp), allocatable :: unbalanced(:, :)     !! applied - internal forces; on held components minus the reaction
      real(wp), allocatable :: pull(:)              !! of locked bolts: tension at the lengths of the model at rest [force]
      type(element_state), allocatable :: states(:) !! of the interface elements
      real(wp), allocatable :: k(:, :)              !! (3, n) their stiffness (k_sx, k_sy, k_n) in the next increment
      type(joint_energy), allocatable  :: energy(:) !! of the joints
      type(pass_record), allocatable   :: passes(:) !! of the last increment
      integer  :: n_passes  = 0
      real(wp) :: largest_p = 0.0_wp                !! pressure or shear stress so far, anywhere: the measure of noise
      real(wp) :: largest_lambda = 0.0_wp           !! deflection so far, likewise
      integer  :: n_removed = 0                     !! interface elements removed by the last increment
      integer  :: n_parts   = 1                     !! NEWTON: parts that the last increment was divided into
   end type analysis_type

contains

   !> A structure at rest without load.
   subroutine start_analysis(model, system, carry, tolerance, analysis)
      type(model_type), intent(in)      :: model
      type(equation_system), intent(in) :: system
      logical, intent(in)               :: carry
      real(wp), intent(in)              :: tolerance !! of NEWTON [-]
      type(analysis_type), intent(out)  :: analysis

      allocate (analysis%applied(model%dimension, model%n_nodes), source=0.0_wp)
      allocate (analysis%load_before, analysis%load_after, analysis%u, analysis%du, analysis%body, analysis%unbalanced, &
                source=analysis%applied)
      allocate (analysis%felt_before, analysis%felt_after, analysis%felt, analysis%change, source=analysis%applied)
      allocate (analysis%moved_before, analysis%moved_after, analysis%moved, analysis%move, source=analysis%applied)
      allocate (analysis%retained, source=system%retained)
      allocate (analysis%pull(n_bars(model)), source=0.0_wp)
      analysis%carry = carry
      analysis%load_tolerance = tolerance
      allocate (analysis%states(size(model%interface)), analysis%energy(size(model%joints)), analysis%passes(16))
      allocate (analysis%k(3, size(model%interface)), source=0.0_wp)
   end subroutine start_analysis


   !> The next stage begins where the last one ended; the joint remembers.
   subroutine start_stage(model, system, stage, analysis)
      type(model_type), intent(in)       :: model
      type(equation_system), intent(in)  :: system
      integer, intent(in)                :: stage
      type(analysis_type), intent(inout) :: analysis
      integer :: i

      analysis%stage = stage
      analysis%increment = 0
      analysis%fraction = 0.0_wp
      analysis%energy = joint_energy()
      analysis%load_before = analysis%applied
      analysis%load_after = 0.0_wp
      analysis%moved_before = analysis%moved
      analysis%moved_after = 0.0_wp
      associate (loads => model%stage_loads(stage))
         if (allocated(loads%moved)) analysis%moved_after = loads%moved
         do i = 1, loads%n
            analysis%load_after(:, loads%node(i)) = analysis%load_after(:, loads%node(i)) + loads%force(:model%dimension, i)
         end do
      end associate
      do i = 1, n_bars(model)
         if (model%bars(i)%stage == stage) analysis%pull(i) = model%bars(i)%preload
         call add_pull(model, i, analysis%pull(i), analysis%load_after)
      end do
      do i = 1, n_sections(model)
         associate (section => model%sections(i))
            associate (load => analysis%load_after(1, section%node))
               if (section%stage == stage) load = load + section%preload
            end associate
            if (section%is_locked) analysis%moved_after(1, section%node) = analysis%moved_before(1, section%node)
         end associate
      end do
      analysis%loaded = pack([(i, i = 1, model%n_nodes)], &
                             any(abs(analysis%load_before) > 0.0_wp .or. abs(analysis%load_after) > 0.0_wp, dim=1))
      analysis%is_moved = any(abs(analysis%moved_before) > 0.0_wp .or. abs(analysis%moved_after) > 0.0_wp)
      if (stage > 1) call condense(model, system, analysis%load_before, analysis%moved_before, analysis%felt_before)
      call condense(model, system, analysis%load_after, analysis%moved_after, analysis%felt_after)
      analysis%felt = analysis%felt_before
      call body_forces(system, analysis%u, analysis%body)
   end subroutine start_stage


   !> What retained nodes feel of LOAD on all nodes where held components are MOVED.
   subroutine condense(model, system, load, moved, felt)
      type(model_type), intent(in)      :: model
      type(equation_system), intent(in) :: system
      real(wp), intent(in)              :: load(:, :), moved(:, :)
      real(wp), intent(out)             :: felt(:, :)

      call condense_load(system, load - forces_of(model, system, moved), felt)
   end subroutine condense


   !> Forces that the bodies need to have MOVED what has no equation, the others at rest.
   function forces_of(model, system, moved) result(f)
      type(model_type), intent(in)      :: model
      type(equation_system), intent(in) :: system
      real(wp), intent(in)              :: moved(:, :)
      real(wp), allocatable :: f(:, :)

      allocate (f, source=merge(moved, 0.0_wp, system%number == 0))
      if (any(abs(f) > 0.0_wp)) then
         call internal_forces(model, merge(moved, 0.0_wp, system%number == 0), f)
      else
         f = 0.0_wp
      end if
   end function forces_of


   !> {dF} of the next increment: its share of the stage's load change, and what is unbalanced where CARRY asks for it.
   subroutine start_increment(plan, analysis)
      type(stage_plan_type), intent(in)  :: plan
      type(analysis_type), intent(inout) :: analysis
      real(wp), allocatable :: moved(:, :)

      associate (shares => plan%stages(analysis%stage)%shares)
         analysis%increment = analysis%increment + 1
         analysis%share = shares(analysis%increment)
         analysis%fraction = sum(shares(:analysis%increment))
         if (analysis%increment == size(shares)) analysis%fraction = 1.0_wp
      end associate
      associate (nodes => analysis%loaded)
         analysis%applied(:, nodes) = between(analysis%load_before(:, nodes), analysis%load_after(:, nodes))
      end associate
      analysis%moves = .false.
      if (analysis%is_moved) then
         allocate (moved, source=between(analysis%moved_before, analysis%moved_after))
         analysis%move = moved - analysis%moved
         analysis%moved = moved
         analysis%moves = any(abs(analysis%move) > 0.0_wp)
      end if
      associate (r => analysis%retained)
         analysis%change(:, r) = between(analysis%felt_before(:, r), analysis%felt_after(:, r)) - analysis%felt(:, r)
         analysis%felt(:, r) = analysis%felt(:, r) + analysis%change(:, r)
         if (analysis%carry) analysis%change(:, r) = analysis%change(:, r) + analysis%unbalanced(:, r)
      end associate
      analysis%n_passes = 0
      analysis%n_parts = 1

   contains

      !> BEFORE at the beginning of the stage, AFTER at its end.
      elemental real(wp) function between(before, after)
         real(wp), intent(in) :: before, after

         between = before + analysis%fraction*(after - before)
         if (analysis%fraction >= 1.0_wp) between = after
      end function between

   end subroutine start_increment


   !> NORM and SHEAR for every interface element: its branches after the last increment, its stiffness for the next one.
   subroutine interface_stiffness(model, analysis)
      type(model_type), intent(in)       :: model
      type(analysis_type), intent(inout) :: analysis
      integer :: before, i

      analysis%n_removed = 0
      do i = 1, size(model%interface)
         before = analysis%states(i)%normal%branch
         call element_stiffness_of(model%joints(model%interface(i)%joint)%law, model%interface(i)%area, &
                                   joint_movement(model, analysis%u, i), analysis%states(i), analysis%k(:, i))
         if (analysis%states(i)%normal%branch == branch_open .and. before /= branch_open) &
            analysis%n_removed = analysis%n_removed + 1
      end do
      call find_unbalanced(model, analysis)
   end subroutine interface_stiffness


   !> Force that interface element I carries, in global axes, as it acts on its node 2 or the base [force].
   pure function element_force(model, analysis, i) result(force)
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      integer, intent(in)             :: i
      real(wp) :: force(3)

      associate (state => analysis%states(i), element => model%interface(i))
         force = matmul(element%axes, [state%shear%tau*element%area, state%normal%sumf])
      end associate
   end function element_force


   !> Load minus the forces in bodies and joints on retained nodes: what the increment leaves unbalanced.
   subroutine find_unbalanced(model, analysis)
      type(model_type), intent(in)       :: model
      type(analysis_type), intent(inout) :: analysis

      associate (r => analysis%retained)
         analysis%unbalanced(:, r) = analysis%felt(:, r) - analysis%body(:, r)
      end associate
      call subtract_joint_forces(model, analysis)
   end subroutine find_unbalanced


   !> Take the forces in joints from the unbalanced ones.
   subroutine subtract_joint_forces(model, analysis)
      type(model_type), intent(in)       :: model
      type(analysis_type), intent(inout) :: analysis
      real(wp) :: force(3)
      integer  :: i

      do i = 1, size(model%interface)
         force = element_force(model, analysis, i)
         associate (nodes => model%interface(i)%nodes, d => model%dimension)
            analysis%unbalanced(:, nodes(1)) = analysis%unbalanced(:, nodes(1)) - force(:d)
            if (nodes(2) > 0) analysis%unbalanced(:, nodes(2)) = analysis%unbalanced(:, nodes(2)) + force(:d)
         end associate
      end do
   end subroutine subtract_joint_forces


   !> Displacements of all nodes; unbalanced forces likewise, from the elements themselves: on held components minus the reaction.
   subroutine recover_bodies(model, system, analysis)
      type(model_type), intent(in)       :: model
      type(equation_system), intent(in)  :: system
      type(analysis_type), intent(inout) :: analysis

      call recover_displacements(system, analysis%applied - forces_of(model, system, analysis%moved), analysis%u)
      where (system%number == 0) analysis%u = analysis%moved
      call internal_forces(model, analysis%u, analysis%unbalanced)
      analysis%unbalanced = analysis%applied - analysis%unbalanced
      call subtract_joint_forces(model, analysis)
   end subroutine recover_bodies


   !> Euclidean norm of nodal forces over the free components of NODES [force].
   pure real(wp) function free_norm(model, f, nodes) result(norm)
      type(model_type), intent(in) :: model
      real(wp), intent(in)         :: f(:, :)  !! (dimension, n_nodes)
      integer, intent(in)          :: nodes(:)
      real(wp) :: largest
      integer  :: i

      largest = 0.0_wp
      do i = 1, size(nodes)
         largest = max(largest, maxval(abs(f(:, nodes(i))), mask=.not. model%held(:, nodes(i))))
      end do
      norm = 0.0_wp
      if (largest <= 0.0_wp) return
      do i = 1, size(nodes)
         norm = norm + sum((f(:, nodes(i))/largest)**2, mask=.not. model%held(:, nodes(i)))
      end do
      norm = largest*sqrt(norm)
   end function free_norm


   !> Add the works (by shear, by normal forces) done on one element to those of its joint.
   pure subroutine tally_work(energy, work)
      type(joint_energy), intent(inout) :: energy
      real(wp), intent(in)              :: work(2)

      energy%put_in = energy%put_in + max(0.0_wp, work)
      energy%given_back = energy%given_back + max(0.0_wp, -work)
   end subroutine tally_work

   !> Keep the largest pressure and deflection that there have been.
   pure subroutine note_largest(analysis)
      type(analysis_type), intent(inout) :: analysis
      integer :: k

      if (size(analysis%states) == 0) return
      analysis%largest_p = max(analysis%largest_p, maxval(abs(analysis%states%normal%pressure)))
      analysis%largest_lambda = max(analysis%largest_lambda, maxval(abs(analysis%states%normal%lambda)))
      do k = 1, 2
         analysis%largest_p = max(analysis%largest_p, maxval(abs(analysis%states%shear(k)%tau)))
         analysis%largest_lambda = max(analysis%largest_lambda, maxval(abs(analysis%states%shear(k)%delta)))
      end do
   end subroutine note_largest


   !> Note a pass for the listing.
   subroutine record_pass(analysis, pass)
      type(analysis_type), intent(inout) :: analysis
      type(pass_record), intent(in)      :: pass

      if (analysis%n_passes == size(analysis%passes)) analysis%passes = [analysis%passes, analysis%passes]
      analysis%n_passes = analysis%n_passes + 1
      analysis%passes(analysis%n_passes) = pass
   end subroutine record_pass

end module analysis_state
