# Beams, shells and joints on their faces and edges against closed forms.

# beam_force NAME ELEMENT END K: of the forces in beams, at its first or second end, the K-th; rotation NAME NODE C
beam_force() { table "$1" 'FORCES IN BEAMS' | awk -v e="$2" -v end="$3" -v k="$4" '$1 == e && ++n == end { v = $(2 + k) } END { print v }'; }
beam_stress() { table "$1" 'STRESSES IN BEAMS' | awk -v e="$2" -v end="$3" -v k="$4" '$1 == e && ++n == end { v = $(2 + k) } END { print v }'; }
rotation() { table "$1" 'ROTATIONS OF REFERENCE NODES' | awk -v node="$2" -v c="$3" '$1 == node { v = $(1 + c) } END { print v }'; }

# ---- a cantilever in the plane and in space, with shear: P L^3/(3 E I) + P L/(K A G) ----

bar='PBARL,1,1,,BAR;+,20.0,40.0;MAT1,1,210000.0,,0.3,7.85-9'
i1='20*40^3/12' i2='40*20^3/12' shear='5/6*800*210000/2.6'
for model in PLANE SPACE; do
   cards cantilever_beam <<DECK
MODEL = $model;SPC = 1;SUBCASE 1;  LOAD = 1;BEGIN BULK;GRID,1,,0.0,0.0,0.0;GRID,2,,300.0,0.0,0.0;GRID,3,,1000.0,0.0,0.0
CBAR,1,1,1,2,0.0,1.0,0.0;CBAR,2,1,2,3,0.0,1.0,0.0;$bar;SPC1,1,123456,1;FORCE,1,3,,1000.0,0.0,1.0,0.0;ENDDATA
DECK
   run cantilever_beam && {
      near "$model: tip of a beam" "$(moved cantilever_beam 3 2)" "1000*1000^3/(3*210000*$i1) + 1000*1000/($shear)" 3e-6
      near "$model: its rotation" "$(rotation cantilever_beam 3 $([ $model = PLANE ] && echo 1 || echo 3))" "1000*1000^2/(2*210000*$i1)" 3e-6
      near "$model: moment at the support" "$(beam_force cantilever_beam 1 1 6)" 1e6 3e-6
      near "$model: stress above" "$(beam_stress cantilever_beam 1 1 1)" "-1e6*20/($i1)" 3e-6
   }
done

# ---- loads along a beam held at both ends: q L^4/(384 E I) + q L^2/(8 K A G) at its middle, q L^2/12 at its ends ----

cards clamped_beam <<DECK
MODEL = SPACE;SPC = 1;SUBCASE 1;  LOAD = 1;BEGIN BULK;GRID,1,,0.0,0.0,0.0;GRID,2,,500.0,0.0,0.0;GRID,3,,1000.0,0.0,0.0
CBAR,1,1,1,2,0.0,0.0,1.0;CBEAM,2,1,2,3,0.0,0.0,1.0;$bar;SPC1,1,123456,1,3;PLOAD1,1,1,FZ,FR,0.0,-2.0,1.0,-2.0
PLOAD1,1,2,FYE,LE,0.0,-2.0,500.0,-2.0;ENDDATA
DECK
run clamped_beam && {
   near 'held at both ends: middle' "$(moved clamped_beam 2 3)" "-2*1000^4/(384*210000*$i1) - 2*1000^2/(8*($shear))" 3e-6
   near 'held at both ends: moment' "$(beam_force clamped_beam 1 1 6)" '-2*1000^2/12' 3e-6
   near 'held at both ends: moment in the middle' "$(beam_force clamped_beam 1 2 6)" '2*1000^2/24' 3e-6
}

# ---- a pin, a hinge with a spring, a rigid bar, an offset ----

# A pinned at node 2 by PB: the right beam carries nothing of the moment; the tip force of a propped cantilever is 5/16 of a load in the middle
cards propped <<DECK
MODEL = SPACE;SPC = 1;SUBCASE 1;  LOAD = 1;BEGIN BULK;GRID,1,,0.0,0.0,0.0;GRID,2,,500.0,0.0,0.0;GRID,3,,1000.0,0.0,0.0
CBAR,1,1,1,2,0.0,1.0,0.0;CBAR,2,1,2,3,0.0,1.0,0.0;+,,56;PBAR,1,1,800.0,1.0+5,1.0+5,1.5+5;MAT1,1,210000.0,,0.3;SPC1,1,123456,1,3
FORCE,1,2,,1000.0,0.0,1.0,0.0;ENDDATA
DECK
run propped && {
   near 'pinned end: no moment' "$(beam_force propped 2 2 6)" 0 0 1e-6
   near 'pinned end: force' "$(beam_force propped 2 2 2)" '-1000*5/16' 3e-6
}
# two beams in line with a rotational spring between them: the tip turns by M L/(E I) twice and M/k
cards hinge <<DECK
MODEL = SPACE;SPC = 1;SUBCASE 1;  LOAD = 1;BEGIN BULK;GRID,1,,0.0,0.0,0.0;GRID,2,,500.0,0.0,0.0;GRID,12,,500.0,0.0,0.0;GRID,3,,1000.0,0.0,0.0
CBAR,1,1,1,2,0.0,1.0,0.0;CBAR,2,1,12,3,0.0,1.0,0.0;PBAR,1,1,800.0,1.0+5,1.0+5,1.5+5;MAT1,1,210000.0,,0.3;SPC1,1,123456,1
CBUSH,9,9,2,12,,,,0;PBUSH,9,K,1.0+9,1.0+9,1.0+9,1.0+12,1.0+12,4.0+8;MOMENT,1,3,,2.0+6,0.0,0.0,1.0;ENDDATA
DECK
run hinge && near 'hinge with a spring' "$(rotation hinge 3 3)" '2e6*1000/(210000*1e5) + 2e6/4e8' 3e-6
sed -e 's/^CBUSH.*/CELAS2,9,4.0+8,2,6,12,6\nRBE2,8,2,12345,12/' -e '/^PBUSH/d' "$work/hinge.bdf" > "$work/hinge_celas.bdf"
run hinge_celas && near 'CELAS2 between rotations, RBE2 for the rest' "$(rotation hinge_celas 3 3)" '2e6*1000/(210000*1e5) + 2e6/4e8' 3e-6
# K1 and K4 of a CBUSH along the line between two nodes that are apart: 2e5 on a beam of 490, behind it the spring and one of 500
sed -e 's/^GRID,12,,500.0/GRID,12,,510.0/' -e 's/^CBUSH.*/CBUSH,9,9,2,12/' -e 's/^PBUSH.*/PBUSH,9,K,1.0+5,,,1.0+8/' -e 's/^MOMENT.*/MOMENT,1,12,,2.0+5,1.0,0.0,0.0/' \
   -e 's/^SPC1.*/&,3/' "$work/hinge.bdf" > "$work/along_spring.bdf"
run along_spring && near 'K4 along the line of a CBUSH' "$(table along_spring 'FORCES OF SPRINGS' | awk '$5 == "R1" { print $6 }')" \
   '2e5/(1 + (500/(1.5e5*210000/2.6) + 1/1e8)/(490/(1.5e5*210000/2.6)))' 3e-6
near 'moment of the spring' "$(table hinge_celas 'FORCES OF SPRINGS' | awk '$2 == 9 { print sqrt($6*$6) }')" 2e6 3e-6
# a rigid arm of 100 at the tip: RBAR, and the same by an offset of the beam
cards rigid_arm <<DECK
MODEL = SPACE;SPC = 1;SUBCASE 1;  LOAD = 1;BEGIN BULK;GRID,1,,0.0,0.0,0.0;GRID,2,,500.0,0.0,0.0;GRID,3,,500.0,100.0,0.0
CBAR,1,1,1,2,0.0,1.0,0.0;RBAR,5,2,3,123456;PBAR,1,1,800.0,1.0+5,1.0+5,1.5+5;MAT1,1,210000.0,,0.3;SPC1,1,123456,1
FORCE,1,3,,1000.0,1.0,0.0,0.0;ENDDATA
DECK
run rigid_arm && {
   near 'rigid arm: along' "$(moved rigid_arm 3 1)" '1000*500/(210000*800) + 1000*100^2*500/(210000*1e5)' 3e-6
   near 'rigid arm: across' "$(moved rigid_arm 2 2)" '-1000*100*500^2/(2*210000*1e5)' 3e-6
}
sed -e '/^RBAR/d' -e '/^GRID,3/d' -e 's/^CBAR.*/CBAR,1,1,1,2,0.0,1.0,0.0,GGG\n+,,,0.0,-100.0,0.0,0.0,-100.0,0.0/' -e 's/FORCE,1,3/FORCE,1,2/' "$work/rigid_arm.bdf" > "$work/offset_beam.bdf"
run offset_beam && near 'offset of a beam' "$(moved offset_beam 2 1)" '1000*500/(210000*800) + 1000*100^2*500/(210000*1e5)' 3e-6

# a beam as a bolt: preload against a spring of k, then 500 on both: N = 1000 + 500 (E A/L)/(E A/L + k)
cards bolt_beam <<'DECK'
MODEL = SPACE;SPC = 1;SUBCASE 1;SUBCASE 2;  LOAD = 1;BEGIN BULK;GRID,1,,0.0,0.0,0.0;GRID,2,,100.0,0.0,0.0
CBAR,1,1,1,2,0.0,1.0,0.0;PBAR,1,1,50.0,200.0,200.0,400.0;MAT1,1,210000.0,,0.3;SPC1,1,123456,1;CELAS2,9,45000.0,2,1
BOLT,1,1,1000.0,1;FORCE,1,2,,500.0,1.0,0.0,0.0;FORCE,1,2,,30.0,0.0,1.0,0.0;ENDDATA
DECK
run bolt_beam && {
   near 'a beam as a bolt: its force' "$(beam_force bolt_beam 1 3 1)" '1000 + 500*105000/(105000 + 45000)' 3e-6
   near 'a beam as a bolt: it bends' "$(moved bolt_beam 2 2)" '30*100^3/(3*210000*200)' 3e-6
   near 'a beam as a bolt: along it' "$(moved bolt_beam 2 1)" '-1000/45000 + 500/150000' 3e-6
}

# ---- a mass beside its node: CONM2 with an offset, and the same at the free end of a rigid bar ----

for model in PLANE SPACE; do
   cards beside <<DECK
MODEL = $model;SPC = 1;SUBCASE 1;  LOAD = 1;  MODES = 3;BEGIN BULK;EIGRL,3,,,3;CORD2R,7,,0.0,0.0,0.0,0.0,0.0,1.0;+,0.0,1.0,0.0
GRID,1,,0.0,0.0,0.0;GRID,2,,500.0,0.0,0.0;CBAR,1,1,1,2,0.0,1.0,0.0;PBAR,1,1,800.0,1.0+5,1.0+5,1.5+5;MAT1,1,210000.0,,0.3;SPC1,1,123456,1
CONM2,9,2,7,0.002,100.0,-40.0,0.0;+,3.0,0.5,4.0,,,5.0;GRAV,1,,9810.0,0.0,1.0,0.0;ENDDATA
DECK
   sed -e 's/^CONM2.*/RBAR,7,2,3,123456\nGRID,3,,540.0,100.0,0.0\nCONM2,9,3,7,0.002/' "$work/beside.bdf" > "$work/beside_bar.bdf"
   run beside && run beside_bar && {
      near "$model: mass beside its node, its weight" "$(moved beside 2 2)" '0.002*9810*(500^3/3 + 40*500^2/2)/(210000*1e5)' 3e-6
      for k in 1 2 3; do near "$model: mass beside its node, frequency $k" "$(mode beside $k frequency)" "$(mode beside_bar $k frequency)" 1e-9; done
   }
done

# ---- warm beams, and beams that oscillate: (n pi)^2/(2 pi L^2) sqrt(E I/(rho A)) ----

cards warm_beam <<DECK
MODEL = SPACE;SPC = 1;SUBCASE 1;  TEMPERATURE(LOAD) = 5;BEGIN BULK;GRID,1,,0.0,0.0,0.0;GRID,2,,500.0,0.0,0.0
CBAR,1,1,1,2,0.0,1.0,0.0;PBAR,1,1,800.0,1.0+5,1.0+5,1.5+5;MAT1,1,210000.0,,0.3,,1.2-5,20.0;SPC1,1,123456,1;SPC1,1,12345,2;TEMPD,5,70.0;ENDDATA
DECK
run warm_beam && near 'a warm beam, held' "$(beam_force warm_beam 1 1 1)" '-210000*800*1.2e-5*50' 3e-6
# TEMPRB: gradients along y and z, linear along the beam. Free: v'' = -alpha TP1, w'' = -alpha TP2; held: sigma = -E alpha (T + TP1 y + TP2 z)
for model in PLANE SPACE; do
   [ $model = PLANE ] && z='' || z=0.3,0.6
   cards warm_bar <<DECK
MODEL = $model;SPC = 1;SUBCASE 1;  TEMPERATURE(LOAD) = 5;  INCR = 1;BEGIN BULK;JINCR,1,,LIST,0.25,0.75;GRID,1,,0.0,0.0,0.0;GRID,2,,500.0,0.0,0.0
CBAR,1,1,1,2,0.0,1.0,0.0;PBARL,1,1,,BAR;+,20.0,40.0;MAT1,1,210000.0,,0.3,,1.2-5,20.0;SPC1,1,123456,1;TEMPRB,5,1,70.0,90.0,0.2,0.5,$z;TEMPD,5,-999.0;ENDDATA
DECK
   run warm_bar && {
      near "$model: a beam warm on one side, along" "$(moved warm_bar 2 1)" '1.2e-5*60*500' 3e-6
      near "$model: a beam warm on one side, along y" "$(moved warm_bar 2 2)" '-1.2e-5*500^2*(0.2/3 + 0.5/6)' 3e-6
      near "$model: a beam warm on one side, its slope" "$(rotation warm_bar 2 $([ $model = PLANE ] && echo 1 || echo 3))" '-1.2e-5*500*0.35' 3e-6
      near "$model: a beam warm on one side, no moment" "$(beam_force warm_bar 1 1 6)" 0 0 1e-4
   }
   [ $model = SPACE ] && near 'along z' "$(moved warm_bar 2 3)" '-1.2e-5*500^2*(0.3/3 + 0.6/6)' 3e-6
   sed -e 's/^SPC1.*/&\nSPC1,1,23456,2/' -e 's/^TEMPD.*//' -e 's/0.2,0.5,0.3,0.6/0.5,0.5,0.3,0.3/; s/0.2,0.5/0.5,0.5/' "$work/warm_bar.bdf" > "$work/warm_bar_held.bdf"
   run warm_bar_held && {
      near "$model: a beam warm on one side, held: moment" "$(beam_force warm_bar_held 1 1 6)" "210000*$i1*1.2e-5*0.5" 3e-6
      near "$model: a beam warm on one side, held: stress" "$(beam_stress warm_bar_held 1 1 1)" "-210000*1.2e-5*(0.5*20 + ${z:+1}0*0.3)" 3e-6
   }
done
# a CBEAM whose section changes, free; rods in a line, by the mean of both ends
cards warm_taper <<'DECK'
MODEL = SPACE;SPC = 1;SUBCASE 1;  TEMPERATURE(LOAD) = 5;BEGIN BULK;GRID,1,,0.0,0.0,0.0;GRID,2,,500.0,0.0,0.0
CBEAM,1,1,1,2,0.0,1.0,0.0;PBEAM,1,1,800.0,1.0+5,0.4+5;+;+,NO,1.0,400.0,0.3+5,0.2+5;MAT1,1,210000.0,,0.3,,1.2-5,20.0;SPC1,1,123456,1;TEMPRB,5,1,70.0,90.0,0.2,0.5,0.3,0.6;ENDDATA
DECK
sed -i 's/^+$/+,,,,,,,,/' "$work/warm_taper.bdf"
run warm_taper && {
   near 'a tapered beam warm on one side, along' "$(moved warm_taper 2 1)" '1.2e-5*60*500' 3e-6
   near 'along y' "$(moved warm_taper 2 2)" '-1.2e-5*500^2*(0.2/3 + 0.5/6)' 3e-6
   near 'along z' "$(moved warm_taper 2 3)" '-1.2e-5*500^2*(0.3/3 + 0.6/6)' 3e-6
}
cards warm_rods <<'DECK'
MODEL = SPACE;SPC = 1;SUBCASE 1;  TEMPERATURE(LOAD) = 5;BEGIN BULK;GRID,1,,0.0,0.0,0.0;GRID,2,,500.0,0.0,0.0;GRID,3,,1000.0,0.0,0.0
CROD,1,1,1,2;CONROD,2,2,3,1,50.0;PROD,1,1,50.0;MAT1,1,210000.0,,0.3,,1.2-5,20.0;SPC1,1,123,1;SPC1,1,23,2,3;TEMPRB,5,1,70.0,90.0;+;+,2
ENDDATA
DECK
sed -i 's/^+$/+,,,,,,,,/' "$work/warm_rods.bdf"
run warm_rods && near 'warm rods' "$(moved warm_rods 3 1)" '1.2e-5*60*1000' 3e-6

{
   printf 'MODEL = SPACE\nSPC = 1\nSUBCASE 1\n  MODES = 3\nBEGIN BULK\nEIGRL,3,,,6\n'
   for k in 0 1 2 3 4 5 6 7 8; do printf 'GRID,%d,,%s,0.0,0.0\n' $((k + 1)) "$((125 * k)).0"; done
   for k in 1 2 3 4 5 6 7 8; do printf 'CBAR,%d,1,%d,%d,0.0,1.0,0.0\n' $k $k $((k + 1)); done
   printf 'PBAR,1,1,100.0,1.0+3,2.0+3,2.5+3\nMAT1,1,210000.0,,0.3,7.85-9\nSPC1,1,1234,1\nSPC1,1,23,9\nENDDATA\n'
} > "$work/modes_beam.bdf"
run modes_beam && {
   near 'modes of a beam: first' "$(mode modes_beam 1 frequency)" "$pi/2/1000^2*sqrt(210000*1000/(7.85e-9*100))" 2e-4
   near 'modes of a beam: across' "$(mode modes_beam 2 frequency)" "$pi/2/1000^2*sqrt(210000*2000/(7.85e-9*100))" 2e-4
   near 'modes of a beam: second' "$(mode modes_beam 3 frequency)" "4*$pi/2/1000^2*sqrt(210000*1000/(7.85e-9*100))" 1e-3
}

# ---- plates: the middle of one that is held at its edges, its first frequency, both solvers ----

# shell_deck NAME AWK-VARIABLES...: a deck of plates.awk
shell_deck() { awk "${@:2}" -f tests/exact/plates.awk > "$work/$1.bdf"; }
shell_deck thick -v case=plate -v n=8 -v edges=s -v load=p -v aspect=1 -v thickness=0.02 -v pressure=1.0
run thick && near 'plate on its edges, 8 x 8' "$(moved thick 1 3)" '0.004062*2^4/(1.7472e7*0.02^3/(12*(1 - 0.3^2)))' 6e-3
sed 's/^MODEL = SPACE/&\nSOLVER = TREE/' "$work/thick.bdf" > "$work/thick_tree.bdf"
sed 's/^MODEL = SPACE/&\nSOLVER = SKYLINE/' "$work/thick.bdf" > "$work/thick_skyline.bdf"
run thick_tree && run thick_skyline && same 'TREE and SKYLINE: displacements' "$(table thick_tree 'DISPLACEMENTS OF NODES')" "$(table thick_skyline 'DISPLACEMENTS OF NODES')"
sed -e 's/^  LOAD = 1/  MODES = 3/' -e '/^PLOAD2/d' -e 's/^BEGIN BULK/&\nEIGRL,3,,,2/' -e 's/^MAT1.*/MAT1,1,17472000.0,,0.3,0.001/' "$work/thick.bdf" > "$work/plate_modes.bdf"
# 2 pi f = 2 pi^2/a^2 sqrt(D/(rho t)), a = 2
run plate_modes && near 'first frequency of a plate on its edges' "$(mode plate_modes 1 frequency)" "$pi/4*sqrt(1.7472e7*0.02^2/(12*(1 - 0.3^2)*0.001))" 6e-3

# ---- a temperature over the thickness: free w = -alpha TPRIME (x^2 + y^2)/2, without stress; held M = D (1 + nu) alpha TPRIME ----

awk 'BEGIN {
   print "MODEL = SPACE\nSPC = 1\nSUBCASE 1\n  TEMPERATURE(LOAD) = 5\n  INCR = 1\n  OUTPUT = LAST, STRESS\nBEGIN BULK\nJINCR,1,,LIST,0.25,0.75"
   for (i = 0; i <= 4; i++) for (j = 0; j <= 4; j++) printf "GRID,%d,,%.1f,%.1f,0.0\n", i*5 + j + 1, 25*i + (i == 2 && j == 2 ? 3 : 0), 20*j
   for (i = 0; i < 4; i++) for (j = 0; j < 4; j++) { a = i*5 + j + 1; printf "CQUAD4,%d,1,%d,%d,%d,%d\n", ++e, a, a + 5, a + 6, a + 1 }
   print "PSHELL,1,1,4.0,1,,1\nMAT1,1,210000.0,,0.3,,1.2-5,20.0\nSPC1,1,123456,1\nTEMPP1,5,1,50.0,10.0\n+,2,THRU,16\nENDDATA" }' > "$work/warm_free.bdf"
shell_stress() { table "$1" 'STRESSES AT THE FACES OF SHELLS' | awk -v e="$2" -v face="$3" -v k="$4" '$1 == e && ++n == face { v = $(2 + k) } END { print v }'; }
run warm_free && {
   near 'a plate warm on one side: across' "$(moved warm_free 25 3)" '-1.2e-5*10*(100^2 + 80^2)/2' 3e-6
   near 'a plate warm on one side: along' "$(moved warm_free 25 1)" '1.2e-5*30*100' 3e-6
   near 'a plate warm on one side: no stress' "$(shell_stress warm_free 6 2 7)" 0 0 1e-6
}
sed -e 's/^SPC1.*/SPC1,1,123456,1,THRU,12\nSPC1,1,123456,14,THRU,25/' "$work/warm_free.bdf" > "$work/warm_held.bdf"
run warm_held && for face in 1 2; do
   near "a plate warm on one side, held, face $face" "$(shell_stress warm_held 6 $face 1)" "-210000/(1 - 0.3)*1.2e-5*(30 + $((2*face - 3))*2*10)" 3e-6
done
sed -e 's/^TEMPP1.*/TEMP,5,1,50.0,2,50.0,6,50.0\nTEMP,5,7,50.0\nTEMPD,5,20.0\nTEMPP1,5,2,50.0,10.0/' -e 's/^+,2,THRU/+,3,THRU/' "$work/warm_held.bdf" > "$work/warm_both.bdf"
run warm_both && near 'TEMPP1 goes before TEMP of nodes' "$(shell_stress warm_both 6 2 1)" '-210000/(1 - 0.3)*1.2e-5*50' 3e-6
near 'a shell without TEMPP1 beside' "$(shell_stress warm_both 1 2 1)" '-210000/(1 - 0.3)*1.2e-5*30' 3e-6

# ---- forces and moments per length: a strip pulled and bent, N = F/b, M = M_0/b; corner forces P twist a plate evenly, M_xy = P/2 ----

# bent NAME CASE: 4 x 2 distorted elements of 100 x 20, 4 thick, offset 3 from their nodes; the strip lies in x-y, the plate in y-z
bent() {
   awk -v case="$2" 'BEGIN {
      print "MODEL = SPACE\nSPC = 1\nSUBCASE 1\n  LOAD = 1\n  OUTPUT = LAST, FORCES\nSUBCASE 2\n  LOAD = 2\n  OUTPUT = NONE, FORCES\nBEGIN BULK"
      strip = case == "strip"
      for (i = 0; i <= 4; i++) for (j = 0; j <= 2; j++) { n++
         a = 25*i + (i == 2 && j == 1 ? 4 : 0); b = 10*j + (i == 1 && j == 1 ? 2 : 0)
         if (strip) printf "GRID,%d,,%.1f,%.1f,0.0\n", n, a, b; else printf "GRID,%d,,0.0,%.1f,%.1f\n", n, a, b }
      for (i = 0; i < 4; i++) for (j = 0; j < 2; j++) { a = 3*i + j + 1; printf "CQUAD4,%d,1,%d,%d,%d,%d,,%s\n", ++e, a, a + 3, a + 4, a + 1, strip ? "3.0" : "" }
      print "PSHELL,1,1,4.0,1,," (strip ? "1" : "") "\nMAT1,1,210000.0,,0.3"
      if (strip) {
         print "SPC1,1,13,1,3\nSPC1,1,12,2\nSPC1,1,5,1,2,3"
         for (s = 1; s <= 2; s++) for (j = 0; j <= 2; j++) {
            w = (j == 1 ? 0.5 : 0.25)*s
            printf "FORCE,%d,%d,,%.4f,1.0,0.0,0.0\nMOMENT,%d,%d,,%.4f,0.0,1.0,0.0\n", s, 13 + j, 600*w, s, 13 + j, 1800*w + 4000*w }
      } else print "SPC1,1,123,1\nSPC1,1,13,13\nSPC1,1,1,3\nFORCE,1,15,,50.0,1.0,0.0,0.0\nFORCE,2,15,,100.0,1.0,0.0,0.0"
      print "ENDDATA" }' > "$work/$1.bdf"
}
shell_force() { table "$1" 'FORCES AND MOMENTS PER LENGTH OF SHELLS' | awk -v e="$2" -v k="$3" '$1 == e { v = $(1 + k) } END { print v }'; }
bent strip strip && run strip && {
   for k in '1 600/20' '2 0' '3 0' '4 4000/20' '5 0' '6 0' '7 0' '8 0'; do
      read -r k value <<< "$k"
      near "a strip pulled and bent: force $k per length" "$(shell_force strip 3 $k)" "$value" 3e-6 1e-4
   done
   "$query" "$work/strip.shell.csv" rows 'stage = 2' count 40 all 'n_x = 60 within 1e-6 and m_x = 400 within 1e-6 and m_y = 0 within 1e-5 and n_y = 0 within 1e-6 and q_x = 0 within 1e-5 and load = 1' &&
      passed=$((passed + 1)) || fail 'a strip pulled and bent: the CSV file has every corner and centre'
}
bent twisted_plate plate && run twisted_plate && {
   near 'a plate twisted evenly: M XY' "$(shell_force twisted_plate 3 6)" '-50/2' 3e-6
   for k in 1 2 3 4 5 7 8; do near "a plate twisted evenly: force $k per length" "$(shell_force twisted_plate 3 $k)" 0 0 1e-5; done
}

# ---- a wall tied to a solid by SHELLTO: a turn of the solid turns the wall, free of force; what the wall bears goes to the solid ----

# tied NAME: a wall of 7 x 2 shells, 6 thick, upright askew on 3 x 2 bricks; the cards behind are read from the standard input
tied() {
   awk 'BEGIN {
      print "MODEL = SPACE\nSPC = 1\nSUBCASE 1\n  LOAD = 1\nBEGIN BULK\nMAT1,1,210000.0,,0.3\nPSOLID,1,1\nPSHELL,2,1,6.0,1,,1\nPMARK,5\nPMARK,6\nPMARK,7\nSHELLTO,7,6"
      print "BLOCK3,1,1,3,2,1,0.0,0.0,-20.0\n+,90.0,50.0,0.0\n+,,,,,5,6\nSPCM,1,123,5"
      for (k = 0; k <= 2; k++) for (i = 0; i <= 7; i++) printf "GRID,%d,,%.6f,%.6f,%.6f\n", 501 + i + 8*k, 10 + 10*i, 21 + i, 25*k
      for (k = 0; k < 2; k++) for (i = 0; i < 7; i++) { a = 501 + i + 8*k; printf "CQUAD4,%d,2,%d,%d,%d,%d\n", 501 + ++e, a, a + 1, a + 9, a + 8 }
      for (i = 0; i < 7; i++) printf "CBAR,%d,7,%d,%d\n", 601 + i, 501 + i, 502 + i }' > "$work/$1.bdf"
   cat - <(echo ENDDATA) >> "$work/$1.bdf"
}
tied tied <<< 'FORCE,1,524,,700.0,1.0,2.0,-1.0'
run tied && for c in 1 2 3; do near "a tied wall: the balance of forces, $c" "$(total tied 'SUM: LEFT UNBALANCED' $c)" 0 0 1e-6; done
# theta = (1, 2, 3) 1E-4 about the origin; node 524 is at (80, 28, 50)
awk 'BEGIN { for (i = 0; i <= 3; i++) for (j = 0; j <= 2; j++) { x = 30*i; y = 25*j; id = 1 + (3*i + j)*2
   printf "SPCD,1,%d,1,%.9f,%d,2,%.9f\nSPCD,1,%d,3,%.9f\n", id, 1e-4*(-40 - 3*y), id, 1e-4*(3*x + 20), id, 1e-4*(y - 2*x) } }' | tied tied_turned
run tied_turned && {
   near 'a tied wall, turned: x' "$(moved tied_turned 524 1)" 16e-4 1e-6
   near 'a tied wall, turned: y' "$(moved tied_turned 524 2)" 190e-4 1e-6
   near 'a tied wall, turned: z' "$(moved tied_turned 524 3)" -132e-4 1e-6
   near 'a tied wall, turned: no stress' "$(shell_stress tied_turned 502 2 7)" 0 0 1e-4
}

# the face is rigid by an RBE2M whose GN is turned about the origin; loaded, the wall moves as one whose edge belongs to the RBE2
tied tied_spider <<< 'RBE2M,905,999,123456,6
GRID,999
FORCE,1,524,,0.0,1.0
SPC,1,999,123,0.0
SPC,1,999,4,1.-4
SPC,1,999,5,2.-4
SPC,1,999,6,3.-4'
run tied_spider && {
   near 'a wall tied to an RBE2M, turned: x' "$(moved tied_spider 524 1)" 16e-4 1e-6
   near 'a wall tied to an RBE2M, turned: y' "$(moved tied_spider 524 2)" 190e-4 1e-6
   near 'a wall tied to an RBE2M, turned: z' "$(moved tied_spider 524 3)" -132e-4 1e-6
   near 'a wall tied to an RBE2M, turned: no stress' "$(shell_stress tied_spider 502 2 7)" 0 0 1e-4
}
tied tied_spider <<< 'FORCE,1,524,,700.0,1.0,2.0,-1.0
GRID,999,,10.0,10.0,10.0
RBE2M,905,999,123456,6'
tied tied_rigid <<< 'FORCE,1,524,,700.0,1.0,2.0,-1.0
GRID,999,,10.0,10.0,10.0
RBE2M,905,999,123456,6
RBE2,906,999,123456,501,502,503,504,505
+,506,507,508'
sed -i '/^SHELLTO/d' "$work/tied_rigid.bdf"
run tied_spider && run tied_rigid && for c in 1 2 3; do
   near "a wall tied to an RBE2M, loaded: $c" "$(moved tied_spider 524 $c)" "$(moved tied_rigid 524 $c)" 1e-6
   near "a wall tied to an RBE2M: the balance of forces, $c" "$(total tied_spider 'SUM: LEFT UNBALANCED' $c)" 0 0 1e-6
done

# ---- joints on the faces of shells: two sheets, pressed evenly ----

# sheets NAME LINES: 4 x 4 sheets of 100 x 100, 10 thick, the lower one held; LINES are those of case control
sheets() {
   awk -v lines="$2" 'BEGIN {
      n = 4; gsub(";", "\n", lines); print lines "\nSPC = 1\nSUBCASE 1\n  LOAD = 1\n  INCR = 3\nBEGIN BULK\nJINCR,3,5"
      for (s = 0; s < 2; s++) for (i = 0; i <= n; i++) for (j = 0; j <= n; j++) {
         printf "GRID,%d,,%.1f,%.1f,%.1f\n", s*100 + i*(n + 1) + j + 1, 25*i, 25*j, 10*s
         if (s == 0) printf "SPC1,1,123456,%d\n", i*(n + 1) + j + 1
      }
      for (m = 0; m < 2; m++) for (s = 0; s < 2; s++) for (i = 0; i < n; i++) for (j = 0; j < n; j++) {
         a = s*100 + i*(n + 1) + j + 1; b = a + n + 1; c = b + 1; d = a + 1
         if (m == 1 && s == 1) printf "CQUAD4,%d,12,%d,%d,%d,%d\n", ++e, d, c, b, a
         else printf "CQUAD4,%d,%d,%d,%d,%d,%d\n", ++e, m == 0 ? 1 : 11, a, b, c, d
      }
      print "PMARK,11\nPMARK,12\nPSHELL,1,1,10.0,1,,1\nMAT1,1,210000.0,,0.3\nJOINT,1,1,11,12\nPJOINT,1,1,1,1,0.3\nJNORM,1,4.6-3,0.5,1.0+6"
      print "JSHEAR,1,20000.0\nPLOAD4,1,17,-2.0,,,,THRU,32\nENDDATA" }' > "$work/$1.bdf"
}
for method in STEP NEWTON BACK; do
   sheets sheets "METHOD = $method" && run sheets && {
      ask "$method: sheets pressed evenly" sheets rows "increment = $([ $method = BACK ] && echo 1 || echo 5)" all 'pressure = 2.0 within 2e-9 and area > 0'
      [ $method = STEP ] || ask "$method: their law" sheets rows "increment = $([ $method = BACK ] && echo 1 || echo 5)" all 'lambda = 4.6e-3*2.0^0.5 within 1e-9*lambda'
   }
done
# A couple on the upper sheet: shear on its lower face turns it, u + theta x r; forces balance and so do moments
near 'sheets: the balance of forces' "$(total sheets 'SUM: LEFT UNBALANCED')" 0 0 1e-6

# A wall that stands on its edge on a rigid base: pressure F/(L t) and, linear law, a couple across bends it: p = F/A +- 6 M/(L t^2)
cards wall <<'DECK'
METHOD = NEWTON;SPC = 1;SUBCASE 1;  LOAD = 1;BEGIN BULK
GRID,1,,0.0,0.0,0.0;GRID,2,,50.0,0.0,0.0;GRID,3,,100.0,0.0,0.0;GRID,4,,0.0,0.0,60.0;GRID,5,,50.0,0.0,60.0;GRID,6,,100.0,0.0,60.0
CQUAD4,1,1,1,2,5,4;CQUAD4,2,1,2,3,6,5;CBAR,11,7,1,2;CBAR,12,7,2,3;PMARK,7;PSHELL,1,1,12.0,1,,1;MAT1,1,210000.0,,0.3
JOINT,1,1,7;PJOINT,1,1,1,1;JNORM,1,1.0-3,1.0,1.0+5;JSHEAR,1,50000.0;RBE2,20,5,123456,4,6;SPC1,1,1,5;FORCE,1,5,,3600.0,0.0,0.0,-1.0
MOMENT,1,5,,4800.0,1.0,0.0,0.0;ENDDATA
DECK
run wall && {
   near 'a wall on its edge: area' "$(value wall print 'sum(area)')" 1200 1e-9
   near 'a wall on its edge: force' "$(value wall print 'sum(force)')" 3600 1e-7
   near 'a wall on its edge: moment about its middle' "$(value wall print 'sum(force*y)')" -4800 1e-6
   near 'a wall on its edge: highest pressure' "$(value wall print 'max(pressure)')" '3 + 6*4800/(100*12^2)/(1 + 2/8^2)' 3e-3
}

# ---- a second-order edge under FORCEM, PLOADM, RBE3M and joints: 1/6, 2/3, 1/6 of the force at its nodes, evenly pressed ----

# edge8 NAME LINES: a sheet of 10 x 10 x 1, as one CQUAD8 or two CTRIA6, held at x = 0 where LINES say so, loaded at x = 10, u = F/100 there
edge8() {
   cards "$1" <<DECK
MODEL = SPACE;METHOD = NEWTON;SPC = 1;SUBCASE 1;  LOAD = 1;BEGIN BULK;GRID,1,,0.0,0.0,0.0;GRID,2,,10.0,0.0,0.0;GRID,3,,10.0,10.0,0.0;GRID,4,,0.0,10.0,0.0
GRID,5,,5.0,0.0,0.0;GRID,6,,10.0,5.0,0.0;GRID,7,,5.0,10.0,0.0;GRID,8,,0.0,5.0,0.0;PSHELL,1,1,1.0,1,,1;MAT1,1,1000.0,,0.0
SPC1,1,3456,1,2,3,4;SPC1,1,3456,5,6,7,8;SPC1,1,2,1,2,5;PMARK,7;CBAR,9,7,2,3;$2;ENDDATA
DECK
}
sheet8='CQUAD8,1,1,1,2,3,4,5,6;+,7,8'
sheet6='GRID,9,,5.0,5.0,0.0;SPC1,1,3456,9;CTRIA6,1,1,1,2,3,5,6,9;CTRIA6,2,1,1,3,4,9,7,8'
pressed8='FORCE,1,1,,16.66666666666667,1.0,0.0,0.0;FORCE,1,4,,16.66666666666667,1.0,0.0,0.0;FORCE,1,8,,66.66666666666667,1.0,0.0,0.0;JNORM,1,1.-3,1.0,1.+6;PJOINT,1,1,1,1;JSHEAR,1,1.+5'
for sheet in "$sheet8" "$sheet6"; do
   words="an edge of ${sheet:0:6}"
   for load in 'FORCEM,1,100.0,1.0,0.0,0.0,7' 'PLOADM,1,-10.0,7' 'GRID,90,,20.0,5.0,0.0;RBE3M,70,90,1,123456,7;FORCE,1,90,,100.0,1.0,0.0,0.0'; do
      edge8 edge8 "$sheet;SPC1,1,1,1,4,8;$load"
      run edge8 && for node in 2 6 3; do near "$words, ${load%%,*}: node $node" "$(moved edge8 $node 1)" 0.1 1e-6; done
   done
   edge8 edge8 "$sheet;SPC1,1,1,1,4,8;FORCEM,1,100.0,1.0,0.0,0.0,7" && sed -i 's/^CBAR,9.*/CBAR,9,7,6,2\nCROD,10,7,6,3/' "$work/edge8.bdf"
   run edge8 && for node in 2 6 3; do near "$words marked by halves: node $node" "$(moved edge8 $node 1)" 0.1 1e-6; done
   edge8 edge8_joint "$sheet;$pressed8;JOINT,1,1,7"
   run edge8_joint && ask "$words pressed evenly" edge8_joint all 'pressure = 10 within 1e-7 and lambda = 0.01 within 1e-10 and area > 0'
   for side in 7,8 8,7; do # a solid of another mesh behind the joint
      edge8 edge8_joint "$sheet;$pressed8;JOINT,1,1,$side;PMARK,8;PMARK,18;BLOCK3,1,2,2,3,2,10.0,0.0,-0.5;+,20.0,10.0,0.5,,,,1001,1001;+,8,18;PSOLID,2,1;SPCM,1,123,18"
      run edge8_joint && ask "$words pressed evenly on a solid, sides $side" edge8_joint all 'pressure = 10 within 1e-7 and area > 0'
   done
done

# ---- linear triangles beside shells of second order, pulled evenly: their drilling rotations bow no edge that these do not bow ----

cards mixed <<'DECK'
MODEL = SPACE;SPC = 1;SUBCASE 1;  LOAD = 1;  OUTPUT = LAST, STRESS;BEGIN BULK;GRID,1,,0.0,0.0,0.0;GRID,2,,10.0,0.0,0.0;GRID,3,,10.0,10.0,0.0
GRID,4,,0.0,10.0,0.0;GRID,12,,20.0,0.0,0.0;GRID,13,,20.0,10.0,0.0;GRID,22,,30.0,0.0,0.0;GRID,23,,30.0,10.0,0.0;GRID,5,,5.0,0.0,0.0;GRID,6,,10.0,5.0,0.0
GRID,7,,5.0,10.0,0.0;GRID,8,,0.0,5.0,0.0;GRID,14,,25.0,0.0,0.0;GRID,15,,25.0,5.0,0.0;GRID,16,,20.0,5.0,0.0;CQUAD8,1,1,1,2,3,4,5,6;+,7,8;CTRIA3,2,1,2,12,13
CTRIA3,3,1,2,13,3;CTRIA6,4,1,12,22,13,14,15,16;CTRIA3,5,1,22,23,13;PSHELL,1,1,1.0,1,,1;MAT1,1,1000.0,,0.3;SPC1,1,13456,1,4,8;SPC1,1,2,1
FORCE,1,22,,50.0,1.0,0.0,0.0;FORCE,1,23,,50.0,1.0,0.0,0.0;ENDDATA
DECK
run mixed && {
   for node in 22 23; do near "linear triangles beside second order: node $node" "$(moved mixed $node 1)" 0.3 1e-6; done
   for e in 1 2 3 4 5; do near "linear triangles beside second order: stress in $e" "$(shell_stress mixed $e 2 7)" 10 1e-6; done
}

# ---- a square tube of shells, with rigid ends, beside the same as one beam: bent, twisted, oscillating ----

tube() { # NAME
   awk 'BEGIN {
      print "MODEL = SPACE\nSPC = 1\nSUBCASE 1\n  LOAD = 1\n  MODES = 3\nBEGIN BULK\nEIGRL,3,,,5\nMAT1,1,210000.0,,0.3,7.85-9\nPSHELL,1,1,4.0,1,,1"
      m = 4; n = 40; h = 100; l = 2000
      for (k = 0; k <= n; k++) for (i = 0; i < 4*m; i++) {
         s = i % m; side = int(i/m); u = h*(s/m - 0.5)
         y = side == 0 ? u : side == 1 ? h/2 : side == 2 ? -u : -h/2; z = side == 0 ? -h/2 : side == 1 ? u : side == 2 ? h/2 : -u
         printf "GRID,%d,,%.6f,%.6f,%.6f\n", k*4*m + i + 1, l*k/n, y, z
      }
      for (k = 0; k < n; k++) for (i = 0; i < 4*m; i++) { j = (i + 1) % (4*m)
         printf "CQUAD4,%d,1,%d,%d,%d,%d\n", ++e, k*4*m + i + 1, (k + 1)*4*m + i + 1, (k + 1)*4*m + j + 1, k*4*m + j + 1 }
      printf "GRID,9001,,0.0,0.0,0.0\nGRID,9002,,%d.0,0.0,0.0\n", l
      for (end = 0; end < 2; end++) { printf "RBE2,%d,%d,123456", 9101 + end, 9001 + end; for (i = 1; i <= 4*m; i++) printf ",%s%d", (i == 6 || i == 14 ? "\n+," : ""), end*n*4*m + i; print "" }
      print "SPC1,1,123456,9001\nFORCE,1,9002,,1000.0,0.0,1.0,0.0\nMOMENT,1,9002,,1.0+6,1.0,0.0,0.0\nENDDATA" }' > "$work/$1.bdf"
}
tube tube
{
   printf 'MODEL = SPACE\nSPC = 1\nSUBCASE 1\n  LOAD = 1\n  MODES = 3\nBEGIN BULK\nEIGRL,3,,,5\nMAT1,1,210000.0,,0.3,7.85-9\nPBARL,1,1,,BOX\n+,104.0,104.0,4.0,4.0\n'
   for k in 0 1 2 3 4 5 6 7 8 9 10; do printf 'GRID,%d,,%d.0,0.0,0.0\n' $((9002 + 10 - k)) $((200 * k)); done
   for k in 1 2 3 4 5 6 7 8 9 10; do printf 'CBAR,%d,1,%d,%d,0.0,1.0,0.0\n' $k $((9013 - k)) $((9012 - k)); done
   printf 'SPC1,1,123456,9012\nFORCE,1,9002,,1000.0,0.0,1.0,0.0\nMOMENT,1,9002,,1.0+6,1.0,0.0,0.0\nENDDATA\n'
} > "$work/tube_beam.bdf"
run tube && run tube_beam && {
   near 'a tube of shells, bent' "$(moved tube 9002 2)" "$(moved tube_beam 9002 2)" 1e-2
   near 'twisted' "$(rotation tube 9002 1)" "$(rotation tube_beam 9002 1)" 1e-2
   near 'its slope' "$(rotation tube 9002 3)" "$(rotation tube_beam 9002 3)" 1e-2
   near 'its first frequency' "$(mode tube 1 frequency)" "$(mode tube_beam 1 frequency)" 1e-2
   near 'its third frequency' "$(mode tube 3 frequency)" "$(mode tube_beam 3 frequency)" 2e-2
}

# ---- the lap of two sheets turned in space, and in metres ----

sed 's/^JNORM.*/JNORM,1,8.0-4,0.5,2.1+5/' input/lap_sheets.bdf > "$work/lap.bdf"
awk 'function fixed(s) { return sprintf("%.12f", s) }
   /^GRID/ { x = substr($0, 25, 8); y = substr($0, 33, 8); z = substr($0, 41, 8)
      printf "GRID,%d,,%s,%s,%s\n", substr($0, 9, 8), fixed((2*x + 3*y + 6*z)/7), fixed((3*x - 6*y + 2*z)/7), fixed((6*x + 2*y - 3*z)/7); next }
   /^FORCE/ { printf "FORCE,%d,%d,,%s,%s,%s,%s\n", substr($0, 9, 8), substr($0, 17, 8), substr($0, 33, 8), fixed(2/7), fixed(3/7), fixed(6/7); next }
   /^SPC1/ && /3456/ && !/123456/ { sub(/3456 /, "3456 "); print; next }
   /^BEGIN/ { print; print "CORD2R,7,,0.0,0.0,0.0,0.857142857142857,0.285714285714286,-0.428571428571429\n+,0.285714285714286,0.428571428571429,0.857142857142857"; next }
   { print }' "$work/lap.bdf" | awk -F, '/^GRID,/ { print $0 ",7"; next } { print }' > "$work/lap_turned.bdf"
awk 'function scaled(at, f) { return sprintf("%.12f", substr($0, at, 8)*f) }
   /^GRID/ { printf "GRID,%d,,%s,%s,%s\n", substr($0, 9, 8), scaled(25, 1e-3), scaled(33, 1e-3), scaled(41, 1e-3); next }
   /^PSHELL/ { print "PSHELL,1,1,0.005,1,,1"; next } /^MAT1/ { print "MAT1,1,2.1+11,,0.3"; next } /^PROD/ { print "PROD,90,1,58.0-6"; next }
   /^JNORM/ { print "JNORM,1,8.0-10,0.5,2.1+14"; next } /^JSHEAR/ { print "JSHEAR,1,3.0+13"; next } { print }' "$work/lap.bdf" > "$work/lap_metres.bdf"
run lap && run lap_turned && run lap_metres && {
   same_rows 'lap of sheets, turned in space' lap lap_turned 1e-7 $resultant
   # lambda = c p**m with p in Pa: c/1000/(1E6)**m = 8.0-10
   ask 'lap of sheets, in metres' lap with "$work/lap_metres.joint.csv" \
      all 'stage = other.stage and increment = other.increment and branch = other.branch and abs(lambda - 1000*other.lambda) <= 1e-7*max(abs(lambda))'
}

# ---- A linear shell beside one of second order: constant stress, and constant curvature, pass their common edge ----
cards plate_orders <<'DECK'
SPC = 1;SUBCASE 1;  LOAD = 1;SUBCASE 2;  LOAD = 2;BEGIN BULK;GRID,1,,0.0,0.0,0.0;GRID,2,,1.0,0.0,0.0;GRID,3,,1.0,1.0,0.0;GRID,4,,0.0,1.0,0.0
GRID,5,,2.0,0.0,0.0;GRID,6,,2.0,1.0,0.0;GRID,7,,1.5,0.0,0.0;GRID,8,,2.0,0.5,0.0;GRID,9,,1.5,1.0,0.0;GRID,10,,1.0,0.5,0.0
CQUAD4,1,1,1,2,3,4;CQUAD8,2,1,2,5,6,3,7,8;+,9,10;PSHELL,1,1,0.1,1;MAT1,1,1000.0,,0.0;SPC1,1,123456,1,4
FORCE,1,5,,0.1,1.0,0.0,0.0;FORCE,1,6,,0.1,1.0,0.0,0.0;FORCE,1,8,,0.4,1.0,0.0,0.0
MOMENT,2,5,,1.-4,0.0,-1.0,0.0;MOMENT,2,6,,1.-4,0.0,-1.0,0.0;MOMENT,2,8,,4.-4,0.0,-1.0,0.0;ENDDATA
DECK
run plate_orders && {
   orders_moved() { table plate_orders "DISPLACEMENTS OF NODES, STAGE $1" | awk -v node="$2" -v c="$3" '$1 == node { print $(4 + c) }'; }
   near 'linear beside second order: stress' "$(orders_moved 1 8 1)" '0.6*2/(1000*0.1)' 1e-5
   near 'linear beside second order: middle of the edge' "$(orders_moved 1 10 1)" '0.6*1/(1000*0.1)' 1e-5
   near 'linear beside second order: curvature' "$(orders_moved 2 8 3)" '6e-4*4/(2*1000*0.1^3/12)' 1e-5
   says 'linear beside second order: said' "$work/plate_orders.log" '1 edge between linear shells and shells of second order'
}

# ---- MID1 blank: no membrane; as with MID1 where the loads bend alone, and the components in the plane are held as idle (AUTOSPC) ----
for mid1 in 1 ''; do
   for kind in CQUAD4 CTRIA3; do
      sed "s/^PSHELL.*/PSHELL,1,$mid1,0.1,1,,1/; s/^SUBCASE 1.*/SUBCASE 2/; /^FORCE/d; /^SUBCASE 2;/d; s/^CQUAD4.*/$kind,1,1,1,2,3$([ $kind = CQUAD4 ] && echo ,4)/; /^CQUAD8/d; /^+,9/d" \
         "$work/plate_orders.bdf" | awk '/^ *LOAD = 1/ { next } /^SUBCASE 2/ && n++ { next } /^GRID,([5-9]|10),/ { next } /^MOMENT/ { next }
         /^ENDDATA/ { print "MOMENT,2,3,,1.-4,0.5,-1.0,0.0\nFORCE,2,2,,3.-4,0.0,0.0,1.0" } { print }' > "$work/bends_$kind$mid1.bdf"
      run "bends_$kind$mid1"
   done
done
for kind in CQUAD4 CTRIA3; do
   near "$kind without membrane" "$(moved bends_$kind 3 3)" "$(moved bends_${kind}1 3 3)" 2e-6
   says "$kind without membrane: idle components" "$work/bends_$kind.log" 'components of nodes without stiffness are held (PARAM AUTOSPC)'
done

# ---- CQUAD8 under loads per area and with their masses: a strip of N along x, or a quarter of a cylinder (R = 100) about z, nu = 0 ----
# eights NAME N SHAPE CARDS [CONTROL]
eights() {
   { printf '%b\n' "MODEL = SPACE\n${5:-SPC = 1\nSUBCASE 1\n  LOAD = 1}\nBEGIN BULK\nPSHELL,1,1,1.0,1,,1\nMAT1,1,1.0+5,,0.0,1.0-3"
      awk -v n="$2" -v shape="$3" -v cd="$(grep -o 'CORD2C,5' <<<"$4" | cut -c 8)" 'BEGIN {
         for (i = 0; i <= 2*n; i++) for (j = 0; j < 3; j++) {
            if (i % 2 && j == 1) continue
            id[i, j] = ++k; a = i*atan2(1, 0)/(2*n); x = 50*i/n
            if (shape == "skewed" && i > 0 && i < 2*n) x += 4*(i % 4 == 2 ? j - 1 : i % 2 ? 0 : 1 - j)
            if (shape != "cylinder") printf "GRID,%d,,%.10f,%.1f,0.0\n", k, x, 15*j
            if (shape == "cylinder") printf "GRID,%d,,%.10f,%.10f,%.1f,%s\n", k, 100*cos(a), 100*sin(a), 25*j, cd
            if (i == 0) printf "SPC1,1,%s,%d\n", shape == "cylinder" ? 246 : 123456, k
            if (i == 2*n && shape == "cylinder") printf "SPC1,1,156,%d\n", k
         }
         for (e = 1; e <= n; e++) { i = 2*e
            printf "CQUAD8,%d,1,%d,%d,%d,%d,%d,%d\n,%d,%d\n", e, id[i-2, 0], id[i, 0], id[i, 2], id[i-2, 2], id[i-1, 0], id[i, 1], id[i-1, 2], id[i-2, 1] }
         printf "SPC1,1,3,1,THRU,%d\n", k }'
      printf '%b\n' "$4\nENDDATA"; } > "$work/$1.bdf"
   run "$1"
}
# spread_of NAME FROM: least and largest displacement: along x of nodes at x = FROM, radial with FROM = r
spread_of() { table "$1" 'DISPLACEMENTS OF NODES' | awk -v from="$2" '$1 ~ /^[0-9]+$/ && NF > 5 && (from == "r" || $2 == from) {
   v = from == "r" ? ($2*$5 + $3*$6)/sqrt($2^2 + $3^2) : $5; if (!n++ || v < a) a = v; if (n == 1 || v > b) b = v } END { print a, b }'; }
both() { set -- "$1" $(spread_of "$2" "$3") "$4" "$5"; near "$1: least" "$2" "$4" "$5"; near "$1: largest" "$3" "$4" "$5"; }
for n in 1 2 4; do
   eights eights_weight $n strip 'GRAV,1,,1000.0,1.0,0.0,0.0' && both "$n CQUAD8 under their weight" eights_weight 1.00000E+02 '1*100^2/(2e5)' 2e-6
done
eights eights_weight 2 strip 'GRAV,1,,1000.0,1.0,0.0,0.0' 'MASS = LUMPED\nSPC = 1\nSUBCASE 1\n  LOAD = 1' && \
   both '2 CQUAD8 under their weight, MASS = LUMPED' eights_weight 1.00000E+02 '1*100^2/(2e5)' 2e-6
eights eights_skewed 4 skewed 'GRAV,1,,1000.0,1.0,0.0,0.0' && both 'CQUAD8, trapezoids, under their weight' eights_skewed 1.00000E+02 '1*100^2/(2e5)' 2.5e-3
# f = k/(4 L) sqrt(E/rho); elements of second order with consistent masses: their error falls with the fourth power of the length
eights eights_modes 2 strip 'EIGRL,1,,,1\nSPC1,2,23456,1,THRU,13\nSPCADD,3,1,2' 'SOL = 103\nSPC = 3\nMETHOD = 1' && near 'two CQUAD8: f along the strip' \
   "$(awk -F, 'NR == 2 { print $3 }' "$work/eights_modes.modes.csv")" '1e8^0.5/400' 3e-4
# a cylinder that breathes, f = sqrt(E/rho)/(2 pi R), radial displacements alone: the inner node moves with the others
for n in 1 2 4; do
   eights eights_breathes $n cylinder "EIGRL,1,,,1\nCORD2C,5,,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\nSPC1,2,23456,1,THRU,$((5*n + 3))" 'SOL = 103\nSPC = 2\nMETHOD = 1' && \
      near "$n CQUAD8 round a quarter that breathes: f" "$(awk -F, 'NR == 2 { print $3 }' "$work/eights_breathes.modes.csv")" '1e8^0.5/(2*3.14159265358979*100)' "0.033/$n"
done
for n in 2 4; do
   eights eights_blown $n cylinder "PLOAD2,1,1.0,1,THRU,$n" && both "$n CQUAD8 round a quarter, pressed" eights_blown r '100^2/1e5' 4.5e-3
   eights eights_spun $n cylinder 'RFORCE,1,,,1.0,0.0,0.0,1.0' && both "$n CQUAD8 round a quarter, turning" eights_spun r '(2*3.14159265)^2*1e-3*100^3/1e5' 4e-3
done
eights eights_falls 2 cylinder 'GRAV,1,,1000.0,1.0,0.5,0.3\nPARAM,INREL,-2' 'SUBCASE 1\n  LOAD = 1' && \
   near 'free CQUAD8 that fall: no displacement' "$(spread_of eights_falls r | tr ' ' '-')" 0 0 1e-9

# A clamped panel, 400 x 200 x 8, vibrates: a coarse mesh of second order has the modes of a fine one of CQUAD4 and no others, whether the
# rotations about the normal are held or free, and whatever the direction of the panel
panel() { # NAME KIND NX NY TILTED PS
   awk -v kind="$2" -v nx="$3" -v ny="$4" -v tilted="$5" -v ps="${6:-}" '
      function node(i, j) {
         if (!((i, j) in at)) {
            at[i, j] = ++n
            x = 400*i/(2*nx); y = 200*j/(2*ny)
            if (tilted) printf "GRID,%d,,%.12f,%.12f,%.12f,,%s\n", n, 0.6*x, y, 0.8*x, ps
            else printf "GRID,%d,,%.6f,%.6f,0.,,%s\n", n, x, y, ps
            if (i == 0) held = held "SPC1,1,123456," n "\n"
         }
         return at[i, j]
      }
      BEGIN {
         print "SOL 103\nCEND\nMODEL = SPACE\nSPC = 1\nMETHOD = 4\nBEGIN BULK\nEIGRL,4,,,6\nPARAM,COUPMASS,1\nPSHELL,2,3,8.,3,,3\nMAT1,3,2.1+5,,.3,7.85-9"
         for (i = 0; i < 2*nx; i += 2) for (j = 0; j < 2*ny; j += 2) {
            a = node(i, j); b = node(i + 2, j); c = node(i + 2, j + 2); d = node(i, j + 2)
            if (kind == "CQUAD4") print "CQUAD4," ++e ",2," a "," b "," c "," d
            if (kind == "CQUAD8") print "CQUAD8," ++e ",2," a "," b "," c "," d "," node(i + 1, j) "," node(i + 2, j + 1) "\n+," node(i + 1, j + 2) "," node(i, j + 1)
            if (kind == "CTRIA6") {
               print "CTRIA6," ++e ",2," a "," b "," c "," node(i + 1, j) "," node(i + 2, j + 1) "," node(i + 1, j + 1)
               print "CTRIA6," ++e ",2," a "," c "," d "," node(i + 1, j + 1) "," node(i + 1, j + 2) "," node(i, j + 1)
            }
         }
         printf "%s", held
         print "ENDDATA"
      }' > "$work/$1.bdf"
   run "$1"
}
panel panel_fine CQUAD4 16 8 0 '' && while read -r kind nx ny tilted ps; do
   panel panel "$kind" $nx $ny $tilted "$ps" || continue
   for k in 1 2 3 4; do
      near "a panel of $nx x $ny $kind, tilted $tilted, PS '$ps': mode $k" "$(mode panel $k frequency)" "$(mode panel_fine $k frequency)" 2e-2
   done
done <<'END'
CQUAD8 4 2 0
CQUAD8 8 4 1
CQUAD8 4 2 0 6
CTRIA6 4 2 0
CTRIA6 4 2 1
CQUAD4 16 8 0 6
END

# The rotation about the normal held at all nodes of flat shells, as in decks of NASTRAN: a cantilever bends in its plane as if it were
# not held; at both ends something is left to hold
in_plane() { # NAME PS
   {
      printf 'SOL 101\nCEND\nMODEL = SPACE\nSPC = 1\nLOAD = 2\nBEGIN BULK\nGRDSET,,,,,,,%s\nPSHELL,1,1,0.1,1\nMAT1,1,1.+6,,0.0\n' "$2"
      awk 'BEGIN {
         for (i = 0; i <= 20; i++) for (j = 0; j <= 4; j++) printf "GRID,%d,,%.6f,%.6f,0.0\n", 10*i + j + 1, i*0.5, j*0.5
         for (i = 0; i < 20; i++) for (j = 0; j < 4; j++)
            printf "CQUAD4,%d,1,%d,%d,%d,%d\n", 1000 + 10*i + j, 10*i + j + 1, 10*i + j + 11, 10*i + j + 12, 10*i + j + 2
         for (j = 1; j <= 5; j++) printf "SPC1,1,123456,%d\n%s,2,%d,,%.3f,0.,1.,0.\n", j, "FORCE", 200 + j, (j == 1 || j == 5) ? 12.5 : 25
      }'
      echo ENDDATA
   } > "$work/$1.bdf"
   run "$1"
}
in_plane in_plane_free '' && for ps in 6 3456; do
   in_plane in_plane $ps && near "bent in its plane, PS = $ps" "$(moved in_plane 203 2)" "$(moved in_plane_free 203 2)" 1e-6
done
near 'bent in its plane, as a beam with shear' "$(moved in_plane_free 203 2)" '100*1000/(3*1e6*0.1*8/12) + 1.2*100*10/(0.2*5e5)' 1e-2
says 'bent in its plane: the message' "$work/in_plane.log" 'hold the rotation about the normal at 100 nodes of flat shells; as in NASTRAN'

# A wall tied to a block by SHELLTO, across the face and shorter than it, all 100 degrees warmer and free: every node moves by 1E-3 of its place
while read -r name y1 y3; do
   cards tied_warm <<DECK
SPC = 1;TEMPERATURE(LOAD) = 7;OUTPUT = LAST;BEGIN BULK;GRID,1,,0.,0.,0.;GRID,2,,20.,0.,0.;GRID,3,,20.,16.,0.;GRID,4,,0.,16.,0.;GRID,5,,0.,0.,12.;GRID,6,,20.,0.,12.
GRID,7,,20.,16.,12.;GRID,8,,0.,16.,12.;GRID,11,,20.,$y1,6.;GRID,12,,20.,8.,6.;GRID,13,,20.,$y3,6.;GRID,14,,25.,$y1,6.;GRID,15,,25.,8.,6.
GRID,16,,25.,$y3,6.;CHEXA,1,1,1,2,3,4,5,6,+;+,7,8;CQUAD4,11,3,11,14,15,12;CQUAD4,12,3,12,15,16,13;CBAR,21,41,11,12;CBAR,22,41,12,13
CQUAD4,31,42,2,3,7,6;PMARK,41;PMARK,42;SHELLTO,41,42;PSHELL,3,1,4.,1,,1;PSOLID,1,1;MAT1,1,200000.,,.3,,1.0-5,20.;TEMPD,7,120.;SPC1,1,123,1
SPC1,1,23,2;SPC1,1,3,4;ENDDATA
DECK
   run tied_warm || continue
   near "a warm wall on a warm block, $name: y of its corner" "$(moved tied_warm 14 2)" "1e-3*$y1" 2e-6 1e-8
   near "a warm wall on a warm block, $name: x of its corner" "$(moved tied_warm 16 1)" '1e-3*25' 2e-6
done <<'END'
within 3. 13.
across 0. 16.
END

# ... but it stays held where something else has the rotation: a rod with J normal to the plate, with a moment at its far end, turns by M L/(G J)
# alone, and a mass with inertia about the normal has no mode there
in_plane in_plane 6
sed -i '/^ENDDATA/d; s/^SPC1,1,123456,1$/&\nGRID,900,,5.0,1.0,2.0,,12345\nCROD,900,90,103,900\nPROD,90,1,1.0,0.01\nMOMENT,2,900,,1.0,0.,0.,1.0/' "$work/in_plane.bdf"
echo ENDDATA >> "$work/in_plane.bdf"
run in_plane && near 'a rod with J on a plate, PS = 6' "$(table in_plane 'ROTATIONS' | awk '$1 == 900 { v = $NF } END { print v }')" '2/(5e5*0.01)' 1e-4
