!> The rigid-body motion that fits the displacements of some points best: the constraint of RBE3 and of shells tied to faces.
module rigid_fit
   use blas_lapack, only: dpstrf, dtrsm
   use kinds, only: wp
   use numbers, only: by_rotation
   use tolerances, only: determined_motion, zero_pivot_of_fit
   implicit none
   private

   public :: mean_motion

contains

   !> [T] of RBE3, {u, theta} = sum of T(:, :, i) {c_i}: the rigid-body motion, displacement and rotation at the reference point,
   !! that fits the measured displacements in the sense of least squares. Point i lies at the arm R(:, i) from the reference point;
   !! c_i are its displacements along the directions AXES(:, 1 to 3, i), of which those USED count, with WEIGHT(i).
   !!    sum of w G^T (G {u, theta} - c) = 0,  G = directions^T [1 W]
   !! Six directions are given where rotations of the points are measured too; they count with the square of the mean arm, as in NASTRAN.
   !! A component that this equation does not determine is not DETERMINED, and its row is zero: for collinear points the rotation
   !! about their line.
   pure subroutine mean_motion(r, axes, used, weight, t, determined)
      real(wp), intent(in)  :: r(:, :)       !! (3, points) [length]
      real(wp), intent(in)  :: axes(:, :, :) !! (3, 3, points), unit
      logical, intent(in)   :: used(:, :)    !! (3 or 6, points)
      real(wp), intent(in)  :: weight(:)     !! > 0
      real(wp), intent(out) :: t(:, :, :)    !! (6, 3 or 6, points) [-], rotations [1/length]
      logical, intent(out)  :: determined(6)
      real(wp) :: g(6, size(used, 1), size(weight)), a(6, 6), inverse(6, 6), arm, extent, total
      integer  :: c, i

      extent = sqrt(sum(r**2)/size(weight))
      if (extent <= 0.0_wp) extent = 1.0_wp
      arm = sum(norm2(r, dim=1))/size(weight)
      if (arm <= 0.0_wp) arm = 1.0_wp
      total = sum(weight)
      a = 0.0_wp
      g = 0.0_wp
      do i = 1, size(weight)
         g(:3, :3, i) = axes(:, :, i)
         if (size(g, 2) == 6) g(4:, 4:, i) = arm/extent*axes(:, :, i)
         g(4:, :3, i) = matmul(transpose(by_rotation(r(:, i)/extent)), axes(:, :, i)) ! rotations times the size: one unit
         do c = 1, size(used, 1)
            if (.not. used(c, i)) g(:, c, i) = 0.0_wp
         end do
         a = a + weight(i)/total*matmul(g(:, :, i), transpose(g(:, :, i)))
      end do
      call invert_where_determined(a, inverse, determined)
      do i = 1, size(weight)
         t(:, :, i) = weight(i)/total*matmul(inverse, g(:, :, i))
         t(4:, :, i) = t(4:, :, i)/extent
         if (size(g, 2) == 6) t(:, 4:, i) = t(:, 4:, i)*arm
      end do
   end subroutine mean_motion

   !> Rows of the INVERSE of A, symmetric and positive semidefinite, for the components of x that A x = b determines; the other rows
   !! are zero. Row j is the solution y of A y = e_j where it exists. The factor takes the largest remaining pivot.
   pure subroutine invert_where_determined(a, inverse, determined)
      real(wp), intent(in)  :: a(6, 6)
      real(wp), intent(out) :: inverse(6, 6)
      logical, intent(out)  :: determined(6)
      real(wp) :: factor(6, 6), of_pivots(6, 6), residual(6), work(12)
      integer  :: info, j, order(6), rank

      factor = a
      call dpstrf('L', 6, factor, 6, order, rank, zero_pivot_of_fit*maxval(abs(a)), work, info)
      of_pivots = 0.0_wp
      do j = 1, rank
         of_pivots(j, j) = 1.0_wp
      end do
      call dtrsm('L', 'L', 'N', 'N', rank, rank, 1.0_wp, factor, 6, of_pivots, 6)
      call dtrsm('L', 'L', 'T', 'N', rank, rank, 1.0_wp, factor, 6, of_pivots, 6)
      inverse = 0.0_wp
      inverse(order(:rank), order(:rank)) = of_pivots(:rank, :rank)
      determined = .false.
      determined(order(:rank)) = .true.
      do j = 1, 6
         residual = matmul(a, inverse(j, :))
         residual(j) = residual(j) - 1.0_wp
         determined(j) = determined(j) .and. maxval(abs(residual)) <= determined_motion
         if (.not. determined(j)) inverse(j, :) = 0.0_wp
      end do
   end subroutine invert_where_determined

end module rigid_fit
