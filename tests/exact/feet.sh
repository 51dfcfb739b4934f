# Friction alone holds what has no other support: a plate under its load on two feet, which its bending spreads apart.

# feet NAME NX MU: NX elements in a row, 400 long, 20 high, 20 thick, 20 x 20 N/mm pressed down; a foot on the base at the left end, one short of the right end
feet() {
   cards "$1" << END
METHOD = NEWTON;LOAD = 11;BEGIN BULK
BLOCK2,1,1,$2,1,0.0,0.0;+,400.0,20.0;+,,,23;PMARK,23
PSHELL,1,1,20.;+,YES;MAT1,1,210000.,,0.3
CBAR,901,20,1,3;CBAR,902,20,3,5;CBAR,903,22,$((2 * $2 - 5)),$((2 * $2 - 3));CBAR,904,22,$((2 * $2 - 3)),$((2 * $2 - 1))
PMARK,20;PMARK,22;JOINT,1,1,20;JOINT,3,1,22
PJOINT,1,1,2,,$3;JNORM,1,1.0-5,0.5,1.0+8;JSHEAR,2,5.0+5
PLOADM,11,1.0,23
ENDDATA
END
   run "$1" ${4:-}
}

# The feet press against each other, within the limits; the laws hold at every node. 573.158: a computation of its own, which minimises
# the energy of plate and laws under given limits, takes new limits from its pressures, and again, until they settle.
feet feet10 10 0.2 && {
   ask 'two feet: equal and opposite' feet10 all 'sum(tau_x*area) = 0 within 1e-6' all 'sum(pressure*area) = 8000 within 1e-6'
   near 'two feet: thrust' "$(value feet10 rows joint=1 print 'abs(sum(tau_x*area))')" 573.158 1e-5
   ask 'two feet: laws' feet10 rows 'branch = "LOAD"' all 'pressure = (lambda/1e-5)^2 within 1e-6' \
      all 'abs(tau_x) <= 0.2*pressure*(1 + 1e-9)' rows 'branch = "LOAD" and slip = 1' all 'abs(tau_x) = 0.2*pressure within 1e-6'
   for joint in 1 3; do
      ask "two feet: joint $joint below its limit" feet10 rows joint=$joint all 'abs(sum(tau_x*area)) < 0.2*sum(pressure*area)'
   done
}
# finer, and friction from little to much
while read -r nx mu; do
   feet feet-$nx-$mu $nx $mu && ask "two feet: $nx elements, mu $mu" feet-$nx-$mu all 'sum(tau_x*area) = 0 within 1e-6' \
      all 'sum(pressure*area) = 8000 within 1e-6' rows 'branch = "LOAD"' all "abs(tau_x) <= $mu*pressure*(1 + 1e-9)"
done <<'DECKS'
8 0.05
12 0.1
20 0.2
20 0.4
30 0.3
DECKS

# Warmed by DT the feet slide further apart under their full limit; cooled again they stick, and the thrust falls by alpha DT L over the
# flexibilities in series: the shear of both nodes in contact, and the plate, which a deck without joints pulls at the same nodes.
feet_span() { awk -F, -v column="$2" '$1 == 1 && $2 == "1" && $12 == "LOAD" { v[$4] = $column } END { print v[1], v[3] }' "$work/$1.joint.csv"; }
thrust_of() { value feet_warmed rows "stage=$1" rows 'load = 1' rows joint=1 print 'abs(sum(tau_x*area))'; }
feet feet_still 20 0.2 && {
   read -r left right <<< "$(feet_span feet_still 6)"
   read -r near_x far_x <<< "$(feet_span feet_still 8)"
   read -r near_a far_a <<< "$(feet_span feet_still 11)"
   sed '/JOINT\|^CBAR\|^JNORM\|^JSHEAR\|^PMARK,2[02]/d; s/^LOAD = 11/SPC = 2\n&/
        s/^PLOADM.*/'"SPC1,2,2,$left,$right\nSPC1,2,1,$left\nFORCE,11,$right,,1.,-1.,0."/ "$work/feet_still.bdf" > "$work/feet_pulled.bdf"
   run feet_pulled && for dt in 2 5; do
      soft="-1*$(moved feet_pulled "$right" 1) + 1/(5e5*$near_a) + 1/(5e5*$far_a)"
      sed "s/^LOAD = 11/SUBCASE 1;LOAD = 11;SUBCASE 2;LOAD = 11;TEMP(LOAD) = 7;SUBCASE 3;LOAD = 11/
           s/^MAT1.*/MAT1,1,210000.,,0.3,,1.2-5,20.;TEMPD,7,$((20 + dt)).0/" "$work/feet_still.bdf" | cards feet_warmed
      run feet_warmed || continue
      near "feet warmed by $dt: the full limit" "$(thrust_of 2)" "0.2*$(value feet_warmed rows stage=2 rows 'load = 1' rows joint=1 print 'sum(force)')" 1e-9
      near "feet cooled by $dt: thrust" "$(thrust_of 3)" "abs($(thrust_of 2) - 1.2e-5*$dt*($far_x - $near_x)/($soft))" 1e-5
   done
}
