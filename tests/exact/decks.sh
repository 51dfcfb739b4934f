# Decks with an exact answer, for the parts of exact/ and for the verification manual (../manual): each function writes $work/NAME.bdf
# and runs it (run, lib.sh), but where its comment says that it only writes.

# ---- one interface element ----

# One element, a = 100, c = 8E-3, E_u = 500, pressed by 130 in increments that grow from 0.07 of it.
one_element() { # NAME METHOD M INCREMENTS
   cards "$1" <<DECK
METHOD = $2;TOL = 1.0E-14;SUBCASE 1;  LOAD = 1;  INCR = 1;  OUTPUT = NONE
BEGIN BULK;GRID,1,,0.0,0.0,,,1;CJOINT,1,1,1,,100.0,0.0,1.0;PJOINT,1,1;JNORM,1,8.0-3,$3,500.0;FORCE,1,1,,100.0,0.0,-1.3
JINCR,1,$4,GEOM,0.07;ENDDATA
DECK
   run "$1"
}

# An element opens and closes again beside an elastic body (k_b at each node), by STEP and by NEWTON; the recurrence and the law are written out.
reopen() { # NAME METHOD
   cards "$1" <<DECK
METHOD = $2;SPC = 1;SUBCASE 1;  LOAD = 1;  INCR = 1;SUBCASE 2;  LOAD = 2;  INCR = 1
SUBCASE 3;  LOAD = 3;  INCR = 1
BEGIN BULK;BLOCK2,1,1,1,1,0.0,0.0;+,10.0,50.0;+,20,,21;PMARK,20;PMARK,21;PSHELL,1,1,20.0;MAT1,1,1000.0,,0.0
JOINT,1,1,20;PJOINT,1,1,,,,,0.05;JNORM,1,8.0-3,0.5,500.0;SPCM,1,12,21;SPCM,1,1,20;FORCE,1,1,,100.0,0.0,-1.0
FORCE,1,3,,100.0,0.0,-1.0;LOAD,2,-0.4,1.0,1;LOAD,3,1.5,1.0,1;JINCR,1,8,ARITH,0.125;ENDDATA
DECK
   run "$1"
}

# One element beside a spring of 10000 kgf/mm: k_s = 25000, so a re-analysis removes 10000/35000 of the excess.
sheared_spring() { # NAME METHOD NREAN FORCE
   cards "$1" <<DECK
METHOD = $2;SUBCASE 1;  LOAD = 1;  OUTPUT = NONE;SUBCASE 2;  LOAD = 2
BEGIN BULK;GRID,1;CJOINT,1,1,1,,100.0,0.0,-1.0;PJOINT,1,1,1,,0.2,$3,0.5;JNORM,1,8.0-3,0.5,500.0;JSHEAR,1,100.0,300.0
\$ the spring: lambda = c p along x
CJOINT,2,2,1,,100.0,1.0,0.0;PJOINT,2,2,,,,,0.1;JNORM,2,1.0-2,1.0,100.0
FORCE,1,1,,50.0,0.0,-1.0;FORCE,12,1,,$4,1.0;LOAD,2,1.0,1.0,1,1.0,12;ENDDATA
DECK
   run "$1"
}

# A bar of stiffness 100 and the joint behind a gap share the force: 100 (g + lambda) + a (lambda/c)**(1/m) = F.
gap_spring() { # NAME METHOD M GAP FORCE INCREMENTS [MORE-FORCES...]: each more force is a stage
   awk -v method="$2" -v m="$3" -v gap="$4" -v forces="$5 ${*:7}" -v n="$6" 'BEGIN {
      stages = split(forces, force, " ")
      print "METHOD = " method "\nTOL = 1.0E-13\nSPC = 1"
      for (s = 1; s <= stages; s++) print "SUBCASE " s "\n  LOAD = " s "\n  INCR = 1\n  OUTPUT = NONE"
      print "BEGIN BULK\nGRID,1,,0.0,0.0\nGRID,2,,0.0,100.0\nCROD,1,1,1,2\nPROD,1,1,10.0\nMAT1,1,1000.0,,0.25"
      printf "CJOINT,5,1,1,,4.0,0.0,-1.0,0.0\nPJOINT,1,1,,,,,%.12f\n", 2/n # about what an increment brings
      print "JNORM,1,8.0-3," m ",1000.0"
      if (gap + 0) print "JGAP,1,CONST," gap
      print "SPC1,1,12,2\nSPC1,1,1,1"
      for (s = 1; s <= stages; s++) printf "FORCE,%d,1,,%.12f,0.0,-1.0\n", s, force[s]
      printf "JINCR,1,%d,,%.12f\nENDDATA\n", n, 1/n }' > "$work/$1.bdf"
   run "$1"
}

gap_spring_lambda() { # M GAP FORCE
   awk -v m="$1" -v g="$2" -v f="$3" 'BEGIN { low = 0; high = 1
      for (i = 0; i < 200; i++) { x = (low + high)/2; if (100*(g + x) + 4*exp(log(x/8e-3)/m) > f) high = x; else low = x }
      printf "%.17g", low }'
}

# Two bars with interference, 100 each: at rest 50 (i - lambda) = a p on the loading curve, by every method; then pulled apart, along
# the line of slope E_u from there: lambda = i - 2 P/100 - pull/100.
bars() { # NAME METHOD PULL INCREMENTS
   cards "$1" <<DECK
METHOD = $2;TOL = 1.0E-13;SPC = 1;SUBCASE 1;  LOAD = 1;  INCR = 1
BEGIN BULK;GRID,1,,0.0,0.0;GRID,2,,0.0,100.0;GRID,3,,0.0,100.0;GRID,4,,0.0,200.0;CROD,1,1,1,2;CROD,2,1,3,4
PROD,1,1,10.0;MAT1,1,1000.0,,0.25;CJOINT,5,1,2,3,4.0,0.0,1.0,0.0;PJOINT,1,1,,,,,0.1;JNORM,1,8.0-3,0.5,1000.0
JGAP,1,CONST,-0.05;SPC1,1,12,1,4;SPC1,1,1,2,3;FORCE,1,2,,$3,0.0,-1.0
JINCR,1,$4,,$(awk "BEGIN { printf \"%.12f\", 1/$4 }");ENDDATA
DECK
   run "$1"
}

# ---- blocks on a rigid base ----

# A plate 100 x 50 x 20 of E 100 pressed evenly by 0.2 on a joint of M 0.4: forces on top as the areas of influence below, three divisions
# 1 : sqrt(0.4) : 0.4.
even_block() { # NAME
   cards "$1" <<'DECK'
METHOD = NEWTON;SPC = 1;SUBCASE 1;  LOAD = 1;  OUTPUT = NONE
BEGIN BULK;BLOCK2,1,1,3,2,0.0,0.0;+,100.0,50.0,,,0.4,1.0;+,20;PMARK,20;PSHELL,1,1,20.0;MAT1,1,100.0,,0.3;JOINT,1,1,20
PJOINT,1,1;JNORM,1,8.0-3,0.4,9500.0;SPC1,1,1,1
DECK
   awk 'BEGIN { CONVFMT = "%.17g"; r = sqrt(0.4); h = 100 / (1 + r + r * r)
      split(h / 2 " " h * (1 + r) / 2 " " h * r * (1 + r) / 2 " " h * r * r / 2, share, " ")
      for (i = 1; i <= 4; i++) printf "FORCE,1,%d,,%.13f,0.0,-1.0\n", 3 * i, 4 * share[i]
      print "ENDDATA" }' >> "$work/$1.bdf"
   run "$1"
}

# A block 100 x 100 x 20, 1E6 times stiffer than the joint, under a force of 1000 at the distance E from its middle: lambda = d + t x.
# Reads d, t, how far from straight it is (of d), how many elements are open.
middle='(first(lambda) + last(lambda))/2' slope='(last(lambda) - first(lambda))/(last(x) - first(x))'
rigid_block() { # NAME NX M E: the load is shared by the two nodes on top next to its place
   awk -v nx="$2" -v m="$3" -v e="$4" 'BEGIN {
      print "METHOD = NEWTON\nTOL = 1.0E-9\nSPC = 1\nSUBCASE 1\n  LOAD = 1\n  OUTPUT = NONE\nBEGIN BULK"
      print "BLOCK2,1,1," nx ",1,-50.0,0.0\n+,50.0,100.0\n+,20\nPMARK,20\nPSHELL,1,1,20.0\nMAT1,1,2.0E9,,0.0"
      print "JOINT,1,1,20\nPJOINT,1,1\nJNORM,1,8.0-3," m ",9500.0\nSPC1,1,1,1"
      i = int((e + 50) * nx / 100 + 1e-9); if (i == nx) i--
      right = (e - (-50 + 100 * i / nx)) * nx / 100
      printf "FORCE,1,%d,,%.12f,0.0,-1.0\n", 2 * i + 2, 1000 * (1 - right)
      printf "FORCE,1,%d,,%.12f,0.0,-1.0\nENDDATA\n", 2 * i + 4, 1000 * right
   }' > "$work/$1.bdf"
   run "$1" || return 1
   read -r d t worst open <<< "$(value "$1" print "$middle" print "$slope" \
      print "max(abs(lambda - ($middle) - ($slope)*x))/abs($middle)" print 'sum(branch = "OPEN")')"
}

# A block clamped evenly to p = 0.5 and pushed at its interface nodes as their areas are: every node has the same tau. Only writes.
pushed_block() { # NAME METHOD NREAN SHARE-OF-THE-LIMIT
   awk -v method="$2" -v nrean="$3" -v share="$4" 'BEGIN {
      print "METHOD = " method "\nSUBCASE 1\n  LOAD = 1\n  INCR = 1\n  OUTPUT = NONE\nSUBCASE 2\n  LOAD = 2\n  INCR = 1\nBEGIN BULK"
      print "BLOCK2,1,1,10,4,0.0,0.0\n+,100.0,40.0\n+,20\nPMARK,20\nPSHELL,1,1,20.0\nMAT1,1,9500.0,,0.0"
      print "JOINT,1,1,20\nPJOINT,1,1,1,,0.2," nrean "\nJNORM,1,8.0-3,0.5,9500.0\nJSHEAR,1,100.0,300.0"
      for (i = 0; i <= 10; i++) {
         w = i % 10 ? 0.1 : 0.05
         printf "FORCE,1,%d,,%.6f,0.0,-1.0\nFORCE,12,%d,,%.9f,1.0,0.0\n", 5 * i + 5, 1000 * w, 5 * i + 1, 200 * share * w
      }
      print "LOAD,2,1.0,1.0,1,1.0,12\nJINCR,1,10,ARITH,0.1\nENDDATA" }' > "$work/$1.bdf"
}

# A rigid block under a force at E, behind gaps: D and T from the balance of forces and moments on the same nodes, by awk.
gap_block() { # NAME METHOD NX M E INCREMENTS GUIDED JGAP-LINES
   awk -v method="$2" -v nx="$3" -v m="$4" -v e="$5" -v n="$6" -v guided="$7" -v card="$8" 'BEGIN {
      print "METHOD = " method "\nTOL = " (method == "BACK" ? "1.0E-7" : "1.0E-9") "\nSPC = 1\nSUBCASE 1\n  LOAD = 1\n  INCR = 1\n  OUTPUT = NONE\nBEGIN BULK"
      print "BLOCK2,1,1," nx ",1,-50.0,0.0\n+,50.0,100.0\n+,20\nPMARK,20\nPSHELL,1,1,20.0\nMAT1,1,2.0E9,,0.0"
      print "JOINT,1,1,20\nPJOINT,1,1\nJNORM,1,8.0-3," m ",9500.0\nSPC1,1,1,1" (guided ? ",2" : "")
      print card
      i = int((e + 50)*nx/100 + 1e-9); if (i == nx) i--
      right = (e - (-50 + 100*i/nx))*nx/100
      printf "FORCE,1,%d,,%.12f,0.0,-1.0\n", 2*i + 2, 1000*(1 - right)
      printf "FORCE,1,%d,,%.12f,0.0,-1.0\nJINCR,1,%d,,%.12f\nENDDATA\n", 2*i + 4, 1000*right, n, 1/n }' > "$work/$1.bdf"
   run "$1"
}

# The same by the balance of forces and moments on the same nodes.
gap_block_balance() { # NX M E GUIDED G0 SX CX: D, T and the largest p
   awk -v nx="$1" -v m="$2" -v e="$3" -v guided="$4" -v g0="$5" -v sx="$6" -v cx="$7" 'BEGIN {
      d = g0 + 0.02; t = guided ? 0 : sx
      for (k = 0; k < 200; k++) {
         f = -1000; q = -1000*e; fd = ft = qt = 0; most = 0
         for (i = 0; i <= nx; i++) {
            x = -50 + 100*i/nx; a = 2000/nx*(i == 0 || i == nx ? 0.5 : 1); l = d + t*x - g0 - sx*x - cx*x*x
            if (l <= 0) continue
            p = exp(log(l/8e-3)/m); s = a*p/(m*l); f += a*p; q += a*p*x; fd += s; ft += s*x; qt += s*x*x
            if (p > most) most = p }
         if (guided) { d -= f/fd; continue }
         det = fd*qt - ft*ft; dd = (qt*f - ft*q)/det; dt = (fd*q - ft*f)/det; d -= dd; t -= dt }
      printf "%.15g %.15g %.15g\n", d, t, most }'
}

# moved_block NAME NX NY P0 STAGE...: 10 x 5 x 2, nu = 0; a STAGE is UX:UY of the top at its end
moved_block() {
   local name=$1 nx=$2 ny=$3 p0=$4 stage s=0
   shift 4
   { echo 'METHOD = NEWTON
SPC = 1'
     for stage; do s=$((s + 1)); printf 'SUBCASE %d\n  LOAD = %d\n' $s $s; done
     echo "BEGIN BULK
BLOCK2,1,1,$nx,$ny,0.0,0.0
+,10.0,5.0
+,20,,21
PSHELL,1,1,2.0
MAT1,1,9500.0,,0.0
PMARK,20
PMARK,21
JOINT,1,1,20
PJOINT,1,1,,,,,$p0
JNORM,1,8.0-3,0.5
SPCM,1,12,21"
     s=0
     for stage; do
        s=$((s + 1))
        for ((i = 1; i <= nx + 1; i++)); do printf 'SPCD,%d,%d,1,%s,,,2,%s\n' $s $((i*(ny + 1))) "${stage%:*}" "${stage#*:}"; done
     done | awk -F, '{ print $1 "," $2 "," $3 "," $4 "," $5; print $1 "," $2 "," $3 "," $8 "," $9 }'
     echo ENDDATA; } > "$work/$name.bdf"
   run "$name"
}

# ---- blocks meshed apart ----

# input/meshed_apart.bdf, 7 elements over 5, with the coarser side first; with a SIDE1 that hangs over on both sides; 7 over 7 as pairs;
# 7 over 7 with the fit forced.
blocks_apart() { # KIND, the name of the deck too: coarse_first, overhang, pairs, forced
   local change match='s/^BLOCK2  1       1       5/BLOCK2  1       1       7/'
   case $1 in
      coarse_first) change='s/^JOINT .*/JOINT,1,1,20,30/' ;;
      overhang) change='s/^BLOCK2  2 .*/BLOCK2,2,1,9,2,-5.0,20.0/; s/^+       50.0    40.0 .*/+,60.0,40.0,,,,,101,101/; s/^PLOADM.*/FORCEM,11,100.0,0.0,-1.0,0.0,31/' ;;
      pairs) change=$match ;;
      forced) change="$match; s/^JOINT .*/JOINT,1,1,30,20,,YES/" ;;
   esac
   sed "$change" input/meshed_apart.bdf > "$work/$1.bdf"
   run "$1"
}

# ---- beams ----

# A slender beam on a joint, one half, 200 x 10 mm, the load's half at the plane of symmetry. In one increment no element is let go:
# the joint is a nonlinear elastic foundation.
beam_moment='sum(force*x)'
beam() { # NAME ELEMENTS M C P REFERENCE [HEIGHT]: E I stays the same
   awk -v n="$2" -v m="$3" -v c="$4" -v p="$5" -v h="${7:-10}" 'BEGIN {
      print "METHOD = NEWTON\nSPC = 1\nSUBCASE 1\n  LOAD = 1\n  INCR = 1\n  OUTPUT = NONE\nBEGIN BULK\nJINCR,1,1"
      print "BLOCK2,1,1," n ",1,0.0,0.0"
      printf "+,200.0,%.6f\n+,20,,,21\nPMARK,20\nPMARK,21\nPSHELL,1,1,20.0\nMAT1,1,%.6f,,0.0\n", h, 9500 * (10 / h)^3
      print "JOINT,1,1,20\nPJOINT,1,1"
      printf "JNORM,1,%.12E,%s,%.12E\n", c, m, 1 / c
      print "SPCM,1,1,21"
      printf "FORCE,1,1,,%.12E,0.0,-1.0\nFORCE,1,2,,%.12E,0.0,-1.0\nENDDATA\n", p / 4, p / 4
   }' > "$work/$1.bdf"
   run "$1" || return 1
   # w at the load and at the end, the moment of the joint about the load, the rest of the first integral of the power law, where it
   # begins to gape, the largest difference from the reference
   read -r w0 w_end m0 integral contact <<< "$(value "$1" print 'first(lambda)' print 'last(lambda)' print "$beam_moment" \
      print "($beam_moment)^2/(2*9500*20*1000/12*20/((1/$3 + 1)*($4)^(1/$3))*(first(lambda)^(1/$3 + 1) - max(last(lambda), 0)^(1/$3 + 1))) - 1" \
      print 'min(if(before(lambda) > 0 and lambda <= 0, before(x) + (x - before(x))*before(lambda)/(before(lambda) - lambda), 200))')"
   [ "$6" = none ] && return
   profile=$("$query" tests/exact/beam_reference.csv rows "case = \"$6\"" with "$work/$1.joint.csv" on "element=int(x*$2/200 + 1.5)" \
      print 'max(abs(other.lambda - w))/first(w)')
}

# of CASE COLUMN...: what all rows of the case have there
of() { "$query" tests/exact/beam_reference.csv rows "case = \"$1\"" "${@:2}"; }

# ---- warm columns ----

# Two columns of nu = 0 with a joint between them, tied together by two bolts of steel to N0 = 10: the lengths of the bolts and of
# the columns with the joint stay equal, (N - N0)/k_b + 20 alpha_s T = -(N - N0)/k_c - lambda(N) + lambda(N0) + (8 alpha_s + 12 alpha_a) T,
# on the curve where N grows, along E_u = 30 where it falls.
warm_columns() { # NAME T SOLVER
   cards "$1" <<DECK
METHOD = NEWTON;SOLVER = $3;SPC = 1;SUBCASE 1;  TEMPERATURE(LOAD) = 6
SUBCASE 2;  TEMPERATURE(LOAD) = 7;  INCR = 5
BEGIN BULK;MAT1,1,200.,,.0,,1.2-5,20.;MAT1,2,70.,,.0,,2.3-5,20.;PSHELL,1,1,2.;PSHELL,2,2,2.
BLOCK2,1,1,1,2,0.,0.;+,10.,8.;+,20,,21;BLOCK2,2,2,1,2,0.,8.;+,10.,20.,,,,,101,101;+,,,,,1;PMARK,20;PMARK,21
SPCM,1,2,20;SPC1,1,1,1,2,3,102,103;JOINT,1,1,21;PJOINT,1,1;JNORM,1,.02,.5,30.;CROD,301,3,1,103;CROD,302,3,4,106
PROD,3,1,1.;BOLT,1,301,5.;BOLT,2,302,5.;JINCR,5,4,ARITH,.25;TEMPD,6,20.,7,$2;ENDDATA
DECK
   run "$1"
}

# ---- bodies without a joint: springs, Lame's cylinder, the slender beam of MacNeal and Harder ----

# A plate on two springs of 20 to the ground, pulled by 12.
two_springs() { # NAME
   cards "$1" <<'DECK'
SPC = 1;SUBCASE 1;  LOAD = 10
BEGIN BULK;MAT1,1,100.,,.0;PSHELL,1,1,2.;BLOCK2,1,1,1,1,0.,0.;+,4.,3.;SPC1,1,2,1;CELAS1,51,7,1,1;CELAS2,52,20.,,,2,1
PELAS,7,20.;FORCE,10,3,,6.,1.;FORCE,10,4,,6.,1.;ENDDATA
DECK
   run "$1"
}

# inner radius 20, outer 40, pressure 525 inside (so that six digits tell most), ends free: u(r) = p a**2/(b**2 - a**2)/E ((1 - nu) r + (1 + nu) b**2/r)
cylinder() { # NAME N: bodies of revolution, N elements through the wall
   printf 'SPC = 1\nSUBCASE 1\n  LOAD = 1\nBEGIN BULK\nBLOCK2,1,1,%d,1,20.0,0.0\n+,40.0,5.0\n+,20,,,23\nPMARK,20\nPMARK,23\nPAXIS,1,1\nMAT1,1,21000.0,,0.3\nSPCM,1,2,20\nPLOADM,1,525.0,23\nENDDATA\n' \
      "$2" > "$work/$1.bdf"
   run "$1"
}
quarter() { # NAME N: a quarter of it of hexahedra, N through the wall, 2 N round it
   awk -v n="$2" 'BEGIN {
      print "SPC = 1\nSUBCASE 1\n  LOAD = 1\nBEGIN BULK\nPSOLID,1,1\nMAT1,1,21000.0,,0.3\nPMARK,23\nPLOADM,1,525.0,23"
      pi = atan2(0, -1); m = 2 * n
      for (k = 0; k <= 1; k++) for (j = 0; j <= m; j++) for (i = 0; i <= n; i++) {
         g = 1 + i + (n + 1) * (j + (m + 1) * k); r = 20 + 20 * i / n; f = pi / 2 * j / m
         printf "GRID,%d,,%.12f,%.12f,%.12f,,%s\n", g, j == m ? 0 : r * cos(f), j == 0 ? 0 : r * sin(f), 5 * k, (j == m ? "1" : j == 0 ? "2" : "") (k ? "" : "3")
      }
      layer = (n + 1) * (m + 1)
      for (j = 0; j < m; j++) for (i = 0; i < n; i++) {
         a = 1 + i + (n + 1) * j; d = a + n + 1
         print "CHEXA," ++e ",1," a "," a + 1 "," d + 1 "," d "," a + layer "," a + 1 + layer "\n+," d + 1 + layer "," d + layer
         if (i == 0) print "CQUAD4," 100000 + ++f4 ",23," a "," d "," d + layer "," a + layer
      }
      print "SPC1,1,3,1\nENDDATA" }' > "$work/$1.bdf"
   run "$1"
}

# 6 x 0.2 x 0.1, six elements, E = 1E7, nu = 0.3, unit load across the free end
beam2() { # NAME MODES
   printf 'SPC = 1\nSUBCASE 1\n  LOAD = 1\nBEGIN BULK\nBLOCK2,1,1,6,1,0.0,0.0\n+,6.0,0.2\nPSHELL,1,1,0.1\n+,%s\nMAT1,1,1.0+7,,0.3\nSPC1,1,1,1,2\nSPC1,1,2,1\nFORCE,1,13,,0.5,0.0,1.0\nFORCE,1,14,,0.5,0.0,1.0\nENDDATA\n' \
      "$2" > "$work/$1.bdf"
   run "$1"
}
beam3() { # NAME MODES DIRECTION: in y (depth 0.2) or z (depth 0.1)
   { printf 'SPC = 1\nSUBCASE 1\n  LOAD = 1\nBEGIN BULK\nBLOCK3,1,1,6,1,1,0.0,0.0,0.0\n+,6.0,0.2,0.1\n+,20\nPMARK,20\nPSOLID,1,1,,,,%s\nMAT1,1,1.0+7,,0.3\nSPCM,1,1,20\nSPC1,1,23,1\nSPC1,1,%d,%d\n' \
      "$2" "$([ "$3" = y ] && echo 3 || echo 2)" "$([ "$3" = y ] && echo 3 || echo 2)"
     for g in 25 26 27 28; do printf 'FORCE,1,%d,,0.25,0.0,%s\n' $g "$([ "$3" = y ] && echo 1.0,0.0 || echo 0.0,1.0)"; done; echo ENDDATA; } > "$work/$1.bdf"
   run "$1"
}

# The twisted beam of MacNeal and Harder. twisted NAME CARD ALONG ISOP: 48 x 6 x 2 elements; CPENTA have their triangles across the beam. ALONG: 1 along the width, 0 across it
twisted() {
   awk -v card="$2" -v along="$3" -v isop="$4" 'BEGIN {
      nx = 48; ny = 6; nz = 2; right = atan2(0, -1) / 2
      print "ECHO = NO\nSPC = 1\nSUBCASE 1\n  LOAD = 1\nBEGIN BULK"
      for (i = 0; i <= nx; i++) for (j = 0; j <= ny; j++) for (k = 0; k <= nz; k++) {
         a = right * i / nx; y = 1.1 * (j / ny - 0.5); z = 0.32 * (k / nz - 0.5)
         printf "GRID,%d,,%.12f,%.12f,%.12f\n", at(i, j, k), 12 * i / nx, y * cos(a) - z * sin(a), y * sin(a) + z * cos(a)
         if (i == 0) print "SPC1,1,123," at(i, j, k)
         if (i == nx) printf "FORCE,1,%d,,%.12f,0.0,%s\n", at(i, j, k), (j % ny ? 1 : 0.5) * (k % nz ? 1 : 0.5) / (ny * nz), along ? "0.0,1.0" : "1.0,0.0"
      }
      for (i = 0; i < nx; i++) for (j = 0; j < ny; j++) for (k = 0; k < nz; k++) {
         a = at(i, j, k); b = at(i, j + 1, k); c = at(i, j + 1, k + 1); d = at(i, j, k + 1); n = at(i + 1, j, k) - a
         if (card == "CHEXA") printf "CHEXA,%d,1,%d,%d,%d,%d,%d,%d\n+,%d,%d\n", ++e, a, b, c, d, a + n, b + n, c + n, d + n
         else {
            printf "CPENTA,%d,1,%d,%d,%d,%d,%d,%d\n", ++e, a, b, c, a + n, b + n, c + n
            printf "CPENTA,%d,1,%d,%d,%d,%d,%d,%d\n", ++e, a, c, d, a + n, c + n, d + n
         }
      }
      print "PSOLID,1,1" (isop == "" ? "" : ",,,," isop) "\nMAT1,1,29.0+6,,0.22\nENDDATA"
   }
   function at(i, j, k) { return 1 + k + (nz + 1) * (j + (ny + 1) * i) }' > "$work/$1.bdf"
   run "$1"
}
# the node in the middle of its end, along the load
tip() { moved "$1" $((1 + 1 + 3*(3 + 7*48))) "$((2 + $2))"; }

# ---- decks of input/ in more increments ----

# input/DECK.bdf as $work/DECK.METHOD.N.bdf, with N equal increments in every stage
variant() { # DECK METHOD N
   awk -v method="$2" -v n="$3" '
      BEGIN { share = sprintf("%.7f", 1 / n) }
      /^METHOD/ { next }
      /^TITLE/ { print; print "METHOD = " method; next }
      /^ *OUTPUT/ { next }
      /^SUBCASE/ { print; print "  OUTPUT = NONE"; next }
      /^JINCR/ { gsub(",", " "); printf "JINCR,%d,%d,ARITH,%s\n", $2, n, share; next }
      { print }' "input/$1.bdf" > "$work/$1.$2.$3.bdf"
   run "$1.$2.$3"
}

# ---- vibration ----

# A bar of N elements, fixed at one end, moves along itself alone. The equations of its nodes have exact solutions:
# omega^2 = (6 E/(rho h^2)) (1 - cos t)/(2 + cos t), lumped (2 E/(rho h^2)) (1 - cos t), t = (2 j - 1) pi/(2 n), or j pi/n free at both ends.
oscillating_bar() { # NAME N MASS MODES
   local nodes=$((2*($2 + 1)))
   cards "$1" <<DECK
SPC = 1;MASS = $3;SUBCASE 1;  LOAD = 10;  $4 = 5
BEGIN BULK;BLOCK2,1,1,$2,1,0.0,0.0;+,500.0,10.0,,,,,1,1;+,,,,40;PMARK,40;PSHELL,1,1,2.0;MAT1,1,2.1E5,,0.0,7.85E-9
SPC1,1,2,1,THRU,$nodes;SPCM,1,1,40;FORCE,10,$nodes,,1.0,1.0;EIGRL,5,,,3;ENDDATA
DECK
   run "$1"
}

# Three sections of the bar of oscillating_bar, one of them its end, have equations that tie their nodes.
tie_sections() { # NAME N
   local i
   sed -i 's/^SPC = 1$/&\nMPC = 7/; /^ENDDATA/d' "$work/$1.bdf"
   for i in 1 $(($2/2)) $2; do echo "MPC,7,$((2*i + 1)),1,1.0,$((2*i + 2)),1,-1.0"; done >> "$work/$1.bdf"
   echo ENDDATA >> "$work/$1.bdf"
   run "$1"
}

# A cantilever, n elements with incompatible modes along it, L/h = 100, plane stress.
oscillating_cantilever() { # NAME N
   cards "$1" <<DECK
SPC = 1;SUBCASE 1;  LOAD = 10;  MODES = 5
BEGIN BULK;BLOCK2,1,1,$2,1,0.0,0.0;+,1000.0,10.0,,,,,1,1;+,,,,40;PMARK,40;PSHELL,1,1,2.0;+,YES
MAT1,1,2.1E5,,0.0,7.85E-9;SPCM,1,12,40;FORCE,10,1,,1.0,0.0,1.0;EIGRL,5,,,2;ENDDATA
DECK
   run "$1"
}

# Two bars end to end, elements of second order, with a joint between them that is a spring K = E_u A for oscillation.
two_bars() { # NAME
   cards "$1" <<'DECK'
METHOD = NEWTON;SPC = 1;SUBCASE 1;  LOAD = 10;  MODES = 5
BEGIN BULK;BLOCK2,1,1,60,1,0.0,0.0;+,300.0,10.0,,,,,1,1;+,11,20,12,40,,2
BLOCK2,2,1,40,1,300.0,0.0;+,500.0,10.0,,,,,1001,1001;+,13,22,14,21,,2;PMARK,11;PMARK,12;PMARK,13;PMARK,14;PMARK,20
PMARK,21;PMARK,22;PMARK,40;PSHELL,1,1,2.0;MAT1,1,2.1E5,,0.0,7.85E-9;JOINT,1,1,20,21;PJOINT,1,1;JNORM,1,1.0-3,0.5,2.0E3
SPCM,1,2,11;SPCM,1,2,12;SPCM,1,2,13;SPCM,1,2,14;SPCM,1,1,40;PLOADM,10,5.0,22;EIGRL,5,,,4;ENDDATA
DECK
   run "$1"
}

# Their four lowest frequencies: K cos(k (l_1 + l_2)) = E A k cos(k l_1) sin(k l_2), omega = k sqrt(E/rho), by bisection.
two_bar_frequencies() {
   awk 'function g(k) { return 2e3*cos(k*500) - 2.1e5*k*cos(k*300)*sin(k*200) }
      BEGIN { step = 1e-5
         for (a = step/3; n < 4; a += step) {
            if (g(a)*g(a + step) > 0) continue
            lo = a; hi = a + step
            for (i = 0; i < 80; i++) { mid = (lo + hi)/2; if (g(lo)*g(mid) > 0) lo = mid; else hi = mid }
            printf "%.15g ", lo*sqrt(2.1e5/7.85e-9)/(2*atan2(0, -1)); n++ } }'
}

# A rigid block on its joint, pressed evenly: lambda_n = E_u A/M; sliding and rocking about z are coupled, of the block on its
# springs below the centre: [k_x, k_x c; k_x c, k_x c^2 + k_t] = lambda [M, I]. Stiffness of the block taken away by a second run.
block_on_joint() { # NAME E SOLVER MODES
   cards "$1" <<DECK
METHOD = NEWTON;SOLVER = $3;SUBCASE 1;  LOAD = 10;  $4 = 5
BEGIN BULK;BLOCK3,1,1,4,4,4,0.0,0.0,0.0;+,100.0,60.0,80.0,,,,1,1;+,,,20,21;PMARK,20;PMARK,21;PSOLID,1,1
MAT1,1,$2,,0.3,7.85E-9;JOINT,1,1,20;PJOINT,1,1,2,2;JNORM,1,1.0-3,0.5,5.0E4;JSHEAR,2,1.0E4,0.0;EIGRL,5,,,6
PLOADM,10,2.0,21;ENDDATA
DECK
   run "$1"
}

# Its frequencies of rocking and sliding, about z with sides 100 and 60, about x with 80 and 60; areas of influence stand at five nodes:
# sum a x^2 = A L^2/12 (1 + 2/4^2)
rocking() { # SIDE SIGN: of the two coupled modes
   local mass='(7.85e-9*100*60*80)' k='(1e4*8000)'
   local t="(5e4*8000*$1^2/12*(1 + 2/16))" i="($mass*($1^2 + 60^2)/12)"
   local b="($k/$mass + ($k*900 + $t)/$i)" c="($k*$t/($mass*$i))"
   echo "sqrt(($b $2 sqrt($b^2 - 4*$c))/2)/(2*$pi)"
}

# A mass on one interface element: across it omega^2 = E_u a/M, along it B'(d; p) a/M with the shear deflection d that a force has
# made, on loading p^(1 - m) a/(m c M) and A'(d; p) a/M. Loss factor of the motion along it: that of the Masing loop of the cubic A(d; p),
# (4/3 |a_2| x^3 + 2 |a_3| x^4)/(pi B' x^2); of that across it none.
mass_on_joint() { # NAME ENTRIES
   cards "$1" <<DECK
METHOD = NEWTON;SUBCASE 1;  LOAD = 10;  MODES = 5;  AMPLITUDE = 1.0E-3;  $2
BEGIN BULK;GRID,1;CJOINT,1,1,1,,100.0,0.0,1.0;PJOINT,1,1,2;JNORM,1,8.0-3,0.5,500.0
JSHEAR,2,100.0,50.0,-2.0E3,-300.0,-1.0E4,-7.0E3;+,400.0,150.0;FORCE,10,1,,1.0,10.0,-130.0;CONM2,4,1,,0.02;EIGRL,5,,,2
ENDDATA
DECK
   run "$1"
}

# Two solids of CHEXA20, 3 x 2 distorted elements on 2 x 3, the upper one loaded at a corner. FORM: plain; turned, each element from another
# of its corners; renumbered, nodes and elements from the last to the first; mirrored, in x.
solids_apart() { # NAME FORM
   awk -v form="$2" 'function is_node() { return i % 2 + j % 2 + k % 2 <= 1 }
   function name(i, j, k, n) { n = first + i + 20*(j + 20*k); return form == "renumbered" ? 90001 - 7*n : n }
   # corners of elements, moved as these are numbered; what is between them is in the middle
   function put(i, j, k) { xy[1] = 60*i/(2*nx); xy[2] = 50*j/(2*ny)
      if (i > 0 && i < 2*nx) xy[1] += 3*sin(first + 2*i + j)
      if (j > 0 && j < 2*ny) xy[2] += 3*cos(first + i + 3*j) }
   function block(nx_, ny_, first_, z, side, mark,   n, t, at, g) { # e, the element, is for node
      nx = nx_; ny = ny_; first = first_
      for (k = 0; k <= 2; k++) for (j = 0; j <= 2*ny; j++) for (i = 0; i <= 2*nx; i++) if (is_node()) {
         put(i - i % 2, j - j % 2, k); x = xy[1]; y = xy[2]
         put(i + i % 2, j + j % 2, k)
         printf "GRID,%d,,%.12f,%.12f,%.12f\n", name(i, j, k), (form == "mirrored" ? -1 : 1)*(x + xy[1])/2, (y + xy[2])/2, z + 10*k }
      for (e = 0; e < nx*ny; e++) {
         n = 0
         for (k = 0; k <= 2; k += 2) for (t = 0; t < 4; t++) { at[++n] = corner(t + (form == "turned")*(e + 1)); level[n] = k }
         for (n = 1; n <= 8; n++) g[n] = node(at[n], at[n], level[n])
         for (n = 1; n <= 4; n++) { t = n % 4 + 1
            g[8 + n] = node(at[n], at[t], 0); g[12 + n] = node(at[n], at[n], 1); g[16 + n] = node(at[n], at[t], 2) }
         printf "CHEXA,%d,1", first + (form == "renumbered" ? 50 - e : e)
         for (n = 1; n <= 20; n++) printf "%s,%d", n == 7 || n == 15 ? "\n+" : "", g[n]
         print ""
         printf "CQUAD4,%d,%d,%d,%d,%d,%d\n", first + 100 + e, mark, g[side + 1], g[side + 2], g[side + 3], g[side + 4] }
      print "PMARK," mark }
   function corner(t) { return (form == "mirrored" ? 7 - t : t) % 4 }
   function node(a, b, k,   i, j) { i = 2*(e % nx); j = 2*int(e/nx)
      return name(i + (a == 1 || a == 2) + (b == 1 || b == 2), j + (a >= 2) + (b >= 2), k) }
   BEGIN {
      print "METHOD = NEWTON\nTOL = 1.0E-13\nSPC = 1\nSUBCASE 1\n  LOAD = 1\n  OUTPUT = NONE\nBEGIN BULK"
      block(3, 2, 1, 0, 4, 20); for (i = 0; i <= 6; i++) for (j = 0; j <= 4; j++) { k = 0; if (is_node()) print "SPC1,1,123," name(i, j, 0) }
      block(2, 3, 2001, 20, 0, 30)
      print "SPC1,1,12," name(0, 0, 2) "\nSPC1,1,2," name(4, 0, 2)
      for (i = 0; i <= 4; i += 2) for (j = 0; j <= 6; j += 2) printf "FORCE,1,%d,,%.1f,0.0,0.0,-1.0\n", name(i, j, 2), 50 + 20*i + 10*j
      print "JOINT,1,1,20,30\nPJOINT,1,1,,,,,0.2\nJNORM,1,8.0-3,0.5,9500.0\nMAT1,1,9500.0,,0.25\nPSOLID,1,1,,,,FULL\nENDDATA" }' \
      > "$work/$1.bdf"
   run "$1"
}

# furthest_apart NAME-A NAME-B SENSE: by how much the pressures at the same places, x of B times SENSE, differ, over the largest; -1: other places
furthest_apart() {
   awk -F, -v sense="$3" 'FNR == 1 { file++; for (c = 1; c <= NF; c++) at[$c] = c; next }
      { place = sprintf("%.6f %.6f", (file == 2 ? sense : 1)*$at["x"] + 1e3, $at["y"]) }
      file == 1 { p[place] = $at["pressure"]; n++; if ($at["pressure"] > most) most = $at["pressure"]; next }
      !(place in p) { worst = 1e9; next }
      { d = p[place] - $at["pressure"]; if (d < 0) d = -d; if (d > worst) worst = d; m++ }
      END { print (n == m && n > 0 ? worst/most : -1) }' "$work/$1.joint.csv" "$work/$2.joint.csv"
}

# One element at p = 0.5 under ORIGIN BRANCH or CURVE with B = C = 2 A(d/2), A = 60 d - 2500 d^2 + 5E4 d^3: the loads at 0.003, -0.003, 0.003, then
# the same of 0.006 and 0.009 as stages 2 to 10
masing_cycles() { # NAME METHOD INCREMENTS ORIGIN
   awk -v method="$2" -v n="$3" -v origin="$4" 'function load(d) { return d < 0 ? -load(-d) : 100*(60*d - 2500*d^2 + 5e4*d^3) }
      BEGIN { print "METHOD = " method "\nUNITS = MM, KGF"
         split("0 .003 -.003 .003 .006 -.006 .006 .009 -.009 .009", d, " ")
         for (i = 1; i <= 10; i++) printf "SUBCASE %d\n LOAD = %d\n INCR = 7\n", i, 100 + i
         print "BEGIN BULK\nGRID,1\nCJOINT,1,1,1,,100.,0.,1.\nPJOINT,1,1,1\nJNORM,1,8.-3,.5,9500.\nFORCE,1,1,,50.,0.,-1.\nJINCR,7," n ",ARITH," 1/n
         print "JSHEAR,1,50.,20.,-2000.,-1000.,4.+4,2.+4\n+,50.,20.,-1000.,-500.,1.+4,5.+3\n+,50.,20.,-1000.,-500.,1.+4,5.+3\n+,,0.5,0.01," origin
         for (i = 1; i <= 10; i++) printf "LOAD,%d,1.,1.,1,1.,%d\nFORCE,%d,1,,%.14E,1.\n", 100 + i, 200 + i, 200 + i, load(d[i])
         print "ENDDATA" }' > "$work/$1.bdf"
}
