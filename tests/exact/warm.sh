# Temperatures and springs: whole runs against closed formulas.

# ---- a bolted joint of aluminium on steel, warmed and cooled ----

for solver in SKYLINE TREE; do
   for warmth in 2000 -2000; do
      warm_columns columns "$((warmth + 20))." $solver || continue
      judge "bolts of two columns, $warmth degrees, $solver" -F, -v warmth=$warmth '
         function lambda(n) { return n > 10 ? 0.02 * (sqrt(n / 20) - sqrt(0.5)) : (n / 20 - 0.5) / 30 }
         function force(t,   k, low, high, n) {
            low = 0; high = 40
            for (k = 0; k < 100; k++) {
               n = (low + high) / 2
               if ((n - 10) * (1 / 20 + 8 / 4000 + 12 / 1400) + lambda(n) < 12 * 1.1e-5 * t) low = n; else high = n
            }
            return n
         }
         FNR > 1 {
            checked++
            expected = force($1 == 1 ? 0 : $3 * warmth) / 2
            if (!($5 - expected < 1e-8 && expected - $5 < 1e-8)) print "stage " $1 ", increment " $2 ": " $5 ", expected " expected
         }
         END { print "checked " checked }' "$work/columns.bolt.csv"
      ask "joint of two columns, $warmth degrees, $solver" columns rows 'stage = 2 and increment = 4' count 2 \
         all "sum(force) = 2*$(awk -F, '$1 == 2 && $2 == 4 { n = $5 } END { print n }' "$work/columns.bolt.csv") within 1e-8"
   done
done

# ---- the flange of input/: what is warm bears on nothing but the joint and its bolt ----

if run_input flange_warm; then
   while IFS=, read -r stage increment force; do
      ask "flange, stage $stage, increment $increment: bolt and joint" flange_warm rows "stage = $stage and increment = $increment" \
         count 25 all "sum(force) = $force within 1e-6*$force"
   done < <(awk -F, 'FNR > 1 { print $1 "," $2 "," $5 }' "$work/flange_warm.bolt.csv")
   judge 'flange: supports and loads' '
      / BALANCE OF FORCES/ { on = 1 }
      on && /LOADS|UNBALANCED/ { checked++; if ($NF + $(NF - 1) + $(NF - 2) != 0) print }
      END { print "checked " checked }' "$work/flange_warm.out"
fi

# ---- springs to the ground: they stand in the balance ----

if two_springs springs; then
   same 'springs: the ground' "$(table springs 'BALANCE OF FORCES' | awk '/GROUND/ { print $(NF - 1), $NF } /UNBALANCED/ { print $(NF - 1), $NF }' | tr '\n' ' ')" \
      '-1.20000E+01 0.00000E+00 0.00000E+00 0.00000E+00 '
   same 'springs: forces' "$(table springs 'FORCES OF SPRINGS' | awk '$1 == 1 { print $2, $3, $4, $5, $6, $7 }' | tr '\n' ';')" \
      '51 1 0 T1 6.00000E+00 3.00000E-01;52 0 2 T1 -6.00000E+00 -3.00000E-01;'
fi
