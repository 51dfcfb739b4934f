!> The values of each joint after an increment: what it transmits, contact, largest pressure, deflection and gap, distance from its
!! laws; and the planes of symmetry that cut its bodies. Listing, CSV files, screen and warnings read these values. A value at the
!! level of rounding is zero.
module joint_values
   use analysis_state, only: analysis_type, element_force
   use connected_bodies, only: number_parts
   use determinate_joints, only: carried_resultant
   use interface_operator, only: at_first_end
   use kinds, only: wp
   use law_error, only: distance_type, normal_distance, shear_distance
   use model_data, only: joint_type, model_type, stage_load_type
   use normal_stiffness, only: branch_open, normal_state
   use numbers, only: cross, first_largest
   use symmetry_planes, only: cut_by, cut_type, find_planes, parts_cut, symmetry_plane
   use text_tools, only: above
   use tolerances, only: page_zero
   implicit none
   private

   public :: find_joint_values, find_resultant, face_distance, find_cuts

   !> The force and moment of side 1 on side 2.
   type, public :: joint_resultant
      real(wp) :: normal = 0.0_wp           !! N: sum of the normal forces of the elements, compression positive [force]
      real(wp) :: across = 0.0_wp           !! total force along the mean normal of the joint [force]
      real(wp) :: along(2) = 0.0_wp         !! sums of the shear forces in the elements' own x and y [force]
      real(wp) :: shear(3) = 0.0_wp         !! the same as a vector, global axes [force]
      real(wp) :: force(3) = 0.0_wp         !! total, global axes [force]
      real(wp) :: moment(3) = 0.0_wp        !! about the centroid of the area, global axes [force x length]
   end type joint_resultant

   type, public :: joint_values_type
      type(joint_resultant) :: total
      logical  :: has_applied = .false.        !! statics alone determines its normal force
      real(wp) :: applied = 0.0_wp             !! that force [force]
      integer  :: n_open = 0, slipping = 0     !! interface elements
      real(wp) :: contact = 0.0_wp             !! share of the area that is not open
      real(wp) :: lambda = 0.0_wp              !! largest [length]
      real(wp) :: pressure = 0.0_wp            !! largest; 0: none is pressed beyond rounding [pressure]
      real(wp) :: gap = 0.0_wp                 !! largest [length]
      integer  :: lambda_at = 0                !! interface elements of these, the first of several; 0: none
      integer  :: pressed_at = 0, open_at = 0
      type(distance_type) :: distances(2)      !! from the normal law and the shear laws, where METHOD = STEP follows them
   end type joint_values_type

contains

   !> The VALUES of all joints after the completed increment.
   subroutine find_joint_values(model, analysis, values)
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      type(joint_values_type), allocatable, intent(out) :: values(:) !! (joints)
      type(stage_load_type) :: now ! the present load
      integer :: j

      now%n = size(analysis%loaded)
      allocate (now%node, source=analysis%loaded)
      allocate (now%force(3, now%n), source=0.0_wp)
      now%force(:model%mesh%dimension, :) = analysis%now%load(:, now%node)
      allocate (values(size(model%joints%list)))
      do j = 1, size(values)
         associate (joint => model%joints%list(j), of_joint => values(j), &
                    states => analysis%states(model%joints%list(j)%first:model%joints%list(j)%last))
            of_joint%total = find_resultant(model, analysis, joint)
            of_joint%has_applied = joint%determinate
            if (joint%determinate) of_joint%applied = carried_resultant(model%mesh, model%freedoms, joint, now)
            of_joint%n_open = count(states%normal%branch == branch_open)
            of_joint%slipping = count(states%slips)
            of_joint%contact = above(1.0_wp - sum(model%joints%element(joint%first:joint%last)%area, &
                                                  mask=states%normal%branch == branch_open)/joint%area, page_zero)
            of_joint%lambda = above(maxval(states%normal%lambda), page_zero*analysis%largest_lambda)
            of_joint%lambda_at = joint%first - 1 + first_largest(above(states%normal%lambda, page_zero*analysis%largest_lambda))
            of_joint%pressure = above(max(0.0_wp, maxval(states%normal%pressure)), page_zero*analysis%largest_p)
            if (of_joint%pressure > 0.0_wp) of_joint%pressed_at = &
               joint%first - 1 + first_largest(states%normal%pressure, states%normal%pressure > 0.0_wp)
            of_joint%gap = above(maxval(face_distance(states%normal)), page_zero*analysis%largest_lambda)
            if (of_joint%gap > 0.0_wp) of_joint%open_at = &
               joint%first - 1 + first_largest(face_distance(states%normal), states%normal%branch == branch_open)
         end associate
         if (allocated(analysis%exact)) values(j)%distances = &
            [normal_distance(model, analysis, j), shear_distance(model, analysis, j)]
      end do
   end subroutine find_joint_values

   !> Distance of the faces at an interface element in this STATE from contact [length].
   elemental real(wp) function face_distance(state) result(gap)
      type(normal_state), intent(in) :: state

      gap = 0.0_wp
      if (state%branch == branch_open) gap = max(0.0_wp, state%lambda_b - state%lambda)
   end function face_distance

   !> The present resultant of JOINT.
   pure function find_resultant(model, analysis, joint) result(total)
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      type(joint_type), intent(in)    :: joint
      type(joint_resultant) :: total
      real(wp) :: force(3)
      integer  :: i

      do i = joint%first, joint%last
         associate (element => model%joints%element(i), state => analysis%states(i))
            force = element_force(element, state)
            total%force = total%force + force
            total%across = total%across + dot_product(force, joint%normal)
            total%moment = total%moment + cross(at_first_end(element, model%mesh%x) - joint%frame%centroid, force)
            total%normal = total%normal + state%normal%sumf
            total%along = total%along + state%shear%tau*element%area
            total%shear = total%shear + matmul(element%axes(:, :2), state%shear%tau*element%area)
         end associate
      end do
   end function find_resultant

   !> The PLANES of symmetry of MODEL, and those that cut all bodies on both sides of each joint; a rigid base has no part in it.
   !! Bodies are parts that bolts do not connect.
   pure subroutine find_cuts(model, planes, cuts)
      type(model_type), intent(in)                   :: model
      type(symmetry_plane), allocatable, intent(out) :: planes(:)
      type(cut_type), allocatable, intent(out)       :: cuts(:) !! (joints)
      integer, allocatable :: part(:)
      logical, allocatable :: all_cut(:), of_part(:, :)
      integer :: i, j, k, n_parts

      call find_planes(model, planes)
      allocate (cuts(size(model%joints%list)))
      if (size(planes) == 0) return
      call number_parts(model%mesh, model%freedoms, .false., part, n_parts)
      allocate (of_part, source=parts_cut(model, planes, part, n_parts))
      allocate (all_cut(size(planes)))
      do j = 1, size(cuts)
         all_cut = .true.
         do i = model%joints%list(j)%first, model%joints%list(j)%last
            associate (nodes => model%joints%element(i)%node)
               do k = 1, size(nodes)
                  all_cut = all_cut .and. of_part(part(nodes(k)), :)
               end do
            end associate
         end do
         cuts(j) = cut_by(planes, all_cut)
      end do
   end subroutine find_cuts

end module joint_values
