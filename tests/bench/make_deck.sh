#!/usr/bin/env bash
# A deck of the benchmark on the standard output.
#
#    make_deck.sh SHAPE SOLVER OUTPUT [NREAN [MODES]]
#
# SHAPE  q4_100x20: a plate of 100 x 20 CQUAD4, the second number its height; hex8_20x20x10: a block of 20 x 20 x 10 CHEXA, the
#        last number its height. The whole bottom stands on a rigid base by a joint. 20 increments press on the whole top, and out
#        of centre on one node: the pressure is uneven, and the joint stays closed. shell_316x316: a plate of 316 x 316 CQUAD4 shells, 3
#        thick, node by node, with its lower face on the joint, likewise. over_24x17x8: a block of 24 x 24 x 8 CHEXA on one of
#        17 x 17 x 8, the joint between them: lists of nodes, and pairs where both numbers are the same. bracket_16: an angle of two legs,
#        3 x 2 units each, 1 thick, each unit cut into 16 cells an edge and every cell into six CTETRA of second order, node by node:
#        1,000,000 unknowns. The lower leg stands on the joint, the upper one is pressed on its end.
# SOLVER, OUTPUT  as in case control
# MODES  so many natural modes behind one increment
# NREAN  given: the joint has shear laws and a friction limit that it exceeds in every increment, and so many re-analyses
set -eu
shape=$1 solver=$2 output=$3 nrean=${4-} modes=${5-}
IFS='x' read -r nx n2 n3 <<< "${shape#*_}"

laws='PJOINT,1,1'
[ -z "$nrean" ] || laws="PJOINT,1,1,1,1,1.0-3,$nrean
JSHEAR,1,100.0,300.0"

steps='  INCR = 5' density=
[ -z "$modes" ] || steps='  MODES = 4' density=",8.0E-10
EIGRL,4,,,$modes"

case $shape in
q4_*)
   mesh="BLOCK2,1,1,$nx,$n2,0.0,0.0
+,300.0,100.0
+,20,21,23
PSHELL,1,1,20.0"
   supports='SPCM,1,1,21'
   loads="FORCE,10,$(( (2*nx/3 + 1)*(n2 + 1) )),,200.0,0.0,-1.0" ;;
hex8_*)
   mesh="BLOCK3,1,1,$nx,$n3,$n2,0.0,0.0,0.0
+,150.0,150.0,150.0,,,,1,1
+,,21,20,23,22
PMARK,22
PSOLID,1,1,,,,PLAIN"
   supports='SPCM,1,1,21
SPCM,1,3,22'
   loads="FORCE,10,$(( (nx + 1)*(n2 + 1)*(n3 + 1) )),,100.0,0.0,-1.0" ;;
shell_*)
   mesh="PSHELL,1,1,3.0,1,,1"
   model='MODEL = SPACE
' held='$'
   supports='SPC1,1,126,1
SPC1,1,2,'$(( nx*(n2 + 1) + 1 ))
   down='0.0,0.0,-1.0'
   loads="FORCE,10,$(( (2*nx/3)*(n2 + 1) + n2/2 + 1 )),,100.0,$down" ;;
over_*)
   mesh="BLOCK3,1,1,$n2,$n2,$n3,0.0,0.0,0.0
+,150.0,150.0,60.0,,,,1,1
+,,,,,21,22
BLOCK3,2,1,$nx,$nx,$n3,0.0,0.0,60.0
+,150.0,150.0,120.0,,,,1000001,1000001
+,,,,,20,23
PMARK,22
PSOLID,1,1,,,,PLAIN"
   sides='20,22'
   supports="SPCM,1,123,21
SPC1,1,12,1000001
SPC1,1,1,$(( 1000001 + nx*(n3 + 1) ))"
   down='0.0,0.0,-1.0'
   loads="FORCE,10,$(( 1000000 + (nx + 1)*(nx + 1)*(n3 + 1) )),,100.0,$down" ;;
bracket_*)
   mesh='PMARK,22
PSOLID,1,1'
   supports='SPCM,1,1,21
SPCM,1,2,22'
   down='0.0,0.0,-1.0'
   loads= ;;
*)
   echo "make_deck.sh: '$shape' is no shape, expected q4_NxM, hex8_NxMxK, shell_NxM, over_NxMxK or bracket_N" >&2
   exit 1 ;;
esac

# The nodes, elements and marked sides of a bracket with $1 cells a unit, each 50 long: a cell is cut along its diagonal, one tetrahedron for
# every order of the three axes. Nodes are numbered on the grid of half cells.
bracket() {
   awk -v n="$1" '
      function id(i, j, k) { return 1 + i + (6*n + 1)*(j + (4*n + 1)*k) }
      function inside(i, j, k) { return i < n || k < n }               # a cell
      function node(a, b, c) { return id(x[a] + x[b], y[a] + y[b], z[a] + z[b]) } # between two corners, or one
      function side(mark, a, b, c) {
         printf "CTRIA6,%d,%d,%d,%d,%d,%d,%d,%d\n", ++sides + 10000000, mark, node(a, a), node(b, b), node(c, c), node(a, b), node(b, c), node(c, a)
      }
      BEGIN {
         split("1 2 3 2 3 1 3 1 2 1 3 2 3 2 1 2 1 3", axis, " ")       # even orders first
         h = 25/n
         for (k = 0; k <= 6*n; k++) for (j = 0; j <= 4*n; j++) for (i = 0; i <= 6*n; i++)
            if (i <= 2*n || k <= 2*n) printf "GRID,%d,,%.6g,%.6g,%.6g\n", id(i, j, k), i*h, j*h, k*h
         for (k = 0; k < 3*n; k++) for (j = 0; j < 2*n; j++) for (i = 0; i < 3*n; i++) {
            if (!inside(i, j, k)) continue
            for (t = 0; t < 6; t++) {
               x[1] = i; y[1] = j; z[1] = k
               for (c = 1; c <= 3; c++) {
                  a = axis[3*t + c]
                  x[c + 1] = x[c] + (a == 1); y[c + 1] = y[c] + (a == 2); z[c + 1] = z[c] + (a == 3)
               }
               if (t > 2) { # turned the other way round
                  p = x[2]; x[2] = x[3]; x[3] = p; p = y[2]; y[2] = y[3]; y[3] = p; p = z[2]; z[2] = z[3]; z[3] = p
               }
               printf "CTETRA,%d,1,%d,%d,%d,%d,%d,%d\n+,%d,%d,%d,%d\n", ++elements, node(1, 1), node(2, 2), node(3, 3), node(4, 4), \
                  node(1, 2), node(2, 3), node(3, 1), node(1, 4), node(2, 4), node(3, 4)
            }
         }
         for (i = 0; i < 3*n; i++) for (j = 0; j < 2*n; j++) {         # below, and on the end of the upper leg
            corners(i, j, 0, 1); side(20, 1, 2, 3); side(20, 1, 3, 4)
            if (i < n) { corners(i, j, 3*n, 1); side(23, 1, 2, 3); side(23, 1, 3, 4) }
         }
         for (j = 0; j < 2*n; j++) for (k = 0; k < 3*n; k++) { corners(0, j, k, 2); side(21, 1, 2, 3); side(21, 1, 3, 4) }
         for (i = 0; i < 3*n; i++) for (k = 0; k < 3*n; k++)
            if (inside(i, 0, k)) { corners(i, 0, k, 3); side(22, 1, 2, 3); side(22, 1, 3, 4) }
      }
      function corners(i, j, k, way,    c, u, w) { # of a face of a cell, one after another; across z, x, y
         for (c = 1; c <= 4; c++) {
            u = c == 2 || c == 3; w = c > 2
            x[c] = i + (way == 2 ? 0 : u); y[c] = j + (way == 3 ? 0 : way == 1 ? w : u); z[c] = k + (way == 1 ? 0 : w)
         }
      }'
}

# The nodes, shells and marked faces of a plate of 150 x 150, $1 x $2 elements: 20 below, 23 above
plate() {
   awk -v n="$1" -v m="$2" 'BEGIN {
      for (i = 0; i <= n; i++) for (j = 0; j <= m; j++) printf "GRID,%d,,%.9g,%.9g,0.0\n", 1 + i*(m + 1) + j, 150*i/n, 150*j/m
      for (i = 0; i < n; i++) for (j = 0; j < m; j++) {
         e++; a = 1 + i*(m + 1) + j; d = a + m + 1
         printf "CQUAD4,%d,1,%d,%d,%d,%d\nCQUAD4,%d,20,%d,%d,%d,%d\n", e, a, d, d + 1, a + 1, n*m + e, a + 1, d + 1, d, a
         printf "CQUAD4,%d,23,%d,%d,%d,%d\n", 2*n*m + e, a, d, d + 1, a + 1
      }
   }'
}

cat <<END
TITLE = ${shape^^}
ECHO = NO
${model-}SPC = 1
SOLVER = $solver
SUBCASE 1
  LOAD = 10
$steps
  OUTPUT = $output
BEGIN BULK
END
[ "${shape%_*}" != bracket ] || bracket "${shape#*_}"
[ "${shape%_*}" != shell ] || plate "$nx" "$n2"
cat <<END
$mesh
MAT1,1,9500.0,,0.25$density
PMARK,20
${held-PMARK,21}
PMARK,23
JOINT,1,1,${sides-20}
$laws
JNORM,1,8.0-3,0.5
$supports
FORCEM,10,1600.0,${down-0.0,-1.0,0.0},23
$loads
JINCR,5,20,ARITH,0.02
ENDDATA
END
