!> The face of a solid that has given corners.
module face_search
   use deck_check, only: checked_deck
   use element_kinds, only: element_table
   use model_data, only: model_type
   use text_tools, only: integer_text
   implicit none
   private

   public :: find_face, own_corner

contains

   !> The SIDE of the ELEMENT whose corners have the numbers ID, in either sense; FIELD of the card on LINE names them. Not OK, with
   !! an error, where there is none, or where bodies lie on both sides and forces on their nodes would be those of both.
   subroutine find_face(deck, model, line, field, id, element, side, first, outward, ok)
      type(checked_deck), intent(in) :: deck
      type(model_type), intent(in)   :: model
      integer, intent(in)            :: line
      character(*), intent(in)       :: field
      integer, intent(in)            :: id(:)         !! 3 or 4 corners, going round
      integer, intent(out)           :: element, side
      integer, intent(out)           :: first         !! position of ID(1) on the side
      logical, intent(out)           :: outward, ok   !! the right hand round the corners points out of the element
      integer :: found, i, k, node, s

      found = 0
      node = model%node_table%find(id(1))
      do while (node > 0)
         do i = model%first_at(node), model%first_at(node + 1) - 1
            do s = 1, element_table(model%element_kind(model%elements_at(i)))%n_sides
               call compare_corners(model, model%elements_at(i), s, id, k, outward)
               if (k == 0) cycle
               found = found + 1
               element = model%elements_at(i)
               side = s
               first = k
            end do
         end do
         if (node /= model%node_table%find(id(1))) exit
         node = model%twin(node)
      end do
      ok = found == 1
      if (found == 0) then
         call deck%field_error(line, field, 'no body element has a face with the corners '//list_of_numbers(id))
      else if (found > 1) then
         call deck%field_error(line, field, 'bodies lie on both sides of the face with the corners '//list_of_numbers(id)// &
                               ', so which one the pressure acts on is not known')
      else
         call compare_corners(model, element, side, id, first, outward)
      end if
   end subroutine find_face

   !> FIRST is the position on side S of element E of the corner with the number ID(1) where ID are the corners of the side, else 0.
   pure subroutine compare_corners(model, e, s, id, first, outward)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e, s, id(:)
      integer, intent(out)         :: first
      logical, intent(out)         :: outward
      integer :: k, place(size(id))

      first = 0
      outward = .false.
      associate (kind => element_table(model%element_kind(e)))
         if (kind%dimension /= 3 .or. kind%side_corners(s) /= size(id)) return
         do k = 1, size(id)
            place(k) = findloc(kind%side_nodes(:size(id), s), own_corner(model, e, id(k)), dim=1)
         end do
      end associate
      if (any(place == 0)) return
      if (all(place == cshift([(k, k = 1, size(id))], place(1) - 1))) then
         outward = .true.
      else if (any(place /= cshift([(k, k = size(id), 1, -1)], size(id) - place(1)))) then
         return ! not going round
      end if
      first = place(1)
   end subroutine compare_corners

   !> Which corner of element E node ID is, the twin of a split node too; 0: none.
   pure integer function own_corner(model, e, id) result(corner)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e, id
      integer :: node

      corner = 0
      node = model%node_table%find(id)
      if (node == 0) return
      associate (corners => model%element_nodes(:element_table(model%element_kind(e))%n_corners, e))
         corner = findloc(corners, node, dim=1)
         if (corner == 0 .and. model%twin(node) > 0) corner = findloc(corners, model%twin(node), dim=1)
      end associate
   end function own_corner

   pure function list_of_numbers(id) result(words)
      integer, intent(in)       :: id(:)
      character(:), allocatable :: words
      integer :: k

      words = integer_text(id(1))
      do k = 2, size(id)
         words = words//', '//integer_text(id(k))
      end do
   end function list_of_numbers

end module face_search
