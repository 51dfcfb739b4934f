!> Reads a deck, its text, case control and bulk data, in one pass and collects all errors.
module deck_input
   use beam_cards, only: read_beam_load, read_beam_property
   use bulk_data, only: bulk_data_type
   use card_fields, only: card_fields_type
   use case_control, only: case_control_type, read_case_control, watch_also
   use deck_cards, only: card_name, card_type, check_first_field, is_continuation, loose_text, read_card
   use deck_errors, only: deck_error_list
   use deck_parameters, only: parameter_type
   use deck_text, only: deck_text_of_bytes, deck_text_type, read_deck_text
   use deck_lines, only: is_include
   use, intrinsic :: iso_fortran_env, only: int16
   use joint_cards, only: read_jgap, read_cjoint, read_jincr, read_jiwan, read_jnorm, read_joint, read_jshear, read_pjoint
   use kinds, only: long
   use laminate_cards, only: read_laminate, read_plate_material
   use matrix_cards, only: read_dmig, read_retained
   use load_cards, only: read_bolt, read_force, read_gravity, read_load, read_own_temperature, read_pressure, read_surface_load, &
                         read_temperature
   use mesh_cards, only: complete_remedy, fill_defaults, read_block, read_edge, read_edge_defaults, read_element, read_grid, &
                         read_pmark, read_grid_defaults, read_system, system_names
   use nastran_compatibility, only: not_reduced, take_idle_card
   use nastran_defaults, only: find_first_card, take_initial_temperature, take_only_sets
   use nx_cards, only: read_pair, read_preload, read_region
   use property_cards, only: read_mat1, read_body_property, read_parameter, &
                             read_pshell, read_rod
   use response_cards, only: read_darea, read_dload, read_lseq, read_rload, read_tabled
   use rigid_cards, only: read_equation, read_place, read_rigid, read_tie
   use support_cards, only: read_displacement, read_mass, read_pmass, read_scalar, read_spring, read_spring_property, &
                            read_sum, read_suport, read_support
   use text_tools, only: plural, upper
   use unused_cards, only: count_unused
   use vibration_cards, only: read_eigrl, read_frequencies, read_jampl, read_tabdmp1
   implicit none
   private

   public :: read_deck, read_deck_of_text

   !> One kind of card, and the routine that reads it. The kinds of one array share a routine.
   type, public :: card_kind
      character(8) :: name = ''
      character(8), allocatable :: fields(:)         !! names of the data fields, as far as cards of this kind have been read
      integer, private :: routine = 0                ! the same for kinds that share a routine
      integer, private :: n = 0                      ! number of cards of this kind
      logical :: of_mesh = .false.                   !! of nodes, elements, properties or marked surfaces
      procedure(read_one), pointer, nopass, private :: read => null()
   end type card_kind

   type, public :: deck_type
      type(deck_text_type)    :: text
      type(case_control_type) :: control
      type(bulk_data_type)    :: bulk
      logical :: is_whole = .false. !! false: a part of the deck is missing, so that references to it cannot be checked
      type(card_kind), allocatable :: kinds(:) !! of card, with their field tables
   end type deck_type

   abstract interface
      !> Stores the fields of CARD in entry CARD%I of its array of BULK.
      subroutine read_one(card, bulk)
         import :: bulk_data_type, card_fields_type
         type(card_fields_type), intent(inout) :: card
         type(bulk_data_type), intent(inout)   :: bulk
      end subroutine read_one
   end interface

   integer, parameter :: many_lines = 5000 ! length of a deck from which two threads pay

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
      call add(['BSURF  ', 'BSURFS ', 'BCPROP ', 'BCPROPS', 'BCRPARA'], read_region)
      cards%of_mesh = .true.
      call add(['BCTSET', 'BGSET '], read_pair)
      call add(['BCTADD'], read_sum)
      call add(['BGADD'], read_sum)
      call add(['BOLTFOR', 'BOLTSEQ'], read_preload)
      call add(['CELAS1', 'CELAS2', 'CELAS3', 'CELAS4', 'CBUSH ', 'CDAMP1', 'CDAMP2', 'CDAMP3', 'CDAMP4'], read_spring)
      call add(['PELAS', 'PBUSH', 'PDAMP'], read_spring_property)
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
         do cursor = 1, merge(size(bulk%matrices%dmig), 0, all(deck%control%matrices == ''))
            call bulk%ignored%add('DMIG')
         end do
         call fill_defaults(bulk)
         call count_unused(bulk)
         call bulk%ignored%settle(any(asked%modes%id /= 0), any(asked%modes%id /= 0 .and. asked%frequency%id > 0), &
                                  any(deck%control%stages%warms_materials), errors)
         if (is_alone) call take_only_sets(bulk, deck%control%stages(1), errors)
         call take_initial_temperature(deck%control%stages%initial, bulk, errors)
      end associate
      deck%is_whole = is_whole
   end subroutine read_lines

   !> Note where the cards from line CURSOR to ENDDATA begin. BULK counts all cards, also unknown ones and those without effect. Text
   !! behind ENDDATA has no effect. A second BEGIN makes their number -1.
   subroutine find_cards(text, cursor, cards, may_be_open, kind_at, bulk, errors)
      type(deck_text_type), intent(in)     :: text
      integer, intent(inout)               :: cursor
      type(card_kind), intent(inout)       :: cards(:)   !! the number of each kind
      logical, intent(in)                  :: may_be_open !! NASTRAN takes the deck without ENDDATA too
      integer(int16), intent(inout)        :: kind_at(:) !! (lines) kind of the card that begins there
      type(bulk_data_type), intent(inout)  :: bulk
      type(deck_error_list), intent(inout) :: errors
      integer(long) :: first, last
      integer :: at, comma, file
      integer :: ended_file ! file whose ENDDATA was read last, 1: the deck itself
      integer :: loose(2), n_loose(2) ! first line with text in columns 73 to 80, and past column 80; and their number
      logical :: is_open    ! a card may be continued

      ended_file = 0
      loose = 0
      n_loose = 0
      is_open = .false.
      do while (cursor <= text%n)
         at = cursor
         cursor = cursor + 1
         call text%find(at, file, first, last, comma)
         if (last < first) cycle
         if (ended_file == 1 .or. file == ended_file) then
            call bulk%ignored%add('text behind ENDDATA')
            do while (cursor <= text%n) ! once for each file
               if (ended_file /= 1 .and. text%file_number(cursor) /= ended_file) exit
               cursor = cursor + 1
            end do
            cycle
         end if
         associate (line => text%files(file)%bytes(first:last))
            if (len(line) > 72 .and. comma == 0) call watch_columns(line)
            if (is_continuation(line, comma)) then
               if (.not. is_open) call errors%add(at, 'a continuation line without a card before it')
               cycle
            end if
            is_open = .false.
            if (is_include(line)) cycle ! the lines of the file follow in the deck text
            if (card_name(line, comma) == 'ENDDATA') then
               ended_file = file
            else if (upper(line(:min(6, len(line)))) == 'BEGIN') then
               errors%n = 0
               call errors%add(at, 'a second BEGIN: there is one structure, without superelements; nothing of this deck is read')
               bulk%n_cards = -1
               return
            else
               is_open = .true.
               bulk%n_cards = bulk%n_cards + 1
               call find_card(line)
            end if
         end associate
      end do
      if (ended_file /= 1 .and. text%ends_whole .and. may_be_open) then
         call errors%warn('no ENDDATA: expected it after the last card; a deck that is cut off between two lines would look '// &
                          'the same')
      else if (ended_file /= 1) then
         call errors%add(0, 'no ENDDATA: the deck may be truncated; expected ENDDATA after the last card')
      end if
      if (n_loose(1) > 0) call errors%warn('text in columns 73 to 80 that is no continuation mark is not read: '// &
         plural(n_loose(1), 'line')//', the first '//text%place(loose(1)))
      if (n_loose(2) > 0) call errors%warn('text past column 80 is not read: '//plural(n_loose(2), 'line')//', the first '// &
                                           text%place(loose(2)))

   contains

      !> Note the text that is not read at the end of LINE, line AT.
      subroutine watch_columns(line)
         character(*), intent(in) :: line
         integer :: column, k

         column = loose_text(line, text%card_part(min(at + 1, text%n)))
         if (column == 0) return
         k = merge(1, 2, column == 73)
         n_loose(k) = n_loose(k) + 1
         if (loose(k) == 0) loose(k) = at
      end subroutine watch_columns

      !> Note the card that begins with LINE, line AT of TEXT; the first comma is in column COMMA, 0: none.
      subroutine find_card(line)
         character(*), intent(in) :: line
         type(card_type)       :: card
         type(deck_error_list) :: faults
         character(8) :: name
         integer :: behind, kind
         logical :: is_idle

         name = card_name(line, comma)
         call check_first_field(line, comma, at, faults)
         do kind = 1, size(cards) ! findloc would copy the names
            if (cards(kind)%name == name) exit
         end do
         if (kind <= size(cards) .and. .not. faults%any()) then
            kind_at(at) = int(kind, int16)
            cards(kind)%n = cards(kind)%n + 1
         else
            is_idle = .false.
            if (.not. faults%any()) call take_idle_card(trim(name), at, bulk%ignored, is_idle)
            if (is_idle) return
            behind = at
            call read_card(text, behind, card, errors) ! finds the other errors of the card
            if (card%name == 'CQUAD9') then
               call errors%add(card%line, 'CQUAD9 is a complete element of nine nodes; expected a CQUAD8, no node inside'// &
                               complete_remedy, 1, 8)
            else if (card%name /= '') then
               call errors%add(card%line, ''''//trim(card%name)//''' is not a card of jointfem; see input/cards.md', 1, 8)
            end if
         end if
      end subroutine find_card

   end subroutine find_cards

   !> Fill the arrays of BULK with the noted cards, in the order of the deck TEXT; errors go to ERRORS. The first routine, that of
   !! the nodes, reads about half of a long deck: one thread runs it, a second thread runs the others. The errors have the order of
   !! a serial run.
   subroutine read_all(text, kind_at, cards, bulk, errors)
      type(deck_text_type), intent(in)             :: text
      integer(int16), intent(in)                    :: kind_at(:)
      type(card_kind), intent(inout)               :: cards(:)
      type(bulk_data_type), intent(inout)          :: bulk
      type(deck_error_list), intent(inout), target :: errors
      type(deck_error_list), target :: others
      integer :: k

      !$omp parallel sections default(shared) if(text%n > many_lines)
      call read_by(1, errors)
      !$omp section
      do k = 2, size(cards)
         call read_by(k, others)
      end do
      !$omp end parallel sections
      if (allocated(others%warnings)) then
         do k = 1, size(others%warnings)
            call errors%warn(others%warnings(k)%words)
         end do
      end if
      do k = 1, others%n
         call errors%add(others%items(k)%line, others%items(k)%message, others%items(k)%first, others%items(k)%last)
      end do

   contains

      !> Read all cards of routine number ROUTINE.
      subroutine read_by(routine, errors)
         integer, intent(in)                          :: routine
         type(deck_error_list), intent(inout), target :: errors
         type(card_fields_type) :: card
         integer :: behind, left, line

         if (cards(routine)%routine /= routine) return ! another name in the line of a routine
         left = sum(cards%n, mask=cards%routine == routine)
         card%errors => errors
         do line = 1, size(kind_at)
            if (left == 0) exit
            if (kind_at(line) == 0) cycle
            associate (kind => cards(kind_at(line)))
               if (kind%routine /= routine) cycle
               behind = line
               call read_card(text, behind, card%card_type, errors)
               call move_alloc(kind%fields, card%names)
               call card%begin()
               call kind%read(card, bulk)
               call move_alloc(card%names, kind%fields)
            end associate
            left = left - 1
         end do
      end subroutine read_by

   end subroutine read_all

end module deck_input
