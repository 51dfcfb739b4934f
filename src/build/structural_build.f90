!> Beams from their cards: sections and geometry, and the rotation nodes of the model.
!! Nodes of shells and beams and reference nodes have rotations.
module structural_build
   use beam_element, only: beam_axes, beam_length
   use bulk_data, only: edge_card, edge_cbeam, edge_crod, rigid_card
   use bush_build, only: bush_type, stiffness_turns
   use deck_check, only: checked_deck
   use elasticity, only: beam, shell
   use field_rules, only: has_component
   use kinds, only: wp
   use lists, only: id_table_type
   use mesh_queries, only: element_points, is_beam, is_scalar_point, n_rotations, open_left_out
   use model_data, only: freedoms_type, mesh_type, rotation_type
   use node_build, only: append_unknowns
   use rod_torsion, only: add_twisted, leave_out_untwisted
   use tapered_beam, only: beam_station
   use text_tools, only: integer_text
   use unknowns, only: node_axes
   implicit none
   private

   public :: build_beams, build_rotations, has_rotations, is_beam_edge, leave_out_idle

contains

   !> Whether EDGE is a beam: a CBAR or CBEAM whose id is that of a section and of no PMARK.
   pure logical function is_beam_edge(deck, edge)
      type(checked_deck), intent(in) :: deck
      type(edge_card), intent(in)    :: edge

      is_beam_edge = edge%kind /= edge_crod .and. edge%property > 0 .and. any(deck%bulk%beam_property%id == edge%property) &
                     .and. all(deck%bulk%pmark%id /= edge%property)
   end function is_beam_edge

   !> Give a node of rotations, behind the nodes of the deck, to each node of shells and beams and each reference node of rigid
   !! elements. An axisymmetric model has none. Missing nodes are reported elsewhere.
   subroutine build_rotations(deck, bushes, mesh)
      type(checked_deck), intent(in)  :: deck
      type(bush_type), intent(in)     :: bushes(:)
      type(mesh_type), intent(inout) :: mesh
      type(rotation_type), allocatable :: rotations(:)
      integer, allocatable :: elements(:), n_elements(:), points(:)
      real(wp) :: arm, square(mesh%n_nodes)
      integer  :: count_of(mesh%n_nodes), e, i, k, n, node
      logical  :: turns

      if (mesh%axisymmetric) return
      if (size(deck%rigid) + size(bushes) + size(deck%bulk%mass) + size(deck%bulk%matrices%dmig) == 0 .and. &
          all(mesh%properties%state < shell) .and. &
          all(mesh%bars%torsion <= 0.0_wp)) return
      allocate (rotations(size(deck%rigid) + mesh%n_nodes))
      mesh%rotation_of = spread(0, 1, mesh%n_nodes)
      n = 0
      do i = 1, size(deck%rigid) ! reference nodes
         associate (card => deck%rigid(i))
            node = mesh%node_table%find(card%node)
            if (node == 0) cycle
            turns = .not. card%is_mean .or. any([(has_component(card%components, k), k = merge(4, 6, mesh%dimension == 3), 6)])
            if (.not. turns .or. mesh%rotation_of(node) > 0) cycle
            n = n + 1
            rotations(n) = rotation_type(point=node, arm=arm_of(mesh, node, card))
            mesh%rotation_of(node) = n
         end associate
      end do
      do i = 1, size(deck%rigid) ! an end of an RBAR without elements, and nodes of RBE1
         associate (card => deck%rigid(i))
            if (card%is_mean .or. card%surface > 0 .or. mesh%node_table%find(card%node) == 0) cycle
            do e = 1, size(card%nodes)
               if (size(card%nodes) > 1 .and. .not. allocated(card%um_nodes)) exit
               if (any([(has_component(card%directions(e), k), k = 4, 6)])) &
                  call turn(card%nodes(e), arm_of(mesh, mesh%node_table%find(card%node), card))
            end do
            if (.not. allocated(card%um_nodes)) cycle
            do e = 1, size(card%um_nodes)
               if (any([(has_component(card%um_components(e), k), k = 4, 6)])) &
                  call turn(card%um_nodes(e), arm_of(mesh, mesh%node_table%find(card%node), card))
            end do
         end associate
      end do
      do i = 1, size(bushes) ! nodes that springs turn
         do k = 1, 2
            call stiffness_turns(deck, bushes, i, k, turns, arm)
            if (turns) call turn(deck%bulk%spring(i)%nodes(k), arm)
         end do
      end do
      do i = 1, size(deck%bulk%force)
         node = deck%bulk%force(i)%node
         if (deck%bulk%force(i)%is_moment .and. any(deck%bulk%spring%nodes(1) == node .or. deck%bulk%spring%nodes(2) == node)) &
            call turn(node, 1.0_wp)
      end do
      do i = 1, size(deck%bulk%mass)
         if (deck%bulk%mass(i)%component > 3 .or. allocated(deck%bulk%mass(i)%matrix)) call turn(deck%bulk%mass(i)%node, 1.0_wp)
         if (deck%bulk%mass(i)%component_2 > 3) call turn(deck%bulk%mass(i)%node_2, 1.0_wp)
      end do
      do i = 1, size(deck%bulk%matrices%dmig)
         associate (card => deck%bulk%matrices%dmig(i))
            if (all(deck%control%matrices%name /= card%name) .or. .not. allocated(card%nodes)) cycle
            if (card%component > 3) call turn(card%node, 1.0_wp)
            do k = 1, size(card%nodes)
               if (card%components(k) > 3) call turn(card%nodes(k), 1.0_wp)
            end do
         end associate
      end do
      ! nodes of shells and beams; their arm is the root mean square of the distances to the other nodes of their elements
      square = 0.0_wp
      count_of = 0
      do e = 1, mesh%n_elements
         if (.not. has_rotations(mesh, e)) cycle
         associate (nodes => element_points(mesh, e))
            if (any(nodes == 0)) cycle ! reported already
            do i = 1, size(nodes)
               square(nodes(i)) = square(nodes(i)) + sum((mesh%x(:, nodes) - spread(mesh%x(:, nodes(i)), 2, size(nodes)))**2)
               count_of(nodes(i)) = count_of(nodes(i)) + size(nodes) - 1
            end do
         end associate
      end do
      do node = 1, mesh%n_nodes
         if (count_of(node) == 0) cycle
         if (mesh%rotation_of(node) == 0) then
            n = n + 1
            mesh%rotation_of(node) = n
            rotations(n) = rotation_type(point=node, arm=sqrt(square(node)/count_of(node)))
            if (.not. rotations(n)%arm > 0.0_wp) rotations(n)%arm = 1.0_wp
         end if
         rotations(mesh%rotation_of(node))%of_element = .true.
      end do
      call add_twisted(deck, mesh, rotations, n)
      if (n == 0) then
         mesh%rotation_of = [integer ::]
         return
      end if
      mesh%rotations = rotations(:n)
      ! a node for each of them, at its point, with the elements of the point if these have rotations
      mesh%rotations%node = mesh%n_nodes + [(k, k = 1, n)]
      points = [(rotations(k)%point, k = 1, n)]
      associate (first => mesh%first_at)
         n_elements = [(count(is_turned(mesh%elements_at(first(points(k)):first(points(k) + 1) - 1))), k = 1, n)]
         elements = [(mesh%elements_at(first(points(k)):first(points(k) + 1) - 1), k = 1, n)]
         elements = pack(elements, is_turned(elements))
      end associate
      call append_unknowns(mesh, points, n_elements, elements)

   contains

      !> Whether element E has rotations: solids at the node of a shell have no part in its rotation.
      elemental logical function is_turned(e)
         integer, intent(in) :: e

         is_turned = has_rotations(mesh, e)
      end function is_turned

      !> Give node ID rotations, unless it has rotations or belongs to a body.
      subroutine turn(id, arm)
         integer, intent(in)  :: id
         real(wp), intent(in) :: arm !! [length]
         integer :: node

         node = 0
         if (id > 0) node = mesh%node_table%find(id)
         if (node == 0) return
         if (mesh%rotation_of(node) > 0 .or. mesh%first_at(node + 1) > mesh%first_at(node) .or. is_scalar_point(mesh, node)) return
         n = n + 1
         rotations(n) = rotation_type(point=node, arm=arm)
         mesh%rotation_of(node) = n
      end subroutine turn

   end subroutine build_rotations

   !> Whether element E is a shell or a beam, by its property.
   pure logical function has_rotations(mesh, e)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)          :: e

      has_rotations = .false.
      if (mesh%element_property(e) > 0) &
         has_rotations = any(mesh%properties(mesh%element_property(e))%state == [shell, beam])
   end function has_rotations

   !> A scalar point has one component. In the plane the node of rotations has one component, about z; at a node of rods alone, those
   !! that a rod twists.
   subroutine leave_out_idle(mesh, freedoms)
      type(mesh_type), intent(in) :: mesh
      type(freedoms_type), intent(inout) :: freedoms
      integer :: k

      do k = 1, size(mesh%is_scalar)
         if (.not. mesh%is_scalar(k)) cycle
         call open_left_out(mesh, freedoms)
         freedoms%left_out(2:, k) = .true.
         freedoms%held(2:, k) = .true.
      end do
      if (mesh%dimension == 3) call leave_out_untwisted(mesh, freedoms)
      if (mesh%dimension == 3) return
      do k = 1, n_rotations(mesh)
         call open_left_out(mesh, freedoms)
         freedoms%left_out(2, mesh%rotations(k)%node) = .true.
         freedoms%held(2, mesh%rotations(k)%node) = .true.
      end do
   end subroutine leave_out_idle

   !> Root mean square of the distances of the nodes of CARD from POINT; 1 where this is zero [length].
   pure real(wp) function arm_of(mesh, point, card) result(arm)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)          :: point
      type(rigid_card), intent(in) :: card
      integer :: k, n, node

      arm = 0.0_wp
      n = 0
      do k = 1, size(card%nodes)
         node = mesh%node_table%find(card%nodes(k))
         if (node == 0) cycle
         n = n + 1
         arm = arm + sum((mesh%x(:, node) - mesh%x(:, point))**2)
      end do
      arm = sqrt(arm/max(n, 1))
      if (arm <= 0.0_wp) arm = 1.0_wp
   end function arm_of

   !> Build the beams of the model; displacement systems must be known. Errors: a beam without length, or without plane 1.
   subroutine build_beams(deck, mesh)
      type(checked_deck), intent(in)  :: deck
      type(mesh_type), intent(inout) :: mesh
      type(id_table_type) :: edges
      real(wp) :: x(3, 2)
      integer  :: c, e, end, k, other

      if (size(mesh%structural%beams) == 0) return
      call edges%build(deck%bulk%edge%id)
      do e = 1, mesh%n_elements
         if (.not. is_beam(mesh, e)) cycle
         if (any(mesh%element_nodes(:2, e) == 0)) cycle ! reported already
         x = mesh%x(:, mesh%element_nodes(:2, e))
         associate (card => deck%bulk%edge(edges%find(mesh%element_id(e))), &
                    law => mesh%structural%beams(mesh%structural%place(e)), &
                    property => mesh%properties(mesh%element_property(e)))
            k = findloc(deck%bulk%beam_property%id, card%property, dim=1)
            law%beam_section = deck%bulk%beam_property(k)%section
            if (allocated(deck%bulk%beam_property(k)%stations)) then
               law%stations = deck%bulk%beam_property(k)%stations
               law%stations%extra_mass = deck%bulk%parameters%mass_factor*law%stations%extra_mass
            end if
            law%e = property%e
            law%g = deck%bulk%mat1(findloc(deck%bulk%mat1%id, deck%bulk%beam_property(k)%material, dim=1))%shear
            law%rho = property%rho
            law%is_cbeam = card%kind == edge_cbeam
            law%expansion = property%alpha
            law%is_cut = any(deck%bulk%bolt%element == card%id)
            law%extra_mass = deck%bulk%parameters%mass_factor*deck%bulk%beam_property(k)%extra_mass
            law%released = [((has_component(card%pins(end), c), c = 1, 6), end = 1, 2)]
            do end = 1, 2
               law%offset(:, end) = matmul(node_axes(mesh, mesh%element_nodes(end, e)), card%offset(:, end))
            end do
            law%orientation = card%orientation
            if (.not. card%in_basic) law%orientation = matmul(node_axes(mesh, mesh%element_nodes(1, e)), card%orientation)
            if (card%nodes(3) > 0) then
               other = mesh%node_table%find(card%nodes(3))
               if (other == 0) then
                  call deck%field_error(card%line, 'X1', 'there is no GRID '//integer_text(card%nodes(3))// &
                                        ' to lie in plane 1, G0')
                  cycle
               end if
               law%orientation = mesh%x(:, other) - x(:, 1)
            end if
            if (law%is_cut .and. allocated(law%stations)) call deck%errors%add(card%line, 'beam '//integer_text(card%id)// &
               ' is a bolt; expected a section constant along it')
            if (law%is_cut .and. (any(abs(law%offset) > 0.0_wp) .or. any(law%released([1, 7])))) call deck%errors%add(card%line, &
               'beam '//integer_text(card%id)//' is a bolt; expected no offsets, and no pin along it')
            ! I12 couples the planes, shear acts in each alone: their stiffness together is that of the integration along the beam
            if (abs(law%inertia(3)) > 0.0_wp .and. any(law%shear > 0.0_wp) .and. law%area*law%g > 0.0_wp .and. &
                .not. allocated(law%stations)) law%stations = [beam_station(law%beam_section, 0.0_wp, law%extra_mass), &
                                                               beam_station(law%beam_section, 1.0_wp, law%extra_mass)]
            if (.not. beam_length(law, x)**3 > 0.0_wp) then ! the bending stiffness divides by it
               call deck%errors%add(card%line, 'beam '//integer_text(card%id)//' has no length')
               cycle
            end if
            if (.not. norm2(law%orientation) > 0.0_wp) then
               if (mesh%dimension == 3) then
                  call deck%field_error(card%line, 'X1', &
                     'blank: where plane 1 of the beam lies is not given; expected a vector X1, X2, X3 or a node G0')
                  cycle
               end if
               law%orientation = [x(2, 1) - x(2, 2), x(1, 2) - x(1, 1), 0.0_wp] ! plane 1 is the plane of the model
            end if
            if (all(abs(beam_axes(law, x)) <= 0.0_wp)) call deck%field_error(card%line, 'X1', &
               'the orientation of the beam lies along it, and gives no plane 1; expected a direction across the beam')
         end associate
      end do
   end subroutine build_beams

end module structural_build
