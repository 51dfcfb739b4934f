!> The bolts at the end of an increment, bars or solids: force, load share, stress, and clamping of the joint. The terms are
!! those of VDI 2230. Assembly is the end of the last stage that tightens a bolt. The share of an axial or transverse load and
!! the loss of clamping force are counted from assembly on. The load of a bolt is the force that passes between the bodies that
!! it clamps, see passing_forces. Of a bolt that planes of symmetry cut, force, load and bending are those of the part in the
!! model; the bending stress is that of the whole shank.
module bolt_answers
   use analysis_state, only: analysis_type
   use body_elements, only: element_thermal_forces, element_stiffness
   use bolt_locking, only: bar_tension, elongation_now, overlap_now, section_tension
   use bolt_places, only: bolt_place, distance, find_places
   use element_kinds, only: max_section_dofs, max_nodes
   use interface_operator, only: at_first_end
   use joint_laws, only: limit_scales
   use kinds, only: wp
   use mesh_queries, only: element_points
   use model_data, only: model_type, section_type, temperature_type
   use node_coupling, only: corner_displacements
   use numbers, only: cross, is_measure
   use passing_forces, only: forces_between, passage_type
   use restart_stream, only: restart_stream_type
   use surface_build, only: surface_node_list, surface_nodes
   use symmetry_planes, only: axis_part, cut_type, free_part, symmetry_plane
   use text_tools, only: above, integer_text
   use tolerances, only: symmetric_tie, zero_remainder
   implicit none
   private

   public :: start_bolts, follow_bolts, end_stage, record_bolts, bending_moment, fault_of_bolts

   real(wp), parameter :: along_it = 0.1_wp       ! of the whole load: a smaller part along a bolt is none
   real(wp), parameter :: pi = acos(-1.0_wp)

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
      real(wp), allocatable, private :: change(:)    !! largest in size since assembly
      real(wp), allocatable, private :: load(:)      !! change of the load that came with it
      real(wp), allocatable, private :: clamped(:)   !! clamping force of its own joint around the bolt at assembly
      real(wp), allocatable, private :: passed(:, :), passed_before(:, :), passed_assembled(:, :) !! (3, pairs) forces between
                                                     !! bodies now, at the end of the stage before, at assembly [force]
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
      real(wp) :: share = 0.0_wp               !! that change of force over this load
      logical  :: has_strength = .false.
      real(wp) :: stress = 0.0_wp              !! force over area [pressure]
      real(wp) :: edge_stress = 0.0_wp         !! with bending, of a round shank; where has_moment [pressure]
      real(wp) :: use = 0.0_wp                 !! largest force over ST area
      integer  :: joint = 0                    !! JID of its own joint, 0: none
      real(wp) :: clamping = 0.0_wp            !! normal force of the elements of that joint nearest to this bolt [force]
      real(wp) :: loss = 0.0_wp                !! loss of clamping since assembly, 1: all
      logical  :: has_safety = .false.
      real(wp) :: safety = 0.0_wp              !! mu N/T of these elements
   end type bolt_answer_type

contains

   !> Find all bolts of MODEL, which has these PLANES of symmetry; the history is empty.
   subroutine start_bolts(model, planes, cuts, history)
      type(model_type), intent(in)     :: model
      type(symmetry_plane), intent(in) :: planes(:)
      type(cut_type), intent(in)       :: cuts(:)     !! (joints) by these planes
      type(bolt_history), intent(out)  :: history
      integer :: n

      call find_places(model, planes, cuts, history%bolts, history%passages, history%crossing)
      n = size(history%bolts)
      allocate (history%before(n), history%tightened(n), history%largest(n), history%assembled(n), history%change(n), &
                history%load(n), history%clamped(n), source=0.0_wp)
      allocate (history%passed(3, history%passages%n), history%passed_before(3, history%passages%n), &
                history%passed_assembled(3, history%passages%n), source=0.0_wp)
   end subroutine start_bolts

   !> Bending moment at the pretension section of a solid bolt: the moment that the elements behind it exert on the nodes of the
   !! section, about the centroid of its area, across the bolt [force x length]. The weight of these elements is neglected.
   pure function bending_moment(model, section, u, temperature) result(moment)
      type(model_type), intent(in)   :: model
      type(section_type), intent(in) :: section
      real(wp), intent(in)           :: u(:, :) !! (dimension, n_nodes) of all nodes [length]
      type(temperature_type), intent(in) :: temperature
      type(surface_node_list) :: list
      real(wp) :: moment(3), centroid(3), force(3), thermal(3, max_nodes)
      real(wp) :: k(max_section_dofs, max_section_dofs), p(max_section_dofs)
      integer  :: d, e, i, j, n, s

      d = model%mesh%dimension
      s = findloc(model%mesh%surfaces%id, section%surface, dim=1)
      call surface_nodes(model%mesh, model%mesh%surfaces(s), list)
      centroid = 0.0_wp
      do i = 1, list%n
         centroid = centroid + list%area(i)*model%mesh%x(:, list%node(i))/sum(list%area)
      end do
      moment = 0.0_wp
      do j = model%mesh%first_at(section%node), model%mesh%first_at(section%node + 1) - 1
         e = model%mesh%elements_at(j)
         call element_stiffness(model, e, k)
         call element_thermal_forces(model, e, temperature, thermal(:d, :))
         associate (nodes => element_points(model%mesh, e))
            n = d*size(nodes)
            p(:n) = matmul(k(:n, :n), reshape(corner_displacements(model, e, u), [n]))
            do i = 1, size(nodes)
               if (model%mesh%node_section(nodes(i)) /= model%mesh%element_section(e)) cycle
               force = 0.0_wp
               force(:d) = p(d*(i - 1) + 1:d*i) - thermal(:d, i)
               moment = moment + cross(model%mesh%x(:, nodes(i)) - centroid, force)
            end do
         end associate
      end do
      moment = moment - dot_product(moment, section%direction)*section%direction
      if (model%mesh%axisymmetric) moment = 0.0_wp ! self-equilibrated around the ring
   end function bending_moment

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
            answer%has_ratio = bolt%stage /= stage .and. abs(answer%load_change) > along_it*whole
            if (answer%has_ratio) answer%ratio = answer%change/answer%load_change
            answer%is_locked = bolt%stage == stage .and. analysis%fraction >= 1.0_wp
            if (bolt%bar > 0) answer%is_locked = answer%is_locked .or. analysis%is_elastic(bolt%bar)
            if (bolt%section > 0) answer%is_locked = answer%is_locked .or. analysis%is_locked(bolt%section)
            if (.not. answer%is_locked) cycle
            answer%tightened = above(history%tightened(i), floor)
            answer%largest = above(history%largest(i), floor)
            answer%load = above(history%load(i), floor)
            answer%has_share = answer%load > 0.0_wp
            if (answer%has_share) answer%share = above(history%change(i), floor)/answer%load
            answer%has_strength = bolt%strength > 0.0_wp
            if (answer%has_strength) answer%use = answer%largest/(bolt%strength*bolt%area)
            if (bolt%joint == 0) cycle
            answer%joint = model%joints%list(bolt%joint)%id
            answer%clamping = above(clamping(i), floor)
            if (history%clamped(i) > floor) answer%loss = above(1.0_wp - clamping(i)/history%clamped(i), zero_remainder)
            answer%has_safety = limit_scales(model%joints%list(bolt%joint)%law) .and. shear(i) > floor
            if (answer%has_safety) answer%safety = model%joints%list(bolt%joint)%law%mu*max(0.0_wp, clamping(i))/shear(i)
         end associate
      end do
   end subroutine follow_bolts

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

   !> (3, bolts) The directions of BOLTS.
   pure function bolt_directions(bolts) result(directions)
      type(bolt_place), intent(in) :: bolts(:)
      real(wp) :: directions(3, size(bolts))
      integer  :: i

      do i = 1, size(bolts)
         directions(:, i) = bolts(i)%direction
      end do
   end function bolt_directions

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

   !> Clamping and shear forces of the own joint around each bolt: sums over the elements of the joint nearest to the axis of
   !! this bolt. Elements equally near to several bolts are shared equally. The shear forces are those that no plane of symmetry
   !! through the bolt balances.
   pure subroutine find_clamping(model, analysis, bolts, clamping, shear)
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      type(bolt_place), intent(in)    :: bolts(:)
      real(wp), intent(out)           :: clamping(:), shear(:) !! (bolts) [force]
      real(wp) :: along(3, size(bolts)), off(size(bolts)), share(size(bolts))
      integer  :: b, i

      clamping = 0.0_wp
      along = 0.0_wp
      do i = 1, size(model%joints%element)
         associate (element => model%joints%element(i), state => analysis%states(i), of_joint => bolts%joint == &
            model%joints%element(i)%joint)
            if (.not. any(of_joint)) cycle
            do b = 1, size(bolts)
               off(b) = distance(bolts(b), at_first_end(element, model%mesh%x))
            end do
            share = merge(1.0_wp, 0.0_wp, of_joint .and. off <= (1.0_wp + symmetric_tie)*minval(off, mask=of_joint))
            share = share/sum(share)
            clamping = clamping + share*state%normal%sumf
            do b = 1, size(bolts)
               along(:, b) = along(:, b) + share(b)*matmul(element%axes(:, :2), state%shear%tau*element%area)
            end do
         end associate
      end do
      if (model%mesh%axisymmetric) along = 0.0_wp ! self-equilibrated around the ring
      do b = 1, size(bolts)
         shear(b) = norm2(free_part(bolts(b)%cut, along(:, b)))
      end do
   end subroutine find_clamping

   !> Record the completed increment in HISTORY; a second call for the same increment changes nothing. Stages in which no load comes
   !! between the bodies, such as warming alone, change no share.
   pure subroutine record_increment(stage, force, clamping, floor, history)
      integer, intent(in)               :: stage
      real(wp), intent(in)              :: force(:), clamping(:) !! (bolts) now [force]
      real(wp), intent(in)              :: floor                 !! of forces: smaller values are rounding
      type(bolt_history), intent(inout) :: history
      real(wp) :: axial, load, whole
      integer  :: i

      associate (bolts => history%bolts)
         if (any(bolts%stage == stage)) then
            where (bolts%stage == stage)
               history%tightened = force
               history%largest = force
            end where
            history%assembly = stage
            history%assembled = force
            history%clamped = clamping
            history%change = 0.0_wp
            history%load = 0.0_wp
            history%passed_assembled = history%passed
         end if
         where (bolts%stage <= stage) history%largest = max(history%largest, force)
         do i = 1, size(bolts)
            call find_load(bolts(i), history%crossing(:, i), history%passed - history%passed_before, axial, whole)
            call find_load(bolts(i), history%crossing(:, i), history%passed - history%passed_assembled, axial, load)
            if (whole <= max(symmetric_tie*load, floor) .or. abs(force(i) - history%assembled(i)) <= abs(history%change(i))) cycle
            history%change(i) = force(i) - history%assembled(i)
            history%load(i) = load
         end do
      end associate
   end subroutine record_increment

   !> The stage that HISTORY has recorded last is over.
   pure subroutine end_stage(answers, history)
      type(bolt_answer_type), intent(in) :: answers(:)
      type(bolt_history), intent(inout)  :: history

      history%before = answers%force
      history%passed_before = history%passed
   end subroutine end_stage

   !> Write the history to a restart file, or read it for the same model.
   subroutine record_bolts(stream, history)
      type(restart_stream_type), intent(inout) :: stream
      type(bolt_history), intent(inout)        :: history

      call stream%part('bolt_history', 1)
      call stream%item('assembly', history%assembly)
      call stream%item('before', history%before)
      call stream%item('tightened', history%tightened)
      call stream%item('largest', history%largest)
      call stream%item('assembled', history%assembled)
      call stream%item('change', history%change)
      call stream%item('load', history%load)
      call stream%item('clamped', history%clamped)
      call stream%item('passed_before', history%passed_before)
      call stream%item('passed_assembled', history%passed_assembled)
   end subroutine record_bolts

end module bolt_answers
