!> The interface elements of faces that do not match: what each has of the area of a face of SIDE1, and on which nodes of both
!! sides it hangs. They come from integrals of shape functions over what faces of SIDE2 cover of the face, and are added up
!! over the faces at a node, each with its area as weight. The areas of influence of a face's nodes, the integrals of the N_k,
!! are shared out among its elements. Edges and linear faces have an element at every node. Faces with mid-side nodes have
!! elements at these alone, because the areas of the corners are zero or negative (0 and 1/3 of the triangle with 6 nodes;
!! -1/12 and 1/3 of the quadrilateral with 8).
module mortar_integrals
   use element_kinds, only: max_nodes, max_side_nodes
   use element_mapping, only: two_pi
   use face_overlap, only: face_frame, find_point, map_point, seen_face, surface_vector, overlap_points, plane_points
   use interface_operator, only: interface_element
   use kinds, only: wp
   use lists, only: sorted_order, list_owners
   implicit none
   private

   public :: start_integrals, add_overlap, fit_face, whole_shares, partial_shares

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

   !> What a face gives to the element at each of its nodes; nothing but zeros where there is none.
   type, public :: face_part
      integer  :: n = 0                                                   !! nodes
      real(wp) :: area(max_side_nodes) = 0.0_wp                           !! [length^2]
      real(wp) :: normal(3, max_side_nodes) = 0.0_wp                      !! area times normal [length^2]
      real(wp) :: own(max_side_nodes, max_side_nodes) = 0.0_wp            !! (element, node k) area times weight [length^2]
      real(wp), allocatable :: opposite(:, :)                             !! (max_side_nodes, nodes opposite) likewise
   end type face_part

   real(wp), parameter :: least_weight = 1.0e-12_wp !! what is less is rounding: such a node is no part of an end
   real(wp), parameter :: least_area = 1.0e-12_wp   !! of the faces at an element: what is less is none

   !> The sums for the elements at the nodes of a side.
   type, public :: interface_sums_type
      integer :: n_nodes = 0                        !! of the model
      real(wp), allocatable :: area(:)              !! (elements) [length^2]
      real(wp), allocatable :: normal(:, :)         !! (3, elements) area times normal
      real(wp), allocatable :: around(:)            !! (elements) area of all faces at the element
      integer :: n = 0                              !! entries: a node, a weight and whose they are
      integer, allocatable  :: owner(:)             !! (room) element
      integer, allocatable  :: key(:)               !! (room) the node; of end 2 with n_nodes on top
      real(wp), allocatable :: weight(:)            !! (room) times the area of the face
      integer, allocatable  :: first(:), entry(:)   !! those of element i: entry(first(i):first(i + 1) - 1)
   contains
      procedure :: start
      procedure :: add_face
      procedure :: finish
      procedure :: has_area
      procedure :: has_none
      procedure :: hang
   end type interface_sums_type

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

   !> PART from the INTEGRALS over a face with N nodes. A whole face: the displacements u2 of SIDE2 under it are fitted by least
   !! squares, u2_k = sum of (M^-1)_kl times the integral of N_l u2, M that of N_k N_l; so that SIDE2, where it moves as the
   !! functions of the face do, is taken exactly, and a node over its partner hangs on that alone. A face partly covered: means
   !! of the displacements of both sides over what is covered, with the functions phi_i of the elements as weights.
   pure subroutine fit_face(dimension, n, is_whole, integrals, part)
      integer, intent(in)               :: dimension, n
      logical, intent(in)               :: is_whole
      type(cover_integrals), intent(in) :: integrals
      type(face_part), intent(inout)    :: part
      real(wp) :: share(max_side_nodes, max_side_nodes), fitted(n, integrals%n)
      integer  :: k

      part%n = n
      if (is_whole) then
         share = whole_shares(dimension, n)
         call solve_symmetric(integrals%own(:n, :n), integrals%opposite(:n, :integrals%n), fitted)
         do k = 1, n
            part%own(:, k) = share(:, k)*integrals%area(k)
         end do
         part%opposite = matmul(part%own(:, :n), fitted)
      else
         share = partial_shares(dimension, n)
         part%own(:, :n) = matmul(share(:, :n), integrals%own(:n, :n))
         part%opposite = matmul(share(:, :n), integrals%opposite(:n, :integrals%n))
      end if
      part%area = matmul(share(:, :n), integrals%area(:n))
      part%normal = matmul(integrals%normal(:, :n), transpose(share(:, :n)))
   end subroutine fit_face

   !> X of M X = B, M symmetric and positive definite: the factor of Cholesky.
   pure subroutine solve_symmetric(m, b, x)
      real(wp), intent(in)  :: m(:, :), b(:, :)
      real(wp), intent(out) :: x(:, :)
      real(wp) :: l(size(m, 1), size(m, 1))
      integer  :: i, k, n

      n = size(m, 1)
      l = 0.0_wp
      do k = 1, n
         l(k, k) = sqrt(m(k, k) - sum(l(k, :k - 1)**2))
         do i = k + 1, n
            l(i, k) = (m(i, k) - dot_product(l(i, :k - 1), l(k, :k - 1)))/l(k, k)
         end do
      end do
      x = b
      do k = 1, n
         x(k, :) = (x(k, :) - matmul(l(k, :k - 1), x(:k - 1, :)))/l(k, k)
      end do
      do k = n, 1, -1
         x(k, :) = (x(k, :) - matmul(l(k + 1:, k), x(k + 1:, :)))/l(k, k)
      end do
   end subroutine solve_symmetric

   !> How many of the N nodes of a face are corners: the first ones.
   pure integer function n_corners(dimension, n)
      integer, intent(in) :: dimension !! of the model: 2, edges, or 3, faces
      integer, intent(in) :: n

      n_corners = n
      if (dimension == 2) n_corners = 2
      if (n > 4) n_corners = n/2
   end function n_corners

   !> Shares of a whole face: SHARE(i, k) is what the element at node i has of the area, the movement and the normal of node k.
   !! Elements at mid-side nodes have half of each corner beside them.
   pure function whole_shares(dimension, n) result(share)
      integer, intent(in) :: dimension !! of the model: 2, edges, or 3, faces
      integer, intent(in) :: n         !! nodes of the face
      real(wp) :: share(max_side_nodes, max_side_nodes)
      integer  :: corners, k

      share = 0.0_wp
      do k = 1, n
         share(k, k) = 1.0_wp
      end do
      corners = n_corners(dimension, n)
      if (dimension == 2 .or. n == corners) return
      do k = 1, corners
         share(k, k) = 0.0_wp
         share(corners + k, k) = 0.5_wp
         share(corners + k, modulo(k, corners) + 1) = 0.5_wp
      end do
   end function whole_shares

   !> Shares of a face of which only a part is covered: the element at node i has the function phi_i = sum of SHARE(i, k) N_k, none
   !! of which is negative on the face: N_i itself where that is linear; ((1-s)/2)^2, ((1+s)/2)^2 and (1-s^2)/2 on an edge with three
   !! nodes; (L1+L2)/2 of the sides of a triangle, (1-eta)/4 and so on of a quadrilateral. A sum of N_k, because all of them are
   !! polynomials that the N_k represent; the shares are their values at the nodes.
   pure function partial_shares(dimension, n) result(share)
      integer, intent(in) :: dimension, n !! as above
      real(wp) :: share(max_side_nodes, max_side_nodes)
      integer  :: corners, k, next

      share = whole_shares(dimension, n)
      if (dimension == 2) then
         if (n == 3) share(:3, 3) = [0.25_wp, 0.25_wp, 0.5_wp]
         return
      end if
      corners = n_corners(dimension, n)
      if (n == corners) return
      do k = 1, corners
         next = modulo(k, corners) + 1
         if (corners == 3) then              ! (L1 + L2)/2: 1/2 at its corners and between them, 1/4 on the other two sides
            share(4:6, corners + k) = 0.25_wp
            share(corners + k, corners + k) = 0.5_wp
         else                                ! (1 - eta)/4: 1/2 on its side, 1/4 on those beside it, 0 on the opposite one
            share(5:8, corners + k) = 0.25_wp
            share(corners + k, corners + k) = 0.5_wp
            share(corners + modulo(k + 1, 4) + 1, corners + k) = 0.0_wp
         end if
      end do
   end function partial_shares

   !> Nothing yet for N elements of a model with so many nodes.
   pure subroutine start(self, n, n_nodes)
      class(interface_sums_type), intent(inout) :: self
      integer, intent(in)                       :: n, n_nodes

      self%n_nodes = n_nodes
      self%n = 0
      allocate (self%area(n), self%around(n), source=0.0_wp)
      allocate (self%normal(3, n), source=0.0_wp)
      allocate (self%owner(0), self%key(0), self%weight(0))
   end subroutine start

   !> Add what a face gives to the elements at its nodes.
   pure subroutine add_face(self, elements, own, opposite, part)
      class(interface_sums_type), intent(inout) :: self
      integer, intent(in)         :: elements(:) !! at its nodes, 0: none
      integer, intent(in)         :: own(:)      !! its nodes, positions in the model
      integer, intent(in)         :: opposite(:) !! the nodes opposite; none: a rigid base
      type(face_part), intent(in) :: part
      integer :: i, k

      do i = 1, part%n
         if (elements(i) == 0 .or. all(abs(part%own(i, :part%n)) <= 0.0_wp)) cycle
         self%area(elements(i)) = self%area(elements(i)) + part%area(i)
         self%normal(:, elements(i)) = self%normal(:, elements(i)) + part%normal(:, i)
         self%around(elements(i)) = self%around(elements(i)) + sum(abs(part%area(:part%n)))
         do k = 1, part%n
            call add_entry(self, elements(i), own(k), part%own(i, k))
         end do
         do k = 1, size(opposite)
            call add_entry(self, elements(i), self%n_nodes + opposite(k), part%opposite(i, k))
         end do
      end do
   end subroutine add_face

   !> Add one entry.
   pure subroutine add_entry(self, owner, key, weight)
      type(interface_sums_type), intent(inout) :: self
      integer, intent(in)  :: owner, key
      real(wp), intent(in) :: weight
      integer, allocatable  :: owners(:), keys(:)
      real(wp), allocatable :: weights(:)

      if (abs(weight) <= 0.0_wp) return
      if (self%n == size(self%owner)) then
         allocate (owners(2*self%n + 100), keys(2*self%n + 100), weights(2*self%n + 100))
         owners(:self%n) = self%owner
         keys(:self%n) = self%key
         weights(:self%n) = self%weight
         call move_alloc(owners, self%owner)
         call move_alloc(keys, self%key)
         call move_alloc(weights, self%weight)
      end if
      self%n = self%n + 1
      self%owner(self%n) = owner
      self%key(self%n) = key
      self%weight(self%n) = weight
   end subroutine add_entry

   !> All faces are there.
   pure subroutine finish(self)
      class(interface_sums_type), intent(inout) :: self

      call list_owners(size(self%area), reshape(self%owner(:self%n), [1, self%n]), self%first, self%entry)
   end subroutine finish

   !> Whether element I has an area, > 0.
   elemental logical function has_area(self, i)
      class(interface_sums_type), intent(in) :: self
      integer, intent(in)                    :: i

      has_area = self%area(i) > least_area*self%around(i)
   end function has_area

   !> Whether the area of element I is zero but for rounding: at a corner on the axis, and far from what is covered of a face.
   elemental logical function has_none(self, i)
      class(interface_sums_type), intent(in) :: self
      integer, intent(in)                    :: i

      has_none = abs(self%area(i)) <= least_area*self%around(i)
   end function has_none

   !> Hang ELEMENT on the nodes that the faces at I gave it, each once, those of an end in ascending order.
   pure subroutine hang(self, i, element)
      class(interface_sums_type), intent(in) :: self
      integer, intent(in)                    :: i       !! has_area(i)
      type(interface_element), intent(inout) :: element
      integer, allocatable  :: order(:), node(:)
      real(wp), allocatable :: weight(:)
      integer :: end, k, n(2)

      associate (entries => self%entry(self%first(i):self%first(i + 1) - 1))
         call sorted_order(self%key(entries), order)
         allocate (node(size(entries)), weight(size(entries)))
         n = 0
         do k = 1, size(entries)
            associate (this => entries(order(k)))
               end = merge(2, 1, self%key(this) > self%n_nodes)
               if (sum(n) > 0) then
                  if (node(sum(n)) == self%key(this)) then
                     weight(sum(n)) = weight(sum(n)) + self%weight(this)
                     cycle
                  end if
               end if
               n(end) = n(end) + 1
               node(sum(n)) = self%key(this)
               weight(sum(n)) = self%weight(this)
            end associate
         end do
      end associate
      node = node(:sum(n))
      weight = weight(:sum(n))/self%area(i)
      call make_whole(weight(:n(1)))
      call make_whole(weight(n(1) + 1:))
      element%n_1 = count(abs(weight(:n(1))) > 0.0_wp)
      element%weight = pack([weight(:n(1)), -weight(n(1) + 1:)], abs(weight) > 0.0_wp)
      element%node = pack(merge(node, node - self%n_nodes, node <= self%n_nodes), abs(weight) > 0.0_wp)
      element%area = self%area(i)
   end subroutine hang

   !> The weights of an end without what is rounding, so that their sum is 1 but for its own rounding.
   pure subroutine make_whole(weight)
      real(wp), intent(inout) :: weight(:)
      integer :: largest

      where (abs(weight) < least_weight) weight = 0.0_wp
      largest = maxloc(abs(weight), dim=1)
      if (largest > 0) weight(largest) = weight(largest) + (1.0_wp - sum(weight))
   end subroutine make_whole

end module mortar_integrals
