# Changes of a deck at random. Each function changes the copy and returns what it did; an empty answer means that it is not
# possible here. Names with a capital letter inside, as NaN, are what the results are searched for: never put them in.

# Runs are short: most JINCR cards come down to a few increments.
function fewer_increments(   part, parts, i, k) {
   parts = split(my_cards, part, " ")
   for (i = 1; i <= parts; i++) {
      k = part[i]
      if (toupper(line[k]) !~ /^JINCR/ || !read_card(k) || field[3] == "LIST" || field[2] < 5) continue
      field[2] = 1 + random(5)
      field[4] = ""
      write_card(k, "small")
   }
}

# ---- wild ----

function extreme(kind) {
   if (random(6) == 0) kind = chance("integer real word blank")
   if (kind == "integer")
      return chance("0 -1 1 2 3 4 5 6 7 8 10 12 20 21 99 101 1000 100000 99999 1000000 2147483647 2147483646 2147483648 -2147483648 99999999999 " \
                    "+5 0007 -0 123456 12345678")
   if (kind == "real") return extreme_real()
   if (kind == "word")
      return chance("ARITH GEOM LIST THRU BY EXCEPT ALL YES NO AUTO CONST PLANE TABLE NODES TRUE MODES K M MEMBRANE A ' \" ( ) = / BLANK ENDDATA " \
                    "\303\204 \377 X* *A +A THRUTHRU")
   return ""
}

# Increments beyond a few dozens make a run long, and rightly so.
function is_length_of_run(f) { return card_name == "JINCR" && f == 2 }

function change_field(   k, f, old) {
   if (!(k = some_card("."))) return ""
   f = 1 + random(fields)
   old = field[f]
   field[f] = is_length_of_run(f) ? chance("0 -1 1 2 3 12 100001 2147483647 1.0 A") : extreme(kind_of_entry(old))
   write_card(k, any_form())
   return card_name " field " f + 1 " from '" old "' to '" field[f] "'"
}

# An entry of the same kind from elsewhere
function borrow_field(   k, f, old, kind, i, g, kept, names, count) {
   if (!(k = some_card("."))) return ""
   g = 1 + random(fields)
   old = field[g]
   if (!some_card(".")) return ""
   f = 1 + random(fields)
   kept = field[f]
   for (i = 1; i <= 8 && kind_of_entry(kept) != kind_of_entry(old); i++) { f = 1 + random(fields); kept = field[f] }
   read_card(k)
   if (is_length_of_run(g)) return ""
   field[g] = kept
   write_card(k, any_form())
   return card_name " field " g + 1 " from '" old "' to '" kept "' of another card"
}

function swap_fields(   k, f, g, kept) {
   if (!(k = some_card("^[^J]"))) return ""
   f = 1 + random(fields); g = 1 + random(fields)
   kept = field[f]; field[f] = field[g]; field[g] = kept
   write_card(k, any_form())
   return card_name " fields " f + 1 " and " g + 1 " swapped"
}

function move_fields(   k, f, i) {
   if (!(k = some_card("."))) return ""
   if (card_name == "JINCR") return ""
   f = 1 + random(fields)
   if (random(2)) {
      for (i = fields++; i >= f; i--) field[i + 1] = field[i]
      field[f] = random(2) ? "" : field[f]
   } else {
      for (i = f; i < fields; i++) field[i] = field[i + 1]
      field[fields] = ""
   }
   write_card(k, any_form())
   return card_name " fields moved from " f + 1 " on"
}

function drop_card(   k, i) {
   if (!(k = some_card("."))) return ""
   for (i = k; i <= card_end; i++) line[i] = gone
   return card_name " of line " k " taken out"
}

function repeat_card(   k, i, copy_of) {
   if (!(k = some_card("."))) return ""
   for (i = k; i <= card_end; i++) copy_of = copy_of "\n" line[i]
   line[card_end] = line[card_end] copy_of
   return card_name " of line " k " twice"
}

# Once more with another number
function clone_card(   k, i, original) {
   if (!(k = some_card("."))) return ""
   for (i = k; i <= card_end; i++) original = original "\n" line[i]
   field[1] = chance("2 3 7 77 1001 2147483647")
   write_card(k, any_form())
   line[k] = line[k] original
   return card_name " once more as " field[1]
}

function swap_cards(   a, b, end_a, i, kept) {
   if (!(a = some_card("."))) return ""
   end_a = card_end
   if (!(b = some_card(".")) || a == b) return ""
   for (i = a; i <= end_a; i++) { kept = kept (i > a ? "\n" : "") line[i]; line[i] = gone }
   for (i = b; i <= card_end; i++) { line[a] = (i > b ? line[a] "\n" : "") line[i]; line[i] = gone }
   line[b] = kept
   return "cards of lines " a " and " b " swapped"
}

function add_sample(   k, other) {
   k = chance(my_cards)
   if (line[k] == gone) return ""
   other = sample[1 + random(samples)]
   line[k] = other "\n" line[k]
   return "put in '" other "'"
}

# The bulk data of another deck behind that of this one
function add_deck(   d, i, out) {
   d = whole[1 + random(n_whole)]
   if (lines[d] > 150) return ""
   for (i = begin[d] + 1; i < end[d]; i++) out = out text[d, i] "\n"
   line[last] = out line[last]
   return "with the cards of " name[d]
}

# A chain of numbers: an id and its references become another one.
function renumber(   part, parts, i, k, f, old, new, done) {
   if (!some_card(".")) return ""
   old = field[1 + random(fields)]
   if (kind_of_entry(old) != "integer") return ""
   new = chance("1 2 5 2147483647 1000000 77")
   parts = split(my_cards, part, " ")
   for (i = 1; i <= parts; i++) {
      k = part[i]
      if (line[k] !~ /^[A-Za-z]/ || !read_card(k)) continue
      done = 0
      for (f = 1; f <= fields; f++) if (field[f] == old && !is_length_of_run(f)) { field[f] = new; done = 1 }
      if (done) write_card(k, "small")
   }
   return "every " old " now " new
}

# ---- coordinates: of all nodes, and blocks ----

function scale_coordinates(factor, axes,   part, parts, i, k, f, from, to) {
   parts = split(my_cards, part, " ")
   for (i = 1; i <= parts; i++) {
      k = part[i]
      if (toupper(line[k]) !~ /^(GRID|BLOCK)/ || !read_card(k)) continue
      from = card_name == "GRID" ? 3 : card_name == "BLOCK3" ? 6 : 5
      to = card_name == "GRID" ? 5 : card_name == "BLOCK3" ? 11 : 12
      for (f = from; f <= to && f <= fields; f++) if (kind_of_entry(field[f]) == "real" && index(axes, (f - from) % 3 + 1)) {
         if (card_name == "BLOCK2" && field[f] == "") continue
         field[f] = real_entry(value_of(field[f]) * factor)
      }
      write_card(k, "free")
   }
   return "coordinates " axes " times " factor
}

function move_node(   k, f, other) {
   if (!(k = some_card("^GRID"))) return ""
   if (random(2)) {
      f = 3 + random(3)
      field[f] = real_entry(value_of(field[f]) + (random(201) - 100) / chance("1 10 100 1E6"))
   } else {
      other = k
      if (!some_card("^GRID")) return ""
      card_name = field[3] " " field[4] " " field[5]
      split(card_name, kept_place, " ")
      read_card(other)
      for (f = 3; f <= 5; f++) field[f] = kept_place[f - 2]
      k = other
   }
   write_card(k, any_form())
   return "a node moved"
}

# ---- case control ----

function change_entry(   k, entry, what) {
   k = chance(my_keys)
   if (k == "" || line[k] == gone) return ""
   what = random(5)
   if (what == 0) { line[k] = gone; return "entry of line " k " taken out" }
   if (what == 1) { line[k] = line[k] "\n" line[k]; return "entry of line " k " twice" }
   if (what == 2) { line[k] = add_entry_text() "\n" line[k]; return "another entry before line " k }
   entry = line[k]
   sub(/=.*/, "", entry)
   line[k] = entry "= " chance("0 1 -1 5 10 20 99 2147483647 2147483648 1.5 STEP NEWTON BACK ALL NONE LAST,STRESS NO YES AUTO TREE SKYLINE EQ10 A,B MM,N 1E-9")
   return "line " k " now '" line[k] "'"
}

function add_entry_text() {
   return chance("METHOD=STEP METHOD=NEWTON METHOD=BACK PRESSURE=EQ10 CARRY=YES SOLVER=TREE SOLVER=SKYLINE AVERAGE=NO PATHTOL=1E-2 PATHTOL=0.0 TOL=1E-3 TOL=1E-30 TOL=0.0 " \
                 "SPC=1 MPC=4 LOAD=10 INCR=5 OUTPUT=ALL,STRESS,STATE,CONDENSED,PLOT TEMPERATURE(LOAD)=7 SUBCASE SUBCASE=2 SUBCOM=3 ECHO=NONE " \
                 "SET RESTART=1 RESTART=0 MODES=4 LOAD=20 OUTPUT=ALL,SET MODES=1 ,5 9 TITLE= INCLUDE BEGIN SET=1 SOL=103")
}

# One more stage: the first one again, with another load
function add_stage(   i, out) {
   for (i = stage; i < first && (i == stage || line[i] !~ /^ *SUBCASE/); i++) if (line[i] != gone) out = out line[i] "\n"
   sub(/SUBCASE +[0-9]+/, "SUBCASE " 90 + random(9), out)
   if (random(3) == 0) sub(/ *LOAD *= *[0-9]+\n/, "", out)
   line[first] = out line[first]
   return "the first stage again"
}

# ---- lines and bytes ----

function spoil_bytes(   k, at, what) {
   k = 1 + random(n)
   if (line[k] == gone) return ""
   at = 1 + random(length(line[k]) + 1)
   what = random(8)
   if (what == 0) what = sprintf("%c", random(256))
   else if (what == 1) what = "\t"
   else if (what == 2) what = "\303\244"
   else if (what == 3) what = long_text(" ", 1 + random(100))
   else if (what == 4) what = "\n"
   else if (what == 5) what = chance("$ , * + = ' . -")
   else if (what == 6) what = "\r"
   else what = long_text(chance("X 1 , 9."), 1 + random(20000))
   line[k] = substr(line[k], 1, at - 1) what substr(line[k], at + random(2))
   return "bytes at column " at " of line " k
}

function spoil_continuation(   k, what, wanted) {
   for (wanted = 1; wanted <= 100; wanted++) {
      k = first + random(last - first)
      if (line[k] ~ /^[+*,]/ && line[k] !~ /\n/) break
   }
   if (wanted > 100) return ""
   what = random(5)
   if (what == 0) line[k] = gone
   else if (what == 1) line[k] = line[k] "\n" line[k]
   else if (what == 2) line[k] = "+AB" substr(line[k], 4)
   else if (what == 3) line[k] = "$ REMARK\n\n" line[k]
   else line[k] = substr(line[k], 1, random(length(line[k]) + 1))
   return "continuation of line " k " spoilt"
}

function other_line_ends() { line_end = random(2) ? "\r\n" : "\r"; return "other line ends" }

function add_include(   k, path) {
   k = chance(my_cards)
   if (line[k] == gone) return ""
   path = chance("fuzz_" copy ".bdf nothing.bdf . / /dev/null moved.inc patch.inc ../decks " long_text("x", 5000))
   line[k] = line[k] "\nINCLUDE '" path "'"
   return "INCLUDE of " path
}

function lower_case(   k) { k = 1 + random(n); if (line[k] == gone) return ""; line[k] = tolower(line[k]); return "line " k " in small letters" }

function wild_change(   k) {
   k = random(40)
   if (k < 12) return change_field()
   if (k < 16) return borrow_field()
   if (k < 17) return swap_fields()
   if (k < 18) return move_fields()
   if (k < 20) return drop_card()
   if (k < 21) return repeat_card()
   if (k < 23) return clone_card()
   if (k < 24) return swap_cards()
   if (k < 27) return add_sample()
   if (k < 28) return add_deck()
   if (k < 29) return renumber()
   if (k < 30) return scale_coordinates(chance("0 1E-6 1E6 1E-30 1E30 -1 1E150 1E-150"), chance("1 2 3 12 123"))
   if (k < 32) return move_node()
   if (k < 35) return change_entry()
   if (k < 36) return add_stage()
   if (k < 37) return spoil_bytes()
   if (k < 38) return spoil_continuation()
   if (k < 39) return random(4) ? lower_case() : other_line_ends()
   return add_include()
}

# ---- moderate: the deck is still valid, most often ----

# A real number of a law, a load, a material, a place becomes another.
function change_value(   k, f, i, old, factor) {
   if (!(k = some_card("^(JNORM|JSHEAR|JIWAN|PJOINT|MAT1|FORCE|PSHELL|LOAD|GRAV|PLOAD|SPCD|JGAP|TEMP|TEMPP1|BOLT|CELAS2|PBUSH|PELAS|CONM2|RBE3|MPC|MOMENT|CONROD|PROD|JOINT|CJOINT)")))
      return ""
   for (i = 1; i <= 20; i++) {
      f = 1 + random(fields)
      if (kind_of_entry(field[f]) == "real") break
   }
   if (i > 20) return ""
   old = field[f]
   if (card_name == "MAT1" && f == 4) return ""
   factor = chance("0.5 2 10 0.1 1000 0.001 -1 1.0001 3 1E6 1E-6")
   field[f] = real_entry(value_of(old) * factor)
   write_card(k, any_form())
   return card_name " field " f + 1 " from '" old "' to '" field[f] "'"
}

function change_law(   k, what) {
   what = random(8)
   if (what == 0 && (k = some_card("^JNORM"))) field[3] = chance("1.0 0.5 0.3 0.1 0.05 0.01 0.001 0.9")
   else if (what == 1 && (k = some_card("^JNORM"))) field[2] = chance("1E-12 1E-6 1E-3 1.0 1E3 1E6 0.01")
   else if (what == 2 && (k = some_card("^JNORM"))) field[4] = chance("1E-6 1.0 1E3 1E6 1E12 10.")
   else if (what == 3 && (k = some_card("^PJOINT"))) field[5] = chance("0.0 0.01 0.1 0.5 1.0 1000. 1E6")
   else if (what == 4 && (k = some_card("^PJOINT"))) field[6] = chance("-1 0 1 2 5 50")
   else if (what == 5 && (k = some_card("^PJOINT"))) field[7] = chance("1E-9 1E-3 0.01 1.0 1E3 1E9")
   else if (what == 6 && (k = some_card("^MAT1"))) field[4] = chance("0.0 0.3 0.49 0.4999 -0.5 -0.99")
   else if ((k = some_card("^MAT1"))) field[2] = chance("1E-6 1.0 1E3 1E6 1E12 210000.")
   if (!k) return ""
   if (fields < 7) fields = 7
   write_card(k, any_form())
   return card_name " changed"
}

# An entry for all stages, in the place of the one that is there
function change_method(   entry, key, k) {
   entry = chance("METHOD=STEP METHOD=NEWTON METHOD=BACK PRESSURE=EQ10 CARRY=YES SOLVER=TREE SOLVER=SKYLINE AVERAGE=NO PATHTOL=1E-5 TOL=1E-6")
   key = substr(entry, 1, index(entry, "=") - 1)
   for (k = 1; k < stage; k++) if (toupper(line[k]) ~ "^ *" key " *=") line[k] = gone
   global_entry[key] = entry
   return entry
}

function change_output(   i, out) {
   out = chance("ALL JOINT LAST NONE") "," chance("PLOT STRESS STATE CONDENSED VTU STRESS,STATE,PLOT,CONDENSED VTU,STEPS")
   for (i = stage + 1; i < first; i++) if (toupper(line[i]) ~ /^ *OUTPUT *=/) line[i] = gone
   line[stage] = line[stage] "\nOUTPUT = " out
   return "output " out
}

function other_format(   k) {
   if (!(k = some_card("."))) return ""
   write_card(k, chance("small free large"))
   return card_name " in another form"
}

function change_divisions(   k) {
   if (!(k = some_card("^BLOCK"))) return ""
   field[3 + random(2)] = 1 + random(6)
   write_card(k, any_form())
   return "other divisions"
}

function change_increments(   k) {
   if (!(k = some_card("^JINCR"))) return ""
   fields = 4
   field[2] = 1 + random(12)
   field[3] = chance("ARITH GEOM")
   field[4] = chance("0.01 0.05 0.1 0.3 1E-6")
   if (field[3] == "ARITH") field[4] = real_entry(1 / field[2])
   write_card(k, any_form())
   return "increments"
}

function moderate_change(   k) {
   k = random(20)
   if (k < 7) return change_value()
   if (k < 10) return change_law()
   if (k < 12) return change_method()
   if (k < 13) return change_output()
   if (k < 14) return other_format()
   if (k < 15) return change_divisions()
   if (k < 16) return add_stage()
   if (k < 17) return change_increments()
   if (k < 18) return move_node()
   if (k < 19) return scale_coordinates(chance("1E-3 1E3 0.1 10 2 1E-6 1E6"), "123")
   return borrow_field()
}
