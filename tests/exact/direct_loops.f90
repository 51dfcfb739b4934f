!> Loops of a rigid body on interface elements, integrated directly: the laws of the elements and the equilibrium of the body are
!! written out here and share nothing with the program. The body has u, v, rotation at a point of height H above the joint; mass M,
!! inertia I; springs to the ground along u and v. Every element has lambda = c p**m with unloading of slope E_u, shear of slope
!! a11 + a12 p, and Coulomb friction. SEED decides on the model.
!!
!!    direct_loops deck SEED                        the deck on standard output
!!    direct_loops judge SEED BACKBONE LOOP         the rows of NAME.backbone.csv against loops under the loads of NAME.loop.csv: a line
!!                                                  for each fault, 'skipped ...' where no loop is to be compared, 'checked N'
program direct_loops
   use, intrinsic :: iso_fortran_env, only: wp => real64, int64
   implicit none

   integer, parameter :: most = 6, stroke = 4000     ! elements; increments between two turning points
   integer  :: n, mode
   integer(int64) :: random
   real(wp) :: x(most), area(most), c, m, e_u, mu, a11, a12, height, mass, inertia, springs(3), force(3), amplitude

   type :: state_type
      real(wp) :: u(3) = 0.0_wp
      real(wp) :: lambda_a(most) = 0.0_wp, p(most) = 0.0_wp, set(most) = 0.0_wp
      real(wp) :: delta(most) = 0.0_wp, tau(most) = 0.0_wp
      logical  :: slips(most) = .false., opened(most) = .false.
   end type state_type

   character(200) :: word
   integer :: seed

   call get_command_argument(2, word)
   read (word, *) seed
   call make_model(seed)
   call get_command_argument(1, word)
   if (word == 'deck') call write_deck()
   if (word == 'judge') call judge()

contains

   !> The next random number between A and B.
   real(wp) function between(a, b)
      real(wp), intent(in) :: a, b

      random = modulo(random*16807_int64, 2147483647_int64)
      between = a + (b - a)*real(random, wp)/2147483647.0_wp
   end function between

   !> The model of SEED: one element or several, rocking, sliding or bouncing, up to amplitudes beyond the first slip or opening.
   subroutine make_model(seed)
      integer, intent(in) :: seed
      real(wp) :: p_0, tangent, total, width, k(3, 3), omega(3), shapes(3, 3), first, share
      integer  :: i

      random = 1000_int64 + 7919_int64*seed
      do i = 1, 5
         width = between(0.0_wp, 1.0_wp)
      end do
      n = 1
      if (modulo(seed, 3) > 0) n = 3 + int(between(0.0_wp, 3.999_wp))
      width = between(40.0_wp, 120.0_wp)
      height = merge(0.0_wp, between(0.1_wp, 1.0_wp)*width, n == 1)
      x = 0.0_wp
      area = between(50.0_wp, 300.0_wp)
      do i = 1, merge(n, 0, n > 1)
         x(i) = width*((i - 1)/(n - 1.0_wp) - 0.5_wp)
         area(i) = area(1)*between(0.6_wp, 1.4_wp)
      end do
      total = sum(area(:n))
      p_0 = between(0.5_wp, 3.0_wp)
      m = between(0.4_wp, 1.0_wp)
      c = 10.0_wp**between(-3.0_wp, -2.0_wp)
      tangent = p_0**(1.0_wp - m)/(m*c)
      e_u = tangent*10.0_wp**between(0.15_wp, 2.0_wp)
      a11 = tangent*between(0.2_wp, 1.0_wp)
      a12 = merge(between(0.0_wp, 0.3_wp)*a11/p_0, 0.0_wp, modulo(seed, 2) == 0)
      mu = between(0.1_wp, 0.4_wp)
      mass = between(0.005_wp, 0.05_wp)
      inertia = mass*width**2*between(0.1_wp, 0.5_wp)
      springs = [between(0.3_wp, 1.0_wp)*a11*total, between(0.1_wp, 0.5_wp)*tangent*total, 0.0_wp]
      force = [merge(0.0_wp, between(-0.3_wp, 0.3_wp), modulo(seed, 4) == 0)*mu*p_0*total, -p_0*total, 0.0_wp]
      force(2) = force(2) - springs(2)*c*p_0**m
      k = stiffness(spread(p_0, 1, most))
      call find_modes(k, omega, shapes)
      mode = 1 + int(between(0.0_wp, merge(1.999_wp, 2.999_wp, n == 1)))
      ! the amplitude at which the first element slips or opens, by the linear mode
      first = huge(1.0_wp)
      do i = 1, n
         first = min(first, p_0/e_u/max(abs(shapes(2, mode) + x(i)*shapes(3, mode)), 1.0e-30_wp), &
                     mu*p_0/(a11 + a12*p_0)/max(abs(shapes(1, mode) + height*shapes(3, mode)), 1.0e-30_wp))
      end do
      share = between(0.3_wp, 3.0_wp)
      amplitude = share*first*norm2(shapes(:2, mode))
   end subroutine make_model

   !> [k] where all elements stick and unload, under the pressures P.
   function stiffness(p) result(k)
      real(wp), intent(in) :: p(most)
      real(wp) :: k(3, 3), b(3)
      integer  :: i

      k = 0.0_wp
      do i = 1, n
         b = [1.0_wp, 0.0_wp, height]
         k = k + area(i)*(a11 + a12*p(i))*spread(b, 2, 3)*spread(b, 1, 3)
         b = [0.0_wp, 1.0_wp, x(i)]
         k = k + area(i)*e_u*spread(b, 2, 3)*spread(b, 1, 3)
      end do
      do i = 1, 3
         k(i, i) = k(i, i) + springs(i)
      end do
      if (n == 1) k(3, 3) = 1.0e3_wp*maxval(k)*inertia/mass ! the body of one element does not rotate
   end function stiffness

   !> Modes of generalised mass 1 with ascending frequencies, by rotations of Jacobi.
   subroutine find_modes(k, omega, shapes)
      real(wp), intent(in)  :: k(3, 3)
      real(wp), intent(out) :: omega(3), shapes(3, 3)
      real(wp) :: a(3, 3), r(3, 3), root(3), angle
      integer  :: at, i, j, pass

      root = 1.0_wp/sqrt([mass, mass, inertia])
      a = k*spread(root, 2, 3)*spread(root, 1, 3)
      shapes = 0.0_wp
      do i = 1, 3
         shapes(i, i) = 1.0_wp
      end do
      do pass = 1, 50
         do i = 1, 2
            do j = i + 1, 3
               angle = 0.5_wp*atan2(2.0_wp*a(i, j), a(j, j) - a(i, i))
               r = 0.0_wp
               do at = 1, 3
                  r(at, at) = 1.0_wp
               end do
               r(i, i) = cos(angle); r(j, j) = cos(angle)
               r(i, j) = sin(angle); r(j, i) = -sin(angle)
               a = matmul(transpose(r), matmul(a, r))
               shapes = matmul(shapes, r)
            end do
         end do
      end do
      omega = [(a(i, i), i = 1, 3)]
      do i = 1, 2
         do j = i + 1, 3
            if (omega(j) >= omega(i)) cycle
            omega([i, j]) = omega([j, i])
            shapes(:, [i, j]) = shapes(:, [j, i])
         end do
      end do
      omega = sqrt(omega)
      shapes = shapes*spread(root, 2, 3)
   end subroutine find_modes

   subroutine write_deck()
      integer :: i

      print '(a)', 'METHOD = NEWTON', 'OUTPUT = NONE', 'SUBCASE 1', '  LOAD = 10', '  INCR = 3', '  MODES = 5', '  BACKBONE = 6', &
         'BEGIN BULK', 'JINCR,3,60,GEOM,1.0-4', 'EIGRL,5,,,3'
      print '(a, i0, a, es12.5, a)', 'JAMPL,6,', mode, ',', amplitude, ',3,0.3,40,2,100'
      print '(a)', '+,1.0-4'
      print '(a, f12.6)', 'GRID,100,,0.0,', height
      if (n > 1) then
         print '(a, i0, a, f12.6, a)', ('GRID,', i, ',,', x(i), ',0.0', i = 1, n)
         print '(a, *(",", i0))', 'RBE2,50,100,12', (i, i = 1, min(n, 5))
         if (n > 5) print '(a, i0)', '+,', 6
      end if
      print '(2(a, es23.16))', 'FORCE,10,100,,1.0,', force(1), ',', force(2)
      print '(a, es23.16)', 'CONM2,4,100,,', mass
      if (n > 1) print '(a, es23.16)', '+,,,,,,', inertia
      do i = 1, n
         print '(2(a, i0), a, es23.16, a)', 'CJOINT,', 10 + i, ',1,', merge(100, i, n == 1), ',,', area(i), ',0.0,-1.0'
      end do
      print '(a, es23.16, a)', 'CELAS2,81,', springs(1), ',100,1'
      print '(a, es23.16, a)', 'CELAS2,82,', springs(2), ',100,2'
      print '(a, es23.16)', 'PJOINT,1,1,2,,', mu
      print '(3(a, es23.16))', 'JNORM,1,', c, ',', m, ',', e_u
      print '(2(a, es23.16))', 'JSHEAR,2,', a11, ',', a12
      print '(a)', 'ENDDATA'
   end subroutine write_deck

   !> Follow the laws of the elements from BEFORE to the movement U of the body; the forces F of the elements on it, and the matrix K
   !! of their tangents.
   pure subroutine follow(before, u, after, f, k)
      type(state_type), intent(in)  :: before
      real(wp), intent(in)          :: u(3)
      type(state_type), intent(out) :: after
      real(wp), intent(out)         :: f(3), k(3, 3)
      real(wp) :: normal(3), along(3), lambda, slope, limit, k_s, p, moved
      integer  :: i

      after = before
      after%u = u
      after%slips = .false.
      after%opened = .false.
      f = -springs*u
      k = 0.0_wp
      do i = 1, 3
         k(i, i) = springs(i)
      end do
      if (n == 1) k(3, 3) = 1.0_wp
      do i = 1, n
         normal = [0.0_wp, -1.0_wp, -x(i)]
         along = [1.0_wp, 0.0_wp, height]
         lambda = dot_product(normal, u)
         if (lambda > before%lambda_a(i)) then
            p = (lambda/c)**(1.0_wp/m)
            slope = p**(1.0_wp - m)/(m*c)
            after%lambda_a(i) = lambda
            after%set(i) = lambda - p/e_u
         else
            p = max(0.0_wp, e_u*(lambda - before%set(i)))
            slope = merge(e_u, 0.0_wp, p > 0.0_wp)
         end if
         after%p(i) = p
         moved = dot_product(along, u) - before%delta(i)
         after%delta(i) = dot_product(along, u)
         if (p <= 0.0_wp) then
            after%opened(i) = .true.
            after%tau(i) = 0.0_wp
            cycle
         end if
         k_s = a11 + a12*0.5_wp*(p + before%p(i))
         after%tau(i) = before%tau(i) + k_s*moved
         limit = mu*p
         f = f - area(i)*p*normal
         k = k + area(i)*slope*spread(normal, 2, 3)*spread(normal, 1, 3)
         if (abs(after%tau(i)) > limit) then
            after%slips(i) = .true.
            after%tau(i) = sign(limit, after%tau(i))
            k = k + area(i)*sign(mu*slope, after%tau(i))*spread(along, 2, 3)*spread(normal, 1, 3)
         else
            k = k + area(i)*k_s*spread(along, 2, 3)*spread(along, 1, 3) &
                + area(i)*0.5_wp*a12*slope*moved*spread(along, 2, 3)*spread(normal, 1, 3)
         end if
         f = f - area(i)*after%tau(i)*along
      end do
   end subroutine follow

   !> The movement to equilibrium under the load F_0 from BEFORE, by Newton's method with halved steps; OK is false where there is none.
   subroutine balance(before, f_0, after, ok)
      type(state_type), intent(in)  :: before
      real(wp), intent(in)          :: f_0(3)
      type(state_type), intent(out) :: after
      logical, intent(out)          :: ok
      type(state_type) :: trial
      real(wp) :: f(3), f_there(3), k(3, 3), k_there(3, 3), step(3), unit(3), size
      integer  :: i, half

      size = norm2(f_0) + sum(area(:n)*before%p(:n))
      unit = [1.0_wp, 1.0_wp, 1.0_wp/max(height, maxval(abs(x(:n))), 1.0_wp)] ! moments as forces
      call follow(before, before%u, after, f, k)
      do i = 1, 200
         ok = norm2((f_0 + f)*unit) <= 1.0e-13_wp*size
         if (ok) return
         step = solved(k, f_0 + f)
         do half = 1, 30
            call follow(before, after%u + step, trial, f_there, k_there)
            if (norm2((f_0 + f_there)*unit) < norm2((f_0 + f)*unit) .or. half == 30) exit
            if (i > 5) step = 0.5_wp*step
            if (i <= 5) exit
         end do
         after = trial
         f = f_there
         k = k_there
      end do
      ok = norm2((f_0 + f)*unit) <= 1.0e-10_wp*size
   end subroutine balance

   !> k x = f, by Cramer's rule.
   pure function solved(k, f) result(x)
      real(wp), intent(in) :: k(3, 3), f(3)
      real(wp) :: x(3), with(3, 3)
      integer  :: i

      do i = 1, 3
         with = k
         with(:, i) = f
         x(i) = determinant(with)/determinant(k)
      end do
   end function solved

   pure real(wp) function determinant(a) result(d)
      real(wp), intent(in) :: a(3, 3)

      d = a(1, 1)*(a(2, 2)*a(3, 3) - a(2, 3)*a(3, 2)) - a(1, 2)*(a(2, 1)*a(3, 3) - a(2, 3)*a(3, 1)) &
          + a(1, 3)*(a(2, 1)*a(3, 2) - a(2, 2)*a(3, 1))
   end function determinant

   !> Go from the load FROM to TO in STEPS; D grows by what the laws absorb: the set under the pressure, the work of shear less what is
   !! given back.
   subroutine go(now, from, to, steps, d, ok)
      type(state_type), intent(inout) :: now
      real(wp), intent(in)    :: from(3), to(3)
      integer, intent(in)     :: steps
      real(wp), intent(inout) :: d
      logical, intent(out)    :: ok
      type(state_type) :: next
      integer :: i

      do i = 1, steps
         call balance(now, from + i*(to - from)/steps, next, ok)
         if (.not. ok) return
         d = d + sum(area(:n)*(0.5_wp*(now%p(:n) + next%p(:n))*(next%set(:n) - now%set(:n)) &
                               + 0.5_wp*(now%tau(:n) + next%tau(:n))*(next%delta(:n) - now%delta(:n)) &
                               - 0.5_wp*(next%tau(:n)**2/(a11 + a12*next%p(:n)) - now%tau(:n)**2/(a11 + a12*now%p(:n)))))
         now = next
      end do
   end subroutine go

   subroutine judge()
      real(wp), parameter :: same_f = 1.0e-4_wp, same_d = 0.01_wp, no_loss = 1.0e-5_wp
      integer, parameter  :: parts(6) = [60, 25, 11, 5, 2, 1]
      type(state_type) :: began, rest
      real(wp) :: alpha, d, f, found(8), k(3, 3), lost, omega(3), phi(3), point(6), q, shapes(3, 3)
      character(300) :: line
      integer :: backbone, checked, i, k_part, loop_file, row, sense
      logical :: agrees, near, ok

      checked = 0
      rest = state_type()
      d = 0.0_wp
      rest%u(2) = -1.0e-12_wp
      do i = 1, 60 ! the same increments as the deck, divided: near zero pressure into fewer parts where Newton's method needs them
         do k_part = 1, size(parts)
            began = rest
            call go(rest, geometric(i - 1)*force, geometric(i)*force, parts(k_part), d, ok)
            if (ok) exit
            rest = began
         end do
         if (.not. ok) exit
      end do
      if (.not. ok) then
         print '(a)', 'skipped: no rest'
         return
      end if
      if (any(rest%slips(:n))) then
         print '(a)', 'skipped: slip at rest'
         return
      end if
      k = stiffness(rest%p)
      call find_modes(k, omega, shapes)
      call get_command_argument(3, word)
      open (newunit=backbone, file=word, status='old', action='read')
      read (backbone, '(a)') line
      do row = 1, 3
         read (backbone, '(a)', iostat=i) line
         if (i /= 0) exit
         read (line, *) found
         if (abs(found(3)/(amplitude*0.3_wp**((3 - row)/2.0_wp)) - 1.0_wp) > 1.0e-4_wp) then
            print '(a, 2es13.5)', 'skipped: the limit ', found(3), amplitude*0.3_wp**((3 - row)/2.0_wp)
            cycle
         end if
         call get_command_argument(4, word)
         open (newunit=loop_file, file=word, status='old', action='read')
         read (loop_file, '(a)') line
         do
            read (loop_file, *) point
            if (abs(point(3)/found(3) - 1.0_wp) < 1.0e-9_wp) exit
         end do
         close (loop_file)
         alpha = abs(point(5))
         phi = shapes(:, mode)
         call choose_sense(rest, alpha, phi, near)
         do sense = 1, merge(2, 1, near) ! both senses where the structure is almost equally soft in both
            if (sense == 2) phi = -phi
            call find_amplitude(rest, found(3), phi, alpha, q, lost, ok)
            if (.not. ok) exit
            d = lost/(acos(-1.0_wp)*alpha*q)
            f = sqrt(alpha/q)/(2.0_wp*acos(-1.0_wp))
            agrees = abs(found(4)/f - 1.0_wp) <= same_f .and. abs(found(5) - d) <= same_d*d + no_loss
            if (agrees) exit
         end do
         if (.not. ok) then
            print '(a)', 'skipped: no equilibrium in the direct integration'
            cycle
         end if
         checked = checked + 1
         if (.not. agrees) print '(3(a, i0), 2(a, 2es14.6), a, es10.2, l2)', 'seed ', seed, ' mode ', mode, ' row ', row, &
            ': frequency ', found(4), f, '  loss ', found(5), d, '  E_u over tangent', e_u*m*c/sum(rest%p(:n)/n)**(1.0_wp - m), near
      end do
      print '(a, i0)', 'checked ', checked
   end subroutine judge

   !> Reverse PHI where the structure is softer in the other sense; NEAR: almost as soft.
   subroutine choose_sense(rest, alpha, phi, near)
      type(state_type), intent(in) :: rest
      real(wp), intent(in)         :: alpha
      real(wp), intent(inout)      :: phi(3)
      logical, intent(out)         :: near
      type(state_type) :: now
      real(wp) :: pushed(2), unused
      logical  :: ok
      integer  :: i

      unused = 0.0_wp
      pushed = 0.0_wp
      do i = 1, 2
         now = rest
         call go(now, force, force + alpha*inert(phi), stroke/8, unused, ok)
         if (ok) pushed(i) = sum(inert(phi)*(now%u - rest%u))
         phi = -phi
      end do
      near = abs(pushed(2) - pushed(1)) < 0.03_wp*maxval(pushed)
      if (pushed(2) > pushed(1)*(1.0_wp + 1.0e-6_wp)) phi = -phi
   end subroutine choose_sense

   !> ALPHA, from a guess, whose loop has the AMPLITUDE, by secants; half the mean stroke Q and the loss LOST of that loop.
   subroutine find_amplitude(rest, amplitude, phi, alpha, q, lost, ok)
      type(state_type), intent(in) :: rest
      real(wp), intent(in)         :: amplitude, phi(3)
      real(wp), intent(inout)      :: alpha
      real(wp), intent(out)        :: q, lost
      logical, intent(out)         :: ok
      real(wp) :: before(2), now(2), wanted
      integer  :: trial

      wanted = amplitude/norm2(phi(:2))
      before = 0.0_wp
      do trial = 1, 8
         call run_loops(rest, phi, alpha, q, lost, ok)
         if (.not. ok .or. abs(q/wanted - 1.0_wp) <= 1.0e-6_wp) return
         now = [alpha, q]
         if (trial == 1) alpha = alpha*(1.0_wp + 0.3_wp*(wanted/q - 1.0_wp))
         if (trial > 1) alpha = alpha + (wanted - q)*(now(1) - before(1))/(now(2) - before(2))
         before = now
      end do
      ok = abs(q/wanted - 1.0_wp) <= 1.0e-4_wp
   end subroutine find_amplitude

   !> Loops under ALPHA until they have settled: twice, for the change of q passes through zero while a loop still moves.
   subroutine run_loops(rest, phi, alpha, q, lost, ok)
      type(state_type), intent(in) :: rest
      real(wp), intent(in)         :: phi(3), alpha
      real(wp), intent(out)        :: q, lost
      logical, intent(out)         :: ok
      type(state_type) :: now
      real(wp) :: high, load(3), lost_before, low, q_before, top
      integer  :: i, settled

      settled = 0
      load = alpha*inert(phi)
      now = rest
      q = 0.0_wp
      lost = 0.0_wp
      call go(now, force, force + load, stroke/2, lost, ok)
      do i = 1, 42
         if (.not. ok) return
         q_before = q
         lost_before = lost
         lost = 0.0_wp
         top = sum(inert(phi)*(now%u - rest%u))
         call go(now, force + load, force - load, stroke, lost, ok)
         if (.not. ok) return
         low = sum(inert(phi)*(now%u - rest%u))
         call go(now, force - load, force + load, stroke, lost, ok)
         high = sum(inert(phi)*(now%u - rest%u))
         q = 0.25_wp*(top + high) - 0.5_wp*low
         settled = merge(settled + 1, 0, i > 1 .and. abs(q - q_before) <= 1.0e-6_wp*q .and. &
                         abs(lost - lost_before) <= 1.0e-3_wp*lost + 1.0e-7_wp*alpha*q)
         if (settled == 2) return
      end do
   end subroutine run_loops

   !> The part of the load at the end of increment I of JINCR.
   real(wp) function geometric(i)
      integer, intent(in) :: i
      real(wp) :: r
      integer  :: pass

      r = 1.1_wp ! 1e-4 (r^60 - 1)/(r - 1) = 1
      do pass = 1, 500
         r = ((r - 1.0_wp)*1.0e4_wp + 1.0_wp)**(1.0_wp/60)
      end do
      geometric = 1.0e-4_wp*(r**i - 1.0_wp)/(r - 1.0_wp)
      if (i == 60) geometric = 1.0_wp
   end function geometric

   function inert(phi) result(f)
      real(wp), intent(in) :: phi(3)
      real(wp) :: f(3)

      f = [mass, mass, inertia]*phi
   end function inert

end program direct_loops
