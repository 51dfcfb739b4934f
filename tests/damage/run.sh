#!/bin/bash
# 500 damaged copies of the decks: the program must refuse each with a message, in less than 10 seconds, without a crash
# and without a file left.
#
#     run.sh PROGRAM INPUT_FOLDER [KEEP]
#
# The copies are always the same for the same decks; those that fail are copied to the folder KEEP.
# Ends with "N passed, N failed"; exit status 1 if anything failed, 2 wrong usage.
set -u
export LC_ALL=C

if [ $# -lt 2 ] || [ ! -x "$1" ] || [ ! -d "$2" ] || ! ls "$2"/*.bdf >/dev/null 2>&1; then
   echo "usage: run.sh PROGRAM INPUT_FOLDER [KEEP]" >&2
   exit 2
fi
program=$(realpath "$1")
input=$(realpath "$2")
keep=${3:+$(realpath "$3")}
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT
copies=500
passed=0; failed=0

# The copies stand among the files of the input folder, which they may INCLUDE.
mkdir "$work/decks" "$work/results"
find "$input" -maxdepth 1 -type f -size -1024k -exec cp {} "$work/decks" \;
cd "$work/decks" || exit 2
awk -v copies=$copies -v folder=. -f "$here/damage.awk" ./*.bdf > "$work/list" || exit 2

# what_is_wrong: with the last run, nothing where all is well
what_is_wrong() {
   if [ "$status" -eq 124 ]; then echo 'still running after 10 seconds'
   elif [ "$status" -lt 1 ] || [ "$status" -gt 3 ]; then echo "exit status $status"
   elif [ ! -s "$work/stderr" ]; then echo 'nothing is said'
   elif grep -aq -e 'Backtrace' -e 'Fortran runtime error' -e 'Program received' "$work/stderr"; then echo 'a run-time error'
   elif [ -s "$work/stdout" ]; then echo 'text on the standard output'
   elif [ -n "$(ls -A "$work/results")" ]; then echo "files left: $(ls -A "$work/results" | tr '\n' ' ')"
   fi
}

while read -r number description; do
   timeout 10 "$program" -o ../results "damaged_$number.bdf" >"$work/stdout" 2>"$work/stderr" </dev/null
   status=$?
   wrong=$(what_is_wrong)
   if [ -z "$wrong" ]; then
      passed=$((passed + 1))
      continue
   fi
   failed=$((failed + 1))
   echo "FAILED: damaged_$number.bdf, $description: $wrong"
   [ -n "$keep" ] && cp "damaged_$number.bdf" "$keep"
   rm -rf "$work/results"
   mkdir "$work/results"
done < "$work/list"

if [ $((passed + failed)) -ne $copies ]; then
   echo "FAILED: $((passed + failed)) copies were made of $copies"
   failed=$((failed + 1))
fi
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
