!> Numbers given twice, and properties whose parts are missing, among the cards that are few.
module id_checks
   use deck_cards, only: add_field_error
   use deck_errors, only: deck_error_list
   use deck_input, only: deck_type
   use deck_text, only: deck_text_type
   use id_table, only: id_table_type
   use text_tools, only: integer_text
   implicit none
   private

   public :: check_ids

contains

   !> Every id of its kind once; properties and PMARK share theirs, as properties do in NASTRAN.
   subroutine check_ids(deck, errors)
      type(deck_type), intent(in)          :: deck
      type(deck_error_list), intent(inout) :: errors
      integer :: direction, i

      associate (bulk => deck%bulk, text => deck%text)
         call check_kind(text, 'property', 'PID', [bulk%pshell(:bulk%n_pshell)%id, bulk%paxis(:bulk%n_paxis)%id, &
                         bulk%psolid(:bulk%n_psolid)%id, bulk%prod(:bulk%n_prod)%id, bulk%pmark(:bulk%n_pmark)%id], &
                         [bulk%pshell(:bulk%n_pshell)%line, bulk%paxis(:bulk%n_paxis)%line, &
                         bulk%psolid(:bulk%n_psolid)%line, bulk%prod(:bulk%n_prod)%line, bulk%pmark(:bulk%n_pmark)%line], errors)
         call check_kind(text, 'MAT1', 'MID', bulk%mat1(:bulk%n_mat1)%id, bulk%mat1(:bulk%n_mat1)%line, errors)
         call check_kind(text, 'LOAD', 'SID', bulk%load(:bulk%n_load)%set, bulk%load(:bulk%n_load)%line, errors)
         call check_kind(text, 'BLOCK2', 'BID', bulk%block2(:bulk%n_block2)%id, bulk%block2(:bulk%n_block2)%line, errors)
         call check_kind(text, 'BLOCK3', 'BID', bulk%block3(:bulk%n_block3)%id, bulk%block3(:bulk%n_block3)%line, errors)
         call check_kind(text, 'BOLT', 'BID', bulk%bolt(:bulk%n_bolt)%id, bulk%bolt(:bulk%n_bolt)%line, errors)
         call check_kind(text, 'JOINT', 'JID', bulk%joint(:bulk%n_joint)%id, bulk%joint(:bulk%n_joint)%line, errors)
         call check_kind(text, 'PJOINT', 'PJID', bulk%pjoint(:bulk%n_pjoint)%id, bulk%pjoint(:bulk%n_pjoint)%line, errors)
         call check_kind(text, 'JNORM', 'NID', bulk%jnorm(:bulk%n_jnorm)%id, bulk%jnorm(:bulk%n_jnorm)%line, errors)
         call check_kind(text, 'JSHEAR', 'SID', bulk%jshear(:bulk%n_jshear)%id, bulk%jshear(:bulk%n_jshear)%line, errors)
         call check_kind(text, 'JINCR', 'SID', bulk%jincr(:bulk%n_jincr)%id, bulk%jincr(:bulk%n_jincr)%line, errors)
         do i = 1, bulk%n_pjoint
            do direction = 1, 2
               if (bulk%pjoint(i)%shear_laws(direction) == 0) cycle
               if (.not. any(bulk%jshear(:bulk%n_jshear)%id == bulk%pjoint(i)%shear_laws(direction))) call add_field_error( &
                  text, bulk%pjoint(i)%line, direction + 2, merge('SIDX', 'SIDY', direction == 1), 'there is no JSHEAR '// &
                  integer_text(bulk%pjoint(i)%shear_laws(direction)), errors)
            end do
            if (bulk%pjoint(i)%normal_law == 0) cycle
            if (.not. any(bulk%jnorm(:bulk%n_jnorm)%id == bulk%pjoint(i)%normal_law)) call add_field_error(text, &
               bulk%pjoint(i)%line, 2, 'NID', 'there is no JNORM '//integer_text(bulk%pjoint(i)%normal_law), errors)
         end do
      end associate
   end subroutine check_ids


   subroutine check_kind(text, kind, field, id, line, errors)
      type(deck_text_type), intent(in)     :: text
      character(*), intent(in)             :: kind, field
      integer, intent(in)                  :: id(:), line(:)
      type(deck_error_list), intent(inout) :: errors
      type(id_table_type)  :: table
      integer, allocatable :: again(:)
      integer :: k

      call table%build(id)
      call table%list_repeated(again)
      do k = 1, size(again)
         if (id(again(k)) == 0) cycle ! a field that could not be read
         call add_field_error(text, line(again(k)), 1, field, kind//' '//integer_text(id(again(k)))// &
                              ' is given twice, first in '//text%place(line(table%find(id(again(k))))), errors)
      end do
   end subroutine check_kind

end module id_checks
