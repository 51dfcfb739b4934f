#!/usr/bin/env bash
# Writes the verification manual, reference_output/README.md, from the chapters in this folder and from runs of the program. `N
# passed` counts rows of the tables. ../README.md tells how to write a chapter.
#
#    make.sh PROGRAM QUERY WORK_FOLDER PAGE      writes PAGE if every number of the runs is within its limit
set -u
program=$1 query=$2 work=$3 page=$4
mkdir -p "$work"
source tests/exact/lib.sh
source tests/exact/decks.sh
source tests/manual/lib.sh

: > "$work/notes" && : > "$work/found" || exit 1
exec 3> "$work/draft.md"
for chapter in tests/manual/[0-9][0-9]_*.md; do
   awk -f tests/manual/page.awk "$chapter" > "$work/chapter.sh" && source "$work/chapter.sh"
done
exec 3>&-
if [ $failed -eq 0 ]; then
   awk -v notes="$work/notes" -v found="$work/found" -f tests/manual/numbers.awk -f tests/manual/fill.awk "$work/draft.md" "$work/draft.md" \
      > "$work/page.md" && cp "$work/page.md" "$page" || fail 'the page could not be filled'
fi
echo "$passed passed, $failed failed"
[ $failed -eq 0 ] && [ $passed -gt 0 ]
