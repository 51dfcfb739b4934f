# The energy of joints: put in = given back + kept + lost, each by hand, whatever the increments. One element of area 50 beside springs of
# 20000 N/mm: tau = 1600 delta, that is 80000 N/mm, MU 0.3, and where it matters p = 5000 lambda.

# slider NAME METHOD INCREMENTS JNORM-FIELDS LOADS...: each LOADS is a stage, N,X,Y in N: pressed, pushed along x and y. In space.
slider() {
   local name=$1 method=$2 increments=$3 law=$4 k=0 at
   shift 4
   {
      printf '%s\n' "METHOD = $method" 'MODEL = SPACE'
      [ "$method" = BACK ] || echo 'INCR = 9'
      for at; do k=$((k + 1)); printf 'SUBCASE %d\n  LOAD = %d\n' $k $k; done
      printf '%s\n' 'BEGIN BULK' 'GRID,5,,1.,2.,3.' 'CJOINT,8,1,5,,50.,0.,0.,-1.' 'PJOINT,1,1,1,1,0.3,-1' "JNORM,1,$law" 'JSHEAR,1,1600.' \
         'CELAS2,11,20000.,5,1' 'CELAS2,12,20000.,5,2' "JINCR,9,$increments,ARITH,$(awk "BEGIN { printf \"%.15f\", 1/$increments }")"
      k=0
      for at; do
         k=$((k + 1))
         awk -F, -v k=$k '{ printf "FORCE,%d,5,,%.1f,0.,0.,-1.\n", k, $1; if ($2) printf "FORCE,%d,5,,%.1f,1.,0.,0.\n", k, $2; if ($3) printf "FORCE,%d,5,,%.1f,0.,1.,0.\n", k, $3 }' <<< "$at"
      done
      echo ENDDATA
   } > "$work/$name.bdf"
   run "$name"
}

# energies WORDS NAME STAGE RELATIVE NORMAL(put in, given back) SHEAR(put in, given back, kept) LOST: the row of the listing
energies() {
   local words=$1 bound=$4
   judge "$words" -v bound="$bound" -v wanted="$5 $6 $7 $8 $9 ${10}" '
      { split(wanted, w, " "); split("2 3 5 6 7 8", at, " "); size = $2 + $5
        for (i = 1; i <= 6; i++) if ($(at[i]) < w[i] - bound*size || $(at[i]) > w[i] + bound*size) print "column " at[i] ": " $(at[i]) ", expected " w[i]
        if (($5 - $6 - $7 - $8)^2 > (2e-5*size)^2) print "put in is not given back + kept + lost: " $0
        print "checked 1" }' <<< "$(awk -v title="ENERGY OF JOINTS, STAGE $3" 'index($0, title) { on = 1 } on && NF == 8 && $1 == 1 { print; exit }' "$work/$2.out")"
}

# Pressed by 400 and pushed by 200 in proportion: at the limit from the beginning, at the end T = 120; the spring of the branch has
# 120^2/160000, and what slides, 0.004 - 0.0015, takes 60 on the mean. Along (3, 4) in the plane of the joint the same.
for increments in 1 3 20; do
   for sideways in 200,0 120,160 -160,120; do
      slider together NEWTON $increments 2.-4,1.,5000. 400,$sideways &&
         energies "pressed and pushed together in $increments, NEWTON" together 1 2e-6 0.32 0 0.24 0 0.09 0.15
      slider together STEP $increments 2.-4,1.,5000. 400,$sideways &&
         energies "pressed and pushed together in $increments, STEP" together 1 2e-6 0.32 0 0.24 0 0.09 0.15
   done
   # the pressure grows along whatever law: p lambda/3 for m = 1/2
   slider together NEWTON $increments 2.-4,0.5,1.+6 400,200,0 &&
      energies "pressed and pushed together in $increments, m = 0.5" together 1 2e-6 "$(number '400*2e-4*8^0.5/3')" 0 0.24 0 0.09 0.15
done
slider together BACK 1 2.-4,1.,5000. 400,200,0 && energies 'pressed and pushed together, BACK' together 1 1e-5 0.32 0 0.24 0 0.09 0.15
slider together BACK 1 2.-4,0.5,1.+6 400,200,0 &&
   energies 'pressed and pushed together, BACK, m = 0.5' together 1 1e-5 "$(number '400*2e-4*8^0.5/3')" 0 0.24 0 0.09 0.15

# Pressed by 400; pushed by 200, slip begins at 150; relieved to 100 and pushed on to 260: slips at once, the spring gives what it has
# to the slip; turned to -260: the spring gives back 30^2/160000 and takes it again.
for method in NEWTON STEP; do
   for increments in 1 2 7 40; do
      slider parts $method $increments 2.-4,1.,5000. 400,0,0 400,200,0 100,260,0 100,-260,0 || continue
      words="in parts of $increments, $method"
      energies "$words: pressed" parts 1 2e-6 0.32 0 0 0 0 0
      energies "$words: pushed until it slips" parts 2 2e-6 0 0 0.39 0 0.09 0.3
      # one increment of STEP has the excess of its end only: the same
      energies "$words: slips under falling pressure" parts 3 2e-6 0 0.3 0.5625 0 -0.084375 0.646875
      energies "$words: turned" parts 4 2e-6 0 0 0.673125 0.005625 0 0.6675
   done
done

# Round a corner, in both directions: what is kept over all stages is the energy of the spring, and what is put in the work of the
# forces along the way, by the trapezoidal rule on fine increments.
for increments in 1 60; do
   slider corner NEWTON $increments 2.-4,1.,5000. 400,0,0 400,200,0 300,200,190 250,-150,220 || continue
   kept=$(awk '/ENERGY OF JOINTS/ { on = 1 } on && NF == 8 && $1 == 1 { kept += $7; if ($8 < 0) kept += 1; on = 0 } END { printf "%.6e", kept }' "$work/corner.out")
   near "round a corner in $increments: kept" "$kept" "$(value corner rows 'stage = 4' rows 'increment = max(increment)' print '(tau_x^2 + tau_y^2)*50/3200')" 1e-5
done
judge 'round a corner in 60: the work is that of the forces' -F, '
   FILENAME ~ /out$/ { n = split($0, v, " "); if (/ENERGY OF JOINTS/) on = 1; if (on && n == 8 && v[1] == 1) { listed += v[5] - v[6]; on = 0 } next }
   FNR == 1 { for (k = 1; k <= NF; k++) at[$k] = k; next }
   { x = $(at["delta_x"]); y = $(at["delta_y"]); tx = $(at["tau_x"]); ty = $(at["tau_y"])
     work += 25*((tx + tx_0)*(x - x_0) + (ty + ty_0)*(y - y_0)); x_0 = x; y_0 = y; tx_0 = tx; ty_0 = ty }
   END { if ((listed/work - 1)^2 > 1e-6) print listed " listed, " work " done"; print "checked " (listed > 0) }' "$work/corner.joint.csv" "$work/corner.out"
