set title 'Fig. 1(b)  Shear of a joint at constant pressure, p = 0.5 kgf/mm^2: O-A-1-A-B-2-B-C-3'
set xlabel 'shear deflection {/Symbol d} [10^{-3} mm]'
set ylabel 'shear stress {/Symbol t} [kgf/mm^2]'
set key top left Left reverse
delta(s) = cell('shear_cycles', s, 10, 1, 'delta_x')
tau(s) = cell('shear_cycles', s, 10, 1, 'tau_x')
set label 1 'O' at 0, 0 offset 0.8, -0.8
do for [i = 1:3] {
   s = 3*i - 1
   set label 10 + i word('A B C', i) at 1000*delta(s), tau(s) offset -0.6, 0.9
   set label 20 + i sprintf('%d', i) at 1000*delta(s + 1), tau(s + 1) offset 0.5, -0.8
}
A(d) = 0.120*d - 0.008*d**2 + 0.0002*d**3
cycle(s) = stage('shear_cycles', s)
plot [0:10.5] [-0.05:0.7] \
   A(x) with lines ls 9 title 'the loading curve, Eq. (6)', \
   for [s in '2 5 8'] cycle(s) using (1000*column('delta_x')):'tau_x' with linespoints ls 1 pt 7 ps 0.8 \
      title (s eq '2' ? 'loading: O to A, A to B, B to C' : ''), \
   for [s in '3 6 9'] cycle(s) using (1000*column('delta_x')):'tau_x' with linespoints ls 2 ps 0.8 \
      title (s eq '3' ? 'unloading: A to 1, B to 2, C to 3' : ''), \
   for [s in '4 7'] cycle(s) using (1000*column('delta_x')):'tau_x' with linespoints ls 3 ps 0.8 \
      title (s eq '4' ? 'reloading: 1 to A, 2 to B' : '')
