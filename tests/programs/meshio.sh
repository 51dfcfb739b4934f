#!/usr/bin/env bash
# Meshes of other programs, converted by the script of the card manual where meshio is installed: a bar of CTETRA with ten nodes and
# CHEXA with twenty nodes as .inp, .msh and .med, its groups as bulk data, is pulled to the exact stress. Where gmsh is installed,
# .unv too.
#
#    meshio.sh PROGRAM QUERY WORK_FOLDER
#
# PYTHON names a python3 that has meshio.
set -u
program=$1 query=$2 work=$3
source tests/exact/lib.sh
python=${PYTHON:-python3}
rm -rf "$work"
mkdir -p "$work"

# pulled WORDS MESH BODY LEFT RIGHT BELOW FRONT: the bar, 2 x 1 x 1, with these numbers of its groups, pulled by 5
pulled() {
   { printf '%s\n' 'SPC = 1' 'SUBCASE 1' '  LOAD = 10' 'BEGIN BULK' "INCLUDE '$2'" "PSOLID,$3,1" 'MAT1,1,1000.,,.3'
     printf 'PMARK,%s\n' "${@:4}"
     printf '%s\n' "SPCM,1,1,$4" "SPCM,1,2,$6" "SPCM,1,3,$7" "PLOADM,10,-5.,$5" ENDDATA; } > "$work/bar.bdf"
   rm -f "$work/bar.stage.csv"
   "$program" -q -o "$work" "$work/bar.bdf" > "$work/bar.log" 2>&1
   if "$query" "$work/bar.stage.csv" count 1 all 'mises_max = 5 within 1e-5 and u_max = sqrt(0.01^2 + 2*0.0015^2) within 1e-7' > "$work/said" 2>&1; then
      passed=$((passed + 1))
   else
      head -n 5 "$work/bar.log" "$work/said"
      fail "$1"
   fi
}

if "$python" -c 'import meshio' > /dev/null 2>&1; then
   awk '/^## Meshes from / { here = 1 } here && /^```$/ { exit } on { print } here && /^```python/ { on = 1 }' input/README.md > "$work/to_bulk.py"
   for format in inp msh med; do
      if [ $format = med ] && ! "$python" -c 'import h5py' > /dev/null 2>&1; then
         echo 'skipped: .med by meshio: h5py is not installed'
         continue
      fi
      for kind in tetra10 hexa20; do
         rm -f "$work/mesh.bdf"
         "$python" tests/programs/meshio_files.py tests/programs/bar_$kind.bdf "$work/bar.$format" > "$work/log" 2>&1 &&
            "$python" "$work/to_bulk.py" "$work/bar.$format" "$work/mesh.bdf" body left right below front >> "$work/log" 2>&1 || tail -n 3 "$work/log"
         pulled "$kind by .$format" mesh.bdf 1 2 3 4 5
      done
   done
else
   echo 'skipped: meshes by meshio: it is not installed (python3 -m pip install meshio h5py)'
fi
if command -v gmsh > /dev/null; then
   gmsh -3 -order 2 -format unv -setnumber Mesh.SecondOrderIncomplete 1 -setnumber kind 3 -o "$work/bar.unv" tests/programs/bar.geo > "$work/log" 2>&1
   (cd "$work" && gmsh bar.unv -save -format bdf -setnumber Mesh.SaveElementTagType 2 -setnumber Mesh.BdfFieldFormat 0 -o unv.bdf) >> "$work/log" 2>&1
   pulled 'tetra10 by .unv' unv.bdf 1 21 22 23 25
else
   echo 'skipped: .unv by gmsh: it is not installed'
fi
echo "$passed passed, $failed failed"
[ $failed -eq 0 ]
