!> The laws of one surface from its test data.
module surface_fit
   use branch_fit, only: branch_fit_type, fault_dependent, fault_few_points, fault_none, fault_one_pressure, &
                         fit_lines_only, fit_points
   use deck_errors, only: deck_error_list
   use fit_branches, only: branch_words, fit_load, fit_reload
   use fit_command, only: fit_command_type
   use kinds, only: wp
   use power_fit, only: fit_power_law, fit_proportional
   use fit_data, only: column_c, column_d, column_lambda, column_p, column_tau, data_normal, data_shear, test_data_type
   use text_tools, only: plural, real_text
   implicit none
   private

   public :: fit_surface

   real(wp), parameter :: m_rounding = 1.0e-9_wp ! an m above 1 by less is 1

   type, public :: surface_fit_type
      integer :: kind = 0                          !! of the data: data_normal, or a shear law
      ! shear
      type(branch_fit_type) :: branch(3)           !! of the card: load, unload, reload; n_points 0: no data
      integer  :: source(3) = 0                    !! the branch of the data that each was fitted to
      real(wp) :: card(2, 3, 3) = 0.0_wp           !! (., k, branch): a_k1 and a_k2 for the card
      logical  :: has_loading = .false.            !! false: there is no whole card
      real(wp) :: p_max = 0.0_wp                   !! range of the loading data [pressure]
      real(wp) :: d_max = 0.0_wp                   !! [length], 0: not known
      ! normal
      real(wp) :: c = 0.0_wp, m = 0.0_wp           !! lambda = c p^m
      integer  :: n_points = 0
      real(wp) :: p_low = 0.0_wp, p_high = 0.0_wp  !! [pressure]
      real(wp) :: lambda_high = 0.0_wp             !! [length]
      real(wp) :: rms = 0.0_wp, largest = 0.0_wp, p_largest = 0.0_wp !! residual of lambda [length], and where [pressure]
      type(deck_error_list) :: warnings
   end type surface_fit_type

contains

   !> Fit the law that DATA are about. What they lack goes to ERRORS.
   subroutine fit_surface(data, command, fit, errors)
      type(test_data_type), intent(in)     :: data
      type(fit_command_type), intent(in)   :: command
      type(surface_fit_type), intent(out)  :: fit
      type(deck_error_list), intent(inout) :: errors

      fit%kind = data%kind
      if (data%kind == data_normal .and. command%only > 0) then
         call errors%add(0, 'points of normal tests have no branch: --branch is for shear tests')
      else if (data%kind == data_normal) then
         call fit_normal(data, fit, errors)
      else
         call fit_shear(data, command, fit, errors)
      end if
   end subroutine fit_surface


   !> The power law of the normal deflection.
   subroutine fit_normal(data, fit, errors)
      type(test_data_type), intent(in)      :: data
      type(surface_fit_type), intent(inout) :: fit
      type(deck_error_list), intent(inout)  :: errors
      real(wp), allocatable :: off(:)
      integer :: at
      logical :: ok

      associate (p => data%value(column_p, :data%n), lambda => data%value(column_lambda, :data%n))
         call fit_power_law(p, lambda, fit%c, fit%m, ok)
         if (.not. ok) then
            call errors%add(0, 'the points do not fix c and m: expected two or more different p above 0 with lambda above 0')
            return
         else if (fit%m <= 0.0_wp) then
            call errors%add(0, 'lambda does not grow with p: m = '//real_text(fit%m)//', expected above 0 and not above 1')
            return
         else if (fit%m > 1.0_wp) then
            if (fit%m > 1.0_wp + m_rounding) call fit%warnings%add(0, 'the points want m = '//real_text(fit%m)// &
               ', the law allows 1 at most: m is held at 1')
            fit%m = 1.0_wp
            fit%c = fit_proportional(p, lambda)
         end if
         off = abs(lambda - fit%c*p**fit%m)
         at = maxloc(off, 1)
         fit%n_points = data%n
         fit%p_low = minval(p)
         fit%p_high = maxval(p)
         fit%lambda_high = maxval(lambda)
         fit%rms = norm2(off)/sqrt(real(data%n, wp))
         fit%largest = off(at)
         fit%p_largest = p(at)
      end associate
   end subroutine fit_normal


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
         call fit_branch(data, command, fit%source(b), fit%branch(b), errors)
         fit%card(:, :, b) = fit%branch(b)%lines
         if (command%joint_fit .and. fit%branch(b)%from_points) fit%card(:, :, b) = fit%branch(b)%joint
      end do
      associate (load => fit%branch(fit_load))
         fit%has_loading = load%n_points > 0
         fit%p_max = load%p_high
         if (load%from_points) fit%d_max = max(abs(load%d_low), abs(load%d_high))
      end associate
      if (command%joint_fit .and. .not. data%kind == data_shear) &
         call fit%warnings%add(0, 'the cubics are given, there are no points for --joint-fit: the lines are on the card')
      if (command%d_max > 0.0_wp) fit%d_max = command%d_max
   end subroutine fit_shear


   !> The branch of the card that the rows of branch SOURCE give.
   subroutine fit_branch(data, command, source, fit, errors)
      type(test_data_type), intent(in)     :: data
      type(fit_command_type), intent(in)   :: command
      integer, intent(in)                  :: source
      type(branch_fit_type), intent(out)   :: fit
      type(deck_error_list), intent(inout) :: errors
      integer, allocatable :: rows(:)
      character(:), allocatable :: name
      integer :: fault, i, where
      logical :: constant

      rows = pack([(i, i = 1, data%n)], data%branch(:data%n) == source)
      name = trim(branch_words(source))
      constant = source /= fit_load
      if (data%kind == data_shear) then
         call fit_points(data%value(column_d, rows), data%value(column_tau, rows), data%value(column_p, rows), constant, &
                         command%p_tolerance, command%joint_fit, fit, fault, where)
      else
         call fit_lines_only(data%value(column_c, rows), data%value(column_p, rows), fit, fault)
         where = 0
      end if
      select case (fault)
      case (fault_none)
         return
      case (fault_one_pressure)
         call errors%add(data%line(rows(1)), name//': all data at one pressure, p = '//real_text(fit%p_high)// &
                         ', expected two pressures or more')
      case (fault_few_points)
         i = findloc(fit%group, where, 1)
         call errors%add(data%line(rows(i)), name//', p = '//real_text(fit%group_p(where))//': '// &
                         plural(count(fit%group == where), 'point')//' that fix no cubic, expected '// &
                         trim(merge('four different d or more             ', &
                                    'three different d or more, not zero  ', constant)))
      case (fault_dependent)
         call errors%add(data%line(rows(1)), name//': '//plural(size(rows), 'point')// &
                         ' that do not fix the coefficients: expected more different d and p')
      end select
   end subroutine fit_branch

end module surface_fit
