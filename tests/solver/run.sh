#!/usr/bin/env bash
# Every deck of input/, and those beside this script, moved supports, one large enough for several threads, one large enough to be
# ordered by a coarse graph, by SOLVER = TREE and by SOLVER = SKYLINE: the same results. By TREE with one thread and with several: the same bytes.
#
#    run.sh PROGRAM WORK_FOLDER
set -u
program=$1 work=$2
here=tests/solver
passed=0 failed=0
rm -rf "$work"
mkdir -p "$work/tree" "$work/skyline" "$work/threads"
for kind in tree skyline; do
   for included in input/*/ $here/*.inc; do ln -s "$PWD/${included%/}" "$work/$kind/"; done # INCLUDE looks beside the deck
done

# with_solver DECK SOLVER: the deck with SOLVER above its other case control. NEWTON stops where its tolerance is met, not at the
# same place by both solvers: it has to go on to the last digits.
with_solver() {
   awk -v solver="$2" '
      toupper($0) ~ /^ *BEGIN +BULK/ { bulk = 1 }
      !bulk && toupper($0) ~ /^ *(SOLVER|TOL) *=/ { next }
      !bulk && !done && toupper($0) ~ /^ *(TITLE|UNITS|METHOD|SPC|SUBCASE)/ {
         print "SOLVER = " solver
         print "TOL = 1.E-13"
         done = 1
      }
      { print }' "$1"
}

# run FOLDER DECK_FOLDER [OPTION...]: the deck NAME
run() {
   local folder=$1 decks=$2
   shift 2
   "$program" -q "$@" -o "$work/$folder" "$work/$decks/$name.bdf" > "$work/$folder/$name.log" 2>&1 && return
   cat "$work/$folder/$name.log"
   return 1
}

same() {
   local suffix
   for suffix in out joint.csv; do
      cmp "$work/$1/$name.$suffix" "$work/$2/$name.$suffix" || return 1
   done
}

for deck in input/*.bdf $here/*.bdf; do
   name=$(basename "$deck" .bdf)
   with_solver "$deck" TREE > "$work/tree/$name.bdf"
   with_solver "$deck" SKYLINE > "$work/skyline/$name.bdf"
   words=
   if run tree tree --threads 1 && run skyline skyline; then
      if words=$(awk -f $here/compare.awk "$work/skyline/$name.joint.csv" "$work/skyline/$name.out" \
                 "$work/tree/$name.joint.csv" "$work/tree/$name.out"); then
         passed=$((passed + 1))
      else
         failed=$((failed + 1)) words="FAILED $words"
      fi
   else
      failed=$((failed + 1)) words='FAILED to run'
   fi
   for threads in 2 3; do
      if run threads tree --threads $threads && same tree threads; then
         passed=$((passed + 1))
      else
         failed=$((failed + 1)) words="$words; FAILED with $threads threads"
      fi
   done
   printf '%-20s %s\n' "$name" "$words"
done
echo "$passed passed, $failed failed"
[ $failed -eq 0 ]
