# Damaged copies of decks, none of which is a valid deck any more.
#
#     awk -v copies=500 -v folder=OUT -f damage.awk DECK...
#
# Writes OUT/damaged_1.bdf, OUT/damaged_2.bdf, ... and prints a line for each: its number, the deck, what was done.
# The same decks always give the same copies, whatever awk this is: the random numbers are made here. Run with LC_ALL=C.

# A whole number from 0 to n - 1 (Park and Miller's generator).
function random(n) {
   seed = (16807 * seed) % 2147483647
   return int(seed / 2147483647 * n)
}

function chance(list,   words, n) {
   n = split(list, words, " ")
   return words[1 + random(n)]
}

FNR == 1 { decks++; name[decks] = FILENAME; sub(/.*\//, "", name[decks]) }
{
   sub(/\r$/, "")
   lines[decks] = FNR
   text[decks, FNR] = $0
   card = toupper($0)
   if (card ~ /^ *BEGIN +BULK/) begin[decks] = FNR
   else if (card ~ /^ *ENDDATA/) end[decks] = FNR
   else if (!begin[decks] && card ~ /^ *SUBCASE/) subcase[decks] = FNR
   else if (!begin[decks] && card ~ /^ *[A-Z]+ *[= ]/) keys[decks] = keys[decks] " " FNR
   else if (begin[decks] && !end[decks] && card ~ /^[A-Z]/) cards[decks] = cards[decks] " " FNR
}

# ---- one damage each: they change the copy in line[1..n] and say what they did; an empty answer means not possible ----

function cut_lines(   k) {
   k = random(last)
   n = k
   return "cut behind line " k
}

function cut_inside(   k) {
   k = chance(my_cards)
   line[k] = substr(line[k], 1, 1 + random(length(line[k])))
   n = k
   return "cut inside line " k
}

# what stands behind an ENDDATA does not count: nothing is left
function end_too_early() {
   insert(first, line[last])
   return "ENDDATA right behind BEGIN BULK"
}

# without the ENDDATA between them, behind which nothing counts
function double_deck(   i, whole) {
   remove(last)
   whole = n
   for (i = 1; i <= whole; i++) line[n + i] = line[i]
   n += whole
   line[++n] = "ENDDATA"
   return "the whole deck twice"
}

# a card whose number nothing else may have
function double_card(   k, i) {
   for (i = 1; i <= 50; i++) {
      k = chance(my_cards)
      if (line[k] ~ /^(GRID|C(QUAD4|BAR|ROD|JOINT|TRIA3|HEXA|PENTA|TETRA)|P(SHELL|AXIS|SOLID|MARK|JOINT)|MAT1|BLOCK[23]|J(OINT|NORM|SHEAR|INCR))[ ,*]/) {
         insert(k, line[k])
         return "line " k " twice"
      }
   }
   return ""
}

function insert(k, new,   i) {
   for (i = n; i > k; i--) line[i + 1] = line[i]
   line[k + 1] = new
   n++
}

function remove(k,   i) {
   for (i = k; i < n; i++) line[i] = line[i + 1]
   n--
}

function swap_lines(a, b, what,   kept) {
   kept = line[a]; line[a] = line[b]; line[b] = kept
   return what " (line " a ") and line " b " swapped"
}

function swap_structure(   kind) {
   kind = random(4)
   if (kind == 0) return swap_lines(first, chance(my_cards), "BEGIN BULK")
   if (kind == 1) return swap_lines(last, chance(my_cards), "ENDDATA")
   if (kind == 2) return swap_lines(stage, chance(my_cards), "SUBCASE")
   return swap_lines(stage, first, "SUBCASE")
}

function swap_halves(   k, i, old) {
   k = first + random(last - first)
   for (i = 1; i <= n; i++) old[i] = line[i]
   for (i = 1; i <= n; i++) line[i] = old[(i + k - 1) % n + 1]
   return "the lines behind " k " moved to the front"
}

function lose_structure(   k) {
   k = random(2) ? first : last
   remove(k)
   return "line " k " (BEGIN BULK or ENDDATA) lost"
}

# A byte that no number holds (nor a line end, a comment, a separator): a control byte, one beyond ASCII, a letter other
# than the E and D of exponents.
function bad_byte(   kind) {
   kind = random(3)
   if (kind == 0) return sprintf("%c", 1 + random(8))
   if (kind == 1) return sprintf("%c", 128 + random(128))
   return substr("ABCFGHIJKLMNOPQRSTUVWXYZabcfghijklmnopqrstuvwxyz", 1 + random(48), 1)
}

# One byte of a number on a card, in columns of eight or between commas
function spoil_number(   k, i, from, width, entry, at) {
   for (i = 1; i <= 200; i++) {
      k = chance(my_cards)
      if (line[k] ~ /[*\t$]/) continue
      if (index(line[k], ",")) {
         from = index(line[k], ",") + 1
         for (at = random(6); at > 0 && index(substr(line[k], from), ","); at--) from += index(substr(line[k], from), ",")
         width = index(substr(line[k], from) ",", ",") - 1
      } else {
         from = 9 + 8 * random(8)
         width = 8
      }
      entry = substr(line[k], from, width)
      if (entry !~ /^ *[-+]?[0-9.]+([-+][0-9]+)? *$/) continue
      match(entry, /[^ ]+/)
      at = from + RSTART - 1 + random(RLENGTH)
      line[k] = substr(line[k], 1, at - 1) bad_byte() substr(line[k], at + 1)
      return "column " at " of line " k
   }
   return ""
}

function spoil_name(   k, at) {
   k = chance(my_cards)
   match(line[k], /^[A-Za-z0-9]+/)
   at = 1 + random(RLENGTH)
   line[k] = substr(line[k], 1, at - 1) substr("#&!?@%", 1 + random(6), 1) substr(line[k], at + 1)
   return "the name on line " k
}

function spoil_key(   k, at) {
   k = chance(my_keys " " stage)
   match(line[k], /[A-Za-z]+/)
   at = RSTART + random(RLENGTH)
   line[k] = substr(line[k], 1, at - 1) substr("#&!?@%", 1 + random(6), 1) substr(line[k], at + 1)
   return "the key on line " k
}

function spoil_anywhere(   k, at) {
   k = 1 + random(n)
   at = 1 + random(length(line[k]))
   line[k] = substr(line[k], 1, at - 1) sprintf("%c", 1 + random(8)) substr(line[k], at)
   return "a control byte in column " at " of line " k
}

# every card has its number or set in field 2
function blank_number(   k, i) {
   for (i = 1; i <= 50; i++) {
      k = chance(my_cards)
      if (line[k] ~ /[*,\t]/) continue
      line[k] = substr(line[k], 1, 8) "        " substr(line[k], 17)
      return "field 2 of line " k " blank"
   }
   return ""
}

function add_nonsense(   k, i, word) {
   k = first + random(last - first)
   word = "Q"
   for (i = 1; i <= 7; i++) word = word substr("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789", 1 + random(36), 1)
   insert(k, word "        1")
   return "nonsense behind line " k
}

function damage(kind) {
   if (kind == 0) return cut_lines()
   if (kind == 1) return cut_inside()
   if (kind == 2) return end_too_early()
   if (kind == 3) return double_deck()
   if (kind == 4) return double_card()
   if (kind == 5) return swap_structure()
   if (kind == 6) return swap_halves()
   if (kind == 7) return lose_structure()
   if (kind == 8) return spoil_name()
   if (kind == 9) return spoil_key()
   if (kind == 10) return spoil_anywhere()
   if (kind == 11) return blank_number()
   if (kind == 12) return add_nonsense()
   return spoil_number()
}

END {
   seed = 19840311
   for (d = 1; d <= decks; d++) if (begin[d] && end[d] && subcase[d] && cards[d] != "") whole[++n_whole] = d
   for (copy = 1; copy <= copies && n_whole > 0; copy++) {
      d = whole[(copy - 1) % n_whole + 1]
      first = begin[d]; last = end[d]; stage = subcase[d]; my_cards = cards[d]; my_keys = keys[d]
      do {
         n = lines[d]
         for (i = 1; i <= n; i++) line[i] = text[d, i]
         what = damage(random(18))
      } while (what == "")
      file = folder "/damaged_" copy ".bdf"
      printf "" > file
      for (i = 1; i <= n; i++) print line[i] > file
      close(file)
      print copy, name[d] ":", what
   }
}
