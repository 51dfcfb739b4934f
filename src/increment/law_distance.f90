!> How far STEP is from its own laws (Fig. 3, the error A_i B_i): beside its states the exact laws are followed along the same
!! movements, increment by increment.
module law_distance
   use analysis_state, only: analysis_type
   use joint_laws, only: element_state, follow_element, rest_when_open
   use kinds, only: wp
   use model_data, only: model_type
   implicit none
   private

   public :: follow_laws, normal_distance, shear_distance

   real(wp), parameter :: noise = 1.0e-9_wp !! of the largest stress so far: nothing is measured by less

   !> The element of a joint that is farthest from its law.
   type, public :: distance_type
      logical  :: is_there = .false.           !! whether the joint bears any such stress
      integer  :: element = 0, direction = 3
      real(wp) :: share = 0.0_wp               !! of the largest stress of the joint, |stress - by_law|
      real(wp) :: stress = 0.0_wp, by_law = 0.0_wp !! p or tau [pressure]
   end type distance_type

contains

   !> Follow the laws along the increment just completed; nothing where the method is not STEP.
   pure subroutine follow_laws(model, analysis)
      type(model_type), intent(in)       :: model
      type(analysis_type), intent(inout) :: analysis
      type(element_state) :: after
      real(wp) :: tangent(3, 3), work(3)
      integer  :: i

      if (.not. allocated(analysis%exact)) return
      do i = 1, size(model%interface)
         call follow_element(model%joints(model%interface(i)%joint)%law, model%interface(i)%area, analysis%exact(i), &
                             analysis%movement(:, i), after, tangent, work)
         call rest_when_open(after, analysis%movement(:, i))
         analysis%exact(i) = after
      end do
   end subroutine follow_laws

   !> Where joint J is farthest from its normal law.
   pure type(distance_type) function normal_distance(model, analysis, j) result(farthest)
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      integer, intent(in)             :: j

      associate (first => model%joints(j)%first, last => model%joints(j)%last)
         farthest = distance_of(analysis%states(first:last)%normal%pressure, analysis%exact(first:last)%normal%pressure, &
                                noise*analysis%largest_p)
         farthest%element = first + farthest%element - 1
      end associate
   end function normal_distance

   !> Likewise from its shear laws, in the direction where that is most.
   pure type(distance_type) function shear_distance(model, analysis, j) result(farthest)
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      integer, intent(in)             :: j
      type(distance_type) :: found
      integer :: k

      associate (first => model%joints(j)%first, last => model%joints(j)%last)
         do k = 1, 2
            if (.not. model%joints(j)%law%shear(k)%given) cycle
            found = distance_of(analysis%states(first:last)%shear(k)%tau, analysis%exact(first:last)%shear(k)%tau, &
                                noise*analysis%largest_p)
            if (.not. found%is_there .or. (farthest%is_there .and. found%share <= farthest%share)) cycle
            farthest = found
            farthest%direction = k
            farthest%element = first + found%element - 1
         end do
      end associate
   end function shear_distance

   !> The largest difference between STRESS and BY_LAW, measured by the largest stress if that is above FLOOR; of values that
   !! rounding alone tells apart the first counts.
   pure type(distance_type) function distance_of(stress, by_law, floor) result(farthest)
      real(wp), intent(in) :: stress(:), by_law(:), floor
      real(wp) :: largest
      integer  :: i

      farthest%element = 1
      largest = maxval(abs(stress))
      farthest%is_there = largest > floor
      if (.not. farthest%is_there) return
      do i = 1, size(stress)
         if (abs(stress(i) - by_law(i)) > (farthest%share + noise)*largest) then
            farthest%element = i
            farthest%share = abs(stress(i) - by_law(i))/largest
         end if
      end do
      farthest%stress = stress(farthest%element)
      farthest%by_law = by_law(farthest%element)
   end function distance_of

end module law_distance
