!> How far a run is from what it should follow: STEP from its laws, NEWTON from the path of many increments; and how much of the
!! movement of a stage a default E_u decides.
module distance_watch
   use analysis_state, only: analysis_type, increment_record
   use joint_values, only: joint_values_type
   use kinds, only: wp
   use model_data, only: joint_node_id, model_type
   use normal_curve, only: loading_pressure, normal_tangent
   use normal_stiffness, only: branch_load, branch_open
   use restart_stream, only: restart_stream_type
   use stage_plan, only: node_pair
   use text_tools, only: integer_text, one_of, real_text
   use tolerances, only: off_path
   use watched_nodes, only: find_watched, watch_answer, watch_state
   implicit none
   private

   public :: watch_distances, watch_path, distance_words, default_slope_words, record_farthest

   real(wp), parameter :: far = 0.02_wp      ! of the largest deflection or stress: beyond it the answer is not that of the laws
   real(wp), parameter :: decides = 0.01_wp  ! of the movement of a stage: by an E_u that nobody gave

   !> The largest distance from a law, or from the path, in a run.
   type, public :: farthest_type
      real(wp) :: relative = 0.0_wp           !! of the largest deflection or stress of the joint in the increment
      integer  :: node = 0                    !! its number; 0: of the path
      logical  :: follows_path = .false.      !! of an increment that NEWTON has divided along the path
      character(:), allocatable :: quantity, place !! in words
   end type farthest_type

contains

   !> Note where JOINTS are FARTHEST from their laws, at this PLACE or before.
   subroutine watch_distances(place, model, joints, farthest)
      character(*), intent(in)            :: place
      type(model_type), intent(in)        :: model
      type(joint_values_type), intent(in) :: joints(:)
      type(farthest_type), intent(inout)  :: farthest
      character(12), parameter :: quantities(2) = [character(12) :: 'deflection', 'shear stress']
      integer :: j, k

      do j = 1, size(joints)
         do k = 1, 2
            associate (distance => joints(j)%distances(k))
               if (.not. distance%is_there .or. distance%relative <= farthest%relative) cycle
               farthest%relative = distance%relative
               farthest%node = joint_node_id(model, distance%element, 1)
               farthest%quantity = trim(quantities(k))
               farthest%place = place
            end associate
         end do
      end do
   end subroutine watch_distances

   !> Note where the error of path of an increment, as its RECORD has it, is largest, at this PLACE or before. WORDS for a warning
   !! where it is above the limit and above what was warned of before; '' otherwise.
   subroutine watch_path(place, record, farthest, words)
      character(*), intent(in)               :: place
      type(increment_record), intent(in)     :: record
      type(farthest_type), intent(inout)     :: farthest
      character(:), allocatable, intent(out) :: words
      character(27), parameter :: quantities(4) = [character(27) :: 'of the largest lambda', 'of the largest pressure', &
                                                   'of the area in contact', 'of the largest displacement']
      real(wp) :: shares(4)
      integer  :: k

      words = ''
      associate (error => record%path_error)
         shares = [error%deflection, error%pressure, error%contact, merge(error%displacement, 0.0_wp, error%slides)]
      end associate
      k = maxloc(shares, dim=1)
      if (shares(k) <= farthest%relative) return
      farthest%relative = shares(k)
      farthest%quantity = trim(quantities(k))
      farthest%place = place
      farthest%follows_path = record%follows_path
      if (shares(k) <= off_path) return
      words = place//': error of path '//percent(shares(k))//' '//farthest%quantity
      if (k < size(shares)) then
         words = words//': see the table of the errors of path'
      else
         words = words//': a joint slides, and more increments show how far'
      end if
   end subroutine watch_path

   !> The line on the screen after a run FARTHEST from its laws or from the path; '' where this is not far.
   pure function distance_words(farthest) result(words)
      type(farthest_type), intent(in) :: farthest
      character(:), allocatable :: words

      words = ''
      if (farthest%node > 0) then
         if (farthest%relative > far) words = 'STEP is up to '//percent(farthest%relative)//' of the largest '// &
            farthest%quantity//' away from its law, at node '//integer_text(farthest%node)//' in '//farthest%place// &
            '; METHOD = NEWTON follows the laws'
      else if (farthest%relative > off_path) then
         words = 'NEWTON is up to '//percent(farthest%relative)//' '//farthest%quantity// &
                 ' away from the path of many increments, in '//farthest%place//'; '// &
                 one_of(farthest%follows_path, 'more increments, by INCR, show how far', 'without INCR it follows the path')
      end if
   end function distance_words

   !> What the default E_u decides of the stage since BEFORE: the share of the movements on its lines in the work of watched_nodes,
   !! and how much more the work is at most with the slope of loading at A (the same forces: an upper bound); '' where little.
   function default_slope_words(model, analysis, before) result(words)
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      type(watch_state), intent(in)   :: before
      character(:), allocatable :: words
      type(watch_answer) :: answer
      real(wp) :: shares(2, size(model%joints%list)), dp, lambda, moved, p
      integer  :: i

      words = ''
      shares = 0.0_wp
      do i = 1, size(model%joints%element)
         associate (element => model%joints%element(i), state => analysis%states(i)%normal, &
                    joint => model%joints%list(model%joints%element(i)%joint))
            if (joint%e_u_given .or. state%branch == branch_load .or. .not. state%p_a > 0.0_wp) cycle
            lambda = before%movement(3, i) - element%gap ! from where, and from which pressure, it moved on the line
            p = before%force(3, i)/element%area
            if (lambda >= state%lambda_a .or. abs(p - loading_pressure(joint%law%normal, max(0.0_wp, lambda))) < &
                abs(p - max(0.0_wp, state%p_a - joint%law%normal%e_u*(state%lambda_a - lambda)))) then
               lambda = state%lambda_a ! it came along the loading curve to A
               p = state%p_a
            end if
            dp = abs(state%pressure - p)
            moved = abs(merge(state%lambda_b, state%lambda, state%branch == branch_open) - &
                        max(lambda, state%lambda_a - state%p_a/joint%law%normal%e_u))
            shares(:, element%joint) = shares(:, element%joint) + 0.5_wp*element%area*dp* &
               [moved, max(0.0_wp, dp/normal_tangent(joint%law%normal, 1.0_wp, state%p_a, state%p_av) - moved)]
         end associate
      end do
      if (.not. any(shares > 0.0_wp)) return
      call find_watched(model, analysis, [integer ::], [node_pair ::], before, answer)
      if (.not. answer%work > 0.0_wp .or. sum(shares) < decides*answer%work) return
      words = 'ELEMENTS UNLOADED ON THE DEFAULT E_U, MOST IN JOINT '//integer_text(model%joints%list(maxloc(sum(shares, dim=1), &
         dim=1))%id)//': '//percent(sum(shares(1, :))/answer%work)//' OF THE MOVEMENT; UP TO '// &
         percent(sum(shares(2, :))/answer%work)//' MORE WITH THE SLOPE OF LOADING: GIVE EU ON JNORM'
   end function default_slope_words

   !> SHARE in per cent, with one decimal.
   pure function percent(share) result(words)
      real(wp), intent(in)      :: share
      character(:), allocatable :: words

      words = real_text(0.1_wp*anint(1000.0_wp*share))//' %'
   end function percent

   !> Write the FARTHEST distance to a restart file, or read it.
   subroutine record_farthest(stream, farthest)
      type(restart_stream_type), intent(inout) :: stream
      type(farthest_type), intent(inout)       :: farthest

      call stream%part('farthest_type', 2)
      call stream%item('relative', farthest%relative)
      call stream%item('node', farthest%node)
      call stream%item('follows_path', farthest%follows_path)
      call stream%text('quantity', farthest%quantity)
      call stream%text('place', farthest%place)
   end subroutine record_farthest

end module distance_watch
