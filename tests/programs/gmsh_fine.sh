#!/usr/bin/env bash
# The two blocks of input/gmsh, meshed with about 50,000 nodes, all tetrahedra: FOLDER/two_blocks_fine.bdf and its mesh. One third
# of the unknowns is left after condensation, too much for NEWTON in a test: STEP.
#
#    gmsh_fine.sh FOLDER
set -eu
folder=$1
mkdir -p "$folder/gmsh"
mesh=$folder/gmsh/two_blocks_fine_mesh.bdf
sed 's/MeshSize {:} = .*;/MeshSize {:} = 1.175;/' input/gmsh/two_blocks.geo > "$folder/gmsh/two_blocks_fine.geo"
rm -f "$mesh" "$folder/two_blocks_fine.bdf"
gmsh -3 -format bdf -setnumber Mesh.SaveElementTagType 2 -o "$mesh" "$folder/gmsh/two_blocks_fine.geo" > "$folder/gmsh/log" 2>&1
nodes=$(grep -c '^GRID' "$mesh")
if [ "$nodes" -lt 48000 ] || [ "$nodes" -gt 52000 ] || grep -qE '^C(PENTA|HEXA)' "$mesh"; then
   echo "gmsh_fine.sh: $nodes nodes, expected 48000 to 52000, all of CTETRA" >&2
   exit 1
fi
sed 's/two_blocks_mesh/two_blocks_fine_mesh/; s/^METHOD *=.*/METHOD = STEP/' input/two_blocks.bdf > "$folder/two_blocks_fine.bdf"
