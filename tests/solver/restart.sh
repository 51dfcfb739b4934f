#!/usr/bin/env bash
# Runs that are killed and resumed from their restart files, compared byte for byte with uninterrupted runs; restart files that are
# damaged, truncated, or of another deck.
#
#    restart.sh PROGRAM WORK_FOLDER [SEED]
#
# SIGKILL ends a run before its n-th call that allocates memory or writes, renames or removes a file (kill_at.c), n at random but
# the same for the same SEED. Without a C compiler a run is killed after a random time.
set -u
export LC_ALL=C
program=$(realpath "$1") work=$2 seed=${3:-20260114}
here=$(cd "$(dirname "$0")" && pwd)
input=$(realpath "$here/../../input") make_deck=$(realpath "$here/../bench/make_deck.sh")
wanted=60 # kills
passed=0 failed=0
rm -rf "$work"
mkdir -p "$work/decks"
cd "$work" || exit 2
RANDOM=$seed

pass() { passed=$((passed + 1)); }
fail() { failed=$((failed + 1)); echo "FAILED: $1"; }
draw() { drawn=$(((RANDOM*32768 + RANDOM) % $1 + 1)); } # 1 to $1; in a subshell it would be the same again and again

killer=
if command -v "${CC:-cc}" >/dev/null && "${CC:-cc}" -O2 -shared -fPIC -o kill_at.so "$here/kill_at.c" -ldl 2>/dev/null; then
   killer=$PWD/kill_at.so
else
   echo 'no C compiler: runs are killed after a random time'
fi

# ------------------------------------------------------------------ decks

# deck NAME AS ENTRIES: input/NAME.bdf as AS, with ENTRIES (and RESTART) above the first SUBCASE in place of its own of these names
deck() {
   local name=$1 as=$2 entries=$3 keys
   keys=$(echo "$entries" | sed 's/ *=[^;]*;\{0,1\}/|/g; s/|$//; s/ //g')
   awk -v entries="$entries" -v keys="^ *($keys) *=" '
      !bulk && $0 ~ keys { next }
      !done && /^(SUBCASE|BEGIN)/ { gsub(/; */, "\n", entries); print entries; done = 1 }
      /^BEGIN/ { bulk = 1 }
      { print }' "$input/$name.bdf" > "decks/$as.bdf"
}

cp "$input"/*.inc decks 2>/dev/null
for deck in $(sed -n "s/^INCLUDE *'\([^']*\)'.*/\1/p" "$input"/*.bdf); do
   mkdir -p "decks/$(dirname "$deck")"; cp "$input/$deck" "decks/$deck"
done
deck prism_history step        'RESTART = 2; SOLVER = TREE'
deck prism_history skyline     'RESTART = 1; SOLVER = SKYLINE; CARRY = YES'
deck prism10       steps       'RESTART = 1; OUTPUT = ALL, VTU, STEPS, STATE'
deck prism_cycle   newton      'RESTART = 3; SOLVER = SKYLINE'
deck prism_back    back        'RESTART = 0'
deck friction_once friction    'RESTART = 1; OUTPUT = JOINT'
deck shear_cycles  cycles      'RESTART = 4'
sed -i 's/^+ *1\.0 *0\.012 *$/+,1.0,0.012,BRANCH/' decks/cycles.bdf # branches that remember where they began
deck gib           gaps        'RESTART = 1; SOLVER = TREE'
deck flange_warm   warm        'RESTART = 1; SOLVER = TREE'
deck bolted_cantilever bolts   'RESTART = 2; SOLVER = SKYLINE'
deck bracket_spiders spiders   'RESTART = 1'
deck flange_sector sector     'RESTART = 1'
deck solid_bolt    solid       'RESTART = 1'
sed -i 's/^BOLT  .*/&\nBOLT,9,,8000.,2,40/' decks/solid.bdf # tightened again in the second stage
deck cantilever_cases cases    'RESTART = 1; SOLVER = TREE; INCR = 5' # states kept for later stages
sed -i 's/^ENDDATA/JINCR,5,2\nENDDATA/' decks/cases.bdf
deck column_tetra10 bodies     'RESTART = 1'
deck by_hand       hand        'RESTART = 1'
deck bolted_lap    backbone   'RESTART = 0; SOLVER = TREE'
deck meshed_apart  apart       'RESTART = 0; SOLVER = SKYLINE'
deck bolted_lap    iwan        'RESTART = 1; SOLVER = TREE' # its friction by Iwan's law
awk '/^PJOINT/ { print "PJOINT,1,1,,,,,12.0,9"; print "+,12.0"; print "JIWAN,9,1.2,2000.,-0.5,0.1"; next } { print }' decks/iwan.bdf > iwan.new
mv iwan.new decks/iwan.bdf
sed -i 's/^JAMPL .*/JAMPL,6,1,0.1,2,0.01,0,2/; s/^+ *1\.0-6 *$/+,1.0-3/' decks/backbone.bdf decks/iwan.bdf # two amplitudes will do
# the factor of an increment serves others: 1,300 unknowns of joints
"$make_deck" hex8_18x18x6 TREE NONE | sed 's/^SPC = .*/&\nRESTART = 3/' > decks/factors.bdf
# supports, held anew and released, and an equation that comes and goes
tr ';' '\n' > decks/supports.bdf <<'DECK'
METHOD = NEWTON;INCR = 2;RESTART = 1
SUBCASE 1;SPC = 1;LOAD = 12
SUBCASE 2;SPC = 2;LOAD = 20
SUBCASE 3;SPC = 1;LOAD = 20
SUBCASE 4;SPC = 2;LOAD = 4
SUBCASE 5;SPC = 1;MPC = 5;LOAD = 25
SUBCASE 6;FROM = 2;SPC = 1;LOAD = 12
BEGIN BULK;BLOCK2,1,1,1,1,0.0,0.0;+,8.0,5.0;+,5
PSHELL,1,1,2.0;MAT1,1,9500.0,,0.0
PMARK,5;JOINT,1,1,5;PJOINT,1,1;JNORM,1,8.0-3,0.5,1000.0
SPC1,1,1,1,2,3,4;SPC1,3,2,2,4;SPCADD,2,1,3;JINCR,2,4;MPC,5,2,2,1.0,4,2,-1.0
FORCE,1,2,,0.75,0.0,-1.0;FORCE,1,4,,0.25,0.0,-1.0
LOAD,12,1.0,12.0,1;LOAD,20,1.0,20.0,1;LOAD,25,1.0,25.,1;SPCD,4,2,2,-0.001;SPCD,4,4,2,-0.001;ENDDATA
DECK
decks='step skyline steps newton back friction cycles gaps warm bolts spiders sector solid cases bodies hand apart backbone iwan factors supports'

# whole NAME: the run in peace, in NAME.whole, what it says in NAME.said, and how many calls it makes
whole() {
   mkdir "$1.whole"
   timeout 60 env KILL_COUNT=calls LD_PRELOAD="$killer" "$program" -q --threads 1 -o "$1.whole" "decks/$1.bdf" > "$1.said" 2> "$1.error"
   status=$?
   calls=5000
   [ -n "$killer" ] && read -r calls < calls
   rm -f calls
   echo "$calls" > "$1.calls"
   if [ $status -eq 0 ] && [ -s "$1.whole/$1.restart" ]; then pass; else fail "$1: status $status, $(head -n 2 "$1.error")"; fi
}
for name in $decks; do whole "$name"; done

# ------------------------------------------------------------------ killed and resumed, again and again

# resume NAME AT: go on with NAME in NAME.now, to be killed at AT (0: not)
resume() {
   local name=$1 at=$2
   if [ "$at" -gt 0 ] && [ -n "$killer" ]; then
      timeout 60 env KILL_AT="$at" LD_PRELOAD="$killer" "$program" -q --threads $((1 + RANDOM % 2)) --resume -o "$name.now" \
         "decks/$name.bdf" > now.said 2> now.error
   elif [ "$at" -gt 0 ]; then
      timeout -s KILL "$(awk -v at="$at" 'BEGIN { printf "%.4f", at*2e-5 }')" "$program" -q --resume -o "$name.now" \
         "decks/$name.bdf" > now.said 2> now.error
   else
      timeout 60 "$program" -q --threads $((1 + RANDOM % 2)) --resume -o "$name.now" "decks/$name.bdf" > now.said 2> now.error
   fi
   status=$?
   grep -q ': resumed from' now.error && taken=$((taken + 1))
} 2>/dev/null

# same NAME: the results in NAME.now are those of the run in peace, the restart file too, and what is said
same() {
   local name=$1
   if [ $status -ne 0 ]; then fail "$name: status $status, $(head -n 1 now.error)"
   elif ! diff -rq "$name.whole" "$name.now"; then fail "$name: resumed, it has other results"
   elif ! diff <(sed "s#$name.whole#FOLDER#g" "$name.said") <(sed "s#$name.now#FOLDER#g" now.said); then fail "$name: other answers"
   elif ! diff "$name.error" <(grep -v ': resumed from\|: there is no .*, the run starts' now.error); then fail "$name: other words"
   else pass
   fi
}

kills=0 taken=0
while [ $kills -lt $wanted ]; do
   for name in $decks; do
      rm -rf "$name.now"; mkdir "$name.now"
      for ((k = 0; k < 4; k++)); do
         read -r calls < "$name.calls"
         draw "$calls"
         [ $((RANDOM % 2)) -eq 0 ] && drawn=$((calls - drawn/3)) # half of them late: much of a short run is reading the deck
         resume "$name" "$drawn"
         if [ $status -eq 137 ]; then
            kills=$((kills + 1))
            # what has its name is complete: of the results those that the end of the run had named already
            for file in "$name.now"/*; do
               case $file in
                  *.part|*.restart|*\*) ;;
                  *) cmp -s "$file" "$name.whole/${file##*/}" || fail "$name: killed, it left $file";;
               esac
            done
            rm -f "$name.now"/*.part
         elif [ $status -eq 0 ]; then break
         else fail "$name: killed at random, it ended with status $status, $(head -n 1 now.error)"; break
         fi
      done
      resume "$name" 0
      same "$name"
      rm -rf "$name.now"
   done
done
echo "$kills kills (seed $seed), $taken times a run was taken up"
if [ $taken -ge $((wanted/4)) ]; then pass; else fail "too few runs were taken up: $taken"; fi

# ------------------------------------------------------------------ what is said

# check WHAT STATUS WORDS: of the last run
check() {
   if [ "$status" -ne "$2" ]; then fail "$1: status $status, expected $2: $(head -n 1 now.error)"
   elif ! grep -q "$3" now.error; then fail "$1: no '$3' in '$(head -n 1 now.error)'"
   else pass
   fi
}
mkdir hand.now
resume hand 0;                            check 'no restart file' 0 'there is no hand.now/hand.restart, the run starts from the beginning'
same hand
resume hand 0;                            check 'a complete run' 0 'where the run is complete; its results are written again'
same hand
"$program" -q --resume - < decks/hand.bdf > now.said 2> now.error; status=$?
check 'a deck from the standard input' 1 'a deck from the standard input has no restart file'
rm -rf hand.now; mkdir hand.now; mkdir hand.now/hand.restart
"$program" -q -o hand.now decks/hand.bdf > now.said 2> now.error; status=$?
check 'a restart file that cannot be written' 4 'the restart file hand.now/hand.restart cannot be written; the run continues'
rmdir hand.now/hand.restart
diff -rq -x '*.restart' hand.whole hand.now && pass || fail 'a restart file that cannot be written: other results'
mkdir factors.now # room for the results, which are smaller
room=$((($(stat -c %s factors.whole/factors.restart) + $(stat -c %s factors.whole/factors.joint.csv))/2048))
(trap '' XFSZ; ulimit -f $room; exec "$program" -q --threads 1 -o factors.now decks/factors.bdf) > now.said 2> now.error; status=$?
check 'a restart file that there is no room for' 4 'the restart file factors.now/factors.restart cannot be written; the run continues'
diff -rq -x '*.restart' factors.whole factors.now && pass || fail 'no room for a restart file: other results, or a part of it'
resume factors 0;                         check 'the older restart file, which stays' 0 ': resumed from'
same factors
mkfifo hand.now/hand.restart
resume hand 0;                            check 'a pipe as restart file' 1 'it cannot be read'
rm -rf hand.now; mkdir hand.now

# ------------------------------------------------------------------ damaged, cut, of others: refused, and nothing is changed

echo 'an older listing' > hand.now/hand.out
cp hand.whole/hand.restart sound
size=$(stat -c %s sound)

# refused WHAT WORDS: with the file that is there
refused() {
   resume hand 0
   if [ $status -ne 1 ] || ! grep -q "hand.now/hand.restart cannot be resumed: .*$2" now.error; then
      fail "$1: status $status, '$(head -n 1 now.error)'"
   elif [ "$(ls hand.now)" != $'hand.out\nhand.restart' ] || [ "$(cat hand.now/hand.out)" != 'an older listing' ]; then
      fail "$1: refused, but files have changed"
   else pass
   fi
}
# flip BYTE: invert some bits of it
flip() {
   local old
   cp sound hand.now/hand.restart
   old=$(od -An -tu1 -j "$1" -N 1 sound)
   draw 255
   printf "\\x$(printf %x $((old ^ drawn)))" | dd of=hand.now/hand.restart bs=1 seek="$1" conv=notrunc status=none
}
for ((k = 0; k < 16; k++)); do flip $k; refused "byte $k of the head damaged" 'it is not a restart file'; done
for ((k = 16; k < 48; k++)); do flip $k; refused "byte $k of the head damaged" 'it is damaged'; done
# --check --resume says what a run would find, solves nothing and leaves all files as they are
looked() { # WHAT STATUS WORDS
   cp hand.now/hand.restart before
   "$program" --check --resume -o hand.now decks/hand.bdf > now.said 2> now.error; status=$?
   check "$1" "$2" "$3"
   if cmp -s before hand.now/hand.restart; then pass; else fail "$1: the restart file has changed"; fi
}
cp sound hand.now/hand.restart; looked '--check of a sound restart file' 0 'hand.now/hand.restart is complete and belongs to this deck and this program'
flip 17;                        looked '--check of a damaged restart file' 1 'hand.now/hand.restart cannot be resumed: it is damaged'
cp step.whole/step.restart hand.now/hand.restart; looked '--check of the restart file of another deck' 1 'it belongs to another deck'

for ((k = size - 16; k < size; k += 3)); do flip $k; refused "byte $k of the end damaged" 'it is damaged'; done
for ((k = 0; k < 60; k++)); do
   draw $((size - 64))
   at=$((47 + drawn))
   flip $at; refused "byte $at damaged" 'its checksum is wrong'
done
draw "$size"
for n in 0 1 15 16 17 47 48 49 63 64 65 $((size/2)) $((size - 17)) $((size - 16)) $((size - 8)) $((size - 1)) $((drawn - 1)); do
   head -c "$n" sound > hand.now/hand.restart; refused "cut to $n bytes" ''
done
{ cat sound; printf '\0'; } > hand.now/hand.restart;           refused 'a byte too many' 'its length is wrong'
{ head -c $((size/2)) sound; cat sound; } > hand.now/hand.restart; refused 'a half and a whole' 'its length is wrong'
{ head -c 20 sound; printf '\1\2\3\4'; tail -c +25 sound; } > hand.now/hand.restart # written by a processor such as SPARC
cmp -s sound hand.now/hand.restart || refused 'the other order of bytes' 'another byte order'
cp decks/hand.bdf hand.now/hand.restart;                       refused 'a deck' 'it is not a restart file'
cp step.whole/step.restart hand.now/hand.restart;              refused 'the file of another deck' 'it belongs to another deck'
cp sound hand.now/hand.restart
echo '$ a remark' >> decks/hand.bdf;                            refused 'a deck that has been changed' 'it belongs to another deck'

echo "$passed passed, $failed failed"
[ $failed -eq 0 ]
