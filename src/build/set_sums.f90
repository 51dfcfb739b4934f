!> Sets that SPCADD and MPCADD sum up.
module set_sums
   use bulk_data, only: set_sum_card
   use deck_check, only: checked_deck
   use text_tools, only: integer_text
   implicit none
   private

   public :: summed_sets, check_sums

contains

   !> The sets that SET means: itself, or those of the SUMS with this number.
   pure function summed_sets(sums, set) result(sets)
      type(set_sum_card), intent(in) :: sums(:)
      integer, intent(in)            :: set !! 0: none
      integer, allocatable :: sets(:)
      integer :: i

      sets = [set]
      do i = 1, size(sums)
         if (sums(i)%set == set .and. set > 0) sets = sums(i)%sets
      end do
   end function summed_sets

   !> The SUMS, cards called NAME, are of sets that are there, and have numbers of their own. OWN are the sets of the cards CALLED so
   !! that may be summed up.
   subroutine check_sums(deck, name, sums, own, called)
      type(checked_deck), intent(in) :: deck
      character(*), intent(in)       :: name, called
      type(set_sum_card), intent(in) :: sums(:)
      integer, intent(in)            :: own(:)
      integer :: i, k

      call deck%report_repeated(name, sums%set, sums%line)
      do i = 1, size(sums)
         associate (card => sums(i))
            if (any(own == card%set) .and. card%set > 0) call deck%field_error(card%line, 'SID', 'set '//integer_text(card%set)// &
               ' is that of an '//called//' too: case control could mean either')
            do k = 1, size(card%sets)
               if (card%sets(k) <= 0 .or. any(own == card%sets(k))) cycle
               if (any(sums%set == card%sets(k))) then
                  call deck%field_error(card%line, card%at(k), integer_text(card%sets(k))//' is an '//name// &
                                        ' too; expected the sets of '//called//' that it sums up', called='S'//integer_text(k))
               else
                  call deck%field_error(card%line, card%at(k), 'there is no '//called//' with set '//integer_text(card%sets(k)), &
                                        called='S'//integer_text(k))
               end if
            end do
         end associate
      end do
   end subroutine check_sums

end module set_sums
