!> Finds properties and coordinate systems that nothing uses: they are read without effect.
module unused_cards
   use bulk_data, only: bulk_data_type
   use lists, only: id_table_type
   use mesh_cards, only: system_names
   implicit none
   private

   public :: count_unused

contains

   !> Add the unused properties and coordinate systems of BULK to its entries without effect.
   subroutine count_unused(bulk)
      type(bulk_data_type), intent(inout) :: bulk

      associate (properties => [bulk%block%property, bulk%element%property, bulk%edge%property], &
                 springs => bulk%spring_property, is_bush => bulk%spring%is_bush, system => bulk%system)
         call count_unnamed([bulk%pshell%id, bulk%paxis%id, bulk%psolid%id, bulk%prod%id, bulk%beam_property%id], properties, &
            [bulk%pshell%name, spread('PAXIS ', 1, size(bulk%paxis)), &
             spread('PSOLID', 1, size(bulk%psolid)), spread('PROD  ', 1, size(bulk%prod)), bulk%beam_property%name])
         call count_unnamed(pack(springs%id, .not. springs%is_bush), pack(bulk%spring%property, .not. is_bush), &
                            spread('PELAS ', 1, count(.not. springs%is_bush)))
         call count_unnamed(pack(springs%id, springs%is_bush), pack(bulk%spring%property, is_bush), &
                            spread('PBUSH ', 1, count(springs%is_bush)))
         if (size(system) == 0) return
         call count_unnamed(system%id, [system%reference, bulk%force%system, bulk%pressure%system, bulk%gravity%system, &
            bulk%spring%system, bulk%spring%point_system, bulk%mass%system, bulk%grid%cp, bulk%grid%cd], &
            system_names(system%kind + merge(0, 3, system%nodes(1) > 0)))
      end associate

   contains

      !> Add the cards with numbers ID, CALLED so, that are not among NAMES.
      subroutine count_unnamed(id, names, called)
         integer, intent(in)      :: id(:), names(:)
         character(6), intent(in) :: called(:)
         type(id_table_type) :: named
         integer :: i

         call named%build(names)
         do i = 1, size(id)
            if (id(i) > 0 .and. named%find(id(i)) == 0) call bulk%ignored%add(trim(called(i)))
         end do
      end subroutine count_unnamed

   end subroutine count_unused

end module unused_cards
