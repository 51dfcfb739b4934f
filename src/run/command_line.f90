!> Reads the command line of jointfem, its options and decks.
module command_line
   use c_library, only: is_regular_file, is_same_file, read_all_bytes, true_path
   use card_manual, only: manual_entry, manual_names
   use terminal, only: command_reader, complain, input_argument, next_option, say, standard_input, version
   use deck_parameters, only: parameter_type
   use field_rules, only: parse_integer
   use parameter_sets, only: read_setting, setting_type, take_row
   use result_page, only: history_ending
   use result_names, only: is_result_ending, listing_ending
   use text_tools, only: one_of, upper
   use vtu_results, only: is_vtu_ending
   implicit none
   private

   public :: read_command_line, is_result_of

   character(*), parameter :: program = 'jointfem', nl = new_line('a')
   character(9), parameter :: help_options(2) = [character(9) :: '--help', '-h'] ! the entry may follow
   character(10), parameter :: options_with_value(9) = [character(10) :: '-o', '--threads', '--watch', '--summary', '--set', &
                                                        '--progress', '--law', help_options]

   character(*), parameter :: help = &
      'usage: jointfem [options] DECK...'//nl// &
      ''//nl// &
      'examples:'//nl// &
      '   jointfem beam.bdf                                  prints the answer, writes the listing beam.out and tables'//nl// &
      '   jointfem -q -o out --summary out/all.csv *.bdf     runs all decks into the folder out, with a table of all runs'//nl// &
      '   jointfem --check beam.bdf                          reports the errors of the deck, solves nothing'//nl// &
      ''//nl// &
      'Solves each deck: a structure with flexible joints, loaded in increments. The deck `-` is read from standard'//nl// &
      'input; its listing goes to standard output. For beam.bdf the program writes beam.out (the listing),'//nl// &
      'beam.joint.csv (every interface element after every increment), beam.stage.csv (the answer of every stage),'//nl// &
      'beam.reaction.csv and, with bolts, beam.bolt.csv; others on request (--help OUTPUT). At the end the answers and the'//nl// &
      'names of the files go to standard output.'//nl// &
      ''//nl// &
      '   -o DIR        folder of the results, made if it is not there (default: the current folder)'//nl// &
      '   --check       read and check the decks without solving them'//nl// &
      '   --joints      print cards for joints where bodies face each other, without solving'//nl// &
      '   -q            do not show progress on the terminal'//nl// &
      '   --progress LINES  a line for each increment to standard error; without it, where standard error is no terminal,'//nl// &
      '                 from the first minute of a run on'//nl// &
      '   --threads N   use at most N threads (default: all cores); the results do not depend on N'//nl// &
      '   --set N=V     replace ${N} in the decks by V; N=V,V,V makes one run for each value, named beam_N=V,'//nl// &
      '                 N=V,V:M=W,W one for each pair, --set F one for each row of the CSV file F below its line of names;'//nl// &
      '                 runs of one deck go on side by side on the cores'//nl// &
      '   --watch N,N   nodes whose displacement and stiffness are added to the answer of every stage; N-M: M against N'//nl// &
      '   --law F       file with the PJOINT, JNORM and JSHEAR of contacts that BCTSET cards of NX define'//nl// &
      '   --summary F   write a table of all runs to the file F, one row for each run, in place of an earlier table'//nl// &
      '   --resume      continue each deck from its restart file, beam.restart: the results are those of an'//nl// &
      '                 uninterrupted run. A deck without a restart file starts from the beginning.'//nl// &
      '   --date        print date and time in the heading of the listing'//nl// &
      '   --times       print the seconds of each phase, operations and memory to standard error'//nl// &
      '   --version     print the version'//nl// &
      '   --help        print this text'//nl// &
      '   --help CARD   print the section of the manual on a card, or on a key of case control'//nl// &
      ''//nl// &
      '`make mpi` builds jointfem_mpi, which also has the solvers PETSC and MUMPS (--help SOLVER) for several'//nl// &
      'processes: mpirun -n 4 jointfem_mpi DECK...'//nl// &
      ''//nl// &
      'exit status: 0 all decks ran, 1 wrong usage or unreadable file, 2 errors in a deck, 3 the structure cannot be'//nl// &
      'solved, 4 output could not be written; of several decks the highest. At status 3, and where it is interrupted, a'//nl// &
      'run keeps the results of its finished stages; beam.out and beam.early then say ENDED EARLY. input/cards.md is the'//nl// &
      'manual of the cards.'

   character(*), parameter :: summary_head = 'deck,status,stages,increments,' ! the first columns of every summary

   !> One deck of the command.
   type, extends(input_argument), public :: deck_argument
      type(parameter_type), allocatable :: parameters(:) !! of --set
      integer :: number = 1, of = 1     !! number of this run, and number of runs of the command
      character(:), allocatable :: base !! base of the names of the results, with folder; empty: standard output
   end type deck_argument

   type, public :: command_type
      logical :: check_only = .false.       !! --check
      logical :: suggest    = .false.       !! --joints
      logical :: quiet      = .false.       !! -q
      logical :: in_lines   = .false.       !! --progress LINES
      logical :: times      = .false.       !! --times
      logical :: dated      = .false.       !! --date
      logical :: resume     = .false.       !! --resume
      integer :: threads    = 0             !! --threads, 0: all cores
      integer :: n_rows     = 1             !! runs of each deck: the combinations of the rows of --set
      character(:), allocatable :: watched  !! --watch: numbers and N-M with commas, empty: none
      character(:), allocatable :: law      !! --law: path of the law of contacts, empty: none
      character(:), allocatable :: summary  !! --summary: path of the table of the batch, empty: none
      character(:), allocatable :: folder   !! -o, with a slash at its end, empty: here
      type(deck_argument), allocatable :: decks(:)
   end type command_type

contains

   !> Read the command. STATUS is the exit status where nothing is left to do, after --help and --version, and after a wrong
   !! command, which has a message on the standard error; otherwise it is -1.
   subroutine read_command_line(command, status)
      type(command_type), intent(out) :: command
      integer, intent(out)            :: status
      type(command_reader) :: reader
      character(:), allocatable :: option, text, value
      type(setting_type), allocatable :: settings(:)
      logical :: is_missing, ok

      command%folder = ''
      command%watched = ''
      command%law = ''
      command%summary = ''
      allocate (settings(0))
      status = 1
      ok = .true.
      do
         call next_option(reader, options_with_value, option, value, is_missing)
         if (is_missing .and. all(option /= help_options)) then
            call complain(program, option//' needs a value')
            return
         end if
         select case (option)
         case ('')
            exit
         case ('--help', '-h')
            text = help
            if (.not. is_missing) text = manual_entry(upper(value))
            if (text == '') call complain(program, 'the manual has no entry '''//upper(value)//'''; it has'//manual_names)
            if (text /= '') call say(text(:verify(text, nl, back=.true.)), status)
            return
         case ('--version')
            call say(program//' '//version, status)
            return
         case ('--check')
            command%check_only = .true.
         case ('--joints')
            command%suggest = .true.
         case ('-q')
            command%quiet = .true.
         case ('--times')
            command%times = .true.
         case ('--date')
            command%dated = .true.
         case ('--resume')
            command%resume = .true.
         case ('-o')
            command%folder = value//'/'
            if (len(value) == 0) command%folder = './'
         case ('--summary')
            command%summary = value
         case ('--law')
            command%law = value
         case ('--set')
            call read_setting(value, settings, text)
            ok = text == ''
            if (.not. ok) call complain(program, text)
         case ('--progress')
            command%in_lines = upper(value) == 'LINES'
            ok = command%in_lines
            if (.not. ok) call complain(program, '--progress '//value//': expected LINES')
         case ('--watch')
            command%watched = value
            ok = value /= '' .and. verify(value, '0123456789-,') == 0
            if (.not. ok) call complain(program, '--watch '//value// &
                                        ': expected node numbers, or N-M for node M against node N, separated by commas')
         case ('--threads')
            call parse_integer(value, command%threads, ok)
            ok = ok .and. command%threads >= 1
            if (.not. ok) call complain(program, '--threads '//value//': expected a number of 1 or more')
         case default
            ok = .false.
            call complain(program, 'unknown option '//option)
         end select
         if (.not. ok) return
      end do
      call plan_runs(reader%files, settings, command, ok)
      if (ok) status = -1
   end subroutine read_command_line

   !> The runs of COMMAND: each of FILES with every combination of rows of SETTINGS. beam.bdf gives beam.out and beam.joint.csv.
   !! No two runs may write the same file, and no result may replace a deck.
   subroutine plan_runs(files, settings, command, ok)
      type(input_argument), intent(in)  :: files(:)
      type(setting_type), intent(in)    :: settings(:)
      type(command_type), intent(inout) :: command
      logical, intent(out)              :: ok
      integer :: dot, first, i, k, n

      ok = .false.
      if (size(files) == 0) then
         call complain(program, 'no deck given')
         return
      end if
      n = product(settings%n_rows)
      command%n_rows = n
      do i = 1, size(files)
         if (files(i)%path /= standard_input .or. (n == 1 .and. .not. command%resume)) cycle
         call complain(program, one_of(command%resume, '--resume: a deck from the standard input has no restart file', &
                                       '--set with several runs: the standard input can be read only once'))
         return
      end do
      allocate (command%decks(size(files)*n))
      do i = 1, size(command%decks)
         associate (deck => command%decks(i))
            deck%path = files((i - 1)/n + 1)%path
            deck%name = files((i - 1)/n + 1)%name
            deck%number = i
            deck%of = size(command%decks)
            call take_row(settings, modulo(i - 1, n), deck%parameters, deck%name, deck%base)
            if (deck%path == standard_input) cycle
            first = index(deck%path, '/', back=.true.) + 1
            dot = index(deck%path, '.', back=.true.)
            if (dot <= first) dot = len(deck%path) + 1
            deck%base = command%folder//deck%path(first:dot - 1)//deck%base
            do k = 1, i - 1
               if (command%decks(k)%base == deck%base) then
                  call complain(program, command%decks(k)%name//' and '//deck%name//' would both write '//deck%base//listing_ending)
                  return
               end if
               if (share_vtu(command%decks(k), deck)) return
               if (share_vtu(deck, command%decks(k))) return
            end do
         end associate
      end do
      do i = 1, size(files)
         do k = 1, size(command%decks)
            if (is_result_of(true_path(files(i)%path), command%decks(k))) then
               call complain(program, 'the results of '//command%decks(k)%name//' would overwrite the deck '//files(i)%name)
               return
            end if
         end do
      end do
      ok = may_write_summary(command)
   end subroutine plan_runs

   !> Whether the file of --summary may be written, with a message where not: it may be new, empty or an earlier summary, but no deck
   !! and no result of the command. (`--summary *.bdf` takes the first deck for the name of the summary.)
   logical function may_write_summary(command)
      type(command_type), intent(in) :: command
      character(:), allocatable :: bytes, path
      integer :: i, slash
      logical :: is_deck, is_result, ok

      may_write_summary = .true.
      if (command%summary == '') return
      slash = index(command%summary, '/', back=.true.)
      path = true_path(command%summary)
      if (.not. is_regular_file(command%summary)) path = true_path(command%summary(:slash)//'.')//'/'//command%summary(slash + 1:)
      do i = 1, size(command%decks)
         is_deck = is_same_file(command%summary, command%decks(i)%path)
         is_result = is_result_of(path, command%decks(i))
         may_write_summary = .not. (is_deck .or. is_result)
         if (may_write_summary) cycle
         call complain(program, '--summary '//command%summary//' would overwrite the deck '//command%decks(i)%name// &
                       ' or a file of its results')
         return
      end do
      if (.not. is_regular_file(command%summary)) return
      call read_all_bytes(command%summary, bytes, ok)
      may_write_summary = ok
      if (ok) may_write_summary = len_trim(bytes) == 0 .or. index(bytes, summary_head) == 1
      if (.not. may_write_summary) call complain(program, '--summary '//command%summary// &
                                                ': the file exists and is no summary; expected a new name, or an earlier summary')
   end function may_write_summary

   !> Whether A and B could both write one VTU file, with a message: with OUTPUT = VTU, stage 1 of A writes A.1.vtu, which the deck
   !! A.1 may write too; likewise A.joint. The decks need not ask for VTU: each run also removes that file as its own of an earlier
   !! run.
   logical function share_vtu(a, b)
      type(deck_argument), intent(in) :: a, b

      share_vtu = .false.
      if (a%base == '' .or. len(b%base) <= len(a%base)) return
      if (b%base(:len(a%base)) /= a%base) return
      share_vtu = is_vtu_ending(b%base(len(a%base) + 1:)//'.vtu')
      if (share_vtu) call complain(program, a%name//' and '//b%name//' could both write '//b%base//'.vtu')
   end function share_vtu

   !> Whether the file with the true path FILE is a result file of DECK under any name.
   logical function is_result_of(file, deck)
      character(*), intent(in)        :: file
      type(deck_argument), intent(in) :: deck
      character(:), allocatable :: base
      integer :: slash

      is_result_of = .false.
      if (deck%base == '') return
      if (file == true_path(deck%base//listing_ending)) is_result_of = .true.
      if (file == true_path(deck%base//history_ending)) is_result_of = .true.
      slash = index(deck%base, '/', back=.true.)
      base = true_path(deck%base(:slash)//'.')//'/'//deck%base(slash + 1:) ! whether or not there is a file
      if (index(file, base) == 1 .and. is_result_ending(file(len(base) + 1:))) is_result_of = .true.
   end function is_result_of

end module command_line
