!> The mass matrix of the structure: what forces its nodes need for an acceleration, F = [m] {a}. Bodies, bars and masses at nodes
!! resist in every direction alike, so that one number between two nodes does for all components; beams, elements behind the section
!! of a solid bolt and the inertia of rotations come on top.
module mass_matrix
   use element_kinds, only: max_felt_dofs, max_nodes
   use kinds, only: wp
   use lists, only: list_owners
   use mass_elements, only: bar_mass, inertia_at_rotation, n_masses, scalar_mass, whole_mass
   use model_data, only: is_beam, model_type, n_bars, n_points, own_nodes
   use node_coupling, only: felt_nodes, rotation_at, section_node
   implicit none
   private

   public :: form_mass, mass_times, total_mass

   integer, parameter :: worth_threads = 10000 ! nodes

   !> Rows of nodes: between node i and column(first(i):first(i + 1) - 1).
   type, public :: mass_matrix_type
      integer, allocatable  :: first(:)      !! (n_nodes + 1)
      integer, allocatable  :: column(:)
      real(wp), allocatable :: value(:)      !! [force time^2/length]
      integer, allocatable  :: whole(:)      !! elements that are not among these: beams, and those behind sections
      integer, allocatable  :: turning(:)    !! masses at nodes with rotations: of model%masses
   end type mass_matrix_type

contains

   !> The mass of MODEL.
   subroutine form_mass(model, mass)
      type(model_type), intent(in)        :: model
      type(mass_matrix_type), intent(out) :: mass
      real(wp) :: m(max_nodes, max_nodes)
      integer  :: e, i

      call lay_out(model, mass)
      mass%whole = pack([(e, e = 1, model%n_elements)], [(has_own_matrix(model, e), e = 1, model%n_elements)])
      do e = 1, model%n_elements
         if (has_own_matrix(model, e)) cycle
         call scalar_mass(model, e, m)
         call add(own_nodes(model, e), m)
      end do
      do i = 1, n_bars(model)
         associate (bar => model%bars(i))
            if (bar%mass > 0.0_wp) call add(bar%nodes, bar_mass(model, i))
         end associate
      end do
      mass%turning = [integer ::]
      do i = 1, n_masses(model)
         associate (node => model%masses(i)%node)
            call add([node], reshape([model%masses(i)%mass], [1, 1]))
            if (rotation_at(model, node) > 0) mass%turning = [mass%turning, i]
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

   !> Whether element E has more mass than one number between two nodes.
   pure logical function has_own_matrix(model, e)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e

      has_own_matrix = section_node(model, e) > 0 .or. is_beam(model, e)
   end function has_own_matrix

   !> Which nodes share an element, or a bar with mass; every node is its own neighbour.
   subroutine lay_out(model, mass)
      type(model_type), intent(in)          :: model
      type(mass_matrix_type), intent(inout) :: mass
      integer, allocatable :: ends(:, :), first_bar(:), bars_at(:), seen_by(:)
      integer :: e, i, k, n, node, pass

      allocate (ends(2, n_bars(model)), source=0)
      do i = 1, n_bars(model)
         if (model%bars(i)%mass > 0.0_wp) ends(:, i) = model%bars(i)%nodes
      end do
      call list_owners(model%n_nodes, ends, first_bar, bars_at)
      allocate (mass%first(model%n_nodes + 1), seen_by(model%n_nodes))
      do pass = 1, 2 ! count, then fill
         seen_by = 0
         n = 0
         do node = 1, model%n_nodes
            mass%first(node) = n + 1
            call visit(node)
            do i = model%first_at(node), model%first_at(node + 1) - 1
               e = model%elements_at(i)
               if (has_own_matrix(model, e)) cycle
               associate (nodes => own_nodes(model, e))
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
         mass%first(model%n_nodes + 1) = n + 1
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

   !> F = [m] {A}. Every node is the work of one thread.
   subroutine mass_times(model, mass, a, f)
      type(model_type), intent(in)       :: model
      type(mass_matrix_type), intent(in) :: mass
      real(wp), contiguous, intent(in)   :: a(:, :) !! (dimension, n_nodes) of nodes, those of rotations and sections included
      real(wp), contiguous, intent(out)  :: f(:, :) !! likewise
      real(wp) :: m(max_felt_dofs, max_felt_dofs), s(3)
      integer  :: i, k, n

      !$omp parallel do default(shared) private(k, s) if(model%n_nodes > worth_threads)
      do i = 1, model%n_nodes
         s = 0.0_wp
         do k = mass%first(i), mass%first(i + 1) - 1
            s(1) = s(1) + mass%value(k)*a(1, mass%column(k))
            s(2) = s(2) + mass%value(k)*a(2, mass%column(k))
            if (size(a, 1) == 3) s(3) = s(3) + mass%value(k)*a(3, mass%column(k))
         end do
         f(:, i) = s(:size(a, 1))
      end do
      !$omp end parallel do
      do i = 1, size(mass%whole)
         associate (nodes => felt_nodes(model, mass%whole(i)))
            n = model%dimension*size(nodes)
            call whole_mass(model, mass%whole(i), m)
            f(:, nodes) = f(:, nodes) + reshape(matmul(m(:n, :n), pack(a(:, nodes), .true.)), [model%dimension, size(nodes)])
         end associate
      end do
      do i = 1, size(mass%turning)
         associate (point => model%masses(mass%turning(i)))
            associate (node => model%rotations(rotation_at(model, point%node))%node)
               f(:, node) = f(:, node) + matmul(inertia_at_rotation(model, point), a(:, node))
            end associate
         end associate
      end do
   end subroutine mass_times

   !> The mass of the structure, where its centre is, and its moments and products of inertia about the axes through the centre,
   !! (I_xx, I_yy, I_zz, I_xy, I_yz, I_zx), products as the integral of x y dm; all from [m] alone. In the plane I_zz is what its
   !! bodies have as bodies of the plane. Of a ring the moments are not those of a body in space: zero.
   subroutine total_mass(model, mass, total, centre, inertia)
      type(model_type), intent(in)       :: model
      type(mass_matrix_type), intent(in) :: mass
      real(wp), intent(out)              :: total      !! [force time^2/length]
      real(wp), intent(out)              :: centre(3)  !! [length]
      real(wp), intent(out)              :: inertia(6) !! [force time^2 length]
      real(wp) :: a(model%dimension, model%n_nodes), f(model%dimension, model%n_nodes), second(3, 3), x(3, model%n_nodes)
      integer  :: c, i

      x = 0.0_wp
      do i = 1, n_points(model)
         x(:, i) = model%x(:, i)
      end do
      a = 0.0_wp
      a(1, :n_points(model)) = 1.0_wp
      call mass_times(model, mass, a, f)
      total = sum(f(1, :n_points(model)))
      centre = 0.0_wp
      inertia = 0.0_wp
      if (.not. total > 0.0_wp) return
      centre = matmul(x, f(1, :))/total
      if (model%axisymmetric) return
      do c = 1, model%dimension
         a = 0.0_wp
         a(1, :n_points(model)) = x(c, :n_points(model)) - centre(c)
         call mass_times(model, mass, a, f)
         second(:, c) = matmul(x, f(1, :)) - centre*sum(f(1, :))
      end do
      if (model%dimension == 2) then
         second(3, :) = 0.0_wp
         second(:, 3) = 0.0_wp
      end if
      inertia = [second(2, 2) + second(3, 3), second(3, 3) + second(1, 1), second(1, 1) + second(2, 2), &
                 second(1, 2), second(2, 3), second(3, 1)]
      do i = 1, n_masses(model)
         associate (own => model%masses(i)%inertia)
            inertia = inertia + [own(1, 1), own(2, 2), own(3, 3), -own(1, 2), -own(2, 3), -own(3, 1)]
         end associate
      end do
   end subroutine total_mass

end module mass_matrix
