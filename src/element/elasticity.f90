!> Hooke's law for each state of stress, principal stresses and the equivalent stress of von Mises.
!! Source: Zienkiewicz, Taylor, Zhu, The Finite Element Method, 6th ed., sections 2.2 and 6.2; vol. 2, the trigonometric solution of
!! the cubic.
module elasticity
   use kinds, only: wp
   implicit none
   private

   public :: elasticity_matrix, principal_stresses, von_mises

   !> States of stress. The components of stress and (engineering) strain are, in this order:
   integer, parameter, public :: plane_stress = 1   !! xx, yy, xy; sigma_zz = 0
   integer, parameter, public :: plane_strain = 2   !! xx, yy, xy; eps_zz = 0, sigma_zz = nu (sigma_xx + sigma_yy)
   integer, parameter, public :: axisymmetric = 3   !! rr, zz, theta theta, rz; r = x and z = y, the axis of symmetry is y
   integer, parameter, public :: solid = 4          !! xx, yy, zz, xy, yz, zx
   integer, parameter, public :: shell = 5          !! as solid, at the mean plane of the shell
   integer, parameter, public :: beam = 6           !! as solid, the axial stress at the centroid

   integer, parameter, public :: n_stresses(6) = [3, 3, 4, 6, 6, 6] !! number of components of each state
   integer, parameter, public :: max_stresses = 6
   integer, parameter, public :: strain_of(3, 3) = reshape([1, 4, 6, 4, 2, 5, 6, 5, 3], [3, 3]) !! component of the pair of axes p, q

contains

   !> [D] of {sigma} = [D] {epsilon} of an isotropic material: n_stresses(state) rows and columns, zero beyond.
   pure subroutine elasticity_matrix(state, e, nu, d)
      integer, intent(in)   :: state                          !! plane_stress ... solid
      real(wp), intent(in)  :: e                              !! modulus of elasticity [pressure], > 0
      real(wp), intent(in)  :: nu                             !! Poisson's ratio, -1 < nu < 0.5
      real(wp), intent(out) :: d(max_stresses, max_stresses)  !! [pressure]
      real(wp) :: e_plane, nu_plane, g, lame
      integer  :: i

      d = 0.0_wp
      select case (state)
      case (plane_stress, plane_strain)
         e_plane = e
         nu_plane = nu
         if (state == plane_strain) then
            e_plane = e/(1.0_wp - nu**2)
            nu_plane = nu/(1.0_wp - nu)
         end if
         d(1, 1) = e_plane/(1.0_wp - nu_plane**2)
         d(2, 2) = d(1, 1)
         d(1, 2) = nu_plane*d(1, 1)
         d(2, 1) = d(1, 2)
         d(3, 3) = 0.5_wp*e_plane/(1.0_wp + nu_plane)
      case (axisymmetric, solid)
         lame = e*nu/((1.0_wp + nu)*(1.0_wp - 2.0_wp*nu))
         g = 0.5_wp*e/(1.0_wp + nu)
         d(:3, :3) = lame
         do i = 1, 3
            d(i, i) = lame + 2.0_wp*g
         end do
         do i = 4, n_stresses(state)
            d(i, i) = g
         end do
      end select
   end subroutine elasticity_matrix

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

end module elasticity
