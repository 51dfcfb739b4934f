!> The loading curve of the joint in its normal direction, Eq. (1): lambda = c p**m. NORM, the exact path and the secants of
!! BACK use this module. The line of unloading is in normal_stiffness.
module normal_curve
   use kinds, only: wp
   use tolerances, only: pressure_floor
   implicit none
   private

   public :: loading_deflection, loading_pressure, normal_secant, normal_tangent, curve_work

   !> The least m. The pressure (lambda/c)^(1/m) has 1/m times the relative error of lambda: at 1/1000 three of 16 digits are
   !! lost. The pressure overflows where lambda exceeds c by the factor 10^(308 m), about 2 at 1/1000. With a smaller m no
   !! iteration would converge.
   real(wp), parameter, public :: least_power = 1.0e-3_wp
   real(wp), parameter :: largest_pressure = 1.0e110_wp      ! of a distant trial: its square is still finite

   type, public :: normal_law
      real(wp) :: c   = 0.0_wp     !! [length/pressure^m], > 0
      real(wp) :: m   = 0.0_wp     !! [-], least_power <= m <= 1
      real(wp) :: e_u = 0.0_wp     !! E_u, slope dp/dlambda of unloading [pressure/length], > 0
   end type normal_law

contains

   !> p of the loading curve at LAMBDA >= 0, Eq. (1) [pressure].
   elemental real(wp) function loading_pressure(law, lambda) result(p)
      type(normal_law), intent(in) :: law
      real(wp), intent(in)         :: lambda

      p = min((lambda/law%c)**(1.0_wp/law%m), largest_pressure)
   end function loading_pressure

   !> lambda of the loading curve at P >= 0, Eq. (1) [length].
   elemental real(wp) function loading_deflection(law, p) result(lambda)
      type(normal_law), intent(in) :: law
      real(wp), intent(in)         :: p

      lambda = law%c*p**law%m
   end function loading_deflection

   !> Secant of the loading curve from 0 to P, Eq. (9), times AREA [force/length].
   pure real(wp) function normal_secant(law, area, p) result(k_n)
      type(normal_law), intent(in) :: law
      real(wp), intent(in)         :: area, p

      k_n = p**(1.0_wp - law%m)*area/law%c
   end function normal_secant

   !> Tangent of the loading curve at P, Eqs. (11), times AREA [force/length]. P is at least the floor: the tangent at p = 0 is
   !! zero.
   pure real(wp) function normal_tangent(law, area, p, p_av) result(k_n)
      type(normal_law), intent(in) :: law
      real(wp), intent(in)         :: area, p, p_av

      k_n = max(p, pressure_floor*p_av)**(1.0_wp - law%m)*area/(law%m*law%c)
   end function normal_tangent

   !> Integral of p d lambda along the loading curve from rest to (LAMBDA, P), a point of it [pressure x length].
   pure real(wp) function curve_work(law, lambda, p) result(work)
      type(normal_law), intent(in) :: law
      real(wp), intent(in)         :: lambda, p

      work = p*lambda*law%m/(1.0_wp + law%m)
   end function curve_work

end module normal_curve
