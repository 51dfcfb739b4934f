# One interface element: NEWTON gives lambda = c (F/a)**m, STEP a closed recurrence.

p='1.3*load' before='1.3*before(load)'
for m in 0.3 0.5 0.77 1.0; do
   one_element newton NEWTON $m 6 && ask "one element, m = $m, NEWTON" newton count 6 \
      all "lambda = 8e-3*($p)^$m within 1e-12*lambda and pressure = $p within 1e-12*pressure"
   one_element step STEP $m 6 && ask "one element, m = $m, STEP" step count 6 all "lambda = if(before(load) > 0,
      before(lambda) + ($p - $before)*$m*8e-3*($before)^($m - 1), 8e-3*($p)^$m) within 1e-12*lambda"
   one_element back BACK $m 6 && near "one element, m = $m, BACK" "$(cell back 1 1 1 lambda)" "8e-3*1.3^$m" 1e-10
done

# Loading, relief and loading again in equilibrium: by hand in the deck itself.
run_input normal_loop && {
   near 'normal loop, lambda at A' "$(cell normal_loop 1 20 1 lambda)" 8.0e-3 1e-12
   near 'normal loop, relieved to p = 0.01' "$(cell normal_loop 2 20 1 lambda)" 6.02e-3 1e-11
   same 'normal loop, relieved' "$(cell normal_loop 2 20 1 branch)" UNLOAD
   near 'normal loop, on past A' "$(cell normal_loop 3 20 1 lambda)" 9.797958971132712e-3 1e-12
   same 'normal loop, on past A' "$(cell normal_loop 3 20 1 branch)" LOAD
   energy=$(awk '/ENERGY OF JOINTS/ { n++; getline; getline; getline; getline; getline; if (n < 4) print $2, $3 }' "$work/normal_loop.out")
   # F lambda/3 to A; p**2 a/(2 E_u) back, less what the last hundredth keeps
   near 'normal loop, work put in to A' "$(echo $energy | cut -d' ' -f1)" 0.266667 2e-6
   near 'normal loop, work given back' "$(echo $energy | cut -d' ' -f4)" 0.09999 1e-5
}
