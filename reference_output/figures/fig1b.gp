set title 'Fig. 1(b)  Shear deflection of a joint at constant pressure, p = 0.5 kgf/mm^2'
set xlabel 'shear deflection {/Symbol d} [10^{-3} mm]'
set ylabel 'shear stress {/Symbol t} [kgf/mm^2]'
set key top left
set zeroaxis lt 1 lc rgb '#808080'
plot [-12:12] [-0.6:0.6] \
   stage('shear_loop', 2) using (1000*column('delta_x')):'tau_x' with linespoints ls 1 title 'loading', \
   stage('shear_loop', 3) using (1000*column('delta_x')):'tau_x' with linespoints ls 2 title 'unloading to the mirror of A', \
   stage('shear_loop', 4) using (1000*column('delta_x')):'tau_x' with linespoints ls 3 title 'and back'
