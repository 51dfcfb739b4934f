!> Interface elements added up from faces: areas, normals and the lists of nodes of their two ends, each face with its area as
!! weight.
module interface_sums
   use face_fit, only: face_part
   use id_table, only: sorted_order
   use interface_operator, only: interface_element
   use kinds, only: wp
   use reverse_lists, only: list_owners
   implicit none
   private

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

end module interface_sums
