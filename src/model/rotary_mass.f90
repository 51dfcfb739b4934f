!> The rotary inertia of second-order shells: rho t^3/12 per area against rotation about axes in the shell, none about its normal. The
!! drilling rotation of these shells is soft, and with an inertia it would have natural modes of its own.
!!
!! Between the rotations of nodes i and j it is m_ij (1 - n_i n_i') (1 - n_j n_j') with the unit normals n.
module rotary_mass
   use element_unknowns, only: displaced_nodes
   use kinds, only: wp
   use mesh_queries, only: element_points, is_shell
   use model_data, only: mesh_type, model_type
   use shell_curved, only: surface_normal
   use shell_element, only: node_thickness, shell_products
   implicit none
   private

   public :: add_rotary_mass, add_rotary_products, find_rotary_masses, has_rotary_mass

   !> Of a shell of N nodes.
   type, public :: rotary_mass_type
      integer  :: n = 0
      integer  :: nodes(8) = 0             !! of its rotations
      real(wp) :: m(8, 8) = 0.0_wp         !! rotations are components times an arm [force time^2/length]
      real(wp) :: normal(3, 8) = 0.0_wp
   end type rotary_mass_type

contains

   !> Whether the inertia of element E about its normal is to be left out: a second-order shell, unless mass is lumped.
   pure logical function has_rotary_mass(mesh, e)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)         :: e

      has_rotary_mass = .false.
      if (is_shell(mesh, e) .and. .not. mesh%lumped) has_rotary_mass = size(element_points(mesh, e)) >= 6
   end function has_rotary_mass

   !> ROTARY of element E, without its nodes.
   pure subroutine find_rotary(mesh, e, rotary)
      type(mesh_type), intent(in)         :: mesh
      integer, intent(in)                 :: e
      type(rotary_mass_type), intent(out) :: rotary
      integer :: i

      associate (points => element_points(mesh, e), rho => mesh%properties(mesh%element_property(e))%rho, &
                 shell => mesh%structural%shells(mesh%structural%place(e)))
         associate (n => size(points), x => mesh%x(:, points), arms => mesh%rotations(mesh%rotation_of(points))%arm)
            rotary%n = n
            call shell_products(x, rho*node_thickness(shell, n)**3/12.0_wp, rotary%m(:n, :n))
            rotary%m(:n, :n) = rotary%m(:n, :n)/(spread(arms, 1, n)*spread(arms, 2, n))
            rotary%normal(:, :n) = reshape([(surface_normal(x, i), i = 1, n)], [3, n])
         end associate
      end associate
   end subroutine find_rotary

   !> The rotary inertia of all elements of MODEL that have it; in a plane all rotation is about the normals.
   pure subroutine find_rotary_masses(model, list)
      type(model_type), intent(in)                     :: model
      type(rotary_mass_type), allocatable, intent(out) :: list(:)
      integer, allocatable :: which(:)
      integer :: e, i

      which = pack([(e, e = 1, model%mesh%n_elements)], [(has_rotary_mass(model%mesh, e), e = 1, model%mesh%n_elements)])
      if (model%mesh%dimension == 2) which = which(:0)
      allocate (list(size(which)))
      do i = 1, size(which)
         call find_rotary(model%mesh, which(i), list(i))
         associate (nodes => displaced_nodes(model%freedoms, which(i)), n => list(i)%n)
            list(i)%nodes(:n) = nodes(n + 1:2*n)
         end associate
      end do
   end subroutine find_rotary_masses

   !> Add to M between the components of the own nodes of element E its rotary inertia, if it has one.
   pure subroutine add_rotary_mass(mesh, e, m)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)         :: e
      real(wp), intent(inout)     :: m(:, :)   !! [force time^2/length]
      type(rotary_mass_type) :: rotary
      integer :: i, j

      if (.not. has_rotary_mass(mesh, e) .or. mesh%dimension == 2) return
      call find_rotary(mesh, e, rotary)
      do i = 1, rotary%n
         do j = 1, rotary%n
            associate (row => 3*(rotary%n + i) - 2, column => 3*(rotary%n + j) - 2)
               m(row:row + 2, column:column + 2) = m(row:row + 2, column:column + 2) + rotary%m(i, j)* &
                                                   matmul(across(rotary%normal(:, i)), across(rotary%normal(:, j)))
            end associate
         end do
      end do
   end subroutine add_rotary_mass

   !> 1 - n n': what is not along the unit NORMAL.
   pure function across(normal) result(p)
      real(wp), intent(in) :: normal(3)
      real(wp) :: p(3, 3)
      integer  :: i

      p = -spread(normal, 1, 3)*spread(normal, 2, 3)
      do i = 1, 3
         p(i, i) = 1.0_wp + p(i, i)
      end do
   end function across

   !> Add to F what LIST adds to [m] {A}.
   pure subroutine add_rotary_products(list, a, f)
      type(rotary_mass_type), intent(in) :: list(:)
      real(wp), intent(in)               :: a(:, :) !! (3, n_nodes)
      real(wp), intent(inout)            :: f(:, :) !! likewise
      real(wp) :: turned(3, 8)
      integer  :: i, k

      do i = 1, size(list)
         associate (n => list(i)%n, nodes => list(i)%nodes, normal => list(i)%normal)
            do k = 1, n
               turned(:, k) = a(:, nodes(k)) - normal(:, k)*dot_product(normal(:, k), a(:, nodes(k)))
            end do
            turned(:, :n) = matmul(turned(:, :n), list(i)%m(:n, :n))
            do k = 1, n
               f(:, nodes(k)) = f(:, nodes(k)) + turned(:, k) - normal(:, k)*dot_product(normal(:, k), turned(:, k))
            end do
         end associate
      end do
   end subroutine add_rotary_products

end module rotary_mass
