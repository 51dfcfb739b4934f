# What is wrong with a run of decks; nothing printed where all is well.
#
#     awk -v status=N -v results=FOLDER [-v statuses=FILE] -f fuzz_judge.awk LIST STDERR
#
# LIST: a line for each deck of the run, its name without the ending and its kind. STDERR: what the run said; its exit status is N.
# Prints a line for each fault: the deck, a blank, what is wrong (deck `-`: none of them alone). FILE gets the decks and the status
# that each must have had.

function fault(deck, what) { print deck " " what; faults++ }

# The numbers that no result may hold
function bad_number(entry) {
   if (entry ~ /^ \*\*\* /) return 0 # a line of words
   return entry ~ /(^|[^A-Za-z])(NaN|Infinity)([^A-Za-z]|$)/ || entry ~ /(^|[ ,>])[-+]?\*\*\*+/
}

# A listing: its head, its echo of the deck and its labels are the user's.
function read_listing(deck, file,   entry, echo, number) {
   while ((getline entry < file) > 0) {
      number++
      if (entry ~ /^ DECK ECHO$/) echo = 1
      else if (echo && entry ~ /^  TOTAL COUNT/) echo = 0
      else if (!echo && bad_number(entry)) { fault(deck, "the listing holds '" entry "'"); break }
   }
   close(file)
}

function read_table(deck, file,   entry) {
   while ((getline entry < file) > 0) if (bad_number(entry)) { fault(deck, substr(file, length(results) + 2) " holds '" entry "'"); break }
   close(file)
}

# A file for ParaView: its header, a fixed length of text, names the arrays that lie behind it as they were in memory.
function read_vtu(deck, file,   entry, many, arrays, command, bad) {
   while ((getline entry < file) > 0 && entry !~ /<\/UnstructuredGrid>/) {
      if (entry ~ /<Piece /) { many["Points"] = many["PointData"] = attribute(entry, "NumberOfPoints"); many["Cells"] = many["CellData"] = attribute(entry, "NumberOfCells") }
      if (entry ~ /^ *<(Points|Cells|PointData|CellData)>/) { section = entry; gsub(/[ <>]/, "", section) }
      if (entry !~ /type="Float64"/) continue
      arrays++
      command = command "od -A n -v -t f8 -j " 16384 + 8 + attribute(entry, "offset") " -N " \
         8*many[section]*(entry ~ /NumberOfComponents/ ? attribute(entry, "NumberOfComponents") : 1) " '" file "'; "
   }
   close(file)
   if (!arrays) { fault(deck, substr(file, length(results) + 2) " holds no arrays"); return }
   while ((command | getline entry) > 0) if (!bad && entry ~ /nan|inf/) { bad = 1; fault(deck, substr(file, length(results) + 2) " holds '" entry "'") }
   close(command)
}
function attribute(entry, what) { return match(entry, what "=\"[0-9]+") ? substr(entry, RSTART + length(what) + 2, RLENGTH - length(what) - 2) + 0 : 0 }

BEGIN {
   command = "ls -A '" results "'"
   while ((command | getline entry) > 0) {
      deck = entry
      sub(/\..*/, "", deck)
      files[deck] = files[deck] " " entry
   }
   close(command)
}
FNR == 1 { input++ }
input == 1 { order[++decks] = $1; kind[$1] = $2; next }

/Fortran runtime error|Program received|SIGFPE|Backtrace|Sanitizer|runtime error:|floating-point exceptions|^Error termination|double free|malloc|corrupt/ { if (!crash++) fault("-", "it says '" $0 "'") }
/NaN|Infinity|[^A-Z*]\*\*\*/ && !/^   [^ ]/ { spoilt = $0 }
match($0, /^[^ ]*fuzz_[0-9]+\.bdf: /) {
   deck = substr($0, 1, RLENGTH - 6)
   sub(/.*\//, "", deck)
   words = substr($0, RSTART + RLENGTH)
   if (words ~ /^[0-9]+ errors?, nothing solved$/) said[deck] = 2
   else if (words ~ /; no results$/) { said[deck] = 3; if (words ~ /NaN|Infinity|\*\*\*/) fault(deck, "it says '" words "'") }
   else if (words ~ /; the results end (there|at stage [0-9]+, increment [0-9]+)$/) { said[deck] = 3; keeps[deck] = 1; if (words ~ /NaN|Infinity|\*\*\*/) fault(deck, "it says '" words "'") }
   else if (words ~ /its results would overwrite/) said[deck] = 1
   else if (words ~ /cannot be written/) said[deck] = 4
   else if (words ~ /cannot be (read|opened)/) said[deck] = 1
}
END {
   for (i = 1; i <= decks; i++) {
      deck = order[i]
      has_listing = (files[deck] " ") ~ /\.out /
      if (!(deck in said)) {
         said[deck] = 0
         if (!has_listing) { fault(deck, "ended without a word and without results"); said[deck] = "-" }
      } else if (files[deck] != "" && !keeps[deck]) fault(deck, "refused, and left" files[deck])
      else if (keeps[deck] && !has_listing) fault(deck, "results said to be there are not")
      else if (keeps[deck] && files[deck] !~ /\.early/) fault(deck, "its results have no mark ENDED EARLY")
      if (kind[deck] == "bad" && said[deck] != 2) fault(deck, "no valid deck, and ended with status " said[deck])
      if (has_listing) read_listing(deck, results "/" deck ".out")
      names = split(files[deck], file, " ")
      for (k = 1; k <= names; k++) if (file[k] ~ /\.part/) fault(deck, "left behind: " file[k])
      for (k = 1; k <= names; k++) {
         if (file[k] ~ /\.csv$/) read_table(deck, results "/" file[k])
         if (file[k] ~ /\.vtu$/) read_vtu(deck, results "/" file[k])
      }
      if (said[deck] > highest) highest = said[deck]
      if (statuses != "") print deck, said[deck] > statuses
   }
   if (status != highest) fault("-", "exit status " status ", where what it says means " highest + 0)
}
