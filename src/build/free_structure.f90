!> Statically determinate supports for a structure without supports whose free modes are requested.
!! The reference state of the modes needs them: as many components are held as the structure has rigid-body motions. A
!! self-equilibrated load causes no reactions there.
module free_structure
   use connected_bodies, only: find_bodies
   use deck_check, only: checked_deck
   use interface_operator, only: named_node
   use kinds, only: wp
   use mesh_queries, only: element_points, is_face_node, node_kind, place_in_kind
   use model_data, only: a_point, a_rotation, freedoms_type, history_type, joints_type, mesh_type, n_sections, support_group
   use numbers, only: cross, first_largest
   use support_build, only: hold
   use tolerances, only: balanced
   use unknowns, only: rotation_at
   implicit none
   private

   public :: hold_free_structure, check_balance

contains

   !> Support the structure if it has no supports and some stage has MODES(FREE) or METHOD = set: all components of a node with rotations,
   !! else 3, 2 and 1 components of three distant nodes of the largest body. Dependent nodes and nodes with CD are skipped.
   subroutine hold_free_structure(deck, mesh, joints, freedoms)
      type(checked_deck), intent(in)  :: deck
      type(mesh_type), intent(in) :: mesh
      type(joints_type), intent(in) :: joints
      type(freedoms_type), intent(inout) :: freedoms
      integer  :: body(mesh%n_elements), body_of(mesh%n_nodes), a, b, c, e, i, k, n
      integer, allocatable :: dependent(:)
      logical  :: may_be(mesh%n_nodes)
      real(wp) :: along(3), off(mesh%n_nodes), turn(3)
      logical  :: are_free(size(deck%control%stages))

      associate (asked => deck%control%stages%vibration)
         are_free = asked%free .or. asked%by_method
         if (.not. any(are_free .and. deck%shares([(i, i = 1, size(asked))])) .or. &
             any(freedoms%held(:, :mesh%n_nodes - n_sections(mesh)))) return
         if (any(asked%modes%id > 0 .and. .not. are_free .and. deck%shares([(i, i = 1, size(asked))]))) return
      end associate
      if (any(deck%bulk%spring%nodes(1) == 0 .or. deck%bulk%spring%nodes(2) == 0)) return ! a grounded spring
      do i = 1, size(joints%element)
         if (named_node(joints%element(i), 2) == 0) return                               ! a rigid base
      end do
      if (mesh%n_elements == 0) return
      ! the nodes of the largest body that may be held
      call find_bodies(mesh, body, n)
      body_of = 0
      do e = 1, mesh%n_elements
         body_of(element_points(mesh, e)) = body(e)
      end do
      may_be = body_of == maxloc([(count(body_of == i), i = 1, n)], dim=1)
      if (size(mesh%node_system) > 0) may_be = may_be .and. mesh%node_system(:size(may_be)) == 0
      dependent = [([deck%rigid(i)%nodes, deck%rigid(i)%node], i = 1, size(deck%rigid)), &
                   (deck%bulk%equation(i)%node, i = 1, size(deck%bulk%equation))]
      do i = 1, size(dependent) ! these nodes depend on each other
         k = mesh%node_table%find(dependent(i))
         if (k > 0) may_be(k) = .false.
      end do
      do i = 1, size(may_be)
         may_be(i) = may_be(i) .and. .not. is_face_node(mesh, i) .and. mesh%duplicate(i) == 0
      end do
      a = findloc(may_be, .true., dim=1)
      if (a == 0) return
      freedoms%floats = .true.
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

   !> Error: a load of a stage that is not self-equilibrated, in a structure without supports.
   subroutine check_balance(deck, mesh, freedoms, history)
      type(checked_deck), intent(in) :: deck
      type(mesh_type), intent(in) :: mesh
      type(freedoms_type), intent(in) :: freedoms
      type(history_type), intent(in) :: history
      real(wp) :: force(3), moment(3), of_forces, of_moments, arm ! sums of amounts: the scales of rounding
      integer  :: i, s

      if (.not. freedoms%floats) return
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
