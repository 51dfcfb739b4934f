# Two runs of one deck: awk -f compare.awk EXPECTED.joint.csv EXPECTED.out ACTUAL.joint.csv ACTUAL.out
#
# A number of the history may be off by 1E-9 of the largest in its column, or of a thousandth of the largest of its kind where
# that is more: the columns of a direction in which nothing happens hold rounding alone. A number in the tables of displacements
# and reactions of the listing may besides be off by a unit of its last digit. Words, and numbers of something, must be the same.
# Prints the largest difference of the history as a share of what it is measured by, or the first that is too large; the exit
# status tells which.

BEGIN {
   split("lambda length delta_x length delta_y length pressure stress tau_x stress tau_y stress", word, " ")
   for (i = 1; i in word; i += 2) kind[word[i]] = word[i + 1]
   real = "^[-+]?[0-9]+[.][0-9]*([eE][-+]?[0-9]+)?$"
}

FNR == 1 { file++; rows[file] = 0; in_table = 0 }

file % 2 == 1 { line[file, ++rows[file]] = $0; next }

/^ [A-Z]/ { in_table = /^ (DISPLACEMENTS|REACTIONS)/; title = $1 }
in_table && $1 ~ /^[0-9]+$/ { line[file, ++rows[file]] = title " " $0 } # title, node, X Y (Z), two or three of the table

END {
   if (file != 4) stop("there are " file + 0 " files of results, expected 4")
   if (rows[1] < 1 || rows[2] < 1) stop("no history, or no table of displacements")
   for (i = 1; i <= 2; i++) if (rows[i] != rows[i + 2]) stop(rows[i] " rows, and " rows[i + 2])
   n = split(line[1, 1], name, ",")
   if (line[1, 1] != line[3, 1]) stop("the titles of the columns differ")
   find_scales(1, ",", 2)
   for (row = 2; row <= rows[1]; row++) compare(1, 3, ",", 0)
   found = worst ? sprintf("within %.1E of the scale of %s", worst, worst_column) : "the same digits"
   split("", name); split("", scale); split("", largest); split("", kind)
   find_scales(2, " ", 1)
   for (row = 1; row <= rows[2]; row++) compare(2, 4, " ", 1.01e-5)
   print rows[1] - 1 " and " rows[2] " rows, " found
}

function size(x) { return x < 0 ? -x : x + 0 }

function stop(words) { print words; exit 1 }

# What the columns of a file are measured by; in tables of the listing those of one title and one column.
function find_scales(file, separator, first,    c, m, key) {
   for (row = first; row <= rows[file]; row++) {
      m = split(line[file, row], word, separator)
      for (c = 1; c <= m; c++) {
         key = c in name ? name[c] : word[1] " " (c > 1 + m / 2)
         if (word[c] ~ real && size(word[c]) > scale[key]) scale[key] = size(word[c])
      }
   }
   for (key in kind) if (scale[key] > largest[kind[key]]) largest[kind[key]] = scale[key]
   for (key in kind) if (scale[key] < largest[kind[key]] / 1000) scale[key] = largest[kind[key]] / 1000
}

# One row of two files, every number within 1E-9 of its scale and DIGITS of itself.
function compare(expected, actual, separator, digits,    c, m, key, off) {
   m = split(line[expected, row], word, separator)
   if (split(line[actual, row], other, separator) != m) stop("row " row ": " m " columns, and another number of them")
   for (c = 1; c <= m; c++) {
      key = c in name ? name[c] : word[1] " " (c > 1 + m / 2)
      if (word[c] !~ real || other[c] !~ real) {
         if ("" word[c] != "" other[c]) stop("row " row ", " key ": " word[c] ", and " other[c])
         continue
      }
      off = size(word[c] - other[c])
      if (off > 1e-9 * scale[key] + digits * size(word[c])) stop("row " row ", " key ": " word[c] ", and " other[c])
      if (scale[key] > 0 && off / scale[key] > worst && !digits) { worst = off / scale[key]; worst_column = key }
   }
}
