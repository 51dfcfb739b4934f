!> Finds properties, coordinate systems and rotations of RBE3 that nothing uses: they are read without effect.
module unused_cards
   use bulk_data, only: bulk_data_type
   use field_rules, only: has_component
   use lists, only: id_table_type
   use mesh_cards, only: system_names
   implicit none
   private

   public :: count_unused

contains

   !> Add the unused properties and coordinate systems of BULK to its entries without effect.
   subroutine count_unused(bulk)
      type(bulk_data_type), intent(inout) :: bulk
      character(6), parameter :: spring_names(4) = ['PELAS ', 'PDAMP ', 'PBUSH ', 'PVISC ']
      logical, allocatable :: is_kind(:)
      integer :: i

      call count_idle_rotations(bulk)
      associate (properties => [bulk%block%property, bulk%element%property, bulk%edge%property], &
                 springs => bulk%spring_property, elements => bulk%spring, system => bulk%system)
         call count_unnamed([bulk%pshell%id, bulk%paxis%id, bulk%psolid%id, bulk%prod%id, bulk%beam_property%id], properties, &
            [bulk%pshell%name, spread('PAXIS ', 1, size(bulk%paxis)), &
             spread('PSOLID', 1, size(bulk%psolid)), spread('PROD  ', 1, size(bulk%prod)), bulk%beam_property%name])
         do i = 1, 4
            is_kind = merge(3, 1, springs%is_bush) + merge(1, 0, springs%is_damper) == i
            call count_unnamed(pack(springs%id, is_kind), &
               pack(elements%property, merge(3, 1, elements%is_bush) + merge(1, 0, elements%is_damper) == i), &
               spread(spring_names(i), 1, count(is_kind)))
         end do
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

   !> Count the RBE3 and RBE3M whose rotations in C have no effect, because some of their nodes belong to no shell, beam or rigid
   !! element.
   subroutine count_idle_rotations(bulk)
      type(bulk_data_type), intent(inout) :: bulk
      type(id_table_type) :: turning
      integer, allocatable :: nodes(:, :)
      integer :: c, i, k

      associate (edge => bulk%edge, plate => bulk%element, rigid => bulk%rigid)
         if (.not. any(rigid%is_mean)) return
         allocate (nodes(4, size(edge) + size(plate) + size(rigid)), source=0)
         do i = 1, size(edge)
            if (any(bulk%beam_property%id == edge(i)%property)) nodes(:2, i) = edge(i)%nodes(:2)
         end do
         do i = 1, size(plate)
            if (any(bulk%pshell%id == plate(i)%property .and. bulk%pshell%bending > 0)) &
               nodes(:, size(edge) + i) = plate(i)%nodes(:4)
         end do
         nodes(1, size(edge) + size(plate) + 1:) = rigid%node
         call turning%build([nodes])
         do i = 1, size(rigid)
            if (.not. rigid(i)%is_mean .or. .not. any([(any(has_component(rigid(i)%directions, c)), c = 4, 6)])) cycle
            if (rigid(i)%surface == 0) then
               if (all([(turning%find(rigid(i)%nodes(k)) > 0, k = 1, size(rigid(i)%nodes))])) cycle
            end if
            call bulk%ignored%add('456 in C of '//merge('RBE3M', 'RBE3 ', rigid(i)%surface > 0))
         end do
      end associate
   end subroutine count_idle_rotations

end module unused_cards
