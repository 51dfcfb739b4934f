!> The equations of interface elements: numbers, weights and assembled stiffness matrices. The matrix of an element has the
!! blocks s_a s_b [k] for nodes a and b with weights s, and [M_a]^T [k] [M_b] for coupled nodes with maps M.
module interface_equations
   use interface_operator, only: interface_element
   use kinds, only: wp
   implicit none
   private

   public :: list_interface_equations, add_products

   type, public :: interface_equations_type
      integer :: n = 0                               !! interface elements
      integer, allocatable, private  :: first(:)     ! (n + 1) the nodes of element i are first(i) to first(i + 1) - 1
      integer, allocatable, private  :: equation(:, :) ! (dimension, all nodes of all elements), 0: held
      real(wp), allocatable, private :: weight(:)
      logical, allocatable, private  :: is_mapped(:) ! (n) coupled by maps, not by weights
      real(wp), allocatable, private :: map(:, :, :) ! (dimension, dimension, all nodes of all elements), if any is mapped
   contains
      procedure :: rows_of, matrix_of
   end type interface_equations_type

contains

   !> List the equations of all ELEMENTS. NUMBER gives the equation of each component.
   pure subroutine list_interface_equations(elements, number, equations)
      type(interface_element), intent(in)         :: elements(:)
      integer, intent(in)                         :: number(:, :) !! (dimension, n_nodes), 0: held
      type(interface_equations_type), intent(out) :: equations
      integer :: i, last, n

      equations%n = size(elements)
      allocate (equations%first(equations%n + 1))
      equations%first(1) = 1
      do i = 1, equations%n
         equations%first(i + 1) = equations%first(i) + size(elements(i)%node)
      end do
      n = equations%first(equations%n + 1) - 1
      allocate (equations%equation(size(number, 1), n), equations%weight(n), equations%is_mapped(equations%n))
      equations%is_mapped = [(allocated(elements(i)%map), i = 1, equations%n)]
      if (any(equations%is_mapped)) allocate (equations%map(size(number, 1), size(number, 1), n), source=0.0_wp)
      do i = 1, equations%n
         last = equations%first(i + 1) - 1
         equations%equation(:, equations%first(i):last) = number(:, elements(i)%node)
         if (equations%is_mapped(i)) then
            equations%map(:, :, equations%first(i):last) = elements(i)%map
         else
            equations%weight(equations%first(i):last) = elements(i)%weight
         end if
      end do
   end subroutine list_interface_equations

   !> The equations of element I, 0 for held components: components of the first node, of the next, ...
   pure function rows_of(self, i) result(rows)
      class(interface_equations_type), intent(in) :: self
      integer, intent(in)                         :: i
      integer, allocatable :: rows(:)

      associate (first => self%first(i), last => self%first(i + 1) - 1)
         rows = reshape(self%equation(:, first:last), [size(self%equation, 1)*(last - first + 1)])
      end associate
   end function rows_of

   !> Stiffness of element I between the equations rows_of, from the stiffness K between its ends.
   pure function matrix_of(self, i, k) result(matrix)
      class(interface_equations_type), intent(in) :: self
      integer, intent(in)                         :: i
      real(wp), intent(in)                        :: k(3, 3) !! global axes [force/length]
      real(wp), allocatable :: matrix(:, :)
      integer :: a, b, d, n

      d = size(self%equation, 1)
      n = self%first(i + 1) - self%first(i)
      allocate (matrix(d*n, d*n))
      if (self%is_mapped(i)) then
         associate (maps => reshape(self%map(:, :, self%first(i):self%first(i + 1) - 1), [d, d*n]))
            matrix = matmul(transpose(maps), matmul(k(:d, :d), maps))
         end associate
         return
      end if
      associate (s => self%weight(self%first(i):self%first(i + 1) - 1))
         do b = 1, n
            do a = 1, n
               matrix(d*(a - 1) + 1:d*a, d*(b - 1) + 1:d*b) = s(a)*s(b)*k(:d, :d)
            end do
         end do
      end associate
   end function matrix_of

   !> Y = Y + sum of [k_int] X over all elements, with the stiffnesses K between their ends.
   pure subroutine add_products(equations, k, x, y)
      type(interface_equations_type), intent(in) :: equations
      real(wp), intent(in)                       :: k(:, :, :) !! (3, 3, n) global axes [force/length]
      real(wp), intent(in)                       :: x(:)       !! by equation [length]
      real(wp), intent(inout)                    :: y(:)       !! likewise [force]
      real(wp) :: between(3), force(3)
      integer  :: a, c, d, e, i

      d = size(equations%equation, 1)
      do i = 1, equations%n
         between = 0.0_wp
         do a = equations%first(i), equations%first(i + 1) - 1
            do c = 1, d
               e = equations%equation(c, a)
               if (e == 0) cycle
               if (equations%is_mapped(i)) then
                  between(:d) = between(:d) + equations%map(:, c, a)*x(e)
               else
                  between(c) = between(c) + equations%weight(a)*x(e)
               end if
            end do
         end do
         force(:d) = matmul(k(:d, :d, i), between(:d))
         do a = equations%first(i), equations%first(i + 1) - 1
            do c = 1, d
               e = equations%equation(c, a)
               if (e == 0) cycle
               if (equations%is_mapped(i)) then
                  y(e) = y(e) + dot_product(equations%map(:, c, a), force(:d))
               else
                  y(e) = y(e) + equations%weight(a)*force(c)
               end if
            end do
         end do
      end do
   end subroutine add_products

end module interface_equations
