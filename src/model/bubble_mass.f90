!> The inertia of the inner node of shells of eight nodes. The displacement of such a shell is N u + b Q a: a are the amplitudes of
!! its bubble b along the directions Q, which statics gives from the nodal values, a = T u (shell_bubble_mass). The mass N^T N of the
!! nodes, one number per pair, is in mass_matrix; here is what the bubble adds, P^T T + T^T P, a matrix of rank six.
module bubble_mass
   use element_unknowns, only: displaced_nodes
   use kinds, only: wp
   use mesh_queries, only: element_points, is_shell
   use model_data, only: mesh_type, model_type
   use shell_element, only: node_thickness, shell_bubble_mass
   use structural_elements, only: most_own, own_to_values
   implicit none
   private

   public :: add_bubble_mass, add_bubble_products, area_mass, find_bubble_masses

   !> The rows P and T of a shell, for the components of its own nodes.
   type, public :: bubble_mass_type
      integer  :: nodes(most_own) = 0
      real(wp) :: p(3, 3*most_own) = 0.0_wp   !! [force time^2/length]
      real(wp) :: t(3, 3*most_own) = 0.0_wp
   end type bubble_mass_type

contains

   !> Mass per area at the nodes of shell E [force time^2/length^3].
   pure function area_mass(mesh, e) result(m)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)         :: e
      real(wp), allocatable :: m(:)           !! (nodes)

      associate (property => mesh%properties(mesh%element_property(e)))
         m = property%rho*node_thickness(mesh%structural%shells(mesh%structural%place(e)), size(element_points(mesh, e))) + &
             property%extra_mass
      end associate
   end function area_mass

   !> Whether element E has a bubble with inertia: a shell of eight nodes, unless mass is lumped.
   pure logical function has_bubble(mesh, e)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)         :: e

      has_bubble = .false.
      if (is_shell(mesh, e) .and. .not. mesh%lumped) has_bubble = 2*size(element_points(mesh, e)) == most_own
   end function has_bubble

   !> The ROWS of element E.
   pure subroutine rows_of(mesh, e, rows)
      type(mesh_type), intent(in)           :: mesh
      integer, intent(in)                   :: e
      type(bubble_mass_type), intent(inout) :: rows
      real(wp) :: own(3*most_own, 3*most_own)

      own = own_to_values(mesh, e)
      call shell_bubble_mass(mesh%structural%shells(mesh%structural%place(e)), mesh%x(:, element_points(mesh, e)), &
                             area_mass(mesh, e), rows%p, rows%t)
      rows%p = matmul(rows%p, own)
      rows%t = matmul(rows%t, own)
   end subroutine rows_of

   !> The BUBBLES of all elements of MODEL that have them.
   pure subroutine find_bubble_masses(model, bubbles)
      type(model_type), intent(in)                     :: model
      type(bubble_mass_type), allocatable, intent(out) :: bubbles(:)
      integer :: e, n

      allocate (bubbles(count([(has_bubble(model%mesh, e), e = 1, model%mesh%n_elements)])))
      n = 0
      do e = 1, model%mesh%n_elements
         if (.not. has_bubble(model%mesh, e)) cycle
         n = n + 1
         bubbles(n)%nodes = displaced_nodes(model%freedoms, e)
         call rows_of(model%mesh, e, bubbles(n))
      end do
   end subroutine find_bubble_masses

   !> Add to F what BUBBLES add to [m] {A}.
   pure subroutine add_bubble_products(bubbles, a, f)
      type(bubble_mass_type), intent(in) :: bubbles(:)
      real(wp), intent(in)               :: a(:, :) !! (3, n_nodes)
      real(wp), intent(inout)            :: f(:, :) !! likewise
      real(wp) :: u(3*most_own)
      integer  :: i

      do i = 1, size(bubbles)
         associate (nodes => bubbles(i)%nodes, p => bubbles(i)%p, t => bubbles(i)%t)
            u = reshape(a(:, nodes), [size(u)])
            f(:, nodes) = f(:, nodes) + reshape(matmul(matmul(t, u), p) + matmul(matmul(p, u), t), [3, most_own])
         end associate
      end do
   end subroutine add_bubble_products

   !> Add to M between the components of the own nodes of element E what its bubble adds, if it has one.
   pure subroutine add_bubble_mass(mesh, e, m)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)         :: e
      real(wp), intent(inout)     :: m(:, :)       !! [force time^2/length]
      type(bubble_mass_type) :: rows
      integer :: n

      if (.not. has_bubble(mesh, e)) return
      n = 3*most_own
      call rows_of(mesh, e, rows)
      m(:n, :n) = m(:n, :n) + matmul(transpose(rows%p), rows%t) + matmul(transpose(rows%t), rows%p)
   end subroutine add_bubble_mass

end module bubble_mass
