#!/usr/bin/env bash
# The pictures of this folder, PNG and SVG, from the joint histories of the decks. Needs gnuplot.
#
#    draw.sh PROGRAM FIT QUERY WORK_FOLDER
#
# The pictures depend on seven digits of the results (rounded.awk), so that another processor draws the same.
set -eu
export LC_ALL=C
program=$1 fit=$2 query=$3 work=$4
source tests/exact/contact_edges.sh
here=$(dirname "$0")
command -v gnuplot > /dev/null || { echo 'make figures needs gnuplot: apt-get install gnuplot-nox'; exit 1; }
mkdir -p "$work"
decks='normal_loop shear_cycles shear_step shear_pressure friction_none friction_once friction_full
       prism03 prism05 prism10 prism15 prism_newton prism_back'
for deck in $decks; do "$program" -q -o "$work" "input/$deck.bdf" > /dev/null; done

# the prism by STEP in 3 to 320 increments, against NEWTON in 40: deflection of node 51, pressures, largest error
prism() { # METHOD INCREMENTS FIRST
   sed -E "s/^METHOD.*/METHOD = $1/; s/^JINCR.*/JINCR,$2,$2,ARITH,$3/; s/^( *INCR =).*/\\1 $2/" input/prism05.bdf \
      > "$work/$1_$2.bdf"
   "$program" -q -o "$work" "$work/$1_$2.bdf" > /dev/null
}
at_the_end() { # METHOD INCREMENTS: the increments, the deflection of node 51, the pressures of nodes 6, 11, ..., 51
   awk -F, -v n=$2 '$2 == n { pressure[$6] = $14; lambda[$6] = $13 }
      END { printf "%d,%s", n, lambda[51]; for (k = 6; k <= 51; k += 5) printf ",%s", pressure[k]; print "" }' "$work/$1_$2.joint.csv"
}
prism NEWTON 40 0.025
columns='increments,lambda,p6,p11,p16,p21,p26,p31,p36,p41,p46,p51'
{ echo "$columns"; at_the_end NEWTON 40; } > "$work/newton.csv"
echo "$columns" > "$work/by_increments.csv"
echo 'increments,error' > "$work/errors.csv"
for n in 3 5 10 15 20 40 80 160 320; do
   first=$(awk -v n=$n 'BEGIN { printf "%.7f", n < 20 ? 0.05 : 1 / n }')
   prism STEP $n "$first"
   at_the_end STEP $n >> "$work/by_increments.csv"
   echo "$n,$("$query" "$work/STEP_$n.joint.csv" rows "increment = $n" with "$work/NEWTON_40.joint.csv" on node1 on increment=40 \
      print 'max(abs(lambda - other.lambda))')" >> "$work/errors.csv"
done

# Fig. 2: the lines that jointfit lays through the coefficients of the published cubics, as it prints them
"$fit" --branch RELOAD --as LOAD tests/fit/sanad.dat 2> /dev/null |
   awk 'BEGIN { print "coefficient,constant,slope" }
        $2 ~ /^a[123]$/ && $3 == "=" { print $2 "," $4 "," ($5 == "-" ? -$6 : $6) }' > "$work/sanad.csv"

# Fig. 5(a): one element under constant pressure, pushed past its friction limit
sed -E -e 's/^METHOD.*/METHOD = STEP/' -e 's/^  LOAD = 2/  LOAD = 3/' \
   -e 's/^PJOINT.*/PJOINT,1,1,1,,0.83,0/' input/shear_cycles.bdf |
   awk '/^SUBCASE [3-9]/ { off = 1 } /^BEGIN BULK/ { off = 0 } !off' > "$work/friction_curve.bdf"
"$program" -q -o "$work" "$work/friction_curve.bdf" > /dev/null

# Fig. 1(b) both ways: B = C = 2 A(d/2), d from zero and from the start of the branch
for origin in CURVE BRANCH; do
   awk -v origin=$origin '/^JSHEAR/ { print; for (i = 1; i <= 2; i++) print "+,20.,200.,-1000.,-6000.,12500.,75000."
      print "+,1.,0.012," origin; skip = 3; next } skip-- > 0 { next } { print }' input/shear_cycles.bdf > "$work/origin_$origin.bdf"
   "$program" -q -o "$work" "$work/origin_$origin.bdf" > /dev/null 2>&1
done

# how far the contact of the clamped flange pair reaches beside its bolt circle, radius 40, with rings of different thickness
echo 'thickness,flexible,stiff' > "$work/flange.csv"
for t in 2 3 4 5 6 7 8 9 10 11 12; do
   for law in '1.0-3,0.5,2.0+5' '1.0-5,0.5,2.0+7'; do
      awk -v t=$t -f tests/exact/flange_thickness.awk input/flange_pair.bdf | sed "s/^JNORM.*/JNORM,1,$law/" > "$work/flange.bdf"
      "$program" -q -o "$work" "$work/flange.bdf" > /dev/null
      contact_edges "$query" "$work/flange.joint.csv"
   done | awk -v t=$t '{ reach[NR] = $2 - 40 } END { print t "," reach[1] "," reach[2] }' >> "$work/flange.csv"
done

# the column on its bed: frequencies against the preload of its bolts; the same foot welded to the bed; its response
echo 'preload,unload1,unload2,load1,load2' > "$work/vibration.csv"
mkdir -p "$work/vibration"
cp input/vibration/column.inc "$work/vibration"
column() { # PRELOAD: the row of the four frequencies
   sed -E "s/^(BOLT +[0-9]+ +[0-9]+ +).*/\1$1.0     1/" input/column_modes_02.bdf > "$work/column.bdf"
   "$program" -q -o "$work" "$work/column.bdf" > /dev/null 2>&1
   awk -F, -v p="$1" 'NR > 1 && $2 < 3 { row = row "," $3 } END { print p row }' "$work/column.modes.csv"
}
for preload in 1000 2000 4000 8000 16000 32000 64000; do column $preload >> "$work/vibration.csv"; done
sed -i -E 's/^\+ +20$/+,,,,,20,,1/; /^P?JOINT/d; /^JNORM/d; /^JSHEAR/d; /^\+ +75.0/d' "$work/vibration/column.inc"
column 8000 > "$work/welded.csv"
"$program" -q -o "$work" input/column_modes_08.bdf > /dev/null 2>&1

# the bolted lap: its backbone, and three loops in more increments
"$program" -q -o "$work" input/bolted_lap.bdf > /dev/null 2>&1
sed -E 's/^JAMPL.*/JAMPL,6,1,1.0,3,0.03,2,16/' input/bolted_lap.bdf > "$work/bolted_loops.bdf"
"$program" -q -o "$work" "$work/bolted_loops.bdf" > /dev/null 2>&1

# the Brake-Reuss beam beside the published points
"$program" -q -o "$work" input/brake_reuss.bdf > /dev/null 2>&1

rm -rf "$work/drawn"
mkdir "$work/drawn"
for table in "$work"/*.csv; do awk -f "$here/rounded.awk" "$table" "$table" > "$work/drawn/${table##*/}"; done

for chart in a b c; do
   awk -v title="Fig. 6($chart)" -f "$here/chart.awk" "$here/README.md" > "$here/fig6$chart.svg"
   echo "$here/fig6$chart.svg"
done
for script in "$here"/*.gp; do
   name=$(basename "$script" .gp)
   for terminal in 'pngcairo size 1000,700 font "DejaVu Sans,14"' 'svg size 1000,700 font "Helvetica,14" background "white"'; do
      suffix=${terminal%% *}
      suffix=${suffix%cairo}
      gnuplot -e "set terminal $terminal; set output '$here/$name.$suffix'; folder = '$work/drawn/'; includes = '$here/'" \
         "$here/style.inc" "$script"
   done
   echo "$here/$name.png, .svg"
done
