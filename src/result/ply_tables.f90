!> The table of the stresses in the plies of laminates, in the axes of each ply.
module ply_tables
   use analysis_state, only: analysis_type
   use element_unknowns, only: displaced_nodes
   use kinds, only: wp
   use mesh_queries, only: element_points, is_shell
   use model_data, only: model_type
   use page_lines, only: in_units
   use result_page, only: page_type, shows
   use shell_recovery, only: ply_stresses
   use structural_elements, only: nodal_values
   use table_column, only: column
   use table_writer, only: table_type
   use temperatures, only: element_rise, element_slope
   use tolerances, only: page_zero
   implicit none
   private

   public :: list_plies

contains

   !> The stresses in the plies of laminates at the centres of shells, at the lower face, the middle and the upper face of a ply: those
   !! with SOUT = YES, or all plies of a laminate where none has it.
   subroutine list_plies(page, model, analysis)
      type(page_type), intent(inout)  :: page
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      character(8), parameter :: names(3) = [character(8) :: 'SIGMA 1', 'SIGMA 2', 'TAU 12']
      type(table_type) :: table
      real(wp), allocatable :: stress(:, :, :)
      integer :: e, i, k, pass
      real(wp) :: floor

      floor = 0.0_wp
      do pass = 1, 2 ! the largest stress, then the rows
         do e = 1, model%mesh%n_elements
            if (.not. is_shell(model%mesh, e)) cycle
            associate (law => model%mesh%structural%shells(model%mesh%structural%place(e)), nodes => element_points(model%mesh, e))
               if (.not. allocated(law%plies) .or. .not. shows(page, nodes)) cycle
               if (allocated(stress)) deallocate (stress)
               allocate (stress(3, 3, size(law%plies)))
               stress(:, :, :) = ply_stresses(law, model%mesh%x(:, nodes), &
                  nodal_values(model, e, analysis%all_u(:, displaced_nodes(model%freedoms, e))), &
                  element_rise(model, e, analysis%now%temperature), element_slope(model, e, analysis%now%temperature))
               floor = max(floor, page_zero*maxval(abs(stress)))
               if (pass == 1) cycle
               do i = 1, size(law%plies)
                  if (any(law%plies%shown) .and. .not. law%plies(i)%shown) cycle
                  associate (ply => law%plies(i))
                     do k = 1, 3
                        call table%put('ELEMENT', model%mesh%element_id(e))
                        call table%put('PLY', ply%id)
                        call table%put('HEIGHT', ply%from + 0.5_wp*real(k - 1, wp)*(ply%to - ply%from))
                        call table%put(names, stress(:, k, i), floor)
                        call table%print_row(page%file)
                     end do
                  end associate
               end do
            end associate
         end do
         if (.not. allocated(stress)) return
         if (pass == 1) call table%start('STRESSES IN PLIES IN THEIR DIRECTIONS 1 AND 2, AT THE CENTRES OF SHELLS'//page%now// &
            in_units(page%labels%pressure), [column('ELEMENT', 'i11'), column('PLY', 'i6'), column('HEIGHT', 'es13.5'), &
                                             column(names, 'es13.5')], page%file)
      end do
   end subroutine list_plies

end module ply_tables
