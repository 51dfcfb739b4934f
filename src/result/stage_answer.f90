!> The answer at the end of a stage: the values of interest for the bodies, each joint and each bolt. Values at the level of
!! rounding are zero; values without meaning are absent.
module stage_answer
   use analysis_state, only: analysis_type
   use body_elements, only: element_centre, node_stresses, whole_stress
   use bolt_answers, only: bolt_answer_type, bolt_history, find_bolt_answers, remainder
   use elasticity, only: max_stresses, von_mises
   use joint_motion, only: find_resultant, joint_resultant, rigid_movement, stiffness_about
   use kinds, only: wp
   use law_error, only: tangents_now
   use table_writer, only: noise
   use model_data, only: joint_type, model_type, n_points
   use normal_stiffness, only: branch_open, normal_state
   use numbers, only: first_largest, is_measure
   use structural_results, only: node_peaks
   use text_tools, only: above, integer_text
   implicit none
   private

   public :: find_answer, stands_apart, fault_of_answer

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

   !> The answer at the end of the stage just completed, the bodies recovered.
   subroutine find_answer(model, analysis, method, largest_force, bolts, answer)
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      integer, intent(in)             :: method        !! of case control
      real(wp), intent(in)            :: largest_force !! ever applied at a node, for the noise [force]
      type(bolt_history), intent(inout)    :: bolts
      type(stage_answer_type), intent(out) :: answer
      real(wp), allocatable :: k(:, :)
      integer :: j

      call find_peaks(model, analysis, answer)
      allocate (answer%joints(size(model%joints)))
      allocate (k, source=tangents_now(model, analysis, method))
      do j = 1, size(model%joints)
         call describe_joint(model, analysis, model%joints(j), k, remainder*largest_force, answer%joints(j))
      end do
      call find_bolt_answers(model, analysis, largest_force, bolts, answer%bolts)
   end subroutine find_answer

   !> Largest displacement of a node; largest von Mises stress at the centre of an element, and at a node as the mean of its
   !! elements.
   subroutine find_peaks(model, analysis, answer)
      type(model_type), intent(in)           :: model
      type(analysis_type), intent(in)        :: analysis
      type(stage_answer_type), intent(inout) :: answer
      real(wp), allocatable :: at_node(:, :), size_of(:), structural(:), at_ends(:)
      integer :: e, node

      allocate (size_of(n_points(model)))
      do node = 1, size(size_of)
         size_of(node) = norm2(analysis%all_u(:, node))
      end do
      node = first_largest(size_of, model%used(:size(size_of)))
      if (node > 0) answer%displacement = peak_type(.true., maxval(size_of, mask=model%used(:size(size_of))), &
                                                    model%node_id(node), model%x(:, node))
      if (model%n_elements == 0) return
      allocate (at_node(max_stresses, n_points(model)))
      call node_stresses(model, analysis%all_u, analysis%now%temperature, at_node)
      allocate (structural(size(size_of)), at_ends(model%n_elements))
      call node_peaks(model, analysis%all_u, analysis%now%temperature, structural, at_ends, analysis)
      do node = 1, size(size_of)
         size_of(node) = max(von_mises(at_node(:, node)), structural(node))
      end do
      node = first_largest(size_of, model%used(:size(size_of)))
      answer%at_node = peak_type(.true., largest(size_of), model%node_id(node), model%x(:, node))
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
      answer%at_centre = peak_type(.true., size_of(e), model%element_id(e))
      answer%at_centre%value = largest(size_of)
      answer%at_centre%x(:model%dimension) = element_centre(model, e)
   end subroutine find_peaks

   !> The largest of VALUES, or the first one that is not a number.
   pure real(wp) function largest(values)
      real(wp), intent(in) :: values(:)

      largest = maxval(values)
      if (.not. all(is_measure(values))) largest = values(findloc(is_measure(values), .false., dim=1))
   end function largest

   !> Distance of the faces at an interface element in this STATE from contact [length].
   elemental real(wp) function stands_apart(state) result(gap)
      type(normal_state), intent(in) :: state

      gap = 0.0_wp
      if (state%branch == branch_open) gap = max(0.0_wp, state%lambda_b - state%lambda)
   end function stands_apart

   !> Contact, resultant, safety against slip and stiffness of JOINT.
   pure subroutine describe_joint(model, analysis, joint, k, floor, answer)
      type(model_type), intent(in)      :: model
      type(analysis_type), intent(in)   :: analysis
      type(joint_type), intent(in)      :: joint
      real(wp), intent(in)              :: k(:, :) !! (3, n) tangents of all interface elements
      real(wp), intent(in)              :: floor   !! of forces: smaller values are rounding
      type(joint_answer), intent(inout) :: answer
      type(joint_resultant) :: total
      real(wp) :: least(6)

      associate (states => analysis%states(joint%first:joint%last), elements => model%interface(joint%first:joint%last))
         answer%contact = above(1.0_wp - sum(elements%area, mask=states%normal%branch == branch_open)/joint%area, noise)
         answer%slipping = count(states%slips)
         answer%pressure = above(maxval(states%normal%pressure), noise*analysis%largest_p)
         answer%gap = above(maxval(stands_apart(states%normal)), noise*analysis%largest_lambda)
         if (answer%pressure > 0.0_wp) answer%pressed_at = &
            joint%first - 1 + first_largest(states%normal%pressure, states%normal%pressure > 0.0_wp)
         if (answer%gap > 0.0_wp) answer%open_at = &
            joint%first - 1 + first_largest(stands_apart(states%normal), states%normal%branch == branch_open)
      end associate
      total = find_resultant(model, analysis, joint)
      associate (frame => joint%frame)
         if (model%axisymmetric) total%shear(1) = 0.0_wp ! self-equilibrated around the ring
         answer%normal = above(total%normal, floor)
         answer%shear = above(norm2(total%shear), floor)
         answer%force(:3) = above(matmul(total%force, frame%axes), floor)
         answer%force(4:) = above(matmul(total%moment, frame%axes), floor*frame%extent)
         answer%force = merge(answer%force, 0.0_wp, frame%exists)
         answer%moment = norm2(answer%force(4:))
         answer%has_safety = joint%law%has_friction .and. answer%shear > 0.0_wp
         if (answer%has_safety) answer%safety = joint%law%mu*max(0.0_wp, answer%normal)/answer%shear
         least = remainder*analysis%largest_lambda
         least(4:) = least(4:)/max(frame%extent, tiny(1.0_wp))
         answer%movement = above(rigid_movement(model, analysis, joint), least)
         answer%tangent = stiffness_about(model, joint, k)
         answer%tangent(:3) = above(answer%tangent(:3), noise*maxval(abs(answer%tangent(:3))))
         answer%tangent(4:) = above(answer%tangent(4:), noise*maxval(abs(answer%tangent(4:))))
         answer%has_secant = frame%exists .and. answer%force*answer%movement > 0.0_wp
         where (answer%has_secant) answer%secant = answer%force/answer%movement
      end associate
   end subroutine describe_joint

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
