!> The plan of the stages, from case control and JINCR cards, and the nodes to which their tables are limited.
!! OUTPUT may limit the tables of a stage to sets of nodes or marked surfaces; WATCH names nodes that are followed.
module stage_build
   use case_entries, only: limit_type, number_set, numbers_in_set
   use control_words, only: method_back, method_newton
   use deck_check, only: checked_deck
   use deck_errors, only: deck_error_list
   use deck_input, only: deck_type
   use kinds, only: wp
   use model_data, only: freedoms_type, mesh_type
   use stage_entries, only: pair_reference
   use stage_plan, only: node_pair, stage_plan_type
   use surface_sides, only: nodes_of
   use text_tools, only: integer_text, one_of
   use unknowns, only: node_axes
   implicit none
   private

   public :: plan_stages, find_shown_nodes, find_limited_nodes

contains

   !> Plan the stages. A stage without INCR has one increment; so has METHOD = BACK. Without joints, bolts, INCR and FROM the stages are
   !! independent cases.
   subroutine plan_stages(deck, plan, errors)
      type(deck_type), intent(in)          :: deck
      type(stage_plan_type), intent(out)   :: plan
      type(deck_error_list), intent(inout) :: errors
      integer :: i, s, k

      plan%measures_path = deck%control%method == method_newton
      associate (given => deck%control%stages, bulk => deck%bulk)
         plan%is_independent = size(given) > 1 .and. all(bulk%joint%is_glued) .and. size(bulk%cjoint) + size(bulk%bolt) == 0 .and. &
                               all(given%increments%id == 0 .and. given%from%id == 0)
      end associate
      plan%first_with = [1]
      allocate (plan%stages(size(deck%control%stages)))
      do s = 1, size(plan%stages)
         associate (stage => plan%stages(s), given => deck%control%stages(s))
            stage%id = given%id
            stage%from = given%from%id
            if (.not. plan%is_independent) stage%begins_at = s - 1
            if (stage%from > 0) stage%begins_at = findloc(deck%control%stages%id, stage%from, dim=1)
            ! gfortran 12 loses the copies of an associate name with a vector subscript
            stage%supports = findloc(deck%control%stages(plan%first_with)%supports%id == given%supports%id .and. &
                                     deck%control%stages(plan%first_with)%equations%id == given%equations%id, .true., dim=1)
            if (stage%supports == 0) plan%first_with = [plan%first_with, s]
            if (stage%supports == 0) stage%supports = size(plan%first_with)
            call plan_sum()
            stage%label = given%label
            stage%output = given%output
            stage%shown_words = ''
            stage%fractions = [1.0_wp]
            stage%follows_path = plan%measures_path .and. given%increments%id == 0
            if (given%increments%id == 0) cycle
            k = findloc(deck%bulk%jincr%id, given%increments%id, dim=1)
            if (k == 0) then
               call errors%add(given%increments%line, 'INCR: there is no JINCR '//integer_text(given%increments%id))
            else if (deck%control%method /= method_back) then
               stage%fractions = deck%bulk%jincr(k)%fractions
            end if
         end associate
      end do

   contains

      !> Plan the SUBCOM at position S: its SUBSEQ names the last SUBCASEs before it.
      subroutine plan_sum()
         associate (given => deck%control%stages(s), stage => plan%stages(s))
            if (given%combines == 0) return
            stage%factors = given%factors
            stage%parts = pack([(i, i = 1, s - 1)], deck%control%stages(:s - 1)%combines == 0)
            if (size(stage%parts) < size(stage%factors)) return ! reported already
            stage%parts = stage%parts(size(stage%parts) - size(stage%factors) + 1:)
            if (any(plan%stages(stage%parts)%supports /= stage%supports)) call errors%add(given%combines, &
               'SUBSEQ: the SUBCASEs have different SPC or MPC; expected a combination of cases with the same supports')
            if (.not. plan%is_independent) call errors%add(given%line, 'SUBCOM: the stages of a deck with joints, bolts, INCR '// &
               'or FROM are one history, which has no sum of cases; expected a SUBCASE with FROM and a LOAD that combines sets')
         end associate
      end subroutine plan_sum

   end subroutine plan_stages

   !> Set SHOWN of the limited stages of PLAN, and WATCHED of the stages with WATCH.
   subroutine find_shown_nodes(deck, mesh, freedoms, plan)
      type(checked_deck), intent(in)       :: deck
      type(mesh_type), intent(in) :: mesh
      type(freedoms_type), intent(in) :: freedoms
      type(stage_plan_type), intent(inout) :: plan
      logical, allocatable :: are_named(:)
      integer :: i, s

      do s = 1, size(plan%stages)
         associate (given => deck%control%stages(s), stage => plan%stages(s))
            if (allocated(given%watch)) then
               plan%has_watched_nodes = .true.
               call find_limited_nodes(deck, mesh, 'WATCH', given%watch, are_named)
               stage%watched = pack([(i, i = 1, mesh%n_nodes)], are_named .and. freedoms%used .and. mesh%node_id > 0)
               if (size(stage%watched) == 0) call deck%errors%add(given%watch(1)%line, 'WATCH: names no node of an element')
            end if
            if (allocated(given%pairs)) then
               plan%has_watched_nodes = .true.
               plan%has_pairs = plan%has_pairs .or. size(given%pairs) > 0
               if (.not. allocated(stage%watched)) allocate (stage%watched(0))
               allocate (stage%pairs(size(given%pairs)))
               do i = 1, size(given%pairs)
                  call find_pair(deck, mesh, freedoms, given%pairs(i), stage%pairs(i))
               end do
            end if
            if (.not. allocated(given%only)) cycle
            call find_limited_nodes(deck, mesh, 'OUTPUT', given%only, stage%shown)
            do i = 1, size(given%only)
               associate (only => given%only(i))
                  stage%shown_words = stage%shown_words//one_of(only%is_mark, ', ONLY PMARK', ', ONLY SET')//' '// &
                                      integer_text(only%id)
               end associate
            end do
         end associate
      end do
   end subroutine find_shown_nodes

   !> The PAIR of WATCH that is GIVEN. Errors: nodes of no element.
   subroutine find_pair(deck, mesh, freedoms, given, pair)
      type(checked_deck), intent(in)    :: deck
      type(mesh_type), intent(in)       :: mesh
      type(freedoms_type), intent(in)   :: freedoms
      type(pair_reference), intent(in)  :: given
      type(node_pair), intent(out)      :: pair
      integer :: at(2), k

      pair%ids = given%nodes
      do k = 1, 2
         at(k) = mesh%node_table%find(given%nodes(k)) ! also of NODEAT
         if (at(k) > 0) at(k) = merge(at(k), 0, freedoms%used(at(k)))
         if (at(k) == 0) call deck%errors%add(given%line, 'WATCH: node '//integer_text(given%nodes(k))// &
                                              ' is not a node of an element')
      end do
      if (any(at == 0)) return
      pair%first = at(1)
      pair%last = at(2)
      associate (line => mesh%x(:, at(2)) - mesh%x(:, at(1)))
         if (norm2(line) > 0.0_wp) pair%along(:, 1) = line/norm2(line)
      end associate
      pair%along(:, 2:1 + mesh%dimension) = reshape(node_axes(mesh, at(1)), [3, mesh%dimension])
   end subroutine find_pair

   !> The nodes of the model that entry KEY of case control names by its LIMITS. Errors: missing sets and surfaces.
   subroutine find_limited_nodes(deck, mesh, key, limits, are_named)
      type(checked_deck), intent(in)    :: deck
      type(mesh_type), intent(in) :: mesh
      character(*), intent(in)          :: key
      type(limit_type), intent(in)      :: limits(:)
      logical, allocatable, intent(out) :: are_named(:) !! (n_nodes)
      integer :: at, i

      allocate (are_named(mesh%n_nodes), source=.false.)
      do i = 1, size(limits)
         associate (only => limits(i))
            if (only%is_mark) then
               at = findloc(mesh%surfaces%id, only%id, dim=1)
               if (at > 0) are_named(nodes_of(mesh%surfaces(at))) = .true.
            else
               at = findloc(deck%control%sets%id, only%id, dim=1, back=.true.)
               if (at > 0) call add_set(deck%control%sets(at))
            end if
            if (at == 0) call deck%errors%add(only%line, key//': there is no '//one_of(only%is_mark, 'PMARK', 'SET')// &
                                              ' '//integer_text(only%id))
         end associate
      end do

   contains

      !> Add the nodes of SET: its numbers, those of NODEAT included, and the nodes of the marked surfaces that it names.
      subroutine add_set(set)
         type(number_set), intent(in) :: set
         integer, allocatable :: marks(:), numbers(:)
         logical, allocatable :: are_in(:)
         integer :: at, i

         allocate (numbers, source=[mesh%node_id, mesh%placed%id])
         allocate (are_in(size(numbers)))
         call numbers_in_set(set, numbers, are_in, marks, deck%errors)
         are_named = are_named .or. are_in(:mesh%n_nodes)
         do i = mesh%n_nodes + 1, size(numbers)
            if (are_in(i) .and. numbers(i) > 0) are_named(mesh%placed(i - mesh%n_nodes)%node) = .true.
         end do
         do i = 1, size(marks)
            at = findloc(mesh%surfaces%id, marks(i), dim=1)
            if (at > 0) are_named(nodes_of(mesh%surfaces(at))) = .true.
            if (at == 0) call deck%errors%add(set%line, 'SET '//integer_text(set%id)//': there is no PMARK '// &
                                              integer_text(marks(i)))
         end do
      end subroutine add_set

   end subroutine find_limited_nodes

end module stage_build
