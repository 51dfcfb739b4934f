#!/bin/bash
# Tests the comparison: it must reject result files that are damaged in every way that has passed unseen through the tests of other
# programs, and accept copies that are equal within the tolerance.
#
#     test_compare.sh COMPARE_RESULTS REFERENCE_FOLDER TOLERANCES
#
# The damaged files are small samples written here, and the first listing and history of REFERENCE_FOLDER.
set -u
export LC_ALL=C

if [ $# -ne 3 ] || [ ! -x "$1" ] || [ ! -f "$3" ]; then
   echo "usage: test_compare.sh COMPARE_RESULTS REFERENCE_FOLDER TOLERANCES" >&2
   exit 2
fi
program=$(realpath "$1"); folder=$2; tolerances=$(realpath "$3")
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT
passed=0; failed=0; skipped=0

# ---- tools ----

pass() { passed=$((passed + 1)); }
fail() {
   failed=$((failed + 1))
   if [ $failed -le 30 ]; then echo "FAILED: $1"; head -n 3 "$work/said"; fi
   [ $failed -eq 31 ] && echo "further failures are counted only"
}

# expect STATUS WHAT TOLERANCES REFERENCE ACTUAL [TEXT]: status of a comparison, TEXT is in what it says
expect() {
   local status
   "$program" "$3" "$4" "$5" >"$work/said" 2>&1; status=$?
   if [ "$status" -ne "$1" ]; then fail "$2: exit status $status, expected $1"
   elif [ "$1" -eq 1 ] && [ ! -s "$work/said" ]; then fail "$2: no difference is named"
   elif [ $# -gt 5 ] && ! grep -qF -- "$6" "$work/said"; then fail "$2: the message lacks '$6'"
   else pass
   fi
}

# damaged WHAT TOLERANCES REFERENCE ACTUAL [TEXT]: the damage has changed the file, and is seen
damaged() {
   if cmp -s "$3" "$4"; then : >"$work/said"; fail "$1: the damage has changed nothing"; else expect 1 "$@"; fi
}

# cell KIND SEPARATOR FILE [COLUMN]: line, index and value of the first cell of a kind; a header line of a CSV aside
cell() {
   awk -F"$2" -v kind="$1" -v column="${4:-}" -v separator="$2" '
      function is(v) {
         number = v ~ /^ *[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([EeDd][-+]?[0-9]+)? *$/
         real = number && v ~ /[.EeDd]/
         if (kind == "word")    return v ~ /^[A-Za-z]+$/
         if (kind == "integer") return number && !real
         if (kind == "real")    return real && v + 0 != 0
         if (kind == "zero")    return (real || number && separator == ",") && v + 0 == 0
      }
      separator == "," && NR == 1 { for (i = 1; i <= NF; i++) title[i] = $i; next }
      { for (i = 1; i <= NF; i++) if ((column == "" || title[i] == column) && is($i)) { print NR, i, $i; exit } }' "$3"
}

# put SEPARATOR FILE LINE INDEX VALUE: the file with another value in one cell
put() {
   awk -F"$1" -v OFS="$1" -v line="$3" -v i="$4" -v value="$5" 'NR == line { $i = value } { print }' "$2"
}

# moved VALUE RELATIVE ABSOLUTE FACTOR: the value, moved away from zero by FACTOR times what is allowed
moved() {
   awk -v v="$1" -v r="$2" -v a="$3" -v f="$4" 'BEGIN {
      gsub(/[Dd]/, "e", v); v += 0; s = v < 0 ? -1 : 1; d = f*(a + r*v*s); if (d == 0) d = 1e-300*f
      printf "%.17E\n", v + s*d }'
}

# limit_of listing|csv NAME: the relative and absolute tolerance of a name, or of `*`
limit_of() {
   awk -v kind="$1" -v name="$2" '
      { sub(/#.*/, "") }
      $1 == kind && ($2 == name || $2 == "*" && !own) {
         own = $2 == name; r = $3 == "exact" ? 0 : $4; a = $3 == "exact" ? 0 : $6 }
      END { print r + 0, a + 0 }' "$tolerances"
}

# ---- the ways to damage a file ----

# seen WHAT [TEXT]: a damage to the file of damage_file is seen, by default in line $line
seen() { damaged "$name: $1" "$limits" "$file" "$copy" "${2-:$line:}"; }

# damage_file NAME FILE SEPARATOR TOLERANCES RELATIVE ABSOLUTE COLUMN: what listings and histories have in common;
# a damage is skipped where the file has no number or word of its kind
damage_file() {
   local name=$1 file=$2 separator=$3 limits=$4 relative=$5 absolute=$6 column=$7
   local copy="$work/damaged.${file##*.}" other="$work/both.${file##*.}" line i value bad size rows
   rows=$(wc -l <"$file"); size=$(wc -c <"$file")

   cp "$file" "$copy"; expect 0 "$name: an identical copy" "$limits" "$file" "$copy"
   sed '$d' "$file" >"$copy";                     seen 'the last row removed' lines:
   sed "$((rows / 2 + 1))d" "$file" >"$copy";     seen 'a row removed' lines:
   sed "$((rows / 2 + 1))p" "$file" >"$copy";     seen 'a row twice' lines:
   sed '$p' "$file" >"$copy";                     seen 'the last row twice' lines:
   { cat "$file"; echo; } >"$copy";               seen 'a blank line at the end' lines:
   head -c $((size / 2)) "$file" >"$copy";        seen 'half of the file' lines:
   head -c $((size - 1)) "$file" >"$copy";        seen 'the last line end lost' 'end of the last line'
   : >"$copy";                                    seen 'an empty file' lines:

   # change VALUE: a copy with another value in the cell found last; change_by FACTOR: ... off by so many tolerances
   change() { put "$separator" "$file" "$line" "$i" "$1" >"$copy"; }
   change_by() { change "$(moved "$value" "$relative" "$absolute" "$1")"; }

   read -r line i value < <(cell real "$separator" "$file" "$column")
   if [ -n "${value:-}" ]; then
      for bad in NaN nan -NaN Infinity +Inf -Infinity '********' '***'; do
         change "$bad";                           seen "$bad in a number"
         damaged "$name: $bad in the reference" "$limits" "$copy" "$file" ":$line:"
         cp "$copy" "$other"
         expect 1 "$name: $bad in both" "$limits" "$other" "$copy" ":$line:"
      done
      for bad in 1.0E+999 word 1.0.0 12x; do
         change "$bad";                           seen "$bad for a number"
      done
      change "";                                  seen 'a number lost'
      change "$value$separator$value";            seen 'a number more'
      case $value in -*) bad=${value#-} ;; *) bad=-${value#+} ;; esac
      change "$bad";                              seen 'the sign'
      change_by 10;                               seen 'a number off by 10 times the tolerance'
      change_by -10;                              seen 'a number off by 10 times the tolerance, towards zero'
      change_by 0.1
      expect 0 "$name: a number inside the tolerance" "$limits" "$file" "$copy"
   else
      skipped=$((skipped + 1))
   fi

   value=; read -r line i value < <(cell zero "$separator" "$file" "$column")
   if [ -n "$value" ]; then
      change_by 10;                               seen 'a zero exceeded'
      change_by -10;                              seen 'a zero exceeded, below'
   else
      skipped=$((skipped + 1))
   fi

   value=; read -r line i value < <(cell word "$separator" "$file")
   if [ -n "$value" ]; then
      for bad in "X$value" "${value}X" "${value%?}" 1; do
         change "$bad";                           seen "'$bad' for the word $value"
      done
   else
      skipped=$((skipped + 1))
   fi
}

# damage_listing NAME FILE: with the tolerance outside of all tables
damage_listing() {
   local name=$1 file=$2 limits="$work/defaults.txt" copy="$work/integer.out" line i value= relative absolute
   read -r relative absolute < <(limit_of listing '*')
   damage_file "$name" "$file" ' ' "$limits" "$relative" "$absolute" ''
   read -r line i value < <(cell integer ' ' "$file")
   if [ -n "$value" ]; then
      put ' ' "$file" "$line" "$i" $((10#${value#[-+]} + 1)) >"$copy";     seen 'an integer'
      put ' ' "$file" "$line" "$i" "$value.0" >"$copy";                    seen 'a real for an integer'
   else
      skipped=$((skipped + 1))
   fi
}

# damage_history NAME FILE COLUMN: with the tolerance of this column
damage_history() {
   local name=$1 file=$2 limits=$tolerances copy="$work/header.csv" relative absolute title
   read -r relative absolute < <(limit_of csv "$3")
   damage_file "$name" "$file" , "$limits" "$relative" "$absolute" "$3"
   for title in "X$3" "${3%?}" "$3 " "$3,$3"; do
      sed -E "1s/(^|,)$3(,|$)/\\1$title\\2/" "$file" >"$copy";       seen "the column title '$title'" :1:
   done
   sed 1d "$file" >"$copy";                       seen 'no header' header
   cut -d, -f2- "$file" >"$copy";                 seen 'a column removed' header
   sed 's/$/,0/' "$file" >"$copy";                seen 'a column more' header
   sed '2s/$/,/' "$file" >"$copy";                seen 'an empty field more' ':2: row:'
   sed '2s/,[^,]*$//' "$file" >"$copy";           seen 'a field less' ':2: row:'
}

# ---- the samples ----

awk '{ sub(/#.*/, "") } $1 == "csv" || $1 == "listing"' "$tolerances" >"$work/defaults.txt"

cat >"$work/sample.out" <<'END'
          PRISM ON A RIGID BASE

     STAGE 1   CLAMPING   INCREMENT  3 OF 20

     TOTAL FORCE   -0.57407E+03   REACTION   1.2E-3   UNBALANCED   0.00000E+00
     ----------------------------------------------

     ELEMENT  NODE   BRANCH      LAMBDA        PRESSURE
           1    12   LOAD     0.57407E-02    0.13000E+00
           2    13   UNLOAD   0.31200D-02    0.07000E+00
           3    14   OPEN     0.00000E+00    0.00000E+00

     END OF STAGE  1
END
cat >"$work/sample.joint.csv" <<'END'
stage,increment,load,joint,element,node1,node2,x,y,z,area,branch,lambda,pressure,force,k_n,branch_x,delta_x,tau_x,k_sx,branch_y,delta_y,tau_y,k_sy,slip
1,1,5.0000000000000003E-02,1,1,12,,0.0000000000000000E+00,0.0,0.0,2.5000000000000000E+01,LOAD,5.7407123456789012E-03,1.3000000000000001E-01,3.25,1.1234567890123456E+04,,0.0,0.0,0.0,,0.0,0.0,0.0,0
1,1,5.0000000000000003E-02,1,2,13,,1.0000000000000000E+01,0.0,0.0,2.5000000000000000E+01,UNLOAD,3.1200000000000000E-03,7.0000000000000007E-02,1.75,1.0234567890123456E+04,,0.0,0.0,0.0,,0.0,0.0,0.0,0
1,1,5.0000000000000003E-02,1,3,14,,2.0000000000000000E+01,0.0,0.0,2.5000000000000000E+01,OPEN,0.0000000000000000E+00,0.0000000000000000E+00,0.0,0.0,,0.0,0.0,0.0,,0.0,0.0,0.0,1
END

damage_listing 'sample listing' "$work/sample.out"
for column in lambda pressure; do damage_history "sample history, $column" "$work/sample.joint.csv" $column; done
if [ $skipped -gt 0 ]; then : >"$work/said"; fail "$skipped damages found nothing to damage in the samples"; skipped=0; fi

sed 's/RIGID/ELASTIC/' "$work/sample.out" >"$work/copy.out"
damaged 'a word of a title' "$tolerances" "$work/sample.out" "$work/copy.out" ":1: token 4: reference 'RIGID', actual 'ELASTIC'"
sed 's/LAMBDA/PRESS/' "$work/sample.out" >"$work/copy.out"
damaged 'a column title of a listing' "$tolerances" "$work/sample.out" "$work/copy.out" ":8:"
sed 's/3 OF 20$/3 OF/' "$work/sample.out" >"$work/copy.out"
damaged 'the last word of a line lost' "$tolerances" "$work/sample.out" "$work/copy.out" ":3:"
damaged 'a word more at the end of a line' "$tolerances" "$work/copy.out" "$work/sample.out" ":3:"
sed 's/----$/---/' "$work/sample.out" >"$work/copy.out"
damaged 'a ruled line' "$tolerances" "$work/sample.out" "$work/copy.out" ":6:"
sed 's/UNLOAD/RELOAD/' "$work/sample.joint.csv" >"$work/copy.joint.csv"
damaged 'a branch of a history' "$tolerances" "$work/sample.joint.csv" "$work/copy.joint.csv" ":3: branch:"
sed '3s/,13,,/,13,15,/' "$work/sample.joint.csv" >"$work/copy.joint.csv"
damaged 'a number in an empty field' "$tolerances" "$work/sample.joint.csv" "$work/copy.joint.csv" ":3: node2:"
sed '4s/1$/0/' "$work/sample.joint.csv" >"$work/copy.joint.csv"
damaged 'slip' "$tolerances" "$work/sample.joint.csv" "$work/copy.joint.csv" ":4: slip:"
sed 's/,UNLOAD,/,UNLOAD ,/' "$work/sample.joint.csv" >"$work/copy.joint.csv"
damaged 'a blank in a word of a history' "$tolerances" "$work/sample.joint.csv" "$work/copy.joint.csv" ":3: branch:"
sed 's/   */ /g' "$work/sample.out" >"$work/copy.out"
expect 0 'other blanks in a listing' "$tolerances" "$work/sample.out" "$work/copy.out"
awk '{ printf "%s\r\n", $0 }' "$work/sample.out" >"$work/copy.out"
expect 0 'line ends CR LF' "$tolerances" "$work/sample.out" "$work/copy.out"
head -n 1 "$work/sample.joint.csv" >"$work/copy.joint.csv"
expect 0 'a history without rows' "$tolerances" "$work/copy.joint.csv" "$work/copy.joint.csv"
: >"$work/copy.out"
expect 1 'both files empty' "$tolerances" "$work/copy.out" "$work/copy.out"

# ---- how numbers are read ----

# number STATUS REFERENCE ACTUAL
number() {
   printf 'A %s B\n' "$2" >"$work/number.out"; printf 'A %s B\n' "$3" >"$work/copy.out"
   expect "$1" "number $2 against $3" "$work/defaults.txt" "$work/number.out" "$work/copy.out"
}
number 0 0.57407E+00 5.7407E-01
number 0 0.57407E+00 .57407d0
number 0 0.57407E+00 +0.57407
number 0 1.5-103     1.5E-103
number 1 1.5+103     1.5E+102
number 0 100.        1E2
number 0 0.00000E+00 -0.0
number 0 12          +012
number 0 0           -0
number 1 12          -12
number 1 12          13
number 1 12          1.2E1
number 1 123456789012345678901 123456789012345678902
number 1 1-3         1-4
number 1 0.5         5-1
number 1 1.0E+999    2.0E+999
number 1 0.5         5.0E-01X
number 1 0.5         0.5,
number 1 E           0.5
number 1 0.5         .
number 1 0.5-0.5     0.5-0.6
number 1 0.5NaN      0.5NaN
number 1 12.5Infinity 12.5Infinity
number 1 2.5'*****'  2.5'*****'
number 1 X=NaN,      X=NaN,
number 0 BANANA      BANANA
number 0 INFLOW      INFLOW
number 0 '*'         '*'
number 0 "$(printf '%060d' 0 | tr 0 '*')" "$(printf '%060d' 0 | tr 0 '*')"

# ---- tables ----

cat >"$work/tables.txt" <<'END'
listing *                relative 1e-6  absolute 0
table JOINT STATE        # the blank line below the column titles does not end it
   column 1  element     exact
   column 3  lambda      relative 0.1   absolute 0
   column *  rest        relative 1e-3  absolute 0
table JOINT STATE LONG
   column 3  slack       relative 0.5   absolute 0
line UNBALANCED
   column 2  residual    relative 0     absolute 1
table JOINT              # the longest title holds wherever it stands
   column *  joint       relative 0.9   absolute 0
table END
END
cat >"$work/tables.out" <<'END'
 JOINT STATE  1.00000

 ELEMENT  AREA  LAMBDA
    1  1.00000  1.00000
    2  1.00000  1.00000
  UNBALANCED 0.00000 1.00000
    3  1.00000  1.00000

  SUM 1.00000 1.00000
  JOINT   STATE   LONG
    1  1.00000  1.00000
  END
    1  1.00000  1.00000
END
# table STATUS LINE TOKEN VALUE QUANTITY
table() {
   awk -v line="$2" -v i="$3" -v value="$4" 'NR == line { $i = value } { print }' "$work/tables.out" >"$work/copy.out"
   if [ "$1" -eq 0 ]; then expect 0 "table, line $2, token $3: $4" "$work/tables.txt" "$work/tables.out" "$work/copy.out"
   else expect 1 "table, line $2, token $3: $4" "$work/tables.txt" "$work/tables.out" "$work/copy.out" ":$2: $5:"; fi
}
table 0 4 3 1.09;       table 1 4 3 1.11 lambda        # the quantity of the column
table 0 5 2 1.0009;     table 1 5 2 1.0011 rest        # the other columns
table 1 4 1 2 element                                  # integers are exact
table 1 1 3 1.0001 'token 3'                           # the title line stands outside its table
table 0 6 2 0.9;        table 1 6 2 1.1 residual       # a line within a table
table 1 6 3 1.0001 'token 3'                           # ... has the default for its other numbers
table 0 7 3 1.09                                       # ... and the table goes on below it
table 1 9 3 1.0001 'token 3'                           # a blank line below the rows ends the table
table 0 11 3 1.4;       table 1 11 3 1.6 slack         # the longest title; a title ends a table
table 1 11 2 1.0001 'token 2'
table 1 13 3 1.0001 'token 3'                          # a title without columns: the default again

# ---- paths ----

printf 'listing * relative 1e-6 absolute 0\npath ITERATIONS\n' >"$work/paths.txt"
printf ' ITERATIONS, STAGE 1\n\n ITER  LEFT\n    1  2.000E+01\n    2  3.000E-09\n\n SUM 1.00000\n' >"$work/paths.out"
# path STATUS WHAT SCRIPT [TEXT]: awk SCRIPT changes the sample
path() {
   awk "$3" "$work/paths.out" >"$work/copy.out"
   if [ "$1" -eq 0 ]; then expect 0 "path: $2" "$work/paths.txt" "$work/paths.out" "$work/copy.out"
   else damaged "path: $2" "$work/paths.txt" "$work/paths.out" "$work/copy.out" "$4"; fi
}
path 0 'other numbers' '{ sub(/3.000E-09/, "7.123E-11") } { print }'
path 0 'a row more' '{ print } NR == 5 { print "    3  1.000E-12" }'
path 0 'a row less' 'NR != 5'
path 1 'no row' 'NR < 4 || NR > 5' 'never without a row'
path 1 'NaN in a row' '{ sub(/3.000E-09/, "NaN") } { print }' 'not finite'
path 1 'the line below' '{ sub(/SUM 1.00000/, "SUM 1.10000") } { print }' 'token 2'
path 1 'a line more at the end' '{ print } END { print "SUM" }' lines
path 1 'another title' '{ sub(/STAGE 1/, "STAGE 2") } { print }' 'token 3'
printf 'path A\ncolumn 1 a exact\n' >"$work/wrong.txt"
expect 2 'a column of a path' "$work/wrong.txt" "$work/sample.out" "$work/sample.out" wrong.txt:2:

# ---- every statement of the tolerance file ----

awk '{ sub(/#.*/, "") }
   $1 == "table" || $1 == "line" || $1 == "path" { kind = $1; $1 = ""; sub(/^ */, ""); title = $0; next }
   $1 == "listing" { kind = "listing"; title = ""; column = 2 }
   $1 == "csv"     { kind = "csv"; title = $2 == "*" ? "any_other" : $2; column = 1 }
   $1 == "column"  { column = $2 == "*" ? 40 : $2 }
   NF { at = $1 == "column" ? 4 : 3
        print kind, column, $at == "exact" ? 0 : $(at + 1) + 0, $at == "exact" ? 0 : $(at + 3) + 0, title }' \
   "$tolerances" >"$work/statements"

# result KIND COLUMN TITLE VALUE: a result file with the value where a statement holds
result() {
   awk -v kind="$1" -v column="$2" -v title="$3" -v value="$4" 'BEGIN {
      if (kind == "csv") { print title; print value; exit }
      if (kind == "table") print title
      n = kind == "line" ? split(title, words) : 0
      row = n > 0 ? title : "-"
      for (i = n > 0 ? n + 1 : 2; i <= column; i++) row = row " " (i == column ? value : "-")
      print column == 1 ? value : row }'
}

while read -r kind column relative absolute title; do
   ending=out; [ "$kind" = csv ] && ending=csv
   what="tolerance of $kind $title $column"
   for value in 2.5 0.0; do
      result "$kind" "$column" "$title" $value >"$work/statement.$ending"
      off=$(moved $value "$relative" "$absolute" 10)
      [ "$value $relative $absolute" = '2.5 0 0' ] && off=2.500000000000001
      result "$kind" "$column" "$title" "$off" >"$work/copy.$ending"
      damaged "$what: $value off by 10 times" "$tolerances" "$work/statement.$ending" "$work/copy.$ending"
      [ "$relative $absolute" = '0 0' ] || [ "$value $absolute" = '0.0 0' ] && continue
      result "$kind" "$column" "$title" "$(moved $value "$relative" "$absolute" 0.1)" >"$work/copy.$ending"
      expect 0 "$what: $value inside" "$tolerances" "$work/statement.$ending" "$work/copy.$ending"
   done
done <"$work/statements"

# ---- long files, long lines, many differences ----

awk 'BEGIN { for (i = 1; i <= 250000; i++) printf "%d.5 ", i; print "END"; for (i = 1; i <= 250000; i++) print "ROW", i }' >"$work/long.out"
sed '1s/250000.5 END/260000.5 END/' "$work/long.out" >"$work/copy.out"
damaged 'the end of a line of 2 MB' "$tolerances" "$work/long.out" "$work/copy.out" ':1: token 250000:'
sed '$s/ROW/RAW/' "$work/long.out" >"$work/copy.out"
damaged 'the end of a file of 5 MB' "$tolerances" "$work/long.out" "$work/copy.out" ':250001: token 1:'
cp "$work/long.out" "$work/copy.out"
expect 0 'a file of 5 MB' "$tolerances" "$work/long.out" "$work/copy.out"
sed '2,51s/ROW/RAW/; $d' "$work/long.out" >"$work/copy.out"
damaged '51 differences' "$tolerances" "$work/long.out" "$work/copy.out" ': 51, shown: 21'
if [ "$(wc -l <"$work/said")" -eq 22 ]; then pass; else fail '51 differences: not 20 lines, the number of lines and the count'; fi

# ---- new references: accept.sh ----

accept=$(realpath "$(dirname "$0")/accept.sh")
place=$work/accept
mkdir -p "$place/input" "$place/reference_output" "$place/made" "$place/before"
: >"$place/input/sample.bdf"
printf '#!/bin/sh\ncp made/* "$3"\n' >"$place/program"
chmod +x "$place/program"
cat >"$place/before/sample.out" <<'END'
 STAGE 1

 TOTAL FORCE   -5.74070E+02   REACTION   1.20000E-03

 ITERATIONS
   ITER  LEFT
      1  2.00000E+01
      2  3.00000E-09

 ELEMENT  BRANCH      LAMBDA
       1  LOAD     5.74070E-03
       2  UNLOAD   3.12000E-03
       3  UNLOAD   3.15000E-03
END
cp "$work/sample.joint.csv" "$place/before"
# what another processor makes of the same program: last digits, and an iteration more
noise='s/5\.7407123456789012E-03/5.7407123456789099E-03/; s/2\.0000000000000000E+01/1.9999999999999996E+01/
   s/-5\.74070E+02/-5.74071E+02/; s/5\.74070E-03/5.74071E-03/; s/^ *2  3\.00000E-09/&\n      3  1.00000E-12/'
# accepted WHAT SCRIPT [SAID]: the results are the references, with that noise, changed by the sed SCRIPT: this change alone is written
accepted() {
   local file
   cp "$place"/before/* "$place/reference_output"
   for file in sample.out sample.joint.csv; do sed "$noise" "$place/before/$file" | sed "$2" >"$place/made/$file"; done
   if (cd "$place" && "$accept" ./program "$program" build sample) >"$work/said" 2>&1; then pass; else fail "accept, $1: ended with a status"; fi
   if grep -qF -- "${3:-lines differ}" "$work/said"; then pass; else fail "accept, $1: not told '${3:-lines differ}'"; fi
   for file in sample.out sample.joint.csv; do
      cp "$place/reference_output/$file" "$work/taken.${file##*.}"
      sed "$2" "$place/before/$file" | diff - "$work/taken.${file##*.}" >"$work/said" && pass || fail "accept, $1: $file is not the reference with this change"
   done
}
accepted 'the same program' '' 'nothing is written'
if find "$place/reference_output" -newer "$place/made/sample.out" | grep -q csv; then fail 'accept: a file that is equal is written'; else pass; fi
accepted 'a number' 's/7\.0000000000000007E-02/7.1E-02/; s/3\.15000E-03/3.16000E-03/' 'sample.joint.csv: 1 of 4 lines'
accepted 'a line more' 's/^       3  UNLOAD .*/&\n       4  OPEN     0.00000E+00/'
accepted 'a line less' '/ 3  UNLOAD/d' '1 of it are gone'
accepted 'a row more' '2s/.*/&\n1,1,0.05,9,9,99,,0.0,0.0,0.0,25.0,OPEN,0.0,0.0,0.0,0.0,,0.0,0.0,0.0,,0.0,0.0,0.0,0/'
accepted 'another branch' 's/UNLOAD/RELOAD/'
accepted 'a word' 's/STAGE 1/STAGE 2/; s/UNLOAD,3/LOAD,3/'
# BYTES: a listing that is equal within the tolerances, but for rows that rounding rules; no table
cp "$place"/before/* "$place/reference_output"
for file in sample.out sample.joint.csv; do sed "$noise" "$place/before/$file" >"$place/made/$file"; done
(cd "$place" && BYTES=yes "$accept" ./program "$program" build sample) >"$work/said" 2>&1
if cmp "$place/made/sample.out" "$place/reference_output/sample.out" && cmp "$place/before/sample.joint.csv" "$place/reference_output/sample.joint.csv"; then
   pass; else fail 'accept BYTES: the listing, and it alone'; fi
sed -i 's/^ ITERATIONS/ CONVERGENCE HISTORY/' "$place/reference_output/sample.out"
cp "$place/reference_output/sample.out" "$place/history.out"
sed 's/1\.00000E-12/7.00000E-13/' "$place/history.out" >"$place/made/sample.out"
(cd "$place" && BYTES=yes "$accept" ./program "$program" build sample) >"$work/said" 2>&1
if cmp "$place/history.out" "$place/reference_output/sample.out"; then pass; else fail 'accept BYTES: a row of CONVERGENCE HISTORY'; fi

# not its rows: they belong to the columns of another program
cp "$place"/before/* "$place/reference_output"
sed "1s/slip/slipped/; $noise" "$place/before/sample.joint.csv" >"$place/made/sample.joint.csv"
(cd "$place" && "$accept" ./program "$program" build sample) >"$work/said" 2>&1
if cmp "$place/made/sample.joint.csv" "$place/reference_output/sample.joint.csv" >"$work/said" 2>&1; then pass; else fail 'accept: another header, other rows'; fi
rm "$place/reference_output/sample.out"
cp "$place/made/sample.joint.csv" "$place/made/sample.stage.csv"
(cd "$place" && TABLES=stage "$accept" ./program "$program" build sample) >"$work/said" 2>&1
for file in sample.out sample.stage.csv; do
   if cmp "$place/made/$file" "$place/reference_output/$file" >"$work/said" 2>&1; then pass; else fail "accept: a first $file"; fi
done
if (cd "$place" && "$accept" ./program "$program" build none) >"$work/said" 2>&1; then fail 'accept: no deck'; else pass; fi

# ---- exit status 2 ----

expect 2 'a missing reference' "$tolerances" "$work/none.out" "$work/sample.out" none.out
expect 2 'a missing result' "$tolerances" "$work/sample.out" "$work/none.out" none.out
expect 2 'missing tolerances' "$work/none.txt" "$work/sample.out" "$work/sample.out" none.txt
expect 2 'a folder for a file' "$tolerances" "$work" "$work/sample.out"
expect 2 'a history against a listing' "$tolerances" "$work/sample.joint.csv" "$work/sample.out"
for arguments in "" "$tolerances" "$tolerances a" "$tolerances a b c d"; do
   # shellcheck disable=SC2086
   "$program" $arguments >"$work/said" 2>&1
   if [ $? -eq 2 ] && grep -q usage: "$work/said"; then pass; else fail "arguments '$arguments': not told how to use it"; fi
done
while read -r statement; do
   printf '# a comment\n%s\n' "$statement" >"$work/wrong.txt"
   expect 2 "tolerance file with '$statement'" "$work/wrong.txt" "$work/sample.out" "$work/sample.out" wrong.txt:2:
done <<'END'
csw lambda relative 1e-9 absolute 1e-15
csv lambda
csv lambda relative 1e-9
csv lambda absolute 1e-9 relative 1e-9
csv lambda relative 1e-9 absolute 1e-15 1e-15
csv lambda relative 1e-9x absolute 1e-15
csv lambda relative NaN absolute 1e-15
csv lambda relative 1e-9 absolute Infinity
csv lambda relative 1e-9 absolute 1e999
csv lambda relative -1e-9 absolute 1e-15
csv lambda relative 1 absolute 1e-15
csv lambda exact 1e-15
listing lambda exact
table
column 1 lambda exact
END
printf 'csv a exact\ncsv a exact\n' >"$work/wrong.txt"
expect 2 'two tolerances of a column' "$work/wrong.txt" "$work/sample.out" "$work/sample.out" wrong.txt:2:
printf 'table A\ntable  A\n' >"$work/wrong.txt"
expect 2 'a title twice' "$work/wrong.txt" "$work/sample.out" "$work/sample.out" wrong.txt:2:
printf 'table A\ncolumn 0 a exact\n' >"$work/wrong.txt"
expect 2 'column 0' "$work/wrong.txt" "$work/sample.out" "$work/sample.out" wrong.txt:2:

# ---- the reference files ----

# a title that no listing has, nor the program, is a tolerance that never holds
if ls "$folder"/*.out >/dev/null 2>&1; then
   awk '/^(table|path|line) / { sub(/#.*/, ""); $1 = ""; $1 = $1; print }' "$tolerances" | while read -r title; do
      cat "$folder"/*.out | awk -v title="$title" '
         { line = $0; gsub(/[,:]( |$)/, " ", line); gsub(/ +/, " ", line); sub(/^ /, "", line)
           if (index(line " ", title " ") == 1) { found = 1; exit } } END { exit !found }' || grep -qF "'$title" src/result/*.f90 || echo "$title"
   done >"$work/said"
   if [ -s "$work/said" ]; then fail 'titles that no listing has'; else pass; fi
fi

chosen=
for file in "$folder"/*.out; do
   if [ -f "$file" ] && [ -n "$(cell real ' ' "$file")" ]; then chosen=$file; break; fi
done
if [ -n "$chosen" ]; then damage_listing "${chosen##*/}" "$chosen"; else echo "no listing with numbers in $folder"; fi
chosen=
for file in "$folder"/*.joint.csv; do
   if [ -f "$file" ] && [ -n "$(cell real , "$file" lambda)" ]; then chosen=$file; break; fi
done
if [ -n "$chosen" ]; then damage_history "${chosen##*/}" "$chosen" lambda; else echo "no history with numbers in $folder"; fi
for what in 'stage p_max' 'stage n' 'stage secant_n' 'bolt force' 'bolt change' 'bolt longer'; do
   set -- $what
   chosen=
   for file in "$folder"/*."$1.csv"; do
      if [ -f "$file" ] && [ -n "$(cell real , "$file" "$2")" ]; then chosen=$file; break; fi
   done
   if [ -n "$chosen" ]; then
      head -n 3 "$chosen" >"$work/part.$1.csv" # a row or two are enough for what is damaged, and quick
      damage_history "${chosen##*/}, $2" "$work/part.$1.csv" "$2"
   else
      : >"$work/said"; fail "no table of $1 with numbers in $2 in $folder"
   fi
done
[ $skipped -gt 0 ] && echo "$skipped damages found nothing to damage in the reference files"

echo "$passed passed, $failed failed"
[ $failed -eq 0 ]
