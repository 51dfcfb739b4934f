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
