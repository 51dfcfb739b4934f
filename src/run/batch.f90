!> A batch as one table: a row a run of the command, into the file of --summary, and where there are several runs behind their answers.
module batch
   use command_line, only: command_type
   use, intrinsic :: iso_fortran_env, only: error_unit
   use kinds, only: long, wp
   use listing_table, only: column, column_type, csv, csv_titles, heading, listing_table_type
   use model_data, only: model_type
   use output_file, only: output_file_type
   use progress, only: run_type, status_of
   implicit none
   private

   public :: start_run_of_batch, end_run_of_batch, end_batch

   integer, parameter :: name_width = 40 ! of the table on the screen

   type :: row_type
      character(:), allocatable :: name
      integer  :: status = 0, counts(3) = 0            ! stages, increments, iterations
      real(wp) :: figures(5) = 0.0_wp                  ! u_max, mises_max, contact, safety, frequency
      logical  :: is_there(5) = .false.
      integer  :: node = 0                             ! the first that is watched, 0: none
      real(wp) :: along = 0.0_wp, stiffness = 0.0_wp
      logical  :: is_loaded = .false., moves = .false.
      real(wp) :: seconds = 0.0_wp
   end type row_type

   type, public :: batch_type
      private
      type(row_type), allocatable :: rows(:)
      integer       :: n = 0
      integer(long) :: began = 0
   end type batch_type

contains

   !> A run of the COMMAND begins.
   subroutine start_run_of_batch(command, batch)
      type(command_type), intent(in)  :: command
      type(batch_type), intent(inout) :: batch

      if (.not. allocated(batch%rows)) allocate (batch%rows(size(command%decks)))
      call system_clock(batch%began)
   end subroutine start_run_of_batch

   !> It has ended: its row.
   subroutine end_run_of_batch(run, model, batch)
      type(run_type), intent(in)      :: run
      type(model_type), intent(in)    :: model
      type(batch_type), intent(inout) :: batch
      integer(long) :: now, rate

      batch%n = batch%n + 1
      call system_clock(now, rate)
      associate (row => batch%rows(batch%n), digest => run%results%digest)
         row%name = run%argument%name
         row%status = status_of(run%ending)
         row%seconds = real(now - batch%began, wp)/real(rate, wp)
         row%counts = [digest%stages, digest%increments, digest%iterations]
         if (digest%stages == 0) return
         row%figures = [digest%u_max, digest%mises_max, digest%contact, digest%safety, digest%frequency]
         row%is_there = [.true., model%n_elements > 0, size(model%joints) > 0, digest%safety < huge(1.0_wp), &
                         digest%frequency >= 0.0_wp]
         if (.not. allocated(run%results%watched%nodes)) return
         associate (watched => run%results%watched%nodes(1))
            row%node = model%node_id(watched%node)
            row%is_loaded = watched%is_loaded
            row%moves = watched%moves
            row%along = watched%along
            row%stiffness = watched%stiffness
         end associate
      end associate
   end subroutine end_run_of_batch

   !> All runs of COMMAND have ended: their table. OK is false where it cannot be written, which is said.
   subroutine end_batch(command, batch, ok)
      type(command_type), intent(in) :: command
      type(batch_type), intent(in)   :: batch
      logical, intent(out)           :: ok
      type(output_file_type)   :: screen, summary
      type(listing_table_type) :: table
      type(column_type), allocatable :: columns(:)
      character(name_width) :: name
      integer :: i
      logical :: shown

      call screen%start('')
      if (command%summary /= '') call summary%start(command%summary)
      call heading(screen, 'ALL RUNS')
      columns = [csv('deck'), column('', 'a41'), column('STATUS', 'i7', name='status'), csv('stages'), &
                 column('INCREMENTS', 'i11', name='increments'), csv('iterations'), &
                 column('U MAX', 'es12.4', name='u_max'), column('MISES MAX', 'es12.4', name='mises_max'), &
                 csv('contact'), column('CONTACT %', 'f10.2'), csv('safety'), column('MU N/T', 'f10.3'), &
                 column('FREQUENCY', 'es12.4', name='frequency'), csv(['watched', 'along  ']), &
                 column('STIFFNESS', 'es12.4', name='stiffness'), csv('seconds')]
      call table%start('', columns, screen)
      if (summary%is_open) call summary%put(csv_titles(columns))
      do i = 1, batch%n
         associate (row => batch%rows(i), f => batch%rows(i)%figures)
            name = row%name(max(1, len(row%name) - name_width + 1):)
            call table%add('"'//row%name//'"')
            call table%add(' '//name)
            call table%add([row%status, row%counts])
            call table%add([f(1:3), 100.0_wp*f(3), f(4), min(f(4), 99999.0_wp), f(5)], where=row%is_there([1, 2, 3, 3, 4, 4, 5]))
            call table%add([row%node], where=[row%node > 0])
            call table%add([row%along, row%stiffness], where=[row%is_loaded, row%moves])
            call table%add([row%seconds])
         end associate
         call table%print_row(screen, summary)
      end do
      ok = .true.
      if (command%summary /= '') call summary%finish(ok)
      if (.not. ok) write (error_unit, '(3a)') 'the summary ', command%summary, ' cannot be written'
      if (batch%n < 2 .or. command%check_only) return
      call screen%finish(shown)
      ok = ok .and. shown
   end subroutine end_batch

end module batch
