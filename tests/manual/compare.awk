# Compares two pages line by line: the same text and the same numbers. Rounded numbers may differ by one in the last digit: numbers
# with an exponent, with five digits or more, and percentages.
#    awk -f compare.awk COMMITTED MADE       prints the differences; status 1 if there are any
function next_number(s,   from, rest) {   # sets at, long: where a number stands in S
   if (!match(s, /[-+]?[0-9]+(\.[0-9]+)?(E-?[0-9]+)?/)) return 0
   at = RSTART; long = RLENGTH
   return 1
}
function soft(number, behind,   digits) {
   digits = number; sub(/E.*/, "", digits); gsub(/[^0-9]/, "", digits); sub(/^0+/, "", digits)
   return number ~ /E/ || number ~ /\./ && length(digits) >= 5 || behind ~ /^ %/
}
function unit(number,   mantissa, decimals, exponent) {
   mantissa = number; sub(/E.*/, "", mantissa)
   decimals = mantissa ~ /\./ ? length(mantissa) - index(mantissa, ".") : 0
   exponent = number ~ /E/ ? substr(number, index(number, "E") + 1) : 0
   return 10 ^ (exponent - decimals)
}
function same(a, b,   x, y, u, d) {
   while (1) {
      if (!next_number(a)) return !next_number(b) && a == b
      x = substr(a, at, long); head = substr(a, 1, at - 1); a = substr(a, at + long)
      if (!next_number(b)) return 0
      y = substr(b, at, long)
      if (head != substr(b, 1, at - 1)) return 0
      b = substr(b, at + long)
      if (x == y) continue
      if (!soft(x, a) || !soft(y, b)) return 0
      u = unit(x) > unit(y) ? unit(x) : unit(y); d = x - y
      if (!(d <= 1.01 * u && -d <= 1.01 * u)) return 0
   }
}
NR == FNR { line[++n] = $0; next }
{ m++; if (m > n || !same(line[m], $0)) { faults++; if (faults <= 10) print "line " m "\n   committed: " line[m] "\n   made:      " $0 } }
END {
   if (m < n) { print n - m " lines are missing"; faults++ }
   if (!m) print "an empty page"
   exit faults || !m
}
