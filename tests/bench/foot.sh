#!/usr/bin/env bash
# The foot of a machine column on an intermediate plate on a bed (foot.geo), meshed by Gmsh, which must be installed, as a deck.
# Two joints between faces that do not match, four bolts of 60 kN, then 5 kN at the top of the column, forwards and down.
#
#    foot.sh FOLDER SIZE [BOLTS [FRICTION [LAW]]]
#
# SIZE      small (4,000 nodes), medium (12,000), large (32,000), huge (100,000), or the edge of the tetrahedra at the joints [mm]
# BOLTS     cut: of solids, each cut at a section of its shank (the default); bars: CROD from spider to spider
# FRICTION  MU (default 0.15), or none
# LAW       ground: cast iron, its shear a cubic that depends on the pressure (the default); linear: 1.0E5 and 2.4E4 N/mm3, what
#           the other has at 5 N/mm2
#
# FOLDER/foot_SIZE_BOLTS.bdf is the deck (_FRICTION and _linear follow where they are not the default), FOLDER/foot_SIZE_BOLTS_mesh.bdf
# its mesh, which is made only where it is missing.
set -eu
export LC_ALL=C
folder=$1 size=$2 bolts=${3:-cut} mu=${4:-0.15} law=${5:-ground}
here=$(dirname "$0")
case $size in
small)  edge=60 around=5 ;;
medium) edge=30 around=6 ;;
large)  edge=16 around=9 ;;
huge)   edge=8 around=12 ;;
*)      edge=$size around=6 ;;
esac
case $bolts in
cut)  bars=0 ;;
bars) bars=1 ;;
*)    echo "foot.sh: bolts are cut or bars, not '$bolts'" >&2; exit 1 ;;
esac
friction=$mu suffix=_$mu
[ "$mu" != 0.15 ] || suffix=
[ "$mu" != none ] || friction=
case $law in
ground) ;;
linear) suffix=${suffix}_linear ;;
*)      echo "foot.sh: the law is ground or linear, not '$law'" >&2; exit 1 ;;
esac
laws() {
   if [ "$law" = linear ]; then
      printf '%s\n' 'JNORM   1       1.0-5   1.0     1.0+5' 'JSHEAR  1       24000.0'
   else
      printf '%s\n' '$ ground cast iron; unloading is elastic' 'JNORM   1       4.6-5   0.48    5.0+6' \
         'JSHEAR  1       4000.0  3600.0  -2.0+7  -1.8+7  5.0+10  4.5+10' '+       4000.0  3600.0' '+       4000.0  3600.0'
   fi
}
name=foot_${size}_$bolts
mesh=$folder/${name}_mesh.bdf
mkdir -p "$folder"
if [ ! -s "$mesh" ]; then
   gmsh -3 -format bdf -setnumber Mesh.SaveElementTagType 2 -setnumber Mesh.BdfFieldFormat 0 -setnumber size "$edge" -setnumber around $around \
      -setnumber bars $bars -o "$mesh.part.bdf" "$here/foot.geo" > "$folder/$name.log" 2>&1 ||
      { tail -n 5 "$folder/$name.log" >&2; exit 1; }
   mv "$mesh.part.bdf" "$mesh"
fi
{
cat <<END_OF_CASE
$ FOOT OF A MACHINE COLUMN ON A PLATE ON A BED
TITLE = FOOT OF A COLUMN, $size, BOLTS $bolts, MU $mu
UNITS = MM, N
METHOD = NEWTON
SOLVER = TREE
ECHO = NO
SPC = 1
OUTPUT = NONE
SUBCASE 1
  LABEL = BOLTS
  INCR = 1
SUBCASE 2
  LABEL = LOAD
  LOAD = 2
  INCR = 2
BEGIN BULK
INCLUDE '${name}_mesh.bdf'
$ foot, plate and bed of cast iron, bolts of steel
PSOLID  1       1
PSOLID  2       1
PSOLID  3       1
MAT1    1       120000.         0.26    7.2-9
MAT1    2       210000.         0.3     7.85-9
JOINT   1       1       20      21
JOINT   2       1       22      23
PJOINT  1       1       1       1       $friction
$(laws)
SPCM    1       123     24
FORCEM  2       5000.0  0.8     0.0     -0.6    25
JINCR   1       5       ARITH   0.2
JINCR   2       10      ARITH   0.1
PMARK   20
PMARK   21
PMARK   22
PMARK   23
PMARK   24
PMARK   25
END_OF_CASE
if [ $bars = 0 ]; then
   echo 'PSOLID  4       2'
   for i in 1 2 3 4; do
      printf 'PMARK   4%d\nBOLT    %d               60000.0 1       4%d\n' $i $i $i
   done
else
   echo 'PROD    90      2       157.0'
   awk -F, -v OFS=, -f "$here/foot_spiders.awk" "$mesh"
fi
echo ENDDATA
} > "$folder/$name$suffix.bdf"
