# OUTPUT = CD: the vectors of a listing along the systems of the nodes against those in global axes; a sector between planes of
# symmetry of any direction against three of it on global supports.

run_input flange_sector
sed 's/, CD$//' "$work/flange_sector.bdf" > "$work/sector_global.bdf"
run sector_global

# along r and theta of the place of each node by hand
for title in 'DISPLACEMENTS OF NODES' 'REACTIONS AT SUPPORTS'; do
   table sector_global "$title" > "$work/sector_global.rows"
   table flange_sector "$title" > "$work/sector_cd.rows"
   judge "$title along CD" '
      function near(a, b) { return (a - b)^2 <= (2e-5*length_of)^2 }
      $1 !~ /^[0-9]+$/ { next }
      NR == FNR { global[FNR] = $0; next }
      { if (split(global[FNR], g) != 7 || NF != 8 || g[1] != $1) { print "row", FNR ": " $0; next }
        r = sqrt($2^2 + $3^2); c = $2/r; s = $3/r
        length_of = sqrt(g[5]^2 + g[6]^2 + g[7]^2)
        if (!near($5, c*g[5] + s*g[6]) || !near($6, c*g[6] - s*g[5]) || !near($7, g[7])) print global[FNR] ": " $0
        if ($8 != 2) print "system of node", $1 ": " $8
        if (length_of > 0) n++ }
      END { print "checked", n }' "$work/sector_global.rows" "$work/sector_cd.rows"
done
# planes of symmetry give along theta alone, and each what the other gives
table flange_sector 'REACTIONS AT SUPPORTS' > "$work/sector_cd.rows"
judge 'reactions of planes of symmetry' '$1 ~ /^[0-9]+$/ && $1 < 900 {
      if ($5 + 0 != 0 || $7 + 0 != 0) print "not along theta:", $0
      if ($1 % 10 == 0) at[$1 + 6] = $6
      else { if ((at[$1] + $6)^2 > (1e-4*$6)^2) print "not alike:", at[$1], $0; n++ } }
   END { print "checked", n }' "$work/sector_cd.rows"

# in space, by its system alone: cylinder axis along (1, 2, 2)
sed -e 's/^CORD2C .*/CORD2C,2,,10.,20.,30.,11.,22.,32./' -e 's/^+       1\.0     0\.0     0\.0$/,10.,30.,20./' \
    -e 's/^FORCEM .*/FORCEM,10,6545.,.3333333333333333,.6666666666666667,.6666666666666667,22/' "$work/flange_sector.bdf" > "$work/sector_turned.bdf"
run sector_turned && {
   same_rows 'a sector turned in space' sector_turned flange_sector 1e-9 $resultant
   table sector_turned 'DISPLACEMENTS OF NODES' > "$work/sector_turned.rows"
   table flange_sector 'DISPLACEMENTS OF NODES' > "$work/sector_cd.rows"
   judge 'its displacements along CD' '
      $1 !~ /^[0-9]+$/ { next }
      NR == FNR { here[FNR] = $0; next }
      { split(here[FNR], g)
        # the listing rounds what is small beside the largest movement, 4E-3, to 1E-11
        for (i = 5; i <= 7; i++) if ((g[i] - $i)^2 > (2e-5*$i)^2 + 1e-22) print here[FNR] ": " $0
        n++ }
      END { print "checked", n }' "$work/sector_turned.rows" "$work/sector_cd.rows"
}

# three sectors to a quarter, whose planes of symmetry are those of x and y: no CD
awk 'function field(i) { gsub(/ /, "", part[i]); return part[i] }
   function node(id, s) { return id < 900 && id % 10 == 0 && s > 0 ? node(id + 6, s - 1) : id + 1000*s }
   function cut(line, i) { for (i = 2; i <= 9; i++) part[i] = substr(line, 8*i - 7, 8) }
   { cut($0) }
   /^GRDSET/ { print "GRDSET,,2"; next }
   /^GRID/ { for (s = 0; s < 3; s++) if (node(field(2), s) == field(2) + 1000*s)
                printf "GRID,%d,,%s,%.1f,%s\n", field(2) + 1000*s, field(4), field(5) + 30*s, field(6); next }
   /^CHEXA/ { card = $0; next }
   /^[+]/ && card ~ /^CHEXA/ {
      for (s = 0; s < 3; s++) {
         cut(card); printf "CHEXA,%d,1", field(2) + 1000*s
         for (i = 4; i <= 9; i++) printf ",%d", node(field(i), s)
         cut($0); printf "\n,%d,%d\n", node(field(2), s), node(field(3), s)
      }
      next }
   /^CQUAD4/ { for (s = 0; s < 3; s++) { printf "CQUAD4,%d,%d", field(2) + 1000*s, field(3)
                  for (i = 4; i <= 7; i++) printf ",%d", node(field(i), s)
                  print "" }
               next }
   /^RBE3/ { for (s = 0; s < 3; s++) { b = 1000*s
                printf "RBE3,%d,,%d,123,4.,123,%d,2.\n,123,%d,%d,%d,%d,1.,123,%d\n,%d,%d,%d\n", 951 + b, 901 + b, 333 + b, 332 + b, 334 + b,
                       323 + b, 343 + b, 322 + b, 324 + b, 342 + b, 344 + b
                printf "CROD,%d,90,%d,%d\nBOLT,%d,%d,40000.,1\nSPC1,1,123,%d\n", 981 + b, 901 + b, 902 + b, s + 1, 981 + b, 902 + b }
             skip = 1; next }
   /^[+]/ && skip { next }
   { skip = 0 }
   /^(CROD|BOLT|SPC1 .*123 )/ { next }
   /^SPC1/ { for (i = 4; i <= 9; i++) if (field(i) != "") print "SPC1,1," (field(i) % 10 == 0 ? "2," field(i) : "1," field(i) + 2000); next }
   /^FORCEM/ { sub(/6545.0 /, "19635.0") }
   { sub(/, CD$/, ""); print }' "$work/flange_sector.bdf" > "$work/quarter.bdf"
run quarter && for s in 0 1 2; do
   # node 1 of the sector in the quarter; the nodes that sectors share bear half of what they have there
   for stage in 1 2; do
      for node in 101 113 133 134 145 152; do
         near "quarter, sector $s, stage $stage: p of node $node" "$(cell quarter $stage 4 $((node + 1000*s)) pressure)" \
              "$(cell flange_sector $stage 4 $node pressure)" 1e-8 1e-12
      done
   done
done
for stage in 1 2; do
   ask "quarter, stage $stage: three times the force" quarter rows "stage = $stage and increment = 4" \
       all "sum(force) = 3*($(value flange_sector rows "stage = $stage and increment = 4" by stage print 'sum(force)')) within 1e-6"
done
bolt=$("$query" "$work/flange_sector.bolt.csv" rows 'stage = 2 and increment = 4' print force)
if "$query" "$work/quarter.bolt.csv" rows 'stage = 2 and increment = 4' count 3 all "force = $bolt within 1e-7*force" > "$work/said" 2>&1; then
   passed=$((passed + 1))
else
   cat "$work/said"; fail 'quarter: bolt forces'
fi

# rotations and moments of a reference node along its system: what SPCD asks for; a bar in torsion about direction 3
cards turned_node <<'END'
METHOD = NEWTON;SPC = 1;LOAD = 10;OUTPUT = LAST, CD
BEGIN BULK;PSOLID,1,1;MAT1,1,9500.,,.25;BLOCK3,1,1,6,2,2,0.,0.,0.;+,60.,10.,10.;GRID,900,,80.,5.,25.,1
CORD2R,1,,0.,0.,0.,1.,1.,1.;+,1.,0.,0.;SPC1,1,123,1,THRU,9;SPC1,1,3456,900;SPCD,10,900,5,.001;SPCD,10,900,6,.002
RBE2,901,900,123456,55,57,63;ENDDATA
END
run turned_node && {
   same 'rotations along CD' "$(table turned_node 'ROTATIONS OF REFERENCE' | awk '$1 == 900 { print $2 + 0, $3, $4, $5 }')" \
        '0 1.00000E-03 2.00000E-03 1'
   says 'rotations along CD: heading' "$work/turned_node.out" 'NODE      THETA 1      THETA 2      THETA 3         CD'
   says 'moments along CD: heading' "$work/turned_node.out" 'NODE           M1           M2           M3         CD'
   sed 's/, CD$//' "$work/turned_node.bdf" > "$work/turned_global.bdf"
   run turned_global
   for title in 'MOMENTS AT SUPPORTS' 'ROTATIONS OF REFERENCE'; do
      for deck in turned_node turned_global; do table $deck "$title" | grep '^ *900 '; done > "$work/turned.rows"
      judge "$title along CD" '
         NR == 1 { for (i = 1; i <= 3; i++) cd[i] = $(i + 1) }
         NR == 2 { # z along (1, 1, 1), x along (2, -1, -1), y across both
            x = (2*$2 - $3 - $4)/sqrt(6); y = ($3 - $4)/sqrt(2); z = ($2 + $3 + $4)/sqrt(3); most = sqrt($2^2 + $3^2 + $4^2)
            if (!(most > 0) || (x - cd[1])^2 + (y - cd[2])^2 + (z - cd[3])^2 > (2e-5*most)^2) print x, y, z, "not", cd[1], cd[2], cd[3]
            print "checked 1" }' "$work/turned.rows"
   done
}
# in the plane about direction 3 of CD, which may be against z: a rigid turn by 0.01 about it
for z in 1. -1.; do
   cards plane_turn <<END
METHOD = NEWTON;SPC = 1;LOAD = 10;OUTPUT = LAST, CD
BEGIN BULK;PSHELL,1,1,2.;MAT1,1,9500.,,.25;BLOCK2,1,1,4,2,0.,0.;+,8.,4.;CORD2R,1,,0.,0.,0.,0.,0.,$z;+,1.,0.,0.
GRID,900,,2.,2.,,1;SPC1,1,126,900;SPCD,10,900,6,.01,900,2,.3;RBE2,90,900,12,1,3,13;ENDDATA
END
   run plane_turn && {
      same "turned about z $z" "$(table plane_turn 'ROTATIONS OF REFERENCE' | awk '$1 == 900 { print $2, $3 }')" '1.00000E-02 1'
      table plane_turn 'DISPLACEMENTS OF NODES' > "$work/turned.rows"
      judge "a rigid turn about z $z" -v z=$z '$1 ~ /^[0-9]+$/ && $1 < 900 { n++
            if (($4 + z*.01*($3 - 2))^2 + ($5 - z*.3 - z*.01*($2 - 2))^2 > 1e-12) print }
         END { print "checked", n }' "$work/turned.rows"
   }
done
# the mirror images of a sector balance all shear along its joint, whatever the angle of its planes
for name in flange_sector sector_turned quarter; do
   same "$name: no T of the whole joint" "$(awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next } { printf "%g %s;", $at["t"], $at["safety"] }' \
      "$work/$name.stage.csv")" '0 ;0 ;'
done
