# A support shares the load with the joint, so statics does not tell its first pressure: NEWTON and BACK guess one, and their answer
# is the same from any other.

guess() { # NAME METHOD P0
   cards "$1" <<END
METHOD = $2;SPC = 1;SUBCASE 1;  LOAD = 1;  INCR = 2
BEGIN BULK;BLOCK2,1,1,10,3,0.,0.;+,100.,30.;+,20;PMARK,20;PSHELL,1,1,10.;MAT1,1,210000.,,0.3;JOINT,1,1,20
PJOINT,1,1,,,,,$3;JNORM,1,8.-3,0.5,9500.;SPC1,1,12,41;FORCE,1,24,,100.,0.,-1.;JINCR,2,2;ENDDATA
END
   "$program" -q -o "$work" "$work/$1.bdf" 2> "$work/$1.log"
}

for method in NEWTON BACK; do
   guess "guess_$method" $method ''
   same "$method without P0: status" $? 0
   for p0 in 1.0-5 10.0; do
      guess given $method $p0
      for node in 5 13 21 29; do
         increment=2 tolerance=1e-9
         [ $method = BACK ] && increment=1 tolerance=1e-4
         near "$method, P0 = $p0, guessed: p of node $node" "$(cell "guess_$method" 1 $increment $node pressure)" \
            "$(cell given 1 $increment $node pressure)" $tolerance 1e-9
      done
   done
done
guess guess_STEP STEP ''
same 'STEP without P0: status' $? 2

# first_p NAME JOINT: FIRST P (EQ.9) of the listing
first_p() { awk -v j="$2" '/FIRST P \(EQ.9\)/ { on = 1; next } on && $1 == j { print $7; exit }' "$work/$1.out"; }

# Two plates of 200 x 10 stand side by side, each on two feet of 40 x 10: one is clamped by two bolts of 5000, one has its weight of 50
# alone. The first pressure of a foot is that of its own plate, whatever the bolts of the other are.
for method in NEWTON BACK; do
   cards resting <<END
METHOD = $method;SPC = 1;LOAD = 1
BEGIN BULK;BLOCK2,1,1,10,2,0.,0.;+,200.,20.,,,,,1,1
BLOCK2,2,1,10,2,300.,0.;+,500.,20.,,,,,101,101
CBAR,901,21,1,4;CBAR,902,21,4,7;CBAR,903,22,25,28;CBAR,904,22,28,31
CBAR,905,23,101,104;CBAR,906,23,104,107;CBAR,907,24,125,128;CBAR,908,24,128,131
PMARK,21;PMARK,22;PMARK,23;PMARK,24;PSHELL,1,1,10.;MAT1,1,210000.,,0.3
JOINT,1,1,21;JOINT,2,1,22;JOINT,3,1,23;JOINT,4,1,24;PJOINT,1,1,;JNORM,1,8.-3,0.5,9500.;SPC1,1,1,16,116
FORCE,1,6,,5000.,0.,-1.;FORCE,1,30,,5000.,0.,-1.;FORCE,1,118,,50.,0.,-1.;ENDDATA
END
   run resting && for j in 1 2 3 4; do
      near "$method: first pressure of foot $j" "$(first_p resting $j)" "$([ $j -le 2 ] && echo 10000/800 || echo 50/800)" 1e-4
   done
done

# P0 is a first guess for NEWTON, whatever its size: here ten decades above the pressure.
for p0 in '' 1.0 100.0; do
   cards "tiny$p0" <<END
METHOD = NEWTON;LOAD = 1
BEGIN BULK;BLOCK2,1,1,4,2,0.,0.;+,10.,10.;+,20;PMARK,20;PSHELL,1,1,10.;MAT1,1,9500.,,0.;JOINT,1,1,20
PJOINT,1,1,1,,0.2,,$p0;JNORM,1,8.-3,0.5,9500.;JSHEAR,1,100.,300.;FORCE,1,15,,1.-7,0.,-1.;ENDDATA
END
   run "tiny$p0" && ask "P0 '$p0' and a pressure of 1E-9" "tiny$p0" all 'sum(pressure*area) = 1e-7 within 1e-15'
done
