# Damage after which a deck is surely none any more: the program must refuse it.
#
# Each function changes the copy in line[1 .. n] and returns what it did; an empty answer means that it is not possible here.
# `first`, `last` and `stage` are the lines of BEGIN BULK, ENDDATA and the first SUBCASE, `my_cards` and `my_keys` those on
# which cards and entries of case control begin.

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

function swap_lines(a, b, what,   kept) {
   kept = line[a]; line[a] = line[b]; line[b] = kept
   return what " (line " a ") and line " b " swapped"
}

function first_of(list,   words) { split(list, words, " "); return words[1] }

# ENDDATA with the first card: what is lost farther down may not be needed
function swap_structure(   kind) {
   kind = random(4)
   if (kind == 0) return swap_lines(first, chance(my_cards), "BEGIN BULK")
   if (kind == 1) return swap_lines(last, first_of(my_cards), "ENDDATA")
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

# every card has its number or set in field 2, but those of defaults
function blank_number(   k, i) {
   for (i = 1; i <= 50; i++) {
      k = chance(my_cards)
      if (line[k] ~ /[*,\t]/ || line[k] ~ /^ *GRDSET/) continue
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

# A field that names another card gets a number that none has.
function lose_reference(   k, f) {
   if (!(k = some_card("^(C(QUAD[48]|TRIA[36]|HEXA|PENTA|TETRA|BAR|ROD|BUSH|ELAS1|JOINT)|P(SHELL|AXIS|SOLID|JOINT)|JOINT|JGAP|FORCE|PLOADM|SPC[M1]?)[ ,*]"))) return ""
   if (card_name ~ /^(JGAP|FORCE)$/) f = card_name == "JGAP" ? 1 : 2
   else if (card_name ~ /^(PLOADM|SPCM)$/) f = 3
   else if (card_name == "SPC1") f = 3
   else if (card_name ~ /^(CQUAD4|CTRIA3|CTETRA|CBAR|CROD|JOINT)$/) f = 2 + random(3)
   else f = 2
   if (field[f] == "") return ""
   field[f] = 87654321
   write_card(k, any_form())
   return card_name " field " f + 1 " names nothing that there is"
}

function lose_set(   k, i) {
   for (i = 1; i <= 20; i++) {
      k = chance(my_keys)
      if (toupper(line[k]) ~ /^ *(SPC|LOAD|INCR|MPC) *=/) break
   }
   if (i > 20) return ""
   sub(/=.*/, "= 87654321", line[k])
   return "line " k " names nothing that there is"
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
   if (kind < 17) return lose_reference()
   if (kind == 17) return lose_set()
   return spoil_number()
}

