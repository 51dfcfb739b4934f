#!/usr/bin/env bash
# Compares every deck of input/ with its reference listing, joint history and other tables in reference_output/: first by diff,
# then, where the text differs, with a tolerance per quantity (tests/compare/tolerances.txt).
#
#    check.sh PROGRAM COMPARE WORK_FOLDER [NAME...]     all decks, or those named
#
# WORK_FOLDER/failed names the decks that failed. Prints the differences; fails on any difference, and on a missing or surplus
# reference.
set -u
program=$1 compare=$2 work=$3
shift 3
passed=0 failed=0
mkdir -p "$work"
: > "$work/failed"

fail() { echo "FAILED $1"; failed=$((failed + 1)); }

# run_decks NAME...: as many side by side as there are cores; the exit status of each into $work/NAME.status
run_decks() {
   local name
   for name; do rm -f "$work/$name.status" "$work/$name.out" "$work/$name".*.csv; done
   printf '%s\n' "$@" | sort -u | program=$program work=$work xargs -r -d '\n' -n 1 -P "$(nproc)" bash -c '
      "$program" -q -o "$work" "input/$1.bdf" > "$work/$1.log" 2>&1
      echo $? > "$work/$1.status"' run_decks
}

check_deck() {
   local name=$1 suffix status
   status=$(cat "$work/$name.status")
   if [ "$status" != 0 ]; then
      cat "$work/$name.log"
      fail "$name: exit status $status"
      return
   fi
   for suffix in out joint.csv stage.csv bolt.csv modes.csv modes.energy.csv response.csv backbone.csv; do
      local reference=reference_output/$name.$suffix actual=$work/$name.$suffix
      if [ ! -f "$reference" ]; then
         case $suffix in out|joint.csv) ;; *) continue ;; esac
         [ $suffix = joint.csv ] && grep -qx "$name" tests/compare/ten_digits.txt && continue
         fail "$name.$suffix: no reference; make accept CASE=$name takes the present result as one"
      elif cmp -s "$reference" "$actual"; then
         passed=$((passed + 1))
      elif "$compare" tests/compare/tolerances.txt "$reference" "$actual"; then
         passed=$((passed + 1))
      else
         fail "$name.$suffix"
      fi
   done
}

if [ $# -gt 0 ]; then
   names=$*
else
   names=$(for deck in input/*.bdf; do basename "$deck" .bdf; done)
   for reference in reference_output/*.out reference_output/*.csv; do
      name=$(basename "$reference"); name=${name%.out}; name=${name%.csv}
      for table in joint stage bolt energy modes response backbone; do name=${name%.$table}; done
      [ -f "input/$name.bdf" ] || fail "$reference: there is no deck input/$name.bdf"
   done
fi
run_decks $names
for name in $names; do
   before=$failed
   check_deck "$name"
   [ $failed -eq $before ] || echo "$name" >> "$work/failed"
done
echo "$passed passed, $failed failed"
[ $failed -eq 0 ] && [ $passed -gt 0 ]
