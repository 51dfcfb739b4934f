!> Reads a deck, its text, case control and bulk data, in one pass and collects all errors.
module deck_input
   use bulk_data, only: bulk_data_type
   use card_reader, only: card_kind, card_reader_type
   use case_control, only: case_control_type, read_case_control, watch_also
   use deck_cards, only: card_name, card_type, check_first_field, is_continuation, read_card
   use deck_errors, only: deck_error_list
   use deck_parameters, only: parameter_type
   use deck_text, only: deck_text_of_bytes, deck_text_type, is_include, read_deck_text
   use joint_cards, only: read_jgap, read_cjoint, read_jincr, read_jnorm, read_joint, read_jshear, read_pjoint
   use kinds, only: long
   use lists, only: id_table_type
   use load_cards, only: read_bolt, read_force, read_gravity, read_load, read_plate_temperature, read_pressure, read_surface_load, &
                         read_temperature
   use mesh_cards, only: complete_remedy, read_block, read_edge, read_element, read_grid, read_pmark, fill_grid_defaults, &
                         read_grid_defaults, read_system, system_names
   use nastran_compatibility, only: is_idle_card
   use property_cards, only: read_beam_load, read_beam_property, read_conrod, read_mat1, read_parameter, read_paxis, &
                             read_prod, read_pshell, read_psolid
   use rigid_cards, only: read_equation, read_place, read_rigid, read_tie
   use support_cards, only: read_displacement, read_mass, read_spring, read_spring_property, read_sum, read_support
   use vibration_cards, only: read_eigrl, read_freq1, read_freq4, read_jampl, read_tabdmp1
   implicit none
   private

   public :: read_deck, read_deck_of_text

   type, public :: deck_type
      type(deck_text_type)    :: text
      type(case_control_type) :: control
      type(bulk_data_type)    :: bulk
      logical :: is_whole = .false. !! false: a part of the deck is missing, so that references to it cannot be checked
      type(card_kind), allocatable :: kinds(:) !! of card, with their field tables
   end type deck_type

   character(*), parameter :: end_of_data = 'ENDDATA', behind_end = 'text behind ENDDATA' ! BEHIND_END as an entry without effect

contains

   !> All cards and the routines that read them. A new card is a line here, or a name in the line of the cards in the same array. GRID
   !! stands first, see read_all. No routine depends on what another has read.
   subroutine list_cards(cards)
      type(card_reader_type), intent(inout) :: cards

      call cards%add_kinds(['GRID'], read_grid)
      call cards%add_kinds(['GRDSET'], read_grid_defaults)
      call cards%add_kinds(system_names, read_system)
      call cards%add_kinds(['CTRIA3', 'CTRIA6', 'CQUAD4', 'CQUAD8', 'CTETRA', 'CPENTA', 'CHEXA '], read_element)
      call cards%add_kinds(['CBAR ', 'CBEAM', 'CROD '], read_edge)
      call cards%add_kinds(['BLOCK2', 'BLOCK3'], read_block)
      call cards%add_kinds(['PMARK'], read_pmark)
      call cards%add_kinds(['PSHELL'], read_pshell)
      call cards%add_kinds(['PAXIS'], read_paxis)
      call cards%add_kinds(['PSOLID'], read_psolid)
      call cards%add_kinds(['PROD'], read_prod)
      call cards%add_kinds(['PBAR  ', 'PBARL ', 'PBEAM ', 'PBEAML'], read_beam_property)
      call cards%add_kinds(['CONROD'], read_conrod)
      call cards%add_kinds(['CELAS1', 'CELAS2', 'CBUSH '], read_spring)
      call cards%add_kinds(['PELAS', 'PBUSH'], read_spring_property)
      call cards%add_kinds(['CONM2 ', 'CMASS2'], read_mass)
      call cards%add_kinds(['MAT1'], read_mat1)
      call cards%add_kinds(['SPC ', 'SPC1', 'SPCM'], read_support)
      call cards%add_kinds(['SPCADD'], read_sum)
      call cards%add_kinds(['RBE2 ', 'RBE3 ', 'RBAR ', 'RBE2M', 'RBE3M'], read_rigid)
      call cards%add_kinds(['NODEAT'], read_place)
      call cards%add_kinds(['SHELLTO'], read_tie)
      call cards%add_kinds(['MPC'], read_equation)
      call cards%add_kinds(['MPCADD'], read_sum)
      call cards%add_kinds(['FORCE ', 'FORCE1', 'FORCE2', 'MOMENT'], read_force)
      call cards%add_kinds(['PLOAD4', 'PLOADE', 'PLOAD ', 'PLOAD2'], read_pressure)
      call cards%add_kinds(['PLOADM', 'FORCEM'], read_surface_load)
      call cards%add_kinds(['GRAV  ', 'RFORCE', 'ACCEL1'], read_gravity)
      call cards%add_kinds(['PLOAD1'], read_beam_load)
      call cards%add_kinds(['SPCD'], read_displacement)
      call cards%add_kinds(['TEMP ', 'TEMPD'], read_temperature)
      call cards%add_kinds(['TEMPP1'], read_plate_temperature)
      call cards%add_kinds(['LOAD'], read_load)
      call cards%add_kinds(['BOLT'], read_bolt)
      call cards%add_kinds(['JOINT'], read_joint)
      call cards%add_kinds(['CJOINT'], read_cjoint)
      call cards%add_kinds(['PJOINT'], read_pjoint)
      call cards%add_kinds(['JNORM'], read_jnorm)
      call cards%add_kinds(['JSHEAR'], read_jshear)
      call cards%add_kinds(['JGAP'], read_jgap)
      call cards%add_kinds(['JINCR'], read_jincr)
      call cards%add_kinds(['EIGRL'], read_eigrl)
      call cards%add_kinds(['JAMPL'], read_jampl)
      call cards%add_kinds(['FREQ1', 'FREQ2'], read_freq1)
      call cards%add_kinds(['FREQ4'], read_freq4)
      call cards%add_kinds(['TABDMP1'], read_tabdmp1)
      call cards%add_kinds(['PARAM'], read_parameter)
   end subroutine list_cards

   !> Allocate every array of BULK for the largest number of entries that its cards can give.
   subroutine make_room(cards, bulk)
      type(card_reader_type), intent(in)  :: cards
      type(bulk_data_type), intent(inout) :: bulk

      allocate (bulk%grid(cards%n_of('GRID')), bulk%system(2*cards%n_of('CORD1R')), bulk%element(cards%n_of('CHEXA')), &
         bulk%edge(cards%n_of('CROD')), bulk%plate(0), bulk%beam_property(cards%n_of('PBAR')), &
         bulk%beam_load(cards%n_of('PLOAD1')), bulk%block(cards%n_of('BLOCK2')), bulk%pmark(cards%n_of('PMARK')), &
         bulk%pshell(cards%n_of('PSHELL')), bulk%paxis(cards%n_of('PAXIS')), bulk%psolid(cards%n_of('PSOLID')), &
         bulk%prod(cards%n_of('PROD')), bulk%conrod(cards%n_of('CONROD')), bulk%spring(cards%n_of('CBUSH')), &
         bulk%spring_property(2*cards%n_of('PBUSH')), bulk%mass(cards%n_of('CONM2')), bulk%mat1(cards%n_of('MAT1')), &
         bulk%support(2*cards%n_of('SPC')), bulk%support_sum(cards%n_of('SPCADD')), bulk%rigid(cards%n_of('RBE2')), &
         bulk%place(cards%n_of('NODEAT')), bulk%tie(cards%n_of('SHELLTO')), &
         bulk%equation(cards%n_of('MPC')), bulk%equation_sum(cards%n_of('MPCADD')), bulk%force(cards%n_of('FORCE')), &
         bulk%pressure(cards%n_of('PLOAD')), bulk%surface_load(cards%n_of('PLOADM')), bulk%gravity(cards%n_of('GRAV')), &
         bulk%displacement(2*cards%n_of('SPCD')), bulk%temperature(4*cards%n_of('TEMP')), bulk%load(cards%n_of('LOAD')), &
         bulk%plate_temperature(cards%n_of('TEMPP1')), &
         bulk%bolt(cards%n_of('BOLT')), bulk%joint(cards%n_of('JOINT')), bulk%cjoint(cards%n_of('CJOINT')), &
         bulk%pjoint(cards%n_of('PJOINT')), bulk%jnorm(cards%n_of('JNORM')), bulk%jshear(cards%n_of('JSHEAR')), &
         bulk%jgap(cards%n_of('JGAP')), bulk%jincr(cards%n_of('JINCR')), bulk%eigrl(cards%n_of('EIGRL')), &
         bulk%jampl(cards%n_of('JAMPL')), &
         bulk%freq1(cards%n_of('FREQ1')), bulk%freq4(cards%n_of('FREQ4')), bulk%tabdmp1(cards%n_of('TABDMP1')))
   end subroutine make_room

   !> Read the deck PATH. READABLE is false where the file cannot be read; errors in the deck go to ERRORS.
   subroutine read_deck(path, deck, errors, readable, parameters, watched)
      character(*), intent(in)             :: path
      type(deck_type), intent(out)         :: deck
      type(deck_error_list), intent(inout) :: errors
      logical, intent(out)                 :: readable
      type(parameter_type), intent(in), optional :: parameters(:) !! of --set; default: none
      character(*), intent(in), optional   :: watched             !! of --watch: node numbers with commas; default and '': none

      call read_deck_text(path, deck%text, errors, readable, parameters)
      if (readable) call read_lines(deck, errors)
      if (.not. present(watched) .or. .not. readable) return
      if (watched == '') return
      call watch_also(deck%control, watched)
      deck%text%options = '--watch '//watched
   end subroutine read_deck

   !> Read the deck with these BYTES, as in a file; errors in the deck go to ERRORS.
   subroutine read_deck_of_text(bytes, deck, errors)
      character(*), intent(in)           :: bytes
      type(deck_type), intent(out)       :: deck
      type(deck_error_list), intent(out) :: errors

      call deck_text_of_bytes(bytes, deck%text, errors)
      call read_lines(deck, errors)
   end subroutine read_deck_of_text

   !> Read case control and bulk data of the deck text.
   subroutine read_lines(deck, errors)
      type(deck_type), intent(inout), target       :: deck
      type(deck_error_list), intent(inout), target :: errors
      type(card_reader_type) :: cards
      integer :: cursor
      logical :: found_bulk, is_whole

      if (.not. deck%text%is_text) return
      is_whole = .not. errors%any()
      cursor = 1
      call read_case_control(deck%text, cursor, deck%control, found_bulk, errors)
      if (.not. found_bulk) then
         call errors%add(0, 'no BEGIN BULK: expected it between case control and the cards')
         return
      end if
      call cards%start(deck%text%n)
      call list_cards(cards)
      deck%bulk%ignored = deck%control%ignored
      deck%bulk%parameters = deck%control%parameters
      call find_cards(deck%text, cursor, cards, deck%bulk, errors)
      call make_room(cards, deck%bulk)
      call cards%read_all(deck%text, deck%bulk, errors)
      associate (bulk => deck%bulk) ! the arrays whose cards may fill one entry or several are cut to the filled entries
         bulk%system = bulk%system(:count(bulk%system%line > 0))
         bulk%spring_property = bulk%spring_property(:count(bulk%spring_property%line > 0))
         bulk%support = bulk%support(:count(bulk%support%line > 0))
         bulk%displacement = bulk%displacement(:count(bulk%displacement%line > 0))
         bulk%temperature = bulk%temperature(:count(bulk%temperature%line > 0))
      end associate
      call fill_grid_defaults(deck%bulk)
      call count_unused(deck%bulk)
      associate (asked => deck%control%stages%vibration)
         call deck%bulk%ignored%settle(any(asked%modes%id > 0), any(asked%modes%id > 0 .and. asked%frequency%id > 0), errors)
      end associate
      call move_alloc(cards%kinds, deck%kinds)
      deck%is_whole = is_whole
   end subroutine read_lines

   !> Note where the cards from line CURSOR to ENDDATA begin. BULK counts all cards, also unknown ones and those without effect. Text
   !! behind ENDDATA has no effect.
   subroutine find_cards(text, cursor, cards, bulk, errors)
      type(deck_text_type), intent(in)      :: text
      integer, intent(inout)                :: cursor
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(deck_error_list), intent(inout)  :: errors
      integer(long) :: first, last
      integer :: comma, file
      integer :: ended_file ! file whose ENDDATA was read last, 1: the deck itself
      logical :: is_open    ! a card may be continued

      ended_file = 0
      is_open = .false.
      do while (cursor <= text%n)
         call text%find(cursor, file, first, last, comma)
         if (last < first) then
            cursor = cursor + 1
         else if (ended_file == 1 .or. file == ended_file) then
            call bulk%ignored%add(behind_end)
            do while (cursor <= text%n) ! once for each file
               if (ended_file /= 1 .and. text%file_number(cursor) /= ended_file) exit
               cursor = cursor + 1
            end do
         else if (is_continuation(text%files(file)%bytes(first:last), comma)) then
            if (.not. is_open) call errors%add(cursor, 'a continuation line without a card before it')
            cursor = cursor + 1
         else if (is_include(text%files(file)%bytes(first:last))) then
            is_open = .false.
            cursor = cursor + 1     ! the lines of the file follow in the deck text
         else if (card_name(text%files(file)%bytes(first:last), comma) == end_of_data) then
            is_open = .false.
            ended_file = file
            cursor = cursor + 1
         else
            is_open = .true.
            bulk%n_cards = bulk%n_cards + 1
            call find_card(text%files(file)%bytes(first:last), comma, text, cursor, cards, bulk, errors)
         end if
      end do
      if (ended_file /= 1) call errors%add(0, 'no ENDDATA: the deck may be truncated; expected ENDDATA after the last card')
   end subroutine find_cards

   !> Note the card that begins with LINE, line CURSOR of TEXT. CURSOR then is a later line.
   subroutine find_card(line, comma, text, cursor, cards, bulk, errors)
      character(*), intent(in)              :: line
      integer, intent(in)                   :: comma !! column of the first comma, 0: none
      type(deck_text_type), intent(in)      :: text
      integer, intent(inout)                :: cursor
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(deck_error_list), intent(inout)  :: errors
      type(card_type)       :: card
      type(deck_error_list) :: faults
      logical :: is_known

      is_known = .false.
      call check_first_field(line, comma, cursor, faults)
      if (.not. faults%any()) call cards%note_card(card_name(line, comma), cursor, is_known)
      if (is_known) then
         cursor = cursor + 1
      else if (.not. faults%any() .and. is_idle_card(card_name(line, comma))) then
         call bulk%ignored%add(trim(card_name(line, comma)))
         cursor = cursor + 1
      else
         call read_card(text, cursor, card, errors) ! finds the other errors of the card
         if (card%name == 'CQUAD9') then
            call errors%add(card%line, 'CQUAD9 is a complete element of nine nodes; expected a CQUAD8, no node inside'// &
                            complete_remedy, 1, 8)
         else if (card%name /= '') then
            call errors%add(card%line, ''''//trim(card%name)//''' is not a card of jointfem; see input/README.md', 1, 8)
         end if
      end if
   end subroutine find_card

   !> Add the unused properties and coordinate systems of BULK to its entries without effect.
   subroutine count_unused(bulk)
      type(bulk_data_type), intent(inout) :: bulk

      associate (properties => [without_repeats(bulk%block%property), without_repeats(bulk%element%property), &
                                without_repeats(bulk%edge%property)], &
                 springs => bulk%spring_property, is_bush => bulk%spring%is_bush, system => bulk%system)
         call count_unnamed([bulk%pshell%id, bulk%paxis%id, bulk%psolid%id, bulk%prod%id, bulk%beam_property%id], properties, &
            [spread('PSHELL', 1, size(bulk%pshell)), spread('PAXIS ', 1, size(bulk%paxis)), &
             spread('PSOLID', 1, size(bulk%psolid)), spread('PROD  ', 1, size(bulk%prod)), &
             bulk%beam_property%name])
         call count_unnamed(pack(springs%id, .not. springs%is_bush), pack(bulk%spring%property, .not. is_bush), &
                            spread('PELAS ', 1, count(.not. springs%is_bush)))
         call count_unnamed(pack(springs%id, springs%is_bush), pack(bulk%spring%property, is_bush), &
                            spread('PBUSH ', 1, count(springs%is_bush)))
         if (size(system) == 0) return
         call count_unnamed(system%id, [system%reference, bulk%force%system, bulk%pressure%system, bulk%gravity%system, &
            bulk%spring%system, bulk%mass%system, without_repeats(bulk%grid%cp), without_repeats(bulk%grid%cd)], &
            system_names(system%kind + merge(0, 3, system%nodes(1) > 0)))
      end associate

   contains

      !> Add the cards with numbers ID, CALLED so, that are not among NAMES.
      subroutine count_unnamed(id, names, called)
         integer, intent(in)      :: id(:), names(:)
         character(6), intent(in) :: called(:)
         type(id_table_type) :: table
         logical :: named(0:size(id))
         integer :: i

         call table%build(id)
         named = .false.
         do i = 1, size(names)
            named(table%find(names(i))) = .true.
         end do
         do i = 1, size(id)
            if (id(i) > 0 .and. .not. named(i)) call bulk%ignored%add(trim(called(i)))
         end do
      end subroutine count_unnamed

   end subroutine count_unused

   !> LIST without consecutive repetitions: a mesh has long runs of one property.
   pure function without_repeats(list) result(shorter)
      integer, intent(in)  :: list(:)
      integer, allocatable :: shorter(:)
      integer :: i

      shorter = pack(list, [(i == 1 .or. list(max(1, i - 1)) /= list(i), i = 1, size(list))])
   end function without_repeats

end module deck_input
