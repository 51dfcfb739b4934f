!> Tables of the bodies: displacements, stresses, reactions, and the balance of the outer forces.
module listing_bodies
   use analysis_state, only: analysis_type, element_force
   use body_elements, only: element_stress, full_stress
   use elasticity, only: max_stresses, n_stresses
   use interface_operator, only: named_node
   use kinds, only: wp
   use listing_table, only: axes, column, listing_table_type, noise, page_type
   use model_data, only: corners_of, model_type, n_points
   use stress_measures, only: principal_stresses, von_mises
   use text_tools, only: clean
   implicit none
   private

   public :: list_bodies

contains

   !> Displacements, stresses, with PRINCIPAL also the principal ones, reactions.
   subroutine list_bodies(page, principal, model, analysis)
      type(page_type), intent(inout)  :: page
      logical, intent(in)             :: principal
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis

      call list_displacements(page, model, analysis)
      if (model%n_elements > 0) call list_stresses(page, principal, model, analysis)
      call list_reactions(page, model, analysis)
   end subroutine list_bodies

   subroutine list_displacements(page, model, analysis)
      type(page_type), intent(inout)  :: page
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      type(listing_table_type) :: table
      real(wp) :: floor
      integer  :: node

      call table%start('DISPLACEMENTS OF NODES'//page%now//in_units(page%labels%length), &
                       [column('NODE', 'i11'), column(axes(:model%dimension), 'es13.5'), &
                        column('U'//axes(:model%dimension), 'es13.5')])
      call table%print_head(page%file)
      floor = noise*maxval(abs(analysis%all_u(:, :n_points(model))))
      do node = 1, n_points(model)
         if (.not. model%used(node)) cycle
         call table%add([model%node_id(node)])
         call table%add(clean(model%x(:model%dimension, node)))
         call table%add(clean(analysis%all_u(:, node), floor))
         call table%print_row(page%file)
      end do
   end subroutine list_displacements

   subroutine list_stresses(page, principal, model, analysis)
      type(page_type), intent(inout)  :: page
      logical, intent(in)             :: principal
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      type(listing_table_type) :: table
      real(wp), allocatable :: stress(:, :)
      real(wp) :: floor
      character(10), allocatable :: names(:)
      integer  :: e, n

      allocate (stress(max_stresses, model%n_elements), source=0.0_wp)
      n = 0
      do e = 1, model%n_elements
         n = n_stresses(model%properties(model%element_property(e))%state)
         stress(:n, e) = element_stress(model, e, analysis%all_u)
      end do
      floor = noise*maxval(abs(stress))
      if (model%dimension == 3) then
         names = [character(10) :: 'SIGMA X', 'SIGMA Y', 'SIGMA Z', 'TAU XY', 'TAU YZ', 'TAU ZX']
      else if (model%axisymmetric) then
         names = [character(10) :: 'SIGMA X', 'SIGMA Y', 'SIGMA HOOP', 'TAU XY']
      else
         names = [character(10) :: 'SIGMA X', 'SIGMA Y', 'TAU XY']
      end if
      call table%start('STRESSES AT THE CENTRES OF ELEMENTS'//page%now//in_units(page%labels%pressure), &
                       [column('ELEMENT', 'i11'), column('CENTRE '//axes(:model%dimension), 'es13.5'), column(names, 'es13.5')])
      call table%print_head(page%file)
      do e = 1, model%n_elements
         call table%add([model%element_id(e)])
         associate (nodes => corners_of(model, e))
            call table%add(clean(sum(model%x(:model%dimension, nodes), dim=2)/size(nodes)))
         end associate
         call table%add(clean(stress(:n, e), floor))
         call table%print_row(page%file)
      end do
      if (principal) call list_principal(page, model, stress(:n, :), floor)
   end subroutine list_stresses

   !> Principal stresses and the equivalent stress of von Mises at the centres.
   subroutine list_principal(page, model, stress, floor)
      type(page_type), intent(inout) :: page
      type(model_type), intent(in)   :: model
      real(wp), intent(in)           :: stress(:, :) !! (stresses of a state, elements)
      real(wp), intent(in)           :: floor
      type(listing_table_type) :: table
      real(wp) :: full(max_stresses)
      integer  :: e

      call table%start('PRINCIPAL STRESSES AT THE CENTRES OF ELEMENTS'//page%now//in_units(page%labels%pressure), &
                       [column('ELEMENT', 'i11'), column([character(9) :: 'SIGMA 1', 'SIGMA 2', 'SIGMA 3', 'VON MISES'], 'es13.5')])
      call table%print_head(page%file)
      do e = 1, model%n_elements
         full = full_stress(model, e, stress(:, e))
         call table%add([model%element_id(e)])
         call table%add(clean(principal_stresses(full), floor))
         call table%add([clean(von_mises(full), floor)])
         call table%print_row(page%file)
      end do
   end subroutine list_principal

   !> Reactions at supports, and the balance of all outer forces: loads, supports, rigid bases.
   subroutine list_reactions(page, model, analysis)
      type(page_type), intent(inout)  :: page
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      type(listing_table_type) :: table
      real(wp), dimension(model%dimension) :: reaction, supports, base, loads
      real(wp) :: floor, force(3)
      integer  :: first, i, node

      call table%start('REACTIONS AT SUPPORTS'//page%now//in_units(page%labels%force), &
                       [column('NODE', 'i11'), column(axes(:model%dimension), 'es13.5'), &
                        column('R'//axes(:model%dimension), 'es13.5')])
      call table%print_head(page%file)
      floor = noise*max(page%largest_force, tiny(1.0_wp))
      supports = 0.0_wp
      do node = 1, n_points(model)
         if (.not. any(model%held(:, node)) .or. .not. model%used(node)) cycle
         reaction = merge(-analysis%all_unbalanced(:, node), 0.0_wp, model%held(:, node))
         supports = supports + reaction
         call table%add([model%node_id(node)])
         call table%add(clean(model%x(:model%dimension, node)))
         call table%add(clean(reaction, floor))
         call table%print_row(page%file)
      end do
      base = 0.0_wp
      do i = 1, size(model%interface)
         if (named_node(model%interface(i), 2) /= 0) cycle
         force = element_force(model%interface(i), analysis%states(i))
         base = base - force(:model%dimension)
      end do
      loads = sum(analysis%applied(:, :n_points(model)), dim=2)
      first = merge(2, 1, model%axisymmetric)
      call table%start('BALANCE OF FORCES'//page%now//in_units(page%labels%force), &
                       [column('', 'a35'), column(axes(first:model%dimension), 'es13.5'), &
                        column(merge('  (THE RADIAL FORCES BALANCE ROUND THE RING)', repeat(' ', 44), model%axisymmetric), 'a')])
      call table%print_head(page%file)
      call balance_line('LOADS', loads(first:))
      call balance_line('SUPPORTS', supports(first:))
      call balance_line('RIGID BASES, THROUGH THE JOINTS', base(first:))
      call balance_line('SUM: LEFT UNBALANCED', loads(first:) + supports(first:) + base(first:))

   contains

      subroutine balance_line(words, resultant)
         character(*), intent(in) :: words
         real(wp), intent(in)     :: resultant(:)
         character(33) :: name

         name = words
         call table%add(name)
         call table%add(clean(resultant, floor))
         call table%print_row(page%file)
      end subroutine balance_line

   end subroutine list_reactions

   !> The unit behind a heading, in brackets; empty where LABEL is blank.
   pure function in_units(label) result(words)
      character(*), intent(in)  :: label
      character(:), allocatable :: words

      words = ''
      if (label /= '') words = '   ('//trim(label)//')'
   end function in_units

end module listing_bodies
