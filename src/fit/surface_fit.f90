!> Fits the laws of one surface to its test data: the branches of the shear law; normal_fit has the power law.
!! Warns where the slope of a fitted cubic turns negative in the range of the card: a joint has no negative stiffness.
module surface_fit
   use branch_cubic, only: cubic
   use branch_fit, only: branch_fit_type, fault_none
   use data_columns, only: branch_words, column_tau, data_loss, data_normal, data_shear, data_stiffness, fit_load, fit_reload, &
                           fit_unload
   use deck_errors, only: deck_error_list
   use field_rules, only: largest_size, smallest_size
   use fit_command, only: fit_command_type
   use fit_data, only: test_data_type
   use iwan_fit, only: fit_iwan, iwan_fit_type
   use kinds, only: wp
   use normal_fit, only: check_residual, fit_normal_test, normal_fit_type
   use shear_branches, only: fit_branch
   use shear_loops, only: loop_closure, wide_gap, worst_closure
   use shear_stiffness, only: shear_law
   use text_tools, only: one_of, real_text
   use tolerances, only: equal_readings
   implicit none
   private

   public :: fit_surface, check_slopes, find_slope_loss, normal_fit_type

   real(wp), parameter :: nearer = 0.9_wp          ! share of the residual of one ORIGIN below which the other is better

   type, public :: surface_fit_type
      integer :: kind = 0                          !! data_normal, data_loss: Iwan's law, or a shear law
      type(branch_fit_type) :: branch(3)           !! load, unload, reload of the card; n_points 0: no data
      integer  :: source(3) = 0                    !! branch of the data used for each branch of the card
      real(wp) :: card(2, 3, 3) = 0.0_wp           !! (., k, branch): a_k1 and a_k2 for the card
      logical  :: has_loading = .false.            !! false: the card is incomplete
      real(wp) :: p_max = 0.0_wp                   !! range of the loading data [pressure]
      real(wp) :: d_max = 0.0_wp                   !! [length], 0: unknown
      logical  :: from_branch = .false.            !! ORIGIN of the card: d of unloading and reloading from the start of the branch
      logical  :: one_shape = .false.              !! one cubic for unloading and reloading, its fit in both
      character(:), allocatable :: origin          !! why this ORIGIN; not allocated: nothing to compare
      type(branch_fit_type) :: other(3)            !! the branches by the other ORIGIN, n_points 0: none
      real(wp) :: other_card(2, 3, 3) = 0.0_wp
      type(loop_closure) :: closure                !! of the law on the card
      type(normal_fit_type) :: normal
      type(iwan_fit_type)   :: iwan                !! kind data_loss, and of shear by --iwan too
      type(deck_error_list) :: warnings
   end type surface_fit_type

contains

   !> Fit the law of the surface in DATA. Missing data go to ERRORS.
   subroutine fit_surface(data, command, fit, errors)
      type(test_data_type), intent(in)     :: data
      type(fit_command_type), intent(in)   :: command
      type(surface_fit_type), intent(out)  :: fit
      type(deck_error_list), intent(inout) :: errors
      type(shear_law) :: law
      real(wp) :: largest, smallest, positive(4)
      integer  :: from(3) ! branch of the card for each branch of the law

      fit%kind = data%kind
      fit%warnings = data%warnings
      if (data%kind == data_loss .or. (data%kind == data_shear .and. command%iwan)) then
         fit%kind = data_loss ! the card
         call fit_iwan(data, fit%iwan, errors, fit%warnings)
         return
      end if
      if (command%iwan) call errors%add(0, '--iwan is for points of shear tests: expected the columns d tau p or d loss p')
      if (any(data%kind == [data_normal, data_stiffness])) then
         fit%kind = data_normal ! the card
         if (command%only > 0) call errors%add(0, 'points of normal tests have no branch: --branch is for shear tests')
         if (command%only == 0) call fit_normal_test(data, fit%normal, errors, fit%warnings)
      else
         call fit_shear(data, command, fit, errors)
      end if
      if (errors%any()) return
      largest = max(fit%normal%c, fit%normal%loops%e_u, maxval(abs(fit%card)), fit%p_max, fit%d_max)
      if (.not. largest <= largest_size) call errors%add(0, 'the law that fits these data has a number of '//real_text(largest)// &
         ', and a deck accepts at most '//real_text(largest_size)//': are the units right, and --dmax?')
      positive = [fit%normal%c, fit%normal%loops%e_u, fit%p_max, fit%d_max] ! zero: not fitted, its field is blank
      smallest = minval(positive, mask=positive > 0.0_wp)
      if (smallest < smallest_size) call errors%add(0, 'the law that fits these data has a number of '//real_text(smallest)// &
         ', and a deck accepts none below '//real_text(smallest_size)//': are the units right?')
      if (errors%any() .or. .not. fit%has_loading) return
      from = merge([fit_load, fit_unload, fit_reload], fit_load, fit%branch%n_points > 0)
      law = shear_law(given=.true., load=cubic(fit%card(:, :, fit_load)), unload=cubic(fit%card(:, :, from(fit_unload))), &
                      reload=cubic(fit%card(:, :, from(fit_reload))), p_max=fit%p_max, from_branch=fit%from_branch)
      if (fit%d_max > 0.0_wp) law%d_max = fit%d_max
      fit%closure = worst_closure(law, fit%p_max)
      if (fit%closure%is_known .and. fit%closure%share > wide_gap) &
         call fit%warnings%add(0, 'reloading misses point A by more than 5 % of tau_r: cycles under one load creep')
   end subroutine fit_surface

   !> Fit the branches of the shear law.
   subroutine fit_shear(data, command, fit, errors)
      type(test_data_type), intent(in)      :: data
      type(fit_command_type), intent(in)    :: command
      type(surface_fit_type), intent(inout) :: fit
      type(deck_error_list), intent(inout)  :: errors
      type(surface_fit_type) :: other
      type(deck_error_list)  :: ignored
      integer :: b

      fit%source = [1, 2, 3]
      if (command%only > 0) then
         fit%source = 0
         fit%source(command%as) = command%only
         if (count(data%branch(:data%n) == command%only) == 0) then
            call errors%add(0, 'no '//trim(branch_words(command%only))//' data: --branch asks for them')
            return
         end if
      end if
      call fit_branches(data, command, fit, errors)
      if (errors%any()) return
      if (data%kind == data_shear .and. command%only == 0 .and. any(fit%branch(fit_unload:)%n_points > 0)) then
         other = fit
         other%from_branch = .true.
         call fit_branches(data, command, other, ignored)
         if (.not. ignored%any() .and. all(other%branch%n_points > 0 .eqv. fit%branch%n_points > 0)) &
            call choose_origin(maxval(abs(data%value(column_tau, :data%n))), command%fit%one_step, other, fit)
      end if
      if (fit%from_branch) call try_one_shape(data, command, fit)
      do b = fit_load, fit_reload
         if (.not. fit%branch(b)%from_points .or. (fit%one_shape .and. b == fit_reload)) cycle
         call check_residual(trim(branch_words(fit%source(b)))//': tau', 'tau', merge(fit%branch(b)%of_joint%largest, &
                             fit%branch(b)%of_lines%largest, command%fit%one_step), maxval(abs(data%value(column_tau, :data%n))), &
                             fit%warnings)
      end do
      associate (load => fit%branch(fit_load))
         fit%has_loading = load%n_points > 0
         fit%p_max = load%p_high
         if (load%from_points) fit%d_max = max(abs(load%d_low), abs(load%d_high))
      end associate
      if (command%fit%one_step .and. .not. data%kind == data_shear) &
         call fit%warnings%add(0, 'the cubics are given, there are no points for --joint-fit: the lines are on the card')
      if (command%d_max > 0.0_wp) fit%d_max = command%d_max
   end subroutine fit_shear

   !> Fit all branches of the card by the ORIGIN of FIT.
   subroutine fit_branches(data, command, fit, errors)
      type(test_data_type), intent(in)      :: data
      type(fit_command_type), intent(in)    :: command
      type(surface_fit_type), intent(inout) :: fit
      type(deck_error_list), intent(inout)  :: errors
      type(branch_fit_type) :: nothing
      integer :: b

      do b = fit_load, fit_reload
         if (count(data%branch(:data%n) == fit%source(b)) == 0) cycle
         if (data%is_record .and. b /= fit_load) then      ! a record may contain a short part of a branch
            call fit_branch(data, command, [fit%source(b)], fit%from_branch, fit%branch(b), fit%warnings)
            if (fit%branch(b)%fault /= fault_none) fit%branch(b) = nothing
         else
            call fit_branch(data, command, [fit%source(b)], fit%from_branch, fit%branch(b), errors)
         end if
         fit%card(:, :, b) = fit%branch(b)%lines
         if (command%fit%one_step .and. fit%branch(b)%from_points) fit%card(:, :, b) = fit%branch(b)%joint
      end do
   end subroutine fit_branches

   !> Take OTHER, fitted with ORIGIN BRANCH, in place of FIT, with CURVE, where its residual on the unloading and reloading branches
   !! is smaller by a tenth, and by more than equal readings of stresses up to TAU.
   subroutine choose_origin(tau, one_step, other, fit)
      real(wp), intent(in)                  :: tau
      logical, intent(in)                   :: one_step
      type(surface_fit_type), intent(in)    :: other
      type(surface_fit_type), intent(inout) :: fit
      character(:), allocatable :: words
      real(wp) :: rms(2)
      logical  :: is_nearer

      rms = [misfit(fit%branch(fit_unload:), one_step), misfit(other%branch(fit_unload:), one_step)]
      words = 'rms on unloading and reloading: '//percent(rms(1))//' of the largest tau where d counts from zero (CURVE), '// &
              percent(rms(2))//' from the start of the branch (BRANCH); '
      is_nearer = rms(2) < nearer*rms(1) .and. rms(1) - rms(2) > equal_readings*tau
      fit%other = fit%branch
      fit%other_card = fit%card
      if (is_nearer) then
         fit%branch = other%branch
         fit%card = other%card
         fit%from_branch = .true.
         fit%origin = words//'BRANCH is nearer'
      else
         fit%other = other%branch
         fit%other_card = other%card
         fit%origin = words//one_of(rms(1) < nearer*rms(2) .and. rms(2) - rms(1) > equal_readings*tau, 'CURVE is nearer', &
                                    'no difference: CURVE, the default')
      end if

   contains

      pure function percent(stress) result(words)
         real(wp), intent(in)      :: stress
         character(:), allocatable :: words

         words = real_text(0.01_wp*anint(1.0e4_wp*stress/max(tau, tiny(tau))))//' %'
      end function percent

   end subroutine choose_origin

   !> The residual of tau about the laws of BRANCHES on the card, over all their points [stress].
   pure real(wp) function misfit(branches, one_step)
      type(branch_fit_type), intent(in) :: branches(:)
      logical, intent(in)               :: one_step
      real(wp) :: rms(size(branches))

      rms = branches%of_lines%rms
      if (one_step) rms = branches%of_joint%rms
      misfit = sqrt(sum(branches%n_points*rms**2)/sum(branches%n_points))
   end function misfit

   !> The paper's "same shape": one cubic for unloading and reloading where it fits both as well as two, so that loops close; also
   !! where only one of them has data.
   subroutine try_one_shape(data, command, fit)
      type(test_data_type), intent(in)      :: data
      type(fit_command_type), intent(in)    :: command
      type(surface_fit_type), intent(inout) :: fit
      type(deck_error_list) :: ignored
      type(branch_fit_type) :: both
      real(wp) :: rms(2)

      call fit_branch(data, command, [fit_unload, fit_reload], .true., both, ignored)
      if (ignored%any()) return
      rms = [misfit([both], command%fit%one_step), misfit(fit%branch(fit_unload:), command%fit%one_step)]
      fit%one_shape = nearer*rms(1) <= rms(2) + equal_readings*maxval(abs(data%value(column_tau, :data%n)))
      if (.not. fit%one_shape) return
      fit%branch(fit_unload:) = both
      fit%card(:, :, fit_unload) = merge(both%joint, both%lines, command%fit%one_step)
      fit%card(:, :, fit_reload) = fit%card(:, :, fit_unload)
   end subroutine try_one_shape

   !> Check the slope of every fitted branch in the range of its data and, if it is positive there, in the range of the card: p from
   !! 0 to PMAX, d to DMAX, and d below zero too for unloading and reloading, because these branches extend past zero to the mirror
   !! image of their point A. A branch is followed as in the joint: unloading with decreasing d, the others with increasing d.
   subroutine check_slopes(fit)
      type(surface_fit_type), intent(inout) :: fit
      character(:), allocatable :: words
      integer  :: b, k
      logical  :: lost
      real(wp) :: d, d_max, p, pressures(2), way(2)

      d_max = fit%d_max
      if (d_max <= 0.0_wp) d_max = huge(d_max)
      do b = fit_load, fit_reload
         associate (branch => fit%branch(b))
            if (branch%n_points == 0 .or. (fit%one_shape .and. b == fit_reload)) cycle
            do k = 1, merge(2, 1, fit%has_loading)
               way = [0.0_wp, d_max]
               if (k == 1) then
                  pressures = [branch%p_low, branch%p_high]
                  if (branch%from_points) way = [branch%d_low, branch%d_high]
                  if (b == fit_load) way(1) = min(way(1), 0.0_wp)
                  words = ', inside the tested range'
               else
                  pressures = [0.0_wp, fit%p_max]
                  if (b /= fit_load .and. fit%d_max > 0.0_wp) way = merge([0.0_wp, 2.0_wp*d_max], [-d_max, d_max], fit%from_branch)
                  words = ', outside the tested range of the branch, but inside the range of the card, which --dmax sets'
               end if
               if (b == fit_unload .and. .not. fit%from_branch .and. merge(branch%from_points, fit%d_max > 0.0_wp, k == 1)) &
                  way = way([2, 1])
               call find_slope_loss(fit%card(:, :, b), pressures(1), pressures(2), way(1), way(2), lost, p, d)
               if (lost) call fit%warnings%add(0, trim(branch_words(b))//': the slope of tau becomes zero or negative at p = '// &
                                               real_text(p)//', d = '//real_text(d)//words)
               if (lost) exit
            end do
         end associate
      end do
   end subroutine check_slopes

   !> From d = FROM to d = TO, find the first d at which dtau/dd = sum over k of k (a_k1 + a_k2 p) d^(k-1) is not positive for some
   !! p between P_LOW and P_HIGH. The slope is linear in p, so its minimum is at P_LOW or P_HIGH: two quadratics in d decide.
   pure subroutine find_slope_loss(lines, p_low, p_high, from, to, found, p, d)
      real(wp), intent(in)  :: lines(2, 3)   !! a_k1 and a_k2 for k = 1, 2, 3
      real(wp), intent(in)  :: p_low, p_high !! [pressure]
      real(wp), intent(in)  :: from, to      !! [length], TO = +-huge: unbounded
      logical, intent(out)  :: found
      real(wp), intent(out) :: p, d          !! the place, if FOUND
      real(wp) :: a(3), ends(2), discriminant, places(3), q, sense
      logical  :: lost(3)
      integer  :: first, i

      found = .false.
      p = 0.0_wp
      d = 0.0_wp
      ends = [p_low, p_high]
      sense = sign(1.0_wp, to - from)
      do i = 1, 2
         a = lines(1, :) + lines(2, :)*ends(i)
         places = from                            ! the start, and the roots of a1 + 2 a2 d + 3 a3 d^2
         discriminant = a(2)**2 - 3.0_wp*a(3)*a(1)
         q = -(a(2) + sign(sqrt(max(discriminant, 0.0_wp)), a(2)))
         if (discriminant >= 0.0_wp .and. abs(q) > 0.0_wp) then ! the two roots q/(3 a3) and a1/q, without cancellation
            places(2) = a(1)/q
            if (abs(a(3)) > tiny(q)) places(3) = q/(3.0_wp*a(3))
         end if
         lost = (places - from)*sense > 0.0_wp .and. (places - to)*sense <= 0.0_wp
         lost(1) = a(1) + from*(2.0_wp*a(2) + from*3.0_wp*a(3)) <= 0.0_wp
         if (.not. any(lost)) cycle
         first = minloc(abs(places - from), 1, lost)
         if (found .and. abs(places(first) - from) >= abs(d - from)) cycle
         found = .true.
         p = ends(i)
         d = places(first)
      end do
   end subroutine find_slope_loss

end module surface_fit
