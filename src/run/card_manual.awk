# The entries of the card manual as a Fortran module, so that the program has them wherever it stands.
#
#    awk -f card_manual.awk input/cards.md > card_manual.f90
#
# An entry is a key of case control (a heading #### in the section on case control) or a card (### in that on bulk data cards);
# the heading may name several, with commas between them. What a terminal shows is plain text: links, fences and other marks are
# left out, paragraphs are filled to 100 columns, the columns of a table stand under each other and wrap where they are too wide.

BEGIN { width = 100 }
/^## / {
   end_block()
   key = /[Cc]ase control/ ? "####" : /[Bb]ulk data cards/ ? "###" : ""
   on = 0
   next
}
key != "" && $1 == key {
   end_block()
   n++
   on = 1
   title[n] = substr($0, length(key) + 2)
   next
}
/^###/ { end_block(); on = 0; next }
!on { next }
/^```/ { end_block(); apart(); fence = !fence; next }
fence { put($0); next }
/^ *\|/ {
   if (!rows) { end_block(); apart() }
   if ($0 !~ /^ *\|[-:]+\|/) row[++rows] = $0
   next
}
/^$/ { end_block(); apart(); next }
/^    / && paragraph == "" { put($0); next }
/^ *(-|[0-9]+\.) / { end_block() }
{
   if (rows) { end_block(); apart() }
   if (paragraph == "") match($0, /^ *((-|[0-9]+\.) )?/)
   if (paragraph == "") hanging = RLENGTH
   text = $0
   if (paragraph != "") sub(/^ +/, "", text)
   paragraph = paragraph (paragraph == "" ? "" : " ") text
}

END {
   end_block()
   if (n == 0) { print "card_manual.awk: no entries in " FILENAME > "/dev/stderr"; exit 1 }
   print "!> The entries of the card manual, made from it by card_manual.awk."
   print "module card_manual"
   print "   implicit none"
   print "   private"
   print ""
   print "   public :: manual_entry"
   print ""
   print "   character(*), parameter, public :: manual_names = & !! of all entries"
   for (i = 1; i <= n; i++) if (!listed[title[i]]++) names = names (i > 1 ? ", " : "   ") title[i]
   m = wrap(names, width, 3)
   for (i = 1; i <= m; i++) print "      new_line('a')//'" wrapped[i] "'" (i < m ? "// &" : "")
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

# One line of the entry
function put(line) { sub(/ +$/, "", line); lines[n, ++length_of[n]] = line }

# One empty line before what follows, but at the beginning
function apart() { if (length_of[n] > 0 && lines[n, length_of[n]] != "") put("") }

# The paragraph or the table that has been read
function end_block(   m, i, piece) {
   if (paragraph != "") {
      m = wrap(plain(paragraph), width, hanging)
      for (i = 1; i <= m; i++) put(wrapped[i])
   }
   if (rows) put_table()
   paragraph = ""
   rows = 0
}

# TEXT in lines of at most LIMIT columns, wrapped[1 ...], all but the first with INDENT blanks in front; returns how many
function wrap(text, limit, indent,   m, at, blanks) {
   m = 0
   blanks = sprintf("%" (indent + 1) "s", "")
   blanks = substr(blanks, 1, indent)
   while (length(text) > limit) {
      for (at = limit + 1; at > indent + 1 && substr(text, at, 1) != " "; at--) ;
      if (at <= indent + 1) { # a word that is too long
         at = index(substr(text, limit + 1), " ")
         if (at == 0) break
         at += limit
      }
      wrapped[++m] = substr(text, 1, at - 1)
      sub(/ +$/, "", wrapped[m])
      text = substr(text, at + 1)
      sub(/^ +/, "", text)
      text = blanks text
   }
   wrapped[++m] = text
   return m
}

# row[1 ... rows]: the columns under each other, the widest ones narrower until a line has room
function put_table(   i, k, m, cells, parts, size, total, widest, high, line, front, piece, tall) {
   cells = 0
   split("", size)
   front = match(row[1], /^ +/) ? substr(row[1], 1, RLENGTH) : ""
   for (i = 1; i <= rows; i++) {
      sub(/^ *\|/, "", row[i])
      sub(/\| *$/, "", row[i])
      m = split(row[i], parts, /\|/)
      if (m > cells) cells = m
      for (k = 1; k <= m; k++) {
         piece = plain(parts[k])
         gsub(/^ +| +$/, "", piece)
         cell[i, k] = piece
         if (length(piece) > size[k]) size[k] = length(piece)
      }
      for (k = m + 1; k <= cells; k++) cell[i, k] = ""
   }
   for (k = 1; k <= cells; k++) if (cell[1, 1] == "1" && size[k] < 6) size[k] = 6 # fields of eight columns, as in the deck below
   for (;;) {
      total = length(front) - 2
      widest = 1
      for (k = 1; k <= cells; k++) {
         total += size[k] + 2
         if (size[k] > size[widest]) widest = k
      }
      if (total <= width || size[widest] <= 16) break
      size[widest]--
   }
   for (i = 1; i <= rows; i++) {
      tall = 1
      for (k = 1; k <= cells; k++) {
         m = wrap(cell[i, k], size[k], 0)
         high[k] = m
         if (m > tall) tall = m
         for (; m >= 1; m--) part[k, m] = wrapped[m]
      }
      for (m = 1; m <= tall; m++) {
         line = front
         for (k = 1; k <= cells; k++) line = line sprintf("%-" (size[k] + (k < cells ? 2 : 0)) "s", m <= high[k] ? part[k, m] : "")
         put(line)
      }
   }
   put("")
}

# LINE without the marks of links, code and emphasis
function plain(line,   at, words, pieces, m, i, out) {
   while (match(line, /\[[^][]*\]\([^()]*\)/)) {
      at = RSTART
      words = substr(line, at, RLENGTH)
      line = substr(line, 1, at - 1) substr(words, 2, index(words, "](") - 2) substr(line, at + RLENGTH)
   }
   m = split(line, pieces, /`/)
   out = ""
   for (i = 1; i <= m; i++) out = out (i % 2 ? upright(pieces[i]) : pieces[i])
   return out
}

# WORDS without the stars of emphasis
function upright(words,   out, at) {
   out = ""
   while (match(words, /\*[A-Za-z][^*]*\*/)) {
      at = RSTART
      out = out substr(words, 1, at - 1) substr(words, at + 1, RLENGTH - 2)
      words = substr(words, at + RLENGTH)
   }
   return out words
}
