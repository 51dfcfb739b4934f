!> Figures that Linux gives in small files of text, /proc and /sys, and what its control groups leave to this program: the limits
!! of containers, batch systems and systemd.
!! Source: Linux, Documentation/admin-guide/cgroup-v2.rst and cgroup-v1/memory.rst; man 7 cgroups for /proc/self/cgroup.
module kernel_figures
   use kinds, only: long
   implicit none
   private

   public :: kernel_figure, memory_left_by_groups

   integer(long), parameter, public :: no_figure = huge(1_long) !! it cannot be read, or is a word such as `max`

   !> One version of the control groups: where its groups are, and the names of their files.
   type :: hierarchy_type
      character(:), allocatable :: folder, limit, used, reclaimable
   end type hierarchy_type

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

   !> The least that any control group of this program leaves of its limit, from its own up to the root [bytes]; huge where none
   !! has one. ROOT: what stands before /proc and /sys, empty but for tests.
   function memory_left_by_groups(root) result(bytes)
      character(*), intent(in) :: root
      integer(long)   :: bytes
      character(4096) :: line
      integer :: unit, status

      bytes = no_figure
      open (newunit=unit, file=root//'/proc/self/cgroup', action='read', status='old', iostat=status)
      if (status /= 0) return
      do
         read (unit, '(a)', iostat=status) line
         if (status /= 0) exit
         bytes = min(bytes, left_by_line(root, trim(line)))
      end do
      close (unit)
   end function memory_left_by_groups

   !> What the group of one LINE leaves, or a group above it. The line is `number:controllers:path`: version 2 has the number 0
   !! and no controllers, version 1 names them.
   function left_by_line(root, line) result(bytes)
      character(*), intent(in) :: root, line
      integer(long) :: bytes
      type(hierarchy_type) :: hierarchy
      character(:), allocatable :: path
      integer :: first, second

      bytes = no_figure
      first = index(line, ':')
      second = first + index(line(first + 1:), ':')
      if (first == 0 .or. second == first) return
      associate (controllers => line(first + 1:second - 1))
         if (controllers == '') then
            hierarchy%folder = root//'/sys/fs/cgroup'
            hierarchy%limit = '/memory.max'
            hierarchy%used = '/memory.current'
            hierarchy%reclaimable = 'inactive_file '
         else if (index(','//controllers//',', ',memory,') > 0) then
            hierarchy%folder = root//'/sys/fs/cgroup/memory'
            hierarchy%limit = '/memory.limit_in_bytes'
            hierarchy%used = '/memory.usage_in_bytes'
            hierarchy%reclaimable = 'total_inactive_file '
         else
            return
         end if
      end associate
      path = line(second + 1:)
      do ! in a container the groups above it, or its own path as the host sees it, may not be there: they say nothing
         bytes = min(bytes, left_in_group(hierarchy, path))
         if (path == '') exit
         path = path(:index(path, '/', back=.true.) - 1)
      end do
   end function left_by_line

   !> What one group leaves: its limit less what its members have; pages of files that nobody uses any more are given back when
   !! memory is asked for.
   function left_in_group(hierarchy, path) result(bytes)
      type(hierarchy_type), intent(in) :: hierarchy
      character(*), intent(in)         :: path
      integer(long) :: bytes, used, reclaimable

      bytes = kernel_figure(hierarchy%folder//path//hierarchy%limit, '', 1)
      used = kernel_figure(hierarchy%folder//path//hierarchy%used, '', 1)
      if (bytes == no_figure .or. used == no_figure) then
         bytes = no_figure
         return
      end if
      reclaimable = kernel_figure(hierarchy%folder//path//'/memory.stat', hierarchy%reclaimable, 1)
      if (reclaimable == no_figure) reclaimable = 0
      bytes = max(0_long, bytes - max(0_long, used - reclaimable))
   end function left_in_group

end module kernel_figures
