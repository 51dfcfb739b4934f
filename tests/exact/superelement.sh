# Structures condensed on some of their nodes, as DMIG cards: closed forms, rigid-body motions, and the matrices read back in place of the
# structure.

# superelement_matrix NAME MATRIX: the terms of a matrix of NAME.dmig, symmetric ones both, as 'row component column component value'
superelement_matrix() { awk -v name="$2" '/^DMIG\*/ { split(substr($0, 9), f, " "); on = f[1] == name; g = substr($0, 25, 16) + 0; c = substr($0, 41, 16) + 0; next }
   /^DMIG / { on = 0; next } /^\*/ && on { v = substr($0, 41, 16); sub(/D/, "E", v); r = substr($0, 9, 16) + 0; q = substr($0, 25, 16) + 0
      print r, q, g, c, v + 0 ; if (r != g || q != c) print g, c, r, q, v + 0 }' OFMT=%.17g CONVFMT=%.17g "$work/$1.dmig"; }
superelement_term() { superelement_matrix "$1" "$2" | awk -v a="$3 $4 $5 $6 " 'index($0 " ", a) == 1 { print $5 }'; }

# ---- a cantilever of four beams condensed on two nodes: stiffness of two beams of length 200, no shear
superelement_beams() { # NAME CASE CARDS
   printf '%b\n' "$2\nBEGIN BULK" 'GRID,1,,0.0,0.0,0.0\nGRID,2,,100.0,0.0,0.0\nGRID,3,,200.0,0.0,0.0\nGRID,4,,300.0,0.0,0.0\nGRID,5,,400.0,0.0,0.0' \
      'CBAR,1,1,1,2,0.0,0.0,1.0\nCBAR,2,1,2,3,0.0,0.0,1.0\nCBAR,3,1,3,4,0.0,0.0,1.0\nCBAR,4,1,4,5,0.0,0.0,1.0' \
      'PBAR,1,1,100.0,800.0,900.0,1500.0\nMAT1,1,2.1E5,,0.3,7.85E-9\nSPC1,1,123456,1' "$3" 'ENDDATA' > "$work/$1.bdf"
   run "$1" "${4:-0}"
}
superelement_beams guyan 'SPC = 1\nOUTPUT = LAST, DMIG\nLOAD = 10' 'FORCE,10,5,,10.0,1.0,2.0,3.0\nASET1,123456,3,5' && {
   near 'axial' "$(superelement_term guyan KAAX 3 1 3 1)" '2*2.1E5*100/200' 1e-12
   near 'bending' "$(superelement_term guyan KAAX 5 3 5 3)" '12*2.1E5*800/200^3' 1e-10
   near 'bending, coupled' "$(superelement_term guyan KAAX 5 3 5 5)" '6*2.1E5*800/200^2' 1e-10
   near 'torsion' "$(superelement_term guyan KAAX 5 4 3 4)" '-2.1E5/2.6*1500/200' 1e-10
   near 'no rotary inertia lost: mass along x of a linear displacement' "$(superelement_term guyan MAAX 5 1 5 1)" '7.85E-9*100*200/3' 1e-10
   says 'the listing' "$work/guyan.out" 'STIFFNESS KAAX AND MASS MAAX, CONDENSED ON 12 COMPONENTS OF NODES: DMIG CARDS'
   same 'the header: symmetric, real double precision' "$(grep -c '^DMIG    [KM]AAX           0       6       2       0$' "$work/guyan.dmig")" 2
}
superelement_beams of_four 'SPC = 1\nOUTPUT = LAST, DMIG\nLOAD = 10' 'FORCE,10,5,,10.0,1.0,2.0,3.0\nASET,3,123456,5,123,0,0,5,456' &&
   same 'ASET, pairs of a node and components, as ASET1' "$(cmp "$work/guyan.dmig" "$work/of_four.dmig" && echo so)" so

# ---- a free block, with a joint or a rigid foot of rotations: no force under rigid-body motions, the mass of the whole
# superelement_block NAME CASE CARDS: 3 x 2 x 2 bricks, 30 x 20 x 20; node 1 + ix + 4 iy + 12 iz
superelement_block() {
   {
      printf '%b\n' "MODEL = SPACE\n$2\nBEGIN BULK"
      awk 'BEGIN { for (z = 0; z < 3; z++) for (y = 0; y < 3; y++) for (x = 0; x < 4; x++) print "GRID," 1 + x + 4*y + 12*z ",," 10.0*x "," 10.0*y "," 10.0*z
         for (z = 0; z < 2; z++) for (y = 0; y < 2; y++) for (x = 0; x < 3; x++) { n = 1 + x + 4*y + 12*z
            print "CHEXA," 1 + x + 3*y + 6*z ",1," n "," n + 1 "," n + 5 "," n + 4 "," n + 12 "," n + 13; print "+," n + 17 "," n + 16 } }'
      printf '%b\n' 'PSOLID,1,1\nMAT1,1,2.1E5,,0.3,7.85E-9' "$3" ENDDATA
   } > "$work/$1.bdf"
   run "$1" "${4:-0}"
}
superelement_corners='ASET1,123,1,4,9,12,25,28\nASET1,123,33,36'
superelement_rigid() { # NAME MASS: forces and mass of unit translations
   local c
   superelement_matrix "$1" KAAX > "$work/$1.k"
   superelement_matrix "$1" MAAX > "$work/$1.m"
   for c in 1 2 3; do
      near "$1: force of translation $c" "$(awk -v c=$c '{ f[$1 " " $2] += $4 == c ? $5 : 0; k = k > $5 ? k : $5 }
         END { for (i in f) w = f[i]^2 > w ? f[i]^2 : w; print sqrt(w)/k }' "$work/$1.k")" 0 0 1e-9
      near "$1: mass along $c" "$(awk -v c=$c '$2 == c && $4 == c { m += $5 } END { printf "%.17g", m }' "$work/$1.m")" "$2" 1e-9
   done
}
superelement_block free 'METHOD = 5\nOUTPUT = NONE, DMIG' "EIGRL,5,,,12\n$superelement_corners" && {
   superelement_rigid free '7.85E-9*30*20*20'
   # a turn about z: u = (-y, x, 0)
   near 'free: force of a turn' "$(awk 'function at(n) { n--; x = 10*(n % 4); y = 10*(int(n/4) % 3) }
      { at($3); u = $4 == 1 ? -y : $4 == 2 ? x : 0; f[$1 " " $2] += $5*u; k = k > $5 ? k : $5 }
      END { for (i in f) w = f[i]^2 > w ? f[i]^2 : w; print sqrt(w)/(30*k) }' "$work/free.k")" 0 0 1e-9
   same 'free: coordinates of the modes behind the nodes' "$(grep SPOINT "$work/free.dmig" | tr -s ' ')" 'SPOINT 37 THRU 48'
}
superelement_block named 'METHOD = 5\nOUTPUT = NONE, DMIG' "EIGRL,5,,,12\n$superelement_corners\nSPOINT,101,THRU,112\nQSET1,0,101,THRU,112" &&
   same 'QSET1: coordinates of the modes, by their numbers' "$(superelement_matrix named KAAX | awk '$1 > 100 { $1 -= 64; $3 -= 64 } 1')" \
      "$(superelement_matrix free KAAX)"
superelement_block loose 'METHOD = 5\nOUTPUT = NONE, DMIG' 'EIGRL,5,,,12\nASET1,1,1' 3 > /dev/null &&
   says 'ASET that holds a free body in one direction' "$work/loose.log" 'increment 1: OUTPUT = DMIG, with the components of ASET held: .* mechanism'

# ---- read back: nodes and DMIG in place of the block, statics and modes as of the whole; held at four corners, loaded at the others
superelement_held='SPC1,1,123,1,9,25,33'
superelement_force='FORCE,10,28,,1.0,3.0,1.0,-2.0\nFORCE,10,4,,1.0,0.0,5.0,1.0'
superelement_back() { # NAME CASE CARDS: the corners, the DMIG cards of free
   {
      printf '%b\n' "MODEL = SPACE\nK2GG = 0.75*KAAX, .25*KAAX\nM2GG = MAAX\n$2\nBEGIN BULK"
      awk 'BEGIN { for (z = 0; z < 3; z += 2) for (y = 0; y < 3; y += 2) for (x = 0; x < 4; x += 3)
         print "GRID," 1 + x + 4*y + 12*z ",," 10.0*x "," 10.0*y "," 10.0*z }'
      cat "$work/free.dmig"
      printf '%b\n' "$3" ENDDATA
   } > "$work/$1.bdf"
   run "$1" "${4:-0}"
}
superelement_case='SPC = 1\nLOAD = 10\nSET 7 = 4,12,28,36\nWATCH = SET 7\nMETHOD = 6\nSUBCASE 1\n'
superelement_moved() { awk -F, -v node=$2 -v c=$(($3 + 5)) 'NR > 1 && $2 == node { print $c }' "$work/$1.watch.csv"; } # NAME NODE COMPONENT
superelement_block whole "$superelement_case" "$superelement_held\n$superelement_force\nEIGRL,6,,,4" &&
   superelement_back back "$superelement_case" "$superelement_held\n$superelement_force\nEIGRL,6,,,4" && {
   for node in 4 12 28 36; do
      for c in 1 2 3; do near "read back: node $node along $c" "$(superelement_moved back $node $c)" "$(superelement_moved whole $node $c)" 1e-8; done
   done
   for j in 1 2 3 4; do near "read back: mode $j" "$(mode back $j frequency)" "$(mode whole $j frequency)" 1e-3; done
}

# ---- QSET beside nodes with rotations: a cantilever condensed on its end, read back: its deflection, its modes
superelement_turned() { table "$1" 'ROTATIONS OF REFERENCE NODES' | awk -v node="$2" -v c="$3" '$1 == node { v = $(1 + c) } END { print v }'; } # NAME NODE C
superelement_beams rotating 'SPC = 1\nOUTPUT = NONE, DMIG\nMETHOD = 5' 'EIGRL,5,,,8\nASET1,123456,5\nSPOINT,101,THRU,108\nQSET1,0,101,THRU,108' && {
   near 'QSET: the stiffness of the end' "$(superelement_term rotating KAAX 5 3 5 3)" '12*2.1E5*800/400^3' 1e-9
   near 'QSET: no stiffness between the end and a mode' "$(superelement_matrix rotating KAAX | awk '($1 == 5) != ($3 == 5) { w += $5^2 } END { print sqrt(w) }')" 0 0 1e-9
   superelement_ends='SET 7 = 5\nWATCH = SET 7\nSPC = 1\nLOAD = 10\nMETHOD = 6\nSUBCASE 1\n'
   superelement_end_load='FORCE,10,5,,10.0,1.0,2.0,3.0\nMOMENT,10,5,,100.0,1.0,-2.0,0.5\nEIGRL,6,,,4'
   superelement_beams end_whole "$superelement_ends" "$superelement_end_load"
   printf '%b\n' "MODEL = SPACE\nK2GG = KAAX\nM2GG = MAAX\n${superelement_ends/SPC = 1\\n/}BEGIN BULK\nGRID,5,,400.0,0.0,0.0\nSPOINT,101,THRU,108" "$superelement_end_load" > "$work/end_back.bdf"
   { cat "$work/rotating.dmig"; echo ENDDATA; } >> "$work/end_back.bdf"
   run end_back && for c in 1 2 3; do
      near "a node with rotations read back: along $c" "$(moved end_back 5 $c)" "$(moved end_whole 5 $c)" 3e-6
      near "a node with rotations read back: about $c" "$(superelement_turned end_back 5 $c)" "$(superelement_turned end_whole 5 $c)" 3e-6
   done
   for j in 1 2 3 4; do near "a node with rotations read back: mode $j" "$(mode end_back $j frequency)" "$(mode end_whole $j frequency)" 1e-3; done
}

# ---- a block on a joint: condensed on the node that moves its top, in series with the block: the slope of unloading, or the tangent under load
superelement_on_joint() { # NAME EXPONENT LOAD [STIFFNESS]
   printf '%b\n' "MODEL = SPACE\nMETHOD = NEWTON\nSUBCASE 1\n  LOAD = 10\n  OUTPUT = LAST, DMIG\n${4:+  STIFFNESS = $4\n}BEGIN BULK" \
      'BLOCK3,1,1,2,2,2,0.0,0.0,0.0\n+,10.0,10.0,20.0\n+,,,,,5,6\nPSOLID,1,1\nMAT1,1,1000.0,,0.0,1.0-6\nPMARK,5\nPMARK,6\nGRID,90,,5.0,5.0,20.0\nRBE2M,9,90,123456,6' \
      "JOINT,1,1,5\nPJOINT,1,1,1,1\nJNORM,1,0.02,$2,400.0\nJSHEAR,1,100.0\nFORCE,10,90,,$3,0.0,0.0,-1.0\nASET1,123,90\nENDDATA" > "$work/$1.bdf"
   run "$1"
}
superelement_on_joint joint_line 1.0 500.0 &&
   near 'a joint: its slope of unloading in series' "$(superelement_term joint_line KAAX 90 3 90 3)" '1/(20/(1000*100) + 1/(400*100))' 1e-8
superelement_on_joint joint_bent 0.5 500.0 LOAD && # d lambda/dp = m c p^(m - 1), p = 5
   near 'a joint that stiffens: its tangent in series' "$(superelement_term joint_bent KAAX 90 3 90 3)" '1/(20/(1000*100) + 0.5*0.02*5^(-0.5)/100)' 1e-6

# ---- the parts of a deck: a cantilever with the nodes 1 to 5 in two parts that share node 3, which the main bulk data have too
superelement_parts() { # NAME NODE: the second part has NODE for node 3
   printf '%b\n' 'SOL 103\nCEND\nSPC = 1\nMETHOD = 6\nLOAD = 10\nSUPER = ALL\nSET 7 = 5\nWATCH = SET 7\nBEGIN BULK' \
      'EIGRL,6,,,2\nPARAM,COUPMASS,1\nSEBULK,1,PRIMARY\nSEBULK,2,PRIMARY\nSECONCT,1,0\n,3,3\nGRID,3,,200.0,0.0,0.0\nFORCE,10,5,,10.0,0.0,0.0,1.0' \
      'BEGIN SUPER = 1\nGRDSET,,,,,,,24\nGRID,1,,0.0,0.0,0.0\nGRID,2,,100.0,0.0,0.0\nGRID,3,,200.0,0.0,0.0\nSPC1,1,123456,1' \
      'PBAR,1,1,100.0,800.0,900.0,1500.0\nMAT1,1,2.1E5,,0.3,7.85E-9\nCBAR,1,1,1,2,0.0,0.0,1.0\nCBAR,2,1,2,3,0.0,0.0,1.0' \
      'begin bulk super 2\nGRDSET  ,,,,,,,24\nGRID*,'$2',,200.0,0.0\n*,0.0\nINCLUDE '"'halves\\\\two.inc'" \
      "PBAR,1,1,100.0,800.0,900.0,1500.0\nMAT1,1,2.1E5,,0.3,7.85E-9\nCBAR,3,1,$2,4,0.0,0.0,1.0\nCBAR,4,1,4,5,0.0,0.0,1.0\n${3-}\nENDDATA" > "$work/$1.bdf"
   run "$1" "${4:-0}"
}
mkdir -p "$work/halves"
printf 'GRID,4,,300.0,0.0,0.0\nGRID,5,,400.0,0.0,0.0\n' > "$work/halves/two.inc"
superelement_parts parts 3 && {
   near 'parts: the deflection' "$(moved parts 5 3)" '10*400^3/(3*2.1E5*800)' 1e-5
   near 'parts: the first mode' "$(mode parts 1 frequency)" '1.8751041^2/(2*pi*400^2)*sqrt(2.1E5*800/(7.85E-9*100))' 1e-4
   says 'parts: one structure' "$work/parts.log" 'BEGIN SUPER: 2 parts and the main bulk data are one structure, in one numbering; nothing is reduced'
}
superelement_parts parts_tied 13 'RBE2,99,3,1356,13' && {
   near 'parts tied by RBE2: the deflection' "$(moved parts_tied 5 3)" '10*400^3/(3*2.1E5*800)' 1e-5
   says 'nodes at one place' "$work/parts_tied.log" '1 pair of nodes of two parts at one place are not joined, the first 3 and 13'
}
# other numbers in the second part: joined by their place, or by SECONCT, one pair or ranges
superelement_parts parts_placed 13 && {
   near 'parts joined by place: the deflection' "$(moved parts_placed 5 3)" '10*400^3/(3*2.1E5*800)' 1e-5
   near 'parts joined by place: the first mode' "$(mode parts_placed 1 frequency)" "$(mode parts 1 frequency)" 1e-12
   says 'nodes at one place' "$work/parts_placed.log" '1 pair of nodes of two parts at one place, the first 3 and 13, are one node each'
}
for pairs in 13,3 13,THRU,13,3,THRU,3; do
   superelement_parts parts_joined 13 > /dev/null
   sed -i "s/^SEBULK,2,PRIMARY/SEBULK,2,PRIMARY,,MANUAL\nSECONCT,2,0\n,$pairs/" "$work/parts_joined.bdf"
   run parts_joined && near "parts joined by SECONCT $pairs: the first mode" "$(mode parts_joined 1 frequency)" "$(mode parts 1 frequency)" 1e-12
done
superelement_parts parts_apart 13 '' > /dev/null; sed -i 's/^SEBULK,2,PRIMARY/SEBULK,2,PRIMARY,,MANUAL/' "$work/parts_apart.bdf"
run parts_apart 3 && says 'MANUAL keeps nodes at one place apart' "$work/parts_apart.log" '13 at 3: the bodies come apart there'

# ---- what cannot be
superelement_beams bare 'SPC = 1\nOUTPUT = LAST, DMIG\nLOAD = 10' 'FORCE,10,5,,10.0,1.0,2.0,3.0' 2 && says 'no ASET' "$work/bare.log" 'DMIG needs ASET'
superelement_beams held 'SPC = 1\nOUTPUT = LAST, DMIG\nLOAD = 10' 'FORCE,10,5,,10.0,1.0,2.0,3.0\nASET1,123456,1' 2 &&
   says 'a supported node' "$work/held.log" 'component 1 of node 1 is supported'
superelement_beams nameless 'SPC = 1\nK2GG = KBB\nLOAD = 10' 'FORCE,10,5,,10.0,1.0,2.0,3.0' 2 && says 'no DMIG' "$work/nameless.log" 'there is no DMIG KBB'

# ASET of one component that is not the first: 300 + 150 without the other node, whose spring follows: 450 - 150^2/450 = 400
cards aset_third <<'DECK'
MODEL = SPACE;OUTPUT = LAST, DMIG;BEGIN BULK;GRID,1;GRID,2,,10.,0.,0.;CELAS2,1,100.,1,1;CELAS2,2,200.,1,2;CELAS2,3,300.,1,3
CELAS2,4,150.,1,3,2,3;CELAS2,6,100.,2,1;CELAS2,7,200.,2,2;CELAS2,8,300.,2,3;ASET,1,3;ENDDATA
DECK
run aset_third && same 'ASET, component 3: one term' "$(awk '/^DMIG\*.*KAAX/ { getline; print $2, $3, $4 }' "$work/aset_third.dmig")" '1 3 4.0D2'
