!> Contact, glue and bolts of NX as joints, ties and bolts of this program: cards JOINT, PJOINT, JGAP, PMARK and BOLT, and stages that
!! tighten the bolts, are added to those of the deck. The parts of the model are made from them as from other cards.
module nx_translation
   use bulk_data, only: bolt_card, bulk_data_type, jgap_card, jnorm_card, joint_card, jshear_card, pjoint_card, pmark_card
   use case_entries, only: set_reference
   use control_words, only: method_newton
   use deck_errors, only: deck_error_list
   use deck_input, only: deck_type
   use kinds, only: wp
   use lists, only: sorted_order
   use stage_entries, only: stage_type, vibration_entries_type
   use support_build, only: summed_sets
   use text_tools, only: integer_text, one_of, real_text, text_item, upper
   use unit_watch, only: find_units
   implicit none
   private

   public :: translate_contacts

   ! the law of contacts without PJOINT: ground steel S45C (Ito, Modular Design for Machine Tools, Table 6-5), with the shear
   ! stiffness that Mindlin's ratio 2 (1 - nu)/(2 - nu), nu = 0.3, gives for the slope of the normal law at 25 kgf/cm2
   real(wp), parameter :: default_c = 4.6e-8_wp, default_m = 0.48_wp             ! [m/MPa^m]
   real(wp), parameter :: default_e_u = 2.1659e14_wp, default_a11 = 5.9e13_wp    ! [N/m3]

contains

   !> Add to DECK the cards and stages that its contact, glue and bolts of NX stand for; what is wrong goes to ERRORS.
   subroutine translate_contacts(deck, errors)
      type(deck_type), intent(inout)       :: deck
      type(deck_error_list), intent(inout) :: errors
      integer :: before

      if (.not. allocated(deck%bulk%pair)) return
      allocate (deck%bulk%told(0))
      if (size(deck%bulk%pair) > 0) call join_regions(deck, errors)
      if (any(deck%bulk%bolt%kind > 0) .or. any(deck%control%stages%bolts%id > 0)) call tighten_bolts(deck, errors)
      before = size(deck%bulk%told)
      if (before == 0 .or. deck%control%method_is_given) return
      deck%control%method = method_newton
      deck%bulk%told = [text_item('contact and bolts of NX: METHOD = NEWTON, since the deck gives no METHOD'), deck%bulk%told]
   end subroutine translate_contacts

   !> The active pairs of BCTSET and BGSET as JOINT cards, those of glue last.
   subroutine join_regions(deck, errors)
      type(deck_type), intent(inout), target :: deck
      type(deck_error_list), intent(inout)   :: errors
      integer, allocatable :: sets(:)
      integer :: i, k, kind, law, n_joints, r(2)

      call check_control(deck, errors)
      associate (bulk => deck%bulk, stage => deck%control%stages(1))
         n_joints = maxval([0, bulk%joint%id])
         do kind = 1, 2 ! contact, glue
            if (kind == 1) sets = summed_sets(bulk%contact_sum, stage%contact%id)
            if (kind == 2) sets = summed_sets(bulk%glue_sum, stage%glue%id)
            do i = 1, size(bulk%pair)
               associate (pair => bulk%pair(i))
                  if (pair%is_glue .neqv. kind == 2) cycle
                  if (all(sets /= pair%set) .or. sets(1) == 0) then
                     call bulk%ignored%add(one_of(kind == 2, 'BGSET', 'BCTSET'))
                     cycle
                  end if
                  do k = 1, size(pair%regions, 2)
                     r = [mark(pair%regions(1, k)), mark(pair%regions(2, k))]
                     if (any(r == 0)) cycle
                     if (kind == 1) then
                        n_joints = n_joints + 1
                        call find_law(deck, pair%mu(k), law)
                        bulk%joint = [bulk%joint, joint_card(line=pair%line, id=n_joints, law=law, sides=r, &
                                                             tolerance=pair%reach(k))]
                        if (all(bulk%touching /= pair%set)) bulk%jgap = [bulk%jgap, jgap_card(line=pair%line, joint=n_joints, &
                           kind='TRUE', node=[integer ::], x=reshape([real(wp) ::], [3, 0]), gap=[real(wp) ::], at=[integer ::])]
                        call tell('contact', k, ': JOINT '//integer_text(n_joints)//', PJOINT '//integer_text(law)// &
                                  one_of(pair%mu(k) > 0.0_wp, ', MU '//real_text(pair%mu(k)), ''))
                     else
                        bulk%joint = [bulk%joint, joint_card(line=pair%line, sides=r, tolerance=pair%reach(k), is_glued=.true.)]
                        call tell('glue', k, ': tied')
                     end if
                  end do
               end associate
            end do
         end do
      end associate

   contains

      !> The PMARK of the region ID, which is added where it is new; 0, and an error: there is no such region.
      integer function mark(id)
         integer, intent(in) :: id
         integer :: s

         mark = 0
         associate (bulk => deck%bulk, line => deck%bulk%pair(i)%line)
            s = findloc(bulk%region%id, id, dim=1)
            if (s == 0 .and. any(bulk%pmark%id == id)) mark = id ! a marked surface is a region too
            if (s == 0) then
               if (id > 0 .and. mark == 0) call errors%add(line, 'there is no BSURF, BSURFS, BCPROP or BCPROPS '//integer_text(id))
               return
            end if
            if (count(bulk%region%id == id) > 1) then
               call errors%add(line, 'region '//integer_text(id)//' is given more than once')
               return
            end if
            if (bulk%region(s)%surface == 0) then
               bulk%region(s)%surface = free_mark(bulk, id)
               bulk%pmark = [bulk%pmark, pmark_card(line=bulk%region(s)%line, id=bulk%region(s)%surface)]
               bulk%region(s)%is_bottom = any(bulk%region_side%id == id .and. bulk%region_side%is_bottom)
            end if
            mark = bulk%region(s)%surface
         end associate
      end function mark

      subroutine tell(what, k, words)
         character(*), intent(in) :: what, words
         integer, intent(in)      :: k

         associate (regions => deck%bulk%pair(i)%regions(:, k))
            deck%bulk%told = [deck%bulk%told, text_item(what//' of regions '//integer_text(regions(1))//' and '// &
               integer_text(regions(2))//', surfaces '//integer_text(r(1))//' and '//integer_text(r(2))//words)]
         end associate
      end subroutine tell

   end subroutine join_regions

   !> Errors of BCSET and BGSET: missing sets, and sets that differ between stages.
   subroutine check_control(deck, errors)
      type(deck_type), intent(in)          :: deck
      type(deck_error_list), intent(inout) :: errors

      associate (pair => deck%bulk%pair, stages => deck%control%stages)
         call check('BCSET', stages%contact, [pack(pair%set, .not. pair%is_glue), deck%bulk%contact_sum%set], 'BCTSET or BCTADD')
         call check('BGSET', stages%glue, [pack(pair%set, pair%is_glue), deck%bulk%glue_sum%set], 'BGSET or BGADD')
      end associate

   contains

      subroutine check(key, asked, known, cards)
         character(*), intent(in)        :: key, cards
         type(set_reference), intent(in) :: asked(:) !! of the stages
         integer, intent(in)             :: known(:)

         if (any(asked%id /= asked(1)%id)) call errors%add(maxval(asked%line), &
            key//': all stages must have the same set; give '//key//' above the first SUBCASE')
         if (asked(1)%id > 0 .and. all(known /= asked(1)%id)) call errors%add(asked(1)%line, &
            key//': there is no '//cards//' with set '//integer_text(asked(1)%id))
      end subroutine check

   end subroutine check_control

   !> A number for a PMARK: ID, where no property and no PMARK has it, else the next above all.
   pure integer function free_mark(bulk, id) result(number)
      type(bulk_data_type), intent(in) :: bulk
      integer, intent(in)              :: id

      associate (used => [bulk%pshell%id, bulk%paxis%id, bulk%psolid%id, bulk%prod%id, bulk%beam_property%id, bulk%pmark%id])
         number = id
         if (id == 0 .or. any(used == id)) number = maxval([used, bulk%region%id, 0]) + 1
      end associate
   end function free_mark

   !> The LAW, a PJOINT, of a contact with friction MU: the first of the deck, or of the file of --law, with this MU where it is above 0;
   !! else that of ground steel.
   subroutine find_law(deck, mu, law)
      type(deck_type), intent(inout) :: deck
      real(wp), intent(in)           :: mu
      integer, intent(out)           :: law
      type(pjoint_card) :: card
      logical :: is_default
      integer :: i

      associate (bulk => deck%bulk)
         is_default = deck%default_law > 0
         if (size(bulk%pjoint) == 0) call add_default_law(deck)
         is_default = deck%default_law > 0
         card = bulk%pjoint(1)
         if (mu > 0.0_wp .and. .not. (card%mu_given .and. abs(card%mu - mu) <= 0.0_wp)) then
            card%mu = mu
            card%mu_given = .true.
            if (is_default) card%shear_laws = deck%default_law
            i = findloc(bulk%pjoint%normal_law == card%normal_law .and. bulk%pjoint%mu_given .and. &
                        abs(bulk%pjoint%mu - mu) <= 0.0_wp, .true., dim=1)
            if (i == 0) then
               card%id = maxval(bulk%pjoint%id) + 1
               bulk%pjoint = [bulk%pjoint, card]
            else
               card = bulk%pjoint(i)
            end if
         end if
         law = card%id
      end associate
   end subroutine find_law

   !> Add PJOINT, JNORM and JSHEAR of ground steel in the units of the deck: those of UNITS, else those in which E is that of a metal.
   subroutine add_default_law(deck)
      type(deck_type), intent(inout) :: deck
      type(jnorm_card)  :: jnorm
      type(jshear_card) :: jshear
      character(:), allocatable :: units
      real(wp) :: e, metre, newton
      integer  :: id

      associate (bulk => deck%bulk)
         call find_units(deck%control, metre, newton)
         units = 'of UNITS'
         if (.not. (metre > 0.0_wp .and. newton > 0.0_wp)) then
            e = maxval([0.0_wp, bulk%mat1%e])
            newton = merge(4.4482216_wp, 1.0_wp, e > 1.5e6_wp .and. e < 1.0e9_wp)
            metre = merge(0.0254_wp, merge(1.0_wp, 1.0e-3_wp, e >= 1.0e9_wp), newton > 2.0_wp)
            units = 'taken as '//one_of(newton > 2.0_wp, 'IN, LBF', one_of(e >= 1.0e9_wp, 'M, N', 'MM, N'))//' by E'
         end if
         id = maxval([0, bulk%jnorm%id, bulk%jshear%id]) + 1
         deck%default_law = id
         jnorm%id = id
         jnorm%law%c = default_c/metre*(newton/metre**2*1.0e-6_wp)**default_m
         jnorm%law%m = default_m
         jnorm%law%e_u = default_e_u*metre**3/newton
         jnorm%e_u_given = .true.
         jshear%id = id
         jshear%law%given = .true.
         jshear%law%load%coefficients(1, 1) = default_a11*metre**3/newton
         jshear%law%unload = jshear%law%load
         jshear%law%reload = jshear%law%load
         bulk%jnorm = [bulk%jnorm, jnorm]
         bulk%jshear = [bulk%jshear, jshear]
         bulk%pjoint = [pjoint_card(id=1, normal_law=id)]
         bulk%told = [bulk%told, text_item('contacts have the default law, ground steel: lambda = C p^M with C = '// &
            real_text(jnorm%law%c)//', M = '//real_text(jnorm%law%m)//', EU = '//real_text(jnorm%law%e_u)// &
            '; with friction A11 = '//real_text(jshear%law%load%coefficients(1, 1))//'; units '//units// &
            '; --law FILE gives another law')]
      end associate
   end subroutine add_default_law

   !> The preloads of BOLTFOR, in the order of BOLTSEQ, in a stage of their own before the first: bolts are locked before other loads
   !! come. A first SUBCASE with BOLTLD and without loads is this stage. All other stages start from its end, as NX solves them.
   subroutine tighten_bolts(deck, errors)
      type(deck_type), intent(inout)       :: deck
      type(deck_error_list), intent(inout) :: errors
      type(stage_type), allocatable :: before(:)
      type(set_reference)  :: asked
      integer, allocatable :: order(:), sets(:)
      integer :: k, n, s

      associate (bulk => deck%bulk, control => deck%control)
         s = findloc(control%stages%bolts%id > 0, .true., dim=1)
         if (s > 0) then
            asked = control%stages(s)%bolts
            sets = [asked%id]
            k = findloc(bulk%sequence%set, asked%id, dim=1)
            if (k > 0) then
               call sorted_order(bulk%sequence(k)%order, order)
               sets = bulk%sequence(k)%sets(order)
            end if
            n = size(sets)
            if (s > 1 .or. any(control%stages%bolts%id > 0 .and. control%stages%bolts%id /= asked%id)) call errors%add(asked%line, &
               'BOLTLD: expected one set for all SUBCASEs, above the first or in the first')
            if (n > 1 .or. control%stages(1)%load%id > 0 .or. count(control%stages%bolts%id > 0) > 1) then
               allocate (before(n), source=control%stages(1))
               k = control%stages(1)%id - n - 1
               if (control%stages(1)%line == 0) then
                  k = 0
                  control%stages(1)%id = n + 1
               end if
               if (k < 0) k = maxval(control%stages%id)
               do s = 1, n
                  before(s)%id = k + s
                  before(s)%label = 'BOLT PRELOAD'
                  before(s)%load = set_reference()
                  before(s)%temperature = set_reference()
                  before(s)%increments = set_reference()
                  before(s)%vibration = vibration_entries_type()
               end do
               do s = 2, size(control%stages)
                  if (control%stages(s)%from%id == 0) control%stages(s)%from = set_reference(k + n, control%stages(s)%line)
               end do
               control%stages = [before, control%stages]
            end if
            do s = 1, n
               call take_preloads(sets(s), control%stages(s)%id)
            end do
         end if
         do k = 1, count(bulk%bolt%kind > 0 .and. bulk%bolt%stage == 0)
            call bulk%ignored%add('BOLT')
         end do
         bulk%bolt = pack(bulk%bolt, bulk%bolt%kind == 0 .or. bulk%bolt%stage > 0)
      end associate

   contains

      !> The BOLTFOR cards of SET tighten their bolts in STAGE.
      subroutine take_preloads(set, stage)
         integer, intent(in) :: set, stage
         integer :: b, i, k
         logical :: is_there

         associate (bulk => deck%bulk)
            if (all(bulk%preload%set /= set)) call errors%add(asked%line, &
               'BOLTLD: there is no BOLTFOR with set '//integer_text(set))
            do i = 1, size(bulk%preload)
               if (bulk%preload(i)%set /= set) cycle
               associate (card => bulk%preload(i), wanted => bulk%preload(i)%bolts)
                  do k = 1, size(wanted%first)
                     is_there = wanted%first(k) < wanted%last(k) ! a range means the bolts that exist
                     do b = 1, count(bulk%bolt%line > 0)
                        associate (id => bulk%bolt(b)%id)
                           if (bulk%bolt(b)%kind == 0 .or. id < wanted%first(k) .or. id > wanted%last(k)) cycle
                        end associate
                        is_there = .true.
                        call take_preload(b, card%force, stage)
                     end do
                     if (.not. is_there) call errors%add(card%line, 'BOLTFOR: there is no BOLT '//integer_text(wanted%first(k))// &
                                                         ' with an ETYPE')
                  end do
               end associate
            end do
         end associate
      end subroutine take_preloads

      !> STAGE tightens bolt B, perhaps again, to FORCE.
      subroutine take_preload(b, force, stage)
         integer, intent(in)  :: b, stage
         real(wp), intent(in) :: force
         integer :: at

         associate (bulk => deck%bulk)
            at = b
            if (bulk%bolt(b)%stage > 0) then
               bulk%bolt = [bulk%bolt, bulk%bolt(b)]
               at = size(bulk%bolt)
               bulk%bolt(at)%id = maxval(bulk%bolt%id) + 1
            else if (bulk%bolt(b)%kind == 1) then
               if (size(bulk%bolt(b)%parts%first) > 0) bulk%bolt(b)%element = bulk%bolt(b)%parts%first(1)
            else
               bulk%bolt(b)%surface = free_mark(bulk, 0)
               bulk%pmark = [bulk%pmark, pmark_card(line=bulk%bolt(b)%line, id=bulk%bolt(b)%surface)]
            end if
            bulk%bolt(at)%preload = force
            bulk%bolt(at)%stage = stage
            bulk%told = [bulk%told, text_item('bolt '//integer_text(bulk%bolt(b)%id)//', '//one_of(bulk%bolt(b)%kind == 1, &
               'element '//integer_text(bulk%bolt(b)%element), 'section of surface '//integer_text(bulk%bolt(b)%surface))// &
               ': tightened to '//real_text(force)//' in SUBCASE '//integer_text(stage))]
         end associate
      end subroutine take_preload

   end subroutine tighten_bolts

end module nx_translation
