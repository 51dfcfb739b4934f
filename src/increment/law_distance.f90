!> How far STEP is from its own laws: beside its states the exact laws are followed along the same movements, increment by increment.
!! Along the normal it is the error A_i B_i of Fig. 3, the distance in deflection at the same pressure; in shear that in stress at the
!! same deflection (Fig. 4a).
module law_distance
   use analysis_state, only: analysis_type
   use joint_laws, only: element_state, follow_element, rest_when_open
   use kinds, only: wp
   use model_data, only: model_type
   use normal_curve, only: loading_deflection, normal_law
   use normal_stiffness, only: branch_load, normal_state, touches
   implicit none
   private

   public :: follow_laws, normal_distance, shear_distance

   real(wp), parameter :: noise = 1.0e-9_wp !! of the largest stress so far: nothing is measured by less

   !> The element of a joint that is farthest from its law.
   type, public :: distance_type
      logical  :: is_there = .false.           !! whether the joint has moved or bears any such stress
      integer  :: element = 0, direction = 3
      real(wp) :: share = 0.0_wp               !! of the largest value of the joint, |value - by_law|
      real(wp) :: value = 0.0_wp, by_law = 0.0_wp !! lambda [length] or tau [pressure]
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
      real(wp) :: by_law(model%joints(j)%last - model%joints(j)%first + 1)
      integer  :: i

      associate (first => model%joints(j)%first, last => model%joints(j)%last)
         do i = first, last
            by_law(i - first + 1) = deflection_at_pressure(model%joints(j)%law%normal, analysis%states(i)%normal, &
                                                           analysis%exact(i)%normal)
         end do
         farthest = distance_of(analysis%states(first:last)%normal%lambda, by_law, noise*analysis%largest_lambda)
         farthest%element = first + farthest%element - 1
      end associate
   end function normal_distance

   !> The deflection at which the law, in its state EXACT, has the pressure of STATE: on the loading curve, or on the line of E_u through
   !! point A once it has been left. An open element has no pressure, and its own deflection is that of the law [length].
   pure real(wp) function deflection_at_pressure(law, state, exact) result(lambda)
      type(normal_law), intent(in)   :: law
      type(normal_state), intent(in) :: state, exact

      lambda = state%lambda
      if (.not. touches(state)) return
      associate (p => max(0.0_wp, state%pressure))
         if (exact%branch == branch_load .or. p >= exact%p_a) then
            lambda = loading_deflection(law, p)
         else
            lambda = exact%lambda_a - (exact%p_a - p)/law%e_u
         end if
      end associate
   end function deflection_at_pressure

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

   !> The largest difference between VALUE and BY_LAW, measured by the largest VALUE if that is above FLOOR; of values that
   !! rounding alone tells apart the first counts.
   pure type(distance_type) function distance_of(value, by_law, floor) result(farthest)
      real(wp), intent(in) :: value(:), by_law(:), floor
      real(wp) :: largest
      integer  :: i

      farthest%element = 1
      largest = maxval(abs(value))
      farthest%is_there = largest > floor
      if (.not. farthest%is_there) return
      do i = 1, size(value)
         if (abs(value(i) - by_law(i)) > (farthest%share + noise)*largest) then
            farthest%element = i
            farthest%share = abs(value(i) - by_law(i))/largest
         end if
      end do
      farthest%value = value(farthest%element)
      farthest%by_law = by_law(farthest%element)
   end function distance_of

end module law_distance
