!> Finds errors between cards that have been read: repeated numbers, missing laws of joints, wrong references.
module deck_check
   use bulk_data, only: bulk_data_type, rigid_card
   use case_control, only: case_control_type
   use deck_cards, only: add_field_error, card_name
   use deck_errors, only: deck_error_list
   use card_kinds, only: card_kind
   use deck_input, only: deck_type
   use deck_text, only: deck_text_type
   use field_rules, only: number_of
   use lists, only: id_table_type, sorted_order
   use text_tools, only: integer_text, one_of
   implicit none
   private

   ! cards of NX, which other cards stand for in the model
   character(8), parameter :: of_nx(7) = [character(8) :: 'BCTSET', 'BGSET', 'BOLT', 'BSURF', 'BSURFS', 'BCPROP', 'BCPROPS']

   !> The parts of a deck, and the list of its errors.
   type, public :: checked_deck
      type(deck_text_type), pointer     :: text => null()
      type(case_control_type), pointer  :: control => null()
      type(bulk_data_type), pointer     :: bulk => null()
      type(deck_error_list), pointer    :: errors => null()
      type(card_kind), pointer, private :: kinds(:) => null()
      type(rigid_card), allocatable     :: rigid(:) !! those of BULK; nodes of marked surfaces are added when known
      integer :: stage = 1                     !! position of the stage whose supports and equations are built
      logical :: keeps_distances = .false.     !! MPC: a history in which they change
   contains
      procedure :: start
      procedure, private :: kind_of_line, named_field_error, numbered_field_error
      generic :: field_error => named_field_error, numbered_field_error
      procedure :: card_on
      procedure :: shares
      procedure :: check_ids
      procedure :: mesh_is_faulty
      procedure :: report_repeated
   end type checked_deck

contains

   !> Begin the check of DECK; errors go to ERRORS. Both must outlive SELF.
   subroutine start(self, deck, errors)
      class(checked_deck), intent(inout)           :: self
      type(deck_type), intent(in), target          :: deck
      type(deck_error_list), intent(inout), target :: errors

      self%text => deck%text
      self%control => deck%control
      self%bulk => deck%bulk
      self%kinds => deck%kinds
      self%errors => errors
      allocate (self%rigid(0))
      if (allocated(deck%bulk%rigid)) self%rigid = deck%bulk%rigid
   end subroutine start

   !> Whether the stage at position S has the supports and equations that are built.
   elemental logical function shares(self, s)
      class(checked_deck), intent(in) :: self
      integer, intent(in)             :: s

      associate (stages => self%control%stages)
         shares = stages(s)%supports%id == stages(self%stage)%supports%id .and. &
                  stages(s)%equations%id == stages(self%stage)%equations%id
      end associate
   end function shares

   !> Kind of the card that begins on LINE.
   integer function kind_of_line(self, line) result(kind)
      class(checked_deck), intent(in) :: self
      integer, intent(in)             :: line

      kind = findloc(self%kinds%name, card_name(self%text%card_part(line)), dim=1)
   end function kind_of_line

   !> The name of the card that begins on LINE, as the user wrote it.
   function card_on(self, line) result(name)
      class(checked_deck), intent(in) :: self
      integer, intent(in)             :: line
      character(:), allocatable       :: name

      name = trim(card_name(self%text%card_part(line)))
   end function card_on

   !> Add an error about the field FIELD of the card that begins on LINE.
   subroutine named_field_error(self, line, field, message, called)
      class(checked_deck), intent(in)    :: self
      integer, intent(in)                :: line
      character(*), intent(in)           :: field, message
      character(*), intent(in), optional :: called !! name in the message, default: FIELD

      integer :: k

      k = self%kind_of_line(line)
      associate (kind => self%kinds(k))
         if (any(kind%name == of_nx) .and. all(kind%fields /= field)) then ! of the card that it stands for
            call self%errors%add(line, field//': '//message)
         else
            call self%field_error(line, number_of(kind%fields, field), message, called)
         end if
      end associate
   end subroutine named_field_error

   !> Add an error about data field K. NOUN, a word for the entry, precedes the name.
   subroutine numbered_field_error(self, line, k, message, called, noun)
      class(checked_deck), intent(in)    :: self
      integer, intent(in)                :: line, k
      character(*), intent(in)           :: message
      character(*), intent(in), optional :: called !! name in the message; required beyond the table of fields
      character(*), intent(in), optional :: noun
      character(:), allocatable :: name
      integer :: kind

      if (present(called)) then
         name = called
      else
         name = 'ID' ! of a card that is a list of numbers
         kind = self%kind_of_line(line)
         if (k <= size(self%kinds(kind)%fields)) name = trim(self%kinds(kind)%fields(k))
      end if
      if (present(noun)) name = noun//' '//name
      call add_field_error(self%text, line, k, name, message, self%errors)
   end subroutine numbered_field_error

   !> Find repeated ids of the kinds with few cards, and missing laws of joints. Properties and PMARK share their ids.
   subroutine check_ids(self)
      class(checked_deck), intent(in) :: self
      integer :: before, i

      associate (bulk => self%bulk)
         call self%report_repeated('property', [bulk%pshell%id, bulk%paxis%id, bulk%psolid%id, bulk%prod%id, bulk%pmark%id], &
                              [bulk%pshell%line, bulk%paxis%line, bulk%psolid%line, bulk%prod%line, bulk%pmark%line])
         call self%report_repeated('PBAR or PBARL', bulk%beam_property%id, bulk%beam_property%line)
         call self%report_repeated('MAT1', bulk%mat1%id, bulk%mat1%line)
         call self%report_repeated('LOAD', bulk%load%set, bulk%load%line)
         associate (plane => bulk%block%dimension == 2)
            call self%report_repeated('BLOCK2', pack(bulk%block%id, plane), pack(bulk%block%line, plane))
            call self%report_repeated('BLOCK3', pack(bulk%block%id, .not. plane), pack(bulk%block%line, .not. plane))
         end associate
         call self%report_repeated('BOLT', bulk%bolt%id, bulk%bolt%line)
         call self%report_repeated('NODEAT', bulk%place%id, bulk%place%line)
         call self%report_repeated('JOINT', bulk%joint%id, bulk%joint%line)
         call self%report_repeated('PJOINT', bulk%pjoint%id, bulk%pjoint%line)
         call self%report_repeated('JNORM', bulk%jnorm%id, bulk%jnorm%line)
         call self%report_repeated('JSHEAR', bulk%jshear%id, bulk%jshear%line)
         call self%report_repeated('JIWAN', bulk%jiwan%id, bulk%jiwan%line)
         call self%report_repeated('JGAP of joint', bulk%jgap%joint, bulk%jgap%line)
         call self%report_repeated('JINCR', bulk%jincr%id, bulk%jincr%line)
         call self%report_repeated('EIGRL', bulk%eigrl%id, bulk%eigrl%line)
         call self%report_repeated('JAMPL', bulk%jampl%id, bulk%jampl%line)
         call self%report_repeated('TABDMP1', bulk%tabdmp1%id, bulk%tabdmp1%line)
         do i = 1, size(bulk%joint)
            call check_reference(bulk%joint(i)%line, 'PJID', bulk%joint(i)%law, 'PJOINT', bulk%pjoint%id)
         end do
         before = 0 ! neighbours with the same law give one error
         do i = 1, size(bulk%cjoint)
            if (bulk%cjoint(i)%law /= before) &
               call check_reference(bulk%cjoint(i)%line, 'PJID', bulk%cjoint(i)%law, 'PJOINT', bulk%pjoint%id)
            before = bulk%cjoint(i)%law
         end do
         do i = 1, size(bulk%pjoint)
            associate (card => bulk%pjoint(i))
               call check_reference(card%line, 'SIDX', card%shear_laws(1), 'JSHEAR', bulk%jshear%id)
               call check_reference(card%line, 'SIDY', card%shear_laws(2), 'JSHEAR', bulk%jshear%id)
               call check_reference(card%line, 'IID', card%iwan_law, 'JIWAN', bulk%jiwan%id)
               call check_reference(card%line, 'NID', card%normal_law, 'JNORM', bulk%jnorm%id)
            end associate
         end do
      end associate

   contains

      !> Report that FIELD of the card on LINE names a card that is not among those with the numbers IDS; ID is 0 where the field is
      !! blank or could not be read.
      subroutine check_reference(line, field, id, card, ids)
         integer, intent(in)      :: line, id, ids(:)
         character(*), intent(in) :: field, card

         if (id > 0 .and. all(ids /= id)) call self%field_error(line, field, 'there is no '//card//' '//integer_text(id))
      end subroutine check_reference

   end subroutine check_ids

   !> Whether an error so far concerns the cards of the mesh: then nothing that depends on the mesh can be built.
   logical function mesh_is_faulty(self) result(is_faulty)
      class(checked_deck), intent(in) :: self
      character(8) :: name
      integer :: i, line

      is_faulty = .false.
      do i = 1, self%errors%n
         name = ''
         do line = self%errors%items(i)%line, 1, -1 ! back from a continuation to its card
            name = card_name(self%text%card_part(line))
            if (name /= '') exit
         end do
         is_faulty = any(self%kinds%of_mesh .and. self%kinds%name == name)
         if (is_faulty) return
      end do
   end function mesh_is_faulty

   !> Report the repeated numbers among ID(n), given on the cards of LINE(n). A card with many numbers is reported once.
   subroutine report_repeated(self, noun, id, line, n_cards)
      class(checked_deck), intent(in) :: self
      character(*), intent(in)       :: noun    !! what the numbers identify
      integer, intent(in)            :: id(:), line(:)
      integer, intent(in), optional  :: n_cards !! cards with their number in data field 1; the others are blocks, with
                                                !! nodes from N1 and elements from E1; default: all
      type(id_table_type)  :: table
      integer, allocatable :: again(:), order(:)
      integer :: k, last_card
      logical :: has_more
      character(:), allocatable :: words

      words = ''
      last_card = size(id)
      if (present(n_cards)) last_card = n_cards
      call table%build(id)
      call table%list_repeated(again)
      call sorted_order(line(again), order)
      again = again(order)
      associate (lines => line(again))
         do k = 1, size(again)
            if (id(again(k)) == 0 .or. any(lines(max(1, k - 1):k - 1) == lines(k))) cycle ! unreadable, or reported
            has_more = any(lines(k + 1:min(k + 1, size(lines))) == lines(k))
            words = noun//' '//integer_text(id(again(k)))//one_of(has_more, ', and more of this card,', '')// &
                    ' is given twice, first in '//self%text%place(line(table%find(id(again(k)))))
            if (again(k) > last_card) then
               call self%field_error(lines(k), merge('N1', 'E1', noun == 'node'), words)
            else
               call self%field_error(lines(k), 1, words)
            end if
         end do
      end associate
   end subroutine report_repeated

end module deck_check
