!> Everything that changes from increment to increment, and what all methods do with it alike.
module analysis_state
   use case_control, only: case_control_type, pressure_eq10
   use equations, only: equation_system
   use joint_laws, only: element_state, element_stiffness_of
   use kinds, only: wp
   use model_data, only: joint_movement, model_type, n_bars
   use normal_stiffness, only: branch_open
   implicit none
   private

   public :: start_analysis, interface_stiffness, find_unbalanced, subtract_joint_forces, element_force, tally_work, &
             record_pass, note_largest, free_norm

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
      logical  :: eq10 = .false.                    !! STEP: p on the loading curve by Eq. (10) as printed
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
   subroutine start_analysis(model, system, control, analysis)
      type(model_type), intent(in)        :: model
      type(equation_system), intent(in)   :: system
      type(case_control_type), intent(in) :: control
      type(analysis_type), intent(out)    :: analysis

      allocate (analysis%applied(model%dimension, model%n_nodes), source=0.0_wp)
      allocate (analysis%load_before, analysis%load_after, analysis%u, analysis%du, analysis%body, analysis%unbalanced, &
                source=analysis%applied)
      allocate (analysis%felt_before, analysis%felt_after, analysis%felt, analysis%change, source=analysis%applied)
      allocate (analysis%moved_before, analysis%moved_after, analysis%moved, analysis%move, source=analysis%applied)
      allocate (analysis%retained, source=system%retained)
      allocate (analysis%pull(n_bars(model)), source=0.0_wp)
      analysis%carry = control%carry
      analysis%eq10 = control%pressure == pressure_eq10
      analysis%load_tolerance = control%tolerance
      allocate (analysis%states(size(model%interface)), analysis%energy(size(model%joints)), analysis%passes(16))
      allocate (analysis%k(3, size(model%interface)), source=0.0_wp)
      analysis%states%normal%p_av = model%joints(model%interface%joint)%p_av
   end subroutine start_analysis


   !> NORM and SHEAR for every interface element: its branches after the last increment, its stiffness for the next one.
   subroutine interface_stiffness(model, analysis)
      type(model_type), intent(in)       :: model
      type(analysis_type), intent(inout) :: analysis
      integer :: before, i

      analysis%n_removed = 0
      do i = 1, size(model%interface)
         before = analysis%states(i)%normal%branch
         call element_stiffness_of(model%joints(model%interface(i)%joint)%law, model%interface(i)%area, &
                                   analysis%eq10, joint_movement(model, analysis%u, i), analysis%states(i), analysis%k(:, i))
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
