!> From a deck to the model that is solved: the sequence of all build steps.
module model_build
   use case_control, only: method_step
   use connected_bodies, only: find_parts
   use constraint_equations, only: expansion_type
   use deck_check, only: checked_deck
   use deck_errors, only: deck_error_list
   use deck_input, only: deck_type
   use determinate_joints, only: find_determinate_joints, find_first_pressures
   use displacement_systems, only: build_frames
   use element_build, only: marked_side
   use free_structure, only: check_balance, hold_free_structure
   use joint_build, only: build_joints
   use joint_gaps, only: build_gaps
   use joint_sides, only: find_frame
   use load_build, only: build_loads
   use mass_build, only: build_masses, check_mass
   use mesh_build, only: build_mesh, check_named_nodes
   use mesh_watch, only: crack_words, repeated_words
   use model_data, only: model_type, n_sections, stage_load_type
   use pretension_section, only: build_sections
   use rigid_elements, only: build_dependents, name_surface_nodes
   use rod_torsion, only: add_torsion
   use shell_faces, only: build_shell_faces, couple_shell_faces
   use shell_ties, only: find_ties, tie_type
   use spring_build, only: build_bars, build_springs
   use stage_plan, only: plan_stages, stage_plan_type
   use structural_build, only: bow_edges, build_beams, build_rotations, build_shells, leave_out_idle
   use support_build, only: build_supports
   use surface_build, only: build_surfaces
   use surface_sides, only: split_shared_surfaces
   use temperature_build, only: build_temperatures
   use text_tools, only: append
   use unit_watch, only: watch_units
   use vibration_build, only: find_shown_nodes, plan_vibrations
   implicit none
   private

   public :: build_model

contains

   !> Build MODEL and the PLAN of its stages from DECK; inconsistencies are added to ERRORS, and then neither may be solved. After
   !! mesh errors nothing else is built, because areas, projections and loads would rest on wrong numbers. Errors that do not depend
   !! on each other are found together.
   subroutine build_model(deck, model, plan, errors)
      type(deck_type), intent(in), target          :: deck
      type(model_type), intent(out)                :: model
      type(stage_plan_type), intent(out)           :: plan
      type(deck_error_list), intent(inout), target :: errors
      type(checked_deck) :: checked
      type(marked_side), allocatable :: sides(:)
      type(tie_type), allocatable :: ties(:)
      type(expansion_type), allocatable :: expansions(:)
      type(stage_load_type), allocatable :: oscillating(:)
      integer :: j

      allocate (model%warnings(0))
      if (.not. deck%is_whole) return
      call checked%start(deck, errors)
      ! consistency of the cards, load history, mesh
      call checked%check_ids()
      call plan_stages(deck, plan, errors)
      call build_mesh(checked, model, sides)
      call check_named_nodes(checked, model)
      if (checked%mesh_is_faulty()) return
      call build_shells(checked, model)
      call build_surfaces(checked, sides, model)
      if (checked%mesh_is_faulty()) return
      call name_surface_nodes(checked, model)
      ! data on the mesh: each kind is built even if another one has errors
      call split_shared_surfaces(checked, model)
      call bow_edges(model)
      call find_ties(checked, model, ties)
      call build_shell_faces(checked, model)
      call build_joints(checked, model)
      call build_gaps(checked, model)
      call build_bars(checked, model)
      call build_rotations(checked, model)
      call build_supports(checked, model)
      call hold_free_structure(checked, model)
      call build_sections(checked, model)
      call build_frames(checked, model)
      call build_beams(checked, model)
      call build_springs(checked, model)
      call add_torsion(model)
      call build_dependents(checked, ties, model, expansions)
      call leave_out_idle(model)
      call build_masses(checked, model)
      if (.not. errors%any()) call couple_shell_faces(model)
      call build_loads(checked, model, oscillating)
      if (.not. errors%any()) call check_balance(checked, model)
      call build_temperatures(checked, expansions, model)
      call find_shown_nodes(checked, model, plan)
      call plan_vibrations(checked, model, oscillating, plan)
      if (.not. any(model%freedoms%used)) call errors%add(0, 'nothing to solve: expected body elements or interface elements')
      if (errors%any()) return
      ! checks and results that need the whole model
      call find_parts(model, .false.)          ! bolts that are being tightened do not connect parts yet
      call find_determinate_joints(model)
      call find_first_pressures(plan%stages(1)%fractions(1), deck%control%method /= method_step, model, errors)
      if (any(model%mesh%bars%bolt > 0) .or. n_sections(model) > 0) then
         call find_parts(model, .true.)
         call find_determinate_joints(model)
      end if
      do j = 1, size(model%joints%list)            ! the normals are final now
         model%joints%list(j)%frame = find_frame(model, model%joints%list(j))
      end do
      call check_mass(checked, model)
      call errors%warn(repeated_words(model))
      call errors%warn(crack_words(model))
      call watch_units(deck, model)
   end subroutine build_model

end module model_build
