#!/usr/bin/env bash
# A deck of the benchmark on the standard output.
#
#    make_deck.sh SHAPE SOLVER OUTPUT [NREAN [MODES]]
#
# SHAPE  q4_100x20: a plate of 100 x 20 CQUAD4, the second number its height; hex8_20x20x10: a block of 20 x 20 x 10 CHEXA, the
#        last number its height. The whole bottom stands on a rigid base by a joint. 20 increments press on the whole top, and out
#        of centre on one node: the pressure is uneven, and the joint stays closed. over_24x17x8: a block of 24 x 24 x 8 CHEXA on one of
#        17 x 17 x 8, the joint between them: lists of nodes, and pairs where both numbers are the same.
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
PSOLID,1,1"
   supports='SPCM,1,1,21
SPCM,1,3,22'
   loads="FORCE,10,$(( (nx + 1)*(n2 + 1)*(n3 + 1) )),,100.0,0.0,-1.0" ;;
over_*)
   mesh="BLOCK3,1,1,$n2,$n2,$n3,0.0,0.0,0.0
+,150.0,150.0,60.0,,,,1,1
+,,,,,21,22
BLOCK3,2,1,$nx,$nx,$n3,0.0,0.0,60.0
+,150.0,150.0,120.0,,,,1000001,1000001
+,,,,,20,23
PMARK,22
PSOLID,1,1"
   sides='20,22'
   supports="SPCM,1,123,21
SPC1,1,12,1000001
SPC1,1,1,$(( 1000001 + nx*(n3 + 1) ))"
   down='0.0,0.0,-1.0'
   loads="FORCE,10,$(( 1000000 + (nx + 1)*(nx + 1)*(n3 + 1) )),,100.0,$down" ;;
*)
   echo "make_deck.sh: '$shape' is no shape, expected q4_NxM, hex8_NxMxK or over_NxMxK" >&2
   exit 1 ;;
esac

cat <<END
TITLE = ${shape^^}
ECHO = NO
SPC = 1
SOLVER = $solver
SUBCASE 1
  LOAD = 10
$steps
  OUTPUT = $output
BEGIN BULK
$mesh
MAT1,1,9500.0,,0.25$density
PMARK,20
PMARK,21
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
