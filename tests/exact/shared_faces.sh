# One surface under several joints: each joint takes the part of the surface that faces its other side.

# bed NAME MARKS JOINTS: a bed 40 x 8 in two blocks that share nodes, their upper sides marked MARKS, under two feet that touch at x = 20; 10
# presses the first, 4 the second. The meshes match.
shared_faces_bed() {
   cards "$1" <<DECK
METHOD = NEWTON;SPC = 1;LOAD = 10;BEGIN BULK;MAT1,1,1000.,,.3;PSHELL,1,1,2.;BLOCK2,1,1,4,2,0.,0.;+,20.,8.,,,,,1,1;+,19,,${2%,*}
BLOCK2,2,1,4,2,20.,0.;+,40.,8.,,,,,101,101;+,19,,${2#*,},,1;BLOCK2,3,1,4,2,0.,8.;+,20.,16.,,,,,201,201;+,21,,31
BLOCK2,4,1,4,2,20.,8.;+,40.,16.,,,,,301,301;+,22,,32;PMARK,19;PMARK,20;PMARK,21;PMARK,22;PMARK,31;PMARK,32;${4:-$}
PJOINT,1,1,2;PJOINT,2,3,2;JNORM,1,.01,.5,1.+4;JNORM,3,.02,.7,1.+4;JSHEAR,2,100.
SPCM,1,12,19;PLOADM,10,10.,31;PLOADM,10,4.,32;$3;ENDDATA
DECK
   run "$1"
}

# A surface for each foot is the reference. The node at x = 20 has an element in both joints, each with its own part of the area.
for order in 1 2; do
   near_side='JOINT,1,1,20,21;JOINT,2,2,20,22' far_side='JOINT,1,1,20,21;JOINT,2,2,23,22'
   [ $order = 2 ] && near_side='JOINT,1,1,21,20;JOINT,2,2,22,20' far_side='JOINT,1,1,21,20;JOINT,2,2,22,23'
   shared_faces_bed apart 20,23 "$far_side" 'PMARK,23' && shared_faces_bed shared 20,20 "$near_side" && {
      same "order $order: one surface or two, the same bytes" "$(cmp "$work/apart.joint.csv" "$work/shared.joint.csv" && echo same)" same
      for j in 1 2; do
         near "order $order: area of joint $j" "$(value shared rows "joint = $j" print 'sum(area)')" 40 1e-12
         near "order $order: force of joint $j" "$(value shared rows "joint = $j" print 'sum(force)')" "$((j == 1 ? 400 : 160))" 1e-9
         ask "order $order: joint $j, five nodes, each once" shared rows "joint = $j" by node1 all 'count() = 1'
      done
   }
done
ask 'the node between the feet is in both joints' shared rows 'x = 20 within 1e-9' by stage all 'count() = 2' all 'sum(area) = 10 within 1e-12'

# plates NAME JOINTS: a bed 100 x 40 x 20 under two feet 30 x 30 whose meshes do not match it. Statics gives the force of each foot and its moment.
shared_faces_plates() {
   cards "$1" <<DECK
METHOD = NEWTON;SPC = 1;LOAD = 10;BEGIN BULK;BLOCK3,1,1,10,4,1,0.,0.,0.;+,100.,40.,20.,,,,1,1;+,,,,,19,20
BLOCK3,2,1,4,5,1,5.,5.,20.;+,35.,35.,40.,,,,1001,1001;+,,,,,21,31;BLOCK3,3,1,7,4,1,35.,5.,20.;+,65.,35.,40.,,,,2001,2001;+,,,,,22,32
PMARK,19;PMARK,20;PMARK,21;PMARK,22;PMARK,31;PMARK,32;PSOLID,1,1;MAT1,1,210000.,,0.;$2
PJOINT,1,1,2,2;JNORM,1,1.-4,1.,1.+4;JSHEAR,2,1.+4;SPCM,1,123,19;PLOADM,10,10.,31;PLOADM,10,4.,32;ENDDATA
DECK
   run "$1"
}
for joints in 'JOINT,1,1,20,21;JOINT,2,1,20,22' 'JOINT,1,1,21,20;JOINT,2,1,22,20' 'JOINT,1,1,21,20;JOINT,2,1,20,22'; do
   shared_faces_plates plates "$joints" || continue
   for j in 1 2; do
      x=$((j == 1 ? 20 : 50)) f=$((j == 1 ? 9000 : 3600))
      near "$joints: area of joint $j" "$(value plates rows "joint = $j" print 'sum(area)')" 900 1e-9
      near "$joints: force of joint $j" "$(value plates rows "joint = $j" print 'sum(force)')" $f 1e-9
      near "$joints: its place along x" "$(value plates rows "joint = $j" print 'sum(x*force)')" "$x*$f" 1e-9
      near "$joints: its place along y" "$(value plates rows "joint = $j" print 'sum(y*force)')" "20*$f" 1e-9
      ask "$joints: an element at each node of joint $j" plates rows "joint = $j" by node1 all 'count() = 1'
   done
done
