!> What a rigid body does: how its points move with displacement and rotation of one of them, and the rigid motion that comes nearest
!! to given displacements of points.
module rigid_motion
   use kinds, only: wp
   implicit none
   private

   public :: by_rotation, mean_motion

contains

   !> [W] of a point at the ARM from the one that turns: its displacement is {u} + [W] {theta}, theta x arm.
   pure function by_rotation(arm) result(w)
      real(wp), intent(in) :: arm(3) !! [length]
      real(wp) :: w(3, 3)

      w = reshape([0.0_wp, -arm(3), arm(2), arm(3), 0.0_wp, -arm(1), -arm(2), arm(1), 0.0_wp], [3, 3])
   end function by_rotation

   !> [T] of RBE3, {u, theta} = sum of T(:, :, i) {c_i}: the rigid motion, displacement and rotation at the reference point, that
   !! makes the sum of the squares of the differences to the measured displacements least. Point i lies at the arm R(:, i) from it; c_i
   !! are its displacements along the directions AXES(:, 1 to 3, i), of which those USED count, with WEIGHT(i).
   !!    sum of w G^T (G {u, theta} - c) = 0,  G = directions^T [1 W]
   !! A component that this leaves open is not DETERMINED, and its row zero: of points on a line the rotation about it.
   pure subroutine mean_motion(r, axes, used, weight, t, determined)
      real(wp), intent(in)  :: r(:, :)       !! (3, points) [length]
      real(wp), intent(in)  :: axes(:, :, :) !! (3, 3, points), unit
      logical, intent(in)   :: used(:, :)    !! (3, points)
      real(wp), intent(in)  :: weight(:)     !! > 0
      real(wp), intent(out) :: t(:, :, :)    !! (6, 3, points) [-], rotations [1/length]
      logical, intent(out)  :: determined(6)
      real(wp) :: g(6, 3, size(weight)), a(6, 6), inverse(6, 6), size_of_it
      integer  :: c, i

      size_of_it = sqrt(sum(r**2)/size(weight))
      if (size_of_it <= 0.0_wp) size_of_it = 1.0_wp
      a = 0.0_wp
      do i = 1, size(weight)
         g(:3, :, i) = axes(:, :, i)
         g(4:, :, i) = matmul(transpose(by_rotation(r(:, i)/size_of_it)), axes(:, :, i)) ! rotations times the size: one unit
         do c = 1, 3
            if (.not. used(c, i)) g(:, c, i) = 0.0_wp
         end do
         a = a + weight(i)/sum(weight)*matmul(g(:, :, i), transpose(g(:, :, i)))
      end do
      call invert_where_determined(a, inverse, determined)
      do i = 1, size(weight)
         t(:, :, i) = weight(i)/sum(weight)*matmul(inverse, g(:, :, i))
         t(4:, :, i) = t(4:, :, i)/size_of_it
      end do
   end subroutine mean_motion

   !> Rows of the INVERSE of A, symmetric and not negative, for the components of x that A x = b determines, zero for the others: row j
   !! is y of A y = e_j where that has a solution. By elimination with the largest pivot left.
   pure subroutine invert_where_determined(a, inverse, determined)
      real(wp), intent(in)  :: a(6, 6)
      real(wp), intent(out) :: inverse(6, 6)
      logical, intent(out)  :: determined(6)
      real(wp), parameter :: rounding = 1.0e-12_wp ! of the largest entry: a pivot that is none
      real(wp) :: m(6, 12), pivot_row(12), residual(6)
      logical  :: done(6)
      integer  :: i, j, p

      m(:, :6) = a
      m(:, 7:) = 0.0_wp
      do i = 1, 6
         m(i, 6 + i) = 1.0_wp
      end do
      done = .false.
      do j = 1, 6
         p = maxloc([(m(i, i), i = 1, 6)], dim=1, mask=.not. done)
         if (m(p, p) <= rounding*maxval(abs(a))) exit
         done(p) = .true.
         pivot_row = m(p, :)/m(p, p)
         do i = 1, 6
            m(i, :) = m(i, :) - m(i, p)*pivot_row
         end do
         m(p, :) = pivot_row
      end do
      do j = 1, 6
         inverse(j, :) = merge(m(:, 6 + j), 0.0_wp, done) ! y, its open components zero
         residual = matmul(a, inverse(j, :))
         residual(j) = residual(j) - 1.0_wp
         determined(j) = done(j) .and. maxval(abs(residual)) <= 1.0e-8_wp
         if (.not. determined(j)) inverse(j, :) = 0.0_wp
      end do
   end subroutine invert_where_determined

end module rigid_motion
