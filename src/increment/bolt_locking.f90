!> Bolts: in the stage that tightens a bolt it is its preload, a pair of forces that grows with the increments; from the end of
!! that stage on it is an elastic bar, locked at the length that it then has.
module bolt_locking
   use analysis_state, only: analysis_type
   use bar_elements, only: add_pull, bar_elongation
   use equations, only: add_bar, equation_system
   use kinds, only: wp
   use model_data, only: model_type, n_bars
   implicit none
   private

   public :: lock_bolts, bar_tension

contains

   !> Lock the bolts that the stage before STAGE has tightened: the part of their force that is not elastic becomes a load.
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

end module bolt_locking
