# Decks made from decks: damaged, changed at random, or moderately.
#
#     awk -v seed=N -v from=A -v to=B -v folder=OUT -v only=KIND -f random.awk -f fuzz_damage.awk -f fuzz_cards.awk -f fuzz_changes.awk -f fuzz_decks.awk MANUAL DECK...
#
# Writes OUT/fuzz_A.bdf ... OUT/fuzz_B.bdf and prints a line for each: its number, its kind, the deck it comes from, what was done.
# MANUAL is the manual of the cards: its filled-in cards are put into decks too. Kinds: `bad`, no valid deck any more, the program
# must refuse it; `wild`, anything may happen but a crash; `mild`, most are still valid and reach the equations. KIND makes all
# of them of that kind.
#
# A deck depends on the seed, on its number and on the decks, not on the other numbers nor on whatever awk this is. Run with LC_ALL=C.

function insert(k, new,   i) {
   for (i = n; i > k; i--) line[i + 1] = line[i]
   line[k + 1] = new
   n++
}

function remove(k,   i) {
   for (i = k; i < n; i++) line[i] = line[i + 1]
   n--
}

# ---- the decks that are read ----

FNR == 1 {
   files++
   if (files > 1) { decks++; name[decks] = FILENAME; sub(/.*\//, "", name[decks]) }
}
files == 1 && /^```/ { in_code = !in_code; next }
files == 1 { if (in_code && /^[A-Z][A-Z0-9]+[*, ]/) sample[++samples] = $0; else if (in_code && samples && /^[+*]/) sample[samples] = sample[samples] "\n" $0; next }
{
   sub(/\r$/, "")
   lines[decks] = FNR
   text[decks, FNR] = $0
   card = toupper($0)
   if (card ~ /^ *BEGIN +BULK/) begin[decks] = FNR
   else if (card ~ /^ *ENDDATA/) end[decks] = FNR
   else if (!begin[decks] && card ~ /^ *SUBCASE/ && !subcase[decks]) subcase[decks] = FNR
   else if (!begin[decks] && card ~ /^ *[A-Z]+ *[= ]/) keys[decks] = keys[decks] " " FNR
   else if (begin[decks] && !end[decks] && card ~ /^[A-Z]/) {
      cards[decks] = cards[decks] " " FNR
      if (FNR % 7 == 0 || samples < 200) sample[++samples] = $0
   }
}

# ---- the copies ----

# Take deck d as the copy that is changed.
function take(d,   i) {
   n = lines[d]
   for (i = 1; i <= n; i++) line[i] = text[d, i]
   first = begin[d]; last = end[d]; stage = subcase[d]; my_cards = cards[d]; my_keys = keys[d]
   source = d
   split("", global_entry)
}

function kind_of_copy(   k) {
   if (only != "") return only
   k = random(10)
   return k < 2 ? "bad" : k < 6 ? "wild" : "mild"
}

function changes(kind,   what, more, times, i) {
   if (kind == "bad") {
      do { take(source); what = damage(random(24)) } while (what == "")
      return what
   }
   fewer_increments()
   times = 1 + random(kind == "mild" ? 6 : 3)
   for (i = 1; i <= times; i++) {
      more = kind == "mild" ? moderate_change() : wild_change()
      if (more != "") what = what (what == "" ? "" : ", ") more
   }
   return what == "" ? "nothing" : what
}

END {
   for (d = 1; d <= decks; d++) if (begin[d] && end[d] && subcase[d] && cards[d] != "") whole[++n_whole] = d
   for (copy = from; copy <= to && n_whole > 0; copy++) {
      start_random(copy)
      take(whole[1 + random(n_whole)])
      kind = kind_of_copy()
      what = changes(kind)
      file = folder "/fuzz_" copy ".bdf"
      printf "" > file
      ORS = line_end
      for (i = 1; i <= global_entries; i++) if (global_key[i] in global_entry) print global_entry[global_key[i]] > file
      for (i = 1; i <= n; i++) if (line[i] != gone) print line[i] > file
      close(file)
      ORS = line_end = "\n"
      gsub(/[^ -~]/, "?", what)
      print copy, kind, name[source] ": " substr(what, 1, 200)
   }
}
BEGIN { line_end = "\n"; gone = "\001gone\001"; global_entries = split("METHOD PRESSURE CARRY SOLVER AVERAGE PATHTOL TOL", global_key, " ") }
