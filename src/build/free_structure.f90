!> Supports of a structure whose free modes are requested: statically determinate ones where it has none, and none for its modes.
!! The reference state of the modes needs determinate ones: as many components are held as the structure has rigid-body motions. A
!! self-equilibrated load causes no reactions there.
module free_structure
   use connected_bodies, only: find_bodies
   use deck_check, only: checked_deck
   use interface_operator, only: named_node
   use kinds, only: wp
   use mesh_queries, only: element_points, is_face_node, is_scalar_point, n_points, node_kind, place_in_kind, point_of
   use model_data, only: a_point, a_rotation, freedoms_type, history_type, joints_type, mesh_type, model_type, n_bars, n_sections, &
                         rotation_type, support_group, supported
   use numbers, only: cross, first_largest
   use support_build, only: hold
   use tolerances, only: balanced
   use unknowns, only: component_place, motions_at, n_motions, node_axes, place_of_component, rotation_at
   implicit none
   private

   public :: beside, hold_free_structure, release_supports, check_balance

contains

   !> Support the structure if it has no supports and some stage has MODES(FREE) or METHOD = set, or INREL = -2: all components of a node with
   !! rotations, else 3, 2 and 1 components of three distant nodes of the largest body. Dependent nodes are skipped, and nodes with
   !! CD where there are others.
   !! With METHOD = set and with INREL = -2 supports that leave rigid-body motions are completed.
   subroutine hold_free_structure(deck, mesh, joints, freedoms)
      type(checked_deck), intent(in)  :: deck
      type(mesh_type), intent(in) :: mesh
      type(joints_type), intent(in) :: joints
      type(freedoms_type), intent(inout) :: freedoms
      integer  :: body(mesh%n_elements), body_of(mesh%n_nodes), a, b, c, e, i, k, n
      logical  :: may_be(mesh%n_nodes)
      real(wp) :: along(3), off(mesh%n_nodes), turn(3)
      logical  :: are_free(size(deck%control%stages)), is_held, relieved

      relieved = deck%bulk%parameters%relief == -2
      associate (asked => deck%control%stages%vibration)
         are_free = asked%free .or. asked%by_method
         is_held = any(freedoms%held(:, :mesh%n_nodes - n_sections(mesh)))
         if (is_held) are_free = asked%by_method .and. size(deck%bulk%suport) == 0 .and. .not. mesh%axisymmetric
         are_free = are_free .or. relieved
         if (.not. any(are_free .and. deck%shares([(i, i = 1, size(asked))]))) return
         if (.not. relieved .and. any(asked%modes%id /= 0 .and. .not. are_free .and. deck%shares([(i, i = 1, size(asked))]))) return
      end associate
      if (any(deck%bulk%spring%nodes(1) == 0 .or. deck%bulk%spring%nodes(2) == 0)) return ! a grounded spring
      do i = 1, size(joints%element)
         if (named_node(joints%element(i), 2) == 0) return                               ! a rigid base
      end do
      ! the nodes of the largest body that may be held
      call find_bodies(mesh, body, n)
      body_of = 0
      do e = 1, mesh%n_elements
         body_of(element_points(mesh, e)) = body(e)
      end do
      if (mesh%n_elements == 0) then ! springs and masses alone; springs or a matrix may hold what supports leave
         if (is_held .or. any([(allocated(mesh%bars(i)%matrix), i = 1, n_bars(mesh))])) return
         body_of(:n_points(mesh)) = merge(1, 0, freedoms%used(:n_points(mesh)) .and. &
                                                .not. [(is_scalar_point(mesh, i), i = 1, n_points(mesh))])
         n = 1
      end if
      do i = 1, 4                                   ! nodes of no rigid element and equation; where there is none, independent ones
         may_be = body_of == maxloc([(count(body_of == k), k = 1, n)], dim=1)
         if (size(mesh%node_system) > 0 .and. i <= 2) may_be = may_be .and. mesh%node_system(:size(may_be)) == 0
         may_be = may_be .and. .not. depend(deck, mesh, all_of_them=modulo(i, 2) == 1)
         may_be = may_be .and. mesh%duplicate == 0 .and. .not. [(is_face_node(mesh, k), k = 1, size(may_be))]
         if (any(may_be)) exit
      end do
      if (is_held) then
         call hold_rest(mesh, may_be, freedoms)
         return
      end if
      a = findloc(may_be, .true., dim=1)
      if (a == 0) return
      freedoms%floats = .true.
      if (mesh%n_elements == 0 .or. has_system(mesh, a)) then ! any components
         call hold_rest(mesh, may_be, freedoms)
         return
      end if
      freedoms%support_groups = [support_group('FREE')]
      if (rotation_at(mesh, a) > 0) then
         if (mesh%rotations(rotation_at(mesh, a))%of_element) then
            call hold(mesh, freedoms, a, merge(123456, 126, mesh%dimension == 3))
            return
         end if
      end if
      if (mesh%axisymmetric) then
         call hold(mesh, freedoms, a, 2)
         return
      end if
      ! the node b farthest from a, and in space the node c farthest from the line through both
      call hold(mesh, freedoms, a, merge(123, 12, mesh%dimension == 3))
      off = [(norm2(mesh%x(:, i) - mesh%x(:, a)), i = 1, size(off))]
      b = first_largest(off, may_be)
      along = (mesh%x(:, b) - mesh%x(:, a))/max(off(b), tiny(1.0_wp))
      k = first_largest(abs(along))
      if (mesh%dimension == 2) then ! the structure turns about a: the component with the largest movement
         call hold(mesh, freedoms, b, merge(2, 1, k == 1))
         return
      end if
      call hold(mesh, freedoms, b, merge(23, merge(13, 12, k == 2), k == 1))
      off = [(norm2(cross(along, mesh%x(:, i) - mesh%x(:, a))), i = 1, size(off))]
      c = first_largest(off, may_be)
      turn = cross(along, mesh%x(:, c) - mesh%x(:, a))
      call hold(mesh, freedoms, c, first_largest(abs(turn)))
   end subroutine hold_free_structure

   !> Whether the components of NODE are along a system CD.
   pure logical function has_system(mesh, node)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)         :: node

      has_system = .false.
      if (size(mesh%node_system) > 0 .and. .not. mesh%axisymmetric) has_system = mesh%node_system(node) /= 0
   end function has_system

   !> Which nodes depend on others by rigid elements and equations; ALL_OF_THEM: or others on them.
   pure function depend(deck, mesh, all_of_them) result(does)
      type(checked_deck), intent(in) :: deck
      type(mesh_type), intent(in)    :: mesh
      logical, intent(in)            :: all_of_them
      logical :: does(mesh%n_nodes)
      integer :: i

      does = .false.
      do i = 1, size(deck%bulk%equation)
         call note(deck%bulk%equation(i)%node)
      end do
      do i = 1, size(deck%rigid)
         associate (rigid => deck%rigid(i), all_nodes => all_of_them .or. allocated(deck%rigid(i)%um_nodes) .or. &
                                                         deck%rigid(i)%is_rod)
            if (all_nodes .or. .not. rigid%is_mean) call note(rigid%nodes)
            if (all_nodes .or. rigid%is_mean) call note([rigid%node])
         end associate
      end do

   contains

      pure subroutine note(ids)
         integer, intent(in) :: ids(:)
         integer :: k

         do k = 1, size(ids)
            if (mesh%node_table%find(ids(k)) > 0) does(mesh%node_table%find(ids(k))) = .true.
         end do
      end subroutine note

   end function depend

   !> MODEL without its supports, or those of SUPORT where it has any; the condition on the axis of a ring remains.
   pure subroutine release_supports(model)
      type(model_type), intent(inout) :: model
      logical :: free(model%mesh%dimension), some
      integer :: d, i

      associate (groups => model%freedoms%support_groups, of => model%freedoms%support_of)
         some = any(groups%kind == 'FREE')
         do i = 1, model%mesh%n_nodes - n_sections(model%mesh)
            free = supported(model%mesh, model%freedoms, i)
            do d = 1, merge(size(free), 0, some)
               if (free(d)) free(d) = groups(of(d, i))%kind == 'FREE'
            end do
            if (model%mesh%axisymmetric) free(1) = free(1) .and. abs(model%mesh%x(1, i)) > 0.0_wp
            model%freedoms%held(:, i) = model%freedoms%held(:, i) .and. .not. free
         end do
      end associate
   end subroutine release_supports

   !> Hold the rigid-body motions of the structure that its supports leave, at nodes that MAY BE held: each by the component that moves
   !! most in those that are left.
   subroutine hold_rest(mesh, may_be, freedoms)
      type(mesh_type), intent(in) :: mesh
      logical, intent(in)         :: may_be(:) !! (n_nodes)
      type(freedoms_type), intent(inout) :: freedoms
      type(component_place) :: place
      real(wp) :: basis(n_motions(mesh%dimension), n_motions(mesh%dimension)) ! of the motions that are held, columns
      real(wp) :: centre(3), extent, most, moves
      integer  :: best(2), d, digit, node, rank
      logical  :: opens ! the group of these supports

      centre = sum(mesh%x(:, :n_points(mesh)), dim=2)/n_points(mesh)
      extent = max(maxval(abs(mesh%x(:, :n_points(mesh)) - spread(centre, 2, n_points(mesh)))), tiny(1.0_wp))
      rank = 0
      do node = 1, mesh%n_nodes - n_sections(mesh)
         if (node_kind(mesh, node) == a_rotation) then
            if (.not. turns(mesh%rotations(place_in_kind(mesh, node)))) cycle
         end if
         do d = 1, mesh%dimension
            if (freedoms%held(d, node)) call add(left_of(node, d))
         end do
      end do
      opens = .true.
      do while (rank < size(basis, 1))
         most = 0.0_wp
         do node = 1, size(may_be)
            if (.not. may_be(node)) cycle
            do digit = 1, 6
               place = place_of_component(mesh, node, digit)
               if (place%node == 0) cycle
               if (freedoms%held(place%d, place%node)) cycle
               if (digit > 3) then
                  if (.not. turns(mesh%rotations(rotation_at(mesh, node)))) cycle
               end if
               moves = norm2(left_of(place%node, place%d))
               if (moves <= (1.0_wp + balanced)*most) cycle
               most = moves
               best = [node, digit]
            end do
         end do
         if (most <= balanced) return
         if (opens) freedoms%support_groups = [freedoms%support_groups, support_group('FREE')]
         opens = .false.
         place = place_of_component(mesh, best(1), best(2))
         call add(left_of(place%node, place%d))
         call hold(mesh, freedoms, best(1), best(2))
      end do

   contains

      !> Whether the structure turns with ROTATION.
      pure logical function turns(rotation)
         type(rotation_type), intent(in) :: rotation

         turns = (rotation%of_element .or. mesh%n_elements == 0) .and. .not. rotation%of_rods
      end function turns

      !> How component D of NODE moves in the motions that are not held yet.
      function left_of(node, d) result(left)
         integer, intent(in) :: node, d
         real(wp) :: left(size(basis, 1)), axes(3, 3)

         axes = node_axes(mesh, point_of(mesh, node))
         left = 0.0_wp
         if (node_kind(mesh, node) == a_point) then
            left = matmul(axes(:mesh%dimension, d), motions_at((mesh%x(:mesh%dimension, node) - centre(:mesh%dimension))/extent))
         else if (mesh%dimension == 3) then
            left(4:) = axes(:, d)
         else
            left(3) = merge(1.0_wp, 0.0_wp, d == 1)
         end if
         left = beside(left, basis(:, :rank))
      end function left_of

      subroutine add(left)
         real(wp), intent(in) :: left(:)

         if (norm2(left) <= balanced) return
         rank = rank + 1
         basis(:, rank) = left/norm2(left)
      end subroutine add

   end subroutine hold_rest

   !> What MOTION has beside the orthonormal columns of BASIS.
   pure function beside(motion, basis) result(left)
      real(wp), intent(in) :: motion(:)
      real(wp), intent(in) :: basis(:, :) !! (size of MOTION, columns)
      real(wp) :: left(size(motion))
      integer  :: k

      left = motion
      do k = 1, 2*size(basis, 2) ! twice against rounding
         associate (b => basis(:, 1 + modulo(k - 1, size(basis, 2))))
            left = left - dot_product(left, b)*b
         end associate
      end do
   end function beside

   !> Error: a load of a stage that is not self-equilibrated, in a structure without supports.
   subroutine check_balance(deck, mesh, freedoms, history)
      type(checked_deck), intent(in) :: deck
      type(mesh_type), intent(in) :: mesh
      type(freedoms_type), intent(in) :: freedoms
      type(history_type), intent(in) :: history
      real(wp) :: force(3), moment(3), of_forces, of_moments, arm ! sums of amounts: the scales of rounding
      integer  :: i, s

      if (.not. freedoms%floats .or. deck%bulk%parameters%relief_line > 0) return ! inertia forces will balance the loads
      arm = maxval(maxval(mesh%x, dim=2) - minval(mesh%x, dim=2))
      do s = 1, size(history%stages)
         if (.not. deck%shares(s)) cycle
         force = 0.0_wp
         moment = 0.0_wp
         of_forces = 0.0_wp
         of_moments = 0.0_wp
         associate (loads => history%stages(s))
            do i = 1, loads%n
               if (node_kind(mesh, loads%node(i)) == a_point) then
                  of_forces = of_forces + norm2(loads%force(:, i))
                  force = force + loads%force(:, i)
                  moment = moment + cross(mesh%x(:, loads%node(i)), loads%force(:, i))
               else if (node_kind(mesh, loads%node(i)) == a_rotation) then
                  associate (rotation => mesh%rotations(place_in_kind(mesh, loads%node(i))))
                     of_moments = of_moments + rotation%arm*norm2(loads%force(:, i))
                     if (mesh%dimension == 3) moment = moment + rotation%arm*loads%force(:, i)
                     if (mesh%dimension == 2) moment(3) = moment(3) + rotation%arm*loads%force(1, i)
                  end associate
               end if
            end do
         end associate
         if (mesh%axisymmetric) force(1) = 0.0_wp
         if (mesh%axisymmetric) moment = 0.0_wp
         if (norm2(force) > balanced*of_forces .or. norm2(moment) > balanced*(of_forces*arm + of_moments)) call deck%errors%add( &
            deck%control%stages(s)%load%line, 'LOAD: nothing supports the structure, and this load does not balance itself; '// &
            'expected a support')
      end do
   end subroutine check_balance

end module free_structure
