!> Mass matrices of elements, bars and nodal masses, consistent or lumped, and the inertia forces F = [m] {a}.
!! Bodies, bars and nodal masses have the same inertia in every direction: one number per pair of nodes holds for all components.
!! Beams, elements behind a pretension section and the inertia of rotations have matrices of their own.
module mass_matrix
   use beam_element, only: beam_mass
   use bubble_mass, only: add_bubble_mass, add_bubble_products, area_mass, bubble_mass_type, find_bubble_masses
   use body_elements, only: coupled_stiffness, law_of
   use element_kinds, only: element_table, max_section_dofs, max_nodes
   use element_unknowns, only: displaced_nodes, nodes_of_unknowns
   use isoparametric, only: lump, shape_products
   use kinds, only: wp
   use lists, only: list_owners
   use mesh_queries, only: element_points, is_beam, is_shell, n_points
   use model_data, only: bar_nodes, mesh_type, model_type, n_bars, point_mass_type
   use node_coupling, only: between_unknowns, extend_stiffness, onto_unknowns, section_node
   use numbers, only: identity
   use rotary_mass, only: add_rotary_mass, add_rotary_products, find_rotary_masses, has_rotary_mass, rotary_mass_type
   use shell_element, only: node_thickness, shell_products
   use structural_elements, only: between_own
   use unknowns, only: rotation_at
   implicit none
   private

   public :: bar_mass, scalar_mass, n_masses, form_mass, mass_times, total_mass
   public :: coupled_dynamic_stiffness, coupled_bar_mass, coupled_point_mass, mass_nodes

   integer, parameter :: worth_threads = 10000 ! number of nodes from which on threads are used

   !> Sparse rows: node i is connected to column(first(i):first(i + 1) - 1).
   type, public :: mass_matrix_type
      integer, allocatable  :: first(:)      !! (n_nodes + 1)
      integer, allocatable  :: column(:)
      real(wp), allocatable :: value(:)      !! [force time^2/length]
      integer, allocatable  :: whole(:)      !! elements with matrices of their own: beams, and elements behind sections
      integer, allocatable  :: turning(:)    !! masses at nodes with rotations, CMASS and CONM1: positions in model%mesh%masses
      type(bubble_mass_type), allocatable :: bubbles(:)
      type(rotary_mass_type), allocatable :: rotary(:)
   end type mass_matrix_type

contains

   !> The number of nodal masses.
   pure integer function n_masses(model)
      type(model_type), intent(in) :: model

      n_masses = size(model%mesh%masses)
   end function n_masses

   !> Mass between the points of element E (no beam), the same for every component of their displacements [force time^2/length].
   !! Of a shell: between its corners, and between its rotations the rotary inertia of the thickness, divided by the arms; the
   !! drilling rotation of a linear shell has this inertia too, second-order shells have rotary_mass. Lumped mass has no rotary inertia.
   pure subroutine scalar_mass(mesh, e, lumped, m)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)          :: e
      logical, intent(in)          :: lumped
      real(wp), intent(inout)      :: m(:, :) !! (nodes, nodes), set here
      integer :: i, n

      n = element_table(mesh%element_kind(e))%n_nodes
      associate (corners => element_points(mesh, e), property => mesh%properties(mesh%element_property(e)))
         if (is_shell(mesh, e)) then
            associate (x => mesh%x(:, corners), t => node_thickness(mesh%structural%shells(mesh%structural%place(e)), n))
               m(:2*n, :2*n) = 0.0_wp
               call shell_products(x, area_mass(mesh, e), m(:n, :n))
               if (.not. (lumped .or. has_rotary_mass(mesh, e))) &
                  call shell_products(x, property%rho*t**3/12.0_wp, m(n + 1:2*n, n + 1:2*n))
            end associate
            do i = n + 1, 2*n
               associate (arm => mesh%rotations(mesh%rotation_of(corners(i - n)))%arm)
                  m(i, n + 1:2*n) = m(i, n + 1:2*n)/arm
                  m(n + 1:2*n, i) = m(n + 1:2*n, i)/arm
               end associate
            end do
         else
            call shape_products(law_of(mesh, e), mesh%x(:mesh%dimension, corners), m)
            m(:n, :n) = property%rho*m(:n, :n)
         end if
         if (lumped) call lump(m(:n, :n))
      end associate
   end subroutine scalar_mass

   !> [m] between the displaced_nodes of element E, components of node 1 first [force time^2/length].
   pure subroutine whole_mass(model, e, m)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e
      real(wp), intent(inout)      :: m(:, :) !! dimension x displaced nodes rows and columns are set
      real(wp) :: scalar(max_nodes, max_nodes)
      integer  :: c, d, n

      if (is_beam(model%mesh, e)) then
         call between_own(model, e, beam_mass(model%mesh%structural%beams(model%mesh%structural%place(e)), &
                                              model%mesh%x(:, element_points(model%mesh, e)), model%mesh%lumped), m)
         return
      end if
      d = model%mesh%dimension
      n = element_table(model%mesh%element_kind(e))%n_nodes
      if (is_shell(model%mesh, e)) n = 2*n ! with their rotations
      call scalar_mass(model%mesh, e, model%mesh%lumped, scalar)
      m(:d*n, :d*n) = 0.0_wp
      do c = 1, d
         m(c:d*n:d, c:d*n:d) = scalar(:n, :n)
      end do
      call add_bubble_mass(model%mesh, e, m)
      call add_rotary_mass(model%mesh, e, m)
      call extend_stiffness(model, e, m)
   end subroutine whole_mass

   !> K = [k] - SHIFT [m] between the components of the nodes_of_unknowns of element E, components of node 1 first [force/length].
   pure subroutine coupled_dynamic_stiffness(model, e, shift, k)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e
      real(wp), intent(in)         :: shift   !! [1/time^2]
      real(wp), allocatable, intent(inout) :: k(:, :) !! as of coupled_stiffness; dimension x these nodes rows and columns are set
      real(wp), allocatable :: full(:, :)
      integer  :: n

      call coupled_stiffness(model, e, k)
      if (.not. abs(shift) > 0.0_wp) return
      allocate (full(max_section_dofs, max_section_dofs))
      call whole_mass(model, e, full)
      if (model%freedoms%coupling%n > 0) call onto_unknowns(model, displaced_nodes(model%freedoms, e), full)
      n = model%mesh%dimension*size(nodes_of_unknowns(model%freedoms, e))
      k(:n, :n) = k(:n, :n) - shift*full(:n, :n)
   end subroutine coupled_dynamic_stiffness

   !> Mass between the two nodes of bar I, the same for every component [force time^2/length].
   pure function bar_mass(mesh, i) result(m)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)          :: i
      real(wp) :: m(2, 2)

      m = mesh%bars(i)%mass/6.0_wp*reshape([2.0_wp, 1.0_wp, 1.0_wp, 2.0_wp], [2, 2])
      if (mesh%lumped) call lump(m)
   end function bar_mass

   !> [m] of bar I between the unknowns of the unknown_nodes of its nodes.
   pure function coupled_bar_mass(model, i) result(m)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: i
      real(wp), allocatable :: m(:, :)
      real(wp) :: of_components(2*model%mesh%dimension, 2*model%mesh%dimension)
      integer  :: c, d

      d = model%mesh%dimension
      of_components = 0.0_wp
      do c = 1, d
         of_components(c::d, c::d) = bar_mass(model%mesh, i)
      end do
      m = between_unknowns(model, bar_nodes(model%mesh%bars(i)), of_components)
   end function coupled_bar_mass

   !> The nodes of MASS: its own, and the node of its rotations if there is one.
   pure function mass_nodes(model, mass) result(nodes)
      type(model_type), intent(in)      :: model
      type(point_mass_type), intent(in) :: mass
      integer, allocatable :: nodes(:)

      if (allocated(mass%nodes)) nodes = mass%nodes
      if (allocated(mass%nodes)) return
      nodes = [mass%node]
      if (rotation_at(model%mesh, mass%node) > 0) nodes = [nodes, model%mesh%rotations(rotation_at(model%mesh, mass%node))%node]
   end function mass_nodes

   !> The inertia of MASS with respect to the node of its rotations, whose components are rotations times an arm: in space about x,
   !! y and z, in the plane about z alone [force time^2/length].
   pure function inertia_at_rotation(model, mass) result(m)
      type(model_type), intent(in)      :: model
      type(point_mass_type), intent(in) :: mass
      real(wp) :: m(model%mesh%dimension, model%mesh%dimension)

      associate (arm => model%mesh%rotations(rotation_at(model%mesh, mass%node))%arm)
         if (model%mesh%dimension == 3) then
            m = mass%inertia/arm**2
         else
            m = 0.0_wp
            m(1, 1) = mass%inertia(3, 3)/arm**2
         end if
      end associate
   end function inertia_at_rotation

   !> [m] of MASS between the unknowns of unknown_nodes(mass_nodes), in the order of these nodes.
   pure function coupled_point_mass(model, mass) result(m)
      type(model_type), intent(in)      :: model
      type(point_mass_type), intent(in) :: mass
      real(wp), allocatable :: m(:, :)
      real(wp) :: of_components(2*model%mesh%dimension, 2*model%mesh%dimension)
      integer  :: d

      if (allocated(mass%matrix)) then
         m = between_unknowns(model, mass%nodes, mass%matrix)
         return
      end if
      d = model%mesh%dimension
      of_components = 0.0_wp
      of_components(:d, :d) = mass%directed(:d, :d) + mass%mass*identity(:d, :d)
      associate (nodes => mass_nodes(model, mass))
         if (size(nodes) == 2) of_components(d + 1:, d + 1:) = inertia_at_rotation(model, mass)
         m = between_unknowns(model, nodes, of_components)
      end associate
   end function coupled_point_mass

   !> Assemble the mass of MODEL.
   subroutine form_mass(model, mass)
      type(model_type), intent(in)        :: model
      type(mass_matrix_type), intent(out) :: mass
      real(wp) :: m(max_nodes, max_nodes)
      integer  :: e, i

      call lay_out(model, mass)
      mass%whole = pack([(e, e = 1, model%mesh%n_elements)], [(has_own_matrix(model, e), e = 1, model%mesh%n_elements)])
      do e = 1, model%mesh%n_elements
         if (has_own_matrix(model, e)) cycle
         call scalar_mass(model%mesh, e, model%mesh%lumped, m)
         call add(displaced_nodes(model%freedoms, e), m)
      end do
      call find_bubble_masses(model, mass%bubbles)
      call find_rotary_masses(model, mass%rotary)
      do i = 1, n_bars(model%mesh)
         associate (bar => model%mesh%bars(i))
            if (bar%mass > 0.0_wp) call add(bar%nodes, bar_mass(model%mesh, i))
         end associate
      end do
      mass%turning = [integer ::]
      do i = 1, n_masses(model)
         associate (node => model%mesh%masses(i)%node)
            call add([node], reshape([model%mesh%masses(i)%mass], [1, 1]))
            if (rotation_at(model%mesh, node) > 0 .or. any(model%mesh%masses(i)%directed > 0.0_wp) .or. &
                allocated(model%mesh%masses(i)%matrix)) mass%turning = [mass%turning, i]
         end associate
      end do

   contains

      subroutine add(nodes, values)
         integer, intent(in)  :: nodes(:)
         real(wp), intent(in) :: values(:, :)
         integer :: a, b, at

         do b = 1, size(nodes)
            do a = 1, size(nodes)
               associate (row => mass%first(nodes(b)))
                  at = row - 1 + findloc(mass%column(row:mass%first(nodes(b) + 1) - 1), nodes(a), dim=1)
               end associate
               mass%value(at) = mass%value(at) + values(a, b)
            end do
         end do
      end subroutine add

   end subroutine form_mass

   !> Whether the mass of element E needs more than one number per pair of nodes.
   pure logical function has_own_matrix(model, e)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e

      has_own_matrix = section_node(model%mesh, e) > 0 .or. is_beam(model%mesh, e)
   end function has_own_matrix

   !> The sparsity pattern: nodes are connected by an element or by a bar with mass; every node is connected to itself.
   subroutine lay_out(model, mass)
      type(model_type), intent(in)          :: model
      type(mass_matrix_type), intent(inout) :: mass
      integer, allocatable :: ends(:, :), first_bar(:), bars_at(:), seen_by(:)
      integer :: e, i, k, n, node, pass

      allocate (ends(2, n_bars(model%mesh)), source=0)
      do i = 1, n_bars(model%mesh)
         if (model%mesh%bars(i)%mass > 0.0_wp) ends(:, i) = model%mesh%bars(i)%nodes
      end do
      call list_owners(model%mesh%n_nodes, ends, first_bar, bars_at)
      allocate (mass%first(model%mesh%n_nodes + 1), seen_by(model%mesh%n_nodes))
      do pass = 1, 2 ! count, then fill
         seen_by = 0
         n = 0
         do node = 1, model%mesh%n_nodes
            mass%first(node) = n + 1
            call visit(node)
            do i = model%mesh%first_at(node), model%mesh%first_at(node + 1) - 1
               e = model%mesh%elements_at(i)
               if (has_own_matrix(model, e)) cycle
               associate (nodes => displaced_nodes(model%freedoms, e))
                  do k = 1, size(nodes)
                     call visit(nodes(k))
                  end do
               end associate
            end do
            do i = first_bar(node), first_bar(node + 1) - 1
               call visit(ends(1, bars_at(i)))
               call visit(ends(2, bars_at(i)))
            end do
         end do
         mass%first(model%mesh%n_nodes + 1) = n + 1
         if (pass == 1) allocate (mass%column(n))
      end do
      allocate (mass%value(n), source=0.0_wp)

   contains

      subroutine visit(other)
         integer, intent(in) :: other

         if (seen_by(other) == node) return
         seen_by(other) = node
         n = n + 1
         if (pass == 2) mass%column(n) = other
      end subroutine visit

   end subroutine lay_out

   !> F = [m] {A}. Each node is computed by one thread.
   subroutine mass_times(model, mass, a, f, bubbles)
      type(model_type), intent(in)       :: model
      type(mass_matrix_type), intent(in) :: mass
      real(wp), contiguous, intent(in)   :: a(:, :) !! (dimension, n_nodes), with the nodes of rotations and sections
      real(wp), contiguous, intent(out)  :: f(:, :) !! likewise
      logical, intent(in), optional      :: bubbles !! of shells; default: with them
      real(wp) :: m(max_section_dofs, max_section_dofs), s(3)
      integer  :: i, k, n
      logical  :: has_bubbles

      !$omp parallel do default(shared) private(k, s) if(model%mesh%n_nodes > worth_threads)
      do i = 1, model%mesh%n_nodes
         s = 0.0_wp
         do k = mass%first(i), mass%first(i + 1) - 1
            s(1) = s(1) + mass%value(k)*a(1, mass%column(k))
            s(2) = s(2) + mass%value(k)*a(2, mass%column(k))
            if (size(a, 1) == 3) s(3) = s(3) + mass%value(k)*a(3, mass%column(k))
         end do
         f(:, i) = s(:size(a, 1))
      end do
      !$omp end parallel do
      has_bubbles = .true.
      if (present(bubbles)) has_bubbles = bubbles
      if (has_bubbles) call add_bubble_products(mass%bubbles, a, f)
      call add_rotary_products(mass%rotary, a, f)
      do i = 1, size(mass%whole)
         associate (nodes => displaced_nodes(model%freedoms, mass%whole(i)))
            n = model%mesh%dimension*size(nodes)
            call whole_mass(model, mass%whole(i), m)
            f(:, nodes) = f(:, nodes) + reshape(matmul(m(:n, :n), pack(a(:, nodes), .true.)), [model%mesh%dimension, size(nodes)])
         end associate
      end do
      do i = 1, size(mass%turning)
         associate (point => model%mesh%masses(mass%turning(i)))
            if (allocated(point%matrix)) then
               f(:, point%nodes) = f(:, point%nodes) + reshape(matmul(point%matrix, pack(a(:, point%nodes), .true.)), &
                                                               [model%mesh%dimension, size(point%nodes)])
               cycle
            end if
            f(:, point%node) = f(:, point%node) + matmul(point%directed(:size(a, 1), :size(a, 1)), a(:, point%node))
            if (rotation_at(model%mesh, point%node) == 0) cycle
            associate (node => model%mesh%rotations(rotation_at(model%mesh, point%node))%node)
               f(:, node) = f(:, node) + matmul(inertia_at_rotation(model, point), a(:, node))
            end associate
         end associate
      end do
   end subroutine mass_times

   !> Total mass, centre of mass, and moments and products of inertia about the axes through the centre, (I_xx, I_yy, I_zz, I_xy,
   !! I_yz, I_zx), products as the integral of x y dm; all from [m] alone. In a plane model I_zz is that of the plane bodies. In an
   !! axisymmetric model the moments are zero, because those of its plane are not the moments of a body in space. Bubbles of shells
   !! have no part in them: their amplitudes are zero in rigid-body motions.
   subroutine total_mass(model, mass, total, centre, inertia)
      type(model_type), intent(in)       :: model
      type(mass_matrix_type), intent(in) :: mass
      real(wp), intent(out)              :: total      !! [force time^2/length]
      real(wp), intent(out)              :: centre(3)  !! [length]
      real(wp), intent(out)              :: inertia(6) !! [force time^2 length]
      real(wp) :: a(model%mesh%dimension, model%mesh%n_nodes), f(model%mesh%dimension, model%mesh%n_nodes)
      real(wp) :: second(3, 3), x(3, model%mesh%n_nodes)
      integer  :: c, i

      x = 0.0_wp
      x(:, :n_points(model%mesh)) = model%mesh%x(:, :n_points(model%mesh))
      a = 0.0_wp
      a(1, :n_points(model%mesh)) = 1.0_wp
      where (model%mesh%is_scalar) a(1, :size(model%mesh%is_scalar)) = 0.0_wp
      call mass_times(model, mass, a, f, bubbles=.false.)
      total = sum(f(1, :n_points(model%mesh)))
      centre = 0.0_wp
      inertia = 0.0_wp
      if (.not. total > 0.0_wp) return
      centre = matmul(x, f(1, :))/total
      if (model%mesh%axisymmetric) return
      second = 0.0_wp
      do c = 1, model%mesh%dimension
         a = 0.0_wp
         a(1, :n_points(model%mesh)) = x(c, :n_points(model%mesh)) - centre(c)
         where (model%mesh%is_scalar) a(1, :size(model%mesh%is_scalar)) = 0.0_wp
         call mass_times(model, mass, a, f, bubbles=.false.)
         second(:, c) = matmul(x, f(1, :)) - centre*sum(f(1, :))
      end do
      if (model%mesh%dimension == 2) second(3, :) = 0.0_wp
      inertia = [second(2, 2) + second(3, 3), second(3, 3) + second(1, 1), second(1, 1) + second(2, 2), &
                 second(1, 2), second(2, 3), second(3, 1)]
      do i = 1, n_masses(model)
         associate (tensor => model%mesh%masses(i)%inertia)
            inertia = inertia + [tensor(1, 1), tensor(2, 2), tensor(3, 3), -tensor(1, 2), -tensor(2, 3), -tensor(3, 1)]
         end associate
      end do
   end subroutine total_mass

end module mass_matrix
