!> NAME.pvd, the file that ParaView opens: which .vtu files belong together, and at what time. Several parts may stand
!! at one time, bodies and joint of a stage for example:
!!
!!    call file%start('beam.pvd')
!!    call file%add(1.0_real64, 0, 'beam.1.vtu')
!!    call file%add(1.0_real64, 1, 'beam.1.joint.vtu')
!!    call file%finish(ok)
module pvd_file
   use, intrinsic :: iso_fortran_env, only: int64, real64
   use c_library, only: remove_file
   use output_file, only: output_file_type
   use text_tools, only: integer_text
   use vtu_header, only: xml_text
   implicit none
   private

   type, public :: pvd_file_type
      private
      type(output_file_type) :: file
      character(:), allocatable :: path
      integer(int64) :: n_bytes = 0        ! put so far
      logical        :: cut_off = .false. ! the file has another size
   contains
      procedure, private :: put
      procedure :: start
      procedure :: add
      procedure :: failed
      procedure :: finish
      procedure :: discard
   end type pvd_file_type

contains

   !> Open the file that will be PATH. A file that is still open is given up first.
   subroutine start(self, path)
      class(pvd_file_type), intent(inout) :: self
      character(*), intent(in)            :: path

      call self%file%discard()
      self%path = path
      self%n_bytes = 0
      self%cut_off = .false.
      call self%file%start(path)
      call self%put('<?xml version="1.0"?>')
      call self%put('<VTKFile type="Collection" version="1.0">')
      call self%put('  <Collection>')
   end subroutine start


   !> One file of the collection.
   subroutine add(self, time, part, name)
      class(pvd_file_type), intent(inout) :: self
      real(real64), intent(in)            :: time !! the number of the stage, for example
      integer, intent(in)                 :: part !! 0, 1, ... within one time
      character(*), intent(in)            :: name !! the .vtu file, as seen from the folder of the .pvd

      call self%put('    <DataSet timestep="'//time_text(time)//'" group="" part="'//integer_text(part)//'"')
      call self%put('             file="'//xml_text(name)//'"/>') ! a line of its own: names may be long
   end subroutine add


   !> Whether anything could not be written.
   pure logical function failed(self)
      class(pvd_file_type), intent(in) :: self

      failed = self%cut_off .or. self%file%failed()
   end function failed


   !> Close the file and give it its name. OK is false, and no file is left by us, where that failed.
   subroutine finish(self, ok)
      class(pvd_file_type), intent(inout) :: self
      logical, intent(out)                :: ok
      integer(int64) :: n_written

      call self%put('  </Collection>')
      call self%put('</VTKFile>')
      call self%file%finish(ok)
      if (.not. ok) return
      inquire (file=self%path, size=n_written) ! that the disk is full may show in nothing but the size
      self%cut_off = n_written /= self%n_bytes
      ok = .not. self%cut_off
      if (.not. ok) call remove_file(self%path)
   end subroutine finish


   !> Leave nothing behind.
   subroutine discard(self)
      class(pvd_file_type), intent(inout) :: self

      call self%file%discard()
   end subroutine discard


   !> Write one line.
   subroutine put(self, line)
      class(pvd_file_type), intent(inout) :: self
      character(*), intent(in)            :: line

      call self%file%put(line)
      self%n_bytes = self%n_bytes + len_trim(line) + len(new_line('a'))
   end subroutine put


   !> A time: a whole number as such, any other with all its digits.
   pure function time_text(time) result(text)
      real(real64), intent(in)  :: time
      character(:), allocatable :: text
      character(24) :: buffer

      if (abs(time) < 1.0e9_real64) then
         if (abs(time - anint(time)) <= 0.0_real64) then
            text = integer_text(nint(time))
            return
         end if
      end if
      write (buffer, '(es24.16e3)') time
      text = trim(adjustl(buffer))
   end function time_text

end module pvd_file
