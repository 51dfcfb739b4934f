set title 'Fig. 4(a)  Shear by increments at constant pressure, p = 0.5 kgf/mm^2'
set xlabel 'shear deflection {/Symbol d} [10^{-3} mm]'
set ylabel 'shear stress {/Symbol t} [kgf/mm^2]'
set key top left Left reverse noautotitle
n = 5
array D[n]
array T[n]
do for [i = 1:n] { D[i] = 1000*cell('shear_step', 2, i, 1, 'delta_x'); T[i] = cell('shear_step', 2, i, 1, 'tau_x') }
A(d) = 0.120*d - 0.008*d**2 + 0.0002*d**3
slope(d) = 0.120 - 0.016*d + 0.0006*d**2
set style textbox opaque noborder fillcolor rgb 'white' margins 0.1, 0.1
set label 1 'O = A_0' at 0, 0 offset 0.8, -0.7
do for [i = 1:n] {
   if (i < 3) { set label 10 + i sprintf('A_%d', i) at D[i], A(D[i]) right front boxed offset -0.4, -1.0 }
   else { set label 10 + i sprintf('A_%d', i) at D[i], A(D[i]) offset 0.6, -0.8 }
   if (i == 4) { set label 20 + i sprintf('B_%d', i) at D[i], T[i] offset -1.2, 2.0 }
   else { set label 20 + i sprintf('B_%d', i) at D[i], T[i] offset -2.4, 0.8 }
   set arrow 30 + i from D[i], A(D[i]) to D[i], T[i] nohead ls 3 lw 3
   if (i < n) { set arrow 40 + i from D[i] - 0.4, A(D[i]) - 0.4*slope(D[i]) \
                   to D[i] + 0.9, A(D[i]) + 0.9*slope(D[i]) nohead ls 4 lw 1.5 dt 2 }
}
plot [0:6.5] [-0.05:0.8] \
   A(x) with lines ls 1 dt 1 lw 1 title 'the loading curve, Eq. (6)', \
   stage('shear_step', 2) using (1000*column('delta_x')):'tau_x' with linespoints ls 2 \
      title 'increments, to the computed points B_i', \
   NaN with lines ls 4 lw 1.5 dt 2 title 'tangents at A_i, which begin at B_i', \
   NaN with lines ls 3 lw 3 title 'error A_i B_i', \
   D using (D[$1]):(A(D[$1])) with points ls 1 title 'A_i on the curve', \
   stage('shear_step', 3) using (1000*column('delta_x')):'tau_x' with linespoints ls 5 \
      title 'unloading: first by the last tangent'
