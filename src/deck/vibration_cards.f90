!> Reads the cards of vibration analysis: EIGRL, EIGR, JAMPL, FREQ, FREQ1 to FREQ5 and TABDMP1.
module vibration_cards
   use bulk_data, only: bulk_data_type
   use card_fields, only: card_fields_type
   use field_rules, only: not_negative, positive, real_range
   use kinds, only: wp
   use text_tools, only: integer_text, one_of, real_text
   use tolerances, only: amplitude_tol
   implicit none
   private

   public :: read_eigrl, read_jampl, read_frequencies, read_tabdmp1, find_endt, check_order

   integer, parameter :: most_frequencies = 100000 ! of one FREQ1, and of one mode of a FREQ4
   integer, parameter :: most_amplitudes = 1000    ! of one JAMPL, and increments to one amplitude
   integer, parameter :: list_from = 9             ! data field in which the list of a TABDMP1 begins

contains

   !> EIGRL: the modes between V1 and V2, at most ND of them, scaled by NORM. EIGR: the same with its F1, F2 and ND, whatever its METHOD;
   !! the methods that iterate find at most 3 NE modes without ND. The controls of the methods and of printout have no effect.
   subroutine read_eigrl(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      character(8) :: method, norm
      character(1) :: of
      integer :: estimate

      associate (eigrl => bulk%eigrl(card%i))
         call card%field('SID', eigrl%id)
         of = merge('V', 'F', card%name == 'EIGRL')
         if (of == 'F') call card%word('METHOD', '|LAN|AHOU|AGIV|GIV|MGIV|HOU|MHOU|INV|SINV|UINV|', method)
         call card%field(of//'1', eigrl%lowest, default=0.0_wp)
         call card%field(of//'2', eigrl%highest, positive, default=0.0_wp)
         estimate = 0
         if (of == 'F') call card%field('NE', estimate, default=0, least=0)
         call card%field('ND', eigrl%most, default=0)
         if (of == 'V') call card%skip(['MSGLVL', 'MAXSET', 'SHFSCL'])
         if (of == 'F') call card%skip(['blank', 'blank'])
         call card%word('NORM', one_of(of == 'V', '|MASS|MAX|', '|MASS|MAX|POINT|'), norm)
         eigrl%line = card%line
         if (of == 'V') call read_options(card, norm)
         eigrl%has_lowest = card%given(of//'1')
         eigrl%has_highest = card%given(of//'2') .and. abs(eigrl%highest) > 0.0_wp
         eigrl%unit_mass = norm == 'MASS'
         eigrl%by_point = norm == 'POINT'
         if (of == 'F' .and. eigrl%most == 0 .and. index(method, 'INV') > 0) eigrl%most = 3*estimate
         if (eigrl%has_lowest .and. eigrl%has_highest) call check_range(card, eigrl%lowest, eigrl%highest, of)
      end associate
   end subroutine read_eigrl

   !> The continuations of an EIGRL: controls of the method, KEY=VALUE or a word or number alone, have no effect; NORM=MASS and NORM=MAX
   !! are the NORM of the first line.
   subroutine read_options(card, norm)
      type(card_fields_type), intent(inout) :: card
      character(8), intent(inout)           :: norm
      character(:), allocatable :: option
      integer :: k

      do k = 9, card%n
         option = card%text_at(k)
         if (index(option, 'NORM=') == 1) then
            norm = option(6:)
            if (all(norm /= ['MASS', 'MAX '])) call card%error_at(k, 'NORM: '''//option(6:)//''', expected MASS or MAX')
         else if (index(option, 'V1=') + index(option, 'V2=') + index(option, 'ND=') > 0) then
            call card%error_at(k, ''''//option//''' on a continuation; expected V1, V2 and ND in their fields')
         end if
      end do
   end subroutine read_options

   !> JAMPL: the amplitudes at which BACKBONE follows a mode through its hysteresis loops.
   subroutine read_jampl(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk

      associate (jampl => bulk%jampl(card%i))
         call card%field('SID', jampl%id)
         call card%field('MODE', jampl%mode, default=1)
         call card%field('AMAX', jampl%largest, positive)
         call card%field('N', jampl%n, default=10, most=most_amplitudes)
         call card%field('RATIO', jampl%ratio, real_range(0.0_wp, 1.0_wp, above=.true., below=.true.), default=0.01_wp)
         call card%field('CYCLES', jampl%cycles, default=20, least=0)
         call card%field('INCS', jampl%increments, default=2, most=most_amplitudes)
         call card%field('GID', jampl%node, default=0)
         call card%field('TOL', jampl%tolerance, positive, default=amplitude_tol)
         call card%finish(jampl%line)
      end associate
   end subroutine read_jampl

   !> The range from LOWEST, field NAME1, to HIGHEST, NAME2, must not be empty.
   subroutine check_range(card, lowest, highest, name)
      type(card_fields_type), intent(inout) :: card
      real(wp), intent(in)                  :: lowest, highest
      character(1), intent(in)              :: name

      if (.not. card%is_faulty() .and. lowest >= highest) call card%error(name//'2', real_text(highest)//' is no more than '// &
         name//'1, '//real_text(lowest)//'; expected the end of the range')
   end subroutine check_range

   !> FREQ: a list. FREQ1: the frequencies F1 + k DF, k = 0 to NDF. FREQ2: NF logarithmic intervals from F1 to F2. FREQ3: NEF
   !! frequencies between neighbours among F1, F2 and the modes between them. FREQ4: NFM frequencies, an odd number so that the natural
   !! frequency is one of them, within FSPD of every mode from F1 to F2. FREQ5: multiples of every mode from F1 to F2. A set may have
   !! several cards.
   subroutine read_frequencies(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      character(8) :: kind

      associate (range => bulk%frequency(card%i))
         call card%field('SID', range%set)
         select case (card%name)
         case ('FREQ')
            call read_list(2, 'F', not_negative)
         case ('FREQ1')
            call card%field('F1', range%first, not_negative)
            call card%field('DF', range%step, positive)
            call card%field('NDF', range%n, default=1, most=most_frequencies)
         case ('FREQ2')
            call card%field('F1', range%first, positive)
            call card%field('F2', range%last, positive)
            call card%field('NF', range%n, default=1, most=most_frequencies)
         case ('FREQ3')
            call card%field('F1', range%first, positive)
            call card%field('F2', range%last, positive, default=range%first)
            call card%word('TYPE', '|LINEAR|LOG|', kind)
            range%is_log = kind == 'LOG'
            call card%field('NEF', range%n, default=10, least=2, most=most_frequencies)
            call card%field('CLUSTER', range%cluster, positive, default=1.0_wp)
         case ('FREQ4')
            call card%field('F1', range%first, not_negative, default=0.0_wp)
            call card%field('F2', range%last, positive, default=1.0e20_wp)
            call card%field('FSPD', range%spread, real_range(0.0_wp, 1.0_wp, above=.true., below=.true.), default=0.1_wp)
            call card%field('NFM', range%n, default=3, most=most_frequencies)
            range%n = range%n + modulo(range%n + 1, 2)
         case default
            call card%field('F1', range%first, not_negative, default=0.0_wp)
            call card%field('F2', range%last, positive, default=1.0e20_wp)
            call read_list(4, 'FR', positive)
         end select
         if (.not. allocated(range%list)) call card%finish(range%line)
         range%line = card%line
         if (any(card%name == ['FREQ2', 'FREQ4', 'FREQ5'])) call check_range(card, range%first, range%last, 'F')
         if (card%name == 'FREQ3' .and. range%first > range%last) call check_range(card, range%first, range%last, 'F')
      end associate

   contains

      !> The list of the card: the real numbers NAME in the data fields from FIRST on, in any order, each once.
      subroutine read_list(first, name, within)
         integer, intent(in)          :: first
         character(*), intent(in)     :: name
         type(real_range), intent(in) :: within
         real(wp), allocatable :: list(:)
         real(wp) :: value
         integer  :: k
         logical  :: ok

         allocate (list(0))
         do k = first, card%n
            if (card%text_at(k) == '') cycle
            call card%real_at(k, name, value, ok, within)
            if (ok) list = [pack(list, list < value), value, pack(list, list > value)]
         end do
         if (size(list) == 0 .and. .not. card%is_faulty()) call card%error_at(first, name//': no number')
         call move_alloc(list, bulk%frequency(card%i)%list)
      end subroutine read_list

   end subroutine read_frequencies

   !> TABDMP1: pairs of frequency and damping, ended by ENDT. TYPE is the kind of damping. A pair with SKIP or with two blank
   !! fields does not count.
   subroutine read_tabdmp1(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      character(:), allocatable :: first, second
      real(wp) :: frequency, value
      integer  :: k, last
      logical  :: ok

      associate (table => bulk%tabdmp1(card%i))
         table%line = card%line
         call card%field('TID', table%id)
         call card%word('TYPE', '|G|CRIT|Q|', table%kind)
         call card%blank(['blank', 'blank', 'blank', 'blank', 'blank', 'blank'])
         allocate (table%frequency(0), table%value(0))
         if (card%is_faulty()) return
         call find_endt(card, list_from, last, 'pair of a frequency and its damping')
         if (last > card%n) return
         do k = list_from, last - 1, 2
            first = card%text_at(k)
            second = card%text_at(k + 1)
            if (first == '' .and. (second == '' .or. second == 'ENDT')) cycle
            if (first == 'SKIP' .or. second == 'SKIP') cycle
            call card%real_at(k, 'F', frequency, ok, not_negative, expected='a frequency of 0 or more')
            if (table%kind == 'Q') then
               call card%real_at(k + 1, 'G', value, ok, positive, expected='a real number above 0, the amplification Q')
            else
               call card%real_at(k + 1, 'G', value, ok, not_negative, expected='a real number of at least 0, the damping')
            end if
            table%frequency = [table%frequency, frequency]
            table%value = [table%value, value]
         end do
         call check_order(card, list_from, 'F', table%frequency, table%value)
      end associate
   end subroutine read_tabdmp1

   !> The data field of ENDT, which ends the list of a table that begins in field FIRST; beyond the card: there is none, an error.
   subroutine find_endt(card, first, last, entries)
      type(card_fields_type), intent(inout) :: card
      integer, intent(in)                   :: first
      integer, intent(out)                  :: last
      character(*), intent(in)              :: entries !! of the list, in words
      integer :: k

      last = first
      do while (last <= card%n .and. card%text_at(last) /= 'ENDT')
         last = last + 1
      end do
      if (last > card%n) then
         call card%error_at(card%n, 'ENDT: expected after the last '//entries)
         return
      end if
      do k = last + 1, card%n
         if (card%text_at(k) /= '') call card%error_at(k, ''''//card%text_at(k)//''' after ENDT, where the card must be blank')
      end do
   end subroutine find_endt

   !> Check that the points (X, Y) of a table, whose list begins in data field FIRST, are two or more in ascending or descending order;
   !! descending ones are reversed. At a jump an X, called NAME, may appear twice, but not at the ends.
   subroutine check_order(card, first, name, x, y)
      type(card_fields_type), intent(inout) :: card
      integer, intent(in)                   :: first
      character(1), intent(in)              :: name
      real(wp), allocatable, intent(inout)  :: x(:), y(:)
      character(:), allocatable :: what
      integer :: n

      n = size(x)
      what = one_of(name == 'F', 'frequenc', 'value')
      if (n < 2 .and. .not. card%is_faulty()) call card%error_at(card%n, integer_text(n)//' points, expected two or more')
      if (card%is_faulty()) return
      if (x(1) > x(n)) then
         x = x(n:1:-1)
         y = y(n:1:-1)
      end if
      if (any(x(2:) < x(:n - 1))) then
         call card%error_at(first, name//': the '//what//one_of(name == 'F', 'ies', 's')// &
                            ' are not in order, expected them ascending, or descending')
      else if (x(1) >= x(2) .or. x(n - 1) >= x(n) .or. any(x(3:) <= x(:n - 2))) then
         call card%error_at(first, name//': a '//what//one_of(name == 'F', 'y', '')// &
                            ' occurs twice at an end of the table, or three times')
      end if
   end subroutine check_order

end module vibration_cards
