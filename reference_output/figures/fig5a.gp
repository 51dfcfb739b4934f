load includes . 'slip.inc'
set title sprintf('Fig. 5(a)  Coulomb check: node 1 of the pushed block is above its limit after increment %d', first)
set xlabel 'shear deflection {/Symbol d} [10^{-3} mm]'
set ylabel 'shear stress {/Symbol t} [kgf/mm^2]'
set key top left Left reverse
set zeroaxis lt 1 lc rgb '#808080'
rows = sprintf("< awk -F, 'NR == 1 || ($1 == 2 && $2 <= %d && $6 == 1)' %sfriction_none.joint.csv", first, folder)
set label 1 't_1' at d1, t1 offset 0.8, 0.5
set label 2 '{/Symbol t}_f' at d1, limit1 offset 0.8, -0.6
plot [-0.3:0.2] [-0.06:0.12] \
   rows using (1000*column('delta_x')):'tau_x' with linespoints ls 2 title 'shear stress after each increment of the push', \
   rows using (1000*column('delta_x')):(mu*column('pressure')) with linespoints ls 1 dt 2 \
      title 'limit {/Symbol t}_f = {/Symbol m}p, {/Symbol m} = 0.2: the pressure falls behind the push'
