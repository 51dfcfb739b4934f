!> The operator of an interface element: the nodes and weights of its two ends, its movement, forces and stiffness.
!! Each end is a list of nodes with weights whose sum is 1; end 2 of an element on a rigid base has no nodes. The movement of end 1
!! relative to end 2 is the sum of weight times displacement, with negative weights for end 2. No other module uses these lists.
!!
!!      end 1    o  o    v_k, sum 1        movement   d = sum v_k u_k - sum w_j u_j
!!                \/                       force F    -v_k F on the nodes of end 1, +w_j F on those of end 2
!!                [k]                      stiffness  s_a s_b [k] between nodes a and b, s = v or -w
!!                /\
!!      end 2    o  o    w_j, sum 1        Two facing nodes are the lists (1), (1).
module interface_operator
   use kinds, only: wp
   implicit none
   private

   public :: connect_nodes, named_node, nodes_of_end, weights_of_end, at_first_end, relative_movement, &
             joint_movement, add_force, add_global_force, global_stiffness

   !> One interface element: the "beam" between two faces, or a face and the rigid base.
   type, public :: interface_element
      integer  :: id = 0
      integer  :: joint = 0
      integer  :: n_1 = 0                    !! number of nodes of end 1; the nodes of end 2 follow
      integer  :: named = 0                  !! the node reported for end 1 where it has several nodes, 0: none
      integer, allocatable  :: node(:)       !! positions
      real(wp), allocatable :: weight(:)     !! of each displacement: the weighted sum is the movement of end 1 relative to end 2
      real(wp), allocatable :: map(:, :, :)  !! (dimension, dimension, nodes) replaces the weights where nodes are coupled: the
                                             !! movement is the sum of map times the unknowns of the nodes
      real(wp) :: area = 0.0_wp              !! a_i [length^2]
      real(wp) :: gap = 0.0_wp               !! g: closing at which the faces touch; negative: interference [length]
      real(wp) :: bulge(3) = 0.0_wp          !! from what curved faces are farther apart along z than their chords [length]
      real(wp) :: axes(3, 3) = 0.0_wp        !! columns: x, y in the joint, z its normal from end 1 to end 2
   end type interface_element

contains

   !> Connect ELEMENT to two facing nodes, one per end. NODE_2 = 0 is a rigid base; NODE_1 = 0 leaves an element without nodes,
   !! in a deck with errors.
   pure subroutine connect_nodes(element, node_1, node_2)
      type(interface_element), intent(inout) :: element
      integer, intent(in)                    :: node_1, node_2

      associate (is_there => [node_1, node_2] > 0)
         element%n_1 = merge(1, 0, is_there(1))
         element%node = pack([node_1, node_2], is_there)
         element%weight = pack([1.0_wp, -1.0_wp], is_there)
      end associate
   end subroutine connect_nodes

   !> The nodes of END 1 or 2; none: a rigid base.
   pure function nodes_of_end(element, end) result(nodes)
      type(interface_element), intent(in) :: element
      integer, intent(in)                 :: end
      integer, allocatable :: nodes(:)

      if (end == 1) nodes = element%node(:element%n_1)
      if (end == 2) nodes = element%node(element%n_1 + 1:)
   end function nodes_of_end

   !> The weights of the nodes of END 1 or 2, as positive numbers.
   pure function weights_of_end(element, end) result(weights)
      type(interface_element), intent(in) :: element
      integer, intent(in)                 :: end
      real(wp), allocatable :: weights(:)

      if (end == 1) weights = abs(element%weight(:element%n_1))
      if (end == 2) weights = abs(element%weight(element%n_1 + 1:))
   end function weights_of_end

   !> The node that output and messages name for END 1 or 2: 0 for a rigid base, -1 where the end has several nodes and none is
   !! named.
   pure integer function named_node(element, end) result(node)
      type(interface_element), intent(in) :: element
      integer, intent(in)                 :: end

      associate (nodes => nodes_of_end(element, end))
         node = merge(0, -1, size(nodes) == 0)
         if (size(nodes) == 1) node = nodes(1)
      end associate
      if (end == 1 .and. element%named > 0) node = element%named
   end function named_node

   !> The weighted mean of nodal VALUES at end 1. For coordinates it is the point where the force acts.
   pure function at_first_end(element, values) result(mean)
      type(interface_element), intent(in) :: element
      real(wp), intent(in)                :: values(:, :) !! (components, nodes)
      real(wp) :: mean(size(values, 1))
      integer  :: a

      mean = 0.0_wp
      do a = 1, element%n_1
         mean = mean + element%weight(a)*values(:, element%node(a))
      end do
   end function at_first_end

   !> Movement of end 1 relative to end 2 in global axes; its third component is zero in the plane [length].
   pure function relative_movement(element, u) result(between)
      type(interface_element), intent(in) :: element
      real(wp), intent(in)                :: u(:, :) !! (dimension, nodes) [length]
      real(wp) :: between(3)
      integer  :: a, d

      d = size(u, 1)
      between = 0.0_wp
      do a = 1, size(element%node)
         if (allocated(element%map)) then
            between(:d) = between(:d) + matmul(element%map(:, :, a), u(:, element%node(a)))
         else
            between(:d) = between(:d) + element%weight(a)*u(:, element%node(a))
         end if
      end do
   end function relative_movement

   !> The movement in the axes of the element: tangential x, y, and the closing deflection lambda, Eq. (8) [length].
   pure function joint_movement(element, u) result(movement)
      type(interface_element), intent(in) :: element
      real(wp), intent(in)                :: u(:, :) !! (dimension, nodes) [length]
      real(wp) :: movement(3), between(3)

      between = relative_movement(element, u)
      movement = matmul(between, element%axes)
   end function joint_movement

   !> Add FORCE, in the axes of the element, to the nodal forces F: with its sign at end 1, with the opposite sign at end 2. The
   !! nodal force of an element is minus that of its stresses.
   pure subroutine add_force(element, force, f)
      type(interface_element), intent(in) :: element
      real(wp), intent(in)                :: force(3) !! [force]
      real(wp), intent(inout)             :: f(:, :)  !! (dimension, nodes) [force]

      call add_global_force(element, matmul(element%axes, force), f)
   end subroutine add_force

   !> Add FORCE in global axes to the nodal forces F, as add_force.
   pure subroutine add_global_force(element, force, f)
      type(interface_element), intent(in) :: element
      real(wp), intent(in)                :: force(3)
      real(wp), intent(inout)             :: f(:, :)
      integer :: a, d

      d = size(f, 1)
      do a = 1, size(element%node)
         if (allocated(element%map)) then
            f(:, element%node(a)) = f(:, element%node(a)) + matmul(force(:d), element%map(:, :, a))
         else
            f(:, element%node(a)) = f(:, element%node(a)) + element%weight(a)*force(:d)
         end if
      end do
   end subroutine add_global_force

   !> The stiffness K, given in the axes of the element, in global axes [force/length].
   pure function global_stiffness(element, k) result(in_global)
      type(interface_element), intent(in) :: element
      real(wp), intent(in)                :: k(3, 3)
      real(wp) :: in_global(3, 3)

      in_global = matmul(element%axes, matmul(k, transpose(element%axes)))
   end function global_stiffness

end module interface_operator
