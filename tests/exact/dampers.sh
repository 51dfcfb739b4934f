# Viscous dampers, B of CBUSH, CDAMP1 to CDAMP4 and CVISC, in a response: [k] - omega^2 [m] + i omega [b] solved by hand.

answers() { awk -F, -v node="$2" -v along="${3:-x}" 'NR > 1 && $3 == node && $4 == along { print $2, $5, $6 }' "$work/$1.response.csv"; } # NAME NODE [DIRECTION]
# listed WORDS WITHIN AWK NAME NODE [DIRECTION]: AWK computes RE and IM of each of these answers and calls check
listed() {
   judge "$1" -v pi="$pi" -v within="$2" 'function times(a, b) { re = a[1]*b[1] - a[2]*b[2]; im = a[1]*b[2] + a[2]*b[1] }
      function over(a, b,   s) { s = b[1]^2 + b[2]^2; re = (a[1]*b[1] + a[2]*b[2])/s; im = (a[2]*b[1] - a[1]*b[2])/s }
      function check(   p) {
         p = $3*pi/180
         if (!(($2*cos(p) - re)^2 + ($2*sin(p) - im)^2 <= within^2*(re^2 + im^2 + size^2))) print $0 ", expected " re " " im
         n++
      }
      { w = 2*pi*$1 } END { print "checked " n } '"$3" <(answers "$4" "$5" "${6:-x}")
}
asked='SUBCASE 1\n  MODES = 5\n  DLOAD = 20\n  FREQUENCY = 7\n  RESPONSE = SET 1\nBEGIN BULK'

# ---- A mass on a bush, K 6000 and B 4, without other damping; at its frequency too
natural=$(number "sqrt(6000/0.02)/(2*$pi)")
on_bush() { # NAME CONTROL CARDS
   printf '%b\n' "$2" 'GRID,1,,0.0,0.0,0.0\nGRID,2,,0.0,0.0,0.0\nCBUSH,1,7,1,2,,,,0\nPBUSH,7,K,6000.0,6000.0,6000.0,9000.0\n+,,B,4.0,,,3.0' \
      "CONM2,2,1,,0.02\n+,0.05\nSPC1,1,2356,1\nSPC1,1,123456,2\nFREQ,7,30.0,$natural,100.0,1000.0\n$3\nENDDATA" > "$work/$1.bdf"
   run "$1"
}
pulled='DAREA,30,1,1,3.0\nRLOAD1,20,30,,,3.0'
alone='BEGIN { k = 6000; m = 0.02; c = 4 } { a[1] = 9; a[2] = 0; b[1] = k - m*w^2; b[2] = w*c; over(a, b); check() }'
on_bush bush_b 'SOL 108\nCEND\nMODEL = SPACE\nSPC = 1\nDLOAD = 20\nFREQ = 7\nSET 1 = 1\nRESPONSE = SET 1\nBEGIN BULK' "$pulled" && {
   listed 'B of a bush, SOL 108' 1e-10 "$alone" bush_b 1
   same '... every frequency' "$(answers bush_b 1 | wc -l)" 4
   same '... has an effect' "$(grep -c 'without effect.*PBUSH' "$work/bush_b.out")" 0
}
on_bush bush_modes "MODEL = SPACE\nSPC = 1\nSET 1 = 1\n$asked" "$pulled\nEIGRL,5,,,2" && listed 'B of a bush, MODES' 1e-10 "$alone" bush_modes 1
# its support moves with an acceleration of 9: u/u_0 = (k + i w c)/(k - m w^2 + i w c)
on_bush bush_moved "MODEL = SPACE\nSPC = 1\nSET 1 = 1\n$asked" 'SPCD,30,2,1,9.0\nRLOAD1,20,30,,,1.0,,ACCE\nEIGRL,5,,,2' && \
   listed 'B of a bush whose support moves' 1e-9 \
      '{ a[1] = -9/w^2*6000; a[2] = -9/w^2*w*4; b[1] = 6000 - 0.02*w^2; b[2] = w*4; over(a, b); check() }' bush_moved 1
sed 's/^FREQ,.*/FREQ,7,0.0/' "$work/bush_moved.bdf" > "$work/bush_away.bdf"
run bush_away 3 && says 'a support that accelerates for ever' "$work/bush_away.log" 'at 0 a support that has a velocity or an acceleration moves without bound'
# its peak between two frequencies lies at omega sqrt(1 - g^2/2), g = c omega/k
sed 's/^FREQ,.*/FREQ,7,10.0,1000.0/; s/^+,,B,4.0/+,,B,8.0/' "$work/bush_modes.bdf" > "$work/bush_peak.bdf"
run bush_peak && near 'B of a bush: a peak that is missed' "$(sed -n 's/.*ITS PEAK BETWEEN .*: AT \([^ ]*\) NODE.*/\1/p' "$work/bush_peak.out")" \
   "$natural*sqrt(1 - 8^2/(6000*0.02)/2)" 1e-5

# ---- A mass on a bush, K1 6000, K6 9000, and two CVISC: CE 4 along (0.6, 0.8, 0), CR 3 about z; an arm of 1 shows the rotation
printf '%b\n' 'SOL 108\nCEND\nMODEL = SPACE\nSPC = 1\nDLOAD = 20\nFREQ = 7\nSET 1 = 1,5\nRESPONSE = SET 1\nBEGIN BULK' \
   'GRID,1,,0.0,0.0,0.0\nGRID,2,,0.0,0.0,0.0\nGRID,3,,3.0,4.0,0.0\nGRID,4,,0.0,0.0,9.0\nGRID,5,,1.0,0.0,0.0\nRBE2,9,1,123456,5' \
   'CBUSH,1,7,1,2,,,,0\nPBUSH,7,K,6000.0,6000.0,6000.0,,,9000.0\nCVISC,2,8,1,3\nCVISC,3,9,1,4\nPVISC,8,4.0,,,9,5.0,3.0\nCONM2,4,1,,0.02\n+,,,,,,0.05' \
   'SPC1,1,2345,1\nSPC1,1,123456,2,3,4\nFREQ,7,30.0,100.0,1000.0\nDAREA,30,1,1,3.0\nDAREA,30,1,6,2.0\nRLOAD1,20,30,,,3.0\nENDDATA' > "$work/cvisc.bdf"
run cvisc && {
   listed 'CE of a CVISC' 1e-10 '{ a[1] = 9; a[2] = 0; b[1] = 6000 - 0.02*w^2; b[2] = w*4*0.36; over(a, b); check() }' cvisc 1
   listed 'CR of a CVISC' 1e-10 '{ a[1] = 6; a[2] = 0; b[1] = 9000 - 0.05*w^2; b[2] = w*3; over(a, b); check() }' cvisc 5 y
   same 'CVISC has an effect' "$(grep -c 'without effect.*CVISC' "$work/cvisc.out")" 0
}

# ---- Two masses: 3000 and B 2 to the ground, 5000 and B 6 between, PARAM G 0.02. The force 3 acts on the second mass.
chain() { # NAME CONTROL CARDS
   printf '%b\n' "SET 1 = 1,2\n$2$asked" "PDAMP,7,1.0,8,2.0\nPARAM,G,0.02\nEIGRL,5,,,2\nRLOAD1,20,20,,,1.0\nFREQ1,7,0.0,7.0,30\n$3\nENDDATA" > "$work/$1.bdf"
   run "$1" && for node in 1 2; do
      listed "$1, mass $node" 1e-10 'BEGIN { node = '$node' }
         { a[1] = 8000 - 0.02*w^2; a[2] = 8000*0.02 + w*8; b[1] = -5000; b[2] = -5000*0.02 - w*6; d[1] = 5000 - 0.05*w^2; d[2] = 5000*0.02 + w*6
           times(a, d); det[1] = re; det[2] = im; times(b, b); det[1] -= re; det[2] -= im
           x[1] = node == 2 ? 3*a[1] : -3*b[1]; x[2] = node == 2 ? 3*a[2] : -3*b[2]; over(x, det); check() }' "$1" $node
   done
}
chain dampers_1_2 'SPC = 1\n' 'GRID,1,,0.0,0.0\nGRID,2,,10.0,0.0\nSPC1,1,2,1,2\nCELAS2,1,3000.0,1,1\nCELAS2,2,5000.0,1,1,2,1
CDAMP1,3,8,1,1\nCDAMP2,4,6.0,2,1,1,1\nCONM2,5,1,,0.02\nCONM2,6,2,,0.05\nDAREA,20,2,1,3.0'
chain dampers_3_4 '' 'SPOINT,1,2\nCELAS4,1,3000.0,1\nCELAS4,2,5000.0,1,2\nCDAMP3,3,8,1\nCDAMP4,4,6.0,2,1\nCMASS4,5,0.02,1\nCMASS4,6,0.05,2\nDAREA,20,2,,3.0'

# ---- A large mass is accelerated and a small one hangs on it, k = 6000 (1 + 0.05 i): the mode moves the large one by 1E-11 of the other
printf '%b\n' "SPC = 1\nSET 1 = 2\n${asked/MODES/MODES(FREE)}" 'GRID,1,,0.0,0.0\nGRID,2,,10.0,0.0\nSPC1,1,2,1,2\nSUPORT,1,1\nCELAS2,1,6000.0,1,1,2,1' \
   'CONM2,5,1,,2.0+9\nCONM2,6,2,,0.02\nPARAM,G,0.05\nEIGRL,5,,,2\nDAREA,20,1,1,5.0+9' \
   'RLOAD1,20,20,,,1.0\nFREQ1,7,20.0,17.0,8\nENDDATA' > "$work/large_mass.bdf"
run large_mass && listed 'a mass on a large one that is accelerated' 1e-6 '{ k[1] = 6000; k[2] = 300; a[1] = 6000 - 2e9*w^2; a[2] = 300; d[1] = 6000 - 0.02*w^2; d[2] = 300
   times(a, d); det[1] = re; det[2] = im; times(k, k); det[1] -= re; det[2] -= im; x[1] = 5e9*k[1]; x[2] = 5e9*k[2]; over(x, det); check() }' large_mass 2

# ---- A rod of forty elements with a damper at its end, of a third of the impedance of the rod: [k] - w^2 [m] + i w [b] by elimination.
# Few modes are those up to twice the frequencies, with the static response to load and damper: within 1.5 % of F/(w b).
for n in 40 ''; do
   name=damped_rod$n
   { printf '%b\n' "SPC = 1\nSET 1 = 41\n$asked"
      for i in $(seq 41); do echo "GRID,$i,,$((i*10 - 10)).0,0.0"; done
      for i in $(seq 40); do echo "CROD,$i,1,$i,$((i + 1))"; done
      printf '%b\n' 'PROD,1,1,2.0\nMAT1,1,9000.0,,0.3,0.01\nPARAM,COUPMASS,1\nCDAMP2,99,6.0,41,1\nSPC1,1,12,1\nSPC1,1,2,2,THRU,41' \
         "EIGRL,5,,,$n\nDAREA,20,41,1,3.0\nRLOAD1,20,20,,,1.0\nFREQ1,7,0.1,0.5,10\nENDDATA"; } > "$work/$name.bdf"
   run $name || continue
   [ "$n" ] || holds 'a rod with a damper: few modes' "$(awk 'NR > 1' "$work/$name.modes.csv" | wc -l) < 12"
   listed "a rod with a damper, ${n:-few} modes" "$([ "$n" ] && echo 1e-9 || echo 0.015)" \
      '{ k = 1800; m = 0.2; d[1] = 2*(k - w^2*m/3); d[2] = 0; e[1] = -k - w^2*m/6; e[2] = 0; times(e, e); s[1] = re; s[2] = im
         for (i = 2; i <= 40; i++) { if (i > 2) over(s, p); p[1] = d[1] - (i > 2 ? re : 0); p[2] = d[2] - (i > 2 ? im : 0) }
         over(s, p); x[1] = k - w^2*m/3 - re; x[2] = w*6 - im; a[1] = 3; a[2] = 0; over(a, x); size = 3/(w*6); check() }' $name 41
done
