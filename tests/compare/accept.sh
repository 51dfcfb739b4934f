#!/usr/bin/env bash
# Makes the present results of decks of input/ their references.
#
#    accept.sh PROGRAM WORK_FOLDER NAME...
#    accept.sh PROGRAM WORK_FOLDER --failed CHECK_FOLDER      of the decks that failed the last check.sh in CHECK_FOLDER
#
# Listing and joint history always; the tables of stages, bolts, modes, their energy and response where a reference exists, or where
# TABLES='stage bolt modes modes.energy response backbone' in the environment asks for them.
set -eu
program=$1 work=$2
shift 2
if [ "${1:-}" = --failed ]; then
   [ -e "$2/failed" ] || { echo "no check has been run: make check"; exit 1; }
   mapfile -t names < "$2/failed"
   set -- "${names[@]}"
   [ $# -gt 0 ] || { echo 'no deck has failed the last make check'; exit 0; }
fi
[ -n "${1:-}" ] || { echo 'usage: make accept CASE=name, for input/name.bdf, or ACCEPT=failed, for those that failed the last make check'; exit 1; }
mkdir -p "$work"
for name; do
   [ -f "input/$name.bdf" ] || { echo "there is no deck input/$name.bdf"; exit 1; }
   "$program" -q -o "$work" "input/$name.bdf"
   cp "$work/$name.out" "$work/$name.joint.csv" reference_output
   for table in stage bolt modes modes.energy response backbone; do
      [[ -f reference_output/$name.$table.csv || " ${TABLES:-} " = *" $table "* ]] || continue
      cp "$work/$name.$table.csv" reference_output
   done
   echo "$name: accepted"
done
echo 'say in the commit message why the references changed'
