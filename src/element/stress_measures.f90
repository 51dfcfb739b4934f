!> Principal stresses and the equivalent stress of von Mises.
!! Source: Zienkiewicz, Taylor, Zhu, The Finite Element Method, 6th ed., vol. 2; the trigonometric solution of the cubic.
module stress_measures
   use kinds, only: wp
   implicit none
   private

   public :: principal_stresses, von_mises

contains

   !> The principal stresses, the largest first [pressure].
   pure function principal_stresses(s) result(p)
      real(wp), intent(in) :: s(6) !! xx, yy, zz, xy, yz, zx
      real(wp), parameter  :: third_turn = 2.0_wp*acos(-1.0_wp)/3.0_wp
      real(wp) :: p(3), d(6), mean, j2, j3, angle, r

      mean = sum(s(:3))/3.0_wp
      d = s
      d(:3) = s(:3) - mean
      j2 = 0.5_wp*sum(d(:3)**2) + sum(d(4:)**2)
      if (j2 <= 0.0_wp) then
         p = mean
         return
      end if
      r = sqrt(j2/3.0_wp)
      d = d/r                                    ! near 1, so that j3 neither overflows nor vanishes
      j3 = d(1)*(d(2)*d(3) - d(5)**2) - d(4)*(d(4)*d(3) - d(5)*d(6)) + d(6)*(d(4)*d(5) - d(2)*d(6))
      angle = acos(max(-1.0_wp, min(1.0_wp, 0.5_wp*j3)))/3.0_wp
      p = mean + 2.0_wp*r*cos([angle, angle - third_turn, angle + third_turn])
   end function principal_stresses

   !> The equivalent stress of von Mises, sqrt(3 J2) [pressure].
   pure real(wp) function von_mises(s) result(equivalent)
      real(wp), intent(in) :: s(6) !! xx, yy, zz, xy, yz, zx

      equivalent = sqrt(0.5_wp*((s(1) - s(2))**2 + (s(2) - s(3))**2 + (s(3) - s(1))**2) + 3.0_wp*sum(s(4:)**2))
   end function von_mises

end module stress_measures
