!> The axes of interface elements: along the joint, and across it from node 1 to node 2.
module interface_axes
   use kinds, only: wp
   use model_data, only: corners_of, model_type
   use vector_product, only: cross
   implicit none
   private

   public :: joint_axes, outward

contains

   !> Axes of an interface element with normal Z (unit): columns x, y, z, right-handed. In the plane x lies in the joint and y
   !! out of the plane; x points towards +X (+Y where the joint stands upright). In space x is +X projected on the joint, or +Y
   !! where the normal is within 25 degrees of X.
   pure function joint_axes(model, z) result(axes)
      type(model_type), intent(in) :: model
      real(wp), intent(in)         :: z(3)
      real(wp) :: axes(3, 3), x(3)

      if (model%dimension == 3) then
         x = [1.0_wp, 0.0_wp, 0.0_wp]
         if (abs(z(1)) > 0.9_wp) x = [0.0_wp, 1.0_wp, 0.0_wp]
         x = x - dot_product(x, z)*z
         x = x/norm2(x)
      else
         x = [-z(2), z(1), 0.0_wp]
         if (x(1) < -1.0e-9_wp .or. (abs(x(1)) <= 1.0e-9_wp .and. x(2) < 0.0_wp)) x = -x
      end if
      axes(:, 1) = x
      axes(:, 2) = cross(z, x)
      axes(:, 3) = z
   end function joint_axes

   !> The normal of a CJOINT in the sense from node 1 to node 2: out of the body at node 1, else into the body at node 2,
   !! else as given. (The card gives the line; its sense follows from where the bodies lie.)
   pure function outward(model, nodes, normal) result(z)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: nodes(2)
      real(wp), intent(in)         :: normal(3)
      real(wp) :: z(3), towards
      integer  :: side

      z = normal
      do side = 1, 2
         if (nodes(side) == 0) cycle
         towards = body_side(model, nodes(side), normal)
         if (abs(towards) > 0.0_wp) then
            if ((side == 1) .eqv. (towards > 0.0_wp)) z = -normal
            return
         end if
      end do
   end function outward

   !> +1 where the body at NODE lies in the direction of NORMAL, -1 where against it, 0 where it cannot be told.
   pure real(wp) function body_side(model, node, normal) result(side)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: node
      real(wp), intent(in)         :: normal(3)
      real(wp) :: to_body(3)
      integer  :: i

      to_body = 0.0_wp
      do i = model%first_at(node), model%first_at(node + 1) - 1
         associate (corners => corners_of(model, model%elements_at(i)))
            if (any(corners == 0)) cycle
            to_body = to_body + sum(model%x(:, corners), dim=2)/size(corners) - model%x(:, node)
         end associate
      end do
      side = 0.0_wp
      if (abs(dot_product(to_body, normal)) > 0.05_wp*norm2(to_body)) side = sign(1.0_wp, dot_product(to_body, normal))
   end function body_side

end module interface_axes
