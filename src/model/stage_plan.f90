!> Stages of the load history, fractions of their increments, and requests for the vibration after a stage.
!! Case control and JINCR cards give them: modes, response to an oscillating load, and the damping of a table.
module stage_plan
   use bulk_data, only: eigrl_card, frequency_card, jampl_card, tabdmp1_card
   use control_words, only: method_back, method_newton, method_step
   use frequency_loads, only: interpolated, load_law
   use kinds, only: wp
   use stage_entries, only: output_all, output_last, output_request
   use text_tools, only: integer_text
   use tolerances, only: least_component, same_frequency
   implicit none
   private

   public :: between, force_between
   public :: loss_at, asked_frequencies, merged, stage_name, where_in_plan, factorisations_of, solves_once, &
             has_unloading_modes, shows_bodies

   real(wp), parameter :: critical_quality = 0.5_wp ! Q of critical damping

   character(4), parameter, public :: pair_names(4) = ['LINE', 'X   ', 'Y   ', 'Z   ']

   !> Two nodes of WATCH: the movement of LAST less that of FIRST, along the line from FIRST to LAST and the axes CD of FIRST.
   type, public :: node_pair
      integer  :: first = 0, last = 0         !! positions
      integer  :: ids(2) = 0                  !! their numbers, as the deck has them
      real(wp) :: along(3, 4) = 0.0_wp        !! unit vectors; 0: a line between nodes at one place, z of a plane model
   end type node_pair

   !> A load that oscillates: the pattern FORCE, or with LAW%CARD%MOTION the movements MOVED of supports, times the factor of LAW.
   type, public :: wave_type
      type(load_law) :: law
      real(wp), allocatable :: force(:, :)    !! (3, n_nodes) [force]
      real(wp), allocatable :: moved(:, :)    !! (dimension, n_nodes) of held unknowns; not allocated: none is moved
   end type wave_type

   !> The response to an oscillating load by modal superposition.
   type, public :: response_plan
      real(wp), allocatable :: frequencies(:) !! ascending, those of FREQ1 [1/time]
      type(frequency_card), allocatable :: spreads(:) !! FREQ3, FREQ4 (n is odd), FREQ5
      integer, allocatable  :: nodes(:)       !! positions of the nodes whose amplitude and phase are requested
      type(node_pair), allocatable :: pairs(:) !! and of one node against another
      type(wave_type), allocatable :: waves(:) !! the load is their sum
      logical :: is_direct = .false.          !! SOL 108
      type(tabdmp1_card), allocatable :: damping !! not allocated: the loss factors of the joints
      logical :: is_structural = .false.      !! KDAMP = -1: as structural damping
   end type response_plan

   !> BACKBONE of a stage: one mode is followed through loops of increasing amplitude, as its JAMPL says. NODE is the position of
   !! the node whose displacement is the amplitude, 0: the node that moves most.
   type, extends(jampl_card), public :: backbone_plan
      real(wp), allocatable :: amplitudes(:)  !! ascending [length]
   end type backbone_plan

   !> MODES of a stage.
   !! The range of its EIGRL: MOST is the number of modes from the lowest of the range on (0: all up to its end); LOWEST > 0 where
   !! the range has a beginning. UNIT_MASS: shapes have generalised mass 1; else their largest component is 1.
   type, extends(eigrl_card), public :: vibration_plan_type
      logical  :: free = .false.              !! without supports
      logical  :: on_loading = .false.        !! STIFFNESS = LOAD
      real(wp) :: amplitude = 0.0_wp          !! largest displacement for the loss factors of the joints [length]; 0: none
      real(wp) :: damping = 0.0_wp            !! PARAM G, structural damping of the whole structure [-]
      logical  :: has_losses = .false.        !! modes have loss factors: from an amplitude, PARAM G or GE
      type(backbone_plan), allocatable :: backbone
      type(response_plan), allocatable :: response
   end type vibration_plan_type

   type, public :: planned_stage
      integer :: id = 0
      integer :: from = 0                   !! number of the stage that FROM names, 0: none
      integer :: begins_at = 0              !! position of the stage from whose end it starts, 0: the structure at rest
      integer :: supports = 1               !! which of the freedoms of the model it has
      integer, allocatable  :: parts(:)     !! SUBCOM: positions of the stages that it combines; not allocated: no SUBCOM
      real(wp), allocatable :: factors(:)   !! likewise
      character(:), allocatable :: label
      type(output_request) :: output
      logical, allocatable :: shown(:)      !! nodes to which its tables are limited; not allocated: all
      integer, allocatable :: watched(:)    !! positions of the nodes of WATCH; not allocated: none
      type(node_pair), allocatable :: pairs(:) !! those of WATCH; allocated where WATCHED is
      character(:), allocatable :: shown_words !! text of this limit, behind a title
      real(wp), allocatable :: fractions(:)    !! of the load change of the stage, one per increment, sum 1
      logical :: follows_path = .false.        !! NEWTON divides its increment so that the parts follow the path
      character(:), allocatable :: path        !! words for its load where this is not that of the stage, as in loops
      type(vibration_plan_type), allocatable :: vibration !! after the stage; not allocated: not requested
   end type planned_stage

   type, public :: stage_plan_type
      type(planned_stage), allocatable :: stages(:)
      logical :: measures_path = .false.      !! NEWTON: increments are printed with their error of path
      logical :: is_independent = .false.     !! linear: every stage starts from rest
      integer, allocatable :: first_with(:)   !! position of the first stage with each of the freedoms of the model
      ! whether any stage has
      logical :: has_modes = .false.          !! natural modes
      logical :: has_backbones = .false.      !! a backbone
      logical :: has_responses = .false.      !! the response to an oscillating load
      logical :: has_watched_nodes = .false.  !! nodes of WATCH
      logical :: has_pairs = .false.          !! pairs of them
   end type stage_plan_type

contains

   !> The movement of PAIR along its directions, from the displacements U of all nodes.
   pure function between(pair, u) result(moved)
      type(node_pair), intent(in) :: pair
      real(wp), intent(in)        :: u(:, :) !! (dimension, nodes)
      real(wp) :: moved(4)
      integer  :: c

      moved = 0.0_wp
      do c = 1, size(u, 1)
         moved = moved + (u(c, pair%last) - u(c, pair%first))*pair%along(c, :)
      end do
   end function between

   !> The force between the nodes of PAIR along its directions, from the forces F on all nodes: positive where it moves them apart.
   !! It is the mean of the forces on both nodes, or the force on one of them where the other has none above FLOOR. Small components
   !! of it are zero.
   pure function force_between(pair, f, floor) result(force)
      type(node_pair), intent(in) :: pair
      real(wp), intent(in)        :: f(:, :) !! (dimension, nodes)
      real(wp), intent(in)        :: floor
      real(wp) :: force(4), first(4), last(4)
      integer  :: c

      first = 0.0_wp
      last = 0.0_wp
      do c = 1, size(f, 1)
         first = first + f(c, pair%first)*pair%along(c, :)
         last = last + f(c, pair%last)*pair%along(c, :)
      end do
      force = last - first
      where (min(abs(first), abs(last)) > floor) force = 0.5_wp*force
      where (abs(force) <= max(floor, least_component*norm2(force(2:)))) force = 0.0_wp
   end function force_between

   !> Structural damping g [-] at FREQUENCY, by the rules of NASTRAN for TABDMP1: linear interpolation, extrapolation of the first
   !! and the last line, the mean at a jump. G: g = value; CRIT: g = 2 value; Q: g = 1/value. An extrapolated line is limited at
   !! zero damping (G, CRIT), or at critical damping or the smallest Q given (Q), because damping must not be negative.
   !! Source: MSC Nastran Quick Reference Guide, TABDMP1, remarks.
   pure real(wp) function loss_at(table, frequency) result(g)
      type(tabdmp1_card), intent(in) :: table !! two points or more; the value jumps at a repeated frequency
      real(wp), intent(in)           :: frequency !! [1/time]
      real(wp) :: value

      value = interpolated(table%frequency, table%value, frequency)
      select case (table%kind)
      case ('CRIT')
         g = 2.0_wp*max(value, 0.0_wp)
      case ('Q')
         g = 1.0_wp/max(value, min(critical_quality, minval(table%value)))
      case default
         g = max(value, 0.0_wp)
      end select
   end function loss_at

   !> The frequencies of PLAN, with those spread about the MODES (ascending frequencies): ascending, each once [1/time]. A
   !! rigid-body mode has no spread.
   pure function asked_frequencies(plan, modes) result(f)
      type(response_plan), intent(in) :: plan
      real(wp), intent(in)            :: modes(:) !! [1/time]
      real(wp), allocatable :: f(:)
      integer :: i, k, m

      f = plan%frequencies
      do i = 1, size(plan%spreads)
         associate (spread => plan%spreads(i))
            if (spread%cluster > 0.0_wp) then
               f = merged(f, between_modes(spread, pack(modes, modes > spread%first .and. modes < spread%last)))
               cycle
            end if
            do m = 1, size(modes)
               if (modes(m) <= 0.0_wp .or. modes(m) < spread%first .or. modes(m) > spread%last) cycle
               if (allocated(spread%list)) then
                  f = merged(f, modes(m)*spread%list)
               else if (spread%n == 1) then
                  f = merged(f, [modes(m)])
               else
                  f = merged(f, [(modes(m)*(1.0_wp + spread%spread*real(2*k - spread%n + 1, wp)/ &
                                            real(spread%n - 1, wp)), k = 0, spread%n - 1)])
               end if
            end do
         end associate
      end do
   end function asked_frequencies

   !> The frequencies of a FREQ3: N of them from each of FIRST, MODES and LAST to the next one, denser at these ends where CLUSTER > 1.
   !! Source: MSC Nastran Quick Reference Guide, FREQ3, remark 6.
   pure function between_modes(spread, modes) result(f)
      type(frequency_card), intent(in) :: spread
      real(wp), intent(in)             :: modes(:) !! ascending
      real(wp), allocatable :: f(:)
      real(wp) :: ends(size(modes) + 2), xi
      integer  :: i, k

      ends = [spread%first, modes, spread%last]
      if (spread%is_log) ends = log(ends)
      f = [real(wp) ::]
      do i = 2, size(ends)
         do k = 1, spread%n
            xi = -1.0_wp + 2.0_wp*real(k - 1, wp)/real(spread%n - 1, wp)
            xi = sign(abs(xi)**(1.0_wp/spread%cluster), xi)
            f = [f, 0.5_wp*((1.0_wp - xi)*ends(i - 1) + (1.0_wp + xi)*ends(i))]
         end do
      end do
      if (spread%is_log) f = exp(f)
      f = merged([real(wp) ::], f)
   end function between_modes

   !> Merge two ascending lists, each frequency once.
   pure function merged(a, b) result(f)
      real(wp), intent(in)  :: a(:), b(:)
      real(wp), allocatable :: f(:)
      integer :: i

      allocate (f(size(a) + size(b)))
      do i = 1, size(a)
         f(i + count(b < a(i))) = a(i)
      end do
      do i = 1, size(b)
         f(i + count(a <= b(i))) = b(i)
      end do
      if (size(f) > 1) f = pack(f, [.true., f(2:) - f(:size(f) - 1) > same_frequency*f(size(f))])
   end function merged

   !> Text such as 'stage 12', or 'stage 12 from 2'.
   pure function stage_name(stage) result(words)
      type(planned_stage), intent(in) :: stage
      character(:), allocatable :: words

      words = 'stage '//integer_text(stage%id)
      if (stage%from > 0) words = words//' from '//integer_text(stage%from)
   end function stage_name

   !> Text such as 'stage 2, increment 7', for messages.
   pure function where_in_plan(plan, stage, increment) result(words)
      type(stage_plan_type), intent(in) :: plan
      integer, intent(in)               :: stage, increment
      character(:), allocatable         :: words

      words = stage_name(plan%stages(stage))//', increment '//integer_text(increment)
      if (allocated(plan%stages(stage)%path)) words = plan%stages(stage)%path
   end function where_in_plan

   !> Estimated number of factorisations, for the choice of an ordering.
   pure integer function factorisations_of(plan, method) result(n)
      type(stage_plan_type), intent(in) :: plan
      integer, intent(in)               :: method !! of case control
      integer :: s

      n = sum([(size(plan%stages(s)%fractions), s = 1, size(plan%stages))])
      if (method == method_newton) n = 6*n
      if (method == method_back) n = 40*n
      do s = 1, size(plan%stages) ! two loops and the start, about three iterations per increment, three trials per amplitude
         if (.not. allocated(plan%stages(s)%vibration)) cycle
         if (.not. allocated(plan%stages(s)%vibration%backbone)) cycle
         associate (backbone => plan%stages(s)%vibration%backbone)
            n = n + 3*3*9*backbone%increments*size(backbone%amplitudes)
         end associate
      end do
   end function factorisations_of

   !> Whether each stiffness is solved for one load: by STEP, without loops.
   pure logical function solves_once(plan, method)
      type(stage_plan_type), intent(in) :: plan
      integer, intent(in)               :: method !! of case control
      integer :: s

      solves_once = method == method_step
      do s = 1, size(plan%stages)
         if (.not. allocated(plan%stages(s)%vibration)) cycle
         if (allocated(plan%stages(s)%vibration%backbone)) solves_once = .false.
      end do
   end function solves_once

   !> Whether displacements, stresses or reactions of the bodies are printed after this increment.
   pure logical function shows_bodies(plan, stage, increment)
      type(stage_plan_type), intent(in) :: plan
      integer, intent(in)               :: stage, increment

      associate (planned => plan%stages(stage), asked => plan%stages(stage)%output)
         shows_bodies = asked%level == output_all .or. asked%steps
         if (increment == size(planned%fractions)) shows_bodies = shows_bodies .or. asked%level == output_last .or. asked%vtu
      end associate
   end function shows_bodies

   !> Whether any stage of PLAN has natural modes with the stiffness of unloading.
   pure logical function has_unloading_modes(plan) result(has_them)
      type(stage_plan_type), intent(in) :: plan
      integer :: s

      has_them = .false.
      do s = 1, size(plan%stages)
         if (allocated(plan%stages(s)%vibration)) has_them = has_them .or. .not. plan%stages(s)%vibration%on_loading
      end do
   end function has_unloading_modes

end module stage_plan
