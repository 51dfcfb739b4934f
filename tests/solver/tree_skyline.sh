#!/usr/bin/env bash
# Every deck of input/ (four long ones by TREE alone), and the decks in this folder (moved supports, faces that slide, one for several
# threads, one large enough for an ordering by a coarse graph), by SOLVER = TREE and by SOLVER = SKYLINE: the same results. TREE
# with one thread and with two or three in turn, and for the decks of this folder 2, 3, 8 and 16, on whatever machine: the same bytes.
# ALL=yes in the environment: two and three for every deck.
#
#    tree_skyline.sh PROGRAM QUERY WORK_FOLDER
set -u
export LC_ALL=C
program=$1 query=$2 work=$3
here=tests/solver
. $here/lib.sh
passed=0 failed=0
rm -rf "$work"
mkdir -p "$work/tree" "$work/skyline" "$work/threads"
for kind in tree skyline; do
   for included in input/*/ $here/*.inc; do ln -s "$PWD/${included%/}" "$work/$kind/"; done # INCLUDE looks beside the deck
done

# run FOLDER DECK_FOLDER [OPTION...]: the deck NAME
run() {
   local folder=$1 decks=$2
   shift 2
   LD_PRELOAD=${preload-} "$program" -q "$@" -o "$work/$folder" "$work/$decks/$name.bdf" > "$work/$folder/$name.log" 2>&1 && return
   cat "$work/$folder/$name.log"
   return 1
}

same() {
   local suffix
   for suffix in out joint.csv; do
      cmp "$work/$1/$name.$suffix" "$work/$2/$name.$suffix" || return 1
   done
}

# a machine of many cores for the decks of this folder: the program takes no more threads than there are
export OMP_WAIT_POLICY=passive
many=$work/many_cores.so
echo 'int omp_get_num_procs_(void) { return 32; }' | ${CC:-cc} -shared -fPIC -x c -o "$many" - || exit 1

# minutes by SKYLINE
by_tree_alone='bolted_lap bracket brake_reuss flanged_column'

for deck in input/*.bdf $here/*.bdf; do
   name=$(basename "$deck" .bdf)
   tol=1.E-13 share=1e-9
   grep -qx "$name" tests/compare/ten_digits.txt && tol=1.E-10 share=1e-6
   [ "$name" != konter_friction ] || share=1e-8 # joints of 1E6 and 1E8 N/mm3 beside displacements of 1.5 mm: the last digits of these are 1E-10 N/mm2 and more
   with_solver "$deck" TREE $tol > "$work/tree/$name.bdf"
   with_solver "$deck" SKYLINE $tol > "$work/skyline/$name.bdf"
   compare_within $share
   words=
   if [[ " $by_tree_alone " = *" $name "* ]]; then
      if run tree tree --threads 1; then passed=$((passed + 1)) words='by TREE alone'; else failed=$((failed + 1)) words='FAILED to run'; fi
   elif run tree tree --threads 1 && run skyline skyline; then
      if words=$(same_history "$work/skyline/$name" "$work/tree/$name" &&
                 awk -v may_lack="$(grep -c '^ *OUTPUT *= *NONE' "$deck")" -f $here/compare.awk "$work/skyline/$name.out" "$work/tree/$name.out"); then
         passed=$((passed + 1))
      else
         failed=$((failed + 1)) words="FAILED $words"
      fi
   else
      failed=$((failed + 1)) words='FAILED to run'
   fi
   turn=$((5 - ${turn:-3})) list=$turn preload=
   [ -z "${ALL:-}" ] || list='2 3'
   [ "${deck#$here}" = "$deck" ] || list='2 3 8 16' preload=$many
   for threads in $list; do
      if run threads tree --threads "$threads" && same tree threads; then
         passed=$((passed + 1))
      else
         failed=$((failed + 1)) words="$words; FAILED with $threads threads"
      fi
   done
   printf '%-20s %s\n' "$name" "$words"
done
echo "$passed passed, $failed failed"
[ $failed -eq 0 ]
