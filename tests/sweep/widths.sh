#!/usr/bin/env bash
# What fields hold: a deck of the largest numbers of everything, forces of 1E13, MU of 1000, long words; and what overflows.
#
#     widths.sh PROGRAM FOLDER
#
# Ends with "N passed, N failed".
set -u
export LC_ALL=C
program=$(realpath "$1")
mkdir -p "$2"
folder=$(cd "$2" && pwd)
here=$(cd "$(dirname "$0")" && pwd)
passed=0 failed=0
cd "$folder" || exit 2
rm -f ./*

check() { if [ "$2" = "$3" ]; then passed=$((passed + 1)); else failed=$((failed + 1)); echo "FAILED: $1: '$2', expected '$3'"; fi; }

# stars FILE: lines with stars that say nothing, behind the echo of the deck and but for powers, the mark of p in a picture and the end
stars() { awk '/MODEL SUMMARY/ { body = 1 } body && !/\*\*M|D\*\*[23]|^  \*  P  |0 TO 9|^ \*\*\* THE RUN/ && /\*/' "$1" | grep -v 'I---\|+---' | grep -c '\*\*\|[0-9]\*'; }

run() { "$program" -q --threads 1 -o . "$1.bdf" > "$1.log" 2> "$1.err"; echo $?; }

for method in STEP NEWTON; do
   sed "s/METHOD = STEP/METHOD = $method/" "$here/largest.bdf" > "largest_$method.bdf"
   check "$method, largest numbers: status" "$(run "largest_$method")" 0
   check "$method: no stars in the listing" "$(stars "largest_$method.out")" 0
   check "$method: none on the screen" "$(grep -c '\*' "largest_$method.log" "largest_$method.err" | cut -d: -f2 | tr '\n' ' ')" '0 0 '
   check "$method: no NaN, no Infinity" "$(cat largest_$method.* | grep -a -c -w -i -e nan -e infinity -e inf)" 0
   check "$method: MU stands there" "$(grep -c '2147483647   FRICTION MU =      1000   RE-ANALYSES    3' "largest_$method.out")" 1
   check "$method: the node stands there" "$(grep -c 'LARGEST DISPLACEMENT .* NODE 2147483644' "largest_$method.log")" 2
done

# one more is too many
sed 's/^SPC1,2147483647,1,2147483644/SPC1,2147483647,1,2147483648/' "$here/largest.bdf" > beyond.bdf
check 'node 2147483648: status' "$(run beyond)" 2
check 'node 2147483648: the message' "$(grep -c "'2147483648' is too large for an integer" beyond.err)" 1

# overflow METHOD E FORCE: a block of next to no area under a force that is a pressure beyond all measure there
overflow() {
   cat > overflow.bdf << DECK
METHOD = $1
SPC = 1
SUBCASE 1
  LOAD = 1
  INCR = 1
BEGIN BULK
BLOCK2,1,1,2,1,0.0,0.0
+,2.0E-30,1.0E-30
+,20,21,22,23
PMARK,20
PMARK,22
PMARK,21
PMARK,23
PSHELL,1,1,1.0E-30
MAT1,1,$2,,0.3
JOINT,1,1,20
PJOINT,1,1,,,,,1.0
JNORM,1,1.0E-75,1.0,1.0E75
SPCM,1,1,23
FORCEM,1,$3,0.0,-1.0,0.0,22
JINCR,1,2
ENDDATA
DECK
   rm -f overflow.out
   check "$1, $3 on an area of 2E-60: status" "$(run overflow)" 3
   check "$1, $3: where" "$(grep -c 'stage 1, increment [12].*: .* \(at\|of\) \(node\|interface element\) [0-9]* ' overflow.err)" 1
   check "$1, $3: no listing" "$(find . -name 'overflow.out' | wc -l)" 0
}
for method in STEP NEWTON BACK; do overflow $method 1.0E50 1.0E70; done

# beyond E FORCE TIMES WORDS: a block of next to no section, 2E-60, that TIMES the FORCE stretches; WORDS say what is beyond all measure
beyond() {
   cat > beyond.bdf << DECK
SPC = 1
SUBCASE 1
  LOAD = 2
  INCR = 1
BEGIN BULK
BLOCK2,1,1,2,1,0.0,0.0
+,2.0E-30,1.0E-30
+,20,,22
PMARK,20
PMARK,22
PSHELL,1,1,1.0E-30
MAT1,1,$1,,0.3
SPCM,1,12,20
FORCEM,1,$2,0.0,1.0,0.0,22
LOAD,2,$3,1.0,1
JINCR,1,2
ENDDATA
DECK
   rm -f beyond.out
   check "E $1, $2 times $3 on an area of 2E-60: status" "$(run beyond)" 3
   check "E $1, $2 times $3: what is too large, and where" "$(grep -c "stage 1, increment [12].*: $4 .*is .*beyond all measure" beyond.err)" 1
   check "E $1, $2 times $3: no listing" "$(find . -name 'beyond.out' | wc -l)" 0
}
beyond 1.0E-50 1.0E70 1.0 'the displacement of node'       # E-30 F/(E A)
beyond 1.0E70 1.0E70 1.0E40 'the load of node'
beyond 1.0E50 1.0E70 1.0 'the stress of element'           # F/A, at a displacement of 1E50

echo "$passed passed, $failed failed"
[ $failed -eq 0 ]
