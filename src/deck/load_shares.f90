!> Shares of a stage's load change that go to its increments (section 5: arithmetic or geometric progression).
module load_shares
   use kinds, only: wp
   implicit none
   private

   public :: arithmetic_shares, geometric_shares

contains

   !> N shares s_k = FIRST + (k - 1) d with sum 1: d = 2 (1 - N FIRST) / (N (N - 1)).
   !! OK is false where the last share would not be positive (FIRST >= 2/N).
   pure subroutine arithmetic_shares(n, first, shares, ok)
      integer, intent(in)                :: n     !! increments, 1 or more
      real(wp), intent(in)               :: first !! share of the first one, 0 < FIRST <= 1 (N = 1: not used)
      real(wp), allocatable, intent(out) :: shares(:)
      logical, intent(out)               :: ok
      real(wp) :: step
      integer  :: k

      ok = .true.
      allocate (shares(n), source=1.0_wp)
      if (n == 1) return
      step = 2.0_wp*(1.0_wp - n*first)/(real(n, wp)*(n - 1))
      do k = 1, n
         shares(k) = first + (k - 1)*step
      end do
      ok = shares(1) > 0.0_wp .and. shares(n) > 1.0e-12_wp
   end subroutine arithmetic_shares

   !> N shares s_k = FIRST r^(k - 1) with sum 1; the ratio r is found by bisection and closed by scaling.
   !! OK is false where no such r exists (FIRST >= 1 with N > 1).
   pure subroutine geometric_shares(n, first, shares, ok)
      integer, intent(in)                :: n
      real(wp), intent(in)               :: first !! 0 < FIRST < 1 (N = 1: not used)
      real(wp), allocatable, intent(out) :: shares(:)
      logical, intent(out)               :: ok
      real(wp) :: low, high, ratio
      integer  :: k

      allocate (shares(n), source=1.0_wp)
      ok = n == 1
      if (ok) return
      if (first <= 0.0_wp .or. first >= 1.0_wp) return
      low = 0.0_wp
      high = 1.0_wp
      do while (geometric_sum(n, first, high) < 1.0_wp)
         high = 2.0_wp*high
      end do
      do k = 1, 200
         ratio = 0.5_wp*(low + high)
         if (geometric_sum(n, first, ratio) < 1.0_wp) then
            low = ratio
         else
            high = ratio
         end if
      end do
      shares(1) = first
      do k = 2, n
         shares(k) = shares(k - 1)*ratio
      end do
      shares(2:) = shares(2:)*(1.0_wp - first)/sum(shares(2:))
      ok = all(shares > 1.0e-12_wp)
   end subroutine geometric_shares

   pure real(wp) function geometric_sum(n, first, ratio) result(total)
      integer, intent(in)  :: n
      real(wp), intent(in) :: first, ratio
      real(wp) :: term
      integer  :: k

      total = 0.0_wp
      term = first
      do k = 1, n
         total = total + term
         if (total > 2.0_wp) return
         term = term*ratio
      end do
   end function geometric_sum

end module load_shares
