!> Contact, glue and bolts of NX as joints, ties and bolts of this program: cards JOINT, PJOINT, JGAP, PMARK and BOLT, and stages that
!! tighten the bolts, are added to those of the deck. The parts of the model are made from them as from other cards.
module nx_translation
   use bulk_data, only: bulk_data_type, jgap_card, jnorm_card, joint_card, jshear_card, pjoint_card, pmark_card
   use case_entries, only: set_reference
   use control_words, only: method_newton
   use deck_errors, only: deck_error_list
   use deck_input, only: deck_type
   use kinds, only: wp
   use lists, only: sorted_order
   use stage_entries, only: stage_type, vibration_entries_type
   use support_build, only: summed_sets
   use text_tools, only: append, integer_text, one_of, real_text
   use unit_watch, only: find_units
   implicit none
   private

   public :: translate_contacts

   ! the law of contacts without PJOINT: ground steel S45C (Ito, Modular Design for Machine Tools, Table 6-5). EU is the slope of loading
   ! at 1000 N/mm2; the shear stiffness is the slope at 25 kgf/cm2 times Mindlin's ratio 2 (1 - nu)/(2 - nu), nu = 0.3
   real(wp), parameter :: default_c = 0.046_wp, default_m = 0.48_wp           ! [micrometre/MPa^m]
   real(wp), parameter :: default_e_u = 1.64e6_wp, default_a11 = 5.9e4_wp     ! [N/mm3]

contains

   !> Add to DECK the cards and stages that its contact, glue and bolts of NX stand for; what is wrong goes to ERRORS.
   subroutine translate_contacts(deck, errors)
      type(deck_type), intent(inout)       :: deck
      type(deck_error_list), intent(inout) :: errors

      if (.not. allocated(deck%bulk%pair)) return
      allocate (deck%bulk%told(0))
      call join_pairs(deck, .false., errors)
      call join_pairs(deck, .true., errors) ! behind all joints
      call tighten_bolts(deck, errors)
      if (size(deck%bulk%told) == 0 .or. deck%control%method_is_given) return
      deck%control%method = method_newton
      call tell(deck%bulk, 'contact and bolts of NX without METHOD: METHOD = NEWTON')
   end subroutine translate_contacts

   !> What the listing and the screen say.
   subroutine tell(bulk, words)
      type(bulk_data_type), intent(inout) :: bulk
      character(*), intent(in)            :: words

      call append(bulk%told, words)
   end subroutine tell

   !> The pairs of regions in contact, or those glued, that case control selects, as JOINT cards.
   subroutine join_pairs(deck, is_glue, errors)
      type(deck_type), intent(inout)       :: deck
      logical, intent(in)                  :: is_glue
      type(deck_error_list), intent(inout) :: errors
      type(set_reference), allocatable :: asked(:)
      character(:), allocatable :: key, words
      integer, allocatable :: sets(:)
      logical, allocatable :: active(:)
      integer :: i, k, law, n, r(2)

      associate (bulk => deck%bulk, stages => deck%control%stages)
         key = one_of(is_glue, 'BGSET', 'BCTSET')
         if (is_glue) asked = stages%glue
         if (.not. is_glue) asked = stages%contact
         if (is_glue) sets = summed_sets(bulk%glue_sum, asked(1)%id)
         if (.not. is_glue) sets = summed_sets(bulk%contact_sum, asked(1)%id)
         words = ''
         allocate (active(size(bulk%pair)))
         do i = 1, size(active)
            active(i) = asked(1)%id > 0 .and. any(sets == bulk%pair(i)%set) .and. (bulk%pair(i)%is_glue .eqv. is_glue)
         end do
         if (any(asked%id /= asked(1)%id)) call errors%add(maxval(asked%line), &
            'all stages must have the same '//key//'s; give the set above the first SUBCASE')
         if (asked(1)%id > 0 .and. .not. any(active)) call errors%add(asked(1)%line, &
            'there is no '//key//' with set '//integer_text(asked(1)%id))
         n = maxval([0, bulk%joint%id])
         do i = 1, size(bulk%pair)
            associate (pair => bulk%pair(i))
               if ((pair%is_glue .eqv. is_glue) .and. .not. active(i)) call bulk%ignored%add(key)
               if (.not. active(i)) cycle
               do k = 1, size(pair%regions, 2)
                  r = [mark(pair%regions(1, k), pair%line), mark(pair%regions(2, k), pair%line)]
                  if (any(r == 0)) cycle
                  bulk%joint = [bulk%joint, joint_card(line=pair%line, sides=r, tolerance=pair%reach(k), is_glued=is_glue)]
                  words = one_of(is_glue, 'glue', 'contact')//' of regions '//integer_text(pair%regions(1, k))//' and '// &
                          integer_text(pair%regions(2, k))//', surfaces '//integer_text(r(1))//' and '//integer_text(r(2))
                  if (.not. is_glue) then
                     n = n + 1
                     call find_law(deck, pair%mu(k), law)
                     bulk%joint(size(bulk%joint))%id = n
                     bulk%joint(size(bulk%joint))%law = law
                     bulk%jgap = [bulk%jgap, jgap_card(line=pair%line, joint=n, kind='TRUE')]
                     words = words//': JOINT '//integer_text(n)//', PJOINT '//integer_text(law)// &
                             one_of(pair%mu(k) > 0.0_wp, ', MU '//real_text(pair%mu(k)), '')
                  end if
                  call tell(bulk, words)
               end do
            end associate
         end do
      end associate

   contains

      !> The PMARK of the region ID, which is added where it is new; 0, and an error: there is no such region.
      integer function mark(id, line)
         integer, intent(in) :: id, line
         integer :: s

         mark = 0
         associate (bulk => deck%bulk, is_region => deck%bulk%region%id == id .and. .not. deck%bulk%region%is_parameter)
            s = findloc(is_region, .true., dim=1)
            if (s == 0 .and. any(bulk%pmark%id == id) .and. all(bulk%region%surface /= id)) mark = id ! a PMARK is a region too
            if (id > 0 .and. s + mark == 0) call errors%add(line, 'there is no BSURF, BSURFS, BCPROP or BCPROPS '// &
                                                            integer_text(id))
            if (count(is_region) > 1) call errors%add(line, 'region '//integer_text(id)//' is given more than once')
            if (s == 0) return
            if (bulk%region(s)%surface == 0) call add_mark(bulk, bulk%region(s)%line, id, bulk%region(s)%surface)
            bulk%region(s)%is_bottom = any(bulk%region%id == id .and. bulk%region%is_bottom)
            mark = bulk%region(s)%surface
         end associate
      end function mark

   end subroutine join_pairs

   !> Add a PMARK for the card on LINE. Its NUMBER is ID, where no property and no PMARK has it, else the next above all.
   pure subroutine add_mark(bulk, line, id, number)
      type(bulk_data_type), intent(inout) :: bulk
      integer, intent(in)                 :: line, id
      integer, intent(out)                :: number

      associate (used => [bulk%pshell%id, bulk%paxis%id, bulk%psolid%id, bulk%prod%id, bulk%beam_property%id, bulk%pmark%id])
         number = id
         if (id == 0 .or. any(used == id)) number = maxval([used, bulk%region%id, 0]) + 1
      end associate
      bulk%pmark = [bulk%pmark, pmark_card(line=line, id=number)]
   end subroutine add_mark

   !> The LAW, a PJOINT, of a contact with friction MU: the first of the deck, or of the file of --law, with this MU where it is above 0
   !! and the law not that of a JIWAN; else that of ground steel.
   subroutine find_law(deck, mu, law)
      type(deck_type), intent(inout) :: deck
      real(wp), intent(in)           :: mu
      integer, intent(out)           :: law
      type(pjoint_card) :: card
      integer :: i

      associate (bulk => deck%bulk)
         if (size(bulk%pjoint) == 0) call add_default_law(deck)
         card = bulk%pjoint(1)
         law = card%id
         if (.not. mu > 0.0_wp .or. card%iwan_law > 0) return
         card%mu = mu
         card%mu_given = .true.
         if (card%line == 0) card%shear_laws = card%normal_law ! of ground steel
         i = findloc(bulk%pjoint%normal_law == card%normal_law .and. bulk%pjoint%mu_given .and. &
                     abs(bulk%pjoint%mu - mu) <= 0.0_wp, .true., dim=1)
         if (i == 0) then
            card%id = maxval(bulk%pjoint%id) + 1
            bulk%pjoint = [bulk%pjoint, card]
            i = size(bulk%pjoint)
         end if
         law = bulk%pjoint(i)%id
      end associate
   end subroutine find_law

   !> Add PJOINT, JNORM and JSHEAR of ground steel in the units of the deck: those of UNITS, else those in which E is that of a metal.
   subroutine add_default_law(deck)
      type(deck_type), intent(inout) :: deck
      type(jnorm_card)  :: jnorm
      type(jshear_card) :: jshear
      character(:), allocatable :: units
      real(wp) :: e, length, metre, newton ! LENGTH: the unit of length [mm]

      associate (bulk => deck%bulk)
         call find_units(deck%control, metre, newton)
         length = 1000.0_wp*metre
         units = 'of UNITS'
         if (.not. (metre > 0.0_wp .and. newton > 0.0_wp)) then
            e = maxval([0.0_wp, bulk%mat1%e])
            newton = merge(4.4482216_wp, 1.0_wp, e > 1.5e6_wp .and. e < 1.0e9_wp)
            length = merge(25.4_wp, merge(1000.0_wp, 1.0_wp, e >= 1.0e9_wp), newton > 2.0_wp)
            units = 'taken as '//one_of(newton > 2.0_wp, 'IN, LBF', one_of(e >= 1.0e9_wp, 'M, N', 'MM, N'))//' by E'
         end if
         jnorm%id = maxval([0, bulk%jnorm%id, bulk%jshear%id]) + 1
         jnorm%law%c = default_c/(1000.0_wp*length)*(newton/length**2)**default_m
         jnorm%law%m = default_m
         jnorm%law%e_u = default_e_u*length**3/newton
         jnorm%e_u_given = .true.
         jshear%id = jnorm%id
         jshear%law%given = .true.
         jshear%law%load%coefficients(1, 1) = default_a11*length**3/newton
         jshear%law%unload = jshear%law%load
         jshear%law%reload = jshear%law%load
         bulk%jnorm = [bulk%jnorm, jnorm]
         bulk%jshear = [bulk%jshear, jshear]
         bulk%pjoint = [pjoint_card(id=1, normal_law=jnorm%id)]
         call tell(bulk, 'contacts have the default law, ground steel: lambda = C p^M with C = '// &
            real_text(jnorm%law%c)//', M = '//real_text(jnorm%law%m)//', EU = '//real_text(jnorm%law%e_u)// &
            '; with friction A11 = '//real_text(jshear%law%load%coefficients(1, 1))//'; units '//units// &
            '; --law FILE gives another law')
      end associate
   end subroutine add_default_law

   !> The preloads of BOLTFOR, in the order of BOLTSEQ, in stages of their own before the first: bolts are locked before other loads
   !! come. A first SUBCASE with BOLTLD and without loads is this stage. All other stages start from its end, as NX solves them.
   subroutine tighten_bolts(deck, errors)
      type(deck_type), intent(inout)       :: deck
      type(deck_error_list), intent(inout) :: errors
      type(set_reference)  :: asked
      integer, allocatable :: order(:), sets(:)
      integer :: i, k, n, s

      associate (bulk => deck%bulk, control => deck%control)
         asked = control%stages(1)%bolts
         if (any(control%stages%bolts%id > 0 .and. control%stages%bolts%id /= asked%id)) call errors%add( &
            maxval(control%stages%bolts%line), 'BOLTLD: expected one set for all SUBCASEs, above the first or in the first')
         if (asked%id > 0) then
            sets = [asked%id]
            do i = 1, size(bulk%preload)
               if (bulk%preload(i)%set /= asked%id .or. .not. allocated(bulk%preload(i)%sets)) cycle
               call sorted_order(bulk%preload(i)%order, order)
               sets = bulk%preload(i)%sets(order)
            end do
            n = size(sets)
            if (n > 1 .or. control%stages(1)%load%id > 0 .or. count(control%stages%bolts%id > 0) > 1) &
               call insert_stages(n, control%stages)
            do s = 1, n
               if (all(bulk%preload%set /= sets(s))) call errors%add(asked%line, 'BOLTLD: there is no BOLTFOR with set '// &
                                                                     integer_text(sets(s)))
               do i = 1, size(bulk%preload)
                  if (bulk%preload(i)%set == sets(s) .and. .not. allocated(bulk%preload(i)%sets)) &
                     call take_preload(deck, i, control%stages(s)%id, errors)
               end do
            end do
         end if
         do k = 1, count(bulk%bolt%kind > 0 .and. bulk%bolt%stage == 0)
            call bulk%ignored%add('BOLT')
         end do
         bulk%bolt = pack(bulk%bolt, bulk%bolt%kind <= 0 .or. bulk%bolt%stage > 0)
      end associate
   end subroutine tighten_bolts

   !> Insert N stages without loads before the first of STAGES; the others start from the end of the last of them.
   subroutine insert_stages(n, stages)
      integer, intent(in) :: n
      type(stage_type), allocatable, intent(inout) :: stages(:)
      type(stage_type) :: before(n)
      integer :: highest, s

      highest = stages(1)%id - 1
      if (stages(1)%line == 0) then ! no SUBCASE
         stages(1)%id = n + 1
         highest = n
      end if
      if (highest < n) highest = maxval(stages%id) + n
      do s = 1, n
         before(s) = stages(1)
         before(s)%id = highest - n + s
         before(s)%label = 'BOLT PRELOAD'
         before(s)%load = set_reference()
         before(s)%temperature = set_reference()
         before(s)%increments = set_reference()
         before(s)%vibration = vibration_entries_type()
      end do
      do s = 2, size(stages)
         if (stages(s)%from%id == 0) stages(s)%from = set_reference(highest, stages(s)%line)
      end do
      stages = [before, stages]
   end subroutine insert_stages

   !> STAGE tightens the bolts of BOLTFOR card I, perhaps again.
   subroutine take_preload(deck, i, stage, errors)
      type(deck_type), intent(inout)       :: deck
      integer, intent(in)                  :: i, stage
      type(deck_error_list), intent(inout) :: errors
      integer :: at, b, k
      logical :: is_there

      associate (bulk => deck%bulk, card => deck%bulk%preload(i))
         do k = 1, size(card%bolts%first)
            is_there = card%bolts%first(k) < card%bolts%last(k) ! a range means the bolts that exist
            do b = 1, count(bulk%bolt%line > 0)
               if (bulk%bolt(b)%kind <= 0 .or. bulk%bolt(b)%id < card%bolts%first(k) .or. &
                   bulk%bolt(b)%id > card%bolts%last(k)) cycle
               is_there = .true.
               at = b
               if (bulk%bolt(b)%stage > 0) then
                  bulk%bolt = [bulk%bolt, bulk%bolt(b)]
                  at = size(bulk%bolt)
                  bulk%bolt(at)%id = maxval(bulk%bolt%id) + 1
                  bulk%bolt(at)%kind = -bulk%bolt(b)%kind ! no BOLTFOR names the copy
               else if (bulk%bolt(b)%kind > 1) then
                  call add_mark(bulk, bulk%bolt(b)%line, 0, bulk%bolt(b)%surface)
               else if (size(bulk%bolt(b)%parts%first) > 0) then
                  bulk%bolt(b)%element = bulk%bolt(b)%parts%first(1)
               end if
               bulk%bolt(at)%preload = card%force
               bulk%bolt(at)%stage = stage
               call tell(bulk, 'bolt '//integer_text(bulk%bolt(b)%id)//', '//one_of(bulk%bolt(b)%kind == 1, 'element '// &
                  integer_text(bulk%bolt(b)%element), 'section of surface '//integer_text(bulk%bolt(b)%surface))// &
                  ': tightened to '//real_text(card%force)//' in SUBCASE '//integer_text(stage))
            end do
            if (.not. is_there) call errors%add(card%line, 'BOLTFOR: there is no BOLT '//integer_text(card%bolts%first(k))// &
                                                ' with an ETYPE')
         end do
      end associate
   end subroutine take_preload

end module nx_translation
