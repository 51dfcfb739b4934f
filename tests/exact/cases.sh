# FROM: stages that start from the end of an earlier one. By hand on one element, whose branches are remembered; against decks that
# hold only the stages on the way to one of them, to the last digit; the table of the cases.

# ---- one element of area 16, lambda = c (F/a)**m, unloading along E_u: every stage from a state that others have left
cards cases_one <<'DECK'
METHOD = NEWTON; SPC = 1; INCR = 2; WATCH = SET 1; SET 1 = 2
SUBCASE 1; LOAD = 12
SUBCASE 2; LOAD = 3
SUBCASE 3; FROM = 1; LOAD = 20
SUBCASE 5; FROM = 2; LOAD = 6
SUBCASE 7; FROM = 1; LOAD = 12
SUBCASE 8; FROM = 1
SUBCASE 9; FROM = 2; LOAD = 20
BEGIN BULK
BLOCK2,1,1,1,1,0.0,0.0;+,8.0,5.0;+,5
PSHELL,1,1,2.0
MAT1,1,9500.0,,0.0
PMARK,5
JOINT,1,1,5
PJOINT,1,1
JNORM,1,8.0-3,0.5,1000.0
SPC1,1,1,1,2,3,4;JINCR,2,3
FORCE,1,2,,0.5,0.0,-1.0;FORCE,1,4,,0.5,0.0,-1.0
LOAD,3,1.0,3.0,1;LOAD,6,1.0,6.0,1;LOAD,12,1.0,12.0,1;LOAD,20,1.0,20.0,1
ENDDATA
DECK
if run cases_one; then
   # cases_lambda STAGE EXPRESSION BRANCH
   cases_lambda() {
      ask "cases: stage $1 by hand" cases_one rows "stage = $1" rows 'increment = 3' count 2 all "lambda = $2 within 1e-12" all "branch = \"$3\""
   }
   cases_lambda 1 '8e-3*sqrt(12/16)' LOAD
   cases_lambda 2 '8e-3*sqrt(12/16) - 9/16/1000' UNLOAD
   cases_lambda 3 '8e-3*sqrt(20/16)' LOAD
   cases_lambda 5 '8e-3*sqrt(12/16) - 6/16/1000' RELOAD
   cases_lambda 7 '8e-3*sqrt(12/16)' LOAD
   ask 'cases: stage 8 by hand' cases_one rows 'stage = 8 and increment = 3' count 2 all 'lambda = 8e-3*sqrt(12/16) - 12/16/1000 within 1e-12'
   cases_lambda 9 '8e-3*sqrt(20/16)' LOAD
   # WATCH counts from the state that FROM names: node 2 at the top, 5 mm above the joint
   cases_change() { near "cases: the change of stage $1" "$(awk -F, -v s="$1" '$1 == s { print $10 }' "$work/cases_one.watch.csv")" "$2" 1e-9 1e-14; }
   cases_change 3 "$(number '-(8e-3*(sqrt(20/16) - sqrt(12/16)) + 8*5/(9500*16))')"
   cases_change 5 "$(number '-(3/16/1000 + 3*5/(9500*16))')"
   cases_change 7 0
   cases_change 9 "$(number '-(8e-3*(sqrt(20/16) - sqrt(12/16)) + 9/16/1000 + 17*5/(9500*16))')"
   says 'the tables say where a stage started' "$work/cases_one.out" '^ INCREMENTS OF STAGE 5 FROM 2$'
   says '... the answer' "$work/cases_one.out" '^ ANSWER AT THE END OF STAGE 9 FROM 2$'
   says '... the error of path' "$work/cases_one.out" '^ ERROR OF PATH, STAGE 3 FROM 1:'
   says '... the energies' "$work/cases_one.out" '^ ENERGY OF JOINTS, STAGE 3 FROM 1$'
   same '... not where it is the stage before' "$(grep -c 'STAGE 2 FROM' "$work/cases_one.out")" 0
   same 'of two cases with one pressure, to rounding, the first is the worst' "$(awk -F, '$1 == "STAGE" { print $6 }' "$work/cases_one.cases.csv")" 3
   # the energy put in between two points of the curve, c**(-1/m) lambda**(1 + 1/m)/(1 + 1/m) a, is that of stage 3 alone
   near 'cases: the energy of stage 3' "$(awk '/^ ENERGY OF JOINTS, STAGE 3 FROM/ { on = 1 } on && $1 == 1 { print $2; exit }' "$work/cases_one.out")" \
      "$(number '16*8e-3/3*(sqrt(20/16)^3 - sqrt(12/16)^3)')" 1e-4
fi

# ---- a cantilever with two bolts and friction: cases from two states, the slack bolt, the warm one, beams, against their own decks
# cases_deck NAME METHOD SOLVER TIGHTENED STAGES...: the stages of a line each, the upper bolt tightened in the stage TIGHTENED
cases_deck() {
   local tightened=$4
   { printf '%s\n' "METHOD = $2" "SOLVER = $3" 'UNITS = MM, N' 'SPC = 1' 'INCR = 6' 'MODES = 7' 'OUTPUT = ALL' 'WATCH = SET 1' 'SET 1 = 9001'
     printf '%s\n' "${@:5}" | tr ';' '\n'
     sed -n '/^BEGIN BULK/,$p' input/cantilever_cases.bdf | sed "s/^BOLT    2 .*/BOLT,2,902,30000.,$tightened/;"'s/^RBE3M .*/RBE3M,9002,9001,123456,123,25/; s/^MAT1 .* 0\.26 .*/MAT1,1,120000.,,0.26,7.2-9,1.05-5,20.0/
        s/^ENDDATA/JINCR,6,3\nEIGRL,7,,,2\nCBAR,801,80,9001,9003,0.0,1.0,0.0\nGRID,9003,,300.,60.,30.\nPBAR,80,2,100.,2000.,2000.,3000.\nPLOAD1,21,801,FY,FR,0.,-1.0,1.,-1.0\nPLOAD1,22,801,FZ,FR,0.,2.0,1.,2.0\nLOAD,31,1.,1.,11,1.,21\nLOAD,32,1.,1.,12,1.,22\nENDDATA/'
   } > "$work/$1.bdf"
   run "$1"
}
# cases_rows NAME STAGE: bolts without the columns that only decks with temperatures or pressures have
cases_rows() { grep "^$2," "$work/$1.$ending.csv" | if [ $ending = bolt ]; then cut -d, -f1-23; else cat; fi; }
# cases_same NAME OTHER STAGE WORDS: all rows of a stage in all CSV files, and its tables of forces in beams, agree to the last digit
cases_same() {
   local ending
   for ending in joint stage bolt watch watch.energy modes modes.energy; do
      if [ "$(grep -c "^$3," "$work/$1.$ending.csv")" -gt 0 ] && cmp -s <(cases_rows "$1" "$3") <(cases_rows "$2" "$3"); then
         passed=$((passed + 1))
      else fail "cases: $4: .$ending.csv of $1 and of $2 differ"
      fi
   done
   same "cases: $4: forces in beams" "$(table "$1" "FORCES IN BEAMS, AT BOTH ENDS, IN THE AXES OF THE BEAM, STAGE $3 FROM")" \
      "$(table "$2" "FORCES IN BEAMS, AT BOTH ENDS, IN THE AXES OF THE BEAM, STAGE $3,")"
}
for cases_run in 'STEP SKYLINE' 'STEP TREE' 'NEWTON TREE'; do
   read -r cases_method cases_solver <<< "$cases_run"
   cases_name=cases_${cases_method}_$cases_solver
   cases_deck "$cases_name" "$cases_method" "$cases_solver" 2 'SUBCASE 1' 'SUBCASE 2' 'SUBCASE 3;LOAD = 32' 'SUBCASE 4;FROM = 1;LOAD = 13' 'SUBCASE 5;FROM = 2;LOAD = 31' \
      'SUBCASE 6;LOAD = 31;TEMP(LOAD) = 7' 'SUBCASE 7;FROM = 2;LOAD = 32;TEMP(LOAD) = 7' 'SUBCASE 8;FROM = 5;LOAD = 12' || continue
   cases_deck "${cases_name}_a" "$cases_method" "$cases_solver" 2 'SUBCASE 1' 'SUBCASE 2' 'SUBCASE 5;LOAD = 31' 'SUBCASE 8;LOAD = 12'
   cases_deck "${cases_name}_b" "$cases_method" "$cases_solver" 2 'SUBCASE 1' 'SUBCASE 2' 'SUBCASE 7;LOAD = 32;TEMP(LOAD) = 7'
   cases_deck "${cases_name}_c" "$cases_method" "$cases_solver" 9 'SUBCASE 1' 'SUBCASE 4;LOAD = 13' 'SUBCASE 9' # the bolt is slack until then
   cases_same "$cases_name" "${cases_name}_a" 5 'a force from a state that others have left'
   cases_same "$cases_name" "${cases_name}_a" 8 'and from there'
   cases_same "$cases_name" "${cases_name}_b" 7 'a warm case'
   cases_same "$cases_name" "${cases_name}_c" 4 'a bolt that is slack'
done

# ---- the table of the cases: the values of other tables, the worst of each column found once more, and the stage that has it
cp input/cantilever_cases.bdf "$work/cases_table.bdf"
sed -i 's/^UNITS/MODES = 7\n&/; s/^MAT1 .* 0.26 .*/MAT1,1,120000.,,0.26,7.2-9,1.05-5,20.0/; s/^ENDDATA/EIGRL,7,,,1\n&/' "$work/cases_table.bdf"
if run cases_table; then
   same 'a row for each case, in two forms' "$(cut -d, -f1-3 "$work/cases_table.cases.csv" | tr '\n' ' ')" \
      'kind,stage,from CASE,2,1 CASE,11,2 CASE,12,2 CASE,13,2 CASE,14,2 CASE,15,14 CASE,16,1 WORST,, STAGE,, '
   same '... also on the screen and in the listing' \
      "$(for cases_file in log out; do awk '/^ CASES:/ { on = 1 } on && $1 == "CASE" { printf "%s %s ", $2, $3 }' "$work/cases_table.$cases_file"; done)" \
      '2 1 11 2 12 2 13 2 14 2 15 14 16 1 2 1 11 2 12 2 13 2 14 2 15 14 16 1 '
   judge 'the worst of each column' -F, '
      function worse(k, a, b) { if (k >= 7 && k <= 9 || k >= 12) return a < b - 1e-6*b; return a*a > b*b*(1 + 3e-6) }
      NR == 1 { n = NF; next }
      $1 == "CASE" { for (k = 4; k <= n; k++) if ($k != "" && (!(k in at) || worse(k, $k, best[k]))) { best[k] = $k; at[k] = $2 } }
      $1 == "WORST" { for (k = 4; k <= n; k++) if ($k != best[k]) print "column " k ": " $k ", not " best[k] }
      $1 == "STAGE" { for (k = 4; k <= n; k++) { checked++; if ($k != at[k]) print "column " k ": stage " $k ", not " at[k] } }
      END { print "checked " checked }' "$work/cases_table.cases.csv"
   # cases_column TABLE COLUMNS: of the file, stage by stage, the last row of each
   judge 'the values are those of the other tables' -F, -v OFS=, '
      FNR == 1 { file++; split("", column); for (k = 1; k <= NF; k++) column[$k] = k; next }
      function at(name) { return $column[name] }
      file == 1 { u[at("stage")] = at("u_max"); m[at("stage")] = at("mises_max"); p[at("stage")] = at("p_max"); c[at("stage")] = at("contact")
                  s[at("stage")] = at("safety") + 0 > 1000 ? "" : at("safety") }
      file == 2 && at("load") == 1 { b = at("stage"); if (at("tightened") == "") next                # of the bolts that are tightened
                  if (!(b in least) || at("force") + 0 < least[b] + 0) least[b] = at("force"); if (at("use") + 0 > use[b] + 0) use[b] = at("use") }
      file == 3 { along[at("stage")] = at("along"); stiff[at("stage")] = at("stiffness") }
      file == 4 && at("mode") == 1 { f[at("stage")] = at("frequency") }
      file == 5 && at("kind") == "CASE" { b = at("stage"); checked++
                  if ($0 != "CASE" OFS b OFS at("from") OFS u[b] OFS m[b] OFS p[b] OFS c[b] OFS s[b] OFS least[b] OFS use[b] OFS along[b] OFS stiff[b] OFS f[b]) print "stage " b ": " $0 }
      END { print "checked " checked }' "$work"/cases_table.{stage,bolt,watch,modes,cases}.csv
fi
# a case that has no equilibrium: the table has the others
sed '/^MODES/d; s/^SUBCASE 15/SUBCASE 15\n  FROM = 1/; s/^FORCE   12 .*/FORCE,12,9001,,2.0+5,0.0,-1.0,0.0/' input/cantilever_cases.bdf > "$work/cases_ended.bdf"
if run cases_ended 3; then
   same 'a case without equilibrium: the others stay' "$(cut -d, -f1-3 "$work/cases_ended.cases.csv" | tr '\n' ' ')" \
      'kind,stage,from CASE,2,1 CASE,11,2 WORST,, STAGE,, '
   says '...' "$work/cases_ended.log" 'stage 12 from 2, increment 1: '
fi
