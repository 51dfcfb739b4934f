!> What stands between two blocks of equations and changes in the run, as rank 0 sees it: joints, bars, and the sections of bolts
!! that are locked. These blocks have a list of their own; their values in all states of the matrix are made here,
!!
!!      bodies       what elements and bars leave there
!!      structure    that and the joints; of a locked equation, row and column, the identity
!!
!! and the processes that have them put them in their places.
module touched_blocks
   use interface_equations, only: interface_equations_type
   use interface_operator, only: interface_element
   use kinds, only: wp
   use lists, only: first_not_below, sorted_order
   use model_data, only: bar_nodes, model_type, n_bars, n_sections
   use node_coupling, only: unknown_nodes
   use node_graph, only: node_graph_type
   use partition, only: partition_type
   implicit none
   private

   public :: list_touched, add_touched, structure_values

   type, public :: touched_type
      integer :: n = 0
      integer, allocatable :: row(:), column(:)   !! (n) blocks from 0 on, ascending by row, then by column
      integer, allocatable :: first(:)             !! (blocks + 1) rows first(b + 1) to first(b + 2) - 1 are of block b
      integer, allocatable :: counts(:)            !! (ranks) of the rows of each
   end type touched_type

contains

   !> The touched blocks of the interface ELEMENTS, on unknowns, of the bars and of the sections of MODEL.
   subroutine list_touched(model, graph, parts, elements, touched)
      type(model_type), intent(in)        :: model
      type(node_graph_type), intent(in)   :: graph
      type(partition_type), intent(in)         :: parts
      type(interface_element), intent(in) :: elements(:)
      type(touched_type), intent(out)     :: touched
      integer, allocatable :: pairs(:, :)
      integer :: i, k, n, pass

      do pass = 1, 2 ! count, then fill
         n = 0
         do i = 1, size(elements)
            call pair(elements(i)%node)
         end do
         do i = 1, n_bars(model)
            call pair(unknown_nodes(model, bar_nodes(model%bars(i))))
         end do
         do i = 1, n_sections(model)
            associate (node => model%sections(i)%node)
               do k = graph%first(node), graph%first(node + 1) - 1
                  call pair([node, graph%neighbours(k)])
               end do
            end associate
         end do
         if (pass == 1) allocate (pairs(2, n))
      end do
      call sort_once(size(parts%order), pairs, touched)
      allocate (touched%counts(size(parts%counts)))
      n = 0
      do i = 1, size(parts%counts)
         touched%counts(i) = touched%first(n + parts%counts(i) + 1) - touched%first(n + 1)
         n = n + parts%counts(i)
      end do

   contains

      subroutine pair(nodes)
         integer, intent(in) :: nodes(:)
         integer :: a, b

         do b = 1, size(nodes)
            do a = 1, size(nodes)
               if (parts%block(nodes(a)) < 0 .or. parts%block(nodes(b)) < 0) cycle
               n = n + 1
               if (pass == 2) pairs(:, n) = parts%block([nodes(a), nodes(b)])
            end do
         end do
      end subroutine pair

   end subroutine list_touched

   !> The PAIRS, each once, in their order: sorted by column and then by row.
   subroutine sort_once(n_blocks, pairs, touched)
      integer, intent(in)               :: n_blocks, pairs(:, :)
      type(touched_type), intent(inout) :: touched
      integer, allocatable :: by_column(:), by_row(:)
      integer :: i, k

      call sorted_order(pairs(2, :), by_column)
      call sorted_order(pairs(1, by_column), by_row)
      by_row = by_column(by_row)
      allocate (touched%row(size(by_row)), touched%column(size(by_row)))
      do i = 1, size(by_row)
         k = touched%n
         if (k > 0) then
            if (touched%row(k) == pairs(1, by_row(i)) .and. touched%column(k) == pairs(2, by_row(i))) cycle
         end if
         touched%n = k + 1
         touched%row(k + 1) = pairs(1, by_row(i))
         touched%column(k + 1) = pairs(2, by_row(i))
      end do
      touched%row = touched%row(:touched%n)
      touched%column = touched%column(:touched%n)
      allocate (touched%first(n_blocks + 1), source=0)
      do i = 1, touched%n
         touched%first(touched%row(i) + 1) = touched%first(touched%row(i) + 1) + 1
      end do
      touched%first(n_blocks + 1) = touched%n + 1
      do i = n_blocks, 1, -1
         touched%first(i) = touched%first(i + 1) - touched%first(i)
      end do
   end subroutine sort_once

   !> Where the block of ROW and COLUMN stands; it is there.
   pure integer function place_of(touched, row, column) result(place)
      type(touched_type), intent(in) :: touched
      integer, intent(in)            :: row, column

      associate (first => touched%first(row + 1), behind => touched%first(row + 2))
         place = first - 1 + first_not_below(touched%column(first:behind - 1), column)
      end associate
   end function place_of

   !> Add the symmetric matrix K between ROWS of the matrix to VALUES of the touched blocks.
   pure subroutine add_touched(touched, rows, k, values)
      type(touched_type), intent(in) :: touched
      integer, intent(in)            :: rows(:)         !! from 1 on; 0: none
      real(wp), intent(in)           :: k(:, :)         !! [force/length]
      real(wp), intent(inout)        :: values(:, :, :) !! (dimension, dimension, n) [force/length]
      integer :: b(size(rows)), c(size(rows)), i, j

      b = (rows - 1)/size(values, 1)
      c = rows - size(values, 1)*b
      do j = 1, size(rows)
         if (rows(j) == 0) cycle
         do i = 1, size(rows)
            if (rows(i) == 0) cycle
            associate (place => place_of(touched, b(i), b(j)))
               values(c(i), c(j), place) = values(c(i), c(j), place) + k(i, j)
            end associate
         end do
      end do
   end subroutine add_touched

   !> VALUES, of the bodies, become those with the joints K_INT, whose equation i is ROW(i) of the matrix; the equations LOCKED get the
   !! diagonal UNIT.
   subroutine structure_values(touched, joints, k_int, row, locked, unit, values)
      type(touched_type), intent(in)             :: touched
      type(interface_equations_type), intent(in) :: joints
      real(wp), intent(in)                       :: k_int(:, :, :)  !! (3, 3, joints%n) [force/length]
      integer, intent(in)                        :: row(0:)         !! from 1 on; of 0: 0
      integer, intent(in)                        :: locked(:)
      real(wp), intent(in)                       :: unit            !! [force/length]
      real(wp), intent(inout)                    :: values(:, :, :) !! (dimension, dimension, n) [force/length]
      integer :: block, c, i, k

      do i = 1, joints%n
         call add_touched(touched, row(joints%rows_of(i)), joints%matrix_of(i, k_int(:, :, i)), values)
      end do
      do i = 1, size(locked)
         block = (row(locked(i)) - 1)/size(values, 1)
         c = row(locked(i)) - size(values, 1)*block
         do k = 1, touched%n
            if (touched%row(k) == block) values(c, :, k) = 0.0_wp
            if (touched%column(k) == block) values(:, c, k) = 0.0_wp
            if (touched%row(k) == block .and. touched%column(k) == block) values(c, c, k) = unit
         end do
      end do
   end subroutine structure_values

end module touched_blocks
