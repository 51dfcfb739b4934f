!> The solution of the distributed equations by PETSc: conjugate gradients, preconditioned by smoothed aggregation (GAMG) with the
!! motions of a rigid body, or by the factor of MUMPS. The preconditioner of an earlier stiffness is kept while that pays. All
!! processes call every routine in step.
!! Source: Adams, Bayraktar, Keaveny, Papadopoulos, Proc. SC2004; Amestoy et al., SIAM J. Matrix Anal. Appl. 23 (2001) 15-41.
module distributed_solution
   use, intrinsic :: iso_c_binding, only: c_int, c_null_ptr, c_ptr
   use distributed_matrix, only: check, distributed_matrix_type, put_vector, take_vector
   use kinds, only: wp
   use petsc_library
   implicit none
   private

   public :: start_solution, renew_preconditioner, solve_distributed, free_solution, set_library_options

   integer, parameter, public :: by_gamg = 1, by_mumps = 2

   type, public :: distributed_solution_type
      type(c_ptr) :: solver = c_null_ptr
      logical  :: has_guess = .false.          !! x holds an earlier solution
      integer  :: steps = 0                    !! of the last solution
      real(wp) :: residual = 0.0_wp            !! of that, as a share of the load
      logical  :: converged = .true.
   end type distributed_solution_type

   real(wp), parameter :: tolerance = 1.0e-12_wp !! of the residual, as a share of the load
   real(wp), parameter :: loosest = 1.0e-9_wp    !! that is still a solution where rounding allows no more
   integer, parameter  :: most_steps = 500
   integer, parameter  :: most_solutions = 3     !! one after another, each from where the one before has come

contains

   !> Options that have no function; before the library is started, so that the user's (PETSC_OPTIONS) come after them.
   subroutine set_library_options()
      call set('-jointfem_pc_gamg_threshold', '0.01')
      call set('-jointfem_mg_levels_ksp_type', 'chebyshev')
      call set('-jointfem_mg_levels_pc_type', 'jacobi')
      call set('-jointfem_mg_levels_ksp_chebyshev_esteig', '0,0.05,0,1.1')
      call set('-jointfem_pc_gamg_agg_nsmooths', '1')
      call set('-jointfem_pc_use_amat', '1') ! the finest level multiplies as the steps do

   contains

      subroutine set(name, value)
         character(*), intent(in) :: name, value

         call check(petsc_options_set_value(c_null_ptr, name//char(0), value//char(0)))
      end subroutine set

   end subroutine set_library_options

   !> A solver of the equations with STIFFNESS, WAY is by_gamg or by_mumps.
   subroutine start_solution(stiffness, way, solution)
      type(distributed_matrix_type), intent(in)    :: stiffness
      integer, intent(in)                          :: way
      type(distributed_solution_type), intent(out) :: solution
      type(c_ptr) :: preconditioner

      associate (ksp => solution%solver)
         call check(ksp_create(petsc_comm_world, ksp))
         call check(ksp_set_options_prefix(ksp, 'jointfem_'//char(0)))
         call check(ksp_set_type(ksp, 'cg'//char(0)))
         call check(ksp_set_norm_type(ksp, unpreconditioned))
         call check(ksp_set_tolerances(ksp, tolerance, 1.0e-300_wp, 1.0e5_wp, most_steps))
         call check(ksp_set_initial_guess_nonzero(ksp, petsc_true))
         call check(ksp_set_operators(ksp, stiffness%products, stiffness%matrix))
         call check(ksp_get_pc(ksp, preconditioner))
         if (way == by_gamg) then
            call check(pc_set_type(preconditioner, 'gamg'//char(0)))
         else
            call check(pc_set_type(preconditioner, 'cholesky'//char(0)))
            call check(pc_factor_set_solver(preconditioner, 'mumps'//char(0)))
         end if
         call check(ksp_set_from_options(ksp))
         call check(ksp_set_reuse_preconditioner(ksp, petsc_false))
      end associate
   end subroutine start_solution

   !> Make the preconditioner anew, of the stiffness as it is now.
   subroutine renew_preconditioner(stiffness, solution)
      type(distributed_matrix_type), intent(in)      :: stiffness
      type(distributed_solution_type), intent(inout) :: solution

      call check(ksp_set_reuse_preconditioner(solution%solver, petsc_false))
      call check(ksp_set_operators(solution%solver, stiffness%products, stiffness%matrix))
      call check(ksp_set_up(solution%solver))
      call check(ksp_set_reuse_preconditioner(solution%solver, petsc_true))
   end subroutine renew_preconditioner

   !> X, of rank 0, the load row after row, becomes the solution; STEPS, RESIDUAL and whether it has CONVERGED tell how.
   subroutine solve_distributed(stiffness, solution, x)
      type(distributed_matrix_type), intent(in)      :: stiffness
      type(distributed_solution_type), intent(inout) :: solution
      real(wp), intent(inout)                        :: x(:)
      integer(c_int) :: reason, steps
      integer  :: again
      real(wp) :: load, left

      call put_vector(x, stiffness, stiffness%b)
      call check(vec_norm(stiffness%b, norm_2, load))
      solution%steps = 0
      solution%residual = 0.0_wp
      solution%converged = .true.
      if (.not. load > 0.0_wp) then
         call check(vec_scale(stiffness%x, 0.0_wp))
         solution%has_guess = .false.
      else
         call scale_guess(stiffness, solution)
         do again = 1, most_solutions            ! the steps keep a residual of their own, which parts from the true one
            call check(ksp_solve(solution%solver, stiffness%b, stiffness%x))
            call check(ksp_get_iteration_number(solution%solver, steps))
            call check(ksp_get_converged_reason(solution%solver, reason))
            solution%steps = solution%steps + steps
            call check(mat_mult(stiffness%products, stiffness%x, stiffness%r))
            call check(vec_aypx(stiffness%r, -1.0_wp, stiffness%b))
            call check(vec_norm(stiffness%r, norm_2, left))
            solution%residual = left/load
            if (reason <= 0 .or. solution%residual <= 10.0_wp*tolerance) exit
         end do
         solution%converged = solution%residual <= loosest
         solution%has_guess = solution%converged
      end if
      call take_vector(stiffness%x, stiffness, x)
   end subroutine solve_distributed

   !> The first guess: the solution before, by that factor with which its energy comes nearest; zero where there is none.
   subroutine scale_guess(stiffness, solution)
      type(distributed_matrix_type), intent(in)   :: stiffness
      type(distributed_solution_type), intent(in) :: solution
      real(wp) :: energy, work, factor

      factor = 0.0_wp
      if (solution%has_guess) then
         call check(mat_mult(stiffness%products, stiffness%x, stiffness%r))
         call check(vec_dot(stiffness%r, stiffness%x, energy))
         call check(vec_dot(stiffness%b, stiffness%x, work))
         if (energy > 0.0_wp) factor = work/energy
      end if
      call check(vec_scale(stiffness%x, factor))
   end subroutine scale_guess

   subroutine free_solution(solution)
      type(distributed_solution_type), intent(inout) :: solution

      call check(ksp_destroy(solution%solver))
   end subroutine free_solution

end module distributed_solution
