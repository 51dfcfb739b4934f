!> The cards of coordinate systems: CORD1R, CORD1C, CORD1S by three nodes, CORD2R, CORD2C, CORD2S by three points; GRDSET, the
!! defaults of GRID.
!!
!! The cards of the mesh: GRID, body elements, the edges CBAR and CROD, PMARK, and the blocks BLOCK2 and BLOCK3. A routine for each
!! array of the bulk data, a table for each kind.
module mesh_cards
   use bulk_data, only: bulk_data_type, edge_cbar, edge_crod, grid_card, grid_defaults_card, pmark_card, system_card
   use card_lines, only: card_values
   use card_reader, only: card_reader_type
   use element_kinds, only: element_table, kind_hexa20, kind_penta15, kind_quad4, kind_quad8, kind_tria3, kind_tria6, n_kinds
   use field_rules, only: any_field, blank_field, component_field, field_rule, integer_field, real_field
   use kinds, only: wp
   use text_tools, only: integer_text
   implicit none
   private

   public :: read_system, read_grid_defaults, fill_grid_defaults, read_grid, read_element, read_edge, read_pmark, read_block

   character(6), parameter, public :: system_names(6) = ['CORD1R', 'CORD1C', 'CORD1S', 'CORD2R', 'CORD2C', 'CORD2S']

   character(*), parameter, public :: complete_remedy = ' (in Gmsh set Mesh.SecondOrderIncomplete = 1)'

   real(wp), parameter :: most_elements = 2.0e7_wp         ! of a block
   integer, parameter  :: most_first = huge(1) - 200000000 ! N1 and E1: the numbers of a block have room behind them

contains

   !> CORD1: one or two systems, each by its origin, a node on its z and one in its x-z plane. CORD2: the same by coordinates in
   !! system RID.
   subroutine read_system(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      integer :: first, i, kind, n

      do kind = 1, 3
         call cards%set_table([integer_field(['CIDA', 'G1A ', 'G2A ', 'G3A ']), &
                               integer_field(['CIDB', 'G1B ', 'G2B ', 'G3B '], default=0)], system_names(kind))
         call cards%set_table([integer_field('CID'), integer_field('RID', default=0, least=0), &
            real_field(['A1', 'A2', 'A3', 'B1', 'B2', 'B3', 'C1', 'C2', 'C3'], default=0.0_wp)], system_names(kind + 3))
      end do
      allocate (bulk%system(2*cards%n))
      n = 0
      do i = 1, cards%n
         call cards%next(values)
         kind = findloc(system_names, cards%card%name(:6), dim=1)
         if (kind > 3) then
            n = n + 1
            bulk%system(n) = system_card(line=cards%line, id=values%integers(1), kind=kind - 3, reference=values%integers(2), &
                                         points=reshape(values%reals(3:11), [3, 3]))
         else
            if (any(values%given(5:8)) .and. .not. all(values%given(5:8))) &
               call cards%error('CIDB', 'a second system needs CIDB, G1B, G2B and G3B, all four')
            do first = 1, merge(5, 1, all(values%given(5:8))), 4
               n = n + 1
               bulk%system(n) = system_card(line=cards%line, id=values%integers(first), kind=kind, &
                                            field=first, nodes=values%integers(first + 1:first + 3))
            end do
         end if
      end do
      bulk%system = bulk%system(:n)
   end subroutine read_system

   !> GRDSET: what GRID has where its CP, CD and PS are blank; there is one at most.
   subroutine read_grid_defaults(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      integer :: i

      call cards%set_table([any_field('-'), integer_field('CP', default=0, least=0), blank_field(['-', '-', '-']), &
         integer_field('CD', default=0, least=0), component_field('PS', default=0), blank_field('SEID')])
      do i = 1, cards%n
         call cards%next(values)
         if (i > 1) call cards%errors%add(cards%line, 'GRDSET: a second one; expected one at most in a deck')
         bulk%grid_defaults = grid_defaults_card(line=cards%line, cp=values%integers(2), cd=values%integers(6), &
                                                 ps=values%integers(7))
      end do
   end subroutine read_grid_defaults

   !> Fill the blank fields CP, CD and PS of all GRID cards from GRDSET.
   pure subroutine fill_grid_defaults(bulk)
      type(bulk_data_type), intent(inout) :: bulk

      associate (defaults => bulk%grid_defaults, grid => bulk%grid)
         where (grid%cp < 0) grid%cp = defaults%cp
         where (grid%cd < 0) grid%cd = defaults%cd
         where (grid%ps == 0) grid%ps = defaults%ps
      end associate
   end subroutine fill_grid_defaults

   !> GRID: a node. Gmsh writes whole coordinates without a decimal point in large field, so integers are taken here.
   subroutine read_grid(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      integer :: i

      call cards%set_table([integer_field('ID'), integer_field('CP', default=-1, least=0), &
         real_field(['X1', 'X2', 'X3'], default=0.0_wp, whole=.true.), integer_field('CD', default=-1, least=0), &
         component_field('PS', default=0), blank_field('SEID')])
      allocate (bulk%grid(cards%n))
      do i = 1, cards%n
         call cards%next(values)
         bulk%grid(i) = grid_card(line=cards%line, id=values%integers(1), ps=values%integers(7), cp=values%integers(2), &
                                  cd=values%integers(6), x=values%reals(3:5), doubtful=.not. values%ok)
      end do
   end subroutine read_grid

   !> CTRIA3, CTRIA6, CQUAD4, CQUAD8, CTETRA, CPENTA and CHEXA, the body elements; in a model of solids, faces of marked surfaces
   !! are those of the plane too. Any mid-side node makes the element one of second order. THETA turns the axes of a material, which
   !! is isotropic here: read without effect. ZOFFS and corner thicknesses of plates must be blank.
   subroutine read_element(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      integer :: i, kind, linear

      do kind = 1, n_kinds
         call cards%set_table(element_rules(kind), element_table(kind)%card, open_ended=complete_nodes(kind) > 0)
      end do
      allocate (bulk%element(cards%n))
      kind = 1
      do i = 1, cards%n
         call cards%next(values)
         if (element_table(kind)%card /= cards%card%name) &
            kind = findloc(element_table%card, cards%card%name, dim=1, back=.true.) ! of second order, where there is one
         call check_end(cards, kind, values)
         linear = element_table(kind)%linear
         associate (element => bulk%element(i), n => element_table(kind)%n_nodes, corners => element_table(kind)%n_corners)
            element%line = cards%line
            element%id = values%integers(1)
            element%property = values%integers(2)
            element%nodes(:n) = values%integers(3:2 + n)
            element%kind = merge(kind, linear, any(element%nodes(corners + 1:n) > 0))
         end associate
      end do
   end subroutine read_element

   !> The table of the card of elements of a KIND; where a kind has the card of a linear one, that of both.
   pure function element_rules(kind) result(rules)
      integer, intent(in) :: kind
      type(field_rule), allocatable :: rules(:)
      integer :: k

      associate (this => element_table(kind))
         rules = [integer_field(['EID', 'PID']), (integer_field('G'//integer_text(k)), k = 1, this%n_corners), &
                  (integer_field('G'//integer_text(k), default=0), k = this%n_corners + 1, this%n_nodes)]
      end associate
      select case (kind)
      case (kind_tria3, kind_quad4)
         rules = [rules, any_field('THETA'), blank_field('ZOFFS')]
      case (kind_tria6)
         rules = [rules, any_field('THETA'), blank_field(['ZOFFS', 'T1   ', 'T2   ', 'T3   '])]
      case (kind_quad8)
         rules = [rules, blank_field(['T1', 'T2', 'T3', 'T4']), any_field('THETA'), blank_field('ZOFFS')]
      end select
   end function element_rules

   !> Nodes of the complete element of second order, with nodes inside its faces and itself, that Gmsh writes on the card of KIND; 0:
   !! none.
   pure integer function complete_nodes(kind) result(n)
      integer, intent(in) :: kind

      n = 0
      if (kind == kind_hexa20) n = 27
      if (kind == kind_penta15) n = 18
   end function complete_nodes

   !> Nothing may stand behind the last node of a solid with mid-side nodes; a complete element is told from a slip of the pen, and
   !! its mid-side nodes, which have another order, are dropped.
   subroutine check_end(cards, kind, values)
      type(card_reader_type), intent(inout) :: cards
      integer, intent(in)                   :: kind
      type(card_values), intent(inout)      :: values
      integer :: first

      first = 3 + element_table(kind)%n_nodes
      if (complete_nodes(kind) == 0 .or. cards%card%n < first) return
      if (cards%card%n == 2 + complete_nodes(kind)) then
         call cards%card%field_error(first, 'a complete element of '//integer_text(complete_nodes(kind))//' nodes; expected '// &
            'at most '//integer_text(element_table(kind)%n_nodes)//', no nodes inside faces'//complete_remedy, cards%errors)
         values%integers(3 + element_table(kind)%n_corners:first - 1) = 0
      else
         first = first - 1 + findloc(cards%card%fields(first:cards%card%n)%length > 0, .true., dim=1)
         call cards%card%field_error(first, ''''//trim(cards%card%fields(first)%text)//''' behind the last node, G'// &
                                     integer_text(element_table(kind)%n_nodes)//', expected nothing', cards%errors)
      end if
   end subroutine check_end

   !> CBAR: an edge of a marked surface; the orientation vector of a real bar (Gmsh writes one) has no meaning here, and of an edge
   !! of second order Gmsh writes the mid-side node in its place. CROD: such an edge, or with a PROD a bar, such as a bolt.
   subroutine read_edge(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      integer :: i

      call cards%set_table([integer_field(['EID', 'PID', 'GA ', 'GB ']), real_field('X1', default=0.0_wp, whole=.true.), &
                            real_field(['X2', 'X3'], default=0.0_wp)], 'CBAR')
      call cards%set_table(integer_field(['EID', 'PID', 'G1 ', 'G2 ']), 'CROD')
      allocate (bulk%edge(cards%n))
      do i = 1, cards%n
         call cards%next(values)
         associate (edge => bulk%edge(i), integers => values%integers)
            edge%line = cards%line
            edge%kind = merge(edge_crod, edge_cbar, cards%card%name == 'CROD')
            edge%id = integers(1)
            edge%property = integers(2)
            edge%nodes(:2) = integers(3:4)
            if (edge%kind == edge_cbar) edge%nodes(3) = integers(5)
         end associate
      end do
   end subroutine read_edge

   !> PMARK: a marked surface.
   subroutine read_pmark(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      integer :: i

      call cards%set_table([integer_field('PID')])
      allocate (bulk%pmark(cards%n))
      do i = 1, cards%n
         call cards%next(values)
         bulk%pmark(i) = pmark_card(line=cards%line, id=values%integers(1))
      end do
   end subroutine read_pmark

   !> BLOCK2: a quadrilateral block of NX by NY elements between four corners; corners 2 and 4 left blank make it a
   !! rectangle with corners 1 and 3 on its diagonal.
   !! BLOCK3: a box of NX by NY by NZ elements between two opposite corners; nodes go up z first, then y, then x.
   subroutine read_block(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      integer, parameter :: others(4) = [7, 8, 11, 12] ! data fields of corners 2 and 4
      integer :: i

      call cards%set_table([integer_field(['BID', 'PID']), integer_field(['NX', 'NY'], most=100000), &
         real_field(['X1', 'Y1', 'X2', 'Y2'], default=0.0_wp), real_field(['X3', 'Y3']), &
         real_field(['X4', 'Y4'], default=0.0_wp), real_field(['RX', 'RY'], default=1.0_wp, above=0.0_wp), &
         integer_field(['N1', 'E1'], default=1), integer_field(['S1  ', 'S2  ', 'S3  ', 'S4  ', 'WELD'], default=0), &
         integer_field('ORDER', default=1, most=2)], 'BLOCK2')
      call cards%set_table([integer_field(['BID', 'PID']), integer_field(['NX', 'NY', 'NZ'], most=10000), &
         real_field(['X1', 'Y1', 'Z1'], default=0.0_wp), real_field(['X2', 'Y2', 'Z2']), &
         real_field(['RX', 'RY', 'RZ'], default=1.0_wp, above=0.0_wp), integer_field(['N1', 'E1'], default=1), &
         integer_field(['S1  ', 'S2  ', 'S3  ', 'S4  ', 'S5  ', 'S6  ', 'WELD'], default=0), &
         integer_field('ORDER', default=1, most=2)], 'BLOCK3')
      allocate (bulk%block(cards%n))
      do i = 1, cards%n
         call cards%next(values)
         associate (block => bulk%block(i), x => values%reals, integers => values%integers, &
                    given => values%given)
            if (cards%card%name == 'BLOCK2') then
               if (any(given(others)) .and. .not. all(given(others))) call cards%error('X2', &
                  'corners 2 and 4 must both be given (X2, Y2, X4, Y4), or all four left blank for a rectangle')
               call check_block(cards, 4, integers)
               integers(15:16) = min(integers(15:16), most_first) ! no number of the block passes what an integer holds
               block%divisions(:2) = max(1, integers(3:4))
               block%corner(:2, :) = reshape(x(5:12), [2, 4])
               if (.not. any(given(others))) block%corner(:2, 2::2) = reshape(x([9, 6, 5, 10]), [2, 2])
               block%grading(:2) = x(13:14)
               block%marks(:4) = integers(17:20)
               block%weld = integers(21)
               block%order = integers(22)
            else
               call check_block(cards, 5, integers)
               where (integers(15:16) > most_first) integers(15:16) = 1 ! a deck of solids is mostly one block, from 1 on
               if (values%ok .and. any(x(9:11) <= x(6:8))) &
                  call cards%error('X2', 'the second corner must lie beyond the first in x, y and z')
               block%dimension = 3
               block%divisions = max(1, integers(3:5))
               block%corner(:, :2) = reshape(x(6:11), [3, 2])
               block%grading = x(12:14)
               block%marks = integers(17:22)
               block%weld = integers(23)
               block%order = integers(24)
            end if
            block%line = cards%line
            block%id = integers(1)
            block%property = integers(2)
            block%first_node = integers(15)
            block%first_element = integers(16)
            block%doubtful = cards%is_faulty()
         end associate
      end do
   end subroutine read_block

   !> Size and numbers of a block, whose divisions are data fields 3 to LAST and whose N1 and E1 are 15 and 16. Of too many
   !! elements one is left, so that the rest of the deck can be checked.
   subroutine check_block(cards, last, integers)
      type(card_reader_type), intent(inout) :: cards
      integer, intent(in)                   :: last
      integer, intent(inout)                :: integers(:) !! the data fields

      if (product(real(integers(3:last), wp)) > most_elements) then
         call cards%error('NX', 'more than 2E7 elements in one block')
         integers(3:last) = 1
      end if
      if (integers(15) > most_first) call cards%error('N1', 'the last node number would pass 2147483647')
      if (integers(16) > most_first) call cards%error('E1', 'the last element number would pass 2147483647')
   end subroutine check_block

end module mesh_cards
