#!/usr/bin/env bash
# The pictures of any deck (make figures DECK=path), drawn where gnuplot is installed, and the flow charts.
#
#    figures.sh PROGRAM FOLDER
set -u
program=$1 work=$2
source tests/exact/lib.sh
figures=reference_output/figures
rm -rf "$work"
mkdir -p "$work"

# tables NAME: those of the joint history of reference_output
tables() {
   mkdir -p "$work/$1"
   awk -v folder="$work/$1" -f $figures/joint_tables.awk "reference_output/$1.joint.csv"
   cat "$work/$1/joints"
}
same 'a row of elements, pressed' "$(tables prism05)" '1 line pressure deflection normal'
same 'it begins at its end' "$(head -n 1 "$work/prism05/1.axes")" 'distance along the joint from (0, 0, 0)'
same 'the last element of the row' "$(tail -n 1 "$work/prism05/1.along")" '150,0,0.574066504,0.00762012913'
same 'a face' "$(tables prism3d)" '1 face pressure deflection normal'
same 'a face in the plane z = 0' "$(tables post_on_plate)" '1 face pressure deflection normal shear_x shear_y'
same 'one element, pushed' "$(tables shear_cycles)" '1 point normal shear_x'
same 'two joints' "$(tables slideway | cut -d' ' -f1,2 | tr '\n' ' ')" '1 face 2 face '
same 'a block of lines for every stage' "$(tables prism_history > /dev/null; grep -c '^$' "$work/prism_history/1.along")" 4
same 'all that ever pressed' "$(wc -l < "$work/prism05/1.peaks")" 11

echo 1 > "$work/chosen"
awk -v joint=1 -f $figures/joint_loops.awk "$work/chosen" reference_output/shear_cycles.joint.csv > "$work/loops"
same 'the loops of an element: its name, rest, every increment' "$(wc -l < "$work/loops")" 83
same 'they begin at rest' "$(head -n 2 "$work/loops" | tail -n 1)" '0,0,0,0,0,0'

# seven digits, whatever the processor makes of the ones behind; ids, words and blanks stay
rounded() { awk -f $figures/rounded.awk "$work/$1" "$work/$1" | tr '\n' ' '; }
printf '%s\n' id,branch,a,b 12345678,LOAD,9.9999999951278209E-005,1.0000000000014009E+000 7,,-3.0000000000E-012,0.0 8,OPEN,-0.25,-2.5E-03 > "$work/one.csv"
printf '%s\n' id,branch,a,b 12345678,LOAD,1.0000000001278209E-004,9.9999999999914009E-001 7,,4.0000000000E-017,-0.0 8,OPEN,-0.25000000000001,-2.5E-03 > "$work/other.csv"
same 'rounded' "$(rounded one.csv)" 'id,branch,a,b 12345678,LOAD,0.0001,1 7,,0.0,0.0 8,OPEN,-0.25,-0.0025 '
same 'rounded, on another processor' "$(rounded other.csv)" "$(rounded one.csv)"

# the response of a stage: a block for every component that moves
mkdir -p "$work/response"
printf '%s\n' stage,frequency,node,component,amplitude,phase 2,5,7,x,0.5,0 2,5,7,y,0,0 2,5,9,x,0.25,-90 2,10,7,x,0.75,-180 2,10,7,y,0,0 \
   2,10,9,x,0,0 4,5,7,x,1E-3,0 > "$work/response.csv"
awk -v folder="$work/response" -f $figures/response_tables.awk "$work/response.csv"
same 'stages with a response' "$(tr '\n' ' ' < "$work/response/responses")" '2 4 '
same 'its curves, zero left out' "$(tr '\n' ' ' < "$work/response/response.2")" '"node 7 x" 5,0.5 10,0.75   "node 9 x" 5,0.25 '
same 'one curve' "$(tr '\n' ' ' < "$work/response/response.4")" '"node 7 x" 5,0.001 '

# refused DECK WORDS: ends with a status and says so
refused() {
   if $figures/deck.sh "$program" "$1" "$work" > "$work/said" 2>&1; then fail "$1: drawn"; else says "$1" "$work/said" "$2"; fi
}
refused "$work/none.bdf" "there is no deck $work/none.bdf"
if command -v gnuplot > /dev/null; then
   sed 's/^FORCE .*/FORCE   10      99              800.0   0.0     -1.0/' input/prism05.bdf > "$work/wrong.bdf"
   refused "$work/wrong.bdf" 'ended with status 2: nothing is drawn'
   cp input/lap_joint.bdf "$work/a user's deck.bdf"
   $figures/deck.sh "$program" "$work/a user's deck.bdf" "$work/pictures" > "$work/said" 2>&1
   same 'pictures of a deck' "$?" 0
   for quantity in pressure deflection normal shear_x; do
      picture="$work/pictures/a user's deck.1.$quantity.png"
      says "$quantity is named" "$work/said" "$picture"
      same "$quantity is a PNG" "$(head -c 4 "$picture" | tail -c 3)" PNG
   done
   same 'nothing else is said' "$(wc -l < "$work/said")" 4
   # the axes of a backbone do not end a decade later for the last digit of an amplitude
   for end in 9.9999999995E-005,170.0,0.0:1.0000000000014E+000 1.0000000000E-004,169.99999999999,1E-17:9.9999999999914E-001; do
      printf '%s\n' amplitude,frequency,loss_factor "${end%:*}" "1.0E-002,150.0,0.05" "${end#*:},140.0,0.07" | sed '1s/^/stage,/; 2,$s/^/2,/' > "$work/ends.csv"
      awk -f $figures/rounded.awk "$work/ends.csv" "$work/ends.csv" > "$work/ends.backbone.csv"
      gnuplot -e "set terminal svg; set output '$work/ends.svg'; folder = '$work/'; deck = 'ends'; stage = '2'; length_unit = ''" \
         $figures/style.inc $figures/backbone.inc
      cksum < "$work/ends.svg"
   done > "$work/ends"
   same 'the picture of a backbone hangs on no last digit' "$(sort -u "$work/ends" | wc -l) $([ "$(grep -c gpPt "$work/ends.svg")" -gt 6 ] && echo drawn)" '1 drawn'
fi

# The report of a deck (make report): sections, pictures and numbers of the page, and what a browser makes of it
report() { # NAME DECK SECTIONS...
   local page="$work/$1.report.html"
   python3 $figures/report.py "$program" "$2" "$work" > "$work/said" 2>&1
   same "report of $1" "$? $(cat "$work/said")" "0 $page"
   says "report of $1: its page" <(python3 tests/programs/report_check.py "$page" "$work/$1.files/$1" "${@:3}" > "$work/checked"; cat "$work/checked") \
      '^checked [1-9]'
   same "report of $1: no fault" "$(sed '$d' "$work/checked")" ''
   [ "$browser" ] || return
   python3 tests/programs/report_check.py --browser "$page" > "$work/browser.html"
   "$browser" --headless --no-sandbox --disable-gpu --dump-dom "file://$(realpath "$work")/browser.html" 2> /dev/null | tr ';<' '\n\n' > "$work/dom"
   same "report of $1: a browser shows its pictures" "$(grep -c -E 'image [1-9]|svg [1-9]' "$work/dom")" \
      "$(awk '{ print $2 + $4 }' "$work/checked")"
}
browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome)
if ! command -v gnuplot > /dev/null || ! command -v python3 > /dev/null; then
   echo 'skipped: reports of decks: gnuplot or python3 is not installed'
else
   [ "$browser" ] || echo 'skipped: the report in a browser: chromium is not installed'
   report column_foot input/column_foot.bdf answer model deflected-shape joints bolts modes warnings
   same 'joints of Tet10 are filled areas' "$(grep -o '<svg' "$work/column_foot.report.html" | wc -l) $(grep -o '<polygon' "$work/column_foot.report.html" |
      awk 'END { print (NR > 500) }')" '3 1'
   report column_modes_08 input/column_modes_08.bdf joints bolts modes response
   sed 's/^BOLT .*/BOLT,1,901,8.+4,1,,M12,8.8,1.6\n+,,,4./' input/flange_pair.bdf > "$work/threads.bdf"
   report threads "$work/threads.bdf" answer deflected-shape joints bolts
   says 'report: values of VDI 2230' "$work/threads.report.html" 'One real bolt after VDI 2230'
   python3 $figures/report.py "$program" "$work/none.bdf" "$work" > "$work/said" 2>&1
   same 'report of no deck' "$? $(cat "$work/said")" "1 there is no deck $work/none.bdf"
fi

# every word of a chart in characters is in the SVG file, which is the one that the script makes of it
for chart in a b c; do
   awk -v title="Fig. 6($chart)" -f $figures/chart.awk $figures/README.md > "$work/fig6$chart.svg"
   same "fig6$chart.svg is that of the chart" "$(cmp "$work/fig6$chart.svg" "$figures/fig6$chart.svg" 2>&1)" ''
   awk -v title="Fig. 6($chart)" '/^#/ { found = index($0, title) } /^```/ { on = found && !on; next } on' $figures/README.md |
      grep -o -E '[A-Za-z_]{2,}' | sort -u > "$work/words"
   missing=$(while read -r word; do grep -q -- "$word" "$work/fig6$chart.svg" || echo "$word"; done < "$work/words")
   same "fig6$chart.svg has all $(wc -l < "$work/words") words" "$([ -s "$work/words" ] || echo none) $missing" ' '
done
awk -v title='Fig. 9' -f $figures/chart.awk $figures/README.md > /dev/null 2>&1
same 'a chart that is not there' $? 1
echo "$passed passed, $failed failed"
[ $failed -eq 0 ] && [ $passed -gt 0 ]
