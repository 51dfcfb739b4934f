#!/usr/bin/env bash
# Checks that the verification manual is the output of this program, and that the comparison notices a page that is not.
#
#    check.sh PROGRAM QUERY WORK_FOLDER
set -u
export LC_ALL=C
program=$1 query=$2 work=$3
here=$(dirname "$0") committed=reference_output/README.md made=$3/README.md
mkdir -p "$work"
rm -f "$made"
"$here/make.sh" "$program" "$query" "$work" "$made" > "$work/made.log"
grep -v '^[0-9]* passed' "$work/made.log"
read -r passed _ failed _ <<< "$(grep -E '^[0-9]+ passed, [0-9]+ failed$' "$work/made.log" | tail -n 1)"
passed=${passed:-0} failed=${failed:-1}

pass() { passed=$((passed + 1)); }
fail() { failed=$((failed + 1)); echo "FAILED $1"; }
compare() { awk -f "$here/compare.awk" "$1" "$2" > "$work/said"; }

if [ -f "$made" ] && compare "$committed" "$made"; then pass; else
   cat "$work/said"
   fail "$committed is not what this program gives; if the change is meant: make manual, and say why in the commit"
fi

# the page is sound: tables, links to headings, and the files that it names
awk -f "$here/numbers.awk" -f "$here/lint.awk" "$committed" > "$work/said" 2>&1
grep -oE '\]\([^)#]+' "$committed" | cut -c3- | sort -u | while read -r file; do [ -e "reference_output/$file" ] || echo "no file $file"; done >> "$work/said"
grep -oE '`(input|tests|exact|unit)/[A-Za-z0-9_./]+`' "$committed" | tr -d '`' | sort -u | while read -r file; do
   [ -e "$file" ] || [ -e "tests/$file" ] || echo "no file $file"
done >> "$work/said"
if [ -s "$work/said" ]; then cat "$work/said"; fail 'the page is not sound'; else pass; fi

# notices WHAT SED-COMMAND: a page changed so is told from the committed one; overlooks: it is not
changed() { sed -E "$2" "$committed" > "$work/changed.md"; ! cmp -s "$committed" "$work/changed.md" || fail "$1: nothing is changed"; }
notices() { changed "$@"; if compare "$committed" "$work/changed.md"; then fail "not noticed: $1"; else pass; fi; }
overlooks() { changed "$@"; if compare "$committed" "$work/changed.md"; then pass; else cat "$work/said"; fail "noticed: $1"; fi; }
notices 'another word' '0,/Theory/s//Theorem/'
notices 'a number wrong in its last digit but one' '0,/3\.57771E-3/s//3.57791E-3/'
notices 'a count' '0,/\| 126 \|/s//| 125 |/'
notices 'another branch' '0,/\| UNLOAD \|/s//| LOAD |/'
notices 'a difference grown' '0,/< 1E-9/s//+2.1E-6/'
notices 'a sign' '0,/\| -0\.250000/s//| 0.250000/'
notices 'NaN' '0,/3\.57771E-3/s//NaN/'
notices 'a row missing' '/^\| 5 \| STEP \|/d'
notices 'the end missing' '$d'
notices 'a line more' '$s/$/\nmore/'
overlooks 'a last digit' '0,/3\.57771E-3/s//3.57772E-3/'
overlooks 'a last digit of a difference' '0,/-0\.51 %/s//-0.52 %/'

# and a number of the program that is off its theory is a fault, not a row of the page
cat > "$work/off.sh" <<'OFF'
query=$1 work=$2/off
mkdir -p "$work"
source tests/exact/lib.sh
source tests/manual/lib.sh
exec 3> /dev/null
begin_case 0.0
row 'within' 1 1.0000000001
row 'off' 1 1.00001
row 'no number' 1 NaN
row 'nothing' 1 ''
row 'a formula in error' '1 +' 1
fact 'a word' OPEN LOAD
echo "$passed $failed"
OFF
if [ "$(bash "$work/off.sh" "$query" "$work" | tail -n 1)" = '1 5' ]; then pass; else fail 'rows that are off their theory pass'; fi
echo "$passed passed, $failed failed"
[ $failed -eq 0 ] && [ $passed -gt 0 ]
