# A block on its joint, moved by SPCD at its top alone, by NEWTON: no force anywhere.

# the joint and the bar above it in series: c sqrt(p) + p H/E = D, so sqrt(p) = 2 D/(c + sqrt(c^2 + 4 D H/E))
in_series() { number "(2*$1/(8e-3 + sqrt(8e-3^2 + 4*$1*5/9500)))^2"; }

for p0 in 1.0-6 0.1 1000.0; do
   for mesh in '1 1' '6 4'; do
      for depth in 1.0E-7 5.0E-3 2.0E-1; do
         moved_block pushed_down $mesh $p0 0.0:-$depth && {
            near "pressed $depth by SPCD alone, P0 $p0, mesh $mesh: p" "$(cell pushed_down 1 1 1 pressure)" "$(in_series $depth)" 1e-9
            near "pressed $depth by SPCD alone, P0 $p0, mesh $mesh: lambda" "$(cell pushed_down 1 1 1 lambda)" \
               "8e-3*sqrt($(in_series $depth))" 1e-9
         }
      done
   done
done

# nothing resists a movement along the joint, or away from it: everything goes with the top, at once and in one part, and back
for mesh in '1 1' '6 4' '60 20'; do
   moved_block carried $mesh 0.1 0.3:0.0 0.3:1.0 0.0:0.0 -2.0:0.0 -2.0:-5.0E-3 && {
      for stage in 1 4; do
         judge "carried along by the top, stage $stage, mesh $mesh" -v stage=$stage '
            / DISPLACEMENTS OF NODES/ { on = $5 + 0 == stage }
            / STRESSES/ { on = 0 }
            on && $1 + 0 == $1 && NF == 5 { n++; e = stage == 1 ? 0.3 : -2; if (($4 - e)^2 > 1e-18 || $5^2 > 1e-18) print }
            END { print "checked " n }' "$work/carried.out"
      done
      same "carried along by the top, mesh $mesh: no increment is divided" \
         "$(awk '/CONVERGENCE HISTORY/ { on = 1; next } /RESULTANTS/ { on = 0 } on && $1 + 0 == $1 && $2 > 1' "$work/carried.out")" ''
      near "pressed after that, mesh $mesh" "$(cell carried 5 1 1 pressure)" "$(in_series 5.0E-3)" 1e-9
   }
done
