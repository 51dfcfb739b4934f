!> A joint as a whole: its axes and centroid, what it transmits, how its sides move against each other as rigid bodies would, and
!! how stiffly. Six components in the joint's axes: forces (movements) along x, y and the normal z, moments (turns) about them.
module joint_motion
   use analysis_state, only: analysis_type, element_force
   use interface_operator, only: at_first_end
   use joint_sides, only: joint_axes
   use kinds, only: wp
   use model_data, only: joint_centroid, joint_type, model_type
   use normal_stiffness, only: branch_open
   use numbers, only: cross
   implicit none
   private

   public :: find_frame, is_closed, find_resultant, rigid_movement, stiffness_about

   real(wp), parameter :: closed_below = 0.1_wp ! length of the mean normal of a joint that faces all ways, as a pin in its bore
   real(wp), parameter :: straight = 1.0e-9_wp  ! of the largest moment of inertia, of the whole joint's: a turn that moves no element

   type, public :: joint_frame
      logical  :: closed = .false.          !! no mean normal: the axes are those of the model
      logical  :: exists(6) = .false.       !! movements that the model and the places of the elements have
      real(wp) :: axes(3, 3) = 0.0_wp       !! columns x, y, z
      real(wp) :: centroid(3) = 0.0_wp      !! of the area [length]
      real(wp) :: extent = 0.0_wp           !! largest distance of an element from it [length]
   end type joint_frame

   !> What side 1 transmits to side 2.
   type, public :: joint_resultant
      real(wp) :: normal = 0.0_wp           !! N: sum of the normal forces of the elements, compression positive [force]
      real(wp) :: along(2) = 0.0_wp         !! sums of the shear forces in the elements' own x and y [force]
      real(wp) :: shear(3) = 0.0_wp         !! the same as a vector, global axes [force]
      real(wp) :: force(3) = 0.0_wp         !! all of it, global axes [force]
      real(wp) :: moment(3) = 0.0_wp        !! about the centroid of the area, global axes [force x length]
   end type joint_resultant

contains

   !> Mean of the normals by area, 1 long where the joint is plane.
   pure function mean_normal(model, joint) result(normal)
      type(model_type), intent(in) :: model
      type(joint_type), intent(in) :: joint
      real(wp) :: normal(3)
      integer  :: i

      normal = 0.0_wp
      do i = joint%first, joint%last
         normal = normal + model%interface(i)%area*model%interface(i)%axes(:, 3)/joint%area
      end do
   end function mean_normal

   !> Whether JOINT faces all ways, so that its mean normal says nothing.
   pure logical function is_closed(model, joint)
      type(model_type), intent(in) :: model
      type(joint_type), intent(in) :: joint

      is_closed = norm2(mean_normal(model, joint)) < closed_below
   end function is_closed

   !> Axes and centroid of JOINT. The axes are those that an interface element with the mean normal has; of a closed joint the
   !! model's in space, in the plane z is +Y.
   pure function find_frame(model, joint) result(frame)
      type(model_type), intent(in) :: model
      type(joint_type), intent(in) :: joint
      type(joint_frame) :: frame
      real(wp) :: arm(3), inertia(3, 3), normal(3)
      integer  :: c, i

      normal = mean_normal(model, joint)
      if (model%axisymmetric) normal(1) = 0.0_wp ! all round the ring it is the part along the axis
      frame%closed = norm2(normal) < closed_below
      if (frame%closed) then
         normal = 0.0_wp
         normal(model%dimension) = 1.0_wp
      end if
      frame%axes = joint_axes(model, normal/norm2(normal))
      frame%centroid = joint_centroid(model, joint)
      inertia = 0.0_wp
      do i = joint%first, joint%last
         arm = arm_of(model, frame, i)
         frame%extent = max(frame%extent, norm2(arm))
         inertia = inertia + model%interface(i)%area*inertia_of(arm)
      end do
      frame%exists = .true.
      if (model%dimension == 2) frame%exists = [.true., .false., .true., .false., .true., .false.]
      if (model%axisymmetric) frame%exists = [.false., .false., .true., .false., .false., .false.]
      if (frame%extent <= straight*norm2(frame%centroid)) frame%exists(4:) = .false. ! all in one place, but for rounding
      do c = 1, 3
         frame%exists(3 + c) = frame%exists(3 + c) .and. inertia(c, c) > straight*maxval(inertia)
      end do
   end function find_frame

   !> What JOINT of this FRAME transmits now.
   pure function find_resultant(model, analysis, joint, frame) result(total)
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      type(joint_type), intent(in)    :: joint
      type(joint_frame), intent(in)   :: frame
      type(joint_resultant) :: total
      real(wp) :: force(3)
      integer  :: i

      do i = joint%first, joint%last
         associate (element => model%interface(i), state => analysis%states(i))
            force = element_force(element, state)
            total%force = total%force + force
            total%moment = total%moment + cross(at_first_end(element, model%x) - frame%centroid, force)
            total%normal = total%normal + state%normal%sumf
            total%along = total%along + state%shear%tau*element%area
            total%shear = total%shear + matmul(element%axes(:, :2), state%shear%tau*element%area)
         end associate
      end do
   end function find_resultant

   !> Movement of side 1 against side 2 as of rigid bodies, nearest to the deflections {d} of the elements that are not open
   !! (delta_x, delta_y, lambda as in the joint history) by least squares, their areas the weights: about the centroid s of these
   !! elements the mean of {d}, and the turn {t} with [J] {t} = sum a (r - s) x {d}, [J] their inertia. It is the movement of the point
   !! at the centroid of the joint. These elements do not tell the turn about a line on which all of them stand: it is 0 [length; radians].
   pure function rigid_movement(model, analysis, joint, frame) result(q)
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      type(joint_type), intent(in)    :: joint
      type(joint_frame), intent(in)   :: frame
      real(wp) :: q(6), area, arm(3), d(3), inertia(3, 3), mean(3), moment(3), place(3)
      integer  :: i

      q = 0.0_wp
      area = 0.0_wp
      place = 0.0_wp
      mean = 0.0_wp
      do i = joint%first, joint%last
         if (analysis%states(i)%normal%branch == branch_open) cycle
         area = area + model%interface(i)%area
         place = place + model%interface(i)%area*arm_of(model, frame, i)
         mean = mean + model%interface(i)%area*deflection_of(model, analysis, joint, frame, i)
      end do
      if (.not. area > 0.0_wp) return
      place = place/area
      mean = mean/area
      inertia = 0.0_wp
      moment = 0.0_wp
      do i = joint%first, joint%last
         if (analysis%states(i)%normal%branch == branch_open) cycle
         arm = arm_of(model, frame, i) - place
         d = deflection_of(model, analysis, joint, frame, i) - mean
         inertia = inertia + model%interface(i)%area*inertia_of(arm)
         moment = moment + model%interface(i)%area*cross(arm, d)
      end do
      q(4:) = merge(smallest_turn(inertia, moment, straight*area*frame%extent**2), 0.0_wp, frame%exists(4:))
      q(:3) = merge(mean - cross(q(4:), place), 0.0_wp, frame%exists(:3))
   end function rigid_movement

   !> How interface element I is deflected, in the axes of FRAME [length].
   pure function deflection_of(model, analysis, joint, frame, i) result(d)
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      type(joint_type), intent(in)    :: joint
      type(joint_frame), intent(in)   :: frame
      integer, intent(in)             :: i
      real(wp) :: d(3)

      d(:2) = merge(analysis%states(i)%shear%delta, analysis%movement(:2, i), joint%law%shear%given)
      d(3) = analysis%states(i)%normal%lambda
      d = matmul(model%interface(i)%axes, d)
      d = matmul(d, frame%axes)
   end function deflection_of

   !> The smallest {t} with [J] {t} = {moment}. Of elements on one line along e, [J] = J ([1] - e e^T): {t} = {moment}/J.
   pure function smallest_turn(inertia, moment, least) result(turn)
      real(wp), intent(in) :: inertia(3, 3) !! [J] about the centroid of the elements
      real(wp), intent(in) :: moment(3)
      real(wp), intent(in) :: least         !! below it J is that of one place
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

   !> What resists each of the six rigid movements while the five others are held: {m}^T [k] {m} summed over the elements
   !! [force/length; force x length].
   pure function stiffness_about(model, joint, frame, k) result(total)
      type(model_type), intent(in)  :: model
      type(joint_type), intent(in)  :: joint
      type(joint_frame), intent(in) :: frame
      real(wp), intent(in)          :: k(:, :) !! (3, n) of all interface elements, in their own axes [force/length]
      real(wp) :: total(6), moved(3) ! by a rigid movement of 1 along an axis or about it
      integer  :: c, i

      total = 0.0_wp
      do i = joint%first, joint%last
         do c = 1, 6
            moved = 0.0_wp
            moved(modulo(c - 1, 3) + 1) = 1.0_wp
            if (c > 3) moved = cross(moved, arm_of(model, frame, i))
            moved = matmul(frame%axes, moved)
            moved = matmul(moved, model%interface(i)%axes)
            total(c) = total(c) + dot_product(k(:, i), moved**2)
         end do
      end do
      total = merge(total, 0.0_wp, frame%exists)
   end function stiffness_about

   !> From the centroid to where interface element I acts, in the axes of FRAME [length].
   pure function arm_of(model, frame, i) result(arm)
      type(model_type), intent(in)  :: model
      type(joint_frame), intent(in) :: frame
      integer, intent(in)           :: i
      real(wp) :: arm(3)

      arm = at_first_end(model%interface(i), model%x) - frame%centroid
      arm = matmul(arm, frame%axes)
   end function arm_of

   !> The moments of inertia of a unit area that is ARM away.
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
