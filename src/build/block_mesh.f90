!> The generator of block meshes: BLOCK2, a quadrilateral block, and BLOCK3, a box.
!! Nodes are numbered up each column first.
module block_mesh
   use bulk_data, only: block_card
   use element_kinds, only: kind_hexa20, kind_hexa8, kind_quad4, kind_quad8
   use kinds, only: wp
   implicit none
   private

   public :: generate_block

   !> The mesh of a block. Places are positions in its own node list.
   type, public :: block_type
      integer :: line = 0, id = 0, property = 0, weld = 0
      integer :: kind = 0                     !! of its elements
      integer, allocatable  :: node_id(:)
      real(wp), allocatable :: x(:, :)        !! (3, nodes)
      integer, allocatable  :: element_id(:)
      integer, allocatable  :: places(:, :)   !! (8, elements) of the corners, 0 behind the last
      integer :: n_sides = 0                  !! marked sides
      integer, allocatable  :: mark(:)        !! (n_sides) PMARK id
      integer, allocatable  :: number(:)      !! (n_sides) k: side Sk of the card
      integer, allocatable  :: side(:, :)     !! (4, n_sides) places of its corners, 0 behind the last
   end type block_type

contains

   !> The nodes, elements and marked sides of a CARD. Node (i, j, k) has the number N1 + (i (NY + 1) + j)(NZ + 1) + k, where i counts
   !! along x or side 1-2, j along y or side 1-4 and k along z, all from 0. Element numbers also run up each column, from E1.
   pure subroutine generate_block(card, block)
      type(block_card), intent(in)  :: card
      type(block_type), intent(out) :: block
      real(wp) :: r(0:card%divisions(1)), s(0:card%divisions(2)), t(0:card%divisions(3))
      integer  :: corner, i, j, k, m, n(3), step(3) ! step: increments of the place along x, y, z

      n = card%divisions
      step = [(n(2) + 1)*(n(3) + 1), n(3) + 1, 1]
      block%line = card%line
      block%id = card%id
      block%property = card%property
      block%weld = card%weld
      if (card%order == 2) then ! mid-edge nodes are added later, like those that cards leave blank
         block%kind = merge(kind_quad8, kind_hexa20, card%dimension == 2)
      else
         block%kind = merge(kind_quad4, kind_hexa8, card%dimension == 2)
      end if
      call graded_places(card%grading(1), r)
      call graded_places(card%grading(2), s)
      call graded_places(card%grading(3), t)
      allocate (block%node_id(product(n + 1)), block%x(3, product(n + 1)))
      m = 0
      do i = 0, n(1)
         do j = 0, n(2)
            do k = 0, n(3)
               m = m + 1
               block%node_id(m) = card%first_node + m - 1
               block%x(:, m) = point(card, r(i), s(j), t(k))
            end do
         end do
      end do
      n(3) = max(1, n(3))
      allocate (block%element_id(product(n)), block%places(8, product(n)), source=0)
      m = 0
      do i = 0, n(1) - 1
         do j = 0, n(2) - 1
            do k = 0, n(3) - 1
               m = m + 1
               block%element_id(m) = card%first_element + m - 1
               corner = 1 + dot_product([i, j, k], step)
               block%places(:4, m) = corner + [0, step(1), step(1) + step(2), step(2)]
               if (card%dimension == 3) block%places(5:, m) = block%places(:4, m) + step(3)
            end do
         end do
      end do
      m = merge(2*(n(1) + n(2)), 2*(n(1)*n(2) + n(2)*n(3) + n(3)*n(1)), card%dimension == 2)
      allocate (block%mark(m), block%number(m), block%side(4, m), source=0)
      if (card%dimension == 2) then
         do k = 1, 4
            call mark_edge(card, k, step, block)
         end do
      else
         do k = 1, 3
            call mark_face(card, k, .false., step, block)
         end do
         do k = 1, 3
            call mark_face(card, k, .true., step, block)
         end do
      end if
   end subroutine generate_block

   !> Position of the node of a block with the graded coordinates R, S, T in the unit square or cube: bilinear interpolation of the corners,
   !! in a box linear interpolation between its two corners.
   pure function point(card, r, s, t) result(x)
      type(block_card), intent(in) :: card
      real(wp), intent(in)         :: r, s, t
      real(wp) :: x(3)

      associate (c => card%corner)
         if (card%dimension == 3) then
            x = c(:, 1) + [r, s, t]*(c(:, 2) - c(:, 1))
         else
            x = (1.0_wp - r)*(1.0_wp - s)*c(:, 1) + r*(1.0_wp - s)*c(:, 2) + r*s*c(:, 3) + (1.0_wp - r)*s*c(:, 4)
         end if
      end associate
   end function point

   !> Coordinates 0 = s_0 < ... < s_n = 1 whose steps grow by a constant factor; the last step is RATIO times the first.
   pure subroutine graded_places(ratio, s)
      real(wp), intent(in)  :: ratio
      real(wp), intent(out) :: s(0:)
      real(wp) :: factor, step
      integer  :: i, n

      n = ubound(s, 1)
      s(0) = 0.0_wp
      if (n == 0) return
      factor = 1.0_wp
      if (n > 1) factor = ratio**(1.0_wp/(n - 1))
      step = 1.0_wp
      do i = 1, n
         s(i) = s(i - 1) + step
         step = step*factor
      end do
      if (abs(ratio - 1.0_wp) <= 0.0_wp) s = [(real(i, wp), i = 0, n)]
      s = s/s(n)
   end subroutine graded_places

   !> The marked edges on side NUMBER of a quadrilateral block (1: corners 1-2, 2: 2-3, 3: 3-4, 4: 4-1), in this order.
   pure subroutine mark_edge(card, number, step, block)
      type(block_card), intent(in)    :: card
      integer, intent(in)             :: number
      integer, intent(in)             :: step(3)
      type(block_type), intent(inout) :: block
      integer :: axis, first, i

      if (card%marks(number) == 0) return
      axis = 2 - modulo(number, 2)
      first = 1
      if (number == 2 .or. number == 3) first = first + card%divisions(1)*step(1)
      if (number >= 3) first = first + card%divisions(2)*step(2)
      do i = 0, card%divisions(axis) - 1
         call add_side(block, card%marks(number), number, first + [i, i + 1]*merge(step(axis), -step(axis), number < 3))
      end do
   end subroutine mark_edge

   !> The marked sides on one face of a box, at the beginning or end of AXIS. Their corners are counter-clockwise as seen from outside.
   pure subroutine mark_face(card, axis, at_end, step, block)
      type(block_card), intent(in)    :: card
      integer, intent(in)             :: axis    !! 1: x, 2: y, 3: z
      logical, intent(in)             :: at_end
      integer, intent(in)             :: step(3) !! increments of the place along x, y, z
      type(block_type), intent(inout) :: block
      integer :: a, b, corner, i, j, number, places(4)

      number = 2*axis - merge(0, 1, at_end)
      if (card%marks(number) == 0) return
      a = merge(2, 1, axis == 1) ! the two other axes, in ascending order
      b = merge(2, 3, axis == 3)
      do i = 0, card%divisions(a) - 1
         do j = 0, card%divisions(b) - 1
            corner = 1 + i*step(a) + j*step(b)
            if (at_end) corner = corner + card%divisions(axis)*step(axis)
            places = corner + [0, step(a), step(a) + step(b), step(b)]
            if (at_end .eqv. axis == 2) places = places(4:1:-1) ! y z, z x and x y are right-handed
            call add_side(block, card%marks(number), number, places)
         end do
      end do
   end subroutine mark_face

   pure subroutine add_side(block, mark, number, places)
      type(block_type), intent(inout) :: block
      integer, intent(in)             :: mark, number, places(:)

      block%n_sides = block%n_sides + 1
      block%mark(block%n_sides) = mark
      block%number(block%n_sides) = number
      block%side(:size(places), block%n_sides) = places
   end subroutine add_side

end module block_mesh
