!> The face of a solid that has given corners.
module face_search
   use deck_check, only: checked_deck
   use element_kinds, only: element_table
   use model_data, only: model_type
   use text_tools, only: integer_text
   implicit none
   private

   public :: find_face, own_corner

   !> A face, and how corners that name it go round it.
   type, public :: named_face
      integer :: element = 0, side = 0       !! 0: there is no such face
      integer :: first = 0                   !! position of the first corner on the side
      logical :: outward = .false.           !! the right hand round the corners points out of the element
   end type named_face

contains

   !> The FACE whose corners have the numbers ID, in either sense; FIELD of the card on LINE names them. None, with an error, where
   !! there is none, or where bodies lie on both sides and forces on their nodes would be those of both.
   subroutine find_face(deck, model, line, field, id, face)
      type(checked_deck), intent(in) :: deck
      type(model_type), intent(in)   :: model
      integer, intent(in)            :: line
      character(*), intent(in)       :: field
      integer, intent(in)            :: id(:)         !! 3 or 4 corners, going round
      type(named_face), intent(out)  :: face
      type(named_face) :: tried
      integer :: found, i, node, s

      found = 0
      node = model%node_table%find(id(1))
      do while (node > 0)
         do i = model%first_at(node), model%first_at(node + 1) - 1
            do s = 1, element_table(model%element_kind(model%elements_at(i)))%n_sides
               call compare_corners(model, model%elements_at(i), s, id, tried)
               if (tried%element == 0) cycle
               found = found + 1
               face = tried
            end do
         end do
         if (node /= model%node_table%find(id(1))) exit
         node = model%twin(node)
      end do
      if (found == 0) then
         call deck%field_error(line, field, 'no body element has a face with the corners '//list_of_numbers(id))
      else if (found > 1) then
         call deck%field_error(line, field, 'bodies lie on both sides of the face with the corners '//list_of_numbers(id)// &
                               ', so which one the pressure acts on is not known')
         face = named_face()
      end if
   end subroutine find_face

   !> Side S of element E where ID are its corners, else none.
   pure subroutine compare_corners(model, e, s, id, face)
      type(model_type), intent(in)  :: model
      integer, intent(in)           :: e, s, id(:)
      type(named_face), intent(out) :: face
      integer :: k, place(size(id))
      logical :: outward

      associate (kind => element_table(model%element_kind(e)))
         if (kind%dimension /= 3 .or. kind%side_corners(s) /= size(id)) return
         do k = 1, size(id)
            place(k) = findloc(kind%side_nodes(:size(id), s), own_corner(model, e, id(k)), dim=1)
         end do
      end associate
      if (any(place == 0)) return
      outward = all(place == cshift([(k, k = 1, size(id))], place(1) - 1))
      if (.not. outward .and. any(place /= cshift([(k, k = size(id), 1, -1)], size(id) - place(1)))) return ! not going round
      face = named_face(e, s, place(1), outward)
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
