#!/usr/bin/env bash
# Compares whole runs with exact answers and independent computations.
#
#    run.sh PROGRAM QUERY WORK_FOLDER [PART...]      all parts, or those named
set -u
program=$1 query=$2 work=$3
shift 3
mkdir -p "$work"
source tests/exact/lib.sh
source tests/exact/decks.sh
[ $# -gt 0 ] || set -- one_element by_hand first_guess rigid_block beam friction feet prism path turned two_bodies resultants histories gaps solids \
   space_axes moved_supports solid_bolts patches twisted_beam flange warm meshed_apart spiders rotations springs answer slip_limit divided habits sectors condition \
   modes response dampers relief harmonic superelement backbone free linear_pressure watch cases reactions batch plates laminates places rotating bolts energy half_models frames iwan bolt_parts shared_faces retighten nx supports scalars

for part in "$@"; do source "tests/exact/$part.sh"; done
echo "$passed passed, $failed failed"
[ $failed -eq 0 ] && [ $passed -gt 0 ]
