# Scalar points, springs and masses alone, without bodies, against closed forms.
# ---- A chain of n springs k and masses m, held at one end: omega = 2 sqrt(k/m) sin((2j - 1) pi/(4n + 2)); the last mass pulled by F
# moves by n F/k. On scalar points (CELAS4, CMASS4; CELAS3, CMASS3 with PELAS, PMASS) and along components of nodes in space, whose
# other components nothing holds (CELAS2, CONM2)
scalar_chain() { # NAME KIND N
   awk -v kind="$2" -v n="$3" 'BEGIN {
      print "METHOD = NEWTON;SPC = 1;SUBCASE 1;  LOAD = 10;  MODES = 5;  OUTPUT = ALL;BEGIN BULK;EIGRL,5,,," n
      if (kind == "grid") print "MODEL = SPACE"
      if (kind == 3) print "SPOINT,101,THRU," 100 + n ";PELAS,7,400.0;PMASS,8,3.0,9,0.04"
      for (i = 1; i <= n; i++) {
         before = i > 1 ? 100 + i - 1 : ""
         if (kind == 4) print "CELAS4," i ",400.0," (i > 1 ? before : 0) "," 100 + i ";CMASS4," 50 + i ",0.04," 100 + i
         if (kind == 3) print "CELAS3," i ",7," 100 + i "," before ";CMASS3," 50 + i ",9,," 100 + i
         if (kind == "grid") print "GRID," 100 + i ",," i ".0,1.0,2.0;CELAS2," i ",400.0," 100 + i ",2," before "," (i > 1 ? 2 : "") ";CONM2," 50 + i "," 100 + i ",,0.04"
      }
      print kind == "grid" ? "FORCE,10," 100 + n ",,8.0,0.0,1.0" : "SLOAD,10," 100 + n ",8.0"
      print "GRID,1,,0.0,0.0,0.0;SPC1,1,123456,1;CELAS2,99,1.0,1,1;ENDDATA"
   }' | awk -v RS=';|\n' '$0 == "MODEL = SPACE" { space = 1; next } { line[++k] = $0 } END { if (space) print "MODEL = SPACE"; for (i = 1; i <= k; i++) print line[i] }' > "$work/$1.bdf"
   run "$1"
}
for kind in 4 3 grid; do
   scalar_chain scalar_chain $kind 5 && {
      for j in 1 2 3 4 5; do near "scalar chain, $kind, mode $j" "$(mode scalar_chain $j omega)" "2*sqrt(400/0.04)*sin((2*$j-1)*$pi/22)" 1e-9; done
      component=1; [ $kind = grid ] && component=2
      near "scalar chain, $kind: last mass" "$(moved scalar_chain 105 $component)" 5*8/400 2e-6
   }
done
says 'scalar chain: held components are named' "$work/scalar_chain.log" '10 components of nodes without stiffness are held (PARAM AUTOSPC), with no load on them; node: components: 101: 1 3; 102: 1 3;'

# ---- A mass that resists the difference of two components: two masses 3 and 5 on springs 700 and 400 to the ground, 2 between them:
# [m] = [3 + 2, -2; -2, 5 + 2]. As scalar points; along two components of one node; as CMASS1 between components 1 and 2 of two nodes
scalar_pair() { cards scalar_pair && run scalar_pair && for j in 1 2; do
   near "mass between two components, $1, mode $j" "$(mode scalar_pair $j omega)^2" \
      "(700*7+400*5 $([ $j = 1 ] && echo - || echo +) sqrt((700*7+400*5)^2 - 4*31*700*400))/(2*31)" 1e-9; done; }
scalar_pair 'scalar points' <<'DECK'
SUBCASE 1;  MODES = 5;BEGIN BULK;EIGRL,5,,,2;CELAS4,1,700.0,11;CELAS4,2,400.0,0,12;CMASS4,3,3.0,11;CMASS4,4,5.0,12;CMASS4,5,2.0,11,12;ENDDATA
DECK
scalar_pair 'one node' <<'DECK'
MODEL = SPACE;SPC = 1;SUBCASE 1;  MODES = 5;BEGIN BULK;EIGRL,5,,,2;GRID,1,,1.0,2.0,3.0;CELAS2,1,700.0,1,1;CELAS2,2,400.0,1,3;SPC1,1,2,1
CMASS2,3,3.0,1,1;CMASS2,4,5.0,,,1,3;CMASS2,5,2.0,1,1,1,3;ENDDATA
DECK
scalar_pair 'two nodes' <<'DECK'
MODEL = SPACE;SPC = 1;SUBCASE 1;  MODES = 5;BEGIN BULK;EIGRL,5,,,2;GRID,1,,1.0,2.0,3.0;GRID,2,,4.0,0.0,0.0;CELAS2,1,700.0,1,1;CELAS2,2,400.0,2,5
SPC1,1,23,1;CMASS2,3,3.0,1,1;CMASS2,4,5.0,2,5;CMASS1,5,7,1,1,2,5;PMASS,6,9.0,7,2.0;ENDDATA
DECK
scalar_pair 'a displacement and a rotation in the plane' <<'DECK'
MODEL = PLANE;SPC = 1;SUBCASE 1;  MODES = 5;BEGIN BULK;EIGRL,5,,,2;GRID,1,,1.0,2.0;GRID,2,,4.0,0.0;CELAS2,1,700.0,1,1;CELAS2,2,400.0,2,6
SPC1,1,2,1;SPC1,1,12,2;CMASS2,3,3.0,1,1;CMASS2,4,5.0,2,6;CMASS2,5,2.0,1,1,2,6;ENDDATA
DECK
scalar_pair 'CONM1 in the plane' <<'DECK'
MODEL = PLANE;SUBCASE 1;  MODES = 5;BEGIN BULK;EIGRL,5,,,2;GRID,1,,1.0,2.0;CELAS2,1,700.0,1,1;CELAS2,2,400.0,1,2;CONM1,3,1,,5.0,-2.0,7.0;ENDDATA
DECK
scalar_pair 'CONM1 with a rotation in the plane' <<'DECK'
MODEL = PLANE;SPC = 1;SUBCASE 1;  MODES = 5;BEGIN BULK;EIGRL,5,,,2;GRID,1,,1.0,2.0;CELAS2,1,700.0,1,1;CELAS2,2,400.0,1,6;SPC1,1,2,1
CONM1,3,1,,5.0,0.0,1.0;+;+,,,-2.0,0.0,0.0,0.0,0.0,7.0;ENDDATA
DECK
# two masses 0.02 and 0.05 that float, 6000 between them
cards scalar_free <<'DECK'
MODEL = PLANE;SPC = 1;SUBCASE 1;  MODES(FREE) = 5;BEGIN BULK;EIGRL,5,,,2;GRID,1,,0.0,0.0;GRID,2,,10.0,0.0;SPC1,1,2,1,2;SUPORT,1,1
CELAS2,1,6000.0,1,1,2,1;CONM1,3,1,,0.02,0.0,0.02;CONM1,4,2,,0.05,0.0,0.05;ENDDATA
DECK
run scalar_free && near 'CONM1 on nodes that float' "$(mode scalar_free 2 omega)^2" '6000*(1/0.02 + 1/0.05)' 1e-9

# ---- CONM1 with the matrix of a body, mass 0.3 at (0.4, -0.2, 0.5) from the node, is CONM2 with this offset and inertia, in system 4:
# the same six frequencies of the body on a CBUSH
scalar_body() { cards "$1" <<DECK
MODEL = SPACE;SPC = 1;SUBCASE 1;  MODES = 5;BEGIN BULK;EIGRL,5,,,6;GRID,1,,1.0,2.0,3.0;GRID,2,,4.0,0.0,1.0;SPC1,1,123456,1
CORD2R,4,,0.0,0.0,0.0,0.0,1.0,1.0;+,2.0,0.0,1.0;CBUSH,1,7,1,2,0.0,0.0,1.0;PBUSH,7,K,500.0,300.0,200.0,4000.0,2500.0,1500.0
$2;ENDDATA
DECK
   run "$1"; }
# m = 0.3; c = (0.4, -0.2, 0.5); I about the centre 0.05, 0.06, 0.07 with I21 0.01; about the node: I + m (c^2 1 - c c^T)
scalar_body conm2_body 'CONM2,9,2,4,0.3,0.4,-0.2,0.5;+,0.05,0.01,0.06,0.0,0.0,0.07' && \
scalar_body conm1_body 'CONM1,9,2,4,0.3,0.0,0.3,0.0,0.0;+,0.3,0.0,-0.15,-0.06,0.137,0.15,0.0,-0.12;+,0.014,0.183,0.06,0.12,0.0,-0.06,0.03,0.13' && \
for j in 1 2 3 4 5 6; do near "CONM1 as CONM2, mode $j" "$(mode conm1_body $j omega)" "$(mode conm2_body $j omega)" 1e-9; done

# ---- M of a PBUSH: half of it at each end. GE: the loss factor of a mode is the mean of GE by strain energy: K1 500 with 0.02 along x,
# K2 500 with 0.06 along y; one GE of all PBUSH holds for all components
bush_losses() { cards bush_losses <<DECK
MODEL = SPACE;SPC = 1;SUBCASE 1;  MODES = 5;BEGIN BULK;EIGRL,5,,,2;GRID,1,,1.0,2.0,3.0;GRID,2,,1.0,2.0,3.0;SPC1,1,123456,1;SPC1,1,3456,2
CBUSH,1,7,1,2,,,,0;PBUSH,7,K,500.0,600.0,,1.0;+,,GE,$1;+,,RCV,1.0;+,,M,0.4;CONM2,2,2,,0.1;ENDDATA
DECK
   run bush_losses; }
bush_losses 0.02,0.06 && for j in 1 2; do
   near "mass of a bush, mode $j" "$(mode bush_losses $j omega)^2" "(400+100*$j)/0.3" 1e-9
   near "GE of a bush, mode $j" "$(mode bush_losses $j loss_factor)" "0.04*$j-0.02" 1e-9
done
bush_losses 0.03 && for j in 1 2; do near "one GE of a bush, mode $j" "$(mode bush_losses $j loss_factor)" 0.03 1e-9; done

# ---- Gravity acts on the masses of nodes, not on scalar points: CONM1, CMASS between two nodes, M of a PBUSH
cards scalar_weight <<'DECK'
MODEL = SPACE;SPC = 1;SUBCASE 1;  LOAD = 10;  OUTPUT = ALL;BEGIN BULK;GRID,1,,1.0,2.0,3.0;GRID,2,,1.0,2.0,3.0;SPC1,1,123456,1
CBUSH,1,7,1,2,,,,0;PBUSH,7,K,500.0,600.0,700.0,1.0,1.0,1.0;+,,M,0.4;CONM1,3,2,,0.3,,0.3,,;+,0.3;CMASS2,5,9.0,1,3,2,3;GRAV,10,,10.0,0.0,0.0,-1.0
CELAS4,11,50.0,5;CMASS4,12,7.0,5;ENDDATA
DECK
run scalar_weight && near 'weight on a bush' "$(moved scalar_weight 2 3)" '-10*(0.2+0.3)/700' 2e-6

# ---- CTUBE: A and J of a tube and of a solid rod; the tapered tube as a hundred pieces in a row
scalar_tube() { # NAME PTUBE A J
   cards "$1" <<DECK
MODEL = SPACE;SPC = 1;SUBCASE 1;  LOAD = 10;  OUTPUT = ALL;BEGIN BULK;MAT1,1,2.0+5,,0.25;GRID,1,,0.0,0.0,0.0;GRID,2,,0.0,50.0,0.0;SPC1,1,123456,1
CTUBE,1,5,1,2;PTUBE,5,1,$2;FORCE,10,2,,900.0,0.0,1.0;MOMENT,10,2,,700.0,0.0,1.0;ENDDATA
DECK
   run "$1" && near "$1: stretch" "$(moved "$1" 2 2)" "900*50/(2e5*$3)" 2e-6 && near "$1: twist" \
      "$(table "$1" 'ROTATIONS OF REFERENCE NODES' | awk '$1 == 2 { v = $(NF - 1) } END { print v }')" "700*50/(0.8e5*($4))" 6e-6
}
scalar_tube tube 30.0,2.5 "$pi/4*(30^2-25^2)" "$pi/32*(30^4-25^4)"
scalar_tube solid_rod 30.0 "$pi/4*30^2" "$pi/32*30^4"
tapered=$(awk -v pi="$pi" 'BEGIN { n = 1e5; for (i = 1; i <= n; i++) { d = 30 - 10*(i - 0.5)/n; s += 1/(pi/4*(d*d - (d - 5)^2))/n } printf "%.12g", 1/s }')
wall_diameter=$(awk 'BEGIN { printf "%.15g", 10/log(27.5/17.5) }')
scalar_tube tapered_tube 30.0,2.5,,20.0 "$tapered" "$pi*2.5*$wall_diameter*($wall_diameter^2+2.5^2)/4"

# ---- Blank components of scalar points, a point given twice: a chain of springs with a link between its halves, its end moved ----
cards scalar_blank <<'DECK'
SPC = 1;MPC = 3;BEGIN BULK;SPOINT,1,THRU,4;SPOINT,2;CELAS4,1,1000.0,1,2;CELAS4,2,500.0,3,4;SPC1,1,,4;SPC,1,1,,0.03;MPC,3,2,,1.0,3,,-1.0;ENDDATA
DECK
run scalar_blank && near 'blank components of scalar points' "$(moved scalar_blank 2 1)" '0.03*1000/1500' 2e-6

# ---- Dependent components that are terms of other equations: u1 = 2 u2, u2 = -u3, u3 = 0.5 u4, in another order ----
cards scalar_chain <<'DECK'
MPC = 3;LOAD = 10;BEGIN BULK;SPOINT,1,THRU,4;CELAS4,1,1000.0,1;CELAS4,2,500.0,4;MPC,3,3,0,2.0,4,0,-1.0;MPC,3,1,0,-1.0,2,0,2.0;MPC,3,2,0,1.0,3,0,1.0
SLOAD,10,1,30.0;ENDDATA
DECK
run scalar_chain && for k in 1 2 3 4; do
   near "a chain of MPC: point $k" "$(moved scalar_chain $k 1)" "$(awk -v k=$k 'BEGIN { split("0.02 0.01 -0.01 -0.02", u, " "); print u[k] }')" 2e-6
done
# The same of rigid elements, of a body on two nodes: RBE2 51 moves the independent node of RBE2 50
link=1
for chain in 'RBE2,50,9,123456,3\nRBAR,51,10,9,123456,,,123456' 'RBE2,50,10,123456,3,9'; do
   printf '%b\n' 'MODEL = SPACE\nSPC = 1\nLOAD = 10\nBEGIN BULK\nGRID,1,,0.0,0.0,0.0\nGRID,2,,10.0,0.0,0.0\nGRID,3,,10.0,10.0,0.0\nGRID,4,,0.0,10.0,0.0' \
      'GRID,9,,15.0,12.0,3.0\nGRID,10,,20.0,15.0,5.0\nCQUAD4,1,1,1,2,3,4\nPSHELL,1,1,2.0,1,,1\nMAT1,1,9500.0,,0.3\nSPC1,1,123456,1,2\nFORCE,10,10,,3.0,1.0,-2.0,4.0' \
      "$chain\nENDDATA" > "$work/rigid_$link.bdf"
   run "rigid_$link"
   link=2
done
for c in 1 2 3; do near "a chain of rigid elements, $c" "$(moved rigid_1 10 $c)" "$(moved rigid_2 10 $c)" 2e-6; done

# ---- A node on the axis of its cylindrical system has the axes of that system, turned by 30 degrees: springs along them. A held node
# of no element takes its loads ----
cards on_axis <<'DECK'
MODEL = SPACE;SPC = 1;LOAD = 2;BEGIN BULK;CORD2C,7,,0.0,0.0,0.0,0.0,0.0,1.0;+,0.8660254037844386,0.5,0.0;GRID,1,,0.0,0.0,5.0,7;GRID,9,,1.0,0.0,0.0
CELAS2,1,100.0,1,1;CELAS2,2,200.0,1,2;CELAS2,3,300.0,1,3;FORCE,2,1,,1.0,1.0,0.0,0.0;SPC1,1,123456,9;FORCE,2,9,,5.0,1.0,0.0,0.0
MOMENT,2,9,,5.0,1.0,0.0,0.0;ENDDATA
DECK
run on_axis && near 'on the axis of a cylindrical system' "$(moved on_axis 1 1)" '0.75/100 + 0.25/200' 2e-6 &&
   says 'on the axis: said' "$work/on_axis.log" 'a node lies on the axis of system 7' &&
   says 'loads of a held node: said' "$work/on_axis.log" 'node 9 belongs to no element and is held: its loads have no effect'

# masses one above the other on springs along x, supports that leave rotations, a load and METHOD = set: the springs bear the load, no support is added
cards shear_building <<'DECK'
METHOD = NEWTON;MODEL = SPACE;SUBCASE 1;  SPC = 1;  LOAD = 2;  METHOD = 4;BEGIN BULK;GRID,1,,0.,0.,0.;GRID,2,,0.,0.,3.;GRID,3,,0.,0.,6.;CELAS2,1,100.,1,1,2,1;CELAS2,2,100.,2,1,3,1
CONM2,11,2,,1.;CONM2,12,3,,1.;SPC1,1,123456,1;SPC1,1,23456,2,3;FORCE,2,3,,50.,1.,0.,0.;EIGRL,4,,,2;ENDDATA
DECK
run shear_building && near 'springs and masses with supports, METHOD and LOAD: the top' "$(moved shear_building 3 1)" '2*50/100' 3e-6
