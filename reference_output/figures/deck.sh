#!/usr/bin/env bash
# Pictures of any deck: of its joints from their history, pressure and deflection along the joint, loops; of its response to loads
# that oscillate, amplitude over frequency; of its backbones. Needs gnuplot.
#
#    deck.sh PROGRAM DECK WORK_FOLDER      PROGRAM -: the results are in WORK_FOLDER already
set -u
export LC_ALL=C
program=$1 deck=$2 work=$3
here=$(dirname "$0")
[ -f "$deck" ] || { echo "there is no deck $deck"; exit 1; }
command -v gnuplot > /dev/null || { echo 'make figures needs gnuplot: apt-get install gnuplot-nox'; exit 1; }
mkdir -p "$work"
status=0
[ "$program" = - ] || "$program" -q -o "$work" "$deck" > /dev/null || status=$?
[ $status -eq 0 ] || { echo "$deck ended with status $status: nothing is drawn"; exit $status; }

name=$(basename "$deck")
name=${name%.*}
tables="$work/$name.tables"
rm -rf "$tables"
mkdir "$tables"
awk -v folder="$tables" -f "$here/joint_tables.awk" "$work/$name.joint.csv" || exit 1
if [ -s "$work/$name.response.csv" ]; then
   awk -v folder="$tables" -f "$here/response_tables.awk" "$work/$name.response.csv" || exit 1
fi
[ ! -s "$work/$name.backbone.csv" ] || awk -F, 'NR > 1 && !seen[$1]++ { print $1 }' "$work/$name.backbone.csv" > "$tables/backbones"
[ -s "$tables/joints" ] || [ -s "$tables/responses" ] || [ -s "$tables/backbones" ] ||
   { echo "$deck has no joint, nor a response: nothing is drawn"; exit 1; }
touch "$tables/joints" "$tables/responses" "$tables/backbones"
for table in backbone loop; do
   [ ! -s "$work/$name.$table.csv" ] || awk -f "$here/rounded.awk" "$work/$name.$table.csv" "$work/$name.$table.csv" > "$tables/$name.$table.csv"
done
# in the listing: UNITS, LABELS ONLY: LENGTH MM, FORCE KGF
read -r length force <<< "$(sed -n 's/^ *UNITS, LABELS ONLY: LENGTH \([^,]*\), FORCE \(.*\)/\1 \2/p' "$work/$name.out" |
   tr 'A-Z' 'a-z' | sed -E 's/ ([km]?)n *$/ \1N/; q')"

quoted() { printf "'%s'" "${1//\'/\'\'}"; }
draw() { # PICTURE SETTINGS SCRIPT
   gnuplot -e "set terminal pngcairo size 1000,700 font 'DejaVu Sans,14'; set output $(quoted "$1")" \
      -e "folder = $(quoted "$tables/"); deck = $(quoted "$name"); $2" \
      -e "length_unit = '${length:-}'; force_unit = '${force:-}'" \
      "$here/style.inc" "$here/$3" || exit 1
   echo "$1"
}
while read -r joint shape quantities; do
   # the largest pressure that an element ever had: the first, the last and three between
   sort -t, -k1,1gr -k2,2n "$tables/$joint.peaks" |
      awk -F, '{ element[NR] = $2 }
         END { for (k = 0; k < 5 && NR; k++) { i = 1 + int(k*(NR - 1)/4 + 0.5); if (!seen[i]++) print element[i] } }' \
      > "$tables/$joint.chosen"
   awk -v joint="$joint" -f "$here/joint_loops.awk" "$tables/$joint.chosen" "$work/$name.joint.csv" > "$tables/$joint.loops"
   for quantity in $quantities; do
      draw "$work/$name.$joint.$quantity.png" "joint = '$joint'; shape = '$shape'; quantity = '$quantity'" joint.inc
   done
done < "$tables/joints"
while read -r stage; do
   draw "$work/$name.response.$stage.png" "stage = '$stage'" response.inc
done < "$tables/responses"
while read -r stage; do
   for picture in backbone loops; do
      draw "$work/$name.$picture.$stage.png" "stage = '$stage'" $picture.inc
   done
done < "$tables/backbones"
