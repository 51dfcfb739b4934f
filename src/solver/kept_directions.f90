!> Directions in which coupled systems were solved, with their products with the stiffness, which are orthonormal: a load is reduced
!! along all of them at once. Rows are taken in chunks, by several threads; sums over the chunks have one order, so that no digit
!! depends on the number of threads.
!! Source: products are orthogonalised as blocks, twice: Barlow, Smoktunowicz, Numer. Math. 123 (2013) 395-423; among themselves by
!! Cholesky's factor of their Gram matrix, twice: Fukaya et al., SIAM J. Sci. Comput. 42 (2020) A477-A503.
module kept_directions
   use blas_lapack, only: dgemm, dgemv, dpotrf, dsygv, dtrsm
   use kinds, only: wp
   use tolerances, only: dependent_energy, dependent_product, equal_errors, no_error
   implicit none
   private

   public :: start_directions, make_room, orthonormalise, reduce_along

   integer, parameter :: chunk = 4096 ! rows

   type, public :: direction_set
      integer :: n = 0                          !! directions
      real(wp), allocatable :: u(:, :)          !! (rows, room for directions): row (node - 1)*dimension + direction [length]
      real(wp), allocatable :: force(:, :)      !! likewise, product of the factorised stiffness and u [force]
      real(wp), allocatable :: product(:, :)    !! likewise, product of the coupled stiffness and u [force]
   end type direction_set

contains

   !> No direction, with ROOM for some of so many ROWS.
   subroutine start_directions(set, rows, room)
      type(direction_set), intent(out) :: set
      integer, intent(in)              :: rows, room

      allocate (set%u(rows, room), set%force(rows, room), set%product(rows, room))
   end subroutine start_directions

   !> Where there is no room for MORE directions, keep half of the room at most: those combinations along which the factorised stiffness
   !! errs most, the eigenvectors of the largest eigenvalues of (P - F)^T (P - F), P the products and F the forces. Where F = P nearly a
   !! step with the factor does as well. Of nearly equal eigenvalues all are kept, or none: last bits do not choose.
   !! Source: de Sturler, SIAM J. Numer. Anal. 36 (1999) 864-889, who keeps what hinders convergence most.
   subroutine make_room(set, more)
      type(direction_set), intent(inout) :: set  !! its products orthonormal
      integer, intent(in)                :: more
      real(wp), allocatable :: combination(:, :), error(:, :), gram(:, :), values(:), work(:)
      integer :: fault, first, j, n, rows

      n = set%n
      if (n + more <= size(set%u, 2)) return
      rows = size(set%u, 1)
      allocate (values(n), work(34*n))
      error = set%product(:, :n) - set%force(:, :n)
      combination = inner_products(rows, n, n, error, error)
      gram = inner_products(rows, n, n, set%product, set%product)
      call dsygv(1, 'V', 'L', n, combination, n, gram, n, values, work, size(work), fault)
      if (fault /= 0) then ! products that are not orthonormal
         set%n = 0
         return
      end if
      first = n + 1 - max(0, min(n, size(set%u, 2)/2, size(set%u, 2) - more))
      do j = first, n
         if (values(j) > max(no_error, (1.0_wp + equal_errors)*values(max(1, j - 1)))) exit
      end do
      first = j
      set%n = n + 1 - first
      call combine(rows, n, set%n, combination(:, first:), set%u)
      call combine(rows, n, set%n, combination(:, first:), set%force)
      call combine(rows, n, set%n, combination(:, first:), set%product)
   end subroutine make_room

   !> Replace the N columns of A by the M columns of A C.
   subroutine combine(rows, n, m, c, a)
      integer, intent(in)     :: rows, n, m
      real(wp), intent(in)    :: c(n, m)
      real(wp), intent(inout) :: a(rows, n)
      real(wp), allocatable :: part(:, :)
      integer :: k, row

      !$omp parallel do default(shared) private(k, part) if(rows > chunk)
      do row = 1, rows, chunk
         k = min(chunk, rows - row + 1)
         allocate (part(k, m))
         call dgemm('N', 'N', k, m, n, 1.0_wp, a(row, 1), rows, c, n, 0.0_wp, part, k)
         a(row:row + k - 1, :m) = part
         deallocate (part)
      end do
      !$omp end parallel do
   end subroutine combine

   !> Make the products of the directions from FIRST on orthonormal, to each other and to those before. Directions of whose products
   !! nothing but rounding remains are left out.
   subroutine orthonormalise(set, first)
      type(direction_set), intent(inout) :: set
      integer, intent(in)                :: first
      real(wp), allocatable :: share(:, :), shares(:, :), gram(:, :)
      real(wp) :: length
      integer, allocatable :: order(:)
      integer  :: fault, j, k, pass, rank, rows

      k = set%n - first + 1
      if (k < 1) return
      rows = size(set%u, 1)
      do j = first, set%n
         length = norm2(set%product(:, j))
         if (.not. length > 0.0_wp) cycle
         set%u(:, j) = 1.0_wp/length*set%u(:, j)
         set%force(:, j) = 1.0_wp/length*set%force(:, j)
         set%product(:, j) = 1.0_wp/length*set%product(:, j)
      end do
      if (first > 1) then
         allocate (shares(first - 1, k), source=0.0_wp)
         do pass = 1, 2
            share = inner_products(rows, first - 1, k, set%product, set%product(1, first))
            call subtract_shares(rows, first - 1, k, set%product, share, set%product(1, first))
            shares = shares + share
         end do
         call subtract_shares(rows, first - 1, k, set%force, shares, set%force(1, first))
         call subtract_shares(rows, first - 1, k, set%u, shares, set%u(1, first))
      end if
      gram = inner_products(rows, k, k, set%product(1, first), set%product(1, first))
      call factorise(merge(dependent_product**2, dependent_energy, k == 1), gram, order)
      rank = size(order)
      set%n = first - 1 + rank
      order = first - 1 + order
      if (rank < k) then
         set%product(:, first:set%n) = set%product(:, order)
         set%force(:, first:set%n) = set%force(:, order)
         set%u(:, first:set%n) = set%u(:, order)
      end if
      if (rank > 0) call divide_columns(k, gram)
      if (k == 1 .or. rank == 0) return
      gram = inner_products(rows, rank, rank, set%product(1, first), set%product(1, first))
      call dpotrf('L', rank, gram, rank, fault)
      if (fault == 0) call divide_columns(rank, gram)

   contains

      !> The columns from FIRST on times the inverse of the transposed factor L.
      subroutine divide_columns(k, l)
         integer, intent(in)  :: k
         real(wp), intent(in) :: l(k, k)
         integer :: row, m

         !$omp parallel do default(shared) private(m) if(rows > chunk)
         do row = 1, rows, chunk
            m = min(chunk, rows - row + 1)
            call dtrsm('R', 'L', 'T', 'N', m, rank, 1.0_wp, l, k, set%product(row, first), rows)
            call dtrsm('R', 'L', 'T', 'N', m, rank, 1.0_wp, l, k, set%force(row, first), rows)
            call dtrsm('R', 'L', 'T', 'N', m, rank, 1.0_wp, l, k, set%u(row, first), rows)
         end do
         !$omp end parallel do
      end subroutine divide_columns

   end subroutine orthonormalise

   !> L, which replaces A, with L L^T = A for the rows TAKEN of A: those whose pivot, given the rows taken before, is above LEAST. They
   !! stay in their order, which with the largest pivots first would hang on last bits.
   pure subroutine factorise(least, a, taken)
      real(wp), intent(in)              :: least
      real(wp), intent(inout)           :: a(:, :)
      integer, allocatable, intent(out) :: taken(:)
      real(wp) :: l(size(a, 1), size(a, 1)), left
      integer  :: i, j, n

      l = 0.0_wp
      allocate (taken(0))
      do j = 1, size(a, 1)
         n = size(taken) + 1
         do i = 1, n - 1
            l(n, i) = (a(j, taken(i)) - dot_product(l(i, :i - 1), l(n, :i - 1)))/l(i, i)
         end do
         left = a(j, j) - sum(l(n, :n - 1)**2)
         if (.not. left > least) cycle
         l(n, n) = sqrt(left)
         taken = [taken, j]
      end do
      a = l
   end subroutine factorise

   !> Reduce COLUMNS of forces LEFT along the directions from FIRST on, whose part of the solution is added to U.
   subroutine reduce_along(set, first, columns, left, u)
      type(direction_set), intent(in) :: set
      integer, intent(in)             :: first, columns
      real(wp), intent(inout)         :: left(size(set%u, 1), columns) !! [force]
      real(wp), intent(inout)         :: u(size(set%u, 1), columns)    !! [length]
      real(wp), allocatable :: share(:, :)
      integer :: k, rows

      if (set%n < first) return
      rows = size(set%u, 1)
      k = set%n - first + 1
      share = inner_products(rows, k, columns, set%product(1, first), left)
      call subtract_shares(rows, k, columns, set%product(1, first), share, left)
      call subtract_shares(rows, k, columns, set%u(1, first), -share, u)
   end subroutine reduce_along

   !> A^T B, of K and N columns.
   function inner_products(rows, k, n, a, b) result(c)
      integer, intent(in)  :: rows, k, n
      real(wp), intent(in) :: a(rows, k), b(rows, n)
      real(wp) :: c(k, n)
      real(wp), allocatable :: of_chunk(:, :, :)
      integer :: i, row

      allocate (of_chunk(k, n, (rows - 1)/chunk + 1))
      !$omp parallel do default(shared) private(row) if(rows > chunk)
      do i = 1, size(of_chunk, 3)
         row = (i - 1)*chunk + 1
         if (n == 1) then
            call dgemv('T', min(chunk, rows - row + 1), k, 1.0_wp, a(row, 1), rows, b(row, 1), 1, 0.0_wp, of_chunk(1, 1, i), 1)
         else
            call dgemm('T', 'N', k, n, min(chunk, rows - row + 1), 1.0_wp, a(row, 1), rows, b(row, 1), rows, 0.0_wp, &
                       of_chunk(1, 1, i), k)
         end if
      end do
      !$omp end parallel do
      c = 0.0_wp
      do i = 1, size(of_chunk, 3)
         c = c + of_chunk(:, :, i)
      end do
   end function inner_products

   !> B = B - A SHARE, likewise.
   subroutine subtract_shares(rows, k, n, a, share, b)
      integer, intent(in)     :: rows, k, n
      real(wp), intent(in)    :: a(rows, k), share(k, n)
      real(wp), intent(inout) :: b(rows, n)
      integer :: row

      !$omp parallel do default(shared) if(rows > chunk)
      do row = 1, rows, chunk
         if (n == 1) then
            call dgemv('N', min(chunk, rows - row + 1), k, -1.0_wp, a(row, 1), rows, share, 1, 1.0_wp, b(row, 1), 1)
         else
            call dgemm('N', 'N', min(chunk, rows - row + 1), n, k, -1.0_wp, a(row, 1), rows, share, k, 1.0_wp, b(row, 1), rows)
         end if
      end do
      !$omp end parallel do
   end subroutine subtract_shares

end module kept_directions
