!> Counts the interface elements of a joint that are beyond a bound of its shear law, for the warnings of a stage.
module range_tally
   use kinds, only: wp
   use restart_stream, only: restart_stream_type
   implicit none
   private

   public :: record_tallies

   !> Elements of a joint beyond a bound of its shear law in the stage so far.
   type, public :: tally_type
      integer  :: n = 0
      integer  :: node = 0, increment = 0          ! of the first element
      integer  :: worst_node = 0
      real(wp) :: p = 0.0_wp, d = 0.0_wp           ! of the worst element
      real(wp) :: excess = 0.0_wp                  ! its p or d beyond the bound
      real(wp) :: bound = 0.0_wp
   end type tally_type

contains

   !> Write the tallies of a joint to a restart file, or read them.
   subroutine record_tallies(stream, tallies)
      type(restart_stream_type), intent(inout) :: stream
      type(tally_type), intent(inout)          :: tallies(:)

      call stream%part('tally_type', 1)
      call stream%item('n', tallies%n)
      call stream%item('node', tallies%node)
      call stream%item('increment', tallies%increment)
      call stream%item('worst_node', tallies%worst_node)
      call stream%item('p', tallies%p)
      call stream%item('d', tallies%d)
      call stream%item('excess', tallies%excess)
      call stream%item('bound', tallies%bound)
   end subroutine record_tallies

end module range_tally
