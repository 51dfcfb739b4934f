# Inertia relief, PARAM INREL = -1 with SUPORT: free bodies that their loads accelerate, by hand.

# free_line NAME CARDS [CONTROL]: twelve elements along x, L = 120, of a section by CARDS
free_line() {
   { printf '%b\n' "MODEL = SPACE${3:-}"'\nSUBCASE 1\n  LOAD = 10\nSUBCASE 2\n  LOAD = 20\nBEGIN BULK\nPARAM,INREL,-1\nPARAM,COUPMASS,1\nMAT1,1,9000.0,,0.25,0.01'
      for i in $(seq 13); do echo "GRID,$i,,$((i*10 - 10)).0,0.0,0.0"; done
      for i in $(seq 12); do echo "CBAR,$i,1,$i,$((i + 1)),0.0,1.0,0.0"; done
      printf '%b\n' "$2\nENDDATA"; } > "$work/$1.bdf"
   run "$1"
}
moved_in() { table "$1" "DISPLACEMENTS OF NODES, STAGE $2" | awk -v node="$3" -v c="$4" '$1 == node { print $(1 + (NF - 1)/2 + c) }'; } # NAME STAGE NODE C
section='PBAR,1,1,4.0,3.0,2.0,5.0'

# ---- Pulled at one end: N = F x/L. The same end across: with m = rho A L and the rotary inertia rho I the accelerations are a = F/m and
# alpha = F L/2/(rho (A L^3/12 + I L)), and relative to the other end E I w = rho I alpha x^3/6 - rho A ((a - alpha L/2) x^4/24 + alpha x^5/120)
across() { awk -v x="$1" 'BEGIN { F = 30; L = 120; A = 4; I = 3; E = 9000; rho = 0.01; a = F/(rho*A*L); alpha = F*L/2/(rho*(A*L^3/12 + I*L))
   printf "%.12g", (rho*I*alpha*x^3/6 - rho*A*((a - alpha*L/2)*x^4/24 + alpha*x^5/120))/(E*I) }'; }
free_line relief "$section\nSUPORT,1,123456\nFORCE,10,13,,30.0,1.0,0.0,0.0\nFORCE,20,13,,30.0,0.0,1.0,0.0" && {
   near 'a free bar, pulled: its length' "$(moved_in relief 1 13 1)" '30*120/(2*9000*4)' 1e-5
   near 'a free bar, pulled: a quarter of it' "$(moved_in relief 1 4 1)" '30*120/(2*9000*4)/16' 1e-5
   near 'a free beam: its end' "$(moved_in relief 2 13 2)" "$(across 120)" 1e-5
   near 'a free beam: half' "$(moved_in relief 2 7 2)" "$(across 60)" 1e-5
   near 'a free body: no reactions' "$(awk '/^ FREE / { for (i = 3; i <= NF; i++) s += $i^2; n++ } END { print n - 2 + s }' "$work/relief.log")" 0 0 1e-9
   same 'a free body: COUPMASS has an effect' "$(grep -c 'without effect.*COUPMASS' "$work/relief.log")" 0
   says 'a free body: its acceleration' "$work/relief.log" "PARAM INREL = -1: stage 2 has the inertia forces of the acceleration 0, $(number '30/(0.01*4*120)' | awk '{ printf "%g", $1 }'), 0 of the centre of mass"
}

# ---- Half of a bar pulled at both ends, on its plane of symmetry: SUPORT holds the motions that SPC leaves
free_line relief_half "$section\nSPC1,1,26,1\nSUPORT,1,1345\nFORCE,10,13,,30.0,1.0,0.0,0.0\nFORCE,20,13,,30.0,1.0,0.0,0.0" '\nSPC = 1' && \
   near 'a bar guided along x' "$(moved_in relief_half 2 13 1)" '30*120/(2*9000*4)' 1e-5

# ---- Errors
sed 's/^SUPORT.*/SUPORT,1,12345/' "$work/relief.bdf" > "$work/relief_few.bdf"
run relief_few 2 && says 'five components of SUPORT' "$work/relief_few.log" 'PARAM INREL = -1: the components of SUPORT are not those that hold the 6 rigid-body motions'
sed '/^SUPORT/d; s/^ENDDATA/SPC1,1,123456,1\n&/; s/^SUBCASE 1/SPC = 1\n&/' "$work/relief.bdf" > "$work/relief_none.bdf"
run relief_none 2 && says 'no SUPORT' "$work/relief_none.log" 'PARAM INREL = -1: expected SUPORT'
sed 's/^MAT1.*/MAT1,1,9000.0,,0.25/' "$work/relief.bdf" > "$work/relief_massless.bdf"
run relief_massless 2 && says 'no mass' "$work/relief_massless.log" 'a rigid-body motion moves no mass'
sed 's/^ENDDATA/CELAS2,99,1.0,1,1\n&/' "$work/relief.bdf" > "$work/relief_spring.bdf"
run relief_spring 2 && says 'a grounded spring' "$work/relief_spring.log" 'a grounded spring or a rigid base'

# ---- INREL = -2: without SUPORT, and displacements without the mean motion of the masses. The mean of x^2 between nodes L/12 apart is
# L^2 (1/3 + 1/(6 12^2)), so that the pulled end moves by F L/(E A) (1/2 - 1/6 - 1/1728) and the other by the rest. Across: the same beam
# as with SUPORT but for a rigid motion, without displacement and rotation of the masses
sed '/^SUPORT/d; s/INREL,-1/INREL,-2/' "$work/relief.bdf" > "$work/relief_mean.bdf"
run relief_mean && {
   near 'without SUPORT: the pulled end' "$(moved_in relief_mean 1 13 1)" '30*120/(9000*4)*(1/3 - 1/1728)' 1e-5
   near 'without SUPORT: the other end' "$(moved_in relief_mean 1 1 1)" '-30*120/(9000*4)*(1/6 + 1/1728)' 1e-5
   near 'without SUPORT: bent as with it' "$(moved_in relief_mean 2 1 2) - 2*$(moved_in relief_mean 2 7 2) + $(moved_in relief_mean 2 13 2)" \
      "$(across 120) - 2*$(across 60)" 1e-4
   near 'without SUPORT: no mean motion' "($(for i in $(seq 13); do echo "$(moved_in relief_mean 2 $i 2)*$([ $i = 1 ] || [ $i = 13 ] && echo 0.5 || echo 1)"; done | paste -sd+))/12/$(moved_in relief_mean 2 13 2)" \
      0 0 0.02
   says 'without SUPORT: its acceleration' "$work/relief_mean.log" "PARAM INREL = -2: stage 1 has the inertia forces of the acceleration $(number '30/(0.01*4*120)' | awk '{ printf "%g", $1 }'), 0, 0 of the centre of mass"
}

# ---- The same line of replicated cards: in free field and in fields of eight columns
{ printf 'MODEL = SPACE\nSUBCASE 1\n  LOAD = 10\nBEGIN BULK\nPARAM,INREL,-1\nMAT1,1,9000.0,,0.25,0.01\nGRID,1,,0.0,0.0,0.0\n=,*(1),=,*(10.),==\n$ eleven more\n=(11)\n'
   printf 'CBAR    1       1       1       2       0.0     1.0     0.0\n=       *1      =       *(1)    *(1)    ==\n=10\n%s\n%b\n' "$section" 'SUPORT,1,123456\nFORCE,10,12,,1.0,0.0,1.0\n=,=,13,=,*29.0,1.0\nFORCE,=,12,=,-1.0,0.0,1.0\nENDDATA'; } > "$work/relief_repeated.bdf"
run relief_repeated && near 'replicated cards' "$(moved_in relief_repeated 1 13 1)" '30*120/(2*9000*4)' 1e-5
