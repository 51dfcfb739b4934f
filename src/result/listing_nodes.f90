!> What tables of nodes have in common: which rows they show where OUTPUT limits a stage to some nodes (those of the nodes, and of
!! the elements that have any of them); their directions, those of the model, or with OUTPUT = CD those of the displacement system of
!! every node, whose number stands behind its row. And the tables of reference nodes with rotations: how they turn, and the moments
!! of supports that hold them.
module listing_nodes
   use analysis_state, only: analysis_type
   use kinds, only: wp
   use listing_table, only: axes, column, column_type, listing_table_type, noise, page_type
   use model_data, only: corners_of, model_type, n_rotations, supported
   use node_coupling, only: held_forces
   use reference_nodes, only: node_axes
   use text_tools, only: clean
   implicit none
   private

   public :: in_units, shows_node, shows_element, shows_interface, direction_columns, direction_words, add_directed, &
             list_rotations, list_moments

   character(1), parameter :: numbers(3) = ['1', '2', '3']

contains

   pure logical function shows_node(page, node)
      type(page_type), intent(in) :: page
      integer, intent(in)         :: node

      shows_node = .true.
      if (allocated(page%shown)) shows_node = page%shown(node)
   end function shows_node

   !> Of body element E.
   pure logical function shows_element(page, model, e)
      type(page_type), intent(in)  :: page
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e

      shows_element = .true.
      if (allocated(page%shown)) shows_element = any(page%shown(corners_of(model, e)))
   end function shows_element

   !> Of interface element I.
   pure logical function shows_interface(page, model, i)
      type(page_type), intent(in)  :: page
      type(model_type), intent(in) :: model
      integer, intent(in)          :: i

      shows_interface = .true.
      if (allocated(page%shown)) shows_interface = any(page%shown(model%interface(i)%node))
   end function shows_interface

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
      real(wp), intent(in)                    :: vector(:), floor
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

      call table%start(title, [column('NODE', 'i11'), direction_columns(page, part, m, behind=.true.)], page%file)
   end subroutine start_table

   !> The unit behind a heading, in brackets; empty where LABEL is blank.
   pure function in_units(label) result(words)
      character(*), intent(in)  :: label
      character(:), allocatable :: words

      words = ''
      if (label /= '') words = '   ('//trim(label)//')'
   end function in_units

end module listing_nodes
