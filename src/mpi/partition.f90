!> Partitions the structure: which nodes, elements and equations each process owns.
!! METIS partitions the nodes so that few elements lie between two parts. An element belongs to the part of its first node. The
!! nodes with unknowns are the BLOCKS of the equations, the part of rank 0 first. A block has as many rows as there are dimensions;
!! the row of a held component is that of the identity.
!!
!! Joints, bars and locked bolt sections change during the run. The blocks that they touch have a list of their own. Rank 0 computes
!! the values of these touched blocks in all states of the matrix,
!!
!!      bodies       the contributions of elements and bars
!!      structure    these and the joints; a locked equation has row and column of the identity
!!
!! and the processes that own the blocks insert the values.
module partition
   use body_parts, only: extract, nodes_of_elements
   use interface_operator, only: interface_element
   use kinds, only: wp
   use lists, only: first_not_below, list_owners, sorted_order
   use mesh_queries, only: element_points, is_beam, is_shell, start_parts
   use metis, only: part_by_metis
   use model_data, only: bar_nodes, model_type, n_bars, n_sections
   use node_coupling, only: is_coupled, section_node, unknown_nodes
   use node_graph, only: node_graph_type
   use ranks, only: n_ranks, pass, rank
   use unknowns, only: motions_of, n_motions
   implicit none
   private

   public :: partition_nodes, subdomain_of, is_entangled, pass_subdomain, pass_part, list_touched, add_touched

   !> The partition of the nodes, known to rank 0.
   type, public :: partition_type
      integer, allocatable :: owner(:)        !! (n_nodes) rank, -1: no unknowns
      integer, allocatable :: block(:)        !! (n_nodes) from 0, -1: none
      integer, allocatable :: order(:)        !! (blocks) the node of each block
      integer, allocatable :: counts(:)       !! (ranks) blocks of each rank
   end type partition_type

   !> The subdomain of one process.
   type, public :: subdomain_type
      integer :: dimension = 0
      integer :: n_blocks = 0                 !! of all processes
      integer :: n_own = 0
      integer :: first = 0                    !! first own block, from 0
      type(model_type) :: model               !! the elements on renumbered nodes; no other component is set
      integer, allocatable  :: block(:)       !! (nodes of MODEL)
      logical, allocatable  :: held(:, :)     !! (dimension, nodes of MODEL)
      logical, allocatable  :: held_own(:, :) !! (dimension, own blocks)
      integer, allocatable  :: inside(:), outside(:) !! (own blocks) neighbours inside this process, itself included, and outside
      real(wp), allocatable :: motions(:, :, :) !! (dimension, motions, own blocks) as motions_of gives them
   end type subdomain_type

   type, public :: touched_type
      integer :: n = 0
      integer, allocatable :: row(:), column(:)   !! (n) blocks from 0, ascending by row, then by column
      integer, allocatable :: first(:)             !! (blocks + 1) rows first(b + 1) to first(b + 2) - 1 belong to block b
      integer, allocatable :: counts(:)            !! (ranks) rows of each rank
   end type touched_type

contains

   !> Partition the nodes that have unknowns.
   subroutine partition_nodes(model, graph, parts, ok)
      type(model_type), intent(in)      :: model
      type(node_graph_type), intent(in) :: graph
      type(partition_type), intent(out) :: parts
      logical, intent(out)              :: ok
      integer, allocatable :: first(:)
      integer :: i

      call part_by_metis(graph, n_ranks, parts%owner, ok)
      if (.not. ok) return
      where (.not. model%freedoms%used) parts%owner = -1
      call list_owners(n_ranks, reshape(parts%owner + 1, [1, model%mesh%n_nodes]), first, parts%order)
      parts%counts = first(2:) - first(:n_ranks)
      allocate (parts%block(model%mesh%n_nodes), source=-1)
      parts%block(parts%order) = [(i - 1, i = 1, size(parts%order))]
   end subroutine partition_nodes

   !> The subdomain of process R.
   subroutine subdomain_of(model, graph, parts, r, subdomain)
      type(model_type), intent(in)      :: model
      type(node_graph_type), intent(in) :: graph
      type(partition_type), intent(in)  :: parts
      integer, intent(in)               :: r
      type(subdomain_type), intent(out) :: subdomain
      integer, allocatable :: mine(:), nodes(:)
      integer :: b, e, node

      subdomain%dimension = model%mesh%dimension
      subdomain%n_blocks = size(parts%order)
      subdomain%n_own = parts%counts(r + 1)
      subdomain%first = sum(parts%counts(:r))
      associate (d => model%mesh%dimension, n => subdomain%n_own)
         allocate (subdomain%held_own(d, n), subdomain%motions(d, n_motions(d), n), subdomain%inside(n), subdomain%outside(n))
      end associate
      do b = 1, subdomain%n_own
         node = parts%order(subdomain%first + b)
         subdomain%held_own(:, b) = model%freedoms%held(:, node)
         subdomain%motions(:, :, b) = motions_of(model, node)
         associate (owners => parts%owner(graph%neighbours(graph%first(node):graph%first(node + 1) - 1)))
            subdomain%inside(b) = 1 + count(owners == r)
            subdomain%outside(b) = count(owners >= 0 .and. owners /= r)
         end associate
      end do
      ! elements whose nodes have their own unknowns in global axes; rank 0 forms the other elements
      mine = pack([(e, e = 1, model%mesh%n_elements)], parts%owner(model%mesh%element_nodes(1, :)) == r)
      mine = pack(mine, [(.not. is_entangled(model, mine(e)), e = 1, size(mine))])
      nodes = nodes_of_elements(model, mine)
      call extract(model, mine, nodes, subdomain%model)
      subdomain%block = parts%block(nodes)
      subdomain%held = model%freedoms%held(:, nodes)
   end subroutine subdomain_of

   !> Whether element E has nodes that depend on others, have local axes, lie on a bolt section, or have rotations.
   pure logical function is_entangled(model, e)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e

      is_entangled = section_node(model%mesh, e) > 0 .or. is_shell(model%mesh, e) .or. is_beam(model%mesh, e)
      if (.not. is_entangled) is_entangled = is_coupled(model%freedoms, element_points(model%mesh, e))
   end function is_entangled

   !> Send SUBDOMAIN from rank 0 to process R.
   subroutine pass_subdomain(r, subdomain)
      integer, intent(in)                 :: r
      type(subdomain_type), intent(inout) :: subdomain

      call pass(r, subdomain%dimension, subdomain%n_blocks, subdomain%n_own, subdomain%first)
      call pass_part(r, subdomain%model)
      associate (d => subdomain%dimension, nodes => subdomain%model%mesh%n_nodes, own => subdomain%n_own)
         if (rank /= 0) then
            allocate (subdomain%block(nodes), subdomain%held(d, nodes), subdomain%held_own(d, own), subdomain%inside(own), &
                      subdomain%outside(own), subdomain%motions(d, n_motions(d), own))
         end if
      end associate
      call pass(r, subdomain%block, subdomain%held, subdomain%held_own, subdomain%inside, subdomain%outside, subdomain%motions)
   end subroutine pass_subdomain

   !> Send the components of PART that extract of body_parts sets from rank 0 to process R.
   subroutine pass_part(r, part)
      integer, intent(in)             :: r
      type(model_type), intent(inout) :: part
      integer :: n_corners, n_properties

      if (rank == 0) then
         n_corners = size(part%mesh%element_nodes, 1)
         n_properties = size(part%mesh%properties)
      end if
      call pass(r, part%mesh%dimension, part%mesh%n_elements, part%mesh%n_nodes, n_corners, n_properties)
      if (rank /= 0) then
         call start_parts(part)
         deallocate (part%mesh%properties)
         allocate (part%mesh%element_kind(part%mesh%n_elements), part%mesh%element_property(part%mesh%n_elements), &
            part%mesh%x(3, part%mesh%n_nodes), &
                   part%mesh%element_nodes(n_corners, part%mesh%n_elements), part%mesh%properties(n_properties))
      end if
      call pass(r, part%mesh%element_kind, part%mesh%element_property, part%mesh%element_nodes, part%mesh%x, part%mesh%properties)
   end subroutine pass_part

   !> The touched blocks of the interface ELEMENTS, on unknowns, of the bars and of the bolt sections of MODEL.
   subroutine list_touched(model, graph, parts, elements, touched)
      type(model_type), intent(in)        :: model
      type(node_graph_type), intent(in)   :: graph
      type(partition_type), intent(in)    :: parts
      type(interface_element), intent(in) :: elements(:)
      type(touched_type), intent(out)     :: touched
      integer, allocatable :: by_column(:), by_row(:), pairs(:, :), rows(:)
      logical, allocatable :: is_new(:)
      integer :: i, k, n, pass

      do pass = 1, 2 ! count, then fill
         n = 0
         do i = 1, size(elements)
            call pair(elements(i)%node)
         end do
         do i = 1, n_bars(model%mesh)
            call pair(unknown_nodes(model%freedoms, bar_nodes(model%mesh%bars(i))))
         end do
         do i = 1, n_sections(model%mesh)
            associate (node => model%mesh%sections(i)%node)
               do k = graph%first(node), graph%first(node + 1) - 1
                  call pair([node, graph%neighbours(k)])
               end do
            end associate
         end do
         if (pass == 1) allocate (pairs(2, n))
      end do

      ! the distinct pairs, sorted by row and then by column
      call sorted_order(pairs(2, :), by_column)
      call sorted_order(pairs(1, by_column), by_row)
      pairs = pairs(:, by_column(by_row))
      allocate (is_new(size(pairs, 2)), source=.true.)
      is_new(2:) = any(pairs(:, 2:) /= pairs(:, :size(is_new) - 1), dim=1)
      touched%n = count(is_new)
      touched%row = pack(pairs(1, :), is_new)
      touched%column = pack(pairs(2, :), is_new)
      call list_owners(size(parts%order), reshape(touched%row + 1, [1, touched%n]), touched%first, rows)
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

   !> Add the symmetric matrix K between ROWS of the matrix to VALUES of the touched blocks.
   pure subroutine add_touched(touched, rows, k, values)
      type(touched_type), intent(in) :: touched
      integer, intent(in)            :: rows(:)         !! from 1; 0: none
      real(wp), intent(in)           :: k(:, :)         !! [force/length]
      real(wp), intent(inout)        :: values(:, :, :) !! (dimension, dimension, n) [force/length]
      integer :: b(size(rows)), c(size(rows)), i, j, place

      b = (rows - 1)/size(values, 1)
      c = rows - size(values, 1)*b
      do j = 1, size(rows)
         if (rows(j) == 0) cycle
         do i = 1, size(rows)
            if (rows(i) == 0) cycle
            associate (first => touched%first(b(i) + 1), behind => touched%first(b(i) + 2)) ! of the blocks in this row
               place = first - 1 + first_not_below(touched%column(first:behind - 1), b(j))
            end associate
            values(c(i), c(j), place) = values(c(i), c(j), place) + k(i, j)
         end do
      end do
   end subroutine add_touched

end module partition
