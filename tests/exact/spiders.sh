# Bolts from spider to spider and a load on a rigid pin, input/bracket_spiders.bdf: statics of the foot, from the histories of bolts and joint.

run_input bracket_spiders && {
   ask 'tightened, the joint carries the preloads' bracket_spiders rows 'stage = 1' by increment all 'sum(force) = 48000*load within 1e-5'
   judge 'foot of the bracket: forces along z, moments about y' -F, '
      FNR == 1 { file++; for (i = 1; i <= NF; i++) at[file, $i] = i; next }
      { step = $at[file, "stage"] "," $at[file, "increment"]; share[step] = $at[file, "stage"] == 2 ? $at[file, "load"] : $at[file, "stage"] == 3 }
      file == 1 { arm = $at[1, "bolt"] % 2 ? -30 : 30; n[step] -= $at[1, "force"]; m[step] += arm * $at[1, "force"] }
      file == 2 { n[step] += $at[2, "force"]; m[step] -= ($at[2, "x"] - 50) * $at[2, "force"] }
      END {
         for (step in n) {
            off = n[step] + 600 * share[step]; turn = m[step] + (3000 * 80 + 20000) * share[step]
            if (!(off < 1e-4 && off > -1e-4 && turn < 1e-2 && turn > -1e-2)) print step ": left over " off ", " turn
            checked++
         }
         if (checked == 12) print "checked " checked
      }' "$work/bracket_spiders.bolt.csv" "$work/bracket_spiders.joint.csv"
   sed 's/^SPC = 1/SPC = 1\nSOLVER = SKYLINE/' input/bracket_spiders.bdf > "$work/bracket_skyline.bdf"
   run bracket_skyline && same_rows 'bracket by SKYLINE' bracket_spiders bracket_skyline 1e-9 $both
}

# C as pre-processors write it: the rotations that nodes of bodies do not have change nothing, and are named once
sed -E 's/^(RBE3 .*[0-9]\.0     )123   /\1123456/; s/^(\+       )123   ( .*)/\1123456\2/; s/(1\.0     )123   /\1123456/' "$work/bracket_spiders.bdf" > "$work/spiders_456.bdf"
same '123456 in C' "$(grep -c 123456 "$work/spiders_456.bdf")" 16
run spiders_456
same_rows '123456 in C of RBE3' spiders_456 bracket_spiders 1e-12 $resultant
says '123456 in C: on the screen' "$work/spiders_456.log" '8 entries without effect: 456 in C of RBE3'
# UM: the same equations, solved for components of the nodes
awk '/^RBE3/ { um = substr($0, 57, 8) + 0 } { print } um && /^[+]/ && ++n == 2 { printf "+       UM      %-8d123\n", um; um = 0; n = 0 }' \
   "$work/bracket_spiders.bdf" > "$work/spiders_um.bdf"
same 'UM in the deck' "$(grep -c 'UM  ' "$work/spiders_um.bdf")" 8
run spiders_um
same_rows 'UM of RBE3' spiders_um bracket_spiders 1e-8 $resultant
# UM of the reference node and its own components: nothing changes
awk '/^RBE3/ { um = substr($0, 25, 8); of = substr($0, 33, 8) } { print } um && /^[+]/ && ++n == 2 { print "+       UM      " um of; um = ""; n = 0 }' \
   "$work/bracket_spiders.bdf" > "$work/spiders_own.bdf"
same 'UM of the reference node in the deck' "$(grep -c 'UM  ' "$work/spiders_own.bdf")" 8
run spiders_own && same_rows 'UM of RBE3, its reference node' spiders_own bracket_spiders 1e-8 $resultant

# a reference node that is held and moved, components of its nodes dependent by UM, against the forces that this needs on a free one
cat > "$work/um_held.inc" <<'END_OF_DECK'
BLOCK3,1,1,3,2,2,0.,0.,0.
+,30.,20.,20.
+,,,,,20
PMARK,20
PSOLID,1,1
MAT1,1,9500.,,.25
JOINT,1,1,20
PJOINT,1,1,2,2,,,.1
JNORM,1,8.-3,.5,500.
JSHEAR,2,60.
GRID,901,,16.,9.,30.
JINCR,5,4
END_OF_DECK
{ printf 'METHOD = NEWTON\nSPC = 1\nINCR = 5\nBEGIN BULK\nINCLUDE um_held.inc\n'
  echo 'RBE3,951,,901,123456,1.,123,3,6
,9,12,15,18,21,24,27,30
,2.,123,33,36
,UM,3,123,9,13,33,3'
  echo 'SPC,1,901,3,-.02,901,1,.004
SPC,1,901,4,-3.-4
SPC1,1,256,901
ENDDATA'; } > "$work/um_held.bdf"
run um_held && {
   table um_held 'REACTIONS AT SUPPORTS' > "$work/um.rows"; table um_held 'MOMENTS AT SUPPORTS' >> "$work/um.rows"
   { printf 'METHOD = NEWTON\nLOAD = 10\nINCR = 5\nBEGIN BULK\nINCLUDE um_held.inc\n'
     echo 'RBE3,951,,901,123456,1.,123,3,6
,9,12,15,18,21,24,27,30
,2.,123,33,36'
     awk '$1 == 901 && NF == 7 { printf "FORCE,10,901,,1.,%s,%s,%s\n", $5, $6, $7 }
          $1 == 901 && NF == 4 { printf "MOMENT,10,901,,1.,%s,%s,%s\n", $2, $3, $4 }' "$work/um.rows"
     echo ENDDATA; } > "$work/um_free.bdf"
   same 'forces from the reactions' "$(grep -c '^FORCE\|^MOMENT' "$work/um_free.bdf")" 2
   run um_free && {
      ask 'a held reference node by UM: the same joint' um_held rows 'increment = 4' count 12 all 'max(pressure) > 0.1' with "$work/um_free.joint.csv" \
          on node1 on increment=4 all 'pressure = other.pressure within 5e-5*max(pressure)' all 'lambda = other.lambda within 5e-5*max(lambda)'
      for deck in um_held um_free; do
         near "$deck: u_x of its reference node" "$(table $deck 'DISPLACEMENTS OF NODES' | awk '$1 == 901 { print $5 }')" .004 1e-4
         near "$deck: u_z" "$(table $deck 'DISPLACEMENTS OF NODES' | awk '$1 == 901 { print $7 }')" -.02 1e-4
         near "$deck: rotation about x" "$(table $deck 'ROTATIONS OF REFERENCE' | awk '$1 == 901 { print $2 }')" -3e-4 1e-4
         near "$deck: rotation about y" "$(table $deck 'ROTATIONS OF REFERENCE' | awk '$1 == 901 { print $3 }')" 0 0 1e-8
      done
   }
}
# MPCADD: the equations of both sets
for sets in 'MPC,5' 'MPCADD,9,5,6\nMPC,6'; do
   { printf 'METHOD = NEWTON\nMPC = %s\nSPC = 1\nLOAD = 10\nBEGIN BULK\nINCLUDE um_held.inc\n' "$(case $sets in MPCADD*) echo 9 ;; *) echo 5 ;; esac)"
     echo 'SPC1,1,12,1,2,3
FORCE,10,36,,100.,.1,0.,-1.
MPC,5,9,3,1.,18,3,-1.'
     printf "$sets,36,3,1.,27,3,-1.\nENDDATA\n"; } > "$work/mpc_${sets:3:1}.bdf"
   run "mpc_${sets:3:1}"
done
same_rows 'MPCADD' mpc_A mpc_, 1e-12 $resultant

# one element of 20 nodes, the load on a middle of an edge: its eight corners rigid by RBE2 and held there, or held themselves; and with all
# three components of six middles and one of the loaded node in one MPC of 19 terms, whose sum of displacements is 0
one_hexa() { # NAME CARDS
   { printf "SPC = 1\n${3:-}SUBCASE 1\n LOAD = 1\nBEGIN BULK\n"
     awk 'BEGIN {
        split("0 10 10 0 0 10 10 0 5 10 5 0 0 10 10 0 5 10 5 0", x); split("0 0 10 10 0 0 10 10 0 5 10 5 0 0 10 10 0 5 10 5", y)
        split("0 0 0 0 10 10 10 10 0 0 0 0 5 5 5 5 10 10 10 10", z)
        for (i = 1; i <= 20; i++) printf "GRID,%d,,%g,%g,%g\n", i, x[i], y[i], z[i]
        print "CHEXA,1,1,1,2,3,4,5,6\n,7,8,9,10,11,12,13,14\n,15,16,17,18,19,20\nPSOLID,1,1\nMAT1,1,21000.,,.3\nFORCE,1,17,0,100.,1.,2.,-3." }'
     printf "$2"'ENDDATA\n'; } > "$work/$1.bdf"
}
one_hexa hexa_rbe2 'GRID,900,,3.,4.,5.\nRBE2,50,900,123456,1,2,3,4,5\n,6,7,8\nSPC1,1,123456,900\n'
one_hexa hexa_held 'SPC1,1,123,1,2,3,4,5,6\n,7,8\n'
run hexa_rbe2 && run hexa_held && {
   for d in 1 2 3; do near "corners by RBE2: component $d" "$(moved hexa_rbe2 17 $d)" "$(moved hexa_held 17 $d)" 1e-5; done
   near 'corners by RBE2: the support takes the load' "$(total hexa_rbe2 SUPPORTS 3)" "$(total hexa_held SUPPORTS 3)" 1e-9
}
terms=$(for n in 10 11 12 13 14 15; do for d in 1 2 3; do echo "$n,$d,1."; done; done |
   awk '{ t = t (NR == 1 ? "" : NR % 2 == 0 ? "\\n,," : ",") $0 } END { print t }')
for solver in SKYLINE TREE; do
   one_hexa hexa_mpc_$solver "MPC,7,17,3,1.,$terms\nSPC1,1,123,1,2,3,4,5,6\n,7,8\n" "SOLVER = $solver\nMPC = 7\n"
   run hexa_mpc_$solver && judge "MPC of 19 terms by $solver" '/^ DISPLACEMENTS OF NODES/ { on = 1; next } /^ [A-Z]/ { on = 0 }
      on && $1 == 17 { sum += $7; size += ($7 > 0 ? $7 : -$7) } on && $1 >= 10 && $1 <= 15 { sum += $5 + $6 + $7; size += ($5 > 0 ? $5 : -$5) }
      END { if (!(sum*sum < 1e-10*size*size)) print "sum " sum " of " size; print "checked 1" }' "$work/hexa_mpc_$solver.out"
done

# ---- an equation between components of one node: it slides along u1 = 2.5 u2 on springs of 100, whichever of both depends, in space and in the plane
for model in SPACE PLANE; do
   for terms in '2,1,1.,2,2,-2.5' '2,2,-2.5,2,1,1.'; do
      cards slide <<DECK
MODEL = $model;MPC = 9;SPC = 1;LOAD = 1;BEGIN BULK;GRID,1;GRID,2,,100.,20.,0.;CELAS2,1,100.,2,1;CELAS2,2,100.,2,2;MPC,9,$terms;SPC1,1,3,2
SPC1,1,123,1;FORCE,1,2,,100.,0.,1.,0.;ENDDATA
DECK
      run slide && near "an equation in one node, $model, $terms: u1" "$(moved slide 2 1)" '2.5*100/(100*2.5^2 + 100)' 3e-6 &&
         near "an equation in one node, $model, $terms: u2" "$(moved slide 2 2)" '100/(100*2.5^2 + 100)' 3e-6
   done
done
# a rod without strain between the ends of two free beams, with any of the six dependent components: the modes of one that is very stiff
rod() { # NAME ROD
   cards "$1" <<DECK
MODEL = SPACE;MODES(FREE) = 4;BEGIN BULK;GRID,1,,0.,0.,0.;GRID,2,,100.,20.,30.;GRID,3,,110.,-40.,80.;CBAR,1,5,1,2,0.,0.,1.,BGG
CBAR,2,5,1,3,0.,0.,1.,BGG;PBAR,5,1,100.,800.,800.,1600.;MAT1,1,2.1+5,,.3,7.85-9;$2;EIGRL,4,,,9;ENDDATA
DECK
   run "$1"
}
rod stiff_rod 'CONROD,9,2,3,2,100.;MAT1,2,2.+9,,.3' &&
   for ends in 1, 2, 3, ,1 ,2 ,3; do
      rod rod "RROD,9,2,3,$ends" || continue
      near "RROD, $ends: rigid-body motions" "$(mode rod 6 frequency)" 0 0 1e-3
      for k in 7 8 9; do near "RROD, $ends: mode $k" "$(mode rod $k frequency)" "$(mode stiff_rod $k frequency)" 1e-6; done
   done

# a node on springs of 100 that is held along z, with u1 = 0.5 u3: the reaction is that of z alone, F3 + 0.5 F1
for cd in '' 9; do
   cards own_held <<DECK
MODEL = SPACE;MPC = 9;SPC = 1;LOAD = 1;BEGIN BULK;CORD2R,9,,0.,0.,0.,0.,0.,1.;,1.,0.,0.;GRID,1;GRID,2,,100.,20.,30.,$cd;CELAS2,1,100.,2,1;CELAS2,2,100.,2,2
CELAS2,3,100.,2,3;MPC,9,2,1,1.,2,3,-.5;SPC1,1,3,2;SPC1,1,123,1;FORCE,1,2,,1.,100.,200.,300.;ENDDATA
DECK
   run own_held && {
      near "held and followed in one node, CD $cd: along z" "$(total own_held SUPPORTS 3)" '-(300 + 0.5*100)' 1e-6
      near "held and followed in one node, CD $cd: nothing along x" "$(total own_held SUPPORTS 1)" 0 0 1e-9
   }
done
# RBE3 whose dependent components are rotations about x or y alone
for c in 4 5 45; do
   cards spider_turns <<DECK
MODEL = SPACE;SPC = 1;LOAD = 10;BEGIN BULK;GRID,1,,0.,0.,0.;GRID,2,,10.,0.,0.;GRID,3,,0.,10.,0.;GRID,4,,3.,3.,0.;CELAS2,3,100.,1,3;CELAS2,6,100.,2,3
CELAS2,9,100.,3,3;SPC1,1,12,1,2,3;SPC1,1,1236,4;SPC1,1,$((9 - 10#${c: -1})),4;RBE3,50,,4,$c,1.,123,1,2;,3;FORCE,10,2,0,1.,0.,0.,1.;ENDDATA
DECK
   [ $c = 45 ] && sed -i '/^SPC1,1,4,4/d' "$work/spider_turns.bdf"
   run spider_turns && near "RBE3, REFC = $c: the node loaded" "$(moved spider_turns 2 3)" 0.01 3e-6
done
