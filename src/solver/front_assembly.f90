!> How matrices come into a front: those of elements, of interface elements, and what the elimination of its children leaves.
!! Source: Duff, Reid, ACM Trans. Math. Softw. 9 (1983) 302-325.
module front_assembly
   use front_tree, only: front_tree_type, front_type
   use kinds, only: wp
   use mass_elements, only: coupled_dynamic_stiffness
   use model_data, only: model_type
   use section_coupling, only: coupled_nodes
   implicit none
   private

   public :: add_elements, add_matrix, add_update, place_in

contains

   !> Add the stiffness of the elements of FRONT to its matrix.
   subroutine add_elements(model, tree, front)
      type(model_type), intent(in)      :: model
      type(front_tree_type), intent(in) :: tree
      type(front_type), intent(inout)   :: front
      real(wp), allocatable :: k(:, :)
      integer, allocatable  :: rows(:)
      integer :: e, j

      allocate (rows(0))
      do j = 1, size(front%elements)
         e = front%elements(j)
         call coupled_dynamic_stiffness(model, e, tree%shift, k)
         associate (nodes => coupled_nodes(model, e))
            rows = [tree%number(:, nodes)]
         end associate
         call add_matrix(front, rows, k(:size(rows), :size(rows)))
      end do
   end subroutine add_elements

   !> Add the symmetric matrix K of the EQUATIONS (0: held) to FRONT, of which all of them are rows.
   pure subroutine add_matrix(front, equations, k)
      type(front_type), intent(inout) :: front
      integer, intent(in)             :: equations(:)
      real(wp), intent(in)            :: k(:, :)
      integer :: places(size(equations)), i, j, row, column

      do i = 1, size(equations)
         places(i) = place_in(front, equations(i))
      end do
      do j = 1, size(equations)
         column = places(j)
         if (column == 0) cycle
         front%diagonal(column) = front%diagonal(column) + k(j, j)
         if (column <= front%p) then
            do i = 1, size(equations)
               row = places(i)
               if (row >= column) front%panel(row, column) = front%panel(row, column) + k(i, j)
            end do
         else
            do i = 1, size(equations)
               row = places(i)
               if (row >= column) front%update(row - front%p, column - front%p) = &
                  front%update(row - front%p, column - front%p) + k(i, j)
            end do
         end if
      end do
   end subroutine add_matrix

   !> Row of EQUATION in FRONT, 0 for equation 0.
   pure integer function place_in(front, equation) result(place)
      type(front_type), intent(in) :: front
      integer, intent(in)          :: equation
      integer :: low, high, middle

      place = 0
      if (equation == 0) return
      place = equation - front%first + 1
      if (place <= front%p) return
      low = 1
      high = front%r
      do while (low < high)
         middle = (low + high)/2
         if (front%rows(middle) < equation) then
            low = middle + 1
         else
            high = middle
         end if
      end do
      place = front%p + low
   end function place_in

   !> Add to FRONT what the elimination of CHILD left, of it the columns FROM to UNTIL.
   pure subroutine add_update(child, front, from, until)
      type(front_type), intent(in)    :: child
      type(front_type), intent(inout) :: front
      integer, intent(in)             :: from, until
      integer :: column, first, i, j, k, last, row, this

      this = 1                                       ! the run that column J is in
      do j = from, until
         do while (j >= child%run(this + 1))
            this = this + 1
         end do
         column = child%in_parent(j)
         front%diagonal(column) = front%diagonal(column) + child%diagonal(child%p + j)
         do k = this, size(child%run) - 1
            first = max(j, child%run(k))
            last = child%run(k + 1) - 1
            row = child%in_parent(first)
            if (column <= front%p) then
               !$omp simd
               do i = 0, last - first
                  front%panel(row + i, column) = front%panel(row + i, column) + child%update(first + i, j)
               end do
            else
               row = row - front%p
               !$omp simd
               do i = 0, last - first
                  front%update(row + i, column - front%p) = front%update(row + i, column - front%p) + child%update(first + i, j)
               end do
            end if
         end do
      end do
   end subroutine add_update

end module front_assembly
