!> Readings below zero: an offset of the first one, noise, or an error.
module reading_offset
   use data_columns, only: column_d, column_p, column_symbols, data_normal, data_shear, fit_load
   use deck_errors, only: deck_error_list
   use fit_data, only: test_data_type
   use kinds, only: wp
   use text_tools, only: plural, real_text
   implicit none
   private

   public :: take_off_offset, check_signs

contains

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

end module reading_offset
