!> Where two faces lie over one another, as seen in the frame of the first: the points over which to integrate. Faces are taken in
!! parts with straight rims; what two parts have in common is a polygon, of edges an interval.
module face_overlap
   use face_frames, only: seen_face
   use kinds, only: wp
   use polygon_clip, only: clip_polygon, drop_straight_corners, polygon_area, polygon_centroid
   use quadrature, only: integration_rule, side_product_rule
   implicit none
   private

   public :: overlap_points, seen_area

   !> Points in the plane of the first face, and what each of them stands for there.
   type, public :: plane_points
      integer :: n = 0
      real(wp), allocatable :: place(:, :) !! (2, room) s and t [length]
      real(wp), allocatable :: weight(:)   !! (room) area, of edges length; their sum is the overlap
   end type plane_points

   integer, parameter  :: most_corners = 4           ! of a part
   integer, parameter  :: most_parts = 5             ! of a face
   integer, parameter  :: room = 4*2**most_corners   ! corners of what two parts have in common
   integer, parameter  :: corner_numbers(4) = [1, 2, 3, 4]
   real(wp), parameter :: least_piece = 1.0e-10_wp   ! of the area of the first face: what is smaller is dropped

   real(wp), parameter :: straight = 1.0e-3_wp       ! of that: the triangle of a corner at which a polygon does not turn

   ! Gauss, five points. Source: Abramowitz, Stegun, Handbook of Mathematical Functions, Table 25.4.
   real(wp), parameter :: r = sqrt(10.0_wp/7.0_wp), q = sqrt(70.0_wp)
   real(wp), parameter :: gauss_place(5) = [-sqrt(5.0_wp + 2.0_wp*r), -sqrt(5.0_wp - 2.0_wp*r), 0.0_wp, &
                                            sqrt(5.0_wp - 2.0_wp*r), sqrt(5.0_wp + 2.0_wp*r)]/3.0_wp
   real(wp), parameter :: gauss_weight(5) = 0.5_wp*[(322.0_wp - 13.0_wp*q)/900.0_wp, (322.0_wp + 13.0_wp*q)/900.0_wp, &
      128.0_wp/225.0_wp, (322.0_wp + 13.0_wp*q)/900.0_wp, (322.0_wp - 13.0_wp*q)/900.0_wp]

contains

   !> The POINTS of the overlap of two faces.
   pure subroutine overlap_points(first, second, points)
      type(seen_face), intent(in)       :: first, second !! both in the frame of FIRST
      type(plane_points), intent(inout) :: points        !! set here; keeps its room
      type(integration_rule) :: rule
      integer  :: i, k, n(2), parts_1(most_corners, most_parts), parts_2(most_corners, most_parts)
      real(wp) :: smallest

      points%n = 0
      call list_parts(first, n(1), parts_1)
      call list_parts(second, n(2), parts_2)
      smallest = least_piece*seen_area(first)
      if (.not. first%is_edge) call side_product_rule(max(first%n, second%n), rule)
      do i = 1, n(1)
         do k = 1, n(2)
            associate (a => corners(first, parts_1(:, i)), b => corners(second, parts_2(:, k)))
               if (first%is_edge) then
                  call add_interval([minval(a(1, :)), maxval(a(1, :))], [minval(b(1, :)), maxval(b(1, :))], smallest, points)
               else
                  call add_polygon(a, b, rule, smallest, points)
               end if
            end associate
         end do
      end do
   end subroutine overlap_points

   !> Area of FACE as it is seen: of its parts together, of an edge its length.
   pure real(wp) function seen_area(face) result(area)
      type(seen_face), intent(in) :: face
      integer :: k, n, parts(most_corners, most_parts)

      area = 0.0_wp
      call list_parts(face, n, parts)
      do k = 1, n
         associate (rim => corners(face, parts(:, k)))
            if (face%is_edge) then
               area = area + abs(rim(1, 2) - rim(1, 1))
            else
               area = area + abs(polygon_area(rim))
            end if
         end associate
      end do
   end function seen_area

   !> The N parts of a face by its nodes, 0 behind the last: where it has mid-side nodes, those between them and the corners.
   pure subroutine list_parts(face, n, parts)
      type(seen_face), intent(in) :: face
      integer, intent(out)        :: n
      integer, intent(out)        :: parts(most_corners, most_parts)

      parts = 0
      if (face%is_edge .and. face%n == 3) then
         n = 2
         parts(:2, :n) = reshape([1, 3, 3, 2], [2, 2])
      else if (face%n == 6) then
         n = 4
         parts(:3, :n) = reshape([1, 4, 6, 4, 2, 5, 6, 5, 3, 4, 5, 6], [3, 4])
      else if (face%n == 8) then
         n = 5
         parts(:, :n) = reshape([1, 5, 8, 0, 5, 2, 6, 0, 6, 3, 7, 0, 8, 7, 4, 0, 5, 6, 7, 8], [4, 5])
      else
         n = 1
         parts(:face%n, 1) = corner_numbers(:face%n)
      end if
   end subroutine list_parts

   !> Where the nodes of a PART of FACE are seen.
   pure function corners(face, part) result(rim)
      type(seen_face), intent(in) :: face
      integer, intent(in)         :: part(:) !! 0 behind the last
      real(wp) :: rim(2, count(part > 0))

      rim = face%x(:2, part(:size(rim, 2)))
   end function corners

   !> Add the points of what the intervals A and B have in common.
   pure subroutine add_interval(a, b, smallest, points)
      real(wp), intent(in)              :: a(2), b(2)
      real(wp), intent(in)              :: smallest
      type(plane_points), intent(inout) :: points
      real(wp) :: low, high
      integer  :: i

      low = max(a(1), b(1))
      high = min(a(2), b(2))
      if (high - low <= smallest) return
      do i = 1, 5
         call add_point([0.5_wp*(low + high) + 0.5_wp*(high - low)*gauss_place(i), 0.0_wp], &
                        (high - low)*gauss_weight(i), points)
      end do
   end subroutine add_interval

   !> Add the points of what the polygons A and B have in common: the RULE over each triangle of a fan from the centroid, so that it
   !! does not matter which corner the polygon begins with. A triangle is its own fan.
   pure subroutine add_polygon(a, b, rule, smallest, points)
      real(wp), intent(in)               :: a(:, :), b(:, :) !! (2, corners), either sense; A convex
      type(integration_rule), intent(in) :: rule
      real(wp), intent(in)               :: smallest
      type(plane_points), intent(inout)  :: points
      real(wp) :: common(2, room), area
      integer  :: k, n

      if (any(minval(a, dim=2) > maxval(b, dim=2)) .or. any(minval(b, dim=2) > maxval(a, dim=2))) return
      if (polygon_area(a) > 0.0_wp) then
         call clip_polygon(b, a, n, common)
      else
         call clip_polygon(b, a(:, size(a, 2):1:-1), n, common)
      end if
      if (n < 3) return
      area = polygon_area(common(:, :n))
      if (abs(area) <= smallest) return
      call drop_straight_corners(straight*smallest, n, common)
      if (n < 3) return
      if (n == 3) then
         call add_triangle(common(:, :3), sign(1.0_wp, area), rule, points)
         return
      end if
      associate (middle => polygon_centroid(common(:, :n)))
         do k = 1, n
            call add_triangle(reshape([middle, common(:, k), common(:, modulo(k, n) + 1)], [2, 3]), sign(1.0_wp, area), rule, &
                              points)
         end do
      end associate
   end subroutine add_polygon

   !> Add the points of the RULE over a triangle of these CORNERS, whose polygon has the SENSE +1 or -1.
   pure subroutine add_triangle(corners, sense, rule, points)
      real(wp), intent(in)               :: corners(2, 3), sense
      type(integration_rule), intent(in) :: rule
      type(plane_points), intent(inout)  :: points
      real(wp) :: twice
      integer  :: i

      twice = 2.0_wp*sense*polygon_area(corners)
      do i = 1, rule%n
         call add_point(corners(:, 1) + rule%point(1, i)*(corners(:, 2) - corners(:, 1)) &
                        + rule%point(2, i)*(corners(:, 3) - corners(:, 1)), twice*rule%weight(i), points)
      end do
   end subroutine add_triangle

   !> Add a point.
   pure subroutine add_point(place, weight, points)
      real(wp), intent(in)              :: place(2), weight
      type(plane_points), intent(inout) :: points
      type(plane_points) :: larger

      if (.not. allocated(points%weight)) allocate (points%place(2, 0), points%weight(0))
      if (points%n == size(points%weight)) then
         allocate (larger%place(2, 2*points%n + 64), larger%weight(2*points%n + 64))
         larger%place(:, :points%n) = points%place
         larger%weight(:points%n) = points%weight
         call move_alloc(larger%place, points%place)
         call move_alloc(larger%weight, points%weight)
      end if
      points%n = points%n + 1
      points%place(:, points%n) = place
      points%weight(points%n) = weight
   end subroutine add_point

end module face_overlap
