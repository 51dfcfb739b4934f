!> Stiffness, mass and nodal forces of shells and beams in terms of the unknowns of nodes and rotation nodes.
!! The components of a node of rotations are rotations times an arm; in the plane only the first one, about z, is used.
module structural_elements
   use beam_element, only: beam_mass, beam_nodal_forces, beam_stiffness, beam_thermal_load
   use elasticity, only: max_stresses
   use kinds, only: wp
   use model_data, only: corners_of, is_beam, model_type, temperature_type
   use shell_element, only: shell_forces, shell_products, shell_stiffness, shell_stresses, shell_thermal_forces
   use temperatures, only: element_rise, element_slope
   implicit none
   private

   public :: structural_stiffness, structural_stress, section_forces, structural_thermal_forces, structural_mass, &
             shell_mass, nodal_values, beam_ends, onto_own

   integer, parameter :: most = 8 ! own nodes of an element: corners and their rotations

contains

   !> The coordinates of the end nodes of beam E [length].
   pure function beam_ends(model, e) result(x)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e
      real(wp) :: x(3, 2)

      x = model%x(:, model%element_nodes(:2, e))
   end function beam_ends

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

   !> [k] of element E between its own nodes, components of node 1 first [force/length].
   pure subroutine structural_stiffness(model, e, k)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e
      real(wp), intent(inout)      :: k(:, :)     !! dimension x own nodes rows and columns are set
      real(wp) :: full(3*most, 3*most)

      associate (place => model%structural%place(e))
         if (is_beam(model, e)) then
            full(:12, :12) = beam_stiffness(model%structural%beams(place), beam_ends(model, e))
         else
            call shell_stiffness(model%structural%shells(place), model%x(:, corners_of(model, e)), full)
         end if
      end associate
      call between_own(model, e, full, k)
   end subroutine structural_stiffness

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

   !> Forces and moments per length of shell E, as in shell_forces, under displacements U of its own nodes.
   pure subroutine section_forces(model, e, u, temperature, along, force)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e
      real(wp), intent(in)         :: u(:, :)     !! (3, own nodes) [length]
      type(temperature_type), intent(in) :: temperature
      real(wp), intent(in)         :: along(3)    !! unit, in the plane of the shell
      real(wp), intent(out)        :: force(:, :) !! (8, corners + 1) [force/length], moments [force]

      call shell_forces(model%structural%shells(model%structural%place(e)), model%x(:, corners_of(model, e)), &
                        nodal_values(model, e, u), element_rise(model, e, temperature), element_slope(model, e, temperature), &
                        along, force)
   end subroutine section_forces

   !> Thermal nodal forces F of element E at its own nodes at this TEMPERATURE.
   pure subroutine structural_thermal_forces(model, e, temperature, f)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e
      type(temperature_type), intent(in) :: temperature
      real(wp), intent(inout)      :: f(:, :)     !! (dimension, own nodes) [force], set here
      real(wp) :: nodal(3, most)

      associate (rise => element_rise(model, e, temperature), place => model%structural%place(e), nodes => corners_of(model, e))
         if (is_beam(model, e)) then
            nodal(:, :4) = beam_nodal_forces(model%structural%beams(place), beam_ends(model, e), &
                                             beam_thermal_load(model%structural%beams(place), sum(rise)/2))
         else
            call shell_thermal_forces(model%structural%shells(place), model%x(:, nodes), rise, &
                                      element_slope(model, e, temperature), nodal)
         end if
      end associate
      call onto_own(model, e, nodal, f)
   end subroutine structural_thermal_forces

   !> Mass between the corners of shell E, the same for every component. With OF_ROTATIONS the mass between its rotations, divided by
   !! the arms [force time^2/length]: the rotary inertia of the thickness, used for the drilling rotation too.
   pure subroutine shell_mass(model, e, of_rotations, m)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e
      logical, intent(in)          :: of_rotations
      real(wp), intent(inout)      :: m(:, :)     !! (corners, corners), set here
      integer :: i, n

      associate (nodes => corners_of(model, e), law => model%structural%shells(model%structural%place(e)), &
                 property => model%properties(model%element_property(e)))
         n = size(nodes)
         if (.not. of_rotations) then
            call shell_products(model%x(:, nodes), property%rho*law%thickness(:n) + property%extra_mass, m)
            return
         end if
         call shell_products(model%x(:, nodes), property%rho*law%thickness(:n)**3/12.0_wp, m)
         do i = 1, n
            associate (arm => model%rotations(model%rotation_of(nodes(i)))%arm)
               m(i, :n) = m(i, :n)/arm
               m(:n, i) = m(:n, i)/arm
            end associate
         end do
      end associate
   end subroutine shell_mass

   !> [m] of beam E between its own nodes, components of node 1 first [force time^2/length].
   pure subroutine structural_mass(model, e, m)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e
      real(wp), intent(inout)      :: m(:, :)     !! dimension x own nodes rows and columns are set
      real(wp) :: full(12, 12)

      full = beam_mass(model%structural%beams(model%structural%place(e)), beam_ends(model, e), model%lumped)
      call between_own(model, e, full, m)
   end subroutine structural_mass

end module structural_elements
