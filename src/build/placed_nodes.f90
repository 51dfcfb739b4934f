!> Nodes defined by position or surface: reference nodes of RBE2M and RBE3M, and NODEAT.
!! A new reference node lies at the centroid of its marked surface. NODEAT is another number for the node nearest to a position.
module placed_nodes
   use block_mesh, only: block_type
   use deck_check, only: checked_deck
   use element_kinds, only: element_table
   use kinds, only: wp
   use lists, only: id_table_type
   use model_data, only: model_type, placed_node
   use node_build, only: raw_nodes
   use numbers, only: cross
   use text_tools, only: integer_text
   implicit none
   private

   public :: add_reference_nodes, find_places

contains

   !> Append to RAW the reference nodes of RBE2M and RBE3M that name none: each at the centroid of its surface, numbered from the
   !! highest node number of the deck on.
   subroutine add_reference_nodes(deck, blocks, raw)
      type(checked_deck), intent(inout) :: deck
      type(block_type), intent(in)      :: blocks(:)
      type(raw_nodes), intent(inout)    :: raw
      type(id_table_type)  :: table
      integer, allocatable :: sides(:, :)
      integer :: highest, i, n_new

      n_new = count(deck%rigid%surface > 0 .and. deck%rigid%node == 0)
      if (n_new == 0 .or. raw%n == 0) return
      highest = max(maxval(raw%id(:raw%n)), maxval([0, deck%bulk%place%id]))
      if (highest > huge(1) - n_new) then
         call deck%errors%add(0, 'the reference nodes of RBE2M and RBE3M get numbers above node '//integer_text(highest)// &
                              ', and their numbers would exceed 2147483647')
         return
      end if
      call table%build(raw%id(:raw%n))
      raw%id = [raw%id(:raw%n), spread(0, 1, n_new)]
      raw%line = [raw%line(:raw%n), spread(0, 1, n_new)]
      raw%x = reshape([raw%x(:, :raw%n), spread([0.0_wp, 0.0_wp, 0.0_wp], 2, n_new)], [3, raw%n + n_new])
      do i = 1, size(deck%rigid)
         associate (card => deck%rigid(i))
            if (card%surface == 0 .or. card%node > 0) cycle
            call list_sides(deck, blocks, raw, table, card%surface, .true., sides)
            highest = highest + 1
            card%node = highest
            raw%n = raw%n + 1
            raw%id(raw%n) = highest
            raw%line(raw%n) = card%line
            raw%x(:, raw%n) = centroid(raw%x, sides)
         end associate
      end do
   end subroutine add_reference_nodes

   !> The SIDES with the mark SURFACE, as raw nodes: their corners, or all nodes on the cards; 0 behind the last.
   subroutine list_sides(deck, blocks, raw, table, surface, corners_only, sides)
      type(checked_deck), intent(in)    :: deck
      type(block_type), intent(in)      :: blocks(:)
      type(raw_nodes), intent(in)       :: raw
      type(id_table_type), intent(in)   :: table    !! of raw nodes
      integer, intent(in)               :: surface
      logical, intent(in)               :: corners_only
      integer, allocatable, intent(out) :: sides(:, :) !! (8, n)
      integer :: b, i, k, n

      associate (bulk => deck%bulk)
         n = count(bulk%edge%property == surface) + count(bulk%element%property == surface)
         do b = 1, size(blocks)
            n = n + count(blocks(b)%mark == surface)
         end do
         allocate (sides(8, n), source=0)
         n = 0
         do i = 1, size(bulk%edge)
            if (bulk%edge(i)%property == surface) call add_side(bulk%edge(i)%nodes(:merge(2, 3, corners_only)))
         end do
         do i = 1, size(bulk%element)
            if (bulk%element(i)%property == surface) call add_side(bulk%element(i)%nodes(:merge(corners_of(i), 8, corners_only)))
         end do
      end associate
      do b = 1, size(blocks)
         do i = 1, blocks(b)%n_sides
            if (blocks(b)%mark(i) /= surface) cycle
            n = n + 1
            do k = 1, count(blocks(b)%side(:, i) > 0)
               sides(k, n) = raw%place(raw%block_start(b) + blocks(b)%side(k, i))
            end do
         end do
      end do

   contains

      integer function corners_of(i)
         integer, intent(in) :: i

         corners_of = element_table(deck%bulk%element(i)%kind)%n_corners
      end function corners_of

      subroutine add_side(nodes)
         integer, intent(in) :: nodes(:)
         integer :: k, m

         n = n + 1
         m = 0
         do k = 1, min(size(nodes), 8)
            if (nodes(k) <= 0) cycle
            if (table%find(nodes(k)) == 0) cycle ! reported elsewhere
            m = m + 1
            sides(m, n) = table%find(nodes(k))
         end do
      end subroutine add_side

   end subroutine list_sides

   !> The centroid of SIDES, weighted by length of edges or area of faces; the mean of the nodes where the total is zero.
   pure function centroid(x, sides)
      real(wp), intent(in) :: x(:, :)     !! (3, nodes) [length]
      integer, intent(in)  :: sides(:, :) !! (8, n) nodes, 0 behind the last
      real(wp) :: centroid(3), extent, total
      integer  :: k, n, s

      centroid = 0.0_wp
      total = 0.0_wp
      do s = 1, size(sides, 2)
         n = count(sides(:, s) > 0)
         associate (p => x(:, sides(:n, s)))
            if (n == 2) then
               extent = norm2(p(:, 2) - p(:, 1))
               centroid = centroid + extent*0.5_wp*(p(:, 1) + p(:, 2))
               total = total + extent
            end if
            do k = 2, n - 1
               extent = 0.5_wp*norm2(cross(p(:, k) - p(:, 1), p(:, k + 1) - p(:, 1)))
               centroid = centroid + extent*(p(:, 1) + p(:, k) + p(:, k + 1))/3.0_wp
               total = total + extent
            end do
         end associate
      end do
      if (total > 0.0_wp) centroid = centroid/total
   end function centroid

   !> The nodes of NODEAT cards: the number of a card becomes a number of the node nearest to its position. Of equally near nodes the
   !! new reference node of an RBE2M or RBE3M is taken, else the node with the lowest number.
   subroutine find_places(deck, blocks, raw, position, model)
      type(checked_deck), intent(in)  :: deck
      type(block_type), intent(in)    :: blocks(:)
      type(raw_nodes), intent(in)     :: raw
      integer, intent(in)             :: position(:) !! raw node -> node of the model
      type(model_type), intent(inout) :: model
      type(id_table_type)   :: table
      real(wp), allocatable :: distance(:)
      integer, allocatable  :: sides(:, :)
      logical, allocatable  :: is_meant(:) ! raw nodes
      real(wp) :: rounding
      integer  :: i, k, n, n_given

      n = raw%n
      n_given = n - count(deck%bulk%rigid%surface > 0 .and. deck%bulk%rigid%node == 0)
      allocate (model%placed(0))
      do i = 1, size(deck%rigid)
         if (deck%rigid(i)%surface > 0) model%placed = [model%placed, placed_node(element=deck%rigid(i)%id, &
            surface=deck%rigid(i)%surface, node=model%node_table%find(deck%rigid(i)%node))]
      end do
      if (size(deck%bulk%place) == 0 .or. n == 0) return
      call table%build(raw%id(:n))
      rounding = 1.0e-9_wp*maxval(maxval(raw%x(:, :n), dim=2) - minval(raw%x(:, :n), dim=2))
      do i = 1, size(deck%bulk%place)
         associate (card => deck%bulk%place(i))
            if (card%id == 0) cycle
            if (table%find(card%id) > 0) then
               call deck%field_error(card%line, 'ID', 'there is a node '//integer_text(card%id)// &
                                     ' already; expected another number')
               cycle
            end if
            is_meant = spread(card%surface == 0, 1, n)
            if (card%surface > 0) then
               call list_sides(deck, blocks, raw, table, card%surface, .false., sides)
               is_meant(pack(sides, sides > 0)) = .true.
               do k = 1, size(deck%rigid)
                  if (deck%rigid(k)%surface /= card%surface) cycle
                  if (table%find(deck%rigid(k)%node) > 0) is_meant(table%find(deck%rigid(k)%node)) = .true.
               end do
            end if
            if (.not. any(is_meant)) then
               call deck%field_error(card%line, 'PID', 'surface '//integer_text(card%surface)//' has no nodes; '// &
                                     'expected a PMARK with faces or edges, or blank')
               cycle
            end if
            distance = norm2(raw%x(:, :n) - spread(card%x, 2, n), dim=1)
            is_meant = is_meant .and. distance <= minval(distance, mask=is_meant) + rounding
            if (any(is_meant(n_given + 1:))) is_meant(:n_given) = .false.
            model%placed = [model%placed, placed_node(id=card%id, surface=card%surface, x=card%x, &
                                                      node=position(minloc(raw%id(:n), dim=1, mask=is_meant)))]
         end associate
      end do
      associate (named => model%placed%id > 0)
         call model%node_table%add(pack(model%placed%id, named), pack(model%placed%node, named))
      end associate
   end subroutine find_places

end module placed_nodes
