#!/usr/bin/env bash
# Linear decks without joints against CalculiX, an independent program (ccx, Dhondt and Wittig): the displacements of all nodes
# to five digits.
#
#    run.sh PROGRAM WORK_FOLDER [store]
#
# Every deck is a cantilever under an end load and under its own weight: deck.awk writes it, second_order.awk those of second order,
# whose edges are curved; convert.awk makes input of CalculiX from it, ccx solves it, compare.awk compares. Where ccx is not installed (Debian: calculix-ccx) the displacements stored here as
# NAME.dat, of CalculiX 2.20, take its place; where it is, both are compared. `store` makes the stored ones anew.
#
#    tetra   CTETRA is C3D4                   tria    CTRIA3 in plane stress is CPE3 with converted constants
#    hexa    plain CHEXA is C3D8              quad    plain CQUAD4 likewise CPE4
#    modes   CHEXA with MODES is C3D8I        strain  CTRIA3 in plane strain is CPE3
#            where it is a rectangular brick
#    tetra10, penta15, hexa20: C3D10, C3D15, C3D20; tria6, quad8, strain8: CPE6, CPE8 likewise
#    ring8   CQUAD8 round an axis is CAX8, a sector of 2 degrees: to 2E-4, for so far it is off the ring
# C3D6 is no twin of CPENTA, for it has two integration points only.
# Ends with `N passed, N failed`.
set -u
export LC_ALL=C OMP_NUM_THREADS=1
program=$1 work=$2 store=${3:-}
here=$(dirname "$0")
passed=0 failed=0
decks='tetra hexa modes tria quad strain tetra10 penta15 hexa20 tria6 quad8 strain8 ring8'
mkdir -p "$work"

pass() { passed=$((passed + 1)); }
fail() { failed=$((failed + 1)); echo "FAILED $1"; }

# agrees NAME DISPLACEMENTS: the listing of NAME with them
agrees() {
   awk -v tolerance="$([ "$1" = ring8 ] && echo 2e-4 || echo 1e-5)" -f "$here/compare.awk" "$2" "$work/$1.out" > "$work/differences"
   [ "$(grep -c -v '^checked ' "$work/differences")" -eq 0 ] && grep -q '^checked [1-9]' "$work/differences"
}

for name in $decks; do
   case $name in *[0-9]) writer=second_order ;; *) writer=deck ;; esac
   awk -v name="$name" -f "$here/$writer.awk" > "$work/$name.bdf"
   "$program" -q -o "$work" "$work/$name.bdf" || { fail "$name: it does not run"; continue; }
   if command -v ccx > /dev/null; then
      awk -f "$here/convert.awk" "$work/$name.bdf" > "$work/$name.inp" && rm -f "$work/$name.dat" &&
         (cd "$work" && ccx "$name" > "$name.log" 2>&1)
      if [ ! -s "$work/$name.dat" ]; then tail -n 5 "$work/$name.log"; fail "$name: ccx does not solve it"; continue; fi
      agrees "$name" "$work/$name.dat" && pass || { cat "$work/differences"; fail "$name: against CalculiX"; }
      if [ "$store" = store ]; then
         { echo "$(ccx -v | sed -n 's/.*Version/Displacements by CalculiX/p'), $(date +%F)"; cat "$work/$name.dat"; } > "$here/$name.dat"
      fi
   fi
   agrees "$name" "$here/$name.dat" && pass || { cat "$work/differences"; fail "$name: against the stored displacements of CalculiX"; }
done
command -v ccx > /dev/null || echo 'ccx is not installed: only the stored displacements of CalculiX are compared'

# the comparison notices a modulus that is wrong in its fifth digit, and a node that is missing
sed 's/^MAT1,1,210000.0/MAT1,1,210005.0/' "$work/tetra.bdf" > "$work/stiff.bdf"
"$program" -q -o "$work" "$work/stiff.bdf"
agrees stiff "$here/tetra.dat" && fail 'a wrong modulus is not noticed' || pass
sed '$d' "$here/tetra.dat" > "$work/short.dat"
agrees tetra "$work/short.dat" && fail 'a missing node is not noticed' || pass
echo "$passed passed, $failed failed"
[ $failed -eq 0 ] && [ $passed -gt 0 ]
