!> Figures that the kernel gives in small files of text, a line each: /proc, /sys.
module kernel_figures
   use kinds, only: long
   implicit none
   private

   public :: kernel_figure

   integer(long), parameter, public :: no_figure = huge(1_long) !! it cannot be read, or is a word such as `max`

contains

   !> The figure that stands behind NAME (empty: alone in the first line) in the file PATH, there in units of so many bytes
   !! [bytes]; huge where there is none.
   function kernel_figure(path, name, unit_bytes) result(bytes)
      character(*), intent(in) :: path, name
      integer, intent(in)      :: unit_bytes
      integer(long) :: bytes
      character(80) :: line
      integer :: unit, status

      bytes = no_figure
      open (newunit=unit, file=path, action='read', status='old', iostat=status)
      if (status /= 0) return
      do
         read (unit, '(a)', iostat=status) line
         if (status /= 0) exit
         if (index(line, name) == 1) then
            read (line(len(name) + 1:), *, iostat=status) bytes
            bytes = merge(unit_bytes*bytes, no_figure, status == 0)
            exit
         end if
      end do
      close (unit)
   end function kernel_figure

end module kernel_figures
