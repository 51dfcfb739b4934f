!> Holds the stiffness of the structure as a PETSc matrix distributed over all processes, in blocks of the dimension.
!! All processes call every routine together. An argument of rank 0 matters on rank 0 alone.
module distributed_matrix
   use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_int, c_null_ptr, c_ptr
   use body_elements, only: coupled_stiffness
   use kinds, only: wp
   use model_data, only: corners_of
   use partition, only: subdomain_type
   use petsc_library
   use ranks, only: gather, give_up, largest_of_all, n_ranks, rank, scatter
   use unknowns, only: motions_at, n_motions
   implicit none
   private

   public :: start_matrix, reserve_touched, add_blocks, finish_matrix, keep_copy, drop_copy, read_touched, read_diagonal, &
             write_touched, multiply_by_matrix, free_matrix, put_vector, take_vector, check

   type, public :: distributed_matrix_type
      type(c_ptr) :: matrix = c_null_ptr      !! row by row, for the preconditioners
      type(c_ptr) :: products = c_null_ptr    !! the matrix for products: the upper blocks of MATRIX, or MATRIX itself
      logical :: has_copy = .false.           !! whether MATRIX and PRODUCTS are two matrices
      type(c_ptr) :: x = c_null_ptr, b = c_null_ptr, r = c_null_ptr !! vectors of the matrix
      real(wp) :: unit = 1.0_wp               !! diagonal of held components [force/length]
      integer, allocatable :: counts(:)       !! (ranks) rows of each rank
      integer, allocatable :: touched(:, :)   !! (2, own touched blocks) row and column, from 0
      integer, allocatable :: touched_counts(:) !! (ranks) entries of the touched blocks of each rank
   end type distributed_matrix_type

contains

   !> Create the matrix of the own elements without assembly. reserve_touched follows; then rank 0 may add_blocks.
   subroutine start_matrix(subdomain, counts, stiffness)
      type(subdomain_type), intent(in)               :: subdomain
      integer, intent(in)                        :: counts(:) !! (ranks) blocks of each rank
      type(distributed_matrix_type), intent(out) :: stiffness
      real(wp), allocatable :: k(:, :)
      integer  :: d, e, n

      d = subdomain%dimension
      stiffness%counts = d*counts
      call start_matrix_of_type('aij', subdomain, subdomain%inside, subdomain%outside, stiffness%matrix)
      call check(mat_set_option(stiffness%matrix, mat_spd, petsc_true))
      call check(mat_set_option(stiffness%matrix, mat_spd_eternal, petsc_true))
      do e = 1, subdomain%model%n_elements
         call coupled_stiffness(subdomain%model, e, k)
         associate (nodes => corners_of(subdomain%model, e))
            n = d*size(nodes)
            call add_blocks(subdomain%block(nodes), subdomain%held(:, nodes), k(:n, :n), stiffness)
         end associate
      end do
   end subroutine start_matrix

   !> Create a matrix of a PETSc type, with room in every own row of blocks for INSIDE own columns and OUTSIDE columns.
   subroutine start_matrix_of_type(type_name, subdomain, inside, outside, matrix)
      character(*), intent(in)     :: type_name
      type(subdomain_type), intent(in) :: subdomain
      integer, intent(in)          :: inside(:), outside(:)
      type(c_ptr), intent(inout)   :: matrix

      associate (d => subdomain%dimension, own => int(subdomain%dimension*subdomain%n_own, c_int), &
                 all => int(subdomain%dimension*subdomain%n_blocks, c_int))
         call check(mat_create(petsc_comm_world, matrix))
         call check(mat_set_sizes(matrix, own, own, all, all))
         call check(mat_set_type(matrix, type_name//char(0)))
         call check(mat_set_block_size(matrix, d))
         call check(mat_set_preallocation(matrix, d, inside, outside, inside, outside))
      end associate
   end subroutine start_matrix_of_type

   !> Reserve the touched blocks and the diagonal: the assembly would return entries that are empty.
   subroutine reserve_touched(subdomain, stiffness)
      type(subdomain_type), intent(in)              :: subdomain
      type(distributed_matrix_type), intent(in) :: stiffness
      real(wp) :: nothing(subdomain%dimension, subdomain%dimension)
      integer  :: i

      nothing = 0.0_wp
      do i = 1, size(stiffness%touched, 2)
         associate (touched => stiffness%touched(:, i))
            call check(mat_set_values_blocked(stiffness%matrix, 1, touched(1:1), 1, touched(2:2), nothing, add_values))
         end associate
      end do
      do i = subdomain%first, subdomain%first + subdomain%n_own - 1
         call check(mat_set_values_blocked(stiffness%matrix, 1, [i], 1, [i], nothing, add_values))
      end do
   end subroutine reserve_touched

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
      call check(mat_set_values_blocked(stiffness%matrix, size(blocks), blocks, size(blocks), blocks, values, add_values))
   end subroutine add_blocks

   !> Assemble the matrix. Held components get the identity times STIFFEST, the largest diagonal entry of all processes. Without an
   !! element STIFFEST is zero, and any number will do.
   subroutine finish_matrix(subdomain, stiffness, stiffest)
      type(subdomain_type), intent(in)                 :: subdomain
      type(distributed_matrix_type), intent(inout) :: stiffness
      real(wp), intent(out)                        :: stiffest !! [force/length]
      real(wp) :: block(subdomain%dimension, subdomain%dimension), own
      real(c_double), pointer :: diagonal(:)
      type(c_ptr) :: values
      integer :: b, c

      call assemble(stiffness%matrix)
      call check(mat_create_vecs(stiffness%matrix, stiffness%x, stiffness%b))
      call check(vec_duplicate(stiffness%b, stiffness%r))
      call check(mat_get_diagonal(stiffness%matrix, stiffness%r))
      call check(vec_get_array(stiffness%r, values))
      call c_f_pointer(values, diagonal, [stiffness%counts(rank + 1)])
      own = 0.0_wp
      if (size(diagonal) > 0) own = maxval(diagonal)
      call check(vec_restore_array(stiffness%r, values))
      stiffest = largest_of_all(own)
      stiffness%unit = merge(stiffest, 1.0_wp, stiffest > 0.0_wp)
      do b = 1, subdomain%n_own
         if (.not. any(subdomain%held_own(:, b))) cycle
         block = 0.0_wp
         do c = 1, subdomain%dimension
            if (subdomain%held_own(c, b)) block(c, c) = stiffness%unit
         end do
         call check(mat_set_values_blocked(stiffness%matrix, 1, [subdomain%first + b - 1], 1, &
                                           [subdomain%first + b - 1], block, add_values))
      end do
      call assemble(stiffness%matrix)
      call give_near_null_space(subdomain, stiffness)
      stiffness%products = stiffness%matrix
   end subroutine finish_matrix

   !> Keep the blocks on and above the diagonal beside the matrix from now on. They take half its memory and multiply a vector in a
   !! quarter of the time.
   subroutine keep_copy(subdomain, stiffness)
      type(subdomain_type), intent(in)                 :: subdomain
      type(distributed_matrix_type), intent(inout) :: stiffness
      integer(c_int), allocatable :: columns(:), own(:), others(:)
      real(wp), allocatable       :: values(:, :)
      integer :: b

      if (stiffness%has_copy) return
      stiffness%products = c_null_ptr
      allocate (own(subdomain%n_own), others(subdomain%n_own))
      do b = 1, subdomain%n_own
         call take_upper(subdomain, stiffness, b, columns)
         own(b) = count(columns < subdomain%first + subdomain%n_own)
         others(b) = size(columns) - own(b)
      end do
      call start_matrix_of_type('sbaij', subdomain, own, others, stiffness%products)
      call check(mat_set_option(stiffness%products, mat_ignore_lower, petsc_true))
      do b = 1, subdomain%n_own
         call take_upper(subdomain, stiffness, b, columns, values)
         call check(mat_set_values_blocked(stiffness%products, 1, [subdomain%first + b - 1], size(columns), columns, values, &
                                           insert_values))
      end do
      call assemble(stiffness%products)
      stiffness%has_copy = .true.
   end subroutine keep_copy

   !> Multiply by the matrix itself from now on.
   subroutine drop_copy(stiffness)
      type(distributed_matrix_type), intent(inout) :: stiffness

      if (stiffness%has_copy) call check(mat_destroy(stiffness%products))
      stiffness%products = stiffness%matrix
      stiffness%has_copy = .false.
   end subroutine drop_copy

   !> The blocks on and above the diagonal in the row of the own block B: the COLUMNS of blocks, and VALUES row after row.
   subroutine take_upper(subdomain, stiffness, b, columns, values)
      type(subdomain_type), intent(in)                          :: subdomain
      type(distributed_matrix_type), intent(in)             :: stiffness
      integer, intent(in)                                   :: b
      integer(c_int), allocatable, intent(inout)            :: columns(:)   !! from 0
      real(wp), allocatable, optional, intent(inout)        :: values(:, :) !! (dimension x columns, dimension) [force/length]
      integer(c_int), pointer :: all(:)
      real(c_double), pointer :: row(:)
      type(c_ptr) :: at_columns, at_values
      integer     :: c, first, n

      associate (d => subdomain%dimension, block => subdomain%first + b - 1)
         do c = 1, merge(d, 1, present(values))
            call check(mat_get_row(stiffness%matrix, d*block + c - 1, n, at_columns, at_values))
            call c_f_pointer(at_columns, all, [n])
            if (c == 1) then
               first = count(all < d*block)
               columns = all(first + 1::d)/d
               if (present(values)) then
                  if (allocated(values)) deallocate (values)
                  allocate (values(n - first, d))
               end if
            end if
            if (present(values)) then
               call c_f_pointer(at_values, row, [n])
               values(:, c) = row(first + 1:)
            end if
            call check(mat_restore_row(stiffness%matrix, d*block + c - 1, n, at_columns, at_values))
         end do
      end associate
   end subroutine take_upper

   subroutine assemble(matrix)
      type(c_ptr), intent(in) :: matrix

      call check(mat_assembly_begin(matrix, final_assembly))
      call check(mat_assembly_end(matrix, final_assembly))
   end subroutine assemble

   !> The rigid-body modes, which the coarse levels of the preconditioner have to represent.
   subroutine give_near_null_space(subdomain, stiffness)
      type(subdomain_type), intent(in)              :: subdomain
      type(distributed_matrix_type), intent(in) :: stiffness
      real(wp) :: modes(subdomain%dimension, subdomain%n_own, n_motions(subdomain%dimension)) ! [-], rotations [length]
      type(c_ptr) :: null_space, vectors(size(modes, 3))
      real(wp)    :: product
      integer     :: b, i, j

      do b = 1, subdomain%n_own
         modes(:, b, :) = motions_at(subdomain%x(:, b))
      end do
      modes(:, subdomain%odd, :) = reshape(subdomain%odd_motions, [size(modes, 1), size(subdomain%odd), size(modes, 3)], &
                                           order=[1, 3, 2])
      do i = 1, size(vectors)
         where (subdomain%held_own) modes(:, :, i) = 0.0_wp
         call check(vec_duplicate(stiffness%b, vectors(i)))
         call put_own(vectors(i), reshape(modes(:, :, i), [size(modes, 1)*size(modes, 2)]))
         do j = 1, i - 1
            call check(vec_dot(vectors(i), vectors(j), product))
            call check(vec_axpy(vectors(i), -product, vectors(j)))
         end do
         call check(vec_norm(vectors(i), norm_2, product))
         if (product > 0.0_wp) call check(vec_scale(vectors(i), 1.0_wp/product))
      end do
      call check(mat_null_space_create(petsc_comm_world, petsc_false, size(vectors), vectors, null_space))
      call check(mat_set_near_null_space(stiffness%matrix, null_space))
      call check(mat_null_space_destroy(null_space))
      do i = 1, size(vectors)
         call check(vec_destroy(vectors(i)))
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
            call check(mat_get_values(stiffness%matrix, d, [(d*touched(1) + c, c = 0, d - 1)], &
                                      d, [(d*touched(2) + c, c = 0, d - 1)], rows))
            own(:, :, i) = transpose(rows)
         end associate
      end do
      call gather(reshape(own, [size(own)]), stiffness%touched_counts, blocks)
   end subroutine read_touched

   !> Give rank 0 the diagonal VALUES, row after row.
   subroutine read_diagonal(stiffness, values)
      type(distributed_matrix_type), intent(in) :: stiffness
      real(wp), intent(inout)                   :: values(:) !! [force/length]

      call check(mat_get_diagonal(stiffness%matrix, stiffness%r))
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
         type(c_ptr), intent(in) :: matrix
         integer :: i

         do i = 1, size(stiffness%touched, 2)
            associate (touched => stiffness%touched(:, i), block => reshape(own(d*d*(i - 1) + 1:d*d*i), [d, d]))
               call check(mat_set_values_blocked(matrix, 1, touched(1:1), 1, touched(2:2), transpose(block), insert_values))
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
      call check(mat_mult(stiffness%products, stiffness%r, stiffness%b))
      call take_vector(stiffness%b, stiffness, x)
   end subroutine multiply_by_matrix

   !> Scatter VALUES of rank 0 into VECTOR.
   subroutine put_vector(values, stiffness, vector)
      real(wp), intent(in)                      :: values(:)
      type(distributed_matrix_type), intent(in) :: stiffness
      type(c_ptr), intent(in)                   :: vector
      real(wp) :: own(stiffness%counts(rank + 1))

      call scatter(values, stiffness%counts, own)
      call put_own(vector, own)
   end subroutine put_vector

   subroutine put_own(vector, own)
      type(c_ptr), intent(in) :: vector
      real(wp), intent(in)    :: own(:)
      real(c_double), pointer :: array(:)
      type(c_ptr) :: values

      call check(vec_get_array(vector, values))
      call c_f_pointer(values, array, [size(own)])
      array = own
      call check(vec_restore_array(vector, values))
   end subroutine put_own

   !> Gather VALUES on rank 0 from VECTOR.
   subroutine take_vector(vector, stiffness, values)
      type(c_ptr), intent(in)                   :: vector
      type(distributed_matrix_type), intent(in) :: stiffness
      real(wp), intent(inout)                   :: values(:)
      real(c_double), pointer :: array(:)
      type(c_ptr) :: own

      call check(vec_get_array(vector, own))
      call c_f_pointer(own, array, [stiffness%counts(rank + 1)])
      call gather(array, stiffness%counts, values)
      call check(vec_restore_array(vector, own))
   end subroutine take_vector

   subroutine free_matrix(stiffness)
      type(distributed_matrix_type), intent(inout) :: stiffness

      call drop_copy(stiffness)
      call check(mat_destroy(stiffness%matrix))
      call check(vec_destroy(stiffness%x))
      call check(vec_destroy(stiffness%b))
      call check(vec_destroy(stiffness%r))
   end subroutine free_matrix

   !> End the program where PETSc has failed: a failure on one process ends all processes.
   subroutine check(code)
      integer(c_int), intent(in) :: code
      character(12) :: digits

      if (code == 0) return
      write (digits, '(i0)') code
      if (code == out_of_memory) then
         call give_up('no memory for the stiffness of the structure; more processes on more machines have more')
      else
         call give_up('PETSc gives the error code '//trim(digits))
      end if
   end subroutine check

end module distributed_matrix
