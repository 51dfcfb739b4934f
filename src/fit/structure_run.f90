!> A run of a deck with given values of its parameters, without listing and tables: the answers to the rows of a measured file.
!! Parameters that only laws and loads use leave the bodies as they are: such runs share the factor of their static part.
module structure_run
   use analysis_state, only: analysis_type, interface_stiffness, note_largest, start_analysis
   use back_method, only: back_increment
   use bolt_locking, only: lock_again, lock_bolts
   use control_words, only: method_back, method_newton, method_step
   use deck_errors, only: deck_error_list
   use deck_input, only: deck_type, read_deck
   use deck_parameters, only: parameter_type
   use equation_solver, only: equation_system, failure_type
   use equations, only: form_body_stiffness, start_equations
   use finite_state, only: check_state
   use kinds, only: wp
   use load_path, only: recover_bodies, start_increment, start_stage
   use measured_data, only: a_bolt, a_loss, a_stiffness, measured_row, measured_type
   use mode_span, only: span_modes
   use model_build, only: build_model
   use model_data, only: model_type
   use newton_method, only: close_gaps, crosses_gaps, newton_increment, seat_joints
   use stage_plan, only: factorisations_of, stage_plan_type
   use step_method, only: accumulate, limit_friction, solve_increment, structure_stiffness
   use structure_answers, only: answer_type, is_of_modes, structure_type, take_stage
   use text_tools, only: integer_text
   use watched_nodes, only: start_watched, watch_state
   implicit none
   private

   public :: start_structure, run_structure

   character(*), parameter :: of_laws = & ! cards on which no body depends
      ' JNORM JSHEAR JIWAN PJOINT BOLT FORCE FORCEM MOMENT PLOAD PLOAD2 PLOAD4 PLOADE PLOADM GRAV LOAD '

contains

   !> The parameters with their VALUES as the deck is to be filled with.
   subroutine set_parameters(structure, data, values, parameters)
      type(structure_type), intent(in)               :: structure
      type(measured_type), intent(in)                :: data
      real(wp), intent(in)                           :: values(:)
      type(parameter_type), allocatable, intent(out) :: parameters(:)
      character(24) :: text
      integer :: i

      allocate (parameters(size(values) + size(structure%set)))
      do i = 1, size(values)
         write (text, '(es23.15e3)') values(i)
         parameters(i)%name = data%parameters(i)%name
         parameters(i)%value = trim(adjustl(text))
         parameters(i)%is_long = .true.
      end do
      parameters(size(values) + 1:) = structure%set
   end subroutine set_parameters

   !> Read the deck of STRUCTURE with the start values of DATA, build it and form its bodies. OF_DATA takes the rows that do not fit
   !! the deck.
   subroutine start_structure(data, structure, errors, of_data, readable, failure)
      type(measured_type), intent(in)      :: data
      type(structure_type), intent(inout)  :: structure
      type(deck_error_list), intent(inout) :: errors, of_data
      logical, intent(out)                 :: readable
      type(failure_type), intent(inout)    :: failure
      type(parameter_type), allocatable :: parameters(:)
      character(:), allocatable :: card, cards
      integer :: i

      structure%watched = ''
      do i = 1, size(data%rows)
         associate (row => data%rows(i))
            if (row%nodes(2) == 0 .and. row%kind /= a_stiffness) cycle
            structure%watched = structure%watched//','//integer_text(row%nodes(1))
            if (row%nodes(2) > 0) structure%watched = structure%watched//'-'//integer_text(row%nodes(2))
         end associate
      end do
      structure%watched = structure%watched(2:)
      call set_parameters(structure, data, data%parameters%start, parameters)
      call read_deck(structure%path, structure%deck, errors, readable, parameters, structure%watched)
      if (.not. readable) return
      allocate (structure%keeps_bodies(size(data%parameters)), source=.true.)
      do i = 1, size(data%parameters)
         associate (parameter => structure%deck%text%parameters(i))
            cards = ''
            if (allocated(parameter%cards)) cards = trim(adjustl(parameter%cards))
            do while (cards /= '')
               card = cards(:index(cards//' ', ' ') - 1)
               structure%keeps_bodies(i) = structure%keeps_bodies(i) .and. index(of_laws, ' '//card//' ') > 0
               cards = trim(adjustl(cards(len(card) + 1:)))
            end do
         end associate
      end do
      call build_model(structure%deck, structure%model, structure%plan, errors)
      if (errors%any()) return
      do i = 1, size(data%rows)
         call check_row(structure, data%rows(i), of_data)
      end do
      if (of_data%any()) return
      call form(structure%deck, structure%model, structure%plan, structure%system, failure)
   end subroutine start_structure

   !> Whether STRUCTURE can answer ROW.
   subroutine check_row(structure, row, errors)
      type(structure_type), intent(in)     :: structure
      type(measured_row), intent(in)       :: row
      type(deck_error_list), intent(inout) :: errors
      character(:), allocatable :: lack
      integer :: k, s

      associate (mesh => structure%model%mesh, stages => structure%plan%stages)
         s = findloc(stages%id, row%stage, dim=1)
         lack = ''
         if (s == 0) lack = 'stage='//integer_text(row%stage)//': the deck has no such SUBCASE'
         do k = 1, size(row%shape) + 2
            if (k > size(row%shape)) then
               if (row%nodes(k - size(row%shape)) == 0) cycle
               if (mesh%node_table%find(row%nodes(k - size(row%shape))) > 0) cycle
               lack = 'node='//integer_text(row%nodes(k - size(row%shape)))
            else
               if (mesh%node_table%find(row%at(1, k)) > 0 .and. row%at(2, k) <= mesh%dimension) cycle
               lack = 'shape='//integer_text(row%at(1, k))
            end if
            lack = lack//': the model has no such node or direction'
         end do
         if (row%direction > mesh%dimension) lack = 'direction=z: the model lies in the plane'
         if (row%kind == a_bolt .and. all(mesh%bars%bolt /= row%bolt) .and. all(mesh%sections%bolt /= row%bolt)) &
            lack = 'bolt='//integer_text(row%bolt)//': the deck has no such BOLT'
         if (lack == '' .and. is_of_modes(row)) then
            if (.not. allocated(stages(s)%vibration)) then
               lack = 'SUBCASE '//integer_text(row%stage)//' has no MODES'
            else if (row%kind == a_loss .and. .not. (stages(s)%vibration%has_losses .or. row%amplitude > 0.0_wp)) then
               lack = 'SUBCASE '//integer_text(row%stage)//' has no loss factors: expected GE, PARAM,G or AMPLITUDE, or amplitude='
            else if (row%frequency > 0.0_wp .and. .not. allocated(stages(s)%vibration%response)) then
               lack = 'SUBCASE '//integer_text(row%stage)//' has no FREQUENCY and DLOAD'
            else if (row%amplitude > 0.0_wp .and. .not. allocated(stages(s)%vibration%backbone)) then
               lack = 'SUBCASE '//integer_text(row%stage)//' has no BACKBONE'
            else if (row%amplitude > 0.0_wp) then
               if (stages(s)%vibration%backbone%mode /= row%mode) lack = 'mode='//integer_text(row%mode)// &
                  ': BACKBONE follows mode '//integer_text(stages(s)%vibration%backbone%mode)
            end if
         end if
         if (lack /= '') call errors%add(row%line, lack)
      end associate
   end subroutine check_row

   !> Order the equations and form the bodies.
   subroutine form(deck, model, plan, system, failure)
      type(deck_type), intent(in)       :: deck
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      class(equation_system), allocatable, intent(out) :: system
      type(failure_type), intent(inout) :: failure

      call start_equations(model, system, failure, deck%control%solver, factorisations_of(plan, deck%control%method))
      if (.not. failure%raised) call form_body_stiffness(model, system, failure)
   end subroutine form

   !> Run STRUCTURE with VALUES of its parameters. NEAR is the answer of a run nearby, whose modes serve where frequencies alone are
   !! asked for. The run uses up the equations of STRUCTURE: it is the last of its process.
   subroutine run_structure(data, values, structure, answer, near)
      type(measured_type), intent(in)         :: data
      real(wp), intent(in)                    :: values(:)
      type(structure_type), intent(inout)     :: structure
      type(answer_type), intent(out)          :: answer
      type(answer_type), intent(in), optional :: near
      type(parameter_type), allocatable :: parameters(:)
      type(analysis_type), allocatable :: kept(:)
      type(watch_state), allocatable   :: ends(:) ! of the stages; the first one is at rest
      type(deck_error_list) :: errors
      type(failure_type)    :: failure
      type(analysis_type)   :: analysis
      logical, allocatable  :: locked(:)
      logical :: is_near, readable
      integer :: from, i, s

      call set_parameters(structure, data, values, parameters)
      call read_deck(structure%path, structure%deck, errors, readable, parameters, structure%watched)
      if (.not. errors%any()) call build_model(structure%deck, structure%model, structure%plan, errors)
      is_near = present(near)
      if (is_near) is_near = all(abs(values - near%set) <= 0.0_wp .or. structure%keeps_bodies)
      answer%fault = ''
      if (errors%any()) answer%fault = errors%items(1)%message
      if (answer%fault /= '') return
      associate (deck => structure%deck, model => structure%model, plan => structure%plan, system => structure%system, &
                 n => size(data%rows))
         allocate (answer%value(n), answer%shapes(size(model%freedoms%held), n), source=0.0_wp)
         allocate (answer%mac(n), source=1.0_wp)
         allocate (answer%off_number(n), source=0.0_wp)
         allocate (answer%mode(n), source=0)
         allocate (answer%stages(size(plan%stages)), kept(size(plan%stages)), ends(0:size(plan%stages)))
         if (any(abs(values - data%parameters%start) > 0.0_wp .and. .not. structure%keeps_bodies)) &
            call form(deck, model, plan, system, failure)
         if (.not. failure%raised) call start_analysis(model, system, deck%control, analysis)
         if (.not. failure%raised .and. deck%control%method /= method_back) call seat_joints(model, analysis, system, failure)
         call interface_stiffness(model, system, analysis, failure)
         call start_watched(model, ends(0))
         do s = 1, maxval(findloc_of(plan%stages%id, data%rows%stage))
            from = model%history%stages(s)%from
            if (s > 1 .and. from /= s - 1) then
               allocate (locked, source=[analysis%is_elastic, analysis%is_locked])
               analysis = kept(from)
               analysis%next = s
               if (any(locked .neqv. [analysis%is_elastic, analysis%is_locked])) then
                  call form(deck, model, plan, system, failure)
                  if (.not. failure%raised) call lock_again(model, analysis, system)
               end if
               deallocate (locked)
            end if
            if (.not. failure%raised) call start_stage(model, system, analysis)
            do i = 1, size(plan%stages(s)%fractions)
               if (.not. failure%raised) call go_an_increment(deck, model, plan, system, analysis, failure)
            end do
            if (failure%raised) exit
            if (is_near) call take_stage(data, s, structure, analysis, ends(from), ends(s), answer, failure, near)
            if (.not. is_near) call take_stage(data, s, structure, analysis, ends(from), ends(s), answer, failure)
            if (failure%raised) exit
            if (any(model%history%stages(s + 1:)%from == s)) then
               call lock_bolts(model, system, analysis)
               kept(s) = analysis
            end if
         end do
         if (failure%raised) answer%fault = failure%message
         i = merge(0, 1, allocated(structure%oscillating(0)%started))
         if (.not. failure%raised) call span_modes(model, structure%oscillating(i)%mass, answer%stages)
      end associate
   end subroutine run_structure

   !> The positions of IDS in LIST.
   pure function findloc_of(list, ids) result(at)
      integer, intent(in) :: list(:), ids(:)
      integer :: at(size(ids)), i

      at = [(findloc(list, ids(i), dim=1), i = 1, size(ids))]
   end function findloc_of

   !> One increment, as in the flow chart of the main program.
   subroutine go_an_increment(deck, model, plan, system, analysis, failure)
      type(deck_type), intent(in)        :: deck
      type(model_type), intent(in)       :: model
      type(stage_plan_type), intent(in)  :: plan
      class(equation_system), allocatable, intent(inout) :: system
      type(analysis_type), intent(inout) :: analysis
      type(failure_type), intent(inout)  :: failure

      call start_increment(plan, system, analysis)
      select case (deck%control%method)
      case (method_step)
         call structure_stiffness(model, plan, analysis, system, failure)
         call solve_increment(model, system, analysis, failure)
         if (crosses_gaps(analysis, failure)) then
            call close_gaps(model, plan, analysis, system, failure)
         else
            call accumulate(model, system, analysis, failure)
            call limit_friction(model, plan, system, analysis, failure)
         end if
         call interface_stiffness(model, system, analysis, failure)
      case (method_newton)
         call newton_increment(model, plan, analysis, system, failure)
      case (method_back)
         call back_increment(model, plan, analysis, system, failure)
      end select
      if (failure%raised) return
      call note_largest(analysis)
      if (analysis%moves) call recover_bodies(model, system, analysis)
      call check_state(model, plan, system, analysis, failure)
   end subroutine go_an_increment

end module structure_run
