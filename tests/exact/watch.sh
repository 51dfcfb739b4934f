# WATCH: movement, stiffness, and who gives way by how much.
watched() { "$query" "$work/$1.watch.csv" rows "stage = $2 and node = $3" print "$4"; }
share() { awk -F, -v s="$2" -v kind="$3" -v id="$4" '$1 == s && $2 == kind && $3 == id { printf "%.17g", $4 + $5 }' "$work/$1.watch.energy.csv"; }
adds_up() { # NAME STAGES
   same "shares of $1 add up to 1 in $2 stages" "$(awk -F, 'NR > 1 { sum[$1] += $4 + $5 }
      END { for (s in sum) n += (sum[s] - 1)^2 < 1e-18; print n }' "$work/$1.watch.energy.csv")" "$2"
}

# A block between a joint below and two springs above, pressed in two stages: three compliances in a row, that of the joint by
# lambda = c p**m, its share of each stage by hand.
for m in 1.0 0.5; do
   cards watch <<DECK
METHOD = NEWTON;SPC = 1;WATCH = SET 7;SET 7 = 52, 54
SUBCASE 1;  LOAD = 10;SUBCASE 2;  LOAD = 20;  INCR = 5
BEGIN BULK;BLOCK2,1,1,1,1,0.0,0.0;+,8.0,5.0;+,5;PSHELL,1,1,2.0;MAT1,1,9500.0,,0.0;GRID,52,,0.0,15.0;GRID,54,,8.0,15.0
PMARK,5;JOINT,1,1,5;PJOINT,1,1;JNORM,1,8.0-3,$m
CELAS2,81,700.0,52,2,2,2;CELAS2,83,700.0,54,2,4,2;SPC1,1,1,1,2,3,4,52,54
FORCE,10,52,,6.0,0.0,-1.0;FORCE,10,54,,6.0,0.0,-1.0;FORCE,20,52,,9.0,0.0,-1.0;FORCE,20,54,,9.0,0.0,-1.0;JINCR,5,3;ENDDATA
DECK
   run watch || continue
   for stage in 1 2; do
      f=$(number "if($stage = 1, 12, 6)")
      joint=$(number "8e-3*(if($stage = 1, 12, 18)/16)^$m - if($stage = 1, 0, 8e-3*(12/16)^$m)")
      block=$(number "$f*5/(9500*16)") springs=$(number "$f/1400")
      all=$(number "$joint + $block + $springs")
      near "watched movement, m $m" "$(watched watch $stage 52 along)" "$all" 1e-10
      near "watched stiffness, m $m" "$(watched watch $stage 54 stiffness)" "$f/$all" 1e-10
      near "share of the joint, m $m" "$(share watch $stage JOINT 1)" "$joint/$all" 1e-10
      near "share of the block, m $m" "$(share watch $stage BODY 1)" "$block/$all" 1e-10
      near "work of the stage, m $m" "$(awk -F, -v s=$stage '$1 == s { w += $6 } END { printf "%.17g", w }' "$work/watch.watch.energy.csv")" \
           "0.5*$f*$all" 1e-10
      for id in 81 83; do near "share of a spring, m $m" "$(share watch $stage SPRING $id)" "0.5*$springs/$all" 1e-10; done
   done
   adds_up watch 2
done
says 'watched nodes in the listing' "$work/watch.out" '^    WATCHED '
says 'shares in the answer' "$work/watch.log" '^     JOINT  *1 '

# The node alone where the loads on the watched nodes cancel; all loads where none acts on them; no stiffness across the load.
cards pulled <<'DECK'
SPC = 1;SET 1 = 1, 2;SET 3 = 3;LOAD = 10;WATCH = SET 1, SET 3
BEGIN BULK;GRID,1,,0.0,0.0;GRID,2,,10.0,0.0;GRID,3,,10.0,10.0;GRID,4,,0.0,10.0;CQUAD4,1,1,1,2,3,4;PSHELL,1,1,2.0;MAT1,1,100.0,,0.0
CONROD,7,1,2,1,1,1.0;SPC1,1,2,1,2,3,4;SPC1,1,1,4;SPC1,1,1,3;FORCE,10,1,,5.0,-1.0,0.0;FORCE,10,2,,5.0,1.0,0.0;ENDDATA
DECK
sed -i 's/CONROD,7,1,2,1,1,1.0/CONROD,7,1,2,1,1.0/' "$work/pulled.bdf"
run pulled && {
   near 'loads that cancel: the node alone' "$(watched pulled 1 1 load_x)" -5 1e-12
   near '... and the other' "$(watched pulled 1 2 load_x)" 5 1e-12
   same '... and none at a third' "$(awk -F, '$2 == 3 { print $15 $16 $17 }' "$work/pulled.watch.csv")" ''
   adds_up pulled 1
}

# Moments are no part of the load: a cantilever of beams, 200 long, with the shear of its section, by hand. 100 at its middle and a moment at its end move the watched
# node at three quarters; a moment alone is no load. The same with the moment on the reference node of an RBE2.
ei=$(number '210000*20^4/12')
for case in 'both 100. FORCE,1,2,,100.,0.,0.,-1.' 'alone 0. $'; do
   set -- $case
   for tip in 'MOMENT,1,4,,1.E5,0.,1.,0.' 'GRID,9,,200.,0.,0.;RBE2,99,9,123456,4;MOMENT,1,9,,1.E5,0.,1.,0.'; do
      cards moment <<DECK
MODEL = SPACE;SPC = 1;LOAD = 1;SET 7 = 3;WATCH = SET 7
BEGIN BULK;GRID,1,,0.,0.,0.;GRID,2,,100.,0.,0.;GRID,3,,150.,0.,0.;GRID,4,,200.,0.,0.;CBAR,1,5,1,2,0.,1.,0.;CBAR,2,5,2,3,0.,1.,0.
CBAR,3,5,3,4,0.,1.,0.;PBARL,5,1,,BAR;+,20.,20.;MAT1,1,2.1E5,,0.3;SPC1,1,123456,1;$3;$tip;ENDDATA
DECK
      run moment || continue
      w=$(number "-$2*(100^2*(3*150 - 100)/(6*$ei) + 100/(5/6*400*210000/2.6)) - 1e5*150^2/(2*$ei)")
      near "a moment and a force, $1: movement" "$(watched moment 1 3 change_z)" "$w" 1e-9
      if [ "$1" = alone ]; then
         same 'a moment alone is no load' "$(awk -F, '$2 == 3 { print $15 $16 $17 }' "$work/moment.watch.csv")" ''
      else
         near 'a moment and a force: load' "$(watched moment 1 3 load)" 100 1e-12
         near 'a moment and a force: along it' "$(watched moment 1 3 along)" "-($w)" 1e-9
         near 'a moment and a force: stiffness' "$(watched moment 1 3 stiffness)" "-100/($w)" 1e-9
      fi
   done
done

# What is at work besides: bolts, friction, splits, spiders, gravity. Tightening rods does no outer work: no table.
for case in 'bolted_cantilever 1' 'solid_bolt 2' 'lap_joint 3' 'bracket_spiders 1' 'gib 2'; do
   set -- $case
   sed '0,/^ *SUBCASE/s//WATCH = SET 99\nSET 99 = ALL\n&/' "input/$1.bdf" > "$work/$1.bdf"
   run "$1" && adds_up "$1" "$2"
done

# Units looked at: a density or an E of another system is told, with what it should be; the right ones, in any system of units, are not. The
# waves of steel have 5172 m/s, those of E in GPa or of RHO in kg/mm3 a 32nd of that; wood, plastics, lead and beryllium are solids, rubber is
# warned of. E and rho, UNITS, what is said.
for case in '7850.0 2.1+5 7.850E-09' '7.85 2.1+5 7.850E-09 UNITS=MM,N' '7.85 2.1+5 7.850E-09' '7.85-6 2.1+5 7.850E-09 UNITS=MM,N' '2.7-6 7.0+4 2.700E-09 UNITS=MM,N' \
   '7.85-9 210.0 2.100E+05 UNITS=MM,N' '7850.0 2.1+5 2.100E+11 UNITS=M,N' '7.85 2.1+11 7.850E+03 UNITS=M,N' '7.85-9 2.1+5' '7.85-9 2.1+5 - UNITS=MM,N' \
   '7850.0 2.1+11' '7850.0 2.1+11 - UNITS=M,N' '8.0-10 21000.0' '8.0-10 21000.0 - UNITS=MM,KGF' '7.35-4 3.0+7' '7.35-4 3.0+7 - UNITS=IN,LBF' '7.85-6 210.0 - UNITS=MM,KN' \
   '1.13-8 1.6+4 - UNITS=MM,N' '1.85-9 2.87+5 - UNITS=MM,N' '5.0-10 300.0 - UNITS=MM,N' '1.4-9 3000.0 - UNITS=MM,N'; do
   set -- $case
   cards units <<DECK
${4:-TITLE = UNITS};SPC = 1;LOAD = 10
BEGIN BULK;BLOCK2,1,1,1,1,0.0,0.0;+,8.0,5.0;PSHELL,1,1,2.0;MAT1,1,$2,,0.0,$1;SPC1,1,12,1,3;FORCE,10,2,,1.0,0.0,1.0;ENDDATA
DECK
   run units
   if [ "${3:--}" != - ]; then says "units: $1 with $2" "$work/units.log" "There it would be $3"
   else same "units: $1 with $2" "$(grep -c 'wave speed' "$work/units.log")" 0; fi
done
cards units <<'DECK'
UNITS=MM,N;SPC = 1;LOAD = 10
BEGIN BULK;BLOCK2,1,1,1,1,0.0,0.0;+,8.0,5.0;PSHELL,1,1,2.0;MAT1,1,5.0,,0.0,1.1-9;SPC1,1,12,1,3;FORCE,10,2,,1.0,0.0,1.0;ENDDATA
DECK
run units && says 'rubber: its speed' "$work/units.log" 'wave speed sqrt(E/RHO) of 6.742E+01 m/s'
run units && says 'the listing has it' "$work/units.out" 'WARNING: MAT1 1: RHO ='

# E without RHO, where UNITS tells the unit of stress: GPa and Pa in a deck of mm, N/mm2 in one of m; a power of ten stands for a rigid body.
for case in '210.0 MM,N 1' '2.1+11 MM,N 1' '2.1+5 M,N 1' '21.4 MM,KGF 1' '2.1+5 MM,N 0' '1.0+10 MM,N 0' '1.0+12 MM,N 0' '2.14+4 MM,KGF 0' '2.1+11 M,N 0' '5.0 MM,N 0' '210.0 MM,KN 0' '210.0 , 0'; do
   set -- $case
   cards units <<DECK
UNITS=$2;SPC = 1;LOAD = 10
BEGIN BULK;BLOCK2,1,1,1,1,0.0,0.0;+,8.0,5.0;PSHELL,1,1,2.0;MAT1,1,$1,,0.0;SPC1,1,12,1,3;FORCE,10,2,,1.0-3,0.0,1.0;ENDDATA
DECK
   [ "$2" = , ] && sed -i '/^UNITS/d' "$work/units.bdf"
   run units
   same "E of $1 in $2" "$(grep -c 'MAT1 1: E =' "$work/units.log")" "$3"
done

# c p^m looked at, at 1 N/mm2 where UNITS tells the units, else at the first pressure against the joint: c of books in the deck as printed.
# 8E-3 mm/(kgf/mm2)^0.5 are 0.8 micrometres/(kgf/cm2)^0.5: 0.8*1E-3*(100)^0.5. C, UNITS, warnings, what C would be.
for case in '8.0-3 MM,KGF 0' '0.8 MM,KGF 1 8.000E-03' '1.0-3 MM,N 0' '1.0 MM,N 1 1.000E-03' '1.0-9 M,N 0' '1.0-3 M,N 1 1.000E-09' '1.0-3 , 0' '1.0 , 1'; do
   set -- $case
   cards units <<DECK
UNITS=$2;METHOD = NEWTON;SPC = 1;LOAD = 10
BEGIN BULK;BLOCK2,1,1,2,1,0.0,0.0;+,8.0,5.0;+,20;PMARK,20;PSHELL,1,1,2.0;MAT1,1,2.1+6,,0.0;SPC1,1,1,1;JOINT,1,1,20;PJOINT,1,1;JNORM,1,$1,0.5,1.0+15
FORCE,10,2,,2.0,0.0,-1.0;FORCE,10,4,,4.0,0.0,-1.0;FORCE,10,6,,2.0,0.0,-1.0;ENDDATA
DECK
   [ "$2" = , ] && sed -i '/^UNITS/d' "$work/units.bdf"
   [ "$2" = M,N ] && sed -i 's/2.1+6/2.1+11/' "$work/units.bdf"
   run units
   same "c of $1 in $2" "$(grep -c 'c p^m of its JNORM' "$work/units.log")" "$3"
   [ -z "${4:-}" ] || says "c of $1 in $2: what it would be" "$work/units.log" "C would be $4"
done

# Gravity and stress looked at likewise: 9.81 is none in mm, 98.1 is 10 g in m; a stress of 6.25 is E/33.6 of 210 and E/50.4 of 315.
for case in '9810.0 MM,N 0' '9.81 MM,N 1' '0.00981 MM,N 0' '9.81 M,N 0' '386.1 IN,LBF 0' '9.81 IN,LBF 1' '1.0 MM,N 0' '30.0 MM,N 1'; do
   set -- $case
   cards units <<DECK
UNITS=$2;SPC = 1;LOAD = 10
BEGIN BULK;BLOCK2,1,1,1,1,0.0,0.0;+,8.0,5.0;PSHELL,1,1,2.0;MAT1,1,2.1+5,,0.0;SPC1,1,12,1,3;CONM2,9,4,,1.0-3;GRAV,10,,$1,0.0,-1.0;ENDDATA
DECK
   run units
   same "gravity: $1 in $2" "$(grep -c 'is not gravity' "$work/units.log")" "$3"
done
# Without UNITS the waves tell the system: 9.81 beside steel in mm is not gravity, beside steel in m it is.
for case in '9810.0 2.1+5 7.85-9 0' '9.81 2.1+5 7.85-9 1' '9.81 2.1+11 7850.0 0' '9810.0 2.1+11 7850.0 1' '386.1 3.0+7 7.35-4 0'; do
   set -- $case
   cards units <<DECK
SPC = 1;LOAD = 10
BEGIN BULK;BLOCK2,1,1,1,1,0.0,0.0;+,8.0,5.0;PSHELL,1,1,2.0;MAT1,1,$2,,0.0,$3;SPC1,1,12,1,3;GRAV,10,,$1,0.0,-1.0;ENDDATA
DECK
   run units
   same "gravity: $1 with E $2" "$(grep -c 'is not gravity' "$work/units.log")" "$4"
done
for case in '210.0 1' '315.0 0'; do
   set -- $case
   cards units <<DECK
SPC = 1;LOAD = 10
BEGIN BULK;BLOCK2,1,1,1,1,0.0,0.0;+,8.0,5.0;PSHELL,1,1,2.0;MAT1,1,$1,,0.0;SPC1,1,2,1,3;SPC1,1,1,1;FORCE,10,2,,50.0,0.0,-1.0;FORCE,10,4,,50.0,0.0,-1.0;ENDDATA
DECK
   run units
   same "stress of E = $1" "$(grep -c 'of E, more than solids bear' "$work/units.log")" "$2"
   same "stress of E = $1: in the listing, counted" "$(grep -c '  WARNING: STAGE 1: THE LARGEST VON MISES' "$work/units.out") $(grep -c " $2 WARNING" "$work/units.out")" "$2 1"
done

# Between two nodes: 9001 on rods along x and y (k = 1000, 2000), 9002 at (30, 40) from it on others (4000, 8000), pulled apart along their line
# by 10: along x and y two springs in series, along the line the sum of both by the squares of its direction. CD turns the axes of 9001.
between_deck() { # NAME CASE [CD] [X2 Y2]
   printf '%b\n' "MODEL = PLANE\nSPC = 1\nLOAD = 20\n$2\nBEGIN BULK" "CORD2R,5,,0.0,0.0,0.0,0.0,0.0,1.0\n+,3.0,4.0,0.0\nGRID,9001,,0.0,0.0,0.0,${3:-}\nGRID,9002,,${4:-30.0},${5:-40.0}" \
      "GRID,11,,-100.0,0.0\nGRID,12,,0.0,-100.0\nGRID,21,,$(number "${4:-30.0} + 100").0,${5:-40.0}\nGRID,22,,${4:-30.0},$(number "${5:-40.0} + 100").0" \
      'CROD,1,1,11,9001\nCROD,2,2,12,9001\nCROD,3,3,21,9002\nCROD,4,4,22,9002\nPROD,1,1,100.0\nPROD,2,1,200.0\nPROD,3,1,400.0\nPROD,4,1,800.0\nMAT1,1,1000.0,,,,,,0.05' \
      'CONM2,31,9001,,0.02\nCONM2,32,9002,,0.03\nSPC1,1,12,11,12,21,22\nFORCE,20,9002,,10.0,0.6,0.8\nFORCE,20,9001,,10.0,-0.6,-0.8\nEIGRL,6,,,4\nFREQ1,7,1.0,1.0,120\nENDDATA' > "$work/$1.bdf"
   run "$1"
}
between() { awk -F, -v along="$2" -v c="$3" 'NR == 1 { for (k = 1; k <= NF; k++) at[$k] = k } $4 == along { print $at[c] }' "$work/$1.between.csv"; }
between_x='(1/1000 + 1/4000)' between_y='(1/2000 + 1/8000)'
between_line="(0.36*$between_x + 0.64*$between_y)"
between_deck between_static 'WATCH = 9001 - 9002' && {
   near 'between two nodes: movement along their line' "$(between between_static LINE movement)" "10*$between_line" 1e-10
   near '... stiffness' "$(between between_static LINE stiffness)" "1/$between_line" 1e-10
   near '... along x' "$(between between_static X stiffness)" "1/$between_x" 1e-10
   near '... along y' "$(between between_static Y stiffness)" "1/$between_y" 1e-10
   near '... the force along y' "$(between between_static Y load)" 8 1e-12
   near '... share of a rod' "$(share between_static 1 BAR 1)" "0.36/1000/$between_line" 1e-10
   adds_up between_static 1
   says '... on the screen' "$work/between_static.log" '^    BETWEEN  *AND  *ALONG'
   same '... no rows of single nodes' "$(awk 'NR > 1' "$work/between_static.watch.csv" | wc -l)" 0
}
between_deck between_cd 'WATCH = 9001-9002, SET 3\nSET 3 = 9002' 5 && {
   near 'between two nodes: x of CD along their line' "$(between between_cd X stiffness)" "1/$between_line" 1e-10
   near '... y of CD across it' "$(between between_cd Y movement)" "10*0.48*($between_y - $between_x)" 1e-10
   same '... no force across it' "$(between between_cd Y load)" ''
   near '... beside a single node' "$(watched between_cd 1 9002 u_x)" '10*0.6/4000' 1e-10
}
between_deck between_one 'WATCH = 9001-9002' '' 0.0 0.0 && {
   same 'two nodes at one place: no line' "$(between between_one LINE movement)" ''
   near '... along x' "$(between between_one X stiffness)" "1/$between_x" 1e-10
}
# across the line, and across it with 1/200 along it, which gives no stiffness along it; the table of cases has the movement along the force
sed -e 's/^WATCH.*/&\nSUBCASE 1\nSUBCASE 2\nLOAD = 30\nFROM = 1\nSUBCASE 3\nLOAD = 31\nFROM = 1/' \
    -e 's/^ENDDATA/LOAD,30,1.0,1.0,20,1.0,21\nLOAD,31,1.0,1.0,20,1.0,22\nFORCE,21,9002,,10.0,-0.8,0.6\nFORCE,21,9001,,10.0,0.8,-0.6\nFORCE,22,9002,,1.0,-7.97,6.04\nFORCE,22,9001,,1.0,7.97,-6.04\n&/' \
    "$work/between_static.bdf" > "$work/between_cases.bdf"
case_of() { awk -F, -v s="$1" -v c="$2" 'NR == 1 { for (k = 1; k <= NF; k++) at[$k] = k } $1 ~ /CASE/ && $2 == s { print $at[c] }' "$work/between_cases.cases.csv"; }
run between_cases && {
   same 'a force across the line: no stiffness along it' "$(awk -F, '$1 == 3 && $4 == "LINE" { print "row" $7 $8 }' "$work/between_cases.between.csv")" row
   near 'cases: movement along the force between two nodes' "$(case_of 2 along)" "10*(0.64*$between_x + 0.36*$between_y)" 1e-9
   near '... stiffness' "$(case_of 2 stiffness)" "1/(0.64*$between_x + 0.36*$between_y)" 1e-9
}
sed 's/^FORCE,20,9001.*//' "$work/between_static.bdf" > "$work/between_load.bdf"
run between_load && near 'a force on one node alone' "$(between between_load X stiffness)" 4000 1e-10
"$program" -q -o "$work" --summary "$work/between.csv" "$work/between_static.bdf" > "$work/between.log" 2>&1
near 'between two nodes: the summary' "$(awk -F, 'NR == 1 { for (k = 1; k <= NF; k++) at[$k] = k } NR == 2 { print $at["stiffness"] }' "$work/between.csv")" "1/$between_line" 1e-10

# ... in modes and in a response: G = 1/(k1 (1 + i eta) - m1 w^2) + 1/(k2 (1 + i eta) - m2 w^2) along each axis
between_deck between_modes 'WATCH = 9001-9002\nSET 3 = 9002\nMODES = 6\nFREQUENCY = 7\nDLOAD = 20\nRESPONSE = SET 3' && {
   near 'compliance of a mode between two nodes' "$(awk -F, '$6 == "LINE" && $2 == 1 { print $8 }' "$work/between_modes.between.modes.csv")" '0.36/1000' 1e-9
   near '... of all modes together' "$(awk -F, '$6 == "LINE" { s += $8 } END { printf "%.17g", s }' "$work/between_modes.between.modes.csv")" "$between_line" 1e-9
   judge 'compliance between two nodes over the frequency' -F, -v pi=$pi 'function add(k, m, w,   a, b) { a = k - m*w^2; b = 0.05*k; re += a/(a^2 + b^2); im -= b/(a^2 + b^2) }
      function far(a, b) { return (a - b)^2 > 1e-18*(re^2 + im^2) }
      $5 == "X" { re = im = 0; w = 2*pi*$2; add(1000, 0.02, w); add(4000, 0.03, w); n++; if (far($8, re) || far($9, im) || far($6/6, sqrt(re^2 + im^2))) print $0 ": " re " " im }
      END { print "checked " n }' "$work/between_modes.between.response.csv"
   near 'the least real part' "$(table between_modes 'RESPONSE BETWEEN' | awk '$3 == "X" { print $7 }')" \
        "$(awk -F, '$5 == "X" && $8 < least { least = $8 } END { printf "%.17g", least }' "$work/between_modes.between.response.csv")" 1e-5
   near 'the largest compliance' "$(table between_modes 'RESPONSE BETWEEN' | awk '$3 == "X" { print $6 }')" \
        "$(awk -F, '$5 == "X" && $6/6 > most { most = $6/6 } END { printf "%.17g", most }' "$work/between_modes.between.response.csv")" 1e-5
}

sed 's/^ENDDATA/CELAS2,99,0.0,9001,1\n&/' "$work/between_modes.bdf" > "$work/between_none.bdf"
run between_none && {
   near 'modes: a spring of no stiffness changes no frequency' "$(mode between_none 1 frequency)" "$(mode between_modes 1 frequency)" 1e-12
   same '... and no energy' "$(grep -c 'NaN' "$work/between_none.modes.energy.csv")" 0
}

# --watch n-m is WATCH = n-m, beside single nodes or alone; nodes of NODEAT, in the deck and on the command line, are those that they stand for.
# The summary has every node and pair of the last stage with WATCH, and the frequencies.
watch_also() { # NAME LIST: between_modes without its WATCH; the numbers of NODEAT are 7001, 7002, and 7003 in the place of 7001
   sed '/^WATCH/d; s/^ENDDATA/NODEAT,7001,0.0,0.0\nNODEAT,7002,30.0,40.0\nENDDATA/' "$work/between_modes.bdf" > "$work/$1.bdf"
   [ "$2" = deck ] && sed -i 's/^MODEL/WATCH = 7001-7002\n&/' "$work/$1.bdf"
   "$program" -q -o "$work" --summary "$work/$1.csv" $([ "$2" = deck ] || echo --watch "$2") "$work/$1.bdf" > "$work/$1.log" 2>&1
   same "--watch $2" "$?" 0
}
watch_summary() { sed 's/"[^"]*"/text/g' "$work/$1.csv" | awk -F, -v c="$2" 'NR == 1 { for (k = 1; k <= NF; k++) at[$k] = k } NR == 2 && c in at { print $at[c] }'; }
watch_also watch_pair 9001-9002
watch_also watch_both 9001-9002,9002,9002-9001
watch_also watch_at 7001-7002
watch_also watch_deck deck
for watch_file in between.csv between.modes.csv between.response.csv watch.energy.csv; do
   same "--watch n-m: $watch_file as with WATCH" "$(cmp "$work/watch_pair.$watch_file" "$work/between_modes.$watch_file" 2>&1)" ''
   same "... with nodes of NODEAT" "$(sed 's/,700\([12]\),700\([12]\),/,900\1,900\2,/' "$work/watch_at.$watch_file" | cmp - "$work/between_modes.$watch_file" 2>&1)" ''
   same "... in the deck" "$(cmp "$work/watch_at.$watch_file" "$work/watch_deck.$watch_file" 2>&1)" ''
done
near 'summary: the pair' "$(watch_summary watch_both along_9001-9002)" "10*$between_line" 1e-10
near '... its stiffness' "$(watch_summary watch_both stiffness_9002-9001)" "1/$between_line" 1e-10
near '... the node, by its number of NODEAT' "$(watch_summary watch_both stiffness_7002)" "1/(0.36/4000 + 0.64/8000)" 1e-10
near '... which is the first' "$(watch_summary watch_both stiffness)" "1/(0.36/4000 + 0.64/8000)" 1e-10
near '... points of NODEAT' "$(watch_summary watch_at stiffness_7001-7002)" "1/$between_line" 1e-10
near '... the second frequency' "$(watch_summary watch_at frequency_2)" "sqrt(2000/0.02)/(2*$pi)" 1e-9
near '... the fourth' "$(watch_summary watch_at frequency_4)" "sqrt(8000/0.03)/(2*$pi)" 1e-9
same '... and no fifth' "$(watch_summary watch_at frequency_5)" ''
# ---- the default E_u: E of the body per unit length, a bar of 10 on it: the line has 1/11 of the movement. With the slope of loading, E/36, the
# joint would move by 36 for 1 beside the 10 of the bar: 35/11 more. Unloading, reloading below A, past A, off to zero
slope_deck() { # NAME METHOD [EU]
   cards "$1" <<DECK
METHOD = $2;SPC = 1;WATCH = SET 4;SET 4 = 4;INCR = 5;SUBCASE 1;LOAD = 1;SUBCASE 2;LOAD = 2;SUBCASE 3;LOAD = 3;SUBCASE 4;LOAD = 4;SUBCASE 5
BEGIN BULK;BLOCK2,1,1,2,1,0.0,0.0;+,20.0,10.0;+,20,,30;PSHELL,1,1,5.0;MAT1,1,9000.,,0.0;JOINT,1,1,20;PJOINT,1,1;JNORM,1,4.-3,1.0,${3:-}
SPC1,1,1,1;PMARK,20;PMARK,30;JINCR,5,2
PLOADM,1,4.0,30;PLOADM,2,1.0,30;PLOADM,3,2.0,30;PLOADM,4,6.0,30;ENDDATA
DECK
}
slope_moved() { awk -F, -v s="$2" '$1 == s { print $10 }' "$work/$1.watch.csv"; }
slope_deck slope_default NEWTON
slope_deck slope_given NEWTON 250.0
run slope_default && run slope_given && {
   same 'default E_u: stages' "$(sed -n 's/ *WARNING: STAGE \(.\): ELEMENTS UNLOADED ON THE DEFAULT E_U, MOST IN JOINT 1: 9.1 % OF THE MOVEMENT;$/\1/p' "$work/slope_default.out" | paste -sd' ')" '2 3 5'
   same 'default E_u: with the slope of loading' "$(grep -c '^ *UP TO 318.2 % MORE' "$work/slope_default.out")" 3
   near 'default E_u: what the slope of loading gives' "$(slope_moved slope_given 2)" "$(slope_moved slope_default 2)*(1 + 35/11)" 1e-9
   same 'E_u given: no warning' "$(grep -c 'ON THE DEFAULT E_U' "$work/slope_given.out")" 0
}
slope_deck slope_step STEP # follows its tangents, the first of which is that of loading
run slope_step && says 'default E_u: STEP' "$work/slope_step.out" 'WARNING: STAGE 3: ELEMENTS UNLOADED ON THE DEFAULT E_U, MOST IN JOINT 1'
