!> Tables of the bodies: displacements, stresses, reactions, and the balance of the outer forces.
module listing_bodies
   use analysis_state, only: analysis_type, element_force
   use body_elements, only: element_stress, full_stress
   use elasticity, only: max_stresses, n_stresses
   use interface_operator, only: named_node
   use kinds, only: wp
   use listing_page, only: heading, in_units, label_type, noise, page_width, where_now
   use model_data, only: corners_of, model_type, n_points
   use output_file, only: output_file_type
   use stage_plan, only: stage_plan_type
   use stress_measures, only: principal_stresses, von_mises
   use text_line, only: text_line_type
   use text_tools, only: clean
   implicit none
   private

   public :: list_bodies

contains

   !> Displacements, stresses, reactions.
   subroutine list_bodies(file, labels, largest_force, model, plan, analysis)
      type(output_file_type), intent(inout) :: file
      type(label_type), intent(in)      :: labels
      real(wp), intent(in)              :: largest_force !! ever applied, for the noise
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      type(analysis_type), intent(in)   :: analysis

      call list_displacements(file, labels, model, plan, analysis)
      call list_stresses(file, labels, model, plan, analysis)
      call list_reactions(file, labels, largest_force, model, plan, analysis)
   end subroutine list_bodies


   subroutine list_displacements(file, labels, model, plan, analysis)
      type(output_file_type), intent(inout) :: file
      type(label_type), intent(in)      :: labels
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      type(analysis_type), intent(in)   :: analysis
      type(text_line_type) :: line
      real(wp) :: floor
      integer  :: node

      call heading(file, 'DISPLACEMENTS OF NODES'//where_now(plan, analysis)//in_units(labels%length))
      if (model%dimension == 3) then
         call file%put('       NODE            X            Y            Z           UX           UY           UZ')
      else
         call file%put('       NODE            X            Y           UX           UY')
      end if
      floor = noise*maxval(abs(analysis%all_u(:, :n_points(model))))
      do node = 1, n_points(model)
         if (.not. model%used(node)) cycle
         call line%clear()
         call line%add_integer(model%node_id(node), 11)
         call line%add_short(clean(model%x(:model%dimension, node)))
         call line%add_short(clean(analysis%all_u(:, node), floor))
         call file%put(line%text(:line%length))
      end do
   end subroutine list_displacements


   subroutine list_stresses(file, labels, model, plan, analysis)
      type(output_file_type), intent(inout) :: file
      type(label_type), intent(in)      :: labels
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      type(analysis_type), intent(in)   :: analysis
      type(text_line_type) :: line
      real(wp), allocatable :: stress(:, :)
      real(wp) :: floor
      integer  :: e, n

      if (model%n_elements == 0) return
      allocate (stress(max_stresses, model%n_elements), source=0.0_wp)
      n = 0
      do e = 1, model%n_elements
         n = n_stresses(model%properties(model%element_property(e))%state)
         stress(:n, e) = element_stress(model, e, analysis%all_u)
      end do
      floor = noise*maxval(abs(stress))
      call heading(file, 'STRESSES AT THE CENTRES OF ELEMENTS'//where_now(plan, analysis)// &
                   in_units(labels%pressure))
      if (model%dimension == 3) then
         call file%put('    ELEMENT     CENTRE X     CENTRE Y     CENTRE Z      SIGMA X      SIGMA Y      SIGMA Z'// &
                       '       TAU XY       TAU YZ       TAU ZX')
      else if (model%axisymmetric) then
         call file%put('    ELEMENT     CENTRE X     CENTRE Y      SIGMA X      SIGMA Y   SIGMA HOOP       TAU XY')
      else
         call file%put('    ELEMENT     CENTRE X     CENTRE Y      SIGMA X      SIGMA Y       TAU XY')
      end if
      do e = 1, model%n_elements
         call line%clear()
         call line%add_integer(model%element_id(e), 11)
         call line%add_short(clean(centre(model, e)))
         call line%add_short(clean(stress(:n, e), floor))
         call file%put(line%text(:line%length))
      end do
      if (plan%stages(analysis%stage)%stress) call list_principal(file, labels, model, plan, analysis, stress(:n, :), floor)
   end subroutine list_stresses


   !> Principal stresses and the equivalent stress of von Mises at the centres, where OUTPUT = STRESS asks for them.
   subroutine list_principal(file, labels, model, plan, analysis, stress, floor)
      type(output_file_type), intent(inout) :: file
      type(label_type), intent(in)      :: labels
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      type(analysis_type), intent(in)   :: analysis
      real(wp), intent(in)              :: stress(:, :)
      real(wp), intent(in)              :: floor
      type(text_line_type) :: line
      real(wp) :: full(max_stresses)
      integer  :: e

      call heading(file, 'PRINCIPAL STRESSES AT THE CENTRES OF ELEMENTS'//where_now(plan, analysis)//in_units(labels%pressure))
      call file%put('    ELEMENT      SIGMA 1      SIGMA 2      SIGMA 3    VON MISES')
      do e = 1, model%n_elements
         full = full_stress(model, e, stress(:, e))
         call line%clear()
         call line%add_integer(model%element_id(e), 11)
         call line%add_short(clean(principal_stresses(full), floor))
         call line%add_short([clean(von_mises(full), floor)])
         call file%put(line%text(:line%length))
      end do
   end subroutine list_principal


   !> The mean of the corners of element E.
   pure function centre(model, e) result(x)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e
      real(wp) :: x(model%dimension)

      associate (nodes => corners_of(model, e))
         x = sum(model%x(:model%dimension, nodes), dim=2)/size(nodes)
      end associate
   end function centre


   !> Reactions at supports, and the balance of all outer forces: loads, supports, rigid bases.
   subroutine list_reactions(file, labels, largest_force, model, plan, analysis)
      type(output_file_type), intent(inout) :: file
      type(label_type), intent(in)      :: labels
      real(wp), intent(in)              :: largest_force !! ever applied, for the noise
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      type(analysis_type), intent(in)   :: analysis
      type(text_line_type) :: line
      real(wp), dimension(model%dimension) :: reaction, supports, base, loads
      real(wp) :: floor, force(3)
      integer  :: i, node

      floor = noise*max(largest_force, tiny(1.0_wp))
      call heading(file, 'REACTIONS AT SUPPORTS'//where_now(plan, analysis)//in_units(labels%force))
      if (model%dimension == 3) then
         call file%put('       NODE            X            Y            Z           RX           RY           RZ')
      else
         call file%put('       NODE            X            Y           RX           RY')
      end if
      supports = 0.0_wp
      do node = 1, n_points(model)
         if (.not. any(model%held(:, node)) .or. .not. model%used(node)) cycle
         reaction = merge(-analysis%all_unbalanced(:, node), 0.0_wp, model%held(:, node))
         supports = supports + reaction
         call line%clear()
         call line%add_integer(model%node_id(node), 11)
         call line%add_short(clean(model%x(:model%dimension, node)))
         call line%add_short(clean(reaction, floor))
         call file%put(line%text(:line%length))
      end do
      base = 0.0_wp
      do i = 1, size(model%interface)
         if (named_node(model%interface(i), 2) /= 0) cycle
         force = element_force(model%interface(i), analysis%states(i))
         base = base - force(:model%dimension)
      end do
      loads = sum(analysis%applied(:, :n_points(model)), dim=2)
      call heading(file, 'BALANCE OF FORCES'//where_now(plan, analysis)//in_units(labels%force))
      if (model%dimension == 3) then
         call file%put('                                               X            Y            Z')
      else if (model%axisymmetric) then
         call file%put('                                               Y  (THE RADIAL FORCES BALANCE ROUND THE RING)')
      else
         call file%put('                                               X            Y')
      end if
      call balance_line('LOADS', loads)
      call balance_line('SUPPORTS', supports)
      call balance_line('RIGID BASES, THROUGH THE JOINTS', base)
      call balance_line('SUM: LEFT UNBALANCED', loads + supports + base)

   contains

      subroutine balance_line(words, resultant)
         character(*), intent(in) :: words
         real(wp), intent(in)     :: resultant(:)
         character(page_width) :: row

         write (row, '(2x, a, t36, 3es13.5)') words, clean(resultant(merge(2, 1, model%axisymmetric):), floor)
         call file%put(row)
      end subroutine balance_line

   end subroutine list_reactions

end module listing_bodies
