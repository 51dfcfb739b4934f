!> Names the components of the state of an analysis in a restart file: one routine for each type.
!! A component of all interface elements is one item. A change of what a routine names counts the version of its part up.
module analysis_record
   use analysis_state, only: analysis_type, increment_record, iteration_record, load_state, path_error_type, slip_record, &
                             turning_point
   use condition_estimate, only: condition_type
   use joint_laws, only: element_state
   use joint_work, only: joint_energy
   use kinds, only: wp
   use model_data, only: temperature_type
   use normal_stiffness, only: normal_state
   use restart_stream, only: restart_stream_type
   use shear_stiffness, only: shear_state
   implicit none
   private

   public :: record_analysis, record_elements, record_turns, record_energy, record_condition, record_iterations, record_slips

contains

   !> Write A, or read it into one that start_analysis has made for the same model. goes_on is left out, which is true only
   !! while the run resumes.
   subroutine record_analysis(stream, a)
      type(restart_stream_type), intent(inout) :: stream
      type(analysis_type), intent(inout)       :: a
      integer :: n, i

      call stream%part('analysis_type', 4)
      call stream%item('stage', a%stage)
      call stream%item('next', a%next)
      call stream%item('increment', a%increment)
      call stream%item('increment_fraction', a%increment_fraction)
      call stream%item('fraction', a%fraction)
      n = 0
      if (stream%writes) n = size(a%loaded)
      call stream%extent('loaded', n, 4)
      if (.not. stream%writes) a%loaded = spread(0, 1, n)
      call stream%item('loaded', a%loaded)
      call stream%item('is_moved', a%is_moved)
      call stream%item('moves', a%moves)
      call stream%item('carry', a%carry)
      call stream%item('eq10', a%eq10)
      call stream%item('average', a%average)
      call stream%item('load_tolerance', a%load_tolerance)
      call stream%item('path_tolerance', a%path_tolerance)
      call stream%item('tolerance', a%tolerance)
      call stream%item('is_loose', a%is_loose)
      call stream%item('loose_force', a%loose_force)
      call stream%item('all_u', a%all_u)
      call stream%item('all_unbalanced', a%all_unbalanced)
      call record_plane(stream, 'stands', a%stands)
      call stream%item('retained_index', a%retained_index)
      call stream%item('held', a%held)
      call stream%item('change', a%change)
      call stream%item('move', a%move)
      call stream%item('body', a%body)
      call stream%item('u', a%u)
      call stream%item('du', a%du)
      call stream%item('unbalanced', a%unbalanced)
      call stream%item('is_elastic', a%is_elastic)
      call stream%item('rest_tension', a%rest_tension)
      call stream%item('start_tension', a%start_tension)
      call stream%item('is_locked', a%is_locked)
      call stream%item('movement', a%movement)
      call stream%item('k', a%k)
      call stream%item('next_kind', a%next_kind)
      call stream%item('largest_p', a%largest_p)
      call stream%item('largest_lambda', a%largest_lambda)
      call stream%item('largest_load', a%largest_load)
      call record_plane(stream, 'kept', a%kept)
      call record_elements(stream, a%states)
      if (allocated(a%exact)) call record_elements(stream, a%exact)
      do i = 1, size(a%turns, 1)
         call record_turns(stream, a%turns(i, :))
      end do
      call record_energy(stream, a%energy)
      call record_loads(stream, a%before)
      call record_loads(stream, a%after)
      call record_loads(stream, a%now)
      call record_increment(stream, a%record)
   end subroutine record_analysis

   ! ---- interface elements and joints ----

   subroutine record_elements(stream, states)
      type(restart_stream_type), intent(inout) :: stream
      type(element_state), intent(inout)         :: states(:)
      integer :: i, owners ! of slices

      call stream%part('element_state', 2)
      call stream%item('slips', states%slips)
      call stream%item('turns', states%turns)
      call stream%item('origin 1', states%origin(1))
      call stream%item('origin 2', states%origin(2))
      call record_normal(stream, states%normal)
      call record_shear(stream, states%shear(1))
      call record_shear(stream, states%shear(2))
      owners = count([(allocated(states(i)%iwan), i = 1, size(states))])
      call stream%item('owners of slices', owners)
      if (owners > 0) call record_slices(stream, states)
   end subroutine record_elements

   !> The slices of the elements with Iwan's law: how many they are, and their values.
   subroutine record_slices(stream, states)
      type(restart_stream_type), intent(inout) :: stream
      type(element_state), intent(inout)       :: states(:)
      integer :: i, n

      call stream%part('iwan_state', 1)
      do i = 1, size(states)
         n = 0
         if (stream%writes .and. allocated(states(i)%iwan)) n = size(states(i)%iwan%tau, 2)
         call stream%extent('slices', n, 16)
         if (.not. stream%writes .and. allocated(states(i)%iwan)) deallocate (states(i)%iwan)
         if (n == 0) cycle
         if (.not. stream%writes) then
            allocate (states(i)%iwan)
            allocate (states(i)%iwan%tau(2, n))
         end if
         call stream%item('slides', states(i)%iwan%slides)
         call stream%item('delta', states(i)%iwan%delta)
         call stream%item('tau', states(i)%iwan%tau)
      end do
   end subroutine record_slices

   subroutine record_normal(stream, states)
      type(restart_stream_type), intent(inout) :: stream
      type(normal_state), intent(inout)          :: states(:)

      call stream%part('normal_state', 1)
      call stream%item('branch', states%branch)
      call stream%item('p_av', states%p_av)
      call stream%item('sigmaf', states%sigmaf)
      call stream%item('sumf', states%sumf)
      call stream%item('gap', states%gap)
      call stream%item('lambda', states%lambda)
      call stream%item('lambda_before', states%lambda_before)
      call stream%item('k_n', states%k_n)
      call stream%item('pressure', states%pressure)
      call stream%item('lambda_a', states%lambda_a)
      call stream%item('p_a', states%p_a)
      call stream%item('lambda_b', states%lambda_b)
   end subroutine record_normal

   subroutine record_shear(stream, states)
      type(restart_stream_type), intent(inout) :: stream
      type(shear_state), intent(inout)           :: states(:)

      call stream%part('shear_state', 2)
      call stream%item('branch', states%branch)
      call stream%item('sense', states%sense)
      call stream%item('delta', states%delta)
      call stream%item('delta_0', states%delta_0)
      call stream%item('slid', states%slid)
      call stream%item('delta_before', states%delta_before)
      call stream%item('delta_start', states%delta_start)
      call stream%item('tau', states%tau)
      call stream%item('tau_before', states%tau_before)
      call stream%item('d_r', states%d_r)
      call stream%item('tau_r', states%tau_r)
      call stream%item('offset', states%offset)
      call stream%item('side', states%side)
      call stream%item('k_s', states%k_s)
   end subroutine record_shear

   subroutine record_turns(stream, turns)
      type(restart_stream_type), intent(inout) :: stream
      type(turning_point), intent(inout)         :: turns(:)

      call stream%part('turning_point', 1)
      call stream%item('branch', turns%branch)
      call stream%item('delta', turns%delta)
      call stream%item('tau', turns%tau)
   end subroutine record_turns

   subroutine record_energy(stream, energy)
      type(restart_stream_type), intent(inout) :: stream
      type(joint_energy), intent(inout)          :: energy(:)

      call stream%part('joint_energy', 1)
      call stream%item('put_in 1', energy%put_in(1))
      call stream%item('put_in 2', energy%put_in(2))
      call stream%item('given_back 1', energy%given_back(1))
      call stream%item('given_back 2', energy%given_back(2))
      call stream%item('lost', energy%lost)
   end subroutine record_energy

   ! ---- loads ----

   subroutine record_loads(stream, at)
      type(restart_stream_type), intent(inout) :: stream
      type(load_state), intent(inout)            :: at

      call stream%part('load_state', 1)
      call stream%item('load', at%load)
      call stream%item('moved', at%moved)
      call stream%item('condensed_load', at%condensed_load)
      call record_temperature(stream, at%temperature)
   end subroutine record_loads

   subroutine record_temperature(stream, temperature)
      type(restart_stream_type), intent(inout) :: stream
      type(temperature_type), intent(inout)      :: temperature
      integer :: n

      call stream%part('temperature_type', 1)
      call stream%item('reference_share', temperature%reference_share)
      n = -1
      if (allocated(temperature%at)) n = size(temperature%at)
      call stream%extent('at', n, 8)
      if (.not. stream%writes .and. allocated(temperature%at)) deallocate (temperature%at)
      if (.not. stream%writes .and. n >= 0) allocate (temperature%at(n))
      if (n >= 0) call stream%item('at', temperature%at)
      call record_plane(stream, 'own', temperature%own)
   end subroutine record_temperature

   !> The component NAME, of any extents or not allocated.
   subroutine record_plane(stream, name, values)
      type(restart_stream_type), intent(inout) :: stream
      character(*), intent(in)                 :: name
      real(wp), allocatable, intent(inout)     :: values(:, :)
      integer :: rows, columns

      rows = -1
      columns = 0
      if (allocated(values)) rows = size(values, 1)
      if (allocated(values)) columns = size(values, 2)
      call stream%extent(name, rows, 8)
      call stream%extent(name, columns, 8*max(1, rows))
      if (.not. stream%writes .and. allocated(values)) deallocate (values)
      if (.not. stream%writes .and. rows >= 0) allocate (values(rows, columns))
      if (rows >= 0) call stream%item(name, values)
   end subroutine record_plane

   ! ---- the last increment ----

   !> Condensed is left out, which does not change in an increment and which the first increment prints.
   subroutine record_increment(stream, record)
      type(restart_stream_type), intent(inout) :: stream
      type(increment_record), intent(inout)      :: record
      integer :: n_slips

      call stream%part('increment_record', 2)
      call stream%item('kind', record%kind)
      call stream%item('n_removed', record%n_removed)
      call stream%item('n_parts', record%n_parts)
      call stream%item('is_iterated', record%is_iterated)
      call stream%item('is_whole', record%is_whole)
      call stream%item('follows_path', record%follows_path)
      call stream%item('ends_early', record%ends_early)
      call stream%item('is_partial', record%is_partial)
      call stream%item('is_settled', record%is_settled)
      call stream%item('hangs', record%hangs)
      call record_path_error(stream, record%path_error)
      call record_condition(stream, record%condition)
      call stream%extent('n_iterations', record%n_iterations, 32)
      if (record%n_iterations > size(record%iterations)) record%iterations = spread(iteration_record(), 1, record%n_iterations)
      call record_iterations(stream, record%iterations(:record%n_iterations))
      n_slips = size(record%slips)
      call stream%extent('slips', n_slips, 88)
      if (n_slips /= size(record%slips)) record%slips = spread(slip_record(), 1, n_slips)
      call record_slips(stream, record%slips)
   end subroutine record_increment

   subroutine record_path_error(stream, error)
      type(restart_stream_type), intent(inout) :: stream
      type(path_error_type), intent(inout)     :: error

      call stream%part('path_error_type', 3)
      call stream%item('deflection', error%deflection)
      call stream%item('pressure', error%pressure)
      call stream%item('contact', error%contact)
      call stream%item('lets_go', error%lets_go)
      call stream%item('slides', error%slides)
      call stream%item('displacement', error%displacement)
      call stream%item('unseen', error%unseen)
   end subroutine record_path_error

   subroutine record_condition(stream, condition)
      type(restart_stream_type), intent(inout) :: stream
      type(condition_type), intent(inout)        :: condition

      call stream%part('condition_type', 1)
      call stream%item('number', condition%number)
      call stream%item('node', condition%node)
      call stream%item('direction', condition%direction)
      call stream%item('weakest', condition%weakest)
      call stream%item('is_new', condition%is_new)
   end subroutine record_condition

   subroutine record_iterations(stream, iterations)
      type(restart_stream_type), intent(inout) :: stream
      type(iteration_record), intent(inout)      :: iterations(:)

      call stream%part('iteration_record', 1)
      call stream%item('before', iterations%before)
      call stream%item('after', iterations%after)
      call stream%item('step', iterations%step)
      call stream%item('changes', iterations%changes)
      call stream%item('part', iterations%part)
   end subroutine record_iterations

   subroutine record_slips(stream, slips)
      type(restart_stream_type), intent(inout) :: stream
      type(slip_record), intent(inout)           :: slips(:)

      call stream%part('slip_record', 1)
      call stream%item('reanalysis', slips%reanalysis)
      call stream%item('element', slips%element)
      call stream%item('delta 1 1', slips%delta(1, 1))
      call stream%item('delta 2 1', slips%delta(2, 1))
      call stream%item('delta 1 2', slips%delta(1, 2))
      call stream%item('delta 2 2', slips%delta(2, 2))
      call stream%item('tau 1 1', slips%tau(1, 1))
      call stream%item('tau 2 1', slips%tau(2, 1))
      call stream%item('tau 1 2', slips%tau(1, 2))
      call stream%item('tau 2 2', slips%tau(2, 2))
      call stream%item('limit 1', slips%limit(1))
      call stream%item('limit 2', slips%limit(2))
   end subroutine record_slips

end module analysis_record
