!> Nodes, bodies and marked sides: from the mesh cards and the block generators to positions in the model.
module mesh_build
   use bar_build, only: is_bar
   use block_mesh, only: block_type, generate_block
   use deck_check, only: checked_deck
   use element_build, only: check_element_numbers, check_elements, check_one_state, collect_elements, is_face, resolve_properties
   use element_kinds, only: element_table, max_side_nodes
   use kinds, only: wp
   use model_data, only: model_type
   use node_build, only: collect_nodes, find_nodes, order_nodes, raw_nodes
   use reverse_lists, only: list_owners
   implicit none
   private

   public :: build_mesh

   !> Sides that carry a mark, before they are sorted into surfaces.
   type, public :: marked_sides
      integer :: n = 0
      integer, allocatable :: mark(:)      !! PMARK id
      integer, allocatable :: corners(:)   !! 2, 3 or 4
      integer, allocatable :: nodes(:, :)  !! (4, n)
      integer, allocatable :: line(:)      !! of its card
      integer, allocatable :: of_block(:)  !! k: the mark stands in Sk of a block; 0: in PID of an edge or face
   end type marked_sides

contains

   !> Fill the mesh part of MODEL; SIDES are the marked sides found on the way.
   subroutine build_mesh(deck, model, sides)
      type(checked_deck), intent(in)  :: deck
      type(model_type), intent(inout) :: model
      type(marked_sides), intent(out) :: sides
      type(block_type), allocatable :: blocks(:)
      type(raw_nodes) :: raw
      integer, allocatable :: position(:) ! raw node -> node of the model
      integer :: b

      model%dimension = 2
      if (any(deck%bulk%block%dimension == 3) .or. any(element_table(deck%bulk%element%kind)%dimension == 3)) model%dimension = 3
      allocate (blocks(size(deck%bulk%block)))
      do b = 1, size(blocks)
         call generate_block(deck%bulk%block(b), blocks(b))
      end do
      call collect_nodes(deck, blocks, raw)
      call order_nodes(raw, model, position)
      call resolve_properties(deck, model)
      call collect_elements(deck, blocks, raw, position, model)
      call check_element_numbers(deck, blocks)
      call list_owners(model%n_nodes, model%element_nodes, model%first_at, model%elements_at)
      call check_one_state(deck, model)
      call check_nodes(deck, model)
      call check_elements(deck, model)
      call collect_sides(deck, blocks, raw, position, model, sides)
   end subroutine build_mesh

   !> A plane model lies in x-y, an axisymmetric one besides in x >= 0.
   subroutine check_nodes(deck, model)
      type(checked_deck), intent(in) :: deck
      type(model_type), intent(in)   :: model
      integer :: b, i

      if (model%dimension == 3) return
      do i = 1, size(deck%bulk%grid)
         associate (grid => deck%bulk%grid(i))
            if (abs(grid%x(3)) > 0.0_wp) call deck%field_error(grid%line, 'X3', 'not zero, but a plane model lies in x-y')
            if (model%axisymmetric .and. grid%x(1) < 0.0_wp) &
               call deck%field_error(grid%line, 'X1', 'negative, but an axisymmetric model lies in x >= 0')
         end associate
      end do
      if (.not. model%axisymmetric) return
      do b = 1, size(deck%bulk%block)
         if (any(deck%bulk%block(b)%corner(1, :) < 0.0_wp)) call deck%errors%add(deck%bulk%block(b)%line, &
            'BLOCK2: a corner has x < 0, but an axisymmetric model lies in x >= 0')
      end do
   end subroutine check_nodes

   !> CBAR and CROD edges in the plane, CTRIA3 and CQUAD4 faces of solids, and the marked sides of blocks.
   subroutine collect_sides(deck, blocks, raw, position, model, sides)
      type(checked_deck), intent(in)  :: deck
      type(block_type), intent(in)    :: blocks(:)
      type(raw_nodes), intent(in)     :: raw
      integer, intent(in)             :: position(:)
      type(model_type), intent(in)    :: model
      type(marked_sides), intent(out) :: sides
      integer :: b, i, n, total

      total = size(deck%bulk%edge) + sum(blocks%n_sides)
      if (model%dimension == 3) total = total + size(deck%bulk%element)
      allocate (sides%mark(total), sides%corners(total), sides%line(total), sides%of_block(total))
      allocate (sides%nodes(max_side_nodes, total), source=0)
      n = 0
      do i = 1, size(deck%bulk%edge)
         associate (edge => deck%bulk%edge(i))
            if (is_bar(deck, edge)) cycle
            if (model%dimension == 3) then
               call deck%errors%add(edge%line, 'a CBAR, or a CROD without a PROD, marks an edge of a plane body; surfaces of '// &
                               'solids are marked with CTRIA3 and CQUAD4 faces')
               cycle
            end if
            call start_side(edge%property, 2, edge%line, 0)
            call find_nodes(deck, edge%line, edge%nodes(:2), model, sides%nodes(:2, n))
         end associate
      end do
      do i = 1, size(deck%bulk%element)
         associate (face => deck%bulk%element(i))
            if (.not. is_face(model, face)) cycle
            call start_side(face%property, element_table(face%kind)%n_nodes, face%line, 0)
            call find_nodes(deck, face%line, face%nodes(:sides%corners(n)), model, sides%nodes(:sides%corners(n), n))
         end associate
      end do
      do b = 1, size(blocks)
         do i = 1, blocks(b)%n_sides
            associate (corners => blocks(b)%side(:count(blocks(b)%side(:, i) > 0), i))
               call start_side(blocks(b)%mark(i), size(corners), blocks(b)%line, blocks(b)%number(i))
               sides%nodes(:size(corners), n) = position(raw%place(raw%block_start(b) + corners))
            end associate
         end do
      end do
      sides%n = n

   contains

      subroutine start_side(mark, corners, line, of_block)
         integer, intent(in) :: mark, corners, line, of_block

         n = n + 1
         sides%mark(n) = mark
         sides%corners(n) = corners
         sides%line(n) = line
         sides%of_block(n) = of_block
      end subroutine start_side

   end subroutine collect_sides

end module mesh_build
