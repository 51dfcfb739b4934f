!> What shell elements are made of and where they lie. An element is flat: its corners are projected onto its mean plane, and what a
!! corner has from there is a rigid lever, as is an offset of the plate (ZOFFS).
module shell_geometry
   use element_kinds, only: kind_quad4, kind_tria3, max_nodes
   use kinds, only: wp
   use numbers, only: cross
   use shape_functions, only: shape_values
   implicit none
   private

   public :: corner_kind, flat_coordinates, shell_frame_of, thickness_at

   !> What a shell element is made of.
   type, public :: shell_law
      real(wp) :: d(3, 3) = 0.0_wp            !! plane stress of the membrane: xx, yy, xy [pressure]
      real(wp) :: bending(3, 3) = 0.0_wp      !! that of bending, times 12 I/T**3 [pressure]
      real(wp) :: shear = 0.0_wp              !! G TS/T of transverse shear; 0: rigid in it [pressure]
      real(wp) :: nu = 0.0_wp                 !! Poisson's ratio of the membrane [-]
      real(wp) :: thickness(4) = 0.0_wp       !! at the corners [length]
      real(wp) :: offset = 0.0_wp             !! of the mean plane from the nodes, along the normal (ZOFFS) [length]
      real(wp) :: expansion = 0.0_wp          !! alpha [1/temperature]
   end type shell_law

   !> Where an element lies.
   type, public :: shell_frame
      integer  :: n = 0                       !! corners
      real(wp) :: axes(3, 3) = 0.0_wp         !! columns: two directions in the plane, the normal, right-handed with the corners
      real(wp) :: x(2, 4) = 0.0_wp            !! corners in the plane [length]
      real(wp) :: lever(4) = 0.0_wp           !! of the plane above the nodes, along the normal, with the offset [length]
   end type shell_frame

contains

   !> The frame of an element with corners X and an OFFSET. The normal is that of the diagonals, of a triangle that of its plane.
   pure type(shell_frame) function shell_frame_of(x, offset) result(frame)
      real(wp), intent(in) :: x(:, :)         !! (3, corners) [length]
      real(wp), intent(in) :: offset          !! [length]
      real(wp) :: from_centre(3), along(3), centre(3), normal(3)
      integer  :: i, n

      n = size(x, 2)
      frame%n = n
      centre = sum(x, dim=2)/n
      if (n == 4) then
         along = x(:, 2) + x(:, 3) - x(:, 1) - x(:, 4)
         normal = cross(x(:, 3) - x(:, 1), x(:, 4) - x(:, 2))
      else
         along = x(:, 2) - x(:, 1)
         normal = cross(along, x(:, 3) - x(:, 1))
      end if
      normal = normal/max(norm2(normal), tiny(1.0_wp))
      along = along - dot_product(along, normal)*normal
      along = along/max(norm2(along), tiny(1.0_wp))
      frame%axes(:, 1) = along
      frame%axes(:, 2) = cross(normal, along)
      frame%axes(:, 3) = normal
      do i = 1, n
         from_centre = x(:, i) - centre
         frame%x(:, i) = matmul(from_centre, frame%axes(:, :2))
         frame%lever(i) = offset
         if (n == 4) frame%lever(i) = offset - dot_product(from_centre, normal)
      end do
   end function shell_frame_of

   !> The corners X of an element in its plane.
   pure function flat_coordinates(x) result(flat)
      real(wp), intent(in) :: x(:, :)         !! (3, corners) [length]
      real(wp) :: flat(2, size(x, 2))
      type(shell_frame) :: frame

      frame = shell_frame_of(x, 0.0_wp)
      flat = frame%x(:, :size(x, 2))
   end function flat_coordinates

   pure integer function corner_kind(n)
      integer, intent(in) :: n

      corner_kind = merge(kind_quad4, kind_tria3, n == 4)
   end function corner_kind

   pure real(wp) function thickness_at(law, frame, point) result(t)
      type(shell_law), intent(in)   :: law
      type(shell_frame), intent(in) :: frame
      real(wp), intent(in)          :: point(3)
      real(wp) :: n(max_nodes)

      call shape_values(corner_kind(frame%n), point, n)
      t = dot_product(n(:frame%n), law%thickness(:frame%n))
   end function thickness_at

end module shell_geometry
