# Natural modes against closed forms.

# mode NAME MODE COLUMN [STAGE]: a cell of NAME.modes.csv; energy NAME MODE KIND ID COLUMN: of NAME.modes.energy.csv
mode() { "$query" "$work/$1.modes.csv" rows "mode = $2 and stage = ${4:-1}" print "$3"; }
energy() { awk -F, -v m="$2" -v kind="$3" -v id="$4" -v c="$5" 'NR == 1 { for (k = 1; k <= NF; k++) at[$k] = k }
   $2 == m && $3 == kind && $4 == id { print $at[c] }' "$work/$1.modes.energy.csv"; }
pi=3.14159265358979324

# ---- A bar of N elements, fixed at one end, moves along itself alone. The equations of its nodes have exact solutions:
# omega^2 = (6 E/(rho h^2)) (1 - cos t)/(2 + cos t), lumped (2 E/(rho h^2)) (1 - cos t), t = (2 j - 1) pi/(2 n), or j pi/n free at both ends.
bar() { # NAME N MASS MODES
   local nodes=$((2*($2 + 1)))
   cat > "$work/$1.bdf" <<DECK
SPC = 1
MASS = $3
SUBCASE 1
  LOAD = 10
  $4 = 5
BEGIN BULK
BLOCK2,1,1,$2,1,0.0,0.0
+,500.0,10.0,,,,,1,1
+,,,,40
PMARK,40
PSHELL,1,1,2.0
MAT1,1,2.1E5,,0.0,7.85E-9
SPC1,1,2,1,THRU,$nodes
SPCM,1,1,40
FORCE,10,$nodes,,1.0,1.0
EIGRL,5,,,3
ENDDATA
DECK
   run "$1"
}
for mass in CONSISTENT LUMPED; do
   # 10 elements: a small structure, solved as a whole; 200: by iteration
   for n in 10 200; do
      bar bar $n $mass MODES || continue
      for j in 1 2 3; do
         t="(($j - 0.5)*$pi/$n)"
         [ $mass = LUMPED ] && square="2*(1 - cos($t))" || square="6*(1 - cos($t))/(2 + cos($t))"
         near "bar of $n elements, $mass: mode $j" "$(mode bar $j frequency)" "sqrt(2.1e5/7.85e-9*($square))*$n/500/(2*$pi)" 1e-9
         holds "bar of $n elements, $mass: residual of mode $j" "$(mode bar $j residual) < 1e-7"
         # effective mass of a fixed bar, of its continuous modes 8/((2j - 1) pi)^2 of all: the sum over all modes is what is not held
         [ $n = 200 ] && near "bar of $n elements, $mass: effective mass $j" "$(mode bar $j mass_x)" \
            "7.85e-9*500*10*2*8/((2*$j - 1)*$pi)^2" 1e-3
      done
   done
done
# order 2: the error of the first frequency falls by four as the elements are halved
before=
for n in 8 16 32 64; do
   bar bar $n CONSISTENT MODES || continue
   error=$(number "$(mode bar 1 frequency)/(sqrt(2.1e5/7.85e-9)/2000) - 1")
   [ -n "$before" ] && near "bar, $n elements: order 2" "$before/($error)" 4 0.02
   before=$error
done
# free: the held motions across the bar are supports too, and let go: three motions without strain
bar free 40 CONSISTENT 'MODES(FREE)' && {
   for j in 1 2 3; do same "free bar: mode $j has no frequency" "$(number "$(mode free $j frequency) = 0")" 1; done
   near 'free bar: it moves along x as a whole' "$(mode free 1 mass_x)" '7.85e-9*500*10*2' 1e-9
   says 'free bar: it says so' "$work/free.out" 'MOVES WITHOUT STRAIN'
}

# ---- A cantilever, n elements with incompatible modes along it: order 2, to the slender beam with its small shear (L/h = 100)
cantilever() { # NAME N
   cat > "$work/$1.bdf" <<DECK
SPC = 1
SUBCASE 1
  LOAD = 10
  MODES = 5
BEGIN BULK
BLOCK2,1,1,$2,1,0.0,0.0
+,1000.0,10.0,,,,,1,1
+,,,,40
PMARK,40
PSHELL,1,1,2.0
+,YES
MAT1,1,2.1E5,,0.0,7.85E-9
SPCM,1,12,40
FORCE,10,1,,1.0,0.0,1.0
EIGRL,5,,,2
ENDDATA
DECK
   run "$1"
}
f=()
for n in 50 100 200; do cantilever cantilever $n && f+=("$(mode cantilever 1 frequency)"); done
near 'cantilever: order 2' "(${f[0]:-0} - (${f[1]:-0}))/((${f[1]:-0}) - (${f[2]:-1}))" 4 0.05
near 'cantilever: the beam of Bernoulli' "(4*(${f[2]:-0}) - (${f[1]:-0}))/3" \
   "1.875104068711961^2/(2*$pi*1000^2)*sqrt(2.1e5*10^2/12/7.85e-9)" 2e-4

# ---- Two bars end to end with a joint between them that is a spring K = E_u A for oscillation:
# K cos(k (l_1 + l_2)) = E A k cos(k l_1) sin(k l_2), omega = k sqrt(E/rho); elements of second order
cat > "$work/two_bars.bdf" <<'DECK'
METHOD = NEWTON
SPC = 1
SUBCASE 1
  LOAD = 10
  MODES = 5
BEGIN BULK
BLOCK2,1,1,60,1,0.0,0.0
+,300.0,10.0,,,,,1,1
+,11,20,12,40,,2
BLOCK2,2,1,40,1,300.0,0.0
+,500.0,10.0,,,,,1001,1001
+,13,22,14,21,,2
PMARK,11
PMARK,12
PMARK,13
PMARK,14
PMARK,20
PMARK,21
PMARK,22
PMARK,40
PSHELL,1,1,2.0
MAT1,1,2.1E5,,0.0,7.85E-9
JOINT,1,1,20,21
PJOINT,1,1
JNORM,1,1.0-3,0.5,2.0E3
SPCM,1,2,11
SPCM,1,2,12
SPCM,1,2,13
SPCM,1,2,14
SPCM,1,1,40
PLOADM,10,5.0,22
EIGRL,5,,,4
ENDDATA
DECK
run two_bars && {
   roots=$(awk 'function g(k) { return 2e3*cos(k*500) - 2.1e5*k*cos(k*300)*sin(k*200) }
      BEGIN { step = 1e-5
         for (a = step/3; n < 4; a += step) {
            if (g(a)*g(a + step) > 0) continue
            lo = a; hi = a + step
            for (i = 0; i < 80; i++) { mid = (lo + hi)/2; if (g(lo)*g(mid) > 0) lo = mid; else hi = mid }
            printf "%.15g ", lo*sqrt(2.1e5/7.85e-9)/(2*atan2(0, -1)); n++ } }')
   j=0
   for root in $roots; do j=$((j + 1)); near "two bars and a joint: mode $j" "$(mode two_bars $j frequency)" "$root" 1e-7; done
   same 'two bars and a joint: four roots' "$j" 4
   for j in 1 2 3 4; do
      near "two bars and a joint: energy of mode $j" \
         "$(energy two_bars $j BODY 1 normal) + $(energy two_bars $j BODY 2 normal) + $(energy two_bars $j JOINT 1 normal)" 1 1e-12
   done
}

# ---- A rigid block on its joint, pressed evenly: lambda_n = E_u A/M; sliding and rocking about z are coupled, of the block on its
# springs below the centre: [k_x, k_x c; k_x c, k_x c^2 + k_t] = lambda [M, I]. Stiffness of the block taken away by a second run.
block() { # NAME E SOLVER MODES
   cat > "$work/$1.bdf" <<DECK
METHOD = NEWTON
SOLVER = $3
SUBCASE 1
  LOAD = 10
  $4 = 5
BEGIN BULK
BLOCK3,1,1,4,4,4,0.0,0.0,0.0
+,100.0,60.0,80.0,,,,1,1
+,,,20,21
PMARK,20
PMARK,21
PSOLID,1,1
MAT1,1,$2,,0.3,7.85E-9
JOINT,1,1,20
PJOINT,1,1,2,2
JNORM,1,1.0-3,0.5,5.0E4
JSHEAR,2,1.0E4,0.0
EIGRL,5,,,6
PLOADM,10,2.0,21
ENDDATA
DECK
   run "$1"
}
block block1 1.0E11 TREE MODES && block block2 2.0E11 TREE MODES && {
   rigid() { number "1/sqrt(2/$(mode block2 $1 frequency)^2 - 1/$(mode block1 $1 frequency)^2)"; }
   mass='(7.85e-9*100*60*80)'
   near 'rigid block: up and down' "$(rigid 5)" "sqrt(5e4*8000/$mass)/(2*$pi)" 1e-8
   # about z with sides 100 and 60, about x with 80 and 60; areas of influence stand at five nodes: sum a x^2 = A L^2/12 (1 + 2/4^2)
   rocks() { # SIDE SIGN: omega of the two coupled modes
      local k="(1e4*8000)" t="(5e4*8000*$1^2/12*(1 + 2/16))" i="($mass*($1^2 + 60^2)/12)"
      local b="($k/$mass + ($k*900 + $t)/$i)" c="($k*$t/($mass*$i))"
      echo "sqrt(($b $2 sqrt($b^2 - 4*$c))/2)/(2*$pi)"
   }
   near 'rigid block: it rocks about z' "$(rigid 2)" "$(rocks 100 -)" 1e-8
   near 'rigid block: and slides' "$(rigid 6)" "$(rocks 100 +)" 1e-8
   near 'rigid block: it rocks about x' "$(rigid 1)" "$(rocks 80 -)" 1e-8
   near 'rigid block: and slides across' "$(rigid 4)" "$(rocks 80 +)" 1e-8
   near 'rigid block: it turns' "$(rigid 3)" \
      "sqrt(1e4*8000*(100^2 + 80^2)/12*(1 + 2/16)/($mass*(100^2 + 80^2)/12))/(2*$pi)" 1e-8
   for d in x y z; do
      near "rigid block: all of its mass along $d" "$("$query" "$work/block1.modes.csv" print "sum(mass_$d)")" "$mass" 1e-6
   done
}
# the two solvers, and any number of threads
block tree 2.1E5 TREE MODES && block skyline 2.1E5 SKYLINE MODES && {
   for j in 1 2 3 4 5 6; do
      near "SKYLINE and TREE: mode $j" "$(mode skyline $j frequency)" "$(mode tree $j frequency)" 1e-9
      near "SKYLINE and TREE: shear energy of mode $j" "$(energy skyline $j JOINT 1 shear)" "$(energy tree $j JOINT 1 shear)" 1e-8 1e-10
   done
   cp "$work/tree.modes.csv" "$work/tree.modes.first"
   for threads in 1 2 3; do
      OMP_NUM_THREADS=$threads "$program" -q --threads $threads -o "$work" "$work/tree.bdf" > "$work/tree.log" 2>&1
      same "$threads threads: the same digits" "$(cmp "$work/tree.modes.csv" "$work/tree.modes.first" && echo same)" same
   done
}
# a range: its modes are those found from below; the count before it
for solver in SKYLINE TREE; do
   block range 2.1E5 $solver MODES && {
      cp "$work/range.modes.csv" "$work/all.modes.csv"
      low=$(number "$(mode range 2 frequency)*0.5 + $(mode range 3 frequency)*0.5")
      high=$(number "$(mode range 5 frequency)*0.5 + $(mode range 6 frequency)*0.5")
      sed -i "s/^EIGRL.*/EIGRL,5,$low,$high/" "$work/range.bdf"
      run range && {
         same "$solver: modes in the range" "$(awk -F, 'NR > 1 { printf "%s ", $2 }' "$work/range.modes.csv")" '3 4 5 '
         for j in 3 4 5; do
            near "$solver: mode $j of the range" "$(mode range $j frequency)" "$(mode all $j frequency)" 1e-9
         done
         says "$solver: the modes before are counted" "$work/range.out" 'BELOW THE RANGE: 2'
      }
   }
done

# ---- A mass on one interface element: across it omega^2 = E_u a/M, along it B'(d; p) a/M with the shear deflection d that a force has
# made, on loading p^(1 - m) a/(m c M) and A'(d; p) a/M. Loss factor of the motion along it: that of the Masing loop of the cubic A(d; p),
# (4/3 |a_2| x^3 + 2 |a_3| x^4)/(pi B' x^2); of that across it none.
point() { # NAME ENTRIES
   cat > "$work/$1.bdf" <<DECK
METHOD = NEWTON
SUBCASE 1
  LOAD = 10
  MODES = 5
  AMPLITUDE = 1.0E-3
  $2
BEGIN BULK
GRID,1
CJOINT,1,1,1,,100.0,0.0,1.0
PJOINT,1,1,2
JNORM,1,8.0-3,0.5,500.0
JSHEAR,2,100.0,50.0,-2.0E3,-300.0,-1.0E4,-7.0E3
+,400.0,150.0
FORCE,10,1,,1.0,10.0,-130.0
CONM2,4,1,,0.02
EIGRL,5,,,2
ENDDATA
DECK
   run "$1"
}
a1='(100 + 50*1.3)' a2='(-2e3 - 300*1.3)' a3='(-1e4 - 7e3*1.3)'
point point '' && {
   near 'a mass on its joint: across' "$(mode point 1 frequency)" "sqrt(500*100/0.02)/(2*$pi)" 1e-12
   near 'a mass on its joint: along' "$(mode point 2 frequency)" "sqrt((400 + 150*1.3)*100/0.02)/(2*$pi)" 1e-12
   near 'a mass on its joint: loss' "$(mode point 2 loss_factor)" \
      "(-4/3*$a2*1e-9 - 2*$a3*1e-12)/($pi*(400 + 150*1.3)*1e-6)" 1e-12
   near 'a mass on its joint: no loss across' "$(mode point 1 loss_factor)" 0 0 1e-15
   near 'a mass on its joint: energy of shear' "$(energy point 2 JOINT 1 shear)" 1 1e-14
   near 'a mass on its joint: energy across' "$(energy point 1 JOINT 1 normal)" 1 1e-14
   near 'a mass on its joint: all of its mass' "$(mode point 2 mass_x)" 0.02 1e-14
}
point loading 'STIFFNESS = LOAD' && {
   delta=$(cell loading 1 1 1 delta_x)
   near 'on loading: across' "$(mode loading 2 frequency)" "sqrt(1.3^0.5*100/(0.5*8e-3)/0.02)/(2*$pi)" 1e-12
   near 'on loading: along' "$(mode loading 1 frequency)" "sqrt(($a1 + 2*$a2*($delta) + 3*$a3*($delta)^2)*100/0.02)/(2*$pi)" 1e-12
}
# what is open takes no part: lifted off, the mass is free
point open 'LABEL = LIFTED' && {
   sed -i 's/^FORCE.*/FORCE,10,1,,1.0,0.0,-1.3\nSPC1,1,12,1\nSPC1,2,1,1/; s/^CJOINT.*/&\nCELAS2,2,3.0,1,1\nCELAS2,3,7.0,1,2\nJGAP,1,CONST,1.0/' "$work/open.bdf"
   run open && {
      near 'open: the spring along alone' "$(mode open 1 frequency)" "sqrt(3/0.02)/(2*$pi)" 1e-12
      near 'open: the spring across alone' "$(mode open 2 frequency)" "sqrt(7/0.02)/(2*$pi)" 1e-12
      says 'open: it says so' "$work/open.out" 'CARRY PRESSURE: 0 OF 1'
   }
}
