# One interface element: NEWTON gives lambda = c (F/a)**m, STEP a closed recurrence. Unloading and reloading: manual/03_joint_laws.md.

p='1.3*load' before='1.3*before(load)'
for m in 0.3 0.5 0.77 1.0; do
   one_element newton NEWTON $m 6 && ask "one element, m = $m, NEWTON" newton count 6 \
      all "lambda = 8e-3*($p)^$m within 1e-12*lambda and pressure = $p within 1e-12*pressure"
   one_element step STEP $m 6 && ask "one element, m = $m, STEP" step count 6 all "lambda = if(before(load) > 0,
      before(lambda) + ($p - $before)*$m*8e-3*($before)^($m - 1), 8e-3*($p)^$m) within 1e-12*lambda"
   one_element back BACK $m 6 && near "one element, m = $m, BACK" "$(cell back 1 1 1 lambda)" "8e-3*1.3^$m" 1e-10
done
