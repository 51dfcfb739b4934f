!> Tables of reference nodes with rotations: how they turn, and the moments of supports that hold them.
module listing_rotations
   use analysis_state, only: analysis_type
   use kinds, only: wp
   use listing_directions, only: add_directed, direction_columns, direction_words
   use listing_table, only: column, listing_table_type, noise, page_type
   use model_data, only: model_type, n_rotations, supported
   use node_coupling, only: held_forces
   implicit none
   private

   public :: list_rotations, list_moments

contains

   !> Rotations in radians about the global axes, or those of the systems CD.
   subroutine list_rotations(page, model, analysis)
      type(page_type), intent(inout)  :: page
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      type(listing_table_type) :: table
      real(wp) :: floor
      integer  :: i, m

      if (n_rotations(model) == 0) return
      m = merge(3, 1, model%dimension == 3)
      call start_table(page, table, 'ROTATIONS OF REFERENCE NODES'//direction_words(page)//page%now//'   (RADIANS)', 'THETA ', m)
      associate (rotations => model%rotations)
         floor = noise*maxval(abs(analysis%all_u)) ! of displacements
         do i = 1, size(rotations)
            call table%add([model%node_id(rotations(i)%point)])
            call add_directed(page, model, rotations(i)%point, analysis%all_u(:m, rotations(i)%node)/rotations(i)%arm, &
                              floor/rotations(i)%arm, table)
            call table%print_row(page%file)
         end do
      end associate
   end subroutine list_rotations

   !> Moments of supports about these axes, where any rotation is supported.
   subroutine list_moments(page, model, analysis)
      type(page_type), intent(inout)  :: page
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      type(listing_table_type) :: table
      real(wp), allocatable :: held(:, :)
      real(wp) :: floor
      integer  :: i, m

      if (.not. any([(any(supported(model, model%rotations(i)%node)), i = 1, n_rotations(model))])) return
      m = merge(3, 1, model%dimension == 3)
      call start_table(page, table, 'MOMENTS AT SUPPORTS'//direction_words(page)//page%now, 'M', m)
      held = held_forces(model, analysis%all_unbalanced)
      do i = 1, size(model%rotations)
         associate (rotation => model%rotations(i))
            if (.not. any(supported(model, rotation%node))) cycle
            floor = noise*max(page%largest_force, tiny(1.0_wp))*rotation%arm
            call table%add([model%node_id(rotation%point)])
            call add_directed(page, model, rotation%point, -held(:m, rotation%node)*rotation%arm, floor, table)
            call table%print_row(page%file)
         end associate
      end do
   end subroutine list_moments

   !> Open a TABLE with a column for the node and one for the part about each axis.
   subroutine start_table(page, table, title, part, m)
      type(page_type), intent(inout)          :: page
      type(listing_table_type), intent(inout) :: table
      character(*), intent(in)                :: title, part
      integer, intent(in)                     :: m !! axes: 3, or z alone

      call table%start(title, [column('NODE', 'i11'), direction_columns(page, part, m, behind=.true.)])
      call table%print_head(page%file)
   end subroutine start_table

end module listing_rotations
