!> How the unknowns of a node go when the structure moves as a rigid body. Those of a point are its displacements, along global axes
!! or along its system CD; those of a node of rotations are the rotation times its arm; a section does not open.
module unknown_motions
   use kinds, only: wp
   use model_data, only: model_type, n_points, n_rotations
   use reference_nodes, only: node_axes, rotation_component
   use vector_product, only: cross
   implicit none
   private

   public :: n_motions, is_ordinary, motions_of, motions_at

contains

   !> Three in the plane, six in space: along the axes, then about them.
   pure integer function n_motions(dimension)
      integer, intent(in) :: dimension

      n_motions = merge(6, 3, dimension == 3)
   end function n_motions

   !> Whether the unknowns of NODE are its displacements in global axes.
   pure logical function is_ordinary(model, node)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: node

      is_ordinary = node <= n_points(model)
      if (is_ordinary .and. allocated(model%node_system)) is_ordinary = model%node_system(node) == 0
   end function is_ordinary

   !> Displacements of a point at X: (dimension, motions).
   pure function motions_at(x) result(u)
      real(wp), intent(in) :: x(:) !! (dimension) [length]
      real(wp) :: u(size(x), n_motions(size(x)))
      integer  :: c, d

      d = size(x)
      u = 0.0_wp
      do c = 1, d
         u(c, c) = 1.0_wp
      end do
      if (d == 2) then
         u(:, 3) = [-x(2), x(1)]
      else
         do c = 1, 3
            u(:, 3 + c) = cross(u(:, c), x)
         end do
      end if
   end function motions_at

   !> Unknowns of NODE: (dimension, motions).
   pure function motions_of(model, node) result(q)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: node
      real(wp) :: q(model%dimension, n_motions(model%dimension))
      real(wp) :: axes(3, 3)
      integer  :: d, r

      d = model%dimension
      q = 0.0_wp
      if (node <= n_points(model)) then
         axes = node_axes(model, node)
         q = matmul(transpose(axes(:d, :d)), motions_at(model%x(:d, node)))
      else if (node <= n_points(model) + n_rotations(model)) then
         r = findloc(model%rotations%node, node, dim=1)
         associate (point => model%rotations(r)%point, arm => model%rotations(r)%arm)
            if (d == 2) then
               q(rotation_component(model, 6), 3) = arm ! about z, whichever way the system CD has it
            else
               q(:, 4:) = arm*transpose(node_axes(model, point))
            end if
         end associate
      end if
   end function motions_of

end module unknown_motions
