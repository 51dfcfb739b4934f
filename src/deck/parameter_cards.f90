!> PARAM: numbers that steer NASTRAN. Most have no effect here, some would change the answer.
module parameter_cards
   use bulk_data, only: bulk_data_type
   use card_lines, only: card_values
   use card_reader, only: card_reader_type
   use field_rules, only: any_field
   use nastran_compatibility, only: take_parameter
   implicit none
   private

   public :: read_parameter

contains

   !> PARAM: a name and one value or two, of any kind.
   subroutine read_parameter(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values)         :: values
      character(:), allocatable :: expected
      integer :: i

      call cards%set_table(any_field(['N ', 'V1', 'V2']))
      do i = 1, cards%n
         call cards%next(values)
         if (.not. values%given(1)) call cards%error('N', 'blank, expected the name of a parameter')
         if (.not. values%given(2)) call cards%error('V1', 'blank, expected the value of the parameter')
         if (.not. all(values%given(:2))) cycle
         associate (fields => cards%card%fields)
            call take_parameter(trim(fields(1)%text), trim(fields(2)%text), cards%line, bulk%parameters, bulk%idle, expected)
            if (expected /= '') then
               call cards%error('V1', ''''//trim(fields(2)%text)//''' for '//trim(fields(1)%text)//', expected '//expected)
            end if
         end associate
      end do
   end subroutine read_parameter

end module parameter_cards
