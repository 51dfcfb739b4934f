set title 'Fig. 4(a)  Shear branches, each shifted to begin where the one before ends'
set xlabel 'shear deflection {/Symbol d} [10^{-3} mm]'
set ylabel 'shear stress {/Symbol t} [kgf/mm^2]'
set key top left
set zeroaxis lt 1 lc rgb '#808080'
A(d) = 70*d - 2000*d**2 + 30000*d**3
B(d) = 52.25*d + 775*d**2 + 7500*d**3
b0 = A(0.01) - B(0.01)
plot [-12:12] [-0.6:0.6] \
   A(x/1000) with lines ls 9 title 'loading curve A(d)', \
   b0 + B(x/1000) with lines ls 9 dt 4 title 'unloading curve b_0 + B(d)', \
   stage('shear_loop', 2) using (1000*column('delta_x')):'tau_x' with points ls 1 title 'program, loading', \
   stage('shear_loop', 3) using (1000*column('delta_x')):'tau_x' with points ls 2 title 'program, unloading'
