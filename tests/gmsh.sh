#!/usr/bin/env bash
# The examples from Gmsh: their joints carry the load, and where gmsh is installed meshes built anew, finer and in every field
# format, do so too, and one of 50,000 nodes.
#
#    gmsh.sh PROGRAM QUERY WORK_FOLDER
set -u
program=$1 query=$2 work=$3
source tests/exact/lib.sh
mkdir -p "$work/gmsh"

# What the history NAME.joint.csv of an example must hold, to 1e-9: two_blocks and post_on_plate WORDS NAME
two_blocks() { ask "$1" "$2" rows 'increment = 2' all 'count() > 10 and sum(force) = 2400 within 2.4e-6'; }
post_on_plate() { # normal force 10000 in both stages, then 1500 along x, and a moment about y that grows by 1500 x 35
   ask "$1" "$2" by stage rows 'increment = max(increment)' rows 'stage = 2' with "$work/$2.joint.csv" on stage=1 on increment=2 on element \
      all 'count() >= 30 and sum(force) = 10000 within 1e-5 and sum(other.force) = 10000 within 1e-5' \
      all 'sum(other.tau_x*area) = 0 within 1e-6 and sum(tau_x*area) = -1500 within 1.5e-6' \
      all 'sum((force - other.force)*x) = 52500 within 5.25e-5'
}

# carries WORDS EXAMPLE DECK: run it, judge it
carries() {
   local name
   name=$(basename "$3" .bdf)
   if "$program" -q -o "$work" "$3"; then "$2" "$1" "$name"; else fail "$1"; fi
}

# anew EXAMPLE SED-SCRIPT: build its mesh with other sizes, in every field format: free, small, large
anew() {
   local example=$1 format
   sed "s/${example}_mesh/anew/" "input/$example.bdf" > "$work/anew.bdf"
   sed "$2" "input/gmsh/$example.geo" > "$work/gmsh/anew.geo"
   cmp -s "input/gmsh/$example.geo" "$work/gmsh/anew.geo" && fail "$example: the sizes are the same"
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
   grep -q 'SOLVER TREE' "$work/two_blocks_fine.out" || fail 'two_blocks, 50,000 nodes: AUTO did not take TREE'
else
   echo 'gmsh is not installed: the meshes are not built anew'
fi
echo "$passed passed, $failed failed"
[ $failed -eq 0 ] && [ $passed -gt 0 ]
