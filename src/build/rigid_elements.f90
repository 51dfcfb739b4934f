!> Constraint equations of rigid elements (RBE1, RBE2, RBAR, RROD, RBE3, RBE2M, RBE3M) and of the MPC of case control.
!! Reference nodes of RBE2 have rotations, and those of RBE3 if the card names rotations. An axisymmetric model has none, because
!! the rigid-body motion of a ring is axial only.
module rigid_elements
   use bulk_data, only: equation_card, rigid_card
   use constraint_equations, only: add_dependence, add_expansion, add_term, check_dependences, dependence_list, eliminate, &
                                   expansion_type, solve_for
   use deck_check, only: checked_deck
   use field_rules, only: has_component
   use glued_surfaces, only: add_glue
   use interface_operator, only: interface_element
   use kinds, only: wp
   use mesh_queries, only: n_rotations
   use model_data, only: freedoms_type, mesh_type
   use numbers, only: by_rotation
   use shell_ties, only: add_middles, add_ties, tie_type
   use support_build, only: check_sums, summed_sets
   use surface_build, only: find_surface, surface_node_list, surface_nodes
   use rigid_bars, only: add_rigid_body, add_rod
   use rigid_fit, only: mean_motion
   use text_tools, only: integer_text
   use tolerances, only: zero_area, zero_component_along
   use unknowns, only: component_place, node_axes, place_of_component, rotation_at, third_axis
   implicit none
   private

   public :: build_dependents, name_surface_nodes

contains

   !> Couple the model by the rigid elements and equations of DECK; supports and displacement systems must be known.
   !! Errors: missing or split nodes, components that do not exist, and the errors of check_dependences.
   subroutine build_dependents(deck, ties, glue, mesh, freedoms, expansions)
      type(checked_deck), intent(in)  :: deck
      type(tie_type), intent(in)      :: ties(:) !! from SHELLTO cards
      type(interface_element), intent(in) :: glue(:) !! of glued surfaces
      type(mesh_type), intent(in) :: mesh
      type(freedoms_type), intent(inout) :: freedoms
      type(expansion_type), allocatable, intent(out) :: expansions(:) !! of rigid elements, for temperatures
      type(dependence_list) :: list
      integer, allocatable  :: active(:)  ! active sets of equations
      integer :: i, set

      allocate (expansions(0))
      set = 0
      if (size(deck%control%stages) > 0) set = deck%control%stages(deck%stage)%equations%id
      if (set > 0 .and. all(deck%bulk%equation%set /= set) .and. all(deck%bulk%equation_sum%set /= set)) call deck%errors%add( &
         deck%control%stages(deck%stage)%equations%line, 'MPC: there is no MPC or MPCADD with set '//integer_text(set))
      call check_sums(deck, 'MPCADD', deck%bulk%equation_sum, deck%bulk%equation%set, 'MPC')
      allocate (active, source=summed_sets(deck%bulk%equation_sum, set))
      if (size(deck%rigid) + size(deck%bulk%equation) + size(ties) + size(glue) + size(mesh%middles) == 0) return
      allocate (list%without(mesh%n_nodes), source=.false.)
      do i = 1, size(deck%rigid)
         associate (card => deck%rigid(i))
            if (card%is_mean .and. allocated(card%um_nodes) .and. abs(card%alpha) > 0.0_wp .and. &
                any(deck%control%stages%temperature%id > 0)) call deck%field_error(card%line, card%alpha_at, &
               'not zero, and case control has TEMPERATURE(LOAD), but UM names other dependent components; expected '// &
               'blank or zero', called='ALPHA')
            if (card%is_mean) then
               call add_mean(deck, card, mesh, freedoms, list)
            else if (card%is_rod .or. allocated(card%um_nodes)) then
               call add_several(deck, card, mesh, freedoms, list)
            else
               call add_rigid(deck, card, mesh, freedoms, list)
            end if
         end associate
      end do
      call add_ties(mesh, ties, list)
      call add_middles(mesh, freedoms%held, list)
      do i = 1, size(deck%bulk%equation)
         call add_equation(deck, deck%bulk%equation(i), any(active == deck%bulk%equation(i)%set), mesh, freedoms, list)
      end do
      freedoms%used = freedoms%used .or. list%without
      if (allocated(list%expansions)) expansions = list%expansions(:list%n_expansions)
      if (deck%errors%any() .or. list%n + size(glue) == 0) return
      call check_dependences(deck, mesh, freedoms, list)
      do i = 1, n_rotations(mesh)
         ! springs use those of a point of its own
         if (.not. (mesh%rotations(i)%of_element .or. freedoms%used(mesh%rotations(i)%node))) &
            list%without(mesh%rotations(i)%node) = .true.
         freedoms%used(mesh%rotations(i)%node) = .true.
      end do
      if (deck%errors%any()) return
      call add_glue(deck, glue, mesh, freedoms, list)
      if (deck%keeps_distances) list%item(:list%n)%expands = .true.
      call eliminate(list, mesh, freedoms)
   end subroutine build_dependents

   !> The nodes of RBE2M and RBE3M from their surface. RBE3M uses the tributary areas as weights, so that a load on the reference
   !! node is distributed uniformly over the area. RBE2M excludes GN, which may lie on the surface.
   subroutine name_surface_nodes(deck, mesh)
      type(checked_deck), intent(inout) :: deck
      type(mesh_type), intent(in) :: mesh
      type(surface_node_list) :: list
      logical, allocatable :: counts(:)
      integer :: i, surface

      do i = 1, size(deck%rigid)
         associate (card => deck%rigid(i))
            if (card%surface == 0) cycle
            call find_surface(deck, card%line, 'PID', card%surface, mesh, surface)
            if (surface == 0) cycle
            call surface_nodes(mesh, mesh%surfaces(surface), list)
            if (card%is_mean) then ! on second-order triangles only mid-side nodes have an area
               counts = abs(list%area) > zero_area*maxval(abs(list%area))
            else
               counts = list%node /= mesh%node_table%find(card%node) ! GN may be a NODEAT
            end if
            card%nodes = pack(mesh%node_id(list%node), counts)
            card%weight = pack(list%area, counts)
            card%at = spread(card%at(1), 1, size(card%nodes))
            card%directions = spread(card%directions(1), 1, size(card%nodes))
         end associate
      end do
   end subroutine name_surface_nodes

   !> The constraint equations of an RBE2: components CM of its nodes follow the rigid-body motion of GN, {u} + theta x arm and
   !! theta.
   subroutine add_rigid(deck, card, mesh, freedoms, list)
      type(checked_deck), intent(in)       :: deck
      type(rigid_card), intent(in)         :: card
      type(mesh_type), intent(in) :: mesh
      type(freedoms_type), intent(in) :: freedoms
      type(dependence_list), intent(inout) :: list
      type(component_place) :: own_place, place
      real(wp) :: direction(6), axes(3, 3), motion(6, 6)
      integer  :: c, digit, first, k, node, point
      logical  :: turns_others

      call find_node(deck, card%line, card%node_at, card%node, mesh, freedoms, list, point)
      turns_others = any([(has_component(card%components, c), c = 4, 6)]) .and. &
                     any([(rotation_at(mesh, max(1, mesh%node_table%find(card%nodes(k)))) > 0, k = 1, size(card%nodes))])
      if (no_displacement(mesh, card%components) .and. .not. turns_others) call deck%field_error(card%line, &
         card%components_at, 'contains no displacement of the nodes of this model; expected some of 1 to '// &
         integer_text(mesh%dimension), called='CM')
      do k = 1, size(card%nodes)
         call find_node(deck, card%line, card%at(k), card%nodes(k), mesh, freedoms, list, node)
         if (node == 0 .and. card%surface > 0) return ! one error for all nodes of the surface
         if (node == 0 .or. point == 0) cycle
         if (node == point) then
            call deck%field_error(card%line, card%at(k), 'node '//integer_text(card%node)//' is the independent node GN; '// &
                                  'expected other nodes that move with it', called='G')
            cycle
         end if
         axes = node_axes(mesh, node)
         do digit = 1, 6
            direction = direction_of(mesh, point, digit)
            motion(:3, digit) = direction(:3) + matmul(by_rotation(mesh%x(:, node) - mesh%x(:, point)), direction(4:))
            motion(4:, digit) = direction(4:)
         end do
         do c = 1, 6
            own_place = place_of_component(mesh, node, c)
            if (own_place%node == 0 .or. .not. has_component(card%components, c)) cycle
            call add_dependence(list, own_place, card%line, card%at(k))
            first = merge(0, 3, c <= 3) ! of a displacement, or of a rotation
            do digit = 1, 6
               place = place_of_component(mesh, point, digit)
               if (place%node > 0) call add_term(list, place, dot_product(axes(:, c - first), motion(first + 1:first + 3, digit))* &
                                                 own_place%scale/place%scale)
            end do
            if (c <= 3) call add_expansion(list, [point, node], card%alpha* &
               dot_product(axes(:, c), mesh%x(:, node) - mesh%x(:, point)), card%reference)
         end do
      end do
   end subroutine add_rigid

   !> The constraint equations of a rigid element with independent components at several nodes.
   subroutine add_several(deck, card, mesh, freedoms, list)
      type(checked_deck), intent(in)       :: deck
      type(rigid_card), intent(in)         :: card
      type(mesh_type), intent(in) :: mesh
      type(freedoms_type), intent(in) :: freedoms
      type(dependence_list), intent(inout) :: list
      integer :: k, nodes(size(card%nodes))
      integer, allocatable :: independent(:)

      do k = 1, size(nodes)
         call find_node(deck, card%line, card%at(k), card%nodes(k), mesh, freedoms, list, nodes(k))
      end do
      if (card%is_rod) then
         if (all(nodes > 0)) call add_rod(deck, card, mesh, nodes, list)
         return
      end if
      allocate (independent(size(card%um_nodes)))
      do k = 1, size(independent)
         call find_node(deck, card%line, card%um_at(k), card%um_nodes(k), mesh, freedoms, list, independent(k))
      end do
      if (all(nodes > 0) .and. all(independent > 0)) call add_rigid_body(deck, card, mesh, nodes, independent, list)
   end subroutine add_several

   !> The constraint equation of an MPC if its set is ACTIVE.
   subroutine add_equation(deck, card, active, mesh, freedoms, list)
      type(checked_deck), intent(in)       :: deck
      type(equation_card), intent(in)      :: card
      logical, intent(in)                  :: active
      type(mesh_type), intent(in) :: mesh
      type(freedoms_type), intent(in) :: freedoms
      type(dependence_list), intent(inout) :: list
      type(component_place) :: place(size(card%node))
      integer :: k, node
      logical :: without(mesh%n_nodes)

      without = list%without
      do k = 1, size(card%node)
         call find_node(deck, card%line, card%at(k), card%node(k), mesh, freedoms, list, node)
         if (node == 0 .or. (card%component(k) == 0 .and. deck%errors%any())) cycle ! reported
         place(k) = place_of_component(mesh, node, card%component(k))
         if (place(k)%node == 0) call deck%field_error(card%line, card%at(k) + 1, 'node '//integer_text(card%node(k))// &
            ' has no component '//integer_text(card%component(k)), called='C')
         if (k == 1 .or. place(k)%node == 0) cycle
         if (place(k)%node == place(1)%node .and. place(k)%d == place(1)%d) call deck%field_error(card%line, card%at(k), &
            'this is the dependent component of the first term', called='G')
      end do
      if (.not. active) list%without = without
      if (.not. active .or. any(place%node == 0) .or. deck%errors%any()) return
      call add_dependence(list, place(1), card%line, card%at(1))
      do k = 2, size(place)
         call add_term(list, place(k), -card%factor(k)/card%factor(1)*place(1)%scale/place(k)%scale)
      end do
   end subroutine add_equation

   !> Whether COMPONENTS contain no displacement of the model.
   pure logical function no_displacement(mesh, components)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)          :: components
      integer :: d

      no_displacement = components > 0 .and. .not. any([(has_component(components, d), d = 1, mesh%dimension)])
   end function no_displacement

   !> The NODE with the number ID in data field FIELD of the card on LINE; 0, and an error, for a missing node, or one that a joint
   !! split. A node that belongs to no element is noted in LIST.
   subroutine find_node(deck, line, field, id, mesh, freedoms, list, node)
      type(checked_deck), intent(in)       :: deck
      integer, intent(in)                  :: line, field, id
      type(mesh_type), intent(in) :: mesh
      type(freedoms_type), intent(in) :: freedoms
      type(dependence_list), intent(inout) :: list
      integer, intent(out)                 :: node

      node = 0
      if (id == 0) return
      node = mesh%node_table%find(id)
      if (node == 0) then
         call deck%field_error(line, field, 'there is no GRID '//integer_text(id), called='G')
      else if (mesh%duplicate(node) > 0) then
         call deck%field_error(line, field, 'node '//integer_text(id)//' is split into two nodes by a JOINT, so that it is '// &
            'ambiguous; expected other nodes, or bodies meshed apart', called='G')
         node = 0
      else
         list%without(node) = list%without(node) .or. .not. freedoms%used(node)
      end if
   end subroutine find_node

   !> The constraint equations of an RBE3: components REFC of its node are the weighted mean of those of its nodes.
   subroutine add_mean(deck, card, mesh, freedoms, list)
      type(checked_deck), intent(in)       :: deck
      type(rigid_card), intent(in)         :: card
      type(mesh_type), intent(in) :: mesh
      type(freedoms_type), intent(in) :: freedoms
      type(dependence_list), intent(inout) :: list
      real(wp) :: r(3, size(card%nodes)), axes(3, 3, size(card%nodes)), direction(6)
      real(wp), allocatable :: t(:, :, :)
      type(component_place) :: of_node
      integer  :: before, c, digit, i, m, nodes(size(card%nodes)), point
      logical  :: determined(6), used(6, size(card%nodes))

      before = list%n
      call find_node(deck, card%line, card%node_at, card%node, mesh, freedoms, list, point)
      do i = 1, size(card%nodes)
         call find_node(deck, card%line, card%at(i), card%nodes(i), mesh, freedoms, list, nodes(i))
         if (nodes(i) == 0 .and. card%surface > 0) return ! one error for all nodes of the surface
      end do
      if (no_displacement(mesh, card%components) .and. .not. (has_component(card%components, 6) .or. (mesh%dimension == 3 .and. &
          (has_component(card%components, 4) .or. has_component(card%components, 5))))) &
         call deck%field_error(card%line, 'REFC', 'contains no component of the nodes of this model')
      call check_directions(deck, card, mesh)
      if (point == 0 .or. any(nodes == 0) .or. deck%errors%any()) return
      do i = 1, size(nodes)
         r(:, i) = mesh%x(:, nodes(i)) - mesh%x(:, point)
         axes(:, :, i) = node_axes(mesh, nodes(i))
         if (mesh%dimension == 2) axes(:, 3, i) = third_axis(mesh, nodes(i))
         do c = 1, 6
            of_node = place_of_component(mesh, nodes(i), c)
            used(c, i) = has_component(card%directions(i), c) .and. of_node%node > 0
         end do
      end do
      m = merge(6, 3, any(used(4:, :)))
      allocate (t(6, m, size(nodes)))
      if (mesh%axisymmetric) then ! from axial displacements only
         r = 0.0_wp
         axes([1, 3], :, :) = 0.0_wp
      end if
      call mean_motion(r, axes, used(:m, :), card%weight, t, determined)
      do digit = 1, 6
         if (.not. has_component(card%components, digit)) cycle
         associate (place => place_of_component(mesh, point, digit))
            if (place%node == 0) cycle
            direction = direction_of(mesh, point, digit)
            if (any(.not. determined .and. abs(direction) > zero_component_along)) then
               call deck%field_error(card%line, 'REFC', 'component '//integer_text(digit)//' of node '// &
                  integer_text(card%node)//' does not follow from the components C of these nodes; nodes on a line, for '// &
                  'example, do not determine the rotation about it; expected REFC without this component, a node beside the '// &
                  'line, or 4, 5, 6 in C at nodes with rotations')
               return
            end if
            call add_dependence(list, place, card%line, card%node_at)
            do i = 1, size(nodes)
               do c = 1, m
                  of_node = place_of_component(mesh, nodes(i), c)
                  if (of_node%node > 0) call add_term(list, of_node, place%scale*dot_product(direction, t(:, c, i))/of_node%scale)
                  if (c <= 3) call add_expansion(list, [point, nodes(i)], -card%alpha*place%scale* &
                     dot_product(direction, t(:, c, i))*dot_product(axes(:, c, i), r(:, i)), card%reference)
               end do
            end do
         end associate
      end do
      if (allocated(card%um_nodes)) call exchange(deck, card, mesh, before + 1, list)
   end subroutine add_mean

   !> UM of an RBE3: the named components depend instead of those of the equations of LIST from FIRST on, which are REFC.
   !! Errors: nodes or components that are not on the card, a number of components other than that of REFC, singular equations.
   subroutine exchange(deck, card, mesh, first, list)
      type(checked_deck), intent(in)       :: deck
      type(rigid_card), intent(in)         :: card
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)                  :: first
      type(dependence_list), intent(inout) :: list
      type(component_place) :: places(6*size(card%um_nodes))
      integer :: at(6*size(card%um_nodes)), digit, k, n
      logical :: ok

      n = 0
      do k = 1, size(card%um_nodes)
         if (card%um_nodes(k) /= card%node .and. all(card%nodes /= card%um_nodes(k))) then
            call deck%field_error(card%line, card%um_at(k), 'node '//integer_text(card%um_nodes(k))// &
               ' is neither REFGRID nor one of the nodes of this card', called='UM')
            return
         end if
         do digit = 1, 6
            if (.not. has_component(card%um_components(k), digit)) cycle
            n = n + 1
            places(n) = place_of_component(mesh, mesh%node_table%find(card%um_nodes(k)), digit)
            at(n) = card%um_at(k)
            if (places(n)%node == 0) n = n - 1 ! out-of-plane components of a plane model
         end do
      end do
      ok = n == list%n - first + 1
      if (.not. ok) call deck%field_error(card%line, card%components_at, 'UM names '//integer_text(n)// &
         ' components, but REFC has '//integer_text(list%n - first + 1)//'; expected as many')
      if (.not. ok) return
      call solve_for(list, first, places(:n), at(:n), ok)
      if (.not. ok) call deck%field_error(card%line, card%um_at(1), 'the components after UM cannot be eliminated; expected '// &
         'components that constrain the reference node as REFC does', called='UM')
   end subroutine exchange

   !> The displacement and rotation in global axes that component DIGIT of POINT measures.
   pure function direction_of(mesh, point, digit) result(direction)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)          :: point, digit
      real(wp) :: direction(6), axes(3, 3)

      axes = node_axes(mesh, point)
      if (mesh%dimension == 2) axes(:, 3) = third_axis(mesh, point)
      direction = 0.0_wp
      if (digit <= 3) direction(:3) = axes(:, digit)
      if (digit > 3) direction(4:) = axes(:, digit - 3)
      if (mesh%axisymmetric) direction([1, 3, 4, 5, 6]) = 0.0_wp
   end function direction_of

   !> Error: C without a component that the node has. Rotations in C count at nodes with rotations.
   subroutine check_directions(deck, card, mesh)
      type(checked_deck), intent(in) :: deck
      type(rigid_card), intent(in)   :: card
      type(mesh_type), intent(in) :: mesh
      type(component_place) :: place
      integer :: digit, i, node
      logical :: has_rotation

      do i = 1, size(card%nodes)
         if (card%directions(i) == 0) cycle ! reported already
         node = mesh%node_table%find(card%nodes(i))
         has_rotation = .false.
         do digit = 4, 6
            if (node == 0 .or. .not. has_component(card%directions(i), digit)) cycle
            place = place_of_component(mesh, node, digit)
            has_rotation = has_rotation .or. place%node > 0
         end do
         if (.not. has_rotation .and. no_displacement(mesh, card%directions(i))) then
            call deck%field_error(card%line, card%at(i), 'its components C, '//integer_text(card%directions(i))// &
               ', contain no displacement of the nodes of this model', called='G')
            return
         end if
      end do
   end subroutine check_directions

end module rigid_elements
