# Lists single changes of Fortran sources, one line for each that is drawn.
#
#    awk -v n=150 -v seed=1 [-v equivalent=FILE] -f mutate.awk src/*/*.f90      n=0: all of them
#
# A line holds, between tabs, its place in the draw, file, line number, kind of change, the old line and the new line. Only
# executable statements of procedures are changed, so no interface of a module; never texts in quotes and comments. The draw depends
# on the seed and on each line itself: an unchanged line keeps its place in the draw. Lines of EQUIVALENT (README.md) are not drawn.

BEGIN {
   FS = "\n"
   for (k = 32; k < 127; k++) code_of[sprintf("%c", k)] = k
   while (equivalent != "" && (getline entry < equivalent) > 0) {
      if (entry ~ /^ *(#|$)/) continue
      if (split(entry, part, / *\| */) < 4) { print equivalent ": not FILE | WAS | IS | WHY: " entry > "/dev/stderr"; bad = 1; exit 1 }
      same[squeezed(part[1]) "|" squeezed(part[2]) "|" squeezed(part[3])] = 1
   }
}

FNR == 1 { executes = 0; declares = 0; continued = 0 }

{
   whole = $0
   code = masked(whole)
   if (code ~ /^ *contains *$/) { executes = 1; next }
   if (!executes || code ~ /^ *$/) next
   was_continued = continued
   continued = code ~ /& *$/
   if (!was_continued) declares = is_declaration(code)
   if (declares && !(code ~ /parameter/ && code ~ /=/)) next
   from = declares ? index(code, "::") + index(substr(code, index(code, "::")), "=") : 1
   delete seen
   operators()
   if (declares) next
   indices()
   if (!was_continued && !continued) statements()
}

END { if (bad) exit 1 }

# ---- what a line may become ----------------------------------------------------------------------

# One character or constant after the other, from column FROM.
function operators(    p, c, two, before, at, text) {
   for (p = from; p <= length(code); p++) {
      c = substr(code, p, 1)
      two = substr(code, p, 2)
      before = last_of(substr(code, 1, p - 1))
      if (c ~ /[a-z_]/ || c == "%") {                                  # a name: its digits are no constants
         while (substr(code, p + 1, 1) ~ /[a-z0-9_%]/) p++
         continue
      }
      if (c ~ /[0-9]/) {
         text = constant(substr(code, p))
         change(p, length(text), other_constant(text), "constant")
         p += length(text) - 1
      } else if (c == ".") {
         if (match(substr(code, p), /^\.and\./)) change(p, 5, ".or.", "and, or")
         else if (match(substr(code, p), /^\.or\./)) change(p, 4, ".and.", "and, or")
         else if (match(substr(code, p), /^\.not\. */)) { at = RLENGTH; change(p, at, "", "not"); p += at - 1; continue }
         else if (match(substr(code, p), /^\.true\./)) change(p, 6, ".false.", "constant")
         else if (match(substr(code, p), /^\.false\./)) change(p, 7, ".true.", "constant")
         else continue
         at = index(substr(code, p + 1), ".")
         p += at
      }
      else if (two == "**") { change(p, 2, "*", "times, divide"); p++ }
      else if (two == "//" || two == "=>" || two == "(/" || two == "/)") p++
      else if (two == "<=" || two == ">=") { change(p, 2, c, "bound of a comparison"); p++ }
      else if (two == "==") { change(p, 2, "/=", "comparison"); p++ }
      else if (two == "/=") { change(p, 2, "==", "comparison"); p++ }
      else if (c == "<" || c == ">") change(p, 1, c "=", "bound of a comparison")
      else if (c == "+" && before ~ /[a-z0-9_)\]]/) change(p, 1, "-", "plus, minus")
      else if (c == "-" && before ~ /[a-z0-9_)\]]/) change(p, 1, "+", "plus, minus")
      else if (c == "-") change(p, 1, "", "sign of a term")
      else if (c == "*" && before ~ /[a-z0-9_)\]]/) change(p, 1, "/", "times, divide")
      else if (c == "/" && before ~ /[a-z0-9_)\]]/) change(p, 1, "*", "times, divide")
   }
}

# Two names as indices exchanged: a(i, j), a(j, i).
function indices(    p, text, rest, first, second) {
   p = 1
   rest = code
   if (code ~ /^ *(call |if \(.*\) call )/) return
   while (match(rest, /[a-z0-9_]\([a-z][a-z0-9_]*, [a-z][a-z0-9_]*\)/)) {
      text = substr(rest, RSTART + 2, RLENGTH - 3)
      first = text; sub(/,.*/, "", first)
      second = text; sub(/.*, /, "", second)
      if (length(first) <= 2 && length(second) <= 2 && substr(rest, 1, RSTART) !~ /(min|max)$/) change(p + RSTART + 1, RLENGTH - 3, second ", " first, "indices")
      p += RSTART + RLENGTH - 1
      rest = substr(code, p)
   }
}

# A whole statement.
function statements(    p, open, close_at, bound) {
   if (match(code, /^ *call /)) change(RLENGTH - 4, length(code) - RLENGTH + 5, "continue", "call left out")
   else if (match(code, /\) call /)) change(RSTART + 2, length(code) - RSTART - 1, "continue", "call left out")
   if (match(code, /^ *(else )?if \(/)) {
      open = RLENGTH
      close_at = end_of(open)
      if (close_at > 0) change(open + 1, close_at - open - 1, ".not. (" substr(whole, open + 1, close_at - open - 1) ")", "condition")
   }
   if (match(code, /^ *([a-z_]+: )?do [a-z_]+ = [^,]*, /) || match(code, /^ *do concurrent \([a-z_]+ = [^:]*:/)) {
      p = RLENGTH + 1
      bound = substr(code, p)
      if (bound ~ /^[^,]*$/) { if (code ~ /^ *do concurrent/) sub(/\) *$/, "", bound); sub(/ *$/, "", bound); change(p, length(bound), substr(whole, p, length(bound)) " - 1", "bound of a loop") }
   }
   if (match(code, /^ *[a-z][a-z0-9_%]*(\([^=<>\/]*\))? = [a-z(]/)) # the first term of what is assigned
      if (code ~ /_wp|[*\/+]| - /) change(RLENGTH, 0, "-", "sign of a term")
}

# ---- tools ---------------------------------------------------------------------------------------

# LENGTH characters from column P give way to TEXT.
function change(p, count, text, what,    now, key, weight) {
   now = substr(whole, 1, p - 1) text substr(whole, p + count)
   if (now == whole) return
   key = FILENAME "|" squeezed(whole) "|" squeezed(now)
   if (key in same) return
   occurs[key]++
   weight = FILENAME ~ /\/(joint|element|model|increment|solver|build|result)\// ? 3 : 1
   if (what == "constant") weight *= 0.4                              # there are as many of them as of all others
   printf "%.9f\t%s\t%d\t%s\t%s\t%s\n", -log(number_of(seed "|" key "|" occurs[key]))/weight, FILENAME, FNR, what, whole, now
}

# A number in (0, 1) from TEXT, the same under every awk.
function number_of(text,    h, k) {
   h = 1
   for (k = 1; k <= length(text); k++) h = (h*8191 + code_of[substr(text, k, 1)]) % 2147483647
   for (k = 1; k <= 3; k++) h = (h*48271 + 11) % 2147483647
   return (h + 1)/2147483649
}

# LINE with what stands in quotes blanked out by quotes, and without its comment: columns stay.
function masked(line,    p, c, quote, out) {
   line = tolower(line)
   for (p = 1; p <= length(line); p++) {
      c = substr(line, p, 1)
      if (quote != "") { if (c == quote) quote = ""; out = out "'" }
      else if (c == "!") break
      else if (c == "'" || c == "\"") { quote = c; out = out "'" }
      else out = out c
   }
   sub(/ +$/, "", out)
   return out
}

function is_declaration(line) {
   if (line ~ /^ *(integer|real|logical|character|complex|type *\(|class *\(|procedure).*::/) return 1
   if (line ~ /^ *(use|implicit|import|interface|end|else *$|contains|select|case|associate|block|type is|class is) *|^ *(use|import) /) return 1
   return line ~ /(^|[^a-z0-9_])(subroutine|function) +[a-z]/ && line !~ /^ *call /
}

function last_of(text) { sub(/ +$/, "", text); return substr(text, length(text), 1) }

function squeezed(text) { gsub(/[ \t]+/, " ", text); sub(/^ /, "", text); sub(/ $/, "", text); return text }

# The constant that TEXT begins with.
function constant(text) {
   match(text, /^[0-9]+(\.[0-9]*)?/)
   if (substr(text, RLENGTH + 1) ~ /^[ed][+-]?[0-9]/ && substr(text, 1, RLENGTH) ~ /\./) match(text, /^[0-9]+\.[0-9]*[ed][+-]?[0-9]+/)
   if (substr(text, RLENGTH + 1) ~ /^_[a-z]/) {
      match(text, /^[0-9]+(\.[0-9]*)?([ed][+-]?[0-9]+)?_[a-z][a-z0-9_]*/)
   }
   return substr(text, 1, RLENGTH)
}

function other_constant(text,    value, kind) {
   kind = ""
   value = text
   if (match(text, /_[a-z].*$/)) { kind = substr(text, RSTART); value = substr(text, 1, RSTART - 1) }
   if (value !~ /\./) return (value + 1) kind
   if (value + 0 == 0) return "1.0" kind
   if (value + 0 == 1) return "2.0" kind
   if (value + 0 == 2) return "1.0" kind
   if (value + 0 == 0.5) return "0.25" kind
   return "(0.5" kind "*" text ")"
}

# The column of the bracket that closes the one in column OPEN; 0: not in this line.
function end_of(open,    p, c, depth) {
   for (p = open; p <= length(code); p++) {
      c = substr(code, p, 1)
      if (c == "(") depth++
      if (c == ")" && --depth == 0) return p
   }
   return 0
}
