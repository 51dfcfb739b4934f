!> Modes of equal frequency: of a square column those that bend either way, say. Every combination of them is a mode; which one an
!! algorithm comes to is a matter of rounding. Here it is settled: the first has all the participation along x that they have, the next
!! of what is left all along y, then z; what participates in nothing is told apart by the displacements of the nodes, in their order.
module equal_modes
   use kinds, only: wp
   implicit none
   private

   public :: settle_equal_modes, settle_sign

   real(wp), parameter :: equal = 1.0e-7_wp    ! of the larger eigenvalue: two that differ by less are one
   real(wp), parameter :: weak = 1.0e-6_wp     ! of the largest: a row that is no more tells no mode apart
   real(wp), parameter :: near = 0.9283_wp     ! of the largest component: it is not rounding that chooses between equals

contains

   !> Turn the shapes of every group of equal LAMBDA among themselves.
   subroutine settle_equal_modes(lambda, mass, participation, u)
      real(wp), intent(in)    :: lambda(:)           !! ascending
      real(wp), intent(in)    :: mass                !! of the structure
      real(wp), intent(inout) :: participation(:, :) !! (directions, modes)
      real(wp), intent(inout) :: u(:, :, :)          !! (dimension, n_nodes, modes), of generalised mass 1
      integer :: first, last

      first = 1
      do while (first <= size(lambda))
         last = first
         do while (last < size(lambda))
            if (lambda(last + 1) - lambda(last) > equal*abs(lambda(last + 1))) exit
            last = last + 1
         end do
         if (last > first) call settle_group(weak*sqrt(mass), participation(:, first:last), u(:, :, first:last))
         first = last + 1
      end do
   end subroutine settle_equal_modes

   !> Turn the modes of one group: row after row of PARTICIPATION above LEAST, then of U, what is not yet settled goes to one mode.
   subroutine settle_group(least, participation, u)
      real(wp), intent(in)    :: least
      real(wp), intent(inout) :: participation(:, :), u(:, :, :)
      integer :: at(2), d, next

      next = 1
      do d = 1, size(participation, 1)
         if (next == size(u, 3)) return
         if (norm2(participation(d, next:)) > least) call give_to_one((participation(d, next:)))
      end do
      do while (next < size(u, 3))
         at = first_large(u(:, :, next:))
         call give_to_one((u(at(1), at(2), next:)))
      end do

   contains

      !> Reflect the modes from NEXT on (Householder) so that the first of them has all of ROW, and go on behind it.
      subroutine give_to_one(row)
         real(wp), intent(in) :: row(:)
         real(wp) :: v(size(row)), along
         integer  :: c, n

         v = row
         v(1) = v(1) + sign(norm2(row), row(1))
         v = v/norm2(v)
         do n = 1, size(participation, 1)
            along = dot_product(v, participation(n, next:))
            participation(n, next:) = participation(n, next:) - 2.0_wp*along*v
         end do
         do n = 1, size(u, 2)
            do c = 1, size(u, 1)
               along = dot_product(v, u(c, n, next:))
               u(c, n, next:) = u(c, n, next:) - 2.0_wp*along*v
            end do
         end do
         next = next + 1
      end subroutine give_to_one

   end subroutine settle_group

   !> The first component and node, in their order, where the displacements of all modes together are as good as largest.
   pure function first_large(u) result(at)
      real(wp), intent(in) :: u(:, :, :)
      integer  :: at(2), d, i
      real(wp) :: much

      at = 1
      much = near*sqrt(maxval(sum(u**2, dim=3)))
      do i = 1, size(u, 2)
         do d = 1, size(u, 1)
            at = [d, i]
            if (norm2(u(d, i, :)) >= much) return
         end do
      end do
   end function first_large

   !> The sign of a shape: that of its largest component, of as good as equal ones the first, is positive.
   pure subroutine settle_sign(participation, u)
      real(wp), intent(inout) :: participation(:), u(:, :)
      real(wp) :: much
      integer  :: d, i

      much = near*maxval(abs(u))
      do i = 1, size(u, 2)
         do d = 1, size(u, 1)
            if (abs(u(d, i)) < much) cycle
            if (u(d, i) < 0.0_wp) then
               u = -u
               participation = -participation
            end if
            return
         end do
      end do
   end subroutine settle_sign

end module equal_modes
