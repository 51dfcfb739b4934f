!> Warnings about element type, shear laws, unbalanced stages, divided increments and poor condition. Bodies of linear
!! tetrahedra are too stiff. A shear law is warned of once if its loops do not close or it unloads less steeply than it loads.
!! Its use outside the tested range is warned of in one line for each bound, joint and stage, with the number of interface
!! elements and the worst of them. Normal unloading softer than loading is warned of once for each joint.
module range_watch
   use analysis_state, only: analysis_type, free_norm
   use branch_cubic, only: cubic_slope
   use control_words, only: method_back, method_newton
   use distance_watch, only: distance_words, farthest_type, record_farthest, watch_distances, watch_path
   use element_kinds, only: kind_tetra4
   use joint_laws, only: friction_excess, friction_limit
   use joint_values, only: joint_values_type
   use kinds, only: wp
   use model_data, only: joint_node_id, model_type
   use normal_curve, only: loading_deflection, normal_tangent
   use normal_stiffness, only: branch_load, branch_open, branch_unload
   use output_file, only: output_file_type
   use page_lines, only: axes, page_width
   use range_tally, only: record_tallies, tally_type
   use restart_stream, only: restart_stream_type
   use result_page, only: page_type
   use shear_loops, only: loop_closure, wide_gap, worst_closure
   use shear_stiffness, only: curve_deflection, shear_law, shear_slope
   use text_tools, only: append, integer_text, one_of, plural, real_text, text_item, upper
   use tolerances, only: equal_slopes, symmetric_tie
   use unknowns, only: unknown_name
   implicit none
   private

   public :: start_watch, watch_drops, watch_increment, watch_stage, print_warnings, record_watch, tetra_words, warn

   character(*), parameter :: hanging = 'a joint is open at all nodes, and nothing holds a body in some direction: its '// &
      'displacement there is arbitrary'
   real(wp), parameter :: much = 0.01_wp ! of the largest load, or of the friction limits: a smaller remainder gives no warning
   real(wp), parameter :: far_beyond = 0.1_wp ! of the load, or of the limits: a larger remainder is said on the screen too

   integer, parameter :: beyond_p = 1, beyond_d = 2, no_slope = 3 ! bounds of a shear law

   type, public :: range_watch_type
      integer :: n_warnings = 0               !! total
      type(text_item), allocatable :: lines(:) !! the warnings of the stage so far
      type(farthest_type) :: farthest
      character(:), allocatable :: poor_condition !! last warning of the condition for the screen, '': none
      character(:), allocatable :: divided    !! message about the last divided increment, '': none
      character(:), allocatable :: overloaded !! message about the last stage whose load the joints do not bear, '': none
      logical :: tells_drops = .false.        !! said that shear stresses without friction have dropped to zero
      integer, allocatable, private :: stage(:, :)   ! (bounds, n) stage in which an element was last found beyond a bound
      type(tally_type), allocatable, private :: tallies(:, :) ! (bounds, joints)
      logical, allocatable, private :: soft_line(:)  ! whether the E_u of a joint was warned of
      integer, allocatable, private :: first_of(:, :)  ! (2, joints) first direction of the model with the same law, 0: none
      logical, allocatable, private :: soft_unloading(:) ! whether that direction, by its number, was warned of soft unloading
   end type range_watch_type

contains

   !> Start without warnings, except that of bodies that are too stiff.
   subroutine start_watch(model, watch)
      type(model_type), intent(in)        :: model
      type(range_watch_type), intent(out) :: watch

      allocate (watch%stage(no_slope, size(model%joints%element)), source=0)
      allocate (watch%tallies(no_slope, size(model%joints%list)))
      allocate (watch%soft_line(size(model%joints%list)), watch%soft_unloading(2*size(model%joints%list)), source=.false.)
      allocate (watch%first_of(2, size(model%joints%list)), source=-1)
      if (tetra_words(model) /= '') watch%n_warnings = 1
      if (allocated(model%warnings)) watch%n_warnings = watch%n_warnings + size(model%warnings)
      allocate (watch%lines(0))
      watch%poor_condition = ''
      watch%divided = ''
      watch%overloaded = ''
   end subroutine start_watch

   !> Warn of the increment just completed: of the condition of the stiffness, the poorest so far, of which only powers of ten are
   !! given, because the digits are rounding; and of a divided increment where its answer depends on the parts.
   subroutine watch_increment(page, model, analysis, joints, method, watch)
      type(page_type), intent(in)           :: page
      type(model_type), intent(in)          :: model
      type(analysis_type), intent(in)       :: analysis
      type(joint_values_type), intent(in)   :: joints(:)
      integer, intent(in)                   :: method !! of case control
      type(range_watch_type), intent(inout) :: watch
      character(:), allocatable :: first, second
      integer :: power

      first = '' ! without this gfortran 12 warns of its length
      second = ''
      associate (record => analysis%record)
         if (record%condition%is_new) then
            power = nint(log10(record%condition%number))
            first = page%place//': condition of the stiffness about 1E'//integer_text(power)//', about '// &
                    integer_text(max(0, 16 - power))//' of 16 digits remain'
            second = 'softest at '//unknown_name(model, record%condition%node, record%condition%direction)
            call warn(watch, '  WARNING: '//upper(first)//': ', upper(second))
            watch%poor_condition = first//': '//second
         end if
         if (record%n_parts > 1 .and. .not. (record%is_partial .or. record%follows_path .and. record%is_whole)) then
            first = page%place//': divided into '//integer_text(record%n_parts)//' parts'
            second = 'then repeated as a whole from the state that they reached'
            if (.not. record%is_whole) &
               second = 'it did not converge as a whole, and the answer depends on the parts: more increments show by how much'
            call warn(watch, merge('  NOTE:    ', '  WARNING: ', record%is_whole)//upper(first)//', ', upper(second))
            watch%divided = first//', '//second
         end if
      end associate
      if (method == method_newton) then
         call watch_path(page%place, analysis%record, watch%farthest, first)
         if (first /= '') call warn(watch, '  WARNING: '//upper(first))
      else
         call watch_distances(page%place, model, joints, watch%farthest)
      end if
      call watch_ranges(model, analysis, watch)
      if (method == method_back) return
      if (any(watch%first_of < 0)) call watch_closures(model, watch)
      call watch_unloading(page%place, model, analysis, watch)
   end subroutine watch_increment

   !> Warn once of an element with shear stiffness and without friction that is open, and was pressed or has no gap. WORDS are for the
   !! screen, '' where there is nothing new to say.
   subroutine watch_drops(model, analysis, watch, words)
      type(model_type), intent(in)           :: model
      type(analysis_type), intent(in)        :: analysis !! a state that NEWTON has iterated
      type(range_watch_type), intent(inout)  :: watch
      character(:), allocatable, intent(out) :: words
      integer :: i

      words = ''
      do i = 1, merge(0, size(model%joints%element), watch%tells_drops)
         associate (law => model%joints%list(model%joints%element(i)%joint)%law, state => analysis%states(i)%normal)
            if (state%branch /= branch_open .or. law%has_friction .or. .not. any(law%shear%given)) cycle
            if (state%gap > 0.0_wp .and. .not. state%p_a > 0.0_wp) cycle
         end associate
         watch%tells_drops = .true.
         words = 'JOINT '//integer_text(model%joints%list(model%joints%element(i)%joint)%id)//', node '// &
                 integer_text(joint_node_id(model, i, 1))//': an element with shear stiffness and without MU on '// &
                 'PJOINT has opened; it drops its shear at once, and the equilibrium may be one of several that rounding chooses'
         call warn(watch, '  WARNING: '//upper(words))
         return
      end do
   end subroutine watch_drops

   !> Warn of the stage just completed: a line for each joint and bound of its shear law that elements have exceeded; the unbalanced
   !! force, and the remaining excess over the friction limits.
   subroutine watch_stage(page, model, analysis, watch)
      type(page_type), intent(in)           :: page
      type(model_type), intent(in)          :: model
      type(analysis_type), intent(in)       :: analysis
      type(range_watch_type), intent(inout) :: watch
      character(:), allocatable :: head
      character(60) :: words
      real(wp) :: excess, limit, unbalanced
      integer  :: i, j, which

      do j = 1, size(model%joints%list)
         do which = beyond_p, no_slope
            associate (tally => watch%tallies(which, j))
               if (tally%n == 0) cycle
               select case (which)
               case (beyond_p)
                  words = 'BEYOND P = '//real_text(tally%bound)
               case (beyond_d)
                  words = 'BEYOND D = '//real_text(tally%bound)
               case default
                  words = 'WITHOUT A POSITIVE SLOPE'
               end select
               call warn(watch, '  WARNING: JOINT '//integer_text(model%joints%list(j)%id)//', '//page%stage//': '// &
                  upper(plural(tally%n, 'element'))//' '//trim(words)//' OF THE SHEAR LAW, FIRST NODE '// &
                  integer_text(tally%node)//' (INCREMENT '//integer_text(tally%increment)//'),', &
                  ' WORST '//integer_text(tally%worst_node)//': P = '//real_text(tally%p)//', D = '//real_text(tally%d))
            end associate
         end do
      end do
      watch%tallies = tally_type()

      head = upper(distance_words(watch%farthest)) ! from the laws; the path was warned of already
      if (index(head, 'STEP IS') == 1 .and. index(head, ' IN '//page%stage//',') > 0) call warn(watch, '  WARNING: '//head)

      ! what remains unbalanced, or above a limit
      head = '  WARNING: '//upper(page%place)//': '
      unbalanced = free_norm(analysis%unbalanced, analysis%held)
      if (size(model%joints%element) == 0) unbalanced = 0.0_wp ! no element to remove: rounding
      if (unbalanced > much*page%largest_force) call warn(watch, head//real_text(unbalanced)// &
         ' OF FORCE REMAIN UNBALANCED BY REMOVED ELEMENTS: SEE CARRY = YES, METHOD = NEWTON')
      if (unbalanced > far_beyond*page%largest_force) watch%overloaded = page%place//': '//real_text(unbalanced)// &
         ' of force remain unbalanced by removed elements; METHOD = NEWTON tells whether there is equilibrium'
      if (analysis%record%hangs) then
         call warn(watch, head//upper(hanging))
         watch%overloaded = page%place//': '//hanging
      end if
      if (.not. analysis%record%is_settled) call warn(watch, head//'THE SECANTS HAVE NOT CONVERGED IN '// &
         integer_text(analysis%record%n_iterations)//' ITERATIONS; THE RESULTS ARE THOSE OF THE LAST: SEE AVERAGE = YES')
      excess = 0.0_wp
      limit = 0.0_wp
      do i = 1, size(model%joints%element)
         associate (law => model%joints%list(model%joints%element(i)%joint)%law, area => model%joints%element(i)%area)
            excess = excess + norm2(friction_excess(law, area, analysis%states(i)))
            limit = limit + friction_limit(law, analysis%states(i)%normal%pressure)*area
         end associate
      end do
      if (excess > much*limit .and. excess > 0.0_wp) &
         call warn(watch, head//'FRICTION LIMITS ARE STILL EXCEEDED BY '//real_text(excess)//' IN ALL: SEE NREAN')
      if (excess > far_beyond*limit .and. excess > much*page%largest_force) watch%overloaded = &
         page%place//': friction limits are exceeded by '//real_text(excess)// &
         ' in all; METHOD = NEWTON tells whether there is equilibrium'
   end subroutine watch_stage

   !> The warning for a model whose bodies are of linear tetrahedra only; otherwise empty.
   pure function tetra_words(model) result(words)
      type(model_type), intent(in) :: model
      character(:), allocatable    :: words

      words = ''
      if (model%mesh%n_elements > 0 .and. all(model%mesh%element_kind == kind_tetra4)) words = &
         'all bodies are of linear tetrahedra, on '//'usual meshes 10 to 35 % too stiff in bending: mesh with second order'
   end function tetra_words

   !> Number the shear laws by the first direction of a joint with that law, and note those with a wide gap.
   subroutine watch_closures(model, watch)
      type(model_type), intent(in)          :: model
      type(range_watch_type), intent(inout) :: watch
      type(loop_closure) :: closure
      integer :: i, j, k

      watch%first_of = 0
      do j = 1, size(model%joints%list)
         do k = 1, model%mesh%dimension - 1
            associate (law => model%joints%list(j)%law%shear(k))
               if (.not. law%given) cycle
               do i = 1, 2*(j - 1) + k
                  if (is_same_law(law, model%joints%list((i + 1)/2)%law%shear(2 - modulo(i, 2)))) exit
               end do
               watch%first_of(k, j) = i
               if (i < 2*(j - 1) + k) cycle
               closure = worst_closure(law, model%joints%list(j)%p_av)
               if (.not. closure%is_known .or. closure%share <= wide_gap) cycle
               call warn(watch, '  WARNING: SHEAR LAW OF JOINT '//integer_text(model%joints%list(j)%id)//', '//axes(k)// &
                  ': RELOADING MISSES POINT A BY MORE THAN 5 PER CENT OF TAU_R, CYCLES CREEP: SEE ITS CLOSURE ABOVE')
            end associate
         end do
      end do
   end subroutine watch_closures

   !> Whether all numbers of two laws are the same.
   pure logical function is_same_law(a, b)
      type(shear_law), intent(in) :: a, b

      is_same_law = b%given .and. abs(a%p_max - b%p_max) <= 0.0_wp .and. abs(a%d_max - b%d_max) <= 0.0_wp &
                    .and. (a%from_branch .eqv. b%from_branch) &
                    .and. all(abs(a%load%coefficients - b%load%coefficients) <= 0.0_wp) &
                    .and. all(abs(a%unload%coefficients - b%unload%coefficients) <= 0.0_wp) &
                    .and. all(abs(a%reload%coefficients - b%reload%coefficients) <= 0.0_wp)
   end function is_same_law

   !> Count the elements outside the range of their shear law after the completed increment.
   subroutine watch_ranges(model, analysis, watch)
      type(model_type), intent(in)          :: model
      type(analysis_type), intent(in)       :: analysis
      type(range_watch_type), intent(inout) :: watch
      real(wp) :: p, d, values(no_slope), bounds(no_slope)
      logical  :: is_beyond(no_slope)
      integer  :: i, k, which

      do i = 1, size(model%joints%element)
         if (analysis%states(i)%normal%branch == branch_open) cycle
         do k = 1, model%mesh%dimension - 1
            associate (law => model%joints%list(model%joints%element(i)%joint)%law%shear(k), shear => analysis%states(i)%shear(k))
               if (.not. law%given) cycle
               p = analysis%states(i)%normal%pressure
               d = abs(curve_deflection(shear))
               values = [p, d, d]
               bounds = [law%p_max, law%d_max, 0.0_wp]
               is_beyond = [p > law%p_max, d > law%d_max, shear_slope(law, shear, max(0.0_wp, p)) <= 0.0_wp]
            end associate
            do which = beyond_p, no_slope
               if (.not. is_beyond(which)) cycle
               associate (tally => watch%tallies(which, model%joints%element(i)%joint))
                  if (tally%n == 0) then
                     tally%node = joint_node_id(model, i, 1)
                     tally%increment = analysis%increment
                     tally%bound = bounds(which)
                  end if
                  if (watch%stage(which, i) /= analysis%stage) tally%n = tally%n + 1
                  watch%stage(which, i) = analysis%stage
                  if (tally%worst_node > 0 .and. values(which) <= (1.0_wp + symmetric_tie)*tally%excess) cycle
                  tally%excess = values(which)
                  tally%worst_node = joint_node_id(model, i, 1)
                  tally%p = p
                  tally%d = d
               end associate
            end do
         end do
      end do
   end subroutine watch_ranges

   !> Keep the line of a warning, or of a NOTE, which is not counted. If both parts are too long for one line, SECOND has a line
   !! of its own; without it so has what is behind a semicolon.
   pure subroutine warn(watch, first, second)
      type(range_watch_type), intent(inout) :: watch
      character(*), intent(in)              :: first
      character(*), intent(in), optional    :: second
      integer :: i

      if (index(first, '  NOTE:') /= 1) watch%n_warnings = watch%n_warnings + 1
      i = index(first(:min(page_width, len(first))), '; ', back=.true.) + 1
      if (.not. present(second) .and. len(first) > page_width .and. i > 1) then
         call append(watch%lines, first(:i))
         call append(watch%lines, '          '//first(i + 1:))
      else if (.not. present(second)) then
         call append(watch%lines, first)
      else if (len(first) + len(second) <= page_width) then
         call append(watch%lines, first//second)
      else
         call append(watch%lines, first)
         call append(watch%lines, '          '//second)
      end if
   end subroutine warn

   !> Print the warnings of the stage, and forget them.
   subroutine print_warnings(watch, file)
      type(range_watch_type), intent(inout) :: watch
      type(output_file_type), intent(inout) :: file
      integer :: i

      if (size(watch%lines) > 0) call file%put('')
      do i = 1, size(watch%lines)
         call file%put(watch%lines(i)%words(:min(page_width, len(watch%lines(i)%words))))
      end do
      deallocate (watch%lines)
      allocate (watch%lines(0))
   end subroutine print_warnings

   !> Warn of shear laws of which an element has begun to unload less steeply than it was loaded: there a branch leaves its loading
   !! curve on the wrong side. Warn of joints of which an element has reached a point where the loading curve is steeper than its
   !! line of unloading, of slope E_u.
   subroutine watch_unloading(place, model, analysis, watch)
      character(*), intent(in)              :: place !! stage and increment
      type(model_type), intent(in)          :: model
      type(analysis_type), intent(in)       :: analysis
      type(range_watch_type), intent(inout) :: watch
      real(wp) :: slope
      integer  :: i, k, law

      do i = 1, size(model%joints%element)
         do k = 1, model%mesh%dimension - 1
            law = watch%first_of(k, model%joints%element(i)%joint)
            if (law == 0) cycle
            if (watch%soft_unloading(law)) cycle
            associate (curves => model%joints%list(model%joints%element(i)%joint)%law%shear(k), &
               state => analysis%states(i)%shear(k), p => max(0.0_wp, analysis%states(i)%normal%pressure))
               if (state%branch /= branch_unload .or. cubic_slope(curves%unload, merge(0.0_wp, state%d_r, curves%from_branch), p) &
                   >= (1.0_wp - equal_slopes)*cubic_slope(curves%load, state%d_r, p)) cycle
               watch%soft_unloading(law) = .true.
               call warn(watch, '  WARNING: NODE '//integer_text(joint_node_id(model, i, 1))//', '// &
                  upper(place)//': SHEAR LAW OF JOINT '// &
                  integer_text(model%joints%list(model%joints%element(i)%joint)%id)//', '//axes(k)// &
                  ': UNLOADING IS LESS STEEP THAN LOADING AT P = '//real_text(p)//', D = '//real_text(state%d_r))
            end associate
         end do
      end do
      do i = 1, size(model%joints%element)
         associate (j => model%joints%element(i)%joint, state => analysis%states(i)%normal)
            if (watch%soft_line(j) .or. state%branch /= branch_load) cycle
            associate (law => model%joints%list(j)%law%normal, p => state%pressure)
               slope = normal_tangent(law, 1.0_wp, p, state%p_av)
               if (law%e_u >= slope*(1.0_wp - equal_slopes)) cycle
               watch%soft_line(j) = .true.
               call warn(watch, '  WARNING: NODE '//integer_text(joint_node_id(model, i, 1))//', '// &
                  upper(place)//': E_U = '//real_text(law%e_u)//' OF JOINT '// &
                  integer_text(model%joints%list(j)%id)//' IS BELOW THE LOADING SLOPE '//real_text(slope)//' AT P = '// &
                     real_text(p)//one_of(p/law%e_u > loading_deflection(law, max(p, 0.0_wp)), ': NEGATIVE SET', ''))
            end associate
         end associate
      end do
   end subroutine watch_unloading

   !> Write the state of the warnings to a restart file, or read it.
   subroutine record_watch(stream, watch)
      type(restart_stream_type), intent(inout) :: stream
      type(range_watch_type), intent(inout)    :: watch
      integer :: i, n

      call stream%part('range_watch_type', 3)
      call stream%item('n_warnings', watch%n_warnings)
      call stream%text('poor_condition', watch%poor_condition)
      call stream%text('divided', watch%divided)
      call stream%text('overloaded', watch%overloaded)
      call stream%item('tells_drops', watch%tells_drops)
      call stream%item('stage', watch%stage)
      call stream%item('soft_line', watch%soft_line)
      call stream%item('first_of', watch%first_of)
      call stream%item('soft_unloading', watch%soft_unloading)
      n = size(watch%lines)
      call stream%extent('lines', n, 10)
      if (.not. stream%writes) deallocate (watch%lines)
      if (.not. stream%writes) allocate (watch%lines(n))
      do i = 1, n
         call stream%text('lines', watch%lines(i)%words)
      end do
      do i = 1, size(watch%tallies, 2)
         call record_tallies(stream, watch%tallies(:, i))
      end do
      call record_farthest(stream, watch%farthest)
   end subroutine record_watch

end module range_watch
