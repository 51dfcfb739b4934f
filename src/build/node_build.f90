!> Nodes: GRID cards and those of generated blocks, in the order of their numbers.
module node_build
   use block_mesh, only: block_type
   use coordinate_systems, only: coordinate_system
   use deck_check, only: checked_deck
   use element_kinds, only: element_table
   use id_table, only: sorted_order
   use kinds, only: wp
   use model_data, only: model_type
   use position_search, only: position_search_type
   use system_build, only: place_grids
   use text_tools, only: integer_text
   implicit none
   private

   public :: collect_nodes, order_nodes, append_nodes, find_nodes

   !> Nodes as they come, before they are put in order, and which of them a block's places are.
   type, public :: raw_nodes
      integer :: n = 0
      integer, allocatable  :: id(:), line(:)
      real(wp), allocatable :: x(:, :)
      integer, allocatable  :: place(:)        !! of all blocks, one after another: raw node
      integer, allocatable  :: block_start(:)  !! place(block_start(b) + 1 : block_start(b + 1))
   end type raw_nodes

contains

   !> All GRID cards and all nodes of blocks; a welded block uses the coincident nodes of the block it is welded to.
   subroutine collect_nodes(deck, systems, blocks, raw)
      type(checked_deck), intent(in)      :: deck
      type(coordinate_system), intent(in) :: systems(:)
      type(block_type), intent(in)        :: blocks(:)
      type(raw_nodes), intent(out)        :: raw
      integer :: b, k, n, total

      allocate (raw%block_start(size(blocks) + 1), source=0)
      do b = 1, size(blocks)
         raw%block_start(b + 1) = raw%block_start(b) + size(blocks(b)%node_id)
      end do
      n = size(deck%bulk%grid)
      total = n + raw%block_start(size(blocks) + 1)
      allocate (raw%id(total), raw%line(total), raw%x(3, total), raw%place(total - n))
      raw%id(:n) = deck%bulk%grid%id
      raw%line(:n) = deck%bulk%grid%line
      call place_grids(deck, systems, raw%x)
      do b = 1, size(blocks)
         associate (places => raw%place(raw%block_start(b) + 1:raw%block_start(b + 1)))
            call weld_block(deck, blocks, b, raw, places)
            do k = 1, size(places)
               if (places(k) > 0) cycle
               n = n + 1
               places(k) = n
               raw%id(n) = blocks(b)%node_id(k)
               raw%line(n) = blocks(b)%line
               raw%x(:, n) = blocks(b)%x(:, k)
            end do
         end associate
      end do
      raw%n = n
      call deck%report_repeated('node', raw%id(:n), raw%line(:n), n_cards=size(deck%bulk%grid))
   end subroutine collect_nodes

   !> Where block B is welded to an earlier one, PLACES(k) is the raw node at X(:, k) of that block, else 0.
   subroutine weld_block(deck, blocks, b, raw, places)
      type(checked_deck), intent(in) :: deck
      type(block_type), intent(in)   :: blocks(:)
      integer, intent(in)            :: b
      type(raw_nodes), intent(in)    :: raw
      integer, intent(inout)         :: places(:)
      type(position_search_type) :: search
      integer, allocatable :: near_this(:), near_other(:)
      real(wp) :: reach, distance
      integer  :: k, other, found

      places = 0
      associate (block => blocks(b))
         if (block%weld == 0) return
         do other = b - 1, 1, -1
            if (blocks(other)%id == block%weld) exit
         end do
         if (other == 0) then
            call deck%field_error(block%line, 'WELD', 'no BLOCK'//integer_text(element_table(block%kind)%dimension)//' '// &
                                  integer_text(block%weld)//' stands before this one')
            return
         end if
      end associate
      reach = 1.0e-6_wp*maxval(maxval(blocks(b)%x, dim=2) - minval(blocks(b)%x, dim=2))
      call nodes_near(blocks(other)%x, blocks(b)%x, reach, near_this)
      call nodes_near(blocks(b)%x, blocks(other)%x, reach, near_other)
      call search%build(blocks(other)%x(:, near_this))
      do k = 1, size(near_other)
         call search%nearest(blocks(b)%x(:, near_other(k)), reach, found, distance)
         if (found > 0) places(near_other(k)) = raw%place(raw%block_start(other) + near_this(found))
      end do
      if (all(places == 0)) call deck%field_error(blocks(b)%line, 'WELD', 'the two blocks have no node in common')
   end subroutine weld_block

   !> The NODES of X that lie within REACH of the box round OTHERS: of two blocks side by side those of one face alone.
   pure subroutine nodes_near(x, others, reach, nodes)
      real(wp), intent(in)              :: x(:, :), others(:, :) !! (3, n) [length]
      real(wp), intent(in)              :: reach                 !! [length]
      integer, allocatable, intent(out) :: nodes(:)
      logical, allocatable :: is_near(:)
      integer :: k

      allocate (is_near(size(x, 2)), source=.true.)
      do k = 1, 3
         is_near = is_near .and. x(k, :) >= minval(others(k, :)) - reach .and. x(k, :) <= maxval(others(k, :)) + reach
      end do
      nodes = pack([(k, k = 1, size(x, 2))], is_near)
   end subroutine nodes_near

   !> The nodes of the model in ascending order of their numbers.
   subroutine order_nodes(raw, model, position)
      type(raw_nodes), intent(in)       :: raw
      type(model_type), intent(inout)   :: model
      integer, allocatable, intent(out) :: position(:)
      integer, allocatable :: order(:)
      integer :: i

      call sorted_order(raw%id(:raw%n), order)
      allocate (position(raw%n))
      position(order) = [(i, i = 1, raw%n)]
      model%n_nodes = raw%n
      model%node_id = raw%id(order)
      model%x = raw%x(:, order)
      call model%node_table%build(model%node_id)
   end subroutine order_nodes

   !> Append nodes at X to those of MODEL, numbered behind the highest; the table of numbers has them too. What would pass the largest
   !! number that there is has that.
   subroutine append_nodes(model, x)
      type(model_type), intent(inout) :: model
      real(wp), intent(in)            :: x(:, :) !! (3, new nodes) [length]
      real(wp), allocatable :: all_x(:, :)
      integer :: k, n

      n = model%n_nodes
      allocate (all_x(3, n + size(x, 2)))
      all_x(:, :n) = model%x
      all_x(:, n + 1:) = x
      call move_alloc(all_x, model%x)
      model%node_id = [model%node_id, (model%node_id(n) + min(k, huge(1) - model%node_id(n)), k = 1, size(x, 2))]
      model%n_nodes = n + size(x, 2)
      call model%node_table%build(model%node_id)
   end subroutine append_nodes

   !> The NODES of the model with the numbers ID, which a card of an element, edge or interface element names from its data field
   !! FIRST on; 0, and an error, where there is none. An id of 0 is no node: a field that is blank or could not be read.
   subroutine find_nodes(deck, line, id, model, nodes, first)
      type(checked_deck), intent(in) :: deck
      integer, intent(in)            :: line     !! of the card
      integer, intent(in)            :: id(:)
      type(model_type), intent(in)   :: model
      integer, intent(out)           :: nodes(:)
      integer, intent(in), optional  :: first    !! 3
      integer :: behind, k

      nodes = 0
      behind = 2
      if (present(first)) behind = first - 1
      do k = 1, size(id)
         if (id(k) == 0) cycle
         nodes(k) = model%node_table%find(id(k))
         if (nodes(k) == 0) call deck%field_error(line, k + behind, 'there is no GRID '//integer_text(id(k)), noun='node')
      end do
   end subroutine find_nodes

end module node_build
