set title 'Fig. 5(a)  Coulomb check: one element, p = 0.5 kgf/mm^2, {/Symbol m} = 0.83'
set xlabel 'shear deflection {/Symbol d} [10^{-3} mm]'
set ylabel 'shear stress {/Symbol t} [kgf/mm^2]'
set key top left Left reverse
first = 1
while (cell('friction_curve', 2, first, 1, 'slip') == 0) { first = first + 1 }
d1 = 1000*cell('friction_curve', 2, first, 1, 'delta_x')
t1 = cell('friction_curve', 2, first, 1, 'tau_x')
limit = 0.83*0.5
A(d) = 0.120*d - 0.008*d**2 + 0.0002*d**3
low = 0.0
high = 10.0
do for [i = 1:60] { middle = 0.5*(low + high); if (A(middle) < limit) { low = middle } else { high = middle } }
end = 7.0
set samples 1001
set label 1 'O' at 0, 0 offset 0.8, -0.8
set label 2 'D' at low, limit offset -0.4, -1.0
set label 3 'E' at end, limit offset -0.4, -1.0
set label 4 't_1' at d1, t1 offset 0.8, 0.5
set label 5 '{/Symbol t}_f = {/Symbol m}p' at 0.1, limit offset 0, 0.7
set label 6 sprintf("the excess t_1 - {/Symbol t}_f = %.3f,\nafter increment %d", t1 - limit, first) at d1, limit offset 1.2, -3.2
set arrow 1 from d1, limit to d1, t1 heads ls 3
plot [-0.1:8] [-0.05:0.7] \
   (x >= 0 && x <= low ? A(x) : NaN) with lines ls 1 title 'the loading curve, Eq. (6), from the origin to D', \
   (x >= low && x <= end ? limit : NaN) with lines ls 4 lw 3 title 'DE: slip at the limit', \
   (x >= low ? A(x) : NaN) with lines ls 9 title 'the loading curve beyond D', \
   (x <= low ? limit : NaN) with lines ls 9 dt 3 notitle, \
   stage('friction_curve', 2) using (1000*column('delta_x')):($0 <= first ? column('tau_x') : NaN) with points ls 2 \
      title 'computed points by STEP, the last above the limit'
