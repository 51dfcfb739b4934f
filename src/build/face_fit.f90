!> The interface elements of one face of SIDE1: what each has of the face, and on which nodes of both sides it hangs, all times its
!! area, so that the faces at a node add up.
module face_fit
   use element_kinds, only: max_side_nodes
   use face_integrals, only: cover_integrals
   use face_shares, only: partial_shares, whole_shares
   use kinds, only: wp
   implicit none
   private

   public :: fit_face

   !> What a face gives to the element at each of its nodes; nothing but zeros where there is none.
   type, public :: face_part
      integer  :: n = 0                                                   !! nodes
      real(wp) :: area(max_side_nodes) = 0.0_wp                           !! [length^2]
      real(wp) :: normal(3, max_side_nodes) = 0.0_wp                      !! area times normal [length^2]
      real(wp) :: own(max_side_nodes, max_side_nodes) = 0.0_wp            !! (element, node k) area times weight [length^2]
      real(wp), allocatable :: opposite(:, :)                             !! (max_side_nodes, nodes opposite) likewise
   end type face_part

contains

   !> PART from the INTEGRALS over a face with N nodes. A whole face: the displacements u2 of SIDE2 under it are fitted by least
   !! squares, u2_k = sum of (M^-1)_kl times the integral of N_l u2, M that of N_k N_l; so that SIDE2, where it moves as the
   !! functions of the face do, is taken exactly, and a node over its partner hangs on that alone. A face partly covered: means
   !! of the displacements of both sides over what is covered, with the functions phi_i of the elements as weights.
   pure subroutine fit_face(dimension, n, is_whole, integrals, part)
      integer, intent(in)               :: dimension, n
      logical, intent(in)               :: is_whole
      type(cover_integrals), intent(in) :: integrals
      type(face_part), intent(inout)    :: part
      real(wp) :: share(max_side_nodes, max_side_nodes), fitted(n, integrals%n)
      integer  :: k

      part%n = n
      if (is_whole) then
         share = whole_shares(dimension, n)
         call solve_symmetric(integrals%own(:n, :n), integrals%opposite(:n, :integrals%n), fitted)
         do k = 1, n
            part%own(:, k) = share(:, k)*integrals%area(k)
         end do
         part%opposite = matmul(part%own(:, :n), fitted)
      else
         share = partial_shares(dimension, n)
         part%own(:, :n) = matmul(share(:, :n), integrals%own(:n, :n))
         part%opposite = matmul(share(:, :n), integrals%opposite(:n, :integrals%n))
      end if
      part%area = matmul(share(:, :n), integrals%area(:n))
      part%normal = matmul(integrals%normal(:, :n), transpose(share(:, :n)))
   end subroutine fit_face

   !> X of M X = B, M symmetric and positive definite: the factor of Cholesky.
   pure subroutine solve_symmetric(m, b, x)
      real(wp), intent(in)  :: m(:, :), b(:, :)
      real(wp), intent(out) :: x(:, :)
      real(wp) :: l(size(m, 1), size(m, 1))
      integer  :: i, k, n

      n = size(m, 1)
      l = 0.0_wp
      do k = 1, n
         l(k, k) = sqrt(m(k, k) - sum(l(k, :k - 1)**2))
         do i = k + 1, n
            l(i, k) = (m(i, k) - dot_product(l(i, :k - 1), l(k, :k - 1)))/l(k, k)
         end do
      end do
      x = b
      do k = 1, n
         x(k, :) = (x(k, :) - matmul(l(k, :k - 1), x(:k - 1, :)))/l(k, k)
      end do
      do k = n, 1, -1
         x(k, :) = (x(k, :) - matmul(l(k + 1:, k), x(k + 1:, :)))/l(k, k)
      end do
   end subroutine solve_symmetric

end module face_fit
