!> Fits Iwan's law, a JIWAN card, to tests of shear: to loops of tau over d, or to the loss of a cycle over its amplitude.
!! Loops: the slices of the law are followed along the readings of each test, from rest, whatever the test does. Losses: those of
!! Masing's loops, to which small cycles contribute the slope chi + 3; the stresses of the tips too, where they are given. Both count
!! relative to the reading.
!! The unknowns are ln F_S, ln K_T, chi and ln beta. Levenberg's method, from several starts. Source: J. J. More, The
!! Levenberg-Marquardt algorithm, Lecture Notes in Mathematics 630 (1978) 105-116.
module iwan_fit
   use branch_fit, only: residual_of, residual_type
   use data_columns, only: column_d, column_loss, column_p, column_tau, data_loss, fit_load
   use deck_errors, only: deck_error_list
   use fit_data, only: test_data_type
   use iwan_law, only: greatest_phi, iwan_type, make_slices
   use kinds, only: wp
   use numbers, only: solve_least_squares
   use text_tools, only: integer_text, plural, real_text
   use tolerances, only: iwan_difference, not_fixed, settled_iwan
   implicit none
   private

   public :: fit_iwan

   integer, parameter  :: fine = 100          ! slices of the loops
   integer, parameter  :: most_steps = 100
   integer, parameter  :: beyond = 3          ! readings beyond phi_max that fix beta
   character(4), parameter :: names(4) = [character(4) :: 'FS', 'KT', 'CHI', 'BETA']

   type, public :: iwan_fit_type
      type(iwan_type) :: law
      character(4) :: reading = 'tau'         !! or loss
      type(residual_type) :: residual         !! of the reading
      real(wp), allocatable :: fitted(:)      !! (row) the reading by the law
      real(wp) :: error(4) = 0.0_wp           !! standard errors, relative; of chi absolute
      type(deck_error_list) :: comments       !! for the card
   end type iwan_fit_type

contains

   !> Fit the law to DATA. What is missing goes to ERRORS.
   subroutine fit_iwan(data, fit, errors, warnings)
      type(test_data_type), intent(in)     :: data
      type(iwan_fit_type), intent(out)     :: fit
      type(deck_error_list), intent(inout) :: errors, warnings
      real(wp) :: best, now, p_ref, q(4), trial(4)
      integer  :: chi, free, k
      logical  :: fixed(4)

      associate (p => data%value(column_p, :data%n), d => data%value(column_d, :data%n))
         if (data%kind == data_loss) fit%reading = 'loss'
         if (any(p <= 0.0_wp)) call errors%add(0, 'Iwan''s law: expected p above 0 in every row')
         if (data%kind == data_loss .and. any(min(d, data%value(column_loss, :data%n)) <= 0.0_wp)) &
            call errors%add(0, 'expected an amplitude d and a loss above 0 in every row')
         if (data%kind /= data_loss .and. .not. data%is_record .and. any(data%branch(:data%n) /= fit_load)) &
            call errors%add(0, 'Iwan''s law follows the test: expected rows in the order of time without a column branch or run')
         if (errors%any()) return
         p_ref = maxval(p)
      end associate
      best = huge(best)
      do free = 4, 3, -1 ! without beta where the data do not fix it
         do k = 1, 3
            do chi = 1, 3
               trial = first_guess(data, p_ref, -0.25_wp*chi, 10.0_wp**(k - 2))
               if (free == 3) trial(4) = -huge(1.0_wp)
               call minimise(data, p_ref, free, trial, now)
               if (now >= best .and. .not. (free == 3 .and. k == 1 .and. chi == 1)) cycle
               best = now
               q = trial
            end do
         end do
         call take_errors(data, p_ref, q(:free), best, fit%error, fixed)
         call set_law(q, p_ref, fit%law)
         if (free == 4) fixed(4) = fixed(4) .and. beyond <= count(abs(data%value(column_d, :data%n)) > &
                                   greatest_phi(fit%law)*data%value(column_p, :data%n)/p_ref)
         if (all(fixed(:free)) .and. (free == 3 .or. exp(q(4)) > not_fixed)) exit
         if (free == 4 .and. exp(q(4)) > not_fixed) call warnings%add(0, 'the data do not fix BETA, it is set to 0: expected '// &
            integer_text(beyond)//' amplitudes beyond phi_max, where the joint slides as a whole')
      end do
      if (.not. all(fixed(:min(free, 4)))) call errors%add(0, 'the data do not fix '//trim(names(findloc(fixed, .false., 1)))// &
         ' of a JIWAN card, CHI = '//real_text(fit%law%chi)//': expected tests from small amplitudes '// &
         'up to macroslip, or a column tau beside loss')
      if (errors%any()) return
      fit%fitted = followed(data, fit%law)
      call describe(data, fit)
   end subroutine fit_iwan

   !> The LAW with the unknowns Q.
   pure subroutine set_law(q, p_ref, law)
      real(wp), intent(in)         :: q(4), p_ref
      type(iwan_type), intent(out) :: law

      law = iwan_type(given=.true., f_s=exp(q(1)), k_t=exp(q(2)), chi=-1.0_wp/(1.0_wp + exp(-q(3))), p_ref=p_ref)
      if (q(4) > -huge(1.0_wp)) law%beta = exp(q(4))
      call make_slices(fine, law)
   end subroutine set_law

   !> Segalman's closed forms for the amplitude D: the stress of the tip, and the loss of a cycle.
   pure function closed_form(law, share, d) result(values)
      type(iwan_type), intent(in) :: law
      real(wp), intent(in)        :: share, d !! of the strength at P_REF; >= 0 [length]
      real(wp) :: values(2), phi, power, r, x

      phi = share*greatest_phi(law)
      power = law%k_t/(1.0_wp + law%beta)
      r = power*(law%chi + 1.0_wp)/phi**(law%chi + 1.0_wp)
      x = min(d, phi)
      values(1) = law%k_t*x - r*x**(law%chi + 2.0_wp)/((law%chi + 1.0_wp)*(law%chi + 2.0_wp))
      values(2) = 4.0_wp*r*x**(law%chi + 3.0_wp)/((law%chi + 2.0_wp)*(law%chi + 3.0_wp)) + 4.0_wp*share*law%f_s*(d - x)
   end function closed_form

   !> Unknowns from which to begin: with CHI, and beta and phi_max in proportion to TIMES.
   pure function first_guess(data, p_ref, chi, times) result(q)
      type(test_data_type), intent(in) :: data
      real(wp), intent(in)             :: p_ref, chi, times
      real(wp) :: q(4), f_s, k_t

      associate (d => abs(data%value(column_d, :data%n)), tau => abs(data%value(column_tau, :data%n)), &
                 loss => data%value(column_loss, :data%n), share => data%value(column_p, :data%n)/p_ref)
         f_s = 1.1_wp*maxval(tau/share)
         k_t = 1.1_wp*maxval(tau/max(d, not_fixed*maxval(d)))
         if (.not. f_s > 0.0_wp) then
            f_s = 1.2_wp*maxval(loss/(4.0_wp*d*share))
            k_t = 3.0_wp*f_s/(times*maxval(d))
         end if
      end associate
      q = [log(f_s), log(k_t), -log(-1.0_wp/chi - 1.0_wp), log(times)]
   end function first_guess

   !> The reading of every row by LAW: the stress at the end of a way from rest along the test, or the loss.
   pure function followed(data, law) result(reading)
      type(test_data_type), intent(in) :: data
      type(iwan_type), intent(in)      :: law
      real(wp) :: reading(data%n), tau(size(law%stiffness)), d, values(2)
      integer  :: i

      tau = 0.0_wp
      d = 0.0_wp
      do i = 1, data%n
         associate (share => data%value(column_p, i)/law%p_ref)
            if (data%kind == data_loss) then
               values = closed_form(law, share, data%value(column_d, i))
               reading(i) = values(2)
               cycle
            end if
            if (.not. data%joined(i)) tau = 0.0_wp
            if (.not. data%joined(i)) d = 0.0_wp
            tau = tau + law%stiffness*(data%value(column_d, i) - d)
            tau = min(max(tau, -share*law%strength), share*law%strength)
            d = data%value(column_d, i)
            reading(i) = sum(tau)
         end associate
      end do
   end function followed

   !> How far the law with the unknowns Q is from each reading, relative to the largest one, or of losses to it.
   pure function residuals(data, p_ref, q) result(r)
      type(test_data_type), intent(in) :: data
      real(wp), intent(in)             :: p_ref, q(:)
      real(wp), allocatable :: r(:)
      type(iwan_type) :: law
      real(wp) :: values(2)
      integer  :: i

      call set_law([q, spread(-huge(1.0_wp), 1, 4 - size(q))], p_ref, law)
      r = followed(data, law)
      associate (tau => data%value(column_tau, :data%n))
         if (data%kind /= data_loss) then
            r = (r - tau)/maxval(abs(tau))
         else
            r = log(max(r, tiny(1.0_wp))/data%value(column_loss, :data%n))
            do i = 1, merge(data%n, 0, all(tau > 0.0_wp))
               values = closed_form(law, data%value(column_p, i)/p_ref, data%value(column_d, i))
               r = [r, values(1)/tau(i) - 1.0_wp]
            end do
         end if
      end associate
   end function residuals

   !> The derivatives of the residuals R at Q.
   pure function derivatives(data, p_ref, q, r) result(jacobian)
      type(test_data_type), intent(in) :: data
      real(wp), intent(in)             :: p_ref, q(:), r(:)
      real(wp) :: jacobian(size(r), size(q)), there(size(q))
      integer  :: k

      do k = 1, size(q)
         there = q
         there(k) = q(k) + iwan_difference
         jacobian(:, k) = (residuals(data, p_ref, there) - r)/iwan_difference
      end do
   end function derivatives

   !> Go from Q, of which the first FREE unknowns are free, to the least sum of squares TOTAL.
   subroutine minimise(data, p_ref, free, q, total)
      type(test_data_type), intent(in) :: data
      real(wp), intent(in)             :: p_ref
      integer, intent(in)              :: free
      real(wp), intent(inout)          :: q(4)
      real(wp), intent(out)            :: total
      real(wp), allocatable :: jacobian(:, :), r(:)
      real(wp) :: damping, now, step(free), trial(free), unit(free, free)
      integer  :: i, k
      logical  :: ok

      unit = 0.0_wp
      damping = 1.0e-2_wp
      r = residuals(data, p_ref, q(:free))
      total = sum(r**2)
      do i = 1, most_steps
         jacobian = derivatives(data, p_ref, q(:free), r)
         do
            do k = 1, free
               unit(k, k) = sqrt(damping)*max(norm2(jacobian(:, k)), settled_iwan)
            end do
            call solve_least_squares(transpose(reshape([transpose(jacobian), unit], [free, size(r) + free])), &
                                     [-r, spread(0.0_wp, 1, free)], step, ok)
            if (.not. ok) return
            trial = q(:free) + min(max(step, -1.0_wp), 1.0_wp)
            trial(3:) = min(max(trial(3:), -12.0_wp), 12.0_wp)
            r = residuals(data, p_ref, trial)
            now = sum(r**2)
            if (now <= total .or. damping > 1.0e10_wp) exit
            damping = 10.0_wp*damping
         end do
         if (now > total) return
         damping = max(0.1_wp*damping, settled_iwan)
         step = trial - q(:free)
         q(:free) = trial
         total = now
         if (maxval(abs(step)) <= settled_iwan) return
      end do
   end subroutine minimise

   !> Standard ERROR of each unknown Q, and whether the data FIX it: by the part of its derivative that the others do not replace.
   subroutine take_errors(data, p_ref, q, total, error, fixed)
      type(test_data_type), intent(in) :: data
      real(wp), intent(in)             :: p_ref, q(:), total !! sum of squares
      real(wp), intent(out)            :: error(4)
      logical, intent(out)             :: fixed(4)
      real(wp), allocatable :: jacobian(:, :), own(:), r(:)
      real(wp) :: shares(size(q) - 1), scatter
      integer  :: k, others(size(q) - 1), j
      logical  :: ok

      error = 0.0_wp
      fixed = .true.
      r = residuals(data, p_ref, q)
      jacobian = derivatives(data, p_ref, q, r)
      scatter = sqrt(total/max(1, size(r) - size(q)))
      do k = 1, size(q)
         others = pack([(j, j = 1, size(q))], [(j /= k, j = 1, size(q))])
         own = jacobian(:, k)
         call solve_least_squares(jacobian(:, others), own, shares, ok)
         if (ok) own = own - matmul(jacobian(:, others), shares)
         fixed(k) = norm2(own) > not_fixed*norm2(jacobian(:, k)) .and. size(r) >= size(q)
         error(k) = scatter/max(norm2(own), tiny(1.0_wp)*1.0e10_wp)
      end do
      error(3) = error(3)*exp(-abs(q(3)))/(1.0_wp + exp(-abs(q(3))))**2 ! d chi/dq
   end subroutine take_errors

   !> Residual and comments of the card of FIT.
   subroutine describe(data, fit)
      type(test_data_type), intent(in)   :: data
      type(iwan_fit_type), intent(inout) :: fit

      associate (p => data%value(column_p, :data%n), d => abs(data%value(column_d, :data%n)), law => fit%law)
         fit%residual = residual_of(data%value(merge(column_loss, column_tau, data%kind == data_loss), :data%n) - fit%fitted)
         call fit%comments%add(0, 'Iwan''s law, phi_max = '//real_text(greatest_phi(law))//' at p = '//real_text(law%p_ref)// &
                               '; the loss of small cycles grows as d^'//real_text(law%chi + 3.0_wp))
         call fit%comments%add(0, plural(data%n, 'point')//', p '//real_text(minval(p))//' to '//real_text(maxval(p))// &
                               ', d to '//real_text(maxval(d))//'; standard errors: FS '//per_cent(fit%error(1))//', KT '// &
                               per_cent(fit%error(2))//', CHI '//real_text(fit%error(3))//', BETA '//per_cent(fit%error(4)))
         call fit%comments%add(0, 'residual of '//trim(fit%reading)//': rms '//real_text(fit%residual%rms)//', largest '// &
                               real_text(fit%residual%largest)//' at p = '//real_text(p(fit%residual%at))//', d = '// &
                               real_text(d(fit%residual%at)))
         call fit%comments%add(0, 'PJOINT names this card in IID, and has PREF '//real_text(law%p_ref)//' on its continuation')
      end associate

   contains

      function per_cent(share) result(words)
         real(wp), intent(in)      :: share
         character(:), allocatable :: words

         words = real_text(0.01_wp*nint(1.0e4_wp*min(share, 1.0e4_wp)))//' %'
      end function per_cent

   end subroutine describe

end module iwan_fit
