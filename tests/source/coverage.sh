#!/usr/bin/env bash
# Reads the counters of gcov: prints the lines of src that ran, file by file, then the lines that did not run, each with the class
# that explains it.
#
#    coverage.sh FOLDER SOURCES EXPLAINED [LEAST]
#
# FOLDER holds the counters (*.gcno, *.gcda), SOURCES is the folder of the sources. EXPLAINED has a line `FILE | TEXT | CLASS` for
# every line that no test can or need run: TEXT is the line, or a part of it with `*` at either end. Fails where less than LEAST per
# cent (98.5) ran, or where a line that did not run is not explained.
set -u
export LC_ALL=C
here=$(dirname "$0")
folder=$1 sources=$2 explained=$3 least=${4:-98.5}
gcov -t -o "$folder" "$folder"/*.gcno 2> /dev/null |
   awk -v sources="$sources" -v explained="$explained" -v least="$least" -f "$here/coverage_table.awk"
