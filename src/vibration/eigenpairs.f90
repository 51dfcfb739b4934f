!> Eigenpairs of [k] {x} = lambda [m] {x} above a shift sigma, from the factor of [k] - sigma [m] of a solver. Spectral
!! transformation: ([k] - sigma [m])^-1 [m] {x} = nu {x}, nu = 1/(lambda - sigma). The eigenvalues next above sigma have the
!! largest nu, which the Lanczos method finds first. Small structures, and those of which most modes are wanted, are solved in
!! full.
!! Source: Ericsson, Ruhe, Math. Comp. 35 (1980) 1251-1268; Lehoucq, Sorensen, Yang, ARPACK Users' Guide, SIAM 1998, section 3.2.
module eigenpairs
   use blas_lapack, only: dsygv
   use equation_solver, only: equation_system, failure_type
   use kinds, only: wp
   use mass_matrix, only: mass_matrix_type, mass_times
   use model_data, only: model_type
   use node_coupling, only: displacements, forces_on_unknowns
   use text_tools, only: integer_text
   use tolerances, only: massless, settled_shape
   implicit none
   private

   public :: find_eigenpairs, improve_eigenpairs, residual_displacements, needs_all, all_displacements, on_equations

   interface

      !> One step of the implicitly restarted Lanczos method.
      subroutine dsaupd(ido, bmat, n, which, nev, tol, resid, ncv, v, ldv, iparam, ipntr, workd, workl, lworkl, info)
         import :: wp
         integer, intent(inout)      :: ido, iparam(11), ipntr(11), info
         character, intent(in)       :: bmat
         integer, intent(in)         :: n, nev, ncv, ldv, lworkl
         character(2), intent(in)    :: which
         real(wp), intent(in)        :: tol
         real(wp), intent(inout)     :: resid(n), v(ldv, ncv), workd(3*n), workl(lworkl)
      end subroutine dsaupd

      !> The eigenvalues D and, where RVEC, eigenvectors Z from dsaupd; the arguments after SIGMA are those of dsaupd.
      subroutine dseupd(rvec, howmny, select, d, z, ldz, sigma, bmat, n, which, nev, tol, resid, ncv, v, ldv, iparam, ipntr, &
                        workd, workl, lworkl, info)
         import :: wp
         logical, intent(in)         :: rvec
         character, intent(in)       :: howmny, bmat
         integer, intent(in)         :: ldz, n, nev, ncv, ldv, lworkl
         logical, intent(inout)      :: select(ncv)
         real(wp), intent(inout)     :: d(nev), z(ldz, nev), resid(n), v(ldv, ncv), workd(2*n), workl(lworkl)
         real(wp), intent(in)        :: sigma, tol
         character(2), intent(in)    :: which
         integer, intent(inout)      :: iparam(7), ipntr(11), info
      end subroutine dseupd
   end interface

   integer, parameter  :: small = 150                !! unknowns of a structure that is solved in full
   integer, parameter  :: most_restarts = 500
   integer, parameter  :: most_steps = 6          !! of subspace iteration, which then costs more than a new search
   integer, parameter  :: worth_threads = 20000      !! unknowns
   integer, parameter  :: zero_vector = -9, exhausted = -9999 ! codes of ARPACK: no more vectors with mass
   integer, parameter  :: restarts_used_up = 1                           ! likewise: restarts used up, perhaps there are no more

contains

   !> Whether to find all eigenvalues of SYSTEM at once where N are wanted.
   pure logical function needs_all(system, n)
      class(equation_system), intent(in) :: system
      integer, intent(in)                :: n

      needs_all = system%n <= small .or. n > system%n/2
   end function needs_all

   !> The N eigenvalues LAMBDA next above the shift of SYSTEM, ascending, and their vectors X, x^T [m] x = 1; fewer where fewer
   !! exist. Where N is the number of unknowns, the shift must be below all eigenvalues. TOLERANCE: of 1/(lambda - sigma), relative.
   subroutine find_eigenpairs(model, mass, system, n, tolerance, lambda, x, failure)
      type(model_type), intent(in)       :: model
      type(mass_matrix_type), intent(in) :: mass
      class(equation_system), intent(in) :: system   !! factorised
      integer, intent(in)                :: n
      real(wp), intent(in)               :: tolerance
      real(wp), allocatable, intent(out) :: lambda(:) !! [1/time^2]
      real(wp), allocatable, intent(out) :: x(:, :)   !! (equations, n)
      type(failure_type), intent(inout)  :: failure
      real(wp), allocatable :: m(:, :), k(:, :), nu(:), work(:)
      integer :: first, i, info, status

      if (n < system%n) then
         call iterate(model, mass, system, n, tolerance, lambda, x, failure)
         if (failure%raised) return
         do first = 2, size(lambda) ! few, and almost sorted
            do i = first, 2, -1
               if (lambda(i) >= lambda(i - 1)) exit
               lambda([i - 1, i]) = lambda([i, i - 1])
               x(:, [i - 1, i]) = x(:, [i, i - 1])
            end do
         end do
         return
      end if

      ! all finite eigenvalues: of [m] {x} = nu ([k] - sigma [m]) {x}, whose matrix on the right is positive definite
      allocate (m(system%n, system%n), k(system%n, system%n), nu(system%n), work(34*system%n), source=0.0_wp, stat=status)
      if (status /= 0) then
         call failure%raise('MODES: no memory for all modes of '//integer_text(system%n)//' unknowns')
         return
      end if
      do i = 1, system%n
         m(i, i) = 1.0_wp
         k(:, i) = m(:, i)
         call times_mass(model, mass, system, m(:, i))
         call system%multiply_by_factor(k(:, i))
         if (any(system%locked == i)) k(i, i) = 1.0_wp
      end do
      call dsygv(1, 'V', 'L', system%n, m, system%n, k, system%n, nu, work, size(work), info)
      if (info /= 0) then
         call failure%raise('MODES: the stiffness is not positive definite')
         return
      end if
      first = findloc(nu > massless*nu(system%n), .true., dim=1)
      if (first == 0) first = system%n + 1
      lambda = [(system%shift + 1.0_wp/nu(i), i = system%n, first, -1)]
      x = m(:, system%n:first:-1)/spread(sqrt(nu(system%n:first:-1)), 1, system%n) ! x^T ([k] - sigma [m]) x was 1
   end subroutine find_eigenpairs

   !> The N next above the shift by ARPACK. Where fewer vectors have mass, ARPACK reports it and has found a basis of all of them.
   subroutine iterate(model, mass, system, n, tolerance, lambda, x, failure)
      type(model_type), intent(in)       :: model
      type(mass_matrix_type), intent(in) :: mass
      class(equation_system), intent(in) :: system
      integer, intent(in)                :: n
      real(wp), intent(in)               :: tolerance
      real(wp), allocatable, intent(out) :: lambda(:), x(:, :)
      type(failure_type), intent(inout)  :: failure
      real(wp), allocatable :: v(:, :), residual(:), work(:), small_work(:)
      logical, allocatable  :: chosen(:)
      integer, allocatable  :: above(:)
      integer :: columns, i, ido, info, parameters(11), places(11), status

      columns = min(system%n, max(2*n + 1, n + 20))
      allocate (lambda(n), x(system%n, n), v(system%n, columns), residual(system%n), work(3*system%n), &
                small_work(columns*(columns + 8)), chosen(columns), stat=status)
      if (status /= 0) then
         call failure%raise('MODES: no memory for '//integer_text(columns)//' vectors of '//integer_text(system%n)//' unknowns')
         return
      end if
      residual = 1.0_wp + 0.5_wp*sin(12.9898_wp*system%node + 78.233_wp*system%direction) ! no symmetry, whatever the numbering
      residual(system%locked) = 0.0_wp
      parameters = 0
      parameters([1, 3, 7]) = [1, most_restarts, 3]
      ido = 0
      info = 1 ! given start vector: every run is the same
      do
         call dsaupd(ido, 'G', system%n, 'LA', n, tolerance, residual, columns, v, system%n, parameters, places, work, &
                     small_work, size(small_work), info)
         if (ido == 99) exit
         associate (from => places(1), to => places(2), of_mass => places(3))
            x(:, 1) = work(merge(of_mass, from, ido == 1):merge(of_mass, from, ido == 1) + system%n - 1)
            if (ido /= 1) call times_mass(model, mass, system, x(:, 1))
            if (abs(ido) == 1) call system%solve_by_factor(x(:, 1))
            x(system%locked, 1) = 0.0_wp
            work(to:to + system%n - 1) = x(:, 1)
         end associate
      end do
      if (info == zero_vector) parameters(5) = 0
      if (info == zero_vector .or. info == exhausted) then
         call solve_in_subspace(model, mass, system, v(:, :parameters(5)), lambda, x, failure)
         return
      end if
      if (info == restarts_used_up .and. parameters(5) == 0 .and. system%shift > 0.0_wp) info = 0 ! all may be below the shift
      if (parameters(5) > 0 .and. (info == 0 .or. info == restarts_used_up)) &
         call dseupd(.true., 'A', chosen, lambda, x, system%n, system%shift, 'G', system%n, 'LA', n, tolerance, residual, &
                     columns, v, system%n, parameters, places, work, small_work, size(small_work), info)
      if (info /= 0) then
         call failure%raise('MODES: of '//integer_text(n)//' modes '//integer_text(parameters(5))//' were found in '// &
                            integer_text(parameters(3))//' restarts (ARPACK says '//integer_text(info)//')')
         return
      end if
      above = pack([(i, i = 1, parameters(5))], lambda(:parameters(5)) > system%shift)
      lambda = lambda(above)
      x = x(:, above)
   end subroutine iterate

   !> All finite eigenvalues above the shift, from a basis V of all vectors with mass, v_i^T [m] v_j = 1 or 0: those of the
   !! small symmetric matrix V^T [m] ([k] - sigma [m])^-1 [m] V.
   subroutine solve_in_subspace(model, mass, system, v, lambda, x, failure)
      type(model_type), intent(in)       :: model
      type(mass_matrix_type), intent(in) :: mass
      class(equation_system), intent(in) :: system
      real(wp), intent(in)               :: v(:, :)
      real(wp), allocatable, intent(out) :: lambda(:), x(:, :)
      type(failure_type), intent(inout)  :: failure
      real(wp) :: t(size(v, 2), size(v, 2)), unit(size(v, 2), size(v, 2)), nu(size(v, 2)), work(34*size(v, 2) + 1), y(system%n)
      integer  :: i, info, n

      n = size(v, 2)
      unit = 0.0_wp
      do i = 1, n
         unit(i, i) = 1.0_wp
         y = v(:, i)
         call times_mass(model, mass, system, y)
         call system%solve_by_factor(y)
         y(system%locked) = 0.0_wp
         call times_mass(model, mass, system, y)
         t(:, i) = matmul(y, v)
      end do
      t = 0.5_wp*(t + transpose(t))
      info = 0
      if (n > 0) call dsygv(1, 'V', 'L', n, t, n, unit, n, nu, work, size(work), info)
      if (info /= 0) then
         call failure%raise('MODES: no eigenvalues of '//integer_text(n)//' modes')
         return
      end if
      i = 0
      if (n > 0) i = count(nu > massless*nu(n) .and. nu > 0.0_wp)
      lambda = system%shift + 1.0_wp/nu(n:n - i + 1:-1)
      x = matmul(v, t(:, n:n - i + 1:-1))
   end subroutine solve_in_subspace

   !> The lowest eigenpairs by subspace iteration from vectors near them, without shift: each step solves for all vectors at
   !! once, and Rayleigh and Ritz find the best combinations. Two vectors of no symmetry are added, by which a mode comes in that
   !! the start lacks. IS_FOUND: the residual of the first N is so small that its square, the order of the error, is within
   !! TOLERANCE of 1/lambda, and that of the others within its root: they are near modes.
   !! Source: Bathe, Finite Element Procedures, Prentice Hall 1996, section 11.6.
   subroutine improve_eigenpairs(model, mass, system, near, n, tolerance, lambda, x, is_found)
      type(model_type), intent(in)       :: model
      type(mass_matrix_type), intent(in) :: mass
      class(equation_system), intent(in) :: system     !! factorised without shift
      real(wp), intent(in)               :: near(:, :) !! (components of all nodes, modes) [length]
      integer, intent(in)                :: n          !! no more modes than in NEAR
      real(wp), intent(in)               :: tolerance
      real(wp), allocatable, intent(out) :: lambda(:)  !! (modes of NEAR, and two) ascending [1/time^2]
      real(wp), allocatable, intent(out) :: x(:, :)    !! (equations, modes) x^T [m] x = 1
      logical, intent(out)               :: is_found
      real(wp), allocatable :: f(:, :), of_mass(:, :), of_y(:, :), y(:, :)
      real(wp), dimension(size(near, 2) + 2, size(near, 2) + 2) :: a, b
      real(wp) :: nu(size(a, 1)), work(34*size(a, 1))
      integer  :: i, info, m, step

      m = size(a, 1)
      allocate (of_mass(system%n, m), of_y(system%n, m), y(system%n, m), f(model%mesh%dimension, model%mesh%n_nodes))
      do i = 1, m - 2
         call mass_times(model, mass, reshape(near(:, i), shape(f)), f)
         of_mass(:, i) = on_equations(model, system, f)
      end do
      of_mass(:, m - 1) = 1.0_wp + 0.5_wp*sin(12.9898_wp*system%node + 78.233_wp*system%direction) ! as in iterate
      of_mass(:, m) = cos(39.3468_wp*system%node + 11.135_wp*system%direction)
      is_found = .false.
      do step = 1, most_steps
         y = of_mass
         call system%solve_many(y)
         of_y = y
         do i = 1, m
            call times_mass(model, mass, system, of_y(:, i))
         end do
         a = matmul(transpose(y), of_mass) ! Y^T [k] Y
         b = matmul(transpose(y), of_y)
         if (step > 1) is_found = all([(b(i, i) - 2.0_wp*nu(i)*a(i, i) + nu(i)**2 <= &
                                        merge(tolerance, sqrt(tolerance), i <= n)*nu(i)**2, i = 1, m - 2)])
         nu = sqrt([(a(i, i), i = 1, m)])
         a = a/spread(nu, 1, m)/spread(nu, 2, m)
         b = b/spread(nu, 1, m)/spread(nu, 2, m)
         y = y/spread(nu, 1, system%n)
         of_y = of_y/spread(nu, 1, system%n)
         call dsygv(1, 'V', 'L', m, b, m, a, m, nu, work, size(work), info)
         if (info == 0) info = merge(0, 1, nu(1) > massless*nu(m))
         is_found = is_found .and. info == 0
         if (info /= 0) return ! dependent, or without mass
         nu = nu(m:1:-1)
         b = b(:, m:1:-1)/spread(sqrt(nu), 1, m) ! x^T [k] x was 1
         of_mass = matmul(of_y, b)
         if (is_found) exit
      end do
      lambda = 1.0_wp/nu
      x = matmul(y, b)
   end subroutine improve_eigenpairs

   !> The displacements U under LOAD less the load that the MODES balance, rigid-body modes among them: the residual flexibility
   !! of an unsupported structure by inertia relief, [k] u = f - [m] phi (phi . f). Each iteration solves with the factor of
   !! SYSTEM, whose shift sigma is negative, ([k] - sigma [m]) u = ... - sigma [m] u; it leaves |sigma|/(lambda + |sigma|) of the
   !! error, lambda the lowest eigenvalue not among the MODES.
   subroutine residual_displacements(model, mass, system, modes, load, u)
      type(model_type), intent(in)       :: model
      type(mass_matrix_type), intent(in) :: mass
      class(equation_system), intent(in) :: system      !! factorised
      real(wp), intent(in)               :: modes(:, :) !! (equations, modes) x^T [m] x = 1
      real(wp), intent(in)               :: load(:)     !! (equations) [force]
      real(wp), intent(out)              :: u(:)        !! (equations) [length]
      real(wp) :: before(size(u)), of_mass(size(u), size(modes, 2)), rest(size(u))
      integer  :: i

      of_mass = modes
      do i = 1, size(modes, 2)
         call times_mass(model, mass, system, of_mass(:, i))
      end do
      rest = load - matmul(of_mass, matmul(load, modes))
      u = 0.0_wp
      do i = 1, most_restarts
         before = u
         call times_mass(model, mass, system, u)
         u = rest - system%shift*u
         call system%solve_by_factor(u)
         u(system%locked) = 0.0_wp
         u = u - matmul(modes, matmul(u, of_mass))
         if (norm2(u - before) <= settled_shape*norm2(u)) exit
      end do
   end subroutine residual_displacements

   !> Replace X by [m] X on the equations; zero where locked.
   subroutine times_mass(model, mass, system, x)
      type(model_type), intent(in)       :: model
      type(mass_matrix_type), intent(in) :: mass
      class(equation_system), intent(in) :: system
      real(wp), intent(inout)            :: x(:)
      real(wp), allocatable :: f(:, :)

      x(system%locked) = 0.0_wp
      allocate (f(model%mesh%dimension, model%mesh%n_nodes))
      call mass_times(model, mass, all_displacements(model, system, x), f)
      x = on_equations(model, system, f)
   end subroutine times_mass

   !> Condense the forces F on all nodes to the equations; zero where locked.
   function on_equations(model, system, f) result(x)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      real(wp), intent(in)               :: f(:, :) !! (dimension, n_nodes) [force]
      real(wp) :: x(system%n)
      real(wp), allocatable :: on_unknowns(:, :)
      integer :: i

      allocate (on_unknowns, source=forces_on_unknowns(model, f))
      !$omp parallel do default(shared) if(system%n > worth_threads)
      do i = 1, system%n
         x(i) = on_unknowns(system%direction(i), system%node(i))
      end do
      !$omp end parallel do
      x(system%locked) = 0.0_wp
   end function on_equations

   !> Displacements of all nodes under X(equation), zero where held.
   function all_displacements(model, system, x) result(u)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      real(wp), intent(in)               :: x(:)
      real(wp), allocatable :: u(:, :)
      integer :: i

      allocate (u(model%mesh%dimension, model%mesh%n_nodes), source=0.0_wp)
      !$omp parallel do default(shared) if(system%n > worth_threads)
      do i = 1, system%n
         u(system%direction(i), system%node(i)) = x(i)
      end do
      !$omp end parallel do
      if (model%freedoms%coupling%n > 0) u = displacements(model, u)
   end function all_displacements

end module eigenpairs
