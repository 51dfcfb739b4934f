!> Polygons in a plane: what two of them have in common, and how large it is.
module polygon_clip
   use kinds, only: wp
   implicit none
   private

   public :: clip_polygon, drop_straight_corners, polygon_area, polygon_centroid

contains

   !> The part of SUBJECT that lies in the convex polygon WINDOW, in the sense of SUBJECT; a corner may stand there twice.
   !! Source: Sutherland and Hodgman, Reentrant polygon clipping, Comm. ACM 17 (1974) 32-42.
   pure subroutine clip_polygon(subject, window, n, common)
      real(wp), intent(in)    :: subject(:, :) !! (2, corners)
      real(wp), intent(in)    :: window(:, :)  !! (2, corners), counter-clockwise
      integer, intent(out)    :: n             !! corners of COMMON; 0: they do not meet
      real(wp), intent(inout) :: common(:, :)  !! (2, room for twice the corners of SUBJECT for each side of WINDOW), set here
      real(wp) :: before(2, size(common, 2)), along(2), here, last
      integer  :: i, k, m, previous

      n = size(subject, 2)
      common(:, :n) = subject
      do k = 1, size(window, 2)
         along = window(:, modulo(k, size(window, 2)) + 1) - window(:, k)
         m = n
         before(:, :m) = common(:, :m)
         n = 0
         do i = 1, m
            previous = modulo(i - 2, m) + 1
            here = left_of(before(:, i))
            last = left_of(before(:, previous))
            if ((here >= 0.0_wp) .neqv. (last >= 0.0_wp)) then
               n = n + 1
               common(:, n) = before(:, previous) + (last/(last - here))*(before(:, i) - before(:, previous))
            end if
            if (here < 0.0_wp) cycle
            n = n + 1
            common(:, n) = before(:, i)
         end do
      end do

   contains

      !> Positive on the left of side K of the window, zero on it.
      pure real(wp) function left_of(point)
         real(wp), intent(in) :: point(2)

         left_of = along(1)*(point(2) - window(2, k)) - along(2)*(point(1) - window(1, k))
      end function left_of

   end subroutine clip_polygon

   !> Drop the corners of POLYGON at which it does not turn: clipping leaves some, by rounding, where sides of both polygons lie on one
   !! another. A corner goes with which the triangle between its neighbours has no more than the area LEAST.
   pure subroutine drop_straight_corners(least, n, polygon)
      real(wp), intent(in)    :: least         !! [length^2]
      integer, intent(inout)  :: n             !! corners
      real(wp), intent(inout) :: polygon(:, :) !! (2, room) [length]
      real(wp) :: before(2), next(2)
      integer  :: k, kept

      if (n < 3) return
      before = polygon(:, n)
      kept = 0
      do k = 1, n
         next = polygon(:, merge(1, k + 1, k == n)) ! at the end the first that is kept
         if (abs(polygon_area(reshape([before, polygon(:, k), next], [2, 3]))) <= least) cycle
         kept = kept + 1
         polygon(:, kept) = polygon(:, k)
         before = polygon(:, k)
      end do
      n = kept
   end subroutine drop_straight_corners

   !> Centroid of POLYGON, whose area is not zero.
   pure function polygon_centroid(polygon) result(centroid)
      real(wp), intent(in) :: polygon(:, :) !! (2, corners) [length]
      real(wp) :: centroid(2), area, all_area
      integer :: i

      centroid = 0.0_wp
      all_area = 0.0_wp
      do i = 3, size(polygon, 2)
         area = polygon_area(polygon(:, [1, i - 1, i]))
         centroid = centroid + area/3.0_wp*(polygon(:, i - 1) + polygon(:, i) - 2.0_wp*polygon(:, 1))
         all_area = all_area + area
      end do
      centroid = polygon(:, 1) + centroid/all_area
   end function polygon_centroid

   !> Area of POLYGON, negative where its corners go round clockwise [length^2].
   pure real(wp) function polygon_area(polygon) result(area)
      real(wp), intent(in) :: polygon(:, :) !! (2, corners) [length]
      integer :: i

      area = 0.0_wp
      do i = 3, size(polygon, 2)
         associate (a => polygon(:, i - 1) - polygon(:, 1), b => polygon(:, i) - polygon(:, 1))
            area = area + 0.5_wp*(a(1)*b(2) - a(2)*b(1))
         end associate
      end do
   end function polygon_area

end module polygon_clip
