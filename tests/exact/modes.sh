# Natural modes beside the closed forms of manual/13_vibration.md: effective masses, equations, free bodies, the two solvers, ranges,
# what is open, responses.

# ---- A bar
for mass in CONSISTENT LUMPED; do
   # 10 elements: a small structure, solved as a whole; 200: by iteration
   for n in 10 200; do
      oscillating_bar bar $n $mass MODES || continue
      for j in 1 2 3; do
         holds "bar of $n elements, $mass: residual of mode $j" "$(mode bar $j residual) < 1e-7"
         # effective mass of a fixed bar, of its continuous modes 8/((2j - 1) pi)^2 of all: the sum over all modes is what is not held
         [ $n = 200 ] && near "bar of $n elements, $mass: effective mass $j" "$(mode bar $j mass_x)" \
            "7.85e-9*500*10*2*8/((2*$j - 1)*$pi)^2" 1e-3
      done
   done
done
# nodes of a section that an equation ties move alike anyway: the same frequencies, mass and modes
for n in 10 200; do
   oscillating_bar bar $n CONSISTENT MODES && cp "$work/bar.modes.csv" "$work/loose.modes.csv" && tie_sections bar $n || continue
   for j in 1 2 3; do
      near "tied bar of $n elements: mode $j" "$(mode bar $j frequency)" "$(mode loose $j frequency)" 1e-9
      near "tied bar of $n elements: effective mass $j" "$(mode bar $j mass_x)" "$(mode loose $j mass_x)" 1e-9
      holds "tied bar of $n elements: residual of mode $j" "$(mode bar $j residual) < 1e-7"
   done
done
# free: the held motions across the bar are supports too, and let go: three motions without strain
oscillating_bar free 40 CONSISTENT 'MODES(FREE)' && {
   for j in 1 2 3; do same "free bar: mode $j has no frequency" "$(number "$(mode free $j frequency) = 0")" 1; done
   near 'free bar: it moves along x as a whole' "$(mode free 1 mass_x)" '7.85e-9*500*10*2' 1e-9
   says 'free bar: it says so' "$work/free.out" 'MOVES WITHOUT STRAIN'
}
# a mass at one corner of a free bar that is solved by iteration: CONM1 as CONM2
for card in 'CONM2,900,402,,0.02' 'CONM1,900,402,,0.02,0.0,0.02'; do
   oscillating_bar free 200 CONSISTENT 'MODES(FREE)' && sed -i "s/^ENDDATA/$card\n&/; s/EIGRL,5,,,3/EIGRL,5,,,5/" "$work/free.bdf" && run free || continue
   [ "${card%%,*}" = CONM2 ] && cp "$work/free.modes.csv" "$work/corner.modes.csv"
done
holds 'a mass on a free bar: its fourth mode strains it' "$(mode corner 4 frequency) > 1"
near 'CONM1 as CONM2 on a free bar' "$(mode free 4 frequency)" "$(mode corner 4 frequency)" 1e-10

# ---- A rigid block on its joint
# the two solvers, and any number of threads
block_on_joint tree 2.1E5 TREE MODES && block_on_joint skyline 2.1E5 SKYLINE MODES && {
   for j in 1 2 3 4 5 6; do
      near "SKYLINE and TREE: mode $j" "$(mode skyline $j frequency)" "$(mode tree $j frequency)" 1e-9
      near "SKYLINE and TREE: shear energy of mode $j" "$(mode_energy skyline $j JOINT 1 shear)" "$(mode_energy tree $j JOINT 1 shear)" 1e-8 1e-10
   done
   cp "$work/tree.modes.csv" "$work/tree.modes.first"
   for threads in 1 2 3; do
      OMP_NUM_THREADS=$threads "$program" -q --threads $threads -o "$work" "$work/tree.bdf" > "$work/tree.log" 2>&1
      same "$threads threads: the same digits" "$(cmp "$work/tree.modes.csv" "$work/tree.modes.first" && echo same)" same
   done
}
# a range: its modes are those found from below; the count before it
for solver in SKYLINE TREE; do
   block_on_joint range 2.1E5 $solver MODES && {
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

# ---- A mass on one interface element
mass_on_joint point '' && {
   near 'a mass on its joint: no loss across' "$(mode point 1 loss_factor)" 0 0 1e-15
   near 'a mass on its joint: energy of shear' "$(mode_energy point 2 JOINT 1 shear)" 1 1e-14
   near 'a mass on its joint: energy across' "$(mode_energy point 1 JOINT 1 normal)" 1 1e-14
   near 'a mass on its joint: all of its mass' "$(mode point 2 mass_x)" 0.02 1e-14
}
# what is open takes no part: lifted off, the mass is free
mass_on_joint open 'LABEL = LIFTED' && {
   sed -i 's/^FORCE.*/FORCE,10,1,,1.0,0.0,-1.3\nSPC1,1,12,1\nSPC1,2,1,1/; s/^CJOINT.*/&\nCELAS2,2,3.0,1,1\nCELAS2,3,7.0,1,2\nJGAP,1,CONST,1.0/' "$work/open.bdf"
   run open && {
      near 'open: the spring along alone' "$(mode open 1 frequency)" "sqrt(3/0.02)/(2*$pi)" 1e-12
      near 'open: the spring across alone' "$(mode open 2 frequency)" "sqrt(7/0.02)/(2*$pi)" 1e-12
      says 'open: it says so' "$work/open.out" 'IN CONTACT: 0 OF 1'
   }
}
# the answer of that mass to a force that oscillates: F/(M (omega_r^2 - omega^2 + i eta omega_r^2)), eta the loss factor along the joint
mass_on_joint answers '' && {
   sed -i 's/^METHOD.*/&\nSET 1 = 1/; s/^  AMPLITUDE.*/&\n  FREQUENCY = 7\n  DLOAD = 20\n  RESPONSE = SET 1/; s/^EIGRL.*/&\nFREQ1,7,0.0,100.0,4\nFORCE,20,1,,1.0,3.0,4.0/' \
      "$work/answers.bdf"
   run answers && {
      answer() { awk -F, -v f="$1" -v c="$2" 'NR > 1 && $2 == f && $4 == c { print $5 }' "$work/answers.response.csv"; } # FREQUENCY x|y
      k="((400 + 150*1.3)*100)" loss=$(mode answers 2 loss_factor)
      for f in 0 100 200 300 400; do
         w2="((2*$pi*$f)^2*0.02)"
         near "response at $f: across" "$(answer $f y)" "4/abs(500*100 - $w2)" 1e-10
         near "response at $f: along" "$(answer $f x)" "3/sqrt(($k - $w2)^2 + ($loss*$k)^2)" 1e-10
      done
   }
}
# free in space the static part is that of inertia relief, and there is no answer at rest
oscillating_bar bound 40 CONSISTENT 'MODES(FREE)' && {
   sed -i 's/^MASS.*/&\nSET 1 = 41/; s/^  LOAD.*/&\n  FREQUENCY = 7\n  DLOAD = 10\n  SDAMPING = 8\n  RESPONSE = SET 1/; s/^EIGRL.*/&\nFREQ1,7,50.0,100.0,4\nTABDMP1,8,G\n+,0.0,0.02,1.0E5,0.02,ENDT/' \
      "$work/bound.bdf"
   run bound && same 'free bar: its response has its static part' "$(grep -c 'BY THESE MODES ALONE' "$work/bound.out")" 0
   sed -i 's/^FREQ1,7,50.0/FREQ1,7,0.0/' "$work/bound.bdf"
   run bound 3 && says 'free bar: no response at rest' "$work/bound.log" 'at 0 the response is unbounded'
}

# ---- A block relieved until rounding alone presses it: it touches, whatever the sign of what is left
for solver in SKYLINE TREE; do
   for load in 1.0-9 1.0-16 -1.0-16 0.0; do
      cards touching <<DECK
METHOD = STEP;SOLVER = $solver;SPC = 1;SUBCASE 1;  LOAD = 1;  INCR = 1
SUBCASE 2;  LOAD = 2;  MODES = 5
BEGIN BULK;BLOCK2,1,1,4,4,0.0,0.0;+,10.0,10.0;+,20,,21;PMARK,20;PMARK,21;PSHELL,1,1,1.0;MAT1,1,2.1+5,,0.3,7.85-9
JOINT,1,1,20;PJOINT,1,1;JNORM,1,8.0-3,0.5,9500.0;SPC1,1,1,1;PLOADM,1,1.0,21;PLOADM,2,$load,21;JINCR,1,4;EIGRL,5,,,2
ENDDATA
DECK
      run touching || continue
      [ $solver$load = SKYLINE1.0-9 ] && f=$(mode touching 1 frequency 2)
      near "relieved to $load, $solver: frequency" "$(mode touching 1 frequency 2)" "$f" 1e-9
      says "relieved to $load, $solver: all touch" "$work/touching.out" 'IN CONTACT: 5 OF 5'
      ask "relieved to $load, $solver: contact" touching rows 'stage = 2' count 5 all 'branch != "OPEN"'
   done
done

# Without supports at all: two beams with a joint are as they are when their supports are let go, from the same state; a plate, a ring, a
# beam have their rigid movements.
mkdir -p "$work/vibration"
cp input/vibration/beams.inc "$work/vibration"
run_input lap_beams && sed -i '/^SPC1 /d' "$work/vibration/beams.inc" && sed '/^SPC = /d' input/lap_beams.bdf > "$work/unheld.bdf" && run unheld && {
   for m in 6 7 8 9; do near "without supports: mode $m" "$(mode unheld $m frequency)" "$(mode lap_beams $m frequency)" 1e-9 1e-9; done
   near 'without supports: bolts' "$(tail -n 1 "$work/unheld.bolt.csv" | cut -d, -f5)" "$(tail -n 1 "$work/lap_beams.bolt.csv" | cut -d, -f5)" 1e-9
}
for case in '3 BLOCK2,1,1,4,2,0.,0.;+,100.,50.;PSHELL,1,1,20.' '1 BLOCK2,1,1,4,2,5.,0.;+,100.,50.;PAXIS,1,1' \
   '6 GRID,1,,0.,,1.;GRID,2,,50.,,1.;GRID,3,,100.,,1.;CBAR,1,1,1,2,0.,1.,0.;CBAR,2,1,2,3,0.,1.,0.;PBAR,1,1,10.,20.,30.,40.'; do
   cards rigid <<DECK
MODES(FREE) = 4;BEGIN BULK;${case#* };MAT1,1,9500.,,.25,1.-9;EIGRL,4,,,7;ENDDATA
DECK
   run rigid && same "without supports: ${case%% *} rigid movements" "$(awk -F, 'NR > 1 && $3 == 0' "$work/rigid.modes.csv" | wc -l)" "${case%% *}"
done

# E_u left blank is E of the bodies per unit of length, here 120000: 120000 m c/p^(1 - m) = 84.85 times the slope of loading at p = 0.5. The
# listing says so once: with the law, or with the modes that it rules, which warn of it; not where EU is given.
slope_given() { # NAME EU STIFFNESS
   cards "$1" <<DECK
METHOD = NEWTON;SUBCASE 1;LOAD = 10;MODES = 8;STIFFNESS = $3
BEGIN BULK;BLOCK3,1,1,2,2,3,0.0,0.0,0.0;+,100.0,100.0,300.0,,,,1,1;+,,,,,20,21;PMARK,20;PMARK,21;PSOLID,1,1;MAT1,1,120000.0,,0.0,7.2-9
JOINT,1,1,20;PJOINT,1,1,1,1,0.2;JNORM,1,1.0-3,0.5,$2;JSHEAR,1,1000.0;FORCEM,10,5000.0,0.0,0.0,-1.0,21;EIGRL,8,,,3;ENDDATA
DECK
   run "$1"
}
slope_given blank_slope '' UNLOAD && slope_given same_slope 120000.0 UNLOAD && slope_given loading_slope '' LOAD && {
   says 'E_u by default: its ratio to the slope of loading' "$work/loading_slope.out" 'NOTE: E_U OF JOINT 1 IS THE DEFAULT, E OF THE BODIES,  8.49E+01 TIMES THE SLOPE OF LOADING'
   same '... told once' "$(grep -c 'IS THE DEFAULT' "$work/blank_slope.out")" 1
   says '... where it rules modes' "$work/blank_slope.out" 'WARNING: E_U OF JOINT 1 IS THE DEFAULT, AND MAKES IT 8.49E+01 TIMES AS STIFF AS ITS LOADING CURVES'
   near '... the frequency of that E_u' "$(mode blank_slope 1 frequency)" "$(mode same_slope 1 frequency)" 1e-9
   same '... given: no word' "$(grep -c 'IS THE DEFAULT' "$work/same_slope.out")" 0
   same '... modes of loading: no warning' "$(grep -c 'WARNING: E_U' "$work/loading_slope.out")" 0
}

# A structure of one mode
cards single <<'DECK'
SPC = 1;SUBCASE 1;MODES = 3
BEGIN BULK;GRID,1;CELAS2,1,100.0,1,1;CONM2,2,1,,1.0;SPC1,1,2,1;EIGRL,3,,,3;ENDDATA
DECK
run single && says 'one mode, in words' "$work/single.out" 'THE STRUCTURE HAS 1 MODE IN ALL, AND IT HAS BEEN FOUND'

# Two free blocks in space, joined by springs between the nodes of their faces, whatever the number of modes asked for: six modes of exactly zero
# without strain energy; the others are the same each time, and their shares of strain energy add up to 1.
joining=$(for i in {0..15}; do for c in 1 2 3; do printf 'CELAS2,%d,2.+5,%d,%d,%d,%d;' $((9000 + 3*i + c)) $((5 + 5*i)) $c $((1001 + 3*i)) $c; done; done)
for n in 1 4 6 7 9 14; do
   cards afloat <<DECK
SUBCASE 1;MODES(FREE) = $n;BEGIN BULK;BLOCK3,1,1,3,3,4,0.,0.,0.;+,30.,20.,90.,,,,1,1;BLOCK3,2,2,3,3,2,0.,0.,90.;+,30.,20.,120.,,,,1001,1001
PSOLID,1,1;PSOLID,2,2;MAT1,1,2.1+5,,.3,7.85-9;MAT1,2,7.+4,,.33,2.7-9;${joining}EIGRL,$n,,,$n;ENDDATA
DECK
   run afloat || continue
   same "free in space, $n modes: six of zero" "$(awk -F, 'NR > 1 { printf "%d", ($3 > 0) }' "$work/afloat.modes.csv")" "$(printf '00000011111111' | cut -c "-$n")"
   [ $n -gt 6 ] || continue
   first=${first:-$(mode afloat 7 frequency)}
   near "free in space, $n modes: the first with strain" "$(mode afloat 7 frequency)" "$first" 1e-9
   judge "free in space, $n modes: shares" 'NR > 1 { share[$2] += $5 + $6 }
      END { for (m in share) { checked++; if (m + 0 <= 6 || (share[m] - 1)^2 > 1e-12) print m, share[m] } print "checked " checked + 0 }' FS=, "$work/afloat.modes.energy.csv"
done

# ---- The part with most energy, and which modes are listed: a block of steel and a thin plate, each clamped, and two masses on rods. The
# plate has the lowest modes; the modes of the mass of 0.03 move 60 % of the mass of the rods' model, those of the other 40 %.
printf '%b\n' 'MODEL = SPACE\nSPC = 1\nSUBCASE 1\n  MODES = 5\n  OUTPUT = LAST, BODY 1\nBEGIN BULK\nBLOCK3,1,1,2,2,2,0.0,0.0,0.0\n+,20.0,20.0,200.0\n+,,,,,20\nPMARK,20\nPSOLID,1,1' \
   'GRID,901,,100.0,0.0,0.0\nGRID,902,,200.0,0.0,0.0\nGRID,903,,200.0,80.0,0.0\nGRID,904,,100.0,80.0,0.0\nCQUAD4,901,2,901,902,903,904\nPSHELL,2,1,2.0,1,,1' \
   'MAT1,1,2.1+5,,0.3,7.85-9\nSPCM,1,123,20\nSPC1,1,123456,901,904\nEIGRL,5,,,8\nENDDATA' > "$work/parts.bdf"
run parts && {
   same 'the part of mode 1' "$(mode parts 1 kind) $(mode parts 1 id)" 'SHELLS 2'
   near '... its share' "$(mode parts 1 energy)" 1 1e-9
   n=$(awk -F, '$10 == "BODY"' "$work/parts.modes.csv" | wc -l)
   holds 'modes of the block are among them' "$n > 0 and $n < 8"
   same 'OUTPUT = BODY: modes listed' "$(table parts FREQUENCIES | awk '$1 + 0 > 0 && $6 == "BODY"' | wc -l) $(table parts FREQUENCIES | grep -c SHELLS)" "$n 0"
   says '... of how many' "$work/parts.out" "LISTED: $n OF 8 MODES, WHICH OUTPUT SELECTS"
   sed -i 's/BODY 1/SHELLS 2/' "$work/parts.bdf"
   run parts && same 'OUTPUT = SHELLS: modes listed' "$(table parts FREQUENCIES | grep -c 'SHELLS .* 100.00')" "$((8 - n))"
}
printf '%b\n' 'MODEL = PLANE\nSPC = 1\nMODES = 5\nOUTPUT = LAST, MASS 50.0\nBEGIN BULK\nGRID,1,,0.0,0.0\nGRID,2,,50.0,0.0\nGRID,11,,-100.0,0.0\nGRID,12,,0.0,-100.0\nGRID,21,,50.0,-100.0\nGRID,22,,150.0,0.0' \
   'CROD,1,1,1,11\nCROD,2,1,1,12\nCROD,3,1,2,21\nCROD,4,1,2,22\nPROD,1,1,100.0\nMAT1,1,1000.0\nCONM2,31,1,,0.02\nCONM2,32,2,,0.03\nSPC1,1,12,11,12,21,22\nEIGRL,5,,,4\nENDDATA' > "$work/masses.bdf"
run masses && {
   same 'OUTPUT = MASS: modes listed' "$(table masses PARTICIPATION | awk '$1 + 0 > 0 { printf "%s ", $1 }')" '1 2 '
   same '... and in the file' "$(awk 'NR > 1' "$work/masses.modes.csv" | wc -l)" 4
   says '... of how many' "$work/masses.out" 'LISTED: 2 OF 4 MODES, WHICH OUTPUT SELECTS'
   near '... the sum is that of all' "$(table masses PARTICIPATION | awk '$1 == "SUM" { print $2 }')" 0.05 1e-9
}
# METHOD beside a support that leaves a rotation: a massless beam on a pin, 0.3 in its middle and at its end, omega^2 = 60 E I/(L^3 m)
cards pinned <<'DECK'
SOL 103;CEND;MODEL = PLANE;SPC = 1;METHOD = 5;BEGIN BULK;EIGRL,5,,,2;GRID,1,,0.0,0.0;GRID,2,,50.0,0.0;GRID,3,,100.0,0.0;CBAR,1,1,1,2,0.0,1.0,0.0
CBAR,2,1,2,3,0.0,1.0,0.0;PBAR,1,1,400.0,80.0,80.0,60.0;MAT1,1,210000.0,,0.3;SPC1,1,12,1;CONM2,3,2,,0.3;CONM2,4,3,,0.3;ENDDATA
DECK
run pinned && {
   same 'on a pin: it turns' "$(number "$(mode pinned 1 omega) = 0")" 1
   near 'on a pin: it bends' "$(mode pinned 2 omega)^2" '60*210000*80/(100^3*0.3)' 1e-7
}
# a spring bears along the joint, the joint alone across it
mass_on_joint selected 'OUTPUT = LAST, JOINT 1' && {
   sed -i 's/^CONM2.*/CELAS2,2,1.0E9,1,1/; s/^CJOINT.*/&\nCONM2,4,1,,0.02/' "$work/selected.bdf"
   run selected && same 'OUTPUT = JOINT: modes listed' "$(table selected FREQUENCIES | awk '$1 ~ /^[0-9]+$/ { print $1, $(NF - 2), $(NF - 1) }')" '1 JOINT 1'
   says '... of how many' "$work/selected.out" 'LISTED: 1 OF 2 MODES, WHICH OUTPUT SELECTS'
}
