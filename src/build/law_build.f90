!> The laws of the joints: from PJOINT, JNORM and JSHEAR cards to the joints that name them.
module law_build
   use deck_check, only: checked_deck
   use id_table, only: id_table_type
   use kinds, only: wp
   use model_data, only: joint_type, model_type
   use normal_stiffness, only: normal_law
   use text_tools, only: integer_text
   implicit none
   private

   public :: list_laws, resolve_laws, default_slope

   !> Where the cards of the laws stand.
   type, public :: law_tables
      type(id_table_type), private :: pjoint, jnorm, jshear
   end type law_tables

contains

   !> The TABLES of the law cards of DECK.
   subroutine list_laws(deck, tables)
      type(checked_deck), intent(in)  :: deck
      type(law_tables), intent(inout) :: tables

      call tables%pjoint%build(deck%bulk%pjoint%id)
      call tables%jnorm%build(deck%bulk%jnorm%id)
      call tables%jshear%build(deck%bulk%jshear%id)
   end subroutine list_laws


   !> The laws of a joint, by the id of its PJOINT.
   subroutine resolve_laws(deck, tables, id, joint)
      type(checked_deck), intent(in)  :: deck
      type(law_tables), intent(in)    :: tables
      integer, intent(in)             :: id
      type(joint_type), intent(inout) :: joint
      integer :: direction, i, k

      if (id == 0) return
      i = tables%pjoint%find(id)
      if (i == 0) then
         call deck%field_error(joint%line, 'PJID', 'there is no PJOINT '//integer_text(id))
         return
      end if
      associate (pjoint => deck%bulk%pjoint(i), law => joint%law)
         if (pjoint%p0_given) joint%p0 = pjoint%p0
         law%has_friction = pjoint%mu_given
         law%mu = pjoint%mu
         joint%n_reanalyses = pjoint%n_reanalyses
         k = tables%jnorm%find(pjoint%normal_law)
         if (k > 0) then ! else said where PJOINT is checked
            law%normal = normal_law(c=deck%bulk%jnorm(k)%c, m=deck%bulk%jnorm(k)%m, e_u=deck%bulk%jnorm(k)%e_u)
            joint%e_u_given = deck%bulk%jnorm(k)%e_u_given
         end if
         do direction = 1, 2
            k = tables%jshear%find(pjoint%shear_laws(direction))
            if (k == 0 .or. pjoint%shear_laws(direction) == 0) cycle
            law%shear(direction) = deck%bulk%jshear(k)%law
         end do
      end associate
   end subroutine resolve_laws


   !> The unloading slope that the card leaves blank: E of the body at the joint, per unit length.
   subroutine default_slope(deck, model, joint)
      type(checked_deck), intent(in)  :: deck
      type(model_type), intent(in)    :: model
      type(joint_type), intent(inout) :: joint
      integer :: i, k, node

      if (joint%e_u_given .or. joint%law%normal%c <= 0.0_wp) return
      do i = joint%first, joint%last
         do k = 1, size(model%interface(i)%node)
            node = model%interface(i)%node(k)
            if (model%first_at(node) == model%first_at(node + 1)) cycle
            associate (property => model%element_property(model%elements_at(model%first_at(node))))
               if (property > 0) joint%law%normal%e_u = model%properties(property)%e
            end associate
            return
         end do
      end do
      if (joint%last >= joint%first) call deck%errors%add(joint%line, 'joint '//integer_text(joint%id)// &
         ': the JNORM of this joint leaves EU blank, and there is no body at the joint to take E from: give EU')
   end subroutine default_slope

end module law_build
