set title 'Fig. 4(b)  Shear under rising pressure: every increment along the curve of its own pressure'
set xlabel 'shear deflection {/Symbol d} [10^{-3} mm]'
set ylabel 'shear stress {/Symbol t} [kgf/mm^2]'
set key bottom right opaque
curve(d, p) = (20 + 100*p)*d - (1000 + 2000*p)*d**2 + (10000 + 40000*p)*d**3
plot [0:10] [0:0.35] \
   for [i = 1:8] curve(x/1000, 0.1*i) with lines ls 9 title (i == 1 ? 'loading curves at p = 0.1, 0.2, ..., 0.8' : ''), \
   stage('shear_pressure', 2) using (1000*column('delta_x')):'tau_x' with linespoints ls 2 \
      title 'pushed, p rising from 0.1 to 0.8'
