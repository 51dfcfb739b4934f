!> The resultant of a joint, the rigid-body movement of its sides against each other, and its six stiffnesses. The components
!! are given in the joint's axes: forces (movements) along x, y and the normal z, moments (rotations) about them.
module joint_motion
   use analysis_state, only: analysis_type, element_force
   use interface_operator, only: at_first_end
   use joint_sides, only: straight
   use kinds, only: wp
   use model_data, only: joint_frame, joint_type, model_type
   use normal_stiffness, only: branch_open
   use numbers, only: cross
   implicit none
   private

   public :: find_resultant, rigid_movement, stiffness_about

   !> The force and moment of side 1 on side 2.
   type, public :: joint_resultant
      real(wp) :: normal = 0.0_wp           !! N: sum of the normal forces of the elements, compression positive [force]
      real(wp) :: along(2) = 0.0_wp         !! sums of the shear forces in the elements' own x and y [force]
      real(wp) :: shear(3) = 0.0_wp         !! the same as a vector, global axes [force]
      real(wp) :: force(3) = 0.0_wp         !! total, global axes [force]
      real(wp) :: moment(3) = 0.0_wp        !! about the centroid of the area, global axes [force x length]
   end type joint_resultant

contains

   !> The present resultant of JOINT.
   pure function find_resultant(model, analysis, joint) result(total)
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      type(joint_type), intent(in)    :: joint
      type(joint_resultant) :: total
      real(wp) :: force(3)
      integer  :: i

      do i = joint%first, joint%last
         associate (element => model%interface(i), state => analysis%states(i))
            force = element_force(element, state)
            total%force = total%force + force
            total%moment = total%moment + cross(at_first_end(element, model%x) - joint%frame%centroid, force)
            total%normal = total%normal + state%normal%sumf
            total%along = total%along + state%shear%tau*element%area
            total%shear = total%shear + matmul(element%axes(:, :2), state%shear%tau*element%area)
         end associate
      end do
   end function find_resultant

   !> Rigid-body movement of side 1 against side 2, fitted to the deflections {d} of the elements that are not open (delta_x,
   !! delta_y, lambda as in the joint history) by least squares weighted with their areas. The translation at the centroid s of
   !! these elements is the mean of {d}. The rotation {t} follows from [J] {t} = sum a (r - s) x {d}, [J] their inertia. The
   !! result is the movement of the point at the centroid of the joint. Elements on one line do not determine the rotation about
   !! it: it is set to 0 [length; radians].
   pure function rigid_movement(model, analysis, joint) result(q)
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      type(joint_type), intent(in)    :: joint
      real(wp) :: q(6), area, arm(3), d(3), inertia(3, 3), mean(3), moment(3), place(3)
      integer  :: i

      q = 0.0_wp
      area = 0.0_wp
      place = 0.0_wp
      mean = 0.0_wp
      do i = joint%first, joint%last
         if (analysis%states(i)%normal%branch == branch_open) cycle
         area = area + model%interface(i)%area
         place = place + model%interface(i)%area*arm_of(model, joint%frame, i)
         mean = mean + model%interface(i)%area*deflection_of(model, analysis, joint, i)
      end do
      if (.not. area > 0.0_wp) return
      place = place/area
      mean = mean/area
      inertia = 0.0_wp
      moment = 0.0_wp
      do i = joint%first, joint%last
         if (analysis%states(i)%normal%branch == branch_open) cycle
         arm = arm_of(model, joint%frame, i) - place
         d = deflection_of(model, analysis, joint, i) - mean
         inertia = inertia + model%interface(i)%area*inertia_of(arm)
         moment = moment + model%interface(i)%area*cross(arm, d)
      end do
      q(4:) = merge(smallest_turn(inertia, moment, straight*area*joint%frame%extent**2), 0.0_wp, joint%frame%exists(4:))
      q(:3) = merge(mean - cross(q(4:), place), 0.0_wp, joint%frame%exists(:3))
   end function rigid_movement

   !> Deflection of interface element I in the axes of JOINT [length].
   pure function deflection_of(model, analysis, joint, i) result(d)
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      type(joint_type), intent(in)    :: joint
      integer, intent(in)             :: i
      real(wp) :: d(3)

      d(:2) = merge(analysis%states(i)%shear%delta, analysis%movement(:2, i), joint%law%shear%given)
      d(3) = analysis%states(i)%normal%lambda
      d = matmul(model%interface(i)%axes, d)
      d = matmul(d, joint%frame%axes)
   end function deflection_of

   !> The smallest {t} with [J] {t} = {moment}. For elements on one line along e, [J] = J ([1] - e e^T) and {t} = {moment}/J.
   pure function smallest_turn(inertia, moment, least) result(turn)
      real(wp), intent(in) :: inertia(3, 3) !! [J] about the centroid of the elements
      real(wp), intent(in) :: moment(3)
      real(wp), intent(in) :: least         !! below it all elements are at one point
      real(wp) :: turn(3), determinant, j, minors(3, 3)

      turn = 0.0_wp
      j = 0.5_wp*(inertia(1, 1) + inertia(2, 2) + inertia(3, 3))
      if (j <= least) return
      minors(:, 1) = cross(inertia(:, 2), inertia(:, 3))
      minors(:, 2) = cross(inertia(:, 3), inertia(:, 1))
      minors(:, 3) = cross(inertia(:, 1), inertia(:, 2))
      determinant = dot_product(inertia(:, 1), minors(:, 1))
      if (determinant > straight*j**3) then
         turn = matmul(minors, moment)/determinant
      else
         turn = moment/j
      end if
   end function smallest_turn

   !> The stiffness of each of the six rigid-body movements with the five others held: {m}^T [k] {m} summed over the elements
   !! [force/length; force x length].
   pure function stiffness_about(model, joint, k) result(total)
      type(model_type), intent(in)  :: model
      type(joint_type), intent(in)  :: joint
      real(wp), intent(in)          :: k(:, :) !! (3, n) of all interface elements, in their own axes [force/length]
      real(wp) :: total(6), moved(3) ! by a unit rigid-body movement along or about an axis
      integer  :: c, i

      total = 0.0_wp
      do i = joint%first, joint%last
         do c = 1, 6
            moved = 0.0_wp
            moved(modulo(c - 1, 3) + 1) = 1.0_wp
            if (c > 3) moved = cross(moved, arm_of(model, joint%frame, i))
            moved = matmul(joint%frame%axes, moved)
            moved = matmul(moved, model%interface(i)%axes)
            total(c) = total(c) + dot_product(k(:, i), moved**2)
         end do
      end do
      total = merge(total, 0.0_wp, joint%frame%exists)
   end function stiffness_about

   !> Vector from the centroid to the point of interface element I, in the axes of FRAME [length].
   pure function arm_of(model, frame, i) result(arm)
      type(model_type), intent(in)  :: model
      type(joint_frame), intent(in) :: frame
      integer, intent(in)           :: i
      real(wp) :: arm(3)

      arm = at_first_end(model%interface(i), model%x) - frame%centroid
      arm = matmul(arm, frame%axes)
   end function arm_of

   !> The moments of inertia of a unit area at distance ARM.
   pure function inertia_of(arm) result(inertia)
      real(wp), intent(in) :: arm(3)
      real(wp) :: inertia(3, 3)
      integer  :: c

      inertia = -spread(arm, 2, 3)*spread(arm, 1, 3)
      do c = 1, 3
         inertia(c, c) = inertia(c, c) + dot_product(arm, arm)
      end do
   end function inertia_of

end module joint_motion
