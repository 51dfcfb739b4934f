#!/usr/bin/env bash
# Writes FOLDER/two_blocks_fine.bdf and its mesh: the two blocks of input/gmsh with about 50,000 nodes, all tetrahedra. The deck
# uses STEP, because one third of the unknowns remains after condensation, too many for NEWTON in a test.
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
