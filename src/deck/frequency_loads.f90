!> Loads as functions of frequency: what the cards RLOAD1, RLOAD2, DAREA, LSEQ and TABLED1 to TABLED4 say, and the value of a load at
!! a frequency.
!! Source: MSC Nastran Quick Reference Guide, RLOAD1, RLOAD2, TABLED1 to TABLED4.
module frequency_loads
   use kinds, only: wp
   implicit none
   private

   public :: interpolated, table_value, load_at

   real(wp), parameter :: pi = acos(-1.0_wp)

   !> TABLED1 to TABLED4. Kinds 1 to 3: points (x, y) in ascending order, kind 4: coefficients y of the powers of x. KIND 0: the
   !! constant y.
   type, public :: tabled_card
      integer  :: line = 0, id = 0
      integer  :: kind = 0
      logical  :: is_log(2) = .false.              !! of kind 1: axis x, axis y
      real(wp) :: shift = 0.0_wp, scale = 1.0_wp   !! X1, X2: the argument is (f - shift)/scale
      real(wp) :: ends(2) = 0.0_wp                 !! X3, X4 of kind 4
      real(wp), allocatable :: x(:), y(:)
   end type tabled_card

   !> RLOAD1: A (C + i D) e**(i (theta - 2 pi f tau)). RLOAD2: A B e**(i (phi + theta - 2 pi f tau)).
   type, public :: rload_card
      integer  :: line = 0, id = 0, excite = 0
      logical  :: is_polar = .false.               !! RLOAD2
      integer  :: tables(2) = 0                    !! TC and TD, TB and TP; 0: CONSTANTS
      real(wp) :: constants(2) = 0.0_wp
      real(wp) :: delay = 0.0_wp                   !! tau [time]
      real(wp) :: phase = 0.0_wp                   !! theta [degrees]
      integer  :: motion = 0                       !! A is a force (0), displacement (1), velocity (2), acceleration (3)
   end type rload_card

   !> DAREA: a force or moment VALUE along a component of a node.
   type, public :: darea_card
      integer  :: line = 0, set = 0, node = 0, component = 0
      integer  :: field = 0                        !! data field of NODE
      real(wp) :: value = 0.0_wp
   end type darea_card

   !> LSEQ: the load set LOAD stands for EXCITE of RLOAD cards.
   type, public :: lseq_card
      integer :: line = 0, set = 0, excite = 0, load = 0
   end type lseq_card

   !> The complex factor of a load: that of an RLOAD with its tables, times SCALE; without an RLOAD 1.
   type, public :: load_law
      real(wp) :: scale = 1.0_wp
      type(rload_card) :: card
      type(tabled_card), allocatable :: tables(:)  !! (2) not allocated: no RLOAD
   end type load_law

   !> These cards of a deck.
   type, public :: response_cards_type
      type(tabled_card), allocatable :: tabled(:)
      type(rload_card), allocatable  :: rload(:)
      type(darea_card), allocatable  :: darea(:)
      type(lseq_card), allocatable   :: lseq(:)
   end type response_cards_type

contains

   !> The value at AT of the lines between points, the first and the last extrapolated; at a jump, a repeated X, the mean.
   pure real(wp) function interpolated(x, y, at) result(value)
      real(wp), intent(in) :: x(:), y(:) !! ascending, two points or more
      real(wp), intent(in) :: at
      integer :: k

      k = min(max(count(x <= at), 1), size(x) - 1) ! the point before, but not the last
      if (k > 1 .and. abs(x(k) - at) <= 0.0_wp) then
         value = y(k)
         if (abs(x(k - 1) - at) <= 0.0_wp) value = 0.5_wp*(y(k - 1) + y(k))
      else
         value = y(k) + (at - x(k))*(y(k + 1) - y(k))/(x(k + 1) - x(k))
      end if
   end function interpolated

   !> The value of TABLE at a FREQUENCY. On a logarithmic axis the straight line is in the logarithms.
   pure real(wp) function table_value(table, frequency) result(value)
      type(tabled_card), intent(in) :: table
      real(wp), intent(in)          :: frequency !! [1/time]
      real(wp), allocatable :: x(:), y(:)
      real(wp) :: at
      integer  :: k

      at = (frequency - table%shift)/table%scale
      select case (table%kind)
      case (0)
         value = table%y(1)
      case (4)
         at = (min(max(frequency, table%ends(1)), table%ends(2)) - table%shift)/table%scale
         value = 0.0_wp
         do k = size(table%y), 1, -1
            value = value*at + table%y(k)
         end do
      case default
         x = table%x
         y = table%y
         if (table%is_log(1)) then
            if (at <= 0.0_wp) at = x(1)
            x = log(x)
            at = log(at)
         end if
         if (table%is_log(2)) y = log(y)
         value = interpolated(x, y, at)
         if (table%is_log(2)) value = exp(value)
      end select
   end function table_value

   !> The factor of a load of LAW at a FREQUENCY.
   pure complex(wp) function load_at(law, frequency) result(factor)
      type(load_law), intent(in) :: law
      real(wp), intent(in)       :: frequency !! [1/time]
      real(wp) :: angle, value(2)

      factor = law%scale
      if (.not. allocated(law%tables)) return
      value = [table_value(law%tables(1), frequency), table_value(law%tables(2), frequency)]
      angle = law%card%phase*pi/180.0_wp - 2.0_wp*pi*frequency*law%card%delay
      if (law%card%is_polar) then
         angle = angle + value(2)*pi/180.0_wp
         factor = law%scale*value(1)
      else
         factor = law%scale*cmplx(value(1), value(2), wp)
      end if
      if (abs(angle) > 0.0_wp) factor = factor*exp(cmplx(0.0_wp, angle, wp))
   end function load_at

end module frequency_loads
