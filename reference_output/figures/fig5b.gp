load includes . 'slip.inc'
set title sprintf('Fig. 5(b)  Re-analysis: the excess at node 1 before (t_1) and after (t_1''), increment %d', first)
set xlabel 'shear deflection {/Symbol d} [10^{-3} mm]'
set ylabel 'shear stress {/Symbol t} [kgf/mm^2]'
set key bottom right Left reverse
set label 1 't_1' at d1, t1 offset -2.5, 0.3
set label 2 "t_1'" at d2, t2 offset 1, 0.3
set label 3 sprintf("the excess over the limit,\n%.5f, is applied, opposed,\nat both ends of the element", \
   t1 - limit1) at d1, 0.5*(t1 + limit1) right offset -1, 1
set label 4 sprintf("remaining excess: %.5f,\n%.0f %% removed", \
   t2 - limit2, 100*(1 - (t2 - limit2)/(t1 - limit1))) at d2, 0.5*(t2 + limit2) offset 1, 0.5
set arrow 1 from d1, limit1 to d1, t1 heads ls 3
set arrow 2 from d2, limit2 to d2, t2 heads ls 3
set arrow 3 from d1, t1 to d2, t2 ls 2
plot [d1 - 4*(d2 - d1):d2 + 4*(d2 - d1)] [0.0335:0.0375] \
   '+' using (d1):(t1) every ::0::0 with points ls 2 ps 2 title 'after the increment, and after one re-analysis', \
   '+' using (d2):(t2) every ::0::0 with points ls 2 ps 2 notitle, \
   '+' using ($0 == 0 ? d1 : d2):($0 == 0 ? limit1 : limit2) every ::0::1 \
      with linespoints ls 1 dt 2 title 'limit {/Symbol t}_f = {/Symbol m}p'
