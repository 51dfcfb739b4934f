!> Rectangular, cylindrical and spherical coordinate systems: position of a point, and directions at it.
!! Conventions of NASTRAN: z from A to B, x in the half-plane of C, y across both; cylindrical coordinates are r, theta (degrees
!! from x), z, spherical ones r, theta (degrees from z), phi (degrees from x about z).
module coordinate_systems
   use kinds, only: wp
   use numbers, only: cross, identity
   use tolerances, only: on_axis, parallel_axes
   implicit none
   private

   public :: make_system, position_in, directions_at

   integer, parameter, public :: rectangular = 1, cylindrical = 2, spherical = 3

   real(wp), parameter :: degree = acos(-1.0_wp)/180.0_wp

   type, public :: coordinate_system
      integer  :: id = 0
      integer  :: kind = rectangular
      real(wp) :: origin(3) = 0.0_wp     !! in global axes [length]
      real(wp) :: axes(3, 3) = identity !! columns: x, y, z in global axes, unit
   end type coordinate_system

contains

   !> The system with origin A, z axis through B, and C in its x-z plane. OK is false where the three points are collinear.
   pure subroutine make_system(id, kind, a, b, c, system, ok)
      integer, intent(in)                  :: id, kind
      real(wp), intent(in)                 :: a(3), b(3), c(3) !! in global axes [length]
      type(coordinate_system), intent(out) :: system
      logical, intent(out)                 :: ok
      real(wp) :: x(3), z(3)

      z = b - a
      x = c - a
      ok = norm2(z) > 0.0_wp .and. norm2(x) > 0.0_wp
      if (.not. ok) return
      z = z/norm2(z)
      x = x/norm2(x)
      x = x - dot_product(x, z)*z
      ok = norm2(x) > parallel_axes
      if (.not. ok) return
      x = x/norm2(x)
      system = coordinate_system(id, kind, a, reshape([x, cross(z, x), z], [3, 3]))
   end subroutine make_system

   !> Position of the point with these COORDINATES in SYSTEM, in global axes [length].
   pure function position_in(system, coordinates) result(x)
      type(coordinate_system), intent(in) :: system
      real(wp), intent(in)                :: coordinates(3) !! x, y, z; r, theta, z; or r, theta, phi [length, degrees]
      real(wp) :: x(3), local(3)

      associate (r => coordinates(1), theta => coordinates(2), phi => coordinates(3))
         select case (system%kind)
         case (cylindrical)
            local = [r*cosine(theta), r*sine(theta), coordinates(3)]
         case (spherical)
            local = [r*sine(theta)*cosine(phi), r*sine(theta)*sine(phi), r*cosine(theta)]
         case default
            local = coordinates
         end select
      end associate
      x = system%origin + matmul(system%axes, local)
   end function position_in

   !> Directions of SYSTEM at the point X in global axes, columns: x, y, z; r, theta, z; or r, theta, phi, unit, in global axes.
   !! OK is false on the axis of a cylindrical or spherical system, where r and theta are undefined.
   pure subroutine directions_at(system, x, directions, ok)
      type(coordinate_system), intent(in) :: system
      real(wp), intent(in)                :: x(3) !! [length]
      real(wp), intent(out)               :: directions(3, 3)
      logical, intent(out)                :: ok
      real(wp) :: along(3), local(3), rho, turn(3, 3), r

      ok = .true.
      directions = system%axes
      if (system%kind == rectangular) return
      local = matmul(x - system%origin, system%axes)
      rho = norm2(local(:2))
      r = norm2(local)
      ok = rho > on_axis*max(r, norm2(x), norm2(system%origin))
      if (.not. ok) return
      along = [local(:2)/rho, 0.0_wp] ! r of cylindrical coordinates
      turn = reshape([along, -along(2), along(1), 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp], [3, 3])
      if (system%kind == spherical) turn = reshape([local/r, along(:2)*local(3)/r, -rho/r, turn(:, 2)], [3, 3])
      directions = matmul(system%axes, turn)
   end subroutine directions_at

   !> Cosine of an angle in degrees, exact at multiples of 90.
   elemental real(wp) function cosine(angle)
      real(wp), intent(in) :: angle !! [degrees]

      cosine = sine(90.0_wp - abs(angle))
   end function cosine

   !> Sine of an angle in degrees, exact at multiples of 90.
   elemental real(wp) function sine(angle)
      real(wp), intent(in) :: angle !! [degrees]
      real(wp) :: acute, rest

      rest = modulo(angle, 360.0_wp)
      acute = min(modulo(rest, 180.0_wp), 180.0_wp - modulo(rest, 180.0_wp))
      sine = sin(acute*degree)
      if (acute >= 90.0_wp) sine = 1.0_wp
      if (rest > 180.0_wp) sine = -sine
   end function sine

end module coordinate_systems
