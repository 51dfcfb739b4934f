# The answer at the end of a stage, number by number: NAME.stage.csv and NAME.bolt.csv against computations from the joint history and the
# tables of the listing, and the block of the listing against these files.

# of NAME FILE ACTION...: what query_results prints of NAME.FILE.csv
of() { "$query" "$work/$1.$2.csv" "${@:3}"; }

# one_joint NAME STAGE JOINT MU ACROSS: a plane joint whose z is +-Y, its x +X, all of whose interface elements have their whole load
# history in the stages, by NEWTON. ACROSS: its shear directions, 'x' or 'x y'
one_joint() {
   local name=$1 stage=$2 joint=$3 mu=$4 row last s words="$1, stage $2, joint $3"
   row=(rows "stage = $stage and joint = $joint")
   last=("${row[@]}" rows 'increment = max(increment)')
   s=$(of "$name" stage "${row[@]}" print x)
   sum() { value "$name" "${last[@]}" print "$1"; }
   at() { of "$name" stage "${row[@]}" print "$1"; }
   near "$words: area" "$(at area)" "$(sum 'sum(area)')" 1e-12
   near "$words: centroid" "$(at x)" "$(sum 'sum(area*x)/sum(area)')" 1e-12 1e-9
   near "$words: share in contact" "$(at contact)" "$(sum 'sum(if(branch = "OPEN", 0, area))/sum(area)')" 1e-12
   near "$words: largest pressure" "$(at p_max)" "$(sum 'max(pressure)')" 1e-12
   near "$words: node of the largest pressure" "$(sum "sum(if(node1 = $(at p_node), pressure, 0))")" "$(at p_max)" 2e-6
   near "$words: slipping" "$(at slipping)" "$(sum 'sum(slip)')" 0
   near "$words: N" "$(at n)" "$(sum 'sum(force)')" 1e-12
   if [ "$name" = prism_answer ]; then near "$words: the plane of symmetry balances M" "$(at m)" 0 0 1e-6; else
      near "$words: M" "$(at m)" "$(sum "abs(sum(force*(x - $s)))")" 1e-9 1e-6
   fi
   near "$words: stiffness, normal" "$(at tangent_n)" "$(sum 'sum(k_n)')" 1e-12
   near "$words: stiffness, tilt" "$(at tangent_tilt_y)" "$(sum "sum(k_n*(x - $s)^2)")" 1e-10
   # the plane w + r s through the deflections of the elements in contact: least squares, areas the weights
   local a='if(branch = "OPEN", 0, area)' d="(x - $s)" s0 s1 s2 b0 b1
   s0=$(sum "sum($a)") s1=$(sum "sum($a*$d)") s2=$(sum "sum($a*$d^2)") b0=$(sum "sum($a*lambda)") b1=$(sum "sum($a*$d*lambda)")
   [ "$name" != prism_answer ] || s1=0 b1=0 # its mirror image keeps the sides parallel: the mean
   near "$words: deflection" "$(at move_n)" "(($b0)*($s2) - ($b1)*($s1))/(($s0)*($s2) - ($s1)^2)" 1e-9
   near "$words: turn" "abs($(at turn_y))" "abs((($b1)*($s0) - ($b0)*($s1))/(($s0)*($s2) - ($s1)^2))" 1e-9 1e-12
   near "$words: secant, normal" "$(at secant_n)" "($(at n))/($(at move_n))" 1e-12
   if [ "$(at secant_tilt_y)" != '' ]; then
      near "$words: secant, tilt" "$(at secant_tilt_y)" "($(at m))/abs($(at turn_y))" 1e-9
   fi
   if [ "$mu" != 0 ]; then
      near "$words: T" "$(at t)" "$(sum 'sqrt(sum(tau_x*area)^2 + sum(tau_y*area)^2)')" 1e-9 1e-7
      near "$words: stiffness along x" "$(at tangent_x)" "$(sum 'sum(if(slip = 1, 0, k_sx))')" 1e-12
      if [ "$(at 't > 0')" = 1 ]; then near "$words: safety" "$(at safety)" "$mu*($(at n))/($(at t))" 1e-9
      else same "$words: no safety without T" "$(of "$name" stage "${row[@]}" all 'safety = ""' 2>&1)" ''; fi
   fi
}

run_input lap_joint && {
   for stage in 1 2 3; do one_joint lap_joint $stage 1 0.2; done
   # an open element stands apart by what is missing to point B, A the farthest of the loading curve: lambda_A - p_A/EU
   near 'lap_joint: largest gap' "$(of lap_joint stage rows 'stage = 2' print gap_max)" \
      "$(value lap_joint rows "node1 = $(of lap_joint stage rows 'stage = 2' print gap_node) and stage < 3" \
         print 'max(lambda) - max(pressure)/9500 - last(lambda)')" 1e-9
}
# STEP: the stiffness at the end of a stage is that of its next increment
run_input prism_history && for stage in 1 2; do
   near "prism_history: stiffness after stage $stage" "$(of prism_history stage rows "stage = $stage" print tangent_n)" \
      "$(value prism_history rows "stage = $stage + 1 and increment = 1" print 'sum(k_n)')" 1e-12
done
sed 's/^ *OUTPUT.*//; s/^SUBCASE.*/&\nOUTPUT = LAST, STRESS\nINCR = 1/; s/^BEGIN.*/&\nJINCR,1,1/' input/prism_newton.bdf > "$work/prism_answer.bdf"
run prism_answer && {
   one_joint prism_answer 1 1 0
   of prism_answer stage print u_max print u_node print mises_centre print mises_element > "$work/said"
   judge 'largest displacement and von Mises stress against the tables' '
      NR == FNR { u = $1; u_node = $2; mises = $3; element = $4; next }
      /^ DISPLACEMENTS/ { table = "u" } /^ PRINCIPAL/ { table = "mises" } /^ (REACTIONS|STRESSES|ANSWER)/ { table = "" }
      table == "u" && NF == 5 && $1 ~ /^[0-9]+$/ { d = sqrt($4^2 + $5^2); if (d > most) { most = d; node = $1 } n++ }
      table == "mises" && NF == 5 && $1 ~ /^[0-9]+$/ { if ($5 > largest) { largest = $5; worst = $1 } n++ }
      END {
         if ((u / most - 1)^2 > 1e-10 || u_node != node) print u, u_node, "not", most, node
         if ((mises / largest - 1)^2 > 1e-10 || element != worst) print mises, element, "not", largest, worst
         print "checked " n
      }' "$work/said" "$work/prism_answer.out"
   near 'largest gap on the way of one load' "$(of prism_answer stage print gap_max)" \
      "$(value prism_answer rows "node1 = $(of prism_answer stage print gap_node)" \
         print 'if(max(lambda) > 0, max(lambda) - max(pressure)/9500, 0) - last(lambda)')" 1e-9 1e-12
}
# second order: stresses at nodes, the mean of their elements, stand in the listing
nodes='SUBCASE 1;LOAD = 1;OUTPUT = LAST, STRESS;BEGIN BULK;GRID,1,,0.,0.;GRID,2,,4.,0.;GRID,3,,4.,2.;GRID,4,,0.,2.;GRID,5,,9.,0.;GRID,6,,9.,3.;GRID,7,,2.,0.;GRID,8,,6.5,0.'
cards='CQUAD8,1,1,1,2,3,4,7;CQUAD8,2,1,2,5,6,3,8;PSHELL,1,1,1.;MAT1,1,1000.,,.3;SPC1,1,12,1,4;FORCE,1,6,,1.,1.,3.;ENDDATA'
echo "SPC = 1;$nodes;$cards" | tr ';' '\n' > "$work/nodes.bdf"
run nodes && {
   of nodes stage print mises_max print mises_node > "$work/said"
   judge 'largest von Mises stress of nodes; a deck without joints' '
      NR == FNR { mises = $1; node = $2; next }
      /^ STRESSES AT NODES/ { on = 1 } /^ (REACTIONS|ANSWER)/ { on = 0 }
      on && NF == 5 && $1 ~ /^[0-9]+$/ { n++; if ($5 > largest) { largest = $5; worst = $1 } }
      END { if ((mises / largest - 1)^2 > 1e-10 || node != worst) print mises, node, "not", largest, worst; print "checked " n }' \
      "$work/said" "$work/nodes.out"
   same 'a deck without joints has a row a stage' "$(of nodes stage count 1 print joint)" 0
}

# Bolts: forces as in the listing, changes from stage to stage, the load by hand: 40000 along the bolt, in the second stage
run_input flange_pair && {
   judge 'flange_pair: bolt forces of the listing' '
      NR == FNR { if (FNR > 1) { split($0, v, ","); force[++n] = v[5] } next }
      /^ BOLT FORCES/ { on = 1 } /^ ENERGY/ { on = 0 }
      on && $1 ~ /^[0-9]+$/ && $2 == 1 { k++; if ((force[k] / $6 - 1)^2 > 1e-10) print force[k], "not", $6 }
      END { if (k != n) print k " rows, not " n; print "checked " k }' "$work/flange_pair.bolt.csv" "$work/flange_pair.out"
   end=$(of flange_pair bolt rows 'stage = 1' print 'last(force)')
   near 'flange_pair: preload' "$end" 80000 1e-12
   of flange_pair bolt rows 'stage = 2' all "change = force - $end within 1e-6" all 'load_change = 40000*load within 1e-6' \
      all 'ratio = change/load_change within 1e-12' > "$work/said" 2>&1 && passed=$((passed + 1)) || { cat "$work/said"; fail 'flange_pair: bolt rows'; }
}

# The block has the numbers of the files, to its digits
for name in lap_joint flange_pair; do
   judge "$name: the block against the files" -v bolts="$work/$name.bolt.csv" -v name="$name" '
      function close_to(a, b, digits) { return (a - b)^2 <= (digits * (b < 0 ? -b : b) + 1e-9)^2 }
      FNR == NR {
         n = split($0, v, ",")
         if (FNR == 1) { for (i = 1; i <= n; i++) at[v[i]] = i; next }
         for (c in at) row[v[1], c] = v[at[c]]
         next
      }
      /^ ANSWER AT THE END OF STAGE/ { s = $7; on = 1; next }
      /^ (END OF LISTING|STAGE|INCREMENTS)/ { on = 0 }
      on && /LARGEST DISPLACEMENT/ { checked++; if (!close_to($3, row[s, "u_max"], 1e-4) || $0 !~ "NODE +" row[s, "u_node"] " ") print }
      on && /VON MISES, CENTRES/ { checked++; if (!close_to($5, row[s, "mises_centre"], 1e-4)) print }
      on && /VON MISES, NODES/ { checked++; if (!close_to($5, row[s, "mises_max"], 1e-4)) print }
      on && /JOINT CONTACT/ { table = "contact"; next }
      on && /JOINT STIFFNESS/ { table = "stiffness"; next }
      on && /BOLT +ELEMENT/ { table = "bolt"; next }
      on && table == "contact" && $1 ~ /^[0-9]+$/ {
         checked++
         k = 5 + (row[s, "gap_node"] != "")
         if (!close_to($2, 100 * row[s, "contact"], 1e-4) || !close_to($3, row[s, "p_max"], 1e-4) || $4 != row[s, "p_node"] ||
             !close_to($5, row[s, "gap_max"], 1e-4) || $(k + 1) != row[s, "slipping"] || !close_to($(k + 2), row[s, "n"], 1e-4) ||
             !close_to($(k + 3), row[s, "t"], 1e-4) || !close_to($(k + 4), row[s, "m"], 1e-4)) print
         if (row[s, "safety"] != "" && !close_to($(k + 5), row[s, "safety"], 1e-3)) print
      }
      on && table == "stiffness" && /TANGENT/ { checked++; if (!close_to($(name == "lap_joint" ? 4 : 3), row[s, "tangent_n"], 1e-4)) print }
      END { print "checked " checked }' "$work/$name.stage.csv" "$work/$name.out"
done

# Tables limited to a set and a surface, a long deck not echoed, the map of a joint in space (its normal is +X, so its x is +Y, its y +Z)
sed 's/^ *OUTPUT.*//; s/^SUBCASE.*/SET 7 = 2 THRU 4 EXCEPT 3,\n 55\n&\nOUTPUT = LAST, SET 7, PMARK 20/' input/prism_newton.bdf > "$work/only.bdf"
run only && judge 'tables limited to a set and a surface: nodes 2, 4, 55 and the lower edge 1, 6, 11, ...' '
   /^ [A-Z]/ { table = /^ DISPLACEMENTS.*ONLY SET 7, ONLY PMARK 20/ ? "nodes" : /^ INTERFACE ELEMENTS.*ONLY/ ? "joint" : /^ STRESSES.*ONLY/ ? "elements" : "" }
   table != "" && $1 ~ /^[0-9]+$/ { n[table]++; seen[table, $1] = 1 }
   END {
      for (k = 1; k <= 55; k++) if (((k % 5 == 1) || k == 2 || k == 4 || k == 55) != (("nodes", k) in seen)) print "node " k
      if (n["nodes"] != 14 || n["joint"] != 11) print n["nodes"], n["joint"]
      # elements at the lower edge, in the first column, at node 55
      for (k = 1; k <= 40; k++) if ((k % 4 == 1 || k <= 4 || k == 40) != (("elements", k) in seen)) print "element " k
      print "checked " n["nodes"] + n["joint"] + n["elements"]
   }' "$work/only.out"
long_deck() { echo "SPC = 1;${1}$nodes;$cards" | sed 's/;ENDDATA//' | tr ';' '\n'; seq -f 'GRID,%.0f,,0.0,0.0' 100 "${2:-5200}"; echo ENDDATA; }
long_deck '' > "$work/long.bdf"
long_deck 'ECHO = YES;' > "$work/asked.bdf"
run long && same 'a long deck: no card is echoed' "$(grep -c 'GRID,' "$work/long.out")" 0 && says 'and that is said' "$work/long.out" 'NOT ECHOED: ECHO = YES'
run asked && same 'a long deck that is asked for' "$(grep -c 'GRID,' "$work/asked.out")" 5109
long_deck '' 5085 > "$work/fits.bdf" # behind 14 cards
run fits && same 'a deck of 5,000 cards is echoed' "$(grep -c 'GRID,' "$work/fits.out")" 4994
long_deck '' 5086 > "$work/beyond.bdf"
run beyond && same 'a deck of 5,001 cards is not' "$(grep -c 'GRID,' "$work/beyond.out")" 0
sed 's/^ *OUTPUT.*//; s/^SUBCASE.*/&\nOUTPUT = NONE, PLOT/' input/bolted_cantilever.bdf > "$work/map.bdf"
run map && judge 'the map of a joint: tenths of the largest pressure, rows from above, from left to right' '
   NR == FNR {
      n = split($0, v, ","); if (FNR == 1) { for (i = 1; i <= n; i++) at[v[i]] = i; next }
      if (v[at["stage"]] == 2 && v[at["load"]] == 1) { k++; p[k] = v[at["pressure"]]; x[k] = v[at["y"]]; y[k] = v[at["z"]]; if (p[k] > most) most = p[k] }
      next
   }
   /^ MAP OF JOINT 1, STAGE 2/ { on = 1 } /^ ANSWER/ { on = 0 }
   on && /^ +[|]/ { gsub(/[ |]/, ""); signs = signs $0 }
   END {
      while (done < k) { # the next one from above, from left to right
         b = 0
         for (i = 1; i <= k; i++) if (!(i in used) && (!b || y[i] > y[b] + 1e-6 || (y[i] > y[b] - 1e-6 && x[i] < x[b]))) b = i
         used[b] = 1; done++
         expected = expected (p[b] > most * (1 - 1e-9) ? "*" : int(10 * (1 + 1e-9) * p[b] / most))
      }
      if (signs != expected) print signs " not " expected
      print "checked " k
   }' "$work/map.joint.csv" "$work/map.out"

# three nodes on a rigid base: two pressed alike but for a tenth of a millionth, the third a thousandth less once nearly all load is off
cards tie <<'END'
UNITS = MM, KGF;METHOD = NEWTON;SUBCASE 1;  LOAD = 1;SUBCASE 2;  LOAD = 2
SUBCASE 3;  LOAD = 3
BEGIN BULK;GRID    1               0.0     0.0     0.0             1
GRID    2               50.0    0.0     0.0             1;GRID    3               100.0   0.0     0.0             1
CJOINT  1       1       1               100.0   0.0     1.0     0.0
CJOINT  2       1       2               100.0   0.0     1.0     0.0
CJOINT  3       1       3               100.0   0.0     1.0     0.0;PJOINT  1       1
JNORM   1       8.0-3   0.5     9500.0;FORCE,1,1,,100.,0.,-1.,0.;FORCE,1,2,,100.00001,0.,-1.,0.
FORCE,1,3,,100.00001,0.,-1.,0.;FORCE,2,1,,0.9999E-6,0.,-1.,0.;FORCE,2,2,,0.9999E-6,0.,-1.,0.
FORCE,2,3,,1.0E-6,0.,-1.,0.;FORCE,3,1,,99.,0.,-1.,0.;FORCE,3,2,,100.,0.,-1.,0.;FORCE,3,3,,100.00001,0.,-1.,0.;ENDDATA
END
run tie && {
   stages=0
   for k in 1 3 2; do
      same "of nodes pressed alike the first is named, stage $((++stages))" "$(of tie stage rows "stage = $stages" print p_node)" $k
   done
   for deck in tie lap_joint; do
      judge "$deck: the listing names the nodes of the largest pressure that the answer names" -f tests/exact/pressed_nodes.awk \
         "$work/$deck.stage.csv" "$work/$deck.out"
   done
}
run_input gib && judge 'gib: the listing names the nodes of the largest pressure that the answer names' -f tests/exact/pressed_nodes.awk \
   "$work/gib.stage.csv" "$work/gib.out"

# Two rules that two tables share. The normal force: a node in a vee of two elements whose normals are 3:4 oblique, springs k_n and k_s: the
# force along the mean normal is the load, shear included; N is the sum of the normal forces.
cards vee <<'DECK'
METHOD = NEWTON;LOAD = 1;INCR = 1
BEGIN BULK;GRID,7;CJOINT,1,1,7,,100.,.6,-.8;CJOINT,2,1,7,,100.,-.6,-.8;PJOINT,1,1,2,,,,.1;JNORM,1,.02,1.,50.;JSHEAR,2,40.
FORCE,1,7,,20.,0.,-1.;JINCR,1,2;ENDDATA
DECK
run vee && {
   w=$(number '20/(2*(0.64*5000 + 0.36*4000))')
   near 'vee: N' "$(of vee stage print n)" "2*0.8*5000*$w" 1e-9
   same 'vee: joint force, applied, difference' "$(table vee 'INCREMENTS OF STAGE' | awk '$1 == 2 { print $10, $11, $12 }')" \
        '2.00000E+01 2.00000E+01 0.000E+00'
   same 'vee: N in the table of resultants' "$(table vee 'RESULTANTS OF JOINTS' | awk '$1 == 2 { printf "%.4f", $3 }')" \
        "$(printf '%.4f' "$(of vee stage print n)")"
}
# The largest pressure: where nothing is pressed it is zero, and no node has it, in both tables
cards opened <<'DECK'
METHOD = NEWTON;SPC = 1;SUBCASE 1;LOAD = 1;INCR = 1;SUBCASE 2;LOAD = 2;INCR = 1
BEGIN BULK;GRID,7;CJOINT,1,1,7,,100.,0.,-1.;PJOINT,1,1,,,,,.1;JNORM,1,8.-3,.5,500.;CELAS2,9,100.,7,2
FORCE,1,7,,40.,0.,-1.;FORCE,2,7,,10.,0.,1.;SPC1,1,1,7;JINCR,1,4;ENDDATA
DECK
run opened && for stage in 1 2; do
   same "opened, stage $stage: p and its node in the table" \
      "$(table opened "INCREMENTS OF STAGE $stage" | awk '$1 == 4 { $0 = substr($0, 62, 24); print $1, $2 }')" \
      "$([ $stage = 1 ] && printf '%.5E 7' "$(of opened stage rows 'stage = 1' print p_max)" || echo '0.00000E+00 ')"
   same "opened, stage $stage: node in the file" "$(awk -F, -v s=$stage 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i } $1 == s { print $at["p_node"] }' \
      "$work/opened.stage.csv")" "$([ $stage = 1 ] && echo 7)"
done

# a safety above 1,000 says nothing: the answer and the table of all runs leave it blank, the file has it. P = 1000, MU = 0.2, T of 1 and 0.1
for t in 1.0 0.1; do
   cards answer_safety <<DECK
METHOD = NEWTON;LOAD = 10;BEGIN BULK;BLOCK2,1,1,1,1,0.0,0.0;+,8.0,5.0;+,5;PSHELL,1,1,2.0;MAT1,1,9500.0,,0.0;PMARK,5;JOINT,1,1,5
PJOINT,1,1,1,,0.2;JNORM,1,8.0-3,0.5;JSHEAR,1,1000.0;FORCE,10,2,,500.0,0.0,-1.0;FORCE,10,4,,500.0,0.0,-1.0;FORCE,10,1,,$t,1.0;ENDDATA
DECK
   "$program" -q -o "$work" --summary "$work/answer_safety.csv" "$work/answer_safety.bdf" "$work/block.bdf" > "$work/answer_safety.log" 2>&1
   near "MU N/T with T = $t: in the file" "$("$query" "$work/answer_safety.stage.csv" print safety)" "0.2*1000/$t" 1e-6
   same '... in the answer' "$(awk '/^ *JOINT CONTACT %/ { n = NR + 1 } NR == n { print NF; exit }' "$work/answer_safety.out")" $([ $t = 1.0 ] && echo 10 || echo 9)
   same '... in the table of all runs' "$(grep -c ' 200.000' <(sed -n '/ALL RUNS/,$p' "$work/answer_safety.log"))" $([ $t = 1.0 ] && echo 1 || echo 0)
done
