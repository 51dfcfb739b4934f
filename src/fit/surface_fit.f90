!> Fits the laws of one surface to its test data: the branches of the shear law; normal_fit has the power law.
!! Warns where the slope of a fitted cubic turns negative in the range of the card: a joint has no negative stiffness.
module surface_fit
   use branch_cubic, only: cubic
   use branch_fit, only: branch_fit_type, fault_dependent, fault_few_points, fault_none, fault_one_pressure, fit_lines_only, &
                         fit_points
   use data_columns, only: branch_words, column_c, column_d, column_p, column_tau, data_loss, data_normal, data_shear, &
                           data_stiffness, &
                           fit_load, fit_reload, fit_unload
   use deck_errors, only: deck_error_list
   use field_rules, only: largest_size, smallest_size
   use fit_command, only: fit_command_type
   use fit_data, only: test_data_type
   use iwan_fit, only: fit_iwan, iwan_fit_type
   use kinds, only: wp
   use normal_fit, only: check_residual, fit_normal_test, normal_fit_type
   use shear_loops, only: loop_closure, wide_gap, worst_closure
   use shear_stiffness, only: shear_law
   use text_tools, only: one_of, plural, real_text
   use tolerances, only: same_deflection
   implicit none
   private

   public :: fit_surface, check_slopes, find_slope_loss, normal_fit_type

   type, public :: surface_fit_type
      integer :: kind = 0                          !! data_normal, data_loss: Iwan's law, or a shear law
      type(branch_fit_type) :: branch(3)           !! load, unload, reload of the card; n_points 0: no data
      integer  :: source(3) = 0                    !! branch of the data used for each branch of the card
      real(wp) :: card(2, 3, 3) = 0.0_wp           !! (., k, branch): a_k1 and a_k2 for the card
      logical  :: has_loading = .false.            !! false: the card is incomplete
      real(wp) :: p_max = 0.0_wp                   !! range of the loading data [pressure]
      real(wp) :: d_max = 0.0_wp                   !! [length], 0: unknown
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
                      reload=cubic(fit%card(:, :, from(fit_reload))), p_max=fit%p_max)
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
      type(branch_fit_type) :: nothing
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
      do b = fit_load, fit_reload
         if (count(data%branch(:data%n) == fit%source(b)) == 0) cycle
         if (data%is_record .and. b /= fit_load) then      ! a record may contain a short part of a branch
            call fit_branch(data, command, fit%source(b), fit%branch(b), fit%warnings)
            if (fit%branch(b)%fault /= fault_none) fit%branch(b) = nothing
         else
            call fit_branch(data, command, fit%source(b), fit%branch(b), errors)
         end if
         fit%card(:, :, b) = fit%branch(b)%lines
         if (.not. fit%branch(b)%from_points) cycle
         if (command%fit%one_step) fit%card(:, :, b) = fit%branch(b)%joint
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

   !> Fit a branch of the card to the rows of branch SOURCE.
   subroutine fit_branch(data, command, source, fit, errors)
      type(test_data_type), intent(in)     :: data
      type(fit_command_type), intent(in)   :: command
      integer, intent(in)                  :: source
      type(branch_fit_type), intent(out)   :: fit
      type(deck_error_list), intent(inout) :: errors
      integer, allocatable :: rows(:)
      character(:), allocatable :: help, name
      integer :: i
      logical :: met(data%n)

      rows = pack([(i, i = 1, data%n)], data%branch(:data%n) == source)
      name = trim(branch_words(source))
      if (data%kind == data_shear) then
         call fit_rows(rows, data%run(rows))
         met = .false.
         if (fit%fault /= fault_none .and. data%in_order .and. source == fit_reload) met = [(returns(i), i = 1, data%n)]
         if (any(met)) then
            rows = pack([(i, i = 1, data%n)], met .or. data%branch(:data%n) == source)
            call fit_rows(rows, merge(data%run(max(1, rows - 1)), data%run(rows), met(rows)))
         end if
      else
         call fit_lines_only(data%value(column_c, rows), data%value(column_p, rows), command%fit%one_pressure, fit)
      end if
      fit%row = rows
      help = ''                   ! where measured pressures are close to each other but count as different
      associate (p => fit%group_p, n => size(fit%group_p))
         if (any(p(2:) < 1.05_wp*p(:n - 1))) help = ', --p-tolerance 0.05 counts pressures within 5 % as one'
      end associate
      select case (fit%fault)
      case (fault_one_pressure)
         call errors%add(data%line(rows(1)), name//': all data at one pressure, p = '//real_text(fit%p_high)// &
                         ', expected two pressures or more; --one-pressure makes a card that does not depend on the pressure')
      case (fault_few_points)
         i = findloc(fit%group, fit%fault_at, 1)
         call errors%add(data%line(rows(i)), name//', p = '//real_text(fit%group_p(fit%fault_at))//': '// &
                         plural(count(fit%group == fit%fault_at), 'point')//' that fix no cubic, expected '// &
                         one_of(fit%constant, 'four different d or more', 'three different d or more, not zero')// &
                         '; --joint-fit needs no cubic of each pressure'//help)
      case (fault_dependent)
         call errors%add(data%line(rows(1)), name//': '//plural(size(rows), 'point')// &
                         ' that do not fix the coefficients: expected more different d and p'//help)
      end select

   contains

      subroutine fit_rows(rows, run)
         integer, intent(in) :: rows(:), run(:)

         call fit_points(data%value(column_d, rows), data%value(column_tau, rows), data%value(column_p, rows), run, &
                         source /= fit_load, command%fit, fit)
      end subroutine fit_rows

      !> Whether reloading returns to point A at row I: it is a point of loading, and also of reloading where reloading has few
      !! points.
      logical function returns(i)
         integer, intent(in) :: i
         integer :: a

         returns = .false.
         if (i == 1) return
         if (data%branch(i) /= fit_load .or. data%branch(i - 1) /= fit_reload) return
         a = findloc(data%branch(:i - 1), fit_load, 1, back=.true.)
         if (a == 0) return
         associate (d => data%value(column_d, [a, i]))
            returns = abs(d(2) - d(1)) <= same_deflection*abs(d(1))
         end associate
      end function returns

   end subroutine fit_branch

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
            if (branch%n_points == 0) cycle
            do k = 1, merge(2, 1, fit%has_loading)
               way = [0.0_wp, d_max]
               if (k == 1) then
                  pressures = [branch%p_low, branch%p_high]
                  if (branch%from_points) way = [branch%d_low, branch%d_high]
                  if (b == fit_load) way(1) = min(way(1), 0.0_wp)
                  words = ', inside the tested range'
               else
                  pressures = [0.0_wp, fit%p_max]
                  if (b /= fit_load .and. fit%d_max > 0.0_wp) way(1) = -d_max
                  words = ', outside the tested range of the branch, but inside the range of the card, which --dmax sets'
               end if
               if (b == fit_unload .and. merge(branch%from_points, fit%d_max > 0.0_wp, k == 1)) way = way([2, 1])
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
