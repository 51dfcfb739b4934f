!> The nodes that the tables of a stage are limited to, where OUTPUT names sets or marked surfaces; likewise those of RESPONSE.
module shown_nodes
   use case_sets, only: find_set, number_set, numbers_in_set
   use deck_errors, only: deck_error_list
   use deck_input, only: deck_type
   use model_data, only: model_type
   use node_limits, only: limit_type
   use stage_plan, only: stage_plan_type
   use surface_sides, only: nodes_of
   use text_tools, only: integer_text
   implicit none
   private

   public :: find_shown_nodes, find_limited_nodes

contains

   !> Fill SHOWN of the stages of PLAN that are limited.
   subroutine find_shown_nodes(deck, model, plan, errors)
      type(deck_type), intent(in)          :: deck
      type(model_type), intent(in)         :: model
      type(stage_plan_type), intent(inout) :: plan
      type(deck_error_list), intent(inout) :: errors
      integer :: i, s

      do s = 1, size(plan%stages)
         associate (given => deck%control%stages(s), stage => plan%stages(s))
            if (.not. allocated(given%only)) cycle
            call find_limited_nodes(deck%control%sets, model, 'OUTPUT', given%only, stage%shown, errors)
            do i = 1, size(given%only)
               associate (only => given%only(i))
                  stage%shown_words = stage%shown_words//trim(merge(', ONLY PMARK', ', ONLY SET  ', only%is_mark))//' '// &
                                      integer_text(only%id)
               end associate
            end do
         end associate
      end do
   end subroutine find_shown_nodes

   !> Which nodes of MODEL the entry KEY of case control names by its LIMITS. What is not there goes to ERRORS.
   subroutine find_limited_nodes(sets, model, key, limits, are_named, errors)
      type(number_set), allocatable, intent(in) :: sets(:) !! of case control; not allocated: none
      type(model_type), intent(in)         :: model
      character(*), intent(in)             :: key
      type(limit_type), intent(in)         :: limits(:)
      logical, allocatable, intent(out)    :: are_named(:) !! (n_nodes)
      type(deck_error_list), intent(inout) :: errors
      logical, allocatable :: are_in(:)
      integer :: at, i

      allocate (are_named(model%n_nodes), source=.false.)
      allocate (are_in(model%n_nodes))
      do i = 1, size(limits)
         associate (only => limits(i))
            if (only%is_mark) then
               at = findloc(model%surfaces%id, only%id, dim=1)
               if (at > 0) are_named(nodes_of(model%surfaces(at))) = .true.
            else
               at = find_set(sets, only%id)
               if (at > 0) then
                  call numbers_in_set(sets(at), model%node_id, are_in, errors)
                  are_named = are_named .or. are_in
               end if
            end if
            if (at == 0) call errors%add(only%line, key//': there is no '//trim(merge('PMARK', 'SET  ', only%is_mark))//' '// &
                                         integer_text(only%id))
         end associate
      end do
   end subroutine find_limited_nodes

end module shown_nodes
