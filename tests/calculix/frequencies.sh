#!/usr/bin/env bash
# Natural frequencies of linear decks without joints against CalculiX (ccx): the eight lowest, to five digits.
#
#    frequencies.sh PROGRAM WORK_FOLDER [store]
#
# The decks are those of run.sh, with MODES in place of their loads. Where ccx is not installed the frequencies stored in
# frequencies.dat, of CalculiX 2.20, take its place; where it is, both are compared. `store` makes them anew. Which elements are
# twins: README.md beside this file.
# Ends with `N passed, N failed`.
set -u
export LC_ALL=C OMP_NUM_THREADS=1
program=$1 work=$2 store=${3:-}
here=$(dirname "$0")
passed=0 failed=0 modes=8
decks='hexa hexa20 hexa20_curved quad quad8 quad8_curved strain8 ring8 ring8_curved'
mkdir -p "$work"

pass() { passed=$((passed + 1)); }
fail() { failed=$((failed + 1)); echo "FAILED $1"; }

# agrees NAME FREQUENCIES: NAME.modes.csv with the rows NAME, mode, frequency of that file
agrees() {
   awk -v name="$2" -v modes=$modes 'FNR == NR { if ($1 == name) theirs[$2] = $3; next }
      { split($0, c, ",") }
      FNR > 1 && c[2] in theirs { d = c[3]/theirs[c[2]] - 1; if (d < 0) d = -d; if (d < 1e-5) n++; else print "mode " c[2] ": apart by " d }
      END { if (n != modes) print n + 0 " of " modes " frequencies agree" }' "$3" "$work/$1.modes.csv" > "$work/differences"
   [ ! -s "$work/differences" ]
}

# by_calculix NAME: rows NAME, mode, frequency as ccx finds them
by_calculix() {
   awk -v modes_wanted=$modes -f "$here/convert.awk" "$work/$1.statics" > "$work/$1.inp" && rm -f "$work/$1.dat" &&
      (cd "$work" && ccx "$1" > "$1.log" 2>&1) && [ -s "$work/$1.dat" ] || return 1
   awk -v name="$1" '/E I G E N V A L U E/ { on = 1 } /P A R T I C I P A T I O N/ { on = 0 }
      on && NF == 5 && $1 + 0 == $1 { print name, $1, $4 }' "$work/$1.dat"
}

: > "$work/found"
for name in $decks; do
   awk -v name="$name" -f "$here/deck.awk" > "$work/$name.statics"
   sed -e '/^SUBCASE [23]/,/LOAD = /d' -e 's/^SUBCASE 1/&\n  MODES = 5/' -e "s/^MAT1/EIGRL,5,,,$modes\n&/" "$work/$name.statics" > "$work/$name.bdf"
   "$program" -q -o "$work" "$work/$name.bdf" > "$work/said" 2>&1 || { cat "$work/said"; fail "$name: it does not run"; continue; }
   if command -v ccx > /dev/null; then
      by_calculix "$name" >> "$work/found" || { tail -n 5 "$work/$name.log"; fail "$name: ccx does not solve it"; continue; }
      agrees "$name" "$name" "$work/found" && pass || { cat "$work/differences"; fail "$name: against CalculiX"; }
   fi
   [ "$store" = store ] || agrees "$name" "$name" "$here/frequencies.dat" && pass || {
      cat "$work/differences"; fail "$name: against the stored frequencies of CalculiX"; }
done
if command -v ccx > /dev/null; then
   if [ "$store" = store ]; then
      { ccx -v | sed -n "s/.*Version\(.*\)/Frequencies by CalculiX\1, $(date +%F): deck, mode, frequency/p"; cat "$work/found"; } > "$here/frequencies.dat"
   fi
else
   echo 'skipped: runs of CalculiX: ccx is not installed; its stored frequencies are compared'
fi

# the comparison notices a density that is wrong in its fourth digit, and a mode that is missing
sed 's/7.85-6/7.851-6/' "$work/hexa20.bdf" > "$work/heavy.bdf"
"$program" -q -o "$work" "$work/heavy.bdf" > "$work/said" 2>&1
agrees heavy hexa20 "$here/frequencies.dat" && fail 'a wrong density is not noticed' || pass
sed 's/^EIGRL.*/EIGRL,5,,,7/' "$work/hexa20.bdf" > "$work/few.bdf"
"$program" -q -o "$work" "$work/few.bdf" > "$work/said" 2>&1
agrees few hexa20 "$here/frequencies.dat" && fail 'a missing mode is not noticed' || pass
echo "$passed passed, $failed failed"
[ $failed -eq 0 ] && [ $passed -gt 0 ]
