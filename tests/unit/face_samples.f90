!> Sides of elements of every kind, straight and curved, for the tests of joints between faces.
module face_samples
   use element_kinds, only: side_kind, node_point
   use kinds, only: wp
   implicit none
   private

   public :: n_samples, sample_dimension, sample_nodes, flat_face, bent_face

   integer, parameter :: n_samples = 6
   integer, parameter :: sample_dimension(n_samples) = [2, 2, 3, 3, 3, 3]
   integer, parameter :: sample_nodes(n_samples) = [2, 3, 3, 4, 6, 8]

contains

   !> Nodes of side I as in local coordinates, in the x-z plane turned about y: edges along x with the body above, faces looking down.
   pure function flat_face(i) result(x)
      integer, intent(in) :: i
      real(wp) :: x(3, sample_nodes(i))

      x = node_point(:, :sample_nodes(i), side_kind(sample_dimension(i), sample_nodes(i)))
   end function flat_face

   !> The same side distorted, moved away and, of second order, curved.
   pure function bent_face(i) result(x)
      integer, intent(in) :: i
      real(wp) :: x(3, sample_nodes(i)), a(3, 3)
      integer  :: k

      x = flat_face(i)
      a = reshape([2.0_wp, 0.5_wp, -0.3_wp, -0.4_wp, 1.5_wp, 0.6_wp, 0.1_wp, 0.2_wp, 1.0_wp], [3, 3])
      do k = 1, sample_nodes(i)
         x(3, k) = 0.05_wp*x(1, k)**2 + 0.08_wp*x(1, k)*x(2, k) - 0.06_wp*x(2, k)**2
         if (sample_nodes(i) > sample_dimension(i) .and. k > 2) x(:2, k) = x(:2, k) + 0.04_wp*[sin(3.0_wp*k), cos(2.0_wp*k)]
         x(:, k) = matmul(a, x(:, k)) + [30.0_wp, -7.0_wp, 11.0_wp]
         if (sample_dimension(i) == 2) x(3, k) = 0.0_wp
      end do
   end function bent_face

end module face_samples
