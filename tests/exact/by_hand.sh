# Increments done again from the numbers of the listing alone: input/by_hand.bdf as the comments of the deck do it, what SHEAR decides while
# the pressure changes, what removes an element; and the distance from the laws.

# state NODE INCREMENT COLUMN, element NODE INCREMENT COLUMN: a number of stage 1 in the listing
state() { table by_hand "STATE OF THE INTERFACE ELEMENTS OF JOINT 1, STAGE 1, INCREMENT $2" | awk -v n="$1" -v c="$3" '$2 == n { print $c }'; }
element() { table by_hand "INTERFACE ELEMENTS OF JOINT 1, STAGE 1, INCREMENT $2" | awk -v n="$1" -v c="$3" '$2 == n { print $c }'; }

run_input by_hand && {
   read -r k11 k12 k22 f1 f2 <<< "$({ table by_hand '[K_B] CONDENSED'; table by_hand 'LOAD CONDENSED'; } |
      awk '$1 == "7Y" && NF == 3 { print $2, $3 } $1 == "10Y" && NF == 3 { print $3 } NF == 4 && /^ *[0-9]+Y/ { print $4 }' | xargs)"
   read -r k7 k10 du7 du10 <<< "$(awk -v k11="$k11" -v k12="$k12" -v k22="$k22" -v f1="$f1" -v f2="$f2" -v s7="$(state 7 1 5)" \
      -v s10="$(state 10 1 5)" \
      -v share="$(awk '/^ STAGE 1, INCREMENT 2 / { print $6 }' "$work/by_hand.out")" 'BEGIN {
         k7 = 50000 * sqrt(s7 / 200); k10 = 50000 * sqrt(s10 / 200)
         d = (k11 + k7) * (k22 + k10) - k12 * k12
         printf "%.9g %.9g %.9g %.9g\n", k7, k10, share * ((k22 + k10) * f1 - k12 * f2) / d, share * ((k11 + k7) * f2 - k12 * f1) / d }')"
   near 'by hand, increment 2: k_n of node 7' "$(cell by_hand 1 2 7 k_n)" "$k7" 1e-5
   near 'by hand, increment 2: k_n of node 10' "$(cell by_hand 1 2 10 k_n)" "$k10" 1e-5
   near 'by hand, increment 2: lambda of node 7' "$(cell by_hand 1 2 7 lambda)" "$(element 7 1 8) - ($du7)" 2e-5
   near 'by hand, increment 2: lambda of node 10' "$(cell by_hand 1 2 10 lambda)" "$(element 10 1 8) - ($du10)" 2e-5
   near 'by hand, increment 2: force of node 7' "$(cell by_hand 1 2 7 force)" "$(state 7 1 5) - $k7*($du7)" 2e-5
   near 'by hand, increment 2: force of node 10' "$(cell by_hand 1 2 10 force)" "$(state 10 1 5) - $k10*($du10)" 2e-5
   # the same numbers stand in the comments of the deck
   for words in "${k7:0:7} *${k10:0:7}" '1.02950E-3 *1.36571E-3' '5.74836 *8.59821' '22.19 %'; do
      says 'by hand: the comments' input/by_hand.bdf "$words"
   done
   says 'by hand: kind of stiffness' "$work/by_hand.out" ' 7  5.66577E-04  6.73247E-04  2.50000E+03   SECANT$'
   says 'by hand: the line on the screen' "$work/by_hand.log" \
      'by_hand.bdf: STEP is up to 24.1 % of the largest deflection away from its law, at node 10 in stage 1, increment 3; METHOD = NEWTON'
   says 'by hand: the same warning in the listing' "$work/by_hand.out" '^  WARNING: STEP IS UP TO 24.1 % OF THE LARGEST DEFLECTION AWAY FROM ITS LAW, AT NODE 10 IN STAGE 1, INCREMENT 3;'
   says 'by hand: the warning is counted' "$work/by_hand.out" '^ END OF LISTING .* 1 WARNING$'
   says 'by hand: counted on the screen' "$work/by_hand.log" '1 warning in the listing'
   judge 'by hand: the share stands before the increment, the tables of a stage behind all of its increments' '
      /^ STAGE [0-9]+, INCREMENT [0-9]+   SHARE/ { now = $2 + 0 " " $4 + 0; shares++ }
      /STAGE [0-9]+, INCREMENT [0-9]+/ && !/SHARE|WARNING/ { match($0, /STAGE [0-9]+, INCREMENT [0-9]+/); split(substr($0, RSTART, RLENGTH), w, /[ ,]+/)
         if (w[2] " " w[4] != now || w[2] == ended) print NR ": " $0 }
      /^ INCREMENTS OF STAGE/ { ended = $4 + 0 }
      END { if (shares != 6) print shares " increments"; print "checked " shares }' "$work/by_hand.out"
}

# NEWTON is on its laws, and says nothing; nor does STEP within 2 %.
sed 's/^SPC = 1/METHOD = NEWTON\n&/' input/by_hand.bdf > "$work/exactly.bdf"
run exactly && same 'by hand, NEWTON: no line on the screen' "$(grep -c 'STEP is' "$work/exactly.log")" 0
sed '/^JNORM/s/0.5 /1.0 /' input/by_hand.bdf | sed '/^SUBCASE 2/,/OUTPUT/d' > "$work/straight.bdf"
run straight && {
   same 'by hand, a straight law: no line on the screen' "$(grep -c 'STEP is' "$work/straight.log")" 0
   says 'by hand, a straight law: no warning' "$work/straight.out" '^ END OF LISTING .* 0 WARNINGS$'
   same 'by hand, a straight law: no distance' "$(table straight 'DISTANCE FROM THE LAWS' | awk '$3 > 0 && NF == 6' | grep -c .)" 0
}

# A_i B_i of Fig. 3 from the history: all elements of prism03 that load, their largest |lambda - c sqrt(p)| of the largest lambda
run_input prism03 && same 'prism03: distance from the laws' \
   "$(table prism03 'DISTANCE FROM THE LAWS' | awk '$1 ~ /^[123]$/ { printf "%.2f %d ", $3, $4 }')" \
   "$(awk -F, 'FNR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next }
      { k = $c["increment"]; l = $c["lambda"]; d = l - 8e-3*sqrt($c["pressure"]); if (d < 0) d = -d
        if (l > most[k]) most[k] = l
        if (d > far[k]) { far[k] = d; node[k] = $c["node1"] } }
      END { for (k = 1; k <= 3; k++) printf "%.2f %d ", 100*far[k]/most[k], node[k] }' "$work/prism03.joint.csv")"

# The force that removed an element: what it had, and what the stiffness used has added to it
sed 's/^\( *\)OUTPUT *=.*//; s/^BEGIN BULK/&/; 0,/^SUBCASE/s/^SUBCASE/OUTPUT = JOINT\n&/' input/prism_history.bdf > "$work/removed.bdf"
run removed && judge 'the force that removed an element' '
   /^ [A-Z]/ { t = 0 }
   /^ INTERFACE ELEMENTS/ { t = 1 }
   /^ ELEMENTS REMOVED/ { t = 2 }
   t && $1 !~ /^[0-9]+$/ { next }
   t == 1 { had[$1] = force[$1]; way[$1] = $8 - lambda[$1]; force[$1] = $10; lambda[$1] = $8; k[$1] = $11; open[$1] = $7 == "OPEN" }
   t == 2 { n++; by_hand = had[$1] + k[$1]*way[$1]
            if (!open[$1] || $4 >= 0 || ($3 - had[$1])^2 > 1e-8*$3^2 || ($4 - by_hand)^2 > (1e-5*k[$1]*lambda[$1] + 1e-4*had[$1])^2 || ($5 - lambda[$1])^2 > 1e-8*$5^2) print $0 ", by hand " by_hand }
   /INTERFACE ELEMENTS? REMOVED/ { if ($(NF - 4) + 0 != n && index($0, " " n " INTERFACE") == 0) print n " removed: " $0 }
   END { print "checked " n + 0 }' "$work/removed.out"

# SHEAR while the pressure changes: branch, point A, o, b0 and c0 after every increment and K_S of the next one, from what is printed of
# the increments before. The path turns on all branches, and comes to the loading curve of either sense.
cards shear_by_hand <<'DECK'
METHOD = STEP;UNITS = MM, KGF;OUTPUT = JOINT, STATE;SUBCASE 1;  LOAD = 1;  INCR = 10
SUBCASE 2;  LOAD = 2;  INCR = 10;SUBCASE 3;  LOAD = 3;  INCR = 11
SUBCASE 4;  LOAD = 4;  INCR = 10;SUBCASE 5;  LOAD = 5;  INCR = 10
SUBCASE 6;  LOAD = 6;  INCR = 10;SUBCASE 7;  LOAD = 7;  INCR = 11
BEGIN BULK;GRID,1,,0.,0.,0.;CJOINT,1,1,1,,100.,0.,1.,0.;PJOINT,1,1,1;JNORM,1,8.-3,.5,9500.
JSHEAR,1,20.,100.,-1000.,-2000.,10000.,40000.;+,20.,100.,-500.,-1000.,2500.,10000.;+,20.,100.,-500.,-1000.,2500.,10000.;+,1.,.01
FORCE,1,1,,10.,0.,-1.;FORCE,2,1,,80.,0.,-1.;FORCE,2,1,,20.,1.,0.;FORCE,3,1,,30.,0.,-1.;FORCE,3,1,,-20.,1.,0.
FORCE,4,1,,60.,0.,-1.;FORCE,4,1,,14.,1.,0.;FORCE,5,1,,40.,0.,-1.;FORCE,5,1,,-10.,1.,0.;FORCE,6,1,,70.,0.,-1.
FORCE,6,1,,30.,1.,0.;FORCE,7,1,,50.,0.,-1.;FORCE,7,1,,-45.,1.,0.;JINCR,10,10,ARITH,.1;JINCR,11,16,ARITH,.0625;ENDDATA
DECK
run shear_by_hand && {
   judge 'SHEAR by hand' '
      function curve(c, d) { return (c[1] + c[2]*p)*d + (c[3] + c[4]*p)*d^2 + (c[5] + c[6]*p)*d^3 }
      function slope(c, d) { return (c[1] + c[2]*p) + 2*(c[3] + c[4]*p)*d + 3*(c[5] + c[6]*p)*d^2 }
      function off(x, y, size) { return (x - y)^2 > (2e-5*size)^2 }
      function sign(x) { return x < 0 ? -1 : 1 }
      # what SHEAR decides for the next increment from the states at the two ends of the last one
      function decide(   back, was, g, d1, d2, t1, t2, e1, e2) {
         was = branch; back = s*(delta - delta_1)
         if (back^2 > 1e-24) {
            back = back < 0
            if (back) { if (branch == "LOAD") { d_r = s*delta_1; tau_r = s*tau_1 } branch = "UNLOAD" }
            else if (branch == "UNLOAD") branch = "RELOAD"
         }
         if (branch != was) { side = 0; d_t = s*delta_1; tau_t = s*tau_1 }
         if (branch == "LOAD") return
         g = branch == "UNLOAD" ? -s : s
         d1 = g*delta_1; d2 = g*delta; t1 = g*tau_1; t2 = g*tau
         if (d2 < 0) return
         if (d1 < 0) { t1 -= (t2 - t1)*d1/(d2 - d1); d1 = 0 }
         e1 = t1 - curve(a, d1) - o; e2 = t2 - curve(a, d2) - o
         if (side) e1 = side
         side = sign(e2)
         if (e2^2 < 1e-12*t2^2 || (e1 > 0) != (e2 > 0) || (d2 >= d_r && side > 0)) { s = g; branch = "LOAD" }
      }
      FNR == 1 { split("20 100 -1000 -2000 10000 40000", a); split("20 100 -500 -1000 2500 10000", b); s = 1; branch = "LOAD" }
      /^ [A-Z]/ { t = 0 }
      /^ INTERFACE ELEMENTS/ { t = 1 }
      /^ SHEAR IN DIRECTION/ { t = 2 }
      /^ STATE OF SHEAR/ { t = 3 }
      $1 != 1 { next }
      t == 1 { p = $9 }
      t == 2 { delta_1 = delta; tau_1 = tau; delta = $4; tau = $5
               if (n && off($7, 100*k, 100*k)) print "increment " n + 1 ": K_S " $7 ", by hand " 100*k }
      t == 3 { n++; decide()
               k = branch == "LOAD" ? slope(a, s*delta) : slope(b, s*delta)
               if (branch == "LOAD") { o = s*tau - curve(a, s*delta); side = 0; shift = 0 }
               else { shift = tau_t - curve(b, d_t)
                      g = branch == "UNLOAD" ? -s : s
                      if (g*delta >= d_r && slope(a, g*delta) > k) k = slope(a, g*delta) }
               if (branch != was) { turns = turns " " branch; was = branch }
               if ($3 != branch || $4 != s || off($7, d_r, 0.01) || off($8, tau_r, 0.3) || off($9, o, 0.3) || off($NF, shift, branch == "LOAD" ? 1e9 : 1))
                  print "increment " n ": " $0 ", by hand " branch, s, d_r, tau_r, o, shift }
      END { print "checked " n turns }' "$work/shear_by_hand.out"
   says 'SHEAR by hand: the branches' "$work/judge.log" 'LOAD UNLOAD RELOAD UNLOAD RELOAD LOAD UNLOAD'
}
