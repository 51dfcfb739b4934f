!> Which branch and which run each row of a test belongs to, found from the way that the test went.
module test_branches
   use data_columns, only: column_d, column_lambda, column_p, column_symbols, column_tau, data_cubics, data_normal, &
                           data_shear, fit_load, fit_reload, fit_unload
   use deck_errors, only: deck_error_list
   use fit_command, only: fit_command_type
   use fit_data, only: test_data_type
   use kinds, only: wp
   use pressure_groups, only: group_by_pressure
   use reading_offset, only: check_signs, take_off_offset
   use text_tools, only: integer_text, plural, real_text
   use turning_points, only: find_turns, scatter_of
   implicit none
   private

   public :: find_branches, follow

   real(wp), parameter :: least_band = 0.01_wp, most_band = 0.25_wp ! of noise, shares of the range
   real(wp), parameter :: far = 0.1_wp         ! share of the range that is away from the first reading
   integer, parameter  :: few = 3              ! rows in a run, on average, below which the order is hardly that of time

contains

   !> Give every row of DATA its branch and its run where the file does not say them: by turning points where the rows are a
   !! record in the order of time, by the direction of each run where the runs have numbers. First readings a little below zero
   !! are taken off the others; what is too far below zero for noise, or in no order, goes to ERRORS.
   subroutine find_branches(data, command, errors)
      type(test_data_type), intent(inout)  :: data
      type(fit_command_type), intent(in)   :: command
      type(deck_error_list), intent(inout) :: errors
      integer, allocatable  :: rows(:), test(:), starts(:)
      real(wp), allocatable :: u(:)
      integer  :: columns(2), i, runs, t
      real(wp) :: band, range(2), scatter
      logical  :: faulty

      if (data%kind == data_cubics .or. data%n == 0) return
      faulty = errors%any()
      columns = merge([column_d, column_tau], [column_lambda, column_p], data%kind == data_shear)
      data%in_order = .not. (data%has_branch .or. command%unordered)
      data%is_record = data%in_order .and. .not. data%has_run
      associate (x => data%value(columns(1), :data%n), y => data%value(columns(2), :data%n))
         range = [maxval(x) - minval(x), maxval(y) - minval(y)]
         where (range <= 0.0_wp) range = 1.0_wp
         scatter = 0.0_wp
         if (data%is_record) scatter = scatter_of(x, y)
      end associate
      band = min(most_band, max(least_band, 2.0_wp*scatter))
      if (command%noise > 0.0_wp) band = command%noise
      if (command%unordered .and. .not. data%has_branch) data%branch = fit_load
      if (data%has_branch .and. .not. data%has_run) call number_stretches(data, command%fit%p_tolerance)
      call separate_tests(data, command%fit%p_tolerance, columns, range, band, test)
      runs = 0
      do t = 1, maxval(test)
         rows = pack([(i, i = 1, data%n)], test == t)
         call take_off_offset(data, rows, columns, scatter*range, band*range, command%zero)
         if (.not. data%in_order) cycle
         u = data%value(columns(2), rows)/range(2)
         if (data%kind == data_shear) u = u + data%value(columns(1), rows)/range(1)
         if (data%is_record) then
            call find_turns(u, band*merge(sqrt(2.0_wp), 1.0_wp, data%kind == data_shear), starts)
            starts = [1, starts + 1]
         else
            starts = pack([(i, i = 1, size(rows))], [.true., data%run(rows(2:)) /= data%run(rows(:size(rows) - 1))])
         end if
         call take_branches(data, rows, u, starts)
         runs = runs + size(starts)
      end do
      call check_signs(data, band, band*range, errors)
      if (.not. faulty .and. data%is_record) call report_record(data, command%fit%p_tolerance, columns, band, &
         band*range, [runs, maxval(test)], errors)
   end subroutine find_branches

   !> The TEST that each row belongs to. A header begins one, another pressure of shear too, and so does a row that is back at
   !! the first reading when the one before it was not: there a specimen starts anew. Rows that name their branches may stand in
   !! any order, and runs with numbers come back to their pressure.
   subroutine separate_tests(data, p_tolerance, columns, range, band, test)
      type(test_data_type), intent(in)  :: data
      real(wp), intent(in)              :: p_tolerance, range(2), band
      integer, intent(in)               :: columns(2)
      integer, allocatable, intent(out) :: test(:)
      integer, allocatable  :: group(:)
      real(wp), allocatable :: group_p(:)
      integer :: first(data%n), last(data%n), i, k, n, t
      logical :: fresh

      allocate (group(data%n), source=1)
      if (data%kind == data_shear .and. .not. data%has_branch) &
         call group_by_pressure(data%value(column_p, :data%n), p_tolerance, group, group_p)
      allocate (test(data%n))
      n = 0
      do i = 1, data%n
         t = findloc([(data%part(first(k)) == data%part(i) .and. group(first(k)) == group(i), k = 1, n)], .true., 1, back=.true.)
         if (data%is_record .and. t < n) t = 0
         fresh = t == 0
         if (data%in_order .and. .not. fresh) fresh = away(last(t), first(t)) > far .and. away(i, first(t)) <= band
         if (fresh) then
            n = n + 1
            first(n) = i
            t = n
         end if
         last(t) = i
         test(i) = t
      end do

   contains

      !> How far row A lies from row B, as a share of the range.
      pure real(wp) function away(a, b)
         integer, intent(in) :: a, b

         away = maxval(abs(data%value(columns, a) - data%value(columns, b))/range)
      end function away

   end subroutine separate_tests

   !> The ROWS of one test, in order, take their branches from the way U that it went, straight from START to START; of shear
   !! what was loaded in the other sense is turned over.
   subroutine take_branches(data, rows, u, starts)
      type(test_data_type), intent(inout) :: data
      integer, intent(in)  :: rows(:), starts(:)
      real(wp), intent(in) :: u(:)
      integer :: branch(size(rows)), i, run, sense(size(rows))

      if (data%kind == data_shear) then
         call follow(data%value(column_d, rows), u, starts, .true., data%is_record, branch, sense)
         data%value(column_d, rows) = sense*data%value(column_d, rows)
         data%value(column_tau, rows) = sense*data%value(column_tau, rows)
      else
         call follow(data%value(column_p, rows), u, starts, .false., data%is_record, branch, sense)
      end if
      data%branch(rows) = branch
      if (.not. data%is_record) return
      data%joined(rows(2:)) = .true.
      run = maxval(data%run) + 1
      data%run(rows(1)) = run
      do i = 2, size(rows)
         if (branch(i) /= branch(i - 1) .or. any(starts == i)) run = run + 1
         data%run(rows(i)) = run
      end do
   end subroutine take_branches

   !> The branch of every point of a test that goes straight along U between the points START, as the law has it: it loads;
   !! turned back it unloads; turned again it reloads, up to the largest deflection of its loading, and loads again beyond. In
   !! a test that MIRRORS, unloading beyond the mirror of that deflection is loading in the other SENSE.
   pure subroutine follow(forward, u, starts, mirrors, joined, branch, sense)
      real(wp), intent(in) :: forward(:) !! d, or p of a normal test
      real(wp), intent(in) :: u(:)       !! grows where the test loads
      integer, intent(in)  :: starts(:)  !! first points of the straight ways
      logical, intent(in)  :: mirrors
      logical, intent(in)  :: joined     !! a way begins at the last point of the one before, else at its own first one
      integer, intent(out) :: branch(:)  !! fit_load, fit_unload, fit_reload
      integer, intent(out) :: sense(:)   !! 1 or -1
      real(wp) :: reached               ! the largest deflection of loading, in the sense S
      integer  :: before, i, k, last, s, way

      s = 1
      reached = 0.0_wp
      do k = 1, size(starts)
         last = size(u)
         if (k < size(starts)) last = starts(k + 1) - 1
         before = starts(k)
         if (k > 1 .and. (joined .or. last == before)) before = before - 1
         if (k == 1) then
            if (mirrors .and. abs(u(last)) >= abs(u(1)) .and. u(last) < 0.0_wp) s = -1
            if (mirrors .and. abs(u(last)) < abs(u(1)) .and. u(1) < 0.0_wp) s = -1
            if (s*(u(last) - u(1)) < 0.0_wp) reached = s*forward(1)
         end if
         way = merge(fit_unload, merge(fit_load, fit_reload, k == 1), s*(u(last) - u(before)) < 0.0_wp)
         do i = starts(k), last
            if (way == fit_reload .and. s*forward(i) > reached) way = fit_load
            if (way == fit_unload .and. mirrors .and. s*forward(i) < -reached) then
               s = -s
               way = fit_load
            end if
            if (way == fit_load) reached = max(reached, s*forward(i))
            branch(i) = way
            sense(i) = s
         end do
      end do
   end subroutine follow

   !> Rows that name their branches and have no runs: each stretch of one branch at one pressure is a run. Stretches of very few
   !! rows of shear are rows in no order: those of a branch and pressure are one run.
   subroutine number_stretches(data, p_tolerance)
      type(test_data_type), intent(inout) :: data
      real(wp), intent(in)                :: p_tolerance
      integer :: i, stretch(data%n)
      logical :: new

      stretch = 1
      do i = 2, data%n
         new = data%branch(i) /= data%branch(i - 1)
         associate (p => data%value(column_p, i - 1:i))
            if (data%kind == data_shear) new = new .or. abs(p(2) - p(1)) > p_tolerance*p(1)
         end associate
         stretch(i) = stretch(i - 1) + merge(1, 0, new)
      end do
      if (data%kind == data_normal .or. data%n >= few*stretch(data%n)) data%run(:data%n) = stretch
   end subroutine number_stretches

   !> Note how the record was cut, and say where it is hardly a record.
   subroutine report_record(data, p_tolerance, columns, share, band, counts, errors)
      type(test_data_type), intent(inout)  :: data
      real(wp), intent(in)                 :: p_tolerance, share, band(2) !! SHARE of the range is the BAND of each column
      integer, intent(in)                  :: columns(2), counts(2)       !! runs and tests
      type(deck_error_list), intent(inout) :: errors
      character(:), allocatable :: rows
      logical :: noisy

      rows = plural(data%n, 'row')
      call data%notes%add(0, rows//' in the order of time, '//plural(counts(2), 'test')//', '// &
                          plural(counts(1) - counts(2), 'turn')//'; noise band '//real_text(0.01_wp*anint(1.0e4_wp*share))// &
                          ' % of the range (--noise): '//real_text(band(1))//' of '//trim(column_symbols(columns(1)))//', '// &
                          real_text(band(2))//' of '//trim(column_symbols(columns(2))))
      associate (p => data%value(column_p, :data%n - 1), p_next => data%value(column_p, 2:data%n))
         noisy = data%kind == data_shear .and. counts(2) > 1 .and. &
                 (data%n < few*counts(2) .or. any(abs(p_next - p) > p_tolerance*p .and. abs(p_next - p) < 0.05_wp*p))
      end associate
      if (noisy) then
         call errors%add(0, plural(counts(2), 'test')//' in '//rows//' by the pressure: expected the rows of a test together; '// &
                         '--p-tolerance 0.05 counts pressures within 5 % as one')
      else if (counts(1) > counts(2) .and. data%n < few*counts(1)) then
         call errors%add(0, 'the test turns back '//integer_text(counts(1) - counts(2))//' times in '//rows//', too often for '// &
                         'a record in the order of time; --unordered takes all rows as loading, --noise 0.1 passes over '// &
                         'smaller turns, a column branch or run tells what the rows are')
      else if (.not. any(data%branch(:data%n) == fit_load) .and. data%kind == data_normal) then
         call errors%add(0, 'no loading: p falls from the first row on; --unordered takes all rows as loading')
      end if
   end subroutine report_record

end module test_branches
