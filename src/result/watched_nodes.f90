!> The answer of WATCH at the end of a stage: movement and stiffness at nodes, and shares in the compliance. The shares are
!! those of bodies, joints, bars and springs.
!!
!! With q the internal forces of a component, d its deformations, and Delta the change over the stage, equilibrium at both ends
!! of the stage and the principle of virtual work give, for any nonlinear path between them,
!!
!!     1/2 sum of Delta F . Delta u = 1/2 sum over all components of Delta q . Delta d
!!
!! for all loads, preloads, and moved supports. The shares are those of the right side. For one force F at one node the left
!! side is F . u at the node: the share of a component is its share of the compliance there.
module watched_nodes
   use analysis_state, only: analysis_type
   use body_elements, only: add_thermal_forces, internal_forces
   use bolt_locking, only: bar_tension
   use kinds, only: wp
   use connected_bodies, only: find_bodies
   use mesh_queries, only: element_points, n_points, node_kind
   use model_data, only: a_point, a_spring, bar_nodes, model_type, n_bars
   use restart_stream, only: restart_stream_type
   use stage_plan, only: between, force_between, node_pair
   use structural_elements, only: bar_elongation
   use tolerances, only: least_load, zero_movement, zero_of_sums
   implicit none
   private

   public :: start_watched, find_watched, state_at_end, record_watched

   !> The structure at the end of a stage.
   type, public :: watch_state
      real(wp), allocatable :: u(:, :)          !! (dimension, n_nodes) [length]
      real(wp), allocatable :: force(:, :)      !! (3, interface elements) in their axes [force]
      real(wp), allocatable :: movement(:, :)   !! likewise [length]
      real(wp), allocatable :: tension(:)       !! of bars [force]
   end type watch_state

   type, public :: watched_node
      integer  :: node = 0                      !! its position
      real(wp) :: u(3) = 0.0_wp, change(3) = 0.0_wp !! displacement, and its change over the stage [length]
      real(wp) :: load(3) = 0.0_wp              ! change over the stage of the forces, for the stiffness [force]
      logical  :: is_loaded = .false., moves = .false.
      real(wp) :: along = 0.0_wp                ! the change along the load [length]
      real(wp) :: stiffness = 0.0_wp            ! load over that [force/length]
   end type watched_node

   !> One node against another, along the directions of the pair.
   type, public :: watched_pair
      type(node_pair) :: pair
      real(wp) :: moved(4) = 0.0_wp, change(4) = 0.0_wp !! of the last node less the first, and its change over the stage [length]
      real(wp) :: load(4) = 0.0_wp              !! change over the stage of the force between them; 0: none [force]
      real(wp) :: stiffness(4) = 0.0_wp         !! load over change; 0: no load, or no movement [force/length]
   end type watched_pair

   !> A component and its shares of the work.
   type, public :: compliance_share
      character(6) :: kind = ''
      integer      :: id = 0
      integer      :: first = 0, last = 0       ! of a body: lowest and highest number of its elements
      real(wp)     :: share(2) = 0.0_wp         ! normal, with all of bodies and bars, and shear [-]
   end type compliance_share

   type, public :: watch_answer
      type(watched_node), allocatable  :: nodes(:)
      type(watched_pair), allocatable  :: pairs(:)
      type(compliance_share), allocatable :: parts(:) !! none where the stage does no work
      real(wp) :: work = 0.0_wp                 !! 1/2 sum of Delta q . Delta d [force x length]
   end type watch_answer

contains

   !> The answer for the nodes WATCHED and PAIRS at the end of the completed stage, after recovery of the bodies.
   subroutine find_watched(model, analysis, watched, pairs, before, answer)
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      integer, intent(in)             :: watched(:)  !! positions
      type(node_pair), intent(in)     :: pairs(:)
      type(watch_state), intent(in)   :: before      !! at the end of the stage from which it started
      type(watch_answer), intent(out) :: answer
      type(watch_state) :: now
      real(wp), allocatable :: change(:, :), load(:, :)
      real(wp) :: on_nodes(3), total(3), amount, largest
      integer  :: d, ends(2), i, k

      d = model%mesh%dimension
      now = state_at_end(model, analysis)
      change = now%u - before%u
      largest = maxval(abs(change(:, :n_points(model%mesh))))
      ! change over the stage of the loads of the deck, without preloads and moments [force]
      allocate (load(3, n_points(model%mesh)), source=0.0_wp)
      ends = [model%history%stages(analysis%stage)%from, analysis%stage]
      do i = merge(1, 2, ends(1) > 0), 2
         associate (loads => model%history%stages(ends(i)))
            do k = 1, loads%n
               if (node_kind(model%mesh, loads%node(k)) == a_point) load(:, loads%node(k)) = load(:, loads%node(k)) + &
                  merge(1, -1, ends(i) == analysis%stage)*analysis%fraction*loads%force(:, k)
            end do
         end associate
      end do
      amount = least_load*sum(abs(load))
      on_nodes = sum(load(:, watched), dim=2)
      total = sum(load, dim=2)
      allocate (answer%nodes(size(watched)))
      do k = 1, size(watched)
         associate (answer => answer%nodes(k), node => watched(k))
            answer%node = node
            answer%u(:d) = analysis%all_u(:, node)
            answer%change(:d) = change(:, node)
            answer%load = on_nodes
            if (norm2(on_nodes) <= amount) answer%load = load(:, node)
            if (norm2(answer%load) <= amount) answer%load = total
            answer%is_loaded = norm2(answer%load) > amount
            if (.not. answer%is_loaded) cycle
            answer%along = dot_product(answer%change, answer%load)/norm2(answer%load)
            answer%moves = abs(answer%along) > zero_movement*largest
            if (answer%moves) answer%stiffness = norm2(answer%load)/answer%along
         end associate
      end do
      allocate (answer%pairs(size(pairs)))
      do k = 1, size(pairs)
         associate (answer => answer%pairs(k), pair => pairs(k))
            answer%pair = pair
            answer%moved = between(pair, now%u)
            answer%change = between(pair, change)
            answer%load = force_between(pair, load, amount)
            where (abs(answer%change) > zero_movement*largest) answer%stiffness = answer%load/answer%change
         end associate
      end do
      call share_work(model, analysis, change, before, now, answer)
   end subroutine find_watched

   !> The shares of bodies, joints, bars and springs in the work over the stage, in which the nodes moved by CHANGE. The work of a
   !! body is that of its nodal forces less the thermal forces.
   subroutine share_work(model, analysis, change, before, now, answer)
      type(model_type), intent(in)       :: model
      type(analysis_type), intent(in)    :: analysis
      real(wp), intent(in)               :: change(:, :) !! (dimension, n_nodes) [length]
      type(watch_state), intent(in)      :: before, now  !! at both ends of the stage
      type(watch_answer), intent(inout)  :: answer
      type(compliance_share), allocatable   :: parts(:)
      real(wp), allocatable :: f(:, :), thermal(:, :)
      integer, allocatable  :: of_node(:)
      integer  :: body(model%mesh%n_elements), e, i, n_bodies, n_joints, node
      real(wp) :: work(3), all_amounts

      ! the bodies
      call find_bodies(model%mesh, body, n_bodies)
      allocate (parts(n_bodies))
      allocate (of_node(model%mesh%n_nodes), source=0)
      parts%kind = 'BODY'
      parts%first = huge(1)
      do e = 1, model%mesh%n_elements
         associate (part => parts(body(e)))
            part%id = body(e)
            part%first = min(part%first, model%mesh%element_id(e))
            part%last = max(part%last, model%mesh%element_id(e))
         end associate
         of_node(element_points(model%mesh, e)) = body(e)
         if (size(model%mesh%element_section) > 0) then
            if (model%mesh%element_section(e) > 0) of_node(model%mesh%sections(model%mesh%element_section(e))%node) = body(e)
         end if
      end do
      allocate (f, mold=change)
      call internal_forces(model, change, f)
      allocate (thermal, source=0.0_wp*change)
      if (allocated(analysis%before%temperature%at)) call add_thermal_forces(model, analysis%before%temperature, thermal)
      f = f + thermal
      thermal = 0.0_wp
      if (allocated(analysis%now%temperature%at)) call add_thermal_forces(model, analysis%now%temperature, thermal)
      f = f - thermal
      do node = 1, model%mesh%n_nodes
         if (of_node(node) == 0) cycle
         associate (part => parts(of_node(node)))
            part%share(1) = part%share(1) + 0.5_wp*dot_product(f(:, node), change(:, node))
         end associate
      end do

      ! the joints, bars and springs
      n_joints = size(model%joints%list)
      parts = [parts, [(compliance_share('JOINT', model%joints%list(i)%id), i = 1, n_joints)], &
               [(compliance_share(merge('SPRING', 'BAR   ', model%mesh%bars(i)%kind == a_spring), model%mesh%bars(i)%id), &
                 i = 1, n_bars(model%mesh))]]
      do i = 1, n_bars(model%mesh)
         if (model%mesh%bars(i)%bolt > 0) parts(n_bodies + n_joints + i) = compliance_share('BOLT', model%mesh%bars(i)%bolt)
      end do
      do i = 1, size(model%joints%element)
         work = 0.5_wp*(now%force(:, i) - before%force(:, i))*(now%movement(:, i) - before%movement(:, i))
         associate (part => parts(n_bodies + model%joints%element(i)%joint))
            part%share = part%share + [work(3), work(1) + work(2)]
         end associate
      end do
      do i = 1, n_bars(model%mesh)
         parts(n_bodies + n_joints + i)%share(1) = 0.5_wp*(now%tension(i) - before%tension(i))* &
                                                   bar_elongation(model%mesh%bars(i), change(:, bar_nodes(model%mesh%bars(i))))
      end do

      ! works become shares, unless they are only rounding
      all_amounts = sum([(sum(abs(parts(i)%share)), i = 1, size(parts))])
      answer%work = sum([(sum(parts(i)%share), i = 1, size(parts))])
      if (abs(answer%work) <= zero_of_sums*all_amounts .or. &
          all_amounts <= zero_of_sums**2*analysis%largest_load*maxval(abs(analysis%all_u))) parts = parts(:0)
      do i = 1, size(parts)
         parts(i)%share = parts(i)%share/answer%work
      end do
      call move_alloc(parts, answer%parts)
   end subroutine share_work

   !> Before the first stage all is at rest.
   pure subroutine start_watched(model, before)
      type(model_type), intent(in)   :: model
      type(watch_state), intent(out) :: before

      allocate (before%u(model%mesh%dimension, model%mesh%n_nodes), before%force(3, size(model%joints%element)), &
                before%movement(3, size(model%joints%element)), before%tension(n_bars(model%mesh)), source=0.0_wp)
   end subroutine start_watched

   !> The structure at the end of the completed stage.
   pure function state_at_end(model, analysis) result(now)
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      type(watch_state) :: now
      integer :: i

      allocate (now%u, source=analysis%all_u)
      allocate (now%force, now%movement, source=analysis%movement)
      do i = 1, size(model%joints%element)
         now%force(:, i) = [analysis%states(i)%shear%tau*model%joints%element(i)%area, analysis%states(i)%normal%sumf]
      end do
      allocate (now%tension, source=[(bar_tension(model, analysis, i), i = 1, n_bars(model%mesh))])
   end function state_at_end

   subroutine record_watched(stream, state)
      type(restart_stream_type), intent(inout) :: stream
      type(watch_state), intent(inout)         :: state !! made by start_watched for the same model

      call stream%part('watch_state', 1)
      call stream%item('u', state%u)
      call stream%item('force', state%force)
      call stream%item('movement', state%movement)
      call stream%item('tension', state%tension)
   end subroutine record_watched

end module watched_nodes
