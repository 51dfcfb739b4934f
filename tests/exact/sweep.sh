#!/usr/bin/env bash
# Numbers of any size, in three parts.
#
#     sweep.sh PROGRAM FOLDER [METHOD...]
#
# 1. A block under uniform pressure on its joint, which has an exact answer: 1,764 runs by NEWTON and by STEP, or by each METHOD
# named (E 1E-6 to 1E15, c 1E-12 to 1E6, m 0.001 to 1, pressure and size 1E-12 to 1E12, nu -0.99 to 0.4999999). Each run is correct
# to 1E-6 or ends with status 3.
# 2. The same problems in 13 systems of units, powers of ten apart: equal results, to 1E-9 of the largest value of each kind.
# 3. The width of fields: a deck with the largest numbers of everything, forces of 1E13, MU of 1000, long words; and overflow.
set -u
export LC_ALL=C
program=$(realpath "$1")
mkdir -p "$2/units" "$2/widths"
folder=$(cd "$2" && pwd)
shift 2
[ $# -gt 0 ] || set -- NEWTON STEP
here=$(cd "$(dirname "$0")" && pwd)
least=1000 # so many of 1,764 are no extremes
passed=0 failed=0

# sweep METHOD: prints what is wrong and the two counts; quietly in one go, as the shell takes the names of all decks
sweep() {
   local into=$folder/$1
   rm -rf "$into"
   mkdir -p "$into"
   awk -v method="$1" -v folder="$into" -f "$here/sweep_decks.awk" > "$into/list"
   (cd "$into" && "$program" -q --threads 1 -o . $(awk '{ print "d" $1 ".bdf" }' list) > out 2> err
    echo "status $?")
   awk -f "$here/sweep_judge.awk" "$into/list" "$into/err" "$into"/d*.joint.csv "$into"/d*.stage.csv
}

for method in "$@"; do sweep "$method" > "$folder/$method.log" & done
wait
for method in "$@"; do
   grep FAILED "$folder/$method.log" | head -n 20 | sed "s/:/: $method,/"
   wrong=$(grep -c FAILED "$folder/$method.log")
   read -r right three < <(tail -n 1 "$folder/$method.log")
   echo "$method: ${right:-0} runs right, ${three:-0} with status 3"
   passed=$((passed + ${right:-0} + ${three:-0}))
   failed=$((failed + wrong))
   if [ "${right:-0}" -lt $least ]; then
      echo "FAILED: $method: fewer than $least runs right"
      failed=$((failed + 1))
   fi
   if ! grep -qx 'status 3' "$folder/$method.log"; then
      echo "FAILED: $method: $(grep status "$folder/$method.log")"
      failed=$((failed + 1))
   fi
done

# ---- the same problems in 13 systems of units ----

cd "$folder/units" || exit 2
rm -f ./*
# systems: number, power of ten of the length, of the force; the first is that of the problem
systems() { awk 'BEGIN { print 0, 0, 0; for (i = 1; i <= 13; i++) print i, i - 7, 2*((5*i)%13 - 6) }'; }

for problem in block beams; do
   for method in STEP NEWTON BACK; do
      systems | while read -r n length force; do
         awk -v problem=$problem -v method=$method -v length_power="$length" -v force_power="$force" -f "$here/units_scaled.awk" \
            > "$problem-$method-$n.bdf"
      done
   done
done
"$program" -q --threads 1 -o . ./*.bdf > out 2> err
for problem in block beams; do
   for method in STEP NEWTON BACK; do
      while read -r n length force; do
         [ "$n" -eq 0 ] && continue
         for table in joint stage; do
            wrong=$(awk -v length_power="$length" -v force_power="$force" -v tolerance=1e-9 -f "$here/units_same.awk" \
                    "$problem-$method-0.$table.csv" "$problem-$method-$n.$table.csv" 2>&1 | head -n 3)
            if [ -z "$wrong" ]; then
               passed=$((passed + 1))
            else
               failed=$((failed + 1))
               echo "FAILED: $problem by $method, lengths by 1E$length, forces by 1E$force: $wrong"
            fi
         done
      done < <(systems)
   done
done

# ---- the largest numbers, and what overflows ----

cd "$folder/widths" || exit 2
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
   tr ';' '\n' > overflow.bdf << DECK
METHOD = $1;SPC = 1;SUBCASE 1;  LOAD = 1;  INCR = 1
BEGIN BULK;BLOCK2,1,1,2,1,0.0,0.0;+,2.0E-30,1.0E-30;+,20,21,22,23;PMARK,20;PMARK,22;PMARK,21;PMARK,23
PSHELL,1,1,1.0E-30;MAT1,1,$2,,0.3;JOINT,1,1,20;PJOINT,1,1,,,,,1.0;JNORM,1,1.0E-75,1.0,1.0E75;SPCM,1,1,23
FORCEM,1,$3,0.0,-1.0,0.0,22;JINCR,1,2;ENDDATA
DECK
   rm -f overflow.out
   check "$1, $3 on an area of 2E-60: status" "$(run overflow)" 3
   check "$1, $3: where" "$(grep -c 'stage 1, increment [12].*: .* \(at\|of\) \(node\|interface element\) [0-9]* ' overflow.err)" 1
   check "$1, $3: no listing" "$(find . -name 'overflow.out' | wc -l)" 0
}
for method in STEP NEWTON BACK; do overflow $method 1.0E50 1.0E70; done

# beyond E FORCE TIMES WORDS: a block of next to no section, 2E-60, that TIMES the FORCE stretches; WORDS say what is beyond all measure
beyond() {
   tr ';' '\n' > beyond.bdf << DECK
SPC = 1;SUBCASE 1;  LOAD = 2;  INCR = 1
BEGIN BULK;BLOCK2,1,1,2,1,0.0,0.0;+,2.0E-30,1.0E-30;+,20,,22;PMARK,20;PMARK,22;PSHELL,1,1,1.0E-30;MAT1,1,$1,,0.3
SPCM,1,12,20;FORCEM,1,$2,0.0,1.0,0.0,22;LOAD,2,$3,1.0,1;JINCR,1,2;ENDDATA
DECK
   rm -f beyond.out
   check "E $1, $2 times $3 on an area of 2E-60: status" "$(run beyond)" 3
   check "E $1, $2 times $3: what is too large, and where" "$(grep -c "stage 1, increment [12].*: $4 .*is .*too large" beyond.err)" 1
   check "E $1, $2 times $3: no listing" "$(find . -name 'beyond.out' | wc -l)" 0
}
beyond 1.0E-50 1.0E70 1.0 'the displacement of node'       # E-30 F/(E A)
beyond 1.0E70 1.0E70 1.0E40 'the load of node'
beyond 1.0E50 1.0E70 1.0 'the stress of element'           # F/A, at a displacement of 1E50

echo "$passed passed, $failed failed"
[ $failed -eq 0 ]
