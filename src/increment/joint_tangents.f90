!> Tangent stiffness of the interface elements in the state that the last increment has left, whatever the method.
module joint_tangents
   use analysis_state, only: analysis_type
   use case_control, only: method_back, method_newton
   use joint_laws, only: element_state, element_stiffness_of
   use kinds, only: wp
   use model_data, only: model_type
   implicit none
   private

   public :: tangents_now

contains

   !> (3, n): k_sx, k_sy, k_n of every interface element [force/length]. STEP: those of its next increment; NEWTON: those of the
   !! equilibrium; BACK: the slopes of the loading curves where its secants end. None along the joint where the element slips.
   pure function tangents_now(model, analysis, method) result(k)
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      integer, intent(in)             :: method !! of case control
      real(wp) :: k(3, size(model%interface))
      type(element_state) :: state
      integer :: i

      do i = 1, size(model%interface)
         state = analysis%states(i)
         select case (method)
         case (method_newton)
            k(:, i) = [state%shear%k_s, state%normal%k_n]
         case (method_back)
            call element_stiffness_of(model%joints(model%interface(i)%joint)%law, model%interface(i)%area, .false., &
                                      analysis%movement(:, i), state, k(:, i))
         case default
            k(:, i) = analysis%k(:, i)
         end select
         if (state%slips) k(:2, i) = 0.0_wp
      end do
   end function tangents_now

end module joint_tangents
