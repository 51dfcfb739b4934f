!> What case control asks of the oscillation after each stage, put together: the range of EIGRL, the frequencies of FREQ1, the load, the
!! damping, the nodes.
module vibration_build
   use bulk_data, only: freq1_card
   use deck_check, only: checked_deck
   use kinds, only: wp
   use model_data, only: model_type, stage_load_type
   use shown_nodes, only: find_limited_nodes
   use stage_plan, only: stage_plan_type
   use text_tools, only: integer_text
   use vibration_entries, only: vibration_entries_type
   use vibration_plan, only: response_plan, vibration_plan_type
   implicit none
   private

   public :: plan_vibrations, merged_frequencies

   real(wp), parameter :: same_frequency = 1.0e-9_wp ! of the largest: what is nearer is one

contains

   !> Fill the vibration of the stages of PLAN that have MODES.
   subroutine plan_vibrations(deck, model, oscillating, plan)
      type(checked_deck), intent(in)       :: deck
      type(model_type), intent(in)         :: model
      type(stage_load_type), intent(in)    :: oscillating(:) !! (stages) the loads of DLOAD
      type(stage_plan_type), intent(inout) :: plan
      integer :: s

      do s = 1, size(plan%stages)
         associate (asked => deck%control%stages(s)%vibration)
            if (asked%modes%id == 0) cycle
            allocate (plan%stages(s)%vibration)
            call plan_modes(deck, asked, plan%stages(s)%vibration)
            if (asked%frequency%id == 0) cycle
            allocate (plan%stages(s)%vibration%response)
            call plan_response(deck, model, asked, oscillating(s), plan%stages(s)%vibration%response)
         end associate
      end do
   end subroutine plan_vibrations

   !> MODES of one stage. How many where ND is blank: the lowest one, or with V2 all up to it, as in NASTRAN. Nothing oscillates
   !! below zero, so that a V1 of zero and less is none.
   subroutine plan_modes(deck, asked, vibration)
      type(checked_deck), intent(in)           :: deck
      type(vibration_entries_type), intent(in) :: asked
      type(vibration_plan_type), intent(out)   :: vibration
      integer :: k

      vibration%id = asked%modes%id
      vibration%free = asked%free
      vibration%on_loading = asked%on_loading
      vibration%amplitude = asked%amplitude
      k = findloc(deck%bulk%eigrl%id, asked%modes%id, dim=1)
      if (k == 0) then
         call deck%errors%add(asked%modes%line, 'MODES: there is no EIGRL '//integer_text(asked%modes%id))
         return
      end if
      associate (card => deck%bulk%eigrl(k))
         vibration%most = card%most
         if (card%most == 0 .and. .not. card%has_highest) vibration%most = 1
         vibration%has_lowest = card%has_lowest .and. card%lowest > 0.0_wp
         if (vibration%has_lowest) vibration%lowest = card%lowest
         vibration%has_highest = card%has_highest
         if (vibration%has_highest) vibration%highest = card%highest
         vibration%unit_mass = card%unit_mass
      end associate
   end subroutine plan_modes

   !> FREQUENCY of one stage.
   subroutine plan_response(deck, model, asked, load, response)
      type(checked_deck), intent(in)           :: deck
      type(model_type), intent(in)             :: model
      type(vibration_entries_type), intent(in) :: asked
      type(stage_load_type), intent(in)        :: load
      type(response_plan), intent(out)         :: response
      logical, allocatable :: are_named(:)
      integer :: k

      response%frequencies = merged_frequencies(pack(deck%bulk%freq1, deck%bulk%freq1%set == asked%frequency%id))
      if (size(response%frequencies) == 0) call deck%errors%add(asked%frequency%line, &
         'FREQUENCY: there is no FREQ1 with set '//integer_text(asked%frequency%id))
      allocate (response%force(3, model%n_nodes), source=0.0_wp)
      do k = 1, load%n
         response%force(:, load%node(k)) = response%force(:, load%node(k)) + load%force(:, k)
      end do
      if (allocated(load%moved)) call deck%errors%add(asked%load%line, 'DLOAD: set '//integer_text(asked%load%id)// &
         ' moves supports (SPCD); expected forces, a support does not oscillate')
      if (asked%damping%id > 0) then
         k = findloc(deck%bulk%tabdmp1%id, asked%damping%id, dim=1)
         if (k == 0) then
            call deck%errors%add(asked%damping%line, 'SDAMPING: there is no TABDMP1 '//integer_text(asked%damping%id))
         else
            allocate (response%damping)
            response%damping%kind = deck%bulk%tabdmp1(k)%kind
            response%damping%frequency = deck%bulk%tabdmp1(k)%frequency
            response%damping%value = deck%bulk%tabdmp1(k)%value
         end if
      end if
      if (.not. allocated(asked%response)) return
      call find_limited_nodes(deck%control%sets, model, 'RESPONSE', asked%response, are_named, deck%errors)
      are_named = are_named .and. model%used .and. model%node_id > 0
      response%nodes = pack([(k, k = 1, model%n_nodes)], are_named)
      if (size(response%nodes) == 0 .and. .not. deck%errors%any()) call deck%errors%add(asked%response(1)%line, &
         'RESPONSE: names no node that an element holds')
   end subroutine plan_response

   !> The frequencies of all CARDS, ascending, each once [1/time].
   pure function merged_frequencies(cards) result(f)
      type(freq1_card), intent(in) :: cards(:)
      real(wp), allocatable :: f(:)
      integer :: i, k

      allocate (f(0))
      do i = 1, size(cards)
         f = merged(f, [(cards(i)%first + k*cards(i)%step, k = 0, cards(i)%n)])
      end do
      if (size(f) > 1) f = pack(f, [.true., f(2:) - f(:size(f) - 1) > same_frequency*f(size(f))])
   end function merged_frequencies

   !> Two ascending lists as one.
   pure function merged(a, b) result(c)
      real(wp), intent(in) :: a(:), b(:)
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
   end function merged

end module vibration_build
