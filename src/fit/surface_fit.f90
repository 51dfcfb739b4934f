!> The laws of one surface from its test data.
module surface_fit
   use branch_cubic, only: cubic
   use branch_fit, only: branch_fit_type, fault_dependent, fault_few_points, fault_none, fault_one_pressure, fit_lines_only, &
                         fit_points, fit_loops
   use data_columns, only: branch_words, column_c, column_d, column_lambda, column_p, column_tau, data_normal, data_shear, &
                           fit_load, fit_reload, fit_unload
   use deck_errors, only: deck_error_list
   use field_rules, only: largest_size, smallest_size
   use fit_command, only: fit_command_type
   use fit_data, only: test_data_type
   use kinds, only: wp
   use normal_fit, only: fit_normal, normal_fit_type
   use shear_loops, only: loop_closure, wide_gap, worst_closure
   use shear_stiffness, only: shear_law
   use text_tools, only: plural, real_text
   implicit none
   private

   public :: fit_surface

   real(wp), parameter :: much = 0.05_wp ! of the largest reading: a residual that is warned of

   type, public :: surface_fit_type
      integer :: kind = 0                          !! of the data: data_normal, or a shear law
      type(branch_fit_type) :: branch(3)           !! of the card: load, unload, reload; n_points 0: no data
      integer  :: source(3) = 0                    !! the branch of the data that each was fitted to
      real(wp) :: card(2, 3, 3) = 0.0_wp           !! (., k, branch): a_k1 and a_k2 for the card
      logical  :: has_loading = .false.            !! false: there is no whole card
      real(wp) :: p_max = 0.0_wp                   !! range of the loading data [pressure]
      real(wp) :: d_max = 0.0_wp                   !! [length], 0: not known
      type(loop_closure) :: closure                !! of the law on the card
      type(normal_fit_type) :: normal
      type(deck_error_list) :: warnings
   end type surface_fit_type

contains

   !> Fit the law that DATA are about. What they lack goes to ERRORS.
   subroutine fit_surface(data, command, fit, errors)
      type(test_data_type), intent(in)     :: data
      type(fit_command_type), intent(in)   :: command
      type(surface_fit_type), intent(out)  :: fit
      type(deck_error_list), intent(inout) :: errors
      type(shear_law) :: law
      real(wp) :: largest, smallest, positive(4)

      fit%kind = data%kind
      fit%warnings = data%warnings
      if (data%kind /= data_normal) then
         call fit_shear(data, command, fit, errors)
      else if (command%only > 0) then
         call errors%add(0, 'points of normal tests have no branch: --branch is for shear tests')
      else
         associate (p => data%value(column_p, :data%n), lambda => data%value(column_lambda, :data%n), &
                    branch => data%branch(:data%n))
            call fit_loops(p, lambda, branch, data%run(:data%n), data%joined(:data%n), fit%normal%loops)
            call fit_normal(pack(p, branch == fit_load), pack(lambda, branch == fit_load), fit%normal, errors, fit%warnings)
            call check_residual('', 'lambda', fit%normal%largest, maxval(abs(lambda)), fit%warnings)
         end associate
      end if
      if (errors%any()) return
      largest = max(fit%normal%c, fit%normal%loops%e_u, maxval(abs(fit%card)), fit%p_max, fit%d_max)
      if (.not. largest <= largest_size) call errors%add(0, 'the law that fits these data has a number of '//real_text(largest)// &
         ', and a deck accepts at most '//real_text(largest_size)//': are the units right, and --dmax?')
      positive = [fit%normal%c, fit%normal%loops%e_u, fit%p_max, fit%d_max] ! zero: none, its field is blank
      smallest = minval(positive, mask=positive > 0.0_wp)
      if (smallest < smallest_size) call errors%add(0, 'the law that fits these data has a number of '//real_text(smallest)// &
         ', and a deck accepts none below '//real_text(smallest_size)//': are the units right?')
      if (errors%any() .or. .not. fit%has_loading) return
      law = shear_law(given=.true., load=cubic(fit%card(:, :, fit_load)), unload=cubic(fit%card(:, :, fit_load)), &
                      reload=cubic(fit%card(:, :, fit_load)), p_max=fit%p_max)
      if (fit%branch(fit_unload)%n_points > 0) law%unload = cubic(fit%card(:, :, fit_unload))
      if (fit%branch(fit_reload)%n_points > 0) law%reload = cubic(fit%card(:, :, fit_reload))
      if (fit%d_max > 0.0_wp) law%d_max = fit%d_max
      fit%closure = worst_closure(law, fit%p_max)
      if (fit%closure%is_known .and. fit%closure%share > wide_gap) &
         call fit%warnings%add(0, 'reloading misses point A by more than 5 % of tau_r: cycles under one load creep')
   end subroutine fit_surface

   !> The branches of the shear law.
   subroutine fit_shear(data, command, fit, errors)
      type(test_data_type), intent(in)      :: data
      type(fit_command_type), intent(in)    :: command
      type(surface_fit_type), intent(inout) :: fit
      type(deck_error_list), intent(inout)  :: errors
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
         if (data%is_record .and. b /= fit_load) then      ! a record may hold a little of a branch
            call fit_branch(data, command, fit%source(b), fit%branch(b), fit%warnings)
            if (fit%branch(b)%fault /= fault_none) fit%branch(b) = branch_fit_type()
         else
            call fit_branch(data, command, fit%source(b), fit%branch(b), errors)
         end if
         fit%card(:, :, b) = fit%branch(b)%lines
         if (.not. fit%branch(b)%from_points) cycle
         if (command%fit%one_step) fit%card(:, :, b) = fit%branch(b)%joint
         call check_residual(trim(branch_words(fit%source(b))), 'tau', merge(fit%branch(b)%of_joint%largest, &
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

   !> Warn of a fit with readings that lie far off it.
   subroutine check_residual(branch, reading, residual, largest, warnings)
      character(*), intent(in)             :: branch, reading
      real(wp), intent(in)                 :: residual, largest !! off the law; of all readings
      type(deck_error_list), intent(inout) :: warnings
      character(:), allocatable :: whose

      if (residual <= much*largest) return
      whose = branch
      if (branch /= '') whose = branch//': '
      call warnings%add(0, whose//reading//' lies up to '//real_text(residual)//' off the law on the card, more than 5 % '// &
                        'of the largest '//reading//', '//real_text(largest))
   end subroutine check_residual

   !> The branch of the card that the rows of branch SOURCE give.
   subroutine fit_branch(data, command, source, fit, errors)
      type(test_data_type), intent(in)     :: data
      type(fit_command_type), intent(in)   :: command
      integer, intent(in)                  :: source
      type(branch_fit_type), intent(out)   :: fit
      type(deck_error_list), intent(inout) :: errors
      integer, allocatable :: rows(:)
      character(:), allocatable :: name
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
      select case (fit%fault)
      case (fault_one_pressure)
         call errors%add(data%line(rows(1)), name//': all data at one pressure, p = '//real_text(fit%p_high)// &
                         ', expected two pressures or more; --one-pressure makes a card that does not depend on the pressure')
      case (fault_few_points)
         i = findloc(fit%group, fit%fault_at, 1)
         call errors%add(data%line(rows(i)), name//', p = '//real_text(fit%group_p(fit%fault_at))//': '// &
                         plural(count(fit%group == fit%fault_at), 'point')//' that fix no cubic, expected '// &
                         trim(merge('four different d or more             ', 'three different d or more, not zero  ', &
                         fit%constant))//'; --joint-fit needs no cubic of each pressure'//tolerance_help(fit))
      case (fault_dependent)
         call errors%add(data%line(rows(1)), name//': '//plural(size(rows), 'point')// &
                         ' that do not fix the coefficients: expected more different d and p'//tolerance_help(fit))
      end select

   contains

      subroutine fit_rows(rows, run)
         integer, intent(in) :: rows(:), run(:)

         call fit_points(data%value(column_d, rows), data%value(column_tau, rows), data%value(column_p, rows), run, &
                         source /= fit_load, command%fit, fit)
      end subroutine fit_rows

      !> Whether row I is where a reloading has come back to point A: it is a point of loading, and of reloading too where there are
      !! few.
      logical function returns(i)
         integer, intent(in) :: i
         integer :: a

         returns = .false.
         if (i == 1) return
         if (data%branch(i) /= fit_load .or. data%branch(i - 1) /= fit_reload) return
         a = findloc(data%branch(:i - 1), fit_load, 1, back=.true.)
         if (a == 0) return
         associate (d => data%value(column_d, [a, i]))
            returns = abs(d(2) - d(1)) <= 1.0e-6_wp*abs(d(1))
         end associate
      end function returns

   end subroutine fit_branch

   !> The option that helps where measured pressures lie close to each other and count as different.
   function tolerance_help(fit) result(words)
      type(branch_fit_type), intent(in) :: fit
      character(:), allocatable :: words

      words = ''
      associate (p => fit%group_p, n => size(fit%group_p))
         if (any(p(2:) < 1.05_wp*p(:n - 1))) words = ', --p-tolerance 0.05 counts pressures within 5 % as one'
      end associate
   end function tolerance_help

end module surface_fit
