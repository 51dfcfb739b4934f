!> A run of a deck with given values of its parameters, without listing and tables: the answers to the rows of a measured file.
!! Parameters that only laws and loads use leave the bodies as they are: such runs share the factor of their static part. Those of a
!! difference in place of a derivative go beside one run by NEWTON: in each increment its last factor brings them to equilibrium.
module structure_run
   use analysis_state, only: analysis_type, interface_stiffness, note_largest, start_analysis
   use back_method, only: back_increment
   use bolt_locking, only: lock_again, lock_bolts
   use control_words, only: method_back, method_newton, method_step
   use deck_errors, only: deck_error_list
   use deck_input, only: read_deck
   use deck_parameters, only: parameter_type
   use equation_solver, only: equation_system, failure_type
   use equations, only: form_body_stiffness, start_equations
   use finite_state, only: check_state
   use joint_laws, only: element_state
   use kinds, only: wp
   use load_path, only: recover_bodies, start_increment, start_stage
   use measured_data, only: a_bolt, a_loss, a_stiffness, measured_row, measured_type
   use mode_rows, only: answer_type, is_of_modes, structure_type
   use mode_span, only: span_modes
   use model_build, only: build_model
   use newton_method, only: close_gaps, crosses_gaps, newton_increment, seat_joints
   use newton_trial, only: attempt_type, commit, trial_type
   use stage_plan, only: factorisations_of, where_in_plan
   use step_method, only: accumulate, limit_friction, solve_increment, structure_stiffness
   use structure_answers, only: take_stage
   use text_tools, only: integer_text
   use tolerances, only: beside_tol
   use watched_nodes, only: start_watched, watch_state
   use way_points, only: approach
   implicit none
   private

   public :: start_structure, run_structure

   !> A run between its stages.
   type :: walk_type
      type(structure_type) :: structure              ! without its equations
      type(analysis_type)  :: analysis
      type(analysis_type), allocatable :: kept(:)    ! ends of stages from which others start
      type(watch_state), allocatable   :: ends(:)    ! of all; the first one is at rest
      logical :: is_beside = .false.                 ! another one, whose equations it uses
      logical :: forms = .false.                     ! equations of its own bodies
   end type walk_type

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
      class(equation_system), allocatable  :: system
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
      call form(structure, system, failure)
      call move_alloc(system, structure%system)
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
   subroutine form(structure, system, failure)
      type(structure_type), intent(in)  :: structure
      class(equation_system), allocatable, intent(out) :: system
      type(failure_type), intent(inout) :: failure

      call start_equations(structure%model, system, failure, structure%deck%control%solver, &
                           factorisations_of(structure%plan, structure%deck%control%method))
      if (.not. failure%raised) call form_body_stiffness(structure%model, system, failure, where_in_plan(structure%plan, 1, 1))
   end subroutine form

   !> Run STRUCTURE with the first of the VALUES (parameters, runs) of its parameters, and beside it with the others, whose laws and
   !! loads alone differ: these follow its increments with its factors, and the FAULT of one that does not come to equilibrium so is
   !! no verdict. NEAR is the answer of a run nearby, whose modes serve where frequencies alone are asked for. The runs use up the
   !! equations of STRUCTURE: they are the last of their process. The increments of the first one begin at REACHED of STRUCTURE.
   subroutine run_structure(data, values, structure, answers, near)
      type(measured_type), intent(in)         :: data
      real(wp), intent(in)                    :: values(:, :)
      type(structure_type), intent(inout)     :: structure
      type(answer_type), intent(out)          :: answers(:)
      type(answer_type), intent(in), optional :: near
      class(equation_system), allocatable :: system
      type(walk_type), allocatable :: walks(:)
      type(failure_type) :: failure
      logical :: is_near
      integer :: at, i, k, last, s

      call move_alloc(structure%system, system)
      is_near = present(near)
      if (is_near) is_near = all(abs(values(:, 1) - near%set) <= 0.0_wp .or. structure%keeps_bodies)
      allocate (walks(size(answers)))
      do k = size(walks), 1, -1
         answers(k)%fault = 'not run'
         walks(k)%structure = structure
         walks(k)%is_beside = k > 1
      end do
      walks(1)%forms = any(abs(values(:, 1) - data%parameters%start) > 0.0_wp .and. .not. structure%keeps_bodies)
      do k = 1, size(walks)
         call start_walk(data, values(:, k), is_near, system, walks(k), answers(k))
         if (answers(k)%fault /= '') return
      end do
      associate (first => walks(1), stages => walks(1)%structure%plan%stages)
         last = maxval(findloc_of(stages%id, data%rows%stage))
         at = merge(sum([(size(stages(s)%fractions), s = 1, last)]), 0, first%structure%deck%control%method == method_newton)
         allocate (answers(1)%reached(size(first%analysis%u, 1), size(first%analysis%u, 2), at))
         at = 0
         do s = 1, last
            do k = 1, size(walks)
               if (answers(k)%fault == '') call go_to_stage(s, walks(k), system, failure)
            end do
            do i = 1, size(stages(s)%fractions)
               at = at + 1
               if (.not. failure%raised) &
                  call go_an_increment(first%structure, system, first%analysis, at, answers(1)%reached, failure)
               do k = 2, merge(1, size(walks), failure%raised)
                  if (answers(k)%fault == '') call go_beside(first%analysis, walks(k), system, answers(k)%fault)
               end do
            end do
            do k = 1, size(walks)
               if (failure%raised) answers(k)%fault = failure%message
               if (answers(k)%fault == '') call end_stage(data, s, is_near, walks(k), system, answers(k), failure, near)
               if (failure%raised) answers(k)%fault = failure%message
            end do
            if (failure%raised) return
         end do
         i = merge(0, 1, allocated(first%structure%oscillating(0)%mass%first))
         call span_modes(first%structure%model, first%structure%oscillating(i)%mass, answers(1)%stages)
      end associate
   end subroutine run_structure

   !> Read and build the structure of WALK with VALUES, and put it at rest; the equations are formed anew where its bodies are others.
   subroutine start_walk(data, values, is_near, system, walk, answer)
      type(measured_type), intent(in)  :: data
      real(wp), intent(in)             :: values(:)
      logical, intent(in)              :: is_near
      class(equation_system), allocatable, intent(inout) :: system
      type(walk_type), intent(inout)   :: walk
      type(answer_type), intent(inout) :: answer
      type(parameter_type), allocatable :: parameters(:)
      type(deck_error_list) :: errors
      type(failure_type)    :: failure
      logical :: readable

      associate (structure => walk%structure, n => size(data%rows))
         call set_parameters(structure, data, values, parameters)
         call read_deck(structure%path, structure%deck, errors, readable, parameters, structure%watched)
         if (.not. errors%any()) call build_model(structure%deck, structure%model, structure%plan, errors)
         answer%fault = ''
         if (errors%any()) answer%fault = errors%items(1)%message
         if (answer%fault /= '') return
         structure%plan%measures_path = .false. ! which is printed only
         allocate (answer%value(n), answer%off_number(n), source=0.0_wp)
         allocate (answer%shapes(merge(0, size(structure%model%freedoms%held), is_near), n), source=0.0_wp)
         allocate (answer%mac(n), source=1.0_wp)
         allocate (answer%mode(n), source=0)
         allocate (answer%stages(size(structure%plan%stages)), walk%kept(size(answer%stages)), walk%ends(0:size(answer%stages)))
         if (walk%forms) call form(structure, system, failure)
         if (.not. failure%raised) call start_analysis(structure%model, system, structure%deck%control, walk%analysis)
         if (.not. failure%raised .and. structure%deck%control%method /= method_back) &
            call seat_joints(structure%model, walk%analysis, system, failure)
         call interface_stiffness(structure%model, system, walk%analysis, failure)
         call start_watched(structure%model, walk%ends(0))
         if (failure%raised) answer%fault = failure%message
      end associate
   end subroutine start_walk

   !> Bring WALK to the start of stage S. Beside another walk the equations have its bolts already.
   subroutine go_to_stage(s, walk, system, failure)
      integer, intent(in)               :: s
      type(walk_type), intent(inout)    :: walk
      class(equation_system), allocatable, intent(inout) :: system
      type(failure_type), intent(inout) :: failure
      logical, allocatable :: locked(:)

      associate (model => walk%structure%model, analysis => walk%analysis, from => walk%structure%model%history%stages(s)%from)
         if (s > 1 .and. from /= s - 1) then
            allocate (locked, source=[analysis%is_elastic, analysis%is_locked])
            analysis = walk%kept(from)
            analysis%next = s
            if (any(locked .neqv. [analysis%is_elastic, analysis%is_locked]) .and. .not. walk%is_beside) then
               call form(walk%structure, system, failure)
               if (.not. failure%raised) call lock_again(model, analysis, system)
            end if
         end if
         if (.not. failure%raised) call start_stage(model, system, analysis, walk%is_beside)
      end associate
   end subroutine go_to_stage

   !> The answers of WALK at the end of stage S, which is kept where a later stage starts from it.
   subroutine end_stage(data, s, is_near, walk, system, answer, failure, near)
      type(measured_type), intent(in)   :: data
      integer, intent(in)               :: s
      logical, intent(in)               :: is_near
      type(walk_type), intent(inout)    :: walk
      class(equation_system), allocatable, intent(inout) :: system
      type(answer_type), intent(inout)  :: answer
      type(failure_type), intent(inout) :: failure
      type(answer_type), intent(in), optional :: near

      associate (structure => walk%structure, stages => walk%structure%model%history%stages)
         call move_alloc(system, structure%system)
         if (is_near) then
            call take_stage(data, s, structure, walk%analysis, walk%ends(stages(s)%from), walk%ends(s), answer, failure, near)
         else
            call take_stage(data, s, structure, walk%analysis, walk%ends(stages(s)%from), walk%ends(s), answer, failure)
         end if
         call move_alloc(structure%system, system)
         if (failure%raised .or. all(stages(s + 1:)%from /= s)) return
         call lock_bolts(structure%model, system, walk%analysis, is_beside=walk%is_beside)
         walk%kept(s) = walk%analysis
      end associate
   end subroutine end_stage

   !> The increment that FIRST has completed, from equilibrium to equilibrium with its last factor, as WALK is almost the same.
   subroutine go_beside(first, walk, system, fault)
      type(analysis_type), intent(in)          :: first
      type(walk_type), intent(inout)           :: walk
      class(equation_system), intent(inout)    :: system
      character(:), allocatable, intent(inout) :: fault
      type(attempt_type) :: attempt
      type(trial_type)   :: trial
      type(element_state), allocatable :: before(:)
      real(wp), allocatable :: u(:, :)
      real(wp) :: enough
      integer  :: i

      associate (model => walk%structure%model, analysis => walk%analysis)
         call start_increment(walk%structure%plan, system, analysis)
         attempt%load = analysis%now%condensed_load
         attempt%iteration = 1 ! there is a factor
         analysis%record%follows_path = .true. ! with all corrections
         analysis%tolerance = beside_tol*first%tolerance/first%load_tolerance
         allocate (before, source=analysis%states)
         u = analysis%u + first%du
         do i = 1, 2 ! each leaves ON_THE_PATH of the residual where it begins, if that is more than the tolerance
            call approach(model, system, analysis%now%condensed_load, u, before, 0.0_wp, analysis, attempt, trial, enough)
            if (trial%size <= analysis%tolerance) exit
            u = trial%u
         end do
         if (analysis%moves .or. .not. first%record%is_whole .or. .not. trial%size <= analysis%tolerance) then
            fault = 'no equilibrium beside another run'
         else
            call commit(model, system, trial, analysis)
            call note_largest(analysis)
         end if
      end associate
   end subroutine go_beside

   !> The positions of IDS in LIST.
   pure function findloc_of(list, ids) result(at)
      integer, intent(in) :: list(:), ids(:)
      integer :: at(size(ids)), i

      at = [(findloc(list, ids(i), dim=1), i = 1, size(ids))]
   end function findloc_of

   !> One increment, as in the flow chart of the main program. NEWTON begins where the path of the last run was then.
   subroutine go_an_increment(structure, system, analysis, at, reached, failure)
      type(structure_type), intent(in)   :: structure
      class(equation_system), allocatable, intent(inout) :: system
      type(analysis_type), intent(inout) :: analysis
      integer, intent(in)                :: at            !! of all increments
      real(wp), intent(inout)            :: reached(:, :, :) !! as in answer_type
      type(failure_type), intent(inout)  :: failure
      logical :: is_known

      associate (model => structure%model, plan => structure%plan)
         call start_increment(plan, system, analysis)
         select case (structure%deck%control%method)
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
            is_known = allocated(structure%reached)
            if (is_known) is_known = all(shape(structure%reached) == shape(reached))
            if (is_known) call newton_increment(model, plan, analysis, system, failure, structure%reached(:, :, at))
            if (.not. is_known) call newton_increment(model, plan, analysis, system, failure)
            reached(:, :, at) = analysis%u
         case (method_back)
            call back_increment(model, plan, analysis, system, failure)
         end select
         if (failure%raised) return
         call note_largest(analysis)
         if (analysis%moves) call recover_bodies(model, system, analysis)
         call check_state(model, plan, system, analysis, failure)
      end associate
   end subroutine go_an_increment

end module structure_run
