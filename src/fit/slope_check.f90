!> Where a fitted cubic loses its positive slope: a joint has no negative stiffness.
module slope_check
   use kinds, only: wp
   implicit none
   private

   public :: find_slope_loss

contains

   !> On the way from d = FROM to d = TO, the first d at which dP/dd = sum over k of k (a_k1 + a_k2 p) d^(k-1) is no longer
   !! positive for some p between P_LOW and P_HIGH. The slope is linear in p, so it is least at one end: two quadratics
   !! in d tell all.
   pure subroutine find_slope_loss(lines, p_low, p_high, from, to, found, p, d)
      real(wp), intent(in)  :: lines(2, 3)   !! a_k1 and a_k2 for k = 1, 2, 3
      real(wp), intent(in)  :: p_low, p_high !! [pressure]
      real(wp), intent(in)  :: from, to      !! [length], TO = +-huge: without end
      logical, intent(out)  :: found
      real(wp), intent(out) :: p, d          !! the place, where found
      real(wp) :: ends(2), place
      logical  :: lost
      integer  :: i

      found = .false.
      p = 0.0_wp
      d = 0.0_wp
      ends = [p_low, p_high]
      do i = 1, 2
         call find_first_root(lines(1, :) + lines(2, :)*ends(i), from, to, lost, place)
         if (.not. lost) cycle
         if (found) then
            if (abs(place - from) >= abs(d - from)) cycle
         end if
         found = .true.
         p = ends(i)
         d = place
      end do
   end subroutine find_slope_loss


   !> The first d from FROM to TO with a(1) + 2 a(2) d + 3 a(3) d^2 <= 0.
   pure subroutine find_first_root(a, from, to, found, d)
      real(wp), intent(in)  :: a(3), from, to
      logical, intent(out)  :: found
      real(wp), intent(out) :: d
      real(wp) :: discriminant, q, roots(2)
      integer  :: i, n

      d = from
      found = a(1) + from*(2.0_wp*a(2) + from*3.0_wp*a(3)) <= 0.0_wp
      if (found) return
      discriminant = a(2)**2 - 3.0_wp*a(3)*a(1)
      if (discriminant < 0.0_wp) return
      q = -(a(2) + sign(sqrt(discriminant), a(2)))
      n = 0
      if (abs(q) > 0.0_wp) then                ! the two roots q/(3 a3) and a1/q, without cancellation
         n = 1
         roots(n) = a(1)/q
         if (abs(a(3)) > tiny(q)) then
            n = 2
            roots(n) = q/(3.0_wp*a(3))
         end if
      end if
      do i = 1, n
         if ((roots(i) - from)*sign(1.0_wp, to - from) <= 0.0_wp) cycle
         if ((roots(i) - to)*sign(1.0_wp, to - from) > 0.0_wp) cycle
         if (found) then
            if (abs(roots(i) - from) >= abs(d - from)) cycle
         end if
         found = .true.
         d = roots(i)
      end do
   end subroutine find_first_root

end module slope_check
