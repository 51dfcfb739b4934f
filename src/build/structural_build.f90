!> Shells and beams from their cards: sections and geometry, and the rotation nodes of the model.
!! Nodes of shells and beams and reference nodes have rotations.
module structural_build
   use beam_element, only: beam_axes, beam_length
   use bulk_data, only: edge_card, edge_crod, property_card, rigid_card
   use deck_check, only: checked_deck
   use elasticity, only: beam, elasticity_matrix, max_stresses, plane_stress, shell
   use field_rules, only: has_component
   use kinds, only: wp
   use lists, only: id_table_type
   use mesh_queries, only: element_points, is_beam, is_shell, n_rotations, open_left_out
   use model_data, only: freedoms_type, mesh_type, rotation_type
   use node_build, only: append_unknowns
   use rod_torsion, only: add_twisted, leave_out_untwisted
   use shell_membrane, only: shell_law
   use text_tools, only: integer_text
   use unknowns, only: node_axes
   implicit none
   private

   real(wp), parameter :: one_side = 0.5_wp   ! cosine: triangles at an edge less than 60 degrees apart lie on one side of it

   public :: bow_edges, build_beams, build_rotations, build_shells, is_beam_edge, leave_out_idle

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
   subroutine build_rotations(deck, mesh)
      type(checked_deck), intent(in)  :: deck
      type(mesh_type), intent(inout) :: mesh
      type(rotation_type), allocatable :: rotations(:)
      integer, allocatable :: elements(:), n_elements(:), points(:)
      real(wp) :: square(mesh%n_nodes)
      integer  :: count_of(mesh%n_nodes), e, i, k, n, node
      logical  :: turns

      if (mesh%axisymmetric) return
      if (size(deck%rigid) == 0 .and. all(mesh%properties%state < shell) .and. all(mesh%bars%torsion <= 0.0_wp)) return
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
      do i = 1, size(deck%rigid) ! an end of an RBAR without elements
         associate (card => deck%rigid(i))
            if (card%is_mean .or. card%surface > 0 .or. size(card%nodes) /= 1) cycle
            if (.not. any([(has_component(card%components, k), k = 4, 6)])) cycle
            node = mesh%node_table%find(card%nodes(1))
            if (node == 0 .or. mesh%node_table%find(card%node) == 0) cycle
            if (mesh%rotation_of(node) > 0 .or. mesh%first_at(node + 1) > mesh%first_at(node)) cycle
            n = n + 1
            rotations(n) = rotation_type(point=node, arm=arm_of(mesh, mesh%node_table%find(card%node), card))
            mesh%rotation_of(node) = n
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
         n_elements = merge(first(points + 1) - first(points), 0, rotations(:n)%of_element)
         elements = [(mesh%elements_at(first(points(k)):first(points(k)) + n_elements(k) - 1), k = 1, n)]
      end associate
      call append_unknowns(mesh, points, n_elements, elements)
   end subroutine build_rotations

   !> Whether element E is a shell or a beam, by its property.
   pure logical function has_rotations(mesh, e)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)          :: e

      has_rotations = .false.
      if (mesh%element_property(e) > 0) &
         has_rotations = any(mesh%properties(mesh%element_property(e))%state == [shell, beam])
   end function has_rotations

   !> In the plane the node of rotations has one component, about z; at a node of rods alone, those that a rod twists.
   subroutine leave_out_idle(mesh, freedoms)
      type(mesh_type), intent(in) :: mesh
      type(freedoms_type), intent(inout) :: freedoms
      integer :: k

      if (mesh%dimension == 3) call leave_out_untwisted(mesh, freedoms)
      if (mesh%dimension == 3) return
      do k = 1, n_rotations(mesh)
         if (.not. mesh%rotations(k)%of_element) cycle
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

   !> Build the shells of the model, and set the positions of its beams.
   subroutine build_shells(deck, mesh)
      type(checked_deck), intent(in)  :: deck
      type(mesh_type), intent(inout) :: mesh
      type(shell_law), allocatable :: of_property(:)
      type(id_table_type) :: plates
      integer :: e, i, n(2)

      do i = 1, size(deck%bulk%plate)
         associate (card => deck%bulk%element(deck%bulk%plate(i)%element))
            if (all(mesh%properties%id /= card%property .or. mesh%properties%state /= shell)) call deck%field_error(card%line, &
               'ZOFFS', 'this and thicknesses at corners are for shells in a model of space; expected blanks')
         end associate
      end do
      if (.not. any([(has_rotations(mesh, e), e = 1, mesh%n_elements)])) return
      mesh%structural%place = spread(0, 1, mesh%n_elements)
      allocate (of_property(size(mesh%properties)))
      do i = 1, size(deck%bulk%pshell)
         if (mesh%properties(i)%state == shell) call find_shell(deck, deck%bulk%pshell(i), of_property(i)) ! they come first
      end do
      call plates%build([(deck%bulk%element(deck%bulk%plate(i)%element)%id, i = 1, size(deck%bulk%plate))])
      n = 0
      do e = 1, mesh%n_elements
         if (.not. has_rotations(mesh, e)) cycle
         i = merge(2, 1, is_beam(mesh, e))
         n(i) = n(i) + 1
         mesh%structural%place(e) = n(i)
      end do
      deallocate (mesh%structural%shells, mesh%structural%beams)
      allocate (mesh%structural%shells(n(1)), mesh%structural%beams(n(2)))
      do e = 1, mesh%n_elements
         if (.not. is_shell(mesh, e)) cycle
         associate (law => mesh%structural%shells(mesh%structural%place(e)))
            law = of_property(mesh%element_property(e))
            i = 0
            if (size(deck%bulk%plate) > 0) i = plates%find(mesh%element_id(e))
            if (i == 0) cycle
            law%offset = deck%bulk%plate(i)%offset
            where (deck%bulk%plate(i)%thickness > 0.0_wp) law%thickness = deck%bulk%plate(i)%thickness
         end associate
      end do
   end subroutine build_shells

   !> Find the edges between triangular shells, which their drilling rotations bow (shell_membrane), once shared surfaces are split:
   !! triangles lie on different sides of the edge, and no quadrilateral has it. Triangles on the same nodes lie on one side.
   pure subroutine bow_edges(mesh)
      type(mesh_type), intent(inout) :: mesh
      integer :: b, e, i, k

      do e = 1, mesh%n_elements
         if (.not. is_shell(mesh, e)) cycle
         if (size(element_points(mesh, e)) /= 3) cycle
         associate (nodes => mesh%element_nodes(:3, e), law => mesh%structural%shells(mesh%structural%place(e)))
            do i = 1, 3
               b = nodes(modulo(i, 3) + 1)
               law%bowed(i) = .false.
               do k = mesh%first_at(nodes(i)), mesh%first_at(nodes(i) + 1) - 1
                  associate (other => mesh%elements_at(k))
                     if (.not. is_shell(mesh, other)) cycle
                     if (all(element_points(mesh, other) /= b)) cycle
                     if (size(element_points(mesh, other)) == 4) then
                        law%bowed(i) = .false.
                        exit
                     end if
                     if (dot_product(across(e, nodes(i), b), across(other, nodes(i), b)) < one_side) law%bowed(i) = .true.
                  end associate
               end do
            end do
         end associate
      end do

   contains

      !> The direction from the edge between nodes A and B into triangle E.
      pure function across(e, a, b) result(inward)
         integer, intent(in) :: e, a, b
         real(wp) :: inward(3)

         associate (along => mesh%x(:, b) - mesh%x(:, a), centre => sum(mesh%x(:, mesh%element_nodes(:3, e)), dim=2)/3.0_wp)
            inward = centre - mesh%x(:, a)
            inward = inward - dot_product(inward, along)/max(dot_product(along, along), tiny(1.0_wp))*along
            inward = inward/max(norm2(inward), tiny(1.0_wp))
         end associate
      end function across

   end subroutine bow_edges

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
            law%e = property%e
            law%g = deck%bulk%mat1(findloc(deck%bulk%mat1%id, deck%bulk%beam_property(k)%material, dim=1))%shear
            law%rho = property%rho
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
            if (law%is_cut .and. (any(abs(law%offset) > 0.0_wp) .or. any(law%released([1, 7])))) call deck%errors%add(card%line, &
               'beam '//integer_text(card%id)//' is a bolt; expected no offsets, and no pin along it')
            if (.not. beam_length(law, x) > 0.0_wp) then
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

   !> The LAW of shells of a PSHELL.
   subroutine find_shell(deck, card, law)
      type(checked_deck), intent(in)  :: deck
      type(property_card), intent(in) :: card
      type(shell_law), intent(out)    :: law
      real(wp) :: d(max_stresses, max_stresses)
      integer  :: bending, membrane, shear

      membrane = material_of(card%material)
      bending = material_of(card%bending, 'MID2')
      shear = material_of(card%shear, 'MID3')
      if (any([membrane, bending] == 0)) return
      associate (mat1 => deck%bulk%mat1)
         call elasticity_matrix(plane_stress, mat1(membrane)%e, mat1(membrane)%nu, d)
         law%d = d(:3, :3)
         law%expansion = mat1(membrane)%alpha
         call elasticity_matrix(plane_stress, mat1(bending)%e, mat1(bending)%nu, d)
         law%bending = card%inertia_ratio*d(:3, :3)
         if (shear > 0) law%shear = mat1(shear)%shear*card%shear_ratio
      end associate
      law%thickness = card%thickness

   contains

      !> The MAT1 with this ID; 0: blank, or missing. A missing MID1 is reported elsewhere.
      integer function material_of(id, field) result(k)
         integer, intent(in) :: id
         character(*), intent(in), optional :: field

         k = 0
         if (id <= 0) return
         k = findloc(deck%bulk%mat1%id, id, dim=1)
         if (k == 0 .and. present(field)) call deck%field_error(card%line, field, 'there is no MAT1 '//integer_text(id))
      end function material_of

   end subroutine find_shell

end module structural_build
