!> The laws of the joints: from PJOINT, JNORM and JSHEAR cards to the joints that name them.
module law_build
   use deck_check, only: checked_deck
   use id_table, only: id_table_type
   use interface_operator, only: nodes_of_end, weights_of_end
   use kinds, only: wp
   use model_data, only: joint_type, model_type
   use text_tools, only: integer_text, real_text
   implicit none
   private

   public :: list_laws, resolve_laws, default_slope, check_first_pressure

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

      i = 0
      if (id > 0) i = tables%pjoint%find(id)
      if (i == 0) return ! said where the laws are checked
      associate (pjoint => deck%bulk%pjoint(i), law => joint%law)
         if (pjoint%p0_given) joint%p0 = pjoint%p0
         law%has_friction = pjoint%mu_given
         law%mu = pjoint%mu
         joint%n_reanalyses = pjoint%n_reanalyses
         k = tables%jnorm%find(pjoint%normal_law)
         if (k > 0) then ! else said where PJOINT is checked
            law%normal = deck%bulk%jnorm(k)%law
            joint%e_u_given = deck%bulk%jnorm(k)%e_u_given
         end if
         do direction = 1, 2
            k = tables%jshear%find(pjoint%shear_laws(direction))
            if (k == 0 .or. pjoint%shear_laws(direction) == 0) cycle
            law%shear(direction) = deck%bulk%jshear(k)%law
         end do
      end associate
   end subroutine resolve_laws

   !> The unloading slope that the card leaves blank: the equivalent E of both bodies, 2 E1 E2/(E1 + E2), per unit length; on a
   !! rigid base E of the body.
   subroutine default_slope(deck, model, joint)
      type(checked_deck), intent(in)  :: deck
      type(model_type), intent(in)    :: model
      type(joint_type), intent(inout) :: joint
      real(wp) :: e(2), lower, higher
      logical  :: is_there(2)
      integer  :: end

      if (joint%e_u_given .or. joint%law%normal%c <= 0.0_wp) return
      do end = 1, 2
         call find_modulus(model, joint, end, e(end), is_there(end))
      end do
      if (.not. any(is_there)) then
         if (joint%last >= joint%first) call deck%errors%add(joint%line, 'joint '//integer_text(joint%id)// &
            ': the JNORM of this joint leaves EU blank, and there is no body at the joint to take E from: give EU')
         return
      end if
      lower = minval(e, mask=is_there)
      higher = maxval(e, mask=is_there)
      if (higher > 0.0_wp) joint%law%normal%e_u = lower*(2.0_wp*higher/(lower + higher)) ! exactly E where both are the same
   end subroutine default_slope

   !> A P0 above E of the bodies is no pressure that they could bear. The joint laws take the scale of rounding from it, and would take
   !! the tension of an element for rounding.
   subroutine check_first_pressure(deck, model, joint)
      type(checked_deck), intent(in) :: deck
      type(model_type), intent(in)   :: model
      type(joint_type), intent(in)   :: joint
      real(wp) :: e(2)
      logical  :: is_there(2)
      integer  :: end

      if (joint%p0 <= 0.0_wp) return
      do end = 1, 2
         call find_modulus(model, joint, end, e(end), is_there(end))
      end do
      if (maxval(e) > 0.0_wp .and. joint%p0 > maxval(e)) call deck%errors%add(joint%line, 'joint '//integer_text(joint%id)// &
         ': P0 of its PJOINT, '//real_text(joint%p0)//', is above E of the bodies beside it, '//real_text(maxval(e))// &
         ': give about the mean pressure of the first increment')
   end subroutine check_first_pressure

   !> E of the bodies at END 1 or 2 of the interface elements of JOINT, if there are any: the mean of their elements at the nodes
   !! there, areas of influence as weights, which the nodes of a list share out as its weights stand to each other [pressure].
   pure subroutine find_modulus(model, joint, end, e, is_there)
      type(model_type), intent(in) :: model
      type(joint_type), intent(in) :: joint
      integer, intent(in)          :: end
      real(wp), intent(out)        :: e
      logical, intent(out)         :: is_there
      real(wp) :: total, weight
      integer, allocatable  :: nodes(:)
      real(wp), allocatable :: share(:)
      integer :: i, j, k

      e = 0.0_wp
      is_there = .false.
      total = 0.0_wp
      do i = joint%first, joint%last
         nodes = nodes_of_end(model%interface(i), end)
         share = weights_of_end(model%interface(i), end)
         share = share/sum(share)
         do k = 1, size(nodes)
            associate (elements => model%elements_at(model%first_at(nodes(k)):model%first_at(nodes(k) + 1) - 1))
               do j = 1, size(elements)
                  is_there = .true.
                  if (model%element_property(elements(j)) == 0) cycle      ! said elsewhere
                  weight = model%interface(i)%area*share(k)/size(elements)
                  total = total + weight
                  e = e + (model%properties(model%element_property(elements(j)))%e - e)*(weight/max(total, tiny(1.0_wp)))
               end do
            end associate
         end do
      end do
   end subroutine find_modulus

end module law_build
