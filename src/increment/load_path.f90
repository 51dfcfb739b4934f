!> The way of the load: from stage to stage, from increment to increment, and what it does to all nodes of the bodies.
module load_path
   use analysis_state, only: analysis_type, joint_energy, subtract_joint_forces
   use bar_elements, only: add_pull
   use body_elements, only: internal_forces
   use equations, only: body_forces, condense_load, equation_system, recover_displacements
   use kinds, only: wp
   use model_data, only: model_type, n_bars, n_sections
   use stage_plan, only: stage_plan_type
   implicit none
   private

   public :: start_stage, start_increment, recover_bodies

contains

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

end module load_path
