!> What is asked about the natural oscillation of the structure after a stage: which modes, and the response to a load that
!! oscillates. Types, and the damping that a table gives.
module vibration_plan
   use kinds, only: wp
   implicit none
   private

   public :: loss_at, asked_frequencies, merged

   real(wp), parameter :: critical_quality = 0.5_wp ! Q of critical damping
   real(wp), parameter :: same_frequency = 1.0e-9_wp ! of the largest: what is nearer is one

   !> TABDMP1: damping over frequency, two points or more in ascending order. Where a frequency stands twice the value jumps.
   type, public :: damping_table
      character(8) :: kind = 'G'              !! G: structural damping g; CRIT: share of critical damping; Q: dynamic amplification
      real(wp), allocatable :: frequency(:)   !! [1/time]
      real(wp), allocatable :: value(:)       !! likewise, of the KIND [-]
   end type damping_table

   !> FREQ4: N frequencies, an odd number, from 1 - SHARE to 1 + SHARE times that of every mode from LOWEST to HIGHEST.
   type, public :: frequency_spread
      real(wp) :: lowest = 0.0_wp, highest = 0.0_wp !! [1/time]
      real(wp) :: share = 0.0_wp
      integer  :: n = 0
   end type frequency_spread

   !> The answer to a load that oscillates, by superposition of the modes.
   type, public :: response_plan
      real(wp), allocatable :: frequencies(:) !! ascending, those of FREQ1 [1/time]
      type(frequency_spread), allocatable :: spreads(:) !! those of FREQ4
      integer, allocatable  :: nodes(:)       !! positions of the nodes whose amplitude and phase are asked
      real(wp), allocatable :: force(:, :)    !! (3, n_nodes) amplitude of the load [force]
      type(damping_table), allocatable :: damping !! not allocated: the joints' own loss factors
      logical :: is_structural = .false.      !! KDAMP = -1: it is structural damping
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
      real(wp) :: damping = 0.0_wp            !! PARAM G, structural damping of everything [-]
      logical  :: has_losses = .false.        !! modes have loss factors: by an amplitude, PARAM G or GE
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

   !> The frequencies of PLAN, ascending, each once, those about the MODES, whose frequencies ascend, among them [1/time]. A motion
   !! without strain has nothing to spread about.
   pure function asked_frequencies(plan, modes) result(f)
      type(response_plan), intent(in) :: plan
      real(wp), intent(in)            :: modes(:) !! [1/time]
      real(wp), allocatable :: f(:)
      integer :: i, k, m

      f = plan%frequencies
      do i = 1, size(plan%spreads)
         associate (spread => plan%spreads(i))
            do m = 1, size(modes)
               if (modes(m) <= 0.0_wp .or. modes(m) < spread%lowest .or. modes(m) > spread%highest) cycle
               if (spread%n == 1) f = merged(f, [modes(m)])
               if (spread%n > 1) f = merged(f, [(modes(m)*(1.0_wp + spread%share*real(2*k - spread%n + 1, wp)/ &
                                                           real(spread%n - 1, wp)), k = 0, spread%n - 1)])
            end do
         end associate
      end do
   end function asked_frequencies

   !> Two ascending lists as one, each frequency once.
   pure function merged(a, b) result(f)
      real(wp), intent(in)  :: a(:), b(:)
      real(wp), allocatable :: f(:)
      real(wp) :: c(size(a) + size(b))
      logical  :: take_a
      integer  :: i, j, k

      i = 1
      j = 1
      do k = 1, size(c)
         take_a = j > size(b)
         if (.not. take_a .and. i <= size(a)) take_a = a(i) <= b(j)
         if (take_a) then
            c(k) = a(i)
            i = i + 1
         else
            c(k) = b(j)
            j = j + 1
         end if
      end do
      f = c
      if (size(c) > 1) f = pack(c, [.true., c(2:) - c(:size(c) - 1) > same_frequency*c(size(c))])
   end function merged

end module vibration_plan
