!> Reads the cards of the mesh: nodes, coordinate systems, elements, edges, marked surfaces and blocks.
!! Nodes: GRID and its defaults GRDSET. Coordinate systems: by three nodes (CORD1R, CORD1C, CORD1S) or by three points (CORD2R,
!! CORD2C, CORD2S). Edges: CBAR, CBEAM and their defaults BAROR
!! and BEAMOR, and CROD. Marked surfaces: PMARK. Blocks: BLOCK2 and BLOCK3.
module mesh_cards
   use bulk_data, only: bulk_data_type, edge_cbar, edge_cbeam, edge_crod, plate_card, system_card
   use card_fields, only: card_fields_type
   use element_kinds, only: element_table, kind_hexa20, kind_penta15, kind_pyram5, kind_quad4, kind_quad8, kind_tria3, &
                            kind_tria6, max_nodes
   use field_rules, only: parse_integer, positive
   use kinds, only: wp
   use text_tools, only: integer_text
   implicit none
   private

   public :: read_system, read_grid_defaults, read_grid, read_element, read_edge, read_edge_defaults, read_pmark, &
             read_block, fill_defaults

   character(6), parameter, public :: system_names(6) = ['CORD1R', 'CORD1C', 'CORD1S', 'CORD2R', 'CORD2C', 'CORD2S']
   character(3), parameter :: node_names(max_nodes) = ['G1 ', 'G2 ', 'G3 ', 'G4 ', 'G5 ', 'G6 ', 'G7 ', 'G8 ', 'G9 ', 'G10', &
      'G11', 'G12', 'G13', 'G14', 'G15', 'G16', 'G17', 'G18', 'G19', 'G20']
   character(2), parameter :: thickness_names(4) = ['T1', 'T2', 'T3', 'T4']
   character(2), parameter :: side_names(6) = ['S1', 'S2', 'S3', 'S4', 'S5', 'S6'] ! of a block
   character(*), parameter, public :: complete_remedy = ' (in Gmsh set Mesh.SecondOrderIncomplete = 1)'

   real(wp), parameter :: most_elements = 2.0e7_wp         ! of a block
   integer, parameter  :: most_first = huge(1) - 200000000 ! N1 and E1: leaves room for the numbers of a block

contains

   !> CORD1: one or two systems, each given by its origin, a node on its z axis and one in its x-z plane. CORD2: the same by coordinates
   !! in system RID.
   subroutine read_system(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      type(system_card) :: second

      associate (system => bulk%system(card%i))
         system%kind = modulo(findloc(system_names, card%name(:6), dim=1) - 1, 3) + 1
         if (card%name(5:5) == '2') then
            call card%field('CID', system%id)
            call card%field('RID', system%reference, default=0, least=0)
            call card%field(['A1', 'A2', 'A3'], system%points(:, 1), default=0.0_wp)
            call card%field(['B1', 'B2', 'B3'], system%points(:, 2), default=0.0_wp)
            call card%field(['C1', 'C2', 'C3'], system%points(:, 3), default=0.0_wp)
            call card%finish(system%line)
         else
            call card%field('CIDA', system%id)
            call card%field(['G1A', 'G2A', 'G3A'], system%nodes)
            call card%field('CIDB', second%id, default=0)
            call card%field(['G1B', 'G2B', 'G3B'], second%nodes, default=0)
            call card%finish(system%line)
            associate (has_field => [second%id, second%nodes] > 0)
               if (all(has_field)) then
                  card%i = card%i + 1
                  bulk%system(card%i) = system_card(line=card%line, id=second%id, kind=system%kind, field=5, nodes=second%nodes)
               else if (any(has_field)) then
                  call card%error('CIDB', 'a second system needs CIDB, G1B, G2B and G3B, all four')
               end if
            end associate
         end if
      end associate
   end subroutine read_system

   !> GRDSET: defaults for blank CP, CD and PS of GRID; one card at most.
   subroutine read_grid_defaults(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      integer :: seid ! nothing is reduced

      associate (defaults => bulk%grid_defaults)
         call card%skip(['-'])
         call card%field('CP', defaults%cp, default=0, least=0)
         call card%blank(['-', '-', '-'])
         call card%field('CD', defaults%cd, default=0, least=0)
         call card%components('PS', defaults%ps, default=0)
         call card%field('SEID', seid, default=0, least=0)
         call card%finish(defaults%line)
      end associate
      if (card%i > 1) call card%errors%add(card%line, 'GRDSET: given twice; expected at most one in a deck')
   end subroutine read_grid_defaults

   !> GRID: a node. In large field Gmsh writes whole coordinates without a decimal point, so that integers are accepted here.
   subroutine read_grid(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      integer :: seid ! nothing is reduced

      associate (grid => bulk%grid(card%i))
         call card%field('ID', grid%id)
         call card%field('CP', grid%cp, default=-1, least=0)
         call card%field(['X1', 'X2', 'X3'], grid%x, default=0.0_wp, whole=.true.)
         call card%field('CD', grid%cd, default=-1, least=-1)
         if (card%text_at(6) == '-1') call card%error('CD', '-1, a node of a fluid; there are no fluids')
         call card%components('PS', grid%ps, default=0)
         call card%field('SEID', seid, default=0, least=0)
         call card%finish(grid%line)
         grid%doubtful = card%is_faulty()
      end associate
   end subroutine read_grid

   !> CTRIA3, CTRIA6, CQUAD4, CQUAD8, CTETRA, CPENTA and CHEXA: elements of bodies; CTRIAR is a CTRIA3, CQUADR a CQUAD4. In a model of
   !! solids plane elements are faces of marked surfaces. Any mid-side node makes an element second order. THETA turns material axes
   !! and has no effect on an isotropic material. ZOFFS and corner thicknesses belong to shells.
   subroutine read_element(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      integer :: complete, k, kind

      ! of second order where there is one
      kind = maxval([(merge(k, 0, element_table(k)%card == card%name), k = 1, size(element_table))])
      if (card%name == 'CTRIAR') kind = kind_tria3
      if (card%name == 'CQUADR') kind = kind_quad4
      associate (element => bulk%element(card%i), n => element_table(kind)%n_nodes, corners => element_table(kind)%n_corners)
         call card%field('EID', element%id)
         call card%field('PID', element%property)
         call card%field(node_names(:corners), element%nodes(:corners))
         call card%field(node_names(corners + 1:n), element%nodes(corners + 1:n), default=0)
         if (any(kind == [kind_tria3, kind_quad4, kind_tria6, kind_quad8])) call read_plate(card, kind, bulk)
         element%line = card%line
         complete = 0 ! nodes of complete second order, on faces and in the centre too, as Gmsh writes it
         if (kind == kind_hexa20) complete = 27
         if (kind == kind_penta15) complete = 18
         if (kind == kind_pyram5 .and. card%n > 2 + n) then
            call card%error_at(3 + n, 'G6: a pyramid of second order, of up to 13 nodes; expected 5: mesh bodies that have '// &
                               'pyramids with first-order elements')
         else if (complete == 0) then
            call card%finish(element%line)
         else if (card%n == 2 + complete) then
            call card%error_at(3 + n, 'a complete element of '//integer_text(complete)//' nodes; expected at most '// &
                               integer_text(n)//', no nodes inside faces'//complete_remedy)
            element%nodes(corners + 1:) = 0 ! the mid-side nodes have another order
         else if (card%n > 2 + n) then
            call card%must_be_blank(3 + n, card%n, ': G'//integer_text(n)//' is the last node')
         end if
         element%kind = merge(kind, element_table(kind)%linear, any(element%nodes(corners + 1:n) > 0))
      end associate
   end subroutine read_element

   !> The fields of a plane element behind its nodes: THETA or MCID, ZOFFS, and thicknesses at corners.
   subroutine read_plate(card, kind, bulk)
      type(card_fields_type), intent(inout) :: card
      integer, intent(in)                   :: kind
      type(bulk_data_type), intent(inout)   :: bulk
      type(plate_card) :: plate
      character(8) :: flag
      integer :: system
      logical :: is_system

      flag = ''
      associate (corners => element_table(kind)%n_corners)
         if (kind == kind_quad8) call card%field(thickness_names, plate%thickness, positive, default=0.0_wp)
         call card%field('THETA', plate%angle, default=0.0_wp, whole=.true.)
         call card%field('ZOFFS', plate%offset, default=0.0_wp)
         if (kind == kind_tria3) call card%skip(['-'])
         if (any(kind == [kind_tria3, kind_quad4])) then
            call card%skip(['-'])
            call card%word('TFLAG', '||0|1|', flag)
         end if
         if (kind /= kind_quad8) call card%field(thickness_names(:corners), plate%thickness(:corners), positive, default=0.0_wp)
      end associate
      plate%element = card%i
      plate%is_relative = flag == '1'
      call parse_integer(card%text_at(merge(15, 3 + element_table(kind)%n_nodes, kind == kind_quad8)), system, is_system)
      if (is_system) plate%system = system
      if (.not. is_system .and. all(abs([plate%angle, plate%offset, plate%thickness]) <= 0.0_wp)) return
      !$omp critical (plates) ! in any order: they are found by the numbers of their elements
      if (bulk%n_plates == size(bulk%plate)) bulk%plate = [bulk%plate, spread(plate, 1, max(64, bulk%n_plates))]
      bulk%n_plates = bulk%n_plates + 1
      bulk%plate(bulk%n_plates) = plate
      !$omp end critical (plates)
   end subroutine read_plate

   !> CBAR, CBEAM: a beam, or with the PID of a PMARK an edge of a marked surface. The orientation vector of such an edge (Gmsh writes
   !! one) has no meaning; in a second-order edge Gmsh writes the mid-side node in its place. CROD: such an edge, or with a PROD a bar
   !! such as a bolt.
   subroutine read_edge(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      logical :: ok, only_global

      associate (edge => bulk%edge(card%i))
         edge%kind = edge_crod
         if (card%name == 'CBAR') edge%kind = edge_cbar
         if (card%name == 'CBEAM') edge%kind = edge_cbeam
         call card%field('EID', edge%id)
         if (edge%kind == edge_crod) then
            call card%field('PID', edge%property)
         else ! blank: that of BAROR or BEAMOR, or EID
            call card%field('PID', edge%property, default=0)
         end if
         call card%field(merge(['G1', 'G2'], ['GA', 'GB'], edge%kind == edge_crod), edge%nodes(:2))
         if (edge%kind /= edge_crod) then
            call card%field('X1', edge%orientation(1), default=0.0_wp, whole=.true.)
            call card%field(['X2', 'X3'], edge%orientation(2:), default=0.0_wp, whole=.true.)
            call parse_integer(card%text_at(5), edge%nodes(3), ok)
            if (ok .and. any(card%given(['X2', 'X3']))) edge%nodes(3) = 0
            if (edge%nodes(3) > 0) edge%orientation = 0.0_wp
            if (edge%nodes(3) == 0) edge%blank(:3) = .not. card%given(['X1', 'X2', 'X3'])
            edge%blank(4) = edge%property == 0
            call read_offset_kind(card, edge%in_basic, only_global)
            edge%blank(5) = .not. card%given('OFFT')
            call card%components('PA', edge%pins(1), default=0)
            call card%components('PB', edge%pins(2), default=0)
            call card%field(['W1A', 'W2A', 'W3A'], edge%offset(:, 1), default=0.0_wp)
            call card%field(['W1B', 'W2B', 'W3B'], edge%offset(:, 2), default=0.0_wp)
            if (.not. only_global .and. any(abs(edge%offset) > 0.0_wp)) call card%error('OFFT', &
               'offsets in element axes; expected GGG or BGG, offsets in the axes of the nodes')
         end if
         call card%finish(edge%line)
      end associate
   end subroutine read_edge

   !> OFFT: three letters for the orientation vector (G: in the axes of the node, B: basic axes) and the offsets of both ends (G, or O: in
   !! element axes, without effect where there are none). Older decks write the kind of orientation: 1 a vector, 2 a node.
   subroutine read_offset_kind(card, in_basic, only_global)
      type(card_fields_type), intent(inout) :: card
      logical, intent(out)                  :: in_basic, only_global
      character(8) :: word

      call card%word('OFFT', '|GGG|BGG|GGO|GOG|GOO|BGO|BOG|BOO|0|1|2|', word)
      in_basic = word(1:1) == 'B'
      only_global = index(word(2:), 'O') == 0
   end subroutine read_offset_kind

   !> BAROR, BEAMOR: defaults for blank PID and X1, X2, X3 (or G0) of CBAR, CBEAM; one card of each at most.
   subroutine read_edge_defaults(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      logical :: ok, only_global

      associate (defaults => bulk%edge_defaults(merge(1, 2, card%name == 'BAROR')))
         if (defaults%line > 0) call card%errors%add(card%line, trim(card%name)//': given twice; expected at most one in a deck')
         call card%skip(['-'])
         call card%field('PID', defaults%property, default=0)
         call card%blank(['-', '-'])
         call card%field('X1', defaults%orientation(1), default=0.0_wp, whole=.true.)
         call card%field(['X2', 'X3'], defaults%orientation(2:), default=0.0_wp, whole=.true.)
         call parse_integer(card%text_at(5), defaults%nodes(3), ok)
         if (ok .and. any(card%given(['X2', 'X3']))) defaults%nodes(3) = 0
         call read_offset_kind(card, defaults%in_basic, only_global)
         call card%finish(defaults%line)
      end associate
   end subroutine read_edge_defaults

   !> Fill the blank fields of GRID from GRDSET, and those of CBAR and CBEAM from BAROR and BEAMOR. Without a default the PID of a beam
   !! is its EID.
   pure subroutine fill_defaults(bulk)
      type(bulk_data_type), intent(inout) :: bulk
      integer :: i

      associate (grid => bulk%grid, defaults => bulk%grid_defaults)
         where (grid%cp < 0) grid%cp = defaults%cp
         where (grid%cd < 0) grid%cd = defaults%cd
         where (grid%ps == 0) grid%ps = defaults%ps
      end associate
      do i = 1, size(bulk%edge)
         associate (edge => bulk%edge(i), defaults => bulk%edge_defaults(merge(2, 1, bulk%edge(i)%kind == edge_cbeam)))
            if (edge%blank(4)) edge%property = merge(defaults%property, edge%id, defaults%property > 0)
            if (edge%blank(5)) edge%in_basic = defaults%in_basic
            if (defaults%nodes(3) == 0) where (edge%blank(:3)) edge%orientation = defaults%orientation
            if (all(edge%blank(:3))) edge%nodes(3) = defaults%nodes(3)
         end associate
      end do
   end subroutine fill_defaults

   !> PMARK: a marked surface.
   subroutine read_pmark(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk

      call card%field('PID', bulk%pmark(card%i)%id)
      call card%finish(bulk%pmark(card%i)%line)
   end subroutine read_pmark

   !> BLOCK2: a quadrilateral block of NX by NY elements between four corners; blank corners 2 and 4 make it a rectangle with corners 1
   !! and 3 on its diagonal.
   !! BLOCK3: a box of NX by NY by NZ elements between two opposite corners; nodes are numbered along z first, then y, then x.
   subroutine read_block(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      character(2), parameter :: others(4) = ['X2', 'Y2', 'X4', 'Y4'] ! corners 2 and 4
      integer :: instead, n_sides
      logical :: ok

      associate (block => bulk%block(card%i), corner => bulk%block(card%i)%corner)
         block%dimension = merge(2, 3, card%name == 'BLOCK2')
         n_sides = 2*block%dimension
         call card%field('BID', block%id)
         call card%field('PID', block%property)
         if (block%dimension == 2) then
            call card%field(['NX', 'NY'], block%divisions(:2), most=100000)
            call card%field(['X1', 'Y1'], corner(:2, 1), default=0.0_wp)
            call card%field(['X2', 'Y2'], corner(:2, 2), default=0.0_wp)
            call card%field(['X3', 'Y3'], corner(:2, 3))
            call card%field(['X4', 'Y4'], corner(:2, 4), default=0.0_wp)
            call card%field(['RX', 'RY'], block%grading(:2), positive, default=1.0_wp)
         else
            call card%field(['NX', 'NY', 'NZ'], block%divisions, most=10000)
            call card%field(['X1', 'Y1', 'Z1'], corner(:, 1), default=0.0_wp)
            call card%field(['X2', 'Y2', 'Z2'], corner(:, 2))
            call card%field(['RX', 'RY', 'RZ'], block%grading, positive, default=1.0_wp)
         end if
         call card%field('N1', block%first_node, default=1)
         call card%field('E1', block%first_element, default=1)
         call card%field(side_names(:n_sides), block%marks(:n_sides), default=0)
         call card%field('WELD', block%weld, default=0)
         call card%field('ORDER', block%order, default=1, most=2)
         call card%finish(block%line)
         ok = .not. card%is_faulty()
         if (block%dimension == 2) then
            if (.not. any(card%given(others))) then
               corner(:2, 2) = [corner(1, 3), corner(2, 1)]
               corner(:2, 4) = [corner(1, 1), corner(2, 3)]
            else if (.not. all(card%given(others))) then
               call card%error('X2', 'corners 2 and 4 must both be given (X2, Y2, X4, Y4), or all four left blank for a rectangle')
            end if
         end if
         associate (divisions => block%divisions(:block%dimension)) ! one element instead: the rest of the deck can be checked
            if (product(real(divisions, wp)) > most_elements) then
               call card%error('NX', 'more than 2E7 elements in one block')
               divisions = 1
            end if
            divisions = max(1, divisions)
         end associate
         if (block%first_node > most_first) call card%error('N1', 'the last node number would exceed 2147483647')
         if (block%first_element > most_first) call card%error('E1', 'the last element number would exceed 2147483647')
         instead = merge(most_first, 1, block%dimension == 2) ! a deck of solids is mostly one block, numbered from 1
         if (block%first_node > most_first) block%first_node = instead ! no number overflows an integer
         if (block%first_element > most_first) block%first_element = instead
         if (block%dimension == 3 .and. ok .and. any(corner(:, 2) <= corner(:, 1))) &
            call card%error('X2', 'the second corner must lie beyond the first in x, y and z')
         block%doubtful = card%is_faulty()
      end associate
   end subroutine read_block

end module mesh_cards
