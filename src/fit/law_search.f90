!> Seeks the parameters of a structure for which its answers are nearest to what was measured: the least sum of squares of the
!! differences over the standard deviations, by MINPACK's lmder. An unknown y is the logarithm of a parameter, or of a LINEAR one
!! its value over a scale; between bounds MINPACK sees z of y = (b + c)/2 + (c - b)/2 sin z. Derivatives are differences of runs.
!! A run that fails is a rejected step. A parameter that the rows do not determine is held at its start, and the search goes on.
!! Source: J. J. More, The Levenberg-Marquardt algorithm, Lecture Notes in Mathematics 630 (1978) 105-116.
module law_search
   use fit_statistics, only: statistics_type, weigh
   use incomplete_results, only: interrupt_so_far
   use kinds, only: wp
   use measured_data, only: a_phase, measured_type, sought_parameter
   use runs_together, only: run_all
   use structure_answers, only: answer_type, structure_type
   use terminal, only: show_line
   use text_tools, only: integer_text, real_text
   use tolerances, only: at_bound, search_difference, search_settled, undetermined
   implicit none
   private

   public :: seek, differences, inner_value, outer_value, unknown_of, y_of

   integer, parameter  :: most_runs = 100          ! of a search, without those for derivatives
   real(wp), parameter :: failed = 1.0e8_wp        ! times the deviation: the difference of a run that has failed
   real(wp), parameter :: first_step = 0.7_wp      ! of an unknown
   real(wp), parameter :: small = 0.01_wp          ! step of z for dy/dz
   real(wp), parameter :: same_minimum = 0.01_wp   ! of a sum of squares

   type, public :: search_type
      real(wp), allocatable :: y(:)                !! (parameters) the best unknowns found
      logical, allocatable  :: is_held(:), is_at_bound(:) !! (parameters) not determined; at a bound
      integer, allocatable  :: free(:)             !! the others
      type(answer_type)     :: first, best         !! answers at the start, and there
      type(statistics_type) :: statistics          !! of the unknowns that are free
      real(wp) :: square = huge(1.0_wp)            !! sum of squares
      integer  :: n_runs = 0, n_starts = 0, n_same = 0 !! N_SAME: starts that have led to the least sum
      logical  :: by_number = .false.              !! numbers of modes are those at the values found, not at the start
      character(:), allocatable :: fault           !! why there is no answer; '': there is
   end type search_type

   type :: task_type
      type(measured_type)   :: data
      type(structure_type)  :: structure
      type(search_type)     :: search
      integer :: cores = 1
      real(wp), allocatable :: from(:)             ! the unknowns of all parameters at the start of this search
      real(wp), allocatable :: y(:)                ! of the last run that has not failed
      type(answer_type)     :: last                ! its answer
      real(wp) :: square = huge(1.0_wp)            ! least sum of squares of this search
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

   !> The unknown y of PARAMETER at VALUE, and the value at the unknown Y.
   elemental real(wp) function inner_value(parameter, value) result(y)
      type(sought_parameter), intent(in) :: parameter
      real(wp), intent(in)               :: value

      if (parameter%is_linear) y = value/scale_of(parameter)
      if (.not. parameter%is_linear) y = log(value)
   end function inner_value

   elemental real(wp) function outer_value(parameter, y) result(value)
      type(sought_parameter), intent(in) :: parameter
      real(wp), intent(in)               :: y

      if (parameter%is_linear) value = y*scale_of(parameter)
      if (.not. parameter%is_linear) value = exp(y)
   end function outer_value

   !> The scale of a linear parameter: between its bounds, or its start.
   elemental real(wp) function scale_of(parameter) result(scale)
      type(sought_parameter), intent(in) :: parameter

      scale = abs(parameter%start)
      if (parameter%is_bounded) scale = parameter%high - parameter%low
      if (.not. scale > 0.0_wp) scale = 1.0_wp
   end function scale_of

   !> z of PARAMETER at the unknown Y, and y at Z.
   elemental real(wp) function unknown_of(parameter, y) result(z)
      type(sought_parameter), intent(in) :: parameter
      real(wp), intent(in)               :: y

      z = y
      if (.not. parameter%is_bounded) return
      associate (b => inner_value(parameter, parameter%low), c => inner_value(parameter, parameter%high))
         z = asin(max(-1.0_wp, min(1.0_wp, (2.0_wp*y - b - c)/(c - b))))
      end associate
   end function unknown_of

   elemental real(wp) function y_of(parameter, z) result(y)
      type(sought_parameter), intent(in) :: parameter
      real(wp), intent(in)               :: z

      y = z
      if (.not. parameter%is_bounded) return
      associate (b => inner_value(parameter, parameter%low), c => inner_value(parameter, parameter%high))
         y = 0.5_wp*(b + c) + 0.5_wp*(c - b)*sin(z)
      end associate
   end function y_of

   !> The differences of ANSWER from the values of DATA, over their deviations.
   pure function differences(data, answer) result(d)
      type(measured_type), intent(in) :: data
      type(answer_type), intent(in)   :: answer
      real(wp) :: d(size(data%rows))

      d = answer%value - data%rows%value
      where (data%rows%kind == a_phase) d = d - 360.0_wp*anint(d/360.0_wp)
      d = d/data%rows%deviation
   end function differences

   !> Seek the parameters of DATA from N_STARTS starts: the given one, and others between the bounds, or within a factor e of
   !! the start. An interrupt ends the search with the best values so far.
   subroutine seek(data, structure, n_starts, cores, search)
      type(measured_type), intent(in)  :: data
      type(structure_type), intent(in) :: structure
      integer, intent(in)              :: n_starts, cores
      type(search_type), intent(out)   :: search
      real(wp) :: least, y(size(data%parameters))
      integer  :: i, k

      allocate (task)
      task%data = data
      task%structure = structure
      task%cores = cores
      task%search%free = [(i, i = 1, size(y))]
      allocate (task%search%is_held(size(y)), task%search%is_at_bound(size(y)), source=.false.)
      do k = 1, n_starts
         y = inner_value(data%parameters, data%parameters%start)
         do i = 1, merge(size(y), 0, k > 1)
            associate (part => modulo(0.5_wp*(k - 1)*sqrt(real(4*i + 1, wp)), 1.0_wp))
               if (.not. data%parameters(i)%is_bounded) y(i) = y(i) + 2.0_wp*part - 1.0_wp
               if (data%parameters(i)%is_bounded) y(i) = y_of(data%parameters(i), asin(2.0_wp*part - 1.0_wp))
            end associate
         end do
         least = task%search%square
         task%structure%by_number = .false.
         call minimise(y)
         if (allocated(task%search%best%mode)) then ! modes have changed places: a number may be that at the end
            task%structure%by_number = any(task%search%best%mode /= data%rows%mode .and. data%rows%mode > 0)
            if (task%structure%by_number) call minimise(y)
         end if
         task%search%n_starts = k
         associate (found => task%square, margin => same_minimum*(1.0_wp + task%square))
            if (abs(found - least) <= margin) task%search%n_same = task%search%n_same + 1
            if (found < least - margin) task%search%n_same = 1
         end associate
         if (task%search%fault /= '' .or. interrupt_so_far() /= 0) exit
      end do
      task%structure%by_number = task%search%by_number
      do while (task%search%fault == '' .and. interrupt_so_far() == 0 .and. size(task%search%free) > 0)
         call judge(k)
         if (k == 0) exit
         task%search%free = pack(task%search%free, task%search%free /= k)
         if (task%search%is_at_bound(k)) cycle
         task%search%is_held(k) = .true.
         y = task%search%y
         y(k) = inner_value(data%parameters(k), data%parameters(k)%start)
         task%search%square = huge(1.0_wp)
         call minimise(y)
      end do
      search = task%search
      deallocate (task)
   end subroutine seek

   !> Go from the unknowns Y to the least sum of squares over those that are free.
   subroutine minimise(y)
      real(wp), intent(in) :: y(:)
      real(wp), dimension(size(task%search%free)) :: diag, qtf, wa1, wa2, wa3, x
      real(wp) :: fjac(size(task%data%rows), size(x)), fvec(size(task%data%rows)), wa4(size(task%data%rows))
      integer  :: info, ipvt(size(x)), m, n, nfev, njev

      task%from = y
      task%square = huge(1.0_wp)
      x = unknown_of(task%data%parameters(task%search%free), y(task%search%free))
      m = size(fvec)
      n = size(x)
      info = 1
      diag = 1.0_wp
      if (n == 0) call ask(m, n, x, fvec, fjac, m, info)
      if (n > 0) call lmder(ask, m, n, x, fvec, fjac, m, search_settled, 1.0e-2_wp*search_settled, 0.0_wp, most_runs, diag, 2, &
         first_step*sqrt(real(n, wp))/merge(norm2(x), 1.0_wp, norm2(x) > 0.0_wp), 0, info, nfev, njev, ipvt, qtf, wa1, wa2, &
         wa3, wa4)
   end subroutine minimise

   !> For lmder: at X the differences FVEC (IFLAG 1) or their derivatives FJAC (IFLAG 2); IFLAG below zero ends the search.
   subroutine ask(m, n, x, fvec, fjac, ldfjac, iflag)
      integer, intent(in)     :: m, n, ldfjac
      real(wp), intent(in)    :: x(n)
      real(wp), intent(inout) :: fvec(m), fjac(ldfjac, n)
      integer, intent(inout)  :: iflag
      type(answer_type), allocatable :: answers(:)
      real(wp) :: y(size(task%data%parameters))

      y = task%from
      associate (search => task%search, parameters => task%data%parameters)
         y(search%free) = y_of(parameters(search%free), x)
         if (iflag == 1) then
            call run_all(task%data, task%structure, reshape(outer_value(parameters, y), [size(y), 1]), task%cores, answers)
            search%n_runs = search%n_runs + 1
            fvec = failed
            if (interrupt_so_far() /= 0 .or. (answers(1)%fault /= '' .and. .not. allocated(search%y))) then
               search%fault = answers(1)%fault
               if (allocated(search%y)) search%fault = ''
               iflag = -1
            else if (answers(1)%fault == '') then
               fvec = differences(task%data, answers(1))
               task%y = y
               task%last = answers(1)
               if (.not. allocated(search%y)) search%first = answers(1)
               if (.not. allocated(search%y)) task%structure%shapes = answers(1)%shapes
               task%square = min(task%square, sum(fvec**2))
               if (sum(fvec**2) < search%square .or. .not. allocated(search%y)) then
                  search%y = y
                  search%best = answers(1)
                  search%by_number = task%structure%by_number
                  search%square = sum(fvec**2)
               end if
            end if
            call show_line('run '//integer_text(search%n_runs)//', least sum of squares '//real_text(search%square), &
                           at_once=.true., is_logged=.true.)
         else if (any(abs(y - task%y) > 0.0_wp)) then ! the first run of this start has failed
            iflag = -1
         else
            call differentiate(task%last, y, .false., fjac(:m, :))
            fjac = fjac*spread((y_of(parameters(search%free), x + small) - y_of(parameters(search%free), x - small))/ &
                               (2.0_wp*small), 1, m)
            if (interrupt_so_far() /= 0) iflag = -1
         end if
      end associate
   end subroutine ask

   !> The derivatives of the differences by the free unknowns at Y, where the answer is NEAR; IS_CENTRAL: by steps to both sides.
   subroutine differentiate(near, y, is_central, derivatives)
      type(answer_type), intent(in) :: near
      real(wp), intent(in)          :: y(:)
      logical, intent(in)           :: is_central
      real(wp), intent(out)         :: derivatives(:, :)
      type(answer_type), allocatable :: answers(:)
      real(wp) :: ends(2), points(size(y), 2*size(task%search%free)), step
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
         call run_all(task%data, task%structure, outer_value(spread(parameters, 2, sides*size(free)), &
                      points(:, :sides*size(free))), task%cores, answers, near)
         task%search%n_runs = task%search%n_runs + size(answers)
         derivatives = 0.0_wp
         do j = 1, size(free)
            do k = j, size(answers), size(free)
               if (answers(k)%fault /= '') answers(k) = near
               if (answers(k)%fault == '' .and. all(abs(answers(k)%value - near%value) <= 0.0_wp)) points(free(j), k) = y(free(j))
            end do
            k = merge(size(free) + j, j, is_central)
            if (is_central) then
               step = points(free(j), j) - points(free(j), k)
               if (abs(step) > 0.0_wp) derivatives(:, j) = differences_of(answers(j), answers(k))/step
            else
               step = points(free(j), j) - y(free(j))
               if (abs(step) > 0.0_wp) derivatives(:, j) = differences_of(answers(j), near)/step
            end if
         end do
      end associate

   contains

      function differences_of(a, b) result(d)
         type(answer_type), intent(in) :: a, b
         real(wp) :: d(size(task%data%rows))

         d = a%value - b%value
         where (task%data%rows%kind == a_phase) d = d - 360.0_wp*anint(d/360.0_wp)
         d = d/task%data%rows%deviation
      end function differences_of

   end subroutine differentiate

   !> Judge the free unknowns at the best values: K is one at its bound, or one that the rows do not determine; 0: there is none,
   !! and the statistics are those of all.
   subroutine judge(k)
      integer, intent(out) :: k
      real(wp) :: jacobian(size(task%data%rows), size(task%search%free))

      associate (search => task%search, free => task%search%free)
         k = findloc(abs(cos(unknown_of(task%data%parameters(free), search%y(free)))) < at_bound .and. &
                     task%data%parameters(free)%is_bounded, .true., dim=1)
         if (k > 0) k = free(k)
         if (k > 0) search%is_at_bound(k) = .true.
         if (k > 0) return
         call differentiate(search%best, search%y, .true., jacobian)
         if (interrupt_so_far() /= 0) return
         call weigh(jacobian, search%statistics)
         if (search%statistics%least < max(1.0_wp, undetermined*search%statistics%largest)) k = free(search%statistics%weakest)
      end associate
   end subroutine judge

end module law_search
