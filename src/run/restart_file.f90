!> Writes and reads the restart file NAME.restart: the state for the next increments, and the results so far.
!! RESTART asks for the file, and another run continues from it with --resume. A state at the end of a stage from which a later
!! stage starts, FROM, is kept in memory in the same form, and in the file.
!!
!! The factors of the equations and the earlier solutions are too large for the file. The resumed run computes them anew, and the
!! run that wrote the file discards them too: both runs then agree to the last digit. The model is built from the deck.
module restart_file
   use analysis_record, only: record_analysis
   use analysis_state, only: analysis_type, interface_stiffness, start_analysis
   use bolt_locking, only: lock_again, lock_bolts, release_bolts, tightens
   use c_library, only: c_fsync, close_file, is_regular_file, read_all_bytes, remove_file
   use control_words, only: no_restart, restart_stages
   use deck_input, only: deck_type
   use deck_text, only: checksum_of
   use equation_solver, only: equation_system
   use equations, only: form_body_stiffness, start_equations
   use incomplete_results, only: create_part, name_part, say_at_interrupts
   use kinds, only: long
   use model_data, only: freedoms_type, model_type
   use run_of_deck, only: goes_on, is_over, is_refused, run_type, tell
   use restart_stream, only: open_restart, restart_stream_type
   use result_names, only: restart_ending
   use results, only: record_reference, record_results, return_to_rest
   use stage_plan, only: factorisations_of, solves_once, stage_plan_type, where_in_plan
   use support_change, only: hand_over, hold_anew
   use terminal, only: version
   use text_tools, only: integer_text, one_of
   implicit none
   private

   public :: open_restart_file, take_up, write_restart, go_to_start

contains

   !> Look for a restart file of DECK. Without one the run begins at the start. A damaged file, or one of another deck or another
   !! version of the program, ends the run.
   subroutine open_restart_file(deck, run)
      type(deck_type), intent(in)   :: deck
      type(run_type), intent(inout) :: run
      character(:), allocatable :: bytes, name
      logical :: there, readable

      name = run%argument%base//restart_ending
      inquire (file=name, exist=there)
      if (.not. there) then
         call tell(run, 'there is no '//name//', the run '// &
                       one_of(run%check_only, 'would start from the beginning', 'starts from the beginning'))
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
      if (run%check_only) call tell(run, name//' is complete and belongs to this deck and this program')
   end subroutine open_restart_file

   !> TAKE UP FROM THE RESTART FILE: the state of ANALYSIS, of the bolts in the equations of SYSTEM, and the results so far.
   subroutine take_up(run, deck, model, plan, system, analysis)
      type(run_type), intent(inout)         :: run
      type(deck_type), intent(in)           :: deck
      type(model_type), intent(inout)       :: model
      type(stage_plan_type), intent(in)     :: plan
      class(equation_system), intent(inout), allocatable :: system
      type(analysis_type), intent(inout)    :: analysis
      character(:), allocatable :: name, words

      if (is_over(run) .or. .not. run%resumes) return
      call run%restart%item('supports', analysis%supports)
      call take_supports(run, deck, plan, max(1, min(analysis%supports, size(plan%first_with))), 0, model, system)
      if (run%failure%raised) return
      if (model%supports /= 1) call start_analysis(model, system, deck%control, analysis)
      call record_analysis(run%restart, analysis)
      call record_results(run%restart, run%results)
      run%problem = ''
      if (.not. run%restart%is_at_end()) then
         run%problem = 'it holds more than the state of this deck'
         if (allocated(run%restart%fault)) run%problem = run%restart%fault
      else if (analysis%stage < 1 .or. analysis%stage > size(plan%stages)) then
         run%problem = 'the deck has no such stage and increment'
      else if (analysis%increment < 1 .or. analysis%increment > size(plan%stages(analysis%stage)%fractions)) then
         run%problem = 'the deck has no such stage and increment'
      end if
      if (run%problem /= '') run%ending = is_refused
      if (run%problem /= '') return
      run%restart = restart_stream_type() ! free its bytes
      call lock_again(model, analysis, system)
      call system%forget_past()
      analysis%goes_on = analysis%increment < size(plan%stages(analysis%stage)%fractions)
      name = run%argument%base//restart_ending
      call say_at_interrupts(run%argument%name//': interrupted; '//name//' stays as it was')
      words = ' after stage '//integer_text(plan%stages(analysis%stage)%id)//', increment '//integer_text(analysis%increment)
      if (allocated(analysis%kept)) then
         words = words//', '//integer_text(size(analysis%kept, 2))//' amplitudes of its backbone done'
      else if (analysis%stage == size(plan%stages) .and. .not. analysis%goes_on) then
         words = ', where the run is complete; its results are written again'
      end if
      call tell(run, 'resumed from '//name//words)
   end subroutine take_up

   !> WRITE THE RESTART FILE at the end of a stage, and after every n increments where RESTART gives n; otherwise do nothing. A new
   !! file is written beside the older one, which it replaces when it is complete. If it cannot be written, the run continues.
   subroutine write_restart(run, deck, plan, system, analysis)
      type(run_type), intent(inout)         :: run
      type(deck_type), intent(in)           :: deck
      type(stage_plan_type), intent(in)     :: plan
      class(equation_system), intent(inout), allocatable :: system
      type(analysis_type), intent(inout)    :: analysis
      type(restart_stream_type) :: stream
      character(:), allocatable :: name, part
      integer :: descriptor
      logical :: closed, ok

      if (is_over(run) .or. run%argument%base == '' .or. deck%control%restart == no_restart) return
      if (analysis%increment < size(plan%stages(analysis%stage)%fractions)) then
         if (deck%control%restart == restart_stages) return
         if (modulo(analysis%increment, deck%control%restart) /= 0) return
      end if
      if (run%deck_sum == 0) run%deck_sum = checksum_of(deck%text)
      name = run%argument%base//restart_ending
      call create_part(name, part, descriptor)
      ok = descriptor >= 0
      if (ok) then
         call stream%start(descriptor, version, run%deck_sum)
         call stream%item('supports', analysis%supports)
         call record_analysis(stream, analysis)
         call record_results(stream, run%results)
         call stream%complete(ok)
         if (ok) ok = c_fsync(descriptor) == 0 ! before the older one is replaced: a power failure leaves one of the two
         call close_file(descriptor, closed)
         ok = ok .and. closed
         if (ok) then
            call name_part(part, name, ok, stays=.true.)
         else
            call remove_file(part)
         end if
      end if
      if (ok) then
         call say_at_interrupts(run%argument%name//': interrupted; '//name//' keeps the state behind '// &
                                where_in_plan(plan, analysis%stage, analysis%increment)//': --resume goes on from there')
      else if (.not. run%misses_output) then
         call tell(run, 'the restart file '//name//' cannot be written; the run continues')
         run%misses_output = .true.
      end if
      call system%forget_past()
   end subroutine write_restart

   !> FROM: keep the state at the end of the stage just completed, its bolts locked, if a later stage starts from it. Where the next
   !! stage starts from an earlier one, return to the state that this one left. Bolts that the next stage tightens again are released.
   !! The bodies are formed anew only where other bolts are locked now. An independent case starts from rest. A stage with other
   !! supports or equations changes them.
   subroutine go_to_start(run, deck, model, plan, system, analysis)
      type(run_type), intent(inout)         :: run
      type(deck_type), intent(in)           :: deck
      type(model_type), intent(inout)       :: model
      type(stage_plan_type), intent(in)     :: plan
      class(equation_system), intent(inout), allocatable :: system
      type(analysis_type), intent(inout)    :: analysis
      type(restart_stream_type) :: stream
      logical, allocatable :: locked(:)
      integer :: done, next

      if (analysis%goes_on .or. analysis%stage == 0) return
      done = analysis%stage
      next = analysis%next
      associate (from => model%history%stages%from)
         if (any(from(next + 1:) == done)) then
            call lock_bolts(model, system, analysis)
            stream%writes = .true.
            stream%bytes = ''
            call record_analysis(stream, analysis)
            call record_reference(stream, run%results)
            run%results%kept(done)%words = stream%bytes(:stream%used)
         end if
         if (from(next) == 0) then
            call take_supports(run, deck, plan, plan%stages(next)%supports, next, model, system)
            if (run%failure%raised) return
            call start_analysis(model, system, deck%control, analysis)
            call interface_stiffness(model, system, analysis, run%failure)
            call return_to_rest(model, run%results)
            analysis%next = next
            return
         end if
         if (from(next) == done) then
            call change_supports(run, deck, plan, next, 0, model, system, analysis)
            if (run%failure%raised .or. .not. tightens(model, next)) return
            call lock_bolts(model, system, analysis)
         end if
         allocate (locked, source=[analysis%is_elastic, analysis%is_locked])
         if (from(next) /= done) then
            if (model%supports /= plan%stages(from(next))%supports) then
               call take_supports(run, deck, plan, plan%stages(from(next))%supports, next, model, system)
               if (run%failure%raised) return
               call start_analysis(model, system, deck%control, analysis)
               locked = [analysis%is_elastic, analysis%is_locked] ! no bolt: the equations are new
            end if
            stream%writes = .false.
            stream%bytes = run%results%kept(from(next))%words
            stream%last = len(stream%bytes, long)
            stream%used = 0
            call record_analysis(stream, analysis)
            call record_reference(stream, run%results)
            if (allocated(stream%fault)) call run%failure%raise('FROM: the kept state cannot be read: '//stream%fault)
            analysis%next = next
         end if
         call release_bolts(model, next, analysis)
         if (any(locked .neqv. [analysis%is_elastic, analysis%is_locked])) then
            call start_equations(model, system, run%failure, deck%control%solver, factorisations_of(plan, deck%control%method), &
                                 solves_once=solves_once(plan, deck%control%method))
            if (.not. run%failure%raised) call form_body_stiffness(model, system, run%failure, where_in_plan(plan, next, 1))
            if (run%failure%raised) return
            call lock_again(model, analysis, system)
         end if
         if (from(next) == done) return
         call system%forget_past()
         if (all(from(next + 1:) /= from(next))) deallocate (run%results%kept(from(next))%words)
         call change_supports(run, deck, plan, next, next, model, system, analysis)
      end associate
   end subroutine go_to_start

   !> Put the freedoms K of MODEL in force, with their equations. Those of independent cases are kept where a stage from NEXT on has
   !! them.
   subroutine take_supports(run, deck, plan, k, next, model, system)
      type(run_type), intent(inout)         :: run
      type(deck_type), intent(in)           :: deck
      type(stage_plan_type), intent(in)     :: plan
      integer, intent(in)                   :: k, next
      type(model_type), intent(inout)       :: model
      class(equation_system), intent(inout), allocatable :: system

      if (k == model%supports) return
      if (.not. allocated(run%kept)) allocate (run%kept(size(model%sets)))
      if (plan%is_independent .and. any(plan%stages(max(1, next):)%supports == model%supports)) &
         call move_alloc(system, run%kept(model%supports)%system)
      model%supports = k
      model%freedoms = model%sets(k)
      if (allocated(run%kept(k)%system)) then
         call move_alloc(run%kept(k)%system, system)
         return
      end if
      call start_equations(model, system, run%failure, deck%control%solver, factorisations_of(plan, deck%control%method), &
                           solves_once=solves_once(plan, deck%control%method))
      if (.not. run%failure%raised) call form_body_stiffness(model, system, run%failure, where_in_plan(plan, max(1, next), 1))
   end subroutine take_supports

   !> Change the supports and the equations of a history to those of the stage NEXT, where these are others, and say so in the
   !! listing. Bolts that stage AGAIN tightens, 0: none, have been released before.
   subroutine change_supports(run, deck, plan, next, again, model, system, analysis)
      type(run_type), intent(inout)         :: run
      type(deck_type), intent(in)           :: deck
      type(stage_plan_type), intent(in)     :: plan
      integer, intent(in)                   :: next, again
      type(model_type), intent(inout)       :: model
      class(equation_system), intent(inout), allocatable :: system
      type(analysis_type), intent(inout)    :: analysis
      type(freedoms_type) :: before
      integer :: held, released
      logical :: other

      associate (k => plan%stages(next)%supports)
         if (k == model%supports) return
         call lock_bolts(model, system, analysis, again)
         associate (stages => deck%control%stages(plan%first_with([model%supports, k])))
            other = stages(1)%equations%id /= stages(2)%equations%id
         end associate
         call hand_over(model, model%sets(k), other, analysis, released)
         before = model%freedoms
         call take_supports(run, deck, plan, k, next, model, system)
         if (run%failure%raised) return
         call hold_anew(model, before, other, system, analysis, held)
         analysis%supports = k
      end associate
      call run%results%page%file%put('')
      call run%results%page%file%put(' SUPPORTS OF STAGE '//integer_text(plan%stages(next)%id)//': '//integer_text(released)// &
         ' COMPONENTS RELEASED, THEIR FORCES DECREASE TO ZERO OVER THE STAGE; '//integer_text(held)// &
         ' HELD ANEW WHERE THEY STAND')
      if (other) call run%results%page%file%put(' EQUATIONS OF STAGE '//integer_text(plan%stages(next)%id)//': LIKEWISE')
   end subroutine change_supports

end module restart_file
