!> Writes files for vtu_read.py, which has the formulas below too.
!!
!!    vtu_sample FOLDER        sample.pvd and the files that it lists: cells of every type, points alone, nothing
!!    vtu_sample FOLDER N      big.vtu with N points and N cells; prints its size and time
!!
!! Exit status 1 if a file cannot be written.
program vtu_sample
   use, intrinsic :: iso_fortran_env, only: int32, int64, int8, real64
   use vtu_file, only: cell_data, point_data, vtk_vertex, vtu_file_type, write_collection
   implicit none
   integer(int8), parameter :: vtk_line = 3_int8, vtk_triangle = 5_int8, vtk_quad = 9_int8, vtk_tetra = 10_int8, &
                               vtk_hexahedron = 12_int8, vtk_wedge = 13_int8
   character(1024) :: folder, number
   integer :: n
   logical :: ok, all_ok

   call get_command_argument(1, folder)
   if (command_argument_count() > 1) then
      call get_command_argument(2, number)
      read (number, *) n
      call write_big(trim(folder)//'/big.vtu', n, all_ok)
   else
      call write_solid(trim(folder)//'/sample.1.vtu', 1, all_ok)
      call write_joint(trim(folder)//'/sample.1.joint.vtu', ok)
      all_ok = all_ok .and. ok
      call write_solid(trim(folder)//'/sample.2 & <3>.vtu', 2, ok)
      all_ok = all_ok .and. ok
      call write_nothing(trim(folder)//'/sample.2.joint.vtu', ok)
      all_ok = all_ok .and. ok
      call write_list(trim(folder)//'/sample.pvd', ok)
      all_ok = all_ok .and. ok
   end if
   if (.not. all_ok) error stop 1, quiet=.true.

contains

   !> Twelve points, a cell of every type, values of every form, all times STAGE.
   subroutine write_solid(path, stage, ok)
      character(*), intent(in) :: path
      integer, intent(in)      :: stage
      logical, intent(out)     :: ok
      integer, parameter :: n = 12, m = 7, length(m) = [8, 6, 4, 4, 3, 2, 1]
      integer(int8), parameter :: types(m) = [vtk_hexahedron, vtk_wedge, vtk_tetra, vtk_quad, vtk_triangle, vtk_line, &
                                              vtk_vertex]
      type(vtu_file_type) :: file
      integer :: c, i, j

      call file%start(path)
      call file%points(reshape([((real(i*j - 5, real64)/7, j=1, 3), i=1, n)], [3, n]))
      call file%cells([((mod(3*c + 5*j, n) + 1, j=1, length(c)), c=1, m)], [(sum(length(:c)), c=1, m)], types)
      call file%add(point_data, 'displacement', stage*reshape([((real(i - 2*j, real64)/3, j=1, 3), i=1, n)], [3, n]))
      call file%add(point_data, 'stress', stage*reshape([((real(i*j, real64)/11, j=1, 6), i=1, n)], [6, n]))
      call file%add(point_data, 'lambda & <p>', stage*[(1/real(i, real64), i=1, n)])
      call file%add(point_data, 'node', stage*[(100*i, i=1, n)])
      call file%add(point_data, 'triple', stage*reshape([((i - j, j=1, 3), i=1, n)], [3, n]))
      call file%add(cell_data, 'energy', stage*[(real(c, real64)/13, c=1, m)])
      call file%add(cell_data, 'flow', stage*reshape([((real(j - c, real64)/17, j=1, 3), c=1, m)], [3, m]))
      call file%add(cell_data, 'strain', stage*reshape([((real(c*j, real64)/19, j=1, 6), c=1, m)], [6, m]))
      call file%add(cell_data, 'property', stage*[(7*c, c=1, m)])
      call file%add(cell_data, 'pair', stage*reshape([((c*j, j=1, 2), c=1, m)], [2, m]))
      call file%finish(ok)
   end subroutine write_solid

   !> Five points alone.
   subroutine write_joint(path, ok)
      character(*), intent(in) :: path
      logical, intent(out)     :: ok
      type(vtu_file_type) :: file
      integer :: i

      call file%start(path)
      call file%points(reshape([(real(i, real64)/3, i=1, 15)], [3, 5]))
      call file%cells([1, 2, 3, 4, 5], [1, 2, 3, 4, 5], [(vtk_vertex, i=1, 5)])
      call file%add(cell_data, 'branch', [1, 2, 3, 4, 1])
      call file%finish(ok)
   end subroutine write_joint

   subroutine write_nothing(path, ok)
      character(*), intent(in) :: path
      logical, intent(out)     :: ok
      type(vtu_file_type) :: file

      call file%start(path)
      call file%points(reshape([real(real64) ::], [3, 0]))
      call file%cells([integer(int32) ::], [integer(int32) ::], [integer(int8) ::])
      call file%add(cell_data, 'branch', [integer(int32) ::])
      call file%finish(ok)
   end subroutine write_nothing

   subroutine write_list(path, ok)
      character(*), intent(in) :: path
      logical, intent(out)     :: ok

      call write_collection(path, [1.0_real64, 1.0_real64, 3.0_real64, 3.0_real64], [0, 1, 0, 1], [character(20) :: &
                            'sample.1.vtu', 'sample.1.joint.vtu', 'sample.2 & <3>.vtu', 'sample.2.joint.vtu'], ok)
   end subroutine write_list

   !> N points in a row, N cells of eight of them.
   subroutine write_big(path, n, ok)
      character(*), intent(in) :: path
      integer, intent(in)      :: n
      logical, intent(out)     :: ok
      type(vtu_file_type) :: file
      real(real64), allocatable   :: vectors(:, :), tensors(:, :)
      integer(int32), allocatable :: nodes(:), ends(:)
      integer(int8), allocatable  :: types(:)
      integer(int64) :: n_bytes, first, last, rate
      integer :: i

      allocate (vectors(3, n), tensors(6, n), nodes(8*n), ends(n), types(n))
      vectors = 1.5_real64
      tensors = -2.5_real64
      nodes = [(mod(i, n) + 1, i=1, 8*n)]
      ends = [(8*i, i=1, n)]
      types = vtk_hexahedron
      call system_clock(first, rate)
      call file%start(path)
      call file%points(vectors)
      call file%cells(nodes, ends, types)
      call file%add(point_data, 'displacement', vectors)
      call file%add(point_data, 'stress', tensors)
      call file%add(cell_data, 'stress', tensors)
      call file%add(cell_data, 'property', ends)
      call file%finish(ok)
      call system_clock(last)
      if (.not. ok) return
      inquire (file=path, size=n_bytes)
      print '(i0,a,f0.1,a,f0.3,a)', n, ' points, ', real(n_bytes, real64)/1e6_real64, ' MB in ', &
         real(last - first, real64)/real(rate, real64), ' s'
   end subroutine write_big

end program vtu_sample
