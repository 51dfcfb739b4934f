!> The bolts at the end of an increment, bars or solids: force, load share, stress, and clamping of the joint. The terms are
!! those of VDI 2230. Assembly is the end of the last stage that tightens a bolt. The share of an axial or transverse load and
!! the loss of clamping force are counted from assembly on.
module bolt_answers
   use analysis_state, only: analysis_type
   use body_elements, only: element_thermal_forces, element_stiffness
   use bolt_locking, only: bar_tension, elongation_now, overlap_now, section_tension
   use element_kinds, only: max_felt_dofs, max_nodes
   use interface_operator, only: at_first_end
   use kinds, only: wp
   use model_data, only: a_point, corners_of, model_type, n_bars, n_points, n_sections, node_kind, section_type, temperature_type
   use node_coupling, only: corner_displacements
   use numbers, only: cross, first_largest, tie
   use restart_stream, only: restart_stream_type
   use surface_build, only: surface_node_list, surface_nodes
   use text_tools, only: above
   implicit none
   private

   public :: start_bolts, find_bolt_answers, record_bolts, load_along, whole_load, bending_moment

   ! of forces and movements: the remainder of sums and differences that are zero but for rounding and the tolerance of iterations
   real(wp), parameter, public :: remainder = 1.0e-7_wp

   real(wp), parameter :: about_as_near = 0.45_wp ! of the bolt's length: own joint farther than the nearest one by this
   real(wp), parameter :: along_it = 0.01_wp      ! of the whole load: a smaller part along a bolt is none
   real(wp), parameter :: pi = acos(-1.0_wp)

   !> The data of a bolt that do not change.
   type :: bolt_place
      integer  :: id = 0                  !! of its BOLT card
      integer  :: bar = 0, section = 0    !! position of its bar or of its pretension section: one of them is 0
      integer  :: stage = 0               !! position of the stage that tightens it
      integer  :: joint = 0               !! position of the joint that it crosses, the largest of several; 0: none
      real(wp) :: point(3) = 0.0_wp       !! on its axis [length]
      real(wp) :: direction(3) = 0.0_wp   !! along it, unit
      real(wp) :: area = 0.0_wp           !! of its shank [length^2]
      real(wp) :: strength = 0.0_wp       !! ST of its material, 0: not given [pressure]
   end type bolt_place

   !> The history of the bolts of a model.
   type, public :: bolt_history
      type(bolt_place), allocatable, private :: bolts(:)
      integer, private :: assembly = 0    !! position of the last stage so far that tightened a bolt, 0: none
      real(wp), private :: load = 0.0_wp  !! the largest since assembly [force]
      real(wp), allocatable :: before(:)             !! forces at the end of the stage before [force]
      real(wp), allocatable, private :: tightened(:) !! at the end of tightening, 0: not yet
      real(wp), allocatable, private :: largest(:)   !! largest since then
      real(wp), allocatable, private :: assembled(:) !! at assembly
      real(wp), allocatable, private :: change(:)    !! largest in size since assembly
      real(wp), allocatable, private :: clamped(:)   !! clamping force of its own joint around the bolt at assembly
   end type bolt_history

   type, public :: bolt_answer_type
      integer  :: id = 0
      integer  :: element = 0, surface = 0     !! its bar; its pretension section; one of them is 0
      real(wp) :: longer = 0.0_wp              !! elongation of a bar; of a solid bolt minus its shortening [length]
      real(wp) :: force = 0.0_wp               !! tension [force]
      real(wp) :: change = 0.0_wp              !! since the end of the stage before [force]
      real(wp) :: load_change = 0.0_wp         !! of the load along it [force]
      logical  :: has_ratio = .false., has_moment = .false.
      real(wp) :: ratio = 0.0_wp               !! change over load_change
      real(wp) :: moment = 0.0_wp              !! bending [force x length]
      logical  :: is_locked = .false.          !! has been tightened: the values below are known
      real(wp) :: tightened = 0.0_wp           !! force at the end of tightening [force]
      real(wp) :: largest = 0.0_wp             !! since then [force]
      real(wp) :: load = 0.0_wp                !! the largest whole load since assembly [force]
      logical  :: has_share = .false.
      real(wp) :: share = 0.0_wp               !! largest change of force since assembly over the load that changed
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

   !> Find all bolts of MODEL, bars first, and the joint of each; the history is empty.
   subroutine start_bolts(model, history)
      type(model_type), intent(in)    :: model
      type(bolt_history), intent(out) :: history
      type(surface_node_list) :: list
      real(wp) :: along, radius, span(2)
      integer  :: i, n, node, s

      n = n_sections(model)
      if (n_bars(model) > 0) n = n + count(model%bars%bolt > 0)
      allocate (history%bolts(n))
      allocate (history%before(n), history%tightened(n), history%largest(n), history%assembled(n), history%change(n), &
                history%clamped(n), source=0.0_wp)
      n = 0
      do i = 1, n_bars(model)
         associate (bar => model%bars(i))
            if (bar%bolt == 0) cycle
            n = n + 1
            history%bolts(n) = bolt_place(id=bar%bolt, bar=i, stage=bar%stage, point=model%x(:, bar%nodes(1)), &
                                          direction=bar%direction(:, 1), area=bar%area, strength=bar%strength)
            call find_own_joint(model, [0.0_wp, norm2(model%x(:, bar%nodes(2)) - model%x(:, bar%nodes(1)))], history%bolts(n))
         end associate
      end do
      do i = 1, n_sections(model)
         n = n + 1
         associate (section => model%sections(i), bolt => history%bolts(n))
            s = findloc(model%surfaces%id, section%surface, dim=1)
            call surface_nodes(model, model%surfaces(s), list)
            bolt = bolt_place(id=section%bolt, section=i, stage=section%stage, direction=section%direction, area=section%area, &
                              point=matmul(model%x(:, list%node), list%area)/sum(list%area), strength=section%strength)
            radius = 0.0_wp
            do s = 1, list%n
               radius = max(radius, norm2(model%x(:, list%node(s)) - bolt%point))
            end do
            span = 0.0_wp ! of the nodes of its body no farther from the axis than those of its pretension section
            do node = 1, n_points(model)
               if (model%part(node) /= model%part(section%point)) cycle
               if (distance(bolt, model%x(:, node)) > radius*(1.0_wp + 1.0e-3_wp)) cycle
               along = dot_product(model%x(:, node) - bolt%point, bolt%direction)
               span = [min(span(1), along), max(span(2), along)]
            end do
            call find_own_joint(model, span, bolt)
         end associate
      end do
   end subroutine start_bolts

   !> The joint of BOLT: its element nearest to the axis lies within the SPAN of the bolt and faces the axis. Joints much
   !! farther than the nearest one belong to other bolts. Of the remaining joints the one of largest area is taken, the first of
   !! equal ones.
   pure subroutine find_own_joint(model, span, bolt)
      type(model_type), intent(in)    :: model
      real(wp), intent(in)            :: span(2) !! from the point of the bolt, in its direction [length]
      type(bolt_place), intent(inout) :: bolt
      real(wp) :: off(size(model%joints)), along, near
      logical  :: crossed(size(model%joints))
      integer  :: i, j

      crossed = .false.
      off = huge(1.0_wp)
      associate (length => span(2) - span(1))
         do j = 1, size(model%joints)
            do i = model%joints(j)%first, model%joints(j)%last
               near = distance(bolt, at_first_end(model%interface(i), model%x))
               if (near > off(j) - tie*length) cycle
               off(j) = near
               along = dot_product(at_first_end(model%interface(i), model%x) - bolt%point, bolt%direction)
               crossed(j) = along > span(1) - tie*length .and. along < span(2) + tie*length .and. &
                            abs(dot_product(model%interface(i)%axes(:, 3), bolt%direction)) > 0.5_wp
            end do
         end do
         crossed = crossed .and. off <= minval(off, mask=crossed) + about_as_near*length
      end associate
      bolt%joint = first_largest(model%joints%area, crossed)
   end subroutine find_own_joint

   !> Distance of X from the axis of BOLT [length].
   pure real(wp) function distance(bolt, x)
      type(bolt_place), intent(in) :: bolt
      real(wp), intent(in)         :: x(3)

      distance = norm2(x - bolt%point - dot_product(x - bolt%point, bolt%direction)*bolt%direction)
   end function distance

   !> The load of the deck along DIRECTION at FRACTION of STAGE: the larger of the sums of nodal forces in this and in the
   !! opposite direction. Of self-equilibrated loads one half counts [force]. Preloads are left out.
   real(wp) function load_along(model, direction, stage, fraction) result(load)
      type(model_type), intent(in) :: model
      real(wp), intent(in)         :: direction(3)
      integer, intent(in)          :: stage    !! position; before the first there is no load
      real(wp), intent(in)         :: fraction
      real(wp), allocatable :: force(:, :)
      real(wp) :: component, sums(2)
      integer  :: i

      call find_load_change(model, 0, stage, fraction, force)
      sums = 0.0_wp
      do i = 1, size(force, 2)
         component = dot_product(force(:, i), direction)
         sums = sums + [max(0.0_wp, component), max(0.0_wp, -component)]
      end do
      load = maxval(sums)
   end function load_along

   !> The load of the deck in any direction at FRACTION of STAGE, relative to the end of stage FROM: half the sum of the
   !! magnitudes of its nodal forces and of the magnitude of their resultant. For a single force it is that force, for
   !! self-equilibrated loads one half [force].
   real(wp) function whole_load(model, from, stage, fraction) result(load)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: from, stage
      real(wp), intent(in)         :: fraction
      real(wp), allocatable :: force(:, :)

      call find_load_change(model, from, stage, fraction, force)
      load = 0.5_wp*(sum(norm2(force, dim=1)) + norm2(sum(force, dim=2)))
   end function whole_load

   !> (3, n_nodes) The nodal forces of the deck at FRACTION of STAGE, less those at the end of stage FROM; without moments.
   subroutine find_load_change(model, from, stage, fraction, force)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: from, stage !! positions; before the first there is no load
      real(wp), intent(in)         :: fraction
      real(wp), allocatable, intent(out) :: force(:, :)
      real(wp) :: shares(3)
      integer  :: i, k, stages(3)

      stages = [stage, stage - 1, from]
      shares = [fraction, 1.0_wp - fraction, -1.0_wp]
      allocate (force(3, model%n_nodes), source=0.0_wp)
      do k = 1, 3
         if (abs(shares(k)) <= 0.0_wp .or. stages(k) < 1) cycle
         associate (loads => model%stage_loads(stages(k)))
            do i = 1, loads%n
               if (node_kind(model, loads%node(i)) == a_point) &
                  force(:, loads%node(i)) = force(:, loads%node(i)) + shares(k)*loads%force(:, i)
            end do
         end associate
      end do
   end subroutine find_load_change

   !> Bending moment at the pretension section of a solid bolt: the moment that the elements behind it exert on the nodes of the
   !! section, about the centroid of its area, across the bolt [force x length]. The weight of these elements is neglected.
   pure real(wp) function bending_moment(model, section, u, temperature) result(moment)
      type(model_type), intent(in)   :: model
      type(section_type), intent(in) :: section
      real(wp), intent(in)           :: u(:, :) !! (dimension, n_nodes) of all nodes [length]
      type(temperature_type), intent(in) :: temperature
      type(surface_node_list) :: list
      real(wp) :: centroid(3), force(3), thermal(3, max_nodes), total(3), k(max_felt_dofs, max_felt_dofs), p(max_felt_dofs)
      integer  :: d, e, i, j, n, s

      d = model%dimension
      s = findloc(model%surfaces%id, section%surface, dim=1)
      call surface_nodes(model, model%surfaces(s), list)
      centroid = 0.0_wp
      do i = 1, list%n
         centroid = centroid + list%area(i)*model%x(:, list%node(i))/sum(list%area)
      end do
      total = 0.0_wp
      do j = model%first_at(section%node), model%first_at(section%node + 1) - 1
         e = model%elements_at(j)
         call element_stiffness(model, e, k)
         call element_thermal_forces(model, e, temperature, thermal(:d, :))
         associate (nodes => corners_of(model, e))
            n = d*size(nodes)
            p(:n) = matmul(k(:n, :n), reshape(corner_displacements(model, e, u), [n]))
            do i = 1, size(nodes)
               if (model%node_section(nodes(i)) /= model%element_section(e)) cycle
               force = 0.0_wp
               force(:d) = p(d*(i - 1) + 1:d*i) - thermal(:d, i)
               total = total + cross(model%x(:, nodes(i)) - centroid, force)
            end do
         end associate
      end do
      total = total - dot_product(total, section%direction)*section%direction
      moment = norm2(total)
      if (model%axisymmetric) moment = 0.0_wp ! self-equilibrated around the ring
   end function bending_moment

   !> The bolts after the completed increment, which HISTORY records. The bending of solid bolts is known only where the bodies
   !! are recovered, at the end of a stage.
   subroutine find_bolt_answers(model, analysis, largest_force, history, answers)
      type(model_type), intent(in)      :: model
      type(analysis_type), intent(in)   :: analysis
      real(wp), intent(in)              :: largest_force !! ever applied at a node, for the noise [force]
      type(bolt_history), intent(inout) :: history
      type(bolt_answer_type), allocatable, intent(out) :: answers(:)
      real(wp), allocatable :: clamping(:), force(:), shear(:)
      real(wp) :: floor
      integer  :: i, stage
      logical  :: completed

      stage = analysis%stage
      completed = analysis%fraction >= 1.0_wp
      floor = remainder*largest_force
      allocate (answers(size(history%bolts)), force(size(history%bolts)))
      if (size(answers) == 0) return
      do i = 1, size(answers)
         associate (answer => answers(i), bolt => history%bolts(i))
            answer%id = bolt%id
            if (bolt%bar > 0) then
               force(i) = bar_tension(model, analysis, bolt%bar)
               answer%element = model%bars(bolt%bar)%id
               answer%longer = elongation_now(model, analysis, bolt%bar)
            else
               force(i) = section_tension(model, analysis, bolt%section)
               answer%surface = model%sections(bolt%section)%surface
               answer%longer = -overlap_now(model, analysis, bolt%section)
            end if
            answer%force = above(force(i), floor)
            answer%stress = answer%force/bolt%area
            answer%has_moment = bolt%section > 0 .and. completed
            if (.not. answer%has_moment) cycle
            answer%moment = above(bending_moment(model, model%sections(bolt%section), analysis%all_u, analysis%now%temperature), &
                                  floor*sqrt(bolt%area))
            answer%edge_stress = answer%stress + 4.0_wp*sqrt(pi)*answer%moment/bolt%area**1.5_wp ! W = pi d**3/32, A = pi d**2/4
         end associate
      end do
      allocate (clamping, shear, mold=force)
      call find_clamping(model, analysis, history%bolts, clamping, shear)
      call record_increment(model, analysis, force, clamping, history)
      do i = 1, size(answers)
         associate (answer => answers(i), bolt => history%bolts(i))
            answer%change = above(force(i) - history%before(i), floor)
            answer%load_change = above(load_along(model, bolt%direction, stage, analysis%fraction) &
                                       - load_along(model, bolt%direction, stage - 1, 1.0_wp), floor)
            answer%has_ratio = bolt%stage /= stage .and. abs(answer%load_change) > &
               along_it*whole_load(model, stage - 1, stage, analysis%fraction)
            if (answer%has_ratio) answer%ratio = answer%change/answer%load_change
            answer%is_locked = bolt%stage < stage .or. (bolt%stage == stage .and. completed)
            if (.not. answer%is_locked) cycle
            answer%tightened = above(history%tightened(i), floor)
            answer%largest = above(history%largest(i), floor)
            answer%load = above(history%load, floor)
            answer%has_share = answer%load > 0.0_wp
            if (answer%has_share) answer%share = above(history%change(i), floor)/answer%load
            answer%has_strength = bolt%strength > 0.0_wp
            if (answer%has_strength) answer%use = answer%largest/(bolt%strength*bolt%area)
            if (bolt%joint == 0) cycle
            answer%joint = model%joints(bolt%joint)%id
            answer%clamping = above(clamping(i), floor)
            if (history%clamped(i) > floor) answer%loss = above(1.0_wp - clamping(i)/history%clamped(i), remainder)
            answer%has_safety = model%joints(bolt%joint)%law%has_friction .and. shear(i) > floor
            if (answer%has_safety) answer%safety = model%joints(bolt%joint)%law%mu*max(0.0_wp, clamping(i))/shear(i)
         end associate
      end do
   end subroutine find_bolt_answers

   !> Clamping and shear forces of the own joint around each bolt: sums over the elements of the joint nearest to the axis of
   !! this bolt. Elements equally near to several bolts are shared equally.
   pure subroutine find_clamping(model, analysis, bolts, clamping, shear)
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      type(bolt_place), intent(in)    :: bolts(:)
      real(wp), intent(out)           :: clamping(:), shear(:) !! (bolts) [force]
      real(wp) :: along(3, size(bolts)), off(size(bolts)), share(size(bolts))
      integer  :: b, i

      clamping = 0.0_wp
      along = 0.0_wp
      do i = 1, size(model%interface)
         associate (element => model%interface(i), state => analysis%states(i), own => bolts%joint == model%interface(i)%joint)
            if (.not. any(own)) cycle
            do b = 1, size(bolts)
               off(b) = distance(bolts(b), at_first_end(element, model%x))
            end do
            share = merge(1.0_wp, 0.0_wp, own .and. off <= (1.0_wp + tie)*minval(off, mask=own))
            share = share/sum(share)
            clamping = clamping + share*state%normal%sumf
            do b = 1, size(bolts)
               along(:, b) = along(:, b) + share(b)*matmul(element%axes(:, :2), state%shear%tau*element%area)
            end do
         end associate
      end do
      if (model%axisymmetric) along = 0.0_wp ! self-equilibrated around the ring
      shear = norm2(along, dim=1)
   end subroutine find_clamping

   !> Record the completed increment in HISTORY; a second call for the same increment changes nothing.
   subroutine record_increment(model, analysis, force, clamping, history)
      type(model_type), intent(in)      :: model
      type(analysis_type), intent(in)   :: analysis
      real(wp), intent(in)              :: force(:), clamping(:) !! (bolts) now [force]
      type(bolt_history), intent(inout) :: history

      associate (bolts => history%bolts, stage => analysis%stage)
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
         end if
         where (bolts%stage <= stage) history%largest = max(history%largest, force)
         if (stage > history%assembly) &
            history%load = max(history%load, whole_load(model, history%assembly, stage, analysis%fraction))
         if (whole_load(model, stage - 1, stage, analysis%fraction) <= tie*history%load) return ! thermal load only, or tightened
         where (abs(force - history%assembled) > abs(history%change)) history%change = force - history%assembled
      end associate
   end subroutine record_increment

   !> Write the history to a restart file, or read it for the same model.
   subroutine record_bolts(stream, history)
      type(restart_stream_type), intent(inout) :: stream
      type(bolt_history), intent(inout)        :: history

      call stream%item(history%assembly, history%load, history%before, history%tightened, history%largest, history%assembled)
      call stream%item(history%change, history%clamped)
   end subroutine record_bolts

end module bolt_answers
