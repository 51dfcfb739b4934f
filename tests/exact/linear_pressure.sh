# PRESSURE = LINEAR on JOINT: the sum of the elements of a side is its consistent matrix, the integral of N^T k N. A body moved as a rigid one: the
# reactions at the nodes of the side are this matrix times the movements. k = 1000; a spring of its own gives the deck an unknown

# consistent WORDS NODES NODE:FORCE... : RZ of a node, RY in the plane, of $work/consistent.out
consistent() {
   local words=$1 pair
   run consistent || return
   for pair in "${@:2}"; do
      near "$words, node ${pair%%:*}" "$(table consistent 'REACTIONS AT SUPPORTS' | awk -v node="${pair%%:*}" '$1 == node { v = $NF } END { print v }')" "-(${pair#*:})" 2e-5
   done
}
law='PJOINT,1,1;JNORM,1,1.0-3,1.0,1.0+3;GRID,90,,99.0,99.0;CELAS2,90,1.0,90,1;CELAS2,91,1.0,90,2'
rigid() { # MODEL CARDS: bodies with v or w = -0.001 - 0.0005 x at all nodes of SPCD cards among CARDS
   tr ';' '\n' <<< "METHOD = NEWTON;MODEL = $1;SPC = 1;SUBCASE 1;LOAD = 1;BEGIN BULK;PMARK,31;JOINT,1,1,31,,,,LINEAR;MAT1,1,1000.0,,0.3;$law;$2;ENDDATA" > "$work/consistent.bdf"
}
# an edge of length 6, thickness 2: k t L/6 [2 1; 1 2] (0.001, 0.004)
rigid PLANE 'GRID,1,,0.0,0.0;GRID,2,,6.0,0.0;GRID,3,,6.0,5.0;GRID,4,,0.0,5.0;CQUAD4,1,1,1,2,3,4;CBAR,9,31,1,2;PSHELL,1,1,2.0;SPC1,1,12,1,2,3,4
SPCD,1,1,2,-0.001,2,2,-0.004;SPCD,1,3,2,-0.004,4,2,-0.001;SPCD,1,3,1,0.0025,4,1,0.0025'
consistent 'an edge' '1:2000*(2*0.001 + 0.004)' '2:2000*(0.001 + 2*0.004)'
# an edge of a ring, r 3 to 9, moved along the axis by 0.001: 2 pi k 0.001 L (2 r_1 + r_2)/6
rigid AXISYMMETRIC 'GRID,1,,3.0,0.0;GRID,2,,9.0,0.0;GRID,3,,9.0,5.0;GRID,4,,3.0,5.0;CQUAD4,1,1,1,2,3,4;CBAR,9,31,1,2;PAXIS,1,1;SPC1,1,12,1,2,3,4
SPCD,1,1,2,-0.001,2,2,-0.001;SPCD,1,3,2,-0.001,4,2,-0.001'
consistent 'an edge of a ring' '1:2*pi*6*15/6' '2:2*pi*6*21/6'
# a rectangle 6 x 4: k A/36 [4 2 1 2; ...] (1, 4, 4, 1)/1000
tilted='SPCD,1,1,3,-0.001,4,3,-0.001;SPCD,1,2,3,-0.004,3,3,-0.004;SPCD,1,5,3,-0.001,8,3,-0.001;SPCD,1,6,3,-0.004,7,3,-0.004
SPCD,1,5,1,0.0025,6,1,0.0025;SPCD,1,7,1,0.0025,8,1,0.0025'
rigid SPACE "GRID,1,,0.0,0.0,0.0;GRID,2,,6.0,0.0,0.0;GRID,3,,6.0,4.0,0.0;GRID,4,,0.0,4.0,0.0;GRID,5,,0.0,0.0,5.0;GRID,6,,6.0,0.0,5.0;GRID,7,,6.0,4.0,5.0
GRID,8,,0.0,4.0,5.0;CHEXA,1,1,1,2,3,4,5,6;+,7,8;CQUAD4,9,31,1,2,3,4;PSOLID,1,1;SPC1,1,123,1,THRU,8;CELAS2,92,1.0,90,3;$tilted"
consistent 'a rectangle' '1:24000/36*(4*0.001 + 2*0.004 + 0.004 + 2*0.001)' '2:24000/36*(2*0.001 + 4*0.004 + 2*0.004 + 0.001)'
# a triangle, 6 x 4: k A/12 [2 1 1; 1 2 1; 1 1 2] (1, 4, 1)/1000
rigid SPACE 'GRID,1,,0.0,0.0,0.0;GRID,2,,6.0,0.0,0.0;GRID,3,,0.0,4.0,0.0;GRID,4,,0.0,0.0,5.0;GRID,5,,6.0,0.0,5.0;GRID,6,,0.0,4.0,5.0
CPENTA,1,1,1,2,3,4,5,6;CTRIA3,9,31,1,2,3;PSOLID,1,1;SPC1,1,123,1,THRU,6;CELAS2,92,1.0,90,3
SPCD,1,1,3,-0.001,3,3,-0.001;SPCD,1,2,3,-0.004;SPCD,1,4,3,-0.001,6,3,-0.001;SPCD,1,5,3,-0.004;SPCD,1,4,1,0.0025,5,1,0.0025;SPCD,1,6,1,0.0025'
consistent 'a triangle' '1:1000*(2*0.001 + 0.004 + 0.001)' '2:1000*(0.001 + 2*0.004 + 0.001)'

# ---- The pressure of a stiff joint round a shaft: constant over the nodes it is smooth, linear over the elements it oscillates
# waves NAME: sum of |p_before - 2 p + p_after| over the sum of p, in the order of the angle
waves() {
   awk -F, 'NR > 1 { print atan2($9, $8), $14 }' "$work/$1.joint.csv" | sort -g |
      awk '{ p[NR] = $2; s += $2 } END { for (i = 1; i <= NR; i++) { d = p[i > 1 ? i - 1 : NR] - 2*p[i] + p[i < NR ? i + 1 : 1]; w += d < 0 ? -d : d } print w/s }'
}
sed 's/^JOINT.*/JOINT,1,1,31,32,,,LINEAR/' input/hub.bdf > "$work/hub_linear.bdf"
run_input hub && run hub_linear && {
   holds 'constant pressure: smooth' "$(waves hub) < 0.12"
   holds 'linear pressure: oscillates' "$(waves hub_linear) > 2"
   sed 's/^JNORM.*/JNORM,1,1.0-3,1.0,1.0+3/' "$work/hub_linear.bdf" > "$work/hub_soft.bdf"
   run hub_soft && holds 'linear pressure, a soft joint: smooth' "$(waves hub_soft) < 0.3"
}
