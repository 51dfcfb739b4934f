#!/usr/bin/env bash
# A flanged column of 10-node tetrahedra, meshed by Gmsh (column.geo), which must be installed: the displacement of its top under 10
# kN. Where ccx is installed it solves the same mesh, and the displacements of all nodes agree to five digits (2E-5 of each).
#
#    column.sh PROGRAM WORK_FOLDER [SIZE...]
#    column.sh --mesh WORK_FOLDER SIZE           mesh and deck alone
#
# SIZE is that of the elements, default 48: 16,000 nodes, 1 s. Prints a line for each: SIZE, nodes, displacement of the top, that of
# CalculiX. Status 1 where they differ, where the displacement is not between 0.26 and 0.29, or where something fails.
set -u
export LC_ALL=C OMP_NUM_THREADS=1
program=$1 work=$2
shift 2
here=$(dirname "$0")
[ $# -gt 0 ] || set -- 48
mkdir -p "$work"

# The mean movement along y of the nodes at z = 900 that are not on its edges, from a listing.
top() { awk '/DISPLACEMENTS OF NODES/ { on = 1 } /REACTIONS|STRESSES/ { on = 0 }
             on && NF == 7 && $4 > 899.99 && $2^2 < 149^2 && $3^2 < 124^2 { s += $6; n++ } END { printf "%.4f", s / n }' "$1"; }

status=0
for size; do
   mesh=$work/column_mesh.bdf deck=$work/column.bdf
   rm -f "$mesh" "$work"/column.{out,dat}
   gmsh -3 -format bdf -setnumber Mesh.SaveElementTagType 2 -setnumber Mesh.BdfFieldFormat 0 -setnumber size "$size" \
      -o "$mesh" "$here/column.geo" > "$work/column.log" 2>&1
   cat > "$deck" <<END
TITLE = FLANGED COLUMN
UNITS = MM, N
ECHO = NO
SPC = 1
SUBCASE 1
  LOAD = 1
BEGIN BULK
INCLUDE 'column_mesh.bdf'
PSOLID  1       1
MAT1    1       120000.         0.26
PMARK   21
PMARK   22
SPCM    1       123     21
FORCEM  1       10000.0 0.0     1.0     0.0     22
ENDDATA
END
   [ "$program" = --mesh ] && break
   "$program" -q -o "$work" "$deck" || { status=1; continue; }
   moved=$(top "$work/column.out") theirs=-
   awk -v u="$moved" 'BEGIN { exit !(u > 0.26 && u < 0.29) }' || status=1
   if command -v ccx > /dev/null; then
      awk -f "$here/column.awk" "$mesh" > "$work/column.inp" && (cd "$work" && ccx column > column.log 2>&1)
      awk -v tolerance=2e-5 -f "$here/calculix_compare.awk" "$work/column.dat" "$work/column.out" > "$work/differences"
      theirs=$(tail -n 1 "$work/differences")
      [ "$(grep -c -v '^checked ' "$work/differences")" -eq 0 ] && grep -q '^checked [1-9]' "$work/differences" || status=1
   fi
   echo "$size $(grep -c '^GRID' "$mesh") $moved $theirs"
done
exit $status
