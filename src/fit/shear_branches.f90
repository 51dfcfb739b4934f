!> Fits a branch of the shear law to the rows of a test, d of unloading and reloading from zero or from the start of the branch.
!! ORIGIN CURVE: tau = b0 + B(d). BRANCH: sense tau = constant + B(sense (d - from)), the sense that of the movement. Each run has a
!! constant of its own.
module shear_branches
   use branch_fit, only: branch_fit_type, fault_dependent, fault_few_points, fault_none, fault_one_pressure, fit_lines_only, &
                         fit_points
   use data_columns, only: branch_words, column_c, column_d, column_p, column_tau, data_shear, fit_load, fit_reload, fit_unload
   use deck_errors, only: deck_error_list
   use fit_command, only: fit_command_type
   use fit_data, only: test_data_type
   use kinds, only: wp
   use text_tools, only: one_of, plural, real_text
   use tolerances, only: same_deflection
   implicit none
   private

   public :: fit_branch

contains

   !> Fit a branch of the card to the rows of the branches SOURCES.
   subroutine fit_branch(data, command, sources, from_branch, fit, errors)
      type(test_data_type), intent(in)     :: data
      type(fit_command_type), intent(in)   :: command
      integer, intent(in)                  :: sources(:)
      logical, intent(in)                  :: from_branch !! d of unloading and reloading counts from the start of the branch
      type(branch_fit_type), intent(out)   :: fit
      type(deck_error_list), intent(inout) :: errors
      integer, allocatable :: rows(:)
      character(:), allocatable :: help, name
      integer :: i
      logical :: met(data%n)

      rows = pack([(i, i = 1, data%n)], [(any(data%branch(i) == sources), i = 1, data%n)])
      name = trim(branch_words(sources(1)))
      if (data%kind == data_shear) then
         call fit_rows(rows, data%run(rows))
         met = .false.
         if (fit%fault /= fault_none .and. data%in_order &
             .and. all(sources == fit_reload)) met = [(returns(i), i = 1, data%n)]
         if (any(met)) then
            rows = pack([(i, i = 1, data%n)], met .or. data%branch(:data%n) == fit_reload)
            call fit_rows(rows, merge(data%run(max(1, rows - 1)), data%run(rows), met(rows)))
         end if
      else
         call fit_lines_only(data%value(column_c, rows), data%value(column_p, rows), command%fit%one_pressure, fit)
      end if
      fit%row = rows
      help = ''                   ! where measured pressures are close to each other but count as different
      associate (p => fit%group_p, n => size(fit%group_p))
         if (any(p(2:) < 1.05_wp*p(:n - 1))) help = ', --p-tolerance 0.05 counts pressures within 5 % as one'
      end associate
      select case (fit%fault)
      case (fault_one_pressure)
         call errors%add(data%line(rows(1)), name//': all data at one pressure, p = '//real_text(fit%p_high)// &
                         ', expected two pressures or more; --one-pressure makes a card that does not depend on the pressure')
      case (fault_few_points)
         i = findloc(fit%group, fit%fault_at, 1)
         call errors%add(data%line(rows(i)), name//', p = '//real_text(fit%group_p(fit%fault_at))//': '// &
                         plural(count(fit%group == fit%fault_at), 'point')//' that fix no cubic, expected '// &
                         one_of(fit%constant, 'four different d or more', 'three different d or more, not zero')// &
                         '; --joint-fit needs no cubic of each pressure'//help)
      case (fault_dependent)
         call errors%add(data%line(rows(1)), name//': '//plural(size(rows), 'point')// &
                         ' that do not fix the coefficients: expected more different d and p'//help)
      end select

   contains

      subroutine fit_rows(rows, run)
         integer, intent(in) :: rows(:), run(:)
         real(wp) :: from(size(rows)), sense(size(rows))

         from = 0.0_wp
         sense = 1.0_wp
         if (from_branch .and. all(sources /= fit_load)) then
            where (data%branch(rows) == fit_unload) sense = -1.0_wp
            from = starts(rows, run, sense)
         end if
         call fit_points(sense*(data%value(column_d, rows) - from), sense*data%value(column_tau, rows), &
                         data%value(column_p, rows), run, all(sources /= fit_load), command%fit, fit)
         fit%sense = sense
         fit%from = from
      end subroutine fit_rows

      !> d at which the branch of each row began: the first one in the SENSE of the movement, of its run and of the row before the
      !! run, which is on another branch of the same test and pressure.
      function starts(rows, run, sense) result(from)
         integer, intent(in)  :: rows(:), run(:)
         real(wp), intent(in) :: sense(:)
         real(wp) :: from(size(rows))
         logical  :: is_done(size(rows)), of_run(size(rows)), follows(size(rows))
         integer  :: before(size(rows)), i

         before = max(1, rows - 1)
         from = 0.0_wp
         is_done = .false.
         associate (d => data%value(column_d, :), p => data%value(column_p, :), tolerance => command%fit%p_tolerance)
            follows = run > 0 .and. data%part(before) == data%part(rows) .and. data%run(before) /= run .and. &
                      abs(p(before) - p(rows)) <= tolerance*p(rows)
            do i = 1, size(rows)
               if (is_done(i)) cycle
               of_run = run == run(i) .and. data%branch(rows) == data%branch(rows(i)) .and. &
                        abs(p(rows) - p(rows(i))) <= tolerance*p(rows(i))
               where (of_run) from = sense*min(minval(sense*d(rows), of_run), minval(sense*d(before), of_run .and. follows))
               is_done = is_done .or. of_run
            end do
         end associate
      end function starts

      !> Whether reloading returns to point A at row I: it is a point of loading, and also of reloading where reloading has few
      !! points.
      logical function returns(i)
         integer, intent(in) :: i
         integer :: a

         returns = .false.
         if (i == 1) return
         if (data%branch(i) /= fit_load .or. data%branch(i - 1) /= fit_reload) return
         a = findloc(data%branch(:i - 1), fit_load, 1, back=.true.)
         if (a == 0) return
         associate (d => data%value(column_d, [a, i]))
            returns = abs(d(2) - d(1)) <= same_deflection*abs(d(1))
         end associate
      end function returns

   end subroutine fit_branch

end module shear_branches
