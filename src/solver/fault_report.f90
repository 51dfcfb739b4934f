!> A factorisation that failed, in words: which node has no stiffness in which direction.
module fault_report
   use equation_numbering, only: equation_numbers
   use equation_solver, only: no_memory
   use failures, only: failure_type
   use model_data, only: model_type, n_points
   use text_tools, only: integer_text
   implicit none
   private

   public :: report_fault

contains

   !> FAULT, an equation without stiffness or no_memory, in words.
   subroutine report_fault(model, numbers, fault, where, failure)
      type(model_type), intent(in)      :: model
      class(equation_numbers), intent(in) :: numbers
      integer, intent(in)               :: fault
      character(*), intent(in)          :: where
      type(failure_type), intent(inout) :: failure

      if (fault == no_memory) then
         call failure%raise(where//'no memory for the factor of '//integer_text(numbers%n)//' equations')
      else if (fault > 0) then
         call failure%raise(where//'the structure is a mechanism: '// &
            what_is_loose(model, numbers%node(fault), numbers%direction(fault))// &
            ' (not supported there, or every joint that held it is open)')
      end if
   end subroutine report_fault


   !> What has no stiffness, in words.
   pure function what_is_loose(model, node, d) result(words)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: node, d
      character(:), allocatable    :: words
      character(1), parameter :: direction_name(3) = ['X', 'Y', 'Z']

      if (node <= n_points(model)) then
         words = 'node '//integer_text(model%node_id(node))//' has no stiffness in direction '//direction_name(d)
      else
         words = 'nothing holds BOLT '//integer_text(model%sections(node - n_points(model))%bolt)//' together at its section'
      end if
   end function what_is_loose

end module fault_report
