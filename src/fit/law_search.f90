!> Seeks the parameters of a structure for which its answers are nearest to what was measured: the least sum of squares of the
!! differences over the standard deviations, by MINPACK's lmder. An unknown y is the logarithm of a parameter, or of a LINEAR one
!! its value over a scale; between bounds MINPACK sees z of y = (b + c)/2 + (c - b)/2 sin z. Derivatives are differences of runs.
!! A run that fails is a rejected step. A parameter that the rows do not determine is held at its start, and the search goes on.
!! A search follows modes by their shapes, so that its sum of squares is smooth. What is least in the end is the sum with MODE = i the
!! i-th frequency there: where modes have changed places they are paired anew, and close neighbours are exchanged to see what is less.
!! Source: J. J. More, The Levenberg-Marquardt algorithm, Lecture Notes in Mathematics 630 (1978) 105-116.
module law_search
   use fit_statistics, only: statistics_type, weigh
   use incomplete_results, only: interrupt_so_far
   use kinds, only: wp
   use measured_data, only: differences, inner_value, measured_type, outer_value, unknown_of, y_of
   use mode_rows, only: answer_type, exchange_modes, is_of_modes, is_predicted, match_again, structure_type
   use runs_together, only: run_all
   use terminal, only: show_line
   use text_tools, only: integer_text, real_text
   use tolerances, only: at_bound, far_better, round_settled, search_difference, search_settled, undetermined, worth_a_round
   implicit none
   private

   public :: seek

   integer, parameter  :: most_runs = 100          ! of a round, without those for derivatives
   integer, parameter  :: few_runs = 20            ! ... of one with predicted frequencies
   integer, parameter  :: most_rounds = 30, most_backs = 4, most_again = 2
   real(wp), parameter :: failed = 1.0e8_wp        ! times the deviation: the difference of a run that has failed
   real(wp), parameter :: first_step = 0.7_wp      ! of an unknown
   real(wp), parameter :: small = 0.01_wp          ! step of z for dy/dz
   real(wp), parameter :: same_minimum = 0.01_wp   ! of a sum of squares
   integer, parameter  :: most_pairings = 12       ! of modes with rows, from a start

   type, public :: search_type
      real(wp), allocatable :: y(:)                !! (parameters) the best unknowns found
      logical, allocatable  :: is_held(:), is_at_bound(:) !! (parameters) not determined; at a bound
      integer, allocatable  :: free(:)             !! the others
      type(answer_type)     :: first, best         !! answers at the start, and there
      type(statistics_type) :: statistics          !! of the unknowns that are free
      real(wp) :: square = huge(1.0_wp)            !! sum of squares
      integer  :: n_runs = 0, n_starts = 0, n_same = 0 !! N_SAME: starts that have led to the least sum
      real(wp), allocatable :: ends(:, :), squares(:) !! (parameters, pairings) where each search has ended, and its least sum
      logical  :: by_number = .false.              !! numbers of modes are those at the values found, not at the start
      character(:), allocatable :: fault           !! why there is no answer; '': there is
   end type search_type

   type :: task_type
      type(measured_type)   :: data
      type(structure_type)  :: structure
      type(search_type)     :: search
      integer :: cores = 1
      real(wp), allocatable :: from(:)             ! the unknowns of all parameters at the start of this round
      real(wp), allocatable :: x_from(:)           ! those of lmder there
      type(answer_type)     :: near, last          ! the answer there in full; of the last run that has not failed
      type(answer_type)     :: found, paired       ! of the least sum of squares with one pairing of the modes; with the best one
      real(wp), allocatable :: y(:), paired_y(:)   ! the unknowns of FOUND and PAIRED
      real(wp) :: square = huge(1.0_wp)            ! that sum
      real(wp), allocatable :: jacobian(:, :), x(:), f(:) ! of lmder, and where it had the derivatives last
      integer  :: n_steps = 0                      ! tried since then
      logical  :: pairs_soon = .false.             ! end a round where the sum with MODE counting there is less
      logical  :: is_predicted = .false.           ! there are frequencies that the modes of a run nearby predict
   end type task_type
   type(task_type), pointer :: task => null()      ! for MINPACK, whose routines have no place for data

   interface
      subroutine lmder(fcn, m, n, x, fvec, fjac, ldfjac, ftol, xtol, gtol, maxfev, diag, mode, factor, nprint, info, nfev, njev, &
                       ipvt, qtf, wa1, wa2, wa3, wa4)
         import :: wp
         external :: fcn
         integer, intent(in)     :: m, n, ldfjac, maxfev, mode, nprint
         integer, intent(out)    :: info, nfev, njev, ipvt(n)
         real(wp), intent(inout) :: x(n), diag(n)
         real(wp), intent(in)    :: ftol, xtol, gtol, factor
         real(wp), intent(out)   :: fvec(m), fjac(ldfjac, n), qtf(n), wa1(n), wa2(n), wa3(n), wa4(m)
      end subroutine lmder
   end interface

contains

   !> Seek the parameters of DATA from N_STARTS starts: the given one, and others between the bounds, or within a factor e of
   !! the start. An interrupt ends the search with the best values so far.
   subroutine seek(data, structure, n_starts, cores, search)
      type(measured_type), intent(in)  :: data
      type(structure_type), intent(in) :: structure
      integer, intent(in)              :: n_starts, cores
      type(search_type), intent(out)   :: search
      real(wp) :: found, least, left, y(size(data%parameters))
      integer  :: i, k, n_again

      allocate (task)
      task%data = data
      task%structure = structure
      task%cores = cores
      task%is_predicted = any([(is_predicted(data, i, structure%plan), i = 1, size(structure%plan%stages))] .and. &
         [(any(is_of_modes(data%rows) .and. data%rows%stage == structure%plan%stages(i)%id), i = 1, size(structure%plan%stages))])
      task%search%free = [(i, i = 1, size(y))]
      allocate (task%search%is_held(size(y)), task%search%is_at_bound(size(y)), source=.false.)
      allocate (task%search%ends(size(y), 0), task%search%squares(0))
      least = huge(least)
      do k = 1, n_starts
         y = inner_value(data%parameters, data%parameters%start)
         do i = 1, merge(size(y), 0, k > 1)
            associate (part => 0.05_wp + 0.9_wp*modulo((k - 1)*sqrt(i**2 + 1.0_wp), 1.0_wp))
               if (.not. data%parameters(i)%is_bounded) y(i) = y(i) + 2.0_wp*part - 1.0_wp
               if (data%parameters(i)%is_bounded) y(i) = y_of(data%parameters(i), asin(2.0_wp*part - 1.0_wp))
            end associate
         end do
         call pair_modes(y, least, found)
         task%search%n_starts = k
         associate (margin => same_minimum*(1.0_wp + found))
            if (abs(found - least) <= margin) task%search%n_same = task%search%n_same + 1
            if (found < least - margin) task%search%n_same = 1
         end associate
         least = min(least, found)
         if (task%search%fault /= '' .or. interrupt_so_far() /= 0) exit
      end do
      if (task%search%fault == '') task%structure%shapes = task%search%best%shapes
      n_again = 0
      do while (task%search%fault == '' .and. interrupt_so_far() == 0 .and. size(task%search%free) > 0)
         call judge(k, left)
         y = task%search%y
         if (k == 0) then
            if (left <= worth_a_round .or. n_again == most_again) exit
            n_again = n_again + 1
         else
            task%search%free = pack(task%search%free, task%search%free /= k)
            if (task%search%is_at_bound(k)) cycle
            task%search%is_held(k) = .true.
            y(k) = inner_value(data%parameters(k), data%parameters(k)%start)
         end if
         call minimise(y)
         call take_found(task%search%by_number)
      end do
      search = task%search
      deallocate (task)
   end subroutine seek

   !> From the unknowns Y, with one pairing of modes and rows after another: first MODE counts there, then where the search has ended,
   !! until it still does so where the next one ends; then close neighbours change places. The best answer is that with the least sum
   !! of squares with MODE counting where a search ends, FOUND, unless that of the first pairing is far below. LEAST is that so far.
   subroutine pair_modes(y, least, found)
      real(wp), intent(in)  :: y(:), least
      real(wp), intent(out) :: found
      real(wp) :: square, z(size(y))
      integer  :: i, numbers(size(task%data%rows))
      logical  :: is_better, is_tried(size(numbers), 2)

      z = y
      numbers = task%data%rows%mode
      is_tried = .false.
      found = huge(found)
      do i = 1, most_pairings
         task%structure%numbers = numbers
         if (allocated(task%structure%shapes)) deallocate (task%structure%shapes)
         task%pairs_soon = i == 1
         call minimise(z)
         task%pairs_soon = .false.
         is_better = .false.
         if (task%square < huge(found)) then
            square = sum(differences(task%data, task%found%value + task%found%off_number)**2)
            if (i == 1) square = min(square, task%square + far_better)
            task%search%ends = reshape([task%search%ends, task%y], shape(task%search%ends) + [0, 1])
            task%search%squares = [task%search%squares, square]
            is_better = square < found - same_minimum
            if (is_better) then
               found = square
               task%paired_y = task%y
               task%paired = task%found
               if (square < least) call take_found(i > 1)
            end if
         end if
         if (found >= huge(found) .or. interrupt_so_far() /= 0) exit
         z = task%paired_y
         numbers = task%data%rows%mode
         if (is_better .and. any(abs(task%found%off_number) > 0.0_wp)) cycle
         call exchange_modes(task%data, task%structure, task%paired, &
                             sqrt(max(1.0_wp, found/max(1, size(numbers) - size(task%search%free)))), numbers, is_tried)
         if (all(numbers == task%data%rows%mode)) exit
      end do
   end subroutine pair_modes

   !> The answer at the unknowns Y of PAIRED, whose modes the rows take by their numbers now, in LAST; OK: all that the rows want of its
   !! modes are frequencies, and it is there.
   subroutine pair_again(y, ok)
      real(wp), intent(in) :: y(:)
      logical, intent(out) :: ok

      ok = task%is_predicted .and. allocated(task%paired%value)
      if (ok) ok = all(abs(y - task%paired_y) <= 0.0_wp)
      if (ok) task%last = task%paired
      if (ok) call match_again(task%data, task%structure, task%last, ok)
   end subroutine pair_again

   !> Take what has been found with one pairing of the modes as the best answer.
   subroutine take_found(by_number)
      logical, intent(in) :: by_number

      task%search%y = task%y
      task%search%best = task%found
      task%search%square = task%square
      task%search%by_number = by_number
   end subroutine take_found

   !> Go from the unknowns Y to the least sum of squares over those that are free. Where runs near another one predict frequencies,
   !! lmder has these, and each round begins with a run in full where the last one has ended; a worse one goes half the way back.
   subroutine minimise(y)
      real(wp), intent(in) :: y(:)
      real(wp), dimension(size(task%search%free)) :: diag, qtf, wa1, wa2, wa3, x
      real(wp) :: fjac(size(task%data%rows), size(x)), fvec(size(task%data%rows)), wa4(size(task%data%rows)), best, now, z(size(y))
      integer  :: backs, info, ipvt(size(x)), n, nfev, njev, round

      n = size(x)
      z = y
      best = huge(best)
      backs = 0
      task%square = huge(best)
      task%y = y
      associate (parameters => task%data%parameters, free => task%search%free)
         do round = 1, most_rounds
            call run_at(z, now)
            if (now >= best) then
               if (round == 1 .or. backs == most_backs .or. interrupt_so_far() /= 0) exit
               backs = backs + 1
               z = 0.5_wp*(z + task%from)
               cycle
            end if
            task%from = z
            task%near = task%last
            if (task%pairs_soon .and. sum(differences(task%data, task%last%value + task%last%off_number)**2) < now) exit
            if (n == 0 .or. best - now <= search_settled*max(1.0_wp, best)) exit ! far below one deviation
            if (round > 1 .and. task%is_predicted) then
               if (sum((differences(task%data, task%last%value) - fvec)**2) <= round_settled) exit ! as predicted
            end if
            best = now
            diag = 1.0_wp
            x = unknown_of(parameters(free), z(free))
            task%x_from = x
            task%jacobian = fjac
            task%n_steps = -1 ! the derivatives at the start are those of runs
            call lmder(ask, size(fvec), n, x, fvec, fjac, size(fvec), merge(round_settled, search_settled, task%is_predicted), &
               1.0e-2_wp*search_settled, 0.0_wp, merge(few_runs, most_runs, task%is_predicted), &
               diag, 2, first_step*sqrt(real(n, wp))/merge(norm2(x), 1.0_wp, norm2(x) > 0.0_wp), 0, info, nfev, njev, ipvt, qtf, &
               wa1, wa2, wa3, wa4)
            z(free) = y_of(parameters(free), x)
            if (info < 0) exit
         end do
      end associate
   end subroutine minimise

   !> Run in full at the unknowns Y. SQUARE is the sum of squares, huge where the run fails.
   subroutine run_at(y, square)
      real(wp), intent(in)  :: y(:)
      real(wp), intent(out) :: square
      type(answer_type), allocatable :: answers(:)
      logical :: is_known

      square = huge(square)
      associate (search => task%search)
         is_known = allocated(search%y) .and. allocated(task%structure%shapes)
         if (is_known) is_known = all(abs(y - search%y) <= 0.0_wp)
         if (is_known) task%last = search%best
         if (.not. (is_known .or. allocated(task%structure%shapes))) call pair_again(y, is_known)
         if (.not. is_known) then
            call run_all(task%data, task%structure, reshape(outer_value(task%data%parameters, y), [size(y), 1]), &
                         task%cores, answers)
            search%n_runs = search%n_runs + 1
            if (interrupt_so_far() /= 0) return
            if (.not. allocated(search%first%value)) search%fault = answers(1)%fault
            if (answers(1)%fault /= '') return
            if (.not. allocated(search%first%value)) search%first = answers(1)
            task%last = answers(1)
            task%structure%known = answers(1)%stages
            task%structure%reached = answers(1)%reached
         end if
         if (.not. allocated(task%structure%shapes)) task%structure%shapes = task%last%shapes
         square = sum(differences(task%data, task%last%value)**2)
         if (square < task%square) then
            task%y = y
            task%found = task%last
            task%square = square
         end if
         call show_line('run '//integer_text(search%n_runs)//', least sum of squares '// &
                        real_text(min(search%square, task%square)), at_once=.true., is_logged=.true.)
      end associate
   end subroutine run_at

   !> For lmder: at X the differences FVEC (IFLAG 1) or their derivatives FJAC (IFLAG 2); IFLAG below zero ends the search.
   subroutine ask(m, n, x, fvec, fjac, ldfjac, iflag)
      integer, intent(in)     :: m, n, ldfjac
      real(wp), intent(in)    :: x(n)
      real(wp), intent(inout) :: fvec(m), fjac(ldfjac, n)
      integer, intent(inout)  :: iflag
      type(answer_type), allocatable :: answers(:)
      real(wp) :: square, y(size(task%data%parameters))

      y = task%from
      associate (parameters => task%data%parameters, free => task%search%free)
         y(free) = y_of(parameters(free), x)
         if (iflag == 2) then
            if (task%n_steps == 1) then
               associate (s => x - task%x)
                  task%jacobian = task%jacobian + spread(fvec - task%f - matmul(task%jacobian, s), 2, n)*spread(s, 1, m)/sum(s**2)
               end associate
            else
               call differentiate(task%last%value, y, .false., task%jacobian)
               task%jacobian = task%jacobian* &
                  spread((y_of(parameters(free), x + small) - y_of(parameters(free), x - small))/(2.0_wp*small), 1, m)
            end if
            fjac = task%jacobian
            task%x = x
            task%f = fvec
            task%n_steps = 0
         else
            task%n_steps = task%n_steps + 1
            square = 0.0_wp
            if (all(abs(x - task%x_from) <= 0.0_wp)) then
               task%last = task%near
            else if (task%is_predicted) then
               call run_all(task%data, task%structure, reshape(outer_value(parameters, y), [size(y), 1]), task%cores, answers, &
                            task%near)
               task%search%n_runs = task%search%n_runs + 1
               if (answers(1)%fault /= '') square = huge(square)
               if (answers(1)%fault == '') then
                  task%last = answers(1)
                  task%structure%reached = answers(1)%reached
               end if
            else
               call run_at(y, square)
               if (square < huge(square)) task%near = task%last
            end if
            fvec = failed
            if (square < huge(square)) fvec = differences(task%data, task%last%value)
         end if
         if (interrupt_so_far() /= 0) iflag = -1
      end associate
   end subroutine ask

   !> The derivatives of the differences by the free unknowns at Y, where the rows have VALUE; IS_CENTRAL: by steps to both sides.
   subroutine differentiate(value, y, is_central, derivatives)
      real(wp), intent(in)  :: value(:), y(:)
      logical, intent(in)   :: is_central
      real(wp), intent(out) :: derivatives(:, :)
      type(answer_type), allocatable :: answers(:)
      real(wp) :: before(size(value)), ends(2), points(size(y), 0:2*size(task%search%free)), step
      integer  :: j, k, sides

      associate (free => task%search%free, parameters => task%data%parameters)
         sides = merge(2, 1, is_central)
         points = spread(y, 2, size(points, 2))
         do j = 1, size(free)
            associate (p => parameters(free(j)))
               step = search_difference
               if (any(task%data%rows%amplitude > 0.0_wp)) step = 2.0_wp*step
               if (p%is_bounded) ends = inner_value(p, [p%low, p%high])
               if (.not. p%is_bounded) ends = y(free(j)) + 2.0_wp*step*[-1, 1]
               if (y(free(j)) + step > ends(2)) step = -step
               points(free(j), j) = y(free(j)) + step
               points(free(j), size(free) + j) = min(ends(2), max(ends(1), y(free(j)) - step))
            end associate
         end do
         call run_all(task%data, task%structure, outer_value(spread(parameters, 2, 1 + sides*size(free)), &
                      points(:, :sides*size(free))), task%cores, answers, task%near, together=.true.)
         task%search%n_runs = task%search%n_runs + size(answers) - merge(0, 1, answers(1)%fault == '')
         derivatives = 0.0_wp
         do j = 1, size(free)
            do k = j, size(answers) - 1, size(free)
               if (answers(k + 1)%fault == '') cycle
               answers(k + 1)%value = value
               points(free(j), k) = y(free(j))
            end do
            k = merge(size(free) + j, 0, is_central)
            ends = points(free(j), [j, k])
            before = value
            if (is_central) before = answers(k + 1)%value
            if (abs(ends(1) - ends(2)) > 0.0_wp) derivatives(:, j) = &
               differences(task%data, task%data%rows%value + answers(j + 1)%value - before)/(ends(1) - ends(2))
         end do
      end associate
   end subroutine differentiate

   !> Judge the free unknowns at the best values: K is one at its bound, or one that the rows do not determine; 0: there is none,
   !! and the statistics are those of all. LEFT is what a step of Gauss and Newton would take from the sum of squares.
   subroutine judge(k, left)
      integer, intent(out)  :: k
      real(wp), intent(out) :: left
      real(wp) :: jacobian(size(task%data%rows), size(task%search%free)), slope(size(task%search%free))

      associate (search => task%search, free => task%search%free)
         k = findloc(abs(cos(unknown_of(task%data%parameters(free), search%y(free)))) < at_bound .and. &
                     task%data%parameters(free)%is_bounded, .true., dim=1)
         if (k > 0) k = free(k)
         if (k > 0) search%is_at_bound(k) = .true.
         left = 0.0_wp
         if (k > 0) return
         task%near = search%best
         call differentiate(search%best%value, search%y, .true., jacobian)
         if (interrupt_so_far() /= 0) return
         call weigh(jacobian, search%statistics)
         if (search%statistics%least < max(1.0_wp, undetermined*search%statistics%largest)) k = free(search%statistics%weakest)
         slope = search%statistics%deviation*matmul(differences(task%data, search%best%value), jacobian)
         left = dot_product(slope, matmul(search%statistics%correlation, slope))
      end associate
   end subroutine judge

end module law_search
