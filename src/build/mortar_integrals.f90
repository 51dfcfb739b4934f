!> Mortar projection for faces that do not match: tributary areas, nodes and weights of the interface elements.
!! Integrals of shape functions over the covered part of each face of SIDE1 give the weights on the nodes of both sides. They are
!! summed over the faces at a node, weighted with the area of the face. The tributary areas of the nodes of a face, the integrals of
!! the N_k, are divided among its elements. Edges and linear faces have an element at every node. Faces with mid-side nodes have
!! elements at these nodes only, because the tributary areas of the corners are zero or negative (0 and 1/3 of the triangle with 6
!! nodes; -1/12 and 1/3 of the quadrilateral with 8).
module mortar_integrals
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use blas_lapack, only: dposv
   use curved_faces, only: height_over_chords
   use element_kinds, only: max_nodes, max_side_nodes
   use element_mapping, only: two_pi
   use face_overlap, only: face_frame, find_point, map_point, seen_face, surface_vector, overlap_points, plane_points
   use interface_operator, only: interface_element
   use kinds, only: wp
   use lists, only: distinct, list_owners
   use tolerances, only: zero_area, zero_weight
   implicit none
   private

   public :: add_overlap, fit_face, whole_shares, partial_shares

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
      !! of N_k times what curved surfaces are farther apart than their
      real(wp) :: bulge(max_side_nodes) = 0.0_wp
                                                                    !! chords [length^3]
      real(wp) :: along(3) = 0.0_wp                                 !! normal of the face, of bulges
      real(wp) :: area(max_side_nodes) = 0.0_wp                     !! of N_k [length^2]
      real(wp) :: normal(3, max_side_nodes) = 0.0_wp                !! of N_k n, in global axes [length^2]
      real(wp) :: same_side(max_side_nodes, max_side_nodes) = 0.0_wp !! of N_k N_k' [length^2]
      integer, allocatable  :: node(:)                              !! the nodes opposite, positions in the model
      real(wp), allocatable :: opposite(:, :)                       !! (max_side_nodes, nodes opposite) of N_k N_j [length^2]
   end type cover_integrals

   !> The contribution of a face to the element at each of its nodes; zero at a node without an element.
   type, public :: face_part
      integer  :: n = 0                                                   !! number of nodes
      real(wp) :: area(max_side_nodes) = 0.0_wp                           !! [length^2]
      real(wp) :: normal(3, max_side_nodes) = 0.0_wp                      !! area times normal [length^2]
      real(wp) :: same_side(max_side_nodes, max_side_nodes) = 0.0_wp      !! (element, node k) area times weight [length^2]
      real(wp), allocatable :: opposite(:, :)                             !! (max_side_nodes, nodes opposite) likewise
      !! area times bulge, along the normal of the face [length^3]
      real(wp) :: bulge(3, max_side_nodes) = 0.0_wp
   end type face_part

   !> The sums of the interface elements at the nodes of a side.
   type, public :: interface_sums_type
      integer :: n_nodes = 0                        !! of the model
      real(wp), allocatable :: area(:)              !! (elements) [length^2]
      real(wp), allocatable :: normal(:, :)         !! (3, elements) area times normal
      real(wp), allocatable :: around(:)            !! (elements) area of all faces at the element
      real(wp), allocatable :: bulge(:, :)          !! (3, elements) area times bulge
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

   !> Add the integrals over the part of FACE that the face OPPOSITE, given in the frame of FACE, covers. A point is covered where
   !! the distance of the faces along the normal of FACE is at most the reach.
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
      integrals%along = face%frame%axes(:, 3)
      if (.not. allocated(integrals%node)) allocate (integrals%node(0), integrals%opposite(max_side_nodes, 0))
      do j = 1, size(nodes)
         column(j) = findloc(integrals%node, nodes(j), dim=1)
         if (column(j) > 0) cycle
         integrals%node = [integrals%node, nodes(j)]
         column(j) = size(integrals%node)
         integrals%opposite = reshape(integrals%opposite, [max_side_nodes, column(j)], pad=[0.0_wp])
      end do
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
            if (face%seen%is_curved .or. opposite%is_curved) integrals%bulge(:n) = integrals%bulge(:n) + &
               n_1(:n)*(weight*(rise(opposite, points%place(:, i), x_2(3)) - rise(face%seen, points%place(:, i), x_1(3))))
            do j = 1, n
               integrals%area(j) = integrals%area(j) + weight*n_1(j)
               integrals%normal(:, j) = integrals%normal(:, j) + surface*n_1(j)
               integrals%same_side(:n, j) = integrals%same_side(:n, j) + (weight*n_1(j))*n_1(:n)
            end do
            do j = 1, size(nodes)
               integrals%opposite(:n, column(j)) = integrals%opposite(:n, column(j)) + (weight*n_2(j))*n_1(:n)
            end do
         end do
      end associate
   end subroutine add_overlap

   !> How far the curved surface of FACE lies above the point of its chords at PLACE, whose height is CHORD, in the frame of another
   !! face. The foot of the point of the surface on FACE lies beside PLACE where the faces are not parallel.
   pure real(wp) function rise(face, place, chord)
      type(seen_face), intent(in) :: face
      real(wp), intent(in)        :: place(2), chord
      real(wp) :: foot(3), height, n(max_nodes), point(3)
      logical  :: found
      integer  :: i

      rise = 0.0_wp
      if (.not. face%is_curved) return
      height = 0.0_wp
      do i = 1, 3
         call find_point(face, place - height*face%normal(:2), point, found)
         if (.not. found) return
         height = height_over_chords(face%x(:, :face%n), face%tilt, point)
      end do
      call map_point(face, point, n, foot)
      rise = foot(3) + height*face%normal(3) - chord
   end function rise

   !> PART from the INTEGRALS over a face with N nodes. A fully covered face: the displacements u2 of SIDE2 are fitted by least
   !! squares, u2_k = sum of (M^-1)_kl times the integral of N_l u2, where M is the integral of N_k N_l. The fit is exact where the
   !! shape functions of the face represent u2, and a node opposite its partner is connected to the partner only. A partly covered
   !! face: the displacements of both sides are averaged over the covered part, with the functions phi_i of the elements as weights.
   pure subroutine fit_face(dimension, n, is_whole, integrals, part)
      integer, intent(in)               :: dimension, n
      logical, intent(in)               :: is_whole
      type(cover_integrals), intent(in) :: integrals
      type(face_part), intent(inout)    :: part
      real(wp) :: share(max_side_nodes, max_side_nodes), fitted(n, size(integrals%node)), bulge(n, 1)
      integer  :: k

      part%n = n
      if (is_whole) then
         share = whole_shares(dimension, n)
         call solve_symmetric(integrals%same_side(:n, :n), integrals%opposite(:n, :), fitted)
         do k = 1, n
            part%same_side(:, k) = share(:, k)*integrals%area(k)
         end do
         part%opposite = matmul(part%same_side(:, :n), fitted)
         bulge(:, 1) = integrals%bulge(:n)
         if (any(abs(bulge) > 0.0_wp)) &
            call solve_symmetric(integrals%same_side(:n, :n), reshape(integrals%bulge(:n), [n, 1]), bulge)
         part%bulge = matmul(reshape(integrals%along, [3, 1]), transpose(matmul(part%same_side(:, :n), bulge)))
      else
         share = partial_shares(dimension, n)
         part%same_side(:, :n) = matmul(share(:, :n), integrals%same_side(:n, :n))
         part%opposite = matmul(share(:, :n), integrals%opposite(:n, :))
         bulge(:, 1) = integrals%bulge(:n)
         part%bulge = matmul(reshape(integrals%along, [3, 1]), transpose(matmul(share(:, :n), bulge)))
      end if
      part%area = matmul(share(:, :n), integrals%area(:n))
      part%normal = matmul(integrals%normal(:, :n), transpose(share(:, :n)))
   end subroutine fit_face

   !> X of M X = B, M symmetric and positive definite.
   pure subroutine solve_symmetric(m, b, x)
      real(wp), intent(in)  :: m(:, :), b(:, :)
      real(wp), intent(out) :: x(:, :)
      real(wp) :: factor(size(m, 1), size(m, 1))
      integer  :: info

      factor = m
      x = b
      call dposv('L', size(x, 1), size(x, 2), factor, size(x, 1), x, size(x, 1), info)
      if (info > 0) x = ieee_value(1.0_wp, ieee_quiet_nan) ! the shape functions of the face are linearly dependent
   end subroutine solve_symmetric

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
      if (dimension == 2 .or. n <= 4) return
      corners = n/2
      do k = 1, corners
         share(k, k) = 0.0_wp
         share(corners + k, k) = 0.5_wp
         share(corners + k, modulo(k, corners) + 1) = 0.5_wp
      end do
   end function whole_shares

   !> Shares of a partly covered face: the element at node i has the function phi_i = sum of SHARE(i, k) N_k, which is nowhere
   !! negative on the face: N_i itself on a linear face; ((1-s)/2)^2, ((1+s)/2)^2 and (1-s^2)/2 on an edge with three nodes;
   !! (L1+L2)/2 for the sides of a triangle, (1-eta)/4 and so on for a quadrilateral. The N_k represent these polynomials exactly;
   !! the shares are the values at the nodes.
   pure function partial_shares(dimension, n) result(share)
      integer, intent(in) :: dimension, n !! as above
      real(wp) :: share(max_side_nodes, max_side_nodes)
      integer  :: corners, k

      share = whole_shares(dimension, n)
      if (dimension == 2) then
         if (n == 3) share(:3, 3) = [0.25_wp, 0.25_wp, 0.5_wp]
         return
      end if
      if (n <= 4) return
      corners = n/2
      do k = corners + 1, n ! 1/2 on its side, 1/4 on the adjacent sides, 0 on the opposite side of a quadrilateral
         share(corners + 1:n, k) = 0.25_wp
         share(k, k) = 0.5_wp
         if (corners == 4) share(5 + modulo(k - 3, 4), k) = 0.0_wp
      end do
   end function partial_shares

   !> Empty sums for N elements of a model with N_NODES nodes.
   pure subroutine start(self, n, n_nodes)
      class(interface_sums_type), intent(inout) :: self
      integer, intent(in)                       :: n, n_nodes

      self%n_nodes = n_nodes
      self%n = 0
      allocate (self%area(n), self%around(n), source=0.0_wp)
      allocate (self%normal(3, n), self%bulge(3, n), source=0.0_wp)
      allocate (self%owner(100), self%key(100), self%weight(100))
   end subroutine start

   !> Add the contribution of a face to the elements at its nodes.
   pure subroutine add_face(self, elements, nodes, opposite, part)
      class(interface_sums_type), intent(inout) :: self
      integer, intent(in)         :: elements(:) !! at its nodes, 0: none
      integer, intent(in)         :: nodes(:)    !! its nodes, positions in the model
      integer, intent(in)         :: opposite(:) !! the nodes opposite; none: a rigid base
      type(face_part), intent(in) :: part
      integer :: i, k

      do i = 1, part%n
         if (elements(i) == 0 .or. all(abs(part%same_side(i, :part%n)) <= 0.0_wp)) cycle
         self%area(elements(i)) = self%area(elements(i)) + part%area(i)
         self%normal(:, elements(i)) = self%normal(:, elements(i)) + part%normal(:, i)
         self%bulge(:, elements(i)) = self%bulge(:, elements(i)) + part%bulge(:, i)
         self%around(elements(i)) = self%around(elements(i)) + sum(abs(part%area(:part%n)))
         associate (key => [nodes(:part%n), self%n_nodes + opposite], &
                    weight => [part%same_side(i, :part%n), part%opposite(i, :size(opposite))])
            do k = 1, size(key)
               if (abs(weight(k)) <= 0.0_wp) cycle
               if (self%n == size(self%owner)) then
                  self%owner = [self%owner, self%owner]
                  self%key = [self%key, self%key]
                  self%weight = [self%weight, self%weight]
               end if
               self%n = self%n + 1
               self%owner(self%n) = elements(i)
               self%key(self%n) = key(k)
               self%weight(self%n) = weight(k)
            end do
         end associate
      end do
   end subroutine add_face

   !> Close the sums after the last face: sort the entries by element.
   pure subroutine finish(self)
      class(interface_sums_type), intent(inout) :: self

      call list_owners(size(self%area), reshape(self%owner(:self%n), [1, self%n]), self%first, self%entry)
   end subroutine finish

   !> Whether element I has an area, > 0.
   elemental logical function has_area(self, i)
      class(interface_sums_type), intent(in) :: self
      integer, intent(in)                    :: i

      has_area = self%area(i) > zero_area*self%around(i)
   end function has_area

   !> Whether the area of element I is zero to rounding: at a corner on the axis, or far from the covered part of a face.
   elemental logical function has_none(self, i)
      class(interface_sums_type), intent(in) :: self
      integer, intent(in)                    :: i

      has_none = abs(self%area(i)) <= zero_area*self%around(i)
   end function has_none

   !> Connect ELEMENT to the nodes of its entries at I, each once, the nodes of an end in ascending order.
   pure subroutine connect(self, i, element)
      class(interface_sums_type), intent(in) :: self
      integer, intent(in)                    :: i       !! has_area(i)
      type(interface_element), intent(inout) :: element
      integer, allocatable  :: node(:)
      real(wp), allocatable :: weight(:)
      integer :: k, n_1

      associate (entries => self%entry(self%first(i):self%first(i + 1) - 1))
         associate (keys => self%key(entries), weights => self%weight(entries))
            call distinct(keys, node)
            allocate (weight, source=[(sum(weights, mask=keys == node(k)), k = 1, size(node))])
         end associate
      end associate
      weight = weight/self%area(i)
      n_1 = count(node <= self%n_nodes)
      call make_whole(weight(:n_1))
      call make_whole(weight(n_1 + 1:))
      element%n_1 = count(abs(weight(:n_1)) > 0.0_wp)
      element%weight = pack([weight(:n_1), -weight(n_1 + 1:)], abs(weight) > 0.0_wp)
      element%node = pack(merge(node, node - self%n_nodes, node <= self%n_nodes), abs(weight) > 0.0_wp)
      element%area = self%area(i)
      element%bulge = self%bulge(:, i)/self%area(i)
   end subroutine connect

   !> Set the weights of an end that are rounding to zero, and correct the largest weight so that the sum is 1.
   pure subroutine make_whole(weight)
      real(wp), intent(inout) :: weight(:)
      integer :: largest

      where (abs(weight) < zero_weight) weight = 0.0_wp
      largest = maxloc(abs(weight), dim=1)
      if (largest > 0) weight(largest) = weight(largest) + (1.0_wp - sum(weight))
   end subroutine make_whole

end module mortar_integrals
