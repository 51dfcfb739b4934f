!> Components of joint nodes on which no joint acts. Where no joint has a shear law, the faces slide on each other: interface
!! elements have stiffness along their normals only. Where the normals are parallel to axes, the other components of the nodes
!! can be eliminated with the bodies, once. Only the components along the normals remain for the increments.
!!
!! In the node graph such a node is divided in two: the node itself keeps its sliding components, and a twin behind all nodes
!! has those along the normals.
module sliding_components
   use interface_operator, only: interface_element
   use model_data, only: model_type, n_sections
   use node_coupling, only: list_on_unknowns
   use node_graph, only: node_graph_type
   use tolerances, only: rounding_of_entries
   implicit none
   private

   public :: find_sliding, divide_nodes

contains

   !> SLIDES(d, node): component d is free, and the interface elements at the node have no stiffness along it. JOINED lists the
   !! nodes that interface elements couple, then those of bars, as list_joined does: bars act on all components.
   pure function find_sliding(model, joined) result(slides)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: joined(:, :)
      logical :: slides(model%mesh%dimension, model%mesh%n_nodes)
      type(interface_element), allocatable :: elements(:)
      integer :: d, i, k

      slides = .false.
      if (any(model%joints%list%law%shear(1)%given .or. model%joints%list%law%shear(2)%given)) return
      call list_on_unknowns(model, elements)
      do i = 1, size(elements)
         slides(:, elements(i)%node) = .true.
      end do
      do i = 1, size(elements)
         do k = 1, size(elements(i)%node)
            do d = 1, model%mesh%dimension
               if (allocated(elements(i)%map) .or. abs(elements(i)%axes(d, 3)) > rounding_of_entries) &
                  slides(d, elements(i)%node(k)) = .false.
            end do
         end do
      end do
      do i = size(elements) + 1, size(joined, 2)
         slides(:, pack(joined(:, i), joined(:, i) > 0)) = .false.
      end do
      if (n_sections(model%mesh) > 0) slides(:, model%mesh%sections%node) = .false.
      slides = slides .and. .not. model%freedoms%held
   end function find_sliding

   !> Divide the nodes of GRAPH that have both SLIDING components, so many, and others. All nodes of joints with sliding components
   !! leave IN_JOINT; their twins, where they have any, take their place. A twin has all neighbours of its node, and the node
   !! itself. NODE lists the nodes of GRAPH that the nodes of the DIVIDED graph are; ORDER, WEIGHT and IN_JOINT get the twins.
   pure subroutine divide_nodes(graph, sliding, order, weight, in_joint, divided, node)
      type(node_graph_type), intent(in)   :: graph
      integer, intent(in)                 :: sliding(:)  !! (graph%n) unknowns
      integer, allocatable, intent(inout) :: order(:), weight(:)
      logical, allocatable, intent(inout) :: in_joint(:)
      type(node_graph_type), intent(out)  :: divided
      integer, allocatable, intent(out)   :: node(:)     !! (divided%n)
      integer :: twin(graph%n) ! 0: none
      integer :: i, k, m, other

      node = pack([(i, i = 1, graph%n)], sliding > 0 .and. weight > sliding)
      twin = 0
      twin(node) = [(graph%n + i, i = 1, size(node))]
      order = [order, twin(node)]
      in_joint = [in_joint .and. sliding == 0, spread(.true., 1, size(node))]
      weight = [merge(sliding, weight, sliding > 0), weight(node) - sliding(node)]
      node = [(i, i = 1, graph%n), node]

      divided%n = size(node)
      allocate (divided%first(divided%n + 1))
      m = 0
      do i = 1, divided%n
         associate (near => graph%neighbours(graph%first(node(i)):graph%first(node(i) + 1) - 1))
            divided%first(i) = m + 1
            m = m + size(near) + count(twin(near) > 0) + merge(1, 0, twin(node(i)) > 0)
         end associate
      end do
      divided%first(divided%n + 1) = m + 1
      allocate (divided%neighbours(m))
      m = 0
      do i = 1, divided%n
         if (twin(node(i)) > 0) then
            m = m + 1
            divided%neighbours(m) = merge(node(i), twin(node(i)), i > graph%n)
         end if
         do k = graph%first(node(i)), graph%first(node(i) + 1) - 1
            other = graph%neighbours(k)
            m = m + 1
            divided%neighbours(m) = other
            if (twin(other) == 0) cycle
            m = m + 1
            divided%neighbours(m) = twin(other)
         end do
      end do
   end subroutine divide_nodes

end module sliding_components
