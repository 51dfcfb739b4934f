!> The nodes that the tables of a stage are limited to, where OUTPUT names sets or marked surfaces.
module shown_nodes
   use case_sets, only: find_set, numbers_in_set
   use deck_errors, only: deck_error_list
   use deck_input, only: deck_type
   use model_data, only: model_type
   use stage_plan, only: stage_plan_type
   use surface_sides, only: nodes_of
   use text_tools, only: integer_text
   implicit none
   private

   public :: find_shown_nodes

contains

   !> Fill SHOWN of the stages of PLAN that are limited.
   subroutine find_shown_nodes(deck, model, plan, errors)
      type(deck_type), intent(in)          :: deck
      type(model_type), intent(in)         :: model
      type(stage_plan_type), intent(inout) :: plan
      type(deck_error_list), intent(inout) :: errors
      logical, allocatable :: are_in(:)
      integer :: at, i, s

      allocate (are_in(model%n_nodes))
      do s = 1, size(plan%stages)
         associate (given => deck%control%stages(s), stage => plan%stages(s))
            if (.not. allocated(given%only)) cycle
            allocate (stage%shown(model%n_nodes), source=.false.)
            do i = 1, size(given%only)
               associate (only => given%only(i))
                  if (only%is_mark) then
                     at = findloc(model%surfaces%id, only%id, dim=1)
                     if (at > 0) stage%shown(nodes_of(model%surfaces(at))) = .true.
                  else
                     at = find_set(deck%control%sets, only%id)
                     if (at > 0) then
                        call numbers_in_set(deck%control%sets(at), model%node_id, are_in, errors)
                        stage%shown = stage%shown .or. are_in
                     end if
                  end if
                  if (at == 0) call errors%add(only%line, 'OUTPUT: there is no '//trim(merge('PMARK', 'SET  ', only%is_mark))// &
                                               ' '//integer_text(only%id))
                  stage%shown_words = stage%shown_words//trim(merge(', ONLY PMARK', ', ONLY SET  ', only%is_mark))//' '// &
                                      integer_text(only%id)
               end associate
            end do
         end associate
      end do
   end subroutine find_shown_nodes

end module shown_nodes
