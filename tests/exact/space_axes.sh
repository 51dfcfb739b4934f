# The two directions of a joint in space: a block on a rigid base, pressed evenly on the face opposite and then drawn along by a force in
# the plane of the joint, oblique. With nu = 0 and the force on the joint's own nodes nothing bends: pressure and shear are the same
# everywhere, and each direction follows its own cubic, at constant pressure.
#
# x of the joint is +X projected on it (+Y where it stands across X), z goes out of the block, y completes a right-handed triad.

# drawn NAME METHOD FACE: the block 40 x 40 x 40 on its face across axis |FACE|, the lower one where FACE < 0. p = 0.5, then 320 along x
# and -192 along y of the joint, then back to half of both.
drawn() {
   awk -v method="$2" -v face="$3" 'BEGIN {
      axis = face < 0 ? -face : face; up = face > 0 ? 1 : -1
      z[axis] = up                                                # out of the block
      x[axis == 1 ? 2 : 1] = 1
      for (k = 1; k <= 3; k++) { m = k%3 + 1; n = m%3 + 1; y[k] = z[m]*x[n] - z[n]*x[m] }
      marks = ""
      for (k = 1; k <= 6; k++) marks = marks "," (k == 2*axis - (face < 0) ? 20 : k == 2*axis - (face > 0) ? 23 : "")
      print "METHOD = " method "\nTOL = 1.E-13\nSUBCASE 1\n  LOAD = 10\n  INCR = 5\nSUBCASE 2\n  LOAD = 30\n  INCR = 5\nSUBCASE 3\n  LOAD = 40\n  INCR = 5\n  OUTPUT = LAST, STATE\nSUBCASE 4\n  LOAD = 50\n  INCR = 5\n  OUTPUT = LAST, STATE"
      print "BEGIN BULK\nBLOCK3,1,1,2,2,2,0.,0.,0.\n+,40.,40.,40.\n+" marks "\nPSOLID,1,1\nMAT1,1,9500.,,0.\nPMARK,20\nPMARK,23"
      print "JOINT,1,1,20\nPJOINT,1,1,1,2,,,0.5\nJNORM,1,8.0-3,.5"
      print "JSHEAR,1,20.,200.,-2000.,-12000.,5.0+4,3.0+5\n+,20.,200.,500.,3000.\nJSHEAR,2,35.,90.,-1500.,-9000.,3.0+4,2.0+5\n+,45.,110.,300.,1000."
      print "PLOADM,10,0.5,23\nLOAD,30,1.,1.,10,1.,20,1.,21\nLOAD,40,1.,1.,10,.5,20,.5,21\nLOAD,50,1.,1.,10,.75,20,.75,21"
      printf "FORCEM,20,320.,%.1f,%.1f,%.1f,20\nFORCEM,21,-192.,%.1f,%.1f,%.1f,20\nJINCR,5,20\nENDDATA\n", x[1], x[2], x[3], y[1], y[2], y[3]
   }' > "$work/$1.bdf"
   run "$1"
}

# At p = 0.5 the loading curves are 120 d - 8000 d^2 + 200000 d^3 and 80 d - 6000 d^2 + 130000 d^3, unloading 120 d + 2000 d^2 and
# 100 d + 800 d^2, shifted to pass through point A.
for face in -3 3 -1 1 -2 2; do
   drawn drawn NEWTON $face || continue
   words="drawn obliquely on face $face"
   ask "$words: pressed" drawn rows 'stage = 1 and increment = max(increment)' count 9 all 'pressure = 0.5 within 1e-9' \
      all 'abs(delta_x) + abs(delta_y) < 1e-12'
   for stage in 2 3; do
      last="stage = $stage and increment = max(increment)"
      ask "$words: stage $stage, shear carries the force" drawn rows "stage = $stage" all 'pressure = 0.5 within 1e-9' \
         all "tau_x = 0.2*$( [ $stage = 2 ] && echo load || echo '(1 - 0.5*load)') within 1e-9" all 'tau_y = -0.6*tau_x within 1e-9'
   done
   ask "$words: on the loading curve of each direction" drawn rows 'stage = 2' count 180 \
      all 'tau_x = 120*delta_x - 8000*delta_x^2 + 2e5*delta_x^3 within 1e-9' \
      all 'tau_y = 80*delta_y + 6000*delta_y^2 + 1.3e5*delta_y^3 within 1e-9' all 'branch_x = "LOAD" and branch_y = "LOAD"'
   set -- $(value drawn rows 'stage = 2 and increment = 20 and node1 = min(node1)' print delta_x print delta_y)
   ask "$words: and back along the line of each" drawn rows 'stage = 3' count 180 all 'branch_x = "UNLOAD" and branch_y = "UNLOAD"' \
      all "tau_x = 0.2 + 120*(delta_x - ($1)) + 2000*(delta_x^2 - ($1)^2) within 1e-9" \
      all "tau_y = -0.12 + 100*(delta_y - ($2)) - 800*(delta_y^2 - ($2)^2) within 1e-9"
   set -- "$@" $(value drawn rows 'stage = 3 and increment = 20 and node1 = min(node1)' print delta_x print delta_y)
   ask "$words: and again, reloading" drawn rows 'stage = 4' count 180 \
      all 'branch_x = "RELOAD" and branch_y = "RELOAD"' \
      all "tau_x = 0.1 + 120*(delta_x - ($3)) - 8000*(delta_x^2 - ($3)^2) + 2e5*(delta_x^3 - ($3)^3) within 1e-9" \
      all "tau_y = -0.06 + 80*(delta_y - ($4)) + 6000*(delta_y^2 - ($4)^2) + 1.3e5*(delta_y^3 - ($4)^3) within 1e-9"
   for k in X Y; do
      table drawn "STATE OF SHEAR IN DIRECTION $k OF JOINT 1, STAGE" > "$work/state"
      judge "$words: what the listing remembers of direction $k" -v k=$k -v rx="$1" -v ry="$2" -v sx="$3" -v sy="$4" '
         function near(what, is, wanted) { if (!(is - wanted < 6e-6*abs(wanted) && wanted - is < 6e-6*abs(wanted))) print what " " is ", expected " wanted ": " $0 }
         function abs(a) { return a < 0 ? -a : a }
         $3 == "UNLOAD" || $3 == "RELOAD" {
            n++
            sense = k == "X" ? 1 : -1
            r = k == "X" ? rx : -ry; s = k == "X" ? sx : -sy; tau = k == "X" ? 0.2 : 0.12
            b = k == "X" ? 120*r + 2000*r^2 : 100*r + 800*r^2
            c = k == "X" ? 120*s - 8000*s^2 + 2e5*s^3 : 80*s - 6000*s^2 + 1.3e5*s^3
            if ($4 != sense || NF != 10) print "sense, columns: " $0
            if ($3 == "UNLOAD") near("D", $5, s)
            near("TAU", $6, ($3 == "UNLOAD" ? 0.5 : 0.75)*tau); near("D_R", $7, r); near("TAU_R", $8, tau)
            near("B0, C0", $10, $3 == "UNLOAD" ? tau - b : 0.5*tau - c) }
         END { if (n != 18) print n " rows"; print "checked " n }' "$work/state"
   done
   ask "$words: tangents" drawn rows 'stage = 2' \
      all 'k_sx = area*(120 - 16000*delta_x + 6e5*delta_x^2) within 1e-6' all 'k_sy = area*(80 + 12000*delta_y + 3.9e5*delta_y^2) within 1e-6'
done

# STEP: each increment goes along the tangents of the state before it, in both directions
drawn stepped STEP -3 &&
   ask 'drawn obliquely by STEP: along the tangents' stepped rows 'stage = 2' by node1 count 180 all 'tau_x = 0.2*load within 1e-9' \
      all 'tau_y = -0.12*load within 1e-9' \
      all 'tau_x - before(tau_x) = (delta_x - before(delta_x))*(120 - 16000*before(delta_x) + 6e5*before(delta_x)^2) within 1e-9' \
      all 'tau_y - before(tau_y) = (delta_y - before(delta_y))*(80 + 12000*before(delta_y) + 3.9e5*before(delta_y)^2) within 1e-9'

# a law whose unloading does not come to zero says so: from A of the tested range B falls by 1.0 d alone
drawn drawn NEWTON -3 && {
   sed 's/^+,20.,200.,500.,3000.$/+,1.0\n+\n+,1.0,2.0-3/' "$work/drawn.bdf" > "$work/unclosed.bdf"
   says 'a law whose unloading stays above zero' <(run unclosed; cat "$work/unclosed.out") 'CLOSURE: UNLOADING DOES NOT REACH TAU = 0'
}
