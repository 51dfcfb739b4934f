!> Reads the cards of joints: JGAP, JOINT, CJOINT, PJOINT, JNORM, JSHEAR, JIWAN and JINCR.
!! JGAP gives the initial gap of a joint in one of five ways.
module joint_cards
   use branch_cubic, only: cubic
   use bulk_data, only: bulk_data_type, jgap_card
   use card_fields, only: card_fields_type
   use deck_cards, only: card_type
   use field_rules, only: not_negative, positive, real_range
   use iwan_law, only: make_slices
   use kinds, only: wp
   use load_cards, only: arithmetic_fractions, geometric_fractions
   use normal_curve, only: least_power
   use shear_stiffness, only: shear_law
   use text_tools, only: integer_text, real_text
   use tolerances, only: sum_of_shares
   implicit none
   private

   public :: read_jgap, read_joint, read_cjoint, read_pjoint, read_jnorm, read_jshear, read_jiwan, read_jincr

   integer, parameter :: list_from = 9 ! data field where the lists of TABLE and NODES begin: the first continuation
   integer, parameter :: most_increments = 100000, most_reanalyses = 1000, most_slices = 1000
   real(wp), parameter :: most_p0 = 1.0e30_wp ! above this pressure the stiffness of the joint leaves no digits to the bodies

contains

   !> JGAP: the initial gap of a joint.
   subroutine read_jgap(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      character(:), allocatable :: no_such_field

      associate (jgap => bulk%jgap(card%i))
         jgap%line = card%line
         call card%field('JID', jgap%joint)
         call card%word('KIND', '|CONST|PLANE|TABLE|NODES|TRUE|', jgap%kind)
         call card%field('G0', jgap%g0, default=0.0_wp)
         call card%field(['SX', 'SY'], jgap%slope, default=0.0_wp)
         call card%field(['CX', 'CY'], jgap%crown, default=0.0_wp)
         call card%blank(['blank'])
         allocate (jgap%node(0), jgap%gap(0), jgap%at(0), jgap%x(3, 0))
         if (.not. card%given('KIND')) call card%error('KIND', 'blank, expected one of CONST, PLANE, TABLE, NODES, TRUE')
         if (card%is_faulty()) return
         no_such_field = ': '//card%text_at(2)//' has no such field'
         select case (jgap%kind)
         case ('CONST', 'PLANE')
            if (.not. card%given('G0')) call card%error('G0', 'blank, expected a real number')
            call card%must_be_blank(merge(4, list_from, jgap%kind == 'CONST'), card%n, no_such_field)
         case ('TRUE')
            call card%must_be_blank(3, card%n, no_such_field)
         case default
            call card%must_be_blank(3, 7, no_such_field)
            call read_gaps(card, jgap)
         end select
      end associate
   end subroutine read_jgap

   !> The points of TABLE: X, Y, Z, G in groups of four; a blank coordinate is zero, four blank fields are no point. The nodes of NODES:
   !! G1 and its gap in pairs; two blank fields are no node. At least one group must be there.
   subroutine read_gaps(card, jgap)
      type(card_fields_type), intent(inout) :: card
      type(jgap_card), intent(inout)        :: jgap
      integer :: d, i, k, length, n
      logical :: ok

      length = merge(4, 2, jgap%kind == 'TABLE')
      associate (filled => card%fields%length > 0)
         jgap%at = pack([(k, k = list_from, card%n, length)], &
                        [(any(filled(k:min(k + length - 1, card%n))), k = list_from, card%n, length)])
      end associate
      n = size(jgap%at)
      if (n == 0) call card%error('KIND', card%text_at(2)//', but no list follows in continuation lines')
      jgap%node = spread(0, 1, n)
      jgap%gap = spread(0.0_wp, 1, n)
      jgap%x = spread(spread(0.0_wp, 1, 3), 2, n)
      do i = 1, n
         associate (first => jgap%at(i))
            if (jgap%kind == 'TABLE') then
               do d = 1, 3
                  if (card%text_at(first + d - 1) /= '') call card%real_at(first + d - 1, achar(iachar('X') + d - 1), &
                                                                           jgap%x(d, i), ok, or_blank=.true.)
               end do
               call card%real_at(first + 3, 'G', jgap%gap(i), ok, expected='the gap at the point, a real number')
            else
               call card%integer_at(first, 'G', jgap%node(i), ok, expected='the number of a node')
               call card%real_at(first + 1, 'GAP', jgap%gap(i), ok, expected='the gap at the node, a real number')
            end if
         end associate
      end do
   end subroutine read_gaps

   !> JOINT: interface elements between two marked surfaces, or between a marked surface and a rigid base.
   subroutine read_joint(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      character(8) :: fit, pressure

      associate (joint => bulk%joint(card%i))
         call card%field('JID', joint%id)
         call card%field('PJID', joint%law)
         call card%field('SIDE1', joint%sides(1))
         call card%field('SIDE2', joint%sides(2), default=0)
         call card%field('TOL', joint%tolerance, positive, default=0.0_wp)
         call card%word('FIT', '|AUTO|YES|NO|', fit)
         call card%word('PRESSURE', '|CONSTANT|LINEAR|', pressure)
         call card%finish(joint%line)
         joint%is_linear = pressure == 'LINEAR'
         joint%fit = findloc([character(4) :: 'AUTO', 'YES', 'NO'], fit, dim=1)
         if (joint%sides(1) > 0 .and. joint%sides(1) == joint%sides(2)) call card%error('SIDE2', 'the same surface as SIDE1')
      end associate
   end subroutine read_joint

   !> CJOINT: one interface element given directly.
   subroutine read_cjoint(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk

      associate (cjoint => bulk%cjoint(card%i))
         call card%field('EID', cjoint%id)
         call card%field('PJID', cjoint%law)
         call card%field('G1', cjoint%nodes(1))
         call card%field('G2', cjoint%nodes(2), default=0)
         call card%field('AREA', cjoint%area, positive)
         call card%field(['NX', 'NY', 'NZ'], cjoint%normal, default=0.0_wp)
         call card%finish(cjoint%line)
         call card%check_direction('NX', 'the normal', cjoint%normal)
         if (cjoint%nodes(1) > 0 .and. cjoint%nodes(1) == cjoint%nodes(2)) call card%error('G2', 'the same node as G1')
      end associate
   end subroutine read_cjoint

   !> PJOINT: the laws of a joint.
   subroutine read_pjoint(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      character(4), parameter :: replaced(3) = [character(4) :: 'SIDX', 'SIDY', 'MU'] ! by IID
      integer :: k

      associate (pjoint => bulk%pjoint(card%i))
         call card%field('PJID', pjoint%id)
         call card%field('NID', pjoint%normal_law)
         call card%field(['SIDX', 'SIDY'], pjoint%shear_laws, default=0)
         call card%field('MU', pjoint%mu, not_negative, default=0.0_wp)
         call card%field('NREAN', pjoint%n_reanalyses, default=1, least=-1, most=most_reanalyses)
         call card%field('P0', pjoint%p0, real_range(0.0_wp, most_p0, above=.true.), default=0.0_wp)
         call card%field('IID', pjoint%iwan_law, default=0)
         call card%field('PREF', pjoint%p_ref, positive, default=0.0_wp)
         call card%finish(pjoint%line)
         do k = 1, merge(3, 0, card%given('IID'))
            if (card%given(replaced(k))) call card%error(trim(replaced(k)), 'expected blank beside IID: its JIWAN '// &
                                                         'is the law of shear and of friction')
         end do
         if (card%given('PREF') .and. .not. card%given('IID')) &
            call card%error('PREF', 'expected blank without IID: it is the pressure at which FS of a JIWAN holds')
         pjoint%mu_given = card%given('MU')
         pjoint%p0_given = card%given('P0')
      end associate
   end subroutine read_pjoint

   !> JNORM: lambda = C p^M, unloading slope EU.
   subroutine read_jnorm(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk

      associate (jnorm => bulk%jnorm(card%i))
         call card%field('NID', jnorm%id)
         call card%field('C', jnorm%law%c, positive)
         call card%field('M', jnorm%law%m, real_range(least_power, 1.0_wp))
         call card%field('EU', jnorm%law%e_u, positive, default=0.0_wp)
         call card%finish(jnorm%line)
         jnorm%e_u_given = card%given('EU')
      end associate
   end subroutine read_jnorm

   !> JSHEAR: the shear law of one direction. The card has the loading coefficients A. The first continuation has the coefficients
   !! of unloading (B), the second those of reloading (C); a blank one is as loading. The third has the tested range and ORIGIN.
   subroutine read_jshear(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      character(2), parameter :: coefficients(6) = ['11', '12', '21', '22', '31', '32']
      type(card_type) :: as_given
      type(cubic)     :: curves(3)
      character(1)    :: branch
      character(8)    :: origin
      real(wp) :: x(6)
      integer  :: k, n
      logical  :: lacks(2:3)

      as_given = card%card_type
      do k = 8, 24, 8 ! a continuation that begins in field 2 stands under A11, in field 3
         n = merge(6, 3, k < 24)
         if (k == 24 .and. card%text_at(28) == '' .and. scan(card%text_at(27), '0123456789') > 0) n = 2 ! without ORIGIN
         if (k + 1 + n > card%n) cycle
         associate (fields => card%fields(k + 1:k + 1 + n))
            if (fields(1)%length == 0 .and. fields(1 + n)%length > 0) fields = cshift(fields, 1)
         end associate
      end do
      associate (jshear => bulk%jshear(card%i), law => bulk%jshear(card%i)%law)
         call card%field('SID', jshear%id)
         call card%field('A11', x(1))
         call card%field('A'//coefficients(2:), x(2:), default=0.0_wp)
         curves = cubic(reshape(x, [2, 3]))
         call card%blank(['blank'])
         do k = 2, 3
            branch = achar(iachar('A') + k - 1)
            call card%field(branch//coefficients, x, default=0.0_wp)
            if (any(card%given(branch//coefficients))) curves(k) = cubic(reshape(x, [2, 3]))
            lacks(k) = any(card%given(branch//coefficients)) .and. .not. card%given(branch//'11')
            call card%blank(['blank', 'blank'])
         end do
         law = shear_law(given=.true., load=curves(1), unload=curves(2), reload=curves(3))
         call card%field('PMAX', law%p_max, positive, default=huge(1.0_wp))
         call card%field('DMAX', law%d_max, positive, default=huge(1.0_wp))
         call card%word('ORIGIN', '|CURVE|BRANCH|', origin)
         law%from_branch = origin == 'BRANCH'
         call card%finish(jshear%line)
         card%card_type = as_given
         do k = 2, 3
            if (lacks(k)) call card%error(achar(iachar('A') + k - 1)//'11', &
                                          'blank, expected a real number: the first coefficient of a branch that is given')
         end do
      end associate
   end subroutine read_jshear

   !> JIWAN: Segalman's Iwan law of shear and friction, divided into N slices.
   subroutine read_jiwan(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      integer :: n

      associate (jiwan => bulk%jiwan(card%i), law => bulk%jiwan(card%i)%law)
         law%given = .true.
         call card%field('IID', jiwan%id)
         call card%field('FS', law%f_s, positive)
         call card%field('KT', law%k_t, positive)
         call card%field('CHI', law%chi, real_range(-1.0_wp, 0.0_wp, above=.true.))
         call card%field('BETA', law%beta, not_negative)
         call card%field('N', n, default=20, least=1, most=most_slices)
         call card%finish(jiwan%line)
         if (.not. card%is_faulty()) call make_slices(n, law)
      end associate
   end subroutine read_jiwan

   !> JINCR: the increments of a stage as fractions that add up to 1; an error leaves one increment.
   subroutine read_jincr(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      character(8) :: progression
      real(wp), allocatable :: list(:)
      real(wp) :: first, share
      integer  :: k, n
      logical  :: ok

      associate (jincr => bulk%jincr(card%i))
         jincr%fractions = [1.0_wp]
         call card%field('SID', jincr%id)
         call card%field('N', n, default=0, most=most_increments)
         call card%word('PROG', '|ARITH|GEOM|LIST|', progression)
         if (card%text_at(3) == 'LIST') then ! the fractions follow; their sum must be 1 within 1E-4 and is scaled to 1
            jincr%line = card%line
            if (card%is_faulty()) return
            allocate (list(0))
            do k = 4, card%n
               if (card%text_at(k) == '') cycle
               call card%real_at(k, 'SHARE', share, ok, expected='a share of the load change')
               if (ok .and. share <= 0.0_wp) call card%error_at(k, 'SHARE: '//real_text(share)//', expected above 0')
               list = [list, share]
            end do
            if (card%is_faulty()) return
            if (card%given('N') .and. n /= size(list)) then
               call card%error('N', integer_text(n)//', but '//integer_text(size(list))//' shares follow')
            else if (abs(sum(list) - 1.0_wp) > sum_of_shares) then
               call card%error_at(4, 'SHARE: the shares add up to '//real_text(sum(list))//', expected 1')
            else
               jincr%fractions = list/sum(list)
            end if
            return
         end if
         call card%field('FIRST', first, real_range(0.0_wp, 1.0_wp, above=.true.), default=0.05_wp)
         call card%finish(jincr%line)
         if (card%is_faulty()) return
         if (.not. card%given('N')) then
            call card%error('N', 'blank, expected the number of increments')
         else if (progression == 'ARITH') then
            call arithmetic_fractions(n, first, jincr%fractions, ok)
            if (.not. ok) call card%error('FIRST', 'with '//integer_text(n)//' increments in arithmetic progression and a '// &
               'first share of '//real_text(first)//' the last share is not positive, expected FIRST below '//real_text(2.0_wp/n))
         else
            call geometric_fractions(n, first, jincr%fractions, ok)
            if (.not. ok) call card%error('FIRST', 'no geometric progression of '//integer_text(n)//' increments begins with '// &
                                          real_text(first))
         end if
      end associate
   end subroutine read_jincr

end module joint_cards
