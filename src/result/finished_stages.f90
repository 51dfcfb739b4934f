!> What stays of a run that ends early: the results of its finished stages, marked ENDED EARLY.
!! At the end of each stage the files are marked. Where the run cannot continue, what was written behind the marks is dropped; where it
!! is interrupted or runs out of memory, incomplete_results shortens the files to the marks. (What METHOD = NEWTON has reached within
!! a stage is in equilibrium and stays too.) The mark of a CSV file cannot stand in the file: NAME.early names the files that end
!! early. A complete run removes NAME.early.
module finished_stages
   use body_values, only: body_values_type
   use bolt_answers, only: bolt_answer_type
   use equation_solver, only: failure_type
   use incomplete_results, only: forget_kept, keep_at_ends, say_at_interrupts
   use joint_answers, only: joint_answer
   use kinds, only: wp
   use output_file, only: output_file_type
   use restart_stream, only: restart_stream_type
   use result_names, only: early_ending, listing_ending
   use result_page, only: page_type, table_endings
   use text_tools, only: plural, upper
   use vtu_results, only: mark_vtu, return_to_mark_vtu, vtu_results_type
   implicit none
   private

   public :: count_increment, count_stage, count_frequencies, mark_finished, return_to_finished, name_companion, listing_end, &
             record_finished, record_counts

   !> The values of a run in a row of a batch.
   type, public :: digest_type
      integer  :: stages = 0, increments = 0, iterations = 0 !! completed; iterations or re-analyses
      real(wp) :: u_max = 0.0_wp, mises_max = 0.0_wp         !! the largest at the end of any stage [length], [pressure]
      real(wp) :: strained = 0.0_wp                          !! largest von Mises stress over E, likewise
      real(wp) :: contact = 1.0_wp                           !! smallest share of any joint, likewise
      real(wp) :: safety = huge(1.0_wp)                      !! smallest against slip, likewise; huge: none
      real(wp) :: bolt_force = huge(1.0_wp)                  !! smallest of a tightened bolt, likewise; huge: none [force]
      real(wp) :: bolt_use = -1.0_wp                         !! largest of a bolt, likewise; negative: none
      real(wp) :: frequencies(5) = -1.0_wp                   !! the first nonzero ones of the last stage with modes [1/time]
   end type digest_type

   !> The numbers of a run up to a place.
   type, public :: count_type
      type(digest_type) :: digest
      integer :: n_removed = 0  !! interface elements
      integer :: n_warnings = 0 !! of the listing
   end type count_type

   !> What the finished stages have.
   type, public :: finished_type
      character(:), allocatable :: place       !! 'stage 2, increment 5', their last; not allocated: no stage has ended
      type(count_type) :: counts
      integer, private :: n_stages = 0         ! of the deck
      type(output_file_type), private :: companion ! NAME.early as it will be if the run is interrupted
   contains
      procedure :: is_named
   end type finished_type

contains

   !> Whether NAME.early has its name: the run has ended early.
   pure logical function is_named(self)
      class(finished_type), intent(in) :: self

      is_named = self%companion%is_named
   end function is_named

   !> Count an increment with its iterations and the interface elements that were removed.
   pure subroutine count_increment(n_iterations, n_removed, counts)
      integer, intent(in)             :: n_iterations, n_removed
      type(count_type), intent(inout) :: counts

      counts%digest%increments = counts%digest%increments + 1
      counts%digest%iterations = counts%digest%iterations + n_iterations
      counts%n_removed = counts%n_removed + n_removed
   end subroutine count_increment

   !> Note what BODIES, JOINTS and BOLTS have at the end of a stage, which IS_COMPLETE or has ended early.
   pure subroutine count_stage(is_complete, bodies, joints, bolts, counts)
      logical, intent(in)                :: is_complete
      type(body_values_type), intent(in) :: bodies
      type(joint_answer), intent(in)     :: joints(:)
      type(bolt_answer_type), intent(in) :: bolts(:)
      type(count_type), intent(inout)    :: counts

      associate (digest => counts%digest)
         if (is_complete) digest%stages = digest%stages + 1
         digest%u_max = max(digest%u_max, bodies%displacement%value)
         digest%mises_max = max(digest%mises_max, bodies%at_node%value)
         digest%strained = max(digest%strained, bodies%strained)
         digest%contact = min(digest%contact, minval(joints%now%contact))
         digest%safety = min(digest%safety, minval(joints%safety, mask=joints%has_safety))
         digest%bolt_force = min(digest%bolt_force, minval(bolts%force, mask=bolts%is_locked))
         digest%bolt_use = max(digest%bolt_use, maxval(bolts%use, mask=bolts%has_strength))
      end associate
   end subroutine count_stage

   !> Note the first natural FREQUENCIES of the stage that has been completed last.
   pure subroutine count_frequencies(frequencies, counts)
      real(wp), intent(in)            :: frequencies(:) !! ascending [1/time]
      type(count_type), intent(inout) :: counts
      integer :: n

      n = min(size(frequencies), size(counts%digest%frequencies))
      counts%digest%frequencies = -1.0_wp
      counts%digest%frequencies(:n) = frequencies(:n)
   end subroutine count_frequencies

   !> Mark the files of PAGE and VTU, whose names begin with BASE, where one of N_STAGES has ended, and note the COUNTS.
   subroutine mark_finished(base, page, vtu, n_stages, counts, finished)
      character(*), intent(in)              :: base
      type(page_type), intent(inout)        :: page
      integer, intent(in)                   :: n_stages
      type(vtu_results_type), intent(inout) :: vtu
      type(count_type), intent(in)          :: counts
      type(finished_type), intent(inout)    :: finished
      integer :: i

      call page%file%mark()
      call page%screen%mark()
      do i = 1, size(table_endings)
         call page%tables(i)%mark()
      end do
      call mark_vtu(vtu)
      finished%place = page%place
      finished%counts = counts
      finished%n_stages = n_stages
      call watch_finished(base, page, finished)
   end subroutine mark_finished

   !> From now on keep the marked files, whose names begin with BASE, where the run is interrupted or runs out of memory; files for
   !! ParaView are not kept then. Nothing is kept where a file has failed.
   subroutine watch_finished(base, page, finished)
      character(*), intent(in)           :: base
      type(page_type), intent(in)        :: page
      type(finished_type), intent(inout) :: finished
      type(failure_type) :: interrupt
      character(:), allocatable :: words
      integer :: i

      call forget_kept()
      if (base == '' .or. .not. allocated(finished%place)) return
      call interrupt%raise('the run was interrupted, or had no memory left')
      call write_companion(base, page, finished%place, interrupt, finished%companion)
      if (finished%companion%fault .or. page%file%fault .or. any(page%tables%fault)) return
      call say_at_interrupts('')
      words = base//listing_ending//' keeps the stages that had ended, up to '//finished%place//', marked ENDED EARLY'
      call keep_at_ends(finished%companion%part, base//early_ending, finished%companion%kept, '', words)
      do i = 1, size(table_endings)
         associate (table => page%tables(i))
            if (table%is_open) call keep_at_ends(table%part, base//trim(table_endings(i)), table%kept, '', words)
         end associate
      end do
      call keep_at_ends(page%file%part, base//listing_ending, page%file%kept, &
                        listing_end(finished%n_stages, finished%counts, finished%place, interrupt), words)
   end subroutine watch_finished

   !> Drop what PAGE and VTU have of a stage that did not end, and take the COUNTS of the stages that did. ANY_ENDED is false where
   !! none did; nothing is changed then.
   subroutine return_to_finished(page, vtu, counts, finished, any_ended)
      type(page_type), intent(inout)        :: page
      type(vtu_results_type), intent(inout) :: vtu
      type(count_type), intent(inout)       :: counts
      type(finished_type), intent(in)       :: finished
      logical, intent(out)                  :: any_ended
      integer :: i

      any_ended = allocated(finished%place)
      if (.not. any_ended) return
      call page%file%return_to_mark()
      call page%screen%return_to_mark()
      do i = 1, size(table_endings)
         call page%tables(i)%return_to_mark()
      end do
      call return_to_mark_vtu(vtu)
      page%place = finished%place
      counts = finished%counts
   end subroutine return_to_finished

   !> Give NAME.early its name, NAME being BASE, where a FAILURE has ended the run; before that no file of such a run has its name.
   !! The file of an interrupt is discarded in any case.
   subroutine name_companion(base, page, failure, finished, ok)
      character(*), intent(in)           :: base
      type(page_type), intent(in)        :: page
      type(failure_type), intent(in)     :: failure
      type(finished_type), intent(inout) :: finished
      logical, intent(out)               :: ok

      ok = .true.
      call forget_kept()
      call finished%companion%discard()
      if (base == '' .or. .not. failure%raised) return
      call write_companion(base, page, page%place, failure, finished%companion)
      call finished%companion%finish(ok)
   end subroutine name_companion

   !> Write the file NAME.early, NAME being BASE, and close it; it has no name yet.
   subroutine write_companion(base, page, place, failure, file)
      character(*), intent(in)              :: base, place
      type(page_type), intent(in)           :: page
      type(failure_type), intent(in)        :: failure
      type(output_file_type), intent(inout) :: file
      character(:), allocatable :: name
      integer :: i

      name = base(index(base, '/', back=.true.) + 1:)
      call file%start(base//early_ending)
      call file%put('ENDED EARLY at '//place//'. Reason: '//failure%message)
      call file%put(name//listing_ending//': ENDED EARLY at '//place)
      do i = 1, size(table_endings)
         if (page%tables(i)%is_open) call file%put(name//trim(table_endings(i))//': ENDED EARLY at '//place)
      end do
      call file%mark()
      call file%close()
   end subroutine write_companion

   !> The last lines of the listing of N_STAGES stages with COUNTS, each with its end. PLACE is the end of the results where a FAILURE
   !! has ended the run.
   pure function listing_end(n_stages, counts, place, failure) result(lines)
      integer, intent(in)            :: n_stages
      type(count_type), intent(in)   :: counts
      character(*), intent(in)       :: place
      type(failure_type), intent(in) :: failure
      character(:), allocatable      :: lines
      character(1), parameter :: nl = new_line('a')

      lines = nl//' END OF LISTING   '
      if (failure%raised) lines = nl//' *** THE RUN ENDED EARLY, ABOVE IS WHAT IT HAS UP TO '//upper(place)//' ***'//nl//'  '// &
                               upper(failure%message)//nl//nl//' ENDED EARLY   AT '//upper(place)//': '
      lines = lines//upper(plural(n_stages, 'stage')//', '//plural(counts%digest%increments, 'increment')//', '// &
              plural(counts%n_removed, 'interface element')//' removed, '//plural(counts%n_warnings, 'warning'))//nl
   end function listing_end

   !> Write to a restart file, or read, what the finished stages have; the marks are in the files themselves.
   subroutine record_finished(stream, base, page, finished)
      type(restart_stream_type), intent(inout) :: stream
      character(*), intent(in)                 :: base
      type(page_type), intent(in)              :: page
      type(finished_type), intent(inout)       :: finished

      call stream%part('finished_type', 1)
      call stream%text('place', finished%place)
      call stream%item('n_stages', finished%n_stages)
      call record_counts(stream, finished%counts)
      if (.not. (stream%writes .or. allocated(stream%fault))) call watch_finished(base, page, finished)
   end subroutine record_finished

   subroutine record_counts(stream, counts)
      type(restart_stream_type), intent(inout) :: stream
      type(count_type), intent(inout)          :: counts

      call stream%part('count_type', 1)
      call stream%item('n_removed', counts%n_removed)
      call stream%item('n_warnings', counts%n_warnings)
      call record_digest(stream, counts%digest)
   end subroutine record_counts

   subroutine record_digest(stream, d)
      type(restart_stream_type), intent(inout) :: stream
      type(digest_type), intent(inout)         :: d

      call stream%part('digest_type', 2)
      call stream%item('stages', d%stages)
      call stream%item('increments', d%increments)
      call stream%item('iterations', d%iterations)
      call stream%item('u_max', d%u_max)
      call stream%item('mises_max', d%mises_max)
      call stream%item('strained', d%strained)
      call stream%item('contact', d%contact)
      call stream%item('safety', d%safety)
      call stream%item('bolt_force', d%bolt_force)
      call stream%item('bolt_use', d%bolt_use)
      call stream%item('frequencies', d%frequencies)
   end subroutine record_digest

end module finished_stages
