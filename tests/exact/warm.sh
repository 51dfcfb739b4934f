# Temperatures and springs; the closed formulas: manual/08_bolts_and_warmth.md.

# ---- a bolted joint of aluminium on steel, warmed and cooled ----

for warmth in 2000 -2000; do
   warm_columns skyline "$((warmth + 20))." SKYLINE && warm_columns columns "$((warmth + 20))." TREE || continue
   if "$query" "$work/columns.bolt.csv" with "$work/skyline.bolt.csv" all 'force = other.force within 1e-8' > "$work/said" 2>&1; then
      passed=$((passed + 1))
   else
      cat "$work/said"; fail "bolts of two columns, $warmth degrees: SKYLINE and TREE"
   fi
   ask "joint of two columns, $warmth degrees" columns rows 'stage = 2 and increment = 4' count 2 \
      all "sum(force) = 2*$(awk -F, '$1 == 2 && $2 == 4 { n = $5 } END { print n }' "$work/columns.bolt.csv") within 1e-8"
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
fi
