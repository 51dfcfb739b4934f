!> Shear laws used outside the range that they were tested in (departure 6): noted once an interface element and stage.
module range_watch
   use analysis_state, only: analysis_type
   use kinds, only: wp
   use model_data, only: model_type
   use row_buffer, only: row_buffer_type
   use stage_plan, only: stage_plan_type, where_in_plan
   use text_tools, only: integer_text, real_text, upper
   implicit none
   private

   public :: watch_ranges

   type, public :: range_watch_type
      integer :: n_warnings = 0               !! in all
      type(row_buffer_type) :: rows           !! of the stage so far
      integer, allocatable, private :: stage(:) ! in which an element was last warned of
   end type range_watch_type

contains

   !> Note the elements that have left their range in the increment just completed.
   subroutine watch_ranges(model, plan, analysis, watch)
      type(model_type), intent(in)          :: model
      type(stage_plan_type), intent(in)     :: plan
      type(analysis_type), intent(in)       :: analysis
      type(range_watch_type), intent(inout) :: watch
      real(wp) :: p, d
      integer  :: i, k

      if (.not. allocated(watch%stage)) allocate (watch%stage(size(model%interface)), source=0)
      do i = 1, size(model%interface)
         if (watch%stage(i) == analysis%stage) cycle
         do k = 1, model%dimension - 1
            associate (law => model%joints(model%interface(i)%joint)%law%shear(k))
               p = analysis%states(i)%normal%pressure
               d = abs(analysis%states(i)%shear(k)%delta)
               if (.not. law%given .or. (p <= law%p_max .and. d <= law%d_max)) cycle
               watch%stage(i) = analysis%stage
               watch%n_warnings = watch%n_warnings + 1
               call watch%rows%add('  WARNING: NODE '//integer_text(model%node_id(model%interface(i)%nodes(1)))//', '// &
                  upper(where_in_plan(plan, analysis%stage, analysis%increment))//': OUTSIDE THE TESTED RANGE OF THE SHEAR '// &
                  'LAW, P = '//real_text(p)//', D = '//real_text(d))
               exit
            end associate
         end do
      end do
   end subroutine watch_ranges

end module range_watch
