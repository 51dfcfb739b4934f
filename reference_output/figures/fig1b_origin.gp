set multiplot layout 1, 2 title 'Fig. 1(b) both ways: the same cubics B and C, d from zero and d from the start of the branch'
set xlabel 'shear deflection {/Symbol d} [10^{-3} mm]'
set ylabel 'shear stress {/Symbol t} [kgf/mm^2]'
set key top left Left reverse
A(d) = 0.120*d - 0.008*d**2 + 0.0002*d**3
do for [origin in 'CURVE BRANCH'] {
   deck = 'origin_' . origin
   set title 'ORIGIN ' . origin
   plot [0:10.5] [-0.05:0.8] \
      A(x) with lines ls 9 title 'loading curve, Eq. (6)', \
      for [s in '2 5 8'] stage(deck, s) using (1000*column('delta_x')):'tau_x' with lines ls 1 title (s eq '2' ? 'loading' : ''), \
      for [s in '3 6 9'] stage(deck, s) using (1000*column('delta_x')):'tau_x' with linespoints ls 2 ps 0.8 \
         title (s eq '3' ? 'unloading, B' : ''), \
      for [s in '4 7'] stage(deck, s) using (1000*column('delta_x')):'tau_x' with linespoints ls 3 ps 0.8 \
         title (s eq '4' ? 'reloading, C = B' : '')
}
unset multiplot
