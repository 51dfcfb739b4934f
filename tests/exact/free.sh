# BACKBONE of structures without supports, MODES(FREE): the inertia forces of the mode are in equilibrium with themselves
# same_backbone WORDS NAME-A NAME-B WITHIN [COLUMNS]: all rows alike: columns 3 to 8, or to COLUMNS; loss factor and distortion within 0.1 WITHIN
# of one, too
same_backbone() {
   judge "$1" -F, -v within="$4" -v columns="${5:-8}" 'FNR == 1 { next } NR == FNR { for (i = 3; i <= 8; i++) a[FNR, i] = $i; rows = FNR; next }
      { n++
        for (i = 3; i <= columns; i++) if (($i - a[FNR, i])^2 > (within*a[FNR, i])^2 + (i == 5 || i == 8 ? (0.1*within)^2 : 0))
           print "amplitude " $3 ", column " i ": " $i ", expected " a[FNR, i] }
      END { if (n != rows - 1) print n " rows"; print "checked " n }' "$work/$2.backbone.csv" "$work/$3.backbone.csv"
}

# ---- Two stiff bars of masses 0.02 and 0.03, three elements and a spring between them along x: against each other they are a mass of
# 0.02*0.03/0.05 on the spring 1000 and three elements of stiffness 4000 that slip at 70 times 0.14, 0.2 and 0.26; the first moves by
# 0.03/0.05 of that. TURNED by an angle; numbered from the other end (BACK = 1); the first bar in a system CD (CD = 1)
free_bars() { # NAME TURNED BACK CD
   awk -v turned="$2" -v back="$3" -v cd="$4" 'function id(b, i) { return back ? 30 - 10*b - i : 10*b + i }
      BEGIN {
         t = turned*atan2(0, -1)/180; c = cos(t); s = sin(t)
         print "METHOD = NEWTON;MODEL = PLANE;SUBCASE 1;  LOAD = 10;  MODES(FREE) = 5;  BACKBONE = 6;BEGIN BULK"
         print "JNORM,1,8.0-3,0.5,500.0;JSHEAR,2,40.0;EIGRL,5,,,5;JAMPL,6,4,0.03,9,0.05;PBAR,1,1,100.0,1.0E4,1.0E4,1.0E4;PBAR,2,2,100.0,1.0E4,1.0E4,1.0E4"
         print "MAT1,1,1.0E10,,0.3,2.0-6;MAT1,2,1.0E10,,0.3,3.0-6;CORD2R,7,,0.0,0.0,0.0,0.0,0.0,1.0;+,0.6,0.8,0.0"
         for (b = 0; b < 2; b++) for (i = 1; i <= 3; i++) {
            printf "GRID,%d,,%.12f,%.12f,0.0%s\nFORCE,10,%d,,70.0,%.15f,%.15f\n", id(b, i), 50*i*c, 50*i*s, cd*!b ? ",7" : "", id(b, i), b ? s : -s, b ? -c : c
            if (i < 3) printf "CBAR,%d,%d,%d,%d\n", 200 + id(b, i), b + 1, id(b, i), id(b, i + 1)
            if (!b) printf "CJOINT,%d,%d,%d,%d,100.0,%.15f,%.15f\nPJOINT,%d,1,2,,%g\n", i, i, id(0, i), id(1, i), -s, c, i, 0.08 + 0.06*i
         }
         # along the bars; a spring of the turned structure is a rod
         printf "CONROD,900,%d,%d,3,20.0\nMAT1,3,5.0E3,,0.3\nENDDATA\n", id(0, 1), id(1, 3)
      }' | cards "$1"
   run "$1"
}
for case in '0 0 0' '30 0 0' '0 1 0' '90 1 1'; do
   free_bars two_bars $case && judge "two bars, $case" -F, 'function most(a, b) { return a > b ? a : b } function near(a, b) { return (a - b)^2 <= (2e-6*b)^2 + 1e-12 }
      NR == 1 { pi = atan2(0, -1); next }
      { x = $3*5/3; k = 1000; d = 0; n++
        for (i = 1; i <= 3; i++) { f = 70*(0.08 + 0.06*i); k += f/most(x, f/4000); d += 4*f*most(0, x - f/4000) }
        if (!near($4, sqrt(k/0.012)/(2*pi)) || !near($5, d/(pi*k*x*x))) print "amplitude " $3 ": " $4 ", " $5 ", expected " sqrt(k/0.012)/(2*pi) ", " d/(pi*k*x*x) }
      END { if (n != 9) print n " rows"; print "checked " n }' "$work/two_bars.backbone.csv"
done

# ---- Two beams of 20 x 10 that lap over three nodes, 5 from the axis of either, with discs at the ends, whose rotary inertia
# puts the first mode far below the others, free: against free decay integrated in
# time (ring_down.awk), which knows no supports; on soft springs to the ground; turned; numbered from the other end, so that FREE holds
# other nodes; joined by the other solver
places=(x 0 150 250 350 500)
free_lap() { # NAME TURNED BACK FREE SOLVER SPRING
   awk -v turned="$2" -v back="$3" -v modes="$4" -v solver="$5" -v spring="$6" -v places="${places[*]:1}" '
      function id(n) { return back ? 30 - n : n }
      function grid(n, x) { printf "GRID,%d,,%.12f,%.12f,0.0\n", id(n), x*c, x*s }
      function beam(e, a, b, h) { printf "CBAR,%d,1,%d,%d;+,,,%.9f,%.9f,0.0,%.9f,%.9f,0.0\n", e, id(a), id(b), -h*s, h*c, -h*s, h*c }
      BEGIN {
         t = turned*atan2(0, -1)/180; c = cos(t); s = sin(t); split(places, x, " ")
         print "METHOD = NEWTON;MODEL = PLANE;SOLVER = " solver ";SUBCASE 1;  LOAD = 10;  " modes " = 5;  BACKBONE = 6;BEGIN BULK;MAT1,1,210000.0,,0.3,7.85-9"
         print "PBAR,1,1,200.0,1666.667,6666.667,1.0E4;EIGRL,5,,,5;JAMPL,6,4,1.5,41,0.05;JNORM,1,5.0-4,1.0,2000.0;JSHEAR,2,100.0;PJOINT,1,1,2,,0.05"
         printf "CONM2,98,%d,,1.0-4;+,,,,,,600.0;CONM2,99,%d,,1.0-4;+,,,,,,600.0\n", id(1), id(15)
         for (i = 1; i <= 4; i++) {
            grid(i, x[i]); grid(11 + i, x[i + 1])
            if (i < 4) { beam(i, i, i + 1, -5); beam(10 + i, 11 + i, 12 + i, 5) }
            if (i > 1) printf "CJOINT,%d,1,%d,%d,100.0,%.15f,%.15f\nFORCE,10,%d,,%d.0,%.15f,%.15f\nFORCE,10,%d,,%d.0,%.15f,%.15f\n", 100 + i, id(i), id(10 + i),
               -s, c, id(i), 1000 + 500*i, -s, c, id(10 + i), 1000 + 500*i, s, -c
         }
         if (spring) for (i = 1; i <= 15; i += 14) printf "CELAS2,9%d1,%g,%d,1;CELAS2,9%d2,%g,%d,2\n", i, spring, id(i), i, spring, id(i)
         print "ENDDATA"
      }' | cards "$1"
   run "$1"
}
{
   for i in 1 15; do printf 'mass %d 1e-4\nmass %d 1e-4\nmass %d 600\n' ${i}0 ${i}1 ${i}2; done
   for i in 1 2 3; do
      echo "beam ${i}0 $((i + 1))0 $((places[i + 1] - places[i])) 4.2e7 3.5000007e8 1.57e-6 1.3083336e-5 -5"
      echo "beam 1$((i + 1))0 1$((i + 2))0 $((places[i + 2] - places[i + 1])) 4.2e7 3.5000007e8 1.57e-6 1.3083336e-5 5"
      echo "element $((i + 1))0 1$((i + 1))0 1e4 $((75 + 25*i)) 0.05 2e5"
   done
} > "$work/free_lap.system"
free_lap free_lap 0 0 'MODES(FREE)' TREE 0 && {
   rm -f "$work/free_lap.rows"; ring_down free_lap 10 5e-4 0.8 0 3
   near 'free beams that stick: frequency of the decay' "$(awk 'NR == 1 { print $2 }' "$work/free_lap.rows")" "$(backbone free_lap frequency)" 2e-4
   near 'free beams that stick: no loss in the backbone' "$(backbone free_lap loss_factor)" 0 0 1e-9
   rm "$work/free_lap.rows"; ring_down free_lap 75 5e-4 4.0 20 3; ring_down free_lap 45 5e-4 2.0 20 3; decays_like free_lap
}
few() { sed -i 's/^JAMPL.*/JAMPL,6,4,1.0,3,0.4,20,,'"${2:-1}"'/' "$work/$1.bdf" && run "$1"; } # NAME [NODE]: three amplitudes, at a node
free_lap few 0 0 'MODES(FREE)' TREE 0 && few few &&
   for case in 'turned 30 0 MODES(FREE) TREE 0 1' 'numbered_back 0 1 MODES(FREE) TREE 0 29' 'skyline 0 0 MODES(FREE) SKYLINE 0 1' 'both 200 1 MODES(FREE) SKYLINE 0 29'; do
      set -- $case
      free_lap "$1" "$2" "$3" "$4" "$5" "$6" && few "$1" "$7" && same_backbone "free beams, $1" few "$1" 1e-5
   done
# springs of 0.1 to 0.001 N/mm: the difference falls with them in proportion
for k in 0.1 0.01 0.001; do
   free_lap soft_$k 0 0 MODES TREE $k && few soft_$k && same_backbone "free beams on springs of $k" few soft_$k "$(number "0.12*$k + 1e-5")" 5
done
# a mode without strain
sed 's/^JAMPL,6,4/JAMPL,6,1/' "$work/few.bdf" > "$work/rigid.bdf"
run rigid && says 'a backbone of a mode without strain' "$work/rigid.out" 'WARNING: NO BACKBONE: THE MODE HAS NO STRAIN'
# a structure with supports of its own, whose modes are free of them: the supports would bear a part of the load
sed 's/^GRID,1,.*/&;SPC1,1,2,1,15/; s/^SUBCASE.*/SPC = 1;&/' "$work/few.bdf" | cards held
run held 2 && says 'supports in the deck' "$work/held.log" 'BACKBONE with MODES(FREE): expected a deck without supports'

# ---- A solid bolt through two plates, without supports: its pretension section is no support, and FREE holds the structure; the bolt has its preload
# and the modes are those of free bodies
sed '/^SPC/d; /^FORCEM/d; /^MAT1/d; /^PJOINT/d; s/^SUBCASE 2/&\n MODES(FREE) = 5/; /LABEL = PULL/d; /LOAD = 10/d; /INCR = 6/d
   s/^BEGIN BULK/&\nMAT1,1,2.1+5,,0.3,7.85-9\nPJOINT,1,1,2,2,0.2\nJSHEAR,2,2.0+4\nEIGRL,5,,,8/' input/solid_bolt.bdf > "$work/free_bolt.bdf"
run free_bolt && {
   near 'free solid bolt: preload' "$("$query" "$work/free_bolt.bolt.csv" rows 'stage = 1' rows 'increment = max(increment)' print force)" 6000 1e-6
   same 'free solid bolt: no strain in six modes' "$(awk -F, '$1 == 2 && $2 <= 6 && $3 == 0' "$work/free_bolt.modes.csv" | wc -l)" 6
}

# ---- a free beam of ten elements whose nodes all are nodes of one RBE3, the mean motion: f = 4.7300407^2/(2 pi L^2) sqrt(E I/(rho A))
{
   printf '%s\n' 'SOL 103' 'CEND' 'METHOD = 1' 'BEGIN BULK' 'EIGRL,1,,,8' 'PARAM,COUPMASS,1' 'PBAR,1,1,100.0,800.0,900.0,1500.0' 'MAT1,1,2.1E5,,0.3,7.85E-9'
   awk 'BEGIN { for (i = 1; i <= 11; i++) printf "GRID,%d,,%.1f,0.0,0.0\n", i, 100*(i - 1); for (i = 1; i <= 10; i++) printf "CBAR,%d,1,%d,%d,0.0,0.0,1.0\n", i, i, i + 1 }'
   printf '%s\n' 'GRID,20,,500.0,0.0,50.0' 'RBE3,30,,20,123456,1.0,123,1,2' ',3,4,5,6,7,8,9,10' ',11,1.0,4,1' 'ENDDATA'
} > "$work/free_mean.bdf"
run free_mean && near 'free, all nodes in an RBE3' "$(mode free_mean 7 frequency)" '4.7300407^2/(2*pi*1000^2)*sqrt(2.1E5*800/(7.85E-9*100))' 1e-3

# ---- a free slender beam of long and very short elements, 500 and 1: its stiffness hides the rigid-body motions by rounding, so that no shift
# of the size of what seems the first frequency can be factorised
{
   printf '%s\n' 'SOL 103' 'CEND' 'METHOD = 1' 'BEGIN BULK' 'EIGRL,1,,,8' 'PARAM,COUPMASS,1' 'PBAR,1,1,12.0,12.0,15.0,25.0' 'MAT1,1,7.0E7,2.6E7,,2.7E-6' 'GRID,1,,0.0,0.0,0.0'
   awk 'BEGIN { for (k = 2; k <= 22; k++) { x += k % 2 ? 1 : 500; printf "GRID,%d,,%.3f,%.3f,0.0\nCBAR,%d,1,%d,%d,0.0,0.0,1.0\n", k, 0.6*x, 0.8*x, k, k - 1, k } }'
   echo ENDDATA
} > "$work/free_slender.bdf"
run free_slender && {
   near 'free, slender: rigid-body modes' "$(mode free_slender 6 frequency)" 0 0 1e-12
   near 'free, slender: bending' "$(mode free_slender 7 frequency)" '4.7300407^2/(2*pi*5510^2)*sqrt(7E7/2.7E-6)' 1e-4
   near 'free, slender: bending about the other axis' "$(mode free_slender 8 frequency)" '4.7300407^2/(2*pi*5510^2)*sqrt(7E7*15/(2.7E-6*12))' 1e-4
}

# ---- free structures whose nodes all have a CD, rectangular or cylindrical: the modes of those without
{
   printf '%s\n' 'SOL 103' 'CEND' 'METHOD = 1' 'BEGIN BULK' 'EIGRL,1,,,8' 'CORD2R,8,,0.,0.,0.,0.,0.,1.' ',1.,1.,0.' 'CORD2C,9,,-5.,.5,0.,-5.,.5,1.' ',1.,1.,0.'
   printf '%s\n' 'GRDSET,,,,,,0' 'GRID,1,,0.,0.,0.' 'GRID,2,,2.,0.,0.' 'GRID,3,,2.,3.,0.' 'GRID,4,,0.,3.,0.' 'GRID,5,,0.,0.,4.' 'GRID,6,,2.,0.,4.' \
      'GRID,7,,2.,3.,4.' 'GRID,8,,0.,3.,4.' 'MAT1,1,2.+11,,.3,7800.' 'PSOLID,1,1' 'CHEXA,1,1,1,2,3,4,5,6' ',7,8' ENDDATA
} > "$work/free_block.bdf"
sed '/^CHEXA/,/^,7,8/d; s/^PSOLID.*/PBAR,1,1,.01,1.-5,2.-5,3.-5\nCBAR,1,1,1,2,7\nCBAR,2,1,2,3,7\nCBAR,3,1,3,7,1/; /^GRID,[4568]/d' \
   "$work/free_block.bdf" > "$work/free_bars.bdf"
for of in block bars; do
   run free_$of || continue
   for system in 8 9; do
      sed "s/^GRDSET.*/GRDSET,,,,,,$system/" "$work/free_$of.bdf" > "$work/free_cd.bdf"
      run free_cd || continue
      near "free $of, all nodes with CD $system: rigid-body modes" "$(mode free_cd 6 frequency)" 0 0 1e-4
      for k in 7 8; do
         near "free $of, all nodes with CD $system: mode $k" "$(mode free_cd $k frequency)" "$(mode free_$of $k frequency)" 1e-6
      done
   done
done

# ---- free masses on bushes, no body: the modes of the same chain on SUPORT; in a row, so that rotations must hold it, and not
chain_of_bushes() { # NAME Y2 SUPPORT
   cards "$1" <<DECK
MODEL = SPACE;$3;BEGIN BULK;GRID,1,,0.,0.,0.;GRID,2,,100.,$2,0.;GRID,3,,200.,0.,0.;GRID,4,,300.,0.,0.;CBUSH,1,3,1,2,,,,0;CBUSH,2,3,3,4,,,,0
CBUSH,3,3,2,3,,,,0;CONM2,11,1,,.01;+,10.,,10.,,,10.;CONM2,12,2,,.01;+,10.,,10.,,,10.;CONM2,13,3,,.01;+,10.,,10.,,,10.;CONM2,14,4,,.01
+,10.,,10.,,,10.;PBUSH,3,K,1.+4,2.+3,3.+3,1.+7,2.+7,3.+7;EIGRL,4,,,9;${4:-};ENDDATA
DECK
   run "$1"
}
for y in 0. 30.; do
   chain_of_bushes bushes_held $y 'METHOD = 4' SUPORT,1,123456 && chain_of_bushes bushes $y 'MODES(FREE) = 4' || continue
   near "bushes in a row, $y: rigid-body motions" "$(mode bushes 6 frequency)" 0 0 1e-4
   for k in 7 8 9; do near "bushes in a row, $y: mode $k" "$(mode bushes $k frequency)" "$(mode bushes_held $k frequency)" 1e-6; done
done
