!> The load path over stages and increments, and the recovery of displacements and forces of the bodies.
module load_path
   use analysis_state, only: all_held, analysis_type, load_state, path_error_type, subtract_joint_forces
   use body_elements, only: add_thermal_forces, internal_forces
   use bolt_locking, only: lock_bolts
   use equations, only: condense_load, equation_system, forces_in_bodies, recover_displacements
   use joint_work, only: joint_energy
   use kinds, only: wp
   use model_data, only: model_type, n_bars, n_sections
   use node_coupling, only: displacements, forces_on_unknowns
   use stage_plan, only: stage_plan_type
   use structural_elements, only: add_bar_forces, add_axial_force, thermal_tension
   use temperatures, only: temperature_between
   implicit none
   private

   public :: start_stage, hold_load, start_increment, go_back, recover_bodies, support_force

contains

   !> Start the next stage from the end of the present one: the joint keeps its history, and bolts tightened in this stage are
   !! locked. A stage that was restarted within continues. IS_BESIDE as in lock_bolts.
   subroutine start_stage(model, system, analysis, is_beside)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(inout) :: system
      type(analysis_type), intent(inout) :: analysis
      logical, intent(in), optional      :: is_beside
      integer :: i, stage

      if (analysis%goes_on) then
         analysis%goes_on = .false.
         return
      end if
      stage = analysis%next
      call lock_bolts(model, system, analysis, stage, is_beside)
      analysis%next = stage + 1
      analysis%stage = stage
      analysis%increment = 0
      analysis%fraction = 0.0_wp
      if (stage > 1) analysis%energy = joint_energy() ! the first stage keeps the work of interference
      analysis%before = analysis%now
      analysis%after%load = 0.0_wp
      analysis%after%moved = 0.0_wp
      analysis%after%temperature = model%history%stages(stage)%temperature
      associate (loads => model%history%stages(stage))
         if (allocated(loads%moved)) analysis%after%moved = loads%moved
         if (allocated(analysis%stands)) analysis%after%moved = analysis%after%moved + analysis%stands
         do i = 1, loads%n
            analysis%after%load(:, loads%node(i)) = analysis%after%load(:, loads%node(i)) + loads%force(:model%mesh%dimension, i)
         end do
      end associate
      do i = 1, n_bars(model%mesh)
         associate (tightening => model%mesh%bars(i)%tightening)
            if (tightening%is_in(stage)) analysis%rest_tension(i) = tightening%preload_in(stage)
         end associate
         call add_axial_force(model, i, analysis%rest_tension(i), analysis%after%load)
      end do
      if (allocated(analysis%after%temperature%at)) then
         call add_thermal_forces(model, analysis%after%temperature, analysis%after%load)
         do i = 1, n_bars(model%mesh)
            if (analysis%is_elastic(i)) &
               call add_axial_force(model, i, thermal_tension(model%mesh%bars(i), analysis%after%temperature), analysis%after%load)
         end do
      end if
      do i = 1, n_sections(model%mesh)
         associate (section => model%mesh%sections(i))
            analysis%after%load(1, section%node) = analysis%after%load(1, section%node) + section%tightening%preload_in(stage)
            if (analysis%is_locked(i)) analysis%after%moved(1, section%node) = analysis%before%moved(1, section%node)
         end associate
      end do
      analysis%loaded = pack([(i, i = 1, model%mesh%n_nodes)], &
                             any(abs(analysis%before%load) > 0.0_wp .or. abs(analysis%after%load) > 0.0_wp, dim=1))
      analysis%is_moved = any(abs(analysis%before%moved) > 0.0_wp .or. abs(analysis%after%moved) > 0.0_wp)
      if (stage > 1) call condense(model, system, analysis%is_elastic, analysis%before)
      call condense(model, system, analysis%is_elastic, analysis%after)
      analysis%now%condensed_load = analysis%before%condensed_load
      call forces_in_bodies(system, analysis%u, analysis%body)
   end subroutine start_stage

   !> Prepare the structure for the next stage under constant load: lock bolts, set the load before and after to the same.
   subroutine hold_load(model, system, analysis)
      type(model_type), intent(in)          :: model
      class(equation_system), intent(inout) :: system
      type(analysis_type), intent(inout)    :: analysis
      integer :: i

      call lock_bolts(model, system, analysis)
      analysis%carry = .false.
      analysis%is_moved = .false.
      analysis%loaded = [(i, i = 1, model%mesh%n_nodes)]
      call condense(model, system, analysis%is_elastic, analysis%now)
      analysis%before = analysis%now
      analysis%after = analysis%now
      call forces_in_bodies(system, analysis%u, analysis%body)
   end subroutine hold_load

   !> Condense the load and the prescribed displacements AT an instant on the retained nodes.
   subroutine condense(model, system, is_elastic, at)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      logical, intent(in)                :: is_elastic(:) !! (bars)
      type(load_state), intent(inout)    :: at

      call condense_load(system, load_on_unknowns(model, system, is_elastic, at), at%condensed_load)
   end subroutine condense

   !> The load AT an instant less the forces of bodies and elastic bars when held components are moved and all others are fixed.
   function load_on_unknowns(model, system, is_elastic, at) result(f)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      logical, intent(in)                :: is_elastic(:)
      type(load_state), intent(in)       :: at
      real(wp), allocatable :: f(:, :), held(:, :)

      allocate (held, source=merge(at%moved, 0.0_wp, system%number == 0))
      if (any(abs(held) > 0.0_wp)) then
         allocate (f, mold=held)
         call internal_forces(model, displacements(model, held), f)
         call add_bar_forces(model, is_elastic, displacements(model, held), f)
         f = forces_on_unknowns(model, at%load - f)
      else
         f = forces_on_unknowns(model, at%load)
      end if
   end function load_on_unknowns

   !> {dF} of the next increment: its share of the stage's load change, plus the unbalanced forces where CARRY asks for them.
   subroutine start_increment(plan, system, analysis)
      type(stage_plan_type), intent(in)  :: plan
      class(equation_system), intent(in) :: system
      type(analysis_type), intent(inout) :: analysis
      real(wp), allocatable :: before(:, :)

      associate (fractions => plan%stages(analysis%stage)%fractions)
         analysis%increment = analysis%increment + 1
         analysis%increment_fraction = fractions(analysis%increment)
         analysis%fraction = sum(fractions(:analysis%increment))
         if (analysis%increment == size(fractions)) analysis%fraction = 1.0_wp
      end associate
      call load_nodes(analysis)
      analysis%now%temperature = temperature_between(analysis%before%temperature, analysis%after%temperature, analysis%fraction)
      analysis%moves = .false.
      analysis%move = 0.0_wp
      if (analysis%is_moved) then
         allocate (before, source=analysis%now%moved)
         analysis%now%moved = between(analysis%fraction, analysis%before%moved, analysis%after%moved)
         analysis%moves = any(abs(analysis%now%moved - before) > 0.0_wp)
         analysis%move = analysis%now%moved(:, system%retained) - before(:, system%retained)
      end if
      associate (load => analysis%now%condensed_load)
         analysis%change = between(analysis%fraction, analysis%before%condensed_load, analysis%after%condensed_load) - load
         load = load + analysis%change
      end associate
      if (analysis%carry) analysis%change = analysis%change + analysis%unbalanced
      analysis%record%n_iterations = 0
      analysis%record%slips = analysis%record%slips(:0)
      analysis%record%n_parts = 1
      analysis%record%is_whole = .true.
      analysis%record%follows_path = .false.
      analysis%record%path_error = path_error_type()
   end subroutine start_increment

   !> Set the loads and movements of an increment that ended early, with LEFT of it still to do. Where none of it was done, the
   !! last increment is the one before.
   pure subroutine go_back(plan, left, analysis)
      type(stage_plan_type), intent(in)  :: plan
      real(wp), intent(in)               :: left     !! of the increment [-], > 0
      type(analysis_type), intent(inout) :: analysis

      analysis%record%is_partial = left < 1.0_wp
      associate (fractions => plan%stages(analysis%stage)%fractions)
         analysis%fraction = sum(fractions(:analysis%increment)) - left*fractions(analysis%increment)
         if (.not. analysis%record%is_partial) analysis%increment = analysis%increment - 1
      end associate
      call load_nodes(analysis)
      if (analysis%is_moved) analysis%now%moved = between(analysis%fraction, analysis%before%moved, analysis%after%moved)
      analysis%now%condensed_load = between(analysis%fraction, analysis%before%condensed_load, analysis%after%condensed_load)
      analysis%record%ends_early = analysis%increment > 0 .or. analysis%stage > 1
   end subroutine go_back

   !> The load on all nodes at the present fraction of the stage.
   pure subroutine load_nodes(analysis)
      type(analysis_type), intent(inout) :: analysis

      associate (nodes => analysis%loaded)
         analysis%now%load(:, nodes) = between(analysis%fraction, analysis%before%load(:, nodes), analysis%after%load(:, nodes))
      end associate
   end subroutine load_nodes

   !> Interpolate from BEFORE, at the beginning of the stage, to AFTER, at its end, at FRACTION.
   elemental real(wp) function between(fraction, before, after)
      real(wp), intent(in) :: fraction, before, after

      between = before + fraction*(after - before)
      if (fraction >= 1.0_wp) between = after
   end function between

   !> Displacements and unbalanced forces of all nodes, from the elements themselves, in global axes; on held components minus
   !! the reaction.
   subroutine recover_bodies(model, system, analysis)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      type(analysis_type), intent(inout) :: analysis
      real(wp), allocatable :: mean(:), on_unknowns(:, :), q(:, :)
      integer :: i

      call recover(model, system, analysis, analysis%now, analysis%u, q, analysis%all_unbalanced)
      analysis%all_u = displacements(model, q)
      if (allocated(model%mean)) then
         mean = [(sum(model%mean(:, :, i)*analysis%all_u), i = 1, size(model%mean, 3))]
         do i = 1, size(mean)
            analysis%all_u = analysis%all_u - mean(i)*model%rigid(:, :, i)
         end do
      end if
      analysis%u = q(:, system%retained)
      allocate (on_unknowns, source=forces_on_unknowns(model, analysis%all_unbalanced))
      analysis%unbalanced = on_unknowns(:, system%retained)
   end subroutine recover_bodies

   !> The unknowns Q of all nodes and the UNBALANCED forces on them in global axes, for the unknowns U of retained nodes under
   !! the loads and support movements AT an instant, with the present joint forces.
   subroutine recover(model, system, analysis, at, u, q, unbalanced)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      type(analysis_type), intent(in)    :: analysis
      type(load_state), intent(in)       :: at
      real(wp), intent(in)               :: u(:, :)
      real(wp), allocatable, intent(out) :: q(:, :)
      real(wp), intent(out)              :: unbalanced(:, :)
      real(wp), allocatable :: all_u(:, :)

      allocate (q, mold=at%load)
      call recover_displacements(system, load_on_unknowns(model, system, analysis%is_elastic, at), u, q)
      where (system%number == 0) q = at%moved
      allocate (all_u, source=displacements(model, q))
      call internal_forces(model, all_u, unbalanced)
      call add_bar_forces(model, analysis%is_elastic, all_u, unbalanced)
      unbalanced = at%load - unbalanced
      call subtract_joint_forces(model%joints%element, analysis%states, unbalanced)
   end subroutine recover

   !> Support forces under the displacements U of retained nodes, with LEFT of the increment still to do [force].
   real(wp) function support_force(model, system, analysis, u, left) result(force)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      type(analysis_type), intent(in)    :: analysis
      real(wp), intent(in)               :: u(:, :) !! (dimension, retained) [length]
      real(wp), intent(in)               :: left    !! [-], 0 to 1
      type(load_state) :: at
      real(wp), allocatable :: q(:, :), unbalanced(:, :)

      associate (ahead => left*analysis%increment_fraction, before => analysis%before, after => analysis%after)
         at%load = analysis%now%load - ahead*(after%load - before%load)
         at%moved = analysis%now%moved - ahead*(after%moved - before%moved)
      end associate
      allocate (unbalanced, mold=at%load)
      call recover(model, system, analysis, at, u, q, unbalanced)
      force = norm2(pack(forces_on_unknowns(model, unbalanced), all_held(model, analysis)))
   end function support_force

end module load_path
