!> The masses of the structure, each as a matrix: of body elements, of bars, and at nodes. Consistent, or lumped where the deck says so.
module mass_elements
   use body_elements, only: coupled_stiffness, law_of
   use element_kinds, only: max_felt_dofs, max_nodes
   use isoparametric, only: lump, shape_products
   use kinds, only: wp
   use model_data, only: bar_nodes, corners_of, is_beam, is_shell, model_type, own_nodes, point_mass_type
   use node_coupling, only: between_unknowns, extend_stiffness, felt_nodes, onto_unknowns, rotation_at, unknown_nodes
   use structural_elements, only: shell_mass, structural_mass
   implicit none
   private

   public :: scalar_mass, whole_mass, bar_mass, inertia_at_rotation
   public :: coupled_dynamic_stiffness, coupled_bar_mass, coupled_point_mass, mass_nodes, n_masses

contains

   !> How many masses there are at nodes.
   pure integer function n_masses(model)
      type(model_type), intent(in) :: model

      n_masses = 0
      if (allocated(model%masses)) n_masses = size(model%masses)
   end function n_masses

   !> Mass between the own_nodes of element E, no beam, the same for every component of their displacements [force time^2/length].
   pure subroutine scalar_mass(model, e, m)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e
      real(wp), intent(inout)      :: m(:, :) !! (nodes, nodes), set here
      integer :: k

      if (is_shell(model, e)) then
         k = size(corners_of(model, e))
         m(:2*k, :2*k) = 0.0_wp
         call shell_mass(model, e, .false., m(:k, :k))
         call shell_mass(model, e, .true., m(k + 1:2*k, k + 1:2*k))
         if (model%lumped) call lump(m(:k, :k))
         if (model%lumped) call lump(m(k + 1:2*k, k + 1:2*k))
         return
      end if
      associate (corners => corners_of(model, e))
         call shape_products(law_of(model, e), model%x(:model%dimension, corners), m)
         associate (n => size(corners))
            m(:n, :n) = model%properties(model%element_property(e))%rho*m(:n, :n)
            if (model%lumped) call lump(m(:n, :n))
         end associate
      end associate
   end subroutine scalar_mass

   !> M between the felt_nodes of element E, components of node 1 first [force time^2/length].
   pure subroutine whole_mass(model, e, m)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e
      real(wp), intent(inout)      :: m(:, :) !! dimension x felt nodes rows and columns are set
      real(wp) :: scalar(max_nodes, max_nodes)
      integer  :: c, d, n

      if (is_beam(model, e)) then
         call structural_mass(model, e, m)
         return
      end if
      d = model%dimension
      n = size(own_nodes(model, e))
      call scalar_mass(model, e, scalar)
      m(:d*n, :d*n) = 0.0_wp
      do c = 1, d
         m(c:d*n:d, c:d*n:d) = scalar(:n, :n)
      end do
      call extend_stiffness(model, e, m)
   end subroutine whole_mass

   !> K = [k] - SHIFT [m] between the unknowns of the coupled_nodes of element E, components of node 1 first [force/length].
   pure subroutine coupled_dynamic_stiffness(model, e, shift, k)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e
      real(wp), intent(in)         :: shift   !! [1/time^2]
      real(wp), allocatable, intent(inout) :: k(:, :) !! as of coupled_stiffness; dimension x coupled nodes rows and columns are set
      real(wp), allocatable :: full(:, :)
      integer  :: n

      call coupled_stiffness(model, e, k)
      if (.not. abs(shift) > 0.0_wp) return
      allocate (full(max_felt_dofs, max_felt_dofs))
      call whole_mass(model, e, full)
      if (allocated(model%coupling%of_node)) call onto_unknowns(model, felt_nodes(model, e), full)
      n = model%dimension*size(unknown_nodes(model, felt_nodes(model, e)))
      k(:n, :n) = k(:n, :n) - shift*full(:n, :n)
   end subroutine coupled_dynamic_stiffness

   !> Mass between the two nodes of bar I, the same for every component [force time^2/length].
   pure function bar_mass(model, i) result(m)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: i
      real(wp) :: m(2, 2)

      m = model%bars(i)%mass/6.0_wp*reshape([2.0_wp, 1.0_wp, 1.0_wp, 2.0_wp], [2, 2])
      if (model%lumped) call lump(m)
   end function bar_mass

   !> [m] of bar I between the unknowns of the unknown_nodes of its nodes, as coupled_bar_stiffness.
   pure function coupled_bar_mass(model, i) result(m)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: i
      real(wp), allocatable :: m(:, :)
      real(wp) :: of_components(2*model%dimension, 2*model%dimension)
      integer  :: c, d

      d = model%dimension
      of_components = 0.0_wp
      do c = 1, d
         of_components(c::d, c::d) = bar_mass(model, i)
      end do
      m = between_unknowns(model, bar_nodes(model%bars(i)), of_components)
   end function coupled_bar_mass

   !> The nodes that MASS moves with: its own, and that of its rotations where there is one.
   pure function mass_nodes(model, mass) result(nodes)
      type(model_type), intent(in)      :: model
      type(point_mass_type), intent(in) :: mass
      integer, allocatable :: nodes(:)

      nodes = [mass%node]
      if (rotation_at(model, mass%node) > 0) nodes = [nodes, model%rotations(rotation_at(model, mass%node))%node]
   end function mass_nodes

   !> The inertia of MASS as the node of its rotations feels it, whose components are rotations times an arm: in space about x, y
   !! and z, in the plane about z alone [force time^2/length].
   pure function inertia_at_rotation(model, mass) result(m)
      type(model_type), intent(in)      :: model
      type(point_mass_type), intent(in) :: mass
      real(wp) :: m(model%dimension, model%dimension)

      associate (arm => model%rotations(rotation_at(model, mass%node))%arm)
         if (model%dimension == 3) then
            m = mass%inertia/arm**2
         else
            m = 0.0_wp
            m(1, 1) = mass%inertia(3, 3)/arm**2
         end if
      end associate
   end function inertia_at_rotation

   !> [m] of MASS between the unknowns of the unknown_nodes of its mass_nodes, components of the first of these first.
   pure function coupled_point_mass(model, mass) result(m)
      type(model_type), intent(in)      :: model
      type(point_mass_type), intent(in) :: mass
      real(wp), allocatable :: m(:, :)
      real(wp) :: of_components(2*model%dimension, 2*model%dimension)
      integer  :: c, d

      d = model%dimension
      of_components = 0.0_wp
      do c = 1, d
         of_components(c, c) = mass%mass
      end do
      associate (nodes => mass_nodes(model, mass))
         if (size(nodes) == 2) of_components(d + 1:, d + 1:) = inertia_at_rotation(model, mass)
         m = between_unknowns(model, nodes, of_components)
      end associate
   end function coupled_point_mass

end module mass_elements
