!> Body elements, their properties and marked sides, from cards to positions; checks of their shape.
module element_build
   use bulk_data, only: element_card, grid_card, property_card
   use deck_check, only: checked_deck
   use elasticity, only: axisymmetric, beam, shell, solid
   use element_kinds, only: element_table, kind_edge2, kind_quad4, kind_quad8, kind_tria3, kind_tria6
   use element_mapping, only: smallest_jacobian
   use kinds, only: wp
   use lists, only: id_table_type, sorted_order
   use mesh_queries, only: element_points
   use model_data, only: mesh_type, property_type
   use node_build, only: blank_node, find_nodes
   use shell_membrane, only: flat_coordinates
   use solid_materials, only: take_solid_material
   use spring_build, only: is_bar
   use structural_build, only: is_beam_edge
   use text_tools, only: integer_text, one_of
   use tolerances, only: same_corner
   implicit none
   private

   real(wp), parameter :: misplaced = 0.3_wp     ! of an edge: a mid-side node farther off its middle is that of another edge
   integer, parameter :: few = 4096 ! number of elements up to which one thread is used

   public :: resolve_properties, collect_elements, collect_sides, check_elements, is_face

   !> A marked side, before it is sorted into a surface: its card with the PMARK as its property and positions of nodes (0 for a
   !! mid-side node left blank). The id is -k for side Sk of a block.
   type, extends(element_card), public :: marked_side
      integer :: corners = 0               !! 2, 3 or 4
      integer :: n_nodes = 0               !! corners, and mid-side nodes if the mark is second-order
   end type marked_side

contains

   !> Whether an element card marks a face: in space a CTRIA3, CQUAD4 or second-order card whose property is no PSHELL.
   elemental logical function is_face(mesh, card)
      type(mesh_type), intent(in) :: mesh
      type(element_card), intent(in) :: card

      is_face = mesh%dimension == 3 .and. element_table(card%kind)%dimension == 2
      if (is_face) is_face = .not. any(mesh%properties%id == card%property .and. mesh%properties%state == shell)
   end function is_face

   !> Every PSHELL, PAXIS and PSOLID with its material, followed by the sections of beams. In space a PSHELL with a bending material
   !! is a shell property.
   subroutine resolve_properties(deck, mesh)
      type(checked_deck), intent(in)  :: deck
      type(mesh_type), intent(inout) :: mesh
      type(property_card), allocatable :: cards(:)
      type(id_table_type) :: materials
      integer :: i, k

      call materials%build(deck%bulk%mat1%id)
      allocate (cards, source=[deck%bulk%pshell, deck%bulk%paxis, deck%bulk%psolid, (property_card( &
         line=deck%bulk%beam_property(i)%line, id=deck%bulk%beam_property(i)%id, material=deck%bulk%beam_property(i)%material, &
         state=beam), i = 1, size(deck%bulk%beam_property))])
      deallocate (mesh%properties)
      allocate (mesh%properties(size(cards)))
      do i = 1, size(cards)
         associate (card => cards(i), property => mesh%properties(i))
            property = property_type(id=card%id, state=card%state, thickness=card%thickness, incompatible=card%incompatible)
            if (mesh%dimension == 3 .and. i <= size(deck%bulk%pshell) .and. card%bending > 0) then
               property%state = shell
               property%fibre = card%fibre
               property%extra_mass = deck%bulk%parameters%mass_factor*card%extra_mass
            end if
            if (card%bends_alone .and. property%state /= shell) call deck%field_error(card%line, 'MID1', &
               'blank, as of a shell that bends alone; expected a MAT1 in the plane')
            k = materials%find(card%material)
            if (k > 0) call check_plate_material(k, card, property%state)
            if (k > 0) then
               property%e = deck%bulk%mat1(k)%e
               property%nu = deck%bulk%mat1(k)%nu
               if (deck%bulk%mat1(k)%bars_only .and. .not. (card%state == beam .and. deck%bulk%mat1(k)%shear > 0.0_wp)) &
                  call deck%field_error(card%line, card%material_at, 'MAT1 '//integer_text(card%material)// &
                                        ' is for bars alone; expected two of E, G and NU, with NU above -1 and below 0.5')
               property%rho = deck%bulk%parameters%mass_factor*deck%bulk%mat1(k)%rho
               if (property%state < axisymmetric .and. card%thickness > 0.0_wp) & ! a membrane
                  property%rho = property%rho + deck%bulk%parameters%mass_factor*card%extra_mass/card%thickness
               property%alpha = deck%bulk%mat1(k)%alpha
               property%strength = deck%bulk%mat1(k)%strength
               property%damping = deck%bulk%mat1(k)%damping
               property%reference = deck%bulk%mat1(k)%reference
               if (allocated(card%plies)) call take_laminate(card, property)
               if (allocated(deck%bulk%mat1(k)%solid)) call take_solid_material(deck, mesh, card, deck%bulk%mat1(k), property)
            else if (card%material > 0) then
               call deck%field_error(card%line, card%material_at, 'there is no MAT1 '//integer_text(card%material))
            end if
         end associate
      end do

   contains

      !> MAT2 and MAT8, number K, are for shells, MAT9 is for solids.
      subroutine check_plate_material(k, card, state)
         integer, intent(in)             :: k, state
         type(property_card), intent(in) :: card

         if (deck%bulk%mat1(k)%name == 'MAT9') return
         if (deck%bulk%mat1(k)%name /= 'MAT1' .and. state /= shell) call deck%field_error(card%line, card%material_at, &
            deck%bulk%mat1(k)%name//' '//integer_text(card%material)//' is for shells: PCOMP, or PSHELL with MID2, in a model '// &
            'of space; expected a MAT1')
      end subroutine check_plate_material

      !> The mean density, TREF and GE of a laminate.
      subroutine take_laminate(card, property)
         type(property_card), intent(in)    :: card
         type(property_type), intent(inout) :: property
         integer :: i, k

         property%rho = 0.0_wp
         property%reference = card%reference
         property%damping = card%damping
         do i = 1, size(card%plies)
            k = materials%find(card%plies(i)%material)
            if (k > 0 .and. card%thickness > 0.0_wp) property%rho = property%rho + deck%bulk%parameters%mass_factor* &
                                      deck%bulk%mat1(k)%rho*card%plies(i)%thickness/card%thickness
         end do
      end subroutine take_laminate

   end subroutine resolve_properties

   !> The elements of CARDS, blocks included, and the beams, in ascending order of their numbers; blank mid-side nodes become
   !! blank_node.
   subroutine collect_elements(deck, cards, mesh)
      type(checked_deck), intent(in)  :: deck
      type(element_card), intent(in)  :: cards(:)
      type(mesh_type), intent(inout) :: mesh
      type(id_table_type)  :: properties
      integer, allocatable :: beams(:), bodies(:), nodes(:, :), order(:), property(:)
      integer :: corners, e, i, k

      bodies = pack([(i, i = 1, size(cards))], .not. is_face(mesh, cards))
      associate (edges => deck%bulk%edge)
         beams = pack([(i, i = 1, size(edges))], [(is_beam_edge(deck, edges(i)), i = 1, size(edges))])
         mesh%element_id = [cards(bodies)%id, edges(beams)%id]
         mesh%element_line = [cards(bodies)%line, edges(beams)%line]
         mesh%element_kind = [cards(bodies)%kind, spread(kind_edge2, 1, size(beams))]
      end associate
      mesh%n_elements = size(mesh%element_id)
      allocate (property(mesh%n_elements), source=0)
      allocate (nodes(maxval([4, element_table(mesh%element_kind)%n_nodes]), mesh%n_elements), source=0)
      call properties%build(mesh%properties%id)
      do e = 1, size(bodies)
         associate (card => cards(bodies(e)))
            k = element_table(card%kind)%n_nodes
            corners = element_table(card%kind)%n_corners
            call find_nodes(deck, card%line, card%nodes(:k), mesh, nodes(:k, e))
            where (card%nodes(corners + 1:k) == 0) nodes(corners + 1:k, e) = blank_node
            property(e) = properties%find(card%property)
            call check_property(deck, mesh, card, property(e))
         end associate
      end do
      do i = 1, size(beams)
         e = size(bodies) + i
         associate (edge => deck%bulk%edge(beams(i)))
            call find_nodes(deck, edge%line, edge%nodes(:2), mesh, nodes(:2, e))
            property(e) = findloc(mesh%properties%id == edge%property .and. mesh%properties%state == beam, .true., dim=1)
         end associate
      end do
      call sorted_order(mesh%element_id, order)
      mesh%element_id = mesh%element_id(order)
      mesh%element_line = mesh%element_line(order)
      mesh%element_kind = mesh%element_kind(order)
      mesh%element_nodes = nodes(:, order)
      mesh%element_property = property(order)
   end subroutine collect_elements

   !> The property of the element CARD must be one for its kind; PROPERTY is its position, 0 for a missing property or one for
   !! another kind.
   subroutine check_property(deck, mesh, card, property)
      type(checked_deck), intent(in) :: deck
      type(mesh_type), intent(in) :: mesh
      type(element_card), intent(in) :: card
      integer, intent(inout)         :: property
      integer :: state

      associate (kind => element_table(card%kind))
         state = 0
         if (property > 0) state = mesh%properties(property)%state
         if (state > 0 .and. state /= beam .and. (state == solid .eqv. kind%dimension == 3)) return
         property = 0
         if (kind%dimension == 2 .and. card%property > 0 .and. any(deck%bulk%pmark%id == card%property)) then
            call deck%field_error(card%line, 'PID', integer_text(card%property)//' is a PMARK: a surface of a plane body is '// &
                                  'marked with CBAR or CROD edges')
         else if (card%property > 0) then
            call deck%field_error(card%line, 'PID', 'there is no '//one_of(kind%dimension == 3, 'PSOLID', 'PSHELL or PAXIS')// &
                                  ' '//integer_text(card%property))
         end if
      end associate
   end subroutine check_property

   !> Marked sides: CBAR and CROD edges in the plane, faces of solids from cards of plane elements, and sides of blocks.
   subroutine collect_sides(deck, of_blocks, mesh, sides)
      type(checked_deck), intent(in) :: deck
      type(element_card), intent(in) :: of_blocks(:)
      type(mesh_type), intent(in) :: mesh
      type(marked_side), allocatable, intent(out) :: sides(:)
      integer :: i, n, total

      total = size(deck%bulk%edge) + size(of_blocks)
      if (mesh%dimension == 3) total = total + size(deck%bulk%element)
      allocate (sides(total))
      n = 0
      do i = 1, size(deck%bulk%edge)
         associate (edge => deck%bulk%edge(i))
            if (is_bar(deck, edge) .or. is_beam_edge(deck, edge)) cycle
            if (mesh%dimension == 3 .and. all(mesh%properties%state /= shell)) then
               call deck%errors%add(edge%line, 'a CBAR, or a CROD without a PROD, marks an edge of a plane body; surfaces of '// &
                               'solids are marked with CTRIA3 and CQUAD4 faces; the PID of a beam is that of a PBAR, PBARL, '// &
                               'PBEAM or PBEAML')
               cycle
            end if
            call add_card(edge%element_card, 2, merge(3, 2, edge%nodes(3) /= 0))
         end associate
      end do
      do i = 1, size(deck%bulk%element)
         associate (face => deck%bulk%element(i))
            if (is_face(mesh, face)) call add_card(face, element_table(face%kind)%n_corners, element_table(face%kind)%n_nodes)
         end associate
      end do
      do i = 1, size(of_blocks)
         associate (corners => count(of_blocks(i)%nodes > 0))
            call add_card(of_blocks(i), corners, corners)
         end associate
      end do
      sides = sides(:n)

   contains

      !> Append the side that a CARD marks.
      subroutine add_card(card, corners, n_nodes)
         type(element_card), intent(in) :: card
         integer, intent(in)            :: corners, n_nodes

         n = n + 1
         sides(n)%element_card = card
         sides(n)%corners = corners
         sides(n)%n_nodes = n_nodes
         call find_nodes(deck, card%line, card%nodes(:n_nodes), mesh, sides(n)%nodes(:n_nodes))
      end subroutine add_card

   end subroutine collect_sides

   !> Errors: an element whose det J is not positive: in a plane element at the corners, in a solid at its integration points.
   subroutine check_elements(deck, nodes, mesh)
      type(checked_deck), intent(in) :: deck
      type(grid_card), intent(in)    :: nodes(:)    !! of DECK, then of blocks, in global axes
      type(mesh_type), intent(in) :: mesh
      logical, allocatable :: doubtful(:), sound(:) ! doubtful: the position of a node is not known, which has been reported
      integer :: e, i, last_line, node

      allocate (doubtful(0:mesh%n_nodes), source=.false.)
      do i = 1, size(nodes)
         node = mesh%node_table%find(nodes(i)%id)
         doubtful(node) = doubtful(node) .or. nodes(i)%doubtful
         if (i > size(deck%bulk%grid)) & ! of a block: a number that another node has too
            doubtful(node) = doubtful(node) .or. any(abs(nodes(i)%x - mesh%x(:, node)) > 0.0_wp)
      end do
      allocate (sound(mesh%n_elements))
      !$omp parallel do schedule(dynamic, 512) default(shared) if(mesh%n_elements > few)
      do e = 1, mesh%n_elements
         sound(e) = is_sound(e)
      end do
      !$omp end parallel do
      last_line = 0
      do e = 1, mesh%n_elements
         if (sound(e) .or. mesh%element_line(e) == last_line) cycle ! one error per card
         last_line = mesh%element_line(e)
         call deck%errors%add(mesh%element_line(e), 'element '//integer_text(mesh%element_id(e))//shape_fault(mesh, e))
      end do

   contains

      !> Whether element E has a valid shape, or cannot be checked yet.
      pure logical function is_sound(e)
         integer, intent(in) :: e

         is_sound = .true.
         associate (nodes => element_points(mesh, e))
            if (any(nodes == 0)) return
            if (any(doubtful(nodes))) return
            if (mesh%element_kind(e) == kind_edge2) return ! a beam: its length is checked with its offsets
            if (mesh%dimension == 3 .and. element_table(mesh%element_kind(e))%dimension == 2) then
               is_sound = smallest_jacobian(mesh%element_kind(e), flat_coordinates(mesh%x(:, nodes))) > 0.0_wp
            else
               is_sound = smallest_jacobian(mesh%element_kind(e), mesh%x(:mesh%dimension, nodes)) > 0.0_wp
            end if
         end associate
      end function is_sound

   end subroutine check_elements

   !> The element of one DIMENSION whose corners stand in that many PLACES.
   pure function element_of(places, dimension) result(words)
      integer, intent(in) :: places, dimension
      character(:), allocatable :: words

      words = 'corners in different places'
      if (dimension == 2 .and. places == 3) words = 'CTRIA3'
      if (dimension == 3 .and. places == 4) words = 'CTETRA'
      if (dimension == 3 .and. places == 5) words = 'CPYRAM'
      if (dimension == 3 .and. places >= 6) words = 'CPENTA'
      if (words(:1) == 'C') words = 'an element of fewer corners, such as '//words
   end function element_of

   !> What is wrong with the shape of element E, and what was expected: coincident corners, mid-side nodes where the element with
   !! straight edges is sound, or the order of the nodes.
   function shape_fault(mesh, e) result(words)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)          :: e
      character(:), allocatable :: twins, words
      integer, allocatable :: corners(:), nodes(:)
      real(wp) :: off, largest
      integer  :: i, k, places, worst

      allocate (nodes, source=element_points(mesh, e))
      associate (kind => element_table(mesh%element_kind(e)))
         allocate (corners, source=nodes(:kind%n_corners))
         words = ' has no positive '//one_of(kind%dimension == 3, 'volume', 'area')//' at some integration point'
         if (kind%dimension == 2 .and. kind%linear == mesh%element_kind(e)) words = ' has no positive area at some corner'
         twins = ''
         places = size(corners)
         do k = 2, size(corners)
            do i = 1, k - 1
               if (norm2(mesh%x(:, corners(k)) - mesh%x(:, corners(i))) < same_corner*longest_edge(mesh, e)) exit
            end do
            if (i == k) cycle
            places = places - 1
            twins = twins//', G'//integer_text(i)//' and G'//integer_text(k)
         end do
         if (twins /= '') then
            words = words//': it has corners in one place'//twins//'; expected '//element_of(places, kind%dimension)
            return
         end if
         if (size(nodes) > size(corners)) then
            if (smallest_jacobian(kind%linear, mesh%x(:kind%dimension, corners)) > 0.0_wp) then
               largest = -1.0_wp
               worst = size(corners) + 1
               do k = 1, kind%n_edges
                  associate (p => mesh%x(:, corners(kind%edges(1, k))), q => mesh%x(:, corners(kind%edges(2, k))))
                     off = norm2(mesh%x(:, nodes(size(corners) + k)) - 0.5_wp*(p + q))/norm2(q - p)
                  end associate
                  if (off > largest) worst = size(corners) + k
                  largest = max(largest, off)
               end do
               words = words//', but would have with straight edges: mid-side nodes are at fault, most of all G'// &
                       integer_text(worst)//', node '//integer_text(mesh%node_id(nodes(worst)))//', which stands '// &
                       integer_text(nint(min(100.0_wp*largest, 1.0e9_wp)))//' % of its edge off the middle'
               if (largest < misplaced) words = words//'; expected smaller elements, or straight edges'
               if (largest < misplaced) return
            end if
         end if
         select case (mesh%element_kind(e))
         case (kind_quad4)
            words = words//'; expected four nodes counter-clockwise round a convex quadrilateral'
         case (kind_tria3)
            words = words//'; expected three nodes counter-clockwise'
         case (kind_quad8, kind_tria6)
            words = words//'; expected the corners counter-clockwise, then the nodes near the middle of its edges, the first '// &
                    'between corners 1 and 2'
         case default
            words = words//'; expected the '//one_of(size(nodes) > size(corners), 'nodes', 'corners')// &
                    ' in the order of '//trim(kind%card)//' in the card manual'
         end select
      end associate
   end function shape_fault

   !> Length of the longest edge of element E [length].
   pure real(wp) function longest_edge(mesh, e) result(longest)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)          :: e
      integer :: k

      longest = 0.0_wp
      associate (kind => element_table(mesh%element_kind(e)), nodes => mesh%element_nodes(:, e))
         do k = 1, kind%n_edges
            longest = max(longest, norm2(mesh%x(:, nodes(kind%edges(2, k))) - mesh%x(:, nodes(kind%edges(1, k)))))
         end do
      end associate
   end function longest_edge

end module element_build
