!> The loads that oscillate in a stage: DLOAD of case control is a load set, an RLOAD1 or RLOAD2, or a DLOAD card, a sum of these.
module wave_build
   use bulk_data, only: bulk_data_type
   use case_entries, only: set_reference
   use deck_check, only: checked_deck
   use frequency_loads, only: load_law
   use kinds, only: wp
   use model_data, only: freedoms_type, mesh_type, stage_load_type
   use text_tools, only: integer_text
   use unknowns, only: component_place, node_axes, place_of_component
   implicit none
   private

   public :: list_waves, check_waves, add_force, has_set

   !> One of these loads.
   type, public :: planned_wave
      integer :: stage = 0
      type(load_law) :: law                      !! without tables: of a load set
      type(stage_load_type) :: load              !! its pattern; at first forces of DAREA, without
      type(set_reference), allocatable :: sets(:) !! these load sets
      character(8), allocatable :: keys(:)       !! what names them
   end type planned_wave

contains

   !> The WAVES of all stages, with the load sets of their patterns.
   subroutine list_waves(deck, mesh, freedoms, waves)
      type(checked_deck), intent(in)  :: deck
      type(mesh_type), intent(in)     :: mesh
      type(freedoms_type), intent(in) :: freedoms
      type(planned_wave), allocatable, intent(out) :: waves(:)
      type(planned_wave), allocatable :: plain ! on the heap: the compiler warns of its bounds where it is a local variable
      integer :: i, k, s

      allocate (plain)
      allocate (plain%load%node(0), plain%load%force(3, 0), waves(0))
      do s = 1, size(deck%control%stages)
         associate (asked => deck%control%stages(s)%vibration%load)
            if (asked%id == 0) cycle
            k = findloc(deck%bulk%dload%set, asked%id, dim=1)
            if (k > 0) then
               associate (sum => deck%bulk%dload(k))
                  do i = 1, size(sum%sets)
                     call add(sum%sets(i), sum%scale*sum%factors(i))
                     if (all(deck%bulk%dynamic%rload%id /= sum%sets(i))) call deck%field_error(sum%line, sum%at(i), &
                        'there is no RLOAD1 or RLOAD2 '//integer_text(sum%sets(i)), called='L'//integer_text(i))
                  end do
               end associate
            else if (any(deck%bulk%dynamic%rload%id == asked%id)) then
               call add(asked%id, 1.0_wp)
            else
               plain%stage = s
               plain%sets = [asked]
               plain%keys = ['DLOAD   ']
               waves = [waves, plain]
            end if
         end associate
      end do

   contains

      !> Append the RLOADs with number ID, times SCALE; each has its tables.
      subroutine add(id, scale)
         integer, intent(in)  :: id
         real(wp), intent(in) :: scale
         type(planned_wave), allocatable :: wave
         integer :: at, r, t

         do r = 1, size(deck%bulk%dynamic%rload)
            associate (card => deck%bulk%dynamic%rload(r), tables => deck%bulk%dynamic%tabled)
               if (card%id /= id) cycle
               wave = plain
               wave%stage = s
               wave%law%scale = scale
               wave%law%card = card
               allocate (wave%law%tables(2))
               do t = 1, 2
                  wave%law%tables(t)%y = [card%constants(t)]
                  if (card%tables(t) == 0) cycle
                  at = findloc(tables%id, card%tables(t), dim=1)
                  if (at > 0) wave%law%tables(t) = tables(at)
                  if (at == 0) call deck%field_error(card%line, 4 + t, 'there is no TABLED1, TABLED2, TABLED3 or TABLED4 '// &
                                                     integer_text(card%tables(t)))
               end do
               call find_sets(deck, deck%control%stages(s)%vibration%sequence%id, wave)
               call add_areas(deck, mesh, freedoms, card%excite, wave%load)
               waves = [waves, wave]
            end associate
         end do
      end subroutine add

   end subroutine list_waves

   !> The load sets that EXCITEID of the RLOAD of WAVE names: itself, and those of LSEQ cards with set SEQUENCE (0: of any set).
   subroutine find_sets(deck, sequence, wave)
      type(checked_deck), intent(in)    :: deck
      integer, intent(in)               :: sequence
      type(planned_wave), intent(inout) :: wave
      integer :: i

      wave%sets = [set_reference ::]
      wave%keys = [character(8) ::]
      associate (card => wave%law%card, lseq => deck%bulk%dynamic%lseq)
         if (has_set(deck%bulk, card%excite) .or. any(deck%bulk%load%set == card%excite)) then
            wave%sets = [set_reference(card%excite, card%line)]
            wave%keys = ['EXCITEID']
         else if (all(deck%bulk%dynamic%darea%set /= card%excite) .and. all(lseq%excite /= card%excite)) then
            call deck%field_error(card%line, 'EXCITEID', 'there is no DAREA, LSEQ, LOAD, nor a load or SPCD with set '// &
                                  integer_text(card%excite))
         end if
         do i = 1, size(lseq)
            if (lseq(i)%excite /= card%excite .or. lseq(i)%load == 0 .or. (sequence > 0 .and. lseq(i)%set /= sequence)) cycle
            wave%sets = [wave%sets, set_reference(lseq(i)%load, lseq(i)%line)]
            wave%keys = [wave%keys, 'LSEQ    ']
         end do
      end associate
   end subroutine find_sets

   !> Errors: an RLOAD whose TYPE does not agree with its loads.
   subroutine check_waves(deck, waves)
      type(checked_deck), intent(in) :: deck
      type(planned_wave), intent(in) :: waves(:)
      integer :: i

      do i = 1, size(waves)
         associate (card => waves(i)%law%card, moves => allocated(waves(i)%load%moved))
            if (.not. allocated(waves(i)%law%tables)) cycle
            if (card%motion == 0 .and. moves) call deck%field_error(card%line, 'TYPE', &
               'set '//integer_text(card%excite)//' moves supports (SPCD), expected DISP, VELO or ACCE')
            if (card%motion > 0 .and. .not. moves .and. .not. deck%errors%any()) call deck%field_error(card%line, 'TYPE', &
               'set '//integer_text(card%excite)//' has no SPCD; expected LOAD, a force, or SPCD cards for supports that move')
         end associate
      end do
   end subroutine check_waves

   !> Add the forces of the DAREA cards of set EXCITE to LOADS, in global axes; a moment acts on the node of rotations.
   subroutine add_areas(deck, mesh, freedoms, excite, loads)
      type(checked_deck), intent(in)       :: deck
      type(mesh_type), intent(in)          :: mesh
      type(freedoms_type), intent(in)      :: freedoms
      integer, intent(in)                  :: excite
      type(stage_load_type), intent(inout) :: loads
      type(component_place) :: place
      real(wp) :: axes(3, 3)
      integer  :: at, i

      do i = 1, size(deck%bulk%dynamic%darea)
         associate (card => deck%bulk%dynamic%darea(i))
            if (card%set /= excite) cycle
            at = mesh%node_table%find(card%node)
            if (at > 0) place = place_of_component(mesh, at, max(1, card%component))
            if (at == 0) then
               call deck%field_error(card%line, card%field, 'there is no GRID '//integer_text(card%node), called='P')
            else if (.not. freedoms%used(at)) then
               call deck%field_error(card%line, card%field, 'node '//integer_text(card%node)//' belongs to no element', called='P')
            else if (place%node == 0) then
               call deck%field_error(card%line, card%field + 1, 'node '//integer_text(card%node)//' has no component '// &
                                     integer_text(card%component), called='C')
            else
               axes = node_axes(mesh, at)
               if (mesh%dimension == 2 .and. card%component == 6) axes(:, 1) = [1.0_wp, 0.0_wp, 0.0_wp]
               call add_force(place%node, axes(:, place%d)*card%value/place%scale, loads)
            end if
         end associate
      end do
   end subroutine add_areas

   !> Whether any load card belongs to SET.
   pure logical function has_set(bulk, set)
      type(bulk_data_type), intent(in) :: bulk
      integer, intent(in)              :: set

      has_set = any(bulk%force%set == set) .or. any(bulk%pressure%set == set) .or. any(bulk%surface_load%set == set) .or. &
                any(bulk%gravity%set == set) .or. any(bulk%displacement%set == set) .or. any(bulk%beam_load%set == set)
   end function has_set

   !> Append a FORCE at NODE.
   pure subroutine add_force(node, force, loads)
      integer, intent(in)                  :: node
      real(wp), intent(in)                 :: force(3)
      type(stage_load_type), intent(inout) :: loads

      if (loads%n == size(loads%node)) then
         loads%node = [loads%node, loads%node, spread(0, 1, 8)]
         loads%force = reshape([loads%force, loads%force, spread(force, 2, 8)], [3, size(loads%node)])
      end if
      loads%n = loads%n + 1
      loads%node(loads%n) = node
      loads%force(:, loads%n) = force
   end subroutine add_force

end module wave_build
