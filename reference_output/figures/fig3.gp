set title 'Fig. 3  Loading by increments: node 51 of the prism, 5 increments'
set xlabel 'closing deflection {/Symbol l} [10^{-3} mm]'
set ylabel 'pressure p [kgf/mm^2]'
set key top left Left reverse noautotitle
n = 5
array L[n]
array P[n]
do for [i = 1:n] { L[i] = 1000*cell('prism05', 1, i, 51, 'lambda'); P[i] = cell('prism05', 1, i, 51, 'pressure') }
on_curve(p) = 8.0*sqrt(p)
tangent(x, p) = p + sqrt(p)/4.0*(x - on_curve(p))
# the first increment: half-load 800 kgf over 150 x 20 mm
p_av = cell('prism05', 1, 1, 51, 'load')*800/3000
set label 1 'O' at 0, 0 offset 0.8, -0.8
set label 2 'A_0' at on_curve(p_av), p_av offset -2.6, 0.9
set label 3 'p_{av}' at 0, p_av offset -5.0, 0.4
set arrow 2 from on_curve(p_av), p_av to 0, p_av nohead ls 9
do for [i = 1:n] {
   set label 10 + i sprintf('A_%d', i) at on_curve(P[i]), P[i] offset -2.2, (i > 1 ? 0.7 : 1.6)
   set label 20 + i sprintf('B_%d', i) at L[i], P[i] offset 0.7, -0.6
   set arrow 30 + i from on_curve(P[i]), P[i] to L[i], P[i] nohead ls 3 lw 3
   if (i < n) { set arrow 40 + i from on_curve(P[i]) - 0.6, tangent(on_curve(P[i]) - 0.6, P[i]) \
                   to on_curve(P[i]) + 1.4, tangent(on_curve(P[i]) + 1.4, P[i]) nohead ls 4 lw 1.5 dt 2 }
}
set arrow 50 from 0, 0 to L[1], P[1] nohead ls 2
array A0[1]
A0[1] = p_av
plot [0:8] [-0.05:0.65] \
   (x/8.0)**2 with lines ls 1 dt 1 lw 1 title 'the law, {/Symbol l} = c p^m', \
   P using (L[$1]):(P[$1]) with linespoints ls 2 title 'increments, to the computed points B_i', \
   NaN with lines ls 4 lw 1.5 dt 2 title 'tangents at A_i, which begin at B_i', \
   NaN with lines ls 3 lw 3 title 'error A_i B_i', \
   P using (on_curve(P[$1])):(P[$1]) with points ls 1 title 'A_i on the curve', \
   A0 using (on_curve(A0[$1])):(A0[$1]) with points ls 6 pt 7 title 'A_0 of the first secant, Eq. (9)'
