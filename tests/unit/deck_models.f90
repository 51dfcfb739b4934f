!> Decks and models from text in memory, and some models for tests of the solvers.
module deck_models
   use deck_errors, only: deck_error_list
   use deck_input, only: deck_type, read_deck_of_text
   use kinds, only: wp
   use model_build, only: build_model
   use model_data, only: model_type
   use stage_plan, only: stage_plan_type
   implicit none
   private

   public :: read_lines, read_cards, build, model_of_cards, sample_cards, some_forces, some_stiffnesses

   character(*), parameter, public :: plane_laws = 'MAT1,1,9500.,,.25;PSHELL,1,1,20.;PJOINT,1,3,,,,,.1;JNORM,3,8.-3,.5,50.;'
   character(*), parameter, public :: solid_laws = 'MAT1,1,9500.,,.25;PSOLID,1,1;PJOINT,1,3,,,,,.1;JNORM,3,8.-3,.5,50.;'

   !> Two blocks on an inclined joint, the lower one held at two nodes, a second joint to the base on the right; 180 nodes.
   character(*), parameter, public :: two_plane_blocks = plane_laws//'SPC1,1,12,103;SPC1,1,1,101;'// &
      'BLOCK2,1,1,11,7,0.,0.,3.,0.;+,3.,2.,0.,1.,,,101,101;+,,,21;PMARK,21;'// &
      'BLOCK2,2,1,11,6,0.,1.,3.,2.;+,3.,3.,0.,3.,,,1,1;+,20,22;PMARK,20;PMARK,22;JOINT,8,1,22;JOINT,7,1,20,21'

   !> Two boxes on each other and on the base, held by these joints alone, two bars through them; 195 nodes.
   character(*), parameter, public :: two_floating_boxes = solid_laws// &
      'BLOCK3,1,1,4,3,4,0.,0.,0.;+,40.,30.,20.,,,,1001,1001;+,,,,,20,21;BLOCK3,2,1,4,3,4,0.,0.,20.;+,40.,30.,50.;+,,,,,22;'// &
      'PMARK,20;PMARK,21;PMARK,22;JOINT,8,1,20;JOINT,7,1,21,22;CROD,3001,9,1023,25;CROD,3002,9,1083,88;PROD,9,1,30.'

   !> A box on the base, a part of it held so that elements have no free component at all, one marked side moved sideways.
   character(*), parameter, public :: box_partly_held = solid_laws//'BLOCK3,1,1,5,3,3,0.,0.,0.;+,50.,30.,30.;+,23,24,,,20;'// &
      'PMARK,20;PMARK,23;PMARK,24;JOINT,8,1,20;SPC1,1,123,1,THRU,40;SPCM,1,2,24'

   !> A plate without a joint.
   character(*), parameter, public :: plate = plane_laws//'BLOCK2,1,1,12,9,0.,0.;+,12.,5.;+,20;PMARK,20;SPCM,1,2,20;SPC1,1,1,3'

   !> A long low plate with its bottom on the base: joints last in parts; 305 nodes.
   character(*), parameter, public :: low_plate = plane_laws//'BLOCK2,1,1,60,4,0.,0.;+,300.,100.;+,20;PMARK,20;'// &
      'JOINT,8,1,20;SPC1,1,1,1'

contains

   !> The deck with these LINES; a semicolon ends a line.
   subroutine read_lines(lines, deck, errors)
      character(*), intent(in)           :: lines
      type(deck_type), intent(out)       :: deck
      type(deck_error_list), intent(out) :: errors
      character(len(lines)) :: bytes
      integer :: i

      do i = 1, len(lines)
         bytes(i:i) = merge(new_line('a'), lines(i:i), lines(i:i) == ';')
      end do
      call read_deck_of_text(bytes, deck, errors)
   end subroutine read_lines

   !> The deck with these CARDS and one stage.
   subroutine read_cards(cards, deck, errors)
      character(*), intent(in)           :: cards
      type(deck_type), intent(out)       :: deck
      type(deck_error_list), intent(out) :: errors

      call read_lines('SUBCASE 1;BEGIN BULK;'//cards//';ENDDATA', deck, errors)
   end subroutine read_cards

   !> The model, and the plan, of the deck with these LINES.
   subroutine build(lines, model, errors, plan)
      character(*), intent(in)           :: lines
      type(model_type), intent(out)      :: model
      type(deck_error_list), intent(out) :: errors
      type(stage_plan_type), intent(out), optional :: plan
      type(deck_type)       :: deck
      type(stage_plan_type) :: own_plan

      call read_lines(lines, deck, errors)
      call build_model(deck, model, own_plan, errors)
      if (present(plan)) plan = own_plan
   end subroutine build

   !> The model with these CARDS and one stage. PROBLEM: the first error, '' where there is none.
   subroutine model_of_cards(cards, model, problem)
      character(*), intent(in)               :: cards
      type(model_type), intent(out)          :: model
      character(:), allocatable, intent(out) :: problem
      type(deck_error_list) :: errors

      call build(trim(merge('SPC=1;', '      ', index(cards, 'SPC') > 0))//'SUBCASE 1;BEGIN BULK;'//cards//';ENDDATA', &
                 model, errors)
      problem = ''
      if (errors%n > 0) problem = errors%items(1)%message
      if (errors%n == 0 .and. index(cards, 'JSHEAR') == 0) then ! for some_stiffnesses, which act along all axes
         model%joints%list%law%shear(1)%given = .true.
         model%joints%list%law%shear(2)%given = .true.
      end if
   end subroutine model_of_cards

   !> The cards of sample model WHICH, 1 to 5 in the order above.
   pure function sample_cards(which) result(cards)
      integer, intent(in)       :: which
      character(:), allocatable :: cards

      if (which == 1) cards = two_plane_blocks
      if (which == 2) cards = two_floating_boxes
      if (which == 3) cards = box_partly_held
      if (which == 4) cards = plate
      if (which == 5) cards = low_plate
   end function sample_cards

   !> Forces on every component of every node, between -1/2 and 1/2 times 1000.
   pure function some_forces(model) result(f)
      type(model_type), intent(in) :: model
      real(wp) :: f(model%mesh%dimension, model%mesh%n_nodes)
      integer  :: d, i

      do i = 1, model%mesh%n_nodes
         do d = 1, model%mesh%dimension
            f(d, i) = 1000.0_wp*(modulo(0.37_wp*(3*i + d)**2, 1.0_wp) - 0.5_wp)
         end do
      end do
   end function some_forces

   !> Stiffnesses of all interface elements, positive definite, the directions coupled; another set for every SEED.
   pure function some_stiffnesses(model, seed) result(k_int)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: seed
      real(wp) :: k_int(3, 3, size(model%joints%element))
      integer  :: i

      do i = 1, size(model%joints%element)
         k_int(:, :, i) = reshape([3.0_wp, 0.5_wp, -0.7_wp, 0.5_wp, 2.0_wp, 0.4_wp, -0.7_wp, 0.4_wp, 5.0_wp], [3, 3]) &
                          *1.0e3_wp*(1 + modulo(3*i + seed, 5))
      end do
   end function some_stiffnesses

end module deck_models
