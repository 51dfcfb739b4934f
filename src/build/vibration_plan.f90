!> What is asked about the natural oscillation of the structure after a stage: which modes, and the response to a load that
!! oscillates. Types, and the damping that a table gives.
module vibration_plan
   use kinds, only: wp
   implicit none
   private

   public :: loss_at

   real(wp), parameter :: critical_quality = 0.5_wp ! Q of critical damping

   !> TABDMP1: damping over frequency, two points or more in ascending order. Where a frequency stands twice the value jumps.
   type, public :: damping_table
      character(8) :: kind = 'G'              !! G: structural damping g; CRIT: share of critical damping; Q: dynamic amplification
      real(wp), allocatable :: frequency(:)   !! [1/time]
      real(wp), allocatable :: value(:)       !! likewise, of the KIND [-]
   end type damping_table

   !> The answer to a load that oscillates, by superposition of the modes.
   type, public :: response_plan
      real(wp), allocatable :: frequencies(:) !! ascending [1/time]
      integer, allocatable  :: nodes(:)       !! positions of the nodes whose amplitude and phase are asked
      real(wp), allocatable :: force(:, :)    !! (3, n_nodes) amplitude of the load [force]
      type(damping_table), allocatable :: damping !! not allocated: the joints' own loss factors
   end type response_plan

   !> MODES of a stage.
   type, public :: vibration_plan_type
      integer  :: id = 0                      !! of the EIGRL
      logical  :: free = .false.              !! the supports are let go
      integer  :: most = 0                    !! modes, from the lowest of the range on; 0: all of the range, which has an end
      logical  :: has_lowest = .false., has_highest = .false.
      real(wp) :: lowest = 0.0_wp             !! V1, > 0 where the range has a beginning [1/time]
      real(wp) :: highest = 0.0_wp            !! V2 [1/time]
      logical  :: unit_mass = .true.          !! shapes have generalised mass 1; else largest component 1
      logical  :: on_loading = .false.        !! STIFFNESS = LOAD
      real(wp) :: amplitude = 0.0_wp          !! largest displacement for the loss factors of the joints [length]; 0: none
      type(response_plan), allocatable :: response
   end type vibration_plan_type

contains

   !> Structural damping g [-] at FREQUENCY, as NASTRAN looks TABDMP1 up: straight lines between the points, before and behind them
   !! those of the two outermost; where the value jumps, the mean. G: g = value; CRIT: g = 2 value; Q: g = 1/value. A line that is
   !! prolonged ends at no damping (G, CRIT) or at critical damping, or the least Q given (Q): damping has a sign.
   !! Source: MSC Nastran Quick Reference Guide, TABDMP1, remarks.
   pure real(wp) function loss_at(table, frequency) result(g)
      type(damping_table), intent(in) :: table
      real(wp), intent(in)            :: frequency !! [1/time]
      real(wp) :: value
      integer  :: k, n

      n = size(table%frequency)
      associate (f => table%frequency, v => table%value)
         k = min(max(count(f <= frequency), 1), n - 1) ! the point before, but never the last
         if (k > 1 .and. abs(f(k) - frequency) <= 0.0_wp) then
            value = v(k)
            if (abs(f(k - 1) - frequency) <= 0.0_wp) value = 0.5_wp*(v(k - 1) + v(k))
         else
            value = v(k) + (frequency - f(k))*(v(k + 1) - v(k))/(f(k + 1) - f(k))
         end if
         select case (table%kind)
         case ('CRIT')
            g = 2.0_wp*max(value, 0.0_wp)
         case ('Q')
            g = 1.0_wp/max(value, min(critical_quality, minval(v)))
         case default
            g = max(value, 0.0_wp)
         end select
      end associate
   end function loss_at

end module vibration_plan
