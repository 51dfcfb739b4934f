!> The run of jointfit: what is said on the standard error, and the exit status.
module fit_run
   use, intrinsic :: iso_fortran_env, only: error_unit, output_unit
   use c_library, only: end_run
   use deck_errors, only: deck_error_list
   use deck_text, only: deck_text_type
   use fit_command, only: data_argument
   use id_table, only: sorted_order
   use output_file, only: output_file_type
   use surface_fit, only: surface_fit_type
   use fit_data, only: data_normal
   use text_tools, only: integer_text, plural
   implicit none
   private

   public :: use_one_thread, report_unreadable_data, report_data_errors, report_fit, finish_output, end_fit

   integer, parameter :: status_unreadable = 1, status_data = 2, status_unwritten = 4
   integer, parameter :: most_printed = 200, widest = 100

   integer :: exit_status = 0 ! the highest so far

   interface
      subroutine openblas_set_num_threads(n) bind(c, name='openblas_set_num_threads')
         use, intrinsic :: iso_c_binding, only: c_int
         integer(c_int), value :: n
      end subroutine openblas_set_num_threads
   end interface

contains

   !> One order of additions, the same digits everywhere.
   subroutine use_one_thread()

      call openblas_set_num_threads(1)
   end subroutine use_one_thread


   subroutine report_unreadable_data(file)
      type(data_argument), intent(in) :: file
      logical :: is_folder, there

      exit_status = max(exit_status, status_unreadable)
      inquire (file=file%path, exist=there)
      inquire (file=file%path//'/.', exist=is_folder)
      if (is_folder) then
         write (error_unit, '(2a)') file%name, ': a directory, expected a file of test data'
      else if (there) then
         write (error_unit, '(2a)') file%name, ': cannot be read'
      else
         write (error_unit, '(2a)') file%name, ': no such file'
      end if
   end subroutine report_unreadable_data


   !> All errors of a data file, in the order of its lines: where, the line itself, a mark under the columns, what is wrong.
   subroutine report_data_errors(text, errors)
      type(deck_text_type), intent(in)  :: text
      type(deck_error_list), intent(in) :: errors
      integer, allocatable :: lines(:), order(:)
      integer :: k

      exit_status = max(exit_status, status_data)
      allocate (lines(errors%n), source=errors%items(:errors%n)%line)
      call sorted_order(lines, order)
      do k = 1, min(errors%n, most_printed)
         associate (item => errors%items(order(k)))
            write (error_unit, '(4a, 3x, a)') 'DATA ERROR ', integer_text(k), ' OF ', integer_text(errors%n), &
               text%place(item%line)
            if (item%line > 0) write (error_unit, '(3x, a)') shown(text%line(item%line))
            if (item%first > 0 .and. item%first <= widest) write (error_unit, '(3x, 2a)') repeat(' ', item%first - 1), &
               repeat('^', max(1, min(item%last, widest) - item%first + 1))
            write (error_unit, '(3x, a, /)') item%message
         end associate
      end do
      if (errors%n > most_printed) write (error_unit, '(3a, /)') 'and ', plural(errors%n - most_printed, 'more error'), &
         ', not printed'
      write (error_unit, '(4a)') text%place(0), ': ', plural(errors%n, 'error'), ', no card written'
   end subroutine report_data_errors


   !> LINE as it may be printed: cut where it is very long, tabs as blanks so that the mark below it stays in place.
   pure function shown(line) result(words)
      character(*), intent(in)  :: line
      character(:), allocatable :: words
      integer :: i

      words = line(:min(len(line), widest))
      do i = 1, len(words)
         if (iachar(words(i:i)) < 32 .or. iachar(words(i:i)) == 127) words(i:i) = ' '
      end do
      if (len(line) > widest) words = words//' ...'
      words = trim(words)
   end function shown


   !> The warnings of a fit, and that there is no card for want of loading data.
   subroutine report_fit(file, fit)
      type(data_argument), intent(in)    :: file
      type(surface_fit_type), intent(in) :: fit
      integer :: k

      do k = 1, fit%warnings%n
         write (error_unit, '(3a)') file%name, ': WARNING: ', fit%warnings%items(k)%message
      end do
      if (fit%kind == data_normal .or. fit%has_loading) return
      exit_status = max(exit_status, status_data)
      write (error_unit, '(2a)') file%name, ': no LOAD data, and a JSHEAR card needs the loading coefficients: those of the'// &
         ' other branches are written as comments; --branch RELOAD --as LOAD makes a card of RELOAD data'
   end subroutine report_fit


   subroutine finish_output(out)
      type(output_file_type), intent(inout) :: out
      logical :: ok

      call out%finish(ok)
      if (ok) return
      exit_status = max(exit_status, status_unwritten)
      write (error_unit, '(a)') 'jointfit: the cards cannot be written to the standard output'
   end subroutine finish_output


   !> End with STATUS, or the highest of the files where that is higher.
   subroutine end_fit(status)
      integer, intent(in) :: status

      flush (output_unit)
      call end_run(max(status, exit_status))
   end subroutine end_fit

end module fit_run
