# Digits that the equations cost: a block on a bar in its axis, F L/(E A) + F H/(E_b A_b) of it known exactly where nu = 0.

# on_bar NAME E SOLVER UNIT: the block, 100 x 60, 20 thick, on a bar of modulus E [kgf/mm2], in mm and kgf or in m and N
on_bar() {
   local length=1 force=1
   [ "$4" = m ] && length=0.001 force=9.80665
   awk -v e="$2" -v l="$length" -v f="$force" -v solver="$3" 'BEGIN {
      split("0 60 30", y); p = f/l^2
      print "SPC = 1\nSOLVER = " solver "\nSUBCASE 1\n  LOAD = 10\nBEGIN BULK"
      printf "BLOCK2,1,1,8,6,0.0,0.0\n+,%.4E,%.4E\n+,20,21,22,23\n", 100*l, 60*l
      print "PMARK,20\nPMARK,21\nPMARK,22\nPMARK,23"
      printf "PSHELL,1,1,%.4E\nMAT1,1,%.6E,,0.0\nMAT1,2,%.6E,,0.0\n", 20*l, 9500*p, e*p
      printf "GRID,900,,%.4E,%.4E,0.0\nCROD,901,2,29,900\nPROD,2,2,%.4E\n", 50*l, -100*l, 100*l^2
      print "SPC1,1,12,900\nSPC1,1,1,1,THRU,63"
      printf "FORCEM,10,%.6E,0.0,1.0,0.0,20\nFORCEM,10,%.6E,0.0,-2.0,0.0,20\nENDDATA\n", 800*f, 800*f }' > "$work/$1.bdf"
   run "$1"
}

for solver in SKYLINE TREE; do
   on_bar stiff_bar 9500.0 $solver mm && {
      same "$solver: a sound structure is silent" "$(grep -c -i condition "$work/stiff_bar.log" "$work/stiff_bar.out" | cut -d: -f2 | tr '\n' ' ')" '0 0 '
   }
   on_bar less_soft 1.0E-3 $solver mm && {
      same "$solver: a bar of E 1E-3 is silent" "$(grep -c -i 'condition of' "$work/less_soft.log")" 0
   }
   for unit in mm m; do
      on_bar "soft_bar_$unit" 1.0E-6 $solver $unit && {
         says "$solver, $unit: a soft bar is told on the screen" "$work/soft_bar_$unit.log" \
            'stage 1, increment 1: condition of the stiffness about 1E13, about 3 of 16 digits remain: softest at node .* in direction Y'
         says "$solver, $unit: and in the listing" "$work/soft_bar_$unit.out" 'WARNING: STAGE 1, INCREMENT 1: CONDITION OF THE STIFFNESS ABOUT 1E13'
         says "$solver, $unit: it counts" "$work/soft_bar_$unit.out" 'END OF LISTING .*, 1 WARNING$'
      }
   done
   near "$solver: the digits that are said to be left are right" \
      "$(awk '$1 == "LARGEST" && $2 == "DISPLACEMENT" { print $3; exit }' "$work/soft_bar_mm.out")" '800*100/(1e-6*100)' 1e-3
done
