!> Inertia relief, PARAM INREL: a free structure under loads that do not balance themselves accelerates as a rigid body.
!!
!! The inertia forces -[m] {a} of its accelerations are added to the loads of each stage, so that the components of SUPORT, to which all
!! displacements are relative, have no reactions. With the rigid-body motions [R] that the other supports leave,
!!
!!    {a} = [R] ([R]^T [m] [R])^-1 [R]^T {F}
!!
!! INREL = -2 needs no SUPORT: any components hold the structure, and {u} is then without the mean motion of the masses,
!! [R]^T [m] {u} = 0.
!!
!! Source: MSC Nastran, Linear Static Analysis User's Guide, inertia relief.
module inertia_relief
   use constraint_equations, only: invert
   use deck_check, only: checked_deck
   use free_structure, only: beside
   use interface_operator, only: named_node
   use kinds, only: wp
   use mass_matrix, only: form_mass, mass_matrix_type, mass_times, total_mass
   use mesh_queries, only: n_points, node_kind, place_in_kind
   use model_data, only: a_point, a_rotation, freedoms_type, history_type, joints_type, model_type, n_sections, supported
   use stage_plan, only: stage_plan_type
   use text_tools, only: integer_text, real_text
   use tolerances, only: balanced
   use unknowns, only: component_axes, motions_at, n_motions
   use wave_build, only: add_force
   implicit none
   private

   public :: relieve

contains

   !> Add the inertia forces to the loads of HISTORY, and warn of the accelerations. Errors: a structure without SUPORT, one that a rigid
   !! base or a grounded spring supports, one without mass; components of SUPORT that do not hold just its motions.
   subroutine relieve(deck, model, plan, joints, sets, history)
      type(checked_deck), intent(in)    :: deck
      type(model_type), intent(inout)   :: model   !! mesh, and freedoms of any set; rigid and mean are set
      type(stage_plan_type), intent(in) :: plan
      type(joints_type), intent(in)     :: joints
      type(freedoms_type), intent(in)   :: sets(:) !! of the plan
      type(history_type), intent(inout) :: history
      type(mass_matrix_type) :: mass
      real(wp), allocatable :: r(:, :, :), mr(:, :, :) ! (dimension, n_nodes, motions): about the centre of mass, rotations by 1/extent
      real(wp), allocatable :: g(:, :), inverse(:, :), n(:, :)
      real(wp) :: a(n_motions(model%mesh%dimension)), centre(3), extent, force(3), whole, inertia(6)
      integer  :: c, d, k, s
      logical  :: ok
      character(:), allocatable :: name

      name = 'PARAM INREL = '//integer_text(deck%bulk%parameters%relief)
      if (size(deck%bulk%suport) == 0 .and. deck%bulk%parameters%relief == -1) &
         call report('expected SUPORT, the components to which displacements are relative')
      if (any(deck%bulk%spring%nodes(1) == 0 .or. deck%bulk%spring%nodes(2) == 0) .or. &
          any([(named_node(joints%element(k), 2) == 0, k = 1, size(joints%element))])) &
         call report('a grounded spring or a rigid base supports the structure; expected a free one')
      if (deck%errors%any()) return
      d = model%mesh%dimension
      call form_mass(model, mass)
      call total_mass(model, mass, whole, centre, inertia)
      associate (mesh => model%mesh)
         extent = norm2(maxval(mesh%x(:, :n_points(mesh)), dim=2) - minval(mesh%x(:, :n_points(mesh)), dim=2))
         allocate (r(d, mesh%n_nodes, size(a)), mr(d, mesh%n_nodes, size(a)), source=0.0_wp)
         do k = 1, mesh%n_nodes
            if (node_kind(mesh, k) == a_point) r(:, k, :) = motions_at((mesh%x(:d, k) - centre(:d))/extent)
            if (node_kind(mesh, k) /= a_rotation) cycle
            do c = 1, size(a) - d
               r(c, k, d + c) = mesh%rotations(place_in_kind(mesh, k))%arm/extent
            end do
         end do
      end associate
      do c = 1, size(a)
         call mass_times(model, mass, r(:, :, c), mr(:, :, c))
      end do
      g = reshape([((sum(r(:, :, k)*mr(:, :, c)), k = 1, size(a)), c = 1, size(a))], [size(a), size(a)])
      do s = 1, size(history%stages)
         associate (loads => history%stages(s))
            if (loads%n == 0 .or. deck%errors%any()) cycle
            call find_motions(model, sets(plan%stages(s)%supports), r, n, ok)
            if (.not. ok) call report('the components of SUPORT are not those that hold the '//integer_text(size(n, 2))// &
                                      ' rigid-body motions which the other supports leave')
            if (.not. ok) cycle
            allocate (inverse(size(n, 2), size(n, 2)))
            call invert(matmul(matmul(transpose(n), g), n), inverse, ok)
            if (.not. ok) call report('a rigid-body motion moves no mass; expected RHO on MAT1, or CONM2')
            if (.not. ok) return
            if (deck%bulk%parameters%relief == -2 .and. .not. allocated(model%mean)) then
               model%rigid = reshape(matmul(reshape(r, [size(r)/size(a), size(a)]), n), [d, size(r, 2), size(n, 2)])
               model%mean = reshape(matmul(reshape(mr, [size(r)/size(a), size(a)]), matmul(n, inverse)), shape(model%rigid))
            end if
            a = [(sum([(dot_product(loads%force(:d, k), r(:, loads%node(k), c)), k = 1, loads%n)]), c = 1, size(a))]
            a = matmul(n, matmul(inverse, matmul(transpose(n), a)))
            deallocate (inverse)
            do k = 1, size(mr, 2)
               force = 0.0_wp
               force(:d) = -matmul(mr(:, k, :), a)
               if (any(abs(force) > 0.0_wp)) call add_force(k, force, loads)
            end do
            call deck%errors%warn(name//': stage '//integer_text(s)//' has the inertia forces of the acceleration '// &
               listed(a(:d))//' of the centre of mass and the angular acceleration '//listed(a(d + 1:)/extent))
         end associate
      end do

   contains

      subroutine report(words)
         character(*), intent(in) :: words

         call deck%errors%add(deck%bulk%parameters%relief_line, name//': '//words)
      end subroutine report

      pure function listed(values) result(words)
         real(wp), intent(in) :: values(:)
         character(:), allocatable :: words
         integer :: i

         words = real_text(values(1))
         do i = 2, size(values)
            words = words//', '//real_text(values(i))
         end do
      end function listed

   end subroutine relieve

   !> N: the rigid-body motions that the supports in FREEDOMS without SUPORT leave, orthonormal combinations of R. OK: the components of
   !! SUPORT are as many as these and hold them.
   subroutine find_motions(model, freedoms, r, n, ok)
      type(model_type), intent(in)    :: model
      type(freedoms_type), intent(in) :: freedoms
      real(wp), intent(in)            :: r(:, :, :)  !! (dimension, n_nodes, motions)
      real(wp), allocatable, intent(out) :: n(:, :)  !! (motions, left motions)
      logical, intent(out)            :: ok
      real(wp) :: basis(size(r, 3), size(r, 3)), held(size(r, 3), size(r, 3)), unit(size(r, 3), size(r, 3))
      real(wp), allocatable :: inverse(:, :)
      integer  :: d, first, k, most, n_held, rank

      rank = 0
      n_held = 0
      do k = 1, model%mesh%n_nodes - n_sections(model%mesh)
         if (node_kind(model%mesh, k) == a_rotation) then
            associate (rotation => model%mesh%rotations(place_in_kind(model%mesh, k)))
               if (.not. rotation%of_element .or. rotation%of_rods) cycle
            end associate
         end if
         associate (is_held => supported(model%mesh, freedoms, k), &
                    along => matmul(transpose(r(:, k, :)), component_axes(model%mesh, k)))
            do d = 1, size(r, 1)
               if (.not. is_held(d)) cycle
               if (freedoms%support_groups(freedoms%support_of(d, k))%kind /= 'FREE') then
                  call add(along(:, d))
               else
                  n_held = n_held + 1
                  if (n_held <= size(held, 2)) held(:, n_held) = along(:, d)
               end if
            end do
         end associate
      end do
      first = rank + 1
      unit = 0.0_wp
      do k = 1, size(unit, 2)
         unit(k, k) = 1.0_wp
      end do
      do while (rank < size(basis, 2)) ! the motion of which the basis has least
         most = 1
         do k = 2, size(unit, 2)
            if (norm2(beside(unit(:, k), basis(:, :rank))) > norm2(beside(unit(:, most), basis(:, :rank)))) most = k
         end do
         call add(unit(:, most))
      end do
      n = basis(:, first:)
      ok = n_held == size(n, 2) .and. n_held > 0
      if (.not. ok) return
      allocate (inverse(n_held, n_held))
      call invert(matmul(transpose(held(:, :n_held)), n), inverse, ok)

   contains

      subroutine add(motion)
         real(wp), intent(in) :: motion(:)
         real(wp) :: left(size(motion))

         left = beside(motion, basis(:, :rank))
         if (rank == size(basis, 2) .or. norm2(left) <= balanced) return
         rank = rank + 1
         basis(:, rank) = left/norm2(left)
      end subroutine add

   end subroutine find_motions

end module inertia_relief
