# Joints between two bodies.

# block_on NAME METHOD BASE: a block pressed off the middle, pushed and released, on RIGID base, on a BODY 1e6 times stiffer that is held below,
# or on a SOFT body of its own material; the joint SPLIT out of one mesh or between two MESHES with facing surfaces.
block_on() {
   awk -v method="$2" -v base="$3" 'BEGIN {
      print "METHOD = " method "\nSPC = 1"
      for (stage = 1; stage <= 3; stage++)
         print "SUBCASE " stage "\n  LOAD = " stage "\n  INCR = " (stage == 1 ? 4 : 8) "\n  OUTPUT = NONE"
      print "BEGIN BULK\nPSHELL,1,1,20.0\nMAT1,1,9500.0,,0.25\nPSHELL,2,2,20.0"
      print "MAT1,2," (base == "BODY" ? "9.5E9" : "9500.0") ",,0.25"
      weld = ""; sides = "20,"; marks = "+,20"
      if (base != "RIGID") {
         print "BLOCK2,2,2,10,2,0.0,-30.0\n+,100.0,0.0,,,,,1001,1001\n+,22,," (base == "SPLIT" ? "" : "21") "\nPMARK,22\nSPCM,1,12,22"
         if (base == "SPLIT") weld = ",,,,2"; else { sides = "20,21"; print "PMARK,21" }
      }
      print "BLOCK2,1,1,10,4,0.0,0.0\n+,100.0,40.0,,,,,1,1\n+,20" weld "\nPMARK,20"
      print "SPC1,1,3,55"
      print "JOINT,1,1," sides "\nPJOINT,1,1,1,,0.2,3\nJNORM,1,8.0-3,0.5,9500.0\nJSHEAR,1,100.0,300.0\n+,160.0,250.0"
      print "FORCE,1,30,,600.0,0.0,-1.0\nFORCE,1,25,,400.0,0.0,-1.0\nFORCE,9,55,,130.0,1.0"
      print "LOAD,2,1.0,1.0,1,1.0,9\nLOAD,3,1.0,1.0,1,-0.5,9\nJINCR,4,4,ARITH,0.25\nJINCR,8,8,ARITH,0.125\nENDDATA"
   }' > "$work/$1.bdf"
   run "$1"
}

for method in NEWTON STEP; do
   block_on rigid $method RIGID && block_on stiff $method BODY && same_rows "on a body 1e6 times stiffer, $method" rigid stiff 1e-5 $along
   block_on meshes $method MESHES && block_on split $method SPLIT && same_rows "split or meshed apart, $method" meshes split 1e-10 $along
done

# Which of the two sides is SIDE1 does not matter, but for the sense of the shear.
sed 's/^JOINT,1,1,20,21/JOINT,1,1,21,20/' "$work/meshes.bdf" > "$work/swapped.bdf"
run swapped && same_rows 'sides exchanged' meshes swapped 1e-10 $against

# Three blocks on a rigid base, three joints with laws of their own, pressed evenly (nu = 0): each carries all, lambda = c p**m of its law.
cards stack <<'DECK'
METHOD = NEWTON;SPC = 1;SUBCASE 1;  LOAD = 1;  INCR = 1
BEGIN BULK;BLOCK2,1,1,2,2,0.0,0.0;+,40.0,20.0,,,,,1,1;+,10,,11
BLOCK2,2,1,2,2,0.0,20.0;+,40.0,40.0,,,,,101,101;+,12,,13;BLOCK2,3,1,2,2,0.0,40.0;+,40.0,60.0,,,,,201,201;+,14;PMARK,10
PMARK,11;PMARK,12;PMARK,13;PMARK,14;PSHELL,1,1,20.0;MAT1,1,9500.0,,0.0;JOINT,1,1,10;JOINT,2,2,11,12;JOINT,3,3,14,13
PJOINT,1,1;PJOINT,2,2;PJOINT,3,3;JNORM,1,8.0-3,0.5,9500.0;JNORM,2,5.0-3,0.4,9500.0;JNORM,3,3.0-3,1.0,9500.0
SPC1,1,1,2,102,202;FORCE,1,203,,100.0,0.0,-1.0;FORCE,1,206,,200.0,0.0,-1.0;FORCE,1,209,,100.0,0.0,-1.0
JINCR,1,3,ARITH,0.2;ENDDATA
DECK
run stack && {
   ask 'three joints in one model' stack all 'pressure = 0.5*load within 1e-8*pressure' by joint all 'max(joint) <= 3 and count() = 9' \
      all 'lambda = if(joint = 1, 8e-3*sqrt(0.5*load), if(joint = 2, 5e-3*(0.5*load)^0.4, 3e-3*0.5*load)) within 1e-8*lambda'
   judge 'three joints in one model: resultants' '
      /RESULTANTS OF JOINTS/ { on = 1; next }
      /ENERGY/ { on = 0 }
      on && NF == 7 && $1 ~ /^[0-9]+$/ {
         n++; load = $1 == 1 ? 80 : $1 == 2 ? 80 + 400 / 3 : 400
         fy = ($2 == 3 ? 1 : 1) * load
         if (($3 / load - 1)^2 > 1e-10 || $4 != 0 || $5 != 0 || ($6 + ($2 == 2 ? -fy : fy))^2 > 1e-6 || $7 != 0) print
      }
      END { if (n != 9) print n " lines"; print "checked " n }' "$work/stack.out"
}

# E_u left blank: bodies of E 100 and 300 have 2 x 100 x 300/400 = 150 between them, and loaded and relieved they go the same way
# whichever side comes first. p 0.5 and then 0.1 by hand: lambda = 8E-3 sqrt(0.5) - 0.4/150 (nu = 0, pressed evenly).
unequal() { # NAME SIDES
   cards "$1" <<DECK
METHOD = NEWTON;SPC = 1;SUBCASE 1;  LOAD = 1;SUBCASE 2;  LOAD = 2
BEGIN BULK;PSHELL,1,1,20.0;MAT1,1,100.0,,0.0;PSHELL,2,2,20.0;MAT1,2,300.0,,0.0
BLOCK2,2,2,2,1,0.0,-30.0;+,100.0,0.0,,,,,1001,1001;+,22,,21;BLOCK2,1,1,2,1,0.0,0.0;+,100.0,40.0,,,,,1,1;+,20,,23
PMARK,20;PMARK,21;PMARK,22;PMARK,23;SPCM,1,12,22;SPC1,1,1,1;JOINT,1,1,$2;PJOINT,1,1;JNORM,1,8.0-3,0.5;PLOADM,1,0.5,23
PLOADM,2,0.1,23;ENDDATA
DECK
   run "$1"
}
unequal up 20,21 && unequal down 21,20 && {
   near 'bodies of unequal E: relieved along the equivalent E' "$(cell up 2 1 1 lambda)" "$(awk 'BEGIN { printf "%.15e", 8e-3 * sqrt(0.5) - 0.4 / 150 }')" 1e-9
   near 'bodies of unequal E: k_n' "$(cell up 2 1 1 k_n)" 75000 1e-12
   near 'bodies of unequal E: sides exchanged' "$(cell down 2 1 1002 lambda)" "$(cell up 2 1 1 lambda)" 1e-10
}

# An E_u less steep than the loading curve is warned of, once a joint: at p = 0.5 the slope is 2 sqrt(0.5)/8E-3 = 176.777, the set of
# 150 is 5.657E-3 - 0.5/150 > 0; that of 80 would be negative.
says 'E_u below the slope of the loading curve' "$work/up.out" 'STAGE 1, INCREMENT 1: E_U = 150 OF JOINT 1 IS BELOW THE LOADING SLOPE 176.7767 AT P = 0.5$'
same 'E_u below the slope: once' "$(grep -c 'WARNING.*: E_U = ' "$work/up.out")" 1
sed 's/^JNORM.*/&,80.0/' "$work/up.bdf" > "$work/negative.bdf"
run negative && says 'E_u below the secant' "$work/negative.out" 'E_U = 80 OF JOINT 1 IS BELOW THE LOADING SLOPE 176.7767 AT P = 0.5: NEGATIVE SET$'
sed 's/^JNORM.*/&,180.0/' "$work/up.bdf" > "$work/steep.bdf"
run steep && same 'E_u above the slope: no warning' "$(grep -c 'WARNING:' "$work/steep.out")" 0

# ---- a pin in a bore, all round: pressed from inside, the joint has the same pressure everywhere and no normal of its own ----

# 48 sectors; the inner ring from 30 to 50, the outer one from 50 to 80, plane strain; nodes at 50 twice
awk 'function ring(first, element, n, from, to,   i, j, a, b) {
        for (i = 0; i < 48; i++) for (j = 0; j <= n; j++) {
           r = from + (to - from)*j/n
           printf "GRID,%d,,%.12f,%.12f\n", first + i*(n + 1) + j, r*cos(pi*i/24), r*sin(pi*i/24)
        }
        for (i = 0; i < 48; i++) for (j = 0; j < n; j++) {
           a = first + i*(n + 1) + j; b = first + ((i + 1)%48)*(n + 1) + j
           printf "CQUAD4,%d,1,%d,%d,%d,%d\n", element + i*n + j, a, a + 1, b + 1, b
        }
     }
     function edges(first, element, n, j, mark,   i) {
        for (i = 0; i < 48; i++) printf "CBAR,%d,%d,%d,%d\n", element + i, mark, first + i*(n + 1) + j, first + ((i + 1)%48)*(n + 1) + j
     }
     BEGIN {
        pi = atan2(0, -1)
        print "METHOD = NEWTON\nSPC = 1\nSUBCASE 1\n  LOAD = 1\n  INCR = 5\nBEGIN BULK\nPSHELL,1,1,1.0,-1\nMAT1,1,9500.0,,0.25"
        print "JOINT,1,1,20,21\nPJOINT,1,1,,,,,0.1\nJNORM,1,8.0-3,0.5\nPMARK,20\nPMARK,21\nPMARK,22\nPLOADM,1,1.0,22\nJINCR,5,4"
        ring(1, 1, 8, 30, 50); ring(1001, 1001, 12, 50, 80)
        edges(1, 2001, 8, 8, 20); edges(1001, 2101, 12, 0, 21); edges(1, 2201, 8, 0, 22)
        # nothing turns or slides: the nodes on the axes stay on them
        print "SPC1,1,2,1,217\nSPC1,1,1,109,325\nSPC1,1,2,1013,1325\nSPC1,1,1,1169,1481\nENDDATA"
     }' > "$work/all_round.bdf"
run all_round && {
   ask 'all round: one pressure' all_round rows 'increment = 4' count 48 all 'pressure = max(pressure) within 1e-8' \
      all 'lambda = 8e-3*pressure^0.5 within 1e-12'
   # two rings of Lame with a joint between them: method of the Verification, p = 0.125133 at the radius of 50
   near 'all round: the pressure of the continuum' "$(value all_round rows 'increment = 4 and node1 = 9' print pressure)" 0.125133 1e-2
   says 'all round: no normal' "$work/all_round.out" '1.00000E-01  *1.00000E-07  *CLOSED'
   same 'all round: no force along a normal' "$(table all_round 'INCREMENTS OF STAGE' | awk '$1 == 4 { print NF }')" 10
}
