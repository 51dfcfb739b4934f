!> The part of pFUnit that the unit tests need, for machines without pFUnit: the assertions, and running the tests.
!!
!! `pf_to_fortran.awk` turns a directive such as `@assertEqual(a, b, tolerance=t)` into a call of this module. Operands are real64,
!! default integer or logical of rank 0, 1 or 2, or a character scalar; both of one type and one shape. Trailing blanks of strings
!! do not count (for pFUnit leading ones neither). A comparison with a NaN fails, without a floating-point exception: the tests can
!! run with exceptions trapped.
module funit
   use, intrinsic :: iso_fortran_env, only: output_unit, wp => real64
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_is_nan
   implicit none
   private

   public :: run_test, skip_test, finish_tests, anyExceptions
   public :: operand_of, assert_relation, assertTrue, assertFalse, assertIsNaN, assertIsFinite

   !> A value of any type and shape. Default integers and logicals (1 or 0) are exact as real64.
   type :: operand
      character(:), allocatable :: type_name    !! 'real', 'integer', 'logical' or 'character'
      integer                   :: rank         !! 0, 1 or 2
      integer                   :: extents(2)   !! its shape, 1 beyond its rank
      real(wp),     allocatable :: values(:)    !! in array element order; one zero for a character operand
      character(:), allocatable :: text         !! the value of a character operand, else empty
   end type operand

   interface operand_of
      module procedure real_scalar, real_vector, real_matrix
      module procedure integer_scalar, integer_vector, integer_matrix
      module procedure logical_scalar, logical_vector, logical_matrix, character_scalar
   end interface operand_of

   abstract interface
      subroutine test_routine()
      end subroutine test_routine
   end interface

   integer :: passed_count = 0
   integer :: failed_count = 0
   logical :: current_failed = .false.   ! has an assertion of the current test failed?

contains

   ! ---- Running --------------------------------------------------------------------------------

   !> Run one test: `before`, the test, `after`; nothing more once `before` has failed, as in pFUnit.
   !! The name stands on the screen before the test starts, so that a run that dies shows where.
   subroutine run_test(suite, name, test, before, after)
      character(*), intent(in) :: suite                   !! module of the test
      character(*), intent(in) :: name                    !! the test routine's name
      procedure(test_routine) :: test
      procedure(test_routine), optional :: before, after

      write (output_unit, '(4a)', advance='no') suite, '.', name, ':'
      flush (output_unit)
      current_failed = .false.
      if (present(before)) call before()
      if (.not. current_failed) then
         call test()
         if (present(after)) call after()
      end if
      if (current_failed) then
         failed_count = failed_count + 1
      else
         passed_count = passed_count + 1
         write (output_unit, '(a)') ' ok'
      end if
   end subroutine run_test

   !> Report a test that carries `@disable`. It counts neither as passed nor as failed.
   subroutine skip_test(suite, name)
      character(*), intent(in) :: suite, name   !! module and name of the test

      write (output_unit, '(4a)') suite, '.', name, ': disabled'
   end subroutine skip_test

   !> Print the closing line and end the program, with status 1 if a test failed or none ran.
   subroutine finish_tests()
      write (output_unit, '(i0, a, i0, a)') passed_count, ' passed, ', failed_count, ' failed'
      flush (output_unit)
      if (failed_count > 0 .or. passed_count == 0) stop 1, quiet=.true.
      stop, quiet=.true.
   end subroutine finish_tests

   !> Has an assertion of the current test failed? The routine that holds the assertion then returns.
   logical function anyExceptions()
      anyExceptions = current_failed
   end function anyExceptions

   !> Print one failed assertion, below the name of its test.
   subroutine record_failure(what, message, location, expected, actual)
      character(*), intent(in)           :: what               !! the directive and circumstances
      character(*), intent(in), optional :: message            !! the test's own words
      character(*), intent(in)           :: location           !! file:line of the directive
      character(*), intent(in)           :: expected, actual   !! the two operands, or their types or shapes

      logical :: ordered

      if (.not. current_failed) write (output_unit, '(a)') ' FAILED'
      current_failed = .true.
      write (output_unit, '(3x, 3a)') location, ': ', what
      if (present(message)) write (output_unit, '(6x, a)') trim(message)
      ordered = index(what, 'Less') > 0 .or. index(what, 'Greater') > 0
      write (output_unit, '(6x, 2a)') merge('lhs:      ', 'expected: ', ordered), expected
      write (output_unit, '(6x, 2a)') merge('rhs:      ', 'actual:   ', ordered), actual
   end subroutine record_failure

   ! ---- Assertions -----------------------------------------------------------------------------

   !> The directives with two operands, by name. Type and shape must agree; then every element must hold:
   !!
   !!     assertEqual                a = b, or |b - a| <= tolerance     a expected, b actual
   !!     assertNotEqual             |b - a| > tolerance                a expected, b actual
   !!     assertRelativelyEqual      |b - a| <= tolerance |a|, a /= 0   a expected, b actual
   !!     assertLessThan(OrEqual)    a < (<=) b + tolerance             a lhs, b rhs
   !!     assertGreaterThan(OrEqual) a > (>=) b - tolerance             a lhs, b rhs
   subroutine assert_relation(name, a, b, tolerance, message, location)
      character(*),  intent(in)           :: name        !! the directive
      type(operand), intent(in)           :: a, b        !! the two operands in the order of the directive
      real(wp),      intent(in), optional :: tolerance   !! for real operands, >= 0; 0 if absent
      character(*),  intent(in), optional :: message     !! printed with a failure
      character(*),  intent(in)           :: location    !! file:line of the directive

      real(wp) :: margin
      integer :: i

      margin = 0
      if (present(tolerance)) margin = tolerance
      if (a%type_name /= b%type_name) then
         call record_failure(name//', operands of two types', message, location, a%type_name, b%type_name)
      else if (present(tolerance) .and. a%type_name /= 'real') then
         call record_failure(name//', tolerance without real operands', message, location, a%type_name, b%type_name)
      else if (.not. has_relation(a%type_name, name)) then
         call record_failure(name//' is not for this type', message, location, a%type_name, b%type_name)
      else if (a%text /= b%text) then
         call record_failure(name, message, location, '"'//a%text//'"', '"'//b%text//'"')
      else if (a%rank /= b%rank .or. any(a%extents /= b%extents)) then
         call record_failure(name//', shapes differ', message, location, shape_of(a), shape_of(b))
      else
         do i = 1, size(a%values)
            if (holds(name, a%values(i), b%values(i), margin)) cycle
            call record_failure(name//place(a, i)//allowance(tolerance), message, location, &
                                shown(a%type_name, a%values(i)), shown(b%type_name, b%values(i)))
            return
         end do
      end if
   end subroutine assert_relation

   !> Has this type the relation? Strings have equality, logicals also its opposite.
   pure logical function has_relation(type_name, name)
      character(*), intent(in) :: type_name, name

      has_relation = .true.
      if (type_name == 'character') has_relation = name == 'assertEqual'
      if (type_name == 'logical') has_relation = name == 'assertEqual' .or. name == 'assertNotEqual'
   end function has_relation

   !> Does the relation hold for one element? Never for a NaN, in an operand or in the tolerance.
   pure logical function holds(name, a, b, margin)
      character(*), intent(in) :: name
      real(wp),     intent(in) :: a, b, margin

      logical :: same, finite

      holds = .false.
      if (ieee_is_nan(a) .or. ieee_is_nan(b) .or. ieee_is_nan(margin)) return
      same = a <= b .and. a >= b   ! decides between infinities, whose difference would be a NaN
      finite = ieee_is_finite(a) .and. ieee_is_finite(b)
      select case (name)
      case ('assertEqual')
         holds = same
         if (finite .and. .not. same) holds = abs(b - a) <= margin
      case ('assertNotEqual')
         holds = .not. same
         if (finite .and. .not. same) holds = abs(b - a) > margin
      case ('assertRelativelyEqual')
         if (finite .and. abs(a) > 0) holds = abs(b - a) <= margin*abs(a)
      case ('assertLessThan')
         holds = a < b + margin
      case ('assertLessThanOrEqual')
         holds = a <= b + margin
      case ('assertGreaterThan')
         holds = a > b - margin
      case ('assertGreaterThanOrEqual')
         holds = a >= b - margin
      end select
   end function holds

   !> The condition is true. (The translator reduces a vector of conditions by `all`.)
   subroutine assertTrue(condition, message, location)
      logical,      intent(in)           :: condition
      character(*), intent(in), optional :: message
      character(*), intent(in)           :: location

      if (.not. condition) call record_failure('assertTrue', message, location, 'true', 'false')
   end subroutine assertTrue

   !> The condition is false. (The translator reduces a vector of conditions by `any`.)
   subroutine assertFalse(condition, message, location)
      logical,      intent(in)           :: condition
      character(*), intent(in), optional :: message
      character(*), intent(in)           :: location

      if (condition) call record_failure('assertFalse', message, location, 'false', 'true')
   end subroutine assertFalse

   !> x is a NaN.
   subroutine assertIsNaN(x, message, location)
      real(wp),     intent(in)           :: x
      character(*), intent(in), optional :: message
      character(*), intent(in)           :: location

      if (.not. ieee_is_nan(x)) call record_failure('assertIsNaN', message, location, 'NaN', shown('real', x))
   end subroutine assertIsNaN

   !> x is neither infinite nor a NaN.
   subroutine assertIsFinite(x, message, location)
      real(wp),     intent(in)           :: x
      character(*), intent(in), optional :: message
      character(*), intent(in)           :: location

      if (.not. ieee_is_finite(x)) call record_failure('assertIsFinite', message, location, 'finite', shown('real', x))
   end subroutine assertIsFinite

   ! ---- Text of a failure ----------------------------------------------------------------------

   !> A value, in the form of its type.
   pure function shown(type_name, value) result(text)
      character(*), intent(in) :: type_name
      real(wp),     intent(in) :: value
      character(:), allocatable :: text

      character(len=40) :: buffer

      select case (type_name)
      case ('integer')
         write (buffer, '(i0)') nint(value)
      case ('logical')
         buffer = merge('true ', 'false', value > 0)
      case default
         write (buffer, '(g0)') value
      end select
      text = trim(buffer)
   end function shown

   !> The shape of an operand: (3, 2).
   pure function shape_of(a) result(text)
      type(operand), intent(in) :: a
      character(:), allocatable :: text

      text = 'scalar'
      if (a%rank > 0) text = listed(a%extents(:a%rank))
   end function shape_of

   !> Where element number i, in array element order, stands in an operand; nothing for a scalar.
   pure function place(a, i) result(text)
      type(operand), intent(in) :: a
      integer,       intent(in) :: i
      character(:), allocatable :: text

      text = ''
      if (a%rank == 1) text = ', element '//listed([i])
      if (a%rank == 2) text = ', element '//listed([modulo(i - 1, a%extents(1)) + 1, (i - 1)/a%extents(1) + 1])
   end function place

   !> Integers in parentheses.
   pure function listed(numbers) result(text)
      integer, intent(in) :: numbers(:)
      character(:), allocatable :: text

      character(len=40) :: buffer

      write (buffer, '("(", *(i0, :, ", "))') numbers
      text = trim(buffer)//')'
   end function listed

   !> The tolerance, where there is one.
   pure function allowance(tolerance) result(text)
      real(wp), intent(in), optional :: tolerance
      character(:), allocatable :: text

      text = ''
      if (present(tolerance)) text = ', tolerance '//shown('real', tolerance)
   end function allowance

   ! ---- Operands -------------------------------------------------------------------------------

   pure type(operand) function real_scalar(x)
      real(wp), intent(in) :: x
      real_scalar = operand('real', 0, [1, 1], [x], '')
   end function real_scalar

   pure type(operand) function real_vector(x)
      real(wp), intent(in) :: x(:)
      real_vector = operand('real', 1, [size(x), 1], [x], '') ! [x]: a strided section is copied rightly
   end function real_vector

   pure type(operand) function real_matrix(x)
      real(wp), intent(in) :: x(:, :)
      real_matrix = operand('real', 2, shape(x), reshape(x, [size(x)]), '')
   end function real_matrix

   pure type(operand) function integer_scalar(x)
      integer, intent(in) :: x
      integer_scalar = operand('integer', 0, [1, 1], [real(x, wp)], '')
   end function integer_scalar

   pure type(operand) function integer_vector(x)
      integer, intent(in) :: x(:)
      integer_vector = operand('integer', 1, [size(x), 1], real(x, wp), '')
   end function integer_vector

   pure type(operand) function integer_matrix(x)
      integer, intent(in) :: x(:, :)
      integer_matrix = operand('integer', 2, shape(x), reshape(real(x, wp), [size(x)]), '')
   end function integer_matrix

   pure type(operand) function logical_scalar(x)
      logical, intent(in) :: x
      logical_scalar = operand('logical', 0, [1, 1], [merge(1.0_wp, 0.0_wp, x)], '')
   end function logical_scalar

   pure type(operand) function logical_vector(x)
      logical, intent(in) :: x(:)
      logical_vector = operand('logical', 1, [size(x), 1], merge(1.0_wp, 0.0_wp, x), '')
   end function logical_vector

   pure type(operand) function logical_matrix(x)
      logical, intent(in) :: x(:, :)
      logical_matrix = operand('logical', 2, shape(x), reshape(merge(1.0_wp, 0.0_wp, x), [size(x)]), '')
   end function logical_matrix

   pure type(operand) function character_scalar(x)
      character(*), intent(in) :: x
      character_scalar = operand('character', 0, [1, 1], [0.0_wp], x)
   end function character_scalar

end module funit
