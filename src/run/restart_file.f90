!> Writes and reads the restart file NAME.restart: the state for the next increments, and the results so far.
!! RESTART asks for the file, and another run continues from it with --resume.
!!
!! The factors of the equations and the earlier solutions are too large for the file. The resumed run computes them anew, and the run
!! that wrote the file discards them too: both runs then agree to the last digit. The model is built from the deck.
module restart_file
   use analysis_state, only: analysis_type, load_state
   use bolt_locking, only: lock_again
   use c_library, only: close_file, is_regular_file, keep_on_disk, read_all_bytes, remove_file
   use case_control, only: no_restart, restart_stages
   use deck_input, only: deck_type
   use deck_text, only: checksum_of
   use equation_solver, only: equation_system
   use incomplete_results, only: create_part, name_part, say_at_interrupts
   use model_data, only: model_type
   use progress, only: goes_on, is_over, is_refused, run_type
   use restart_stream, only: open_restart, restart_stream_type
   use results, only: record_results, restart_ending
   use stage_plan, only: stage_plan_type, where_in_plan
   use terminal, only: say_line, version
   use text_tools, only: integer_text
   implicit none
   private

   public :: open_restart_file, take_up, write_restart, restart_name, record_analysis

contains

   !> The restart file of a run whose results begin with BASE.
   pure function restart_name(base) result(name)
      character(*), intent(in)  :: base
      character(:), allocatable :: name

      name = base//restart_ending
   end function restart_name

   !> Look for a restart file of DECK. Without one the run begins at the start. A damaged file, or one of another deck or another
   !! version of the program, ends the run.
   subroutine open_restart_file(deck, run)
      type(deck_type), intent(in)   :: deck
      type(run_type), intent(inout) :: run
      character(:), allocatable :: bytes, name
      logical :: there, readable

      name = restart_name(run%argument%base)
      inquire (file=name, exist=there)
      if (.not. there) then
         call say_line(run%argument%name//': there is no '//name//', the run '// &
                       trim(merge('would start from the beginning', 'starts from the beginning     ', run%check_only)))
         return
      end if
      run%ending = is_refused
      run%problem = 'it cannot be read'
      readable = is_regular_file(name)
      if (readable) call read_all_bytes(name, bytes, readable)
      if (.not. readable) return
      call open_restart(bytes, version, checksum_of(deck%text), run%restart, run%problem)
      if (run%problem /= '') return
      run%resumes = .not. run%check_only
      run%ending = goes_on
      if (run%check_only) call say_line(run%argument%name//': '//name//' is complete and belongs to this deck and this program')
   end subroutine open_restart_file

   !> TAKE UP FROM THE RESTART FILE: the state of ANALYSIS, of the bolts in the equations of SYSTEM, and the results so far.
   subroutine take_up(run, model, plan, system, analysis)
      type(run_type), intent(inout)         :: run
      type(model_type), intent(in)          :: model
      type(stage_plan_type), intent(in)     :: plan
      class(equation_system), intent(inout), allocatable :: system
      type(analysis_type), intent(inout)    :: analysis
      character(:), allocatable :: words
      integer :: s

      if (is_over(run) .or. .not. run%resumes) return
      call record_analysis(run%restart, analysis)
      call record_results(run%restart, run%results)
      if (.not. run%restart%is_at_end()) then
         run%ending = is_refused
         run%problem = 'it holds more than the state of this deck'
         if (allocated(run%restart%fault)) run%problem = run%restart%fault
      else if (.not. is_in_plan(plan, analysis)) then
         run%ending = is_refused
         run%problem = 'the deck has no such stage and increment'
      end if
      if (is_over(run)) return
      run%restart = restart_stream_type() ! free its bytes
      call lock_again(model, analysis, system)
      call system%forget_past()
      analysis%goes_on = analysis%increment < size(plan%stages(analysis%stage)%fractions)
      call say_at_interrupts(run%argument%name//': interrupted; '//restart_name(run%argument%base)//' stays as it was')
      call run%progress%expect(plan, sum([(size(plan%stages(s)%fractions), s = 1, analysis%stage - 1)]) + analysis%increment)
      words = ': resumed from '//restart_name(run%argument%base)//' after stage '// &
              integer_text(plan%stages(analysis%stage)%id)//', increment '//integer_text(analysis%increment)
      if (allocated(analysis%kept)) then
         words = words//', '//integer_text(size(analysis%kept, 2))//' amplitudes of its backbone done'
      else if (analysis%stage == size(plan%stages) .and. .not. analysis%goes_on) then
         words = ': resumed from '//restart_name(run%argument%base)//', where the run is complete; its results are written again'
      end if
      call say_line(run%argument%name//words)
   end subroutine take_up

   !> Whether PLAN has the stage and the increment of ANALYSIS.
   pure logical function is_in_plan(plan, analysis)
      type(stage_plan_type), intent(in) :: plan
      type(analysis_type), intent(in)   :: analysis

      is_in_plan = analysis%stage >= 1 .and. analysis%stage <= size(plan%stages)
      if (is_in_plan) is_in_plan = analysis%increment >= 1 .and. analysis%increment <= size(plan%stages(analysis%stage)%fractions)
   end function is_in_plan

   !> WRITE THE RESTART FILE at the end of a stage, and after every n increments where RESTART gives n; otherwise do nothing. If it cannot
   !! be written, the run continues and an older file stays.
   subroutine write_restart(run, deck, plan, system, analysis)
      type(run_type), intent(inout)         :: run
      type(deck_type), intent(in)           :: deck
      type(stage_plan_type), intent(in)     :: plan
      class(equation_system), intent(inout), allocatable :: system
      type(analysis_type), intent(inout)    :: analysis
      logical :: ok

      if (is_over(run) .or. run%argument%base == '' .or. deck%control%restart == no_restart) return
      if (analysis%increment < size(plan%stages(analysis%stage)%fractions)) then
         if (deck%control%restart == restart_stages) return
         if (modulo(analysis%increment, deck%control%restart) /= 0) return
      end if
      if (run%deck_sum == 0) run%deck_sum = checksum_of(deck%text)
      call write_state(run, analysis, ok)
      if (.not. (ok .or. run%misses_restart)) call say_line(run%argument%name//': the restart file '// &
         restart_name(run%argument%base)//' cannot be written; the run continues')
      run%misses_restart = run%misses_restart .or. .not. ok
      if (ok) call say_at_interrupts(run%argument%name//': interrupted; '//restart_name(run%argument%base)// &
         ' keeps the state behind '//where_in_plan(plan, analysis%stage, analysis%increment)//': --resume goes on from there')
      call system%forget_past()
   end subroutine write_restart

   !> Write a new file beside the older one, and replace the older one when the new one is complete.
   subroutine write_state(run, analysis, ok)
      type(run_type), intent(inout)      :: run
      type(analysis_type), intent(inout) :: analysis
      logical, intent(out)               :: ok
      type(restart_stream_type) :: stream
      character(:), allocatable :: part
      integer :: descriptor
      logical :: closed

      call create_part(restart_name(run%argument%base), part, descriptor)
      ok = descriptor >= 0
      if (.not. ok) return
      call stream%start(descriptor, version, run%deck_sum)
      call record_analysis(stream, analysis)
      call record_results(stream, run%results)
      call stream%complete(ok)
      if (ok) call keep_on_disk(descriptor, ok) ! before the older one is replaced: a power failure leaves one of the two
      call close_file(descriptor, closed)
      if (ok .and. closed) then
         call name_part(part, restart_name(run%argument%base), ok, stays=.true.)
      else
         call remove_file(part)
         ok = .false.
      end if
   end subroutine write_state

   !> Write A, or read it into one that start_analysis has just made for the same model. Two components are left out: condensed, which
   !! does not change in an increment and which the first increment prints, and goes_on, which is true only while the run resumes.
   subroutine record_analysis(stream, a)
      type(restart_stream_type), intent(inout) :: stream
      type(analysis_type), intent(inout)       :: a
      integer :: n_loaded, n_slips, rows, columns

      call stream%item(a%stage, a%increment, a%increment_fraction, a%fraction, a%carry, a%eq10)
      call stream%item(a%average, a%is_loose, a%loose_force, a%load_tolerance, a%tolerance)
      call record_loads(stream, a%before)
      call record_loads(stream, a%after)
      call record_loads(stream, a%now)
      n_loaded = 0
      if (stream%writes) n_loaded = size(a%loaded)
      call stream%extent(n_loaded, 4)
      if (.not. stream%writes) allocate (a%loaded(n_loaded))
      call stream%item(a%loaded, a%is_moved, a%moves, a%all_u, a%all_unbalanced, a%retained_index)
      ! of retained nodes, bars and sections
      call stream%item(a%held, a%change, a%move, a%body, a%u, a%du)
      call stream%item(a%unbalanced, a%is_elastic, a%pull, a%is_locked)
      ! of interface elements and joints
      call stream%item(a%states, a%movement, a%k, a%turns, a%next_kind)
      if (allocated(a%exact)) call stream%item(a%exact)
      call stream%item(a%energy, a%largest_p, a%largest_lambda, a%largest_load)
      rows = 0
      columns = 0
      if (allocated(a%kept)) rows = size(a%kept, 1)
      if (allocated(a%kept)) columns = size(a%kept, 2)
      call stream%extent(rows, 8)
      call stream%extent(columns, 8)
      if (.not. stream%writes .and. columns > 0) allocate (a%kept(rows, columns))
      if (columns > 0) call stream%item(a%kept)
      associate (record => a%record)
         call stream%item(record%condition, record%kind, record%n_removed, record%n_parts)
         call stream%item(record%ends_early, record%is_partial, record%is_settled)
         call stream%extent(record%n_iterations, 32)
         n_slips = size(record%slips)
         call stream%extent(n_slips, 88)
         if (record%n_iterations > size(record%iterations)) then
            deallocate (record%iterations)
            allocate (record%iterations(record%n_iterations))
         end if
         if (n_slips /= size(record%slips)) then
            deallocate (record%slips)
            allocate (record%slips(n_slips))
         end if
         call stream%item(record%iterations(:record%n_iterations), record%slips)
      end associate
   end subroutine record_analysis

   subroutine record_loads(stream, at)
      type(restart_stream_type), intent(inout) :: stream
      type(load_state), intent(inout)          :: at
      integer :: n

      call stream%item(at%load, at%moved, at%condensed_load)
      associate (temperature => at%temperature)
         n = -1
         if (allocated(temperature%at)) n = size(temperature%at)
         call stream%extent(n, 8)
         if (.not. stream%writes) then
            if (allocated(temperature%at)) deallocate (temperature%at)
            if (n >= 0) allocate (temperature%at(n))
         end if
         if (n >= 0) call stream%item(temperature%at)
         call stream%item(temperature%reference_share)
         n = -1
         if (allocated(temperature%plate)) n = size(temperature%plate, 2)
         call stream%extent(n, 40)
         if (.not. stream%writes) then
            if (allocated(temperature%plate)) deallocate (temperature%plate)
            if (n >= 0) allocate (temperature%plate(5, n))
         end if
         if (n >= 0) call stream%item(temperature%plate)
      end associate
   end subroutine record_loads

end module restart_file
