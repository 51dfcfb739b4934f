!> Nested dissection of a node graph by METIS 5.1 (Karypis, Kumar, SIAM J. Sci. Comput. 20 (1998) 359-392).
module nested_dissection
   use, intrinsic :: iso_c_binding, only: c_int32_t, c_null_ptr, c_ptr
   use node_graph, only: node_graph_type
   implicit none
   private

   public :: dissect

   integer, parameter :: n_options = 40         ! METIS_NOPTIONS
   integer, parameter :: metis_ok = 1           ! METIS_OK

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
   end interface

contains

   !> ORDER(k) is the k-th node to be eliminated, of those with TAKEN(node): the others are left out of the graph.
   !! OK is false where METIS has not the memory.
   subroutine dissect(graph, taken, order, ok)
      type(node_graph_type), intent(in)  :: graph
      logical, intent(in)                :: taken(:)
      integer, allocatable, intent(out)  :: order(:)
      logical, intent(out)               :: ok
      integer(c_int32_t), allocatable :: first(:), neighbours(:), old_of_new(:), new_of_old(:)
      integer(c_int32_t) :: options(n_options)
      integer, allocatable :: number(:), node_of(:)
      integer :: i, k, n, m, status

      allocate (number(graph%n), node_of(count(taken)))
      number = -1
      n = 0
      do i = 1, graph%n
         if (.not. taken(i)) cycle
         number(i) = n
         n = n + 1
         node_of(n) = i
      end do
      allocate (first(n + 1), neighbours(size(graph%neighbours)), old_of_new(n), new_of_old(n))
      m = 0
      do i = 1, n
         first(i) = m
         do k = graph%first(node_of(i)), graph%first(node_of(i) + 1) - 1
            if (number(graph%neighbours(k)) < 0) cycle
            m = m + 1
            neighbours(m) = number(graph%neighbours(k))
         end do
      end do
      first(n + 1) = m
      ok = .true.
      if (n > 1) then
         status = metis_set_default_options(options)
         ok = metis_node_nd(n, first, neighbours, c_null_ptr, options, old_of_new, new_of_old) == metis_ok
      else
         old_of_new = 0
      end if
      if (ok) order = node_of(old_of_new + 1)
   end subroutine dissect

end module nested_dissection
