# What forces, temperatures and pressures change in the tension of a bolt, each in a stage of its own, and its values after VDI 2230, in
# closed form: springs beside each other. Two columns as in bolts.sh, linear joint; two bolts M3 of k_b = 20 and preload 1500 beside k_p = 250
# of half of the columns and of the joint. Stage 2 pulls each bolt with 12, 3 warms the bolts by 10, 4 adds a pressure that pulls with 6,
# 5 adds a force of 3 and warms by 4 more, 6 adds a force of 6.
of_bolt() { "$query" "$work/$1.bolt.csv" rows "stage = $2 and bolt = $3" rows "increment = max(increment)" print "$4"; }
bolt_parts() { # NAME
   cards "$1" <<DECK
METHOD = NEWTON;UNITS = MM, N;SPC = 1;SUBCASE 1;SUBCASE 2;  LOAD = 10;SUBCASE 3;  LOAD = 10;  TEMPERATURE(LOAD) = 7
SUBCASE 4;  LOAD = 11;  TEMPERATURE(LOAD) = 7;SUBCASE 5;  LOAD = 12;  TEMPERATURE(LOAD) = 8;SUBCASE 6;  LOAD = 13;  TEMPERATURE(LOAD) = 8
BEGIN BULK;MAT1,1,1000.,,.0;MAT1,2,200.,,.0,,1.-4,0.;+,100.;PSHELL,1,1,2.;BLOCK2,1,1,1,1,0.,0.;+,10.,10.;+,20,,21
BLOCK2,2,1,1,1,0.,10.;+,10.,20.,,,,,101,101;+,,,22,,1;PMARK,20;PMARK,21;PMARK,22;SPCM,1,12,20
JOINT,1,1,21;PJOINT,1,1,1,,.5;JNORM,1,.02,1.,50.;JSHEAR,1,40.
CROD,301,3,1,102;CROD,302,3,3,104;PROD,3,2,2.;BOLT,1,301,1500.,1,,M3,8.8,1.25;BOLT,2,302,1500.,1,,M3,8.8,1.25
FORCE,1,102,,12.,0.,1.;FORCE,1,104,,12.,0.,1.;FORCE,2,102,,1.,0.,1.;FORCE,2,104,,1.,0.,1.;PLOADM,3,-.6,22
LOAD,10,1.,1.,1;LOAD,11,1.,1.,1,1.,3;LOAD,12,1.,1.,1,1.,3,3.,2;+;LOAD,13,1.,1.,1,1.,3,9.,2
TEMPD,7,10.;TEMPD,8,14.;ENDDATA
DECK
   sed -i '/^+$/d' "$work/$1.bdf"
   run "$1"
}
bolt_parts parts && {
   phi=$(number '20/270') warm=$(number '-20*250/270*1e-4*20*10')
   for b in 1 2; do
      i=0
      for stage in 2 3 4 5 6; do
         i=$((i + 1))
         set -- $(echo '12 0 0 0;12 1 0 0;12 1 6 0;12 1 6 1;18 1 6 1' | cut -d';' -f$i)
         near "stage $stage, bolt $b: by forces" "$(of_bolt parts $stage $b by_forces)" "$1*$phi" 1e-8
         near "stage $stage, bolt $b: by temperature" "$(of_bolt parts $stage $b by_temperature)" "$2*$warm" 1e-8 1e-9
         near "stage $stage, bolt $b: by pressure" "$(of_bolt parts $stage $b by_pressure)" "$3*$phi" 1e-8 1e-9
         near "stage $stage, bolt $b: by several" "$(of_bolt parts $stage $b by_several)" "$4*(3*$phi + 0.4*$warm)" 1e-8 1e-9
         near "stage $stage, bolt $b: share of the forces" "$(of_bolt parts $stage $b share)" "$phi/2" 1e-8
         near "stage $stage, bolt $b: parts are the change" "$(of_bolt parts $stage $b 'by_forces + by_temperature + by_pressure + by_several')" \
            "$(of_bolt parts $stage $b force) - 1500" 1e-8
         [ $stage -lt 4 ] || near "stage $stage, bolt $b: share of the pressure" "$(of_bolt parts $stage $b share_pressure)" "$phi/2" 1e-8
      done
      near "bolt $b: whole load of the forces" "$(of_bolt parts 6 $b whole_load)" 36 1e-8
   done
   says 'parts in the answer' "$work/parts.log" 'BY FORCES BY TEMPERATURE'
   same 'stages of several kinds are told' "$(grep -c 'NOTE: A STAGE CHANGES LOADS OF SEVERAL KINDS' "$work/parts.log")" 2

   # VDI 2230: d_2, A_S of M3 x 0.5, class 8.8, mu_G = 0.12
   d2=$(number '3 - 0.75*0.75^0.5*0.5') as=$(number 'pi/4*(3 - 13/12*0.75^0.5*0.5)^2')
   near 'working load, whatever the temperature' "$(of_bolt parts 3 1 working_load)" 12 1e-7
   near 'working load with the pressure' "$(of_bolt parts 4 1 working_load)" 18 1e-7
   near 'assembly force' "$(of_bolt parts 4 1 assembly_force)" 1500 1e-9
   near 'residual clamping at F_M/alpha_A' "$(of_bolt parts 2 1 residual)" "1500 - 300 - 12*(1 - $phi)" 1e-8
   near 'amplitude' "$(of_bolt parts 2 1 amplitude)" "12*$phi/(2*$as)" 1e-7
   near 'amplitude without the temperature' "$(of_bolt parts 4 1 amplitude)" "18*$phi/(2*$as)" 1e-7
   near 'fatigue' "$(of_bolt parts 4 1 fatigue)" "min(1000, 0.85*(150/3 + 45)/(18*$phi/(2*$as)))" 1e-7
   near 'fatigue, rolled last' "$(of_bolt parts 4 1 fatigue_rolled)" \
      "(2 - (1500 + $warm + 9*$phi)/(640*$as))*0.85*(150/3 + 45)/(18*$phi/(2*$as))" 1e-7
   torsion=$(number "16/(pi*(4*$as/pi)^1.5)*1500*$d2/2*(0.5/(pi*$d2) + 1.155*0.12)")
   near 'yield' "$(of_bolt parts 2 1 yield)" "640/(((1500 + 12*$phi)/$as)^2 + 3*(0.5*$torsion)^2)^0.5" 1e-7
   near 'opening' "$(of_bolt parts 2 1 opening)" "1200/(12*(1 - $phi))" 1e-7
   says 'VDI 2230 in the answer' "$work/parts.log" 'M3 8.8'
}


# A ring: the bar is four bolts M12, so that each has a quarter of the forces.
cp input/flange_pair.bdf "$work/ring_bolts.bdf"
sed -i 's/^BOLT .*/BOLT,1,901,8.+4,1,,M12,8.8\n+,1.25,.1,4./' "$work/ring_bolts.bdf"
run ring_bolts && {
   near 'ring: assembly force of one bolt' "$(of_bolt ring_bolts 2 1 assembly_force)" 20000 1e-7
   near 'ring: allowed force' "$(of_bolt ring_bolts 2 1 allowed_force)" 49100 2e-3 # Table A of VDI 2230: M12 x 1.25, 8.8, 0.10
   near 'ring: amplitude' "$(of_bolt ring_bolts 2 1 amplitude)" \
      "$("$query" "$work/ring_bolts.bolt.csv" rows 'stage = 2' print 'max(force) - min(force)')/(8*pi/4*(12 - 13/12*0.75^0.5*1.25)^2)" 1e-7
}
