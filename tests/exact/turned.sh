# The same joint at any angle: a block on a rigid base with shear, friction and no supports, turned with its loads.

turned_block() { # NAME METHOD ANGLE
   awk -v method="$2" -v angle="$3" '
      function place(x, y) { return sprintf("%.12f,%.12f", x * c - y * s, x * s + y * c) }
      BEGIN {
         pi = atan2(0, -1); c = cos(angle * pi / 180); s = sin(angle * pi / 180)
         if (angle == 90) { c = 0; s = 1 }
         print "METHOD = " method
         for (stage = 1; stage <= 5; stage++)
            print "SUBCASE " stage "\n  LOAD = " stage "\n  INCR = " (stage == 1 ? 4 : 8) "\n  OUTPUT = NONE"
         print "BEGIN BULK\nBLOCK2,1,1,10,4," place(0, 0) "," place(100, 0)
         print "+," place(100, 40) "," place(0, 40) "\n+,20\nPMARK,20\nPSHELL,1,1,20.0\nMAT1,1,9500.0,,0.25"
         print "JOINT,1,1,20\nPJOINT,1,1,1,,0.2,3\nJNORM,1,8.0-3,0.5,9500.0"
         print "JSHEAR,1,100.0,300.0,-2.0+4,0.0,3.0+6,0.0\n+,160.0,250.0,1.0+4,0.0,2.0+6,0.0\n+,150.0,280.0,-1.0+4,0.0,2.0+6,0.0"
         # pressed a little off the middle; pushed at the top right corner and drawn back
         printf "FORCE,1,30,,600.0,%.14f,%.14f\nFORCE,1,25,,400.0,%.14f,%.14f\n", s, -c, s, -c
         printf "FORCE,9,55,,130.0,%.14f,%.14f\n", c, s
         print "LOAD,2,1.0,1.0,1,1.0,9\nLOAD,3,1.0,0.7,1,-0.6,9\nLOAD,4,1.0,1.0,1,0.9,9\nLOAD,5,1.0,1.2,1"
         print "JINCR,4,4,ARITH,0.25\nJINCR,8,8,ARITH,0.125\nENDDATA"
      }' > "$work/$1.bdf"
   run "$1"
}

for method in NEWTON STEP; do
   turned_block upright $method 0 || continue
   for angle in 30 90 -45 61.7; do
      turned_block turned $method $angle && same_rows "block turned by $angle degrees, $method" upright turned 1e-10 $along
   done
   # beyond 90 degrees x of the joint points the other way (to +X): shear has the other sign
   for angle in 135 200; do
      turned_block turned $method $angle && same_rows "block turned by $angle degrees, $method" upright turned 1e-10 $against
   done
   # the case has everything in it
   ask "block turned, $method: unloads, reloads, slips, shear of both senses" upright \
      all 'sum(branch = "LOAD") > 0 and sum(branch = "UNLOAD") > 0 and sum(branch = "RELOAD") > 0' \
      all 'sum(branch_x = "LOAD") > 0 and sum(branch_x = "UNLOAD") > 0 and sum(branch_x = "RELOAD") > 0' \
      all 'sum(slip) > 0 and sum(slip) < count() and max(tau_x) > 0 and min(tau_x) <= 0'
done
