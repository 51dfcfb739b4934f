!> Classical laminates: plies of orthotropic plane stress, their integrals over the thickness, and the transverse shear stiffness.
!! Source: R. M. Jones, Mechanics of Composite Materials, 2nd ed., sections 2.6, 4.2 and 4.5.
module laminate
   use kinds, only: wp
   implicit none
   private

   public :: make_ply, ply_turn, shear_flexibility

   !> A ply, in the axes of its laminate; heights are above the mid-plane.
   type, public :: ply_type
      real(wp) :: q(3, 3) = 0.0_wp             !! plane stress: xx, yy, xy [pressure]
      real(wp) :: heat(3) = 0.0_wp             !! [Q] {alpha}: stress per unit of restrained warming [pressure/temperature]
      real(wp) :: shear(2) = 0.0_wp            !! G of xz and yz; 0: rigid [pressure]
      real(wp) :: from = 0.0_wp, to = 0.0_wp   !! heights of its faces [length]
      real(wp) :: angle = 0.0_wp               !! of its direction 1 from x [rad]
      integer  :: id = 0
      logical  :: shown = .false.              !! SOUT
   end type ply_type

contains

   !> Give PLY its material, with STRESS the matrix of plane stress in the axes 1, 2 of the ply, ALPHA its expansions and SHEAR its
   !! moduli 1z and 2z, turned by its angle.
   pure subroutine make_ply(stress, alpha, shear, ply)
      real(wp), intent(in) :: stress(3, 3)     !! [pressure]
      real(wp), intent(in) :: alpha(3)         !! 1, 2, 12 [1/temperature]
      real(wp), intent(in) :: shear(2)         !! [pressure]
      type(ply_type), intent(inout) :: ply

      associate (r => ply_turn(ply%angle), c => cos(ply%angle)**2, s => sin(ply%angle)**2)
         ply%q = matmul(transpose(r), matmul(stress, r))
         ply%heat = matmul(matmul(stress, alpha), r)
         ply%shear = [c*shear(1) + s*shear(2), s*shear(1) + c*shear(2)]
      end associate
   end subroutine make_ply

   !> The matrix that gives the strains 11, 22, 12 of axes at ANGLE from xx, yy, xy; its transposed gives stresses xx, yy, xy.
   pure function ply_turn(angle) result(r)
      real(wp), intent(in) :: angle            !! [rad]
      real(wp) :: r(3, 3)

      associate (c => cos(angle), s => sin(angle))
         r = reshape([c**2, s**2, -2.0_wp*c*s, s**2, c**2, 2.0_wp*c*s, c*s, -c*s, c**2 - s**2], [3, 3])
      end associate
   end function ply_turn

   !> Transverse shear flexibility of PLIES in the direction K, x or y: the energy of the shear stresses that are in equilibrium
   !! with the stresses of bending in that direction, for a unit force per length. Of one ply it is 6/5/(G t).
   pure real(wp) function shear_flexibility(plies, k) result(flexibility)
      type(ply_type), intent(in) :: plies(:)
      integer, intent(in)        :: k
      real(wp), parameter :: at(3) = sqrt(0.6_wp)*[-1.0_wp, 0.0_wp, 1.0_wp], weight(3) = [5.0_wp, 8.0_wp, 5.0_wp]/18.0_wp
      real(wp) :: moment(0:2), neutral, tau(3), z(3), below
      integer  :: i

      moment = 0.0_wp
      do i = 1, size(plies)
         associate (p => plies(i))
            moment = moment + p%q(k, k)*[p%to - p%from, (p%to**2 - p%from**2)/2.0_wp, (p%to**3 - p%from**3)/3.0_wp]
         end associate
      end do
      neutral = moment(1)/moment(0)
      below = 0.0_wp                           ! integral of E (z - neutral) up to the ply
      flexibility = 0.0_wp
      do i = 1, size(plies)
         associate (p => plies(i))
            z = 0.5_wp*(p%from + p%to) + 0.5_wp*at*(p%to - p%from) - neutral
            tau = (below + 0.5_wp*p%q(k, k)*(z**2 - (p%from - neutral)**2))/(moment(2) - neutral*moment(1))
            if (p%shear(k) > 0.0_wp) flexibility = flexibility + (p%to - p%from)*sum(weight*tau**2)/p%shear(k)
            below = below + 0.5_wp*p%q(k, k)*((p%to - neutral)**2 - (p%from - neutral)**2)
         end associate
      end do
   end function shear_flexibility

end module laminate
