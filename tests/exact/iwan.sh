# JIWAN: whole runs against sums of Jenkins elements that are made here from Segalman's density, and against his closed forms.

# The slices of a law, in awk: make(FS, KT, CHI, BETA, N) sets k[m], s[m] and n; phi(...) is phi_max. tau(d, g): the stress from rest, loss(d, g):
# that of a cycle of amplitude d, the strengths times g
slices='
   function phi(fs, kt, chi, beta) { return fs*(1 + beta)/(kt*(beta + (chi + 1)/(chi + 2))) }
   function make(fs, kt, chi, beta, slices,   m, x, x0, a) {
      a = kt/(1 + beta); x0 = 0; n = slices
      for (m = 1; m <= slices; m++) {
         x = exp(-1.6*(slices - m)/sqrt(slices))
         k[m] = a*(x^(chi + 1) - x0^(chi + 1)); s[m] = a*phi(fs, kt, chi, beta)*(chi + 1)/(chi + 2)*(x^(chi + 2) - x0^(chi + 2)); x0 = x
      }
      if (beta > 0) { n++; k[n] = a*beta; s[n] = a*beta*phi(fs, kt, chi, beta) }
   }
   function tau(d, g,   m, t) { t = 0; for (m = 1; m <= n; m++) t += k[m]*d < g*s[m] ? k[m]*d : g*s[m]; return t }
   function loss(d, g,   m, t) { t = 0; for (m = 1; m <= n; m++) if (k[m]*d > g*s[m]) t += 4*g*s[m]*(d - g*s[m]/k[m]); return t }
   function abs(x) { return x < 0 ? -x : x }'

# ---- One element of area 50 on springs, pressed and pushed from stage to stage, along the plane of the joint. Its history has the stress
# of its slices, each a Jenkins element followed along the movements and pressures that the history tells; it opens and closes too.
# element NAME METHOD INCREMENTS PJOINT-FIELDS STAGES: each stage N,X,Y
element() {
   local name=$1 method=$2 increments=$3 laws=$4 at k=0
   shift 4
   {
      printf '%s\n' "METHOD = $method" 'MODEL = SPACE' 'INCR = 9'
      for at; do k=$((k + 1)); printf 'SUBCASE %d\n  LOAD = %d\n' $k $k; done
      printf '%s\n' 'BEGIN BULK' 'GRID,5,,1.,2.,3.' 'CJOINT,8,1,5,,50.,0.,0.,-1.' "PJOINT,1,1,$laws" 'JNORM,1,2.-4,1.,5000.' \
         'JIWAN,7,2.4,1600.,-0.5,0.5' 'CELAS2,11,20000.,5,1' 'CELAS2,12,20000.,5,2' 'CELAS2,13,1000.,5,3' \
         "JINCR,9,$increments,ARITH,$(awk "BEGIN { printf \"%.15f\", 1/$increments }")"
      k=0
      for at; do
         k=$((k + 1))
         awk -F, -v k=$k '{ if ($1) printf "FORCE,%d,5,,%.1f,0.,0.,-1.\n", k, $1; if ($2) printf "FORCE,%d,5,,%.1f,1.,0.,0.\n", k, $2; if ($3) printf "FORCE,%d,5,,%.1f,0.,1.,0.\n", k, $3 }' <<< "$at"
      done
      echo ENDDATA
   } | cards "$name"
   run "$name"
}
# jenkins WORDS NAME RELATIVE PREF: the history of NAME. Where a slice slides, l dn/df = e - n (n . e) by the method of Runge and Kutta, e what
# its stress would grow by, l the mean of its limit
jenkins() {
   judge "$1" -F, -v within="$3" -v pref="$4" "$slices"'
      BEGIN { make(2.4, 1600, -0.5, 0.5, 20) }
      function rate(a) { return (ey*cos(a) - ex*sin(a))/l }
      function move(m, l1, l2,   a, f, h, i, low, steps, r, r1, r2, r3, r4) { # m: the slice, (ex, ey): what its stress would grow by
         low = sqrt(x[m]^2 + y[m]^2); if (l1 < low) l1 = low
         low = 0; f = 1
         for (i = 1; i <= 60; i++) {
            r = (low + f)/2
            if ((x[m] + r*ex)^2 + (y[m] + r*ey)^2 > (l1 + r*(l2 - l1))^2) f = r; else low = r
         }
         a = atan2(y[m] + f*ey, x[m] + f*ex); l = (l1 + f*(l2 - l1) + l2)/2
         h = (1 - f)*sqrt(ex^2 + ey^2)/l; if (h > 40) f = 1 - (1 - f)*40/h # turned entirely
         steps = int(40*(h < 40 ? h : 40)) + 10; h = (1 - f)/steps
         for (i = 1; i <= steps; i++) {
            r1 = rate(a); r2 = rate(a + h*r1/2); r3 = rate(a + h*r2/2); r4 = rate(a + h*r3); a += h*(r1 + 2*r2 + 2*r3 + r4)/6
         }
         x[m] = l2*cos(a); y[m] = l2*sin(a)
      }
      NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
      $at["branch"] == "OPEN" { g_before = pref ? 0 : 1; for (m = 1; m <= n; m++) x[m] = y[m] = 0; dx = dy = 0; next }
      { g = pref ? $at["pressure"]/pref : 1; tx = ty = 0; slides = 1
        for (m = 1; m <= n; m++) {
           ex = k[m]*($at["delta_x"] - dx); ey = k[m]*($at["delta_y"] - dy)
           if (sqrt((x[m] + ex)^2 + (y[m] + ey)^2) > g*s[m]) move(m, g_before*s[m], g*s[m])
           else { slides = 0; x[m] += ex; y[m] += ey }
           tx += x[m]; ty += y[m]
        }
        g_before = g
        dx = $at["delta_x"]; dy = $at["delta_y"]
        if (abs(tx - $at["tau_x"]) > within*2.4 || abs(ty - $at["tau_y"]) > within*2.4) printf "stage %d, increment %d: %s, %s, expected %.12f, %.12f\n", $1, $2, $at["tau_x"], $at["tau_y"], tx, ty
        if (abs($at["slid_x"] - (dx - tx/1600)) > within*0.01) print "stage " $1 ", increment " $2 ": slid " $at["slid_x"] ", expected " dx - tx/1600
        if ($at["slip"] != slides) print "stage " $1 ", increment " $2 ": slip " $at["slip"] }
      END { print "checked " NR - 1 }' "$work/$2.joint.csv"
}
stages='400,0,0 400,130,0 400,-60,0 300,90,-120 200,100,40 -60,150,0 400,-20,0 400,-130,50'
for increments in 1 4 25; do
   element walk NEWTON $increments ',,,-1,,7;+,8.0' $stages && jenkins "a walk in $increments increments, NEWTON" walk 1e-9 8
   element fixed NEWTON $increments ',,,-1,,7' $stages && jenkins "a walk in $increments increments, F_S without the pressure" fixed 1e-9 0
done
same 'it opens and closes' "$(value walk rows 'branch = "OPEN"' rows 'increment = 25' print 'count()')" 1
same 'the sum of its energies: put in is given back, kept and lost' "$(table walk 'ENERGY OF JOINTS' | awk 'NF == 8 && $1 == 1 { n++
   if (($5 - $6 - $7 - $8)^2 > (3e-5*$5)^2 || $8 < 0) print } END { print n }')" 8

# ---- STEP: with re-analyses to the end it is where NEWTON is; with one it tends there with the increments, four times as many leave a quarter of the error
pushed='400,0,0 400,130,0 400,-60,80'
element exact NEWTON 16 ',,,-1,8.0,7;+,8.0' $pushed && element all STEP 16 ',,,-1,8.0,7;+,8.0' $pushed && {
   same_rows 'STEP with all re-analyses and NEWTON' all exact 1e-6 tau_x tau_y
   jenkins 'STEP with all re-analyses: the slices' all 1e-6 8
}
errors=()
for increments in 20 80 320; do
   element one STEP $increments ',,,1,8.0,7;+,8.0' $pushed && element one_exact NEWTON $increments ',,,1,8.0,7;+,8.0' $pushed || continue
   errors+=("$("$query" "$work/one.joint.csv" with "$work/one_exact.joint.csv" print 'max(abs(delta_x - other.delta_x))')")
done
holds "STEP tends to NEWTON: ${errors[*]}" "${errors[0]} < 1e-4 and ${errors[1]} < 0.35*${errors[0]} and ${errors[2]} < 0.35*${errors[1]}"

# ---- BACK: the movement along (3, 4)/5 under which spring and curve carry the load: the stress of the curve; all slices slide beyond phi_max
element back BACK 1 ',,,1,8.0,7;+,8.0' 400,54,72 && judge 'BACK: the curve' -F, "$slices"'
   BEGIN { make(2.4, 1600, -0.5, 0.5, 20) } NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
   { d = sqrt($at["delta_x"]^2 + $at["delta_y"]^2); t = sqrt($at["tau_x"]^2 + $at["tau_y"]^2); g = $at["pressure"]/8
     if (abs(t - tau(d, g)) > 1e-4*t || abs(50*t + 20000*d - 90) > 1e-6) print t ", expected " tau(d, g); print "checked 2" }' "$work/back.joint.csv"
element back BACK 1 ',,,1,8.0,7;+,8.0' 400,400,0 && same 'BACK: it slides' "$(cell back 1 1 5 slip)" 1

# ---- A lap, pulled and turned back: both solvers
lap() {
   awk -v solver="$2" -v n=6 '/^SOLVER|^INCR|^ *INCR/ { next } /^BEGIN/ { bulk = 1 }
      !bulk && /^SUBCASE/ && !done++ { print "SOLVER = " solver; print "INCR = 77" }
      /^JINCR/ { next } /^PJOINT/ { print "PJOINT,1,1,,,,-1,1.0,7"; print "+,0.3"; print "JIWAN,7,0.06,100.,-0.4,0.2"; print "JINCR,77," n ",ARITH," 1/n; next } { print }' \
      input/lap_joint.bdf > "$work/$1.bdf"
   run "$1"
}
lap tree TREE && lap skyline SKYLINE && same_rows 'SKYLINE and TREE' tree skyline 1e-8 $along

# ---- BACKBONE: a mass on the element: the secant of its curve and the loss of its Masing loops, at amplitudes from below the first slice to
# beyond phi_max, in any number of increments; with many slices they are Segalman's, loss 4 R x^(chi+3)/((chi+2)(chi+3))
# pushed_mass NAME JAMPL PJOINT-FIELDS JIWAN-FIELDS [MORE]
pushed_mass() {
   cards "$1" <<DECK
METHOD = ${6:-NEWTON};SUBCASE 1;  LOAD = 10;  MODES = 5;  BACKBONE = 6;BEGIN BULK;GRID,1;FORCE,10,1,,1.0,0.0,-130.0
CONM2,4,1,,0.02;EIGRL,5,,,2;$2;CJOINT,1,1,1,,100.0,0.0,-1.0;PJOINT,1,1,$3;JNORM,1,8.0-3,0.5,500.0;JIWAN,7,$4;$5;ENDDATA
DECK
   run "$1"
}
# rows WORDS NAME N RELATIVE: p = 1.3 is PREF/2; spring 1000 beside it; N = 0: the closed form
rows() {
   judge "$1" -F, -v slices_of="$3" -v within="$4" "$slices"'
      function near(a, b) { return (a - b)^2 <= (within*b)^2 + 1e-22 }
      BEGIN { pi = atan2(0, -1); if (slices_of) make(0.2, 40, -0.6, 0.3, slices_of); g = 0.5; p = g*phi(0.2, 40, -0.6, 0.3); r = 40*0.4/1.3/p^0.4 }
      NR == 1 { next }
      { x = $3; t = slices_of ? tau(x, g) : x < p ? 40*x - r*x^1.4/(0.4*1.4) : g*0.2; d = slices_of ? loss(x, g) : 4*r*x^2.4/(1.4*2.4)
        if (!slices_of && x > p) next
        stiff = 100*t/x + 1000; f = sqrt(stiff/0.02)/(2*pi); n_rows++
        if (!near($4, f)) print "amplitude " x ": frequency " $4 ", expected " f
        if (!near($5, 100*d/(pi*stiff*x*x))) print "amplitude " x ": loss factor " $5 ", expected " 100*d/(pi*stiff*x*x) }
      END { print "checked " n_rows }' "$work/$2.backbone.csv"
}
for n in 1 8; do
   pushed_mass mass "JAMPL,6,1,0.03,13,1.0-4,,$n" ',,,,,7;+,2.6' 0.2,40.0,-0.6,0.3 CELAS2,2,1000.0,1,1 && rows "backbone in $n increments" mass 20 2e-6
done
pushed_mass mass 'JAMPL,6,1,0.03,7,1.0-3' ',,,,,7;+,2.6' 0.2,40.0,-0.6,0.3 CELAS2,2,1000.0,1,1 STEP && rows 'backbone about a state of STEP' mass 20 2e-6
pushed_mass mass 'JAMPL,6,1,0.004,9,1.0-2' ',,,,,7;+,2.6' 0.2,40.0,-0.6,0.3,400 CELAS2,2,1000.0,1,1 && rows 'backbone with many slices' mass 0 3e-3
