!> From a deck to the structure that is solved.
module model_build
   use bar_build, only: build_bars
   use case_control, only: method_step
   use connected_parts, only: find_parts
   use deck_check, only: checked_deck
   use deck_errors, only: deck_error_list
   use deck_input, only: deck_type
   use determinate_joints, only: find_determinate_joints
   use first_pressures, only: find_first_pressures
   use gap_build, only: build_gaps
   use frame_build, only: build_frames
   use joint_build, only: build_joints
   use joint_split, only: split_shared_surfaces
   use load_build, only: build_loads
   use mass_build, only: build_masses, check_mass
   use mesh_build, only: build_mesh, marked_sides
   use model_data, only: model_type, n_sections, stage_load_type
   use named_nodes, only: check_named_nodes
   use rigid_build, only: build_dependents
   use rotation_build, only: build_rotations
   use section_build, only: build_sections
   use shown_nodes, only: find_shown_nodes
   use spring_build, only: build_springs
   use stage_plan, only: plan_stages, stage_plan_type
   use support_build, only: build_supports
   use surface_build, only: build_surfaces
   use temperature_build, only: build_temperatures
   use vibration_build, only: plan_vibrations
   implicit none
   private

   public :: build_model

contains

   !> Build MODEL and the PLAN of its stages from DECK; what does not fit together goes to ERRORS, and then neither
   !! is fit to be solved. Of a faulty mesh nothing further is made: areas, fits and loads of it would be of numbers that nobody
   !! gave. Errors that do not depend on each other are found together.
   subroutine build_model(deck, model, plan, errors)
      type(deck_type), intent(in), target          :: deck
      type(model_type), intent(out)                :: model
      type(stage_plan_type), intent(out)           :: plan
      type(deck_error_list), intent(inout), target :: errors
      type(checked_deck) :: checked
      type(marked_sides) :: sides
      type(stage_load_type), allocatable :: oscillating(:)

      if (.not. deck%is_whole) return
      call checked%start(deck, errors)
      ! what the cards say of each other, the load history, the mesh
      call checked%check_ids()
      call plan_stages(deck, plan, errors)
      call build_mesh(checked, model, sides)
      call check_named_nodes(checked, model)
      if (checked%mesh_is_faulty()) return
      call build_surfaces(checked, sides, model)
      if (checked%mesh_is_faulty()) return
      ! what stands on the mesh: each is put together whatever is wrong with the others
      call split_shared_surfaces(checked, model)
      call build_joints(checked, model)
      call build_gaps(checked, model)
      call build_bars(checked, model)
      call build_rotations(checked, model)
      call build_supports(checked, model)
      call build_sections(checked, model)
      call build_frames(checked, model)
      call build_springs(checked, model)
      call build_dependents(checked, model)
      call build_masses(checked, model)
      call build_loads(checked, model, oscillating)
      call build_temperatures(checked, model)
      call find_shown_nodes(deck, model, plan, errors)
      call plan_vibrations(checked, model, oscillating, plan)
      if (.not. any(model%used)) call errors%add(0, 'nothing to solve: expected body elements or interface elements')
      if (errors%any()) return
      ! what all of it together does
      call find_parts(model, .false.)          ! bolts that are being tightened connect nothing yet
      call find_determinate_joints(model)
      call find_first_pressures(plan%stages(1)%shares(1), deck%control%method /= method_step, model, errors)
      if (any(model%bars%bolt > 0) .or. n_sections(model) > 0) then
         call find_parts(model, .true.)
         call find_determinate_joints(model)
      end if
      call check_mass(checked, model)
   end subroutine build_model

end module model_build
