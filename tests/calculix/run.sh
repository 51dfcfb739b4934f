#!/usr/bin/env bash
# Linear decks without joints against CalculiX, an independent program (ccx, Dhondt and Wittig): the displacements of all nodes
# to five digits.
#
#    run.sh PROGRAM WORK_FOLDER [store]
#
# deck.awk writes every deck, a cantilever or a ring, convert.awk makes input of CalculiX from it, ccx solves it, compare.awk
# compares. Where ccx is not installed (Debian: calculix-ccx) the displacements stored here as NAME.dat, of CalculiX 2.20, take its
# place; where it is, both are compared. `store` makes the stored ones anew. Which elements are twins of which, and which are not:
# README.md beside this file.
# Ends with `N passed, N failed`.
set -u
export LC_ALL=C OMP_NUM_THREADS=1
program=$1 work=$2 store=${3:-}
here=$(dirname "$0")
passed=0 failed=0
decks='tetra hexa modes tria quad strain tetra10 tetra10_curved hexa20 hexa20_curved penta15 penta15_curved
   tria6 tria6_curved quad8 quad8_curved strain8 stress8 ring8 ring8_curved'
mkdir -p "$work"

pass() { passed=$((passed + 1)); }
fail() { failed=$((failed + 1)); echo "FAILED $1"; }

# agrees NAME DISPLACEMENTS: the listing of NAME with them. CPS8 is plane stress on the average only, so that it differs sooner.
agrees() {
   local tolerance=1e-5
   [ "$1" = stress8 ] && tolerance=2e-3
   awk -v tolerance=$tolerance -f "$here/compare.awk" "$2" "$work/$1.out" > "$work/differences"
   [ "$(grep -c -v '^checked ' "$work/differences")" -eq 0 ] && grep -q '^checked [1-9]' "$work/differences"
}

# by_calculix NAME: NAME.dat, the displacements that ccx finds
by_calculix() {
   awk -v stress="$([ "$1" = stress8 ] && echo CPS)" -f "$here/convert.awk" "$work/$1.bdf" > "$work/$1.inp" && rm -f "$work/$1.dat" &&
      (cd "$work" && ccx "$1" > "$1.log" 2>&1) && [ -s "$work/$1.dat" ] || return 1
   case $1 in ring*)
      awk -f "$here/straighten.awk" "$work/$1.inp" "$work/$1.dat" > "$work/straight.dat" && mv "$work/straight.dat" "$work/$1.dat" ;;
   esac
}

for name in $decks; do
   awk -v name="$name" -f "$here/deck.awk" > "$work/$name.bdf"
   "$program" -q -o "$work" "$work/$name.bdf" 2> "$work/said" || { cat "$work/said"; fail "$name: it does not run"; continue; }
   if command -v ccx > /dev/null; then
      by_calculix "$name" || { tail -n 5 "$work/$name.log"; fail "$name: ccx does not solve it"; continue; }
      agrees "$name" "$work/$name.dat" && pass || { cat "$work/differences"; fail "$name: against CalculiX"; }
      if [ "$store" = store ]; then
         { ccx -v | sed -n "s/.*Version\(.*\)/Displacements by CalculiX\1, $(date +%F)/p"; cat "$work/$name.dat"; } > "$here/$name.dat"
      fi
   fi
   agrees "$name" "$here/$name.dat" && pass || { cat "$work/differences"; fail "$name: against the stored displacements of CalculiX"; }
done
command -v ccx > /dev/null || echo 'skipped: runs of CalculiX: ccx is not installed; its stored displacements are compared'

# the comparison notices a modulus that is wrong in its fifth digit, and a node that is missing
sed 's/^MAT1,1,210000.0/MAT1,1,210005.0/' "$work/tetra.bdf" > "$work/stiff.bdf"
"$program" -q -o "$work" "$work/stiff.bdf" 2> /dev/null
agrees stiff "$here/tetra.dat" && fail 'a wrong modulus is not noticed' || pass
sed '$d' "$here/tetra.dat" > "$work/short.dat"
agrees tetra "$work/short.dat" && fail 'a missing node is not noticed' || pass
echo "$passed passed, $failed failed"
[ $failed -eq 0 ] && [ $passed -gt 0 ]
