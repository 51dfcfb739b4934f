!> The names of the files of results, and the removal of those of an earlier run.
!! A name is that of the deck with an ending: `.out` the listing, `.early` the mark of a run that ended early, `.restart` the state
!! from which a run goes on, the endings of the CSV tables and those of the files for ParaView.
module result_names
   use c_library, only: close_file, lock_folder
   use incomplete_results, only: remove_old
   use result_page, only: table_endings
   use vtu_results, only: is_vtu_ending, remove_old_vtu
   implicit none
   private

   public :: remove_old_results, remove_all, is_result_ending

   character(*), parameter, public :: listing_ending = '.out', early_ending = '.early', restart_ending = '.restart'

contains

   !> Remove the results of an earlier run of the same deck, which are no longer valid.
   subroutine remove_old_results(base)
      character(*), intent(in) :: base
      integer :: hold
      logical :: closed

      if (base == '') return
      call lock_folder(base(:index(base, '/', back=.true.))//'.', hold)
      call remove_all(base)
      call close_file(hold, closed)
   end subroutine remove_old_results

   !> Remove the results whose names begin with BASE, none where it is empty.
   subroutine remove_all(base)
      character(*), intent(in) :: base
      integer :: i

      if (base == '') return
      call remove_old(base//listing_ending)
      do i = 1, size(table_endings)
         call remove_old(base//trim(table_endings(i)))
      end do
      call remove_old_vtu(base)
      call remove_old(base//early_ending)
   end subroutine remove_all

   !> Whether ENDING, behind the base, is that of a result file.
   pure logical function is_result_ending(ending)
      character(*), intent(in) :: ending

      is_result_ending = any(ending == [character(22) :: listing_ending, restart_ending, early_ending, &
                              table_endings]) .or. is_vtu_ending(ending)
   end function is_result_ending

end module result_names
