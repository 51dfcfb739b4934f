#!/usr/bin/env bash
# A block pressed evenly on its joint, which has an exact answer, over more decades than any structure has: 1,764 runs a method (E
# 1E-6 to 1E15, c 1E-12 to 1E6, m 0.001 to 1, pressure and size 1E-12 to 1E12, nu -0.99 to 0.4999999). Each is right to 1E-6 or ends
# with status 3.
#
#     run.sh PROGRAM FOLDER [METHOD...]
#
# METHODs: NEWTON and STEP, or those named. Ends with "N passed, N failed".
set -u
export LC_ALL=C
program=$(realpath "$1")
mkdir -p "$2"
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
   awk -v method="$1" -v folder="$into" -f "$here/decks.awk" > "$into/list"
   (cd "$into" && "$program" -q --threads 1 -o . $(awk '{ print "d" $1 ".bdf" }' list) > out 2> err
    echo "status $?")
   awk -f "$here/judge.awk" "$into/list" "$into/err" "$into"/d*.joint.csv "$into"/d*.stage.csv
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
echo "$passed passed, $failed failed"
[ $failed -eq 0 ]
