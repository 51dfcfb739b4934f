!> The bolts at the end of an increment, bars or solids: force, load share, stress, and clamping of the joint. The terms are
!! those of VDI 2230. Assembly is the end of the last stage that tightens a bolt. The share of an axial or transverse load and
!! the loss of clamping force are counted from assembly on. The load of a bolt is the force that passes between the bodies that
!! it clamps, see passing_forces. A stage that changes loads of one kind (forces, temperatures or pressures) changes the tension by
!! this kind; the change by a stage of several kinds is not separable, because joints are not linear. Of a bolt that planes of
!! symmetry cut, force, load and bending are those of the part in the model; the bending stress is that of the whole shank.
module bolt_answers
   use analysis_state, only: analysis_type
   use bolt_locking, only: bar_tension, elongation_now, overlap_now, section_tension
   use bolt_places, only: bending_moment, bolt_directions, bolt_place, find_clamping, find_places
   use bolt_threads, only: assembly_limit, endurance_rolled_last, reduced_stress
   use joint_laws, only: limit_scales
   use kinds, only: wp
   use model_data, only: model_type
   use numbers, only: is_measure
   use passing_forces, only: forces_between, passage_type
   use restart_stream, only: restart_stream_type
   use symmetry_planes, only: axis_part, cut_type, symmetry_plane
   use text_tools, only: above, integer_text
   use tolerances, only: symmetric_tie, zero_remainder
   implicit none
   private

   public :: start_bolts, follow_bolts, end_stage, record_bolts, fault_of_bolts

   real(wp), parameter :: along_it = 0.1_wp       ! of the whole load: a smaller part along a bolt is none
   real(wp), parameter :: pi = acos(-1.0_wp)
   integer, parameter, public :: by_forces = 1, by_warmth = 2, by_pressure = 3, by_several = 4 !! kinds of stages
   real(wp), parameter :: most_safety = 1000.0_wp               ! of VDI 2230: a larger one is none
   integer, parameter  :: of_loads(2) = [by_forces, by_pressure] ! kinds with a share

   !> The history of the bolts of a model.
   type, public :: bolt_history
      type(bolt_place), allocatable, private   :: bolts(:)
      type(passage_type), private              :: passages
      integer, allocatable, private            :: crossing(:, :) !! (pairs of bodies, bolts) as in forces_between
      integer, private :: assembly = 0    !! position of the last stage so far that tightened a bolt, 0: none
      real(wp), allocatable :: before(:)             !! forces at the end of the stage before [force]
      real(wp), allocatable, private :: tightened(:) !! at the end of tightening, 0: not yet
      real(wp), allocatable, private :: largest(:)   !! largest since then
      real(wp), allocatable, private :: assembled(:) !! at assembly
      integer, allocatable, private :: kind(:)       !! (stages) of what the stage changes
      real(wp), allocatable, private :: base(:, :)   !! (bolts, kinds) force at assembly with all that other kinds have changed since
      real(wp), allocatable, private :: change(:, :) !! (bolts, 2) by forces, by pressures: largest in size since assembly
      real(wp), allocatable, private :: load(:, :)   !! (bolts, 2) change of the load that came with it
      real(wp), allocatable, private :: reach(:, :)  !! (bolts, 2) least and largest change since assembly but by warmth
      real(wp), allocatable, private :: clamped(:)   !! clamping force of its own joint around the bolt at assembly
      real(wp), allocatable, private :: passed(:, :), passed_before(:, :) !! (3, pairs) forces between bodies now, at the end
                                                     !! of the stage before [force]
      real(wp), allocatable, private :: passed_base(:, :) !! (3, pairs of forces, then of pressures) as BASE
   end type bolt_history

   type, public :: bolt_answer_type
      integer  :: id = 0
      integer  :: element = 0, surface = 0     !! its bar; its pretension section; one of them is 0
      integer  :: n_cuts = 0                   !! directions of the planes of symmetry that cut it
      real(wp) :: longer = 0.0_wp              !! elongation of a bar; of a solid bolt minus its shortening [length]
      real(wp) :: force = 0.0_wp               !! tension [force]
      real(wp) :: change = 0.0_wp              !! since the end of the stage before [force]
      logical  :: has_load = .false.           !! clamps bodies: the load is known
      real(wp) :: load_change = 0.0_wp         !! of the load along it since then, positive where it parts the bodies [force]
      logical  :: has_ratio = .false., has_moment = .false.
      real(wp) :: ratio = 0.0_wp               !! change over load_change
      real(wp) :: moment = 0.0_wp              !! bending [force x length]
      logical  :: is_locked = .false.          !! has been tightened: the values below are known
      real(wp) :: tightened = 0.0_wp           !! force at the end of tightening [force]
      real(wp) :: largest = 0.0_wp             !! since then [force]
      real(wp) :: load = 0.0_wp                !! change of the whole load from assembly to where the force changed most [force]
      logical  :: has_share = .false.
      real(wp) :: share = 0.0_wp               !! that change of force over this load, both by forces alone
      logical  :: has_pressure_share = .false.
      real(wp) :: pressure_share = 0.0_wp      !! likewise by pressures alone
      real(wp) :: by(4) = 0.0_wp               !! change of the tension since assembly by each kind [force]
      logical  :: has_strength = .false.
      real(wp) :: stress = 0.0_wp              !! force over area [pressure]
      real(wp) :: edge_stress = 0.0_wp         !! with bending, of a round shank; where has_moment [pressure]
      real(wp) :: use = 0.0_wp                 !! largest force over ST area
      integer  :: joint = 0                    !! JID of its own joint, 0: none
      real(wp) :: clamping = 0.0_wp            !! normal force of the elements of that joint nearest to this bolt [force]
      real(wp) :: loss = 0.0_wp                !! loss of clamping since assembly, 1: all
      logical  :: has_safety = .false.
      real(wp) :: safety = 0.0_wp              !! mu N/T of these elements
      character(8) :: thread = '', class = ''  !! '': none is given
      real(wp) :: tightening = 1.0_wp          !! alpha_A
      real(wp) :: vdi(10) = 0.0_wp             !! as vdi_names of result_page, of a whole real bolt
      logical  :: has_vdi(10) = .false.
   end type bolt_answer_type

contains

   !> Find all bolts of MODEL, which has these PLANES of symmetry; the history is empty.
   subroutine start_bolts(model, planes, cuts, history)
      type(model_type), intent(in)     :: model
      type(symmetry_plane), intent(in) :: planes(:)
      type(cut_type), intent(in)       :: cuts(:)     !! (joints) by these planes
      type(bolt_history), intent(out)  :: history
      integer :: n, s

      call find_places(model, planes, cuts, history%bolts, history%passages, history%crossing)
      n = size(history%bolts)
      allocate (history%before(n), history%tightened(n), history%largest(n), history%assembled(n), &
                history%clamped(n), source=0.0_wp)
      allocate (history%base(n, 4), history%change(n, 2), history%load(n, 2), history%reach(n, 2), source=0.0_wp)
      allocate (history%passed(3, history%passages%n), history%passed_before(3, history%passages%n), source=0.0_wp)
      allocate (history%passed_base(3, 2*history%passages%n), source=0.0_wp)
      allocate (history%kind(size(model%history%stages)), source=by_forces)
      do s = 1, size(history%kind)
         associate (changes => model%history%stages(s)%changes) ! forces, pressures, temperatures
            if (changes(2)) history%kind(s) = by_pressure
            if (changes(3)) history%kind(s) = by_warmth
            if (count(changes) > 1) history%kind(s) = by_several
         end associate
      end do
   end subroutine start_bolts

   !> Follow the bolts through the increment just completed: their history, and their values now. The bending of solid bolts is known
   !! only where the bodies are recovered, at the end of a stage.
   subroutine follow_bolts(model, analysis, largest_force, history, answers)
      type(model_type), intent(in)      :: model
      type(analysis_type), intent(in)   :: analysis
      real(wp), intent(in)              :: largest_force !! ever applied at a node, for the noise [force]
      type(bolt_history), intent(inout) :: history
      type(bolt_answer_type), allocatable, intent(out) :: answers(:)
      real(wp), allocatable :: clamping(:), force(:), shear(:)
      real(wp) :: axial, floor, whole
      integer  :: i, stage

      stage = analysis%stage
      floor = zero_remainder*largest_force
      allocate (answers(size(history%bolts)), force(size(history%bolts)))
      if (size(answers) == 0) return
      do i = 1, size(answers)
         call answer_force(model, analysis, history%bolts(i), floor, force(i), answers(i))
      end do
      history%passed = forces_between(model, analysis, history%passages, history%crossing, bolt_directions(history%bolts), force)
      allocate (clamping, shear, mold=force)
      call find_clamping(model, analysis, history%bolts, clamping, shear)
      call record_increment(analysis%stage, force, clamping, floor, history)
      do i = 1, size(answers)
         associate (answer => answers(i), bolt => history%bolts(i))
            answer%change = above(force(i) - history%before(i), floor)
            answer%has_load = any(history%crossing(:, i) /= 0)
            call find_load(bolt, history%crossing(:, i), history%passed - history%passed_before, axial, whole)
            answer%load_change = above(axial, floor)
            answer%has_ratio = .not. bolt%tightening%is_in(stage) .and. abs(answer%load_change) > along_it*whole
            if (answer%has_ratio) answer%ratio = answer%change/answer%load_change
            answer%is_locked = bolt%tightening%is_in(stage) .and. analysis%fraction >= 1.0_wp
            if (bolt%bar > 0) answer%is_locked = answer%is_locked .or. analysis%is_elastic(bolt%bar)
            if (bolt%section > 0) answer%is_locked = answer%is_locked .or. analysis%is_locked(bolt%section)
            if (.not. answer%is_locked) cycle
            answer%tightened = above(history%tightened(i), floor)
            answer%largest = above(history%largest(i), floor)
            answer%load = above(history%load(i, 1), floor)
            answer%has_share = answer%load > 0.0_wp
            if (answer%has_share) answer%share = above(history%change(i, 1), floor)/answer%load
            answer%has_pressure_share = history%load(i, 2) > floor
            if (answer%has_pressure_share) answer%pressure_share = above(history%change(i, 2), floor)/history%load(i, 2)
            answer%by = above(changes_by_kind(stage, force(i), history, i), floor)
            answer%has_strength = bolt%strength > 0.0_wp
            if (answer%has_strength) answer%use = answer%largest/(bolt%strength*bolt%area)
            if (bolt%joint == 0) then
               call follow_vdi(bolt, history, i, floor, answer)
               cycle
            end if
            answer%joint = model%joints%list(bolt%joint)%id
            answer%clamping = above(clamping(i), floor)
            if (history%clamped(i) > floor) answer%loss = above(1.0_wp - clamping(i)/history%clamped(i), zero_remainder)
            answer%has_safety = limit_scales(model%joints%list(bolt%joint)%law) .and. shear(i) > floor
            if (answer%has_safety) answer%safety = model%joints%list(bolt%joint)%law%mu*max(0.0_wp, clamping(i))/shear(i)
            call follow_vdi(bolt, history, i, floor, answer)
         end associate
      end do
   end subroutine follow_bolts

   !> What stages of each kind have changed in the tension of bolt I since assembly; it has FORCE now, in STAGE.
   pure function changes_by_kind(stage, force, history, i) result(by)
      integer, intent(in)            :: stage, i !! positions
      real(wp), intent(in)           :: force
      type(bolt_history), intent(in) :: history
      real(wp) :: by(4)

      by = 0.0_wp
      if (history%assembly == 0 .or. stage == history%assembly) return
      by = history%before(i) - history%base(i, :)
      by(history%kind(stage)) = force - history%base(i, history%kind(stage))
   end function changes_by_kind

   !> The values of VDI 2230 of bolt I: those of one real bolt, with the force at the end of tightening as the largest assembly force.
   pure subroutine follow_vdi(bolt, history, i, floor, answer)
      type(bolt_place), intent(in)          :: bolt
      type(bolt_history), intent(in)        :: history
      integer, intent(in)                   :: i
      real(wp), intent(in)                  :: floor  !! of forces: smaller values are rounding
      type(bolt_answer_type), intent(inout) :: answer !! all but these values are known
      real(wp) :: amplitude, clamped, last, lost, residual, scatter
      logical  :: clamps

      if (bolt%thread%size == '') return
      answer%thread = bolt%thread%size
      answer%class = bolt%thread%class
      answer%tightening = bolt%thread%tightening
      clamps = answer%joint > 0
      associate (thread => bolt%thread, part => bolt%thread%count, reach => history%reach(i, :))
         scatter = answer%tightened*(1.0_wp - 1.0_wp/thread%tightening)            ! (R1/1): F_M max - F_M max/alpha_A
         clamped = max(0.0_wp, history%clamped(i) - scatter)
         residual = max(0.0_wp, answer%clamping - scatter)                         ! F_KR min (R12/1)
         lost = history%clamped(i) - answer%clamping
         amplitude = 0.5_wp*above(reach(2) - reach(1), floor)/(part*thread%area)   ! sigma_a (R9/1)
         last = endurance_rolled_last(thread, (history%assembled(i) + answer%by(by_warmth) + 0.5_wp*sum(reach))/part)
         answer%has_vdi = [.true., .true., clamps, clamps, .true., .true., amplitude > 0.0_wp, &
                           amplitude > 0.0_wp .and. last > 0.0_wp, answer%has_safety .and. answer%clamping > 0.0_wp, &
                           clamps .and. lost > floor]
         answer%vdi(:6) = [answer%tightened/part, assembly_limit(thread), &
                           above(answer%force - history%assembled(i) + lost, floor)/part, residual/part, amplitude, &
                           thread%yield/reduced_stress(thread, answer%tightened/part, answer%largest/part)] ! S_F (R8/5-1)
         if (answer%has_vdi(7)) answer%vdi(7:8) = [thread%endurance, last]/amplitude
         if (answer%has_vdi(9)) answer%vdi(9) = answer%safety*residual/answer%clamping ! S_G (R12/4)
         if (answer%has_vdi(10)) answer%vdi(10) = clamped/lost
         answer%has_vdi(6:) = answer%has_vdi(6:) .and. answer%vdi(6:) <= most_safety
      end associate
   end subroutine follow_vdi

   !> What of the answers is beyond all bounds, '': nothing.
   pure function fault_of_bolts(answers) result(words)
      type(bolt_answer_type), intent(in) :: answers(:)
      character(:), allocatable :: words
      integer :: i

      words = ''
      do i = 1, size(answers)
         associate (bolt => answers(i))
            if (all(is_measure([bolt%force, bolt%change, bolt%load_change, bolt%ratio, bolt%moment, bolt%stress, bolt%share, &
                                bolt%use, bolt%clamping, bolt%loss, bolt%safety]))) cycle
            words = 'the force of bolt '//integer_text(bolt%id)
            return
         end associate
      end do
   end function fault_of_bolts

   !> The tension FORCE of BOLT now, and in ANSWER all that follows from it and from the bodies.
   subroutine answer_force(model, analysis, bolt, floor, force, answer)
      type(model_type), intent(in)        :: model
      type(analysis_type), intent(in)     :: analysis
      type(bolt_place), intent(in)        :: bolt
      real(wp), intent(in)                :: floor !! of forces: smaller values are rounding
      real(wp), intent(out)               :: force
      type(bolt_answer_type), intent(out) :: answer
      real(wp) :: moment(3)

      answer%id = bolt%id
      answer%n_cuts = bolt%cut%n
      if (bolt%bar > 0) then
         force = bar_tension(model, analysis, bolt%bar)
         answer%element = model%mesh%bars(bolt%bar)%id
         answer%longer = elongation_now(model, analysis, bolt%bar)
      else
         force = section_tension(model, analysis, bolt%section)
         answer%surface = model%mesh%sections(bolt%section)%surface
         answer%longer = -overlap_now(model, analysis, bolt%section)
      end if
      answer%force = above(force, floor)
      answer%stress = answer%force/bolt%area
      answer%has_moment = bolt%section > 0 .and. analysis%fraction >= 1.0_wp
      if (.not. answer%has_moment) return
      moment = bending_moment(model, model%mesh%sections(bolt%section), analysis%all_u, analysis%now%temperature)
      answer%moment = above(norm2(axis_part(bolt%cut, moment)), floor*sqrt(bolt%area))
      ! W = pi d**3/32, A = pi d**2/4; one plane of symmetry leaves half of the moment and of the area of the whole shank
      answer%edge_stress = answer%stress + &
         merge(sqrt(0.5_wp), 1.0_wp, bolt%cut%n == 1)*4.0_wp*sqrt(pi)*answer%moment/bolt%area**1.5_wp
   end subroutine answer_force

   !> The load of BOLT from the forces that have PASSED between bodies: AXIAL along it, positive where it parts the bodies, and the
   !! WHOLE force, each of the pair of bodies between which it is largest.
   pure subroutine find_load(bolt, crossing, passed, axial, whole)
      type(bolt_place), intent(in) :: bolt
      integer, intent(in)          :: crossing(:)  !! (pairs) of this bolt
      real(wp), intent(in)         :: passed(:, :) !! (3, pairs) [force]
      real(wp), intent(out)        :: axial, whole !! [force]
      real(wp) :: parting
      integer  :: k

      axial = 0.0_wp
      whole = 0.0_wp
      do k = 1, size(crossing)
         if (crossing(k) == 0) cycle
         parting = -crossing(k)*dot_product(passed(:, k), bolt%direction)
         if (abs(parting) > abs(axial)) axial = parting
         whole = max(whole, norm2(passed(:, k)))
      end do
   end subroutine find_load

   !> Record the completed increment in HISTORY; a second call for the same increment changes nothing. Shares are those of stages
   !! that change forces alone, or pressures alone, and in which a load comes between the bodies.
   pure subroutine record_increment(stage, force, clamping, floor, history)
      integer, intent(in)               :: stage
      real(wp), intent(in)              :: force(:), clamping(:) !! (bolts) now [force]
      real(wp), intent(in)              :: floor                 !! of forces: smaller values are rounding
      type(bolt_history), intent(inout) :: history
      real(wp) :: axial, by(4), load, whole
      integer  :: i, k, n

      n = history%passages%n
      associate (bolts => history%bolts, &
                 is_now => [(history%bolts(i)%tightening%is_in(stage), i = 1, size(history%bolts))])
         if (any(is_now)) then
            where (is_now)
               history%tightened = force
               history%largest = force
            end where
            history%assembly = stage
            history%assembled = force
            history%clamped = clamping
            history%base = spread(force, 2, 4)
            history%change = 0.0_wp
            history%load = 0.0_wp
            history%reach = 0.0_wp
            history%passed_base(:, :n) = history%passed
            history%passed_base(:, n + 1:) = history%passed
         end if
         where ([(bolts(i)%tightening%last_until(stage) > 0, i = 1, size(bolts))]) history%largest = max(history%largest, force)
         k = findloc(of_loads, history%kind(stage), dim=1)
         do i = 1, size(bolts)
            by = changes_by_kind(stage, force(i), history, i)
            by(by_warmth) = 0.0_wp
            history%reach(i, :) = [min(history%reach(i, 1), sum(by)), max(history%reach(i, 2), sum(by))]
            if (k == 0) cycle
            call find_load(bolts(i), history%crossing(:, i), history%passed - history%passed_before, axial, whole)
            call find_load(bolts(i), history%crossing(:, i), history%passed - &
                           history%passed_base(:, (k - 1)*n + 1:k*n), axial, load)
            if (whole <= max(symmetric_tie*load, floor)) cycle
            if (abs(force(i) - history%base(i, of_loads(k))) <= abs(history%change(i, k))) cycle
            history%change(i, k) = force(i) - history%base(i, of_loads(k))
            history%load(i, k) = load
         end do
      end associate
   end subroutine record_increment

   !> STAGE, which HISTORY has recorded last, is over.
   pure subroutine end_stage(stage, answers, history)
      integer, intent(in)                :: stage
      type(bolt_answer_type), intent(in) :: answers(:)
      type(bolt_history), intent(inout)  :: history
      integer :: k

      do k = 1, merge(4, 0, stage /= history%assembly)
         if (k /= history%kind(stage)) history%base(:, k) = history%base(:, k) + (answers%force - history%before)
      end do
      do k = 1, merge(2, 0, stage /= history%assembly)
         associate (base => history%passed_base(:, (k - 1)*history%passages%n + 1:k*history%passages%n))
            if (of_loads(k) /= history%kind(stage)) base = base + (history%passed - history%passed_before)
         end associate
      end do
      history%before = answers%force
      history%passed_before = history%passed
   end subroutine end_stage

   !> Write the history to a restart file, or read it for the same model.
   subroutine record_bolts(stream, history)
      type(restart_stream_type), intent(inout) :: stream
      type(bolt_history), intent(inout)        :: history

      call stream%part('bolt_history', 2)
      call stream%item('assembly', history%assembly)
      call stream%item('before', history%before)
      call stream%item('tightened', history%tightened)
      call stream%item('largest', history%largest)
      call stream%item('assembled', history%assembled)
      call stream%item('base', history%base)
      call stream%item('change', history%change)
      call stream%item('load', history%load)
      call stream%item('reach', history%reach)
      call stream%item('clamped', history%clamped)
      call stream%item('passed_before', history%passed_before)
      call stream%item('passed_base', history%passed_base)
   end subroutine record_bolts

end module bolt_answers
