!> A face of a joint and the plane that it is seen in: the plane through its centre at right angles to its normal there. What stands
!! opposite is projected on that plane, along the normal; in space and, as a line, in the plane.
module face_frames
   use element_kinds, only: max_nodes, max_side_nodes, side_kind, centre_point
   use kinds, only: wp
   use shape_functions, only: shape_derivatives, shape_values
   use vector_product, only: cross
   implicit none
   private

   public :: make_frame, in_frame, find_point, map_point, surface_vector

   !> Axes of a face: columns s and t in its plane, of an edge s along it, and its normal h out of the body.
   type, public :: face_frame
      real(wp) :: centre(3) = 0.0_wp
      real(wp) :: axes(3, 3) = 0.0_wp
   end type face_frame

   !> A face as it is seen in a frame.
   type, public :: seen_face
      logical  :: is_edge = .false.
      integer  :: kind = 0                    !! of its shape functions, from side_kind
      integer  :: n = 0                       !! nodes
      real(wp) :: x(3, max_side_nodes) = 0.0_wp !! s, t and h of each [length]
   end type seen_face

   integer, parameter  :: most_steps = 30     ! of Newton
   real(wp), parameter :: still = 1.0e-14_wp  ! a step in local coordinates below which there is no further one

contains

   !> The frame of a face with its nodes at X; no axes where it has no area.
   pure subroutine make_frame(dimension, x, frame)
      integer, intent(in)           :: dimension !! of the model: 2, edges, or 3, faces
      real(wp), intent(in)          :: x(:, :)   !! (3, nodes) [length]
      type(face_frame), intent(out) :: frame
      real(wp) :: n(max_nodes), dn(3, max_nodes), a(3), b(3), normal(3)
      integer  :: kind, nodes

      nodes = size(x, 2)
      kind = side_kind(dimension, nodes)
      call shape_values(kind, centre_point(:, kind), n)
      call shape_derivatives(kind, centre_point(:, kind), dn)
      frame%centre = matmul(x, n(:nodes))
      a = matmul(x, dn(1, :nodes))
      b = [0.0_wp, 0.0_wp, 1.0_wp]               ! the body on the left of an edge, its right-hand normal
      if (dimension == 3) b = matmul(x, dn(2, :nodes))
      normal = cross(a, b)
      if (norm2(normal) <= 0.0_wp) return
      frame%axes(:, 1) = a/norm2(a)
      frame%axes(:, 3) = normal/norm2(normal)
      frame%axes(:, 2) = cross(frame%axes(:, 3), frame%axes(:, 1))
   end subroutine make_frame

   !> The face with its nodes at X as it is seen in FRAME.
   pure function in_frame(dimension, x, frame) result(face)
      integer, intent(in)          :: dimension
      real(wp), intent(in)         :: x(:, :) !! (3, nodes) [length]
      type(face_frame), intent(in) :: frame
      type(seen_face) :: face
      integer :: k

      face%is_edge = dimension == 2
      face%n = size(x, 2)
      face%kind = side_kind(dimension, face%n)
      do k = 1, face%n
         face%x(:, k) = matmul(x(:, k) - frame%centre, frame%axes)
      end do
   end function in_frame

   !> Local coordinates POINT of the place of FACE that is seen at PLACE, by Newton's method.
   pure subroutine find_point(face, place, point, is_found)
      type(seen_face), intent(in) :: face
      real(wp), intent(in)        :: place(2)  !! s and t [length]
      real(wp), intent(out)       :: point(3)
      logical, intent(out)        :: is_found
      real(wp) :: n(max_nodes), dn(3, max_nodes), miss(2), j(2, 2), determinant, step(2)
      integer  :: i

      point = centre_point(:, face%kind)
      is_found = .false.
      do i = 1, most_steps
         call shape_values(face%kind, point, n)
         call shape_derivatives(face%kind, point, dn)
         miss = place - matmul(face%x(:2, :face%n), n(:face%n))
         j(:, 1) = matmul(face%x(:2, :face%n), dn(1, :face%n))
         j(:, 2) = [0.0_wp, 1.0_wp]
         if (.not. face%is_edge) j(:, 2) = matmul(face%x(:2, :face%n), dn(2, :face%n))
         determinant = j(1, 1)*j(2, 2) - j(1, 2)*j(2, 1)
         if (abs(determinant) <= 0.0_wp) return
         step = [j(2, 2)*miss(1) - j(1, 2)*miss(2), j(1, 1)*miss(2) - j(2, 1)*miss(1)]/determinant
         if (face%is_edge) step(2) = 0.0_wp
         point(:2) = point(:2) + step
         is_found = maxval(abs(step)) <= still*(1.0_wp + maxval(abs(point)))
         if (is_found .or. .not. maxval(abs(point)) < 1.0e3_wp) return
      end do
      is_found = maxval(abs(step)) <= 1.0e-9_wp ! it turns about the point, by rounding
   end subroutine find_point

   !> What FACE has at a POINT of it: its shape functions N, and where it is.
   pure subroutine map_point(face, point, n, x)
      type(seen_face), intent(in) :: face
      real(wp), intent(in)        :: point(3)
      real(wp), intent(out)       :: n(max_nodes)
      real(wp), intent(out)       :: x(3)       !! s, t, h [length]

      call shape_values(face%kind, point, n)
      x = matmul(face%x(:, :face%n), n(:face%n))
   end subroutine map_point

   !> The outward vector of the surface of FACE at a POINT, in the frame: as long as the area, of an edge the length, that is seen
   !! as one; 0 where the face is seen from the side there.
   pure function surface_vector(face, point) result(vector)
      type(seen_face), intent(in) :: face
      real(wp), intent(in)        :: point(3)
      real(wp) :: vector(3)
      real(wp) :: dn(3, max_nodes), a(3), b(3)

      call shape_derivatives(face%kind, point, dn)
      a = matmul(face%x(:, :face%n), dn(1, :face%n))
      b = [0.0_wp, 1.0_wp, 0.0_wp]
      if (.not. face%is_edge) b = matmul(face%x(:, :face%n), dn(2, :face%n))
      vector = cross(a, b)
      if (abs(vector(3)) <= 1.0e-6_wp*norm2(vector)) then
         vector = 0.0_wp
      else
         vector = vector/abs(vector(3))
      end if
   end function surface_vector

end module face_frames
