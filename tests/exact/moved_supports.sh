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

# D of SPC: reached in the first stage, kept with and without a LOAD; an SPCD, of a LOAD card too, takes its place in its stage
for way in spc spcd; do
   { echo 'METHOD = NEWTON
SPC = 9
INCR = 5
SUBCASE 1'
     [ $way = spcd ] && echo '  LOAD = 1'
     echo 'SUBCASE 2'
     [ $way = spcd ] && echo '  LOAD = 1' || echo '  LOAD = 7'
     echo 'SUBCASE 3
  LOAD = 3
SUBCASE 4'
     [ $way = spcd ] && echo '  LOAD = 1'
     echo 'BEGIN BULK
BLOCK2,1,1,4,2,0.0,0.0
+,10.0,5.0
+,20
PSHELL,1,1,2.0
MAT1,1,9500.0,,0.0
PMARK,20
JOINT,1,1,20
PJOINT,1,1,2,,.2,,.1
JNORM,1,8.0-3,0.5,500.
JSHEAR,2,60.
JINCR,5,3
SPC1,2,12,3,6,9,12,15
SPC1,1,2,9
SPCADD,9,1,2
LOAD,3,2.,.5,4,1.,5
FORCE,7,1,,1.-9,1.'
     for node in 3 6 9 12 15; do
        [ $way = spc ] && echo "SPC,1,$node,2,-.005" || echo "SPCD,1,$node,2,-.005"
        echo "SPCD,4,$node,2,-.007"
        [ $node = 9 ] && continue
        [ $way = spc ] && echo "SPC,1,$node,1,.001" || echo "SPCD,1,$node,1,.001"
     done
     [ $way = spc ] && echo 'SPC,1,9,1,.001,9,2,-.005' || echo 'SPCD,1,9,1,.001'
     # the stage that has SPCD along y has D along x still
     [ $way = spcd ] && for node in 3 6 9 12 15; do echo "SPCD,5,$node,1,.0005"; done
     echo 'FORCE,5,1,,1.-9,1.
ENDDATA'; } > "$work/held_at_$way.bdf"
   run held_at_$way
done
same_rows 'D of SPC as SPCD of the same' held_at_spc held_at_spcd 1e-8 $along
moved_block pushed_by_spc 6 4 0.1 0.0:-5.0E-3 && {
   sed -E -i -e '/^SPCD,.*,1,/d; s/^SPCD,/SPC,/; /LOAD = 1/d; s/^SPCM,1,12,21/SPCM,1,1,21/' "$work/pushed_by_spc.bdf"
   run pushed_by_spc
   near 'pressed by D of SPC without LOAD: p' "$(cell pushed_by_spc 1 1 1 pressure)" "$(in_series 5.0E-3)" 1e-9
   same 'that deck has no SPCD' "$(grep -c '^SPCD' "$work/pushed_by_spc.bdf")$(grep -c '^SPC,1,.*-5' "$work/pushed_by_spc.bdf")" 07
}

# No unknown is left: two bodies with all nodes held, the upper one moved, follow the law of the joint between them; one that is
# stretched and one that is heated have the stress of the exact solution
blocks='GRID,1,,0.,0.,0.;GRID,2,,1.,0.,0.;GRID,3,,1.,1.,0.;GRID,4,,0.,1.,0.;GRID,5,,0.,0.,1.;GRID,6,,1.,0.,1.;GRID,7,,1.,1.,1.
GRID,8,,0.,1.,1.;CHEXA,1,1,1,2,3,4,5,6;+,7,8;PSOLID,1,1;MAT1,1,2.1+5,,0.3,,1.2-5,0.;SPC1,1,123,1,THRU,4;SPC1,2,123,5,THRU,8;SPCADD,9,1,2'
raised() { for node in ${2//,/ }; do printf 'SPCD,%s,%s,3,%s\n' "$1" "$node" "$3"; done; }
for solver in SKYLINE TREE; do
   for method in STEP NEWTON; do
      name=all_held_${solver}_$method
      { echo "METHOD = $method;SOLVER = $solver;SPC = 9;SUBCASE 1;LOAD = 2;SUBCASE 2;LOAD = 5;TEMP(LOAD) = 3;BEGIN BULK;$blocks"
        raised 2 5,6,7,8 .001
        echo 'TEMPD,3,100.;FORCE,5,7,,5.,1.;ENDDATA'; } | cards $name
      run $name && says "$name" "$work/$name.log" 'all components of all nodes are supported' || continue
      near "$name, stretched: force" "$("$query" "$work/$name.reaction.csv" rows 'stage = 1 and id = 2' print force_z)" \
           '1E-3*2.1E5*0.7/(1.3*0.4)' 1e-12
      near "$name, heated: force" "$("$query" "$work/$name.reaction.csv" rows 'stage = 2 and id = 1' print force_z)" \
           '2.1E5*1.2E-3/0.4' 1e-12
      near "$name, pushed: force" "$("$query" "$work/$name.reaction.csv" rows 'stage = 2 and id = 2' print force_x)" -5 1e-12
   done
   for method in NEWTON BACK; do
      name=law_held_${solver}_$method
      { echo "METHOD = $method;SOLVER = $solver;SPC = 9;SUBCASE 1;LOAD = 2;INCR = 3"
        [ $method = NEWTON ] && echo 'SUBCASE 2;LOAD = 4'
        echo "BEGIN BULK;$blocks;CHEXA,2,1,15,16,17,18,25,26;+,27,28;JINCR,3,4,ARITH,.25"
        for k in 5 6 7 8; do
           sed -n "s/^GRID,$k,,\(.*,\)1\.\$/GRID,1$k,,\11.;GRID,2$k,,\12.;CJOINT,10$k,1,$k,1$k,.25,0.,0.,1./p" <<< "$(tr ';' '\n' <<< "$blocks")"
        done
        echo 'PJOINT,1,1;JNORM,1,1.-3,.5;SPC1,1,123,15,THRU,18;SPC1,1,123,25,THRU,28'
        raised 2 15,16,17,18,25,26,27,28 -.004
        raised 4 15,16,17,18,25,26,27,28 .001
        echo ENDDATA; } | cards $name
      run $name || continue
      if [ $method = BACK ]; then
         near "$name: p" "$(cell $name 1 1 6 pressure)" 16 1e-12
         continue
      fi
      for i in 1 2 3 4; do near "$name, increment $i: p" "$(cell $name 1 $i 6 pressure)" "$i*$i" 1e-12; done
      same "$name: lifted" "$(cell $name 2 1 6 branch)" OPEN
   done
done
