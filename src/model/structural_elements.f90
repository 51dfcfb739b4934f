!> Shells and beams of a model: their matrices between the unknowns of their nodes and of the rotations there. The components of a node
!! of rotations are rotations times an arm; in the plane the first one alone counts, about z.
module structural_elements
   use beam_element, only: beam_line_load, beam_mass, beam_nodal_forces, beam_stiffness, beam_thermal_load
   use elasticity, only: max_stresses
   use kinds, only: wp
   use model_data, only: corners_of, is_beam, model_type, temperature_type
   use shell_element, only: shell_products, shell_stiffness, shell_stresses, shell_thermal_forces
   use temperatures, only: element_rise, element_slope
   implicit none
   private

   public :: structural_stiffness, structural_stress, structural_thermal_forces, structural_weight, structural_mass, shell_mass, &
             nodal_values, beam_ends, onto_own

   integer, parameter :: most = 8 ! own nodes of an element: corners and their rotations

contains

   !> The nodes of beam E [length].
   pure function beam_ends(model, e) result(x)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e
      real(wp) :: x(3, 2)

      x = model%x(:, model%element_nodes(:2, e))
   end function beam_ends

   !> Where the unknowns of the own nodes of element E, components of node 1 first, stand among its nodal values (3, 2 corners) as
   !! shell_element and beam_element have them, and what a unit of them is there.
   pure subroutine find_values(model, e, n, at, unit)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e
      integer, intent(out)         :: n          !! unknowns
      integer, intent(out)         :: at(3*most) !! 0: nowhere
      real(wp), intent(out)        :: unit(3*most)
      integer :: c, d, i, m

      d = model%dimension
      associate (nodes => corners_of(model, e))
         m = size(nodes)
         n = 2*m*d
         do i = 1, m
            associate (arm => model%rotations(model%rotation_of(nodes(i)))%arm)
               do c = 1, d
                  at(d*(i - 1) + c) = 3*(i - 1) + c
                  unit(d*(i - 1) + c) = 1.0_wp
                  at(d*(m + i - 1) + c) = 3*(m + i - 1) + c
                  if (d == 2) at(d*(m + i - 1) + c) = merge(3*(m + i), 0, c == 1)
                  unit(d*(m + i - 1) + c) = 1.0_wp/arm
               end do
            end associate
         end do
      end associate
   end subroutine find_values

   !> K between the unknowns from FULL between the nodal values of element E.
   pure subroutine between_own(model, e, full, k)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e
      real(wp), intent(in)         :: full(:, :)
      real(wp), intent(inout)      :: k(:, :) !! set here, as many rows and columns as there are unknowns
      real(wp) :: unit(3*most)
      integer  :: at(3*most), a, b, n

      call find_values(model, e, n, at, unit)
      k(:n, :n) = 0.0_wp
      do b = 1, n
         if (at(b) == 0) cycle
         do a = 1, n
            if (at(a) > 0) k(a, b) = full(at(a), at(b))*unit(a)*unit(b)
         end do
      end do
   end subroutine between_own

   !> Forces F on the own nodes from those on the nodal values.
   pure subroutine onto_own(model, e, nodal, f)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e
      real(wp), intent(in)         :: nodal(:, :) !! (3, 2 corners) [force], [force length]
      real(wp), intent(inout)      :: f(:, :)     !! (dimension, own nodes) [force], set here
      real(wp) :: unit(3*most)
      integer  :: at(3*most), a, d, n

      d = model%dimension
      call find_values(model, e, n, at, unit)
      do a = 1, n
         f(modulo(a - 1, d) + 1, (a - 1)/d + 1) = 0.0_wp
         if (at(a) > 0) f(modulo(a - 1, d) + 1, (a - 1)/d + 1) = unit(a)*nodal(modulo(at(a) - 1, 3) + 1, (at(a) - 1)/3 + 1)
      end do
   end subroutine onto_own

   !> The nodal values of element E where its own nodes move by U.
   pure function nodal_values(model, e, u) result(values)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e
      real(wp), intent(in)         :: u(:, :)     !! (dimension, own nodes) [length]
      real(wp), allocatable :: values(:, :)       !! (3, 2 corners) [length], [rad]
      real(wp) :: unit(3*most)
      integer  :: at(3*most), a, d, n

      d = model%dimension
      allocate (values(3, size(u, 2)), source=0.0_wp)
      call find_values(model, e, n, at, unit)
      do a = 1, n
         if (at(a) > 0) values(modulo(at(a) - 1, 3) + 1, (at(a) - 1)/3 + 1) = unit(a)*u(modulo(a - 1, d) + 1, (a - 1)/d + 1)
      end do
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
   !! centre, where its own nodes move by U.
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

   !> F: what element E at this TEMPERATURE pushes its own nodes with.
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

   !> Forces F on the own nodes of element E under a body force B per mass.
   pure subroutine structural_weight(model, e, b, f)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e
      real(wp), intent(in)         :: b(:)        !! (dimension) [length/time^2]
      real(wp), intent(inout)      :: f(:, :)     !! (dimension, own nodes) [force], set here
      real(wp) :: nodal(3, most), force(3), m(4, 4), q(6, 2)
      integer  :: i, n

      force = 0.0_wp
      force(:size(b)) = b
      nodal = 0.0_wp
      if (is_beam(model, e)) then
         associate (law => model%structural%beams(model%structural%place(e)))
            q = 0.0_wp
            q(:3, :) = spread((law%rho*law%area + law%extra_mass)*force, 2, 2)
            nodal(:, :4) = beam_nodal_forces(law, beam_ends(model, e), beam_line_load(law, beam_ends(model, e), q, 0.0_wp, 1.0_wp))
         end associate
      else
         n = size(corners_of(model, e))
         call shell_mass(model, e, .false., m)
         do i = 1, n
            nodal(:, i) = sum(m(:n, i))*force
         end do
      end if
      call onto_own(model, e, nodal, f)
   end subroutine structural_weight

   !> Mass between the corners of shell E, the same for every component, or that between its rotations, OF_ROTATIONS: the rotary inertia
   !! of the thickness, taken for the drilling rotation too [force time^2/length], by the arms.
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
