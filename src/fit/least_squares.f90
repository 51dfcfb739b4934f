!> What comes before a fit: readings below zero, an offset of the first one, noise or an error; points that were taken at one
!! pressure. Linear least squares by LAPACK.
module least_squares
   use data_columns, only: column_d, column_p, column_symbols, data_normal, data_shear, fit_load
   use deck_errors, only: deck_error_list
   use fit_data, only: test_data_type
   use kinds, only: wp
   use text_tools, only: plural, real_text
   implicit none
   private

   public :: solve_least_squares, fit_line, group_by_pressure, take_off_offset, check_signs

   real(wp), parameter :: singular = 1.0e-12_wp ! reciprocal condition number of the scaled columns that counts as rank lost

   interface
      subroutine dgelsy(m, n, nrhs, a, lda, b, ldb, jpvt, rcond, rank, work, lwork, info)
         import :: wp
         integer, intent(in)     :: m, n, nrhs, lda, ldb, lwork
         real(wp), intent(in)    :: rcond
         real(wp), intent(inout) :: a(lda, *), b(ldb, *), work(*)
         integer, intent(inout)  :: jpvt(*)
         integer, intent(out)    :: rank, info
      end subroutine dgelsy
   end interface

contains

   !> The X that makes norm2(MATRIX X - RHS) least, by an orthogonal factorisation with pivoting (DGELSY). The columns are
   !! scaled to length one first, so that d, d^2, d^3 in any unit do no harm. OK is false where MATRIX has fewer rows than
   !! columns or, to rounding, dependent columns; X is then zero.
   subroutine solve_least_squares(matrix, rhs, x, ok)
      real(wp), intent(in)  :: matrix(:, :) !! (points, unknowns)
      real(wp), intent(in)  :: rhs(:)       !! (points)
      real(wp), intent(out) :: x(:)         !! (unknowns)
      logical, intent(out)  :: ok
      real(wp), allocatable :: a(:, :), b(:, :), work(:)
      real(wp) :: length(size(matrix, 2)), best_size(1)
      integer  :: pivots(size(matrix, 2)), info, k, m, n, rank

      m = size(matrix, 1)
      n = size(matrix, 2)
      x = 0.0_wp
      ok = .false.
      if (m < n) return
      do k = 1, n
         length(k) = norm2(matrix(:, k))
      end do
      if (any(length <= 0.0_wp)) return
      a = matrix/spread(length, 1, m)
      b = reshape(rhs, [m, 1])
      pivots = 0
      call dgelsy(m, n, 1, a, m, b, m, pivots, singular, rank, best_size, -1, info)
      allocate (work(int(best_size(1))))
      call dgelsy(m, n, 1, a, m, b, m, pivots, singular, rank, work, size(work), info)
      ok = info == 0 .and. rank == n
      if (ok) x = b(:n, 1)/length
   end subroutine solve_least_squares

   !> The straight line y = LINE(1) + LINE(2) x nearest to the points. OK is false for fewer than two different x.
   subroutine fit_line(x, y, line, ok)
      real(wp), intent(in)  :: x(:), y(:)
      real(wp), intent(out) :: line(2)
      logical, intent(out)  :: ok
      real(wp) :: matrix(size(x), 2)

      matrix(:, 1) = 1.0_wp
      matrix(:, 2) = x
      call solve_least_squares(matrix, y, line, ok)
   end subroutine fit_line

   !> Put points into groups of equal pressure. In ascending order of p a group reaches from its lowest p to
   !! (1 + TOLERANCE) times that; its pressure is the mean of its points. Groups are numbered in ascending order of p.
   pure subroutine group_by_pressure(p, tolerance, group, group_p)
      real(wp), intent(in)               :: p(:)       !! [pressure]; one below 0, an error elsewhere, stands for itself
      real(wp), intent(in)               :: tolerance  !! >= 0 [-]
      integer, allocatable, intent(out)  :: group(:)   !! (points) the group of each point
      real(wp), allocatable, intent(out) :: group_p(:) !! (groups) [pressure]
      real(wp) :: lowest
      integer  :: n

      allocate (group(size(p)), source=0)
      allocate (group_p(0))
      do while (any(group == 0))
         n = size(group_p) + 1
         lowest = minval(p, group == 0)
         where (group == 0 .and. p <= max(lowest, lowest*(1.0_wp + tolerance))) group = n
         group_p = [group_p, sum(p, group == n)/count(group == n)]
      end do
   end subroutine group_by_pressure

   !> Where the first reading of a test is negative, by more than the SCATTER of readings and up to the BAND of noise, or ALWAYS,
   !! take it off all its ROWS, COLUMNS(1) and (2) each by itself. Rows that name their branches begin with the first of loading.
   subroutine take_off_offset(data, rows, columns, scatter, band, always)
      type(test_data_type), intent(inout) :: data
      integer, intent(in)  :: rows(:), columns(2)
      real(wp), intent(in) :: scatter(2), band(2) !! of each column
      logical, intent(in)  :: always
      real(wp) :: first
      integer  :: k, start

      start = rows(1)
      if (data%has_branch) start = rows(max(1, findloc(data%branch(rows), fit_load, 1)))
      if (data%has_branch .and. data%branch(start) /= fit_load) return
      do k = 1, 2
         first = data%value(columns(k), start)
         if (.not. (always .or. (first < -scatter(k) .and. first >= -band(k))) .or. abs(first) <= 0.0_wp) cycle
         data%value(columns(k), rows) = data%value(columns(k), rows) - first
         call data%notes%add(data%line(start), 'the first reading of '//trim(column_symbols(columns(k)))//', '// &
                             real_text(first)//', taken off '//plural(size(rows), 'row'))
      end do
   end subroutine take_off_offset

   !> What is further below zero than the BAND of noise, SHARE of the range: p, and d of rows that are named loading.
   subroutine check_signs(data, share, band, errors)
      type(test_data_type), intent(in)     :: data
      real(wp), intent(in)                 :: share, band(2) !! of d and tau, or of lambda and p
      type(deck_error_list), intent(inout) :: errors
      character(:), allocatable :: help, word
      integer :: i

      help = '; --zero takes the first reading off all of a test, --noise takes more than '// &
             real_text(0.01_wp*anint(1.0e4_wp*share))//' % of the range for noise'
      do i = 1, data%n
         associate (p => data%place(:, column_p, i), d => data%place(:, column_d, i))
            word = data%text%line(data%line(i))
            word = word(p(1):min(p(2), len(word)))
            if (data%kind == data_normal .and. data%value(column_p, i) < -band(2)) then
               call errors%add(data%line(i), 'P: '''//word//''' is negative, expected 0 or more (compression is '// &
                               'positive)'//help, p(1), p(2))
            else if (data%kind == data_shear .and. data%value(column_p, i) < 0.0_wp) then
               call errors%add(data%line(i), 'P: '''//word//''' is negative, expected 0 or more (compression is '// &
                               'positive)', p(1), p(2))
            else if (data%kind == data_shear .and. data%has_branch .and. data%branch(i) == fit_load .and. &
                     data%value(column_d, i) < -band(1)) then
               call errors%add(data%line(i), 'd of the LOAD branch is negative: expected d and tau counted in the sense of '// &
                               'loading'//help, d(1), d(2))
            end if
         end associate
      end do
   end subroutine check_signs

end module least_squares
