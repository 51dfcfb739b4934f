#!/usr/bin/env bash
# The examples from Gmsh: their joints carry the load, and where gmsh is installed meshes built anew, finer and in every field
# format, do so too, and one of 50,000 nodes.
#
#    gmsh.sh PROGRAM WORK_FOLDER
set -u
program=$1 work=$2
passed=0 failed=0
mkdir -p "$work/gmsh"

# What the history NAME.joint.csv of an example must hold, to 1e-9; a line for every fault
two_blocks() { # normal force 2400
   awk -F, 'FNR == 1 { for (k = 1; k <= NF; k++) at[$k] = k; next }
      $2 == 2 { force += $(at["force"]); n++ }
      END { if (!(n > 10 && (force / 2400 - 1)^2 < 1e-18)) print n " elements, normal force " force }' "$1"
}
post_on_plate() { # normal force 10000 in both stages, then 1500 along x, and a moment about y that grows by 1500 x 35
   awk -F, 'FNR == 1 { for (k = 1; k <= NF; k++) at[$k] = k; next }
      { last[$1] = $2 }
      { i = $1 "," $2; n[i]++; a = $(at["area"]); force[i] += $(at["force"]); shear[i] += $(at["tau_x"]) * a; moment[i] += $(at["force"]) * $(at["x"]) }
      function far(x, y) { return !((x / y - 1)^2 < 1e-18) }
      END {
         i = "1," last[1]; j = "2," last[2]
         if (n[i] < 30 || n[j] != n[i]) print n[i] " elements, " n[j]
         if (far(force[i], 10000) || far(force[j], 10000)) print "normal force " force[i] ", " force[j]
         if (!(shear[i]^2 < 1e-12) || far(-shear[j], 1500)) print "shear force " shear[i] ", " shear[j]
         if (far(moment[j] - moment[i], 52500)) print "moment " moment[i] ", " moment[j]
      }' "$1"
}

# carries WORDS EXAMPLE DECK: run it, judge it
carries() {
   local name
   name=$(basename "$3" .bdf)
   if "$program" -q -o "$work" "$3" && "$2" "$work/$name.joint.csv" > "$work/faults" && [ ! -s "$work/faults" ]; then
      passed=$((passed + 1))
   else
      cat "$work/faults"
      failed=$((failed + 1)); echo "FAILED $1"
   fi
}

# anew EXAMPLE SED-SCRIPT: build its mesh with other sizes, in every field format: free, small, large
anew() {
   local example=$1 format
   sed "s/${example}_mesh/anew/" "input/$example.bdf" > "$work/anew.bdf"
   sed "$2" "input/gmsh/$example.geo" > "$work/gmsh/anew.geo"
   cmp -s "input/gmsh/$example.geo" "$work/gmsh/anew.geo" && { failed=$((failed + 1)); echo "FAILED $example: the sizes are the same"; }
   for format in 0 1 2; do
      rm -f "$work/gmsh/anew.bdf"
      gmsh -3 -format bdf -setnumber Mesh.SaveElementTagType 2 -setnumber Mesh.BdfFieldFormat $format \
         -o "$work/gmsh/anew.bdf" "$work/gmsh/anew.geo" > "$work/gmsh/log" 2>&1
      carries "$example: a mesh built anew, field format $format" "$example" "$work/anew.bdf"
   done
}

for example in two_blocks post_on_plate; do carries "$example: the mesh as shipped" $example input/$example.bdf; done
if command -v gmsh > /dev/null; then
   anew two_blocks 's/MeshSize {:} = .*;/MeshSize {:} = 9;/'
   anew post_on_plate 's/^size = .*;/size = 6;/'
   tests/gmsh_fine.sh "$work"
   carries 'two_blocks: 50,000 nodes' two_blocks "$work/two_blocks_fine.bdf"
   if ! grep -q 'SOLVER TREE' "$work/two_blocks_fine.out"; then
      failed=$((failed + 1)); echo 'FAILED two_blocks, 50,000 nodes: AUTO did not take TREE'
   fi
else
   echo 'gmsh is not installed: the meshes are not built anew'
fi
echo "$passed passed, $failed failed"
[ $failed -eq 0 ] && [ $passed -gt 0 ]
