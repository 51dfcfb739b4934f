!> The lines of a deck that bring in another file: INCLUDE 'mesh.bdf'.
module include_lines
   use text_tools, only: upper
   implicit none
   private

   public :: is_include, included_path, folder

   integer, parameter :: longest_include = 10000 ! characters; no path is longer

contains

   !> Whether LINE (its card part) is an INCLUDE: the word, then a blank, a quote or an equals sign.
   pure logical function is_include(line)
      character(*), intent(in) :: line
      integer :: first

      is_include = .false.
      first = verify(line, ' ')
      if (first == 0 .or. len(line) > longest_include) return
      if (len(line) < first + 6) return
      if (line(first:first) /= 'I' .and. line(first:first) /= 'i') return ! most lines
      if (upper(line(first:first + 6)) /= 'INCLUDE') return
      is_include = .true.
      if (len(line) > first + 6) is_include = scan(line(first + 7:first + 7), ' ''"=') == 1
   end function is_include


   !> The file name in what follows the word INCLUDE: in quotes of either kind, or bare.
   pure function included_path(words) result(path)
      character(*), intent(in)  :: words
      character(:), allocatable :: path
      integer :: closing

      path = trim(adjustl(words))
      if (path == '') return
      if (path(1:1) == '=') path = trim(adjustl(path(2:)))
      if (path == '') return
      if (path(1:1) == '''' .or. path(1:1) == '"') then
         closing = index(path(2:), path(1:1))
         if (closing == 0) then
            path = ''
         else if (len_trim(path) > closing + 1) then
            path = ''
         else
            path = path(2:closing)
         end if
      end if
   end function included_path


   !> The folder part of PATH with its slash, empty for the current folder.
   pure function folder(path) result(part)
      character(*), intent(in)  :: path
      character(:), allocatable :: part

      part = path(:index(path, '/', back=.true.))
   end function folder

end module include_lines
