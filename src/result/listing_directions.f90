!> Directions that the tables of nodes have: those of the model, or with OUTPUT = CD those of the displacement system of every node,
!! whose number stands behind its row.
module listing_directions
   use kinds, only: wp
   use listing_table, only: axes, column, column_type, listing_table_type, page_type
   use model_data, only: model_type
   use reference_nodes, only: node_axes
   use text_tools, only: clean
   implicit none
   private

   public :: direction_columns, direction_words, add_directed

   character(1), parameter :: numbers(3) = ['1', '2', '3']

contains

   !> Columns of a vector whose parts are called PART, along M directions: the first ones, or BEHIND the last ones.
   function direction_columns(page, part, m, behind) result(columns)
      type(page_type), intent(in)   :: page
      character(*), intent(in)      :: part
      integer, intent(in)           :: m
      logical, intent(in), optional :: behind !! default: the first ones
      type(column_type), allocatable :: columns(:)
      character(1) :: names(3)
      integer :: first

      first = 1
      if (present(behind)) first = merge(4 - m, 1, behind)
      names = axes
      if (page%along_cd) names = numbers
      columns = [column(part//names(first:first + m - 1), 'es13.5')]
      if (page%along_cd) columns = [columns, column('CD', 'i11')]
   end function direction_columns

   !> What stands behind the title of such a table.
   pure function direction_words(page) result(words)
      type(page_type), intent(in) :: page
      character(:), allocatable :: words

      words = ''
      if (page%along_cd) words = ' ALONG THEIR SYSTEMS CD (0: X, Y, Z)'
   end function direction_words

   !> Add the VECTOR at NODE in global axes to the row of TABLE, what is below FLOOR as zero, and the node's system where it counts.
   subroutine add_directed(page, model, node, vector, floor, table)
      type(page_type), intent(in)             :: page
      type(model_type), intent(in)            :: model
      integer, intent(in)                     :: node
      real(wp), intent(in)                    :: vector(:)
      real(wp), intent(in)                    :: floor
      type(listing_table_type), intent(inout) :: table
      real(wp) :: directions(3, 3)
      integer  :: system

      if (.not. page%along_cd) then
         call table%add(clean(vector, floor))
         return
      end if
      directions = node_axes(model, node)
      system = 0
      if (allocated(model%node_system)) system = model%node_system(node)
      if (system > 0) system = model%systems(system)%id
      if (size(vector) == 1) then ! about z of a plane model
         call table%add(clean(vector*directions(3, 3), floor))
      else
         associate (d => size(vector))
            call table%add(clean(matmul(vector, directions(:d, :d)), floor))
         end associate
      end if
      call table%add([system])
   end subroutine add_directed

end module listing_directions
