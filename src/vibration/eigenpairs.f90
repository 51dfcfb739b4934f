!> Eigenpairs of [k] {x} = lambda [m] {x} above a shift sigma, from the factor of [k] - sigma [m] that a solver has. Spectral
!! transformation: ([k] - sigma [m])^-1 [m] {x} = nu {x}, nu = 1/(lambda - sigma); the eigenvalues next above sigma are the largest nu,
!! which the Lanczos method finds first. Small structures are solved as a whole.
!! Source: Ericsson, Ruhe, Math. Comp. 35 (1980) 1251-1268; Lehoucq, Sorensen, Yang, ARPACK Users' Guide, SIAM 1998, section 3.2.
module eigenpairs
   use arpack, only: dsaupd, dseupd
   use blas_lapack, only: dsygv
   use equation_solver, only: equation_system
   use failures, only: failure_type
   use kinds, only: wp
   use mass_matrix, only: mass_matrix_type, mass_times
   use model_data, only: model_type
   use node_coupling, only: displacements, forces_on_unknowns
   use text_tools, only: integer_text
   implicit none
   private

   public :: find_eigenpairs, is_small, all_displacements

   integer, parameter  :: small = 150                !! unknowns of a structure that is solved as a whole
   integer, parameter  :: most_restarts = 500
   real(wp), parameter :: tolerance = 1.0e-13_wp     ! of nu, of what Lanczos estimates its error
   real(wp), parameter :: finite = 1.0e-12_wp        ! of the largest nu: what is below has no mass to speak of

contains

   !> Whether all eigenvalues of SYSTEM are found at once, whatever the shift below them.
   pure logical function is_small(system)
      class(equation_system), intent(in) :: system

      is_small = system%n <= small
   end function is_small

   !> The N eigenvalues LAMBDA next above the shift of SYSTEM, ascending, and their vectors X, x^T [m] x = 1; fewer where there are not
   !! so many. Of a small structure all that there are above the shift, which has to be below all of them.
   subroutine find_eigenpairs(model, mass, system, n, lambda, x, failure)
      type(model_type), intent(in)       :: model
      type(mass_matrix_type), intent(in) :: mass
      class(equation_system), intent(in) :: system   !! factorised
      integer, intent(in)                :: n
      real(wp), allocatable, intent(out) :: lambda(:) !! [1/time^2]
      real(wp), allocatable, intent(out) :: x(:, :)   !! (equations, n)
      type(failure_type), intent(inout)  :: failure
      integer :: i, k

      if (is_small(system)) then
         call solve_whole(model, mass, system, lambda, x, failure)
      else
         call iterate(model, mass, system, min(n, system%n - 1), lambda, x, failure)
      end if
      if (failure%raised) return
      do i = 2, size(lambda) ! few, and nearly in order
         do k = i, 2, -1
            if (lambda(k) >= lambda(k - 1)) exit
            lambda([k - 1, k]) = lambda([k, k - 1])
            x(:, [k - 1, k]) = x(:, [k, k - 1])
         end do
      end do
   end subroutine find_eigenpairs

   !> All finite eigenvalues: of [m] {x} = nu ([k] - sigma [m]) {x}, whose matrix on the right is positive definite.
   subroutine solve_whole(model, mass, system, lambda, x, failure)
      type(model_type), intent(in)       :: model
      type(mass_matrix_type), intent(in) :: mass
      class(equation_system), intent(in) :: system
      real(wp), allocatable, intent(out) :: lambda(:), x(:, :)
      type(failure_type), intent(inout)  :: failure
      real(wp) :: m(system%n, system%n), k(system%n, system%n), nu(system%n), work(34*system%n)
      integer  :: first, i, info

      m = 0.0_wp
      k = 0.0_wp
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
      first = findloc(nu > finite*nu(system%n), .true., dim=1)
      if (first == 0) first = system%n + 1
      lambda = [(system%shift + 1.0_wp/nu(i), i = system%n, first, -1)]
      allocate (x(system%n, size(lambda)))
      do i = 1, size(lambda)
         x(:, i) = m(:, system%n + 1 - i)/sqrt(nu(system%n + 1 - i)) ! x^T ([k] - sigma [m]) x was 1
      end do
   end subroutine solve_whole

   !> The N next above the shift by ARPACK.
   subroutine iterate(model, mass, system, n, lambda, x, failure)
      type(model_type), intent(in)       :: model
      type(mass_matrix_type), intent(in) :: mass
      class(equation_system), intent(in) :: system
      integer, intent(in)                :: n
      real(wp), allocatable, intent(out) :: lambda(:), x(:, :)
      type(failure_type), intent(inout)  :: failure
      real(wp), allocatable :: v(:, :), residual(:), work(:), small_work(:)
      logical, allocatable  :: chosen(:)
      integer :: columns, ido, info, parameters(11), places(11), status

      columns = min(system%n, max(2*n + 1, n + 20))
      allocate (lambda(n), x(system%n, n), v(system%n, columns), residual(system%n), work(3*system%n), &
                small_work(columns*(columns + 8)), chosen(columns), stat=status)
      if (status /= 0) then
         call failure%raise('MODES: no memory for '//integer_text(columns)//' vectors of '//integer_text(system%n)//' unknowns')
         return
      end if
      residual = start_vector(system)
      parameters = 0
      parameters([1, 3, 7]) = [1, most_restarts, 3]
      ido = 0
      info = 1 ! the start vector is given: every run is the same
      do
         call dsaupd(ido, 'G', system%n, 'LA', n, tolerance, residual, columns, v, system%n, parameters, places, work, small_work, &
                     size(small_work), info)
         if (ido == 99) exit
         associate (from => places(1), to => places(2), of_mass => places(3))
            select case (ido)
            case (-1)
               x(:, 1) = work(from:from + system%n - 1)
               call times_mass(model, mass, system, x(:, 1))
               call system%solve_by_factor(x(:, 1))
            case (1)
               x(:, 1) = work(of_mass:of_mass + system%n - 1)
               call system%solve_by_factor(x(:, 1))
            case default
               x(:, 1) = work(from:from + system%n - 1)
               call times_mass(model, mass, system, x(:, 1))
            end select
            x(system%locked, 1) = 0.0_wp
            work(to:to + system%n - 1) = x(:, 1)
         end associate
      end do
      if (info == 0) call dseupd(.true., 'A', chosen, lambda, x, system%n, system%shift, 'G', system%n, 'LA', n, tolerance, &
                                 residual, columns, v, system%n, parameters, places, work, small_work, size(small_work), info)
      if (info /= 0) call failure%raise('MODES: of '//integer_text(n)//' modes '//integer_text(parameters(5))// &
                                        ' were found in '//integer_text(parameters(3))//' restarts (ARPACK says '// &
                                        integer_text(info)//'); are there so many below infinity?')
   end subroutine iterate

   !> A vector without any symmetry, the same for every numbering of the equations.
   pure function start_vector(system) result(x)
      class(equation_system), intent(in) :: system
      real(wp) :: x(system%n)
      integer  :: i

      do i = 1, system%n
         x(i) = 1.0_wp + 0.5_wp*sin(12.9898_wp*system%node(i) + 78.233_wp*system%direction(i))
      end do
      x(system%locked) = 0.0_wp
   end function start_vector

   !> X becomes [m] X on the equations; locked ones take no part.
   subroutine times_mass(model, mass, system, x)
      type(model_type), intent(in)       :: model
      type(mass_matrix_type), intent(in) :: mass
      class(equation_system), intent(in) :: system
      real(wp), intent(inout)            :: x(:)
      real(wp), allocatable :: f(:, :)
      integer :: i

      x(system%locked) = 0.0_wp
      allocate (f(model%dimension, model%n_nodes))
      call mass_times(model, mass, all_displacements(model, system, x), f)
      if (allocated(model%coupling%of_node)) f = forces_on_unknowns(model, f)
      do i = 1, system%n
         x(i) = f(system%direction(i), system%node(i))
      end do
      x(system%locked) = 0.0_wp
   end subroutine times_mass

   !> Displacements of all nodes under X(equation), zero where held.
   pure function all_displacements(model, system, x) result(u)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      real(wp), intent(in)               :: x(:)
      real(wp), allocatable :: u(:, :)
      integer :: i

      allocate (u(model%dimension, model%n_nodes), source=0.0_wp)
      do i = 1, system%n
         u(system%direction(i), system%node(i)) = x(i)
      end do
      if (allocated(model%coupling%of_node)) u = displacements(model, u)
   end function all_displacements

end module eigenpairs
