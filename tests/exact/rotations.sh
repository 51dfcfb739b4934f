# Rotations of reference nodes in the listing: moments at supports, and the bodies condensed on a joint that hangs on one node.

# ---- moments: a bar clamped at the reference node of its end has, by statics, the moment of its loads about that node ----

# clamped NAME Z CARDS: a model without a joint, held at node 900 at (-3, 4, Z)
clamped() {
   printf 'SPC = 1\nSUBCASE 1\n  LOAD = 10\n  INCR = 5\nBEGIN BULK\nMAT1,1,9500.0,,0.25\nPMARK,20\nGRID,900,,-3.0,4.0,%s\n%b\nJINCR,5,2\nENDDATA\n' "$2" "$3" > "$work/$1.bdf"
   run "$1"
}
# moment NAME C: component C of the last moment at node 900
moment() { table "$1" 'MOMENTS AT SUPPORTS' | awk -v c="$2" '$1 == 900 { v = $(1 + c) } END { print v }'; }

clamped plane 0.0 'BLOCK2,1,1,4,2,0.0,0.0\n+,40.0,10.0\n+,,,,20\nPSHELL,1,1,2.0\nRBE2,50,900,126,1,2,3\nSPC1,1,126,900
FORCE,10,13,,7.0,0.0,-1.0\nFORCE,10,15,,3.0,1.0,0.0' && {
   # the loads -7 along y at (40, 0) and 3 along x at (40, 10) turn by -7 (40 + 3) - 3 (10 - 4); the support turns back
   near 'moment at a support in the plane' "$(moment plane 1)" '7*43 + 3*6' 2e-6
   same 'in the plane: one support that takes a moment' "$(table plane 'MOMENTS AT SUPPORTS, STAGE 1, INCREMENT 2' | grep -c '^ *900 ')" 1
}
clamped space 5.0 'BLOCK3,1,1,3,1,1,0.0,0.0,0.0\n+,30.0,10.0,10.0\n+,20\nPSOLID,1,1\nRBE2,50,900,123456,1,2,3,4\nSPC1,1,123456,900
FORCE,10,13,,2.0,1.0,0.0,0.0\nFORCE,10,16,,5.0,0.0,1.0,0.0\nFORCE,10,16,,7.0,0.0,0.0,-1.0' && {
   # r x F of (2, 0, 0) at (33, -4, -5) and of (0, 5, -7) at (33, 6, 5) from the node
   near 'moment at a support in space, about x' "$(moment space 1)" '-(6*(-7) - 5*5)' 2e-6
   near 'about y' "$(moment space 2)" '-((-5)*2 + 33*7)' 2e-6
   near 'about z' "$(moment space 3)" '-(4*2 + 33*5)' 2e-6
}

# ---- [k_b] condensed: one bilinear element, w wide, h high, t thick, nu = 0, clamped on top; its lower side is rigid ----

# The lower side moves by a along x, b along y and turns by r about its middle: energy of u = (1 - y/h) (a, b + r (x - w/2)).
w=8 h=5 t=2 e=9500 g=4750
cards condensed <<DECK
SPC = 1;SUBCASE 1;  LOAD = 10;  INCR = 5;  OUTPUT = LAST, CONDENSED
BEGIN BULK;BLOCK2,1,1,1,1,0.0,0.0;+,$w.0,$h.0;+,20;PMARK,20;PSHELL,1,1,$t.0;MAT1,1,$e.0,,0.0;GRID,900,,4.0,0.0
RBE2,50,900,126,1,3;JOINT,1,1,20;PJOINT,1,1,,,,,0.5;JNORM,1,8.0-3,0.5;SPC1,1,12,2,4;FORCE,10,900,,100.0,0.0,-1.0
MOMENT,10,900,,30.0,0.0,0.0,1.0;JINCR,5,2;ENDDATA
DECK
# entry NAME K: column K of the row that is called NAME in the condensed stiffness; share NAME K: in the load
entry() { table condensed '[K_B] CONDENSED' | awk -v name="$1" -v k="$2" '$1 == name { print $(k + 1) }'; }
share() { table condensed 'LOAD CONDENSED' | awk -v name="$1" -v k="$2" '$1 == name { print $(k + 1) }'; }
run condensed && {
   near 'condensed: shear' "$(entry 900X 1)" "$g*$t*$w/$h" 1e-5
   near 'condensed: compression' "$(entry 900Y 2)" "$e*$t*$w/$h" 1e-5
   near 'condensed: rotation' "$(entry 900RZ 3)" "$e*$t*$w^3/(12*$h) + $g*$t*$w*$h/3" 1e-5
   near 'condensed: shear by rotation' "$(entry 900X 3)" "-$g*$t*$w/2" 1e-5
   near 'condensed: rotation by shear' "$(entry 900RZ 1)" "-$g*$t*$w/2" 1e-5
   near 'condensed: nothing between' "abs($(entry 900Y 1)) + abs($(entry 900Y 3))" 0 0 1e-6
   near 'condensed: force' "$(share 900Y 2)" -100 1e-5
   near 'condensed: moment' "$(share 900RZ 3)" 30 1e-5
}

# A body beside it that hangs on springs alone changes nothing
sed -e 's/^GRID,900.*/&\nBLOCK2,2,1,1,1,20.0,0.0\n+,28.0,5.0,,,,,101,101\nCELAS2,90,50.0,101,1\nCELAS2,91,50.0,101,2\nCELAS2,92,50.0,103,2/' "$work/condensed.bdf" > "$work/hangs.bdf"
sed -i 's/^SPC = 1/&\nSOLVER = SKYLINE/' "$work/hangs.bdf"
run hangs && same 'condensed: with a body on springs beside it' "$(table hangs '[K_B] CONDENSED')" "$(table condensed '[K_B] CONDENSED')"

# A mean movement names components that a plane model has not: they are no equations
for components in 126 123456; do
   printf 'SPC = 1\nSUBCASE 1\n  LOAD = 10\n  INCR = 5\nBEGIN BULK\nMAT1,1,9500.0,,0.25\nGRID,900,,45.0,4.0\nBLOCK2,1,1,4,2,0.0,0.0\n+,40.0,10.0\nPSHELL,1,1,2.0
SPC1,1,12,1,2,3\nRBE3,51,,900,%s,1.0,12,13,14\n+,15\nFORCE,10,900,,7.0,3.0,-1.0\nMOMENT,10,900,,30.0,0.0,0.0,1.0\nJINCR,5,2\nENDDATA\n' $components > "$work/mean_$components.bdf"
   run mean_$components
done
same 'RBE3 in the plane: components of space alone change nothing' "$(table mean_123456 'DISPLACEMENTS OF NODES')" "$(table mean_126 'DISPLACEMENTS OF NODES')"
holds 'and the reference node moves' "abs($(table mean_126 'DISPLACEMENTS OF NODES' | awk '$1 == 900 { v = $5 } END { print v }')) > 1e-6"

# What is too large to be condensed as a full matrix is said, and by how much
sed -e 's/\b900\b/9000/g; s/^SPC = 1/SOLVER = SKYLINE\n&/; s/^BLOCK2,1,1,1,1,/BLOCK2,1,1,3,400,/; s/^RBE2.*/RBE2,5000,9000,126,1,402,803,1204/; s/^SPC1,1,12,2,4/SPC1,1,12,401,802,1203,1604/' "$work/condensed.bdf" > "$work/many.bdf"
run many && says 'too much to condense' "$work/many.out" 'NOT PRINTED, 3195 EQUATIONS ARE LEFT, MORE THAN 3000; SOLVER = TREE LEAVES FEWER$'

# One unknown alone is condensed: a node between two springs in a row adds 1/(1/300 + 1/700) along y
sed 's/^GRID,900.*/&\nGRID,901,,4.0,-9.0\nCELAS2,91,300.0,900,2,901,2\nCELAS2,92,700.0,901,2\nSPC1,1,1,901/' "$work/condensed.bdf" > "$work/condensed_chain.bdf"
run condensed_chain &&
   near 'condensed: one unknown' "$(table condensed_chain '[K_B] CONDENSED' | awk '$1 == "900Y" { print $3 }')" "$e*$t*$w/$h + 210" 1e-5
