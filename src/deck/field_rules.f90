!> The rules that the table of a card is made of: one a field, with what the field may hold, and the same in words. Of
!! several names a rule makes as many fields alike.
module field_rules
   use kinds, only: wp
   use text_tools, only: integer_text, real_text
   implicit none
   private

   public :: integer_field, real_field, word_field, blank_field, any_field, component_field, in_range, expectation, list_of

   integer, parameter, public :: kind_integer = 1, kind_real = 2, kind_word = 3, kind_blank = 4, kind_components = 5, kind_any = 6

   !> What a field may hold.
   type, public :: field_rule
      character(8)  :: name     = ''           !! as in the card manual
      integer       :: kind     = kind_blank
      logical       :: required = .false.
      real(wp)      :: default  = 0.0_wp       !! of integer and real fields left blank
      real(wp)      :: least    = -huge(1.0_wp)
      real(wp)      :: most     = huge(1.0_wp)
      logical       :: above    = .false.      !! reals: LEAST itself is out
      logical       :: below    = .false.      !! reals: MOST itself is out
      logical       :: whole    = .false.      !! reals: an integer is a number too
      character(48) :: words    = ''           !! of a word field: '|STEP|BACK|', the first is the default
   end type field_rule

contains

   !> Rule for an integer: an id by default (1 and up).
   elemental function integer_field(name, default, least, most) result(rule)
      character(*), intent(in)      :: name
      integer, intent(in), optional :: default !! none: the field must be filled
      integer, intent(in), optional :: least, most
      type(field_rule) :: rule

      rule%name = name
      rule%kind = kind_integer
      rule%required = .not. present(default)
      rule%least = 1.0_wp
      if (present(default)) rule%default = real(default, wp)
      if (present(least)) rule%least = real(least, wp)
      if (present(most)) rule%most = real(most, wp)
   end function integer_field

   !> Rule for a real; ABOVE and BELOW exclude the bound, LEAST and MOST include it.
   elemental function real_field(name, default, above, below, least, most, whole) result(rule)
      character(*), intent(in)       :: name
      real(wp), intent(in), optional :: default !! none: the field must be filled
      real(wp), intent(in), optional :: above, below, least, most
      logical, intent(in), optional  :: whole   !! true: an integer is taken too (default: NASTRAN's rule, it is not)
      type(field_rule) :: rule

      rule%name = name
      rule%kind = kind_real
      rule%required = .not. present(default)
      if (present(default)) rule%default = default
      if (present(least)) rule%least = least
      if (present(most)) rule%most = most
      if (present(above)) rule%least = above
      if (present(below)) rule%most = below
      rule%above = present(above)
      if (present(whole)) rule%whole = whole
      rule%below = present(below)
   end function real_field

   !> Rule for a word out of a list, WORDS = '|ARITH|GEOM|LIST|'; a blank field takes the first.
   elemental function word_field(name, words) result(rule)
      character(*), intent(in) :: name, words
      type(field_rule) :: rule

      rule%name = name
      rule%kind = kind_word
      rule%words = words
   end function word_field

   !> Rule for a list of NASTRAN's components: different digits of 1 to 6.
   elemental function component_field(name, default) result(rule)
      character(*), intent(in)      :: name
      integer, intent(in), optional :: default !! none: the field must be filled
      type(field_rule) :: rule

      rule = integer_field(name, default, least=1, most=654321)
      rule%kind = kind_components
   end function component_field

   !> Rule for a field that must stay blank (NAME says what NASTRAN has there); a zero is a blank too.
   elemental function blank_field(name) result(rule)
      character(*), intent(in) :: name
      type(field_rule) :: rule

      rule%name = name
      rule%kind = kind_blank
   end function blank_field

   !> Rule for a field that is left to the card's own routine, or has no effect whatever stands in it.
   elemental function any_field(name) result(rule)
      character(*), intent(in) :: name
      type(field_rule) :: rule

      rule%name = name
      rule%kind = kind_any
   end function any_field

   !> Whether VALUE keeps to a RULE of integers or reals.
   pure logical function in_range(rule, value)
      type(field_rule), intent(in) :: rule
      real(wp), intent(in)         :: value

      if (rule%kind == kind_components) then
         in_range = is_component_list(nint(value))
         return
      end if
      in_range = value >= rule%least .and. value <= rule%most
      if (rule%above) in_range = in_range .and. value > rule%least
      if (rule%below) in_range = in_range .and. value < rule%most
   end function in_range

   !> What a rule wants, in words.
   pure function expectation(rule) result(words)
      type(field_rule), intent(in) :: rule
      character(:), allocatable    :: words
      logical :: has_least, has_most

      has_least = rule%least > -huge(1.0_wp)
      has_most = rule%most < huge(1.0_wp)
      select case (rule%kind)
      case (kind_integer)
         words = 'an integer'
         if (has_least .and. has_most) then
            words = words//' from '//integer_text(nint(rule%least))//' to '//integer_text(nint(rule%most))
         else if (has_least) then
            words = words//' of '//integer_text(nint(rule%least))//' or more'
         end if
      case (kind_components)
         words = 'a list of components, different digits of 1 to 6'
      case (kind_real)
         words = 'a real number'
         if (has_least) words = words//trim(merge(' above      ', ' of at least', rule%above))//' '//real_text(rule%least)
         if (has_least .and. has_most) words = words//' and'
         if (has_most) words = words//trim(merge(' below  ', ' at most', rule%below))//' '//real_text(rule%most)
      case (kind_word)
         words = 'one of '//list_of(trim(rule%words), ', ')
      case default
         words = 'blank'
      end select
      if (.not. rule%required .and. rule%kind /= kind_blank .and. rule%kind /= kind_word) words = words//', or blank'
   end function expectation

   !> WORDS = '|STEP|BACK|' as a list with this SEPARATOR between them.
   pure function list_of(words, separator) result(list)
      character(*), intent(in)  :: words, separator
      character(:), allocatable :: list
      integer :: i

      list = ''
      do i = 2, len(words) - 1
         if (words(i:i) == '|') then
            list = list//separator
         else
            list = list//words(i:i)
         end if
      end do
   end function list_of

   !> Whether COMPONENTS is a list of NASTRAN's degrees of freedom: different digits of 1 to 6.
   pure logical function is_component_list(components)
      integer, intent(in) :: components
      integer :: rest, digit
      logical :: seen(6)

      seen = .false.
      is_component_list = .false.
      rest = components
      if (rest <= 0) return
      do while (rest > 0)
         digit = modulo(rest, 10)
         if (digit < 1 .or. digit > 6) return
         if (seen(digit)) return
         seen(digit) = .true.
         rest = rest/10
      end do
      is_component_list = .true.
   end function is_component_list

end module field_rules
