!> The modes that the rows of a measured file mean, and what runs of a structure share and answer. A mode is followed by its
!! shape: that of the largest MAC (x^T y)^2/(x^T x y^T y) with the shape given, or with that of a run before; without one, the
!! mode is that of its number.
module mode_rows
   use deck_input, only: deck_type
   use deck_parameters, only: parameter_type
   use element_mapping, only: two_pi
   use equation_solver, only: equation_system, failure_type
   use kinds, only: wp
   use measured_data, only: a_frequency, a_loss, a_phase, an_amplitude, measured_row, measured_type
   use mode_span, only: stage_modes
   use model_data, only: model_type
   use oscillating_structure, only: oscillating_type
   use stage_plan, only: stage_plan_type
   use text_tools, only: integer_text
   use tolerances, only: close_modes, least_mac
   implicit none
   private

   public :: is_of_modes, is_predicted, mac_of, match_rows, match_again, shapes_near, exchange_modes

   !> What the runs share.
   type, public :: structure_type
      character(:), allocatable :: path, watched
      type(parameter_type), allocatable :: set(:)    !! of --set, which stay
      type(deck_type)       :: deck
      type(model_type)      :: model
      type(stage_plan_type) :: plan
      class(equation_system), allocatable :: system  !! its bodies formed for the start
      logical, allocatable  :: keeps_bodies(:)       !! (parameters) the bodies do not depend on it
      type(oscillating_type) :: oscillating(0:1)     !! with and without supports
      real(wp), allocatable :: shapes(:, :)          !! (components, rows) of the modes that are followed; or not allocated:
      integer, allocatable  :: numbers(:)            !! (rows) of the modes
      type(stage_modes), allocatable :: known(:)     !! (stages) modes of the last run in full, where the next ones begin
      real(wp), allocatable :: reached(:, :, :)      !! REACHED of the last run
   end type structure_type

   type, public :: answer_type
      real(wp), allocatable :: set(:)                !! (parameters) their values
      character(:), allocatable :: fault             !! why the run failed, '': it did not
      real(wp), allocatable :: value(:)              !! (rows)
      real(wp), allocatable :: off_number(:)         !! (rows) frequency of the mode with the number of the row, less VALUE
      real(wp), allocatable :: mac(:)                !! (rows) of modes, else 1
      integer, allocatable  :: mode(:)               !! (rows) place of the mode among those found, 0: none
      type(stage_modes), allocatable :: stages(:)    !! of a run in full
      real(wp), allocatable :: shapes(:, :)          !! (components, rows) of the modes
      real(wp), allocatable :: reached(:, :, :)      !! (dimension, retained, increments) displacements by NEWTON, or none
   end type answer_type

contains

   !> Whether ROW needs the modes of its stage.
   elemental logical function is_of_modes(row)
      type(measured_row), intent(in) :: row

      is_of_modes = any(row%kind == [a_frequency, a_loss, an_amplitude, a_phase])
   end function is_of_modes

   !> Whether all that the rows want of the modes of stage S of PLAN are frequencies of small oscillation.
   pure logical function is_predicted(data, s, plan)
      type(measured_type), intent(in)   :: data
      integer, intent(in)               :: s
      type(stage_plan_type), intent(in) :: plan

      is_predicted = all(data%rows%stage /= plan%stages(s)%id .or. .not. is_of_modes(data%rows) .or. &
                         (data%rows%kind == a_frequency .and. data%rows%amplitude <= 0.0_wp))
   end function is_predicted

   !> MAC of two shapes: 1 where they are proportional, 0 where they are orthogonal.
   pure real(wp) function mac_of(x, y) result(mac)
      real(wp), intent(in) :: x(:), y(:)
      real(wp) :: scale

      mac = 0.0_wp
      scale = sum(x**2)*sum(y**2)
      if (scale > 0.0_wp) mac = sum(x*y)**2/scale
   end function mac_of

   !> Shapes that those of stage S may be near: of the last run, or of the last stage of this one; or none.
   pure function shapes_near(s, structure, answer) result(u)
      integer, intent(in)              :: s
      type(structure_type), intent(in) :: structure
      type(answer_type), intent(in)    :: answer
      real(wp), allocatable :: u(:, :)
      integer :: i

      allocate (u(size(structure%model%freedoms%held), 0))
      do i = 1, s - 1
         if (allocated(answer%stages(i)%u)) u = answer%stages(i)%u
      end do
      if (.not. allocated(structure%known)) return
      if (allocated(structure%known(s)%u)) u = structure%known(s)%u
   end function shapes_near

   !> The modes of stage S of ANSWER that the rows OF_MODES mean, their MAC with the shape given or that of the start, and their
   !! frequencies.
   subroutine match_rows(data, s, of_modes, structure, answer, failure)
      type(measured_type), intent(in)    :: data
      integer, intent(in)                :: s
      logical, intent(in)                :: of_modes(:)
      type(structure_type), intent(in)   :: structure
      type(answer_type), intent(inout)   :: answer
      type(failure_type), intent(inout)  :: failure
      real(wp) :: macs(size(answer%stages(s)%lambda)), frequencies(size(answer%stages(s)%lambda))
      integer  :: d, i, k, m, p

      d = structure%model%mesh%dimension
      frequencies = sqrt(max(0.0_wp, answer%stages(s)%lambda))/two_pi
      do i = 1, size(of_modes)
         associate (row => data%rows(i), stage => answer%stages(s))
            if (.not. of_modes(i) .or. row%frequency > 0.0_wp) cycle
            m = structure%numbers(i) - stage%n_before
            if (m < 1 .or. m > size(macs)) m = 0
            answer%mac(i) = 1.0_wp
            if (size(row%shape) > 0 .or. allocated(structure%shapes)) then
               do k = 1, size(macs)
                  if (size(row%shape) == 0) macs(k) = mac_of(stage%u(:, k), structure%shapes(:, i))
                  if (size(row%shape) > 0) macs(k) = mac_of(row%shape, [(stage%u(d*(structure%model%mesh%node_table%find( &
                     row%at(1, p)) - 1) + row%at(2, p), k), p = 1, size(row%shape))])
               end do
               m = maxloc(macs, dim=1)
               answer%mac(i) = macs(m)
               if (size(row%shape) == 0 .and. macs(m) < least_mac) m = 0
            end if
            if (m == 0) call failure%raise('mode '//integer_text(row%mode)//' is not among those found')
            if (failure%raised) return
            answer%mode(i) = m
            answer%value(i) = frequencies(m)
            if (size(answer%shapes, 1) > 0) answer%shapes(:, i) = stage%u(:, m)
            answer%off_number(i) = 0.0_wp
            k = row%mode - stage%n_before
            if (row%kind == a_frequency .and. size(row%shape) == 0 .and. row%amplitude <= 0.0_wp .and. k > 0 .and. &
                k <= size(macs) .and. k /= m) answer%off_number(i) = frequencies(k) - frequencies(m)
         end associate
      end do
   end subroutine match_rows

   !> Match all rows of modes with those of ANSWER anew; OK: all that they want of the modes are frequencies, and these are there.
   subroutine match_again(data, structure, answer, ok)
      type(measured_type), intent(in)  :: data
      type(structure_type), intent(in) :: structure
      type(answer_type), intent(inout) :: answer
      logical, intent(out)             :: ok
      type(failure_type) :: failure
      integer :: s

      ok = .true.
      do s = 1, size(structure%plan%stages)
         associate (of_modes => is_of_modes(data%rows) .and. data%rows%stage == structure%plan%stages(s)%id)
            ok = ok .and. is_predicted(data, s, structure%plan)
            if (ok .and. any(of_modes)) call match_rows(data, s, of_modes, structure, answer, failure)
         end associate
      end do
      ok = ok .and. .not. failure%raised
   end subroutine match_again

   !> Exchange the NUMBERS of a mode with rows and of one beside it that ANSWER has close to it; IS_TRIED (rows, below and above).
   !! OFF is the usual difference of a row over its deviation, 1 or more: so many times further may close modes be from each other.
   subroutine exchange_modes(data, structure, answer, off, numbers, is_tried)
      type(measured_type), intent(in)  :: data
      type(structure_type), intent(in) :: structure
      type(answer_type), intent(in)    :: answer
      real(wp), intent(in)             :: off
      integer, intent(inout)           :: numbers(:)
      logical, intent(inout)           :: is_tried(:, :)
      integer :: at, k, other, s, side

      associate (rows => data%rows, stages => structure%plan%stages%id)
         do k = 1, size(rows)
            if (rows(k)%kind /= a_frequency .or. rows(k)%amplitude > 0.0_wp .or. size(rows(k)%shape) > 0) cycle
            s = findloc(stages, rows(k)%stage, dim=1)
            do side = 1, 2
               at = answer%mode(k) + 2*side - 3
               other = rows(k)%mode + 2*side - 3
               if (is_tried(k, side) .or. min(at, other) < 1 .or. at > size(answer%stages(s)%lambda)) cycle
               associate (omega => sqrt(max(0.0_wp, answer%stages(s)%lambda([at, answer%mode(k)]))))
                  if (abs(omega(1) - omega(2)) > two_pi*close_modes*off*rows(k)%deviation) cycle
               end associate
               where (rows%stage == rows(k)%stage .and. rows%mode == other)
                  numbers = rows(k)%mode
                  is_tried(:, 3 - side) = .true.
               elsewhere (rows%stage == rows(k)%stage .and. rows%mode == rows(k)%mode)
                  numbers = other
                  is_tried(:, side) = .true.
               end where
               return
            end do
         end do
      end associate
   end subroutine exchange_modes

end module mode_rows
