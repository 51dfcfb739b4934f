!> NAME.response.csv: amplitude and phase of the nodes asked, over the frequency of a load that oscillates, in full precision.
module response_file
   use csv_line, only: csv_line_type
   use modal_response, only: response_type
   use output_file, only: output_file_type
   use text_tools, only: clean
   implicit none
   private

   public :: write_response_header, write_response

   character(1), parameter :: component_names(3) = ['x', 'y', 'z']

contains

   subroutine write_response_header(file)
      type(output_file_type), intent(inout) :: file

      call file%put('stage,frequency,node,component,amplitude,phase')
   end subroutine write_response_header

   !> The rows of the ANSWER of STAGE: frequency by frequency, at each node by node, of each its components.
   subroutine write_response(file, stage, answer)
      type(output_file_type), intent(inout) :: file
      integer, intent(in)                   :: stage !! number of the SUBCASE
      type(response_type), intent(in)       :: answer
      type(csv_line_type) :: line
      integer :: d, f, k

      do f = 1, size(answer%frequency)
         do k = 1, size(answer%node)
            do d = 1, size(answer%amplitude, 1)
               line%length = 0
               call line%add([stage])
               call line%add(clean([answer%frequency(f)]))
               call line%add([answer%node(k)])
               call line%add(component_names(d))
               call line%add(clean([answer%amplitude(d, k, f), answer%phase(d, k, f)]))
               call file%put(line%text(:line%length))
            end do
         end do
      end do
   end subroutine write_response

end module response_file
