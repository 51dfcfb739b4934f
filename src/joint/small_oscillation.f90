!> What an interface element resists small oscillation about its present state with. Oscillation turns back all the time: where the
!! joint has been loaded it unloads first, and goes to and fro on its unloading branches, stiffer than it was on the way there. So the
!! joint of a structure that shakes is that of unloading, E_u and the slope that the shear unloading branch begins with; the tangent
!! of loading is what a slowly growing load sees. An element that stands apart has neither.
module small_oscillation
   use branch_cubic, only: cubic_slope
   use joint_laws, only: element_state, joint_law
   use kinds, only: wp
   use normal_curve, only: normal_tangent
   use normal_stiffness, only: touches
   use shear_stiffness, only: curve_deflection
   implicit none
   private

   public :: oscillation_stiffness

contains

   !> K = (k_sx, k_sy, k_n) under the present pressure p and shear deflections d [force/length]: E_u a_i and a_i B'(d; p), the slope of
   !! the unloading cubic; ON_LOADING dp/dlambda a_i and a_i A'(d; p) of the loading curves.
   pure function oscillation_stiffness(law, area, state, on_loading) result(k)
      type(joint_law), intent(in)     :: law
      real(wp), intent(in)            :: area       !! a_i [length^2]
      type(element_state), intent(in) :: state
      logical, intent(in)             :: on_loading
      real(wp) :: k(3)
      integer  :: i

      k = 0.0_wp
      if (.not. touches(state%normal)) return
      associate (p => max(0.0_wp, state%normal%pressure))
         k(3) = law%normal%e_u*area
         if (on_loading) k(3) = normal_tangent(law%normal, area, p, state%normal%p_av)
         do i = 1, 2
            if (.not. law%shear(i)%given) cycle
            if (on_loading) then
               k(i) = area*cubic_slope(law%shear(i)%load, abs(curve_deflection(state%shear(i))), p)
            else
               k(i) = area*cubic_slope(law%shear(i)%unload, curve_deflection(state%shear(i)), p)
            end if
         end do
      end associate
   end function oscillation_stiffness

end module small_oscillation
