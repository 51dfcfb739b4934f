!> Bolts. A CROD in the stage that tightens it is its preload, a pair of forces that grows with the increments; from the end of
!! that stage on it is an elastic bar, locked at the length that it then has. In a solid bolt the preload is a force on the
!! overlap g at its section; from the end of that stage on g is held as it then is.
module bolt_locking
   use analysis_state, only: analysis_type
   use bar_elements, only: add_pull, bar_elongation
   use equations, only: add_bar, equation_system, lock_unknown
   use kinds, only: wp
   use model_data, only: model_type, n_bars, n_sections
   implicit none
   private

   public :: lock_bolts, bar_tension, section_tension

contains

   !> Lock the bolts that the stage before STAGE has tightened: the part of the force of bars that is not elastic becomes a load,
   !! and the overlap of solids a displacement that is prescribed as it is.
   subroutine lock_bolts(stage, model, system, analysis)
      integer, intent(in)                  :: stage
      type(model_type), intent(inout)      :: model
      type(equation_system), intent(inout) :: system
      type(analysis_type), intent(inout)   :: analysis
      integer :: i

      do i = 1, n_bars(model)
         associate (bar => model%bars(i))
            if (bar%bolt == 0 .or. bar%stage /= stage - 1) cycle
            bar%is_elastic = .true.
            analysis%pull(i) = bar%preload - bar%stiffness*bar_elongation(model, analysis%u, i)
            call add_pull(model, i, analysis%pull(i) - bar%preload, analysis%applied)
            call add_bar(model, i, system)
         end associate
      end do
      do i = 1, n_sections(model)
         associate (section => model%sections(i))
            if (section%stage /= stage - 1) cycle
            section%is_locked = .true.
            model%held(1, section%node) = .true.
            analysis%applied(1, section%node) = analysis%applied(1, section%node) - section%preload
            analysis%moved(1, section%node) = analysis%u(1, section%node)
            call lock_unknown(section%node, 1, system)
         end associate
      end do
   end subroutine lock_bolts


   !> Tension of bar I now [force].
   pure real(wp) function bar_tension(model, analysis, i) result(tension)
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      integer, intent(in)             :: i

      tension = 0.0_wp
      associate (bar => model%bars(i))
         if (bar%is_elastic) then
            tension = analysis%pull(i) + bar%stiffness*bar_elongation(model, analysis%u, i)
         else if (bar%stage == analysis%stage) then
            tension = analysis%fraction*bar%preload
         end if
      end associate
   end function bar_tension


   !> Tension of solid bolt I now: the force in its bodies that does work on its overlap, less the share of the loads [force].
   pure real(wp) function section_tension(model, analysis, i) result(tension)
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      integer, intent(in)             :: i

      associate (section => model%sections(i))
         tension = -analysis%unbalanced(1, section%node)
         if (section%stage == analysis%stage) tension = tension + analysis%fraction*section%preload
      end associate
   end function section_tension

end module bolt_locking
