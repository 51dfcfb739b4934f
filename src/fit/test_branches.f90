!> Assigns each row of a test to a branch and a run, and corrects readings below zero.
!! The loading path of the test decides the branch. A reading below zero is an offset of the first reading, noise, or an error.
module test_branches
   use branch_cubic, only: cubic, cubic_value
   use branch_fit, only: find_turns, fit_cubic, group_by_pressure, scatter_of
   use data_columns, only: column_d, column_lambda, column_p, column_symbols, column_tau, data_cubics, data_loss, data_normal, &
                           data_shear, data_stiffness, fit_load, fit_reload, fit_unload
   use deck_errors, only: deck_error_list
   use fit_command, only: fit_command_type
   use fit_data, only: test_data_type
   use kinds, only: wp
   use numbers, only: solve_least_squares
   use text_tools, only: integer_text, plural, real_text
   use tolerances, only: equal_readings
   implicit none
   private

   public :: find_branches, follow

   real(wp), parameter :: least_band = 0.01_wp, most_band = 0.25_wp ! of noise, as shares of the range
   real(wp), parameter :: far = 0.1_wp         ! share of the range beyond which a reading is away from the first reading
   integer, parameter  :: few = 3              ! mean number of rows in a run below which the rows are hardly in the order of time

   integer, parameter  :: no_branch = 0        ! for rows without a branch of the law
   real(wp), parameter :: farthest = 1.0e6_wp  ! its scatter grows up to this multiple
   real(wp), parameter :: known = 1.5_wp       ! the loading cubic is trusted up to this multiple of the largest d of loading

contains

   !> Assign a branch and a run to every row of DATA where the file does not give them: by turning points where the rows are in the
   !! order of time, by the direction of each run where the runs are numbered. A first reading slightly below zero is subtracted
   !! from the others. Readings too far below zero for noise, and rows without an order, go to ERRORS. The notes say how a record
   !! was split.
   subroutine find_branches(data, command, errors)
      type(test_data_type), intent(inout)  :: data
      type(fit_command_type), intent(in)   :: command
      type(deck_error_list), intent(inout) :: errors
      character(:), allocatable :: n_rows
      integer, allocatable :: rows(:)
      integer :: i, n_tests, runs, t, test(data%n)
      logical :: faulty, is_noisy

      if (data%kind == data_stiffness) data%branch = fit_load
      if (any(data%kind == [data_cubics, data_stiffness, data_loss]) .or. data%n == 0) return
      faulty = errors%any()
      data%in_order = .not. (data%has_branch .or. command%unordered)
      data%is_record = data%in_order .and. .not. data%has_run
      data%columns = merge([column_d, column_tau], [column_lambda, column_p], data%kind == data_shear)
      associate (x => data%value(data%columns(1), :data%n), y => data%value(data%columns(2), :data%n))
         data%range = [maxval(x) - minval(x), maxval(y) - minval(y)]
         where (data%range <= 0.0_wp) data%range = 1.0_wp
         if (data%is_record) data%scatter = scatter_of(x, y)
      end associate
      data%band = min(most_band, max(least_band, 2.0_wp*data%scatter))
      if (command%noise > 0.0_wp) data%band = command%noise
      if (command%unordered .and. .not. data%has_branch) data%branch = fit_load
      if (data%has_branch .and. .not. data%has_run) call number_stretches(data, command%fit%p_tolerance, command%noise)
      call separate_tests(data, command%fit%p_tolerance, test)
      runs = 0
      n_tests = maxval(test)
      do t = 1, n_tests
         rows = pack([(i, i = 1, data%n)], test == t)
         call take_off_offset(data, rows, command%zero)
         if (data%in_order .and. .not. command%iwan) call take_branches(data, rows, runs)
      end do
      if (command%iwan) then ! its slices follow each test, whatever it does
         if (data%is_record) data%joined(2:data%n) = test(2:) == test(:data%n - 1)
         return
      end if
      call check_signs(data, errors)
      if (faulty .or. .not. data%is_record) return

      ! how the record was split, and an error where it hardly is a record
      n_rows = plural(data%n, 'row')
      associate (names => column_symbols(data%columns), band => data%band*data%range)
         call data%notes%add(0, n_rows//' in the order of time, '//plural(n_tests, 'test')//', '//plural(runs - n_tests, 'turn')// &
                             '; noise band '//real_text(0.01_wp*anint(1.0e4_wp*data%band))//' % of the range (--noise): '// &
                             real_text(band(1))//' of '//trim(names(1))//', '//real_text(band(2))//' of '//trim(names(2)))
      end associate
      associate (p => data%value(column_p, :data%n - 1), p_next => data%value(column_p, 2:data%n), &
                 tolerance => command%fit%p_tolerance)
         is_noisy = data%kind == data_shear .and. n_tests > 1 .and. &
                    (data%n < few*n_tests .or. any(abs(p_next - p) > tolerance*p .and. abs(p_next - p) < 0.05_wp*p))
      end associate
      if (is_noisy) then
         call errors%add(0, plural(n_tests, 'test')//' in '//n_rows//' by the pressure: expected the rows of a test together; '// &
                         '--p-tolerance 0.05 counts pressures within 5 % as one')
      else if (runs > n_tests .and. data%n < few*runs) then
         call errors%add(0, 'the test turns back '//integer_text(runs - n_tests)//' times in '//n_rows//', too often for '// &
            'a record in the order of time; --unordered takes all rows as loading, --noise 0.1 ignores smaller turns, a column '// &
            'branch or run classifies the rows')
      else if (.not. any(data%branch(:data%n) == fit_load) .and. data%kind == data_normal) then
         call errors%add(0, 'no loading: p falls from the first row on; --unordered takes all rows as loading')
      end if
   end subroutine find_branches

   !> The TEST of each row. A header begins a test, and so does another pressure in shear. A row back at the first reading, after a
   !! row away from it, begins the test of a new specimen. Rows with branches may be in any order, and numbered runs may return to
   !! their pressure.
   subroutine separate_tests(data, p_tolerance, test)
      type(test_data_type), intent(in)  :: data
      real(wp), intent(in)              :: p_tolerance
      integer, intent(out)              :: test(:) !! (row)
      integer, allocatable  :: group(:)
      real(wp), allocatable :: group_p(:)
      integer :: first(data%n), last(data%n), i, k, n, t
      logical :: fresh

      allocate (group(data%n), source=1)
      if (data%kind == data_shear .and. .not. data%has_branch) &
         call group_by_pressure(data%value(column_p, :data%n), p_tolerance, group, group_p)
      n = 0
      do i = 1, data%n
         t = findloc([(data%part(first(k)) == data%part(i) .and. group(first(k)) == group(i), k = 1, n)], .true., 1, back=.true.)
         if (data%is_record .and. t < n) t = 0
         fresh = t == 0
         if (data%in_order .and. .not. fresh) then ! the row before is away from the first row, this row is back at it
            associate (value => data%value(data%columns, [first(t), last(t), i]))
               fresh = any(abs(value(:, 2) - value(:, 1))/data%range > far) .and. &
                       all(abs(value(:, 3) - value(:, 1))/data%range <= data%band)
            end associate
         end if
         if (fresh) then
            n = n + 1
            first(n) = i
            t = n
         end if
         last(t) = i
         test(i) = t
      end do
   end subroutine separate_tests

   !> Assign branches to the ROWS of one test, in order, from its path, which is straight between the turning points of a record or
   !! from run to run, and count its RUNS. In shear, readings of the opposite sense of loading are reversed.
   subroutine take_branches(data, rows, runs)
      type(test_data_type), intent(inout) :: data
      integer, intent(in)                 :: rows(:)
      integer, intent(inout)              :: runs
      integer, allocatable  :: starts(:)
      real(wp), allocatable :: tau(:), u(:)       ! U increases where the test loads; TAU of shear
      integer :: branch(size(rows)), i, run, sense(size(rows))
      logical :: is_shear

      is_shear = data%kind == data_shear
      u = data%value(data%columns(2), rows)/data%range(2)
      if (is_shear) u = u + data%value(data%columns(1), rows)/data%range(1)
      if (data%is_record) then
         call find_turns(u, data%band*merge(sqrt(2.0_wp), 1.0_wp, is_shear), starts)
         starts = [1, starts + 1]
      else
         starts = pack([(i, i = 1, size(rows))], [.true., data%run(rows(2:)) /= data%run(rows(:size(rows) - 1))])
      end if
      runs = runs + size(starts)
      if (is_shear) tau = data%value(column_tau, rows)
      call follow(data%value(merge(column_d, column_p, is_shear), rows), u, starts, is_shear, data%is_record, branch, sense, tau)
      data%value(data%columns, rows) = spread(sense, 1, 2)*data%value(data%columns, rows)
      data%branch(rows) = branch
      if (any(branch == no_branch)) call data%notes%add(0, plural(count(branch == no_branch), 'row')// &
         ' left out: past point A and off the loading curve, p = '//real_text(data%value(column_p, rows(1))))
      if (.not. data%is_record) return
      data%joined(rows(2:)) = .true.
      run = maxval(data%run) + 1
      data%run(rows(1)) = run
      do i = 2, size(rows)
         if (branch(i) /= branch(i - 1) .or. any(starts == i)) run = run + 1
         data%run(rows(i)) = run
      end do
   end subroutine take_branches

   !> The branch of every point of a test that follows U in straight ways between the points STARTS. The test loads; turned back it
   !! unloads; turned again it reloads until it meets the loading curve, and then loads. In a test that MIRRORS, unloading that
   !! meets the loading curve of the other SENSE becomes loading. Without stresses, or without a known curve, the curve is met at
   !! point A, the deflection at which the last unloading began.
   subroutine follow(forward, u, starts, mirrors, joined, branch, sense, tau)
      real(wp), intent(in) :: forward(:) !! d, or p of a normal test
      real(wp), intent(in) :: u(:)       !! increases where the test loads
      integer, intent(in)  :: starts(:)  !! first points of the straight ways
      logical, intent(in)  :: mirrors
      logical, intent(in)  :: joined     !! a way begins at the last point of the way before, otherwise at its own first point
      integer, intent(out) :: branch(:)  !! fit_load, fit_unload, fit_reload, no_branch
      integer, intent(out) :: sense(:)   !! 1 or -1
      real(wp), intent(in), optional :: tau(:)
      real(wp) :: reached               ! deflection of point A, in the sense S; during loading the largest deflection so far
      integer  :: before, goal, joins, k, last, s, way

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
         joins = starts(k)
         if (way /= fit_load) then
            goal = merge(-s, s, way == fit_unload)
            joins = last + 1
            if (way == fit_reload .or. mirrors) joins = findloc(goal*forward(starts(k):last) > reached, .true., 1) + starts(k) - 1
            if (joins < starts(k)) joins = last + 1
            branch(starts(k):last) = way
            sense(starts(k):last) = s
            if (present(tau)) call find_meeting(forward(:last), tau(:last), sense(:last), goal, starts(k), joins, branch(:last))
            if (joins > last) cycle
            s = goal
            reached = s*forward(joins)
         end if
         branch(joins:last) = fit_load
         sense(joins:last) = s
         reached = max(reached, maxval(s*forward(joins:last)))
      end do
   end subroutine follow

   !> Where a return path from point FIRST on meets the loading curve tau = a1 d + a2 d^2 + a3 d^3 through the points of loading
   !! before: after the last point up to A that is off the curve on the side of the path. Where that is the last point before A,
   !! JOINS keeps the value from A. Points beyond A that are still off the curve, within its known range, then belong to no branch
   !! of the law.
   subroutine find_meeting(forward, stress, sense, goal, first, joins, branch)
      real(wp), intent(in)   :: forward(:), stress(:)
      integer, intent(in)    :: sense(:), goal      !! of loading, 1 or -1: at the points; of the curve that the path may meet
      integer, intent(in)    :: first
      integer, intent(inout) :: joins               !! first point of loading
      integer, intent(inout) :: branch(:)
      type(cubic) :: law
      integer, allocatable  :: of_load(:)
      real(wp), allocatable :: starts(:)
      real(wp) :: d(size(forward)), d_most, least, off(size(forward)), scatter, side
      logical  :: is_on(size(forward)), ok
      integer  :: i, last_off

      of_load = pack([(i, i = 1, first - 1)], branch(:first - 1) == fit_load)
      if (size(of_load) < few) return
      d = goal*forward
      associate (d_own => sense(of_load)*forward(of_load), tau_own => sense(of_load)*stress(of_load))
         call fit_cubic(d_own, tau_own, reshape([logical ::], [size(of_load), 0]), law%coefficients(1, :), starts, ok)
         if (.not. ok) return
         scatter = norm2(tau_own - cubic_value(law, d_own, 0.0_wp))/sqrt(real(max(1, size(of_load) - 3), wp))
         least = equal_readings*maxval(abs(tau_own)) ! smallest difference between readings
         off = goal*stress - cubic_value(law, d, 0.0_wp)
         ! on the curve: within three times the scatter of its points, more beyond the last point
         d_most = maxval(d_own)
         if (.not. d_most > 0.0_wp) return  ! the points of loading moved against their stresses: no curve ahead
         is_on = abs(off) <= least + 3.0_wp*scatter*max(1.0_wp, min(farthest, d/d_most))**6
      end associate
      side = 0.0_wp
      last_off = 0
      do i = first, joins - 1
         if (d(i) < 0.0_wp .or. is_on(i)) cycle
         if (.not. abs(side) > 0.0_wp) side = sign(1.0_wp, off(i))
         if (side*off(i) > 0.0_wp) last_off = i
      end do
      if (last_off == 0) return
      if (last_off < joins - 1) then
         joins = behind(last_off, joins)
      else if (size(of_load) > 2*few) then
         do i = joins, size(d)
            if (is_on(i) .or. d(i) > known*d_most) exit
            branch(i) = no_branch
            joins = i + 1
         end do
      end if

   contains

      !> The first point after LAST and before END on the curve. Of points in doubt it is the first one after the intersection of
      !! the curve with the parabola through the points before that are off the curve.
      integer function behind(last, end)
         integer, intent(in) :: last, end
         integer, allocatable :: points(:)
         real(wp) :: parabola(3)
         logical  :: ok

         points = pack([(i, i = first, last)], d(first:last) >= 0.0_wp)
         associate (x => d(points), k => size(points))
            call solve_least_squares(reshape([(1.0_wp, i = 1, k), x, x**2], [k, 3]), off(points), parabola, ok)
         end associate
         do behind = last + 1, end - 1
            if (.not. ok .or. abs(off(behind)) <= least) return
            if (side*(parabola(1) + d(behind)*(parabola(2) + d(behind)*parabola(3))) <= 0.0_wp) return
         end do
      end function behind

   end subroutine find_meeting

   !> Assign runs to rows that have branches but no runs. Each stretch of one branch at one pressure is a run, up to where d, or p
   !! of a normal test, turns back. Very short stretches in shear mean rows without an order: those of one branch and pressure form
   !! one run.
   subroutine number_stretches(data, p_tolerance, noise)
      type(test_data_type), intent(inout) :: data
      real(wp), intent(in)                :: p_tolerance
      real(wp), intent(in)                :: noise !! share of the range, 0: estimated
      logical  :: begins(data%n + 1)               ! a run, at each row; and one behind the last row
      real(wp) :: band
      integer  :: first, i, last, run
      integer, allocatable :: turns(:)

      associate (n => data%n, is_shear => data%kind == data_shear, branch => data%branch, p => data%value(column_p, :))
         begins = .true.
         begins(2:n) = branch(2:n) /= branch(:n - 1) .or. (is_shear .and. abs(p(2:n) - p(:n - 1)) > p_tolerance*p(:n - 1))
         associate (x => data%value(merge(column_d, column_p, is_shear), :n), &
                    y => data%value(merge(column_tau, column_lambda, is_shear), :n))
            band = max(least_band, 2.0_wp*scatter_of(x, y))
            if (noise > 0.0_wp) band = noise
            first = 1
            do last = 1, n
               if (.not. begins(last + 1) .or. (band > most_band .and. noise <= 0.0_wp)) cycle
               do                           ! split the stretch that is complete where x turns back
                  call find_turns(x(first:last), band*(maxval(x) - minval(x)), turns)
                  if (size(turns) == 0) exit
                  first = first + turns(1)
                  begins(first) = .true.
               end do
               first = last + 1
            end do
         end associate
         if (is_shear .and. n < few*count(begins(:n))) return
         run = 0
         do i = 1, n
            if (begins(i)) run = run + 1
            data%run(i) = run
         end do
      end associate
   end subroutine number_stretches

   !> Where the first reading of a test is negative, by more than the scatter of readings and at most the band of noise, or ALWAYS,
   !! subtract it from all ROWS of the test, separately in both columns. Rows with branches begin with the first loading row.
   subroutine take_off_offset(data, rows, always)
      type(test_data_type), intent(inout) :: data
      integer, intent(in)                 :: rows(:)
      logical, intent(in)                 :: always
      real(wp) :: first
      integer  :: k, start

      start = rows(1)
      if (data%has_branch) start = rows(max(1, findloc(data%branch(rows), fit_load, 1)))
      if (data%has_branch .and. data%branch(start) /= fit_load) return
      do k = 1, 2
         associate (value => data%value(data%columns(k), :), range => data%range(k))
            first = value(start)
            if (.not. (always .or. (first < -data%scatter*range .and. first >= -data%band*range)) &
                .or. abs(first) <= 0.0_wp) cycle
            value(rows) = value(rows) - first
            call data%notes%add(data%line(start), 'the first reading of '//trim(column_symbols(data%columns(k)))//', '// &
                                real_text(first)//', subtracted from '//plural(size(rows), 'row'))
         end associate
      end do
   end subroutine take_off_offset

   !> Report readings below zero by more than the band of noise: p, and d of rows given as loading. The p of a shear test is
   !! prescribed, without noise.
   subroutine check_signs(data, errors)
      type(test_data_type), intent(in)     :: data
      type(deck_error_list), intent(inout) :: errors
      character(:), allocatable :: help, help_of_p, word
      real(wp) :: lowest(2)
      integer  :: i

      lowest = -data%band*data%range
      if (data%kind == data_shear) lowest(2) = 0.0_wp
      help = '; --zero subtracts the first reading of a test from all its readings, --noise allows more noise than '// &
             real_text(0.01_wp*anint(1.0e4_wp*data%band))//' % of the range'
      help_of_p = ''
      if (data%kind == data_normal) help_of_p = help
      do i = 1, data%n
         associate (p => data%place(:, column_p, i), d => data%place(:, column_d, i))
            word = data%text%line(data%line(i))
            word = word(p(1):min(p(2), len(word)))
            if (data%value(column_p, i) < lowest(2)) then
               call errors%add(data%line(i), 'P: '''//word//''' is negative, expected 0 or more (compression is positive)'// &
                               help_of_p, p(1), p(2))
            else if (data%kind == data_shear .and. data%has_branch .and. data%branch(i) == fit_load .and. &
                     data%value(column_d, i) < lowest(1)) then
               call errors%add(data%line(i), 'd of the LOAD branch is negative: expected d and tau counted in the sense of '// &
                               'loading'//help, d(1), d(2))
            end if
         end associate
      end do
   end subroutine check_signs

end module test_branches
