# The entries of the card manual as a Fortran module, so that the program has them wherever it stands.
#
#    awk -f card_manual.awk input/README.md > card_manual.f90
#
# An entry is a key of case control (a heading #### in the section on case control) or a card (### in that on bulk data cards);
# the heading may name several, with commas between them. Links are left out.

/^## / {
   key = /[Cc]ase control/ ? "####" : /[Bb]ulk data cards/ ? "###" : ""
   on = 0
   next
}
key != "" && $1 == key {
   n++
   on = 1
   title[n] = substr($0, length(key) + 2)
   next
}
/^###/ { on = 0; next }
on { lines[n, ++length_of[n]] = plain($0) }

END {
   if (n == 0) { print "card_manual.awk: no entries in " FILENAME > "/dev/stderr"; exit 1 }
   print "!> The entries of the card manual, made from it by card_manual.awk."
   print "module card_manual"
   print "   implicit none"
   print "   private"
   print ""
   print "   public :: manual_entry"
   print ""
   print "   character(*), parameter, public :: manual_names = ' '// & !! of all entries"
   for (i = 1; i <= n; i++) print "      '" title[i] " '" (i < n ? "// &" : "")
   print ""
   print "contains"
   print ""
   print "   !> The entries of NAME, capitals, of a key and of a card; empty where there is none."
   print "   function manual_entry(name) result(text)"
   print "      character(*), intent(in)  :: name"
   print "      character(:), allocatable :: text"
   print ""
   print "      text = ''"
   for (i = 1; i <= n; i++) {
      m = split(title[i], words, /, */)
      for (k = 1; k <= m; k++) print "      if (name == '" words[k] "') call entry_" i "(text)"
   }
   print "   end function manual_entry"
   for (i = 1; i <= n; i++) write_entry(i)
   print ""
   print "   subroutine add(text, line)"
   print "      character(:), allocatable, intent(inout) :: text"
   print "      character(*), intent(in) :: line"
   print ""
   print "      text = text//line//new_line('a')"
   print "   end subroutine add"
   print ""
   print "end module card_manual"
}

function write_entry(i,   k, last) {
   last = length_of[i]
   while (last > 1 && lines[i, last] == "") last--
   print ""
   print "   subroutine entry_" i "(text)"
   print "      character(:), allocatable, intent(inout) :: text"
   print ""
   print "      call add(text, '" title[i] "')"
   print "      call add(text, '')"
   for (k = (lines[i, 1] == "" ? 2 : 1); k <= last; k++) print "      call add(text, " quoted(lines[i, k]) ")"
   print "      call add(text, '')"
   print "   end subroutine entry_" i
}

# LINE as a character constant, in pieces that a line of Fortran has room for
function quoted(line,   pieces, piece) {
   pieces = ""
   while (length(line) > 90) {
      piece = substr(line, 1, 90)
      line = substr(line, 91)
      gsub(/'/, "''", piece)
      pieces = pieces "'" piece "'// &\n         "
   }
   gsub(/'/, "''", line)
   return pieces "'" line "'"
}

# LINE without the marks of links
function plain(line,   at, words) {
   while (match(line, /\[[^][]*\]\([^()]*\)/)) {
      at = RSTART
      words = substr(line, at, RLENGTH)
      line = substr(line, 1, at - 1) substr(words, 2, index(words, "](") - 2) substr(line, at + RLENGTH)
   }
   return line
}
