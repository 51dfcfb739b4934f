# Initial gaps and interference: closed formulas, a rigid block solved by awk on the same nodes, and each other.

# STEP as it goes: nothing behind the gap, then once the secant of Eq. (9), then tangents; from the equilibrium with interference.
spring_step() { # M GAP FORCE INCREMENTS AT-REST
   awk -v m="$1" -v g="$2" -v f="$3" -v n="$4" -v x="$5" 'BEGIN {
      p = 0; if (g > 0) x = -g; else p = exp(log(x/8e-3)/m)
      for (i = 1; i <= n; i++) {
         k = x < 0 ? 0 : 4*exp((1 - m)*log(p > 0 ? p : 2/n))/(8e-3*(p > 0 ? m : 1))
         x += f/n/(100 + k); p += k*f/n/(100 + k)/4 }
      printf "%.17g", x }'
}
for m in 0.3 0.5 1.0; do
   for gap in 0.05 0.09 -0.04; do
      lambda=$(gap_spring_lambda $m $gap 10.0)
      gap_spring one NEWTON $m $gap 10.0 3 && near "a spring and a gap of $gap, m = $m, NEWTON" "$(cell one 1 3 1 lambda)" "$lambda" 1e-11
      gap_spring one BACK $m $gap 10.0 3 && near "a spring and a gap of $gap, m = $m, BACK" "$(cell one 1 1 1 lambda)" "$lambda" 1e-10
      for n in 7 40; do
         gap_spring one STEP $m $gap 10.0 $n && near "a spring and a gap of $gap, m = $m, STEP $n" "$(cell one 1 $n 1 lambda)" \
            "$(spring_step $m $gap 10.0 $n "$(gap_spring_lambda $m $gap 0.0)")" 1e-9
      done
   done
done
gap_spring one NEWTON 0.5 0.05 10.3 10 && ask 'closing is lambda and gap' one count 10 \
   all 'gap = 0.05 and (lambda < 0 and branch = "OPEN" and pressure = 0 or lambda > 0 and branch = "LOAD") and
      pressure = if(lambda < 0, 0, (lambda/8e-3)^2) within 1e-9' \
   all '100*(lambda + gap) + force = 10.3*load within 1e-8'
says 'the history of a deck with a gap has a column for it' "$work/one.joint.csv" ',slip,gap$'
gap_spring one NEWTON 0.5 0 10.0 10 && says 'and one without has not' "$work/one.joint.csv" ',slip$'

# beside a joint without a gap: the table of gaps has those of the other alone
gap_spring one NEWTON 0.5 0.05 10.0 3 && {
   sed 's/^SPC1,1,12,2/CJOINT,6,2,2,,4.0,0.0,-1.0,0.0\nPJOINT,2,1,,,,,0.1\nSPC1,1,1,2/' "$work/one.bdf" > "$work/beside.bdf"
   run beside && same 'the joint that has gaps' "$(table beside 'INITIAL GAPS' | awk '$1 ~ /^[0-9]+$/ { $1 = $1; print }')" '1 CONST 5.00000E-02 5.00000E-02 1 0'
}

# A history about the gap is that without gap under a load that is smaller by what the spring takes to the gap: loaded, relieved until
# it opens, closed again past A; lambda, p and the work of the joint.
for method in NEWTON STEP; do
   gap_spring apart $method 0.5 0.05 10.0 40 1.0 12.0 6.5 11.0 && gap_spring plain $method 0.5 0 5.0 40 -4.0 7.0 1.5 6.0 || continue
   [ $method = NEWTON ] && tolerance=1e-9 || tolerance=0.25
   for stage in 1 2 3 4 5; do
      for column in lambda pressure; do
         near "history about a gap, $method, stage $stage: $column" "$(cell apart $stage 40 1 $column)" \
            "$(cell plain $stage 40 1 $column)" $tolerance 1e-11
      done
      [ $method = NEWTON ] && same "history about a gap, stage $stage: branch" "$(cell apart $stage 40 1 branch)" "$(cell plain $stage 40 1 branch)"
   done
   [ $method = STEP ] && continue
   for deck in apart plain; do awk '/ENERGY OF JOINTS/ { on = 1 } on && $1 == 1 { print $2, $3, $4; on = 0 }' "$work/$deck.out" > "$work/$deck.energy"; done
   same 'history about a gap: work put in, given back, kept' "$(cat "$work/apart.energy")" "$(cat "$work/plain.energy")"
   same 'history about a gap: five stages of work' "$(wc -l < "$work/apart.energy")" 5
done

at_rest=$(awk 'BEGIN { k = 4/8e-3^2; printf "%.17g", (sqrt(50^2 + 4*k*50*0.05) - 50)/(2*k) }')
p_rest="($at_rest/8e-3)^2"
for method in NEWTON STEP BACK; do
   bars bars $method 0.0 1 || continue
   near "interference at rest, $method: the bars push as the joint does" "$(cell bars 1 1 2 force)" "50*(0.05 - $at_rest)" 1e-9
done
bars bars NEWTON 0.0 1 && near 'interference at rest: what it has put in stands with the first stage' \
   "$(awk '/ENERGY OF JOINTS/ { on = 1 } on && $1 == 1 { print $2; on = 0 }' "$work/bars.out")" "4*$p_rest*$at_rest/3" 1e-5
pulled="((0.05 - 0.01 - 0.02*4*$p_rest + 0.02*4000*$at_rest)/(1 + 0.02*4000))"
bars bars NEWTON 1.0 5 && near 'interference, pulled apart: p' "$(cell bars 1 5 2 pressure)" "$p_rest - 1000*($at_rest - $pulled)" 1e-9
bars bars STEP 1.0 160 && near 'interference, pulled apart, STEP' "$(cell bars 1 160 2 pressure)" "$p_rest - 1000*($at_rest - $pulled)" 3e-3

closing='(lambda + gap)'
for case in '0.5 10.0 0.02 1.0-4 0.0 1e-4 0' '0.5 0.0 0.0 1.0-4 0.0 1e-4 0' '1.0 -10.0 0.1 -1.0-4 4.0-6 -1e-4 4e-6' \
            '0.5 5.0 0.0 0.0 8.0-6 0 8e-6' '0.5 5.0 0.0 0.0 -2.0-6 0 -2e-6'; do
   set -- $case
   for method in NEWTON STEP BACK; do # one increment: STEP iterates it too, for the gaps leave the block loose
      gap_block block $method 20 $1 $2 1 '' "JGAP,1,PLANE,$3,$4,0.0,$5" || continue
      read -r d t worst most <<< "$(value block print "(first($closing) + last($closing))/2" \
         print "(last($closing) - first($closing))/100" \
         print "max(abs($closing - (first($closing) + last($closing))/2 - (last($closing) - first($closing))/100*x))" \
         print 'max(pressure)')"
      read -r d_awk t_awk most_awk <<< "$(gap_block_balance 20 $1 $2 '' $3 $6 $7)"
      near "rigid block behind gaps $*, $method: d" "$d" "$d_awk" 1e-5 1e-7
      near "rigid block behind gaps $*, $method: t" "$t" "$t_awk" 1e-5 1e-9
      near "rigid block behind gaps $*, $method: largest p" "$most" "$most_awk" 3e-5
      holds "rigid block behind gaps $*, $method: it stays straight" "$worst < 1e-6"
   done
done

# A wedge: with lambda = d + t x, d and t without G0 and SX, the continuous formulas N = (b/c**2)(d**2 L + t**2 L**3/12),
# M = (b/c**2) d t L**3/6 hold as without it.
before=
for nx in 20 40 80; do
   gap_block wedge NEWTON $nx 0.5 10.0 1 '' 'JGAP,1,PLANE,0.02,1.0-4' || continue
   read -r d t <<< "$(value wedge print "(first($closing) + last($closing))/2 - 0.02" print "(last($closing) - first($closing))/100 - 1e-4")"
   error=$(number "abs(20/8e-3^2*(($d)^2*100 + ($t)^2*100^3/12)/1000 - 1) + abs(20/8e-3^2*$d*$t*100^3/6/10000 - 1)")
   [ -n "$before" ] && holds "wedge, $nx elements: the error falls" "$error < 0.3*$before"
   before=$error
done
holds 'wedge: the continuous formulas' "$error < 1e-3"

# STEP goes on from its first increment in tangents: towards NEWTON.
gap_block wedge NEWTON 20 0.5 10.0 1 '' 'JGAP,1,PLANE,0.0,1.0-4' && d=$(value wedge print "(first($closing) + last($closing))/2")
before=
for n in 5 20 80; do
   gap_block wedge STEP 20 0.5 10.0 $n '' 'JGAP,1,PLANE,0.0,1.0-4' || continue
   error=$(number "abs($(value wedge rows "increment = $n" print "(first($closing) + last($closing))/2")/$d - 1)")
   [ -n "$before" ] && holds "wedge, STEP, $n increments: the error falls" "$error < 0.7*$before"
   before=$error
done
holds 'wedge, STEP' "$error < 0.05"

# Interference alone pushes a block away that nothing holds: nothing is pressed at rest, and then it bears the load as on a wedge.
for method in NEWTON STEP; do
   gap_block rest $method 20 0.5 10.0 1 '' 'JGAP,1,PLANE,0.0,1.0-4' || continue
   cp "$work/rest.joint.csv" "$work/wedge.joint.csv"
   sed -i 's/^PJOINT,1,1$/PJOINT,1,1,,,,,0.5/; s/^  LOAD = 1/  LABEL = AT REST/; s/^BEGIN/SUBCASE 2\n  LOAD = 1\nBEGIN/' "$work/rest.bdf"
   run rest && ask "a block pushed away, $method, at rest" rest rows 'stage = 1' count 21 all 'abs(force) < 1e-3' &&
      ask "a block pushed away, $method, loaded" rest rows 'stage = 2' count 21 with "$work/wedge.joint.csv" on element \
         all 'pressure = other.pressure within 1e-6'
done

# A crown under a rigid flat face, m = 1: p = C (w**2 - x**2)/c over the half width w; the pressures add up to the force:
# F = (4/3) b C w**3/c, and the closing is C w**2.
before=
for nx in 40 80 160; do
   gap_block crown NEWTON $nx 1.0 0.0 1 '' 'JGAP,1,PLANE,0.0,0.0,0.0,8.0-6' || continue
   read -r d most force <<< "$(value crown print "(first($closing) + last($closing))/2" print 'max(pressure)' print 'sum(force)')"
   near "crown, $nx elements: the whole force" "$force" 1000 1e-6
   w="((0.75*1000*8e-3/(20*8e-6))^(1/3))"
   error=$(number "abs($d/(8e-6*$w^2) - 1) + abs($most/(8e-6*$w^2/8e-3) - 1)")
   [ -n "$before" ] && holds "crown, $nx elements: the error falls" "$error < 0.6*$before + 1e-4"
   before=$error
done
holds 'crown: the pressure integral' "$error < 2e-3"

# The same crown as a table, by nodes: the same rows. And guided, by STEP in more and more increments.
gap_block crown NEWTON 4 0.5 0.0 1 '' 'JGAP,1,PLANE,0.0,0.0,0.0,8.0-6'
gap_block table NEWTON 4 0.5 0.0 1 '' $'JGAP,1,TABLE\n+,0.0,0.0,0.0,0.0,50.0,0.0,0.0,0.02\n+,-25.0,,,0.005,-50.0,,,0.02\n+,25.0,,,0.005' &&
   same_rows 'a crown as a table' crown table 1e-9
gap_block nodes NEWTON 4 0.5 0.0 1 '' $'JGAP,1,NODES\n+,1,0.02,3,0.005,7,0.005,9,0.02' && same_rows 'a crown by nodes' crown nodes 1e-9
read -r d t most <<< "$(gap_block_balance 20 0.5 0.0 1 0.0 0 8e-6)"
before=
for n in 40 160 640; do
   gap_block guided STEP 20 0.5 0.0 $n 1 'JGAP,1,PLANE,0.0,0.0,0.0,8.0-6' || continue
   error=$(number "abs($(value guided rows "increment = $n" print 'max(pressure)')/$most - 1)")
   [ -n "$before" ] && holds "a guided crown, STEP, $n increments: the error falls" "$error < 0.7*$before"
   before=$error
done
holds 'a guided crown, STEP' "$error < 0.03"

# The distance of the faces: two blocks meshed 0.25 apart close by it and bear evenly, either side first.
for sides in '20,21' '21,20'; do
   cards true <<DECK
METHOD = NEWTON;SPC = 1;SUBCASE 1;  LOAD = 1
BEGIN BULK;BLOCK2,1,1,4,2,0.0,0.0;+,100.0,50.0,,,,,101,101;+,22,,21
BLOCK2,2,1,4,2,0.0,50.25;+,100.0,100.25,,,,,1,1;+,20,,23;PMARK,20;PMARK,21;PMARK,22;PMARK,23;PSHELL,1,1,20.0
MAT1,1,9500.0,,0.0;JOINT,1,1,$sides,0.3;JGAP,1,TRUE;PJOINT,1,1;JNORM,1,8.0-3,0.5,9500.0;SPCM,1,2,22;SPC1,1,1,1,101
PLOADM,1,0.2,23;ENDDATA
DECK
   run true && ask "true distance, sides $sides" true count 5 \
      all 'gap = 0.25 within 1e-12 and pressure = 0.2 within 1e-9 and lambda = 8e-3*0.2^0.5 within 1e-11 and branch = "LOAD"'
done

# The open distance is a field of the file for ParaView.
sed 's/OUTPUT = NONE/OUTPUT = NONE,VTU/' "$work/apart.bdf" > "$work/apart.vtu.bdf" && run apart.vtu &&
   says 'the gap in the file for ParaView' "$work/apart.vtu.5.joint.vtu" 'Name="gap"'

# STEP after an increment that was iterated: the bodies take what the load presses, and with CARRY = YES nothing is loaded twice.
for carry in YES NO; do
   for gap in CONST,0.01 CONST,-0.01 PLANE,0.01,4.0-4; do
      for solver in SKYLINE TREE; do
         cards carried <<DECK
METHOD = STEP;CARRY = $carry;SOLVER = $solver;SPC = 1;SUBCASE 1;  LOAD = 1;  INCR = 1;  OUTPUT = NONE
BEGIN BULK;BLOCK2,1,1,4,4,0.0,0.0;+,10.0,10.0;+,20,,21;PMARK,20;PMARK,21;PSHELL,1,1,1.0;MAT1,1,1000.0,,0.0
JOINT,1,1,20;PJOINT,1,1,,,,,0.5;JNORM,1,8.0-3,0.5,500.0;JGAP,1,$gap;SPC1,1,1,1;PLOADM,1,2.0,21;JINCR,1,5;ENDDATA
DECK
         run carried || continue
         words="STEP behind a gap, $gap, $solver, CARRY = $carry"
         same "$words: nothing is unbalanced" "$(grep -c 'LEFT UNBALANCED BY' "$work/carried.out")" 0
         cp "$work/carried.joint.csv" "$work/carried_$solver.joint.csv"
         [ $gap = PLANE,0.01,4.0-4 ] && { [ $solver = SKYLINE ] || same_rows "$words" carried_TREE carried_SKYLINE 1e-9; continue; }
         near "$words: largest von Mises" "$("$query" "$work/carried.stage.csv" print mises_max)" 2 1e-9
         ask "$words: the joint bears the load" carried by increment all 'sum(force) = 20*load within 1e-9'
      done
   done
done

# Interference at one edge pushes a block away until nothing presses; how far it slides there under no pressure is no shear deflection.
# Loaded then, it sticks everywhere: tau = 100 delta from rest on, by NEWTON and by STEP.
for method in NEWTON STEP; do
   cards pushed <<DECK
METHOD = $method;SUBCASE 1;  LOAD = 1;  INCR = 1
BEGIN BULK;BLOCK2,1,1,4,2,0.0,0.0;+,40.0,20.0;+,20,,22;PSHELL,1,1,10.0;MAT1,1,100000.0,,0.3;PMARK,20;PMARK,22
JOINT,1,1,20;JGAP,1,PLANE,-1.0-3,1.3-4;PJOINT,1,1,1,,0.3,,0.1;JNORM,1,8.0-3,0.5,5000.0;JSHEAR,1,100.0
CELAS2,900,50.0,3,1;FORCEM,1,1.0,1.0,-100.0,0.0,22;JINCR,1,4;ENDDATA
DECK
   run pushed && ask "$method, pushed away by interference, then pressed: no shear deflection from the way" pushed count 20 \
      all 'slip = 0 and abs(tau_x - 100*delta_x) <= 1e-12 + 1e-9*abs(tau_x)'
done

# Two blocks, one on the other, interference below the lower one: while neither presses they do not slide off sideways.
for solver in SKYLINE TREE; do
   cards stack <<DECK
METHOD = NEWTON;SOLVER = $solver;SUBCASE 1;  LOAD = 1
BEGIN BULK;BLOCK2,1,1,4,2,0.0,0.0;+,40.0,12.0,,,,,1,1;+,20,,21
BLOCK2,2,1,4,2,0.0,12.0;+,40.0,20.0,,,,,101,101;+,22,,23;PSHELL,1,1,10.0;MAT1,1,100000.0,,0.3;PMARK,20;PMARK,21
PMARK,22;PMARK,23;JOINT,1,1,20;JOINT,2,1,22,21;JGAP,1,PLANE,-1.0-3,1.3-4;PJOINT,1,1,1,,1.3,,0.1
JNORM,1,8.0-3,0.5,5000.0;JSHEAR,1,100.0;FORCEM,1,1.0,0.0,-400.0,0.0,23;ENDDATA
DECK
   run stack && ask "$solver, a stack pushed away by interference: it does not slide off" stack count 10 \
      all 'slip = 0 and abs(tau_x - 100*delta_x) <= 1e-9 and abs(delta_x) < 1e-3'
done

# Quarters of a shaft in a ring, drawn with 23 and 16 chords whose sagittas are 0.0175 and 0.0361: JGAP TRUE finds the overlap of the circles.
# Lame, E = 210000, radii 12, 30, 55, both in plane stress: p = overlap E/(30 ((55^2 + 30^2)/(55^2 - 30^2) + (30^2 + 12^2)/(30^2 - 12^2))). Touching
# circles are not pressed. In the plane, and in space by hexahedra; the warning names gap and sagittas.
shrink() { # NAME DIMENSION OVERLAP
   awk -v d="$2" -v overlap="$3" '
      function ring(n0, e0, r1, r2, nt, mark, inner,   i, j, k, n, r, a, g, q, s) {
         n = n0
         for (i = 0; i <= 5; i++) for (j = 0; j <= nt; j++) for (k = 0; k <= d - 2; k++) {
            r = r1 + (r2 - r1)*i/5; a = atan2(0, -1)/2*j/nt; g[i, j, k] = ++n
            printf "GRID*,%d,,%.12f,%.12f,\n*,%.1f\n", n, r*cos(a), r*sin(a), 5*k
            printf "SPC1,1,%s3,%d\n", j == 0 ? 2 : (j == nt ? 1 : ""), n
         }
         for (i = 0; i < 5; i++) for (j = 0; j < nt; j++) {
            q = g[i, j, 0] "," g[i + 1, j, 0] "," g[i + 1, j + 1, 0] "," g[i, j + 1, 0]
            if (d == 3) q = q "," g[i, j, 1] "," g[i + 1, j, 1] "\n+," g[i + 1, j + 1, 1] "," g[i, j + 1, 1]
            printf "%s,%d,1,%s\n", d == 2 ? "CQUAD4" : "CHEXA", ++e0, q
         }
         i = inner ? 0 : 5
         for (j = 0; j < nt; j++) {
            s = inner ? g[i, j + 1, 0] "," g[i, j, 0] : g[i, j, 0] "," g[i, j + 1, 0]
            if (d == 3) s = inner ? g[i, j, 0] "," g[i, j, 1] "," g[i, j + 1, 1] "," g[i, j + 1, 0] : g[i, j, 0] "," g[i, j + 1, 0] "," g[i, j + 1, 1] "," g[i, j, 1]
            printf "%s,%d,%d,%s\n", d == 2 ? "CBAR" : "CQUAD4", ++e0, mark, s
         }
      }
      BEGIN {
         print "METHOD = NEWTON\nSPC = 1\nSUBCASE 1\nBEGIN BULK"
         ring(0, 0, 12, 30 + overlap, 23, 20, 0); ring(10000, 10000, 30, 55, 16, 21, 1)
         print d == 2 ? "PSHELL,1,1,5.0" : "PSOLID,1,1", "\nMAT1,1,210000.0,,0.3\nPMARK,20\nPMARK,21\nJOINT,1,1,20,21,0.5\nPJOINT,1,1,,,,,1.0"
         print "JNORM,1,1.0-7,1.0,1.0+7\nJGAP,1,TRUE\nENDDATA"
      }' > "$work/$1.bdf"
   [ "$2" = 2 ] && sed -i 's/^\(SPC1,1,.*\)3,/\1,/; /^SPC1,1,,/d' "$work/$1.bdf"
   run "$1"
}
lame=$(awk 'BEGIN { printf "%.9f", 0.02*210000/(30*((55^2 + 30^2)/(55^2 - 30^2) + (30^2 + 12^2)/(30^2 - 12^2))) }')
for d in 2 3; do
   shrink "shrunk$d" $d 0.02 && {
      pressure=$lame
      [ $d = 3 ] && pressure="$lame/(1 - 0.09)" # plane strain: both moduli over 1 - nu^2
      near "shrink fit in $d dimensions: mean pressure" "$(value shrunk$d rows 'increment = max(increment)' by stage print 'sum(force)/sum(area)')" "$pressure" 0.01
      ask "... the same at every node" shrunk$d rows 'increment = max(increment)' all "pressure = ($pressure) within 0.03*($pressure)"
      says "... the sagittas are told" "$work/shrunk$d.log" 'JGAP TRUE finds gaps of -0.02.* 0.0175.* (SIDE1) and 0.0361.* (SIDE2)'
   }
   shrink "touching$d" $d 0.0 && ask "touching circles in $d dimensions" touching$d rows 'increment = max(increment)' all "abs(pressure) < 0.001*$lame"
done

# A plate that interference holds at two points, the other gaps being open, pressed and pushed at once: the elements that close have to
# hold it, and nothing does before
for solver in SKYLINE TREE; do
   { echo "METHOD = NEWTON;SOLVER = $solver;SPC = 1;SUBCASE 1;LOAD = 10;INCR = 51;BEGIN BULK"
     echo 'BLOCK3,1,1,2,2,2,6.1,-3.07,-3.27;,36.5,20.,3.95,,,,101,101;,,,,,11,12;GRID,28,,8.49,-5.48,5.75;GRID,29,,8.49,17.6,5.75'
     echo 'GRID,30,,25.1,-5.48,5.75;GRID,31,,25.1,17.6,5.75;GRID,32,,38.4,-5.48,5.75;GRID,33,,38.4,17.6,5.75'
     for mark in 2,28,30,31,29,30,32,33,31 21,28,29,31,30,30,31,33,32 22,28,30,31,29,30,32,33,31; do
        IFS=, read -r pid a b c d e f g h <<< "$mark"
        echo "CQUAD4,1$pid,$pid,$a,$b,$c,$d;CQUAD4,2$pid,$pid,$e,$f,$g,$h"
     done
     echo 'PSOLID,1,1;MAT1,1,1.38+5,,.27;PMARK,11;PMARK,12;PMARK,21;PMARK,22;PSHELL,2,2,3.6,2,,2;MAT1,2,8.28+4,,.33'
     echo 'JOINT,2,1,12,21;PJOINT,1,1,1,1,1.24,,.168;JSHEAR,1,111.;JNORM,1,.00353,.798,2540.;JGAP,2,TABLE'
     echo '+,7.07,21.9,3.95,-.00193,43.9,21.4,3.95,.000312;+,2.51,-7.68,3.95,-.00216,44.5,-7.66,3.95,.0029;+,18.,-.562,3.95,.00332'
     echo 'SPCM,1,123,11;FORCEM,10,1.,-37.9,114.,-1200.,22;PLOADM,10,.851,22;JINCR,51,,LIST,1.;ENDDATA'; } | cards two_points_$solver
   run two_points_$solver && same "a plate on two points, $solver: open elements" "$(grep -c ,OPEN, "$work/two_points_$solver.joint.csv")" 0 && near "a plate on two points, $solver: its push" "$(total two_points_$solver SUPPORTS 2)" -114 1e-6
done

# Four points of a gap table nearly on a circle, the fourth 0.1 % outside: the Delaunay triangles are those of the other diagonal, also in a
# mirror. At the node 0.01*0.05
for side in '' -; do
   cards nearly_square <<< "METHOD = NEWTON;SUBCASE 1;LOAD = 1;BEGIN BULK;GRID,1,,${side}0.183012701892,0.683012701892,0.,,12
CJOINT,1,1,1,,100.,0.,0.,1.;PJOINT,1,1;JNORM,1,8.-3,.5,9500.;JGAP,1,TABLE
$(awk -v s="${side}1" 'BEGIN { printf "+,%.9f,-5.,0.,0.,%.9f,5.,0.,0.", -8.660254038*s, 8.660254038*s
                               printf ";+,%.9f,8.660254038,0.,.01,%.9f,-8.668914292,0.,.01", -5*s, 5.005*s }')
FORCE,1,1,,1.,0.,0.,-100.;ENDDATA"
   run nearly_square && near "nearly a square${side:+, mirrored}: gap" "$(cell nearly_square 1 1 1 gap)" 5e-4 1e-6
done

# Two blocks whose faces match and stand 1 apart: they are joined, and a warning says so, but not with JGAP
for gap in '' 'JGAP,1,TRUE;'; do
   cards apart <<< "METHOD = NEWTON;SPC = 1;SUBCASE 1;LOAD = 10;BEGIN BULK;BLOCK3,1,1,1,1,1,0.,0.,0.;,20.,20.,20.,,,,1,1;,,,,,20,21
BLOCK3,2,1,1,1,1,0.,0.,21.;,20.,20.,40.,,,,101,101;,,,,,22,23;PSOLID,1,1;MAT1,1,1.2+5,,.25;PMARK,20;PMARK,21;PMARK,22;PMARK,23
JOINT,1,1,22,21;PJOINT,1,1,2;JNORM,1,1.-3,.5,3.+4;JSHEAR,2,100.;${gap}SPCM,1,123,20;SPCM,1,12,23;FORCEM,10,400.,0.,0.,-1.,23;ENDDATA"
   run apart && same "faces apart${gap:+, with JGAP}: warnings" "$(grep -c 'faces stand apart or overlap by up to 1, and are joined' "$work/apart.log")" $((${#gap} == 0))
done

# A plate lifted off its joint hangs on two upright bolts: nothing holds it sideways, and a warning says so; a third one, aslant, holds it
hanging() { # NAME CARD
   cards "$1" <<DECK
METHOD = NEWTON;SPC = 1;SUBCASE 1;SUBCASE 2;  LOAD = 10;BEGIN BULK;BLOCK2,1,1,4,1,0.0,0.0;+,80.0,20.0,,,,,1,1;+,,,20;BLOCK2,2,1,4,1,0.0,20.0
+,80.0,40.0,,,,,11,11;+,21;PSHELL,1,1,20.0;MAT1,1,210000.,,0.3;PMARK,20;PMARK,21;JOINT,1,1,20,21;PJOINT,1,1,1,,0.3;JNORM,1,1.0-3,0.5,2.0+5;JSHEAR,1,2.0+4
CROD,901,90,3,14;CROD,902,90,7,18;PROD,90,1,60.0;BOLT,1,901,2000.,1;BOLT,2,902,3000.,1;SPC1,1,12,1,3,5,7,9;FORCE,10,14,,6000.,0.0,1.0
FORCE,10,18,,8300.,0.0,1.0;$2;ENDDATA
DECK
   run "$1"
}
hanging hangs 'FORCE,10,20,,100.,0.0,-1.0' && {
   says 'a plate that hangs on two rods: the screen' "$work/hangs.log" 'a joint is open at all nodes, and nothing holds a body in some direction'
   says 'a plate that hangs on two rods: the listing' "$work/hangs.out" 'NOTHING HOLDS A BODY IN SOME DIRECTION'
}
hanging held_aslant 'CROD,903,91,1,20;PROD,91,1,1.0' && same 'a plate on a third rod, aslant' "$(grep -c 'nothing holds a body' "$work/held_aslant.log")" 0
