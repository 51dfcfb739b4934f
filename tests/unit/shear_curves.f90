!> Shear laws of tests. Coefficients in the order of a JSHEAR card: a11, a12, a21, a22, a31, a32.
module shear_curves
   use branch_cubic, only: cubic
   use kinds, only: wp
   use shear_stiffness, only: shear_law
   implicit none
   private

   public :: closing_cubics, curve, one_cubic, three_cubics

contains

   pure type(cubic) function curve(coefficients)
      real(wp), intent(in) :: coefficients(6)

      curve = cubic(reshape(coefficients, [2, 3]))
   end function curve

   !> The same cubic on every branch.
   pure type(shear_law) function one_cubic(coefficients) result(law)
      real(wp), intent(in) :: coefficients(6)

      law = shear_law(given=.true., load=curve(coefficients), unload=curve(coefficients), reload=curve(coefficients))
   end function one_cubic

   !> Three cubics without a common coefficient: a call that takes the wrong branch, power or pressure is seen. All slopes are
   !! positive for |d| < 1, 0 < p < 3.
   pure type(shear_law) function three_cubics() result(law)
      law = shear_law(given=.true., load=curve([50.0_wp, 20.0_wp, -8.0_wp, -1.0_wp, 3.0_wp, 0.5_wp]), &
                      unload=curve([60.0_wp, 30.0_wp, 5.0_wp, 2.0_wp, 1.0_wp, 0.25_wp]), &
                      reload=curve([70.0_wp, 10.0_wp, -4.0_wp, 3.0_wp, 2.0_wp, 0.125_wp]))
   end function three_cubics

   !> Three cubics as of a test: a reloading branch is a little steeper than the unloading branch beside it, and meets the loading
   !! curve before the point that was left; an unloading branch stays above the loading curve of the other sense after d > 0.6,
   !! meets it else. All slopes are positive for |d| < 1, 0 < p < 3.
   pure type(shear_law) function closing_cubics() result(law)
      law = shear_law(given=.true., load=curve([50.0_wp, 20.0_wp, -30.0_wp, -8.0_wp, 8.0_wp, 2.0_wp]), &
                      unload=curve([46.0_wp, 18.0_wp, 10.0_wp, 2.0_wp, 0.0_wp, 0.0_wp]), &
                      reload=curve([60.0_wp, 22.0_wp, 1.0_wp, 0.5_wp, 0.0_wp, 0.0_wp]))
   end function closing_cubics

end module shear_curves
