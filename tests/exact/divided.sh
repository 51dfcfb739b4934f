# Blocks with friction in large increments, some of which NEWTON has to divide: whether it does, and into which parts, hangs on rounding,
# the answer does not. SKYLINE, TREE, and other units.

# block_pushed NAME SOLVER LENGTH FORCE NX NY WIDTH HEIGHT MU M EU FORCES...: a unit of length and one of force; a force is STAGE:NODE:FX:FY
block_pushed() {
   awk -v solver="$2" -v l="$3" -v f="$4" -v nx="$5" -v ny="$6" -v w="$7" -v h="$8" -v mu="$9" -v m="${10}" -v eu="${11}" -v forces="${*:12}" 'BEGIN {
      n = split(forces, force, " "); p = f/l^2
      print "METHOD = NEWTON\nSOLVER = " solver
      for (i = 1; i <= n; i++) { split(force[i], at, ":"); if (at[1] != before) printf "SUBCASE %d\n  LOAD = %d\n", at[1], at[1]; before = at[1] }
      printf "BEGIN BULK\nBLOCK2,1,1,%d,%d,0.0,0.0\n+,%.14E,%.14E\n+,20\nPMARK,20\nPSHELL,1,1,%.14E\nMAT1,1,%.14E,,0.25\n", nx, ny, w*l, h*l, 20*l, 9500*p
      printf "JOINT,1,1,20\nPJOINT,1,1,1,,%s,,%.14E\nJNORM,1,%.14E,%s,%.14E\n", mu, p, 8e-3*l/p^m, m, eu*p/l
      printf "JSHEAR,1,%.14E,%.14E\n", 400*p/l, 1200/l
      for (i = 1; i <= n; i++) { split(force[i], at, ":"); printf "FORCE,%d,%d,,%.14E,%.14E,%.14E\n", at[1], at[2], f, at[3], at[4] }
      print "ENDDATA" }' > "$work/$1.bdf"
   run "$1"
}

# alike WORDS PRESSURE: of pushed, TREE and units, where PRESSURE is one of the unit of the others
alike() {
   same_rows "$1, SKYLINE and TREE" pushed tree 1e-7 $along
   ask "$1, other units" pushed with "$work/units.joint.csv" all 'slip = other.slip and branch = other.branch' \
      all "$2*pressure = other.pressure within 1e-7*$2*max(abs(pressure))" all "$2*tau_x = other.tau_x within 1e-7*$2*max(abs(pressure))"
   for deck in pushed tree units; do
      same "$1, $deck: the screen too" "$(grep -c 'divided into' "$work/$deck.log")" "$(grep -c -m 1 ': DIVIDED INTO' "$work/$deck.out")"
      same "$1, $deck: the parts only lead the way" "$(grep -c 'DEPENDS ON THE PARTS' "$work/$deck.out")" 0
   done
}

pushed_by='12 1 100 30 0.2 0.5 3000 1:20:0.0:-537.65947817906930 1:24:0.0:-1371.1929790752040
   2:12:-242.51793886726140:-1194.5190699366020 2:16:-45.275950015461400:-1185.9554996846210 3:24:10.622724168002140:-1476.7636758518200
   4:12:-143.68756663070610:-1040.1415246204700 4:14:-166.57611075871740:-1105.9682768638290 4:26:-35.516482335196560:-1633.9997914714240'
block_pushed pushed SKYLINE 1 1 $pushed_by && block_pushed tree TREE 1 1 $pushed_by && block_pushed units SKYLINE 1e-3 9.80665 $pushed_by &&
   alike 'a block pushed to and fro' 9806650
