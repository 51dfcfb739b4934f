!> The four-node plane element with linear shape functions and 2 x 2 Gauss integration.
!! Source: Smith, Griffiths, Margetts, Programming the Finite Element Method, 5th ed., sections 3.7 and 5.3.
module quad4
   use kinds, only: wp
   implicit none
   private

   public :: plane_elasticity, quad4_stiffness, quad4_stress, quad4_smallest_jacobian

   real(wp), parameter :: corner_r(4) = [-1.0_wp, 1.0_wp, 1.0_wp, -1.0_wp] ! corners counter-clockwise
   real(wp), parameter :: corner_s(4) = [-1.0_wp, -1.0_wp, 1.0_wp, 1.0_wp]
   real(wp), parameter :: gauss = 1.0_wp/sqrt(3.0_wp)

contains

   !> [D] of (sigma_x, sigma_y, tau_xy) = [D] (eps_x, eps_y, gamma_xy) for plane stress or plane strain.
   pure function plane_elasticity(e, nu, plane_strain) result(d)
      real(wp), intent(in) :: e            !! modulus of elasticity [pressure], > 0
      real(wp), intent(in) :: nu           !! Poisson's ratio, -1 < nu < 0.5
      logical, intent(in)  :: plane_strain
      real(wp) :: d(3, 3), e_plane, nu_plane

      e_plane = e
      nu_plane = nu
      if (plane_strain) then
         e_plane = e/(1.0_wp - nu**2)
         nu_plane = nu/(1.0_wp - nu)
      end if
      d = 0.0_wp
      d(1, 1) = e_plane/(1.0_wp - nu_plane**2)
      d(2, 2) = d(1, 1)
      d(1, 2) = nu_plane*d(1, 1)
      d(2, 1) = d(1, 2)
      d(3, 3) = 0.5_wp*e_plane/(1.0_wp + nu_plane)
   end function plane_elasticity


   !> [k] = sum over the Gauss points of [B]^T [D] [B] t det J.
   pure subroutine quad4_stiffness(x, d, thickness, k)
      real(wp), intent(in)  :: x(2, 4)     !! corners counter-clockwise [length]
      real(wp), intent(in)  :: d(3, 3)     !! elasticity [pressure]
      real(wp), intent(in)  :: thickness   !! [length]
      real(wp), intent(out) :: k(8, 8)     !! u_x, u_y of corner 1, of corner 2, ... [force/length]
      real(wp) :: b(3, 8), jacobian
      integer  :: i

      k = 0.0_wp
      do i = 1, 4
         call strain_matrix(x, gauss*corner_r(i), gauss*corner_s(i), b, jacobian)
         k = k + matmul(transpose(b), matmul(d, b))*(thickness*jacobian)
      end do
   end subroutine quad4_stiffness


   !> Stress (sigma_x, sigma_y, tau_xy) at the centre, where a linear element is at its best.
   pure function quad4_stress(x, d, u) result(stress)
      real(wp), intent(in) :: x(2, 4)
      real(wp), intent(in) :: d(3, 3)
      real(wp), intent(in) :: u(8)         !! displacements, ordered as in quad4_stiffness
      real(wp) :: stress(3), b(3, 8), jacobian

      call strain_matrix(x, 0.0_wp, 0.0_wp, b, jacobian)
      stress = matmul(d, matmul(b, u))
   end function quad4_stress


   !> The smallest det J over the corners, relative to the square of the longest side: not above 1E-12 (returned as
   !! zero or negative) for an element that is turned round, folded or flat.
   pure real(wp) function quad4_smallest_jacobian(x) result(smallest)
      real(wp), intent(in) :: x(2, 4)
      real(wp) :: a(2), b(2), longest
      integer  :: i, next, before

      smallest = huge(1.0_wp)
      longest = 0.0_wp
      do i = 1, 4
         next = modulo(i, 4) + 1
         before = modulo(i + 2, 4) + 1
         a = x(:, next) - x(:, i)
         b = x(:, before) - x(:, i)
         smallest = min(smallest, a(1)*b(2) - a(2)*b(1))
         longest = max(longest, dot_product(a, a))
      end do
      if (smallest <= 1.0e-12_wp*longest) smallest = min(smallest, 0.0_wp)
   end function quad4_smallest_jacobian


   !> [B] at the point (R, S) of the square -1..1, and det J there.
   pure subroutine strain_matrix(x, r, s, b, jacobian)
      real(wp), intent(in)  :: x(2, 4), r, s
      real(wp), intent(out) :: b(3, 8), jacobian
      real(wp) :: dn(2, 4), j(2, 2), dxy(2, 4)

      dn(1, :) = 0.25_wp*corner_r*(1.0_wp + s*corner_s)
      dn(2, :) = 0.25_wp*corner_s*(1.0_wp + r*corner_r)
      j = matmul(dn, transpose(x))
      jacobian = j(1, 1)*j(2, 2) - j(1, 2)*j(2, 1)
      dxy(1, :) = (j(2, 2)*dn(1, :) - j(1, 2)*dn(2, :))/jacobian
      dxy(2, :) = (j(1, 1)*dn(2, :) - j(2, 1)*dn(1, :))/jacobian
      b = 0.0_wp
      b(1, 1::2) = dxy(1, :)
      b(2, 2::2) = dxy(2, :)
      b(3, 1::2) = dxy(2, :)
      b(3, 2::2) = dxy(1, :)
   end subroutine strain_matrix

end module quad4
