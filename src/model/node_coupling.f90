!> Coupling of nodal displacements with the unknowns of the equations.
!! An ordinary node has its own unknowns, its displacements in global axes. The displacements of a coupled node are a sum over
!! parts, {u} = sum of [T] {q}, with the unknowns q of the node or of other nodes. A node with a displacement system CD has one
!! part: its own unknowns along the directions of the system. Elements, loads, interface elements and results use displacements;
!! this module transforms them to and from the unknowns of the equations:
!!
!!      {u} = [T] {q}      {f_q} = [T]^T {f}      [k_q] = [T]^T [k] [T]
!!
!! Pretension sections: the corners of an element behind a section include the overlap g of the section, {u_e} = [T] {u, g}. The
!! unknown g is component 1 of the node of the section.
module node_coupling
   use element_kinds, only: element_table
   use interface_operator, only: interface_element
   use kinds, only: wp
   use mesh_queries, only: element_points
   use model_data, only: freedoms_type, mesh_type, model_type, n_sections, node_coupling_type
   use numbers, only: identity
   use tolerances, only: rounding_of_entries
   use unknowns, only: component_axes
   implicit none
   private

   public :: is_coupled, couple_node, unknown_nodes, transformation, onto_unknowns, between_unknowns, displacements, &
             displacements_at, forces_on_unknowns, held_forces, list_on_unknowns, section_node, &
             corner_displacements, extend_stiffness, add_section_share, coupling_parts

contains

   !> The first and the last part of NODE in the coupling of the model; the last is < 0 where the node is not coupled.
   pure function coupling_parts(freedoms, node) result(parts)
      type(freedoms_type), intent(in) :: freedoms
      integer, intent(in)          :: node
      integer :: parts(2)

      parts = [0, -1]
      if (freedoms%coupling%n == 0) return
      associate (c => freedoms%coupling%of_node(node))
         if (c > 0) parts = [freedoms%coupling%first(c), freedoms%coupling%first(c + 1) - 1]
      end associate
   end function coupling_parts

   !> Whether any of NODES is coupled; a node 0 is skipped.
   pure logical function is_coupled(freedoms, nodes)
      type(freedoms_type), intent(in) :: freedoms
      integer, intent(in)          :: nodes(:)

      is_coupled = .false.
      if (freedoms%coupling%n > 0) is_coupled = any(freedoms%coupling%of_node(pack(nodes, nodes > 0)) > 0)
   end function is_coupled

   !> Couple NODE: u = sum of T(:, :, k) q of the node MASTERS(k), in COUPLING of N_NODES nodes. An earlier coupling is replaced.
   pure subroutine couple_node(coupling, n_nodes, node, masters, t)
      type(node_coupling_type), intent(inout) :: coupling
      integer, intent(in)                     :: n_nodes, node, masters(:)
      real(wp), intent(in)                    :: t(:, :, :) !! (dimension, dimension, masters) [-]
      integer :: n, parts

      if (coupling%n == 0) coupling%of_node = spread(0, 1, n_nodes)
      n = coupling%n + 1
      parts = coupling%first(n) - 1
      if (n + 1 > size(coupling%first)) coupling%first = [coupling%first, coupling%first]
      if (parts + size(masters) > size(coupling%node)) then
         coupling%node = [coupling%node, masters, coupling%node]
         coupling%t = reshape([coupling%t, t, coupling%t], [size(t, 1), size(t, 2), size(coupling%node)])
      end if
      coupling%n = n
      coupling%of_node(node) = n
      coupling%node(parts + 1:parts + size(masters)) = masters
      coupling%t(:, :, parts + 1:parts + size(masters)) = t
      coupling%first(n + 1) = parts + size(masters) + 1
   end subroutine couple_node

   !> The nodes whose unknowns determine NODES, each once: NODES themselves where none is coupled.
   pure function unknown_nodes(freedoms, nodes) result(unknown)
      type(freedoms_type), intent(in) :: freedoms
      integer, intent(in)          :: nodes(:)
      integer, allocatable :: unknown(:)
      integer :: i, k

      if (.not. is_coupled(freedoms, nodes)) then
         unknown = nodes
         return
      end if
      allocate (unknown(0))
      do i = 1, size(nodes)
         associate (parts => coupling_parts(freedoms, nodes(i)))
            if (parts(2) < 0 .and. all(unknown /= nodes(i))) unknown = [unknown, nodes(i)]
            do k = parts(1), parts(2)
               if (all(unknown /= freedoms%coupling%node(k))) unknown = [unknown, freedoms%coupling%node(k)]
            end do
         end associate
      end do
   end function unknown_nodes

   !> [T] of NODES: their displacements, components of node 1 first, from the unknowns of unknown_nodes in the same order.
   pure function transformation(mesh, freedoms, nodes) result(t)
      type(mesh_type), intent(in) :: mesh
      type(freedoms_type), intent(in) :: freedoms
      integer, intent(in)          :: nodes(:)
      real(wp), allocatable :: t(:, :)
      integer, allocatable  :: unknown(:)
      integer :: column, d, i, k

      allocate (unknown, source=unknown_nodes(freedoms, nodes))
      d = mesh%dimension
      allocate (t(d*size(nodes), d*size(unknown)), source=0.0_wp)
      do i = 1, size(nodes)
         associate (parts => coupling_parts(freedoms, nodes(i)))
            if (parts(2) < 0) then
               column = d*(findloc(unknown, nodes(i), dim=1) - 1)
               t(d*(i - 1) + 1:d*i, column + 1:column + d) = identity(:d, :d)
            end if
            do k = parts(1), parts(2)
               column = d*(findloc(unknown, freedoms%coupling%node(k), dim=1) - 1)
               t(d*(i - 1) + 1:d*i, column + 1:column + d) = freedoms%coupling%t(:, :, k)
            end do
         end associate
      end do
   end function transformation

   !> [T]^T [k] [T]: transform the stiffness K between the displacements of NODES to the unknowns of unknown_nodes. Entries that are
   !! only rounding become zero: a bar has no stiffness normal to its axis, and the check for unsupported nodes relies on the zero.
   pure subroutine onto_unknowns(model, nodes, k)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: nodes(:)
      real(wp), allocatable, intent(inout) :: k(:, :) !! at least one row and column per component of NODES; enlarged where the
                                                      !! unknowns need more [force/length]
      real(wp), allocatable :: t(:, :), wider(:, :)

      if (.not. is_coupled(model%freedoms, nodes)) return
      t = transformation(model%mesh, model%freedoms, nodes)
      associate (n => size(t, 1), m => size(t, 2))
         if (m > size(k, 1)) then
            allocate (wider(m, m))
            wider(:n, :n) = k(:n, :n)
            call move_alloc(wider, k)
         end if
         k(:m, :m) = matmul(transpose(t), matmul(k(:n, :n), t))
         where (abs(k(:m, :m)) <= rounding_of_entries*maxval(abs(k(:m, :m)))) k(:m, :m) = 0.0_wp
      end associate
   end subroutine onto_unknowns

   !> onto_unknowns for a K of exactly the size that it needs.
   pure function between_unknowns(model, nodes, k) result(q)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: nodes(:)
      real(wp), intent(in)         :: k(:, :) !! between the components of NODES; rows beyond them are left out [force/length]
      real(wp), allocatable :: q(:, :)
      integer :: n

      q = k
      call onto_unknowns(model, nodes, q)
      n = model%mesh%dimension*size(unknown_nodes(model%freedoms, nodes))
      q = q(:n, :n)
   end function between_unknowns

   !> Displacements U of all nodes from the unknowns Q.
   pure function displacements(model, q) result(u)
      type(model_type), intent(in) :: model
      real(wp), intent(in)         :: q(:, :) !! (dimension, n_nodes) [length]
      real(wp), allocatable :: u(:, :)
      integer :: i, k

      u = q
      if (model%freedoms%coupling%n == 0) return
      do i = 1, size(model%freedoms%coupling%of_node)
         associate (coupling => model%freedoms%coupling, parts => coupling_parts(model%freedoms, i))
            if (parts(2) >= 0) u(:, i) = 0.0_wp
            do k = parts(1), parts(2)
               u(:, i) = u(:, i) + matmul(coupling%t(:, :, k), q(:, coupling%node(k)))
            end do
         end associate
      end do
   end function displacements

   !> Displacements of NODES; the unknowns of node i are Q(:, PLACE(i)).
   pure function displacements_at(model, nodes, place, q) result(u)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: nodes(:)
      integer, intent(in)          :: place(:) !! (n_nodes)
      real(wp), intent(in)         :: q(:, :)  !! (dimension, places) [length]
      real(wp) :: u(size(q, 1), size(nodes))

      if (is_coupled(model%freedoms, nodes)) then
         u = reshape(matmul(transformation(model%mesh, model%freedoms, nodes), &
                            pack(q(:, place(unknown_nodes(model%freedoms, nodes))), .true.)), shape(u))
      else
         u = q(:, place(nodes))
      end if
   end function displacements_at

   !> Transform the forces F on all nodes to forces on their unknowns, [T]^T {f}, which do the same work.
   pure function forces_on_unknowns(model, f) result(on_unknowns)
      type(model_type), intent(in) :: model
      real(wp), intent(in)         :: f(:, :) !! (dimension, n_nodes) [force]
      real(wp), allocatable :: on_unknowns(:, :)
      integer :: i, k

      on_unknowns = f
      if (model%freedoms%coupling%n == 0) return
      associate (coupling => model%freedoms%coupling)
         do i = 1, size(coupling%of_node)
            if (coupling%of_node(i) > 0) on_unknowns(:, i) = 0.0_wp
         end do
         do i = 1, size(coupling%of_node)
            associate (parts => coupling_parts(model%freedoms, i))
               do k = parts(1), parts(2)
                  on_unknowns(:, coupling%node(k)) = on_unknowns(:, coupling%node(k)) + matmul(f(:, i), coupling%t(:, :, k))
               end do
            end associate
         end do
      end associate
   end function forces_on_unknowns

   !> The part of the forces F on all nodes that acts on held unknowns, in global axes at the nodes of these unknowns.
   pure function held_forces(model, f) result(held)
      type(model_type), intent(in) :: model
      real(wp), intent(in)         :: f(:, :) !! (dimension, n_nodes) [force]
      real(wp), allocatable :: held(:, :)
      integer :: i

      held = merge(forces_on_unknowns(model, f), 0.0_wp, model%freedoms%held)
      if (model%freedoms%coupling%n == 0) return
      do i = 1, size(model%freedoms%coupling%of_node)
         if (any(model%freedoms%held(:, i))) held(:, i) = matmul(component_axes(model%mesh, i), held(:, i))
      end do
   end function held_forces

   !> The interface ELEMENTS of the model, expressed by the nodes of their unknowns.
   pure subroutine list_on_unknowns(model, elements)
      type(model_type), intent(in)                      :: model
      type(interface_element), allocatable, intent(out) :: elements(:)
      real(wp), allocatable :: t(:, :)
      integer :: a, b, d, i

      elements = model%joints%element
      d = model%mesh%dimension
      do i = 1, size(elements)
         associate (nodes => model%joints%element(i)%node)
            if (.not. is_coupled(model%freedoms, nodes)) cycle
            t = transformation(model%mesh, model%freedoms, nodes)
            elements(i)%node = unknown_nodes(model%freedoms, nodes)
            allocate (elements(i)%map(d, d, size(elements(i)%node)), source=0.0_wp)
            do b = 1, size(elements(i)%node)
               do a = 1, size(nodes)
                  elements(i)%map(:, :, b) = elements(i)%map(:, :, b) + model%joints%element(i)%weight(a)* &
                                             t(d*(a - 1) + 1:d*a, d*(b - 1) + 1:d*b)
               end do
            end do
         end associate
      end do
   end subroutine list_on_unknowns

   !> The node of the section that element E touches from behind; 0: none.
   pure integer function section_node(mesh, e) result(node)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)          :: e

      node = 0
      if (n_sections(mesh) == 0) return
      if (mesh%element_section(e) > 0) node = mesh%sections(mesh%element_section(e))%node
   end function section_node

   !> Displacements of the corners of element E: u, or u + g direction at a section that the element touches from behind.
   pure function corner_displacements(model, e, u) result(moved)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e
      real(wp), intent(in)         :: u(:, :) !! (dimension, n_nodes) [length]
      real(wp) :: moved(model%mesh%dimension, element_table(model%mesh%element_kind(e))%n_nodes)
      integer  :: i

      associate (corners => element_points(model%mesh, e))
         moved = u(:, corners)
         if (section_node(model%mesh, e) == 0) return
         associate (section => model%mesh%sections(model%mesh%element_section(e)))
            do i = 1, size(corners)
               if (model%mesh%node_section(corners(i)) == model%mesh%element_section(e)) &
                  moved(:, i) = moved(:, i) + u(1, section%node)*section%direction(:model%mesh%dimension)
            end do
         end associate
      end associate
   end function corner_displacements

   !> [T]^T [k] [T]: transform the stiffness K of element E from its points to its displaced_nodes, components of node 1 first.
   !! Only the first component of the section node has stiffness.
   pure subroutine extend_stiffness(model, e, k)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e
      real(wp), intent(inout)      :: k(:, :) !! dimension x displaced nodes rows and columns are set [force/length]
      real(wp) :: row(size(k, 1))
      integer  :: c, d, g, i, n

      if (section_node(model%mesh, e) == 0) return
      d = model%mesh%dimension
      associate (corners => element_points(model%mesh, e), section => model%mesh%sections(model%mesh%element_section(e)))
         n = d*size(corners)
         g = n + 1
         k(g:n + d, :n + d) = 0.0_wp
         k(:n, g:n + d) = 0.0_wp
         row = 0.0_wp
         do i = 1, size(corners)
            if (model%mesh%node_section(corners(i)) /= model%mesh%element_section(e)) cycle
            do c = 1, d
               row(:n) = row(:n) + section%direction(c)*k(d*(i - 1) + c, :n)
            end do
         end do
         do i = 1, size(corners)
            if (model%mesh%node_section(corners(i)) == model%mesh%element_section(e)) &
               row(g) = row(g) + dot_product(section%direction(:d), row(d*(i - 1) + 1:d*i))
         end do
         k(g, :g) = row(:g)
         k(:n, g) = row(:n)
      end associate
   end subroutine extend_stiffness

   !> Forces F on NODES of element E, already added to FORCE, also do work on the overlap of a section that the element touches from
   !! behind: add this work-equivalent force at the node of the section.
   pure subroutine add_section_share(mesh, e, nodes, f, force)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)          :: e, nodes(:)
      real(wp), intent(in)         :: f(:, :)     !! (at least dimension, nodes) [force]
      real(wp), intent(inout)      :: force(:, :) !! (at least dimension, n_nodes)
      integer :: d, i

      if (section_node(mesh, e) == 0) return
      d = mesh%dimension
      associate (section => mesh%sections(mesh%element_section(e)))
         do i = 1, size(nodes)
            if (mesh%node_section(nodes(i)) == mesh%element_section(e)) &
               force(1, section%node) = force(1, section%node) + dot_product(section%direction(:d), f(:d, i))
         end do
      end associate
   end subroutine add_section_share

end module node_coupling
