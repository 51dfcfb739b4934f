!> Reads a deck, its text, case control and bulk data, in one pass and collects all errors.
module deck_input
   use beam_cards, only: read_beam_load, read_beam_property
   use bulk_data, only: bulk_data_type
   use card_fields, only: card_fields_type
   use card_kinds, only: card_kind, find_cards, read_all, read_one
   use case_entries, only: limit_type, number_set
   use case_control, only: case_control_type, read_case_control
   use deck_errors, only: deck_error_list
   use deck_parameters, only: parameter_type
   use deck_parts, only: check_parts, drop_repeated, read_part
   use deck_text, only: deck_text_of_bytes, deck_text_type, read_deck_text
   use, intrinsic :: iso_fortran_env, only: int16
   use joint_cards, only: read_jgap, read_cjoint, read_jincr, read_jiwan, read_jnorm, read_joint, read_jshear, read_pjoint
   use laminate_cards, only: read_laminate, read_plate_material, read_solid_material
   use matrix_cards, only: read_dmig, read_retained
   use load_cards, only: read_bolt, read_force, read_gravity, read_load, read_own_temperature, read_pressure, read_surface_load, &
                         read_temperature
   use mesh_cards, only: fill_defaults, read_block, read_edge, read_edge_defaults, read_element, read_grid, &
                         read_pmark, read_grid_defaults, read_system, system_names
   use nastran_compatibility, only: not_reduced
   use nastran_defaults, only: find_first_card, take_initial_temperature, take_only_sets
   use nx_cards, only: read_pair, read_preload, read_region
   use property_cards, only: read_mat1, read_body_property, read_parameter, &
                             read_pshell, read_rod
   use response_cards, only: read_darea, read_dload, read_lseq, read_rload, read_tabled
   use rigid_cards, only: read_equation, read_place, read_rigid, read_tie
   use stage_entries, only: pair_reference, read_watched_pair => read_pair
   use support_cards, only: read_displacement, read_mass, read_pmass, read_scalar, read_spring, read_spring_property, &
                            read_sum, read_suport, read_support
   use unused_cards, only: count_unused
   use vibration_cards, only: read_eigrl, read_frequencies, read_jampl, read_tabdmp1
   implicit none
   private

   public :: read_deck, read_deck_of_text

   integer, parameter :: own_set = -1 ! number of the set of --watch

   type, public :: deck_type
      type(deck_text_type)    :: text
      type(case_control_type) :: control
      type(bulk_data_type)    :: bulk
      logical :: is_whole = .false. !! false: a part of the deck is missing, so that references to it cannot be checked
      type(card_kind), allocatable :: kinds(:) !! of card, with their field tables
   end type deck_type

contains

   !> All cards and the routines that read them. A new card is a line here, or a name in the line of the cards in the same array. GRID
   !! stands first, see read_all, then the other cards of the mesh. No routine depends on what another has read.
   subroutine list_cards(cards)
      type(card_kind), allocatable, intent(out) :: cards(:)

      allocate (cards(0))
      call add(['GRID'], read_grid)
      call add(['GRDSET'], read_grid_defaults)
      call add(system_names, read_system)
      call add(['CTRIA3', 'CTRIA6', 'CTRIAR', 'CQUAD4', 'CQUAD8', 'CQUADR', 'CTETRA', 'CPENTA', 'CHEXA ', 'CPYRAM'], read_element)
      call add(['CBAR ', 'CBEAM', 'CROD ', 'CTUBE'], read_edge)
      call add(['BAROR ', 'BEAMOR'], read_edge_defaults)
      call add(['BLOCK2', 'BLOCK3'], read_block)
      call add(['PMARK'], read_pmark)
      call add(['PSHELL'], read_pshell)
      call add(['PCOMP ', 'PCOMPG'], read_laminate, joins=.true.)
      call add(['PAXIS'], read_body_property)
      call add(['PSOLID'], read_body_property)
      call add(['PROD ', 'PTUBE'], read_rod)
      call add(['PBAR  ', 'PBARL ', 'PBEAM ', 'PBEAML'], read_beam_property)
      call add(['CONROD'], read_rod)
      call add(['NODEAT'], read_place)
      call add(['MAT1'], read_mat1)
      call add(['MAT2', 'MAT8'], read_plate_material, joins=.true.)
      call add(['MAT9'], read_solid_material, joins=.true.)
      call add(['BSURF  ', 'BSURFS ', 'BCPROP ', 'BCPROPS', 'BCRPARA'], read_region)
      cards%of_mesh = .true.
      call add(['BCTSET', 'BGSET '], read_pair)
      call add(['BCTADD'], read_sum)
      call add(['BGADD'], read_sum)
      call add(['BOLTFOR', 'BOLTSEQ'], read_preload)
      call add(['CELAS1', 'CELAS2', 'CELAS3', 'CELAS4', 'CBUSH ', 'CVISC ', 'CDAMP1', 'CDAMP2', 'CDAMP3', 'CDAMP4'], read_spring)
      call add(['PELAS', 'PBUSH', 'PVISC', 'PDAMP'], read_spring_property)
      call add(['CONM2 ', 'CONM1 ', 'CMASS1', 'CMASS2', 'CMASS3', 'CMASS4'], read_mass)
      call add(['PMASS'], read_pmass)
      call add(['SPOINT'], read_scalar)
      call add(['SPC ', 'SPC1', 'SPCM'], read_support)
      call add(['SPCADD'], read_sum)
      call add(['SUPORT'], read_suport)
      call add(['RBE2 ', 'RBE1 ', 'RBE3 ', 'RBAR ', 'RROD ', 'RBE2M', 'RBE3M'], read_rigid)
      call add(['SHELLTO'], read_tie)
      call add(['MPC'], read_equation)
      call add(['MPCADD'], read_sum)
      call add(['FORCE  ', 'FORCE1 ', 'FORCE2 ', 'MOMENT ', 'MOMENT1', 'MOMENT2', 'SLOAD  '], read_force)
      call add(['PLOAD4', 'PLOADE', 'PLOAD ', 'PLOAD2'], read_pressure)
      call add(['PLOADM', 'FORCEM'], read_surface_load)
      call add(['GRAV  ', 'RFORCE', 'ACCEL1'], read_gravity)
      call add(['PLOAD1'], read_beam_load)
      call add(['SPCD'], read_displacement)
      call add(['TEMP ', 'TEMPD'], read_temperature)
      call add(['TEMPP1', 'TEMPRB'], read_own_temperature)
      call add(['LOAD'], read_load)
      call add(['BOLT'], read_bolt)
      call add(['JOINT'], read_joint)
      call add(['CJOINT'], read_cjoint)
      call add(['PJOINT'], read_pjoint)
      call add(['JNORM'], read_jnorm)
      call add(['JSHEAR'], read_jshear)
      call add(['JIWAN'], read_jiwan)
      call add(['JGAP'], read_jgap)
      call add(['JINCR'], read_jincr)
      call add(['EIGRL', 'EIGR '], read_eigrl)
      call add(['JAMPL'], read_jampl)
      call add(['FREQ1', 'FREQ2', 'FREQ4', 'FREQ ', 'FREQ3', 'FREQ5'], read_frequencies)
      call add(['TABDMP1'], read_tabdmp1)
      call add(['RLOAD1', 'RLOAD2'], read_rload)
      call add(['DLOAD'], read_dload)
      call add(['DAREA'], read_darea)
      call add(['LSEQ'], read_lseq)
      call add(['TABLED1', 'TABLED2', 'TABLED3', 'TABLED4'], read_tabled)
      call add(['DMIG'], read_dmig)
      call add(['ASET ', 'ASET1', 'BSET ', 'BSET1', 'QSET ', 'QSET1'], read_retained)
      call add(['SEBULK ', 'SECONCT'], read_part)
      call add(['PARAM'], read_parameter)

   contains

      !> Add the kinds NAMES, which READ reads; where JOINS is present, into the array of the kind before.
      subroutine add(names, read, joins)
         character(*), intent(in) :: names(:)
         procedure(read_one)      :: read
         logical, intent(in), optional :: joins
         type(card_kind) :: kind
         integer :: k

         kind%routine = size(cards) + 1
         if (present(joins)) kind%routine = cards(size(cards))%routine
         kind%read => read
         do k = 1, size(names)
            kind%name = names(k)
            cards = [cards, kind]
         end do
      end subroutine add

   end subroutine list_cards

   !> Allocate every array of BULK for the largest number of entries that its cards can give.
   subroutine make_room(cards, bulk)
      type(card_kind), intent(in)         :: cards(:)
      type(bulk_data_type), intent(inout) :: bulk

      allocate (bulk%grid(n('GRID')), bulk%system(2*n('CORD1R')), bulk%element(n('CHEXA')), bulk%edge(n('CROD')), &
         bulk%plate(0), bulk%beam_property(n('PBAR')), bulk%beam_load(n('PLOAD1')), bulk%block(n('BLOCK2')), &
         bulk%pmark(n('PMARK')), bulk%pshell(n('PSHELL')), bulk%paxis(n('PAXIS')), bulk%psolid(n('PSOLID')), &
         bulk%prod(n('PROD')), bulk%conrod(n('CONROD')), bulk%spring(n('CBUSH')), bulk%spring_property(4*n('PBUSH')), &
         bulk%mass(n('CONM2')), bulk%pmass(4*n('PMASS')), bulk%scalar(n('SPOINT')), &
         bulk%mat1(n('MAT1')), bulk%support(2*n('SPC')), bulk%support_sum(n('SPCADD')), &
         bulk%rigid(n('RBE2')), bulk%place(n('NODEAT')), bulk%tie(n('SHELLTO')), bulk%equation(n('MPC')), &
         bulk%equation_sum(n('MPCADD')), bulk%force(n('FORCE') + 2*sum(cards%n, mask=cards%name == 'SLOAD')), &
         bulk%pressure(n('PLOAD')), bulk%surface_load(n('PLOADM')), &
         bulk%gravity(n('GRAV')), bulk%displacement(2*n('SPCD')), bulk%suport(4*n('SUPORT')), &
         bulk%temperature(4*n('TEMP')), bulk%load(n('LOAD')), &
         bulk%own_temperature(n('TEMPP1')), bulk%bolt(n('BOLT')), bulk%joint(n('JOINT')), bulk%cjoint(n('CJOINT')), &
         bulk%pjoint(n('PJOINT')), bulk%jnorm(n('JNORM')), bulk%jshear(n('JSHEAR')), bulk%jgap(n('JGAP')), &
         bulk%jiwan(n('JIWAN')), bulk%jincr(n('JINCR')), bulk%eigrl(n('EIGRL')), bulk%jampl(n('JAMPL')), &
         bulk%frequency(n('FREQ1')), bulk%tabdmp1(n('TABDMP1')), bulk%region(n('BSURF')), &
         bulk%pair(n('BCTSET')), bulk%contact_sum(n('BCTADD')), bulk%glue_sum(n('BGADD')), bulk%preload(n('BOLTFOR')), &
         bulk%dynamic%rload(n('RLOAD1')), bulk%dload(n('DLOAD')), &
         bulk%dynamic%darea(2*n('DAREA')), bulk%dynamic%lseq(n('LSEQ')), bulk%dynamic%tabled(n('TABLED1')), &
         bulk%matrices%dmig(n('DMIG')), bulk%matrices%retained(4*n('ASET')))

   contains

      !> Number of cards of the kind NAME and of the kinds in the same array.
      pure integer function n(name)
         character(*), intent(in) :: name
         integer :: k

         k = findloc(cards%name, name, dim=1)
         if (k == 0) error stop 'there is no card '//name
         n = sum(cards%n, mask=cards%routine == cards(k)%routine)
      end function n

   end subroutine make_room

   !> Read the deck PATH. READABLE is false where the file cannot be read; errors in the deck go to ERRORS.
   subroutine read_deck(path, deck, errors, readable, parameters, watched, law)
      character(*), intent(in)             :: path
      type(deck_type), intent(out)         :: deck
      type(deck_error_list), intent(inout) :: errors
      logical, intent(out)                 :: readable
      type(parameter_type), intent(in), optional :: parameters(:) !! of --set; default: none
      character(*), intent(in), optional   :: watched             !! of --watch: node numbers with commas; default and '': none
      character(*), intent(in), optional   :: law                 !! file of --law; default and '': none
      logical :: ok

      call read_deck_text(path, deck%text, errors, readable, parameters, law)
      if (readable) call read_lines(deck, errors)
      if (.not. present(watched) .or. .not. readable) return
      if (watched == '') return
      call watch_also(deck%control, watched, ok)
      if (.not. ok) call errors%add(0, '--watch '//watched//': expected node numbers, or N-M for node M against node N')
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
      integer(int16), allocatable :: kind_at(:) ! (lines) kind of the card that begins there, 0: none or unknown
      integer :: cursor, first_card
      logical :: found_bulk, is_alone, is_whole

      if (.not. deck%text%is_text) return
      is_whole = .not. errors%any()
      if (deck%text%tab_lines /= '') call errors%warn('tabs are read as blanks up to the next column of eight: '// &
                                                      deck%text%tab_lines)
      cursor = 1
      call list_cards(deck%kinds)
      call find_first_card(deck%text, deck%kinds%name, first_card, is_alone, errors)
      call read_case_control(deck%text, cursor, first_card, deck%control, found_bulk, errors)
      if (deck%control%refused) return
      if (.not. found_bulk .or. (first_card > 0 .and. .not. (is_alone .or. deck%control%of_nastran))) then
         call errors%add(0, 'no BEGIN BULK: expected it between case control and the cards')
         return
      end if
      if (first_card > 0 .and. .not. is_alone) call errors%warn('no BEGIN BULK: the cards begin in '//deck%text%place(first_card))
      allocate (kind_at(deck%text%n), source=0_int16)
      deck%bulk%ignored = deck%control%ignored
      deck%bulk%parameters = deck%control%parameters
      call find_cards(deck%text, cursor, deck%kinds, deck%control%of_nastran .or. is_alone, kind_at, deck%bulk, errors)
      if (deck%bulk%n_cards < 0) return
      if (size(deck%bulk%part_lines) > 0) call drop_repeated(deck%text, deck%kinds%name, kind_at, deck%kinds%n, deck%bulk, errors)
      call make_room(deck%kinds, deck%bulk)
      call read_all(deck%text, kind_at, deck%kinds, deck%bulk, errors)
      associate (bulk => deck%bulk, asked => deck%control%stages%vibration)
         ! the arrays whose cards may fill one entry or several are cut to the filled entries
         bulk%system = bulk%system(:count(bulk%system%line > 0))
         bulk%spring_property = bulk%spring_property(:count(bulk%spring_property%line > 0))
         bulk%pmass = bulk%pmass(:count(bulk%pmass%line > 0))
         bulk%force = bulk%force(:count(bulk%force%line > 0))
         bulk%support = bulk%support(:count(bulk%support%line > 0))
         bulk%displacement = bulk%displacement(:count(bulk%displacement%line > 0))
         bulk%suport = bulk%suport(:count(bulk%suport%line > 0))
         bulk%temperature = bulk%temperature(:count(bulk%temperature%line > 0))
         bulk%plate = bulk%plate(:bulk%n_plates)
         bulk%dynamic%darea = bulk%dynamic%darea(:count(bulk%dynamic%darea%line > 0))
         bulk%matrices%retained = bulk%matrices%retained(:count(bulk%matrices%retained%line > 0))
         do cursor = 1, merge(0, size(bulk%matrices%retained), any(deck%control%stages%output%dmig))
            call bulk%ignored%wait('ASET', bulk%matrices%retained(cursor)%line, .false., warning=not_reduced)
         end do
         do cursor = 1, merge(size(bulk%matrices%dmig), 0, size(deck%control%matrices) == 0)
            call bulk%ignored%add('DMIG')
         end do
         call fill_defaults(bulk)
         if (size(bulk%part_lines) > 0) call check_parts(bulk, errors)
         call count_unused(bulk)
         call bulk%ignored%settle(any(asked%modes%id /= 0), any(asked%modes%id /= 0 .and. asked%frequency%id > 0), &
                                  any(deck%control%stages%warms_materials), &
                                  bulk%parameters%relief_line > 0 .or. any(deck%control%stages%output%dmig), errors)
         if (is_alone) call take_only_sets(bulk, deck%control%stages(1), errors)
         call take_initial_temperature(deck%control%stages%initial, bulk, errors)
      end associate
      deck%is_whole = is_whole
   end subroutine read_lines

   !> Watch the nodes and pairs of LIST, numbers and N-M with commas, in all stages; not OK: a word is neither. The nodes form a set
   !! whose number no deck can use.
   pure subroutine watch_also(control, list, ok)
      type(case_control_type), intent(inout) :: control
      character(*), intent(in)               :: list
      logical, intent(out)                   :: ok
      type(pair_reference), allocatable :: pairs(:)
      type(pair_reference) :: pair
      type(number_set) :: own
      character(:), allocatable :: nodes, rest
      integer :: comma, s

      own%id = own_set
      nodes = ''
      allocate (pairs(0))
      rest = list
      ok = .true.
      do while (ok .and. rest /= '')
         comma = index(rest//',', ',')
         if (index(rest(:comma - 1), '-') > 0) then
            call read_watched_pair(rest(:comma - 1), pair, ok)
            pairs = [pairs, pair]
         else
            nodes = nodes//','//rest(:comma - 1)
         end if
         rest = rest(min(comma + 1, len(rest) + 1):)
      end do
      if (.not. allocated(control%sets)) allocate (control%sets(0))
      if (nodes /= '') then
         own%text = nodes(2:)
         control%sets = [control%sets, own]
      end if
      do s = 1, size(control%stages)
         associate (stage => control%stages(s))
            if (.not. allocated(stage%pairs)) allocate (stage%pairs(0))
            stage%pairs = [stage%pairs, pairs]
            if (nodes == '') cycle
            if (.not. allocated(stage%watch)) allocate (stage%watch(0))
            stage%watch = [stage%watch, limit_type(.false., own_set, 0)]
         end associate
      end do
   end subroutine watch_also

end module deck_input
