!> Bolts: the preload while a bolt is tightened, the locked bolt afterwards, and the tension.
!! A CROD in the stage that tightens it is its preload, a pair of forces that grows with the increments. From the end of that
!! stage on the CROD is an elastic bar, locked at its length at that time. In a solid bolt the preload is a force on the overlap
!! g at its pretension section. From the end of that stage on g is held. A later stage may tighten the bolt again: it is released,
!! a force again that grows from the tension at that time to the new preload, and locked at the end of that stage.
module bolt_locking
   use analysis_state, only: analysis_type
   use equations, only: add_bar, equation_system, lock_unknown
   use kinds, only: wp
   use model_data, only: bar_nodes, model_type, n_bars, n_sections
   use node_coupling, only: displacements_at
   use structural_elements, only: add_axial_force, bar_elongation, thermal_tension
   implicit none
   private

   public :: lock_bolts, tightens, release_bolts, lock_again, bar_tension, elongation_now, section_tension, overlap_now

contains

   !> Lock the bolts that the completed stage has tightened, if they are not yet locked. The inelastic part of the bar forces becomes
   !! a load, and the overlap of solid bolts a prescribed displacement. Bolts that stage NEXT tightens again have been released.
   !! IS_BESIDE: the equations are those of another analysis too, which has locked the bolts in them.
   subroutine lock_bolts(model, system, analysis, next, is_beside)
      type(model_type), intent(in)          :: model
      class(equation_system), intent(inout) :: system
      type(analysis_type), intent(inout)    :: analysis
      integer, intent(in), optional         :: next !! default: none
      logical, intent(in), optional         :: is_beside
      integer :: again, i
      logical :: locks

      locks = .true.
      if (present(is_beside)) locks = .not. is_beside
      again = 0
      if (present(next)) again = next
      do i = 1, n_bars(model%mesh)
         associate (bar => model%mesh%bars(i))
            if (analysis%is_elastic(i) .or. .not. bar%tightening%is_in(analysis%stage) .or. bar%tightening%is_in(again)) cycle
            analysis%is_elastic(i) = .true.
            associate (preload => bar%tightening%preload_in(analysis%stage))
               analysis%rest_tension(i) = preload - bar%stiffness*elongation_now(model, analysis, i)
               call add_axial_force(model, i, analysis%rest_tension(i) - preload, analysis%now%load)
            end associate
            ! the loads contain the thermal tension from now on
            analysis%rest_tension(i) = analysis%rest_tension(i) - thermal_tension(bar, analysis%now%temperature)
            if (locks) call add_bar(model, i, system)
         end associate
      end do
      do i = 1, n_sections(model%mesh)
         associate (section => model%mesh%sections(i))
            if (analysis%is_locked(i) .or. .not. section%tightening%is_in(analysis%stage) .or. &
                section%tightening%is_in(again)) cycle
            analysis%is_locked(i) = .true.
            analysis%held(1, analysis%retained_index(section%node)) = .true.
            analysis%now%load(1, section%node) = analysis%now%load(1, section%node) - &
                                                section%tightening%preload_in(analysis%stage)
            analysis%now%moved(1, section%node) = overlap_now(model, analysis, i)
            if (locks) call lock_unknown(section%node, 1, system)
         end associate
      end do
   end subroutine lock_bolts

   !> Whether STAGE tightens any bolt.
   pure logical function tightens(model, stage)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: stage
      integer :: i

      tightens = any([(model%mesh%bars(i)%tightening%is_in(stage), i = 1, n_bars(model%mesh)), &
                      (model%mesh%sections(i)%tightening%is_in(stage), i = 1, n_sections(model%mesh))])
   end function tightens

   !> Release the locked bolts that stage NEXT tightens again: their tension becomes a force. They are still in the equations.
   subroutine release_bolts(model, next, analysis)
      type(model_type), intent(in)       :: model
      integer, intent(in)                :: next
      type(analysis_type), intent(inout) :: analysis
      integer :: i

      do i = 1, n_bars(model%mesh)
         associate (bar => model%mesh%bars(i), tension => bar_tension(model, analysis, i))
            if (.not. analysis%is_elastic(i) .or. .not. bar%tightening%is_in(next)) cycle
            analysis%start_tension(i) = tension
            ! the loads contain the tension of the locked bolt at the lengths at rest
            call add_axial_force(model, i, bar%stiffness*elongation_now(model, analysis, i), analysis%now%load)
            analysis%is_elastic(i) = .false.
         end associate
      end do
      do i = 1, n_sections(model%mesh)
         associate (section => model%mesh%sections(i), start => analysis%start_tension(n_bars(model%mesh) + i))
            if (.not. analysis%is_locked(i) .or. .not. section%tightening%is_in(next)) cycle
            start = section_tension(model, analysis, i)
            analysis%now%load(1, section%node) = analysis%now%load(1, section%node) + start
            analysis%unbalanced(1, analysis%retained_index(section%node)) = 0.0_wp
            analysis%now%moved(1, section%node) = 0.0_wp
            analysis%held(1, analysis%retained_index(section%node)) = .false.
            analysis%is_locked(i) = .false.
         end associate
      end do
   end subroutine release_bolts

   !> Lock the bolts of an analysis from a restart file in the equations, in the original order, so that every digit is the same.
   subroutine lock_again(model, analysis, system)
      type(model_type), intent(in)          :: model
      type(analysis_type), intent(in)       :: analysis
      class(equation_system), intent(inout) :: system
      integer :: i, stage

      do stage = 1, analysis%stage
         do i = 1, n_bars(model%mesh)
            if (model%mesh%bars(i)%bolt == 0 .or. model%mesh%bars(i)%tightening%last_until(analysis%stage) /= stage) cycle
            if (analysis%is_elastic(i)) call add_bar(model, i, system)
         end do
         do i = 1, n_sections(model%mesh)
            if (model%mesh%sections(i)%tightening%last_until(analysis%stage) /= stage) cycle
            if (analysis%is_locked(i)) call lock_unknown(model%mesh%sections(i)%node, 1, system)
         end do
      end do
   end subroutine lock_again

   !> Present elongation of bar I [length].
   pure real(wp) function elongation_now(model, analysis, i) result(elongation)
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      integer, intent(in)             :: i

      elongation = bar_elongation(model%mesh%bars(i), displacements_at(model, bar_nodes(model%mesh%bars(i)), &
         analysis%retained_index, analysis%u))
   end function elongation_now

   !> Present overlap g at the pretension section of solid bolt I [length].
   pure real(wp) function overlap_now(model, analysis, i) result(overlap)
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      integer, intent(in)             :: i

      overlap = analysis%u(1, analysis%retained_index(model%mesh%sections(i)%node))
   end function overlap_now

   !> Present tension of bar I [force].
   pure real(wp) function bar_tension(model, analysis, i) result(tension)
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      integer, intent(in)             :: i

      tension = 0.0_wp
      associate (bar => model%mesh%bars(i))
         if (analysis%is_elastic(i)) then
            tension = analysis%rest_tension(i) + bar%stiffness*elongation_now(model, analysis, i) + &
                      thermal_tension(bar, analysis%now%temperature)
         else if (bar%tightening%is_in(analysis%stage)) then
            tension = tension_between(analysis, i, bar%tightening%preload_in(analysis%stage))
         end if
      end associate
   end function bar_tension

   !> Present tension of solid bolt I: the force in its bodies that does work on its overlap, less the part of the loads [force].
   pure real(wp) function section_tension(model, analysis, i) result(tension)
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      integer, intent(in)             :: i

      associate (section => model%mesh%sections(i))
         tension = -analysis%unbalanced(1, analysis%retained_index(section%node))
         if (section%tightening%is_in(analysis%stage)) tension = tension + tension_between(analysis, n_bars(model%mesh) + i, &
            section%tightening%preload_in(analysis%stage))
      end associate
   end function section_tension

   !> The tension of bolt I, bars first, while it is tightened from its tension at the start of the stage to PRELOAD [force].
   pure real(wp) function tension_between(analysis, i, preload) result(tension)
      type(analysis_type), intent(in) :: analysis
      integer, intent(in)             :: i
      real(wp), intent(in)            :: preload

      tension = analysis%start_tension(i) + analysis%fraction*(preload - analysis%start_tension(i))
   end function tension_between

end module bolt_locking
