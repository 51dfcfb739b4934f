!> Mortar projection for faces that do not match: tributary areas, nodes and weights of the interface elements.
!! Integrals of shape functions over the covered part of each face of SIDE1 give the weights on the nodes of both sides. They are summed
!! over the faces at a node, weighted with the area of the face. The tributary areas of the nodes of a face, the integrals of the N_k,
!! are divided among its elements. Edges and linear faces have an element at every node. Faces with mid-side nodes have elements at these
!! nodes only, because the tributary areas of the corners are zero or negative (0 and 1/3 of the triangle with 6 nodes; -1/12 and 1/3 of
!! the quadrilateral with 8).
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

   !> A face of SIDE1, with the thickness or 2 pi r that converts lengths to areas.
   type, public :: own_face
      type(face_frame) :: frame
      type(seen_face)  :: seen
      logical  :: on_ring = .false.
      real(wp) :: thickness = 1.0_wp         !! [length]; 1 in space
      real(wp) :: reach = 0.0_wp             !! of the search along the normal, either sense [length]
   end type own_face

   !> The integrals; N_k of the face of SIDE1, N_j of the opposite faces.
   type, public :: cover_integrals
      real(wp) :: seen = 0.0_wp                                     !! covered area, projected onto the plane of the face
      real(wp) :: farthest = 0.0_wp                                 !! largest distance of the faces [length]
      real(wp) :: area(max_side_nodes) = 0.0_wp                     !! of N_k [length^2]
      real(wp) :: normal(3, max_side_nodes) = 0.0_wp                !! of N_k n, in global axes [length^2]
      real(wp) :: own(max_side_nodes, max_side_nodes) = 0.0_wp      !! of N_k N_k' [length^2]
      integer  :: n = 0                                             !! number of opposite nodes
      integer, allocatable  :: node(:)                              !! (room) their positions
      real(wp), allocatable :: opposite(:, :)                       !! (max_side_nodes, room) of N_k N_j [length^2]
   end type cover_integrals

   !> The contribution of a face to the element at each of its nodes; zero at a node without an element.
   type, public :: face_part
      integer  :: n = 0                                                   !! number of nodes
      real(wp) :: area(max_side_nodes) = 0.0_wp                           !! [length^2]
      real(wp) :: normal(3, max_side_nodes) = 0.0_wp                      !! area times normal [length^2]
      real(wp) :: own(max_side_nodes, max_side_nodes) = 0.0_wp            !! (element, node k) area times weight [length^2]
      real(wp), allocatable :: opposite(:, :)                             !! (max_side_nodes, nodes opposite) likewise
   end type face_part

   real(wp), parameter :: least_weight = 1.0e-12_wp !! a smaller weight is rounding: its node is not connected
   real(wp), parameter :: least_area = 1.0e-12_wp   !! of the area of the faces at an element: a smaller area is zero

   !> The sums of the interface elements at the nodes of a side.
   type, public :: interface_sums_type
      integer :: n_nodes = 0                        !! of the model
      real(wp), allocatable :: area(:)              !! (elements) [length^2]
      real(wp), allocatable :: normal(:, :)         !! (3, elements) area times normal
      real(wp), allocatable :: around(:)            !! (elements) area of all faces at the element
      integer :: n = 0                              !! number of entries: a node, a weight and the element
      integer, allocatable  :: owner(:)             !! (room) element
      integer, allocatable  :: key(:)               !! (room) the node; for end 2 plus n_nodes
      real(wp), allocatable :: weight(:)            !! (room) times the area of the face
      integer, allocatable  :: first(:), entry(:)   !! the entries of element i: entry(first(i):first(i + 1) - 1)
   contains
      procedure :: start
      procedure :: add_face
      procedure :: finish
      procedure :: has_area
      procedure :: has_none
      procedure :: connect
   end type interface_sums_type

contains

   !> Set all integrals to zero; keep the room.
   pure subroutine start_integrals(integrals)
      type(cover_integrals), intent(inout) :: integrals

      integrals%seen = 0.0_wp
      integrals%farthest = 0.0_wp
      integrals%area = 0.0_wp
      integrals%normal = 0.0_wp
      integrals%own = 0.0_wp
      integrals%n = 0
      if (.not. allocated(integrals%node)) allocate (integrals%node(32), integrals%opposite(max_side_nodes, 32))
   end subroutine start_integrals

   !> Add the integrals over the part of FACE that the face OPPOSITE, given in the frame of FACE, covers. A point is covered where the
   !! distance of the faces along the normal of FACE is at most the reach.
   pure subroutine add_overlap(face, opposite, nodes, points, integrals)
      type(own_face), intent(in)           :: face
      type(seen_face), intent(in)          :: opposite
      integer, intent(in)                  :: nodes(:)   !! of OPPOSITE
      type(plane_points), intent(inout)    :: points     !! work space
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

   !> The columns of these NODES of SIDE2 in the integrals; new nodes get new columns of zeros.
   pure subroutine find_columns(nodes, integrals, column)
      integer, intent(in)                  :: nodes(:)
      type(cover_integrals), intent(inout) :: integrals
      integer, intent(out)                 :: column(:)
      integer :: k

      do while (integrals%n + size(nodes) > size(integrals%node))
         integrals%node = [integrals%node, integrals%node]
         integrals%opposite = reshape([integrals%opposite, integrals%opposite], [max_side_nodes, size(integrals%node)])
      end do
      do k = 1, size(nodes)
         column(k) = findloc(integrals%node(:integrals%n), nodes(k), dim=1)
         if (column(k) > 0) cycle
         integrals%n = integrals%n + 1
         integrals%node(integrals%n) = nodes(k)
         integrals%opposite(:, integrals%n) = 0.0_wp
         column(k) = integrals%n
      end do
   end subroutine find_columns

   !> PART from the INTEGRALS over a face with N nodes. A fully covered face: the displacements u2 of SIDE2 are fitted by least squares,
   !! u2_k = sum of (M^-1)_kl times the integral of N_l u2, where M is the integral of N_k N_l. The fit is exact where the shape functions
   !! of the face represent u2, and a node opposite its partner is connected to the partner only. A partly covered face: the displacements
   !! of both sides are averaged over the covered part, with the functions phi_i of the elements as weights.
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

   !> The number of corners among the N nodes of a face; they come first.
   pure integer function n_corners(dimension, n)
      integer, intent(in) :: dimension !! of the model: 2, edges, or 3, faces
      integer, intent(in) :: n

      n_corners = n
      if (dimension == 2) n_corners = 2
      if (n > 4) n_corners = n/2
   end function n_corners

   !> Shares of a fully covered face: SHARE(i, k) is the share of the element at node i in area, movement and normal of node k.
   !! An element at a mid-side node has half of each adjacent corner.
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

   !> Shares of a partly covered face: the element at node i has the function phi_i = sum of SHARE(i, k) N_k, which is nowhere negative on
   !! the face: N_i itself on a linear face; ((1-s)/2)^2, ((1+s)/2)^2 and (1-s^2)/2 on an edge with three nodes; (L1+L2)/2 for the sides of
   !! a triangle, (1-eta)/4 and so on for a quadrilateral. The N_k represent these polynomials exactly; the shares are the values at the
   !! nodes.
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
         if (corners == 3) then              ! (L1 + L2)/2: 1/2 on its side and at the ends of it, 1/4 on the other two sides
            share(4:6, corners + k) = 0.25_wp
            share(corners + k, corners + k) = 0.5_wp
         else                                ! (1 - eta)/4: 1/2 on its side, 1/4 on the adjacent ones, 0 on the opposite one
            share(5:8, corners + k) = 0.25_wp
            share(corners + k, corners + k) = 0.5_wp
            share(corners + modulo(k + 1, 4) + 1, corners + k) = 0.0_wp
         end if
      end do
   end function partial_shares

   !> Empty sums for N elements of a model with N_NODES nodes.
   pure subroutine start(self, n, n_nodes)
      class(interface_sums_type), intent(inout) :: self
      integer, intent(in)                       :: n, n_nodes

      self%n_nodes = n_nodes
      self%n = 0
      allocate (self%area(n), self%around(n), source=0.0_wp)
      allocate (self%normal(3, n), source=0.0_wp)
      allocate (self%owner(100), self%key(100), self%weight(100))
   end subroutine start

   !> Add the contribution of a face to the elements at its nodes.
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

   pure subroutine add_entry(self, owner, key, weight)
      type(interface_sums_type), intent(inout) :: self
      integer, intent(in)  :: owner, key
      real(wp), intent(in) :: weight

      if (abs(weight) <= 0.0_wp) return
      if (self%n == size(self%owner)) then
         self%owner = [self%owner, self%owner]
         self%key = [self%key, self%key]
         self%weight = [self%weight, self%weight]
      end if
      self%n = self%n + 1
      self%owner(self%n) = owner
      self%key(self%n) = key
      self%weight(self%n) = weight
   end subroutine add_entry

   !> Close the sums after the last face: sort the entries by element.
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

   !> Whether the area of element I is zero to rounding: at a corner on the axis, or far from the covered part of a face.
   elemental logical function has_none(self, i)
      class(interface_sums_type), intent(in) :: self
      integer, intent(in)                    :: i

      has_none = abs(self%area(i)) <= least_area*self%around(i)
   end function has_none

   !> Connect ELEMENT to the nodes of its entries at I, each once, the nodes of an end in ascending order.
   pure subroutine connect(self, i, element)
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
   end subroutine connect

   !> Set the weights of an end that are rounding to zero, and correct the largest weight so that the sum is 1.
   pure subroutine make_whole(weight)
      real(wp), intent(inout) :: weight(:)
      integer :: largest

      where (abs(weight) < least_weight) weight = 0.0_wp
      largest = maxloc(abs(weight), dim=1)
      if (largest > 0) weight(largest) = weight(largest) + (1.0_wp - sum(weight))
   end subroutine make_whole

end module mortar_integrals
