!> Properties and coordinate systems that nothing uses: they count among the entries without effect.
module unused_cards
   use bulk_data, only: bulk_data_type
   use lists, only: id_table_type
   implicit none
   private

   public :: count_unused

   character(6), parameter :: property_names(4) = ['PSHELL', 'PAXIS ', 'PSOLID', 'PROD  ']
   character(6), parameter :: system_names(3, 2) = reshape(['CORD2R', 'CORD2C', 'CORD2S', 'CORD1R', 'CORD1C', 'CORD1S'], [3, 2])

contains

   !> Add to the entries without effect of BULK its properties and coordinate systems that no other card names.
   subroutine count_unused(bulk)
      type(bulk_data_type), intent(inout) :: bulk
      integer, allocatable :: id(:), named(:), sort(:)
      integer :: i

      associate (pshell => bulk%pshell%id, paxis => bulk%paxis%id, psolid => bulk%psolid%id, prod => bulk%prod%id)
         allocate (id, source=[pshell, paxis, psolid, prod])
         allocate (sort, source=[(1, i = 1, size(pshell)), (2, i = 1, size(paxis)), (3, i = 1, size(psolid)), &
                                 (4, i = 1, size(prod))])
      end associate
      call find_named(id, [bulk%block%property, without_repeats(bulk%element%property), without_repeats(bulk%edge%property)], named)
      do i = 1, size(id)
         if (named(i) == 0 .and. id(i) > 0) call bulk%idle%add(trim(property_names(sort(i))))
      end do
      call count_spring_properties(.false., 'PELAS')
      call count_spring_properties(.true., 'PBUSH')
      if (size(bulk%system) == 0) return
      call find_named(bulk%system%id, [bulk%system%reference, bulk%force%system, bulk%pressure%system, bulk%gravity%system, &
                                       bulk%spring%system, bulk%mass%system, without_repeats(bulk%grid%cp), &
                                       without_repeats(bulk%grid%cd)], named)
      do i = 1, size(named)
         associate (card => bulk%system(i))
            if (named(i) == 0 .and. card%id > 0) call bulk%idle%add(system_names(card%kind, merge(2, 1, card%nodes(1) > 0)))
         end associate
      end do

   contains

      !> PELAS, or PBUSH, which bushes alone name.
      subroutine count_spring_properties(are_bushes, name)
         logical, intent(in)      :: are_bushes
         character(*), intent(in) :: name
         integer, allocatable :: property(:)
         integer :: k

         allocate (property, source=pack(bulk%spring_property%id, bulk%spring_property%is_bush .eqv. are_bushes))
         call find_named(property, pack(bulk%spring%property, bulk%spring%is_bush .eqv. are_bushes), named)
         do k = 1, size(property)
            if (named(k) == 0 .and. property(k) > 0) call bulk%idle%add(name)
         end do
      end subroutine count_spring_properties

   end subroutine count_unused

   !> NAMED(i) > 0 where ID(i) is among NAMES.
   subroutine find_named(id, names, named)
      integer, intent(in)               :: id(:), names(:)
      integer, allocatable, intent(out) :: named(:)
      type(id_table_type) :: table
      integer :: i, k

      call table%build(id)
      allocate (named(size(id)), source=0)
      do i = 1, size(names)
         k = table%find(names(i))
         if (k > 0) named(k) = 1
      end do
   end subroutine find_named

   !> LIST without the entries that repeat the one before: a mesh has long runs of one property.
   pure function without_repeats(list) result(shorter)
      integer, intent(in)  :: list(:)
      integer, allocatable :: shorter(:)
      integer :: i

      shorter = pack(list, [(i == 1 .or. list(max(1, i - 1)) /= list(i), i = 1, size(list))])
   end function without_repeats

end module unused_cards
