#!/usr/bin/env bash
# What it costs to find four parameters of a joint from natural frequencies: `name value` a line.
#
#    identify.sh JOINTFEM JOINTFIT FOLDER SHAPE
#
# SHAPE  hex8_11x11x64: a column of 11 x 11 CHEXA, 150 by 120, and 64 of them high, on a rigid base by one joint
#
# Known C, M, A11, A12 give the frequencies of four modes under three loads, which are changed by up to 1 %. jointfit begins with other values.
# `once` are the seconds of processor time in which jointfem orders, forms, factorises and solves the equations once, in one increment;
# `all` those of jointfit; both are the least of three runs, which above 30 s are not repeated. FOLDER/SHAPE.found is the answer.
set -eu
jointfem=$1 jointfit=$2 folder=$3 shape=$4
export LC_ALL=C OPENBLAS_NUM_THREADS=1
IFS='x' read -r nx ny nz <<< "${shape#*_}"
name=$folder/$shape
truth=(--set C=5.0E-3 --set M=0.5 --set A11=40.0 --set A12=60.0)
mkdir -p "$folder"
cat > "$name.bdf" << END
METHOD = NEWTON
OUTPUT = NONE
STIFFNESS = LOAD
SOLVER = TREE
INCR = 5
MODES = 4
SUBCASE 1
  LOAD = 10
SUBCASE 2
  LOAD = 20
SUBCASE 3
  LOAD = 30
BEGIN BULK
BLOCK3,1,1,$nx,$ny,$nz,0.0,0.0,0.0
+,150.0,120.0,$(awk "BEGIN { printf \"%.4f\", 150*$nz/$nx }"),,,,1,1
+,,,,,20,23
PSOLID,1,1,,,,PLAIN
MAT1,1,1.1E5,,0.25,7.2E-9
PMARK,20
PMARK,23
JOINT,1,1,20
PJOINT,1,1,1,1
JNORM,1,\${C},\${M},2.0+5
JSHEAR,1,\${A11},\${A12}
FORCEM,10,2.0E3,0.0,0.0,-1.0,23
FORCEM,20,1.0E4,0.0,0.0,-1.0,23
FORCEM,30,5.0E4,0.0,0.0,-1.0,23
FORCE,10,1,,50.0,1.0,0.5,0.0
JINCR,5,5
EIGRL,4,,,4
ENDDATA
END
"$jointfem" -q -o "$folder" "${truth[@]}" "$name.bdf" > "$folder/said" 2>&1 || { cat "$folder/said" >&2; exit 1; }
sed '/^SUBCASE 2/,/^  LOAD = 30/d; /^MODES/d; /^STIFF/d; /^EIGRL/d; s/= NEWTON/= STEP/; s/^JINCR.*/JINCR,5,1/' "$name.bdf" > "$name.once.bdf"
{
   printf 'parameter,%s\n' C,8.0E-3 M,0.6 A11,60.0 A12,40.0
   awk -F, -v OFS=, 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
      { off = 0.01*(2*((NR*0.618034) % 1) - 1); print "frequency", $at["frequency"]*(1 + off), "1%", "stage=" $at["stage"], "mode=" $at["mode"] }' \
      "$name.modes.csv"
} > "$name.csv"
{
   for turn in 1 2 3; do
      "$jointfem" --times --threads 1 -q -o "$folder" "${truth[@]}" "$name.once.bdf" 2>&1 |
         awk '/: (order|factor|increments|recover) / { once += $(NF - 1) } END { print "once", once }'
      TIMEFORMAT=$'all %3U'
      { time OMP_NUM_THREADS=1 "$jointfit" --structure "$name.bdf" --measured "$name.csv" > "$name.found" 2> "$folder/said"; } 2>&1 ||
         { cat "$folder/said" >&2; exit 1; }
      [ $SECONDS -lt 30 ] || break
   done | awk '!($1 in least) || $2 < least[$1] { least[$1] = $2 } END { for (name in least) print name, least[name] }'
   awk '$1 == "UNKNOWNS" && NF == 2 { print "unknowns", $2 }' "$name.once.out"
   awk '$2 ~ /^(C|M|A11|A12)$/ && $1 == "$" && NF > 4 { print $2, $4 }' "$name.found"
}
