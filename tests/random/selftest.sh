#!/usr/bin/env bash
# The two fuzzers themselves: their judges notice every fault that they are there for, and they make the same decks again.
#
#     selftest.sh PROGRAM FOLDER
#
# Ends with "N passed, N failed"; exit status 1 if anything failed.
set -u
export LC_ALL=C
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
program=$(realpath "$1")
rm -rf "$2"
mkdir -p "$2"/{fuzz,pairs/sound}
cd "$2/fuzz" || exit 2
passed=0 failed=0

# ---- damaged decks ----

# holds WHAT COMMAND...
holds() {
   local what=$1
   shift
   if "$@"; then passed=$((passed + 1)); else failed=$((failed + 1)); echo "FAILED: $what"; fi
}

# run STATUS KIND WORDS [FILE CONTENT]...: a run of the deck fuzz_1 as it may be; what the judge says of it goes to `verdict`
run() {
   local status=$1
   rm -rf results
   mkdir results
   echo "fuzz_1 $2" > list
   printf '%s\n' "$3" > stderr
   shift 3
   while [ $# -gt 1 ]; do if [ -e "$2" ]; then cp "$2" "results/$1"; else printf '%s\n' "$2" > "results/$1"; fi; shift 2; done
   awk -v status="$status" -v results=results -v statuses=statuses -f "$here/fuzz_judge.awk" list stderr > verdict
}
# vtu BYTES: the name of a file for ParaView whose values, 1 and 2 of a point, 3 of a cell, end in four BYTES of 3
vtu() {
   printf '%-16383s_' '<VTKFile>
   <Piece NumberOfPoints="2" NumberOfCells="1">
   <PointData>
   <DataArray type="Int32" Name="node" format="appended" offset="0"/>
   <DataArray type="Float64" Name="u" format="appended" offset="16"/>
   </PointData>
   <CellData>
   <DataArray type="Float64" Name="s" format="appended" NumberOfComponents="1" offset="40"/>
   </CellData>
</UnstructuredGrid>' > sample.vtu
   printf "\\x08$zero7\\xff\\xff\\xff\\xff\\xff\\xff\\xff\\x7f\\x10$zero7$zero7\\x40$zero7\\x40\\x08${zero7}NaN $1" >> sample.vtu
   echo sample.vtu
}
zero7='\x00\x00\x00\x00\x00\x00\x00'
good() { [ ! -s verdict ]; }
finds() { grep -q "$1" verdict; }

refusal='fuzz_1.bdf: 2 errors, nothing solved'
unsolved='fuzz_1.bdf: node 3 has no stiffness along y; no results'

run 2 bad "$refusal"; holds 'a deck refused' good
run 0 mild '' fuzz_1.out ' A' fuzz_1.joint.csv 1,2; holds 'a deck solved' good
run 3 wild "$unsolved"; holds 'a structure refused' good
for at in there 'at stage 2, increment 5'; do
   early="fuzz_1.bdf: no equilibrium; the results end $at"
   run 3 wild "$early" fuzz_1.out ' *** THE RUN ENDED EARLY ***' fuzz_1.early 'ENDED EARLY'; holds "a run that ended early, $at" good
done
run 3 wild "$early" fuzz_1.out ' *** THE RUN ENDED EARLY ***'; holds 'a run that ended early' finds 'its results have no mark ENDED EARLY'
run 0 mild '' fuzz_1.out "$(printf ' DECK ECHO\nGRID****** NaN\n  TOTAL COUNT 1 CARDS\n 1.0')"; holds 'an echo that looks bad' good
run 0 mild ''; holds 'no word, no result' finds 'without a word'
run 2 wild "$refusal" fuzz_1.out ' A'; holds 'a result of a refused deck' finds 'refused, and left'
run 3 wild "$unsolved" fuzz_1.joint.csv 1,2; holds 'a result of a refused structure' finds 'refused, and left'
run 3 wild "$early"; holds 'a result said to be there' finds 'are not'
run 0 bad '' fuzz_1.out ' A'; holds 'a result of a bad deck' finds 'no valid deck'
run 3 bad "$unsolved"; holds 'a bad deck taken for a bad structure' finds 'no valid deck'
run 0 mild '' fuzz_1.out '  1.0  NaN'; holds 'NaN in a listing' finds NaN
run 0 mild '' fuzz_1.out '  1.0 -Infinity  2.0'; holds 'Infinity in a listing' finds Infinity
run 0 mild '' fuzz_1.out '  1.0 ******** 2'; holds 'asterisks in a listing' finds 'listing holds'
run 0 mild '' fuzz_1.out ' A' fuzz_1.joint.csv '1,NaN,2'; holds 'NaN in a history' finds 'joint.csv holds'
run 0 mild '' fuzz_1.out ' A' fuzz_1.1.vtu "$(vtu 'NaN\x40')"; holds 'a file for ParaView whose bytes spell NaN' good
run 0 mild '' fuzz_1.out ' A' fuzz_1.1.vtu "$(vtu '\x00\x00\xf8\x7f')"; holds 'NaN in a file for ParaView' finds 'vtu holds'
run 0 mild '' fuzz_1.out ' A' fuzz_1.1.vtu '0.0'; holds 'no file for ParaView' finds 'vtu holds no arrays'
run 0 mild '' fuzz_1.out ' A' fuzz_1.joint.csv.part '1'; holds 'a part file' finds 'left behind'
run 3 wild 'fuzz_1.bdf: the residual is NaN; no results'; holds 'NaN in a message' finds 'it says'
run 139 mild 'Program received signal SIGSEGV: Segmentation fault' fuzz_1.out ' A'; holds 'a crash' finds SIGSEGV
run 2 wild "$(printf '%s\nFortran runtime error: Bad integer' "$refusal")"; holds 'a run-time error' finds 'Bad integer'
run 0 mild 'src/a.f90:1:2: runtime error: signed integer overflow' fuzz_1.out ' A'; holds 'undefined behaviour' finds overflow
run 0 mild '==1==ERROR: LeakSanitizer: detected memory leaks' fuzz_1.out ' A'; holds 'a leak' finds LeakSanitizer
run 0 mild "$refusal"; holds 'a status that is not what is said' finds 'exit status 0'
run 3 mild '' fuzz_1.out ' A'; holds 'a status without a word' finds 'exit status 3'

# decks FROM TO FOLDER: decks of seed 5
decks() {
   mkdir -p "$3"
   awk -v seed=5 -v from="$1" -v to="$2" -v folder="$3" -f "$here/random.awk" -f "$here/fuzz_damage.awk" -f "$here/fuzz_cards.awk" \
      -f "$here/fuzz_changes.awk" -f "$here/fuzz_decks.awk" "$root/input/cards.md" "$root"/tests/random/*.bdf "$root"/input/prism*.bdf > "$3/list"
}
decks 1 60 all
decks 1 60 again
decks 37 37 one
holds 'the same decks again' diff -r all again
holds 'a deck does not depend on the others' cmp -s all/fuzz_37.bdf one/fuzz_37.bdf
holds 'decks of every kind' [ "$(cut -d' ' -f2 all/list | sort -u | tr '\n' ' ')" = 'bad mild wild ' ]
holds 'decks that differ' [ "$(cat all/*.bdf | cksum)" != "$(decks 61 120 other; cat other/*.bdf | cksum)" ]

# ---- pairs of features ----

cd ../pairs || exit 2

# pairs FROM TO FOLDER
pairs() {
   mkdir -p "$3"
   awk -v seed=11 -v from="$1" -v to="$2" -v folder="$3" -f "$here/random.awk" -f "$here/pairs_features.awk" -f "$here/pairs_model.awk" \
      -f "$here/pairs_write.awk" > "$3/list"
}

pairs 1 40 all
pairs 1 40 again
pairs 17 17 one
holds 'the same decks again' diff -r all again
holds 'a deck does not depend on the others' cmp -s all/d17a.bdf one/d17a.bdf
holds 'decks that differ' [ "$(cat all/*.bdf | cksum)" != "$(pairs 41 80 other; cat other/*.bdf | cksum)" ]

# of: the first solved deck in the list with METHOD (2nd word) and the features named
of() { awk -v method="$1" -v wanted="$2" '$1 == "DECK" && $4 == method { n = split(wanted, w, " "); for (k = 1; k <= n; k++) if (!index($0 " ", " " w[k] " ")) next
   if (/ part/) next
   print $2; exit }' list; }

# judge: what it says of the results in `now`
judge() { awk -v folder=now -v tallies=tallies -f "$here/pairs_judge.awk" "$1" messages > verdict; }

# prepare NUMBER: the deck's results, sound
prepare() {
   rm -rf sound
   mkdir sound
   awk -v n="$1" '$1 == "DECK" { on = $2 == n } on' list > one_list
   for v in a t r m q u; do "$program" -q --threads 1 -o sound "made/d$1$v.bdf" > /dev/null 2> messages; done
   : > messages
   fresh
   judge one_list
   holds "deck $1, as it is" [ ! -s verdict ]
   number=$1
}
fresh() { rm -rf now; cp -r sound now; }

# change FILE COLUMN EXPRESSION [CONDITION]: in the last row of a CSV file that meets CONDITION; x is the column
change() {
   awk -F, -v OFS=, -v column="$2" 'NR == FNR { if (FNR == 1) for (i = 1; i <= NF; i++) c[$i] = i; else if ('"${4:-1}"') last = FNR; next }
      FNR == last { x = $c[column]; $c[column] = '"$3"' } { print }' "$1" "$1" > changed && mv changed "$1"
}

# finds WHAT WORDS: the judge says WORDS of what has been changed
finds() { judge one_list; holds "$1" grep -q "$2" verdict; fresh; }

pairs 1 400 made
mv made/list list

prepare "$(of NEWTON 'modes bolt vtu friction')"
change now/d${number}t.joint.csv pressure 'x * 1.00001';         finds 'another pressure by the other solver' 'pressure, t is off'
change now/d${number}r.joint.csv lambda 'x * 1.0001';            finds 'another deflection, renumbered' 'lambda, r is off'
change now/d${number}m.joint.csv force 'x + 1';                  finds 'another force, mirrored' 'force, m is off'
change now/d${number}u.joint.csv area 'x * 1.001';               finds 'another area in other units' 'area, u is off'
change now/d${number}q.joint.csv x 'x + 1' 'FNR == 2';           finds 'another place, turned' 'place of an element, q is off'
change now/d${number}a.joint.csv pressure 'x * 1.001' '$c["branch"] == "LOAD"'; finds 'off the loading curve' 'LOAD is off'
change now/d${number}a.joint.csv force 'x * 1.001';              finds 'a force that is not p a' 'force = p a is off'
change now/d${number}a.joint.csv tau_x 'x + 100';                finds 'more than friction' 'friction is off'
change now/d${number}a.joint.csv area 'x * 1.01' 'FNR == 2';     finds 'areas' 'area of joint'
change now/d${number}a.joint.csv pressure -1e-3;                 finds 'a pull' ': p -'
change now/d${number}a.joint.csv branch '"OPEN"';                finds 'open under pressure' 'open, with p'
change now/d${number}r.joint.csv branch '"OPEN"';                finds 'another branch' 'branch OPEN for'
change now/d${number}t.joint.csv slip '1 - x';                   finds 'another slip' 'slip . for'
sed -i '$d' now/d${number}t.joint.csv;                           finds 'a row less' 'rows, the model'
change now/d${number}m.modes.csv frequency 'x * 1.0001';         finds 'another frequency' 'frequency, m is off'
change now/d${number}u.bolt.csv force 'x * 1.0001';              finds 'another bolt' 'force, u is off'
change now/d${number}t.stage.csv u_max 'x * 1.0001';             finds 'another displacement' 'u_max of the answer, t'
change now/d${number}r.stage.csv p_max 'x * 1.0001';             finds 'another largest pressure' 'p_max of the answer, r'
awk '/BALANCE OF FORCES/ { on = 1 } on && /^  SUM/ { $NF = "1.0000E+01"; $0 = "  " $0; on = 0 } { print }' sound/d${number}a.out > now/d${number}a.out
finds 'no balance' 'balance of forces is off'
grep -v 'BALANCE OF FORCES' sound/d${number}a.out > now/d${number}a.out; finds 'a balance less' 'balances for'
# taken VARIANT FIELD EXPRESSION: another energy in the last row of the listing of a variant; x is the field
taken() {
   awk -v field="$2" '/^ [A-Z]/ { on = /^ ENERGY OF JOINTS/ } NR == FNR { if (on && NF == 8 && $1 ~ /^[0-9]+$/) last = FNR; next }
      FNR == last { x = $field; $field = '"$3"' } { print }' sound/d${number}$1.out sound/d${number}$1.out > now/d${number}$1.out
}
taken a 8 '-1';                                                   finds 'less than nothing lost by sliding' 'energy 7 is -'
taken a 5 'x * 1.001';                                           finds 'more put in than is kept, given back and lost' 'put in of shear is off'
taken a 2 'x * 1.001';                                           finds 'more put in by normal forces' 'put in of normal forces is off'
taken r 7 'x + 1e6';                                             finds 'another energy, renumbered' 'energies of joints, r is off'
awk '/^ [A-Z]/ { on = /^ ENERGY OF JOINTS/ } on && NF == 8 && $1 ~ /^[0-9]+$/ { for (i = 2; i <= 8; i++) $i *= 3 } { print }' sound/d${number}a.out > now/d${number}a.out
finds 'three times the work of the forces' 'work of .* is off'
grep -v 'ENERGY OF JOINTS' sound/d${number}a.out > now/d${number}a.out; finds 'no energies' 'rows of energies'
for file in now/d${number}a*joint.vtu; do head -c 16500 "$file" > changed; mv changed "$file"; done
finds 'a file for ParaView that ends too early' 'bytes long'
rm -f now/d${number}a*[0-9a].vtu now/d${number}a.vtu;            finds 'no file for ParaView' 'no now/'
rm now/d${number}u.*;                                            finds 'no results without a word' 'no results and no message'
echo "d${number}m.bdf: no equilibrium; no results" > messages;   finds 'one variant without an answer' 'some not: m:unsolved'
echo "d${number}m.bdf: 2 errors, nothing solved" > messages;     finds 'one variant refused' 'is refused'
: > messages

prepare "$(awk '$1 == "DECK" { n = $2; taken = $4 == "NEWTON" && !/ (mpc|part|gap|temp)/ } $1 == "CARRIES" && taken { print n; exit }' list)"
change now/d${number}a.stage.csv n 'x * 1.001';                  finds 'a normal force against statics' 'by statics is off'

echo "$passed passed, $failed failed"
[ $failed -eq 0 ]
