# Shells of second order against published problems, laminates against classical laminate theory, tapered beams against closed forms.

# ---- shells of second order: the problems of MacNeal and Harder and their kin (plates.awk), a series for the plate ----

laminates_shell() { # NAME WORDS COMPONENT VALUE RELATIVE AWK-VARIABLES...
   awk "${@:6}" -v second=1 -f tests/exact/plates.awk > "$work/$1.bdf"
   run "$1" && near "second order: $2" "$(moved "$1" $(awk '$1 == "$" { print $2 }' "$work/$1.bdf") "$3")" "$4" "$5"
}
laminates_shell roof8 'the roof of Scordelis and Lo, CQUAD8' 3 -0.3024 1e-2 -v case=roof -v n=8
laminates_shell roof6 'the roof, CTRIA6' 3 -0.3024 1e-2 -v case=roof -v n=8 -v tri=1
laminates_shell sphere8 'a hemisphere with a hole, CQUAD8' 1 0.094 1.5e-2 -v case=sphere -v n=8
laminates_shell cylinder8 'a pinched cylinder, CQUAD8' 3 -1.8248e-5 1e-2 -v case=cylinder -v n=16
laminates_shell twisted8 'a twisted beam, CQUAD8' 2 0.001754 1e-2 -v case=twisted -v load=2
laminates_shell twisted6 'a twisted beam, CTRIA6' 2 0.001754 1.5e-2 -v case=twisted -v load=2 -v tri=1
laminates_shell plate8 'a plate on its edges, CQUAD8' 3 '0.004062*2^4/(1.7472e7*0.02^3/(12*(1 - 0.3^2)))' 6e-3 -v case=plate -v n=8 -v edges=s -v load=p \
   -v aspect=1 -v thickness=0.02 -v pressure=1.0
laminates_shell plate6 'a plate on its edges, CTRIA6' 3 '0.004062*2^4/(1.7472e7*0.02^3/(12*(1 - 0.3^2)))' 2e-2 -v case=plate -v n=8 -v edges=s -v load=p \
   -v aspect=1 -v thickness=0.02 -v pressure=1.0 -v tri=1
sed -e 's/^  LOAD = 1/  MODES = 3/' -e '/^PLOAD2/d' -e 's/^BEGIN BULK/&\nEIGRL,3,,,2/' -e 's/^MAT1.*/MAT1,1,17472000.0,,0.3,0.001/' "$work/plate8.bdf" > "$work/modes8.bdf"
run modes8 && near 'second order: first frequency of a plate' "$(mode modes8 1 frequency)" "$pi/4*sqrt(1.7472e7*0.02^2/(12*(1 - 0.3^2)*0.001))" 6e-3

# Two plates of 2 x 2 CQUAD8 each, 4 thick, 6 between their nodes: the faces are 2 apart, as a gap that the joint does not count; pressed evenly by PLOAD4,
# every node of the joint has p and lambda = c p^0.5
awk 'BEGIN {
   print "MODEL = SPACE\nSPC = 1\nSUBCASE 1\n  LOAD = 1\nBEGIN BULK\nPSHELL,1,1,4.0,1,,1\nMAT1,1,210000.0,,0.3\nPMARK,5\nPMARK,6\nPJOINT,1,1\nJNORM,1,1.0-3,0.5,1.0+5"
   print "JOINT,1,1,5,6\nSPC1,1,12456,1,THRU,225"
   for (k = 0; k < 2; k++) for (i = 0; i <= 4; i++) for (j = 0; j <= 4; j++) if (i % 2 == 0 || j % 2 == 0)
      printf "GRID,%d,,%.1f,%.1f,%.1f\n", 1 + 100*k + 5*i + j, 10*i, 8*j, 4*k
   for (k = 0; k < 2; k++) for (i = 0; i < 4; i += 2) for (j = 0; j < 4; j += 2) { a = 1 + 100*k + 5*i + j
      e++; printf "CQUAD8,%d,1,%d,%d,%d,%d,%d,%d\n+,%d,%d\n", e, a, a + 10, a + 12, a + 2, a + 5, a + 11, a + 7, a + 1
      m = k ? sprintf("%d,%d,%d,%d", a, a + 2, a + 12, a + 10) : sprintf("%d,%d,%d,%d", a, a + 10, a + 12, a + 2)
      printf "CQUAD4,%d,%d,%s\n", 50 + e, 5 + k, m
      if (k) printf "PLOAD4,1,%d,-0.2\n", e; else printf "SPC1,1,3,%d,%d,%d,%d,%d,%d\n+,%d,%d\n", a, a + 10, a + 12, a + 2, a + 5, a + 11, a + 7, a + 1 }
   print "ENDDATA" }' | sed 's/THRU,225/THRU,25\nSPC1,1,12456,101,THRU,125/' > "$work/pressed8.bdf"
run pressed8 && {
   ask 'second order: plates pressed evenly' pressed8 all 'pressure = 0.2 within 1e-9' all 'lambda = 1e-3*0.2^0.5 within 1e-10'
   near 'second order: reaction of PLOAD4' "$(total pressed8 'SUPPORTS' 3)" '0.2*40*32' 1e-9
}

# ---- laminates: a strip without symmetry, pulled, bent and warm, against sums over slices (laminates.awk) ----

# strip NAME KIND THETA [Z0]: 4 x 2 distorted elements of 100 x 20, held at its first corner, and across at the second; N_x = 100, M_x = 50, 40 degrees warmer
strip() {
   awk -v kind="$2" -v theta="$3" -v z0="${4:-}" 'function grid(i, j,   a, b) {
         a = 25*(i/m) + (i == 2*m && j == m ? 4 : 0); b = 10*(j/m) + (i == m && j == m ? 2 : 0); gx[i, j] = a; gy[i, j] = b; at[i, j] = ++n }
      function edge(i, s,   j, w) { for (j = 0; j <= 2*m; j++) { w = m == 1 ? (j == 1 ? 10 : 5) : (j % 2 ? 20/3 : j == 2 ? 10/3 : 5/3)
         printf "FORCE,1,%d,,%.9f,1.0,0.0,0.0\nMOMENT,1,%d,,%.9f,0.0,1.0,0.0\n", at[i, j], s*100*w, at[i, j], s*50*w } }
      BEGIN {
      m = kind ~ /[68]/ ? 2 : 1
      print "MODEL = SPACE\nSPC = 1\nSUBCASE 1\n  LOAD = 1\n  TEMPERATURE(LOAD) = 5\n  OUTPUT = LAST, STRESS\nBEGIN BULK\nTEMPD,5,60.0\nSPC1,1,12345,1"
      print "MAT8,1,140000.0,10000.0,0.3,5000.0,4000.0,3000.0,1.6-9\n+,1.0-6,3.0-5\nMAT1,2,70000.0,,0.33,2.7-9,2.3-5"
      printf "PCOMP,1,%s,,,,20.0\n+,1,0.5,%.1f,,1,0.25,%.1f\n+,2,1.0,%.1f,,1,0.5,%.1f\n", z0, 30 - theta, -50 - theta, -theta, 90 - theta
      for (i = 0; i <= 4*m; i++) for (j = 0; j <= 2*m; j++) grid(i, j)
      if (m == 2) for (i = 0; i <= 8; i++) for (j = 0; j <= 4; j++) if (i % 2 || j % 2) { # midway between its neighbours
         p = i % 2; q = j % 2; if (p && q) { gx[i, j] = (gx[i - 1, j - 1] + gx[i + 1, j + 1])/2; gy[i, j] = (gy[i - 1, j - 1] + gy[i + 1, j + 1])/2 }
         else { gx[i, j] = (gx[i - p, j - q] + gx[i + p, j + q])/2; gy[i, j] = (gy[i - p, j - q] + gy[i + p, j + q])/2 } }
      for (i = 0; i <= 4*m; i++) for (j = 0; j <= 2*m; j++) if (kind != "CQUAD8" || i % 2 == 0 || j % 2 == 0)
         printf "GRID,%d,,%.6f,%.6f,0.0\n", at[i, j], gx[i, j], gy[i, j]
      for (i = 0; i < 4*m; i += m) for (j = 0; j < 2*m; j += m) {
         a = at[i, j]; b = at[i + m, j]; c = at[i + m, j + m]; d = at[i, j + m]
         if (m == 2) { ab = at[i + 1, j]; bc = at[i + 2, j + 1]; cd = at[i + 1, j + 2]; da = at[i, j + 1]; ac = at[i + 1, j + 1] }
         # the direction 1 of the laminate is x, theta from the side of corners 1 and 2
         turn = atan2(gy[i + m, j] - gy[i, j], gx[i + m, j] - gx[i, j])*180/3.14159265358979; diagonal = atan2(gy[i + m, j + m] - gy[i, j], gx[i + m, j + m] - gx[i, j])*180/3.14159265358979
         if (kind == "CQUAD4") printf "CQUAD4,%d,1,%d,%d,%d,%d,%.9f\n", ++e, a, b, c, d, theta - turn
         if (kind == "CTRIA3") printf "CTRIA3,%d,1,%d,%d,%d,%.9f\nCTRIA3,%d,1,%d,%d,%d,%.9f\n", ++e, a, b, c, theta - turn, ++e, a, c, d, theta - diagonal
         if (kind == "CQUAD8") printf "CQUAD8,%d,1,%d,%d,%d,%d,%d,%d\n+,%d,%d,,,,,%.9f\n", ++e, a, b, c, d, ab, bc, cd, da, theta - turn
         if (kind == "CTRIA6") printf "CTRIA6,%d,1,%d,%d,%d,%d,%d,%d\n+,%.9f\nCTRIA6,%d,1,%d,%d,%d,%d,%d,%d\n+,%.9f\n", ++e, a, b, c, ab, bc, ac, theta - turn, \
            ++e, a, c, d, ac, cd, da, theta - diagonal }
      edge(4*m, 1); edge(0, -1); printf "SPC1,1,2,%d\n", at[4*m, 0]; print "ENDDATA" }' > "$work/$1.bdf"
}
ply_stress() { table "$1" 'STRESSES IN PLIES' | awk -v e="$2" -v p="$3" -v k="$4" '$1 == e && $2 == p && ++n == 2 { print $(3 + k) }'; }
m8='140000 10000 0.3 5000 1e-6 3e-5' m1="70000 70000 0.33 $(number '70000/2.66') 2.3e-5 2.3e-5"
awk -v plies="$m8 0.5 30;$m8 0.25 -50;$m1 1.0 0;$m8 0.5 90" -v load='100 0 0 50 0 0' -v dt=40 -f tests/exact/laminates.awk > "$work/strip.clt"
read -r ex ey exy kx ky kxy < "$work/strip.clt"
for kind in CQUAD4:15:0 CTRIA3:15:0 CQUAD8:45:0 CTRIA6:45:0 CQUAD4:15:25; do
   IFS=: read -r kind corner theta <<< "$kind"
   strip strip_$kind $kind $theta
   run strip_$kind && {
      near "a laminate of $kind: along" "$(moved strip_$kind $corner 1)" "$ex*100 + $exy*20" 3e-5
      near "a laminate of $kind: across" "$(moved strip_$kind $corner 2)" "$ey*20" 3e-5
      near "a laminate of $kind: out of its plane" "$(moved strip_$kind $corner 3)" "-($kx*100^2 + $ky*20^2 + $kxy*100*20)/2" 3e-5
      for ply in 1 2 3 4; do
         read -r -a wanted <<< "$(sed -n "$((ply + 1))p" "$work/strip.clt")"
         for k in 1 2 3; do near "a laminate of $kind: ply $ply, stress $k" "$(ply_stress strip_$kind 3 $ply $k)" "${wanted[k - 1]}" 3e-5 1e-4; done
      done
   }
done
# Z0 = 0: the nodes lie on the lower face; forces at them bend too: N_x = 100 there is M_x = -112.5 more about the mid-plane
strip strip_z0 CQUAD4 0 0.0
awk -v plies="$m8 0.5 30;$m8 0.25 -50;$m1 1.0 0;$m8 0.5 90" -v load='100 0 0 -62.5 0 0' -v dt=40 -f tests/exact/laminates.awk > "$work/strip.clt"
read -r ex ey exy kx ky kxy < "$work/strip.clt"
run strip_z0 && near 'Z0: out of its plane' "$(moved strip_z0 15 3)" "-($kx*100^2 + $ky*20^2 + $kxy*100*20)/2" 3e-5 &&
   near 'Z0: along' "$(moved strip_z0 15 1)" "($ex - 1.125*$kx)*100 + ($exy - 1.125*$kxy)*20" 3e-5

# THETA as a system: its x is the direction from which the plies turn, theta from x; SYM: the plies again in reverse
strip strip_system CQUAD4 25
sed -i -e 's/^\(CQUAD4,.*\),[^,]*$/\1,9/' -e "s/^BEGIN BULK/&\nCORD2R,9,,0.0,0.0,0.0,0.0,0.0,1.0\n+,$(number 'cos(25*3.14159265358979/180)'),$(number 'sin(25*3.14159265358979/180)'),0.0/" "$work/strip_system.bdf"
run strip_system && for c in 1 2 3; do near "THETA as a system, component $c" "$(moved strip_system 15 $c)" "$(moved strip_CQUAD4 15 $c)" 3e-6; done
strip strip_sym CQUAD4 0
sed -i -e '/^PCOMP/s/$/,,SYM/' -e '/^PCOMP/s/,,,,20.0,,SYM/,,,,20.0,,SYM/' "$work/strip_sym.bdf"
awk -v plies="$m8 0.5 30;$m8 0.25 -50;$m1 1.0 0;$m8 0.5 90;$m8 0.5 90;$m1 1.0 0;$m8 0.25 -50;$m8 0.5 30" -v load='100 0 0 50 0 0' -v dt=40 -f tests/exact/laminates.awk > "$work/strip.clt"
read -r ex ey exy kx ky kxy < "$work/strip.clt"
run strip_sym && near 'SYM: along' "$(moved strip_sym 15 1)" "$ex*100 + $exy*20" 3e-5 &&
   near 'SYM: out of its plane' "$(moved strip_sym 15 3)" "-($kx*100^2 + $ky*20^2 + $kxy*100*20)/2" 3e-5
# an edge of second order is held: u = F L/(E A)
cards held_edge <<'DECK'
MODEL = SPACE;SPC = 1;SUBCASE 1;  LOAD = 1;BEGIN BULK;GRID,1,,0.0,0.0,0.0;GRID,2,,20.0,0.0,0.0;GRID,3,,20.0,10.0,0.0;GRID,4,,0.0,10.0,0.0
GRID,5,,10.0,0.0,0.0;GRID,6,,20.0,5.0,0.0;GRID,7,,10.0,10.0,0.0;GRID,8,,0.0,5.0,0.0;CQUAD8,1,1,1,2,3,4,5,6;+,7,8;PSHELL,1,1,2.0,1,,1
MAT1,1,1000.0,,0.0;PMARK,8;CBAR,9,8,4,1;SPCM,1,123456,8
FORCE,1,2,,40.0,0.166666666666667,0.0,0.0;FORCE,1,3,,40.0,0.166666666666667,0.0,0.0;FORCE,1,6,,40.0,0.666666666666667,0.0,0.0;ENDDATA
DECK
run held_edge && for n in 2 3 6; do near "an edge of second order, held: node $n" "$(moved held_edge $n 1)" '40*20/(1000*20)' 3e-6; done

# Cylindrical bending of an unsymmetric sandwich under an end force, P L^3/(3 (D11 - B11^2/A11)) + P L/S; S of the core, G d^2/h nearly
awk 'BEGIN { print "MODEL = SPACE\nSPC = 1\nSUBCASE 1\n  LOAD = 1\nBEGIN BULK\nMAT8,1,70000.0,70000.0,0.0,35000.0,,\nMAT8,2,1.0,1.0,0.0,0.5,50.0,50.0"
   print "PCOMP,1\n+,1,0.5,0.0,,2,20.0,0.0\n+,1,1.0\nSPC1,1,246,1,THRU,22\nSPC1,1,135,1,2\nFORCE,1,21,,5.0,0.0,0.0,1.0\nFORCE,1,22,,5.0,0.0,0.0,1.0"
   for (i = 0; i <= 10; i++) printf "GRID,%d,,%.1f,0.0,0.0\nGRID,%d,,%.1f,10.0,0.0\n", 2*i + 1, 30*i, 2*i + 2, 30*i
   for (i = 0; i < 10; i++) { a = 2*i + 1; printf "CQUAD4,%d,1,%d,%d,%d,%d\n", i + 1, a, a + 2, a + 3, a + 1 }
   print "ENDDATA" }' > "$work/sandwich.bdf"
read -r a11 b11 d11 <<< "$(awk -v plies='70000 70000 0 35000 0 0 0.5 0;1 1 0 0.5 0 0 20 0;70000 70000 0 35000 0 0 1 0' -v load='0 0 0 0 0 0' -v dt=0 -f tests/exact/laminates.awk | tail -n 1)"
run sandwich && near 'a sandwich, bent by an end force' "$(moved sandwich 21 3)" "300^3/(3*($d11 - $b11^2/$a11)) + 300*20/(50*20.75^2)" 1e-3

# laminates_beam TABLE NAME END K: of the forces or stresses in the first beam, at this end, the K-th
laminates_beam() { table "$2" "$1 IN BEAMS" | awk -v end="$3" -v k="$4" '$1 == 1 && ++n == end { print $(2 + k) }'; }
# ---- tapered beams: depth from 40 to 20 over 1000, width 10; tip force, weight, warmth, end forces ----

# I = b h^3/12, h = 40 - 20 s; the stations interpolate A exactly and I between 40, 30, 20 only at 0, 0.5, 1: closed forms of linear I
cards tapered <<'DECK'
MODEL = SPACE;SPC = 1;SUBCASE 1;  LOAD = 1;BEGIN BULK;GRID,1,,0.0,0.0,0.0;GRID,2,,1000.0,0.0,0.0;CBEAM,1,1,1,2,0.0,1.0,0.0
PBEAM,1,1,400.0,8.0+4,4.0+4,,6.0+4,;+,20.0,0.0;+,NO,1.0,200.0,2.0+4,1.0+4,,3.0+4;+,0.0,0.0;MAT1,1,210000.0,,0.3,7.85-9,1.2-5
SPC1,1,123456,1;FORCE,1,2,,1000.0,1.0,1.0,0.0;MOMENT,1,2,,1.0+6,1.0,0.0,0.0;ENDDATA
DECK
# E I v'' = P (L - x), I = I0 (1 - 3 s/4): the integral of (1 - s)^2/(1 - 3 s/4) ds from 0 to 1
run tapered && {
   q=$(awk 'BEGIN { n = 200000; for (i = 0; i < n; i++) { s = (i + 0.5)/n; q += (1 - s)^2/(1 - 0.75*s)/n } printf "%.10f", q }')
   near 'a tapered beam: tip' "$(moved tapered 2 2)" "1000*1000^3/(210000*8e4)*$q" 3e-6
   near 'a tapered beam: along' "$(moved tapered 2 1)" '1000*1000/(210000*400)*2*log(2)' 3e-6
   near 'a tapered beam: twist' "$(table tapered 'ROTATIONS OF REFERENCE NODES' | awk '$1 == 2 { print $2 }')" '1e6*1000/(210000/2.6*6e4)*2*log(2)' 3e-6
   near 'a tapered beam: stress at the support' "$(laminates_beam STRESSES tapered 1 1)" '1000/400 - 1e6*20/8e4' 3e-6
   near 'a tapered beam: stress at the tip' "$(laminates_beam STRESSES tapered 2 5)" '1000/200' 3e-6
}
# its weight: A linear, so that q = 400 (1 - s/2) rho g; the moment at x is the integral of q (xi - x)
sed -e 's/^FORCE.*/GRAV,1,,9810.0,0.0,1.0,0.0/' -e '/^MOMENT/d' "$work/tapered.bdf" > "$work/tapered_weight.bdf"
run tapered_weight && {
   q=$(awk 'BEGIN { n = 20000; for (i = 0; i < n; i++) { s = (i + 0.5)/n; t = 1 - s; m = t^2/2 - (s*t^2/4 + t^3/6); q += m*(1 - s)/(1 - 0.75*s)/n } printf "%.10f", q }')
   near 'a tapered beam: its weight bends it' "$(moved tapered_weight 2 2)" "400*7.85e-9*9810*1000^4/(210000*8e4)*$q" 1e-5
   near 'a tapered beam: its weight' "$(total tapered_weight 'SUPPORTS' 2)" '-300*1000*7.85e-9*9810' 3e-6
}
# held and warm: N = -E alpha dT L/(integral of dx/A)
sed -e 's/^  LOAD = 1/  TEMPERATURE(LOAD) = 5/' -e '/^FORCE/d' -e '/^MOMENT/d' -e 's/^SPC1.*/&\nSPC1,1,12345,2/' -e 's/^ENDDATA/TEMPD,5,50.0\n&/' "$work/tapered.bdf" > "$work/tapered_warm.bdf"
run tapered_warm && near 'a tapered beam, held and warm' "$(laminates_beam FORCES tapered_warm 1 1)" '-210000*1.2e-5*50*400/(2*log(2))' 3e-6
# a station in the middle, and the same beam as two
sed -e 's/^+,20.0,0.0/&\n+,NO,0.4,250.0,5.0+4,2.0+4,,4.0+4/' "$work/tapered.bdf" > "$work/stations.bdf"
sed -e 's/^CBEAM.*/CBEAM,1,1,1,3,0.0,1.0,0.0\nCBEAM,2,2,3,2,0.0,1.0,0.0\nGRID,3,,400.0,0.0,0.0\nPBEAM,2,1,250.0,5.0+4,2.0+4,,4.0+4\n+\n+,NO,1.0,200.0,2.0+4,1.0+4,,3.0+4\n+,0.0,0.0/' \
   "$work/tapered.bdf" | awk '/^PBEAM,1,/ { first = 1 } first && /^\+,NO/ { print "+,NO,1.0,250.0,5.0+4,2.0+4,,4.0+4"; first = 0; next } { print }' > "$work/chain.bdf"
run stations && run chain && for c in 1 2; do near "stations and a chain of beams: $c" "$(moved stations 2 $c)" "$(moved chain 2 $c)" 3e-6; done
# PBEAML: a BAR from 10 x 40 to 10 x 20 has the areas and moments of its ends
cards tapered_bar <<'DECK'
MODEL = SPACE;SPC = 1;SUBCASE 1;  LOAD = 1;BEGIN BULK;GRID,1,,0.0,0.0,0.0;GRID,2,,1000.0,0.0,0.0;CBEAM,1,1,1,2,0.0,1.0,0.0
PBEAML,1,1,,BAR;+,10.0,40.0,,YES,1.0,10.0,20.0;MAT1,1,210000.0,,0.3;SPC1,1,123456,1;FORCE,1,2,,1000.0,1.0,0.0,0.0;ENDDATA
DECK
run tapered_bar && near 'PBEAML with a station' "$(moved tapered_bar 2 1)" '1000*1000/(210000*400)*2*log(2)' 3e-6
# point loads along beams: on a tapered one without torsional stiffness a torque passes to the ends as a lever has it; v by the unit force
sed -e 's/,,6.0+4,/,,,/; s/,,3.0+4/,,/; /^MOMENT/d; s/^FORCE.*/PLOAD1,1,1,FY,FR,0.5,1000.0\nPLOAD1,1,1,MX,FR,0.25,8000.0/; s/^SPC1.*/&\nSPC1,1,4,2/' "$work/tapered.bdf" > "$work/tapered_point.bdf"
run tapered_point && {
   q=$(awk 'BEGIN { n = 200000; for (i = 0; i < n; i++) { s = (i + 0.5)/n/2; q += (0.5 - s)*(1 - s)/(1 - 0.75*s)/n/2 } printf "%.10f", q }')
   near 'a tapered beam: a force along it' "$(moved tapered_point 2 2)" "1000*1000^3/(210000*8e4)*$q" 3e-6
   near 'a tapered beam: a torque along it' "$("$query" "$work/tapered_point.reaction.csv" rows 'x = 1000 within 1e-6' print moment_x)" -2000 1e-6
}
cards point_loads <<'DECK'
MODEL = SPACE;SPC = 1;SUBCASE 1;  LOAD = 1;BEGIN BULK;GRID,1,,0.0,0.0,0.0;GRID,2,,1000.0,0.0,0.0;CBAR,1,1,1,2,0.0,1.0,0.0
PBAR,1,1,400.0,8.0+4,4.0+4,6.0+4;MAT1,1,210000.0,,0.3;SPC1,1,123456,1;PLOAD1,1,1,FY,LE,400.0,1000.0;PLOAD1,1,1,MX,FR,0.25,1.0+6;ENDDATA
DECK
run point_loads && {
   near 'a force along a bar' "$(moved point_loads 2 2)" '1000*400^2*(3*1000 - 400)/(6*210000*8e4)' 3e-6
   near 'a torque along a bar' "$(table point_loads 'ROTATIONS OF REFERENCE NODES' | awk '$1 == 2 { print $2 }')" '1e6*250/(210000/2.6*6e4)' 3e-6
}

# ---- a material that expands along 2 alone, mass by NSM alone, and gravity beside another load without any mass
laminates_sheet() { # NAME CASE CARDS
   printf '%b\n' "SPC = 1\n$2\nBEGIN BULK" 'GRID,1,,0.0,0.0,0.0\nGRID,2,,10.0,0.0,0.0\nGRID,3,,10.0,10.0,0.0\nGRID,4,,0.0,10.0,0.0\nCQUAD4,1,1,1,2,3,4' \
      'SPC1,1,123456,1\nSPC1,1,23456,2\nSPC1,1,3456,3,4\nSPC1,1,1,4' "$3" ENDDATA > "$work/$1.bdf"
   run "$1"
}
laminates_sheet expands_along_2 'MODEL = SPACE\nTEMPERATURE = 2' 'PSHELL,1,1,0.5,1\nMAT8,1,1.0+4,2.0+4,0.2,5.0+3\n,0.0,3.0-5\nTEMPD,2,100.0' && {
   near 'expansion along 2 alone' "$(moved expands_along_2 3 2)" '3e-5*100*10' 1e-6
   near 'expansion along 2 alone: none along 1' "$(moved expands_along_2 3 1)" 0 0 1e-12
}
laminates_sheet nsm_weight 'MODEL = SPACE\nLOAD = 1' 'PSHELL,1,1,0.5,1,,,,3.0-3\nMAT1,1,1.0+4,,0.0\nGRAV,1,,1000.0,1.0' &&
   near 'weight of NSM alone' "$(total nsm_weight LOADS 1)" '3e-3*100*1000' 1e-9
laminates_sheet no_weight 'LOAD = 1' 'PSHELL,1,1,0.5\nMAT1,1,1.0+4,,0.0\nGRAV,1,,1000.0,1.0\nFORCE,1,2,,10.0,1.0\nFORCE,1,3,,10.0,1.0' && {
   near 'gravity without mass beside forces' "$(moved no_weight 2 1)" '20*10/(1e4*0.5*10)' 1e-6
   says 'gravity without mass' "$work/no_weight.log" 'GRAV (.*) has no effect: no body has a mass'
}
