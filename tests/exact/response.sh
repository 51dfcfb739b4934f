# Damping of materials and springs, and the frequencies at which a response is asked for, by hand.

# hung NAME CASE CARDS: a mass of 0.02 on a rod (k = 3000, GE 0.05), a CELAS2 (k = 1000, GE 0.01) and a CELAS1 (k = 2000, GE 0.2) in
# parallel along x, pulled with 3; across x it is held. CASE: lines of case control, CARDS: of the bulk data
k=6000 mass=0.02 pull=3
eta='((3000*0.05 + 1000*0.01 + 2000*0.2)/6000)'
hung() {
   printf '%b\n' "SPC = 1\nSET 1 = 1\nSUBCASE 1\n  MODES = 5\n$2\nBEGIN BULK" \
      'GRID,1,,100.0,0.0\nGRID,2,,0.0,0.0\nCROD,1,1,2,1\nPROD,1,1,100.0\nMAT1,1,3000.0,,,,,,0.05' \
      'CELAS2,2,1000.0,1,1,,,0.01\nCELAS1,3,7,1,1\nPELAS,7,2000.0,0.2\nCONM2,4,1,,0.02\nSPC1,1,12,2\nSPC1,1,2,1\nEIGRL,5,,,1' \
      "$3" 'FORCE,20,1,,3.0,1.0\nENDDATA' > "$work/$1.bdf"
   run "$1" "${4:-0}"
}
asked='  FREQUENCY = 7\n  DLOAD = 20\n  RESPONSE = SET 1'
amplitude() { awk -F, -v f="$2" 'NR > 1 && $4 == "x" && $2 - f < 1e-9*f && f - $2 < 1e-9*f { print $5 }' "$work/$1.response.csv"; } # NAME FREQUENCY
phase() { awk -F, -v f="$2" 'NR > 1 && $4 == "x" && $2 - f < 1e-9*f && f - $2 < 1e-9*f { print $6 }' "$work/$1.response.csv"; }
f0=$(number "sqrt($k/$mass)/(2*$pi)")

# ---- structural damping: the loss factor is the sum of GE times the shares of the strain energy; at resonance F/(k eta)
hung ge "$asked" 'FREQ4,7' && {
   near 'GE: loss factor of the mode' "$(mode ge 1 loss_factor)" "$eta" 1e-13
   near 'GE: amplitude at resonance' "$(amplitude ge "$f0")" "$pull/($k*$eta)" 1e-10
   near 'GE: phase at resonance' "$(phase ge "$f0")" -90 1e-9
   near 'GE: a tenth below' "$(amplitude ge "$(number "0.9*$f0")")" "$pull/($k*sqrt((1 - 0.81)^2 + $eta^2))" 1e-10
   says 'GE: the listing says whose loss it is' "$work/ge.out" 'LOSS FACTORS OF MATERIALS (GE, PARAM G) ALONE'
   same 'GE: it has an effect' "$(grep -c 'without effect' "$work/ge.log")" 0
}
hung ge_g "$asked" 'FREQ4,7\nPARAM,G,0.03' && {
   near 'PARAM G: loss factor of the mode' "$(mode ge_g 1 loss_factor)" "$eta + 0.03" 1e-13
   near 'PARAM G: amplitude at resonance' "$(amplitude ge_g "$f0")" "$pull/($k*($eta + 0.03))" 1e-10
}
# beside SDAMPING, which is viscous: i (eta lambda + g omega omega_0); with KDAMP -1 structural
table='TABDMP1,8,G\n+,0.0,0.1,1.0E5,0.1,ENDT'
hung viscous "$asked\n  SDAMPING = 8" "FREQ4,7\n$table" && near 'GE beside SDAMPING' "$(amplitude viscous "$(number "0.9*$f0")")" \
   "$pull/($k*sqrt((1 - 0.81)^2 + ($eta + 0.1*0.9)^2))" 1e-10
hung kdamp "$asked\n  SDAMPING = 8" "FREQ4,7\n$table\nPARAM,KDAMP,-1" && near 'GE beside structural SDAMPING' \
   "$(amplitude kdamp "$(number "0.9*$f0")")" "$pull/($k*sqrt((1 - 0.81)^2 + ($eta + 0.1)^2))" 1e-10
# a bar that oscillates along itself, every mode has the loss factor of its material
oscillating_bar solid 40 CONSISTENT MODES && {
   sed -i 's/^\(MAT1,1,[^$]*\)$/&,,,0.04/; s/^MASS.*/&\nSET 1 = 41/; s/^  LOAD.*/&\n  FREQUENCY = 7\n  DLOAD = 10\n  RESPONSE = SET 1/; s/^EIGRL.*/&\nFREQ4,7,0.0,1.0E4,0.05,1/' \
      "$work/solid.bdf"
   run solid && for j in 1 2 3; do near "GE of a bar: mode $j" "$(mode solid $j loss_factor)" 0.04 1e-12; done
}
# from the second mode on, the response at rest has the first one in its static part: F L/(E A)
oscillating_bar upper 200 CONSISTENT MODES && {
   sed -i 's/^MASS.*/&\nSET 1 = 402/; s/^  LOAD.*/&\n  FREQUENCY = 7\n  DLOAD = 10\n  SDAMPING = 8\n  RESPONSE = SET 1/
      s/^EIGRL.*/EIGRL,5,4.0E3,,3\nFREQ,7,0.0\nTABDMP1,8,G\n+,0.0,0.02,1.0E5,0.02,ENDT/; s/^FORCE,.*/FORCE,10,402,,0.5,1.0\nFORCE,10,401,,0.5,1.0/' "$work/upper.bdf"
   run upper && same 'from the second mode on: its number' "$(mode upper 2 mode)" 2 &&
      near '... the response at rest' "$(awk -F, '$4 == "x" { print $5 }' "$work/upper.response.csv")" '500/(2.1E5*20)' 1e-9
}
# together with what the joint loses at an amplitude
mass_on_joint alone '' && mass_on_joint sprung '' && {
   sed -i 's/^CJOINT.*/&\nCELAS2,2,20000.0,1,1,,,0.3/' "$work/sprung.bdf"
   run sprung && near 'GE beside the loss of a joint' "$(mode sprung 2 loss_factor)" \
      "($(mode alone 2 loss_factor)*(400 + 150*1.3)*100 + 0.3*20000)/((400 + 150*1.3)*100 + 20000)" 1e-12
}
# PARAM COUPMASS chooses the mass as MASS does
oscillating_bar lumped 10 LUMPED MODES && oscillating_bar coupled 10 CONSISTENT MODES && {
   for value in -1 1; do
      name=$([ $value = 1 ] && echo coupled || echo lumped)
      sed "/^MASS/d; s/^EIGRL.*/&\nPARAM,COUPMASS,$value/" "$work/$name.bdf" > "$work/coupmass.bdf"
      run coupmass && near "PARAM COUPMASS $value is $name mass" "$(mode coupmass 1 frequency)" "$(mode $name 1 frequency)" 1e-14
   done
   sed "s/^EIGRL.*/&\nPARAM,COUPMASS,1/" "$work/lumped.bdf" > "$work/both.bdf"
   run both 2 && says 'MASS = LUMPED and COUPMASS 1' "$work/both.log" 'PARAM COUPMASS asks for consistent mass, but MASS in case control does not'
}

# ---- what has no effect is named, what would have another one is an error
sed '/MODES = /d; /^EIGRL/d; s/^  RESPONSE.*//' "$work/ge_g.bdf" | sed '/FREQUENCY\|DLOAD/d; s/^SUBCASE.*/&\n  LOAD = 20/; s/^PARAM.*/&\nPARAM,ALPHA1,0.1\nPARAM,POST,-1\nPARAM,COUPMASS,1\nPARAM,POST,0/' > "$work/still.bdf"
run still && same 'entries without effect in statics' "$(sed -n 's/.*still.bdf: \(.*without effect\)/\1/p' "$work/still.log")" \
   '9 entries without effect: SET, PARAM POST, GE of MAT1, GE of CELAS2, GE of PELAS, PARAM G, PARAM ALPHA1, PARAM COUPMASS'
hung alpha "$asked" 'FREQ4,7\nPARAM,ALPHA1,0.1' 2 && says 'PARAM ALPHA1' "$work/alpha.log" 'PARAM ALPHA1: this card would change the response'
hung lmodes "$asked" 'FREQ4,7\nPARAM,LMODES,20' 2 && says 'PARAM LMODES' "$work/lmodes.log" 'EIGRL say which modes take part'
hung undamped "$asked" 'FREQ4,7' && {
   sed -i 's/,0.05$//; s/,0.01$//; s/,0.2$//' "$work/undamped.bdf"
   run undamped 2 && says 'no damping at all' "$work/undamped.log" 'FREQUENCY: expected damping: SDAMPING, AMPLITUDE'
}

# ---- FREQ4: NFM frequencies from (1 - FSPD) to (1 + FSPD) times that of the mode, an odd number; modes out of its range have none
frequencies() { awk -F, 'NR > 1 && $4 == "x" { printf "%.15g ", $2 }' "$work/$1.response.csv"; }
grid() { # NAME WORDS SHARES...: its frequencies are these shares of f0
   local i=0 found=($(frequencies "$1")) words=$2
   shift 2
   same "$words: so many" ${#found[@]} $#
   for share; do near "$words: number $((i + 1))" "${found[i]:-0}" "$share*$f0" 1e-12; i=$((i + 1)); done
}
hung spread "$asked" 'FREQ4,7,10.0,1000.0,0.3,7' && grid spread 'FREQ4' 0.7 0.8 0.9 1 1.1 1.2 1.3
hung spread "$asked" 'FREQ4,7,,,0.2,4' && grid spread 'FREQ4, NFM even' 0.8 0.9 1 1.1 1.2
hung spread "$asked" 'FREQ4,7' && grid spread 'FREQ4, blank' 0.9 1 1.1
hung spread "$asked" 'FREQ4,7,,,,1' && grid spread 'FREQ4, NFM 1' 1
hung spread "$asked" "FREQ4,7\nFREQ1,7,$(number "0.95*$f0"),$(number "0.1*$f0"),1" && grid spread 'FREQ4 and FREQ1' 0.9 0.95 1 1.05 1.1
hung spread "$asked" 'FREQ4,7,500.0,1000.0\nFREQ1,7,10.0,10.0,1' && same 'FREQ4, the mode out of its range' "$(frequencies spread)" '10 20 '
hung spread "$asked" 'FREQ4,7,500.0,1000.0' && says 'FREQ4, no mode in its range' "$work/spread.out" 'NO MODE FOUND IS IN THE RANGE OF FREQ4'

# ---- a peak between two frequencies is warned of, by the mode and what it would be
warned() { grep -c 'HAS ITS PEAK BETWEEN THE REQUESTED FREQUENCIES' "$work/$1.out"; }
hung coarse "$asked" 'FREQ1,7,0.0,60.0,4' && {
   same 'a missed peak: one warning' "$(warned coarse)" 1
   line=$(grep 'HAS ITS PEAK' "$work/coarse.out")
   same 'a missed peak: mode, node and component' "$(sed -E 's/ AT [^ ]+ / AT F /; s/ X [^ ]+, IN THE TABLE .*;/ X A;/' <<< "$line")" \
      '  WARNING: MODE 1 HAS ITS PEAK BETWEEN THE REQUESTED FREQUENCIES: AT F NODE 1 X A; SEE FREQ4'
   near 'a missed peak: its frequency' "$(sed -E 's/.* AT ([^ ]+) NODE.*/\1/' <<< "$line")" "$f0" 1e-5
   near 'a missed peak: its amplitude' "$(sed -E 's/.* X ([^,]+), .*/\1/' <<< "$line")" "$pull/($k*$eta)" 1e-5
   near 'a missed peak: beside it' "$(sed -E 's/.* IN THE TABLE ([^;]+);.*/\1/' <<< "$line")" "$(amplitude coarse 60)" 1e-5
   says 'a missed peak: counted' "$work/coarse.log" '1 warning in the listing'
}
hung coarse "$asked\n  SDAMPING = 8" "FREQ1,7,0.0,60.0,4\nTABDMP1,8,G\n+,0.0,0.2,1.0E5,0.2,ENDT" && near 'a missed viscous peak: its frequency' \
   "$(sed -nE 's/.*PEAK.* AT ([^ ]+) NODE.*/\1/p' "$work/coarse.out")" "$f0*sqrt(1 - 0.02)" 1e-5
hung fine "$asked" 'FREQ1,7,0.0,2.0,120' && same 'a fine FREQ1 misses no peak' "$(warned fine)" 0
hung ahead "$asked" 'FREQ1,7,0.0,10.0,8' && same 'a peak beyond the frequencies asked for is not missed' "$(warned ahead)" 0
hung both "$asked" 'FREQ1,7,0.0,60.0,4\nFREQ4,7' && same 'with FREQ4 beside FREQ1 no peak is missed' "$(warned both)" 0
# a mode without damping has no bound
mass_on_joint bare '' && {
   sed -i 's/^METHOD.*/&\nSET 1 = 1/; s/^  AMPLITUDE.*/&\n  FREQUENCY = 7\n  DLOAD = 20\n  RESPONSE = SET 1/; s/^EIGRL.*/&\nFREQ1,7,0.0,200.0,2\nFORCE,20,1,,1.0,3.0,4.0/' \
      "$work/bare.bdf"
   run bare && says 'an undamped peak' "$work/bare.out" 'MODE 1 HAS ITS PEAK BETWEEN .* NODE 1 Y NO BOUND'
}

# FREQ2: logarithmic intervals; SOL 103 with METHOD = n is MODES = n: a mass on a spring, whose response is asked at three decades
cards decades <<'DECK'
SOL 103;CEND;SPC = 1;METHOD = 4;FREQUENCY = 5;DLOAD = 10;SDAMPING = 6;RESPONSE = SET 7;SET 7 = 4
BEGIN BULK;BLOCK2,1,1,1,1,0.0,0.0;+,8.0,5.0;PSHELL,1,1,2.0;MAT1,1,9500.0,,0.0,8.0-10;SPC1,1,1,1,2,3,4;SPC1,1,2,1,3
FORCE,10,4,,1.0,0.0,1.0;EIGRL,4,,,1;FREQ2,5,10.0,10000.0,3;TABDMP1,6;+,0.0,0.01,1.0+6,0.01,ENDT;ENDDATA
DECK
run decades && same 'FREQ2: three decades' "$(awk -F, 'NR > 1 && !seen[$2 + 0]++ { printf "%.6g ", $2 }' "$work/decades.response.csv")" '10 100 1000 10000 '

# ---- A mode that neither load nor damping reaches: a mass on two rods at right angles, turned by 30 degrees; GE in one of them, the load
# along it. The mode along the other one has no response, by either solver; the response at resonance is F/(k eta)
for solver in SKYLINE TREE; do
   printf '%b\n' "SOLVER = $solver\nMODEL = PLANE\nSPC = 1\nSET 1 = 1\nSUBCASE 1\n  MODES = 5\n$asked\nBEGIN BULK" 'GRID,1,,0.0,0.0\nGRID,2,,-86.60254037844386,-50.0' \
      'GRID,3,,50.0,-86.60254037844386\nCROD,1,1,2,1\nCROD,2,2,3,1\nPROD,1,1,100.0\nPROD,2,2,100.0\nMAT1,1,3000.0,,,,,,0.05\nMAT1,2,2000.0' \
      'CONM2,4,1,,0.02\nSPC1,1,12,2,3\nEIGRL,5,,,2\nFREQ4,7,,,0.05,3\nFORCE,20,1,,3.0,0.8660254037844386,0.5\nENDDATA' > "$work/apart.bdf"
   run apart && judge "a mode without load and damping, $solver" -F, 'NR == 1 { next } { n++; if ($5 > most) most = $5; if ($5 > 3/(3000*0.05)*1.0001) print $0 }
      END { if ((most/(3/(3000*0.05)*sqrt(3)/2) - 1)^2 > 1e-8) print "largest " most; print "checked " n }' "$work/apart.response.csv"
   same "a mode without damping, $solver" "$(number "$(mode apart 1 loss_factor)")" 0
done

# ---- A bar without supports: the response by 8 modes with the residual flexibility is that of its equations
free_bar() { # NAME MODES
   { printf '%b\n' "MODEL = PLANE\nMASS = CONSISTENT\nSPC = 1\nSET 1 = 1, 11, 41\nSUBCASE 1\n  MODES(FREE) = 5\n$asked\nBEGIN BULK"
     for i in $(seq 1 41); do echo "GRID,$i,,$((5*i)).0,0.0"; [ "$i" -lt 41 ] && echo "CBAR,$i,1,$i,$((i + 1))"; done
     printf '%b\n' "PBAR,1,1,100.0,1.0E4,1.0E4,1.0E4\nMAT1,1,2.0E5,,0.3,7.85E-9\nSPC1,1,123456,1\nPARAM,G,0.02\nEIGRL,5,,,$2\nFREQ1,7,500.0,500.0,4\nFORCE,20,1,,3.0,1.0\nFORCE,20,11,,-1.0,1.0\nENDDATA"; } > "$work/$1.bdf"
   run "$1"
}
# free_bar_awk: the same bar integrated here, (1 + 0.02i) [k] - omega^2 [m] of the 40 elements, by elimination along the bar
free_bar_awk='function times(a, b) { re = a[1]*b[1] - a[2]*b[2]; im = a[1]*b[2] + a[2]*b[1] }
   function over(a, b,   n) { n = b[1]^2 + b[2]^2; re = (a[1]*b[1] + a[2]*b[2])/n; im = (a[2]*b[1] - a[1]*b[2])/n }
   FNR > 1 && $4 == "x" { n++; b = amplitude($2, $3); if ((($5 - b)/b)^2 > within^2) print $0 ", by hand " b } END { print "checked " n }
   function amplitude(f, node,   i, s, k, w, d, e, r) {
      w = 4*pi^2*f^2*7.85e-9*100*5/6; k = 2e5*100/5; e[1] = -k - w; e[2] = -0.02*k
      for (i = 1; i <= 41; i++) { s = i == 1 || i == 41 ? 1 : 2; d[i, 1] = s*(k - 2*w); d[i, 2] = s*0.02*k; r[i, 1] = i == 1 ? 3 : i == 11 ? -1 : 0; r[i, 2] = 0 }
      for (i = 2; i <= 41; i++) { a[1] = d[i - 1, 1]; a[2] = d[i - 1, 2]; over(e, a); c[1] = re; c[2] = im
         times(c, e); d[i, 1] -= re; d[i, 2] -= im; q[1] = r[i - 1, 1]; q[2] = r[i - 1, 2]; times(c, q); r[i, 1] -= re; r[i, 2] -= im }
      for (i = 41; i >= node; i--) { q[1] = r[i, 1]; q[2] = r[i, 2]; if (i < 41) { times(e, u); q[1] -= re; q[2] -= im }
         a[1] = d[i, 1]; a[2] = d[i, 2]; over(q, a); u[1] = re; u[2] = im }
      return sqrt(u[1]^2 + u[2]^2)
   }'
free_bar free_all 120 && judge 'without supports, all modes' -F, -v pi=$pi -v within=1e-6 "$free_bar_awk" "$work/free_all.response.csv"
for n in 8 20; do
   free_bar free_$n $n && judge "without supports, $n modes" -F, -v pi=$pi -v within=0.05 "$free_bar_awk" "$work/free_$n.response.csv"
   same "without supports, $n modes: nothing is missing" "$(grep -c 'BY THESE MODES ALONE' "$work/free_$n.out")" 0
done

# ---- The loss of a joint with AMPLITUDE, the mode turned against its axes: the limit is that of the resultant
for angle in 0 30 45 70; do
   printf '%b\n' "METHOD = NEWTON\nMODEL = SPACE\nSPC = 1\nSUBCASE 1\n  LOAD = 10\n  MODES = 5\n  AMPLITUDE = 0.02\nBEGIN BULK" \
      "GRID,1,,0.0,0.0,0.0\nGRID,2,,$(number "100*cos($angle*$pi/180)"),$(number "100*sin($angle*$pi/180)"),0.0\nCROD,1,1,1,2\nPROD,1,1,100.0\nMAT1,1,1000.0,,0.3\nSPC1,1,123,2" \
      'CJOINT,11,1,1,,100.0,0.0,0.0,-1.0\nPJOINT,1,1,2,2,0.2\nJNORM,1,8.0-3,0.5,50000.0\nJSHEAR,2,40.0\nFORCE,10,1,,1.0,0.0,0.0,-130.0\nCONM2,4,1,,0.02\nEIGRL,5,,,2\nENDDATA' |
      awk 'length($0) > 0' > "$work/turned_loss.bdf"
   run turned_loss && {
      near "loss across the rod, $angle degrees" "$(mode turned_loss 1 loss_factor)" '4*26*(0.02 - 26/4000)/('$pi'*4000*0.02^2)' 1e-6
      near "loss along the rod, $angle degrees" "$(mode turned_loss 2 loss_factor)" '4*26*(0.02 - 26/4000)/('$pi'*5000*0.02^2)' 1e-6
   }
done

# ---- Frequencies above the modes: a mass on a rod along x (k = 3000) and one along y (k = 48000), pulled along both, eta = 0.05. With
# ND = 1 the frequencies above mode 1 are named, with the mass that moves; blank ND and V2 take the modes up to twice the frequencies.
covered() { # NAME EIGRL FREQUENCIES
   printf '%b\n' "MODEL = PLANE\nSPC = 1\nSET 1 = 1\nSUBCASE 1\n  MODES = 5\n$asked\nBEGIN BULK" 'GRID,1,,0.0,0.0\nGRID,2,,-100.0,0.0\nGRID,3,,0.0,-100.0' \
      'CROD,1,11,2,1\nCROD,2,12,3,1\nPROD,11,1,100.0\nPROD,12,2,100.0\nMAT1,1,3000.0,,,,,,0.05\nMAT1,2,48000.0,,,,,,0.05' \
      "CONM2,4,1,,0.02\nSPC1,1,12,2,3\nEIGRL,5$2\n$3\nFORCE,20,1,,1.0,3.0,4.0\nENDDATA" > "$work/$1.bdf"
   run "$1"
}
low=$(number "sqrt(3000/0.02)/(2*$pi)") high=$(number "sqrt(48000/0.02)/(2*$pi)")
covered covered_nd ',,,1' "FREQ1,7,0.0,$(number "$high/16"),32" && {
   line=$(grep 'ABOVE THE HIGHEST MODE' "$work/covered_nd.out")
   same 'frequencies above the modes: how many' "$(sed -E 's/.*WARNING: ([0-9]+ OF [0-9]+) FREQUENCIES.*/\1/' <<< "$line")" '28 OF 33'
   near '... above which mode' "$(sed -nE 's/.*HIGHEST MODE, MODE 1 AT ([^:]+):.*/\1/p' <<< "$line")" "$low" 1e-5
   near '... up to which' "$(sed -nE 's/.*UP TO ([^,]+), ARE.*/\1/p' <<< "$line")" "2*$high" 1e-5
   says '... the effective mass' "$work/covered_nd.out" 'EFFECTIVE MASS OF 100.0 % ALONG X, 0.0 % ALONG Y'
   says '... counted' "$work/covered_nd.log" '1 warning in the listing'
}
covered covered '' "FREQ1,7,0.0,$(number "$high/16"),32" && {
   same 'blank ND and V2: the modes of the frequencies' "$(awk 'NR > 1' "$work/covered.modes.csv" | wc -l)" 2
   near '... the peak of the second' "$(awk -F, -v f="$high" '$4 == "y" && ($2/f - 1)^2 < 1e-18 { print $5 }' "$work/covered.response.csv")" '4/(48000*0.05)' 1e-9
   same '... no warning' "$(grep -c 'ABOVE THE HIGHEST' "$work/covered.out")" 0
}
covered covered_4 '' 'FREQ4,7,0.0,1000.0' && same 'the range of FREQ4: its modes' "$(awk 'NR > 1' "$work/covered_4.modes.csv" | wc -l)" 2
covered covered_few '' "FREQ1,7,0.0,$(number "0.1*$low"),10" && same 'twice the highest frequency, and no more' "$(awk 'NR > 1' "$work/covered_few.modes.csv" | wc -l)" 1
covered covered_v2 ",,$(number "1.5*$low")" "FREQ1,7,0.0,$(number "0.15*$low"),10" && same 'up to V2 all modes are there' "$(grep -c 'ABOVE THE HIGHEST' "$work/covered_v2.out")" 0

# ---- No bound: what is complete stays, with the mode and the part that has no damping
sed 's/^MAT1,2,48000.*/MAT1,2,48000.0/; s/^  MODES/  LOAD = 20\n&/; s/^FREQ1.*/FREQ1,7,'"$high"',1.0/' "$work/covered.bdf" > "$work/unbound.bdf"
"$program" -q -o "$work" --summary "$work/unbound.csv" "$work/unbound.bdf" > "$work/unbound.log" 2>&1
same 'a response without bound' $? 3
says '... names the part' "$work/unbound.log" 'the response is unbounded: mode 2 has no damping; 100 % of its strain energy is in BAR 2: expected GE on its MAT1, or PARAM,G'
same '... keeps the modes' "$(awk 'NR > 1' "$work/unbound.modes.csv" | wc -l)" 2
near '... and the statics' "$(awk -F, '$2 == 0 { print $3 }' "$work/unbound.stage.csv")" "sqrt((3/3000)^2 + (4/48000)^2)" 1e-9
says '... marked in the listing' "$work/unbound.out" '^ ENDED EARLY   AT STAGE 1, INCREMENT 1: 1 STAGE'
says '... and in the summary' "$work/unbound.csv" 'ENDED EARLY at stage 1'
says '... with the tables of the modes' "$work/unbound.out" '^ PARTICIPATION AND EFFECTIVE MASS'
# a moment at the end of a massless cantilever with a mass there; without RESPONSE the file has the node that is loaded. At resonance M L^2/(2 E I eta)
cards shaken_moment <<'DECK'
SOL 111;CEND;MODEL = PLANE;SPC = 1;METHOD = 5;FREQUENCY = 7;DLOAD = 20;BEGIN BULK;EIGRL,5,,,1;FREQ4,7;PARAM,G,0.04;GRID,1,,0.0,0.0;GRID,2,,100.0,0.0
CBAR,1,1,1,2,0.0,1.0,0.0;PBAR,1,1,400.0,80.0,80.0,60.0;MAT1,1,210000.0,,0.3;SPC1,1,126,1;CONM2,3,2,,0.3;DAREA,30,2,6,3.0;RLOAD1,20,30,,,1.0;ENDDATA
DECK
run shaken_moment && near 'a moment that oscillates' \
   "$(awk -F, 'NR > 1 && $4 == "y" && $5 > a { a = $5 } END { print a }' "$work/shaken_moment.response.csv")" '3*100^2/(2*210000*80*0.04)' 1e-9
