!> The cases of a deck with FROM, or without a history, in one table, a row a case, with the worst of each column and its stage.
!! A case is a stage that starts from a state from which several stages start, or that follows such a stage.
module case_table
   use analysis_state, only: analysis_type
   use body_values, only: body_values_type
   use bolt_answers, only: bolt_answer_type
   use joint_answers, only: joint_answer
   use kinds, only: wp
   use model_data, only: history_type, model_type
   use restart_stream, only: restart_stream_type
   use result_page, only: case_names, cases_table, largest_safety, page_type, table_columns
   use stage_plan, only: stage_plan_type
   use table_column, only: column_type, csv
   use table_writer, only: table_type
   use text_tools, only: one_of
   use tolerances, only: symmetric_tie
   use watched_nodes, only: watch_answer, watched_node
   implicit none
   private

   public :: is_case, note_case, print_cases, record_cases

   integer, parameter :: n_values = size(case_names)
   real(wp), parameter :: none = huge(1.0_wp)
   logical, parameter :: least_is_worst(n_values) = [.false., .false., .false., .true., .true., .true., .false., .false., .true., &
                                                     .true.] ! of case_names

   !> The values at the end of a case, those of case_names; the last of them, its frequency, comes with the modes.
   type, public :: case_row
      integer  :: stage = 0                      !! its position
      real(wp) :: values(n_values) = none      !! NONE, of either sign: there is none
   end type case_row

contains

   !> Whether the stage at position S is a case.
   pure logical function is_case(history, s)
      type(history_type), intent(in) :: history
      integer, intent(in)            :: s
      integer :: at

      is_case = .false.
      at = s
      do while (at > 0 .and. .not. is_case)
         is_case = count(history%stages%from == history%stages(at)%from) > 1
         at = history%stages(at)%from
      end do
   end function is_case

   !> Add the stage just completed to ROWS if it is a case.
   pure subroutine note_case(model, plan, analysis, bodies, joints, bolts, watched, rows)
      type(model_type), intent(in)       :: model
      type(stage_plan_type), intent(in)  :: plan
      type(analysis_type), intent(in)    :: analysis
      type(body_values_type), intent(in) :: bodies
      type(joint_answer), intent(in)     :: joints(:)
      type(bolt_answer_type), intent(in) :: bolts(:)
      type(watch_answer), intent(in)     :: watched
      type(case_row), allocatable, intent(inout) :: rows(:)
      type(watched_node) :: first

      if (.not. is_case(model%history, analysis%stage) .or. analysis%record%ends_early) return
      if (allocated(plan%stages(analysis%stage)%watched)) first = first_watched(watched)
      rows = [rows, case_row(analysis%stage, &
         [bodies%displacement%value, merge(bodies%at_node%value, none, model%mesh%n_elements > 0), &
          maxval(joints%now%pressure), minval(joints%now%contact), & ! huge where there are none
          minval(joints%safety, mask=joints%has_safety .and. joints%safety <= largest_safety), &
          minval(bolts%force, mask=bolts%is_locked), maxval(bolts%use, mask=bolts%is_locked .and. bolts%has_strength), &
          merge(first%along, none, first%is_loaded), merge(first%stiffness, none, first%moves), none])]
   end subroutine note_case

   !> The first watched node of ANSWER or, without one, the first pair along the force between its nodes.
   pure type(watched_node) function first_watched(answer) result(watched)
      type(watch_answer), intent(in) :: answer
      real(wp) :: force

      if (size(answer%nodes) > 0) then
         watched = answer%nodes(1)
      else if (size(answer%pairs) > 0) then
         associate (load => answer%pairs(1)%load(2:), change => answer%pairs(1)%change(2:)) ! along three axes
            force = norm2(load)
            watched%is_loaded = force > 0.0_wp
            if (watched%is_loaded) watched%along = dot_product(change, load)/force
            watched%moves = any(abs(answer%pairs(1)%stiffness(2:)) > 0.0_wp) .and. abs(watched%along) > 0.0_wp
            if (watched%moves) watched%stiffness = force/watched%along
         end associate
      end if
   end function first_watched

   !> Print ROWS, then the worst of each column and its stage. Of values equal to rounding the first is the worst.
   subroutine print_cases(page, model, plan, rows)
      type(page_type), intent(inout)    :: page
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      type(case_row), intent(in)        :: rows(:)
      type(table_type) :: table
      type(column_type), allocatable :: columns(:)
      real(wp) :: badness(size(rows))
      logical  :: has(size(rows))
      integer  :: before, i, k, worst(n_values) ! positions in ROWS, 0: none has the value

      if (size(rows) == 0) return
      do k = 1, n_values
         badness = rows%values(k)
         if (case_names(k) /= 'bolt_min') badness = abs(badness) ! a bolt may be in compression
         if (least_is_worst(k)) badness = -badness
         has = abs(rows%values(k)) < none
         i = maxloc(badness, mask=has, dim=1)
         worst(k) = 0
         if (i > 0) worst(k) = findloc(has .and. badness >= badness(i) - symmetric_tie*abs(badness(i)), .true., dim=1)
      end do
      columns = table_columns(cases_table, page%labels, model)
      do i = 1, size(columns) ! the listing leaves out columns without a value
         if (any(case_names == columns(i)%name .and. worst == 0) .or. (columns(i)%name == 'from' .and. plan%is_independent)) &
            columns(i) = csv(columns(i)%name)
      end do
      before = page%screen%used
      call table%start('CASES: STAGES THAT START FROM '//one_of(plan%is_independent, 'REST', 'ONE STATE')// &
                       ', AND THE WORST OF EACH COLUMN', columns, page%screen)
      do i = 1, size(rows)
         associate (row => rows(i), stage => plan%stages(rows(i)%stage))
            call table%put('stage', stage%id)
            if (stage%begins_at > 0) call table%put('from', plan%stages(stage%begins_at)%id)
            if (stage%begins_at == 0) call table%put('from', 0)
            call table%put(case_names, row%values, where=abs(row%values) < none)
            call table%put('LABEL', '   '//stage%label)
         end associate
         call table%put('kind', ' CASE')
         call table%print_row(page%screen, page%tables(cases_table))
      end do
      do k = 1, n_values
         call table%put(case_names(k), rows(max(1, worst(k)))%values(k), where=worst(k) > 0)
      end do
      call table%put('kind', ' WORST')
      call table%leave_rest()
      call table%print_row(page%screen, page%tables(cases_table))
      do k = 1, n_values
         call table%put(case_names(k), plan%stages(rows(max(1, worst(k)))%stage)%id, where=worst(k) > 0)
      end do
      call table%put('kind', ' STAGE')
      call table%leave_rest()
      call table%print_row(page%screen, page%tables(cases_table))
      call page%file%put_lines(page%screen%text_behind(before))
   end subroutine print_cases

   !> Write ROWS to a restart file, or read them.
   subroutine record_cases(stream, rows)
      type(restart_stream_type), intent(inout)   :: stream
      type(case_row), allocatable, intent(inout) :: rows(:)
      integer :: k, n

      call stream%part('case_row', 1)
      n = size(rows)
      call stream%extent('rows', n, 8)
      if (.not. stream%writes) rows = spread(case_row(), 1, n)
      call stream%item('stage', rows%stage)
      do k = 1, n_values
         call stream%item('values', rows%values(k))
      end do
   end subroutine record_cases

end module case_table
