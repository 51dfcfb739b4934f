!> Shells and beams in terms of the unknowns of nodes and rotation nodes: the transformation of their matrices, forces and displacements,
!! the stresses and the mass of shells.
!! The components of a node of rotations are rotations times an arm; in the plane only the first one, about z, is used.
module structural_elements
   use kinds, only: wp
   use model_data, only: corners_of, model_type, temperature_type
   use shell_element, only: shell_products, shell_stresses
   use temperatures, only: element_rise, element_slope
   implicit none
   private

   public :: structural_stress, shell_mass, nodal_values, between_own, onto_own

   integer, parameter, public :: most_own = 8 !! own nodes of an element: corners and their rotations

contains

   !> T: the nodal values (3, 2 corners) of element E, as defined in shell_element and beam_element, due to a unit of each unknown
   !! of its own nodes (one column each), components of node 1 first.
   pure function own_to_values(model, e) result(t)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e
      real(wp), allocatable :: t(:, :)            !! (6 corners, 2 dimension corners)
      integer :: c, d, i, m

      d = model%dimension
      associate (nodes => corners_of(model, e))
         m = size(nodes)
         allocate (t(6*m, 2*d*m), source=0.0_wp)
         do i = 1, m
            associate (arm => model%rotations(model%rotation_of(nodes(i)))%arm)
               do c = 1, d
                  t(3*(i - 1) + c, d*(i - 1) + c) = 1.0_wp
                  if (d == 3) t(3*(m + i - 1) + c, d*(m + i - 1) + c) = 1.0_wp/arm
               end do
               if (d == 2) t(3*(m + i), d*(m + i - 1) + 1) = 1.0_wp/arm
            end associate
         end do
      end associate
   end function own_to_values

   !> Transform FULL, a matrix between the nodal values of element E, to K between its unknowns.
   pure subroutine between_own(model, e, full, k)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e
      real(wp), intent(in)         :: full(:, :)
      real(wp), intent(inout)      :: k(:, :) !! set here; one row and column per unknown

      associate (t => own_to_values(model, e))
         k(:size(t, 2), :size(t, 2)) = matmul(matmul(transpose(t), full(:size(t, 1), :size(t, 1))), t)
      end associate
   end subroutine between_own

   !> Transform forces on the nodal values to forces F on the own nodes.
   pure subroutine onto_own(model, e, nodal, f)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e
      real(wp), intent(in)         :: nodal(:, :) !! (3, 2 corners) [force], [force length]
      real(wp), intent(inout)      :: f(:, :)     !! (dimension, own nodes) [force], set here

      associate (t => own_to_values(model, e), d => model%dimension)
         f(:d, :size(t, 2)/d) = reshape(matmul(reshape(nodal, [size(t, 1)]), t), [d, size(t, 2)/d])
      end associate
   end subroutine onto_own

   !> The nodal values (3, 2 corners) of element E for displacements U of its own nodes [length], [rad].
   pure function nodal_values(model, e, u) result(values)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e
      real(wp), intent(in)         :: u(:, :)     !! (dimension, own nodes) [length]
      real(wp), allocatable :: values(:, :)

      associate (t => own_to_values(model, e))
         values = reshape(matmul(t, reshape(u, [size(u)])), [3, size(u, 2)])
      end associate
   end function nodal_values

   !> Stresses of shell E in global axes, (xx, yy, zz, xy, yz, zx), at the heights Z above its mean plane, at its corners and then at its
   !! centre, under displacements U of its own nodes.
   pure subroutine structural_stress(model, e, u, temperature, z, stress)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e
      real(wp), intent(in)         :: u(:, :)     !! (3, own nodes) [length]
      type(temperature_type), intent(in) :: temperature
      real(wp), intent(in)         :: z(:)        !! [length]
      real(wp), intent(out)        :: stress(:, :, :) !! (6, corners + 1, heights) [pressure]

      call shell_stresses(model%structural%shells(model%structural%place(e)), model%x(:, corners_of(model, e)), &
                          nodal_values(model, e, u), element_rise(model, e, temperature), &
                          element_slope(model, e, temperature), z, stress)
   end subroutine structural_stress

   !> Mass between the own nodes of shell E, the same for every component: between its corners, and between its rotations the rotary
   !! inertia of the thickness, divided by the arms and used for the drilling rotation too [force time^2/length].
   pure subroutine shell_mass(model, e, m)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e
      real(wp), intent(out)        :: m(:, :)     !! (own nodes, own nodes)
      integer :: i, n

      m = 0.0_wp
      associate (nodes => corners_of(model, e), law => model%structural%shells(model%structural%place(e)), &
                 property => model%properties(model%element_property(e)))
         n = size(nodes)
         call shell_products(model%x(:, nodes), property%rho*law%thickness(:n) + property%extra_mass, m(:n, :n))
         call shell_products(model%x(:, nodes), property%rho*law%thickness(:n)**3/12.0_wp, m(n + 1:, n + 1:))
         do i = 1, n
            associate (arm => model%rotations(model%rotation_of(nodes(i)))%arm)
               m(n + i, n + 1:) = m(n + i, n + 1:)/arm
               m(n + 1:, n + i) = m(n + 1:, n + i)/arm
            end associate
         end do
      end associate
   end subroutine shell_mass

end module structural_elements
