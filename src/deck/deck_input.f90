!> A deck: its text, its case control, its bulk data. Read in one go, all errors collected.
module deck_input
   use bulk_data, only: bulk_data_type
   use card_fields, only: card_values
   use card_lines, only: card_type
   use case_control, only: case_control_type, read_case_control
   use card_names, only: card_name, is_continuation
   use deck_cards, only: read_card
   use deck_errors, only: deck_error_list
   use deck_text, only: deck_text_of_bytes, deck_text_type, read_deck_text
   use element_cards, only: read_element
   use element_kinds, only: kind_hexa8, kind_penta6, kind_quad4, kind_tetra4, kind_tria3
   use include_lines, only: is_include
   use joint_cards, only: read_cjoint, read_jincr, read_jnorm, read_joint, read_jshear, read_pjoint
   use kinds, only: long
   use load_cards, only: read_force, read_load, read_spc, read_spc1, read_spcm
   use mesh_cards, only: read_block2, read_block3, read_cbar, read_crod, read_grid, read_pmark
   use property_cards, only: read_mat1, read_paxis, read_prod, read_pshell, read_psolid
   use surface_load_cards, only: read_bolt, read_forcem, read_grav, read_pload4, read_ploade, read_ploadm, read_spcd
   implicit none
   private

   public :: read_deck, read_deck_of_text

   type, public :: deck_type
      type(deck_text_type)    :: text
      type(case_control_type) :: control
      type(bulk_data_type)    :: bulk
      logical :: is_whole = .false. !! false: a part of the deck is missing, what refers to it cannot be checked
   end type deck_type

   ! every card, in alphabetical order (it is searched by halves); a new one is added here, to the select case below and to the
   ! room
   character(8), parameter :: known_cards(34) = [character(8) :: 'BLOCK2', 'BLOCK3', 'BOLT', 'CBAR', 'CHEXA', 'CJOINT', &
      'CPENTA', 'CQUAD4', 'CROD', 'CTETRA', 'CTRIA3', 'FORCE', 'FORCEM', 'GRAV', 'GRID', 'JINCR', 'JNORM', 'JOINT', 'JSHEAR', &
      'LOAD', 'MAT1', 'PAXIS', 'PJOINT', 'PLOAD4', 'PLOADE', 'PLOADM', 'PMARK', 'PROD', 'PSHELL', 'PSOLID', 'SPC', 'SPC1', &
      'SPCD', 'SPCM']
   character(8), parameter :: end_of_data = 'ENDDATA'
   integer, parameter :: line_is_card = 0, line_continues = 1, line_includes = 2, line_ends = 3

contains

   !> Read the deck PATH. READABLE is false where the file itself cannot be read; what is wrong in it goes to ERRORS.
   subroutine read_deck(path, deck, errors, readable)
      character(*), intent(in)             :: path
      type(deck_type), intent(out)         :: deck
      type(deck_error_list), intent(inout) :: errors
      logical, intent(out)                 :: readable

      call read_deck_text(path, deck%text, errors, readable)
      if (readable) call read_lines(deck, errors)
   end subroutine read_deck


   !> Read the deck whose file would hold these BYTES; what is wrong in it goes to ERRORS.
   subroutine read_deck_of_text(bytes, deck, errors)
      character(*), intent(in)             :: bytes
      type(deck_type), intent(out)         :: deck
      type(deck_error_list), intent(inout) :: errors

      call deck_text_of_bytes(bytes, deck%text, errors)
      call read_lines(deck, errors)
   end subroutine read_deck_of_text


   !> Case control and bulk data of the deck whose text is there.
   subroutine read_lines(deck, errors)
      type(deck_type), intent(inout)       :: deck
      type(deck_error_list), intent(inout) :: errors
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
      call make_room(deck%text, cursor, deck%bulk)
      call read_bulk_data(deck%text, cursor, deck%bulk, errors)
      deck%is_whole = is_whole
   end subroutine read_lines


   !> Count the cards by name and give every kind its room.
   subroutine make_room(text, first_line, bulk)
      type(deck_text_type), intent(in)    :: text
      integer, intent(in)                 :: first_line
      type(bulk_data_type), intent(inout) :: bulk
      integer(long) :: first, last
      integer :: counts(size(known_cards)), i, k, file, comma
      character(8) :: name, name_before

      counts = 0
      k = 0
      name_before = ''
      do i = first_line, text%n
         call text%find(i, file, first, last, comma)
         name = card_name(text%files(file)%bytes(first:last), comma)
         if (name == '        ') cycle
         if (name /= name_before) k = card_number(name) ! cards of a kind mostly stand together
         name_before = name
         if (k > 0) counts(k) = counts(k) + 1
      end do
      allocate (bulk%block2(number_of('BLOCK2')), bulk%cjoint(number_of('CJOINT')), bulk%block3(number_of('BLOCK3')))
      allocate (bulk%element(number_of('CQUAD4') + number_of('CTRIA3') + number_of('CHEXA') + number_of('CPENTA') + &
                             number_of('CTETRA')))
      allocate (bulk%paxis(number_of('PAXIS')), bulk%psolid(number_of('PSOLID')), bulk%prod(number_of('PROD')))
      allocate (bulk%pressure(number_of('PLOAD4') + number_of('PLOADE')), bulk%gravity(number_of('GRAV')))
      allocate (bulk%surface_load(number_of('PLOADM') + number_of('FORCEM')))
      allocate (bulk%displacement(2*number_of('SPCD')), bulk%bolt(number_of('BOLT')))
      allocate (bulk%edge(number_of('CBAR') + number_of('CROD')), bulk%force(number_of('FORCE')))
      allocate (bulk%grid(number_of('GRID')), bulk%jincr(number_of('JINCR')), bulk%jnorm(number_of('JNORM')))
      allocate (bulk%jshear(number_of('JSHEAR')))
      allocate (bulk%joint(number_of('JOINT')), bulk%load(number_of('LOAD')), bulk%mat1(number_of('MAT1')))
      allocate (bulk%pjoint(number_of('PJOINT')), bulk%pmark(number_of('PMARK')), bulk%pshell(number_of('PSHELL')))
      allocate (bulk%support(2*number_of('SPC') + number_of('SPC1') + number_of('SPCM')))

   contains

      pure integer function number_of(name)
         character(*), intent(in) :: name

         number_of = counts(card_number(name))
      end function number_of

   end subroutine make_room


   !> The place of NAME in the list of known cards, 0 for any other.
   pure integer function card_number(name) result(k)
      character(*), intent(in) :: name

      integer :: behind, middle

      k = 1
      behind = size(known_cards) + 1
      do while (behind - k > 1)
         middle = (k + behind)/2
         if (known_cards(middle) <= name) then
            k = middle
         else
            behind = middle
         end if
      end do
      if (known_cards(k) /= name) k = 0
   end function card_number


   !> All cards from line CURSOR to ENDDATA.
   subroutine read_bulk_data(text, cursor, bulk, errors)
      type(deck_text_type), intent(in)     :: text
      integer, intent(inout)               :: cursor
      type(bulk_data_type), intent(inout)  :: bulk
      type(deck_error_list), intent(inout) :: errors
      type(card_type)   :: card
      type(card_values) :: values
      integer(long) :: first, last
      integer :: file, comma
      integer :: ended_file ! the file whose ENDDATA was read last, 1 the deck itself

      ended_file = 0
      do while (cursor <= text%n)
         call text%find(cursor, file, first, last, comma)
         if (last < first) then
            cursor = cursor + 1
         else if (ended_file == 1 .or. file == ended_file) then
            call errors%add(cursor, 'text after ENDDATA')
            if (ended_file == 1) return
            do while (cursor <= text%n) ! the rest of this file cannot be meant
               if (text%file_number(cursor) /= ended_file) exit
               cursor = cursor + 1
            end do
         else
            select case (meaning(text%files(file)%bytes(first:last), comma))
            case (line_continues)
               call errors%add(cursor, 'a continuation line without a card before it')
               cursor = cursor + 1
            case (line_includes)
               cursor = cursor + 1     ! its lines follow in the deck text
            case (line_ends)
               ended_file = file
               call check_rest_of_line(text%card_part(cursor), cursor, errors)
               cursor = cursor + 1
            case default
               call read_card(text, cursor, card, errors)
               bulk%n_cards = bulk%n_cards + 1
               call dispatch(card, bulk, values, errors)
            end select
         end if
      end do
      if (ended_file /= 1) call errors%add(0, 'no ENDDATA: the deck ends before its end, is it whole?')
   end subroutine read_bulk_data


   !> What LINE is, as a card may begin there; its first comma is in column COMMA.
   pure integer function meaning(line, comma)
      character(*), intent(in) :: line
      integer, intent(in)      :: comma

      if (is_continuation(line, comma)) then
         meaning = line_continues
      else if (is_include(line)) then
         meaning = line_includes
      else if (card_name(line, comma) == end_of_data) then
         meaning = line_ends
      else
         meaning = line_is_card
      end if
   end function meaning


   subroutine check_rest_of_line(line, at, errors)
      character(*), intent(in)             :: line
      integer, intent(in)                  :: at
      type(deck_error_list), intent(inout) :: errors
      character(:), allocatable :: words

      words = trim(adjustl(line))
      if (len(words) > 7) call errors%add(at, 'text behind ENDDATA', len(line) - len(words) + 8, len(line))
   end subroutine check_rest_of_line


   !> Hand a card to its routine.
   subroutine dispatch(card, bulk, values, errors)
      type(card_type), intent(in)          :: card
      type(bulk_data_type), intent(inout)  :: bulk
      type(card_values), intent(inout)     :: values
      type(deck_error_list), intent(inout) :: errors

      select case (card%name)
      case ('BLOCK2'); call read_block2(card, bulk, values, errors)
      case ('BLOCK3'); call read_block3(card, bulk, values, errors)
      case ('BOLT');   call read_bolt(card, bulk, values, errors)
      case ('CBAR');   call read_cbar(card, bulk, values, errors)
      case ('CHEXA');  call read_element(card, kind_hexa8, bulk, values, errors)
      case ('CJOINT'); call read_cjoint(card, bulk, values, errors)
      case ('CPENTA'); call read_element(card, kind_penta6, bulk, values, errors)
      case ('CQUAD4'); call read_element(card, kind_quad4, bulk, values, errors)
      case ('CROD');   call read_crod(card, bulk, values, errors)
      case ('CTETRA'); call read_element(card, kind_tetra4, bulk, values, errors)
      case ('CTRIA3'); call read_element(card, kind_tria3, bulk, values, errors)
      case ('FORCE');  call read_force(card, bulk, values, errors)
      case ('FORCEM'); call read_forcem(card, bulk, values, errors)
      case ('GRAV');   call read_grav(card, bulk, values, errors)
      case ('GRID');   call read_grid(card, bulk, values, errors)
      case ('JINCR');  call read_jincr(card, bulk, values, errors)
      case ('JNORM');  call read_jnorm(card, bulk, values, errors)
      case ('JOINT');  call read_joint(card, bulk, values, errors)
      case ('JSHEAR'); call read_jshear(card, bulk, values, errors)
      case ('LOAD');   call read_load(card, bulk, values, errors)
      case ('MAT1');   call read_mat1(card, bulk, values, errors)
      case ('PAXIS');  call read_paxis(card, bulk, values, errors)
      case ('PJOINT'); call read_pjoint(card, bulk, values, errors)
      case ('PLOAD4'); call read_pload4(card, bulk, values, errors)
      case ('PLOADE'); call read_ploade(card, bulk, values, errors)
      case ('PLOADM'); call read_ploadm(card, bulk, values, errors)
      case ('PMARK');  call read_pmark(card, bulk, values, errors)
      case ('PROD');   call read_prod(card, bulk, values, errors)
      case ('PSHELL'); call read_pshell(card, bulk, values, errors)
      case ('PSOLID'); call read_psolid(card, bulk, values, errors)
      case ('SPC');    call read_spc(card, bulk, values, errors)
      case ('SPC1');   call read_spc1(card, bulk, values, errors)
      case ('SPCD');   call read_spcd(card, bulk, values, errors)
      case ('SPCM');   call read_spcm(card, bulk, values, errors)
      case ('') ! said already
         return
      case default
         call errors%add(card%line, ''''//trim(card%name)//''' is no card that jointfem knows; see input/README.md', 1, 8)
      end select
   end subroutine dispatch

end module deck_input
