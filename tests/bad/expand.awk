# Makes the decks of the tables: for each case a deck INTO/NAME.bdf, and INTO/NAME.expected with the exit status and the fragments
# of the message. README.md describes the tables.
#
#     awk -v bases=FOLDER -v into=FOLDER -f expand.awk TABLE...
#
# An ambiguous table is refused with the place, and the case is not made; exit status 1 then.

function refuse(what, where) {
   print (where == "" ? FILENAME ", line " FNR : where) ": " what > "/dev/stderr"
   refused = 1; usable = 0
}

# ---- the base deck: line[0 .. lines], line 0 the comment at its head ----

function open_base(name,   file, text) {
   close_case()
   has_base = 1; lines = 0
   if (name == "none") return
   file = bases "/" name ".bdf"
   for (lines = -1; (getline text < file) > 0;) line[++lines] = text
   close(file)
   if (lines < 0) { has_base = 0; refuse("there is no base deck " file) }
}

# The one line of the base deck that begins with this text, blanks before it ignored; 0 if there is none, or several.
function line_with(text,   i, found, count) {
   sub(/^ +/, "", text)
   for (i = 1; i <= lines; i++) if (index(trimmed(line[i]), text) == 1) { found = i; count++ }
   if (count != 1) refuse((count ? count " lines of the base deck begin" : "no line of the base deck begins") " with '" text "'")
   return count == 1 ? found : 0
}

# The line of the base deck that begins with the most words of this text; 0 if none does, or several with as many.
function line_like(text,   i, words, most, found, count) {
   for (i = 1; i <= lines; i++) {
      words = common_words(text, line[i])
      if (words > most) { most = words; count = 0 }
      if (words && words == most) { found = i; count++ }
   }
   if (count != 1) refuse((count ? count " lines of the base deck begin" : "no line of the base deck begins") " like '" text "'")
   return count == 1 ? found : 0
}

function common_words(a, b,   words_a, words_b, n, m, k) {
   n = split(trimmed(a), words_a, /[ ,]+/); m = split(trimmed(b), words_b, /[ ,]+/)
   for (k = 0; k < n && k < m && words_a[k + 1] "" == words_b[k + 1] "";) k++
   return k
}

function trimmed(text) { sub(/^ +/, "", text); return text }

# ---- a case ----

function open_case(header) {
   close_case()
   case_name = header; sub(/ .*/, "", case_name)
   fault = substr(header, length(case_name) + 1); sub(/^ +/, "", fault)
   first_edit = fault ~ /^([-!$>+]|eol) / ? fault : ""
   if (first_edit != "") fault = case_name
   begun = FILENAME ", line " FNR
   usable = 1; status = ""; fragments = 0; edits = 0; line_end = "\n"
   split("", gone); split("", put)
   if (!has_base) refuse("no base deck above the case '" case_name "'")
   if (case_name in seen) refuse("the case '" case_name "' is given twice, first in " seen[case_name])
   else seen[case_name] = begun
   if (fault == "" && lines) refuse("the case '" case_name "' does not say what its fault is")
   for (place = lines; place > 0 && line[place] ~ /^ENDDATA/;) place--
}

# Takes out the lines of the base deck that a text names, `first line` or `first line ... last line`, or puts a sign before
# them; what is put in from now on stands behind them.
function change(text, sign,   dots, first, last, i) {
   dots = index(text, " ... ")
   first = line_with(dots ? substr(text, 1, dots - 1) : text)
   last = dots ? line_with(substr(text, dots + 5)) : first
   if (!first || !last) return
   if (last < first) refuse("the last line stands above the first")
   for (i = first; i <= last; i++) { take_out(i); if (sign != "") put_in(sign line[i]) }
}

function take_out(i) {
   if (i && i in gone) refuse("line " i + 1 " of the base deck is changed twice")
   gone[i] = 1; place = i; edits++
}

function put_in(text) { put[place] = put[place] decoded(text) line_end; edits++ }

# \t, \r, \n and \xHH stand for a tab, a carriage return, a line feed and the byte HH.
function decoded(text,   out, code) {
   while (match(text, /\\(x[0-9A-F][0-9A-F]|.|$)/)) {
      code = substr(text, RSTART + 1, RLENGTH - 1)
      out = out substr(text, 1, RSTART - 1)
      text = substr(text, RSTART + RLENGTH)
      if (code == "t") out = out "\t"
      else if (code == "r") out = out "\r"
      else if (code == "n") out = out "\n"
      else if (code ~ /^x./) out = out sprintf("%c", 16 * digit(substr(code, 2, 1)) + digit(substr(code, 3, 1)))
      else refuse("'\\" code "' where \\t, \\r, \\n or \\xHH is expected")
   }
   return out text
}

function digit(letter) { return index("0123456789ABCDEF", letter) - 1 }

function expect(text,   part, n, k) {
   n = split(trimmed(text), part, / +\| +/)
   for (k = 1; k <= n; k++) if (part[k] != "") { gsub(/@/, case_name ".bdf", part[k]); expected[++fragments] = part[k] }
}

function close_case(   file, i) {
   if (case_name == "") return
   if (status == "") refuse("the case '" case_name "' has no status", begun)
   else if (!fragments) refuse("the case '" case_name "' has no message", begun)
   if (!edits && lines) refuse("the case '" case_name "' changes nothing in its base deck", begun)
   if (usable) {
      file = into "/" case_name ".bdf"
      printf "%s%s", fault == "" ? "" : "$ " fault line_end, put[0] > file
      for (i = 1; i <= lines; i++) printf "%s%s", (i in gone) ? "" : line[i] line_end, put[i] > file
      close(file)
      file = into "/" case_name ".expected"
      print "status " status > file
      for (i = 1; i <= fragments; i++) print expected[i] > file
      close(file)
   }
   case_name = ""
}

# ---- the lines of a table ----

FNR == 1 { close_case(); has_base = 0 }
/^#/ || /^ *$/ { next }
/^base [a-z0-9_]+$/ { open_base($2); next }
/^[a-z]/ { open_case($0); if (first_edit == "") next; $0 = "   " first_edit }
!/^   [^ ]/ { refuse("a line that is neither a case nor part of one: three blanks expected before what belongs to a case"); next }
case_name == "" { refuse("no case above this line"); next }
{ text = substr($0, 6) }
$1 == "!" { take_out(line_like(text)); put_in(text); next }
$1 == "-" { change(text, ""); next }
$1 == "$" { change(text, "$"); next }
$1 == ">" { place = line_with(text); next }
$1 == "+" { put_in(text); next }
$1 == "eol" { line_end = decoded(substr($0, 8)); edits++; next }
$1 ~ /^[1-4]$/ && status == "" { status = $1; expect(text); next }
$1 == "|" && status != "" { expect(text); next }
{ refuse("a line of a case that begins with none of ! - $ > + eol |, nor with its first status, 1 to 4") }
END { close_case(); exit refused }
