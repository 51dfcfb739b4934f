!> Hooke's law in the states of stress that the bodies can be in.
!! Source: Zienkiewicz, Taylor, Zhu, The Finite Element Method, 6th ed., sections 2.2 and 6.2.
module elasticity
   use kinds, only: wp
   implicit none
   private

   public :: elasticity_matrix

   !> States of stress. The components of stress and (engineering) strain are, in this order:
   integer, parameter, public :: plane_stress = 1   !! xx, yy, xy; sigma_zz = 0
   integer, parameter, public :: plane_strain = 2   !! xx, yy, xy; eps_zz = 0, sigma_zz = nu (sigma_xx + sigma_yy)
   integer, parameter, public :: axisymmetric = 3   !! rr, zz, theta theta, rz; r = x and z = y, the axis of symmetry is y
   integer, parameter, public :: solid = 4          !! xx, yy, zz, xy, yz, zx

   integer, parameter, public :: n_stresses(4) = [3, 3, 4, 6] !! components in every state
   integer, parameter, public :: max_stresses = 6

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

end module elasticity
