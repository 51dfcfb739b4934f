# Solids, bodies of revolution, distributed loads and prescribed displacements: joints in space and round an axis against what
# is known of them.

# ---- tools ----

# pressed_evenly WORDS NAME P A_INT: every pressure of the last increment is P, the areas add up to A_INT
pressed_evenly() {
   ask "$1" "$2" rows 'stage = max(stage)' rows 'increment = max(increment)' all "pressure = $3 within 1e-10*$3" all "sum(area) = $4 within 1e-12*$4"
}

# The mesh of a box, 0 to 60 x 0 to 40 x 0 to 30, 3 x 2 x 2 cells, GRIDs 1 to 36 (x fastest, then y, then z), skewed inside and on the
# lower and upper faces: as HEXA, PENTA (2 a cell) or TETRA (6 a cell). The lower face is marked 20, the upper one 23 (cards CQUAD4, CTRIA3).
# TURN: degrees about z, then about x, then about y.
box_mesh() { # KIND SKEW [TURN]
   awk -v kind="$1" -v skew="$2" -v turn="${3:-0 0 0}" '
      function node(i, j, k) { return 1 + i + 4 * j + 12 * k }
      function element(kind, list) { print "C" kind "," ++e ",1," list }
      function face(list, mark,   n) { n = split(list, g, ","); print (n == 4 ? "CQUAD4," : "CTRIA3,") ++f "," mark "," list }
      function penta(a, b, c, d, p, q) { element("PENTA", a "," b "," c "," d "," p "," q) }
      BEGIN {
         pi = atan2(0, -1); split(turn, t, " "); for (m = 1; m <= 3; m++) { c[m] = cos(t[m] * pi / 180); s[m] = sin(t[m] * pi / 180) }
         for (k = 0; k <= 2; k++) for (j = 0; j <= 2; j++) for (i = 0; i <= 3; i++) {
            x = 20 * i; y = 20 * j; z = 15 * k
            if (i % 3) x += skew * (1 + j - 2 * k); if (j % 2) y += skew * (i - 1.3 + k); if (k % 2) z += skew * (1 - i + j)
            u = c[1] * x - s[1] * y; v = s[1] * x + c[1] * y; w = z
            y = c[2] * v - s[2] * w; z = s[2] * v + c[2] * w
            x = c[3] * u + s[3] * z; z = -s[3] * u + c[3] * z
            printf "GRID,%d,,%.14f,%.14f,%.14f\n", node(i, j, k), x, y, z
         }
         f = 1000
         for (k = 0; k < 2; k++) for (j = 0; j < 2; j++) for (i = 0; i < 3; i++) {
            a = node(i, j, k); b = node(i + 1, j, k); d = node(i + 1, j + 1, k); g4 = node(i, j + 1, k)
            A = a + 12; B = b + 12; D = d + 12; G = g4 + 12
            if (kind == "HEXA") {
               print "CHEXA," ++e ",1," a "," b "," d "," g4 "," A "," B "\n+," D "," G
               if (k == 0) face(a "," b "," d "," g4, 20)
               if (k == 1) face(A "," B "," D "," G, 23)
            } else {
               if (k == 0) { face(a "," b "," d, 20); face(a "," d "," g4, 20) }
               if (k == 1) { face(A "," B "," D, 23); face(A "," D "," G, 23) }
               if (kind == "PENTA") { penta(a, b, d, A, B, D); penta(a, d, g4, A, D, G) }
               else {
                  element("TETRA", a "," b "," d "," D); element("TETRA", a "," B "," b "," D); element("TETRA", a "," A "," B "," D)
                  element("TETRA", a "," d "," g4 "," D); element("TETRA", a "," g4 "," G "," D); element("TETRA", a "," G "," A "," D)
               }
            }
         }
         print "PMARK,20\nPMARK,23"
      }'
}

# ---- the prism of the worked example in space ----

# nu = 0: nothing happens across its thickness, and every row of nodes has the pressures of the plane prism
prism_in() { # NAME DIMENSION METHOD MODES
   awk -v plane="$(($2 == 2))" -v method="$3" -v modes="$4" 'BEGIN {
      print "METHOD = " method "\nSPC = 1\nSUBCASE 1\n  LOAD = 1\n  INCR = 5\nBEGIN BULK\nMAT1,1,9500.0,,0.0\nJOINT,1,1,20\nPJOINT,1,1\nJNORM,1,8.0-3,0.5"
      print "PMARK,20\nPMARK,21\nSPCM,1,1,21\nJINCR,5,5,ARITH,0.05"
      if (plane) {
         print "BLOCK2,1,1,10,4,0.0,0.0\n+,150.0,100.0\n+,20,21\nPSHELL,1,1,20.0" (modes == "YES" ? "\n+,YES" : "") "\nFORCE,1,55,,800.0,0.0,-1.0"
      } else {
         print "BLOCK3,1,1,10,4,2,0.0,0.0,0.0\n+,150.0,100.0,20.0\n+,,21,20,,22\nPMARK,22\nSPCM,1,3,22\nPSOLID,1,1,,,," (modes == "YES" ? "MODES" : "PLAIN")
         print "FORCE,1,163,,200.0,0.0,-1.0\nFORCE,1,164,,400.0,0.0,-1.0\nFORCE,1,165,,200.0,0.0,-1.0"
      }
      print "ENDDATA" }' > "$work/$1.bdf"
   run "$1"
}
for method in NEWTON STEP BACK; do
   for modes in NO YES; do
      prism_in flat 2 $method $modes && prism_in space 3 $method $modes &&
         ask "prism in space, $method, modes $modes" space count $((3 * $(value flat print 'count()'))) \
            with "$work/flat.joint.csv" on stage on increment on x \
            all 'pressure = other.pressure within 1e-9*max(other.pressure) and max(other.pressure) > 0.2'
   done
done

# ---- rings ----

# ring NAME CARDS: a ring pressed by 0.5 on its top, on the joint law of the prism; CARDS are its mesh, marks 20 (joint) and 23 (top)
ring() {
   { printf 'METHOD = NEWTON\nSPC = 1\nSUBCASE 1\n  LOAD = 1\n  INCR = 5\nBEGIN BULK\nPAXIS,1,1\nMAT1,1,9500.0,,0.3\nJOINT,1,1,20\nPJOINT,1,1\nJNORM,1,8.0-3,0.5\n'
     printf 'PMARK,20\nPMARK,23\nPLOADM,1,0.5,23\nJINCR,5,5\n%b\nENDDATA\n' "$2"; } > "$work/$1.bdf"
   run "$1"
}
ring_area() { number "pi*($2^2 - $1^2)"; }
free='GRID,999,,200.0,200.0\nSPC1,1,12,999' # a set of supports must hold some node
ring ring "BLOCK2,1,1,5,3,20.0,0.0\n+,60.0,30.0,,,3.0,1.0,1,1\n+,20,,23\n$free" && {
   pressed_evenly 'ring pressed evenly' ring 0.5 "$(ring_area 20 60)"
   near 'ring: total load 0.5 A_int' "$(total ring LOADS)" "-0.5*$(ring_area 20 60)" 3e-6
   near 'ring: lambda = c p**m' "$(cell ring 1 5 1 lambda)" 5.656854249492380e-3 1e-9
}
ring disc "BLOCK2,1,1,7,2,0.0,0.0\n+,60.0,30.0,,,0.2\n+,20,22,23,21\nPMARK,21\nPMARK,22\nSPCM,1,1,21" && {
   pressed_evenly 'disc with its axis pressed evenly' disc 0.5 "$(ring_area 0 60)"
   near 'disc: area of the node on the axis, pi h**2/3' "$(cell disc 1 5 1 area)" \
      "$(awk 'BEGIN { f = 0.2^(1/6); s = 0; t = 1; for (i = 1; i <= 7; i++) { s += t; t *= f } h = 60 / s; printf "%.15g", atan2(0, -1) * h * h / 3 }')" 1e-10
}
# of triangles, skewed
ring_triangles=$(awk 'BEGIN {
   for (i = 0; i <= 5; i++) for (j = 0; j <= 3; j++) {
      x = 20 + 8 * i + ((i % 5) ? 1.5 * (j - 1.2) : 0); y = 10 * j + ((j % 3) ? 1.1 * (i - 2.6) : 0)
      printf "GRID,%d,,%.12f,%.12f\\n", 1 + 4 * i + j, x, y
   }
   for (i = 0; i < 5; i++) for (j = 0; j < 3; j++) {
      a = 1 + 4 * i + j; b = a + 4
      if ((i + j) % 2) { printf "CTRIA3,%d,1,%d,%d,%d\\n", ++e, a, b, b + 1; printf "CTRIA3,%d,1,%d,%d,%d\\n", ++e, a, b + 1, a + 1 }
      else { printf "CTRIA3,%d,1,%d,%d,%d\\n", ++e, a, b, a + 1; printf "CTRIA3,%d,1,%d,%d,%d\\n", ++e, b, b + 1, a + 1 }
      if (j == 0) printf "CBAR,%d,20,%d,%d\\n", 100 + i, a, b
      if (j == 2) printf "CBAR,%d,23,%d,%d\\n", 200 + i, a + 1, b + 1
   } }')
ring ring_tria "$ring_triangles\n$free" && pressed_evenly 'ring of triangles pressed evenly' ring_tria 0.5 "$(ring_area 20 60)"
# a ring in a ring, the joint between them a cylinder: pressed from outside it carries the same along its height
cards rings <<'DECK'
METHOD = NEWTON;SPC = 1;SUBCASE 1;  LOAD = 1;  INCR = 5
BEGIN BULK;BLOCK2,1,1,4,3,20.0,0.0;+,40.0,30.0,,,,0.5;+,,20
BLOCK2,2,1,4,3,40.0,0.0;+,60.0,30.0,,,,0.5,101,101;+,,23,,21;PMARK,20;PMARK,21;PMARK,23;PAXIS,1,1;MAT1,1,9500.0,,0.3
JOINT,1,1,20,21;PJOINT,1,1,,,,,1.0;JNORM,1,8.0-3,0.5;SPC1,1,2,1,THRU,200;PLOADM,1,2.0,23;JINCR,5,5;ENDDATA
DECK
run rings && pressed_evenly 'ring in a ring: the same pressure along the height' rings "$(cell rings 1 5 17 pressure)" \
   "$(number "2400*pi")"

# ---- boxes pressed evenly, free to slide ----

box() { # NAME KIND SKEW CARDS [TURN]
   { printf 'METHOD = NEWTON\nSPC = 1\nSUBCASE 1\n  LOAD = 1\n  INCR = 5\nBEGIN BULK\nMAT1,1,9500.0,,0.3\nJOINT,1,1,20\nPJOINT,1,1,,,,,%s\nJNORM,1,8.0-3,0.5\nJINCR,5,5\n' "${p0:-}"
     box_mesh "$2" "$3" "${5:-0 0 0}"; printf '%b\nENDDATA\n' "$4"; } > "$work/$1.bdf"
   run "$1"
}
for kind in HEXA PENTA TETRA; do
   for modes in '' MODES; do
      for skew in 0.0 1.2; do
         box box_$kind $kind $skew "PSOLID,1,1,,,,$modes\nSPC1,1,12,1\nSPC1,1,2,4\nPLOADM,1,0.5,23" &&
            pressed_evenly "box of C$kind pressed evenly, skew $skew, $modes" box_$kind 0.5 2400
      done
   done
done
near 'box: total load' "$(total box_TETRA LOADS)" -1200 2e-6
near 'box: the joint carries it' "$(total box_TETRA 'RIGID BASES, THROUGH THE JOINTS')" 1200 2e-6

# ---- distributed loads ----

# PLOAD4 on every face of the top, PLOADM on its mark, FORCEM of the same total: the same nodal forces, the same joint
on_top() { # KIND: PLOAD4 cards
   case $1 in
      HEXA)  for e in 7 8 9 10 11 12; do k=$((e - 7)); a=$((25 + k % 3 + 4 * (k / 3))); printf 'PLOAD4,1,%d,0.5,,,,%d,%d\\n' $e $a $((a + 5)); done ;;
      PENTA) for k in 0 1 2 3 4 5; do a=$((25 + k % 3 + 4 * (k / 3))); printf 'PLOAD4,1,%d,0.5,,,,%d\\nPLOAD4,1,%d,0.5,,,,%d\\n' $((13 + 2 * k)) $a $((14 + 2 * k)) $a; done ;;
      TETRA) for k in 0 1 2 3 4 5; do a=$((25 + k % 3 + 4 * (k / 3))); b=$((a - 12)); printf 'PLOAD4,1,%d,0.5,,,,%d,%d\\nPLOAD4,1,%d,0.5,,,,%d,%d\\n' \
                $((39 + 6 * k)) $a $b $((42 + 6 * k)) $a $b; done ;;
   esac
}
for kind in HEXA PENTA TETRA; do
   box face_$kind $kind 1.2 "PSOLID,1,1\nSPC1,1,12,1\nSPC1,1,2,4\n$(on_top $kind)" && box mark_$kind $kind 1.2 "PSOLID,1,1\nSPC1,1,12,1\nSPC1,1,2,4\nPLOADM,1,0.5,23" &&
      same_rows "C$kind: PLOAD4 and PLOADM" face_$kind mark_$kind 1e-10 $both
   box force_$kind $kind 1.2 "PSOLID,1,1\nSPC1,1,12,1\nSPC1,1,2,4\nFORCEM,1,600.0,0.0,0.0,-2.0,23" &&
      same_rows "C$kind: FORCEM and PLOADM" force_$kind mark_$kind 1e-10 $both
done
# with factors of LOAD; inclined
p0=1.0 box inclined HEXA 1.2 "PSOLID,1,1\nSPC1,1,123,1,THRU,12\nFORCEM,7,100.0,3.0,-2.0,-6.0,23\nLOAD,1,2.0,0.5,7,1.0,8\nPLOADM,8,0.25,23" && {
   near 'FORCEM and PLOADM by LOAD: x' "$(total inclined LOADS 1)" 300 2e-6
   near 'FORCEM and PLOADM by LOAD: y' "$(total inclined LOADS 2)" -200 2e-6
   near 'FORCEM and PLOADM by LOAD: z' "$(total inclined LOADS 3)" -1800 2e-6
}
# a pressure round a closed body has no resultant: on all faces of a tetrahedron
cards around <<'DECK'
SPC = 1;SUBCASE 1;  LOAD = 1
BEGIN BULK;GRID,1,,0.0,0.0,0.0;GRID,2,,7.0,1.0,0.5;GRID,3,,1.5,6.0,-0.5;GRID,4,,2.0,1.0,5.0;CTETRA,1,1,1,2,3,4
PSOLID,1,1;MAT1,1,9500.0,,0.3;PLOAD4,1,1,2.0,,,,1,4;PLOAD4,1,1,2.0,,,,1,3;PLOAD4,1,1,2.0,,,,2,1;PLOAD4,1,1,2.0,,,,1,2
SPC1,1,123,1;SPC1,1,23,2;SPC1,1,3,3;ENDDATA
DECK
run around && for c in 1 2 3; do near "pressure all round: component $c" "$(total around LOADS $c)" 0 0 1e-12; near "pressure all round: reaction $c" "$(total around SUPPORTS $c)" 0 0 1e-10; done

# plane and axisymmetric edges: PLOADE on the edges of the top as PLOADM on its mark
for property in 'PSHELL,1,1,20.0' 'PAXIS,1,1'; do
   for load in 'PLOADM,1,0.5,23' "$(for i in 0 1 2 3 4; do printf 'PLOADE,1,%d,0.5,%d,%d\\n' $((3 * i + 3)) $((4 * i + 8)) $((4 * i + 4)); done)"; do
      name=edge_${property%%,*}_${load%%,*}
      { printf 'METHOD = NEWTON\nSPC = 1\nSUBCASE 1\n  LOAD = 1\n  INCR = 5\nBEGIN BULK\nBLOCK2,1,1,5,3,20.0,0.0\n+,60.0,30.0,,,3.0\n+,20,,23\nMAT1,1,9500.0,,0.3\nJOINT,1,1,20\nPJOINT,1,1\n'
        printf 'JNORM,1,8.0-3,0.5\nPMARK,20\nPMARK,23\nJINCR,5,5\nSPC1,1,1,1\n%b\n%b\nENDDATA\n' "$property" "$load"; } > "$work/$name.bdf"
      run "$name"
   done
   same_rows "${property%%,*}: PLOADE and PLOADM" "edge_${property%%,*}_PLOADM" "edge_${property%%,*}_PLOADE" 1e-10 $along
done
near 'PLOADE on a plane body: p times length times thickness' "$(total edge_PSHELL_PLOADE LOADS)" -400 2e-6

# weight: rho g V, all of it in the supports
gravity() { # NAME CARDS
   { printf 'SPC = 1\nSUBCASE 1\n  LOAD = 1\nBEGIN BULK\nMAT1,1,9500.0,,0.3,7.85-6\n%b\nENDDATA\n' "$2"; } > "$work/$1.bdf"
   run "$1"
}
for kind in HEXA PENTA TETRA; do
   gravity weight "$(box_mesh $kind 1.2)\nPSOLID,1,1\nSPCM,1,123,20\nGRAV,1,,10.0,0.6,0.0,-0.8" && {
      near "weight of C$kind, z" "$(total weight SUPPORTS 3)" 4.5216 2e-6      # 7.85E-6 x 72000 x 8
      near "weight of C$kind, x" "$(total weight SUPPORTS 1)" -3.3912 2e-6
   }
done
gravity weight2 'BLOCK2,1,1,4,3,0.0,0.0,50.0,-5.0\n+,60.0,40.0,5.0,30.0\n+,20\nPMARK,20\nPSHELL,1,1,2.5\nSPCM,1,12,20\nGRAV,1,,9.81,0.0,-1.0' &&
   near 'weight of a plate' "$(total weight2 SUPPORTS)" "$(awk 'BEGIN { # area by the shoelace rule
      split("0 50 60 5", x, " "); split("0 -5 40 30", y, " "); for (i = 1; i <= 4; i++) { j = i % 4 + 1; a += (x[i] * y[j] - x[j] * y[i]) / 2 } print 7.85e-6 * 9.81 * 2.5 * a }')" 3e-6
gravity weight_ring 'BLOCK2,1,1,4,3,20.0,0.0\n+,60.0,30.0\n+,20\nPMARK,20\nPAXIS,1,1\nSPCM,1,12,20\nGRAV,1,,9.81,0.0,-1.0' &&
   near 'weight of a ring' "$(total weight_ring SUPPORTS)" "7.85e-6*9.81*30*$(ring_area 20 60)" 3e-6

# ---- two bodies, a joint turned in space ----

# pressed off the middle, pushed in x and y, released; the joint SPLIT out of one mesh or between two MESHES
bodies_in_space() { # NAME METHOD BASE
   awk -v method="$2" -v base="$3" 'BEGIN {
      print "METHOD = " method "\nSPC = 1"
      for (s = 1; s <= 3; s++) print "SUBCASE " s "\n  LOAD = " s "\n  INCR = " (s == 1 ? 4 : 8) "\n  OUTPUT = NONE"
      print "BEGIN BULK\nPSOLID,1,1\nMAT1,1,9500.0,,0.25\nBLOCK3,2,1,4,3,2,0.0,0.0,-20.0\n+,80.0,60.0,0.0,,,,1001,1001\n+,,,,,22,20"
      print "PMARK,22\nPMARK,20\nSPCM,1,123,22\nBLOCK3,1,1,4,3,2,0.0,0.0,0.0\n+,80.0,60.0,40.0,,,,1,1\n+,,,,," (base == "SPLIT" ? ",23,2" : "21,23") "\nPMARK,23"
      if (base != "SPLIT") print "PMARK,21"
      print "JOINT,1,1,20" (base == "SPLIT" ? "" : ",21") "\nPJOINT,1,1,1,1,0.2,3\nJNORM,1,8.0-3,0.5,9500.0\nJSHEAR,1,100.0,300.0\n+,160.0,250.0"
      print "PLOADM,11,0.3,23\nFORCE,12,60,,600.0,0.0,0.0,-1.0\nFORCEM,13,200.0,0.8,-0.6,0.0,23"
      print "LOAD,1,1.0,1.0,11,1.0,12\nLOAD,2,1.0,1.0,11,1.0,12,1.0,13\nLOAD,3,1.0,1.0,11,0.5,12,-0.5,13\nJINCR,4,4,ARITH,0.25\nJINCR,8,8,ARITH,0.125\nENDDATA" }' > "$work/$1.bdf"
   run "$1"
}
for method in NEWTON STEP; do
   bodies_in_space apart $method MESHES && bodies_in_space split $method SPLIT && {
      same_rows "joint in space, split or meshed apart, $method" apart split 1e-9 $both
      ask "joint in space, $method: unloads and slips" split \
         all 'sum(branch = "LOAD") > 0 and sum(branch = "UNLOAD") > 0 and sum(slip) > 0 and sum(slip) < count()'
   }
done
sed 's/^JOINT,1,1,20,21/JOINT,1,1,21,20/' "$work/apart.bdf" > "$work/exchanged.bdf"
run exchanged && same_rows 'joint in space, sides exchanged' apart exchanged 1e-9 $resultant

# turned in space, with its loads, no supports but the joint: the same pressures; of the shear the resultant is the same
turned_box() { # NAME KIND METHOD TURN
   local push
   push=$(awk -v turn="$4" 'BEGIN { pi = atan2(0, -1); split(turn, t, " "); for (m = 1; m <= 3; m++) { c[m] = cos(t[m] * pi / 180); s[m] = sin(t[m] * pi / 180) }
      n = split("13 31 36", g, " "); split("9 4 -7 3 2 5 -5 1 8", q, " ")
      for (i = 1; i <= n; i++) {
         x = q[3 * i - 2]; y = q[3 * i - 1]; z = -100 + q[3 * i]
         u = c[1] * x - s[1] * y; v = s[1] * x + c[1] * y; w = z
         y = c[2] * v - s[2] * w; z = s[2] * v + c[2] * w; x = c[3] * u + s[3] * z; z = -s[3] * u + c[3] * z
         printf "FORCE,2,%d,,1.0,%.14f,%.14f,%.14f\n", g[i], x, y, z
      } }')
   { printf 'METHOD = %s\nSUBCASE 1\n  LOAD = 1\n  INCR = 5\nSUBCASE 2\n  LOAD = 3\n  INCR = 5\nBEGIN BULK\nMAT1,1,9500.0,,0.0\nPSOLID,1,1\nJOINT,1,1,20\nPJOINT,1,1,1,1,0.3,3\n' "$3"
     printf 'JNORM,1,8.0-3,0.5,9500.0\nJSHEAR,1,100.0,0.0\nJINCR,5,5\nPLOADM,1,0.5,23\nLOAD,3,1.0,1.0,1,1.0,2\n'
     box_mesh "$2" 1.2 "$4"; printf '%s\nENDDATA\n' "$push"; } > "$work/$1.bdf"
   run "$1"
}
for method in NEWTON STEP; do
   for kind in HEXA TETRA; do
      turned_box upright $kind $method '0 0 0' || continue
      for turn in '0 30 0' '0 0 90' '0 10 75' '0 180 0' '25 61.7 -40'; do
         turned_box turned $kind $method "$turn" && same_rows "box of C$kind turned by $turn degrees, $method" upright turned 1e-10 $resultant
      done
   done
done

# ---- Lame's thick cylinder ----

lame=$(number "525*400/1200/21000*(0.7*20 + 1.3*1600/20)")
declare -A first=([lame]=16 [lame_solid]=8)
for k in 1 2 4; do cylinder lame$((16 * k)) $((16 * k)); quarter lame_solid$((8 * k)) $((8 * k)); done
for name in lame lame_solid; do
   for k in 1 2 4; do errors[k]=$(number "$(moved $name$((k * ${first[$name]})) 1 1)/$lame - 1"); done
   holds "$name: the displacement inside, differences ${errors[*]}" "abs(${errors[4]}) < 2e-4 and
      ${errors[1]}/${errors[2]} = 4.15 within 0.45 and ${errors[2]}/${errors[4]} = 4.075 within 0.225"
done

# ---- the slender beam of MacNeal and Harder (1985): 6 x 0.2 x 0.1, six elements, E = 1E7, nu = 0.3, unit load across the free end ----

beam2 beam_modes YES && near 'slender beam, CQUAD4 with modes' "$(moved beam_modes 13 2)" 0.1081 0.02
beam2 beam_plain NO && holds 'slender beam, plain CQUAD4: an order too stiff' "$(moved beam_plain 13 2)/0.1081 = 0.1 within 0.05"
for direction in y z; do
   exact=$([ $direction = y ] && echo 0.1081 || echo 0.4321) c=$([ $direction = y ] && echo 2 || echo 3)
   beam3 beam_modes3 MODES $direction && near "slender beam, CHEXA with modes, $direction" "$(moved beam_modes3 25 $c)" $exact 0.02
   beam3 beam_plain3 PLAIN $direction && holds "slender beam, plain CHEXA, $direction: far too stiff" "$(moved beam_plain3 25 $c)/$exact = 0.075 within 0.075"
done

# ---- prescribed displacements ----

# node 36, a corner of the top, is moved down; a force as large as its reaction gives the same joint and moves it as far
p0=0.1 box pushed HEXA 1.2 'PSOLID,1,1,,,,PLAIN\nSPC1,1,12,1\nSPC1,1,2,4\nSPC1,1,3,30\nSPCD,1,30,3,-0.02' && {
   reaction=$(table pushed 'REACTIONS AT' | awk '$1 == 30 { r = $NF } END { print r }')
   box pressed HEXA 1.2 "PSOLID,1,1,,,,PLAIN\nSPC1,1,12,1\nSPC1,1,2,4\nFORCE,1,30,,1.0,0.0,0.0,$reaction" && {
      near 'a force as large as the reaction: the displacement of SPCD' "$(moved pressed 30 3)" -0.02 3e-5
      ask 'SPCD and a force: the same pressures' pressed rows 'increment = 5' count 12 with "$work/pushed.joint.csv" on increment on node1 \
         all 'pressure = other.pressure within 3e-5*max(other.pressure) and max(other.pressure) > 0'
   }
}

# ---- friction in the plane of the joint ----

# pressed by 1200, mu = 0.25, then dragged by SPCD on the lower face along a direction, until all slips: the resultant is mu N whatever the direction
dragged() { # NAME DEGREES METHOD
   { printf 'METHOD = %s\nTOL = 1.0-10\nSPC = 1\nSUBCASE 1\n  LOAD = 1\n  INCR = 2\nSUBCASE 2\n  LOAD = 2\n  INCR = 20\nBEGIN BULK\nMAT1,1,9500.0,,0.0\nPSOLID,1,1\nJOINT,1,1,20\nPJOINT,1,1,1,1,0.25,-1,1.0\nJNORM,1,8.0-3,0.5,9500.0\n' "$3"
     printf 'JSHEAR,1,100.0,300.0\nJINCR,2,2\nJINCR,20,20\nPLOADM,1,0.5,23\nLOAD,2,1.0,1.0,1,1.0,3\nSPC1,1,12,1,THRU,36\n'
     box_mesh HEXA 0.0
     awk -v t="$2" 'BEGIN { t *= atan2(0, -1) / 180; for (g = 1; g <= 36; g++) printf "SPCD,3,%d,1,%.12f,%d,2,%.12f\n", g, 0.01 * cos(t), g, 0.01 * sin(t) }'
     echo ENDDATA; } > "$work/$1.bdf"
   run "$1"
}
shear='sqrt(tau_x^2 + tau_y^2)' x='sum(tau_x*area)' y='sum(tau_y*area)'
for degrees in 0 90 45 200; do
   dragged drag $degrees NEWTON && {
      ask "dragged along $degrees degrees: all nodes slip" drag rows 'stage = 2 and increment = 20' all 'sum(slip) = 12'
      ask "dragged along $degrees degrees: the resultant of the shear is mu p" drag all "$shear <= 0.25*pressure*(1 + 1e-7)" \
         rows 'stage = 2 and increment = 20' all "$shear >= 0.25*pressure*(1 - 1e-7)" all "sqrt($x^2 + $y^2) = 300 within 1e-4" \
         all "(($x*cos($degrees*pi/180) - $y*sin($degrees*pi/180))/sqrt($x^2 + $y^2))^2 > 1 - 1e-10"
   }
done

# one element: 0.99 of the limit sticks, 1.01 slips, in every direction
for degrees in 0 90 45 200; do
   for share in 0.99 1.01; do
      awk -v t="$degrees" -v share="$share" 'BEGIN { t *= atan2(0, -1) / 180
         print "METHOD = STEP\nSPC = 1\nSUBCASE 1\n  LOAD = 1\n  INCR = 1\nBEGIN BULK\nBLOCK3,1,1,1,1,1,0.0,0.0,0.0\n+,10.0,10.0,10.0\n+,,,,,20,23\nPMARK,20\nPMARK,23\nPSOLID,1,1\nMAT1,1,9500.0,,0.0"
         print "JOINT,1,1,20\nPJOINT,1,1,1,1,0.25,0\nJNORM,1,8.0-3,0.5\nJSHEAR,1,100.0\nJINCR,1,2\nFORCEM,1,100.0,0.0,0.0,-1.0,23\nSPC1,1,3,2,4,6,8"
         printf "FORCEM,1,%.12f,%.12f,%.12f,0.0,20\nENDDATA\n", 25 * share, cos(t), sin(t) }' | sed '/^SPC/d' > "$work/limit.bdf"
      run limit && ask "at $degrees degrees, $share of the limit" limit rows 'increment = 2' all "sum(slip) = if($share < 1, 0, 4)"
   done
done

# ACCEL1: all nodes together are GRAV; a node in the middle of a face of four of eight equal cubes has half the mass of a cube.
for case in 'GRAV,1,,10.0,0.0,0.0,-1.0' 'ACCEL1,1,,10.0,0.0,0.0,-1.0;+,1,THRU,26,27' 'ACCEL1,1,,10.0,0.0,0.0,-1.0;+,15'; do
   cards accelerated <<DECK
SPC = 1;LOAD = 1;BEGIN BULK;BLOCK3,1,1,2,2,2,0.,0.,0.;+,20.,20.,20.;+,,,,,20,30;PSOLID,1,1;MAT1,1,1000.,,.3,1.-3;PMARK,20;PMARK,30;SPCM,1,123,20
$case;ENDDATA
DECK
   weight=80 # 8000 x 1E-3 x 10
   [ "${case##*,}" = 15 ] && weight=5
   run accelerated && near "weight by ${case%%,*}" "$(awk -F, '$2 == "LOADS" { print $11 }' "$work/accelerated.reaction.csv")" "-$weight" 1e-10
done

# Pyramids: a cube of six round a node out of the centre with a hexahedron on top, pressed evenly on a rigid base: p = 2 everywhere, the top goes
# down by lambda + p H/E and grows sideways by nu p/E; the weight is the volume, of one pyramid a third of its box; PLOAD4 on triangles.
pyramids() { # NAME MORE-CARDS
   cards "$1" <<DECK
METHOD = NEWTON;TOL = 1.E-13;SPC = 1;SUBCASE 1;LOAD = 10;INCR = 4;OUTPUT = LAST,STRESS,VTU;SUBCASE 2;LOAD = 13;INCR = 4
BEGIN BULK;GRID,1,,0.,0.,0.;GRID,2,,10.,0.,0.;GRID,3,,10.,10.,0.;GRID,4,,0.,10.,0.;GRID,5,,0.,0.,10.;GRID,6,,10.,0.,10.;GRID,7,,10.,10.,10.
GRID,8,,0.,10.,10.;GRID,9,,4.,5.5,6.;GRID,11,,20.,0.,0.;GRID,12,,30.,0.,0.;GRID,13,,30.,10.,0.;GRID,14,,20.,10.,0.;GRID,15,,25.,5.,10.
GRID,35,,0.,0.,25.;GRID,36,,10.,0.,25.;GRID,37,,10.,10.,25.;GRID,38,,0.,10.,25.
CPYRAM,1,1,1,2,3,4,9;CPYRAM,2,1,8,7,6,5,9;CPYRAM,3,1,1,5,6,2,9;CPYRAM,4,1,2,6,7,3,9;CPYRAM,5,1,3,7,8,4,9;CPYRAM,6,1,4,8,5,1,9
CHEXA,8,1,5,6,7,8,35,36;+,37,38;CPYRAM,7,1,11,12,13,14,15;CQUAD4,101,20,1,2,3,4;CQUAD4,102,21,11,12,13,14;PMARK,20;PMARK,21;PSOLID,1,1
MAT1,1,200000.,,0.3,1.-7;JOINT,1,1,20;JOINT,2,1,21;PJOINT,1,1;JNORM,1,2.-3,0.5,2.+5;SPC1,1,12,1,11;SPC1,1,2,2,12;PLOAD4,11,8,2.,,,,35,37
PLOAD4,11,7,2.,,,,11,12;PLOAD4,11,7,2.,,,,13,12;PLOAD4,11,7,2.,,,,14,13;PLOAD4,11,7,2.,,,,14,11;GRAV,12,,1.+4,0.,0.,-1.
LOAD,10,1.,1.,11;LOAD,13,1.,1.,11,1.,12;JINCR,4,3;${2:-$ no more};ENDDATA
DECK
}
pyramids pyramids && run pyramids && {
   ask 'pyramids: an even pressure' pyramids rows 'joint = 1 and stage = 1' count 12 \
      all 'pressure = 2*load within 1e-11 and lambda = 2e-3*(2*load)^0.5 within 1e-13'
   near 'pyramids: the top' "$(table pyramids 'DISPLACEMENTS OF NODES' | awk '$1 == 37 && !v { v = $NF } END { print v }')" '-(2e-3*2^0.5 + 2*25/200000)' 2e-6
   near 'pyramids: sideways' "$(table pyramids 'DISPLACEMENTS OF NODES' | awk '$1 == 7 && !v { v = $(NF - 1) } END { print v }')" '0.3*2/200000*10' 2e-6
   ask 'pyramids: pressure on triangles' pyramids rows 'joint = 2 and stage = 1' by increment all 'sum(force) = 200*load within 1e-9'
   ask 'pyramids: volume of six and a hexahedron' pyramids rows 'joint = 1 and stage = 2' by increment all 'sum(force) = 200 + 2.5*load within 1e-9'
   ask 'pyramids: volume of one' pyramids rows 'joint = 2 and stage = 2' by increment all 'sum(force) = 200 + load/3 within 1e-9'
   od -An -v -tx1 "$work/pyramids.1.vtu" | tr -d ' \n' > "$work/pyramids.hex"
   says 'pyramids for ParaView' "$work/pyramids.hex" '0e0e0e0e0e0e0e0c'
}
# One pyramid held at its base, a force on the apex: the displacements are linear in the height h, so that k = E V/h^2 upwards and G V/h^2 sideways
# with nu = 0, wherever the apex is.
for case in '0. 0. 1. 2.5*16/(1000*8)' '1. 0. 0. 2.5*16/(500*8)' '0. 1. 0. 2.5*16/(500*8)'; do
   set -- $case
   cards one_pyramid <<DECK
SPC = 1;SUBCASE 1;LOAD = 1
BEGIN BULK;GRID,1,,0.,0.,0.;GRID,2,,2.,0.,0.;GRID,3,,2.,3.,0.;GRID,4,,0.,3.,0.;GRID,9,,0.3,2.,4.;CPYRAM,1,1,1,2,3,4,9;PSOLID,1,1
MAT1,1,1000.,,0.;SPC1,1,123,1,2,3,4;FORCE,1,9,,2.5,$1,$2,$3;ENDDATA
DECK
   run one_pyramid && near "one pyramid, force $1 $2 $3" "$("$query" "$work/one_pyramid.stage.csv" print u_max)" "$4" 1e-12
done
pyramids more_nodes 'CPYRAM,70,1,11,12,13,14,15,1;+,2' && run more_nodes 2 && says 'a pyramid of thirteen nodes' "$work/more_nodes.log" \
   'CPYRAM, field 9, G6: a pyramid of second order, of up to 13 nodes; expected 5'
pyramids turned_round 'CPYRAM,70,1,14,13,12,11,15' && run turned_round 2 && says 'a pyramid turned round' "$work/turned_round.log" \
   'element 70 has no positive volume at some integration point'
pyramids no_face 'PLOAD4,11,7,2.,,,,11,15' && run no_face 2 && says 'a face that is none' "$work/no_face.log" 'expected two opposite corners of the base, or the two'
pyramids twice 'CPYRAM,70,1,12,13,14,11,15' && run twice && says 'two pyramids on the same nodes' "$work/twice.log" '70 as 7'
