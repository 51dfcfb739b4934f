#!/usr/bin/env bash
# The fuzzer itself: it notices every fault that it is there for, and makes the same decks again.
#
#     selftest.sh
#
# Ends with "N passed, N failed"; exit status 1 if anything failed.
set -u
export LC_ALL=C
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 2
passed=0 failed=0

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
   awk -v status="$status" -v results=results -v statuses=statuses -f "$here/judge.awk" list stderr > verdict
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
early='fuzz_1.bdf: no equilibrium; the results end there'

run 2 bad "$refusal"; holds 'a deck refused' good
run 0 mild '' fuzz_1.out ' A' fuzz_1.joint.csv 1,2; holds 'a deck solved' good
run 3 wild "$unsolved"; holds 'a structure refused' good
run 3 wild "$early" fuzz_1.out ' *** THE RUN ENDED EARLY ***'; holds 'a run that ended early' good
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
   awk -v seed=5 -v from="$1" -v to="$2" -v folder="$3" -f "$here/random.awk" -f "$here/damage.awk" -f "$here/cards.awk" \
      -f "$here/changes.awk" -f "$here/decks.awk" "$root/input/README.md" "$root"/tests/fuzz/decks/*.bdf "$root"/input/prism*.bdf > "$3/list"
}
decks 1 60 all
decks 1 60 again
decks 37 37 one
holds 'the same decks again' diff -r all again
holds 'a deck does not depend on the others' cmp -s all/fuzz_37.bdf one/fuzz_37.bdf
holds 'decks of every kind' [ "$(cut -d' ' -f2 all/list | sort -u | tr '\n' ' ')" = 'bad mild wild ' ]
holds 'decks that differ' [ "$(cat all/*.bdf | cksum)" != "$(decks 61 120 other; cat other/*.bdf | cksum)" ]

echo "$passed passed, $failed failed"
[ $failed -eq 0 ]
