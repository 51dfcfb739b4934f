!> Changes the supports and the constraint equations between two stages of a history.
!! A support or an equation that goes hands its force over: the force becomes a load at the start of the stage, which the increments
!! take away. A support that comes holds its component where it stands; an equation that comes holds the distance that it finds.
!! Displacements that cards prescribe count from there.
module support_change
   use analysis_state, only: analysis_type
   use bolt_locking, only: lock_again
   use equations, only: equation_system
   use kinds, only: wp
   use mesh_queries, only: node_kind
   use model_data, only: an_overlap, freedoms_type, mesh_type, model_type, supported
   use node_coupling, only: coupling_parts, displacements, forces_on_unknowns
   use unknowns, only: component_axes
   implicit none
   private

   public :: hand_over, hold_anew

contains

   !> Add the forces of the supports of MODEL that the freedoms NEXT do not have to the load of ANALYSIS, and, with OTHER EQUATIONS,
   !! those of the constraint equations. RELEASED: number of components.
   subroutine hand_over(model, next, other_equations, analysis, released)
      type(model_type), intent(in)       :: model
      type(freedoms_type), intent(in)    :: next
      logical, intent(in)                :: other_equations
      type(analysis_type), intent(inout) :: analysis
      integer, intent(out)               :: released
      real(wp), allocatable :: force(:, :), on_unknowns(:, :)
      logical  :: goes(model%mesh%dimension)
      integer  :: n

      associate (mesh => model%mesh, freedoms => model%freedoms, d => model%mesh%dimension)
         released = 0
         allocate (force, mold=analysis%all_unbalanced)
         force = 0.0_wp
         if (other_equations .and. size(freedoms%left_out) > 0) then ! of the equations: the forces on dependent components
            do n = 1, mesh%n_nodes
               if (.not. any(freedoms%left_out(:, n))) cycle
               force(:, n) = -matmul(component_axes(mesh, n), merge(matmul(analysis%all_unbalanced(:, n), &
                                     component_axes(mesh, n)), 0.0_wp, freedoms%left_out(:, n)))
            end do
            on_unknowns = forces_on_unknowns(model, force) ! and minus these on the others
            do n = 1, mesh%n_nodes
               force(:, n) = force(:, n) - matmul(component_axes(mesh, n), merge(0.0_wp, on_unknowns(:, n), &
                                                                                 freedoms%left_out(:, n)))
            end do
         end if
         on_unknowns = forces_on_unknowns(model, analysis%all_unbalanced)
         do n = 1, mesh%n_nodes
            if (node_kind(mesh, n) == an_overlap) cycle
            goes = supported(mesh, freedoms, n) .and. .not. supported(mesh, next, n)
            released = released + count(goes)
            if (any(goes)) force(:, n) = force(:, n) - matmul(component_axes(mesh, n), merge(on_unknowns(:, n), 0.0_wp, goes))
         end do
         analysis%now%load = analysis%now%load + force
         analysis%all_unbalanced = analysis%all_unbalanced + force
      end associate
   end subroutine hand_over

   !> Continue ANALYSIS with the freedoms and the equations SYSTEM of MODEL, after those BEFORE. HELD: number of components that are
   !! held anew.
   subroutine hold_anew(model, before, other_equations, system, analysis, held)
      type(model_type), intent(in)          :: model
      type(freedoms_type), intent(in)       :: before
      logical, intent(in)                   :: other_equations
      class(equation_system), intent(inout) :: system
      type(analysis_type), intent(inout)    :: analysis
      integer, intent(out)                  :: held
      real(wp), allocatable :: q(:, :), on_unknowns(:, :), u(:, :)
      logical  :: is(model%mesh%dimension), was(model%mesh%dimension)
      integer  :: n

      held = 0
      if (.not. allocated(analysis%stands)) allocate (analysis%stands, source=0.0_wp*analysis%all_u)
      associate (mesh => model%mesh, freedoms => model%freedoms, moved => analysis%now%moved, stands => analysis%stands)
         q = analysis%all_u
         do n = 1, mesh%n_nodes
            if (node_kind(mesh, n) == an_overlap) cycle
            q(:, n) = matmul(analysis%all_u(:, n), component_axes(mesh, n))
            is = supported(mesh, freedoms, n)
            was = supported(mesh, before, n)
            held = held + count(is .and. .not. was)
            where (is .and. .not. was) stands(:, n) = q(:, n)
            where (is .and. .not. was) moved(:, n) = q(:, n)
            where (.not. freedoms%held(:, n)) stands(:, n) = 0.0_wp
            where (.not. freedoms%held(:, n)) moved(:, n) = 0.0_wp
         end do
         if (other_equations .and. size(freedoms%left_out) > 0) then ! what the equations leave of the displacements
            u = displacements(model, merge(merge(0.0_wp, moved, freedoms%left_out), q, freedoms%held))
            do n = 1, mesh%n_nodes
               if (.not. any(freedoms%left_out(:, n)) .or. node_kind(mesh, n) == an_overlap) cycle
               associate (parts => coupling_parts(freedoms, n))
                  is = freedoms%left_out(:, n) .and. any(freedoms%coupling%node(parts(1):parts(2)) == n)
               end associate
               was = .false.
               if (size(before%left_out) > 0) was = before%left_out(:, n)
               u(:, n) = matmul(analysis%all_u(:, n) - u(:, n), component_axes(mesh, n))
               where (is) stands(:, n) = u(:, n) - merge(moved(:, n) - stands(:, n), 0.0_wp, was)
               where (is) moved(:, n) = u(:, n)
            end do
         end if
         q = merge(moved, q, freedoms%held)
      end associate
      call lock_again(model, analysis, system)
      call system%forget_past()
      associate (retained => system%retained)
         analysis%retained_index = system%retained_index
         analysis%held = system%held_now()
         analysis%u = q(:, retained)
         on_unknowns = forces_on_unknowns(model, analysis%all_unbalanced)
         analysis%unbalanced = on_unknowns(:, retained)
         analysis%du = 0.0_wp*analysis%u
      end associate
      analysis%body = analysis%du
      analysis%change = analysis%du
      analysis%move = analysis%du
      analysis%now%condensed_load = analysis%du
      analysis%after%condensed_load = analysis%du
   end subroutine hold_anew

end module support_change
