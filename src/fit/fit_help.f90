!> What `jointfit --help` prints.
module fit_help
   implicit none
   private

   public :: help_text

contains

   pure function help_text() result(text)
      character(:), allocatable :: text
      character(*), parameter   :: nl = new_line('a')

      text = &
         'usage: jointfit [options] DATA...'//nl// &
         ''//nl// &
         'Fits the laws of a joint to test data and writes the cards for a deck of jointfem on the standard output,'//nl// &
         'with the residuals as comments. Each file is one surface; `-` is the standard input. A line with the names'//nl// &
         'of the columns, in any order, says what a file holds:'//nl// &
         ''//nl// &
         '   d tau p             points of shear tests: a JSHEAR card'//nl// &
         '   lambda p            points of normal tests: a JNORM card'//nl// &
         '   c1 c2 c3 p branch   cubics tau = c1 d + c2 d^2 + c3 d^3 published for several p: a JSHEAR card'//nl// &
         ''//nl// &
         'Points may have two columns more:'//nl// &
         ''//nl// &
         '   branch   LOAD, UNLOAD or RELOAD: each stretch of rows of one branch and pressure is a run, but rows that'//nl// &
         '            stand in no order share one run'//nl// &
         '   run      the number of the run from one turn to the next: every run of unloading and reloading starts'//nl// &
         '            at a point of its own (b0, c0); without a column branch its direction tells what it is'//nl// &
         ''//nl// &
         'Without both the rows are a record in the order of time, cut where the test turns back by more than the'//nl// &
         'noise of the readings. A way up is reloading to where the loading before it ended (p of a normal test, d of'//nl// &
         'shear), and loading beyond. Loops of a normal test are no part of c and m: their straight lines give EU. A'//nl// &
         'second header line, another pressure of shear, or a reading back at the first one begins a new test.'//nl// &
         ''//nl// &
         'Entries stand between blanks, tabs, commas or semicolons (then 1,5 is 1.5); # and $ begin a comment. Units may'//nl// &
         'stand in the headings, as `lambda [um]; p [MPa]`; `UNITS = ...` is copied to the comments. The cards are in the'//nl// &
         'units of the data, or of --units.'//nl// &
         ''//nl// &
         'the data:'//nl// &
         '   --units L,F       units of length and force of the cards: mm,n or mm,kgf or m,n and so on'//nl// &
         '   --decimal-comma   1,5 is 1.5 also where no semicolons stand'//nl// &
         '   --columns NAMES   the columns, whatever headings the file has; - does not count: -,p [MPa],lambda [um]'//nl// &
         '   --noise X         share of the range of the readings that is noise: smaller turns are none, a first reading'//nl// &
         '                     that is less below zero is an offset (default: found from the record, 0.01 or more)'//nl// &
         '   --zero            take the first reading of each test off all of it'//nl// &
         '   --unordered       rows without a branch stand in no order: all are loading'//nl// &
         ''//nl// &
         'shear:'//nl// &
         '   --joint-fit       the coefficients fitted to all points of a branch at once, instead of the straight lines'//nl// &
         '                     through the coefficients of the cubics of each pressure'//nl// &
         '   --one-pressure    data at one pressure are enough: a card that does not depend on it'//nl// &
         '   --p-tolerance X   pressures within this share of each other count as one (default 0.001)'//nl// &
         '   --branch BRANCH   use only this branch of the data'//nl// &
         '   --as BRANCH       with --branch: as this branch of the card'//nl// &
         '   --dmax X          DMAX of the card, in its units (default: the largest d of the loading data)'//nl// &
         ''//nl// &
         'output:'//nl// &
         '   --id N            id of the first card (default 1), the cards of more files count up'//nl// &
         '   --plot FILE       write data and fit as a script that gnuplot draws as an SVG picture beside it'//nl// &
         '   --large           numbers in fields of 16 columns (default)'//nl// &
         '   --small           numbers in fields of 8 columns'//nl// &
         '   --version         print the version'//nl// &
         '   --help            print this'//nl// &
         ''//nl// &
         'exit status: 0 all cards written, 1 wrong usage or unreadable file, 2 errors in the data, 4 output that'//nl// &
         'cannot be written; of several files the highest.'
   end function help_text

end module fit_help
