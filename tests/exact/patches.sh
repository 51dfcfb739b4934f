# The patch test of MacNeal and Harder as whole decks, of CHEXA, CPENTA and CTETRA, linear and of second order: the stress is the
# same in every element, to the six digits of the listing (to 1E-12: unit/test_element_patches.pf), and the nodes inside move as the
# corners do.

# equations: node 9, of which the elements have one more, moves by an equation of 21 terms that every linear field fulfils: as the
# trilinear functions of the cube interpolate, with 0.1 (u of the middle of an edge - mean of its ends) = 0 added for each edge. An
# element then has more unknowns than its own nodes.
cp tests/exact/patch.inc tests/exact/patch_*.bdf "$work/"
# CHEXA of 8 and CPENTA of 6 nodes with their modes, as PSOLID has them when ISOP is blank, and without
sed 's/^PSOLID,1,1$/&,,,,PLAIN/' "$work/patch.inc" > "$work/plain.inc"
for kind in hexa penta; do sed "s/'patch.inc'/'plain.inc'/" "$work/patch_$kind.bdf" > "$work/patch_${kind}_plain.bdf"; done
awk 'BEGIN { split("1 2 2 3 3 4 4 1 5 6 6 7 7 8 8 5 1 5 2 6 3 7 4 8", end)
             x[1] = 0.249; x[2] = 0.342; x[3] = 0.192; split("011001100011001100001111", digit, "") }
     function weight(k,   i, w) {                            # of corner k: the signs stand by axis in DIGIT
        w = 1
        for (i = 1; i <= 3; i++) w *= digit[8*(i - 1) + k] ? x[i] : 1 - x[i]
        return w
     }
     /^SPC = / { print; print "MPC = 7"; next }
     /^ENDDATA/ {
        for (k = 1; k <= 8; k++) a[k] = weight(k)
        for (k = 21; k <= 32; k++) { a[k] = 0.1; a[end[2*(k - 20) - 1]] -= 0.05; a[end[2*(k - 20)]] -= 0.05 }
        for (c = 1; c <= 3; c++) {
           line = sprintf("MPC,7,9,%d,-1.0", c); n = 1
           for (k = 1; k <= 32; k++) if (k in a) {
              if (n % 2 == 0) { print line ","; line = "," } # columns 2 to 8, field 9 blank
              line = line sprintf(",%d,%d,%s", k, c, n ? sprintf("%.16f", a[k]) : ""); n++
           }
           print line
        }
     }
     { print }' "$work/patch_hexa20.bdf" > "$work/patch_equations.bdf"
for kind in hexa hexa_plain penta penta_plain tetra hexa20 penta15 tetra10 equations; do
   run patch_$kind && judge "patch test of C${kind^^}" '
      function size(x) { return x < 0 ? -x : x }
      function check(found, expected) { n++; if (!(size(found - expected) <= 1e-9 + 2e-6 * size(expected))) print FNR ": " found ", expected " expected }
      / DISPLACEMENTS OF NODES/ { table = "nodes" }
      / STRESSES/ { table = "stresses" }
      / REACTIONS| BALANCE/ { table = "" }
      $1 + 0 != $1 || NF < 7 { next }
      table == "nodes" {
         nodes++
         check($5, 1e-3 * ($2 + $3 / 2 + $4 / 2)); check($6, 1e-3 * ($2 / 2 + $3 + $4 / 2)); check($7, 1e-3 * ($2 / 2 + $3 / 2 + $4))
      }
      table == "stresses" && NF == 10 { elements++; for (k = 5; k <= 7; k++) check($k, 2000); for (k = 8; k <= 10; k++) check($k, 400) }
      END { if (nodes < 16 || elements < 7) print nodes " nodes, " elements " elements"; print "checked " n }' "$work/patch_$kind.out"
done

# MAT9, any matrix, warmed: the stress is [D] ({epsilon} - {alpha} 10), the strains are 1E-3; then the axes of the material turned by CORDM
patches_matrix='3000 1000 800 100 50 -60 2500 700 -80 90 40 2000 30 -20 110 900 60 -70 800 50 700'
sed 's/^MAT1.*/MAT9,1,3.0+6,1.0+6,8.0+5,1.0+5,5.0+4,-6.0+4,2.5+6\n+,7.0+5,-8.0+4,9.0+4,4.0+4,2.0+6,3.0+4,-2.0+4,1.1+5\n+,9.0+5,6.0+4,-7.0+4,8.0+5,5.0+4,7.0+5,,1.0-5\n+,2.0-5,-3.0-5,4.0-6,-5.0-6,6.0-6\nTEMPD,3,10.0/' \
   "$work/patch.inc" > "$work/matrix.inc"
for kind in hexa penta tetra hexa20 penta15 tetra10; do
   sed "s/'patch.inc'/'matrix.inc'/; s/^  LOAD = 1/&\nTEMPERATURE(LOAD) = 3/" "$work/patch_$kind.bdf" > "$work/patch_matrix.bdf"
   run patch_matrix && judge "patch test of C${kind^^} of MAT9" -v matrix="$patches_matrix" '
      function size(x) { return x < 0 ? -x : x }
      BEGIN { split(matrix, g, " "); split("1 2 -3 0.4 -0.5 0.6", alpha, " ")
         for (i = 1; i <= 6; i++) for (j = i; j <= 6; j++) { n++; s[i] += g[n]*(1 - 0.1*alpha[j]); if (j > i) s[j] += g[n]*(1 - 0.1*alpha[i]) }
         n = 0 }
      / STRESSES/ { on = 1 }
      / REACTIONS| BALANCE/ { on = 0 }
      on && $1 + 0 == $1 && NF == 10 { n++; for (k = 1; k <= 6; k++) if (!(size($(4 + k) - s[k]) <= 4e-6*size(s[k]))) print "element " $1 ": " $(4 + k) ", expected " s[k] }
      END { if (n < 7) print n " elements"; print "checked " n }' "$work/patch_matrix.out"
done
# a bar of 10 x 1 x 1 whose fibres are 30 degrees off its axis, pulled by 100: R. M. Jones, Mechanics of Composite Materials, section 2.8
awk 'BEGIN {
   e1 = 140000; e2 = 10000; e3 = 8000; a = 1/e1; b = 1/e2; c = 1/e3; f = -0.3/e1; g = -0.25/e1; h = -0.4/e2
   det = a*(b*c - h*h) - f*(f*c - g*h) + g*(f*h - b*g)
   print "SPC = 1\nLOAD = 1\nBEGIN BULK\nPSOLID,1,9,5\nCORD2R,5,,0.0,0.0,0.0,0.0,0.0,1.0\n+,0.8660254037844387,0.5,0.0"
   for (n = 0; n < 8; n++) printf "GRID,%d,,%.1f,%.1f,%.1f\n", n + 1, n < 4 ? 0 : 10, int(n/2) % 2, n % 2
   print "CHEXA,1,1,1,5,7,3,2,6\n+,8,4\nSPC1,1,1,1,2,3,4\nSPC1,1,23,1\nSPC1,1,3,3"
   for (n = 5; n < 9; n++) print "FORCE,1," n ",,25.0,1.0,0.0,0.0"
   printf "MAT9*,9,%.10E,%.10E,%.10E\n*,,,,%.10E\n", (b*c - h*h)/det, (g*h - f*c)/det, (f*h - b*g)/det, (a*c - g*g)/det
   printf "*,%.10E,,,\n*,%.10E\n*,5000.0,,,3000.0\n*,,4000.0\nENDDATA\n", (f*g - a*h)/det, (a*b - f*f)/det }' > "$work/fibres.bdf"
fibres='s = 0.5; c = 0.75^0.5; s11 = 1/140000; s12 = -0.3/140000; s22 = 1/10000; s66 = 1/5000'
run fibres && {
   near 'fibres off the axis: its strain' "$(moved fibres 5 1)" "$(awk "BEGIN { $fibres; printf \"%.12g\", 1000*(s11*c^4 + (2*s12 + s66)*s^2*c^2 + s22*s^4) }")" 1e-6
   near 'fibres off the axis: its shear' "$(moved fibres 5 2)" \
      "$(awk "BEGIN { $fibres; printf \"%.12g\", 1000*((2*s11 - 2*s12 - s66)*s*c^3 - (2*s22 - 2*s12 - s66)*s^3*c) }")" 1e-6
}

sed 's/^LOAD = 1/TEMPERATURE(LOAD) = 3/; /^FORCE/d; s/^\*,,4000.0$/*,,4000.0,,1.0-6\n*,3.0-5,2.0-5,,\n*,,/; s/^ENDDATA/TEMPD,3,10.0\n&/' "$work/fibres.bdf" > "$work/fibres_warm.bdf"
run fibres_warm && {
   near 'fibres off the axis, warmed: its length' "$(moved fibres_warm 5 1)" '(0.75*1e-6 + 0.25*3e-5)*100' 1e-6
   near 'fibres off the axis, warmed: its shear' "$(moved fibres_warm 5 2)" '-2.9e-5*0.8660254038*100' 3e-6
   near 'fibres off the axis, warmed: its thickness' "$(moved fibres_warm 6 3)" '2e-5*10' 1e-6
}

# ---- shells: a rectangle of 24 x 12 bears constant stress under the nodal forces of that stress, which have no moments, and under PLOADM ----

# shell_patch NAME MESH STRESS...: 4 x 3 cells. MESH: words of even (else nodes lie anywhere, those of the sides on the sides), quad, tria, mixed (else),
# turned (diagonals), reversed (every other element clockwise), double (each element twice, half as thick). STRESS: S_X, S_Y, S_XY, or PLOADM.
# The first lines are the displacements expected: node, u, v.
shell_patch() {
   awk -v mesh="$2" -v stress="${*:3}" '
      function is(word) { return index(mesh, word) > 0 }
      function element(a, b, c, d,   k, t) {
         for (k = 0; k <= is("double"); k++) {
            t = is("reversed") && e++ % 2 ? c "," b "," a : a "," b "," c
            if (d) printf "CQUAD4,%d,1,%d,%d,%d,%d\n", ++id, a, b, c, d; else printf "CTRIA3,%d,1,%s\n", ++id, t
         }
      }
      function side(a, b,   k, n) {                          # the body lies to the left: the outer normal times the length is (dy, -dx)
         dx = x[b] - x[a]; dy = y[b] - y[a]
         if (stress == "PLOADM") { printf "CROD,%d,20,%d,%d\n", ++id, a, b; return }
         for (k = 1; k <= 2; k++) { n = k == 1 ? a : b; fx[n] += 0.5*t*(s[1]*dy - s[3]*dx); fy[n] += 0.5*t*(s[3]*dy - s[2]*dx) }
      }
      BEGIN {
         split(stress == "PLOADM" ? "-80 -80 0" : stress, s, " "); e_ = 2e5; nu = 0.3; t = 0.5
         print "MODEL = SPACE\nSPC = 1\nSUBCASE 1\n  LOAD = 1\n  OUTPUT = LAST, STRESS\nBEGIN BULK"
         split("0 5 13 18 24", at_x, " "); split("0 3 8 12", at_y, " "); split("1.1 -0.7 0.4 -1.3 0.9 0.6 -0.5 1.2 -0.9 0.3 -1.0 0.8", away, " ")
         for (i = 0; i <= 4; i++) for (j = 0; j <= 3; j++) {
            n = 4*i + j + 1; inside = i > 0 && i < 4 && j > 0 && j < 3
            x[n] = is("even") ? 6*i : at_x[i + 1] + (inside ? away[++m] : 0); y[n] = is("even") ? 4*j : at_y[j + 1] + (inside ? away[++m] : 0)
            printf "$ %d %.9g %.9g\nGRID,%d,,%.6f,%.6f,0.0\n", n, (s[1] - nu*s[2])/e_*x[n] + s[3]*2*(1 + nu)/e_*y[n], (s[2] - nu*s[1])/e_*y[n], n, x[n], y[n]
         }
         for (i = 0; i < 4; i++) for (j = 0; j < 3; j++) {
            a = 4*i + j + 1; b = a + 4; c = b + 1; d = a + 1
            if (is("quad") || (is("mixed") && (i + 2*j) % 3 == 0)) element(a, b, c, d)
            else if (is("turned") && (i + j) % 2) { element(a, b, d); element(b, c, d) }
            else { element(a, b, c); element(a, c, d) }
         }
         printf "PSHELL,1,1,%s,1,,1\nMAT1,1,2.0+5,,0.3\nSPC1,1,123,1\nSPC1,1,3,4,17\nSPC1,1,2,17\n", is("double") ? "0.25" : "0.5"
         for (i = 0; i < 4; i++) { side(4*i + 1, 4*i + 5); side(4*i + 8, 4*i + 4) }
         for (j = 1; j < 4; j++) { side(16 + j, 17 + j); side(j + 1, j) }
         if (stress == "PLOADM") print "PMARK,20\nPLOADM,1,80.0,20"
         for (n in fx) if (fx[n]^2 + fy[n]^2 > 1e-12) printf "FORCE,1,%d,,1.0,%.9f,%.9f,0.0\n", n, fx[n], fy[n]
         print "ENDDATA" }' > "$work/$1.bdf"
}
for mesh in 'tria even' 'tria even turned' tria 'tria turned' 'tria turned reversed' 'tria turned double' 'quad even' quad 'mixed even' 'mixed turned' 'mixed turned reversed'; do
   for stress in '100 0 0' '0 100 0' '0 0 60' '70 -40 30' PLOADM; do
      [ "$stress" = PLOADM ] && [[ $mesh == *double* ]] && continue # a marked edge has one shell behind it
      shell_patch shell_patch "$mesh" $stress
      run shell_patch && judge "patch of shells under nodal forces, $mesh: $stress" -v stress="${stress/PLOADM/-80 -80 0}" '
         function check(found, expected, size) { n++; if (!((found - expected)^2 <= (3e-6*size)^2)) print FNR ": " found ", expected " expected }
         BEGIN { split(stress, s, " ") }
         FILENAME ~ /bdf$/ { if ($1 == "$" && NF == 4) { u[$2] = $3; v[$2] = $4 } next }
         / DISPLACEMENTS OF NODES/ { table = 1 }
         / STRESSES AT THE FACES/ { table = 2 }
         / REACTIONS| BALANCE| ROTATIONS/ { table = 0 }
         $1 + 0 != $1 || NF < 7 { next }
         table == 1 && $1 in u { nodes++; check($5, u[$1], 0.012); check($6, v[$1], 0.012) }
         table == 2 { elements++; check($3, s[1], 100); check($4, s[2], 100); check($6, s[3], 100) }
         END { if (nodes < 20 || !elements) print nodes " nodes, " elements " elements"; print "checked " n }' "$work/shell_patch.bdf" "$work/shell_patch.out"
   done
done
