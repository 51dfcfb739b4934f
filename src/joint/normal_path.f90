!> The exact normal law of the joint over one step, for methods that iterate to equilibrium:
!! the loading curve p = (lambda/c)**(1/m) beyond point A, the straight line p_A - E_u (lambda_A - lambda) below it, and
!! nothing once that line has come down to zero.
module normal_path
   use kinds, only: wp
   use normal_stiffness, only: branch_load, branch_open, branch_reload, branch_unload, normal_law, normal_state, &
                               pressure_floor
   implicit none
   private

   public :: follow_normal

contains

   !> Follow the law from the state BEFORE to the deflection LAMBDA.
   pure subroutine follow_normal(law, area, before, lambda, after, slope, work)
      type(normal_law), intent(in)    :: law
      real(wp), intent(in)            :: area   !! a_i [length^2]
      type(normal_state), intent(in)  :: before !! in equilibrium; its point A is the farthest point of the loading curve
      real(wp), intent(in)            :: lambda !! [length]
      type(normal_state), intent(out) :: after
      real(wp), intent(out)           :: slope  !! dp/dlambda at LAMBDA [pressure/length]; zero where open
      real(wp), intent(out)           :: work   !! done on the element, integral of p a d lambda [force x length]
      real(wp) :: unloaded

      after = before
      after%lambda_before = before%lambda
      after%sigmaf = before%sumf
      after%lambda = lambda
      unloaded = before%p_a - law%e_u*(before%lambda_a - lambda)
      if (lambda >= before%lambda_a .and. lambda > 0.0_wp) then
         after%branch = branch_load
         after%pressure = (lambda/law%c)**(1.0_wp/law%m)
         after%lambda_a = lambda
         after%p_a = after%pressure
         slope = max(after%pressure, pressure_floor*law%p_av)**(1.0_wp - law%m)/(law%m*law%c)
      else if (unloaded > 0.0_wp) then
         after%branch = merge(branch_reload, branch_unload, lambda > before%lambda)
         after%pressure = unloaded
         slope = law%e_u
      else
         after%branch = branch_open
         after%pressure = 0.0_wp
         after%lambda_b = before%lambda_a - before%p_a/law%e_u
         slope = 0.0_wp
      end if
      if (abs(lambda - before%lambda) <= 0.0_wp) after%branch = before%branch ! at rest
      after%sumf = after%pressure*area
      work = area*(stored(law, after) - stored(law, before))
   end subroutine follow_normal


   !> Integral of p d lambda from rest to LAMBDA along the loading curve to A and back along the line, for a state with
   !! this point A [pressure x length].
   pure real(wp) function stored(law, state)
      type(normal_law), intent(in)   :: law
      type(normal_state), intent(in) :: state

      stored = state%p_a*state%lambda_a*law%m/(1.0_wp + law%m) - 0.5_wp*(state%p_a**2 - state%pressure**2)/law%e_u
   end function stored

end module normal_path
