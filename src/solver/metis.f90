!> METIS 5.1: fill-reducing orders of a graph, and separators that cut it in parts.
!! Source: Karypis, Kumar, SIAM J. Sci. Comput. 20 (1998) 359-392.
module metis
   use, intrinsic :: iso_c_binding, only: c_int32_t, c_null_ptr, c_ptr
   use node_graph, only: node_graph_type
   implicit none
   private

   public :: order_by_metis, separate_by_metis, part_by_metis

   integer, parameter :: n_options = 40         ! METIS_NOPTIONS
   integer, parameter :: compress = 13          ! METIS_OPTION_COMPRESS, from 1 on
   integer, parameter :: metis_ok = 1           ! METIS_OK
   integer, parameter :: words = 8              ! of a node or a link that METIS is given room for

   interface
      integer(c_int32_t) function metis_set_default_options(options) bind(c, name='METIS_SetDefaultOptions')
         import :: c_int32_t
         integer(c_int32_t), intent(out) :: options(*)
      end function metis_set_default_options

      integer(c_int32_t) function metis_node_nd(n, first, neighbours, weights, options, old_of_new, new_of_old) &
         bind(c, name='METIS_NodeND')
         import :: c_int32_t, c_ptr
         integer(c_int32_t), intent(in)    :: n
         integer(c_int32_t), intent(in)    :: first(*), neighbours(*)  !! from 0 on
         type(c_ptr), value                :: weights
         integer(c_int32_t), intent(in)    :: options(*)
         integer(c_int32_t), intent(out)   :: old_of_new(*), new_of_old(*)
      end function metis_node_nd

      integer(c_int32_t) function metis_node_ndp(n, first, neighbours, weights, parts, options, old_of_new, new_of_old, sizes) &
         bind(c, name='METIS_NodeNDP')
         import :: c_int32_t, c_ptr
         integer(c_int32_t), value         :: n
         integer(c_int32_t), intent(in)    :: first(*), neighbours(*)  !! from 0 on
         type(c_ptr), value                :: weights
         integer(c_int32_t), value         :: parts
         integer(c_int32_t), intent(in)    :: options(*)
         integer(c_int32_t), intent(out)   :: old_of_new(*), new_of_old(*)
         integer(c_int32_t), intent(inout) :: sizes(*)   !! (2 parts - 1) of leaves and separators, the root last
      end function metis_node_ndp

      integer(c_int32_t) function metis_part_kway(n, constraints, first, neighbours, weights, sizes, link_weights, parts, shares, &
                                                  imbalance, options, cut, part) bind(c, name='METIS_PartGraphKway')
         import :: c_int32_t, c_ptr
         integer(c_int32_t), intent(in)  :: n, constraints
         integer(c_int32_t), intent(in)  :: first(*), neighbours(*)  !! from 0 on
         type(c_ptr), value              :: weights, sizes, link_weights, shares, imbalance
         integer(c_int32_t), intent(in)  :: parts
         integer(c_int32_t), intent(in)  :: options(*)
         integer(c_int32_t), intent(out) :: cut, part(*)
      end function metis_part_kway
   end interface

contains

   !> ORDER(k) is the k-th node of GRAPH to be eliminated, by nested dissection. OK is false where METIS has not the memory.
   subroutine order_by_metis(graph, order, ok)
      type(node_graph_type), intent(in) :: graph
      integer, allocatable, intent(out) :: order(:)
      logical, intent(out)              :: ok
      integer(c_int32_t) :: old_of_new(graph%n), new_of_old(graph%n), options(n_options)
      integer :: status

      ok = .true.
      if (graph%n > 1) then
         status = metis_set_default_options(options)
         ok = metis_node_nd(graph%n, graph%first - 1, graph%neighbours - 1, c_null_ptr, options, old_of_new, &
                            new_of_old) == metis_ok
      else
         old_of_new = 0
      end if
      if (ok) order = old_of_new + 1
   end subroutine order_by_metis

   !> Cut GRAPH by separators into N_PARTS, a power of 2: PLACE of every node in the tree of nested_dissection; all in place 1
   !! where METIS does not say which nodes the separators are. OK is false where there is not the memory: METIS would end the
   !! program.
   subroutine separate_by_metis(graph, n_parts, place, ok)
      type(node_graph_type), intent(in) :: graph
      integer, intent(in)               :: n_parts
      integer, allocatable, intent(out) :: place(:) !! (graph%n)
      logical, intent(out)              :: ok
      integer(c_int32_t) :: old_of_new(graph%n), new_of_old(graph%n), sizes(2*n_parts - 1), options(n_options)
      integer, allocatable :: room(:, :)
      integer :: n, status

      allocate (room(words, graph%n + size(graph%neighbours)), stat=status)
      ok = status == 0
      if (.not. ok) return
      deallocate (room)
      status = metis_set_default_options(options)
      options(compress) = 0   ! sizes would count what is left of the nodes
      sizes = 0
      ok = metis_node_ndp(graph%n, graph%first - 1, graph%neighbours - 1, c_null_ptr, n_parts, options, old_of_new, new_of_old, &
                          sizes) == metis_ok
      if (.not. ok) return
      allocate (place(graph%n), source=1)
      if (sum(sizes) /= graph%n) return
      n = 0
      call hand_out(1)

   contains

      !> The nodes of the subtree of place TOP: METIS orders its second half first, the separator last.
      recursive subroutine hand_out(top)
         integer, intent(in) :: top

         if (top < n_parts) then
            call hand_out(2*top + 1)
            call hand_out(2*top)
         end if
         associate (m => sizes(2*n_parts - top))
            place(old_of_new(n + 1:n + m) + 1) = top
            n = n + m
         end associate
      end subroutine hand_out

   end subroutine separate_by_metis

   !> PART, 0 to N_PARTS - 1, of every node of GRAPH: parts of like size with few links between them. OK as above.
   subroutine part_by_metis(graph, n_parts, part, ok)
      type(node_graph_type), intent(in) :: graph
      integer, intent(in)               :: n_parts
      integer, allocatable, intent(out) :: part(:) !! (graph%n)
      logical, intent(out)              :: ok
      integer(c_int32_t) :: cut, options(n_options)
      integer, allocatable :: room(:, :)
      integer :: status

      allocate (part(graph%n), source=0)
      ok = .true.
      if (n_parts == 1 .or. graph%n < n_parts) return
      allocate (room(words, graph%n + size(graph%neighbours)), stat=status)
      ok = status == 0
      if (.not. ok) return
      deallocate (room)
      status = metis_set_default_options(options)
      ok = metis_part_kway(graph%n, 1, graph%first - 1, graph%neighbours - 1, c_null_ptr, c_null_ptr, c_null_ptr, n_parts, &
                           c_null_ptr, c_null_ptr, options, cut, part) == metis_ok
   end subroutine part_by_metis

end module metis
