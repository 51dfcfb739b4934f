!> Declares the functions of PETSc 3.18 that the program uses, as in the C headers of PETSc.
!! Matrices, vectors and Krylov solvers are handles. Every function returns an error code, 0 for none. PetscInt has 32 bits and
!! PetscScalar is a double: the real build of Debian, with Open MPI.
!! Source: PETSc Users Manual, ANL-21/39 Rev 3.18.
module petsc_library
   use, intrinsic :: iso_c_binding, only: c_char, c_double, c_funptr, c_int, c_ptr
   implicit none
   public

   integer(c_int), parameter :: insert_values = 1, add_values = 2            ! InsertMode
   integer(c_int), parameter :: final_assembly = 0                           ! MatAssemblyType
   integer(c_int), parameter :: petsc_false = 0, petsc_true = 1              ! PetscBool
   integer(c_int), parameter :: norm_2 = 1                                   ! NormType
   integer(c_int), parameter :: mat_ignore_lower = 12, mat_spd = 15, mat_spd_eternal = 26 ! MatOption
   integer(c_int), parameter :: out_of_memory = 55                           ! PETSC_ERR_MEM
   integer(c_int), parameter :: no_memory_for_factor = 3                     ! PC_FACTOR_OUTMEMORY of PCFailedReason

   type(c_ptr), bind(c, name='PETSC_COMM_WORLD') :: petsc_comm_world

   interface
      integer(c_int) function petsc_initialize() bind(c, name='PetscInitializeNoArguments')
         import :: c_int
      end function petsc_initialize

      integer(c_int) function petsc_finalize() bind(c, name='PetscFinalize')
         import :: c_int
      end function petsc_finalize

      integer(c_int) function petsc_pop_signal_handler() bind(c, name='PetscPopSignalHandler')
         import :: c_int
      end function petsc_pop_signal_handler

      integer(c_int) function petsc_push_error_handler(handler, context) bind(c, name='PetscPushErrorHandler')
         import :: c_funptr, c_int, c_ptr
         type(c_funptr), value :: handler
         type(c_ptr), value    :: context
      end function petsc_push_error_handler

      !> Returns the error code without a message; for petsc_push_error_handler.
      subroutine petsc_return_error_handler() bind(c, name='PetscReturnErrorHandler')
      end subroutine petsc_return_error_handler

      integer(c_int) function petsc_options_set_value(options, name, value) bind(c, name='PetscOptionsSetValue')
         import :: c_char, c_int, c_ptr
         type(c_ptr), value                 :: options
         character(kind=c_char), intent(in) :: name(*), value(*)
      end function petsc_options_set_value

      ! ---------------------------------------------------------------------------------------------------- vectors

      !> Creates vectors for the argument and the result of a product with MATRIX.
      integer(c_int) function mat_create_vecs(matrix, right, left) bind(c, name='MatCreateVecs')
         import :: c_int, c_ptr
         type(c_ptr), value       :: matrix
         type(c_ptr), intent(out) :: right, left
      end function mat_create_vecs

      integer(c_int) function vec_duplicate(vector, other) bind(c, name='VecDuplicate')
         import :: c_int, c_ptr
         type(c_ptr), value       :: vector
         type(c_ptr), intent(out) :: other
      end function vec_duplicate

      !> Gives access to the values of this process until vec_restore_array.
      integer(c_int) function vec_get_array(vector, values) bind(c, name='VecGetArray')
         import :: c_int, c_ptr
         type(c_ptr), value       :: vector
         type(c_ptr), intent(out) :: values
      end function vec_get_array

      integer(c_int) function vec_restore_array(vector, values) bind(c, name='VecRestoreArray')
         import :: c_int, c_ptr
         type(c_ptr), value         :: vector
         type(c_ptr), intent(inout) :: values
      end function vec_restore_array

      integer(c_int) function vec_destroy(vector) bind(c, name='VecDestroy')
         import :: c_int, c_ptr
         type(c_ptr), intent(inout) :: vector
      end function vec_destroy

      integer(c_int) function vec_norm(vector, norm_type, norm) bind(c, name='VecNorm')
         import :: c_double, c_int, c_ptr
         type(c_ptr), value          :: vector
         integer(c_int), value       :: norm_type
         real(c_double), intent(out) :: norm
      end function vec_norm

      integer(c_int) function vec_dot(x, y, product) bind(c, name='VecDot')
         import :: c_double, c_int, c_ptr
         type(c_ptr), value          :: x, y
         real(c_double), intent(out) :: product
      end function vec_dot

      !> y = x
      integer(c_int) function vec_copy(x, y) bind(c, name='VecCopy')
         import :: c_int, c_ptr
         type(c_ptr), value :: x, y
      end function vec_copy

      !> Dot PRODUCTS of X with N other vectors.
      integer(c_int) function vec_many_dot(x, n, y, products) bind(c, name='VecMDot')
         import :: c_double, c_int, c_ptr
         type(c_ptr), value          :: x
         integer(c_int), value       :: n
         type(c_ptr), intent(in)     :: y(*)
         real(c_double), intent(out) :: products(*)
      end function vec_many_dot

      !> y = y + sum of a x
      integer(c_int) function vec_many_axpy(y, n, a, x) bind(c, name='VecMAXPY')
         import :: c_double, c_int, c_ptr
         type(c_ptr), value         :: y
         integer(c_int), value      :: n
         real(c_double), intent(in) :: a(*)
         type(c_ptr), intent(in)    :: x(*)
      end function vec_many_axpy

      !> y = y + a x
      integer(c_int) function vec_axpy(y, a, x) bind(c, name='VecAXPY')
         import :: c_double, c_int, c_ptr
         type(c_ptr), value    :: y, x
         real(c_double), value :: a
      end function vec_axpy

      !> y = x + a y
      integer(c_int) function vec_aypx(y, a, x) bind(c, name='VecAYPX')
         import :: c_double, c_int, c_ptr
         type(c_ptr), value    :: y, x
         real(c_double), value :: a
      end function vec_aypx

      integer(c_int) function vec_scale(x, a) bind(c, name='VecScale')
         import :: c_double, c_int, c_ptr
         type(c_ptr), value    :: x
         real(c_double), value :: a
      end function vec_scale

      ! ---------------------------------------------------------------------------------------------------- matrices

      integer(c_int) function mat_create(comm, matrix) bind(c, name='MatCreate')
         import :: c_int, c_ptr
         type(c_ptr), value       :: comm
         type(c_ptr), intent(out) :: matrix
      end function mat_create

      integer(c_int) function mat_set_sizes(matrix, own_rows, own_columns, rows, columns) bind(c, name='MatSetSizes')
         import :: c_int, c_ptr
         type(c_ptr), value    :: matrix
         integer(c_int), value :: own_rows, own_columns, rows, columns
      end function mat_set_sizes

      integer(c_int) function mat_set_type(matrix, type) bind(c, name='MatSetType')
         import :: c_char, c_int, c_ptr
         type(c_ptr), value                 :: matrix
         character(kind=c_char), intent(in) :: type(*)
      end function mat_set_type

      integer(c_int) function mat_set_block_size(matrix, size) bind(c, name='MatSetBlockSize')
         import :: c_int, c_ptr
         type(c_ptr), value    :: matrix
         integer(c_int), value :: size
      end function mat_set_block_size

      !> Reserves blocks in every row of blocks of this process: in its own columns, and in those of others. The second pair of counts is
      !! for types that store the upper blocks only.
      integer(c_int) function mat_set_preallocation(matrix, block_size, own, others, own_upper, others_upper) &
         bind(c, name='MatXAIJSetPreallocation')
         import :: c_int, c_ptr
         type(c_ptr), value         :: matrix
         integer(c_int), value      :: block_size
         integer(c_int), intent(in) :: own(*), others(*), own_upper(*), others_upper(*)
      end function mat_set_preallocation

      integer(c_int) function mat_set_option(matrix, option, value) bind(c, name='MatSetOption')
         import :: c_int, c_ptr
         type(c_ptr), value    :: matrix
         integer(c_int), value :: option, value
      end function mat_set_option

      !> Inserts or adds VALUES, row after row.
      integer(c_int) function mat_set_values_blocked(matrix, m, rows, n, columns, values, mode) bind(c, name='MatSetValuesBlocked')
         import :: c_double, c_int, c_ptr
         type(c_ptr), value         :: matrix
         integer(c_int), value      :: m, n
         integer(c_int), intent(in) :: rows(*), columns(*) !! of blocks, from 0
         real(c_double), intent(in) :: values(*)
         integer(c_int), value      :: mode
      end function mat_set_values_blocked

      integer(c_int) function mat_get_values(matrix, m, rows, n, columns, values) bind(c, name='MatGetValues')
         import :: c_double, c_int, c_ptr
         type(c_ptr), value          :: matrix
         integer(c_int), value       :: m, n
         integer(c_int), intent(in)  :: rows(*), columns(*) !! from 0
         real(c_double), intent(out) :: values(*)
      end function mat_get_values

      integer(c_int) function mat_assembly_begin(matrix, type) bind(c, name='MatAssemblyBegin')
         import :: c_int, c_ptr
         type(c_ptr), value    :: matrix
         integer(c_int), value :: type
      end function mat_assembly_begin

      integer(c_int) function mat_assembly_end(matrix, type) bind(c, name='MatAssemblyEnd')
         import :: c_int, c_ptr
         type(c_ptr), value    :: matrix
         integer(c_int), value :: type
      end function mat_assembly_end

      !> Row ROW of this process, from 0: N columns, ascending, and their values, until mat_restore_row.
      integer(c_int) function mat_get_row(matrix, row, n, columns, values) bind(c, name='MatGetRow')
         import :: c_int, c_ptr
         type(c_ptr), value          :: matrix
         integer(c_int), value       :: row
         integer(c_int), intent(out) :: n
         type(c_ptr), intent(out)    :: columns, values
      end function mat_get_row

      integer(c_int) function mat_restore_row(matrix, row, n, columns, values) bind(c, name='MatRestoreRow')
         import :: c_int, c_ptr
         type(c_ptr), value            :: matrix
         integer(c_int), value         :: row
         integer(c_int), intent(inout) :: n
         type(c_ptr), intent(inout)    :: columns, values
      end function mat_restore_row

      integer(c_int) function mat_mult(matrix, x, y) bind(c, name='MatMult')
         import :: c_int, c_ptr
         type(c_ptr), value :: matrix, x, y
      end function mat_mult

      integer(c_int) function mat_get_diagonal(matrix, vector) bind(c, name='MatGetDiagonal')
         import :: c_int, c_ptr
         type(c_ptr), value :: matrix, vector
      end function mat_get_diagonal

      integer(c_int) function mat_null_space_create(comm, has_constant, n, vectors, null_space) bind(c, name='MatNullSpaceCreate')
         import :: c_int, c_ptr
         type(c_ptr), value       :: comm
         integer(c_int), value    :: has_constant, n
         type(c_ptr), intent(in)  :: vectors(*)
         type(c_ptr), intent(out) :: null_space
      end function mat_null_space_create

      integer(c_int) function mat_null_space_destroy(null_space) bind(c, name='MatNullSpaceDestroy')
         import :: c_int, c_ptr
         type(c_ptr), intent(inout) :: null_space
      end function mat_null_space_destroy

      integer(c_int) function mat_set_near_null_space(matrix, null_space) bind(c, name='MatSetNearNullSpace')
         import :: c_int, c_ptr
         type(c_ptr), value :: matrix, null_space
      end function mat_set_near_null_space

      integer(c_int) function mat_destroy(matrix) bind(c, name='MatDestroy')
         import :: c_int, c_ptr
         type(c_ptr), intent(inout) :: matrix
      end function mat_destroy

      ! ---------------------------------------------------------------------------------------------------- solvers

      integer(c_int) function ksp_create(comm, solver) bind(c, name='KSPCreate')
         import :: c_int, c_ptr
         type(c_ptr), value       :: comm
         type(c_ptr), intent(out) :: solver
      end function ksp_create

      integer(c_int) function ksp_set_options_prefix(solver, prefix) bind(c, name='KSPSetOptionsPrefix')
         import :: c_char, c_int, c_ptr
         type(c_ptr), value                 :: solver
         character(kind=c_char), intent(in) :: prefix(*)
      end function ksp_set_options_prefix

      integer(c_int) function ksp_set_tolerances(solver, relative, absolute, divergence, most_steps) &
         bind(c, name='KSPSetTolerances')
         import :: c_double, c_int, c_ptr
         type(c_ptr), value    :: solver
         real(c_double), value :: relative, absolute, divergence
         integer(c_int), value :: most_steps
      end function ksp_set_tolerances

      integer(c_int) function ksp_get_tolerances(solver, relative, absolute, divergence, most_steps) &
         bind(c, name='KSPGetTolerances')
         import :: c_double, c_int, c_ptr
         type(c_ptr), value          :: solver
         real(c_double), intent(out) :: relative, absolute, divergence
         integer(c_int), intent(out) :: most_steps
      end function ksp_get_tolerances

      integer(c_int) function ksp_set_operators(solver, matrix, preconditioned) bind(c, name='KSPSetOperators')
         import :: c_int, c_ptr
         type(c_ptr), value :: solver, matrix, preconditioned
      end function ksp_set_operators

      integer(c_int) function ksp_set_reuse_preconditioner(solver, yes) bind(c, name='KSPSetReusePreconditioner')
         import :: c_int, c_ptr
         type(c_ptr), value    :: solver
         integer(c_int), value :: yes
      end function ksp_set_reuse_preconditioner

      integer(c_int) function ksp_set_from_options(solver) bind(c, name='KSPSetFromOptions')
         import :: c_int, c_ptr
         type(c_ptr), value :: solver
      end function ksp_set_from_options

      integer(c_int) function ksp_set_up(solver) bind(c, name='KSPSetUp')
         import :: c_int, c_ptr
         type(c_ptr), value :: solver
      end function ksp_set_up

      integer(c_int) function ksp_solve(solver, b, x) bind(c, name='KSPSolve')
         import :: c_int, c_ptr
         type(c_ptr), value :: solver, b, x
      end function ksp_solve

      integer(c_int) function ksp_get_iteration_number(solver, steps) bind(c, name='KSPGetIterationNumber')
         import :: c_int, c_ptr
         type(c_ptr), value          :: solver
         integer(c_int), intent(out) :: steps
      end function ksp_get_iteration_number

      integer(c_int) function ksp_get_converged_reason(solver, reason) bind(c, name='KSPGetConvergedReason')
         import :: c_int, c_ptr
         type(c_ptr), value          :: solver
         integer(c_int), intent(out) :: reason   !! positive: converged
      end function ksp_get_converged_reason

      integer(c_int) function ksp_get_pc(solver, preconditioner) bind(c, name='KSPGetPC')
         import :: c_int, c_ptr
         type(c_ptr), value       :: solver
         type(c_ptr), intent(out) :: preconditioner
      end function ksp_get_pc

      integer(c_int) function ksp_destroy(solver) bind(c, name='KSPDestroy')
         import :: c_int, c_ptr
         type(c_ptr), intent(inout) :: solver
      end function ksp_destroy

      integer(c_int) function pc_set_type(preconditioner, type) bind(c, name='PCSetType')
         import :: c_char, c_int, c_ptr
         type(c_ptr), value                 :: preconditioner
         character(kind=c_char), intent(in) :: type(*)
      end function pc_set_type

      !> Number of levels of a multigrid preconditioner after set-up.
      integer(c_int) function pc_mg_get_levels(preconditioner, levels) bind(c, name='PCMGGetLevels')
         import :: c_int, c_ptr
         type(c_ptr), value          :: preconditioner
         integer(c_int), intent(out) :: levels
      end function pc_mg_get_levels

      integer(c_int) function pc_mg_get_smoother(preconditioner, level, smoother) bind(c, name='PCMGGetSmoother')
         import :: c_int, c_ptr
         type(c_ptr), value       :: preconditioner
         integer(c_int), value    :: level         !! 0: the coarsest
         type(c_ptr), intent(out) :: smoother
      end function pc_mg_get_smoother

      !> Sets the matrix for the residual of a level; a null RESIDUAL selects the default routine.
      integer(c_int) function pc_mg_set_residual(preconditioner, level, residual, matrix) bind(c, name='PCMGSetResidual')
         import :: c_funptr, c_int, c_ptr
         type(c_ptr), value    :: preconditioner, matrix
         integer(c_int), value :: level
         type(c_funptr), value :: residual
      end function pc_mg_set_residual

      !> Reason for the failure of a set-up, 0: none.
      integer(c_int) function pc_get_failed_reason(preconditioner, reason) bind(c, name='PCGetFailedReason')
         import :: c_int, c_ptr
         type(c_ptr), value          :: preconditioner
         integer(c_int), intent(out) :: reason
      end function pc_get_failed_reason

      integer(c_int) function pc_factor_set_solver(preconditioner, name) bind(c, name='PCFactorSetMatSolverType')
         import :: c_char, c_int, c_ptr
         type(c_ptr), value                 :: preconditioner
         character(kind=c_char), intent(in) :: name(*)
      end function pc_factor_set_solver
   end interface

end module petsc_library
