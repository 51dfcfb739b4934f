!> What the machine has.
module machine
   use kinds, only: long
   implicit none
   private

   public :: available_memory

contains

   !> Memory that a program can still take [bytes], from /proc/meminfo; huge where that cannot be read.
   function available_memory() result(bytes)
      integer(long) :: bytes
      character(80) :: line
      integer :: unit, status

      bytes = huge(bytes)
      open (newunit=unit, file='/proc/meminfo', action='read', status='old', iostat=status)
      if (status /= 0) return
      do
         read (unit, '(a)', iostat=status) line
         if (status /= 0) exit
         if (index(line, 'MemAvailable:') == 1) then
            read (line(14:), *, iostat=status) bytes
            if (status == 0) bytes = 1024*bytes
            exit
         end if
      end do
      close (unit)
   end function available_memory

end module machine
