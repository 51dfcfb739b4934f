!> The answer at the end of a stage: the values of interest for the bodies, each joint and each bolt. Values at the level of
!! rounding are zero; values without meaning are absent. For a joint these are the resultant, the rigid-body movement of its sides
!! against each other and its six stiffnesses, in the joint's axes: forces (movements) along x, y and the normal z, moments
!! (rotations) about them. T, M, the movement and the secant stiffnesses leave out what planes of symmetry balance.
module stage_answer
   use analysis_state, only: analysis_type
   use body_elements, only: element_centre, node_stresses, whole_stress
   use bolt_answers, only: bolt_answer_type, bolt_history, find_bolt_answers, remainder
   use elasticity, only: max_stresses, von_mises
   use interface_operator, only: at_first_end
   use joint_resultants, only: find_largest_pressure, find_resultant, joint_resultant
   use joint_sides, only: straight
   use kinds, only: wp
   use law_error, only: tangents_now
   use model_data, only: joint_frame, joint_type, model_type, n_points
   use normal_stiffness, only: branch_open, normal_state
   use numbers, only: cross, first_largest, identity, is_measure
   use structural_results, only: node_peaks
   use symmetry_planes, only: axis_part, cut_type, free_part
   use table_writer, only: noise
   use text_tools, only: above, integer_text
   implicit none
   private

   public :: find_answer, rigid_movement, stiffness_about, face_distance, fault_of_answer

   !> The largest value of a kind, and its place.
   type, public :: peak_type
      logical  :: is_there = .false.
      real(wp) :: value = 0.0_wp
      integer  :: id = 0                       !! of a node, or of an element
      real(wp) :: x(3) = 0.0_wp                !! position [length]
   end type peak_type

   type, public :: joint_answer
      real(wp) :: contact = 0.0_wp             !! share of the area that is not open
      integer  :: pressed_at = 0, open_at = 0  !! interface elements of the largest pressure and gap; 0: none
      real(wp) :: pressure = 0.0_wp            !! largest [pressure]
      real(wp) :: gap = 0.0_wp                 !! largest [length]
      integer  :: slipping = 0                 !! interface elements
      integer  :: n_cuts = 0                   !! directions of the planes of symmetry that cut its bodies
      real(wp) :: normal = 0.0_wp, shear = 0.0_wp, moment = 0.0_wp !! N, T, M [force; force x length]
      logical  :: has_safety = .false.
      real(wp) :: safety = 0.0_wp              !! mu N/T
      real(wp) :: force(6) = 0.0_wp            !! force and moment in the axes of the joint
      real(wp) :: movement(6) = 0.0_wp         !! movement of side 1 against side 2
      real(wp) :: tangent(6) = 0.0_wp, secant(6) = 0.0_wp
      logical  :: has_secant(6) = .false.
   end type joint_answer

   type, public :: stage_answer_type
      type(peak_type) :: displacement          !! magnitude [length]
      type(peak_type) :: at_centre, at_node    !! von Mises [pressure]
      real(wp) :: strained = 0.0_wp            !! largest von Mises stress at the centre of an element over its E
      type(joint_answer), allocatable     :: joints(:)
      type(bolt_answer_type), allocatable :: bolts(:)
   end type stage_answer_type

contains

   !> The answer at the end of the stage just completed, the bodies recovered. Peaks are the largest displacement of a node, and
   !! the largest von Mises stress at the centre of an element and at a node as the mean of its elements.
   subroutine find_answer(model, cuts, analysis, method, largest_force, bolts, answer)
      type(model_type), intent(in)    :: model
      type(cut_type), intent(in)      :: cuts(:)       !! (joints) by planes of symmetry
      type(analysis_type), intent(in) :: analysis
      integer, intent(in)             :: method        !! of case control
      real(wp), intent(in)            :: largest_force !! ever applied at a node, for the noise [force]
      type(bolt_history), intent(inout)    :: bolts
      type(stage_answer_type), intent(out) :: answer
      real(wp), allocatable :: k(:, :), at_node(:, :), size_of(:), structural(:), at_ends(:)
      integer :: e, j, node

      allocate (answer%joints(size(model%joints)))
      allocate (k, source=tangents_now(model, analysis, method))
      do j = 1, size(model%joints)
         call describe_joint(model, analysis, model%joints(j), cuts(j), k, remainder*largest_force, answer%joints(j))
      end do
      call find_bolt_answers(model, analysis, largest_force, bolts, answer%bolts)

      ! the largest displacement
      allocate (size_of(n_points(model)))
      do node = 1, size(size_of)
         size_of(node) = norm2(analysis%all_u(:, node))
      end do
      node = first_largest(size_of, model%used(:size(size_of)))
      if (node > 0) answer%displacement = peak_type(.true., maxval(size_of, mask=model%used(:size(size_of))), &
                                                    model%node_id(node), model%x(:, node))
      if (model%n_elements == 0) return

      ! the largest von Mises stress at a node
      allocate (at_node(max_stresses, n_points(model)))
      call node_stresses(model, analysis%all_u, analysis%now%temperature, at_node)
      allocate (structural(size(size_of)), at_ends(model%n_elements))
      call node_peaks(model, analysis%all_u, analysis%now%temperature, structural, at_ends, analysis)
      do node = 1, size(size_of)
         size_of(node) = max(von_mises(at_node(:, node)), structural(node))
      end do
      node = first_largest(size_of, model%used(:size(size_of)))
      answer%at_node = peak_type(.true., largest(size_of), model%node_id(node), model%x(:, node))

      ! that at the centre of an element
      deallocate (size_of)
      allocate (size_of(model%n_elements))
      !$omp parallel do schedule(dynamic, 512) default(shared) if(model%n_elements > 4096)
      do e = 1, model%n_elements
         size_of(e) = max(von_mises(whole_stress(model, e, analysis%all_u, analysis%now%temperature)), at_ends(e))
      end do
      !$omp end parallel do
      associate (modulus => model%properties(model%element_property)%e)
         if (all(is_measure(size_of))) answer%strained = maxval(size_of/modulus, mask=modulus > 0.0_wp)
      end associate
      e = first_largest(size_of, size_of >= 0.0_wp)
      answer%at_centre = peak_type(.true., largest(size_of), model%element_id(e))
      answer%at_centre%x(:model%dimension) = element_centre(model, e)
   end subroutine find_answer

   !> The largest of VALUES, or the first one that is not a number.
   pure real(wp) function largest(values)
      real(wp), intent(in) :: values(:)

      largest = maxval(values)
      if (.not. all(is_measure(values))) largest = values(findloc(is_measure(values), .false., dim=1))
   end function largest

   !> Distance of the faces at an interface element in this STATE from contact [length].
   elemental real(wp) function face_distance(state) result(gap)
      type(normal_state), intent(in) :: state

      gap = 0.0_wp
      if (state%branch == branch_open) gap = max(0.0_wp, state%lambda_b - state%lambda)
   end function face_distance

   !> Contact, resultant, safety against slip and stiffness of JOINT.
   pure subroutine describe_joint(model, analysis, joint, cut, k, floor, answer)
      type(model_type), intent(in)      :: model
      type(analysis_type), intent(in)   :: analysis
      type(joint_type), intent(in)      :: joint
      type(cut_type), intent(in)        :: cut     !! by planes of symmetry
      real(wp), intent(in)              :: k(:, :) !! (3, n) tangents of all interface elements
      real(wp), intent(in)              :: floor   !! of forces: smaller values are rounding
      type(joint_answer), intent(inout) :: answer
      type(joint_resultant) :: total
      type(cut_type) :: along
      real(wp) :: least(6), unbalanced(6)

      associate (states => analysis%states(joint%first:joint%last), elements => model%interface(joint%first:joint%last))
         answer%contact = above(1.0_wp - sum(elements%area, mask=states%normal%branch == branch_open)/joint%area, noise)
         answer%slipping = count(states%slips)
         answer%gap = above(maxval(face_distance(states%normal)), noise*analysis%largest_lambda)
         if (answer%gap > 0.0_wp) answer%open_at = &
            joint%first - 1 + first_largest(face_distance(states%normal), states%normal%branch == branch_open)
      end associate
      call find_largest_pressure(analysis, joint, answer%pressure, answer%pressed_at)
      total = find_resultant(model, analysis, joint)
      answer%n_cuts = cut%n
      associate (frame => joint%frame)
         if (model%axisymmetric) total%shear(1) = 0.0_wp ! self-equilibrated around the ring
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
         answer%has_safety = joint%law%has_friction .and. answer%shear > 0.0_wp
         if (answer%has_safety) answer%safety = joint%law%mu*max(0.0_wp, answer%normal)/answer%shear
         least = remainder*analysis%largest_lambda
         least(4:) = least(4:)/max(frame%extent, tiny(1.0_wp))
         answer%movement = above(rigid_movement(model, analysis, joint, along), least)
         answer%tangent = stiffness_about(model, joint, k)
         answer%tangent(:3) = above(answer%tangent(:3), noise*maxval(abs(answer%tangent(:3))))
         answer%tangent(4:) = above(answer%tangent(4:), noise*maxval(abs(answer%tangent(4:))))
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
      real(wp) :: unit_area, unit_length
      integer  :: i

      q = 0.0_wp
      unit_length = 2.0_wp**exponent(joint%frame%extent)
      unit_area = 2.0_wp**exponent(joint%area)
      area = 0.0_wp
      place = 0.0_wp
      mean = 0.0_wp
      do i = joint%first, joint%last
         if (analysis%states(i)%normal%branch == branch_open) cycle
         a = model%interface(i)%area/unit_area
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
         a = model%interface(i)%area/unit_area
         arm = arm_of(model, joint%frame, i)/unit_length - place
         d = deflection_of(model, analysis, joint, i) - mean
         inertia = inertia + a*(dot_product(arm, arm)*identity - spread(arm, 2, 3)*spread(arm, 1, 3))
         moment = moment + a*cross(arm, d)
      end do
      j = 0.5_wp*(inertia(1, 1) + inertia(2, 2) + inertia(3, 3))
      if (cut%n > 0) then
         mean = free_part(cut, mean)
         j = dot_product(cut%direction(:, 1), matmul(inertia, cut%direction(:, 1)))
         if (j > straight*area*(joint%frame%extent/unit_length)**2) q(4:) = axis_part(cut, moment)/j
      else if (j > straight*area*(joint%frame%extent/unit_length)**2) then  ! else all elements are at one point
         minors(:, 1) = cross(inertia(:, 2), inertia(:, 3))
         minors(:, 2) = cross(inertia(:, 3), inertia(:, 1))
         minors(:, 3) = cross(inertia(:, 1), inertia(:, 2))
         determinant = dot_product(inertia(:, 1), minors(:, 1))
         if (determinant > straight*j**3) then
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
      d = matmul(model%interface(i)%axes, d)
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

   !> The first value of ANSWER beyond all bounds, in words; '' where all are finite.
   pure function fault_of_answer(model, answer) result(words)
      type(model_type), intent(in)        :: model
      type(stage_answer_type), intent(in) :: answer
      character(:), allocatable :: words
      integer :: i

      words = ''
      if (.not. is_measure(answer%displacement%value)) then
         words = 'the displacement of node '//integer_text(answer%displacement%id)
      else if (.not. is_measure(answer%at_centre%value)) then
         words = 'the stress of element '//integer_text(answer%at_centre%id)
      else if (.not. is_measure(answer%at_node%value)) then
         words = 'the stress at node '//integer_text(answer%at_node%id)
      end if
      do i = 1, size(answer%joints)
         associate (joint => answer%joints(i))
            if (words /= '') return
            if (.not. all(is_measure([joint%pressure, joint%gap, joint%normal, joint%shear, joint%moment, joint%safety, &
                                      joint%force, joint%movement, joint%tangent, joint%secant]))) &
               words = 'the force of joint '//integer_text(model%joints(i)%id)//', or its stiffness,'
         end associate
      end do
      do i = 1, size(answer%bolts)
         associate (bolt => answer%bolts(i))
            if (words /= '') return
            if (.not. all(is_measure([bolt%force, bolt%change, bolt%load_change, bolt%ratio, bolt%moment, bolt%stress, &
                                      bolt%share, bolt%use, bolt%clamping, bolt%loss, bolt%safety]))) &
               words = 'the force of bolt '//integer_text(bolt%id)
         end associate
      end do
   end function fault_of_answer

end module stage_answer
