#!/usr/bin/env bash
# Linear decks without joints against CalculiX, an independent program (ccx, Dhondt and Wittig): displacements of all nodes and the
# eight lowest natural frequencies, to five digits.
#
#    calculix.sh PROGRAM WORK_FOLDER [store]
#
# calculix_deck.awk writes each deck, a cantilever or a ring; calculix_convert.awk converts it into input of CalculiX; ccx solves
# it; calculix_compare.awk compares. Where ccx is not installed (Debian: calculix-ccx), the stored results of CalculiX 2.20 are used
# (displacements.dat, frequencies.dat); where ccx is installed, both are compared. `store` renews the stored results. calculix.md
# lists which elements correspond.
set -u
export LC_ALL=C OMP_NUM_THREADS=1
program=$1 work=$2 store=${3:-}
here=$(dirname "$0")
passed=0 failed=0 modes=8
mkdir -p "$work"
command -v ccx > /dev/null && ccx=yes || ccx=

pass() { passed=$((passed + 1)); }
fail() { failed=$((failed + 1)); echo "FAILED $1"; cat "$work/differences"; }

# runs NAME: the deck, by the program
runs() { : > "$work/differences"; "$program" -q -o "$work" "$work/$1.bdf" > "$work/differences" 2>&1 || { fail "$1: it does not run"; return 1; }; }

# by_calculix NAME DECK [OPTION]: NAME.dat, what ccx finds
by_calculix() {
   awk "${@:3}" -f "$here/calculix_convert.awk" "$work/$2" > "$work/$1.inp" && rm -f "$work/$1.dat" &&
      (cd "$work" && ccx "$1" > "$1.log" 2>&1) && [ -s "$work/$1.dat" ] && return
   tail -n 5 "$work/$1.log" > "$work/differences"
   fail "$1: ccx does not solve it"
   return 1
}

# agrees NAME DISPLACEMENTS [STORED_NAME]: the listing of NAME with them. CPS8 is plane stress on the average only, so that it differs sooner.
agrees() {
   local tolerance=1e-5
   [ "$1" = stress8 ] && tolerance=2e-3
   awk -v name="${3:-$1}" -v tolerance=$tolerance -f "$here/calculix_compare.awk" "$2" "$work/$1.out" > "$work/differences"
   [ "$(grep -c -v '^checked ' "$work/differences")" -eq 0 ] && grep -q '^checked [1-9]' "$work/differences"
}

# same_frequencies NAME FREQUENCIES [STORED_NAME]: NAME.modes.csv with the row of that file
same_frequencies() {
   awk -v name="${3:-$1}" -v modes=$modes 'FNR == NR { if ($1 == name) for (k = 1; k < NF; k++) theirs[k] = $(k + 1); next }
      { split($0, c, ",") }
      FNR > 1 && c[2] in theirs { d = c[3]/theirs[c[2]] - 1; if (d < 0) d = -d; if (d < 1e-5) n++; else print "mode " c[2] ": apart by " d }
      END { if (n != modes) print n + 0 " of " modes " frequencies agree" }' "$2" "$work/$1.modes.csv" > "$work/differences"
   [ ! -s "$work/differences" ]
}

# ---- displacements ----

: > "$work/found"
for name in tetra hexa modes tria quad strain tetra10 tetra10_curved hexa20 hexa20_curved penta15 penta15_curved \
   tria6 tria6_curved quad8 quad8_curved strain8 stress8 ring8 ring8_curved; do
   awk -v name="$name" -f "$here/calculix_deck.awk" > "$work/$name.bdf"
   runs "$name" || continue
   if [ "$ccx" ]; then
      by_calculix "$name" "$name.bdf" -v stress="$([ "$name" = stress8 ] && echo CPS)" || continue
      case $name in ring*)
         awk -f "$here/calculix_straighten.awk" "$work/$name.inp" "$work/$name.dat" > "$work/straight.dat" && mv "$work/straight.dat" "$work/$name.dat" ;;
      esac
      agrees "$name" "$work/$name.dat" && pass || fail "$name: against CalculiX"
      awk -v name="$name" -f "$here/calculix_store.awk" "$work/$name.bdf" "$work/$name.dat" >> "$work/found"
   fi
   [ "$store" ] || agrees "$name" "$here/displacements.dat" && pass || fail "$name: against the stored displacements of CalculiX"
done
# version WHAT: the head of a stored file
version() { ccx -v | sed -n "s/.*Version *\(.*\)/$1 by CalculiX \1, $(date +%F): $2/p"; }
[ "$ccx$store" = yesstore ] && { version Displacements 'deck and components; displacements of all nodes, stage after stage'
                                 cat "$work/found"; } > "$here/displacements.dat"

# the comparison notices a modulus that is wrong in its fifth digit, and a node that is missing
sed 's/^MAT1,1,210000.0/MAT1,1,210005.0/' "$work/tetra.bdf" > "$work/stiff.bdf"
runs stiff
agrees stiff "$here/displacements.dat" tetra && fail 'a wrong modulus is not noticed' || pass
awk '/^hexa 3$/ { sub(/ [^ ]* [^ ]* [^ ]*$/, "", last) } NR > 1 { print last } { last = $0 } END { print last }' "$here/displacements.dat" > "$work/short.dat"
agrees tetra "$work/short.dat" && fail 'a missing node is not noticed' || pass

# ---- natural frequencies: the same decks, MODES in place of their loads ----

: > "$work/found"
for name in hexa hexa20 hexa20_curved quad quad8 quad8_curved strain8 ring8 ring8_curved; do
   awk -v name="$name" -f "$here/calculix_deck.awk" > "$work/$name.statics"
   sed -e '/^SUBCASE [23]/,/LOAD = /d' -e 's/^SUBCASE 1/&\n  MODES = 5/' -e "s/^MAT1/EIGRL,5,,,$modes\n&/" "$work/$name.statics" > "$work/$name.bdf"
   runs "$name" || continue
   if [ "$ccx" ]; then
      by_calculix "$name" "$name.statics" -v modes_wanted=$modes || continue
      awk -v name="$name" '/E I G E N V A L U E/ { on = 1 } /P A R T I C I P A T I O N/ { on = 0 }
         on && NF == 5 && $1 + 0 == $1 { row = row sprintf(" %.7g", $4) } END { print name row }' "$work/$name.dat" >> "$work/found"
      same_frequencies "$name" "$work/found" && pass || fail "$name: frequencies against CalculiX"
   fi
   [ "$store" ] || same_frequencies "$name" "$here/frequencies.dat" && pass || fail "$name: against the stored frequencies of CalculiX"
done
[ "$ccx$store" = yesstore ] && { version Frequencies "deck, the eight lowest"; cat "$work/found"; } > "$here/frequencies.dat"
# ---- shells: a column of thin walls, CQUAD4 against S8R: movement of two corners of its top, five frequencies, to 1 % ----

theirs='1.662519E-02 1.362553E-02 374.8622 415.6102 435.5873 435.5873 461.1871' # by CalculiX 2.20
# close NUMBERS OTHERS TOLERANCE: all seven numbers agree
close() { awk -v a="$1" -v b="$2" -v t="$3" 'BEGIN { n = split(a, x, " "); split(b, y, " "); for (k = 1; k <= n; k++) { d = x[k]/y[k] - 1; if (d > t || -d > t) print x[k] ", and " y[k] }
   if (n != 7) print n " numbers of 7" }' > "$work/differences"; [ ! -s "$work/differences" ]; }
awk -v n=16 -v m=48 -v modes=5 -f "$here/calculix_box.awk" > "$work/box.bdf"
runs box && {
   ours=$(awk 'index($0, " DISPLACEMENTS OF NODES") == 1 { on = 1 } /^ [A-Z]/ && !/DISPLACEMENTS/ { on = 0 } on && ($1 == 3073 || $1 == 3105) { print $5 }' "$work/box.out"
          awk -F, 'NR > 1 { print $3 }' "$work/box.modes.csv")
   close "$ours" "$theirs" 0.01 && pass || fail 'box: against the stored results of CalculiX'
   if [ "$ccx" ]; then
      awk -v n=16 -v m=48 -v ccx=1 -f "$here/calculix_box.awk" > "$work/box.inp"
      awk -v n=16 -v m=48 -v ccx=1 -v modes=5 -f "$here/calculix_box.awk" > "$work/box_modes.inp"
      (cd "$work" && ccx box > box.log 2>&1 && ccx box_modes >> box.log 2>&1)
      found=$(awk '$1 == 3073 || $1 == 3105 { print $2 }' "$work/box.dat"
              awk '/E I G E N V A L U E/ { on = 1 } /P A R T I C I P A T I O N/ { on = 0 } on && NF == 5 && $1 + 0 == $1 { print $4 }' "$work/box_modes.dat")
      close "$found" "$theirs" 1e-5 && pass || fail 'box: ccx against its stored results'
   fi
   close "$ours" "${theirs/435.5873/440.5873}" 0.01 && fail 'box: a wrong frequency is not noticed' || pass
}
[ "$ccx" ] || echo 'skipped: runs of CalculiX: ccx is not installed; what it gave is compared'

# the comparison notices a density that is wrong in its fourth digit, and a mode that is missing
sed 's/7.85-6/7.851-6/' "$work/hexa20.bdf" > "$work/heavy.bdf"
runs heavy
same_frequencies heavy "$here/frequencies.dat" hexa20 && fail 'a wrong density is not noticed' || pass
sed 's/^EIGRL.*/EIGRL,5,,,7/' "$work/hexa20.bdf" > "$work/few.bdf"
runs few
same_frequencies few "$here/frequencies.dat" hexa20 && fail 'a missing mode is not noticed' || pass
echo "$passed passed, $failed failed"
[ $failed -eq 0 ] && [ $passed -gt 0 ]
