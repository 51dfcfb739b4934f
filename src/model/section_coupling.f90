!> Sections of solid bolts as elements see them. An element behind a section has its corners there where they would be with the
!! overlap g of the section on top, {u_e} = [T] {u, g}: one more unknown, kept as component 1 of the section's own node.
module section_coupling
   use element_kinds, only: element_table
   use kinds, only: wp
   use model_data, only: corners_of, model_type, n_sections
   use node_coupling, only: unknown_nodes
   implicit none
   private

   public :: section_node, felt_nodes, coupled_nodes, corner_displacements, extend_stiffness, add_section_share

contains

   !> The node of the section that element E touches from behind; 0: none.
   pure integer function section_node(model, e) result(node)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e

      node = 0
      if (n_sections(model) == 0) return
      if (model%element_section(e) > 0) node = model%sections(model%element_section(e))%node
   end function section_node

   !> The nodes whose displacements element E feels: its corners, and the node of a section that it touches from behind.
   pure function felt_nodes(model, e) result(nodes)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e
      integer, allocatable :: nodes(:)

      nodes = corners_of(model, e)
      if (section_node(model, e) > 0) nodes = [nodes, section_node(model, e)]
   end function felt_nodes

   !> The nodes whose unknowns element E couples.
   pure function coupled_nodes(model, e) result(nodes)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e
      integer, allocatable :: nodes(:)

      nodes = unknown_nodes(model, felt_nodes(model, e))
   end function coupled_nodes

   !> Displacements of the corners of element E as it feels them: u, at a section that it touches from behind u + g direction.
   pure function corner_displacements(model, e, u) result(moved)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e
      real(wp), intent(in)         :: u(:, :) !! (dimension, n_nodes) [length]
      real(wp) :: moved(model%dimension, element_table(model%element_kind(e))%n_nodes)
      integer  :: i

      associate (corners => corners_of(model, e))
         moved = u(:, corners)
         if (section_node(model, e) == 0) return
         associate (section => model%sections(model%element_section(e)))
            do i = 1, size(corners)
               if (model%node_section(corners(i)) == model%element_section(e)) &
                  moved(:, i) = moved(:, i) + u(1, section%node)*section%direction(:model%dimension)
            end do
         end associate
      end associate
   end function corner_displacements

   !> [T]^T [k] [T]: the stiffness K of element E between its corners becomes that between its felt_nodes, components of node 1
   !! first. Of the section's node the first component alone has any.
   pure subroutine extend_stiffness(model, e, k)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e
      real(wp), intent(inout)      :: k(:, :) !! dimension x coupled nodes rows and columns are set [force/length]
      real(wp) :: row(size(k, 1))
      integer  :: c, d, g, i, n

      if (section_node(model, e) == 0) return
      d = model%dimension
      associate (corners => corners_of(model, e), section => model%sections(model%element_section(e)))
         n = d*size(corners)
         g = n + 1
         k(g:n + d, :n + d) = 0.0_wp
         k(:n, g:n + d) = 0.0_wp
         row = 0.0_wp
         do i = 1, size(corners)
            if (model%node_section(corners(i)) /= model%element_section(e)) cycle
            do c = 1, d
               row(:n) = row(:n) + section%direction(c)*k(d*(i - 1) + c, :n)
            end do
         end do
         do i = 1, size(corners)
            if (model%node_section(corners(i)) == model%element_section(e)) &
               row(g) = row(g) + dot_product(section%direction(:d), row(d*(i - 1) + 1:d*i))
         end do
         k(g, :g) = row(:g)
         k(:n, g) = row(:n)
      end associate
   end subroutine extend_stiffness

   !> Forces F on NODES of element E, already in FORCE, do work on the overlap of a section too where the element touches it from
   !! behind: add that share at the section's node.
   pure subroutine add_section_share(model, e, nodes, f, force)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e, nodes(:)
      real(wp), intent(in)         :: f(:, :)     !! (at least dimension, nodes) [force]
      real(wp), intent(inout)      :: force(:, :) !! (at least dimension, n_nodes)
      integer :: d, i

      if (section_node(model, e) == 0) return
      d = model%dimension
      associate (section => model%sections(model%element_section(e)))
         do i = 1, size(nodes)
            if (model%node_section(nodes(i)) == model%element_section(e)) &
               force(1, section%node) = force(1, section%node) + dot_product(section%direction(:d), f(:d, i))
         end do
      end associate
   end subroutine add_section_share

end module section_coupling
