!> Integrals of shape functions over the part of one face of SIDE1 that faces of SIDE2 cover: what the interface elements of the
!! face are made of. The points have no state: they serve the integrals alone.
module face_integrals
   use element_kinds, only: max_nodes, max_side_nodes
   use element_mapping, only: two_pi
   use face_frames, only: face_frame, find_point, map_point, seen_face, surface_vector
   use face_overlap, only: overlap_points, plane_points
   use kinds, only: wp
   implicit none
   private

   public :: start_integrals, add_overlap

   !> A face of SIDE1 with what makes lengths areas: thickness, or twice pi and the distance from the axis.
   type, public :: own_face
      type(face_frame) :: frame
      type(seen_face)  :: seen
      logical  :: on_ring = .false.
      real(wp) :: thickness = 1.0_wp         !! [length]; 1 in space
      real(wp) :: reach = 0.0_wp             !! of the search along the normal, either sense [length]
   end type own_face

   !> The integrals; N_k of the own face, N_j of those opposite.
   type, public :: cover_integrals
      real(wp) :: seen = 0.0_wp                                     !! what is covered, as seen: in the plane of the face
      real(wp) :: farthest = 0.0_wp                                 !! largest distance of the faces [length]
      real(wp) :: area(max_side_nodes) = 0.0_wp                     !! of N_k [length^2]
      real(wp) :: normal(3, max_side_nodes) = 0.0_wp                !! of N_k n, in global axes [length^2]
      real(wp) :: own(max_side_nodes, max_side_nodes) = 0.0_wp      !! of N_k N_k' [length^2]
      integer  :: n = 0                                             !! nodes opposite
      integer, allocatable  :: node(:)                              !! (room) their positions
      real(wp), allocatable :: opposite(:, :)                       !! (max_side_nodes, room) of N_k N_j [length^2]
   end type cover_integrals

contains

   !> All integrals zero; the room stays.
   pure subroutine start_integrals(integrals)
      type(cover_integrals), intent(inout) :: integrals

      integrals%seen = 0.0_wp
      integrals%farthest = 0.0_wp
      integrals%area = 0.0_wp
      integrals%normal = 0.0_wp
      integrals%own = 0.0_wp
      integrals%n = 0
      if (.not. allocated(integrals%node)) allocate (integrals%node(0), integrals%opposite(max_side_nodes, 0))
   end subroutine start_integrals

   !> Add what the face OPPOSITE, seen in the frame of FACE, covers of it: a point is covered where the faces are no farther apart
   !! than the reach, along the normal of FACE.
   pure subroutine add_overlap(face, opposite, nodes, points, integrals)
      type(own_face), intent(in)           :: face
      type(seen_face), intent(in)          :: opposite
      integer, intent(in)                  :: nodes(:)   !! of OPPOSITE
      type(plane_points), intent(inout)    :: points     !! room to work in
      type(cover_integrals), intent(inout) :: integrals
      real(wp) :: n_1(max_nodes), n_2(max_nodes), x_1(3), x_2(3), point_1(3), point_2(3), surface(3), weight
      integer  :: column(size(nodes)), i, j
      logical  :: found_1, found_2

      call overlap_points(face%seen, opposite, points)
      if (points%n == 0) return
      call find_columns(nodes, integrals, column)
      associate (n => face%seen%n)
         do i = 1, points%n
            call find_point(face%seen, points%place(:, i), point_1, found_1)
            call find_point(opposite, points%place(:, i), point_2, found_2)
            if (.not. (found_1 .and. found_2)) cycle
            call map_point(face%seen, point_1, n_1, x_1)
            call map_point(opposite, point_2, n_2, x_2)
            if (abs(x_2(3) - x_1(3)) > face%reach) cycle
            surface = surface_vector(face%seen, point_1)
            weight = points%weight(i)*face%thickness
            if (face%on_ring) weight = points%weight(i)*two_pi*(face%frame%centre(1) + dot_product(face%frame%axes(1, :), x_1))
            integrals%seen = integrals%seen + points%weight(i)
            integrals%farthest = max(integrals%farthest, abs(x_2(3) - x_1(3)))
            surface = weight*matmul(face%frame%axes, surface)
            weight = norm2(surface)
            do j = 1, n
               integrals%area(j) = integrals%area(j) + weight*n_1(j)
               integrals%normal(:, j) = integrals%normal(:, j) + surface*n_1(j)
               integrals%own(:n, j) = integrals%own(:n, j) + (weight*n_1(j))*n_1(:n)
            end do
            do j = 1, size(nodes)
               integrals%opposite(:n, column(j)) = integrals%opposite(:n, column(j)) + (weight*n_2(j))*n_1(:n)
            end do
         end do
      end associate
   end subroutine add_overlap

   !> Where the integrals with the shape functions of these NODES of SIDE2 stand; nodes that are new get places, with zeros.
   pure subroutine find_columns(nodes, integrals, column)
      integer, intent(in)                  :: nodes(:)
      type(cover_integrals), intent(inout) :: integrals
      integer, intent(out)                 :: column(:)
      integer, allocatable  :: node(:)
      real(wp), allocatable :: opposite(:, :)
      integer :: k

      if (integrals%n + size(nodes) > size(integrals%node)) then
         allocate (node(2*integrals%n + 32), opposite(max_side_nodes, 2*integrals%n + 32))
         node(:integrals%n) = integrals%node(:integrals%n)
         opposite(:, :integrals%n) = integrals%opposite(:, :integrals%n)
         call move_alloc(node, integrals%node)
         call move_alloc(opposite, integrals%opposite)
      end if
      do k = 1, size(nodes)
         column(k) = findloc(integrals%node(:integrals%n), nodes(k), dim=1)
         if (column(k) > 0) cycle
         integrals%n = integrals%n + 1
         integrals%node(integrals%n) = nodes(k)
         integrals%opposite(:, integrals%n) = 0.0_wp
         column(k) = integrals%n
      end do
   end subroutine find_columns

end module face_integrals
