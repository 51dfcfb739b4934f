!> Interface elements that hang on lists of nodes, and models of them.
module element_lists
   use interface_operator, only: interface_element
   use kinds, only: wp
   use model_data, only: model_type
   implicit none
   private

   public :: on_lists, some_axes, connect_lists

contains

   !> The element whose ends are these nodes with these weights; no nodes at end 2: a rigid base.
   pure function on_lists(nodes_1, weights_1, nodes_2, weights_2, axes) result(element)
      integer, intent(in)  :: nodes_1(:), nodes_2(:)
      real(wp), intent(in) :: weights_1(:), weights_2(:), axes(3, 3)
      type(interface_element) :: element

      element%n_1 = size(nodes_1)
      element%node = [nodes_1, nodes_2]
      element%weight = [weights_1, -weights_2]
      element%area = 1.0_wp
      element%axes = axes
   end function on_lists

   !> Axes of a joint whose x is turned by ANGLE about Z, and its y by TILT out of Z; no tilt: a joint in the plane.
   pure function some_axes(angle, tilt) result(axes)
      real(wp), intent(in) :: angle, tilt
      real(wp) :: axes(3, 3)

      associate (c => cos(angle), s => sin(angle))
         axes(:, 1) = [c, s, 0.0_wp]
         axes(:, 2) = [s*sin(tilt), -c*sin(tilt), cos(tilt)]
         axes(:, 3) = [s*cos(tilt), -c*cos(tilt), -sin(tilt)]
      end associate
   end function some_axes

   !> From now on every interface element of MODEL hangs on its own nodes and those of a neighbour in its joint: end 1 in the ratio
   !! 3:1, end 2, where there is one, on their mean.
   pure subroutine connect_lists(model)
      type(model_type), intent(inout) :: model
      type(interface_element), allocatable :: pairs(:)
      integer :: i, j

      allocate (pairs, source=model%joints%element)
      do j = 1, size(model%joints%list)
         do i = model%joints%list(j)%first, model%joints%list(j)%last
            associate (own => pairs(i)%node, next => pairs(merge(i + 1, i - 1, i < model%joints%list(j)%last))%node)
               model%joints%element(i)%n_1 = 2
               model%joints%element(i)%node = [own(1), next(1), own(2:), next(2:)]
               model%joints%element(i)%weight = [0.75_wp, 0.25_wp, spread(-0.5_wp, 1, 2*size(own) - 2)]
            end associate
         end do
      end do
   end subroutine connect_lists

end module element_lists
