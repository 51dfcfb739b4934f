# Compares the tables of displacements, reactions and natural frequencies of two listings: awk -f compare.awk EXPECTED.out
# ACTUAL.out
#
# A number may differ by 1E-9 of the largest value of its quantity in tables of its title, and by one unit of its last digit. Words
# and counts must be equal. With MAY_LACK above 0 both may have no such table. Prints the first difference, or how many rows there are;
# the exit status tells which.

BEGIN { real = "^[-+]?[0-9]+[.][0-9]*([eE][-+]?[0-9]+)?$" }
FNR == 1 { file++; in_table = 0 }
/^ [A-Z]/ { in_table = /^ (DISPLACEMENTS|REACTIONS|FREQUENCIES)/; title = $1 }
title == "FREQUENCIES" { $0 = $1 " " $2 " " $3 " " $4 } # the residual is rounding
in_table && $1 ~ /^[0-9]+$/ { line[file, ++rows[file]] = title " " $0 } # title, node, X Y (Z), two or three of the table

END {
   if (rows[1] + rows[2] == 0 && may_lack > 0) { print "no tables"; exit }
   if (rows[1] < 1 || rows[1] != rows[2]) stop(rows[1] + 0 " rows, and " rows[2] + 0)
   for (row = 1; row <= rows[1]; row++) {
      m = split(line[1, row], word, " ")
      for (c = 1; c <= m; c++) if (word[c] ~ real && size(word[c]) > scale[key(c)]) scale[key(c)] = size(word[c])
   }
   for (row = 1; row <= rows[1]; row++) {
      m = split(line[1, row], word, " ")
      if (split(line[2, row], other, " ") != m) stop("row " row ": " m " columns, and another number of them")
      for (c = 1; c <= m; c++) {
         if (word[c] !~ real || other[c] !~ real) close_enough = "" word[c] == "" other[c]
         else close_enough = size(word[c] - other[c]) <= 1e-9 * scale[key(c)] + 1.01e-5 * size(word[c])
         if (!close_enough) stop("row " row ", " key(c) ": " word[c] ", and " other[c])
      }
   }
   print rows[1] " rows"
}

function size(x) { return x < 0 ? -x : x + 0 }
function key(c) { return word[1] " " (c > 1 + m / 2) } # the title, and whether it is a place or what the table is about
function stop(words) { print words; exit 1 }
