!> The overlap of two faces of a joint, as integration points in the plane of the first face.
!! This plane goes through the centre of the first face, perpendicular to its normal there; the opposite face is projected onto it
!! along the normal. Faces are divided into parts with straight edges; the overlap of two parts is a polygon, of two edges an
!! interval.
module face_overlap
   use element_kinds, only: centre_point, max_nodes, max_side_nodes, side_kind
   use kinds, only: wp
   use numbers, only: cross
   use quadrature, only: integration_rule, side_product_rule
   use shape_functions, only: shape_derivatives, shape_values
   use tolerances, only: alternating_point, edgewise_face, still_point, straight_corner, zero_overlap
   implicit none
   private

   public :: make_frame, edge_lengths, in_frame, find_point, map_point, surface_vector, clip_polygon, drop_straight_corners, &
             polygon_area, polygon_centroid, overlap_points, seen_area

   !> Axes of a face: columns s and t in its plane (for an edge, s along it), and the normal h out of the body.
   type, public :: face_frame
      real(wp) :: centre(3) = 0.0_wp
      real(wp) :: axes(3, 3) = 0.0_wp
   end type face_frame

   !> A face in the coordinates of a frame.
   type, public :: seen_face
      logical  :: is_edge = .false.
      integer  :: kind = 0                    !! of its shape functions, from side_kind
      integer  :: n = 0                       !! number of nodes
      real(wp) :: x(3, max_side_nodes) = 0.0_wp !! s, t and h of each node [length]
      logical  :: is_curved = .false.         !! whether the edges are chords of arcs; then also
      real(wp) :: tilt(4) = 0.0_wp            !! the angles of their tangents [rad]
      real(wp) :: normal(3) = 0.0_wp          !! of the face, unit
   end type seen_face

   integer, parameter  :: most_steps = 30     ! of Newton

   !> Integration points in the plane of the first face, with their weights.
   type, public :: plane_points
      integer :: n = 0
      real(wp), allocatable :: place(:, :) !! (2, room) s and t [length]
      real(wp), allocatable :: weight(:)   !! (room) area, of edges length; the sum is the overlap
   end type plane_points

   integer, parameter  :: room = 4*2**4              ! corners of the overlap of two parts of four corners
   integer, parameter  :: corner_numbers(4) = [1, 2, 3, 4]

   ! Gauss, five points. Source: Abramowitz, Stegun, Handbook of Mathematical Functions, Table 25.4.
   real(wp), parameter :: r = sqrt(10.0_wp/7.0_wp), q = sqrt(70.0_wp)
   real(wp), parameter :: gauss_place(5) = [-sqrt(5.0_wp + 2.0_wp*r), -sqrt(5.0_wp - 2.0_wp*r), 0.0_wp, &
                                            sqrt(5.0_wp - 2.0_wp*r), sqrt(5.0_wp + 2.0_wp*r)]/3.0_wp
   real(wp), parameter :: gauss_weight(5) = 0.5_wp*[(322.0_wp - 13.0_wp*q)/900.0_wp, (322.0_wp + 13.0_wp*q)/900.0_wp, &
      128.0_wp/225.0_wp, (322.0_wp + 13.0_wp*q)/900.0_wp, (322.0_wp - 13.0_wp*q)/900.0_wp]

contains

   !> The frame of a face with nodes X; zero axes where the face has no area.
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
      b = [0.0_wp, 0.0_wp, 1.0_wp]               ! body on the left of an edge, right-hand normal
      if (dimension == 3) b = matmul(x, dn(2, :nodes))
      normal = cross(a, b)
      if (norm2(normal) <= 0.0_wp) return
      frame%axes(:, 1) = a/norm2(a)
      frame%axes(:, 3) = normal/norm2(normal)
      frame%axes(:, 2) = cross(frame%axes(:, 3), frame%axes(:, 1))
   end subroutine make_frame

   !> The lengths of the edges of a face with corners X, from each corner to the next [length].
   pure function edge_lengths(x) result(lengths)
      real(wp), intent(in) :: x(:, :) !! (3, corners) [length]
      real(wp) :: lengths(size(x, 2))

      lengths = norm2(cshift(x, 1, dim=2) - x, dim=1)
   end function edge_lengths

   !> The face with nodes X in the coordinates of FRAME.
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

   !> Local coordinates POINT of the point of FACE that is projected to PLACE, by Newton's method.
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
         is_found = maxval(abs(step)) <= still_point*(1.0_wp + maxval(abs(point)))
         if (is_found .or. .not. maxval(abs(point)) < 1.0e3_wp) return
      end do
      is_found = maxval(abs(step)) <= alternating_point ! iterates alternate about the point by rounding
   end subroutine find_point

   !> Shape functions N and position of FACE at a POINT.
   pure subroutine map_point(face, point, n, x)
      type(seen_face), intent(in) :: face
      real(wp), intent(in)        :: point(3)
      real(wp), intent(out)       :: n(max_nodes)
      real(wp), intent(out)       :: x(3)       !! s, t, h [length]

      call shape_values(face%kind, point, n)
      x = matmul(face%x(:, :face%n), n(:face%n))
   end subroutine map_point

   !> The outward area vector of FACE at a POINT, in the frame, divided by the projected area (of an edge, length); 0 where the
   !! projected area is zero.
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
      if (abs(vector(3)) <= edgewise_face*norm2(vector)) then
         vector = 0.0_wp
      else
         vector = vector/abs(vector(3))
      end if
   end function surface_vector

   !> The part of SUBJECT inside the convex polygon WINDOW, with the orientation of SUBJECT; a corner may occur twice.
   !! Source: Sutherland and Hodgman, Reentrant polygon clipping, Comm. ACM 17 (1974) 32-42.
   pure subroutine clip_polygon(subject, window, n, common)
      real(wp), intent(in)    :: subject(:, :) !! (2, corners)
      real(wp), intent(in)    :: window(:, :)  !! (2, corners), counter-clockwise
      integer, intent(out)    :: n             !! number of corners of COMMON; 0: no overlap
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

      !> Positive to the left of side K of the window, zero on it.
      pure real(wp) function left_of(point)
         real(wp), intent(in) :: point(2)

         left_of = along(1)*(point(2) - window(2, k)) - along(2)*(point(1) - window(1, k))
      end function left_of

   end subroutine clip_polygon

   !> Drop the corners of POLYGON at which it does not turn. Clipping leaves some, by rounding, where sides of both polygons
   !! coincide. A corner is dropped if its triangle with both neighbours has at most the area LEAST.
   pure subroutine drop_straight_corners(least, n, polygon)
      real(wp), intent(in)    :: least         !! [length^2]
      integer, intent(inout)  :: n             !! number of corners
      real(wp), intent(inout) :: polygon(:, :) !! (2, room) [length]
      real(wp) :: before(2), next(2)
      integer  :: k, kept

      if (n < 3) return
      before = polygon(:, n)
      kept = 0
      do k = 1, n
         next = polygon(:, merge(1, k + 1, k == n)) ! after the last corner comes the first one kept
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

   !> Area of POLYGON, negative for a clockwise polygon [length^2].
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

   !> The integration POINTS of the overlap of two faces.
   pure subroutine overlap_points(first, second, points)
      type(seen_face), intent(in)       :: first, second !! both in the frame of FIRST
      type(plane_points), intent(inout) :: points        !! set here; keeps its room
      type(integration_rule) :: rule
      integer, allocatable :: parts_1(:, :), parts_2(:, :)
      real(wp) :: low, high, smallest
      integer  :: i, k, p

      points%n = 0
      allocate (parts_1, source=parts_of(first))
      allocate (parts_2, source=parts_of(second))
      smallest = zero_overlap*seen_area(first)
      if (.not. first%is_edge) call side_product_rule(max(first%n, second%n), rule)
      do i = 1, size(parts_1, 2)
         do k = 1, size(parts_2, 2)
            associate (a => corners(first, parts_1(:, i)), b => corners(second, parts_2(:, k)))
               if (first%is_edge) then
                  low = max(minval(a(1, :)), minval(b(1, :)))
                  high = min(maxval(a(1, :)), maxval(b(1, :)))
                  if (high - low > smallest) then
                     do p = 1, 5
                        call add_point([0.5_wp*(low + high) + 0.5_wp*(high - low)*gauss_place(p), 0.0_wp], &
                                       (high - low)*gauss_weight(p), points)
                     end do
                  end if
               else
                  call add_polygon(a, b, rule, smallest, points)
               end if
            end associate
         end do
      end do
   end subroutine overlap_points

   !> Projected area of FACE, the sum over its parts; of an edge its length.
   pure real(wp) function seen_area(face) result(area)
      type(seen_face), intent(in) :: face
      integer, allocatable :: parts(:, :)
      integer :: k

      area = 0.0_wp
      allocate (parts, source=parts_of(face))
      do k = 1, size(parts, 2)
         associate (rim => corners(face, parts(:, k)))
            if (face%is_edge) then
               area = area + abs(rim(1, 2) - rim(1, 1))
            else
               area = area + abs(polygon_area(rim))
            end if
         end associate
      end do
   end function seen_area

   !> The parts of a face as lists of nodes, one in a column, 0 behind the last node. A face with mid-side nodes is divided at them.
   pure function parts_of(face) result(parts)
      type(seen_face), intent(in) :: face
      integer, allocatable :: parts(:, :)

      if (face%is_edge .and. face%n == 3) then
         parts = reshape([1, 3, 3, 2], [2, 2])
      else if (face%n == 6) then
         parts = reshape([1, 4, 6, 4, 2, 5, 6, 5, 3, 4, 5, 6], [3, 4])
      else if (face%n == 8) then
         parts = reshape([1, 5, 8, 0, 5, 2, 6, 0, 6, 3, 7, 0, 8, 7, 4, 0, 5, 6, 7, 8], [4, 5])
      else
         parts = reshape(corner_numbers(:face%n), [face%n, 1])
      end if
   end function parts_of

   !> The projected corners of a PART of FACE.
   pure function corners(face, part) result(rim)
      type(seen_face), intent(in) :: face
      integer, intent(in)         :: part(:) !! 0 behind the last
      real(wp) :: rim(2, count(part > 0))

      rim = face%x(:2, part(:size(rim, 2)))
   end function corners

   !> Add the points of the intersection of the polygons A and B: the RULE over each triangle of a fan from the centroid, so that
   !! the result does not depend on the first corner. A triangle is not divided.
   pure subroutine add_polygon(a, b, rule, smallest, points)
      real(wp), intent(in)               :: a(:, :), b(:, :) !! (2, corners), either sense; A convex
      type(integration_rule), intent(in) :: rule
      real(wp), intent(in)               :: smallest
      type(plane_points), intent(inout)  :: points
      real(wp) :: common(2, room), area, middle(2), triangle(2, 3), twice
      integer  :: i, k, n

      if (any(minval(a, dim=2) > maxval(b, dim=2)) .or. any(minval(b, dim=2) > maxval(a, dim=2))) return
      if (polygon_area(a) > 0.0_wp) then
         call clip_polygon(b, a, n, common)
      else
         call clip_polygon(b, a(:, size(a, 2):1:-1), n, common)
      end if
      if (n < 3) return
      area = polygon_area(common(:, :n))
      if (abs(area) <= smallest) return
      call drop_straight_corners(straight_corner*smallest, n, common)
      if (n < 3) return
      middle = polygon_centroid(common(:, :n))
      do k = 1, merge(1, n, n == 3)
         triangle = common(:, :3)
         if (n > 3) triangle = reshape([middle, common(:, k), common(:, modulo(k, n) + 1)], [2, 3])
         twice = sign(2.0_wp, area)*polygon_area(triangle) ! negative for a triangle against the orientation of its polygon
         do i = 1, rule%n
            call add_point(triangle(:, 1) + rule%point(1, i)*(triangle(:, 2) - triangle(:, 1)) &
                           + rule%point(2, i)*(triangle(:, 3) - triangle(:, 1)), twice*rule%weight(i), points)
         end do
      end do
   end subroutine add_polygon

   !> Append a point; the arrays are doubled when they are full.
   pure subroutine add_point(place, weight, points)
      real(wp), intent(in)              :: place(2), weight
      type(plane_points), intent(inout) :: points

      if (.not. allocated(points%weight)) allocate (points%place(2, 64), points%weight(64))
      if (points%n == size(points%weight)) then
         points%weight = [points%weight, points%weight]
         points%place = reshape([points%place, points%place], [2, 2*points%n])
      end if
      points%n = points%n + 1
      points%place(:, points%n) = place
      points%weight(points%n) = weight
   end subroutine add_point

end module face_overlap
