# Numbers of input/README.md and input/cards.md: a part of pages.sh. What the program prints is taken from runs, or from
# reference_output, which compare/check.sh compares with runs; what follows by hand is computed here.

# round FORMAT EXPRESSION
round() { awk "BEGIN { printf \"$1\", $2 }"; }
# guide WORDS TEXT: the guide has the text, however its lines are broken
guide_text=$(awk '!/^ *(\||```)/ && NF { sub(/^ +/, ""); printf "%s ", $0 }' $guide)
guide() { case $guide_text in *"$2"*) passed=$((passed + 1)) ;; *) fail "$1: '$2' does not stand in $guide" ;; esac; }

# ---- the decks of the folder: contact and frequency ----
index=$(awk -F'|' '/^## / { on = /^## The decks of this folder/ }
   on && $2 ~ /^ `/ { gsub(/[ `]/, "", $2); gsub(/ /, "", $5); gsub(/ /, "", $6); print $2, $5 "/" $6 }' $guide)
found=$(while read -r name _; do
   awk -v name="$name" '/^ *JOINT CONTACT %/ { table = 1; next }
      table && /^ *[0-9]+ +[0-9.]+ / { if (!n++ || $2 + 0 < least + 0) least = $2; next }
      table && !/^ *[NM1K]/ { table = 0 }
      / MODE +FREQUENCY +OMEGA/ { modes = 1; above = 0; next }
      modes && /^ +[0-9]+ / && $2 > 1e-3 && !above++ { hz = $2 }
      /^ [A-Z]/ { modes = 0 }
      END { print name, (n ? sprintf("%.0f%%", least) : "") "/" (hz ? sprintf("%.1fHz", hz) : "") }' "reference_output/$name.out"
done <<< "$index")
same 'the decks: contact and frequency (<), of the listings (>)' "$(diff <(echo "$index") <(echo "$found"))" ''

# processor time, relative to that of all these decks together: within a factor of two, below a second of three
seconds() { local TIMEFORMAT=%U; { time OMP_NUM_THREADS=1 "$program" -q -o "$work" "input/$1.bdf" > /dev/null 2>&1; } 2>&1; }
awk -F'|' '/^## / { on = /^## The decks of this folder/ }
   on && $2 ~ /^ `/ && $7 + 0 > 0 { gsub(/[ `]/, "", $2); print $2, $7 + 0 }' $guide |
   while read -r name said; do echo "$name $said $(seconds "$name" < /dev/null)"; done > "$work/seconds.txt"
judge 'the decks: CPU s' '{ said[$1] = $2; took[$1] = $3; all_said += $2; all_took += $3 }
   END { for (name in said) { r = took[name]/said[name]*all_said/all_took; n++; most = said[name] < 1 ? 3 : 2
            if (r > most || r < 1/most) print name ": " said[name] " s in the table, " took[name] " s of " all_took " s here" }
         print "checked " n + 0 }' "$work/seconds.txt"

# ---- cases from one state: the table ----
command=$(block $guide 'Cases from one state' 1 | sed -n '1s/^\$ //p')
same 'cases from one state: the table' "$(block $guide 'Cases from one state' 1 | tail -n +2)" "$(bash -c "${command/mine/reference_output}" | sed 's/ *$//')"

# ---- the first deck: areas of influence ----
same 'the first deck: areas' "$(round %g "$(cell block 1 5 1 area)") $(round %g "$(cell block 1 5 4 area)")" '250 500'
guide 'the first deck: areas' 'a_i is 250 mm2 at the two ends and 500 mm2 between'

# ---- a column foot: the answers, by the listing ----
foot() { awk -v stage="$1" "/ANSWER AT THE END OF STAGE/ { on = \$7 == stage } on && $2" reference_output/column_foot.out; }
answers() { shown "a column foot, $1" $guide "$2"; }
tool() { foot "$1" '/^ +9001 / { printf "%.1f N/um along '"$2"'", $NF/1000 }'; }
answers 'stiffness at the tool' "| $(tool 2 x), $(tool 3 y)."
share() { foot 2 "/^ +$1 +$2 +[-0-9.]+ +[-0-9.]+ +[-0-9.]+( |\$)/ && !/E\\+/ { printf \"%.0f %%\", \$3 }"; }
answers 'what gives way' "| column with foot $(share BODY 2), joint $(share JOINT 1), bed $(share BODY 1), bolts"
answers 'proof stress' "| $(foot 3 '/OF ST %/ { n = NR + 2 } NR == n { printf "%.0f %%", $7 }') of the proof stress; at 50 % each bolt carries 50 kN |"
least=$(foot 3 '/SHARE/ && /LOSS/ { table = NR + 1 } table && NR > table && NR <= table + 4 && $5 < least { least = $5 } END { print -100*least }')
answers 'share of the bolts' "| at most $(round %.0f "$least") % of the 2.8 kN"
answers 'contact' "| $(foot 3 '/JOINT CONTACT/ { n = NR + 2 } NR == n { printf "%.0f", $2 }') % of the joint is in contact; around bolt 1 the clamping force falls by $(foot 3 '/LOSS %/ { n = NR + 2 } NR == n { printf "%.0f", $10 }') % |"
answers 'slip' "| $(foot 3 '/JOINT CONTACT/ { n = NR + 2 } NR == n { printf "%.1f", $NF }') as a whole; $(foot 3 '/LOSS %/ { n = NR + 2 } NR == n { printf "%.1f", $NF }') around bolt 1"
answers 'forces on the bed' "| $(foot 3 '/^ SPCM/ && !done++ { printf "%.0f N along x and y; MCX %d,000", $4, $10/1000 }') N mm = 2000 x (400 + 60) |"
modes=$(awk '/^ FREQUENCIES/ { on = 1 } on && /^ +[1-3] / && n < 3 { n++; printf("%s%.0f Hz", (n > 1 ? ", " : ""), $2) }' reference_output/column_foot.out)
answers 'frequencies' "| $modes in the tightened state. |"
answers 'frequency by hand' "| sqrt(k/m)/(2 pi) = $(round %.0f "sqrt($(tool 3 y | cut -d' ' -f1)*1e3/(0.04 + 0.24*0.023))/(2*3.14159265)") Hz with $(tool 3 y | cut -d' ' -f1) N/um"
# the box by hand: a cantilever of 370 with shear in the walls along the force, 140 x 120 with walls of 20
by_hand=$(awk '/^MAT1 +1 /{ e = substr($0, 17, 8) + 0; nu = substr($0, 33, 8) + 0; exit } END { print e, nu }' input/column_foot.bdf |
   awk '{ g = $1/(2*(1 + $2)); l = 370; printf "%.0f and %.0f", k(140, 120), k(120, 140) }
      function k(h, b,   i) { i = (b*h^3 - (b - 40)*(h - 40)^3)/12; return 1e-3/(l^3/(3*e_of(i)) + l/(g*2*20*h)) }
      function e_of(i) { return $1*i }')
answers 'the box by hand' "| $by_hand N/um"
same 'a column foot: warnings of the shear law' "$(grep -c 'BEYOND P = 2.45166 OF THE SHEAR LAW' reference_output/column_foot.out)" 3

# ---- which method ----
for name in prism05.NEWTON.1 prism05.NEWTON.2; do
   [ -s "$work/$name.joint.csv" ] || variant prism05 NEWTON "${name##*.}"
done
# closes NAME: the deflection of node 51 after the last increment
closes() { awk -v x="$(cell "$1" 1 "$(awk -F, 'END { print $2 }' "$work/$1.joint.csv")" 51 lambda)" 'BEGIN { printf "%.3f", 1000*x }'; }
guide 'which method: prism05' "closes by $(closes prism05)E-3 mm with STEP in 5 increments, $(closes prism15)E-3 in 15"
guide 'which method: BACK, NEWTON' "by $(closes prism_back)E-3 with BACK and with NEWTON in one increment"
same 'which method: NEWTON in one increment is BACK' "$(closes prism05.NEWTON.1)" "$(closes prism_back)"
guide 'which method: NEWTON' "by $(closes prism05.NEWTON.2)E-3 with NEWTON in two increments or more"
in_contact() { awk '/JOINT CONTACT %/ { n = NR + 2 } NR == n { v = $2 } END { printf "%.0f", v }' "$work/$1.out"; }
guide 'which method: contact' "the prism has $(in_contact prism05.NEWTON.1) % contact in one increment, $(in_contact prism05.NEWTON.2) % in two or more"
same 'which method: contact in 40 increments' "$(in_contact prism05.NEWTON.40)" "$(in_contact prism05.NEWTON.2)"

# ---- laws: c from books, EU, Masing, offsets ----
books=$(awk -F'|' '/^### c from books/ { on = 1; next } /^#/ { on = 0 }
   on && $2 ~ /^ micrometre/ { split($7, given, ", "); c = given[1]*len($4)*press($5)^given[2]; n++
      if (sprintf("%.5E", c) + 0 != sprintf("%.5E", $8) + 0) print $2 $3 ": c = " c ", in the table" $8 }
   function len(words) { return words + 0 }
   function press(words) { return words + 0 }
   END { if (n != 6) print n + 0 " rows" }' $guide)
same 'c from books' "$books" ''
guide 'c from books: other exponents' "for m = 0.4 the factor is $(round %.4f '100^0.4')"
guide 'choosing EU' "With c = 1E-3 mm/(N/mm2)^0.5 at 0.5 N/mm2 this slope is $(round %.0f '0.5^0.5/(0.5*1e-3)') N/mm3"
guide 'choosing EU' "1.2E5, is $(round %.0f '1.2e5/(0.5^0.5/(0.5*1e-3))') times as large"
masing=$(awk '/^### JSHEAR/ { on = 1 } on && /^JSHEAR  1 / && !n++ { p = 0.5; d = 0.01; a1 = at(3) + at(4)*p; a2 = at(5) + at(6)*p; a3 = at(7) + at(8)*p
      next } n == 1 && /^\+/ { n++; print at(2) - (a1 + a2*d + 0.75*a3*d^2), at(4) + a2/2 + 0.75*a3*d, at(6) - a3/4 }
   function at(field) { return substr($0, 8*field - 7, 8) + 0 }' $cards)
same "Masing's rule gives the first law of JSHEAR" "$(echo "$masing" | awk '{ for (i = 1; i <= 3; i++) s += $i^2; print (NF == 3 && s < 1e-18) }')" 1
awk 'BEGIN { print "lambda p"; for (i = 0; i <= 40; i++) { p = 0.09*i; printf "%.17g %.17g\n", 1.1*(sqrt(p + 0.4) - sqrt(0.4)), p } }' > "$work/zeroed.dat"
"$(dirname "$program")/jointfit" "$work/zeroed.dat" > "$work/zeroed.bdf" 2> /dev/null
guide 'a test zeroed under load' "m comes back as $(awk '/^\$ law/ { sub(/.*m = /, ""); printf "%.2f", $0 }' "$work/zeroed.bdf") and c as $(awk '/^\$ law/ { sub(/.*c = /, ""); printf "%.2f", $0 }' "$work/zeroed.bdf")"

# ---- vibration ----
first_loss=$(awk '/^ FREQUENCIES/ { on = 1 } on && /^ +1 / && !n++ { printf "%.3f", $6 }' reference_output/bolted_lap.out)
at_tenth=$(awk '/^FREQUENCY AND LOSS AGAINST AMPLITUDE|^ FREQUENCY AND LOSS AGAINST AMPLITUDE/ { on = 1 } on && $1 ~ /^1.0+E-01$/ && !n++ { printf "%.3f", $4 }' reference_output/bolted_lap.out)
guide 'bolted_lap: loss factors' "MODES gives $first_loss, the backbone $at_tenth"
guide 'off the peak' 'at 5 % from the peak of a mode of loss factor 0.01 the amplitude is a tenth of the peak'
holds 'off the peak' '0.01/sqrt((1 - 1.05^2)^2 + 0.01^2) = 0.1 within 0.005'
holds 'off the peak' '0.01/sqrt((1 - 0.95^2)^2 + 0.01^2) = 0.1 within 0.005'
# an element of stiffness 1 that slips at 1 beside a spring of 1: first harmonic of the loop against the secant, at X
harmonic() { awk -v x="$1" 'BEGIN { c = 1 - 2/x; t = atan2(sqrt(1 - c^2), c); n = (t - sin(2*t)/2)/3.14159265358979; printf "%.1f", 100*(sqrt((1 + n)/(1 + 1/x)) - 1) }'; }
guide 'first harmonic' "a frequency $(harmonic 1.2) % above the secant's at 1.2 x_s, the same at 2 x_s, $(harmonic 5 | tr -d -) % below it at 5 x_s"
same 'first harmonic at 2' "$(harmonic 2 | tr -d -)" 0.0

# ---- elements: the flanged column of the comparison with CalculiX ----
tops=$(awk -F'|' '/^\| the program, CTETRA of 10 nodes/ { print $4 + 0, $5 + 0 }' tests/programs/calculix.md)
linear=$(grep -oE 'of size 9, 42,623 nodes, give 0\.[0-9]+' tests/programs/calculix.md | awk '{ print $NF }')
less() { awk -v a="$1" -v b="${tops#* }" "BEGIN { printf \"$2\", 100*(1 - a/b) }"; }
guide 'a flanged column' "moves $(less "$linear" %.0f) % less with 42,623 nodes of linear tetrahedra than with 74,516 of second order; with 30,320 nodes of second order $(less "${tops% *}" %.1f) % less"

# ---- units: the two systems of newtons from that of kgf, and the factors of shear coefficients ----
units=$(awk -F'|' '/^## Units of the deck/ { on = 1; next } /^## / { on = 0 }
   on && $2 ~ /^ 1 kgf is/ { f = $5 + 0 } on && $2 ~ /^ E of steel/ { e = $4; n = $5; m = $6 }
   on && $2 ~ /^ 9500/ { split($6, both, ";"); if (sprintf("%.5E", 9500*f) != sprintf("%.5E", $5 + 0)) print "9500 in mm, N:" $5
      if (sprintf("%.5E", 9500*f*1e6) != sprintf("%.5E", both[1] + 0) || sprintf("%.5E", 9500*f*1e9) != sprintf("%.5E", both[2] + 0)) print "9500 in m, N:" $6 }
   END { if (sprintf("%.5E", n/f) != sprintf("%.5E", e + 0) || m != n*1e6) print "E of steel"; if (f != 9.80665) print "no table" }' $cards)
same 'units of the deck' "$units" ''
# kgf/cm2 over micrometre^k to kgf/mm2 over mm^k, or to 1/mm^k
for k in 1 2 3; do factors="${factors:-} A${k}1 by $(round %g "1000^$k/100"), A${k}2 by $(round %g "1000^$k"),"; done
guide 'shear coefficients of books' "multiply$(echo "${factors%,}" | sed -E 's/e\+0/E/g; s/1000\b/1E3/; s/10000\b/1E4/; s/\b100000\b/1E5/')."

# ---- limits of the manual of the cards ----
mkdir -p "$work/limits"
# nested N: a deck whose INCLUDE files are nested N deep
nested() {
   local k
   { sed '/^ENDDATA/d' "$work/block.bdf"; echo "INCLUDE 'nested_1.inc'"; echo ENDDATA; } > "$work/limits/nested.bdf"
   for ((k = 1; k < $1; k++)); do echo "INCLUDE 'nested_$((k + 1)).inc'" > "$work/limits/nested_$k.inc"; done
   echo '$ the last' > "$work/limits/nested_$1.inc"
}
# many N: a deck with N INCLUDE files beside each other
many() { { sed '/^ENDDATA/d' "$work/block.bdf"; for ((k = 1; k <= $1; k++)); do echo "INCLUDE 'nested_$last.inc'"; done; echo ENDDATA; } > "$work/limits/many.bdf"; }
checked() { "$program" --check "$work/limits/$1.bdf" > "$work/limits/$1.log" 2>&1; echo $?; }
read -r deep all <<< "$(sed -n 's/.* \([0-9]*\) deep, \([0-9]*\) files in all.*/\1 \2/p' <<< "$(tr '\n' ' ' < $cards)")"
nested "$deep"; same "INCLUDE, $deep deep" "$(checked nested)" 0
nested $((deep + 1)); same "INCLUDE, one deeper" "$(checked nested)" 2
last=1; echo '$' > "$work/limits/nested_1.inc"
many $((all - 1)); same "INCLUDE, $all files with the deck" "$(checked many)" 0
many "$all"; same "INCLUDE, a file more" "$(checked many)" 2
# echoed CARDS: whether the listing of a deck of so many cards prints its bulk data
echoed() {
   awk -v n="$1" '/^BEGIN/ { on = 1 } on && /^[A-Z]/ && !/^(BEGIN|ENDDATA)/ { k++ }
      /^ENDDATA/ { for (i = 1; i <= n - k; i++) print "GRID," 100000 + i ",,0.0,0.0" } { print }' "$work/block.bdf" > "$work/echoed.bdf"
   run echoed && grep -c 'GRID,100001,' "$work/echoed.out"
}
most=$(grep -oE 'a deck of more than [0-9,]+ cards' $cards | tr -dc 0-9)
same "ECHO, $most cards" "$(echoed "$most")" 1
same "ECHO, a card more" "$(echoed $((most + 1)))" 0
# BACK without AVERAGE, one element: as many iterations as the manual has
cards straight <<DECK
METHOD = BACK;AVERAGE = NO;SUBCASE 1;  LOAD = 1
BEGIN BULK;GRID,1,,0.0,0.0,,,1;CJOINT,1,1,1,,100.0,0.0,1.0;PJOINT,1,1,,,,,0.02;JNORM,1,8.0-3,0.5,500.0;FORCE,1,1,,100.0,0.0,-1.3
ENDDATA
DECK
run straight && turns=$(grep -oE 'HAVE NOT CONVERGED IN [0-9]+' "$work/straight.out" | tr -dc 0-9) &&
   same 'BACK without AVERAGE: iterations' "$(tr -s ' \n' ' ' < $cards | grep -oE 'A run not settled after [0-9]+' | tr -dc 0-9)" "$turns"

# ---- Gmsh, where it is installed: the example of the guide ----
if command -v gmsh > /dev/null; then
   mkdir -p "$work/blocks"
   block $guide 'Meshing with Gmsh, step by step' 1 > "$work/blocks/blocks.geo"
   block $guide 'Meshing with Gmsh, step by step' 2 > "$work/blocks.bdf"
   sed "s#'blocks_mesh.bdf'#'blocks/blocks_mesh.bdf'#" -i "$work/blocks.bdf"
   command=$(echo "$guide_text" | grep -oE 'gmsh -3 -order 2 [^`]*blocks.geo')
   (cd "$work/blocks" && $command) > "$work/blocks/gmsh.log" 2>&1
   sed 's/^JOINT .*/JOINT   1       1       21      20/' "$work/blocks.bdf" > "$work/turned.bdf"
   covered() { awk '/SIDE1 COVERED/ { n = NR + 2 } NR == n { print $4 + 0, $5 + 0 }' "$work/$1.out"; }
   run blocks && same 'blocks of Gmsh: covered, farthest apart' "$(covered blocks)" '1 0'
   run turned && same 'blocks of Gmsh, exchanged' "$(covered turned)" '0.5 0'
   ask 'blocks of Gmsh: pressures' blocks all 'min(pressure) = 3.4 within 0.1 and max(pressure) = 6.8 within 0.1'
fi
