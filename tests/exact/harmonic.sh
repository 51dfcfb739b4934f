# Loads that depend on frequency, and supports that oscillate: closed forms of one and two masses on springs.

# The base of the decks: node 1, mass 0.02, on a spring of 6000 to node 2, and node 2 held; along x; loss factor 0.1
harmonic_m=0.02 harmonic_k=6000 harmonic_g=0.1
# harmonic NAME CASE CARDS [STATUS]
harmonic() {
   printf '%b\n' "$2\nBEGIN BULK" 'GRID,1,,100.0,0.0\nGRID,2,,0.0,0.0\nCROD,1,1,2,1\nPROD,1,1,100.0\nMAT1,1,6000.0\nCONM2,4,1,,0.02' \
      'SPC1,1,12,2\nSPC1,1,2,1\nEIGRL,5,,,1\nPARAM,G,0.1' "$3" 'ENDDATA' > "$work/$1.bdf"
   run "$1" "${4:-0}"
}
harmonic_modal='SOL 111\nCEND\nSET 1 = 1\nDISPLACEMENT(SORT1,PHASE) = 1\nSPC = 1\nMETHOD = 5\nFREQUENCY = 7\nDLOAD = 20'
# harmonic_answer NAME FREQUENCY [NODE]: amplitude and phase along x
harmonic_answer() { awk -F, -v f="$2" -v node="${3:-1}" 'NR > 1 && $4 == "x" && $3 == node && $2 - f < 1e-9*f && f - $2 < 1e-9*f { print $5, $6 }' \
   "$work/$1.response.csv"; }
# harmonic_near WORDS NAME RE IM: at 20, 60, 87.5 and 100 the answer of node 1 to the force RE + i IM, expressions of f in awk
harmonic_near() {
   local f found expected
   for f in 20 60 87.5 100; do
      found=($(harmonic_answer "$2" $f)) expected=($(awk -v f=$f -v m=$harmonic_m -v k=$harmonic_k -v g=$harmonic_g -v pi=$pi "
         BEGIN { re = $3; im = $4; a = k - m*(2*pi*f)^2; b = k*g; x = (re*a + im*b)/(a*a + b*b); y = (im*a - re*b)/(a*a + b*b)
                 printf \"%.15g %.15g\n\", sqrt(x*x + y*y), atan2(y, x)*180/pi }"))
      near "$1, amplitude at $f" "${found[0]:-0}" "${expected[0]}" 1e-9
      near "$1, phase at $f" "${found[1]:-0}" "${expected[1]}" 1e-8 1e-7
   done
}
harmonic_list='FREQ,7,20.0,60.0,87.5,100.0'
harmonic_c='(1 + 2*f/100)' # TABLED1 of C
harmonic_turn='(30*pi/180 - 2*pi*f*0.002)'

# ---- RLOAD1: tables and constants, delay and phase; of a DAREA, of a FORCE, of a load set by LSEQ
for of in 'DAREA,30,1,1,3.0' 'FORCE,30,1,,3.0,1.0' 'LSEQ,40,30,31\nLSEQ,41,30,32\nFORCE,31,1,,3.0,1.0\nFORCE,32,1,,9.0,1.0'; do
   harmonic rload1 "$harmonic_modal\nLOADSET = 40" \
      "$of\nRLOAD1,20,30,0.002,30.0,8,0.5\nTABLED1,8\n+,0.0,1.0,50.0,2.0,100.0,3.0,ENDT\n$harmonic_list" && {
      harmonic_near "RLOAD1 of ${of%%,*}" rload1 "3*($harmonic_c*cos($harmonic_turn) - 0.5*sin($harmonic_turn))" \
         "3*($harmonic_c*sin($harmonic_turn) + 0.5*cos($harmonic_turn))"
      same "RLOAD1 of ${of%%,*}: DISPLACEMENT has an effect" "$(grep -c 'without effect.*DISPLACEMENT' "$work/rload1.log")" 0
   }
done
# without LOADSET all LSEQ of the EXCITEID: 12 in place of 3
harmonic lseq "$harmonic_modal" 'LSEQ,40,30,31\nLSEQ,41,30,32\nFORCE,31,1,,3.0,1.0\nFORCE,32,1,,9.0,1.0\nRLOAD1,20,30,,,1.0\n'"$harmonic_list" &&
   harmonic_near 'LSEQ without LOADSET' lseq 12 0

# ---- RLOAD2: B e^(i phi), tables with logarithmic axes; outside extrapolated; DLOAD: 2 (3 RLOAD2 - 0.5 RLOAD1)
harmonic rload2 "$harmonic_modal" 'DAREA,30,1,1,1.5\nRLOAD2,20,30,,,8,9\nTABLED1,8,LOG,LOG\n+,10.0,4.0,90.0,36.0,ENDT'"\nTABLED1,9\n+,0.0,10.0,10.0,12.0,ENDT\n$harmonic_list" &&
   harmonic_near 'RLOAD2' rload2 '1.5*0.4*f*cos((10 + 0.2*f)*pi/180)' '1.5*0.4*f*sin((10 + 0.2*f)*pi/180)'
harmonic half_log "$harmonic_modal" 'DAREA,30,1,1,1.5\nRLOAD1,20,30,,,8,9\nTABLED1,8,LOG\n+,10.0,1.0,1000.0,3.0,ENDT'"\nTABLED1,9,,LOG\n+,0.0,1.0,50.0,100.0,ENDT\n$harmonic_list" &&
   harmonic_near 'one logarithmic axis' half_log '1.5*log(f)/log(10)' '1.5*100^(f/50)'
harmonic dload "$harmonic_modal" "DLOAD,20,2.0,3.0,21,-0.5,22\nDAREA,30,1,1,1.0\nRLOAD2,21,30,,,0.7,90.0\nRLOAD1,22,30,,,0.4\n$harmonic_list" &&
   harmonic_near 'DLOAD' dload -0.4 4.2
# TABLED2: x - X1; TABLED3: (x - X1)/X2; TABLED4: a polynomial of (x - X1)/X2, x within X3 and X4; a jump of TABLED1: its mean
harmonic tabled2 "$harmonic_modal" "DAREA,30,1,1,1.0\nRLOAD1,20,30,,,8,9\nTABLED2,8,-10.0\n+,0.0,0.0,200.0,4.0,ENDT\nTABLED3,9,5.0,2.5\n+,-1.0,1.0,1.0,3.0,ENDT\n$harmonic_list" &&
   harmonic_near 'TABLED2, TABLED3' tabled2 '(f + 10)/50' '2 + (f - 5)/2.5'
harmonic tabled4 "$harmonic_modal" "DAREA,30,1,1,1.0\nRLOAD1,20,30,,,8,9\nTABLED4,8,10.0,20.0,30.0,90.0\n+,1.0,0.5,,0.25,ENDT\nTABLED1,9\n+,0.0,1.0,60.0,1.0,60.0,2.0,100.0,2.0\n+,ENDT\n$harmonic_list" &&
   harmonic_near 'TABLED4, a jump' tabled4 '1 + 0.5*((f < 30 ? 30 : f > 90 ? 90 : f) - 10)/20 + 0.25*(((f < 30 ? 30 : f > 90 ? 90 : f) - 10)/20)^3' \
      'f < 60 ? 1 : f > 60 ? 2 : 1.5'

# ---- supports that oscillate: u = a k (1 + i g)/(k (1 + i g) - m omega^2), a the displacement of node 2
for type in DISP VELO ACCE; do
   harmonic base "$harmonic_modal" "SPCD,30,2,1,0.25\nRLOAD1,20,30,,,2.0,,$type\n$harmonic_list" && {
      a='0.5' b='0'
      [ $type = VELO ] && a='0' b='(-0.5/(2*pi*f))'
      [ $type = ACCE ] && a='(-0.5/(2*pi*f)^2)'
      harmonic_near "SPCD, $type" base "k*($a - g*$b)" "k*($b + g*$a)"
   }
done
harmonic type "$harmonic_modal" "SPCD,30,2,1,0.25\nRLOAD1,20,30,,,2.0\n$harmonic_list" 2 && says 'SPCD without a TYPE' "$work/type.log" 'moves supports (SPCD), expected DISP'
# two masses, the second support moved, and a joint without mass in the chain: the same chain solved in complex numbers. Node 4 moves
# with 0.1; springs 4-3: 2000, 3-1: the joint, 1500*10, 1-2: 6000; one of two modes is computed, the rest is static at 0.01 of its frequency
printf '%b\n' 'SOL 111\nCEND\nSET 1 = 1,3\nDISPLACEMENT(PLOT) = 1\nSPC = 1\nMETHOD = 5\nFREQUENCY = 7\nDLOAD = 20\nBEGIN BULK' \
   'GRID,1,,100.0,0.0\nGRID,2,,0.0,0.0\nGRID,3,,100.0,0.0\nGRID,4,,200.0,0.0\nCROD,1,1,2,1\nPROD,1,1,100.0\nMAT1,1,6000.0\nCONM2,4,1,,0.02\nCONM2,5,3,,0.03' \
   'CELAS2,6,2000.0,3,1,4,1\nCELAS2,7,15000.0,1,1,3,1\nSPC1,1,12,2,4\nSPC1,1,2,1,3\nEIGRL,5,,,2\nPARAM,G,0.1' \
   "SPCD,30,4,1,0.1\nRLOAD1,20,30,,,1.0,,DISP\n$harmonic_list" ENDDATA > "$work/two.bdf"
run two && for f in 20 60 87.5 100; do
   for node in 1 3; do
      found=($(harmonic_answer two $f $node)) expected=$(awk -v f=$f -v node=$node -v g=0.1 -v pi=$pi 'BEGIN { w = (2*pi*f)^2
         ar = 21000 - 0.02*w; ai = 21000*g; br = -15000; bi = -15000*g; cr = 17000 - 0.03*w; ci = 17000*g; fr = 200; fi = 200*g
         dr = ar*cr - ai*ci - br*br + bi*bi; di = ar*ci + ai*cr - 2*br*bi # determinant
         if (node == 1) { nr = -(br*fr - bi*fi); ni = -(br*fi + bi*fr) } else { nr = ar*fr - ai*fi; ni = ar*fi + ai*fr }
         printf "%.15g", sqrt((nr*nr + ni*ni)/(dr*dr + di*di)) }')
      near "two masses, node $node at $f" "${found[0]:-0}" "$expected" 1e-9
   done
done

# ---- SOL 108: no METHOD, the modes that the frequencies need; DISPLACEMENT = ALL; without one the loaded nodes; told in the listing
harmonic direct 'SOL 108\nCEND\nDISPLACEMENT = ALL\nSPC = 1\nFREQUENCY = 7\nDLOAD = 20' "DAREA,30,1,1,3.0\nRLOAD1,20,30,,,1.0\n$harmonic_list" && {
   harmonic_near 'SOL 108' direct 3 0
   same 'SOL 108: all nodes' "$(awk -F, 'NR > 1 { n[$3] = 1 } END { print length(n) }' "$work/direct.response.csv")" 2
   says 'SOL 108: the listing' "$work/direct.out" 'SOL 108 BY ITS MODES'
}
harmonic loaded 'SOL SEDFREQ\nCEND\nSPC = 1\nFREQUENCY = 7\nDLOAD = 20' "DAREA,30,1,1,3.0\nRLOAD1,20,30,,,1.0\n$harmonic_list" &&
   same 'without DISPLACEMENT: the loaded node' "$(awk -F, 'NR > 1 { n[$3] = 1 } END { for (k in n) print k }' "$work/loaded.response.csv")" 1

# ---- FREQ3: between its ends and the modes, with a cluster; FREQ5: shares of the modes; FREQ in any order, each once
harmonic_grid() { # NAME WORDS FREQUENCIES...
   local name=$1 words=$2 i=0 found=($(awk -F, 'NR > 1 && $4 == "x" { print $2 }' "$work/$1.response.csv"))
   shift 2
   same "$words: so many" ${#found[@]} $#
   for f; do near "$words: number $((i + 1))" "${found[i]:-0}" "$f" 1e-12; i=$((i + 1)); done
}
harmonic_f0=$(number "sqrt($harmonic_k/$harmonic_m)/(2*$pi)")
harmonic freq3 "$harmonic_modal" 'DAREA,30,1,1,3.0\nRLOAD1,20,30,,,1.0\nFREQ3,7,20.0,200.0,LINEAR,5,2.0' && harmonic_grid freq3 FREQ3 20 \
   "20 + ($harmonic_f0 - 20)*(0.5 - 0.5*sqrt(0.5))" "20 + ($harmonic_f0 - 20)*0.5" "20 + ($harmonic_f0 - 20)*(0.5 + 0.5*sqrt(0.5))" $harmonic_f0 \
   "$harmonic_f0 + (200 - $harmonic_f0)*(0.5 - 0.5*sqrt(0.5))" "$harmonic_f0 + (200 - $harmonic_f0)*0.5" "$harmonic_f0 + (200 - $harmonic_f0)*(0.5 + 0.5*sqrt(0.5))" 200
harmonic freq3_log "$harmonic_modal" 'DAREA,30,1,1,3.0\nRLOAD1,20,30,,,1.0\nFREQ3,7,1.0,16.0,LOG,5' && harmonic_grid freq3_log 'FREQ3 LOG' 1 2 4 8 16
harmonic freq5 "$harmonic_modal" 'DAREA,30,1,1,3.0\nRLOAD1,20,30,,,1.0\nFREQ5,7,20.0,200.0,0.6,1.2,0.9\nFREQ,7,300.0,10.0,300.0' && harmonic_grid freq5 FREQ5 10 \
   "0.6*$harmonic_f0" "0.9*$harmonic_f0" "1.2*$harmonic_f0" 300

# ---- what is refused, by name; RANDOM is told to have no effect
harmonic tload 'SOL 109\nCEND\nSPC = 1\nDLOAD = 20\nTSTEP = 3' 'TLOAD1,20,30,,,8\nTSTEP,3,100,0.1' 2 &&
   says 'SOL 109' "$work/tload.log" 'SOL: 109 is transient response'
harmonic random "$harmonic_modal\nRANDOM = 3" "DAREA,30,1,1,3.0\nRLOAD1,20,30,,,1.0\n$harmonic_list\nRANDPS,3,1,1,1.0,0.0,9" && {
   harmonic_near 'beside RANDOM' random 3 0
   says 'RANDOM' "$work/random.log" 'RANDOM: the response is that to DLOAD; none is random'
}
harmonic delay "$harmonic_modal" "DAREA,30,1,1,3.0\nRLOAD1,20,30,5,,1.0\n$harmonic_list" 2 && says 'a set of DELAY' "$work/delay.log" '5 is a set of DELAY cards'
harmonic missing "$harmonic_modal" "RLOAD1,20,30,,,8\n$harmonic_list" 2 && {
   says 'no EXCITEID' "$work/missing.log" 'EXCITEID: there is no DAREA, LSEQ, LOAD'
   says 'no table' "$work/missing.log" 'there is no TABLED1, TABLED2, TABLED3 or TABLED4 8'
}
