!> Holds the stiffness of the structure as a PETSc matrix distributed over all processes, in blocks of the dimension.
!! All processes call every routine together. An argument of rank 0 matters on rank 0 alone. An error in PETSc ends the run, see
!! end_at_error; the codes that its routines return need no check.
module distributed_matrix
   use body_elements, only: coupled_stiffness
   use kinds, only: wp
   use mesh_queries, only: element_points
   use partition, only: subdomain_type
   use petscmat
   use ranks, only: gather, give_up, n_ranks, rank, scatter
   implicit none
   private

   public :: start_matrix, add_blocks, finish_matrix, drop_copy, read_touched, read_diagonal, write_touched, multiply_by_matrix, &
             free_matrix, put_vector, take_vector, end_at_error

   type, public :: distributed_matrix_type
      type(tMat) :: matrix                    !! row by row, for the preconditioners
      type(tMat) :: products                  !! the matrix for products: the upper blocks of MATRIX, or MATRIX itself
      logical :: has_copy = .false.           !! whether MATRIX and PRODUCTS are two matrices
      type(tVec) :: x, b, r                   !! vectors of the matrix
      real(wp) :: unit = 1.0_wp               !! diagonal of held components [force/length]
      integer, allocatable :: counts(:)       !! (ranks) rows of each rank
      integer, allocatable :: touched(:, :)   !! (2, own touched blocks) row and column, from 0
      integer, allocatable :: touched_counts(:) !! (ranks) entries of the touched blocks of each rank
   end type distributed_matrix_type

   integer :: code ! of PETSc

contains

   !> Create the matrix of the own elements without assembly; rank 0 may add_blocks to it. WORDS: the number of blocks of each rank,
   !! the number of touched blocks of each rank, then rows and columns of all touched blocks.
   subroutine start_matrix(words, subdomain, stiffness)
      integer, intent(in)                        :: words(:)
      type(subdomain_type), intent(in)           :: subdomain
      type(distributed_matrix_type), intent(out) :: stiffness
      real(wp), allocatable :: k(:, :)
      real(wp) :: nothing(subdomain%dimension**2)
      integer  :: d, e, first, i, n

      d = subdomain%dimension
      stiffness%counts = d*words(:n_ranks)
      associate (matrix => stiffness%matrix, own => d*subdomain%n_own, all => d*subdomain%n_blocks)
         call MatCreate(PETSC_COMM_WORLD, matrix, code)
         call MatSetSizes(matrix, own, own, all, all, code)
         call MatSetType(matrix, 'aij', code)
         call MatSetBlockSize(matrix, d, code)
         ! the last two are for symmetric storage; "none of them" is a scalar in PETSc 3.22 and an array before
         call MatXAIJSetPreallocation(matrix, d, subdomain%inside, subdomain%outside, subdomain%inside, subdomain%outside, code)
      end associate
      call MatSetOption(stiffness%matrix, MAT_SPD, PETSC_TRUE, code)
      call MatSetOption(stiffness%matrix, MAT_SPD_ETERNAL, PETSC_TRUE, code)
      do e = 1, subdomain%model%mesh%n_elements
         call coupled_stiffness(subdomain%model, e, k)
         associate (nodes => element_points(subdomain%model%mesh, e))
            n = d*size(nodes)
            call add_blocks(subdomain%block(nodes), subdomain%held(:, nodes), k(:n, :n), stiffness)
         end associate
      end do

      ! reserve the touched blocks of the own rows and the diagonal: the assembly would return entries that are empty
      nothing = 0.0_wp
      associate (touched => words(n_ranks + 1:2*n_ranks))
         stiffness%touched_counts = d**2*touched
         first = 2*n_ranks + sum(touched(:rank))
         allocate (stiffness%touched(2, touched(rank + 1)))
         stiffness%touched(1, :) = words(first + 1:first + touched(rank + 1))
         stiffness%touched(2, :) = words(first + sum(touched) + 1:first + sum(touched) + touched(rank + 1))
      end associate
      do i = 1, size(stiffness%touched, 2)
         associate (row => stiffness%touched(1:1, i), column => stiffness%touched(2:2, i))
            call MatSetValuesBlocked(stiffness%matrix, 1, row, 1, column, nothing, ADD_VALUES, code)
         end associate
      end do
      do i = subdomain%first, subdomain%first + subdomain%n_own - 1
         call MatSetValuesBlocked(stiffness%matrix, 1, [i], 1, [i], nothing, ADD_VALUES, code)
      end do
   end subroutine start_matrix

   !> Add the symmetric matrix K between BLOCKS, without the HELD rows and columns.
   subroutine add_blocks(blocks, held, k, stiffness)
      integer, intent(in)  :: blocks(:)  !! from 0
      logical, intent(in)  :: held(:, :) !! (dimension, blocks)
      real(wp), intent(in) :: k(:, :)    !! (dimension x blocks, likewise) [force/length]
      type(distributed_matrix_type), intent(in) :: stiffness
      real(wp) :: values(size(k, 1), size(k, 2))
      logical  :: out(size(k, 1))
      integer  :: i

      values = k
      out = reshape(held, [size(k, 1)])
      do i = 1, size(out)
         if (.not. out(i)) cycle
         values(i, :) = 0.0_wp
         values(:, i) = 0.0_wp
      end do
      call MatSetValuesBlocked(stiffness%matrix, size(blocks), blocks, size(blocks), blocks, &
                               reshape(values, [size(values)]), ADD_VALUES, code)
   end subroutine add_blocks

   !> Assemble the matrix. Held components get the identity times STIFFEST, the largest diagonal entry of all processes. Without an
   !! element STIFFEST is zero, and any number will do.
   subroutine finish_matrix(subdomain, stiffness, stiffest)
      type(subdomain_type), intent(in)             :: subdomain
      type(distributed_matrix_type), intent(inout) :: stiffness
      real(wp), intent(out)                        :: stiffest !! [force/length]
      real(wp) :: block(subdomain%dimension, subdomain%dimension)
      integer  :: b, c, row(1)

      call assemble(stiffness%matrix)
      call MatCreateVecs(stiffness%matrix, stiffness%x, stiffness%b, code)
      call VecDuplicate(stiffness%b, stiffness%r, code)
      call MatGetDiagonal(stiffness%matrix, stiffness%r, code)
      call VecMax(stiffness%r, PETSC_NULL_INTEGER, stiffest, code)
      stiffness%unit = merge(stiffest, 1.0_wp, stiffest > 0.0_wp)
      do b = 1, subdomain%n_own
         if (.not. any(subdomain%held_own(:, b))) cycle
         block = 0.0_wp
         do c = 1, subdomain%dimension
            if (subdomain%held_own(c, b)) block(c, c) = stiffness%unit
         end do
         row = subdomain%first + b - 1
         call MatSetValuesBlocked(stiffness%matrix, 1, row, 1, row, reshape(block, [size(block)]), ADD_VALUES, code)
      end do
      call assemble(stiffness%matrix)
      call give_near_null_space(subdomain, stiffness)
      stiffness%products = stiffness%matrix
   end subroutine finish_matrix

   !> Multiply by the matrix itself from now on.
   subroutine drop_copy(stiffness)
      type(distributed_matrix_type), intent(inout) :: stiffness

      if (stiffness%has_copy) call MatDestroy(stiffness%products, code)
      stiffness%products = stiffness%matrix
      stiffness%has_copy = .false.
   end subroutine drop_copy

   subroutine assemble(matrix)
      type(tMat), intent(in) :: matrix

      call MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY, code)
      call MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY, code)
   end subroutine assemble

   !> The rigid-body modes, which the coarse levels of the preconditioner have to represent.
   subroutine give_near_null_space(subdomain, stiffness)
      type(subdomain_type), intent(in)          :: subdomain
      type(distributed_matrix_type), intent(in) :: stiffness
      type(tMatNullSpace) :: null_space
      type(tVec)  :: vectors(size(subdomain%motions, 2))
      real(wp)    :: product
      integer     :: i, j

      do i = 1, size(vectors)
         call VecDuplicate(stiffness%b, vectors(i), code)
         call put_own(vectors(i), pack(merge(0.0_wp, subdomain%motions(:, i, :), subdomain%held_own), .true.))
         do j = 1, i - 1
            call VecDot(vectors(i), vectors(j), product, code)
            call VecAXPY(vectors(i), -product, vectors(j), code)
         end do
         call VecNorm(vectors(i), NORM_2, product, code)
         if (product > 0.0_wp) call VecScale(vectors(i), 1.0_wp/product, code)
      end do
      call MatNullSpaceCreate(PETSC_COMM_WORLD, PETSC_FALSE, size(vectors), vectors, null_space, code)
      call MatSetNearNullSpace(stiffness%matrix, null_space, code)
      call MatNullSpaceDestroy(null_space, code)
      do i = 1, size(vectors)
         call VecDestroy(vectors(i), code)
      end do
   end subroutine give_near_null_space

   !> Give rank 0 the values of the touched BLOCKS.
   subroutine read_touched(d, stiffness, blocks)
      integer, intent(in)                       :: d !! dimension
      type(distributed_matrix_type), intent(in) :: stiffness
      real(wp), intent(inout)                   :: blocks(:) !! (d, d, touched blocks of all) [force/length]
      real(wp) :: own(d, d, size(stiffness%touched, 2)), rows(d, d)
      integer  :: c, i

      do i = 1, size(own, 3)
         associate (touched => stiffness%touched(:, i))
            call MatGetValues(stiffness%matrix, d, [(d*touched(1) + c, c = 0, d - 1)], &
                              d, [(d*touched(2) + c, c = 0, d - 1)], rows, code)
            own(:, :, i) = transpose(rows)
         end associate
      end do
      call gather(reshape(own, [size(own)]), stiffness%touched_counts, blocks)
   end subroutine read_touched

   !> Give rank 0 the diagonal VALUES, row after row.
   subroutine read_diagonal(stiffness, values)
      type(distributed_matrix_type), intent(in) :: stiffness
      real(wp), intent(inout)                   :: values(:) !! [force/length]

      call MatGetDiagonal(stiffness%matrix, stiffness%r, code)
      call take_vector(stiffness%r, stiffness, values)
   end subroutine read_diagonal

   !> Write the BLOCKS of rank 0 into the touched blocks.
   subroutine write_touched(d, blocks, stiffness)
      integer, intent(in)                       :: d         !! dimension
      real(wp), intent(in)                      :: blocks(:) !! (d, d, touched blocks of all) [force/length]
      type(distributed_matrix_type), intent(in) :: stiffness
      real(wp) :: own(d*d*size(stiffness%touched, 2))

      call scatter(blocks, stiffness%touched_counts, own)
      call insert(stiffness%matrix)
      if (stiffness%has_copy) call insert(stiffness%products)

   contains

      subroutine insert(matrix)
         type(tMat), intent(in) :: matrix
         integer :: i

         do i = 1, size(stiffness%touched, 2)
            associate (touched => stiffness%touched(:, i), block => reshape(own(d*d*(i - 1) + 1:d*d*i), [d, d]))
               call MatSetValuesBlocked(matrix, 1, touched(1:1), 1, touched(2:2), &
                                        reshape(transpose(block), [d*d]), INSERT_VALUES, code)
            end associate
         end do
         call assemble(matrix)
      end subroutine insert

   end subroutine write_touched

   !> Replace X of rank 0, row after row, by the product of the matrix and X.
   subroutine multiply_by_matrix(stiffness, x)
      type(distributed_matrix_type), intent(in) :: stiffness
      real(wp), intent(inout)                   :: x(:)

      call put_vector(x, stiffness, stiffness%r)
      call MatMult(stiffness%products, stiffness%r, stiffness%b, code)
      call take_vector(stiffness%b, stiffness, x)
   end subroutine multiply_by_matrix

   !> Scatter VALUES of rank 0 into VECTOR.
   subroutine put_vector(values, stiffness, vector)
      real(wp), intent(in)                      :: values(:)
      type(distributed_matrix_type), intent(in) :: stiffness
      type(tVec), intent(in)                    :: vector
      real(wp) :: own(stiffness%counts(rank + 1))

      call scatter(values, stiffness%counts, own)
      call put_own(vector, own)
   end subroutine put_vector

   subroutine put_own(vector, own)
      type(tVec), intent(in) :: vector
      real(wp), intent(in)   :: own(:)
      real(wp), pointer :: values(:)

      call VecGetArrayF90(vector, values, code)
      values = own
      call VecRestoreArrayF90(vector, values, code)
   end subroutine put_own

   !> Gather VALUES on rank 0 from VECTOR.
   subroutine take_vector(vector, stiffness, values)
      type(tVec), intent(in)                    :: vector
      type(distributed_matrix_type), intent(in) :: stiffness
      real(wp), intent(inout)                   :: values(:)
      real(wp), pointer :: own(:)

      call VecGetArrayF90(vector, own, code)
      call gather(own, stiffness%counts, values)
      call VecRestoreArrayF90(vector, own, code)
   end subroutine take_vector

   subroutine free_matrix(stiffness)
      type(distributed_matrix_type), intent(inout) :: stiffness

      call drop_copy(stiffness)
      call MatDestroy(stiffness%matrix, code)
      call VecDestroy(stiffness%x, code)
      call VecDestroy(stiffness%b, code)
      call VecDestroy(stiffness%r, code)
   end subroutine free_matrix

   !> PETSc calls this routine at its first error: an error on one process ends all processes. Its manual page of
   !! PetscPushErrorHandler prescribes the arguments.
   subroutine end_at_error(comm, line, routine, file, error, kind, message, context, status)
      integer, intent(in)      :: comm, line, error, kind, context
      character(*), intent(in) :: routine, file, message
      integer, intent(out)     :: status
      character(200) :: words

      status = error
      if (error == PETSC_ERR_MEM) then
         call give_up('no memory for the stiffness of the structure; more processes on more machines have more')
      else
         write (words, '(a, i0, 3a, i0, 4a, 3(a, i0))') 'PETSc gives the error code ', error, ' in ', routine, ', line ', line, &
            ' of ', file, ': ', message, '; kind ', kind, ', context ', context, ', communicator ', comm
         call give_up(trim(words))
      end if
   end subroutine end_at_error

end module distributed_matrix
