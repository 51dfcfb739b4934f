# input/by_hand.bdf: increment 2 from the numbers of the listing alone, as the comments of the deck do it.

# state NODE INCREMENT COLUMN, element NODE INCREMENT COLUMN: a number of stage 1 in the listing
state() { table by_hand "STATE OF THE INTERFACE ELEMENTS OF JOINT 1, STAGE 1, INCREMENT $2" | awk -v n="$1" -v c="$3" '$2 == n { print $c }'; }
element() { table by_hand "INTERFACE ELEMENTS OF JOINT 1, STAGE 1, INCREMENT $2" | awk -v n="$1" -v c="$3" '$2 == n { print $c }'; }

run_input by_hand && {
   read -r k11 k12 k22 f1 f2 <<< "$({ table by_hand '[K_B] CONDENSED'; table by_hand 'LOAD CONDENSED'; } |
      awk '$1 == "7Y" && NF == 3 { print $2, $3 } $1 == "10Y" && NF == 3 { print $3 } NF == 4 && /^ *[0-9]+Y/ { print $4 }' | xargs)"
   read -r k7 k10 du7 du10 <<< "$(awk -v k11="$k11" -v k12="$k12" -v k22="$k22" -v f1="$f1" -v f2="$f2" -v s7="$(state 7 1 5)" \
      -v s10="$(state 10 1 5)" 'BEGIN {
         k7 = 50000 * sqrt(s7 / 200); k10 = 50000 * sqrt(s10 / 200)
         d = (k11 + k7) * (k22 + k10) - k12 * k12
         printf "%.9g %.9g %.9g %.9g\n", k7, k10, 0.2 * ((k22 + k10) * f1 - k12 * f2) / d, 0.2 * ((k11 + k7) * f2 - k12 * f1) / d }')"
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
   near 'by hand, increment 2: distance from the law of node 10' "$(table by_hand 'DISTANCE FROM THE LAWS, STAGE 1' | awk '$1 == 2 && $4 == 10 { print $3 }')" \
      "100*($(cell by_hand 1 2 10 lambda) - 0.008*sqrt($(cell by_hand 1 2 10 pressure)))/$(cell by_hand 1 2 10 lambda)" 5e-5
   says 'by hand: kind of stiffness' "$work/by_hand.out" ' 7  5.66577E-04  6.73247E-04  2.50000E+03   SECANT$'
   says 'by hand: the line on the screen' "$work/by_hand.log" \
      'by_hand.bdf: STEP is up to 24.1 % of the largest deflection away from its law, at node 10 in stage 1, increment 3; METHOD = NEWTON'
}

# NEWTON is on its laws, and says nothing; nor does STEP within 2 %.
sed 's/^SPC = 1/METHOD = NEWTON\n&/' input/by_hand.bdf > "$work/exactly.bdf"
run exactly && same 'by hand, NEWTON: no line on the screen' "$(grep -c 'STEP is' "$work/exactly.log")" 0
sed '/^JNORM/s/0.5 /1.0 /' input/by_hand.bdf | sed '/^SUBCASE 2/,/OUTPUT/d' > "$work/straight.bdf"
run straight && {
   same 'by hand, a straight law: no line on the screen' "$(grep -c 'STEP is' "$work/straight.log")" 0
   same 'by hand, a straight law: no distance' "$(table straight 'DISTANCE FROM THE LAWS' | awk '$3 > 0 && NF == 6' | grep -c .)" 0
}
