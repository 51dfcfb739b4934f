!> From a deck to the model that is solved: mesh, joints, freedoms and load history, each from those before it. An exchanged call does
!! not compile.
module model_build
   use bush_build, only: bush_type, find_bushes
   use control_words, only: method_step
   use case_sums, only: sum_cases
   use connected_bodies, only: find_parts
   use constraint_equations, only: expansion_type
   use deck_check, only: checked_deck
   use deck_errors, only: deck_error_list
   use deck_input, only: deck_type
   use determinate_joints, only: find_determinate_joints
   use first_pressures, only: find_first_pressures
   use displacement_systems, only: couple_node_systems, find_node_systems
   use drilling_supports, only: free_drilling
   use edge_halves, only: join_halves
   use element_build, only: marked_side
   use element_unknowns, only: make_table
   use free_structure, only: check_balance, hold_free_structure
   use idle_components, only: hold_idle
   use inertia_relief, only: relieve
   use joint_build, only: build_joints
   use joint_gaps, only: build_gaps
   use joint_sides, only: find_frame
   use load_build, only: build_loads
   use mass_build, only: build_masses, check_mass, check_masses
   use matrix_build, only: build_matrices
   use mesh_build, only: build_mesh, check_named_nodes
   use mesh_queries, only: start_freedoms, start_mesh
   use mesh_watch, only: crack_words, repeated_words
   use model_data, only: freedoms_type, history_type, joints_type, mesh_type, model_type, n_sections
   use pretension_section, only: build_sections
   use rigid_elements, only: build_dependents, name_surface_nodes
   use rod_torsion, only: add_torsion
   use shell_build, only: bow_edges, build_shells
   use shell_faces, only: build_shell_faces, couple_shell_faces
   use shell_ties, only: find_ties, tie_type
   use spring_build, only: build_bars, build_springs
   use stage_build, only: find_shown_nodes, plan_stages
   use stage_plan, only: stage_plan_type
   use structural_build, only: build_beams, build_rotations, leave_out_idle
   use superelement_build, only: find_retained, retained_type
   use support_build, only: build_supports
   use surface_build, only: build_surfaces
   use surface_parts, only: divide_shared_surfaces
   use surface_sides, only: split_shared_surfaces
   use temperature_build, only: build_temperatures
   use unit_watch, only: watch_units
   use vibration_build, only: plan_vibrations
   use wave_build, only: planned_wave
   implicit none
   private

   public :: build_model

contains

   !> Build MODEL and the PLAN of its stages from DECK; inconsistencies are added to ERRORS, and then neither may be solved. Each part
   !! of the model is made by one routine from the parts before it. After mesh errors nothing else is built, because areas, projections
   !! and loads would rest on wrong numbers. Errors that do not depend on each other are found together.
   subroutine build_model(deck, model, plan, errors)
      type(deck_type), intent(in), target          :: deck
      type(model_type), intent(out)                :: model
      type(stage_plan_type), intent(out)           :: plan
      type(deck_error_list), intent(inout), target :: errors
      type(checked_deck) :: checked
      type(tie_type), allocatable :: ties(:)
      type(planned_wave), allocatable :: waves(:)
      type(retained_type) :: retained
      logical :: is_whole

      allocate (model%warnings(0))
      if (.not. deck%is_whole) return
      call checked%start(deck, errors)
      call checked%check_ids()
      call plan_stages(deck, plan, errors)
      call make_mesh(checked, model%mesh, ties, is_whole)
      if (.not. is_whole) return
      ! each part is declared in the block in which it is made, so that calls in another order do not compile
      associate (mesh => model%mesh)
         block
            type(joints_type) :: joints
            call make_joints(checked, mesh, joints)
            block
               type(freedoms_type), allocatable :: sets(:)
               type(history_type) :: history
               call make_stages(checked, plan, mesh, joints, ties, sets, history, waves)
               call find_shown_nodes(checked, mesh, sets(1), plan)
               if (any(plan%stages%output%dmig)) call find_retained(checked, mesh, sets(1), retained)
               call plan_vibrations(checked, mesh, joints%list%id, sets, waves, plan)
               if (.not. (any(sets(1)%used) .or. errors%any())) &
                  call errors%add(0, 'nothing to solve: expected body elements or interface elements')
               if (errors%any()) return
               if (deck%bulk%parameters%relief_line > 0) then
                  model%freedoms = sets(1)
                  call relieve(checked, model, plan, joints, sets, history)
                  if (errors%any()) return
               end if
               call find_start(checked, plan, mesh, history, joints, sets)
               call errors%warn(repeated_words(mesh))
               call errors%warn(crack_words(mesh, joints, sets(1)))
               if (all(is_held(sets))) &
                  call errors%warn('all components of all nodes are supported; nodes move only by D of SPC and by SPCD')
               call watch_units(deck, joints, errors)
               call take_parts(joints, sets, history, model)
               if (deck%bulk%parameters%holds_idle) call hold_idle_of_sets(waves, model, errors)
            end block
         end block
      end associate
      if (allocated(errors%warnings)) call move_alloc(errors%warnings, model%warnings)
   end subroutine build_model

   !> Whether no component is free under the supports of FREEDOMS.
   elemental logical function is_held(freedoms)
      type(freedoms_type), intent(in) :: freedoms

      is_held = .not. any(.not. freedoms%held .and. spread(freedoms%used, 1, size(freedoms%held, 1)))
   end function is_held

   !> Move the parts into MODEL; a copy of the joints would take time.
   subroutine take_parts(joints, sets, history, model)
      type(joints_type), intent(inout)  :: joints
      type(freedoms_type), allocatable, intent(inout) :: sets(:)
      type(history_type), intent(inout) :: history
      type(model_type), intent(inout)   :: model

      call move_alloc(joints%list, model%joints%list)
      call move_alloc(joints%element, model%joints%element)
      call move_alloc(history%stages, model%history%stages)
      model%freedoms = sets(1)
      if (size(sets) > 1) call move_alloc(sets, model%sets)
   end subroutine take_parts

   !> Hold the idle components of MODEL under the supports of each stage, and warn of them.
   subroutine hold_idle_of_sets(waves, model, errors)
      type(planned_wave), intent(in)       :: waves(:)
      type(model_type), intent(inout)      :: model
      type(deck_error_list), intent(inout) :: errors
      character(:), allocatable :: words, first
      integer :: k

      call hold_idle(waves, model, first)
      call errors%warn(first)
      if (.not. allocated(model%sets)) return
      model%sets(1) = model%freedoms
      do k = 2, size(model%sets)
         model%freedoms = model%sets(k)
         call hold_idle(waves, model, words)
         if (words /= first) call errors%warn(words)
         model%sets(k) = model%freedoms
      end do
      model%freedoms = model%sets(1)
   end subroutine hold_idle_of_sets

   !> Make the MESH: points with duplicates at split surfaces, mid-side and face nodes, elements and their laws, surfaces, bars and springs,
   !! masses, and the nodes of rotations and of pretension sections. TIES belong to the constraint equations. IS_WHOLE is false where an
   !! error of the mesh makes the rest pointless.
   subroutine make_mesh(deck, mesh, ties, is_whole)
      type(checked_deck), intent(inout) :: deck
      type(mesh_type), intent(out)      :: mesh
      type(tie_type), allocatable, intent(out) :: ties(:)
      logical, intent(out)              :: is_whole
      type(marked_side), allocatable :: sides(:)
      type(bush_type), allocatable :: bushes(:)
      integer :: k

      call start_mesh(mesh)
      call build_mesh(deck, mesh, sides)
      call check_named_nodes(deck, mesh)
      is_whole = .not. deck%mesh_is_faulty()
      if (.not. is_whole) return
      call build_shells(deck, mesh)
      call join_halves(mesh, sides)
      call build_surfaces(deck, sides, mesh)
      is_whole = .not. deck%mesh_is_faulty()
      if (.not. is_whole) return
      call name_surface_nodes(deck, mesh)
      ! data on the mesh: each kind is built even if another one has errors
      call split_shared_surfaces(deck, mesh)
      call bow_edges(mesh)
      call find_ties(deck, mesh, ties)
      call find_bushes(deck, mesh, bushes)
      call build_shell_faces(deck, mesh, bushes)
      if (.not. deck%errors%any()) call divide_shared_surfaces(deck, mesh)
      call build_bars(deck, mesh)
      call build_rotations(deck, bushes, mesh)
      call build_sections(deck, mesh)
      call find_node_systems(deck, mesh)
      call build_beams(deck, mesh)
      call build_springs(deck, bushes, mesh)
      call add_torsion(mesh)
      call build_masses(deck, bushes, mesh)
      call build_matrices(deck, mesh)
      mesh%bars%column = size(mesh%structural%shells) + size(mesh%structural%beams) + [(k, k = 1, size(mesh%bars))]
   end subroutine make_mesh

   !> Make the JOINTS and their interface elements, with their gaps.
   subroutine make_joints(deck, mesh, joints)
      type(checked_deck), intent(in) :: deck
      type(mesh_type), intent(in)    :: mesh
      type(joints_type), intent(out) :: joints

      call build_joints(deck, mesh, joints)
      call build_gaps(deck, mesh, joints)
   end subroutine make_joints

   !> Make the SETS of freedoms, one for the stages with the same SPC and MPC, and with them the HISTORY. After an error in the first
   !! the others are not made.
   subroutine make_stages(deck, plan, mesh, joints, ties, sets, history, waves)
      type(checked_deck), intent(inout) :: deck
      type(stage_plan_type), intent(in) :: plan
      type(mesh_type), intent(in)       :: mesh
      type(joints_type), intent(in)     :: joints
      type(tie_type), intent(in)        :: ties(:)
      type(freedoms_type), allocatable, intent(out)   :: sets(:)
      type(history_type), intent(out)                 :: history
      type(planned_wave), allocatable, intent(out)    :: waves(:)
      type(expansion_type), allocatable  :: expansions(:)
      type(history_type) :: other
      type(planned_wave), allocatable :: other_waves(:)
      integer :: k, s

      allocate (sets(size(plan%first_with)))
      deck%keeps_distances = .not. plan%is_independent .and. &
                             any(deck%control%stages%equations%id /= deck%control%stages(1)%equations%id)
      do k = 1, size(sets)
         deck%stage = plan%first_with(k)
         if (k > 1 .and. deck%errors%any()) then
            sets(k) = sets(1)
            cycle
         end if
         call make_freedoms(deck, mesh, joints, ties, sets(k), expansions)
         if (k == 1) then
            call make_history(deck, plan, mesh, sets(k), expansions, history, waves)
            cycle
         end if
         call make_history(deck, plan, mesh, sets(k), expansions, other, other_waves)
         do s = 1, size(plan%stages)
            if (plan%stages(s)%supports /= k) cycle
            history%stages(s) = other%stages(s)
         end do
         do s = 1, size(waves)
            if (plan%stages(waves(s)%stage)%supports == k) waves(s) = other_waves(s)
         end do
      end do
      if (.not. deck%errors%any()) call sum_cases(plan, history)
   end subroutine make_stages

   !> Make the FREEDOMS: supports, displacement systems, constraint equations and rigid elements, and the table of unknowns. EXPANSIONS are
   !! those of the rigid elements when warm.
   subroutine make_freedoms(deck, mesh, joints, ties, freedoms, expansions)
      type(checked_deck), intent(inout) :: deck
      type(mesh_type), intent(in)       :: mesh
      type(joints_type), intent(in)     :: joints
      type(tie_type), intent(in)        :: ties(:)
      type(freedoms_type), intent(out)  :: freedoms
      type(expansion_type), allocatable, intent(out) :: expansions(:)

      call start_freedoms(freedoms)
      call build_supports(deck, mesh, joints, freedoms)
      call free_drilling(deck, mesh, freedoms)
      call hold_free_structure(deck, mesh, joints, freedoms)
      call couple_node_systems(deck, mesh, freedoms)
      call build_dependents(deck, ties, joints%glue, mesh, freedoms, expansions)
      call leave_out_idle(mesh, freedoms)
      call check_masses(deck, mesh, freedoms)
      if (.not. deck%errors%any()) call couple_shell_faces(mesh, freedoms)
      if (.not. deck%errors%any()) call make_table(mesh, freedoms)
   end subroutine make_freedoms

   !> Make the load HISTORY, and the loads that oscillate.
   subroutine make_history(deck, plan, mesh, freedoms, expansions, history, waves)
      type(checked_deck), intent(in)     :: deck
      type(stage_plan_type), intent(in)  :: plan
      type(mesh_type), intent(in)        :: mesh
      type(freedoms_type), intent(in)    :: freedoms
      type(expansion_type), intent(in)   :: expansions(:)
      type(history_type), intent(out)    :: history
      type(planned_wave), allocatable, intent(out) :: waves(:)

      call build_loads(deck, plan%stages%begins_at, mesh, freedoms, history, waves)
      if (.not. deck%errors%any()) call check_balance(deck, mesh, freedoms, history)
      call build_temperatures(deck, expansions, mesh, freedoms, history)
   end subroutine make_history

   !> Find what the whole model determines: the connected parts, the pressures of the first increment, the final frames of the joints.
   subroutine find_start(deck, plan, mesh, history, joints, sets)
      type(checked_deck), intent(in)     :: deck
      type(stage_plan_type), intent(in)  :: plan
      type(mesh_type), intent(in)        :: mesh
      type(history_type), intent(in)     :: history
      type(joints_type), intent(inout)   :: joints   !! p_av, whether statics determines them, frames
      type(freedoms_type), intent(inout) :: sets(:)  !! parts
      integer :: j, k

      associate (freedoms => sets(1))
         call find_parts(mesh, freedoms, .false.)          ! bolts that are being tightened do not connect parts yet
         call find_determinate_joints(mesh, joints, freedoms)
         call find_first_pressures(plan%stages(1)%fractions(1), deck%control%method /= method_step, mesh, joints, freedoms, &
                                   history, deck%errors)
         if (any(mesh%bars%bolt > 0) .or. n_sections(mesh) > 0) then
            call find_parts(mesh, freedoms, .true.)
            call find_determinate_joints(mesh, joints, freedoms)
         end if
         do j = 1, size(joints%list)            ! the normals are final now
            joints%list(j)%frame = find_frame(mesh, joints, joints%list(j))
         end do
         call check_mass(deck, mesh, freedoms)
      end associate
      do k = 2, size(sets)
         call find_parts(mesh, sets(k), .true.)
      end do
   end subroutine find_start

end module model_build
