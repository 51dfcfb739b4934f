!> Properties of the bodies: sections and materials, from their cards to positions in the model.
module property_build
   use deck_cards, only: add_field_error
   use deck_errors, only: deck_error_list
   use deck_input, only: deck_type
   use elasticity, only: axisymmetric, plane_strain, plane_stress, solid
   use element_kinds, only: element_table
   use id_table, only: id_table_type
   use model_data, only: model_type, property_type
   use text_tools, only: integer_text
   implicit none
   private

   public :: resolve_properties, check_property

contains

   !> Every PSHELL, PAXIS and PSOLID with its material.
   subroutine resolve_properties(deck, model, errors)
      type(deck_type), intent(in)          :: deck
      type(model_type), intent(inout)      :: model
      type(deck_error_list), intent(inout) :: errors
      type(id_table_type) :: materials
      integer :: i, n

      associate (bulk => deck%bulk)
         call materials%build(bulk%mat1(:bulk%n_mat1)%id)
         allocate (model%properties(bulk%n_pshell + bulk%n_paxis + bulk%n_psolid))
         do i = 1, bulk%n_pshell
            associate (pshell => bulk%pshell(i), property => model%properties(i))
               property%id = pshell%id
               property%state = merge(plane_strain, plane_stress, pshell%plane_strain)
               property%thickness = pshell%thickness
               property%incompatible = pshell%incompatible
               call set_material(deck, materials, pshell%material, pshell%line, 'MID1', property, errors)
            end associate
         end do
         n = bulk%n_pshell
         do i = 1, bulk%n_paxis
            model%properties(n + i)%id = bulk%paxis(i)%id
            model%properties(n + i)%state = axisymmetric
            call set_material(deck, materials, bulk%paxis(i)%material, bulk%paxis(i)%line, 'MID', model%properties(n + i), errors)
         end do
         n = n + bulk%n_paxis
         do i = 1, bulk%n_psolid
            model%properties(n + i)%id = bulk%psolid(i)%id
            model%properties(n + i)%state = solid
            model%properties(n + i)%incompatible = bulk%psolid(i)%incompatible
            call set_material(deck, materials, bulk%psolid(i)%material, bulk%psolid(i)%line, 'MID', model%properties(n + i), &
                              errors)
         end do
      end associate
   end subroutine resolve_properties


   !> The material of a PROPERTY by its id; an error about field 2 of the card on LINE where there is none.
   subroutine set_material(deck, materials, id, line, field, property, errors)
      type(deck_type), intent(in)          :: deck
      type(id_table_type), intent(in)      :: materials
      integer, intent(in)                  :: id, line
      character(*), intent(in)             :: field
      type(property_type), intent(inout)   :: property
      type(deck_error_list), intent(inout) :: errors
      integer :: material

      material = materials%find(id)
      if (material > 0) then
         property%e = deck%bulk%mat1(material)%e
         property%nu = deck%bulk%mat1(material)%nu
         property%rho = deck%bulk%mat1(material)%rho
      else if (id > 0) then
         call add_field_error(deck%text, line, 2, field, 'there is no MAT1 '//integer_text(id), errors)
      end if
   end subroutine set_material


   !> The property ID of an element of a KIND must be one of its own sort; PROPERTY is its position, 0 for none, and set to 0
   !! where it is of another.
   subroutine check_property(deck, model, line, id, kind, property, errors)
      type(deck_type), intent(in)          :: deck
      type(model_type), intent(in)         :: model
      integer, intent(in)                  :: line, id, kind
      integer, intent(inout)               :: property
      type(deck_error_list), intent(inout) :: errors
      character(:), allocatable :: wanted

      if (model%dimension == 3 .and. element_table(kind)%dimension == 2) then
         call errors%add(line, 'BLOCK2: the model has solids; plane bodies and solids cannot be mixed')
         return
      end if
      wanted = 'PSHELL or PAXIS '
      if (element_table(kind)%dimension == 3) wanted = 'PSOLID '
      if (property > 0) then
         if ((model%properties(property)%state == solid) .eqv. element_table(kind)%dimension == 3) return
         property = 0
      end if
      if (id == 0) return
      if (any(deck%bulk%pmark(:deck%bulk%n_pmark)%id == id) .and. element_table(kind)%dimension == 2) then
         call add_field_error(deck%text, line, 2, 'PID', integer_text(id)//' is a PMARK: a surface of a plane body is '// &
                              'marked with CBAR or CROD edges', errors)
      else
         call add_field_error(deck%text, line, 2, 'PID', 'there is no '//wanted//integer_text(id), errors)
      end if
   end subroutine check_property

end module property_build
