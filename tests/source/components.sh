#!/usr/bin/env bash
# Checks that restart files forget nothing: of each type with a part in them, the routine that names its components names all.
#
#    components.sh SOURCE_FOLDER
#
# A part is `call stream%part('TYPE', version)`. A component that the routine of the part does not use, and that the list below does
# not have, is printed; likewise a line of the list that is no longer true. N counts the components.
set -u
left_out='
analysis_type goes_on: true only while the run resumes
analysis_type supports: stands before the analysis, whose sizes depend on it
increment_record condensed: of one increment, the first prints it
page_type labels date: from the deck, in the head of the listing
table_type title last line: come with the next row
vtu_results_type name labels many is_listed subdomains: start_vtu makes them anew
bolt_history bolts passages crossing kind: start_bolts makes them anew
bolt_history passed: of the last increment
finished_type companion: written anew
results_type missing_vtu method cuts: start_results makes them anew
results_type joints_now bolts_now watched: of the last increment, and of the last stage
output_file_type *: the file is kept by its bytes
'
find "$1" -name '*.f90' -print0 | sort -z | xargs -0 awk -v left_out="$left_out" '
   BEGIN {
      n = split(left_out, lines, "\n")
      for (i = 1; i <= n; i++) {
         m = split(substr(lines[i], 1, index(lines[i], ":") - 1), words, " ")
         for (k = 2; k <= m; k++) except[words[1], words[k]] = 1
      }
   }
   { sub(/ *!.*/, "") }                                              # no exclamation mark stands in a text of these lines
   /^ *type(, public)? *:: *[a-z_0-9]+ *$/ { type = $NF; next }
   /^ *type, .*:: *[a-z_0-9]+ *$/ && !/^ *type,.*\(.*\(/ { type = $NF; next }
   /^ *(contains|end type)/ { type = "" }
   type != "" && /::/ {
      sub(/.*:: */, "")
      while (gsub(/\([^()]*\)/, "")) ;                               # extents, and calls in initial values
      n = split($0, names, ",")
      for (i = 1; i <= n; i++) {
         sub(/=.*/, "", names[i]); gsub(/[ &]/, "", names[i])
         if (names[i] ~ /^[a-z]/) {
            components[type] = components[type] " " names[i]
            components[FILENAME, type] = components[FILENAME, type] " " names[i]
         }
      }
   }
   /^ *(pure |elemental )*(recursive )?subroutine / { text = ""; parts = "" }
   { text = text " " $0 }
   match($0, /%part\(\047[a-z_0-9]+/) { parts = parts " " substr($0, RSTART + 7, RLENGTH - 7) }
   /^ *end subroutine/ {
      n = split(parts, these, " ")
      for (i = 1; i <= n; i++) { routine[these[i]] = routine[these[i]] text; home[these[i]] = FILENAME }
      parts = ""
   }
   END {
      for (type in routine) {
         of_type = components[home[type], type]                      # a private type, which others may be called like
         if (of_type == "") of_type = components[type]
         m = split(of_type, names, " ")
         if (m == 0) { print type ": has a part, and no components are found"; failed++ }
         for (i = 1; i <= m; i++) {
            name = names[i]
            used = routine[type] ~ ("%" name "[^a-z_0-9]")
            count++
            if ((type, "*") in except) { met[type, "*"] = 1; continue }
            if (!used && (type, name) in except) { met[type, name] = 1; continue }
            if (!used) { print type "%" name ": a restart file forgets it"; failed++ }
         }
      }
      for (key in except) {
         split(key, pair, SUBSEP)
         if (!(key in met)) { print pair[1] "%" pair[2] ": is left out no longer"; failed++ }
      }
      if (count == 0) { print "no part is found"; failed++ }
      print count - failed " passed, " failed + 0 " failed"
      exit failed > 0
   }'
