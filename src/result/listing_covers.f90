!> The table of the listing about joints whose sides do not match.
module listing_covers
   use interface_operator, only: named_node
   use kinds, only: wp
   use listing_table, only: column, listing_table_type, page_type
   use model_data, only: is_coarser, model_type, whole_share
   use text_tools, only: clean, integer_text
   implicit none
   private

   public :: write_covers

contains

   !> How the sides of joints cover each other that do not match node by node.
   subroutine write_covers(page, model)
      type(page_type), intent(inout) :: page
      type(model_type), intent(in)   :: model
      type(listing_table_type) :: table
      integer :: j, lists(size(model%joints))
      integer, allocatable :: shown(:)

      lists = [(n_lists(model, j), j = 1, size(model%joints))]
      shown = pack([(j, j = 1, size(model%joints))], model%joints%cover%fitted .and. &
                   (lists > 0 .or. model%joints%cover%share < whole_share))
      if (size(shown) == 0) return
      call table%start('JOINTS OF FACES THAT DO NOT MATCH', [column('JOINT', 'i11'), column(['PAIRS', 'LISTS'], 'i9'), &
                       column('SIDE1 COVERED', 'f15.6'), column('FARTHEST APART', 'es17.5', page%labels%length)])
      call table%print_head(page%file)
      do j = 1, size(shown)
         associate (joint => model%joints(shown(j)))
            call table%add([joint%id, joint%last - joint%first + 1 - lists(shown(j)), lists(shown(j))])
            call table%add([joint%cover%share, clean(joint%cover%farthest, 1.0e-9_wp*sqrt(joint%area))])
            call table%print_row(page%file)
         end associate
      end do
      do j = 1, size(shown)
         associate (joint => model%joints(shown(j)))
            if (joint%cover%share < whole_share) call page%file%put('  NOTE: SIDE2 COVERS ONLY A PART OF SIDE1 OF JOINT '// &
               integer_text(joint%id)//'. WHERE IT DOES NOT, THERE IS NO JOINT.')
            if (is_coarser(joint%cover)) call page%file%put('  NOTE: SIDE1 OF JOINT '//integer_text(joint%id)// &
               ' IS COARSER THAN SIDE2. EXCHANGE THEM FOR BETTER STRESSES BESIDE THE JOINT.')
         end associate
      end do
   end subroutine write_covers

   !> How many interface elements of joint J hang on lists of nodes.
   pure integer function n_lists(model, j)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: j
      integer :: i

      n_lists = 0
      do i = model%joints(j)%first, model%joints(j)%last
         if (model%interface(i)%n_1 > 1 .or. named_node(model%interface(i), 2) < 0) n_lists = n_lists + 1
      end do
   end function n_lists

end module listing_covers
