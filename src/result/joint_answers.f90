!> The answer at the end of a stage for each joint. Values at the level of rounding are zero; values without meaning are absent. They
!! are the resultant, the rigid-body movement of its sides against each other and its six stiffnesses, in the joint's axes: forces
!! (movements) along x, y and the normal z, moments (rotations) about them. T, M, the movement and the
!! secant stiffnesses leave out what planes of symmetry balance.
module joint_answers
   use analysis_state, only: analysis_type
   use interface_operator, only: at_first_end
   use joint_laws, only: limit_scales
   use joint_values, only: joint_resultant, joint_values_type
   use kinds, only: wp
   use law_error, only: tangents_now
   use model_data, only: joint_frame, joint_type, model_type
   use normal_stiffness, only: branch_open
   use numbers, only: cross, identity, is_measure
   use symmetry_planes, only: axis_part, cut_type, free_part
   use text_tools, only: above, integer_text
   use tolerances, only: no_inertia, page_zero, zero_remainder
   implicit none
   private

   public :: find_joint_answers, rigid_movement, stiffness_about, fault_of_joints

   type, public :: joint_answer
      type(joint_values_type) :: now           !! at the end of the stage
      integer  :: n_cuts = 0                   !! directions of the planes of symmetry that cut its bodies
      real(wp) :: normal = 0.0_wp, shear = 0.0_wp, moment = 0.0_wp !! N, T, M [force; force x length]
      logical  :: has_safety = .false.
      real(wp) :: safety = 0.0_wp              !! mu N/T
      real(wp) :: force(6) = 0.0_wp            !! force and moment in the axes of the joint
      real(wp) :: movement(6) = 0.0_wp         !! movement of side 1 against side 2
      real(wp) :: tangent(6) = 0.0_wp, secant(6) = 0.0_wp
      logical  :: has_secant(6) = .false.
   end type joint_answer

contains

   !> The ANSWERS of all joints at the end of the stage just completed.
   subroutine find_joint_answers(model, cuts, analysis, now, method, largest_force, answers)
      type(model_type), intent(in)        :: model
      type(cut_type), intent(in)          :: cuts(:)       !! (joints) by planes of symmetry
      type(analysis_type), intent(in)     :: analysis
      type(joint_values_type), intent(in) :: now(:)        !! (joints)
      integer, intent(in)                 :: method        !! of case control
      real(wp), intent(in)                :: largest_force !! ever applied at a node, for the noise [force]
      type(joint_answer), allocatable, intent(out) :: answers(:) !! (joints)
      real(wp), allocatable :: k(:, :)
      integer :: j

      allocate (answers(size(model%joints%list)))
      allocate (k, source=tangents_now(model, analysis, method))
      do j = 1, size(answers)
         call describe_joint(model, analysis, model%joints%list(j), now(j), cuts(j), k, zero_remainder*largest_force, answers(j))
      end do
   end subroutine find_joint_answers

   !> Contact, resultant, safety against slip and stiffness of JOINT.
   pure subroutine describe_joint(model, analysis, joint, now, cut, k, floor, answer)
      type(model_type), intent(in)      :: model
      type(analysis_type), intent(in)   :: analysis
      type(joint_type), intent(in)      :: joint
      type(joint_values_type), intent(in) :: now
      type(cut_type), intent(in)        :: cut     !! by planes of symmetry
      real(wp), intent(in)              :: k(:, :) !! (3, n) tangents of all interface elements
      real(wp), intent(in)              :: floor   !! of forces: smaller values are rounding
      type(joint_answer), intent(inout) :: answer
      type(joint_resultant) :: total
      type(cut_type) :: along
      real(wp) :: least(6), unbalanced(6)

      answer%now = now
      total = now%total
      answer%n_cuts = cut%n
      associate (frame => joint%frame)
         if (model%mesh%axisymmetric) total%shear(1) = 0.0_wp ! self-equilibrated around the ring
         answer%normal = above(total%normal, floor)
         answer%shear = above(norm2(free_part(cut, total%shear)), floor)
         answer%force(:3) = above(matmul(total%force, frame%axes), floor)
         answer%force(4:) = above(matmul(total%moment, frame%axes), floor*frame%extent)
         answer%force = merge(answer%force, 0.0_wp, frame%exists)
         along%n = cut%n ! in the axes of the joint
         along%direction = matmul(transpose(frame%axes), cut%direction)
         unbalanced = answer%force
         if (cut%n > 0) unbalanced = above([free_part(along, answer%force(:3)), axis_part(along, answer%force(4:))], &
                                           floor*[1.0_wp, 1.0_wp, 1.0_wp, frame%extent, frame%extent, frame%extent])
         answer%moment = norm2(unbalanced(4:))
         answer%has_safety = limit_scales(joint%law) .and. answer%shear > 0.0_wp
         if (answer%has_safety) answer%safety = joint%law%mu*max(0.0_wp, answer%normal)/answer%shear
         least = zero_remainder*analysis%largest_lambda
         least(4:) = least(4:)/max(frame%extent, tiny(1.0_wp))
         answer%movement = above(rigid_movement(model, analysis, joint, along), least)
         answer%tangent = stiffness_about(model, joint, k)
         answer%tangent(:3) = above(answer%tangent(:3), page_zero*maxval(abs(answer%tangent(:3))))
         answer%tangent(4:) = above(answer%tangent(4:), page_zero*maxval(abs(answer%tangent(4:))))
         answer%has_secant = frame%exists .and. unbalanced*answer%movement > 0.0_wp
         where (answer%has_secant) answer%secant = unbalanced/answer%movement
      end associate
   end subroutine describe_joint

   !> Rigid-body movement of side 1 against side 2, fitted to the deflections {d} of the elements that are not open (delta_x,
   !! delta_y, lambda as in the joint history) by least squares weighted with their areas. The translation at the centroid s of
   !! these elements is the mean of {d}. The rotation is the smallest {t} with [J] {t} = sum a (r - s) x {d}, [J] their inertia. The
   !! result is the movement of the point at the centroid of the joint. Elements on one line do not determine the rotation about
   !! it: it is set to 0. Of a joint that planes of symmetry cut it is the movement of the whole, which is a translation in the planes
   !! and a rotation about the normal of the only plane. The determinant of [J] goes with the 15th power of a length: areas and vectors are divided by powers of
   !! two near the largest, which changes no digit [length; radians].
   pure function rigid_movement(model, analysis, joint, cut) result(q)
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      type(joint_type), intent(in)    :: joint
      type(cut_type), intent(in)      :: cut !! by planes of symmetry, in the axes of the joint
      real(wp) :: q(6), a, area, arm(3), d(3), determinant, inertia(3, 3), j, mean(3), minors(3, 3), moment(3), place(3)
      real(wp) :: least, unit_area, unit_length
      integer  :: i

      q = 0.0_wp
      unit_length = 2.0_wp**exponent(joint%frame%extent)
      unit_area = 2.0_wp**exponent(joint%area)
      area = 0.0_wp
      place = 0.0_wp
      mean = 0.0_wp
      do i = joint%first, joint%last
         if (analysis%states(i)%normal%branch == branch_open) cycle
         a = model%joints%element(i)%area/unit_area
         area = area + a
         place = place + a*(arm_of(model, joint%frame, i)/unit_length)
         mean = mean + a*deflection_of(model, analysis, joint, i)
      end do
      if (.not. area > 0.0_wp) return
      place = place/area
      mean = mean/area
      inertia = 0.0_wp
      moment = 0.0_wp
      do i = joint%first, joint%last
         if (analysis%states(i)%normal%branch == branch_open) cycle
         a = model%joints%element(i)%area/unit_area
         arm = arm_of(model, joint%frame, i)/unit_length - place
         d = deflection_of(model, analysis, joint, i) - mean
         inertia = inertia + a*(dot_product(arm, arm)*identity - spread(arm, 2, 3)*spread(arm, 1, 3))
         moment = moment + a*cross(arm, d)
      end do
      j = 0.5_wp*(inertia(1, 1) + inertia(2, 2) + inertia(3, 3))
      least = huge(1.0_wp) ! all elements are at one place
      if (joint%frame%extent > 0.0_wp) least = no_inertia*area*(joint%frame%extent/unit_length)**2
      if (cut%n > 0) then
         mean = free_part(cut, mean)
         j = dot_product(cut%direction(:, 1), matmul(inertia, cut%direction(:, 1)))
         if (j > least) q(4:) = axis_part(cut, moment)/j
      else if (j > least) then  ! else all elements are at one point
         minors(:, 1) = cross(inertia(:, 2), inertia(:, 3))
         minors(:, 2) = cross(inertia(:, 3), inertia(:, 1))
         minors(:, 3) = cross(inertia(:, 1), inertia(:, 2))
         determinant = dot_product(inertia(:, 1), minors(:, 1))
         if (determinant > no_inertia*j**3) then
            q(4:) = matmul(minors, moment)/determinant
         else                                            ! on one line along e: [J] = J ([1] - e e^T)
            q(4:) = moment/j
         end if
      end if
      q(4:) = merge(q(4:), 0.0_wp, joint%frame%exists(4:))
      q(:3) = merge(mean - cross(q(4:), place), 0.0_wp, joint%frame%exists(:3))
      q(4:) = q(4:)/unit_length
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
      d = matmul(model%joints%element(i)%axes, d)
      d = matmul(d, joint%frame%axes)
   end function deflection_of

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
            moved = matmul(moved, model%joints%element(i)%axes)
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

      arm = at_first_end(model%joints%element(i), model%mesh%x) - frame%centroid
      arm = matmul(arm, frame%axes)
   end function arm_of

   !> What of the answers is beyond all bounds, '': nothing.
   pure function fault_of_joints(model, answers) result(words)
      type(model_type), intent(in)   :: model
      type(joint_answer), intent(in) :: answers(:)
      character(:), allocatable :: words
      integer :: i

      words = ''
      do i = 1, size(answers)
         associate (joint => answers(i))
            if (.not. all(is_measure([joint%now%pressure, joint%now%gap, joint%normal, joint%shear, joint%moment, joint%safety, &
                                      joint%force, joint%movement, joint%tangent, joint%secant]))) then
               words = 'the force of joint '//integer_text(model%joints%list(i)%id)//', or its stiffness,'
               return
            end if
         end associate
      end do
   end function fault_of_joints

end module joint_answers
