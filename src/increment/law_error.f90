!> The distance of STEP from its own laws, and the tangent stiffness of interface elements for any method.
!! The exact laws are followed along the movements of STEP, increment by increment. In the normal direction the distance is A_i
!! B_i of Fig. 3, the difference of the deflections at one pressure. In shear it is the difference of the stresses at one
!! deflection.
module law_error
   use analysis_state, only: analysis_type
   use control_words, only: method_back, method_newton
   use joint_laws, only: element_state, follow_element, norm_and_shear, rest_when_open
   use kinds, only: wp
   use model_data, only: model_type
   use normal_stiffness, only: law_deflection
   use tolerances, only: least_scale
   implicit none
   private

   public :: follow_laws, normal_distance, shear_distance, tangents_now

   !> The element of a joint with the largest distance from its law.
   type, public :: distance_type
      logical  :: is_there = .false.           !! whether the joint has any such deflection or stress
      integer  :: element = 0, direction = 3
      real(wp) :: relative = 0.0_wp            !! |actual - by_law| relative to the largest value of the joint
      real(wp) :: actual = 0.0_wp, by_law = 0.0_wp !! lambda [length] or tau [pressure]
   end type distance_type

contains

   !> Follow the exact laws along the completed increment; nothing where the method is not STEP.
   pure subroutine follow_laws(model, analysis)
      type(model_type), intent(in)       :: model
      type(analysis_type), intent(inout) :: analysis
      type(element_state) :: after
      real(wp) :: tangent(3, 3)
      integer  :: i

      if (.not. allocated(analysis%exact)) return
      do i = 1, size(model%joints%element)
         call follow_element(model%joints%list(model%joints%element(i)%joint)%law, model%joints%element(i)%area, &
            analysis%exact(i), analysis%movement(:, i), after, tangent)
         call rest_when_open(after, analysis%movement(:, i))
         analysis%exact(i) = after
      end do
   end subroutine follow_laws

   !> The largest distance of joint J from its normal law: lambda from that of the law at the same pressure. At zero pressure the
   !! law holds for any lambda below the end of its branch.
   pure type(distance_type) function normal_distance(model, analysis, j) result(farthest)
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      integer, intent(in)             :: j
      real(wp) :: by_law(model%joints%list(j)%first:model%joints%list(j)%last), p
      integer  :: i

      associate (joint => model%joints%list(j), lambda => analysis%states%normal%lambda)
         do i = joint%first, joint%last
            p = analysis%states(i)%normal%pressure
            if (p <= least_scale*analysis%largest_p) p = 0.0_wp
            by_law(i) = law_deflection(joint%law%normal, analysis%exact(i)%normal, p)
            if (.not. p > 0.0_wp) by_law(i) = min(by_law(i), lambda(i))
         end do
         farthest = distance_of(lambda(joint%first:joint%last), by_law, maxval(lambda(joint%first:joint%last)), &
                                least_scale*analysis%largest_lambda)
         farthest%element = joint%first + farthest%element - 1
      end associate
   end function normal_distance

   !> The largest distance of joint J from its shear laws: tau from that of the law at the same deflection, over both directions.
   pure type(distance_type) function shear_distance(model, analysis, j) result(farthest)
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      integer, intent(in)             :: j
      type(distance_type) :: found
      integer :: k

      associate (first => model%joints%list(j)%first, last => model%joints%list(j)%last)
         do k = 1, 2
            if (.not. model%joints%list(j)%law%shear(k)%given) cycle
            found = distance_of(analysis%states(first:last)%shear(k)%tau, analysis%exact(first:last)%shear(k)%tau, &
                                maxval(abs(analysis%states(first:last)%shear(k)%tau)), least_scale*analysis%largest_p)
            if (.not. found%is_there .or. (farthest%is_there .and. found%relative <= farthest%relative)) cycle
            farthest = found
            farthest%direction = k
            farthest%element = first + found%element - 1
         end do
      end associate
   end function shear_distance

   !> The largest difference between ACTUAL and BY_LAW, relative to LARGEST; there is none where LARGEST is not above FLOOR. Of
   !! values that are equal but for rounding the first counts.
   pure type(distance_type) function distance_of(actual, by_law, largest, floor) result(farthest)
      real(wp), intent(in) :: actual(:), by_law(:), largest, floor
      integer :: i

      farthest%element = 1
      farthest%is_there = largest > floor
      if (.not. farthest%is_there) return
      do i = 1, size(actual)
         if (abs(actual(i) - by_law(i)) > (farthest%relative + least_scale)*largest) then
            farthest%element = i
            farthest%relative = abs(actual(i) - by_law(i))/largest
         end if
      end do
      farthest%actual = actual(farthest%element)
      farthest%by_law = by_law(farthest%element)
   end function distance_of

   !> (3, n): k_sx, k_sy, k_n of every interface element [force/length]. STEP: those of its next increment. NEWTON: those at
   !! equilibrium. BACK: the slopes of the loading curves at the ends of its secants. A slipping element has no tangential
   !! stiffness.
   pure function tangents_now(model, analysis, method) result(k)
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      integer, intent(in)             :: method !! of case control
      real(wp) :: k(3, size(model%joints%element))
      type(element_state) :: state
      integer :: i

      do i = 1, size(model%joints%element)
         state = analysis%states(i)
         select case (method)
         case (method_newton)
            k(:, i) = [state%shear%k_s, state%normal%k_n]
         case (method_back)
            call norm_and_shear(model%joints%list(model%joints%element(i)%joint)%law, model%joints%element(i)%area, .false., &
                                analysis%movement(:, i), state, k(:, i))
         case default
            k(:, i) = analysis%k(:, i)
         end select
         if (state%slips) k(:2, i) = 0.0_wp
      end do
   end function tangents_now

end module law_error
