!> Equations between components, solved for others of them than those that they were written for.
module dependence_exchange
   use dependences, only: add_dependence, add_term, dependence_list
   use kinds, only: wp
   use reference_nodes, only: component_place
   implicit none
   private

   public :: solve_for

contains

   !> Of the items FIRST and on of LIST, each an equation c_j = sum of factor c_k, make such of the components at PLACES, as many, named in
   !! data fields AT: with [A] their coefficients in c_j - sum of factor c_k = 0 they are -[A]^-1 times the rest. Not OK where [A] has
   !! no inverse.
   subroutine solve_for(list, first, places, at, ok)
      type(dependence_list), intent(inout) :: list
      integer, intent(in)                  :: first
      type(component_place), intent(in)    :: places(:)
      integer, intent(in)                  :: at(:) !! (places)
      logical, intent(out)                 :: ok
      type(dependence_list) :: solved
      real(wp) :: a(size(places), 2*size(places))
      integer  :: i, j, k, n

      n = size(places)
      a = 0.0_wp
      do j = 1, n
         a(j, n + j) = 1.0_wp
         associate (item => list%item(first - 1 + j))
            do i = 1, n
               if (stands_at(i, item%node, item%d)) a(j, i) = a(j, i) + 1.0_wp
               do k = 1, item%n
                  if (stands_at(i, item%on(k), item%on_d(k))) a(j, i) = a(j, i) - item%factor(k)
               end do
            end do
         end associate
      end do
      call reduce(a, ok)
      if (.not. ok) return
      do i = 1, n
         call add_dependence(solved, places(i), list%item(first)%line, at(i))
         do j = 1, n
            associate (item => list%item(first - 1 + j), by => a(i, n + j))
               call add_other(item%node, item%d, -by)
               do k = 1, item%n
                  call add_other(item%on(k), item%on_d(k), by*item%factor(k))
               end do
            end associate
         end do
      end do
      list%item(first:list%n) = solved%item(:n)

   contains

      pure logical function stands_at(i, node, d)
         integer, intent(in) :: i, node, d

         stands_at = places(i)%node == node .and. places(i)%d == d
      end function stands_at

      subroutine add_other(node, d, factor)
         integer, intent(in)  :: node, d
         real(wp), intent(in) :: factor
         integer :: m

         if (.not. any([(stands_at(m, node, d), m = 1, n)])) call add_term(solved, component_place(node, d, 1.0_wp), factor)
      end subroutine add_other

   end subroutine solve_for

   !> Bring A = [M 1] to [1 M^-1], by rows, with the largest pivot of each column. Not OK where M has no inverse, to rounding.
   pure subroutine reduce(a, ok)
      real(wp), intent(inout) :: a(:, :) !! (n, 2 n)
      logical, intent(out)    :: ok
      real(wp), parameter :: rounding = 1.0e-10_wp ! of the largest entry: a pivot that is none
      real(wp) :: least, row(size(a, 2))
      integer  :: i, j, p

      least = rounding*maxval(abs(a(:, :size(a, 1))))
      ok = .true.
      do j = 1, size(a, 1)
         p = j - 1 + maxloc(abs(a(j:, j)), dim=1)
         ok = abs(a(p, j)) > least
         if (.not. ok) return
         row = a(p, :)/a(p, j)
         a(p, :) = a(j, :)
         do i = 1, size(a, 1)
            a(i, :) = a(i, :) - a(i, j)*row
         end do
         a(j, :) = row
      end do
   end subroutine reduce

end module dependence_exchange
