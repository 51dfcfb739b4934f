#!/usr/bin/env bash
# Pictures of the joints of any deck, from its joint history: pressure and deflection along the joint, loops. Needs gnuplot.
#
#    deck.sh PROGRAM DECK WORK_FOLDER
set -u
export LC_ALL=C
program=$1 deck=$2 work=$3
here=$(dirname "$0")
[ -f "$deck" ] || { echo "there is no deck $deck"; exit 1; }
command -v gnuplot > /dev/null || { echo 'make figures needs gnuplot: apt-get install gnuplot-nox'; exit 1; }
mkdir -p "$work"
"$program" -q -o "$work" "$deck" > /dev/null
status=$?
[ $status -eq 0 ] || { echo "$deck ended with status $status: nothing is drawn"; exit $status; }

name=$(basename "$deck")
name=${name%.*}
tables="$work/$name.tables"
rm -rf "$tables"
mkdir "$tables"
awk -v folder="$tables" -f "$here/joint_tables.awk" "$work/$name.joint.csv" || exit 1
[ -s "$tables/joints" ] || { echo "$deck has no joint: nothing is drawn"; exit 1; }
# in the listing: UNITS, LABELS ONLY: LENGTH MM, FORCE KGF
read -r length force <<< "$(sed -n 's/^ *UNITS, LABELS ONLY: LENGTH \([^,]*\), FORCE \(.*\)/\1 \2/p' "$work/$name.out" |
   tr 'A-Z' 'a-z' | sed -E 's/ ([km]?)n *$/ \1N/; q')"

quoted() { printf "'%s'" "${1//\'/\'\'}"; }
draw() { # JOINT SHAPE QUANTITY
   local picture="$work/$name.$1.$3.png"
   gnuplot -e "set terminal pngcairo size 1000,700 font 'Helvetica,14'; set output $(quoted "$picture")" \
      -e "folder = $(quoted "$tables/"); joint = '$1'; shape = '$2'; quantity = '$3'; deck = $(quoted "$name")" \
      -e "length_unit = '${length:-}'; force_unit = '${force:-}'" \
      "$here/style.inc" "$here/joint.inc" || exit 1
   echo "$picture"
}
while read -r joint shape quantities; do
   # the largest pressure that an element ever had: the first, the last and three between
   sort -t, -k1,1gr -k2,2n "$tables/$joint.peaks" |
      awk -F, '{ element[NR] = $2 }
         END { for (k = 0; k < 5 && NR; k++) { i = 1 + int(k*(NR - 1)/4 + 0.5); if (!seen[i]++) print element[i] } }' \
      > "$tables/$joint.chosen"
   awk -v joint="$joint" -f "$here/joint_loops.awk" "$tables/$joint.chosen" "$work/$name.joint.csv" > "$tables/$joint.loops"
   for quantity in $quantities; do draw "$joint" "$shape" "$quantity"; done
done < "$tables/joints"
