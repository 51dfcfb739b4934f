# Prints the numbers of the cards in the output of jointfit, one a line: `NAME FIELD VALUE`. Data fields are counted from 1 over all
# lines of a card, as jointfem counts them (1 is the id, B11 is 9, C11 is 17, PMAX is 25). Reads small and large fields; a card
# beyond column 80 and any other text is an error.
#
# The words of ORIGIN are printed as they are.
#
#    awk -f card_values.awk [-v name=JSHEAR] cards.bdf
function number(text) {
   gsub(/ /, "", text)
   if (text !~ /^[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([+-][0-9]+)?$/) { print "not a number: '" text "'"; exit 1 }
   if (match(text, /[0-9.][+-]/)) text = substr(text, 1, RSTART) "e" substr(text, RSTART + 1)
   return text + 0
}
/^\$/ || /^ *$/ { next }
length($0) > 80 { print "past column 80: " $0; exit 1 }
{
   head = substr($0, 1, 8)
   gsub(/ /, "", head)
   width = head ~ /\*/ ? 16 : 8
   gsub(/[*+]/, "", head)
   if (head != "") { card = head; field = 0 }
   else if (width == 8 && field % 8) field += 8 - field % 8
   for (i = 0; i < 64 / width; i++) {
      field++
      entry = substr($0, 9 + i * width, width)
      if (entry ~ /^(BRANCH|CURVE) *$/ && (name == "" || name == card)) { sub(/ +$/, "", entry); print card, field, entry; continue }
      if (entry !~ /^ *$/ && (name == "" || name == card)) printf "%s %d %.17g\n", card, field, number(entry)
   }
}
