#!/usr/bin/env bash
# Meshes from Gmsh. A bar of every kind of second-order element (bar_*.bdf), in every field format (field_format.awk), is pulled to
# the exact stress; the joints of the examples carry the load. Where gmsh is installed, so do new meshes of the bars and of finer
# examples in every field format, and one of 50,000 nodes; complete second-order elements are refused.
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

pin_in_bore() { # it bears about as much on any mesh
   ask "$1" "$2" rows 'stage = 2' rows 'increment = 4' all 'max(pressure) > 104 and max(pressure) < 109 and min(pressure) = 0'
}

column_foot() { # the joint bears the bolts, which stand upright but for the mesh, then 2 kN along x and as much along y; the stiffness at the tool is about that of any mesh
   ask "$1" "$2" by stage rows 'increment = max(increment)' rows 'stage = 1' all 'sum(force) = 100000 within 1'
   ask "$1" "$2" by stage rows 'increment = max(increment)' rows 'stage = 3' \
      all 'abs(sum(tau_x*area)) = 2000 within 100 and abs(sum(tau_y*area)) = 2000 within 100'
   if "$query" "$work/$2.watch.csv" all 'stiffness = if(stage = 2, 88000, 68000) within 4000' > "$work/said" 2>&1; then
      passed=$((passed + 1))
   else
      fail "$1: stiffness"
   fi
}

# carries WORDS EXAMPLE DECK: run it, judge it
carries() {
   local name
   name=$(basename "$3" .bdf)
   if "$program" -q -o "$work" "$3" > /dev/null; then "$2" "$1" "$name"; else fail "$1"; fi
}

# anew EXAMPLE SED-SCRIPT [FORMATS]: build its mesh with other sizes, in every field format: free, small, large, or those given.
# What is 0.02 off, as in pin_in_bore, needs the digits of the last.
anew() {
   local example=$1 format space=-3
   [ $example = pin_in_bore ] && space=-2
   sed "s/${example}_mesh/anew/" "input/$example.bdf" > "$work/anew.bdf"
   sed "$2" "input/gmsh/$example.geo" > "$work/gmsh/anew.geo"
   cmp -s "input/gmsh/$example.geo" "$work/gmsh/anew.geo" && fail "$example: the sizes are the same"
   for format in ${3:-0 1 2}; do
      rm -f "$work/gmsh/anew.bdf"
      gmsh $space -format bdf -setnumber Mesh.SaveElementTagType 2 -setnumber Mesh.BdfFieldFormat $format \
         -o "$work/gmsh/anew.bdf" "$work/gmsh/anew.geo" > "$work/gmsh/log" 2>&1
      carries "$example: a mesh built anew, field format $format" "$example" "$work/anew.bdf"
   done
}

# pulled WORDS KIND MESH: a bar of elements of KIND with the faces of MESH, pulled with 5 along x: the same stress everywhere
pulled() {
   local plane=0 body='PSOLID  1       1' elements
   case $2 in CTRIA6 | CQUAD8) plane=1 body='PSHELL  1       1       1.0' ;; esac
   elements=$(grep -c "^$2" "$3")
   {
      printf '%s\n' 'SPC = 1' 'SUBCASE 1' '  LOAD = 10' '  OUTPUT = LAST, STRESS' 'BEGIN BULK' "INCLUDE '$(realpath "$3")'" "$body" \
         'MAT1,1,1000.,,.3' 'PMARK,21' 'PMARK,22' 'PMARK,23' 'SPCM,1,1,21' 'SPCM,1,2,23' 'PLOADM,10,-5.,22'
      [ $plane = 1 ] || printf '%s\n' 'PMARK,25' 'SPCM,1,3,25'
      echo ENDDATA
   } > "$work/bar.bdf"
   rm -f "$work/bar.out"
   "$program" -q -o "$work" "$work/bar.bdf" > /dev/null && judge "$1" -v plane=$plane -v elements="$elements" '
      function off(x, y) { return (x > y ? x - y : y - x) > 1e-9 }
      / STRESSES AT THE CENTRES/ && !/PRINCIPAL/ { table = 1; next }
      / STRESSES AT NODES/ { table = 2; next }
      / PRINCIPAL| REACTIONS/ { table = 0 }
      !table || $1 + 0 != $1 || NF < 5 { next }
      {
         n[table]++
         first = table == 1 ? NF - (plane ? 2 : 5) : 2
         if (off($first, 5)) print FNR ": " $first ", 5 expected"
         for (k = first + 1; k <= first + (plane ? 2 : 5); k++) if (off($k, 0)) print FNR ": " $k ", 0 expected"
      }
      END {
         if (n[1] != elements || n[2] < 8) print n[1] + 0 " elements of " elements ", " n[2] + 0 " nodes"
         print "checked " n[1] + n[2]
      }' "$work/bar.out"
}

kinds=(CTRIA6 CQUAD8 CTETRA CPENTA CHEXA)
meshes=(tria6 quad8 tetra10 penta15 hexa20)
formats=(free small large)
for kind in 0 1 2 3 4; do
   for format in "${formats[@]}"; do
      mesh=tests/programs/bar_${meshes[kind]}.bdf
      [ $format = small ] || { awk -v form=$format -f tests/programs/field_format.awk "$mesh" > "$work/stored.bdf"; mesh=$work/stored.bdf; }
      pulled "bar of ${meshes[kind]}, $format field" "${kinds[kind]}" "$mesh"
   done
done
for example in two_blocks post_on_plate pin_in_bore column_foot; do carries "$example: the mesh as shipped" $example input/$example.bdf; done

# bar_anew KIND FORMAT COMPLETE: the mesh $work/gmsh/bar.bdf of the kind and format of these positions
bar_anew() {
   rm -f "$work/gmsh/bar.bdf"
   gmsh -$(($1 < 2 ? 2 : 3)) -order 2 -format bdf -setnumber Mesh.SecondOrderIncomplete $((1 - $3)) -setnumber kind $(($1 + 1)) \
      -setnumber Mesh.SaveElementTagType 2 -setnumber Mesh.BdfFieldFormat "$2" -o "$work/gmsh/bar.bdf" tests/programs/bar.geo \
      > "$work/gmsh/log" 2>&1
}

# refuses WORDS: the mesh of complete elements, with a message that names the remedy
refuses() {
   local status
   printf '%s\n' 'SUBCASE 1' 'BEGIN BULK' "INCLUDE 'gmsh/bar.bdf'" 'ENDDATA' > "$work/complete.bdf"
   "$program" --check "$work/complete.bdf" > "$work/complete.log" 2>&1
   status=$?
   same "$1" $status 2
   says "$1" "$work/complete.log" 'complete element.*SecondOrderIncomplete = 1'
}

if command -v gmsh > /dev/null; then
   for kind in 0 1 2 3 4; do
      for format in 0 1 2; do
         bar_anew $kind $format 0
         pulled "bar of ${meshes[kind]} built anew, ${formats[format]} field" "${kinds[kind]}" "$work/gmsh/bar.bdf"
      done
   done
   for kind in 1 3 4; do
      bar_anew $kind 1 1
      refuses "complete elements in the place of ${meshes[kind]}"
   done
   anew two_blocks 's/MeshSize {:} = .*;/MeshSize {:} = 9;/'
   anew post_on_plate 's/^size = .*;/size = 6;/'
   anew pin_in_bore 's/{1, 2} = 11;/{1, 2} = 19;/; s/{11} = 17;/{11} = 28;/' 2
   mkdir -p "$work/surfaces" && cp -R input/surfaces/mm_n "$work/surfaces" # which the deck includes
   anew column_foot 's/{column()}; } } = 100;/{column()}; } } = 80;/' 0
   # shells beside solids of second order: two runs on one file, by the lines of the manual
   cp input/gmsh/sheet_on_bed.geo "$work/gmsh" && rm -f "$work"/gmsh/{bed,sheet}_mesh.bdf
   sed -n '/^gmsh .* sheet_on_bed.geo$/p' input/README.md > "$work/gmsh/manual.sh"
   (cd "$work/gmsh" && sh ./manual.sh > log 2>&1)
   printf '%s\n' 'MODEL = SPACE' 'SPC = 1' 'LOAD = 1' 'BEGIN BULK' "INCLUDE 'gmsh/bed_mesh.bdf'" "INCLUDE 'gmsh/sheet_mesh.bdf'" 'PSOLID,1,1' \
      'PSHELL,2,1,4.0,1,,1' 'MAT1,1,210000.,,.3' 'PMARK,20' 'PMARK,21' 'PMARK,30' 'SHELLTO,30,21' 'SPCM,1,123,20' 'NODEAT,9001,180.,50.,80.' \
      'FORCE,1,9001,,100.,0.,1.,0.' 'ENDDATA' > "$work/sheet_on_bed.bdf"
   if "$program" -q -o "$work" "$work/sheet_on_bed.bdf" > "$work/sheet_on_bed.log"; then
      # forces and moments of the supports about the origin: F = (0, 100, 0) at (180, 50, 80)
      same 'a sheet on a bed, two runs of Gmsh: reactions' "$(awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
         $at["kind"] == "SPCM" { printf "%.3f %.3f %.1f %.1f", $at["force_x"] + 0, $at["force_y"], $at["moment_x"], $at["moment_z"] }' "$work/sheet_on_bed.reaction.csv")" '0.000 -100.000 8000.0 -18000.0'
   else
      fail 'a sheet on a bed, two runs of Gmsh'
   fi
   if tests/programs/column.sh "$program" "$work/column"; then passed=$((passed + 1)); else fail "a flanged column"; fi
   tests/programs/gmsh_fine.sh "$work"
   carries 'two_blocks: 50,000 nodes' two_blocks "$work/two_blocks_fine.bdf"
   grep -q 'SOLVER TREE' "$work/two_blocks_fine.out" || fail 'two_blocks, 50,000 nodes: AUTO did not take TREE'
else
   echo 'skipped: meshes built anew: gmsh is not installed'
fi
echo "$passed passed, $failed failed"
[ $failed -eq 0 ] && [ $passed -gt 0 ]
