!> The cases of a deck with FROM in one table, a row a case, with the worst of each column and its stage.
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
   use tolerances, only: symmetric_tie
   use watched_nodes, only: summarise_watched, watch_answer, watched_node
   implicit none
   private

   public :: is_case, note_case, note_frequency, write_cases, print_cases, record_cases

   integer, parameter :: n_values = size(case_names)
   logical, parameter :: least_is_worst(n_values) = [.false., .false., .false., .true., .true., .true., .false., .false., .true., &
                                                     .true.] ! of case_names

   !> The values at the end of a case.
   type :: case_row
      integer  :: stage = 0                      !! its position
      logical  :: waits = .false.                !! for its natural modes
      real(wp) :: values(n_values) = 0.0_wp
      logical  :: has(n_values) = .false.
   end type case_row

   type, public :: case_list
      type(case_row), allocatable, private :: rows(:) ! not allocated: none
      integer, private :: n_written = 0          ! rows that are in their file
   end type case_list

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

   !> Add the stage just completed to CASES if it is one.
   pure subroutine note_case(model, plan, analysis, bodies, joints, bolts, watched, cases)
      type(model_type), intent(in)       :: model
      type(stage_plan_type), intent(in)  :: plan
      type(analysis_type), intent(in)    :: analysis
      type(body_values_type), intent(in) :: bodies
      type(joint_answer), intent(in)     :: joints(:)
      type(bolt_answer_type), intent(in) :: bolts(:)
      type(watch_answer), intent(in)     :: watched
      type(case_list), intent(inout)     :: cases
      type(watched_node) :: first
      logical :: safe(size(joints)), used(size(bolts))
      integer :: id

      if (.not. is_case(model%history, analysis%stage) .or. analysis%record%ends_early) return
      if (allocated(plan%stages(analysis%stage)%watched)) call summarise_watched(model, watched, id, first)
      if (.not. allocated(cases%rows)) allocate (cases%rows(0))
      safe = joints%has_safety .and. joints%safety <= largest_safety
      used = bolts%is_locked .and. bolts%has_strength
      cases%rows = [cases%rows, case_row(analysis%stage, allocated(plan%stages(analysis%stage)%vibration), &
         [bodies%displacement%value, bodies%at_node%value, maxval(joints%now%pressure), minval(joints%now%contact), &
          minval(joints%safety, mask=safe), minval(bolts%force, mask=bolts%is_locked), maxval(bolts%use, mask=used), &
          first%along, first%stiffness, 0.0_wp], &
         [.true., model%mesh%n_elements > 0, size(joints) > 0, size(joints) > 0, any(safe), any(bolts%is_locked), any(used), &
          first%is_loaded, first%moves, .false.])]
   end subroutine note_case

   !> Note the first natural FREQUENCY of the stage at the position STAGE, the last one completed; negative: it has none.
   pure subroutine note_frequency(stage, frequency, cases)
      integer, intent(in)            :: stage
      real(wp), intent(in)           :: frequency !! [1/time]
      type(case_list), intent(inout) :: cases

      if (.not. allocated(cases%rows)) return
      associate (row => cases%rows(size(cases%rows)))
         if (row%stage /= stage) return
         row%waits = .false.
         row%values(n_values) = frequency
         row%has(n_values) = frequency >= 0.0_wp
      end associate
   end subroutine note_frequency

   !> Write the CASES that are complete into their file, AT_END all of them.
   subroutine write_cases(page, model, plan, cases, at_end)
      type(page_type), intent(inout)    :: page
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      type(case_list), intent(inout)    :: cases
      logical, intent(in), optional     :: at_end
      type(table_type) :: table
      integer :: i

      if (.not. allocated(cases%rows)) return
      do i = cases%n_written + 1, size(cases%rows)
         if (cases%rows(i)%waits .and. .not. present(at_end)) return
         call table%start('', table_columns(cases_table, page%labels, model))
         call fill_row(model%history, plan, cases%rows(i), table)
         call table%print_row(csv_file=page%tables(cases_table))
         cases%n_written = i
      end do
   end subroutine write_cases

   !> Put the values of ROW into a row of TABLE.
   subroutine fill_row(history, plan, row, table)
      type(history_type), intent(in)    :: history
      type(stage_plan_type), intent(in) :: plan
      type(case_row), intent(in)        :: row
      type(table_type), intent(inout)   :: table

      associate (stage => plan%stages(row%stage))
         call table%put('kind', ' CASE')
         call table%put('stage', stage%id)
         call table%put('from', plan%stages(history%stages(row%stage)%from)%id)
         call table%put(case_names, row%values, where=row%has)
         call table%put('LABEL', '   '//stage%label)
      end associate
   end subroutine fill_row

   !> Print CASES to the screen and the listing, with the worst of each column and its stage, which end the file. Values equal to
   !! rounding are a tie, which the first of them wins.
   subroutine print_cases(page, model, plan, cases)
      type(page_type), intent(inout)    :: page
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      type(case_list), intent(inout)    :: cases
      type(table_type) :: table
      type(case_row), allocatable    :: rows(:)
      type(column_type), allocatable :: columns(:)
      real(wp) :: pair(2)
      integer  :: before, i, k, worst(n_values) ! positions of the cases, 0: no case has the value

      if (.not. allocated(cases%rows)) return
      call write_cases(page, model, plan, cases, at_end=.true.)
      rows = cases%rows
      worst = 0
      do i = 1, size(rows)
         do k = 1, n_values
            if (.not. rows(i)%has(k)) cycle
            if (worst(k) > 0) then
               pair = [rows(worst(k))%values(k), rows(i)%values(k)]
               if (case_names(k) /= 'bolt_min') pair = abs(pair) ! a bolt may be in compression
               if (merge(pair(1) - pair(2), pair(2) - pair(1), least_is_worst(k)) <= symmetric_tie*abs(pair(1))) cycle
            end if
            worst(k) = i
         end do
      end do
      columns = table_columns(cases_table, page%labels, model)
      do i = 1, size(columns)
         k = findloc(case_names, columns(i)%name, dim=1)
         if (k == 0) cycle
         if (worst(k) == 0) columns(i) = csv(columns(i)%name)
      end do
      before = page%screen%used
      call table%start('CASES: STAGES THAT START FROM ONE STATE, AND THE WORST OF EACH COLUMN', columns, page%screen)
      do i = 1, size(rows)
         call fill_row(model%history, plan, rows(i), table)
         call table%print_row(page%screen)
      end do
      call table%put('kind', ' WORST')
      do k = 1, n_values
         call table%put(case_names(k), rows(max(1, worst(k)))%values(k), where=worst(k) > 0)
      end do
      call table%leave_rest()
      call table%print_row(page%screen, page%tables(cases_table))
      call table%put('kind', ' STAGE')
      do k = 1, n_values
         call table%put(case_names(k), plan%stages(rows(max(1, worst(k)))%stage)%id, where=worst(k) > 0)
      end do
      call table%leave_rest()
      call table%print_row(page%screen, page%tables(cases_table))
      call page%file%put_lines(page%screen%text_behind(before))
   end subroutine print_cases

   !> Write CASES to a restart file, or read them.
   subroutine record_cases(stream, cases)
      type(restart_stream_type), intent(inout) :: stream
      type(case_list), intent(inout)           :: cases
      integer :: k, n

      call stream%part('case_list', 1)
      call stream%item('n_written', cases%n_written)
      n = -1
      if (allocated(cases%rows)) n = size(cases%rows)
      call stream%extent('rows', n, 8)
      if (n < 0) return
      if (.not. stream%writes) cases%rows = spread(case_row(), 1, n)
      call stream%item('stage', cases%rows%stage)
      call stream%item('waits', cases%rows%waits)
      do k = 1, n_values
         call stream%item('values', cases%rows%values(k))
         call stream%item('has', cases%rows%has(k))
      end do
   end subroutine record_cases

end module case_table
